#include "guard.h"

#include <math.h>

#include <buffon/disk.h>

#include "circle.h"
#include "density_priv.h"
#include "elementary.h"

#define KERNELS "disk_lanes.h"
#include "levels.h"

static double disk_density(double radius)
{
    return DENSITY_INV_PI / radius / radius;
}

static int disk_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    LEVELS_RUN(disk_polar, (x, x + n, u, u + n, n, g->param[0]));
    if (pdf)
        density_fill(pdf, disk_density(g->param[0]), n);
    return 0;
}

static int disk_draw_concentric(double *x, double *pdf, const double *u, size_t n,
                                const buffon_density *g)
{
    LEVELS_RUN(disk_concentric, (x, x + n, u, u + n, n, g->param[0]));
    if (pdf)
        density_fill(pdf, disk_density(g->param[0]), n);
    return 0;
}

/* `inside` at points of the disk, `outside` elsewhere; no square leaves the doubles. */
static void disk_judge(double *out, const double *x, size_t n, double radius, double inside,
                       double outside)
{
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] / radius, b = x[n + i] / radius;
        out[i] = a * a + b * b <= 1 ? inside : outside;
    }
}

static int disk_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    disk_judge(pdf, x, n, g->param[0], disk_density(g->param[0]), 0);
    return 0;
}

static int disk_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double log_pi = 0x1.250d048e7a1bdp+0;
    const double inside = -(log_pi + 2 * buffon_priv_log(g->param[0]));
    disk_judge(log_pdf, x, n, g->param[0], inside, -(double)INFINITY);
    return 0;
}

static int disk_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const double point[2] = {x[i] / g->param[0], x[n + i] / g->param[0]};
        double v[2];
        buffon_disk_invert(v, point);
        u[i] = v[0];
        u[n + i] = v[1];
    }
    return 0;
}

static int disk_unmap_concentric(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        double v[2];
        buffon_priv_concentric_invert(v, x[i] / g->param[0], x[n + i] / g->param[0]);
        u[i] = v[0];
        u[n + i] = v[1];
    }
    return 0;
}

static const buffon_density_ops disk_ops = {.sample = disk_draw,
                                            .pdf = disk_pdf,
                                            .log_pdf = disk_log_pdf,
                                            .invert = disk_unmap,
                                            .name = "buffon.disk"};

static const buffon_density_ops disk_concentric_ops = {.sample = disk_draw_concentric,
                                                       .pdf = disk_pdf,
                                                       .log_pdf = disk_log_pdf,
                                                       .invert = disk_unmap_concentric,
                                                       .name = "buffon.disk_concentric"};

static buffon_density disk_make(double radius, const buffon_density_ops *ops)
{
    buffon_density g = {.uniforms = 2, .dim = 2, .ops = ops};
    if (radius > 0 && buffon_priv_isfinite(radius))
        g.param[0] = radius;
    else
        g.status = BUFFON_E_SHAPE;
    return g;
}

buffon_density buffon_disk(double radius)
{
    return disk_make(radius, &disk_ops);
}

buffon_density buffon_disk_concentric(double radius)
{
    return disk_make(radius, &disk_concentric_ops);
}

void buffon_disk_sample(double x[2], double u1, double u2)
{
    disk_polar_scalar(x, x + 1, &u1, &u2, 1, 1);
}

void buffon_disk_sample_concentric(double x[2], double u1, double u2)
{
    disk_concentric_scalar(x, x + 1, &u1, &u2, 1, 1);
}

void buffon_disk_invert(double u[2], const double x[2])
{
    const double a = x[0], b = x[1];
    u[0] = density_open(a * a + b * b);
    u[1] = buffon_priv_circle_invert(a, b);
}

void buffon_disk_invert_concentric(double u[2], const double x[2])
{
    buffon_priv_concentric_invert(u, x[0], x[1]);
}
