/* Threads: the same bits with 1, 2, 3 and 7.
 *
 * A point is a function of the seed and its index, not of who evaluates it, and sums are exact
 * whole numbers, which can be added in any order. So the number of threads is a matter of time
 * alone. The integrand is called by several threads at once: what it writes must not be shared. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

enum { DIM = 4 };

/* The product of 1 / (1 + x_j^2); its integral over the unit cube is (pi / 4)^4. */
static double f(const double *x, void *ctx)
{
    (void)ctx;
    double product = 1;
    for (size_t j = 0; j < DIM; j++)
        product /= 1 + x[j] * x[j];
    return product;
}

int main(void)
{
    const double lo[DIM] = {0}, hi[DIM] = {1, 1, 1, 1}, pi = 3.14159265358979323846;
    const uint32_t threads[] = {1, 2, 3, 7};
    buffon_estimate first = {.value = 0};
    int differ = 0;
    for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
        buffon_estimate e;
        const buffon_status s =
            buffon_uniform(&e, &(buffon_integrand){.scalar = f, .dim = DIM}, lo, hi,
                           &(buffon_run){.samples = 2000000, .seed = 6, .threads = threads[k]});
        if (s < 0) {
            fprintf(stderr, "%s\n", buffon_status_string(s));
            return 1;
        }
        if (k == 0)
            first = e;
        differ |= e.value != first.value || e.std_error != first.std_error || e.lo != first.lo ||
                  e.hi != first.hi;
        printf("%u thread%c  %a +- %a\n", (unsigned)threads[k], threads[k] > 1 ? 's' : ' ', e.value,
               e.std_error);
    }
    printf("%s: %.6f +- %.6f, 95 %% in [%.6f, %.6f], exactly %.6f\n",
           differ ? "different bits" : "the same bits", first.value, first.std_error, first.lo,
           first.hi, pow(pi / 4, DIM));
    return differ;
}
