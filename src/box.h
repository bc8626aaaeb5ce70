/* Private. Boxes as the engine meets them. */
#ifndef BUFFON_SRC_BOX_H
#define BUFFON_SRC_BOX_H

#include <buffon/box.h>

/* Whether g is a box. Its points may be drawn over their uniforms: x == u. */
int buffon_priv_box_is(const buffon_density *g);

/* The volume, which no dimension leads out of range: m 2^e with m in [1/2, 1), within dim ulp.
 * Bounds as buffon_box takes them. */
void buffon_priv_box_volume(double *m, int *e, const double *lo, const double *hi, size_t dim);

#endif
