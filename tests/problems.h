/* Problems of every kind, for what must hold of all: any threads, parts and interruptions give the
 * same bits. Their integrands use + - * / and sqrt alone, so their bits are the same on every
 * machine. */
#ifndef TESTS_PROBLEMS_H
#define TESTS_PROBLEMS_H

#include <math.h>
#include <string.h>

#include <buffon/buffon.h>

#if defined(__GNUC__) || defined(__clang__)
#define PROBLEMS_UNUSED __attribute__((unused))
#else
#define PROBLEMS_UNUSED
#endif

#define PROBLEMS_COMPONENTS 3 /* at most */

/* Solves a problem with the options of a run; what makes the problem is added to them. */
typedef struct problem {
    const char *name;
    size_t components;
    double rel_tol; /* that is reached between the first look and 200000 samples */
    buffon_status (*solve)(buffon_estimate *out, buffon_run run);
} problem;

/* ---- integrands ---- */

/* A hill about (0.3, 0.3, ...), between 0 and 1. ctx: the dimension. */
static double problem_hill(const double *x, void *ctx)
{
    double sum = 0;
    for (size_t j = 0; j < *(const size_t *)ctx; j++)
        sum += (x[j] - 0.3) * (x[j] - 0.3);
    return 1 / (1 + 5 * sum);
}

/* Three functions of the first two coordinates. */
static int problem_three(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i];
        f[i] = a * b;
        f[n + i] = 1 / (0.5 + a * a + b);
        f[2 * n + i] = a > 0.25 ? sqrt(a) : 2;
    }
    return 0;
}

/* 1 / x, and infinite for one x in fifty. */
static double problem_pole(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] < 0.02 ? INFINITY : 1 / x[0];
}

/* A weight that is not normalised. */
static double problem_weight(const double *x, void *ctx)
{
    (void)ctx;
    return 7 / (1 + x[0] * x[0] + x[1]);
}

/* ---- a point set of a user: the Kronecker sequence, shifted at random in each replicate ---- */

static size_t problem_kronecker_size(size_t dim, const buffon_points *self)
{
    (void)self;
    return dim * sizeof(uint64_t);
}

static int problem_kronecker_prepare(const buffon_points_block *block, const buffon_points *self)
{
    buffon_rng_key key = block->key;
    (void)self;
    key.purpose = BUFFON_PURPOSE_SHUFFLE;
    buffon_rng_words_at(block->table, block->dim, &key, 0, 0);
    return 0;
}

static int problem_kronecker_fill(double *u, const buffon_points_block *block,
                                  const buffon_points *self)
{
    /* The fractions of g^-1, g^-2, g^-3, g^-4 for the g of Roberts (2018) in four dimensions. */
    static const uint64_t step[] = {UINT64_C(0xdb4ee6d39cf8d1b4), UINT64_C(0xbbe6ccb9bd3a5ed0),
                                    UINT64_C(0xa0fb2a2d9a9e3d15), UINT64_C(0x89e9c0bd4fd6f4a1)};
    const uint64_t *shift = block->table;
    (void)self;
    for (size_t j = 0; j < block->dim; j++) {
        for (size_t i = 0; i < block->n; i++) {
            const uint64_t word = shift[j] + (block->first + i) * step[j % 4];
            u[j * block->n + i] = ((double)(word >> 12) + 0.5) * 0x1p-52;
        }
    }
    return 0;
}

static buffon_points problem_kronecker(void)
{
    return (buffon_points){.fill = problem_kronecker_fill,
                           .table_size = problem_kronecker_size,
                           .prepare = problem_kronecker_prepare,
                           .design = BUFFON_DESIGN_REPLICATES,
                           .replicates = 8,
                           .name = "tests.kronecker"};
}

/* ---- the problems ---- */

static const double problem_lo[] = {0, -1, 0.25, -2}, problem_hi[] = {1, 1.5, 3, -1};

static buffon_status problem_plain(buffon_estimate *out, buffon_run run)
{
    size_t dim = 3;
    const buffon_integrand f = {.scalar = problem_hill, .dim = dim, .ctx = &dim};
    return buffon_uniform(out, &f, problem_lo, problem_hi, &run);
}

static buffon_status problem_components(buffon_estimate *out, buffon_run run)
{
    const double lo[] = {0, 0}, hi[] = {1, 2};
    const buffon_integrand f = {.batch = problem_three, .dim = 2, .components = 3};
    run.covariance = run.partial != NULL;
    return buffon_uniform(out, &f, lo, hi, &run);
}

static buffon_status problem_antithetic(buffon_estimate *out, buffon_run run)
{
    const buffon_points points = buffon_points_antithetic();
    run.points = &points;
    return problem_components(out, run);
}

static buffon_status problem_jitter(buffon_estimate *out, buffon_run run)
{
    const buffon_points points = buffon_points_jitter(5);
    run.points = &points;
    return problem_components(out, run);
}

static buffon_status problem_replicates(buffon_estimate *out, buffon_run run)
{
    const buffon_points points = problem_kronecker();
    run.points = &points;
    return problem_components(out, run);
}

static buffon_status problem_rejection(buffon_estimate *out, buffon_run run)
{
    size_t dim = 2;
    const buffon_integrand f = {.scalar = problem_hill, .dim = dim, .ctx = &dim};
    return buffon_rejection(out, &f, problem_lo, problem_hi, 1.125, &run);
}

static buffon_status problem_cap(buffon_estimate *out, buffon_run run)
{
    const double axis[] = {1, 2, -2};
    const buffon_density g = buffon_cap_about(0.25, axis);
    size_t dim = 3;
    const buffon_integrand f = {.scalar = problem_hill, .dim = dim, .ctx = &dim};
    return buffon_importance(out, &f, &g, &run);
}

/* Two halves of a square and a square beside it, the last with an integrand of its own. */
static buffon_status problem_strata(buffon_estimate *out, buffon_run run, int allocation)
{
    size_t dim = 2;
    const double lo[3][2] = {{0, 0}, {0.5, 0}, {1, 0}}, hi[3][2] = {{0.5, 1}, {1, 1}, {2, 1}};
    const buffon_density box[3] = {buffon_box(lo[0], hi[0], 2), buffon_box(lo[1], hi[1], 2),
                                   buffon_box(lo[2], hi[2], 2)};
    const buffon_integrand f = {.scalar = problem_hill, .dim = 2, .ctx = &dim};
    const buffon_integrand weight = {.scalar = problem_weight, .dim = 2, .components = 1};
    const buffon_stratum list[] = {{.density = &box[0]},
                                   {.density = &box[1], .share = 0.5, .weight = -2},
                                   {.density = &box[2], .f = &weight, .share = 2}};
    const buffon_strata strata = {
        .stratum = list, .count = 3, .allocation = allocation, .pilot = 100};
    return buffon_stratified(out, &f, &strata, &run);
}

static buffon_status problem_stratified(buffon_estimate *out, buffon_run run)
{
    const buffon_points points = buffon_points_jitter(3);
    run.points = &points;
    return problem_strata(out, run, BUFFON_ALLOCATION_SHARE);
}

static buffon_status problem_neyman(buffon_estimate *out, buffon_run run)
{
    return problem_strata(out, run, BUFFON_ALLOCATION_NEYMAN);
}

static buffon_status problem_self_normalised(buffon_estimate *out, buffon_run run)
{
    const double lo[] = {0, 0}, hi[] = {2, 2};
    const buffon_density g = buffon_box(lo, hi, 2);
    const buffon_integrand h = {.batch = problem_three, .dim = 2, .components = 3};
    const buffon_integrand p = {.scalar = problem_weight, .dim = 2};
    const buffon_points points = buffon_points_antithetic();
    run.points = &points;
    run.covariance = run.partial != NULL;
    return buffon_self_normalised(out, &h, &p, &g, &run);
}

static buffon_status problem_expectation(buffon_estimate *out, buffon_run run)
{
    const buffon_density g = buffon_disk(2);
    size_t dim = 2;
    const buffon_integrand h = {.scalar = problem_hill, .dim = dim, .ctx = &dim};
    return buffon_expectation(out, &h, &g, &run);
}

static buffon_status problem_table(buffon_estimate *out, buffon_run run)
{
    static const double x[] = {0.5, 1, 2, 4}, F[] = {1, 4, 6, 7};
    const buffon_inversion how = {.x = x, .F = F, .count = 4};
    const buffon_integrand f = {.scalar = problem_pole, .dim = 1};
    return buffon_inverse_cdf(out, &f, &how, &run);
}

static buffon_status problem_nonfinite(buffon_estimate *out, buffon_run run)
{
    const double lo = 0, hi = 1;
    const buffon_integrand f = {.scalar = problem_pole, .dim = 1};
    run.on_nonfinite = BUFFON_NONFINITE_ZERO;
    return buffon_uniform(out, &f, &lo, &hi, &run);
}

static buffon_status problem_net(buffon_estimate *out, buffon_run run)
{
    const buffon_points points = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    run.points = &points;
    return problem_strata(out, run, BUFFON_ALLOCATION_SHARE);
}

static buffon_status problem_median(buffon_estimate *out, buffon_run run)
{
    const double lo[] = {0, 0}, hi[] = {2, 2};
    const buffon_density g = buffon_box(lo, hi, 2);
    const buffon_integrand h = {.batch = problem_three, .dim = 2, .components = 3};
    const buffon_integrand p = {.scalar = problem_weight, .dim = 2};
    const buffon_points points = buffon_points_sobol_median();
    run.points = &points;
    return buffon_self_normalised(out, &h, &p, &g, &run);
}

PROBLEMS_UNUSED static const problem problems[] = {
    {"uniform", 1, 1e-2, problem_plain},
    {"three components", 3, 2e-2, problem_components},
    {"antithetic pairs", 3, 2e-2, problem_antithetic},
    {"jittered points", 3, 3e-3, problem_jitter},
    {"replicates of a user's points", 3, 2e-3, problem_replicates},
    {"rejection", 1, 2e-2, problem_rejection},
    {"importance on a cap", 1, 6e-3, problem_cap},
    {"strata", 1, 2e-2, problem_stratified},
    {"strata, Neyman", 1, 3e-2, problem_neyman},
    {"self-normalised", 3, 2e-2, problem_self_normalised},
    {"expectation on a disk", 1, 1e-2, problem_expectation},
    {"inverse CDF of a table", 1, 1e-2, problem_table},
    {"values that are not finite", 1, 3e-2, problem_nonfinite},
    {"strata, a net in each", 1, 1e-4, problem_net},
    {"self-normalised, median", 3, 1e-4, problem_median},
};

enum { PROBLEMS = sizeof problems / sizeof problems[0] };

/* ---- comparing ---- */

static inline int same_double(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

/* Are two estimates the same to the last bit, in every field? */
static inline int same_estimate(const buffon_estimate *a, const buffon_estimate *b)
{
    const double x[] = {a->value, a->std_error, a->variance,  a->lo,         a->hi,  a->confidence,
                        a->min,   a->max,       a->max_share, a->tail_index, a->ess, a->acceptance};
    const double y[] = {b->value, b->std_error, b->variance,  b->lo,         b->hi,  b->confidence,
                        b->min,   b->max,       b->max_share, b->tail_index, b->ess, b->acceptance};
    int same = a->samples == b->samples && a->nonfinite == b->nonfinite &&
               a->bad_index == b->bad_index && a->bad_stratum == b->bad_stratum &&
               a->status == b->status && a->doubts == b->doubts && a->interval == b->interval &&
               a->looks == b->looks && memcmp(a->reserved, b->reserved, sizeof a->reserved) == 0;
    for (size_t i = 0; i < sizeof x / sizeof *x; i++)
        same &= same_double(x[i], y[i]);
    return same;
}

static inline int same_estimates(const buffon_estimate *a, const buffon_estimate *b, size_t n)
{
    int same = 1;
    for (size_t k = 0; k < n; k++)
        same &= same_estimate(&a[k], &b[k]);
    return same;
}

/* Does this estimate say that there is none, and why? */
static inline int is_refusal(const buffon_estimate *e, buffon_status status)
{
    return e->status == status && e->value != e->value && e->std_error == INFINITY &&
           e->samples == 0 && e->lo == -INFINITY && e->hi == INFINITY;
}

#endif
