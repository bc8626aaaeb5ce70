/* Layer 1. Random bits: every number is a pure function of where it stands.
 *
 * A word (64 bits) is W(seed, stream, purpose, stratum, replicate, dimension, index). Nothing is
 * carried from one word to the next, so any stretch of indices can be had in any order by any
 * thread, and asking for more samples or dimensions changes none that were there.
 *
 * The layout, so that anybody can write it again (all integers little end first; Philox is
 * Philox4x32-10, four counter words, two key words):
 *
 *   tag  = purpose 2^24 + replicate 2^16 + stratum                   (8, 8 and 16 bits)
 *   K    = Philox(counter = {stream low, stream high, dimension, tag}; key = {seed low, seed high})
 *   row  = index / 1024, the unit in which words are made
 *   lane = index mod 16,  step = (index mod 1024) / 16               (the 16 lanes take turns)
 *   A lane of a row starts at two Philox blocks, h = 0 and 1, keyed by {K[0], K[1]} with
 *        counter = {K[2], K[3], low, high} of the 64 bits  row 2^5 + lane 2 + h.
 *   Block 0 gives the state words s[0], s[1], block 1 gives s[2], s[3], each from two outputs, low
 *   first. Word (row, lane, step) is output number `step` of xoshiro256++ from that state, the
 *   first output being number 0.
 *
 * Philox permutes its counters under one key. So the two blocks of a lane differ, which excludes
 * the all-zero state; and no two lanes of one seed have a block with the same key and counter.
 *
 * Source: J. Salmon, M. Moraes, R. Dror, D. Shaw (2011), Parallel random numbers: as easy as
 *         1, 2, 3;
 *         D. Blackman, S. Vigna (2021), Scrambled linear pseudorandom number generators;
 *         D. Lemire (2019), Fast random integer generation in an interval.
 */
#ifndef BUFFON_RNG_H
#define BUFFON_RNG_H

#include <string.h>

#include "api.h"
#include "status.h"

BUFFON_BEGIN

/** What numbers are for. No two uses share one: a pilot never repeats the main run. */
typedef enum buffon_purpose {
    BUFFON_PURPOSE_MAIN = 0,     /* the coordinates of an estimate */
    BUFFON_PURPOSE_PILOT = 1,    /* of its pilot */
    BUFFON_PURPOSE_RNG = 2,      /* the sequence of a buffon_rng */
    BUFFON_PURPOSE_SHUFFLE = 3,  /* permutations of point sets */
    BUFFON_PURPOSE_SCRAMBLE = 4, /* scrambles of Sobol' points */
    BUFFON_PURPOSE_USER = 128    /* 128 to 255 are the caller's */
} buffon_purpose;

/** Which of the independent sequences: the types hold exactly the values allowed. */
typedef struct buffon_rng_key {
    uint64_t seed;
    uint64_t stream;
    uint8_t purpose; /* a buffon_purpose */
    uint8_t replicate;
    uint16_t stratum;
} buffon_rng_key;

/** The words of a row of the layout above. */
#define BUFFON_RNG_ROW 1024

/** Words first, first + 1, ... of one dimension.
 *
 *  Out:     w[n]       64 random bits each; n = 0 does nothing
 *  In:      key        whose words
 *           dimension  which of 2^32 sequences of the key
 *           first      index of w[0]; indices wrap at 2^64
 *  Repeat:  a pure function of its arguments; cutting a stretch differently changes no word
 *  Cost:    whole rows at full speed; a cut inside a row makes that row's head again
 *  Since:   0.1
 */
BUFFON_API void buffon_rng_words_at(uint64_t *w, size_t n, const buffon_rng_key *key,
                                    uint32_t dimension, uint64_t first);

/** Uniforms first, first + 1, ... of one dimension: those of the words at the same indices.
 *
 *  Out:     u[n]  in (0, 1): u = (k + 1/2) 2^-52 with k the top 52 bits of the word
 *  Law:     each k equally likely; 0, 1 and 1/2 never occur, and 1 - u is exact and in the same set
 *  Repeat:  as buffon_rng_words_at
 *  Since:   0.1
 */
BUFFON_API void buffon_rng_uniforms_at(double *u, size_t n, const buffon_rng_key *key,
                                       uint32_t dimension, uint64_t first);

/** Philox4x32-10: a keyed permutation of 128 bits that serves as a random function of a counter.
 *
 *  Out:     out[4]
 *  In:      counter[4], key[2]; out may be counter
 *  Source:  Salmon et al. (2011)
 *  Since:   0.1
 */
BUFFON_API void buffon_rng_philox(uint32_t out[4], const uint32_t counter[4],
                                  const uint32_t key[2]);

#define BUFFON_RNG_BUFFER 256

/** A sequence of random numbers: dimension 0 of purpose BUFFON_PURPOSE_RNG, walked in order.
 *
 *  A plain value: a copy is a checkpoint, and two copies go on alike. Not for two threads at once;
 *  give each thread its own stream. The fields are private.
 */
typedef struct buffon_rng {
    uint64_t seed, stream;
    uint64_t next;                      /* index of the first word not yet in the buffer */
    uint64_t state[4][16];              /* the lanes, where the buffer ends */
    uint64_t buffer[BUFFON_RNG_BUFFER]; /* the words before `next` */
    uint32_t at;                        /* the first one not yet given out */
    uint32_t reserved;
} buffon_rng;

/** A sequence at its first number.
 *
 *  In:      seed, stream  any; different pairs give independent sequences
 *  Repeat:  shares no number with an estimate of the same seed and stream
 *  Since:   0.1
 */
BUFFON_API buffon_rng buffon_rng_make(uint64_t seed, uint64_t stream);

/** How many words have been given out.
 *
 *  In:      rng
 *  Since:   0.1
 */
BUFFON_API uint64_t buffon_rng_tell(const buffon_rng *rng);

/** Goes to the word with this index, forwards or back, in constant time.
 *
 *  In/Out:  rng
 *  In:      index  of the word that is given out next
 *  Since:   0.1
 */
BUFFON_API void buffon_rng_seek(buffon_rng *rng, uint64_t index);

/** Leaves out the next n words, in constant time.
 *
 *  In/Out:  rng
 *  In:      n  modulo 2^64
 *  Since:   0.1
 */
BUFFON_API void buffon_rng_skip(buffon_rng *rng, uint64_t n);

/** The next 64 random bits.
 *
 *  In/Out:  rng  moves on by one word
 *  Since:   0.1
 */
BUFFON_API inline uint64_t buffon_rng_word(buffon_rng *rng)
{
    if (rng->at == BUFFON_RNG_BUFFER)
        buffon_rng_skip(rng, 0); /* fills the buffer */
    return rng->buffer[rng->at++];
}

/** The next n words, as buffon_rng_word gives them.
 *
 *  Out:     w[n]
 *  In/Out:  rng  moves on by n words
 *  Since:   0.1
 */
BUFFON_API void buffon_rng_fill_words(uint64_t *w, size_t n, buffon_rng *rng);

/** The next uniform in (0, 1), as buffon_rng_uniforms_at makes it.
 *
 *  In/Out:  rng  moves on by one word
 *  Since:   0.1
 */
BUFFON_API inline double buffon_rng_next(buffon_rng *rng)
{
    /* The fraction of a double in [1, 2) is k, and 1 - 2^-53 is subtracted: always exact. */
    uint64_t bits = buffon_rng_word(rng) >> 12 | UINT64_C(0x3ff0000000000000);
    double u;
    memcpy(&u, &bits, sizeof u);
    return u - 0x1.fffffffffffffp-1;
}

/** The next n uniforms: the same numbers that n calls of buffon_rng_next give, however cut.
 *
 *  Out:     u[n]  in (0, 1); n = 0 draws nothing
 *  In/Out:  rng   moves on by n words
 *  Since:   0.1
 */
BUFFON_API void buffon_rng_fill(double *u, size_t n, buffon_rng *rng);

/** The next uniform float in (0, 1): (k + 1/2) 2^-23 with k the top 23 bits of a word.
 *
 *  In/Out:  rng  moves on by one word
 *  Law:     0 and 1 never occur; 1 - u is exact and in the same set
 *  Since:   0.1
 */
BUFFON_API inline float buffon_rng_float(buffon_rng *rng)
{
    uint32_t bits = (uint32_t)(buffon_rng_word(rng) >> 41) | UINT32_C(0x3f800000);
    float u;
    memcpy(&u, &bits, sizeof u);
    return u - 0x1.fffffep-1f;
}

/** The next n floats, as buffon_rng_float gives them.
 *
 *  Out:     u[n]
 *  In/Out:  rng  moves on by n words
 *  Since:   0.1
 */
BUFFON_API void buffon_rng_fill_floats(float *u, size_t n, buffon_rng *rng);

/** A whole number from 0 to bound - 1, each exactly equally likely.
 *
 *  In/Out:  rng    moves on by one word, seldom more (with probability below bound 2^-64 each time)
 *  In:      bound  0 stands for 2^64
 *  Source:  Lemire (2019), algorithm 5
 *  Since:   0.1
 */
BUFFON_API uint64_t buffon_rng_below(buffon_rng *rng, uint64_t bound);

BUFFON_END

#endif
