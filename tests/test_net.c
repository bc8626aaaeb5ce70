/* One net of Sobol' points with an error bar from its own blocks: the ranges that its cells are,
 * the formula, coverage, and the same bits whatever the threads, parts, looks and doublings. */
#include <stdlib.h>

#include <buffon/buffon.h>

#include "binomial.h"
#include "integrands.h"
#include "net.h"
#include "problems.h"
#include "record.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

static const double lo[] = {0, 0, 0, 0, 0}, hi[] = {1, 1, 1, 1, 1};

static void must_run(buffon_status status, const char *name)
{
    if (status < 0) {
        printf("Bail out! %s: %s\n", name, buffon_status_string(status));
        exit(1);
    }
}

static double smooth(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0] / (1 + x[1]);
}

static const buffon_integrand smooth_f = {.scalar = smooth, .dim = 2};
static const double smooth_exact = 0.69314718055994530942 / 3;

/* ---- ranges -------------------------------------------------------------------------------- */

/* Ranges follow one another, and every net has eighths of whole ranges. */
static void test_ranges(void)
{
    int gapless = buffon_priv_net_begin(0) == 0, aligned = 1;
    for (size_t r = 0; r < BUFFON_PRIV_NET_RANGES_MOST; r++)
        gapless &=
            buffon_priv_net_begin(r) + buffon_priv_net_size(r) == buffon_priv_net_begin(r + 1);
    for (unsigned m = 6; m <= BUFFON_PRIV_NET_MOST; m++) {
        const size_t ranges = 1 + 4 * (size_t)(m - 3);
        aligned &= buffon_priv_net_begin(ranges) == UINT64_C(1) << m;
        for (size_t b = 0; b <= BUFFON_PRIV_NET_BLOCKS; b++)
            aligned &= buffon_priv_net_begin(buffon_priv_net_eighth(ranges, b)) == (uint64_t)b
                                                                                       << (m - 3);
        aligned &= m > 6 || ranges == BUFFON_PRIV_NET_RANGES;
        aligned &= m < BUFFON_PRIV_NET_MOST || ranges == BUFFON_PRIV_NET_RANGES_MOST;
    }
    tap_ok(gapless, "the ranges of a net have no gap");
    tap_ok(aligned, "the eighths of every net of 2^6 to 2^40 points are whole ranges");
}

/* ---- the formula --------------------------------------------------------------------------- */

/* Mean and error of a net from its points, one by one, with a block of the run that is shorter and
 * one that is longer than most ranges. */
static void test_formula(unsigned m, uint32_t block)
{
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    const buffon_density box = buffon_box(lo, hi, 2);
    const uint64_t n = UINT64_C(1) << m;
    const buffon_run run = {.samples = n, .seed = m, .points = &net, .block = block};
    double mean[8] = {0}, all = 0, square = 0;
    buffon_estimate e;
    for (uint64_t i = 0; i < n; i++) {
        double x[2];
        must_run(buffon_sample_at(x, &box, i, &run), "sample_at");
        mean[i * 8 / n] += 8 * smooth(x, NULL) / (double)n;
    }
    for (size_t b = 0; b < 8; b++)
        all += mean[b] / 8;
    for (size_t b = 0; b < 8; b++)
        square += (mean[b] - all) * (mean[b] - all) / 56;
    const buffon_status status = buffon_uniform(&e, &smooth_f, lo, hi, &run);
    const double half = -buffon_student_upper(0.975, 7) * sqrt(square);
    tap_ok(status == BUFFON_OK && e.samples == n && fabs(e.value - all) < 1e-14 &&
               fabs(e.std_error / sqrt(square) - 1) < 1e-9 &&
               e.interval == BUFFON_INTERVAL_STUDENT &&
               fabs((e.hi - e.value) / fabs(half) - 1) < 1e-9,
           "2^%u points: value %.9f, error %.3g from its eighths", m, e.value, e.std_error);
}

/* ---- coverage ------------------------------------------------------------------------------ */

enum { GENZ_DIM = 5, GENZ = 7 };

static const struct {
    const char *name;
    double (*f)(const double *x, size_t dim);
    size_t dim;
    double exact;
} genz[GENZ] = {{"oscillatory", genz_oscillatory, 5, 0.56673906320480859508},
                {"product peak", genz_product_peak, 5, 3901.7486263338889417},
                {"corner peak", genz_corner_peak, 5, 0.019907420523996069575},
                {"Gaussian", genz_gaussian, 5, 0.028306726720449704941},
                {"C0", genz_c0, 5, 0.018404913546477759913},
                {"discontinuous", genz_discontinuous, 2, 5.7875210945361465302},
                {"discontinuous, d = 5", genz_discontinuous, 5, 1642.2577991699242359}};

static int genz_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        double point[GENZ_DIM];
        for (size_t j = 0; j < GENZ_DIM; j++)
            point[j] = x[j * n + i];
        for (size_t k = 0; k < GENZ; k++)
            f[k * n + i] = genz[k].f(point, genz[k].dim);
    }
    return 0;
}

/* Blocks of one net are not independent, so there is no law to hold the intervals to: what was
 * measured is that they are too wide, seldom too narrow, and by how much. */
static void test_coverage(void)
{
    enum { SEEDS = 600, POINTS = 512 };
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    const buffon_integrand f = {.batch = genz_batch, .dim = GENZ_DIM, .components = GENZ};
    uint64_t covered[GENZ] = {0};
    double sum[GENZ] = {0}, sum2[GENZ] = {0}, se2[GENZ] = {0};
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_estimate e[GENZ];
        const buffon_run run = {.samples = POINTS, .seed = seed, .points = &net};
        must_run(buffon_uniform(e, &f, lo, hi, &run), "coverage");
        for (size_t k = 0; k < GENZ; k++) {
            const double d = e[k].value - genz[k].exact;
            covered[k] += e[k].lo <= genz[k].exact && genz[k].exact <= e[k].hi;
            sum[k] += d;
            sum2[k] += d * d;
            se2[k] += e[k].std_error * e[k].std_error;
        }
    }
    for (size_t k = 0; k < GENZ; k++) {
        const double share = (double)covered[k] / SEEDS, ratio = sqrt(se2[k] / sum2[k]);
        tap_ok(share > 0.975, "%s: intervals of 95 %% cover %.2f %%", genz[k].name, 100 * share);
        tap_ok(ratio > 1.5 && ratio < 10, "%s: the standard error is %.1f times the error",
               genz[k].name, ratio);
        tap_ok(fabs(sum[k]) < BINOMIAL_SIGMAS * sqrt(sum2[k]), "%s: unbiased (%.2f sigma)",
               genz[k].name, sum[k] / sqrt(sum2[k]));
    }
}

/* Runs that stop at a tolerance: each look has the error of its own net. */
static void test_stopping(void)
{
    enum { SEEDS = 200 };
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    size_t missed = 0, early = 0, covered = 0, unlike = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_estimate e, whole;
        buffon_run run = {.samples = 1 << 17, .seed = seed, .points = &net, .abs_tol = 6e-6};
        must_run(buffon_uniform(&e, &smooth_f, lo, hi, &run), "stopping");
        covered += e.lo <= smooth_exact && smooth_exact <= e.hi;
        missed += e.status != BUFFON_OK || !((e.hi - e.lo) / 2 <= 6e-6) || e.looks != 5;
        early += e.samples == 1 << 13 || e.samples == 1 << 14 || e.samples == 1 << 15;
        run.abs_tol = 0;
        run.samples = e.samples;
        must_run(buffon_uniform(&whole, &smooth_f, lo, hi, &run), "as many at once");
        unlike += !same_double(e.value, whole.value) || !same_double(e.std_error, whole.std_error);
    }
    tap_ok(missed == 0 && early == SEEDS, "%zu of %d runs stop early, with the tolerance met",
           early, SEEDS);
    tap_ok(covered == SEEDS, "and cover: %zu", covered);
    tap_ok(unlike == 0, "with the bits of a run of that size");
}

/* ---- numbers of points, and what is refused -------------------------------------------------- */

static uint64_t round_to(size_t dim, const buffon_points *self)
{
    (void)dim;
    return (uint64_t)(uintptr_t)self->ctx;
}

static void test_samples(void)
{
    static const uint64_t asked[] = {1, 64, 65, 1000, 4097}, wanted[] = {64, 64, 128, 1024, 8192};
    buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    uint64_t round = 256;
    buffon_run run = {.points = &net};
    buffon_estimate e;
    for (size_t k = 0; k < COUNT(asked); k++) {
        run.samples = asked[k];
        tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_OK && e.samples == wanted[k],
               "%llu samples asked for: %llu", (unsigned long long)asked[k],
               (unsigned long long)wanted[k]);
    }
    run.samples = (UINT64_C(1) << 40) + 1;
    tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_E_SAMPLES &&
               is_refusal(&e, BUFFON_E_SAMPLES),
           "no net of more than 2^40 points");
    run.samples = 100;
    net.limit = 127;
    tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_E_SAMPLES, "nor beyond the limit");
    net.limit = 128;
    tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_OK && e.samples == 128,
           "up to it");
    net.round = round_to;
    net.limit = net.doubling = 0;
    net.ctx = (void *)(uintptr_t)round;
    tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_OK && e.samples == 256,
           "the point set may round further");
    net.ctx = (void *)(uintptr_t)192;
    tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_E_POINTS, "but to a power of two");
    net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    net.replicates = 2;
    tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_E_POINTS, "two nets are refused");
    net = buffon_points_sobol_net(BUFFON_SCRAMBLE_NONE);
    tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_W_NO_ERROR && isnan(e.std_error),
           "without a scramble there is no error");
    net = buffon_points_sobol_net((buffon_scramble)4);
    tap_ok(buffon_uniform(&e, &smooth_f, lo, hi, &run) == BUFFON_E_POINTS, "no such scramble");
}

/* The net has the points of a single replicate. */
static void test_value(void)
{
    buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_LINEAR);
    buffon_points one = buffon_points_sobol(BUFFON_SCRAMBLE_LINEAR);
    buffon_estimate a, b;
    one.replicates = 1;
    must_run(buffon_uniform(&a, &smooth_f, lo, hi, &(buffon_run){.samples = 4096, .points = &net}),
             "net");
    must_run(buffon_uniform(&b, &smooth_f, lo, hi, &(buffon_run){.samples = 4096, .points = &one}),
             "one replicate");
    tap_ok(fabs(a.value - b.value) < 1e-15 && a.std_error > 0 && b.std_error == INFINITY &&
               a.min == b.min && a.max == b.max && a.tail_index == b.tail_index,
           "the value of one replicate, with an error");
}

/* ---- every estimator, and doubling ---------------------------------------------------------- */

static buffon_status net_strata(buffon_estimate *out, buffon_run run)
{
    return problem_strata(out, run, BUFFON_ALLOCATION_SHARE);
}

static buffon_status net_self_normalised(buffon_estimate *out, buffon_run run)
{
    const buffon_density g = buffon_box(lo, hi, 2);
    const buffon_integrand h = {.batch = problem_three, .dim = 2, .components = 3};
    const buffon_integrand p = {.scalar = problem_weight, .dim = 2};
    return buffon_self_normalised(out, &h, &p, &g, &run);
}

static const problem solved[] = {{"uniform", 1, 0, problem_plain},
                                 {"three components", 3, 0, problem_components},
                                 {"rejection", 1, 0, problem_rejection},
                                 {"importance on a cap", 1, 0, problem_cap},
                                 {"strata", 1, 0, net_strata},
                                 {"strata, Neyman", 1, 0, problem_neyman},
                                 {"self-normalised", 3, 0, net_self_normalised},
                                 {"inverse CDF of a table", 1, 0, problem_table}};

/* Against replicates of the strict mode. */
static void test_agrees(const problem *p)
{
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    const buffon_points strict = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    buffon_estimate a[PROBLEMS_COMPONENTS], b[PROBLEMS_COMPONENTS];
    double worst = 0;
    must_run(p->solve(a, (buffon_run){.samples = 1 << 13, .seed = 2, .points = &net}), p->name);
    must_run(p->solve(b, (buffon_run){.samples = 1 << 13, .seed = 1, .points = &strict}), p->name);
    for (size_t k = 0; k < p->components; k++) {
        const double z = fabs(a[k].value - b[k].value) / hypot(a[k].std_error, b[k].std_error);
        worst = z > worst ? z : worst;
    }
    tap_ok(worst < 4, "%s: agrees with replicates (%.2f sigma)", p->name, worst);
}

/* Is a partial sound enough to be saved and loaded? */
static int travels(const buffon_partial *partial)
{
    buffon_partial loaded = {{0}, NULL};
    const size_t size = buffon_partial_size(partial);
    unsigned char *bytes = malloc(size);
    const int good = bytes != NULL && buffon_partial_save(bytes, size, partial) == BUFFON_OK &&
                     buffon_partial_load(&loaded, bytes, size) == BUFFON_OK;
    buffon_partial_free(&loaded);
    free(bytes);
    return good;
}

static void solve_part(buffon_partial *all, const problem *p, buffon_run run, uint32_t part)
{
    buffon_estimate e[PROBLEMS_COMPONENTS];
    buffon_partial one = {{0}, NULL};
    run.part = part;
    run.parts = 3;
    run.partial = &one;
    must_run(p->solve(e, run), p->name);
    must_run(buffon_partial_merge(all, &one), p->name);
    buffon_partial_free(&one);
}

/* Two of three parts of a net of 2^10, then all of 2^12, then less; parts that go on as parts. */
static void test_doubling(const problem *p)
{
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    buffon_estimate once[PROBLEMS_COMPONENTS], e[PROBLEMS_COMPONENTS];
    buffon_run run = {.samples = 1 << 12, .seed = 5, .points = &net, .block = 32};
    buffon_partial all = {{0}, NULL}, part = {{0}, NULL};
    size_t wrong = 0, sizes[2];
    must_run(p->solve(once, run), p->name);
    run.samples = 1 << 10;
    solve_part(&all, p, run, 2);
    solve_part(&all, p, run, 0);
    const buffon_status status = buffon_partial_estimate(e, &all, 0);
    wrong += status != BUFFON_W_INCOMPLETE || !(e[0].std_error > 0 && e[0].std_error < INFINITY);
    sizes[0] = buffon_partial_size(&all);
    run.samples = 1 << 12;
    run.partial = &all;
    must_run(p->solve(e, run), p->name);
    wrong += !same_estimates(once, e, p->components);
    sizes[1] = buffon_partial_size(&all);
    run.samples = 1 << 8;
    must_run(p->solve(e, run), p->name);
    wrong += !same_estimates(once, e, p->components) || !travels(&all);
    run.samples = 1 << 9; /* a part that goes on as a part */
    run.parts = 3;
    run.part = 1;
    run.partial = &part;
    must_run(p->solve(e, run), p->name);
    run.samples = 1 << 12;
    must_run(p->solve(e, run), p->name);
    run.partial = NULL;
    solve_part(&part, p, run, 0);
    solve_part(&part, p, run, 2);
    must_run(buffon_partial_estimate(e, &part, 0), p->name);
    wrong += !same_estimates(once, e, p->components);
    tap_ok(wrong == 0, "%s: parts and whole runs that double have the bits of one go", p->name);
    tap_ok(sizes[0] < sizes[1], "%s: partials of %zu and %zu bytes", p->name, sizes[0], sizes[1]);
    buffon_partial_free(&all);
    buffon_partial_free(&part);
}

static double counting(const double *x, void *ctx)
{
    ++*(size_t *)ctx;
    return smooth(x, NULL);
}

/* From 2^m to 2^(m+1) points only the new ones are evaluated. */
static void test_reuse(void)
{
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    size_t calls = 0;
    const buffon_integrand f = {.scalar = counting, .dim = 2, .ctx = &calls};
    buffon_partial partial = {{0}, NULL};
    buffon_run run = {.points = &net, .partial = &partial};
    buffon_estimate e, once;
    int same = 1;
    for (run.samples = 64; run.samples <= 1 << 14; run.samples *= 2) {
        must_run(buffon_uniform(&e, &f, lo, hi, &run), "doubling");
        same &= calls == run.samples;
        must_run(buffon_uniform(&once, &smooth_f, lo, hi,
                                &(buffon_run){.samples = run.samples, .points = &net}),
                 "at once");
        same &= same_estimate(&e, &once);
    }
    tap_ok(same, "every doubling from 2^6 to 2^14 evaluates only the new points; the same bits");
    buffon_partial_free(&partial);
}

/* ---- what is not whole ---------------------------------------------------------------------- */

static int cancel(const buffon_progress *progress, void *ctx)
{
    (void)progress;
    (void)ctx;
    return 1;
}

/* A run that is cancelled in its first round has an estimate of the ranges begun, and goes on. */
static void test_cancelled(void)
{
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    buffon_partial partial = {{0}, NULL};
    buffon_estimate e, once;
    buffon_run run = {
        .samples = 1 << 12, .points = &net, .block = 16, .partial = &partial, .progress = cancel};
    must_run(buffon_uniform(&once, &smooth_f, lo, hi,
                            &(buffon_run){.samples = 1 << 12, .points = &net, .block = 16}),
             "at once");
    const buffon_status status = buffon_uniform(&e, &smooth_f, lo, hi, &run);
    tap_ok(status == BUFFON_W_CANCELLED && e.samples >= 8 && e.samples < 1 << 12 &&
               (e.doubts & BUFFON_DOUBT(BUFFON_W_INCOMPLETE)) != 0,
           "cancelled after %llu points, with reservations", (unsigned long long)e.samples);
    run.progress = NULL;
    run.samples = 64;
    const buffon_status whole = buffon_uniform(&e, &smooth_f, lo, hi, &run);
    tap_ok(whole == BUFFON_OK && e.samples == 64, "and made whole again as the least net (%llu)",
           (unsigned long long)e.samples);
    run.samples = 1 << 12;
    must_run(buffon_uniform(&e, &smooth_f, lo, hi, &run), "to the end");
    tap_ok(same_estimate(&e, &once), "and to the end, with the same bits");
    buffon_partial_free(&partial);
}

/* The third of three parts is missing: unbiased, and the interval is not too short. */
static void test_incomplete(void)
{
    enum { SEEDS = 300 };
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    size_t covered = 0;
    double sum = 0, sum2 = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_partial all = {{0}, NULL};
        buffon_estimate e;
        for (uint32_t part = 0; part < 2; part++) {
            buffon_partial one = {{0}, NULL};
            const buffon_run run = {.samples = 1024,
                                    .seed = seed,
                                    .points = &net,
                                    .block = 16,
                                    .part = part,
                                    .parts = 3,
                                    .partial = &one};
            must_run(buffon_uniform(&e, &smooth_f, lo, hi, &run), "part");
            must_run(buffon_partial_merge(&all, &one), "merge");
            buffon_partial_free(&one);
        }
        must_run(buffon_partial_estimate(&e, &all, 0), "estimate");
        covered += e.lo <= smooth_exact && smooth_exact <= e.hi && e.status == BUFFON_W_INCOMPLETE;
        sum += e.value - smooth_exact;
        sum2 += (e.value - smooth_exact) * (e.value - smooth_exact);
        buffon_partial_free(&all);
    }
    binomial_ok(covered, SEEDS, 0.95, 1, "two of three parts cover");
    tap_ok(fabs(sum) < BINOMIAL_SIGMAS * sqrt(sum2), "unbiased");
}

static double failing(const double *x, void *ctx)
{
    const double *bad = ctx;
    return x[0] == bad[0] && x[1] == bad[1] ? NAN : smooth(x, NULL);
}

/* bad_index names the point, wherever its range is. */
static void test_bad_index(void)
{
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    const buffon_density box = buffon_box(lo, hi, 2);
    static const uint64_t indices[] = {0, 7, 8, 63, 300, 1000, 4095};
    int good = 1;
    for (size_t k = 0; k < COUNT(indices); k++) {
        double bad[2];
        const buffon_run run = {.samples = 4096, .seed = 3, .points = &net, .block = 128};
        const buffon_integrand f = {.scalar = failing, .dim = 2, .ctx = bad};
        buffon_estimate e;
        must_run(buffon_sample_at(bad, &box, indices[k], &run), "sample_at");
        good &=
            buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_E_NONFINITE && e.bad_index == indices[k];
    }
    tap_ok(good, "bad_index names the point of a net");
}

/* ---- a net of a user's ---------------------------------------------------------------------- */

static int own_prepare(const buffon_points_block *block, const buffon_points *self)
{
    ++*(size_t *)self->ctx;
    *(uint64_t *)block->table = block->key.stratum;
    return 0;
}

static size_t own_size(size_t dim, const buffon_points *self)
{
    (void)dim;
    (void)self;
    return sizeof(uint64_t);
}

/* Random points; the key of a stratum is one, and so is its table. */
static int own_fill(double *u, const buffon_points_block *block, const buffon_points *self)
{
    (void)self;
    for (size_t j = 0; j < block->dim; j++)
        buffon_rng_uniforms_at(u + j * block->n, block->n, &block->key, (uint32_t)j, block->first);
    return block->key.replicate != 0 || *(const uint64_t *)block->table != block->key.stratum;
}

static void test_own(void)
{
    size_t prepared = 0;
    const buffon_points net = {.fill = own_fill,
                               .table_size = own_size,
                               .prepare = own_prepare,
                               .design = BUFFON_DESIGN_NET,
                               .ctx = &prepared};
    buffon_estimate a, b;
    const buffon_run run = {.samples = 1000, .points = &net};
    must_run(buffon_uniform(&a, &smooth_f, lo, hi, &run), "own");
    must_run(buffon_uniform(&b, &smooth_f, lo, hi, &(buffon_run){.samples = 1024}), "random");
    tap_ok(prepared == 1 && a.samples == 1024 && fabs(a.value - b.value) < 1e-15,
           "a user's net: one table, and the points in order");
    prepared = 0;
    must_run(net_strata(&a, run), "strata");
    tap_ok(prepared == 3, "one table for each stratum");
}

int main(void)
{
    test_ranges();
    for (unsigned m = 6; m <= 12; m++) {
        test_formula(m, 16);
        test_formula(m, 0);
    }
    test_coverage();
    test_stopping();
    test_samples();
    test_value();
    for (size_t k = 0; k < COUNT(solved); k++) {
        test_agrees(&solved[k]);
        test_doubling(&solved[k]);
    }
    test_reuse();
    test_cancelled();
    test_incomplete();
    test_bad_index();
    test_own();
    return tap_done();
}
