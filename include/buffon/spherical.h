/* Layer 2. Directions in which a triangle, a rectangle or a convex polygon is seen from a point,
 * uniform by solid angle, and the solid angles themselves: light sources, windows, detectors.
 *
 * Where the piece is small or far off its solid angle and the place of a point on it keep their
 * digits; a direction, whose coordinates are near 1, knows it only to 2^-50 of the distance.
 *
 * All coordinates are finite; distances from the observer are up to 2^1000, and the farthest corner
 * is 2^-900 off or more. Sizes below 1e-100 of the distance lose digits.
 */
#ifndef BUFFON_SPHERICAL_H
#define BUFFON_SPHERICAL_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** The solid angle under which a triangle is seen.
 *
 *  In:      from[3]           the observer
 *           a[3], b[3], c[3]  the corners, in any order
 *  Returns: 0 to 2 pi; in the plane of the triangle 0, inside of it 2 pi; NaN for what is NULL, not
 *           finite, or outside the range above
 *  Exact:   4 ulp, at any distance, nearly in the plane of the triangle too
 *           (tests/test_spherical.c)
 *  Source:  A. van Oosterom, J. Strackee (1983), The solid angle of a plane triangle
 *  Since:   0.1
 */
BUFFON_API double buffon_solid_angle_triangle(const double from[3], const double a[3],
                                              const double b[3], const double c[3]);

/** The solid angle under which a parallelogram is seen: a rectangle, for one.
 *
 *  In:      from[3]                         the observer
 *           corner[3], edge1[3], edge2[3]   corner, and from it to its neighbours
 *  Returns, Exact: as buffon_solid_angle_triangle
 *  Since:   0.1
 */
BUFFON_API double buffon_solid_angle_parallelogram(const double from[3], const double corner[3],
                                                   const double edge1[3], const double edge2[3]);

/** The directions in which a triangle is seen from a point.
 *
 *  In:      from[3]           the observer, not in the plane of the triangle
 *           a[3], b[3], c[3]  the corners
 *  Law:     with C on the edge from a to c such that the triangle a b C has the part u1 of the
 *           solid angle, x is between b (u2 = 0) and C (u2 = 1), with 1 - x . b uniform.
 *           g = 1 / solid angle for unit vectors that meet the triangle, 0 for others and where
 *           |x|^2 is further than 2^-20 from 1. Edges count as inside, with 2^-48 to spare for
 *           rounding
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL, or BUFFON_E_SHAPE: also where the
 *           solid angle is 0, or its inverse exceeds the doubles
 *  Exact:   g within 4 ulp; |x| within 2^-50 of 1, and x within 2^-48 of the true direction; the
 *           place on the triangle as buffon_spherical_triangle_weights (tests/test_spherical.c)
 *  Source:  J. Arvo (1995), Stratified sampling of spherical triangles; rearranged
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_spherical_triangle(const double from[3], const double a[3],
                                                    const double b[3], const double c[3]);

/** Where on the triangle a direction of buffon_spherical_triangle meets it: the point is
 *  w[0] a + w[1] b + w[2] c.
 *
 *  Out:     w[3]    positive, with sum 1; NaN where the density is refused
 *  In:      u1, u2  in (0, 1), those of the direction
 *           from[3], a[3], b[3], c[3]  as buffon_spherical_triangle
 *  Exact:   4e-16, for distances of 0.1 to 1e6 sizes, where the plane is seen under an angle with
 *           sine 0.01 or more (tests/test_spherical.c)
 *  Since:   0.1
 */
BUFFON_API void buffon_spherical_triangle_weights(double w[3], double u1, double u2,
                                                  const double from[3], const double a[3],
                                                  const double b[3], const double c[3]);

/** The directions in which a rectangle is seen from a point.
 *
 *  In:      from[3]                        the observer, not in the plane of the rectangle
 *           corner[3], edge1[3], edge2[3]  corner, and from it to its neighbours; edges are
 *                                          perpendicular: the cosine between them is within 2^-44
 *  Law:     u1 moves along edge1, such that the strip up to there has the part u1 of the solid
 *           angle; u2 along edge2, on the line that u1 left. g = 1 / solid angle for unit vectors
 *           that meet the rectangle, 0 for others, with the same to spare as
 *           buffon_spherical_triangle
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL, or BUFFON_E_SHAPE: also where the
 *           solid angle is 0, or its inverse exceeds the doubles
 *  Exact:   g within 4 ulp; |x| within 2^-50 of 1, and x within 2^-48 of the true direction; the
 *           place on the rectangle as buffon_spherical_rectangle_along (tests/test_spherical.c)
 *  Source:  C. Urena, M. Fajardo, A. King (2013), An area-preserving parametrization for spherical
 *           rectangles; rearranged
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_spherical_rectangle(const double from[3], const double corner[3],
                                                     const double edge1[3],
                                                     const double edge2[3]);

/** Where on the rectangle a direction of buffon_spherical_rectangle meets it: the point is
 *  corner + st[0] edge1 + st[1] edge2.
 *
 *  Out:     st[2]   in [0, 1]; NaN where the density is refused
 *  In:      u1, u2  in (0, 1), those of the direction
 *           from[3], corner[3], edge1[3], edge2[3]  as buffon_spherical_rectangle
 *  Exact:   2e-15 of u1 and u2, for distances of 0.1 to 1e6 sizes; 2e-14 where the plane is seen
 *           under an angle with a sine of 0.01 (tests/test_spherical.c)
 *  Since:   0.1
 */
BUFFON_API void buffon_spherical_rectangle_along(double st[2], double u1, double u2,
                                                 const double from[3], const double corner[3],
                                                 const double edge1[3], const double edge2[3]);

/** The directions in which a convex polygon is seen from a point.
 *
 *  In:      from[3]          the observer, not in the plane of the polygon
 *           corner[3*count]  corner k is corner[3*k] to corner[3*k + 2], in order round it;
 *                            must outlive the density
 *           count            3 to 16; no three corners in line
 *  Law:     a fan of triangles about corner 0: u1 moves by solid angle round the sides that do not
 *           meet there, from corner 1 to the last; u2 from corner 0 to the side, as in
 *           buffon_spherical_triangle. g likewise. Corners need not lie in one plane, as long as
 *           the polygon is convex as seen
 *  Draws:   2
 *  Returns: a density of 3 coordinates; it carries BUFFON_E_NULL, BUFFON_E_DIM (count), or
 *           BUFFON_E_SHAPE: also where the polygon is not convex, or the solid angle of one of its
 *           triangles is 0
 *  Exact:   g within 6 ulp (tests/test_spherical.c)
 *  Cost:    a batch starts with count - 2 triangles, half a microsecond each; points one by one
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_spherical_polygon(const double from[3], const double *corner,
                                                   size_t count);

BUFFON_END

#endif
