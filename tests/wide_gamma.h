/* Parts of the gamma function in extended precision. */
#ifndef TESTS_WIDE_GAMMA_H
#define TESTS_WIDE_GAMMA_H

#include <math.h>

typedef long double wide;

#define WIDE_LOG_2PI 1.837877066409345483560659472811235279722794947275566825634L

/* Stirling's series with an error of 1e-21 from 40 up. */
static inline wide wide_stirling(wide z)
{
    static const wide c[] = {1 / 12.0L,    -1 / 360.0L,       1 / 1260.0L,
                             -1 / 1680.0L, 1 / 1188.0L,       -691 / 360360.0L,
                             1 / 156.0L,   -3617 / 122400.0L, 43867 / 244188.0L};
    wide sum = 0, series = 0;
    for (; z < 40; z += 1)
        sum += (z + 0.5L) * log1pl(1 / z) - 1;
    for (int k = 8; k >= 0; k--)
        series = c[k] + series / (z * z);
    return sum + series / z;
}

static inline wide wide_lgamma1p(wide a)
{
    /* By 40 steps of log Gamma(z) = log Gamma(z + 1) - log z from Stirling's formula. */
    const wide z = a + 41;
    wide sum = (z - 0.5L) * logl(z) - z + 0.5L * WIDE_LOG_2PI + wide_stirling(z);
    for (int k = 1; k <= 40; k++)
        sum -= logl(a + k);
    return sum;
}

/* d - log(1 + d) */
static inline wide wide_deviance(wide d)
{
    wide sum = 0;
    if (fabsl(d) > 0.01L)
        return d - log1pl(d);
    for (int k = 14; k >= 2; k--)
        sum = (k % 2 ? -1.0L : 1.0L) / k + d * sum;
    return d * d * sum;
}

#endif
