/* Statistics of numbers of your own: here a simulation. How many throws of a die until all six
 * faces have come up? The mean is 6 (1 + 1/2 + ... + 1/6) = 14.7.
 *
 * buffon_stats keeps sums as whole numbers that lose nothing. So samples gathered apart, in any
 * order, merge to the same bits as one. */
#include <stdio.h>

#include <buffon/buffon.h>

enum { GAMES = 200000, TABLES = 4 };

static double play(buffon_rng *rng)
{
    unsigned seen = 0, throws = 0;
    while (seen != 63) {
        seen |= 1u << buffon_rng_below(rng, 6);
        throws++;
    }
    return throws;
}

int main(void)
{
    buffon_stats table[TABLES] = {{0}}, all = {0}, merged = {0};
    for (size_t t = 0; t < TABLES; t++) {
        buffon_rng rng = buffon_rng_make(6, t); /* each table has a stream of its own */
        for (size_t i = 0; i < GAMES / TABLES; i++) {
            const double throws = play(&rng);
            buffon_stats_add(&table[t], &throws, 1);
            buffon_stats_add(&all, &throws, 1);
        }
    }
    for (size_t t = TABLES; t-- > 0;) /* backwards, for once */
        buffon_stats_merge(&merged, &table[t]);

    const buffon_summary a = buffon_stats_summary(&all), b = buffon_stats_summary(&merged);
    printf("%llu games, from %g to %g throws, variance %.3f (exactly 38.99)\n",
           (unsigned long long)a.count, a.min, a.max, a.variance);

    buffon_estimate e;
    const buffon_status s = buffon_stats_estimate(&e, &merged, 0.95);
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    printf("mean %.4f +- %.4f, 95 %% in [%.4f, %.4f], exactly 14.7 (%s)\n", e.value, e.std_error,
           e.lo, e.hi, buffon_status_string(s));
    const int same = a.mean == b.mean && a.variance == b.variance;
    printf("merged from %d tables: %s bits\n", TABLES, same ? "the same" : "different");
    return !same;
}
