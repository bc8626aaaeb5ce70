#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/truncated.h>

#include "density_priv.h"
#include "elementary.h"

/* `param`: lo, hi, the uniforms of both and the distance of these, which is negative where x falls
 * with u. The whole is data[0]. */
enum { RESTRICTED_LO, RESTRICTED_HI, RESTRICTED_FROM, RESTRICTED_TO, RESTRICTED_SPAN };

enum { RESTRICTED_TILE = 256 };

/* The uniform of the whole. */
static double restricted_stretch(double u, const double *p)
{
    const double least = p[RESTRICTED_SPAN] > 0 ? p[RESTRICTED_FROM] : p[RESTRICTED_TO];
    const double most = p[RESTRICTED_SPAN] > 0 ? p[RESTRICTED_TO] : p[RESTRICTED_FROM];
    return density_held(p[RESTRICTED_FROM] + u * p[RESTRICTED_SPAN], least, most);
}

static int restricted_sample(double *x, double *pdf, const double *u, size_t n,
                             const buffon_density *g)
{
    const double *p = g->param, mass = buffon_priv_abs(p[RESTRICTED_SPAN]);
    double v[RESTRICTED_TILE], least, most;
    density_inner(&least, &most, p[RESTRICTED_LO], p[RESTRICTED_HI]);
    for (size_t at = 0; at < n; at += RESTRICTED_TILE) {
        const size_t m = n - at < RESTRICTED_TILE ? n - at : RESTRICTED_TILE;
        for (size_t i = 0; i < m; i++)
            v[i] = restricted_stretch(u[at + i], p);
        const buffon_status status =
            buffon_density_sample(x + at, pdf ? pdf + at : NULL, v, m, g->data[0]);
        if (status != BUFFON_OK)
            return status;
        for (size_t i = at; i < at + m; i++)
            x[i] = density_held(x[i], least, most);
        for (size_t i = at; pdf && i < at + m; i++)
            pdf[i] /= mass;
    }
    return 0;
}

static int restricted_holds(double x, const double *p)
{
    return x >= p[RESTRICTED_LO] && x <= p[RESTRICTED_HI];
}

static int restricted_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double mass = buffon_priv_abs(g->param[RESTRICTED_SPAN]);
    const buffon_status status = buffon_density_pdf(pdf, x, n, g->data[0]);
    for (size_t i = 0; i < n && status == BUFFON_OK; i++)
        pdf[i] = restricted_holds(x[i], g->param) ? pdf[i] / mass : 0;
    return status;
}

static int restricted_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double log_mass = buffon_priv_log(buffon_priv_abs(g->param[RESTRICTED_SPAN]));
    const buffon_status status = buffon_density_log_pdf(log_pdf, x, n, g->data[0]);
    for (size_t i = 0; i < n && status == BUFFON_OK; i++)
        log_pdf[i] = restricted_holds(x[i], g->param) ? log_pdf[i] - log_mass : -(double)INFINITY;
    return status;
}

static int restricted_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param;
    const buffon_status status = buffon_density_invert(u, x, n, g->data[0]);
    for (size_t i = 0; i < n && status == BUFFON_OK; i++)
        u[i] = density_inside((u[i] - p[RESTRICTED_FROM]) / p[RESTRICTED_SPAN]);
    return status;
}

static uint64_t restricted_identity(uint64_t mix, const buffon_density *g)
{
    return buffon_priv_density_identity(mix, g->data[0]);
}

static const buffon_density_ops restricted_ops = {.sample = restricted_sample,
                                                  .pdf = restricted_pdf,
                                                  .log_pdf = restricted_log_pdf,
                                                  .invert = restricted_invert,
                                                  .identity = restricted_identity,
                                                  .name = "buffon.truncated"};

static const buffon_density_ops restricted_blind_ops = {.sample = restricted_sample,
                                                        .invert = restricted_invert,
                                                        .identity = restricted_identity,
                                                        .name = "buffon.truncated"};

/* The uniform of a bound; of an infinite one that of the tail's end, on the side of the other. */
static buffon_status restricted_level(double *u, double x, const buffon_density *g)
{
    const double finite = density_held(x, -DBL_MAX, DBL_MAX);
    return buffon_density_invert(u, &finite, 1, g);
}

static buffon_status restricted_check(const buffon_density *g, double lo, double hi)
{
    const buffon_status status = buffon_density_check(g);
    if (status != BUFFON_OK)
        return status;
    if (g->dim != 1 || g->uniforms != 1)
        return BUFFON_E_DIM;
    if (!g->ops->invert)
        return BUFFON_E_UNSUPPORTED;
    return lo < hi ? BUFFON_OK : BUFFON_E_DOMAIN;
}

buffon_density buffon_truncated(const buffon_density *whole, double lo, double hi)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &restricted_ops, .data = {whole, NULL}};
    double from, to;
    g.status = restricted_check(whole, lo, hi);
    if (g.status == BUFFON_OK)
        g.status = restricted_level(&from, lo, whole);
    if (g.status == BUFFON_OK)
        g.status = restricted_level(&to, hi, whole);
    if (g.status != BUFFON_OK)
        return g;
    const double most = from > to ? from : to, span = to - from;
    if (!(buffon_priv_abs(span) >= 0x1p-33 * most))
        g.status = BUFFON_E_DOMAIN;
    if (!buffon_priv_density_has_pdf(whole))
        g.ops = &restricted_blind_ops;
    g.param[RESTRICTED_LO] = lo;
    g.param[RESTRICTED_HI] = hi;
    g.param[RESTRICTED_FROM] = from;
    g.param[RESTRICTED_TO] = to;
    g.param[RESTRICTED_SPAN] = span;
    return g;
}
