/* Runs repeated over thousands of seeds, on problems whose value and whose variance are known: do
 * the intervals cover as stated, and have the values and their standard errors the right law?
 */
#ifndef TESTS_REPEATS_H
#define TESTS_REPEATS_H

#include "binomial.h"

#include <buffon/estimate.h>
#include <buffon/interval.h>
#include <buffon/partial.h>
#include <buffon/run.h>

enum { REPEATS_LEVELS = 3, REPEATS_MOST = 3 };

static const double repeats_level[REPEATS_LEVELS] = {0.6827, 0.95, 0.997};

typedef buffon_status repeats_run(buffon_estimate *out, const buffon_run *run);

/* A run to repeat, and what is known of its components. */
typedef struct repeats_trial {
    const char *name;
    repeats_run *run;
    uint64_t stream, samples;
    const buffon_points *points;
    size_t components;
    double exact[REPEATS_MOST];    /* the value */
    double variance[REPEATS_MOST]; /* of the estimate */
    double bias[REPEATS_MOST];     /* of the estimate */
    double slack; /* the relative error that the mean of std_error^2 may have, beside chance */
    /* How often the interval of a value that should be `exact` covers it; NULL: as stated. */
    double (*coverage)(uint64_t samples, double exact, double confidence);
} repeats_trial;

/* What the repeats of a component were like. */
typedef struct repeats_sums {
    uint64_t n, covered[REPEATS_LEVELS];
    double sum, sum2, sum4; /* powers of value - exact - bias */
    double se2, se4;        /* powers of std_error */
} repeats_sums;

LAW_UNUSED static void repeats_add(repeats_sums *r, const buffon_estimate *e, double expected)
{
    const double d = e->value - expected, d2 = d * d, se2 = e->std_error * e->std_error;
    r->n++;
    r->sum += d;
    r->sum2 += d2;
    r->sum4 += d2 * d2;
    r->se2 += se2;
    r->se4 += se2 * se2;
}

LAW_UNUSED static void repeats_coverage(const repeats_sums *r, const repeats_trial *t, size_t k)
{
    for (size_t l = 0; l < REPEATS_LEVELS; l++) {
        double expected = repeats_level[l];
        char what[100];
        if (t->coverage != NULL)
            expected = t->coverage(t->samples, t->exact[k], repeats_level[l]);
        snprintf(what, sizeof what, "%s [%zu] covers at %.4f", t->name, k, repeats_level[l]);
        binomial_ok(r->covered[l], r->n, expected, 0, what);
    }
}

/* The values have the mean and the variance that they should have, and std_error^2 has that
 * variance for its mean. How far chance may take the last two is estimated from the sample. */
LAW_UNUSED static void repeats_moments(const repeats_sums *r, const repeats_trial *t, size_t k)
{
    const double n = (double)r->n, variance = t->variance[k];
    const double mean = r->sum / n, spread = r->sum2 / n, squares = r->se2 / n;
    const double spread_error = sqrt((r->sum4 / n - spread * spread) / n);
    const double squares_error = sqrt((r->se4 / n - squares * squares) / n);
    tap_ok(fabs(mean) < BINOMIAL_SIGMAS * sqrt(variance / n),
           "%s [%zu]: the mean is %.2f sigma off", t->name, k, mean / sqrt(variance / n));
    tap_ok(fabs(spread - variance) < BINOMIAL_SIGMAS * spread_error,
           "%s [%zu]: the variance is %.4f of the exact one", t->name, k, spread / variance);
    tap_ok(fabs(squares - variance) < BINOMIAL_SIGMAS * squares_error + t->slack * variance,
           "%s [%zu]: the mean std_error^2 is %.4f of the exact one", t->name, k,
           squares / variance);
}

/* Three levels are read off each run, the second and third from its partial result. */
LAW_UNUSED static void repeats_check(const repeats_trial *t, uint64_t seeds)
{
    repeats_sums r[REPEATS_MOST] = {{.n = 0}};
    uint64_t failed = 0;
    for (uint64_t seed = 0; seed < seeds; seed++) {
        buffon_partial partial = {{0}, NULL};
        buffon_estimate e[REPEATS_MOST];
        const buffon_run run = {.samples = t->samples,
                                .seed = seed,
                                .stream = t->stream,
                                .confidence = repeats_level[0],
                                .points = t->points,
                                .partial = &partial};
        buffon_status status = t->run(e, &run);
        for (size_t k = 0; k < t->components; k++)
            repeats_add(&r[k], &e[k], t->exact[k] + t->bias[k]);
        for (size_t l = 0; l < REPEATS_LEVELS; l++) {
            if (l > 0 && status >= 0)
                status = buffon_partial_estimate(e, &partial, repeats_level[l]);
            failed += status < 0;
            for (size_t k = 0; k < t->components; k++)
                r[k].covered[l] += e[k].lo <= t->exact[k] && t->exact[k] <= e[k].hi;
        }
        buffon_partial_free(&partial);
    }
    tap_ok(failed == 0, "%s: no run failed", t->name);
    for (size_t k = 0; k < t->components; k++) {
        repeats_coverage(&r[k], t, k);
        repeats_moments(&r[k], t, k);
    }
}

#endif
