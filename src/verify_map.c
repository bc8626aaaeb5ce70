/* The map of a density by differences: how it stretches, and whether the way back leads back. */
#include "guard.h"

#include <math.h>

#include "elementary.h"
#include "verify_priv.h"

#define VERIFY_SHORT 0x1p-10 /* a difference, of the distance to 0 or 1 */
#define VERIFY_STRETCH 1e-6  /* by which the volume may be off, beside the error of differences */

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
            const double noise = moves ? VERIFY_NOISE * buffon_priv_verify_size(t, d, middle) : 0;
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
            slack[i] +=
                buffon_priv_abs(y[i]) * VERIFY_ROUND * buffon_priv_verify_size(t, d, x[d * stride]);
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
        double allowed = t->how.tolerance * buffon_priv_verify_size(t, d, cloud->x[d * n + i]);
        for (size_t j = 0; j < t->g->uniforms; j++)
            allowed += buffon_priv_abs(map->slope[j][d]) * (slack[j] + 0x1p-50);
        const double error = buffon_priv_abs(x[d] - cloud->x[d * n + i]) / allowed;
        worst = error > worst || error != error ? error : worst;
    }
    buffon_priv_verify_see(t, BUFFON_VERIFY_INVERSE, worst, cloud, i);
    return status;
}

/* STRETCH and INVERSE, by differences at each point of a cloud. Half the points lie near 0 and 1 in
 * some uniform, at distances of all sizes. */
buffon_status buffon_priv_verify_stretch(verify *t)
{
    verify_cloud *cloud = &t->points, *star = &t->other;
    const size_t n = cloud->n = VERIFY_BATCH / 2, uniforms = t->g->uniforms;
    size_t smooth = 0;
    buffon_priv_verify_uniforms(t, cloud, 0);
    for (size_t i = 0; i < n; i += 2) {
        double *u = cloud->u + buffon_rng_below(&t->rng, uniforms) * n + i;
        const double distance = buffon_priv_ldexp(*u, -(int)buffon_rng_below(&t->rng, 24));
        *u = i % 4 == 0 ? distance : 1 - distance;
    }
    buffon_status status = buffon_priv_verify_sample(t, cloud);
    if (status == BUFFON_OK)
        status = buffon_density_invert(t->v, cloud->x, n, t->g);
    for (size_t i = 0; i < n && status == BUFFON_OK; i++) {
        double l[VERIFY_DIM][VERIFY_DIM], slack[VERIFY_DIM], v[VERIFY_DIM], error = 0;
        verify_map map;
        verify_star(star, cloud, i, uniforms);
        status = buffon_priv_verify_sample(t, star);
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
            buffon_priv_verify_see(t, BUFFON_VERIFY_STRETCH,
                                   buffon_priv_abs(cloud->pdf[i] * volume - 1) /
                                       (VERIFY_STRETCH + 4 * error),
                                   cloud, i);
        verify_slack(slack, l, &map, t, cloud->x + i, n);
        status = verify_inverse(t, cloud, i, v, slack, &map);
    }
    if (smooth < n / 8)
        t->report->item[BUFFON_VERIFY_STRETCH].looked = 0;
    return status;
}
