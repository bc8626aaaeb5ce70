/* Globes: the unit sphere seen from far away, so that what is drawn is the coordinates across the
 * line of sight. What lies behind is drawn fainter. */
#include "figure.h"

#include <math.h>

#define GLOBE_PI 3.14159265358979323846
#define GLOBE_STEPS 72

static double globe_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void globe_cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

double globe_project(const globe *g, const double v[3], double *x, double *y)
{
    *x = g->x + g->radius * globe_dot(v, g->right);
    *y = g->y - g->radius * globe_dot(v, g->up);
    return globe_dot(v, g->towards);
}

globe globe_eye(text *out, double size, double radius, double above, double around)
{
    double a = above * GLOBE_PI / 180, b = around * GLOBE_PI / 180;
    globe g = {.out = out, .width = size, .height = size, .x = size / 2, .y = size / 2};
    g.radius = radius;
    g.towards[0] = cos(a) * cos(b);
    g.towards[1] = cos(a) * sin(b);
    g.towards[2] = sin(a);
    g.right[0] = -sin(b);
    g.right[1] = cos(b);
    globe_cross(g.up, g.towards, g.right);
    return g;
}

globe globe_begin(text *out, double size, double above, double around, int hemisphere,
                  const char *alt)
{
    static const double pole[3] = {0, 0, 1};
    globe g = globe_eye(out, size, size / 2 - 14, above, around);
    if (hemisphere) {
        g.y = g.radius + (above < 60 && size > 400 ? 40 : 14); /* room for the normal */
        g.height = g.y + g.radius * g.towards[2] + 14;
    }
    text_add(out, "<svg viewBox=\"0 0 %g %.0f\" role=\"img\" aria-label=\"%s\">", size, g.height,
             alt);
    if (hemisphere) {
        for (int k = 1; k < 3; k++)
            globe_circle(&g, "wire", pole, sin(k * GLOBE_PI / 6));
        globe_circle(&g, "rim", pole, 0);
        text_add(out, "<path class=\"line rim\" d=\"M%.1f %.1fA%.1f %.1f 0 0 1 %.1f %.1f\"/>",
                 g.x - g.radius, g.y, g.radius, g.radius, g.x + g.radius, g.y);
    } else {
        for (int k = -2; k < 3; k++)
            globe_circle(&g, k == 0 ? "wire rim" : "wire", pole, sin(k * GLOBE_PI / 6));
        text_add(out, "<circle class=\"line rim\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>", g.x, g.y,
                 g.radius);
    }
    return g;
}

void globe_end(globe *g)
{
    text_put(g->out, "</svg>\n");
}

void globe_dots(globe *g, const char *class, double size, const double *x, size_t n)
{
    for (int near = 0; near < 2; near++) {
        size_t drawn = 0;
        for (size_t i = 0; i < n; i++) {
            double px, py;
            if ((globe_project(g, x + 3 * i, &px, &py) >= 0) != near)
                continue;
            if (drawn++ == 0)
                text_add(g->out, "<path class=\"dots %s%s\" stroke-width=\"%g\" d=\"", class,
                         near ? "" : " far", size);
            text_add(g->out, "M%.1f %.1fh0", px, py);
        }
        if (drawn > 0)
            text_put(g->out, "\"/>");
    }
}

/* Two directions at right angles to this one. */
static void globe_basis(double a[3], double b[3], const double middle[3])
{
    double other[3] = {fabs(middle[0]) < 0.6, fabs(middle[0]) >= 0.6, 0};
    globe_cross(a, middle, other);
    double length = sqrt(globe_dot(a, a));
    for (int k = 0; k < 3; k++)
        a[k] /= length;
    globe_cross(b, middle, a);
}

/* Draws on to (x, y). On the other side of the globe another line begins; side -1: the first. */
static void globe_stroke(globe *g, const char *class, double x, double y, int near, int *side)
{
    if (*side >= 0)
        text_add(g->out, "L%.1f %.1f", x, y);
    if (near == *side)
        return;
    if (*side >= 0)
        text_put(g->out, "\"/>");
    text_add(g->out, "<path class=\"line %s%s\" d=\"M%.1f %.1f", class, near ? "" : " far", x, y);
    *side = near;
}

void globe_circle(globe *g, const char *class, const double middle[3], double cosine)
{
    double a[3], b[3], sine = sqrt(1 - cosine * cosine);
    int side = -1;
    globe_basis(a, b, middle);
    for (int i = 0; i <= GLOBE_STEPS; i++) {
        double t = 2 * GLOBE_PI * i / GLOBE_STEPS, v[3], x, y;
        for (int k = 0; k < 3; k++)
            v[k] = cosine * middle[k] + sine * (cos(t) * a[k] + sin(t) * b[k]);
        int near = globe_project(g, v, &x, &y) >= -1e-9;
        globe_stroke(g, class, x, y, near, &side);
    }
    text_put(g->out, "\"/>");
}

void globe_ring(globe *g, const char *class, double radius, double z)
{
    int side = -1;
    for (int i = 0; i <= GLOBE_STEPS; i++) {
        double t = 2 * GLOBE_PI * i / GLOBE_STEPS, x, y;
        double v[3] = {radius * cos(t), radius * sin(t), z};
        int near = globe_project(g, v, &x, &y) - z * g->towards[2] >= -1e-9;
        globe_stroke(g, class, x, y, near, &side);
    }
    text_put(g->out, "\"/>");
}

void globe_segment(globe *g, const char *class, const double from[3], const double to[3])
{
    double x0, y0, x1, y1;
    globe_project(g, from, &x0, &y0);
    globe_project(g, to, &x1, &y1);
    text_add(g->out, "<path class=\"line %s\" d=\"M%.1f %.1fL%.1f %.1f\"/>", class, x0, y0, x1, y1);
}

void globe_text(globe *g, const char *class, const double at[3], double dx, double dy,
                const char *what)
{
    double x, y;
    globe_project(g, at, &x, &y);
    text_add(g->out, "<text class=\"note %s\" x=\"%.1f\" y=\"%.1f\">%s</text>", class, x + dx,
             y + dy, what);
}
