#include "guard.h"

#include <math.h>

#include <buffon/sphere.h>

#include "circle.h"
#include "density_priv.h"
#include "frame.h"
#include "sphere_priv.h"

#define KERNELS "sphere_lanes.h"
#include "levels.h"

void buffon_priv_sphere_pair(double *x, double *y, double *rest, const double *u1, const double *u2,
                             size_t n, double power)
{
    LEVELS_RUN(sphere_pair, (x, y, rest, u1, u2, n, power));
}

void buffon_priv_sphere_circle(double *x, double *y, const double *square, const double *turn,
                               size_t n)
{
    LEVELS_RUN(sphere_circle, (x, y, square, turn, n));
}

static int sphere_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    (void)g;
    LEVELS_RUN(sphere_map, (x, x + n, x + 2 * n, u, u + n, n));
    if (pdf)
        density_fill(pdf, 0.25 * DENSITY_INV_PI, n);
    return 0;
}

static int sphere_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++)
        pdf[i] = frame_is_unit(x[i], x[n + i], x[2 * n + i]) ? 0.25 * DENSITY_INV_PI : 0;
    return 0;
}

static int sphere_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++) {
        const double point[3] = {x[i], x[n + i], x[2 * n + i]};
        double v[2];
        buffon_sphere_invert(v, point);
        u[i] = v[0];
        u[n + i] = v[1];
    }
    return 0;
}

static const buffon_density_ops sphere_ops = {
    .sample = sphere_draw, .pdf = sphere_pdf, .invert = sphere_unmap, .name = "buffon.sphere"};

buffon_density buffon_sphere(void)
{
    return (buffon_density){.uniforms = 2, .dim = 3, .ops = &sphere_ops};
}

void buffon_sphere_sample(double x[3], double u1, double u2)
{
    sphere_map_scalar(x, x + 1, x + 2, &u1, &u2, 1);
}

/* u1 is a quarter of the squared chord to the north pole, and 1 - u1 of that to the south pole: the
 * nearer pole is the one whose chord keeps its digits. */
void buffon_sphere_invert(double u[2], const double x[3])
{
    const double a = x[0], b = x[1], gap = 1 - buffon_priv_abs(x[2]);
    const double depth = 0.25 * (a * a + b * b + gap * gap);
    u[0] = density_open(x[2] > 0 ? depth : 1 - depth);
    u[1] = buffon_priv_circle_invert(a, b);
}
