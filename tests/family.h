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
    family_plain("normal between bounds", buffon_normal_truncated(0, 1, -1, 2));
    family_plain("normal beyond 3", buffon_normal_truncated(0, 1, 3, INFINITY));
    family_plain("normal, its far tail", buffon_normal_truncated(-1e5, 1, 0, INFINITY));
    family_add("normal, a sliver", buffon_normal_truncated(-20, 1, 0, 1e-10));
    family_add("normal below the mean", buffon_normal_truncated(1e3, 1, -INFINITY, 0));
    family_plain("lognormal", buffon_lognormal(0.5, 0.75));
    family_add("lognormal, heavy", buffon_lognormal(-20, 8))->unseen = 1;
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
    family_lines();
    family_products();
}

#endif
