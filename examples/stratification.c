/* Stratification: int over Omega = sum of int over its pieces, each estimated on its own; their
 * squared errors add. It takes away what the pieces differ by.
 *
 * Equal cells of the cube are a point set, buffon_points_jitter(k): pairs of points in each of k^d
 * cells, whose error falls as N^(-1/2 - 1/d) for smooth f. Here e^(x+y) over the unit square,
 * exactly (e - 1)^2.
 *
 * Pieces of your own are a list of strata. Neyman's allocation gives stratum i samples in
 * proportion to |weight_i| sigma_i, found by a pilot run. Here e^-x over (0, 10), exactly
 * 1 - e^-10. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static double exp_sum(const double *x, void *ctx)
{
    (void)ctx;
    return exp(x[0] + x[1]);
}

static double decay(const double *x, void *ctx)
{
    (void)ctx;
    return exp(-x[0]);
}

static int show(const char *name, buffon_status s, const buffon_estimate *e)
{
    if (s < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(s));
        return 1;
    }
    printf("%-22s %7llu  %.7f +- %.7f, 95 %% in [%.7f, %.7f]\n", name,
           (unsigned long long)e->samples, e->value, e->std_error, e->lo, e->hi);
    return 0;
}

static int jitter(void)
{
    const double lo[] = {0, 0}, hi[] = {1, 1};
    const buffon_integrand f = {.scalar = exp_sum, .dim = 2};
    buffon_estimate e;
    int bad =
        show("no strata", buffon_uniform(&e, &f, lo, hi, &(buffon_run){.samples = 1 << 17}), &e);
    for (uint64_t k = 4; k <= 256; k *= 4) {
        const buffon_points points = buffon_points_jitter(k);
        char name[32];
        snprintf(name, sizeof name, "%d x %d cells", (int)k, (int)k);
        bad |= show(
            name,
            buffon_uniform(&e, &f, lo, hi, &(buffon_run){.samples = 1 << 17, .points = &points}),
            &e);
    }
    printf("exactly %33.7f\n\n", (exp(1) - 1) * (exp(1) - 1));
    return bad;
}

static int pieces(void)
{
    const double lo = 0, hi = 10;
    const buffon_density near = buffon_segment(0, 1), middle = buffon_segment(1, 3),
                         far = buffon_segment(3, 10);
    const buffon_stratum list[] = {{.density = &near, .share = 1},
                                   {.density = &middle, .share = 2},
                                   {.density = &far, .share = 7}};
    const buffon_strata by_length = {.stratum = list, .count = 3};
    const buffon_strata neyman = {
        .stratum = list, .count = 3, .allocation = BUFFON_ALLOCATION_NEYMAN};
    const buffon_integrand f = {.scalar = decay, .dim = 1};
    const buffon_run run = {.samples = 1 << 17};
    buffon_estimate e;
    int bad = show("no strata", buffon_uniform(&e, &f, &lo, &hi, &run), &e);
    bad |= show("3, by their lengths", buffon_stratified(&e, &f, &by_length, &run), &e);
    bad |= show("3, Neyman", buffon_stratified(&e, &f, &neyman, &run), &e);
    printf("exactly %33.7f\n", 1 - exp(-10));
    return bad;
}

int main(void)
{
    const int bad = jitter();
    return bad | pieces();
}
