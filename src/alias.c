#include "guard.h"

#include <math.h>
#include <string.h>

#include <buffon/alias.h>

#include "density_priv.h"
#include "elementary.h"
#include "shares.h"

/* ---- alias --------------------------------------------------------------------------------- */

/* A bin is one word: the threshold in the upper 62 - b of 62 bits, the other item in the lower b,
 * where there are 2^b bins. Bin i gives item i for units below the threshold, else the other one.
 * A bin that is all its own has itself as the other. Behind the bins are the probabilities, and one
 * word more. */

static uint64_t *alias_bins(const buffon_priv_table *table)
{
    return (uint64_t *)(uintptr_t)(table + 1);
}

static double *alias_pmf(const buffon_priv_table *table)
{
    return (double *)(alias_bins(table) + ((size_t)1 << table->bits[0]));
}

/* One bin at least has two halves, so that a shift by 64 - b is one. */
static unsigned alias_bits(size_t count)
{
    return buffon_priv_guide_bits(count < 2 ? 2 : count);
}

size_t buffon_alias_size(size_t count)
{
    if (count < 1 || count > SHARES_MOST)
        return SIZE_MAX;
    const size_t bins = (size_t)1 << alias_bits(count);
    return buffon_priv_table_more(
        buffon_priv_table_more(sizeof(buffon_priv_table), bins, sizeof(uint64_t)), count + 1,
        sizeof(double));
}

/* The item of a unit of 62 bits, chosen by arithmetic: no predictor knows which side it will be.
 * With the lower b bits set, the unit's part in the bin is below the word just where it is below
 * the threshold. */
static inline uint64_t alias_take(const uint64_t *bins, unsigned b, uint64_t unit)
{
    const uint64_t index = unit >> (62 - b), low = (UINT64_C(1) << b) - 1;
    const uint64_t bin = bins[index], inside = (unit << b & (SHARES_WHOLE - 1)) | low;
    const uint64_t own = 0 - (uint64_t)(inside < bin);
    return (index & own) | (bin & low & ~own);
}

/* An item's units, of those left of it in the walk below. */
static uint64_t alias_units(const uint64_t *bound, size_t k, size_t count)
{
    return k < count ? bound[k + 1] - bound[k] : 0;
}

/* The next item from k on that has more units than a bin holds. */
static size_t alias_heavy(const uint64_t *bound, size_t k, size_t count, uint64_t room)
{
    while (k < count && alias_units(bound, k, count) <= room)
        k++;
    return k;
}

/* Light items take their own bins in turn, each filled up by the heavy item whose turn it is. When
 * that has no more left than a bin holds, what is left goes to its own bin, and the next heavy item
 * fills it up. Units are whole numbers and their sum is that of all bins, so the last bin is full
 * when the last unit is gone. */
static void alias_sweep(uint64_t *bins, unsigned b, const uint64_t *bound, size_t count)
{
    const uint64_t room = SHARES_WHOLE >> b;
    const size_t end = (size_t)1 << b;
    size_t heavy = alias_heavy(bound, 0, count, room);
    uint64_t left = alias_units(bound, heavy, count);
    for (size_t k = 0; k < end; k++) {
        const uint64_t units = alias_units(bound, k, count);
        if (units > room)
            continue;
        bins[k] = units == room ? (uint64_t)k : units << b | (uint64_t)heavy;
        left -= room - units;
        while (heavy < count && left <= room) {
            const size_t next = alias_heavy(bound, heavy + 1, count, room);
            bins[heavy] = left == room ? (uint64_t)heavy : left << b | (uint64_t)next;
            left = alias_units(bound, next, count) - (room - left);
            heavy = next;
        }
    }
}

/* ---- guide --------------------------------------------------------------------------------- */

/* The bounds, the probabilities, the index. */

static uint64_t *guide_bounds(const buffon_priv_table *table)
{
    return (uint64_t *)(uintptr_t)(table + 1);
}

static double *guide_pmf(const buffon_priv_table *table)
{
    return (double *)(guide_bounds(table) + table->size[0] + 1);
}

static uint32_t *guide_first(const buffon_priv_table *table)
{
    return (uint32_t *)(guide_pmf(table) + table->size[0]);
}

size_t buffon_guide_size(size_t count)
{
    if (count < 1 || count > SHARES_MOST)
        return SIZE_MAX;
    size_t size = buffon_priv_table_more(sizeof(buffon_priv_table), count + 1, sizeof(uint64_t));
    size = buffon_priv_table_more(size, count, sizeof(double));
    return buffon_priv_table_more(size, ((size_t)1 << buffon_priv_guide_bits(count)) + 1,
                                  sizeof(uint32_t));
}

/* ---- densities ----------------------------------------------------------------------------- */

static int alias_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const buffon_priv_table *table = g->data[0];
    const uint64_t *bins = alias_bins(table);
    const double *pmf = alias_pmf(table);
    const unsigned b = (unsigned)table->bits[0];
    for (size_t i = 0; i < n; i++) {
        double rest;
        const uint64_t k = alias_take(bins, b, shares_unit(&rest, u[i]));
        x[i] = (double)(int64_t)k;
        if (pdf)
            pdf[i] = pmf[k];
    }
    return 0;
}

static int guide_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const buffon_priv_table *table = g->data[0];
    const uint64_t *bound = guide_bounds(table);
    const uint32_t *first = guide_first(table);
    const double *pmf = guide_pmf(table);
    const unsigned bits = (unsigned)table->bits[0];
    for (size_t i = 0; i < n; i++) {
        double rest;
        const size_t k = shares_find(bound, first, bits, shares_unit(&rest, u[i]));
        x[i] = (double)(int64_t)k;
        if (pdf)
            pdf[i] = pmf[k];
    }
    return 0;
}

/* Whole numbers below the count have a probability, others none. */
static void alias_look(double *pdf, const double *x, size_t n, const double *pmf, size_t count)
{
    for (size_t i = 0; i < n; i++) {
        pdf[i] = 0;
        if (x[i] >= 0 && x[i] < (double)count) {
            const size_t k = (size_t)x[i];
            if ((double)k == x[i])
                pdf[i] = pmf[k];
        }
    }
}

static int alias_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const buffon_priv_table *table = g->data[0];
    alias_look(pdf, x, n, alias_pmf(table), (size_t)table->size[0]);
    return 0;
}

static int guide_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const buffon_priv_table *table = g->data[0];
    alias_look(pdf, x, n, guide_pmf(table), (size_t)table->size[0]);
    return 0;
}

static const buffon_density_ops alias_ops = {.sample = alias_draw,
                                             .pdf = alias_pdf,
                                             .identity = buffon_priv_table_identity,
                                             .name = "buffon.alias"};

static const buffon_density_ops guide_ops = {.sample = guide_draw,
                                             .pdf = guide_pdf,
                                             .identity = buffon_priv_table_identity,
                                             .name = "buffon.guide"};

buffon_density buffon_priv_alias_view(const buffon_priv_table *table)
{
    const int alias = buffon_priv_table_kind(table) == TABLE_ALIAS;
    return (buffon_density){
        .uniforms = 1, .dim = 1, .ops = alias ? &alias_ops : &guide_ops, .data = {table, NULL}};
}

/* Weights as masses, where buffon_priv_shares_make looks for them. */
static buffon_status alias_shares(uint64_t *bound, const double *weight, size_t count,
                                  buffon_priv_shares *sum)
{
    for (size_t k = 0; k < count; k++)
        bound[k + 1] = buffon_priv_bits(weight[k]);
    return buffon_priv_shares_make(bound, count, sum);
}

/* Copied, as words stood there before, which a compiler may take for other memory. */
static void alias_normalise(double *pmf, const double *weight, size_t count,
                            const buffon_priv_shares *sum)
{
    for (size_t k = 0; k < count; k++) {
        const double p = shares_of(sum, weight[k]);
        memcpy(pmf + k, &p, sizeof p);
    }
}

/* While the bins are made the bounds stand where the probabilities come to stand. */
buffon_density buffon_alias(void *memory, size_t size, const double *weight, size_t count)
{
    buffon_status status;
    buffon_priv_shares sum;
    buffon_priv_table *table =
        buffon_priv_table_begin(&status, memory, size, buffon_alias_size(count), TABLE_ALIAS);
    if (table && !weight)
        status = BUFFON_E_NULL;
    if (status != BUFFON_OK)
        return table_refused(&alias_ops, 1, 1, status);
    table->size[0] = count;
    table->bits[0] = alias_bits(count);
    uint64_t *bound = (uint64_t *)alias_pmf(table);
    status = alias_shares(bound, weight, count, &sum);
    if (status != BUFFON_OK)
        return table_refused(&alias_ops, 1, 1, status);
    alias_sweep(alias_bins(table), (unsigned)table->bits[0], bound, count);
    alias_normalise(alias_pmf(table), weight, count, &sum);
    bound[count] = 0;
    buffon_priv_table_close(table);
    return buffon_priv_alias_view(table);
}

buffon_density buffon_guide(void *memory, size_t size, const double *weight, size_t count)
{
    buffon_status status;
    buffon_priv_shares sum;
    buffon_priv_table *table =
        buffon_priv_table_begin(&status, memory, size, buffon_guide_size(count), TABLE_GUIDE);
    if (table && !weight)
        status = BUFFON_E_NULL;
    if (status != BUFFON_OK)
        return table_refused(&guide_ops, 1, 1, status);
    table->size[0] = count;
    table->bits[0] = buffon_priv_guide_bits(count);
    status = alias_shares(guide_bounds(table), weight, count, &sum);
    if (status != BUFFON_OK)
        return table_refused(&guide_ops, 1, 1, status);
    alias_normalise(guide_pmf(table), weight, count, &sum);
    buffon_priv_guide_make(guide_first(table), (unsigned)table->bits[0], guide_bounds(table),
                           count);
    buffon_priv_table_close(table);
    return buffon_priv_alias_view(table);
}

/* ---- single items and many ----------------------------------------------------------------- */

static buffon_status alias_check(const buffon_density *g)
{
    const buffon_status status = buffon_density_check(g);
    if (status != BUFFON_OK)
        return status;
    return g->ops == &alias_ops || g->ops == &guide_ops ? BUFFON_OK : BUFFON_E_UNSUPPORTED;
}

/* Where in its side of its bin the unit is: from 0 to 1. */
static double alias_rest(const uint64_t *bins, unsigned b, uint64_t unit, double rest)
{
    const uint64_t room = SHARES_WHOLE >> b, bin = bins[unit >> (62 - b)];
    const uint64_t threshold = bin >> b, inside = unit & (room - 1);
    if (inside < threshold)
        return ((double)(int64_t)inside + rest) / (double)(int64_t)threshold;
    return ((double)(int64_t)(inside - threshold) + rest) / (double)(int64_t)(room - threshold);
}

static void alias_pick(size_t *index, double *pmf, double *rest, double u,
                       const buffon_priv_table *table)
{
    const unsigned b = (unsigned)table->bits[0];
    double below;
    const uint64_t unit = shares_unit(&below, u);
    *index = (size_t)alias_take(alias_bins(table), b, unit);
    *pmf = alias_pmf(table)[*index];
    *rest = alias_rest(alias_bins(table), b, unit, below);
}

static void guide_pick(size_t *index, double *pmf, double *rest, double u,
                       const buffon_priv_table *table)
{
    const uint64_t *bound = guide_bounds(table);
    double below, left;
    const uint64_t unit = shares_unit(&below, u);
    *index = shares_find(bound, guide_first(table), (unsigned)table->bits[0], unit);
    *pmf = guide_pmf(table)[*index];
    *rest = shares_into(&left, bound, *index, unit, below);
}

buffon_status buffon_alias_pick(size_t *index, double *pmf, double *rest, double u,
                                const buffon_density *g)
{
    buffon_status status = alias_check(g);
    size_t k = 0;
    double p = (double)NAN, r = (double)NAN;
    if (status == BUFFON_OK && !index)
        status = BUFFON_E_NULL;
    if (status == BUFFON_OK) {
        (g->ops == &alias_ops ? alias_pick : guide_pick)(&k, &p, &r, u, g->data[0]);
        r = density_open(r);
    }
    if (index)
        *index = k;
    if (pmf)
        *pmf = p;
    if (rest)
        *rest = r;
    return status;
}

enum { ALIAS_TILE = 1024 };

static void alias_translate(uint32_t *index, const uint64_t *word, size_t n,
                            const buffon_priv_table *table)
{
    if (buffon_priv_table_kind(table) == TABLE_ALIAS) {
        const uint64_t *bins = alias_bins(table);
        const unsigned b = (unsigned)table->bits[0];
        for (size_t i = 0; i < n; i++)
            index[i] = (uint32_t)alias_take(bins, b, word[i] >> 2);
    } else {
        const uint64_t *bound = guide_bounds(table);
        const uint32_t *first = guide_first(table);
        const unsigned bits = (unsigned)table->bits[0];
        for (size_t i = 0; i < n; i++)
            index[i] = (uint32_t)shares_find(bound, first, bits, word[i] >> 2);
    }
}

buffon_status buffon_alias_fill(uint32_t *index, size_t n, const buffon_density *g, buffon_rng *rng)
{
    uint64_t word[ALIAS_TILE];
    buffon_status status = alias_check(g);
    if (status == BUFFON_OK && ((n && !index) || !rng))
        status = BUFFON_E_NULL;
    for (size_t i = 0; i < n && index; i += ALIAS_TILE) {
        const size_t m = n - i < ALIAS_TILE ? n - i : ALIAS_TILE;
        if (status == BUFFON_OK) {
            buffon_rng_fill_words(word, m, rng);
            alias_translate(index + i, word, m, g->data[0]);
        } else {
            memset(index + i, 0, m * sizeof *index);
        }
    }
    return status;
}
