/* buffon_verify_density: it finds the mistakes that people make, names the right check and a place,
 * and lets what is right pass, at the rate that it promises. */
#include <buffon/buffon.h>
#include <math.h>

#include "law.h"
#include "pvalue.h"
#include "tap.h"

/* ---- densities with a mistake each: a number in `param` says which ------------------------- */

enum disk_mistake {
    RIGHT,
    LINEAR_RADIUS, /* r = u */
    TWICE_ROUND,   /* the angle goes round twice */
    ONE_PERCENT,   /* pdf too large */
    ONE_PART_IN_1E4,
    WIDE_SUPPORT,   /* pdf positive in a ring outside */
    OTHER_PDF,      /* at a point, another than with it */
    MIRRORED,       /* way back */
    SHORT_WAY_BACK, /* the way back gives angles in (0, 1/2) */
    RIM_NAN,        /* no number at the outermost uniform */
    ZERO_PDF,       /* at the outermost uniform */
    OUTSIDE_CUBE    /* way back leads to uniforms of 1 and more */
};

static int disk_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const int mistake = (int)g->param[0];
    for (size_t i = 0; i < n; i++) {
        const double r = mistake == LINEAR_RADIUS ? u[i] : sqrt(u[i]);
        const double a = (mistake == TWICE_ROUND ? 4 : 2) * LAW_PI * u[n + i];
        x[i] = mistake == RIM_NAN && u[i] > 1 - 1e-15 ? NAN : r * cos(a);
        x[n + i] = r * sin(a);
        if (pdf)
            pdf[i] = (mistake == ONE_PERCENT       ? 1.01
                      : mistake == ONE_PART_IN_1E4 ? 1.0001
                      : mistake == ZERO_PDF        ? u[i] < 1 - 1e-15
                                                   : 1) /
                     LAW_PI;
    }
    return 0;
}

static int disk_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const int mistake = (int)g->param[0];
    const double edge = mistake == WIDE_SUPPORT ? 1.1 : 1 + 1e-12;
    const double factor = mistake == ONE_PERCENT || mistake == OTHER_PDF ? 1.01
                          : mistake == ONE_PART_IN_1E4                   ? 1.0001
                                                                         : 1;
    for (size_t i = 0; i < n; i++)
        pdf[i] = x[i] * x[i] + x[n + i] * x[n + i] <= edge ? factor / LAW_PI : 0;
    return 0;
}

static int disk_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const int mistake = (int)g->param[0];
    for (size_t i = 0; i < n; i++) {
        const double r2 = x[i] * x[i] + x[n + i] * x[n + i];
        double turn = atan2(x[n + i], x[i]) / (2 * LAW_PI);
        turn += turn < 0;
        u[i] = mistake == LINEAR_RADIUS ? sqrt(r2) : r2 < 1 - 1e-16 ? r2 : 1 - 1e-16;
        u[n + i] = mistake == MIRRORED         ? 1 - turn
                   : mistake == SHORT_WAY_BACK ? 0.5 * turn
                   : mistake == TWICE_ROUND    ? 0.5 * turn
                                               : turn;
        u[n + i] += mistake == OUTSIDE_CUBE;
    }
    return 0;
}

static const buffon_density_ops disk_ops = {
    .sample = disk_draw, .pdf = disk_pdf, .invert = disk_invert, .name = "disk"};
static const buffon_density_ops one_way_ops = {
    .sample = disk_draw, .pdf = disk_pdf, .name = "disk, one way"};

static buffon_density disk_of(const buffon_density_ops *ops, int mistake)
{
    return (buffon_density){.uniforms = 2, .dim = 2, .ops = ops, .param = {mistake}};
}

/* Directions: z is made from u by one rule, and the pdf says uniform. */
enum sphere_mistake { EVEN_ANGLES = 1, HALF_SPHERE, COSINE };

static int sphere_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const int mistake = (int)g->param[0];
    for (size_t i = 0; i < n; i++) {
        const double z = mistake == EVEN_ANGLES   ? cos(LAW_PI * u[i])
                         : mistake == HALF_SPHERE ? 1 - u[i]
                         : mistake == COSINE      ? sqrt(u[i])
                                                  : 1 - 2 * u[i];
        const double s = sqrt(1 - z * z), a = 2 * LAW_PI * u[n + i];
        x[i] = s * cos(a);
        x[n + i] = s * sin(a);
        x[2 * n + i] = z;
        if (pdf)
            pdf[i] = 1 / (4 * LAW_PI);
    }
    return 0;
}

static int sphere_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++)
        pdf[i] = x[i] == x[i] ? 1 / (4 * LAW_PI) : 0;
    return 0;
}

static const buffon_density_ops sphere_ops = {
    .sample = sphere_draw, .pdf = sphere_pdf, .name = "sphere"};

/* A normal of spread param[0] that says it has spread 1, by two uniforms. */
static int normal_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        x[i] = g->param[0] * sqrt(-2 * log(u[i])) * cos(2 * LAW_PI * u[n + i]) + g->param[1];
        if (pdf)
            pdf[i] = exp(-0.5 * x[i] * x[i]) / sqrt(2 * LAW_PI);
    }
    return 0;
}

static int normal_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++)
        pdf[i] = exp(-0.5 * x[i] * x[i]) / sqrt(2 * LAW_PI);
    return 0;
}

static const buffon_density_ops normal_ops = {
    .sample = normal_draw, .pdf = normal_pdf, .name = "normal"};

static buffon_density normal_of(double spread, double shift)
{
    return (buffon_density){.uniforms = 2, .dim = 1, .ops = &normal_ops, .param = {spread, shift}};
}

/* A die of six sides, thrown as if it had param[0], which says that each has param[1]. */
static int die_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        x[i] = 1 + floor(g->param[0] * u[i]) + g->param[2];
        if (pdf)
            pdf[i] = g->param[1];
    }
    return 0;
}

static int die_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        pdf[i] = (x[i] >= 1 && x[i] < 7 && (x[i] == floor(x[i]) || g->param[2] != 0)) || x[i] > 1e19
                     ? g->param[1]
                     : 0;
    return 0;
}

static const buffon_density_ops die_ops = {.sample = die_draw, .pdf = die_pdf, .name = "die"};

static buffon_density die_of(double sides, double p, double shift)
{
    return (buffon_density){.uniforms = 1, .dim = 1, .ops = &die_ops, .param = {sides, p, shift}};
}

/* ---- they are found -------------------------------------------------------------------------- */

static const buffon_verification *const plain = NULL;

static void finds(buffon_density g, const buffon_verification *how, buffon_verify_check check,
                  const char *what)
{
    buffon_verify_report r;
    const buffon_status status = buffon_verify_density(&r, &g, how);
    if (!tap_ok(status == BUFFON_E_LAW && r.status == status && r.check == check &&
                    r.item[check].failed && r.item[check].looked,
                "found: %s", what))
        tap_note("%s: %s", buffon_status_string(status), buffon_verify_string(r.check));
}

static void passes(buffon_density g, const buffon_verification *how, buffon_status wanted,
                   const char *what)
{
    buffon_verify_report r;
    const buffon_status status = buffon_verify_density(&r, &g, how);
    int failed = 0;
    for (size_t k = 0; k < BUFFON_VERIFY_CHECKS; k++)
        failed |= r.item[k].failed;
    if (!tap_ok(status == wanted && r.check == BUFFON_VERIFY_CHECKS && !failed && r.u[0] != r.u[0],
                "passes: %s", what))
        tap_note("%s: %s", buffon_status_string(status), buffon_verify_string(r.check));
}

static void answers(buffon_status got, buffon_status wanted, const char *what)
{
    if (!tap_ok(got == wanted, "%s: %s", what, buffon_status_name(wanted)))
        tap_note("got %s", buffon_status_name(got));
}

static void test_one_to_one(void)
{
    passes(disk_of(&disk_ops, RIGHT), plain, BUFFON_OK, "a disk");
    finds(disk_of(&disk_ops, LINEAR_RADIUS), plain, BUFFON_VERIFY_STRETCH, "r = u");
    finds(disk_of(&disk_ops, TWICE_ROUND), plain, BUFFON_VERIFY_INVERSE, "twice round");
    finds(disk_of(&disk_ops, ONE_PERCENT), plain, BUFFON_VERIFY_STRETCH, "a pdf 1 % off");
    finds(disk_of(&disk_ops, ONE_PART_IN_1E4), plain, BUFFON_VERIFY_STRETCH, "a pdf 1e-4 off");
    finds(disk_of(&disk_ops, WIDE_SUPPORT), plain, BUFFON_VERIFY_SUPPORT, "too wide a support");
    finds(disk_of(&disk_ops, OTHER_PDF), plain, BUFFON_VERIFY_PDF, "two pdfs");
    finds(disk_of(&disk_ops, MIRRORED), plain, BUFFON_VERIFY_INVERSE, "a mirrored way back");
    finds(disk_of(&disk_ops, SHORT_WAY_BACK), plain, BUFFON_VERIFY_INVERSE, "half a way back");
    finds(disk_of(&disk_ops, OUTSIDE_CUBE), plain, BUFFON_VERIFY_INVERSE, "uniforms above 1");
    finds(disk_of(&disk_ops, RIM_NAN), plain, BUFFON_VERIFY_POINTS, "a point that is NaN");
    finds(disk_of(&disk_ops, ZERO_PDF), plain, BUFFON_VERIFY_POINTS, "a point of pdf 0");
}

static void test_one_way(void)
{
    const buffon_verification more = {.samples = 1 << 18};
    passes(disk_of(&one_way_ops, RIGHT), plain, BUFFON_OK, "a disk without a way back");
    finds(disk_of(&one_way_ops, LINEAR_RADIUS), plain, BUFFON_VERIFY_CELLS, "r = u, one way");
    finds(disk_of(&one_way_ops, ONE_PERCENT), &more, BUFFON_VERIFY_TOTAL, "a pdf 1 % off");
    finds(disk_of(&one_way_ops, WIDE_SUPPORT), plain, BUFFON_VERIFY_TOTAL, "too wide a support");
    passes(normal_of(1, 0), plain, BUFFON_OK, "a normal");
    finds(normal_of(1.05, 0), plain, BUFFON_VERIFY_CELLS, "a spread 5 % off");
    finds(normal_of(1, 0.05), plain, BUFFON_VERIFY_CELLS, "a mean 0.05 off");
    const buffon_density right = {.uniforms = 2, .dim = 3, .ops = &sphere_ops};
    passes(right, plain, BUFFON_OK, "a sphere");
    for (int mistake = EVEN_ANGLES; mistake <= COSINE; mistake++) {
        buffon_density wrong = right;
        wrong.param[0] = mistake;
        finds(wrong, plain, mistake == COSINE ? BUFFON_VERIFY_TOTAL : BUFFON_VERIFY_CELLS,
              mistake == EVEN_ANGLES   ? "even angles on a sphere"
              : mistake == HALF_SPHERE ? "half a sphere"
                                       : "cosines for a uniform sphere");
    }
}

static void test_discrete(void)
{
    const buffon_verification whole = {.discrete = 1};
    passes(die_of(6, 1.0 / 6, 0), &whole, BUFFON_OK, "a die");
    finds(die_of(6, 1.0 / 6, 0.5), &whole, BUFFON_VERIFY_POINTS, "halves of points");
    finds(die_of(5.9, 1.0 / 6, 0), &whole, BUFFON_VERIFY_CELLS, "a loaded die");
    finds(die_of(6, 0.17, 0), &whole, BUFFON_VERIFY_TOTAL, "probabilities that sum to 1.02");
    finds(die_of(6, 0.16, 0), &whole, BUFFON_VERIFY_TOTAL, "probabilities that sum to 0.96");
    passes(die_of(6, 1.0 / 6, 1e20), &whole, BUFFON_W_UNSEEN,
           "numbers beyond those that doubles tell apart");
    const double lo[2] = {0, 0}, hi[2] = {1, 1};
    const buffon_density square = buffon_box(lo, hi, 2);
    buffon_verify_report r;
    answers(buffon_verify_density(&r, &square, &whole), BUFFON_E_DIM, "pairs of whole numbers");
}

/* The place of a mistake: uniforms and point, of which the one makes the other. */
static void test_place(void)
{
    const buffon_density g = disk_of(&disk_ops, ONE_PERCENT);
    buffon_verify_report r;
    double x[2], u[2];
    const int found = buffon_verify_density(&r, &g, NULL) == BUFFON_E_LAW;
    u[0] = r.u[0];
    u[1] = r.u[1];
    tap_ok(found && buffon_density_sample(x, NULL, u, 1, &g) == BUFFON_OK && x[0] == r.x[0] &&
               x[1] == r.x[1] && r.u[2] != r.u[2] && r.x[2] != r.x[2],
           "the place: uniforms, and the point they make");
}

/* p-values of right densities over seeds: with four statistics of a normal without a way back, the
 * corrected one is below 1/10 in at most a tenth of them. */
static void test_rate(void)
{
    const buffon_density g = normal_of(1, 0), disk = disk_of(&one_way_ops, RIGHT);
    double low = 0, failed = 0, runs = 200;
    for (int seed = 0; seed < runs; seed++) {
        const buffon_verification how = {.samples = 1 << 13, .seed = 1000 + (uint64_t)seed};
        buffon_verify_report r;
        failed += buffon_verify_density(&r, seed % 2 ? &g : &disk, &how) != BUFFON_OK;
        low += r.p_value < 0.1;
    }
    tap_ok(failed == 0, "200 seeds, none fails");
    tap_ok(low <= 0.1 * runs + 6 * sqrt(0.09 * runs), "p below 1/10 in a tenth of them at most");
    tap_note("%g of %g", low, runs);
}

/* A pdf that ends in a jump, anywhere in a cell. */
static void test_jumps(void)
{
    int passed = 0;
    for (int k = 0; k < 50; k++) {
        const buffon_density g = buffon_power(0.5 + 0.05 * k, 0, 1 + 0.01 * k);
        const buffon_verification how = {.samples = 1 << 14, .seed = (uint64_t)k};
        buffon_verify_report r;
        passed += buffon_verify_density(&r, &g, &how) == BUFFON_OK;
    }
    tap_ok(passed == 50, "fifty pdfs that end in a jump pass");
    tap_note("%d of 50", passed);
}

/* A surface needs `over`: a flat square in space. */
static void test_over(void)
{
    const double lo[2] = {0, 0}, hi[2] = {1, 1};
    const buffon_density square = buffon_box(lo, hi, 2), wide = buffon_disk(3);
    const buffon_verification how = {.over = &wide};
    passes(square, &how, BUFFON_OK, "a square under a disk");
    const buffon_density line = buffon_normal(0, 1);
    const buffon_verification other = {.over = &line};
    buffon_verify_report r;
    answers(buffon_verify_density(&r, &square, &other), BUFFON_E_DIM,
            "`over` of another dimension");
}

static int near(double p, double wanted)
{
    return fabs(p / wanted - 1) < 1e-6;
}

/* Published points of the laws, and this suite's own functions. */
static void test_probabilities(void)
{
    int same = 1;
    for (double dof = 1; dof < 5000; dof *= 1.7) {
        for (double x = dof / 4; x < 4 * dof; x *= 1.3) {
            const double p = buffon_priv_p_chi_square(x, dof), other = law_chi_square(x, dof);
            same &= fabs(p - other) <= 1e-9 * other + 1e-14;
        }
    }
    for (double d = 0.001; d < 0.1; d *= 1.1) {
        const double p = buffon_priv_p_kolmogorov(d, 1000), other = law_kolmogorov(d, 1000);
        same &= fabs(p - other) <= 1e-12 || (p == 1 && other > 1 - 1e-9);
    }
    tap_ok(same, "p-values as the tests have them");
    tap_ok(near(buffon_priv_p_chi_square(3.841458820694124, 1), 0.05) &&
               near(buffon_priv_p_chi_square(124.3421134004004, 100), 0.05) &&
               near(buffon_priv_p_normal(1.959963984540054), 0.05),
           "and as they are in tables");
}

static void test_refused(void)
{
    const buffon_density g = buffon_sphere(), none = buffon_disk(-1);
    const buffon_verification few = {.samples = 100}, tolerance = {.tolerance = -1},
                              alpha = {.alpha = 2}, reserved = {.reserved = {1}},
                              nan = {.tolerance = NAN}, covered = {.over = &none};
    buffon_verify_report r;
    answers(buffon_verify_density(NULL, &g, NULL), BUFFON_E_NULL, "no report");
    answers(buffon_verify_density(&r, NULL, NULL), BUFFON_E_NULL, "no density");
    answers(buffon_verify_density(&r, &none, NULL), BUFFON_E_SHAPE, "a density that is none");
    answers(buffon_verify_density(&r, &g, &covered), BUFFON_E_SHAPE, "an `over` that is none");
    answers(buffon_verify_density(&r, &g, &few), BUFFON_E_SAMPLES, "100 samples");
    answers(buffon_verify_density(&r, &g, &tolerance), BUFFON_E_TOLERANCE, "tolerance < 0");
    answers(buffon_verify_density(&r, &g, &nan), BUFFON_E_TOLERANCE, "tolerance NaN");
    answers(buffon_verify_density(&r, &g, &alpha), BUFFON_E_CONFIDENCE, "alpha = 2");
    answers(buffon_verify_density(&r, &g, &reserved), BUFFON_E_RESERVED, "reserved words");
    tap_ok(r.status == BUFFON_E_RESERVED && r.check == BUFFON_VERIFY_CHECKS && r.p_value == 1 &&
               r.u[0] != r.u[0] && !r.item[0].looked,
           "the report of a refused call is defined");
    tap_ok(strcmp(buffon_verify_string(BUFFON_VERIFY_CHECKS), "nothing is wrong") == 0 &&
               strcmp(buffon_verify_string((buffon_verify_check)99), "unknown check") == 0,
           "sentences for every value");
}

int main(void)
{
    test_one_to_one();
    test_one_way();
    test_discrete();
    test_place();
    test_rate();
    test_jumps();
    test_over();
    test_probabilities();
    test_refused();
    return tap_done();
}
