/* buffon: Monte Carlo integration and sampling. This header includes all the others.
 *
 *     layer 0  api  version  status  cpu
 *     layer 1  math  rng  stats  estimate  interval  integrand  points  sobol  partial
 *     layer 2  density  box  disk  sphere  cap  hemisphere  directional
 *     layer 2  inversion  exponential  normal
 *     layer 2  laws
 *     layer 2  mixture  truncated  affine
 *     layer 2  verify_density
 *     layer 3  run  uniform  rejection  importance  inverse_cdf  stratified
 *
 * Includes point down, or to the left within a row.
 */
#ifndef BUFFON_BUFFON_H
#define BUFFON_BUFFON_H

#include "affine.h"
#include "api.h"
#include "box.h"
#include "cap.h"
#include "cpu.h"
#include "density.h"
#include "directional.h"
#include "disk.h"
#include "estimate.h"
#include "exponential.h"
#include "hemisphere.h"
#include "importance.h"
#include "integrand.h"
#include "interval.h"
#include "inverse_cdf.h"
#include "inversion.h"
#include "laws.h"
#include "math.h"
#include "mixture.h"
#include "normal.h"
#include "partial.h"
#include "points.h"
#include "rejection.h"
#include "rng.h"
#include "run.h"
#include "sobol.h"
#include "sphere.h"
#include "stats.h"
#include "status.h"
#include "stratified.h"
#include "truncated.h"
#include "uniform.h"
#include "verify_density.h"
#include "version.h"

#endif
