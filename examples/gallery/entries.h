/* The densities of the gallery: the body of a function in gallery.c.
 *
 * GROUP(title, what they have in common);
 * ENTRY(name, caption, view, the density as C);
 *
 * The views are those of gallery.h. An entry may be preceded by the arrays that it needs. Entries
 * stand in the groups to which they belong; a new one goes at the end of its group.
 */

/* ---- laws on the line ---- */
GROUP("Laws on the line", "One uniform makes one point by the inverse of the distribution "
      "function, so points keep their order.");

ENTRY("Segment", "Every point of an interval alike.", LINE(-0.5, 2.5), buffon_segment(0, 2));

ENTRY("Normal", "Sums of many small things; far tails keep their digits.", LINE(-4, 4),
      buffon_normal(0, 1));

ENTRY("Normal, its tails", "The same on a logarithmic scale: a parabola.", TAILS(-5, 5, 6),
      buffon_normal(0, 1));

ENTRY("Exponential", "Waiting times, and distances between collisions.", LINE(0, 5),
      buffon_exponential(1));

const double knots[] = {0, 1, 1.5, 2.5, 4}, shares[] = {0, 0.15, 0.5, 0.9, 1};
const buffon_inversion table = {.x = knots, .F = shares, .count = 5};
ENTRY("Inverse of a table", "A distribution function known at a few points, straight in between.",
      LINE(-0.2, 4.2), buffon_inverse(&table));

ENTRY("von Mises", "The normal law of angles: kappa is how much they agree.", LINE(-3.3, 3.3),
      buffon_von_mises(2, 0));

/* ---- shapes in the plane ---- */
GROUP("Shapes in the plane", "The net is the image of a square one: each of its 64 cells has the "
      "same chance.");

const double low[] = {-1, -0.6}, high[] = {1, 0.6};
ENTRY("Box", "A rectangle, or a box of any dimension.", PLANE(-1.1, 1.1, -0.8, 0.8),
      buffon_box(low, high, 2));

ENTRY("Disk", "Polar coordinates: the radius is the square root of a uniform.",
      PLANE(-1.1, 1.1, -1.1, 1.1), buffon_disk(1));

ENTRY("Disk, concentric", "Squares become circles; neighbours stay neighbours.",
      PLANE(-1.1, 1.1, -1.1, 1.1), buffon_disk_concentric(1));

ENTRY("Circle", "The edge alone, by its length.", PLANE(-1.1, 1.1, -1.1, 1.1), buffon_circle(1));

ENTRY("Annulus", "A ring, however thin: its area is a product, not a difference.",
      PLANE(-1.1, 1.1, -1.1, 1.1), buffon_annulus(0.6, 1));

ENTRY("Sector", "Part of a ring, between two angles.", PLANE(-1.1, 1.1, -1.1, 1.1),
      buffon_disk_sector(0.3, 1, -0.5, 2.2));

ENTRY("Ellipse", "The concentric disk, drawn out.", PLANE(-1.1, 1.1, -1.1, 1.1),
      buffon_ellipse(1, 0.6));

/* ---- directions ---- */
GROUP("Directions", "Unit vectors; the density is by solid angle.");

ENTRY("Sphere", "Every direction alike: heights are uniform.", SPHERE, buffon_sphere());

ENTRY("Hemisphere", "The sky over a surface.", SPHERE, buffon_hemisphere());

ENTRY("Cosine hemisphere", "A disk projected up: as a matt surface sees its sky.", SPHERE,
      buffon_hemisphere_cosine());

const double lamp[] = {3, -2, 2};
ENTRY("Cap", "A lamp that is a sphere, the sun, a cone of directions.", SPHERE,
      buffon_cap_about(0.8, lamp));

ENTRY("Zone", "Between two planes, or two angles from an axis.", SPHERE,
      buffon_zone(0.1, 0.5, lamp));

ENTRY("All but a cap", "The sphere, with the smallest hole kept out.", SPHERE,
      buffon_cap_complement_angle(0.7, lamp));

ENTRY("Power of the cosine", "A spot of light, from a wide one to a beam.", SPHERE,
      buffon_hemisphere_power(20));

const double up[] = {0, 0, 1}, setting[] = {3, -2, 0.3};
ENTRY("Cosine cap", "A cap as a surface sees it: what grazes counts less.", SPHERE,
      buffon_cap_cosine(0.7, lamp, up));

ENTRY("Cosine cap, setting", "The horizon cuts it: nothing below, little above.", SPHERE,
      buffon_cap_cosine(0.6, setting, up));

ENTRY("Henyey and Greenstein", "How light goes on that met a particle of dust.", SPHERE,
      buffon_henyey_greenstein(0.7, lamp));

ENTRY("von Mises and Fisher", "The normal law of directions.", SPHERE,
      buffon_von_mises_fisher(10, lamp));
