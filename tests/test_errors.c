/* Whatever is senseless is refused with its own status before anything is drawn: no call of the
 * integrand, the generator and the partial as they were, and outputs that say so. */
#include <stdlib.h>

#include "problems.h"
#include "tap.h"

/* Requests that no memory can hold are refused, not reported as errors of this program. */
const char *__asan_default_options(void);
const char *__tsan_default_options(void);
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1";
}
const char *__tsan_default_options(void)
{
    return "allocator_may_return_null=1";
}

static int calls; /* of the integrands */

static double scalar(const double *x, void *ctx)
{
    (void)ctx;
    calls++;
    return x[0];
}

static int batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)x;
    (void)ctx;
    calls++;
    for (size_t i = 0; i < 3 * n; i++)
        f[i] = 1;
    return 0;
}

/* ---- what a refused call must leave ---- */

enum { COMPONENTS = 3 };
static buffon_estimate e[COMPONENTS];

static void before(void)
{
    memset(e, 0x55, sizeof e);
    calls = 0;
}

static void after(buffon_status got, buffon_status expected, size_t components, const char *what)
{
    int good = got == expected && calls == 0;
    for (size_t k = 0; k < components; k++)
        good &= is_refusal(&e[k], expected) && e[k].bad_index == UINT64_MAX && e[k].doubts == 0;
    if (!tap_ok(good, "%s: %s", buffon_status_name(expected), what))
        tap_note("got %s after %d calls", buffon_status_name(got), calls);
}

#define REFUSES(expected, call, what)                                                              \
    do {                                                                                           \
        before();                                                                                  \
        const buffon_status got_ = (call);                                                         \
        after(got_, expected, 1, what);                                                            \
    } while (0)

/* ---- every estimator ---- */

static const double lo[9] = {0}, hi[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
static const char *const estimators[] = {"uniform",     "rejection",       "importance",
                                         "expectation", "self-normalised", "inverse CDF",
                                         "stratified",  "Neyman"};

enum { ESTIMATORS = sizeof estimators / sizeof estimators[0] };

static double quantile(double u, void *ctx)
{
    (void)ctx;
    return u;
}

static double density(double x, void *ctx)
{
    (void)x;
    (void)ctx;
    return 1;
}

static buffon_status estimate(int estimator, const buffon_integrand *f, const buffon_run *run)
{
    const buffon_density box = buffon_box(lo, hi, 1);
    const buffon_integrand p = {.scalar = scalar, .dim = 1};
    const buffon_inversion how = {.quantile = quantile, .pdf = density};
    const buffon_stratum list[] = {{.density = &box}, {.density = &box}};
    const buffon_strata strata = {.stratum = list, .count = 2, .allocation = estimator == 7};
    switch (estimator) {
    case 0:
        return buffon_uniform(e, f, lo, hi, run);
    case 1:
        return buffon_rejection(e, f, lo, hi, 1, run);
    case 2:
        return buffon_importance(e, f, &box, run);
    case 3:
        return buffon_expectation(e, f, &box, run);
    case 4:
        return buffon_self_normalised(e, f, &p, &box, run);
    case 5:
        return buffon_inverse_cdf(e, f, &how, run);
    default:
        return buffon_stratified(e, f, &strata, run);
    }
}

/* One fault in the options, for all estimators, with a partial that must not change. */
static void bad_run(buffon_status expected, const buffon_run *run, const char *what)
{
    const buffon_integrand f = {.scalar = scalar, .dim = 1};
    for (int i = 0; i < ESTIMATORS; i++) {
        char name[128];
        snprintf(name, sizeof name, "%s: %s", estimators[i], what);
        REFUSES(expected, estimate(i, &f, run), name);
    }
    double x = 0;
    const buffon_density box = buffon_box(lo, hi, 1);
    const buffon_status got = buffon_sample_at(&x, &box, 5, run);
    if (expected != BUFFON_E_SAMPLES && expected != BUFFON_E_MISMATCH)
        tap_ok(got == expected && isnan(x), "%s: sample_at: %s", buffon_status_name(expected),
               what);
}

static void test_numbers(void)
{
    static const double outside[] = {-0.5, 1, 2, NAN, INFINITY, -INFINITY};
    static const double tolerances[] = {-1e-300, NAN, INFINITY, -INFINITY};
    static const uint32_t blocks[] = {1, 8, 15, 17, 1000, 1u << 21, 3u << 19, UINT32_MAX};
    char what[64];
    for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
        snprintf(what, sizeof what, "confidence %g", outside[i]);
        bad_run(BUFFON_E_CONFIDENCE, &(buffon_run){.confidence = outside[i]}, what);
    }
    for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
        snprintf(what, sizeof what, "tolerance %g", tolerances[i]);
        bad_run(BUFFON_E_TOLERANCE, &(buffon_run){.abs_tol = tolerances[i]}, what);
        bad_run(BUFFON_E_TOLERANCE, &(buffon_run){.rel_tol = tolerances[i]}, what);
    }
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
        snprintf(what, sizeof what, "block %lu", (unsigned long)blocks[i]);
        bad_run(BUFFON_E_BLOCK, &(buffon_run){.block = blocks[i]}, what);
    }
    bad_run(BUFFON_E_SAMPLES, &(buffon_run){.samples = (UINT64_C(1) << 62) + 1},
            "2^62 + 1 samples");
    bad_run(BUFFON_E_SAMPLES, &(buffon_run){.samples = UINT64_MAX}, "2^64 - 1 samples");
}

static void test_flags(void)
{
    buffon_run run = {.reserved_int = 1};
    bad_run(BUFFON_E_RESERVED, &run, "reserved_int");
    run.reserved_int = 0;
    for (int i = 0; i < 8; i += 7) {
        run.reserved[i] = 1;
        bad_run(BUFFON_E_RESERVED, &run, "a reserved word of the options");
        run.reserved[i] = 0;
    }
    bad_run(BUFFON_E_RESERVED, &(buffon_run){.on_nonfinite = 2}, "on_nonfinite 2");
    bad_run(BUFFON_E_RESERVED, &(buffon_run){.on_nonfinite = -1}, "on_nonfinite -1");
    bad_run(BUFFON_E_PART, &(buffon_run){.part = 1}, "a part of no parts");
    bad_run(BUFFON_E_PART, &(buffon_run){.parts = 2}, "parts without a partial");
    bad_run(BUFFON_E_PART, &(buffon_run){.covariance = 1}, "covariance without a partial");
    buffon_partial partial = {0};
    run = (buffon_run){.part = 3, .parts = 3, .partial = &partial};
    bad_run(BUFFON_E_PART, &run, "part 3 of 3");
    run.part = 1;
    run.abs_tol = 1;
    bad_run(BUFFON_E_PART, &run, "a part with a tolerance");
    run.abs_tol = 0;
    run.rel_tol = 1;
    bad_run(BUFFON_E_PART, &run, "a part with a relative tolerance");
    tap_ok(partial.more == NULL, "the partial is still empty");
}

static uint64_t round_to(size_t dim, const buffon_points *self)
{
    (void)dim;
    return self->param[0];
}

static void test_points(void)
{
    const buffon_points random = buffon_points_random();
    buffon_points points = random;
    const buffon_run run = {.samples = 100, .points = &points};
    points.fill = NULL;
    bad_run(BUFFON_E_POINTS, &run, "points without fill");
    points = random, points.replicates = 257;
    bad_run(BUFFON_E_POINTS, &run, "257 replicates");
    points = random, points.design = (buffon_design)7;
    bad_run(BUFFON_E_POINTS, &run, "design 7");
    points = random, points.design = BUFFON_DESIGN_NET, points.replicates = 2;
    bad_run(BUFFON_E_POINTS, &run, "two nets");
    for (int i = 0; i < 3; i++) {
        points = random, points.reserved[i] = 1;
        bad_run(BUFFON_E_RESERVED, &run, "a reserved word of the points");
    }
    points = random, points.round = round_to;
    bad_run(BUFFON_E_POINTS, &run, "points for no such dimension");
    points.param[0] = (UINT64_C(1) << 48) + 1;
    bad_run(BUFFON_E_POINTS, &run, "points by more than 2^48");
    points.param[0] = 3;
    points.doubling = 1;
    bad_run(BUFFON_E_POINTS, &run, "a power of two of points, by threes");
    points.doubling = 0;
    points.design = BUFFON_DESIGN_STRATIFIED;
    bad_run(BUFFON_E_POINTS, &run, "pairs in threes");
    points = random, points.design = BUFFON_DESIGN_ANTITHETIC;
    bad_run(BUFFON_E_POINTS, &run, "pairs one at a time");
    points = random, points.limit = 49;
    bad_run(BUFFON_E_SAMPLES, &run, "more samples than the points hold");
    points = buffon_points_jitter(0);
    bad_run(BUFFON_E_POINTS, &run, "jitter(0)");
    points = buffon_points_jitter((UINT64_C(1) << 40) + 1);
    bad_run(BUFFON_E_POINTS, &run, "jitter of more than 2^40 cells");
}

static void test_integrands(void)
{
    const buffon_integrand good = {.scalar = scalar, .dim = 1};
    buffon_integrand f;
    for (int i = 0; i < ESTIMATORS; i++) {
        REFUSES(BUFFON_E_NULL, estimate(i, NULL, NULL), "no integrand");
        f = good, f.scalar = NULL;
        REFUSES(BUFFON_E_INTEGRAND, estimate(i, &f, NULL), "neither scalar nor batch");
        f = good, f.batch = batch;
        REFUSES(BUFFON_E_INTEGRAND, estimate(i, &f, NULL), "both");
        f = good, f.components = 3;
        REFUSES(BUFFON_E_INTEGRAND, estimate(i, &f, NULL), "a scalar of three components");
        after(estimate(i, &f, NULL), BUFFON_E_INTEGRAND, 3, "and all three outputs say so");
        f = good, f.dim = 0;
        REFUSES(BUFFON_E_DIM, estimate(i, &f, NULL), "no dimension");
        f = good, f.scalar = NULL, f.batch = batch, f.components = ((size_t)1 << 20) + 1;
        REFUSES(BUFFON_E_DIM, estimate(i, &f, NULL), "too many components");
        f.components = SIZE_MAX;
        REFUSES(BUFFON_E_DIM, estimate(i, &f, NULL), "SIZE_MAX components");
        for (int k = 0; k < 4; k++) {
            f = good, f.reserved[k] = 1;
            REFUSES(BUFFON_E_RESERVED, estimate(i, &f, NULL), "a reserved word of the integrand");
        }
        if (i >= 2) { /* the first two take their dimension from f */
            f = good, f.dim = 2;
            REFUSES(BUFFON_E_DIM, estimate(i, &f, NULL), "a dimension that is not the density's");
        }
    }
}

/* ---- domains ---- */

static void test_domains(void)
{
    static const double bad[][2] = {{1, 1},   {2, 1},         {NAN, 1},
                                    {0, NAN}, {-INFINITY, 1}, {0, INFINITY}};
    for (size_t dim = 1; dim <= 9; dim += 4) {
        const buffon_integrand f = {.scalar = scalar, .dim = dim};
        REFUSES(BUFFON_E_NULL, buffon_uniform(e, &f, NULL, hi, NULL), "lo is NULL");
        REFUSES(BUFFON_E_NULL, buffon_uniform(e, &f, lo, NULL, NULL), "hi is NULL");
        REFUSES(BUFFON_E_NULL, buffon_rejection(e, &f, NULL, hi, 1, NULL), "lo is NULL");
        REFUSES(BUFFON_E_NULL, buffon_rejection(e, &f, lo, NULL, 1, NULL), "hi is NULL");
        for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
            for (size_t j = 0; j < dim; j += 4) {
                double a[9] = {0}, b[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
                char what[64];
                a[j] = bad[i][0];
                b[j] = bad[i][1];
                snprintf(what, sizeof what, "bounds %g, %g in coordinate %zu of %zu", a[j], b[j], j,
                         dim);
                REFUSES(BUFFON_E_DOMAIN, buffon_uniform(e, &f, a, b, NULL), what);
                REFUSES(BUFFON_E_DOMAIN, buffon_rejection(e, &f, a, b, 1, NULL), what);
            }
        }
    }
    static const double heights[] = {0, -1, NAN, INFINITY, -INFINITY};
    const buffon_integrand f = {.scalar = scalar, .dim = 1};
    for (size_t i = 0; i < sizeof heights / sizeof *heights; i++)
        REFUSES(BUFFON_E_HEIGHT, buffon_rejection(e, &f, lo, hi, heights[i], NULL), "height");
}

/* ---- densities ---- */

static void bad_density(buffon_status expected, const buffon_density *g, const char *what)
{
    const buffon_integrand f = {.scalar = scalar, .dim = g != NULL && g->dim > 0 ? g->dim : 1};
    const buffon_stratum list[] = {{.density = g}};
    const buffon_strata strata = {.stratum = list, .count = 1};
    double x[4] = {0};
    REFUSES(expected, buffon_importance(e, &f, g, NULL), what);
    REFUSES(expected, buffon_self_normalised(e, &f, &f, g, NULL), what);
    REFUSES(expected, buffon_stratified(e, &f, &strata, NULL), what);
    if (expected == BUFFON_E_UNSUPPORTED)
        return;
    REFUSES(expected, buffon_expectation(e, &f, g, NULL), what);
    tap_ok(buffon_sample_at(x, g, 0, NULL) == expected && (g == NULL || g->dim == 0 || isnan(x[0])),
           "%s: sample_at: %s", buffon_status_name(expected), what);
}

static int copy(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    (void)pdf;
    memcpy(x, u, n * g->dim * sizeof *x);
    return 0;
}

static int ones(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    (void)x;
    (void)g;
    for (size_t i = 0; i < n; i++)
        pdf[i] = 1;
    return 0;
}

static void test_densities(void)
{
    static const buffon_density_ops ops = {.sample = copy, .pdf = ones};
    static const buffon_density_ops bare = {.sample = copy}, none = {.pdf = ones};
    static const buffon_density_ops newer = {.sample = copy, .pdf = ones, .reserved = {0, 0, 0, 1}};
    static const double up[] = {0, 0, 1}, nothing[] = {0, 0, 0};
    const buffon_inversion how = {.quantile = quantile};
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &ops};
    bad_density(BUFFON_E_NULL, NULL, "no density");
    g.ops = NULL;
    bad_density(BUFFON_E_NULL, &g, "a density without a table");
    g.ops = &none;
    bad_density(BUFFON_E_NULL, &g, "a density that cannot sample");
    g.ops = &newer;
    bad_density(BUFFON_E_RESERVED, &g, "a reserved word of the table");
    g.ops = &bare;
    bad_density(BUFFON_E_UNSUPPORTED, &g, "a density without a pdf");
    g = buffon_inverse(&how);
    bad_density(BUFFON_E_UNSUPPORTED, &g, "a quantile function without a pdf");
    g = (buffon_density){.uniforms = 1, .ops = &ops};
    bad_density(BUFFON_E_DIM, &g, "a density without coordinates");
    g = (buffon_density){.dim = 1, .ops = &ops};
    bad_density(BUFFON_E_DIM, &g, "a density without uniforms");
    g = (buffon_density){.uniforms = 1, .dim = 1, .ops = &ops, .reserved = {0, 0, 0, 1}};
    bad_density(BUFFON_E_RESERVED, &g, "a reserved word of the density");
    g = buffon_cap(1);
    bad_density(BUFFON_E_SHAPE, &g, "a cap with its cut at 1");
    g = buffon_cap(-1.0000001);
    bad_density(BUFFON_E_SHAPE, &g, "a cap with its cut below -1");
    g = buffon_cap(NAN);
    bad_density(BUFFON_E_SHAPE, &g, "a cap with its cut at NaN");
    g = buffon_cap_about(0, nothing);
    bad_density(BUFFON_E_SHAPE, &g, "a cap about no axis");
    g = buffon_cap_angle(4, up);
    bad_density(BUFFON_E_SHAPE, &g, "a cap of more than the sphere");
    g = buffon_disk(0);
    bad_density(BUFFON_E_SHAPE, &g, "a disk without a radius");
    g = buffon_segment(1, 0);
    bad_density(BUFFON_E_DOMAIN, &g, "a segment from 1 to 0");
    g = buffon_inverse(NULL);
    bad_density(BUFFON_E_NULL, &g, "an inverse CDF of nothing");
    g = (buffon_density){.uniforms = 1, .dim = 1, .status = BUFFON_E_TABLE, .ops = &ops};
    bad_density(BUFFON_E_TABLE, &g, "any status that a density carries");
}

/* Sizes whose product no memory can hold. */
static void test_sizes(void)
{
    static const buffon_density_ops ops = {.sample = copy, .pdf = ones};
    const size_t many = (size_t)UINT32_MAX / 2;
    buffon_density g = {.uniforms = many, .dim = many, .ops = &ops};
    buffon_integrand f = {.scalar = scalar, .dim = many};
    REFUSES(BUFFON_E_NOMEM, buffon_importance(e, &f, &g, &(buffon_run){.block = 1u << 20}),
            "2^31 coordinates in blocks of 2^20");
    g.uniforms = SIZE_MAX;
    REFUSES(SIZE_MAX > UINT32_MAX ? BUFFON_E_DIM : BUFFON_E_NOMEM,
            buffon_importance(e, &f, &g, NULL), "more uniforms than there are dimensions");
    double x;
    g.dim = 1;
    tap_ok(buffon_sample_at(&x, &g, 0, NULL) == BUFFON_E_DIM, "sample_at: nor for one point");
    g.uniforms = 1;
    g.dim = f.dim = SIZE_MAX;
    REFUSES(SIZE_MAX > UINT32_MAX ? BUFFON_E_DIM : BUFFON_E_NOMEM,
            buffon_importance(e, &f, &g, NULL), "SIZE_MAX coordinates");
}

/* ---- strata ---- */

static void test_strata(void)
{
    const double plane_lo[] = {0, 0}, plane_hi[] = {1, 1};
    const buffon_density box = buffon_segment(0, 1), plane = buffon_box(plane_lo, plane_hi, 2);
    const buffon_integrand f = {.scalar = scalar, .dim = 1}, g = {.scalar = scalar, .dim = 2};
    const buffon_integrand three = {.batch = batch, .dim = 1, .components = 3};
    const buffon_integrand explicitly = {.scalar = scalar, .dim = 1, .components = 1};
    buffon_stratum list[2] = {{.density = &box}, {.density = &box}};
    buffon_strata strata = {.stratum = list, .count = 2};
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    REFUSES(BUFFON_E_NULL, buffon_stratified(e, &f, NULL, NULL), "no strata");
    strata.stratum = NULL;
    REFUSES(BUFFON_E_NULL, buffon_stratified(e, &f, &strata, NULL), "no list of strata");
    strata.stratum = list;
    REFUSES(BUFFON_E_NULL, buffon_stratified(e, NULL, &strata, NULL), "no integrand at all");
    strata.count = 0;
    REFUSES(BUFFON_E_STRATA, buffon_stratified(e, &f, &strata, NULL), "no stratum");
    strata.count = 65537;
    REFUSES(BUFFON_E_STRATA, buffon_stratified(e, &f, &strata, NULL), "65537 strata");
    strata.count = 2;
    strata.allocation = 2;
    REFUSES(BUFFON_E_RESERVED, buffon_stratified(e, &f, &strata, NULL), "allocation 2");
    strata.allocation = 0;
    for (int i = 0; i < 4; i++) {
        strata.reserved[i] = 1;
        REFUSES(BUFFON_E_RESERVED, buffon_stratified(e, &f, &strata, NULL), "a reserved word");
        strata.reserved[i] = 0;
    }
    for (int i = 0; i < 2; i++) {
        list[1].reserved[i] = 1;
        REFUSES(BUFFON_E_RESERVED, buffon_stratified(e, &f, &strata, NULL), "of a stratum");
        list[1].reserved[i] = 0;
    }
    for (size_t i = 0; i < 3; i++) {
        list[1].weight = bad[i];
        REFUSES(BUFFON_E_STRATA, buffon_stratified(e, &f, &strata, NULL), "a weight");
        list[1].weight = 0;
        list[1].share = bad[i];
        REFUSES(BUFFON_E_STRATA, buffon_stratified(e, &f, &strata, NULL), "a share");
        list[1].share = 0;
    }
    list[1].share = -1;
    REFUSES(BUFFON_E_STRATA, buffon_stratified(e, &f, &strata, NULL), "a share of -1");
    list[0].share = list[1].share = 1e308;
    REFUSES(BUFFON_E_STRATA, buffon_stratified(e, &f, &strata, NULL),
            "shares whose sum is infinite");
    list[0].share = list[1].share = 0;
    list[1].density = NULL;
    REFUSES(BUFFON_E_NULL, buffon_stratified(e, &f, &strata, NULL), "a stratum without a density");
    list[1].density = &plane;
    REFUSES(BUFFON_E_DIM, buffon_stratified(e, &f, &strata, NULL),
            "strata of different dimensions");
    list[1].f = &g;
    REFUSES(BUFFON_E_DIM, buffon_stratified(e, &f, &strata, NULL), "each with its own integrand");
    list[1] = (buffon_stratum){.density = &box, .f = &three};
    REFUSES(BUFFON_E_DIM, buffon_stratified(e, &f, &strata, NULL), "different components");
    list[1].f = &explicitly;
    tap_ok(buffon_stratified(e, &f, &strata, &(buffon_run){.samples = 100}) == BUFFON_OK,
           "0 components and 1 component are the same");
    double x = 0;
    tap_ok(buffon_stratum_sample_at(&x, &strata, 2, 0, NULL) == BUFFON_E_STRATA && isnan(x),
           "sample_at: stratum 2 of 2");
    tap_ok(buffon_stratum_sample_at(&x, NULL, 0, 0, NULL) == BUFFON_E_NULL &&
               buffon_stratum_sample_at(NULL, &strata, 0, 0, NULL) == BUFFON_E_NULL,
           "sample_at: NULL");
}

/* ---- the rest ---- */

static void test_outputs(void)
{
    const buffon_integrand f = {.scalar = scalar, .dim = 1};
    const buffon_density box = buffon_segment(0, 1);
    const buffon_inversion how = {.quantile = quantile, .pdf = density};
    const buffon_stratum list[] = {{.density = &box}};
    const buffon_strata strata = {.stratum = list, .count = 1};
    calls = 0;
    tap_ok(buffon_uniform(NULL, &f, lo, hi, NULL) == BUFFON_E_NULL &&
               buffon_rejection(NULL, &f, lo, hi, 1, NULL) == BUFFON_E_NULL &&
               buffon_rejection(NULL, &f, lo, hi, -1, NULL) == BUFFON_E_NULL &&
               buffon_importance(NULL, &f, &box, NULL) == BUFFON_E_NULL &&
               buffon_expectation(NULL, &f, &box, NULL) == BUFFON_E_NULL &&
               buffon_self_normalised(NULL, &f, &f, &box, NULL) == BUFFON_E_NULL &&
               buffon_self_normalised(NULL, &f, NULL, &box, NULL) == BUFFON_E_NULL &&
               buffon_inverse_cdf(NULL, &f, &how, NULL) == BUFFON_E_NULL &&
               buffon_inverse_cdf(NULL, &f, NULL, NULL) == BUFFON_E_NULL &&
               buffon_stratified(NULL, &f, &strata, NULL) == BUFFON_E_NULL &&
               buffon_stratified(NULL, NULL, NULL, NULL) == BUFFON_E_NULL && calls == 0,
           "no place for the result");
    const buffon_integrand three = {.batch = batch, .dim = 1, .components = 3};
    REFUSES(BUFFON_E_NULL, buffon_self_normalised(e, &f, NULL, &box, NULL), "no second integrand");
    REFUSES(BUFFON_E_DIM, buffon_self_normalised(e, &f, &three, &box, NULL), "one of components");
}

int main(void)
{
    test_numbers();
    test_flags();
    test_points();
    test_integrands();
    test_domains();
    test_densities();
    test_sizes();
    test_strata();
    test_outputs();
    return tap_done();
}
