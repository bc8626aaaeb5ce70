/* The samplers against their formulas in extended precision: the numbers behind `Exact:` in the
 * headers. Needs a long double of 64 bits or more; elsewhere the checks are skipped.
 */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>

#include "../src/box.h"
#include "../src/circle.h"
#include "round.h"

enum { DRAWS = 100000 };

/* In [2^-k, 2^(1-k)) with k below `range`. */
static double scaled(buffon_rng *rng, int range)
{
    const int k = (int)buffon_rng_below(rng, (uint64_t)range);
    return ldexp(1 + buffon_rng_next(rng), -k);
}

static void test_disks(void)
{
    const double radius = 0x1.7p+3;
    const buffon_density polar = buffon_disk(radius), concentric = buffon_disk_concentric(radius);
    ulps_worst p = {0}, q = {0}, area = {0};
    buffon_rng rng = buffon_rng_make(1, 22);
    int inside = 1;
    for (int k = 0; k < DRAWS; k++) {
        double u[2], x[2], pdf;
        wide c, s, r;
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &polar) != BUFFON_OK)
            p.ulps = INFINITY;
        ulps_circle(&c, &s, u[1]);
        r = sqrtl(u[0]);
        r = r > CIRCLE_RIM ? (wide)CIRCLE_RIM : r;
        see(&p, x[0], radius * r * c);
        see(&p, x[1], radius * r * s);
        see(&area, pdf, 1 / (WIDE_PI * radius * radius));
        inside &= x[0] * x[0] + x[1] * x[1] <= radius * radius;
        if (buffon_density_sample(x, &pdf, u, 1, &concentric) != BUFFON_OK)
            q.ulps = INFINITY;
        const double a = 2 * u[0] - 1, b = 2 * u[1] - 1;
        const wide turn = fabs(a) > fabs(b) ? WIDE_PI / 4 * b / a : WIDE_PI / 4 * a / b;
        r = fabs(a) > fabs(b) ? a : b;
        r = r > CIRCLE_RIM ? (wide)CIRCLE_RIM : r < -CIRCLE_RIM ? -(wide)CIRCLE_RIM : r;
        see(&q, x[0], radius * r * (fabs(a) > fabs(b) ? cosl(turn) : sinl(turn)));
        see(&q, x[1], radius * r * (fabs(a) > fabs(b) ? sinl(turn) : cosl(turn)));
        inside &= x[0] * x[0] + x[1] * x[1] <= radius * radius;
    }
    report(&p, 4, "disk, polar, in ulp");
    report(&q, 4, "disk, concentric, in ulp");
    report(&area, 2, "disk, pdf in ulp");
    tap_ok(inside, "no point lies outside the disk");
}

/* Radii and angles of every kind at the very edge. */
static void test_rim(void)
{
    int inside = 1;
    buffon_rng rng = buffon_rng_make(2, 22);
    for (int k = 0; k < DRAWS; k++) {
        const double radius = 0x1p400 * scaled(&rng, 800);
        const buffon_density g[2] = {buffon_disk(radius), buffon_disk_concentric(radius)};
        const uint64_t steps = 1 + 2 * buffon_rng_below(&rng, 8);
        const double u[2] = {1 - (double)steps * 0x1p-53, buffon_rng_next(&rng)};
        for (int j = 0; j < 2; j++) {
            double x[2], pdf;
            inside &= buffon_density_sample(x, NULL, u, 1, &g[j]) == BUFFON_OK;
            inside &= x[0] * x[0] + x[1] * x[1] <= radius * radius;
            inside &= buffon_density_pdf(&pdf, x, 1, &g[j]) == BUFFON_OK && pdf > 0;
        }
    }
    tap_ok(inside, "x^2 + y^2 <= r^2 as computed, at the edge of disks of any size");
}

static void test_sphere(void)
{
    const buffon_density g = buffon_sphere();
    ulps_worst w = {0}, pole = {0};
    buffon_rng rng = buffon_rng_make(3, 22);
    for (int k = 0; k < DRAWS; k++) {
        double u[2], x[3], pdf;
        wide c, s;
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            w.ulps = INFINITY;
        ulps_circle(&c, &s, u[1]);
        const wide sine = 2 * sqrtl((wide)u[0] * (1 - (wide)u[0]));
        see(&w, x[0], sine * c);
        see(&w, x[1], sine * s);
        see(&pole, x[2], 1 - 2 * (wide)u[0]);
        see(&pole, pdf, 1 / (4 * WIDE_PI));
    }
    report(&w, 3, "sphere, x and y in ulp");
    report(&pole, 0.5, "sphere, z and pdf in ulp");
}

/* A cap of height h about +z: x, y and depth at every size, from the h and 2 - h that it was given.
 * */
static void see_cap(ulps_worst *across, ulps_worst *height, ulps_worst *area,
                    const buffon_density *g, wide h, buffon_rng *rng, int k)
{
    double u[2], x[3], pdf;
    wide c, s;
    grid_pair(u, rng, k);
    if (buffon_density_sample(x, &pdf, u, 1, g) != BUFFON_OK)
        across->ulps = INFINITY;
    ulps_circle(&c, &s, u[1]);
    const wide sine = sqrtl(h * u[0] * ((2 - h) + h * (1 - (wide)u[0])));
    see(across, x[0], sine * c);
    see(across, x[1], sine * s);
    see_part(height, x[2], 1 - h * u[0], 1);
    see(area, pdf, 1 / (2 * WIDE_PI * h));
}

static void test_caps(void)
{
    const double up[3] = {0, 0, 1};
    ulps_worst across = {0}, height = {0}, area = {0}, angle = {0};
    buffon_rng rng = buffon_rng_make(4, 22);
    for (int k = 0; k < DRAWS; k++) {
        /* From 2^-1020 to 2, and as near to 2. */
        const double h = k % 3 ? scaled(&rng, 1020) : 2 - 0.25 * scaled(&rng, 50);
        const buffon_density g = buffon_cap_height(h, up);
        see_cap(&across, &height, &area, &g, h, &rng, k);
        const double cut = k % 2 ? 2 * buffon_rng_next(&rng) - 1 : 0.5 * scaled(&rng, 50) - 1;
        const buffon_density plane = buffon_cap(cut);
        see_cap(&across, &height, &area, &plane, 1 - (wide)cut, &rng, k);
        const double theta = k % 4 ? 3.1415926535897931 * buffon_rng_next(&rng)
                                   : ldexp(1 + buffon_rng_next(&rng), -(k % 500));
        const buffon_density cone = buffon_cap_angle(theta, up);
        const double u[2] = {0.25, 0.25};
        double x[3], pdf;
        if (buffon_density_sample(x, &pdf, u, 1, &cone) != BUFFON_OK)
            angle.ulps = INFINITY;
        const wide sine = sinl((wide)theta / 2);
        see(&angle, pdf, 1 / (4 * WIDE_PI * sine * sine));
    }
    report(&across, 4, "cap about +z, x and y in ulp, h from 2^-1020 to 2");
    report(&height, 1, "cap about +z, z in ulp of 1");
    report(&area, 2, "cap, pdf in ulp");
    report(&angle, 6, "cap of an angle from 2^-500 to pi, pdf in ulp");
}

/* About any axis: distance from the turned true point, in the same frame. */
static void test_turned(void)
{
    double error = 0, length = 0, square = 0;
    int inside = 1;
    buffon_rng rng = buffon_rng_make(5, 22);
    for (int k = 0; k < DRAWS; k++) {
        double axis[3], x[3], pdf, again;
        for (int j = 0; j < 3; j++)
            axis[j] = (2 * buffon_rng_next(&rng) - 1) * ldexp(1, j == k % 3 ? 0 : -(k % 60));
        if (k % 2)
            axis[2] = -fabs(axis[2]);
        const double h = ldexp(1 + buffon_rng_next(&rng), -(k % 100));
        const buffon_density g[2] = {buffon_cap_height(h, axis),
                                     buffon_hemisphere_cosine_about(axis)};
        double u[2];
        grid_pair(u, &rng, k);
        for (int m = 0; m < 2; m++) {
            inside &= buffon_density_sample(x, &pdf, u, 1, &g[m]) == BUFFON_OK;
            inside &= buffon_density_pdf(&again, x, 1, &g[m]) == BUFFON_OK && again > 0;
            error = fmax(error, m ? fabs(pdf - again) : 0);
            const wide r2 = (wide)x[0] * x[0] + (wide)x[1] * x[1] + (wide)x[2] * x[2];
            length = fmax(length, fabs((double)(r2 - 1)));
            if (m)
                continue;
            /* The cosine with the axis itself, from the chord. */
            const wide n =
                sqrtl((wide)axis[0] * axis[0] + (wide)axis[1] * axis[1] + (wide)axis[2] * axis[2]);
            const wide z = (x[0] * (wide)axis[0] + x[1] * (wide)axis[1] + x[2] * (wide)axis[2]) / n;
            square = fmax(square, fabs((double)(z - (1 - (wide)h * u[0]))));
        }
    }
    tap_ok(inside, "turned points lie in their caps and hemispheres, with a pdf");
    tap_ok(length <= 0x1p-48, "turned points: |x| within 2^-49 of 1");
    tap_note("| |x|^2 - 1 | up to %.3g", length);
    tap_ok(square <= 0x1p-50, "turned caps: height within 2^-50");
    tap_note("up to %.3g", square);
    tap_ok(error <= 0x1p-51, "turned cosine hemisphere: pdf within 2^-51");
    tap_note("up to %.3g", error);
}

static void test_frames(void)
{
    double error = 0;
    buffon_rng rng = buffon_rng_make(6, 22);
    for (int k = 0; k < DRAWS; k++) {
        double axis[3];
        for (int j = 0; j < 3; j++)
            axis[j] = (2 * buffon_rng_next(&rng) - 1) * ldexp(1, j == 2 ? 0 : -(k % 60));
        const buffon_density g = buffon_hemisphere_about(axis);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b <= a; b++) {
                wide dot = 0;
                for (int j = 0; j < 3; j++)
                    dot += (wide)g.param[3 * a + j] * g.param[3 * b + j];
                error = fmax(error, fabs((double)(dot - (a == b))));
            }
    }
    tap_ok(error <= 0x1p-50, "frames are orthonormal within 2^-50");
    tap_note("up to %.3g", error);
}

static void test_cosine(void)
{
    const buffon_density g = buffon_hemisphere_cosine();
    ulps_worst w = {0};
    double least = 1;
    buffon_rng rng = buffon_rng_make(7, 22);
    for (int k = 0; k < DRAWS; k++) {
        double u[2], x[3], pdf;
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            w.ulps = INFINITY;
        const double a = 2 * u[0] - 1, b = 2 * u[1] - 1, big = fabs(a) > fabs(b) ? u[0] : u[1];
        const wide z = 2 * sqrtl((wide)big * (1 - (wide)big));
        see(&w, x[2], z);
        see(&w, pdf, z / WIDE_PI);
        least = fmin(least, pdf);
    }
    report(&w, 3, "cosine hemisphere, z and pdf in ulp");
    tap_ok(least > 0x1p-30, "a cosine sample never has a pdf of zero");
}

/* Spheres from afar and from near. */
static void test_seen(void)
{
    ulps_worst w = {0};
    buffon_rng rng = buffon_rng_make(8, 22);
    for (int k = 0; k < DRAWS; k++) {
        double from[3], centre[3], x[3], pdf;
        const double u[2] = {0.5, 0.5}, radius = ldexp(1 + buffon_rng_next(&rng), -(k % 400));
        wide d2 = 0;
        for (int j = 0; j < 3; j++) {
            from[j] = k % 2 ? 0 : buffon_rng_next(&rng);
            centre[j] = 3 + buffon_rng_next(&rng);
            d2 += ((wide)centre[j] - from[j]) * ((wide)centre[j] - from[j]);
        }
        const buffon_density g = buffon_cap_of_sphere(from, centre, radius);
        const wide s2 = (wide)radius * radius / d2;
        if (s2 > 1 / 1.21L)
            continue;
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            w.ulps = INFINITY;
        see(&w, pdf, (1 + sqrtl(1 - s2)) / (2 * WIDE_PI * s2));
    }
    report(&w, 8, "sphere from 1.1 to 2^400 radii off, pdf in ulp");
}

static void test_boxes(void)
{
    ulps_worst range = {0}, origin = {0}, volume = {0};
    buffon_rng rng = buffon_rng_make(9, 22);
    for (int k = 0; k < DRAWS; k++) {
        const double a = (2 * buffon_rng_next(&rng) - 1) * ldexp(1, k % 40 - 20);
        const double b = (2 * buffon_rng_next(&rng) - 1) * ldexp(1, k % 37 - 20);
        const double lo = fmin(a, b), hi = fmax(a, b), u = grid(&rng, k);
        const wide exact = lo + u * ((wide)hi - lo);
        const double x = buffon_segment_sample(u, lo, hi);
        see_part(&range, x, exact, fmax(fabs(lo), fabs(hi)));
        see(&origin, buffon_segment_sample(u, 0, fabs(a)), (wide)u * fabs(a));
    }
    report(&range, 2, "box, in 2^-52 of the larger bound");
    report(&origin, 1, "box from 0, in ulp");
    for (int k = 0; k < 1000; k++) {
        double lo[12], hi[12], pdf, m;
        const double x[12] = {0};
        const size_t dim = 1 + (size_t)k % 12;
        wide exact = 1;
        int e;
        for (size_t j = 0; j < dim; j++) {
            lo[j] = -0x1p50 * scaled(&rng, 100);
            hi[j] = buffon_rng_next(&rng);
            exact *= (wide)hi[j] - lo[j];
        }
        const buffon_density g = buffon_box(lo, hi, dim);
        if (buffon_density_pdf(&pdf, x, 1, &g) != BUFFON_OK)
            volume.ulps = INFINITY;
        see_error(&volume, fabsl(pdf * exact - 1) * 0x1p52L / (wide)(dim + 1));
        buffon_priv_box_volume(&m, &e, lo, hi, dim);
        see_error(&volume, fabsl(ldexpl(m, e) / exact - 1) * 0x1p52L / (wide)dim);
    }
    report(&volume, 1, "box of dim coordinates, pdf in 2^-52 (dim + 1) of itself");
}

int main(void)
{
    if (!ulps_have_wide()) {
        printf("1..0 # SKIP long double is no wider than double here\n");
        return 0;
    }
    test_disks();
    test_rim();
    test_sphere();
    test_caps();
    test_turned();
    test_frames();
    test_cosine();
    test_seen();
    test_boxes();
    return tap_done();
}
