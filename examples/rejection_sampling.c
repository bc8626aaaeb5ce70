/* Drawing from a density known up to a factor: X ~ g is accepted with probability f(X) / (M g(X)),
 * where M g is an envelope, f <= M g. What is accepted has density f / int f, and the share that is
 * accepted estimates int f / M.
 *
 * Here f = x (1 - x)^2 on (0, 1), at most 4/27, with int f = 1/12 and mean E[X] = 2/5. */
#include <stdio.h>

#include <buffon/buffon.h>

enum { N = 100000 };

static double f(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * (1 - x[0]) * (1 - x[0]);
}

int main(void)
{
    static double x[N];
    const buffon_density g = buffon_segment(0, 1);
    const buffon_integrand law = {.scalar = f, .dim = 1};
    const double envelope = 4. / 27;
    buffon_rng rng = buffon_rng_make(27, 0);
    buffon_rejection_report report;
    buffon_status s = buffon_rejection_sample(x, N, &report, &law, &g, envelope, &rng, 0);
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    printf("%llu of %llu accepted: %.4f, expected %.4f\n", (unsigned long long)report.accepted,
           (unsigned long long)report.tries, report.acceptance, 1. / 12 / envelope);

    buffon_stats stats = {0};
    buffon_estimate mean;
    buffon_stats_add(&stats, x, N);
    s = buffon_stats_estimate(&mean, &stats, 0.95);
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    printf("E[X] = %.6f +- %.6f, 95 %% in [%.6f, %.6f], exactly 0.4\n", mean.value, mean.std_error,
           mean.lo, mean.hi);

    /* An envelope that is too low is found out as soon as a point lies above it. */
    s = buffon_rejection_sample(x, N, &report, &law, &g, 0.14, &rng, 0);
    printf("envelope 0.14: %s\n", buffon_status_string(s));
    if (s != BUFFON_E_BOUND)
        return 1;
    printf("    f / (M g) = %.4f at x = %.4f\n", report.worst, x[report.accepted]);
    return 0;
}
