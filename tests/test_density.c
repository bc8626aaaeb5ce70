/* Densities: what is refused and how, batches against single points, there and back, products. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>

#include "../src/density_priv.h"
#include "refused.h"

static const double up[3] = {0, 0, 1};

static void test_refusals(void)
{
    const double lo[2] = {0, 0}, hi[2] = {1, 1}, flat[2] = {1, 0}, nan[2] = {1, NAN};
    const double endless[2] = {1, INFINITY}, zero[3] = {0, 0, 0}, far[3] = {0, INFINITY, 1};
    const double near[3] = {0, 0, 2};
    refused_by_value(buffon_box(NULL, hi, 2), BUFFON_E_NULL, "a box without lo");
    refused_by_value(buffon_box(lo, NULL, 2), BUFFON_E_NULL, "a box without hi");
    refused_by_value(buffon_box(lo, hi, 0), BUFFON_E_DIM, "a box of no dimension");
    refused_by_value(buffon_box(lo, flat, 2), BUFFON_E_DOMAIN, "a box without width");
    refused_by_value(buffon_box(lo, nan, 2), BUFFON_E_DOMAIN, "a box to NaN");
    refused_by_value(buffon_box(lo, endless, 2), BUFFON_E_DOMAIN, "a box to infinity");
    refused_by_value(buffon_segment(2, 1), BUFFON_E_DOMAIN, "a segment backwards");
    refused_by_value(buffon_segment(-INFINITY, 1), BUFFON_E_DOMAIN, "a segment from -infinity");
    refused_by_value(buffon_disk(0), BUFFON_E_SHAPE, "a disk of radius 0");
    refused_by_value(buffon_disk(NAN), BUFFON_E_SHAPE, "a disk of radius NaN");
    refused_by_value(buffon_disk_concentric(-1), BUFFON_E_SHAPE, "a disk of radius -1");
    refused_by_value(buffon_disk_concentric(INFINITY), BUFFON_E_SHAPE, "a disk without end");
    refused_by_value(buffon_cap(1), BUFFON_E_SHAPE, "a cap cut at the top");
    refused_by_value(buffon_cap(-1.0000000000000002), BUFFON_E_SHAPE, "a cap cut below");
    refused_by_value(buffon_cap(NAN), BUFFON_E_SHAPE, "a cap cut at NaN");
    refused_by_value(buffon_cap_about(0, NULL), BUFFON_E_NULL, "a cap without axis");
    refused_by_value(buffon_cap_about(0, zero), BUFFON_E_SHAPE, "a cap about no direction");
    refused_by_value(buffon_cap_about(0, far), BUFFON_E_SHAPE, "a cap about infinity");
    refused_by_value(buffon_cap_angle(0, up), BUFFON_E_SHAPE, "a cap of angle 0");
    refused_by_value(buffon_cap_angle(3.1415926535897936, up), BUFFON_E_SHAPE, "an angle over pi");
    refused_by_value(buffon_cap_angle(-1, up), BUFFON_E_SHAPE, "a negative angle");
    refused_by_value(buffon_cap_angle(1e-160, up), BUFFON_E_SHAPE, "an angle with g past DBL_MAX");
    refused_by_value(buffon_cap_angle(1, NULL), BUFFON_E_NULL, "an angle without axis");
    refused_by_value(buffon_cap_height(0, up), BUFFON_E_SHAPE, "a cap of height 0");
    refused_by_value(buffon_cap_height(2.0000000000000004, up), BUFFON_E_SHAPE, "a height over 2");
    refused_by_value(buffon_cap_height(1e-310, up), BUFFON_E_SHAPE, "a height with g past DBL_MAX");
    refused_by_value(buffon_cap_of_sphere(NULL, near, 1), BUFFON_E_NULL, "a sphere from nowhere");
    refused_by_value(buffon_cap_of_sphere(zero, NULL, 1), BUFFON_E_NULL, "a sphere without centre");
    refused_by_value(buffon_cap_of_sphere(zero, near, 2), BUFFON_E_SHAPE, "a sphere from on it");
    refused_by_value(buffon_cap_of_sphere(zero, near, 3), BUFFON_E_SHAPE, "a sphere from inside");
    refused_by_value(buffon_cap_of_sphere(zero, near, 0), BUFFON_E_SHAPE, "a sphere of radius 0");
    refused_by_value(buffon_cap_of_sphere(zero, near, NAN), BUFFON_E_SHAPE, "a radius of NaN");
    refused_by_value(buffon_cap_of_sphere(far, near, 1), BUFFON_E_SHAPE, "a sphere from infinity");
    refused_by_value(buffon_cap_of_sphere(zero, near, 1e-160), BUFFON_E_SHAPE, "a sphere too far");
    refused_by_value(buffon_hemisphere_about(NULL), BUFFON_E_NULL, "a hemisphere without axis");
    refused_by_value(buffon_hemisphere_about(zero), BUFFON_E_SHAPE, "a hemisphere about nothing");
    refused_by_value(buffon_hemisphere_cosine_about(NULL), BUFFON_E_NULL, "a cosine without axis");
    refused_by_value(buffon_hemisphere_cosine_about(far), BUFFON_E_SHAPE, "an infinite axis");
    refused_by_value(buffon_density_product(NULL, 1), BUFFON_E_NULL, "a product without parts");
    const buffon_density parts[2] = {buffon_sphere(), buffon_disk(-1)};
    refused_by_value(buffon_density_product(parts, 0), BUFFON_E_NULL, "a product of no parts");
    refused_by_value(buffon_density_product(parts, 2), BUFFON_E_SHAPE, "a product with a bad part");
    static double low[3000], high[3000];
    for (int j = 0; j < 3000; j++)
        high[j] = 1;
    const buffon_density large = buffon_box(low, high, 3000);
    buffon_density product = buffon_density_product(&large, 1);
    tap_ok(large.status == BUFFON_OK && product.status == BUFFON_E_DIM,
           "a product refuses a part of thousands of coordinates");
}

/* A user's density: x = u^2 on (0, 1), which fails on request. */
static int user_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        x[i] = u[i] * u[i];
        if (pdf)
            pdf[i] = 0.5 / u[i];
    }
    return g->ctx != NULL;
}

static int user_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        pdf[i] = x[i] > 0 && x[i] < 1 ? 0.5 / sqrt(x[i]) : 0;
    return g->ctx != NULL;
}

static void test_user(void)
{
    static const buffon_density_ops bare = {.sample = user_sample};
    static const buffon_density_ops full = {.sample = user_sample, .pdf = user_pdf};
    static const buffon_density_ops odd = {.sample = user_sample, .reserved = {0, 0, 0, 1}};
    static const buffon_density_ops empty = {.pdf = user_pdf};
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &full};
    const double u[2] = {0.5, 0.25};
    double x[2], pdf[2];
    tap_ok(buffon_density_sample(x, pdf, u, 2, &g) == BUFFON_OK && x[0] == 0.25 && pdf[1] == 2,
           "a user's density samples");
    tap_ok(buffon_density_log_pdf(pdf, x, 2, &g) == BUFFON_OK && pdf[0] == 0 &&
               fabs(pdf[1] - log(2)) < 1e-15,
           "a log pdf is taken where there is none");
    x[0] = -1;
    tap_ok(buffon_density_log_pdf(pdf, x, 1, &g) == BUFFON_OK && pdf[0] == -INFINITY,
           "and is -infinity outside");
    tap_ok(buffon_density_invert(x, u, 1, &g) == BUFFON_E_UNSUPPORTED && is_nan(x, 1),
           "no inverse: BUFFON_E_UNSUPPORTED");
    g.ctx = &g;
    tap_ok(buffon_density_sample(x, pdf, u, 2, &g) == BUFFON_E_PDF && is_nan(x, 2) &&
               is_nan(pdf, 2) && buffon_density_pdf(pdf, u, 2, &g) == BUFFON_E_PDF &&
               buffon_density_log_pdf(pdf, u, 2, &g) == BUFFON_E_PDF && is_nan(pdf, 2),
           "its failure is BUFFON_E_PDF");
    g.ctx = NULL;
    g.ops = &bare;
    tap_ok(buffon_density_pdf(pdf, u, 2, &g) == BUFFON_E_UNSUPPORTED && is_nan(pdf, 2) &&
               buffon_density_log_pdf(pdf, u, 2, &g) == BUFFON_E_UNSUPPORTED,
           "no pdf: BUFFON_E_UNSUPPORTED");
    g.ops = &empty;
    tap_ok(buffon_density_check(&g) == BUFFON_E_NULL, "a table without sample is refused");
    g.ops = NULL;
    tap_ok(buffon_density_check(&g) == BUFFON_E_NULL, "a density without table is refused");
    g.ops = &odd;
    tap_ok(buffon_density_check(&g) == BUFFON_E_RESERVED, "reserved words of a table");
    g.ops = &full;
    g.reserved[3] = 1;
    tap_ok(buffon_density_sample(x, pdf, u, 2, &g) == BUFFON_E_RESERVED && is_nan(x, 2),
           "reserved words of a density");
    g.reserved[3] = 0;
    g.dim = 0;
    tap_ok(buffon_density_check(&g) == BUFFON_E_DIM, "no coordinates");
    g.dim = 1;
    g.uniforms = 0;
    tap_ok(buffon_density_check(&g) == BUFFON_E_DIM, "no uniforms");
}

static void test_calls(void)
{
    const buffon_density g = buffon_sphere();
    double u[2] = {0.5, 0.5}, x[3] = {7, 7, 7}, pdf = 7;
    tap_ok(buffon_density_check(NULL) == BUFFON_E_NULL &&
               buffon_density_sample(x, &pdf, u, 1, NULL) == BUFFON_E_NULL && is_nan(&pdf, 1),
           "no density");
    tap_ok(buffon_density_sample(x, NULL, NULL, 1, &g) == BUFFON_E_NULL && is_nan(x, 3) &&
               buffon_density_sample(NULL, &pdf, u, 1, &g) == BUFFON_E_NULL && is_nan(&pdf, 1),
           "no uniforms, or no room for points");
    tap_ok(buffon_density_pdf(NULL, x, 1, &g) == BUFFON_E_NULL &&
               buffon_density_pdf(&pdf, NULL, 1, &g) == BUFFON_E_NULL &&
               buffon_density_log_pdf(&pdf, NULL, 1, &g) == BUFFON_E_NULL &&
               buffon_density_invert(u, NULL, 1, &g) == BUFFON_E_NULL && is_nan(u, 2),
           "no points");
    x[0] = pdf = 7;
    tap_ok(buffon_density_sample(NULL, NULL, NULL, 0, &g) == BUFFON_OK &&
               buffon_density_sample(x, &pdf, u, 0, &g) == BUFFON_OK && x[0] == 7 && pdf == 7 &&
               buffon_density_pdf(&pdf, x, 0, &g) == BUFFON_OK && pdf == 7,
           "n = 0 does nothing");
    tap_ok(buffon_density_sample(x, &pdf, u, SIZE_MAX / 8, &g) == BUFFON_E_DIM && x[0] == 7,
           "more points than memory can hold");
}

/* Every density of the library, for checks that hold for all. */
enum { ZOO = 20 };

static const double zoo_lo[9] = {0, -1, 1e10, -1e-300, -DBL_MAX, 1, 0, 0, 5};
static const double zoo_hi[9] = {1, 2, 2e10, 3e-300, DBL_MAX, 1.5, 1e200, 0x1p-1000, 6};
static const double zoo_knots[4] = {-1, 0, 0.5, 3}, zoo_F[4] = {2, 2.5, 4, 4.25};

static double square_root(double u, void *ctx)
{
    (void)ctx;
    return sqrt(u);
}

static double square(double x, void *ctx)
{
    (void)ctx;
    return x < 0 ? 0 : x > 1 ? 1 : x * x;
}

static double ramp(double x, void *ctx)
{
    (void)ctx;
    return x < 0 || x > 1 ? 0 : 2 * x;
}

static const buffon_inversion zoo_quantile = {.quantile = square_root, .cdf = square, .pdf = ramp};
static const buffon_inversion zoo_cdf = {.cdf = square, .pdf = ramp, .lo = 0, .hi = 1};
static const buffon_inversion zoo_table = {.x = zoo_knots, .F = zoo_F, .count = 4};

static void fill_zoo(buffon_density *g)
{
    static buffon_density parts[3], inner[2];
    const double aslant[3] = {1, -2, -3}, origin[3] = {0, 0, 0}, centre[3] = {4, 5, -6};
    size_t k = 0;
    inner[0] = buffon_segment(-2, 3);
    inner[1] = buffon_disk(2);
    parts[0] = buffon_sphere();
    parts[1] = buffon_density_product(inner, 2);
    parts[2] = buffon_inverse(&zoo_table);
    g[k++] = buffon_segment(-3, 4);
    g[k++] = buffon_box(zoo_lo, zoo_hi, 8);
    g[k++] = buffon_box(zoo_lo, zoo_hi, 9);
    g[k++] = buffon_disk(0.5);
    g[k++] = buffon_disk_concentric(1e100);
    g[k++] = buffon_sphere();
    g[k++] = buffon_cap(0.5);
    g[k++] = buffon_cap(-1);
    g[k++] = buffon_cap(-0.999999999);
    g[k++] = buffon_cap_about(0.25, aslant);
    g[k++] = buffon_cap_angle(3, aslant);
    g[k++] = buffon_cap_height(1e-300, up);
    g[k++] = buffon_cap_of_sphere(origin, centre, 3);
    g[k++] = buffon_hemisphere();
    g[k++] = buffon_hemisphere_cosine();
    g[k++] = buffon_hemisphere_cosine_about(aslant);
    g[k++] = buffon_inverse(&zoo_quantile);
    g[k++] = buffon_inverse(&zoo_cdf);
    g[k++] = buffon_inverse(&zoo_table);
    g[k++] = buffon_density_product(parts, 3);
}

/* Sizes around the tiles of the maps, each point against a batch of one. */
static int same_in_batches(const buffon_density *g, size_t n)
{
    static double u[16 * 600], x[16 * 600], pdf[600], far[600], back[16 * 600];
    int same = 1;
    buffon_rng rng = buffon_rng_make(n, 23);
    buffon_rng_fill(u, g->uniforms * n, &rng);
    same &= buffon_density_sample(x, pdf, u, n, g) == BUFFON_OK &&
            buffon_density_pdf(far, x, n, g) == BUFFON_OK &&
            buffon_density_invert(back, x, n, g) == BUFFON_OK;
    for (size_t i = 0; i < n; i++) {
        double v[16], y[16], w[16], p = 0, q = 0;
        for (size_t j = 0; j < g->uniforms; j++)
            v[j] = u[j * n + i];
        same &= buffon_density_sample(y, &p, v, 1, g) == BUFFON_OK &&
                buffon_density_pdf(&q, y, 1, g) == BUFFON_OK &&
                buffon_density_invert(w, y, 1, g) == BUFFON_OK;
        same &= tap_bits(p) == tap_bits(pdf[i]) && tap_bits(q) == tap_bits(far[i]);
        for (size_t j = 0; j < g->dim; j++)
            same &= tap_bits(y[j]) == tap_bits(x[j * n + i]);
        for (size_t j = 0; j < g->uniforms; j++)
            same &= tap_bits(w[j]) == tap_bits(back[j * n + i]);
        same &= buffon_density_sample(w, NULL, v, 1, g) == BUFFON_OK &&
                memcmp(w, y, g->dim * sizeof *w) == 0;
    }
    return same;
}

/* There and back, the ends of the generator's grid included. The pdf that comes with a point is the
 * pdf at the point, and its log the log. */
static int goes_back(const buffon_density *g, double *worst)
{
    int good = 1;
    buffon_rng rng = buffon_rng_make(1, 24);
    for (int k = 0; k < 3000; k++) {
        double u[16], x[16], v[16], y[16], pdf = NAN, again = NAN, log_pdf = NAN;
        for (size_t j = 0; j < g->uniforms; j++) {
            u[j] = buffon_rng_next(&rng);
            u[j] = k % 8 ? u[j] : u[j] < 0.5 ? 0x1p-53 : 1 - 0x1p-53;
        }
        good &= buffon_density_sample(x, &pdf, u, 1, g) == BUFFON_OK &&
                buffon_density_pdf(&again, x, 1, g) == BUFFON_OK &&
                buffon_density_log_pdf(&log_pdf, x, 1, g) == BUFFON_OK &&
                buffon_density_invert(v, x, 1, g) == BUFFON_OK &&
                buffon_density_sample(y, NULL, v, 1, g) == BUFFON_OK;
        good &= fabs(again - pdf) <= 1e-9 * pdf || fabs(again - pdf) < 1e-15;
        good &= pdf == 0 || pdf > DBL_MAX || fabs(log_pdf - log(pdf)) < 1e-7;
        for (size_t j = 0; j < g->uniforms; j++) {
            good &= v[j] > 0 && v[j] < 1;
            /* An angle at the seam may come back from the other side. */
            const double off = fabs(u[j] - v[j]), around = fmin(off, fabs(1 - off));
            *worst = fmax(*worst, g->dim == g->uniforms && g->dim != 2 ? off : around);
        }
        for (size_t j = 0; j < g->dim; j++)
            good &= fabs(x[j] - y[j]) <= 2e-7 * (1 + fabs(x[j]));
    }
    return good;
}

static void test_zoo(void)
{
    static const size_t sizes[] = {1, 2, 3, 7, 255, 256, 257, 512, 600};
    buffon_density g[ZOO];
    fill_zoo(g);
    for (int k = 0; k < ZOO; k++) {
        int same = g[k].status == BUFFON_OK;
        double worst = 0;
        for (size_t s = 0; same && s < sizeof sizes / sizeof *sizes; s++)
            same = same_in_batches(&g[k], sizes[s]);
        tap_ok(same, "%s (%d): batches are single points, bit for bit", g[k].ops->name, k);
        tap_ok(goes_back(&g[k], &worst) && worst < 1e-7, "%s (%d): there and back",
               g[k].ops->name, k);
        tap_note("worst %.2g", worst);
    }
}

static void test_products(void)
{
    static buffon_density parts[200];
    static double u[200 * 3], x[200 * 3], v[200 * 3];
    double pdf[3], log_pdf[3];
    int good = 1;
    buffon_rng rng = buffon_rng_make(1, 27);
    for (int k = 0; k < 200; k++)
        parts[k] = buffon_segment(k, k + 1000);
    const buffon_density g = buffon_density_product(parts, 200);
    buffon_rng_fill(u, 600, &rng);
    good &= g.dim == 200 && g.uniforms == 200 && buffon_priv_density_has_pdf(&g);
    good &= buffon_density_sample(x, pdf, u, 3, &g) == BUFFON_OK;
    good &= buffon_density_log_pdf(log_pdf, x, 3, &g) == BUFFON_OK;
    good &= buffon_density_invert(v, x, 3, &g) == BUFFON_OK;
    for (int k = 0; k < 600; k++)
        good &= x[k] == k / 3 + 1000 * u[k] && fabs(v[k] - u[k]) < 1e-15;
    for (int i = 0; i < 3; i++)
        good &= pdf[i] == 0 && fabs(log_pdf[i] / (-200 * log(1000)) - 1) < 1e-14;
    tap_ok(good, "a product of 200 segments: points, log pdf where the pdf underflows, inverse");
    x[300] = -1;
    tap_ok(buffon_density_log_pdf(log_pdf, x, 3, &g) == BUFFON_OK && log_pdf[0] == -INFINITY &&
               log_pdf[1] > -INFINITY,
           "outside one part is outside the product");
    const buffon_inversion bare = {.quantile = square_root};
    const buffon_density some[2] = {buffon_sphere(), buffon_inverse(&bare)};
    const buffon_density h = buffon_density_product(some, 2);
    const buffon_density nested = buffon_density_product(&h, 1);
    tap_ok(!buffon_priv_density_has_pdf(&nested) &&
               buffon_density_sample(x, pdf, u, 1, &nested) == BUFFON_E_UNSUPPORTED &&
               buffon_density_pdf(pdf, x, 1, &nested) == BUFFON_E_UNSUPPORTED &&
               buffon_density_invert(v, x, 1, &nested) == BUFFON_E_UNSUPPORTED &&
               buffon_density_sample(x, NULL, u, 1, &nested) == BUFFON_OK && x[3] == sqrt(u[2]),
           "a product with a part that has no pdf");
}

static uint64_t identity(buffon_density g)
{
    return buffon_priv_density_identity(1, &g);
}

static void test_identity(void)
{
    const buffon_density ab[2] = {buffon_disk(1), buffon_disk(2)}, ba[2] = {ab[1], ab[0]};
    const buffon_density copy[2] = {ab[0], ab[1]};
    double knots[4], lo[9], hi[9];
    memcpy(knots, zoo_knots, sizeof knots);
    memcpy(lo, zoo_lo, sizeof lo);
    memcpy(hi, zoo_hi, sizeof hi);
    const buffon_inversion table = {.x = knots, .F = zoo_F, .count = 4};
    tap_ok(identity(buffon_density_product(ab, 2)) == identity(buffon_density_product(copy, 2)) &&
               identity(buffon_density_product(ab, 2)) != identity(buffon_density_product(ba, 2)),
           "a product is known by its parts and their order");
    int good = identity(buffon_inverse(&table)) == identity(buffon_inverse(&zoo_table));
    knots[2] = 0.75;
    good &= identity(buffon_inverse(&table)) != identity(buffon_inverse(&zoo_table));
    tap_ok(good, "a table by its contents");
    good = identity(buffon_box(lo, hi, 9)) == identity(buffon_box(zoo_lo, zoo_hi, 9));
    lo[8] -= 1;
    good &= identity(buffon_box(lo, hi, 9)) != identity(buffon_box(zoo_lo, zoo_hi, 9));
    tap_ok(good, "a large box by its bounds");
    tap_ok(identity(buffon_disk(1)) != identity(buffon_disk_concentric(1)) &&
               identity(buffon_disk(1)) != identity(buffon_disk(2)) &&
               identity(buffon_cap(0)) != identity(buffon_cap(0.5)) &&
               identity(buffon_segment(0, 1)) != identity(buffon_segment(0, 2)) &&
               identity(buffon_inverse(&zoo_cdf)) != identity(buffon_inverse(&zoo_quantile)),
           "others by their law and numbers");
}

int main(void)
{
    test_refusals();
    test_user();
    test_calls();
    test_zoo();
    test_products();
    test_identity();
    return tap_done();
}
