/* The table of all densities (family.h): gamma, beta and their kin; whole numbers. */
#ifndef TESTS_FAMILY_SPECIAL_H
#define TESTS_FAMILY_SPECIAL_H

#include "../family.h"

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

static void family_beta(void)
{
    family_plain("beta 2 3", buffon_beta(2, 3));
    family_plain("beta 0.5 0.5", buffon_beta(0.5, 0.5))->unseen = 1;
    family_plain("beta 50 20", buffon_beta(50, 20));
    family_add("beta 0.1 3", buffon_beta(0.1, 3))->unseen = 1;
    family_add("beta 10 10", buffon_beta(10, 10));
    family_add("beta 5 1e6", buffon_beta(5, 1e6));
    family_add("beta 1e8 1e10", buffon_beta(1e8, 1e10));
    family_plain("t 3", buffon_student_t(3));
    family_plain("t 30", buffon_student_t(30));
    family_add("t 1", buffon_student_t(1));
    family_add("t 0.5", buffon_student_t(0.5))->unseen = 1;
    family_add("t 1e10", buffon_student_t(1e10));
}

/* Points are whole numbers. */
static family_case *family_number(family_case *one)
{
    one->how.discrete = 1;
    return one;
}

static void family_counts(void)
{
    family_number(family_plain("bernoulli", buffon_bernoulli(0.3)));
    family_number(family_plain("geometric", buffon_geometric(0.2)));
    family_number(family_plain("binomial 20", buffon_binomial(20, 0.3)));
    family_number(family_plain("binomial 1e6", buffon_binomial(1000000, 0.3)));
    family_number(family_plain("poisson 10", buffon_poisson(10)));
    family_number(family_plain("poisson 1e6", buffon_poisson(1e6)));
    family_number(family_add("geometric, rare", buffon_geometric(1e-14)))->unseen = 1;
    family_number(family_add("binomial, rare", buffon_binomial(UINT64_C(1) << 50, 1e-15)));
    family_number(family_add("binomial, often", buffon_binomial(1000, 0.999)));
    family_number(family_add("poisson 1e15", buffon_poisson(1e15)))->unseen = 1;
}

static void family_of_special(void)
{
    family_gamma();
    family_beta();
    family_counts();
}

#endif
