/* Checks of what a caller hands to an estimator, and the defaults of what he leaves out. */
#ifndef BUFFON_OPTIONS_H
#define BUFFON_OPTIONS_H

#include "engine.h"

/** The most components of an integrand. */
#define OPTIONS_COMPONENTS_MOST ((size_t)1 << 20)

/** The options with every default filled in but points; NULL is all defaults. */
buffon_run buffon_priv_run_defaults(const buffon_run *run);

/** Are the options sensible? Looks at nothing but the options. */
buffon_status buffon_priv_run_check(const buffon_run *run);

/** Are the densities, integrands and options of a problem sensible together? */
buffon_status buffon_priv_problem_check(const buffon_priv_problem *problem, const buffon_run *run);

/** Is this a usable integrand of a dimension (0: any)? */
buffon_status buffon_priv_integrand_check(const buffon_integrand *f, size_t dim);

/** Is this a usable point set for a dimension? */
buffon_status buffon_priv_points_check(const buffon_points *points, size_t dim);

/** The number that tells runs apart whose partial results must not mix. */
uint64_t buffon_priv_problem_identity(const buffon_priv_problem *problem, const buffon_run *run,
                                      const buffon_points *points);

#endif
