#include "guard.h"

#include <math.h>

#include <buffon/bilinear.h>

#include "density_priv.h"
#include "elementary.h"
#include "ramp.h"

/* param: v00, v10, v01, v11, scaled by a power of two so that the largest is in [1/2, 1); then four
 * over their sum. */

static double bilinear_mix(double a, double b, double s)
{
    return (1 - s) * a + s * b;
}

static double bilinear_height(const double *v, double x, double y)
{
    return bilinear_mix(bilinear_mix(v[0], v[2], y), bilinear_mix(v[1], v[3], y), x) * v[4];
}

/* From the nearer end. */
static double biramp_place(double a, double b, double u)
{
    double s, c;
    ramp_place(&s, &c, a, b, u, 1 - u);
    return s < c ? s : 1 - c;
}

static int bilinear_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *v = g->param;
    for (size_t i = 0; i < n; i++) {
        const double y = biramp_place(v[0] + v[1], v[2] + v[3], u[n + i]);
        x[i] = biramp_place(bilinear_mix(v[0], v[2], y), bilinear_mix(v[1], v[3], y), u[i]);
        x[n + i] = y;
        if (pdf)
            pdf[i] = bilinear_height(v, x[i], y);
    }
    return 0;
}

static int bilinear_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const int inside = x[i] >= 0 && x[i] <= 1 && x[n + i] >= 0 && x[n + i] <= 1;
        pdf[i] = inside ? bilinear_height(g->param, x[i], x[n + i]) : 0;
    }
    return 0;
}

static int bilinear_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *v = g->param;
    for (size_t i = 0; i < n; i++) {
        const double y = x[n + i];
        const double a = bilinear_mix(v[0], v[2], y), b = bilinear_mix(v[1], v[3], y);
        u[i] = density_open(ramp_mass(a, b, x[i], 1 - x[i]));
        u[n + i] = density_open(ramp_mass(v[0] + v[1], v[2] + v[3], y, 1 - y));
    }
    return 0;
}

static const buffon_density_ops bilinear_ops = {.sample = bilinear_draw,
                                                .pdf = bilinear_pdf,
                                                .invert = bilinear_unmap,
                                                .name = "buffon.bilinear"};

buffon_density buffon_bilinear(double v00, double v10, double v01, double v11)
{
    buffon_density g = {.uniforms = 2, .dim = 2, .ops = &bilinear_ops};
    const double v[4] = {v00, v10, v01, v11};
    double most = 0;
    int e;
    for (int k = 0; k < 4; k++) {
        if (!(v[k] >= 0) || !buffon_priv_isfinite(v[k]))
            g.status = BUFFON_E_SHAPE;
        most = v[k] > most ? v[k] : most;
    }
    if (!(most > 0))
        g.status = BUFFON_E_SHAPE;
    if (g.status != BUFFON_OK)
        return g;
    buffon_priv_frexp(&e, most);
    for (int k = 0; k < 4; k++)
        g.param[k] = buffon_priv_ldexp(v[k], -e);
    g.param[4] = 4 / ((g.param[0] + g.param[1]) + (g.param[2] + g.param[3]));
    return g;
}
