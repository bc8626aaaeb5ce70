/* What a number costs, against the same loops written plainly with libm, and against GSL where it
 * is installed: how to read the table is said in bench.h. */
#define _POSIX_C_SOURCE 200809L

#include <string.h>

#include <buffon/buffon.h>

#include "bench.h"
#include "plain.h"

#define TILE 1024
#define COUNT(cases) (sizeof(cases) / sizeof *(cases))

static const double zeros[8] = {0}, ones[8] = {1, 1, 1, 1, 1, 1, 1, 1};
static double buffer[8 * TILE], points[8 * TILE], pdf[TILE];
static uint64_t words[TILE];
static uint64_t next_index;

static void must(buffon_status status)
{
    if (status < 0) {
        fprintf(stderr, "bench: %s\n", buffon_status_string(status));
        exit(1);
    }
}

/* ---- uniforms ---- */

static double ours_uniforms(size_t items)
{
    const buffon_rng_key key = {.seed = 1};
    for (size_t i = 0; i < items; i += TILE, next_index += TILE)
        buffon_rng_uniforms_at(buffer, TILE, &key, 0, next_index);
    return buffer[1];
}

static double ours_words(size_t items)
{
    const buffon_rng_key key = {.seed = 1};
    for (size_t i = 0; i < items; i += TILE, next_index += TILE)
        buffon_rng_words_at(words, TILE, &key, 0, next_index);
    return (double)words[1];
}

static double ours_fill(size_t items)
{
    static buffon_rng rng;
    if (next_index == 0)
        rng = buffon_rng_make(1, 0);
    for (size_t i = 0; i < items; i += TILE)
        buffon_rng_fill(buffer, TILE, &rng);
    return buffer[1];
}

static double ours_next(size_t items)
{
    buffon_rng rng = buffon_rng_make(1, next_index);
    double sum = 0;
    for (size_t i = 0; i < items; i++)
        sum += buffon_rng_next(&rng);
    return sum;
}

static double plain_next(size_t items)
{
    double sum = 0;
    for (size_t i = 0; i < items; i++)
        sum += plain_uniform();
    return sum;
}

static double plain_fill(size_t items)
{
    for (size_t i = 0; i < items; i += TILE) {
        for (size_t k = 0; k < TILE; k++)
            buffer[k] = plain_uniform();
    }
    return buffer[1];
}

#ifdef BENCH_GSL
static gsl_rng *gsl_mt;

static double gsl_fill(size_t items)
{
    for (size_t i = 0; i < items; i += TILE) {
        for (size_t k = 0; k < TILE; k++)
            buffer[k] = gsl_rng_uniform(gsl_mt);
    }
    return buffer[1];
}
#endif

static void bench_uniforms(void)
{
    const bench_case fill[] = {{"buffon_rng_uniforms_at", ours_uniforms},
                               {"buffon_rng_words_at", ours_words},
                               {"buffon_rng_fill", ours_fill},
                               {"plain xoshiro256++", plain_fill},
#ifdef BENCH_GSL
                               {"GSL mt19937", gsl_fill},
#endif
    };
    const bench_case next[] = {{"buffon_rng_next", ours_next}, {"plain xoshiro256++", plain_next}};
    bench_header("ns per number");
    bench_group("uniform, 1024 at a time", fill, COUNT(fill));
    bench_group("uniform, one at a time", next, COUNT(next));
}

/* ---- samplers, generator included ---- */

static double ours_density(const buffon_density *g, size_t items)
{
    const buffon_rng_key key = {.seed = 1};
    for (size_t i = 0; i < items; i += TILE, next_index += TILE) {
        for (size_t j = 0; j < g->uniforms; j++)
            buffon_rng_uniforms_at(buffer + j * TILE, TILE, &key, (uint32_t)j, next_index);
        must(buffon_density_sample(points, pdf, buffer, TILE, g));
    }
    return points[1] + pdf[1];
}

#define OURS(name, constructor)                                                                   \
    static double ours_##name(size_t items)                                                       \
    {                                                                                             \
        const buffon_density g = constructor;                                                     \
        return ours_density(&g, items);                                                           \
    }
OURS(sphere, buffon_sphere())
OURS(cap, buffon_cap(0.5))
OURS(hemisphere, buffon_hemisphere())
OURS(cosine, buffon_hemisphere_cosine())
OURS(disk, buffon_disk(1))
OURS(concentric, buffon_disk_concentric(1))
OURS(box, buffon_box(zeros, ones, 2))

#define PLAIN(name, call)                                                                         \
    static double plainly_##name(size_t items)                                                    \
    {                                                                                             \
        double x[3] = {0}, sum = 0;                                                               \
        for (size_t i = 0; i < items; i++) {                                                      \
            call;                                                                                 \
            sum += x[0];                                                                          \
        }                                                                                         \
        return sum;                                                                               \
    }
PLAIN(sphere, plain_sphere(x))
PLAIN(cap, plain_cap(x, 0.5))
PLAIN(cosine, plain_cosine(x))
PLAIN(disk, plain_disk(x))
#ifdef BENCH_GSL
PLAIN(gsl_sphere, gsl_ran_dir_3d(gsl_mt, &x[0], &x[1], &x[2]))
PLAIN(gsl_circle, gsl_ran_dir_2d(gsl_mt, &x[0], &x[1]))
#define GSL_SPHERE , {"GSL gsl_ran_dir_3d", plainly_gsl_sphere}
#define GSL_CIRCLE , {"GSL gsl_ran_dir_2d (circle)", plainly_gsl_circle}
#else
#define GSL_SPHERE
#define GSL_CIRCLE
#endif

static void bench_samplers(void)
{
    const bench_case box[] = {{"buffon_box, d = 2", ours_box}};
    const bench_case sphere[] = {{"buffon_sphere", ours_sphere},
                                 {"plain, libm", plainly_sphere} GSL_SPHERE};
    const bench_case cap[] = {{"buffon_cap", ours_cap}, {"plain, libm", plainly_cap} GSL_SPHERE};
    const bench_case hemisphere[] = {{"buffon_hemisphere", ours_hemisphere} GSL_SPHERE};
    const bench_case cosine[] = {{"buffon_hemisphere_cosine", ours_cosine},
                                 {"plain, libm", plainly_cosine} GSL_SPHERE};
    const bench_case disk[] = {{"buffon_disk", ours_disk},
                               {"buffon_disk_concentric", ours_concentric},
                               {"plain, libm", plainly_disk} GSL_CIRCLE};
    bench_header("ns per point");
    bench_group("box", box, COUNT(box));
    bench_group("sphere", sphere, COUNT(sphere));
    bench_group("cap", cap, COUNT(cap));
    bench_group("hemisphere", hemisphere, COUNT(hemisphere));
    bench_group("hemisphere, cosine", cosine, COUNT(cosine));
    bench_group("disk", disk, COUNT(disk));
}

/* ---- plain Monte Carlo: the sum of squares ---- */

static size_t dim;

static double squares(const double *x, void *ctx)
{
    double sum = 0;
    (void)ctx;
    for (size_t j = 0; j < dim; j++)
        sum += x[j] * x[j];
    return sum;
}

static int squares_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    memset(f, 0, n * sizeof *f);
    for (size_t j = 0; j < dim; j++) {
        for (size_t i = 0; i < n; i++)
            f[i] += x[j * n + i] * x[j * n + i];
    }
    return 0;
}

static double ours_integral(const buffon_integrand *f, size_t items)
{
    buffon_estimate e;
    must(buffon_uniform(&e, f, zeros, ones, &(buffon_run){.samples = items, .seed = next_index++}));
    return e.value;
}

static double ours_batch(size_t items)
{
    return ours_integral(&(buffon_integrand){.batch = squares_batch, .dim = dim}, items);
}

static double ours_scalar(size_t items)
{
    return ours_integral(&(buffon_integrand){.scalar = squares, .dim = dim}, items);
}

/* Welford's running mean and variance, as the textbooks have it. */
static double plain_integral(size_t items)
{
    double x[8], mean = 0, m2 = 0;
    for (size_t i = 0; i < items; i++) {
        for (size_t j = 0; j < dim; j++)
            x[j] = plain_uniform();
        const double d = squares(x, NULL) - mean;
        mean += d / (double)(i + 1);
        m2 += d * (squares(x, NULL) - mean);
    }
    return mean + m2;
}

#ifdef BENCH_GSL
static double gsl_squares(double *x, size_t d, void *ctx)
{
    (void)d;
    return squares(x, ctx);
}

static double gsl_integral(size_t items)
{
    gsl_monte_function f = {gsl_squares, dim, NULL};
    gsl_monte_plain_state *state = gsl_monte_plain_alloc(dim);
    double value = 0, error = 0;
    gsl_monte_plain_integrate(&f, zeros, ones, dim, items, gsl_mt, state, &value, &error);
    gsl_monte_plain_free(state);
    return value + error;
}
#endif

static void bench_integrals(void)
{
    const bench_case cases[] = {{"buffon_uniform, batch", ours_batch},
                                {"buffon_uniform, scalar", ours_scalar},
                                {"plain loop", plain_integral},
#ifdef BENCH_GSL
                                {"GSL gsl_monte_plain, mt19937", gsl_integral},
#endif
    };
    bench_header("ns per evaluation");
    for (dim = 1; dim <= 8; dim *= 2) {
        char title[32];
        snprintf(title, sizeof title, "sum of squares, d = %zu", dim);
        bench_group(title, cases, COUNT(cases));
    }
}

int main(void)
{
#ifdef BENCH_GSL
    gsl_mt = gsl_rng_alloc(gsl_rng_mt19937);
#endif
    printf("buffon %s, compiler %s, %d rounds\n", buffon_version(), __VERSION__, BENCH_ROUNDS);
    bench_uniforms();
    bench_samplers();
    bench_integrals();
#ifdef BENCH_GSL
    gsl_rng_free(gsl_mt);
#else
    printf("\nGSL is not installed (pkg-config gsl): no lines for it.\n");
#endif
    return 0;
}
