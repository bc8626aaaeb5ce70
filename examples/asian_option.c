/* An Asian option by Monte Carlo and by quasi-Monte Carlo, side by side.
 *
 * The call pays what the mean price over n dates is above K. The price is a geometric Brownian
 * motion, so a path takes n normals: an integral in n dimensions. Sobol' points are best in their
 * first coordinates. Built date by date, a path needs all of its normals alike; by the Brownian
 * bridge the first one is its end, the second its middle given both ends, and so on: the first few
 * decide nearly everything, and the error falls by a further large factor. That changes nothing for
 * random points.
 *
 * For the geometric mean of the prices the value is known (A. Kemna, A. Vorst, 1990); for the
 * arithmetic mean over three dates it was computed to 22 digits. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

enum { MOST = 64, SAMPLES = 1 << 16 };

static const double S0 = 100, K = 100, RATE = 0.05, SIGMA = 0.3, YEARS = 1;

typedef struct option {
    size_t dates;
    int bridge;
} option;

/* w[1..n], the Brownian motion at the dates, date by date. */
static void walk(double *w, const double *z, size_t n)
{
    w[0] = 0;
    for (size_t i = 1; i <= n; i++)
        w[i] = w[i - 1] + sqrt(YEARS / (double)n) * z[i - 1];
}

/* The same law by the bridge: between dates a and b, where w is known, the date in the middle is
 * normal about the line, with variance (m - a)(b - m) / (b - a) steps. Widest gaps first. */
static void bridge(double *w, const double *z, size_t n)
{
    size_t from[2 * MOST] = {0}, to[2 * MOST] = {n}, gaps = 1;
    w[0] = 0;
    w[n] = sqrt(YEARS) * z[0];
    for (size_t gap = 0; gap < gaps; gap++) {
        const size_t a = from[gap], b = to[gap], m = (a + b) / 2;
        if (m == a)
            continue;
        const double left = (double)(m - a), right = (double)(b - m), all = (double)(b - a);
        const double sd = sqrt(left * right / all * YEARS / (double)n);
        w[m] = (right * w[a] + left * w[b]) / all + sd * z[(gaps + 1) / 2];
        from[gaps] = a, to[gaps++] = m;
        from[gaps] = m, to[gaps++] = b;
    }
}

/* Discounted payoffs for the geometric and the arithmetic mean. */
static int payoffs(double *f, const double *z, size_t n, void *ctx)
{
    const option *o = ctx;
    for (size_t i = 0; i < n; i++) {
        double normal[MOST], w[MOST + 1], sum = 0, logs = 0;
        for (size_t j = 0; j < o->dates; j++)
            normal[j] = z[j * n + i];
        (o->bridge ? bridge : walk)(w, normal, o->dates);
        for (size_t j = 1; j <= o->dates; j++) {
            const double t = YEARS * (double)j / (double)o->dates;
            const double log_price = (RATE - SIGMA * SIGMA / 2) * t + SIGMA * w[j];
            sum += S0 * exp(log_price);
            logs += log_price;
        }
        f[i] = exp(-RATE * YEARS) * fmax(0, S0 * exp(logs / (double)o->dates) - K);
        f[n + i] = exp(-RATE * YEARS) * fmax(0, sum / (double)o->dates - K);
    }
    return 0;
}

static int show(const char *name, const option *o, size_t mean, double exact,
                const buffon_points *points)
{
    buffon_density normal[MOST];
    buffon_estimate e[2];
    for (size_t j = 0; j < o->dates; j++)
        normal[j] = buffon_normal(0, 1);
    const buffon_density g = buffon_density_product(normal, o->dates);
    const buffon_integrand f = {
        .batch = payoffs, .dim = o->dates, .components = 2, .ctx = (void *)o};
    const buffon_status s = buffon_expectation(
        e, &f, &g, &(buffon_run){.samples = SAMPLES, .seed = 7, .points = points});
    if (s < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(s));
        return 1;
    }
    printf("  %-26s %.6f +- %.6f, 95 %% in [%.6f, %.6f], off by %9.6f\n", name, e[mean].value,
           e[mean].std_error, e[mean].lo, e[mean].hi, e[mean].value - exact);
    return 0;
}

static int compare(const char *title, size_t dates, size_t mean, double exact)
{
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const option by_date = {dates, 0}, by_bridge = {dates, 1};
    printf("%s, %zu dates, %d paths: exactly %.13f\n", title, dates, SAMPLES, exact);
    return show("Monte Carlo", &by_date, mean, exact, NULL) |
           show("Sobol', date by date", &by_date, mean, exact, &sobol) |
           show("Sobol', Brownian bridge", &by_bridge, mean, exact, &sobol);
}

int main(void)
{
    return compare("Geometric mean", 64, 0, 7.5947744978418912) |
           compare("Geometric mean", 12, 0, 8.0247032233068717) |
           compare("Arithmetic mean", 3, 1, 10.0525106843742639);
}
