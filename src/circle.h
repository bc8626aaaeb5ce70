/* Private. From points of circles and disks back to uniforms; lanes_circle.h has the way there. */
#ifndef BUFFON_SRC_CIRCLE_H
#define BUFFON_SRC_CIRCLE_H

#include <stddef.h>

/* The largest radius in the unit disk: far enough from 1 that no rounding of sines, products and
 * their squares leads x^2 + y^2 past 1. */
#define CIRCLE_RIM (1 - 0x1p-50)

/* t in (0, 1) such that the point lies in the direction 2 pi t. */
double buffon_priv_circle_invert(double x, double y);

/* The uniforms that the concentric map takes to a point of the unit disk. */
void buffon_priv_concentric_invert(double u[2], double x, double y);

#endif
