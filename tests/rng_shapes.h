/* Shapes: orders of words in which a generator with keys could fail though each of its sequences
 * alone is good. Neighbours of one kind are laid side by side, or combined; test_rng_stats.c and
 * the battery read them as one stream. A shape makes chunk after chunk of words.
 */
#ifndef TESTS_RNG_SHAPES_H
#define TESTS_RNG_SHAPES_H

#include <buffon/rng.h>

enum { SHAPE_CHUNK = 65536, SHAPE_MEMBERS = 64 };

typedef struct shape {
    const char *name;
    void (*make)(uint64_t *w, uint64_t chunk, int kind);
    int kind;
} shape;

/* What the members differ in: their number, or one bit of it. */
enum {
    SHAPE_SEED, SHAPE_STREAM, SHAPE_DIMENSION, SHAPE_ROW, SHAPE_PURPOSE, SHAPE_REPLICATE,
    SHAPE_STRATUM, SHAPE_SEED_BIT, SHAPE_STREAM_BIT, SHAPE_DIMENSION_BIT, SHAPE_ROW_BIT,
    SHAPE_TAG_BIT
};

static uint64_t shape_reverse(uint64_t x, int bits)
{
    uint64_t y = 0;
    for (int i = 0; i < bits; i++)
        y |= (x >> i & 1) << (bits - 1 - i);
    return y;
}

/* Row `chunk` of member m, below 128; below 64 for the kinds that differ in a bit. */
static void shape_row(uint64_t row[1024], int kind, unsigned m, uint64_t chunk)
{
    buffon_rng_key key = {1, 2, BUFFON_PURPOSE_MAIN, 0, 0};
    uint32_t dimension = 0, bit32 = m < 32 ? UINT32_C(1) << m : ~(UINT32_C(1) << m % 32);
    uint64_t first = chunk * BUFFON_RNG_ROW;
    switch (kind) {
    case SHAPE_SEED: key.seed = 1000 + m; break;
    case SHAPE_STREAM: key.stream = m; break;
    case SHAPE_DIMENSION: dimension = m; break;
    case SHAPE_ROW: first = (128 * chunk + m) * BUFFON_RNG_ROW; break;
    case SHAPE_PURPOSE: key.purpose = (uint8_t)m; break;
    case SHAPE_REPLICATE: key.replicate = (uint8_t)m; break;
    case SHAPE_STRATUM: key.stratum = (uint16_t)m; break;
    case SHAPE_SEED_BIT: key.seed = UINT64_C(1) << m; break;
    case SHAPE_STREAM_BIT: key.stream = UINT64_C(1) << m; break;
    case SHAPE_DIMENSION_BIT: dimension = bit32; break;
    case SHAPE_ROW_BIT: first = shape_reverse(64 * chunk + m, 54) * BUFFON_RNG_ROW; break;
    default:
        key.purpose = (uint8_t)(bit32 >> 24);
        key.replicate = (uint8_t)(bit32 >> 16);
        key.stratum = (uint16_t)bit32;
    }
    buffon_rng_words_at(row, 1024, &key, dimension, first);
}

/* The members in turn. */
static void shape_interleave(uint64_t *w, uint64_t chunk, int kind)
{
    uint64_t row[1024];
    for (unsigned m = 0; m < SHAPE_MEMBERS; m++) {
        shape_row(row, kind, m, chunk);
        for (unsigned i = 0; i < 1024; i++)
            w[SHAPE_MEMBERS * i + m] = row[i];
    }
}

/* Members 2m and 2m + 1, combined. */
static void shape_xor(uint64_t *w, uint64_t chunk, int kind)
{
    uint64_t a[1024], b[1024];
    for (unsigned m = 0; m < SHAPE_MEMBERS; m++) {
        shape_row(a, kind, 2 * m, chunk);
        shape_row(b, kind, 2 * m + 1, chunk);
        for (unsigned i = 0; i < 1024; i++)
            w[1024 * m + i] = a[i] ^ b[i];
    }
}

static void shape_difference(uint64_t *w, uint64_t chunk, int kind)
{
    uint64_t a[1024], b[1024];
    for (unsigned m = 0; m < SHAPE_MEMBERS; m++) {
        shape_row(a, kind, 2 * m, chunk);
        shape_row(b, kind, 2 * m + 1, chunk);
        for (unsigned i = 0; i < 1024; i++)
            w[1024 * m + i] = b[i] - a[i];
    }
}

/* The first four words of each of very many sequences. */
static void shape_heads(uint64_t *w, uint64_t chunk, int kind)
{
    for (unsigned i = 0; i < SHAPE_CHUNK / 4; i++) {
        uint64_t number = chunk * (SHAPE_CHUNK / 4) + i;
        buffon_rng rng = buffon_rng_make(kind == SHAPE_SEED ? number : 5,
                                         kind == SHAPE_STREAM ? number : 6);
        for (unsigned j = 0; j < 4; j++)
            w[4 * i + j] = buffon_rng_word(&rng);
    }
}

/* Eight words around the beginning of each row. */
static void shape_edges(uint64_t *w, uint64_t chunk, int kind)
{
    const buffon_rng_key key = {3, 4, BUFFON_PURPOSE_MAIN, 0, 0};
    for (unsigned i = 0; i < SHAPE_CHUNK / 8; i++) {
        uint64_t row = chunk * (SHAPE_CHUNK / 8) + i + 1;
        buffon_rng_words_at(w + 8 * i, 8, &key, (uint32_t)kind, row * BUFFON_RNG_ROW - 4);
    }
}

static buffon_rng shape_sequence(uint64_t position)
{
    buffon_rng rng = buffon_rng_make(1, 2);
    buffon_rng_seek(&rng, position);
    return rng;
}

/* One sequence, word for word or by fills of odd size. */
static void shape_words(uint64_t *w, uint64_t chunk, int fill)
{
    buffon_rng rng = shape_sequence(chunk * SHAPE_CHUNK);
    for (size_t i = 0, n; i < SHAPE_CHUNK; i += n) {
        n = 777 < SHAPE_CHUNK - i ? 777 : SHAPE_CHUNK - i;
        if (fill)
            buffon_rng_fill_words(w + i, n, &rng);
        else
            for (size_t j = 0; j < n; j++)
                w[i + j] = buffon_rng_word(&rng);
    }
}

/* The bits of uniforms, 52 of a double or 23 of a float, one after the other. */
static void shape_uniforms(uint64_t *w, uint64_t chunk, int bits)
{
    size_t count = (size_t)(SHAPE_CHUNK * 64 / bits) + 1, out = 0;
    buffon_rng rng = shape_sequence(chunk * count);
    uint64_t word = 0;
    int have = 0;
    while (out < SHAPE_CHUNK) {
        uint64_t k = (uint64_t)(bits == 52 ? buffon_rng_next(&rng) * 0x1p52
                                           : (double)buffon_rng_float(&rng) * 0x1p23);
        word |= k << have;
        have += bits;
        if (have >= 64) {
            w[out++] = word;
            have -= 64;
            word = have > 0 ? k >> (bits - have) : 0;
        }
    }
}

/* The words from the low bit up, for tests that look at the high ones. */
static void shape_reversed(uint64_t *w, uint64_t chunk, int fill)
{
    shape_words(w, chunk, fill);
    for (size_t i = 0; i < SHAPE_CHUNK; i++)
        w[i] = shape_reverse(w[i], 64);
}

static const shape shape_list[] = {
    {"words", shape_words, 0},
    {"fills", shape_words, 1},
    {"reversed", shape_reversed, 1},
    {"doubles", shape_uniforms, 52},
    {"floats", shape_uniforms, 23},
    {"edges", shape_edges, 0},
    {"seed heads", shape_heads, SHAPE_SEED},
    {"stream heads", shape_heads, SHAPE_STREAM},
    {"seeds", shape_interleave, SHAPE_SEED},
    {"streams", shape_interleave, SHAPE_STREAM},
    {"dimensions", shape_interleave, SHAPE_DIMENSION},
    {"rows", shape_interleave, SHAPE_ROW},
    {"purposes", shape_interleave, SHAPE_PURPOSE},
    {"replicates", shape_interleave, SHAPE_REPLICATE},
    {"strata", shape_interleave, SHAPE_STRATUM},
    {"seed bits", shape_interleave, SHAPE_SEED_BIT},
    {"stream bits", shape_interleave, SHAPE_STREAM_BIT},
    {"dimension bits", shape_interleave, SHAPE_DIMENSION_BIT},
    {"row bits", shape_interleave, SHAPE_ROW_BIT},
    {"tag bits", shape_interleave, SHAPE_TAG_BIT},
    {"seeds xor", shape_xor, SHAPE_SEED},
    {"streams xor", shape_xor, SHAPE_STREAM},
    {"dimensions xor", shape_xor, SHAPE_DIMENSION},
    {"rows xor", shape_xor, SHAPE_ROW},
    {"purposes xor", shape_xor, SHAPE_PURPOSE},
    {"replicates xor", shape_xor, SHAPE_REPLICATE},
    {"strata xor", shape_xor, SHAPE_STRATUM},
    {"seeds difference", shape_difference, SHAPE_SEED},
    {"streams difference", shape_difference, SHAPE_STREAM},
    {"dimensions difference", shape_difference, SHAPE_DIMENSION},
    {"rows difference", shape_difference, SHAPE_ROW},
};

enum { SHAPE_COUNT = sizeof shape_list / sizeof shape_list[0] };

#endif
