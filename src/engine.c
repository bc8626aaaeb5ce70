#include "guard.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "engine.h"
#include "options.h"
#include "parallel.h"
#include "plan.h"
#include "worker.h"

#define ENGINE_ROUND 1024           /* blocks handed to the workers at a time, at most */
#define ENGINE_SHARES 8             /* in which a worker takes its part of what is left */
#define ENGINE_ALONE_SECONDS 1e-3   /* of a run, before threads are started for it */
#define ENGINE_PROGRESS_SECONDS 0.1 /* between calls of the progress callback */
#define ENGINE_LINDEBERG 0.02       /* the largest share of one sample where a tolerance is met */

/* A run under way. */
typedef struct engine {
    buffon_priv_plan plan;
    buffon_estimate *out;
    buffon_priv_record *record;
    int own_record; /* no partial holds it */
    buffon_priv_worker *worker;
    size_t workers, wanted; /* there are; there are to be when the first millisecond is over */
    size_t points;          /* of the largest block: for these a worker has memory */
    double alone_until;     /* by engine_clock */
    buffon_priv_team *team;
    buffon_priv_task *task;    /* of the present round */
    size_t tasks, round, room; /* there are, and at most; the array's */
    uint64_t next_k;           /* where the next round looks for blocks */
    size_t next_cell;
    double last_progress;
    atomic_size_t next_task; /* the first that no worker has taken */
    atomic_size_t end_task;  /* none is done from here on */
} engine;

static double engine_clock(void)
{
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- memory ---- */

static void engine_free(engine *e)
{
    buffon_priv_team_stop(e->team);
    for (size_t i = 0; e->worker != NULL && i < e->workers; i++)
        buffon_priv_worker_free(&e->worker[i]);
    free(e->worker);
    free(e->task);
    buffon_priv_plan_free(&e->plan);
    if (e->own_record)
        buffon_priv_record_free(e->record);
}

/* A sample keeps its largest values. In the end those are not among them that are below all that
 * `others` keep of a cell, with which a worker's will be merged. A worker that has no values yet is
 * spared them: its list is filled with the least of the others'. That these are merged too does no
 * harm, since as many values that are no less are there. */
static void engine_raise_bar(const buffon_priv_cells *cells, const buffon_priv_cells *others,
                             size_t cell, const buffon_priv_shape *shape)
{
    const size_t series = buffon_priv_shape_series(shape);
    for (size_t s = cell * series; s < (cell + 1) * series; s++) {
        for (size_t i = 0; i < BUFFON_STATS_TOP; i++)
            cells->stats[s].top[i] = others->stats[s].top[BUFFON_STATS_TOP - 1];
    }
}

/* Makes workers until there are n: BUFFON_OK, or BUFFON_E_NOMEM and fewer. */
static buffon_status engine_hire(engine *e, size_t n)
{
    buffon_status status = BUFFON_OK;
    while (e->workers < n) {
        buffon_priv_worker *worker = &e->worker[e->workers];
        status = buffon_priv_worker_make(worker, &e->plan, e->points);
        if (status != BUFFON_OK)
            break;
        for (size_t c = 0; c < buffon_priv_shape_cells(&e->plan.shape); c++)
            engine_raise_bar(&worker->whole, &e->worker[0].whole, c, &e->plan.shape);
        e->workers++;
    }
    return status;
}

static buffon_status engine_allocate(engine *e)
{
    uint64_t blocks = 0, longest = 0;
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->plan.shape); c++) {
        /* A record may want more than this run: a gap before blocks that are done. */
        const uint64_t here = e->record->target[c];
        const uint64_t n = e->plan.target[c] > here ? e->plan.target[c] : here;
        blocks += (n + e->plan.shape.block - 1) / e->plan.shape.block;
        longest = n > longest ? n : longest;
    }
    e->points = (size_t)(longest < e->plan.shape.block ? longest : e->plan.shape.block);
    e->room = blocks < ENGINE_ROUND ? (size_t)blocks : ENGINE_ROUND;
    e->wanted = e->room < e->plan.run.threads ? e->room : e->plan.run.threads;
    if (e->wanted == 0)
        return BUFFON_E_SAMPLES; /* there is no run without a block */
    /* The first round shows how long a block takes, if anybody is waiting to hear. */
    e->round = e->plan.run.progress != NULL ? e->wanted : e->room;
    e->task = malloc(e->room * sizeof *e->task);
    e->worker = calloc(e->wanted, sizeof *e->worker);
    if (e->task == NULL || e->worker == NULL)
        return BUFFON_E_NOMEM;
    /* The caller's own worker, or all that his executor may use. */
    if (engine_hire(e, e->plan.run.executor != NULL ? e->wanted : 1) != BUFFON_OK)
        return BUFFON_E_NOMEM;
    return buffon_priv_plan_prepare(&e->plan);
}

static buffon_status engine_make(engine *e, const buffon_priv_problem *problem,
                                 const buffon_run *run)
{
    int fresh = 0;
    buffon_status status = buffon_priv_plan_make(&e->plan, problem, run);
    if (status == BUFFON_OK)
        status = buffon_priv_plan_attach(&e->record, &fresh, &e->plan);
    e->own_record = fresh;
    if (status == BUFFON_OK)
        status = engine_allocate(e);
    if (status != BUFFON_OK)
        return status;
    buffon_priv_plan_extend(e->record, &e->plan); /* from here on nothing is refused */
    if (fresh && e->plan.run.partial != NULL) {
        buffon_priv_record_free(buffon_priv_partial_record(e->plan.run.partial));
        e->plan.run.partial->more = e->record;
        e->own_record = 0;
    }
    return BUFFON_OK;
}

/* ---- rounds ---- */

/* Blocks of a cell up to the present look. */
static uint64_t engine_blocks(const engine *e, size_t cell)
{
    const uint64_t block = e->plan.shape.block, points = e->plan.look[cell];
    return points / block + (points % block != 0);
}

/* Gathers the next blocks that are to do: block 0 of every cell, block 1 of every cell, ... so that
 * any prefix has some of each. Returns their number. */
static size_t engine_gather(engine *e, size_t most)
{
    const buffon_priv_record *record = e->record;
    const size_t cells = buffon_priv_shape_cells(&e->plan.shape);
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
            e->plan.run.parts == 0 || buffon_priv_record_owner(record, c, k) == e->plan.run.part;
        if (k < engine_blocks(e, c) && mine && !buffon_priv_record_has(record, c, k)) {
            const uint64_t left = record->target[c] - k * e->plan.shape.block;
            e->task[e->tasks++] = (buffon_priv_task){
                .k = k,
                .cell = c,
                .n = (size_t)(left < e->plan.shape.block ? left : e->plan.shape.block)};
        }
        if (++e->next_cell == cells) {
            e->next_cell = 0;
            e->next_k++;
        }
    }
    return e->tasks;
}

/* A worker takes the next n tasks and does them. Tasks are taken in order, and one that is taken is
 * done unless one before it has failed: so all before the lowest failure have been tried, and it
 * does not depend on the threads. */
static void engine_do(engine *e, buffon_priv_worker *worker, size_t n)
{
    const size_t first = atomic_fetch_add_explicit(&e->next_task, n, memory_order_relaxed);
    size_t end = atomic_load_explicit(&e->end_task, memory_order_relaxed);
    for (size_t t = first; t < first + n && t < end; t++) {
        const buffon_status status = buffon_priv_worker_block(worker, &e->task[t]);
        end = atomic_load_explicit(&e->end_task, memory_order_relaxed);
        if (status == BUFFON_OK)
            continue;
        worker->status = status;
        worker->task = t;
        while (t < end && !atomic_compare_exchange_weak(&e->end_task, &end, t))
            continue;
    }
}

/* Tasks that no worker has taken. */
static size_t engine_left(engine *e)
{
    const size_t next = atomic_load_explicit(&e->next_task, memory_order_relaxed);
    const size_t end = atomic_load_explicit(&e->end_task, memory_order_relaxed);
    return next < end ? end - next : 0;
}

/* Several tasks at a time, so that workers seldom meet at the counter, but ever fewer, so that they
 * end together. */
static void engine_work(size_t i, void *arg)
{
    engine *e = arg;
    for (size_t left = engine_left(e); left > 0; left = engine_left(e))
        engine_do(e, &e->worker[i], 1 + left / (ENGINE_SHARES * e->workers));
}

/* For the first millisecond of a run the caller's thread works alone: a run that ends in it would
 * only lose by threads. Now and then, ever more rarely, it looks at the clock. Then memory and
 * threads are had for all that is wanted; what cannot be had is done without. */
static void engine_begin(engine *e)
{
    for (size_t left = engine_left(e); left > 0 && engine_clock() < e->alone_until;
         left = engine_left(e))
        engine_do(e, &e->worker[0], 1 + (e->tasks - left) / ENGINE_SHARES);
    if (engine_left(e) < 2)
        return;
    (void)engine_hire(e, e->wanted);
    e->wanted = e->workers;
    e->team = buffon_priv_team_start(e->workers - 1);
}

/* The tasks of the round on as many workers as there are. */
static void engine_round_run(engine *e)
{
    const size_t workers = e->tasks < e->workers ? e->tasks : e->workers;
    atomic_store(&e->next_task, 0);
    atomic_store(&e->end_task, e->tasks);
    if (e->plan.run.executor != NULL) {
        e->plan.run.executor(workers, engine_work, e, e->plan.run.executor_ctx);
        engine_work(0, e); /* what an executor that ended early left */
        return;
    }
    if (e->workers < e->wanted)
        engine_begin(e);
    buffon_priv_team_run(engine_left(e) > 1 ? e->team : NULL, engine_work, e);
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

/* Empties a worker's sums into the record's. */
static void engine_merge_cells(engine *e, const buffon_priv_cells *into,
                               const buffon_priv_cells *from)
{
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->plan.shape); c++) {
        if (buffon_priv_cell_count(from, c, &e->plan.shape) > 0) {
            buffon_priv_cell_merge(into, from, c, &e->plan.shape);
            buffon_priv_cell_clear(from, c, &e->plan.shape);
            engine_raise_bar(from, into, c, &e->plan.shape);
        }
    }
}

/* Adds what the workers have to the record. */
static void engine_commit(engine *e)
{
    buffon_priv_record *record = e->record;
    const size_t cells = buffon_priv_shape_cells(&e->plan.shape);
    for (size_t i = 0; i < e->workers; i++) {
        engine_merge_cells(e, &record->whole, &e->worker[i].whole);
        engine_merge_cells(e, &record->tail, &e->worker[i].tail);
    }
    for (size_t t = 0; t < e->tasks; t++) {
        const buffon_priv_task *task = &e->task[t];
        if (task->n == e->plan.shape.block)
            record->done[buffon_priv_record_owner(record, task->cell, task->k) * cells +
                         task->cell]++;
    }
}

/* ---- progress ---- */

/* Points that this run, or this part of it, is to have in the end. */
static uint64_t engine_total(const engine *e)
{
    const buffon_priv_record *record = e->record;
    const uint64_t block = e->plan.shape.block;
    uint64_t total = 0;
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->plan.shape); c++) {
        const uint64_t blocks = record->target[c] / block, rest = record->target[c] % block;
        if (e->plan.run.parts == 0) {
            total += record->target[c];
            continue;
        }
        total += buffon_priv_record_owned(record, e->plan.run.part, c, blocks) * block;
        if (buffon_priv_record_owner(record, c, blocks) == e->plan.run.part)
            total += rest;
    }
    return total;
}

/* Tells the caller how far the run is; non-zero if he cancels it. */
static int engine_tell(const engine *e)
{
    buffon_partial view = {{0}, e->record};
    const buffon_progress progress = {.done = buffon_priv_record_points(e->record),
                                      .total = engine_total(e),
                                      .estimate = e->out,
                                      .components = (size_t)e->plan.shape.components,
                                      .partial = e->plan.run.partial != NULL ? e->plan.run.partial
                                                                             : &view};
    return e->plan.run.progress(&progress, e->plan.run.progress_ctx);
}

/* After a round that took `seconds`: makes the next as long as the callback may wait, and calls it
 * if it is time. Rounds change no number. */
static int engine_progress(engine *e, double before)
{
    const double now = engine_clock(), seconds = now - before;
    const double most = (double)e->tasks * (ENGINE_PROGRESS_SECONDS / (seconds + 1e-9));
    e->round = most < (double)e->room ? (size_t)most : e->room;
    if (e->round < e->wanted)
        e->round = e->wanted;
    if (now - e->last_progress < ENGINE_PROGRESS_SECONDS)
        return 0;
    e->last_progress = now;
    (void)buffon_priv_record_estimate(e->out, e->record, e->plan.run.confidence);
    return engine_tell(e);
}

/* ---- the loop ---- */

/* All blocks up to the present look. BUFFON_W_CANCELLED if the caller said so. */
static buffon_status engine_advance(engine *e)
{
    e->next_k = 0;
    e->next_cell = 0;
    while (engine_gather(e, e->round) > 0) {
        const double before = e->plan.run.progress != NULL ? engine_clock() : 0;
        engine_round_run(e);
        const buffon_priv_worker *failure = engine_failure(e);
        if (failure != NULL)
            return failure->status;
        engine_commit(e);
        if (e->plan.run.progress != NULL && engine_progress(e, before) != 0)
            return BUFFON_W_CANCELLED;
    }
    return BUFFON_OK;
}

/* Is the tolerance met, by estimates that deserve belief? The interval rests on the central limit
 * theorem, so no single sample may carry more than a fiftieth of the variance (Lindeberg's
 * condition, as far as a sample shows it); and zero spread meets no tolerance. */
static int engine_reached(const engine *e)
{
    const uint32_t fatal = BUFFON_DOUBT(BUFFON_W_NO_SPREAD) | BUFFON_DOUBT(BUFFON_W_NO_ERROR) |
                           BUFFON_DOUBT(BUFFON_W_FEW) | BUFFON_DOUBT(BUFFON_W_HEAVY_TAIL) |
                           BUFFON_DOUBT(BUFFON_W_DOMINATED);
    for (size_t k = 0; k < e->plan.shape.components; k++) {
        const buffon_estimate *estimate = &e->out[k];
        const double size = estimate->value < 0 ? -estimate->value : estimate->value;
        const double relative = e->plan.run.rel_tol * size;
        const double tolerance = relative > e->plan.run.abs_tol ? relative : e->plan.run.abs_tol;
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
    for (size_t c = 0; c < buffon_priv_shape_cells(&e->plan.shape); c++)
        e->record->target[c] = e->plan.look[c];
}

/* Adds a reservation to all components. */
static buffon_status engine_reserve(engine *e, buffon_status reservation)
{
    buffon_status status = reservation;
    for (size_t k = 0; k < e->plan.shape.components; k++) {
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
    e->alone_until = e->workers < e->wanted ? engine_clock() + ENGINE_ALONE_SECONDS : 0;
    for (uint32_t j = 0; j < e->plan.shape.looks; j++) {
        if (!buffon_priv_plan_look(&e->plan, e->record, j) && j + 1 < e->plan.shape.looks)
            continue;
        status = engine_advance(e);
        if (status < 0)
            return status;
        const buffon_status estimate =
            buffon_priv_record_estimate(e->out, e->record, e->plan.run.confidence);
        if (status == BUFFON_W_CANCELLED && !buffon_priv_record_complete(e->record))
            return engine_reserve(e, BUFFON_W_CANCELLED);
        status = estimate;
        if (buffon_priv_plan_tolerance(&e->plan) && engine_reached(e)) {
            engine_conclude(e);
            return buffon_priv_record_estimate(e->out, e->record, e->plan.run.confidence);
        }
    }
    if (buffon_priv_plan_tolerance(&e->plan))
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

buffon_status buffon_priv_engine_check(const buffon_priv_problem *problem, const buffon_run *run)
{
    buffon_status status = buffon_priv_problem_check(problem, run);
    engine e = {.out = NULL};
    int fresh = 0;
    if (status != BUFFON_OK)
        return status;
    status = buffon_priv_plan_make(&e.plan, problem, run);
    if (status == BUFFON_OK)
        status = buffon_priv_plan_attach(&e.record, &fresh, &e.plan);
    e.own_record = fresh;
    engine_free(&e);
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
        for (size_t k = 0; failure != NULL && k < e.plan.shape.components; k++) {
            out[k].bad_index = failure->bad_index;
            out[k].bad_stratum = failure->bad_stratum;
        }
    } else if (e.plan.run.progress != NULL && status != BUFFON_W_CANCELLED) {
        (void)engine_tell(&e); /* there is nothing left to cancel */
    }
    engine_free(&e);
    return status;
}
