/* Layer 2. Mixtures: a point of one of several densities, by chance. */
#ifndef BUFFON_MIXTURE_H
#define BUFFON_MIXTURE_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The mixture of densities of the same coordinates: g = w1 g1 + w2 g2 + ...
 *
 *  Which part a point is of is told by its first uniform, which is then stretched to serve the part
 *  as well: (u - c) / w, where the share of the part goes from c to c + w. So no uniform is spent
 *  on the choice, and stratified or quasi-random points are so in the choice and in the part.
 *
 *  Defensive: where f / g is large far out because g falls too fast, mix g with a share of a broad
 *  density. f / (w1 g1 + w2 g2) is below both f / (w1 g1) and f / (w2 g2): a tenth of the points
 *  bounds all weights by ten times those of the broad density alone
 *
 *      const buffon_density parts[] = {buffon_normal(0, 1), buffon_cauchy(0, 2)};
 *      const buffon_density g = buffon_mixture(parts, (double[]){0.9, 0.1}, 2);
 *
 *  In:      parts[count]    of one dim; must outlive the mixture. count >= 1
 *           weights[count]  in any unit: shares are weights over their sum. Finite, not negative,
 *                           not all 0; must outlive the mixture. Parts of weight 0 are never drawn
 *  Law:     as above. The bits of the part's uniform are those of u less log2(1 / w)
 *  Draws:   the most uniforms of any part
 *  Returns: a density without a way back (a point may be of any part); it carries BUFFON_E_NULL,
 *           BUFFON_E_DIM (dims that differ, or dim and uniforms together above 200), BUFFON_E_SHAPE
 *           (weights), or the first part's status that is not BUFFON_OK. Its pdf is there if all
 *           parts have one; its logarithm holds where all of them underflow
 *  Exact:   g within count + 2 ulp and the errors of the parts (tests/test_combinators.c)
 *  Cost:    each point once in its part, and the pdf of all parts at each point. 24 KiB of stack
 *           for each mixture within a mixture
 *  Source:  T. Hesterberg (1995), Weighted average importance sampling and defensive mixture
 *           distributions, Technometrics 37
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_mixture(const buffon_density *parts, const double *weights,
                                         size_t count);

BUFFON_END

#endif
