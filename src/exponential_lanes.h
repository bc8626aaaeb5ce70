/* Private. The kernels of exponential.c: included by levels.h. */

/* The pdf is (1 - u) / mean. Where it is not wanted it is NULL. */
static void LANES(exponential_map)(double *x, double *pdf, const double *u, size_t n, double mean)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d v = lanes_load(u + i, n - i);
        lanes_store(x + i, -mean * LANES(log1p)(-v), n - i);
        if (pdf != NULL)
            lanes_store(pdf + i, (1.0 - v) / mean, n - i);
    }
}

static void LANES(exponential_at)(double *pdf, const double *x, size_t n, double mean)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d v = lanes_load(x + i, n - i), g = LANES(exp)(-v / mean) / mean;
        const lanes_m inside = lanes_less_equal(lanes_all(0), v);
        lanes_store(pdf + i, lanes_pick(inside, g, lanes_all(0)), n - i);
    }
}

static void LANES(exponential_level)(double *u, const double *x, size_t n, double mean)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH)
        lanes_store(u + i, -LANES(expm1)(-lanes_load(x + i, n - i) / mean), n - i);
}
