/* A vector-valued integrand in six dimensions, evaluated by the batch, to a tolerance, on two
 * threads, with a progress line.
 *
 * The run looks at 2^13, 2^14, ... samples and stops when the interval of every component is narrow
 * enough. The interval that comes back covers as stated although the run chose when to stop. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

enum { DIM = 6 };

/* exp(-r^2) and r^2 exp(-r^2): component k of point i is f[k*n + i], coordinate j is x[j*n + i]. */
static int moments(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        double r2 = 0;
        for (size_t j = 0; j < DIM; j++)
            r2 += x[j * n + i] * x[j * n + i];
        f[i] = exp(-r2);
        f[n + i] = r2 * f[i];
    }
    return 0;
}

static int show(const buffon_progress *p, void *ctx)
{
    (void)ctx;
    fprintf(stderr, "\r%3.0f %%  %.6f +- %.6f", 100. * (double)p->done / (double)p->total,
            p->estimate[0].value, p->estimate[0].std_error);
    return 0; /* anything else would cancel */
}

int main(void)
{
    const double lo[DIM] = {0}, hi[DIM] = {1, 1, 1, 1, 1, 1};
    buffon_estimate e[2];
    const buffon_status s = buffon_uniform(
        e, &(buffon_integrand){.batch = moments, .dim = DIM, .components = 2}, lo, hi,
        &(buffon_run){.samples = 1u << 28, .rel_tol = 1e-3, .threads = 2, .progress = show});
    fprintf(stderr, "\n");
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    /* The integrals factor: a = int_0^1 exp(-t^2) = 0.7468241, b = int_0^1 t^2 exp(-t^2) =
     * 0.1894723. */
    const double a = 0.74682413281242702, b = 0.18947234582049235;
    printf("             estimate    std_error   95 %% interval          exact\n");
    printf("exp(-r2)     %.7f   %.7f   [%.6f, %.6f]   %.7f\n", e[0].value, e[0].std_error, e[0].lo,
           e[0].hi, pow(a, 6));
    printf("r2 exp(-r2)  %.7f   %.7f   [%.6f, %.6f]   %.7f\n", e[1].value, e[1].std_error, e[1].lo,
           e[1].hi, 6 * b * pow(a, 5));
    printf("%llu samples: %s\n", (unsigned long long)e[0].samples, buffon_status_string(s));
    return 0;
}
