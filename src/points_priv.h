/* Private. What the engine asks of a point set beyond its fields. */
#ifndef BUFFON_SRC_POINTS_PRIV_H
#define BUFFON_SRC_POINTS_PRIV_H

#include <buffon/points.h>

/* Can the points serve so many strata? Replayed numbers are the same in every stratum and
 * replicate: their errors would be added as if they were independent, and are one. */
int buffon_priv_points_serve(const buffon_points *points, size_t strata);

#endif
