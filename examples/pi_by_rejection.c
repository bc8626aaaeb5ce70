/* The rejection method: points (x, y), uniform on a box times [0, h], are under the curve of f in
 * proportion to its integral:
 *
 *     int f ~ (hits / N) h volume.
 *
 * The hits are binomial, so the interval is Clopper and Pearson's, which covers at least as often
 * as stated however few they are. The bound h must hold: a value above it is an error that names
 * its point, since a curve that is cut off would give a wrong answer without a sign of it. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double pi = 3.14159265358979323846;
static const double lo = 0, hi = 1;

static double quarter_circle(const double *x, void *ctx)
{
    (void)ctx;
    return sqrt(1 - x[0] * x[0]);
}

static const buffon_integrand f = {.scalar = quarter_circle, .dim = 1};

static int estimate_pi(uint64_t n)
{
    buffon_estimate e;
    const buffon_status s =
        buffon_rejection(&e, &f, &lo, &hi, 1, &(buffon_run){.samples = n, .seed = 4});
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    printf("%8llu points, %.4f of them hit: pi = %.5f +- %.5f, 95 %% in [%.5f, %.5f]\n",
           (unsigned long long)n, e.acceptance, 4 * e.value, 4 * e.std_error, 4 * e.lo, 4 * e.hi);
    return 0;
}

/* A bound that is too low: the curve reaches 1. */
static int too_low(double height)
{
    const buffon_run run = {.samples = 1000, .seed = 4};
    buffon_estimate e;
    const buffon_status s = buffon_rejection(&e, &f, &lo, &hi, height, &run);
    if (s != BUFFON_E_BOUND)
        return 1;
    /* The point in question: that of the box which has y as its last side. */
    double point[2];
    const double from[] = {lo, 0}, to[] = {hi, height};
    const buffon_density box = buffon_box(from, to, 2);
    const buffon_status found = buffon_sample_at(point, &box, e.bad_index, &run);
    printf("with h = %g: %s\n", height, buffon_status_string(s));
    printf("    at point %llu, x = %.5f, where f = %.5f\n", (unsigned long long)e.bad_index,
           point[0], quarter_circle(point, NULL));
    return found != BUFFON_OK;
}

int main(void)
{
    int bad = 0;
    for (uint64_t n = 100; n <= 1000000; n *= 10)
        bad |= estimate_pi(n);
    printf("exactly                            pi = %.5f\n\n", pi);
    bad |= too_low(0.9);
    return bad;
}
