/* The tail index k-hat: values computed apart from these sources, and samples of known index. */
#include "samples.h"

/* Zhang and Stephens' estimate with the prior of Vehtari et al., computed apart from these sources
 * from the formulas of the papers. */
static void test_tail_values(void)
{
    double top[5][BUFFON_STATS_TOP];
    static const double expected[] = {-0.7466923996334539, 0.8228092140114632, 11.42564289291079,
                                      1.608165840475453, -0.6361999899446521};
    for (int i = 0; i < BUFFON_STATS_TOP; i++) {
        top[0][i] = 64.0 - i;
        top[1][i] = 64.0 / (i + 1);
        top[2][i] = ldexp(1.0, -i);
        top[3][i] = top[1][i] * top[1][i];
        top[4][i] = i < 40 ? 40.0 - i : 0.0;
    }
    for (int k = 0; k < 5; k++) {
        double got = buffon_priv_tail_index(top[k], 1000);
        tap_ok(close_to(got, expected[k], 1e-12), "k-hat of tail %d", k);
        for (int i = 0; i < BUFFON_STATS_TOP; i++)
            top[k][i] = ldexp(top[k][i], 950);
        tap_ok(buffon_priv_tail_index(top[k], 320) == got, "and of 2^950 times it");
    }
    tap_ok(isnan(buffon_priv_tail_index(top[0], 319)), "NaN below 320 values");
    for (int i = 0; i < BUFFON_STATS_TOP; i++)
        top[0][i] = i < 32 ? 3.0 + i % 2 : 1.0;
    qsort(top[0], BUFFON_STATS_TOP, sizeof(double), falling);
    tap_ok(isfinite(buffon_priv_tail_index(top[0], 320)), "32 values above the rest are enough");
    top[0][31] = 1.0;
    tap_ok(isnan(buffon_priv_tail_index(top[0], 320)), "31 are not");
    for (int i = 0; i < BUFFON_STATS_TOP; i++)
        top[0][i] = 1.0;
    tap_ok(isnan(buffon_priv_tail_index(top[0], 1000)), "NaN for a tail without spread");
    for (int i = 0; i < BUFFON_STATS_TOP; i++)
        top[0][i] = ldexp(1.0, 1000 - 32 * i);
    tap_ok(buffon_priv_tail_index(top[0], 1000) > 50.0, "a tail over 2000 powers of two is heavy");
}

/* Generalised Pareto samples of index k: so are their tails. The mean of k-hat over replicates is
 * (63 k + 5) / 73 but for a small bias. The likelihood gives its standard deviation as 63 / 73 of
 * (1 + k) / sqrt(63) for k > -1/2; at -1/2 it is larger. */
static void test_tail_samples(void)
{
    static const double shapes[] = {-0.5, 0.0, 0.5, 1.0, 2.0};
    enum { REPLICATES = 400, SIZE = 3000 };
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        double k = shapes[s], sum = 0.0, squares = 0.0;
        for (int r = 0; r < REPLICATES; r++) {
            for (size_t i = 0; i < SIZE; i++) {
                double u = random_unit(), x = k == 0.0 ? -log(u) : (pow(u, -k) - 1.0) / k;
                data[i] = i % 2 ? x : -x;
            }
            buffon_stats sample = add_all(data, SIZE);
            double got = buffon_stats_summary(&sample).tail_index;
            sum += got;
            squares += got * got;
        }
        double mean = sum / REPLICATES, sd = sqrt(squares / REPLICATES - mean * mean);
        double expected = (63.0 * k + 5.0) / 73.0;
        double scatter = (1.0 + k) / sqrt(63.0) * 63.0 / 73.0 * (k == -0.5 ? 2.0 : 1.0);
        tap_note("k = %g: mean %.4f, expected %.4f; sd %.4f, asymptotically %.4f", k, mean,
                 expected, sd, scatter);
        tap_ok(fabs(mean - expected) < 6.0 * scatter / sqrt(REPLICATES) + 0.02 &&
                   sd < 1.25 * scatter && sd > 0.75 * scatter,
               "k-hat of 400 samples with k = %g", k);
    }
}

int main(void)
{
    test_tail_values();
    test_tail_samples();
    return tap_done();
}
