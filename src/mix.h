/* Hashing of what a run depends on, for the identity of partial results. */
#ifndef BUFFON_MIX_H
#define BUFFON_MIX_H

#include <stdint.h>
#include <string.h>

/* One step: adding a word, then a bijection that carries every bit everywhere (the finaliser of
 * SplitMix64, S. Vigna 2015). */
static inline uint64_t buffon_priv_mix(uint64_t mix, uint64_t word)
{
    mix = (mix + word) * UINT64_C(0x9e3779b97f4a7c15) + UINT64_C(0x632be59bd9b4e019);
    mix = (mix ^ (mix >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    mix = (mix ^ (mix >> 27)) * UINT64_C(0x94d049bb133111eb);
    return mix ^ (mix >> 31);
}

static inline uint64_t buffon_priv_mix_double(uint64_t mix, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return buffon_priv_mix(mix, bits);
}

/* The characters of a name; NULL is told from "". */
static inline uint64_t buffon_priv_mix_name(uint64_t mix, const char *name)
{
    if (name == NULL)
        return buffon_priv_mix(mix, UINT64_MAX);
    for (; *name != '\0'; name++)
        mix = buffon_priv_mix(mix, (unsigned char)*name);
    return buffon_priv_mix(mix, 0);
}

#endif
