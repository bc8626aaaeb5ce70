/* Panels: axes, ticks and marks. */
#include "figure.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

double panel_x(const panel *p, double x)
{
    double t = p->x.log ? log(x / p->x.lo) / log(p->x.hi / p->x.lo)
                        : (x - p->x.lo) / (p->x.hi - p->x.lo);
    return p->left + t * (p->right - p->left);
}

double panel_y(const panel *p, double y)
{
    double t = p->y.log ? log(y / p->y.lo) / log(p->y.hi / p->y.lo)
                        : (y - p->y.lo) / (p->y.hi - p->y.lo);
    return p->bottom + t * (p->top - p->bottom);
}

/* A step of 1, 2 or 5 times a power of ten that cuts the range into about `wanted` parts. */
static double figure_step(double range, double wanted)
{
    double unit = pow(10, floor(log10(range / wanted)));
    double parts = range / unit / wanted;
    return unit * (parts < 1.5 ? 1 : parts < 3.5 ? 2 : parts < 7.5 ? 5 : 10);
}

/* A whole power of ten as HTML cannot be had in SVG text; a raised tspan can. */
static void figure_power(text *out, int exponent)
{
    if (exponent >= -1 && exponent <= 3)
        text_add(out, "%g", pow(10, exponent));
    else
        text_add(out, "10<tspan class=\"raise\" dy=\"-5\">%s%d</tspan>",
                 exponent < 0 ? "&#8722;" : "", abs(exponent));
}

static void figure_number(text *out, double v, double step)
{
    int decimals = step >= 1 ? 0 : (int)ceil(-log10(step) - 1e-9);
    if (fabs(v) < step * 1e-9)
        text_put(out, "0");
    else
        text_add(out, "%s%.*f", v < 0 ? "&#8722;" : "", decimals, fabs(v));
}

/* One tick with its number and its line across the panel. */
static void panel_tick(panel *p, int vertical, double v, double step)
{
    if (vertical) {
        double y = panel_y(p, v);
        text_add(p->out, "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>", p->left, y, p->right);
        text_add(p->out, "<text class=\"tick end\" x=\"%.1f\" y=\"%.1f\">", p->left - 7, y + 4);
    } else {
        double x = panel_x(p, v);
        text_add(p->out, "<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>", x, p->top, p->bottom);
        text_add(p->out, "<text class=\"tick middle\" x=\"%.1f\" y=\"%.1f\">", x, p->bottom + 17);
    }
    if (step > 0)
        figure_number(p->out, v, step);
    else
        figure_power(p->out, (int)lround(log10(v)));
    text_put(p->out, "</text>");
}

static void panel_ticks(panel *p, int vertical)
{
    const ruler *a = vertical ? &p->y : &p->x;
    double pixels = vertical ? p->bottom - p->top : p->right - p->left;
    if (a->no_ticks)
        return;
    if (a->log) {
        double decades = log10(a->hi / a->lo), room = pixels / (vertical ? 26 : 46);
        int every = decades > room ? (int)ceil(decades / room) : 1;
        int first = (int)ceil(log10(a->lo) - 1e-9), last = (int)floor(log10(a->hi) + 1e-9);
        for (int e = first; e <= last; e++)
            if (e % every == 0)
                panel_tick(p, vertical, pow(10, e), 0);
        return;
    }
    double step = figure_step(a->hi - a->lo, pixels / (vertical ? 45 : 80));
    double first = ceil(a->lo / step - 1e-9), last = floor(a->hi / step + 1e-9);
    for (double k = first; k <= last; k++)
        panel_tick(p, vertical, k * step, step);
}

panel panel_begin(text *out, double width, double height, ruler x, ruler y, const char *alt)
{
    panel p = {.out = out, .width = width, .height = height, .x = x, .y = y};
    p.left = y.label != NULL ? (y.no_ticks ? 30 : 62) : (!y.no_ticks ? 44 : x.no_ticks ? 10 : 22);
    p.right = width - 14;
    p.top = 10;
    p.bottom = height - (x.label != NULL ? 44 : x.no_ticks ? 8 : 24);
    text_add(out, "<svg viewBox=\"0 0 %g %g\" role=\"img\" aria-label=\"%s\">", width, height, alt);
    panel_ticks(&p, 0);
    panel_ticks(&p, 1);
    if (!x.no_ticks || x.label != NULL)
        text_add(out, "<path class=\"frame\" d=\"M%.1f %.1fV%.1fH%.1f\"/>", p.left,
                 y.no_ticks ? p.bottom : p.top, p.bottom, p.right);
    if (x.label != NULL)
        text_add(out, "<text class=\"label middle\" x=\"%.1f\" y=\"%.1f\">%s</text>",
                 (p.left + p.right) / 2, height - 7, x.label);
    if (y.label != NULL)
        text_add(out, "<text class=\"label middle\" transform=\"translate(15 %.1f) rotate(-90)\">%s"
                 "</text>", (p.top + p.bottom) / 2, y.label);
    return p;
}

void panel_end(panel *p)
{
    text_put(p->out, "</svg>\n");
}

static void panel_path(panel *p, const double *x, const double *y, size_t n)
{
    for (size_t i = 0; i < n; i++)
        text_add(p->out, "%s%.1f %.1f", i == 0 ? "M" : i == 1 ? "L" : " ", panel_x(p, x[i]),
                 panel_y(p, y[i]));
}

void panel_line(panel *p, const char *class, const double *x, const double *y, size_t n)
{
    text_add(p->out, "<path class=\"line %s\" d=\"", class);
    panel_path(p, x, y, n);
    text_put(p->out, "\"/>");
}

void panel_area(panel *p, const char *class, const double *x, const double *y, size_t n,
                double base)
{
    if (n == 0)
        return;
    text_add(p->out, "<path class=\"area %s\" d=\"", class);
    panel_path(p, x, y, n);
    text_add(p->out, "L%.1f %.1fH%.1fZ\"/>", panel_x(p, x[n - 1]), panel_y(p, base),
             panel_x(p, x[0]));
}

void panel_dots(panel *p, const char *class, double size, const double *x, const double *y,
                size_t n)
{
    size_t drawn = 0;
    for (size_t i = 0; i < n; i++) {
        double px = panel_x(p, x[i]), py = panel_y(p, y[i]);
        if (!(px >= p->left - 1 && px <= p->right + 1 && py >= p->top - 1 && py <= p->bottom + 1))
            continue;
        if (drawn++ == 0)
            text_add(p->out, "<path class=\"dots %s\" stroke-width=\"%g\" d=\"", class, size);
        text_add(p->out, "M%.1f %.1fh0", px, py); /* a line of no length with round ends */
    }
    if (drawn > 0)
        text_put(p->out, "\"/>");
}

void panel_segment(panel *p, const char *class, double x0, double y0, double x1, double y1)
{
    text_add(p->out, "<path class=\"line %s\" d=\"M%.1f %.1fL%.1f %.1f\"/>", class, panel_x(p, x0),
             panel_y(p, y0), panel_x(p, x1), panel_y(p, y1));
}

void panel_rectangle(panel *p, const char *class, double x0, double y0, double x1, double y1)
{
    double left = panel_x(p, fmin(x0, x1)), right = panel_x(p, fmax(x0, x1));
    double top = panel_y(p, fmax(y0, y1)), bottom = panel_y(p, fmin(y0, y1));
    text_add(p->out, "<path class=\"area %s\" d=\"M%.1f %.1fH%.1fV%.1fH%.1fZ\"/>", class, left, top,
             right, bottom, left);
}

void panel_text(panel *p, const char *class, double x, double y, double dx, double dy,
                const char *format, ...)
{
    char what[256];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= sizeof what)
        give_up("figure", "a label is too long");
    text_add(p->out, "<text class=\"note %s\" x=\"%.1f\" y=\"%.1f\">%s</text>", class,
             panel_x(p, x) + dx, panel_y(p, y) + dy, what);
}

void figure_lollipops(text *out, ruler x, const lollipop *stick, size_t n, const char *alt)
{
    ruler y = {.lo = (double)n, .hi = 0, .no_ticks = 1};
    panel p = panel_begin(out, 860, 60 + 50 * (double)n, x, y, alt);
    for (size_t i = 0; i < n; i++) {
        double row = (double)i + 0.68;
        int shown = stick[i].value > x.lo;
        double value = shown ? stick[i].value : x.lo;
        if (shown) {
            panel_segment(&p, stick[i].class, x.lo, row, value, row);
            panel_dots(&p, stick[i].class, 11, &value, &row, 1);
        }
        double expected = stick[i].expected;
        if (expected > x.lo)
            panel_segment(&p, "exact", expected, row - 0.22, expected, row + 0.22);
        panel_text(&p, "halo", x.lo, row, 8, -9, "%s", stick[i].name);
        panel_text(&p, "halo bold", fmax(value, expected), row, 12, 4, "%s", stick[i].note);
    }
    panel_end(&p);
}

void panel_histogram(panel *p, const char *class, const double *value, size_t n, double lo,
                     double hi, size_t bins)
{
    double width = (hi - lo) / (double)bins;
    text_add(p->out, "<path class=\"area %s\" d=\"M%.1f %.1f", class, panel_x(p, lo),
             panel_y(p, 0));
    for (size_t b = 0; b < bins; b++) {
        size_t count = 0;
        double from = lo + (double)b * width, to = lo + (double)(b + 1) * width;
        for (size_t i = 0; i < n; i++)
            count += value[i] >= from && value[i] < to;
        text_add(p->out, "V%.1fH%.1f", panel_y(p, (double)count / (double)n / width),
                 panel_x(p, to));
    }
    text_add(p->out, "V%.1fZ\"/>", panel_y(p, 0));
}
