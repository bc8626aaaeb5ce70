#include "guard.h"

#include <buffon/run.h>

#include "engine.h"

buffon_status buffon_sample_at(double *x, const buffon_density *g, uint64_t index,
                               const buffon_run *run)
{
    return buffon_priv_engine_point(x, g, 0, index, run);
}
