/* The mean shadow of a convex body is a quarter of its surface (Cauchy), and of a needle pi / 4 of
 * its length: over all rotations. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

/* The shadow on the floor of a box with edges 1, 2, 3: of each pair of faces as seen from above. */
static double box(const double *q, void *ctx)
{
    double m[9];
    (void)ctx;
    buffon_rotation_matrix(m, q);
    return 6 * fabs(m[6]) + 3 * fabs(m[7]) + 2 * fabs(m[8]);
}

static double needle(const double *q, void *ctx)
{
    const double along[3] = {1, 0, 0};
    double x[3];
    (void)ctx;
    buffon_rotation_apply(x, along, q);
    return hypot(x[0], x[1]);
}

int main(void)
{
    const buffon_density rotations = buffon_rotation();
    const buffon_points points = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const struct {
        const char *name;
        double (*f)(const double *q, void *ctx);
        double exact;
    } bodies[] = {{"box 1 x 2 x 3", box, 5.5}, {"needle", needle, 0.78539816339744831}};
    for (int k = 0; k < 2; k++) {
        buffon_estimate e;
        const buffon_status s =
            buffon_expectation(&e, &(buffon_integrand){.scalar = bodies[k].f, .dim = 4}, &rotations,
                               &(buffon_run){.samples = 1 << 14, .points = &points});
        if (s < 0) {
            fprintf(stderr, "%s\n", buffon_status_string(s));
            return 1;
        }
        printf("mean shadow of a %-14s %.6f +- %.6f, exactly %.6f\n", bodies[k].name, e.value,
               e.std_error, bodies[k].exact);
    }
    return 0;
}
