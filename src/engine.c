#include "guard.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "engine.h"
#include "options.h"
#include "parallel.h"
#include "worker.h"

#define ENGINE_ROUND 1024             /* blocks handed to the workers at a time, at most */
#define ENGINE_FIRST_LOOK 8192        /* samples at the first look at a tolerance */
#define ENGINE_PROGRESS_SECONDS 0.1   /* between calls of the progress callback */
#define ENGINE_LINDEBERG 0.01         /* the largest share of one sample where a tolerance is met */

/* A run under way. */
typedef struct engine {
    buffon_run run; /* with its defaults */
    buffon_points points;
    buffon_priv_shape shape;
    buffon_priv_setting setting;
    buffon_estimate *out;
    buffon_priv_record *record;
    int own_record; /* no partial holds it */
    uint64_t *target;
    uint64_t *look;  /* [cells] points at the present look */
    void **table;    /* [cells] */
    buffon_priv_worker *worker;
    size_t workers;
    buffon_priv_team *team;
    int team_tried;
    buffon_priv_task *task; /* of the present round */
    size_t tasks, round;    /* there are, and at most */
    uint64_t next_k;        /* where the next round looks for blocks */
    size_t next_cell;
    double last_progress;
    atomic_size_t next_task;
    atomic_int stop;
} engine;

/* ---- the plan ---- */

/* At least x, for 0 <= x < 2^63. */
static uint64_t engine_ceil(double x)
{
    const uint64_t whole = (uint64_t)x;
    return whole + ((double)whole < x);
}

/* Points of each replicate of a stratum when the run has `samples`: its share, at least two if there
 * are several strata, rounded up to what the point set needs. Grows with `samples`, so that a longer
 * run contains the shorter one. */
static uint64_t engine_cell_points(const engine *e, size_t stratum, uint64_t samples)
{
    const buffon_priv_problem *problem = e->setting.problem;
    const uint64_t replicates = e->shape.replicates, round = e->shape.round;
    uint64_t n = samples;
    if (problem->strata > 1) {
        double all = 0;
        for (size_t s = 0; s < problem->strata; s++)
            all += problem->stratum[s].share;
        n = engine_ceil(problem->stratum[stratum].share / all * (double)samples);
        n = n < 2 ? 2 : n;
    }
    n = (n + replicates - 1) / replicates;
    return (n + round - 1) / round * round;
}

/* What the point set needs, for densities of different numbers of uniforms the least common multiple:
 * 0 if that is too large. */
static uint64_t engine_round_points(const engine *e)
{
    const buffon_priv_problem *problem = e->setting.problem;
    uint64_t round = 1;
    for (size_t s = 0; s < problem->strata && round > 0 && e->points.round != NULL; s++) {
        const size_t dim = problem->stratum[s].g->uniforms + problem->extra;
        const uint64_t own = e->points.round(dim, &e->points);
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

static buffon_status engine_targets(engine *e, uint64_t samples, uint64_t *target)
{
    const uint64_t limit = e->points.limit > 0 ? e->points.limit : UINT64_MAX >> 1;
    uint64_t all = 0;
    for (size_t s = 0; s < e->shape.strata; s++) {
        const uint64_t n = engine_cell_points(e, s, samples);
        if (n > limit || n > (UINT64_MAX >> 1) / e->shape.replicates - all / e->shape.replicates - 1)
            return BUFFON_E_SAMPLES;
        for (size_t r = 0; r < e->shape.replicates; r++)
            target[s * (size_t)e->shape.replicates + r] = n;
        all += n * e->shape.replicates;
    }
    return BUFFON_OK;
}

static int engine_has_tolerance(const engine *e)
{
    return e->run.abs_tol > 0 || e->run.rel_tol > 0;
}

/* Samples at look j: 2^13, 2^14, ..., and what the run allows. */
static uint64_t engine_look_samples(const engine *e, uint32_t j)
{
    if (j + 1 >= e->shape.looks)
        return e->run.samples;
    return (uint64_t)ENGINE_FIRST_LOOK << j;
}

static void engine_shape(engine *e)
{
    const buffon_priv_problem *problem = e->setting.problem;
    const size_t given = problem->stratum[0].f->components, components = given > 0 ? given : 1;
    const int ratio = problem->kind == BUFFON_PRIV_RATIO;
    e->shape = (buffon_priv_shape){
        .identity = buffon_priv_problem_identity(problem, &e->run, &e->points),
        .kind = problem->kind,
        .design = e->points.design,
        .components = components,
        .outputs = components + (size_t)ratio,
        .covariance = e->run.covariance || ratio,
        .constant = e->run.constant != 0,
        .strata = problem->strata,
        .replicates = e->points.replicates > 0 ? e->points.replicates : 1,
        .block = e->run.block,
        .scale_e = (uint64_t)(int64_t)problem->scale_e,
        .parts = e->run.parts > 0 ? e->run.parts : 1,
        .looks = 1};
    memcpy(&e->shape.scale_m, &problem->scale_m, sizeof problem->scale_m);
    e->shape.round = engine_round_points(e);
    if (engine_has_tolerance(e)) {
        for (uint64_t n = ENGINE_FIRST_LOOK; n < e->run.samples; n *= 2)
            e->shape.looks++;
    }
}

/* ---- what is done already ---- */

/* Is this the record of the same run, as far as a resumed one must be? */
static int engine_same_run(const engine *e, const buffon_priv_record *record)
{
    buffon_priv_shape a = e->shape, b = record->shape;
    a.parts = b.parts = 1;
    a.looks = b.looks = 1;
    return memcmp(&a, &b, sizeof a) == 0;
}

/* Does a record hold blocks of other parts than this one? */
static int engine_holds_others(const engine *e, const buffon_priv_record *record)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t cells = buffon_priv_shape_cells(shape);
    for (size_t c = 0; c < cells; c++) {
        const uint64_t last = record->target[c] / shape->block;
        for (uint64_t p = 0; p < shape->parts; p++) {
            if (p != e->run.part && record->done[p * cells + c] > 0)
                return 1;
        }
        if (buffon_priv_cell_count(&record->tail, c, shape) &&
            buffon_priv_record_owner(record, c, last) != e->run.part)
            return 1;
    }
    return 0;
}

static buffon_status engine_attach(engine *e)
{
    buffon_priv_record *record = NULL;
    if (e->run.partial != NULL)
        record = buffon_priv_partial_record(e->run.partial);
    if (record == NULL) {
        record = buffon_priv_record_make(&e->shape);
        if (record == NULL)
            return BUFFON_E_NOMEM;
        for (size_t s = 0; s < e->shape.strata; s++)
            record->weight[s] = e->setting.problem->stratum[s].weight;
        memcpy(record->target, e->target, buffon_priv_shape_cells(&e->shape) * sizeof *e->target);
        e->own_record = 1;
    } else if (!engine_same_run(e, record)) {
        return BUFFON_E_MISMATCH;
    } else if (e->run.parts > 0 &&
               (record->shape.parts != e->run.parts || engine_holds_others(e, record))) {
        return BUFFON_E_MISMATCH;
    }
    e->record = record;
    return BUFFON_OK;
}

/* A whole run that goes on from parts which are all there has no parts any more. */
static void engine_join_parts(engine *e)
{
    buffon_priv_record *record = e->record;
    const size_t cells = buffon_priv_shape_cells(&record->shape);
    if (e->run.parts > 0 || record->shape.parts == 1 || !buffon_priv_record_complete(record))
        return;
    memset(record->done, 0, (size_t)record->shape.parts * cells * sizeof *record->done);
    record->shape.parts = 1;
    for (size_t c = 0; c < cells; c++)
        record->done[c] = record->target[c] / record->shape.block;
}

/* The end of the last whole block of a cell that is done. */
static uint64_t engine_extent(const buffon_priv_record *record, size_t cell)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t cells = buffon_priv_shape_cells(shape);
    uint64_t extent = 0;
    for (uint64_t p = 0; p < shape->parts; p++) {
        const uint64_t done = record->done[p * cells + cell];
        const uint64_t first = (p + shape->parts - cell % shape->parts) % shape->parts;
        const uint64_t end = done > 0 ? (first + (done - 1) * shape->parts + 1) * shape->block : 0;
        extent = end > extent ? end : extent;
    }
    return extent;
}

/* Sets the targets of a record that may hold something already. What is done stays; but a short last
 * block that is not the last any more is forgotten, to be evaluated again as part of a whole one. */
static void engine_extend(engine *e)
{
    buffon_priv_record *record = e->record;
    engine_join_parts(e);
    record->shape.looks = e->shape.looks;
    for (size_t c = 0; c < buffon_priv_shape_cells(&record->shape); c++) {
        const int tail = buffon_priv_cell_count(&record->tail, c, &record->shape) > 0;
        const uint64_t extent = engine_extent(record, c);
        if (tail && e->target[c] <= record->target[c])
            continue;
        if (tail)
            buffon_priv_cell_clear(&record->tail, c, &record->shape);
        record->target[c] = e->target[c] > extent ? e->target[c] : extent;
    }
    e->setting.shape = &record->shape;
}

/* ---- memory ---- */

static void engine_free(engine *e)
{
    buffon_priv_team_stop(e->team);
    for (size_t i = 0; e->worker != NULL && i < e->workers; i++)
        buffon_priv_worker_free(&e->worker[i]);
    for (size_t c = 0; e->table != NULL && c < buffon_priv_shape_cells(&e->shape); c++)
        free(e->table[c]);
    free(e->worker);
    free(e->table);
    free(e->task);
    free(e->target);
    free(e->look);
    if (e->own_record)
        buffon_priv_record_free(e->record);
}

/* The tables of the point set, one for each cell. */
static buffon_status engine_prepare(engine *e)
{
    const buffon_priv_problem *problem = e->setting.problem;
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->shape); c++) {
        const size_t dim = problem->stratum[c / e->shape.replicates].g->uniforms + problem->extra;
        const size_t size = e->points.table_size != NULL ? e->points.table_size(dim, &e->points) : 0;
        if (size == 0 && e->points.prepare == NULL)
            continue;
        e->table[c] = malloc(size > 0 ? size : 1);
        if (e->table[c] == NULL)
            return BUFFON_E_NOMEM;
        const buffon_points_block block = {.key = buffon_priv_cell_key(&e->setting, c),
                                           .dim = dim,
                                           .table = e->table[c]};
        if (e->points.prepare != NULL && e->points.prepare(&block, &e->points) != 0)
            return BUFFON_E_POINTS;
    }
    return BUFFON_OK;
}

static buffon_status engine_allocate(engine *e)
{
    uint64_t blocks = 0, longest = 0;
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->shape); c++) {
        /* A record may want more than this run: a gap before blocks that are done. */
        const uint64_t here = e->record->target[c];
        const uint64_t n = e->target[c] > here ? e->target[c] : here;
        blocks += (n + e->shape.block - 1) / e->shape.block;
        longest = n > longest ? n : longest;
    }
    const size_t n = (size_t)(longest < e->shape.block ? longest : e->shape.block);
    e->workers = blocks < e->run.threads ? (size_t)blocks : e->run.threads;
    /* The first round shows how long a block takes, if anybody is waiting to hear. */
    e->round = e->run.progress != NULL ? e->workers : ENGINE_ROUND;
    e->task = calloc(ENGINE_ROUND, sizeof *e->task);
    e->worker = calloc(e->workers, sizeof *e->worker);
    if (e->task == NULL || e->worker == NULL)
        return BUFFON_E_NOMEM;
    for (size_t i = 0; i < e->workers; i++) {
        const buffon_status status = buffon_priv_worker_make(&e->worker[i], &e->setting, n);
        if (status != BUFFON_OK)
            return status;
    }
    return engine_prepare(e);
}

static buffon_status engine_make(engine *e, const buffon_priv_problem *problem,
                                 const buffon_run *run)
{
    buffon_status status;
    e->run = buffon_priv_run_defaults(run);
    e->points = e->run.points != NULL ? *e->run.points : buffon_points_random();
    e->setting = (buffon_priv_setting){.problem = problem,
                                       .run = &e->run,
                                       .points = &e->points,
                                       .shape = &e->shape};
    engine_shape(e);
    if (e->shape.round == 0)
        return BUFFON_E_POINTS;
    const size_t cells = buffon_priv_shape_cells(&e->shape);
    e->target = calloc(cells, sizeof *e->target);
    e->look = calloc(cells, sizeof *e->look);
    e->table = calloc(cells, sizeof *e->table);
    e->setting.table = e->table;
    if (e->target == NULL || e->look == NULL || e->table == NULL)
        return BUFFON_E_NOMEM;
    status = engine_targets(e, e->run.samples, e->target);
    if (status == BUFFON_OK)
        status = engine_attach(e);
    if (status == BUFFON_OK)
        status = engine_allocate(e);
    if (status != BUFFON_OK)
        return status;
    engine_extend(e); /* from here on nothing is refused */
    if (e->own_record && e->run.partial != NULL) {
        e->run.partial->more = e->record;
        e->own_record = 0;
    }
    return BUFFON_OK;
}

/* ---- rounds ---- */

/* Blocks of a cell up to the present look. */
static uint64_t engine_blocks(const engine *e, size_t cell)
{
    const uint64_t block = e->shape.block, points = e->look[cell];
    return points / block + (points % block != 0);
}

/* Gathers the next blocks that are to do: block 0 of every cell, block 1 of every cell, ... so that any
 * prefix has some of each. Returns their number. */
static size_t engine_gather(engine *e, size_t most)
{
    const buffon_priv_record *record = e->record;
    const size_t cells = buffon_priv_shape_cells(&e->shape);
    uint64_t longest = 0;
    for (size_t c = 0; c < cells; c++) {
        const uint64_t blocks = engine_blocks(e, c);
        longest = blocks > longest ? blocks : longest;
    }
    e->tasks = 0;
    while (e->tasks < most && e->next_k < longest) {
        const uint64_t k = e->next_k;
        const size_t c = e->next_cell;
        const int mine =
            e->run.parts == 0 || buffon_priv_record_owner(record, c, k) == e->run.part;
        if (k < engine_blocks(e, c) && mine && !buffon_priv_record_has(record, c, k)) {
            const uint64_t left = record->target[c] - k * e->shape.block;
            e->task[e->tasks++] = (buffon_priv_task){
                .k = k,
                .cell = c,
                .n = (size_t)(left < e->shape.block ? left : e->shape.block)};
        }
        if (++e->next_cell == cells) {
            e->next_cell = 0;
            e->next_k++;
        }
    }
    return e->tasks;
}

/* Tasks are taken in order, and one that is taken is done: so when one fails, all before it have been
 * tried, and the lowest failure does not depend on the threads. */
static void engine_work(size_t i, void *arg)
{
    engine *e = arg;
    buffon_priv_worker *worker = &e->worker[i];
    while (!atomic_load_explicit(&e->stop, memory_order_relaxed)) {
        const size_t t = atomic_fetch_add_explicit(&e->next_task, 1, memory_order_relaxed);
        if (t >= e->tasks)
            return;
        worker->status = buffon_priv_worker_block(worker, &e->task[t]);
        if (worker->status != BUFFON_OK) {
            worker->task = t;
            atomic_store_explicit(&e->stop, 1, memory_order_relaxed);
        }
    }
}

/* The tasks of the round on as many workers as there are. */
static void engine_round_run(engine *e)
{
    const size_t workers = e->tasks < e->workers ? e->tasks : e->workers;
    atomic_store(&e->next_task, 0);
    atomic_store(&e->stop, 0);
    if (e->run.executor != NULL) {
        e->run.executor(workers, engine_work, e, e->run.executor_ctx);
        engine_work(0, e); /* what an executor that ended early left */
        return;
    }
    if (workers > 1 && !e->team_tried) {
        e->team_tried = 1;
        e->team = buffon_priv_team_start(e->workers - 1);
    }
    buffon_priv_team_run(workers > 1 ? e->team : NULL, engine_work, e);
}

/* The worker that failed at the lowest task; NULL if none did. */
static const buffon_priv_worker *engine_failure(const engine *e)
{
    const buffon_priv_worker *lowest = NULL;
    for (size_t i = 0; i < e->workers; i++) {
        const buffon_priv_worker *worker = &e->worker[i];
        if (worker->status < 0 && (lowest == NULL || worker->task < lowest->task))
            lowest = worker;
    }
    return lowest;
}

static void engine_merge_cells(engine *e, const buffon_priv_cells *into,
                               const buffon_priv_cells *from)
{
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->shape); c++) {
        if (buffon_priv_cell_count(from, c, &e->shape) > 0) {
            buffon_priv_cell_merge(into, from, c, &e->shape);
            buffon_priv_cell_clear(from, c, &e->shape);
        }
    }
}

/* Adds what the workers have to the record. */
static void engine_commit(engine *e)
{
    buffon_priv_record *record = e->record;
    const size_t cells = buffon_priv_shape_cells(&e->shape);
    for (size_t i = 0; i < e->workers; i++) {
        engine_merge_cells(e, &record->whole, &e->worker[i].whole);
        engine_merge_cells(e, &record->tail, &e->worker[i].tail);
    }
    for (size_t t = 0; t < e->tasks; t++) {
        const buffon_priv_task *task = &e->task[t];
        if (task->n == e->shape.block)
            record->done[buffon_priv_record_owner(record, task->cell, task->k) * cells +
                         task->cell]++;
    }
}

/* ---- progress ---- */

static double engine_clock(void)
{
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Points that this run, or this part of it, is to have in the end. */
static uint64_t engine_total(const engine *e)
{
    const buffon_priv_record *record = e->record;
    const uint64_t block = e->shape.block;
    uint64_t total = 0;
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->shape); c++) {
        const uint64_t blocks = record->target[c] / block, rest = record->target[c] % block;
        if (e->run.parts == 0) {
            total += record->target[c];
            continue;
        }
        total += buffon_priv_record_owned(record, e->run.part, c, blocks) * block;
        if (buffon_priv_record_owner(record, c, blocks) == e->run.part)
            total += rest;
    }
    return total;
}

/* Tells the caller how far the run is; non-zero if he cancels it. */
static int engine_tell(const engine *e)
{
    buffon_partial view = {{0}, e->record};
    const buffon_progress progress = {
        .done = buffon_priv_record_points(e->record),
        .total = engine_total(e),
        .estimate = e->out,
        .components = (size_t)e->shape.components,
        .partial = e->run.partial != NULL ? e->run.partial : &view};
    return e->run.progress(&progress, e->run.progress_ctx);
}

/* After a round that took `seconds`: makes the next as long as the callback may wait, and calls it if
 * it is time. Rounds change no number. */
static int engine_progress(engine *e, double before)
{
    const double now = engine_clock(), seconds = now - before;
    const double most = (double)e->tasks * (ENGINE_PROGRESS_SECONDS / (seconds + 1e-9));
    e->round = most < (double)ENGINE_ROUND ? (size_t)most : ENGINE_ROUND;
    if (e->round < e->workers)
        e->round = e->workers;
    if (now - e->last_progress < ENGINE_PROGRESS_SECONDS)
        return 0;
    e->last_progress = now;
    (void)buffon_priv_record_estimate(e->out, e->record, e->run.confidence);
    return engine_tell(e);
}

/* ---- the loop ---- */

/* All blocks up to the present look. BUFFON_W_CANCELLED if the caller said so. */
static buffon_status engine_advance(engine *e)
{
    e->next_k = 0;
    e->next_cell = 0;
    while (engine_gather(e, e->round) > 0) {
        const double before = e->run.progress != NULL ? engine_clock() : 0;
        engine_round_run(e);
        const buffon_priv_worker *failure = engine_failure(e);
        if (failure != NULL)
            return failure->status;
        engine_commit(e);
        if (e->run.progress != NULL && engine_progress(e, before) != 0)
            return BUFFON_W_CANCELLED;
    }
    return BUFFON_OK;
}

/* Points of each cell at a look, in whole blocks but for the last look; 0 if the record is beyond. */
static int engine_look_at(engine *e, uint32_t j)
{
    const uint64_t block = e->shape.block;
    const int last = j + 1 >= e->shape.looks;
    uint64_t ahead = 0;
    (void)engine_targets(e, engine_look_samples(e, j), e->look); /* not more than the run's own */
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->shape); c++) {
        const uint64_t whole = (e->look[c] + block - 1) / block * block;
        const uint64_t target = e->record->target[c];
        e->look[c] = last || whole > target ? target : whole;
        ahead |= engine_extent(e->record, c) > e->look[c] ||
                 (!last && buffon_priv_cell_count(&e->record->tail, c, &e->shape) > 0);
    }
    return !ahead;
}

/* Is the tolerance met, by estimates that deserve belief? The interval rests on the central limit
 * theorem, so no single sample may carry more than a hundredth of the variance (Lindeberg's
 * condition, as far as a sample shows it); and zero spread meets no tolerance. */
static int engine_reached(const engine *e)
{
    const uint32_t fatal = BUFFON_DOUBT(BUFFON_W_NO_SPREAD) | BUFFON_DOUBT(BUFFON_W_NO_ERROR) |
                           BUFFON_DOUBT(BUFFON_W_FEW) | BUFFON_DOUBT(BUFFON_W_HEAVY_TAIL) |
                           BUFFON_DOUBT(BUFFON_W_DOMINATED);
    for (size_t k = 0; k < e->shape.components; k++) {
        const buffon_estimate *estimate = &e->out[k];
        const double size = estimate->value < 0 ? -estimate->value : estimate->value;
        const double relative = e->run.rel_tol * size;
        const double tolerance = relative > e->run.abs_tol ? relative : e->run.abs_tol;
        if ((estimate->doubts & fatal) != 0 || !((estimate->hi - estimate->lo) / 2 <= tolerance))
            return 0;
        if (estimate->interval == BUFFON_INTERVAL_STUDENT && estimate->max_share > ENGINE_LINDEBERG)
            return 0;
    }
    return 1;
}

/* The run is at an end before its target: what is done is all that was wanted. */
static void engine_conclude(engine *e)
{
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->shape); c++)
        e->record->target[c] = e->look[c];
}

/* Adds a reservation to all components. */
static buffon_status engine_reserve(engine *e, buffon_status reservation)
{
    buffon_status status = reservation;
    for (size_t k = 0; k < e->shape.components; k++) {
        buffon_estimate *estimate = &e->out[k];
        estimate->doubts |= BUFFON_DOUBT(reservation);
        if (estimate->status == BUFFON_OK || estimate->status > reservation)
            estimate->status = reservation;
        status = estimate->status < status ? estimate->status : status;
    }
    return status;
}

static buffon_status engine_loop(engine *e)
{
    buffon_status status = BUFFON_OK;
    for (uint32_t j = 0; j < e->shape.looks; j++) {
        if (!engine_look_at(e, j) && j + 1 < e->shape.looks)
            continue;
        status = engine_advance(e);
        if (status < 0)
            return status;
        const buffon_status estimate =
            buffon_priv_record_estimate(e->out, e->record, e->run.confidence);
        if (status == BUFFON_W_CANCELLED && !buffon_priv_record_complete(e->record))
            return engine_reserve(e, BUFFON_W_CANCELLED);
        status = estimate;
        if (engine_has_tolerance(e) && engine_reached(e)) {
            engine_conclude(e);
            return buffon_priv_record_estimate(e->out, e->record, e->run.confidence);
        }
    }
    if (engine_has_tolerance(e))
        status = engine_reserve(e, BUFFON_W_TOLERANCE);
    return status;
}

buffon_status buffon_priv_refuse(buffon_estimate *out, const buffon_integrand *f,
                                 buffon_status status)
{
    size_t components = f != NULL && f->components > 0 ? f->components : 1;
    if (out == NULL)
        return BUFFON_E_NULL;
    if (components > OPTIONS_COMPONENTS_MOST)
        components = 1; /* no caller has an array of that size */
    for (size_t k = 0; k < components; k++)
        out[k] = buffon_priv_estimate_failed(status);
    return status;
}

buffon_status buffon_priv_engine_run(buffon_estimate *out, const buffon_priv_problem *problem,
                                     const buffon_run *run)
{
    engine e = {.out = out};
    const buffon_priv_worker *failure;
    buffon_status status;
    if (out == NULL)
        return BUFFON_E_NULL;
    status = buffon_priv_problem_check(problem, run);
    if (status != BUFFON_OK)
        return buffon_priv_refuse(out, problem->stratum[0].f, status);
    status = engine_make(&e, problem, run);
    if (status == BUFFON_OK)
        status = engine_loop(&e);
    if (status < 0) {
        buffon_priv_refuse(out, problem->stratum[0].f, status);
        failure = e.worker != NULL ? engine_failure(&e) : NULL;
        for (size_t k = 0; failure != NULL && k < e.shape.components; k++) {
            out[k].bad_index = failure->bad_index;
            out[k].bad_stratum = failure->bad_stratum;
        }
    } else if (e.run.progress != NULL && status != BUFFON_W_CANCELLED) {
        (void)engine_tell(&e); /* there is nothing left to cancel */
    }
    engine_free(&e);
    return status;
}

/* Draws one point of a cell: what a worker does for a block, for the maths of the point alone. */
static buffon_status engine_draw(double *x, double *u, const buffon_points_block *block,
                                 const buffon_points *points, const buffon_density *g)
{
    if (points->prepare != NULL && points->prepare(block, points) != 0)
        return BUFFON_E_POINTS;
    if (points->fill(u, block, points) != 0)
        return BUFFON_E_POINTS;
    return buffon_density_sample(x, NULL, u, 1, g);
}

buffon_status buffon_priv_engine_point(double *x, const buffon_density *g, uint64_t stratum,
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
    for (size_t j = 0; status == BUFFON_OK && j < g->dim; j++)
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
    status = u != NULL && block.table != NULL ? engine_draw(x, u, &block, &points, g)
                                              : BUFFON_E_NOMEM;
    free(u);
    free(block.table);
    return status;
}
