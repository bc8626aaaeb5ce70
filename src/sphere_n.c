#include "guard.h"

#include <math.h>

#include <buffon/sphere_n.h>

#include "circle.h"
#include "density_priv.h"
#include "elementary.h"
#include "sphere_priv.h"

/* In `param`: the density, its logarithm, and how many coordinates of the sphere are left out. */
enum { SPHERE_N_PDF, SPHERE_N_LOG_PDF, SPHERE_N_HIDDEN };

enum { SPHERE_N_TILE = 256 };

#define SPHERE_N_MOST 0x7fffffffu
#define SPHERE_N_EXCESS 0x1.1d1afdb068d79p-54
#define SPHERE_N_LOG_PI 0x1.250d048e7a1bdp+0
#define SPHERE_N_LOG_SQRT_2PI 0x1.d67f1c864beb5p-1

/* The last three: z is uniform, and x and y have the square 4 u (1 - u) together. */
static void sphere_n_three(double *const row[3], double *rest, const double *u, const double *turn,
                           size_t n)
{
    for (size_t i = 0; i < n; i++) {
        row[2][i] = sqrt(rest[i]) * (1 - 2 * u[i]);
        rest[i] *= 4 * (u[i] * (1 - u[i]));
    }
    buffon_priv_sphere_circle(row[0], row[1], rest, turn, n);
}

/* Of which a ball shows the first. */
static void sphere_n_one(double *x, const double *rest, const double *u, size_t n)
{
    for (size_t i = 0; i < n; i++)
        x[i] = sqrt(rest[i]) * (2 * u[i] - 1);
}

/* n points of a stretch of `all`: row j of x and of u is at j * all. */
static void sphere_n_points(double *x, const double *u, size_t n, size_t all,
                            const buffon_density *g)
{
    const int hidden = g->param[SPHERE_N_HIDDEN] > 0;
    double rest[SPHERE_N_TILE]; /* what is left of |x|^2 = 1 */
    size_t r = g->dim + (hidden ? 2 : 0);
    density_fill(rest, 1, n);
    for (; r > 3; r -= 2, x += 2 * all, u += 2 * all)
        buffon_priv_sphere_pair(x, x + all, rest, u, u + all, n, 2.0 / (double)(r - 2));
    if (r == 3 && hidden)
        sphere_n_one(x, rest, u, n);
    else if (r == 3)
        sphere_n_three((double *const[]){x, x + all, x + 2 * all}, rest, u, u + all, n);
    else if (!hidden)
        buffon_priv_sphere_circle(x, x + all, rest, u, n);
}

static int sphere_n_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    for (size_t start = 0; start < n; start += SPHERE_N_TILE)
        sphere_n_points(x + start, u + start, n - start < SPHERE_N_TILE ? n - start : SPHERE_N_TILE,
                        n, g);
    if (pdf)
        density_fill(pdf, g->param[SPHERE_N_PDF], n);
    return 0;
}

/* Where the density is: `inside` there, else `outside`. */
static void sphere_n_support(double *out, const double *x, size_t n, const buffon_density *g,
                             double inside, double outside)
{
    const int solid = g->param[SPHERE_N_HIDDEN] > 0;
    const double slack = 0x1p-50 * (double)g->dim;
    for (size_t i = 0; i < n; i++) {
        double square = 0;
        for (size_t j = 0; j < g->dim; j++)
            square += x[j * n + i] * x[j * n + i];
        const int in = solid ? square <= 1 + slack : buffon_priv_abs(square - 1) <= 0x1p-20;
        out[i] = in ? inside : outside;
    }
}

static int sphere_n_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    sphere_n_support(pdf, x, n, g, g->param[SPHERE_N_PDF], 0);
    return 0;
}

static int sphere_n_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    sphere_n_support(log_pdf, x, n, g, g->param[SPHERE_N_LOG_PDF], -(double)INFINITY);
    return 0;
}

/* From the last coordinates, whose squares sum to `rest`, to the first. A pair's squares are to the
 * sum of it and the rest as 1 - (1 - u)^(2 / (r - 2)) to 1. */
static void sphere_n_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    const int hidden = g->param[SPHERE_N_HIDDEN] > 0;
    size_t j = g->dim, r = hidden ? 2 : 0;
    double rest = 0;
    if (hidden) {
        double square = 0;
        for (size_t k = 0; k < g->dim; k++)
            square += x[k * n] * x[k * n];
        rest = square < 1 ? 1 - square : 0;
    }
    if (hidden && g->dim % 2) {
        const double z = x[--j * n], size = sqrt(rest + z * z);
        u[j * n] = density_open(size > 0 ? 0.5 + 0.5 * (z / size) : 0.5);
        rest += z * z;
        r = 3;
    } else if (g->dim % 2) {
        const double a = x[(j - 3) * n], b = x[(j - 2) * n], z = x[(j - 1) * n];
        const double across = a * a + b * b, size = sqrt(across + z * z), far = buffon_priv_abs(z);
        const double depth = across > 0 ? 0.5 * across / (size * (size + far)) : 0;
        j -= 3;
        u[j * n] = density_open(z > 0 ? depth : 1 - depth);
        u[(j + 1) * n] = buffon_priv_circle_invert(a, b);
        rest = across + z * z;
        r = 3;
    } else if (!hidden) {
        const double a = x[(j - 2) * n], b = x[(j - 1) * n];
        j -= 2;
        u[j * n] = buffon_priv_circle_invert(a, b);
        rest = a * a + b * b;
        r = 2;
    }
    while (j > 0) {
        const double a = x[(j - 2) * n], b = x[(j - 1) * n], square = a * a + b * b;
        j -= 2;
        r += 2;
        const double left = -buffon_priv_log1p(square / rest) * (0.5 * (double)(r - 2));
        u[j * n] = density_open(rest > 0 ? -buffon_priv_expm1(left) : 1);
        u[(j + 1) * n] = buffon_priv_circle_invert(a, b);
        rest += square;
    }
}

static int sphere_n_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        sphere_n_unmap(u + i, x + i, n, g);
    return 0;
}

static const buffon_density_ops sphere_n_ops = {.sample = sphere_n_draw,
                                                .pdf = sphere_n_pdf,
                                                .log_pdf = sphere_n_log_pdf,
                                                .invert = sphere_n_invert,
                                                .name = "buffon.sphere_n"};

static const buffon_density_ops ball_n_ops = {.sample = sphere_n_draw,
                                              .pdf = sphere_n_pdf,
                                              .log_pdf = sphere_n_log_pdf,
                                              .invert = sphere_n_invert,
                                              .name = "buffon.ball_n"};

/* Gamma(d/2) / (2 pi^(d/2)): from d = 1, 2 on by factors d / (2 pi), which may overflow. The double
 * nearest to 1/pi exceeds it by SPHERE_N_EXCESS of itself, each time. */
static double sphere_n_inverse_area(size_t dim)
{
    const size_t pairs = dim / 2;
    double product = dim % 2 ? 0.5 : 0.5 * DENSITY_INV_PI;
    for (size_t d = dim % 2 ? 1 : 2; d < dim && buffon_priv_isfinite(product); d += 2)
        product *= 0.5 * DENSITY_INV_PI * (double)d;
    if (!buffon_priv_isfinite(product))
        return product;
    return product - product * (SPHERE_N_EXCESS * (double)pairs);
}

/* Its logarithm for large d by Stirling's series in z = d/2. */
static double sphere_n_log_inverse_area(double z)
{
    const double series = (1 - 1 / (30 * z * z)) / (12 * z);
    const double log_z = buffon_priv_log(z);
    return z * (log_z - SPHERE_N_LOG_PI - 1) - 0.5 * log_z + (SPHERE_N_LOG_SQRT_2PI + series) -
           0x1.62e42fefa39efp-1;
}

static buffon_density sphere_n_make(const buffon_density_ops *ops, size_t dim, int hidden)
{
    buffon_density g = {.uniforms = hidden ? dim : dim - 1, .dim = dim, .ops = ops};
    if (dim < (hidden ? 1 : 2) || dim > SPHERE_N_MOST) {
        g.uniforms = g.dim = 1;
        g.status = BUFFON_E_DIM;
        return g;
    }
    const double pdf = sphere_n_inverse_area(dim) * (hidden ? (double)dim : 1);
    g.param[SPHERE_N_PDF] = pdf;
    g.param[SPHERE_N_LOG_PDF] = buffon_priv_log(pdf);
    if (!buffon_priv_isfinite(pdf))
        g.param[SPHERE_N_LOG_PDF] = sphere_n_log_inverse_area(0.5 * (double)dim) +
                                    (hidden ? buffon_priv_log((double)dim) : 0);
    g.param[SPHERE_N_HIDDEN] = hidden ? 2 : 0;
    return g;
}

buffon_density buffon_sphere_n(size_t dim)
{
    return sphere_n_make(&sphere_n_ops, dim, 0);
}

buffon_density buffon_ball_n(size_t dim)
{
    return sphere_n_make(&ball_n_ops, dim, 1);
}
