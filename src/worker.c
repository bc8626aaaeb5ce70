#include "guard.h"

#include <stdlib.h>
#include <string.h>

#include "box.h"
#include "density_priv.h"
#include "exact.h"
#include "worker.h"

#define WORKER_LINE 8 /* doubles of a cache line; each array of a block begins with one */

/* The most uniforms, coordinates and components of any stratum; of coordinates those that do not
 * lie where their uniforms were. */
typedef struct worker_sizes {
    size_t uniforms, dim, apart, components;
} worker_sizes;

static worker_sizes worker_measure(const buffon_priv_problem *problem)
{
    worker_sizes most = {0, 0, 0, 0};
    for (size_t s = 0; s < problem->strata; s++) {
        const buffon_priv_stratum *stratum = &problem->stratum[s];
        const size_t uniforms = stratum->g->uniforms + problem->extra;
        most.uniforms = uniforms > most.uniforms ? uniforms : most.uniforms;
        const size_t apart = buffon_priv_box_is(stratum->g) ? 0 : stratum->g->dim;
        most.dim = stratum->g->dim > most.dim ? stratum->g->dim : most.dim;
        most.apart = apart > most.apart ? apart : most.apart;
        most.components = stratum->f->components > 0 ? stratum->f->components : 1;
    }
    return most;
}

buffon_status buffon_priv_worker_make(buffon_priv_worker *worker, const buffon_priv_plan *plan,
                                      size_t n)
{
    const buffon_priv_problem *problem = plan->problem;
    const buffon_priv_shape *shape = &plan->shape;
    const worker_sizes most = worker_measure(problem);
    const size_t outputs = (size_t)shape->outputs, series = buffon_priv_shape_series(shape);
    /* Sums cannot wrap: uniforms and dim are below 2^32, the rest below 2^20. */
    const size_t rows[] = {most.uniforms,      most.apart,
                           problem->pdf != 0,  most.components,
                           problem->p != NULL, problem->weigh != NULL ? outputs : 0,
                           series - outputs};
    double **const arrays[] = {&worker->u, &worker->apart, &worker->pdf, &worker->f,
                               &worker->p, &worker->y,     &worker->pair};
    const size_t count = sizeof rows / sizeof *rows;
    size_t all = WORKER_LINE;
    memset(worker, 0, sizeof *worker);
    worker->plan = plan;
    for (size_t i = 0; i < count; i++) {
        if (rows[i] > SIZE_MAX / 16 / sizeof(double) / n - all / n - 1)
            return BUFFON_E_NOMEM;
        all += rows[i] * n + WORKER_LINE;
    }
    worker->memory = malloc((all + WORKER_LINE * most.dim) * sizeof(double));
    worker->moments = calloc(series, sizeof *worker->moments);
    if (worker->memory == NULL || worker->moments == NULL ||
        buffon_priv_cells_make(&worker->whole, shape) != 0 ||
        buffon_priv_cells_make(&worker->tail, shape) != 0) {
        buffon_priv_worker_free(worker);
        return BUFFON_E_NOMEM;
    }
    worker->row = worker->memory;
    double *at = worker->memory + WORKER_LINE * most.dim;
    at += WORKER_LINE - ((uintptr_t)at / sizeof(double)) % WORKER_LINE;
    for (size_t i = 0; i < count; i++) {
        *arrays[i] = at;
        at += (rows[i] * n + WORKER_LINE - 1) / WORKER_LINE * WORKER_LINE;
    }
    return BUFFON_OK;
}

void buffon_priv_worker_free(buffon_priv_worker *worker)
{
    free(worker->memory);
    free(worker->moments);
    buffon_priv_cells_free(&worker->whole);
    buffon_priv_cells_free(&worker->tail);
    worker->memory = NULL;
    worker->moments = NULL;
}

/* f[components * n] at x[dim * n]. A function of one point gets the points of a cache line at a
 * time: the lines of many coordinates lie pages apart, and the cache keeps few of those. */
static buffon_status worker_integrand(buffon_priv_worker *worker, double *f,
                                      const buffon_integrand *integrand, size_t n)
{
    const double *x = worker->x;
    const size_t dim = integrand->dim;
    if (integrand->batch != NULL)
        return integrand->batch(f, x, n, integrand->ctx) == 0 ? BUFFON_OK : BUFFON_E_STOPPED;
    for (size_t i = 0; i < n; i += WORKER_LINE) {
        const size_t some = n - i < WORKER_LINE ? n - i : WORKER_LINE;
        for (size_t j = 0; j < dim; j++) {
            for (size_t k = 0; k < some; k++)
                worker->row[k * dim + j] = x[j * n + i + k];
        }
        for (size_t k = 0; k < some; k++)
            f[i + k] = integrand->scalar(worker->row + k * dim, integrand->ctx);
    }
    return BUFFON_OK;
}

/* The lowest of the points that a density which failed made NaN; 0 if it told none. */
static size_t worker_first_nan(const double *x, size_t dim, size_t n)
{
    size_t lowest = n;
    for (size_t j = 0; j < dim; j++) {
        for (size_t i = 0; i < lowest; i++)
            lowest = x[j * n + i] != x[j * n + i] ? i : lowest;
    }
    return lowest < n ? lowest : 0;
}

/* From a block of the point set to outputs y, NULL if it did not come to them; *bad is the lowest
 * point that failed. */
static buffon_status worker_evaluate(buffon_priv_worker *worker, const buffon_priv_task *task,
                                     const double **y, size_t *bad)
{
    const buffon_priv_plan *plan = worker->plan;
    const buffon_priv_problem *problem = plan->problem;
    const size_t stratum = task->cell / (size_t)plan->shape.per_stratum;
    const buffon_density *g = problem->stratum[stratum].g;
    double *x = buffon_priv_box_is(g) ? worker->u : worker->apart;
    buffon_points_block block = buffon_priv_plan_block(plan, task->cell, task->k);
    const buffon_priv_batch batch = {.n = task->n,
                                     .x = x,
                                     .pdf = worker->pdf,
                                     .extra = worker->u + g->uniforms * task->n,
                                     .f = worker->f,
                                     .p = worker->p,
                                     .point = worker->row,
                                     .g = g};
    buffon_status status;
    *bad = 0;
    *y = NULL;
    worker->x = x;
    block.n = task->n;
    if (plan->points.fill(worker->u, &block, &plan->points) != 0)
        return BUFFON_E_POINTS;
    status = buffon_priv_density_result(
        g->ops->sample(x, problem->pdf ? worker->pdf : NULL, worker->u, task->n, g));
    if (status != BUFFON_OK) {
        *bad = worker_first_nan(x, g->dim, task->n);
        return status;
    }
    status = worker_integrand(worker, worker->f, problem->stratum[stratum].f, task->n);
    if (status == BUFFON_OK && problem->p != NULL)
        status = worker_integrand(worker, worker->p, problem->p, task->n);
    if (status != BUFFON_OK)
        return status;
    *y = problem->weigh != NULL ? worker->y : worker->f;
    if (problem->weigh == NULL)
        return BUFFON_OK;
    return problem->weigh(worker->y, bad, &batch, problem);
}

/* Sees to values that are not finite, up to the point `end` where something else failed: the lowest
 * point that has one, or end if by option they count as zero. */
static size_t worker_nonfinite(buffon_priv_worker *worker, double *y, size_t n, size_t end,
                               uint64_t *replaced)
{
    const buffon_priv_plan *plan = worker->plan;
    size_t lowest = end;
    for (size_t k = 0; k < plan->shape.outputs; k++) {
        for (size_t i = 0; i < end; i++) {
            double *value = &y[k * n + i];
            if (*value - *value == 0)
                continue;
            if (plan->run.on_nonfinite == BUFFON_NONFINITE_ERROR) {
                lowest = i < lowest ? i : lowest;
                break;
            }
            *value = 0;
            replaced[k]++;
        }
    }
    return lowest;
}

/* Means and half differences of the pairs of each output, behind one another. */
static void worker_pairs(buffon_priv_worker *worker, const double *y, size_t n)
{
    const buffon_priv_shape *shape = &worker->plan->shape;
    const size_t outputs = (size_t)shape->outputs, half = n / 2;
    const int differences = buffon_priv_shape_variants(shape) > 2;
    for (size_t k = 0; k < outputs; k++) {
        const double *row = y + k * n;
        double *mean = worker->pair + k * half, *difference = worker->pair + (outputs + k) * half;
        for (size_t i = 0; i < half; i++) {
            mean[i] = 0.5 * row[2 * i] + 0.5 * row[2 * i + 1];
            if (differences)
                difference[i] = 0.5 * row[2 * i] - 0.5 * row[2 * i + 1];
        }
    }
}

/* The values of a series of the block, and their number. */
static const double *worker_series(const buffon_priv_worker *worker, const double *y, size_t n,
                                   size_t s, size_t *count)
{
    const size_t outputs = (size_t)worker->plan->shape.outputs;
    *count = s < outputs ? n : n / 2;
    return s < outputs ? y + s * n : worker->pair + (s - outputs) * (n / 2);
}

static void worker_add_cross(buffon_priv_worker *worker, const buffon_priv_cells *cells,
                             size_t cell, const double *y, size_t n)
{
    const buffon_priv_shape *shape = &worker->plan->shape;
    const size_t outputs = (size_t)shape->outputs;
    uint64_t *cross = cells->cross + cell * buffon_priv_shape_cross(shape);
    for (size_t v = 0; v < buffon_priv_shape_variants(shape); v++) {
        for (size_t b = 1; b < outputs; b++) {
            for (size_t a = 0; a < b; a++) {
                const buffon_priv_moments *ma = &worker->moments[v * outputs + a];
                const buffon_priv_moments *mb = &worker->moments[v * outputs + b];
                size_t count;
                const double *ya = worker_series(worker, y, n, v * outputs + a, &count);
                const double *yb = worker_series(worker, y, n, v * outputs + b, &count);
                const double q = buffon_priv_cross_block(ya, yb, count, ma, mb);
                buffon_priv_cross_add(cross + buffon_priv_shape_cross_at(shape, v, a, b), ma, mb,
                                      q);
            }
        }
    }
}

/* Adds the block's values to its cell. `replaced` counts, for each output, values set to zero. */
static void worker_add(buffon_priv_worker *worker, const buffon_priv_task *task, const double *y,
                       const uint64_t *replaced)
{
    const buffon_priv_shape *shape = &worker->plan->shape;
    const size_t series = buffon_priv_shape_series(shape);
    const buffon_priv_cells *cells = task->n == shape->block ? &worker->whole : &worker->tail;
    buffon_stats *stats = cells->stats + task->cell * series;
    for (size_t s = 0; s < series; s++) {
        size_t count;
        const double *values = worker_series(worker, y, task->n, s, &count);
        if (s >= shape->outputs) /* the outputs' own are there already */
            (void)buffon_priv_moments_block(&worker->moments[s], values, count);
        buffon_priv_stats_add_block(&stats[s], &worker->moments[s], values);
        if (replaced != NULL && s < shape->outputs)
            stats[s].nonfinite += replaced[s];
    }
    if (shape->covariance)
        worker_add_cross(worker, cells, task->cell, y, task->n);
}

static int worker_finite(buffon_priv_worker *worker, const double *y, size_t n)
{
    for (size_t k = 0; k < worker->plan->shape.outputs; k++) {
        if (buffon_priv_moments_block(&worker->moments[k], y + k * n, n) != n)
            return 0;
    }
    return 1;
}

/* The way of a block in which something is wrong: finds the lowest point that fails, or mends. */
static buffon_status worker_doubtful(buffon_priv_worker *worker, const buffon_priv_task *task,
                                     double *y, buffon_status status, size_t *bad)
{
    const size_t outputs = (size_t)worker->plan->shape.outputs;
    const size_t end = status == BUFFON_OK ? task->n : *bad;
    uint64_t *replaced = calloc(outputs, sizeof *replaced);
    size_t lowest;
    *bad = 0;
    if (replaced == NULL)
        return BUFFON_E_NOMEM;
    lowest = worker_nonfinite(worker, y, task->n, end, replaced);
    if (lowest == task->n) {
        (void)worker_finite(worker, y, task->n);
        if (buffon_priv_shape_variants(&worker->plan->shape) > 1)
            worker_pairs(worker, y, task->n);
        worker_add(worker, task, y, replaced);
    }
    free(replaced);
    *bad = lowest;
    if (lowest < end)
        return BUFFON_E_NONFINITE;
    return status;
}

buffon_status buffon_priv_worker_block(buffon_priv_worker *worker, const buffon_priv_task *task)
{
    const buffon_priv_shape *shape = &worker->plan->shape;
    const double *y = NULL;
    size_t bad = 0;
    buffon_status status = worker_evaluate(worker, task, &y, &bad);
    if (status == BUFFON_OK && worker_finite(worker, y, task->n)) {
        if (buffon_priv_shape_variants(shape) > 1)
            worker_pairs(worker, y, task->n);
        worker_add(worker, task, y, NULL);
        return BUFFON_OK;
    }
    if (y != NULL && (status == BUFFON_OK || bad > 0))
        status =
            worker_doubtful(worker, task, y == worker->f ? worker->f : worker->y, status, &bad);
    if (status == BUFFON_E_POINTS || status == BUFFON_E_NOMEM) {
        worker->bad_index = UINT64_MAX; /* neither the integrand's nor the density's */
    } else if (status != BUFFON_OK) {
        worker->bad_index = buffon_priv_plan_index(worker->plan, task->cell, task->k, bad);
        worker->bad_stratum = task->cell / shape->per_stratum;
    }
    return status;
}
