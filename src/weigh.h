/* The primary estimate of importance sampling, y = f / g: what several estimators share. */
#ifndef BUFFON_WEIGH_H
#define BUFFON_WEIGH_H

#include "engine.h"

/** y = f / pdf at point i of a batch. 0 / 0 is 0: where f vanishes g may too. Where the pdf has
 * left the doubles its log serves. Non-zero: g is not a pdf there, or zero where f is not. */
int buffon_priv_ratio(double *y, double f, double pdf, size_t i, const buffon_priv_batch *batch);

/** The `weigh` of a problem: y = f / g for every component, or BUFFON_E_PDF. */
buffon_status buffon_priv_weigh_ratio(double *y, size_t *bad, const buffon_priv_batch *batch,
                                      const buffon_priv_problem *problem);

#endif
