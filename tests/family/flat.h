/* The table of all densities (family.h): flat pieces, spherical polygons, rotations. */
#ifndef TESTS_FAMILY_FLAT_H
#define TESTS_FAMILY_FLAT_H

#include "../family.h"

/* Held against a larger piece of the same line or plane. */
static void family_within(family_case *added, const buffon_density *over)
{
    added->how.over = over;
}

/* So thin or far off that the way back and the stretch say little: rounding moves points by more
 * than the map does. */
static void family_unseen(const char *name, buffon_density g)
{
    family_add(name, g)->unseen = 1;
}

static void family_pieces(void)
{
    static const double o[3] = {0.5, -1, 2}, a[3] = {1, 2, -0.5}, b[3] = {-2, 0.25, 1};
    static const double c[3] = {0.1, 0.2, 3}, far[3] = {1e6, 1e6 + 1e-3, -1e6};
    static const double beyond[3] = {1e6 + 1e-3, 1e6, -1e6}, tip[3] = {1e6, 1e6, 1e-3 - 1e6};
    static const double e1[3] = {2, 0, 1}, e2[3] = {0, 1e-7, 0}, e3[3] = {-2, 1, -1.01};
    static const double ab[3] = {0.5, 3, -2.5}, ob[3] = {-2.5, 1.25, -1}, oc[3] = {-0.4, 1.2, 1};
    static const double end[3] = {4, 3.75, -2}, wide[3] = {1, 6, -5}, broad[3] = {-5, 2.5, -2};
    static const double start[3] = {0.5625, -1.1328125, 2.109375}; /* o - (wide + broad) / 64 */
    static const double zero[5] = {0}, one[5] = {1, 1, 1, 1, 1};
    static buffon_density line, plane, box, cube[6];
    line = buffon_segment_between(end, b);
    plane = buffon_parallelogram(start, wide, broad);
    box = buffon_parallelepiped(o, ab, ob, oc);
    for (size_t dim = 3; dim <= 5; dim++)
        cube[dim] = buffon_box(zero, one, dim);
    family_within(family_plain("segment in space", buffon_segment_between(a, b)), &line);
    family_unseen("segment in space, short and far", buffon_segment_between(far, tip));
    family_within(family_plain("triangle", buffon_triangle(o, a, b)), &plane);
    family_plain("triangle, flat", buffon_triangle_flat(o, a, b));
    family_unseen("triangle, small and far", buffon_triangle(far, beyond, tip));
    family_within(family_plain("tetrahedron", buffon_tetrahedron(o, a, b, c)), &box);
    family_within(family_plain("parallelogram", buffon_parallelogram(o, ab, ob)), &plane);
    family_unseen("parallelogram, a strip", buffon_parallelogram(far, e1, e2));
    family_plain("parallelepiped", buffon_parallelepiped(o, e1, a, c));
    family_unseen("parallelepiped, flat", buffon_parallelepiped(o, e1, a, e3));
    family_add("simplex 1", buffon_simplex(1));
    family_plain("simplex 2", buffon_simplex(2));
    family_within(family_plain("simplex 3", buffon_simplex(3)), &cube[3]);
    family_within(family_plain("simplex 5", buffon_simplex(5)), &cube[5]);
    family_unseen("simplex 16", buffon_simplex(16));
}

static void family_spherical(void)
{
    static const double o[3] = {0.5, -1, 2}, a[3] = {1, 2, -0.5}, b[3] = {-2, 0.25, 1};
    static const double c[3] = {0.1, 0.2, 3}, e1[3] = {2, 0, 1}, e2[3] = {-0.5, 3, 1};
    static const double across[3] = {1, -3, -2}, far[3] = {40, -30, 20}, above[3] = {0.6, 0.5, 0};
    family_plain("spherical triangle", buffon_spherical_triangle(o, a, b, c));
    family_add("spherical triangle, large", buffon_spherical_triangle(above, a, b, c));
    family_add("spherical triangle, 30 sizes away", buffon_spherical_triangle(far, a, b, c));
    family_plain("spherical rectangle", buffon_spherical_rectangle(o, a, e1, across));
    family_add("spherical rectangle, aside", buffon_spherical_rectangle(o, e2, e1, across));
    family_add("spherical rectangle, mirrored", buffon_spherical_rectangle(o, b, e1, across));
    family_add("spherical rectangle, far", buffon_spherical_rectangle(far, a, e1, across));
    static const double pentagon[15] = {1, 0,    2,    0.3, 1,   2.25, -0.8, 0.6,
                                        2, -0.8, -0.6, 2,   0.3, -1,   1.75};
    family_plain("spherical polygon", buffon_spherical_polygon(above, pentagon, 5));
    family_add("spherical polygon, a triangle", buffon_spherical_polygon(above, pentagon, 3));
    family_plain("rotation", buffon_rotation())->unseen = 1;
}

static void family_of_flat(void)
{
    family_pieces();
    family_spherical();
}

#endif
