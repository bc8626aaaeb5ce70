/* Private. Compiles a file of kernels once for each set of vector instructions:
 *
 *     #define KERNELS "sphere_lanes.h"
 *     #include "levels.h"
 *
 * A kernel in that file is `static void LANES(sphere_map)(...)`, written with the lanes of lanes.h
 * and the functions of lanes_math.h; it returns nothing. LEVELS_RUN(sphere_map, (x, y, n)) calls
 * the one for the level in use.
 *
 * The instructions are asked for by pragmas around the kernels, so a build needs no flags for
 * single files; ifunc and target_clones, which clang and musl lack, are not needed either. Included
 * without KERNELS this file says which levels there are: LEVELS_HAVE_128 and LEVELS_HAVE_X86.
 */
#ifndef LEVELS_H
#define LEVELS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <buffon/cpu.h>

#include "circle.h"
#include "elementary.h"
#include "frame.h"

/* BUFFON_NO_VECTORS leaves plain C, which is also what a compiler without vectors gets. */
#if defined(BUFFON_NO_VECTORS) || !defined(__GNUC__)
#define LEVELS_HAVE_128 0
#define LEVELS_HAVE_X86 0
#elif defined(__SSE2__)
#define LEVELS_HAVE_128 1
#define LEVELS_HAVE_X86 1
#include <immintrin.h>
#elif defined(__aarch64__)
#define LEVELS_HAVE_128 1
#define LEVELS_HAVE_X86 0
#include <arm_neon.h>
#else
#define LEVELS_HAVE_128 0
#define LEVELS_HAVE_X86 0
#endif

#if defined(__GNUC__)
#define LANES_INLINE static inline __attribute__((always_inline))
#else
#define LANES_INLINE static inline
#endif

#define LEVELS_JOIN_(name, level) name##_##level
#define LEVELS_JOIN(name, level) LEVELS_JOIN_(name, level)
#define LANES(name) LEVELS_JOIN(name, LANES_LEVEL)

#if LEVELS_HAVE_X86
#define LEVELS_CASES(name, arguments)                                                              \
    case BUFFON_LEVEL_AVX512:                                                                      \
        name##_avx512 arguments;                                                                   \
        break;                                                                                     \
    case BUFFON_LEVEL_AVX2:                                                                        \
        name##_avx2 arguments;                                                                     \
        break;                                                                                     \
    case BUFFON_LEVEL_128:                                                                         \
        name##_128 arguments;                                                                      \
        break;
#elif LEVELS_HAVE_128
#define LEVELS_CASES(name, arguments)                                                              \
    case BUFFON_LEVEL_128:                                                                         \
        name##_128 arguments;                                                                      \
        break;
#else
#define LEVELS_CASES(name, arguments)
#endif

#define LEVELS_RUN(name, arguments)                                                                \
    do {                                                                                           \
        switch ((int)buffon_cpu_level()) {                                                         \
            LEVELS_CASES(name, arguments)                                                          \
        default:                                                                                   \
            name##_scalar arguments;                                                               \
            break;                                                                                 \
        }                                                                                          \
    } while (0)

#endif

#ifdef KERNELS

/* ---- plain C ---- */

#define LANES_LEVEL scalar
#define LANES_WIDTH 1
#ifndef LEVELS_SCALAR
#define LEVELS_SCALAR
#include "lanes.h"
#endif
#include KERNELS
#undef LANES_LEVEL
#undef LANES_WIDTH

/* ---- what the build has anyway ---- */

#if LEVELS_HAVE_128
#define LANES_LEVEL 128
#define LANES_WIDTH 2
#ifndef LEVELS_128
#define LEVELS_128
#include "lanes.h"
#endif
#include KERNELS
#undef LANES_LEVEL
#undef LANES_WIDTH
#endif

/* ---- what the machine may have ---- */

#if LEVELS_HAVE_X86
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#define LANES_LEVEL avx2
#define LANES_WIDTH 4
#ifndef LEVELS_AVX2
#define LEVELS_AVX2
#include "lanes.h"
#endif
#include KERNELS
#undef LANES_LEVEL
#undef LANES_WIDTH
#if defined(__clang__)
#pragma clang attribute pop
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,avx512bw"))),        \
                             apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx512bw")
#endif
#define LANES_LEVEL avx512
#define LANES_WIDTH 8
#ifndef LEVELS_AVX512
#define LEVELS_AVX512
#include "lanes.h"
#endif
#include KERNELS
#undef LANES_LEVEL
#undef LANES_WIDTH
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

#undef KERNELS
#endif
