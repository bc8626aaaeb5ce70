/* Direct light from a sphere on a surface: L' = (rho / pi) int L0 cos(theta) dw over the directions
 * in which the sphere is seen. They form a cap, and points of the cap are drawn uniformly by its
 * solid angle, so no sample misses the light.
 *
 * A sphere wholly above the horizon gives L' = rho L0 (r / d)^2 cos(angle of its centre), exactly.
 */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double pi = 3.14159265358979323846;

static double cosine(const double *w, void *normal)
{
    const double *n = normal, c = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
    return c > 0 ? c : 0;
}

int main(void)
{
    const double point[3] = {0, 0, 0}, centre[3] = {0, 1, 3}, radius = 1, rho = 0.5, L0 = 10;
    double normal[3] = {0, 0, 1};
    buffon_estimate e;
    const buffon_density cap = buffon_cap_of_sphere(point, centre, radius);
    const buffon_status s =
        buffon_importance(&e, &(buffon_integrand){.scalar = cosine, .dim = 3, .ctx = normal}, &cap,
                          &(buffon_run){.samples = 4096});
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    const double factor = rho / pi * L0, d2 = 1 + 9;
    const double exact = rho * L0 * (radius * radius / d2) * (3 / sqrt(d2));
    printf("L' = %.6f +- %.6f, exactly %.6f\n", factor * e.value, factor * e.std_error, exact);
    return 0;
}
