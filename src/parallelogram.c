#include "guard.h"

#include <buffon/parallelogram.h>

#include "flat.h"

static int parallelogram_draw(double *x, double *pdf, const double *u, size_t n,
                              const buffon_density *g)
{
    return buffon_priv_flat_draw(x, pdf, u, n, g, FLAT_BOX);
}

static int parallelogram_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    return buffon_priv_flat_pdf(pdf, x, n, g, FLAT_BOX);
}

static int parallelogram_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    return buffon_priv_flat_invert(u, x, n, g, FLAT_BOX);
}

static const buffon_density_ops parallelogram_ops = {.sample = parallelogram_draw,
                                                     .pdf = parallelogram_pdf,
                                                     .invert = parallelogram_unmap,
                                                     .name = "buffon.parallelogram"};

static buffon_density parallelogram_make(const double *origin, const double *const *edge,
                                         size_t edges)
{
    buffon_density g = {.uniforms = edges, .dim = 3, .ops = &parallelogram_ops};
    pair wide[3][3] = {{{0}}};
    g.status = origin ? BUFFON_OK : BUFFON_E_NULL;
    for (size_t k = 0; k < edges; k++)
        if (!edge[k])
            g.status = BUFFON_E_NULL;
    if (g.status != BUFFON_OK)
        return g;
    for (size_t k = 0; k < 3 * edges; k++)
        wide[k / 3][k % 3] = pair_of(edge[k / 3][k % 3]);
    buffon_priv_flat_make(&g, FLAT_BOX, origin, wide);
    return g;
}

buffon_density buffon_parallelogram(const double corner[3], const double edge1[3],
                                    const double edge2[3])
{
    const double *const edge[] = {edge1, edge2};
    return parallelogram_make(corner, edge, 2);
}

buffon_density buffon_parallelepiped(const double corner[3], const double edge1[3],
                                     const double edge2[3], const double edge3[3])
{
    const double *const edge[] = {edge1, edge2, edge3};
    return parallelogram_make(corner, edge, 3);
}
