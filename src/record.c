#include "guard.h"

#include <stdlib.h>
#include <string.h>

#include "exact.h"
#include "record.h"

size_t buffon_priv_shape_cells(const buffon_priv_shape *shape)
{
    return (size_t)(shape->strata * shape->per_stratum);
}

size_t buffon_priv_shape_variants(const buffon_priv_shape *shape)
{
    switch (shape->design) {
    case BUFFON_DESIGN_ANTITHETIC:
        return 2;
    case BUFFON_DESIGN_STRATIFIED:
        return 3;
    default:
        return 1;
    }
}

size_t buffon_priv_shape_series(const buffon_priv_shape *shape)
{
    return buffon_priv_shape_variants(shape) * (size_t)shape->outputs;
}

static size_t record_pairs(const buffon_priv_shape *shape)
{
    return (size_t)(shape->outputs * (shape->outputs - 1) / 2);
}

size_t buffon_priv_shape_cross(const buffon_priv_shape *shape)
{
    if (!shape->covariance)
        return 0;
    return buffon_priv_shape_variants(shape) * record_pairs(shape) * BUFFON_STATS_SQUARES;
}

size_t buffon_priv_shape_cross_at(const buffon_priv_shape *shape, size_t variant, size_t a,
                                  size_t b)
{
    return (variant * record_pairs(shape) + b * (b - 1) / 2 + a) * BUFFON_STATS_SQUARES;
}

/* calloc of at least one element, so that NULL means no memory and nothing else. */
static void *record_alloc(size_t n, size_t size)
{
    return calloc(n > 0 ? n : 1, size);
}

int buffon_priv_cells_make(buffon_priv_cells *cells, const buffon_priv_shape *shape)
{
    const size_t n = buffon_priv_shape_cells(shape);
    const size_t series = buffon_priv_shape_series(shape), cross = buffon_priv_shape_cross(shape);
    cells->stats = NULL;
    cells->cross = NULL;
    if (n > SIZE_MAX / sizeof(buffon_stats) / series)
        return -1;
    if (cross > 0 && n > SIZE_MAX / sizeof(uint64_t) / cross)
        return -1;
    cells->stats = record_alloc(n * series, sizeof(buffon_stats));
    cells->cross = record_alloc(n * cross, sizeof(uint64_t));
    if (cells->stats != NULL && cells->cross != NULL)
        return 0;
    buffon_priv_cells_free(cells);
    return -1;
}

void buffon_priv_cells_free(buffon_priv_cells *cells)
{
    free(cells->stats);
    free(cells->cross);
    cells->stats = NULL;
    cells->cross = NULL;
}

void buffon_priv_cell_merge(const buffon_priv_cells *into, const buffon_priv_cells *from,
                            size_t cell, const buffon_priv_shape *shape)
{
    const size_t series = buffon_priv_shape_series(shape), cross = buffon_priv_shape_cross(shape);
    for (size_t s = cell * series; s < (cell + 1) * series; s++)
        buffon_stats_merge(&into->stats[s], &from->stats[s]);
    for (size_t c = cell * cross; c < (cell + 1) * cross; c += BUFFON_STATS_SQUARES)
        buffon_priv_limbs_merge(into->cross + c, from->cross + c, BUFFON_STATS_SQUARES);
}

void buffon_priv_cell_clear(const buffon_priv_cells *cells, size_t cell,
                            const buffon_priv_shape *shape)
{
    const size_t series = buffon_priv_shape_series(shape), cross = buffon_priv_shape_cross(shape);
    memset(cells->stats + cell * series, 0, series * sizeof(buffon_stats));
    if (cross > 0)
        memset(cells->cross + cell * cross, 0, cross * sizeof(uint64_t));
}

uint64_t buffon_priv_cell_count(const buffon_priv_cells *cells, size_t cell,
                                const buffon_priv_shape *shape)
{
    return cells->stats[cell * buffon_priv_shape_series(shape)].count;
}

uint64_t buffon_priv_record_count(const buffon_priv_record *record, size_t cell)
{
    const buffon_priv_shape *shape = &record->shape;
    return buffon_priv_cell_count(&record->whole, cell, shape) +
           buffon_priv_cell_count(&record->tail, cell, shape);
}

buffon_priv_record *buffon_priv_record_make(const buffon_priv_shape *shape)
{
    const size_t cells = buffon_priv_shape_cells(shape);
    buffon_priv_record *record = calloc(1, sizeof *record);
    if (record == NULL)
        return NULL;
    record->shape = *shape;
    if (shape->parts <= SIZE_MAX / sizeof(uint64_t) / cells) {
        record->weight = record_alloc((size_t)shape->strata, sizeof(double));
        record->target = record_alloc(cells, sizeof(uint64_t));
        record->done = record_alloc((size_t)shape->parts * cells, sizeof(uint64_t));
    }
    if (record->weight == NULL || record->target == NULL || record->done == NULL ||
        buffon_priv_cells_make(&record->whole, shape) != 0 ||
        buffon_priv_cells_make(&record->tail, shape) != 0) {
        buffon_priv_record_free(record);
        return NULL;
    }
    return record;
}

/* Cell `from` of one as cell `to` of another. */
static void record_copy(buffon_priv_cells *into, size_t to, const buffon_priv_cells *cells,
                        size_t from, const buffon_priv_shape *shape)
{
    const size_t series = buffon_priv_shape_series(shape), cross = buffon_priv_shape_cross(shape);
    memcpy(into->stats + to * series, cells->stats + from * series, series * sizeof(buffon_stats));
    if (cross > 0)
        memcpy(into->cross + to * cross, cells->cross + from * cross, cross * sizeof(uint64_t));
}

void buffon_priv_record_free(buffon_priv_record *record)
{
    if (record == NULL)
        return;
    free(record->weight);
    free(record->target);
    free(record->done);
    buffon_priv_cells_free(&record->whole);
    buffon_priv_cells_free(&record->tail);
    free(record);
}

buffon_priv_record *buffon_priv_record_grown(const buffon_priv_record *record, uint64_t per_stratum)
{
    const buffon_priv_shape *old = &record->shape;
    buffon_priv_shape shape = *old;
    shape.per_stratum = per_stratum;
    buffon_priv_record *grown = buffon_priv_record_make(&shape);
    const size_t cells = buffon_priv_shape_cells(old), all = buffon_priv_shape_cells(&shape);
    if (grown == NULL)
        return NULL;
    memcpy(grown->weight, record->weight, (size_t)old->strata * sizeof(double));
    for (size_t c = 0; c < cells; c++) {
        const size_t n = (size_t)old->per_stratum;
        const size_t to = c / n * (size_t)per_stratum + c % n;
        grown->target[to] = record->target[c];
        for (size_t p = 0; p < old->parts; p++)
            grown->done[p * all + to] = record->done[p * cells + c];
        record_copy(&grown->whole, to, &record->whole, c, old);
        record_copy(&grown->tail, to, &record->tail, c, old);
    }
    return grown;
}

/* What tells the cells of a run apart when blocks are given to parts. Nets have more cells as they
 * grow, which must change no owner. */
static uint64_t record_label(const buffon_priv_shape *shape, size_t cell)
{
    if (shape->design == BUFFON_DESIGN_NET)
        return cell / shape->per_stratum + cell % shape->per_stratum;
    return cell;
}

uint64_t buffon_priv_record_owner(const buffon_priv_record *record, size_t cell, uint64_t k)
{
    return (k + record_label(&record->shape, cell)) % record->shape.parts;
}

uint64_t buffon_priv_record_first(const buffon_priv_record *record, uint64_t part, size_t cell)
{
    const uint64_t parts = record->shape.parts;
    return (part + parts - record_label(&record->shape, cell) % parts) % parts;
}

int buffon_priv_record_has(const buffon_priv_record *record, size_t cell, uint64_t k)
{
    const buffon_priv_shape *shape = &record->shape;
    if (k == record->target[cell] / shape->block &&
        buffon_priv_cell_count(&record->tail, cell, shape))
        return 1;
    /* The owner's blocks are k mod parts, k mod parts + parts, ...: this is number k / parts. */
    return k / shape->parts <
           record->done[buffon_priv_record_owner(record, cell, k) * buffon_priv_shape_cells(shape) +
                        cell];
}

uint64_t buffon_priv_record_owned(const buffon_priv_record *record, uint64_t part, size_t cell,
                                  uint64_t blocks)
{
    const uint64_t parts = record->shape.parts;
    const uint64_t first = buffon_priv_record_first(record, part, cell);
    return blocks > first ? (blocks - first - 1) / parts + 1 : 0;
}

int buffon_priv_record_complete(const buffon_priv_record *record)
{
    const buffon_priv_shape *shape = &record->shape;
    for (size_t c = 0; c < buffon_priv_shape_cells(shape); c++) {
        if (buffon_priv_record_count(record, c) < record->target[c])
            return 0;
    }
    return 1;
}

uint64_t buffon_priv_record_points(const buffon_priv_record *record)
{
    const buffon_priv_shape *shape = &record->shape;
    uint64_t points = 0;
    for (size_t c = 0; c < buffon_priv_shape_cells(shape); c++)
        points += buffon_priv_record_count(record, c);
    return points;
}
