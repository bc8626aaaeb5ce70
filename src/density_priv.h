/* Private. What the densities share, and what the engine asks of any density. */
#ifndef BUFFON_SRC_DENSITY_PRIV_H
#define BUFFON_SRC_DENSITY_PRIV_H

#include <buffon/density.h>

#include "elementary.h"
#include "mix.h"

/* 1 / pi, which is also 1 / (2 pi) and 1 / (4 pi) but for the exponent. */
#define DENSITY_INV_PI 0x1.45f306dc9c883p-2

/* 1 / sqrt(2 pi), and the logarithm of its inverse. */
#define DENSITY_INV_SQRT_2PI 0x1.9884533d43651p-2
#define DENSITY_LOG_SQRT_2PI 0x1.d67f1c864beb5p-1

/* Mixes all that a density depends on, as far as the library can see it. */
uint64_t buffon_priv_density_identity(uint64_t mix, const buffon_density *g);

/* What a function of a table of operations returned, as a status: the library's own say more than
 * that they failed. */
buffon_status buffon_priv_density_result(int result);

/* Whether g can be had: it has the operation `pdf`, and so have the parts of a product. */
int buffon_priv_density_has_pdf(const buffon_density *g);

/* Mixes n numbers. */
static inline uint64_t density_mix(uint64_t mix, const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        mix = buffon_priv_mix_double(mix, x[i]);
    return mix;
}

static inline void density_fill(double *x, double value, size_t n)
{
    for (size_t i = 0; i < n; i++)
        x[i] = value;
}

/* The nearest point of an interval. */
static inline double density_held(double x, double least, double most)
{
    return x < least ? least : x > most ? most : x;
}

/* A uniform that was found by inversion, moved off the ends that rounding may have led it to: to
 * the outermost of those that the generator makes. */
static inline double density_open(double u)
{
    return density_held(u, 0x1p-53, 1 - 0x1p-53);
}

/* The same for laws whose small uniforms count: off 0 and 1 by as little as there is. */
static inline double density_inside(double u)
{
    return density_held(u, 0x1p-1074, 1 - 0x1p-53);
}

/* Where points between lo and hi are held: by the neighbours of these, as far as there are any, as
 * rounding may lead to a bound. */
static inline void density_inner(double *least, double *most, double lo, double hi)
{
    const double up = buffon_priv_nextup(lo), down = buffon_priv_nextdown(hi);
    *least = up < hi ? up : lo;
    *most = up < hi ? down : hi;
}

#endif
