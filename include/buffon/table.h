/* Layer 2. Laws by tables: what they share.
 *
 * Weights, heights and images become tables that make drawing fast. A table is one block of the
 * caller's memory. Nothing else is allocated, and the density is good for as long as the block is:
 *
 *     size_t size = buffon_alias_size(count);
 *     void *table = malloc(size);
 *     buffon_density g = buffon_alias(table, size, weight, count);      ... draw, estimate
 *     free(table);
 *
 * A size that cannot be had is SIZE_MAX, for which malloc gives NULL, which the constructor
 * refuses: one look at the density's status, or at that of the call that uses it, is enough. The
 * weights are not needed any more once the constructor returns. Many threads may use one table.
 *
 * A block has no pointers in it. It may be moved, saved, mapped from a file or shared by processes,
 * on machines of the same byte order, and used there after buffon_table_open.
 *
 * Masses are kept as whole numbers of units of 2^-62 that add up to 2^62 exactly: the sum of the
 * first k of them is right within half a unit, whatever their number and sizes. So no point is out
 * of reach, none is drawn where there is no mass, and tables are never read beyond their ends.
 */
#ifndef BUFFON_TABLE_H
#define BUFFON_TABLE_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The density of a table that was made before: in another place, process or run.
 *
 *  In:      table  aligned as malloc's memory is; must outlive the density
 *           size   the bytes that are there
 *  Returns: the density as its constructor returned it, with the same points and the same bits; it
 *           carries BUFFON_E_NULL, BUFFON_E_SIZE (too few bytes, or not aligned), BUFFON_E_CORRUPT
 *           (none, of another version or byte order, or damaged)
 *  Cost:    reads the table once
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_table_open(const void *table, size_t size);

BUFFON_END

#endif
