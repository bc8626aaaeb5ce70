#include "guard.h"

#include <math.h>

#include <buffon/cap.h>
#include <buffon/hemisphere.h>

#include "circle.h"
#include "density_priv.h"
#include "frame.h"

/* The numbers of a power of the cosine in `param`: the frame, the exponent, 1 / (n + 1) as a double
 * and as the sum of its first 26 bits and a double, (n + 1) / (2 pi). */
enum { LOBE_EXPONENT = FRAME_SIZE, LOBE_SHARE, LOBE_SHARE_TOP, LOBE_SHARE_LOW, LOBE_SCALE };

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

/* ---- powers of the cosine ----------------------------------------------------------------- */

static int hemisphere_draw_power(double *x, double *pdf, const double *u, size_t n,
                                 const buffon_density *g)
{
    double *const row[4] = {x, x + n, x + 2 * n, pdf};
    LEVELS_RUN(hemisphere_power_map, (row, u, u + n, n, g->param));
    return 0;
}

/* log cos of the angle between the axis and a direction of about length 1; -infinity where the
 * density is 0. Near the axis from the sine, which keeps its digits there; its share in the length
 * does not ask for a length of exactly 1. */
static double hemisphere_log_cosine(const double *frame, double x, double y, double z)
{
    const double cosine = x * frame[6] + y * frame[7] + z * frame[8];
    const double square = x * x + y * y + z * z;
    double across[2];
    if (!(cosine > 0 && frame_is_unit(x, y, z)))
        return -(double)INFINITY;
    frame_across(across, frame, x, y, z);
    const double sine = (across[0] * across[0] + across[1] * across[1]) / square;
    return sine < 0.5 ? 0.5 * buffon_priv_log1p(-sine)
                      : buffon_priv_log(cosine) - 0.5 * buffon_priv_log(square);
}

static int hemisphere_pdf_power(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param;
    for (size_t i = 0; i < n; i++) {
        const double log_cosine = hemisphere_log_cosine(p, x[i], x[n + i], x[2 * n + i]);
        const int in = log_cosine > -(double)INFINITY;
        pdf[i] = in ? p[LOBE_SCALE] * buffon_priv_exp(p[LOBE_EXPONENT] * log_cosine) : 0;
    }
    return 0;
}

static int hemisphere_log_pdf_power(double *log_pdf, const double *x, size_t n,
                                    const buffon_density *g)
{
    const double *p = g->param, log_scale = buffon_priv_log(p[LOBE_SCALE]);
    for (size_t i = 0; i < n; i++) {
        const double log_cosine = hemisphere_log_cosine(p, x[i], x[n + i], x[2 * n + i]);
        const int in = log_cosine > -(double)INFINITY;
        log_pdf[i] = in ? log_scale + p[LOBE_EXPONENT] * log_cosine : -(double)INFINITY;
    }
    return 0;
}

static int hemisphere_unmap_power(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *p = g->param;
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i], c = x[2 * n + i];
        const double log_rest = hemisphere_log_cosine(p, a, b, c) / p[LOBE_SHARE];
        double across[2];
        frame_across(across, p, a, b, c);
        u[i] = density_open(-buffon_priv_expm1(log_rest));
        u[n + i] = buffon_priv_circle_invert(across[0], across[1]);
    }
    return 0;
}

static const buffon_density_ops hemisphere_power_ops = {.sample = hemisphere_draw_power,
                                                        .pdf = hemisphere_pdf_power,
                                                        .log_pdf = hemisphere_log_pdf_power,
                                                        .invert = hemisphere_unmap_power,
                                                        .name = "buffon.hemisphere_power"};

/* 1 / (n + 1) and its parts: what n + 1 and the quotient lose is known, products of halves of their
 * digits being exact. */
static void hemisphere_share(double share[3], double exponent)
{
    const double sum = exponent + 1, added = sum - exponent;
    const double lost = (exponent - (sum - added)) + (1 - added), q = 1 / sum;
    const double split = 0x1p27 + 1, ss = split * sum, s1 = ss - (ss - sum), s2 = sum - s1;
    const double q1 = buffon_priv_from_bits(buffon_priv_bits(q) & ~UINT64_C(0x7ffffff));
    const double rest = (1 - q1 * s1) - q1 * s2;
    share[0] = q;
    share[1] = q1;
    share[2] = (rest - q * lost) / sum;
}

buffon_density buffon_hemisphere_power_about(double exponent, const double axis[3])
{
    buffon_density g = {.uniforms = 2, .dim = 3, .ops = &hemisphere_power_ops};
    double n[3];
    if (!axis)
        g.status = BUFFON_E_NULL;
    else if (!(exponent >= 0 && exponent <= 1e15) || frame_unit(n, axis) == 0)
        g.status = BUFFON_E_SHAPE;
    if (g.status != BUFFON_OK)
        return g;
    frame_make(g.param, n);
    g.param[LOBE_EXPONENT] = exponent;
    hemisphere_share(g.param + LOBE_SHARE, exponent);
    g.param[LOBE_SCALE] = 0.5 * DENSITY_INV_PI * (exponent + 1);
    return g;
}

buffon_density buffon_hemisphere_power(double exponent)
{
    const double up[3] = {0, 0, 1};
    return buffon_hemisphere_power_about(exponent, up);
}
