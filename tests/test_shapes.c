/* Boxes, disks, spheres and caps: scalar functions, extremes, where densities end. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>

#include "../src/box.h"
#include "refused.h"

static const double up[3] = {0, 0, 1};

static double square_root(double u, void *ctx)
{
    (void)ctx;
    return sqrt(u);
}

static double ramp(double x, void *ctx)
{
    (void)ctx;
    return x < 0 || x > 1 ? 0 : 2 * x;
}

/* Scalar conveniences are the densities. */
static void test_scalars(void)
{
    const buffon_density disk = buffon_disk(1), concentric = buffon_disk_concentric(1);
    const buffon_density sphere = buffon_sphere(), cap = buffon_cap(0.3);
    const buffon_density dome = buffon_hemisphere();
    const buffon_inversion root = {.quantile = square_root, .pdf = ramp};
    const buffon_density cosine = buffon_hemisphere_cosine(), segment = buffon_segment(-1, 7);
    int same = 1;
    buffon_rng rng = buffon_rng_make(1, 25);
    for (int k = 0; k < 1000; k++) {
        double u[2], x[3], y[3], v[2], w[2];
        buffon_rng_fill(u, 2, &rng);
#define SAME(g, sample, invert)                                                                    \
    do {                                                                                           \
        sample;                                                                                    \
        same &= buffon_density_sample(x, NULL, u, 1, &(g)) == BUFFON_OK;                           \
        same &= memcmp(x, y, (g).dim * sizeof *x) == 0;                                            \
        invert;                                                                                    \
        same &= buffon_density_invert(v, x, 1, &(g)) == BUFFON_OK;                                 \
        same &= memcmp(v, w, sizeof v) == 0;                                                       \
    } while (0)
        SAME(disk, buffon_disk_sample(y, u[0], u[1]), buffon_disk_invert(w, x));
        SAME(concentric, buffon_disk_sample_concentric(y, u[0], u[1]),
             buffon_disk_invert_concentric(w, x));
        SAME(sphere, buffon_sphere_sample(y, u[0], u[1]), buffon_sphere_invert(w, x));
        SAME(cap, buffon_cap_sample(y, u[0], u[1], 0.3), buffon_cap_invert(w, x, 0.3));
        SAME(dome, buffon_hemisphere_sample(y, u[0], u[1]), buffon_hemisphere_invert(w, x));
        SAME(cosine, buffon_hemisphere_sample_cosine(y, u[0], u[1]),
             buffon_hemisphere_invert_cosine(w, x));
#undef SAME
        same &= buffon_density_sample(x, NULL, u, 1, &segment) == BUFFON_OK;
        same &= x[0] == buffon_segment_sample(u[0], -1, 7);
        same &= buffon_inverse_sample(x, v, u[0], &root) == BUFFON_OK;
        same &= x[0] == sqrt(u[0]) && v[0] == 2 * x[0];
    }
    tap_ok(same, "scalar functions give the points of the densities");
    double x[3] = {0, 0, 0};
    buffon_cap_sample(x, 0.5, 0.5, 1);
    tap_ok(is_nan(x, 3), "a point of no cap is NaN");
    buffon_cap_invert(x, up, -2);
    tap_ok(is_nan(x, 2), "and so is its inverse");
    tap_ok(buffon_segment_sample(0.5, 1, 1) != buffon_segment_sample(0.5, 1, 1),
           "a point of no segment is NaN");
    const double lo[3] = {0, 1, 2}, hi[3] = {1, 1, 3}, u[3] = {0.5, 0.5, 0.5};
    x[0] = x[1] = x[2] = 0;
    buffon_box_sample(x, u, lo, hi, 3);
    tap_ok(is_nan(x, 3), "a point of no box is NaN");
    const double top[3] = {1, 2, 3};
    buffon_box_sample(x, u, lo, top, 3);
    tap_ok(x[0] == 0.5 && x[1] == 1.5 && x[2] == 2.5, "a point of a box");
}

static int inside_always(double lo, double hi)
{
    const double next = nextafter(lo, hi);
    int good = 1;
    buffon_rng rng = buffon_rng_make(1, 26);
    for (int k = 0; k < 2000; k++) {
        const double u = k == 0 ? 0x1p-53 : k == 1 ? 1 - 0x1p-53 : buffon_rng_next(&rng);
        const double x = buffon_segment_sample(u, lo, hi);
        good &= next < hi ? x > lo && x < hi : x == lo || x == hi;
    }
    return good;
}

static void test_boxes(void)
{
    tap_ok(inside_always(0, 1) && inside_always(-DBL_MAX, DBL_MAX) &&
               inside_always(1e16, 1e16 + 4) && inside_always(-1e308, DBL_MAX) &&
               inside_always(-1, 0) && inside_always(-1e-300, 1) &&
               inside_always(-DBL_MAX, nextafter(-DBL_MAX, 0)),
           "points are strictly inside");
    tap_ok(inside_always(0, 0x1p-1074) && inside_always(0, 0x1p-1073) &&
               inside_always(0, 0x1p-1060) && inside_always(1, 1 + DBL_EPSILON) &&
               inside_always(1, 1 + 2 * DBL_EPSILON) && inside_always(1e300, 1.1e300),
           "also in boxes of a few doubles, where there are any");
    const double mid = buffon_segment_sample(0.5, -DBL_MAX, DBL_MAX);
    const double upper = buffon_segment_sample(0.75, -DBL_MAX, DBL_MAX);
    tap_ok(mid == 0 && fabs(upper / DBL_MAX - 0.5) < 1e-15,
           "a width beyond the doubles");
    double volume, lo[400], hi[400], x[400];
    int e;
    for (int j = 0; j < 400; j++) {
        lo[j] = j % 2 ? -DBL_MAX : 0;
        hi[j] = j % 2 ? DBL_MAX : 0x1p-1074;
        x[j] = 0;
    }
    buffon_priv_box_volume(&volume, &e, lo, hi, 400);
    tap_ok(fabs(volume - 1) < 1e-12 && e == 200 * (1025 - 1074),
           "the volume of a box never leaves the doubles");
    buffon_priv_box_volume(&volume, &e, lo, hi, 1);
    tap_ok(volume == 0.5 && e == -1073, "nor of the least segment");
    for (int j = 0; j < 400; j++) {
        lo[j] = 0;
        hi[j] = 1000;
    }
    const buffon_density g = buffon_box(lo, hi, 400);
    double pdf, log_pdf;
    tap_ok(buffon_density_pdf(&pdf, x, 1, &g) == BUFFON_OK && pdf == 0 &&
               buffon_density_log_pdf(&log_pdf, x, 1, &g) == BUFFON_OK &&
               fabs(log_pdf / (-400 * log(1000)) - 1) < 1e-15,
           "log pdf where the pdf underflows");
    x[7] = -1;
    tap_ok(buffon_density_log_pdf(&log_pdf, x, 1, &g) == BUFFON_OK && log_pdf == -INFINITY,
           "and outside");
    double a = 3, b = 4;
    const buffon_density copied = buffon_box(&a, &b, 1);
    a = b = NAN;
    x[0] = 3.5;
    tap_ok(buffon_density_pdf(&pdf, x, 1, &copied) == BUFFON_OK && pdf == 1,
           "the bounds of a small box are copied");
}

static double pdf_at(const buffon_density *g, double x, double y, double z)
{
    const double point[3] = {x, y, z};
    double pdf;
    return buffon_density_pdf(&pdf, point, 1, g) == BUFFON_OK ? pdf : NAN;
}

/* Where densities end. */
static void test_supports(void)
{
    const double x[3] = {1, 0, 0};
    const buffon_density disk = buffon_disk(2), sphere = buffon_sphere(), cap = buffon_cap(0.5);
    const buffon_density side = buffon_cap_about(0.5, x), cosine = buffon_hemisphere_cosine();
    const buffon_density tiny = buffon_cap_height(1e-200, up), box = buffon_segment(1, 2);
    const double r = sqrt(0.75), pi = 3.14159265358979323846;
    tap_ok(pdf_at(&disk, 1.2, 1.6000000000000003, 0) == 0 && pdf_at(&disk, 1.2, 1.59999, 0) > 0 &&
               pdf_at(&disk, NAN, 0, 0) == 0 && pdf_at(&disk, 1e200, 1e200, 0) == 0,
           "a disk ends at its edge");
    tap_ok(pdf_at(&sphere, 0.6, 0, -0.8) > 0 && pdf_at(&sphere, 0.6, 0, -0.81) == 0 &&
               pdf_at(&sphere, 0, 0, 0) == 0 && pdf_at(&sphere, NAN, 0, 1) == 0 &&
               pdf_at(&sphere, (float)0.6, 0, (float)0.8) > 0,
           "a sphere is for unit vectors, floats included");
    tap_ok(pdf_at(&cap, r + 1e-14, 0, 0.5 - 1e-14) == 0 && pdf_at(&cap, r, 0, 0.5) > 0 &&
               pdf_at(&cap, 0, 0, -1) == 0 && pdf_at(&cap, 0, 0, 1) > 0 &&
               fabs(pdf_at(&cap, 0, 0, 1) * pi - 1) < 1e-15,
           "a cap ends at its plane");
    tap_ok(pdf_at(&side, 0.5 - 1e-14, r + 1e-14, 0) == 0 && pdf_at(&side, 0.5, 0, r) > 0 &&
               pdf_at(&side, -1, 0, 0) == 0,
           "about another axis too");
    tap_ok(pdf_at(&tiny, 2.1e-100, 0, 1) == 0 && pdf_at(&tiny, 1.4e-100, 0, 1) > 1e199 &&
               pdf_at(&tiny, 1.42e-100, 0, 1) == 0,
           "a cap of height 1e-200 has an edge as sharp");
    tap_ok(pdf_at(&cosine, 1, 0, 0) == 0 && pdf_at(&cosine, 0.6, 0, -0.8) == 0 &&
               fabs(pdf_at(&cosine, 0.6, 0, 0.8) * pi - 0.8) < 1e-15,
           "the cosine hemisphere ends at the horizon");
    tap_ok(pdf_at(&box, 1, 0, 0) == 1 && pdf_at(&box, 2.0000000000000004, 0, 0) == 0 &&
               pdf_at(&box, NAN, 0, 0) == 0,
           "a segment ends at its ends");
}

/* The same cap by every constructor; scales of axes; spheres near and far. */
static void test_cap_forms(void)
{
    const double axis[3] = {2, -1, 2}, huge[3] = {2e307, -1e307, 2e307};
    const double tiny[3] = {0x1p-1073, -0x1p-1074, 0x1p-1073}, origin[3] = {0, 0, 0};
    const double here[3] = {1e308, 1e308, -1e308}, there[3] = {-1e308, 1e308, -1e308};
    const double h = 0.5;
    const buffon_density g[6] = {buffon_cap_about(0.5, axis),
                                 buffon_cap_angle(1.0471975511965976, huge),
                                 buffon_cap_height(h, tiny),
                                 buffon_cap_of_sphere(origin, axis, 3 * sqrt(0.75)),
                                 buffon_cap_of_sphere(origin, huge, 3e307 * sqrt(0.75)),
                                 buffon_cap_height(0.5, axis)};
    const double u[2] = {0.3, 0.8};
    double first[3], x[3], pdf;
    int good = buffon_density_sample(first, NULL, u, 1, &g[0]) == BUFFON_OK;
    for (int k = 0; k < 6; k++) {
        good &= buffon_density_sample(x, &pdf, u, 1, &g[k]) == BUFFON_OK;
        good &= fabs(pdf * 3.14159265358979323846 - 1) < 2e-15;
        for (int j = 0; j < 3; j++)
            good &= fabs(x[j] - first[j]) < 2e-15;
    }
    tap_ok(good, "every way to name a cap gives the same, axes of any length");
    const buffon_density wide = buffon_cap_of_sphere(here, there, 1e307);
    tap_ok(buffon_density_sample(x, &pdf, u, 1, &wide) == BUFFON_OK && x[0] < -0.99 &&
               fabs(pdf * 3.14159265358979323846 * 0.0025 - 1) < 1e-3,
           "a sphere at a distance beyond the doubles");
    const buffon_density sun = buffon_cap_height(1e-300, axis);
    good = 1;
    for (int k = 0; k < 8; k++) {
        const double v[2] = {k & 1 ? 0x1p-53 : 1 - 0x1p-53, k / 8.0 + 0.05};
        double again;
        good &= buffon_density_sample(x, &pdf, v, 1, &sun) == BUFFON_OK;
        good &= buffon_density_pdf(&again, x, 1, &sun) == BUFFON_OK && again == pdf && pdf > 1e299;
    }
    tap_ok(good, "a cap smaller than the steps of the doubles keeps its points");
    const buffon_density whole = buffon_cap_angle(3.1415926535897931, up), cut = buffon_cap(-1);
    tap_ok(whole.param[9] == 2 && cut.param[9] == 2 && pdf_at(&whole, 0, 0, -1) > 0 &&
               pdf_at(&cut, 0, 0, -1) == pdf_at(&cut, 0, 0, 1),
           "the whole sphere is a cap");
}

int main(void)
{
    test_scalars();
    test_boxes();
    test_supports();
    test_cap_forms();
    return tap_done();
}
