/* Why not quadrature? In d dimensions a rule with m points along each axis takes m^d evaluations,
 * so with N of them it has N^(1/d) along an axis: 2^20 are 1024 in the plane, and 4 in ten
 * dimensions. The error of Monte Carlo is sigma / sqrt(N) in any dimension.
 *
 * The integrand is as smooth as can be, the best case for a rule: the product of 6 x_j (1 - x_j)
 * over the unit cube. Its integral is 1, its variance (6/5)^d - 1, and the midpoint rule gives
 * (1 + 1 / (2 m^2))^d. */
#include <stdio.h>

#include <buffon/buffon.h>

enum { MOST = 20, EVALUATIONS = 1 << 20 };

static double f(const double *x, void *ctx)
{
    const size_t dim = *(const size_t *)ctx;
    double product = 1;
    for (size_t j = 0; j < dim; j++)
        product *= 6 * x[j] * (1 - x[j]);
    return product;
}

/* The midpoint rule with m points along each of dim axes. */
static double midpoint(size_t m, size_t dim)
{
    double sum = 0, x[MOST];
    for (size_t i = 0; i < EVALUATIONS; i++) {
        size_t rest = i;
        for (size_t j = 0; j < dim; j++, rest /= m)
            x[j] = ((double)(rest % m) + 0.5) / (double)m;
        sum += f(x, &dim);
    }
    return sum / EVALUATIONS;
}

int main(void)
{
    const double lo[MOST] = {0};
    const size_t dims[] = {1, 2, 4, 5, 10, 20}, along[] = {1 << 20, 1024, 32, 16, 4, 2};
    double hi[MOST];
    for (size_t j = 0; j < MOST; j++)
        hi[j] = 1;
    printf("%d evaluations each; exactly 1\n", EVALUATIONS);
    printf(" d   along an axis   midpoint      error    Monte Carlo   std_error"
           "     95 %% interval      error\n");
    for (size_t k = 0; k < sizeof dims / sizeof *dims; k++) {
        size_t dim = dims[k];
        const double rule = midpoint(along[k], dim);
        buffon_estimate e;
        const buffon_status s =
            buffon_uniform(&e, &(buffon_integrand){.scalar = f, .dim = dim, .ctx = &dim}, lo, hi,
                           &(buffon_run){.samples = EVALUATIONS, .seed = 10});
        if (s < 0) {
            fprintf(stderr, "%s\n", buffon_status_string(s));
            return 1;
        }
        printf("%2zu   %13zu   %.6f   %8.1e       %.6f    %.6f   [%.4f, %.4f]   %8.1e\n", dim,
               along[k], rule, rule - 1, e.value, e.std_error, e.lo, e.hi, e.value - 1);
    }
    return 0;
}
