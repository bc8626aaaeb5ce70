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

static uint64_t room[5][512];
const double heights[] = {0.2, 0.9, 0.5, 0, 0.7, 0.3};
ENTRY("Steps", "A histogram; what has height 0 is never drawn.", LINE(-0.1, 1.1),
      buffon_piecewise_constant(room[0], sizeof room[0], NULL, heights, 6));

ENTRY("Straight lines", "Heights at a few points, and straight lines between them.",
      LINE(-0.1, 1.1), buffon_piecewise_linear(room[1], sizeof room[1], NULL, heights, 6));

ENTRY("Weights", "One of a number of items by their weights, in constant time.", BARS(0, 5),
      buffon_alias(room[2], sizeof room[2], heights, 6));

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

ENTRY("Bilinear", "Four heights at the corners of a square.", FIELD(-0.1, 1.1, -0.1, 1.1),
      buffon_bilinear(1, 4, 3, 0));

const double pixels[] = {1, 0, 3, 1, 2, 1, 0, 2, 6, 3, 2, 0, 1, 2, 1, 0};
ENTRY("Grid", "An image: cells, each of its own height.", FIELD(-0.1, 1.1, -0.1, 1.1),
      buffon_piecewise_grid(room[3], sizeof room[3], pixels, 4, 4));

/* ---- directions ---- */
GROUP("Directions", "Unit vectors; the density is by solid angle.");

ENTRY("Sphere", "Every direction alike: heights are uniform.", SPHERE, buffon_sphere());

ENTRY("Hemisphere", "The sky over a surface.", SPHERE, buffon_hemisphere());

ENTRY("Cosine hemisphere", "A disk projected up: as a matt surface sees its sky.", SPHERE,
      buffon_hemisphere_cosine());

const double lamp[] = {3, -2, 2};
ENTRY("Cap", "A lamp that is a sphere, the sun, a cone of directions.", SPHERE,
      buffon_cap_about(0.8, lamp));

ENTRY("Henyey and Greenstein", "How light goes on that met a particle of dust.", SPHERE,
      buffon_henyey_greenstein(0.7, lamp));

ENTRY("von Mises and Fisher", "The normal law of directions.", SPHERE,
      buffon_von_mises_fisher(10, lamp));

ENTRY("Picture of a sky", "Directions by the luminance of an image in longitude and latitude.",
      SPHERE, buffon_environment(room[4], sizeof room[4], pixels, 8, 2));
