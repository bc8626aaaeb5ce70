#include "guard.h"

#include <math.h>

#include <buffon/piecewise.h>

#include "density_priv.h"
#include "elementary.h"
#include "ramp.h"
#include "shares.h"

/* ---- pieces of the line -------------------------------------------------------------------- */

/* A block of the line: bounds, edges, values of g (one for each piece of steps, for each edge of
 * lines), index. `spare` is 1 where the pieces are equal. */
typedef struct piecewise_line {
    size_t pieces;
    unsigned bits;
    int even;
    uint64_t *bound;
    double *edge, *g;
    uint32_t *first;
} piecewise_line;

static size_t piecewise_size(size_t pieces, size_t values)
{
    size_t size = buffon_priv_table_more(sizeof(buffon_priv_table), pieces + 1, sizeof(uint64_t));
    size = buffon_priv_table_more(size, pieces + 1, sizeof(double));
    size = buffon_priv_table_more(size, values, sizeof(double));
    return buffon_priv_table_more(size, ((size_t)1 << buffon_priv_guide_bits(pieces)) + 1,
                                  sizeof(uint32_t));
}

size_t buffon_piecewise_constant_size(size_t count)
{
    return count < 1 || count > SHARES_MOST ? SIZE_MAX : piecewise_size(count, count);
}

size_t buffon_piecewise_linear_size(size_t count)
{
    return count < 2 || count > SHARES_MOST ? SIZE_MAX : piecewise_size(count - 1, count);
}

static piecewise_line piecewise_of(const buffon_priv_table *table)
{
    const int linear = buffon_priv_table_kind(table) == TABLE_LINEAR;
    piecewise_line line = {.pieces = (size_t)table->size[0],
                           .bits = (unsigned)table->bits[0],
                           .even = table->spare == 1};
    line.bound = (uint64_t *)(uintptr_t)(table + 1);
    line.edge = (double *)(line.bound + line.pieces + 1);
    line.g = line.edge + line.pieces + 1;
    line.first = (uint32_t *)(line.g + line.pieces + (linear ? 1 : 0));
    return line;
}

/* Where k of n equal pieces of [0, 1] begins. */
static double piecewise_edge(size_t k, size_t n)
{
    return (double)k / (double)n;
}

/* The piece of n equal ones that holds x, as the edges themselves say; the last for x = 1. */
static size_t piecewise_cell(double x, size_t n)
{
    const double at = x * (double)n;
    size_t k = at < (double)n ? (size_t)at : n - 1;
    if (x < piecewise_edge(k, n))
        k--;
    else if (k + 1 < n && x >= piecewise_edge(k + 1, n))
        k++;
    return k;
}

/* The piece that holds an x between the outer edges. */
static size_t piecewise_find(const piecewise_line *line, double x)
{
    size_t k = 0;
    if (line->even)
        return piecewise_cell(x, line->pieces);
    for (size_t left = line->pieces; left > 1;) {
        const size_t half = left / 2;
        k += line->edge[k + half] <= x ? half : 0;
        left -= half;
    }
    return k;
}

static int piecewise_outside(const piecewise_line *line, double x)
{
    return !(x >= line->edge[0] && x <= line->edge[line->pieces]);
}

/* ---- steps --------------------------------------------------------------------------------- */

/* x stays below the upper end of its piece, so that its pdf is that of the piece it came from. */
static int piecewise_draw_steps(double *x, double *pdf, const double *u, size_t n,
                                const buffon_density *g)
{
    const piecewise_line line = piecewise_of(g->data[0]);
    for (size_t i = 0; i < n; i++) {
        double rest, left;
        const uint64_t unit = shares_unit(&rest, u[i]);
        const size_t k = shares_find(line.bound, line.first, line.bits, unit);
        const double lo = line.edge[k], hi = line.edge[k + 1];
        const double v = lo + shares_into(&left, line.bound, k, unit, rest) * (hi - lo);
        x[i] = v < hi ? v : buffon_priv_nextdown(hi);
        if (pdf)
            pdf[i] = line.g[k];
    }
    return 0;
}

static int piecewise_pdf_steps(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const piecewise_line line = piecewise_of(g->data[0]);
    for (size_t i = 0; i < n; i++)
        pdf[i] = piecewise_outside(&line, x[i]) ? 0 : line.g[piecewise_find(&line, x[i])];
    return 0;
}

static int piecewise_unmap_steps(double *u, const double *x, size_t n, const buffon_density *g)
{
    const piecewise_line line = piecewise_of(g->data[0]);
    for (size_t i = 0; i < n; i++) {
        const size_t k = piecewise_outside(&line, x[i]) ? 0 : piecewise_find(&line, x[i]);
        const double lo = line.edge[k], hi = line.edge[k + 1];
        u[i] = density_open(shares_uniform(line.bound, k, (x[i] - lo) / (hi - lo)));
    }
    return 0;
}

/* ---- lines --------------------------------------------------------------------------------- */

/* Divided first: the products of g and a width may leave the doubles. */
static double piecewise_height(const piecewise_line *line, size_t k, double x)
{
    const double lo = line->edge[k], hi = line->edge[k + 1], width = hi - lo;
    return line->g[k] * ((hi - x) / width) + line->g[k + 1] * ((x - lo) / width);
}

/* Rounding may take x to an end of its piece, but not to one where g is 0. */
static double piecewise_inside(const piecewise_line *line, size_t k, double x)
{
    const double lo = line->g[k] > 0 ? line->edge[k] : buffon_priv_nextup(line->edge[k]);
    const double hi =
        line->g[k + 1] > 0 ? line->edge[k + 1] : buffon_priv_nextdown(line->edge[k + 1]);
    return x < lo ? lo : x < hi ? x : hi;
}

/* From the nearer end of the piece. Both ways meet in the middle, where the order is kept. */
static int piecewise_draw_lines(double *x, double *pdf, const double *u, size_t n,
                                const buffon_density *g)
{
    const piecewise_line line = piecewise_of(g->data[0]);
    for (size_t i = 0; i < n; i++) {
        double rest, left, s, c, way;
        const uint64_t unit = shares_unit(&rest, u[i]);
        const size_t k = shares_find(line.bound, line.first, line.bits, unit);
        const double lo = line.edge[k], hi = line.edge[k + 1], width = hi - lo;
        const double into = shares_into(&left, line.bound, k, unit, rest);
        ramp_place(&s, &c, line.g[k], line.g[k + 1], into, left);
        const size_t end = ramp_end(&way, s, c);
        const double least[2] = {lo, lo + 0.5 * width}, v = line.edge[k + end] + way * width;
        x[i] = piecewise_inside(&line, k, v > least[end] ? v : least[end]);
        if (pdf)
            pdf[i] = piecewise_height(&line, k, x[i]);
    }
    return 0;
}

static int piecewise_pdf_lines(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const piecewise_line line = piecewise_of(g->data[0]);
    for (size_t i = 0; i < n; i++)
        pdf[i] = piecewise_outside(&line, x[i])
                     ? 0
                     : piecewise_height(&line, piecewise_find(&line, x[i]), x[i]);
    return 0;
}

static int piecewise_unmap_lines(double *u, const double *x, size_t n, const buffon_density *g)
{
    const piecewise_line line = piecewise_of(g->data[0]);
    for (size_t i = 0; i < n; i++) {
        const size_t k = piecewise_outside(&line, x[i]) ? 0 : piecewise_find(&line, x[i]);
        const double lo = line.edge[k], hi = line.edge[k + 1], width = hi - lo;
        const double a = line.g[k], b = line.g[k + 1];
        /* A piece of height 0 has its one uniform. */
        const double t = a + b > 0 ? ramp_mass(a, b, (x[i] - lo) / width, (hi - x[i]) / width) : 0;
        u[i] = density_open(shares_uniform(line.bound, k, t));
    }
    return 0;
}

/* ---- making them --------------------------------------------------------------------------- */

/* Copies the edges, or makes equal ones. The range lies within 2^-900 and 2^900, so that no g of
 * what is drawn is subnormal. Returns its exponent, or INT32_MAX. */
static int piecewise_edges(piecewise_line *line, const double *edge)
{
    const size_t n = line->pieces;
    int e;
    for (size_t k = 0; k <= n; k++)
        line->edge[k] = edge ? edge[k] : piecewise_edge(k, n);
    for (size_t k = 0; k < n; k++)
        if (!(line->edge[k] < line->edge[k + 1]))
            return INT32_MAX;
    const double range = line->edge[n] - line->edge[0];
    if (!(range >= 0x1p-900 && range <= 0x1p900))
        return INT32_MAX;
    buffon_priv_frexp(&e, range);
    return e;
}

/* Copies the heights, scaled by a power of two so that their sums are in range. Non-zero: not
 * usable. */
static int piecewise_heights(double *out, const double *height, size_t count)
{
    buffon_priv_shares scale;
    if (buffon_priv_shares_scale(&scale, buffon_priv_largest(height, count)))
        return 1;
    for (size_t k = 0; k < count; k++)
        out[k] = shares_scaled(&scale, height[k]);
    return 0;
}

/* Masses are heights times widths, relative to the range: neither can leave the doubles. */
static buffon_status piecewise_fill(piecewise_line *line, size_t values, int range)
{
    const size_t n = line->pieces;
    const double narrow = buffon_priv_ldexp(1, -range);
    buffon_priv_shares sum;
    for (size_t k = 0; k < n; k++) {
        const double width = (line->edge[k + 1] - line->edge[k]) * narrow;
        const double height = values > n ? 0.5 * (line->g[k] + line->g[k + 1]) : line->g[k];
        line->bound[k + 1] = buffon_priv_bits(height * width);
    }
    const buffon_status status = buffon_priv_shares_make(line->bound, n, &sum);
    if (status != BUFFON_OK)
        return status;
    for (size_t k = 0; k < values; k++) {
        line->g[k] = buffon_priv_ldexp(line->g[k] / sum.all, -sum.exponent - range);
        if (!(line->g[k] <= 0x1p1022))
            return BUFFON_E_TABLE;
    }
    buffon_priv_guide_make(line->first, line->bits, line->bound, n);
    return BUFFON_OK;
}

static const buffon_density_ops piecewise_steps_ops = {.sample = piecewise_draw_steps,
                                                       .pdf = piecewise_pdf_steps,
                                                       .invert = piecewise_unmap_steps,
                                                       .identity = buffon_priv_table_identity,
                                                       .name = "buffon.piecewise_constant"};

static const buffon_density_ops piecewise_lines_ops = {.sample = piecewise_draw_lines,
                                                       .pdf = piecewise_pdf_lines,
                                                       .invert = piecewise_unmap_lines,
                                                       .identity = buffon_priv_table_identity,
                                                       .name = "buffon.piecewise_linear"};

static buffon_status piecewise_make(buffon_priv_table *table, const double *edge,
                                    const double *height, size_t pieces, size_t values)
{
    if (!height)
        return BUFFON_E_NULL;
    table->size[0] = pieces;
    table->bits[0] = buffon_priv_guide_bits(pieces);
    table->spare = edge ? 0 : 1;
    piecewise_line line = piecewise_of(table);
    const int range = piecewise_edges(&line, edge);
    if (range == INT32_MAX)
        return BUFFON_E_TABLE;
    if (piecewise_heights(line.g, height, values))
        return BUFFON_E_SHAPE;
    const buffon_status status = piecewise_fill(&line, values, range);
    if (status == BUFFON_OK)
        buffon_priv_table_close(table);
    return status;
}

buffon_density buffon_piecewise_constant(void *memory, size_t size, const double *edge,
                                         const double *height, size_t count)
{
    buffon_status status;
    const size_t wanted = buffon_piecewise_constant_size(count);
    buffon_priv_table *table =
        buffon_priv_table_begin(&status, memory, size, wanted, TABLE_CONSTANT);
    if (table)
        status = piecewise_make(table, edge, height, count, count);
    return status == BUFFON_OK ? buffon_priv_piecewise_view(table)
                               : table_refused(&piecewise_steps_ops, 1, 1, status);
}

buffon_density buffon_piecewise_linear(void *memory, size_t size, const double *knot,
                                       const double *height, size_t count)
{
    buffon_status status;
    const size_t wanted = buffon_piecewise_linear_size(count);
    buffon_priv_table *table = buffon_priv_table_begin(&status, memory, size, wanted, TABLE_LINEAR);
    if (table)
        status = piecewise_make(table, knot, height, count - 1, count);
    return status == BUFFON_OK ? buffon_priv_piecewise_view(table)
                               : table_refused(&piecewise_lines_ops, 1, 1, status);
}

/* ---- steps of a grid ----------------------------------------------------------------------- */

enum { PIECEWISE_TILE = 512 };

static buffon_priv_sheet piecewise_sheet(const buffon_density *g)
{
    return buffon_priv_sheet_of(g->data[0], sizeof(buffon_priv_table));
}

/* The point so far into piece k of n, and still in it. */
static double piecewise_point(size_t k, size_t n, double part)
{
    const double lo = piecewise_edge(k, n), hi = piecewise_edge(k + 1, n);
    const double x = ((double)k + part) / (double)n;
    return x < lo ? lo : x < hi ? x : buffon_priv_nextdown(hi);
}

static int piecewise_draw_grid(double *x, double *pdf, const double *u, size_t n,
                               const buffon_density *g)
{
    const buffon_priv_sheet sheet = piecewise_sheet(g);
    const double cells = (double)sheet.columns * (double)sheet.rows;
    uint32_t row[PIECEWISE_TILE], column[PIECEWISE_TILE];
    for (size_t i = 0; i < n; i++) {
        const size_t t = i % PIECEWISE_TILE;
        double above, rest, left;
        if (t == 0)
            buffon_priv_sheet_find(row, column, u + i, u + n + i,
                                   n - i < PIECEWISE_TILE ? n - i : PIECEWISE_TILE, &sheet);
        const uint64_t down = shares_unit(&above, u[n + i]), unit = shares_unit(&rest, u[i]);
        const size_t r = row[t], c = column[t];
        const double across = shares_into(&left, sheet_columns(&sheet, r), c, unit, rest);
        x[i] = piecewise_point(c, sheet.columns, across);
        x[n + i] = piecewise_point(r, sheet.rows, shares_into(&left, sheet.row, r, down, above));
        if (pdf)
            pdf[i] = sheet_mass(&sheet, r, c) * cells;
    }
    return 0;
}

static int piecewise_pdf_grid(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const buffon_priv_sheet sheet = piecewise_sheet(g);
    const double cells = (double)sheet.columns * (double)sheet.rows;
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i];
        pdf[i] = 0;
        if (a >= 0 && a <= 1 && b >= 0 && b <= 1)
            pdf[i] = sheet_mass(&sheet, piecewise_cell(b, sheet.rows),
                                piecewise_cell(a, sheet.columns)) *
                     cells;
    }
    return 0;
}

static int piecewise_unmap_grid(double *u, const double *x, size_t n, const buffon_density *g)
{
    const buffon_priv_sheet sheet = piecewise_sheet(g);
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] >= 0 && x[i] <= 1 ? x[i] : 0;
        const double b = x[n + i] >= 0 && x[n + i] <= 1 ? x[n + i] : 0;
        const size_t c = piecewise_cell(a, sheet.columns), r = piecewise_cell(b, sheet.rows);
        const double across = a * (double)sheet.columns - (double)c;
        const double down = b * (double)sheet.rows - (double)r;
        u[i] = density_open(shares_uniform(sheet_columns(&sheet, r), c, across));
        u[n + i] = density_open(shares_uniform(sheet.row, r, down));
    }
    return 0;
}

static const buffon_density_ops piecewise_grid_ops = {.sample = piecewise_draw_grid,
                                                      .pdf = piecewise_pdf_grid,
                                                      .invert = piecewise_unmap_grid,
                                                      .identity = buffon_priv_table_identity,
                                                      .name = "buffon.piecewise_grid"};

size_t buffon_piecewise_grid_size(size_t columns, size_t rows)
{
    return buffon_priv_sheet_size(sizeof(buffon_priv_table), columns, rows);
}

static buffon_status piecewise_make_grid(buffon_priv_table *table, const double *height,
                                         size_t columns, size_t rows)
{
    buffon_priv_shares scale;
    if (!height)
        return BUFFON_E_NULL;
    if (buffon_priv_shares_scale(&scale, buffon_priv_largest(height, columns * rows)))
        return BUFFON_E_SHAPE;
    table->size[0] = columns;
    table->size[1] = rows;
    table->bits[0] = buffon_priv_guide_bits(columns);
    table->bits[1] = buffon_priv_guide_bits(rows);
    const buffon_priv_sheet sheet = buffon_priv_sheet_of(table, sizeof *table);
    for (size_t r = 0; r < rows; r++)
        for (size_t c = 0; c < columns; c++)
            sheet_put(&sheet, r, c, shares_scaled(&scale, height[r * columns + c]));
    const buffon_status status = buffon_priv_sheet_make(&sheet, NULL);
    if (status == BUFFON_OK)
        buffon_priv_table_close(table);
    return status;
}

buffon_density buffon_piecewise_grid(void *memory, size_t size, const double *height,
                                     size_t columns, size_t rows)
{
    buffon_status status;
    const size_t wanted = buffon_piecewise_grid_size(columns, rows);
    buffon_priv_table *table = buffon_priv_table_begin(&status, memory, size, wanted, TABLE_GRID);
    if (table)
        status = piecewise_make_grid(table, height, columns, rows);
    return status == BUFFON_OK ? buffon_priv_piecewise_view(table)
                               : table_refused(&piecewise_grid_ops, 2, 2, status);
}

buffon_density buffon_priv_piecewise_view(const buffon_priv_table *table)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .data = {table, NULL}};
    const table_kind kind = buffon_priv_table_kind(table);
    g.ops = kind == TABLE_CONSTANT ? &piecewise_steps_ops : &piecewise_lines_ops;
    if (kind == TABLE_GRID) {
        g.ops = &piecewise_grid_ops;
        g.uniforms = g.dim = 2;
    }
    return g;
}
