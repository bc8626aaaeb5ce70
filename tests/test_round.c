/* Round shapes, in the plane and in space: the samplers against their formulas in extended
 * precision over all legal sizes (the numbers behind `Exact:` in the headers), there and back, and
 * what is refused. */
#include <float.h>
#include <math.h>

#include <buffon/buffon.h>

#include "../src/circle.h"
#include "grid.h"
#include "refused.h"

typedef long double wide;

#define WIDE_PI 3.14159265358979323846264338327950288L

enum { DRAWS = 20000 };

static const double up[3] = {0, 0, 1};

/* Valgrind, for one, computes long doubles in 53 bits. */
static int have_wide(void)
{
    volatile wide one = 1, tiny = 0x1p-60L;
    return LDBL_MANT_DIG >= 64 && one + tiny > one;
}

/* ---- errors ------------------------------------------------------------------------------- */

static wide ulp(wide x)
{
    const double a = fabs((double)x);
    return a < DBL_MIN ? 0x1p-1074L : (wide)nextafter(a, INFINITY) - a;
}

/* The worst error met, in the unit of the check. */
typedef struct worst {
    double most;
} worst;

static void see_error(worst *w, wide error)
{
    if (!(error <= w->most))
        w->most = error == error ? (double)error : INFINITY;
}

/* Relative, in units of 2^-52. */
static void see_share(worst *w, double x, wide exact)
{
    see_error(w, fabsl(x - exact) / fabsl(exact) * 0x1p52L);
}

/* In ulp of the true value. */
static void see(worst *w, double x, wide exact)
{
    see_error(w, fabsl(x - exact) / ulp(exact));
}

/* Of the size of the shape, in units of 2^-52. */
static void see_part(worst *w, double x, wide exact, double size)
{
    see_error(w, fabsl(x - exact) / size * 0x1p52L);
}

static void report(const worst *w, double limit, const char *what)
{
    tap_ok(w->most <= limit, "%s: at most %g", what, limit);
    tap_note("worst %.3f", w->most);
}

/* sin and cos of 2 pi t: the reduction by quarters is exact. */
static void circle(wide *c, wide *s, wide t)
{
    const wide quarters = floorl(4 * t + 0.5L), rest = t - 0.25L * quarters;
    const wide sine = sinl(2 * WIDE_PI * rest), cosine = cosl(2 * WIDE_PI * rest);
    const int k = (int)quarters & 3;
    *c = k == 0 ? cosine : k == 1 ? -sine : k == 2 ? -cosine : sine;
    *s = k == 0 ? sine : k == 1 ? cosine : k == 2 ? -sine : -cosine;
}

/* ---- arguments ---------------------------------------------------------------------------- */

/* Of any size from 2^low to 2^high. */
static double any(buffon_rng *rng, int low, int high)
{
    const double v = 1 + buffon_rng_next(rng);
    return ldexp(v, low + (int)buffon_rng_below(rng, (uint64_t)(high - low)));
}

/* In [0, top), now and then as near to it, or to 0, as may be. */
static double below(buffon_rng *rng, double top)
{
    const double v = buffon_rng_next(rng), small = ldexp(v, -(int)buffon_rng_below(rng, 52));
    switch (buffon_rng_below(rng, 5)) {
    case 0:
        return 0;
    case 1:
        return top * small;
    case 2:
        return fmin(top * (1 - small), nextafter(top, 0));
    case 3:
        return nextafter(top, 0);
    default:
        return top * v;
    }
}

/* ---- every density: there and back, and its pdf along the way ----------------------------- */

/* `lost` is how many times further apart the uniforms may be than rounding leaves points. */
static void check_back(const buffon_density *g, double lost, const char *what)
{
    double worst_u = 0;
    int same = g->status == BUFFON_OK;
    buffon_rng rng = buffon_rng_make(50, 40);
    for (int k = 0; same && k < 2000; k++) {
        double u[3], v[3] = {0}, x[3], pdf, again;
        for (size_t j = 0; j < g->uniforms; j++)
            u[j] = grid(&rng, k / (int)(j + 1));
        same &= buffon_density_sample(x, &pdf, u, 1, g) == BUFFON_OK &&
                buffon_density_pdf(&again, x, 1, g) == BUFFON_OK &&
                buffon_density_invert(v, x, 1, g) == BUFFON_OK;
        same &= pdf > 0 && again > 0 && isfinite(pdf);
        for (size_t j = 0; j < g->uniforms; j++) {
            /* An angle means nothing at the middle, and next to nothing near it. */
            const double off = fabs(u[j] - v[j]), turn = fmin(off, 1 - off);
            same &= v[j] > 0 && v[j] < 1;
            if (u[0] > 1e-4 && u[0] < 1 - 1e-4 && u[1 % g->uniforms] > 1e-4 &&
                u[1 % g->uniforms] < 1 - 1e-4)
                worst_u = fmax(worst_u, turn);
        }
    }
    tap_ok(same && worst_u <= lost * 0x1p-50, "%s: there and back", what);
    if (!(same && worst_u <= lost * 0x1p-50))
        tap_note("uniforms differ by up to %.3g", worst_u);
}

static double pdf_at(const buffon_density *g, double x, double y, double z)
{
    double pdf = NAN;
    const double point[3] = {x, y, z};
    return buffon_density_pdf(&pdf, point, 1, g) == BUFFON_OK ? pdf : (double)NAN;
}

/* ---- plane shapes ------------------------------------------------------------------------- */

static void test_circle(void)
{
    worst point = {0}, length = {0};
    buffon_rng rng = buffon_rng_make(1, 40);
    for (int k = 0; k < DRAWS; k++) {
        const double radius = k % 9 ? any(&rng, -1021, 1017) : k % 2 ? DBL_MIN : 0x1p1017;
        const double u = grid(&rng, k);
        const buffon_density g = buffon_circle(radius);
        double x[2], pdf;
        wide c, s;
        if (buffon_density_sample(x, &pdf, &u, 1, &g) != BUFFON_OK)
            point.most = INFINITY;
        circle(&c, &s, u);
        see(&point, x[0], radius * c);
        see(&point, x[1], radius * s);
        see(&length, pdf, 1 / (2 * WIDE_PI * radius));
    }
    report(&point, 3, "circle, x and y in ulp");
    report(&length, 2, "circle, g in ulp");
}

static void test_rings(void)
{
    worst point = {0}, area = {0}, part = {0}, slice = {0};
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
            point.most = INFINITY;
        circle(&c, &s, u[1]);
        wide r = sqrtl((wide)r0 * r0 + u[0] * squares);
        r = r > rim * r1 ? (wide)rim * r1 : r;
        see(&point, x[0], r * c);
        see(&point, x[1], r * s);
        see(&area, pdf, 1 / (WIDE_PI * squares));
        if (!(angle1 <= full && angle1 - angle0 <= full && angle1 > angle0))
            continue;
        const buffon_density h = buffon_disk_sector(r0, r1, angle0, angle1);
        if (buffon_density_sample(x, &pdf, u, 1, &h) != BUFFON_OK)
            part.most = INFINITY;
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
    worst point = {0}, area = {0};
    int inside = 1;
    buffon_rng rng = buffon_rng_make(3, 40);
    for (int k = 0; k < DRAWS; k++) {
        const double a = k % 5 ? any(&rng, -500, 500) : any(&rng, -1021, -900);
        const double b = k % 5 ? any(&rng, -500, 500) : any(&rng, 0, 1000);
        const buffon_density g = buffon_ellipse(a, b);
        double x[2], pdf, u[2];
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            point.most = INFINITY;
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

/* ---- zones and caps ----------------------------------------------------------------------- */

/* Half the chord of an angle, and of what is left of pi: squared and doubled, the depths from both
 * poles. */
static wide half_sine(double angle)
{
    return sinl(0.5L * angle);
}

static wide left_of_pi(double angle)
{
    return (0x1.921fb54442d18p+1L - angle) + 1.22464679914735317723e-16L;
}

static wide half_cosine(double angle)
{
    return sinl(0.5L * left_of_pi(angle));
}

typedef struct zone_errors {
    worst across, height, area;
} zone_errors;

/* From depth h0 on, of height h, and `rest` above the opposite pole. */
static void see_zone(zone_errors *w, const buffon_density *g, wide h0, wide h, wide rest,
                     buffon_rng *rng, int k)
{
    double u[2], x[3], pdf;
    wide c, s;
    grid_pair(u, rng, k);
    if (buffon_density_sample(x, &pdf, u, 1, g) != BUFFON_OK)
        w->across.most = INFINITY;
    circle(&c, &s, u[1]);
    const wide depth = h0 + h * u[0], above = rest + h * (1 - (wide)u[0]);
    see(&w->across, x[0], sqrtl(depth) * sqrtl(above) * c);
    see(&w->across, x[1], sqrtl(depth) * sqrtl(above) * s);
    see_part(&w->height, x[2], depth < 1 ? 1 - depth : above - 1, 1);
    see_share(&w->area, pdf, 1 / (2 * WIDE_PI * h));
    if (buffon_density_pdf(u, x, 1, g) != BUFFON_OK || u[0] != pdf)
        w->area.most = INFINITY;
}

/* From 0 to pi, as near to either as may be. */
static double any_angle(buffon_rng *rng, int k)
{
    const double pi = 0x1.921fb54442d18p+1, a = pi * buffon_rng_next(rng);
    const double small = any(rng, -500, 0);
    return k % 3 == 0 ? a : k % 3 == 1 ? small : fmax(0, pi - ldexp(small, 450));
}

static void test_zones(void)
{
    zone_errors planes = {0}, angles = {0}, heights = {0}, rest = {0};
    buffon_rng rng = buffon_rng_make(5, 40);
    for (int k = 0; k < 2 * DRAWS; k++) {
        const double z0 = 2 * buffon_rng_next(&rng) - 1, z1 = 1 - below(&rng, 1 - z0);
        if (z1 > z0) {
            const buffon_density g = buffon_zone(z0, z1, up);
            see_zone(&planes, &g, 1 - (wide)z1, (wide)z1 - z0, 1 + (wide)z0, &rng, k);
        }
        const double h1 = k % 3 ? any(&rng, -960, 0) : 2 - any(&rng, -53, 0), h0 = below(&rng, h1);
        if (h1 <= 2) {
            const buffon_density g = buffon_zone_heights(h0, h1, up);
            see_zone(&heights, &g, h0, (wide)h1 - h0, 2 - (wide)h1, &rng, k);
        }
        const double a1 = any_angle(&rng, k), a0 = k % 4 ? below(&rng, a1) : any_angle(&rng, k / 4);
        if (a1 > a0 && a1 - a0 > 0x1p-500) {
            const buffon_density g = buffon_zone_angles(a0, a1, up);
            const wide left = 0.5L * (left_of_pi(a0) + left_of_pi(a1));
            const wide mean = 0.5L * ((wide)a0 + a1), slope = sinl(fminl(mean, left));
            const wide h = 2 * sinl(0.5L * ((wide)a1 - a0)) * slope;
            see_zone(&angles, &g, 2 * half_sine(a0) * half_sine(a0), h,
                     2 * half_cosine(a1) * half_cosine(a1), &rng, k);
        }
        if (a1 > 0) {
            const buffon_density g = buffon_cap_complement_angle(a1, up);
            see_zone(&rest, &g, 2 * half_sine(a1) * half_sine(a1),
                     2 * half_cosine(a1) * half_cosine(a1), 0, &rng, k);
        }
    }
    report(&planes.across, 5, "zone between planes, x and y in ulp");
    report(&planes.height, 2, "zone between planes, z in 2^-52");
    report(&planes.area, 2, "zone between planes, g in 2^-52 of itself");
    report(&heights.across, 5, "zone by heights, x and y in ulp");
    report(&heights.height, 2, "zone by heights, z in 2^-52");
    report(&heights.area, 2, "zone by heights, g in 2^-52 of itself");
    report(&angles.across, 6, "zone by angles, x and y in ulp");
    report(&angles.height, 4, "zone by angles, z in 2^-52");
    report(&angles.area, 4, "zone by angles, g in 2^-52 of itself");
    report(&rest.across, 5, "all but a cap, x and y in ulp");
    report(&rest.height, 4, "all but a cap, z in 2^-52");
    report(&rest.area, 4, "all but a cap, g in 2^-52 of itself");
}

/* What was promised of caps: half angles from 1e-9 to pi, errors in 2^-52; 1 - cos and the sine of
 * the half angle as the edge has them, coordinates absolutely. */
static void test_cap_angles(void)
{
    worst area = {0}, height = {0}, sine = {0}, point = {0};
    buffon_rng rng = buffon_rng_make(6, 40);
    for (int k = 0; k < 2 * DRAWS; k++) {
        const double pi = 0x1.921fb54442d18p+1, v = buffon_rng_next(&rng);
        const double angle = k % 3 ? exp(log(1e-9) + v * (log(pi) - log(1e-9))) : pi * v;
        const buffon_density g = buffon_cap_angle(angle, up);
        double u[2], x[3], pdf;
        wide c, s;
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            area.most = INFINITY;
        const wide h = 2 * half_sine(angle) * half_sine(angle);
        const wide rest = 2 * half_cosine(angle) * half_cosine(angle);
        const wide w = h * u[0], r = sqrtl(w * (rest + h * (1 - (wide)u[0])));
        circle(&c, &s, u[1]);
        see_share(&area, pdf, 1 / (2 * WIDE_PI * h));
        see_share(&height, g.param[9], h);
        see_share(&sine, hypot(x[0], x[1]), r);
        see_part(&point, x[0], r * c, 1);
        see_part(&point, x[1], r * s, 1);
        see_part(&point, x[2], 1 - w, 1);
    }
    report(&area, 4, "cap of an angle from 1e-9 to pi, g in 2^-52 of itself");
    report(&height, 4, "cap of an angle from 1e-9 to pi, 1 - cos of the edge in 2^-52 of itself");
    report(&sine, 4, "cap of an angle from 1e-9 to pi, sine of a point in 2^-52 of itself");
    report(&point, 4, "cap of an angle from 1e-9 to pi, coordinates in 2^-52");
}

/* ---- powers of the cosine ----------------------------------------------------------------- */

static void test_powers(void)
{
    worst point = {0}, height = {0}, drawn = {0}, given = {0}, logs = {0}, back = {0};
    buffon_rng rng = buffon_rng_make(8, 40);
    for (int k = 0; k < 2 * DRAWS; k++) {
        const double edge[] = {0, 1, 1e15, 0x1p-1074, 0.5, 2, 3e7};
        const double power = k % 3 == 0 ? edge[k / 3 % 7] : any(&rng, k % 3 == 1 ? -60 : -3, 49);
        const buffon_density g = buffon_hemisphere_power(power);
        double u[2], x[3], pdf = NAN, again = NAN, log_pdf = NAN, v[2] = {0};
        wide c, s;
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK ||
            buffon_density_pdf(&again, x, 1, &g) != BUFFON_OK ||
            buffon_density_log_pdf(&log_pdf, x, 1, &g) != BUFFON_OK ||
            buffon_density_invert(v, x, 1, &g) != BUFFON_OK)
            point.most = INFINITY;
        circle(&c, &s, u[1]);
        const wide log_cosine = log1pl(-(wide)u[0]) / ((wide)power + 1);
        const wide sine = sqrtl(-expm1l(2 * log_cosine)), scale = ((wide)power + 1) / (2 * WIDE_PI);
        see(&point, x[0], sine * c);
        see(&point, x[1], sine * s);
        see(&height, x[2], expl(log_cosine));
        see(&drawn, pdf, scale * expl(power * log_cosine));
        /* At the point as it is: its sine, or its height where that is less. */
        const wide r2 = (wide)x[0] * x[0] + (wide)x[1] * x[1], z = x[2];
        const wide own =
            r2 < 0.5L ? 0.5L * log1pl(-r2 / (r2 + z * z)) : logl(z) - 0.5L * logl(r2 + z * z);
        const wide exact = scale * expl(power * own);
        if (exact > DBL_MIN)
            see_error(&given, fabsl(again - exact) / ulp(exact) / (5 - 3 * power * own));
        see_error(&logs, fabsl(log_pdf - (logl(scale) + power * own)) / 0x1p-52L /
                             (1 + fabsl(logl(scale)) - power * own));
        see_error(&back, fabs(v[0] - u[0]) / 0x1p-52L);
    }
    report(&point, 5, "power of the cosine, x and y in ulp");
    report(&height, 4, "power of the cosine, z in ulp");
    report(&drawn, 4, "power of the cosine, g along with the point in ulp");
    report(&given, 1, "power of the cosine, g at a point in 5 + 3 n |log z| ulp");
    report(&logs, 3, "power of the cosine, log g in 2^-52 of its terms");
    report(&back, 64, "power of the cosine, u1 of the point in 2^-52");
}

/* ---- balls and cylinders ------------------------------------------------------------------ */

static void test_balls(void)
{
    worst point = {0}, volume = {0};
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
            point.most = INFINITY;
        circle(&c, &s, u[2]);
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
    worst point = {0}, area = {0};
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
            point.most = INFINITY;
        circle(&c, &s, u[1]);
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

static void test_sphere_parts(void)
{
    const double aslant[3] = {-3, 2, -0.5}, pi = 0x1.921fb54442d18p+1;
    const buffon_density cap = buffon_cap_height(0.75, aslant);
    const buffon_density same_cap = buffon_zone_heights(0, 0.75, aslant);
    const buffon_density ring = buffon_zone_angles(pi - 1e-7, pi - 5e-8, up);
    const buffon_density band = buffon_zone(-0.25, 0.5, aslant);
    const buffon_density hole = buffon_cap_complement_angle(1e-9, up);
    const buffon_density most = buffon_cap_complement_height(1.5, aslant);
    const buffon_density thin = buffon_zone_heights(1, 1 + 0x1p-40, aslant);
    int same = 1;
    buffon_rng rng = buffon_rng_make(7, 40);
    for (int k = 0; k < 1000; k++) {
        double u[2], x[3], y[3];
        grid_pair(u, &rng, k);
        same &= buffon_density_sample(x, NULL, u, 1, &cap) == BUFFON_OK &&
                buffon_density_sample(y, NULL, u, 1, &same_cap) == BUFFON_OK && x[0] == y[0] &&
                x[1] == y[1] && x[2] == y[2];
    }
    tap_ok(same, "a zone from depth 0 has the points of the cap");
    tap_ok(fabs(pdf_at(&hole, 2e-9, 0, 1) * 4 * pi - 1) < 1e-15 &&
               pdf_at(&hole, 1e-10, 0, 1) == 0 && pdf_at(&hole, 0, 0, -1) > 0 &&
               pdf_at(&hole, NAN, 0, 1) == 0,
           "the smallest cap is left out");
    tap_ok(pdf_at(&ring, 7e-8, 0, -1) > 1e13 && pdf_at(&ring, 4e-8, 0, -1) == 0 &&
               pdf_at(&ring, 1.1e-7, 0, -1) == 0 && pdf_at(&ring, 7e-8, 0, 1) == 0,
           "a zone next to the opposite pole");
    tap_ok(pdf_at(&band, 0, 0, 1) > 0 && pdf_at(&band, 0, 1, 0) == 0 &&
               pdf_at(&band, 1, 0, 0) == 0 && pdf_at(&band, 0, 0, 0.9) == 0,
           "a zone: g inside only");
    check_back(&band, 4, "zone");
    check_back(&ring, 64, "zone next to a pole");
    check_back(&hole, 4, "all but the smallest cap");
    check_back(&most, 16, "all but most");
    check_back(&thin, 0x1p41, "thin zone");
}

static void refuse_sphere_parts(void)
{
    const double zero[3] = {0, 0, 0}, inf[3] = {0, INFINITY, 1};
    refused_by_value(buffon_zone(0.5, 0.5, up), BUFFON_E_SHAPE, "a zone without height");
    refused_by_value(buffon_zone(0.5, 0, up), BUFFON_E_SHAPE, "a zone upside down");
    refused_by_value(buffon_zone(-1.5, 0, up), BUFFON_E_SHAPE, "a zone from below the sphere");
    refused_by_value(buffon_zone(0, 1.5, up), BUFFON_E_SHAPE, "a zone to above the sphere");
    refused_by_value(buffon_zone(NAN, 0, up), BUFFON_E_SHAPE, "a zone from NaN");
    refused_by_value(buffon_zone(0, NAN, up), BUFFON_E_SHAPE, "a zone to NaN");
    refused_by_value(buffon_zone(0, 1, NULL), BUFFON_E_NULL, "a zone without axis");
    refused_by_value(buffon_zone(0, 1, zero), BUFFON_E_SHAPE, "a zone about nothing");
    refused_by_value(buffon_zone(0, 1, inf), BUFFON_E_SHAPE, "a zone about infinity");
    refused_by_value(buffon_zone_angles(1, 1, up), BUFFON_E_SHAPE, "a zone of one angle");
    refused_by_value(buffon_zone_angles(2, 1, up), BUFFON_E_SHAPE, "angles backwards");
    refused_by_value(buffon_zone_angles(-1, 1, up), BUFFON_E_SHAPE, "a negative angle");
    refused_by_value(buffon_zone_angles(1, 3.1415926535897936, up), BUFFON_E_SHAPE, "over pi");
    refused_by_value(buffon_zone_angles(NAN, 1, up), BUFFON_E_SHAPE, "an angle that is none");
    refused_by_value(buffon_zone_angles(0, 1e-160, up), BUFFON_E_SHAPE, "angles with g past it");
    refused_by_value(buffon_zone_heights(-0.5, 1, up), BUFFON_E_SHAPE, "a negative depth");
    refused_by_value(buffon_zone_heights(0.5, 2.5, up), BUFFON_E_SHAPE, "a depth over 2");
    refused_by_value(buffon_zone_heights(0.5, 0.25, up), BUFFON_E_SHAPE, "depths backwards");
    refused_by_value(buffon_zone_heights(0, NAN, up), BUFFON_E_SHAPE, "a depth that is none");
    refused_by_value(buffon_zone_heights(0, 1e-310, up), BUFFON_E_SHAPE, "depths with g past it");
    refused_by_value(buffon_cap_complement_angle(0, up), BUFFON_E_SHAPE, "all but no cap");
    refused_by_value(buffon_cap_complement_angle(4, up), BUFFON_E_SHAPE, "an angle over pi");
    refused_by_value(buffon_cap_complement_angle(NAN, up), BUFFON_E_SHAPE, "a cap of NaN");
    refused_by_value(buffon_cap_complement_angle(1, NULL), BUFFON_E_NULL, "a cap without axis");
    refused_by_value(buffon_cap_complement_height(0, up), BUFFON_E_SHAPE, "all but nothing");
    refused_by_value(buffon_cap_complement_height(2, up), BUFFON_E_SHAPE, "all but everything");
    refused_by_value(buffon_cap_complement_height(NAN, up), BUFFON_E_SHAPE, "a height of NaN");
}

/* Turned, against the same upright: the uniform and the cosine hemisphere have the same pdf. */
static void test_lobes(void)
{
    const double axis[3] = {2, -1, -3};
    const buffon_density flat = buffon_hemisphere_power(0), cosine = buffon_hemisphere_power(1);
    const buffon_density sharp = buffon_hemisphere_power_about(1e15, axis);
    const buffon_density lobe = buffon_hemisphere_power_about(20.5, axis);
    const buffon_density lambert = buffon_hemisphere_cosine();
    double error = 0, length = 0, u[2], x[3], pdf, again;
    int there = 1;
    buffon_rng rng = buffon_rng_make(9, 40);
    for (int k = 0; k < 2000; k++) {
        grid_pair(u, &rng, k);
        there &= buffon_density_sample(x, &pdf, u, 1, &lambert) == BUFFON_OK &&
                 buffon_density_pdf(&again, x, 1, &cosine) == BUFFON_OK;
        error = fmax(error, fabs(again - pdf) / pdf);
        there &= buffon_density_pdf(&again, x, 1, &flat) == BUFFON_OK && again == flat.param[13];
        there &= buffon_density_sample(x, &pdf, u, 1, &sharp) == BUFFON_OK && pdf > 0;
        length = fmax(length, fabs(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1));
        there &= buffon_density_pdf(&again, x, 1, &sharp) == BUFFON_OK && again > 0;
        if (u[0] < 0.999)
            error = fmax(error, 1e-8 * fabs(again / pdf - 1));
    }
    tap_ok(there && error < 1e-14, "lobes: exponents 0 and 1 are the uniform and the cosine one");
    tap_note("up to %.3g", error);
    tap_ok(length < 0x1p-48, "lobes: |x| within 2^-49 of 1");
    tap_ok(pdf_at(&lobe, -2, 1, 3) == 0 && pdf_at(&lambert, 0, 0, 0) == 0 &&
               pdf_at(&cosine, 0, 1, 0) == 0 && pdf_at(&flat, 0, 0, -1) == 0 &&
               pdf_at(&flat, 0, 0, 1.1) == 0 && pdf_at(&lobe, NAN, 0, 0) == 0,
           "lobes: g is 0 below the plane");
    check_back(&lobe, 64, "lobe");
    check_back(&flat, 64, "lobe of exponent 0");
    refused_by_value(buffon_hemisphere_power(-0.5), BUFFON_E_SHAPE, "a negative exponent");
    refused_by_value(buffon_hemisphere_power(NAN), BUFFON_E_SHAPE, "an exponent of NaN");
    refused_by_value(buffon_hemisphere_power(1.0000000000000002e15), BUFFON_E_SHAPE, "a large one");
    refused_by_value(buffon_hemisphere_power(INFINITY), BUFFON_E_SHAPE, "an endless one");
    refused_by_value(buffon_hemisphere_power_about(1, NULL), BUFFON_E_NULL, "a lobe without axis");
    refused_by_value(buffon_hemisphere_power_about(1, (double[3]){0}), BUFFON_E_SHAPE, "about 0");
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
                                    buffon_annulus(1, k == 4 ? bad[k] : -fabs(bad[k])),
                                    buffon_annulus(k < 2    ? -0x1p-30
                                                   : k == 3 ? 2
                                                            : -fabs(bad[k]),
                                                   1),
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
    if (have_wide()) {
        test_circle();
        test_rings();
        test_ellipse();
        test_zones();
        test_cap_angles();
        test_powers();
        test_balls();
        test_cylinders();
    }
    test_plane();
    refuse_plane();
    test_sphere_parts();
    refuse_sphere_parts();
    test_lobes();
    test_solids();
    return tap_done();
}
