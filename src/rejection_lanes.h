/* Private. The kernel of rejection.c: included by levels.h. */

/* y = 1 where v top is below scale f, else 0; *fits is 0 if a value is not in 0 .. height. */
static void LANES(rejection_hits)(int *fits, double *y, const double *f, const double *v, size_t n,
                                  double height, double scale)
{
    const lanes_d zero = lanes_all(0), one = lanes_all(1), top = lanes_all(scale * height);
    lanes_m inside = lanes_equal(zero, zero);
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d value = lanes_load(f + i, n - i);
        const lanes_m hit = lanes_less(lanes_load(v + i, n - i) * top, scale * value);
        lanes_store(y + i, lanes_pick(hit, one, zero), n - i);
        inside = lanes_and(inside, lanes_and(lanes_less_equal(zero, value),
                                             lanes_less_equal(value, lanes_all(height))));
    }
    *fits = lanes_every(inside);
}
