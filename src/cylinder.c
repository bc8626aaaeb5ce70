#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/cylinder.h>
#include <buffon/math.h>

#include "circle.h"
#include "density_priv.h"
#include "elementary.h"
#include "frame.h"

/* The numbers of a cylinder in `param`: the frame, the middle of the first end, length and radius,
 * what is spared along the axis, the pdf. */
enum {
    CYLINDER_FROM = FRAME_SIZE,
    CYLINDER_LENGTH = CYLINDER_FROM + 3,
    CYLINDER_RADIUS,
    CYLINDER_SLACK,
    CYLINDER_DENSITY
};

/* Sines and cosines come in batches, and stand where the points will. */
static int cylinder_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *f = g->param, *from = f + CYLINDER_FROM;
    const double radius = f[CYLINDER_RADIUS], length = f[CYLINDER_LENGTH];
    double *const y = x + n, *const z = x + 2 * n;
    for (size_t i = 0; i < n; i++)
        z[i] = 2 * u[n + i];
    buffon_math_sincospi(y, x, z, n);
    for (size_t i = 0; i < n; i++) {
        const double t = radius * x[i], b = radius * y[i], h = length * u[i];
        x[i] = from[0] + (t * f[0] + b * f[3] + h * f[6]);
        y[i] = from[1] + (t * f[1] + b * f[4] + h * f[7]);
        z[i] = from[2] + (t * f[2] + b * f[5] + h * f[8]);
    }
    if (pdf)
        density_fill(pdf, f[CYLINDER_DENSITY], n);
    return 0;
}

/* A point in units of the radius: across the axis, and along it from the first end. */
static void cylinder_place(double out[3], double x, double y, double z, const double *f)
{
    const double *from = f + CYLINDER_FROM, radius = f[CYLINDER_RADIUS];
    const double a = x - from[0], b = y - from[1], c = z - from[2];
    out[0] = (a * f[0] + b * f[1] + c * f[2]) / radius;
    out[1] = (a * f[3] + b * f[4] + c * f[5]) / radius;
    out[2] = a * f[6] + b * f[7] + c * f[8];
}

static int cylinder_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *f = g->param, slack = f[CYLINDER_SLACK];
    const double room = 0x1p-20 + slack / f[CYLINDER_RADIUS];
    for (size_t i = 0; i < n; i++) {
        double at[3];
        cylinder_place(at, x[i], x[n + i], x[2 * n + i], f);
        const double off = sqrt(at[0] * at[0] + at[1] * at[1]) - 1;
        const int in = at[2] >= -slack && at[2] <= f[CYLINDER_LENGTH] + slack;
        pdf[i] = in && buffon_priv_abs(off) <= room ? f[CYLINDER_DENSITY] : 0;
    }
    return 0;
}

static int cylinder_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        double at[3];
        cylinder_place(at, x[i], x[n + i], x[2 * n + i], g->param);
        u[i] = density_open(at[2] / g->param[CYLINDER_LENGTH]);
        u[n + i] = buffon_priv_circle_invert(at[0], at[1]);
    }
    return 0;
}

static const buffon_density_ops cylinder_ops = {.sample = cylinder_draw,
                                                .pdf = cylinder_pdf,
                                                .invert = cylinder_invert,
                                                .name = "buffon.cylinder"};

buffon_density buffon_cylinder(const double from[3], const double to[3], double radius)
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = &cylinder_ops};
    double axis[3] = {0}, n[3] = {0}, most = radius;
    int valid = radius > 0 && radius <= 0x1p1000;
    if (!from || !to) {
        g.status = BUFFON_E_NULL;
        return g;
    }
    for (size_t j = 0; j < 3; j++) {
        const double a = buffon_priv_abs(from[j]), b = buffon_priv_abs(to[j]);
        valid &= a <= 0x1p1000 && b <= 0x1p1000;
        most = a > most ? a : most;
        most = b > most ? b : most;
        axis[j] = to[j] - from[j];
        g.param[CYLINDER_FROM + j] = from[j];
    }
    const double length = frame_unit(n, axis), area = radius * length;
    if (!(valid && area >= DBL_MIN && area <= 0x1p1019)) {
        g = (buffon_density){.uniforms = 2, .dim = 3, .ops = &cylinder_ops};
        g.status = BUFFON_E_SHAPE;
        return g;
    }
    frame_make(g.param, n);
    g.param[CYLINDER_LENGTH] = length;
    g.param[CYLINDER_RADIUS] = radius;
    g.param[CYLINDER_SLACK] = 0x1p-50 * most;
    g.param[CYLINDER_DENSITY] = 0.5 * DENSITY_INV_PI / area;
    return g;
}
