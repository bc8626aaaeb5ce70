/* Private. The kernels of directional.c: included by levels.h. */

/* The point at depth w = 1 - z below the axis, where `rest` is 2 - w: each keeps its digits near
 * its pole. `frame` NULL leaves the axis at +z. */
LANES_INLINE void LANES(directional_place)(double *const row[4], size_t i, size_t n, lanes_d w,
                                           lanes_d rest, lanes_d turns, const double *frame)
{
    const lanes_d s = lanes_sqrt(w * rest);
    lanes_d a, b, c = lanes_pick(lanes_less(w, rest), 1.0 - w, rest - 1.0);
    LANES(circle)(&a, &b, turns);
    a *= s;
    b *= s;
    if (frame != NULL)
        LANES(turn)(&a, &b, &c, frame);
    lanes_store(row[0] + i, a, n - i);
    lanes_store(row[1] + i, b, n - i);
    lanes_store(row[2] + i, c, n - i);
}

LANES_INLINE void LANES(scatter_points)(double *const row[4], const double *u1, const double *u2,
                                        size_t n, const double *param, const double *frame)
{
    const double a = param[SCATTER_BACK], b = param[SCATTER_FRONT], a2 = a * a, b2 = b * b;
    const double top = param[SCATTER_TOP];
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), v = 1.0 - u;
        const lanes_d d = a * u + b * v, scale = 2.0 / (d * d);
        const lanes_d w = scale * (u * a2 * (b * v + u));
        const lanes_d rest = scale * (v * b2 * (a * u + v));
        if (row[3] != NULL)
            lanes_store(row[3] + i, top * (d * d * d), n - i);
        LANES(directional_place)(row, i, n, w, rest, lanes_load(u2 + i, n - i), frame);
    }
}

static void LANES(scatter_map)(double *const row[4], const double *u1, const double *u2, size_t n,
                               const double *param)
{
    if (frame_is_upright(param))
        LANES(scatter_points)(row, u1, u2, n, param, NULL);
    else
        LANES(scatter_points)(row, u1, u2, n, param, param);
}

/* log(1 + t) where 1 + t >= 1/2, and log(y) where it is less: there y, which is the same number,
 * is known better than t. About 1 the sum 1 + t is not used at all, see log1p of lanes_math.h. */
LANES_INLINE lanes_d LANES(fisher_log)(lanes_d t, lanes_d y)
{
    const lanes_d one = 1.0 + t, zero = lanes_all(0);
    lanes_d m, k;
    k = LANES(log_split)(&m, lanes_pick(lanes_less_equal(lanes_all(0.5), one), one, y));
    return LANES(log_core)(k, lanes_pick(lanes_equal(k, zero), t, m - 1.0), zero);
}

LANES_INLINE void LANES(fisher_points)(double *const row[4], const double *u1, const double *u2,
                                       size_t n, const double *param, const double *frame)
{
    const double kappa = param[FISHER_KAPPA], top = param[FISHER_TOP], spread = 1 / kappa;
    const double far = param[FISHER_FAR], edge = param[FISHER_EDGE];
    const double front = param[FISHER_FRONT], back = param[FISHER_BACK];
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), v = 1.0 - u, y = v + far * u;
        lanes_d w = 2.0 * u, rest = 2.0 * v;
        if (kappa > 0) {
            const lanes_m behind = lanes_less(v, lanes_all(edge));
            const lanes_d t = lanes_pick(behind, back * v, front * u);
            const lanes_d from = lanes_abs(LANES(fisher_log)(t, y)) * spread;
            w = lanes_pick(behind, 2.0 - from, from);
            rest = lanes_pick(behind, from, 2.0 - from);
        }
        if (row[3] != NULL)
            lanes_store(row[3] + i, top * y, n - i);
        LANES(directional_place)(row, i, n, w, rest, lanes_load(u2 + i, n - i), frame);
    }
}

static void LANES(fisher_map)(double *const row[4], const double *u1, const double *u2, size_t n,
                              const double *param)
{
    if (frame_is_upright(param))
        LANES(fisher_points)(row, u1, u2, n, param, NULL);
    else
        LANES(fisher_points)(row, u1, u2, n, param, param);
}
