/* Layer 2. One of a number of items, by their weights: two tables, each a draw in constant time. */
#ifndef BUFFON_ALIAS_H
#define BUFFON_ALIAS_H

#include "api.h"
#include "density.h"
#include "rng.h"
#include "status.h"
#include "table.h"

BUFFON_BEGIN

/** The bytes of a table for buffon_alias.
 *
 *  In:      count  1 to 2^31 - 1; SIZE_MAX is returned for others
 *  Cost:    16 to 24 bytes an item; those that a draw reads are 8 to 16
 *  Since:   0.1
 */
BUFFON_API size_t buffon_alias_size(size_t count);

/** Item k with the probability weight[k] / (sum of the weights), by the alias method: the fastest.
 *
 *  The unit interval is cut into a power of two of equal bins, and each bin between two items: the
 *  upper bits of u choose the bin, the lower ones the side. u is used up without order, so that
 *  stratified and quasi-random points gain little: buffon_guide keeps their order.
 *
 *  Out:     memory  the table: `size` bytes, at least buffon_alias_size(count), aligned as malloc's
 *                   memory is; must outlive the density; must not overlap the weights
 *  In:      weight[count]  finite, >= 0, not all 0; of any size, their sum may leave the doubles
 *  Law:     x = k, a whole number from 0 on, with pdf p[k] = weight[k] / sum: a density with
 *           respect to counting. From random words (buffon_alias_fill) item k comes with a
 *           probability that is a whole number of 2^-62 and within one of them of p[k], exactly 0
 *           for weight 0; these add up to 1 exactly. Uniforms are words of 52 bits: with them each
 *           bin is cut within 2^-53
 *  Draws:   1
 *  Returns: a density of 1 coordinate without inverse; it carries BUFFON_E_DIM (count),
 *           BUFFON_E_NULL, BUFFON_E_SIZE (the memory), BUFFON_E_SHAPE (the weights)
 *  Exact:   p within 2 ulp, probabilities as stated (tests/test_alias.c)
 *  Cost:    some 60 ns an item to make
 *  Source:  A. Walker (1974); M. Vose (1991), A linear algorithm for generating random numbers with
 *           a given distribution; L. Huebschle-Schneider, P. Sanders (2022), Parallel weighted
 *           random sampling (the sweep that makes the table without lists)
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_alias(void *memory, size_t size, const double *weight,
                                       size_t count);

/** The bytes of a table for buffon_guide.
 *
 *  In:      count  1 to 2^31 - 1; SIZE_MAX is returned for others
 *  Cost:    20 to 24 bytes an item
 *  Since:   0.1
 */
BUFFON_API size_t buffon_guide_size(size_t count);

/** Item k with the probability weight[k] / (sum of the weights), by inversion: the items keep their
 *  order, as stratified and quasi-random points want it.
 *
 *  Out, In: as buffon_alias
 *  Law:     x = k where the weights before k, relative to the sum, are at most u and those up to k
 *           are more. These bounds are whole numbers of 2^-62, rounded once. pdf as buffon_alias
 *  Draws:   1
 *  Returns: as buffon_alias
 *  Exact:   bounds within 2^-63, p within 2 ulp (tests/test_alias.c)
 *  Cost:    a draw looks in an index of as many cells as items: some two items on average, the
 *           logarithm of their number where they crowd. 60 ns an item to make
 *  Source:  H. Chen, Y. Asau (1974), On generating random variates from an empirical distribution
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_guide(void *memory, size_t size, const double *weight,
                                       size_t count);

/** One item, and what is left of the uniform: a new one, for the next choice.
 *
 *  Out:     index  the item; 0 on error
 *           pmf    its probability; may be NULL; NaN on error
 *           rest   in (0, 1), uniform whatever the item is: where in its bin, or in its step of the
 *                  CDF, u fell. An item of probability p leaves 52 + log2(p) random bits, less the
 *                  10 or 20 of its bin with buffon_alias. May be NULL; NaN on error
 *  In:      u      in (0, 1)
 *           g      of buffon_alias or buffon_guide
 *  Returns: BUFFON_OK; the status of g; BUFFON_E_NULL; BUFFON_E_UNSUPPORTED (another density)
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_alias_pick(size_t *index, double *pmf, double *rest,
                                                        double u, const buffon_density *g);

/** Many items at once, straight from random words: no rounding of uniforms comes in between.
 *
 *  Out:     index[n]  0 on error
 *  In/Out:  rng       moves on by n words, by none on error
 *  In:      g         of buffon_alias or buffon_guide
 *  Law:     item by item as buffon_alias and buffon_guide say, from the upper 62 bits of a word
 *  Returns: as buffon_alias_pick
 *  Repeat:  the same items however the stretch is cut
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_alias_fill(uint32_t *index, size_t n,
                                                        const buffon_density *g, buffon_rng *rng);

BUFFON_END

#endif
