/* Private. Lanes of doubles and of 64-bit words: included by levels.h, once for each level.
 *
 * LANES_WIDTH lanes make a vector of the machine's own width; wider ones would be spilled.
 * Compilers give + - * / & | ^ << >> on vectors and with single numbers; here is what they do not
 * give, each with the result of plain C in every lane:
 *
 *     lanes_d, lanes_u, lanes_m       doubles, words, truth values
 *     lanes_all(x), lanes_words(w)    the same in all lanes
 *     lanes_load(p, m), lanes_store(p, v, m)   m lanes of memory; lanes from m on are the last one
 *     lanes_pairs(&a, &b, p, k)       p[k] and p[k + 1] of every lane; k[LANES_WIDTH] is in memory
 *     lanes_bits(v), lanes_double(w)  the bits of doubles, and back
 *     lanes_uniform(w)                the uniforms of random words: see rng.h
 *     lanes_less(a, b), lanes_less_equal(a, b), lanes_equal(a, b), lanes_odd(w)
 *     lanes_and(m, k), lanes_any(m), lanes_every(m)   the last two are ints
 *     lanes_pick(m, a, b)             m ? a : b
 *     lanes_min(a, b), lanes_max(a, b)   a < b ? a : b,  a > b ? a : b
 *     lanes_abs(v), lanes_copysign(v, s), lanes_sqrt(v)
 *     lanes_count(m)                  the number of true lanes
 *     lanes_compress(p, v, m)         the true lanes, side by side, in p[LANES_WIDTH]
 *     lanes_expand(v, p, m)           v, its true lanes from p, where they are side by side
 *
 * With one lane all of it is plain C on double and uint64_t: the portable level, and the scalar
 * functions of elementary.h, are the same source.
 */
#define lanes_d LANES(lanes_d)
#define lanes_u LANES(lanes_u)
#define lanes_m LANES(lanes_m)
#define lanes_all LANES(lanes_all)
#define lanes_words LANES(lanes_words)
#define lanes_load LANES(lanes_load)
#define lanes_store LANES(lanes_store)
#define lanes_pairs LANES(lanes_pairs)
#define lanes_bits LANES(lanes_bits)
#define lanes_double LANES(lanes_double)
#define lanes_uniform LANES(lanes_uniform)
#define lanes_less LANES(lanes_less)
#define lanes_less_equal LANES(lanes_less_equal)
#define lanes_equal LANES(lanes_equal)
#define lanes_odd LANES(lanes_odd)
#define lanes_and LANES(lanes_and)
#define lanes_any LANES(lanes_any)
#define lanes_every LANES(lanes_every)
#define lanes_pick LANES(lanes_pick)
#define lanes_min LANES(lanes_min)
#define lanes_max LANES(lanes_max)
#define lanes_abs LANES(lanes_abs)
#define lanes_copysign LANES(lanes_copysign)
#define lanes_sqrt LANES(lanes_sqrt)
#define lanes_count LANES(lanes_count)
#define lanes_compress LANES(lanes_compress)
#define lanes_expand LANES(lanes_expand)

#if LANES_WIDTH == 1

typedef double lanes_d;
typedef uint64_t lanes_u;
typedef int lanes_m;

#else

typedef double lanes_d __attribute__((vector_size(8 * LANES_WIDTH)));
typedef uint64_t lanes_u __attribute__((vector_size(8 * LANES_WIDTH)));
#if LANES_WIDTH == 8
typedef __mmask8 lanes_m;
#else
typedef int64_t lanes_m __attribute__((vector_size(8 * LANES_WIDTH))); /* 0 or -1 */
#endif

#endif

/* ---- memory ---- */

LANES_INLINE lanes_u lanes_bits(lanes_d v)
{
    lanes_u w;
    memcpy(&w, &v, sizeof w);
    return w;
}

LANES_INLINE lanes_d lanes_double(lanes_u w)
{
    lanes_d v;
    memcpy(&v, &w, sizeof v);
    return v;
}

/* The fraction of a double in [1, 2) is k, and what is subtracted is 1 - 2^-53: the difference is
 * (k + 1/2) 2^-52, a multiple of 2^-53 below 1, hence exact in any rounding mode. */
LANES_INLINE lanes_d lanes_uniform(lanes_u word)
{
    return lanes_double(word >> 12 | UINT64_C(0x3ff0000000000000)) - 0x1.fffffffffffffp-1;
}

LANES_INLINE lanes_d lanes_all(double x)
{
#if LANES_WIDTH == 1
    return x;
#else
    return x - (lanes_d){0}; /* also for -0 */
#endif
}

LANES_INLINE lanes_u lanes_words(uint64_t w)
{
#if LANES_WIDTH == 1
    return w;
#else
    return w + (lanes_u){0};
#endif
}

LANES_INLINE lanes_d lanes_load(const double *p, size_t m)
{
    lanes_d v;
    if (m >= LANES_WIDTH) {
        memcpy(&v, p, sizeof v);
    } else {
        double part[LANES_WIDTH];
        for (size_t l = 0; l < LANES_WIDTH; l++)
            part[l] = p[l < m ? l : m - 1];
        memcpy(&v, part, sizeof v);
    }
    return v;
}

LANES_INLINE void lanes_store(double *p, lanes_d v, size_t m)
{
    if (m >= LANES_WIDTH) {
        memcpy(p, &v, sizeof v);
    } else {
        double part[LANES_WIDTH];
        memcpy(part, &v, sizeof v);
        for (size_t l = 0; l < m; l++)
            p[l] = part[l];
    }
}

/* Two numbers by one load, and a transposition: cheaper than two gathers, each of which is a load
 * for every lane and more. */
#if LANES_WIDTH >= 4
LANES_INLINE __m256d LANES(lanes_two_pairs)(const double *p, const double *q)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p)), _mm_loadu_pd(q), 1);
}
#endif

LANES_INLINE void lanes_pairs(lanes_d *a, lanes_d *b, const double *p, const uint64_t *k)
{
#if LANES_WIDTH == 8
    const __m256d even = LANES(lanes_two_pairs)(p + k[0], p + k[2]);
    const __m256d odd = LANES(lanes_two_pairs)(p + k[1], p + k[3]);
    const __m256d more_even = LANES(lanes_two_pairs)(p + k[4], p + k[6]);
    const __m256d more_odd = LANES(lanes_two_pairs)(p + k[5], p + k[7]);
    const __m512d v = _mm512_insertf64x4(_mm512_castpd256_pd512(even), more_even, 1);
    const __m512d w = _mm512_insertf64x4(_mm512_castpd256_pd512(odd), more_odd, 1);
    *a = (lanes_d)_mm512_unpacklo_pd(v, w);
    *b = (lanes_d)_mm512_unpackhi_pd(v, w);
#elif LANES_WIDTH == 4
    const __m256d v = LANES(lanes_two_pairs)(p + k[0], p + k[2]);
    const __m256d w = LANES(lanes_two_pairs)(p + k[1], p + k[3]);
    *a = (lanes_d)_mm256_unpacklo_pd(v, w);
    *b = (lanes_d)_mm256_unpackhi_pd(v, w);
#elif LANES_WIDTH == 2
    *a = (lanes_d){p[k[0]], p[k[1]]};
    *b = (lanes_d){p[k[0] + 1], p[k[1] + 1]};
#else
    *a = p[*k];
    *b = p[*k + 1];
#endif
}

/* ---- choices ---- */

#if LANES_WIDTH == 8

LANES_INLINE lanes_m lanes_less(lanes_d a, lanes_d b)
{
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ);
}

LANES_INLINE lanes_m lanes_less_equal(lanes_d a, lanes_d b)
{
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LE_OQ);
}

LANES_INLINE lanes_m lanes_equal(lanes_d a, lanes_d b)
{
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_EQ_OQ);
}

LANES_INLINE lanes_m lanes_odd(lanes_u w)
{
    return _mm512_test_epi64_mask((__m512i)w, _mm512_set1_epi64(1));
}

LANES_INLINE lanes_d lanes_pick(lanes_m m, lanes_d a, lanes_d b)
{
    return (lanes_d)_mm512_mask_blend_pd(m, (__m512d)b, (__m512d)a);
}

#else

LANES_INLINE lanes_m lanes_less(lanes_d a, lanes_d b)
{
    return a < b;
}

LANES_INLINE lanes_m lanes_less_equal(lanes_d a, lanes_d b)
{
    return a <= b;
}

LANES_INLINE lanes_m lanes_equal(lanes_d a, lanes_d b)
{
    return a == b;
}

LANES_INLINE lanes_m lanes_odd(lanes_u w)
{
#if LANES_WIDTH == 1
    return (int)(w & 1);
#else
    return (lanes_m)(0 - (w & 1));
#endif
}

LANES_INLINE lanes_d lanes_pick(lanes_m m, lanes_d a, lanes_d b)
{
#if LANES_WIDTH == 1
    return m ? a : b;
#elif LANES_WIDTH == 4
    return (lanes_d)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)m);
#elif LEVELS_HAVE_X86
    return (lanes_d)_mm_or_pd(_mm_and_pd((__m128d)m, (__m128d)a),
                              _mm_andnot_pd((__m128d)m, (__m128d)b));
#else
    return lanes_double((lanes_bits(a) & (lanes_u)m) | (lanes_bits(b) & ~(lanes_u)m));
#endif
}

#endif

/* In C gcc turns the truth values of SSE2 and AVX2 into numbers of general registers and back. */
LANES_INLINE lanes_m lanes_and(lanes_m m, lanes_m k)
{
#if LANES_WIDTH == 4
    return (lanes_m)_mm256_and_pd((__m256d)m, (__m256d)k);
#elif LANES_WIDTH == 2 && LEVELS_HAVE_X86
    return (lanes_m)_mm_and_pd((__m128d)m, (__m128d)k);
#else
    return (lanes_m)(m & k);
#endif
}

LANES_INLINE int lanes_any(lanes_m m)
{
#if LANES_WIDTH == 4
    return _mm256_movemask_pd((__m256d)m) != 0;
#elif LANES_WIDTH == 2 && LEVELS_HAVE_X86
    return _mm_movemask_pd((__m128d)m) != 0;
#elif LANES_WIDTH == 2
    return (m[0] | m[1]) != 0;
#else
    return m != 0;
#endif
}

LANES_INLINE int lanes_every(lanes_m m)
{
#if LANES_WIDTH == 8
    return m == 0xff;
#elif LANES_WIDTH == 4
    return _mm256_movemask_pd((__m256d)m) == 0xf;
#elif LANES_WIDTH == 2 && LEVELS_HAVE_X86
    return _mm_movemask_pd((__m128d)m) == 0x3;
#elif LANES_WIDTH == 2
    return (m[0] & m[1]) != 0;
#else
    return m != 0;
#endif
}

/* The instructions of x86 do just what the C expressions say, with NaN and -0 too; those of ARM do
 * not. */
LANES_INLINE lanes_d lanes_min(lanes_d a, lanes_d b)
{
#if LANES_WIDTH == 8
    return (lanes_d)_mm512_min_pd((__m512d)a, (__m512d)b);
#elif LANES_WIDTH == 4
    return (lanes_d)_mm256_min_pd((__m256d)a, (__m256d)b);
#elif LANES_WIDTH == 2 && LEVELS_HAVE_X86
    return (lanes_d)_mm_min_pd((__m128d)a, (__m128d)b);
#else
    return lanes_pick(lanes_less(a, b), a, b);
#endif
}

LANES_INLINE lanes_d lanes_max(lanes_d a, lanes_d b)
{
#if LANES_WIDTH == 8
    return (lanes_d)_mm512_max_pd((__m512d)a, (__m512d)b);
#elif LANES_WIDTH == 4
    return (lanes_d)_mm256_max_pd((__m256d)a, (__m256d)b);
#elif LANES_WIDTH == 2 && LEVELS_HAVE_X86
    return (lanes_d)_mm_max_pd((__m128d)a, (__m128d)b);
#else
    return lanes_pick(lanes_less(b, a), a, b);
#endif
}

/* ---- doubles ---- */

LANES_INLINE lanes_d lanes_abs(lanes_d v)
{
    return lanes_double(lanes_bits(v) & UINT64_C(0x7fffffffffffffff));
}

/* The magnitude of v with the sign of s. */
LANES_INLINE lanes_d lanes_copysign(lanes_d v, lanes_d s)
{
    const uint64_t sign = UINT64_C(0x8000000000000000);
    return lanes_double((lanes_bits(v) & ~sign) | (lanes_bits(s) & sign));
}

LANES_INLINE lanes_d lanes_sqrt(lanes_d v)
{
#if LANES_WIDTH == 8
    return (lanes_d)_mm512_sqrt_pd((__m512d)v);
#elif LANES_WIDTH == 4
    return (lanes_d)_mm256_sqrt_pd((__m256d)v);
#elif LANES_WIDTH == 2 && LEVELS_HAVE_X86
    return (lanes_d)_mm_sqrt_pd((__m128d)v);
#elif LANES_WIDTH == 2
    return (lanes_d)vsqrtq_f64((float64x2_t)v);
#else
    return sqrt(v);
#endif
}

/* ---- lanes side by side ---- */

LANES_INLINE size_t lanes_count(lanes_m m)
{
#if LANES_WIDTH == 8
    return (size_t)__builtin_popcount(m);
#elif LANES_WIDTH == 1
    return (size_t)m;
#else
    size_t count = 0;
    for (size_t l = 0; l < LANES_WIDTH; l++)
        count += (size_t)(m[l] & 1);
    return count;
#endif
}

LANES_INLINE void lanes_compress(double *p, lanes_d v, lanes_m m)
{
#if LANES_WIDTH == 8
    _mm512_storeu_pd(p, _mm512_maskz_compress_pd(m, (__m512d)v));
#elif LANES_WIDTH == 1
    *p = v;
    (void)m;
#else
    for (size_t l = 0, k = 0; l < LANES_WIDTH; l++) {
        p[k] = v[l];
        k += (size_t)(m[l] & 1);
    }
#endif
}

LANES_INLINE lanes_d lanes_expand(lanes_d v, const double *p, lanes_m m)
{
#if LANES_WIDTH == 8
    return (lanes_d)_mm512_mask_expand_pd((__m512d)v, m, _mm512_loadu_pd(p));
#elif LANES_WIDTH == 1
    return m ? *p : v;
#else
    for (size_t l = 0, k = 0; l < LANES_WIDTH; l++) {
        v[l] = m[l] ? p[k] : v[l];
        k += (size_t)(m[l] & 1);
    }
    return v;
#endif
}

#include "lanes_math.h"

#include "lanes_circle.h"
