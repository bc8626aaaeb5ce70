/* How often something happened, judged by the binomial law: for tests of coverage. */
#ifndef TESTS_BINOMIAL_H
#define TESTS_BINOMIAL_H

#include "law.h"

/* What a normal variable exceeds in magnitude with probability LAW_ALPHA. */
#define BINOMIAL_SIGMAS 6.1095

/* P(X = k) for X binomial, 0 < p < 1. */
LAW_UNUSED static double binomial_mass(uint64_t k, uint64_t n, double p)
{
    const double hits = (double)k, misses = (double)(n - k);
    return exp(lgamma((double)n + 1) - lgamma(hits + 1) - lgamma(misses + 1) + hits * log(p) +
               misses * log1p(-p));
}

/* P(from <= X <= to), summed term by term: good to 1e-10 of itself while n is below a million. */
LAW_UNUSED static double binomial_between(uint64_t from, uint64_t to, uint64_t n, double p)
{
    double sum = 0;
    for (uint64_t k = from; k <= to; k++)
        sum += binomial_mass(k, n, p);
    return sum;
}

/* One check that n trials with k successes have a success probability p, or, if `at_least`, one of
 * p or more. It fails by chance with probability LAW_ALPHA, or half of it. */
LAW_UNUSED static int binomial_ok(uint64_t k, uint64_t n, double p, int at_least, const char *what)
{
    const double below = binomial_between(0, k, n, p);
    const double above = at_least ? 1 : binomial_between(k, n, n, p);
    const int good = below > LAW_ALPHA / 2 && above > LAW_ALPHA / 2;
    return tap_ok(good, "%s: %.4f of %llu, expected %s%.4f", what, (double)k / (double)n,
                  (unsigned long long)n, at_least ? "at least " : "", p);
}

#endif
