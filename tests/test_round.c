/* Round shapes in the plane and in space: the samplers against their formulas in extended precision
 * over all legal sizes (the numbers behind `Exact:` in the headers), there and back, and what is
 * refused. */
#include <float.h>
#include <math.h>

#include <buffon/buffon.h>

#include "../src/circle.h"
#include "refused.h"
#include "round.h"

enum { DRAWS = 20000 };

/* ---- plane shapes ------------------------------------------------------------------------- */

static void test_circle(void)
{
    ulps_worst point = {0}, length = {0};
    buffon_rng rng = buffon_rng_make(1, 40);
    for (int k = 0; k < DRAWS; k++) {
        const double radius = k % 9 ? any(&rng, -1021, 1017) : k % 2 ? DBL_MIN : 0x1p1017;
        const double u = grid(&rng, k);
        const buffon_density g = buffon_circle(radius);
        double x[2], pdf;
        wide c, s;
        if (buffon_density_sample(x, &pdf, &u, 1, &g) != BUFFON_OK)
            point.ulps = INFINITY;
        ulps_circle(&c, &s, u);
        see(&point, x[0], radius * c);
        see(&point, x[1], radius * s);
        see(&length, pdf, 1 / (2 * WIDE_PI * radius));
    }
    report(&point, 3, "circle, x and y in ulp");
    report(&length, 2, "circle, g in ulp");
}

static void test_rings(void)
{
    ulps_worst point = {0}, area = {0}, part = {0}, slice = {0};
    const double full = 0x1.921fb54442d18p+2;
    buffon_rng rng = buffon_rng_make(2, 40);
    for (int k = 0; k < 3 * DRAWS; k++) {
        const double r1 = any(&rng, -440, 480), r0 = below(&rng, r1);
        const double start = (2 * buffon_rng_next(&rng) - 1) * full;
        const double angle0 = k % 3 ? start : -full + below(&rng, full);
        const double angle1 =
            angle0 + (k % 2 ? ldexp(full, -(k % 50)) : full * buffon_rng_next(&rng));
        const double rim = r0 > 0 ? 2 : CIRCLE_RIM;
        const wide squares = ((wide)r1 - r0) * ((wide)r1 + r0);
        const buffon_density g = buffon_annulus(r0, r1);
        double x[2], pdf, u[2];
        wide c, s;
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            point.ulps = INFINITY;
        ulps_circle(&c, &s, u[1]);
        wide r = sqrtl((wide)r0 * r0 + u[0] * squares);
        r = r > rim * r1 ? (wide)rim * r1 : r;
        see(&point, x[0], r * c);
        see(&point, x[1], r * s);
        see(&area, pdf, 1 / (WIDE_PI * squares));
        if (!(angle1 <= full && angle1 - angle0 <= full && angle1 > angle0))
            continue;
        const buffon_density h = buffon_disk_sector(r0, r1, angle0, angle1);
        if (buffon_density_sample(x, &pdf, u, 1, &h) != BUFFON_OK)
            part.ulps = INFINITY;
        const wide angle = angle0 + u[1] * ((wide)angle1 - angle0);
        see_part(&part, x[0], r * cosl(angle), r1);
        see_part(&part, x[1], r * sinl(angle), r1);
        see(&slice, pdf, 2 / (((wide)angle1 - angle0) * squares));
    }
    report(&point, 4, "annulus, x and y in ulp");
    report(&area, 4, "annulus, g in ulp");
    report(&part, 8, "sector, x and y in 2^-52 of the radius");
    report(&slice, 4, "sector, g in ulp");
}

static void test_ellipse(void)
{
    ulps_worst point = {0}, area = {0};
    int inside = 1;
    buffon_rng rng = buffon_rng_make(3, 40);
    for (int k = 0; k < DRAWS; k++) {
        const double a = k % 5 ? any(&rng, -500, 500) : any(&rng, -1021, -900);
        const double b = k % 5 ? any(&rng, -500, 500) : any(&rng, 0, 1000);
        const buffon_density g = buffon_ellipse(a, b);
        double x[2], pdf, u[2];
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            point.ulps = INFINITY;
        const double p = 2 * u[0] - 1, q = 2 * u[1] - 1;
        const int flat = fabs(p) > fabs(q);
        const wide turn = flat ? WIDE_PI / 4 * q / p : WIDE_PI / 4 * p / q, rim = CIRCLE_RIM;
        const wide r = fmaxl(-rim, fminl(rim, flat ? p : q));
        see(&point, x[0], a * r * (flat ? cosl(turn) : sinl(turn)));
        see(&point, x[1], b * r * (flat ? sinl(turn) : cosl(turn)));
        see(&area, pdf, 1 / (WIDE_PI * a * b));
        inside &= x[0] / a * (x[0] / a) + x[1] / b * (x[1] / b) <= 1;
    }
    report(&point, 4, "ellipse, x and y in ulp");
    report(&area, 2, "ellipse, g in ulp");
    tap_ok(inside, "ellipse: (x / a)^2 + (y / b)^2 <= 1 as computed");
}

/* ---- balls and cylinders ------------------------------------------------------------------ */

static void test_balls(void)
{
    ulps_worst point = {0}, volume = {0};
    int inside = 1;
    buffon_rng rng = buffon_rng_make(10, 40);
    for (int k = 0; k < 2 * DRAWS; k++) {
        const double r1 = any(&rng, -320, 339), r0 = k % 3 ? below(&rng, r1) : 0;
        const double u[3] = {grid(&rng, k), grid(&rng, k / 2), grid(&rng, k / 4)};
        const wide rim = r0 > 0 ? 2 * (wide)r1 : (wide)CIRCLE_RIM * r1;
        const wide cubes = ((wide)r1 - r0) * ((wide)r1 * r1 + (wide)r1 * r0 + (wide)r0 * r0);
        const buffon_density g = r0 > 0 ? buffon_shell(r0, r1) : buffon_ball(r1);
        double x[3], pdf;
        wide c, s;
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            point.ulps = INFINITY;
        ulps_circle(&c, &s, u[2]);
        const wide r = fminl(rim, cbrtl((wide)r0 * r0 * r0 + u[0] * cubes));
        const wide sine = 2 * sqrtl((wide)u[1] * (1 - (wide)u[1]));
        see(&point, x[0], r * sine * c);
        see(&point, x[1], r * sine * s);
        see(&point, x[2], r * (1 - 2 * (wide)u[1]));
        see(&volume, pdf, 3 / (4 * WIDE_PI * cubes));
        inside &= r0 > 0 || x[0] * x[0] + x[1] * x[1] + x[2] * x[2] <= r1 * r1;
        inside &= buffon_density_pdf(x, x, 1, &g) == BUFFON_OK && x[0] == pdf;
    }
    report(&point, 5, "ball and shell, x, y and z in ulp");
    report(&volume, 5, "ball and shell, g in ulp");
    tap_ok(inside, "ball: x^2 + y^2 + z^2 <= r^2 as computed");
}

/* The frame that completes the axis is one that the library states: Duff's. */
static void test_cylinders(void)
{
    ulps_worst point = {0}, area = {0};
    buffon_rng rng = buffon_rng_make(11, 40);
    for (int k = 0; k < DRAWS; k++) {
        const double size = k % 4 ? 1 : any(&rng, -400, 400);
        double from[3], to[3], x[3], u[2], pdf, again, most;
        wide n[3], length = 0, c, s;
        const double radius = most = size * any(&rng, -20, 4);
        for (int j = 0; j < 3; j++) {
            from[j] = k % 3 ? size * (2 * buffon_rng_next(&rng) - 1) : 0;
            to[j] = size * (2 * buffon_rng_next(&rng) - 1) * ldexp(1, -(k % 7) * j);
            most = fmax(most, fmax(fabs(from[j]), fabs(to[j])));
            n[j] = (wide)to[j] - from[j];
            length += n[j] * n[j];
        }
        length = sqrtl(length);
        for (int j = 0; j < 3; j++)
            n[j] /= length;
        const buffon_density g = buffon_cylinder(from, to, radius);
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK ||
            buffon_density_pdf(&again, x, 1, &g) != BUFFON_OK || again != pdf)
            point.ulps = INFINITY;
        ulps_circle(&c, &s, u[1]);
        const wide sign = n[2] < 0 ? -1 : 1, a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
        const wide t[3] = {1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
        const wide q[3] = {b, sign + n[1] * n[1] * a, -n[1]};
        for (int j = 0; j < 3; j++)
            see_part(&point, x[j], from[j] + u[0] * length * n[j] + radius * (c * t[j] + s * q[j]),
                     most);
        see(&area, pdf, 1 / (2 * WIDE_PI * radius * length));
    }
    report(&point, 4, "cylinder, coordinates in 2^-52 of the largest");
    report(&area, 5, "cylinder, g in ulp");
}

/* ---- known values ------------------------------------------------------------------------- */

static void test_plane(void)
{
    const double pi = 0x1.921fb54442d18p+1;
    const buffon_density disk = buffon_disk(1.5), ring = buffon_annulus(0, 1.5);
    const buffon_density circle2 = buffon_circle(2), ellipse = buffon_ellipse(3, 0.5);
    const buffon_density thin = buffon_annulus(1 - 0x1p-40, 1),
                         wedge = buffon_disk_sector(1, 2, -0.5, 0.25);
    const buffon_density behind = buffon_disk_sector(0, 1, 3, 3.5),
                         whole = buffon_disk_sector(0, 1, -pi, pi);
    int same = 1;
    buffon_rng rng = buffon_rng_make(4, 40);
    for (int k = 0; k < 1000; k++) {
        double u[2], x[2], y[2];
        grid_pair(u, &rng, k);
        same &= buffon_density_sample(x, NULL, u, 1, &disk) == BUFFON_OK &&
                buffon_density_sample(y, NULL, u, 1, &ring) == BUFFON_OK && x[0] == y[0] &&
                x[1] == y[1];
    }
    tap_ok(same, "an annulus from 0 has the points of the disk");
    tap_ok(pdf_at(&circle2, 2, 0, 0) == 0.25 / pi && pdf_at(&circle2, 2.1, 0, 0) == 0 &&
               pdf_at(&circle2, 0, 0, 0) == 0 && pdf_at(&circle2, NAN, 0, 0) == 0 &&
               pdf_at(&circle2, INFINITY, 0, 0) == 0,
           "circle: g on it and off it");
    tap_ok(pdf_at(&thin, 1, 0, 0) > 0x1p37 && pdf_at(&thin, 1 - 0x1p-39, 0, 0) == 0 &&
               pdf_at(&thin, 1 + 0x1p-40, 0, 0) == 0 && pdf_at(&thin, NAN, 1, 0) == 0,
           "annulus: g between its circles only");
    tap_ok(fabs(pdf_at(&wedge, 1.5, 0, 0) - 2 / (0.75 * 3)) < 1e-15 &&
               pdf_at(&wedge, 1.5, 1, 0) == 0 && pdf_at(&wedge, -1.5, 0, 0) == 0 &&
               pdf_at(&wedge, 0.5, 0, 0) == 0 && pdf_at(&wedge, 1.4, -0.7, 0) > 0 &&
               pdf_at(&wedge, 1.4, -0.8, 0) == 0,
           "sector: g between its edges only");
    tap_ok(pdf_at(&behind, -1, 0, 0) > 0 && pdf_at(&behind, -0.5, -0.1, 0) > 0 &&
               pdf_at(&behind, 0.5, 0, 0) == 0 && pdf_at(&whole, -0.5, -1e-300, 0) == 1 / pi,
           "sector: across the negative x axis, and a whole disk");
    tap_ok(pdf_at(&ellipse, 2.9, 0, 0) > 0 && pdf_at(&ellipse, 0, 0.6, 0) == 0 &&
               pdf_at(&ellipse, NAN, 0, 0) == 0,
           "ellipse: g inside only");
    check_back(&circle2, 1, "circle");
    check_back(&ellipse, 4, "ellipse");
    check_back(&thin, 0x1p40, "thin annulus");
    check_back(&wedge, 8, "sector");
    check_back(&behind, 16, "sector behind");
    check_back(&whole, 4, "sector of a full turn");
}

static void test_solids(void)
{
    const double pi = 0x1.921fb54442d18p+1, from[3] = {1, 2, 3}, to[3] = {1, 2, 5};
    const double far[3] = {0, INFINITY, 0}, nan[3] = {0, 0, NAN};
    const buffon_density ball = buffon_ball(2), shell = buffon_shell(1, 2);
    const buffon_density thin = buffon_shell(1, 1 + 0x1p-40);
    const buffon_density tube = buffon_cylinder(from, to, 0.5);
    tap_ok(fabs(pdf_at(&ball, 1, 1, -1) * 32 * pi / 3 - 1) < 1e-15 &&
               pdf_at(&ball, 1.2, 1.2, 1.2) == 0 && pdf_at(&ball, NAN, 0, 0) == 0,
           "ball: g inside only");
    tap_ok(fabs(pdf_at(&shell, 1, 1, -1) * 28 * pi / 3 - 1) < 1e-15 &&
               pdf_at(&shell, 0.5, 0.5, 0.5) == 0 && pdf_at(&shell, 1.2, 1.2, 1.2) == 0,
           "shell: g between its spheres only");
    tap_ok(fabs(pdf_at(&tube, 1.5, 2, 4) * 2 * pi - 1) < 1e-15 && pdf_at(&tube, 1.5, 2, 2.9) == 0 &&
               pdf_at(&tube, 1.5, 2, 5.1) == 0 && pdf_at(&tube, 1, 2, 4) == 0 &&
               pdf_at(&tube, 1, 2.5, 3) > 0 && pdf_at(&tube, NAN, 2, 4) == 0,
           "cylinder: g on its side only");
    check_back(&ball, 16, "ball");
    check_back(&shell, 16, "shell");
    check_back(&thin, 0x1p41, "thin shell");
    check_back(&tube, 64, "cylinder");
    refused_by_value(buffon_ball(0), BUFFON_E_SHAPE, "a ball of radius 0");
    refused_by_value(buffon_ball(-1), BUFFON_E_SHAPE, "a ball of radius -1");
    refused_by_value(buffon_ball(NAN), BUFFON_E_SHAPE, "a ball of radius NaN");
    refused_by_value(buffon_ball(INFINITY), BUFFON_E_SHAPE, "a ball without end");
    refused_by_value(buffon_ball(0x1p-341), BUFFON_E_SHAPE, "a ball with g past DBL_MAX");
    refused_by_value(buffon_ball(0x1p341), BUFFON_E_SHAPE, "a large ball");
    refused_by_value(buffon_shell(1, 1), BUFFON_E_SHAPE, "a shell without width");
    refused_by_value(buffon_shell(2, 1), BUFFON_E_SHAPE, "a shell inside out");
    refused_by_value(buffon_shell(-0.5, 1), BUFFON_E_SHAPE, "a negative radius");
    refused_by_value(buffon_shell(NAN, 1), BUFFON_E_SHAPE, "a radius of NaN");
    refused_by_value(buffon_cylinder(NULL, to, 1), BUFFON_E_NULL, "a cylinder from nowhere");
    refused_by_value(buffon_cylinder(from, NULL, 1), BUFFON_E_NULL, "a cylinder to nowhere");
    refused_by_value(buffon_cylinder(from, from, 1), BUFFON_E_SHAPE, "a cylinder of no length");
    refused_by_value(buffon_cylinder(from, to, 0), BUFFON_E_SHAPE, "a cylinder of radius 0");
    refused_by_value(buffon_cylinder(from, to, -1), BUFFON_E_SHAPE, "a cylinder of radius -1");
    refused_by_value(buffon_cylinder(from, to, NAN), BUFFON_E_SHAPE, "a cylinder of radius NaN");
    refused_by_value(buffon_cylinder(from, to, INFINITY), BUFFON_E_SHAPE, "a wide cylinder");
    refused_by_value(buffon_cylinder(from, far, 1), BUFFON_E_SHAPE, "a cylinder to infinity");
    refused_by_value(buffon_cylinder(nan, to, 1), BUFFON_E_SHAPE, "a cylinder from NaN");
    refused_by_value(buffon_cylinder(from, to, 0x1p-1024), BUFFON_E_SHAPE, "a cylinder of no area");
}

static void refuse_plane(void)
{
    static const double bad[] = {0, -0.0, -1, 0x1p-1074, NAN, INFINITY, -INFINITY, DBL_MAX};
    int shape = 1;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        const buffon_density g[] = {buffon_circle(bad[k]),
                                    buffon_annulus(0, bad[k]),
                                    buffon_annulus(1, -fabs(bad[k])),
                                    buffon_annulus(bad[k] == 0 ? -0x1p-30 : -fabs(bad[k]), 1),
                                    buffon_disk_sector(0, bad[k], 0, 1),
                                    buffon_ellipse(bad[k], 1e10),
                                    buffon_ellipse(1e10, bad[k])};
        for (size_t j = 0; j < sizeof g / sizeof *g; j++)
            shape &= g[j].status == BUFFON_E_SHAPE;
    }
    tap_ok(shape, "radii that are none are refused");
    refused_by_value(buffon_circle(nextafter(0x1p1017, INFINITY)), BUFFON_E_SHAPE,
                     "a large circle");
    refused_by_value(buffon_annulus(1, 1), BUFFON_E_SHAPE, "a ring without width");
    refused_by_value(buffon_annulus(2, 1), BUFFON_E_SHAPE, "a ring inside out");
    refused_by_value(buffon_annulus(0, 0x1p-512), BUFFON_E_SHAPE, "a ring with g past DBL_MAX");
    refused_by_value(buffon_annulus(0, nextafter(0x1p510, INFINITY)), BUFFON_E_SHAPE,
                     "a large ring");
    refused_by_value(buffon_disk_sector(0, 0x1.8p510, 0, 1e-3), BUFFON_E_SHAPE, "a large sector");
    const buffon_density largest = buffon_annulus(0, 0x1p510);
    tap_ok(pdf_at(&largest, 0x1p509, 0, 0) >= DBL_MIN, "the largest ring is not");
    refused_by_value(buffon_disk_sector(0, 1, 1, 1), BUFFON_E_SHAPE, "a sector without angle");
    refused_by_value(buffon_disk_sector(0, 1, 1, 0.5), BUFFON_E_SHAPE, "a sector backwards");
    refused_by_value(buffon_disk_sector(0, 1, 0, NAN), BUFFON_E_SHAPE, "a sector to NaN");
    refused_by_value(buffon_disk_sector(0, 1, -1, 6), BUFFON_E_SHAPE, "a sector of over a turn");
    refused_by_value(buffon_disk_sector(0, 1, 6, 7), BUFFON_E_SHAPE, "an angle over 2 pi");
    refused_by_value(buffon_disk_sector(0, 1, -7, -6), BUFFON_E_SHAPE, "an angle under -2 pi");
    refused_by_value(buffon_disk_sector(0, 0x1p-500, 0, 1e-300), BUFFON_E_SHAPE, "a sliver");
    refused_by_value(buffon_ellipse(0x1p-1022, 0.5), BUFFON_E_SHAPE, "an ellipse with g past it");
    refused_by_value(buffon_ellipse(0x1p1000, 0x1p21), BUFFON_E_SHAPE, "a large ellipse");
}

int main(void)
{
    if (ulps_have_wide()) {
        test_circle();
        test_rings();
        test_ellipse();
        test_balls();
        test_cylinders();
    }
    test_plane();
    refuse_plane();
    test_solids();
    return tap_done();
}
