/* Private. The kernels of normal.c: included by levels.h. */

/* exp(-z^2 / 2) scale for |z| < 40, from where on it is 0. z^2 is a square that is exact, of a
 * number of 26 bits, and a small rest, whose exponential is a short sum. */
LANES_INLINE lanes_d LANES(normal_bell)(lanes_d z, double scale)
{
    const lanes_d size = lanes_abs(z);
    const lanes_d a = lanes_min(lanes_all(40), size);
    const lanes_d high = lanes_double(lanes_bits(a) & UINT64_C(0xfffffffff8000000));
    const lanes_d rest = 0.5 * (a - high) * (a + high);
    const lanes_d factor = 1.0 - rest * (1.0 - rest * (0.5 - rest * 0x1.5555555555555p-3));
    const lanes_d bell = LANES(exp)(-0.5 * high * high) * factor * scale;
    return lanes_pick(lanes_less(size, lanes_all(40)), bell, lanes_all(0));
}

/* From standard normals in x: points and, unless it is NULL, the pdf. */
static void LANES(normal_map)(double *x, double *pdf, size_t n, double mean, double sd)
{
    const double scale = NORMAL_INV_SQRT_2PI / sd;
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d z = lanes_load(x + i, n - i);
        lanes_store(x + i, mean + sd * z, n - i);
        if (pdf != NULL)
            lanes_store(pdf + i, LANES(normal_bell)(z, scale), n - i);
    }
}

static void LANES(normal_at)(double *pdf, const double *x, size_t n, double mean, double sd)
{
    const double scale = NORMAL_INV_SQRT_2PI / sd;
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d z = (lanes_load(x + i, n - i) - mean) / sd;
        lanes_store(pdf + i, LANES(normal_bell)(z, scale), n - i);
    }
}
