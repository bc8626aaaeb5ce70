/* What a run is to do: its options with their defaults, the points of each cell, the looks at a
 * tolerance, and how that goes together with what a partial result holds already.
 */
#ifndef BUFFON_PLAN_H
#define BUFFON_PLAN_H

#include "engine.h"

/** A run before it starts. Workers read it and none writes. */
typedef struct buffon_priv_plan {
    const buffon_priv_problem *problem;
    buffon_run run; /* with its defaults */
    buffon_points points;
    buffon_priv_shape shape;
    uint64_t *target; /* [cells] points of the whole run */
    uint64_t *look;   /* [cells] points at the present look */
    void **table;     /* [cells] of the point set; those of a net have one, the first cell's */
} buffon_priv_plan;

/** Plans a run whose problem and options were found sensible: BUFFON_OK, BUFFON_E_POINTS, _SAMPLES
 * or _NOMEM. To be freed in any case. */
buffon_status buffon_priv_plan_make(buffon_priv_plan *plan, const buffon_priv_problem *problem,
                                    const buffon_run *run);
void buffon_priv_plan_free(buffon_priv_plan *plan);

/** Makes the tables of the point set: BUFFON_OK, BUFFON_E_NOMEM or BUFFON_E_POINTS. */
buffon_status buffon_priv_plan_prepare(buffon_priv_plan *plan);

/** Where block k of a cell comes from: key, index of its first point, dimension and table. */
buffon_points_block buffon_priv_plan_block(const buffon_priv_plan *plan, size_t cell, uint64_t k);

/** The point i of that block by the index that buffon_sample_at takes. */
uint64_t buffon_priv_plan_index(const buffon_priv_plan *plan, size_t cell, uint64_t k, size_t i);

/** Is a tolerance asked for? */
int buffon_priv_plan_tolerance(const buffon_priv_plan *plan);

/** The record that the run adds to: that of its partial if it is of the same run, or a fresh one.
 *  A fresh one is to take the place of the partial's, which is empty or has too few cells. */
buffon_status buffon_priv_plan_attach(buffon_priv_record **record, int *fresh,
                                      const buffon_priv_plan *plan);

/** Sets the targets of a record that may hold something already. What is done stays; but a short
 * last block that is not the last any more is forgotten, to be evaluated again as part of a whole
 * one. */
void buffon_priv_plan_extend(buffon_priv_record *record, const buffon_priv_plan *plan);

/** Sets the points of each cell at look j: whole blocks, but at the last look the target. 0 if the
 *  record is beyond it. */
int buffon_priv_plan_look(buffon_priv_plan *plan, const buffon_priv_record *record, uint32_t j);

#endif
