/* Private. The kernel of hemisphere.c: included by levels.h. */

/* The radius on the disk below is |2 v - 1|, v the uniform further from 1/2. So the height is
 * sqrt(1 - (2 v - 1)^2) = 2 sqrt(v (1 - v)), which neither cancels nor vanishes. Row 3 of the
 * output is the density, where it is asked for; a frame of NULL leaves the axis at +z. */
LANES_INLINE void LANES(hemisphere_points)(double *const row[4], const double *u1, const double *u2,
                                           size_t n, const double *frame)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), v = lanes_load(u2 + i, n - i);
        lanes_d a, b, c = 2.0 * lanes_sqrt(lanes_min(u * (1.0 - u), v * (1.0 - v)));
        LANES(concentric)(&a, &b, u, v);
        if (row[3] != NULL)
            lanes_store(row[3] + i, DENSITY_INV_PI * c, n - i);
        if (frame != NULL)
            LANES(turn)(&a, &b, &c, frame);
        lanes_store(row[0] + i, a, n - i);
        lanes_store(row[1] + i, b, n - i);
        lanes_store(row[2] + i, c, n - i);
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
