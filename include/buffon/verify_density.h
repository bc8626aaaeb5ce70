/* Layer 2. Is this density what it says it is? A check of anybody's density: of one that was
 * written today, or of one of the library's with parameters that nobody has tried.
 *
 * A density says one thing four times: by its points, by their pdf, by the pdf at any point, and by
 * the way back. Each is held against the others, where it can be exactly, and else by statistics
 * with fixed seeds.
 */
#ifndef BUFFON_VERIFY_DENSITY_H
#define BUFFON_VERIFY_DENSITY_H

#include "api.h"
#include "density.h"
#include "status.h"

/** What is looked at: X(name, sentence that says what is wrong). */
#define BUFFON_VERIFY_LIST(X)                                                                     \
    X(BUFFON_VERIFY_POINTS, "a point is not finite, or has a pdf that is not positive and finite") \
    X(BUFFON_VERIFY_PDF, "the pdf that comes with a point is not the pdf at that point")          \
    X(BUFFON_VERIFY_INVERSE, "the way back does not lead to the uniforms that made the point")     \
    X(BUFFON_VERIFY_STRETCH, "the pdf is not one over the volume that the map makes of a unit")    \
    X(BUFFON_VERIFY_SUPPORT, "the pdf is positive at a point that no uniforms make")               \
    X(BUFFON_VERIFY_TOTAL, "the pdf does not integrate to one")                                    \
    X(BUFFON_VERIFY_CELLS, "points do not fall into cells as the pdf says")                        \
    X(BUFFON_VERIFY_EVEN, "points taken back to uniforms are not evenly spread")

/** The checks, in the order of the report. */
typedef enum buffon_verify_check {
#define BUFFON_VERIFY_ENUM(name, text) name,
    BUFFON_VERIFY_LIST(BUFFON_VERIFY_ENUM)
#undef BUFFON_VERIFY_ENUM
    BUFFON_VERIFY_CHECKS
} buffon_verify_check;

BUFFON_BEGIN

/** How to look. All zero is the default, NULL the same. */
typedef struct buffon_verification {
    const buffon_density *over; /* covers the support and has a pdf and a way back, on the same
                                 * surface if g lives on one. NULL: one is made from the first
                                 * points where g fills its space, or lives on the unit sphere */
    uint64_t samples;           /* 0: 2^16; at least 2^10 */
    uint64_t seed;
    double tolerance;     /* relative, of what is compared exactly; 0: 1e-9 */
    double alpha;         /* probability that all is well and the statistics fail; 0: 1e-6 */
    int discrete;         /* non-zero: points are whole numbers, the pdf their probabilities */
    uint64_t reserved[4]; /* must be zero */
} buffon_verification;

/** One check of a report. */
typedef struct buffon_verify_item {
    int looked;   /* 0: this could not be looked at */
    int failed;   /* 1: the sentence of the check holds */
    double worst; /* largest error met, in units of what is allowed; of statistics 0 */
    double p;     /* of statistics: the probability of such data if all is well; else 1 */
} buffon_verify_item;

#define BUFFON_VERIFY_UNIFORMS 8

/** What was found. The place is that of the worst error of the first check that failed. */
typedef struct buffon_verify_report {
    buffon_status status;
    buffon_verify_check check; /* the first that failed; BUFFON_VERIFY_CHECKS if none */
    double p_value;            /* the least p times their number, 1 at most */
    uint64_t points;           /* points looked at in all */
    double u[BUFFON_VERIFY_UNIFORMS]; /* the first uniforms of the place; NaN where it has none */
    double x[BUFFON_VERIFY_UNIFORMS]; /* the first coordinates of the place, likewise */
    buffon_verify_item item[BUFFON_VERIFY_CHECKS];
    uint64_t reserved[4]; /* zero */
} buffon_verify_report;

/** Holds a density against itself.
 *
 *      buffon_verify_report r;
 *      if (buffon_verify_density(&r, &g, NULL) < 0)
 *          printf("%s\n", buffon_verify_string(r.check));
 *
 *  Out:     report  filled whole, whatever happens
 *  In:      g       any density
 *           how     NULL: the default
 *  Law:     POINTS   at random uniforms and at the outermost: 2^-53, 1 - 2^-53, and smaller
 *           PDF      agrees with the pdf at the point within the tolerance
 *           INVERSE  leads from points to their uniforms and to the points again, within the
 *                    tolerance and what rounding of the point is worth
 *           STRETCH  pdf times the volume to which the map stretches a unit of uniforms is 1: one
 *                    over the Jacobian, of a surface the root of Gram's determinant. By differences
 *                    where the map is smooth and one-to-one (there is a way back, and no more
 *                    uniforms than coordinates), within 1e-6 and their error
 *           SUPPORT  points of `over` where the pdf is positive are led back and forth likewise
 *           TOTAL    the mean of pdf over that of `over` is 1: normal test. Not where the ratio has
 *                    a heavy tail
 *           CELLS    chi-square: in cells of `over`, or whole numbers, against the pdf
 *           EVEN     chi-square in equal cells of the cube, and Kolmogorov-Smirnov for each
 *                    uniform, of points taken back
 *           A density without pdf or way back is not asked for them. What is told by statistics is
 *           judged together (Bonferroni) at `alpha`
 *  Returns: BUFFON_OK: all that applies was looked at and is well; BUFFON_W_UNSEEN: well, but some
 *           of it could not be looked at (items with looked = 0); BUFFON_E_LAW: report->check is
 *           wrong; the status g or `over` carries; BUFFON_E_NULL, BUFFON_E_DIM (`over` is of
 *           another dim; whole numbers of more than one), BUFFON_E_SAMPLES (fewer than 2^10 or
 *           more than 2^30), BUFFON_E_TOLERANCE, BUFFON_E_CONFIDENCE (alpha), BUFFON_E_RESERVED,
 *           BUFFON_E_NOMEM;
 *           BUFFON_E_PDF or BUFFON_E_INVERSION where a function of the density failed
 *  Repeat:  the same report for the same arguments, on any machine where g gives the same bits
 *  Cost:    2 to 5 `samples` points, which report->points counts; 8 bytes of memory a sample and
 *           uniform, for 8 uniforms at most
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_verify_density(buffon_verify_report *report,
                                                            const buffon_density *g,
                                                            const buffon_verification *how);

/** What is wrong where a check failed, as an English sentence.
 *
 *  In:      check  any value; BUFFON_VERIFY_CHECKS gives "nothing is wrong", others "unknown check"
 *  Returns: a string that lives as long as the program; never NULL
 *  Since:   0.1
 */
BUFFON_API const char *buffon_verify_string(buffon_verify_check check);

BUFFON_END

#endif
