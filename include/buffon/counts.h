/* Layer 2. Discrete laws: whole numbers with probabilities.
 *
 * A point is a whole number in a double, below 2^53, and its pdf is the probability of that number:
 * the measure is the counting one. The pdf of what is not a whole number is 0. There is no way
 * back to the uniforms, since many make the same number: buffon_density_invert says
 * BUFFON_E_UNSUPPORTED.
 *
 * Each point is made from one uniform u: the least k with P(X <= k) >= u, so points keep the order
 * of uniforms. Each P(X <= k), or P(X > k) where that is the smaller, is computed to 2e-13 of
 * itself: u is on its right side unless it is as near. Nothing is lost for u or 1 - u next to 0.
 */
#ifndef BUFFON_COUNTS_H
#define BUFFON_COUNTS_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** One with probability p, else zero.
 *
 *  In:      p  in [0, 1]
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   all of it (tests/test_counts.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_bernoulli(double p);

/** Failures before the first success, each try succeeding with probability p.
 *
 *  In:      p  from 1e-14 to 1
 *  Law:     P(X = k) = p (1 - p)^k, k = 0, 1, 2, ...; the mean is (1 - p) / p. By the inverse CDF:
 *           no loop
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   pdf within 2e-15 (1 + |log|) of itself (tests/test_counts.c)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_geometric(double p);

/** Successes among n tries, each succeeding with probability p.
 *
 *  In:      n  at most 2^50
 *           p  in [0, 1]
 *  Law:     P(X = k) = n! / (k! (n - k)!) p^k (1 - p)^(n - k), k = 0 ... n
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   pdf within 4e-15 (1 + |log|) of itself (tests/test_counts.c)
 *  Cost:    0.015 us a point up to a mean of 200 of what is rarer, successes or failures, with 1 us
 *           a batch; 0.5 to 0.9 us a point above
 *  Source:  C. Loader (2000), Fast and accurate computation of binomial probabilities
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_binomial(uint64_t n, double p);

/** Events in a time in which `mean` of them are expected.
 *
 *  In:      mean  from 0 to 1e15
 *  Law:     P(X = k) = mean^k exp(-mean) / k!, k = 0, 1, 2, ...
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_SHAPE
 *  Exact:   pdf within 4e-15 (1 + |log|) of itself (tests/test_counts.c)
 *  Cost:    0.015 us a point up to a mean of 200, with 1 us a batch; 0.4 to 0.6 us a point above
 *  Source:  as buffon_binomial
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_poisson(double mean);

BUFFON_END

#endif
