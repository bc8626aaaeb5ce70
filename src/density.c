/* The calls that go through a density's table of operations, and products of densities. */
#include "guard.h"

#include <math.h>
#include <string.h>

#include <buffon/density.h>

#include "density_priv.h"
#include "elementary.h"

buffon_status buffon_density_check(const buffon_density *g)
{
    if (!g)
        return BUFFON_E_NULL;
    if (g->status != BUFFON_OK)
        return g->status;
    for (size_t k = 0; k < sizeof g->reserved / sizeof *g->reserved; k++)
        if (g->reserved[k] != 0)
            return BUFFON_E_RESERVED;
    if (!g->ops || !g->ops->sample)
        return BUFFON_E_NULL;
    for (size_t k = 0; k < sizeof g->ops->reserved / sizeof *g->ops->reserved; k++)
        if (g->ops->reserved[k] != 0)
            return BUFFON_E_RESERVED;
    return g->dim && g->uniforms ? BUFFON_OK : BUFFON_E_DIM;
}

/* Whether arrays of n points can exist in memory. */
static int density_fits(size_t n, const buffon_density *g)
{
    const size_t most = SIZE_MAX / sizeof(double);
    return n <= most && (!n || !g || (g->dim <= most / n && g->uniforms <= most / n));
}

/* What a refused call leaves. Where n itself is senseless nothing can be said of the arrays, and
 * they are left alone. */
static void density_spoil(double *x, size_t n, size_t width, const buffon_density *g)
{
    if (x && density_fits(n, g))
        density_fill(x, (double)NAN, n * width);
}

static buffon_status density_check_call(const void *out, const void *in, size_t n,
                                        const buffon_density *g)
{
    const buffon_status status = buffon_density_check(g);
    if (status != BUFFON_OK)
        return status;
    if (n && (!out || !in))
        return BUFFON_E_NULL;
    return density_fits(n, g) ? BUFFON_OK : BUFFON_E_DIM;
}

buffon_status buffon_priv_density_result(int result)
{
    if (result == 0)
        return BUFFON_OK;
    if (result == BUFFON_E_INVERSION || result == BUFFON_E_UNSUPPORTED)
        return (buffon_status)result;
    return BUFFON_E_PDF;
}

buffon_status buffon_density_sample(double *x, double *pdf, const double *u, size_t n,
                                    const buffon_density *g)
{
    buffon_status status = density_check_call(x, u, n, g);
    if (status == BUFFON_OK && n)
        status = buffon_priv_density_result(g->ops->sample(x, pdf, u, n, g));
    if (status != BUFFON_OK) {
        density_spoil(x, n, g ? g->dim : 0, g);
        density_spoil(pdf, n, 1, g);
    }
    return status;
}

buffon_status buffon_density_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    buffon_status status = density_check_call(pdf, x, n, g);
    if (status == BUFFON_OK && !g->ops->pdf)
        status = BUFFON_E_UNSUPPORTED;
    if (status == BUFFON_OK && n)
        status = buffon_priv_density_result(g->ops->pdf(pdf, x, n, g));
    if (status != BUFFON_OK)
        density_spoil(pdf, n, 1, g);
    return status;
}

/* The table's own, or the log of its pdf. */
static int density_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    if (g->ops->log_pdf)
        return g->ops->log_pdf(log_pdf, x, n, g);
    if (!g->ops->pdf)
        return BUFFON_E_UNSUPPORTED;
    const int result = g->ops->pdf(log_pdf, x, n, g);
    for (size_t i = 0; i < n && result == 0; i++)
        log_pdf[i] = buffon_priv_log(log_pdf[i]);
    return result;
}

buffon_status buffon_density_log_pdf(double *log_pdf, const double *x, size_t n,
                                     const buffon_density *g)
{
    buffon_status status = density_check_call(log_pdf, x, n, g);
    if (status == BUFFON_OK && !g->ops->log_pdf && !g->ops->pdf)
        status = BUFFON_E_UNSUPPORTED;
    if (status == BUFFON_OK && n)
        status = buffon_priv_density_result(density_log_pdf(log_pdf, x, n, g));
    if (status != BUFFON_OK)
        density_spoil(log_pdf, n, 1, g);
    return status;
}

buffon_status buffon_density_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    buffon_status status = density_check_call(u, x, n, g);
    if (status == BUFFON_OK && !g->ops->invert)
        status = BUFFON_E_UNSUPPORTED;
    if (status == BUFFON_OK && n)
        status = buffon_priv_density_result(g->ops->invert(u, x, n, g));
    if (status != BUFFON_OK)
        density_spoil(u, n, g ? g->uniforms : 0, g);
    return status;
}

uint64_t buffon_priv_density_identity(uint64_t mix, const buffon_density *g)
{
    mix = buffon_priv_mix_name(mix, g->ops->name);
    mix = buffon_priv_mix(mix, g->uniforms);
    mix = buffon_priv_mix(mix, g->dim);
    mix = density_mix(mix, g->param, BUFFON_DENSITY_PARAMS);
    return g->ops->identity ? g->ops->identity(mix, g) : mix;
}

/* A product keeps its parts as data[0] up to, not including, data[1]. As batches are
 * coordinate-major, the coordinates of a part are one stretch of the whole, so its operations run
 * in place. Only the pdf of a part needs room of its own: for that its points are copied in tiles.
 * A product within a product is walked, so one tile serves all levels. */
#define PRODUCT_TILE 4096

/* out := out * g of a part, or out + log g, at points given by their uniforms or as they are. */
typedef enum product_job { PRODUCT_SAMPLE, PRODUCT_PDF, PRODUCT_LOG_PDF } product_job;

/* One part at all points: tiles of its columns, each with its pdf behind them. */
static int product_leaf(double *x_out, double *out, const double *in, size_t n,
                        const buffon_density *part, product_job job)
{
    double tile[PRODUCT_TILE];
    const size_t inputs = job == PRODUCT_SAMPLE ? part->uniforms : part->dim;
    const size_t outputs = job == PRODUCT_SAMPLE ? part->dim : 0;
    const size_t points = PRODUCT_TILE / (inputs + outputs + 1);
    for (size_t i = 0; i < n; i += points) {
        const size_t m = n - i < points ? n - i : points;
        double *x = tile + inputs * m, *g = x + outputs * m;
        int result;
        for (size_t j = 0; j < inputs; j++)
            memcpy(tile + j * m, in + j * n + i, m * sizeof *tile);
        if (job == PRODUCT_SAMPLE)
            result = part->ops->sample(x, g, tile, m, part);
        else if (job == PRODUCT_PDF)
            result = part->ops->pdf ? part->ops->pdf(g, tile, m, part) : BUFFON_E_UNSUPPORTED;
        else
            result = density_log_pdf(g, tile, m, part);
        if (result != 0)
            return result;
        for (size_t j = 0; j < outputs; j++)
            memcpy(x_out + j * n + i, x + j * m, m * sizeof *tile);
        for (size_t k = 0; k < m; k++)
            out[i + k] = job == PRODUCT_LOG_PDF ? out[i + k] + g[k] : out[i + k] * g[k];
    }
    return 0;
}

static int product_sample(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g);

static int product_fold(double *x, double *out, const double *in, size_t n,
                        const buffon_density *g, product_job job)
{
    const buffon_density *end = g->data[1];
    int result = 0;
    for (const buffon_density *part = g->data[0]; part < end && result == 0; part++) {
        if (part->ops->sample == product_sample)
            result = product_fold(x, out, in, n, part, job);
        else
            result = product_leaf(x, out, in, n, part, job);
        if (job == PRODUCT_SAMPLE)
            x += part->dim * n;
        in += (job == PRODUCT_SAMPLE ? part->uniforms : part->dim) * n;
    }
    return result;
}

static int product_sample(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    const buffon_density *end = g->data[1];
    int result = 0;
    if (pdf) {
        density_fill(pdf, 1, n);
        return product_fold(x, pdf, u, n, g, PRODUCT_SAMPLE);
    }
    for (const buffon_density *part = g->data[0]; part < end && result == 0; part++) {
        result = part->ops->sample(x, NULL, u, n, part);
        x += part->dim * n;
        u += part->uniforms * n;
    }
    return result;
}

static int product_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    density_fill(pdf, 1, n);
    return product_fold(NULL, pdf, x, n, g, PRODUCT_PDF);
}

static int product_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    density_fill(log_pdf, 0, n);
    return product_fold(NULL, log_pdf, x, n, g, PRODUCT_LOG_PDF);
}

static int product_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const buffon_density *end = g->data[1];
    int result = 0;
    for (const buffon_density *part = g->data[0]; part < end && result == 0; part++) {
        result = part->ops->invert ? part->ops->invert(u, x, n, part) : BUFFON_E_UNSUPPORTED;
        u += part->uniforms * n;
        x += part->dim * n;
    }
    return result;
}

static uint64_t product_identity(uint64_t mix, const buffon_density *g)
{
    const buffon_density *end = g->data[1];
    for (const buffon_density *part = g->data[0]; part < end; part++)
        mix = buffon_priv_density_identity(mix, part);
    return mix;
}

static const buffon_density_ops product_ops = {.sample = product_sample,
                                               .pdf = product_pdf,
                                               .log_pdf = product_log_pdf,
                                               .invert = product_invert,
                                               .identity = product_identity,
                                               .name = "buffon.product"};

int buffon_priv_density_has_pdf(const buffon_density *g)
{
    const buffon_density *end = g->data[1];
    if (g->ops != &product_ops)
        return g->ops->pdf != NULL;
    for (const buffon_density *part = g->data[0]; part < end; part++)
        if (!buffon_priv_density_has_pdf(part))
            return 0;
    return 1;
}

/* Sums the sizes. A part whose points do not fit the tile is refused, unless it is walked. */
buffon_density buffon_density_product(const buffon_density *parts, size_t count)
{
    buffon_density g = {.ops = &product_ops};
    if (!parts || !count)
        g.status = BUFFON_E_NULL;
    for (size_t k = 0; k < count && g.status == BUFFON_OK; k++) {
        const size_t dim = parts[k].dim, uniforms = parts[k].uniforms;
        g.status = buffon_density_check(&parts[k]);
        if (g.status != BUFFON_OK)
            break;
        if (dim > SIZE_MAX - g.dim || uniforms > SIZE_MAX - g.uniforms)
            g.status = BUFFON_E_DIM;
        else if (parts[k].ops != &product_ops &&
                 (dim >= PRODUCT_TILE / 2 || uniforms >= PRODUCT_TILE / 2))
            g.status = BUFFON_E_DIM;
        g.dim += dim;
        g.uniforms += uniforms;
    }
    if (g.status == BUFFON_OK) {
        g.data[0] = parts;
        g.data[1] = parts + count;
    }
    return g;
}
