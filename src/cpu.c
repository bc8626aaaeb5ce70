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

/* The best level of the machine and the level in use, each plus one; 0 before anybody asked. */
static atomic_int cpu_best, cpu_used;

static int cpu_ask(void)
{
    int best = atomic_load_explicit(&cpu_best, memory_order_relaxed);
    if (best == 0) {
        best = (int)cpu_detect() + 1;
        atomic_store_explicit(&cpu_best, best, memory_order_relaxed);
    }
    return best;
}

buffon_level buffon_cpu_limit(buffon_level most)
{
    const int best = cpu_ask(), wanted = (int)most < 0 ? 0 : (int)most;
    const int used = wanted < best ? wanted + 1 : best;
    atomic_store_explicit(&cpu_used, used, memory_order_relaxed);
    return (buffon_level)(used - 1);
}

/* The first to ask must not undo a limit that another thread sets meanwhile. */
buffon_level buffon_cpu_level(void)
{
    int used = atomic_load_explicit(&cpu_used, memory_order_relaxed);
    if (used == 0) {
        const int best = cpu_ask();
        if (atomic_compare_exchange_strong(&cpu_used, &used, best))
            used = best;
    }
    return (buffon_level)(used - 1);
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
