/* Rows of xoshiro256++ started by Philox: include/buffon/rng.h says what every bit is. The layout
 * fixes the bits, not the vectors that make them. */
#include "guard.h"

#include <buffon/rng.h>

#include <string.h>

#define RNG_LANES 16

enum { RNG_NOTHING, RNG_WORDS, RNG_UNIFORMS };

/* The calls that the header makes inline exist as symbols too. */
extern inline uint64_t buffon_rng_word(buffon_rng *rng);
extern inline double buffon_rng_next(buffon_rng *rng);
extern inline float buffon_rng_float(buffon_rng *rng);

/* ---- Philox ------------------------------------------------------------------------------- */

/* The multipliers of a round and the increments of the key. */
#define RNG_M0 UINT32_C(0xd2511f53)
#define RNG_M1 UINT32_C(0xcd9e8d57)
#define RNG_W0 UINT32_C(0x9e3779b9)
#define RNG_W1 UINT32_C(0xbb67ae85)

void buffon_rng_philox(uint32_t out[4], const uint32_t counter[4], const uint32_t key[2])
{
    uint32_t c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3];
    uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < 10; round++) {
        uint64_t p = (uint64_t)c0 * RNG_M0, q = (uint64_t)c2 * RNG_M1;
        c0 = (uint32_t)(q >> 32) ^ c1 ^ k0;
        c1 = (uint32_t)q;
        c2 = (uint32_t)(p >> 32) ^ c3 ^ k1;
        c3 = (uint32_t)p;
        k0 += RNG_W0;
        k1 += RNG_W1;
    }
    out[0] = c0;
    out[1] = c1;
    out[2] = c2;
    out[3] = c3;
}

#define KERNELS "rng_lanes.h"
#include "levels.h"

/* ---- rows --------------------------------------------------------------------------------- */

/* K of the layout. */
static void rng_derive(uint32_t k[4], const buffon_rng_key *key, uint32_t dimension)
{
    uint32_t tag = (uint32_t)key->purpose << 24 | (uint32_t)key->replicate << 16 | key->stratum;
    uint32_t counter[4] = {(uint32_t)key->stream, (uint32_t)(key->stream >> 32), dimension, tag};
    uint32_t seed[2] = {(uint32_t)key->seed, (uint32_t)(key->seed >> 32)};
    buffon_rng_philox(k, counter, seed);
}

/* The lanes where the row begins. The two blocks of a lane have one key and different counters, so
 * they differ, and the state is never all zero. */
static void rng_start(uint64_t state[4][RNG_LANES], const uint32_t k[4], uint64_t row)
{
    LEVELS_RUN(rng_start, (state, k, row));
}

static void rng_go(void *out, uint64_t state[4][RNG_LANES], size_t steps, int what)
{
    LEVELS_RUN(rng_go, (out, state, steps, what));
}

/* Those from `from` on of a row, at most to its end. Only whole steps go straight to out. */
static void rng_cut(unsigned char *out, size_t n, const uint32_t k[4], uint64_t row, size_t from,
                    int what)
{
    uint64_t state[4][RNG_LANES], step[RNG_LANES];
    size_t inside = from % RNG_LANES;
    rng_start(state, k, row);
    if (from >= RNG_LANES)
        rng_go(NULL, state, from / RNG_LANES, RNG_NOTHING);
    if (inside > 0) {
        size_t some = n < RNG_LANES - inside ? n : RNG_LANES - inside;
        rng_go(step, state, 1, what);
        memcpy(out, step + inside, 8 * some);
        out += 8 * some;
        n -= some;
    }
    if (n >= RNG_LANES)
        rng_go(out, state, n / RNG_LANES, what);
    if (n % RNG_LANES > 0) {
        rng_go(step, state, 1, what);
        memcpy(out + 8 * (n - n % RNG_LANES), step, 8 * (n % RNG_LANES));
    }
}

static void rng_stretch(void *out, size_t n, const buffon_rng_key *key, uint32_t dimension,
                        uint64_t first, int what)
{
    unsigned char *at = out;
    uint32_t k[4];
    rng_derive(k, key, dimension);
    while (n > 0) {
        size_t from = (size_t)(first % BUFFON_RNG_ROW);
        size_t some = n < BUFFON_RNG_ROW - from ? n : BUFFON_RNG_ROW - from;
        rng_cut(at, some, k, first / BUFFON_RNG_ROW, from, what);
        at += 8 * some;
        n -= some;
        first += some;
    }
}

void buffon_rng_words_at(uint64_t *w, size_t n, const buffon_rng_key *key, uint32_t dimension,
                         uint64_t first)
{
    rng_stretch(w, n, key, dimension, first, RNG_WORDS);
}

void buffon_rng_uniforms_at(double *u, size_t n, const buffon_rng_key *key, uint32_t dimension,
                            uint64_t first)
{
    rng_stretch(u, n, key, dimension, first, RNG_UNIFORMS);
}

/* ---- the sequence ------------------------------------------------------------------------- */

/* `next` is a multiple of the buffer's length. Where it begins a row, the lanes' state is not
 * looked at, and the words of the buffer before `at` never are: so whole buffers can go straight
 * to the caller, with an empty buffer left behind. */

buffon_rng buffon_rng_make(uint64_t seed, uint64_t stream)
{
    return (buffon_rng){.seed = seed, .stream = stream, .at = BUFFON_RNG_BUFFER};
}

static void rng_begin_row(buffon_rng *rng)
{
    buffon_rng_key key = {rng->seed, rng->stream, BUFFON_PURPOSE_RNG, 0, 0};
    uint32_t k[4];
    rng_derive(k, &key, 0);
    rng_start(rng->state, k, rng->next / BUFFON_RNG_ROW);
}

/* The n words from `next` on; n is a multiple of the buffer's length, and stays in the row. */
static void rng_advance(void *out, size_t n, buffon_rng *rng, int what)
{
    if (rng->next % BUFFON_RNG_ROW == 0)
        rng_begin_row(rng);
    rng_go(out, rng->state, n / RNG_LANES, what);
    rng->next += n;
}

static void rng_refill(buffon_rng *rng)
{
    rng_advance(rng->buffer, BUFFON_RNG_BUFFER, rng, RNG_WORDS);
    rng->at = 0;
}

/* n words of the buffer, as they are or as uniforms. */
static void rng_give(unsigned char *out, const uint64_t *w, size_t n, int what)
{
    if (what == RNG_WORDS) {
        memcpy(out, w, 8 * n);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        double u = lanes_uniform_scalar(w[i]);
        memcpy(out + 8 * i, &u, sizeof u);
    }
}

/* What the buffer holds, then whole buffers up to the row's end, then the start of a new buffer. */
static void rng_walk(void *out, size_t n, buffon_rng *rng, int what)
{
    unsigned char *to = out;
    while (n > 0) {
        size_t some = BUFFON_RNG_BUFFER - rng->at;
        if (some > 0) {
            if (some > n)
                some = n;
            rng_give(to, rng->buffer + rng->at, some, what);
            rng->at += (uint32_t)some;
        } else if (n < BUFFON_RNG_BUFFER) {
            rng_refill(rng);
        } else {
            size_t left = BUFFON_RNG_ROW - (size_t)(rng->next % BUFFON_RNG_ROW);
            some = n < left ? n - n % BUFFON_RNG_BUFFER : left;
            rng_advance(to, some, rng, what);
        }
        to += 8 * some;
        n -= some;
    }
}

void buffon_rng_fill(double *u, size_t n, buffon_rng *rng)
{
    rng_walk(u, n, rng, RNG_UNIFORMS);
}

void buffon_rng_fill_words(uint64_t *w, size_t n, buffon_rng *rng)
{
    rng_walk(w, n, rng, RNG_WORDS);
}

void buffon_rng_fill_floats(float *u, size_t n, buffon_rng *rng)
{
    for (size_t i = 0; i < n; i++)
        u[i] = buffon_rng_float(rng);
}

uint64_t buffon_rng_tell(const buffon_rng *rng)
{
    return rng->next - (BUFFON_RNG_BUFFER - rng->at);
}

/* Leaves a word in the buffer: skipping none is how the inline calls fill it. The lanes stand at
 * `next` already, unless the way leads elsewhere. */
void buffon_rng_seek(buffon_rng *rng, uint64_t index)
{
    uint64_t ahead = index - buffon_rng_tell(rng), start = index - index % BUFFON_RNG_BUFFER;
    if (ahead < BUFFON_RNG_BUFFER - rng->at) {
        rng->at += (uint32_t)ahead;
        return;
    }
    if (start != rng->next) {
        rng->next = start;
        if (start % BUFFON_RNG_ROW > 0) {
            rng_begin_row(rng);
            rng_go(NULL, rng->state, (size_t)(start % BUFFON_RNG_ROW) / RNG_LANES, RNG_NOTHING);
        }
    }
    rng_refill(rng);
    rng->at = (uint32_t)(index % BUFFON_RNG_BUFFER);
}

void buffon_rng_skip(buffon_rng *rng, uint64_t n)
{
    buffon_rng_seek(rng, buffon_rng_tell(rng) + n);
}

/* ---- whole numbers ------------------------------------------------------------------------ */

/* The 128 bits of a b, from products of halves. Returns the high half. */
static uint64_t rng_product(uint64_t *low, uint64_t a, uint64_t b)
{
    uint64_t a0 = a & UINT32_MAX, a1 = a >> 32, b0 = b & UINT32_MAX, b1 = b >> 32;
    uint64_t x = a0 * b0, y = a1 * b0 + (x >> 32), z = a0 * b1 + (y & UINT32_MAX);
    *low = z << 32 | (x & UINT32_MAX);
    return a1 * b1 + (y >> 32) + (z >> 32);
}

/* A word w gives floor(w bound / 2^64). Each value has floor(2^64 / bound) words or one more; the
 * one more is the first, the only one whose low half can be below 2^64 mod bound: it is refused.
 * The division is done only where the low half is below bound, which is above the remainder. */
uint64_t buffon_rng_below(buffon_rng *rng, uint64_t bound)
{
    uint64_t low, value;
    if (bound == 0)
        return buffon_rng_word(rng);
    do
        value = rng_product(&low, buffon_rng_word(rng), bound);
    while (low < bound && low < (0 - bound) % bound);
    return value;
}
