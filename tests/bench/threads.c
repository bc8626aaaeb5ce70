/* What a second thread costs and gains. Runs with one thread and with two take turns. Of their
 * processor times the ratio is 1 where nothing is lost to sharing the work; of their times by the
 * wall clock it is 0.5 where two processors are free, and the system soon gives the second thread
 * one of its own. Medians of 31 pairs. Two threads are wanted to take 10 % more processor time than
 * one at most. The estimates must be the same to the last bit: if they are not, the program says so
 * and fails.
 */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <buffon/buffon.h>

#define PAIRS 31
#define CPU_WANTED 1.1
#define SHORT_SECONDS 3e-3 /* short runs are timed by as many as take this long */

static const double zeros[8] = {0}, ones[8] = {1, 1, 1, 1, 1, 1, 1, 1};

/* ---- integrands ---- */

static int squares(double *f, const double *x, size_t n, void *ctx)
{
    const size_t dim = *(const size_t *)ctx;
    memset(f, 0, n * sizeof *f);
    for (size_t j = 0; j < dim; j++) {
        for (size_t i = 0; i < n; i++)
            f[i] += x[j * n + i] * x[j * n + i];
    }
    return 0;
}

/* Some hundred nanoseconds: square roots that wait for one another. */
static double roots(const double *x, void *ctx)
{
    double y = x[0];
    (void)ctx;
    for (int i = 0; i < 16; i++)
        y = sqrt(y + 1);
    return y;
}

/* ---- runs ---- */

typedef struct workload {
    const char *name;
    size_t dim;
    int slow;
    uint64_t samples;
    double abs_tol;
} workload;

static buffon_estimate run(const workload *w, uint32_t threads)
{
    size_t dim = w->dim;
    const buffon_integrand cheap = {.batch = squares, .dim = dim, .ctx = &dim};
    const buffon_integrand slow = {.scalar = roots, .dim = dim};
    const buffon_run options = {
        .samples = w->samples, .seed = 1, .threads = threads, .abs_tol = w->abs_tol};
    buffon_estimate e;
    if (buffon_uniform(&e, w->slow ? &slow : &cheap, zeros, ones, &options) < 0) {
        fprintf(stderr, "threads: %s: %s\n", w->name, buffon_status_string(e.status));
        exit(1);
    }
    return e;
}

static int same(const buffon_estimate *a, const buffon_estimate *b)
{
    return memcmp(&a->value, &b->value, sizeof a->value) == 0 &&
           memcmp(&a->std_error, &b->std_error, sizeof a->std_error) == 0 &&
           memcmp(&a->lo, &b->lo, sizeof a->lo) == 0 && a->samples == b->samples &&
           a->status == b->status && a->doubts == b->doubts;
}

/* ---- times ---- */

/* Seconds of the processors and of the wall. */
typedef struct spent {
    double cpu, wall;
} spent;

static double seconds(clockid_t id)
{
    struct timespec now;
    clock_gettime(id, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static spent time_runs(const workload *w, uint32_t threads, size_t runs)
{
    const spent before = {seconds(CLOCK_PROCESS_CPUTIME_ID), seconds(CLOCK_MONOTONIC)};
    for (size_t i = 0; i < runs; i++)
        (void)run(w, threads);
    return (spent){(seconds(CLOCK_PROCESS_CPUTIME_ID) - before.cpu) / (double)runs,
                   (seconds(CLOCK_MONOTONIC) - before.wall) / (double)runs};
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *x)
{
    qsort(x, PAIRS, sizeof *x, ascending);
    return x[PAIRS / 2];
}

/* One thread and two in turns, each first in every other pair: medians of their times and of the
 * ratios. */
typedef struct comparison {
    double one, two; /* by the wall, seconds a run */
    double cpu, wall;
} comparison;

static comparison compare(const workload *w, size_t runs)
{
    double one[PAIRS], two[PAIRS], cpu[PAIRS], wall[PAIRS];
    for (int i = 0; i < PAIRS; i++) {
        spent t[2];
        for (int turn = 0; turn < 2; turn++) {
            const int second = (turn + i) % 2;
            t[second] = time_runs(w, second ? 2 : 1, runs);
        }
        one[i] = t[0].wall;
        two[i] = t[1].wall;
        cpu[i] = t[1].cpu / t[0].cpu;
        wall[i] = t[1].wall / t[0].wall;
    }
    return (comparison){median(one), median(two), median(cpu), median(wall)};
}

/* ---- the tables ---- */

static const char *verdict(const comparison *c, int good)
{
    return !good ? "THE BITS DIFFER" : c->cpu <= CPU_WANTED ? "met" : "MISSED";
}

static int bench_long(const workload *w)
{
    const buffon_estimate alone = run(w, 1), both = run(w, 2);
    const int good = same(&alone, &both);
    const comparison c = compare(w, 1);
    printf("%-44s %8.2f %8.2f  %7.2f %7.2f  %s\n", w->name, 1e3 * c.one, 1e3 * c.two, c.cpu, c.wall,
           verdict(&c, good));
    fflush(stdout);
    return good;
}

static int bench_short(uint64_t samples)
{
    const workload w = {.name = "a short run", .dim = 1, .samples = samples};
    const buffon_estimate alone = run(&w, 1), both = run(&w, 2);
    const int good = same(&alone, &both);
    const double once = time_runs(&w, 1, 100).cpu;
    const comparison c = compare(&w, (size_t)(SHORT_SECONDS / once) + 1);
    printf("%8llu samples, d = 1%24s %8.2f %8.2f  %7.2f %7.2f  %s\n", (unsigned long long)samples,
           "", 1e6 * c.one, 1e6 * c.two, c.cpu, c.wall, verdict(&c, good));
    fflush(stdout);
    return good;
}

int main(void)
{
    static const workload workloads[] = {
        {"sum of squares, d = 1", 1, 0, 1 << 22, 0},
        {"sum of squares, d = 8", 8, 0, 1 << 22, 0},
        {"an integrand of some 100 ns", 1, 1, 1 << 19, 0},
        {"10 looks, the tolerance never met, d = 1", 1, 0, 1 << 22, 1e-300},
    };
    static const uint64_t brief[] = {16, 1024, 16384};
    int good = 1;
    printf("\n%-44s %8s %8s  %7s %7s  cpu <= %.2f\n", "ms a run, and two threads to one", "one",
           "two", "cpu", "wall", CPU_WANTED);
    for (size_t i = 0; i < sizeof workloads / sizeof *workloads; i++)
        good &= bench_long(&workloads[i]);
    printf("\n%-44s %8s %8s  %7s %7s\n", "us a run, and two threads to one", "one", "two", "cpu",
           "wall");
    for (size_t i = 0; i < sizeof brief / sizeof *brief; i++)
        good &= bench_short(brief[i]);
    return good ? 0 : 1;
}
