/* Private. Densities that are straight lines: a at 0, b at 1, a + b > 0 and finite. */
#ifndef BUFFON_SRC_RAMP_H
#define BUFFON_SRC_RAMP_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "elementary.h"

/* The height, for a and b of any unit, at the point with the mass t below it and q above. */
static inline double ramp_height(double a, double b, double t, double q)
{
    return sqrt(q * (a * a) + t * (b * b));
}

/* The point s with the mass t below it and q = 1 - t above it, and its distance c = 1 - s from 1,
 * both with all their digits. The mass below s is s (2 a + (b - a) s) / (a + b) = t. Its root is
 * (sqrt(q a^2 + t b^2) - a) / (b - a); times (sqrt(..) + a) above and below no difference is left.
 * Heights relative to their sum have squares in range. */
static inline void ramp_place(double *s, double *c, double a, double b, double t, double q)
{
    const double sum = a + b, p = a / sum, r = b / sum;
    const double root = ramp_height(p, r, t, q);
    *s = t / (p + root);
    *c = q / (r + root);
}

/* Which end is nearer, 0 or 1, and the way from there: s or -c. By arithmetic, as no predictor
 * knows which it will be. */
static inline size_t ramp_end(double *way, double s, double c)
{
    const size_t end = (size_t)!(s < c);
    const uint64_t upper = 0 - (uint64_t)end;
    *way = buffon_priv_from_bits((buffon_priv_bits(-c) & upper) | (buffon_priv_bits(s) & ~upper));
    return end;
}

/* The mass below s = 1 - c. */
static inline double ramp_mass(double a, double b, double s, double c)
{
    return s * (a * (1 + c) + b * s) / (a + b);
}

#endif
