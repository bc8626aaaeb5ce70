#include "guard.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <buffon/mixture.h>

#include "density_priv.h"
#include "elementary.h"

/* A mixture keeps its parts as data[0] and their weights as data[1]. `param`: the greatest weight,
 * the sum of weights in units of it, the number of parts, and that of the last one with a weight.
 *
 * A tile of points is drawn part by part: those of a part are gathered, drawn side by side and put
 * back. */
enum { MIXTURE_MOST, MIXTURE_SUM, MIXTURE_COUNT, MIXTURE_LAST };
enum { MIXTURE_TILE = 1024, MIXTURE_WIDEST = 200, MIXTURE_POINTS = 256 };

static size_t mixture_count(const buffon_density *g)
{
    return (size_t)g->param[MIXTURE_COUNT];
}

/* The share of a part. */
static double mixture_share(const buffon_density *g, size_t k)
{
    const double *weights = g->data[1];
    return weights[k] / g->param[MIXTURE_MOST] / g->param[MIXTURE_SUM];
}

/* How many points a tile holds if each takes so many numbers. */
static size_t mixture_points(size_t each)
{
    const size_t points = MIXTURE_TILE / each;
    return points < MIXTURE_POINTS ? points : MIXTURE_POINTS;
}

/* u of the whole, from the part that begins at `from`, as a uniform of the part. A u at the very
 * edge stands for the half of a step of 2^-53 above it. */
static double mixture_stretch(double u, double from, double share)
{
    const double half = 0x1p-54 / share;
    const double least = from > 0 ? (half < 0.5 ? half : 0.5) : 0x1p-1074;
    return density_held((u - from) / share, least, 1 - 0x1p-53);
}

/* The points of one tile. own[i] is the part's pdf at its point, which[i] the part. */
static int mixture_draw(double *x, double *own, size_t *which, const double *u, size_t n, size_t at,
                        size_t m, const buffon_density *g)
{
    const buffon_density *parts = g->data[0];
    const double *weights = g->data[1];
    const size_t count = mixture_count(g), last = (size_t)g->param[MIXTURE_LAST];
    double tile[MIXTURE_TILE], sum = 0, from = 0;
    for (size_t k = 0; k < count && k <= last; k++) {
        const buffon_density *part = &parts[k];
        size_t index[MIXTURE_POINTS], taken = 0;
        sum += weights[k] / g->param[MIXTURE_MOST];
        const double to = k == last ? 1 : sum / g->param[MIXTURE_SUM];
        for (size_t i = 0; i < m; i++) {
            index[taken] = i;
            taken += (u[at + i] >= from) & (u[at + i] < to) & (weights[k] > 0);
        }
        double *point = tile + part->uniforms * taken, *pdf = point + part->dim * taken;
        for (size_t t = 0; t < taken; t++) {
            const double *place = u + at + index[t];
            tile[t] = mixture_stretch(*place, from, to - from);
            for (size_t j = 1; j < part->uniforms; j++)
                tile[j * taken + t] = place[j * n];
            which[index[t]] = k;
        }
        const buffon_status status =
            buffon_density_sample(point, own ? pdf : NULL, tile, taken, part);
        if (status != BUFFON_OK)
            return status;
        for (size_t t = 0; t < taken; t++) {
            for (size_t j = 0; j < part->dim; j++)
                x[j * n + at + index[t]] = point[j * taken + t];
            if (own)
                own[index[t]] = pdf[t];
        }
        from = to;
    }
    return 0;
}

/* Copies the coordinates of m points from `at` on out of n. */
static void mixture_copy(double *tile, const double *x, size_t n, size_t at, size_t m, size_t dim)
{
    for (size_t j = 0; j < dim; j++)
        memcpy(tile + j * m, x + j * n + at, m * sizeof *tile);
}

/* The sum of the parts' pdfs at m points; of the part that a point is of, if that is known, the pdf
 * that came with it. */
static int mixture_sum(double *pdf, const double *tile, size_t m, const double *own,
                       const size_t *which, const buffon_density *g)
{
    const buffon_density *parts = g->data[0];
    double one[MIXTURE_POINTS];
    density_fill(pdf, 0, m);
    for (size_t k = 0; k < mixture_count(g); k++) {
        const double share = mixture_share(g, k);
        if (!(share > 0))
            continue;
        const buffon_status status = buffon_density_pdf(one, tile, m, &parts[k]);
        if (status != BUFFON_OK)
            return status;
        for (size_t i = 0; i < m; i++)
            pdf[i] += share * (own && which[i] == k ? own[i] : one[i]);
    }
    return 0;
}

static int mixture_sample(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    const size_t points = mixture_points(g->uniforms + g->dim + 1);
    double own[MIXTURE_POINTS], tile[MIXTURE_TILE];
    size_t which[MIXTURE_POINTS];
    for (size_t at = 0; at < n; at += points) {
        const size_t m = n - at < points ? n - at : points;
        int result = mixture_draw(x, pdf ? own : NULL, which, u, n, at, m, g);
        if (pdf && result == 0) {
            mixture_copy(tile, x, n, at, m, g->dim);
            result = mixture_sum(pdf + at, tile, m, own, which, g);
        }
        if (result != 0)
            return result;
    }
    return 0;
}

static int mixture_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const size_t points = mixture_points(g->dim);
    double tile[MIXTURE_TILE];
    for (size_t at = 0; at < n; at += points) {
        const size_t m = n - at < points ? n - at : points;
        mixture_copy(tile, x, n, at, m, g->dim);
        const int result = mixture_sum(pdf + at, tile, m, NULL, NULL, g);
        if (result != 0)
            return result;
    }
    return 0;
}

/* log(exp(a) + exp(b)). */
static double mixture_log_add(double a, double b)
{
    const double most = a > b ? a : b, least = a > b ? b : a;
    if (!(least > -(double)INFINITY) || most > DBL_MAX)
        return most;
    return most + buffon_priv_log1p(buffon_priv_exp(least - most));
}

static int mixture_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const buffon_density *parts = g->data[0];
    const size_t points = mixture_points(g->dim);
    double tile[MIXTURE_TILE], one[MIXTURE_POINTS];
    density_fill(log_pdf, -(double)INFINITY, n);
    for (size_t at = 0; at < n; at += points) {
        const size_t m = n - at < points ? n - at : points;
        mixture_copy(tile, x, n, at, m, g->dim);
        for (size_t k = 0; k < mixture_count(g); k++) {
            const double share = mixture_share(g, k), log_share = buffon_priv_log(share);
            if (!(share > 0))
                continue;
            const buffon_status status = buffon_density_log_pdf(one, tile, m, &parts[k]);
            if (status != BUFFON_OK)
                return status;
            for (size_t i = 0; i < m; i++)
                log_pdf[at + i] = mixture_log_add(log_pdf[at + i], log_share + one[i]);
        }
    }
    return 0;
}

static uint64_t mixture_identity(uint64_t mix, const buffon_density *g)
{
    const buffon_density *parts = g->data[0];
    mix = density_mix(mix, g->data[1], mixture_count(g));
    for (size_t k = 0; k < mixture_count(g); k++)
        mix = buffon_priv_density_identity(mix, &parts[k]);
    return mix;
}

static const buffon_density_ops mixture_ops = {.sample = mixture_sample,
                                               .pdf = mixture_pdf,
                                               .log_pdf = mixture_log_pdf,
                                               .identity = mixture_identity,
                                               .name = "buffon.mixture"};

/* Of parts some of which have no pdf. */
static const buffon_density_ops mixture_blind_ops = {
    .sample = mixture_sample, .identity = mixture_identity, .name = "buffon.mixture"};

/* The greatest weight, their sum in units of it, and the last that is not 0. */
static buffon_status mixture_weigh(buffon_density *g, const double *weights, size_t count)
{
    double most = 0, sum = 0;
    for (size_t k = 0; k < count; k++) {
        if (!(weights[k] >= 0 && weights[k] <= DBL_MAX))
            return BUFFON_E_SHAPE;
        most = weights[k] > most ? weights[k] : most;
        if (weights[k] > 0)
            g->param[MIXTURE_LAST] = (double)k;
    }
    if (!(most > 0))
        return BUFFON_E_SHAPE;
    for (size_t k = 0; k < count; k++)
        sum += weights[k] / most;
    g->param[MIXTURE_MOST] = most;
    g->param[MIXTURE_SUM] = sum;
    g->param[MIXTURE_COUNT] = (double)count;
    return BUFFON_OK;
}

buffon_density buffon_mixture(const buffon_density *parts, const double *weights, size_t count)
{
    buffon_density g = {.ops = &mixture_ops, .data = {parts, weights}};
    if (!parts || !weights || !count) {
        g.status = BUFFON_E_NULL;
        return g;
    }
    for (size_t k = 0; k < count && g.status == BUFFON_OK; k++) {
        g.status = buffon_density_check(&parts[k]);
        if (g.status != BUFFON_OK)
            return g;
        if (parts[k].dim != parts[0].dim || parts[k].dim > MIXTURE_WIDEST ||
            parts[k].uniforms > MIXTURE_WIDEST - parts[k].dim)
            g.status = BUFFON_E_DIM;
        g.uniforms = parts[k].uniforms > g.uniforms ? parts[k].uniforms : g.uniforms;
        if (!buffon_priv_density_has_pdf(&parts[k]))
            g.ops = &mixture_blind_ops;
    }
    g.dim = parts[0].dim;
    if (g.status == BUFFON_OK)
        g.status = mixture_weigh(&g, weights, count);
    return g;
}
