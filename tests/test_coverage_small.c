/* Coverage where the data are normal: Student's t is then exact however few they are, so that each
 * degree of freedom shows. */
#include "repeats.h"

#include <buffon/buffon.h>

enum { SEEDS = 8192 };

static const double unit_lo[] = {0, 0}, unit_hi[] = {1, 1};

static double normal_scalar(const double *x, void *ctx)
{
    (void)ctx;
    return buffon_normal_quantile(x[0]);
}

static buffon_status normal_uniform(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.scalar = normal_scalar, .dim = 1};
    return buffon_uniform(out, &f, unit_lo, unit_hi, run);
}

/* Even in x[0], odd in x[1]: a value has the variance 10, the mean of an antithetic pair 1. */
static double even_scalar(const double *x, void *ctx)
{
    (void)ctx;
    return buffon_normal_quantile(fabs(2 * x[0] - 1)) + 3 * buffon_normal_quantile(x[1]);
}

static buffon_status even_uniform(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.scalar = even_scalar, .dim = 2};
    return buffon_uniform(out, &f, unit_lo, unit_hi, run);
}

/* Normal in each of eight cells, or four times over in each of two. */
static double cells_scalar(const double *x, void *ctx)
{
    (void)ctx;
    return buffon_normal_quantile(8 * x[0] - floor(8 * x[0]));
}

static buffon_status cells_uniform(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.scalar = cells_scalar, .dim = 1};
    return buffon_uniform(out, &f, unit_lo, unit_hi, run);
}

/* Two strata, the first with a deviation of `*ctx`. */
static double steep_scalar(const double *x, void *ctx)
{
    const double *deviation = ctx;
    return x[0] < 1 ? *deviation * buffon_normal_quantile(x[0]) : buffon_normal_quantile(x[0] - 1);
}

static buffon_status steep_stratified(buffon_estimate *out, double deviation, double share,
                                      const buffon_run *run)
{
    const buffon_integrand f = {.scalar = steep_scalar, .dim = 1, .ctx = &deviation};
    const buffon_density left = buffon_segment(0, 1), right = buffon_segment(1, 2);
    const buffon_stratum stratum[] = {{.density = &left, .share = share},
                                      {.density = &right, .share = 16 - share}};
    const buffon_strata strata = {.stratum = stratum, .count = 2};
    return buffon_stratified(out, &f, &strata, run);
}

static buffon_status steep_left(buffon_estimate *out, const buffon_run *run)
{
    return steep_stratified(out, 64, 3, run);
}

static buffon_status steep_even(buffon_estimate *out, const buffon_run *run)
{
    return steep_stratified(out, 1, 8, run);
}

static void check_normal(const char *name, repeats_run *run, uint64_t samples,
                         const buffon_points *points, double variance)
{
    static uint64_t stream;
    const repeats_trial t = {.name = name,
                             .stream = ++stream,
                             .run = run,
                             .samples = samples,
                             .points = points,
                             .components = 1,
                             .variance = {variance}};
    repeats_check(&t, SEEDS);
}

static void check_small(void)
{
    const buffon_points mirrored = buffon_points_antithetic();
    const buffon_points eight = buffon_points_jitter(8), two = buffon_points_jitter(2);
    buffon_points replicates = buffon_points_random();
    replicates.design = BUFFON_DESIGN_REPLICATES;
    replicates.replicates = 8;
    check_normal("16 normals", normal_uniform, 16, NULL, 1.0 / 16);
    check_normal("3 normals", normal_uniform, 3, NULL, 1.0 / 3);
    check_normal("8 normal pairs", even_uniform, 16, &mirrored, 1.0 / 8);
    check_normal("3 normal pairs", even_uniform, 6, &mirrored, 1.0 / 3);
    check_normal("8 normal cells", cells_uniform, 16, &eight, 1.0 / 16);
    check_normal("2 normal cells", cells_uniform, 4, &two, 1.0 / 4);
    check_normal("8 normal replicates", normal_uniform, 16, &replicates, 1.0 / 16);
    replicates.replicates = 3;
    check_normal("3 normal replicates", normal_uniform, 12, &replicates, 1.0 / 12);
    check_normal("2 normal strata, one steep", steep_left, 16, NULL, 4096.0 / 3 + 1.0 / 13);
    check_normal("2 normal strata, alike", steep_even, 16, NULL, 2.0 / 8);
}

/* Numbers of the caller's own. */
static void check_stats(const char *name, uint64_t n)
{
    const repeats_trial t = {.name = name, .variance = {1 / (double)n}};
    repeats_sums r = {.n = 0};
    buffon_rng rng = buffon_rng_make(1, n);
    uint64_t failed = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_stats s = {0};
        buffon_estimate e;
        for (uint64_t i = 0; i < n; i++) {
            const double y = buffon_normal_quantile(buffon_rng_next(&rng));
            buffon_stats_add(&s, &y, 1);
        }
        for (size_t l = 0; l < REPEATS_LEVELS; l++) {
            failed += buffon_stats_estimate(&e, &s, repeats_level[l]) < 0;
            r.covered[l] += e.lo <= 0 && 0 <= e.hi;
        }
        repeats_add(&r, &e, 0);
    }
    tap_ok(failed == 0, "%s: no estimate failed", name);
    repeats_coverage(&r, &t, 0);
    repeats_moments(&r, &t, 0);
}

int main(void)
{
    check_small();
    check_stats("stats of 16 normals", 16);
    check_stats("stats of 2 normals", 2);
    return tap_done();
}
