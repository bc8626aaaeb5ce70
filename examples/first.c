#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

/* exp(-x^2 - y^2) over the unit square; exactly 0.557746285351034 */
static double f(const double *x, void *ctx)
{
    (void)ctx;
    return exp(-x[0] * x[0] - x[1] * x[1]);
}

int main(void)
{
    const double lo[] = {0, 0}, hi[] = {1, 1};
    buffon_estimate e;
    buffon_status s = buffon_uniform(&e, &(buffon_integrand){.scalar = f, .dim = 2}, lo, hi,
                                     &(buffon_run){.samples = 1000000, .seed = 42});
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    printf("%.6f +- %.6f, 95 %% in [%.6f, %.6f] (%s)\n", e.value, e.std_error, e.lo, e.hi,
           buffon_status_string(s));
    return 0;
}
