/* The sun sets. A level surface gets E = int cos(theta) exp(-tau / (cos(theta) + 0.025)) dw over
 * that part of the sun's disk which is above the horizon: less the lower it stands, and less of it.
 * (The exponential is a simple law of the air that the light comes through.)
 *
 * Uniform points of the disk waste those below the horizon, and find cosines that differ many times
 * over. Points by the cosine are all above it, and what is left to be averaged hardly varies.
 * Without air the irradiance is known: buffon_cap_irradiance.
 */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static double light(const double *w, void *tau)
{
    return w[2] > 0 ? w[2] * exp(-*(double *)tau / (w[2] + 0.025)) : 0;
}

static int relative_error(double *percent, double *value, const buffon_density *g, double *tau)
{
    buffon_estimate e;
    const buffon_status s =
        buffon_importance(&e, &(buffon_integrand){.scalar = light, .dim = 3, .ctx = tau}, g,
                          &(buffon_run){.samples = 4096});
    *percent = 100 * e.std_error / e.value;
    *value = e.value;
    if (s < 0)
        fprintf(stderr, "%s\n", buffon_status_string(s));
    return s < 0;
}

int main(void)
{
    const double degree = 3.14159265358979323846 / 180, half_angle = 0.2666 * degree;
    const double heights[] = {30, 1, 0.2, 0, -0.2}, up[3] = {0, 0, 1};
    double tau = 0.15;
    printf("height    without air    with air   error, uniform   by the cosine\n");
    for (int k = 0; k < 5; k++) {
        const double h = heights[k] * degree, sun[3] = {cos(h), 0, sin(h)};
        const buffon_density disk = buffon_cap_angle(half_angle, sun);
        const buffon_density seen = buffon_cap_cosine(half_angle, sun, up);
        double uniform, by_cosine, value;
        if (relative_error(&uniform, &value, &disk, &tau) ||
            relative_error(&by_cosine, &value, &seen, &tau))
            return 1;
        printf("%5.1f deg %13.6e %12.4e %14.3f %% %13.4f %%\n", heights[k],
               buffon_cap_irradiance(half_angle, sun, up), value, uniform, by_cosine);
    }
    return 0;
}
