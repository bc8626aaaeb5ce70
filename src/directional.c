#include "guard.h"

#include <math.h>

#include <buffon/directional.h>
#include <buffon/math.h>

#include "circle.h"
#include "density_priv.h"
#include "frame.h"

/* In `param` after the frame. Henyey and Greenstein: g, 1 - g, 1 + g, what the cube of D is to be
 * multiplied by for the density, and the factor of the density at given points. */
enum { SCATTER_G = FRAME_SIZE, SCATTER_BACK, SCATTER_FRONT, SCATTER_TOP, SCATTER_FACTOR };

/* Von Mises and Fisher: kappa; expm1(-2 kappa) and expm1(2 kappa); exp(-2 kappa); 1 - u1 of the
 * points at right angles to the axis, below which they lie behind, 0 where no double does; the
 * density on the axis. */
enum { FISHER_KAPPA = FRAME_SIZE, FISHER_FRONT, FISHER_BACK, FISHER_FAR, FISHER_EDGE, FISHER_TOP };

#define KERNELS "directional_lanes.h"
#include "levels.h"

/* Half the squared chords from the axis and from its opposite: 1 - cos and 1 + cos. */
static void directional_chords(double *near, double *far, const double n[3], double x, double y,
                               double z)
{
    const double nx = n[0], ny = n[1], nz = n[2];
    *near = 0.5 * ((x - nx) * (x - nx) + (y - ny) * (y - ny) + (z - nz) * (z - nz));
    *far = 0.5 * ((x + nx) * (x + nx) + (y + ny) * (y + ny) + (z + nz) * (z + nz));
}

/* What both constructors begin with: the density is good if `valid` and the axis is one. */
static buffon_density directional_make(const buffon_density_ops *ops, int valid,
                                       const double axis[3])
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = ops};
    double n[3];
    if (!axis)
        g.status = BUFFON_E_NULL;
    else if (!valid || frame_unit(n, axis) == 0)
        g.status = BUFFON_E_SHAPE;
    else
        frame_make(g.param, n);
    return g;
}

/* The uniforms of a point: the first, and the turn about the axis. */
static void directional_open(double *u, size_t n, double first, const buffon_density *g,
                             const double x[3])
{
    double across[2];
    frame_across(across, g->param, x[0], x[1], x[2]);
    u[0] = density_open(first);
    u[n] = buffon_priv_circle_invert(across[0], across[1]);
}

/* ---- Henyey and Greenstein ---- */

static int scatter_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    double *const row[4] = {x, x + n, x + 2 * n, pdf};
    LEVELS_RUN(scatter_map, (row, u, u + n, n, g->param));
    return 0;
}

/* 1 + g^2 - 2 g cos as a sum of positives: from the axis for g > 0, from its opposite below. */
static double scatter_square(double near, double far, const double *param)
{
    const double g = param[SCATTER_G], a = param[SCATTER_BACK], b = param[SCATTER_FRONT];
    return g > 0 ? a * a + 2 * g * near : b * b - 2 * g * far;
}

static int scatter_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double factor = g->param[SCATTER_FACTOR];
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i], c = x[2 * n + i];
        double near, far;
        directional_chords(&near, &far, g->param + 6, a, b, c);
        const double square = scatter_square(near, far, g->param);
        pdf[i] = frame_is_unit(a, b, c) ? factor / (square * sqrt(square)) : 0;
    }
    return 0;
}

/* With s the root of 1 + g^2 - 2 g cos, D = a b / s, and u1 = (b - D) / (2 g): the division by g
 * cancels in b w / (s (s + a)). */
static int scatter_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double a = g->param[SCATTER_BACK], b = g->param[SCATTER_FRONT];
    for (size_t i = 0; i < n; i++) {
        const double point[3] = {x[i], x[n + i], x[2 * n + i]};
        double near, far;
        directional_chords(&near, &far, g->param + 6, point[0], point[1], point[2]);
        const double s = sqrt(scatter_square(near, far, g->param));
        directional_open(u + i, n, b * near / (s * (s + a)), g, point);
    }
    return 0;
}

static const buffon_density_ops scatter_ops = {.sample = scatter_draw,
                                               .pdf = scatter_pdf,
                                               .invert = scatter_invert,
                                               .name = "buffon.henyey_greenstein"};

buffon_density buffon_henyey_greenstein(double g, const double axis[3])
{
    buffon_density made = directional_make(&scatter_ops, g > -1 && g < 1, axis);
    const double a = 1 - g, b = 1 + g;
    made.param[SCATTER_G] = g;
    made.param[SCATTER_BACK] = a;
    made.param[SCATTER_FRONT] = b;
    made.param[SCATTER_TOP] = 0.25 * DENSITY_INV_PI / (a * a * (b * b));
    made.param[SCATTER_FACTOR] = 0.25 * DENSITY_INV_PI * (a * b);
    return made;
}

/* ---- von Mises and Fisher ---- */

static int fisher_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    double *const row[4] = {x, x + n, x + 2 * n, pdf};
    LEVELS_RUN(fisher_map, (row, u, u + n, n, g->param));
    return 0;
}

/* The exponent of the density; -infinity off the sphere. */
static int fisher_exponent(double *y, const double *x, size_t n, const buffon_density *g)
{
    const double kappa = g->param[FISHER_KAPPA];
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i], c = x[2 * n + i];
        double near, far;
        directional_chords(&near, &far, g->param + 6, a, b, c);
        y[i] = frame_is_unit(a, b, c) ? -kappa * near : -(double)INFINITY;
    }
    return 0;
}

static int fisher_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    fisher_exponent(pdf, x, n, g);
    buffon_math_exp(pdf, pdf, n);
    for (size_t i = 0; i < n; i++)
        pdf[i] *= g->param[FISHER_TOP];
    return 0;
}

static int fisher_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double top = buffon_priv_log(g->param[FISHER_TOP]);
    fisher_exponent(log_pdf, x, n, g);
    for (size_t i = 0; i < n; i++)
        log_pdf[i] += top;
    return 0;
}

/* u1 = expm1(-kappa w) / expm1(-2 kappa). */
static int fisher_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double kappa = g->param[FISHER_KAPPA], front = g->param[FISHER_FRONT];
    for (size_t i = 0; i < n; i++) {
        const double point[3] = {x[i], x[n + i], x[2 * n + i]};
        double near, far;
        directional_chords(&near, &far, g->param + 6, point[0], point[1], point[2]);
        const double first = kappa > 0 ? buffon_priv_expm1(-kappa * near) / front : 0.5 * near;
        directional_open(u + i, n, first, g, point);
    }
    return 0;
}

static const buffon_density_ops fisher_ops = {.sample = fisher_draw,
                                              .pdf = fisher_pdf,
                                              .log_pdf = fisher_log_pdf,
                                              .invert = fisher_invert,
                                              .name = "buffon.von_mises_fisher"};

/* Below 2^-54 the law is that of the sphere to the last digit. From 40 on no double is near enough
 * to 1 to be behind. */
buffon_density buffon_von_mises_fisher(double kappa, const double axis[3])
{
    buffon_density g = directional_make(&fisher_ops, kappa >= 0 && kappa <= 0x1p900, axis);
    const double half = buffon_priv_exp(-kappa);
    g.param[FISHER_TOP] = 0.25 * DENSITY_INV_PI;
    g.param[FISHER_FAR] = 1;
    if (kappa < 0x1p-54)
        return g;
    g.param[FISHER_KAPPA] = kappa;
    g.param[FISHER_FRONT] = buffon_priv_expm1(-2 * kappa);
    g.param[FISHER_BACK] = kappa < 40 ? buffon_priv_expm1(2 * kappa) : 0;
    g.param[FISHER_EDGE] = kappa < 40 ? half / (1 + half) : 0;
    g.param[FISHER_FAR] = buffon_priv_exp(-2 * kappa);
    g.param[FISHER_TOP] = 0.5 * DENSITY_INV_PI * (kappa / -g.param[FISHER_FRONT]);
    return g;
}
