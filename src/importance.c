#include "guard.h"

#include <buffon/importance.h>

#include "engine.h"
#include "weigh.h"

buffon_status buffon_importance(buffon_estimate *out, const buffon_integrand *f,
                                const buffon_density *g, const buffon_run *run)
{
    const buffon_priv_stratum stratum = {.g = g, .f = f, .weight = 1, .share = 1};
    const buffon_priv_problem problem = {.name = "buffon.importance",
                                         .stratum = &stratum,
                                         .strata = 1,
                                         .pdf = 1,
                                         .scale_m = 1,
                                         .weigh = buffon_priv_weigh_ratio};
    return buffon_priv_engine_run(out, &problem, run);
}

buffon_status buffon_expectation(buffon_estimate *out, const buffon_integrand *h,
                                 const buffon_density *g, const buffon_run *run)
{
    const buffon_priv_stratum stratum = {.g = g, .f = h, .weight = 1, .share = 1};
    const buffon_priv_problem problem = {
        .name = "buffon.expectation", .stratum = &stratum, .strata = 1, .scale_m = 1};
    return buffon_priv_engine_run(out, &problem, run);
}

/* Outputs w h_k, then w, where w = p / g. */
static buffon_status importance_weigh_ratio(double *y, size_t *bad, const buffon_priv_batch *batch,
                                            const buffon_priv_problem *problem)
{
    const buffon_integrand *h = problem->stratum[0].f;
    const size_t n = batch->n, components = h->components > 0 ? h->components : 1;
    double *w = y + components * n;
    for (size_t i = 0; i < n; i++) {
        *bad = i;
        if (batch->p[i] < 0)
            return BUFFON_E_BOUND;
        if (buffon_priv_ratio(&w[i], batch->p[i], batch->pdf[i], i, batch) != 0)
            return BUFFON_E_PDF;
        for (size_t k = 0; k < components; k++)
            y[k * n + i] = w[i] != 0 ? w[i] * batch->f[k * n + i] : 0;
    }
    return BUFFON_OK;
}

buffon_status buffon_self_normalised(buffon_estimate *out, const buffon_integrand *h,
                                     const buffon_integrand *p, const buffon_density *g,
                                     const buffon_run *run)
{
    const buffon_priv_stratum stratum = {.g = g, .f = h, .weight = 1, .share = 1};
    const buffon_priv_problem problem = {.name = "buffon.self_normalised",
                                         .stratum = &stratum,
                                         .strata = 1,
                                         .p = p,
                                         .pdf = 1,
                                         .kind = BUFFON_PRIV_RATIO,
                                         .scale_m = 1,
                                         .weigh = importance_weigh_ratio};
    if (p == NULL)
        return buffon_priv_refuse(out, h, BUFFON_E_NULL);
    return buffon_priv_engine_run(out, &problem, run);
}
