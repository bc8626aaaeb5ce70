/* Layer 1. Partial results: what a run has done so far, as a value that merges and travels.
 *
 * A partial holds integers (exact sums for each stratum, replicate and component) and which blocks
 * are in it. Merging is adding integers: any order, any grouping, same bits. Threads, processes,
 * checkpoints and "a million more samples" are all this one operation.
 *
 *     buffon_partial p = {0};                            empty
 *     buffon_uniform(&e, &f, lo, hi, &(buffon_run){.samples = 1000000, .partial = &p});
 *     buffon_uniform(&e, &f, lo, hi, &(buffon_run){.samples = 2000000, .partial = &p});
 *     buffon_partial_free(&p);                           the second call did the second half
 */
#ifndef BUFFON_PARTIAL_H
#define BUFFON_PARTIAL_H

#include "api.h"
#include "estimate.h"
#include "status.h"

BUFFON_BEGIN

/** A partial result. {0} is empty. Owned memory hangs on it: do not copy the struct, and end with
 *  buffon_partial_free. The fields are private. */
typedef struct buffon_partial {
    uint64_t private_[32];
    void *more;
} buffon_partial;

/** Adds what another part, process or machine has done.
 *
 *  In/Out:  into  unchanged on error; an empty one becomes a copy of from
 *  In:      from  empty: nothing happens; not into itself (BUFFON_E_OVERLAP unless empty)
 *  Returns: BUFFON_OK, BUFFON_E_NULL, BUFFON_E_MISMATCH (another run: estimator, domain, options,
 *           seed, samples or id), BUFFON_E_OVERLAP (a block in both), BUFFON_E_NOMEM
 *  Repeat:  associative and commutative to the last bit
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_partial_merge(buffon_partial *into,
                                                           const buffon_partial *from);

/** The estimate of what is here: the same as the run returned, or would have.
 *
 *  Out:     out[components]
 *  In:      partial
 *           confidence  in (0, 1); 0 means 0.95
 *  Returns: as the run; BUFFON_W_INCOMPLETE where blocks are missing; BUFFON_E_EMPTY,
 *           BUFFON_E_NULL, BUFFON_E_CONFIDENCE
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_partial_estimate(buffon_estimate *out,
                                                              const buffon_partial *partial,
                                                              double confidence);

/** The covariance matrix of the component estimates: its diagonal holds the squared std_errors.
 *
 *  Out:     cov[components * components]  symmetric; NaN on error
 *  In:      partial  of a run with .covariance
 *  Returns: BUFFON_OK, BUFFON_E_NULL, BUFFON_E_EMPTY, BUFFON_E_UNSUPPORTED (the run kept none)
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_partial_covariance(double *cov,
                                                                const buffon_partial *partial);

/** How many components the estimate of this partial has: 0 for an empty one.
 *
 *  Since:   0.1
 */
BUFFON_API size_t buffon_partial_components(const buffon_partial *partial);

/** How many bytes buffon_partial_save writes.
 *
 *  In:      partial  an empty one has a size too
 *  Returns: depends on the problem alone (components, strata, replicates, parts; for a net its
 *           samples too), never on how much is done: every part of a run has the same size. 0 for
 *           NULL
 *  Since:   0.1
 */
BUFFON_API size_t buffon_partial_size(const buffon_partial *partial);

/** Writes a partial as bytes that any machine can read: little-endian, with version and checksum.
 *
 *  Out:     bytes[buffon_partial_size(partial)]
 *  In:      size  at least that
 *  Returns: BUFFON_OK, BUFFON_E_NULL, BUFFON_E_SIZE (nothing is written)
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_partial_save(void *bytes, size_t size,
                                                          const buffon_partial *partial);

/** Reads a partial from bytes.
 *
 *  In/Out:  partial  {0} or an earlier one, which is freed; unchanged on error
 *  In:      bytes[size]  from buffon_partial_save; longer is allowed
 *  Returns: BUFFON_OK, BUFFON_E_NULL, BUFFON_E_SIZE (truncated), BUFFON_E_CORRUPT, BUFFON_E_NOMEM
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_partial_load(buffon_partial *partial,
                                                          const void *bytes, size_t size);

/** Frees what hangs on a partial and leaves it empty. NULL and {0} are allowed.
 *
 *  In/Out:  partial
 *  Since:   0.1
 */
BUFFON_API void buffon_partial_free(buffon_partial *partial);

BUFFON_END

#endif
