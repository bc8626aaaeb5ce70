/* How much light comes through?
 *
 * A photon flies an exponential distance before it is absorbed, so of a beam exp(-thickness) gets
 * through a slab, measured in mean free paths. To draw distances and count the long ones is to do
 * as nature does, and behind a thick slab few arrive. Drawn with a longer mean and weighed by f/g,
 * many do: the exponential transform of those who compute shields.
 *
 * A laser beam has a normal profile. Through a lens of thickness 1 + r^2 / 8 its share is the mean
 * of exp(-thickness) over the beam, which for a standard deviation of s is e^-1 / (1 + s^2 / 4). */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double slab = 8; /* mean free paths */

static double arrives(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] > slab;
}

/* The same times the law of x: what is integrated when x is drawn from another. */
static double arrives_weighed(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] > slab ? exp(-x[0]) : 0;
}

static double lens(const double *x, void *ctx)
{
    (void)ctx;
    return exp(-1 - (x[0] * x[0] + x[1] * x[1]) / 8);
}

static int show(const char *name, buffon_status s, const buffon_estimate *e, double exact)
{
    if (s < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(s));
        return 1;
    }
    printf("%-22s  %.4e +- %.1e  (exactly %.4e)\n", name, e->value, e->std_error, exact);
    return 0;
}

int main(void)
{
    const double s = 1.5;
    const buffon_density nature = buffon_exponential(1), stretched = buffon_exponential(slab);
    const buffon_density profile[] = {buffon_normal(0, s), buffon_normal(0, s)};
    const buffon_density beam = buffon_density_product(profile, 2);
    const buffon_run run = {.samples = 1000000, .seed = 1};
    buffon_estimate e;
    buffon_status status;
    int bad = 0;
    status =
        buffon_expectation(&e, &(buffon_integrand){.scalar = arrives, .dim = 1}, &nature, &run);
    bad |= show("slab, as in nature", status, &e, exp(-slab));
    status = buffon_importance(&e, &(buffon_integrand){.scalar = arrives_weighed, .dim = 1},
                               &stretched, &run);
    bad |= show("slab, longer paths", status, &e, exp(-slab));
    status = buffon_expectation(&e, &(buffon_integrand){.scalar = lens, .dim = 2}, &beam, &run);
    bad |= show("lens", status, &e, exp(-1) / (1 + s * s / 4));
    return bad;
}
