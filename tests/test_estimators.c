/* Each estimator against exact values: the value within 6.1 exact standard errors (1e-9), the
 * variance within as many of its own, whose law follows from the exact fourth moment. */
#include <stdlib.h>

#include "law.h"
#include "problems.h"

#define SAMPLES 200000
#define LIMIT 6.11 /* standard errors that a check of 1e-9 allows */

static const double zero = 0, one = 1, unit_lo[10] = {0},
                    unit_hi[10] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1};

/* An estimate from the raw moments m[1] to m[4] of its primary estimates. */
static void judge(const char *name, buffon_status status, const buffon_estimate *e,
                  const double m[5])
{
    const double n = (double)e->samples, mean = m[1], var = m[2] - mean * mean;
    const double fourth =
        m[4] - 4 * mean * m[3] + 6 * mean * mean * m[2] - 3 * mean * mean * mean * mean;
    const double z = (e->value - mean) / sqrt(var / n);
    const double r = (e->variance / var - 1) / sqrt((fourth / (var * var) - 1) / n);
    tap_ok(status == BUFFON_OK && e->doubts == 0 && fabs(z) < LIMIT && fabs(r) < LIMIT &&
               fabs(e->std_error / sqrt(e->variance / n) - 1) < 1e-13 && e->lo < e->value &&
               e->value < e->hi,
           "%s: %.6g +- %.2g, exactly %.6g: z = %.2f; of the variance %.2f", name, e->value,
           e->std_error, mean, z, r);
}

/* ---- uniform ---- */

static double power(const double *x, void *ctx)
{
    return pow(x[0], *(const double *)ctx);
}

/* prod 2 x_j, whose k-th moment is (2^k / (k + 1))^d. */
static double product(const double *x, void *ctx)
{
    double y = 1;
    for (size_t j = 0; j < *(const size_t *)ctx; j++)
        y *= 2 * x[j];
    return y;
}

static double ball(const double *x, void *ctx)
{
    double sum = 0;
    for (size_t j = 0; j < *(const size_t *)ctx; j++)
        sum += x[j] * x[j];
    return sum < 1;
}

static void test_uniform(void)
{
    buffon_estimate e;
    double m[5];
    for (size_t d = 1; d <= 10; d += d < 4 ? 1 : 3) {
        const buffon_integrand f = {.scalar = product, .dim = d, .ctx = &d};
        for (int k = 1; k < 5; k++)
            m[k] = pow(ldexp(1, k) / (k + 1), (double)d);
        const buffon_status status =
            buffon_uniform(&e, &f, unit_lo, unit_hi, &(buffon_run){.samples = SAMPLES, .seed = d});
        char name[64];
        snprintf(name, sizeof name, "uniform, prod 2x, d = %zu", d);
        judge(name, status, &e, m);
    }
    double p = 2;
    const buffon_integrand f = {.scalar = power, .dim = 1, .ctx = &p};
    const double lo = -1, hi = 2;
    for (int k = 1; k < 5; k++)
        m[k] = pow(3, k) * (pow(2, 2 * k + 1) + 1) / (2 * k + 1) / 3;
    judge("uniform, x^2 on (-1, 2)",
          buffon_uniform(&e, &f, &lo, &hi, &(buffon_run){.samples = SAMPLES}), &e, m);
    static const double cube_lo[] = {-1, -1, -1, -1, -1}, cube_hi[] = {1, 1, 1, 1, 1};
    size_t d = 5;
    const buffon_integrand g = {.scalar = ball, .dim = d, .ctx = &d};
    for (int k = 1; k < 5; k++)
        m[k] = pow(32, k - 1) * 5.2637890139143245967;
    judge("uniform, the ball in d = 5",
          buffon_uniform(&e, &g, cube_lo, cube_hi, &(buffon_run){.samples = SAMPLES}), &e, m);
}

/* ---- rejection ---- */

static void test_rejection(void)
{
    buffon_estimate e;
    double p = 3, m[5];
    const buffon_integrand f = {.scalar = power, .dim = 1, .ctx = &p};
    for (int k = 1; k < 5; k++)
        m[k] = pow(1.5, k - 1) / 4;
    judge("rejection, x^3 under 1.5",
          buffon_rejection(&e, &f, &zero, &one, 1.5, &(buffon_run){.samples = SAMPLES}), &e, m);
    size_t d = 3;
    const buffon_integrand g = {.scalar = ball, .dim = d, .ctx = &d};
    for (int k = 1; k < 5; k++)
        m[k] = LAW_PI / 6;
    judge("rejection, an eighth of the ball, where h is attained",
          buffon_rejection(&e, &g, unit_lo, unit_hi, 1, &(buffon_run){.samples = SAMPLES}), &e, m);
}

/* ---- importance ---- */

static double height(const double *x, void *ctx)
{
    (void)ctx;
    return x[2];
}

static double height2(const double *x, void *ctx)
{
    (void)ctx;
    return x[2] * x[2];
}

static double radius2(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0] + x[1] * x[1];
}

static void test_importance(void)
{
    const buffon_run run = {.samples = SAMPLES, .seed = 5};
    const buffon_integrand f_z = {.scalar = height, .dim = 3}, f_z2 = {.scalar = height2, .dim = 3};
    const buffon_integrand f_r2 = {.scalar = radius2, .dim = 2};
    const double r = 2;
    buffon_density g[2] = {buffon_disk(r), buffon_disk_concentric(r)};
    buffon_estimate e;
    double m[5];
    for (int k = 1; k < 5; k++)
        m[k] = pow(LAW_PI * r * r * r * r, k) / (k + 1);
    judge("importance, r^2 on a disk", buffon_importance(&e, &f_r2, &g[0], &run), &e, m);
    judge("importance, concentric disk", buffon_importance(&e, &f_r2, &g[1], &run), &e, m);
    g[0] = buffon_sphere();
    for (int k = 1; k < 5; k++)
        m[k] = pow(4 * LAW_PI, k) / (2 * k + 1);
    judge("importance, z^2 on the sphere", buffon_importance(&e, &f_z2, &g[0], &run), &e, m);
    const double cut = 0.3;
    g[0] = buffon_cap(cut);
    for (int k = 1; k < 5; k++)
        m[k] = pow(2 * LAW_PI * (1 - cut), k) * (1 - pow(cut, k + 1)) / ((k + 1) * (1 - cut));
    judge("importance, z on a cap", buffon_importance(&e, &f_z, &g[0], &run), &e, m);
    g[0] = buffon_hemisphere();
    for (int k = 1; k < 5; k++)
        m[k] = pow(2 * LAW_PI, k) / (k + 1);
    judge("importance, z on the hemisphere", buffon_importance(&e, &f_z, &g[0], &run), &e, m);
    g[0] = buffon_hemisphere_cosine();
    for (int k = 1; k < 5; k++) /* z^2 is uniform */
        m[k] = pow(LAW_PI, k) * 2 / (k + 2);
    judge("importance, z^2 by cosines", buffon_importance(&e, &f_z2, &g[0], &run), &e, m);
    const buffon_status status = buffon_importance(&e, &f_z, &g[0], &run);
    tap_ok(status >= 0 && fabs(e.value - LAW_PI) < 1e-14 && e.std_error < 1e-16,
           "importance, g = f: no variance but rounding (%.1g)", e.std_error);
}

static double exponential(double u, void *ctx)
{
    (void)ctx;
    return -log(u);
}

static double first(const double *x, void *ctx)
{
    (void)ctx;
    return x[0];
}

static void test_expectation(void)
{
    const buffon_inversion how = {.quantile = exponential};
    const buffon_density g = buffon_inverse(&how);
    const buffon_integrand h = {.scalar = first, .dim = 1};
    const double m[] = {1, 1, 2, 6, 24};
    buffon_estimate e;
    judge("expectation, the mean of an exponential",
          buffon_expectation(&e, &h, &g, &(buffon_run){.samples = SAMPLES}), &e, m);
    tap_ok(buffon_importance(&e, &h, &g, NULL) == BUFFON_E_UNSUPPORTED, "which has no pdf here");
}

/* p = 7 x on (0, 1), g uniform with a wrong factor: E[x] = 2/3, n Var = E[w^2 (x - 2/3)^2] /
 * E[w]^2. */
static double seven(const double *x, void *ctx)
{
    (void)ctx;
    return 7 * x[0];
}

static void test_self_normalised(void)
{
    const buffon_density g = buffon_segment(0, 1);
    const buffon_integrand h = {.scalar = first, .dim = 1}, p = {.scalar = seven, .dim = 1};
    const double exact = 2.0 / 3, var = 4 * (0.2 - 1.0 / 3 + 4.0 / 27);
    buffon_estimate e;
    const buffon_status status =
        buffon_self_normalised(&e, &h, &p, &g, &(buffon_run){.samples = SAMPLES, .seed = 9});
    const double z = (e.value - exact) / sqrt(var / SAMPLES);
    tap_ok(status == BUFFON_OK && fabs(z) < LIMIT && fabs(e.variance / var - 1) < 0.02,
           "self-normalised: z = %.2f, variance off by %.2g", z, e.variance / var - 1);
    tap_ok(fabs(e.ess / SAMPLES - 0.75) < 0.005 &&
               fabs(e.max_share * SAMPLES * (1.0 / 3) - 1) < 0.02,
           "self-normalised: effective sample size %.0f", e.ess);
}

/* Values far from 0: the error never comes out too small, and where rounding hides it the estimate
 * says that it saw no spread. */
static double far_first(const double *x, void *ctx)
{
    return x[0] + *(const double *)ctx;
}

static void test_self_normalised_far(void)
{
    const buffon_density g = buffon_segment(0, 1);
    const buffon_integrand p = {.scalar = seven, .dim = 1};
    const double var = 4 * (0.2 - 1.0 / 3 + 4.0 / 27);
    double offset = 1;
    for (int decade = 0; decade <= 10; decade++, offset *= 10) {
        const buffon_integrand h = {.scalar = far_first, .dim = 1, .ctx = &offset};
        buffon_estimate e;
        const buffon_status status =
            buffon_self_normalised(&e, &h, &p, &g, &(buffon_run){.samples = SAMPLES, .seed = 9});
        const double ratio = e.variance / var;
        const int seen = status == BUFFON_OK && ratio > 0.98 && (offset > 1e5 || ratio < 1.02);
        const int unseen = status == BUFFON_W_NO_SPREAD && offset > 1e6;
        tap_ok((seen || unseen) && fabs(e.value - offset - 2.0 / 3) < 1e-2,
               "self-normalised, values near 1e%d: %s", decade, buffon_status_name(status));
    }
}

/* ---- inverse CDF ---- */

/* g = 2 x on (0, 1), f = x^3: y = x^2 / 2 with x^2 uniform. */
static double root(double u, void *ctx)
{
    (void)ctx;
    return sqrt(u);
}

static double cdf_square(double x, void *ctx)
{
    (void)ctx;
    return x * x;
}

static double pdf_twice(double x, void *ctx)
{
    (void)ctx;
    return 2 * x;
}

static void test_inverse_cdf(void)
{
    double p = 3, x[33], F[33], m[5];
    const buffon_integrand f = {.scalar = power, .dim = 1, .ctx = &p};
    const buffon_inversion quantile = {.quantile = root, .pdf = pdf_twice};
    const buffon_inversion newton = {.cdf = cdf_square, .pdf = pdf_twice, .lo = 0, .hi = 1};
    const buffon_inversion table = {.x = x, .F = F, .count = 33};
    const buffon_run run = {.samples = SAMPLES, .seed = 8};
    buffon_estimate e, other;
    for (int k = 1; k < 5; k++)
        m[k] = ldexp(1, -k) / (k + 1);
    judge("inverse CDF, quantile", buffon_inverse_cdf(&e, &f, &quantile, &run), &e, m);
    judge("inverse CDF, Newton", buffon_inverse_cdf(&other, &f, &newton, &run), &other, m);
    tap_ok(fabs(e.value - other.value) < 1e-13, "inverse CDF: both draw the same points");
    for (int i = 0; i <= 32; i++) {
        x[i] = i / 32.0;
        F[i] = x[i] * x[i];
    }
    for (int k = 1; k < 5; k++) { /* sum of integral (x^3 / g)^k g over the pieces */
        m[k] = 0;
        for (int i = 0; i < 32; i++)
            m[k] += (pow(x[i + 1], 3 * k + 1) - pow(x[i], 3 * k + 1)) / (3 * k + 1) /
                    pow(x[i] + x[i + 1], k - 1);
    }
    judge("inverse CDF, table", buffon_inverse_cdf(&e, &f, &table, &run), &e, m);
    p = 1;
    const buffon_status status = buffon_inverse_cdf(&e, &f, &quantile, &run);
    tap_ok(status == BUFFON_W_NO_SPREAD && e.value == 0.5 && e.std_error == 0,
           "inverse CDF, g = f: no variance, and it says so");
}

/* ---- strata ---- */

/* x^2 over (0, 1) in strata of unequal width: exact standard errors for the samples each gets. */
static void test_stratified(void)
{
    static const double edge[] = {0, 0.1, 0.3, 0.6, 1};
    double p = 2, plain = 4.0 / 45, proportional = 0, deviation = 0, neyman = 0, sd[4];
    const buffon_integrand f = {.scalar = power, .dim = 1, .ctx = &p};
    buffon_density box[4];
    buffon_stratum list[4];
    buffon_strata strata = {.stratum = list, .count = 4};
    const buffon_run run = {.samples = SAMPLES, .seed = 4};
    buffon_estimate e;
    for (int s = 0; s < 4; s++) {
        const double a = edge[s], b = edge[s + 1], w = b - a;
        const double m1 = (b * b * b - a * a * a) / 3 / w, m2 = (pow(b, 5) - pow(a, 5)) / 5 / w;
        box[s] = buffon_segment(a, b);
        list[s] = (buffon_stratum){.density = &box[s], .share = w};
        sd[s] = w * sqrt(m2 - m1 * m1);
        proportional += sd[s] * sd[s] / w;
        deviation += sd[s];
    }
    for (int s = 0; s < 4; s++)
        neyman += sd[s] * sd[s] / (0.1 * (edge[s + 1] - edge[s]) + 0.9 * sd[s] / deviation);
    buffon_status status = buffon_stratified(&e, &f, &strata, &run);
    double z = (e.value - 1.0 / 3) / sqrt(proportional / SAMPLES);
    tap_ok(status == BUFFON_OK && fabs(z) < LIMIT && fabs(e.variance / proportional - 1) < 0.02 &&
               e.variance < plain,
           "strata, proportional: z = %.2f, variance off by %.2g", z,
           e.variance / proportional - 1);
    strata.allocation = BUFFON_ALLOCATION_NEYMAN;
    status = buffon_stratified(&e, &f, &strata, &run);
    z = (e.value - 1.0 / 3) / sqrt(neyman / SAMPLES);
    tap_ok(status == BUFFON_OK && fabs(z) < LIMIT && fabs(e.variance / neyman - 1) < 0.05 &&
               neyman < proportional,
           "strata, Neyman: z = %.2f, variance off by %.2g", z, e.variance / neyman - 1);
}

static double sawtooth(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] - floor(x[0]);
}

/* Two strata alike but for a weight of 9: a tenth goes by shares, the rest by weight. */
static void test_neyman_weights(void)
{
    const buffon_density box[2] = {buffon_segment(0, 1), buffon_segment(1, 2)};
    const buffon_stratum list[] = {{.density = &box[0]}, {.density = &box[1], .weight = -9}};
    const buffon_strata strata = {
        .stratum = list, .count = 2, .allocation = BUFFON_ALLOCATION_NEYMAN, .pilot = 100000};
    const buffon_integrand f = {.scalar = sawtooth, .dim = 1};
    const double expected = (1 / (0.05 + 0.09) + 81 / (0.05 + 0.81)) / 12;
    buffon_estimate e;
    const buffon_status status =
        buffon_stratified(&e, &f, &strata, &(buffon_run){.samples = SAMPLES});
    tap_ok(status == BUFFON_OK && fabs(e.value + 4) < LIMIT * e.std_error &&
               fabs(e.variance / expected - 1) < 0.02,
           "strata, Neyman: weights count, variance off by %.2g", e.variance / expected - 1);
}

/* A constant stratum beside a lively one: Neyman leaves it a tenth of its share, not nothing; and
 * where no stratum has spread the shares stay. */
static double half_flat(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] < 0.5 ? 1 : 1 + x[0] * x[0];
}

static int seen_in_order(const buffon_progress *progress, void *ctx)
{
    *(uint64_t *)ctx = progress->done;
    return 0;
}

static void test_neyman_floor(void)
{
    buffon_density box[2] = {buffon_segment(0, 0.5), buffon_segment(0.5, 1)};
    const buffon_stratum list[] = {{.density = &box[0]}, {.density = &box[1]}};
    const buffon_strata strata = {
        .stratum = list, .count = 2, .allocation = BUFFON_ALLOCATION_NEYMAN};
    const buffon_integrand f = {.scalar = half_flat, .dim = 1};
    uint64_t done = 0;
    const buffon_run run = {.samples = 10000, .progress = seen_in_order, .progress_ctx = &done};
    buffon_estimate e;
    const double x = 7.0 / 24 / 0.5; /* mean of x^2 on the second half */
    const double var = 0.25 * (31.0 / 160 / 0.5 - x * x);
    tap_ok(buffon_stratified(&e, &f, &strata, &run) == BUFFON_OK && e.samples == done &&
               fabs(e.std_error * e.std_error * 9500 / var - 1) < 0.03,
           "strata, Neyman: a stratum without spread keeps a tenth of its share");
}

/* ---- scales ---- */

typedef struct scale {
    double factor;
    size_t dim;
} scale;

/* The mean of the coordinates' places in (0, 1), times the factor: its integral is half of that
 * times the volume. */
static double tiny_or_huge(const double *x, void *ctx)
{
    const scale *s = ctx;
    return s->factor * x[0];
}

static void check_scale(const char *name, double lo, double hi, size_t dim, double factor,
                        double exact)
{
    static double a[300], b[300];
    scale s = {factor, dim};
    const buffon_integrand f = {.scalar = tiny_or_huge, .dim = dim, .ctx = &s};
    buffon_estimate e;
    for (size_t j = 0; j < dim; j++) {
        a[j] = lo;
        b[j] = hi;
    }
    const buffon_status status = buffon_uniform(&e, &f, a, b, &(buffon_run){.samples = 40000});
    const double z = (e.value - exact) / e.std_error;
    tap_ok(status == BUFFON_OK && e.std_error > 0 && e.std_error < INFINITY && fabs(z) < LIMIT &&
               e.lo < exact && exact < e.hi,
           "%s: %g +- %g", name, e.value, e.std_error);
}

/* From -1e-5 to 1.5e-5 over a box whose width is no double. */
static double wide(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * 1e-308 * 1e-5;
}

static void test_wide(void)
{
    const buffon_integrand f = {.scalar = wide, .dim = 1};
    const double lo = -1e308, hi = 1.5e308, exact = 6.25e302;
    buffon_estimate e;
    const buffon_status status = buffon_uniform(&e, &f, &lo, &hi, &(buffon_run){.samples = 40000});
    tap_ok(status == BUFFON_OK && fabs(e.value - exact) < LIMIT * e.std_error &&
               fabs(e.std_error / (2.5e303 / sqrt(12 * 40000.0) * 2.5) - 1) < 0.03,
           "a box as wide as the doubles: %g +- %g", e.value, e.std_error);
}

static void test_scales(void)
{
    check_scale("values near 1e308", 0, 1, 1, 1.6e308, 0.8e308);
    check_scale("values near 1e-300", 0, 1, 1, 1e-300, 0.5e-300);
    check_scale("subnormal values", 0, 1, 1, 0x1p-1060, 0x1p-1061);
    check_scale("a volume of 2^300", 0, 2, 300, 1, ldexp(1, 300));
    check_scale("a volume of 1e600", 0, 100, 300, 1e-305, 5e296);
    check_scale("a volume of 1e-600", 0, 0.01, 300, 1e303, 0.5e-299);
    check_scale("three hundred dimensions", 0, 1, 300, 1, 0.5);
    check_scale("a tiny box far out", 1e15, 1e15 + 1, 1, 1, 1e15 + 0.5);
}

/* A product of 200 densities underflows to 0; its logarithm does not, and f / g follows from it. */
static void test_log_pdf(void)
{
    enum { D = 200 };
    static buffon_density part[D];
    scale s = {1e-200, D};
    for (int j = 0; j < D; j++)
        part[j] = buffon_segment(0, 100); /* pdf 1e-400 */
    const buffon_density g = buffon_density_product(part, D);
    const buffon_integrand f = {.scalar = tiny_or_huge, .dim = D, .ctx = &s};
    buffon_estimate e;
    const buffon_status status = buffon_importance(&e, &f, &g, &(buffon_run){.samples = 5000});
    tap_ok(status == BUFFON_OK && fabs(e.value - 5e201) < LIMIT * e.std_error &&
               fabs(e.std_error / (1e202 / sqrt(12 * 5000.0)) - 1) < 0.1 && e.variance == INFINITY,
           "a pdf of 1e-400 by its logarithm: %g +- %g", e.value, e.std_error);
    buffon_estimate minus;
    s.factor = -1e-200;
    tap_ok(buffon_importance(&minus, &f, &g, &(buffon_run){.samples = 5000}) == BUFFON_OK &&
               minus.value == -e.value && minus.std_error == e.std_error,
           "and negative f likewise");
    for (int j = 0; j < D; j++)
        part[j] = buffon_segment(0, 0.01); /* pdf 1e400 */
    s.factor = 1e250;
    const buffon_status small = buffon_importance(&e, &f, &g, &(buffon_run){.samples = 5000});
    tap_ok(small == BUFFON_OK && fabs(e.value / 5e-153 - 1) < LIMIT * e.std_error / 5e-153,
           "and of 1e400: %g +- %g", e.value, e.std_error);
}

int main(void)
{
    test_uniform();
    test_rejection();
    test_importance();
    test_expectation();
    test_self_normalised();
    test_self_normalised_far();
    test_inverse_cdf();
    test_stratified();
    test_neyman_weights();
    test_neyman_floor();
    test_wide();
    test_scales();
    test_log_pdf();
    return tap_done();
}
