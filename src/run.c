#include "guard.h"

#include <math.h>
#include <stdlib.h>

#include <buffon/run.h>

#include "engine.h"
#include "options.h"

#define RUN_MOST (UINT32_MAX / sizeof(double)) /* uniforms or coordinates of a point */

/* Draws one point of a cell: what a worker does for a block, for the maths of the point alone. */
static buffon_status run_draw(double *x, double *u, const buffon_points_block *block,
                              const buffon_points *points, const buffon_density *g)
{
    if (points->prepare != NULL && points->prepare(block, points) != 0)
        return BUFFON_E_POINTS;
    if (points->fill(u, block, points) != 0)
        return BUFFON_E_POINTS;
    return buffon_density_sample(x, NULL, u, 1, g);
}

buffon_status buffon_priv_run_point(double *x, const buffon_density *g, uint64_t stratum,
                                    uint64_t index, const buffon_run *run)
{
    const buffon_run full = buffon_priv_run_defaults(run);
    const buffon_points points = full.points != NULL ? *full.points : buffon_points_random();
    const uint64_t replicates = points.replicates > 0 ? points.replicates : 1;
    buffon_points_block block = {.key = {.seed = full.seed,
                                         .stream = full.stream,
                                         .purpose = BUFFON_PURPOSE_MAIN,
                                         .replicate = (uint8_t)(index % replicates),
                                         .stratum = (uint16_t)stratum},
                                 .first = index / replicates,
                                 .n = 1};
    buffon_status status = buffon_density_check(g);
    if (x == NULL)
        return BUFFON_E_NULL;
    if (g != NULL && (g->dim > RUN_MOST || g->uniforms > RUN_MOST))
        return BUFFON_E_DIM;
    for (size_t j = 0; g != NULL && j < g->dim; j++)
        x[j] = NAN;
    if (status == BUFFON_OK)
        status = buffon_priv_run_check(run);
    if (status == BUFFON_OK)
        status = buffon_priv_points_check(&points, g->uniforms);
    if (status == BUFFON_OK && points.limit > 0 && block.first >= points.limit)
        status = BUFFON_E_SAMPLES;
    if (status != BUFFON_OK)
        return status;
    const size_t size = points.table_size != NULL ? points.table_size(g->uniforms, &points) : 0;
    double *u = malloc(g->uniforms * sizeof *u);
    block.dim = g->uniforms;
    block.table = malloc(size > 0 ? size : 1);
    status = u != NULL && block.table != NULL ? run_draw(x, u, &block, &points, g) : BUFFON_E_NOMEM;
    free(u);
    free(block.table);
    return status;
}

buffon_status buffon_sample_at(double *x, const buffon_density *g, uint64_t index,
                               const buffon_run *run)
{
    return buffon_priv_run_point(x, g, 0, index, run);
}
