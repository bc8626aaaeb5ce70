/* Affine maps and rotations of densities. */
#include "guard.h"

#include <math.h>
#include <string.h>

#include <buffon/affine.h>

#include "density_priv.h"
#include "elementary.h"
#include "frame.h"

/* `param`: the shift; |det A| as m 2^e with m in [1/2, 1). Up to dim = 3 the matrix follows the
 * shift, else it is data[1]. data[0] is the density of y. */
enum { AFFINE_MOST = 12, AFFINE_COPIED = 3, AFFINE_TILE = 512 };
enum { AFFINE_SHIFT = 0, AFFINE_M = 12, AFFINE_E = 13, AFFINE_MATRIX = 3 };

static const double *affine_matrix(const buffon_density *g)
{
    return g->data[1] ? (const double *)g->data[1] : g->param + AFFINE_MATRIX;
}

/* A as L U by elimination with row pivots: in place, row[k] the row that is k-th. A row is chosen
 * by its number against the largest of the row. Where the numbers differ by more than 2^120, units
 * are changed first by exact powers of two: a_ij = 2^(up_i + across_j) of what is kept. */
typedef struct affine_lu {
    double a[AFFINE_MOST * AFFINE_MOST];
    size_t row[AFFINE_MOST];
    int up[AFFINE_MOST], across[AFFINE_MOST];
    int changed; /* whether they are not all 0 */
} affine_lu;

/* The largest exponents of the rows, and then of the columns. */
static void affine_units(affine_lu *lu, const double *matrix, size_t dim)
{
    int e;
    lu->changed = 0;
    memset(lu->up, 0, sizeof lu->up);
    memset(lu->across, 0, sizeof lu->across);
    for (size_t k = 0; k < dim * dim; k++)
        lu->changed |= matrix[k] != 0 && !(buffon_priv_abs(matrix[k]) < 0x1p60 &&
                                           buffon_priv_abs(matrix[k]) > 0x1p-60);
    for (size_t i = 0; i < dim && lu->changed; i++) {
        double most = 0;
        for (size_t j = 0; j < dim; j++)
            if (buffon_priv_abs(matrix[dim * i + j]) > most)
                most = buffon_priv_abs(matrix[dim * i + j]);
        buffon_priv_frexp(&lu->up[i], most);
    }
    for (size_t j = 0; j < dim && lu->changed; j++) {
        int most = -5000;
        for (size_t i = 0; i < dim; i++)
            if (matrix[dim * i + j] != 0) {
                buffon_priv_frexp(&e, matrix[dim * i + j]);
                most = e - lu->up[i] > most ? e - lu->up[i] : most;
            }
        lu->across[j] = most;
    }
    for (size_t i = 0; i < dim; i++)
        for (size_t j = 0; j < dim; j++)
            lu->a[dim * i + j] = buffon_priv_ldexp(matrix[dim * i + j], -lu->up[i] - lu->across[j]);
}

/* How much of a row its element in column k is, below the first k columns. */
static double affine_weight(const double *row, size_t k, size_t dim)
{
    double most = 0;
    for (size_t j = k; j < dim; j++)
        most = buffon_priv_abs(row[j]) > most ? buffon_priv_abs(row[j]) : most;
    return most > 0 ? buffon_priv_abs(row[k]) / most : 0;
}

/* Returns 0 if A is singular. */
static int affine_factor(affine_lu *lu, const double *matrix, size_t dim)
{
    affine_units(lu, matrix, dim);
    for (size_t k = 0; k < dim; k++)
        lu->row[k] = k;
    for (size_t k = 0; k < dim; k++) {
        size_t best = k;
        for (size_t i = k + 1; i < dim; i++)
            if (affine_weight(lu->a + dim * lu->row[i], k, dim) >
                affine_weight(lu->a + dim * lu->row[best], k, dim))
                best = i;
        const size_t chosen = lu->row[best];
        lu->row[best] = lu->row[k];
        lu->row[k] = chosen;
        const double *pivot = lu->a + dim * chosen;
        if (pivot[k] == 0)
            return 0;
        for (size_t i = k + 1; i < dim; i++) {
            double *below = lu->a + dim * lu->row[i];
            const double factor = below[k] / pivot[k];
            below[k] = factor;
            for (size_t j = k + 1; j < dim; j++)
                below[j] -= factor * pivot[j];
        }
    }
    return 1;
}

/* y with A y = x - b, of m points from `at` on of n. */
static void affine_back(double *y, const double *x, size_t n, size_t at, size_t m,
                        const affine_lu *lu, const buffon_density *g)
{
    const size_t dim = g->dim;
    for (size_t k = 0; k < dim; k++) {
        const size_t row = lu->row[k];
        for (size_t i = 0; i < m; i++) {
            double sum = x[row * n + at + i] - g->param[AFFINE_SHIFT + row];
            if (lu->changed)
                sum = buffon_priv_ldexp(sum, -lu->up[row]);
            for (size_t j = 0; j < k; j++)
                sum -= lu->a[dim * row + j] * y[j * m + i];
            y[k * m + i] = sum;
        }
    }
    for (size_t k = dim; k-- > 0;) {
        const double *row = lu->a + dim * lu->row[k];
        for (size_t i = 0; i < m; i++) {
            double sum = y[k * m + i];
            for (size_t j = k + 1; j < dim; j++)
                sum -= row[j] * y[j * m + i];
            y[k * m + i] = sum / row[k];
        }
    }
    for (size_t k = 0; k < dim && lu->changed; k++)
        for (size_t i = 0; i < m; i++)
            y[k * m + i] = buffon_priv_ldexp(y[k * m + i], -lu->across[k]);
}

/* value / |det A|, whose parts may be beyond the doubles. */
static double affine_over(double value, const double *p)
{
    return buffon_priv_ldexp(value / p[AFFINE_M], -(int)p[AFFINE_E]);
}

static int affine_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *matrix = affine_matrix(g);
    const size_t dim = g->dim;
    const buffon_status status = buffon_density_sample(x, pdf, u, n, g->data[0]);
    for (size_t i = 0; i < n && status == BUFFON_OK; i++) {
        double y[AFFINE_MOST];
        for (size_t j = 0; j < dim; j++)
            y[j] = x[j * n + i];
        for (size_t j = 0; j < dim; j++) {
            double sum = 0;
            for (size_t k = 0; k < dim; k++)
                sum += matrix[dim * j + k] * y[k];
            x[j * n + i] = sum + g->param[AFFINE_SHIFT + j];
        }
        if (pdf)
            pdf[i] = affine_over(pdf[i], g->param);
    }
    return status;
}

/* An operation of the part: buffon_density_pdf or one of its kind. */
typedef buffon_status affine_job(double *out, const double *y, size_t n,
                                 const buffon_density *part);

/* The way back to y for m points from `at` on of n. */
typedef void affine_way(double *y, const double *x, size_t n, size_t at, size_t m,
                        const affine_lu *lu, const buffon_density *g);

/* What the part says of the y of points. */
static int affine_pull(double *out, const double *x, size_t n, const buffon_density *g,
                       affine_job *job, affine_way *back, const affine_lu *lu)
{
    const size_t wide = job == buffon_density_invert ? g->uniforms : 1;
    const size_t points = AFFINE_TILE / g->dim, room = AFFINE_TILE / wide;
    const size_t batch = points < room ? points : room;
    double y[AFFINE_TILE], one[AFFINE_TILE];
    for (size_t at = 0; at < n; at += batch) {
        const size_t m = n - at < batch ? n - at : batch;
        back(y, x, n, at, m, lu, g);
        const buffon_status status = job(one, y, m, g->data[0]);
        if (status != BUFFON_OK)
            return status;
        for (size_t j = 0; j < wide; j++)
            memcpy(out + j * n + at, one + j * m, m * sizeof *out);
    }
    return 0;
}

static int affine_fold(double *out, const double *x, size_t n, const buffon_density *g,
                       affine_job *job)
{
    affine_lu lu;
    affine_factor(&lu, affine_matrix(g), g->dim);
    return affine_pull(out, x, n, g, job, affine_back, &lu);
}

static int affine_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const int result = affine_fold(pdf, x, n, g, buffon_density_pdf);
    for (size_t i = 0; i < n && result == 0; i++)
        pdf[i] = affine_over(pdf[i], g->param);
    return result;
}

static int affine_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double log_2 = 0x1.62e42fefa39efp-1;
    const double log_det = buffon_priv_log(g->param[AFFINE_M]) + log_2 * g->param[AFFINE_E];
    const int result = affine_fold(log_pdf, x, n, g, buffon_density_log_pdf);
    for (size_t i = 0; i < n && result == 0; i++)
        log_pdf[i] -= log_det;
    return result;
}

static int affine_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    return affine_fold(u, x, n, g, buffon_density_invert);
}

static uint64_t affine_identity(uint64_t mix, const buffon_density *g)
{
    if (g->data[1])
        mix = density_mix(mix, g->data[1], g->dim * g->dim);
    return buffon_priv_density_identity(mix, g->data[0]);
}

static const buffon_density_ops affine_ops = {.sample = affine_sample,
                                              .pdf = affine_pdf,
                                              .log_pdf = affine_log_pdf,
                                              .invert = affine_invert,
                                              .identity = affine_identity,
                                              .name = "buffon.affine"};

static const buffon_density_ops affine_blind_ops = {.sample = affine_sample,
                                                    .invert = affine_invert,
                                                    .identity = affine_identity,
                                                    .name = "buffon.affine"};

/* The pivots' product is |det A|. */
static buffon_status affine_measure(buffon_density *g, const double *matrix, const double *shift)
{
    const size_t dim = g->dim;
    double m = 0.5;
    int e = 1;
    affine_lu lu;
    for (size_t k = 0; k < dim * dim; k++)
        if (!buffon_priv_isfinite(matrix[k]))
            return BUFFON_E_SHAPE;
    for (size_t k = 0; k < dim && shift; k++) {
        if (!buffon_priv_isfinite(shift[k]))
            return BUFFON_E_SHAPE;
        g->param[AFFINE_SHIFT + k] = shift[k];
    }
    if (!affine_factor(&lu, matrix, dim))
        return BUFFON_E_SHAPE;
    for (size_t k = 0; k < dim; k++) {
        int more, again;
        m *= buffon_priv_abs(buffon_priv_frexp(&more, lu.a[dim * lu.row[k] + k]));
        m = buffon_priv_frexp(&again, m);
        e += more + again + lu.up[k] + lu.across[k];
    }
    if (!(m > 0 && buffon_priv_isfinite(m)))
        return BUFFON_E_SHAPE;
    g->param[AFFINE_M] = m;
    g->param[AFFINE_E] = e;
    return BUFFON_OK;
}

buffon_density buffon_affine(const buffon_density *part, const double *matrix, const double *shift)
{
    buffon_density g = {.ops = &affine_ops, .data = {part, NULL}};
    g.status = matrix ? buffon_density_check(part) : BUFFON_E_NULL;
    if (g.status != BUFFON_OK)
        return g;
    g.dim = part->dim;
    g.uniforms = part->uniforms;
    if (g.dim > AFFINE_MOST || g.uniforms > AFFINE_TILE) {
        g.status = BUFFON_E_DIM;
        return g;
    }
    g.status = affine_measure(&g, matrix, shift);
    if (g.dim <= AFFINE_COPIED)
        memcpy(g.param + AFFINE_MATRIX, matrix, g.dim * g.dim * sizeof *matrix);
    else
        g.data[1] = matrix;
    if (!buffon_priv_density_has_pdf(part))
        g.ops = &affine_blind_ops;
    return g;
}

/* ---- rotations ---------------------------------------------------------------------------- */

/* `param` is R by rows. */

/* R y, in place. */
static int turned_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *r = g->param;
    const buffon_status status = buffon_density_sample(x, pdf, u, n, g->data[0]);
    for (size_t i = 0; i < n && status == BUFFON_OK; i++) {
        const double y[] = {x[i], x[n + i], x[2 * n + i]};
        for (size_t j = 0; j < 3; j++)
            x[j * n + i] = r[3 * j] * y[0] + r[3 * j + 1] * y[1] + r[3 * j + 2] * y[2];
    }
    return status;
}

/* y by the transpose of R. */
static void turned_back(double *y, const double *x, size_t n, size_t at, size_t m,
                        const affine_lu *none, const buffon_density *g)
{
    const double *r = g->param;
    (void)none;
    for (size_t i = 0; i < m; i++) {
        const double z[] = {x[at + i], x[n + at + i], x[2 * n + at + i]};
        for (size_t j = 0; j < 3; j++)
            y[j * m + i] = r[j] * z[0] + r[3 + j] * z[1] + r[6 + j] * z[2];
    }
}

static int turned_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    return affine_pull(pdf, x, n, g, buffon_density_pdf, turned_back, NULL);
}

static int turned_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    return affine_pull(log_pdf, x, n, g, buffon_density_log_pdf, turned_back, NULL);
}

static int turned_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    return affine_pull(u, x, n, g, buffon_density_invert, turned_back, NULL);
}

static const buffon_density_ops turned_ops = {.sample = turned_sample,
                                              .pdf = turned_pdf,
                                              .log_pdf = turned_log_pdf,
                                              .invert = turned_invert,
                                              .identity = affine_identity,
                                              .name = "buffon.turned"};

static const buffon_density_ops turned_blind_ops = {.sample = turned_sample,
                                                    .invert = turned_invert,
                                                    .identity = affine_identity,
                                                    .name = "buffon.turned"};

static buffon_density turned_make(const buffon_density *part, int given)
{
    buffon_density g = {.ops = &turned_ops, .data = {part, NULL}};
    g.status = given ? buffon_density_check(part) : BUFFON_E_NULL;
    if (g.status != BUFFON_OK)
        return g;
    g.dim = part->dim;
    g.uniforms = part->uniforms;
    if (g.dim != 3 || g.uniforms > AFFINE_TILE)
        g.status = BUFFON_E_DIM;
    if (!buffon_priv_density_has_pdf(part))
        g.ops = &turned_blind_ops;
    return g;
}

/* R of a quaternion of any length: first it is brought near 1 by its largest part. */
buffon_density buffon_turned(const buffon_density *part, const double q[4])
{
    buffon_density g = turned_make(part, q != NULL);
    double most = 0, v[4];
    if (g.status != BUFFON_OK)
        return g;
    for (int k = 0; k < 4; k++) {
        if (!buffon_priv_isfinite(q[k]))
            g.status = BUFFON_E_SHAPE;
        most = buffon_priv_abs(q[k]) > most ? buffon_priv_abs(q[k]) : most;
    }
    if (!(most > 0))
        g.status = BUFFON_E_SHAPE;
    if (g.status != BUFFON_OK)
        return g;
    for (int k = 0; k < 4; k++)
        v[k] = q[k] / most;
    const double w = v[0], x = v[1], y = v[2], z = v[3];
    const double s = 2 / (w * w + x * x + y * y + z * z);
    const double r[9] = {1 - s * (y * y + z * z), s * (x * y - w * z),     s * (x * z + w * y),
                         s * (x * y + w * z),     1 - s * (x * x + z * z), s * (y * z - w * x),
                         s * (x * z - w * y),     s * (y * z + w * x),     1 - s * (x * x + y * y)};
    memcpy(g.param, r, sizeof r);
    return g;
}

/* The columns of R are the frame of the axis. */
buffon_density buffon_turned_to(const buffon_density *part, const double axis[3])
{
    buffon_density g = turned_make(part, axis != NULL);
    double n[3], f[FRAME_SIZE];
    if (g.status != BUFFON_OK)
        return g;
    if (!(frame_unit(n, axis) > 0)) {
        g.status = BUFFON_E_SHAPE;
        return g;
    }
    frame_make(f, n);
    for (size_t j = 0; j < 3; j++)
        for (size_t k = 0; k < 3; k++)
            g.param[3 * j + k] = f[3 * k + j];
    return g;
}
