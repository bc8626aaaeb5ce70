#include "guard.h"

#include <math.h>

#include "circle.h"
#include "density_priv.h"
#include "elementary.h"

void buffon_priv_circle(double *c, double *s, const double *t, size_t n)
{
    for (size_t i = 0; i < n; i++)
        buffon_priv_sincospi(&s[i], &c[i], 2 * t[i]);
}

double buffon_priv_circle_invert(double x, double y)
{
    const double t = 0.5 * buffon_priv_atan2pi(y, x);
    return density_open(t < 0 ? t + 1 : t);
}

/* With the larger of |a|, |b| as the radius the angle from its axis is (pi/4) small / big, an
 * eighth of a turn at most. The branches of the four triangles become two choices: which is big,
 * and which of sine and cosine goes with which coordinate. The rows of the output hold the angles
 * meanwhile. */
void buffon_priv_concentric(double *restrict x, double *restrict y, const double *restrict u1,
                            const double *restrict u2, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const double a = 2 * u1[i] - 1, b = 2 * u2[i] - 1;
        const int flat = buffon_priv_abs(a) > buffon_priv_abs(b);
        const double big = flat ? a : b, small = flat ? b : a;
        y[i] = big != 0 ? 0.125 * (small / big) : 0;
    }
    buffon_priv_circle(x, y, y, n);
    for (size_t i = 0; i < n; i++) {
        const double a = 2 * u1[i] - 1, b = 2 * u2[i] - 1;
        const int flat = buffon_priv_abs(a) > buffon_priv_abs(b);
        const double big = flat ? a : b, c = x[i], s = y[i];
        const double r = big > CIRCLE_RIM ? CIRCLE_RIM : big < -CIRCLE_RIM ? -CIRCLE_RIM : big;
        x[i] = r * (flat ? c : s);
        y[i] = r * (flat ? s : c);
    }
}

void buffon_priv_concentric_invert(double u[2], double x, double y)
{
    const double ax = buffon_priv_abs(x), ay = buffon_priv_abs(y);
    const int flat = ax >= ay;
    const double r = sqrt(x * x + y * y);
    const double t = 4 * buffon_priv_atan2pi(flat ? ay : ax, flat ? ax : ay);
    u[0] = density_open(0.5 + 0.5 * buffon_priv_copysign(flat ? r : r * t, x));
    u[1] = density_open(0.5 + 0.5 * buffon_priv_copysign(flat ? r * t : r, y));
}
