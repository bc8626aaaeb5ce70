/* Private. The summary of one block of values, and how it enters a sample.
 *
 * Value i goes to lane i % 16, in an order that tests/test_moments.c spells out, and the lanes are
 * folded by a fixed tree. So the compiler may use vectors of any width without changing a bit.
 */
#ifndef BUFFON_SRC_MOMENTS_H
#define BUFFON_SRC_MOMENTS_H

#include <stddef.h>
#include <stdint.h>

#include "buffon/stats.h"

/* With y = 2^e y': m is a number near the mean of the y', r = sum(y' - m), q = sum((y' - m)^2). So
 * the sum of the y' is n m + r and the sum of their squares n m^2 + 2 m r + q, without
 * cancellation. e is 0 unless max |y| is so large or small that q could leave the doubles. Where
 * all values are equal, m is that value and r = q = 0. min and max are of y itself, never -0. */
typedef struct buffon_priv_moments {
    size_t n;
    int e;
    double m, r, q;
    double min, max;
} buffon_priv_moments;

/* Summarises a block. Returns n if every value is finite, else the index of the first that is not
 * (out is then undefined). All of out is zero for n = 0. */
size_t buffon_priv_moments_block(buffon_priv_moments *out, const double *y, size_t n);

/* sum (a' - ma)(b' - mb) of two finite blocks, scaled by 2^-(ma->e + mb->e). */
double buffon_priv_cross_block(const double *a, const double *b, size_t n,
                               const buffon_priv_moments *ma, const buffon_priv_moments *mb);

/* Adds a block to a sample; y[m->n] are its values, for the largest. */
void buffon_priv_stats_add_block(buffon_stats *s, const buffon_priv_moments *m, const double *y);

/* Adds a block of products a b to their exact sum. */
void buffon_priv_cross_add(uint64_t *squares, const buffon_priv_moments *ma,
                           const buffon_priv_moments *mb, double q_ab);

#endif
