#include "guard.h"

#include <math.h>

#include <buffon/student.h>

#include "bell.h"
#include "density_priv.h"
#include "elementary.h"
#include "incomplete.h"
#include "quantile.h"
#include "special.h"

#define STUDENT_LOG_SQRT_2PI 0x1.d67f1c864beb5p-1
#define STUDENT_BELL 20 /* degrees of freedom from which the law is nearly normal */
#define STUDENT_MOST 0x1p1000
#define STUDENT_SQUARE 0x1p500 /* above, a square may overflow */

/* zeta^2 = log(1 + x^2 / dof). `param`: dof, the log of the gain G of bell.h. */
typedef struct student_law {
    double dof, log_gain;
    buffon_priv_bell bell; /* from STUDENT_BELL on */
    buffon_priv_beta beta; /* of x^2 / (dof + x^2), below */
} student_law;

static void student_make(student_law *law, const buffon_density *g)
{
    law->dof = g->param[0];
    law->log_gain = g->param[1];
    if (law->dof >= STUDENT_BELL)
        buffon_priv_bell_make(&law->bell, 0, 1, law->dof, law->log_gain, 2, 1);
    buffon_priv_beta_make(&law->beta, 0.5, 0.5 * law->dof);
}

/* log(1 + x^2 / dof) */
static double student_spread(double x, double dof)
{
    const double size = buffon_priv_abs(x);
    return size < STUDENT_SQUARE ? buffon_priv_log1p(x * x / dof)
                                 : 2 * buffon_priv_log(size) - buffon_priv_log(dof);
}

/* |x| with the probability `outside` beyond it on both sides, less than 1. Of 1 degree of freedom
 * it is a tangent, of 2 it is algebraic. */
static double student_size(const student_law *law, double inside, double outside)
{
    double x, y;
    if (law->dof == 1) {
        buffon_priv_sincospi(&y, &x, 0.5 * outside);
        return x / y < STUDENT_MOST ? x / y : STUDENT_MOST;
    }
    if (law->dof == 2)
        return inside * 0x1.6a09e667f3bcdp+0 / sqrt(outside * (2 - outside));
    if (law->dof >= STUDENT_BELL) {
        const double z = -buffon_priv_normal_quantile(0.5 * outside);
        const double zeta = buffon_priv_bell_quantile(&law->bell, z);
        if (zeta == zeta) {
            const double w = buffon_priv_bell_distance(&law->bell, zeta);
            return law->bell.root * w / sqrt((1 - w) * (1 + w));
        }
    }
    x = buffon_priv_student_from(&law->beta, inside, outside);
    return x < STUDENT_MOST ? x : STUDENT_MOST;
}

/* Both tails and what lies between them are exact, or as good as u. */
static double student_point(const student_law *law, double u)
{
    const double outside = 2 * (u > 0.5 ? 1 - u : u), inside = 2 * buffon_priv_abs(u - 0.5);
    return inside > 0 ? buffon_priv_copysign(student_size(law, inside, outside), u - 0.5) : 0;
}

static double student_log_at(const student_law *law, double x)
{
    return law->log_gain - STUDENT_LOG_SQRT_2PI -
           0.5 * (law->dof + 1) * student_spread(x, law->dof);
}

static double student_pdf_at(const student_law *law, double x)
{
    return x - x == 0 ? buffon_priv_exp(student_log_at(law, x)) : 0;
}

/* P(T <= -size) */
static double student_tail(const student_law *law, double size)
{
    const double spread = student_spread(size, law->dof), zeta = sqrt(spread);
    if (law->dof >= STUDENT_BELL && zeta <= law->bell.reach)
        return buffon_priv_bell_tail(&law->bell, -zeta, 0);
    return 0.5 * buffon_priv_beta_above(&law->beta, 2 * buffon_priv_log(size));
}

static double student_cdf(const student_law *law, double x)
{
    const double tail = x == 0 ? 0.5 : student_tail(law, buffon_priv_abs(x));
    return x > 0 ? 1 - tail : tail;
}

static int student_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    student_law law;
    student_make(&law, g);
    for (size_t i = 0; i < n; i++) {
        x[i] = student_point(&law, density_inside(u[i]));
        if (pdf)
            pdf[i] = student_pdf_at(&law, x[i]);
    }
    return 0;
}

static int student_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    student_law law;
    student_make(&law, g);
    for (size_t i = 0; i < n; i++)
        pdf[i] = student_pdf_at(&law, x[i]);
    return 0;
}

static int student_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    student_law law;
    student_make(&law, g);
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = x[i] - x[i] == 0 ? student_log_at(&law, x[i]) : -(double)INFINITY;
    return 0;
}

static int student_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    student_law law;
    student_make(&law, g);
    for (size_t i = 0; i < n; i++)
        u[i] = density_inside(student_cdf(&law, x[i]));
    return 0;
}

static const buffon_density_ops student_ops = {.sample = student_draw,
                                               .pdf = student_pdf,
                                               .log_pdf = student_log_pdf,
                                               .invert = student_invert,
                                               .name = "buffon.student"};

/* log G, of the quotient of gammas: with z = dof / 2, it is that of Gamma(z + 1/2) over
 * Gamma(z) sqrt(z), by Stirling's formula. */
buffon_density buffon_student_t(double dof)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &student_ops};
    if (dof >= 1e-3 && dof <= 1e100) {
        const double z = 0.5 * dof;
        g.param[0] = dof;
        g.param[1] = buffon_priv_stirling(z + 0.5) - buffon_priv_stirling(z) -
                     z * buffon_priv_deviance(0.5 / z);
    } else {
        g.status = BUFFON_E_SHAPE;
    }
    return g;
}
