#include "guard.h"

#include "moments.h"

#include "elementary.h"
#include "exact.h"
#include "stats_priv.h"

/* Value i belongs to lane i mod 16. A row is four values of each lane, which are added to one
 * another first. Lanes start afresh every MOMENTS_CHUNK values: fewer numbers in a row means less
 * rounding.
 */
enum { MOMENTS_LANES = 16, MOMENTS_ROW = 4 * MOMENTS_LANES, MOMENTS_CHUNK = 1024 };

/* Scales that keep squares and their sums inside the doubles: data beyond 2^500 come down by 2^600,
 * data below 2^-400 go up by it. That is exact for all but values 2^500 times below the largest. */
#define MOMENTS_LARGE 0x1p500
#define MOMENTS_SMALL 0x1p-400
#define MOMENTS_SCALE 600

typedef struct moments_lanes {
    double r[MOMENTS_LANES], q[MOMENTS_LANES];
    double min[MOMENTS_LANES], max[MOMENTS_LANES];
} moments_lanes;

#define KERNELS "moments_lanes.h"
#include "levels.h"

static inline double moments_lesser(double a, double b)
{
    return a < b ? a : b;
}

static inline double moments_greater(double a, double b)
{
    return a > b ? a : b;
}

/* 16 lanes to one number: the upper half to the lower, and again. */
static double moments_fold(const double *lane)
{
    double t[8];
    for (int i = 0; i < 8; i++)
        t[i] = lane[i] + lane[i + 8];
    for (int i = 0; i < 4; i++)
        t[i] += t[i + 4];
    return (t[0] + t[2]) + (t[1] + t[3]);
}

static double moments_least(const double *lane)
{
    double t[8];
    for (int i = 0; i < 8; i++)
        t[i] = moments_lesser(lane[i], lane[i + 8]);
    for (int i = 0; i < 4; i++)
        t[i] = moments_lesser(t[i], t[i + 4]);
    return moments_lesser(moments_lesser(t[0], t[2]), moments_lesser(t[1], t[3]));
}

static double moments_most(const double *lane)
{
    double t[8];
    for (int i = 0; i < 8; i++)
        t[i] = moments_greater(lane[i], lane[i + 8]);
    for (int i = 0; i < 4; i++)
        t[i] = moments_greater(t[i], t[i + 4]);
    return moments_greater(moments_greater(t[0], t[2]), moments_greater(t[1], t[3]));
}

/* The values themselves, or their multiples by `scale` in the buffer. */
static const double *moments_view(double *buffer, const double *y, size_t n, double scale)
{
    if (scale == 1.0)
        return y;
    for (size_t i = 0; i < n; i++)
        buffer[i] = y[i] * scale;
    return buffer;
}

/* One chunk about the number m: adds to r and q, widens min and max. */
static void moments_chunk(moments_lanes *t, const double *y, size_t n, double m)
{
    double r[MOMENTS_LANES], q[MOMENTS_LANES];
    size_t i = n - n % MOMENTS_ROW;
    LEVELS_RUN(moments_rows, (r, q, t->min, t->max, y, n / MOMENTS_ROW, m));
    for (; i < n; i++) {
        size_t l = i % MOMENTS_LANES;
        double d = y[i] - m;
        r[l] += d;
        q[l] += d * d;
        t->min[l] = moments_lesser(t->min[l], y[i]);
        t->max[l] = moments_greater(t->max[l], y[i]);
    }
    for (size_t l = 0; l < MOMENTS_LANES; l++) {
        t->r[l] += r[l];
        t->q[l] += q[l];
    }
}

/* Everything but n and e, for the values times `scale` about the number m. */
static void moments_about(buffon_priv_moments *out, const double *y, size_t n, double m,
                          double scale)
{
    double buffer[MOMENTS_CHUNK];
    moments_lanes t;
    for (size_t l = 0; l < MOMENTS_LANES; l++) {
        t.r[l] = t.q[l] = 0;
        t.min[l] = t.max[l] = y[0] * scale;
    }
    for (size_t i = 0; i < n; i += MOMENTS_CHUNK) {
        size_t length = n - i < MOMENTS_CHUNK ? n - i : MOMENTS_CHUNK;
        moments_chunk(&t, moments_view(buffer, y + i, length, scale), length, m);
    }
    out->m = m;
    out->r = moments_fold(t.r);
    out->q = moments_fold(t.q);
    out->min = moments_least(t.min);
    out->max = moments_most(t.max);
}

/* The first value serves as m. Where it is within two standard deviations of the mean, as it mostly
 * is, one reading of the block is enough: little of q cancels in the end. */
static void moments_centre(buffon_priv_moments *out, const double *y, size_t n, double scale)
{
    moments_about(out, y, n, y[0] * scale, scale);
    double shift = out->r / (double)n;
    if (!(out->q / (double)n >= 1.25 * (shift * shift)))
        moments_about(out, y, n, out->m + shift, scale);
}

/* 2^-e. */
static double moments_factor(const buffon_priv_moments *m)
{
    return m->e == 0 ? 1.0 : m->e > 0 ? 0x1p-600 : 0x1p600;
}

size_t buffon_priv_moments_block(buffon_priv_moments *out, const double *y, size_t n)
{
    *out = (buffon_priv_moments){.n = n};
    if (n == 0)
        return 0;
    moments_centre(out, y, n, 1.0);
    if (!buffon_priv_isfinite(out->r)) { /* a value is not finite, or all are and r overflowed */
        for (size_t i = 0; i < n; i++) {
            if (!buffon_priv_isfinite(y[i]))
                return i;
        }
    }
    double min = out->min + 0.0, max = out->max + 0.0; /* -0 becomes 0 */
    double largest = moments_greater(-min, max);
    /* Of equal values, whatever their size, m is the first and r = q = 0 already. */
    if (min < max && (largest > MOMENTS_LARGE || largest < MOMENTS_SMALL)) {
        out->e = largest > MOMENTS_LARGE ? MOMENTS_SCALE : -MOMENTS_SCALE;
        moments_centre(out, y, n, moments_factor(out));
    }
    out->min = min;
    out->max = max;
    return n;
}

/* total += sum (a - ma)(b - mb) of one chunk. */
static void moments_cross_chunk(double *total, const double *a, const double *b, size_t n,
                                double ma, double mb)
{
    double q[MOMENTS_LANES];
    size_t i = n - n % MOMENTS_ROW;
    LEVELS_RUN(moments_cross_rows, (q, a, b, n / MOMENTS_ROW, ma, mb));
    for (; i < n; i++)
        q[i % MOMENTS_LANES] += (a[i] - ma) * (b[i] - mb);
    for (size_t l = 0; l < MOMENTS_LANES; l++)
        total[l] += q[l];
}

double buffon_priv_cross_block(const double *a, const double *b, size_t n,
                               const buffon_priv_moments *ma, const buffon_priv_moments *mb)
{
    double a_buffer[MOMENTS_CHUNK], b_buffer[MOMENTS_CHUNK], total[MOMENTS_LANES] = {0};
    for (size_t i = 0; i < n; i += MOMENTS_CHUNK) {
        size_t length = n - i < MOMENTS_CHUNK ? n - i : MOMENTS_CHUNK;
        const double *a_view = moments_view(a_buffer, a + i, length, moments_factor(ma));
        const double *b_view = moments_view(b_buffer, b + i, length, moments_factor(mb));
        moments_cross_chunk(total, a_view, b_view, length, ma->m, mb->m);
    }
    return moments_fold(total);
}

void buffon_priv_stats_add_block(buffon_stats *s, const buffon_priv_moments *m, const double *y)
{
    if (m->n == 0)
        return;
    buffon_priv_sum_add(s->sum, m->m, m->n, m->e);
    buffon_priv_sum_add(s->sum, m->r, 1, m->e);
    buffon_priv_squares_add(s->squares, m->m, m->m, m->n, 2 * m->e);
    buffon_priv_squares_add(s->squares, m->m, m->r, 2, 2 * m->e);
    buffon_priv_squares_add(s->squares, m->q, 1.0, 1, 2 * m->e);
    s->min = s->count == 0 ? m->min : moments_lesser(s->min, m->min);
    s->max = s->count == 0 ? m->max : moments_greater(s->max, m->max);
    s->count += m->n;
    if (moments_greater(-m->min, m->max) > s->top[BUFFON_STATS_TOP - 1])
        buffon_priv_top_add(s->top, y, m->n);
}

void buffon_priv_cross_add(uint64_t *squares, const buffon_priv_moments *ma,
                           const buffon_priv_moments *mb, double q_ab)
{
    int e = ma->e + mb->e;
    buffon_priv_squares_add(squares, ma->m, mb->m, ma->n, e);
    buffon_priv_squares_add(squares, ma->m, mb->r, 1, e);
    buffon_priv_squares_add(squares, mb->m, ma->r, 1, e);
    buffon_priv_squares_add(squares, q_ab, 1.0, 1, e);
}
