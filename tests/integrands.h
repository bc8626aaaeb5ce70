/* The integrands of tests/data/exact_values.csv whose standard deviation under uniform points is
 * known. Sources: the test suites of GSL, Cuba, vegas, cubature and m-Cubes; A. Genz (1984),
 * Testing multidimensional integration routines; and a few that are meant to be hard. */
#ifndef TESTS_INTEGRANDS_H
#define TESTS_INTEGRANDS_H

#include <math.h>
#include <stddef.h>

#define INTEGRAND_PI 3.14159265358979323846

/* One integrand. Coordinate 0 runs over `first`, the others over `rest`.
 *
 * `kurtosis` is the fourth central moment over the squared variance under uniform points, measured
 * with 2^22 points and good to a tenth; INTEGRAND_NARROW where it is above a hundred: most of these
 * are peaks so narrow that 2^16 points say little about them. */
typedef struct integrand_row {
    const char *name;
    size_t dim;
    double (*f)(const double *x, size_t dim);
    double kurtosis;
    double first[2], rest[2];
} integrand_row;

#define INTEGRAND_NARROW INFINITY

/* |x - c|^2, the same c in every coordinate. */
static double integrand_distance2(const double *x, size_t dim, double c)
{
    double sum = 0;
    for (size_t j = 0; j < dim; j++)
        sum += (x[j] - c) * (x[j] - c);
    return sum;
}

/* ---- GSL ---- */

static double gsl_const(const double *x, size_t dim)
{
    (void)x;
    (void)dim;
    return 1;
}

static double gsl_step(const double *x, size_t dim)
{
    (void)dim;
    return x[0] > 0.1 && x[0] < 0.9;
}

static double gsl_product(const double *x, size_t dim)
{
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product *= 2 * x[j];
    return product;
}

static double gauss_peak(const double *x, size_t dim, double c, double a)
{
    const double height = pow(a * sqrt(INTEGRAND_PI), -(double)dim);
    return height * exp(-integrand_distance2(x, dim, c) / (a * a));
}

static double gsl_gauss(const double *x, size_t dim)
{
    return gauss_peak(x, dim, 0.5, 0.1);
}

static double gsl_dblgauss(const double *x, size_t dim)
{
    return 0.5 * (gauss_peak(x, dim, 1.0 / 3, 0.1) + gauss_peak(x, dim, 2.0 / 3, 0.1));
}

static double gsl_tsuda(const double *x, size_t dim)
{
    const double c = (1 + sqrt(10.0)) / 9;
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product *= c / (c + 1) * ((c + 1) / (c + x[j])) * ((c + 1) / (c + x[j]));
    return product;
}

/* ---- Cuba ---- */

static double cuba_1(const double *x, size_t dim)
{
    (void)dim;
    return sin(x[0]) * cos(x[1]) * exp(x[2]);
}

static double cuba_2(const double *x, size_t dim)
{
    (void)dim;
    return cos(x[1]) * exp(x[2]) / ((x[0] + x[1]) * (x[0] + x[1]) + 0.003);
}

static double cuba_3(const double *x, size_t dim)
{
    (void)dim;
    return 1 / (3.75 - cos(INTEGRAND_PI * x[0]) - cos(INTEGRAND_PI * x[1]) -
                cos(INTEGRAND_PI * x[2]));
}

static double cuba_4(const double *x, size_t dim)
{
    return fabs(integrand_distance2(x, dim, 0) - 0.125);
}

static double cuba_5(const double *x, size_t dim)
{
    return exp(-integrand_distance2(x, dim, 0));
}

static double cuba_6(const double *x, size_t dim)
{
    (void)dim;
    return 1 / (1 - x[0] * x[1] * x[2] + 1e-10);
}

static double cuba_7(const double *x, size_t dim)
{
    (void)dim;
    return sqrt(fabs(x[0] - x[1] - x[2]));
}

static double cuba_8(const double *x, size_t dim)
{
    (void)dim;
    return exp(-x[0] * x[1] * x[2]);
}

static double cuba_9(const double *x, size_t dim)
{
    (void)dim;
    return x[0] * x[0] / (cos(x[0] + x[1] + x[2] + 1) + 5);
}

static double cuba_10(const double *x, size_t dim)
{
    const double product = x[0] * x[1] * x[2];
    (void)dim;
    return x[0] > 0.5 ? 1 / sqrt(product + 1e-5) : sqrt(product);
}

/* Also cuba.11. */
static double unit_ball(const double *x, size_t dim)
{
    return integrand_distance2(x, dim, 0) < 1;
}

/* ---- vegas ---- */

static double vegas_gauss4(const double *x, size_t dim)
{
    return 1013.2118364296088 * exp(-100 * integrand_distance2(x, dim, 0.5));
}

static double vegas_gauss4_ball(const double *x, size_t dim)
{
    const double r2 = integrand_distance2(x, dim, 0.5);
    return r2 < 0.04 ? 1115.3539360527281318 * exp(-100 * r2) : 0;
}

static double vegas_twogauss4(const double *x, size_t dim)
{
    return 0.5 * 1013.2167575422921535 * (exp(-100 * integrand_distance2(x, dim, 1.0 / 3)) +
                                          exp(-100 * integrand_distance2(x, dim, 2.0 / 3)));
}

static double vegas_moment0(const double *x, size_t dim)
{
    return exp(-200 * integrand_distance2(x, dim, 0.5));
}

static double vegas_moment1(const double *x, size_t dim)
{
    return x[0] * vegas_moment0(x, dim);
}

static double vegas_moment2(const double *x, size_t dim)
{
    return x[0] * x[0] * vegas_moment0(x, dim);
}

static double vegas_dist2(const double *x, size_t dim)
{
    return exp(-integrand_distance2(x, dim, 0.5));
}

static double vegas_threegauss20(const double *x, size_t dim)
{
    static const double centre[] = {0.23, 0.39, 0.74};
    const double far = integrand_distance2(x + 5, dim - 5, 0.45);
    double sum = 0;
    for (size_t i = 0; i < 3; i++)
        sum += exp(-100 * (integrand_distance2(x, 5, centre[i]) + far));
    return 356047712484621.56 * sum;
}

/* ---- Genz: w_i = frac(0.618... i), c_i = i h / (d (d + 1) / 2), i from 1 ---- */

static double genz_w(size_t j)
{
    const double w = 0.6180339887498949 * (double)(j + 1);
    return w - floor(w);
}

static double genz_c(size_t j, size_t dim, double h)
{
    return (double)(j + 1) * h / ((double)dim * (double)(dim + 1) / 2);
}

static double genz_dot(const double *x, size_t dim, double h)
{
    double sum = 0;
    for (size_t j = 0; j < dim; j++)
        sum += genz_c(j, dim, h) * x[j];
    return sum;
}

static double genz_oscillatory(const double *x, size_t dim)
{
    return cos(2 * INTEGRAND_PI * genz_w(0) + genz_dot(x, dim, 6.0));
}

static double genz_product_peak(const double *x, size_t dim)
{
    double product = 1;
    for (size_t j = 0; j < dim; j++) {
        const double c = genz_c(j, dim, 18.0), d = x[j] - genz_w(j);
        product /= 1 / (c * c) + d * d;
    }
    return product;
}

static double genz_corner_peak(const double *x, size_t dim)
{
    return pow(1 + genz_dot(x, dim, 2.2), -(double)(dim + 1));
}

static double genz_gaussian(const double *x, size_t dim)
{
    double sum = 0;
    for (size_t j = 0; j < dim; j++) {
        const double d = genz_c(j, dim, 15.2) * (x[j] - genz_w(j));
        sum += d * d;
    }
    return exp(-sum);
}

static double genz_c0(const double *x, size_t dim)
{
    double sum = 0;
    for (size_t j = 0; j < dim; j++)
        sum += genz_c(j, dim, 16.1) * fabs(x[j] - genz_w(j));
    return exp(-sum);
}

static double genz_discontinuous(const double *x, size_t dim)
{
    if (x[0] > genz_w(0) || x[1] > genz_w(1))
        return 0;
    return exp(genz_dot(x, dim, 16.4));
}

/* ---- m-Cubes ---- */

/* sum of i x_i, i from 1. */
static double mcubes_dot(const double *x, size_t dim)
{
    double sum = 0;
    for (size_t j = 0; j < dim; j++)
        sum += (double)(j + 1) * x[j];
    return sum;
}

static double mcubes_f1(const double *x, size_t dim)
{
    return cos(mcubes_dot(x, dim));
}

static double mcubes_f2(const double *x, size_t dim)
{
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product /= 1.0 / 2500 + (x[j] - 0.5) * (x[j] - 0.5);
    return product;
}

static double mcubes_f3(const double *x, size_t dim)
{
    return pow(1 + mcubes_dot(x, dim), -(double)(dim + 1));
}

static double mcubes_f4(const double *x, size_t dim)
{
    return exp(-625 * integrand_distance2(x, dim, 0.5));
}

static double mcubes_f5(const double *x, size_t dim)
{
    double sum = 0;
    for (size_t j = 0; j < dim; j++)
        sum += fabs(x[j] - 0.5);
    return exp(-10 * sum);
}

static double mcubes_f6(const double *x, size_t dim)
{
    double sum = 0;
    for (size_t j = 0; j < dim; j++) {
        if (x[j] >= (double)(j + 4) / 10)
            return 0;
        sum += (double)(j + 5) * x[j];
    }
    return exp(sum);
}

static double mcubes_fa(const double *x, size_t dim)
{
    double sum = 0;
    for (size_t j = 0; j < dim; j++)
        sum += x[j];
    return sin(sum);
}

static double mcubes_fb(const double *x, size_t dim)
{
    return gauss_peak(x, dim, 0, 0.01 * sqrt(2.0));
}

/* ---- cubature and others ---- */

static double cubature_cosprod(const double *x, size_t dim)
{
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product *= cos(x[j]);
    return product;
}

static double cubature_morokoff(const double *x, size_t dim)
{
    const double side = 1 / (double)dim;
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product *= (1 + side) * pow(x[j], side);
    return product;
}

static double cubature_ball(const double *x, size_t dim)
{
    const double radius = 0.50124145262344534;
    return integrand_distance2(x, dim, 0) < radius * radius;
}

static double box_distance(const double *x, size_t dim)
{
    return sqrt(integrand_distance2(x, dim, 0));
}

static double radovic(const double *x, size_t dim)
{
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product *= (fabs(4 * x[j] - 2) + 0.01) / 1.01;
    return product;
}

static double heavy_power(const double *x, size_t dim)
{
    (void)dim;
    return pow(x[0], -0.4);
}

static double power_1(const double *x, size_t dim)
{
    (void)dim;
    return x[0];
}

static double power_2(const double *x, size_t dim)
{
    (void)dim;
    return x[0] * x[0];
}

static double missed_gauss6(const double *x, size_t dim)
{
    return gauss_peak(x, dim, 0.5, 0.02);
}

static double offset_step(const double *x, size_t dim)
{
    (void)dim;
    return 1000 + (x[0] < 0.5);
}

#define ROW(name, dim, f, kurtosis) {name, dim, f, kurtosis, {0, 1}, {0, 1}}

static const integrand_row integrand_list[] = {
    ROW("gsl.const", 2, gsl_const, 0),
    ROW("gsl.step", 2, gsl_step, 3.26),
    ROW("gsl.product", 1, gsl_product, 1.8),
    ROW("gsl.product", 3, gsl_product, 6.39),
    ROW("gsl.product", 6, gsl_product, 40.2),
    ROW("gsl.product", 10, gsl_product, INTEGRAND_NARROW),
    ROW("gsl.gauss(a=0.1)", 1, gsl_gauss, 4.16),
    ROW("gsl.gauss(a=0.1)", 3, gsl_gauss, INTEGRAND_NARROW),
    ROW("gsl.gauss(a=0.1)", 6, gsl_gauss, INTEGRAND_NARROW),
    ROW("gsl.gauss(a=0.1)", 10, gsl_gauss, INTEGRAND_NARROW),
    ROW("gsl.dblgauss(a=0.1)", 1, gsl_dblgauss, 1.83),
    ROW("gsl.dblgauss(a=0.1)", 3, gsl_dblgauss, 89.2),
    ROW("gsl.dblgauss(a=0.1)", 6, gsl_dblgauss, INTEGRAND_NARROW),
    ROW("gsl.dblgauss(a=0.1)", 10, gsl_dblgauss, INTEGRAND_NARROW),
    ROW("gsl.tsuda", 1, gsl_tsuda, 3.71),
    ROW("gsl.tsuda", 3, gsl_tsuda, 38.2),
    ROW("gsl.tsuda", 6, gsl_tsuda, INTEGRAND_NARROW),
    ROW("gsl.tsuda", 10, gsl_tsuda, INTEGRAND_NARROW),
    ROW("cuba.1", 3, cuba_1, 2.99),
    ROW("cuba.2", 3, cuba_2, INTEGRAND_NARROW),
    ROW("cuba.3", 3, cuba_3, 11.4),
    ROW("cuba.4", 3, cuba_4, 2.7),
    ROW("cuba.5", 3, cuba_5, 2.75),
    ROW("cuba.6", 3, cuba_6, INTEGRAND_NARROW),
    ROW("cuba.7", 3, cuba_7, 2.32),
    ROW("cuba.8", 3, cuba_8, 4.47),
    ROW("cuba.9", 3, cuba_9, 2.19),
    ROW("cuba.10", 3, cuba_10, INTEGRAND_NARROW),
    ROW("cuba.11", 3, unit_ball, 1.01),
    {"vegas.gauss4", 4, vegas_gauss4, INTEGRAND_NARROW, {-1, 1}, {0, 1}},
    {"vegas.gauss4.big", 4, vegas_gauss4, INTEGRAND_NARROW, {-2, 2}, {0, 2}},
    {"vegas.gauss4.ball", 4, vegas_gauss4_ball, INTEGRAND_NARROW, {-1, 1}, {0, 1}},
    ROW("vegas.twogauss4", 4, vegas_twogauss4, INTEGRAND_NARROW),
    ROW("vegas.moment0", 4, vegas_moment0, INTEGRAND_NARROW),
    ROW("vegas.moment1", 4, vegas_moment1, INTEGRAND_NARROW),
    ROW("vegas.moment2", 4, vegas_moment2, INTEGRAND_NARROW),
    ROW("vegas.dist2", 2, vegas_dist2, 2.29),
    ROW("vegas.threegauss20", 20, vegas_threegauss20, INTEGRAND_NARROW),
    {"ball.volume", 2, unit_ball, 2.93, {-1, 1}, {-1, 1}},
    {"ball.volume", 5, unit_ball, 4.27, {-1, 1}, {-1, 1}},
    {"ball.volume", 10, unit_ball, INTEGRAND_NARROW, {-1, 1}, {-1, 1}},
    ROW("genz1.oscillatory", 2, genz_oscillatory, 2.18),
    ROW("genz1.oscillatory", 5, genz_oscillatory, 3.68),
    ROW("genz1.oscillatory", 8, genz_oscillatory, 4.34),
    ROW("genz1.oscillatory", 10, genz_oscillatory, 4.54),
    ROW("genz2.productpeak", 2, genz_product_peak, 12.6),
    ROW("genz2.productpeak", 5, genz_product_peak, 25.4),
    ROW("genz2.productpeak", 8, genz_product_peak, 25.3),
    ROW("genz2.productpeak", 10, genz_product_peak, 18.6),
    ROW("genz3.cornerpeak", 2, genz_corner_peak, 8.74),
    ROW("genz3.cornerpeak", 5, genz_corner_peak, 42.2),
    ROW("genz3.cornerpeak", 8, genz_corner_peak, INTEGRAND_NARROW),
    ROW("genz3.cornerpeak", 10, genz_corner_peak, INTEGRAND_NARROW),
    ROW("genz4.gaussian", 2, genz_gaussian, 15.1),
    ROW("genz4.gaussian", 5, genz_gaussian, 31.8),
    ROW("genz4.gaussian", 8, genz_gaussian, 28.5),
    ROW("genz4.gaussian", 10, genz_gaussian, 19.1),
    ROW("genz5.C0", 2, genz_c0, 15.5),
    ROW("genz5.C0", 5, genz_c0, 38.9),
    ROW("genz5.C0", 8, genz_c0, 50.2),
    ROW("genz5.C0", 10, genz_c0, 41.6),
    ROW("genz6.discontinuous", 2, genz_discontinuous, 61),
    ROW("genz6.discontinuous", 5, genz_discontinuous, INTEGRAND_NARROW),
    ROW("genz6.discontinuous", 8, genz_discontinuous, INTEGRAND_NARROW),
    ROW("genz6.discontinuous", 10, genz_discontinuous, INTEGRAND_NARROW),
    ROW("mcubes.f1", 8, mcubes_f1, 1.5),
    ROW("mcubes.f2", 6, mcubes_f2, INTEGRAND_NARROW),
    ROW("mcubes.f2", 8, mcubes_f2, INTEGRAND_NARROW),
    ROW("mcubes.f3", 8, mcubes_f3, INTEGRAND_NARROW),
    ROW("mcubes.f4", 5, mcubes_f4, INTEGRAND_NARROW),
    ROW("mcubes.f4", 8, mcubes_f4, INTEGRAND_NARROW),
    ROW("mcubes.f5", 8, mcubes_f5, INTEGRAND_NARROW),
    ROW("mcubes.f6", 6, mcubes_f6, INTEGRAND_NARROW),
    {"mcubes.fA", 6, mcubes_fa, 1.5, {0, 10}, {0, 10}},
    {"mcubes.fB", 9, mcubes_fb, INTEGRAND_NARROW, {-1, 1}, {-1, 1}},
    ROW("cubature.cosprod", 3, cubature_cosprod, 2.31),
    ROW("cubature.cosprod", 6, cubature_cosprod, 3.32),
    ROW("cubature.morokoff", 3, cubature_morokoff, 2.36),
    ROW("cubature.morokoff", 6, cubature_morokoff, 2.65),
    ROW("cubature.ball", 3, cubature_ball, 13.2),
    ROW("cubature.ball", 6, cubature_ball, INTEGRAND_NARROW),
    ROW("box.B3(1)", 3, box_distance, 2.81),
    ROW("radovic(a=.01)", 2, radovic, 3.14),
    ROW("radovic(a=.01)", 10, radovic, INTEGRAND_NARROW),
    ROW("heavy.pow(-.4)", 1, heavy_power, INTEGRAND_NARROW),
    ROW("cov.x", 1, power_1, 1.8),
    ROW("cov.x2", 1, power_2, 2.14),
    ROW("missed.gauss6", 6, missed_gauss6, INTEGRAND_NARROW),
    ROW("offset.step", 1, offset_step, 1),
};

#undef ROW

enum { INTEGRAND_ROWS = sizeof integrand_list / sizeof *integrand_list };

#endif
