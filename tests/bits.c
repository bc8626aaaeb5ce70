/* Results in hex, for comparing builds: every line must be the same from every compiler, level of
 * optimisation, instruction set and machine (tests/bits.sh). The integrands use + - * / and sqrt
 * alone.
 *
 *     bits [scalar | 128 | avx2 | avx512]
 *
 * The argument limits the library to these instructions. The exit code is 77 where they are
 * missing. */
#include <stdio.h>
#include <stdlib.h>

#include "family.h"
#include "problems.h"

static uint64_t bits_of(double x)
{
    uint64_t bits;
    if (x != x)
        return UINT64_C(0x7ff8000000000000); /* NaNs have signs and payloads that mean nothing */
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static void show(const char *name, double x)
{
    printf(" %s %016llx", name, (unsigned long long)bits_of(x));
}

/* FNV-1a of bytes or of numbers, for outputs too long to print. */
static uint64_t hash_bytes(uint64_t hash, const unsigned char *bytes, size_t n)
{
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static uint64_t hash_numbers(const double *x, size_t n)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < n; i++) {
        unsigned char bytes[8];
        for (unsigned b = 0; b < 8; b++)
            bytes[b] = (unsigned char)(bits_of(x[i]) >> (8 * b));
        hash = hash_bytes(hash, bytes, 8);
    }
    return hash;
}

/* ---- estimates ---- */

static void show_estimate(const char *name, size_t k, const buffon_estimate *e)
{
    printf("%s [%zu]: %d %llu %llu %lx %d", name, k, (int)e->status, (unsigned long long)e->samples,
           (unsigned long long)e->nonfinite, (unsigned long)e->doubts, (int)e->interval);
    show("value", e->value);
    show("error", e->std_error);
    show("variance", e->variance);
    show("lo", e->lo);
    show("hi", e->hi);
    show("min", e->min);
    show("max", e->max);
    show("share", e->max_share);
    show("tail", e->tail_index);
    show("ess", e->ess);
    show("acceptance", e->acceptance);
    printf("\n");
}

static void show_partial(const char *name, const buffon_partial *partial, size_t components)
{
    double cov[PROBLEMS_COMPONENTS * PROBLEMS_COMPONENTS];
    const size_t size = buffon_partial_size(partial);
    unsigned char *bytes = malloc(size);
    if (bytes == NULL || buffon_partial_save(bytes, size, partial) != BUFFON_OK)
        exit(1);
    printf("%s: partial of %zu bytes %016llx", name, size,
           (unsigned long long)hash_bytes(UINT64_C(0xcbf29ce484222325), bytes, size));
    if (buffon_partial_covariance(cov, partial) == BUFFON_OK) {
        for (size_t i = 0; i < components * components; i++)
            show("", cov[i]);
    }
    printf("\n");
    free(bytes);
}

static void show_problem(const problem *p)
{
    static const struct {
        uint64_t samples;
        uint32_t block;
        int tolerant;
    } runs[] = {{9, 0, 0}, {777, 16, 0}, {30001, 0, 0}, {100000, 2048, 1}};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        buffon_partial partial = {0};
        buffon_estimate e[PROBLEMS_COMPONENTS];
        buffon_run run = {.samples = runs[i].samples,
                          .seed = 20240607 + i,
                          .block = runs[i].block,
                          .rel_tol = runs[i].tolerant ? p->rel_tol : 0,
                          .threads = 2,
                          .partial = &partial};
        const buffon_status status = p->solve(e, run);
        printf("%s: %d\n", p->name, (int)status);
        for (size_t k = 0; k < p->components; k++)
            show_estimate(p->name, k, &e[k]);
        show_partial(p->name, &partial, p->components);
        buffon_partial_free(&partial);
    }
}

/* ---- densities ---- */

enum { POINTS = 3000, WIDE = 16 };

static void show_density(const char *name, const buffon_density *g)
{
    static double u[WIDE * POINTS], x[WIDE * POINTS], pdf[POINTS];
    if (g->uniforms > WIDE || g->dim > WIDE)
        return;
    buffon_rng rng = buffon_rng_make(7, g->uniforms);
    buffon_rng_fill(u, g->uniforms * POINTS, &rng);
    u[0] = 0x1p-53; /* the ends of what the generator gives */
    u[1] = 1 - 0x1p-53;
    buffon_status status = buffon_density_sample(x, pdf, u, POINTS, g);
    printf("%s: %d x %016llx pdf %016llx", name, (int)status,
           (unsigned long long)hash_numbers(x, g->dim * POINTS),
           (unsigned long long)hash_numbers(pdf, POINTS));
    for (size_t j = 0; j < g->dim; j++)
        show("", x[j * POINTS + 2]);
    status = buffon_density_pdf(pdf, x, POINTS, g);
    printf(" pdf %d %016llx", (int)status, (unsigned long long)hash_numbers(pdf, POINTS));
    status = buffon_density_log_pdf(pdf, x, POINTS, g);
    printf(" log %d %016llx", (int)status, (unsigned long long)hash_numbers(pdf, POINTS));
    status = buffon_density_invert(u, x, POINTS, g);
    printf(" invert %d %016llx\n", (int)status,
           (unsigned long long)hash_numbers(u, g->uniforms * POINTS));
}

static double logistic_cdf(double x, void *ctx)
{
    (void)ctx;
    return x < 0 ? 0.5 / (1 - x) : 1 - 0.5 / (1 + x);
}

static double logistic_pdf(double x, void *ctx)
{
    const double d = 1 + (x < 0 ? -x : x);
    (void)ctx;
    return 0.5 / (d * d);
}

static double root(double u, void *ctx)
{
    (void)ctx;
    return sqrt(u);
}

static double twice(double x, void *ctx)
{
    (void)ctx;
    return 2 * x;
}

static void show_densities(void)
{
    static const double axis[] = {1, -2, 0.5}, from[] = {1, 2, 3}, centre[] = {4, 4, 9};
    static const double lo[] = {-1, 0, 1e10, -1e300}, hi[] = {2, 1e-300, 1e10 + 1, 1e300};
    static const double knots[] = {-3, -1, 0, 0.5, 4}, F[] = {0, 0.125, 0.5, 0.75, 1};
    const buffon_inversion quantile = {.quantile = root, .cdf = NULL, .pdf = twice};
    const buffon_inversion newton = {.cdf = logistic_cdf, .pdf = logistic_pdf};
    const buffon_inversion table = {.x = knots, .F = F, .count = 5};
    const buffon_density parts[] = {buffon_segment(-2, 5), buffon_disk(3)};
    const struct {
        const char *name;
        buffon_density g;
    } list[] = {{"segment", buffon_segment(-1, 2)},
                {"box", buffon_box(lo, hi, 4)},
                {"disk", buffon_disk(1.5)},
                {"disk concentric", buffon_disk_concentric(1.5)},
                {"sphere", buffon_sphere()},
                {"cap", buffon_cap(0.75)},
                {"cap about", buffon_cap_about(-0.25, axis)},
                {"cap angle", buffon_cap_angle(1e-3, axis)},
                {"cap height", buffon_cap_height(1e-12, axis)},
                {"cap of sphere", buffon_cap_of_sphere(from, centre, 2)},
                {"hemisphere", buffon_hemisphere()},
                {"hemisphere about", buffon_hemisphere_about(axis)},
                {"hemisphere cosine", buffon_hemisphere_cosine()},
                {"hemisphere cosine about", buffon_hemisphere_cosine_about(axis)},
                {"exponential", buffon_exponential(0.25)},
                {"normal", buffon_normal(-1.5, 3)},
                {"quantile", buffon_inverse(&quantile)},
                {"newton", buffon_inverse(&newton)},
                {"table", buffon_inverse(&table)},
                {"product", buffon_density_product(parts, 2)}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        show_density(list[i].name, &list[i].g);
    family_make();
    for (const family_case *one = family; one < family + family_count; one++)
        show_density(one->name, &one->g);
}

/* ---- elementary functions ---- */

/* Of numbers from -spread to spread, and with them their reciprocals. */
static void show_function(const char *name, void (*function)(double *y, const double *x, size_t n),
                          double spread)
{
    const buffon_rng_key key = {.seed = 5};
    double x[POINTS], y[POINTS];
    buffon_rng_uniforms_at(x, POINTS, &key, 0, 0);
    for (size_t i = 0; i < POINTS; i++) {
        x[i] = spread * (2 * x[i] - 1);
        x[i] = i % 4 == 3 ? 1 / x[i] : x[i];
    }
    function(y, x, POINTS);
    printf("%s: %016llx\n", name, (unsigned long long)hash_numbers(y, POINTS));
}

static void sine_over_cosine(double *y, const double *x, size_t n)
{
    double c[POINTS];
    buffon_math_sincospi(y, c, x, n);
    for (size_t i = 0; i < n; i++)
        y[i] /= c[i];
}

static void angle_from_one(double *y, const double *x, size_t n)
{
    double one[POINTS];
    for (size_t i = 0; i < n; i++)
        one[i] = i % 2 ? -1 : 1;
    buffon_math_atan2pi(y, x, one, n);
}

static void show_functions(void)
{
    show_function("sincospi", sine_over_cosine, 1e3);
    show_function("sinpi", buffon_math_sinpi, 4);
    show_function("cospi", buffon_math_cospi, 4);
    show_function("atan2pi", angle_from_one, 4);
    show_function("acospi", buffon_math_acospi, 1);
    show_function("log", buffon_math_log, 1e9);
    show_function("log1p", buffon_math_log1p, 2);
    show_function("exp", buffon_math_exp, 800);
    show_function("expm1", buffon_math_expm1, 60);
    show_function("cbrt", buffon_math_cbrt, 1e9);
    show_function("erfc", buffon_math_erfc, 28);
    show_function("normal cdf", buffon_math_normal_cdf, 40);
    show_function("normal quantile", buffon_math_normal_quantile, 1);
}

/* ---- points, generator, sampler ---- */

static void show_points(void)
{
    static double u[3 * POINTS];
    const struct {
        const char *name;
        buffon_points points;
    } list[] = {{"random points", buffon_points_random()},
                {"antithetic points", buffon_points_antithetic()},
                {"jitter(7)", buffon_points_jitter(7)},
                {"jitter(10000)", buffon_points_jitter(10000)},
                {"Sobol' nested", buffon_points_sobol(BUFFON_SCRAMBLE_OWEN)},
                {"Sobol' linear", buffon_points_sobol(BUFFON_SCRAMBLE_LINEAR)},
                {"Sobol' shift", buffon_points_sobol(BUFFON_SCRAMBLE_SHIFT)},
                {"Sobol'", buffon_points_sobol(BUFFON_SCRAMBLE_NONE)}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        for (size_t dim = 1; dim <= 3; dim++) {
            const buffon_points *points = &list[i].points;
            buffon_points_block block = {.key = {.seed = 3, .stratum = 2},
                                         .n = POINTS,
                                         .first = (UINT64_C(1) << 33) + 5,
                                         .dim = dim};
            const size_t size = points->table_size ? points->table_size(dim, points) : 0;
            block.table = malloc(size > 0 ? size : 1);
            const int failed = block.table == NULL ||
                               (points->prepare && points->prepare(&block, points) != 0) ||
                               points->fill(u, &block, points) != 0;
            printf("%s: %d %016llx\n", list[i].name, failed,
                   (unsigned long long)hash_numbers(u, dim * POINTS));
            free(block.table);
        }
    }
}

static void show_rng(void)
{
    buffon_rng rng = buffon_rng_make(UINT64_C(0x123456789abcdef), 42);
    for (int i = 0; i < 5; i++)
        printf("word %016llx\n", (unsigned long long)buffon_rng_word(&rng));
    buffon_rng_seek(&rng, UINT64_C(1) << 60);
    for (int i = 0; i < 5; i++) {
        const double next = buffon_rng_next(&rng), single = (double)buffon_rng_float(&rng);
        printf("next");
        show("", next);
        show("", single);
        printf(" %llu\n", (unsigned long long)buffon_rng_below(&rng, 1000003));
    }
}

static void show_sampler(void)
{
    static double x[2 * POINTS];
    const buffon_density g = buffon_disk(1);
    size_t dim = 2;
    const buffon_integrand f = {.scalar = problem_hill, .dim = 2, .ctx = &dim};
    buffon_rng rng = buffon_rng_make(5, 5);
    buffon_rejection_report r;
    const buffon_status status = buffon_rejection_sample(x, POINTS, &r, &f, &g, 3.5, &rng, 0);
    printf("rejection sampler: %d %llu %016llx", (int)status, (unsigned long long)r.tries,
           (unsigned long long)hash_numbers(x, 2 * POINTS));
    show("worst", r.worst);
    printf("\n");
}

/* ---- quantiles and statistics ---- */

static void show_quantiles(void)
{
    static const double p[] = {1e-300, 1e-20, 1e-5, 0.01, 0.2, 0.5, 0.75, 0.999};
    static const double dof[] = {1, 1.5, 4, 30, 1e6};
    for (size_t i = 0; i < sizeof p / sizeof *p; i++) {
        printf("quantiles at %g:", p[i]);
        show("normal", buffon_normal_quantile(p[i]));
        for (size_t k = 0; k < sizeof dof / sizeof *dof; k++) {
            show("t", buffon_student_upper(p[i], dof[k]));
            show("beta", buffon_beta_quantile(p[i], dof[k], 2.5));
        }
        printf("\n");
    }
}

static void show_intervals(void)
{
    for (uint64_t hits = 0; hits <= 40; hits += 8) {
        double lo = 0, hi = 0;
        buffon_status status = buffon_interval_clopper_pearson(&lo, &hi, hits, 40, 0.95);
        printf("%llu of 40: %d", (unsigned long long)hits, (int)status);
        show("", lo);
        show("", hi);
        status = buffon_interval_wilson(&lo, &hi, hits, 40, 0.99);
        printf(" %d", (int)status);
        show("", lo);
        show("", hi);
        printf("\n");
    }
}

static void show_stats(void)
{
    static double y[POINTS];
    static const double scales[] = {1, 1e300, 1e-300, 0x1p-1060};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        buffon_rng rng = buffon_rng_make(9, i);
        buffon_stats s = {0};
        buffon_rng_fill(y, POINTS, &rng);
        for (size_t k = 0; k < POINTS; k++)
            y[k] = scales[i] / y[k];
        buffon_stats_add(&s, y, POINTS);
        const buffon_summary summary = buffon_stats_summary(&s);
        printf("statistics at %g:", scales[i]);
        show("mean", summary.mean);
        show("variance", summary.variance);
        show("error", summary.std_error);
        show("ess", summary.ess);
        show("share", summary.max_share);
        show("tail", summary.tail_index);
        printf("\n");
    }
}

static int limit(const char *wanted)
{
    for (int level = BUFFON_LEVEL_SCALAR; level <= BUFFON_LEVEL_AVX512; level++) {
        if (strcmp(wanted, buffon_level_string((buffon_level)level)) == 0)
            return (int)buffon_cpu_limit((buffon_level)level) == level ? 0 : 77;
    }
    fprintf(stderr, "bits: there is no level %s\n", wanted);
    return 2;
}

int main(int argc, char **argv)
{
    const int lacking = argc > 1 ? limit(argv[1]) : 0;
    if (lacking)
        return lacking;
    show_rng();
    show_points();
    show_densities();
    show_functions();
    show_sampler();
    show_quantiles();
    show_intervals();
    show_stats();
    for (int i = 0; i < PROBLEMS; i++)
        show_problem(&problems[i]);
    return 0;
}
