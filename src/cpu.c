/* What this machine can do is asked once, of the processor and of the operating system: registers
 * that the system does not save must not be touched. Threads that ask at the same time find the
 * same. */
#include "guard.h"

#include <stdatomic.h>

#include <buffon/cpu.h>

#include "levels.h"

#if LEVELS_HAVE_X86
#include <cpuid.h>

/* XCR0: which registers the system saves. Only where OSXSAVE is set. */
static uint32_t cpu_saved(void)
{
    uint32_t low, high;
    __asm__ volatile(".byte 0x0f, 0x01, 0xd0" : "=a"(low), "=d"(high) : "c"(0)); /* xgetbv */
    return low;
}

static buffon_level cpu_detect(void)
{
    const uint32_t osxsave = 1u << 27, ymm = 0x06, zmm = 0xe6;
    const uint32_t avx2 = 1u << 5;
    const uint32_t avx512 = 1u << 16 | 1u << 17 | 1u << 30 | 1u << 31; /* F DQ BW VL */
    uint32_t a, b, c, d, saved;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & osxsave))
        return BUFFON_LEVEL_128;
    saved = cpu_saved();
    if (!__get_cpuid_count(7, 0, &a, &b, &c, &d) || !(b & avx2) || (saved & ymm) != ymm)
        return BUFFON_LEVEL_128;
    return (b & avx512) == avx512 && (saved & zmm) == zmm ? BUFFON_LEVEL_AVX512 : BUFFON_LEVEL_AVX2;
}

#else

static buffon_level cpu_detect(void)
{
    return LEVELS_HAVE_128 ? BUFFON_LEVEL_128 : BUFFON_LEVEL_SCALAR;
}

#endif

/* The level in use plus one; 0 before anybody asked. */
static atomic_int cpu_state;

buffon_level buffon_cpu_limit(buffon_level most)
{
    const buffon_level best = cpu_detect(), level = (int)most < 0 ? BUFFON_LEVEL_SCALAR : most;
    const buffon_level used = level < best ? level : best;
    atomic_store_explicit(&cpu_state, (int)used + 1, memory_order_relaxed);
    return used;
}

/* The first to ask must not undo a limit that another thread sets meanwhile. */
buffon_level buffon_cpu_level(void)
{
    int state = atomic_load_explicit(&cpu_state, memory_order_relaxed);
    if (state == 0) {
        const int best = (int)cpu_detect() + 1;
        if (atomic_compare_exchange_strong(&cpu_state, &state, best))
            state = best;
    }
    return (buffon_level)(state - 1);
}

const char *buffon_level_string(buffon_level level)
{
    switch (level) {
    case BUFFON_LEVEL_SCALAR:
        return "scalar";
    case BUFFON_LEVEL_128:
        return "128";
    case BUFFON_LEVEL_AVX2:
        return "avx2";
    case BUFFON_LEVEL_AVX512:
        return "avx512";
    }
    return "unknown";
}
