/* Parts of the unit sphere: caps, zones and lobes, against their formulas in extended precision
 * over all legal sizes (the numbers behind `Exact:` in the headers), there and back, and what is
 * refused. */
#include <float.h>
#include <math.h>

#include <buffon/buffon.h>

#include "refused.h"
#include "round.h"

enum { DRAWS = 20000 };

static const double up[3] = {0, 0, 1};

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
    ulps_worst across, height, area;
} zone_errors;

/* From depth h0 on, of height h, and `rest` above the opposite pole. */
static void see_zone(zone_errors *w, const buffon_density *g, wide h0, wide h, wide rest,
                     buffon_rng *rng, int k)
{
    double u[2], x[3], pdf;
    wide c, s;
    grid_pair(u, rng, k);
    if (buffon_density_sample(x, &pdf, u, 1, g) != BUFFON_OK)
        w->across.ulps = INFINITY;
    ulps_circle(&c, &s, u[1]);
    const wide depth = h0 + h * u[0], above = rest + h * (1 - (wide)u[0]);
    see(&w->across, x[0], sqrtl(depth) * sqrtl(above) * c);
    see(&w->across, x[1], sqrtl(depth) * sqrtl(above) * s);
    see_part(&w->height, x[2], depth < 1 ? 1 - depth : above - 1, 1);
    see_share(&w->area, pdf, 1 / (2 * WIDE_PI * h));
    if (buffon_density_pdf(u, x, 1, g) != BUFFON_OK || u[0] != pdf)
        w->area.ulps = INFINITY;
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
        const double h1 = k % 3 ? any(&rng, -1021, 0) : 2 - any(&rng, -53, 0), h0 = below(&rng, h1);
        if (h1 <= 2 && h1 - h0 >= DBL_MIN) {
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
    ulps_worst area = {0}, height = {0}, sine = {0}, point = {0};
    buffon_rng rng = buffon_rng_make(6, 40);
    for (int k = 0; k < 2 * DRAWS; k++) {
        const double pi = 0x1.921fb54442d18p+1, v = buffon_rng_next(&rng);
        const double angle = k % 3 ? exp(log(1e-9) + v * (log(pi) - log(1e-9))) : pi * v;
        const buffon_density g = buffon_cap_angle(angle, up);
        double u[2], x[3], pdf;
        wide c, s;
        grid_pair(u, &rng, k);
        if (buffon_density_sample(x, &pdf, u, 1, &g) != BUFFON_OK)
            area.ulps = INFINITY;
        const wide h = 2 * half_sine(angle) * half_sine(angle);
        const wide rest = 2 * half_cosine(angle) * half_cosine(angle);
        const wide w = h * u[0], r = sqrtl(w * (rest + h * (1 - (wide)u[0])));
        ulps_circle(&c, &s, u[1]);
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
    ulps_worst point = {0}, height = {0}, drawn = {0}, given = {0}, logs = {0}, back = {0};
    buffon_rng rng = buffon_rng_make(8, 40);
    for (int k = 0; k < 2 * DRAWS; k++) {
        const double edge[] = {0, 1, 1e15, 0x1p-1074, 0.5, 2, 3e7};
        const double power = k % 3 == 0 ? edge[k / 3 % 7] : any(&rng, k % 3 == 1 ? -60 : -3, 49);
        const buffon_density g = buffon_hemisphere_power(power);
        double u[2], x[3], pdf = NAN, again = NAN, log_pdf = NAN, v[2] = {0};
        wide c, s;
        grid_pair(u, &rng, k);
        if (k % 5 == 1)
            u[0] = ldexp(u[0], -(int)buffon_rng_below(&rng, 890));
        if (!round_trip(x, &pdf, &again, v, u, &g) ||
            buffon_density_log_pdf(&log_pdf, x, 1, &g) != BUFFON_OK)
            point.ulps = INFINITY;
        ulps_circle(&c, &s, u[1]);
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
            see_error(&given, fabsl(again - exact) / ulps_of(exact) / (5 - 3 * power * own));
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

/* ---- known values ------------------------------------------------------------------------- */

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

int main(void)
{
    if (ulps_have_wide()) {
        test_zones();
        test_cap_angles();
        test_powers();
    }
    test_sphere_parts();
    refuse_sphere_parts();
    test_lobes();
    return tap_done();
}
