/* The table of all densities (family.h): tables made by numerical inversion. */
#ifndef TESTS_FAMILY_INVERSES_H
#define TESTS_FAMILY_INVERSES_H

#include "../family.h"

static void family_inverse_tables(void)
{
}

static void family_of_inverses(void)
{
    family_inverse_tables();
}

#endif
