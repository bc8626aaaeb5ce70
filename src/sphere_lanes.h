/* Private. The kernel of sphere.c: included by levels.h. */

/* 1 - z^2 = 4 u (1 - u): a product of positives, where 1 - z * z would cancel at the poles. */
static void LANES(sphere_map)(double *x, double *y, double *z, const double *u1, const double *u2,
                              size_t n)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), s = 2.0 * lanes_sqrt(u * (1.0 - u));
        lanes_d cosine, sine;
        LANES(circle)(&cosine, &sine, lanes_load(u2 + i, n - i));
        lanes_store(x + i, cosine * s, n - i);
        lanes_store(y + i, sine * s, n - i);
        lanes_store(z + i, 1.0 - 2.0 * u, n - i);
    }
}
