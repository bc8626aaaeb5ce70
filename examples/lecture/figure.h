/* Figures as inline SVG: a panel with two axes, and a globe seen from afar.
 *
 * Colours and line widths are classes of the page's style sheet, so that one figure serves light
 * and dark: c1 .. c5 (the series), exact (the true value), grid, frame, faint.
 */
#ifndef LECTURE_FIGURE_H
#define LECTURE_FIGURE_H

#include "text.h"

typedef struct ruler {
    double lo, hi;
    int log;            /* non-zero: decades */
    const char *label;  /* HTML; NULL: none */
    int no_ticks;       /* non-zero: neither numbers nor grid */
} ruler;

typedef struct panel {
    text *out;
    double width, height;            /* of the drawing */
    double left, right, top, bottom; /* where the axes are */
    ruler x, y;
} panel;

/* Starts a drawing `width` by `height` with its frame, ticks and labels. `alt` says what it is. */
panel panel_begin(text *out, double width, double height, ruler x, ruler y, const char *alt);
void panel_end(panel *p);

/* From the axes to the drawing. */
double panel_x(const panel *p, double x);
double panel_y(const panel *p, double y);

void panel_line(panel *p, const char *class, const double *x, const double *y, size_t n);
/* Between the curve and y = base. */
void panel_area(panel *p, const char *class, const double *x, const double *y, size_t n,
                double base);
/* Round dots of `size` pixels; those outside the axes are left out. */
void panel_dots(panel *p, const char *class, double size, const double *x, const double *y,
                size_t n);
void panel_segment(panel *p, const char *class, double x0, double y0, double x1, double y1);
void panel_rectangle(panel *p, const char *class, double x0, double y0, double x1, double y1);
/* Text at a point of the axes, moved by (dx, dy) pixels. class: start, middle, end. */
void panel_text(panel *p, const char *class, double x, double y, double dx, double dy,
                const char *format, ...) TEXT_PRINTF(7, 8);
/* Bars of counts, normalised to unit area over the n values (those outside lo .. hi count too). */
void panel_histogram(panel *p, const char *class, const double *value, size_t n, double lo,
                     double hi, size_t bins);

/* A chart of one value for each of several things, with a mark where it was expected. */
typedef struct lollipop {
    const char *name, *class;
    double value, expected; /* expected below the axis: no mark */
    char note[64];          /* beside the value */
} lollipop;

void figure_lollipops(text *out, ruler x, const lollipop *stick, size_t n, const char *alt);

/* A unit sphere about the origin in orthographic projection. */
typedef struct globe {
    text *out;
    double width, height, x, y, radius; /* the drawing, and the circle in it */
    double right[3], up[3], towards[3]; /* the eye's axes */
} globe;

/* The eye alone, nothing drawn yet: the sphere will have `radius` pixels in a square of `size`.
 * `above` and `around` are the direction of the eye, in degrees from the xy plane and about z. */
globe globe_eye(text *out, double size, double radius, double above, double around);

/* A drawing with the sphere in it; `hemisphere` non-zero: only its part z >= 0. */
globe globe_begin(text *out, double size, double above, double around, int hemisphere,
                  const char *alt);
void globe_end(globe *g);

/* Where a point of space is drawn; returns its distance towards the eye. */
double globe_project(const globe *g, const double v[3], double *x, double *y);

/* Dots; those on the far side get the class "far" too. x[3 * n], point after point. */
void globe_dots(globe *g, const char *class, double size, const double *x, size_t n);
/* The circle of directions v with v . middle = cosine, middle a unit vector. */
void globe_circle(globe *g, const char *class, const double middle[3], double cosine);
/* The circle about z at this height and radius, such as the rim of a cylinder. */
void globe_ring(globe *g, const char *class, double radius, double z);
void globe_segment(globe *g, const char *class, const double from[3], const double to[3]);
void globe_text(globe *g, const char *class, const double at[3], double dx, double dy,
                const char *what);

#endif
