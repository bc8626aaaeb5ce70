/* A second implementation of the layout in buffon/rng.h, slow and plain, written from its text. */
#ifndef TESTS_RNG_NAIVE_H
#define TESTS_RNG_NAIVE_H

#include <string.h>

#include <buffon/rng.h>

static void naive_philox(uint32_t c[4], uint32_t k0, uint32_t k1)
{
    for (uint32_t round = 0; round < 10; round++) {
        uint64_t p = UINT64_C(0xd2511f53) * c[0], q = UINT64_C(0xcd9e8d57) * c[2];
        uint32_t next[4] = {(uint32_t)(q >> 32) ^ c[1] ^ (k0 + round * UINT32_C(0x9e3779b9)),
                            (uint32_t)q,
                            (uint32_t)(p >> 32) ^ c[3] ^ (k1 + round * UINT32_C(0xbb67ae85)),
                            (uint32_t)p};
        memcpy(c, next, sizeof next);
    }
}

static uint64_t naive_rotate(uint64_t x, int n)
{
    return x << n | x >> (64 - n);
}

static uint64_t naive_step(uint64_t s[4])
{
    uint64_t word = naive_rotate(s[0] + s[3], 23) + s[0], t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = naive_rotate(s[3], 45);
    return word;
}

static uint64_t naive_word(const buffon_rng_key *key, uint32_t dimension, uint64_t index)
{
    uint32_t tag = key->purpose * (UINT32_C(1) << 24) + key->replicate * (UINT32_C(1) << 16) +
                   key->stratum;
    uint32_t k[4] = {(uint32_t)key->stream, (uint32_t)(key->stream >> 32), dimension, tag};
    uint64_t s[4], word = 0;
    naive_philox(k, (uint32_t)key->seed, (uint32_t)(key->seed >> 32));
    for (unsigned h = 0; h < 2; h++) {
        uint64_t number = index / 1024 * 32 + index % 16 * 2 + h;
        uint32_t c[4] = {k[2], k[3], (uint32_t)number, (uint32_t)(number >> 32)};
        naive_philox(c, k[0], k[1]);
        s[2 * h] = c[0] + ((uint64_t)c[1] << 32);
        s[2 * h + 1] = c[2] + ((uint64_t)c[3] << 32);
    }
    for (uint64_t step = 0; step <= index % 1024 / 16; step++)
        word = naive_step(s);
    return word;
}

static int naive_is_uniform(double u, uint64_t word)
{
    double twice = (double)(2 * (word >> 12) + 1); /* below 2^53: exact */
    return u > 0 && u < 1 && u == twice * 0x1p-53 && 1 - u == (0x1p53 - twice) * 0x1p-53;
}

static int naive_is_float(float u, uint64_t word)
{
    float twice = (float)(2 * (word >> 41) + 1);
    return u > 0 && u < 1 && u == twice * 0x1p-24f && 1 - u == (0x1p24f - twice) * 0x1p-24f;
}

#endif
