/* The densities of the gallery: the body of a function in gallery.c.
 *
 * GROUP(title, what they have in common);
 * ENTRY(name, caption, view, the density as C);
 *
 * The views are those of gallery.h. An entry may be preceded by the arrays that it needs, and by
 * ROOM(name, bytes) for the memory of a table: `name` and `name_size`. Entries stand in the groups
 * to which they belong; a new one goes at the end of its group.
 */
const double up[] = {0, 0, 1}, lamp[] = {3, -2, 2};

/* ---- laws on the line ---- */
GROUP("Laws on the line", "One uniform makes one point by the inverse of the distribution "
      "function, so points keep their order.");

ENTRY("Segment", "Every point of an interval alike.", LINE(-0.5, 2.7), buffon_segment(0, 2));

ENTRY("Linear", "A ramp between two heights.", LINE(-1.5, 2.5),
      buffon_linear(-1, 2, 1, 3));

ENTRY("Triangular", "Least, likeliest and largest are all that is known.", LINE(-1.5, 4.5),
      buffon_triangular(-1, 0.5, 4));

ENTRY("Tent", "The sum of two uniforms, and the filter of a camera.", LINE(-2.5, 2.5),
      buffon_tent(0, 2));

ENTRY("Exponential", "Waiting times, and distances between collisions.", LINE(0, 5),
      buffon_exponential(1));

ENTRY("Exponential, bounded", "Where in a slab of fog light is scattered.", LINE(-0.5, 3.5),
      buffon_exponential_truncated(0.8, 0, 3));

ENTRY("Laplace", "Two exponentials back to back.", LINE(-5, 5), buffon_laplace(0, 1));

ENTRY("Normal", "Sums of many small things.", LINE(-4, 4), buffon_normal(0, 1));

ENTRY("Normal, its tails", "The same on a logarithmic scale: a parabola.", TAILS(-4.5, 4.5, 6),
      buffon_normal(0, 1));

ENTRY("Normal, bounded", "However far out the bounds are.", LINE(3, 5),
      buffon_normal_truncated(0, 1, 3.25, 4.5));

ENTRY("Lognormal", "Products of many small things.", LINE(0, 6), buffon_lognormal(0, 0.7));

ENTRY("Logistic", "Like the normal, with the tails of an exponential.", TAILS(-12, 12, 6),
      buffon_logistic(0, 1));

ENTRY("Cauchy", "Where a spun lamp hits a wall: it has no mean.", TAILS(-60, 60, 4),
      buffon_cauchy(0, 1));

ENTRY("Student", "The mean of few normals over its error; its intervals are this library's.",
      TAILS(-12, 12, 5), buffon_student_t(3));

ENTRY("Power", "A power of x between bounds, infinite or not at its end.", LINE(0, 2),
      buffon_power(1.5, 0, 2));

ENTRY("Pareto", "Cities, fortunes, files: a few are huge.", TAILS(0, 20, 5), buffon_pareto(2.5, 1));

ENTRY("Weibull", "How long things last that wear out.", LINE(0, 5), buffon_weibull(1.5, 2));

ENTRY("Gamma", "The wait for several events.", LINE(0, 10), buffon_gamma(2.5, 1));

ENTRY("Chi-square", "Sums of squares of normals; of one, with a pole at 0.", LINE(0, 6),
      buffon_chi_square(1));

ENTRY("Beta", "A share between 0 and 1; here with poles at both ends.", LINE(0, 1),
      buffon_beta(0.6, 0.8));

ENTRY("von Mises", "The normal law of angles: kappa is how much they agree.", LINE(-3.3, 3.3),
      buffon_von_mises(2, 0));

/* ---- tables ---- */
GROUP("From tables", "A histogram, an image or a sky as a density.");

const double knots[] = {0, 1, 1.5, 2.5, 4}, shares[] = {0, 0.15, 0.5, 0.9, 1};
const buffon_inversion table = {.x = knots, .F = shares, .count = 5};
ENTRY("Inverse of a table", "A distribution function known at a few points, straight in between.",
      LINE(0, 4), buffon_inverse(&table));

const double edges[] = {0, 0.5, 1, 2, 2.5, 4}, steps[] = {1, 4, 2, 0, 1};
ROOM(bins, buffon_piecewise_constant_size(5));
ENTRY("Steps", "A histogram: one bin may be empty.", LINE(0, 4),
      buffon_piecewise_constant(bins, bins_size, edges, steps, 5));

const double bends[] = {0, 1, 1.5, 3, 4}, heights[] = {0, 3, 1, 2, 0};
ROOM(lines, buffon_piecewise_linear_size(5));
ENTRY("Lines", "Straight between given heights.", LINE(0, 4),
      buffon_piecewise_linear(lines, lines_size, bends, heights, 5));

ENTRY("Bilinear", "Four corners and what lies between: the net thins out with the density.",
      PLANE(-0.05, 1.05, -0.05, 1.05), buffon_bilinear(0.1, 1, 1, 4));

static double rose[72 * 72];
for (int i = 0; i < 72 * 72; i++) {
    const double x = (i % 72 - 35.5) / 36, y = (i / 72 - 35.5) / 36;
    const double r = hypot(x, y), petal = fabs(cos(2.5 * atan2(x, y)));
    rose[i] = r < 0.97 * petal ? 0.15 + r : 0;
}
ROOM(image, buffon_piecewise_grid_size(72, 72));
ENTRY("Image", "Points fall where it is bright.", FIELD(0, 1, 0, 1),
      buffon_piecewise_grid(image, image_size, rose, 72, 72));

const double nodes[] = {0, 1, 0, 0, 1, 1, 0, 3, 1, 2, 0, 1, 0, 0, 6, 1, 0, 2, 1, 0, 0, 1, 0, 3, 0};
ROOM(nodal, buffon_bilinear_grid_size(5, 5));
ENTRY("Surface", "Heights at the nodes of a grid, bilinear in between.", FIELD(0, 1, 0, 1),
      buffon_bilinear_grid(nodal, nodal_size, nodes, 5, 5));

static double sky[64 * 32];
for (int i = 0; i < 64 * 32; i++) {
    const double angle = 3.14159265 * (i / 64 + 0.5) / 32, turn = 6.2831853 * (i % 64 + 0.5) / 64;
    const double towards = (3 * sin(angle) * cos(turn) - 2 * sin(angle) * sin(turn) +
                            2 * cos(angle)) / sqrt(17);
    sky[i] = angle > 1.5707963 ? 0.02 : 0.15 + pow(sin(angle), 8) + 40 * exp(30 * (towards - 1));
}
ROOM(world, buffon_environment_size(64, 32));
ENTRY("Environment", "A sky in longitude and latitude: a sun, a bright horizon, dark ground.",
      SKY, buffon_environment(world, world_size, sky, 64, 32));

ROOM(lamp_table, 1 << 17);
ENTRY("Any pdf", "A formula, unnormalised: a slope from a pole, and two lines. Tabulated.",
      LINE(0, 3), gallery_tabulated(lamp_table, lamp_table_size));

/* ---- whole numbers ---- */
GROUP("Whole numbers", "Bars are the share of points, dots the probabilities.");

const double odds[] = {5, 1, 3, 0, 2, 8, 4, 2, 1, 3, 6, 2};
ROOM(alias, buffon_alias_size(12));
ENTRY("Alias table", "Any weights, in constant time, by bits that are exact.", BARS(0, 11),
      buffon_alias(alias, alias_size, odds, 12));

ROOM(guide, buffon_guide_size(12));
ENTRY("Guide table", "The same weights by inversion: items keep their order.", BARS(0, 11),
      buffon_guide(guide, guide_size, odds, 12));

ENTRY("Bernoulli", "Yes or no.", BARS(0, 1), buffon_bernoulli(0.3));

ENTRY("Binomial", "How many of n are yes.", BARS(0, 20), buffon_binomial(20, 0.4));

ENTRY("Geometric", "How many noes before the first yes.", BARS(0, 16), buffon_geometric(0.25));

ENTRY("Poisson", "Counts of rare things: clicks, calls, photons.", BARS(0, 14),
      buffon_poisson(4.5));

/* ---- shapes in the plane ---- */
GROUP("Shapes in the plane", "The net is the image of a square one: each of its 64 cells has the "
      "same chance.");

const double low[] = {-1, -0.6}, high[] = {1, 0.6};
ENTRY("Box", "A rectangle, or a box of any dimension.", PLANE(-1.1, 1.1, -1.1, 1.1),
      buffon_box(low, high, 2));

ENTRY("Disk", "Polar coordinates: the radius is the square root of a uniform.",
      PLANE(-1.1, 1.1, -1.1, 1.1), buffon_disk(1));

ENTRY("Disk, concentric", "Squares become circles; neighbours stay neighbours.",
      PLANE(-1.1, 1.1, -1.1, 1.1), buffon_disk_concentric(1));

ENTRY("Circle", "Its points by length.", PLANE(-1.1, 1.1, -1.1, 1.1), buffon_circle(1));

ENTRY("Ring", "However thin, it keeps its digits.", PLANE(-1.1, 1.1, -1.1, 1.1),
      buffon_annulus(0.6, 1));

ENTRY("Sector", "Between two circles and two angles.", PLANE(-1.1, 1.1, -1.1, 1.1),
      buffon_disk_sector(0.3, 1, 0.5, 3.8));

ENTRY("Ellipse", "A disk, stretched.", PLANE(-1.1, 1.1, -1.1, 1.1), buffon_ellipse(1, 0.5));

const double west[] = {-1, -0.7}, east[] = {1, -0.5}, north[] = {-0.3, 0.9};
ENTRY("Triangle in the plane", "Three corners, every point alike.", PLANE(-1.1, 1.1, -1.1, 1.1),
      buffon_triangle_flat(west, east, north));

/* ---- directions ---- */
GROUP("Directions", "Unit vectors; the density is by solid angle.");

ENTRY("Sphere", "Every direction alike: heights are uniform.", SPHERE, buffon_sphere());

ENTRY("Hemisphere", "The sky over a surface.", SPHERE, buffon_hemisphere());

ENTRY("Cosine hemisphere", "A disk projected up: as a matt surface sees its sky.", SPHERE,
      buffon_hemisphere_cosine());

ENTRY("Power of the cosine", "A glossy surface: the higher the power, the narrower.", SPHERE,
      buffon_hemisphere_power(12));

ENTRY("Cap", "A lamp that is a sphere, the sun, a cone of directions.", SPHERE,
      buffon_cap_about(0.8, lamp));

ENTRY("Zone", "Between two parallels.", SPHERE, buffon_zone(-0.25, 0.5, up));

ENTRY("All but a cap", "What a lamp leaves.", SPHERE, buffon_cap_complement_angle(0.9, lamp));

ENTRY("Henyey and Greenstein", "How light goes on that met a particle of dust.", SPHERE,
      buffon_henyey_greenstein(0.7, lamp));

ENTRY("von Mises and Fisher", "The normal law of directions.", SPHERE,
      buffon_von_mises_fisher(10, lamp));

const double low_lamp[] = {3, -2.5, 0.8};
ENTRY("Cosine cap", "What a lamp near the horizon gives a surface: its cosine, nothing below.",
      SPHERE, buffon_cap_cosine(0.8, low_lamp, up));

const double eye[] = {0, 0, 0}, p[] = {2, -1, 2}, q[] = {-1, -2, 0.5}, r[] = {1.5, -2, -0.7};
ENTRY("Spherical triangle", "The directions in which a triangle is seen, by solid angle.", SPHERE,
      buffon_spherical_triangle(eye, p, q, r));

const double qp[] = {2, 1, 0}, qr[] = {0.4, -0.8, -1.6};
ENTRY("Spherical rectangle", "The directions in which a rectangular lamp is seen.", SPHERE,
      buffon_spherical_rectangle(eye, q, qp, qr));

const double gem[] = {0, -1, 1.2, -0.9, -1, 0.6, -0.5, -1, -0.4, 0.5, -1, -0.4, 0.9, -1, 0.6};
ENTRY("Spherical polygon", "A fan of triangles about its first corner.", SPHERE,
      buffon_spherical_polygon(eye, gem, 5));

ENTRY("Rotations", "All alike: each hair is where a turn takes the pole, and points where x went.",
      FRAMES, buffon_rotation());

/* ---- shapes in space ---- */
GROUP("Shapes in space", "Seen from afar; what is further off is fainter.");

const double o[] = {-0.8, -0.5, -0.6}, a[] = {0.9, -0.4, -0.7}, b[] = {0.1, 0.9, -0.4};
const double c[] = {0, 0, 0.95}, oa[] = {1.4, 0.2, -0.1}, ob[] = {-0.2, 1.1, 0.5};
const double oc[] = {0.3, -0.2, 1.3};
ENTRY("Segment in space", "Between two points.", SPACE(0, 0, 0, 1), buffon_segment_between(o, c));

ENTRY("Triangle", "By area, in space.", SPACE(0, 0, 0, 1), buffon_triangle(o, a, c));

ENTRY("Parallelogram", "A lamp of two edges.", SPACE(0, 0, 0, 1), buffon_parallelogram(o, oa, ob));

ENTRY("Tetrahedron", "By volume; a simplex of any dimension goes likewise.", SPACE(0, 0, 0, 1),
      buffon_tetrahedron(o, a, b, c));

ENTRY("Parallelepiped", "A box that leans.", SPACE(-0.05, 0.05, 0.25, 1.3),
      buffon_parallelepiped(o, oa, ob, oc));

const double foot[] = {0, 0, -0.8}, head[] = {0, 0, 0.8};
ENTRY("Cylinder", "Its side: a fluorescent tube.", SPACE(0, 0, 0, 1),
      buffon_cylinder(foot, head, 0.5));

ENTRY("Simplex", "Random shares: coordinates whose sum is below 1.", SPACE(0.35, 0.35, 0.35, 0.8),
      buffon_simplex(3));

ENTRY("Ball", "By volume.", SKY, buffon_ball(1));

ENTRY("Shell", "Between two spheres.", SKY, buffon_shell(0.9, 1));

/* ---- more dimensions ---- */
GROUP("Many dimensions, and densities of densities", "Two coordinates are shown of many.");

ENTRY("Sphere of four dimensions", "Its first two coordinates fill a disk evenly.",
      PLANE(-1.1, 1.1, -1.1, 1.1), buffon_sphere_n(4));

ENTRY("Ball of twenty dimensions", "Two of its coordinates: nearly normal.",
      PLANE(-1.1, 1.1, -1.1, 1.1), buffon_ball_n(20));

const buffon_density normals[] = {buffon_normal(0, 1), buffon_normal(0, 0.5)};
ENTRY("Product of two normals", "Independent coordinates, each by its own law.",
      FIELD(-3, 3, -3, 3), buffon_density_product(normals, 2));

const buffon_density round[] = {buffon_disk(0.7), buffon_segment(-0.8, 0.8)};
const buffon_density bell = buffon_density_product(normals, 2);
const double slant[] = {0.9, -0.5, 0.6, 1.1}, shift[] = {0.2, 0.1};
ENTRY("Affine map", "Any density of the plane or of space, stretched, slanted and shifted.",
      FIELD(-3, 3, -3, 3), buffon_affine(&bell, slant, shift));

const buffon_density modes[] = {buffon_normal(-1.2, 0.5), buffon_normal(1.1, 0.8)};
const double weights[] = {1, 2};
ENTRY("Mixture", "One of several laws, each with its weight; the first uniform serves twice.",
      LINE(-4, 4), buffon_mixture(modes, weights, 2));

const buffon_density logistic = buffon_logistic(0, 1);
ENTRY("Truncated", "Any law on the line, kept between two bounds.", LINE(-3, 5),
      buffon_truncated(&logistic, -1, 4));

const buffon_density upright = buffon_hemisphere_power(30);
ENTRY("Turned", "Any density in space about another axis.", SPHERE,
      buffon_turned_to(&upright, lamp));

ENTRY("Solid product", "A disk times a segment is a solid cylinder.", SPACE(0, 0, 0, 1.05),
      buffon_density_product(round, 2));
