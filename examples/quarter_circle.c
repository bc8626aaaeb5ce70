/* The smallest program: pi as four times the area under sqrt(1 - x^2) from 0 to 1.
 *
 * Without options a run has 2^20 independent points and a 95 % interval. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static double quarter_circle(const double *x, void *ctx)
{
    (void)ctx;
    return sqrt(1 - x[0] * x[0]);
}

int main(void)
{
    const double lo = 0, hi = 1;
    buffon_estimate e;
    const buffon_status s = buffon_uniform(
        &e, &(buffon_integrand){.scalar = quarter_circle, .dim = 1}, &lo, &hi, NULL);
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    printf("pi = %.6f +- %.6f\n", 4 * e.value, 4 * e.std_error);
    return 0;
}
