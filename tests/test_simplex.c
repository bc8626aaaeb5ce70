/* Segments, triangles, tetrahedra, parallelograms, parallelepipeds and the standard simplex against
 * their formulas in extended precision, and at their limits. What needs a long double of 64 bits is
 * skipped elsewhere. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>

#include "grid.h"
#include "tap.h"

typedef long double wide;

enum { DRAWS = 20000, DIM_MAX = 170 };

static double ulp(wide x)
{
    const double a = fabs((double)x);
    return nextafter(a, INFINITY) - a;
}

static void raise_to(double *worst, double error)
{
    if (!(error <= *worst))
        *worst = error;
}

static void report(double worst, double limit, const char *what)
{
    tap_ok(worst <= limit, "%s: at most %g", what, limit);
    tap_note("worst %.3g", worst);
}

/* ---- the map ---- */

/* By tails, as in the header. */
static void weights(wide *w, const double *u, size_t dim)
{
    wide tail = expl(logl((wide)u[0]) / (wide)dim);
    for (size_t j = 0; j + 1 < dim; j++) {
        const wide e = logl((wide)u[j + 1]) / (wide)(dim - 1 - j);
        w[j] = -tail * expm1l(e);
        tail *= expl(e);
    }
    w[dim - 1] = tail;
}

static void test_simplex_map(void)
{
    double error[2] = {0}, way_back = 0;
    int good = 1;
    buffon_rng rng = buffon_rng_make(1, 61);
    for (int k = 0; k < DRAWS / 4; k++) {
        const size_t dim = k % 64 == 0 ? 1 + buffon_rng_below(&rng, DIM_MAX) : 1 + (size_t)k % 9;
        const buffon_density g = buffon_simplex(dim);
        double u[DIM_MAX], x[DIM_MAX], v[DIM_MAX], y[DIM_MAX], sum = 0, pdf;
        wide w[DIM_MAX];
        for (size_t j = 0; j < dim; j++)
            u[j] = grid(&rng, k + 3 * (int)j);
        good &= buffon_density_sample(x, NULL, u, 1, &g) == BUFFON_OK;
        good &= buffon_density_invert(v, x, 1, &g) == BUFFON_OK;
        good &= buffon_density_sample(y, NULL, v, 1, &g) == BUFFON_OK;
        good &= buffon_density_pdf(&pdf, x, 1, &g) == BUFFON_OK && pdf > 0;
        weights(w, u, dim);
        for (size_t j = 0; j < dim; j++) {
            raise_to(&error[dim > 3], (double)fabsl(x[j] - w[j]) * 0x1p53);
            raise_to(&way_back, fabs(y[j] - x[j]) * 0x1p53);
            sum += x[j];
        }
        good &= sum <= 1 + (double)dim * 0x1p-53;
    }
    tap_ok(good, "simplex: all points are inside and have a way back");
    if (LDBL_MANT_DIG >= 64) {
        report(error[0], 2, "simplex of up to 3 dimensions, coordinates in 2^-53");
        report(error[1], 4, "simplex of more, coordinates in 2^-53");
    }
    report(way_back, 32, "simplex, from points to uniforms to points, in 2^-53");
}

/* Products of small whole numbers are exact, and so are a few factorials. */
static void test_simplex_pdf(void)
{
    const double x[3] = {0.25, 0.25, 0.25};
    double pdf, last = 0;
    int good = 1;
    wide factorial = 1;
    for (size_t dim = 1; dim <= DIM_MAX; dim++) {
        const buffon_density g = buffon_simplex(dim);
        double zeros[DIM_MAX] = {0};
        factorial *= (wide)dim;
        good &= buffon_density_pdf(&pdf, zeros, 1, &g) == BUFFON_OK;
        if (LDBL_MANT_DIG >= 64 || dim < 19)
            good &= fabsl(pdf - factorial) <= 1.01L * (wide)ulp(factorial);
        last = pdf;
    }
    tap_ok(good, "simplex: g = dim! within 1 ulp");
    tap_ok(last == 0x1.52f5ca5f8f3efp1019 || fabs(last / 7.257415615307994e306 - 1) < 1e-15,
           "simplex: 170! = 7.257415615307994e306");
    const buffon_density g = buffon_simplex(3);
    good = buffon_density_pdf(&pdf, x, 1, &g) == BUFFON_OK && pdf == 6;
    const double outside[3][3] = {{0.5, 0.5, 1e-15}, {-1e-300, 0.1, 0.1}, {0.1, NAN, 0.1}};
    for (int k = 0; k < 3; k++)
        good &= buffon_density_pdf(&pdf, outside[k], 1, &g) == BUFFON_OK && pdf == 0;
    tap_ok(good, "simplex: where it ends");
}

/* ---- pieces ---- */

typedef struct piece {
    buffon_density g;
    double origin[3], edge[3][3]; /* exact */
    double size;
    wide measure; /* of the simplex */
} piece;

static double whole(buffon_rng *rng, int bits)
{
    return (double)buffon_rng_below(rng, (uint64_t)2 << bits) - ldexp(1, bits);
}

static wide determinant(double (*e)[3])
{
    wide c[3];
    for (int j = 0; j < 3; j++)
        c[j] = (wide)e[0][(j + 1) % 3] * e[1][(j + 2) % 3] -
               (wide)e[0][(j + 2) % 3] * e[1][(j + 1) % 3];
    return c[0] * e[2][0] + c[1] * e[2][1] + c[2] * e[2][2];
}

static wide area(double (*e)[3])
{
    wide sum = 0;
    for (int j = 0; j < 3; j++) {
        const wide c = (wide)e[0][(j + 1) % 3] * e[1][(j + 2) % 3] -
                       (wide)e[0][(j + 2) % 3] * e[1][(j + 1) % 3];
        sum += c * c;
    }
    return sqrtl(sum);
}

static wide length(const double *e)
{
    return sqrtl((wide)e[0] * e[0] + (wide)e[1] * e[1] + (wide)e[2] * e[2]);
}

/* Corners in whole numbers, so that edges and products are exact: small pieces up to 2^32 of their
 * size from the origin; every third a needle or sliver; then all of it times a power of two. */
static int piece_make(piece *p, buffon_rng *rng, int k, size_t edges, int box)
{
    const int far = (int)buffon_rng_below(rng, 50), scale = (int)buffon_rng_below(rng, 600) - 300;
    double corner[4][3];
    for (int j = 0; j < 3; j++) {
        p->origin[j] = whole(rng, far);
        for (size_t e = 0; e < 3; e++)
            p->edge[e][j] = e < edges ? whole(rng, 16) : 0;
        if (k % 3 == 0)
            p->edge[1][j] = edges > 1 ? 3 * p->edge[0][j] + (j == 1) : 0;
        if (k % 3 == 1 && edges > 2)
            p->edge[2][j] = p->edge[0][j] - p->edge[1][j] + (j == 2);
    }
    if (edges == 2 && k % 2)
        p->edge[0][2] = p->edge[1][2] = 0;
    p->measure = edges == 1   ? length(p->edge[0])
                 : edges == 2 ? area(p->edge)
                              : fabsl(determinant(p->edge));
    p->measure = ldexpl(p->measure / (box ? 1 : edges == 3 ? 6 : (wide)edges), scale * (int)edges);
    p->size = 0;
    for (int j = 0; j < 3; j++) {
        p->origin[j] = ldexp(p->origin[j], scale);
        p->size = fmax(p->size, fabs(p->origin[j]));
        corner[0][j] = p->origin[j];
        for (size_t e = 0; e < edges; e++) {
            p->edge[e][j] = ldexp(p->edge[e][j], scale);
            corner[e + 1][j] = p->origin[j] + p->edge[e][j];
            p->size = fmax(p->size, fabs(p->edge[e][j]));
        }
    }
    if (edges == 1)
        p->g = buffon_segment_between(corner[0], corner[1]);
    else if (edges == 2 && box)
        p->g = buffon_parallelogram(p->origin, p->edge[0], p->edge[1]);
    else if (edges == 2 && k % 2)
        p->g = buffon_triangle_flat(corner[0], corner[1], corner[2]);
    else if (edges == 2)
        p->g = buffon_triangle(corner[0], corner[1], corner[2]);
    else if (box)
        p->g = buffon_parallelepiped(p->origin, p->edge[0], p->edge[1], p->edge[2]);
    else
        p->g = buffon_tetrahedron(corner[0], corner[1], corner[2], corner[3]);
    return p->measure > 0 ? p->g.status == BUFFON_OK : p->g.status == BUFFON_E_SHAPE;
}

static void point(wide *x, const piece *p, const double *u, int box)
{
    wide w[3] = {u[0], 0, 0};
    const size_t edges = p->g.uniforms;
    if (box)
        for (size_t e = 0; e < edges; e++)
            w[e] = u[e];
    else
        weights(w, u, edges);
    for (size_t j = 0; j < 3; j++) {
        x[j] = p->origin[j];
        for (size_t e = 0; e < edges; e++)
            x[j] += w[e] * p->edge[e][j];
    }
}

/* The point just outside beyond each wall, as seen from the middle: along the normal by `step`. */
static int ends(const piece *p)
{
    const size_t edges = p->g.uniforms;
    const double beyond = 1e-3;
    int good = 1;
    for (size_t e = 0; e < edges; e++) {
        double x[3], pdf;
        for (size_t j = 0; j < 3; j++)
            x[j] = p->origin[j] + 0.5 * (edges > 1) * p->edge[(e + 1) % edges][j] -
                   beyond * p->edge[e][j];
        good &= buffon_density_pdf(&pdf, x, 1, &p->g) == BUFFON_OK && pdf == 0;
        for (size_t j = 0; j < 3; j++)
            x[j] = p->origin[j] + (1 + beyond) * p->edge[e][j];
        good &= buffon_density_pdf(&pdf, x, 1, &p->g) == BUFFON_OK && pdf == 0;
    }
    return good;
}

static void test_pieces(size_t edges, int box, const char *name)
{
    double error = 0, density = 0;
    int made = 1, inside = 1, closed = 1;
    buffon_rng rng = buffon_rng_make(2 + edges, box ? 63 : 62);
    for (int k = 0; k < DRAWS / 4; k++) {
        piece p;
        double u[3], x[3], v[3], pdf, again;
        wide exact[3];
        made &= piece_make(&p, &rng, k, edges, box);
        if (p.g.status != BUFFON_OK)
            continue;
        for (size_t e = 0; e < edges; e++)
            u[e] = grid(&rng, k / (1 + (int)e));
        made &= buffon_density_sample(x, &pdf, u, 1, &p.g) == BUFFON_OK;
        point(exact, &p, u, box);
        for (size_t j = 0; j < p.g.dim; j++)
            raise_to(&error, (double)fabsl(x[j] - exact[j]) / p.size * 0x1p52);
        raise_to(&density, (double)fabsl(pdf - 1 / p.measure) / ulp(1 / p.measure));
        inside &= buffon_density_pdf(&again, x, 1, &p.g) == BUFFON_OK && again == pdf;
        made &= buffon_density_invert(v, x, 1, &p.g) == BUFFON_OK;
        for (size_t e = 0; e < edges; e++)
            made &= v[e] > 0 && v[e] < 1;
        /* Where rounding does not reach: shapes of their own size near the origin. */
        double most = 0;
        for (size_t j = 0; j < 3; j++)
            most = fmax(most, fabs(p.edge[0][j]));
        if (k % 3 == 2 && p.size < 64 * most)
            closed &= p.measure > 1e-2L * powl(most, edges) ? ends(&p) : 1;
    }
    tap_ok(made, "%s: made, drawn and led back, or refused where there is no measure", name);
    tap_ok(inside, "%s: the pdf at a point is that with the point, of needles and far off too",
           name);
    tap_ok(closed, "%s: 0 beyond each side and end", name);
    if (LDBL_MANT_DIG >= 64) {
        report(error, 4, "points, in 2^-52 of the largest coordinate");
        report(density, 2, "pdf, in ulp");
    }
}

/* Corners whose differences are no doubles: twice the area is 2^-50 - 2^-60 - 2^-110. */
static void test_needle(void)
{
    const double a[2] = {1, 0}, b[2] = {0x1p-60, 1}, c[2] = {0, 1 + 0x1p-50};
    const double exact = 2 / (0x1p-50 - 0x1p-60);
    const double point[2] = {0, 1};
    const buffon_density g = buffon_triangle_flat(a, b, c);
    double pdf;
    tap_ok(buffon_density_pdf(&pdf, point, 1, &g) == BUFFON_OK && fabs(pdf / exact - 1) < 4e-16,
           "the area of a needle is that of its corners, not of rounded edges");
}

/* Back to uniforms and to points again; and the uniforms themselves, but where a corner is near,
 * which determines them badly. */
static void test_way_back(void)
{
    const double o[3] = {0.5, -1, 2}, a[3] = {1, 2, -0.5}, b[3] = {-2, 0.25, 1};
    const double c[3] = {0.1, 0.2, 3};
    const buffon_density g[6] = {buffon_segment_between(a, b),  buffon_triangle(o, a, b),
                                 buffon_triangle_flat(o, a, b), buffon_tetrahedron(o, a, b, c),
                                 buffon_parallelogram(o, a, b), buffon_parallelepiped(o, a, b, c)};
    double worst = 0, uniforms = 0;
    buffon_rng rng = buffon_rng_make(3, 64);
    for (int k = 0; k < DRAWS; k++) {
        double u[3], x[3], v[3], y[3];
        const buffon_density *one = &g[k % 6];
        const size_t edges = one->uniforms;
        for (size_t e = 0; e < edges; e++)
            u[e] = k % 2 ? grid(&rng, k / (1 + (int)e)) : 0.75 * buffon_rng_next(&rng);
        if (buffon_density_sample(x, NULL, u, 1, one) != BUFFON_OK ||
            buffon_density_invert(v, x, 1, one) != BUFFON_OK ||
            buffon_density_sample(y, NULL, v, 1, one) != BUFFON_OK)
            worst = INFINITY;
        for (size_t e = 0; e < edges && k % 2 == 0; e++)
            raise_to(&uniforms, fabs(u[e] - v[e]) * 0x1p52);
        for (size_t j = 0; j < one->dim; j++)
            raise_to(&worst, fabs(y[j] - x[j]) * 0x1p52);
    }
    report(worst, 32, "from points of plain pieces to uniforms to points, in 2^-52");
    report(uniforms, 32, "the uniforms, in 2^-52");
}

/* Off the line or plane by little and by less; corners and middles of edges. */
static void test_edges(void)
{
    const double a[3] = {1, 2, 3}, b[3] = {2, 4, 5}, c[3] = {-1, 2, 7}; /* |b - a| = 3 */
    const buffon_density segment = buffon_segment_between(a, b),
                         triangle = buffon_triangle(a, b, c);
    double x[3] = {1.5, 3, 4}, pdf[2];
    tap_ok(buffon_density_pdf(pdf, a, 1, &segment) == BUFFON_OK && pdf[0] == 1.0 / 3 &&
               buffon_density_pdf(pdf, b, 1, &segment) == BUFFON_OK && pdf[0] == 1.0 / 3,
           "ends count as inside, g = 1 / length");
    tap_ok(buffon_density_pdf(pdf, a, 1, &triangle) == BUFFON_OK && pdf[0] > 0 &&
               buffon_density_pdf(pdf, c, 1, &triangle) == BUFFON_OK && pdf[0] > 0 &&
               buffon_density_pdf(pdf, x, 1, &triangle) == BUFFON_OK && pdf[0] > 0,
           "corners and edges count as inside");
    const double off[2][2] = {{1e-15, 1}, {1e-13, 0}};
    int good = 1;
    for (int k = 0; k < 2; k++) {
        x[0] = 1.5 + 2 * off[k][0];
        x[1] = 3 - off[k][0];
        good &= buffon_density_pdf(pdf, x, 1, &segment) == BUFFON_OK;
        good &= (pdf[0] > 0) == (off[k][1] > 0);
    }
    tap_ok(good, "a point 1e-13 off the segment is not on it, one 2e-15 off is");
    x[0] = 0.75;
    x[2] = 4.5;
    good = 1;
    for (int k = -1; k <= 1; k += 2) {
        x[1] = 2.5 + k * 1e-13;
        good &= buffon_density_pdf(pdf, x, 1, &triangle) == BUFFON_OK && pdf[0] == 0;
    }
    x[1] = 2.5;
    good &= buffon_density_pdf(pdf, x, 1, &triangle) == BUFFON_OK && pdf[0] == 1.0 / 6;
    tap_ok(good, "a point 1e-13 off the triangle, on either side, is not on it, g = 1 / area");
}

static void test_refused(void)
{
    const double a[3] = {1, 2, 3}, b[3] = {3, 5, 9}, c[3] = {0, 0, 1}, line[3] = {5, 8, 15};
    const double bad[3] = {1, NAN, 3}, endless[3] = {1, 2, INFINITY}, zero[3] = {0};
    const double small[3] = {1e-302, 0, 0}, large[3] = {0, 2e301, 0};
    int shape = 1, null = 1;
    shape &= buffon_segment_between(a, a).status == BUFFON_E_SHAPE;
    shape &= buffon_segment_between(a, bad).status == BUFFON_E_SHAPE;
    shape &= buffon_segment_between(endless, a).status == BUFFON_E_SHAPE;
    shape &= buffon_segment_between(zero, small).status == BUFFON_E_SHAPE;
    shape &= buffon_segment_between(zero, large).status == BUFFON_E_SHAPE;
    shape &= buffon_triangle(a, b, line).status == BUFFON_E_SHAPE;
    shape &= buffon_triangle(a, b, b).status == BUFFON_E_SHAPE;
    shape &= buffon_triangle(bad, b, c).status == BUFFON_E_SHAPE;
    shape &= buffon_triangle_flat(zero, a, zero).status == BUFFON_E_SHAPE;
    shape &= buffon_tetrahedron(a, b, line, c).status == BUFFON_E_SHAPE;
    shape &= buffon_tetrahedron(a, b, c, endless).status == BUFFON_E_SHAPE;
    shape &= buffon_parallelogram(a, b, b).status == BUFFON_E_SHAPE;
    shape &= buffon_parallelogram(a, b, zero).status == BUFFON_E_SHAPE;
    shape &= buffon_parallelogram(bad, a, b).status == BUFFON_E_SHAPE;
    shape &= buffon_parallelepiped(a, b, c, c).status == BUFFON_E_SHAPE;
    shape &= buffon_parallelepiped(a, b, c, bad).status == BUFFON_E_SHAPE;
    tap_ok(shape, "what has no measure, or is not finite, or too small or large, is refused");
    null &= buffon_segment_between(NULL, a).status == BUFFON_E_NULL;
    null &= buffon_triangle(a, b, NULL).status == BUFFON_E_NULL;
    null &= buffon_triangle_flat(a, NULL, b).status == BUFFON_E_NULL;
    null &= buffon_tetrahedron(a, b, c, NULL).status == BUFFON_E_NULL;
    null &= buffon_parallelogram(NULL, a, b).status == BUFFON_E_NULL;
    null &= buffon_parallelogram(a, b, NULL).status == BUFFON_E_NULL;
    null &= buffon_parallelepiped(a, b, c, NULL).status == BUFFON_E_NULL;
    tap_ok(null, "NULL is refused");
    tap_ok(buffon_simplex(0).status == BUFFON_E_DIM && buffon_simplex(171).status == BUFFON_E_DIM,
           "simplices of 0 and of 171 dimensions are refused");
}

int main(void)
{
    test_simplex_map();
    test_simplex_pdf();
    test_pieces(1, 0, "segment");
    test_pieces(2, 0, "triangle");
    test_pieces(3, 0, "tetrahedron");
    test_pieces(2, 1, "parallelogram");
    test_pieces(3, 1, "parallelepiped");
    test_needle();
    test_way_back();
    test_edges();
    test_refused();
    return tap_done();
}
