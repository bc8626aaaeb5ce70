/* Layer 1. Sobol' points: far more even than random ones, and scrambled so that their error shows.
 *
 * The points of a replicate are numbered from 0 in Gray code order. Every aligned stretch of 2^m of
 * them has one point in each of the 2^m equal intervals of every coordinate, and so for boxes in
 * several coordinates as far as the direction numbers allow. A scramble keeps that and makes each
 * point uniform: means of independently scrambled replicates have Student's t interval.
 *
 * The layout, so that anybody can write it again. Coordinate j of point i is (k + 1/2) 2^-52, k the
 * top 52 bits of the scrambled word. Bit b of a word is worth 2^b.
 *
 *   w        XOR of direction numbers V[b] of dimension j over the bits b of i ^ (i >> 1);
 *            V[b] = m[b+1] 2^(63-b) below the degree s of the dimension's primitive polynomial
 *            x^s + a[1] x^(s-1) + ... + a[s-1] x + 1, and from there on
 *            V[b] = a[1] V[b-1] ^ ... ^ a[s-1] V[b-s+1] ^ V[b-s] ^ V[b-s] 2^-s
 *   R[0..]   the words (rng.h) of the run's key with purpose BUFFON_PURPOSE_SCRAMBLE, dimension j,
 *            from index 1024 p on, p being the purpose of the run
 *
 *   SHIFT    w ^ R[64]
 *   LINEAR   XOR of the columns C[c] over the bits 63 - c of w, XOR R[64];
 *            C[c] = (2^63 + R[c] / 2) / 2^c: a 1 on the diagonal, random bits below
 *   OWEN     every bit of w is flipped or not as a random bit says that belongs to all the bits
 *            above it. Bit 63 - l, l < 6: that is bit h of R[0], h = 2^l + the top l bits of w.
 *            Bit b < 58: it is bit t of H(w[57..b+1] + 2^b), w[57..b+1] the bits 57 to b + 1 of w
 *            where they stand; t < 64 is the one point whose unscrambled word has the top six bits
 *            of w. H(x): x ^= R[1]; F(32); F(29); x ^= R[2]; F(32); x ^= x >> 29, where F(s) is
 *            x ^= x >> s; x *= 0xbea225f9eb34556d
 *
 * Source: I. Sobol' (1967), On the distribution of points in a cube; S. Joe, F. Kuo (2008),
 *         Constructing Sobol sequences with better two-dimensional projections;
 *         A. Owen (1995), Randomly permuted (t,m,s)-nets and (t,s)-sequences;
 *         J. Matousek (1998), On the L2-discrepancy for anchored boxes (LINEAR);
 *         J. Maiga (2020), mx3 (the mixer in H).
 */
#ifndef BUFFON_SOBOL_H
#define BUFFON_SOBOL_H

#include "api.h"
#include "points.h"
#include "status.h"

BUFFON_BEGIN

/** The dimensions that Sobol' points have here. */
#define BUFFON_SOBOL_DIMENSIONS 1111

/** How Sobol' points are made random. */
typedef enum buffon_scramble {
    BUFFON_SCRAMBLE_OWEN = 0,   /* nested uniform: errors close to normal, intervals that hold */
    BUFFON_SCRAMBLE_LINEAR = 1, /* random matrix and shift: the same variance, heavier tails */
    BUFFON_SCRAMBLE_SHIFT = 2,  /* random shift: for f = x the variance falls as N^-2, not N^-3 */
    BUFFON_SCRAMBLE_NONE = 3    /* the sequence itself: no standard error */
} buffon_scramble;

/** Sobol' points for a run: a value, nothing to free.
 *
 *      const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
 *      buffon_uniform(&e, &f, lo, hi, &(buffon_run){.samples = 1 << 16, .points = &sobol});
 *
 *  In:      scramble  NONE gives std_error NaN and the reservation BUFFON_W_NO_ERROR
 *  Law:     scrambled, each point is uniform and the estimate unbiased. The samples are spread over
 *           8 independently scrambled replicates, and the interval is Student's with 7 degrees of
 *           freedom; `.replicates` of the value may be set to another number. More replicates: a
 *           surer error bar; fewer: a smaller error for as many samples
 *  Samples: a replicate has a power of two of points: `.samples` is rounded up to it times the
 *           replicates, in each stratum. Any other number would spoil the evenness
 *  Refused: more than BUFFON_SOBOL_DIMENSIONS dimensions: BUFFON_E_POINTS
 *  Cost:    1 kB for each dimension, replicate and stratum of a run
 *  Since:   0.1
 */
BUFFON_API buffon_points buffon_points_sobol(buffon_scramble scramble);

/** One net of Sobol' points, with an error bar from its own blocks: the fast mode. With a caller's
 *  table: set `.design` = BUFFON_DESIGN_NET and `.replicates` = 1 in the value below.
 *
 *      const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
 *
 *  In:      scramble  as buffon_points_sobol
 *  Law:     all samples are one net, with BUFFON_DESIGN_NET (points.h). The estimate is unbiased
 *           and 1.3 to 20 times nearer than that of 8 replicates with as many samples, the
 *           interval about as wide. The interval is a rule of thumb: with OWEN and 512 points or
 *           more it covered 97 to 100 % instead of 95 % (docs/qmc.md). With LINEAR it can cover
 *           less
 *  Samples: a power of two, 64 to 2^40, in each stratum: `.samples` is rounded up to it
 *  Refused: more than BUFFON_SOBOL_DIMENSIONS dimensions: BUFFON_E_POINTS
 *  Cost:    1 kB for each dimension and stratum. A partial result has 4 m - 11 cells for 2^m points
 *           in place of 8: 3 kB each, for each component and stratum. Each keeps sums and largest
 *           values of its own, which takes 6 us more than 8 replicates do at 2^6 points, 0.2 ms at
 *           2^16 and 1.4 ms at 2^20, for each component
 *  Since:   0.1
 */
BUFFON_API buffon_points buffon_points_sobol_net(buffon_scramble scramble);

/** The median of 15 linear scrambles: for smooth integrands of one to three coordinates.
 *
 *      const buffon_points median = buffon_points_sobol_median();
 *
 *  Law:     BUFFON_DESIGN_MEDIAN (points.h). Most runs of the linear scramble are far nearer than
 *           their standard deviation, and so is the median of a few. It is not unbiased: where
 *           single runs are skewed, as for rare events, it is on the side where most of them are.
 *           The interval is that from the 4th to the 12th at 95 %, which covers the median of the
 *           law of one run with 96.5 % and covered the integral with 93 to 98 % (docs/qmc.md).
 *           `.replicates` may be set to another odd number from 5 on; an interval of 95 % needs 7,
 *           one of 1 - alpha some 1 + log2(1 / alpha). Without one there is BUFFON_W_FEW
 *  Samples: 15 times a power of two: 100,000 are rounded up to 122,880
 *  Refused: as buffon_points_sobol; `.covariance`: BUFFON_E_POINTS
 *  Source:  Z. Pan, A. Owen (2023), Super-polynomial accuracy of one dimensional randomized nets
 *           using the median of means
 *  Since:   0.1
 */
BUFFON_API buffon_points buffon_points_sobol_median(void);

/** The same with direction numbers of the caller's own: more dimensions, or another choice.
 *
 *  In:      scramble     as buffon_points_sobol
 *           rows[count]  for dimension 1, 2, ... in turn: the polynomial's degree s, 1 to 31, its
 *                        inner coefficients a, and m_1, ..., m_s, odd and m_i < 2^i: the rows of
 *                        the published files without their first column. Must outlive the run
 *  Law:     as buffon_points_sobol, if the polynomials are primitive and no two the same; neither
 *           is looked at. new-joe-kuo-6.21201 has 21,201 dimensions, of which buffon_points_sobol
 *           has the first 1,111
 *  Refused: rows that are none, where the points are used: BUFFON_E_POINTS; likewise more
 *           dimensions than there are rows, and one
 *  Cost:    reads the numbers once, to tell partial results of different tables apart
 *  Since:   0.1
 */
BUFFON_API buffon_points buffon_points_sobol_table(buffon_scramble scramble, const uint32_t *rows,
                                                   size_t count);

/** Words of the sequence itself: points first, first + 1, ... of one dimension.
 *
 *  Out:     w[n]       the coordinate is w 2^-64
 *  In:      dimension  below BUFFON_SOBOL_DIMENSIONS
 *           first      index of w[0]; indices wrap at 2^64
 *  Returns: BUFFON_OK; BUFFON_E_NULL, BUFFON_E_DIM
 *  Repeat:  cutting a stretch differently changes no word
 *  Cost:    up to 4 us for each call, and 0.1 to 0.5 ns for each word
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_sobol_words(uint64_t *w, size_t n, uint32_t dimension,
                                                         uint64_t first);

BUFFON_END

#endif
