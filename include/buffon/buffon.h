/* buffon: Monte Carlo integration and sampling. This header includes all the others.
 *
 *     layer 0  api  version  status  cpu
 *     layer 1  math  rng  stats  estimate  interval  integrand  points  sobol  partial
 *     layer 2  density
 *     layer 2  box  disk  sphere  cap  cap_cosine  hemisphere  directional
 *     layer 2  ball  cylinder  sphere_n  simplex  parallelogram  spherical  rotation
 *     layer 2  inversion  exponential  normal  laws  gamma  beta  student  counts
 *     layer 2  table  alias  piecewise  bilinear  environment  inverse_table
 *     layer 2  mixture  truncated  affine
 *     layer 2  verify_density
 *     layer 3  run  uniform  rejection  importance  inverse_cdf  stratified
 *
 * Includes point down, or to the left within a row.
 */
#ifndef BUFFON_BUFFON_H
#define BUFFON_BUFFON_H

#include "affine.h"
#include "alias.h"
#include "api.h"
#include "ball.h"
#include "beta.h"
#include "bilinear.h"
#include "box.h"
#include "cap.h"
#include "cap_cosine.h"
#include "counts.h"
#include "cpu.h"
#include "cylinder.h"
#include "density.h"
#include "directional.h"
#include "disk.h"
#include "environment.h"
#include "estimate.h"
#include "exponential.h"
#include "gamma.h"
#include "hemisphere.h"
#include "importance.h"
#include "integrand.h"
#include "interval.h"
#include "inverse_cdf.h"
#include "inverse_table.h"
#include "inversion.h"
#include "laws.h"
#include "math.h"
#include "mixture.h"
#include "normal.h"
#include "parallelogram.h"
#include "partial.h"
#include "piecewise.h"
#include "points.h"
#include "rejection.h"
#include "rng.h"
#include "rotation.h"
#include "run.h"
#include "simplex.h"
#include "sobol.h"
#include "sphere.h"
#include "sphere_n.h"
#include "spherical.h"
#include "stats.h"
#include "status.h"
#include "stratified.h"
#include "student.h"
#include "table.h"
#include "truncated.h"
#include "uniform.h"
#include "verify_density.h"
#include "version.h"

#endif
