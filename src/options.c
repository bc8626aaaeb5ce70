#include "guard.h"

#include <math.h>

#include "density_priv.h"
#include "mix.h"
#include "options.h"
#include "points_priv.h"

#define OPTIONS_THREADS_MOST 4096
#define OPTIONS_MEDIAN_LEAST 5 /* replicates */

static int options_all_zero(const uint64_t *words, size_t n)
{
    uint64_t any = 0;
    for (size_t i = 0; i < n; i++)
        any |= words[i];
    return any == 0;
}

buffon_run buffon_priv_run_defaults(const buffon_run *run)
{
    buffon_run full = {0};
    if (run != NULL)
        full = *run;
    if (full.samples == 0)
        full.samples = UINT64_C(1) << 20;
    if (full.threads == 0)
        full.threads = 1;
    if (full.threads > OPTIONS_THREADS_MOST)
        full.threads = OPTIONS_THREADS_MOST;
    if (full.block == 0)
        full.block = 1024;
    if (full.confidence == 0)
        full.confidence = 0.95;
    return full;
}

/* A tolerance is 0 or positive and finite; NaN fails every comparison. */
static int options_tolerance(double tolerance)
{
    return tolerance >= 0 && tolerance < INFINITY;
}

buffon_status buffon_priv_run_check(const buffon_run *run)
{
    if (run == NULL)
        return BUFFON_OK;
    const buffon_run full = buffon_priv_run_defaults(run);
    if (!options_all_zero(run->reserved, 8) || run->reserved_int != 0)
        return BUFFON_E_RESERVED;
    if (run->on_nonfinite != BUFFON_NONFINITE_ERROR && run->on_nonfinite != BUFFON_NONFINITE_ZERO)
        return BUFFON_E_RESERVED;
    if (!(full.confidence > 0 && full.confidence < 1))
        return BUFFON_E_CONFIDENCE;
    if (!options_tolerance(run->abs_tol) || !options_tolerance(run->rel_tol))
        return BUFFON_E_TOLERANCE;
    if (full.block < 16 || full.block > 1u << 20 || (full.block & (full.block - 1)) != 0)
        return BUFFON_E_BLOCK;
    if (full.samples > UINT64_C(1) << 62)
        return BUFFON_E_SAMPLES;
    if (run->parts == 0 ? run->part != 0 : run->part >= run->parts)
        return BUFFON_E_PART;
    if (run->parts > 0 && (run->partial == NULL || run->abs_tol > 0 || run->rel_tol > 0))
        return BUFFON_E_PART;
    if (run->covariance && run->partial == NULL)
        return BUFFON_E_PART;
    return BUFFON_OK;
}

buffon_status buffon_priv_integrand_check(const buffon_integrand *f, size_t dim)
{
    if (f == NULL)
        return BUFFON_E_NULL;
    if (!options_all_zero(f->reserved, 4))
        return BUFFON_E_RESERVED;
    if ((f->scalar == NULL) == (f->batch == NULL) || (f->scalar != NULL && f->components > 1))
        return BUFFON_E_INTEGRAND;
    if (f->dim == 0 || (dim > 0 && f->dim != dim) || f->components > OPTIONS_COMPONENTS_MOST)
        return BUFFON_E_DIM;
    return BUFFON_OK;
}

buffon_status buffon_priv_points_check(const buffon_points *points, size_t dim)
{
    if (points->fill == NULL || points->replicates > BUFFON_PRIV_REPLICATES ||
        (unsigned)points->design > BUFFON_DESIGN_MEDIAN)
        return BUFFON_E_POINTS;
    const int net = points->design == BUFFON_DESIGN_NET;
    if (net && points->replicates > 1)
        return BUFFON_E_POINTS;
    if (points->design == BUFFON_DESIGN_MEDIAN &&
        (points->replicates < OPTIONS_MEDIAN_LEAST || points->replicates % 2 == 0))
        return BUFFON_E_POINTS;
    if (!options_all_zero(points->reserved, 3))
        return BUFFON_E_RESERVED;
    const uint64_t round = points->round != NULL ? points->round(dim, points) : 1;
    if (round == 0 || round > UINT64_C(1) << 48)
        return BUFFON_E_POINTS;
    if ((points->doubling || net) && (round & (round - 1)) != 0)
        return BUFFON_E_POINTS;
    if ((points->design == BUFFON_DESIGN_ANTITHETIC ||
         points->design == BUFFON_DESIGN_STRATIFIED) &&
        round % 2 != 0)
        return BUFFON_E_POINTS;
    if (points->table_size != NULL && points->table_size(dim, points) == SIZE_MAX)
        return BUFFON_E_POINTS;
    return BUFFON_OK;
}

static size_t options_components(const buffon_integrand *f)
{
    return f->components > 0 ? f->components : 1;
}

static buffon_status options_stratum_check(const buffon_priv_problem *problem, size_t s)
{
    const buffon_priv_stratum *stratum = &problem->stratum[s];
    buffon_status status = buffon_density_check(stratum->g);
    if (status == BUFFON_OK)
        status = buffon_priv_integrand_check(stratum->f, stratum->g->dim);
    if (status == BUFFON_OK && problem->p != NULL)
        status = buffon_priv_integrand_check(problem->p, stratum->g->dim);
    if (status != BUFFON_OK)
        return status;
    if (problem->p != NULL && problem->p->components > 1)
        return BUFFON_E_DIM;
    if (stratum->g->uniforms > UINT32_MAX - problem->extra || stratum->g->dim > UINT32_MAX)
        return BUFFON_E_DIM;
    if (stratum->g->dim != problem->stratum[0].g->dim ||
        options_components(stratum->f) != options_components(problem->stratum[0].f))
        return BUFFON_E_DIM;
    if (problem->pdf && !buffon_priv_density_has_pdf(stratum->g))
        return BUFFON_E_UNSUPPORTED;
    return BUFFON_OK;
}

buffon_status buffon_priv_problem_check(const buffon_priv_problem *problem, const buffon_run *run)
{
    buffon_status status = buffon_priv_run_check(run);
    for (size_t s = 0; s < problem->strata && status == BUFFON_OK; s++) {
        status = options_stratum_check(problem, s);
        if (status == BUFFON_OK && run != NULL && run->points != NULL)
            status = buffon_priv_points_check(run->points,
                                              problem->stratum[s].g->uniforms + problem->extra);
    }
    if (status == BUFFON_OK && run != NULL && run->points != NULL &&
        (!buffon_priv_points_serve(run->points, problem->strata) ||
         (run->covariance && run->points->design == BUFFON_DESIGN_MEDIAN)))
        status = BUFFON_E_POINTS;
    return status;
}

static uint64_t options_points_identity(uint64_t mix, const buffon_points *points)
{
    mix = buffon_priv_mix_name(mix, points->name);
    mix = buffon_priv_mix(mix, (uint64_t)points->design);
    mix = buffon_priv_mix(mix, points->limit);
    for (size_t i = 0; i < 4; i++)
        mix = buffon_priv_mix(mix, points->param[i]);
    return mix;
}

uint64_t buffon_priv_problem_identity(const buffon_priv_problem *problem, const buffon_run *run,
                                      const buffon_points *points)
{
    uint64_t mix = buffon_priv_mix_name(0, problem->name);
    for (size_t s = 0; s < problem->strata; s++) {
        const buffon_priv_stratum *stratum = &problem->stratum[s];
        mix = buffon_priv_density_identity(mix, stratum->g);
        mix = buffon_priv_mix_double(mix, stratum->weight);
        mix = buffon_priv_mix_double(mix, stratum->asked);
    }
    mix = buffon_priv_mix(mix, problem->extra);
    mix = buffon_priv_mix_double(mix, problem->param);
    mix = buffon_priv_mix(mix, problem->purpose);
    mix = options_points_identity(mix, points);
    mix = buffon_priv_mix(mix, run->seed);
    mix = buffon_priv_mix(mix, run->stream);
    mix = buffon_priv_mix(mix, run->id);
    return buffon_priv_mix(mix, (uint64_t)(unsigned)run->on_nonfinite);
}
