/* Private. Orthonormal frames: three unit vectors t, b, n in nine numbers, n the axis. */
#ifndef BUFFON_SRC_FRAME_H
#define BUFFON_SRC_FRAME_H

#include <math.h>
#include <stddef.h>

#include "elementary.h"

#define FRAME_SIZE 9

/* n = v / |v| for finite v of any size; returns |v|, or 0 where there is no direction. Squares of
 * very large and very small vectors are kept in range by exact powers of two. */
static inline double frame_unit(double n[3], const double v[3])
{
    const double ax = buffon_priv_abs(v[0]), ay = buffon_priv_abs(v[1]);
    const double az = buffon_priv_abs(v[2]);
    const double most = ax > ay ? (ax > az ? ax : az) : (ay > az ? ay : az);
    const double up = most > 0x1p+400 ? 0x1p-600 : most < 0x1p-400 ? 0x1p+600 : 1;
    const double down = most > 0x1p+400 ? 0x1p+600 : most < 0x1p-400 ? 0x1p-600 : 1;
    const double x = v[0] * up, y = v[1] * up, z = v[2] * up;
    const double length = sqrt(x * x + y * y + z * z);
    if (!(length > 0) || !buffon_priv_isfinite(length))
        return 0;
    n[0] = x / length;
    n[1] = y / length;
    n[2] = z / length;
    return length * down;
}

/* The frame of a unit vector by T. Duff et al. (2017): one branch, no cancellation for any n. */
static inline void frame_make(double f[FRAME_SIZE], const double n[3])
{
    const double sign = n[2] < 0 ? -1 : 1;
    const double a = -1 / (sign + n[2]);
    const double b = n[0] * n[1] * a;
    f[0] = 1 + sign * n[0] * n[0] * a;
    f[1] = sign * b;
    f[2] = -sign * n[0];
    f[3] = b;
    f[4] = sign + n[1] * n[1] * a;
    f[5] = -n[1];
    f[6] = n[0];
    f[7] = n[1];
    f[8] = n[2];
}

/* Whether the axis is +z, so that nothing needs to be turned. */
static inline int frame_is_upright(const double f[FRAME_SIZE])
{
    return f[6] == 0 && f[7] == 0 && f[8] == 1;
}

/* Whether a vector passes for a unit vector: directions rounded to float do. */
static inline int frame_is_unit(double x, double y, double z)
{
    return buffon_priv_abs(x * x + y * y + z * z - 1) <= 0x1p-20;
}

/* The coordinates t and b of d - n: those of d itself, but for the digits that d . t would lose to
 * cancellation where d is near n. */
static inline void frame_across(double out[2], const double f[FRAME_SIZE], double x, double y,
                                double z)
{
    const double dx = x - f[6], dy = y - f[7], dz = z - f[8];
    out[0] = dx * f[0] + dy * f[1] + dz * f[2];
    out[1] = dx * f[3] + dy * f[4] + dz * f[5];
}

#endif
