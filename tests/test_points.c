/* Point sets: the same points whichever way they are asked for, their laws, their errors, and a set
 * of a user's own. */
#include <stdlib.h>

#include "law.h"
#include "problems.h"

#define MOST 4096

static const buffon_rng_key main_key = {.seed = 5, .stream = 6};

/* Points first .. first + n - 1 into u[dim * n]. */
static int fill(double *u, const buffon_points *points, size_t dim, uint64_t first, size_t n,
                const buffon_rng_key *key)
{
    buffon_points_block block = {.key = *key, .first = first, .n = n, .dim = dim};
    uint64_t table[16];
    block.table = table;
    if (points->prepare != NULL && points->prepare(&block, points) != 0)
        return -1;
    return points->fill(u, &block, points);
}

/* ---- any stretch ---- */

static void test_stretches(const char *name, const buffon_points *points, size_t dim)
{
    static double whole[3 * MOST], part[3 * MOST];
    buffon_rng rng = buffon_rng_make(1, 0);
    int same = 1, inside = 1;
    /* Far out too, where indices need all their bits. */
    static const uint64_t starts[] = {0, 1, UINT64_C(1) << 32, (UINT64_C(1) << 61) + 7};
    for (size_t s = 0; s < 4; s++) {
        const uint64_t start = points->limit > 0 ? s : starts[s];
        const size_t n = points->limit > 0 ? (size_t)(points->limit - s) : MOST;
        if (fill(whole, points, dim, start, n, &main_key) != 0)
            exit(1);
        for (size_t i = 0; i < dim * n; i++)
            inside &= whole[i] > 0 && whole[i] < 1;
        for (int t = 0; t < 60; t++) {
            const size_t first = (size_t)buffon_rng_below(&rng, n);
            size_t length = (size_t)buffon_rng_below(&rng, n - first + 1);
            length = t % 2 ? length : length % 20;
            same &= fill(part, points, dim, start + first, length, &main_key) == 0;
            for (size_t j = 0; j < dim; j++)
                same &=
                    memcmp(part + j * length, whole + j * n + first, length * sizeof *part) == 0;
        }
    }
    tap_ok(same, "%s, dim %zu: any stretch has the same points", name, dim);
    tap_ok(inside, "%s, dim %zu: all lie in (0, 1)", name, dim);
}

/* ---- random and antithetic ---- */

static void test_antithetic(void)
{
    static double u[3 * MOST], plain[3 * MOST];
    const buffon_points pairs = buffon_points_antithetic(), random = buffon_points_random();
    int mirrored = 1, fresh = 1;
    fill(u, &pairs, 3, 0, MOST, &main_key);
    fill(plain, &random, 3, 0, MOST, &main_key);
    for (size_t j = 0; j < 3; j++) {
        for (size_t i = 0; i < MOST; i += 2) {
            mirrored &= u[j * MOST + i + 1] == 1 - u[j * MOST + i];
            mirrored &= u[j * MOST + i] == 1 - u[j * MOST + i + 1];
            fresh &= u[j * MOST + i] == plain[j * MOST + i / 2];
        }
    }
    tap_ok(mirrored, "antithetic: the second point of a pair is 1 - the first, exactly");
    tap_ok(fresh, "antithetic: pair p is random point p and its mirror image");
    tap_ok(pairs.design == BUFFON_DESIGN_ANTITHETIC && pairs.round(7, &pairs) == 2,
           "antithetic: points come in twos");
}

static double linear(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] - 2 * x[1];
}

static double even(const double *x, void *ctx)
{
    (void)ctx;
    return fabs(x[0] - 0.5);
}

static double square(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0];
}

static void test_antithetic_error(void)
{
    const double lo[] = {0, 0}, hi[] = {1, 1};
    const buffon_points pairs = buffon_points_antithetic();
    const buffon_integrand odd = {.scalar = linear, .dim = 2}, worst = {.scalar = even, .dim = 1};
    const buffon_run run = {.samples = 10001, .points = &pairs};
    buffon_estimate e;
    tap_ok(buffon_uniform(&e, &odd, lo, hi, &run) >= 0 && e.samples == 10002 &&
               fabs(e.value + 0.5) < 1e-15 && e.std_error < 1e-17,
           "antithetic: linear integrands exactly");
    tap_ok(buffon_uniform(&e, &worst, lo, hi, &run) == BUFFON_OK &&
               fabs(e.std_error * e.std_error * 10002 / (2 * e.variance) - 1) < 0.05,
           "antithetic: even integrands at twice the variance, and the error says so");
}

/* ---- jitter ---- */

static size_t cell_of(const double *u, size_t n, size_t i, size_t dim, size_t k)
{
    size_t cell = 0;
    for (size_t j = dim; j-- > 0;)
        cell = cell * k + (size_t)(u[j * n + i] * (double)k);
    return cell;
}

/* In each sweep every cell has one pair; the order changes from sweep to sweep and key to key. */
static void test_jitter(size_t k, size_t dim)
{
    static double u[3 * MOST];
    size_t cells = 1, order[2][MOST / 2];
    int full = 1, unlike = 1;
    for (size_t j = 0; j < dim; j++)
        cells *= k;
    const buffon_points points = buffon_points_jitter(k);
    for (uint64_t sweep = 0; sweep < 20; sweep++) {
        unsigned char seen[MOST / 2] = {0};
        size_t *now = order[sweep % 2];
        buffon_rng_key key = main_key;
        if (sweep >= 10)
            key.replicate = (uint8_t)sweep; /* the same sweep of other replicates */
        fill(u, &points, dim, 2 * cells * (sweep < 10 ? sweep : 3), 2 * cells, &key);
        for (size_t i = 0; i < 2 * cells; i += 2) {
            const size_t cell = cell_of(u, 2 * cells, i, dim, k);
            full &= cell < cells && cell_of(u, 2 * cells, i + 1, dim, k) == cell && !seen[cell]++;
            now[i / 2] = cell;
        }
        if (sweep > 0 && cells > 8)
            unlike &= memcmp(order[0], order[1], cells * sizeof *now) != 0;
    }
    tap_ok(full, "jitter(%zu), dim %zu: a pair in every cell in every sweep", k, dim);
    tap_ok(unlike, "jitter(%zu), dim %zu: each sweep has its own order", k, dim);
    tap_ok(points.round(dim, &points) == 2 * cells, "jitter(%zu), dim %zu: rounds to %zu", k, dim,
           2 * cells);
}

/* The first cell of a sweep, and the way from it to the second, are uniform: so a prefix is a
 * random sample of the cells. Within its cell a point is uniform. */
static void test_jitter_law(void)
{
    enum { K = 12, SWEEPS = 20000 };
    const buffon_points points = buffon_points_jitter(K);
    static uint64_t first[K], step[K], at[K];
    static double mass[K], steps[K], inside[SWEEPS];
    double u[2 * K];
    for (size_t s = 0; s < SWEEPS; s++) {
        fill(u, &points, 1, s * 2 * K, 2 * K, &main_key);
        const size_t a = (size_t)(u[0] * K), b = (size_t)(u[2] * K);
        first[a]++;
        step[(b + K - a) % K]++;
        inside[s] = u[0] * K - (double)a;
        for (size_t p = 0; p < K; p++) /* where cell 5 comes in the sweep */
            at[p] += (size_t)(u[2 * p] * K) == 5;
    }
    for (size_t c = 0; c < K; c++) {
        mass[c] = 1.0 / K;
        steps[c] = c > 0 ? 1.0 / (K - 1) : 0;
    }
    law_ok(law_cells(first, mass, K), "jitter: each cell is as likely to come first");
    law_ok(law_cells(step, steps, K), "jitter: and each other one second");
    law_ok(law_cells(at, mass, K), "jitter: a cell is as likely to come at any place");
    law_ok(law_uniform(inside, SWEEPS), "jitter: points are uniform within their cells");
}

/* A run that ends within a sweep is unbiased, and its error counts the spread between the cells. */
static void test_jitter_prefix(void)
{
    enum { RUNS = 1500 };
    const buffon_points points = buffon_points_jitter(64);
    const buffon_integrand f = {.scalar = square, .dim = 1};
    const double lo = 0, hi = 1;
    double sum = 0, sum2 = 0, error = 0;
    for (uint64_t seed = 0; seed < RUNS; seed++) {
        buffon_partial partial = {0};
        buffon_run run = {.samples = 128,
                          .block = 16,
                          .seed = seed,
                          .parts = 2,
                          .points = &points,
                          .partial = &partial};
        buffon_estimate e;
        if (buffon_uniform(&e, &f, &lo, &hi, &run) < 0 || e.samples != 64)
            exit(1);
        sum += e.value - 1.0 / 3;
        sum2 += (e.value - 1.0 / 3) * (e.value - 1.0 / 3);
        error += e.std_error * e.std_error;
        buffon_partial_free(&partial);
    }
    const double sd = sqrt(sum2 / RUNS), se = sqrt(error / RUNS);
    law_ok(law_normal(sum / RUNS / (sd / sqrt(RUNS))), "jitter: half a sweep is unbiased");
    tap_ok(se > 0.95 * sd && se < 2 * sd, "jitter: and its error bar is not too short (%.3f)",
           se / sd);
}

/* 1/12 of f'^2 over each cell is all the variance that is left: it falls as k^-2 more. */
static void test_jitter_error(void)
{
    const buffon_points points = buffon_points_jitter(50);
    const buffon_integrand f = {.scalar = square, .dim = 1};
    const double lo = 0, hi = 1;
    const buffon_run run = {.samples = 99950, .seed = 3, .points = &points};
    buffon_estimate e;
    double expected = 0;
    for (int c = 0; c < 50; c++) {
        const double a = c / 50.0, b = a + 0.02, m = (b * b * b - a * a * a) / 0.06;
        expected += ((pow(b, 5) - pow(a, 5)) / 0.1 - m * m) / 50;
    }
    tap_ok(buffon_uniform(&e, &f, &lo, &hi, &run) == BUFFON_OK && e.samples == 100000,
           "jitter: samples are rounded up to whole sweeps");
    const double ratio = e.std_error * e.std_error * 100000 / expected;
    tap_ok(fabs(ratio - 1) < 0.05 && fabs(e.value - 1.0 / 3) < 6 * sqrt(expected / 100000),
           "jitter: the error is that of the spread within the cells (%.4f)", ratio);
}

/* ---- replay ---- */

static void test_replay(void)
{
    enum { N = 100 };
    static double u[2 * N], got[2 * N];
    static const double bad[] = {0, 1, -0.5, 1.5, NAN, INFINITY};
    buffon_rng rng = buffon_rng_make(2, 0);
    buffon_rng_fill(u, 2 * N, &rng);
    const buffon_points points = buffon_points_replay(u, 2, N, BUFFON_DESIGN_INDEPENDENT);
    tap_ok(fill(got, &points, 2, 0, N, &main_key) == 0 && memcmp(got, u, sizeof u) == 0,
           "replay gives what it was given");
    tap_ok(fill(got, &points, 2, 0, N + 1, &main_key) != 0 &&
               fill(got, &points, 2, N - 1, 2, &main_key) != 0 &&
               fill(got, &points, 2, N + 1, 0, &main_key) != 0 &&
               fill(got, &points, 1, 0, 1, &main_key) != 0,
           "and nothing that it does not hold");
    const buffon_integrand f = {.scalar = linear, .dim = 2};
    const double lo[] = {0, 0}, hi[] = {1, 1};
    buffon_run run = {.samples = N, .points = &points};
    buffon_estimate e, same;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_OK && e.samples == N, "replay: a run");
    run.seed = 77;
    run.stream = 3;
    run.threads = 3;
    tap_ok(buffon_uniform(&same, &f, lo, hi, &run) == BUFFON_OK && same_estimate(&e, &same),
           "replay: the seed plays no part");
    run.samples = N + 1;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_E_SAMPLES &&
               is_refusal(&e, BUFFON_E_SAMPLES),
           "replay: more samples than it has are refused");
    run.samples = N;
    for (size_t b = 0; b < sizeof bad / sizeof *bad; b++) {
        const double kept = u[N + 63];
        u[N + 63] = bad[b];
        tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_E_POINTS &&
                   is_refusal(&e, BUFFON_E_POINTS) && e.bad_index == UINT64_MAX,
               "replay: a coordinate of %g is refused", bad[b]);
        u[N + 63] = kept;
    }
}

static void test_replay_designs(void)
{
    static const double u[] = {0.1, 0.9, 0.3, 0.7, 0.25, 0.75}; /* pairs */
    const buffon_integrand f = {.scalar = square, .dim = 1}, g = {.scalar = linear, .dim = 2};
    const double lo[] = {0, 0}, hi[] = {1, 1};
    buffon_run run = {.samples = 6};
    buffon_estimate a, b, c;
    buffon_points points = buffon_points_replay(u, 1, 6, BUFFON_DESIGN_INDEPENDENT);
    run.points = &points;
    int good = buffon_uniform(&a, &f, lo, hi, &run) >= 0;
    points = buffon_points_replay(u, 1, 6, BUFFON_DESIGN_ANTITHETIC);
    good &= buffon_uniform(&b, &f, lo, hi, &run) >= 0;
    points = buffon_points_replay(u, 1, 6, BUFFON_DESIGN_NONE);
    good &= buffon_uniform(&c, &f, lo, hi, &run) == BUFFON_W_NO_ERROR;
    tap_ok(good && a.value == b.value && a.value == c.value && b.std_error < a.std_error / 3 &&
               b.std_error > 0 && isnan(c.std_error),
           "replay: the error is that of its design");
    tap_ok(buffon_uniform(&a, &g, lo, hi, &run) == BUFFON_E_POINTS, "replay: another dimension");
    for (int design = -1; design < 8; design++) {
        points = buffon_points_replay(u, 1, 6, (buffon_design)design);
        const int known = design == 0 || design == 1 || design == 4;
        tap_ok((buffon_uniform(&a, &f, lo, hi, &run) == BUFFON_E_POINTS) == !known,
               "replay: design %d is %s", design, known ? "taken" : "refused");
    }
    points = buffon_points_replay(NULL, 1, 6, BUFFON_DESIGN_NONE);
    tap_ok(buffon_uniform(&a, &f, lo, hi, &run) == BUFFON_E_POINTS, "replay of NULL is refused");
    points = buffon_points_replay(u, 1, 0, BUFFON_DESIGN_NONE);
    tap_ok(buffon_uniform(&a, &f, lo, hi, &run) == BUFFON_E_POINTS, "replay of nothing is refused");
    points = buffon_points_replay(u, 1, 5, BUFFON_DESIGN_ANTITHETIC);
    run.samples = 5;
    tap_ok(buffon_uniform(&a, &f, lo, hi, &run) == BUFFON_E_SAMPLES, "half a pair is refused");
    const buffon_density g1 = buffon_segment(0, 1);
    const buffon_stratum twice[] = {{.density = &g1}, {.density = &g1}};
    points = buffon_points_replay(u, 1, 6, BUFFON_DESIGN_INDEPENDENT);
    tap_ok(buffon_stratified(&a, &f, &(buffon_strata){.stratum = twice, .count = 2}, &run) ==
               BUFFON_E_POINTS,
           "two strata with the same numbers are refused");
}

/* ---- a user's ---- */

/* What a set of shifted replicates is for: a far smaller error, honestly told. */
static void test_replicates(void)
{
    enum { RUNS = 400 };
    const buffon_points points = problem_kronecker();
    const double lo[] = {0, 0}, hi[] = {1, 1};
    const buffon_integrand f = {.batch = problem_three, .dim = 2, .components = 3};
    double sum2 = 0, error = 0, plain = 0;
    for (uint64_t seed = 0; seed < RUNS; seed++) {
        buffon_estimate e[3];
        buffon_run run = {.samples = 2048, .seed = seed, .points = &points, .block = 128};
        if (buffon_uniform(e, &f, lo, hi, &run) < 0 || e->samples != 2048)
            exit(1);
        sum2 += (e->value - 0.25) * (e->value - 0.25);
        error += e->std_error * e->std_error;
        plain += e->variance / 2048;
    }
    tap_ok(plain > 5 * sum2, "replicates: variance %.0f times below that of random points",
           plain / sum2);
    /* 7 degrees of freedom each, 400 runs: the ratio has a standard deviation of some 8 %. */
    tap_ok(fabs(sum2 / error - 1) < 0.5, "replicates: the error is that seen over %d runs (%.2f)",
           RUNS, sum2 / error);
}

typedef struct counts {
    int prepared, sized;
    size_t dim;
} counts;

static size_t count_size(size_t dim, const buffon_points *self)
{
    counts *c = self->ctx;
    c->sized++;
    c->dim = dim;
    return dim == 3 ? SIZE_MAX : 24;
}

static int count_prepare(const buffon_points_block *block, const buffon_points *self)
{
    counts *c = self->ctx;
    c->prepared++;
    uint64_t *table = block->table;
    table[0] = block->key.replicate;
    table[1] = block->key.stratum;
    table[2] = block->dim;
    return block->dim == 4;
}

/* Checks that the table is that of its block. */
static int count_fill(double *u, const buffon_points_block *block, const buffon_points *self)
{
    const uint64_t *table = block->table;
    (void)self;
    for (size_t j = 0; j < block->dim; j++)
        buffon_rng_uniforms_at(u + j * block->n, block->n, &block->key, (uint32_t)j, block->first);
    return table[0] != block->key.replicate || table[1] != block->key.stratum ||
           table[2] != block->dim || block->key.seed != 9 || block->key.stream != 8;
}

static double flat(const double *x, void *ctx)
{
    (void)ctx;
    return x[0];
}

static void test_hooks(void)
{
    const double lo[] = {0, 0, 0, 0}, hi[] = {1, 1, 1, 1};
    counts c = {0, 0, 0};
    buffon_points points = {.fill = count_fill,
                            .table_size = count_size,
                            .prepare = count_prepare,
                            .design = BUFFON_DESIGN_REPLICATES,
                            .replicates = 5,
                            .ctx = &c};
    const buffon_run run = {
        .samples = 9001, .seed = 9, .stream = 8, .points = &points, .threads = 2};
    buffon_integrand f = {.scalar = flat, .dim = 2};
    const buffon_density box[2] = {buffon_box(lo, hi, 2), buffon_box(lo, hi, 2)};
    const buffon_stratum list[] = {{.density = &box[0]}, {.density = &box[1]}};
    const buffon_strata strata = {.stratum = list, .count = 2};
    buffon_estimate e;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_OK && c.prepared == 5 && c.dim == 2 &&
               e.samples == 9005,
           "a table is prepared for each replicate, once");
    c.prepared = 0;
    tap_ok(buffon_stratified(&e, &f, &strata, &run) == BUFFON_OK && c.prepared == 10,
           "and for each stratum");
    c.prepared = 0;
    tap_ok(buffon_rejection(&e, &f, lo, hi, 1, &run) == BUFFON_E_POINTS && c.prepared == 0 &&
               c.dim == 3,
           "a table of SIZE_MAX: not for that dimension (one more, by rejection)");
    f.dim = 4;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_E_POINTS && c.prepared == 1 &&
               is_refusal(&e, BUFFON_E_POINTS),
           "a table that cannot be prepared");
    double x[4];
    f.dim = 2;
    tap_ok(buffon_sample_at(x, &box[0], 17, &run) == BUFFON_OK, "sample_at prepares its table too");
    points.design = BUFFON_DESIGN_ANTITHETIC;
    tap_ok(buffon_uniform(&e, &f, lo, hi, &run) == BUFFON_E_POINTS,
           "pairs must round to even numbers");
}

/* Sixes for one uniform, fours for two. */
static uint64_t six_or_four(size_t dim, const buffon_points *self)
{
    (void)self;
    return dim == 1 ? 6 : 4;
}

static int draw_first(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    (void)g;
    memcpy(x, u, n * sizeof *x);
    for (size_t i = 0; pdf != NULL && i < n; i++)
        pdf[i] = 1;
    return 0;
}

static int pdf_one(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    (void)x;
    (void)g;
    for (size_t i = 0; i < n; i++)
        pdf[i] = 1;
    return 0;
}

static void test_rounding(void)
{
    static const buffon_density_ops ops = {.sample = draw_first, .pdf = pdf_one};
    buffon_points points = buffon_points_random();
    const buffon_density g[] = {{.uniforms = 1, .dim = 1, .ops = &ops},
                                {.uniforms = 2, .dim = 1, .ops = &ops}};
    const buffon_stratum list[] = {{.density = &g[0]}, {.density = &g[1]}};
    const buffon_strata strata = {.stratum = list, .count = 2};
    const buffon_integrand f = {.scalar = square, .dim = 1};
    const buffon_run run = {.samples = 26, .points = &points};
    buffon_estimate e;
    points.round = six_or_four;
    tap_ok(buffon_stratified(&e, &f, &strata, &run) >= 0 && e.samples == 48,
           "strata of different needs: each gets a multiple of all");
    points.round = NULL;
    tap_ok(buffon_stratified(&e, &f, &strata, &run) >= 0 && e.samples == 26,
           "without a need: none");
}

int main(void)
{
    static double u[3 * 1000];
    buffon_rng rng = buffon_rng_make(4, 0);
    buffon_rng_fill(u, 3 * 1000, &rng);
    const struct {
        const char *name;
        buffon_points points;
        size_t least, most; /* dimensions */
    } sets[] = {{"random", buffon_points_random(), 1, 3},
                {"antithetic", buffon_points_antithetic(), 1, 3},
                {"jitter(1)", buffon_points_jitter(1), 1, 3},
                {"jitter(7)", buffon_points_jitter(7), 1, 3},
                {"jitter(2^13)", buffon_points_jitter(8192), 1, 3},
                {"replay", buffon_points_replay(u, 3, 1000, BUFFON_DESIGN_NONE), 3, 3},
                {"kronecker", problem_kronecker(), 1, 3}};
    for (size_t s = 0; s < sizeof sets / sizeof *sets; s++) {
        for (size_t dim = sets[s].least; dim <= sets[s].most; dim++)
            test_stretches(sets[s].name, &sets[s].points, dim);
    }
    test_antithetic();
    test_antithetic_error();
    for (size_t k = 1; k <= 12; k++) {
        test_jitter(k, 1);
        test_jitter(k, 2);
        if (k <= 11)
            test_jitter(k, 3);
    }
    test_jitter_law();
    test_jitter_prefix();
    test_jitter_error();
    test_replay();
    test_replay_designs();
    test_replicates();
    test_hooks();
    test_rounding();
    return tap_done();
}
