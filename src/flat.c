#include "guard.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <buffon/math.h>

#include "density_priv.h"
#include "flat.h"
#include "frame.h"

#define KERNELS "flat_lanes.h"
#include "levels.h"

/* Coordinates of vertices are at most this, and the longest edge at least the inverse. */
#define FLAT_LIMIT 0x1p+1000

/* ---- constructor ---- */

/* The length, area or volume that the edges span. */
static pair flat_measure(pair (*edge)[3], size_t edges)
{
    pair normal[3];
    if (edges == 1)
        return pair_length(edge[0]);
    pair_cross(normal, edge[0], edge[1]);
    if (edges == 2)
        return pair_length(normal);
    const pair volume = pair_dot(normal, edge[2]);
    return volume.hi < 0 ? pair_negate(volume) : volume;
}

/* The largest coordinate of an edge; NaN if one is not finite. */
static double flat_most(const double *x, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) {
        const double size = buffon_priv_abs(x[k]);
        if (!buffon_priv_isfinite(size))
            return (double)NAN;
        most = size > most ? size : most;
    }
    return most;
}

/* The edges are differences of vertices with all their digits, and so is what they span: a needle,
 * or a small piece far from the origin, has an area as exact as its vertices. */
void buffon_priv_flat_make(buffon_density *g, flat_kind kind, const double origin[3],
                           pair (*edge)[3])
{
    static const double parts[4] = {1, 1, 2, 6};
    const size_t edges = g->uniforms;
    double *e = g->param + FLAT_EDGES;
    for (size_t j = 0; j < 3; j++)
        g->param[j] = origin[j];
    for (size_t k = 0; k < 3 * edges; k++)
        e[k] = edge[k / 3][k % 3].hi;
    const double start = flat_most(origin, 3), most = flat_most(e, 3 * edges);
    g->status = BUFFON_E_SHAPE;
    if (!(start <= FLAT_LIMIT && most <= FLAT_LIMIT && most >= 1 / FLAT_LIMIT))
        return;
    int exponent;
    buffon_priv_frexp(&exponent, most);
    for (size_t k = 0; k < 3 * edges; k++)
        edge[k / 3][k % 3] = pair_scale(edge[k / 3][k % 3], buffon_priv_ldexp(1, -exponent));
    const double measure = pair_value(flat_measure(edge, edges));
    const double whole = kind == FLAT_SIMPLEX ? parts[edges] : 1;
    const double density = buffon_priv_ldexp(whole / measure, -exponent * (int)edges);
    if (!(measure > 0 && density >= DBL_MIN && density <= 1 / DBL_MIN))
        return;
    g->param[FLAT_DENSITY] = density;
    g->param[FLAT_SLACK] = 0x1p-49 * (start + (double)edges * most);
    g->status = BUFFON_OK;
}

/* ---- walls ---- */

/* A piece as the meeting of half-spaces offset + (x - origin) . normal >= 0. The first `edges` of
 * them hold the origin: wall k is opposite to the end of edge k, which is at `height` above it. */
typedef struct flat_walls {
    size_t count;
    double normal[6][3], offset[6], height[3];
} flat_walls;

static void flat_wall(flat_walls *w, const double normal[3], double sign, double offset)
{
    for (size_t j = 0; j < 3; j++)
        w->normal[w->count][j] = sign * normal[j];
    w->offset[w->count++] = offset;
}

/* The unit vector across two vectors; returns the length of the product. */
static double flat_across(double out[3], const pair a[3], const pair b[3])
{
    pair product[3];
    double v[3];
    pair_cross(product, a, b);
    for (size_t j = 0; j < 3; j++)
        v[j] = pair_value(product[j]);
    return frame_unit(out, v);
}

static void flat_widen(pair out[3], const double v[3])
{
    for (size_t j = 0; j < 3; j++)
        out[j] = pair_of(v[j]);
}

static void flat_walls_line(flat_walls *w, const double e[3])
{
    double unit[3] = {0, 0, 1}, frame[FRAME_SIZE];
    const double length = frame_unit(unit, e);
    frame_make(frame, unit);
    w->height[0] = length;
    flat_wall(w, unit, 1, 0);
    flat_wall(w, unit, -1, length);
    for (size_t k = 0; k < 2; k++) {
        flat_wall(w, frame + 3 * k, 1, 0);
        flat_wall(w, frame + 3 * k, -1, 0);
    }
}

/* With n the normal of the plane, e2 x n and n x e1 point to the ends of e1 and e2, and
 * n x (e2 - e1) points to the origin. */
static void flat_walls_plane(flat_walls *w, pair (*e)[3], size_t dim, flat_kind kind)
{
    double n[3] = {0, 0, 0}, v[3] = {0, 0, 0};
    pair normal[3], third[3];
    const double area = flat_across(n, e[0], e[1]);
    flat_widen(normal, n);
    w->height[0] = area / flat_across(v, e[1], normal);
    flat_wall(w, v, 1, 0);
    w->height[1] = area / flat_across(v, normal, e[0]);
    flat_wall(w, v, 1, 0);
    if (kind == FLAT_SIMPLEX) {
        for (size_t j = 0; j < 3; j++)
            third[j] = pair_subtract(e[1][j], e[0][j]);
        const double base = flat_across(v, normal, third);
        flat_wall(w, v, 1, area / base);
    }
    if (dim == 3) {
        flat_wall(w, n, 1, 0);
        flat_wall(w, n, -1, 0);
    }
}

static void flat_walls_space(flat_walls *w, pair (*e)[3], flat_kind kind)
{
    const double volume = pair_value(flat_measure(e, 3));
    pair normal[3];
    double v[3];
    pair_cross(normal, e[0], e[1]);
    const double sign = pair_value(pair_dot(normal, e[2])) < 0 ? -1 : 1;
    for (size_t k = 0; k < 3; k++) {
        w->height[k] = volume / flat_across(v, e[(k + 1) % 3], e[(k + 2) % 3]);
        flat_wall(w, v, sign, 0);
    }
    if (kind == FLAT_SIMPLEX) {
        pair side[2][3];
        for (size_t j = 0; j < 6; j++)
            side[j / 3][j % 3] = pair_subtract(e[1 + j / 3][j % 3], e[0][j % 3]);
        const double area = flat_across(v, side[0], side[1]);
        flat_wall(w, v, -sign, volume / area);
    }
}

/* From the edges of `param`, brought near 1 so that products keep their digits; offsets and heights
 * are brought back. */
static void flat_walls_make(flat_walls *w, const buffon_density *g, flat_kind kind)
{
    const size_t edges = g->uniforms;
    const double *e = g->param + FLAT_EDGES;
    double scaled[9] = {0};
    pair edge[3][3];
    int exponent;
    buffon_priv_frexp(&exponent, flat_most(e, 3 * edges));
    for (size_t k = 0; k < 3 * edges; k++)
        scaled[k] = e[k] * buffon_priv_ldexp(1, -exponent);
    for (size_t k = 0; k < 3; k++)
        flat_widen(edge[k], scaled + 3 * k);
    memset(w, 0, sizeof *w);
    if (edges == 1)
        flat_walls_line(w, scaled);
    else if (edges == 2)
        flat_walls_plane(w, edge, g->dim, kind);
    else
        flat_walls_space(w, edge, kind);
    if (kind == FLAT_BOX)
        for (size_t k = 0; k < edges; k++)
            flat_wall(w, w->normal[k], -1, w->height[k]);
    for (size_t k = 0; k < w->count; k++)
        w->offset[k] = buffon_priv_ldexp(w->offset[k], exponent);
    for (size_t k = 0; k < edges; k++)
        w->height[k] = buffon_priv_ldexp(w->height[k], exponent);
}

/* ---- operations ---- */

int buffon_priv_flat_draw(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g, flat_kind kind)
{
    LEVELS_RUN(flat_map, (x, u, n, g->param, g->dim, g->uniforms, kind));
    if (pdf)
        density_fill(pdf, g->param[FLAT_DENSITY], n);
    return 0;
}

/* Where x lies from the origin; no third coordinate in the plane. */
static void flat_from(double d[3], const double *x, size_t n, const buffon_density *g)
{
    for (size_t j = 0; j < 3; j++)
        d[j] = j < g->dim ? x[j * n] - g->param[j] : 0;
}

static double flat_above(const flat_walls *w, size_t k, const double d[3])
{
    const double *normal = w->normal[k];
    return w->offset[k] + (d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2]);
}

int buffon_priv_flat_pdf(double *pdf, const double *x, size_t n, const buffon_density *g,
                         flat_kind kind)
{
    flat_walls w;
    flat_walls_make(&w, g, kind);
    for (size_t i = 0; i < n; i++) {
        double d[3];
        int in = 1;
        flat_from(d, x + i, n, g);
        for (size_t k = 0; k < w.count; k++)
            in &= flat_above(&w, k, d) >= -g->param[FLAT_SLACK];
        pdf[i] = in ? g->param[FLAT_DENSITY] : 0;
    }
    return 0;
}

int buffon_priv_flat_invert(double *u, const double *x, size_t n, const buffon_density *g,
                            flat_kind kind)
{
    const size_t edges = g->uniforms;
    flat_walls w;
    flat_walls_make(&w, g, kind);
    for (size_t i = 0; i < n; i++) {
        double d[3], weight[3], v[3];
        flat_from(d, x + i, n, g);
        for (size_t k = 0; k < edges; k++)
            weight[k] = flat_above(&w, k, d) / w.height[k];
        if (kind == FLAT_SIMPLEX)
            buffon_priv_flat_uniforms(v, weight, 1, edges);
        for (size_t k = 0; k < edges; k++)
            u[k * n + i] = density_open(kind == FLAT_SIMPLEX ? v[k] : weight[k]);
    }
    return 0;
}

/* ---- the standard simplex ---- */

/* The first tails by t = exp(log(u) / k), the last three by roots. The tail is kept where the last
 * coordinate will be, and t where the next one will. */
void buffon_priv_flat_weights(double *w, const double *u, size_t n, size_t dim)
{
    const size_t last = dim < 3 ? dim : 3, first = dim - last;
    double *tail = w + (dim - 1) * n;
    for (size_t j = 0; j < first; j++) {
        double *t = j == 0 ? tail : w + j * n, *y = j == 0 ? tail : w + (j - 1) * n;
        buffon_math_log(y, u + j * n, n);
        for (size_t i = 0; i < n; i++)
            y[i] /= (double)(dim - j);
        buffon_math_exp(t, y, n);
        if (j == 0)
            continue;
        buffon_math_expm1(y, y, n);
        for (size_t i = 0; i < n; i++) {
            y[i] *= -tail[i];
            tail[i] *= t[i];
        }
    }
    LEVELS_RUN(flat_last, (w + first * n, u + first * n, n, last, first > 0 ? tail : NULL));
}

/* t^k for t in [0, 1]. */
static double flat_power(double t, size_t k)
{
    double power = 1;
    for (size_t bit = 1; bit <= k; bit <<= 1, t *= t)
        power *= k & bit ? t : 1;
    return power;
}

/* Tails are sums of positive numbers, so their ratios are right to the last digits. */
void buffon_priv_flat_uniforms(double *u, const double *w, size_t stride, size_t dim)
{
    double tail = 0;
    for (size_t j = dim; j-- > 0;) {
        const double before = tail;
        tail += w[j * stride] > 0 ? w[j * stride] : 0;
        if (j + 1 < dim)
            u[(j + 1) * stride] =
                density_inside(flat_power(tail > 0 ? before / tail : 0.5, dim - j - 1));
    }
    u[0] = density_inside(flat_power(tail < 1 ? tail : 1, dim));
}
