/* Layer 2. Directions by an image of the sky: light that comes from all around. */
#ifndef BUFFON_ENVIRONMENT_H
#define BUFFON_ENVIRONMENT_H

#include "api.h"
#include "density.h"
#include "status.h"
#include "table.h"

BUFFON_BEGIN

/** The bytes of a table for buffon_environment and buffon_environment_float.
 *
 *  In:      width, height  of the image; 1 to 2^31 - 1; SIZE_MAX is returned for others
 *  Cost:    12 to 16 bytes a pixel: 24 MiB for 2048 x 1024
 *  Since:   0.1
 */
BUFFON_API size_t buffon_environment_size(size_t width, size_t height);

/** Directions by the luminance of an image in longitude and latitude, constant within each pixel.
 *
 *  Pixel (c, r) is the part of the unit sphere with 2 pi c / width <= longitude < 2 pi (c + 1) /
 *  width, from +x over +y, and pi r / height <= angle from +z < pi (r + 1) / height: the first row
 *  is about +z, the last about -z. Within a pixel directions are uniform by solid angle, which in a
 *  row means a uniform z. So neither the sine of the angle nor the middle of a pixel stands for
 *  anything, and the poles are as good as any other place.
 *
 *  Out:     memory  the table: `size` bytes, at least buffon_environment_size(width, height),
 *                   aligned as malloc's memory is; must outlive the density; must not overlap the
 *                   image
 *  In:      luminance[width * height]  pixel (c, r) at [r * width + c]; finite, >= 0, not all 0; in
 *                                      any unit. With colours: their mean, or largest
 *  Law:     g = luminance / (integral of it over the sphere), by solid angle; the row is found from
 *           u2, the pixel in it from u1, both by inversion, so that stratified points keep their
 *           order. g is that of the law as it is drawn, by whole numbers of 2^-62 of the row and of
 *           the whole: a pixel with less than 2^-63 of its row counts as black. Directions keep off
 *           the sides of their pixel, by 2^-49 of a turn and by 2^-48 of the height from the nearer
 *           pole, so that a direction has the g of the pixel it was drawn from
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_DIM (width, height), BUFFON_E_NULL,
 *           BUFFON_E_SIZE (the memory), BUFFON_E_SHAPE (the luminances)
 *  Exact:   F is u, for each of them, within 2^-48 and what 2^-48 of a turn or of a height are
 *           worth; heights near a pole within 2^-47 of themselves; |x|^2 within 2^-50 of 1; g
 *           within 6 ulp and what half a unit is of the row in the whole and of the pixel in its
 *           row (tests/test_tables.c)
 *  Cost:    some 70 ns a pixel to make
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_environment(void *memory, size_t size, const double *luminance,
                                             size_t width, size_t height);

/** The same from an image of floats: the same table as from its values as doubles.
 *
 *  Out, In, Returns: as buffon_environment
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_environment_float(void *memory, size_t size,
                                                   const float *luminance, size_t width,
                                                   size_t height);

BUFFON_END

#endif
