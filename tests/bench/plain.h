/* The same work written plainly, as one writes it without a library: scalar xoshiro256++ and libm.
 * The generator's state is a local variable of the loop, as in the best of such programs. */
#ifndef TESTS_BENCH_PLAIN_H
#define TESTS_BENCH_PLAIN_H

#include <math.h>
#include <stdint.h>

#define PLAIN_PI 3.14159265358979323846

typedef struct plain_rng {
    uint64_t s[4];
} plain_rng;

static plain_rng plain_make(void)
{
    return (plain_rng){{0x9e3779b97f4a7c15, 0xbf58476d1ce4e5b9, 0x94d049bb133111eb, 1}};
}

static inline uint64_t plain_rotl(uint64_t x, int k)
{
    return (x << k) | (x >> (64 - k));
}

/* xoshiro256++ (Blackman and Vigna, 2021). */
static inline double plain_uniform(plain_rng *rng)
{
    uint64_t *s = rng->s;
    const uint64_t result = plain_rotl(s[0] + s[3], 23) + s[0], t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = plain_rotl(s[3], 45);
    return ((double)(result >> 12) + 0.5) * 0x1p-52;
}

/* A point of the sphere at z >= cut. */
static inline void plain_cap(double x[3], double cut, plain_rng *rng)
{
    const double z = 1 - (1 - cut) * plain_uniform(rng), r = sqrt(1 - z * z);
    const double a = 2 * PLAIN_PI * plain_uniform(rng);
    x[0] = r * cos(a);
    x[1] = r * sin(a);
    x[2] = z;
}

static inline void plain_disk(double x[2], plain_rng *rng)
{
    const double r = sqrt(plain_uniform(rng)), a = 2 * PLAIN_PI * plain_uniform(rng);
    x[0] = r * cos(a);
    x[1] = r * sin(a);
}

/* Of points of the square, the first in the disk: no sine, but jumps that nobody predicts. */
static inline void plain_disk_rejection(double x[2], plain_rng *rng)
{
    do {
        x[0] = 2 * plain_uniform(rng) - 1;
        x[1] = 2 * plain_uniform(rng) - 1;
    } while (x[0] * x[0] + x[1] * x[1] >= 1);
}

/* Marsaglia (1972): a point of the disk, bent up to the sphere. */
static inline void plain_sphere_rejection(double x[3], plain_rng *rng)
{
    plain_disk_rejection(x, rng);
    const double s = x[0] * x[0] + x[1] * x[1], r = 2 * sqrt(1 - s);
    x[0] *= r;
    x[1] *= r;
    x[2] = 1 - 2 * s;
}

static inline void plain_cosine(double x[3], plain_rng *rng)
{
    plain_disk(x, rng);
    x[2] = sqrt(1 - x[0] * x[0] - x[1] * x[1]);
}

/* Box and Muller (1958): two normals. */
static inline void plain_normals(double x[2], plain_rng *rng)
{
    const double r = sqrt(-2 * log(plain_uniform(rng))), a = 2 * PLAIN_PI * plain_uniform(rng);
    x[0] = r * cos(a);
    x[1] = r * sin(a);
}

#endif
