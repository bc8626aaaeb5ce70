/* What hangs on a buffon_partial: exact sums in cells, and which blocks are in them.
 *
 * A cell is one replicate of one stratum, cell = stratum * replicates + replicate, or one range of
 * a net (net.h). Its points are cut into blocks; block k of a cell belongs to part (k + cell) mod
 * parts; of a net, which may come to have more cells, to part (k + stratum + range) mod parts. Of
 * each part a prefix of its blocks is done, so a count for each (part, cell) says which. The last
 * block of a cell may be short: its sums are kept apart (the tail), because a run that goes on
 * evaluates that block again, whole.
 *
 * In a cell there is one buffon_stats for each series: the outputs y themselves, then, for points
 * that come in pairs, their pair means (y0 + y1)/2, then, for stratified pairs, (y0 - y1)/2.
 */
#ifndef BUFFON_RECORD_H
#define BUFFON_RECORD_H

#include <buffon/partial.h>
#include <buffon/points.h>

/** How estimates follow from the means of the outputs. */
enum buffon_priv_kind {
    BUFFON_PRIV_MEAN = 0, /* component k is scale times output k */
    BUFFON_PRIV_HITS = 1, /* the same, of outputs that are 0 or 1 */
    BUFFON_PRIV_RATIO = 2 /* output k over the last output, which is a weight */
};

/** All words, so that comparing, saving and loading are loops. Equal in records that merge. */
typedef struct buffon_priv_shape {
    uint64_t identity;   /* of estimator, domain, options, seed and id */
    uint64_t kind;       /* a buffon_priv_kind */
    uint64_t design;     /* a buffon_design */
    uint64_t components; /* of the estimate */
    uint64_t outputs;    /* numbers that a point yields */
    uint64_t covariance; /* are cross products kept? */
    uint64_t constant;   /* is zero spread certainty? */
    uint64_t strata;
    uint64_t per_stratum; /* cells of a stratum: its replicates, or the ranges of a net */
    uint64_t block;
    uint64_t round;   /* points of a full sweep of the point set */
    uint64_t scale_m; /* bits of the factor of all means ... */
    uint64_t scale_e; /* ... and its power of two, two's complement */
    uint64_t parts;
    uint64_t looks; /* over which the error probability is spent */
} buffon_priv_shape;

#define BUFFON_PRIV_REPLICATES 256 /* the most */
#define BUFFON_PRIV_SHAPE_WORDS (sizeof(buffon_priv_shape) / sizeof(uint64_t))

/** Exact sums: stats[cell * series + s] and, with covariance, the limbs of the products of outputs
 *  a < b of variant v in cross. */
typedef struct buffon_priv_cells {
    buffon_stats *stats;
    uint64_t *cross;
} buffon_priv_cells;

typedef struct buffon_priv_record {
    buffon_priv_shape shape;
    double *weight;          /* [strata] factor of a stratum's estimate */
    uint64_t *target;        /* [cells] points that the run wants */
    uint64_t *done;          /* [parts * cells] whole blocks done */
    buffon_priv_cells whole; /* sums over whole blocks */
    buffon_priv_cells tail;  /* and over a short last one */
} buffon_priv_record;

size_t buffon_priv_shape_cells(const buffon_priv_shape *shape);
size_t buffon_priv_shape_variants(const buffon_priv_shape *shape);
size_t buffon_priv_shape_series(const buffon_priv_shape *shape);

/** Words of cross products in a cell; 0 without covariance. */
size_t buffon_priv_shape_cross(const buffon_priv_shape *shape);

/** Where the product of outputs a < b of a variant starts within its cell's cross words. */
size_t buffon_priv_shape_cross_at(const buffon_priv_shape *shape, size_t variant, size_t a,
                                  size_t b);

/** Zeroed sums for all cells of a shape; free with buffon_priv_cells_free. */
int buffon_priv_cells_make(buffon_priv_cells *cells, const buffon_priv_shape *shape);
void buffon_priv_cells_free(buffon_priv_cells *cells);

/** Adds one cell to another, exactly. */
void buffon_priv_cell_merge(const buffon_priv_cells *into, const buffon_priv_cells *from,
                            size_t cell, const buffon_priv_shape *shape);
void buffon_priv_cell_clear(const buffon_priv_cells *cells, size_t cell,
                            const buffon_priv_shape *shape);

/** Points in a cell. */
uint64_t buffon_priv_cell_count(const buffon_priv_cells *cells, size_t cell,
                                const buffon_priv_shape *shape);

/** Points in a cell of a record, in whole blocks and the tail. */
uint64_t buffon_priv_record_count(const buffon_priv_record *record, size_t cell);

/** A record with nothing done, or NULL without memory. */
buffon_priv_record *buffon_priv_record_make(const buffon_priv_shape *shape);
void buffon_priv_record_free(buffon_priv_record *record);

/** A copy with more cells in each stratum, empty ones; NULL without memory. */
buffon_priv_record *buffon_priv_record_grown(const buffon_priv_record *record,
                                             uint64_t per_stratum);

/** The first block of a cell that a part owns; the others follow at a distance of `parts`. */
uint64_t buffon_priv_record_first(const buffon_priv_record *record, uint64_t part, size_t cell);

/** Which part owns block k of a cell, and is the block done? */
uint64_t buffon_priv_record_owner(const buffon_priv_record *record, size_t cell, uint64_t k);
int buffon_priv_record_has(const buffon_priv_record *record, size_t cell, uint64_t k);

/** Whole blocks that a part owns among the first `blocks` of a cell. */
uint64_t buffon_priv_record_owned(const buffon_priv_record *record, uint64_t part, size_t cell,
                                  uint64_t blocks);

/** Is every point of the target there? Is any? */
int buffon_priv_record_complete(const buffon_priv_record *record);
uint64_t buffon_priv_record_points(const buffon_priv_record *record);

/** The record of a partial; NULL if it is empty. */
static inline buffon_priv_record *buffon_priv_partial_record(const buffon_partial *partial)
{
    return (buffon_priv_record *)partial->more;
}

/** The estimate of a record: out[components], as buffon_partial_estimate. */
buffon_status buffon_priv_record_estimate(buffon_estimate *out, const buffon_priv_record *record,
                                          double confidence);

/** An estimate that says only why there is none. */
buffon_estimate buffon_priv_estimate_failed(buffon_status status);

#endif
