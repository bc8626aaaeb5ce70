#include "guard.h"

#include "box.h"

#include <math.h>
#include <string.h>

#include <buffon/box.h>

#include "density_priv.h"
#include "elementary.h"

/* Boxes of so many dimensions keep their bounds in `param`, larger ones in the caller's arrays. */
#define BOX_COPIED (BUFFON_DENSITY_PARAMS / 2)

static const double *box_lo(const buffon_density *g)
{
    return g->data[0] ? (const double *)g->data[0] : g->param;
}

static const double *box_hi(const buffon_density *g)
{
    return g->data[1] ? (const double *)g->data[1] : g->param + BOX_COPIED;
}

#define KERNELS "box_lanes.h"
#include "levels.h"

/* Rounding may lead lo + u (hi - lo) to lo or to hi, so it is held between their neighbours, as far
 * as there are any. Where hi - lo overflows, so does neither product of the other form. */
static void box_line(double *x, const double *u, size_t n, double lo, double hi)
{
    if (x == u && lo == 0 && hi == 1)
        return; /* what is in (0, 1) is between the neighbours of 0 and 1 */
    const double width = hi - lo, up = buffon_priv_nextup(lo), down = buffon_priv_nextdown(hi);
    const double least = up < hi ? up : lo, most = up < hi ? down : hi;
    if (buffon_priv_isfinite(width))
        LEVELS_RUN(box_map, (x, u, n, lo, width, least, most));
    else
        for (size_t i = 0; i < n; i++) {
            const double v = lo * (1 - u[i]) + hi * u[i];
            const double w = v < least ? least : v;
            x[i] = w > most ? most : w;
        }
}

void buffon_priv_box_volume(double *m, int *e, const double *lo, const double *hi, size_t dim)
{
    const int64_t bound = 1 << 26; /* beyond all doubles; squares may double it twice */
    double mantissa = 1;
    int64_t exponent = 0;
    for (size_t j = 0; j < dim; j++) {
        const double width = hi[j] - lo[j];
        const int wide = !buffon_priv_isfinite(width);
        int k, l;
        mantissa *= buffon_priv_frexp(&k, wide ? 0.5 * hi[j] - 0.5 * lo[j] : width);
        mantissa = buffon_priv_frexp(&l, mantissa);
        exponent += k + l + wide;
    }
    if (dim == 0) {
        mantissa = 0.5;
        exponent = 1;
    }
    *m = mantissa;
    *e = (int)(exponent > bound ? bound : exponent < -bound ? -bound : exponent);
}

static double box_density(const buffon_density *g)
{
    double m;
    int e;
    buffon_priv_box_volume(&m, &e, box_lo(g), box_hi(g), g->dim);
    return buffon_priv_ldexp(1 / m, -e);
}

/* -log(m 2^e), with m brought to the middle of 1 so that volumes near 1 lose nothing. */
static double box_log_density(const buffon_density *g)
{
    const double log_2 = 0x1.62e42fefa39efp-1;
    double m;
    int e;
    buffon_priv_box_volume(&m, &e, box_lo(g), box_hi(g), g->dim);
    if (m < 0x1.6a09e667f3bcdp-1) {
        m *= 2;
        e--;
    }
    return 0 - (e * log_2 + buffon_priv_log(m));
}

static int box_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *lo = box_lo(g), *hi = box_hi(g);
    for (size_t j = 0; j < g->dim; j++)
        box_line(x + j * n, u + j * n, n, lo[j], hi[j]);
    if (pdf)
        density_fill(pdf, box_density(g), n);
    return 0;
}

/* `inside` at the points of the closed box, `outside` elsewhere. */
static void box_judge(double *out, const double *x, size_t n, const buffon_density *g,
                      double inside, double outside)
{
    const double *lo = box_lo(g), *hi = box_hi(g);
    density_fill(out, inside, n);
    for (size_t j = 0; j < g->dim; j++)
        for (size_t i = 0; i < n; i++) {
            const int in = (x[j * n + i] >= lo[j]) & (x[j * n + i] <= hi[j]);
            out[i] = in ? out[i] : outside;
        }
}

static int box_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    box_judge(pdf, x, n, g, box_density(g), 0);
    return 0;
}

static int box_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    box_judge(log_pdf, x, n, g, box_log_density(g), -(double)INFINITY);
    return 0;
}

static int box_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *lo = box_lo(g), *hi = box_hi(g);
    for (size_t j = 0; j < g->dim; j++) {
        const double scale = buffon_priv_isfinite(hi[j] - lo[j]) ? 1 : 0.5;
        const double width = scale * hi[j] - scale * lo[j];
        for (size_t i = 0; i < n; i++)
            u[j * n + i] = density_open((scale * x[j * n + i] - scale * lo[j]) / width);
    }
    return 0;
}

static uint64_t box_identity(uint64_t mix, const buffon_density *g)
{
    if (!g->data[0])
        return mix;
    mix = density_mix(mix, g->data[0], g->dim);
    return density_mix(mix, g->data[1], g->dim);
}

static const buffon_density_ops box_ops = {.sample = box_draw,
                                           .pdf = box_pdf,
                                           .log_pdf = box_log_pdf,
                                           .invert = box_invert,
                                           .identity = box_identity,
                                           .name = "buffon.box"};

int buffon_priv_box_is(const buffon_density *g)
{
    return g->ops == &box_ops;
}

static buffon_status box_check(const double *lo, const double *hi, size_t dim)
{
    if (!lo || !hi)
        return BUFFON_E_NULL;
    if (dim == 0 || dim > UINT32_MAX)
        return BUFFON_E_DIM;
    for (size_t j = 0; j < dim; j++)
        if (!buffon_priv_isfinite(lo[j]) || !buffon_priv_isfinite(hi[j]) || !(lo[j] < hi[j]))
            return BUFFON_E_DOMAIN;
    return BUFFON_OK;
}

buffon_density buffon_box(const double *lo, const double *hi, size_t dim)
{
    buffon_density g = {
        .uniforms = dim, .dim = dim, .status = box_check(lo, hi, dim), .ops = &box_ops};
    if (g.status != BUFFON_OK)
        return g;
    if (dim <= BOX_COPIED) {
        memcpy(g.param, lo, dim * sizeof *lo);
        memcpy(g.param + BOX_COPIED, hi, dim * sizeof *hi);
    } else {
        g.data[0] = lo;
        g.data[1] = hi;
    }
    return g;
}

buffon_density buffon_segment(double lo, double hi)
{
    return buffon_box(&lo, &hi, 1);
}

double buffon_segment_sample(double u, double lo, double hi)
{
    buffon_box_sample(&u, &u, &lo, &hi, 1);
    return u;
}

void buffon_box_sample(double *x, const double *u, const double *lo, const double *hi, size_t dim)
{
    const int bad = box_check(lo, hi, dim) != BUFFON_OK;
    for (size_t j = 0; j < dim; j++)
        if (bad)
            x[j] = (double)NAN;
        else
            box_line(x + j, u + j, 1, lo[j], hi[j]);
}
