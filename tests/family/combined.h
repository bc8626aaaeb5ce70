/* The table of all densities (family.h): products, mixtures, truncation, affine images. */
#ifndef TESTS_FAMILY_COMBINED_H
#define TESTS_FAMILY_COMBINED_H

#include "../family.h"

static void family_products(void)
{
    static buffon_density part[3];
    part[0] = buffon_disk(2);
    part[1] = buffon_normal(1, 2);
    part[2] = buffon_exponential(0.5);
    family_plain("product", buffon_density_product(part, 3));
}

static void family_mixtures(void)
{
    static buffon_density one[2], two[3], pair[2], disk;
    static const double shares[] = {0.9, 0.1}, three[] = {1, 0, 5e300};
    static const double matrix[] = {2, 0.5, 0, 1}, shift[] = {3, -1};
    one[0] = buffon_normal(0, 1);
    one[1] = buffon_cauchy(0, 2);
    family_plain("mixture", buffon_mixture(one, shares, 2));
    pair[0] = buffon_truncated(&one[0], -2, 1);
    pair[1] = buffon_laplace(0, 1);
    disk = buffon_disk(2);
    two[0] = buffon_density_product(pair, 2);
    two[1] = buffon_disk_concentric(1);
    two[2] = buffon_affine(&disk, matrix, shift);
    family_add("mixture of products and images", buffon_mixture(two, three, 3));
    family_plain("normal, truncated", pair[0]);
    family_add("normal, truncated to its lower tail", buffon_truncated(&one[0], -INFINITY, -20));
}

static void family_images(void)
{
    static buffon_density normal, cap, disk, edges[3], cube;
    static const double matrix[] = {2, 0.5, -1, 3}, shift[] = {3, -1}, q[] = {1, 2, -1, 0.5};
    static const double minus = -1e100, up[] = {0, 0, 1};
    static const double units[] = {0, 1e20, 0, 2, 0, 0, 0, 0, 1e-20};
    normal = buffon_normal(0, 1);
    cap = buffon_cap_angle(0.5, up);
    disk = buffon_disk(1);
    for (int k = 0; k < 3; k++)
        edges[k] = buffon_exponential(1);
    cube = buffon_density_product(edges, 3);
    family_plain("disk, affine", buffon_affine(&disk, matrix, shift));
    family_add("normal, affine", buffon_affine(&normal, &minus, NULL));
    family_plain("cap, turned", buffon_turned(&cap, q));
    family_plain("cap, turned to an axis", buffon_turned_to(&cap, family_axis));
    family_add("exponentials in other units", buffon_affine(&cube, units, NULL))->unseen = 1;
}

static void family_of_combined(void)
{
    family_products();
    family_mixtures();
    family_images();
}

#endif
