/* Layer 0. The vector instructions that the library uses.
 *
 * Random numbers, points, shapes, elementary functions and sums are computed several at a time, by
 * the widest instructions that the library has kernels for and the machine and its operating system
 * support. All levels give the same bits, so nobody has to care; these calls are for reports, for
 * timing, and for programs that keep a processor from wide instructions.
 */
#ifndef BUFFON_CPU_H
#define BUFFON_CPU_H

#include "api.h"

BUFFON_BEGIN

/** Sets of instructions, each with all before it. */
typedef enum buffon_level {
    BUFFON_LEVEL_SCALAR, /* plain C, on every machine */
    BUFFON_LEVEL_128,    /* SSE2 on x86, NEON on 64-bit ARM: 2 doubles at a time */
    BUFFON_LEVEL_AVX2,   /* 4 doubles at a time */
    BUFFON_LEVEL_AVX512  /* 8 doubles at a time: AVX-512 F, DQ, VL and BW */
} buffon_level;

/** The level in use: the best of this machine, unless it is limited.
 *
 *  May be called from any thread.
 *
 *  Returns: the level
 *  Since:   0.1
 */
BUFFON_API buffon_level buffon_cpu_level(void);

/** Uses no instructions beyond `most` from now on, in the whole program.
 *
 *  May be called from any thread, while others compute too: no bit of a result depends on it.
 *
 *      buffon_cpu_limit(BUFFON_LEVEL_AVX2);     no AVX-512
 *      buffon_cpu_limit(BUFFON_LEVEL_AVX512);   whatever the machine has
 *
 *  most:    the highest level wanted
 *  Returns: the level now in use: the lower of `most` and the best of this machine
 *  Since:   0.1
 */
BUFFON_API buffon_level buffon_cpu_limit(buffon_level most);

/** The name of a level: "scalar", "128", "avx2", "avx512", or "unknown" for other numbers.
 *
 *  Returns: a string that lives as long as the program
 *  Since:   0.1
 */
BUFFON_API const char *buffon_level_string(buffon_level level);

BUFFON_END

#endif
