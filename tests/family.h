/* Every density of the library, with parameters plain and extreme: the one table that is verified
 * (test_family), compared between levels (test_family), printed in hex (bits) and timed
 * (bench/family). A density is a line in one of the files of family/; what it needs to live is
 * static. */
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
    int shape;  /* geometric: a uniform of it should cost what one of the sphere's does, or twice */
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

#include "family/round.h"
#include "family/directions.h"
#include "family/flat.h"
#include "family/lines.h"
#include "family/special.h"
#include "family/tables.h"
#include "family/inverses.h"
#include "family/combined.h"

static void family_make(void)
{
    family_of_round();
    family_of_directions();
    family_of_flat();
    for (size_t k = 0; k < family_count; k++)
        family[k].shape = 1;
    family_of_lines();
    family_of_special();
    family_of_tables();
    family_of_inverses();
    family_of_combined();
}

#endif
