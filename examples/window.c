/* Daylight through a window on a desk: E = int L0 cos(theta) dw over the directions in which the
 * window is seen, with L0 = 1. Three densities for the same integral:
 *
 *     points of the window by its area: f has the factor cos(theta') / d^2, which varies
 *     directions into the window, uniform by solid angle: only cos(theta) varies
 *     directions of the hemisphere by the cosine: nothing varies, but most of them miss
 *
 * Lambert gives E exactly: half the sum over the sides of the angle that a side covers times the
 * height of the normal of its plane. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double desk[3] = {0, 0, 0}, corner[3] = {-0.5, 0.4, 0.1};
static const double across[3] = {1.5, 0, 0}, up[3] = {0, 0, 1.2};

static double by_area(const double *x, void *ctx)
{
    const double square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    (void)ctx;
    return x[2] * x[1] / (square * square); /* the normals are z and -y */
}

static double by_direction(const double *w, void *ctx)
{
    (void)ctx;
    return w[2];
}

/* The window is in the plane y = 0.4. */
static double by_cosine(const double *w, void *ctx)
{
    const double x = 0.4 * w[0] / w[1], z = 0.4 * w[2] / w[1];
    (void)ctx;
    return w[1] > 0 && x > -0.5 && x < 1 && z > 0.1 && z < 1.3 ? w[2] : 0;
}

static double lambert(void)
{
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        double p[3], q[3];
        for (int j = 0; j < 3; j++) {
            p[j] = corner[j] + (k == 1 || k == 2) * across[j] + (k >= 2) * up[j];
            q[j] = corner[j] + (k == 0 || k == 1) * across[j] + (k == 1 || k == 2) * up[j];
        }
        const double x = p[1] * q[2] - p[2] * q[1], y = p[2] * q[0] - p[0] * q[2];
        const double z = p[0] * q[1] - p[1] * q[0], sine = sqrt(x * x + y * y + z * z);
        sum += 0.5 * atan2(sine, p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) * z / sine;
    }
    return fabs(sum);
}

int main(void)
{
    const struct {
        const char *name;
        buffon_density g;
        double (*f)(const double *x, void *ctx);
    } ways[] = {
        {"points of the window, by area", buffon_parallelogram(corner, across, up), by_area},
        {"directions, by solid angle", buffon_spherical_rectangle(desk, corner, across, up),
         by_direction},
        {"directions of the sky, by cosine", buffon_hemisphere_cosine(), by_cosine},
    };
    printf("the window covers %.6f of 2 pi; the desk gets %.6f\n",
           buffon_solid_angle_parallelogram(desk, corner, across, up), lambert());
    for (int k = 0; k < 3; k++) {
        buffon_estimate e;
        const buffon_status s =
            buffon_importance(&e, &(buffon_integrand){.scalar = ways[k].f, .dim = 3}, &ways[k].g,
                              &(buffon_run){.samples = 4096});
        if (s < 0) {
            fprintf(stderr, "%s: %s\n", ways[k].name, buffon_status_string(s));
            return 1;
        }
        printf("%-34s %.6f +- %.6f\n", ways[k].name, e.value, e.std_error);
    }
    return 0;
}
