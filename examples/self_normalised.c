/* Expectations under a density p that is known up to a factor only:
 *
 *     E_p[h] ~ sum w h / sum w,  w = p(X) / g(X),  X ~ g.
 *
 * A coin gave 7 heads in 10 throws. With a uniform prior its chance t of heads has the posterior
 * p ~ t^7 (1 - t)^3, whose mean is 8/12 and second moment 8 9 / (12 13). The effective sample size
 * says how many points of p itself those of g are worth. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static int powers(double *h, const double *t, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        h[i] = t[i];
        h[n + i] = t[i] * t[i];
    }
    return 0;
}

static double posterior(const double *t, void *ctx)
{
    (void)ctx;
    return pow(t[0], 7) * pow(1 - t[0], 3);
}

static double quantile(double u, void *ctx) /* F = t^4 */
{
    (void)ctx;
    return pow(u, 1. / 4);
}

static double pdf(double t, void *ctx)
{
    (void)ctx;
    return 4 * pow(t, 3);
}

static int show(const char *name, const buffon_density *g)
{
    const buffon_integrand h = {.batch = powers, .dim = 1, .components = 2};
    const buffon_integrand p = {.scalar = posterior, .dim = 1};
    const double exact[] = {8. / 12, 8. * 9 / (12 * 13)};
    buffon_estimate e[2];
    const buffon_status s =
        buffon_self_normalised(e, &h, &p, g, &(buffon_run){.samples = 100000, .seed = 1763});
    if (s < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(s));
        return 1;
    }
    printf("g %-8s  effective sample size %.0f of %llu\n", name, e[0].ess,
           (unsigned long long)e[0].samples);
    for (size_t k = 0; k < 2; k++)
        printf("    E[t^%zu] = %.6f +- %.6f, 95 %% in [%.6f, %.6f], exactly %.6f\n", k + 1,
               e[k].value, e[k].std_error, e[k].lo, e[k].hi, exact[k]);
    return 0;
}

int main(void)
{
    const buffon_density uniform = buffon_segment(0, 1);
    const buffon_density rising =
        buffon_inverse(&(buffon_inversion){.quantile = quantile, .pdf = pdf});
    const int bad = show("uniform", &uniform);
    return bad | show("4 t^3", &rising);
}
