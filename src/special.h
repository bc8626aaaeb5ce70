/* Private. Parts of the gamma function that keep their relative accuracy where the function itself
 * would lose it. Bits are the same everywhere (elementary.h).
 */
#ifndef BUFFON_SRC_SPECIAL_H
#define BUFFON_SRC_SPECIAL_H

/* The error of Stirling's formula, log Gamma(z) - ((z - 1/2) log z - z + log(2 pi) / 2), for z > 0:
 * within 1e-16 from 3/2 up, 2e-16 (1 - log z) below. */
double buffon_priv_stirling(double z);

/* log Gamma(1 + a) for 0 <= a <= 3/2, within 1e-15 of itself near its zeros 0 and 1 too. */
double buffon_priv_lgamma1p(double a);

/* d - log(1 + d) for d > -1, within 1e-15 of itself: d^2 / 2 for small d. The deviance of a law of
 * mean m at x is m times that of d = (x - m) / m, for the gamma and the Poisson law. */
double buffon_priv_deviance(double d);

#endif
