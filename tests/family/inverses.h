/* The table of all densities (family.h): tables made by numerical inversion. */
#ifndef TESTS_FAMILY_INVERSES_H
#define TESTS_FAMILY_INVERSES_H

#include "../family.h"

/* exp and pow of the library itself: so the bits are the same everywhere. */
static double family_bell(double x, void *ctx)
{
    double y = -0.5 * x * x;
    (void)ctx;
    buffon_math_exp(&y, &y, 1);
    return y;
}

static double family_cauchy_bell(double x, void *ctx)
{
    (void)ctx;
    return 1 / (1 + x * x);
}

static double family_pole(double x, void *ctx)
{
    (void)ctx;
    return 1 / sqrt(x);
}

static double family_two_steps(double x, void *ctx)
{
    (void)ctx;
    return x < 0.3 ? 1 : 5;
}

static buffon_density family_inverse_table(double (*pdf)(double, void *), double lo, double hi,
                                           double u_error, double *memory, size_t bytes)
{
    static const double at = 0.3;
    buffon_inverse_report report;
    const buffon_inverse_law law = {.pdf = pdf,
                                    .lo = lo,
                                    .hi = hi,
                                    .breaks = &at,
                                    .breaks_count = pdf == family_two_steps,
                                    .u_error = u_error};
    if (buffon_inverse_table_build(memory, bytes, &report, &law) < 0)
        memory[0] = 0;
    return buffon_inverse_table_density((const buffon_inverse_table *)(const void *)memory);
}

static void family_inverse_tables(void)
{
    static double memory[5][1 << 15];
    const size_t bytes = sizeof memory[0];
    family_plain("inverse table, normal",
                 family_inverse_table(family_bell, 0, 0, 0, memory[0], bytes));
    family_add("inverse table, normal, coarser",
               family_inverse_table(family_bell, 0, 0, 1e-9, memory[1], bytes));
    family_add("inverse table, Cauchy",
               family_inverse_table(family_cauchy_bell, 0, 0, 0, memory[2], bytes));
    family_add("inverse table, pole", family_inverse_table(family_pole, 0, 1, 0, memory[3], bytes))
        ->unseen = 1;
    family_add("inverse table, steps",
               family_inverse_table(family_two_steps, -1, 1, 0, memory[4], bytes));
}

static void family_of_inverses(void)
{
    family_inverse_tables();
}

#endif
