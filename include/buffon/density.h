/* Layer 2. A density g: how to draw X ~ g from uniforms, what g is there, and the way back.
 *
 * A density is a plain value made by a constructor (buffon_box, buffon_disk, buffon_sphere,
 * buffon_cap, ...) or filled in by the user. Batches are coordinate-major: coordinate j of point i
 * is x[j*n + i], uniform j of point i is u[j*n + i]. A constructor given nonsense returns a density
 * that carries its status and is refused wherever it is used.
 *
 * Every map is deterministic and uses a fixed number of uniforms per point, so any point set can
 * drive it, quasi-random ones included.
 */
#ifndef BUFFON_DENSITY_H
#define BUFFON_DENSITY_H

#include "api.h"
#include "status.h"

BUFFON_BEGIN

struct buffon_density;

/** What a density can do. A user's own density is one of these tables and a buffon_density with it.
 *
 *  Each function returns 0, or non-zero when it fails: the estimate then fails with BUFFON_E_PDF
 *  (those of inversion.h: BUFFON_E_INVERSION). Functions may be called by several threads at once.
 *  `g` is the density itself.
 */
typedef struct buffon_density_ops {
    /* x[dim*n] and, unless pdf is NULL, pdf[n] > 0 from u[uniforms*n] in (0, 1). Required. */
    int (*sample)(double *x, double *pdf, const double *u, size_t n,
                  const struct buffon_density *g);
    /* pdf[n] >= 0 at any x[dim*n]; 0 outside the support. NULL where there is none. */
    int (*pdf)(double *pdf, const double *x, size_t n, const struct buffon_density *g);
    /* log of pdf[n], for densities whose pdf may leave the doubles. NULL: log of pdf is taken. */
    int (*log_pdf)(double *log_pdf, const double *x, size_t n, const struct buffon_density *g);
    /* u[uniforms*n] in (0, 1) from x[dim*n] in the support. NULL where there is none. */
    int (*invert)(double *u, const double *x, size_t n, const struct buffon_density *g);
    /* Mixes all that g depends on into a number, so that partial results of different densities are
     * told apart. NULL: the name, sizes and `param` alone are. */
    uint64_t (*identity)(uint64_t mix, const struct buffon_density *g);
    /* Names the law, such as "buffon.sphere". NULL is allowed. */
    const char *name;
    uintptr_t reserved[4]; /* must be zero */
} buffon_density_ops;

#define BUFFON_DENSITY_PARAMS 16

/** A density. Copies are independent; what `data` and `ctx` point at must outlive its use. */
typedef struct buffon_density {
    size_t uniforms;      /* uniforms a point uses */
    size_t dim;           /* coordinates a point has */
    buffon_status status; /* BUFFON_OK, or why the constructor refused */
    const buffon_density_ops *ops;
    double param[BUFFON_DENSITY_PARAMS]; /* the constructor's */
    const void *data[2];                 /* the constructor's: arrays of the caller */
    void *ctx; /* a user's own. Numbers are better kept in `param`: partial results of different
                * `param` are told apart, of different `ctx` only by the .id of the run */
    uint64_t reserved[4];                /* must be zero */
} buffon_density;

/** Draws points, and g at each, from uniforms.
 *
 *  Out:     x[dim*n]
 *           pdf[n]         may be NULL; equals buffon_density_pdf at x up to rounding
 *  In:      u[uniforms*n]  in (0, 1); must not overlap the outputs; n = 0 does nothing
 *  Returns: BUFFON_OK; the status the density carries; BUFFON_E_NULL; BUFFON_E_DIM; BUFFON_E_PDF if
 *           a user's density failed. Outputs are NaN unless BUFFON_OK.
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_density_sample(double *x, double *pdf, const double *u,
                                                            size_t n, const buffon_density *g);

/** g at given points; 0 outside its support.
 *
 *  Out:     pdf[n]
 *  In:      x[dim*n]
 *  Returns: as buffon_density_sample, and BUFFON_E_UNSUPPORTED
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_density_pdf(double *pdf, const double *x, size_t n,
                                                         const buffon_density *g);

/** log g at given points; -infinity outside its support.
 *
 *  Out:     log_pdf[n]
 *  In:      x[dim*n]
 *  Returns: as buffon_density_pdf
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_density_log_pdf(double *log_pdf, const double *x,
                                                             size_t n, const buffon_density *g);

/** The uniforms that give these points.
 *
 *  Out:     u[uniforms*n]  in (0, 1)
 *  In:      x[dim*n]       points of the support
 *  Returns: as buffon_density_pdf
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_density_invert(double *u, const double *x, size_t n,
                                                            const buffon_density *g);

/** Is this density usable? Checks what can be seen from outside.
 *
 *  In:      g
 *  Returns: BUFFON_OK; the status it carries; BUFFON_E_NULL (g, its table, or sample);
 *           BUFFON_E_DIM; BUFFON_E_RESERVED
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_density_check(const buffon_density *g);

/** The product of independent densities: X = (X1, X2, ...), g = g1 g2 ...
 *
 *  In:      parts[count]  count >= 1; must outlive the product
 *  Returns: a density of all the coordinates and uniforms in order; it carries BUFFON_E_NULL or the
 *           first part's status that is not BUFFON_OK. buffon_density_log_pdf is the sum of the
 *           logs: it holds where the product itself underflows
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_density_product(const buffon_density *parts, size_t count);

BUFFON_END

#endif
