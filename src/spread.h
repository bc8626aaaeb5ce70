/* From the exact sums of a record to means, and to what their errors are by the design of the
 * points: independent values, pairs, stratified pairs, replicates, blocks of a net.
 */
#ifndef BUFFON_SPREAD_H
#define BUFFON_SPREAD_H

#include "record.h"
#include "wide.h"

/** A squared error or covariance, and the degrees of freedom it was estimated with. */
typedef struct buffon_priv_spread {
    buffon_priv_wide square;
    double dof;
} buffon_priv_spread;

/** The exact sample of one series of a stratum. */
void buffon_priv_spread_pool(buffon_stats *pool, const buffon_priv_record *record, size_t stratum,
                             size_t series);

/** Points in a stratum, and the mean of an output there. */
uint64_t buffon_priv_spread_count(const buffon_priv_record *record, size_t stratum);
buffon_priv_wide buffon_priv_spread_mean(const buffon_priv_record *record, size_t stratum,
                                         size_t output);

/** Which series the error of a stratum comes from: 0 the values, 1 the means of pairs, 2 their half
 *  differences. */
size_t buffon_priv_spread_variant(const buffon_priv_record *record, size_t stratum);

/** Covariance of the means of outputs a and b in a stratum, from values or pairs. */
buffon_priv_spread buffon_priv_spread_pairs(const buffon_priv_record *record, size_t stratum,
                                            size_t a, size_t b);

/** The factor of a stratum's mean in the estimate: scale times weight. */
buffon_priv_wide buffon_priv_spread_factor(const buffon_priv_record *record, size_t stratum);

/** An output over all strata: the sum of factor times mean. */
buffon_priv_wide buffon_priv_spread_output(const buffon_priv_record *record, size_t output);

/** The estimate of component k from replicate r of every stratum alone. */
buffon_priv_wide buffon_priv_spread_replicate(const buffon_priv_record *record, size_t r, size_t k);

/** The estimate of component k, and the covariance of those of k and l. */
buffon_priv_wide buffon_priv_spread_value(const buffon_priv_record *record, size_t k);
buffon_priv_spread buffon_priv_spread_of(const buffon_priv_record *record, size_t k, size_t l);

#endif
