/* Private. The kernel of stats.c: included by levels.h. */

/* Keeps the largest of the |y[n]|. Few values pass the bar once a list is full, so a vector is
 * looked at one by one only where a lane does. */
static void LANES(stats_top)(double *top, const double *y, size_t n)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d size = lanes_abs(lanes_load(y + i, n - i));
        if (!lanes_any(lanes_less(lanes_all(top[BUFFON_STATS_TOP - 1]), size)))
            continue;
        for (size_t k = i; k < n && k < i + LANES_WIDTH; k++)
            stats_top_insert(top, buffon_priv_abs(y[k]));
    }
}
