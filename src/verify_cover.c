/* A density under another that covers its support: their ratio, summed and by cells. */
#include "guard.h"

#include <math.h>
#include <string.h>

#include <buffon/cap.h>
#include <buffon/sphere.h>

#include "density_priv.h"
#include "elementary.h"
#include "pvalue.h"
#include "verify_priv.h"

enum {
    VERIFY_COARSE = 64,  /* groups of cells */
    VERIFY_PER_CELL = 16 /* points by which the pdf's share of a cell is found: a power of two */
};

#define VERIFY_BEYOND 1e-6 /* of a pdf to that of `over`, where no uniform of the generator leads */
#define VERIFY_HEAVY 0.02  /* the largest share of a sum of squares that passes for light */

/* ---- what covers ---- */

/* The line, from uniforms: x = middle + scale t, t = z / (1 - z^2), z = 2 v - 1. Half of it lies
 * within 2/3 of the scale, and its tails are those of 1 / x^2: few laws have heavier ones. */
static int verify_line_draw(double *x, double *pdf, const double *u, size_t n,
                            const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const double z = 2 * u[i] - 1, rest = 4 * u[i] * (1 - u[i]);
        x[i] = g->param[0] + g->param[1] * (z / rest);
        if (pdf)
            pdf[i] = rest * rest / (2 * (1 + z * z)) / g->param[1];
    }
    return 0;
}

static double verify_line_z(double x, const buffon_density *g)
{
    const double t = (x - g->param[0]) / g->param[1];
    return 2 * t / (1 + sqrt(1 + 4 * t * t));
}

static int verify_line_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const double z = verify_line_z(x[i], g), rest = (1 - z) * (1 + z);
        pdf[i] = rest * rest / (2 * (1 + z * z)) / g->param[1];
    }
    return 0;
}

static int verify_line_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        u[i] = density_open(0.5 + 0.5 * verify_line_z(x[i], g));
    return 0;
}

static const buffon_density_ops verify_line_ops = {.sample = verify_line_draw,
                                                   .pdf = verify_line_pdf,
                                                   .invert = verify_line_invert,
                                                   .name = "buffon.verify_line"};

/* Of directions: the least cap of twice the height of that which holds the points, about their
 * mean, or the sphere. 0 if the points are no directions. */
static int verify_cover_directions(verify *t, const verify_cloud *cloud)
{
    const size_t n = cloud->n;
    const double *x = cloud->x;
    double mean[3] = {0, 0, 0}, height = 0;
    for (size_t i = 0; i < n; i++) {
        double square = 0;
        for (size_t d = 0; d < 3; d++) {
            square += x[d * n + i] * x[d * n + i];
            mean[d] += x[d * n + i] / (double)n;
        }
        if (!(buffon_priv_abs(square - 1) <= 1e-9))
            return 0;
    }
    const double length = sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
    for (size_t i = 0; i < n; i++) {
        double chord = 0;
        for (size_t d = 0; d < 3; d++) {
            const double off = x[d * n + i] - mean[d] / length;
            chord += off * off;
        }
        height = chord / 2 > height ? chord / 2 : height;
    }
    t->own[0] = length > 0.1 && height < 1 ? buffon_cap_height(2 * height, mean) : buffon_sphere();
    return 1;
}

/* What covers g, of the user or made from the first points; NULL where there is none. */
void buffon_priv_verify_cover(verify *t, const verify_cloud *cloud)
{
    const size_t dim = t->g->dim;
    t->over = t->how.over;
    if (t->over != NULL || t->how.discrete || !t->has_pdf)
        return;
    if (dim == 3 && verify_cover_directions(t, cloud)) {
        t->over = &t->own[0];
        return;
    }
    if (t->g->uniforms < dim || dim > VERIFY_DIM)
        return;
    for (size_t j = 0; j < dim; j++)
        t->own[j] = (buffon_density){.uniforms = 1,
                                     .dim = 1,
                                     .ops = &verify_line_ops,
                                     .param = {t->middle[j], 3 * t->spread[j]}};
    t->own[dim] = buffon_density_product(t->own, dim);
    t->over = &t->own[dim];
}

/* SUPPORT, of point i of `over` where the pdf of g is positive: the way back and forth leads to it
 * again, as far as the rounding of uniforms lets it. A point beyond the outermost uniforms may be
 * one of a long tail, and then has next to no pdf. */
static buffon_status verify_support(verify *t, const verify_cloud *cloud, size_t i)
{
    verify_cloud *near = &t->other;
    const size_t n = cloud->n, uniforms = t->g->uniforms, dim = t->g->dim;
    double y[VERIFY_DIM], v[VERIFY_DIM], worst = 0;
    int beyond = 0;
    for (size_t d = 0; d < dim; d++)
        y[d] = cloud->x[d * n + i];
    buffon_status status = buffon_density_invert(v, y, 1, t->g);
    near->n = 1 + 2 * uniforms;
    for (size_t j = 0; j < uniforms; j++) {
        beyond |= v[j] <= 0x1p-53 || v[j] >= 1 - 0x1p-53;
        for (size_t k = 0; k < near->n; k++)
            near->u[j * near->n + k] = v[j];
        near->u[j * near->n + 1 + 2 * j] = density_inside(v[j] * (1 - 0x1p-48));
        near->u[j * near->n + 2 + 2 * j] = density_inside(v[j] + (1 - v[j]) * 0x1p-48 + 0x1p-52);
    }
    if (status == BUFFON_OK)
        status = buffon_priv_verify_sample(t, near);
    for (size_t d = 0; d < dim && status == BUFFON_OK; d++) {
        const double *x = near->x + d * near->n;
        double allowed = (t->how.tolerance + VERIFY_ROUND) * buffon_priv_verify_size(t, d, y[d]);
        for (size_t k = 1; k < near->n; k++)
            allowed += buffon_priv_abs(x[k] - x[0]);
        const double error = buffon_priv_abs(x[0] - y[d]) / allowed;
        worst = error > worst || error != error ? error : worst;
    }
    if (beyond)
        worst = cloud->pdf[i] / VERIFY_BEYOND;
    near->n = 1; /* the place: the uniforms found, and the point */
    for (size_t d = 0; d < dim; d++)
        near->x[d] = y[d];
    for (size_t j = 0; j < uniforms; j++)
        near->u[j] = v[j];
    if (status == BUFFON_OK)
        buffon_priv_verify_see(t, BUFFON_VERIFY_SUPPORT, worst, near, 0);
    return status;
}

/* Cells of the uniforms of `over`: so many to a side, for the first so many axes. */
typedef struct verify_grid {
    size_t axes, side, cells;
} verify_grid;

static verify_grid verify_grid_make(const verify *t)
{
    const size_t uniforms = t->over->uniforms, room = (size_t)t->how.samples / 16;
    const size_t most = room < VERIFY_CELLS ? room : VERIFY_CELLS;
    verify_grid grid = {.axes = uniforms < VERIFY_AXES ? uniforms : VERIFY_AXES, .side = 1};
    for (;;) {
        size_t cells = 1;
        for (size_t j = 0; j < grid.axes && cells <= most; j++)
            cells *= grid.side + 1;
        if (cells > most)
            break;
        grid.cells = cells;
        grid.side++;
    }
    if (grid.side == 1) { /* too many axes even for two to a side */
        for (grid.axes = 0, grid.cells = 1; grid.cells * 2 <= most; grid.axes++)
            grid.cells *= 2;
        grid.side = 2;
    }
    return grid;
}

/* The cell in which uniforms v, one every `stride`, lie. */
static size_t verify_cell(const verify_grid *grid, const double *v, size_t stride)
{
    size_t cell = 0;
    for (size_t j = 0; j < grid->axes; j++) {
        const size_t at = (size_t)(v[j * stride] * (double)grid->side);
        cell = cell * grid->side + (at < grid->side ? at : grid->side - 1);
    }
    return cell;
}

/* VERIFY_PER_CELL points of a cell, from point i of the cloud on, in uniforms of `over`: random,
 * one in each slice of the cell, along every axis. Point k lies in slice a k + b. */
static void verify_slices(verify *t, size_t n, size_t i, const verify_grid *grid, size_t cell)
{
    const size_t slices = VERIFY_PER_CELL; /* a power of two */
    for (size_t j = t->over->uniforms; j-- > 0;) {
        const int axis = j < grid->axes;
        const size_t a = 1 + 2 * (size_t)buffon_rng_below(&t->rng, slices / 2);
        const size_t b = (size_t)buffon_rng_below(&t->rng, slices);
        const double side = axis ? (double)grid->side : 1;
        const double at = axis ? (double)(cell % grid->side) : 0;
        for (size_t k = 0; k < slices; k++) {
            const double slice = (double)((a * k + b) % slices) + buffon_rng_next(&t->rng);
            t->v[j * n + i + k] = density_open((at + slice / (double)slices) / side);
        }
        cell /= axis ? grid->side : 1;
    }
}

/* Ratios of the pdfs at points of cells first, first + 1, ...: VERIFY_PER_CELL of each, as many as
 * fill the cloud. Leaves uniforms of `over` in v, points in x and ratios in pdf. */
static buffon_status verify_ratios(verify *t, verify_cloud *cloud, const verify_grid *grid,
                                   size_t first)
{
    const size_t n = cloud->n;
    for (size_t i = 0; i < n; i += VERIFY_PER_CELL)
        verify_slices(t, n, i, grid, first + i / VERIFY_PER_CELL);
    t->report->points += n;
    buffon_status status = buffon_density_sample(cloud->x, t->again, t->v, n, t->over);
    if (status == BUFFON_OK)
        status = buffon_density_pdf(cloud->pdf, cloud->x, n, t->g);
    for (size_t i = 0; i < n && status == BUFFON_OK; i++) {
        const double ratio = cloud->pdf[i] / t->again[i];
        buffon_priv_verify_see(t, BUFFON_VERIFY_POINTS,
                               ratio >= 0 && ratio <= 0x1p+1000 ? 0 : (double)INFINITY, NULL, 0);
        cloud->pdf[i] = ratio;
    }
    return status;
}

/* The share of a cell from its ratios, and the variance of that. A cell with an edge or a peak in
 * it is not known well from so few: the return value is 0. */
static int verify_share(double *share, double *variance, const double *ratio)
{
    double sum = 0, squares = 0, most = 0;
    size_t positive = 0;
    for (size_t i = 0; i < VERIFY_PER_CELL; i++) {
        sum += ratio[i];
        positive += ratio[i] > 0;
        most = ratio[i] > most ? ratio[i] : most;
    }
    *share = sum / VERIFY_PER_CELL;
    for (size_t i = 0; i < VERIFY_PER_CELL; i++)
        squares += (ratio[i] - *share) * (ratio[i] - *share);
    *variance = squares / (VERIFY_PER_CELL * (VERIFY_PER_CELL - 1));
    return positive == VERIFY_PER_CELL && most <= 0.5 * sum;
}

/* What is summed over the cells of `over`. */
typedef struct verify_sums {
    double total, variance, squares, largest; /* of ratios: sums, and the largest square */
    size_t positive, supported;
} verify_sums;

static buffon_status verify_shares(verify *t, const verify_grid *grid, verify_sums *sums,
                                   char *known)
{
    for (size_t cell = 0; cell < grid->cells;) {
        verify_cloud *cloud = &t->points;
        const size_t left = grid->cells - cell, batch = VERIFY_BATCH / VERIFY_PER_CELL;
        cloud->n = VERIFY_PER_CELL * (left < batch ? left : batch);
        buffon_status status = verify_ratios(t, cloud, grid, cell);
        if (status != BUFFON_OK || t->report->item[BUFFON_VERIFY_POINTS].failed)
            return status;
        for (size_t i = 0; i < cloud->n; i++) {
            const double square = cloud->pdf[i] * cloud->pdf[i];
            sums->squares += square;
            sums->largest = square > sums->largest ? square : sums->largest;
            sums->positive += cloud->pdf[i] > 0;
            if (cloud->pdf[i] > 0 && t->has_inverse && sums->supported < VERIFY_BATCH) {
                sums->supported++;
                status = verify_support(t, cloud, i);
            }
            if (status != BUFFON_OK)
                return status;
        }
        for (size_t i = 0; i < cloud->n; i += VERIFY_PER_CELL, cell++) {
            known[cell] =
                (char)verify_share(&t->expected[cell], &t->variance[cell], cloud->pdf + i);
        }
    }
    return BUFFON_OK;
}

/* A jump of the pdf within a cell may lie beyond all points that were tried there, and no spread is
 * seen. What is missed then is at most a slice of the cell with the difference to the next cell,
 * along whichever axis: as if even up to that, it is added to the variance. */
static void verify_widen(verify *t, const verify_grid *grid, verify_sums *sums)
{
    const double cells = (double)grid->cells;
    for (size_t c = 0; c < grid->cells; c++) {
        double most = 0;
        for (size_t stride = 1; stride < grid->cells; stride *= grid->side) {
            const size_t at = c / stride % grid->side;
            const double down = at > 0 ? t->expected[c] - t->expected[c - stride] : 0;
            const double up = at + 1 < grid->side ? t->expected[c] - t->expected[c + stride] : 0;
            most = buffon_priv_abs(down) > most ? buffon_priv_abs(down) : most;
            most = buffon_priv_abs(up) > most ? buffon_priv_abs(up) : most;
        }
        most /= VERIFY_PER_CELL;
        t->variance[c] += most * most / 12;
        sums->total += t->expected[c] / cells;
        sums->variance += t->variance[c] / cells / cells;
    }
}

/* Points of g, counted in the cells of `over`. */
static buffon_status verify_count(verify *t, const verify_grid *grid)
{
    memset(t->count, 0, grid->cells * sizeof *t->count);
    for (uint64_t done = 0; done < t->how.samples;) {
        verify_cloud *cloud = &t->points;
        const uint64_t left = t->how.samples - done;
        const size_t n = cloud->n = left < VERIFY_BATCH ? (size_t)left : VERIFY_BATCH;
        buffon_priv_verify_uniforms(t, cloud, 0);
        buffon_status status = buffon_priv_verify_sample(t, cloud);
        if (status == BUFFON_OK)
            status = buffon_density_invert(t->v, cloud->x, n, t->over);
        if (status != BUFFON_OK)
            return status;
        for (size_t i = 0; i < n; i++)
            t->count[verify_cell(grid, t->v + i, n)]++;
        done += n;
    }
    return BUFFON_OK;
}

/* Neighbours taken together, VERIFY_COARSE groups of them: many cells see a narrow mistake, few a
 * slight but wide one. Returns how many groups there are. */
static size_t verify_coarsen(verify *t, size_t cells)
{
    const size_t length = (cells + VERIFY_COARSE - 1) / VERIFY_COARSE;
    size_t groups = 0;
    for (size_t c = 0; c < cells; groups++) {
        double sum[3] = {0, 0, 0};
        for (size_t k = 0; k < length && c < cells; k++, c++) {
            sum[0] += t->count[c];
            sum[1] += t->expected[c];
            sum[2] += t->variance[c];
        }
        t->count[groups] = sum[0];
        t->expected[groups] = sum[1];
        t->variance[groups] = sum[2];
    }
    return groups;
}

/* CELLS: the shares that are known, then all others as one. */
static void verify_cells(verify *t, const verify_grid *grid, const char *known)
{
    const double n = (double)t->how.samples, cells = (double)grid->cells;
    double rest[3] = {0, 0, 0};
    size_t kept = 0;
    for (size_t c = 0; c < grid->cells; c++) {
        const double mean = t->expected[c] / cells, variance = t->variance[c] / (cells * cells);
        const double value[3] = {t->count[c], n * mean, n * mean + n * n * variance};
        for (size_t k = 0; k < 3 && !known[c]; k++)
            rest[k] += value[k];
        if (known[c]) {
            t->count[kept] = value[0];
            t->expected[kept] = value[1];
            t->variance[kept++] = value[2];
        }
    }
    if (kept < grid->cells) {
        t->count[kept] = rest[0];
        t->expected[kept] = rest[1];
        t->variance[kept++] = rest[2];
    }
    buffon_priv_verify_judge(t, BUFFON_VERIFY_CELLS,
                             buffon_priv_p_cells(t->count, t->expected, t->variance, kept));
    const size_t coarse = verify_coarsen(t, kept);
    buffon_priv_verify_judge(t, BUFFON_VERIFY_CELLS,
                             buffon_priv_p_cells(t->count, t->expected, t->variance, coarse));
}

/* SUPPORT, TOTAL and CELLS. Where the ratio of the pdfs has a heavy tail its mean says little, and
 * the latter two are left. */
buffon_status buffon_priv_verify_covered(verify *t)
{
    const verify_grid grid = verify_grid_make(t);
    verify_sums sums = {0, 0, 0, 0, 0, 0};
    char known[VERIFY_CELLS];
    buffon_status status = verify_shares(t, &grid, &sums, known);
    if (status != BUFFON_OK || t->report->item[BUFFON_VERIFY_POINTS].failed)
        return status;
    verify_widen(t, &grid, &sums);
    if (sums.positive < VERIFY_PER_CELL * 4 || sums.largest > VERIFY_HEAVY * sums.squares)
        return BUFFON_OK;
    const double off = buffon_priv_abs(sums.total - 1) - t->how.tolerance;
    const double z = off <= 0            ? 0
                     : sums.variance > 0 ? off / sqrt(sums.variance)
                                         : (double)INFINITY;
    buffon_priv_verify_judge(t, BUFFON_VERIFY_TOTAL, z < 40 ? buffon_priv_p_normal(z) : 0);
    status = verify_count(t, &grid);
    if (status == BUFFON_OK)
        verify_cells(t, &grid, known);
    return status;
}
