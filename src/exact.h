/* Private. Sums that lose nothing: whole numbers wide enough for every double and every product.
 *
 * A sum has BUFFON_STATS_SUM limbs and counts units of 2^-1152, a sum of products has
 * BUFFON_STATS_SQUARES limbs and counts units of 2^-2304, the unit squared, so n S_ab - S_a S_b is
 * again a whole number. Limbs are little first, two's complement; adding is modulo 2^(64 limbs), so
 * it commutes and associates whatever happens. Zeroed limbs are zero.
 */
#ifndef BUFFON_SRC_EXACT_H
#define BUFFON_SRC_EXACT_H

#include <stddef.h>
#include <stdint.h>

#include "wide.h"

enum { BUFFON_PRIV_SUM_UNIT = -1152, BUFFON_PRIV_SQUARES_UNIT = -2304 };

/* sum += n m 2^e for finite m and |e| < 2^20. Bits of the term below the unit are cut toward zero:
 * there are none where n m 2^e is a double. */
void buffon_priv_sum_add(uint64_t *sum, double m, uint64_t n, int e);

/* squares += n a b 2^e for finite a and b, likewise. */
void buffon_priv_squares_add(uint64_t *squares, double a, double b, uint64_t n, int e);

/* sum += y and squares += y y, for finite y: the fast way for single numbers. */
void buffon_priv_value_add(uint64_t *sum, uint64_t *squares, double y);

/* into += from. They may be the same. */
void buffon_priv_limbs_merge(uint64_t *into, const uint64_t *from, size_t limbs);

/* limbs / n in units of 2^unit, correctly rounded to 53 bits. n > 0 */
buffon_priv_wide buffon_priv_limbs_over(const uint64_t *limbs, size_t count, uint64_t n, int unit);

/* n S_ab - S_a S_b, correctly rounded to 53 bits: n (n - 1) times the covariance. */
buffon_priv_wide buffon_priv_limbs_spread(const uint64_t *s_ab, const uint64_t *s_a,
                                          const uint64_t *s_b, uint64_t n);

#endif
