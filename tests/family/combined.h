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

static void family_combined(void)
{
}

static void family_of_combined(void)
{
    family_products();
    family_combined();
}

#endif
