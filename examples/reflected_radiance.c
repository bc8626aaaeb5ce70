/* Light that a matt surface reflects: L' = (rho / pi) int_Omega L(w) cos(theta) dw over the
 * hemisphere of directions w above it.
 *
 * A spherical lamp of radiance 20 shines on it from a small cap gamma of directions, the sky of
 * radiance 1 from the rest. The cap has int cos(theta) dw = pi (r / d)^2 cos(axis), so
 *
 *     L' = rho (1 + 19 (r / d)^2 cos(axis))  with both,  rho 20 (r / d)^2 cos(axis)  by the lamp.
 *
 * A uniform hemisphere seldom finds the lamp; one by the cosine at least does not waste samples on
 * the horizon; the uniform cap always finds the lamp, but nothing else. So the region is split:
 * Omega = gamma + rest, the first by the cap and the second by the cosine. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double pi = 3.14159265358979323846;
static const double point[3] = {0, 0, 0}, centre[3] = {0, 1, 3}, radius = 0.5, d2 = 10;
static const double rho = 0.5, lamp = 20, sky = 1;

static int in_gamma(const double *w)
{
    const double along = w[0] * centre[0] + w[1] * centre[1] + w[2] * centre[2];
    return along > 0 && along * along > d2 - radius * radius;
}

/* rho / pi L(w) cos(theta), of one light or of both. */
static double by_lamp(const double *w, void *ctx)
{
    (void)ctx;
    return in_gamma(w) ? rho / pi * lamp * w[2] : 0;
}

static double by_sky(const double *w, void *ctx)
{
    (void)ctx;
    return in_gamma(w) ? 0 : rho / pi * sky * w[2];
}

static double by_both(const double *w, void *ctx)
{
    return by_lamp(w, ctx) + by_sky(w, ctx);
}

static int show(const char *name, buffon_status s, const buffon_estimate *e, double exact)
{
    if (s < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(s));
        return 1;
    }
    printf("%-28s %.6f +- %.6f, 95 %% in [%.6f, %.6f], exactly %.6f\n", name, e->value,
           e->std_error, e->lo, e->hi, exact);
    return 0;
}

int main(void)
{
    const buffon_density uniform = buffon_hemisphere(), cosine = buffon_hemisphere_cosine();
    const buffon_density cap = buffon_cap_of_sphere(point, centre, radius);
    const buffon_integrand direct = {.scalar = by_lamp, .dim = 3};
    const buffon_integrand rest = {.scalar = by_sky, .dim = 3};
    const buffon_integrand both = {.scalar = by_both, .dim = 3};
    const buffon_stratum split[] = {{.density = &cap, .f = &direct},
                                    {.density = &cosine, .f = &rest}};
    const buffon_strata omega = {.stratum = split, .count = 2};
    const buffon_run run = {.samples = 100000, .seed = 174};
    const double form = radius * radius / d2 * (centre[2] / sqrt(d2));
    const double by_lamp_alone = rho * lamp * form, all = rho * (sky + (lamp - sky) * form);
    buffon_estimate e;
    int bad = 0;
    bad |= show("lamp: uniform hemisphere", buffon_importance(&e, &direct, &uniform, &run), &e,
                by_lamp_alone);
    bad |= show("lamp: cosine hemisphere", buffon_importance(&e, &direct, &cosine, &run), &e,
                by_lamp_alone);
    bad |= show("lamp: uniform cap", buffon_importance(&e, &direct, &cap, &run), &e, by_lamp_alone);
    bad |= show("both: uniform hemisphere", buffon_importance(&e, &both, &uniform, &run), &e, all);
    bad |= show("both: cosine hemisphere", buffon_importance(&e, &both, &cosine, &run), &e, all);
    bad |= show("both: Omega = gamma + rest", buffon_stratified(&e, NULL, &omega, &run), &e, all);
    return bad;
}
