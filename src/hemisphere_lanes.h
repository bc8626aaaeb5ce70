/* Private. The kernels of hemisphere.c: included by levels.h. */

/* The radius on the disk below is |2 v - 1|, v the uniform further from 1/2. So the height is
 * sqrt(1 - (2 v - 1)^2) = 2 sqrt(v (1 - v)), which neither cancels nor vanishes. Row 3 of the
 * output is the density, where it is asked for; a frame of NULL leaves the axis at +z. */
LANES_INLINE void LANES(hemisphere_points)(double *const row[4], const double *u1, const double *u2,
                                           size_t n, const double *frame)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), v = lanes_load(u2 + i, n - i);
        const lanes_d c = 2.0 * lanes_sqrt(lanes_min(u * (1.0 - u), v * (1.0 - v)));
        lanes_d a, b;
        LANES(concentric)(&a, &b, u, v);
        if (row[3] != NULL)
            lanes_store(row[3] + i, DENSITY_INV_PI * c, n - i);
        LANES(store_turned)(row, i, n, a, b, c, frame);
    }
}

static void LANES(hemisphere_map)(double *const row[4], const double *u1, const double *u2,
                                  size_t n, const double *param)
{
    if (frame_is_upright(param))
        LANES(hemisphere_points)(row, u1, u2, n, NULL);
    else
        LANES(hemisphere_points)(row, u1, u2, n, param);
}

/* c = (1 - u)^share, 1 - c with its own digits, share = 1 / (n + 1) in two parts. Near the horizon
 * the power would multiply the rounding of a logarithm by its size, 37. So the logarithm a is cut
 * in two, of which the first has 26 bits, like the first part of share: their product is exact, and
 * the exponential takes the rest by itself. */
LANES_INLINE lanes_d LANES(hemisphere_root)(lanes_d *less, lanes_d u, const double *param)
{
    lanes_d m, r;
    lanes_u e;
    const lanes_d k = LANES(log_split)(&m, 1.0 - u);
    const lanes_d f = lanes_pick(lanes_equal(k, lanes_all(0)), -u, m - 1.0);
    const lanes_d half = 0.5 * f * f, s = f / (2.0 + f);
    const lanes_d y = (half - (s * (half + LANES(log_rest)(s)) + k * LANES_LN2_LO)) - f;
    const lanes_d big = k * LANES_LN2_HI;
    const lanes_d top = lanes_double(lanes_bits(big - y) & ~UINT64_C(0x7ffffff));
    const lanes_d tail = (big - top) - y;
    const lanes_d low = top * param[LOBE_SHARE_LOW] + tail * param[LOBE_SHARE];
    const lanes_d rest = LANES(exp_core)(&r, &e, top * param[LOBE_SHARE_TOP], low);
    const lanes_d scale = LANES(power2)(e), begin = 1.0 - LANES(power2)(0 - e);
    const lanes_d sum = begin + r;
    *less = -(sum + ((r - (sum - begin)) + rest)) * scale;
    return (1.0 + (r + rest)) * scale;
}

/* Depth u below the pole: cos = (1 - u)^(1 / (n + 1)), and sin^2 = (1 - cos) (1 + cos). The pdf is
 * (n + 1) / (2 pi) cos^n, and cos^n = (1 - u) / cos. */
LANES_INLINE void LANES(hemisphere_powers)(double *const row[4], const double *u1, const double *u2,
                                           size_t n, const double *param, const double *frame)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i);
        lanes_d less, a, b;
        const lanes_d c = LANES(hemisphere_root)(&less, u, param);
        const lanes_d s = lanes_sqrt(less * (1.0 + c));
        if (row[3] != NULL)
            lanes_store(row[3] + i, param[LOBE_SCALE] * ((1.0 - u) / c), n - i);
        LANES(circle)(&a, &b, lanes_load(u2 + i, n - i));
        LANES(store_turned)(row, i, n, a * s, b * s, c, frame);
    }
}

static void LANES(hemisphere_power_map)(double *const row[4], const double *u1, const double *u2,
                                        size_t n, const double *param)
{
    if (frame_is_upright(param))
        LANES(hemisphere_powers)(row, u1, u2, n, param, NULL);
    else
        LANES(hemisphere_powers)(row, u1, u2, n, param, param);
}
