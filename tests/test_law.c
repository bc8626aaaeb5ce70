/* The samplers against their densities, from fixed seeds.
 *
 * Each density comes with a chart: the unit square laid over its support so that equal areas are
 * equal areas, written here with libm and on its own, from the definition of the shape. In the
 * chart the points must follow the density that the library states (cells), their coordinates the
 * laws known in closed form (Kolmogorov-Smirnov), and the stated density must integrate to 1.
 */
#include <buffon/buffon.h>
#include <float.h>

#include "law.h"

enum { SIDE = 32, CELLS = SIDE * SIDE, POINTS = 1 << 20, CHUNK = 1 << 12, SHORT = 1 << 17 };

typedef struct chart {
    const char *name;
    double area;                                  /* of the support */
    double radius, h, axis[3], across[3], up[3];  /* of the shape: across, up complete the axis */
    const double *lo, *hi;
    /* The point at v of the square, and v of a point. */
    void (*point)(double *x, const double v[2], const struct chart *c);
    void (*coordinates)(double v[2], const double *x, const struct chart *c);
    /* Takes v[0], which has the law of the density, to a uniform. NULL: it is one. */
    double (*level)(double v, const struct chart *c);
    /* Whether x is in the support, exactly: that of the shape. */
    int (*inside)(const double *x, const struct chart *c);
} chart;

static double turns(double y, double x)
{
    const double t = atan2(y, x) / (2 * LAW_PI);
    return t < 0 ? t + 1 : t;
}

static void disk_point(double *x, const double v[2], const chart *c)
{
    x[0] = c->radius * sqrt(v[0]) * cos(2 * LAW_PI * v[1]);
    x[1] = c->radius * sqrt(v[0]) * sin(2 * LAW_PI * v[1]);
}

static void disk_coordinates(double v[2], const double *x, const chart *c)
{
    v[0] = (x[0] * x[0] + x[1] * x[1]) / (c->radius * c->radius);
    v[1] = turns(x[1], x[0]);
}

static int disk_inside(const double *x, const chart *c)
{
    return x[0] * x[0] + x[1] * x[1] <= c->radius * c->radius;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Depth below the pole of the axis in units of h, and the angle about the axis. */
static void cap_point(double *x, const double v[2], const chart *c)
{
    const double w = c->h * v[0], s = sqrt(w * (2 - w)), a = 2 * LAW_PI * v[1];
    for (int j = 0; j < 3; j++)
        x[j] = s * cos(a) * c->across[j] + s * sin(a) * c->up[j] + (1 - w) * c->axis[j];
}

static void cap_coordinates(double v[2], const double *x, const chart *c)
{
    const double d[3] = {x[0] - c->axis[0], x[1] - c->axis[1], x[2] - c->axis[2]};
    v[0] = 0.5 * dot(d, d) / c->h;
    v[1] = turns(dot(d, c->up), dot(d, c->across));
}

static int cap_inside(const double *x, const chart *c)
{
    const double chord[3] = {x[0] - c->axis[0], x[1] - c->axis[1], x[2] - c->axis[2]};
    return fabs(dot(x, x) - 1) < 8 * DBL_EPSILON &&
           sqrt(dot(chord, chord)) <= sqrt(2 * c->h) + 4 * DBL_EPSILON;
}

/* P(depth <= v) on the cosine hemisphere: 1 - z^2. */
static double cosine_level(double v, const chart *c)
{
    (void)c;
    return v * (2 - v);
}

static int cosine_inside(const double *x, const chart *c)
{
    return fabs(dot(x, x) - 1) < 8 * DBL_EPSILON && dot(x, c->axis) > 0;
}

static void box_point(double *x, const double v[2], const chart *c)
{
    for (int j = 0; j < 2; j++)
        x[j] = c->lo[j] + v[j] * (c->hi[j] - c->lo[j]);
}

static void box_coordinates(double v[2], const double *x, const chart *c)
{
    for (int j = 0; j < 2; j++)
        v[j] = (x[j] - c->lo[j]) / (c->hi[j] - c->lo[j]);
}

static int box_inside(const double *x, const chart *c)
{
    return x[0] > c->lo[0] && x[0] < c->hi[0] && x[1] > c->lo[1] && x[1] < c->hi[1];
}

/* The share of the density in each cell: its value at the middle, where it is constant or linear in
 * v[0] and there is nothing to gain from more. */
static double stated_masses(double *mass, const chart *c, const buffon_density *g)
{
    double sum = 0;
    for (int k = 0; k < CELLS; k++) {
        const double v[2] = {(k / SIDE + 0.5) / SIDE, (k % SIDE + 0.5) / SIDE};
        double x[3];
        c->point(x, v, c);
        if (buffon_density_pdf(&mass[k], x, 1, g) != BUFFON_OK)
            return NAN;
        mass[k] *= c->area / CELLS;
        sum += mass[k];
    }
    return sum;
}

static double level_points[2][SHORT];

/* Counts cells, keeps the coordinates of the first points, and returns how many points lie outside
 * the shape or have another pdf than the density states for them. */
static uint64_t draw(uint64_t *count, const chart *c, const buffon_density *g, uint64_t seed)
{
    static double u[2 * CHUNK], x[3 * CHUNK], pdf[CHUNK], again[CHUNK];
    buffon_rng rng = buffon_rng_make(seed, 20);
    uint64_t bad = 0;
    for (size_t done = 0; done < POINTS; done += CHUNK) {
        buffon_rng_fill(u, 2 * CHUNK, &rng);
        if (buffon_density_sample(x, pdf, u, CHUNK, g) != BUFFON_OK ||
            buffon_density_pdf(again, x, CHUNK, g) != BUFFON_OK)
            return UINT64_MAX;
        for (size_t i = 0; i < CHUNK; i++) {
            const double p[3] = {x[i], x[CHUNK + i], g->dim > 2 ? x[2 * CHUNK + i] : 0};
            double v[2];
            c->coordinates(v, p, c);
            /* The stated pdf at a grazing angle is as good as the point is. */
            bad += !c->inside(p, c) ||
                   !(fabs(pdf[i] - again[i]) <= 4 * DBL_EPSILON * (pdf[i] + (c->level != NULL)));
            if (!(v[0] >= 0 && v[0] < 1.001 && v[1] >= 0 && v[1] <= 1))
                return UINT64_MAX;
            const int a = (int)(v[0] * SIDE), b = (int)(v[1] * SIDE);
            count[(a < SIDE ? a : SIDE - 1) * SIDE + (b < SIDE ? b : SIDE - 1)]++;
            if (done + i < SHORT) {
                level_points[0][done + i] = fmin(c->level ? c->level(v[0], c) : v[0], 1);
                level_points[1][done + i] = fmin(v[1], 1);
            }
        }
    }
    return bad;
}

static void check(const chart *c, const buffon_density *g, uint64_t seed)
{
    static double mass[CELLS];
    static uint64_t count[CELLS];
    memset(count, 0, sizeof count);
    const double sum = stated_masses(mass, c, g);
    tap_ok(fabs(sum - 1) < 1e-12, "%s: the pdf integrates to 1", c->name);
    const uint64_t bad = draw(count, c, g, seed);
    tap_ok(bad == 0, "%s: every point lies inside, with the pdf stated there", c->name);
    law_ok(law_cells(count, mass, CELLS), "%s: points follow the pdf", c->name);
    law_ok(law_uniform(level_points[0], SHORT), "%s: law of the first coordinate", c->name);
    law_ok(law_uniform(level_points[1], SHORT), "%s: law of the second coordinate", c->name);
}

/* Completes a unit axis to a frame that owes nothing to the library's. */
static void set_axis(chart *c, const double axis[3])
{
    const double length = sqrt(dot(axis, axis));
    const int k = fabs(axis[0]) < fabs(axis[1]) ? (fabs(axis[0]) < fabs(axis[2]) ? 0 : 2)
                                                : (fabs(axis[1]) < fabs(axis[2]) ? 1 : 2);
    double s = 0;
    for (int j = 0; j < 3; j++)
        c->axis[j] = axis[j] / length;
    for (int j = 0; j < 3; j++)
        c->across[j] = (j == k) - c->axis[k] * c->axis[j];
    s = sqrt(dot(c->across, c->across));
    for (int j = 0; j < 3; j++)
        c->across[j] /= s;
    for (int j = 0; j < 3; j++)
        c->up[j] = c->axis[(j + 1) % 3] * c->across[(j + 2) % 3] -
                   c->axis[(j + 2) % 3] * c->across[(j + 1) % 3];
}

static void check_box(void)
{
    const double lo[2] = {-1, 5}, hi[2] = {2, 5.125};
    const chart c = {.name = "box", .area = 3 * 0.125, .lo = lo, .hi = hi, .point = box_point,
                     .coordinates = box_coordinates, .inside = box_inside};
    const buffon_density g = buffon_box(lo, hi, 2);
    check(&c, &g, 1);
    const buffon_density sides[2] = {buffon_segment(lo[0], hi[0]), buffon_segment(lo[1], hi[1])};
    const buffon_density product = buffon_density_product(sides, 2);
    chart d = c;
    d.name = "product of two segments";
    check(&d, &product, 2);
}

static void check_disks(void)
{
    chart c = {.name = "disk", .radius = 1.5, .area = LAW_PI * 2.25, .point = disk_point,
               .coordinates = disk_coordinates, .inside = disk_inside};
    const buffon_density polar = buffon_disk(1.5), concentric = buffon_disk_concentric(1.5);
    check(&c, &polar, 3);
    c.name = "concentric disk";
    check(&c, &concentric, 4);
}

static void check_cap(const char *name, const buffon_density *g, double h, const double axis[3],
                      uint64_t seed)
{
    chart c = {.name = name, .h = h, .area = 2 * LAW_PI * h, .point = cap_point,
               .coordinates = cap_coordinates, .inside = cap_inside};
    set_axis(&c, axis);
    check(&c, g, seed);
}

static void check_sphere_and_caps(void)
{
    const double up[3] = {0, 0, 1}, down[3] = {0, 0, -2}, aslant[3] = {-3, 2, -0.5};
    const double from[3] = {1, 2, 3}, centre[3] = {1 - 6, 2 + 4, 3 - 1};
    buffon_density g = buffon_sphere();
    check_cap("sphere", &g, 2, up, 5);
    g = buffon_cap(0.25);
    check_cap("cap above a plane", &g, 0.75, up, 6);
    g = buffon_cap(-0.75);
    check_cap("cap that is most of the sphere", &g, 1.75, up, 7);
    g = buffon_cap_about(0.5, aslant);
    check_cap("cap about an axis", &g, 0.5, aslant, 8);
    g = buffon_cap_angle(LAW_PI / 3, down);
    check_cap("cap of an angle, downwards", &g, 0.5, down, 9);
    g = buffon_cap_height(1e-8, aslant);
    check_cap("small cap by its height", &g, 1e-8, aslant, 10);
    g = buffon_cap_of_sphere(from, centre, sqrt(53.0) / 2);
    const double seen[3] = {-6, 4, -1};
    check_cap("sphere seen from a point", &g, 1 - sqrt(0.75), seen, 11);
    g = buffon_hemisphere();
    check_cap("hemisphere", &g, 1, up, 12);
    g = buffon_hemisphere_about(aslant);
    check_cap("hemisphere about an axis", &g, 1, aslant, 13);
}

static void check_cosine(void)
{
    const double up[3] = {0, 0, 1}, aslant[3] = {1, -1, -4};
    chart c = {.name = "cosine hemisphere", .h = 1, .area = 2 * LAW_PI, .point = cap_point,
               .coordinates = cap_coordinates, .level = cosine_level, .inside = cosine_inside};
    buffon_density g = buffon_hemisphere_cosine();
    set_axis(&c, up);
    check(&c, &g, 14);
    c.name = "cosine hemisphere about an axis";
    g = buffon_hemisphere_cosine_about(aslant);
    set_axis(&c, aslant);
    check(&c, &g, 15);
}

/* One dimension: cells between quantiles that the closed form gives, whose masses come from the pdf
 * by Simpson's rule, which is exact enough on so small a cell. */
typedef struct line_law {
    const char *name;
    double (*cdf)(double x, void *ctx);
    double (*edge)(double u, void *ctx); /* any increasing map of [0, 1] onto most of the support */
    void *ctx;
} line_law;

static double line_mass(const buffon_density *g, double a, double b)
{
    enum { PIECES = 16 };
    double sum = 0;
    for (int k = 0; k < PIECES; k++) {
        const double from = a + (b - a) * k / PIECES, to = a + (b - a) * (k + 1) / PIECES;
        const double x[3] = {from + (to - from) * 1e-9, 0.5 * (from + to), to - (to - from) * 1e-9};
        double f[3];
        if (buffon_density_pdf(f, x, 3, g) != BUFFON_OK)
            return NAN;
        sum += (to - from) / 6 * (f[0] + 4 * f[1] + f[2]);
    }
    return sum;
}

static void check_line(const line_law *law, const buffon_density *g, uint64_t seed)
{
    enum { N = 1 << 18, BINS = 256 };
    static double u[N], x[N], level[N], edge[BINS + 1], mass[BINS];
    static uint64_t count[BINS];
    double sum = 0;
    buffon_rng rng = buffon_rng_make(seed, 21);
    memset(count, 0, sizeof count);
    buffon_rng_fill(u, N, &rng);
    tap_ok(buffon_density_sample(x, NULL, u, N, g) == BUFFON_OK, "%s: samples", law->name);
    for (int k = 0; k <= BINS; k++)
        edge[k] = law->edge((double)k / BINS, law->ctx);
    for (int k = 0; k < BINS; k++)
        sum += mass[k] = line_mass(g, edge[k], edge[k + 1]);
    tap_ok(fabs(sum - 1) < 1e-7, "%s: the pdf integrates to 1", law->name);
    for (size_t i = 0; i < N; i++) {
        int a = 0, b = BINS;
        while (b - a > 1)
            *(x[i] < edge[(a + b) / 2] ? &b : &a) = (a + b) / 2;
        count[a]++;
        level[i] = law->cdf(x[i], law->ctx);
    }
    law_ok(law_cells(count, mass, BINS), "%s: points follow the pdf", law->name);
    law_ok(law_uniform(level, N), "%s: points follow the CDF", law->name);
}

static double exponential_quantile(double u, void *ctx)
{
    (void)ctx;
    return -log1p(-u);
}

static double exponential_cdf(double x, void *ctx)
{
    (void)ctx;
    return -expm1(-x);
}

static double exponential_pdf(double x, void *ctx)
{
    (void)ctx;
    return exp(-x);
}

static double exponential_edge(double u, void *ctx)
{
    (void)ctx;
    return 20 * u;
}

static double normal_cdf(double x, void *ctx)
{
    (void)ctx;
    return 0.5 * erfc(-x / sqrt(2.0));
}

static double normal_pdf(double x, void *ctx)
{
    (void)ctx;
    return exp(-0.5 * x * x) / sqrt(2 * LAW_PI);
}

static double normal_edge(double u, void *ctx)
{
    (void)ctx;
    return 14 * u - 7;
}

/* A table with uneven knots and steps, F from 3 to 8. */
static const double knots[6] = {-2, -1.5, 0, 0.25, 4, 5}, steps[6] = {3, 3.25, 5, 6.5, 7, 8};

static double table_cdf(double x, void *ctx)
{
    int k = 0;
    (void)ctx;
    while (k < 4 && x >= knots[k + 1])
        k++;
    const double part = (x - knots[k]) / (knots[k + 1] - knots[k]);
    return (steps[k] + part * (steps[k + 1] - steps[k]) - 3) / 5;
}

/* 256 cells in fifties and one more for each piece, so that no cell straddles a knot. */
static double table_edge(double u, void *ctx)
{
    const int cell = (int)(u * 256 + 0.5), k = cell < 255 ? cell / 51 : 4;
    (void)ctx;
    return knots[k] + (knots[k + 1] - knots[k]) * (cell - 51 * k) / (k < 4 ? 51 : 52);
}

static void check_inversions(void)
{
    const buffon_inversion closed = {.quantile = exponential_quantile, .pdf = exponential_pdf};
    const buffon_inversion newton = {.cdf = exponential_cdf, .pdf = exponential_pdf,
                                     .hi = INFINITY};
    const buffon_inversion bell = {.cdf = normal_cdf, .pdf = normal_pdf};
    const buffon_inversion table = {.x = knots, .F = steps, .count = 6};
    line_law law = {"exponential by its quantile", exponential_cdf, exponential_edge, NULL};
    buffon_density g = buffon_inverse(&closed);
    check_line(&law, &g, 16);
    law.name = "exponential by its CDF";
    g = buffon_inverse(&newton);
    check_line(&law, &g, 17);
    law = (line_law){"normal by its CDF", normal_cdf, normal_edge, NULL};
    g = buffon_inverse(&bell);
    check_line(&law, &g, 18);
    law = (line_law){"table of a CDF", table_cdf, table_edge, NULL};
    g = buffon_inverse(&table);
    check_line(&law, &g, 19);
}

/* The p-values themselves, against mpmath and the tables of the limit law. */
static void check_p_values(void)
{
    tap_ok(fabs(law_chi_square(10, 5) - 0.07523524614651217) < 1e-14 &&
               fabs(law_chi_square(1, 5) - 0.9625657732472964) < 1e-14 &&
               fabs(law_chi_square(1400, 1023) / 3.16471980280305e-14 - 1) < 1e-10,
           "chi-square tails");
    tap_ok(fabs(law_kolmogorov(1.3580986393225505e-6, 1e12) - 0.05) < 1e-6 &&
               fabs(law_kolmogorov(0.999999e-6, 1e12) - law_kolmogorov(1.000001e-6, 1e12)) < 1e-5,
           "Kolmogorov tails");
    tap_ok(fabs(law_normal(1.959963984540054) - 0.05) < 1e-15, "normal tails");
}

int main(void)
{
    check_p_values();
    check_box();
    check_disks();
    check_sphere_and_caps();
    check_cosine();
    check_inversions();
    return tap_done();
}
