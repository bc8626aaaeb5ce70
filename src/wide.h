/* Private. Doubles with a wide exponent: the variance of data near 1e308 or 1e-300 leaves the
 * doubles, its square root does not. Every operation rounds once, to 53 bits.
 */
#ifndef BUFFON_SRC_WIDE_H
#define BUFFON_SRC_WIDE_H

#include <stdint.h>

/* The value m 2^e with |m| in [1/2, 1), or zero (m = 0, e = 0). An infinite or NaN m has e = 0 and
 * goes through the operations as in the doubles. |e| stays below 2^30. */
typedef struct buffon_priv_wide {
    double m;
    int e;
} buffon_priv_wide;

/* x 2^e exactly, for any double x. */
buffon_priv_wide buffon_priv_wide_make(double x, int e);

/* x itself. */
static inline buffon_priv_wide buffon_priv_wide_of(double x)
{
    return buffon_priv_wide_make(x, 0);
}

/* A count, rounded to 53 bits. */
buffon_priv_wide buffon_priv_wide_count(uint64_t n);

/* (hi 2^64 + lo) 2^e, rounded to 53 bits, ties to even; `sticky` says that more bits, not all of
 * them zero, follow below. hi 2^64 + lo is zero or at least 2^64 where sticky is set. */
buffon_priv_wide buffon_priv_wide_round(uint64_t hi, uint64_t lo, int sticky, int e);

buffon_priv_wide buffon_priv_wide_add(buffon_priv_wide a, buffon_priv_wide b);
buffon_priv_wide buffon_priv_wide_mul(buffon_priv_wide a, buffon_priv_wide b);
buffon_priv_wide buffon_priv_wide_div(buffon_priv_wide a, buffon_priv_wide b);
buffon_priv_wide buffon_priv_wide_sqrt(buffon_priv_wide a);
buffon_priv_wide buffon_priv_wide_negate(buffon_priv_wide a);

/* The nearest double: infinite above their range, subnormal or zero below it. */
double buffon_priv_wide_to_double(buffon_priv_wide a);

#endif
