#include "guard.h"

#include <stdlib.h>
#include <string.h>

#include "net.h"
#include "options.h"
#include "plan.h"

#define PLAN_FIRST_LOOK 8192 /* samples at the first look at a tolerance */

/* At least x, for 0 <= x < 2^63. */
static uint64_t plan_ceil(double x)
{
    const uint64_t whole = (uint64_t)x;
    return whole + ((double)whole < x);
}

static int plan_is_net(const buffon_priv_plan *plan)
{
    return plan->shape.design == BUFFON_DESIGN_NET;
}

/* Independent repeats of a stratum: the ranges of a net are none. */
static uint64_t plan_replicates(const buffon_priv_plan *plan)
{
    return plan_is_net(plan) ? 1 : plan->shape.per_stratum;
}

/* The least number of points of a replicate, at least n, that the point set allows. */
static uint64_t plan_whole(const buffon_priv_plan *plan, uint64_t n)
{
    const uint64_t least = plan_is_net(plan) ? BUFFON_PRIV_NET_LEAST : 1;
    const uint64_t rounds = (n + plan->shape.round - 1) / plan->shape.round;
    uint64_t power = 1;
    if (!plan->points.doubling && !plan_is_net(plan))
        return rounds * plan->shape.round;
    while (power < rounds || power * plan->shape.round < least)
        power *= 2;
    return power * plan->shape.round;
}

/* Points of each replicate of a stratum when the run has `samples`: its share, at least two if
 * there are several strata, rounded up to what the point set needs. Grows with `samples`, so that a
 * longer run contains the shorter one. */
static uint64_t plan_cell_points(const buffon_priv_plan *plan, size_t stratum, uint64_t samples)
{
    const buffon_priv_problem *problem = plan->problem;
    const uint64_t replicates = plan_replicates(plan);
    uint64_t n = samples;
    if (problem->strata > 1) {
        double all = 0;
        for (size_t s = 0; s < problem->strata; s++)
            all += problem->stratum[s].share;
        n = plan_ceil(problem->stratum[stratum].share / all * (double)samples);
        n = n < 2 ? 2 : n;
    }
    return plan_whole(plan, (n + replicates - 1) / replicates);
}

/* What the point set needs, for densities of different numbers of uniforms the least common
 * multiple: 0 if that is too large. */
static uint64_t plan_round_points(const buffon_priv_plan *plan)
{
    const buffon_priv_problem *problem = plan->problem;
    uint64_t round = 1;
    for (size_t s = 0; s < problem->strata && round > 0 && plan->points.round != NULL; s++) {
        const size_t dim = problem->stratum[s].g->uniforms + problem->extra;
        const uint64_t own = plan->points.round(dim, &plan->points);
        uint64_t a = round, b = own;
        while (b > 0) {
            const uint64_t rest = a % b;
            a = b;
            b = rest;
        }
        round = own <= (UINT64_C(1) << 48) / (round / a) ? round / a * own : 0;
    }
    return round;
}

/* The most points of a replicate. */
static uint64_t plan_limit(const buffon_priv_plan *plan)
{
    const uint64_t most = UINT64_C(1) << BUFFON_PRIV_NET_MOST, given = plan->points.limit;
    if (plan_is_net(plan))
        return given > 0 && given < most ? given : most;
    return given > 0 ? given : UINT64_MAX >> 1;
}

/* The targets of a stratum's cells for n points of each replicate. */
static void plan_set(uint64_t *target, const buffon_priv_plan *plan, uint64_t n)
{
    for (size_t r = 0; r < plan->shape.per_stratum; r++) {
        target[r] = n;
        if (plan_is_net(plan))
            target[r] = buffon_priv_net_begin(r) < n ? buffon_priv_net_size(r) : 0;
    }
}

static buffon_status plan_targets(uint64_t *target, const buffon_priv_plan *plan, uint64_t samples)
{
    const uint64_t limit = plan_limit(plan), replicates = plan_replicates(plan);
    uint64_t all = 0;
    for (size_t s = 0; s < plan->shape.strata; s++) {
        const uint64_t n = plan_cell_points(plan, s, samples);
        if (n > limit || n > (UINT64_MAX >> 1) / replicates - all / replicates - 1)
            return BUFFON_E_SAMPLES;
        plan_set(target + s * (size_t)plan->shape.per_stratum, plan, n);
        all += n * replicates;
    }
    return BUFFON_OK;
}

int buffon_priv_plan_tolerance(const buffon_priv_plan *plan)
{
    return plan->run.abs_tol > 0 || plan->run.rel_tol > 0;
}

/* Samples at look j: 2^13, 2^14, ..., and what the run allows. */
static uint64_t plan_look_samples(const buffon_priv_plan *plan, uint32_t j)
{
    if (j + 1 >= plan->shape.looks)
        return plan->run.samples;
    return (uint64_t)PLAN_FIRST_LOOK << j;
}

static void plan_shape(buffon_priv_plan *plan)
{
    const buffon_priv_problem *problem = plan->problem;
    const size_t given = problem->stratum[0].f->components, components = given > 0 ? given : 1;
    const int ratio = problem->kind == BUFFON_PRIV_RATIO;
    const int median = plan->points.design == BUFFON_DESIGN_MEDIAN;
    plan->shape = (buffon_priv_shape){
        .identity = buffon_priv_problem_identity(problem, &plan->run, &plan->points),
        .kind = problem->kind,
        .design = plan->points.design,
        .components = components,
        .outputs = components + (size_t)ratio,
        .covariance = plan->run.covariance || (ratio && !median),
        .constant = plan->run.constant != 0,
        .strata = problem->strata,
        .per_stratum = plan->points.replicates > 0 ? plan->points.replicates : 1,
        .block = plan->run.block,
        .scale_e = (uint64_t)(int64_t)problem->scale_e,
        .parts = plan->run.parts > 0 ? plan->run.parts : 1,
        .looks = 1};
    memcpy(&plan->shape.scale_m, &problem->scale_m, sizeof problem->scale_m);
    plan->shape.round = plan_round_points(plan);
    if (buffon_priv_plan_tolerance(plan)) {
        for (uint64_t n = PLAN_FIRST_LOOK; n < plan->run.samples; n *= 2)
            plan->shape.looks++;
    }
}

/* Ranges of the largest net that the run wants or its partial has. */
static uint64_t plan_ranges(const buffon_priv_plan *plan)
{
    const buffon_partial *partial = plan->run.partial;
    const buffon_priv_record *record = partial != NULL ? buffon_priv_partial_record(partial) : NULL;
    uint64_t ranges = BUFFON_PRIV_NET_RANGES;
    if (record != NULL && record->shape.design == BUFFON_DESIGN_NET)
        ranges = record->shape.per_stratum;
    for (size_t s = 0; s < plan->shape.strata; s++) {
        const uint64_t n = plan_cell_points(plan, s, plan->run.samples);
        while (ranges < BUFFON_PRIV_NET_RANGES_MOST && buffon_priv_net_begin(ranges) < n)
            ranges += 4;
    }
    return ranges;
}

buffon_status buffon_priv_plan_make(buffon_priv_plan *plan, const buffon_priv_problem *problem,
                                    const buffon_run *run)
{
    memset(plan, 0, sizeof *plan);
    plan->problem = problem;
    plan->run = buffon_priv_run_defaults(run);
    plan->points = plan->run.points != NULL ? *plan->run.points : buffon_points_random();
    plan_shape(plan);
    if (plan->shape.round == 0)
        return BUFFON_E_POINTS;
    if (plan_is_net(plan))
        plan->shape.per_stratum = plan_ranges(plan);
    const size_t cells = buffon_priv_shape_cells(&plan->shape);
    plan->target = calloc(cells, sizeof *plan->target);
    plan->look = calloc(cells, sizeof *plan->look);
    plan->table = calloc(cells, sizeof *plan->table);
    if (plan->target == NULL || plan->look == NULL || plan->table == NULL)
        return BUFFON_E_NOMEM;
    return plan_targets(plan->target, plan, plan->run.samples);
}

buffon_points_block buffon_priv_plan_block(const buffon_priv_plan *plan, size_t cell, uint64_t k)
{
    const size_t per_stratum = (size_t)plan->shape.per_stratum;
    const size_t stratum = cell / per_stratum, r = cell % per_stratum;
    const int net = plan_is_net(plan);
    return (buffon_points_block){
        .key = {.seed = plan->run.seed,
                .stream = plan->run.stream,
                .purpose = plan->problem->purpose,
                .replicate = (uint8_t)(net ? 0 : r),
                .stratum = (uint16_t)stratum},
        .first = k * plan->shape.block + (net ? buffon_priv_net_begin(r) : 0),
        .dim = plan->problem->stratum[stratum].g->uniforms + plan->problem->extra,
        .table = plan->table[net ? cell - r : cell]};
}

uint64_t buffon_priv_plan_index(const buffon_priv_plan *plan, size_t cell, uint64_t k, size_t i)
{
    const buffon_points_block block = buffon_priv_plan_block(plan, cell, k);
    return (block.first + i) * plan_replicates(plan) + block.key.replicate;
}

buffon_status buffon_priv_plan_prepare(buffon_priv_plan *plan)
{
    const size_t step = plan_is_net(plan) ? (size_t)plan->shape.per_stratum : 1;
    for (size_t c = 0; c < buffon_priv_shape_cells(&plan->shape); c += step) {
        buffon_points_block block = buffon_priv_plan_block(plan, c, 0);
        const size_t size =
            plan->points.table_size != NULL ? plan->points.table_size(block.dim, &plan->points) : 0;
        if (size == 0 && plan->points.prepare == NULL)
            continue;
        block.table = plan->table[c] = malloc(size > 0 ? size : 1);
        if (block.table == NULL)
            return BUFFON_E_NOMEM;
        if (plan->points.prepare != NULL && plan->points.prepare(&block, &plan->points) != 0)
            return BUFFON_E_POINTS;
    }
    return BUFFON_OK;
}

void buffon_priv_plan_free(buffon_priv_plan *plan)
{
    for (size_t c = 0; plan->table != NULL && c < buffon_priv_shape_cells(&plan->shape); c++)
        free(plan->table[c]);
    free(plan->table);
    free(plan->target);
    free(plan->look);
}

/* ---- what is done already ---- */

/* Is this the record of the same run, as far as a resumed one must be? */
static int plan_same_run(const buffon_priv_plan *plan, const buffon_priv_record *record)
{
    buffon_priv_shape a = plan->shape, b = record->shape;
    a.parts = b.parts = 1;
    a.looks = b.looks = 1;
    if (a.design == BUFFON_DESIGN_NET) /* it has as many ranges as it needs */
        a.per_stratum = b.per_stratum;
    return memcmp(&a, &b, sizeof a) == 0;
}

/* Does a record hold blocks of other parts than this one? */
static int plan_holds_others(const buffon_priv_plan *plan, const buffon_priv_record *record)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t cells = buffon_priv_shape_cells(shape);
    for (size_t c = 0; c < cells; c++) {
        const uint64_t last = record->target[c] / shape->block;
        for (uint64_t p = 0; p < shape->parts; p++) {
            if (p != plan->run.part && record->done[p * cells + c] > 0)
                return 1;
        }
        if (buffon_priv_cell_count(&record->tail, c, shape) &&
            buffon_priv_record_owner(record, c, last) != plan->run.part)
            return 1;
    }
    return 0;
}

buffon_status buffon_priv_plan_attach(buffon_priv_record **record, int *fresh,
                                      const buffon_priv_plan *plan)
{
    const buffon_priv_shape *shape = &plan->shape;
    *fresh = plan->run.partial == NULL || plan->run.partial->more == NULL;
    if (*fresh) {
        *record = buffon_priv_record_make(shape);
        if (*record == NULL)
            return BUFFON_E_NOMEM;
        for (size_t s = 0; s < shape->strata; s++)
            (*record)->weight[s] = plan->problem->stratum[s].weight;
        memcpy((*record)->target, plan->target,
               buffon_priv_shape_cells(shape) * sizeof *plan->target);
        return BUFFON_OK;
    }
    *record = buffon_priv_partial_record(plan->run.partial);
    if (!plan_same_run(plan, *record))
        return BUFFON_E_MISMATCH;
    if (plan->run.parts > 0 &&
        ((*record)->shape.parts != plan->run.parts || plan_holds_others(plan, *record)))
        return BUFFON_E_MISMATCH;
    if ((*record)->shape.per_stratum < shape->per_stratum) {
        *record = buffon_priv_record_grown(*record, shape->per_stratum);
        *fresh = 1;
    }
    return *record != NULL ? BUFFON_OK : BUFFON_E_NOMEM;
}

/* A whole run that goes on from parts which are all there has no parts any more. */
static void plan_join_parts(buffon_priv_record *record, const buffon_priv_plan *plan)
{
    const size_t cells = buffon_priv_shape_cells(&record->shape);
    if (plan->run.parts > 0 || record->shape.parts == 1 || !buffon_priv_record_complete(record))
        return;
    memset(record->done, 0, (size_t)record->shape.parts * cells * sizeof *record->done);
    record->shape.parts = 1;
    for (size_t c = 0; c < cells; c++)
        record->done[c] = record->target[c] / record->shape.block;
}

/* The end of the last whole block of a cell that is done. */
static uint64_t plan_extent(const buffon_priv_record *record, size_t cell)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t cells = buffon_priv_shape_cells(shape);
    uint64_t extent = 0;
    for (uint64_t p = 0; p < shape->parts; p++) {
        const uint64_t done = record->done[p * cells + cell];
        const uint64_t first = buffon_priv_record_first(record, p, cell);
        const uint64_t end = done > 0 ? (first + (done - 1) * shape->parts + 1) * shape->block : 0;
        extent = end > extent ? end : extent;
    }
    return extent;
}

/* The ranges of a net never change: where one was begun, the whole net that has it is wanted. */
static void plan_extend_nets(buffon_priv_record *record, const buffon_priv_plan *plan)
{
    const size_t ranges = (size_t)plan->shape.per_stratum;
    for (size_t c = 0; c < buffon_priv_shape_cells(&plan->shape); c += ranges) {
        uint64_t n = 0;
        for (size_t r = 0; r < ranges; r++) {
            if (plan->target[c + r] > 0 || buffon_priv_record_count(record, c + r) > 0)
                n = plan_whole(plan, buffon_priv_net_begin(r) + buffon_priv_net_size(r));
        }
        plan_set(record->target + c, plan, n);
    }
}

void buffon_priv_plan_extend(buffon_priv_record *record, const buffon_priv_plan *plan)
{
    plan_join_parts(record, plan);
    record->shape.looks = plan->shape.looks;
    if (plan_is_net(plan)) {
        plan_extend_nets(record, plan);
        return;
    }
    for (size_t c = 0; c < buffon_priv_shape_cells(&record->shape); c++) {
        const int tail = buffon_priv_cell_count(&record->tail, c, &record->shape) > 0;
        const uint64_t done = plan_extent(record, c);
        const uint64_t extent = plan->points.doubling ? plan_whole(plan, done) : done;
        if (tail && plan->target[c] <= record->target[c])
            continue;
        if (tail)
            buffon_priv_cell_clear(&record->tail, c, &record->shape);
        record->target[c] = plan->target[c] > extent ? plan->target[c] : extent;
    }
}

int buffon_priv_plan_look(buffon_priv_plan *plan, const buffon_priv_record *record, uint32_t j)
{
    const uint64_t block = plan->shape.block;
    const int last = j + 1 >= plan->shape.looks;
    uint64_t ahead = 0;
    (void)plan_targets(plan->look, plan, plan_look_samples(plan, j)); /* the run's own were fine */
    for (size_t c = 0; c < buffon_priv_shape_cells(&plan->shape); c++) {
        const uint64_t whole = (plan->look[c] + block - 1) / block * block;
        const uint64_t target = record->target[c];
        plan->look[c] = last || whole > target ? target : whole;
        /* The short last block of a small stratum may belong to an early look. */
        ahead |=
            plan_extent(record, c) > plan->look[c] ||
            (plan->look[c] < target && buffon_priv_cell_count(&record->tail, c, &plan->shape) > 0);
    }
    return !ahead;
}
