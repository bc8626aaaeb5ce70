/* The same work written plainly, as one writes it without a library: scalar xoshiro256++ and libm.
 * And the same work by GSL, where it is installed (BENCH_GSL). */
#ifndef TESTS_BENCH_PLAIN_H
#define TESTS_BENCH_PLAIN_H

#include <math.h>
#include <stdint.h>

#ifdef BENCH_GSL
#include <gsl/gsl_monte_plain.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#endif

static uint64_t plain_state[4] = {1, 2, 3, 4};

static inline uint64_t plain_rotl(uint64_t x, int k)
{
    return (x << k) | (x >> (64 - k));
}

/* xoshiro256++ (Blackman and Vigna, 2021). */
static inline double plain_uniform(void)
{
    uint64_t *s = plain_state;
    const uint64_t result = plain_rotl(s[0] + s[3], 23) + s[0], t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = plain_rotl(s[3], 45);
    return ((double)(result >> 12) + 0.5) * 0x1p-52;
}

static inline void plain_sphere(double x[3])
{
    const double z = 1 - 2 * plain_uniform(), r = sqrt(1 - z * z);
    const double a = 2 * 3.14159265358979323846 * plain_uniform();
    x[0] = r * cos(a);
    x[1] = r * sin(a);
    x[2] = z;
}

static inline void plain_cap(double x[3], double cut)
{
    const double z = 1 - (1 - cut) * plain_uniform(), r = sqrt(1 - z * z);
    const double a = 2 * 3.14159265358979323846 * plain_uniform();
    x[0] = r * cos(a);
    x[1] = r * sin(a);
    x[2] = z;
}

static inline void plain_disk(double x[2])
{
    const double r = sqrt(plain_uniform()), a = 2 * 3.14159265358979323846 * plain_uniform();
    x[0] = r * cos(a);
    x[1] = r * sin(a);
}

static inline void plain_cosine(double x[3])
{
    plain_disk(x);
    x[2] = sqrt(1 - x[0] * x[0] - x[1] * x[1]);
}

#endif
