/* Private. The table of inverse_table.h, and what its making passes from one step to the next. */
#ifndef BUFFON_SRC_INVERSE_PRIV_H
#define BUFFON_SRC_INVERSE_PRIV_H

#include <buffon/inverse_table.h>

#include "elementary.h"

/* ---- the table ---- */

/* v = c0 + d (c1 + ... + d c5), d = t - from, for t between `from` and `to`. In the centre t is u
 * and v is x, and t grows from row to row. In a tail t is log p and v is log |x - e|; rows go
 * outwards, so that `to` is below `from`; that of the last is -infinity. */
typedef struct inverse_row {
    double from, to, c[6];
} inverse_row;

/* Followed by the rows of the lower tail, the centre and the upper tail, and by the guide, two
 * numbers for each of `bins` equal parts of (0, 1): the bits of the first are 8 k, where the cell k
 * of the centre is the one that the bin's lower end lies in, the second is where that cell ends. */
struct buffon_inverse_table {
    uint64_t magic, bytes;
    uint64_t tail[2], cells, bins; /* numbers of rows: lower and upper tail, centre */
    double u_lo, u_hi, x_lo, x_hi; /* the ends of the centre */
    double end[2], sign[2];        /* x = end + sign e^v in a tail */
    double least, most;            /* of all x */
};

#define INVERSE_MAGIC UINT64_C(0x32766e6966667562) /* "buffinv2" on little-endian machines */

static inline inverse_row *inverse_rows(const buffon_inverse_table *table)
{
    return (inverse_row *)(table + 1);
}

static inline inverse_row *inverse_cells(const buffon_inverse_table *table)
{
    return inverse_rows(table) + table->tail[0];
}

static inline inverse_row *inverse_tail_rows(const buffon_inverse_table *table, int upper)
{
    return inverse_rows(table) + (upper ? table->tail[0] + table->cells : 0);
}

static inline double *inverse_guide(const buffon_inverse_table *table)
{
    return (double *)(inverse_rows(table) + table->tail[0] + table->cells + table->tail[1]);
}

/* v at d of a row, and its derivative. */
static inline double inverse_value(double *slope, const inverse_row *row, double d)
{
    const double *c = row->c;
    *slope = c[1] + d * (2 * c[2] + d * (3 * c[3] + d * (4 * c[4] + d * (5 * c[5]))));
    return c[0] + d * (c[1] + d * (c[2] + d * (c[3] + d * (c[4] + d * c[5]))));
}

/* x and the pdf where p is below (or above) x, in the tail. */
double buffon_priv_inverse_tail(double *pdf, double p, int upper,
                                const buffon_inverse_table *table);

/* ---- panels: the integral of the pdf ---- */

#define INVERSE_NODES 17 /* values on a panel */
#define INVERSE_TERMS 18 /* of the series of their integral */

/* x = origin + scale e^y, the scale a power of two or its negative; x = y where the scale is 0
 * (the origin then serves to tell one run of panels from another). */
typedef struct inverse_map {
    double origin, scale;
} inverse_map;

/* The mass between y0 and y, as Chebyshev polynomials in s, which goes from -1 to 1 as y goes from
 * y0 to y1. */
typedef struct inverse_panel {
    inverse_map map;
    double y0, y1;
    double mass, below, above; /* of the panel, and of all to its left and right */
    double a[INVERSE_TERMS];
} inverse_panel;

typedef struct inverse_builder {
    const buffon_inverse_law *law;
    buffon_inverse_report *report;
    double lo, hi, centre;
    double u_error, tail;
    double cosine[2 * (INVERSE_NODES - 1)]; /* of k pi / 16 */
    inverse_panel *panels;                  /* from left to right once all are there */
    size_t count, room;
    double unit;        /* a power of two that masses are multiplied by; 0 before the first */
    double total;       /* mass so far */
    double error;       /* of it */
    double residual[2]; /* mass beyond the outermost panels */
    double rate[2];     /* residual over pdf by y there; 0 where unknown */
    double reached[2];  /* mass beyond the place to which a tail has its relative accuracy */
    double tail_error;  /* the worst of it until there */
    double noise;       /* of the pdf, relative, where it was met */
    int faint;          /* the last values of the pdf leave the doubles */
} inverse_builder;

/* Fills in the panels, their masses and the total. Non-zero where the law was refused: the report
 * says why. */
int buffon_priv_inverse_integrate(inverse_builder *b);

/* Sets down why the law is refused; returns 1. */
int buffon_priv_inverse_refuse(inverse_builder *b, buffon_status status, const char *why,
                               double where);

/* The mass between y0 and y of a panel. */
double buffon_priv_inverse_part(const inverse_panel *p, double y);

static inline double inverse_x(const inverse_map *map, double y)
{
    return map->scale == 0 ? y : map->origin + map->scale * buffon_priv_exp(y);
}

#endif
