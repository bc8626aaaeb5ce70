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

static void family_n_spheres(void)
{
    family_plain("sphere of 2 dimensions", buffon_sphere_n(2))->unseen = 1;
    family_plain("sphere of 3 dimensions", buffon_sphere_n(3));
    family_plain("sphere of 4 dimensions", buffon_sphere_n(4))->unseen = 1;
    family_plain("sphere of 5 dimensions", buffon_sphere_n(5))->unseen = 1;
    family_plain("sphere of 20 dimensions", buffon_sphere_n(20))->unseen = 1;
    family_plain("ball of 1 dimension", buffon_ball_n(1));
    family_plain("ball of 2 dimensions", buffon_ball_n(2));
    family_plain("ball of 3 dimensions", buffon_ball_n(3));
    family_plain("ball of 8 dimensions", buffon_ball_n(8))->unseen = 1;
    family_add("ball of 99 dimensions", buffon_ball_n(99))->unseen = 1;
}

static void family_lines(void)
{
    family_plain("normal", buffon_normal(0, 1));
    family_add("normal, narrow", buffon_normal(1e6, 1e-3));
    family_plain("exponential", buffon_exponential(1));
    family_add("exponential, fast", buffon_exponential(1e100));
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
    family_directional();
    family_n_spheres();
    family_flat();
    family_spherical();
    family_dimensions();
    family_lines();
    family_laws();
    family_gamma();
    family_counts();
    family_tables();
    family_inverse_tables();
    family_products();
    family_combined();
}

#endif
