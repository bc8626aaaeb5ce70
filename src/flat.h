/* Private. Flat pieces: segments, triangles and tetrahedra; parallelograms and boxes on the skew.
 * Each is an origin and one to three edges from it. */
#ifndef BUFFON_SRC_FLAT_H
#define BUFFON_SRC_FLAT_H

#include <buffon/density.h>

#include "pair.h"

/* The numbers of a piece in `param`: the origin, three edges (zeros where there are fewer), g, and
 * how far from the piece a point may lie for rounding. `uniforms` is the number of edges. */
enum { FLAT_EDGES = 3, FLAT_DENSITY = 12, FLAT_SLACK };

/* The most coordinates a standard simplex may have: the last factorial that is a double. */
#define FLAT_DIM_MAX 170

/* Which of the pieces with given edges. */
typedef enum flat_kind { FLAT_SIMPLEX, FLAT_BOX } flat_kind;

/* Fills g->param, or sets g->status. Edges have three coordinates whatever g->dim. */
void buffon_priv_flat_make(buffon_density *g, flat_kind kind, const double origin[3],
                           pair (*edge)[3]);

/* The operations of a density. */
int buffon_priv_flat_draw(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g, flat_kind kind);
int buffon_priv_flat_pdf(double *pdf, const double *x, size_t n, const buffon_density *g,
                         flat_kind kind);
int buffon_priv_flat_invert(double *u, const double *x, size_t n, const buffon_density *g,
                            flat_kind kind);

/* Points of the standard simplex {w > 0, sum of w < 1} of `dim` coordinates. */
void buffon_priv_flat_weights(double *w, const double *u, size_t n, size_t dim);

/* The way back for one point: u[j * stride] from w[j * stride], u apart from w. */
void buffon_priv_flat_uniforms(double *u, const double *w, size_t stride, size_t dim);

#endif
