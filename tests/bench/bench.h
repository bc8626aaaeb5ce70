/* Timing side by side: the contestants of a group take turns, round after round, so that a change of
 * the machine's speed meets them all; the median of the rounds is quoted, and ratios within a group. */
#ifndef TESTS_BENCH_H
#define TESTS_BENCH_H

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define BENCH_ROUNDS 21
#define BENCH_MOST 8

/* Does `items` units of work and returns a number that depends on all of it. */
typedef double bench_work(size_t items);

typedef struct bench_case {
    const char *name;
    bench_work *work;
} bench_case;

static volatile double bench_sink;

static double bench_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int bench_order(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* How many items take about three milliseconds. */
static size_t bench_calibrate(bench_work *work)
{
    size_t items = 1024;
    for (;;) {
        const double before = bench_clock();
        bench_sink = work(items);
        const double seconds = bench_clock() - before;
        if (seconds > 3e-3 || items > (size_t)1 << 30)
            return items;
        items *= seconds < 3e-4 ? 8 : 2;
    }
}

/* Times the cases and prints a line for each: the first is the one that the others are held against. */
static void bench_group(const char *title, const bench_case *cases, size_t n)
{
    static double time[BENCH_MOST][BENCH_ROUNDS];
    size_t items[BENCH_MOST];
    double first = 0;
    for (size_t c = 0; c < n; c++)
        items[c] = bench_calibrate(cases[c].work);
    for (size_t round = 0; round < BENCH_ROUNDS; round++) {
        for (size_t c = 0; c < n; c++) {
            const double before = bench_clock();
            bench_sink = cases[c].work(items[c]);
            time[c][round] = 1e9 * (bench_clock() - before) / (double)items[c];
        }
    }
    for (size_t c = 0; c < n; c++) {
        qsort(time[c], BENCH_ROUNDS, sizeof time[c][0], bench_order);
        const double median = time[c][BENCH_ROUNDS / 2];
        first = c == 0 ? median : first;
        printf("%-34s %-30s %8.2f %8.2f %8.2f  %7.2f\n", c == 0 ? title : "", cases[c].name,
               time[c][0], median, time[c][BENCH_ROUNDS - 1], median / first);
    }
    fflush(stdout);
}

static void bench_header(const char *unit)
{
    printf("\n%-34s %-30s %8s %8s %8s  %7s\n", "", unit, "min", "median", "max", "ratio");
}

#endif
