/* A density of your own: the normal one in the plane, which reaches where no box does.
 *
 *     r = sigma sqrt(-2 log u1),  angle = 2 pi u2       (G. Box, M. Muller 1958)
 *     g = exp(-r^2 / (2 sigma^2)) / (2 pi sigma^2)
 *
 * A density is a buffon_density and the table of functions it points at: `sample` draws points and
 * says what g is there, `pdf` says it of any point. Batches are coordinate-major. Parameters live
 * in `param`, by which partial results of different densities are told apart. Every estimator and
 * point set then works with it. buffon_verify_density tells whether it does what it says: here is
 * one with a mistake that is easily made, r = sigma u1.
 *
 * Here int x^2 exp(-x^2 - y^2) over the plane, exactly pi / 2. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

static const double pi = 3.14159265358979323846;

static int normal_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const double variance = g->param[0] * g->param[0];
    for (size_t i = 0; i < n; i++)
        pdf[i] = exp(-(x[i] * x[i] + x[n + i] * x[n + i]) / (2 * variance)) / (2 * pi * variance);
    return 0;
}

static int normal_sample(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const double r = g->param[0] * sqrt(-2 * log(u[i])), angle = 2 * pi * u[n + i];
        x[i] = r * cos(angle);
        x[n + i] = r * sin(angle);
    }
    return pdf != NULL ? normal_pdf(pdf, x, n, g) : 0;
}

/* As it is in many a first draft. */
static int mistaken_sample(double *x, double *pdf, const double *u, size_t n,
                           const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        const double r = g->param[0] * u[i], angle = 2 * pi * u[n + i];
        x[i] = r * cos(angle);
        x[n + i] = r * sin(angle);
    }
    return pdf != NULL ? normal_pdf(pdf, x, n, g) : 0;
}

static void verify(const char *name, const buffon_density *g)
{
    buffon_verify_report r;
    const buffon_status s = buffon_verify_density(&r, g, NULL);
    printf("%s: %s; %s\n", name, buffon_status_string(s), buffon_verify_string(r.check));
}

/* The constructor. What is senseless is refused where the density is used. */
static buffon_density normal(double sigma)
{
    static const buffon_density_ops ops = {
        .sample = normal_sample, .pdf = normal_pdf, .name = "example.normal"};
    return (buffon_density){.uniforms = 2,
                            .dim = 2,
                            .status = sigma > 0 ? BUFFON_OK : BUFFON_E_SHAPE,
                            .ops = &ops,
                            .param = {sigma}};
}

static double f(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0] * exp(-x[0] * x[0] - x[1] * x[1]);
}

int main(void)
{
    const buffon_points points[] = {buffon_points_random(), buffon_points_jitter(256)};
    const char *const names[] = {"random", "jittered"};
    const buffon_density g = normal(1);
    for (size_t k = 0; k < 2; k++) {
        buffon_estimate e;
        const buffon_status s =
            buffon_importance(&e, &(buffon_integrand){.scalar = f, .dim = 2}, &g,
                              &(buffon_run){.samples = 1 << 17, .seed = 9, .points = &points[k]});
        if (s < 0) {
            fprintf(stderr, "%s\n", buffon_status_string(s));
            return 1;
        }
        printf("%-8s  %.6f +- %.6f, 95 %% in [%.6f, %.6f], exactly %.6f\n", names[k], e.value,
               e.std_error, e.lo, e.hi, pi / 2);
    }
    static const buffon_density_ops ops = {.sample = mistaken_sample, .pdf = normal_pdf};
    buffon_density mistaken = g;
    mistaken.ops = &ops;
    verify("with r = sigma sqrt(-2 log u1)", &g);
    verify("with r = sigma u1", &mistaken);
    const buffon_density bad = normal(-1);
    printf("sigma = -1: %s\n", buffon_status_string(buffon_density_check(&bad)));
    return 0;
}
