/* Uniforms for tests of maps: of the generator's grid, with its ends and much of their
 * neighbourhood. */
#ifndef TESTS_GRID_H
#define TESTS_GRID_H

#include <buffon/rng.h>
#include <math.h>

/* One of the generator's grid: the ends first, then every fourth drawn towards an end. */
static inline double grid(buffon_rng *rng, int k)
{
    const double u = buffon_rng_next(rng);
    if (k < 4)
        return k & 1 ? 1 - 0x1p-53 : 0x1p-53;
    if (k % 4)
        return u;
    const double small = floor(ldexp(u, (int)buffon_rng_below(rng, 52))) + 0.5;
    return k % 8 ? ldexp(small, -52) : 1 - ldexp(small, -52);
}

static inline void grid_pair(double u[2], buffon_rng *rng, int k)
{
    u[0] = grid(rng, k);
    u[1] = grid(rng, k / 2);
}

#endif
