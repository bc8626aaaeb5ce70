/* Numbers for the tests of samples, and samples of them by both ways. */
#ifndef TESTS_SAMPLES_H
#define TESTS_SAMPLES_H

#include "tap.h"

#include <math.h>
#include <stdlib.h>

#include <buffon/stats.h>

#include "exact.h"
#include "moments.h"
#include "stats_priv.h"

enum { MANY = 1 << 17 };

static double data[MANY];
static uint64_t random_state = 1;

static inline uint64_t random_word(void)
{
    uint64_t z = random_state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

static inline double random_unit(void)
{
    return ((double)(random_word() >> 12) + 0.5) * 0x1p-52;
}

static inline size_t random_below(size_t n)
{
    return (size_t)(random_word() % n);
}

static inline int close_to(double x, double expected, double relative)
{
    if (!(fabs(x - expected) <= relative * fabs(expected))) {
        tap_note("got %.17g, expected %.17g: %.2g", x, expected, fabs(x / expected - 1.0));
        return 0;
    }
    return 1;
}

static inline buffon_stats add_all(const double *y, size_t n)
{
    buffon_stats s = {0};
    buffon_stats_add(&s, y, n);
    return s;
}

/* As the engine does it. */
static inline buffon_stats add_blocks(const double *y, size_t n, size_t block)
{
    buffon_stats s = {0};
    for (size_t i = 0; i < n; i += block) {
        buffon_priv_moments m;
        size_t length = n - i < block ? n - i : block;
        if (buffon_priv_moments_block(&m, y + i, length) != length)
            tap_ok(0, "finite data were refused");
        buffon_priv_stats_add_block(&s, &m, y + i);
    }
    return s;
}

static inline int same_stats(const buffon_stats *a, const buffon_stats *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

static inline void fill_wild(double *y, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        y[i] = ldexp(random_unit() - 0.5, (int)random_below(2000) - 1000);
        if (random_below(10) == 0)
            y[i] = i % 2 ? INFINITY : -0.0;
    }
}

/* For qsort. */
static inline int falling(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

#endif
