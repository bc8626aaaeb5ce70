/* The table of all densities (family.h): directions about an axis, spheres of any dimension. */
#ifndef TESTS_FAMILY_DIRECTIONS_H
#define TESTS_FAMILY_DIRECTIONS_H

#include "../family.h"

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
    family_plain("von Mises", buffon_von_mises(2, 0));
    family_plain("von Mises, concentrated", buffon_von_mises(100, 3));
    family_add("von Mises, even", buffon_von_mises(0, -1));
    family_add("von Mises, nearly even", buffon_von_mises(1e-9, 0));
    family_add("von Mises, narrow", buffon_von_mises(1e15, 0));
}

static void family_n_spheres(void)
{
    family_plain("sphere of 2 dimensions", buffon_sphere_n(2))->unseen = 1;
    family_plain("sphere of 3 dimensions", buffon_sphere_n(3));
    family_plain("sphere of 4 dimensions", buffon_sphere_n(4))->unseen = 1;
    family_plain("sphere of 5 dimensions", buffon_sphere_n(5))->unseen = 1;
    family_plain("sphere of 20 dimensions", buffon_sphere_n(20))->unseen = 1;
    family_plain("ball of 1 dimension", buffon_ball_n(1));
    family_plain("ball of 2 dimensions", buffon_ball_n(2));
    family_plain("ball of 3 dimensions", buffon_ball_n(3));
    family_plain("ball of 8 dimensions", buffon_ball_n(8))->unseen = 1;
    family_add("ball of 99 dimensions", buffon_ball_n(99))->unseen = 1;
}

static void family_of_directions(void)
{
    family_directional();
    family_n_spheres();
}

#endif
