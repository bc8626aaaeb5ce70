#include "guard.h"

#include <math.h>
#include <string.h>

#include <buffon/bilinear.h>

#include "density_priv.h"
#include "elementary.h"
#include "ramp.h"
#include "shares.h"
#include "pair.h"

/* param: v00, v10, v01, v11, scaled by a power of two so that the largest is in [1/2, 1); then four
 * over their sum. */

static double bilinear_mix(double a, double b, double s)
{
    return (1 - s) * a + s * b;
}

static double bilinear_height(const double *v, double x, double y)
{
    return bilinear_mix(bilinear_mix(v[0], v[2], y), bilinear_mix(v[1], v[3], y), x) * v[4];
}

/* From the nearer end. */
static double biramp_place(double a, double b, double u)
{
    double s, c, way;
    ramp_place(&s, &c, a, b, u, 1 - u);
    const size_t end = ramp_end(&way, s, c);
    return (double)(int64_t)end + way;
}

static int bilinear_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double *v = g->param;
    for (size_t i = 0; i < n; i++) {
        const double y = biramp_place(v[0] + v[1], v[2] + v[3], u[n + i]);
        x[i] = biramp_place(bilinear_mix(v[0], v[2], y), bilinear_mix(v[1], v[3], y), u[i]);
        x[n + i] = y;
        if (pdf)
            pdf[i] = bilinear_height(v, x[i], y);
    }
    return 0;
}

static int bilinear_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const int inside = x[i] >= 0 && x[i] <= 1 && x[n + i] >= 0 && x[n + i] <= 1;
        pdf[i] = inside ? bilinear_height(g->param, x[i], x[n + i]) : 0;
    }
    return 0;
}

static int bilinear_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double *v = g->param;
    for (size_t i = 0; i < n; i++) {
        const double y = x[n + i];
        const double a = bilinear_mix(v[0], v[2], y), b = bilinear_mix(v[1], v[3], y);
        u[i] = density_open(ramp_mass(a, b, x[i], 1 - x[i]));
        u[n + i] = density_open(ramp_mass(v[0] + v[1], v[2] + v[3], y, 1 - y));
    }
    return 0;
}

static const buffon_density_ops bilinear_ops = {.sample = bilinear_draw,
                                                .pdf = bilinear_pdf,
                                                .invert = bilinear_unmap,
                                                .name = "buffon.bilinear"};

buffon_density buffon_bilinear(double v00, double v10, double v01, double v11)
{
    buffon_density g = {.uniforms = 2, .dim = 2, .ops = &bilinear_ops};
    const double v[4] = {v00, v10, v01, v11};
    double most = 0;
    int e;
    for (int k = 0; k < 4; k++) {
        if (!(v[k] >= 0) || !buffon_priv_isfinite(v[k]))
            g.status = BUFFON_E_SHAPE;
        most = v[k] > most ? v[k] : most;
    }
    if (!(most > 0))
        g.status = BUFFON_E_SHAPE;
    if (g.status != BUFFON_OK)
        return g;
    buffon_priv_frexp(&e, most);
    for (int k = 0; k < 4; k++)
        g.param[k] = buffon_priv_ldexp(v[k], -e);
    g.param[4] = 4 / ((g.param[0] + g.param[1]) + (g.param[2] + g.param[3]));
    return g;
}

/* ---- a grid of nodes ------------------------------------------------------------------------ */

/* The block: g at the nodes; what rows integrate to, up to a common factor; the bounds of the
 * strips between rows; for each row the bounds of its pieces; the strips' index. */
typedef struct bilinear_grid {
    size_t columns, rows;
    unsigned bits;
    double *node, *row;
    uint64_t *strip, *piece;
    uint32_t *first;
} bilinear_grid;

size_t buffon_bilinear_grid_size(size_t columns, size_t rows)
{
    if (columns < 2 || rows < 2 || columns > SHARES_MOST || rows > SHARES_MOST)
        return SIZE_MAX;
    const size_t width = buffon_priv_table_more(0, columns, sizeof(double) + sizeof(uint64_t));
    size_t size = buffon_priv_table_more(sizeof(buffon_priv_table), rows, width);
    size = buffon_priv_table_more(size, rows, sizeof(double) + sizeof(uint64_t));
    return buffon_priv_table_more(size, ((size_t)1 << buffon_priv_guide_bits(rows - 1)) + 1,
                                  sizeof(uint32_t));
}

static bilinear_grid bilinear_grid_of(const buffon_priv_table *table)
{
    bilinear_grid grid = {.columns = (size_t)table->size[0],
                          .rows = (size_t)table->size[1],
                          .bits = (unsigned)table->bits[1]};
    grid.node = (double *)(uintptr_t)(table + 1);
    grid.row = grid.node + grid.columns * grid.rows;
    grid.strip = (uint64_t *)(grid.row + grid.rows);
    grid.piece = grid.strip + grid.rows;
    grid.first = (uint32_t *)(grid.piece + grid.columns * grid.rows);
    return grid;
}

/* A place among n equal pieces of [0, 1]: in piece k, s of its width from its lower end and c from
 * its upper. The product n x is exact, so s and c are right to the last digit however small. */
typedef struct bilinear_spot {
    size_t k;
    double s, c;
} bilinear_spot;

static bilinear_spot bilinear_spot_of(double x, size_t n)
{
    const pair at = pair_product(x, (double)(int64_t)n);
    const size_t cell = (size_t)(int64_t)at.hi;
    bilinear_spot spot = {.k = cell < n ? cell : n - 1};
    spot.k -= spot.k > 0 && (at.hi - (double)(int64_t)spot.k) + at.lo < 0;
    spot.s = (at.hi - (double)(int64_t)spot.k) + at.lo;
    spot.c = ((double)(int64_t)(spot.k + 1) - at.hi) - at.lo;
    return spot;
}

/* The point of piece k of n below which lies the part t of its mass, and q above. A point where g
 * is 0 is none: t is at least what the generator's least uniform is of the whole. */
static double bilinear_point(size_t k, size_t n, double a, double b, double t, double q)
{
    double s, c, way;
    ramp_place(&s, &c, a, b, t > 0x1p-53 ? t : 0x1p-53, q > 0x1p-53 ? q : 0x1p-53);
    const size_t end = ramp_end(&way, s, c);
    return ((double)(int64_t)(k + end) + way) / (double)(int64_t)n;
}

/* The line across the grid at some y: its height at node i, and what lies below it of the whole, up
 * to a factor that is 1 but for rounding. */
typedef struct bilinear_line {
    const double *low, *high;
    const uint64_t *below_low, *below_high;
    double s, c, share_low, share_high;
} bilinear_line;

static bilinear_line bilinear_line_of(const bilinear_grid *grid, bilinear_spot y)
{
    const size_t low = y.k * grid->columns, high = low + grid->columns;
    const double a = y.c * grid->row[y.k], b = y.s * grid->row[y.k + 1], sum = a + b;
    return (bilinear_line){.low = grid->node + low,
                           .high = grid->node + high,
                           .below_low = grid->piece + low,
                           .below_high = grid->piece + high,
                           .s = y.s,
                           .c = y.c,
                           .share_low = sum > 0 ? 0x1p-62 * (a / sum) : 0,
                           .share_high = sum > 0 ? 0x1p-62 * (b / sum) : 0};
}

static double bilinear_node(const bilinear_line *line, size_t i)
{
    return line->c * line->low[i] + line->s * line->high[i];
}

static double bilinear_below(const bilinear_line *line, size_t i)
{
    return line->share_low * (double)(int64_t)line->below_low[i] +
           line->share_high * (double)(int64_t)line->below_high[i];
}

static double bilinear_across(const bilinear_line *line, double u, size_t pieces)
{
    const double t = u * bilinear_below(line, pieces);
    size_t k = 0;
    for (size_t left = pieces; left > 1;) {
        const size_t half = left / 2;
        k += half & (0 - (size_t)(bilinear_below(line, k + half) <= t));
        left -= half;
    }
    const double lo = bilinear_below(line, k), hi = bilinear_below(line, k + 1);
    return bilinear_point(k, pieces, bilinear_node(line, k), bilinear_node(line, k + 1),
                          (t - lo) / (hi - lo), (hi - t) / (hi - lo));
}

static double bilinear_grid_height(const bilinear_grid *grid, double x, double y)
{
    const bilinear_line line = bilinear_line_of(grid, bilinear_spot_of(y, grid->rows - 1));
    const bilinear_spot spot = bilinear_spot_of(x, grid->columns - 1);
    return spot.c * bilinear_node(&line, spot.k) + spot.s * bilinear_node(&line, spot.k + 1);
}

static int bilinear_grid_draw(double *x, double *pdf, const double *u, size_t n,
                              const buffon_density *g)
{
    const bilinear_grid grid = bilinear_grid_of(g->data[0]);
    for (size_t i = 0; i < n; i++) {
        double rest, left;
        const uint64_t unit = shares_unit(&rest, u[n + i]);
        const size_t r = shares_find(grid.strip, grid.first, grid.bits, unit);
        const double into = shares_into(&left, grid.strip, r, unit, rest);
        const double y = bilinear_point(r, grid.rows - 1, grid.row[r], grid.row[r + 1], into, left);
        const bilinear_line line = bilinear_line_of(&grid, bilinear_spot_of(y, grid.rows - 1));
        x[i] = bilinear_across(&line, u[i], grid.columns - 1);
        x[n + i] = y;
        if (pdf)
            pdf[i] = bilinear_grid_height(&grid, x[i], y);
    }
    return 0;
}

static int bilinear_grid_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const bilinear_grid grid = bilinear_grid_of(g->data[0]);
    for (size_t i = 0; i < n; i++) {
        const int inside = x[i] >= 0 && x[i] <= 1 && x[n + i] >= 0 && x[n + i] <= 1;
        pdf[i] = inside ? bilinear_grid_height(&grid, x[i], x[n + i]) : 0;
    }
    return 0;
}

/* The mass of a piece below a place in it, of a piece with any. */
static double bilinear_part(double a, double b, bilinear_spot at)
{
    return a + b > 0 ? ramp_mass(a, b, at.s, at.c) : 0;
}

static int bilinear_grid_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    const bilinear_grid grid = bilinear_grid_of(g->data[0]);
    for (size_t i = 0; i < n; i++) {
        const double a = x[i] >= 0 && x[i] <= 1 ? x[i] : 0;
        const double b = x[n + i] >= 0 && x[n + i] <= 1 ? x[n + i] : 0;
        const bilinear_spot down = bilinear_spot_of(b, grid.rows - 1);
        const bilinear_spot across = bilinear_spot_of(a, grid.columns - 1);
        const bilinear_line line = bilinear_line_of(&grid, down);
        const double lo = bilinear_below(&line, across.k), hi = bilinear_below(&line, across.k + 1);
        const double part = bilinear_part(bilinear_node(&line, across.k),
                                          bilinear_node(&line, across.k + 1), across);
        u[i] = density_open(lo + part * (hi - lo));
        u[n + i] = density_open(shares_uniform(
            grid.strip, down.k, bilinear_part(grid.row[down.k], grid.row[down.k + 1], down)));
    }
    return 0;
}

static const buffon_density_ops bilinear_grid_ops = {.sample = bilinear_grid_draw,
                                                     .pdf = bilinear_grid_pdf,
                                                     .invert = bilinear_grid_unmap,
                                                     .identity = buffon_priv_table_identity,
                                                     .name = "buffon.bilinear_grid"};

buffon_density buffon_priv_bilinear_view(const buffon_priv_table *table)
{
    return (buffon_density){
        .uniforms = 2, .dim = 2, .ops = &bilinear_grid_ops, .data = {table, NULL}};
}

/* Bounds of the pieces between n values. Returns their integral; where it is 0, so are they. */
static double bilinear_shares(uint64_t *bound, const double *value, size_t n)
{
    buffon_priv_shares sum;
    for (size_t k = 0; k + 1 < n; k++)
        bound[k + 1] = buffon_priv_bits(0.5 * (value[k] + value[k + 1]));
    if (buffon_priv_shares_make(bound, n - 1, &sum) != BUFFON_OK) {
        memset(bound, 0, n * sizeof *bound);
        return 0;
    }
    return buffon_priv_ldexp(sum.all, sum.exponent) / (double)(n - 1);
}

static buffon_status bilinear_grid_make(buffon_priv_table *table, const double *height,
                                        size_t columns, size_t rows)
{
    buffon_priv_shares scale;
    if (!height)
        return BUFFON_E_NULL;
    if (buffon_priv_shares_scale(&scale, buffon_priv_largest(height, columns * rows)))
        return BUFFON_E_SHAPE;
    table->size[0] = columns;
    table->size[1] = rows;
    table->bits[1] = buffon_priv_guide_bits(rows - 1);
    const bilinear_grid grid = bilinear_grid_of(table);
    for (size_t k = 0; k < columns * rows; k++)
        grid.node[k] = shares_scaled(&scale, height[k]);
    for (size_t r = 0; r < rows; r++)
        grid.row[r] = bilinear_shares(grid.piece + r * columns, grid.node + r * columns, columns);
    const double total = bilinear_shares(grid.strip, grid.row, rows);
    for (size_t k = 0; k < columns * rows; k++)
        grid.node[k] /= total;
    buffon_priv_guide_make(grid.first, grid.bits, grid.strip, rows - 1);
    buffon_priv_table_close(table);
    return BUFFON_OK;
}

buffon_density buffon_bilinear_grid(void *memory, size_t size, const double *height, size_t columns,
                                    size_t rows)
{
    buffon_status status;
    const size_t wanted = buffon_bilinear_grid_size(columns, rows);
    buffon_priv_table *table =
        buffon_priv_table_begin(&status, memory, size, wanted, TABLE_BILINEAR);
    if (table)
        status = bilinear_grid_make(table, height, columns, rows);
    return status == BUFFON_OK ? buffon_priv_bilinear_view(table)
                               : table_refused(&bilinear_grid_ops, 2, 2, status);
}
