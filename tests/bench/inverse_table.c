/* Tables of quantile functions beside those of UNU.RAN's PINV, where it is installed: the time to
 * make one, to draw by it, and how far F(Q(u)) is from u, over the laws of laws40.h. Both are asked
 * for a u-error of 1e-12. Buffon's tables reach down to p = 1e-300, UNU.RAN's are cut at 5e-14;
 * `short` is the time for one of buffon's that reaches down to 1e-15. Times are the least of some
 * repeats that take turns; draws are the second of two passes, from the same uniforms in memory,
 * and with each library's own generator. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <buffon/buffon.h>

#include "../laws40.h"

#ifdef BENCH_UNURAN
#include <unuran.h>
#endif

enum { N = 1 << 14, ROUNDS = 7 };

static double u[N], x[N];
static volatile double sink;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* What one law came to: times in seconds, 0 where there is none. */
typedef struct result {
    double make, brief, draw, generate, error;
    unsigned long calls;
    int is_there;
} result;

static void least(double *best, double value)
{
    if (*best == 0 || value < *best)
        *best = value;
}

static double off(const law40 *l, double p, double at)
{
    return (double)fabsl(p < 0.5 ? l->lower(at, l->p) - p
                                 : (1 - (long double)p) - l->upper(at, l->p));
}

static buffon_inverse_law law_of(const law40 *l, double tail)
{
    return (buffon_inverse_law){.pdf = l->pdf,
                                .ctx = (void *)(uintptr_t)l->p,
                                .lo = l->lo,
                                .hi = l->hi,
                                .centre = l->centre,
                                .breaks = l->at,
                                .breaks_count = l->breaks,
                                .poles = l->at + l->breaks,
                                .poles_count = l->poles,
                                .tail = tail};
}

static void must(buffon_status status)
{
    if (status < 0) {
        fprintf(stderr, "bench: %s\n", buffon_status_string(status));
        exit(1);
    }
}

static void ours(result *r, const law40 *l)
{
    const buffon_inverse_law law = law_of(l, 0), brief = law_of(l, 1e-15);
    const buffon_rng_key key = {.seed = 1};
    buffon_inverse_table *table;
    buffon_inverse_report report;
    double start = now();
    must(buffon_inverse_table_new(&table, &report, &brief));
    least(&r->brief, now() - start);
    buffon_inverse_table_free(table);
    start = now();
    must(buffon_inverse_table_new(&table, &report, &law));
    least(&r->make, now() - start);
    const buffon_density g = buffon_inverse_table_density(table);
    must(buffon_density_sample(x, NULL, u, N, &g));
    start = now();
    must(buffon_density_sample(x, NULL, u, N, &g));
    least(&r->draw, (now() - start) / N);
    if (r->error == 0)
        for (size_t i = 0; i < N; i += 7)
            r->error = fmax(r->error, off(l, u[i], x[i]));
    start = now();
    for (size_t i = 0; i < N; i += 1024) {
        double some[1024];
        buffon_rng_uniforms_at(some, 1024, &key, 0, i);
        must(buffon_density_sample(x + i, NULL, some, 1024, &g));
    }
    sink = x[7];
    least(&r->generate, (now() - start) / N);
    r->calls = (unsigned long)report.calls;
    r->is_there = 1;
    buffon_inverse_table_free(table);
}

#ifdef BENCH_UNURAN
static const law40 *theirs_law;
static unsigned long theirs_calls;

static double theirs_pdf(double at, const UNUR_DISTR *distr)
{
    (void)distr;
    theirs_calls++;
    return theirs_law->pdf(at, (void *)(uintptr_t)theirs_law->p);
}

static UNUR_GEN *theirs_make(const law40 *l)
{
    const int line = l->lo == 0 && l->hi == 0;
    UNUR_DISTR *distr = unur_distr_cont_new();
    theirs_law = l;
    theirs_calls = 0;
    unur_distr_cont_set_pdf(distr, theirs_pdf);
    unur_distr_cont_set_domain(distr, line ? -INFINITY : l->lo, line ? INFINITY : l->hi);
    const double inside = isfinite(l->hi) && !line ? 0.5 * (l->lo + l->hi) : l->lo + 1;
    unur_distr_cont_set_center(distr, line ? l->centre : inside);
    UNUR_PAR *par = unur_pinv_new(distr);
    unur_pinv_set_u_resolution(par, 1e-12);
    UNUR_GEN *gen = unur_init(par);
    unur_distr_free(distr);
    return gen;
}

static void theirs(result *r, const law40 *l)
{
    double start = now();
    UNUR_GEN *gen = theirs_make(l);
    if (gen == NULL)
        return;
    least(&r->make, now() - start);
    r->calls = theirs_calls;
    for (size_t i = 0; i < N; i++)
        x[i] = unur_quantile(gen, u[i]);
    start = now();
    for (size_t i = 0; i < N; i++)
        x[i] = unur_quantile(gen, u[i]);
    least(&r->draw, (now() - start) / N);
    if (r->error == 0)
        for (size_t i = 0; i < N; i += 7)
            r->error = fmax(r->error, off(l, u[i], x[i]));
    start = now();
    for (size_t i = 0; i < N; i++)
        x[i] = unur_sample_cont(gen);
    sink = x[7];
    least(&r->generate, (now() - start) / N);
    r->is_there = 1;
    unur_free(gen);
}
#endif

static int order(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static void want(const char *what, double *ratio, size_t n, int most, double wanted)
{
    if (n == 0)
        return;
    qsort(ratio, n, sizeof *ratio, order);
    const double median = ratio[n / 2], worst = most ? ratio[n - 1] : ratio[0];
    printf("%-50s %s %4.3g, median %6.3g %-6s  worst %6.3g %s\n", what, most ? "<=" : ">=", wanted,
           median, (most ? median <= wanted : median >= wanted) ? "met" : "MISSED", worst,
           (most ? worst <= wanted : worst >= wanted) ? "met" : "MISSED");
}

int main(void)
{
    double made[LAWS_COUNT], brief[LAWS_COUNT], drawn[LAWS_COUNT], generated[LAWS_COUNT];
    double error[LAWS_COUNT];
    size_t n = 0;
    const buffon_rng_key key = {.seed = 2};
    buffon_rng_uniforms_at(u, N, &key, 0, 0);
#ifdef BENCH_UNURAN
    unur_set_stream(fopen("/dev/null", "w"));
#else
    printf("UNU.RAN is not installed (unuran.h): no columns for it\n");
#endif
    printf("%-24s %7s %7s %7s %7s %7s  %7s %7s %7s %7s %7s\n", "", "make us", "short", "draw ns",
           "+ rng", "u-error", "PINV us", "calls", "draw ns", "+ rng", "u-error");
    for (size_t k = 0; k < LAWS_COUNT; k++) {
        const law40 *l = &laws40[k];
        result a = {0}, b = {0};
        for (int round = 0; round < ROUNDS; round++) {
            ours(&a, l);
#ifdef BENCH_UNURAN
            if (l->peers)
                theirs(&b, l);
#endif
        }
        printf("%-24s %7.0f %7.0f %7.2f %7.2f %7.1e", l->name, 1e6 * a.make, 1e6 * a.brief,
               1e9 * a.draw, 1e9 * a.generate, a.error);
        error[k] = a.error;
        if (b.is_there) {
            printf("  %7.0f %7lu %7.2f %7.2f %7.1e", 1e6 * b.make, b.calls, 1e9 * b.draw,
                   1e9 * b.generate, b.error);
            made[n] = a.make / b.make;
            brief[n] = a.brief / b.make;
            drawn[n] = b.draw / a.draw;
            generated[n++] = b.generate / a.generate;
        }
        printf("\n");
        fflush(stdout);
    }
    printf("\n");
    for (size_t k = 0; k < LAWS_COUNT; k++)
        error[k] *= 1e12;
    want("u-error / 1e-12", error, LAWS_COUNT, 1, 1);
    want("time to make, of UNU.RAN's", made, n, 1, 2);
    want("the same, tails to 1e-15 only", brief, n, 1, 2);
    want("times as fast from the same uniforms", drawn, n, 0, 8);
    want("times as fast, generators included", generated, n, 0, 8);
    return 0;
}
