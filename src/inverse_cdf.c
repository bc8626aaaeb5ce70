#include "guard.h"

#include <buffon/importance.h>
#include <buffon/inverse_cdf.h>

buffon_status buffon_inverse_cdf(buffon_estimate *out, const buffon_integrand *f,
                                 const buffon_inversion *how, const buffon_run *run)
{
    const buffon_density g = buffon_inverse(how);
    return buffon_importance(out, f, &g, run);
}
