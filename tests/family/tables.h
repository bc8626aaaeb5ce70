/* The table of all densities (family.h): tables. */
#ifndef TESTS_FAMILY_TABLES_H
#define TESTS_FAMILY_TABLES_H

#include "../family.h"

/* Memory for a table. The verification runs once; nothing is given back. */
static void *family_room(size_t size)
{
    void *room = malloc(size);
    if (!room)
        abort();
    return room;
}

static void family_whole(family_case *added)
{
    added->how.discrete = 1;
}

static void family_items(void)
{
    static const double few[] = {3, 0, 1, 4, 1, 5, 0}, far[] = {1e-300, 1e300, 0, 1e299, 5e-324};
    static double many[1000];
    const size_t alias = buffon_alias_size(1000), guide = buffon_guide_size(1000);
    for (size_t k = 0; k < 1000; k++)
        many[k] = k % 5 ? 1 / (double)(k + 1) : 0;
    family_whole(family_add("alias, few items", buffon_alias(family_room(alias), alias, few, 7)));
    family_whole(family_plain("alias", buffon_alias(family_room(alias), alias, many, 1000)));
    family_whole(family_add("alias, far apart", buffon_alias(family_room(alias), alias, far, 5)));
    family_whole(family_plain("guide table", buffon_guide(family_room(guide), guide, many, 1000)));
    family_whole(
        family_add("guide table, one item", buffon_guide(family_room(guide), guide, few, 1)));
}

static void family_skies(void)
{
    static double sky[64 * 32];
    const size_t size = buffon_environment_size(64, 32);
    for (size_t k = 0; k < 64 * 32; k++)
        sky[k] = 1 + (double)(k * 7919 % 101) / 50;
    family_plain("environment", buffon_environment(family_room(size), size, sky, 64, 32));
    sky[300] = 1e5;
    for (size_t k = 20 * 64; k < 32 * 64; k++)
        sky[k] = 0;
    family_add("environment with a sun", buffon_environment(family_room(size), size, sky, 64, 32))
        ->unseen = 1;
    family_add("environment of a pixel", buffon_environment(family_room(size), size, sky, 1, 1));
}

static void family_tables(void)
{
    static const double edge[] = {-1, -0.5, 0, 2, 2.25, 4}, height[] = {2, 0, 1, 8, 0.5, 0};
    static const double thin[] = {0, 1e-200, 1e-10, 1, 1e10, 1e200};
    static double grid[16 * 9];
    const size_t size = buffon_piecewise_grid_size(16, 9);
    const size_t surface = buffon_bilinear_grid_size(16, 9);
    for (size_t k = 0; k < 16 * 9; k++)
        grid[k] = (double)(k * 5 % 23) - 2 > 0 ? (double)(k * 5 % 23) : 0;
    family_items();
    family_plain("steps", buffon_piecewise_constant(family_room(size), size, edge, height, 5));
    family_add("steps, very uneven",
               buffon_piecewise_constant(family_room(size), size, thin, height, 5))
        ->unseen = 1;
    family_plain("lines", buffon_piecewise_linear(family_room(size), size, edge, height, 6));
    family_add("lines, even", buffon_piecewise_linear(family_room(size), size, NULL, height, 6));
    family_plain("grid", buffon_piecewise_grid(family_room(size), size, grid, 16, 9));
    family_plain("bilinear", buffon_bilinear(1, 2, 0.5, 4));
    family_plain("bilinear grid",
                 buffon_bilinear_grid(family_room(surface), surface, grid, 16, 9));
    family_add("bilinear, two corners", buffon_bilinear(0, 1, 1, 0));
    family_add("bilinear, one corner", buffon_bilinear(0, 0, 0x1p-1000, 0));
    family_skies();
}

static void family_of_tables(void)
{
    family_tables();
}

#endif
