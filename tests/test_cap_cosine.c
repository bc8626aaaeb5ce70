/* The cosine-weighted cap: irradiance and law against quadratures in extended precision that share
 * no formula with the library. */
#include <float.h>
#include <math.h>

#include <buffon/buffon.h>

#include "refused.h"
#include "round.h"

enum { NODES = 24 };

static wide node[NODES], weight[NODES];

/* Gauss and Legendre's nodes on (0, 1), by Newton's method. */
static void make_nodes(void)
{
    for (int i = 0; i < NODES; i++) {
        wide x = cosl(WIDE_PI * (i + 0.75L) / (NODES + 0.5L)), slope = 1;
        for (int step = 0; step < 10; step++) {
            wide p = 1, q = 0;
            for (int k = 1; k <= NODES; k++) {
                const wide next = ((2 * k - 1) * x * p - (k - 1) * q) / k;
                q = p;
                p = next;
            }
            slope = NODES * (x * p - q) / (x * x - 1);
            x -= p / slope;
        }
        node[i] = 0.5L * (1 - x);
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

/* sin x - x cos x. */
static wide sector(wide x)
{
    wide sum = 0, term = x * x * x / 6;
    if (x > 1)
        return sinl(x) - x * cosl(x);
    for (int k = 1; k < 14; k++) {
        sum += 2 * k * term;
        term *= -x * x / ((2 * k + 2) * (2 * k + 3));
    }
    return sum;
}

/* The irradiance by circles about the axis: on the one at angle a the cosine from the normal is
 * A + B cos q, A = cos a sin b and B = sin a cos b, positive for q up to acos(-A / B). Where that
 * sets in, at a = |b|, it goes as a power of 3/2, which t^2 smooths. */
static wide circle_of(wide a, wide b)
{
    const wide A = cosl(a) * sinl(b), B = sinl(a) * cosl(b);
    const wide gap = sinl(a - fabsl(b)); /* B - |A| */
    if (gap <= 0)
        return b > 0 ? 2 * WIDE_PI * A * sinl(a) : 0;
    const wide least = 2 * asinl(sqrtl(0.5L * gap / B)); /* acos(|A| / B) */
    return 2 * sinl(a) * B * sector(least) + (b > 0 ? 2 * WIDE_PI * A * sinl(a) : 0);
}

static wide irradiance(wide angle, wide b)
{
    const wide whole =
        b > 0 ? WIDE_PI * sinl(fminl(angle, b)) * sinl(fminl(angle, b)) * sinl(b) : 0;
    const wide more = angle - fabsl(b);
    wide sum = 0;
    if (more <= 0)
        return whole;
    for (int piece = 0; piece < 4; piece++)
        for (int i = 0; i < NODES; i++) {
            const wide t = (piece + node[i]) / 4;
            sum += weight[i] / 4 * 2 * t * circle_of(fabsl(b) + more * t * t, b);
        }
    return whole + more * sum;
}

/* The irradiance of the vectors as they are, and what rounding of them may be worth. */
static void set_height(wide *b, wide *lean, const double axis[3], const double normal[3])
{
    wide dot = 0, square = 0;
    for (int j = 0; j < 3; j++) {
        const int k = (j + 1) % 3, l = (j + 2) % 3;
        const wide cross = (wide)axis[k] * normal[l] - (wide)axis[l] * normal[k];
        dot += (wide)axis[j] * normal[j];
        square += cross * cross;
    }
    *b = atan2l(dot, sqrtl(square));
    *lean = sqrtl(square);
}

static wide irradiance_of(double angle, const double axis[3], const double normal[3])
{
    wide b, lean;
    set_height(&b, &lean, axis, normal);
    return irradiance(angle, b);
}

/* A cap of any size, from wholly above to barely above the horizon; every third touches it closely.
 * The axis is +z, where small caps keep their digits, and the normal leans anywhere; or they are
 * turned. */
typedef struct example {
    double angle, height, axis[3], normal[3];
} example;

static example any_example(buffon_rng *rng, int k)
{
    example e = {.axis = {0, 0, 1}};
    const double top = 1.5707963267948966, v = buffon_rng_next(rng), w = buffon_rng_next(rng);
    const double turn = 6.283185307179586 * buffon_rng_next(rng);
    e.angle = k % 2 ? top * v : top * ldexp(0.5 + 0.5 * v, -(int)buffon_rng_below(rng, 40));
    const double near = ldexp(w, -(int)buffon_rng_below(rng, 30));
    e.height = k % 3 == 0   ? -e.angle * (1 - near)
               : k % 3 == 1 ? e.angle * (2 * w - 1)
                            : e.angle + (top - e.angle) * near;
    e.normal[0] = cos(e.height) * cos(turn);
    e.normal[1] = cos(e.height) * sin(turn);
    e.normal[2] = sin(e.height);
    return e;
}

static void test_irradiance(void)
{
    ulps_worst above = {0}, cut = {0}, turned = {0};
    buffon_rng rng = buffon_rng_make(1, 41);
    for (int k = 0; k < 3000; k++) {
        const example e = any_example(&rng, k);
        const wide exact = irradiance_of(e.angle, e.axis, e.normal);
        const double got = buffon_cap_irradiance(e.angle, e.axis, e.normal);
        wide b, lean;
        set_height(&b, &lean, e.axis, e.normal);
        const wide known = b >= e.angle ? 1 : 1 + e.angle / (b + e.angle);
        see_error(b >= e.angle ? &above : &cut, fabsl(got / exact - 1) * 0x1p52L / known);
        /* About another axis the height is known within 2^-52, not within so much of itself. */
        const double axis[3] = {1, -2, 0.5 + k}, normal[3] = {-0.5, 0.25 * (k % 9), 1};
        const wide other = irradiance_of(e.angle, axis, normal);
        set_height(&b, &lean, axis, normal);
        const double again = buffon_cap_irradiance(e.angle, axis, normal);
        if (b + e.angle > 0)
            see_error(&turned, fabsl(again / other - 1) * 0x1p52L / (1 + 1 / (b + e.angle)));
    }
    report(&above, 8, "irradiance of a cap above the horizon, in 2^-52 of itself");
    report(&cut, 8, "irradiance of a cap across the horizon, in 2^-52 (1 + t / (b + t))");
    report(&turned, 16, "irradiance about any axis, in 2^-52 (1 + 1 / (b + t))");
}

/* ---- points ------------------------------------------------------------------------------- */

/* The area beyond y, by chords of constant y: semicircles of the upper half sphere, on which the
 * cap is an arc of half angle acos(c / r) about the height of its axis. */
static wide chord_of(wide y, wide angle, wide b, wide *first, wide *last)
{
    const wide r = sqrtl((1 - y) * (1 + y)), s = sinl(angle);
    const wide arc = atan2l(sqrtl(fmaxl(0, (s - y) * (s + y))), cosl(angle));
    *first = fmaxl(0, b - arc);
    *last = b + arc;
    if (*last <= *first)
        return 0;
    return 2 * r * sinl(0.5L * (*last - *first)) * sinl(0.5L * (*last + *first));
}

/* With nodes close together at the end, where the circle of a large cap turns sharply. */
static wide area_between(wide from, wide to, wide angle, wide b)
{
    wide sum = 0, first, last;
    const wide s = sinl(angle);
    for (int piece = 0; piece < 4; piece++)
        for (int i = 0; i < NODES; i++) {
            const wide v = (piece + node[i]) / 4, p = to - (to - from) * v * v * v * v;
            sum += weight[i] * v * v * v * chord_of(s * sinl(p), angle, b, &first, &last) * cosl(p);
        }
    return s * (to - from) * sum;
}

/* Where a point of a cut cap stands, as the two uniforms; about +z. */
static void see_cut(ulps_worst *w, ulps_worst *tail, ulps_worst *along, const example *e,
                    const double x[3], const double u[2], wide b)
{
    const wide length = hypotl(e->normal[0], e->normal[1]);
    const wide tx = e->normal[0] / length, ty = e->normal[1] / length;
    const wide t = x[0] * tx + x[1] * ty, y = fabsl(x[0] * ty - x[1] * tx);
    const wide z = t * cosl(b) + x[2] * sinl(b), out = x[2] * cosl(b) - t * sinl(b);
    const wide s = sinl(e->angle), p = y < s ? asinl(y / s) : 0.5L * WIDE_PI;
    const wide apart = sinl(e->angle - fabsl(b)) * sinl(e->angle + fabsl(b));
    const wide touch = atan2l(sqrtl(apart), cosl(e->angle) * fabsl(sinl(b)));
    const wide end = b > 0 ? 0.5L * WIDE_PI : touch, turn = fminl(touch, fmaxl(p, 0));
    const wide total = area_between(0, touch, e->angle, b) + area_between(touch, end, e->angle, b);
    const wide beyond =
        area_between(turn, touch, e->angle, b) + area_between(fmaxl(p, touch), end, e->angle, b);
    const wide share = fminl(u[0], 1 - (wide)u[0]), known = 1 + e->angle / (b + e->angle);
    wide first, last;
    see_error(w, fabsl(0.5L * beyond / total - share) * 0x1p52L / known);
    if (touch < 0.5L && b < 0)
        see_error(tail,
                  fabsl(0.5L * beyond / total - share) / powl(share, 2.0L / 3) * 0x1p52L / known);
    if (share < 1e-3L)
        return; /* chords of no length */
    (void)chord_of(y, e->angle, b, &first, &last);
    const wide at = atan2l(z, out);
    const wide part = sinl(0.5L * (at - first)) * sinl(0.5L * (at + first)) /
                      (sinl(0.5L * (last - first)) * sinl(0.5L * (last + first)));
    see_error(along, fabsl(part - u[1]) * 0x1p52L / known);
}

/* A point of a cap above the horizon, lifted from the concentric disk; about +z. */
static void see_whole(ulps_worst *w, const example *e, const double x[3], const double u[2], wide b)
{
    const wide length = hypotl(e->normal[0], e->normal[1]), s = sinl(e->angle), c = cosl(e->angle);
    const wide tx = length > 0 ? e->normal[0] / length : 1;
    const wide ty = length > 0 ? e->normal[1] / length : 0;
    const wide f = 2 * (wide)u[0] - 1, g = 2 * (wide)u[1] - 1;
    const int flat = fabsl(f) > fabsl(g);
    const wide turn = WIDE_PI / 4 * (flat ? g / f : g == 0 ? 0 : f / g), r = flat ? f : g;
    const wide p = r * (flat ? cosl(turn) : sinl(turn)), q = r * (flat ? sinl(turn) : cosl(turn));
    const wide base = c * sinl(b) + s * cosl(b) * p, off = s * s * (1 - r) * (1 + r);
    const wide rise = off / (base + sqrtl(base * base + off));
    const wide t = s * p + rise * cosl(b), a = c + rise * sinl(b);
    see_error(w, fabsl(x[0] - (t * tx - s * q * ty)) / s * 0x1p52L);
    see_error(w, fabsl(x[1] - (t * ty + s * q * tx)) / s * 0x1p52L);
    see_error(w, fabsl(x[2] - a) * 0x1p52L);
}

static void test_points(void)
{
    ulps_worst whole = {0}, across = {0}, tail = {0}, along = {0}, length = {0}, drawn = {0};
    int there = 1;
    buffon_rng rng = buffon_rng_make(2, 41);
    for (int k = 0; k < 3000; k++) {
        const example e = any_example(&rng, k);
        const buffon_density g = buffon_cap_cosine(e.angle, e.axis, e.normal);
        double u[2], x[3], pdf = NAN, again = NAN, v[2] = {0};
        wide b, lean;
        grid_pair(u, &rng, k);
        there &= round_trip(x, &pdf, &again, v, u, &g);
        there &= fabs(v[0] - u[0]) < 1e-6 && v[1] > 0 && v[1] < 1;
        set_height(&b, &lean, e.axis, e.normal);
        see_error(&length,
                  fabsl((wide)x[0] * x[0] + (wide)x[1] * x[1] + (wide)x[2] * x[2] - 1) * 0x1p48L);
        if (b >= e.angle)
            see_whole(&whole, &e, x, u, b);
        else
            see_cut(&across, &tail, &along, &e, x, u, b);
        const double total = buffon_cap_irradiance(e.angle, e.axis, e.normal);
        there &= pdf > 0 && (again > 0 || pdf * total < 0x1p-50 * sin(e.angle));
        const wide highest = b + e.angle < 1.5L ? sinl(e.angle + fmaxl(0, b)) : 1;
        see_error(&drawn, fabsl(pdf - (wide)again) * total / highest * 0x1p52L);
    }
    tap_ok(there, "points lie on their caps and above the horizon");
    report(&length, 1, "|x|^2 within 2^-48 of 1, in that");
    report(&whole, 16, "points of a cap above the horizon, in 2^-52 of its size");
    report(&across, 4, "points across the horizon: share of u1, in 2^-52 (1 + t / (b + t))");
    report(&tail, 4, "thin crescents: share q of the smaller side, in 2^-52 q^(2/3) (1 + ...)");
    report(&along, 16, "points across the horizon: share of u2, in 2^-52 (1 + t / (b + t))");
    report(&drawn, 16, "cosine at the point, in 2^-52 of the highest");
}

/* About a surface that looks up the cosine is z, to the last digits however low. */
static void test_level(void)
{
    ulps_worst cosine = {0}, given = {0}, back = {0};
    buffon_rng rng = buffon_rng_make(4, 41);
    for (int k = 0; k < 3000; k++) {
        const example e = any_example(&rng, k);
        const buffon_density g = buffon_cap_cosine(e.angle, e.normal, e.axis);
        const double total = buffon_cap_irradiance(e.angle, e.normal, e.axis);
        double u[2], x[3] = {0}, pdf = NAN, again = NAN, v[2] = {0};
        grid_pair(u, &rng, k);
        if (!round_trip(x, &pdf, &again, v, u, &g))
            cosine.ulps = INFINITY;
        see_error(&cosine, fabsl((wide)pdf * total / x[2] - 1) * 0x1p52L);
        if (e.angle < 1e-3)
            continue; /* the doubles near the axis are 2^-53 apart, and so are their uniforms */
        see_error(&given, fabs(again / pdf - 1) * 0x1p52);
        if (e.height > -0.9 * e.angle && fmin(u[0], 1 - u[0]) > 1e-3 && fmin(u[1], 1 - u[1]) > 1e-3)
            see_error(&back,
                      fmax(fabs(v[0] - u[0]), fabs(v[1] - u[1])) * e.angle * e.angle * 0x1p52);
    }
    report(&cosine, 4, "about a surface that looks up: g along with the point is z, in 2^-52");
    report(&given, 4, "and so is g at the point");
    report(&back, 128, "u of the point, in 2^-52 over the square of the angle");
}

/* ---- known values ------------------------------------------------------------------------- */

static int is(double got, double wanted)
{
    return fabs(got - wanted) <= 1e-15 * fabs(wanted);
}

static void test_known(void)
{
    const double pi = 0x1.921fb54442d18p+1, up[3] = {0, 0, 3}, side[3] = {2, 0, 0};
    const double down[3] = {0, 0, -1}, low[3] = {1, 0, -1};
    tap_ok(is(buffon_cap_irradiance(pi / 2, up, up), pi), "the whole sky: pi");
    tap_ok(is(buffon_cap_irradiance(pi / 2, side, up), pi / 2), "half of the sky: pi / 2");
    tap_ok(is(buffon_cap_irradiance(0.5, up, up), pi * sin(0.5) * sin(0.5)), "a sun in the zenith");
    tap_ok(is(buffon_cap_irradiance(1, side, up), 1 - sin(1) * cos(1)), "a sun that sets, half");
    tap_ok(buffon_cap_irradiance(1, down, up) == 0 && buffon_cap_irradiance(0.7, low, up) == 0 &&
               buffon_cap_irradiance(0.8, low, up) > 0,
           "below the horizon: 0");
    const buffon_density g = buffon_cap_cosine(0.8, low, up);
    const double at[4][3] = {{1, 0, 1e-4}, {1, 0, -1e-4}, {0.6, 0.8, 1e-4}, {NAN, 0, 0}};
    double pdf[4] = {0};
    for (int k = 0; k < 4; k++)
        (void)!buffon_density_pdf(&pdf[k], at[k], 1, &g);
    tap_ok(pdf[0] > 0 && pdf[1] == 0 && pdf[2] == 0 && pdf[3] == 0,
           "g above the horizon and on the cap only");
}

/* A sphere of sine s = radius / distance above the horizon: pi s^2 sin b. */
static void test_spheres(void)
{
    const double here[3] = {1, 2, 3}, up[3] = {0, 0, 1}, far[3] = {0, INFINITY, 0};
    ulps_worst whole = {0}, set = {0};
    buffon_rng rng = buffon_rng_make(3, 41);
    for (int k = 0; k < 2000; k++) {
        double from[3], centre[3];
        wide square = 0;
        for (int j = 0; j < 3; j++) {
            from[j] = k % 2 ? 0 : buffon_rng_next(&rng);
            centre[j] = from[j] + (j < 2 ? 2 * buffon_rng_next(&rng) - 1 : 1);
            square += ((wide)centre[j] - from[j]) * ((wide)centre[j] - from[j]);
        }
        const wide d = sqrtl(square), sine = ((wide)centre[2] - from[2]) / d;
        const double radius =
            (double)d * sinh(1) * 0.77 * ldexp(buffon_rng_next(&rng), k % 3 ? 0 : -(k % 100));
        const double got = buffon_cap_irradiance_of_sphere(from, centre, radius, up);
        const wide angle = asinl(radius / d), b = asinl(sine);
        if (angle <= b)
            see_error(&whole,
                      fabsl(got / (WIDE_PI * radius * radius / square * sine) - 1) * 0x1p52L);
        else
            see_error(&set, fabsl(got / irradiance(angle, b) - 1) * 0x1p52L);
    }
    report(&whole, 16, "irradiance of a sphere above the horizon, in 2^-52 of itself");
    report(&set, 16, "irradiance of a sphere across the horizon, in 2^-52 of itself");
    const double centre[3] = {1, 2, 5};
    const buffon_density g = buffon_cap_cosine_of_sphere(here, centre, 1, up);
    double x[3] = {0, 0, 1}, pdf = 0;
    tap_ok(buffon_density_pdf(&pdf, x, 1, &g) == BUFFON_OK &&
               fabs(pdf * 0.7853981633974483 - 1) < 1e-15,
           "a sphere of half the distance in the zenith: g = 4 / pi there");
    refused_by_value(buffon_cap_cosine_of_sphere(NULL, here, 1, up), BUFFON_E_NULL, "from nowhere");
    refused_by_value(buffon_cap_cosine_of_sphere(here, NULL, 1, up), BUFFON_E_NULL, "no centre");
    refused_by_value(buffon_cap_cosine_of_sphere(here, centre, 1, NULL), BUFFON_E_NULL,
                     "no normal");
    refused_by_value(buffon_cap_cosine_of_sphere(here, centre, 2, up), BUFFON_E_SHAPE,
                     "from on it");
    refused_by_value(buffon_cap_cosine_of_sphere(here, centre, 0, up), BUFFON_E_SHAPE, "radius 0");
    refused_by_value(buffon_cap_cosine_of_sphere(here, centre, NAN, up), BUFFON_E_SHAPE, "NaN");
    refused_by_value(buffon_cap_cosine_of_sphere(here, far, 1, up), BUFFON_E_SHAPE, "far off");
    refused_by_value(buffon_cap_cosine_of_sphere(centre, here, 1, up), BUFFON_E_SHAPE, "below");
    tap_ok(buffon_cap_irradiance_of_sphere(centre, here, 1, up) == 0 &&
               isnan(buffon_cap_irradiance_of_sphere(here, here, 1, up)) &&
               isnan(buffon_cap_irradiance_of_sphere(NULL, here, 1, up)),
           "the irradiance of a sphere below is 0, of one around NaN");
}

/* However small, u2 leaves a point above the horizon. */
static void test_least(void)
{
    static const double half[] = {1e-8, 0.01, 0.8, 1.5707963267948966}, z[3] = {0, 0, 1};
    int good = 1;
    for (int k = 0; k < 36; k++) {
        const double t = half[k / 9], up = t * (k % 9 / 4.5 - 0.9), n[3] = {cos(up), 0, sin(up)};
        const buffon_density g = buffon_cap_cosine(t, z, n);
        const double u[] = {0x1p-53, 0.3, 1 - 0x1p-53, 0x1p-1074, 0x1p-1074, 1e-300};
        double x[9], pdf[3];
        good &= buffon_density_sample(x, pdf, u, 3, &g) == BUFFON_OK;
        good &= pdf[0] > 0 && pdf[1] > 0 && pdf[2] > 0;
    }
    tap_ok(good, "the smallest uniforms make points with a density");
}

static void test_refusals(void)
{
    const double up[3] = {0, 0, 1}, zero[3] = {0}, inf[3] = {1, INFINITY, 0}, down[3] = {0, 0, -1};
    refused_by_value(buffon_cap_cosine(1, NULL, up), BUFFON_E_NULL, "a cap without axis");
    refused_by_value(buffon_cap_cosine(1, up, NULL), BUFFON_E_NULL, "a cap without normal");
    refused_by_value(buffon_cap_cosine(1, zero, up), BUFFON_E_SHAPE, "a cap about nothing");
    refused_by_value(buffon_cap_cosine(1, up, zero), BUFFON_E_SHAPE, "a normal of no length");
    refused_by_value(buffon_cap_cosine(1, inf, up), BUFFON_E_SHAPE, "a cap about infinity");
    refused_by_value(buffon_cap_cosine(1, up, inf), BUFFON_E_SHAPE, "a normal to infinity");
    refused_by_value(buffon_cap_cosine(0, up, up), BUFFON_E_SHAPE, "a cap of angle 0");
    refused_by_value(buffon_cap_cosine(-1, up, up), BUFFON_E_SHAPE, "a negative angle");
    refused_by_value(buffon_cap_cosine(1.5707963267948968, up, up), BUFFON_E_SHAPE, "over pi/2");
    refused_by_value(buffon_cap_cosine(NAN, up, up), BUFFON_E_SHAPE, "an angle of NaN");
    refused_by_value(buffon_cap_cosine(1, down, up), BUFFON_E_SHAPE, "a cap below the horizon");
    refused_by_value(buffon_cap_cosine(1e-160, up, up), BUFFON_E_SHAPE, "a cap of no irradiance");
    tap_ok(isnan(buffon_cap_irradiance(2, up, up)) && isnan(buffon_cap_irradiance(1, NULL, up)) &&
               isnan(buffon_cap_irradiance(1, up, zero)),
           "no irradiance of what is refused for its arguments");
}

int main(void)
{
    make_nodes();
    if (ulps_have_wide()) {
        test_irradiance();
        test_points();
        test_spheres();
        test_level();
    }
    test_known();
    test_least();
    test_refusals();
    return tap_done();
}
