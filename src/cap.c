#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/cap.h>

#include "circle.h"
#include "density_priv.h"
#include "frame.h"

/* The numbers of a cap in `param`: the frame, its height h, what is left of the diameter 2 - h, and
 * the largest squared chord from the axis that counts as inside. */
enum { CAP_HEIGHT = FRAME_SIZE, CAP_REST, CAP_REACH };

/* What the kernel takes: h, h1, 2 - h1 and h0 of the zone. */
enum { ZONE_HEIGHT, ZONE_DEPTH, ZONE_REST, ZONE_FIRST, ZONE_SIZE };

#define KERNELS "cap_lanes.h"
#include "levels.h"

static double cap_density(const buffon_density *g)
{
    return 0.5 * DENSITY_INV_PI / g->param[CAP_HEIGHT];
}

static int cap_draw_from(double *x, double *pdf, const double *u, size_t n, const buffon_density *g,
                         double h0, double h1)
{
    double *const row[3] = {x, x + n, x + 2 * n};
    const double zone[ZONE_SIZE] = {g->param[CAP_HEIGHT], h1, g->param[CAP_REST], h0};
    LEVELS_RUN(cap_map, (row, u, u + n, n, g->param, zone));
    if (pdf)
        density_fill(pdf, cap_density(g), n);
    return 0;
}

static int cap_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    return cap_draw_from(x, pdf, u, n, g, 0, g->param[CAP_HEIGHT]);
}

static int cap_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *axis = g->param + 6, reach = g->param[CAP_REACH], value = cap_density(g);
    const double ax = axis[0], ay = axis[1], az = axis[2];
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i], c = x[2 * n + i];
        const double chord = (a - ax) * (a - ax) + (b - ay) * (b - ay) + (c - az) * (c - az);
        const int in = (chord <= reach) & frame_is_unit(a, b, c);
        pdf[i] = in ? value : 0;
    }
    return 0;
}

/* The squared chords of a direction to the axis and to its opposite. */
static void cap_chords(double *near, double *far, const double *axis, double x, double y, double z)
{
    const double ax = axis[0], ay = axis[1], az = axis[2];
    *near = (x - ax) * (x - ax) + (y - ay) * (y - ay) + (z - az) * (z - az);
    *far = (x + ax) * (x + ax) + (y + ay) * (y + ay) + (z + az) * (z + az);
}

/* w is half the squared chord d - n, and 2 - w half that of d + n: the shorter keeps its digits. It
 * grows from h0. */
static void cap_unmap(double u[2], double x, double y, double z, const double *param, double h0)
{
    const double h = param[CAP_HEIGHT];
    double near, far, across[2];
    cap_chords(&near, &far, param + 6, x, y, z);
    frame_across(across, param, x, y, z);
    u[0] =
        density_open(near <= far ? (0.5 * near - h0) / h : 1 - (0.5 * far - param[CAP_REST]) / h);
    u[1] = buffon_priv_circle_invert(across[0], across[1]);
}

static int cap_invert_from(double *u, const double *x, size_t n, const buffon_density *g, double h0)
{
    for (size_t i = 0; i < n; i++) {
        double v[2];
        cap_unmap(v, x[i], x[n + i], x[2 * n + i], g->param, h0);
        u[i] = v[0];
        u[n + i] = v[1];
    }
    return 0;
}

static int cap_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    return cap_invert_from(u, x, n, g, 0);
}

static const buffon_density_ops cap_ops = {
    .sample = cap_draw, .pdf = cap_pdf, .invert = cap_invert, .name = "buffon.cap"};

/* About +z the points of even the smallest cap have all their digits; about another axis the
 * doubles near it are 2^-53 apart, and membership must allow for that. */
static double cap_slack(const double *frame)
{
    return frame_is_upright(frame) ? 0 : 0x1p-50;
}

/* The square of the chord of a depth, with room for rounding. */
static double cap_edge(double depth, double slack, int outwards)
{
    const double chord = sqrt(2 * depth);
    const double moved = outwards ? chord * (1 + 0x1p-50) + slack : chord * (1 - 0x1p-50) - slack;
    return moved > 0 ? moved * moved : 0;
}

/* What caps and zones have in common: the frame, the height and what is left of the diameter. */
static buffon_density cap_begin(const buffon_density_ops *ops, double h, double rest,
                                const double axis[3])
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = ops};
    double n[3];
    if (!axis)
        g.status = BUFFON_E_NULL;
    else if (!(h >= DBL_MIN && h <= 2) || frame_unit(n, axis) == 0)
        g.status = BUFFON_E_SHAPE;
    if (g.status != BUFFON_OK)
        return g;
    frame_make(g.param, n);
    g.param[CAP_HEIGHT] = h;
    g.param[CAP_REST] = rest;
    return g;
}

static buffon_density cap_make(double h, double rest, const double axis[3])
{
    buffon_density g = cap_begin(&cap_ops, h, rest, axis);
    if (g.status == BUFFON_OK)
        g.param[CAP_REACH] = cap_edge(h, cap_slack(g.param), 1);
    return g;
}

buffon_density buffon_cap_about(double cut, const double axis[3])
{
    const int valid = cut >= -1 && cut < 1;
    return cap_make(valid ? 1 - cut : (double)NAN, 1 + cut, axis);
}

buffon_density buffon_cap(double cut)
{
    const double up[3] = {0, 0, 1};
    return buffon_cap_about(cut, up);
}

buffon_density buffon_cap_height(double one_minus_cos, const double axis[3])
{
    return cap_make(one_minus_cos, 2 - one_minus_cos, axis);
}

#define CAP_PI 0x1.921fb54442d18p+1

/* sin(x) for 0 <= x <= pi / 2. */
static double cap_sine(double x)
{
    return buffon_priv_sinpi(x * DENSITY_INV_PI);
}

/* pi - x, which loses no digit near pi: the first difference is exact there. */
static double cap_from_pi(double x)
{
    return (CAP_PI - x) + 0x1.1a62633145c07p-53;
}

/* h = 1 - cos(x) and 2 - h = 1 + cos(x) for 0 <= x <= pi, the smaller from its own sine. */
static void cap_depths(double *h, double *rest, double x)
{
    const int near = x <= 0.5 * CAP_PI;
    const double s = cap_sine(0.5 * (near ? x : cap_from_pi(x))), small = 2 * s * s;
    *h = near ? small : 2 - small;
    *rest = near ? 2 - small : small;
}

buffon_density buffon_cap_angle(double half_angle, const double axis[3])
{
    double s, c;
    buffon_priv_sincospi(&s, &c, half_angle / (2 * CAP_PI));
    if (half_angle > 0.5 * CAP_PI)
        c = cap_sine(0.5 * cap_from_pi(half_angle));
    if (!(half_angle > 0 && half_angle <= CAP_PI))
        s = (double)NAN;
    return cap_make(2 * s * s, 2 * c * c, axis);
}

/* With s = radius / distance the sine of the half angle, h = 1 - cos = s^2 / (1 + cos) and
 * cos^2 = (1 - s)(1 + s) = ((d - r) / d) ((d + r) / d): nothing cancels but d - r. Coordinates that
 * might overflow are first scaled, exactly. */
buffon_density buffon_cap_of_sphere(const double from[3], const double centre[3], double radius)
{
    double axis[3], unit[3], h = (double)NAN, rest = h;
    int finite = 1, large = radius > 0x1p+1000;
    if (!from || !centre)
        return cap_make(h, rest, NULL);
    for (size_t j = 0; j < 3; j++) {
        finite &= buffon_priv_isfinite(from[j]) && buffon_priv_isfinite(centre[j]);
        large |= buffon_priv_abs(from[j]) > 0x1p+1000 || buffon_priv_abs(centre[j]) > 0x1p+1000;
    }
    const double scale = large ? 0x1p-4 : 1, r = scale * radius;
    for (size_t j = 0; j < 3; j++)
        axis[j] = scale * centre[j] - scale * from[j];
    const double d = frame_unit(unit, axis);
    if (finite && r > 0 && d > r) {
        const double s = r / d, cosine = sqrt((d - r) / d * ((d + r) / d));
        h = s * s / (1 + cosine);
        rest = 1 + cosine;
    }
    return cap_make(h, rest, axis);
}

/* Refused where buffon_cap refuses, by NaN. */
void buffon_cap_sample(double x[3], double u1, double u2, double cut)
{
    const buffon_density g = buffon_cap(cut);
    const double u[2] = {u1, u2};
    if (g.status == BUFFON_OK)
        (void)cap_draw(x, NULL, u, 1, &g);
    else
        density_fill(x, (double)NAN, 3);
}

void buffon_cap_invert(double u[2], const double x[3], double cut)
{
    const buffon_density g = buffon_cap(cut);
    if (g.status == BUFFON_OK)
        cap_unmap(u, x[0], x[1], x[2], g.param, 0);
    else
        density_fill(u, (double)NAN, 2);
}

/* ---- zones -------------------------------------------------------------------------------- */

/* A zone in `param`: as a cap, but for the reach, and then the depths of both edges; the squares of
 * the chords that the edges are judged by, each from the pole that is nearer to it. */
enum { ZONE_H0 = CAP_REACH, ZONE_H1, ZONE_UPPER, ZONE_LOWER };

static int cap_draw_zone(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    return cap_draw_from(x, pdf, u, n, g, g->param[ZONE_H0], g->param[ZONE_H1]);
}

static int cap_pdf_zone(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param, value = cap_density(g);
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i], c = x[2 * n + i];
        double near, far;
        cap_chords(&near, &far, p + 6, a, b, c);
        const int below = p[ZONE_H0] <= 1 ? near >= p[ZONE_UPPER] : far <= p[ZONE_UPPER];
        const int above = p[ZONE_H1] <= 1 ? near <= p[ZONE_LOWER] : far >= p[ZONE_LOWER];
        pdf[i] = below && above && frame_is_unit(a, b, c) ? value : 0;
    }
    return 0;
}

static int cap_invert_zone(double *u, const double *x, size_t n, const buffon_density *g)
{
    return cap_invert_from(u, x, n, g, g->param[ZONE_H0]);
}

static const buffon_density_ops cap_zone_ops = {
    .sample = cap_draw_zone, .pdf = cap_pdf_zone, .invert = cap_invert_zone, .name = "buffon.zone"};

/* From depth h0 to h1 with h = h1 - h0. `left` and `rest` are 2 - h0 and 2 - h1. Each number is
 * given by whoever knows its digits. */
static buffon_density cap_make_zone(double h0, double h1, double h, double left, double rest,
                                    const double axis[3])
{
    const int valid = h0 >= 0 && h1 <= 2;
    buffon_density g = cap_begin(&cap_zone_ops, valid ? h : (double)NAN, rest, axis);
    if (g.status != BUFFON_OK)
        return g;
    const double slack = cap_slack(g.param);
    g.param[ZONE_H0] = h0;
    g.param[ZONE_H1] = h1;
    g.param[ZONE_UPPER] = h0 <= 1 ? cap_edge(h0, slack, 0) : cap_edge(left, slack, 1);
    g.param[ZONE_LOWER] = h1 <= 1 ? cap_edge(h1, slack, 1) : cap_edge(rest, slack, 0);
    return g;
}

buffon_density buffon_zone(double z0, double z1, const double axis[3])
{
    const int valid = z0 >= -1 && z1 <= 1;
    return cap_make_zone(1 - z1, 1 - z0, valid ? z1 - z0 : (double)NAN, 1 + z1, 1 + z0, axis);
}

buffon_density buffon_zone_heights(double h0, double h1, const double axis[3])
{
    return cap_make_zone(h0, h1, h1 - h0, 2 - h0, 2 - h1, axis);
}

/* h1 - h0 = cos a0 - cos a1 = 2 sin((a1 - a0) / 2) sin((a1 + a0) / 2). */
buffon_density buffon_zone_angles(double angle0, double angle1, const double axis[3])
{
    double h0, h1, left, rest;
    const double mean = 0.5 * (angle0 + angle1);
    const double across = 0.5 * (cap_from_pi(angle0) + cap_from_pi(angle1));
    const double slope = cap_sine(mean <= across ? mean : across);
    const int valid = angle0 >= 0 && angle0 < angle1 && angle1 <= CAP_PI;
    const double h = valid ? 2 * cap_sine(0.5 * (angle1 - angle0)) * slope : (double)NAN;
    cap_depths(&h0, &left, angle0);
    cap_depths(&h1, &rest, angle1);
    return cap_make_zone(h0, h1, h, left, rest, axis);
}

buffon_density buffon_cap_complement_height(double one_minus_cos, const double axis[3])
{
    const double h0 = one_minus_cos, rest = 2 - h0;
    return cap_make_zone(h0, 2, h0 > 0 ? rest : (double)NAN, rest, 0, axis);
}

buffon_density buffon_cap_complement_angle(double half_angle, const double axis[3])
{
    double h, left;
    cap_depths(&h, &left, half_angle);
    if (!(half_angle > 0 && half_angle <= CAP_PI))
        left = (double)NAN;
    return cap_make_zone(h, 2, left, left, 0, axis);
}
