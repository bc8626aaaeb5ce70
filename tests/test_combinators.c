/* Mixtures, truncation, affine maps and rotations of densities: against what they are made of,
 * against laws that are known in closed form, nested, refused, and in the estimators. */
#include <float.h>
#include <math.h>
#include <string.h>

#include <buffon/buffon.h>

#include "density_priv.h"
#include "law.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

enum { N = 3000 };
static double u[4 * N], x[4 * N], pdf[N], given[N], log_given[N], back[4 * N];

/* Points of a density, all that it says of them. */
static int draw(const buffon_density *g, uint64_t seed)
{
    buffon_rng rng = buffon_rng_make(seed, 50);
    buffon_rng_fill(u, g->uniforms * N, &rng);
    return buffon_density_sample(x, pdf, u, N, g) == BUFFON_OK &&
           buffon_density_pdf(given, x, N, g) == BUFFON_OK &&
           buffon_density_log_pdf(log_given, x, N, g) == BUFFON_OK;
}

/* The largest |a - b| / b. */
static double apart(const double *a, const double *b, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        const double off = fabs(a[i] - b[i]) / fabs(b[i]);
        most = off <= most ? most : off;
    }
    return most;
}

static int verified(const buffon_density *g)
{
    buffon_verify_report r;
    const buffon_status status =
        buffon_verify_density(&r, g, &(buffon_verification){.samples = 1 << 13});
    if (status < 0)
        tap_note("%s: %s", buffon_status_string(status), buffon_verify_string(r.check));
    return status >= 0;
}

static int refuses(buffon_density g, buffon_status status)
{
    double y = 1, p = 1;
    const double v = 0.5;
    return g.status == status && buffon_density_sample(&y, &p, &v, 0, &g) == status;
}

/* ---- mixtures ----------------------------------------------------------------------------- */

static void test_mixture_sum(void)
{
    const buffon_density parts[] = {buffon_normal(0, 1), buffon_cauchy(1, 2),
                                    buffon_laplace(-3, 0.1), buffon_normal(7, 1e-3)};
    const double weights[] = {3, 1, 0, 4}, doubled[] = {0.75e300, 0.25e300, 0, 1e300};
    const buffon_density g = buffon_mixture(parts, weights, 4),
                         h = buffon_mixture(parts, doubled, 4);
    double sum[N], one[N], log_sum[N];
    int same = draw(&g, 1);
    memset(sum, 0, sizeof sum);
    for (int k = 0; k < 4; k++) {
        same &= buffon_density_pdf(one, x, N, &parts[k]) == BUFFON_OK;
        for (int i = 0; i < N; i++)
            sum[i] += weights[k] / 8 * one[i];
    }
    for (int i = 0; i < N; i++)
        log_sum[i] = log(sum[i]);
    tap_ok(same && apart(given, sum, N) < 4 * DBL_EPSILON && apart(pdf, given, N) < 1e-8 &&
               apart(log_given, log_sum, N) < 1e-13,
           "mixture: the pdf is the sum of the shares");
    memcpy(back, x, sizeof back);
    tap_ok(draw(&h, 1) && memcmp(back, x, N * sizeof *x) == 0 && apart(given, sum, N) < 1e-15,
           "mixture: weights in any unit");
}

/* Where the pdf came with the point it is that of the part, to the bit if there is but one. */
static void test_mixture_of_one(void)
{
    const buffon_density pair[] = {buffon_laplace(0, 1), buffon_normal(1, 2)};
    const buffon_density part = buffon_density_product(pair, 2);
    const double weights[] = {0.3};
    const buffon_density g = buffon_mixture(&part, weights, 1);
    double y[2 * N], p[N];
    const int good = draw(&g, 2) && buffon_density_sample(y, p, u, N, &part) == BUFFON_OK;
    tap_ok(good && memcmp(x, y, 2 * N * sizeof *x) == 0 && memcmp(pdf, p, sizeof p) == 0,
           "a mixture of one is that one");
    tap_ok(verified(&g), "and is what it says");
}

/* Evenly spaced uniforms: every part has its share of points within one, and evenly spaced ones
 * itself. Parts are told apart by their places. */
static void test_mixture_strata(void)
{
    buffon_density parts[40];
    double weights[40], spread = 0;
    int counts[40] = {0}, good = 1;
    for (int k = 0; k < 40; k++) {
        parts[k] = buffon_segment(2 * k, 2 * k + 1);
        weights[k] = k % 5 == 2 || k == 39 ? 0 : 1 + k % 7;
        spread += weights[k];
    }
    const buffon_density g = buffon_mixture(parts, weights, 40);
    for (int i = 0; i < N; i++)
        u[i] = (i + 0.5) / N;
    good &= buffon_density_sample(x, pdf, u, N, &g) == BUFFON_OK;
    for (int i = 0; i < N; i++) {
        const int k = (int)(x[i] / 2);
        counts[k]++;
        good &= x[i] > 2 * k && x[i] < 2 * k + 1 && fabs(pdf[i] - weights[k] / spread) < 1e-15;
        good &= i == 0 || x[i] > x[i - 1];
    }
    for (int k = 0; k < 40; k++)
        good &= fabs(counts[k] - N * weights[k] / spread) <= 1;
    tap_ok(good, "mixture: strata of the whole are strata of the parts; none of weight 0");
    const double edge[] = {0x1p-1074, 0x1p-53, 0.25, 1 - 0x1p-53, 0.5, nextafter(0.25, 0)};
    const buffon_density normals[] = {buffon_normal(-40, 1), buffon_normal(0, 1),
                                      buffon_normal(40, 1)};
    const double halves[] = {1, 2, 1};
    const buffon_density h = buffon_mixture(normals, halves, 3);
    good = buffon_density_sample(x, pdf, edge, 6, &h) == BUFFON_OK;
    good &= x[0] < -77 && x[1] > -49 && x[1] < -47 && x[2] < -7.5 && x[2] > -9 && x[3] > 47 &&
            x[3] < 49 && fabs(x[4]) < 1e-15 && x[5] < -31 && x[5] > -33;
    for (int i = 1; i < 6; i++)
        good &= pdf[i] > 0;
    tap_ok(good, "mixture: uniforms at the seams do not make far tails");
}

static void test_mixture_far(void)
{
    const buffon_density parts[] = {buffon_normal(0, 1), buffon_normal(0, 1.5)};
    const double weights[] = {1, 3}, at = 200;
    const buffon_density g = buffon_mixture(parts, weights, 2);
    double p, log_p;
    const double exact = -0.5 * 200. * 200. / 2.25 - log(1.5 * sqrt(2 * LAW_PI) / 0.75);
    tap_ok(buffon_density_pdf(&p, &at, 1, &g) == BUFFON_OK && p == 0 &&
               buffon_density_log_pdf(&log_p, &at, 1, &g) == BUFFON_OK &&
               fabs(log_p / exact - 1) < 1e-15,
           "mixture: the logarithm holds where all parts underflow");
}

static void test_mixture_refused(void)
{
    const buffon_density good[] = {buffon_normal(0, 1), buffon_cauchy(0, 1)};
    const buffon_density bad[] = {buffon_normal(0, 1), buffon_normal(0, -1)};
    const buffon_density broad[] = {buffon_normal(0, 1), buffon_disk(1)};
    const double weights[] = {1, 1}, zero[] = {0, 0}, none[] = {1, NAN}, less[] = {1, -1};
    const double most[] = {INFINITY, 1};
    int fine = refuses(buffon_mixture(NULL, weights, 2), BUFFON_E_NULL);
    fine &= refuses(buffon_mixture(good, NULL, 2), BUFFON_E_NULL);
    fine &= refuses(buffon_mixture(good, weights, 0), BUFFON_E_NULL);
    fine &= refuses(buffon_mixture(bad, weights, 2), BUFFON_E_SHAPE);
    fine &= refuses(buffon_mixture(broad, weights, 2), BUFFON_E_DIM);
    fine &= refuses(buffon_mixture(good, zero, 2), BUFFON_E_SHAPE);
    fine &= refuses(buffon_mixture(good, none, 2), BUFFON_E_SHAPE);
    fine &= refuses(buffon_mixture(good, less, 2), BUFFON_E_SHAPE);
    fine &= refuses(buffon_mixture(good, most, 2), BUFFON_E_SHAPE);
    buffon_density many[201];
    for (int k = 0; k < 201; k++)
        many[k] = good[0];
    const buffon_density huge = buffon_density_product(many, 201);
    fine &= refuses(buffon_mixture(&huge, weights, 1), BUFFON_E_DIM);
    tap_ok(fine, "mixture: what is refused");
    const buffon_density g = buffon_mixture(good, weights, 2);
    const double v = 0.5;
    double w;
    tap_ok(buffon_density_invert(&w, &v, 1, &g) == BUFFON_E_UNSUPPORTED,
           "mixture: there is no way back");
}

/* ---- truncation --------------------------------------------------------------------------- */

static void test_truncated_known(void)
{
    const buffon_density wholes[] = {buffon_exponential(2), buffon_normal(1, 2),
                                     buffon_normal(1, 2), buffon_segment(-1, 5),
                                     buffon_power(2, 0, 1)};
    const double bounds[][2] = {{1, 3}, {-2, 4}, {-INFINITY, -3}, {0, 9}, {-3, 0.5}};
    const buffon_density same[] = {buffon_exponential_truncated(0.5, 1, 3),
                                   buffon_normal_truncated(1, 2, -2, 4),
                                   buffon_normal_truncated(1, 2, -INFINITY, -3),
                                   buffon_segment(0, 5), buffon_power(2, 0, 0.5)};
    for (size_t k = 0; k < COUNT(wholes); k++) {
        const buffon_density g = buffon_truncated(&wholes[k], bounds[k][0], bounds[k][1]);
        double y[N], p[N], q[N];
        int good = g.status == BUFFON_OK && draw(&g, 3 + k) &&
                   buffon_density_invert(back, x, N, &g) == BUFFON_OK &&
                   buffon_density_sample(y, p, u, N, &same[k]) == BUFFON_OK &&
                   buffon_density_pdf(q, x, N, &same[k]) == BUFFON_OK;
        good &= apart(given, q, N) < 1e-14 && apart(pdf, q, N) < 1e-13;
        for (int i = 0; i < N; i++) {
            good &= fabs(x[i] - y[i]) < 1e-12 && x[i] > bounds[k][0] && x[i] < bounds[k][1];
            good &= fabs(back[i] - u[i]) < 1e-14 && fabs(log_given[i] - log(q[i])) < 1e-13;
        }
        tap_ok(good, "truncated: %s, as the law of the rest is", wholes[k].ops->name);
    }
}

/* A law of uniforms that fall with x. */
static int falling_sample(double *y, double *p, const double *v, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++) {
        y[i] = 4 * (1 - v[i]);
        if (p)
            p[i] = 0.25;
    }
    return 0;
}

static int falling_invert(double *v, const double *y, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++)
        v[i] = y[i] < 0 ? 1 - 0x1p-53 : y[i] > 4 ? 0x1p-53 : density_open(1 - y[i] / 4);
    return 0;
}

static const buffon_density_ops falling_ops = {.sample = falling_sample, .invert = falling_invert};

static double itself(const double *y, void *ctx)
{
    (void)ctx;
    return y[0];
}

static void test_truncated_own(void)
{
    const buffon_density own = {.uniforms = 1, .dim = 1, .ops = &falling_ops};
    const buffon_density g = buffon_truncated(&own, 1, 2);
    const buffon_density both[] = {own, buffon_segment(0, 1)};
    const double weights[] = {1, 1}, q = 1, matrix = 2;
    const buffon_density blind[] = {g, buffon_mixture(both, weights, 2),
                                    buffon_affine(&own, &matrix, &q)};
    const double v[] = {0.25, 0.5, 0x1p-53, 1 - 0x1p-53};
    double y[4], w[4];
    const buffon_integrand f = {.scalar = itself, .dim = 1};
    buffon_estimate e;
    int good = buffon_density_sample(y, NULL, v, 4, &g) == BUFFON_OK && fabs(y[0] - 1.25) < 1e-15 &&
               fabs(y[1] - 1.5) < 1e-15 && y[2] > 1 && y[3] < 2;
    good &= buffon_density_invert(w, y, 2, &g) == BUFFON_OK && fabs(w[0] - 0.25) < 1e-15;
    tap_ok(good, "truncated: a law whose points fall with u; now they grow");
    good = 1;
    for (int k = 0; k < 3; k++) {
        const double mean[] = {1.5, 1.25, 5};
        const buffon_run run = {.samples = 1 << 14};
        good &= blind[k].ops->pdf == NULL && blind[k].ops->log_pdf == NULL;
        good &= buffon_expectation(&e, &f, &blind[k], &run) == BUFFON_OK &&
                fabs(e.value - mean[k]) < 6 * e.std_error;
        good &= buffon_importance(&e, &f, &blind[k], &run) == BUFFON_E_UNSUPPORTED;
        good &= buffon_density_pdf(w, y, 1, &blind[k]) == BUFFON_E_UNSUPPORTED;
    }
    tap_ok(good, "parts without a pdf serve expectations and are refused as g in f / g");
}

static void test_truncated_refused(void)
{
    const buffon_density g = buffon_normal(0, 1), disk = buffon_disk(1), bad = buffon_normal(0, 0);
    const double weights[] = {1};
    const buffon_density mix = buffon_mixture(&g, weights, 1), zero = {.dim = 0};
    int good = refuses(buffon_truncated(NULL, 0, 1), BUFFON_E_NULL);
    good &= refuses(buffon_truncated(&disk, 0, 1), BUFFON_E_DIM);
    good &= refuses(buffon_truncated(&bad, 0, 1), BUFFON_E_SHAPE);
    good &= refuses(buffon_truncated(&mix, 0, 1), BUFFON_E_UNSUPPORTED);
    good &= refuses(buffon_truncated(&zero, 0, 1), BUFFON_E_NULL);
    good &= refuses(buffon_truncated(&g, 1, 1), BUFFON_E_DOMAIN);
    good &= refuses(buffon_truncated(&g, 2, 1), BUFFON_E_DOMAIN);
    good &= refuses(buffon_truncated(&g, NAN, 1), BUFFON_E_DOMAIN);
    good &= refuses(buffon_truncated(&g, 0, NAN), BUFFON_E_DOMAIN);
    good &= refuses(buffon_truncated(&g, 7, 8), BUFFON_E_DOMAIN); /* 1 - F has few digits */
    good &= refuses(buffon_truncated(&g, 0, 1e-12), BUFFON_E_DOMAIN);
    good &= buffon_truncated(&g, -8, -7).status == BUFFON_OK;
    tap_ok(good, "truncated: what is refused");
}

/* ---- affine maps -------------------------------------------------------------------------- */

static void test_affine_line(void)
{
    const double scale[] = {2, -3, 1e-300, 1e300}, shift[] = {5, -1, 0, 0};
    const buffon_density standard = buffon_normal(0, 1);
    int good = 1;
    for (int k = 0; k < 4; k++) {
        const buffon_density g = buffon_affine(&standard, &scale[k], &shift[k]);
        const buffon_density h = buffon_normal(shift[k], fabs(scale[k]));
        double p[N], q[N];
        good &= draw(&g, 20 + (uint64_t)k) && buffon_density_pdf(p, x, N, &h) == BUFFON_OK &&
                buffon_density_log_pdf(q, x, N, &h) == BUFFON_OK &&
                buffon_density_invert(back, x, N, &g) == BUFFON_OK;
        good &= apart(given, p, N) < 1e-14 && apart(pdf, p, N) < 1e-13;
        for (int i = 0; i < N; i++)
            good &= fabs(back[i] - u[i]) < 1e-14 &&
                    fabs(log_given[i] - q[i]) < 1e-13 * (1 + fabs(q[i]));
    }
    tap_ok(good, "affine: a normal of another mean and deviation");
}

/* A density in the plane by a matrix, against its formula. */
static void test_affine_plane(void)
{
    const buffon_density disk = buffon_disk(1);
    const double a[] = {2, 1, -1, 3}, b[] = {10, -20};
    const buffon_density g = buffon_affine(&disk, a, b);
    int good = draw(&g, 30) && buffon_density_invert(back, x, N, &g) == BUFFON_OK;
    for (int i = 0; i < N; i++) {
        const double s = x[i] - 10, t = x[N + i] + 20, y = (3 * s - t) / 7, z = (s + 2 * t) / 7;
        good &= y * y + z * z < 1 && fabs(pdf[i] * 7 * LAW_PI - 1) < 4e-16 &&
                fabs(given[i] - pdf[i]) < 1e-16;
        good &= fabs(back[i] - u[i]) < 1e-13;
    }
    tap_ok(good && verified(&g), "affine: an ellipse of the disk");
    const double at[] = {10, 12.9, NAN, INFINITY, -20, -20, 10, 10};
    double p[4];
    good = buffon_density_pdf(p, at, 4, &g) == BUFFON_OK && p[0] == given[0] && p[1] == 0 &&
           p[2] == 0 && p[3] == 0;
    tap_ok(good, "affine: 0 where there is no number");
}

/* Five coordinates, units that differ by 1e400, and a matrix that needs pivots. */
static void test_affine_space(void)
{
    static const double a[25] = {0,      1e200, 0, 0, 0,     3e-200, 1e-200, 0, 0,
                                 0,      0,     0, 0, 5e200, 0,      0,      0, 2e-200,
                                 1e-200, 0,     0, 0, 1e200, 0,      4e200};
    static const double b[5] = {1e200, 0, -1e200, 0, 2e200};
    static const double diagonal[16] = {1e300, 0, 0,     0, 0, 1e300, 0, 0,
                                        0,     0, 1e300, 0, 0, 0,     0, 1e300};
    buffon_density parts[5];
    for (int k = 0; k < 5; k++)
        parts[k] = buffon_segment(0, 1);
    const buffon_density cube = buffon_density_product(parts, 4);
    const buffon_density five = buffon_density_product(parts, 5);
    const buffon_density g = buffon_affine(&five, a, b), h = buffon_affine(&cube, diagonal, NULL);
    const double v[5] = {0.1, 0.2, 0.3, 0.4, 0.5};
    double y[5], p, q, w[5];
    /* |det| = 3e-200 1e200 . 2e-200 5e200 . 4e200 */
    int good = buffon_density_sample(y, &p, v, 1, &g) == BUFFON_OK;
    good &= buffon_density_pdf(&q, y, 1, &g) == BUFFON_OK &&
            buffon_density_invert(w, y, 1, &g) == BUFFON_OK;
    good &= fabs(p * 1.2e202 - 1) < 1e-15 && p == q;
    good &= fabs(y[0] / 1.2e200 - 1) < 1e-15 && fabs(y[1] / 5e-201 - 1) < 1e-15;
    for (int k = 0; k < 5; k++)
        good &= fabs(w[k] - v[k]) < 2e-15;
    tap_ok(good, "affine: a permuted matrix of five coordinates and very different units");
    good = buffon_density_sample(y, &p, v, 1, &h) == BUFFON_OK && p == 0;
    good &= buffon_density_log_pdf(&p, y, 1, &h) == BUFFON_OK && fabs(p + 1200 * log(10)) < 1e-12;
    tap_ok(good, "affine: the logarithm holds where the determinant is beyond the doubles");
}

static void test_affine_refused(void)
{
    const buffon_density g = buffon_disk(1), bad = buffon_disk(-1);
    const double singular[] = {1, 2, 2, 4}, zero[] = {1, 0, 0, 0}, none[] = {1, 0, 0, NAN};
    const double good_one[] = {1, 0, 0, 1}, shift[] = {0, INFINITY};
    buffon_density many[13];
    double eye[169] = {0};
    for (int k = 0; k < 13; k++) {
        many[k] = buffon_segment(0, 1);
        eye[14 * k] = 1;
    }
    const buffon_density broad = buffon_density_product(many, 13);
    int fine = refuses(buffon_affine(NULL, good_one, NULL), BUFFON_E_NULL);
    fine &= refuses(buffon_affine(&g, NULL, NULL), BUFFON_E_NULL);
    fine &= refuses(buffon_affine(&bad, good_one, NULL), bad.status);
    fine &= refuses(buffon_affine(&g, singular, NULL), BUFFON_E_SHAPE);
    fine &= refuses(buffon_affine(&g, zero, NULL), BUFFON_E_SHAPE);
    fine &= refuses(buffon_affine(&g, none, NULL), BUFFON_E_SHAPE);
    fine &= refuses(buffon_affine(&g, good_one, shift), BUFFON_E_SHAPE);
    fine &= refuses(buffon_affine(&broad, eye, NULL), BUFFON_E_DIM);
    tap_ok(fine, "affine: what is refused");
}

/* ---- rotations ---------------------------------------------------------------------------- */

static void test_turned_to(void)
{
    const double axis[] = {1, -2, 0.5}, up[] = {0, 0, 1e-200}, length = sqrt(5.25);
    const buffon_density cap = buffon_cap_angle(0.3, up), about = buffon_cap_angle(0.3, axis);
    const buffon_density g = buffon_turned_to(&cap, axis);
    double p[N];
    int good = draw(&g, 40) && buffon_density_pdf(p, x, N, &about) == BUFFON_OK &&
               buffon_density_invert(back, x, N, &g) == BUFFON_OK;
    for (int i = 0; i < N; i++) {
        const double a = x[i], b = x[N + i], c = x[2 * N + i];
        good &= fabs(a * a + b * b + c * c - 1) < 2e-15 && fabs(p[i] - pdf[i]) < 1e-12;
        good &= (a - 2 * b + 0.5 * c) / length > cos(0.3) - 1e-15;
        good &= fabs(back[i] - u[i]) < 1e-12 && pdf[i] == given[i];
    }
    tap_ok(good && verified(&g), "turned: a cap about another axis");
}

static void test_turned(void)
{
    const double up[] = {0, 0, 1e-200}, q[] = {cos(0.5), 0, sin(0.5), 0};
    const double scaled[] = {1e-200 * q[0], 0, 1e-200 * q[2], 0};
    const buffon_density cap = buffon_cap_angle(0.3, up);
    const buffon_density g = buffon_turned(&cap, q), h = buffon_turned(&cap, scaled);
    double y[3 * N];
    int good = draw(&g, 40) && buffon_density_sample(y, NULL, u, N, &cap) == BUFFON_OK;
    for (int i = 0; i < N; i++) {
        good &= fabs(x[i] - (cos(1) * y[i] + sin(1) * y[2 * N + i])) < 4e-16;
        good &= fabs(x[N + i] - y[N + i]) < 4e-16;
        good &= fabs(x[2 * N + i] - (cos(1) * y[2 * N + i] - sin(1) * y[i])) < 4e-16;
    }
    tap_ok(good, "turned: by a quaternion about y, z goes to x");
    memcpy(y, x, sizeof y);
    good = draw(&h, 40);
    for (int i = 0; i < 3 * N; i++)
        good &= fabs(x[i] - y[i]) < 4e-16;
    tap_ok(good, "turned: quaternions of any length");
}

/* y + (2 w v x y + 2 v x (v x y)) / |q|^2, v the last three parts of q. */
static void test_turned_by_vectors(void)
{
    const double up[] = {0, 0, 1}, q[] = {1, 2, -1, 0.5}, *v = q + 1;
    const buffon_density cap = buffon_cap_angle(0.3, up), g = buffon_turned(&cap, q);
    double y[3 * N];
    int good = draw(&g, 40) && buffon_density_sample(y, NULL, u, N, &cap) == BUFFON_OK;
    for (int i = 0; i < N; i++) {
        const double from[] = {y[i], y[N + i], y[2 * N + i]};
        double a[3], b[3];
        for (int j = 0; j < 3; j++)
            a[j] = v[(j + 1) % 3] * from[(j + 2) % 3] - v[(j + 2) % 3] * from[(j + 1) % 3];
        for (int j = 0; j < 3; j++)
            b[j] = v[(j + 1) % 3] * a[(j + 2) % 3] - v[(j + 2) % 3] * a[(j + 1) % 3];
        for (int j = 0; j < 3; j++)
            good &= fabs(x[j * N + i] - (from[j] + (2 * a[j] + 2 * b[j]) / 6.25)) < 1e-15;
    }
    tap_ok(good, "turned: by any quaternion, as its formula by vectors says");
}

static void test_turned_refused(void)
{
    const double up[] = {0, 0, 1}, q[] = {1, 0, 0, 0}, zero[4] = {0}, none[] = {1, 0, NAN, 0};
    const buffon_density cap = buffon_cap_angle(0.3, up);
    const buffon_density disk = buffon_disk(1), bad = buffon_disk(-1);
    int good = refuses(buffon_turned(NULL, q), BUFFON_E_NULL);
    good &= refuses(buffon_turned(&cap, NULL), BUFFON_E_NULL);
    good &= refuses(buffon_turned_to(&cap, NULL), BUFFON_E_NULL);
    good &= refuses(buffon_turned(&disk, q), BUFFON_E_DIM);
    good &= refuses(buffon_turned(&bad, q), bad.status);
    good &= refuses(buffon_turned(&cap, zero), BUFFON_E_SHAPE);
    good &= refuses(buffon_turned(&cap, none), BUFFON_E_SHAPE);
    good &= refuses(buffon_turned_to(&cap, zero), BUFFON_E_SHAPE);
    tap_ok(good, "turned: what is refused");
}

/* ---- together ----------------------------------------------------------------------------- */

/* A mixture of products of truncated affine densities, moved. */
static buffon_density nested(void)
{
    static buffon_density normal, moved, part[2], products[3], whole;
    static const double two = 2, one = 1, weights[] = {5, 3, 2};
    static const double matrix[] = {1, 0.5, 0, 2}, shift[] = {-1, 1};
    normal = buffon_normal(0, 1);
    moved = buffon_affine(&normal, &two, &one);
    part[0] = buffon_truncated(&moved, -3, 4);
    part[1] = buffon_laplace(0, 1);
    products[0] = buffon_density_product(part, 2);
    products[1] = buffon_disk(3);
    products[2] = buffon_affine(&products[0], matrix, NULL);
    whole = buffon_mixture(products, weights, 3);
    return buffon_affine(&whole, matrix, shift);
}

static void test_nested(void)
{
    const buffon_density g = nested();
    tap_ok(g.status == BUFFON_OK && g.dim == 2 && g.uniforms == 2 && verified(&g),
           "a mixture of products of truncated affine densities, moved");
    int same = draw(&g, 60);
    for (int i = 0; i < N; i += 7) {
        const double v[] = {u[i], u[N + i]};
        double y[2], p, y_pdf, y_log;
        same &= buffon_density_sample(y, &p, v, 1, &g) == BUFFON_OK &&
                buffon_density_pdf(&y_pdf, y, 1, &g) == BUFFON_OK &&
                buffon_density_log_pdf(&y_log, y, 1, &g) == BUFFON_OK;
        same &= y[0] == x[i] && y[1] == x[N + i] && p == pdf[i] && y_pdf == given[i] &&
                y_log == log_given[i];
    }
    tap_ok(same, "and its points one by one");
}

static void test_identity(void)
{
    const buffon_density parts[] = {buffon_normal(0, 1), buffon_normal(0, 2), buffon_normal(0, 1)};
    const double weights[] = {1, 2, 1}, one[] = {1, 1}, other[] = {2, 1};
    const double q[] = {1, 0, 0, 0};
    const buffon_density spheres[] = {buffon_sphere(), buffon_hemisphere()};
    const buffon_density g[] = {buffon_mixture(parts, weights, 2),
                                buffon_mixture(parts, one, 2),
                                buffon_mixture(parts, other, 2),
                                buffon_mixture(parts, weights, 3),
                                buffon_mixture(parts + 1, weights, 2),
                                buffon_truncated(&parts[0], 0, 1),
                                buffon_truncated(&parts[1], 0, 1),
                                buffon_truncated(&parts[0], 0, 2),
                                buffon_affine(&parts[0], weights, NULL),
                                buffon_affine(&parts[0], weights + 1, NULL),
                                buffon_affine(&parts[1], weights, NULL),
                                buffon_turned(&spheres[0], q),
                                buffon_turned(&spheres[1], q)};
    int good = 1;
    for (size_t j = 0; j < COUNT(g); j++)
        for (size_t k = 0; k < j; k++)
            good &=
                buffon_priv_density_identity(1, &g[j]) != buffon_priv_density_identity(1, &g[k]);
    const buffon_density copies[] = {parts[2], parts[1]};
    const buffon_density again = buffon_mixture(copies, weights, 2);
    good &= buffon_priv_density_identity(1, &again) == buffon_priv_density_identity(1, &g[0]);
    tap_ok(good, "partial results of different combinations are told apart, of equal ones not");
}

/* ---- in the estimators -------------------------------------------------------------------- */

/* 1 / (1 + x^2): the normal alone has weights without bound, a tenth of a Cauchy density bounds
 * them: f / g <= f / (0.1 c) = 10 pi. */
static double bell_of_agnesi(const double *y, void *ctx)
{
    (void)ctx;
    return 1 / (1 + y[0] * y[0]);
}

static void test_defensive(void)
{
    const buffon_density parts[] = {buffon_normal(0, 1), buffon_cauchy(0, 1)};
    const double weights[] = {0.9, 0.1};
    const buffon_density g = buffon_mixture(parts, weights, 2);
    const buffon_integrand f = {.scalar = bell_of_agnesi, .dim = 1};
    const buffon_points even = buffon_points_jitter(1024);
    buffon_run run = {.samples = 1 << 16, .seed = 3};
    buffon_estimate alone, e;
    const buffon_status before = buffon_importance(&alone, &f, &parts[0], &run);
    int good = before > 0 && alone.max > 100;
    good &= buffon_importance(&e, &f, &g, &run) == BUFFON_OK && e.doubts == 0;
    good &= fabs(e.value - LAW_PI) < 6 * e.std_error && e.max <= 10 * LAW_PI * (1 + 1e-14);
    tap_ok(good, "a defensive mixture bounds the weights: %g instead of %g", e.max, alone.max);
    const double plain = e.std_error;
    run.points = &even;
    good = buffon_importance(&e, &f, &g, &run) >= 0 && fabs(e.value - LAW_PI) < 8 * e.std_error &&
           e.std_error < 0.1 * plain;
    tap_ok(good, "and jittered points still gain: %g instead of %g", e.std_error, plain);
}

/* How often an interval of 95 % holds the truth. */
static void test_coverage(void)
{
    const buffon_density g = nested();
    const buffon_density line[] = {buffon_normal(0, 1), buffon_cauchy(0, 1)};
    const double weights[] = {0.9, 0.1};
    const buffon_density h = buffon_mixture(line, weights, 2);
    const buffon_integrand f = {.scalar = bell_of_agnesi, .dim = 1};
    const buffon_integrand first = {.scalar = itself, .dim = 2};
    enum { RUNS = 400 };
    int held = 0, self = 0, sound = 1;
    buffon_estimate exact;
    sound &=
        buffon_expectation(&exact, &first, &g, &(buffon_run){.samples = 1 << 20, .seed = 99}) >= 0;
    for (uint64_t k = 0; k < RUNS; k++) {
        const buffon_run run = {.samples = 4096, .seed = k + 1};
        buffon_estimate e;
        sound &= buffon_importance(&e, &f, &h, &run) >= 0;
        held += e.lo <= LAW_PI && LAW_PI <= e.hi;
        sound &= buffon_expectation(&e, &first, &g, &run) >= 0;
        self += e.lo <= exact.value && exact.value <= e.hi;
    }
    tap_ok(sound && held > 0.92 * RUNS && held < 0.98 * RUNS && self > 0.91 * RUNS &&
               self < 0.985 * RUNS,
           "intervals cover: %d and %d of %d", held, self, RUNS);
}

static double heavy(const double *y, void *ctx)
{
    (void)ctx;
    return exp(-fabs(y[0]));
}

static void test_estimators(void)
{
    const buffon_density parts[] = {buffon_normal(0, 1), buffon_laplace(0, 2)};
    const double weights[] = {1, 1}, up[] = {0, 0, 1};
    const buffon_density g = buffon_mixture(parts, weights, 2), cap = buffon_cap_angle(1, up);
    const buffon_density turned = buffon_turned_to(&cap, up);
    const buffon_integrand f = {.scalar = heavy, .dim = 1}, y = {.scalar = itself, .dim = 1};
    const buffon_integrand s = {.scalar = itself, .dim = 3};
    const buffon_run run = {.samples = 1 << 15, .seed = 1};
    buffon_estimate e, one, two;
    int good =
        buffon_self_normalised(&e, &f, &f, &g, &run) >= 0 && fabs(e.value - 0.5) < 6 * e.std_error;
    buffon_rng rng = buffon_rng_make(7, 50);
    buffon_rejection_report report;
    good &= buffon_rejection_sample(x, N, &report, &f, &g, 4.5, &rng, 0) == BUFFON_OK;
    good &= buffon_expectation(&e, &s, &turned, &run) >= 0 && fabs(e.value) < 6 * e.std_error;
    tap_ok(good, "self-normalised weights, rejection and expectations of combinations");
    const buffon_run threads = {.samples = 1 << 15, .seed = 1, .threads = 3};
    good = buffon_importance(&one, &y, &g, &run) >= 0 &&
           buffon_importance(&two, &y, &g, &threads) >= 0;
    tap_ok(good && tap_bits(one.value) == tap_bits(two.value), "the same bits from threads");
}

int main(void)
{
    test_mixture_sum();
    test_mixture_of_one();
    test_mixture_strata();
    test_mixture_far();
    test_mixture_refused();
    test_truncated_known();
    test_truncated_own();
    test_truncated_refused();
    test_affine_line();
    test_affine_plane();
    test_affine_space();
    test_affine_refused();
    test_turned_to();
    test_turned();
    test_turned_by_vectors();
    test_turned_refused();
    test_nested();
    test_identity();
    test_defensive();
    test_coverage();
    test_estimators();
    return tap_done();
}
