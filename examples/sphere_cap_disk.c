/* Points of the sphere, of a cap, of hemispheres and of the disk, and integrals over each.
 *
 * Sphere: slices of equal height have equal area (Archimedes), so z = 1 - 2 u1, angle = 2 pi u2.
 * Cap above z = cut: z = 1 - (1 - cut) u1, the same angle.
 * Disk: P(r <= s) = s^2, so r = sqrt(u1), angle = 2 pi u2; the concentric map keeps neighbours
 * together. Its points projected upwards have density cos(theta) / pi on the hemisphere.
 *
 * An integral by area or solid angle is the mean of f / g with g the uniform density. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double pi = 3.14159265358979323846;

static double height(const double *w, void *ctx)
{
    (void)ctx;
    return w[2];
}

static double height_squared(const double *w, void *ctx)
{
    (void)ctx;
    return w[2] * w[2];
}

static double x_squared(const double *w, void *ctx)
{
    (void)ctx;
    return w[0] * w[0];
}

typedef struct problem {
    const char *name;
    buffon_density g;
    double (*f)(const double *x, void *ctx);
    double exact;
} problem;

int main(void)
{
    const double cut = 0.8;
    const problem problems[] = {
        {"z^2 over the sphere", buffon_sphere(), height_squared, 4 * pi / 3},
        {"z over the cap above 0.8", buffon_cap(cut), height, pi * (1 - cut * cut)},
        {"z^2, uniform hemisphere", buffon_hemisphere(), height_squared, 2 * pi / 3},
        {"z^2, cosine hemisphere", buffon_hemisphere_cosine(), height_squared, 2 * pi / 3},
        {"x^2 over the disk, polar", buffon_disk(1), x_squared, pi / 4},
        {"the same, concentric", buffon_disk_concentric(1), x_squared, pi / 4},
    };
    printf("                              value  std_error      95 %% interval        exactly\n");
    for (size_t k = 0; k < sizeof problems / sizeof *problems; k++) {
        const problem *p = &problems[k];
        buffon_estimate e;
        const buffon_status s =
            buffon_importance(&e, &(buffon_integrand){.scalar = p->f, .dim = p->g.dim}, &p->g,
                              &(buffon_run){.samples = 200000, .seed = 212});
        if (s < 0) {
            fprintf(stderr, "%s: %s\n", p->name, buffon_status_string(s));
            return 1;
        }
        printf("%-26s  %.6f   %.6f   [%.6f, %.6f]   %.6f\n", p->name, e.value, e.std_error, e.lo,
               e.hi, p->exact);
    }
    /* One point at a time, from uniforms of your own. */
    buffon_rng rng = buffon_rng_make(212, 0);
    double w[3];
    const double u1 = buffon_rng_next(&rng), u2 = buffon_rng_next(&rng);
    buffon_cap_sample(w, u1, u2, cut);
    printf("a point of the cap: (%.4f, %.4f, %.4f)\n", w[0], w[1], w[2]);
    return 0;
}
