#include "guard.h"

#include <buffon/points.h>

#include "mix.h"
#include "points_priv.h"

/* Points are worked on in tiles that fit the stack and the first cache. */
#define POINTS_TILE 1024

static int points_fill_random(double *u, const buffon_points_block *block,
                              const buffon_points *self)
{
    (void)self;
    for (size_t j = 0; j < block->dim; j++)
        buffon_rng_uniforms_at(u + j * block->n, block->n, &block->key, (uint32_t)j, block->first);
    return 0;
}

buffon_points buffon_points_random(void)
{
    return (buffon_points){.fill = points_fill_random, .name = "buffon.random"};
}

/* Pair p is the uniform p of each dimension and its mirror image; the points from `first` on. */
static void points_pairs(double *row, size_t n, const buffon_rng_key *key, uint32_t dimension,
                         uint64_t first)
{
    double pair[POINTS_TILE + 1];
    const size_t odd = (size_t)(first & 1);
    buffon_rng_uniforms_at(pair, (odd + n + 1) / 2, key, dimension, first / 2);
    if (odd)
        row[0] = 1 - pair[0];
    for (size_t k = 0; k < (n - odd) / 2; k++) {
        const double v = pair[odd + k];
        row[odd + 2 * k] = v;
        row[odd + 2 * k + 1] = 1 - v;
    }
    if ((n - odd) % 2)
        row[n - 1] = pair[(n - odd) / 2 + odd];
}

static int points_fill_antithetic(double *u, const buffon_points_block *block,
                                  const buffon_points *self)
{
    (void)self;
    for (size_t j = 0; j < block->dim; j++) {
        for (size_t i = 0; i < block->n; i += 2 * POINTS_TILE) {
            const size_t left = block->n - i;
            points_pairs(u + j * block->n + i, left < 2 * POINTS_TILE ? left : 2 * POINTS_TILE,
                         &block->key, (uint32_t)j, block->first + i);
        }
    }
    return 0;
}

static uint64_t points_round_pairs(size_t dim, const buffon_points *self)
{
    (void)dim;
    (void)self;
    return 2;
}

buffon_points buffon_points_antithetic(void)
{
    return (buffon_points){.fill = points_fill_antithetic,
                           .round = points_round_pairs,
                           .design = BUFFON_DESIGN_ANTITHETIC,
                           .name = "buffon.antithetic"};
}

/* k^dim, or 0 where it is more than 2^40 (or k is 0). */
static uint64_t points_cells(uint64_t k, size_t dim)
{
    const uint64_t most = UINT64_C(1) << 40;
    uint64_t cells = 1;
    if (k <= 1)
        return k;
    for (size_t j = 0; j < dim; j++) {
        if (cells > most / k)
            return 0;
        cells *= k;
    }
    return cells;
}

static uint64_t points_round_jitter(size_t dim, const buffon_points *self)
{
    return 2 * points_cells(self->param[0], dim);
}

/* A keyed permutation of 0 .. cells - 1. Each step (add, odd multiple, shifted xor) is a bijection
 * of the next power of two; what falls outside walks on along its cycle until it is back inside. */
typedef struct points_shuffle {
    uint64_t cells, mask;
    unsigned shift;
    uint64_t key[8];
} points_shuffle;

static points_shuffle points_shuffle_make(uint64_t cells, const buffon_rng_key *key, uint64_t sweep)
{
    points_shuffle s = {.cells = cells, .mask = 1};
    buffon_rng_key own = *key;
    unsigned bits = 1;
    for (; s.mask < cells - 1; bits++)
        s.mask = 2 * s.mask + 1;
    s.shift = (bits + 1) / 2;
    own.purpose = BUFFON_PURPOSE_SHUFFLE;
    buffon_rng_words_at(s.key, 8, &own, key->purpose, 8 * sweep);
    return s;
}

static uint64_t points_shuffle_at(const points_shuffle *s, uint64_t i)
{
    do {
        for (unsigned round = 0; round < 8; round++) {
            i = (i + s->key[round]) & s->mask;
            i ^= i >> s->shift;
            i = (i * (s->key[7 - round] | 1)) & s->mask;
        }
    } while (i >= s->cells);
    return i;
}

/* Point q is in sweep q / 2M over the M cells; within it, pair q / 2 mod M has the cell that the
 * sweep's permutation gives. Its place in the cell is the uniform q of each dimension. */
static int points_fill_jitter(double *u, const buffon_points_block *block,
                              const buffon_points *self)
{
    const uint64_t k = self->param[0], cells = points_cells(k, block->dim);
    const double side = 1 / (double)k, below_one = 1 - 0x1p-53;
    uint64_t cell[POINTS_TILE];
    uint64_t sweep = UINT64_MAX;
    points_shuffle shuffle = {.cells = 0};
    for (size_t j = 0; j < block->dim; j++)
        buffon_rng_uniforms_at(u + j * block->n, block->n, &block->key, (uint32_t)j, block->first);
    for (size_t i = 0; i < block->n; i += POINTS_TILE) {
        const size_t m = block->n - i < POINTS_TILE ? block->n - i : POINTS_TILE;
        for (size_t t = 0; t < m; t++) {
            const uint64_t point = block->first + i + t, pair = point / 2;
            if (t > 0 && (point & 1)) { /* it has its pair's cell */
                cell[t] = cell[t - 1];
                continue;
            }
            if (pair / cells != sweep) {
                sweep = pair / cells;
                shuffle = points_shuffle_make(cells, &block->key, sweep);
            }
            cell[t] = points_shuffle_at(&shuffle, pair % cells);
        }
        for (size_t j = 0; j < block->dim; j++) {
            double *row = u + j * block->n + i;
            for (size_t t = 0; t < m; t++) {
                const double v = ((double)(cell[t] % k) + row[t]) * side;
                row[t] = v < below_one ? v : below_one;
                cell[t] /= k;
            }
        }
    }
    return 0;
}

buffon_points buffon_points_jitter(uint64_t k)
{
    return (buffon_points){.fill = points_fill_jitter,
                           .round = points_round_jitter,
                           .design = BUFFON_DESIGN_STRATIFIED,
                           .name = "buffon.jitter",
                           .param = {k}};
}

/* The numbers come from outside, so each is checked. */
static int points_fill_replay(double *u, const buffon_points_block *block,
                              const buffon_points *self)
{
    const size_t count = (size_t)self->limit, first = (size_t)block->first;
    const double *data = self->data;
    int bad = block->dim != self->param[0] || block->first > count || block->n > count - first;
    for (size_t j = 0; j < block->dim && !bad; j++) {
        for (size_t i = 0; i < block->n; i++) {
            const double v = data[j * count + first + i];
            bad |= !(v > 0 && v < 1);
            u[j * block->n + i] = v;
        }
    }
    return bad;
}

int buffon_priv_points_serve(const buffon_points *points, size_t strata)
{
    return points->fill != points_fill_replay || points->design == BUFFON_DESIGN_NONE ||
           (strata == 1 && points->replicates <= 1);
}

static uint64_t points_round_replay(size_t dim, const buffon_points *self)
{
    if (dim != self->param[0])
        return 0;
    return self->design == BUFFON_DESIGN_ANTITHETIC ? 2 : 1;
}

buffon_points buffon_points_replay(const double *u, size_t dim, size_t count, buffon_design design)
{
    buffon_points points = {.round = points_round_replay,
                            .design = design,
                            .limit = count,
                            .name = "buffon.replay",
                            .param = {dim},
                            .data = u};
    const int known = design == BUFFON_DESIGN_INDEPENDENT || design == BUFFON_DESIGN_ANTITHETIC ||
                      design == BUFFON_DESIGN_NONE;
    if (u == NULL || count == 0 || !known || dim > SIZE_MAX / count)
        return points; /* without `fill` it is refused where it is used */
    points.fill = points_fill_replay;
    for (size_t i = 0; i < dim * count; i++) /* partial results tell numbers apart by this */
        points.param[1] = buffon_priv_mix_double(points.param[1], u[i]);
    return points;
}
