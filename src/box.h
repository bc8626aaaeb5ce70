/* Private. Volumes of boxes that no dimension leads out of range. */
#ifndef BUFFON_SRC_BOX_H
#define BUFFON_SRC_BOX_H

#include <stddef.h>

/* volume = m 2^e with m in [1/2, 1), within dim ulp. Bounds as buffon_box takes them. */
void buffon_priv_box_volume(double *m, int *e, const double *lo, const double *hi, size_t dim);

#endif
