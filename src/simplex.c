#include "guard.h"

#include <buffon/simplex.h>

#include "density_priv.h"
#include "flat.h"

/* ---- segment, triangle, tetrahedron ---- */

static int simplex_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    return buffon_priv_flat_draw(x, pdf, u, n, g, FLAT_SIMPLEX);
}

static int simplex_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    return buffon_priv_flat_pdf(pdf, x, n, g, FLAT_SIMPLEX);
}

static int simplex_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    return buffon_priv_flat_invert(u, x, n, g, FLAT_SIMPLEX);
}

static const buffon_density_ops simplex_piece_ops = {
    .sample = simplex_draw, .pdf = simplex_pdf, .invert = simplex_unmap, .name = "buffon.piece"};

static buffon_density simplex_make(const double *const *vertex, size_t edges, size_t dim)
{
    buffon_density g = {.uniforms = edges, .dim = dim, .ops = &simplex_piece_ops};
    double origin[3] = {0};
    pair edge[3][3] = {{{0}}};
    for (size_t k = 0; k <= edges; k++)
        if (!vertex[k])
            g.status = BUFFON_E_NULL;
    if (g.status != BUFFON_OK)
        return g;
    for (size_t j = 0; j < dim; j++) {
        origin[j] = vertex[0][j];
        for (size_t k = 0; k < edges; k++)
            edge[k][j] = pair_difference(vertex[k + 1][j], vertex[0][j]);
    }
    buffon_priv_flat_make(&g, FLAT_SIMPLEX, origin, edge);
    return g;
}

buffon_density buffon_segment_between(const double a[3], const double b[3])
{
    const double *const vertex[] = {a, b};
    return simplex_make(vertex, 1, 3);
}

buffon_density buffon_triangle(const double a[3], const double b[3], const double c[3])
{
    const double *const vertex[] = {a, b, c};
    return simplex_make(vertex, 2, 3);
}

buffon_density buffon_triangle_flat(const double a[2], const double b[2], const double c[2])
{
    const double *const vertex[] = {a, b, c};
    return simplex_make(vertex, 2, 2);
}

buffon_density buffon_tetrahedron(const double a[3], const double b[3], const double c[3],
                                  const double d[3])
{
    const double *const vertex[] = {a, b, c, d};
    return simplex_make(vertex, 3, 3);
}

/* ---- the standard simplex ---- */

static int simplex_standard_draw(double *x, double *pdf, const double *u, size_t n,
                                 const buffon_density *g)
{
    buffon_priv_flat_weights(x, u, n, g->dim);
    if (pdf)
        density_fill(pdf, g->param[0], n);
    return 0;
}

/* A sum of `dim` rounded numbers may pass 1 by half an ulp of 1 for each. */
static int simplex_standard_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double most = 1 + (double)g->dim * 0x1p-52;
    for (size_t i = 0; i < n; i++) {
        double sum = 0;
        int in = 1;
        for (size_t j = 0; j < g->dim; j++) {
            in &= x[j * n + i] >= 0;
            sum += x[j * n + i];
        }
        in &= sum <= most;
        pdf[i] = in ? g->param[0] : 0;
    }
    return 0;
}

static int simplex_standard_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        buffon_priv_flat_uniforms(u + i, x + i, n, g->dim);
    return 0;
}

static const buffon_density_ops simplex_standard_ops = {.sample = simplex_standard_draw,
                                                        .pdf = simplex_standard_pdf,
                                                        .invert = simplex_standard_unmap,
                                                        .name = "buffon.simplex"};

/* The density is dim!, rounded once. */
buffon_density buffon_simplex(size_t dim)
{
    buffon_density g = {.uniforms = dim, .dim = dim, .ops = &simplex_standard_ops};
    pair factorial = pair_of(1);
    if (dim < 1 || dim > FLAT_DIM_MAX) {
        g.status = BUFFON_E_DIM;
        return g;
    }
    for (size_t k = 2; k <= dim; k++)
        factorial = pair_multiply(factorial, pair_of((double)k));
    g.param[0] = pair_value(factorial);
    return g;
}
