/* Layer 1. Point sets: where in the unit cube an estimate looks.
 *
 * A point set is a value that any number of runs may share; nothing to free. It gives the
 * coordinates of any stretch of points of any replicate, so that threads, processes and resumed
 * runs see the same points. Independent random points are what a run uses without one.
 */
#ifndef BUFFON_POINTS_H
#define BUFFON_POINTS_H

#include "api.h"
#include "rng.h"
#include "status.h"

BUFFON_BEGIN

/** How the error of an estimate follows from its points. */
typedef enum buffon_design {
    BUFFON_DESIGN_INDEPENDENT = 0, /* from the spread of the values */
    BUFFON_DESIGN_ANTITHETIC = 1,  /* points 2i and 2i + 1 are a pair; pairs are independent */
    BUFFON_DESIGN_STRATIFIED = 2,  /* a pair shares a cell; `round` points visit every cell alike */
    BUFFON_DESIGN_REPLICATES = 3,  /* from the spread of the means of independent replicates */
    BUFFON_DESIGN_NONE = 4,        /* not random: no standard error */
    /* A net: all points of a stratum are one (of replicate 0), a power of two of them, 64 to 2^40,
     * whether or not `doubling` says so. The error is the standard error of the means of the eight
     * aligned blocks of an eighth, with 7 degrees of freedom. That is a rule of thumb: the blocks
     * are not independent. It holds for points whose blocks are even and make up for each other,
     * so that the whole is nearer than eight independent blocks would be. */
    BUFFON_DESIGN_NET = 5,
    /* The value is the median of the estimates of independent replicates, an odd number of them,
     * at least 5. The interval is from the j-th smallest of these to the j-th largest, which miss
     * the median of their law with the probability that fewer than j of as many fair coins show
     * heads, or tails. The standard error is half the interval of 95 % over what that is in
     * standard errors of the normal law. No covariances. The median is not unbiased: it is for
     * estimates of which most are near and few far off. */
    BUFFON_DESIGN_MEDIAN = 6
} buffon_design;

/** The stretch of points asked for: first, ..., first + n - 1 of one replicate. */
typedef struct buffon_points_block {
    buffon_rng_key key; /* seed, stream, purpose, stratum, replicate: the source of randomness */
    uint64_t first;
    size_t n;
    size_t dim;
    void *table; /* what `prepare` made for this key and dim; NULL without */
} buffon_points_block;

/** A point set. The constructors below fill it in, or a user does, for a point set of his own. */
typedef struct buffon_points {
    /* u[j*n + i] in (0, 1): coordinate j of point first + i. Non-zero: failure (BUFFON_E_POINTS).
     * A pure function of its arguments; several threads call it at once. Required. */
    int (*fill)(double *u, const buffon_points_block *block, const struct buffon_points *self);
    /* Bytes of table that `prepare` wants for a dimension; NULL: none. SIZE_MAX: refused. */
    size_t (*table_size)(size_t dim, const struct buffon_points *self);
    /* Makes the table (aligned for any type) that `fill` then reads, once for each stratum and
     * replicate of a run (a net is one). Non-zero: failure. */
    int (*prepare)(const buffon_points_block *block, const struct buffon_points *self);
    /* Points come in multiples of this for a dimension (per replicate); NULL: 1. 0: not for that
     * dim. A run rounds its samples up to it. */
    uint64_t (*round)(size_t dim, const struct buffon_points *self);
    buffon_design design;
    uint32_t replicates;  /* 1 to 256; 0 means 1. The samples of a run are spread over them. A net
                           * is one */
    uint64_t limit;       /* points that a replicate holds; 0: 2^64, of a net 2^40 */
    const char *name;     /* tells point sets apart in partial results; NULL is allowed */
    uint64_t param[4];    /* the constructor's */
    const void *data;     /* the constructor's */
    void *ctx;            /* a user's own */
    uint64_t doubling;    /* non-zero: a replicate has a power of two of points; so is `round` */
    uint64_t reserved[3]; /* must be zero */
} buffon_points;

/** Independent uniform points: what a run without `.points` uses.
 *
 *  Since:   0.1
 */
BUFFON_API buffon_points buffon_points_random(void);

/** Antithetic pairs: a random point u and its mirror image 1 - u.
 *
 *  Law:     each point is uniform; the error comes from the means of the pairs. Exact, up
 *           to rounding, for integrands that are odd about the middle, never worse than plain for
 *           monotone ones, and twice the variance for even ones
 *  Draws:   dim uniforms a pair
 *  Source:  J. Hammersley, K. Morton (1956), A new Monte Carlo technique: antithetic variates
 *  Since:   0.1
 */
BUFFON_API buffon_points buffon_points_antithetic(void);

/** Stratified jitter: the cube is cut into k^dim equal cells and every cell gets pairs of random
 *  points. Samples are rounded up to a multiple of 2 k^dim.
 *
 *  In:      k  cells along each coordinate, >= 1; a dimension with k^dim > 2^40 is refused
 *  Law:     the cells of each sweep are visited in a random order, so a run that ends within a
 *           sweep is unbiased too; its error then counts the spread between cells. The interval
 *           takes the cells to vary alike: where few carry the variance it is a little short
 *  Source:  S. Haber (1967), A modified Monte-Carlo quadrature II
 *  Since:   0.1
 */
BUFFON_API buffon_points buffon_points_jitter(uint64_t k);

/** Points of the caller's own: replay of a recorded run, another generator, a hand-made design.
 *
 *  In:      u[dim*count]  coordinate-major, in (0, 1); must outlive the run
 *           dim, count    the run must have this dimension and at most so many samples
 *           design        what the caller vouches for: INDEPENDENT, ANTITHETIC or NONE. Several
 *                         strata or replicates would get the same numbers, so with them only NONE
 *                         is taken
 *  Cost:    reads the numbers once, to tell partial results of different ones apart
 *  Since:   0.1
 */
BUFFON_API buffon_points buffon_points_replay(const double *u, size_t dim, size_t count,
                                              buffon_design design);

BUFFON_END

#endif
