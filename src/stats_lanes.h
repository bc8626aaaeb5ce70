/* Private. The kernel of stats.c: included by levels.h. */

/* Keeps the largest of the |y[n]|. Few values pass the bar once a list is full, so those of a row
 * are looked at one by one only where the largest does. */
static void LANES(stats_top)(double *top, const double *y, size_t n)
{
    size_t i = 0;
    for (; i + STATS_ROW <= n; i += STATS_ROW) {
        lanes_d most = lanes_all(0);
        for (size_t k = i; k < i + STATS_ROW; k += LANES_WIDTH)
            most = lanes_max(most, lanes_abs(lanes_load(y + k, LANES_WIDTH)));
        if (!lanes_any(lanes_less(lanes_all(top[BUFFON_STATS_TOP - 1]), most)))
            continue;
        for (size_t k = i; k < i + STATS_ROW; k++)
            stats_top_insert(top, buffon_priv_abs(y[k]));
    }
    for (; i < n; i++)
        stats_top_insert(top, buffon_priv_abs(y[i]));
}
