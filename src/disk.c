#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/disk.h>

#include "circle.h"
#include "density_priv.h"
#include "elementary.h"
#include "frame.h"

/* The numbers of a ring in `param`: the outer radius; (r0 / r1)^2 and 1 less it; the first angle
 * and the angle between both, in turns; the pdf; the largest radius drawn. */
enum { RING_RADIUS, RING_INNER, RING_WIDTH, RING_FROM, RING_TURN, RING_DENSITY, RING_RIM };

#define KERNELS "disk_lanes.h"
#include "levels.h"

static double disk_density(double radius)
{
    return DENSITY_INV_PI / radius / radius;
}

static int disk_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    LEVELS_RUN(disk_polar, (x, x + n, u, u + n, n, g->param[0]));
    if (pdf)
        density_fill(pdf, disk_density(g->param[0]), n);
    return 0;
}

static int disk_draw_concentric(double *x, double *pdf, const double *u, size_t n,
                                const buffon_density *g)
{
    LEVELS_RUN(disk_concentric, (x, x + n, u, u + n, n, g->param[0], g->param[0]));
    if (pdf)
        density_fill(pdf, disk_density(g->param[0]), n);
    return 0;
}

/* `inside` at points of an ellipse, `outside` elsewhere; no square leaves the doubles. A disk has
 * both half-axes equal. */
static void disk_judge(double *out, const double *x, size_t n, double across, double up,
                       double inside, double outside)
{
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] / across, b = x[n + i] / up;
        out[i] = a * a + b * b <= 1 ? inside : outside;
    }
}

static int disk_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double radius = g->param[0];
    disk_judge(pdf, x, n, radius, radius, disk_density(radius), 0);
    return 0;
}

static int disk_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double radius = g->param[0], log_pi = 0x1.250d048e7a1bdp+0;
    const double inside = -(log_pi + 2 * buffon_priv_log(radius));
    disk_judge(log_pdf, x, n, radius, radius, inside, -(double)INFINITY);
    return 0;
}

static int disk_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const double point[2] = {x[i] / g->param[0], x[n + i] / g->param[0]};
        double v[2];
        buffon_disk_invert(v, point);
        u[i] = v[0];
        u[n + i] = v[1];
    }
    return 0;
}

static void disk_unmap_square(double *u, const double *x, size_t n, double across, double up)
{
    for (size_t i = 0; i < n; i++) {
        double v[2];
        buffon_priv_concentric_invert(v, x[i] / across, x[n + i] / up);
        u[i] = v[0];
        u[n + i] = v[1];
    }
}

static int disk_unmap_concentric(double *u, const double *x, size_t n, const buffon_density *g)
{
    disk_unmap_square(u, x, n, g->param[0], g->param[0]);
    return 0;
}

static const buffon_density_ops disk_ops = {.sample = disk_draw,
                                            .pdf = disk_pdf,
                                            .log_pdf = disk_log_pdf,
                                            .invert = disk_unmap,
                                            .name = "buffon.disk"};

static const buffon_density_ops disk_concentric_ops = {.sample = disk_draw_concentric,
                                                       .pdf = disk_pdf,
                                                       .log_pdf = disk_log_pdf,
                                                       .invert = disk_unmap_concentric,
                                                       .name = "buffon.disk_concentric"};

static buffon_density disk_make(double radius, const buffon_density_ops *ops)
{
    buffon_density g = {.uniforms = 2, .dim = 2, .ops = ops};
    if (radius > 0 && buffon_priv_isfinite(radius))
        g.param[0] = radius;
    else
        g.status = BUFFON_E_SHAPE;
    return g;
}

buffon_density buffon_disk(double radius)
{
    return disk_make(radius, &disk_ops);
}

buffon_density buffon_disk_concentric(double radius)
{
    return disk_make(radius, &disk_concentric_ops);
}

void buffon_disk_sample(double x[2], double u1, double u2)
{
    disk_polar_scalar(x, x + 1, &u1, &u2, 1, 1);
}

void buffon_disk_sample_concentric(double x[2], double u1, double u2)
{
    disk_concentric_scalar(x, x + 1, &u1, &u2, 1, 1, 1);
}

void buffon_disk_invert(double u[2], const double x[2])
{
    const double a = x[0], b = x[1];
    u[0] = density_open(a * a + b * b);
    u[1] = buffon_priv_circle_invert(a, b);
}

void buffon_disk_invert_concentric(double u[2], const double x[2])
{
    buffon_priv_concentric_invert(u, x[0], x[1]);
}

/* ---- circles ------------------------------------------------------------------------------ */

static double disk_edge_density(const buffon_density *g)
{
    return 0.5 * DENSITY_INV_PI / g->param[0];
}

static int disk_draw_edge(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    LEVELS_RUN(disk_edge, (x, x + n, u, n, g->param[0]));
    if (pdf)
        density_fill(pdf, disk_edge_density(g), n);
    return 0;
}

static int disk_pdf_edge(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double value = disk_edge_density(g);
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] / g->param[0], b = x[n + i] / g->param[0];
        pdf[i] = frame_is_unit(a, b, 0) ? value : 0;
    }
    return 0;
}

static int disk_unmap_edge(double *u, const double *x, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++)
        u[i] = buffon_priv_circle_invert(x[i], x[n + i]);
    return 0;
}

static const buffon_density_ops disk_edge_ops = {.sample = disk_draw_edge,
                                                 .pdf = disk_pdf_edge,
                                                 .invert = disk_unmap_edge,
                                                 .name = "buffon.circle"};

buffon_density buffon_circle(double radius)
{
    buffon_density g = {.uniforms = 1, .dim = 2, .ops = &disk_edge_ops};
    if (radius >= DBL_MIN && radius <= 0x1p1017)
        g.param[0] = radius;
    else
        g.status = BUFFON_E_SHAPE;
    return g;
}

/* ---- rings and sectors -------------------------------------------------------------------- */

static int disk_draw_ring(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    LEVELS_RUN(disk_ring, (x, x + n, u, u + n, n, g->param));
    if (pdf)
        density_fill(pdf, g->param[RING_DENSITY], n);
    return 0;
}

/* The angle from the first edge of a sector to a point, in turns from 0 to 1. */
static double disk_turn(const buffon_density *g, double x, double y)
{
    double t = 0.5 * buffon_priv_atan2pi(y, x) - g->param[RING_FROM];
    while (t < 0)
        t += 1;
    while (t > 1)
        t -= 1;
    return t;
}

static int disk_pdf_ring(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double slack = 0x1p-50, inner = g->param[RING_INNER] * (1 - 2 * slack);
    const double last = g->param[RING_TURN] + slack;
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] / g->param[RING_RADIUS], b = x[n + i] / g->param[RING_RADIUS];
        const double s = a * a + b * b;
        int in = s >= inner && s <= 1 + 2 * slack;
        if (in && last < 1) {
            const double t = disk_turn(g, a, b);
            in = t <= last || t >= 1 - slack;
        }
        pdf[i] = in ? g->param[RING_DENSITY] : 0;
    }
    return 0;
}

/* A point that rounding has led past the first edge has a turn near 1, which belongs to 0. */
static int disk_unmap_ring(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double turn = g->param[RING_TURN], last = 0.5 * (1 + turn);
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] / g->param[RING_RADIUS], b = x[n + i] / g->param[RING_RADIUS];
        const double t = disk_turn(g, a, b);
        u[i] = density_open((a * a + b * b - g->param[RING_INNER]) / g->param[RING_WIDTH]);
        u[n + i] = density_open(t > last ? 0 : t / turn);
    }
    return 0;
}

static const buffon_density_ops disk_ring_ops = {.sample = disk_draw_ring,
                                                 .pdf = disk_pdf_ring,
                                                 .invert = disk_unmap_ring,
                                                 .name = "buffon.annulus"};

/* The area is (r1 - r0) (r1 + r0) half the angle, whose factors keep the digits of thin rings. */
static buffon_density disk_make_ring(double r0, double r1, double from, double turn, double half)
{
    buffon_density g = {.uniforms = 2, .dim = 2, .ops = &disk_ring_ops};
    const double squares = (r1 - r0) * (r1 + r0), density = 1 / (squares * half);
    if (!(r0 >= 0 && r0 < r1 && squares >= DBL_MIN && squares <= 0x1p1020 && turn > 0 &&
          turn <= 1 && buffon_priv_isfinite(density))) {
        g.status = BUFFON_E_SHAPE;
        return g;
    }
    g.param[RING_RADIUS] = r1;
    g.param[RING_INNER] = r0 / r1 * (r0 / r1);
    g.param[RING_WIDTH] = (r1 - r0) / r1 * ((r1 + r0) / r1);
    g.param[RING_FROM] = from;
    g.param[RING_TURN] = turn;
    g.param[RING_DENSITY] = density;
    g.param[RING_RIM] = r0 > 0 ? 2 : CIRCLE_RIM;
    return g;
}

buffon_density buffon_annulus(double r0, double r1)
{
    return disk_make_ring(r0, r1, 0, 1, 0x1.921fb54442d18p+1);
}

buffon_density buffon_disk_sector(double r0, double r1, double angle0, double angle1)
{
    const double full = 0x1.921fb54442d18p+2, angle = angle1 - angle0;
    const int valid = angle0 >= -full && angle1 <= full;
    return disk_make_ring(r0, r1, angle0 / full, valid ? angle / full : (double)NAN, 0.5 * angle);
}

/* ---- ellipses ----------------------------------------------------------------------------- */

static double disk_ellipse_density(const buffon_density *g)
{
    return DENSITY_INV_PI / (g->param[0] * g->param[1]);
}

static int disk_draw_ellipse(double *x, double *pdf, const double *u, size_t n,
                             const buffon_density *g)
{
    LEVELS_RUN(disk_concentric, (x, x + n, u, u + n, n, g->param[0], g->param[1]));
    if (pdf)
        density_fill(pdf, disk_ellipse_density(g), n);
    return 0;
}

static int disk_pdf_ellipse(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    disk_judge(pdf, x, n, g->param[0], g->param[1], disk_ellipse_density(g), 0);
    return 0;
}

static int disk_unmap_ellipse(double *u, const double *x, size_t n, const buffon_density *g)
{
    disk_unmap_square(u, x, n, g->param[0], g->param[1]);
    return 0;
}

static const buffon_density_ops disk_ellipse_ops = {.sample = disk_draw_ellipse,
                                                    .pdf = disk_pdf_ellipse,
                                                    .invert = disk_unmap_ellipse,
                                                    .name = "buffon.ellipse"};

buffon_density buffon_ellipse(double a, double b)
{
    buffon_density g = {.uniforms = 2, .dim = 2, .ops = &disk_ellipse_ops};
    const double area = a * b;
    if (a >= DBL_MIN && b >= DBL_MIN && area >= DBL_MIN && area <= 0x1p1020) {
        g.param[0] = a;
        g.param[1] = b;
    } else {
        g.status = BUFFON_E_SHAPE;
    }
    return g;
}
