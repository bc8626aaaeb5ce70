/* Private. What every source file needs of its compiler, checked before anything else: the bits of
 * a result are promised to be the same everywhere, so each operation must round once, to a double,
 * in the order written. Included first by every file of src.
 *
 * The Makefile passes -ffp-contract=off. The pragmas say the same where these files are dropped
 * into another build: gcc contracts a*b + c to one rounding in its gnu modes, clang in every mode.
 * Where the flag is given the pragma changes no instruction.
 */
#ifndef BUFFON_SRC_GUARD_H
#define BUFFON_SRC_GUARD_H

/* pthreads, clocks and signal masks under -std=c11. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif

#include <float.h>
#include <limits.h>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) ||    \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "buffon needs IEEE arithmetic: build it without -ffast-math and the flags it stands for"
#endif

/* 1, 16, 32 and 64 widen narrower types to a double at most, which does no harm; 2 is the x87,
 * where doubles carry spare bits. */
#if FLT_EVAL_METHOD < 0 || FLT_EVAL_METHOD == 2 || FLT_EVAL_METHOD > 64
#error "buffon needs doubles that round to double: on 32-bit x86 build with -msse2 -mfpmath=sse"
#endif

#if CHAR_BIT != 8 || FLT_RADIX != 2 || DBL_MANT_DIG != 53 || DBL_MAX_EXP != 1024
#error "buffon needs bytes of 8 bits and IEEE binary64 doubles"
#endif

#endif
