/* The gallery: a card for each density, with a picture of its points. */
#ifndef GALLERY_H
#define GALLERY_H

#include <buffon/buffon.h>

#include "../lecture/figure.h"

/* How a density is looked at. The names below make one for a line of entries.h. */
typedef struct view {
    enum { VIEW_LINE, VIEW_BARS, VIEW_PLANE, VIEW_SPHERE, VIEW_SPACE, VIEW_FRAMES } kind;
    double a, b, c, d; /* what is seen */
    int extra;         /* LINE: decades of a log scale; PLANE: shades; SPHERE: no net */
} view;

/* A law on the line: a histogram of points from lo to hi, and the density. */
#define LINE(lo, hi) ((view){VIEW_LINE, lo, hi, 0, 0, 0})
/* The same on a logarithmic scale, so many decades down from the top: for tails. */
#define TAILS(lo, hi, decades) ((view){VIEW_LINE, lo, hi, 0, 0, decades})
/* A law on the whole numbers lo to hi: the share of points at each, and the probability. */
#define BARS(lo, hi) ((view){VIEW_BARS, lo, hi, 0, 0, 0})
/* A law in the plane: points. */
#define PLANE(left, right, low, high) ((view){VIEW_PLANE, left, right, low, high, 0})
/* The same over shades of the density. */
#define FIELD(left, right, low, high) ((view){VIEW_PLANE, left, right, low, high, 1})
/* Directions: points on the unit sphere. */
#define SPHERE ((view){VIEW_SPHERE, 0, 0, 0, 1, 0})
/* The same without a net: where it would say little, and for solids in the unit sphere. */
#define SKY ((view){VIEW_SPHERE, 0, 0, 0, 1, 1})
/* A surface or a solid in space, seen from afar: what lies within r of (x, y, z). */
#define SPACE(x, y, z, r) ((view){VIEW_SPACE, x, y, z, r, 0})
/* Rotations as quaternions: the images of +z, with hairs along the images of +x. */
#define FRAMES ((view){VIEW_FRAMES, 0, 0, 0, 1, 0})

/* Appends a drawing of g in the colour of the class. */
void view_draw(text *out, const buffon_density *g, view v, const char *class);

/* Ends the program unless all is well. */
void gallery_check(buffon_status status, const char *what);

#endif
