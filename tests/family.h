/* Every density of the library, with parameters plain and extreme: the one table that is verified
 * (test_family), compared between levels (test_family), printed in hex (bits) and timed
 * (bench/family). A density is a line; what it needs to live is static. */
#ifndef TESTS_FAMILY_H
#define TESTS_FAMILY_H

#include <math.h>
#include <stdlib.h>

#include <buffon/buffon.h>

enum { FAMILY_MOST = 400 };

typedef struct family_case {
    const char *name; /* unique */
    buffon_density g;
    buffon_verification how;
    int unseen; /* the verification cannot look at all of it: no sum, no cells */
    int timed;  /* gets a line in the bench */
} family_case;

static family_case family[FAMILY_MOST];
static size_t family_count;

/* Adds a density. Parameters that make a plain case are timed, extreme ones only checked. */
static family_case *family_add(const char *name, buffon_density g)
{
    if (family_count == FAMILY_MOST)
        abort();
    family[family_count] = (family_case){.name = name, .g = g, .how = {.samples = 1 << 14}};
    return &family[family_count++];
}

static family_case *family_plain(const char *name, buffon_density g)
{
    family_case *added = family_add(name, g);
    added->timed = 1;
    return added;
}

static const double family_axis[3] = {1, -2, 0.5};

static void family_shapes(void)
{
    static const double lo[3] = {-1, 0, 1e5}, hi[3] = {2, 1e-3, 1e6};
    family_plain("box 3", buffon_box(lo, hi, 3));
    family_plain("disk", buffon_disk(1.5));
    family_plain("disk, concentric", buffon_disk_concentric(1.5));
    family_add("disk, tiny", buffon_disk(1e-100));
    family_plain("sphere", buffon_sphere());
    family_plain("cap", buffon_cap(0.5));
    family_plain("cap about an axis", buffon_cap_angle(0.3, family_axis));
    family_add("cap, small", buffon_cap_angle(1e-5, family_axis));
    family_add("cap, large", buffon_cap_height(1.999, family_axis));
    family_plain("hemisphere", buffon_hemisphere());
    family_plain("hemisphere, cosine", buffon_hemisphere_cosine());
    family_plain("hemisphere, cosine, about an axis", buffon_hemisphere_cosine_about(family_axis));
}

static void family_round(void)
{
    static const double up[3] = {0, 0, 1}, down[3] = {0, 0, -1};
    family_plain("circle", buffon_circle(2))->unseen = 1;
    family_add("circle, tiny", buffon_circle(1e-300))->unseen = 1;
    family_plain("annulus", buffon_annulus(1, 2));
    family_add("annulus, thin", buffon_annulus(1e10, 1e10 + 1e-3))->unseen = 1;
    family_plain("sector", buffon_disk_sector(0, 1.5, 0.5, 2));
    family_add("sector, behind", buffon_disk_sector(1, 1.25, 3, 3.5));
    family_add("sector, sliver", buffon_disk_sector(0, 1, 1, 1 + 1e-6))->unseen = 1;
    family_plain("ellipse", buffon_ellipse(3, 0.5));
    family_add("ellipse, flat", buffon_ellipse(1e-3, 10));
    family_plain("zone", buffon_zone(-0.25, 0.5, up));
    family_plain("zone about an axis", buffon_zone_angles(1, 2, family_axis));
    family_add("zone, thin", buffon_zone_heights(1, 1 + 1e-6, family_axis))->unseen = 1;
    family_add("zone, near the pole", buffon_zone_angles(1e-9, 2e-9, up));
    family_add("zone, near the other pole", buffon_zone_angles(3.1415, 3.14159, up));
    family_add("all but a cap", buffon_cap_complement_angle(0.5, family_axis));
    family_plain("ball", buffon_ball(2));
    family_add("ball, tiny", buffon_ball(1e-90));
    family_plain("shell", buffon_shell(1, 1.5));
    family_add("shell, thin", buffon_shell(1, 1 + 1e-3))->unseen = 1;
    family_plain("cylinder", buffon_cylinder(family_axis, up, 0.5))->unseen = 1;
    family_add("cylinder, flat", buffon_cylinder(up, down, 30))->unseen = 1;
    family_plain("cosine to the power 20", buffon_hemisphere_power(20));
    family_plain("cosine to a power, about an axis",
                 buffon_hemisphere_power_about(2.5, family_axis));
    family_add("cosine to the power 0", buffon_hemisphere_power(0));
    family_add("cosine to the power 1e15", buffon_hemisphere_power(1e15));
    family_add("all but a tiny cap", buffon_cap_complement_height(1e-18, up));
}

/* Caps over, across and under the horizon of a surface that looks up. */
static void family_cap_cosine(void)
{
    static const double up[3] = {0, 0, 1}, high[3] = {1, 1, 2}, low[3] = {2, 1, 0.25};
    static const double below[3] = {3, 1, -0.5}, under[3] = {1, 0, -20}, grazing[3] = {1, 0, -0.54};
    family_plain("cosine cap", buffon_cap_cosine(0.5, high, up));
    family_add("cosine cap across the horizon", buffon_cap_cosine(0.5, low, up))->how.samples =
        1 << 13;
    family_add("cosine cap, small", buffon_cap_cosine(1e-5, high, family_axis));
    family_add("cosine cap, sky", buffon_cap_cosine(0x1.921fb54442d18p+0, up, up));
    family_add("cosine cap, to the horizon", buffon_cap_cosine(0.5, high, family_axis));
    family_add("cosine cap, half", buffon_cap_cosine(0.25, low, (double[3]){-1, 2, 0}));
    family_add("cosine cap, wide", buffon_cap_cosine(1.5, high, family_axis));
    family_add("cosine cap, mostly below", buffon_cap_cosine(0.3, below, up));
    family_add("cosine cap, looking down", buffon_cap_cosine(1.55, under, up))->unseen = 1;
    family_add("cosine cap, grazing", buffon_cap_cosine(0.5, grazing, up));
}

static void family_directional(void)
{
    static const double up[3] = {0, 0, 1};
    family_plain("Henyey and Greenstein", buffon_henyey_greenstein(0.7, up));
    family_plain("Henyey and Greenstein about an axis",
                 buffon_henyey_greenstein(-0.4, family_axis));
    family_add("Henyey and Greenstein, forward", buffon_henyey_greenstein(1 - 0x1p-20, up))
        ->unseen = 1;
    family_add("Henyey and Greenstein, backward", buffon_henyey_greenstein(-0.999, family_axis))
        ->unseen = 1;
    family_add("Henyey and Greenstein, even", buffon_henyey_greenstein(1e-300, up));
    family_plain("von Mises and Fisher", buffon_von_mises_fisher(5, up));
    family_plain("von Mises and Fisher about an axis", buffon_von_mises_fisher(50, family_axis));
    family_add("von Mises and Fisher, even", buffon_von_mises_fisher(0, family_axis));
    family_add("von Mises and Fisher, nearly even", buffon_von_mises_fisher(1e-9, up));
    family_add("von Mises and Fisher, narrow", buffon_von_mises_fisher(1e12, up));
    family_plain("von Mises", buffon_von_mises(2, 0));
    family_plain("von Mises, concentrated", buffon_von_mises(100, 3));
    family_add("von Mises, even", buffon_von_mises(0, -1));
    family_add("von Mises, nearly even", buffon_von_mises(1e-9, 0));
    family_add("von Mises, narrow", buffon_von_mises(1e15, 0));
}

/* ---- flat pieces ---- */

static void family_flat(void)
{
}

/* ---- spherical polygons and rotations ---- */

static void family_spherical(void)
{
}

/* ---- gamma, beta and their kin ---- */

static void family_gamma(void)
{
    family_plain("gamma 2.5", buffon_gamma(2.5, 1));
    family_plain("gamma 0.5", buffon_gamma(0.5, 3))->unseen = 1;
    family_plain("gamma 50", buffon_gamma(50, 0.1));
    family_add("gamma 0.05", buffon_gamma(0.05, 1e100))->unseen = 1;
    family_add("gamma 10", buffon_gamma(10, 1e-100));
    family_add("gamma 9.99", buffon_gamma(9.99, 1));
    family_add("gamma 1e10", buffon_gamma(1e10, 1));
    family_plain("chi-square 3", buffon_chi_square(3));
}

/* ---- laws of whole numbers ---- */

static void family_counts(void)
{
}

/* ---- laws on the line in closed form ---- */

static void family_laws(void)
{
}

/* ---- tables ---- */

static void family_tables(void)
{
}

/* ---- tables made by numerical inversion ---- */

static void family_inverse_tables(void)
{
}

/* ---- spheres and balls of any dimension ---- */

static void family_dimensions(void)
{
}

/* ---- mixtures, truncation, affine images ---- */

static void family_combined(void)
{
}

static void family_lines(void)
{
    static const double zero = 0, two = 2, minus = -5, far = 1e10, less = -1;
    static buffon_density to_two, to_zero, to_far, to_one;
    to_two = buffon_box(&zero, &two, 1);
    to_zero = buffon_box(&minus, &zero, 1);
    to_one = buffon_box(&less, &zero, 1);
    to_far = buffon_box(&zero, &far, 1);
    family_plain("normal", buffon_normal(0, 1));
    family_add("normal, narrow", buffon_normal(1e6, 1e-3));
    family_plain("exponential", buffon_exponential(1));
    family_add("exponential, fast", buffon_exponential(1e100));
    family_plain("exponential between bounds", buffon_exponential_truncated(1.5, -1, 2));
    family_add("exponential between bounds, rising", buffon_exponential_truncated(-30, -1, 0))
        ->how.over = &to_one;
    family_add("exponential between bounds, nearly even",
               buffon_exponential_truncated(1e-200, 0, 1e10))
        ->how.over = &to_far;
    family_plain("linear", buffon_linear(-1, 2, 1, 3));
    family_add("linear, from 0", buffon_linear(0, 1e-100, 0, 1e300));
    family_add("linear, to 0", buffon_linear(-5, 0, 1e-300, 0))->how.over = &to_zero;
    family_plain("triangular", buffon_triangular(-1, 0.5, 4));
    family_add("triangular, mode at an end", buffon_triangular(0, 0, 1e10))->how.over = &to_far;
    family_plain("tent", buffon_tent(0, 2));
    family_plain("Laplace", buffon_laplace(1, 2));
    family_add("Laplace, narrow", buffon_laplace(0, 1e-100));
    family_plain("logistic", buffon_logistic(1, 2));
    family_add("logistic, wide", buffon_logistic(0, 1e100));
    family_plain("Cauchy", buffon_cauchy(1, 2));
    family_plain("power", buffon_power(1.5, 0, 2))->how.over = &to_two;
    family_add("power, steep", buffon_power(0x1p20, 0, 1));
    family_add("power, singular", buffon_power(-0.75, 0, 2))->unseen = 1;
    family_plain("power between bounds", buffon_power(-2.5, 1, 100));
    family_plain("one over x", buffon_power(-1, 1e-3, 1e3))->unseen = 1;
    family_plain("Pareto", buffon_pareto(2.5, 1));
    family_add("Pareto, heavy", buffon_pareto(0.125, 1e10))->unseen = 1;
    family_plain("Weibull", buffon_weibull(1.5, 2));
    family_add("Weibull, heavy", buffon_weibull(0.0625, 1))->unseen = 1;
    family_add("Weibull, narrow", buffon_weibull(0x1p20, 1e5));
}

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

static void family_products(void)
{
    static buffon_density part[3];
    part[0] = buffon_disk(2);
    part[1] = buffon_normal(1, 2);
    part[2] = buffon_exponential(0.5);
    family_plain("product", buffon_density_product(part, 3));
}

static void family_make(void)
{
    family_shapes();
    family_round();
    family_cap_cosine();
    family_directional();
    family_flat();
    family_spherical();
    family_dimensions();
    family_lines();
    family_laws();
    family_gamma();
    family_counts();
    family_tables();
    family_inverse_tables();
    family_pieces();
    family_products();
    family_combined();
}

#endif
