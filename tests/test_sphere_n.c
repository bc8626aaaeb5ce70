/* Spheres and balls of any dimension: the maps and the densities against extended precision, the
 * numbers behind `Exact:` in sphere_n.h; moments that are known, the way back, the edges. */
#include <float.h>
#include <math.h>

#include <buffon/buffon.h>

#include "grid.h"
#include "refused.h"

typedef long double wide;

#define WIDE_PI 3.14159265358979323846264338327950288L

enum { MOST = 1001 };

static const size_t dims[] = {2, 3, 4, 5, 6, 7, 8, 9, 12, 33, 100, 437, 1001};

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* Valgrind, for one, computes long doubles in 53 bits. */
static int have_wide(void)
{
    volatile wide one = 1, tiny = 0x1p-60L;
    return LDBL_MANT_DIG >= 64 && one + tiny > one;
}

static double ulp(wide x)
{
    const double a = fabs((double)x);
    return a < DBL_MIN ? 0x1p-1074 : nextafter(a, INFINITY) - a;
}

/* The worst error met, as a share of what is allowed. */
typedef struct worst {
    double share;
} worst;

static void see(worst *w, double x, wide exact, double allowed)
{
    const double share = (double)fabsl(x - exact) / ulp(exact) / allowed;
    if (!(share <= w->share))
        w->share = share;
}

static void see_near(worst *w, double x, wide exact, double allowed)
{
    const double share = (double)fabsl(x - exact) / allowed;
    if (!(share <= w->share))
        w->share = share;
}

static void report(const worst *w, const char *what)
{
    tap_ok(w->share <= 1, "%s", what);
    tap_note("worst %.3f of what is allowed", w->share);
}

/* sin and cos of 2 pi t: the reduction by quarters is exact. */
static void circle(wide *c, wide *s, double t)
{
    const double quarters = floor(4 * t + 0.5), rest = t - 0.25 * quarters;
    const wide sine = sinl(2 * WIDE_PI * rest), cosine = cosl(2 * WIDE_PI * rest);
    const int k = (int)quarters & 3;
    *c = k == 0 ? cosine : k == 1 ? -sine : k == 2 ? -cosine : sine;
    *s = k == 0 ? sine : k == 1 ? cosine : k == 2 ? -sine : -cosine;
}

/* The point as the header says. The share of r coordinates in |x|^2 is (1 - u)^(2 / (r - 2)). */
static void wide_point(wide *x, const double *u, size_t dim, int solid)
{
    size_t j = 0, r = dim + (solid ? 2 : 0);
    wide rest = 1, c, s;
    for (; r > 3; r -= 2, j += 2) {
        const wide left = log1pl(-(wide)u[j]) * 2 / (wide)(r - 2);
        const wide size = sqrtl(rest * -expm1l(left));
        circle(&c, &s, u[j + 1]);
        x[j] = size * c;
        x[j + 1] = size * s;
        rest *= expl(left);
    }
    if (r == 3 && solid) {
        x[j] = sqrtl(rest) * (2 * (wide)u[j] - 1);
    } else if (r == 3) {
        const wide across = 2 * sqrtl(rest * u[j] * (1 - (wide)u[j]));
        circle(&c, &s, u[j + 1]);
        x[j] = across * c;
        x[j + 1] = across * s;
        x[j + 2] = sqrtl(rest) * (1 - 2 * (wide)u[j]);
    } else if (!solid) {
        circle(&c, &s, u[j]);
        x[j] = sqrtl(rest) * c;
        x[j + 1] = sqrtl(rest) * s;
    }
}

static buffon_density make(size_t dim, int solid)
{
    return solid ? buffon_ball_n(dim) : buffon_sphere_n(dim);
}

static void test_points(int solid)
{
    static double u[MOST], x[MOST], v[MOST];
    static wide exact[MOST];
    worst at = {0}, length = {0}, back = {0};
    int inside = 1;
    buffon_rng rng = buffon_rng_make(1, 80);
    for (size_t d = 0; d < COUNT(dims); d++)
        for (int k = 0; k < (dims[d] < 20 ? 4000 : 40); k++) {
            const size_t dim = dims[d];
            const buffon_density g = make(dim, solid);
            double pdf = 0;
            wide square = 0;
            for (size_t j = 0; j < g.uniforms; j++)
                u[j] = k % 3 ? grid(&rng, k + (int)j)
                             : ldexp(0.5 + 0.5 * buffon_rng_next(&rng), -(k % 1000));
            if (buffon_density_sample(x, NULL, u, 1, &g) != BUFFON_OK ||
                buffon_density_pdf(&pdf, x, 1, &g) != BUFFON_OK)
                at.share = INFINITY;
            wide_point(exact, u, dim, solid);
            for (size_t j = 0; j < dim; j++) {
                see(&at, x[j], exact[j], 24 + (double)dim / 100);
                square += (wide)x[j] * x[j];
            }
            if (!solid)
                see_near(&length, (double)(sqrtl(square) - 1), 0, (4 + (double)dim) * 0x1p-53);
            inside &= pdf > 0;
            /* The way back from points that are not at an edge: there little is left to know. */
            buffon_rng_fill(u, g.uniforms, &rng);
            if (buffon_density_sample(x, NULL, u, 1, &g) != BUFFON_OK ||
                buffon_density_invert(v, x, 1, &g) != BUFFON_OK)
                back.share = INFINITY;
            for (size_t j = 0; j < g.uniforms; j++)
                see_near(&back, v[j], u[j], 1e-10);
        }
    report(&at,
           solid ? "ball: x within 24 + dim / 100 ulp" : "sphere: x within 24 + dim / 100 ulp");
    if (!solid)
        report(&length, "sphere: |x| within (4 + dim) 2^-53 of 1");
    tap_ok(inside, "no point lies outside");
    report(&back, "and back to the uniforms");
}

/* 1 / area and 1 / volume, by the gamma function of half a whole number. */
static void test_areas(void)
{
    worst pdf = {0}, log_pdf = {0};
    static double x[MOST];
    int infinite = 1;
    x[0] = 1;
    for (size_t dim = 1; dim <= MOST; dim++)
        for (int solid = 0; solid < 2; solid++) {
            const wide z = 0.5L * (wide)dim;
            const wide front = solid ? lgammal(z + 1) : lgammal(z) - logl(2);
            const wide exact = front - z * logl(WIDE_PI);
            double got = NAN, logarithm = NAN;
            if (!solid && dim == 1)
                continue;
            const buffon_density g = make(dim, solid);
            if (buffon_density_pdf(&got, x, 1, &g) != BUFFON_OK ||
                buffon_density_log_pdf(&logarithm, x, 1, &g) != BUFFON_OK)
                pdf.share = INFINITY;
            /* The logarithm of a large gamma function has errors of its own: 2^-64 of it. */
            if (exact < 709.7L)
                see(&pdf, got, expl(exact), 2 + (double)dim / 20);
            else
                infinite &= got == INFINITY && dim >= (solid ? 432 : 438);
            infinite &= exact < 709.8L || got == INFINITY;
            see_near(&log_pdf, logarithm, exact, 4 * ulp(fmaxl(front, 1)));
        }
    report(&pdf, "g within 2 + dim / 20 ulp");
    report(&log_pdf, "log g within 4 ulp of its largest term");
    tap_ok(infinite, "g is infinite where it is above all doubles");
    const buffon_density disk = buffon_ball_n(2), ball = buffon_ball_n(3),
                         four = buffon_sphere_n(4);
    double got[3] = {0};
    const double origin[4] = {0}, axis[4] = {0, 0, 0, 1};
    tap_ok(buffon_density_pdf(got, origin, 1, &disk) == BUFFON_OK &&
               buffon_density_pdf(got + 1, origin, 1, &ball) == BUFFON_OK &&
               buffon_density_pdf(got + 2, axis, 1, &four) == BUFFON_OK &&
               fabs(got[0] * 3.1415926535897931 - 1) < 1e-15 &&
               fabs(got[1] * 4.1887902047863905 - 1) < 1e-15 &&
               fabs(got[2] * 19.739208802178716 - 1) < 1e-15,
           "areas that are known: pi, 4 pi / 3, 2 pi^2");
}

/* E[x_i^2 x_j^2] over the sphere is 1 / (d (d + 2)), E[x_i^4] three times that, and E|x|^p over the
 * ball is d / (d + p). By even points. */
static void test_moments(void)
{
    enum { POINTS = 1 << 14 };
    static double u[9 * POINTS], x[9 * POINTS], table[1 << 12];
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    worst fourth = {0}, first = {0}, radius = {0};
    for (size_t dim = 2; dim < 10; dim++)
        for (int solid = 0; solid < 2; solid++) {
            const buffon_density g = make(dim, solid);
            const double d = (double)dim, ball = solid ? d / (d + 4) : 1;
            buffon_points_block block = {.n = POINTS, .dim = g.uniforms, .table = table};
            if (sobol.table_size(g.uniforms, &sobol) > sizeof table ||
                sobol.prepare(&block, &sobol) != 0 || sobol.fill(u, &block, &sobol) != 0 ||
                buffon_density_sample(x, NULL, u, POINTS, &g) != BUFFON_OK)
                fourth.share = INFINITY;
            for (size_t j = 0; j < dim; j++) {
                double mean = 0;
                for (size_t i = 0; i < POINTS; i++)
                    mean += x[j * POINTS + i] / POINTS;
                see_near(&first, mean, 0, 1e-3);
                for (size_t k = 0; k <= j; k++) {
                    double product = 0;
                    for (size_t i = 0; i < POINTS; i++) {
                        const double a = x[j * POINTS + i], b = x[k * POINTS + i];
                        product += a * a * b * b / POINTS;
                    }
                    see_near(&fourth, product * d * (d + 2) / ball, j == k ? 3 : 1, 0.02);
                }
            }
            double cube = 0;
            for (size_t i = 0; i < POINTS; i++) {
                double square = 0;
                for (size_t j = 0; j < dim; j++)
                    square += x[j * POINTS + i] * x[j * POINTS + i];
                cube += square * sqrt(square) / POINTS;
            }
            see_near(&radius, cube, solid ? d / (d + 3) : 1, 1e-4);
        }
    report(&first, "means of all coordinates are 0");
    report(&fourth, "means of all products of squares are those of the sphere");
    report(&radius, "mean cubes of the radius are d / (d + 3)");
}

/* Three dimensions are the sphere of sphere.h. */
static void test_sphere(void)
{
    const buffon_density three = buffon_sphere_n(3), sphere = buffon_sphere();
    int same = 1;
    buffon_rng rng = buffon_rng_make(2, 80);
    for (int k = 0; k < 1000; k++) {
        double u[2], x[3], y[3];
        grid_pair(u, &rng, k);
        same &= buffon_density_sample(x, NULL, u, 1, &three) == BUFFON_OK &&
                buffon_density_sample(y, NULL, u, 1, &sphere) == BUFFON_OK &&
                memcmp(x, y, sizeof x) == 0;
    }
    tap_ok(same, "in three dimensions the points are those of buffon_sphere");
}

static void test_outside(void)
{
    const double off[4] = {0.6, 0.6, 0.6, 0}, on[4] = {0.5, -0.5, 0.5, -0.5},
                 no[4] = {0, NAN, 0, 0};
    const buffon_density sphere = buffon_sphere_n(4), ball = buffon_ball_n(4);
    double a, b, c, d, e, f;
    tap_ok(buffon_density_pdf(&a, off, 1, &sphere) == BUFFON_OK && a == 0 &&
               buffon_density_pdf(&b, off, 1, &ball) == BUFFON_OK && b == 0 &&
               buffon_density_pdf(&c, on, 1, &sphere) == BUFFON_OK && c > 0 &&
               buffon_density_pdf(&d, on, 1, &ball) == BUFFON_OK && d > 0 &&
               buffon_density_pdf(&e, no, 1, &sphere) == BUFFON_OK && e == 0 &&
               buffon_density_pdf(&f, no, 1, &ball) == BUFFON_OK && f == 0,
           "a density on the sphere, or in the ball, and nowhere else");
    refused_by_value(buffon_sphere_n(0), BUFFON_E_DIM, "a sphere of no dimension");
    refused_by_value(buffon_sphere_n(1), BUFFON_E_DIM, "a sphere of 1 dimension");
    refused_by_value(buffon_ball_n(0), BUFFON_E_DIM, "a ball of no dimension");
    refused_by_value(buffon_ball_n((size_t)-1), BUFFON_E_DIM, "a ball of too many dimensions");
}

int main(void)
{
    if (have_wide()) {
        test_points(0);
        test_points(1);
        test_areas();
    } else {
        tap_ok(1, "formulas # SKIP long double is no wider than double");
    }
    test_moments();
    test_sphere();
    test_outside();
    return tap_done();
}
