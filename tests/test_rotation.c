/* Random rotations: the formula in extended precision, what is turned, and moments over all
 * rotations. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>

#include "grid.h"
#include "law.h"
#include "tap.h"

typedef long double wide;

#define WIDE_PI 3.14159265358979323846264338327950288L

enum { DRAWS = 20000 };

static void raise_to(double *worst, double error)
{
    if (!(error <= *worst))
        *worst = error;
}

static void report(double worst, double limit, const char *what)
{
    tap_ok(worst <= limit, "%s: at most %g", what, limit);
    tap_note("worst %.3g", worst);
}

/* cos(pi t), sin(pi t), reduced by halves exactly. */
static void half_turns(wide *c, wide *s, double t)
{
    const double halves = floor(2 * t + 0.5);
    const wide rest = WIDE_PI * ((wide)t - halves / 2), sine = sinl(rest), cosine = cosl(rest);
    const int k = (int)halves & 3;
    *c = k == 0 ? cosine : k == 1 ? -sine : k == 2 ? -cosine : sine;
    *s = k == 0 ? sine : k == 1 ? cosine : k == 2 ? -sine : -cosine;
}

static void test_formula(void)
{
    const buffon_density g = buffon_rotation();
    double ulps = 0, length = 0, back = 0;
    int good = 1;
    buffon_rng rng = buffon_rng_make(1, 91);
    for (int k = 0; k < DRAWS; k++) {
        const double u[3] = {grid(&rng, k), grid(&rng, k / 2), grid(&rng, k / 3)};
        double q[4], v[3], p[4], pdf, again;
        wide c, s, exact[4];
        good &= buffon_density_sample(q, &pdf, u, 1, &g) == BUFFON_OK;
        half_turns(&c, &s, 2 * u[1]);
        exact[1] = sqrtl(1 - (wide)u[0]) * c;
        exact[2] = sqrtl(1 - (wide)u[0]) * s;
        half_turns(&c, &s, u[2]);
        exact[0] = sqrtl(u[0]) * s;
        exact[3] = sqrtl(u[0]) * c;
        for (int j = 0; j < 4; j++) {
            const double size = fabs((double)exact[j]);
            raise_to(&ulps, (double)fabsl(q[j] - exact[j]) / (nextafter(size, 2) - size));
        }
        raise_to(&length, fabs(sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) - 1));
        good &= q[0] > 0 && pdf == 0x1.9f02f6222c720p-4;
        good &= buffon_density_pdf(&again, q, 1, &g) == BUFFON_OK && again == pdf;
        good &= buffon_density_invert(v, q, 1, &g) == BUFFON_OK;
        good &= buffon_density_sample(p, NULL, v, 1, &g) == BUFFON_OK;
        for (int j = 0; j < 4; j++)
            raise_to(&back, fabs(p[j] - q[j]));
        for (int j = 0; j < 4; j++)
            q[j] = -q[j];
        good &= buffon_density_pdf(&again, q, 1, &g) == BUFFON_OK && again == 0;
    }
    tap_ok(good, "w > 0, g = 1 / pi^2 there and 0 at -q");
    if (LDBL_MANT_DIG >= 64)
        report(ulps, 3, "quaternions, in ulp");
    report(length, 0x1p-51, "length of quaternions");
    report(back, 0x1p-50, "from quaternions to uniforms to quaternions");
    const double off[3][4] = {{1, 1, 0, 0}, {0.5, 0.5, 0.5, 0.49}, {NAN, 0, 0, 1}};
    good = fabs(0x1.9f02f6222c720p-4 * 3.14159265358979323846 * 3.14159265358979323846 - 1) < 4e-16;
    for (int k = 0; k < 3; k++) {
        double pdf;
        good &= buffon_density_pdf(&pdf, off[k], 1, &g) == BUFFON_OK && pdf == 0;
    }
    tap_ok(good, "g = 0 for what is not a unit quaternion");
}

/* The rotation by an angle about an axis, by Rodrigues' formula. */
static void test_turning(void)
{
    double worst = 0, ortho = 0;
    buffon_rng rng = buffon_rng_make(2, 91);
    for (int k = 0; k < DRAWS / 4; k++) {
        double axis[3], p[3], q[4], y[3], m[9];
        const double angle = 2 * LAW_PI * buffon_rng_next(&rng), scale = ldexp(1, k % 60 - 30);
        const double u1 = buffon_rng_next(&rng), u2 = buffon_rng_next(&rng);
        buffon_sphere_sample(axis, u1, u2);
        for (int j = 0; j < 3; j++)
            p[j] = 2 * buffon_rng_next(&rng) - 1;
        const wide sine = sinl((wide)angle / 2), cosine = cosl((wide)angle / 2);
        q[0] = scale * (double)cosine;
        for (int j = 0; j < 3; j++)
            q[j + 1] = scale * (double)(axis[j] * sine);
        buffon_rotation_apply(y, p, q);
        buffon_rotation_matrix(m, q);
        wide along = 0, square = 0;
        for (int j = 0; j < 3; j++) {
            along += (wide)axis[j] * p[j];
            square += (wide)axis[j] * axis[j];
        }
        for (int j = 0; j < 3; j++) {
            const int a = (j + 1) % 3, b = (j + 2) % 3;
            const wide cross = (wide)axis[a] * p[b] - (wide)axis[b] * p[a];
            const wide exact = p[j] * cosl(angle) + cross * sinl(angle) +
                               axis[j] * along / square * (1 - cosl(angle));
            raise_to(&worst, (double)fabsl(y[j] - exact));
            const double by_matrix = m[3 * j] * p[0] + m[3 * j + 1] * p[1] + m[3 * j + 2] * p[2];
            raise_to(&worst, (double)fabsl(by_matrix - exact));
        }
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                const double row =
                    m[3 * i] * m[3 * j] + m[3 * i + 1] * m[3 * j + 1] + m[3 * i + 2] * m[3 * j + 2];
                raise_to(&ortho, fabs(row - (i == j)));
            }
    }
    report(worst, 0x1p-50, "turned vectors against Rodrigues' formula");
    report(ortho, 0x1p-49, "matrices are orthogonal");
    double y[3] = {1, 2, 3};
    const double zero[4] = {0}, turn[4] = {1, 0, 0, 1};
    buffon_rotation_apply(y, y, turn);
    tap_ok(y[0] == -2 && y[1] == 1 && y[2] == 3, "a quarter turn about z, in place");
    buffon_rotation_apply(y, y, zero);
    tap_ok(isnan(y[0]) && isnan(y[1]) && isnan(y[2]), "zero turns nothing");
}

/* A turned axis is uniform on the sphere, whatever axis; the angle of a rotation has the density
 * (1 - cos) / pi. */
static void test_law(void)
{
    static double height[3][DRAWS], turn[DRAWS];
    const double axes[3][3] = {{1, 0, 0}, {0, 0, 1}, {0.6, 0, 0.8}};
    const buffon_density g = buffon_rotation();
    buffon_rng rng = buffon_rng_make(3, 91);
    int good = 1;
    for (int k = 0; k < DRAWS; k++) {
        double u[3], q[4], y[3];
        buffon_rng_fill(u, 3, &rng);
        good &= buffon_density_sample(q, NULL, u, 1, &g) == BUFFON_OK;
        for (int a = 0; a < 3; a++) {
            buffon_rotation_apply(y, axes[a], q);
            height[a][k] = 0.5 + 0.5 * (a == 0 ? y[2] : a == 1 ? y[0] : 0.8 * y[1] - 0.6 * y[2]);
        }
        const double angle = 2 * acos(q[0] < 1 ? q[0] : 1);
        turn[k] = (angle - sin(angle)) / LAW_PI;
    }
    tap_ok(good, "rotations drawn");
    for (int a = 0; a < 3; a++)
        law_ok(law_uniform(height[a], DRAWS), "turned axis %d: height in a fixed direction", a);
    law_ok(law_uniform(turn, DRAWS), "the angle of a rotation");
}

int main(void)
{
    test_formula();
    test_turning();
    test_law();
    return tap_done();
}
