#include "guard.h"

#include <math.h>

#include <buffon/math.h>
#include <buffon/rotation.h>

#include "circle.h"
#include "density_priv.h"
#include "elementary.h"

/* 1 / pi^2 */
#define ROTATION_DENSITY 0x1.9f02f6222c720p-4

/* Angles are written where their sines and cosines will be. */
static int rotation_draw(double *q, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    double *w = q, *x = q + n, *y = q + 2 * n, *z = q + 3 * n;
    (void)g;
    for (size_t i = 0; i < n; i++)
        x[i] = 2 * u[n + i];
    buffon_math_sincospi(y, x, x, n);
    buffon_math_sincospi(w, z, u + 2 * n, n);
    for (size_t i = 0; i < n; i++) {
        const double a = sqrt(1 - u[i]), b = sqrt(u[i]);
        w[i] *= b;
        x[i] *= a;
        y[i] *= a;
        z[i] *= b;
    }
    if (pdf)
        density_fill(pdf, ROTATION_DENSITY, n);
    return 0;
}

static int rotation_pdf(double *pdf, const double *q, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++) {
        const double w = q[i], x = q[n + i], y = q[2 * n + i], z = q[3 * n + i];
        const double square = w * w + x * x + y * y + z * z;
        const int in = (w >= 0) & (buffon_priv_abs(square - 1) <= 0x1p-20);
        pdf[i] = in ? ROTATION_DENSITY : 0;
    }
    return 0;
}

/* u1 is the square of the part (w, z), and 1 - u1 that of (x, y): the smaller keeps its digits. */
static int rotation_unmap(double *u, const double *q, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++) {
        const double w = q[i], x = q[n + i], y = q[2 * n + i], z = q[3 * n + i];
        const double b = w * w + z * z, a = x * x + y * y;
        u[i] = density_open(b < a ? b : 1 - a);
        u[n + i] = buffon_priv_circle_invert(x, y);
        u[2 * n + i] = density_open(buffon_priv_atan2pi(w, z));
    }
    return 0;
}

static const buffon_density_ops rotation_ops = {.sample = rotation_draw,
                                                .pdf = rotation_pdf,
                                                .invert = rotation_unmap,
                                                .name = "buffon.rotation"};

buffon_density buffon_rotation(void)
{
    return (buffon_density){.uniforms = 3, .dim = 4, .ops = &rotation_ops};
}

/* With v = (x, y, z) the vector p goes to p + 2 (w v x p + v x (v x p)) / |q|^2. */
void buffon_rotation_apply(double out[3], const double p[3], const double q[4])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double scale = 2 / (w * w + x * x + y * y + z * z);
    const double a = p[0], b = p[1], c = p[2];
    const double s = y * c - z * b, t = z * a - x * c, r = x * b - y * a;
    out[0] = a + scale * (w * s + (y * r - z * t));
    out[1] = b + scale * (w * t + (z * s - x * r));
    out[2] = c + scale * (w * r + (x * t - y * s));
}

void buffon_rotation_matrix(double m[9], const double q[4])
{
    for (size_t j = 0; j < 3; j++) {
        const double axis[3] = {j == 0, j == 1, j == 2};
        double column[3];
        buffon_rotation_apply(column, axis, q);
        for (size_t i = 0; i < 3; i++)
            m[3 * i + j] = column[i];
    }
}
