#include "guard.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <buffon/partial.h>

#include "exact.h"
#include "net.h"
#include "record.h"
#include "spread.h"

/* The saved form: 64-bit words, little end first.
 *
 *     magic  version  words in all  shape  weights  targets  done  cells (whole, then tail)
 * checksum
 *
 * A cell is its series of statistics (count, nonfinite, min, max, sum, squares, top), then its
 * cross products. An empty partial has shape words of zero and nothing between them and the
 * checksum.
 */
#define PARTIAL_MAGIC UINT64_C(0x4c41495452415042) /* "BPARTIAL" as bytes */
#define PARTIAL_VERSION 1
#define PARTIAL_HEAD (3 + BUFFON_PRIV_SHAPE_WORDS)
#define PARTIAL_STATS_WORDS (4 + BUFFON_STATS_SUM + BUFFON_STATS_SQUARES + BUFFON_STATS_TOP)

/* One walk over a record serves saving and loading, so the two cannot disagree. */
typedef struct partial_stream {
    unsigned char *out;      /* saving: where the next byte goes */
    const unsigned char *in; /* loading: where it comes from */
} partial_stream;

static void partial_word(partial_stream *s, uint64_t *word)
{
    if (s->out != NULL) {
        for (unsigned i = 0; i < 8; i++)
            *s->out++ = (unsigned char)(*word >> (8 * i));
    } else {
        *word = 0;
        for (unsigned i = 0; i < 8; i++)
            *word |= (uint64_t)*s->in++ << (8 * i);
    }
}

static void partial_words(partial_stream *s, uint64_t *words, size_t n)
{
    for (size_t i = 0; i < n; i++)
        partial_word(s, &words[i]);
}

static void partial_doubles(partial_stream *s, double *x, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, &x[i], sizeof bits);
        partial_word(s, &bits);
        memcpy(&x[i], &bits, sizeof bits);
    }
}

static void partial_stats(partial_stream *s, buffon_stats *stats)
{
    partial_word(s, &stats->count);
    partial_word(s, &stats->nonfinite);
    partial_doubles(s, &stats->min, 1);
    partial_doubles(s, &stats->max, 1);
    partial_words(s, stats->sum, BUFFON_STATS_SUM);
    partial_words(s, stats->squares, BUFFON_STATS_SQUARES);
    partial_doubles(s, stats->top, BUFFON_STATS_TOP);
}

static void partial_cells(partial_stream *s, const buffon_priv_cells *cells,
                          const buffon_priv_shape *shape)
{
    const size_t n = buffon_priv_shape_cells(shape);
    const size_t series = buffon_priv_shape_series(shape), cross = buffon_priv_shape_cross(shape);
    for (size_t c = 0; c < n; c++) {
        for (size_t i = 0; i < series; i++)
            partial_stats(s, &cells->stats[c * series + i]);
        partial_words(s, cells->cross + c * cross, cross);
    }
}

static void partial_body(partial_stream *s, buffon_priv_record *record)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t cells = buffon_priv_shape_cells(shape);
    partial_doubles(s, record->weight, (size_t)shape->strata);
    partial_words(s, record->target, cells);
    partial_words(s, record->done, (size_t)shape->parts * cells);
    partial_cells(s, &record->whole, shape);
    partial_cells(s, &record->tail, shape);
}

/* n + a * b, or SIZE_MAX where that is too much. */
static size_t partial_more(size_t n, uint64_t a, uint64_t b)
{
    const size_t most = SIZE_MAX / 16;
    if (n > most || (a > 0 && b > most / a) || a * b > most - n)
        return SIZE_MAX;
    return n + (size_t)(a * b);
}

/* All words of a saved record of this shape; SIZE_MAX where no memory could hold it. */
static size_t partial_count(const buffon_priv_shape *shape)
{
    const uint64_t cells = shape->strata * shape->per_stratum;
    size_t cell = partial_more(0, buffon_priv_shape_series(shape), PARTIAL_STATS_WORDS);
    size_t n = PARTIAL_HEAD + 1;
    cell = partial_more(cell, buffon_priv_shape_cross(shape), 1);
    n = partial_more(n, shape->strata, 1);
    n = partial_more(n, cells, 1);
    n = partial_more(n, shape->parts, cells);
    return partial_more(n, 2 * cells, cell);
}

/* FNV-1a: each step is a bijection of the hash, so any one damaged byte is seen for certain. */
static uint64_t partial_checksum(const unsigned char *bytes, size_t n)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    return hash;
}

size_t buffon_partial_size(const buffon_partial *partial)
{
    if (partial == NULL)
        return 0;
    if (partial->more == NULL)
        return 8 * (PARTIAL_HEAD + 1);
    return 8 * partial_count(&buffon_priv_partial_record(partial)->shape);
}

buffon_status buffon_partial_save(void *bytes, size_t size, const buffon_partial *partial)
{
    const size_t need = buffon_partial_size(partial);
    uint64_t head[3] = {PARTIAL_MAGIC, PARTIAL_VERSION, need / 8};
    buffon_priv_shape none = {0};
    partial_stream s = {.out = bytes};
    uint64_t checksum;
    if (bytes == NULL || partial == NULL)
        return BUFFON_E_NULL;
    if (size < need)
        return BUFFON_E_SIZE;
    partial_words(&s, head, 3);
    if (partial->more == NULL) {
        partial_words(&s, (uint64_t *)&none, BUFFON_PRIV_SHAPE_WORDS);
    } else {
        buffon_priv_record *record = buffon_priv_partial_record(partial);
        partial_words(&s, (uint64_t *)&record->shape, BUFFON_PRIV_SHAPE_WORDS);
        partial_body(&s, record);
    }
    checksum = partial_checksum(bytes, need - 8);
    partial_word(&s, &checksum);
    return BUFFON_OK;
}

/* Could a stratum have so many cells, and a median products? */
static int partial_plausible_cells(const buffon_priv_shape *shape)
{
    if (shape->design == BUFFON_DESIGN_NET)
        return shape->per_stratum >= BUFFON_PRIV_NET_RANGES && shape->per_stratum % 4 == 1 &&
               shape->per_stratum <= BUFFON_PRIV_NET_RANGES_MOST;
    if (shape->design == BUFFON_DESIGN_MEDIAN && (shape->per_stratum % 2 == 0 || shape->covariance))
        return 0;
    return shape->per_stratum > 0 && shape->per_stratum <= BUFFON_PRIV_REPLICATES;
}

/* Could a run have made this shape? The checksum guards against accidents; this and the exact size
 * guard the memory against everything else. */
static int partial_plausible(const buffon_priv_shape *shape)
{
    const uint64_t many = UINT64_C(1) << 20, far = UINT64_C(1) << 27;
    double scale;
    memcpy(&scale, &shape->scale_m, sizeof scale);
    if (!(scale > 0 && scale <= 1) || shape->scale_e + far > 2 * far)
        return 0;
    return shape->kind <= BUFFON_PRIV_RATIO && shape->design <= BUFFON_DESIGN_MEDIAN &&
           shape->components > 0 && shape->components <= many &&
           shape->outputs == shape->components + (shape->kind == BUFFON_PRIV_RATIO) &&
           shape->covariance <= 1 && shape->constant <= 1 &&
           (shape->covariance || shape->kind != BUFFON_PRIV_RATIO ||
            shape->design == BUFFON_DESIGN_MEDIAN) &&
           shape->strata > 0 && shape->strata <= 65536 && partial_plausible_cells(shape) &&
           shape->block >= 16 && shape->block <= many && !(shape->block & (shape->block - 1)) &&
           shape->round > 0 && shape->parts > 0 && shape->parts <= UINT32_MAX && shape->looks > 0 &&
           shape->looks <= 64;
}

/* Are the targets of a stratum those of a net? The ranges from the first on, each whole. */
static int partial_is_net(const uint64_t *target, size_t ranges)
{
    size_t wanted = 0;
    while (wanted < ranges && target[wanted] == buffon_priv_net_size(wanted))
        wanted++;
    for (size_t r = wanted; r < ranges; r++) {
        if (target[r] > 0)
            return 0;
    }
    return wanted >= BUFFON_PRIV_NET_RANGES && wanted % 4 == 1;
}

/* Do the counts of a record fit each other, and are its weights numbers? */
static int partial_consistent(const buffon_priv_record *record)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t cells = buffon_priv_shape_cells(shape), series = buffon_priv_shape_series(shape);
    for (size_t s = 0; s < shape->strata; s++) {
        if (!(record->weight[s] - record->weight[s] == 0))
            return 0;
    }
    for (size_t s = 0; s < shape->strata && shape->design == BUFFON_DESIGN_NET; s++) {
        const size_t ranges = (size_t)shape->per_stratum;
        if (!partial_is_net(record->target + s * ranges, ranges))
            return 0;
    }
    for (size_t c = 0; c < cells; c++) {
        const uint64_t blocks = record->target[c] / shape->block;
        const uint64_t rest = record->target[c] % shape->block;
        uint64_t whole = 0;
        for (uint64_t p = 0; p < shape->parts; p++) {
            const uint64_t done = record->done[p * cells + c];
            if (done > buffon_priv_record_owned(record, p, c, blocks))
                return 0;
            whole += done * shape->block;
        }
        const uint64_t tail = buffon_priv_cell_count(&record->tail, c, shape);
        if (buffon_priv_cell_count(&record->whole, c, shape) != whole || (tail && tail != rest))
            return 0;
        for (size_t i = 0; i < series; i++) {
            const uint64_t halves = i < shape->outputs ? 1 : 2;
            if (record->whole.stats[c * series + i].count != whole / halves ||
                record->tail.stats[c * series + i].count != tail / halves)
                return 0;
        }
    }
    return 1;
}

buffon_status buffon_partial_load(buffon_partial *partial, const void *bytes, size_t size)
{
    partial_stream s = {.in = bytes};
    uint64_t head[3], checksum;
    buffon_priv_shape shape;
    buffon_priv_record *record = NULL;
    if (partial == NULL || bytes == NULL)
        return BUFFON_E_NULL;
    if (size < 8 * (PARTIAL_HEAD + 1))
        return BUFFON_E_SIZE;
    partial_words(&s, head, 3);
    if (head[0] != PARTIAL_MAGIC || head[1] != PARTIAL_VERSION || head[2] < PARTIAL_HEAD + 1)
        return BUFFON_E_CORRUPT;
    if (head[2] > size / 8)
        return BUFFON_E_SIZE;
    partial_words(&s, (uint64_t *)&shape, BUFFON_PRIV_SHAPE_WORDS);
    partial_stream end = {.in = (const unsigned char *)bytes + 8 * (head[2] - 1)};
    partial_word(&end, &checksum);
    if (checksum != partial_checksum(bytes, 8 * ((size_t)head[2] - 1)))
        return BUFFON_E_CORRUPT;
    if (head[2] == PARTIAL_HEAD + 1) {
        if (memcmp(&shape, &(buffon_priv_shape){0}, sizeof shape) != 0)
            return BUFFON_E_CORRUPT;
    } else {
        if (!partial_plausible(&shape) || partial_count(&shape) != head[2])
            return BUFFON_E_CORRUPT;
        record = buffon_priv_record_make(&shape);
        if (record == NULL)
            return BUFFON_E_NOMEM;
        partial_body(&s, record);
        if (!partial_consistent(record)) {
            buffon_priv_record_free(record);
            return BUFFON_E_CORRUPT;
        }
    }
    buffon_partial_free(partial);
    partial->more = record;
    return BUFFON_OK;
}

void buffon_partial_free(buffon_partial *partial)
{
    if (partial == NULL)
        return;
    buffon_priv_record_free(buffon_priv_partial_record(partial));
    *partial = (buffon_partial){{0}, NULL};
}

/* May these be added: the same run, and no block in both? */
static buffon_status partial_compatible(const buffon_priv_record *a, const buffon_priv_record *b)
{
    const buffon_priv_shape *shape = &a->shape;
    const size_t cells = buffon_priv_shape_cells(shape);
    if (memcmp(shape, &b->shape, sizeof *shape) != 0)
        return BUFFON_E_MISMATCH;
    if (memcmp(a->weight, b->weight, (size_t)shape->strata * sizeof(double)) != 0 ||
        memcmp(a->target, b->target, cells * sizeof(uint64_t)) != 0)
        return BUFFON_E_MISMATCH;
    for (size_t i = 0; i < (size_t)shape->parts * cells; i++) {
        if (a->done[i] > 0 && b->done[i] > 0)
            return BUFFON_E_OVERLAP;
    }
    for (size_t c = 0; c < cells; c++) {
        if (buffon_priv_cell_count(&a->tail, c, shape) &&
            buffon_priv_cell_count(&b->tail, c, shape))
            return BUFFON_E_OVERLAP;
    }
    return BUFFON_OK;
}

static void partial_add(buffon_priv_record *into, const buffon_priv_record *from)
{
    const buffon_priv_shape *shape = &into->shape;
    const size_t cells = buffon_priv_shape_cells(shape);
    for (size_t i = 0; i < (size_t)shape->parts * cells; i++)
        into->done[i] += from->done[i];
    for (size_t c = 0; c < cells; c++) {
        buffon_priv_cell_merge(&into->whole, &from->whole, c, shape);
        buffon_priv_cell_merge(&into->tail, &from->tail, c, shape);
    }
}

buffon_status buffon_partial_merge(buffon_partial *into, const buffon_partial *from)
{
    if (into == NULL || from == NULL)
        return BUFFON_E_NULL;
    const buffon_priv_record *b = buffon_priv_partial_record(from);
    buffon_priv_record *a = buffon_priv_partial_record(into);
    if (b == NULL)
        return BUFFON_OK;
    if (a == NULL) {
        a = buffon_priv_record_make(&b->shape);
        if (a == NULL)
            return BUFFON_E_NOMEM;
        memcpy(a->weight, b->weight, (size_t)b->shape.strata * sizeof(double));
        memcpy(a->target, b->target, buffon_priv_shape_cells(&b->shape) * sizeof(uint64_t));
        into->more = a;
    } else {
        const buffon_status status = partial_compatible(a, b);
        if (status != BUFFON_OK)
            return status;
    }
    partial_add(a, b);
    return BUFFON_OK;
}

size_t buffon_partial_components(const buffon_partial *partial)
{
    if (partial == NULL || partial->more == NULL)
        return 0;
    return (size_t)buffon_priv_partial_record(partial)->shape.components;
}

buffon_status buffon_partial_estimate(buffon_estimate *out, const buffon_partial *partial,
                                      double confidence)
{
    buffon_status status = BUFFON_OK;
    if (out == NULL)
        return BUFFON_E_NULL;
    if (partial == NULL)
        status = BUFFON_E_NULL;
    else if (partial->more == NULL)
        status = BUFFON_E_EMPTY;
    else if (confidence != 0 && !(confidence > 0 && confidence < 1))
        status = BUFFON_E_CONFIDENCE;
    if (status == BUFFON_OK)
        return buffon_priv_record_estimate(out, buffon_priv_partial_record(partial), confidence);
    const size_t n =
        partial != NULL && partial->more != NULL ? buffon_partial_components(partial) : 1;
    for (size_t k = 0; k < n; k++)
        out[k] = buffon_priv_estimate_failed(status);
    return status;
}

buffon_status buffon_partial_covariance(double *cov, const buffon_partial *partial)
{
    const size_t n = buffon_partial_components(partial);
    if (cov == NULL || partial == NULL)
        return BUFFON_E_NULL;
    if (n == 0)
        return BUFFON_E_EMPTY;
    const buffon_priv_record *record = buffon_priv_partial_record(partial);
    buffon_status status = record->shape.covariance ? BUFFON_OK : BUFFON_E_UNSUPPORTED;
    for (size_t s = 0; s < record->shape.strata && status == BUFFON_OK; s++)
        status = buffon_priv_spread_count(record, s) > 0 ? BUFFON_OK : BUFFON_E_EMPTY;
    for (size_t k = 0; k < n; k++) {
        for (size_t l = 0; l < n; l++) {
            double *entry = &cov[k * n + l];
            if (status != BUFFON_OK)
                *entry = NAN;
            else if (l < k)
                *entry = cov[l * n + k];
            else
                *entry = buffon_priv_wide_to_double(buffon_priv_spread_of(record, k, l).square);
        }
    }
    return status;
}
