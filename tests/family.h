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

static family_case *family_counts(family_case *one)
{
    one->how.discrete = 1;
    return one;
}

static void family_discrete(void)
{
    family_counts(family_plain("bernoulli", buffon_bernoulli(0.3)));
    family_counts(family_plain("geometric", buffon_geometric(0.2)));
    family_counts(family_plain("binomial 20", buffon_binomial(20, 0.3)));
    family_counts(family_plain("binomial 1e6", buffon_binomial(1000000, 0.3)));
    family_counts(family_plain("poisson 10", buffon_poisson(10)));
    family_counts(family_plain("poisson 1e6", buffon_poisson(1e6)));
    family_counts(family_add("geometric, rare", buffon_geometric(1e-14)))->unseen = 1;
    family_counts(family_add("binomial, rare", buffon_binomial(UINT64_C(1) << 50, 1e-15)));
    family_counts(family_add("binomial, often", buffon_binomial(1000, 0.999)));
    family_counts(family_add("poisson 1e15", buffon_poisson(1e15)))->unseen = 1;
}

static void family_lines(void)
{
    family_plain("normal", buffon_normal(0, 1));
    family_add("normal, narrow", buffon_normal(1e6, 1e-3));
    family_plain("exponential", buffon_exponential(1));
    family_add("exponential, fast", buffon_exponential(1e100));
    family_gamma();
    family_beta();
    family_discrete();
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
    family_lines();
    family_products();
}

#endif
