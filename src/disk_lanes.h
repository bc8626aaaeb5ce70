/* Private. The kernels of disk.c: included by levels.h. The concentric map is that of ellipses too:
 * a disk has both half-axes equal. */

static void LANES(disk_polar)(double *x, double *y, const double *u1, const double *u2, size_t n,
                              double radius)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d s = lanes_sqrt(lanes_load(u1 + i, n - i));
        const lanes_d r = radius * lanes_min(lanes_all(CIRCLE_RIM), s);
        lanes_d cosine, sine;
        LANES(circle)(&cosine, &sine, lanes_load(u2 + i, n - i));
        lanes_store(x + i, cosine * r, n - i);
        lanes_store(y + i, sine * r, n - i);
    }
}

static void LANES(disk_concentric)(double *x, double *y, const double *u1, const double *u2,
                                   size_t n, double across, double up)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        lanes_d a, b;
        LANES(concentric)(&a, &b, lanes_load(u1 + i, n - i), lanes_load(u2 + i, n - i));
        lanes_store(x + i, a * across, n - i);
        lanes_store(y + i, b * up, n - i);
    }
}

/* r^2 grows from r0^2 as the area does. In units of r1^2 it is inner + width u, a sum of positives,
 * and no square leaves the doubles. */
static void LANES(disk_ring)(double *x, double *y, const double *u1, const double *u2, size_t n,
                             const double *param)
{
    const double radius = param[RING_RADIUS], inner = param[RING_INNER], width = param[RING_WIDTH];
    const double from = param[RING_FROM], turn = param[RING_TURN], rim = param[RING_RIM];
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d s = lanes_sqrt(inner + width * lanes_load(u1 + i, n - i));
        const lanes_d r = radius * lanes_min(lanes_all(rim), s);
        lanes_d cosine, sine;
        LANES(circle)(&cosine, &sine, from + turn * lanes_load(u2 + i, n - i));
        lanes_store(x + i, cosine * r, n - i);
        lanes_store(y + i, sine * r, n - i);
    }
}

static void LANES(disk_edge)(double *x, double *y, const double *u, size_t n, double radius)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        lanes_d cosine, sine;
        LANES(circle)(&cosine, &sine, lanes_load(u + i, n - i));
        lanes_store(x + i, cosine * radius, n - i);
        lanes_store(y + i, sine * radius, n - i);
    }
}
