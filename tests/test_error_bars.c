/* Error bars against the truth: integrals whose value, and whose standard deviation under uniform
 * points, are known. */
#include "binomial.h"

#include <stdio.h>
#include <stdlib.h>

#include <buffon/uniform.h>

#include "integrands.h"

enum {
    LONG = 1 << 16, /* points of the one long run of an integrand */
    SHORT = 1 << 12, /* and of each of its repeats */
    REPEATS = 64
};

#define SEED 1777 /* Buffon, Essai d'arithmetique morale */

/* ---- the table of exact values ---- */

/* Cuts a line of CSV into fields, in place. */
static size_t csv_cut(char *line, char **field, size_t most)
{
    size_t fields = 0;
    for (char *p = line; fields < most;) {
        const int quoted = *p == '"';
        p += quoted;
        field[fields++] = p;
        while (*p && (quoted ? *p != '"' : *p != ',' && *p != '\n'))
            p++;
        if (quoted && *p)
            *p++ = 0;
        if (*p != ',')
            break;
        *p++ = 0;
    }
    return fields;
}

/* The exact value of an integrand and its standard deviation, volume included; 0 if not found. */
static int truth_find(double *exact, double *deviation, const integrand_row *row)
{
    FILE *file = fopen("tests/data/exact_values.csv", "r");
    char line[500], *field[7];
    int found = 0;
    while (file && !found && fgets(line, sizeof line, file)) {
        if (csv_cut(line, field, 7) < 6 || strcmp(field[0], row->name) != 0)
            continue;
        if (strcmp(field[1], "any") != 0 && strtoul(field[1], NULL, 10) != row->dim)
            continue;
        *exact = strtod(field[4], NULL);
        *deviation = strtod(field[5], NULL);
        found = field[5][0] != 0;
    }
    if (file)
        fclose(file);
    return found;
}

/* ---- runs ---- */

static double row_value(const double *x, void *ctx)
{
    const integrand_row *row = *(const integrand_row *const *)ctx;
    return row->f(x, row->dim);
}

static buffon_estimate row_run(const integrand_row *row, uint64_t samples, uint64_t stream)
{
    const buffon_integrand f = {.scalar = row_value, .dim = row->dim, .ctx = &row};
    const buffon_run run = {.samples = samples, .seed = SEED, .stream = stream};
    double lo[32], hi[32];
    buffon_estimate e;
    for (size_t j = 0; j < row->dim; j++) {
        lo[j] = j > 0 ? row->rest[0] : row->first[0];
        hi[j] = j > 0 ? row->rest[1] : row->first[1];
    }
    if (buffon_uniform(&e, &f, lo, hi, &run) < 0)
        tap_ok(0, "%s: %s", row->name, buffon_status_name(e.status));
    return e;
}

/* By how much the ratio of a variance estimated from n values to the true one may differ from 1. */
static double variance_limit(const integrand_row *row, double n)
{
    return BINOMIAL_SIGMAS * sqrt((1.1 * row->kurtosis - 1) / n);
}

/* ---- checks ---- */

/* The z-scores of all repeats, by the exact standard error and by the reported one. */
static double all_exact[INTEGRAND_ROWS * REPEATS], all_own[INTEGRAND_ROWS * REPEATS];
static size_t scores;

static void check_long(const integrand_row *row, double exact, double deviation, uint64_t stream)
{
    const buffon_estimate e = row_run(row, LONG, stream);
    const double error = deviation / sqrt(LONG), ratio = e.std_error / error;
    law_ok(law_normal((e.value - exact) / error), "%s, d = %zu: the value is %.2f sigma off",
           row->name, row->dim, (e.value - exact) / error);
    /* The limit is one for ratios of variances. */
    tap_ok(fabs(ratio * ratio - 1) < variance_limit(row, LONG),
           "%s, d = %zu: std_error is %.4f of the exact one", row->name, row->dim, ratio);
}

/* A peak that few points see, or that all of them miss, cannot have a good error bar. But a bad one
 * has to say so: by a doubt, or by a single sample that carries more than a hundredth of it. */
static void check_narrow(const integrand_row *row, double exact, uint64_t stream)
{
    const buffon_estimate e = row_run(row, LONG, stream);
    const double off = (e.value - exact) / e.std_error;
    tap_ok(fabs(off) < BINOMIAL_SIGMAS || e.doubts != 0 || e.max_share > 0.01,
           "%s, d = %zu: %.2f std_error off, with a largest share of %.2g", row->name, row->dim,
           off, e.max_share);
}

static void check_repeats(const integrand_row *row, double exact, double deviation, uint64_t stream)
{
    const double error = deviation / sqrt(SHORT);
    double squares = 0;
    for (uint64_t r = 0; r < REPEATS; r++) {
        const buffon_estimate e = row_run(row, SHORT, stream + r);
        squares += e.std_error * e.std_error / (error * error) / REPEATS;
        all_exact[scores] = (e.value - exact) / error;
        all_own[scores++] = (e.value - exact) / e.std_error;
    }
    tap_ok(fabs(squares - 1) < variance_limit(row, (double)REPEATS * SHORT),
           "%s, d = %zu: the mean std_error^2 is %.4f of the exact one", row->name, row->dim,
           squares);
}

/* Are these numbers N(0, 1)? */
static void check_scores(double *z, const char *whose)
{
    double squares = 0;
    for (size_t i = 0; i < scores; i++) {
        squares += z[i] * z[i];
        z[i] = 0.5 * erfc(-z[i] / sqrt(2.0));
    }
    law_ok(law_chi_square(squares, (double)scores), "%zu errors over the %s: mean square %.4f",
           scores, whose, squares / (double)scores);
    law_ok(law_uniform(z, scores), "their law is normal");
}

int main(void)
{
    size_t judged = 0;
    for (size_t i = 0; i < INTEGRAND_ROWS; i++) {
        const integrand_row *row = &integrand_list[i];
        const uint64_t stream = 1000 * (i + 1);
        double exact = 0, deviation = 0;
        if (!truth_find(&exact, &deviation, row)) {
            tap_ok(0, "%s, d = %zu: not in the table", row->name, row->dim);
        } else if (deviation == 0) {
            const buffon_estimate e = row_run(row, LONG, stream);
            tap_ok(e.value == exact && e.std_error == 0 && e.status == BUFFON_W_NO_SPREAD,
                   "%s: no spread, and no certainty", row->name);
        } else if (row->kurtosis < INTEGRAND_NARROW) {
            check_long(row, exact, deviation, stream);
            check_repeats(row, exact, deviation, stream + 1);
            judged++;
        } else {
            check_narrow(row, exact, stream);
        }
    }
    tap_ok(judged >= 50, "%zu integrands have error bars to be judged", judged);
    check_scores(all_exact, "exact standard error");
    check_scores(all_own, "reported one");
    return tap_done();
}
