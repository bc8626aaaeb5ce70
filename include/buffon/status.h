/* Layer 0. What a call says of itself.
 *
 *   < 0  BUFFON_E_*  there is no result: the call was refused before anything was drawn, or the
 *                    integrand failed. Outputs are defined: value NaN, std_error infinity,
 *                    samples 0.
 *     0  BUFFON_OK   done.
 *   > 0  BUFFON_W_*  there is a result, valid as far as it goes, with the reservation named. Where
 *                    several hold, the smallest number is returned and `doubts` of the estimate
 *                    holds them all.
 */
#ifndef BUFFON_STATUS_H
#define BUFFON_STATUS_H

#include "api.h"

/** Every status: X(name, number, sentence). The one list from which the enum and the texts come. */
#define BUFFON_STATUS_LIST(X)                                                                     \
    X(BUFFON_OK, 0, "done")                                                                       \
    X(BUFFON_E_NULL, -1, "a required pointer is NULL")                                            \
    X(BUFFON_E_DIM, -2,                                                                           \
      "a dimension or a number of components is zero, too large, or not that of its partner")      \
    X(BUFFON_E_DOMAIN, -3, "a bound of the domain is not finite, or lo is not below hi")          \
    X(BUFFON_E_HEIGHT, -4, "the bound h of the rejection method is not positive and finite")      \
    X(BUFFON_E_SHAPE, -5, "a parameter of a shape or density is outside its domain")              \
    X(BUFFON_E_INTEGRAND, -6,                                                                     \
      "an integrand needs exactly one of scalar (one component) and batch")                       \
    X(BUFFON_E_CONFIDENCE, -7, "a confidence is not between 0 and 1")                             \
    X(BUFFON_E_TOLERANCE, -8, "a tolerance is negative or not finite")                            \
    X(BUFFON_E_BLOCK, -9, "a block is a power of two from 16 to 2^20")                            \
    X(BUFFON_E_SAMPLES, -10, "the number of samples is too large, or more than the points hold")  \
    X(BUFFON_E_RESERVED, -11, "a reserved word is not zero, or an option has no such value")      \
    X(BUFFON_E_PART, -12,                                                                         \
      "a part is not below parts, a partial is missing, or a part was given a tolerance")         \
    X(BUFFON_E_POINTS, -13, "the point set is not usable here")                                   \
    X(BUFFON_E_STRATA, -14, "a stratum, its weight or share, or their number is not usable")      \
    X(BUFFON_E_TABLE, -15, "a table of (x, F) is not strictly increasing, or is too short")        \
    X(BUFFON_E_NOMEM, -16, "memory could not be allocated")                                       \
    X(BUFFON_E_UNSUPPORTED, -17, "this density has no pdf, or no inverse")                        \
    X(BUFFON_E_NONFINITE, -32, "the integrand gave a value that is not finite")                   \
    X(BUFFON_E_STOPPED, -33, "the integrand asked to stop")                                       \
    X(BUFFON_E_BOUND, -34, "the integrand is negative or above the bound of the rejection")        \
    X(BUFFON_E_PDF, -35, "a pdf is negative or not finite, or zero where the integrand is not")   \
    X(BUFFON_E_INVERSION, -36, "a quantile function failed, or a CDF could not be inverted")      \
    X(BUFFON_E_TRIES, -37, "rejection did not accept within the allowed number of tries")         \
    X(BUFFON_E_LAW, -38, "points, pdf and inverse of the density do not agree")                   \
    X(BUFFON_E_MISMATCH, -48, "the partial results belong to different runs")                     \
    X(BUFFON_E_OVERLAP, -49, "the partial results hold the same block")                           \
    X(BUFFON_E_CORRUPT, -50,                                                                      \
      "the saved partial result or the table is damaged or is none")                              \
    X(BUFFON_E_SIZE, -51,                                                                         \
      "the bytes are fewer than the partial result or the table needs")                           \
    X(BUFFON_E_EMPTY, -52, "there is nothing here to estimate from")                              \
    X(BUFFON_W_CANCELLED, 1, "cancelled: the estimate is that of the blocks done")                \
    X(BUFFON_W_INCOMPLETE, 2, "incomplete: only some parts of the run are here")                  \
    X(BUFFON_W_NONFINITE, 3, "values that are not finite were left out or counted as zero")       \
    X(BUFFON_W_NO_ERROR, 4, "the points are not random: there is no standard error")              \
    X(BUFFON_W_FEW, 5, "no standard error: too few samples, or numbers beyond the doubles")       \
    X(BUFFON_W_NO_SPREAD, 6, "all samples agree: that is not certainty, a feature may be unseen") \
    X(BUFFON_W_HEAVY_TAIL, 7, "heavy tail: the standard error cannot be trusted")                 \
    X(BUFFON_W_DOMINATED, 8, "a single sample carries a tenth of the variance or more")           \
    X(BUFFON_W_TOLERANCE, 9, "the tolerance was not reached with the samples allowed")             \
    X(BUFFON_W_UNSEEN, 10, "nothing is wrong with what was looked at, but not all could be")

/** The outcome of a call: see the table above. */
typedef enum buffon_status {
#define BUFFON_STATUS_ENUM(name, number, text) name = number,
    BUFFON_STATUS_LIST(BUFFON_STATUS_ENUM)
#undef BUFFON_STATUS_ENUM
} buffon_status;

/** The bit of a reservation in `buffon_estimate.doubts`. */
#define BUFFON_DOUBT(w) (UINT32_C(1) << (w))

BUFFON_BEGIN

/** A status as one English sentence.
 *
 *  In:      status  any value; one that the library does not know gives "unknown status"
 *  Returns: a string that lives as long as the program; never NULL
 *  Since:   0.1
 */
BUFFON_API const char *buffon_status_string(buffon_status status);

/** A status as the name of its constant, such as "BUFFON_E_NULL".
 *
 *  In:      status  any value; one that the library does not know gives "unknown"
 *  Returns: a string that lives as long as the program; never NULL
 *  Since:   0.1
 */
BUFFON_API const char *buffon_status_name(buffon_status status);

BUFFON_END

#endif
