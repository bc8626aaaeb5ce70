/* Private. The kernel of cap_cosine.c: included by levels.h. */

/* A cap above the horizon. A point q of its base, c along the axis and s (p, q) across, is lifted
 * by `rise` along the normal to the sphere: rise^2 + 2 rise q.n = 1 - |q|^2, which is s^2 (1 - p.p)
 * and 4 v (1 - v) of it, v the uniform further from 1/2 (see hemisphere_points). So the cosine is
 * sqrt((q.n)^2 + 1 - |q|^2), and q.n that of the lowest point of the rim and a positive rest:
 * nothing cancels. */
static void LANES(cap_cosine_map)(double *const row[4], const double *u1, const double *u2,
                                  size_t n, const double *param)
{
    const double s = param[CAP_COSINE_SINE], c = param[CAP_COSINE_COSINE];
    const double sb = param[CAP_COSINE_UP], cb = param[CAP_COSINE_ACROSS];
    const double lowest = param[CAP_COSINE_LOWEST], scale = 1 / param[CAP_COSINE_TOTAL];
    const int level = param[CAP_COSINE_REACH] < 0;
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), v = lanes_load(u2 + i, n - i);
        const lanes_d off = s * s * 4.0 * lanes_min(u * (1.0 - u), v * (1.0 - v));
        lanes_d p, q;
        LANES(concentric)(&p, &q, u, v);
        const lanes_d flat = lowest + s * cb * (1.0 + p);
        const lanes_d cosine = lanes_sqrt(flat * flat + off), rise = off / (flat + cosine);
        const lanes_d across = level ? c * cb - s * sb * p : s * p + cb * rise, side = s * q;
        lanes_d along = cosine;
        if (!level)
            along = 1.0 - (across * across + side * side) / (1.0 + (c + sb * rise));
        if (row[3] != NULL)
            lanes_store(row[3] + i, scale * cosine, n - i);
        LANES(store_turned)(row, i, n, across, side, along, param);
    }
}
