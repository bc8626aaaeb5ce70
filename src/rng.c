/* Rows of xoshiro256++ started by Philox: include/buffon/rng.h says what every bit is.
 *
 * The 16 lanes of a row go through the registers in groups of two vectors, each group for all the
 * steps asked for, its words stored 16 apart. Two vectors hide the latency of the chain, and their
 * eight state words leave room for the temporaries in 16 registers. Rejected: vectors wider than
 * those of the machine (gcc spills them) and plain loops for the compiler to vectorise (gcc does
 * not). A vector of one word is an integer, so the same source is the portable one.
 *
 * A vector may have any width up to 64 bytes: the layout fixes the bits, not the vector.
 */
#include "guard.h"

#include <buffon/rng.h>

#include <string.h>

/* BUFFON_NO_VECTORS asks for the plain loops. */
#if defined(BUFFON_NO_VECTORS) || !defined(__GNUC__)
#define RNG_VECTOR 8
#elif defined(__AVX512F__)
#define RNG_VECTOR 64
#elif defined(__AVX2__)
#define RNG_VECTOR 32
#elif defined(__SSE2__) || defined(__ARM_NEON)
#define RNG_VECTOR 16
#else
#define RNG_VECTOR 8
#endif

#if RNG_VECTOR > 8 && defined(__SSE2__)
#include <immintrin.h>
#endif

#if RNG_VECTOR > 8
typedef uint64_t rng_vector __attribute__((vector_size(RNG_VECTOR)));
typedef double rng_doubles __attribute__((vector_size(RNG_VECTOR)));
#else
typedef uint64_t rng_vector;
typedef double rng_doubles;
#endif

#if defined(__GNUC__)
#define RNG_INLINE static inline __attribute__((always_inline))
#else
#define RNG_INLINE static inline
#endif

#define RNG_LANES 16
#define RNG_WIDTH (RNG_VECTOR / 8) /* lanes of a vector */

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

/* The products of the low halves: one instruction on x86, which gcc does not find by itself. */
RNG_INLINE rng_vector rng_multiply(rng_vector a, uint32_t b)
{
#if RNG_VECTOR == 64
    return (rng_vector)_mm512_mul_epu32((__m512i)a, _mm512_set1_epi64(b));
#elif RNG_VECTOR == 32
    return (rng_vector)_mm256_mul_epu32((__m256i)a, _mm256_set1_epi64x(b));
#elif RNG_VECTOR == 16 && defined(__SSE2__)
    return (rng_vector)_mm_mul_epu32((__m128i)a, _mm_set1_epi64x(b));
#else
    return (a & UINT32_MAX) * b;
#endif
}

/* The same with a block in each lane of a vector. A counter word is the low half of its lane; what
 * the high half holds between the rounds is never looked at. */
RNG_INLINE void rng_philox(rng_vector c[4], uint32_t k0, uint32_t k1)
{
    for (int round = 0; round < 10; round++) {
        rng_vector p = rng_multiply(c[0], RNG_M0), q = rng_multiply(c[2], RNG_M1);
        c[0] = q >> 32 ^ c[1] ^ k0;
        c[1] = q;
        c[2] = p >> 32 ^ c[3] ^ k1;
        c[3] = p;
        k0 += RNG_W0;
        k1 += RNG_W1;
    }
}

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
    static const uint64_t block[RNG_LANES] = {0,  2,  4,  6,  8,  10, 12, 14,
                                              16, 18, 20, 22, 24, 26, 28, 30};
    for (int lane = 0; lane < RNG_LANES; lane += RNG_WIDTH) {
        for (uint32_t h = 0; h < 2; h++) {
            rng_vector c[4], low;
            memcpy(&low, &block[lane], sizeof low);
            c[0] = (rng_vector){0} + k[2];
            c[1] = (rng_vector){0} + k[3];
            c[2] = low + ((uint32_t)(row << 5) | h);
            c[3] = (rng_vector){0} + (uint32_t)(row >> 27);
            rng_philox(c, k[0], k[1]);
            for (int j = 0; j < 2; j++) {
                rng_vector s = (c[2 * j] & UINT32_MAX) | c[2 * j + 1] << 32;
                memcpy(&state[2 * h + (uint32_t)j][lane], &s, sizeof s);
            }
        }
    }
}

RNG_INLINE rng_vector rng_rotate(rng_vector x, int n)
{
    return x << n | x >> (64 - n);
}

/* xoshiro256++ */
RNG_INLINE rng_vector rng_step(rng_vector s[4])
{
    rng_vector word = rng_rotate(s[0] + s[3], 23) + s[0];
    rng_vector t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rng_rotate(s[3], 45);
    return word;
}

/* The fraction of a double in [1, 2) is k, and what is subtracted is 1 - 2^-53: the difference is
 * (k + 1/2) 2^-52, a multiple of 2^-53 below 1, hence exact in any rounding mode. */
RNG_INLINE void rng_put(unsigned char *out, size_t at, rng_vector word, int what)
{
    if (what == RNG_WORDS)
        memcpy(out + at, &word, sizeof word);
    if (what == RNG_UNIFORMS) {
        rng_doubles u;
        word = word >> 12 | UINT64_C(0x3ff0000000000000);
        memcpy(&u, &word, sizeof u);
        u -= 0x1.fffffffffffffp-1;
        memcpy(out + at, &u, sizeof u);
    }
}

RNG_INLINE void rng_run(unsigned char *out, uint64_t state[4][RNG_LANES], size_t steps, int what)
{
    for (size_t lane = 0; lane < RNG_LANES; lane += 2 * RNG_WIDTH) {
        rng_vector a[4], b[4];
        for (int j = 0; j < 4; j++) {
            memcpy(&a[j], &state[j][lane], sizeof a[j]);
            memcpy(&b[j], &state[j][lane + RNG_WIDTH], sizeof b[j]);
        }
        for (size_t i = 0; i < steps; i++) {
            size_t at = 8 * (RNG_LANES * i + lane);
            rng_put(out, at, rng_step(a), what);
            rng_put(out, at + RNG_VECTOR, rng_step(b), what);
        }
        for (int j = 0; j < 4; j++) {
            memcpy(&state[j][lane], &a[j], sizeof a[j]);
            memcpy(&state[j][lane + RNG_WIDTH], &b[j], sizeof b[j]);
        }
    }
}

/* The next steps of all lanes, 16 words or uniforms each; with RNG_NOTHING they are passed over. */
static void rng_go(void *out, uint64_t state[4][RNG_LANES], size_t steps, int what)
{
    if (what == RNG_UNIFORMS)
        rng_run(out, state, steps, RNG_UNIFORMS);
    else if (what == RNG_WORDS)
        rng_run(out, state, steps, RNG_WORDS);
    else
        rng_run(NULL, state, steps, RNG_NOTHING);
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

/* n words of the buffer, as they are or as uniforms (see rng_put). */
static void rng_give(unsigned char *out, const uint64_t *w, size_t n, int what)
{
    if (what == RNG_WORDS) {
        memcpy(out, w, 8 * n);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        uint64_t bits = w[i] >> 12 | UINT64_C(0x3ff0000000000000);
        double u;
        memcpy(&u, &bits, sizeof u);
        u -= 0x1.fffffffffffffp-1;
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
