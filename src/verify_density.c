/* A density held against itself. Everything works on batches of points of one cloud: uniforms,
 * points, pdf. Exact checks come first, since statistics of points that are not numbers say
 * nothing. */
#include "guard.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <buffon/cap.h>
#include <buffon/rng.h>
#include <buffon/sphere.h>
#include <buffon/verify_density.h>

#include "density_priv.h"
#include "elementary.h"
#include "pvalue.h"

enum {
    VERIFY_BATCH = 1024, /* points at a time; at the edges; of differences */
    VERIFY_AXES = 8,     /* uniforms that are looked at one by one; axes of cells */
    VERIFY_DIM = 16,     /* most coordinates and uniforms where differences are taken */
    VERIFY_CELLS = 4096, /* at most */
    VERIFY_COARSE = 64,  /* groups of them */
    VERIFY_PER_CELL = 16 /* points by which the pdf's share of a cell is found: a power of two */
};

#define VERIFY_SHORT 0x1p-10 /* a difference, of the distance to 0 or 1 */
#define VERIFY_STRETCH 1e-6  /* by which the volume may be off, beside the error of differences */
#define VERIFY_NOISE 0x1p-51 /* of a computed number, relative */
#define VERIFY_ROUND 0x1p-48 /* what the rounding of a number may be worth, relative */
#define VERIFY_BEYOND 1e-6 /* of a pdf to that of `over`, where no uniform of the generator leads */
#define VERIFY_HEAVY 0.02  /* the largest share of a sum of squares that passes for light */

/* n points of a density. */
typedef struct verify_cloud {
    size_t n;
    double *u, *x, *pdf;
} verify_cloud;

typedef struct verify {
    const buffon_density *g, *over;
    buffon_verification how;
    buffon_verify_report *report;
    buffon_rng rng;
    int has_pdf, has_inverse, one_to_one;
    verify_cloud points, other; /* room for VERIFY_BATCH each */
    double *v;                  /* [uniforms * VERIFY_BATCH] uniforms found by the way back */
    double *again;              /* [VERIFY_BATCH] the pdf */
    double *even;               /* [axes * samples] */
    double *count, *expected, *variance; /* [VERIFY_CELLS] each */
    double *memory;
    double middle[VERIFY_DIM], spread[VERIFY_DIM]; /* of the first points */
    buffon_density own[VERIFY_DIM + 1];            /* an `over` that was made here */
} verify;

/* ---- report ---- */

/* An error in units of what is allowed, at point i of a cloud (NULL: no place). */
static void verify_see(verify *t, buffon_verify_check check, double error,
                       const verify_cloud *cloud, size_t i)
{
    buffon_verify_item *item = &t->report->item[check];
    const int failed = !(error <= 1);
    item->looked = 1;
    if (!(error > item->worst) && error == error)
        return;
    item->worst = error == error ? error : (double)INFINITY;
    item->failed |= failed;
    if (!failed || t->report->check < check || cloud == NULL)
        return;
    t->report->check = check;
    for (size_t j = 0; j < BUFFON_VERIFY_UNIFORMS; j++) {
        t->report->u[j] = j < t->g->uniforms ? cloud->u[j * cloud->n + i] : (double)NAN;
        t->report->x[j] = j < t->g->dim ? cloud->x[j * cloud->n + i] : (double)NAN;
    }
}

/* The p-value of a statistic: the least of its check is kept. */
static void verify_judge(verify *t, buffon_verify_check check, double p)
{
    buffon_verify_item *item = &t->report->item[check];
    item->p = item->looked && item->p < p ? item->p : p;
    item->looked = 1;
}

/* ---- clouds ---- */

static buffon_status verify_sample(verify *t, verify_cloud *cloud)
{
    t->report->points += cloud->n;
    return buffon_density_sample(cloud->x, t->has_pdf ? cloud->pdf : NULL, cloud->u, cloud->n,
                                 t->g);
}

/* Random uniforms; with edges, three of four coordinates of a point lie at 0, 1/2 or 1, as near as
 * the generator comes. */
static void verify_uniforms(verify *t, verify_cloud *cloud, int edges)
{
    static const double edge[3] = {0x1p-53, 0.5, 1 - 0x1p-53};
    for (size_t i = 0; i < t->g->uniforms * cloud->n; i++) {
        const uint64_t which = edges ? buffon_rng_below(&t->rng, 4) : 3;
        const double u = buffon_rng_next(&t->rng);
        cloud->u[i] = which < 3 ? edge[which] : u;
    }
}

/* What the rounding of point i is worth in its pdf: a normal of small spread far from 0 has few
 * points. The pdf is asked for on either side of each coordinate. */
static double verify_pdf_slack(const verify *t, const verify_cloud *cloud, size_t i,
                               buffon_status *status)
{
    const size_t dim = t->g->dim, n = 2 * (dim < VERIFY_DIM ? dim : VERIFY_DIM);
    double slack = 0, *x = t->other.x, *pdf = t->other.pdf;
    for (size_t d = 0; d < dim; d++) {
        const double middle = cloud->x[d * cloud->n + i];
        for (size_t k = 0; k < n; k++)
            x[d * n + k] =
                k / 2 == d ? middle * (1 + (k % 2 ? VERIFY_NOISE : -VERIFY_NOISE)) : middle;
    }
    *status = buffon_density_pdf(pdf, x, n, t->g);
    for (size_t k = 0; k < n && *status == BUFFON_OK; k++) {
        const double off = buffon_priv_abs(pdf[k] - t->again[i]);
        slack += off > 0 ? off : 0;
    }
    return slack;
}

/* POINTS and PDF of a cloud: 0 if there are points that no more can be asked of. */
static int verify_points(verify *t, const verify_cloud *cloud, buffon_status *status)
{
    const size_t n = cloud->n;
    int good = 1;
    for (size_t i = 0; i < n; i++) {
        int finite = !t->has_pdf || (cloud->pdf[i] > 0 && buffon_priv_isfinite(cloud->pdf[i]));
        for (size_t j = 0; j < t->g->dim; j++) {
            const double x = cloud->x[j * n + i];
            finite &= buffon_priv_isfinite(x);
            finite &= !t->how.discrete || buffon_priv_abs(x) >= 0x1p+52 || x == (double)(int64_t)x;
        }
        verify_see(t, BUFFON_VERIFY_POINTS, finite ? 0 : (double)INFINITY, cloud, i);
        good &= finite;
    }
    if (!good || !t->has_pdf)
        return good;
    *status = buffon_density_pdf(t->again, cloud->x, n, t->g);
    for (size_t i = 0; i < n && *status == BUFFON_OK; i++) {
        double allowed = t->how.tolerance * cloud->pdf[i];
        const double error = buffon_priv_abs(t->again[i] - cloud->pdf[i]);
        if (error > allowed)
            allowed += verify_pdf_slack(t, cloud, i, status);
        verify_see(t, BUFFON_VERIFY_PDF, error / allowed, cloud, i);
    }
    return *status == BUFFON_OK;
}

/* Median and half the distance of the quartiles of each coordinate. */
static void verify_measure(verify *t, const verify_cloud *cloud)
{
    const size_t n = cloud->n;
    for (size_t j = 0; j < t->g->dim && j < VERIFY_DIM; j++) {
        memcpy(t->again, cloud->x + j * n, n * sizeof *t->again);
        buffon_priv_sort(t->again, n);
        const double half = 0.5 * t->again[n - 1 - n / 4] - 0.5 * t->again[n / 4];
        const double range = t->again[n - 1] - t->again[0];
        t->middle[j] = t->again[n / 2];
        t->spread[j] = half > 0 ? half : range > 0 && range <= 0x1p+1000 ? range : 1;
    }
}

/* The size of rounding errors that a coordinate may have, where it is x. */
static double verify_size(const verify *t, size_t j, double x)
{
    return buffon_priv_abs(x) + (j < VERIFY_DIM ? t->spread[j] : 0);
}

/* ---- the map ---- */

/* What differences say of the map at a point: J[j][d] = dx_d / du_j with the error of each, and
 * whether the map is smooth there. */
typedef struct verify_map {
    double slope[VERIFY_DIM][VERIFY_DIM], error[VERIFY_DIM];
    int smooth;
} verify_map;

/* Points about point i for differences: itself, then for each uniform two steps on either side. */
static void verify_star(verify_cloud *star, const verify_cloud *cloud, size_t i, size_t uniforms)
{
    static const double step[4] = {-1, -0.5, 0.5, 1};
    star->n = 1 + 4 * uniforms;
    for (size_t j = 0; j < uniforms; j++) {
        const double u = cloud->u[j * cloud->n + i], h = VERIFY_SHORT * (u < 0.5 ? u : 1 - u);
        for (size_t k = 0; k < star->n; k++)
            star->u[j * star->n + k] = u;
        for (size_t k = 0; k < 4; k++)
            star->u[j * star->n + 1 + 4 * j + k] = u + step[k] * h;
    }
}

/* Central differences of both steps, extrapolated; their difference is the error. The differences
 * to the two sides differ by h f'': half as much at half the step, unless the map has a kink. */
static void verify_differences(verify_map *map, const verify *t, const verify_cloud *star)
{
    const size_t n = star->n, dim = t->g->dim, uniforms = t->g->uniforms;
    map->smooth = 1;
    for (size_t j = 0; j < uniforms; j++) {
        const double *u = star->u + j * n + 1 + 4 * j;
        const double far = u[3] - u[0], near = u[2] - u[1];
        double error = 0, length = 0;
        for (size_t d = 0; d < dim; d++) {
            const double *x = star->x + d * n + 1 + 4 * j, middle = star->x[d * n];
            const double wide = (x[3] - x[0]) / far, fine = (x[2] - x[1]) / near;
            const double bend = (x[3] - middle) - (middle - x[0]);
            const double bent = (x[2] - middle) - (middle - x[1]);
            const int moves = x[0] != middle || x[3] != middle;
            const double noise = moves ? VERIFY_NOISE * verify_size(t, d, middle) : 0;
            const double slope = fine + (fine - wide) / 3;
            map->slope[j][d] = slope;
            error += buffon_priv_abs(fine - wide) + noise / near;
            length += slope * slope;
            map->smooth &= buffon_priv_abs(bent) <= 0.4 * buffon_priv_abs(bend) + noise;
        }
        map->error[j] = error / sqrt(length);
        map->smooth &= map->error[j] <= 1e-3;
    }
}

/* Gram's matrix J J^T of the map as its Cholesky factor L; returns the product of L's diagonal, the
 * volume, or 0. */
static double verify_volume(double l[VERIFY_DIM][VERIFY_DIM], const verify_map *map,
                            const verify *t)
{
    const size_t n = t->g->uniforms;
    double volume = 1;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            double sum = 0;
            for (size_t d = 0; d < t->g->dim; d++)
                sum += map->slope[i][d] * map->slope[j][d];
            for (size_t k = 0; k < j; k++)
                sum -= l[i][k] * l[j][k];
            l[i][j] = i == j ? sqrt(sum) : sum / l[j][j];
        }
        volume *= l[i][i];
    }
    return volume > 0 && buffon_priv_isfinite(volume) ? volume : 0;
}

/* How far uniform j may be off that is found from a point whose coordinates are rounded: the rows
 * of the inverse map (J J^T)^-1 J, times the roundings. */
static void verify_slack(double slack[VERIFY_DIM], double l[VERIFY_DIM][VERIFY_DIM],
                         const verify_map *map, const verify *t, const double *x, size_t stride)
{
    const size_t n = t->g->uniforms;
    for (size_t j = 0; j < n; j++)
        slack[j] = 0;
    for (size_t d = 0; d < t->g->dim; d++) {
        double y[VERIFY_DIM];
        for (size_t i = 0; i < n; i++) {
            y[i] = map->slope[i][d];
            for (size_t k = 0; k < i; k++)
                y[i] -= l[i][k] * y[k];
            y[i] /= l[i][i];
        }
        for (size_t i = n; i-- > 0;) {
            for (size_t k = i + 1; k < n; k++)
                y[i] -= l[k][i] * y[k];
            y[i] /= l[i][i];
            slack[i] += buffon_priv_abs(y[i]) * VERIFY_ROUND * verify_size(t, d, x[d * stride]);
        }
    }
}

/* INVERSE at one point, whose uniforms the way back gave as v: near the true ones, or no further
 * off than rounding is worth; and they make the point again. */
static buffon_status verify_inverse(verify *t, const verify_cloud *cloud, size_t i, double *v,
                                    const double slack[VERIFY_DIM], const verify_map *map)
{
    const size_t n = cloud->n;
    double x[VERIFY_DIM], worst = 0;
    for (size_t j = 0; j < t->g->uniforms; j++) {
        const double u = cloud->u[j * n + i], off = buffon_priv_abs(v[j] - u);
        const double error =
            v[j] > 0 && v[j] < 1 ? off / (t->how.tolerance + slack[j]) : (double)INFINITY;
        worst = error > worst || error != error ? error : worst;
    }
    const buffon_status status = buffon_density_sample(x, NULL, v, 1, t->g);
    for (size_t d = 0; d < t->g->dim && status == BUFFON_OK; d++) {
        double allowed = t->how.tolerance * verify_size(t, d, cloud->x[d * n + i]);
        for (size_t j = 0; j < t->g->uniforms; j++)
            allowed += buffon_priv_abs(map->slope[j][d]) * (slack[j] + 0x1p-50);
        const double error = buffon_priv_abs(x[d] - cloud->x[d * n + i]) / allowed;
        worst = error > worst || error != error ? error : worst;
    }
    verify_see(t, BUFFON_VERIFY_INVERSE, worst, cloud, i);
    return status;
}

/* STRETCH and INVERSE, by differences at each point of a cloud. Half the points lie near 0 and 1 in
 * some uniform, at distances of all sizes. */
static buffon_status verify_stretch(verify *t)
{
    verify_cloud *cloud = &t->points, *star = &t->other;
    const size_t n = cloud->n = VERIFY_BATCH / 2, uniforms = t->g->uniforms;
    size_t smooth = 0;
    verify_uniforms(t, cloud, 0);
    for (size_t i = 0; i < n; i += 2) {
        double *u = cloud->u + buffon_rng_below(&t->rng, uniforms) * n + i;
        const double distance = buffon_priv_ldexp(*u, -(int)buffon_rng_below(&t->rng, 24));
        *u = i % 4 == 0 ? distance : 1 - distance;
    }
    buffon_status status = verify_sample(t, cloud);
    if (status == BUFFON_OK)
        status = buffon_density_invert(t->v, cloud->x, n, t->g);
    for (size_t i = 0; i < n && status == BUFFON_OK; i++) {
        double l[VERIFY_DIM][VERIFY_DIM], slack[VERIFY_DIM], v[VERIFY_DIM], error = 0;
        verify_map map;
        verify_star(star, cloud, i, uniforms);
        status = verify_sample(t, star);
        verify_differences(&map, t, star);
        const double volume = verify_volume(l, &map, t);
        if (!map.smooth || !(volume > 0) || status != BUFFON_OK)
            continue;
        for (size_t j = 0; j < uniforms; j++) {
            error += map.error[j];
            v[j] = t->v[j * n + i];
        }
        smooth++;
        if (t->has_pdf)
            verify_see(t, BUFFON_VERIFY_STRETCH,
                       buffon_priv_abs(cloud->pdf[i] * volume - 1) / (VERIFY_STRETCH + 4 * error),
                       cloud, i);
        verify_slack(slack, l, &map, t, cloud->x + i, n);
        status = verify_inverse(t, cloud, i, v, slack, &map);
    }
    if (smooth < n / 8)
        t->report->item[BUFFON_VERIFY_STRETCH].looked = 0;
    return status;
}

/* EVEN: the points of a run, taken back to uniforms, and counted in cells of the first axes. */
static buffon_status verify_even(verify *t)
{
    const size_t uniforms = t->g->uniforms, axes = uniforms < 3 ? uniforms : 3;
    const size_t shown = uniforms < VERIFY_AXES ? uniforms : VERIFY_AXES;
    const size_t side = axes == 1 ? 1024 : axes == 2 ? 32 : 10, samples = (size_t)t->how.samples;
    const size_t cells = axes == 1 ? side : axes == 2 ? side * side : side * side * side;
    memset(t->count, 0, cells * sizeof *t->count);
    for (size_t done = 0; done < samples;) {
        verify_cloud *cloud = &t->points;
        const size_t n = cloud->n = samples - done < VERIFY_BATCH ? samples - done : VERIFY_BATCH;
        verify_uniforms(t, cloud, 0);
        buffon_status status = verify_sample(t, cloud);
        if (status == BUFFON_OK)
            status = buffon_density_invert(t->v, cloud->x, n, t->g);
        if (status != BUFFON_OK)
            return status;
        for (size_t i = 0; i < n; i++, done++) {
            size_t cell = 0;
            for (size_t j = 0; j < axes; j++) {
                const double v = t->v[j * n + i];
                cell = cell * side + (v > 0 && v < 1 ? (size_t)(v * (double)side) : 0);
            }
            t->count[cell]++;
            for (size_t j = 0; j < shown; j++)
                t->even[j * samples + done] = t->v[j * n + i];
        }
    }
    density_fill(t->expected, (double)samples / (double)cells, cells);
    verify_judge(t, BUFFON_VERIFY_EVEN,
                 buffon_priv_p_cells(t->count, t->expected, t->expected, cells));
    for (size_t j = 0; j < shown; j++) {
        const double d = buffon_priv_kolmogorov(t->even + j * samples, samples);
        verify_judge(t, BUFFON_VERIFY_EVEN, buffon_priv_p_kolmogorov(d, (double)samples));
    }
    return BUFFON_OK;
}

/* ---- a density that covers the support ---- */

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
static void verify_cover(verify *t, const verify_cloud *cloud)
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
        status = verify_sample(t, near);
    for (size_t d = 0; d < dim && status == BUFFON_OK; d++) {
        const double *x = near->x + d * near->n;
        double allowed = (t->how.tolerance + VERIFY_ROUND) * verify_size(t, d, y[d]);
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
        verify_see(t, BUFFON_VERIFY_SUPPORT, worst, near, 0);
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
        verify_see(t, BUFFON_VERIFY_POINTS, ratio >= 0 && ratio <= 0x1p+1000 ? 0 : (double)INFINITY,
                   NULL, 0);
        cloud->pdf[i] = ratio;
    }
    return status;
}

/* The share of a cell from its ratios, and the variance of that. A cell with an edge or a peak in
 * it is not known well from so few: those are taken together, in *rest. */
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
        verify_uniforms(t, cloud, 0);
        buffon_status status = verify_sample(t, cloud);
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
    verify_judge(t, BUFFON_VERIFY_CELLS,
                 buffon_priv_p_cells(t->count, t->expected, t->variance, kept));
    const size_t coarse = verify_coarsen(t, kept);
    verify_judge(t, BUFFON_VERIFY_CELLS,
                 buffon_priv_p_cells(t->count, t->expected, t->variance, coarse));
}

/* SUPPORT, TOTAL and CELLS. Where the ratio of the pdfs has a heavy tail its mean says little, and
 * the latter two are left. */
static buffon_status verify_covered(verify *t)
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
    verify_judge(t, BUFFON_VERIFY_TOTAL, z < 40 ? buffon_priv_p_normal(z) : 0);
    status = verify_count(t, &grid);
    if (status == BUFFON_OK)
        verify_cells(t, &grid, known);
    return status;
}

/* ---- whole numbers ---- */

/* TOTAL and CELLS of a law on whole numbers: points are counted, and the probabilities from the
 * least point to the largest summed. What is not seen there was expected less than a few times in
 * all. */
static buffon_status verify_discrete(verify *t)
{
    const size_t samples = (size_t)t->how.samples;
    double total = 0, unseen = 0;
    size_t kept = 0;
    for (size_t done = 0; done < samples;) {
        verify_cloud *cloud = &t->points;
        cloud->n = samples - done < VERIFY_BATCH ? samples - done : VERIFY_BATCH;
        verify_uniforms(t, cloud, 0);
        const buffon_status status = verify_sample(t, cloud);
        if (status != BUFFON_OK)
            return status;
        memcpy(t->even + done, cloud->x, cloud->n * sizeof *cloud->x);
        done += cloud->n;
    }
    buffon_priv_sort(t->even, samples);
    const double least = t->even[0], range = t->even[samples - 1] - least;
    if (!(range < 0x1p+20))
        return BUFFON_OK;
    size_t next = 0;
    double count = 0, expected = 0;
    for (double from = least; from <= least + range; from += VERIFY_BATCH) {
        for (size_t i = 0; i < VERIFY_BATCH; i++)
            t->points.x[i] = from + (double)i;
        const buffon_status status = buffon_density_pdf(t->again, t->points.x, VERIFY_BATCH, t->g);
        if (status != BUFFON_OK)
            return status;
        for (size_t i = 0; i < VERIFY_BATCH && t->points.x[i] <= least + range; i++) {
            total += t->again[i];
            expected += (double)samples * t->again[i];
            for (; next < samples && t->even[next] == t->points.x[i]; next++)
                count++;
            if (expected >= 10 && kept + 2 < VERIFY_CELLS) {
                t->count[kept] = count;
                t->expected[kept++] = expected;
                count = expected = 0;
            }
        }
    }
    unseen = (double)samples * (1 - total);
    t->count[kept] = count;
    t->expected[kept++] = expected + (unseen > 0 ? unseen : 0);
    verify_judge(t, BUFFON_VERIFY_CELLS,
                 buffon_priv_p_cells(t->count, t->expected, t->expected, kept));
    verify_see(t, BUFFON_VERIFY_TOTAL, (total - 1) / t->how.tolerance, NULL, 0);
    verify_judge(t, BUFFON_VERIFY_TOTAL,
                 unseen < 1 ? 1 : buffon_priv_exp(-unseen) * (double)samples);
    return BUFFON_OK;
}

/* ---- the whole ---- */

static buffon_status verify_defaults(verify *t, const buffon_verification *how)
{
    const buffon_verification none = {.samples = 0};
    t->how = how != NULL ? *how : none;
    for (size_t k = 0; k < sizeof none.reserved / sizeof *none.reserved; k++)
        if (t->how.reserved[k] != 0)
            return BUFFON_E_RESERVED;
    t->how.samples = t->how.samples > 0 ? t->how.samples : (uint64_t)1 << 16;
    t->how.tolerance = t->how.tolerance != 0 ? t->how.tolerance : 1e-9;
    t->how.alpha = t->how.alpha != 0 ? t->how.alpha : 1e-6;
    if (t->how.samples < 1 << 10 || t->how.samples > 1 << 30)
        return BUFFON_E_SAMPLES;
    if (!(t->how.tolerance > 0 && t->how.tolerance < 1))
        return BUFFON_E_TOLERANCE;
    if (!(t->how.alpha > 0 && t->how.alpha < 1))
        return BUFFON_E_CONFIDENCE;
    const buffon_status status = buffon_density_check(t->g);
    if (status != BUFFON_OK || t->how.over == NULL)
        return status;
    if (t->how.over->status == BUFFON_OK && t->how.over->dim != t->g->dim)
        return BUFFON_E_DIM;
    return buffon_density_check(t->how.over);
}

/* One block of memory for all arrays. */
static buffon_status verify_allocate(verify *t)
{
    const size_t over = t->how.over != NULL ? t->how.over->uniforms : 0;
    const size_t dim = t->g->dim > 3 ? t->g->dim : 3;
    size_t uniforms = t->g->uniforms > over ? t->g->uniforms : over;
    uniforms = uniforms > dim ? uniforms : dim;
    const size_t shown = t->g->uniforms < VERIFY_AXES ? t->g->uniforms : VERIFY_AXES;
    if (uniforms > SIZE_MAX / sizeof(double) / VERIFY_BATCH / 16)
        return BUFFON_E_NOMEM;
    const size_t rows = VERIFY_BATCH * (3 * uniforms + 2 * dim + 3);
    const size_t all = rows + 3 * (VERIFY_CELLS + 1) + shown * (size_t)t->how.samples;
    double *at = t->memory = malloc(all * sizeof *at);
    if (at == NULL)
        return BUFFON_E_NOMEM;
    double **const array[] = {&t->points.u, &t->other.u,    &t->v,         &t->points.x,
                              &t->other.x,  &t->points.pdf, &t->other.pdf, &t->again,
                              &t->count,    &t->expected,   &t->variance,  &t->even};
    const size_t length[] = {VERIFY_BATCH * uniforms,
                             VERIFY_BATCH * uniforms,
                             VERIFY_BATCH * uniforms,
                             VERIFY_BATCH * dim,
                             VERIFY_BATCH * dim,
                             VERIFY_BATCH,
                             VERIFY_BATCH,
                             VERIFY_BATCH,
                             VERIFY_CELLS + 1,
                             VERIFY_CELLS + 1,
                             VERIFY_CELLS + 1,
                             0};
    for (size_t k = 0; k < sizeof array / sizeof *array; k++) {
        *array[k] = at;
        at += length[k];
    }
    return BUFFON_OK;
}

/* What the density can do, which it may learn from its parts: by asking, at one point. */
static buffon_status verify_probe(verify *t)
{
    const size_t dim = t->g->dim, uniforms = t->g->uniforms;
    density_fill(t->points.u, 0.5, uniforms);
    const buffon_status status = buffon_density_sample(t->points.x, NULL, t->points.u, 1, t->g);
    if (status != BUFFON_OK)
        return status;
    t->has_pdf = buffon_density_pdf(t->again, t->points.x, 1, t->g) != BUFFON_E_UNSUPPORTED;
    t->has_inverse = !t->how.discrete && dim <= VERIFY_DIM && uniforms <= VERIFY_DIM &&
                     buffon_density_invert(t->v, t->points.x, 1, t->g) != BUFFON_E_UNSUPPORTED;
    t->one_to_one = t->has_inverse && uniforms <= dim;
    return BUFFON_OK;
}

/* All checks, the exact ones first. Points that are none end it. */
static buffon_status verify_run(verify *t)
{
    verify_cloud *cloud = &t->points;
    buffon_status status = BUFFON_OK;
    for (int edges = 1; edges >= 0; edges--) {
        cloud->n = VERIFY_BATCH;
        verify_uniforms(t, cloud, edges);
        status = verify_sample(t, cloud);
        if (status != BUFFON_OK || !verify_points(t, cloud, &status))
            return status;
    }
    verify_measure(t, cloud);
    verify_cover(t, cloud);
    if (t->how.discrete)
        return t->has_pdf ? verify_discrete(t) : BUFFON_OK;
    if (t->one_to_one)
        status = verify_stretch(t);
    if (status == BUFFON_OK && t->over != NULL && t->has_pdf)
        status = verify_covered(t);
    if (status == BUFFON_OK && t->has_inverse)
        status = verify_even(t);
    return status;
}

/* Does a check apply to g at all? */
static int verify_applies(const verify *t, size_t check)
{
    switch (check) {
    case BUFFON_VERIFY_POINTS:
        return 1;
    case BUFFON_VERIFY_INVERSE:
        return t->one_to_one;
    case BUFFON_VERIFY_STRETCH:
        return t->one_to_one && t->has_pdf;
    case BUFFON_VERIFY_SUPPORT:
        return t->has_inverse && t->has_pdf;
    case BUFFON_VERIFY_EVEN:
        return t->has_inverse;
    default:
        return t->has_pdf;
    }
}

/* The verdict: statistics together, then the first check that failed. */
static buffon_status verify_conclude(verify *t)
{
    buffon_verify_report *report = t->report;
    const double statistics = 4 + (double)t->g->uniforms;
    buffon_status status = BUFFON_OK;
    for (size_t k = BUFFON_VERIFY_CHECKS; k-- > 0;) {
        buffon_verify_item *item = &report->item[k];
        const double p = statistics * item->p;
        report->p_value = p < report->p_value ? p : report->p_value;
        item->failed |= p < t->how.alpha;
        if (!item->looked && verify_applies(t, k) && status == BUFFON_OK)
            status = BUFFON_W_UNSEEN;
        if (item->failed) {
            status = BUFFON_E_LAW;
            if (report->check > (buffon_verify_check)k)
                report->check = (buffon_verify_check)k;
        }
    }
    return status;
}

buffon_status buffon_verify_density(buffon_verify_report *report, const buffon_density *g,
                                    const buffon_verification *how)
{
    verify t = {.g = g, .report = report};
    if (report == NULL)
        return BUFFON_E_NULL;
    *report = (buffon_verify_report){.check = BUFFON_VERIFY_CHECKS, .p_value = 1};
    density_fill(report->u, (double)NAN, BUFFON_VERIFY_UNIFORMS);
    density_fill(report->x, (double)NAN, BUFFON_VERIFY_UNIFORMS);
    for (size_t k = 0; k < BUFFON_VERIFY_CHECKS; k++)
        report->item[k].p = 1;
    buffon_status status = verify_defaults(&t, how);
    if (status == BUFFON_OK)
        status = verify_allocate(&t);
    if (status == BUFFON_OK) {
        t.rng = buffon_rng_make(t.how.seed, 0);
        status = verify_probe(&t);
    }
    if (status == BUFFON_OK)
        status = verify_run(&t);
    if (status == BUFFON_OK)
        status = verify_conclude(&t);
    free(t.memory);
    report->status = status;
    return status;
}

const char *buffon_verify_string(buffon_verify_check check)
{
    switch (check) {
#define VERIFY_TEXT(name, text)                                                                    \
    case name:                                                                                     \
        return text;
        BUFFON_VERIFY_LIST(VERIFY_TEXT)
#undef VERIFY_TEXT
    case BUFFON_VERIFY_CHECKS:
        return "nothing is wrong";
    }
    return "unknown check";
}
