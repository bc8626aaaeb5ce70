/* The table of all densities (family.h): shapes that are round. */
#ifndef TESTS_FAMILY_ROUND_H
#define TESTS_FAMILY_ROUND_H

#include "../family.h"

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

static void family_round(void)
{
    static const double up[3] = {0, 0, 1}, down[3] = {0, 0, -1};
    family_plain("circle", buffon_circle(2))->unseen = 1;
    family_add("circle, tiny", buffon_circle(1e-300))->unseen = 1;
    family_plain("annulus", buffon_annulus(1, 2));
    family_add("annulus, thin", buffon_annulus(1e10, 1e10 + 1e-3))->unseen = 1;
    family_plain("sector", buffon_disk_sector(0, 1.5, 0.5, 2));
    family_add("sector, behind", buffon_disk_sector(1, 1.25, 3, 3.5));
    family_add("sector, sliver", buffon_disk_sector(0, 1, 1, 1 + 1e-6))->unseen = 1;
    family_plain("ellipse", buffon_ellipse(3, 0.5));
    family_add("ellipse, flat", buffon_ellipse(1e-3, 10));
    family_plain("zone", buffon_zone(-0.25, 0.5, up));
    family_plain("zone about an axis", buffon_zone_angles(1, 2, family_axis));
    family_add("zone, thin", buffon_zone_heights(1, 1 + 1e-6, family_axis))->unseen = 1;
    family_add("zone, near the pole", buffon_zone_angles(1e-9, 2e-9, up));
    family_add("zone, near the other pole", buffon_zone_angles(3.1415, 3.14159, up));
    family_add("all but a cap", buffon_cap_complement_angle(0.5, family_axis));
    family_plain("ball", buffon_ball(2));
    family_add("ball, tiny", buffon_ball(1e-90));
    family_plain("shell", buffon_shell(1, 1.5));
    family_add("shell, thin", buffon_shell(1, 1 + 1e-3))->unseen = 1;
    family_plain("cylinder", buffon_cylinder(family_axis, up, 0.5))->unseen = 1;
    family_add("cylinder, flat", buffon_cylinder(up, down, 30))->unseen = 1;
    family_plain("cosine to the power 20", buffon_hemisphere_power(20));
    family_plain("cosine to a power, about an axis",
                 buffon_hemisphere_power_about(2.5, family_axis));
    family_add("cosine to the power 0", buffon_hemisphere_power(0));
    family_add("cosine to the power 1e15", buffon_hemisphere_power(1e15));
    family_add("all but a tiny cap", buffon_cap_complement_height(1e-18, up));
}

/* Caps over, across and under the horizon of a surface that looks up. */
static void family_cap_cosine(void)
{
    static const double up[3] = {0, 0, 1}, high[3] = {1, 1, 2}, low[3] = {2, 1, 0.25};
    static const double below[3] = {3, 1, -0.5}, under[3] = {1, 0, -20}, grazing[3] = {1, 0, -0.54};
    family_plain("cosine cap", buffon_cap_cosine(0.5, high, up));
    family_plain("cosine cap across the horizon", buffon_cap_cosine(0.5, low, up))->how.samples =
        1 << 13;
    family_add("cosine cap, small", buffon_cap_cosine(1e-5, high, family_axis));
    family_add("cosine cap, sky", buffon_cap_cosine(0x1.921fb54442d18p+0, up, up));
    family_add("cosine cap, to the horizon", buffon_cap_cosine(0.5, high, family_axis));
    family_add("cosine cap, half", buffon_cap_cosine(0.25, low, (double[3]){-1, 2, 0}));
    family_add("cosine cap, wide", buffon_cap_cosine(1.5, high, family_axis));
    family_add("cosine cap, mostly below", buffon_cap_cosine(0.3, below, up));
    family_add("cosine cap, looking down", buffon_cap_cosine(1.55, under, up))->unseen = 1;
    family_add("cosine cap, grazing", buffon_cap_cosine(0.5, grazing, up));
}

static void family_of_round(void)
{
    family_shapes();
    family_round();
    family_cap_cosine();
}

#endif
