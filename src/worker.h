/* One worker: evaluates blocks into cells of its own. */
#ifndef BUFFON_WORKER_H
#define BUFFON_WORKER_H

#include "moments.h"
#include "plan.h"

/** Block k of a cell: points k block, ..., n of them. */
typedef struct buffon_priv_task {
    uint64_t k;
    size_t cell;
    size_t n;
} buffon_priv_task;

typedef struct buffon_priv_worker {
    const buffon_priv_plan *plan;
    double *memory; /* that the arrays below are cut from */
    double *u, *apart, *pdf, *f, *p, *y, *pair, *row;
    const double *x; /* the points of the block: in u or in apart */
    buffon_priv_moments *moments; /* [series] */
    buffon_priv_cells whole, tail;
    /* The first failure, if status < 0. */
    buffon_status status;
    size_t task;
    uint64_t bad_index, bad_stratum;
} buffon_priv_worker;

/** Gives a worker its memory for blocks of at most n points: BUFFON_OK or BUFFON_E_NOMEM. */
buffon_status buffon_priv_worker_make(buffon_priv_worker *worker, const buffon_priv_plan *plan,
                                      size_t n);
void buffon_priv_worker_free(buffon_priv_worker *worker);

/** Evaluates a block and adds it to the worker's cells; on failure nothing is added. */
buffon_status buffon_priv_worker_block(buffon_priv_worker *worker, const buffon_priv_task *task);

#endif
