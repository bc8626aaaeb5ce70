/* The table of all densities (family.h): laws on the line in closed form. */
#ifndef TESTS_FAMILY_LINES_H
#define TESTS_FAMILY_LINES_H

#include "../family.h"

static void family_of_lines(void)
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

#endif
