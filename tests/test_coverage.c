/* Coverage of the stated intervals, and the law of repeats, for every estimator and every kind of
 * points. The integrands are so mild that the central limit theorem is good to a tenth of what the
 * binomial law lets pass; where the values lie on a lattice, the coverage is computed exactly.
 */
#include "repeats.h"

#include <buffon/buffon.h>

enum { SEEDS = 4096, POINTS = 256 };

/* ---- the square: x y, exp x, and 1 + x where y < 0.3 ---- */

#define SQUARE_MEANS {0.25, expm1(1), 0.45}

static int square_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[i] = x[i] * x[n + i];
        f[n + i] = exp(x[i]);
        f[2 * n + i] = x[n + i] < 0.3 ? 1 + x[i] : 0;
    }
    return 0;
}

static const double square_lo[] = {0, 0}, square_hi[] = {1, 1};

static buffon_status square_uniform(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.batch = square_batch, .dim = 2, .components = 3};
    return buffon_uniform(out, &f, square_lo, square_hi, run);
}

/* Without the step, whose spread is all in the few cells that it cuts. */
static int smooth_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[i] = x[i] * x[n + i];
        f[n + i] = exp(x[i]);
    }
    return 0;
}

static buffon_status smooth_uniform(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.batch = smooth_batch, .dim = 2, .components = 2};
    return buffon_uniform(out, &f, square_lo, square_hi, run);
}

/* The variance of exp on an interval. */
static double exp_variance(double a, double b)
{
    const double mean = (exp(b) - exp(a)) / (b - a);
    return (exp(2 * b) - exp(2 * a)) / (2 * (b - a)) - mean * mean;
}

static void check_random(void)
{
    const repeats_trial t = {.name = "uniform",
                             .run = square_uniform,
                             .stream = 1,
                             .samples = POINTS,
                             .components = 3,
                             .exact = SQUARE_MEANS,
                             .variance = {7.0 / 144 / POINTS, exp_variance(0, 1) / POINTS,
                                          0.4975 / POINTS}};
    repeats_trial blocks = t;
    blocks.name = "uniform, 4 blocks";
    blocks.run = smooth_uniform;
    blocks.stream = 2;
    blocks.samples = 4096;
    blocks.components = 1;
    blocks.variance[0] = 7.0 / 144 / 4096;
    repeats_check(&t, SEEDS);
    repeats_check(&blocks, SEEDS);
}

/* With a = x - 1/2 and b = y - 1/2 the mean of a pair is 1/4 + a b; that of exp has the covariance
 * e - (e - 1)^2; and y and 1 - y are never both below 0.3. */
static void check_antithetic(void)
{
    const buffon_points points = buffon_points_antithetic();
    const double pairs = POINTS / 2.0, mean = expm1(1);
    const repeats_trial t = {.name = "antithetic",
                             .run = square_uniform,
                             .stream = 3,
                             .samples = POINTS,
                             .points = &points,
                             .components = 3,
                             .exact = SQUARE_MEANS,
                             .variance = {1.0 / 144 / pairs,
                                          (exp_variance(0, 1) + exp(1) - mean * mean) / 2 / pairs,
                                          (0.4975 - 0.2025) / 2 / pairs}};
    repeats_check(&t, SEEDS);
}

/* Of x y in a cell with the middle (p, q) and the side h: (p^2 + q^2) h^2 / 12 + h^4 / 144, where
 * p^2 is 1/3 - h^2 / 12 on average. */
static void check_jitter(const char *name, uint64_t k, uint64_t samples, uint64_t stream)
{
    const buffon_points points = buffon_points_jitter(k);
    const double h = 1 / (double)k, n = (double)samples;
    const double product = (2.0 / 3 - h * h / 6) * h * h / 12 + h * h * h * h / 144;
    double exponential = 0;
    for (uint64_t i = 0; i < k; i++)
        exponential += exp_variance((double)i * h, (double)(i + 1) * h) * h;
    const repeats_trial t = {.name = name,
                             .run = smooth_uniform,
                             .stream = stream,
                             .samples = samples,
                             .points = &points,
                             .components = 2,
                             .exact = SQUARE_MEANS,
                             .variance = {product / n, exponential / n}};
    repeats_check(&t, SEEDS);
}

/* ---- a user's points in independent replicates ---- */

enum { REPLICATES = 8 };

/* One point in each of `param[0]` slices of coordinate 0; the other coordinates are random. */
static int sliced_fill(double *u, const buffon_points_block *block, const buffon_points *self)
{
    for (size_t j = 0; j < block->dim; j++)
        buffon_rng_uniforms_at(u + j * block->n, block->n, &block->key, (uint32_t)j, block->first);
    for (size_t i = 0; i < block->n; i++)
        u[i] = ((double)((block->first + i) % self->param[0]) + u[i]) / (double)self->param[0];
    return 0;
}

static void check_replicates(void)
{
    const double slices = POINTS / REPLICATES, h = 1 / slices;
    const buffon_points points = {.fill = sliced_fill,
                                  .design = BUFFON_DESIGN_REPLICATES,
                                  .replicates = REPLICATES,
                                  .param = {POINTS / REPLICATES}};
    const double p2 = 1.0 / 3 - h * h / 12; /* the mean square of the middles */
    double exponential = 0;
    for (double i = 0; i < slices; i++)
        exponential += exp_variance(i * h, (i + 1) * h) * h;
    const repeats_trial t = {.name = "replicates",
                             .run = square_uniform,
                             .stream = 5,
                             .samples = POINTS,
                             .points = &points,
                             .components = 3,
                             .exact = SQUARE_MEANS,
                             .variance = {(1.0 / 9 - p2 / 4) / POINTS, exponential / POINTS,
                                          (0.7 - 0.09 * (2 + p2)) / POINTS}};
    repeats_check(&t, SEEDS);
}

/* ---- hit or miss ---- */

/* Hits of probability 1/4 and 1/100. */
static int hits_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[i] = x[i] * x[n + i];
        f[n + i] = 0.01;
    }
    return 0;
}

static buffon_status hits_rejection(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.batch = hits_batch, .dim = 2, .components = 2};
    return buffon_rejection(out, &f, square_lo, square_hi, 1, run);
}

/* How often the interval of Clopper and Pearson at n points covers p. */
static double clopper_pearson_coverage(uint64_t n, double p, double confidence)
{
    double covered = 0;
    for (uint64_t k = 0; k <= n; k++) {
        double lo, hi;
        if (buffon_interval_clopper_pearson(&lo, &hi, k, n, confidence) == BUFFON_OK && lo <= p &&
            p <= hi)
            covered += binomial_mass(k, n, p);
    }
    return covered;
}

/* A point under x y has its mirror image above: a pair never hits twice, so that its mean is 1/2
 * with probability 2 p, else 0. How often Student's interval covers p. */
static double pairs_coverage(uint64_t n, double p, double confidence)
{
    const uint64_t pairs = n / 2;
    double covered = 0;
    for (uint64_t k = 1; k < pairs; k++) {
        const double share = (double)k / (double)pairs, dof = (double)pairs - 1;
        const double error = sqrt(share * (1 - share) / dof) / 2;
        double lo, hi;
        if (buffon_interval_student(&lo, &hi, share / 2, error, dof, confidence) == BUFFON_OK &&
            lo <= p && p <= hi)
            covered += binomial_mass(k, pairs, 2 * p);
    }
    return covered;
}

static void check_rejection(void)
{
    const buffon_points mirrored = buffon_points_antithetic();
    const repeats_trial t = {.name = "rejection",
                             .run = hits_rejection,
                             .stream = 6,
                             .samples = POINTS,
                             .components = 2,
                             .exact = {0.25, 0.01},
                             .variance = {0.1875 / POINTS, 0.0099 / POINTS},
                             .coverage = clopper_pearson_coverage};
    const repeats_trial pairs = {.name = "rejection, antithetic",
                                 .run = hits_rejection,
                                 .stream = 7,
                                 .samples = POINTS,
                                 .points = &mirrored,
                                 .components = 1,
                                 .exact = {0.25},
                                 .variance = {0.125 / POINTS},
                                 .coverage = pairs_coverage};
    for (size_t l = 0; l < REPEATS_LEVELS; l++) {
        const double expected = clopper_pearson_coverage(POINTS, 0.01, repeats_level[l]);
        tap_ok(expected >= repeats_level[l], "Clopper-Pearson at %.4f covers %.4f",
               repeats_level[l], expected);
    }
    repeats_check(&t, SEEDS);
    repeats_check(&pairs, SEEDS);
}

/* ---- densities ---- */

/* Over a disk of radius 2: x^2 + y^2, which is uniform on (0, 4), and 1 + x. */
static int disk_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[i] = x[i] * x[i] + x[n + i] * x[n + i];
        f[n + i] = 1 + x[i];
    }
    return 0;
}

static buffon_status disk_importance(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.batch = disk_batch, .dim = 2, .components = 2};
    const buffon_density g = buffon_disk(2);
    return buffon_importance(out, &f, &g, run);
}

/* z and exp z, z the coordinate along the axis. */
static const double axis[3] = {2.0 / 7, 3.0 / 7, -6.0 / 7};

static int along_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[i] = axis[0] * x[i] + axis[1] * x[n + i] + axis[2] * x[2 * n + i];
        f[n + i] = exp(f[i]);
    }
    return 0;
}

static const buffon_integrand along = {.batch = along_batch, .dim = 3, .components = 2};

static buffon_status cap_importance(buffon_estimate *out, const buffon_run *run)
{
    const buffon_density g = buffon_cap_about(0.5, axis);
    return buffon_importance(out, &along, &g, run);
}

static buffon_status cosine_expectation(buffon_estimate *out, const buffon_run *run)
{
    const buffon_density g = buffon_hemisphere_cosine_about(axis);
    return buffon_expectation(out, &along, &g, run);
}

static void check_densities(void)
{
    const double area = 4 * LAW_PI, angle = LAW_PI;
    const repeats_trial disk = {.name = "importance, disk",
                                .run = disk_importance,
                                .stream = 8,
                                .samples = POINTS,
                                .components = 2,
                                .exact = {2 * area, area},
                                .variance = {area * area * 16 / 12 / POINTS, area * area / POINTS}};
    const repeats_trial cap = {.name = "importance, cap", /* z is uniform on (1/2, 1) */
                               .run = cap_importance,
                               .stream = 9,
                               .samples = POINTS,
                               .components = 2,
                               .exact = {0.75 * angle, 2 * (exp(1) - exp(0.5)) * angle},
                               .variance = {angle * angle / 48 / POINTS,
                                            angle * angle * exp_variance(0.5, 1) / POINTS}};
    const repeats_trial cosine = {.name = "expectation", /* z has the density 2 z on (0, 1) */
                                  .run = cosine_expectation,
                                  .stream = 10,
                                  .samples = POINTS,
                                  .components = 2,
                                  .exact = {2.0 / 3, 2},
                                  .variance = {1.0 / 18 / POINTS, ((exp(2) + 1) / 2 - 4) / POINTS}};
    repeats_check(&disk, SEEDS);
    repeats_check(&cap, SEEDS);
    repeats_check(&cosine, SEEDS);
}

static double exponential_quantile(double u, void *ctx)
{
    (void)ctx;
    return -log1p(-u);
}

static double exponential_pdf(double x, void *ctx)
{
    (void)ctx;
    return exp(-x);
}

static double root_scalar(const double *x, void *ctx)
{
    (void)ctx;
    return sqrt(x[0]) * exp(-x[0]);
}

static buffon_status root_inverse_cdf(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand f = {.scalar = root_scalar, .dim = 1};
    const buffon_inversion how = {.quantile = exponential_quantile, .pdf = exponential_pdf};
    return buffon_inverse_cdf(out, &f, &how, run);
}

static void check_inverse_cdf(void)
{
    const repeats_trial t = {.name = "inverse_cdf", /* f / g = sqrt x has Rayleigh's law */
                             .run = root_inverse_cdf,
                             .stream = 11,
                             .samples = POINTS,
                             .components = 1,
                             .exact = {sqrt(LAW_PI) / 2},
                             .variance = {(1 - LAW_PI / 4) / POINTS}};
    repeats_check(&t, SEEDS);
}

/* ---- self-normalised: x, and whether x < 1/2, under p = 7 exp x on (0, 1) ---- */

static int half_batch(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[i] = x[i];
        f[n + i] = x[i] < 0.5;
    }
    return 0;
}

static double seven_exp(const double *x, void *ctx)
{
    (void)ctx;
    return 7 * exp(x[0]);
}

static buffon_status half_self_normalised(buffon_estimate *out, const buffon_run *run)
{
    const buffon_integrand h = {.batch = half_batch, .dim = 1, .components = 2};
    const buffon_integrand p = {.scalar = seven_exp, .dim = 1};
    const buffon_density g = buffon_segment(0, 1);
    return buffon_self_normalised(out, &h, &p, &g, run);
}

/* To first order the variance is E w^2 (h - R)^2 / (E w)^2 / n, the bias - E w^2 (h - R) / (E w)^2
 * / n; what comes after is smaller by some ten parts in n. With w = exp x, E w^2 x = (e^2 + 1) / 4
 * and E w^2 x^2 = (e^2 - 1) / 4. */
static void check_self_normalised(void)
{
    const double ww = expm1(1) * expm1(1), w2 = expm1(2) / 2, low2 = expm1(1) / 2;
    const double x2 = (exp(2) + 1) / 4, r = 1 / expm1(1), s = expm1(0.5) / expm1(1);
    const repeats_trial t = {
        .name = "self_normalised",
        .run = half_self_normalised,
        .samples = POINTS,
        .components = 2,
        .exact = {r, s},
        .variance = {(expm1(2) / 4 - 2 * r * x2 + r * r * w2) / ww / POINTS,
                     (low2 * (1 - 2 * s) + s * s * w2) / ww / POINTS},
        .bias = {-(x2 - r * w2) / ww / POINTS, -(low2 - s * w2) / ww / POINTS},
        .slack = 10.0 / POINTS};
    repeats_check(&t, SEEDS);
}

/* ---- strata: exp on (0, 1), cut at 0.2 and 0.7 ---- */

static const double cuts[] = {0, 0.2, 0.7, 1};

static double exp_scalar(const double *x, void *ctx)
{
    (void)ctx;
    return exp(x[0]);
}

static buffon_status exp_stratified(buffon_estimate *out, int allocation, const buffon_run *run)
{
    const buffon_integrand f = {.scalar = exp_scalar, .dim = 1};
    buffon_density part[3];
    buffon_stratum stratum[3] = {{NULL, NULL, 0, 0, {0}}};
    for (size_t s = 0; s < 3; s++) {
        part[s] = buffon_segment(cuts[s], cuts[s + 1]);
        stratum[s].density = &part[s];
        stratum[s].share = cuts[s + 1] - cuts[s];
    }
    const buffon_strata strata = {
        .stratum = stratum, .count = 3, .allocation = allocation, .pilot = POINTS};
    return buffon_stratified(out, &f, &strata, run);
}

static buffon_status exp_proportional(buffon_estimate *out, const buffon_run *run)
{
    return exp_stratified(out, BUFFON_ALLOCATION_SHARE, run);
}

static buffon_status exp_neyman(buffon_estimate *out, const buffon_run *run)
{
    return exp_stratified(out, BUFFON_ALLOCATION_NEYMAN, run);
}

/* Neyman's shares keep a tenth of the old ones and follow the deviations that a pilot finds; these
 * scatter by a few hundredths, which moves the variance by less than a hundredth. */
static void check_stratified(void)
{
    double deviation[3], all = 0, proportional = 0, neyman = 0;
    for (size_t s = 0; s < 3; s++) {
        deviation[s] = (cuts[s + 1] - cuts[s]) * sqrt(exp_variance(cuts[s], cuts[s + 1]));
        all += deviation[s];
    }
    for (size_t s = 0; s < 3; s++) {
        const double share = cuts[s + 1] - cuts[s], square = deviation[s] * deviation[s];
        proportional += square / ceil(share * POINTS - 1e-9);
        neyman += square / ((0.1 * share + 0.9 * deviation[s] / all) * POINTS + 0.5);
    }
    const repeats_trial t = {.name = "stratified, proportional",
                             .run = exp_proportional,
                             .stream = 13,
                             .samples = POINTS,
                             .components = 1,
                             .exact = {expm1(1)},
                             .variance = {proportional}};
    repeats_trial best = t;
    best.name = "stratified, Neyman";
    best.stream = 14;
    best.run = exp_neyman;
    best.variance[0] = neyman;
    best.slack = 0.01;
    repeats_check(&t, SEEDS);
    repeats_check(&best, SEEDS);
}

int main(void)
{
    check_random();
    check_antithetic();
    check_jitter("jitter, 8 sweeps", 4, POINTS, 3);
    check_jitter("jitter, one sweep", 12, 288, 4);
    check_replicates();
    check_rejection();
    check_densities();
    check_inverse_cdf();
    check_self_normalised();
    check_stratified();
    return tap_done();
}
