/* Private. The kernels of flat.c: included by levels.h. */

/* From the unit cube to the standard simplex by the tails S_j = w_j + w_(j+1) + ...: they are the
 * order statistics of dim uniform numbers, with t_j = u_j^(1/k), k = dim, dim - 1, ... 1 in turn,
 *
 *     S_1 = t_1,   S_(j+1) = S_j t_(j+1),   w_j = S_j (1 - t_(j+1)),   w_dim = S_dim.
 *
 * Here k = 3, 2 and 1, by roots; 1 - t = (1 - u) / (1 + t + ... + t^(k-1)), where nothing cancels.
 * `tail` is what goes before. */
LANES_INLINE void LANES(flat_share2)(lanes_d w[2], lanes_d tail, lanes_d u)
{
    w[0] = tail * (1.0 - u);
    w[1] = tail * u;
}

LANES_INLINE void LANES(flat_share3)(lanes_d w[3], lanes_d tail, lanes_d u1, lanes_d u2)
{
    const lanes_d t = lanes_sqrt(u1);
    w[0] = tail * ((1.0 - u1) / (1.0 + t));
    LANES(flat_share2)(w + 1, tail * t, u2);
}

/* x = origin + the weighted sum of the edges. */
LANES_INLINE void LANES(flat_points)(double *x, const double *u, size_t n, const double *param,
                                     size_t dim, size_t edges, flat_kind kind)
{
    const double *origin = param, *e = param + FLAT_EDGES;
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        lanes_d w[3];
        for (size_t k = 0; k < edges; k++)
            w[k] = lanes_load(u + k * n + i, n - i);
        if (kind == FLAT_SIMPLEX && edges == 2)
            LANES(flat_share2)(w, lanes_sqrt(w[0]), w[1]);
        if (kind == FLAT_SIMPLEX && edges == 3)
            LANES(flat_share3)(w, LANES(cbrt)(w[0]), w[1], w[2]);
        for (size_t j = 0; j < dim; j++) {
            lanes_d y = origin[j] + w[0] * e[j];
            for (size_t k = 1; k < edges; k++)
                y += w[k] * e[3 * k + j];
            lanes_store(x + j * n + i, y, n - i);
        }
    }
}

static void LANES(flat_map)(double *x, const double *u, size_t n, const double *param, size_t dim,
                            size_t edges, flat_kind kind)
{
    if (edges == 1)
        LANES(flat_points)(x, u, n, param, 3, 1, FLAT_SIMPLEX);
    else if (edges == 2 && dim == 2 && kind == FLAT_SIMPLEX)
        LANES(flat_points)(x, u, n, param, 2, 2, FLAT_SIMPLEX);
    else if (edges == 2 && kind == FLAT_SIMPLEX)
        LANES(flat_points)(x, u, n, param, 3, 2, FLAT_SIMPLEX);
    else if (edges == 2)
        LANES(flat_points)(x, u, n, param, 3, 2, FLAT_BOX);
    else if (kind == FLAT_SIMPLEX)
        LANES(flat_points)(x, u, n, param, 3, 3, FLAT_SIMPLEX);
    else
        LANES(flat_points)(x, u, n, param, 3, 3, FLAT_BOX);
}

/* The last `count` coordinates, up to three, from as many uniforms; `tail` is NULL where they are
 * all, and else what goes before, for the coordinate before them too. It may be where the last
 * coordinate will be. */
static void LANES(flat_last)(double *w, const double *u, size_t n, size_t count, const double *tail)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d zero = lanes_all(0);
        lanes_d v[3] = {zero, zero, zero}, part[3];
        for (size_t k = 0; k < count; k++)
            v[k] = lanes_load(u + k * n + i, n - i);
        if (count == 1) {
            part[0] = v[0];
        } else if (count == 2) {
            LANES(flat_share2)(part, lanes_sqrt(v[0]), v[1]);
        } else {
            lanes_d t = LANES(cbrt)(v[0]);
            if (tail) {
                const lanes_d rest = lanes_load(tail + i, n - i);
                lanes_store(w + i - n, rest * ((1.0 - v[0]) / (1.0 + t + t * t)), n - i);
                t *= rest;
            }
            LANES(flat_share3)(part, t, v[1], v[2]);
        }
        for (size_t k = 0; k < count; k++)
            lanes_store(w + k * n + i, part[k], n - i);
    }
}
