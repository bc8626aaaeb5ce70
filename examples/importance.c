/* Importance sampling: int f = E[f(X) / g(X)] for X of any density g that is positive where f is
 * not zero. Its variance is int f^2 / g - (int f)^2: small where g has the shape of f, zero for
 * g = f / int f, and infinite where g vanishes much faster than f.
 *
 * Here f = x^3 on (0, 1), int f = 1/4. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static double f(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0] * x[0];
}

static double quantile_rising(double u, void *ctx) /* F = x^2 */
{
    (void)ctx;
    return sqrt(u);
}

static double pdf_rising(double x, void *ctx)
{
    (void)ctx;
    return 2 * x;
}

static double quantile_like_f(double u, void *ctx) /* F = x^4 */
{
    (void)ctx;
    return sqrt(sqrt(u));
}

static double pdf_like_f(double x, void *ctx)
{
    return 4 * f(&x, ctx);
}

static double quantile_falling(double u, void *ctx) /* F = 1 - (1 - x)^5 */
{
    (void)ctx;
    return 1 - pow(1 - u, 1. / 5);
}

static double pdf_falling(double x, void *ctx)
{
    (void)ctx;
    return 5 * pow(1 - x, 4);
}

static int show(const char *name, const buffon_density *g, int constant, double variance)
{
    buffon_estimate e;
    const buffon_status s =
        buffon_importance(&e, &(buffon_integrand){.scalar = f, .dim = 1}, g,
                          &(buffon_run){.samples = 100000, .seed = 3, .constant = constant});
    if (s < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(s));
        return 1;
    }
    printf("%-12s  %.6f  %.6f  [%9.6f, %9.6f]  %.5f  %7.5f  %s\n", name, e.value, e.std_error, e.lo,
           e.hi, e.variance, variance, buffon_status_string(s));
    return 0;
}

int main(void)
{
    const buffon_density uniform = buffon_segment(0, 1);
    const buffon_density rising =
        buffon_inverse(&(buffon_inversion){.quantile = quantile_rising, .pdf = pdf_rising});
    const buffon_density like_f =
        buffon_inverse(&(buffon_inversion){.quantile = quantile_like_f, .pdf = pdf_like_f});
    const buffon_density falling =
        buffon_inverse(&(buffon_inversion){.quantile = quantile_falling, .pdf = pdf_falling});
    int bad = 0;
    printf("g                value  std_err      95 %% interval        variance  exactly\n");
    bad |= show("uniform", &uniform, 0, 1. / 7 - 1. / 16);
    bad |= show("2 x", &rising, 0, 1. / 12 - 1. / 16);
    /* Without a spread there is no telling a constant from a feature that no sample saw ... */
    bad |= show("4 x^3", &like_f, 0, 0);
    /* ... unless the caller knows that f / g is constant, and says so. */
    bad |= show("4 x^3, known", &like_f, 1, 0);
    bad |= show("5 (1 - x)^4", &falling, 0, INFINITY);
    printf("exactly       %.6f\n", 0.25);
    return bad;
}
