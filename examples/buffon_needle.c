/* Buffon's needle, the first Monte Carlo experiment (1777).
 *
 * A needle as long as the distance between the lines of a ruled floor falls at random. Its middle
 * is y from the nearest line, uniform on (0, 1/2), its angle to the lines uniform on (0, pi/2). It
 * crosses a line where y < sin(angle) / 2, so
 *
 *     P(cross) = (2 / pi) int_0^(pi/2) sin(angle) d angle = 2 / pi.
 *
 * A probability is the expectation of a function that is 0 or 1. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double pi = 3.14159265358979323846;

/* x is one throw: angle and y. */
static double crosses(const double *x, void *ctx)
{
    (void)ctx;
    return x[1] < sin(x[0]) / 2;
}

int main(void)
{
    const double lo[] = {0, 0}, hi[] = {pi / 2, 0.5};
    const buffon_density g = buffon_box(lo, hi, 2);
    const buffon_integrand h = {.scalar = crosses, .dim = 2};
    printf("   throws  P(cross)  std_error     95 %% interval    2 / P      95 %% interval\n");
    for (uint64_t n = 100; n <= 1000000; n *= 10) {
        buffon_estimate e;
        const buffon_status s =
            buffon_expectation(&e, &h, &g, &(buffon_run){.samples = n, .seed = 1777});
        if (s < 0) {
            fprintf(stderr, "%s\n", buffon_status_string(s));
            return 1;
        }
        /* 2 / P falls as P rises, so the ends of its interval are those of P, turned about. */
        printf("%9llu  %.6f   %.6f  [%.4f, %.4f]  %.6f  [%.4f, %.4f]\n", (unsigned long long)n,
               e.value, e.std_error, e.lo, e.hi, 2 / e.value, 2 / e.hi, 2 / e.lo);
    }
    printf("  exactly  %.6f                               %.6f\n", 2 / pi, pi);
    return 0;
}
