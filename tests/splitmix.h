/* Choices of tests that must not depend on the library's generator: splitmix64 (S. Vigna, 2015). */
#ifndef TESTS_SPLITMIX_H
#define TESTS_SPLITMIX_H

#include <stdint.h>

static uint64_t splitmix_state = 1;

static inline uint64_t splitmix_word(void)
{
    uint64_t z = splitmix_state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

static inline double splitmix_uniform(double lo, double hi)
{
    return lo + (hi - lo) * ((double)(splitmix_word() >> 12) + 0.5) * 0x1p-52;
}

#endif
