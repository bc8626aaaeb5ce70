#include "guard.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <buffon/stratified.h>

#include "engine.h"
#include "record.h"
#include "stats_priv.h"
#include "weigh.h"

#define STRATIFIED_MOST 65536
#define STRATIFIED_FLOOR 0.1 /* of its own share that a stratum keeps under Neyman allocation */

/* A number that stands for 1 where it is 0. */
static double stratified_or_one(double x)
{
    return x != 0 ? x : 1;
}

static buffon_status stratified_check(const buffon_integrand *f, const buffon_strata *strata)
{
    if (strata == NULL || strata->stratum == NULL)
        return BUFFON_E_NULL;
    if (strata->count == 0 || strata->count > STRATIFIED_MOST)
        return BUFFON_E_STRATA;
    if ((strata->reserved[0] | strata->reserved[1] | strata->reserved[2] | strata->reserved[3]) !=
            0 ||
        (strata->allocation != BUFFON_ALLOCATION_SHARE &&
         strata->allocation != BUFFON_ALLOCATION_NEYMAN))
        return BUFFON_E_RESERVED;
    double shares = 0;
    for (size_t s = 0; s < strata->count; s++) {
        const buffon_stratum *stratum = &strata->stratum[s];
        shares += stratum->share;
        if (stratum->reserved[0] != 0 || stratum->reserved[1] != 0)
            return BUFFON_E_RESERVED;
        if (!(stratum->weight - stratum->weight == 0) || !(stratum->share >= 0) ||
            !(shares < INFINITY))
            return BUFFON_E_STRATA;
        if (stratum->density == NULL || (stratum->f == NULL && f == NULL))
            return BUFFON_E_NULL;
    }
    return BUFFON_OK;
}

/* The strata as the engine takes them. */
static buffon_priv_stratum *stratified_list(const buffon_integrand *f, const buffon_strata *strata)
{
    buffon_priv_stratum *list = calloc(strata->count, sizeof *list);
    for (size_t s = 0; list != NULL && s < strata->count; s++) {
        const buffon_stratum *stratum = &strata->stratum[s];
        list[s] = (buffon_priv_stratum){.g = stratum->density,
                                        .f = stratum->f != NULL ? stratum->f : f,
                                        .weight = stratified_or_one(stratum->weight),
                                        .share = stratified_or_one(stratum->share),
                                        .asked = stratified_or_one(stratum->share)};
    }
    return list;
}

/* |weight| times the standard deviation that the pilot saw in a stratum. */
static double stratified_deviation(const buffon_priv_record *record, size_t s, size_t component)
{
    const size_t series = buffon_priv_shape_series(&record->shape);
    buffon_stats all = record->whole.stats[s * series + component];
    buffon_stats_merge(&all, &record->tail.stats[s * series + component]);
    const double deviation =
        buffon_priv_wide_to_double(buffon_priv_wide_sqrt(buffon_priv_stats_variance(&all)));
    return fabs(record->weight[s]) * deviation;
}

/* New shares from the pilot: Neyman's n_s ~ |weight_s| sigma_s, averaged over the components, and
 * not below a tenth of the old share, since a pilot can miss what a stratum hides. */
static void stratified_reallocate(buffon_priv_stratum *list, const buffon_priv_record *record)
{
    const size_t strata = (size_t)record->shape.strata,
                 components = (size_t)record->shape.components;
    double old = 0, all_components = 0;
    for (size_t s = 0; s < strata; s++)
        old += list[s].share;
    for (size_t s = 0; s < strata; s++)
        list[s].share = STRATIFIED_FLOOR * list[s].share / old;
    for (size_t k = 0; k < components; k++) {
        double sum = 0;
        for (size_t s = 0; s < strata; s++)
            sum += stratified_deviation(record, s, k);
        if (!(sum > 0 && sum < INFINITY))
            continue;
        all_components += 1;
        for (size_t s = 0; s < strata; s++)
            list[s].share += (1 - STRATIFIED_FLOOR) * stratified_deviation(record, s, k) / sum /
                             (double)components;
    }
    if (all_components > 0)
        return;
    for (size_t s = 0; s < strata; s++) /* no spread anywhere: the old shares */
        list[s].share /= STRATIFIED_FLOOR;
}

/* Points of the pilot in each stratum. */
static uint64_t stratified_pilot_points(const buffon_strata *strata)
{
    return strata->pilot > 0 ? strata->pilot : 1024;
}

/* Runs the pilot, with numbers of its own, and reallocates. Its size does not depend on the samples
 * of the run, so a longer run keeps the shares of a shorter one. */
static buffon_status stratified_pilot(buffon_estimate *out, buffon_priv_problem *problem,
                                      buffon_priv_stratum *list, const buffon_strata *strata,
                                      const buffon_run *run)
{
    const uint64_t each = stratified_pilot_points(strata);
    buffon_priv_stratum *equal = malloc(strata->count * sizeof *equal);
    buffon_priv_problem pilot = *problem;
    buffon_partial partial = {{0}, NULL};
    buffon_run options = {.samples = each * strata->count,
                          .partial = &partial,
                          .on_nonfinite = BUFFON_NONFINITE_ZERO};
    if (equal == NULL)
        return buffon_priv_refuse(out, list[0].f, BUFFON_E_NOMEM);
    for (size_t s = 0; s < strata->count; s++) {
        equal[s] = list[s];
        equal[s].share = 1;
    }
    if (run != NULL) {
        options.seed = run->seed;
        options.stream = run->stream;
        options.threads = run->threads;
        options.block = run->block;
        options.executor = run->executor;
        options.executor_ctx = run->executor_ctx;
    }
    pilot.stratum = equal;
    pilot.purpose = BUFFON_PURPOSE_PILOT;
    const buffon_status status = buffon_priv_engine_run(out, &pilot, &options);
    if (status >= 0)
        stratified_reallocate(list, buffon_priv_partial_record(&partial));
    buffon_partial_free(&partial);
    free(equal);
    if (status < 0) /* the pilot's points are its own: no index of the run names them */
        return buffon_priv_refuse(out, list[0].f, status);
    return BUFFON_OK;
}

buffon_status buffon_stratified(buffon_estimate *out, const buffon_integrand *f,
                                const buffon_strata *strata, const buffon_run *run)
{
    buffon_status status = stratified_check(f, strata);
    const buffon_integrand *first = f;
    if (strata != NULL && strata->stratum != NULL && strata->count > 0 &&
        strata->stratum[0].f != NULL)
        first = strata->stratum[0].f;
    if (status != BUFFON_OK || out == NULL)
        return buffon_priv_refuse(out, first, status);
    buffon_priv_stratum *list = stratified_list(f, strata);
    if (list == NULL)
        return buffon_priv_refuse(out, first, BUFFON_E_NOMEM);
    buffon_priv_problem problem = {.name = "buffon.stratified",
                                   .stratum = list,
                                   .strata = strata->count,
                                   .pdf = 1,
                                   .scale_m = 1,
                                   .weigh = buffon_priv_weigh_ratio};
    if (strata->allocation == BUFFON_ALLOCATION_NEYMAN)
        problem.param = (double)stratified_pilot_points(strata);
    status = buffon_priv_engine_check(&problem, run); /* before the pilot draws anything */
    if (status != BUFFON_OK)
        status = buffon_priv_refuse(out, first, status);
    else if (strata->allocation == BUFFON_ALLOCATION_NEYMAN)
        status = stratified_pilot(out, &problem, list, strata, run);
    if (status == BUFFON_OK)
        status = buffon_priv_engine_run(out, &problem, run);
    free(list);
    return status;
}

buffon_status buffon_stratum_sample_at(double *x, const buffon_strata *strata, uint64_t stratum,
                                       uint64_t index, const buffon_run *run)
{
    if (x == NULL || strata == NULL || strata->stratum == NULL)
        return BUFFON_E_NULL;
    if (strata->count > STRATIFIED_MOST || stratum >= strata->count) {
        const buffon_density *g = strata->count > 0 ? strata->stratum[0].density : NULL;
        for (size_t j = 0; g != NULL && j < g->dim; j++)
            x[j] = NAN;
        return BUFFON_E_STRATA;
    }
    return buffon_priv_run_point(x, strata->stratum[stratum].density, stratum, index, run);
}
