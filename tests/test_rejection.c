/* The rejection sampler: its law, what it draws, and what it says when the bound does not hold. */
#include <buffon/buffon.h>

#include "law.h"

#define N 20000

static double square(const double *x, void *ctx)
{
    return *(const double *)ctx * x[0] * x[0];
}

static int square_batch(double *f, const double *x, size_t n, void *ctx)
{
    for (size_t i = 0; i < n; i++)
        f[i] = square(&x[i], ctx);
    return 0;
}

/* 1 - r^2 on the unit disk. */
static double dome(const double *x, void *ctx)
{
    (void)ctx;
    return 1 - (x[0] * x[0] + x[1] * x[1]);
}

static double x[2 * N], again[2 * N], v[N];

/* ---- laws ---- */

static void acceptance_ok(const buffon_rejection_report *r, double p, const char *name)
{
    const double n = (double)r->tries;
    law_ok(law_normal(((double)r->accepted / n - p) / sqrt(p * (1 - p) / n)),
           "%s: accepts %.4f of its tries, %.4f in the long run", name, r->acceptance, p);
}

static void test_line(void)
{
    const buffon_density g = buffon_segment(0, 1);
    double factor = 1;
    const buffon_integrand f = {.scalar = square, .dim = 1, .ctx = &factor};
    buffon_rng rng = buffon_rng_make(1, 0);
    buffon_rejection_report r;
    tap_ok(buffon_rejection_sample(x, N, &r, &f, &g, 1, &rng, 0) == BUFFON_OK && r.accepted == N,
           "x^2 on the line");
    for (size_t i = 0; i < N; i++)
        v[i] = x[i] * x[i] * x[i];
    law_ok(law_uniform(v, N), "its points have the CDF x^3");
    acceptance_ok(&r, 1.0 / 3, "x^2");
    tap_ok(r.acceptance == (double)r.accepted / (double)r.tries && r.worst < 1 && r.worst > 0.999,
           "the worst ratio met is %.6f", r.worst);
    tap_ok(buffon_rng_tell(&rng) == 2 * r.tries, "a try takes one word for x and one to decide");
}

static void test_disk(void)
{
    const buffon_density g = buffon_disk(1);
    const buffon_integrand f = {.scalar = dome, .dim = 2};
    const double envelope = LAW_PI; /* f <= 1 = pi g */
    buffon_rng rng = buffon_rng_make(2, 5);
    buffon_rejection_report r;
    int inside = 1;
    tap_ok(buffon_rejection_sample(x, N, &r, &f, &g, envelope, &rng, 0) == BUFFON_OK,
           "1 - r^2 on a disk");
    for (size_t i = 0; i < N; i++) {
        const double r2 = x[i] * x[i] + x[N + i] * x[N + i];
        inside &= r2 <= 1;
        v[i] = 2 * r2 - r2 * r2;
    }
    tap_ok(inside, "its points lie in the disk");
    law_ok(law_uniform(v, N), "their distance has its law");
    for (size_t i = 0; i < N; i++)
        v[i] = atan2(x[N + i], x[i]) / (2 * LAW_PI) + 0.5;
    law_ok(law_uniform(v, N), "their angle is uniform");
    acceptance_ok(&r, 0.5, "the disk");
    tap_ok(buffon_rng_tell(&rng) == 3 * r.tries, "a try takes three words");
}

/* ---- the same points ---- */

static void test_same(void)
{
    const buffon_density g = buffon_segment(0, 1);
    double factor = 1;
    const buffon_integrand f = {.scalar = square, .dim = 1, .ctx = &factor};
    const buffon_integrand b = {.batch = square_batch, .dim = 1, .ctx = &factor};
    buffon_rng rng = buffon_rng_make(1, 0), other = buffon_rng_make(1, 0);
    int good = buffon_rejection_sample(x, N, NULL, &f, &g, 1, &rng, 0) == BUFFON_OK;
    good &= buffon_rejection_sample(again, N, NULL, &b, &g, 1, &other, 0) == BUFFON_OK;
    tap_ok(good && memcmp(x, again, N * sizeof *x) == 0 && memcmp(&rng, &other, sizeof rng) == 0,
           "a batch gives the same points as a scalar");
    factor = 0x1p-900;
    other = buffon_rng_make(1, 0);
    good = buffon_rejection_sample(again, N, NULL, &f, &g, factor, &other, 0) == BUFFON_OK;
    tap_ok(good && memcmp(x, again, N * sizeof *x) == 0, "f and envelope may both be tiny");
    factor = 0x1p1000;
    other = buffon_rng_make(1, 0);
    good = buffon_rejection_sample(again, N, NULL, &f, &g, factor, &other, 0) == BUFFON_OK;
    tap_ok(good && memcmp(x, again, N * sizeof *x) == 0, "or huge");
}

/* ---- what goes wrong ---- */

/* 1/2, but `ctx` above 0.9. */
static double step(const double *at, void *ctx)
{
    return at[0] > 0.9 ? *(const double *)ctx : 0.5;
}

static int stop(double *f, const double *at, size_t n, void *ctx)
{
    (void)at;
    for (size_t i = 0; i < n; i++)
        f[i] = 0.5;
    return ++*(int *)ctx > 3;
}

/* Are there `accepted` points below 0.9 and NaN from `from` on? */
static int is_cut(const buffon_rejection_report *r, size_t n, size_t from)
{
    int good = r->accepted < n && r->tries >= r->accepted;
    for (size_t i = 0; i < r->accepted; i++)
        good &= x[i] > 0 && x[i] <= 0.9;
    for (size_t i = from; i < n; i++)
        good &= isnan(x[i]);
    return good;
}

static void test_bound(void)
{
    static const double values[] = {1.5, 1.0000000000000002, 1e308,    -0x1p-1074,
                                    NAN, INFINITY,           -INFINITY};
    const buffon_density g = buffon_segment(0, 1);
    buffon_rejection_report r;
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        double value = values[i];
        const buffon_integrand f = {.scalar = step, .dim = 1, .ctx = &value};
        buffon_rng rng = buffon_rng_make(3, i);
        const buffon_status status = buffon_rejection_sample(x, 1000, &r, &f, &g, 1, &rng, 0);
        const size_t at = (size_t)r.accepted;
        if (i == 1) /* within the rounding of f / (envelope g) */
            tap_ok(status == BUFFON_OK && r.worst == value, "a bound met but for rounding");
        else if (i < 4)
            tap_ok(status == BUFFON_E_BOUND && is_cut(&r, 1000, at + 1) && x[at] > 0.9 &&
                       r.worst == (value > 0 ? value : 0.5),
                   "f = %g: the bound fails, here", value);
        else
            tap_ok(status == BUFFON_E_NONFINITE && is_cut(&r, 1000, at), "f = %g", value);
    }
}

static int no_pdf(double *at, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++) {
        at[i] = u[i];
        pdf[i] = u[i] > 0.9 ? g->param[0] : 1;
    }
    return u[0] > 0.95 && g->param[1] > 0;
}

static int any_pdf(double *pdf, const double *at, size_t n, const buffon_density *g)
{
    (void)at;
    (void)g;
    for (size_t i = 0; i < n; i++)
        pdf[i] = 1;
    return 0;
}

static void test_density(void)
{
    static const buffon_density_ops ops = {.sample = no_pdf, .pdf = any_pdf};
    static const double values[] = {0, -1, NAN, INFINITY};
    double half = 0.5;
    const buffon_integrand f = {.scalar = step, .dim = 1, .ctx = &half};
    buffon_rejection_report r;
    for (size_t i = 0; i < 4; i++) {
        const buffon_density g = {.uniforms = 1, .dim = 1, .ops = &ops, .param = {values[i]}};
        buffon_rng rng = buffon_rng_make(3, 0);
        tap_ok(buffon_rejection_sample(x, 1000, &r, &f, &g, 1, &rng, 0) == BUFFON_E_PDF &&
                   is_cut(&r, 1000, (size_t)r.accepted),
               "g = %g", values[i]);
    }
    const buffon_density g = {.uniforms = 1, .dim = 1, .ops = &ops, .param = {1, 1}};
    buffon_rng rng = buffon_rng_make(3, 0);
    tap_ok(buffon_rejection_sample(x, N, &r, &f, &g, 1, &rng, 0) == BUFFON_E_PDF && r.accepted < N,
           "a density that fails");
    int calls = 0;
    const buffon_integrand stops = {.batch = stop, .dim = 1, .ctx = &calls};
    const buffon_density box = buffon_segment(0, 1);
    tap_ok(buffon_rejection_sample(x, N, &r, &stops, &box, 1, &rng, 0) == BUFFON_E_STOPPED &&
               r.accepted > 0 && isnan(x[r.accepted]) && isnan(x[N - 1]) && calls == 4,
           "an integrand that stops");
}

static double never(const double *at, void *ctx)
{
    (void)at;
    (void)ctx;
    return 0;
}

static void test_tries(void)
{
    const buffon_density g = buffon_segment(0, 1);
    double factor = 1;
    const buffon_integrand none = {.scalar = never, .dim = 1};
    const buffon_integrand f = {.scalar = square, .dim = 1, .ctx = &factor};
    buffon_rng rng = buffon_rng_make(3, 0), other = rng;
    buffon_rejection_report r, exact;
    tap_ok(buffon_rejection_sample(x, 10, &r, &none, &g, 1, &rng, 0) == BUFFON_E_TRIES &&
               r.tries == 11000 && r.accepted == 0 && r.acceptance == 0 && isnan(x[0]),
           "it gives up after 1000 n + 1000 tries");
    tap_ok(buffon_rejection_sample(x, 10, &r, &none, &g, 1, &rng, 777) == BUFFON_E_TRIES &&
               r.tries == 777,
           "or when it is told to");
    rng = other;
    int good = buffon_rejection_sample(x, 100, &r, &f, &g, 1, &rng, 0) == BUFFON_OK;
    rng = other;
    good &= buffon_rejection_sample(x, 100, &exact, &f, &g, 1, &rng, r.tries) == BUFFON_OK;
    rng = other;
    good &= buffon_rejection_sample(x, 100, &exact, &f, &g, 1, &rng, r.tries - 1) == BUFFON_E_TRIES;
    tap_ok(good && exact.accepted == 99 && exact.tries == r.tries - 1 && isnan(x[99]) && x[98] > 0,
           "just enough tries are enough, one fewer are not");
}

/* ---- what is refused ---- */

static int calls; /* of the integrands below */

static double counted(const double *at, void *ctx)
{
    (void)ctx;
    calls++;
    return at[0];
}

static int counted_batch(double *f, const double *at, size_t n, void *ctx)
{
    (void)at;
    (void)ctx;
    calls++;
    for (size_t i = 0; i < 3 * n; i++)
        f[i] = 1;
    return 0;
}

static double identity(double u, void *ctx)
{
    (void)ctx;
    return u;
}

static void refused(buffon_status expected, double *out, size_t n, const buffon_integrand *f,
                    const buffon_density *g, double envelope, const char *what)
{
    buffon_rng rng = buffon_rng_make(1, 2);
    buffon_rng_skip(&rng, 5);
    const buffon_rng was = rng;
    buffon_rejection_report report;
    memset(&report, 0x55, sizeof report);
    calls = 0;
    if (out != NULL)
        out[0] = 5;
    const buffon_status got = buffon_rejection_sample(out, n, &report, f, g, envelope, &rng, 0);
    tap_ok(got == expected && calls == 0 && memcmp(&rng, &was, sizeof rng) == 0 &&
               report.tries == 0 && report.accepted == 0 && isnan(report.acceptance) &&
               report.worst == 0 && (out == NULL || out[0] == 5 || isnan(out[0])),
           "%s: %s", buffon_status_name(expected), what);
}

static void test_refused(void)
{
    const buffon_density box = buffon_segment(0, 1), bad = buffon_segment(1, 0);
    const buffon_inversion how = {.quantile = identity};
    const buffon_density bare = buffon_inverse(&how);
    const buffon_integrand f = {.scalar = counted, .dim = 1}, plane = {.scalar = counted, .dim = 2};
    const buffon_integrand three = {.batch = counted_batch, .dim = 1, .components = 3};
    const buffon_integrand none = {.dim = 1};
    static const double envelopes[] = {0, -1, NAN, INFINITY};
    refused(BUFFON_E_NULL, NULL, 4, &f, &box, 1, "x is NULL");
    refused(BUFFON_E_NULL, x, 4, NULL, &box, 1, "f is NULL");
    refused(BUFFON_E_NULL, x, 4, &f, NULL, 1, "g is NULL");
    refused(BUFFON_E_DOMAIN, x, 4, &f, &bad, 1, "g is bad");
    refused(BUFFON_E_UNSUPPORTED, x, 4, &f, &bare, 1, "g has no pdf");
    refused(BUFFON_E_DIM, x, 4, &plane, &box, 1, "f has another dimension");
    refused(BUFFON_E_DIM, x, 4, &three, &box, 1, "f has components");
    refused(BUFFON_E_DIM, x, SIZE_MAX / 2, &f, &box, 1, "n is too large");
    refused(BUFFON_E_INTEGRAND, x, 4, &none, &box, 1, "f is no function");
    for (size_t i = 0; i < sizeof envelopes / sizeof *envelopes; i++)
        refused(BUFFON_E_HEIGHT, x, 4, &f, &box, envelopes[i], "envelope");
    tap_ok(buffon_rejection_sample(x, 4, NULL, &f, &box, 1, NULL, 0) == BUFFON_E_NULL,
           "BUFFON_E_NULL: no generator");
    buffon_rng rng = buffon_rng_make(1, 2);
    tap_ok(buffon_rejection_sample(NULL, 0, NULL, &f, &box, 1, &rng, 0) == BUFFON_OK &&
               buffon_rng_tell(&rng) == 0,
           "n = 0 draws nothing");
}

int main(void)
{
    test_line();
    test_disk();
    test_same();
    test_bound();
    test_density();
    test_tries();
    test_refused();
    return tap_done();
}
