/* One sample is an estimate already; the mean of many is a good one.
 *
 * The primary estimator of int_a^b f is Y = (b - a) f(x) with x uniform on (a, b). Its mean is the
 * integral and its variance sigma^2 = (b - a) int f^2 - (int f)^2. The average of N of them has the
 * same mean and the standard error sigma / sqrt(N): a digit more costs a hundred times the samples.
 *
 * Here f = e^x on (0, 1): int f = e - 1, sigma^2 = (e^2 - 1)/2 - (e - 1)^2. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static double f(const double *x, void *ctx)
{
    (void)ctx;
    return exp(x[0]);
}

int main(void)
{
    const double lo = 0, hi = 1, exact = exp(1) - 1;
    const double sigma = sqrt((exp(2) - 1) / 2 - exact * exact);
    printf("       N     value  std_error  sigma/sqrt(N)       95 %% interval\n");
    for (uint64_t n = 1; n <= 1u << 22; n *= 4) {
        buffon_estimate e;
        const buffon_status s = buffon_uniform(&e, &(buffon_integrand){.scalar = f, .dim = 1}, &lo,
                                               &hi, &(buffon_run){.samples = n, .seed = 1});
        if (s < 0) {
            fprintf(stderr, "%s\n", buffon_status_string(s));
            return 1;
        }
        printf("%8llu  %.6f  %9.6f      %.6f   [%9.6f, %9.6f]", (unsigned long long)n, e.value,
               e.std_error, sigma / sqrt((double)n), e.lo, e.hi);
        printf(s == BUFFON_OK ? "\n" : "  %s\n", buffon_status_string(s));
    }
    printf(" exactly  %.6f\n", exact);
    return 0;
}
