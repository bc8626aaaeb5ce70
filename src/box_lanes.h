/* Private. The kernel of box.c: included by levels.h. */

/* lo + u width, held between `least` and `most`. */
static void LANES(box_map)(double *x, const double *u, size_t n, double lo, double width,
                           double least, double most)
{
    const lanes_d low = lanes_all(least), high = lanes_all(most);
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d v = lo + lanes_load(u + i, n - i) * width;
        lanes_store(x + i, lanes_min(high, lanes_max(low, v)), n - i);
    }
}
