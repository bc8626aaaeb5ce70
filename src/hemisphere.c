#include "guard.h"

#include <math.h>

#include <buffon/cap.h>
#include <buffon/hemisphere.h>

#include "circle.h"
#include "density_priv.h"
#include "frame.h"

#define KERNELS "hemisphere_lanes.h"
#include "levels.h"

static int hemisphere_draw_cosine(double *x, double *pdf, const double *u, size_t n,
                                  const buffon_density *g)
{
    double *const row[4] = {x, x + n, x + 2 * n, pdf};
    LEVELS_RUN(hemisphere_map, (row, u, u + n, n, g->param));
    return 0;
}

static int hemisphere_pdf_cosine(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double nx = g->param[6], ny = g->param[7], nz = g->param[8];
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i], c = x[2 * n + i];
        const double cosine = a * nx + b * ny + c * nz;
        const int in = (cosine > 0) & frame_is_unit(a, b, c);
        pdf[i] = in ? DENSITY_INV_PI * cosine : 0;
    }
    return 0;
}

static int hemisphere_unmap_cosine(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        double v[2], across[2];
        frame_across(across, g->param, x[i], x[n + i], x[2 * n + i]);
        buffon_priv_concentric_invert(v, across[0], across[1]);
        u[i] = v[0];
        u[n + i] = v[1];
    }
    return 0;
}

static const buffon_density_ops hemisphere_cosine_ops = {.sample = hemisphere_draw_cosine,
                                                         .pdf = hemisphere_pdf_cosine,
                                                         .invert = hemisphere_unmap_cosine,
                                                         .name = "buffon.hemisphere_cosine"};

buffon_density buffon_hemisphere(void)
{
    return buffon_cap(0);
}

buffon_density buffon_hemisphere_about(const double axis[3])
{
    return buffon_cap_about(0, axis);
}

buffon_density buffon_hemisphere_cosine_about(const double axis[3])
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = &hemisphere_cosine_ops};
    double n[3];
    if (!axis)
        g.status = BUFFON_E_NULL;
    else if (frame_unit(n, axis) == 0)
        g.status = BUFFON_E_SHAPE;
    else
        frame_make(g.param, n);
    return g;
}

buffon_density buffon_hemisphere_cosine(void)
{
    const double up[3] = {0, 0, 1};
    return buffon_hemisphere_cosine_about(up);
}

void buffon_hemisphere_sample(double x[3], double u1, double u2)
{
    buffon_cap_sample(x, u1, u2, 0);
}

void buffon_hemisphere_sample_cosine(double x[3], double u1, double u2)
{
    double *const row[4] = {x, x + 1, x + 2, NULL};
    hemisphere_points_scalar(row, &u1, &u2, 1, NULL);
}

void buffon_hemisphere_invert(double u[2], const double x[3])
{
    buffon_cap_invert(u, x, 0);
}

void buffon_hemisphere_invert_cosine(double u[2], const double x[3])
{
    buffon_priv_concentric_invert(u, x[0], x[1]);
}
