/* Private. The kernel of cap.c: included by levels.h. */

/* A zone, of which a cap is one from depth 0. With w = 1 - z from h0 to h0 + h = h1, w = h0 + h u
 * and 2 - w = (2 - h1) + h (1 - u): products and sums of positives, right to the last digits from
 * the smallest cap to the whole sphere. w is kept in units of h1, where it is u for a cap, and its
 * root apart: products of the smallest heights would leave the doubles. */
LANES_INLINE void LANES(cap_points)(double *const row[3], const double *u1, const double *u2,
                                    size_t n, const double *zone, const double *frame)
{
    const double h = zone[ZONE_HEIGHT], h1 = zone[ZONE_DEPTH], rest = zone[ZONE_REST];
    const double first = zone[ZONE_FIRST] / h1, width = h / h1, root = sqrt(h1);
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), w = first + width * u;
        const lanes_d s = root * lanes_sqrt(w * (rest + h * (1.0 - u)));
        lanes_d a, b;
        LANES(circle)(&a, &b, lanes_load(u2 + i, n - i));
        LANES(store_turned)(row, i, n, a * s, b * s, 1.0 - h1 * w, frame);
    }
}

static void LANES(cap_map)(double *const row[3], const double *u1, const double *u2, size_t n,
                           const double *param, const double *zone)
{
    if (frame_is_upright(param))
        LANES(cap_points)(row, u1, u2, n, zone, NULL);
    else
        LANES(cap_points)(row, u1, u2, n, zone, param);
}
