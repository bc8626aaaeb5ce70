/* Sobol' points: what a coordinate costs, against GSL's where that is installed, and how much
 * smaller the errors are than those of random points. How times are measured is said in bench.h. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>

#include "../integrands.h"
#include "bench.h"

#ifdef BENCH_GSL
#include <gsl/gsl_qrng.h>
#endif

/* ---- time --------------------------------------------------------------------------------- */

enum { DIM = 8, TILE = 256, WIDE = BUFFON_SOBOL_DIMENSIONS };

static _Alignas(64) double tile[DIM * TILE];
static buffon_points points;
static buffon_points_block block;

static void make_ready(buffon_scramble scramble, size_t dim)
{
    free(block.table);
    points = buffon_points_sobol(scramble);
    block = (buffon_points_block){.key = {.seed = 1}, .n = TILE, .dim = dim};
    block.table = malloc(points.table_size(dim, &points));
    if (block.table == NULL || points.prepare(&block, &points) != 0)
        exit(1);
}

/* An item is a coordinate; the buffer stays in the first cache. */
static double work_points(size_t items)
{
    for (size_t done = 0; done < items; done += DIM * TILE) {
        block.first = done / DIM;
        if (points.fill(tile, &block, &points) != 0)
            exit(1);
    }
    return tile[1];
}

#ifdef BENCH_GSL
static double work_gsl(size_t items)
{
    gsl_qrng *q = gsl_qrng_alloc(gsl_qrng_sobol, DIM);
    for (size_t i = 0; i < items / DIM; i++) /* points one after the other: its only order */
        gsl_qrng_get(q, tile + i % TILE * DIM);
    gsl_qrng_free(q);
    return tile[1];
}
#else
#define work_gsl NULL
#endif

static void time_scramble(const char *name, buffon_scramble scramble, double wanted, double most)
{
    const size_t best = bench_levels() - 1;
    const bench_peer peer[] = {{"gsl_qrng_sobol", work_gsl, {0, 0, 0, wanted}}};
    make_ready(scramble, DIM);
    bench_group(name, work_points, peer, 1);
    bench_target target = {.where = buffon_level_string((buffon_level)best),
                           .unit = "ns",
                           .wanted = most,
                           .reached = bench_median(bench_times[best]),
                           .most = 1};
    snprintf(target.what, sizeof target.what, "%s", name);
    if (most > 0 && best == BUFFON_LEVEL_AVX512)
        bench_want(&target);
}

/* The median of some preparations of all dimensions, in ms. */
static void time_prepare(const char *name, buffon_scramble scramble)
{
    double ms[BENCH_ROUNDS];
    make_ready(scramble, WIDE);
    for (size_t round = 0; round < BENCH_ROUNDS; round++) {
        const double before = bench_clock();
        if (points.prepare(&block, &points) != 0)
            exit(1);
        ms[round] = 1e3 * (bench_clock() - before);
    }
    const size_t best = bench_levels() - 1;
    bench_target target = {.where = buffon_level_string((buffon_level)best),
                           .unit = "ms",
                           .wanted = 5,
                           .reached = bench_median(ms),
                           .most = 1};
    snprintf(target.what, sizeof target.what, "a replicate made ready, %d dimensions, %s", WIDE,
             name);
    bench_want(&target);
}

/* ---- errors ------------------------------------------------------------------------------- */

enum { SAMPLES = 1 << 16, SEEDS = 30, MOST_DIM = 20, KINDS = 6 };
enum { MEDIAN_SAMPLES = 15 << 12 }; /* 15 replicates of a power of two */

typedef struct smooth {
    const char *name;
    size_t dim;
    double (*f)(const double *x, size_t dim);
    double exact;
} smooth;

/* The product of 1 + (x_j - 1/2) / j^2: a function of many coordinates that depends on ever less of
 * them, as most do for which Sobol' points are used. */
static double product_squares(const double *x, size_t dim)
{
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product *= 1 + (x[j] - 0.5) / (double)((j + 1) * (j + 1));
    return product;
}

/* The same with 1 / j: the coordinates matter more alike. */
static double product_linear(const double *x, size_t dim)
{
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product *= 1 + (x[j] - 0.5) / (double)(j + 1);
    return product;
}

/* Exact values from tests/data/exact_values.csv. */
static const smooth genz[] = {
    {"Genz, oscillatory", 5, genz_oscillatory, 0.56673906320480859508},
    {"Genz, product peak", 5, genz_product_peak, 3901.7486263338889417},
    {"Genz, corner peak", 5, genz_corner_peak, 0.019907420523996069575},
    {"Genz, Gaussian", 5, genz_gaussian, 0.028306726720449704941},
    {"Genz, C0", 5, genz_c0, 0.018404913546477759913},
    {"Genz, discontinuous", 5, genz_discontinuous, 1642.2577991699242359}};
static const smooth squares = {"product, weights 1 / j^2", 20, product_squares, 1};
static const smooth inverses = {"product, weights 1 / j", 20, product_linear, 1};
static const smooth ball = {"quarter ball", 5, unit_ball, 0.16449340668482264365};

static double call(const double *x, void *ctx)
{
    const smooth *s = ctx;
    return s->f(x, s->dim);
}

/* The root mean squares over seeds of the errors and of the standard errors, relative to the value.
 */
static double error_of(double *bar, const smooth *s, const buffon_points *with)
{
    static const double lo[MOST_DIM] = {0};
    double hi[MOST_DIM], sum = 0, bars = 0;
    for (size_t j = 0; j < MOST_DIM; j++)
        hi[j] = 1;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        buffon_estimate e;
        const buffon_integrand f = {.scalar = call, .dim = s->dim, .ctx = (void *)s};
        const int median = with->design == BUFFON_DESIGN_MEDIAN;
        const buffon_run run = {
            .samples = median ? MEDIAN_SAMPLES : SAMPLES, .seed = seed, .points = with};
        bench_must(buffon_uniform(&e, &f, lo, hi, &run));
        sum += pow(e.value / s->exact - 1, 2);
        bars += pow(e.std_error / s->exact, 2);
    }
    *bar = sqrt(bars / SEEDS);
    return sqrt(sum / SEEDS);
}

/* Random points, 8 replicates with the nested scramble and with the shift, one net with the nested
 * scramble and with the linear one, the median of 15 linear ones; of the last three the error that
 * they state, too. Leaves the gains over random points. */
static void print_errors(double gain[KINDS], const smooth *s)
{
    buffon_points with[KINDS] = {buffon_points_random(),
                                 buffon_points_sobol(BUFFON_SCRAMBLE_OWEN),
                                 buffon_points_sobol(BUFFON_SCRAMBLE_SHIFT),
                                 buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN),
                                 buffon_points_sobol_net(BUFFON_SCRAMBLE_LINEAR),
                                 buffon_points_sobol_median()};
    double error[KINDS], bar;
    printf("  %-26s d = %-3zu", s->name, s->dim);
    for (size_t k = 0; k < KINDS; k++) {
        error[k] = error_of(&bar, s, &with[k]);
        gain[k] = error[0] / error[k];
        printf(k > 0 ? "  %8.1e %8.1fx" : "  %8.1e", error[k], gain[k]);
        if (with[k].design >= BUFFON_DESIGN_NET)
            printf(" +- %.1e", bar);
    }
    printf("\n");
    fflush(stdout);
}

static void want_gain(const char *what, double wanted, double reached)
{
    bench_target target = {.where = "any", .unit = "x", .wanted = wanted, .reached = reached};
    snprintf(target.what, sizeof target.what, "%s", what);
    bench_want(&target);
}

static void compare_errors(void)
{
    double gain[KINDS], logs[KINDS] = {0};
    printf("\nrelative error at N = %d, rms over %d seeds, and how many times smaller than with "
           "random points\n  %-34s  %8s  %18s  %18s  %29s  %29s  %29s\n",
           SAMPLES, SEEDS, "", "random", "8 replicates", "8, shift", "one net", "one, linear",
           "median of 15");
    for (size_t k = 0; k < COUNT(genz); k++) {
        print_errors(gain, &genz[k]);
        for (size_t i = 0; i < KINDS; i++)
            logs[i] += log(gain[i]) / (double)COUNT(genz);
    }
    want_gain("Genz d = 5, geometric mean, error against random, 8 replicates", 10, exp(logs[1]));
    want_gain("Genz d = 5, geometric mean, error against random, one net", 35, exp(logs[3]));
    print_errors(gain, &squares);
    want_gain("smooth product d = 20, error against random, 8 replicates", 1000, gain[1]);
    print_errors(gain, &inverses);
    print_errors(gain, &ball);
}

int main(void)
{
    printf("\nSobol' points, coordinates of %d points at a time\n", TILE);
    bench_header("ns per coordinate, d = 8");
    time_scramble("Sobol', not scrambled", BUFFON_SCRAMBLE_NONE, 6, 0);
    time_scramble("Sobol', nested scramble", BUFFON_SCRAMBLE_OWEN, 0, 6);
    time_scramble("Sobol', linear scramble", BUFFON_SCRAMBLE_LINEAR, 0, 0);
    time_prepare("nested scramble", BUFFON_SCRAMBLE_OWEN);
    time_prepare("linear scramble", BUFFON_SCRAMBLE_LINEAR);
    time_prepare("not scrambled", BUFFON_SCRAMBLE_NONE);
    compare_errors();
    bench_print_targets();
    free(block.table);
    return 0;
}
