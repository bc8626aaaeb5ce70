/* Timing side by side: the contestants of a group take turns, round after round, so that a change
 * of the machine's speed meets them all. Buffon takes a turn at each level that the machine has.
 * Times are the processor's, not the wall's; a ratio is the median over the rounds of the ratios of
 * times of one round. What is wanted is kept, to be printed with what was reached at the end. */
#ifndef TESTS_BENCH_H
#define TESTS_BENCH_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <buffon/buffon.h>

#define BENCH_ROUNDS 41
#define BENCH_MOST 16
#define BENCH_LEVELS 4
#define COUNT(array) (sizeof(array) / sizeof *(array))

/* Does `items` units of work and returns a number that depends on all of it. */
typedef double bench_work(size_t items);

/* Who is compared with buffon, and how many times as fast buffon is to be at each level, from plain
 * C to AVX-512; 0 asks for nothing. */
typedef struct bench_peer {
    const char *name;
    bench_work *work; /* NULL: is not installed */
    double wanted[BENCH_LEVELS];
} bench_peer;

/* One whose turn is timed: a piece of work, at a level. */
typedef struct bench_case {
    bench_work *work;
    buffon_level level;
} bench_case;

static volatile double bench_sink;
static double bench_times[BENCH_MOST][BENCH_ROUNDS];

static void bench_must(buffon_status status)
{
    if (status < 0) {
        fprintf(stderr, "bench: %s\n", buffon_status_string(status));
        exit(1);
    }
}

/* ---- time ---- */

static double bench_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double bench_seconds(const bench_case *one, size_t items)
{
    buffon_cpu_limit(one->level);
    const double before = bench_clock();
    bench_sink = one->work(items);
    return bench_clock() - before;
}

/* How many items take about three milliseconds: a power of two, at least 1024. */
static size_t bench_calibrate(const bench_case *one)
{
    size_t items = 1024;
    for (;;) {
        const double seconds = bench_seconds(one, items);
        if (seconds > 2e-3 || items > (size_t)1 << 30)
            return items;
        items *= seconds < 2e-4 ? 8 : 2;
    }
}

/* Leaves ns per item in bench_times. Every other round goes backwards, so that nobody always comes
 * after the same one. */
static void bench_time(const bench_case *cases, size_t n)
{
    size_t items[BENCH_MOST];
    for (size_t c = 0; c < n; c++)
        items[c] = bench_calibrate(&cases[c]);
    for (size_t round = 0; round < BENCH_ROUNDS; round++) {
        for (size_t k = 0; k < n; k++) {
            const size_t c = round % 2 == 0 ? k : n - 1 - k;
            bench_times[c][round] = 1e9 * bench_seconds(&cases[c], items[c]) / (double)items[c];
        }
    }
    buffon_cpu_limit(BUFFON_LEVEL_AVX512);
}

static int bench_order(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value of this rank of the sorted x, 0 for the least. */
static double bench_ranked(const double *x, size_t rank)
{
    double sorted[BENCH_ROUNDS];
    memcpy(sorted, x, sizeof sorted);
    qsort(sorted, BENCH_ROUNDS, sizeof *sorted, bench_order);
    return sorted[rank];
}

static double bench_median(const double *x)
{
    return bench_ranked(x, BENCH_ROUNDS / 2);
}

/* How many times as long as case b case a took. */
static double bench_ratio(size_t a, size_t b)
{
    double ratio[BENCH_ROUNDS];
    for (size_t round = 0; round < BENCH_ROUNDS; round++)
        ratio[round] = bench_times[a][round] / bench_times[b][round];
    return bench_median(ratio);
}

/* ---- what is wanted ---- */

typedef struct bench_target {
    char what[80];
    const char *where, *unit;
    double wanted, reached;
    int most; /* no more than `wanted`; otherwise no less */
} bench_target;

static bench_target bench_targets[100];
static size_t bench_wanted;

static void bench_want(const bench_target *target)
{
    if (bench_wanted == COUNT(bench_targets)) {
        fprintf(stderr, "bench: more targets than there is room for\n");
        exit(1);
    }
    bench_targets[bench_wanted++] = *target;
}

static inline void bench_print_targets(void)
{
    size_t met = 0;
    printf("\n%-62s %-7s %9s %11s\n", "what is wanted", "level", "wanted", "reached");
    for (size_t k = 0; k < bench_wanted; k++) {
        const bench_target *t = &bench_targets[k];
        const int good = t->most ? t->reached <= t->wanted : t->reached >= t->wanted;
        met += (size_t)good;
        printf("%-62s %-7s %s %6.4g %6.4g %-3s  %s\n", t->what, t->where,
               t->most ? "<=" : ">=", t->wanted, t->reached, t->unit, good ? "met" : "MISSED");
    }
    printf("%zu of %zu met\n", met, bench_wanted);
}

/* ---- tables ---- */

static size_t bench_levels(void)
{
    return (size_t)buffon_cpu_limit(BUFFON_LEVEL_AVX512) + 1;
}

static inline void bench_header(const char *unit)
{
    printf("\n%-40s %8s %8s  ", unit, "min", "median");
    for (size_t level = 0; level < bench_levels(); level++)
        printf(" %8s", buffon_level_string((buffon_level)level));
    printf("\n");
}

/* A line of a group: the time of a case, and how many times that of buffon it is at each level. */
static void bench_line(const char *name, size_t c)
{
    const double *time = bench_times[c];
    printf("  %-38s %8.3f %8.3f  ", name, bench_ranked(time, 0), bench_median(time));
    for (size_t level = 0; level < bench_levels(); level++)
        printf(" %8.2f", bench_ratio(c, level));
    printf("\n");
}

static void bench_want_ratios(const char *title, const bench_peer *peer, size_t c)
{
    for (size_t level = 0; level < bench_levels(); level++) {
        bench_target target = {.where = buffon_level_string((buffon_level)level),
                               .unit = "x",
                               .wanted = peer->wanted[level],
                               .reached = bench_ratio(c, level)};
        snprintf(target.what, sizeof target.what, "%s, against %s", title, peer->name);
        if (target.wanted > 0)
            bench_want(&target);
    }
}

/* Times buffon at every level, and the peers that are installed; prints a line for each. */
static inline void bench_group(const char *title, bench_work *ours, const bench_peer *peers,
                               size_t n)
{
    const size_t levels = bench_levels();
    const bench_peer *in[BENCH_MOST] = {NULL};
    bench_case cases[BENCH_MOST];
    size_t count = 0;
    for (; count < levels; count++)
        cases[count] = (bench_case){ours, (buffon_level)count};
    for (size_t p = 0; p < n; p++) {
        if (peers[p].work != NULL) {
            in[count] = &peers[p];
            cases[count++] = (bench_case){peers[p].work, BUFFON_LEVEL_AVX512};
        }
    }
    bench_time(cases, count);
    printf("%s\n", title);
    for (size_t c = 0; c < count; c++) {
        char name[32];
        snprintf(name, sizeof name, "buffon, %s", buffon_level_string((buffon_level)c));
        bench_line(c < levels ? name : in[c]->name, c);
        if (c >= levels)
            bench_want_ratios(title, in[c], c);
    }
    fflush(stdout);
}

#endif
