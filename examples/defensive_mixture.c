/* A defensive mixture: most points from a density that has the shape of f where f is large, and a
 * share from a broad one, for what the first does not see.
 *
 * f = 1 / (1 + x^2) is a bell with heavy tails; its integral is pi. A normal density fits the bell
 * and falls much too fast: f / g grows without bound, and the variance of the mean is infinite. In
 * g = 0.9 normal + 0.1 Cauchy, f / g is nowhere more than f / (0.1 Cauchy): its largest value is
 * known before a single point is drawn. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double pi = 3.14159265358979323846;

static double f(const double *x, void *ctx)
{
    (void)ctx;
    return 1 / (1 + x[0] * x[0]);
}

static int show(buffon_estimate *e, const char *name, const buffon_density *g)
{
    const buffon_status status = buffon_importance(e, &(buffon_integrand){.scalar = f, .dim = 1}, g,
                                                   &(buffon_run){.samples = 1 << 18, .seed = 11});
    if (status < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(status));
        return 1;
    }
    printf("%-10s %.5f +- %.5f   largest f / g %8.2f   %s\n", name, e->value, e->std_error, e->max,
           buffon_status_string(status));
    return 0;
}

int main(void)
{
    const buffon_density parts[] = {buffon_normal(0, 1), buffon_cauchy(0, 3)};
    const double shares[] = {0.9, 0.1}; /* any unit will do: 9 to 1 */
    const buffon_density mixture = buffon_mixture(parts, shares, 2);
    buffon_estimate alone, mixed;
    if (show(&alone, "normal", &parts[0]) || show(&mixed, "mixture", &mixture))
        return 1;
    printf("exactly    %.5f\n", pi);

    /* f / (0.1 Cauchy(0, 3)) = 10 pi (9 + x^2) / (3 (1 + x^2)), 30 pi at most. */
    const int known = mixed.max <= 30 * pi && fabs(mixed.value - pi) < 5 * mixed.std_error;
    return !known || mixed.doubts != 0 || alone.doubts == 0;
}
