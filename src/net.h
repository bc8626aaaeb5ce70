/* Private. The cells of a net (BUFFON_DESIGN_NET): ranges of its points that no doubling moves.
 *
 * The error of a net of N = 2^m points comes from its eighths, which are other points for every m.
 * So the cells are what all eighths are made of: range 0 is the points below 2^3, and each shell
 * 2^k, ..., 2^(k+1) - 1 above it is four ranges, its quarters. In a net of 2^m points
 *
 *     eighths     4, 5, 6, 7   are the quarters of shell m - 1,
 *                 2, 3         the halves of shell m - 2, two ranges each,
 *                 1            shell m - 3, four ranges,
 *                 0            all ranges before it.
 *
 * A range is in a net whole or not at all: a net that doubles has all the cells it had, and the
 * four of one shell more.
 */
#ifndef BUFFON_SRC_NET_H
#define BUFFON_SRC_NET_H

#include <stddef.h>
#include <stdint.h>

enum {
    BUFFON_PRIV_NET_BLOCKS = 8,        /* whose spread is the error */
    BUFFON_PRIV_NET_LEAST = 64,        /* points: 2^6, so that eighth 0 is range 0 */
    BUFFON_PRIV_NET_RANGES = 13,       /* of the least net */
    BUFFON_PRIV_NET_RANGES_MOST = 149, /* of the largest */
    BUFFON_PRIV_NET_MOST = 40          /* log2 of the points of the largest net */
};

/* The number of a range's first point, and that of its points. Range 1 + 4 (k - 3) + q is quarter q
 * of shell k, so a net of 2^m points has 1 + 4 (m - 3) ranges. */
static inline uint64_t buffon_priv_net_begin(uint64_t range)
{
    return range > 0 ? (uint64_t)(4 + (range - 1) % 4) << (1 + (range - 1) / 4) : 0;
}

static inline uint64_t buffon_priv_net_size(uint64_t range)
{
    return range > 0 ? UINT64_C(2) << ((range - 1) / 4) : 8;
}

/* The first range of an eighth of a net with so many ranges, at least 13; for eighth 8 their end.
 */
static inline size_t buffon_priv_net_eighth(size_t ranges, size_t eighth)
{
    static const unsigned char before_end[] = {0, 12, 8, 6, 4, 3, 2, 1, 0};
    return eighth > 0 ? ranges - before_end[eighth] : 0;
}

#endif
