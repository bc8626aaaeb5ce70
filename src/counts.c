#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/counts.h>
#include <buffon/math.h>

#include "density_priv.h"
#include "elementary.h"
#include "incomplete.h"
#include "special.h"

#define COUNTS_MOST 0x1p50 /* tries */
#define COUNTS_LOG_SQRT_2PI 0x1.d67f1c864beb5p-1
#define COUNTS_FEW 200     /* a mean up to which all probabilities fit a table */
#define COUNTS_DOUBT 1e-12 /* of a tail: nearer than that, a sum of probabilities does not decide */

/* Whether x is a whole number from 0 to `most`, itself at most 2^53. */
static int counts_whole(double x, double most)
{
    return x >= 0 && x <= most && x == (double)(int64_t)x;
}

/* ---- the Bernoulli and the geometric law ---- */

/* 1 - p is exact where it is compared, or is not needed to the last bit. */
static int bernoulli_draw(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    const double p = g->param[0];
    for (size_t i = 0; i < n; i++) {
        x[i] = u[i] > 0.5 ? 1 - u[i] < p : u[i] > 1 - p;
        if (pdf)
            pdf[i] = x[i] == 1 ? p : 1 - p;
    }
    return 0;
}

static int bernoulli_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double p = g->param[0];
    for (size_t i = 0; i < n; i++)
        pdf[i] = x[i] == 1 ? p : x[i] == 0 ? 1 - p : 0;
    return 0;
}

static int bernoulli_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double p = g->param[0], one = buffon_priv_log(p), zero = buffon_priv_log1p(-p);
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = x[i] == 1 ? one : x[i] == 0 ? zero : -(double)INFINITY;
    return 0;
}

static const buffon_density_ops bernoulli_ops = {.sample = bernoulli_draw,
                                                 .pdf = bernoulli_pdf,
                                                 .log_pdf = bernoulli_log_pdf,
                                                 .name = "buffon.bernoulli"};

buffon_density buffon_bernoulli(double p)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &bernoulli_ops};
    if (p >= 0 && p <= 1)
        g.param[0] = p;
    else
        g.status = BUFFON_E_SHAPE;
    return g;
}

/* `param`: p, log(1 - p), log p. */

static double geometric_log_at(const buffon_density *g, double k)
{
    return k == 0 ? g->param[2] : g->param[2] + k * g->param[1];
}

static double geometric_pdf_at(const buffon_density *g, double k)
{
    return k == 0 ? g->param[0] : g->param[0] * buffon_priv_exp(k * g->param[1]);
}

/* P(X > k) = (1 - p)^(k + 1) is 1 - u at most from k + 1 = log(1 - u) / log(1 - p) on. */
static int geometric_draw(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const double tries = buffon_priv_log1p(-density_inside(u[i])) / g->param[1];
        const double whole = (double)(int64_t)tries;
        x[i] = whole == tries && tries > 0 ? whole - 1 : whole;
        if (pdf)
            pdf[i] = geometric_pdf_at(g, x[i]);
    }
    return 0;
}

static int geometric_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        pdf[i] = counts_whole(x[i], 0x1p53) ? geometric_pdf_at(g, x[i]) : 0;
    return 0;
}

static int geometric_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = counts_whole(x[i], 0x1p53) ? geometric_log_at(g, x[i]) : -(double)INFINITY;
    return 0;
}

static const buffon_density_ops geometric_ops = {.sample = geometric_draw,
                                                 .pdf = geometric_pdf,
                                                 .log_pdf = geometric_log_pdf,
                                                 .name = "buffon.geometric"};

buffon_density buffon_geometric(double p)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &geometric_ops};
    if (p >= 1e-14 && p <= 1) {
        g.param[0] = p;
        g.param[1] = buffon_priv_log1p(-p);
        g.param[2] = buffon_priv_log(p);
    } else {
        g.status = BUFFON_E_SHAPE;
    }
    return g;
}

/* ---- the Poisson and the binomial law ---- */

/* Poisson: `tries` is infinite, p is 0. The binomial law is taken with p <= 1/2, counting failures
 * where p is more. */
typedef struct counts_law {
    double tries, p, mean, sd, skew, excess;
    int mirrored;
} counts_law;

static counts_law counts_law_make(const buffon_density *g, int binomial)
{
    counts_law law = {.tries = (double)INFINITY, .mean = g->param[0]};
    double q = 1;
    if (binomial) {
        law.tries = g->param[0];
        law.mirrored = g->param[1] > 0.5;
        law.p = law.mirrored ? 1 - g->param[1] : g->param[1];
        law.mean = law.tries * law.p;
        q = 1 - law.p;
    }
    law.sd = sqrt(law.mean * q);
    law.skew = (q - law.p) / law.sd;
    law.excess = (1 - 6 * law.p * q) / (law.mean * q);
    return law;
}

/* x log(x / m) + m - x, `rest` being m - x. A quotient below the normal doubles has lost digits. */
static double counts_deviance(double x, double m, double rest)
{
    const double d = rest / x, ratio = m / x;
    if (!(d < -0.5))
        return x * buffon_priv_deviance(d);
    return x * (d - (ratio < DBL_MIN ? buffon_priv_log(m) - buffon_priv_log(x)
                                     : buffon_priv_log(ratio)));
}

/* log P(X = k): Stirling's formula for the factorials, and the deviance of k. */
static double counts_log_at(const counts_law *law, double k)
{
    const double n = law->tries, left = n - k;
    double rest, deviance;
    if (k == 0)
        return law->p > 0 ? n * buffon_priv_log1p(-law->p) : -law->mean;
    if (left == 0)
        return n * buffon_priv_log(law->p);
    if (!(n <= COUNTS_MOST))
        return -0.5 * buffon_priv_log(k) - COUNTS_LOG_SQRT_2PI - buffon_priv_stirling(k) -
               counts_deviance(k, law->mean, law->mean - k);
    rest = buffon_priv_beta_excess(k, left, law->p);
    deviance = counts_deviance(k, law->mean, rest) + counts_deviance(left, n - law->mean, -rest);
    return -0.5 * buffon_priv_log(k * (left / n)) - COUNTS_LOG_SQRT_2PI +
           (buffon_priv_stirling(n) - buffon_priv_stirling(k) - buffon_priv_stirling(left)) -
           deviance;
}

/* P(X = k + 1) / P(X = k) */
static double counts_ratio(const counts_law *law, double k)
{
    return law->p > 0 ? (law->tries - k) / (k + 1) * (law->p / (1 - law->p)) : law->mean / (k + 1);
}

/* The sum of P(X = k), P(X = k + 1), ... or, downwards, P(X = k), P(X = k - 1), ... of a Poisson
 * law, for k far out on that side. */
static double poisson_sum(const counts_law *law, double k, int upper)
{
    double term = 1, sum = 1;
    for (double j = k; term > 0x1p-56 * sum && j >= 0; j += upper ? 1 : -1) {
        term *= upper ? law->mean / (j + 1) : j / law->mean;
        sum += term;
    }
    return sum * buffon_priv_exp(counts_log_at(law, k));
}

/* P(X <= k), or P(X >= k) if `upper`: P(X >= a) = P(Y <= mean) of a gamma variable Y of shape a. */
static double poisson_tail(const counts_law *law, double k, int upper)
{
    const double a = upper ? k : k + 1, d = (law->mean - a) / a;
    const double size = a >= 10 ? sqrt(2 * buffon_priv_deviance(d)) : 2;
    buffon_priv_bell bell;
    if (size <= 1) {
        buffon_priv_bell_make(&bell, 1, 0, a, -buffon_priv_stirling(a), 1, size);
        return buffon_priv_bell_tail(&bell, d < 0 ? -size : size, !upper);
    }
    if (upper)
        return k > law->mean ? poisson_sum(law, k, 1) : 1 - poisson_sum(law, k - 1, 0);
    return k < law->mean ? poisson_sum(law, k, 0) : 1 - poisson_sum(law, k + 1, 1);
}

/* The same of the binomial law: P(X >= a) = P(Y <= p) of a beta variable Y of a and n - a + 1. */
static double counts_tail(const counts_law *law, double k, int upper)
{
    const double a = upper ? k : k + 1, b = law->tries - (a - 1);
    buffon_priv_beta beta;
    if (a == 0 || b == 0)
        return 1;
    if (!(law->tries <= COUNTS_MOST))
        return poisson_tail(law, k, upper);
    buffon_priv_beta_make(&beta, a, b);
    return buffon_priv_beta_tail(&beta, law->p, !upper);
}

/* Near where k ought to be, for a normal z: E. Cornish, R. Fisher (1938). In far tails of small
 * means the series wanders off; it is kept on its side of the mean. */
static double counts_guess(const counts_law *law, double z)
{
    const double zz = z * z, s = law->skew, m = law->mean;
    const double most = law->tries < 0x1p52 ? law->tries : 0x1p52;
    double x = m + law->sd * (z + s * (zz - 1) / 6 + law->excess * z * (zz - 3) / 24 -
                              s * s * z * (2 * zz - 5) / 36);
    if (z < 0 ? !(x <= m) : !(x >= m))
        x = m;
    return x > 0 ? x < most ? (double)(int64_t)(x + 0.5) : most : 0;
}

/* A walk towards the k where a tail, P(X <= k) or P(X >= k), just reaches `target`. The tail is
 * known to `doubt`. */
typedef struct counts_walk {
    double k, tail, at, doubt; /* at = P(X = k) */
} counts_walk;

static counts_walk counts_start(const counts_law *law, double k, int upper)
{
    counts_walk walk = {.k = k, .tail = counts_tail(law, k, upper)};
    walk.at = buffon_priv_exp(counts_log_at(law, k));
    walk.doubt = COUNTS_DOUBT * walk.tail;
    return walk;
}

/* A step of 1 up or down. Sums of probabilities stand for the tail where there is no doubt on which
 * side of the target it is; else it is computed, so that the same tail decides wherever a walk
 * began, and points keep the order of uniforms. */
static void counts_step(counts_walk *walk, const counts_law *law, double target, int upper, int up)
{
    const double before = walk->at;
    walk->at = up ? before * counts_ratio(law, walk->k) : before / counts_ratio(law, walk->k - 1);
    walk->k += up ? 1 : -1;
    walk->tail += up != upper ? walk->at : -before;
    walk->doubt += COUNTS_DOUBT * walk->at;
    if (!(buffon_priv_abs(walk->tail - target) > walk->doubt))
        *walk = counts_start(law, walk->k, upper);
}

/* What a tail is to reach. The least k with P(X <= k) >= u is that with P(X > k) <= 1 - u: a tail
 * that belongs to u above 1/2 must be more than 1 - u. */
typedef struct counts_target {
    double p;
    int upper, more;
} counts_target;

static int counts_reached(double tail, const counts_target *target)
{
    return target->more ? tail > target->p : tail >= target->p;
}

/* The outermost k whose tail reaches the target, at most 1/2. */
static double counts_find(const counts_law *law, const counts_target *target)
{
    const double z = buffon_priv_normal_quantile(target->p);
    const int upper = target->upper;
    const double end = upper ? law->tries : 0;
    counts_walk walk;
    int in;
    if (law->mean == 0)
        return 0;
    walk = counts_start(law, counts_guess(law, upper ? -z : z), upper);
    in = !counts_reached(walk.tail, target);
    for (int i = 1; in || walk.k != end; i++) {
        const double k = walk.k;
        counts_step(&walk, law, target->p, upper, upper != in);
        if (in == counts_reached(walk.tail, target))
            return in ? walk.k : k;
        if (i % 16 == 0)
            walk = counts_start(law, walk.k, upper);
    }
    return walk.k;
}

/* ---- small means: all tails in a table, for a batch ---- */

enum { COUNTS_TABLE = 512 };

typedef struct counts_table {
    counts_law law;
    int size;                                        /* 0: there is none */
    double lower[COUNTS_TABLE], upper[COUNTS_TABLE]; /* P(X <= k), P(X >= k) */
    double pdf[COUNTS_TABLE];                        /* -1: not computed yet */
} counts_table;

/* Until what follows is less than 2^-70, which tails of 2^-60 do not see. */
static void counts_table_make(counts_table *table, const buffon_density *g, int binomial)
{
    const counts_law law = counts_law_make(g, binomial);
    double at, sum = 0;
    int k = 0;
    table->law = law;
    table->size = 0;
    if (law.mean > COUNTS_FEW)
        return;
    at = buffon_priv_exp(counts_log_at(&law, 0));
    for (k = 0; k < COUNTS_TABLE && k <= law.tries && (k <= law.mean || at > 0x1p-75); k++) {
        sum += at;
        table->lower[k] = sum;
        table->upper[k] = at;
        table->pdf[k] = -1;
        at *= counts_ratio(&law, k);
    }
    table->size = k;
    for (k -= 2; k >= 0; k--)
        table->upper[k] += table->upper[k + 1];
}

/* As counts_find, by halving: the outermost k is one of from ... to. */
static double counts_look(const counts_table *table, const counts_target *target)
{
    int from = 0, to = table->size - 1;
    while (from < to) {
        const int middle = (from + to + target->upper) / 2;
        const double tail = target->upper ? table->upper[middle] : table->lower[middle];
        const int here = counts_reached(tail, target);
        if (target->upper) {
            from = here ? middle : from;
            to = here ? to : middle - 1;
        } else {
            to = here ? middle : to;
            from = here ? from : middle + 1;
        }
    }
    return from;
}

static double counts_point(const counts_table *table, double u)
{
    const int more = u > 0.5;
    const counts_target target = {
        .p = more ? 1 - u : u, .upper = more != table->law.mirrored, .more = more};
    return table->size && (!target.upper || target.p > 0x1p-60) ? counts_look(table, &target)
                                                                : counts_find(&table->law, &target);
}

static double counts_pdf_of(counts_table *table, double k)
{
    if (!(k < table->size))
        return buffon_priv_exp(counts_log_at(&table->law, k));
    if (table->pdf[(int)k] < 0)
        table->pdf[(int)k] = buffon_priv_exp(counts_log_at(&table->law, k));
    return table->pdf[(int)k];
}

static void counts_sample(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g, int binomial)
{
    counts_table table;
    counts_table_make(&table, g, binomial);
    for (size_t i = 0; i < n; i++) {
        const double k = counts_point(&table, density_inside(u[i]));
        x[i] = table.law.mirrored ? table.law.tries - k : k;
        if (pdf)
            pdf[i] = counts_pdf_of(&table, k);
    }
}

static void counts_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g,
                           int binomial)
{
    const counts_law law = counts_law_make(g, binomial);
    const double most = law.tries < 0x1p53 ? law.tries : 0x1p53;
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = counts_whole(x[i], most)
                         ? counts_log_at(&law, law.mirrored ? law.tries - x[i] : x[i])
                         : -(double)INFINITY;
}

static int binomial_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    counts_sample(x, pdf, u, n, g, 1);
    return 0;
}

static int binomial_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    counts_log_pdf(log_pdf, x, n, g, 1);
    return 0;
}

static int binomial_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    counts_log_pdf(pdf, x, n, g, 1);
    buffon_math_exp(pdf, pdf, n);
    return 0;
}

static const buffon_density_ops binomial_ops = {.sample = binomial_draw,
                                                .pdf = binomial_pdf,
                                                .log_pdf = binomial_log_pdf,
                                                .name = "buffon.binomial"};

buffon_density buffon_binomial(uint64_t n, double p)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &binomial_ops};
    if (n <= (uint64_t)COUNTS_MOST && p >= 0 && p <= 1) {
        g.param[0] = (double)n;
        g.param[1] = p;
    } else {
        g.status = BUFFON_E_SHAPE;
    }
    return g;
}

static int poisson_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    counts_sample(x, pdf, u, n, g, 0);
    return 0;
}

static int poisson_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    counts_log_pdf(log_pdf, x, n, g, 0);
    return 0;
}

static int poisson_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    counts_log_pdf(pdf, x, n, g, 0);
    buffon_math_exp(pdf, pdf, n);
    return 0;
}

static const buffon_density_ops poisson_ops = {.sample = poisson_draw,
                                               .pdf = poisson_pdf,
                                               .log_pdf = poisson_log_pdf,
                                               .name = "buffon.poisson"};

buffon_density buffon_poisson(double mean)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &poisson_ops};
    if (mean >= 0 && mean <= 1e15)
        g.param[0] = mean;
    else
        g.status = BUFFON_E_SHAPE;
    return g;
}
