/* A table in use: points, the pdf they have, and the way back. */
#include "guard.h"

#include <float.h>
#include <math.h>

#include "density_priv.h"
#include "inverse_priv.h"

#define INVERSE_TILE 512

/* Does those of u[n] that lie in a tail, or beyond the row that is at at[n]. */
static void inverse_mend(double *x, double *pdf, const double *u, const uint64_t *at, size_t n,
                         const buffon_inverse_table *table)
{
    for (size_t i = 0; i < n; i++) {
        double *const density = pdf != NULL ? &pdf[i] : NULL;
        const inverse_row *row = inverse_cells(table) + at[i] / 8;
        if (u[i] < table->u_lo) {
            x[i] = buffon_priv_inverse_tail(density, u[i], 0, table);
        } else if (u[i] >= table->u_hi) {
            x[i] = buffon_priv_inverse_tail(density, 1 - u[i], 1, table);
        } else if (u[i] >= row->to) {
            double slope;
            while (u[i] >= row->to)
                row++;
            x[i] = inverse_value(&slope, row, u[i] - row->from);
            if (pdf != NULL)
                pdf[i] = 1 / slope;
        }
    }
}

#define KERNELS "inverse_table_lanes.h"
#include "levels.h"

static unsigned inverse_bits(uint64_t bins)
{
    unsigned bits = 0;
    while (bins >> bits > 1)
        bits++;
    return bits;
}

static int inverse_is_table(const buffon_inverse_table *table)
{
    return table->magic == INVERSE_MAGIC && table->bins >= 2 && table->cells >= 1 &&
           table->tail[0] >= 1 && table->tail[1] >= 1;
}

size_t buffon_inverse_table_bytes(const buffon_inverse_table *table)
{
    return table != NULL && inverse_is_table(table) ? (size_t)table->bytes : 0;
}

/* ---- tails ---- */

double buffon_priv_inverse_tail(double *pdf, double p, int upper, const buffon_inverse_table *table)
{
    const inverse_row *row = inverse_tail_rows(table, upper);
    const double t = buffon_priv_log(p);
    double slope;
    while (t < row->to)
        row++;
    const double v = inverse_value(&slope, row, t < row->from ? t - row->from : 0);
    const double x = table->end[upper] + table->sign[upper] * buffon_priv_exp(v);
    if (pdf != NULL) {
        const double g = buffon_priv_exp(t - v) / buffon_priv_abs(slope);
        *pdf = g < DBL_MIN ? DBL_MIN : g > DBL_MAX ? DBL_MAX : g;
    }
    return x < table->least ? table->least : x > table->most ? table->most : x;
}

/* p and the pdf at an x of a tail; both 0 beyond the support. */
static double inverse_untail(double *pdf, double x, int upper, const buffon_inverse_table *table)
{
    const inverse_row *row = inverse_tail_rows(table, upper);
    const inverse_row *last = row + table->tail[upper] - 1;
    const double r = (x - table->end[upper]) * table->sign[upper];
    *pdf = 0;
    if (!(r > 0 && r <= DBL_MAX) || x < table->least || x > table->most)
        return 0;
    const double v = buffon_priv_log(r);
    const int rises = row->c[1] < 0; /* v outwards */
    while (row < last && (rises ? row[1].c[0] <= v : row[1].c[0] >= v))
        row++;
    double slope, a = row->to - row->from, b = 0, d = (v - row->c[0]) / row->c[1];
    for (int k = 0; k < 64; k++) {
        if (!(d >= a))
            d = a < -DBL_MAX ? 0 : a;
        d = d > b ? b : d;
        const double off = inverse_value(&slope, row, d) - v;
        if (off == 0)
            break;
        if ((off > 0) == (slope > 0))
            b = d;
        else
            a = d;
        const double next = d - off / slope;
        if (buffon_priv_abs(next - d) <= 0x1p-52 * buffon_priv_abs(row->from + d)) {
            d = next < 0 ? next : 0;
            break;
        }
        d = next > a && next < b ? next : a < -DBL_MAX ? next : 0.5 * (a + b);
    }
    const double t = row->from + d;
    inverse_value(&slope, row, d);
    *pdf = buffon_priv_exp(t - v) / buffon_priv_abs(slope);
    *pdf = *pdf > DBL_MAX ? DBL_MAX : *pdf;
    return buffon_priv_exp(t);
}

/* ---- the centre ---- */

/* u and the pdf at an x of the centre; in a gap the pdf is 0. */
static double inverse_uncentre(double *pdf, double x, const buffon_inverse_table *table)
{
    const inverse_row *cell = inverse_cells(table);
    for (size_t left = (size_t)table->cells; left > 1;) {
        const size_t half = left / 2;
        cell += cell[half].c[0] <= x ? half : 0;
        left -= half;
    }
    double slope, a = 0, b = cell->to - cell->from;
    const double last = inverse_value(&slope, cell, b);
    if (x >= last) {
        const double size = buffon_priv_abs(x) + buffon_priv_abs(cell->c[0]);
        *pdf = x - last <= 0x1p-50 * size ? 1 / slope : 0;
        return cell->to;
    }
    double d = b * ((x - cell->c[0]) / (last - cell->c[0]));
    for (int k = 0; k < 64; k++) {
        const double off = inverse_value(&slope, cell, d) - x;
        if (off == 0)
            break;
        if (off > 0)
            b = d;
        else
            a = d;
        const double next = d - off / slope;
        if (buffon_priv_abs(next - d) <= 0x1p-54 * cell->to)
            break;
        d = next > a && next < b ? next : 0.5 * (a + b);
    }
    *pdf = 1 / slope;
    return cell->from + d;
}

/* P(X <= x), P(X > x) and the pdf. */
static void inverse_at(double *lower, double *upper, double *pdf, double x,
                       const buffon_inverse_table *table)
{
    if (x < table->x_lo) {
        *lower = inverse_untail(pdf, x, 0, table);
        *upper = 1 - *lower;
    } else if (x > table->x_hi) {
        *upper = inverse_untail(pdf, x, 1, table);
        *lower = 1 - *upper;
    } else if (x == x) {
        *lower = inverse_uncentre(pdf, x, table);
        *upper = 1 - *lower;
    } else {
        *pdf = 0;
        *lower = *upper = x;
    }
}

/* ---- the density ---- */

static int inverse_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const buffon_inverse_table *table = g->data[0];
    LEVELS_RUN(inverse_map_points, (x, pdf, u, n, table, inverse_bits(table->bins)));
    return 0;
}

static int inverse_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    double lower, upper;
    for (size_t i = 0; i < n; i++)
        inverse_at(&lower, &upper, &pdf[i], x[i], g->data[0]);
    return 0;
}

static int inverse_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    double upper, pdf;
    for (size_t i = 0; i < n; i++) {
        inverse_at(&u[i], &upper, &pdf, x[i], g->data[0]);
        u[i] = density_inside(u[i]);
    }
    return 0;
}

static uint64_t inverse_table_identity(uint64_t mix, const buffon_density *g)
{
    const buffon_inverse_table *table = g->data[0];
    const uint64_t *words = (const uint64_t *)(const void *)table;
    for (uint64_t k = 0; k < table->bytes / sizeof *words; k++)
        mix = buffon_priv_mix(mix, words[k]);
    return mix;
}

static const buffon_density_ops inverse_table_ops = {.sample = inverse_draw,
                                                     .pdf = inverse_pdf,
                                                     .invert = inverse_invert,
                                                     .identity = inverse_table_identity,
                                                     .name = "buffon.inverse_table"};

buffon_density buffon_inverse_table_density(const buffon_inverse_table *table)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &inverse_table_ops, .data = {table, NULL}};
    g.status = table == NULL ? BUFFON_E_NULL : inverse_is_table(table) ? BUFFON_OK : BUFFON_E_TABLE;
    return g;
}

buffon_status buffon_inverse_table_upper(double *x, double *pdf, const double *q, size_t n,
                                         const buffon_inverse_table *table)
{
    const buffon_density g = buffon_inverse_table_density(table);
    if (g.status != BUFFON_OK)
        return g.status;
    if (n > 0 && (x == NULL || q == NULL))
        return BUFFON_E_NULL;
    for (size_t i = 0; i < n; i++) {
        const double u = 1 - q[i];
        if (u >= table->u_hi)
            x[i] = buffon_priv_inverse_tail(pdf ? &pdf[i] : NULL, q[i], 1, table);
        else
            inverse_draw(&x[i], pdf ? &pdf[i] : NULL, &u, 1, &g);
    }
    return BUFFON_OK;
}

buffon_status buffon_inverse_table_cdf(double *lower, double *upper, const double *x, size_t n,
                                       const buffon_inverse_table *table)
{
    const buffon_density g = buffon_inverse_table_density(table);
    if (g.status != BUFFON_OK)
        return g.status;
    if (n > 0 && x == NULL)
        return BUFFON_E_NULL;
    for (size_t i = 0; i < n; i++) {
        double below, above, pdf;
        inverse_at(&below, &above, &pdf, x[i], table);
        if (lower != NULL)
            lower[i] = below;
        if (upper != NULL)
            upper[i] = above;
    }
    return BUFFON_OK;
}
