/* Quantiles and intervals: against 20-digit references, against exact sums, symmetries, refusals,
 * and the bits themselves. */
#include <buffon/interval.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "incomplete.h"
#include "quantile.h"
#include "tap.h"

#ifndef BUFFON_TEST_DATA
#define BUFFON_TEST_DATA "tests/data"
#endif

#define TEST_TOLERANCE 1e-12
#define TEST_FIELDS 6

/* ---- tables ------------------------------------------------------------------------------- */

static FILE *test_open(const char *name)
{
    char path[1024];
    FILE *file;
    snprintf(path, sizeof path, "%s/%s", BUFFON_TEST_DATA, name);
    file = fopen(path, "r");
    if (file == NULL) {
        tap_ok(0, "%s can be read", path);
    }
    return file;
}

/* The next line, cut at its commas; missing fields are empty. */
static int test_row(char *field[TEST_FIELDS], char *line, int size, FILE *file)
{
    int i;
    if (fgets(line, size, file) == NULL) {
        return 0;
    }
    line[strcspn(line, "\r\n")] = '\0';
    for (i = 0; i < TEST_FIELDS; i++) {
        field[i] = line;
        line += strcspn(line, ",");
        if (*line != '\0') {
            *line++ = '\0';
        }
    }
    return 1;
}

/* The number after `name=` in a list such as k=0;n=1. */
static double test_input(const char *list, const char *name)
{
    const char *at = list;
    const size_t length = strlen(name);
    while (strncmp(at, name, length) != 0 || at[length] != '=') {
        at = strchr(at, ';');
        if (at == NULL) {
            return NAN;
        }
        at++;
    }
    return strtod(at + length + 1, NULL);
}

static double test_error(double got, double want)
{
    const double error = want == 0 ? fabs(got) : fabs(got / want - 1);
    return isnan(error) ? HUGE_VAL : error;
}

/* ---- against the references --------------------------------------------------------------- */

static double test_quantile(const char *function, char **field)
{
    const double a1 = strtod(field[1], NULL), a2 = strtod(field[2], NULL);
    if (strcmp(function, "norm_quantile") == 0) {
        return buffon_normal_quantile(a1);
    }
    if (strcmp(function, "t_upper_quantile") == 0) {
        return buffon_student_upper(a1, a2);
    }
    return buffon_beta_quantile(a1, a2, strtod(field[3], NULL));
}

static void test_quantiles(const char *name, const char *function, int least)
{
    char line[512], *field[TEST_FIELDS], where[128] = "";
    double worst = 0;
    int rows = 0;
    FILE *file = test_open(name);
    if (file == NULL) {
        return;
    }
    while (test_row(field, line, sizeof line, file)) {
        if (strcmp(field[0], function) == 0) {
            const double error = test_error(test_quantile(function, field), strtod(field[4], NULL));
            rows++;
            if (error >= worst) {
                worst = error;
                snprintf(where, sizeof where, "%s %s %s", field[1], field[2], field[3]);
            }
        }
    }
    fclose(file);
    tap_ok(rows >= least && worst <= TEST_TOLERANCE, "%s of %s: %d rows, at most %.2g (at %s)",
           function, name, rows, worst, where);
}

static buffon_status test_interval_row(double *lo, double *hi, const char *method, const char *in)
{
    const double confidence = test_input(in, "conf"), n = test_input(in, "n");
    if (strcmp(method, "clopper_pearson") == 0) {
        return buffon_interval_clopper_pearson(lo, hi, (uint64_t)test_input(in, "k"), (uint64_t)n,
                                               confidence);
    }
    if (strcmp(method, "wilson") == 0) {
        return buffon_interval_wilson(lo, hi, (uint64_t)test_input(in, "k"), (uint64_t)n,
                                      confidence);
    }
    return buffon_interval_normal(lo, hi, test_input(in, "mean"), test_input(in, "sd") / sqrt(n),
                                  confidence);
}

static void test_intervals(const char *method, int least)
{
    char line[512], *field[TEST_FIELDS], where[128] = "";
    double worst = 0;
    int rows = 0, refused = 0;
    FILE *file = test_open("ci_reference.csv");
    if (file == NULL) {
        return;
    }
    while (test_row(field, line, sizeof line, file)) {
        if (strcmp(field[0], method) == 0) {
            double lo, hi, error;
            refused += test_interval_row(&lo, &hi, method, field[1]) != BUFFON_OK;
            error = fmax(test_error(lo, strtod(field[2], NULL)),
                         test_error(hi, strtod(field[3], NULL)));
            rows++;
            if (error >= worst) {
                worst = error;
                snprintf(where, sizeof where, "%s", field[1]);
            }
        }
    }
    fclose(file);
    tap_ok(rows >= least && refused == 0 && worst <= TEST_TOLERANCE,
           "%s: %d rows, at most %.2g (at %s)", method, rows, worst, where);
}

/* ---- against closed forms and exact sums -------------------------------------------------- */

/* P(at least k hits of n) with probability p of each. */
static double test_binomial(int k, int n, double p)
{
    double term = pow(1 - p, n - k), sum = 0;
    int i;
    for (i = 1; i <= k; i++) {
        term *= (n - k + i) * p / i;
    }
    for (i = k; i <= n; i++) {
        sum += term;
        term *= (double)(n - i) / (i + 1) * (p / (1 - p));
    }
    return sum;
}

/* Near 1 the double `hi` itself is too coarse; the mirrored interval is checked there. */
static void test_exact_binomial(void)
{
    static const double confidences[] = {0.02, 0.5, 0.95, 0.9999};
    double worst = 0;
    int n, k, c;
    for (n = 1; n <= 60; n++) {
        for (k = 0; k <= n; k++) {
            for (c = 0; c < 4; c++) {
                const double miss = 0.5 * (1 - confidences[c]);
                double lo, hi, error = 0;
                if (buffon_interval_clopper_pearson(&lo, &hi, (uint64_t)k, (uint64_t)n,
                                                    confidences[c]) != BUFFON_OK) {
                    error = HUGE_VAL;
                }
                if (k > 0) {
                    error = fmax(error, test_error(test_binomial(k, n, lo), miss));
                }
                if (k < n && hi < 0.99) {
                    error = fmax(error, test_error(test_binomial(n - k, n, 1 - hi), miss));
                }
                worst = fmax(worst, error);
            }
        }
    }
    tap_ok(worst <= 2e-12, "Clopper-Pearson up to n = 60 solves the binomial sums: %.2g", worst);
}

/* k - n p = -+ z sqrt(n p (1 - p)) at both ends. */
static void test_wilson(void)
{
    static const double confidences[] = {1e-6, 0.5, 0.95, 1 - 0x1p-50};
    double worst = 0;
    int n, k, c, outside = 0;
    for (n = 1; n <= 60; n++) {
        for (k = 0; k <= n; k++) {
            for (c = 0; c < 4; c++) {
                const double z = buffon_priv_normal_two_sided(1 - confidences[c]);
                double lo, hi;
                outside += buffon_interval_wilson(&lo, &hi, (uint64_t)k, (uint64_t)n,
                                                  confidences[c]) != BUFFON_OK;
                outside += !(0 <= lo && lo <= hi && hi <= 1) || (k == 0 && lo != 0) ||
                           (k == n && hi != 1);
                if (k > 0 && c > 0) {
                    worst = fmax(worst, test_error((k - n * lo) / sqrt(n * lo * (1 - lo)), z));
                }
                if (k < n && c > 0 && hi < 0.99) {
                    worst = fmax(worst, test_error((n * hi - k) / sqrt(n * hi * (1 - hi)), z));
                }
            }
        }
    }
    tap_ok(outside == 0, "Wilson's interval lies in [0, 1], exactly 0 and 1 at the ends");
    tap_ok(worst <= 1e-13, "Wilson's interval solves its equation: %.2g", worst);
}

static void test_student_closed(void)
{
    double worst_1 = 0, worst_2 = 0, q;
    for (q = 1e-3; q < 0.5; q += 1e-3) {
        const double w = 4 * q * (1 - q), alpha = ldexp(q, -900);
        worst_1 = fmax(worst_1, test_error(buffon_student_upper(q, 1), 1 / tan(acos(-1) * q)));
        worst_1 = fmax(worst_1, test_error(buffon_student_upper(alpha, 1), 1 / (acos(-1) * alpha)));
        worst_2 = fmax(worst_2, test_error(buffon_student_upper(q, 2), (1 - 2 * q) * sqrt(2 / w)));
        worst_2 = fmax(worst_2, test_error(buffon_student_upper(alpha, 2), sqrt(0.5 / alpha)));
    }
    tap_ok(worst_1 <= TEST_TOLERANCE, "t with 1 degree of freedom is a tangent: %.2g", worst_1);
    tap_ok(worst_2 <= TEST_TOLERANCE, "t with 2 degrees of freedom is algebraic: %.2g", worst_2);
}

/* Far out P(T > t) = Gamma((v + 1) / 2) / (Gamma(v / 2) sqrt(pi v)) v^((v - 1) / 2) t^-v. */
static void test_student_far(void)
{
    static const double dofs[] = {1.2, 1.5, 2.5, 3, 4.75, 9};
    double worst = 0;
    int i;
    for (i = 0; i < 6; i++) {
        const double v = dofs[i], q = i < 3 ? 1e-300 : 1e-150;
        const double front = tgamma(0.5 * v + 0.5) / (tgamma(0.5 * v) * sqrt(acos(-1) * v));
        const double want = pow(front / q, 1 / v) * pow(v, 0.5 - 0.5 / v);
        worst = fmax(worst, test_error(buffon_student_upper(q, v), want));
    }
    tap_ok(worst <= TEST_TOLERANCE, "the far tail of t is a power: %.2g", worst);
}

/* The series in 1 / dof and the beta quantile meet. */
static void test_student_seam(void)
{
    static const double tails[] = {1e-300, 1e-100, 1e-12, 1e-3, 0.1, 0.16, 0.4, 0.49999};
    double worst = 0, dof;
    int i;
    for (dof = 1000; dof < 1e6; dof *= 1.37) {
        for (i = 0; i < 8; i++) {
            const double alpha = 2 * tails[i];
            buffon_priv_beta law;
            buffon_priv_beta_make(&law, 0.5, 0.5 * dof);
            const double mu = buffon_priv_beta_quantile(&law, 1 - alpha, alpha, NAN).mu;
            worst = fmax(worst, test_error(buffon_student_upper(tails[i], dof), exp(0.5 * mu)));
        }
    }
    tap_ok(worst <= TEST_TOLERANCE, "both ways to t agree from 1000 to 1e6: %.2g", worst);
}

/* a = 1/2 = b is the arcsine law; b = 1 or a = 1 are powers. */
static void test_beta_closed(void)
{
    double worst = 0, p;
    for (p = 1e-3; p < 1; p += 1e-3) {
        const double s = sin(0.5 * acos(-1) * p);
        worst = fmax(worst, test_error(buffon_beta_quantile(p, 0.5, 0.5), s * s));
        worst = fmax(worst, test_error(buffon_beta_quantile(p, 0.25, 1), p * p * p * p));
        worst = fmax(worst, test_error(buffon_beta_quantile(p, 1, 1), p));
        worst = fmax(worst, test_error(buffon_beta_quantile(p, 1, 1e10), -expm1(log1p(-p) / 1e10)));
    }
    tap_ok(worst <= TEST_TOLERANCE, "beta quantiles with a closed form: %.2g", worst);
}

/* ---- symmetries and ends ------------------------------------------------------------------ */

static void test_symmetry(void)
{
    static const uint64_t sizes[] = {1, 7, 100, 5000, 1000000, UINT64_C(1000000000000)};
    int wrong = 0, narrow = 0, i, j;
    for (i = 0; i < 6; i++) {
        double last_lo = -1, last_hi = -1;
        for (j = 0; j <= 8; j++) {
            const uint64_t n = sizes[i], k = n / 8 * (uint64_t)j + (j == 8 ? n % 8 : 0);
            double lo, hi, mirrored_lo, mirrored_hi;
            buffon_priv_clopper_pearson(&lo, &hi, k, n, 0.05);
            buffon_priv_clopper_pearson(&mirrored_lo, &mirrored_hi, n - k, n, 0.05);
            wrong += fabs(lo + mirrored_hi - 1) > 1e-15 || fabs(hi + mirrored_lo - 1) > 1e-15;
            wrong += (k == 0 && lo != 0) || (k == n && hi != 1);
            narrow += !(lo <= (double)k / (double)n && hi >= (double)k / (double)n);
            wrong += n > 7 && !(lo > last_lo && hi > last_hi);
            last_lo = lo;
            last_hi = hi;
        }
    }
    tap_ok(wrong == 0, "Clopper-Pearson: mirrored, growing with k, exactly 0 and 1 at the ends");
    tap_ok(narrow == 0, "Clopper-Pearson holds k/n");
    tap_ok(buffon_student_upper(0.7, 3) == -buffon_student_upper(1 - 0.7, 3) &&
               buffon_student_upper(0.5, 3) == 0 && buffon_student_upper(0, 3) == INFINITY &&
               buffon_student_upper(1, 3) == -INFINITY,
           "t is odd about 1/2, and infinite at 0 and 1");
    tap_ok(buffon_student_upper(0.025, INFINITY) == -buffon_normal_quantile(0.025) &&
               buffon_student_upper(0.025, 1e300) == -buffon_normal_quantile(0.025),
           "t with infinitely many degrees of freedom is normal");
    tap_ok(buffon_student_upper(0.3, 1e-3) > 1e219 && buffon_student_upper(0.3, 1e-5) == INFINITY &&
               buffon_student_upper(0.3, 1e-310) == INFINITY,
           "t with next to no degrees of freedom leaves the doubles");
    tap_ok(buffon_student_upper(0x1.d99dd427390afp-2, 0x1.c2000950603edp-59) == INFINITY &&
               buffon_student_upper(0.4, 1e-12) == INFINITY &&
               buffon_student_upper(0.5 - 1e-10, 1e-12) > 1e30,
           "nor does it lose its way there");
    tap_ok(buffon_beta_quantile(0, 2, 3) == 0 && buffon_beta_quantile(1, 2, 3) == 1, "beta ends");
}

static void test_tiny_alpha(void)
{
    double worst = 0, lo, hi;
    buffon_priv_clopper_pearson(&lo, &hi, 0, 1000, 1e-200);
    worst = fmax(worst, test_error(hi, 1 - pow(5e-201, 1e-3)));
    buffon_priv_clopper_pearson(&lo, &hi, 1, 1000, 1e-200);
    worst = fmax(worst, test_error(lo, 5e-204));
    worst = fmax(worst, test_error(buffon_priv_normal_two_sided(2e-300), 37.047096299361199237));
    worst = fmax(worst, test_error(buffon_priv_normal_two_sided(0.5), 0.6744897501960817432));
    worst = fmax(worst, test_error(buffon_priv_student_two_sided(2e-12, 100),
                                   buffon_student_upper(1e-12, 100)));
    worst = fmax(worst, test_error(buffon_priv_student_two_sided(1e-200, 1), 2e200 / acos(-1)));
    tap_ok(worst <= TEST_TOLERANCE, "a tiny miss probability is not lost: %.2g", worst);
    buffon_priv_clopper_pearson(&lo, &hi, UINT64_MAX / 2, UINT64_MAX, 0.05);
    tap_ok(lo < 0.5 && hi > 0.5 && hi - lo < 1e-9, "n = 2^64 - 1");
}

/* ---- refusals ----------------------------------------------------------------------------- */

static void test_nan(void)
{
    static const double bad[] = {-DBL_MIN, 1 + DBL_EPSILON, INFINITY, -INFINITY, NAN};
    int wrong = 0, i;
    for (i = 0; i < 5; i++) {
        wrong += !isnan(buffon_normal_quantile(bad[i]));
        wrong += !isnan(buffon_student_upper(bad[i], 3));
        wrong += !isnan(buffon_beta_quantile(bad[i], 2, 3));
    }
    wrong += !isnan(buffon_student_upper(0.1, 0)) || !isnan(buffon_student_upper(0.1, -1)) ||
             !isnan(buffon_student_upper(0.1, NAN));
    wrong += !isnan(buffon_beta_quantile(0.1, 0, 1)) || !isnan(buffon_beta_quantile(0.1, 1, 0)) ||
             !isnan(buffon_beta_quantile(0.1, -1, 1)) ||
             !isnan(buffon_beta_quantile(0.1, NAN, 1)) ||
             !isnan(buffon_beta_quantile(0.1, 1, INFINITY));
    wrong += !isnan(buffon_beta_quantile(0.1, 1e-17, 2)) ||
             !isnan(buffon_beta_quantile(0.1, 2, 1e31));
    tap_ok(wrong == 0, "arguments outside give NaN");
}

/* Whether a call returned `want` and, as it is an error, left NaN in both outputs. */
static int test_refused(buffon_status got, buffon_status want, const double *lo, const double *hi)
{
    return got == want && isnan(*lo) && isnan(*hi);
}

/* Where the quantile is 0 or infinite, and where rounding leads past 1. */
static void test_extremes(void)
{
    const uint64_t n = UINT64_C(1) << 53;
    double lo, hi;
    int good = buffon_interval_student(&lo, &hi, 2, 0, 1e-17, 0.95) == BUFFON_OK;
    tap_ok(good && lo == 2 && hi == 2, "no error is none at any quantile");
    good = buffon_interval_normal(&lo, &hi, 2, INFINITY, DBL_TRUE_MIN) == BUFFON_OK;
    tap_ok(good && lo == -INFINITY && hi == INFINITY, "an infinite error is infinite at any");
    good = buffon_interval_wilson(&lo, &hi, 0, 10, 1e-300) == BUFFON_OK;
    tap_ok(good && lo == 0 && hi >= 0, "Wilson: no hits, no confidence");
    good = buffon_interval_wilson(&lo, &hi, n - 1, n, 1 - 0x1p-53) == BUFFON_OK;
    tap_ok(good && lo < 1 && hi <= 1, "Wilson: never above 1");
}

static void test_statuses(void)
{
    static const double confidences[] = {0, 1, -0.1, 1.5, NAN, INFINITY};
    double lo = 0, hi = 0;
    int good = 1, i;
    for (i = 0; i < 6; i++) {
        const double c = confidences[i];
        const buffon_status want = BUFFON_E_CONFIDENCE;
        lo = hi = 0;
        good &= test_refused(buffon_interval_normal(&lo, &hi, 0, 1, c), want, &lo, &hi);
        lo = hi = 0;
        good &= test_refused(buffon_interval_student(&lo, &hi, 0, 1, 3, c), want, &lo, &hi);
        lo = hi = 0;
        good &= test_refused(buffon_interval_clopper_pearson(&lo, &hi, 1, 2, c), want, &lo, &hi);
        lo = hi = 0;
        good &= test_refused(buffon_interval_wilson(&lo, &hi, 1, 2, c), want, &lo, &hi);
    }
    tap_ok(good, "a confidence outside (0, 1) is refused, the outputs are NaN");

    good = buffon_interval_normal(NULL, &hi, 0, 1, 0.9) == BUFFON_E_NULL && isnan(hi);
    good &= buffon_interval_normal(&lo, NULL, 0, 1, 0.9) == BUFFON_E_NULL && isnan(lo);
    good &= buffon_interval_student(NULL, NULL, 0, 1, 3, 0.9) == BUFFON_E_NULL;
    good &= buffon_interval_clopper_pearson(NULL, &hi, 1, 2, 0.9) == BUFFON_E_NULL;
    good &= buffon_interval_wilson(&lo, NULL, 1, 2, 0.9) == BUFFON_E_NULL;
    tap_ok(good, "NULL is refused, the other output is NaN");

    good = test_refused(buffon_interval_normal(&lo, &hi, NAN, 1, 0.9), BUFFON_E_SHAPE, &lo, &hi);
    good &= test_refused(buffon_interval_normal(&lo, &hi, HUGE_VAL, 1, 0.9), BUFFON_E_SHAPE, &lo,
                         &hi);
    good &= test_refused(buffon_interval_normal(&lo, &hi, 0, -1, 0.9), BUFFON_E_SHAPE, &lo, &hi);
    good &= test_refused(buffon_interval_normal(&lo, &hi, 0, NAN, 0.9), BUFFON_E_SHAPE, &lo, &hi);
    good &= test_refused(buffon_interval_student(&lo, &hi, 0, 1, 0, 0.9), BUFFON_E_SHAPE, &lo, &hi);
    good &= test_refused(buffon_interval_student(&lo, &hi, 0, 1, NAN, 0.9), BUFFON_E_SHAPE, &lo,
                         &hi);
    tap_ok(good, "a mean, error or degree of freedom without sense is refused");

    good = test_refused(buffon_interval_clopper_pearson(&lo, &hi, 0, 0, 0.9), BUFFON_E_SAMPLES,
                        &lo, &hi);
    good &= test_refused(buffon_interval_clopper_pearson(&lo, &hi, 3, 2, 0.9), BUFFON_E_SAMPLES,
                         &lo, &hi);
    good &= test_refused(buffon_interval_wilson(&lo, &hi, 0, 0, 0.9), BUFFON_E_SAMPLES, &lo, &hi);
    good &= test_refused(buffon_interval_wilson(&lo, &hi, 3, 2, 0.9), BUFFON_E_SAMPLES, &lo, &hi);
    tap_ok(good, "no samples, or more hits than samples, are refused");

    good = buffon_interval_normal(&lo, &hi, 5, 0, 0.9) == BUFFON_OK && lo == 5 && hi == 5;
    good &= buffon_interval_normal(&lo, &hi, 5, INFINITY, 0.9) == BUFFON_OK && lo == -INFINITY &&
            hi == INFINITY;
    good &= buffon_interval_student(&lo, &hi, 0, 1, 10, 0.95) == BUFFON_OK && hi == -lo &&
            test_error(hi, 2.2281388519862742245) < 1e-12;
    good &= buffon_interval_normal(&lo, &hi, 0, 1, 1e-200) == BUFFON_OK &&
            test_error(hi, 1e-200 * sqrt(acos(-1) / 2)) < 1e-12;
    tap_ok(good, "an error of zero or infinity, and the tiniest confidence, are served");
}

/* ---- frozen bits -------------------------------------------------------------------------- */

static uint64_t test_hash(uint64_t hash, double x)
{
    return (hash ^ tap_bits(x)) * UINT64_C(0x100000001b3);
}

static void test_frozen(const char *name, uint64_t hash, uint64_t want)
{
    tap_ok(hash == want, "bits of %s: %016llx", name, (unsigned long long)hash);
}

static void test_bits(void)
{
    uint64_t student = 0, beta = 0, binomial = 0;
    double lo, hi;
    int i;
    for (i = 1; i < 4000; i++) {
        const double p = i / 4000.0, a = i % 61 * 0.375 + 0.25, b = i % 7 * 11.5 * (i % 601) + 0.5;
        student = test_hash(student, buffon_student_upper(p * (i % 3 ? 1 : 0x1p-100), a));
        student = test_hash(student, buffon_student_upper(p, i * 5.0));
        beta = test_hash(beta, buffon_beta_quantile(p, a, b));
        beta = test_hash(beta, buffon_beta_quantile(p, 1000 + b, 1e9 * a));
        buffon_priv_clopper_pearson(&lo, &hi, (uint64_t)i, (uint64_t)(4000 + i * (i % 5)), 1e-3);
        binomial = test_hash(test_hash(binomial, lo), hi);
        if (buffon_interval_wilson(&lo, &hi, (uint64_t)i, 4000, p) == BUFFON_OK) {
            binomial = test_hash(test_hash(binomial, lo), hi);
        }
    }
    test_frozen("t", student, UINT64_C(0xa9de6f1b2ecd284f));
    test_frozen("beta", beta, UINT64_C(0x979587ae8a8d9d6b));
    test_frozen("intervals", binomial, UINT64_C(0xe8c8e0f9badfd777));
}

int main(void)
{
    test_quantiles("special_reference.csv", "norm_quantile", 27);
    test_quantiles("special_reference.csv", "t_upper_quantile", 77);
    test_quantiles("special_reference.csv", "beta_quantile", 40);
    test_quantiles("quantile_reference.csv", "t_upper_quantile", 24);
    test_quantiles("quantile_reference.csv", "beta_quantile", 32);
    test_intervals("clopper_pearson", 140);
    test_intervals("wilson", 2);
    test_intervals("normal_clt", 24);
    test_exact_binomial();
    test_wilson();
    test_student_closed();
    test_student_far();
    test_student_seam();
    test_beta_closed();
    test_symmetry();
    test_tiny_alpha();
    test_nan();
    test_extremes();
    test_statuses();
    test_bits();
    return tap_done();
}
