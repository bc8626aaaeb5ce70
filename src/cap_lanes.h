/* Private. The kernel of cap.c: included by levels.h. */

/* With w = 1 - z = h u: 1 - z^2 = w (2 - w) and 2 - w = (2 - h) + h (1 - u), products and sums of
 * positives, right to the last digits from the smallest cap to the whole sphere. */
LANES_INLINE void LANES(cap_points)(double *x, double *y, double *z, const double *u1,
                                    const double *u2, size_t n, const double *param, int turned)
{
    const double h = param[CAP_HEIGHT], rest = param[CAP_REST], root = sqrt(h);
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i);
        const lanes_d s = root * lanes_sqrt(u * (rest + h * (1.0 - u)));
        lanes_d a, b, c = 1.0 - h * u;
        LANES(circle)(&a, &b, lanes_load(u2 + i, n - i));
        a *= s;
        b *= s;
        if (turned)
            LANES(turn)(&a, &b, &c, param);
        lanes_store(x + i, a, n - i);
        lanes_store(y + i, b, n - i);
        lanes_store(z + i, c, n - i);
    }
}

static void LANES(cap_map)(double *x, double *y, double *z, const double *u1, const double *u2,
                           size_t n, const double *param)
{
    if (frame_is_upright(param))
        LANES(cap_points)(x, y, z, u1, u2, n, param, 0);
    else
        LANES(cap_points)(x, y, z, u1, u2, n, param, 1);
}
