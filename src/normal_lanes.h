/* Private. The kernels of normal.c: included by levels.h. */

/* exp(-z^2 / 2) scale for |z| < 40, beyond which it is 0. */
LANES_INLINE lanes_d LANES(normal_bell)(lanes_d z, double scale)
{
    const lanes_d a = lanes_min(lanes_all(40), lanes_abs(z));
    lanes_d low, r, bell;
    lanes_u k;
    const lanes_d high = LANES(square)(&low, a);
    const lanes_d rest = LANES(exp_core)(&r, &k, -0.5 * high, -0.5 * low);
    bell = LANES(scale)((1.0 + (r + rest)) * scale, k);
    return lanes_pick(lanes_less(a, lanes_all(40)), bell, lanes_all(0));
}

/* From standard normals in x: points and, unless it is NULL, the pdf. */
static void LANES(normal_map)(double *x, double *pdf, size_t n, double mean, double sd)
{
    const double scale = DENSITY_INV_SQRT_2PI / sd;
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d z = lanes_load(x + i, n - i);
        lanes_store(x + i, mean + sd * z, n - i);
        if (pdf != NULL)
            lanes_store(pdf + i, LANES(normal_bell)(z, scale), n - i);
    }
}

static void LANES(normal_at)(double *pdf, const double *x, size_t n, double mean, double sd)
{
    const double scale = DENSITY_INV_SQRT_2PI / sd;
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d z = (lanes_load(x + i, n - i) - mean) / sd;
        lanes_store(pdf + i, LANES(normal_bell)(z, scale), n - i);
    }
}
