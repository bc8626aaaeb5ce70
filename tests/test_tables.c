/* Densities by tables of heights: a point's F, in extended precision from the heights themselves,
 * is the uniform it came from. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "../src/shares.h"
#include "grid.h"
#include "refused.h"
#include "tap.h"

typedef long double wide;

#define WIDE_PI 3.14159265358979323846264338327950288L
#define HAVE_WIDE (LDBL_MANT_DIG >= 64)

enum { MOST = 2000, DRAWS = 20000 };

static uint64_t block[16 * MOST], moved[16 * MOST];
static double edge[MOST + 1], height[MOST + 1];

static double ulp(wide x)
{
    const double a = fabs((double)x);
    return a < DBL_MIN ? 0x1p-1074 : nextafter(a, INFINITY) - a;
}

static void at_most(double worst, double limit, const char *law, const char *what)
{
    if (!HAVE_WIDE)
        tap_ok(1, "%s: %s # SKIP long double is a double", law, what);
    else if (!tap_ok(worst <= limit, "%s: %s", law, what))
        tap_note("worst: %.3f of %g", worst, limit);
    else
        tap_note("worst %.3f", worst);
}

/* A third of the heights are 0; those of the others differ by 2^spread, the widths likewise. */
static void fill(size_t count, int spread, double range, double most, buffon_rng *rng)
{
    double at = 0;
    for (size_t k = 0; k <= count; k++) {
        const int e = (int)buffon_rng_below(rng, (uint64_t)spread + 1);
        height[k] = buffon_rng_below(rng, 3) ? most * ldexp(buffon_rng_next(rng), -e) : 0;
        edge[k] = at;
        at += ldexp(1 + buffon_rng_next(rng),
                    -(int)buffon_rng_below(rng, spread > 20 ? 20 : (uint64_t)spread + 1));
    }
    const double scale = range / edge[count];
    for (size_t k = 0; k <= count; k++)
        edge[k] = (edge[k] - 0.25 * at) * scale;
    height[count / 2] = most;
}

/* ---- the line ---- */

/* Heights a and b of piece k, which are the same for steps. */
static void ends(wide *a, wide *b, size_t k, int linear)
{
    *a = height[k];
    *b = height[linear ? k + 1 : k];
}

static wide piece_mass(size_t k, int linear)
{
    wide a, b;
    ends(&a, &b, k, linear);
    return (a + b) / 2 * ((wide)edge[k + 1] - edge[k]);
}

static size_t piece_of(double x, size_t pieces)
{
    size_t k = 0;
    while (k + 1 < pieces && edge[k + 1] <= x)
        k++;
    return k;
}

static void see_line(const char *name, const buffon_density *g, size_t pieces, int linear,
                     buffon_rng *rng)
{
    static wide below[MOST + 1];
    double off = 0, pdf_off = 0, back = 0, before = -INFINITY;
    int support = g->status == BUFFON_OK, agree = 1, order = 1;
    for (size_t k = 0; k < pieces; k++)
        below[k + 1] = below[k] + piece_mass(k, linear);
    const wide total = below[pieces];
    for (int i = 0; i < DRAWS / 5 && support; i++) {
        const double u = i == 5 ? 0x1p-1074 : i == 6 ? 0x1p-400 : grid(rng, i), twice[2] = {u, u};
        double x[2], pdf[2], again, v;
        support &= buffon_density_sample(x, pdf, twice, 2, g) == BUFFON_OK && x[0] == x[1];
        support &= buffon_density_pdf(&again, x, 1, g) == BUFFON_OK;
        support &= buffon_density_invert(&v, x, 1, g) == BUFFON_OK && v > 0 && v < 1;
        const size_t k = piece_of(x[0], pieces);
        const wide w = (wide)edge[k + 1] - edge[k], s = (x[0] - (wide)edge[k]) / w;
        const wide c = (edge[k + 1] - (wide)x[0]) / w;
        wide a, b;
        ends(&a, &b, k, linear);
        const wide exact = (a * c + b * s) / total;
        const wide F = (below[k] + w * s * (a * (1 + c) + b * s) / 2) / total;
        const double grain = (double)(exact)*ulp(x[0]);
        agree &= pdf[0] == again || (linear && fabs(pdf[0] - again) <= 4 * ulp(pdf[0]));
        support &= pdf[0] > 0 && exact > 0 && x[0] >= edge[0] && x[0] <= edge[pieces];
        off = fmax(off, (double)fabsl(F - u) / (0x1p-52 + grain));
        pdf_off = fmax(pdf_off, (double)fabsl(pdf[0] - exact) / ulp(exact));
        back = fmax(back, i < 7 && i > 3 ? 0 : fabs(v - u) / (0x1p-52 + grain));
        const double next = nextafter(u, 1), far = u + 0x1p-30;
        if (far < 1) {
            const double pair[2] = {next, far};
            const double slack = linear ? 4 * (0x1p-52 / (double)exact + ulp(x[0])) : 0;
            order &=
                buffon_density_sample(x + 1, NULL, pair, 1, g) == BUFFON_OK && x[1] >= x[0] - slack;
            order &=
                buffon_density_sample(&before, NULL, pair + 1, 1, g) == BUFFON_OK && before >= x[0];
        }
    }
    tap_ok(support, "%s: points lie where g is positive", name);
    tap_ok(agree, "%s: the pdf of a sample is that at its point", name);
    tap_ok(order, linear ? "%s: x grows with u but for rounding" : "%s: x grows with u", name);
    at_most(off, 2, name, "F(x) is u");
    at_most(pdf_off, linear ? 5 : 3, name, "pdf");
    at_most(back, linear ? 6 : 4, name, "and back to u");
}

static void see_steps(const char *name, size_t count, buffon_rng *rng)
{
    const buffon_density g = buffon_piecewise_constant(block, sizeof block, edge, height, count);
    char text[80];
    snprintf(text, sizeof text, "steps, %s", name);
    see_line(text, &g, count, 0, rng);
}

static void see_lines(const char *name, size_t count, buffon_rng *rng)
{
    const buffon_density g = buffon_piecewise_linear(block, sizeof block, edge, height, count + 1);
    char text[80];
    snprintf(text, sizeof text, "lines, %s", name);
    see_line(text, &g, count, 1, rng);
}

static void test_lines(void)
{
    buffon_rng rng = buffon_rng_make(1, 42);
    const struct {
        const char *name;
        size_t count;
        int spread;
        double range, most;
    } law[] = {{"even", 100, 1, 3, 1},
               {"uneven", 1000, 20, 1, 1e300},
               {"very uneven", 60, 300, 1e-3, 1e-300},
               {"a wide range", 37, 10, 0x1p900, DBL_MAX},
               {"a narrow range", 37, 10, 0x1p-900, 0x1p-1060},
               {"two pieces", 2, 0, 1, 1},
               {"one piece", 1, 0, 2, 5}};
    for (size_t k = 0; k < sizeof law / sizeof *law; k++) {
        fill(law[k].count, law[k].spread, law[k].range, law[k].most, &rng);
        see_steps(law[k].name, law[k].count, &rng);
        see_lines(law[k].name, law[k].count, &rng);
    }
}

/* Ramps and tents that are known. */
static void test_tents(void)
{
    const double knot[] = {-1, 0, 1}, up[] = {0, 2, 0}, ramp[] = {0, 7}, wedge[] = {3, 0};
    buffon_density g = buffon_piecewise_linear(block, sizeof block, knot, up, 3);
    int mirror = g.status == BUFFON_OK, good = 1;
    buffon_rng rng = buffon_rng_make(2, 42);
    double worst = 0;
    for (int i = 0; i < DRAWS / 4; i++) {
        const double a = grid(&rng, i), u[2] = {a, 1 - a};
        double x[2];
        mirror &= buffon_density_sample(x, NULL, u, 2, &g) == BUFFON_OK && x[0] == -x[1];
        if (a < 0.5)
            worst = fmax(worst, fabs(x[0] + 1 - sqrt(2 * a)) / 0x1p-53);
    }
    tap_ok(mirror, "a tent: mirror images are exact");
    tap_ok(worst <= 2, "a tent: x is sqrt(2 u) - 1");
    g = buffon_piecewise_linear(block, sizeof block, NULL, ramp, 2);
    for (int i = 0; i < 1000; i++) {
        const double u = i == 4 ? 0x1p-1000 : grid(&rng, i);
        double x, pdf;
        good &= buffon_density_sample(&x, &pdf, &u, 1, &g) == BUFFON_OK;
        good &= fabs(x - sqrt(u)) <= 2 * ulp(x) && fabs(pdf - 2 * x) <= 4 * ulp(pdf);
    }
    g = buffon_piecewise_linear(block, sizeof block, NULL, wedge, 2);
    for (int i = 0; i < 1000; i++) {
        const double u = grid(&rng, i);
        double x, pdf;
        good &= buffon_density_sample(&x, &pdf, &u, 1, &g) == BUFFON_OK;
        good &= fabs(x - (1 - sqrt(1 - u))) <= 2 * 0x1p-53 && pdf > 0;
    }
    tap_ok(good, "ramps: sqrt(u) and 1 - sqrt(1 - u)");
}

/* Pieces of a few doubles: rounding leads to their ends, but not beyond. */
static void test_slivers(void)
{
    const double eps = DBL_EPSILON, e[] = {1, 1 + 2 * eps, 1 + 3 * eps, 1 + 5 * eps, 2};
    const double steps[] = {1 / eps, 0, 1 / eps, 1}, lines[] = {0, 1, 0, 1, 0};
    const buffon_density g[] = {buffon_piecewise_constant(block, sizeof block, e, steps, 4),
                                buffon_piecewise_linear(moved, sizeof moved, e, lines, 5)};
    buffon_rng rng = buffon_rng_make(9, 42);
    for (int t = 0; t < 2; t++) {
        int good = g[t].status == BUFFON_OK;
        for (int i = 0; i < 4000; i++) {
            const double v = grid(&rng, i), u = t && i % 2 ? 0x1p-52 * (1 + v) : v;
            double x, pdf, again;
            good &= buffon_density_sample(&x, &pdf, &u, 1, &g[t]) == BUFFON_OK && pdf > 0;
            good &= buffon_density_pdf(&again, &x, 1, &g[t]) == BUFFON_OK && pdf == again;
        }
        tap_ok(good, "%s: pieces of two doubles", g[t].ops->name);
    }
}

/* Equal pieces are found by arithmetic, others by halving: they are the same. */
static void test_even(void)
{
    enum { COUNT = 997 };
    buffon_rng rng = buffon_rng_make(3, 42);
    int same = 1;
    fill(COUNT, 3, 1, 1, &rng);
    for (int linear = 0; linear < 2; linear++) {
        for (size_t k = 0; k <= COUNT; k++)
            edge[k] = (double)k / COUNT;
        const buffon_density g =
            linear ? buffon_piecewise_linear(block, sizeof block, NULL, height, COUNT + 1)
                   : buffon_piecewise_constant(block, sizeof block, NULL, height, COUNT);
        const buffon_density h =
            linear ? buffon_piecewise_linear(moved, sizeof moved, edge, height, COUNT + 1)
                   : buffon_piecewise_constant(moved, sizeof moved, edge, height, COUNT);
        for (int i = 0; i < 3 * COUNT && same; i++) {
            const double e = edge[i / 3], u = grid(&rng, i);
            const double x = i % 3 == 0 ? e : i % 3 == 1 ? nextafter(e, -1) : nextafter(e, 2);
            double p, q, y, z, v, w;
            same &= buffon_density_pdf(&p, &x, 1, &g) == BUFFON_OK;
            same &= buffon_density_pdf(&q, &x, 1, &h) == BUFFON_OK && p == q;
            same &= linear || p == 0 ||
                    p == ((double *)((uint64_t *)((const buffon_priv_table *)g.data[0] + 1) +
                                     COUNT + 1))[COUNT + 1 + piece_of(x, COUNT)];
            same &= buffon_density_sample(&y, &p, &u, 1, &g) == BUFFON_OK;
            same &= buffon_density_sample(&z, &q, &u, 1, &h) == BUFFON_OK && y == z && p == q;
            same &= buffon_density_invert(&v, &y, 1, &g) == BUFFON_OK;
            same &= buffon_density_invert(&w, &y, 1, &h) == BUFFON_OK && v == w;
        }
    }
    tap_ok(same, "equal pieces of [0, 1]: the same as by their edges");
    const double outside[] = {-0x1p-1074, 1 + DBL_EPSILON, NAN, INFINITY, -INFINITY};
    const buffon_density g = buffon_piecewise_constant(block, sizeof block, NULL, height, COUNT);
    double pdf[5];
    int none = buffon_density_pdf(pdf, outside, 5, &g) == BUFFON_OK;
    for (int k = 0; k < 5; k++)
        none &= pdf[k] == 0;
    tap_ok(none, "steps: nothing outside");
}

/* Any point a density gives, and its pdf, lie within bounds; tables are not read beyond. */
static void test_no_uniforms(void)
{
    const double strange[] = {0, 1, -1, 2, NAN, INFINITY};
    const double h[] = {1, 2, 0, 3};
    const buffon_density g[] = {
        buffon_piecewise_constant(block, sizeof block, NULL, h, 4),
        buffon_piecewise_linear(block + 100, sizeof block - 800, NULL, h, 4),
        buffon_piecewise_grid(block + 200, sizeof block - 1600, h, 2, 2),
        buffon_environment(block + 300, sizeof block - 2400, h, 2, 2)};
    for (size_t t = 0; t < 4; t++) {
        int safe = 1;
        for (int i = 0; i < 6; i++) {
            const double u[2] = {strange[i], strange[5 - i]};
            double x[3], pdf;
            safe &= buffon_density_sample(x, &pdf, u, 1, &g[t]) == BUFFON_OK;
            safe &= fabs(x[0]) <= 1 && pdf >= 0 && pdf < 10;
        }
        tap_ok(safe, "%s: what is no uniform gives some point", g[t].ops->name);
    }
}

/* ---- the grid ---- */

static void see_grid(const char *name, size_t columns, size_t rows, buffon_rng *rng)
{
    memset(block, 0xa5, sizeof block);
    const buffon_density g = buffon_piecewise_grid(block, sizeof block, height, columns, rows);
    double off = 0, pdf_off = 0, back = 0;
    int support = g.status == BUFFON_OK, agree = 1;
    wide row[64] = {0}, total = 0;
    for (size_t k = 0; k < columns * rows; k++) {
        row[k / columns] += height[k];
        total += height[k];
    }
    for (int i = 0; i < DRAWS / 5 && support; i++) {
        double u[2], x[2], pdf, again, v[2];
        grid_pair(u, rng, i);
        support &= buffon_density_sample(x, &pdf, u, 1, &g) == BUFFON_OK;
        support &= buffon_density_pdf(&again, x, 1, &g) == BUFFON_OK;
        support &= buffon_density_invert(v, x, 1, &g) == BUFFON_OK;
        agree &= pdf == again;
        size_t c = (size_t)(x[0] * (double)columns), r = (size_t)(x[1] * (double)rows);
        while (x[0] < (double)c / (double)columns)
            c--;
        while (c + 1 < columns && x[0] >= (double)(c + 1) / (double)columns)
            c++;
        while (x[1] < (double)r / (double)rows)
            r--;
        while (r + 1 < rows && x[1] >= (double)(r + 1) / (double)rows)
            r++;
        const double here = height[r * columns + c];
        wide a = 0, b = 0;
        for (size_t k = 0; k < c; k++)
            a += height[r * columns + k];
        for (size_t k = 0; k < r; k++)
            b += row[k];
        a = (a + here * ((wide)x[0] * columns - c)) / row[r];
        b = (b + row[r] * ((wide)x[1] * rows - r)) / total;
        support &= here > 0 && pdf > 0 && x[0] < 1 && x[1] < 1;
        off = fmax(off, (double)fabsl(a - u[0]) /
                            (0x1p-52 + (double)(here * (wide)columns / row[r]) * ulp(x[0])));
        off = fmax(off, (double)fabsl(b - u[1]) /
                            (0x1p-52 + (double)(row[r] * (wide)rows / total) * ulp(x[1])));
        const wide exact = here * (wide)columns * (wide)rows / total;
        const double slack = 0x1p-63 * (double)(exact * (row[r] / here + total / row[r]));
        pdf_off = fmax(pdf_off, (double)fabsl(pdf - exact) / (ulp(exact) + slack));
        back = fmax(back, fmax(fabs(v[0] - u[0]) /
                                   (0x1p-52 + (double)(here * (wide)columns / row[r]) * ulp(x[0])),
                               fabs(v[1] - u[1]) /
                                   (0x1p-52 + (double)(row[r] * (wide)rows / total) * ulp(x[1]))));
    }
    for (size_t k = 0; k < columns * rows && support; k++) {
        const double x[2] = {((double)(k % columns) + 0.5) / (double)columns,
                             ((double)(k / columns) + 0.5) / (double)rows};
        double pdf;
        support &= buffon_density_pdf(&pdf, x, 1, &g) == BUFFON_OK;
        support &= height[k] > 0 ? pdf >= 0 : pdf == 0;
    }
    tap_ok(support, "grid, %s: points lie where g is positive", name);
    tap_ok(agree, "grid, %s: the pdf of a sample is that at its point", name);
    at_most(off, 2, name, "grid, F is u");
    at_most(pdf_off, 4, name, "grid, pdf");
    at_most(back, 4, name, "grid, and back");
}

static void test_grid(void)
{
    buffon_rng rng = buffon_rng_make(4, 42);
    fill(MOST, 2, 1, DBL_MAX, &rng);
    see_grid("37 by 29", 37, 29, &rng);
    fill(MOST, 60, 1, 1, &rng);
    for (size_t k = 0; k < 64; k++)
        height[64 * 2 + k] = 0;
    see_grid("64 by 16 with a row of 0", 64, 16, &rng);
    fill(MOST, 900, 1, 1, &rng);
    see_grid("9 by 7, very uneven", 9, 7, &rng);
    height[0] = 0x1p-1074;
    see_grid("1 by 1", 1, 1, &rng);
    const double outside[] = {-0.1, 0.5, NAN, 0.5, 1.1, 0.5};
    const double two[] = {1, 1};
    const buffon_density g = buffon_piecewise_grid(block, sizeof block, two, 2, 1);
    double pdf[3], corner[] = {1, 1};
    tap_ok(buffon_density_pdf(pdf, outside, 3, &g) == BUFFON_OK && pdf[0] == 0 && pdf[1] == 0 &&
               pdf[2] == 0 && buffon_density_pdf(pdf, corner, 1, &g) == BUFFON_OK && pdf[0] == 1,
           "grid: nothing outside, and the corner belongs to it");
}

/* ---- bilinear ---- */

/* The point of the line from a to b, from the nearer end: s, or 1 - s with `upper`. */
static wide linear_point(wide a, wide b, wide u, int *upper)
{
    const wide root = sqrtl((1 - u) * a * a + u * b * b);
    const wide s = u * (a + b) / (a + root), c = (1 - u) * (a + b) / (b + root);
    *upper = s > c;
    return *upper ? c : s;
}

static double point_error(double x, wide a, wide b, double u)
{
    int upper;
    const wide s = linear_point(a, b, u, &upper);
    return (double)(upper ? fabsl(1 - x - s) / 0x1p-52L : fabsl(x - s) / ulp(s));
}

static void test_bilinear(void)
{
    double y_off = 0, x_off = 0, pdf_off = 0, back = 0;
    int good = 1;
    buffon_rng rng = buffon_rng_make(5, 42);
    for (int i = 0; i < DRAWS; i++) {
        double v[4], u[2], x[2], pdf, again, w[2];
        const double scale = i % 7 ? 1 : i % 2 ? 0x1p1000 : 0x1p-1000;
        for (int k = 0; k < 4; k++)
            v[k] = buffon_rng_below(&rng, 3)
                       ? scale * ldexp(buffon_rng_next(&rng),
                                       -(int)buffon_rng_below(&rng, (uint64_t)i % 60 + 1))
                       : 0;
        v[i % 4] = scale;
        const buffon_density g = buffon_bilinear(v[0], v[1], v[2], v[3]);
        grid_pair(u, &rng, i);
        good &= buffon_density_sample(x, &pdf, u, 1, &g) == BUFFON_OK;
        good &= buffon_density_pdf(&again, x, 1, &g) == BUFFON_OK && again == pdf && pdf > 0;
        good &= buffon_density_invert(w, x, 1, &g) == BUFFON_OK;
        const wide y = x[1], a = (1 - y) * v[0] + y * v[2], b = (1 - y) * v[1] + y * v[3];
        const wide sum = ((wide)v[0] + v[1]) + ((wide)v[2] + v[3]);
        const wide exact = 4 * ((1 - (wide)x[0]) * a + x[0] * b) / sum;
        y_off = fmax(y_off, point_error(x[1], (wide)v[0] + v[1], (wide)v[2] + v[3], u[1]));
        x_off = fmax(x_off, point_error(x[0], a, b, u[0]));
        pdf_off = fmax(pdf_off, (double)fabsl(pdf - exact) / ulp(exact));
        back = fmax(back, fmax(fabs(w[0] - u[0]), fabs(w[1] - u[1])));
    }
    tap_ok(good, "bilinear: points lie where g is positive, which is the same at each");
    at_most(y_off, 4, "bilinear", "y");
    at_most(x_off, 4, "bilinear", "x at its y");
    at_most(pdf_off, 5, "bilinear", "pdf");
    at_most(back / 0x1p-52, 8, "bilinear", "and back");
    const buffon_density flat = buffon_bilinear(3, 3, 3, 3), ramp = buffon_bilinear(0, 1, 0, 1);
    const double u[2] = {0x1p-40, 0.7};
    double x[2], y[2], pdf[2];
    good = buffon_density_sample(x, &pdf[0], u, 1, &flat) == BUFFON_OK && x[0] == u[0] &&
           fabs(x[1] - u[1]) <= 0x1p-53 && pdf[0] == 1;
    good &= buffon_density_sample(y, &pdf[1], u, 1, &ramp) == BUFFON_OK && y[0] == 0x1p-20 &&
            fabs(pdf[1] - 0x1p-19) <= 0x1p-70;
    tap_ok(good, "bilinear: equal corners are the uniform law, two of 0 a ramp");
    const double outside[] = {-0.1, 0.5, NAN, 0.5, 1.1, 0.5};
    double p[3];
    tap_ok(buffon_density_pdf(p, outside, 3, &flat) == BUFFON_OK && p[0] + p[1] + p[2] == 0,
           "bilinear: nothing outside");
}

/* Piece k of n that holds x, and how far in it x is. */
static size_t place_in(wide *s, double x, size_t n)
{
    const wide at = (wide)x * (wide)n;
    const size_t k = at < (wide)n ? (size_t)at : n - 1;
    *s = at - (wide)k;
    return k;
}

/* The integral of a row of nodes up to x, and all of it; g there. */
static wide along(wide *all, wide *here, const wide *node, size_t n, double x)
{
    wide s, below = 0;
    const size_t at = place_in(&s, x, n - 1);
    *all = 0;
    for (size_t k = 0; k + 1 < n; k++) {
        const wide mass = (node[k] + node[k + 1]) / 2;
        below += k < at ? mass : 0;
        *all += mass;
    }
    below += s * (node[at] * (2 - s) + node[at + 1] * s) / 2;
    *here = node[at] * (1 - s) + node[at + 1] * s;
    *all /= (wide)(n - 1);
    return below / (wide)(n - 1);
}

static void see_surface(const char *name, size_t columns, size_t rows, buffon_rng *rng)
{
    static wide line[MOST], row[MOST];
    double off = 0, pdf_off = 0, back = 0;
    memset(block, 0xa5, sizeof block);
    const buffon_density g = buffon_bilinear_grid(block, sizeof block, height, columns, rows);
    int support = g.status == BUFFON_OK, agree = 1;
    for (size_t r = 0; r < rows; r++) {
        wide here;
        for (size_t c = 0; c < columns; c++)
            line[c] = height[r * columns + c];
        (void)along(&row[r], &here, line, columns, 1);
    }
    for (int i = 0; i < DRAWS / 5 && support; i++) {
        double u[2], x[2], pdf, again, v[2];
        wide here, all, total, marginal, s;
        grid_pair(u, rng, i);
        support &= buffon_density_sample(x, &pdf, u, 1, &g) == BUFFON_OK && pdf > 0;
        support &= buffon_density_pdf(&again, x, 1, &g) == BUFFON_OK;
        support &= buffon_density_invert(v, x, 1, &g) == BUFFON_OK;
        support &= x[0] >= 0 && x[0] <= 1 && x[1] >= 0 && x[1] <= 1;
        agree &= pdf == again;
        const wide b = along(&total, &marginal, row, rows, x[1]) / total;
        const size_t r = place_in(&s, x[1], rows - 1);
        for (size_t c = 0; c < columns; c++)
            line[c] = height[r * columns + c] * (1 - s) + height[(r + 1) * columns + c] * s;
        const wide a = along(&all, &here, line, columns, x[0]) / all;
        const double grain[2] = {0x1p-52 + (double)(here / all) * ulp(x[0]),
                                 0x1p-52 + (double)(marginal / total) * ulp(x[1])};
        off = fmax(off, (double)fabsl(a - u[0]) / grain[0]);
        off = fmax(off, (double)fabsl(b - u[1]) / grain[1]);
        pdf_off = fmax(pdf_off, (double)fabsl(pdf - here / total) / ulp(here / total));
        back = fmax(back, fmax(fabs(v[0] - u[0]) / grain[0], fabs(v[1] - u[1]) / grain[1]));
    }
    tap_ok(support, "surface, %s: points lie where g is positive", name);
    tap_ok(agree, "surface, %s: the pdf of a sample is that at its point", name);
    at_most(off, 2, name, "surface, F is u");
    at_most(pdf_off, 5, name, "surface, pdf");
    at_most(back, 4, name, "surface, and back");
}

static void test_surface(void)
{
    buffon_rng rng = buffon_rng_make(10, 42);
    fill(MOST, 2, 1, DBL_MAX, &rng);
    see_surface("37 by 29", 37, 29, &rng);
    fill(MOST, 30, 1, 0x1p-1040, &rng);
    memset(height + 5 * 40, 0, 80 * sizeof *height);
    see_surface("40 by 20 with two rows of 0", 40, 20, &rng);
    fill(MOST, 900, 1, 1, &rng);
    see_surface("9 by 7, very uneven", 9, 7, &rng);
    memset(height, 0, sizeof height);
    height[3 * 5 + 2] = 1;
    see_surface("a peak", 5, 6, &rng);
    height[0] = 1;
    see_surface("a corner", 2, 2, &rng);
    const double flat[4] = {2, 2, 2, 2}, two[4] = {1, 4, 3, 0.5};
    const buffon_density h = buffon_bilinear_grid(block, sizeof block, flat, 2, 2);
    const buffon_density g = buffon_bilinear_grid(moved, sizeof moved, two, 2, 2);
    const buffon_density one = buffon_bilinear(1, 4, 3, 0.5);
    int good = 1;
    for (int i = 0; i < 1000; i++) {
        double u[2], x[2], y[2], p[2];
        grid_pair(u, &rng, i);
        good &= buffon_density_sample(x, &p[0], u, 1, &h) == BUFFON_OK;
        good &= fabs(x[0] - u[0]) <= 0x1p-52 && fabs(x[1] - u[1]) <= 0x1p-52 && p[0] == 1;
        good &= buffon_density_sample(x, &p[0], u, 1, &g) == BUFFON_OK;
        good &= buffon_density_sample(y, &p[1], u, 1, &one) == BUFFON_OK;
        good &= fabs(x[0] - y[0]) <= 0x1p-49 && fabs(x[1] - y[1]) <= 0x1p-50;
    }
    tap_ok(good, "surface: of one cell, as buffon_bilinear");
    /* Where g is 0 on a line, at uniforms that lead there, and past the last column with any. */
    const double cross[9] = {1, 0, 1, 0, 0, 0, 1, 0, 1}, left[8] = {1, 2, 0, 0, 3, 1, 0, 0};
    const double gap[8] = {1, 0, 1, 1, 1, 0, 1, 1}, half[2] = {0.5, 0.5}, third[2] = {1 / 3.0, 0.5};
    const buffon_density c = buffon_bilinear_grid(block, sizeof block, cross, 3, 3);
    double x[2], pdf;
    good = buffon_density_sample(x, &pdf, half, 1, &c) == BUFFON_OK && pdf > 0;
    const buffon_density third_at = buffon_bilinear_grid(block, sizeof block, gap, 4, 2);
    good &= buffon_density_pdf(&pdf, third, 1, &third_at) == BUFFON_OK && pdf > 0 && pdf < 1e-15;
    const buffon_density l = buffon_bilinear_grid(block, sizeof block, left, 4, 2);
    for (int i = 0; i < 2000; i++) {
        const double u[2] = {1 - 0x1p-53, buffon_rng_next(&rng)};
        good &= buffon_density_sample(x, &pdf, u, 1, &l) == BUFFON_OK && pdf > 0 && x[0] < 0.67;
    }
    tap_ok(good, "surface: lines and corners where g is 0 are not drawn");
}

/* ---- the sky ---- */

/* An image and what is true of it: where its rows begin below the north pole, their heights, what
 * each row is worth, and the whole. */
typedef struct sky {
    size_t width, rows;
    wide depth[MOST + 1], band[MOST], row[MOST], total;
} sky;

static void look_up(sky *s, size_t width, size_t rows)
{
    const wide step = WIDE_PI / (2 * (wide)rows);
    memset(s, 0, sizeof *s);
    s->width = width;
    s->rows = rows;
    for (size_t r = 0; r <= rows; r++)
        s->depth[r] = 2 * sinl(step * (wide)r) * sinl(step * (wide)r);
    for (size_t r = 0; r < rows; r++) {
        s->band[r] = 2 * sinl(step * (wide)(2 * r + 1)) * sinl(step);
        for (size_t c = 0; c < width; c++)
            s->row[r] += height[r * width + c];
        s->total += s->row[r] * s->band[r];
    }
}

typedef struct sky_errors {
    double across, down, pdf, length, near;
} sky_errors;

/* A direction's longitude and height say by their F which uniforms they are worth. */
static int see_direction(sky_errors *e, const double *x, double pdf, const double *u, const sky *s)
{
    const wide square = (wide)x[0] * x[0] + (wide)x[1] * x[1];
    const wide near = square / (1 + fabsl((wide)x[2]));
    const wide turn = atan2l(x[1], x[0]) / (2 * WIDE_PI),
               at = (turn < 0 ? turn + 1 : turn) * (wide)s->width;
    size_t r = 0, c = (size_t)at;
    while (r + 1 < s->rows && s->depth[x[2] < 0 ? s->rows - 1 - r : r + 1] * (x[2] < 0 ? -1 : 1) <=
                                  near * (x[2] < 0 ? -1 : 1))
        r++;
    const double here = height[r * s->width + c];
    if (!(here > 0))
        return 0;
    wide a = 0, b = 0;
    for (size_t k = 0; k < c; k++)
        a += height[r * s->width + k];
    for (size_t k = 0; k < r; k++)
        b += s->row[k] * s->band[k];
    const wide down =
        x[2] < 0 ? s->band[r] - (near - s->depth[s->rows - 1 - r]) : near - s->depth[r];
    const wide F1 = (a + here * (at - (wide)c)) / s->row[r], F2 = (b + s->row[r] * down) / s->total;
    /* What 2^-52 of a turn, and 2^-52 of a height, are worth there. */
    e->across = fmax(
        e->across, (double)(fabsl(F1 - u[0]) / (1 + here * (wide)s->width / s->row[r]) / 0x1p-52L));
    e->down = fmax(e->down, (double)(fabsl(F2 - u[1]) / (1 + s->row[r] / s->total) / 0x1p-52L));
    const wide exact = here * (wide)s->width / (2 * WIDE_PI * s->total);
    const double slack =
        0x1p-63 * (double)(exact * (s->row[r] / here + s->total / (s->row[r] * s->band[r])));
    e->pdf = fmax(e->pdf, (double)fabsl(pdf - exact) / (ulp(exact) + slack));
    e->length = fmax(e->length, (double)fabsl(square + (wide)x[2] * x[2] - 1) / 0x1p-52);
    /* The height from the nearer pole that u2 stands for; a unit of 2^-62 shows in thin rows. */
    const wide worth =
        x[2] < 0 ? s->depth[s->rows - 1 - r] + ((b - u[1] * s->total) / s->row[r] + s->band[r])
                 : s->depth[r] + (u[1] * s->total - b) / s->row[r];
    const wide grain = 0x1p-52L * worth + 0x1p-60L * s->total / s->row[r];
    e->near = fmax(e->near, (double)(fabsl(near - worth) / grain));
    return 1;
}

static void see_sky(const char *name, size_t width, size_t rows, int draws, buffon_rng *rng)
{
    static sky s;
    static float image[MOST + 1];
    memset(block, 0xa5, sizeof block);
    const buffon_density g = buffon_environment(block, sizeof block, height, width, rows);
    sky_errors e = {0};
    double back = 0;
    int support = g.status == BUFFON_OK, agree = 1;
    look_up(&s, width, rows);
    for (int i = 0; i < draws && support; i++) {
        double u[2], x[3], pdf, again, v[2];
        grid_pair(u, rng, i);
        support &= buffon_density_sample(x, &pdf, u, 1, &g) == BUFFON_OK && pdf > 0;
        support &= buffon_density_pdf(&again, x, 1, &g) == BUFFON_OK;
        support &= buffon_density_invert(v, x, 1, &g) == BUFFON_OK;
        support &= see_direction(&e, x, pdf, u, &s);
        agree &= pdf == again;
        back =
            fmax(back, fmax(fabs(u[0] - v[0]) * 2 * 3.1415926535897931 / 0x1p-52 / (1 + 800 * pdf),
                            fabs(u[1] - v[1]) / 0x1p-52 / 64));
    }
    for (size_t k = 0; k < width * rows && support; k++) {
        const double turn = 2 * 3.1415926535897931 * ((double)(k % width) + 0.5) / (double)width;
        const double angle = 3.1415926535897931 * ((double)(k / width) + 0.5) / (double)rows;
        const double x[3] = {sin(angle) * cos(turn), sin(angle) * sin(turn), cos(angle)};
        double pdf;
        support &= buffon_density_pdf(&pdf, x, 1, &g) == BUFFON_OK;
        support &= height[k] > 0 ? pdf >= 0 : pdf == 0;
    }
    tap_ok(support, "sky, %s: no direction is dark", name);
    tap_ok(agree, "sky, %s: the pdf of a sample is that in its direction", name);
    at_most(e.across, 16, name, "longitude");
    at_most(e.down, 16, name, "height");
    at_most(e.near, 20, name, "height from the nearer pole");
    at_most(e.length, 4, name, "length");
    at_most(e.pdf, 6, name, "pdf");
    at_most(back, 20, name, "and back");
    int fits = 1;
    for (size_t k = 0; k < width * rows; k++) {
        image[k] = (float)height[k];
        fits &= (double)image[k] <= FLT_MAX && (image[k] > 0 || !(height[k] > 0));
        height[k] = image[k];
    }
    if (!fits)
        return;
    const buffon_density d = buffon_environment(block, sizeof block, height, width, rows);
    const buffon_density f = buffon_environment_float(moved, sizeof moved, image, width, rows);
    tap_ok(d.status == BUFFON_OK && f.status == BUFFON_OK &&
               memcmp(block, moved, buffon_environment_size(width, rows)) == 0,
           "sky, %s: floats make the same table", name);
}

static void test_sky(void)
{
    buffon_rng rng = buffon_rng_make(6, 42);
    fill(MOST, 2, 1, 1, &rng);
    see_sky("60 by 30", 60, 30, DRAWS / 2, &rng);
    fill(MOST, 2, 1, 1, &rng);
    memset(height + 3, 0, (1999 - 6) * sizeof *height);
    height[0] = height[1998] = 1;
    see_sky("1 by 1999, the poles", 1, 1999, DRAWS / 20, &rng);
    fill(MOST, 30, 1, 1, &rng);
    for (size_t c = 0; c < 31; c++)
        height[3 * 31 + c] = 0;
    see_sky("31 by 17, uneven, with a dark row", 31, 17, DRAWS / 2, &rng);
    fill(MOST, 2, 1, DBL_MAX, &rng);
    see_sky("5 by 3, very bright", 5, 3, DRAWS / 2, &rng);
    memset(height, 0, sizeof height);
    height[20] = 1e-310;
    see_sky("one pixel of 8 by 8", 8, 8, DRAWS / 2, &rng);
    height[0] = height[1] = height[2] = 3;
    see_sky("1 by 1", 1, 1, DRAWS / 2, &rng);
    see_sky("1 by 2", 1, 2, DRAWS / 2, &rng);
    see_sky("3 by 1", 3, 1, DRAWS / 2, &rng);
}

/* Even light is the uniform law of the sphere. */
static void test_even_sky(void)
{
    const double outside[] = {0, 0, 2, 0.5, 0.5, 0.5, NAN, 0, 0};
    const buffon_density s = buffon_sphere();
    buffon_rng rng = buffon_rng_make(7, 42);
    double worst = 0, pdf[3];
    int good = 1;
    for (size_t k = 0; k < 32 * 16; k++)
        height[k] = 0.25;
    const buffon_density g = buffon_environment(block, sizeof block, height, 32, 16);
    for (int i = 0; i < DRAWS / 4; i++) {
        double u[2], v[2], x[3], y[3], p;
        grid_pair(u, &rng, i);
        v[0] = u[1];
        v[1] = u[0];
        good &= buffon_density_sample(x, &p, u, 1, &g) == BUFFON_OK;
        good &= buffon_density_sample(y, NULL, v, 1, &s) == BUFFON_OK;
        for (int k = 0; k < 3; k++)
            worst = fmax(worst, fabs(x[k] - y[k]) / (1 + 0x1p-3 / hypot(y[0], y[1])));
        good &= fabs(p * 4 * 3.14159265358979323846 - 1) < 0x1p-48;
    }
    tap_ok(good && worst <= 0x1p-46, "an even sky: the points of buffon_sphere");
    tap_note("%.3g", worst);
    double transposed[9];
    for (int k = 0; k < 9; k++)
        transposed[k] = outside[k % 3 * 3 + k / 3];
    tap_ok(buffon_density_pdf(pdf, transposed, 3, &g) == BUFFON_OK && pdf[0] == 0 && pdf[1] == 0 &&
               pdf[2] == 0,
           "what is no direction has no pdf");
}

/* What memory held before is no part of a table. */
static void test_clean(void)
{
    static unsigned char first[32 * 200], second[32 * 200];
    const double w[35] = {0, 0, 0, 0, 0, 1, 0, 2, 0, 3, 0, 0, 0, 0, 0, 4, -0.0, 5};
    int same = 1;
    for (int t = 0; t < 7; t++) {
        for (int k = 0; k < 2; k++) {
            memset(block, k ? 0xff : 0x5a, sizeof block);
            const buffon_density g =
                t == 0   ? buffon_alias(block, sizeof block, w, 35)
                : t == 1 ? buffon_guide(block, sizeof block, w, 35)
                : t == 2 ? buffon_piecewise_constant(block, sizeof block, NULL, w, 35)
                : t == 3 ? buffon_piecewise_linear(block, sizeof block, NULL, w, 35)
                : t == 4 ? buffon_piecewise_grid(block, sizeof block, w, 5, 7)
                : t == 5 ? buffon_bilinear_grid(block, sizeof block, w, 5, 7)
                         : buffon_environment(block, sizeof block, w, 5, 7);
            const size_t size = (size_t)((const buffon_priv_table *)g.data[0])->bytes;
            memcpy(k ? second : first, block, size < sizeof first ? size : 0);
            same &= k == 0 || memcmp(first, second, size) == 0;
        }
    }
    tap_ok(same, "what memory held before is no part of a table");
}

/* ---- what is refused, and tables that travel ---- */

static void test_refusals(void)
{
    const double e[] = {0, 1, 2}, h[] = {1, 0, 2, 1}, zero[4] = {0};
    const double falling[] = {0, 2, 1}, twice[] = {0, 1, 1}, no_edge[] = {0, NAN, 1};
    const double endless[] = {0, 1, INFINITY}, wide_range[] = {-DBL_MAX, 0, DBL_MAX};
    const double narrow[] = {0, 0x1p-1000, 0x1p-900 * 0.5}, needle[] = {0, 0x1p-1070, 1};
    const double negative[] = {1, -1, 1, 1}, no_number[] = {1, NAN, 1, 1};
    const double infinite[] = {1, INFINITY, 1, 1};
    const struct {
        const double *edge, *height;
        buffon_status status;
        const char *what;
    } bad[] = {{falling, h, BUFFON_E_TABLE, "falling edges"},
               {twice, h, BUFFON_E_TABLE, "two equal edges"},
               {no_edge, h, BUFFON_E_TABLE, "an edge that is NaN"},
               {endless, h, BUFFON_E_TABLE, "an infinite edge"},
               {wide_range, h, BUFFON_E_TABLE, "a range beyond the doubles"},
               {narrow, h, BUFFON_E_TABLE, "a range below 2^-900"},
               {needle, (const double[]){1, 0, 0}, BUFFON_E_TABLE, "a pdf beyond the doubles"},
               {e, zero, BUFFON_E_SHAPE, "heights of 0"},
               {e, negative, BUFFON_E_SHAPE, "a negative height"},
               {e, no_number, BUFFON_E_SHAPE, "a height that is NaN"},
               {e, infinite, BUFFON_E_SHAPE, "an infinite height"},
               {e, NULL, BUFFON_E_NULL, "no heights"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        refused_by_value(
            buffon_piecewise_constant(block, sizeof block, bad[k].edge, bad[k].height, 2),
            bad[k].status, bad[k].what);
        refused_by_value(
            buffon_piecewise_linear(block, sizeof block, bad[k].edge, bad[k].height, 3),
            bad[k].status, bad[k].what);
    }
    for (size_t k = 7; k < sizeof bad / sizeof *bad; k++) {
        refused_by_value(buffon_piecewise_grid(block, sizeof block, bad[k].height, 2, 2),
                         bad[k].status, bad[k].what);
        refused_by_value(buffon_environment(block, sizeof block, bad[k].height, 2, 2),
                         bad[k].status, bad[k].what);
        refused_by_value(buffon_bilinear_grid(block, sizeof block, bad[k].height, 2, 2),
                         bad[k].status, bad[k].what);
    }
    const float dark[2] = {0, 0}, odd[2] = {1, (float)NAN}, below[2] = {1, -1};
    refused_by_value(buffon_environment_float(block, sizeof block, dark, 2, 1), BUFFON_E_SHAPE,
                     "dark");
    refused_by_value(buffon_environment_float(block, sizeof block, odd, 2, 1), BUFFON_E_SHAPE,
                     "NaN");
    refused_by_value(buffon_environment_float(block, sizeof block, below, 1, 2), BUFFON_E_SHAPE,
                     "-1");
    refused_by_value(buffon_environment_float(block, sizeof block, NULL, 1, 2), BUFFON_E_NULL,
                     "NULL");
    refused_by_value(buffon_piecewise_linear(block, sizeof block, e, h, 1), BUFFON_E_DIM,
                     "one knot");
    refused_by_value(buffon_piecewise_constant(block, sizeof block, e, h, 0), BUFFON_E_DIM,
                     "no piece");
    refused_by_value(buffon_piecewise_grid(block, sizeof block, h, 0, 2), BUFFON_E_DIM,
                     "no column");
    refused_by_value(buffon_environment(block, sizeof block, h, 2, 0), BUFFON_E_DIM, "no row");
    refused_by_value(buffon_bilinear_grid(block, sizeof block, h, 2, 1), BUFFON_E_DIM, "one row");
    refused_by_value(buffon_bilinear_grid(block, buffon_bilinear_grid_size(2, 2) - 1, h, 2, 2),
                     BUFFON_E_SIZE, "a byte less");
    refused_by_value(buffon_environment(NULL, 9999, h, 2, 2), BUFFON_E_NULL, "no memory");
    refused_by_value(buffon_environment(block, buffon_environment_size(2, 2) - 1, h, 2, 2),
                     BUFFON_E_SIZE, "a byte less");
    refused_by_value(buffon_piecewise_grid(block, buffon_piecewise_grid_size(2, 2) - 1, h, 2, 2),
                     BUFFON_E_SIZE, "a byte less");
    const size_t huge = (size_t)INT32_MAX, beyond = (size_t)1 << 31;
    tap_ok(buffon_piecewise_constant_size(beyond) == SIZE_MAX &&
               buffon_piecewise_linear_size(beyond) == SIZE_MAX &&
               buffon_piecewise_grid_size(beyond, 1) == SIZE_MAX &&
               buffon_environment_size(1, beyond) == SIZE_MAX &&
               (buffon_environment_size(huge, huge) > huge || SIZE_MAX < UINT64_MAX),
           "sizes of tables that cannot be");
    const double v[][4] = {{0, 0, 0, 0}, {-1, 1, 1, 1}, {1, NAN, 1, 1}, {1, 1, 1, INFINITY}};
    for (int k = 0; k < 4; k++)
        refused_by_value(buffon_bilinear(v[k][0], v[k][1], v[k][2], v[k][3]), BUFFON_E_SHAPE,
                         "bilinear");
}

static void test_open(void)
{
    buffon_rng rng = buffon_rng_make(8, 42);
    for (int t = 0; t < 5; t++) {
        fill(60, 3, 1, 1, &rng);
        const buffon_density g =
            t == 0   ? buffon_piecewise_constant(block, sizeof block, edge, height, 60)
            : t == 1 ? buffon_piecewise_linear(block, sizeof block, edge, height, 60)
            : t == 2 ? buffon_piecewise_grid(block, sizeof block, height, 10, 6)
            : t == 3 ? buffon_bilinear_grid(block, sizeof block, height, 10, 6)
                     : buffon_environment(block, sizeof block, height, 10, 6);
        const size_t size = t == 0   ? buffon_piecewise_constant_size(60)
                            : t == 1 ? buffon_piecewise_linear_size(60)
                            : t == 2 ? buffon_piecewise_grid_size(10, 6)
                            : t == 3 ? buffon_bilinear_grid_size(10, 6)
                                     : buffon_environment_size(10, 6);
        double u[40], x[60], y[60], p[20], q[20];
        memcpy(moved, block, size);
        memset((unsigned char *)moved + size, 0xff, 64);
        const buffon_density h = buffon_table_open(moved, size);
        buffon_rng_fill(u, 40, &rng);
        int same = h.ops == g.ops && h.dim == g.dim && h.uniforms == g.uniforms;
        same &= buffon_density_sample(x, p, u, 20, &g) == BUFFON_OK;
        same &= buffon_density_sample(y, q, u, 20, &h) == BUFFON_OK;
        tap_ok(same && !memcmp(x, y, 20 * g.dim * sizeof *x) && !memcmp(p, q, sizeof p),
               "%s: opened elsewhere, the same points", g.ops->name);
        /* One by one, as in a batch. */
        for (size_t i = 0; i < 20; i++) {
            double v[2], z[3], r;
            for (size_t j = 0; j < g.uniforms; j++)
                v[j] = u[20 * j + i];
            same &= buffon_density_sample(z, &r, v, 1, &g) == BUFFON_OK && r == p[i];
            for (size_t j = 0; j < g.dim; j++)
                same &= z[j] == x[20 * j + i];
        }
        tap_ok(same, "%s: batches and single points are the same", g.ops->name);
        ((unsigned char *)moved)[size - 1] ^= 1;
        refused_by_value(buffon_table_open(moved, size), BUFFON_E_CORRUPT, "a damaged table");
    }
}

int main(void)
{
    test_lines();
    test_tents();
    test_slivers();
    test_even();
    test_no_uniforms();
    test_grid();
    test_bilinear();
    test_surface();
    test_sky();
    test_even_sky();
    test_clean();
    test_refusals();
    test_open();
    return tap_done();
}
