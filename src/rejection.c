#include "guard.h"

#include <math.h>
#include <stdlib.h>

#include <buffon/box.h>
#include <buffon/rejection.h>

#include "box.h"
#include "density_priv.h"
#include "engine.h"
#include "options.h"

#define KERNELS "rejection_lanes.h"
#include "levels.h"

/* y = 1 where the point (x, v height) is under the curve. A value that is not finite is passed on.
 */
static buffon_status rejection_weigh(double *y, size_t *bad, const buffon_priv_batch *batch,
                                     const buffon_priv_problem *problem)
{
    const buffon_integrand *f = problem->stratum[0].f;
    const size_t n = batch->n, components = f->components > 0 ? f->components : 1;
    const double height = problem->param;
    /* v height must not be rounded to a few subnormal steps. */
    const double scale = height < 0x1p-900 ? 0x1p900 : 1;
    size_t lowest = n;
    for (size_t k = 0; k < components; k++) {
        int fits;
        LEVELS_RUN(rejection_hits,
                   (&fits, y + k * n, batch->f + k * n, batch->extra, n, height, scale));
        for (size_t i = 0; !fits && i < n; i++) {
            const double value = batch->f[k * n + i];
            if (value >= 0 && value <= height)
                continue;
            if (value - value != 0)
                y[k * n + i] = NAN;
            else if (i < lowest)
                lowest = i;
        }
    }
    *bad = lowest;
    return lowest < n ? BUFFON_E_BOUND : BUFFON_OK;
}

buffon_status buffon_rejection(buffon_estimate *out, const buffon_integrand *f, const double *lo,
                               const double *hi, double height, const buffon_run *run)
{
    const buffon_density box = buffon_box(lo, hi, f != NULL ? f->dim : 1);
    const buffon_priv_stratum stratum = {.g = &box, .f = f, .weight = 1, .share = 1};
    buffon_priv_problem problem = {.name = "buffon.rejection",
                                   .stratum = &stratum,
                                   .strata = 1,
                                   .extra = 1,
                                   .kind = BUFFON_PRIV_HITS,
                                   .scale_m = 1,
                                   .param = height,
                                   .weigh = rejection_weigh};
    if (!(height > 0 && height < INFINITY))
        return buffon_priv_refuse(out, f, BUFFON_E_HEIGHT);
    if (box.status == BUFFON_OK) {
        const double zero = 0;
        double m;
        int e;
        buffon_priv_box_volume(&problem.scale_m, &problem.scale_e, lo, hi, box.dim);
        buffon_priv_box_volume(&m, &e, &zero, &height, 1);
        problem.scale_m *= m;
        problem.scale_e += e;
    }
    return buffon_priv_engine_run(out, &problem, run);
}

/* ---- the sampler ---- */

#define REJECTION_TILE 256

/* Candidates are drawn by the tile, and a tile costs its words whether all of it is needed or not;
 * so a tile is no longer than what is still wanted. */
typedef struct rejection_tile {
    double *memory;
    double *u, *x, *pdf, *f, *row, *v;
} rejection_tile;

static buffon_status rejection_tile_make(rejection_tile *tile, const buffon_density *g)
{
    const size_t most = SIZE_MAX / sizeof(double) / 8 / REJECTION_TILE;
    if (g->uniforms > most || g->dim > most)
        return BUFFON_E_NOMEM;
    const size_t words = REJECTION_TILE * (g->uniforms + g->dim + 3) + g->dim + g->uniforms + 1;
    tile->memory = malloc(words * sizeof(double));
    if (tile->memory == NULL)
        return BUFFON_E_NOMEM;
    tile->u = tile->memory;
    tile->x = tile->u + REJECTION_TILE * g->uniforms;
    tile->pdf = tile->x + REJECTION_TILE * g->dim;
    tile->f = tile->pdf + REJECTION_TILE;
    tile->v = tile->f + REJECTION_TILE;
    tile->row = tile->v + REJECTION_TILE;
    return BUFFON_OK;
}

/* n candidates with f and g; each takes its uniforms from the generator in turn, then one more. */
static buffon_status rejection_candidates(rejection_tile *tile, size_t n, const buffon_integrand *f,
                                          const buffon_density *g, buffon_rng *rng)
{
    double *draw = tile->row + g->dim;
    for (size_t i = 0; i < n; i++) {
        buffon_rng_fill(draw, g->uniforms + 1, rng);
        for (size_t j = 0; j < g->uniforms; j++)
            tile->u[j * n + i] = draw[j];
        tile->v[i] = draw[g->uniforms];
    }
    const buffon_status status =
        buffon_priv_density_result(g->ops->sample(tile->x, tile->pdf, tile->u, n, g));
    if (status != BUFFON_OK)
        return status;
    if (f->batch != NULL)
        return f->batch(tile->f, tile->x, n, f->ctx) == 0 ? BUFFON_OK : BUFFON_E_STOPPED;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < g->dim; j++)
            tile->row[j] = tile->x[j * n + i];
        tile->f[i] = f->scalar(tile->row, f->ctx);
    }
    return BUFFON_OK;
}

/* Judges candidate i: 1 accept, 0 reject, or the error. The bound holds up to the rounding of its
 * three numbers. */
static int rejection_judge(const rejection_tile *tile, size_t i, double envelope, double *worst)
{
    const double f = tile->f[i], pdf = tile->pdf[i];
    if (!(pdf > 0 && pdf < INFINITY))
        return BUFFON_E_PDF;
    if (f - f != 0)
        return BUFFON_E_NONFINITE;
    const double ratio = f / envelope / pdf;
    *worst = ratio > *worst ? ratio : *worst;
    if (f < 0 || ratio > 1 + 0x1p-50)
        return BUFFON_E_BOUND;
    return tile->v[i] < ratio;
}

static void rejection_store(double *x, size_t n, size_t at, const rejection_tile *tile, size_t i,
                            size_t tile_n, size_t dim)
{
    for (size_t j = 0; j < dim; j++)
        x[j * n + at] = tile->x[j * tile_n + i];
}

static buffon_status rejection_loop(double *x, size_t n, buffon_rejection_report *report,
                                    rejection_tile *tile, const buffon_integrand *f,
                                    const buffon_density *g, double envelope, buffon_rng *rng,
                                    uint64_t max_tries)
{
    size_t accepted = 0;
    while (accepted < n) {
        const uint64_t left = max_tries - report->tries;
        size_t m = n - accepted < REJECTION_TILE ? n - accepted : REJECTION_TILE;
        m = left < m ? (size_t)left : m;
        if (m == 0)
            return BUFFON_E_TRIES;
        const buffon_status status = rejection_candidates(tile, m, f, g, rng);
        if (status != BUFFON_OK)
            return status;
        for (size_t i = 0; i < m; i++) {
            const int verdict = rejection_judge(tile, i, envelope, &report->worst);
            report->tries++;
            if (verdict == 1 || verdict == BUFFON_E_BOUND)
                rejection_store(x, n, accepted, tile, i, m, g->dim);
            if (verdict < 0)
                return (buffon_status)verdict;
            accepted += (size_t)verdict;
            report->accepted = accepted;
        }
    }
    return BUFFON_OK;
}

static buffon_status rejection_check(const double *x, size_t n, const buffon_integrand *f,
                                     const buffon_density *g, double envelope,
                                     const buffon_rng *rng)
{
    buffon_status status = buffon_density_check(g);
    if ((x == NULL && n > 0) || rng == NULL)
        return BUFFON_E_NULL;
    if (status == BUFFON_OK)
        status = buffon_priv_integrand_check(f, g->dim);
    if (status != BUFFON_OK)
        return status;
    if (f->components > 1 || n > SIZE_MAX / sizeof(double) / g->dim)
        return BUFFON_E_DIM;
    if (!buffon_priv_density_has_pdf(g))
        return BUFFON_E_UNSUPPORTED;
    return envelope > 0 && envelope < INFINITY ? BUFFON_OK : BUFFON_E_HEIGHT;
}

buffon_status buffon_rejection_sample(double *x, size_t n, buffon_rejection_report *report,
                                      const buffon_integrand *f, const buffon_density *g,
                                      double envelope, buffon_rng *rng, uint64_t max_tries)
{
    buffon_rejection_report own = {0, 0, NAN, 0};
    rejection_tile tile = {0};
    buffon_status status = rejection_check(x, n, f, g, envelope, rng);
    const int shaped = buffon_density_check(g) == BUFFON_OK && x != NULL &&
                       n <= SIZE_MAX / sizeof(double) / g->dim;
    for (size_t i = 0; shaped && i < n * g->dim; i++)
        x[i] = NAN;
    if (status == BUFFON_OK)
        status = rejection_tile_make(&tile, g);
    if (status == BUFFON_OK) {
        const uint64_t wanted = n;
        if (max_tries == 0)
            max_tries = wanted < UINT64_MAX / 2000 ? 1000 * wanted + 1000 : UINT64_MAX;
        status = rejection_loop(x, n, &own, &tile, f, g, envelope, rng, max_tries);
    }
    free(tile.memory);
    if (own.tries > 0)
        own.acceptance = (double)own.accepted / (double)own.tries;
    if (report != NULL)
        *report = own;
    return status;
}
