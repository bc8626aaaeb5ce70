#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/cap_cosine.h>

#include "circle.h"
#include "density_priv.h"
#include "frame.h"

/* Coordinates. The cap's own frame (t, b, a): a is the axis, and the normal n = sin B a + cos B t,
 * with B the height of the axis above the horizon, from -pi/2 to pi/2. The surface's frame (x, y,
 * z): z along n, y along b, and x where the axis leans: n = z, x = cos B a - sin B t.
 *
 * Seen along n, the rim of the cap is an ellipse about (c cos B, 0), s and c sine and cosine of the
 * half angle. It touches the unit circle, the horizon, in two points where the cap crosses it, at
 * y = +-s sin H, cos H = c |sin B| / (s cos B). Between these lies the crescent: outside the
 * ellipse, inside the circle. It is all there is of a cap with B <= 0; with B > 0 the ellipse is
 * added to it, and the areas are the irradiance.
 *
 * With y = s sin p the chord of the crescent at p is from the ellipse's x = c cos B + |sin B| s cos
 * p to the circle's r = sqrt(1 - y^2).
 *
 * The frame kept is the cap's, in which small caps keep their digits about a coordinate axis; but
 * where the normal is a coordinate axis it is the surface's, in which small cosines keep theirs. A
 * REACH below 0 says so. */
enum {
    CAP_COSINE_SINE = FRAME_SIZE, /* s */
    CAP_COSINE_COSINE,            /* c */
    CAP_COSINE_UP,                /* sin B */
    CAP_COSINE_ACROSS,            /* cos B */
    CAP_COSINE_LOWEST, /* the sine of the rim's least height; where that is below 0: -H */
    CAP_COSINE_TOTAL,  /* the irradiance */
    CAP_COSINE_REACH   /* the largest chord that counts as inside */
};

#define CAP_COSINE_PI 0x1.921fb54442d18p+1

#define KERNELS "cap_cosine_lanes.h"
#include "levels.h"

/* ---- areas -------------------------------------------------------------------------------- */

/* x - sin x for 0 <= x <= 1.2, by its series. */
static double cap_cosine_arc(double x)
{
    const double z = x * x, w = z * z;
    const double even =
        0x1.5555555555555p-3 +
        w * (0x1.a01a01a01a01ap-13 + w * (0x1.ae64567f544e4p-26 + w * 0x1.ae7f3e733b81fp-41));
    const double odd =
        0x1.1111111111111p-7 +
        w * (0x1.71de3a556c734p-19 + w * (0x1.6124613a86d09p-33 + w * 0x1.952c77030ad4ap-49));
    return x * z * (even - z * odd);
}

/* v(x) = sin x - (x + sin x cos x) / 2 for 0 <= x <= pi/2: what the area under an arc of the unit
 * circle lacks of its rectangle. Its series is that of sin x - x / 2 - sin(2 x) / 4. */
static double cap_cosine_lack(double x, double s, double c)
{
    const double z = x * x, w = z * z;
    if (x >= 1)
        return s - 0.5 * (x + s * c);
    const double even = 0x1.5555555555555p-3 +
                        w * (0x1.9319319319319p-8 +
                             w * (0x1.ad8d245414a41p-17 +
                                  w * (0x1.ae71ca7947e81p-28 +
                                       w * (0x1.2f491cc339e17p-40 + w * 0x1.761b358089781p-54))));
    const double odd = 0x1.dddddddddddddp-5 +
                       w * (0x1.6efa7de0c19a5p-12 +
                            w * (0x1.60f83cae5f7fcp-22 +
                                 w * (0x1.95294caa1cce9p-34 +
                                      w * (0x1.71b8c136b1696p-47 + w * 0x1.3f3ccb52ec5efp-61))));
    return x * z * (even - z * odd);
}

/* A cap that the horizon cuts. */
typedef struct cap_cosine_cut {
    double s, c, sb, cb, low;        /* sin B, cos B; |sin B| */
    double touch, sin_touch, middle; /* H; the crescent's chord at p = 0 */
    double cos_touch;
    double end;            /* the largest p */
    double crescent, half; /* areas on one side of y = 0: the crescent's, all */
} cap_cosine_cut;

/* A place p in it. */
typedef struct cap_cosine_place {
    double sine, cosine, y, r; /* of p; s sin p, sqrt(1 - y^2) */
    double crescent;           /* from the circle to the ellipse */
    double gap, chord;         /* from the circle to the shape, and through the shape */
} cap_cosine_place;

/* The chord of the crescent is z^2 / (r + x) with z the height of the rim above the ellipse's x:
 * s cos B (cos p - cos H), and a difference of angles keeps the digits of that of the cosines. */
static cap_cosine_place cap_cosine_at(const cap_cosine_cut *k, double p)
{
    cap_cosine_place at;
    double sine, cosine;
    buffon_priv_sincospi(&sine, &cosine, 0.5 * (k->touch - p) / CAP_COSINE_PI);
    const double above = 2 * sine * (k->sin_touch * cosine - k->cos_touch * sine);
    const double z = k->s * k->cb * above;
    at.cosine = k->cos_touch + above > 0 ? k->cos_touch + above : 0;
    at.sine = k->sin_touch - 2 * sine * (k->sin_touch * sine + k->cos_touch * cosine);
    at.y = k->s * at.sine;
    at.r = sqrt(at.cosine * at.cosine + k->c * k->c * at.sine * at.sine);
    at.crescent = z * z / (at.r + k->c * k->cb + k->low * k->s * at.cosine);
    at.gap = p > k->touch ? at.crescent : 0;
    at.chord = (at.crescent - at.gap) + (k->sb > 0 ? 2 * k->low * k->s * at.cosine : 0);
    return at;
}

/* v(p) - v(m) for the angle m of the circle at y, by d = p - m: with q = p - d / 2, half way, it is
 * 2 sin(d / 2) cos(q) (1 - cos(q) cos(d / 2)) - (d - sin d) / 2. */
static double cap_cosine_between(const cap_cosine_cut *k, const cap_cosine_place *at)
{
    const double sine = at->sine, cosine = at->cosine;
    const double sd = k->c * k->c * sine / (at->r + k->s * cosine);
    const double cd = cosine * at->r + sine * at->y;
    const double d = CAP_COSINE_PI * buffon_priv_atan2pi(sd, cd);
    const double c2 = sqrt(0.5 * (1 + cd)), s2 = 0.5 * sd / c2;
    const double sq = sine * c2 - cosine * s2, cq = cosine * c2 + sine * s2;
    const double rest = sq * sq / (1 + cq) + cq * (s2 * s2 / (1 + c2));
    return 2 * s2 * cq * rest - 0.5 * cap_cosine_arc(d);
}

/* The crescent's area from 0 to p: its middle chord's rectangle, less what the circle lacks, and
 * what the ellipse lacks. Small caps are nearly flat, and so is the circle over them; of large ones
 * circle and ellipse are alike, and what counts is d = p - m, m the angle of the circle at y. */
static double cap_cosine_closed(const cap_cosine_cut *k, const cap_cosine_place *at, double p)
{
    const double ellipse = cap_cosine_lack(p, at->sine, at->cosine);
    if (k->c > 0.5) {
        const double m = CAP_COSINE_PI * buffon_priv_atan2pi(at->y, at->r);
        const double circle = cap_cosine_lack(m, at->y, at->r);
        return at->y * k->middle - circle + k->low * k->s * k->s * ellipse;
    }
    const double unlike = k->c * k->c + k->s * k->s * (k->cb * k->cb / (1 + k->low));
    return at->y * k->middle + cap_cosine_between(k, at) - unlike * ellipse;
}

/* The same from p to H by Gauss and Legendre's rule of 8 nodes. */
static double cap_cosine_rule(const cap_cosine_cut *k, double p)
{
    static const double place[4] = {0x1.77ac94f3c7345p-4, 0x1.0d129583284b4p-2,
                                    0x1.97e4ab249f41ep-2, 0x1.ebab1cb0acc67p-2};
    static const double weight[4] = {0x1.736360b199343p-3, 0x1.413c50a255615p-3,
                                     0x1.c76fb531d2b96p-4, 0x1.9ea1d04ca0374p-5};
    const double width = k->touch - p;
    double sum = 0;
    for (int i = 0; i < 8; i++) {
        const double off = i < 4 ? 0.5 - place[i] : 0.5 + place[i - 4];
        const cap_cosine_place at = cap_cosine_at(k, p + off * width);
        sum += weight[i % 4] * at.crescent * at.cosine;
    }
    return k->s * width * sum;
}

/* The share of the area beyond p. The closed form loses the digits of a thin crescent and of what
 * is left near its end, where the rule has them all: the circles of large caps, which turn sharply
 * at pi/2, are left out, and the nearest singularity is some 5 half widths from its middle. */
static double cap_cosine_left(const cap_cosine_cut *k, const cap_cosine_place *at, double p)
{
    const double across = 0.5 * CAP_COSINE_PI - p;
    double left = 0;
    if (p < k->touch && (k->touch < 0.5 || (k->c > 0.5 && p > 0.85 * k->touch)))
        left = cap_cosine_rule(k, p);
    else if (p < k->touch)
        left = k->crescent - cap_cosine_closed(k, at, p);
    if (k->sb > 0)
        left += k->sb * k->s * k->s *
                (across < 0.6 ? 0.5 * cap_cosine_arc(2 * across) : across - at->sine * at->cosine);
    return left / k->half;
}

/* The middle chord of the crescent is 1 - cos(e), e the lesser height of the rim and below pi/2;
 * sin(e) = s cos B - c |sin B| = s cos B (1 - cos H). */
static cap_cosine_cut cap_cosine_cut_of(const double *param)
{
    const double s = param[CAP_COSINE_SINE], sb = param[CAP_COSINE_UP];
    cap_cosine_cut k = {.s = s, .c = param[CAP_COSINE_COSINE], .sb = sb, .half = 1};
    k.cb = param[CAP_COSINE_ACROSS];
    k.low = buffon_priv_abs(sb);
    k.touch = -param[CAP_COSINE_LOWEST];
    buffon_priv_sincospi(&k.sin_touch, &k.cos_touch, k.touch / CAP_COSINE_PI);
    const double half = buffon_priv_sinpi(0.5 * k.touch / CAP_COSINE_PI);
    const double sine = 2 * s * k.cb * half * half;
    k.middle = sine * sine / (1 + k.c * k.cb + s * k.low);
    k.end = sb > 0 ? 0.5 * CAP_COSINE_PI : k.touch;
    if (k.touch < 0.5) {
        k.crescent = cap_cosine_rule(&k, 0);
    } else {
        const cap_cosine_place last = cap_cosine_at(&k, k.touch);
        k.crescent = cap_cosine_closed(&k, &last, k.touch);
    }
    k.half = k.crescent + (sb > 0 ? 0.5 * CAP_COSINE_PI * sb * s * s : 0);
    return k;
}

/* p with the share `rest` of the area beyond it. The cube root of what is beyond is nearly straight
 * in p, and zero at the end: Newton's method on it, kept within bounds. */
static double cap_cosine_solve(const cap_cosine_cut *k, double rest)
{
    const double wanted = buffon_priv_cbrt(rest);
    double lo = 0, hi = k->end, p = hi * (1 - wanted * (0.79 + 0.21 * wanted));
    for (int step = 0; step < 60; step++) {
        if (!(p > lo && p < hi))
            p = 0.5 * (lo + hi);
        const cap_cosine_place at = cap_cosine_at(k, p);
        const double root = buffon_priv_cbrt(cap_cosine_left(k, &at, p));
        const double slope = at.chord * k->s * at.cosine / (3 * root * root * k->half);
        const double next = p + (root - wanted) / slope;
        *(root > wanted ? &lo : &hi) = p;
        if (buffon_priv_abs(next - p) <= 0x1p-28 * k->end)
            return next < 0 ? 0 : next < k->end ? next : k->end;
        p = next;
        if (hi - lo <= 0x1p-52 * k->end)
            break;
    }
    return p > lo && p < hi ? p : 0.5 * (lo + hi);
}

/* ---- shape -------------------------------------------------------------------------------- */

/* The frame, and the height of the axis above the horizon by its sine and cosine. */
static void cap_cosine_turn(double *param, const double a[3], const double n[3], int level)
{
    const double *along = level ? n : a, *other = level ? a : n;
    double frame[FRAME_SIZE], lean[2];
    frame_make(frame, along);
    frame_across(lean, frame, other[0], other[1], other[2]);
    const double up = a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
    const double across = sqrt(lean[0] * lean[0] + lean[1] * lean[1]);
    const double length = sqrt(up * up + across * across);
    const double p = across > 0 ? lean[0] / across : 1, q = across > 0 ? lean[1] / across : 0;
    for (int j = 0; j < 3; j++) {
        param[j] = p * frame[j] + q * frame[3 + j];
        param[3 + j] = p * frame[3 + j] - q * frame[j];
        param[6 + j] = along[j];
    }
    param[CAP_COSINE_UP] = up / length;
    param[CAP_COSINE_ACROSS] = across / length;
}

static double cap_cosine_sine(double angle)
{
    return buffon_priv_sinpi(angle / CAP_COSINE_PI);
}

/* Where the horizon is, and the irradiance. The axis is at `height`. */
static void cap_cosine_measure(double *param, double half_angle)
{
    const double s = param[CAP_COSINE_SINE], c = param[CAP_COSINE_COSINE];
    const double sb = param[CAP_COSINE_UP], cb = param[CAP_COSINE_ACROSS];
    const double height = CAP_COSINE_PI * buffon_priv_atan2pi(sb, cb);
    const double size = buffon_priv_abs(height), differ = cap_cosine_sine(half_angle - size);
    if (height >= half_angle) {
        param[CAP_COSINE_LOWEST] = 2 * s * cb < c * sb ? c * sb - s * cb : -differ;
        param[CAP_COSINE_TOTAL] = CAP_COSINE_PI * s * s * sb;
    } else if (height > -half_angle) {
        const double both = sqrt(differ * cap_cosine_sine(half_angle + size));
        param[CAP_COSINE_LOWEST] =
            -CAP_COSINE_PI * buffon_priv_atan2pi(both, c * buffon_priv_abs(sb));
        param[CAP_COSINE_TOTAL] = 2 * cap_cosine_cut_of(param).half;
    }
}

/* All of `param`; the irradiance is 0 where the cap is below the horizon. */
static buffon_status cap_cosine_set(double *param, double half_angle, const double axis[3],
                                    const double normal[3])
{
    const double right = 0.5 * CAP_COSINE_PI, rest = 0x1.1a62633145c07p-54;
    double a[3] = {0}, n[3] = {0};
    if (!axis || !normal)
        return BUFFON_E_NULL;
    if (!(half_angle > 0 && half_angle <= right) || frame_unit(a, axis) == 0 ||
        frame_unit(n, normal) == 0)
        return BUFFON_E_SHAPE;
    const int level = (n[0] != 0) + (n[1] != 0) + (n[2] != 0) == 1;
    cap_cosine_turn(param, a, n, level);
    const double s = cap_cosine_sine(half_angle), half = cap_cosine_sine(0.5 * half_angle);
    const double slack = !level && frame_is_upright(param) ? 0 : 0x1p-50;
    const double reach = 2 * half * (1 + 0x1p-50) + slack;
    param[CAP_COSINE_SINE] = s;
    param[CAP_COSINE_COSINE] =
        half_angle > 1 ? cap_cosine_sine((right - half_angle) + rest) : 1 - 2 * half * half;
    param[CAP_COSINE_REACH] = level ? -reach : reach;
    cap_cosine_measure(param, half_angle);
    return BUFFON_OK;
}

double buffon_cap_irradiance(double half_angle, const double axis[3], const double normal[3])
{
    double param[BUFFON_DENSITY_PARAMS] = {0};
    if (cap_cosine_set(param, half_angle, axis, normal) != BUFFON_OK)
        return (double)NAN;
    return param[CAP_COSINE_TOTAL];
}

/* The half angle at which a sphere is seen, and the axis; NaN where it is not. The sine is radius
 * over distance, and the cosine the root of a product in which only distance - radius cancels. */
static double cap_cosine_seen(double axis[3], const double from[3], const double centre[3],
                              double radius)
{
    const double most = 0x1p1000;
    int valid = radius > 0 && radius <= most;
    double unit[3];
    for (size_t j = 0; j < 3; j++) {
        valid &= buffon_priv_abs(from[j]) <= most && buffon_priv_abs(centre[j]) <= most;
        axis[j] = centre[j] - from[j];
    }
    const double d = frame_unit(unit, axis);
    if (!(valid && d > radius))
        return (double)NAN;
    const double cosine = sqrt((d - radius) / d * ((d + radius) / d));
    return CAP_COSINE_PI * buffon_priv_atan2pi(radius / d, cosine);
}

double buffon_cap_irradiance_of_sphere(const double from[3], const double centre[3], double radius,
                                       const double normal[3])
{
    double axis[3];
    if (!from || !centre)
        return (double)NAN;
    const double half_angle = cap_cosine_seen(axis, from, centre, radius);
    return buffon_cap_irradiance(half_angle, axis, normal);
}

/* ---- the density -------------------------------------------------------------------------- */

/* u1 is the place across, both sides of y = 0 alike; u2 goes along the chord, from the horizon. The
 * height of a point at depth d below the circle is sqrt(d (2 r - d)). What it has along the axis is
 * found from the sine, whose digits a small cap needs: a cosine that is off by an ulp would be off
 * the cap. The least of u2 keep off the horizon, where g is 0. */
static void cap_cosine_draw_cut(double *x, double *pdf, const double *u, size_t n,
                                const buffon_density *g)
{
    const double *f = g->param;
    const int level = f[CAP_COSINE_REACH] < 0;
    const cap_cosine_cut k = cap_cosine_cut_of(f);
    for (size_t i = 0; i < n; i++) {
        const int left = u[i] < 0.5;
        const double p = cap_cosine_solve(&k, 2 * (left ? u[i] : 1 - u[i]));
        const cap_cosine_place at = cap_cosine_at(&k, p);
        const double up = u[n + i] < 0x1p-60 ? 0x1p-60 : u[n + i];
        const double d = at.gap + up * at.chord, b = left ? -at.y : at.y;
        const double z = sqrt(d * (2 * at.r - d)), out = at.r - d;
        const double across = level ? out : z * k.cb - out * k.sb;
        const double height = out * k.cb + z * k.sb;
        const double along = level ? z : 1 - (across * across + b * b) / (1 + height);
        for (size_t j = 0; j < 3; j++)
            x[j * n + i] = across * f[j] + b * f[3 + j] + along * f[6 + j];
        if (pdf)
            pdf[i] = z / f[CAP_COSINE_TOTAL];
    }
}

static int cap_cosine_draw(double *x, double *pdf, const double *u, size_t n,
                           const buffon_density *g)
{
    double *const row[4] = {x, x + n, x + 2 * n, pdf};
    if (g->param[CAP_COSINE_LOWEST] < 0)
        cap_cosine_draw_cut(x, pdf, u, n, g);
    else
        LEVELS_RUN(cap_cosine_map, (row, u, u + n, n, g->param));
    return 0;
}

/* A direction in the cap's frame, in the surface's, and its squared chord from the axis. */
typedef struct cap_cosine_view {
    double t, b, a, x, z, chord;
} cap_cosine_view;

static cap_cosine_view cap_cosine_see(const double *f, double x, double y, double z)
{
    const double sb = f[CAP_COSINE_UP], cb = f[CAP_COSINE_ACROSS];
    const double along = x * f[6] + y * f[7] + z * f[8];
    double off[2];
    cap_cosine_view v;
    frame_across(off, f, x, y, z);
    v.b = off[1];
    if (f[CAP_COSINE_REACH] < 0) {
        v.x = off[0];
        v.z = along;
        v.t = (v.z - sb) * cb - (v.x - cb) * sb;
        v.a = v.x * cb + v.z * sb;
        v.chord = (v.x - cb) * (v.x - cb) + v.b * v.b + (v.z - sb) * (v.z - sb);
    } else {
        const double dx = x - f[6], dy = y - f[7], dz = z - f[8];
        v.t = off[0];
        v.a = along;
        v.x = v.a * cb - v.t * sb;
        v.z = v.t * cb + v.a * sb;
        v.chord = dx * dx + dy * dy + dz * dz;
    }
    return v;
}

static int cap_cosine_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *f = g->param, reach = f[CAP_COSINE_REACH] * f[CAP_COSINE_REACH];
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i], c = x[2 * n + i];
        const cap_cosine_view v = cap_cosine_see(f, a, b, c);
        const int in = v.chord <= reach && v.z > 0 && frame_is_unit(a, b, c);
        pdf[i] = in ? v.z / f[CAP_COSINE_TOTAL] : 0;
    }
    return 0;
}

/* The way back to the cap's base: its point has risen by (h - w) / sin B along the normal, with w =
 * 1 - cos of the direction's angle from the axis. */
static void cap_cosine_unmap_whole(double u[2], const cap_cosine_view *v, const double *f)
{
    const double s = f[CAP_COSINE_SINE], h = s * s / (1 + f[CAP_COSINE_COSINE]);
    const double rise = h > 0.5 * v->chord ? (h - 0.5 * v->chord) / f[CAP_COSINE_UP] : 0;
    buffon_priv_concentric_invert(u, (v->t - rise * f[CAP_COSINE_ACROSS]) / s, v->b / s);
}

static void cap_cosine_unmap_cut(double u[2], const cap_cosine_view *v, const cap_cosine_cut *k)
{
    const double y = buffon_priv_abs(v->b), z = v->z > 0 ? v->z : 0;
    const double inside = y < k->s ? sqrt((k->s - y) * (k->s + y)) : 0;
    double p = CAP_COSINE_PI * buffon_priv_atan2pi(y, inside);
    p = p < k->end ? p : k->end;
    const cap_cosine_place at = cap_cosine_at(k, p);
    const double share = 0.5 * cap_cosine_left(k, &at, p);
    const double d = v->x > 0 ? z * z / (at.r + v->x) : at.r - v->x;
    u[0] = density_open(v->b < 0 ? share : 1 - share);
    u[1] = density_open(at.chord > 0 ? (d - at.gap) / at.chord : 0.5);
}

static int cap_cosine_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *f = g->param;
    const int cut = f[CAP_COSINE_LOWEST] < 0;
    const cap_cosine_cut k = cut ? cap_cosine_cut_of(f) : (cap_cosine_cut){0};
    for (size_t i = 0; i < n; i++) {
        const cap_cosine_view v = cap_cosine_see(f, x[i], x[n + i], x[2 * n + i]);
        double place[2];
        if (cut)
            cap_cosine_unmap_cut(place, &v, &k);
        else
            cap_cosine_unmap_whole(place, &v, f);
        u[i] = place[0];
        u[n + i] = place[1];
    }
    return 0;
}

static const buffon_density_ops cap_cosine_ops = {.sample = cap_cosine_draw,
                                                  .pdf = cap_cosine_pdf,
                                                  .invert = cap_cosine_invert,
                                                  .name = "buffon.cap_cosine"};

buffon_density buffon_cap_cosine(double half_angle, const double axis[3], const double normal[3])
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = &cap_cosine_ops};
    const buffon_status status = cap_cosine_set(g.param, half_angle, axis, normal);
    if (status == BUFFON_OK && g.param[CAP_COSINE_TOTAL] >= 0x1p-960)
        return g;
    g = (buffon_density){.uniforms = 2, .dim = 3, .ops = &cap_cosine_ops};
    g.status = status == BUFFON_OK ? BUFFON_E_SHAPE : status;
    return g;
}

buffon_density buffon_cap_cosine_of_sphere(const double from[3], const double centre[3],
                                           double radius, const double normal[3])
{
    double axis[3];
    if (!from || !centre)
        return buffon_cap_cosine(1, NULL, normal);
    const double half_angle = cap_cosine_seen(axis, from, centre, radius);
    return buffon_cap_cosine(half_angle, axis, normal);
}
