#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/ball.h>

#include "circle.h"
#include "density_priv.h"
#include "elementary.h"

/* The numbers of a shell in `param`: the outer radius; (r0 / r1)^3 and 1 less it; the pdf; the
 * largest radius drawn; r0 / r1. */
enum { BALL_RADIUS, BALL_INNER, BALL_WIDTH, BALL_DENSITY, BALL_RIM, BALL_RATIO };

#define KERNELS "ball_lanes.h"
#include "levels.h"

static int ball_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    LEVELS_RUN(ball_map, (x, x + n, x + 2 * n, u, n, g->param));
    if (pdf)
        density_fill(pdf, g->param[BALL_DENSITY], n);
    return 0;
}

static int ball_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double radius = g->param[BALL_RADIUS], ratio = g->param[BALL_RATIO];
    const double least = ratio * ratio * (1 - 0x1p-49), most = 1 + 0x1p-49;
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] / radius, b = x[n + i] / radius, c = x[2 * n + i] / radius;
        const double s = a * a + b * b + c * c;
        pdf[i] = s >= least && s <= most ? g->param[BALL_DENSITY] : 0;
    }
    return 0;
}

/* The direction back as of a sphere: its depth from the nearer pole. */
static int ball_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double radius = g->param[BALL_RADIUS];
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] / radius, b = x[n + i] / radius, c = x[2 * n + i] / radius;
        const double flat = a * a + b * b, r = sqrt(flat + c * c);
        const double depth = r > 0 ? 0.5 * flat / (r * (r + buffon_priv_abs(c))) : 0.5;
        u[i] = density_open((r * r * r - g->param[BALL_INNER]) / g->param[BALL_WIDTH]);
        u[n + i] = density_open(c > 0 ? depth : 1 - depth);
        u[2 * n + i] = buffon_priv_circle_invert(a, b);
    }
    return 0;
}

static const buffon_density_ops ball_ops = {
    .sample = ball_draw, .pdf = ball_pdf, .invert = ball_invert, .name = "buffon.ball"};

/* r1^3 - r0^3 = (r1 - r0) (r1^2 + r1 r0 + r0^2), whose factors keep the digits of thin shells. */
buffon_density buffon_shell(double r0, double r1)
{
    buffon_density g = {.uniforms = 3, .dim = 3, .ops = &ball_ops};
    const double cubes = (r1 - r0) * (r1 * r1 + r0 * (r1 + r0)), ratio = r0 / r1;
    if (!(r0 >= 0 && r0 < r1 && cubes >= DBL_MIN && cubes <= 0x1p1020)) {
        g.status = BUFFON_E_SHAPE;
        return g;
    }
    g.param[BALL_RADIUS] = r1;
    g.param[BALL_INNER] = ratio * ratio * ratio;
    g.param[BALL_WIDTH] = (r1 - r0) / r1 * (1 + ratio * (1 + ratio));
    g.param[BALL_DENSITY] = 0.75 * DENSITY_INV_PI / cubes;
    g.param[BALL_RIM] = r0 > 0 ? 2 : CIRCLE_RIM;
    g.param[BALL_RATIO] = ratio;
    return g;
}

buffon_density buffon_ball(double radius)
{
    return buffon_shell(0, radius);
}
