/* The level of vector instructions: what it is, how it is limited, and that threads which change it
 * disturb none that compute. That levels give the same bits: tests/test_levels.c. */
#include <limits.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include <buffon/buffon.h>

#include "levels.h"
#include "problems.h"
#include "tap.h"

enum { LEVELS = BUFFON_LEVEL_AVX512 + 1 };

#define COUNT(array) (sizeof(array) / sizeof *(array))

static buffon_level best;

/* What the compiler's own detection says, which shares nothing with the library's. */
static buffon_level machine_level(void)
{
#if LEVELS_HAVE_X86
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
        return BUFFON_LEVEL_AVX512;
    if (__builtin_cpu_supports("avx2"))
        return BUFFON_LEVEL_AVX2;
#endif
    return LEVELS_HAVE_128 ? BUFFON_LEVEL_128 : BUFFON_LEVEL_SCALAR;
}

static void test_limit(void)
{
    static const int odd[] = {-1, -7, INT_MIN, LEVELS, 100, INT_MAX};
    static const char *const name[] = {"scalar", "128", "avx2", "avx512", "unknown"};
    int named = 1;
    tap_ok(buffon_cpu_level() == machine_level(), "the level is the best of the machine: %s",
           buffon_level_string(buffon_cpu_level()));
    best = buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    tap_ok(best == machine_level() && buffon_cpu_level() == best, "and so without a limit");
    for (int most = 0; most < LEVELS; most++) {
        const buffon_level used = most < (int)best ? (buffon_level)most : best;
        tap_ok(buffon_cpu_limit((buffon_level)most) == used && buffon_cpu_level() == used,
               "limited to %s: %s", name[most], name[used]);
    }
    for (size_t k = 0; k < COUNT(odd); k++) {
        const buffon_level used = odd[k] < 0 ? BUFFON_LEVEL_SCALAR : best;
        tap_ok(buffon_cpu_limit((buffon_level)odd[k]) == used && buffon_cpu_level() == used,
               "limited to %d, which is no level: %s", odd[k], name[used]);
        named &= strcmp(buffon_level_string((buffon_level)odd[k]), "unknown") == 0;
    }
    for (int level = 0; level <= LEVELS; level++)
        named &= strcmp(buffon_level_string((buffon_level)level), name[level]) == 0;
    tap_ok(named, "levels have names, other numbers are unknown");
    (void)buffon_cpu_limit(BUFFON_LEVEL_AVX512);
}

enum { FLIPPERS = 2, RUNNERS = 2, ROUNDS = 4 };

static buffon_estimate flip_wanted[PROBLEMS][PROBLEMS_COMPONENTS];
static atomic_int flip_running;

/* Sets one level after the other and leaves it for a while. */
static void *flip(void *arg)
{
    size_t *flips = arg;
    uint64_t state = *flips;
    for (*flips = 0; atomic_load(&flip_running) > 0; ++*flips) {
        volatile uint64_t idle;
        state = state * UINT64_C(6364136223846793005) + 1442695040888963407;
        (void)buffon_cpu_limit((buffon_level)(state >> 62));
        for (idle = state >> 52; idle > 0; idle--)
            continue;
    }
    return NULL;
}

/* Counts estimates that are not as wanted. */
static void *run_problems(void *arg)
{
    size_t *bad = arg;
    *bad = 0;
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t k = 0; k < PROBLEMS; k++) {
            buffon_estimate out[PROBLEMS_COMPONENTS];
            (void)problems[k].solve(out, (buffon_run){.samples = 20000, .threads = 1 + k % 2});
            *bad += !same_estimates(out, flip_wanted[k], problems[k].components);
        }
    }
    atomic_fetch_sub(&flip_running, 1);
    return NULL;
}

static void test_flipping(void)
{
    pthread_t thread[FLIPPERS + RUNNERS];
    size_t result[FLIPPERS + RUNNERS] = {0}, bad = 0;
    int started = 0, flipped = 1;
    (void)buffon_cpu_limit(BUFFON_LEVEL_SCALAR);
    for (size_t k = 0; k < PROBLEMS; k++)
        (void)problems[k].solve(flip_wanted[k],
                                (buffon_run){.samples = 20000, .threads = 1 + k % 2});
    atomic_store(&flip_running, RUNNERS);
    for (int i = 0; i < FLIPPERS + RUNNERS; i++) {
        result[i] = (size_t)i;
        started +=
            pthread_create(&thread[i], NULL, i < FLIPPERS ? flip : run_problems, &result[i]) == 0;
    }
    tap_ok(started == FLIPPERS + RUNNERS, "threads that change the level and threads that compute");
    if (started < FLIPPERS + RUNNERS)
        exit(tap_done());
    for (int i = 0; i < FLIPPERS + RUNNERS; i++) {
        pthread_join(thread[i], NULL);
        flipped &= i >= FLIPPERS || result[i] > 0;
        bad += i >= FLIPPERS ? result[i] : 0;
    }
    tap_ok(flipped, "the level changed while others computed");
    if (!tap_ok(bad == 0, "which changed no estimate"))
        tap_note("%zu differ", bad);
    (void)buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    tap_ok(buffon_cpu_level() == best, "the level of the machine is in use again");
}

int main(void)
{
    test_limit();
    test_flipping();
    return tap_done();
}
