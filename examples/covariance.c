/* Several components and their covariance: the centre of mass of a rod of density e^-x on (0, 1).
 *
 * Mass m = int e^-x and moment a = int x e^-x come from the same points, so their errors are not
 * independent. To first order the variance of the ratio c = a / m is
 *
 *     (Var a - 2 c Cov(a, m) + c^2 Var m) / m^2;
 *
 * leaving out the covariance, which is negative here, would state an error that is too small.
 * Exactly c = (1 - 2/e) / (1 - 1/e). */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

/* Component k of point i is f[k*n + i]: the moment, then the mass. */
static int moment_and_mass(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[n + i] = exp(-x[i]);
        f[i] = x[i] * f[n + i];
    }
    return 0;
}

int main(void)
{
    const double lo = 0, hi = 1;
    buffon_estimate e[2];
    buffon_partial sums = {0};
    double cov[2][2];
    buffon_status s = buffon_uniform(
        e, &(buffon_integrand){.batch = moment_and_mass, .dim = 1, .components = 2}, &lo, &hi,
        &(buffon_run){.samples = 100000, .seed = 2, .covariance = 1, .partial = &sums});
    if (s >= 0)
        s = buffon_partial_covariance(&cov[0][0], &sums);
    buffon_partial_free(&sums);
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    const double a = e[0].value, m = e[1].value, c = a / m;
    const double error = sqrt(cov[0][0] - 2 * c * cov[0][1] + c * c * cov[1][1]) / m;
    const double careless = sqrt(cov[0][0] + c * c * cov[1][1]) / m;
    const double z = buffon_normal_quantile(0.975);
    printf("moment  %.6f +- %.6f, exactly %.6f\n", a, e[0].std_error, 1 - 2 * exp(-1));
    printf("mass    %.6f +- %.6f, exactly %.6f\n", m, e[1].std_error, 1 - exp(-1));
    printf("correlation of their errors %.4f\n", cov[0][1] / (e[0].std_error * e[1].std_error));
    printf("centre  %.6f +- %.6f, 95 %% in [%.6f, %.6f], exactly %.6f\n", c, error, c - z * error,
           c + z * error, (1 - 2 * exp(-1)) / (1 - exp(-1)));
    printf("without the covariance the error would be given as %.6f\n", careless);
    return 0;
}
