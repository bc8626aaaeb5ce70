/* Private. The kernels of disk.c: included by levels.h. */

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
                                   size_t n, double radius)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        lanes_d a, b;
        LANES(concentric)(&a, &b, lanes_load(u1 + i, n - i), lanes_load(u2 + i, n - i));
        lanes_store(x + i, a * radius, n - i);
        lanes_store(y + i, b * radius, n - i);
    }
}
