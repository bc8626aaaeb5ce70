#include "guard.h"

#include "stats_priv.h"

#include <math.h>

#include "elementary.h"

/* Excesses x over a threshold follow a generalised Pareto law, P(X > x) = (1 - theta x)^(-1/k) with
 * theta = -k / sigma. For a given theta the likelihood is greatest at k = mean log(1 - theta x).
 * Zhang and Stephens average theta over a grid, each weighted by its likelihood at that k. Dividing
 * the excesses by the largest leaves k as it is. */
enum {
    TAIL_COUNT = 320, /* so that the 64 largest are a fifth of the values at most */
    TAIL_FEWEST = 32, /* excesses that a fit needs */
    TAIL_GRID = 37    /* 30 + sqrt(63), as in the paper's advice */
};

static double tail_shape(const double *x, int n, double theta)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += buffon_priv_log1p(-theta * x[i]);
    return sum / n;
}

/* The average of theta. x falls from 1 */
static double tail_theta(const double *x, int n)
{
    double theta[TAIL_GRID], likelihood[TAIL_GRID], best = -INFINITY, sum = 0.0, weights = 0.0;
    double quartile = x[n - (n + 2) / 4];
    if (quartile < 0x1p-900) /* keeps theta finite; k is large either way */
        quartile = 0x1p-900;
    for (int j = 0; j < TAIL_GRID; j++) {
        theta[j] = 1.0 + (1.0 - sqrt(TAIL_GRID / (j + 0.5))) / (3.0 * quartile);
        if (theta[j] == 0.0) /* the exponential law, by its neighbour */
            theta[j] = 0x1p-60;
        double k = tail_shape(x, n, theta[j]);
        likelihood[j] = n * (buffon_priv_log(-theta[j] / k) - k - 1.0);
        best = likelihood[j] > best ? likelihood[j] : best;
    }
    for (int j = 0; j < TAIL_GRID; j++) {
        double weight = buffon_priv_exp(likelihood[j] - best);
        weights += weight;
        sum += weight * theta[j];
    }
    return sum / weights;
}

double buffon_priv_tail_index(const double *top, uint64_t count)
{
    double x[BUFFON_STATS_TOP], threshold = top[BUFFON_STATS_TOP - 1];
    int n = 0;
    while (n < BUFFON_STATS_TOP && top[n] > threshold) {
        x[n] = (top[n] - threshold) / (top[0] - threshold);
        n++;
    }
    if (count < TAIL_COUNT || n < TAIL_FEWEST)
        return NAN;
    double k = tail_shape(x, n, tail_theta(x, n));
    /* Vehtari et al.: as if ten more excesses had said 1/2, which steadies a small sample. */
    return (n * k + 5.0) / (n + 10.0);
}
