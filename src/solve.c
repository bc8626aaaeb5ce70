#include "guard.h"

#include "solve.h"

#include <math.h>

#include "elementary.h"

#define SOLVE_NEAR 0.03 /* a step that the series at a point spans, in units of its natural scale */

static double solve_size(const buffon_priv_place *at)
{
    return 1 + buffon_priv_abs(at->slope[0]) + sqrt(buffon_priv_abs(at->slope[1]));
}

/* The h up to which D has an integral of area D(t): the integral of exp of that of the slope, as a
 * series E with E' = slope E, and Newton's steps on it. What the series leaves out is
 * SOLVE_NEAR^9 / 400 at most. The loop over coefficients is written out, which halves its time. */
static double solve_near(const buffon_priv_place *at, double area)
{
    const double *s = at->slope;
    double e[SOLVE_ORDER + 1] = {1}, h = area / (1 + 0.5 * s[0] * area);
    e[1] = s[0];
    e[2] = (s[0] * e[1] + s[1]) * (1.0 / 2);
    e[3] = (s[0] * e[2] + s[1] * e[1] + s[2]) * (1.0 / 3);
    e[4] = (s[0] * e[3] + s[1] * e[2] + s[2] * e[1] + s[3]) * (1.0 / 4);
    e[5] = (s[0] * e[4] + s[1] * e[3] + s[2] * e[2] + s[3] * e[1] + s[4]) * (1.0 / 5);
    e[6] = (s[0] * e[5] + s[1] * e[4] + s[2] * e[3] + s[3] * e[2] + s[4] * e[1] + s[5]) * (1.0 / 6);
    e[7] =
        (s[0] * e[6] + s[1] * e[5] + s[2] * e[4] + s[3] * e[3] + s[4] * e[2] + s[5] * e[1] + s[6]) *
        (1.0 / 7);
    e[8] = (s[0] * e[7] + s[1] * e[6] + s[2] * e[5] + s[3] * e[4] + s[4] * e[3] + s[5] * e[2] +
            s[6] * e[1] + s[7]) *
           (1.0 / 8);
    for (int i = 0; i < 2; i++) {
        const double rise =
            1 +
            h * (e[1] +
                 h * (e[2] +
                      h * (e[3] + h * (e[4] + h * (e[5] + h * (e[6] + h * (e[7] + h * e[8])))))));
        const double sum =
            1 + h * (e[1] * (1.0 / 2) +
                     h * (e[2] * (1.0 / 3) +
                          h * (e[3] * (1.0 / 4) +
                               h * (e[4] * (1.0 / 5) +
                                    h * (e[5] * (1.0 / 6) +
                                         h * (e[6] * (1.0 / 7) +
                                              h * (e[7] * (1.0 / 8) + h * (e[8] * (1.0 / 9)))))))));
        h -= (h * sum - area) / rise;
    }
    return h;
}

/* Newton's step on log tail - log p is Halley's once it is divided by its bend, kept from
 * stretching it more than twofold. A tail is log-concave: Newton's own steps, from the ninth on,
 * reach a point short of the root and then rise to it. */
static double solve_far(const buffon_priv_place *at, double log_p, int upper, int i)
{
    const double excess = at->density + buffon_priv_log(at->ratio) - log_p;
    const double newton = excess * at->ratio / at->unit;
    const double slope = upper ? -at->slope[0] : at->slope[0];
    const double bend = 1 - 0.5 * (newton * slope - excess);
    const double step = i < 8 ? newton / (bend > 0.5 ? bend : 0.5) : newton;
    return upper ? step : -step;
}

double buffon_priv_solve(double t, double log_p, int upper, buffon_priv_law *law, const void *ctx)
{
    for (int i = 0; i < 100; i++) {
        buffon_priv_place at;
        double area;
        law(&at, t, upper, ctx);
        area = (buffon_priv_exp(log_p - at.density) - at.ratio) / at.unit;
        if (buffon_priv_abs(area) * solve_size(&at) < SOLVE_NEAR)
            return t + solve_near(&at, upper ? -area : area);
        t += solve_far(&at, log_p, upper, i);
    }
    return t;
}
