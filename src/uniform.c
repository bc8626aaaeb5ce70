#include "guard.h"

#include <buffon/box.h>
#include <buffon/uniform.h>

#include "box.h"
#include "engine.h"

buffon_status buffon_uniform(buffon_estimate *out, const buffon_integrand *f, const double *lo,
                             const double *hi, const buffon_run *run)
{
    const buffon_density box = buffon_box(lo, hi, f != NULL ? f->dim : 1);
    const buffon_priv_stratum stratum = {.g = &box, .f = f, .weight = 1, .share = 1};
    buffon_priv_problem problem = {
        .name = "buffon.uniform", .stratum = &stratum, .strata = 1, .scale_m = 1};
    /* The volume multiplies the mean at the end: there it can neither overflow nor cost a rounding
     * of each value. */
    if (box.status == BUFFON_OK)
        buffon_priv_box_volume(&problem.scale_m, &problem.scale_e, lo, hi, box.dim);
    return buffon_priv_engine_run(out, &problem, run);
}
