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
 * SOLVE_NEAR^9 / 400 at most. */
static double solve_near(const buffon_priv_place *at, double area)
{
    double e[SOLVE_ORDER + 1] = {1}, h = area / (1 + 0.5 * at->slope[0] * area);
    for (int k = 0; k < SOLVE_ORDER; k++) {
        double sum = 0;
        for (int j = 0; j <= k; j++)
            sum += at->slope[j] * e[k - j];
        e[k + 1] = sum / (k + 1);
    }
    for (int i = 0; i < 2; i++) {
        double sum = 0, rise = 0;
        for (int k = SOLVE_ORDER; k >= 0; k--) {
            rise = e[k] + h * rise;
            sum = e[k] * (1.0 / (k + 1)) + h * sum;
        }
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
    const double newton = excess * at->ratio;
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
        area = buffon_priv_exp(log_p - at.density) - at.ratio;
        if (buffon_priv_abs(area) * solve_size(&at) < SOLVE_NEAR)
            return t + solve_near(&at, upper ? -area : area);
        t += solve_far(&at, log_p, upper, i);
    }
    return t;
}
