#include "guard.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <buffon/spherical.h>

#include "density_priv.h"
#include "frame.h"
#include "pair.h"

/* The numbers of a density in `param`. Of a triangle: three unit vectors, and what the map needs of
 * them. Of a rectangle: its corner and edges seen from the observer, and its bounds in the
 * coordinates of its plane. SPHERICAL_HALF is half the solid angle over pi. */
enum {
    SPHERICAL_A = 0,
    SPHERICAL_B = 3,
    SPHERICAL_C = 6,
    SPHERICAL_HALF = 9,
    SPHERICAL_RATIO = 10,
    SPHERICAL_COSINE = 11,
    SPHERICAL_X0 = 10, /* and x1, y0, y1, z */
};

/* The most corners of a polygon. */
#define SPHERICAL_MOST 16

/* What the map of a rectangle needs, mirrored so that x1 >= 0 and y1 >= 0 and neither bound below 0
 * unless the other is above. */
typedef struct spherical_view {
    double x0, x1, y0, y1, z, width, high, half;
    double t0, t1, delta, sigma, scale, q0, above, below;
    int mirror[2];
} spherical_view;

#define KERNELS "spherical_lanes.h"
#include "levels.h"

/* ---- solid angles ---- */

/* Vectors from the observer, brought near 1 by a power of two. */
typedef struct spherical_corners {
    pair at[4][3], edge[2][3];
} spherical_corners;

static double spherical_most(const spherical_corners *s, size_t corners)
{
    double most = 0;
    for (size_t k = 0; k < 3 * corners; k++) {
        const double size = buffon_priv_abs(s->at[k / 3][k % 3].hi);
        if (!buffon_priv_isfinite(size))
            return (double)NAN;
        most = size > most ? size : most;
    }
    return most;
}

/* Returns the exponent of the scale, or 0 and NaNs where numbers are not usable. */
static int spherical_scale(spherical_corners *s, size_t corners)
{
    const double most = spherical_most(s, corners);
    const int usable = most >= 0x1p-900 && most <= 0x1p+1000;
    int exponent = 0;
    if (usable)
        buffon_priv_frexp(&exponent, most);
    const double scale = usable ? buffon_priv_ldexp(1, -exponent) : (double)NAN;
    for (size_t k = 0; k < 12; k++)
        s->at[k / 3][k % 3] = pair_scale(s->at[k / 3][k % 3], scale);
    for (size_t k = 0; k < 6; k++)
        s->edge[k / 3][k % 3] = pair_scale(s->edge[k / 3][k % 3], scale);
    return exponent;
}

static void spherical_from_corners(spherical_corners *s, const double from[3], const double a[3],
                                   const double b[3], const double c[3])
{
    memset(s, 0, sizeof *s);
    for (size_t j = 0; j < 3; j++) {
        s->at[0][j] = pair_difference(a[j], from[j]);
        s->at[1][j] = pair_difference(b[j], from[j]);
        s->at[2][j] = pair_difference(c[j], from[j]);
        s->edge[0][j] = pair_difference(b[j], a[j]);
        s->edge[1][j] = pair_difference(c[j], a[j]);
    }
    spherical_scale(s, 3);
}

static void spherical_from_edges(spherical_corners *s, const double from[3], const double corner[3],
                                 const double edge1[3], const double edge2[3])
{
    for (size_t j = 0; j < 3; j++) {
        s->edge[0][j] = pair_of(edge1[j]);
        s->edge[1][j] = pair_of(edge2[j]);
        s->at[0][j] = pair_difference(corner[j], from[j]);
        s->at[1][j] = pair_add(s->at[0][j], s->edge[0][j]);
        s->at[2][j] = pair_add(s->at[1][j], s->edge[1][j]);
        s->at[3][j] = pair_add(s->at[0][j], s->edge[1][j]);
    }
}

/* A. van Oosterom, J. Strackee (1983), The solid angle of a plane triangle. With A, B, C the
 * corners from the observer, tan(solid angle / 2) is
 *
 *     |A . (B - A) x (C - A)| over |A||B||C| + A.B |C| + B.C |A| + C.A |B|
 *
 * Edges make the triple product as small as it is; with twice the digits, and edges from the
 * corners as given, nothing is left that could cancel: not for small triangles, nor far off, nor
 * nearly in a plane with the observer. */
typedef struct spherical_angle {
    pair length[3], across, along;
    double half; /* of the solid angle, over pi */
} spherical_angle;

static void spherical_measure(spherical_angle *out, const pair a[3], const pair b[3],
                              const pair c[3], const pair ab[3], const pair ac[3])
{
    pair normal[3];
    pair_cross(normal, ab, ac);
    out->across = pair_dot(a, normal);
    if (out->across.hi < 0)
        out->across = pair_negate(out->across);
    out->length[0] = pair_length(a);
    out->length[1] = pair_length(b);
    out->length[2] = pair_length(c);
    const pair product =
        pair_multiply(pair_multiply(out->length[0], out->length[1]), out->length[2]);
    const pair one = pair_add(product, pair_multiply(pair_dot(a, b), out->length[2]));
    const pair two = pair_add(pair_multiply(pair_dot(b, c), out->length[0]),
                              pair_multiply(pair_dot(c, a), out->length[1]));
    out->along = pair_add(one, two);
    out->half = buffon_priv_atan2pi(pair_value(out->across), pair_value(out->along));
}

#define SPHERICAL_TWO_PI 0x1.921fb54442d18p+2

double buffon_solid_angle_triangle(const double from[3], const double a[3], const double b[3],
                                   const double c[3])
{
    spherical_corners s;
    spherical_angle angle;
    if (!from || !a || !b || !c)
        return (double)NAN;
    spherical_from_corners(&s, from, a, b, c);
    spherical_measure(&angle, s.at[0], s.at[1], s.at[2], s.edge[0], s.edge[1]);
    return SPHERICAL_TWO_PI * angle.half;
}

/* Two triangles, of which the first has the diagonal for its second edge, the other for its first.
 */
static double spherical_quad(const spherical_corners *s)
{
    spherical_angle first, second;
    pair diagonal[3];
    for (size_t j = 0; j < 3; j++)
        diagonal[j] = pair_add(s->edge[0][j], s->edge[1][j]);
    spherical_measure(&first, s->at[0], s->at[1], s->at[2], s->edge[0], diagonal);
    spherical_measure(&second, s->at[0], s->at[2], s->at[3], diagonal, s->edge[1]);
    return first.half + second.half;
}

double buffon_solid_angle_parallelogram(const double from[3], const double corner[3],
                                        const double edge1[3], const double edge2[3])
{
    spherical_corners s;
    if (!from || !corner || !edge1 || !edge2)
        return (double)NAN;
    spherical_from_edges(&s, from, corner, edge1, edge2);
    spherical_scale(&s, 4);
    return SPHERICAL_TWO_PI * spherical_quad(&s);
}

/* ---- where a spherical polygon ends ---- */

/* The planes through the observer and each side, with normals inward, and a direction that all of
 * the polygon is near to, for those that are smaller than an octant: it tells them from what lies
 * opposite. */
typedef struct spherical_walls {
    size_t count;
    double normal[SPHERICAL_MOST][3], corner[SPHERICAL_MOST][3], slack[SPHERICAL_MOST], middle[3];
} spherical_walls;

static double spherical_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void spherical_cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* From corners, of any length, and the sides from each to the next. A normal is corner x side: that
 * of a short side keeps its direction. Directions are rounded by 2^-53, which counts for more where
 * a side is nearly half a circle. */
static void spherical_walls_make(spherical_walls *w, double (*corner)[3], double (*side)[3],
                                 size_t count)
{
    int narrow = 1;
    memset(w, 0, sizeof *w);
    w->count = count;
    for (size_t k = 0; k < count; k++)
        frame_unit(w->corner[k], corner[k]);
    for (size_t k = 0; k < count; k++) {
        const double *a = w->corner[k], *b = w->corner[(k + 1) % count];
        double v[3], sum[3];
        spherical_cross(v, corner[k], side[k]);
        frame_unit(w->normal[k], v);
        const double sign = spherical_dot(side[(k + 1) % count], v) < 0 ? -1 : 1;
        for (size_t j = 0; j < 3; j++) {
            w->normal[k][j] *= sign;
            w->middle[j] += a[j];
            sum[j] = b[j] + a[j];
        }
        w->slack[k] = 0x1p-49 * (1 + 1 / sqrt(spherical_dot(sum, sum)));
        narrow &= spherical_dot(a, b) > 0 && spherical_dot(a, w->corner[(k + 2) % count]) > 0;
    }
    for (size_t j = 0; j < 3; j++)
        w->middle[j] = narrow ? w->middle[j] : 0;
}

static int spherical_holds(const spherical_walls *w, const double x[3])
{
    int in = frame_is_unit(x[0], x[1], x[2]) & (spherical_dot(x, w->middle) >= 0);
    for (size_t k = 0; k < w->count; k++) {
        const double d[3] = {x[0] - w->corner[k][0], x[1] - w->corner[k][1],
                             x[2] - w->corner[k][2]};
        in &= spherical_dot(d, w->normal[k]) >= -w->slack[k];
    }
    return in;
}

static double spherical_density(const buffon_density *g)
{
    return 0.5 * DENSITY_INV_PI / g->param[SPHERICAL_HALF];
}

static void spherical_weigh(double *pdf, const double *x, size_t n, const buffon_density *g,
                            const spherical_walls *w)
{
    for (size_t i = 0; i < n; i++) {
        const double point[3] = {x[i], x[n + i], x[2 * n + i]};
        pdf[i] = spherical_holds(w, point) ? spherical_density(g) : 0;
    }
}

static void spherical_judge(double *pdf, const double *x, size_t n, const buffon_density *g,
                            double (*corner)[3], double (*side)[3], size_t count)
{
    spherical_walls w;
    spherical_walls_make(&w, corner, side, count);
    spherical_weigh(pdf, x, n, g, &w);
}

/* ---- triangle ----
 *
 * J. Arvo (1995), Stratified sampling of spherical triangles, without its cancellations. Unit
 * vectors a, b, c; H half the solid angle. First a corner c' on the arc from a to c such that the
 * triangle a b c' has the part u1. With R the length of (across, along) of spherical_measure, all
 * over |A||B||C|, and
 *
 *     near = sin((1 - u1) H),  far = (1 + a.b)/R sin(u1 H),  k = 1 + a.c,
 *
 * the tangent of u1 H by the formula above for a, b, c' gives
 *
 *     c' = (near (near + 2 far) a + 2 far (near + k far) c) / (near^2 + 2 k far (near + far)),
 *
 * sums and products of positive numbers. Then x on the arc from b to c' with
 * 1 - x.b = u2 (1 - c'.b), by half angles, again of positive numbers: for q = 1 - c'.b, p = 2 - q,
 * r = sqrt(u2), e = sqrt(p/2), f = sqrt(1 - u2 q/2)
 *
 *     x = (1 - u2) (f e + r q/2) / (e (f + e r)) b + r f/e c'.
 *
 * p only needs its digits where c' is nearly opposite to b: it is half the square of c' + b. */

static int spherical_triangle_draw(double *x, double *pdf, const double *u, size_t n,
                                   const buffon_density *g)
{
    LEVELS_RUN(spherical_triangle, (x, u, n, g->param));
    if (pdf)
        density_fill(pdf, spherical_density(g), n);
    return 0;
}

static int spherical_triangle_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    double corner[3][3], side[3][3];
    for (size_t k = 0; k < 9; k++) {
        corner[k / 3][k % 3] = g->param[k];
        side[k / 3][k % 3] = g->param[(k + 3) % 9] - g->param[k];
    }
    spherical_judge(pdf, x, n, g, corner, side, 3);
    return 0;
}

/* c' = (s a + t c) / |s a + t c| with s = [x b c] and t = [a b x], up to sign; its triangle's share
 * by the formula above; and the ratio of the squared chords from b to x and to c'. */
typedef struct spherical_return {
    double side_a[3], side_c[3], on_a[3], on_c[3], sine, cosine;
} spherical_return;

static void spherical_return_make(spherical_return *r, const double *param)
{
    const double *a = param + SPHERICAL_A, *b = param + SPHERICAL_B, *c = param + SPHERICAL_C;
    for (size_t j = 0; j < 3; j++) {
        r->side_a[j] = a[j] - b[j];
        r->side_c[j] = c[j] - b[j];
    }
    spherical_cross(r->on_a, b, r->side_c);
    spherical_cross(r->on_c, r->side_a, b);
    if (spherical_dot(r->on_a, r->side_a) < 0)
        for (size_t j = 0; j < 3; j++) {
            r->on_a[j] = -r->on_a[j];
            r->on_c[j] = -r->on_c[j];
        }
    buffon_priv_sincospi(&r->sine, &r->cosine, param[SPHERICAL_HALF]);
}

static double spherical_positive(double x)
{
    return x > 0 ? x : 0;
}

static void spherical_triangle_unmap(double u[2], const double x[3], const double *param,
                                     const spherical_return *r)
{
    const double *b = param + SPHERICAL_B, k = param[SPHERICAL_COSINE];
    const double d[3] = {x[0] - b[0], x[1] - b[1], x[2] - b[2]};
    const double s = spherical_positive(spherical_dot(d, r->on_a));
    const double t = spherical_positive(spherical_dot(d, r->on_c));
    const double length = sqrt((s - t) * (s - t) + 2 * k * s * t);
    double chord = 0, share[2] = {0.5, 0.5};
    if (length > 0) {
        const double far = t / (length + s);
        const double near = spherical_positive(1 - far);
        share[0] =
            buffon_priv_atan2pi(far * r->sine, near * param[SPHERICAL_RATIO] + far * r->cosine) /
            param[SPHERICAL_HALF];
        for (size_t j = 0; j < 3; j++) {
            const double bow = 2 * (2 - k) * s * t / (s + t + length);
            const double e = (s * r->side_a[j] + t * r->side_c[j] + bow * b[j]) / length;
            chord += e * e;
        }
        share[1] = chord > 0 ? spherical_dot(d, d) / chord : 0.5;
    }
    u[0] = density_open(share[0]);
    u[1] = density_open(share[1]);
}

static int spherical_triangle_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    spherical_return r;
    spherical_return_make(&r, g->param);
    for (size_t i = 0; i < n; i++) {
        const double point[3] = {x[i], x[n + i], x[2 * n + i]};
        double v[2];
        spherical_triangle_unmap(v, point, g->param, &r);
        u[i] = v[0];
        u[n + i] = v[1];
    }
    return 0;
}

static const buffon_density_ops spherical_triangle_ops = {.sample = spherical_triangle_draw,
                                                          .pdf = spherical_triangle_pdf,
                                                          .invert = spherical_triangle_invert,
                                                          .name = "buffon.spherical_triangle"};

/* The density, and the distances of the corners up to a factor. */
static buffon_density spherical_triangle_make(double distance[3], const double from[3],
                                              const double a[3], const double b[3],
                                              const double c[3])
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = &spherical_triangle_ops};
    spherical_corners s;
    spherical_angle angle;
    if (!from || !a || !b || !c) {
        g.status = BUFFON_E_NULL;
        return g;
    }
    spherical_from_corners(&s, from, a, b, c);
    spherical_measure(&angle, s.at[0], s.at[1], s.at[2], s.edge[0], s.edge[1]);
    const pair ab =
        pair_add(pair_multiply(angle.length[0], angle.length[1]), pair_dot(s.at[0], s.at[1]));
    const pair ac =
        pair_add(pair_multiply(angle.length[0], angle.length[2]), pair_dot(s.at[0], s.at[2]));
    const pair radius = pair_sqrt(pair_add(pair_multiply(angle.across, angle.across),
                                           pair_multiply(angle.along, angle.along)));
    g.param[SPHERICAL_HALF] = angle.half;
    g.param[SPHERICAL_RATIO] = pair_value(pair_multiply(ab, angle.length[2])) / pair_value(radius);
    g.param[SPHERICAL_COSINE] =
        pair_value(ac) / pair_value(pair_multiply(angle.length[0], angle.length[2]));
    for (size_t k = 0; k < 3; k++) {
        distance[k] = pair_value(angle.length[k]);
        for (size_t j = 0; j < 3; j++)
            g.param[3 * k + j] = pair_value(s.at[k][j]) / distance[k];
    }
    if (!(angle.half >= 0x1p-1000 && angle.half < 1 && g.param[SPHERICAL_RATIO] > 0 &&
          g.param[SPHERICAL_COSINE] > 0))
        g.status = BUFFON_E_SHAPE;
    return g;
}

buffon_density buffon_spherical_triangle(const double from[3], const double a[3], const double b[3],
                                         const double c[3])
{
    double distance[3];
    return spherical_triangle_make(distance, from, a, b, c);
}

void buffon_spherical_triangle_weights(double w[3], double u1, double u2, const double from[3],
                                       const double a[3], const double b[3], const double c[3])
{
    double distance[3], sum = 0;
    const buffon_density g = spherical_triangle_make(distance, from, a, b, c);
    density_fill(w, (double)NAN, 3);
    if (g.status != BUFFON_OK)
        return;
    spherical_share_scalar(w, u1, u2, g.param);
    for (size_t k = 0; k < 3; k++) {
        w[k] /= distance[k];
        sum += w[k];
    }
    for (size_t k = 0; k < 3; k++)
        w[k] /= sum;
}

/* ---- rectangle ----
 *
 * C. Urena, M. Fajardo, A. King (2013), An area-preserving parametrization for spherical
 * rectangles, without its cancellations. The observer is at the origin, the rectangle
 * [x0, x1] x [y0, y1] in the plane z > 0. With psi_i = atan(y_i / z) and phi = atan(x / z) the
 * strip from x = 0 to x has the solid angle
 *
 *     theta(x) = asin(sin phi sin psi1) - asin(sin phi sin psi0),
 *
 * which the law of cosines turns round. With tau = tan(theta / 2), delta = tan^2((psi1 - psi0)/2),
 * sigma = tan^2((psi1 + psi0)/2)
 *
 *     x = scale tau / sqrt(Q),  Q = (delta - tau^2) (1 - sigma tau^2),
 *     scale = z sqrt((1 + delta) (1 + sigma)),
 *
 * and the other way, with root_i = sqrt(1 + x^2 / (y_i^2 + z^2)),
 *
 *     tau = x sqrt(Q) / scale,  sqrt(Q) = 2 sqrt(delta) / (root0 + root1),
 *
 * theta grows from theta(x0) by u1 times the solid angle, tau from t0 by
 * du = sin(U) (1 + t0^2) / (cos(U) - t0 sin(U)), U half of that; towards t1 it falls short by dv,
 * likewise. The distance x - x0, which is what is small where the rectangle is, has the factor
 * du, too:
 *
 *     x - x0 = scale du (tau + t0) (delta - sigma tau^2 t0^2)
 *              / (sqrt(Q Q0) (tau sqrt(Q0) + t0 sqrt(Q))).
 *
 * On the strip at x the sine h = y / sqrt(x^2 + y^2 + z^2) is uniform, and y - y0 follows in the
 * same manner. */

/* sqrt(delta) and sigma by the tangents of half a sum or difference of angles. */
static double spherical_tangent(double sine, double cosine, double product)
{
    return cosine > 0 ? sine / (product + cosine) : (product - cosine) / sine;
}

/* sqrt(Q) at x. */
static double spherical_q(const spherical_view *r, double root, double x)
{
    const double a = x * x / (r->y0 * r->y0 + r->z * r->z);
    const double b = x * x / (r->y1 * r->y1 + r->z * r->z);
    return 2 * root / (sqrt(1 + a) + sqrt(1 + b));
}

/* sqrt(delta) - tau at x >= 0, given tau and sqrt(Q) there. */
static double spherical_short_of(const spherical_view *r, double root, double tau, double q)
{
    return q * q / ((1 - r->sigma * tau * tau) * (root + tau));
}

/* The bounds as they are, or seen in a mirror. */
static int spherical_mirror(double *lo, double *hi, double x0, double x1)
{
    const int mirror = x1 <= 0;
    *lo = mirror ? -x1 : x0;
    *hi = mirror ? -x0 : x1;
    return mirror;
}

static void spherical_view_make(spherical_view *r, const double *param)
{
    const double *at = param + SPHERICAL_X0;
    const double *e1 = param + SPHERICAL_B, *e2 = param + SPHERICAL_C;
    r->mirror[0] = spherical_mirror(&r->x0, &r->x1, at[0], at[1]);
    r->mirror[1] = spherical_mirror(&r->y0, &r->y1, at[2], at[3]);
    r->z = at[4];
    r->width = sqrt(spherical_dot(e1, e1));
    r->high = sqrt(spherical_dot(e2, e2));
    r->half = param[SPHERICAL_HALF];
    const double zz = r->z * r->z, yy = r->y0 * r->y1;
    const double product = sqrt(r->y0 * r->y0 + zz) * sqrt(r->y1 * r->y1 + zz);
    const double root = spherical_tangent(r->z * r->high, zz + yy, product);
    const double sum = spherical_tangent(r->z * (r->y1 + r->y0), zz - yy, product);
    r->delta = root * root;
    r->sigma = sum * sum;
    r->scale = r->z * sqrt((1 + r->delta) * (1 + r->sigma));
    const double q1 = spherical_q(r, root, r->x1);
    r->q0 = spherical_q(r, root, r->x0);
    r->t0 = r->x0 * r->q0 / r->scale;
    r->t1 = r->x1 * q1 / r->scale;
    r->below = spherical_short_of(r, root, r->t1, q1);
    r->above = r->t0 < 0 ? spherical_short_of(r, root, -r->t0, r->q0) : root + r->t0;
}

static int spherical_rectangle_draw(double *x, double *pdf, const double *u, size_t n,
                                    const buffon_density *g)
{
    spherical_view r;
    spherical_view_make(&r, g->param);
    LEVELS_RUN(spherical_rectangle, (x, u, n, g->param, &r));
    if (pdf)
        density_fill(pdf, spherical_density(g), n);
    return 0;
}

static int spherical_rectangle_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *corner = g->param + SPHERICAL_A, *e1 = g->param + SPHERICAL_B;
    const double *e2 = g->param + SPHERICAL_C;
    double at[4][3], side[4][3];
    for (size_t j = 0; j < 3; j++) {
        at[0][j] = corner[j];
        at[1][j] = corner[j] + e1[j];
        at[2][j] = at[1][j] + e2[j];
        at[3][j] = corner[j] + e2[j];
        side[0][j] = e1[j];
        side[1][j] = e2[j];
        side[2][j] = -e1[j];
        side[3][j] = -e2[j];
    }
    spherical_judge(pdf, x, n, g, at, side, 4);
    return 0;
}

/* The strip up to x, and the part of it up to y; differences as in the map. */
static void spherical_along_unmap(double u[2], double s, double t, const spherical_view *r)
{
    const double root = sqrt(r->delta);
    s = r->mirror[0] ? 1 - s : s;
    t = r->mirror[1] ? 1 - t : t;
    const double x = r->x0 + s * r->width, y = r->y0 + t * r->high;
    const double q = spherical_q(r, root, x), tau = x * q / r->scale;
    double step = tau - r->t0, v;
    if (r->x0 >= 0)
        step = s * r->width * q * r->q0 * (tau * r->q0 + r->t0 * q) /
               (r->scale * (tau + r->t0) * (r->delta - r->sigma * tau * tau * r->t0 * r->t0));
    const double d = x * x + r->z * r->z;
    const double r0 = sqrt(d + r->y0 * r->y0), r1 = sqrt(d + r->y1 * r->y1), ry = sqrt(d + y * y);
    if (r->y0 >= 0)
        v = t * (y + r->y0) * r1 * (r->y1 * r0 + r->y0 * r1) /
            ((r->y1 + r->y0) * ry * (y * r0 + r->y0 * ry));
    else
        v = (y / ry - r->y0 / r0) / (r->y1 / r1 - r->y0 / r0);
    const double share = buffon_priv_atan2pi(step, 1 + tau * r->t0) / r->half;
    u[0] = density_open(r->mirror[0] ? 1 - share : share);
    u[1] = density_open(r->mirror[1] ? 1 - v : v);
}

/* x is along corner + s e1 + t e2, so s = [corner e2 x] / [e2 e1 x], t = [e1 corner x] / the same.
 */
static int spherical_rectangle_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *corner = g->param + SPHERICAL_A, *e1 = g->param + SPHERICAL_B;
    const double *e2 = g->param + SPHERICAL_C;
    double on_s[3], on_t[3], normal[3], unit[3] = {0, 0, 0};
    spherical_view r;
    spherical_view_make(&r, g->param);
    spherical_cross(on_s, corner, e2);
    spherical_cross(on_t, e1, corner);
    spherical_cross(normal, e2, e1);
    frame_unit(unit, corner);
    for (size_t i = 0; i < n; i++) {
        const double point[3] = {x[i], x[n + i], x[2 * n + i]};
        const double d[3] = {point[0] - unit[0], point[1] - unit[1], point[2] - unit[2]};
        const double below = spherical_dot(point, normal);
        double s = spherical_dot(d, on_s) / below, t = spherical_dot(d, on_t) / below, v[2];
        s = s > 1 ? 1 : spherical_positive(s);
        t = t > 1 ? 1 : spherical_positive(t);
        spherical_along_unmap(v, s, t, &r);
        u[i] = v[0];
        u[n + i] = v[1];
    }
    return 0;
}

static const buffon_density_ops spherical_rectangle_ops = {.sample = spherical_rectangle_draw,
                                                           .pdf = spherical_rectangle_pdf,
                                                           .invert = spherical_rectangle_invert,
                                                           .name = "buffon.spherical_rectangle"};

buffon_density buffon_spherical_rectangle(const double from[3], const double corner[3],
                                          const double edge1[3], const double edge2[3])
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = &spherical_rectangle_ops};
    spherical_corners s;
    pair normal[3];
    if (!from || !corner || !edge1 || !edge2) {
        g.status = BUFFON_E_NULL;
        return g;
    }
    spherical_from_edges(&s, from, corner, edge1, edge2);
    spherical_scale(&s, 4);
    pair_cross(normal, s.edge[0], s.edge[1]);
    const double l1 = pair_value(pair_length(s.edge[0]));
    const double l2 = pair_value(pair_length(s.edge[1]));
    const double skew = pair_value(pair_dot(s.edge[0], s.edge[1]));
    double *at = g.param + SPHERICAL_X0;
    g.param[SPHERICAL_HALF] = spherical_quad(&s);
    at[0] = pair_value(pair_dot(s.at[0], s.edge[0])) / l1;
    at[1] = pair_value(pair_dot(s.at[1], s.edge[0])) / l1;
    at[2] = pair_value(pair_dot(s.at[0], s.edge[1])) / l2;
    at[3] = pair_value(pair_dot(s.at[3], s.edge[1])) / l2;
    at[4] = buffon_priv_abs(pair_value(pair_dot(s.at[0], normal))) / (l1 * l2);
    for (size_t j = 0; j < 3; j++) {
        g.param[SPHERICAL_A + j] = pair_value(s.at[0][j]);
        g.param[SPHERICAL_B + j] = pair_value(s.edge[0][j]);
        g.param[SPHERICAL_C + j] = pair_value(s.edge[1][j]);
    }
    if (!(buffon_priv_abs(skew) <= 0x1p-44 * l1 * l2 && at[1] > at[0] && at[3] > at[2] &&
          at[4] >= 0x1p-400 && g.param[SPHERICAL_HALF] >= 0x1p-1000))
        g.status = BUFFON_E_SHAPE;
    return g;
}

void buffon_spherical_rectangle_along(double st[2], double u1, double u2, const double from[3],
                                      const double corner[3], const double edge1[3],
                                      const double edge2[3])
{
    const buffon_density g = buffon_spherical_rectangle(from, corner, edge1, edge2);
    spherical_view r;
    density_fill(st, (double)NAN, 2);
    if (g.status != BUFFON_OK)
        return;
    spherical_view_make(&r, g.param);
    spherical_along_scalar(&st[0], &st[1], u1, u2, &r);
}

/* ---- convex polygon ----
 *
 * A fan of triangles about corner 0: with the pole of each map there, the maps fit together where
 * triangles meet. Triangles are made anew for each batch from the caller's corners. */

typedef struct spherical_fan {
    size_t count;
    double half, start[SPHERICAL_MOST - 1], param[SPHERICAL_MOST - 2][BUFFON_DENSITY_PARAMS];
} spherical_fan;

static buffon_status spherical_fan_make(spherical_fan *f, const double from[3],
                                        const double *corner, size_t count)
{
    f->count = count - 2;
    f->half = 0;
    for (size_t k = 0; k < f->count; k++) {
        double distance[3];
        const buffon_density one =
            spherical_triangle_make(distance, from, corner + 3 * k + 3, corner, corner + 3 * k + 6);
        if (one.status != BUFFON_OK)
            return one.status;
        memcpy(f->param[k], one.param, sizeof one.param);
        f->start[k] = f->half;
        f->half += one.param[SPHERICAL_HALF];
    }
    return BUFFON_OK;
}

/* Corners as unit vectors: of the first triangle corners 1, 0, 2, of the next ones the last. */
static void spherical_fan_walls(spherical_walls *w, const spherical_fan *f)
{
    double corner[SPHERICAL_MOST][3], side[SPHERICAL_MOST][3];
    const size_t count = f->count + 2;
    memcpy(corner[0], f->param[0] + SPHERICAL_B, sizeof corner[0]);
    memcpy(corner[1], f->param[0] + SPHERICAL_A, sizeof corner[1]);
    for (size_t k = 0; k < f->count; k++)
        memcpy(corner[k + 2], f->param[k] + SPHERICAL_C, sizeof corner[0]);
    for (size_t k = 0; k < count; k++)
        for (size_t j = 0; j < 3; j++)
            side[k][j] = corner[(k + 1) % count][j] - corner[k][j];
    spherical_walls_make(w, corner, side, count);
}

static int spherical_polygon_draw(double *x, double *pdf, const double *u, size_t n,
                                  const buffon_density *g)
{
    spherical_fan f;
    if (spherical_fan_make(&f, g->param, g->data[0], (size_t)g->param[3]) != BUFFON_OK)
        return 1;
    for (size_t i = 0; i < n; i++) {
        const double along = u[i] * f.half;
        size_t k = f.count - 1;
        while (k > 0 && along < f.start[k])
            k--;
        const double v[2] = {density_open((along - f.start[k]) / f.param[k][SPHERICAL_HALF]),
                             u[n + i]};
        double point[3];
        spherical_triangle_scalar(point, v, 1, f.param[k]);
        for (size_t j = 0; j < 3; j++)
            x[j * n + i] = point[j];
    }
    if (pdf)
        density_fill(pdf, spherical_density(g), n);
    return 0;
}

static int spherical_polygon_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    spherical_fan f;
    spherical_walls w;
    if (spherical_fan_make(&f, g->param, g->data[0], (size_t)g->param[3]) != BUFFON_OK)
        return 1;
    spherical_fan_walls(&w, &f);
    spherical_weigh(pdf, x, n, g, &w);
    return 0;
}

/* The triangle of x is the last whose first side, from corner 0, x is beyond. */
static int spherical_polygon_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    spherical_fan f;
    spherical_return r[SPHERICAL_MOST - 2];
    if (spherical_fan_make(&f, g->param, g->data[0], (size_t)g->param[3]) != BUFFON_OK)
        return 1;
    for (size_t k = 0; k < f.count; k++)
        spherical_return_make(&r[k], f.param[k]);
    for (size_t i = 0; i < n; i++) {
        const double point[3] = {x[i], x[n + i], x[2 * n + i]};
        const double *pole = f.param[0] + SPHERICAL_B;
        const double d[3] = {point[0] - pole[0], point[1] - pole[1], point[2] - pole[2]};
        double v[2];
        size_t k = f.count - 1;
        while (k > 0 && spherical_dot(d, r[k].on_c) < 0)
            k--;
        spherical_triangle_unmap(v, point, f.param[k], &r[k]);
        u[i] = density_open((f.start[k] + v[0] * f.param[k][SPHERICAL_HALF]) / f.half);
        u[n + i] = v[1];
    }
    return 0;
}

static uint64_t spherical_polygon_identity(uint64_t mix, const buffon_density *g)
{
    return density_mix(mix, g->data[0], 3 * (size_t)g->param[3]);
}

static const buffon_density_ops spherical_polygon_ops = {.sample = spherical_polygon_draw,
                                                         .pdf = spherical_polygon_pdf,
                                                         .invert = spherical_polygon_invert,
                                                         .identity = spherical_polygon_identity,
                                                         .name = "buffon.spherical_polygon"};

/* Convex: all corners are on the inner side of all sides, those next to them strictly. */
static int spherical_is_convex(const spherical_walls *w)
{
    for (size_t k = 0; k < w->count; k++)
        for (size_t i = 2; i < w->count; i++) {
            const double *at = w->corner[(k + i) % w->count];
            const double d[3] = {at[0] - w->corner[k][0], at[1] - w->corner[k][1],
                                 at[2] - w->corner[k][2]};
            if (!(spherical_dot(d, w->normal[k]) > 0))
                return 0;
        }
    return 1;
}

buffon_density buffon_spherical_polygon(const double from[3], const double *corner, size_t count)
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = &spherical_polygon_ops};
    spherical_fan f;
    spherical_walls w;
    if (!from || !corner)
        g.status = BUFFON_E_NULL;
    else if (count < 3 || count > SPHERICAL_MOST)
        g.status = BUFFON_E_DIM;
    else
        g.status = spherical_fan_make(&f, from, corner, count);
    if (g.status != BUFFON_OK)
        return g;
    spherical_fan_walls(&w, &f);
    if (!spherical_is_convex(&w) || !(f.half < 1))
        g.status = BUFFON_E_SHAPE;
    for (size_t j = 0; j < 3; j++)
        g.param[j] = from[j];
    g.param[3] = (double)count;
    g.param[SPHERICAL_HALF] = f.half;
    g.data[0] = corner;
    return g;
}
