/* Private. The steps of sphere_n.c, by the kernels of sphere.c. */
#ifndef BUFFON_SRC_SPHERE_PRIV_H
#define BUFFON_SRC_SPHERE_PRIV_H

#include <stddef.h>

/* Of r uniform coordinates whose squares sum to rest[i] the first two, and what they leave: with
 * `power` 2 / (r - 2), 1 at most, they take the share 1 - (1 - u1)^power of it, in the direction
 * 2 pi u2. The sum of the squares of two of r is above the share s with probability
 * (1 - s)^(r/2 - 1): a beta law whose quantile is in closed form. */
void buffon_priv_sphere_pair(double *x, double *y, double *rest, const double *u1,
                             const double *u2, size_t n, double power);

/* Two coordinates of which the sum of the squares is known, in the direction 2 pi turn. */
void buffon_priv_sphere_circle(double *x, double *y, const double *square, const double *turn,
                               size_t n);

#endif
