/* Private. The kernel of weigh.c: included by levels.h. */

/* y = f / pdf, and the number of points up to the first vector in which a pdf is not a normal
 * number, which plain division does not do. */
static void LANES(weigh_divide)(size_t *done, double *y, const double *f, const double *pdf,
                                size_t n)
{
    size_t i = 0;
    for (; i < n; i += LANES_WIDTH) {
        const lanes_d g = lanes_load(pdf + i, n - i);
        const lanes_m normal =
            lanes_and(lanes_less(lanes_all(0x1p-1022), g), lanes_less(g, lanes_all(LANES_INF)));
        if (!lanes_every(normal))
            break;
        lanes_store(y + i, lanes_load(f + i, n - i) / g, n - i);
    }
    *done = i < n ? i : n;
}
