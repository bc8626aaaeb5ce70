/* For tests of laws on the line: what a law says of a uniform, its errors, what it refuses. */
#ifndef TESTS_LINE_H
#define TESTS_LINE_H

#include <float.h>
#include <math.h>

#include <buffon/density.h>

#include "one.h"
#include "ulps.h"

/* A point and the pdf that comes with it. */
typedef struct line_point {
    double x, pdf;
} line_point;

static inline line_point line_draw(const buffon_density *g, double u)
{
    line_point at = {(double)NAN, (double)NAN};
    if (buffon_density_sample(&at.x, &at.pdf, &u, 1, g) != BUFFON_OK)
        at.x = at.pdf = (double)NAN;
    return at;
}

/* The worst errors of a point, of the pdf that came with it, of that at a given x and its
 * logarithm, and of u of x. */
typedef struct line_errors {
    ulps_worst x, drawn, given, log_given, u;
} line_errors;

/* The level that invert can return nearest to the exact one. */
static inline wide line_inside(wide u)
{
    return u < 0x1p-1074L ? 0x1p-1074L : u > 1 - 0x1p-53L ? 1 - 0x1p-53L : u;
}

static inline int line_refuses(buffon_density g, buffon_status status)
{
    double x = 1, y = 1, u = 0.5;
    return g.status == status && buffon_density_sample(&x, &y, &u, 1, &g) == status && x != x &&
           y != y;
}

/* pdf and its logarithm at points that no law holds, and what it must be at one that it does. */
static inline int line_special(buffon_density g, const double *none, size_t count, double at,
                               double exact)
{
    int good = g.status == BUFFON_OK;
    for (size_t k = 0; k < count; k++)
        good &= one_pdf(&g, none[k]) == 0 && one_log_pdf(&g, none[k]) == -INFINITY;
    good &= fabs(one_pdf(&g, at) - exact) <= 1e-15 * exact;
    good &= fabs(one_log_pdf(&g, at) - log(exact)) <= 2e-15 * (1 + fabs(log(exact)));
    return good;
}

/* Whether g is finite, and that of the point, at points of the smallest uniforms. */
static inline int line_least_points(buffon_density g)
{
    static const double u[] = {0x1p-1074, 1e-300, 1e-200};
    int good = g.status == BUFFON_OK;
    for (int i = 0; i < 3; i++) {
        const line_point at = line_draw(&g, u[i]);
        good &= at.x > 0 && at.pdf <= DBL_MAX && (at.x >= DBL_MIN || at.pdf == one_pdf(&g, at.x));
    }
    return good;
}

/* Whether points of uniforms next to 0 and 1 are inside the bounds, however coarse doubles are
 * there. */
static inline int line_strictly_inside(buffon_density g, double lo, double hi)
{
    static const double u[] = {0x1p-1074, 0x1p-53, 1 - 0x1p-53};
    int good = g.status == BUFFON_OK;
    for (int i = 0; i < 3; i++) {
        const double x = one_x(&g, u[i]);
        good &= x > lo && x < hi;
    }
    return good;
}

#endif
