/* Private. Maps of the unit square to circles and disks, a batch at a time: all the trigonometry of
 * the densities is here.
 */
#ifndef BUFFON_SRC_CIRCLE_H
#define BUFFON_SRC_CIRCLE_H

#include <stddef.h>

/* Points that a density works on at a time, so that they stay in the first cache. */
#define CIRCLE_TILE 256

/* The largest radius in the unit disk: far enough from 1 that no rounding of sines, products and
 * their squares leads x^2 + y^2 past 1. */
#define CIRCLE_RIM (1 - 0x1p-50)

/* cos(2 pi t) and sin(2 pi t), each within 1.5 ulp; t may be c or s. */
void buffon_priv_circle(double *c, double *s, const double *t, size_t n);

/* t in (0, 1) such that the point lies in the direction 2 pi t. */
double buffon_priv_circle_invert(double x, double y);

/* The concentric map of the unit square to the unit disk: see buffon_disk_concentric. */
void buffon_priv_concentric(double *restrict x, double *restrict y, const double *restrict u1,
                            const double *restrict u2, size_t n);
void buffon_priv_concentric_invert(double u[2], double x, double y);

#endif
