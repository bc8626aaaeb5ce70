/* Uniform numbers: many at a time into a buffer that stays in the first cache, and one by one. */
#ifndef TESTS_BENCH_UNIFORMS_H
#define TESTS_BENCH_UNIFORMS_H

#include "bench.h"
#include "peers.h"
#include "plain.h"

#define TILE 1024

/* Aligned as the widest stores like it, for everybody. */
static _Alignas(64) double buffer[8 * TILE];
/* Where the next stretch starts, always at the start of a row; and who has not been used yet. */
static uint64_t next_index, next_seed;

/* A statement that writes TILE numbers, as often as it takes. */
#define TILES(...)                                                                                 \
    do {                                                                                           \
        for (size_t tile = 0; tile < items; tile += TILE) {                                        \
            __VA_ARGS__;                                                                           \
            bench_sink = buffer[tile % 3];                                                         \
        }                                                                                          \
    } while (0)

/* ---- many at a time ---- */

static double ours_uniforms(size_t items)
{
    const buffon_rng_key key = {.seed = 1};
    TILES(buffon_rng_uniforms_at(buffer, TILE, &key, 0, next_index); next_index += TILE);
    return buffer[1];
}

static double ours_words(size_t items)
{
    static _Alignas(64) uint64_t words[TILE];
    const buffon_rng_key key = {.seed = 1};
    TILES(buffon_rng_words_at(words, TILE, &key, 0, next_index); next_index += TILE);
    return (double)words[1];
}

/* A stretch that ends at no row: pieces of 1000, so that rows are made in two cuts. */
static double ours_cut(size_t items)
{
    const buffon_rng_key key = {.seed = 1};
    static uint64_t first;
    for (size_t done = 0; done < items; done += 1000, first += 1000)
        buffon_rng_uniforms_at(buffer, items - done < 1000 ? items - done : 1000, &key, 0, first);
    return buffer[1];
}

static double ours_fill(size_t items)
{
    buffon_rng rng = buffon_rng_make(1, next_seed++);
    TILES(buffon_rng_fill(buffer, TILE, &rng));
    return buffer[1];
}

/* No generator at all: the C library's stores, the widest of the machine. */
static double store_fill(size_t items)
{
    static _Alignas(64) double stored[TILE];
    TILES(memset(stored, (int)(tile / TILE), sizeof stored));
    return stored[1];
}

static double plain_fill(size_t items)
{
    plain_rng rng = plain_make();
    TILES(for (size_t k = 0; k < TILE; k++) buffer[k] = plain_uniform(&rng));
    return buffer[1];
}

/* ---- one at a time: the quarter circle, the first program that everybody writes ---- */

#define QUARTER_CIRCLE(draw)                                                                       \
    do {                                                                                           \
        size_t hits = 0;                                                                           \
        for (size_t i = 0; i < items; i += 2) {                                                    \
            const double x = draw, y = draw;                                                       \
            hits += x * x + y * y < 1;                                                             \
        }                                                                                          \
        return (double)hits;                                                                       \
    } while (0)

static double ours_next(size_t items)
{
    buffon_rng rng = buffon_rng_make(1, next_seed++);
    QUARTER_CIRCLE(buffon_rng_next(&rng));
}

static double plain_next(size_t items)
{
    plain_rng rng = plain_make();
    QUARTER_CIRCLE(plain_uniform(&rng));
}

/* ---- other libraries ---- */

#ifdef BENCH_DSFMT
static double dsfmt_fill(size_t items)
{
    TILES(dsfmt_fill_array_close_open(&dsfmt, buffer, TILE));
    return buffer[1];
}

static double dsfmt_next(size_t items)
{
    QUARTER_CIRCLE(dsfmt_genrand_close_open(&dsfmt));
}
#else
#define dsfmt_fill NULL
#define dsfmt_next NULL
#endif

#ifdef BENCH_RANDOM123
/* 52 bits of each half of a block, as buffon takes them of a word. */
static inline double random123_uniform(uint32_t low, uint32_t high)
{
    return ((double)(((uint64_t)high << 32 | low) >> 12) + 0.5) * 0x1p-52;
}

static void random123_block(double u[2], uint64_t index)
{
    const philox4x32_key_t key = {{1, 0}};
    const philox4x32_ctr_t counter = {{(uint32_t)index, (uint32_t)(index >> 32), 0, 0}};
    const philox4x32_ctr_t out = philox4x32_R(10, counter, key);
    u[0] = random123_uniform(out.v[0], out.v[1]);
    u[1] = random123_uniform(out.v[2], out.v[3]);
}

static double random123_fill(size_t items)
{
    TILES(for (size_t k = 0; k < TILE; k += 2) random123_block(buffer + k, tile + k));
    return buffer[1];
}
#else
#define random123_fill NULL
#endif

#ifdef BENCH_GSL
static double gsl_fill(size_t items)
{
    TILES(for (size_t k = 0; k < TILE; k++) buffer[k] = gsl_rng_uniform(gsl_mt));
    return buffer[1];
}

static double gsl_taus_fill(size_t items)
{
    TILES(for (size_t k = 0; k < TILE; k++) buffer[k] = gsl_rng_uniform(gsl_taus));
    return buffer[1];
}

static double gsl_next(size_t items)
{
    QUARTER_CIRCLE(gsl_rng_uniform(gsl_mt));
}

static double gsl_taus_next(size_t items)
{
    QUARTER_CIRCLE(gsl_rng_uniform(gsl_taus));
}
#else
#define gsl_fill NULL
#define gsl_taus_fill NULL
#define gsl_next NULL
#define gsl_taus_next NULL
#endif

static void bench_uniforms(void)
{
    const bench_peer fill[] = {
        {"store only (memset): the limit", store_fill, {0}},
        {"buffon_rng_words_at", ours_words, {0}},
        {"buffon_rng_uniforms_at, 1000 at a time", ours_cut, {0}},
        {"buffon_rng_fill", ours_fill, {0}},
        {"scalar xoshiro256++", plain_fill, {0, 0.8, 1.6, 3.2}},
        {"dSFMT fill_array_close_open", dsfmt_fill, {0}},
        {"Random123 philox4x32x10", random123_fill, {0}},
        {"GSL taus2", gsl_taus_fill, {0}},
        {"GSL mt19937", gsl_fill, {0, 4, 8, 16}},
    };
    const bench_peer next[] = {
        {"scalar xoshiro256++", plain_next, {0.8, 0.8, 0.8, 0.8}},
        {"dSFMT genrand_close_open", dsfmt_next, {0}},
        {"GSL taus2", gsl_taus_next, {0}},
        {"GSL mt19937", gsl_next, {0}},
    };
    bench_header("ns per number");
    bench_group("uniforms, 1024 at a time", ours_uniforms, fill, COUNT(fill));
    bench_group("uniforms, one at a time", ours_next, next, COUNT(next));
}

#endif
