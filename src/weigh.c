#include "guard.h"

#include <math.h>

#include "elementary.h"
#include "weigh.h"

/* f / g where g itself has left the doubles but its log has not; NaN where there is no number. */
static double weigh_by_log(double f, size_t i, const buffon_priv_batch *batch)
{
    const buffon_density *g = batch->g;
    double log_pdf;
    if (g->ops->log_pdf == NULL)
        return NAN;
    for (size_t j = 0; j < g->dim; j++)
        batch->point[j] = batch->x[j * batch->n + i];
    if (g->ops->log_pdf(&log_pdf, batch->point, 1, g) != 0 ||
        !(log_pdf > -INFINITY && log_pdf < INFINITY))
        return NAN;
    const double size = buffon_priv_exp(buffon_priv_log(f < 0 ? -f : f) - log_pdf);
    return f < 0 ? -size : size;
}

int buffon_priv_ratio(double *y, double f, double pdf, size_t i, const buffon_priv_batch *batch)
{
    *y = f / pdf;
    if (pdf > 0x1p-1022 && pdf < INFINITY)
        return 0;
    *y = 0;
    if (!(pdf >= 0))
        return -1;
    if (f == 0 || f != f) {
        *y = f;
        return 0;
    }
    *y = weigh_by_log(f, i, batch);
    if (*y == *y)
        return 0;
    *y = f / pdf; /* a subnormal pdf is still one */
    return pdf > 0 && pdf < INFINITY ? 0 : -1;
}

#define KERNELS "weigh_lanes.h"
#include "levels.h"

buffon_status buffon_priv_weigh_ratio(double *y, size_t *bad, const buffon_priv_batch *batch,
                                      const buffon_priv_problem *problem)
{
    const buffon_integrand *f = problem->stratum[0].f;
    const size_t n = batch->n, components = f->components > 0 ? f->components : 1;
    size_t lowest = n;
    for (size_t k = 0; k < components; k++) {
        size_t i;
        LEVELS_RUN(weigh_divide, (&i, y + k * n, batch->f + k * n, batch->pdf, n));
        for (; i < n; i++) {
            const size_t at = k * n + i;
            if (buffon_priv_ratio(&y[at], batch->f[at], batch->pdf[i], i, batch) != 0 && i < lowest)
                lowest = i;
        }
    }
    *bad = lowest;
    return lowest < n ? BUFFON_E_PDF : BUFFON_OK;
}
