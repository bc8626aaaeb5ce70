/* Plain Monte Carlo of the sum of squares, and what the engine and the sums cost in it. */
#ifndef TESTS_BENCH_INTEGRALS_H
#define TESTS_BENCH_INTEGRALS_H

#include "samplers.h"

static size_t dim;

/* What the peers integrate. The empty instruction keeps compilers from vectors, which would make it
 * slower: a wide load of what was just stored one by one waits for the stores. */
static inline double squares(const double *x, void *ctx)
{
    double sum = 0;
    (void)ctx;
    for (size_t j = 0; j < dim; j++) {
        sum += x[j] * x[j];
        __asm__ volatile("");
    }
    return sum;
}

/* What we integrate, for each level compiled for its instructions, as -march would: an integrand is
 * the caller's, and who runs it by the million lets the compiler know his machine. Never inlined,
 * or the compiler would turn loops whose arrays it knows. */
#if defined(__GNUC__)
#define SQUARES_APART __attribute__((noinline))
#else
#define SQUARES_APART
#endif

#define SQUARES(name, apart)                                                                       \
    apart static int name(double *f, const double *x, size_t n, void *ctx)                         \
    {                                                                                              \
        (void)ctx;                                                                                 \
        for (size_t i = 0; i < n; i++)                                                             \
            f[i] = x[i] * x[i];                                                                    \
        for (size_t j = 1; j < dim; j++) {                                                         \
            for (size_t i = 0; i < n; i++)                                                         \
                f[i] += x[j * n + i] * x[j * n + i];                                               \
        }                                                                                          \
        return 0;                                                                                  \
    }

SQUARES(squares_plain, SQUARES_APART)
#if defined(__GNUC__) && defined(__x86_64__)
SQUARES(squares_avx2, __attribute__((noinline, target("avx2"))))
SQUARES(squares_avx512, __attribute__((noinline, target("avx512f,avx512dq,avx512vl,avx512bw"))))
#else
#define squares_avx2 squares_plain
#define squares_avx512 squares_plain
#endif

typedef int squares_function(double *f, const double *x, size_t n, void *ctx);

static squares_function *squares_batch(void)
{
    switch (buffon_cpu_level()) {
    case BUFFON_LEVEL_AVX512:
        return squares_avx512;
    case BUFFON_LEVEL_AVX2:
        return squares_avx2;
    default:
        return squares_plain;
    }
}

static double ours_integral(const buffon_integrand *f, const double *lo, size_t items)
{
    const buffon_run run = {.samples = items, .seed = next_seed++};
    buffon_estimate e;
    bench_must(buffon_uniform(&e, f, lo, ones, &run));
    return e.value;
}

static double ours_batch(size_t items)
{
    return ours_integral(&(buffon_integrand){.batch = squares_batch(), .dim = dim}, zeros, items);
}

static double ours_plain_batch(size_t items)
{
    return ours_integral(&(buffon_integrand){.batch = squares_plain, .dim = dim}, zeros, items);
}

static double ours_box_batch(size_t items)
{
    static const double lo[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
    return ours_integral(&(buffon_integrand){.batch = squares_batch(), .dim = dim}, lo, items);
}

static double ours_scalar(size_t items)
{
    return ours_integral(&(buffon_integrand){.scalar = squares, .dim = dim}, zeros, items);
}

/* The numbers and the integrand, and nothing else: no box, no sums, no engine. */
static double bare_batch(size_t items)
{
    const buffon_rng_key key = {.seed = next_seed++};
    squares_function *const batch = squares_batch();
    for (size_t i = 0; i < items; i += TILE) {
        for (size_t j = 0; j < dim; j++)
            buffon_rng_uniforms_at(buffer + j * TILE, TILE, &key, (uint32_t)j, i);
        batch(points, buffer, TILE, NULL);
        bench_sink = points[i % 3];
    }
    return points[1];
}

/* Welford's running mean and variance, as the textbooks have it. */
static double plain_integral(size_t items)
{
    plain_rng rng = plain_make();
    double x[8], mean = 0, m2 = 0;
    for (size_t i = 0; i < items; i++) {
        for (size_t j = 0; j < dim; j++)
            x[j] = plain_uniform(&rng);
        const double f = squares(x, NULL), d = f - mean;
        mean += d / (double)(i + 1);
        m2 += d * (f - mean);
    }
    return mean + m2;
}

#ifdef BENCH_GSL
static double gsl_squares(double *x, size_t d, void *ctx)
{
    (void)d;
    return squares(x, ctx);
}

static double gsl_integral(gsl_rng *rng, size_t items)
{
    gsl_monte_function f = {gsl_squares, dim, NULL};
    gsl_monte_plain_state *state = gsl_monte_plain_alloc(dim);
    double value = 0, error = 0;
    gsl_monte_plain_integrate(&f, zeros, ones, dim, items, rng, state, &value, &error);
    gsl_monte_plain_free(state);
    return value + error;
}

static double gsl_mt_integral(size_t items)
{
    return gsl_integral(gsl_mt, items);
}

static double gsl_taus_integral(size_t items)
{
    return gsl_integral(gsl_taus, items);
}
#else
#define gsl_mt_integral NULL
#define gsl_taus_integral NULL
#endif

static void bench_integrals(void)
{
    const bench_peer peers[] = {
        {"buffon, box from -1 to 1", ours_box_batch, {0}},
        {"buffon, integrand for the 128-bit level", ours_plain_batch, {0}},
        {"buffon, one point at a time", ours_scalar, {0}},
        {"plain loop, scalar xoshiro256++", plain_integral, {0}},
        {"GSL gsl_monte_plain, taus2", gsl_taus_integral, {0}},
        {"GSL gsl_monte_plain, mt19937", gsl_mt_integral, {0, 4.5, 8, 15}},
    };
    bench_header("ns per evaluation");
    for (dim = 1; dim <= 8; dim *= 2) {
        char title[32];
        snprintf(title, sizeof title, "sum of squares, d = %zu", dim);
        bench_group(title, ours_batch, peers, COUNT(peers));
    }
}

/* At each level by how much the whole run takes longer than its numbers and its integrand. */
static void overhead_line(double most)
{
    const size_t levels = bench_levels();
    bench_case cases[2 * BENCH_LEVELS];
    for (size_t level = 0; level < levels; level++) {
        cases[2 * level] = (bench_case){ours_batch, (buffon_level)level};
        cases[2 * level + 1] = (bench_case){bare_batch, (buffon_level)level};
    }
    bench_time(cases, 2 * levels);
    printf("  d = %-53zu", dim);
    for (size_t level = 0; level < levels; level++) {
        const double percent = 100 * (bench_ratio(2 * level, 2 * level + 1) - 1);
        bench_target target = {.where = buffon_level_string((buffon_level)level),
                               .unit = "%",
                               .wanted = most,
                               .reached = percent,
                               .most = 1};
        snprintf(target.what, sizeof target.what,
                 "engine and sums over numbers and integrand, d = %zu", dim);
        if (most > 0 && level == BUFFON_LEVEL_AVX512)
            bench_want(&target);
        printf(" %6.0f %%", percent);
    }
    printf("\n");
    fflush(stdout);
}

static void bench_overhead(void)
{
    static const double most[9] = {[1] = 60, [8] = 15};
    printf("\nengine and sums over numbers and integrand alone\n");
    for (dim = 1; dim <= 8; dim *= 2)
        overhead_line(most[dim]);
}

#endif
