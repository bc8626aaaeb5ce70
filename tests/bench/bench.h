/* Timing side by side: the contestants of a group take turns, round after round, so that a change
 * of the machine's speed meets them all. Times are the processor's, not the wall's; a ratio is the
 * median of the ratios of the rounds. */
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
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
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

static double bench_median(double *x)
{
    qsort(x, BENCH_ROUNDS, sizeof *x, bench_order);
    return x[BENCH_ROUNDS / 2];
}

/* Times the cases and prints a line for each. The ratio is the time of a case over that of the
 * first: how many times as fast the first is. */
static void bench_group(const char *title, const bench_case *cases, size_t n)
{
    static double time[BENCH_MOST][BENCH_ROUNDS], ratio[BENCH_MOST][BENCH_ROUNDS];
    size_t items[BENCH_MOST];
    for (size_t c = 0; c < n; c++)
        items[c] = bench_calibrate(cases[c].work);
    for (size_t round = 0; round < BENCH_ROUNDS; round++) {
        for (size_t c = 0; c < n; c++) {
            const double before = bench_clock();
            bench_sink = cases[c].work(items[c]);
            time[c][round] = 1e9 * (bench_clock() - before) / (double)items[c];
            ratio[c][round] = time[c][round] / time[0][round];
        }
    }
    for (size_t c = 0; c < n; c++) {
        const double median = bench_median(time[c]);
        printf("%-34s %-30s %8.2f %8.2f %8.2f  %7.2f\n", c == 0 ? title : "", cases[c].name,
               time[c][0], median, time[c][BENCH_ROUNDS - 1], bench_median(ratio[c]));
    }
    fflush(stdout);
}

static void bench_header(const char *unit)
{
    printf("\n%-34s %-30s %8s %8s %8s  %7s\n", "", unit, "min", "median", "max", "ratio");
}

#endif
