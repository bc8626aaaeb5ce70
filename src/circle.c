#include "guard.h"

#include <math.h>

#include "circle.h"
#include "density_priv.h"
#include "elementary.h"

double buffon_priv_circle_invert(double x, double y)
{
    const double t = 0.5 * buffon_priv_atan2pi(y, x);
    return density_open(t < 0 ? t + 1 : t);
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
