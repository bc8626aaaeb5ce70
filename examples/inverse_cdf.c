/* X = F^-1(u) has the CDF F, since P(X <= x) = P(u <= F(x)) = F(x).
 *
 * F may come in three forms: as its inverse, the quantile function; as F itself with its derivative
 * g, which Newton's method inverts; or as a table. Here g = sin(x) / 2 on (0, pi), so that
 *
 *     F = (1 - cos x) / 2,   F^-1(u) = arccos(1 - 2 u),
 *
 * and f = x sin(x), whose integral is pi. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

enum { TABLE = 65 };
static const double pi = 3.14159265358979323846;

static double f(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * sin(x[0]);
}

static double pdf(double x, void *ctx)
{
    (void)ctx;
    return sin(x) / 2;
}

static double cdf(double x, void *ctx)
{
    (void)ctx;
    return sin(x / 2) * sin(x / 2); /* (1 - cos x) / 2 without cancellation near 0 */
}

static double quantile(double u, void *ctx)
{
    (void)ctx;
    return 2 * asin(sqrt(u)); /* arccos(1 - 2 u), likewise */
}

static int show(const char *name, const buffon_inversion *how)
{
    buffon_estimate e;
    const buffon_status s = buffon_inverse_cdf(&e, &(buffon_integrand){.scalar = f, .dim = 1}, how,
                                               &(buffon_run){.samples = 200000, .seed = 8});
    if (s < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(s));
        return 1;
    }
    printf("%-12s  %.6f +- %.6f, 95 %% in [%.6f, %.6f]\n", name, e.value, e.std_error, e.lo, e.hi);
    return 0;
}

int main(void)
{
    /* Between two points of the table the density is constant: not quite g, and still exact, since
     * f is divided by the density that was sampled. */
    double x[TABLE], F[TABLE];
    for (size_t i = 0; i < TABLE; i++) {
        x[i] = pi * (double)i / (TABLE - 1);
        F[i] = cdf(x[i], NULL);
    }
    int bad = 0;
    bad |= show("quantile", &(buffon_inversion){.quantile = quantile, .pdf = pdf});
    bad |= show("CDF and pdf", &(buffon_inversion){.cdf = cdf, .pdf = pdf, .lo = 0, .hi = pi});
    bad |= show("table", &(buffon_inversion){.x = x, .F = F, .count = TABLE});
    printf("exactly       %.6f\n", pi);
    return bad;
}
