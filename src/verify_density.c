/* A density held against itself: the report, and the checks that need nothing but points. The exact
 * ones come first, since statistics of points that are not numbers say nothing. */
#include "guard.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "density_priv.h"
#include "elementary.h"
#include "pvalue.h"
#include "verify_priv.h"

/* ---- report ---- */

/* An error in units of what is allowed, at point i of a cloud (NULL: no place). */
void buffon_priv_verify_see(verify *t, buffon_verify_check check, double error,
                            const verify_cloud *cloud, size_t i)
{
    buffon_verify_item *item = &t->report->item[check];
    const int failed = !(error <= 1);
    item->looked = 1;
    if (!(error > item->worst) && error == error)
        return;
    item->worst = error == error ? error : (double)INFINITY;
    item->failed |= failed;
    if (!failed || t->report->check < check || cloud == NULL)
        return;
    t->report->check = check;
    for (size_t j = 0; j < BUFFON_VERIFY_UNIFORMS; j++) {
        t->report->u[j] = j < t->g->uniforms ? cloud->u[j * cloud->n + i] : (double)NAN;
        t->report->x[j] = j < t->g->dim ? cloud->x[j * cloud->n + i] : (double)NAN;
    }
}

/* The p-value of a statistic: the least of its check is kept. */
void buffon_priv_verify_judge(verify *t, buffon_verify_check check, double p)
{
    buffon_verify_item *item = &t->report->item[check];
    item->p = item->looked && item->p < p ? item->p : p;
    item->looked = 1;
}

/* ---- clouds ---- */

buffon_status buffon_priv_verify_sample(verify *t, verify_cloud *cloud)
{
    t->report->points += cloud->n;
    return buffon_density_sample(cloud->x, t->has_pdf ? cloud->pdf : NULL, cloud->u, cloud->n,
                                 t->g);
}

/* Random uniforms; with edges, three of four coordinates of a point lie at 0, 1/2 or 1, as near as
 * the generator comes. */
void buffon_priv_verify_uniforms(verify *t, verify_cloud *cloud, int edges)
{
    static const double edge[3] = {0x1p-53, 0.5, 1 - 0x1p-53};
    for (size_t i = 0; i < t->g->uniforms * cloud->n; i++) {
        const uint64_t which = edges ? buffon_rng_below(&t->rng, 4) : 3;
        const double u = buffon_rng_next(&t->rng);
        cloud->u[i] = which < 3 ? edge[which] : u;
    }
}

/* What the rounding of point i is worth in its pdf: a normal of small spread far from 0 has few
 * points. The pdf is asked for on either side of each coordinate. */
static double verify_pdf_slack(const verify *t, const verify_cloud *cloud, size_t i,
                               buffon_status *status)
{
    const size_t dim = t->g->dim, n = 2 * (dim < VERIFY_DIM ? dim : VERIFY_DIM);
    double slack = 0, *x = t->other.x, *pdf = t->other.pdf;
    for (size_t d = 0; d < dim; d++) {
        const double middle = cloud->x[d * cloud->n + i];
        for (size_t k = 0; k < n; k++)
            x[d * n + k] =
                k / 2 == d ? middle * (1 + (k % 2 ? VERIFY_NOISE : -VERIFY_NOISE)) : middle;
    }
    *status = buffon_density_pdf(pdf, x, n, t->g);
    for (size_t k = 0; k < n && *status == BUFFON_OK; k++) {
        const double off = buffon_priv_abs(pdf[k] - t->again[i]);
        slack += off > 0 ? off : 0;
    }
    return slack;
}

/* POINTS and PDF of a cloud: 0 if there are points that no more can be asked of. */
static int verify_points(verify *t, const verify_cloud *cloud, buffon_status *status)
{
    const size_t n = cloud->n;
    int good = 1;
    for (size_t i = 0; i < n; i++) {
        int finite = !t->has_pdf || (cloud->pdf[i] > 0 && buffon_priv_isfinite(cloud->pdf[i]));
        for (size_t j = 0; j < t->g->dim; j++) {
            const double x = cloud->x[j * n + i];
            finite &= buffon_priv_isfinite(x);
            finite &= !t->how.discrete || buffon_priv_abs(x) >= 0x1p+52 || x == (double)(int64_t)x;
        }
        buffon_priv_verify_see(t, BUFFON_VERIFY_POINTS, finite ? 0 : (double)INFINITY, cloud, i);
        good &= finite;
    }
    if (!good || !t->has_pdf)
        return good;
    *status = buffon_density_pdf(t->again, cloud->x, n, t->g);
    for (size_t i = 0; i < n && *status == BUFFON_OK; i++) {
        double allowed = t->how.tolerance * cloud->pdf[i];
        const double error = buffon_priv_abs(t->again[i] - cloud->pdf[i]);
        if (error > allowed)
            allowed += verify_pdf_slack(t, cloud, i, status);
        buffon_priv_verify_see(t, BUFFON_VERIFY_PDF, error / allowed, cloud, i);
    }
    return *status == BUFFON_OK;
}

/* Median and half the distance of the quartiles of each coordinate. */
static void verify_measure(verify *t, const verify_cloud *cloud)
{
    const size_t n = cloud->n;
    for (size_t j = 0; j < t->g->dim && j < VERIFY_DIM; j++) {
        memcpy(t->again, cloud->x + j * n, n * sizeof *t->again);
        buffon_priv_sort(t->again, n);
        const double half = 0.5 * t->again[n - 1 - n / 4] - 0.5 * t->again[n / 4];
        const double range = t->again[n - 1] - t->again[0];
        t->middle[j] = t->again[n / 2];
        t->spread[j] = half > 0 ? half : range > 0 && range <= 0x1p+1000 ? range : 1;
    }
}

/* The size of rounding errors that a coordinate may have, where it is x. */
double buffon_priv_verify_size(const verify *t, size_t j, double x)
{
    return buffon_priv_abs(x) + (j < VERIFY_DIM ? t->spread[j] : 0);
}

/* EVEN: the points of a run, taken back to uniforms, and counted in cells of the first axes. */
static buffon_status verify_even(verify *t)
{
    const size_t uniforms = t->g->uniforms, axes = uniforms < 3 ? uniforms : 3;
    const size_t shown = uniforms < VERIFY_AXES ? uniforms : VERIFY_AXES;
    const size_t side = axes == 1 ? 1024 : axes == 2 ? 32 : 10, samples = (size_t)t->how.samples;
    const size_t cells = axes == 1 ? side : axes == 2 ? side * side : side * side * side;
    memset(t->count, 0, cells * sizeof *t->count);
    for (size_t done = 0; done < samples;) {
        verify_cloud *cloud = &t->points;
        const size_t n = cloud->n = samples - done < VERIFY_BATCH ? samples - done : VERIFY_BATCH;
        buffon_priv_verify_uniforms(t, cloud, 0);
        buffon_status status = buffon_priv_verify_sample(t, cloud);
        if (status == BUFFON_OK)
            status = buffon_density_invert(t->v, cloud->x, n, t->g);
        if (status != BUFFON_OK)
            return status;
        for (size_t i = 0; i < n; i++, done++) {
            size_t cell = 0;
            for (size_t j = 0; j < axes; j++) {
                const double v = t->v[j * n + i];
                cell = cell * side + (v > 0 && v < 1 ? (size_t)(v * (double)side) : 0);
            }
            t->count[cell]++;
            for (size_t j = 0; j < shown; j++)
                t->even[j * samples + done] = t->v[j * n + i];
        }
    }
    density_fill(t->expected, (double)samples / (double)cells, cells);
    buffon_priv_verify_judge(t, BUFFON_VERIFY_EVEN,
                             buffon_priv_p_cells(t->count, t->expected, t->expected, cells));
    for (size_t j = 0; j < shown; j++) {
        const double d = buffon_priv_kolmogorov(t->even + j * samples, samples);
        buffon_priv_verify_judge(t, BUFFON_VERIFY_EVEN,
                                 buffon_priv_p_kolmogorov(d, (double)samples));
    }
    return BUFFON_OK;
}

/* ---- whole numbers ---- */

/* The points of a run, sorted. */
static buffon_status verify_numbers(verify *t)
{
    const size_t samples = (size_t)t->how.samples;
    for (size_t done = 0; done < samples;) {
        verify_cloud *cloud = &t->points;
        cloud->n = samples - done < VERIFY_BATCH ? samples - done : VERIFY_BATCH;
        buffon_priv_verify_uniforms(t, cloud, 0);
        const buffon_status status = buffon_priv_verify_sample(t, cloud);
        if (status != BUFFON_OK)
            return status;
        memcpy(t->even + done, cloud->x, cloud->n * sizeof *cloud->x);
        done += cloud->n;
    }
    buffon_priv_sort(t->even, samples);
    return BUFFON_OK;
}

/* Counts the sorted points by number from the least to the most, with what the pdf expects:
 * neighbours together until ten are expected. *total is the sum of the pdf, *cells how many counts
 * there are; room for one more is left. */
static buffon_status verify_tally(verify *t, double least, double most, double *total,
                                  size_t *cells)
{
    const size_t samples = (size_t)t->how.samples;
    size_t next = 0, k = 0;
    t->count[0] = t->expected[0] = *total = 0;
    for (double from = least; from <= most; from += VERIFY_BATCH) {
        for (size_t i = 0; i < VERIFY_BATCH; i++)
            t->points.x[i] = from + (double)i;
        const buffon_status status = buffon_density_pdf(t->again, t->points.x, VERIFY_BATCH, t->g);
        if (status != BUFFON_OK)
            return status;
        for (size_t i = 0; i < VERIFY_BATCH && t->points.x[i] <= most; i++) {
            *total += t->again[i];
            t->expected[k] += (double)samples * t->again[i];
            for (; next < samples && t->even[next] == t->points.x[i]; next++)
                t->count[k]++;
            if (t->expected[k] >= 10 && k + 1 < VERIFY_CELLS) {
                k++;
                t->count[k] = t->expected[k] = 0;
            }
        }
    }
    *cells = k + 1;
    return BUFFON_OK;
}

/* TOTAL and CELLS of a law on whole numbers, between the least and the largest of the points. A
 * law may have more beyond: if points are expected there, that none was seen has the probability
 * exp(-unseen), for any of as many ends as there are points. Numbers so large that they are not
 * doubles, or so far apart that there are too many, are not looked at. */
static buffon_status verify_discrete(verify *t)
{
    const size_t samples = (size_t)t->how.samples;
    double total;
    size_t cells;
    buffon_status status = verify_numbers(t);
    if (status != BUFFON_OK)
        return status;
    const double least = t->even[0], most = t->even[samples - 1];
    if (!(most - least < 0x1p+20 && least > -0x1p+52 && most < 0x1p+52))
        return BUFFON_OK;
    status = verify_tally(t, least, most, &total, &cells);
    if (status != BUFFON_OK)
        return status;
    const double unseen = (double)samples * (1 - total);
    t->expected[cells - 1] += unseen > 0 ? unseen : 0;
    buffon_priv_verify_judge(t, BUFFON_VERIFY_CELLS,
                             buffon_priv_p_cells(t->count, t->expected, t->expected, cells));
    buffon_priv_verify_see(t, BUFFON_VERIFY_TOTAL, (total - 1) / t->how.tolerance, NULL, 0);
    buffon_priv_verify_judge(t, BUFFON_VERIFY_TOTAL,
                             unseen < 1 ? 1 : buffon_priv_exp(-unseen) * (double)samples);
    return BUFFON_OK;
}

/* ---- the whole ---- */

static buffon_status verify_defaults(verify *t, const buffon_verification *how)
{
    const buffon_verification none = {.samples = 0};
    t->how = how != NULL ? *how : none;
    for (size_t k = 0; k < sizeof none.reserved / sizeof *none.reserved; k++)
        if (t->how.reserved[k] != 0)
            return BUFFON_E_RESERVED;
    t->how.samples = t->how.samples > 0 ? t->how.samples : (uint64_t)1 << 16;
    t->how.tolerance = t->how.tolerance != 0 ? t->how.tolerance : 1e-9;
    t->how.alpha = t->how.alpha != 0 ? t->how.alpha : 1e-6;
    if (t->how.samples < 1 << 10 || t->how.samples > 1 << 30)
        return BUFFON_E_SAMPLES;
    if (!(t->how.tolerance > 0 && t->how.tolerance < 1))
        return BUFFON_E_TOLERANCE;
    if (!(t->how.alpha > 0 && t->how.alpha < 1))
        return BUFFON_E_CONFIDENCE;
    const buffon_status status = buffon_density_check(t->g);
    if (status == BUFFON_OK && t->how.discrete && t->g->dim != 1)
        return BUFFON_E_DIM;
    if (status != BUFFON_OK || t->how.over == NULL)
        return status;
    if (t->how.over->status == BUFFON_OK && t->how.over->dim != t->g->dim)
        return BUFFON_E_DIM;
    return buffon_density_check(t->how.over);
}

/* One block of memory for all arrays. */
static buffon_status verify_allocate(verify *t)
{
    const size_t over = t->how.over != NULL ? t->how.over->uniforms : 0;
    const size_t dim = t->g->dim > 3 ? t->g->dim : 3;
    size_t uniforms = t->g->uniforms > over ? t->g->uniforms : over;
    uniforms = uniforms > dim ? uniforms : dim;
    const size_t shown = t->g->uniforms < VERIFY_AXES ? t->g->uniforms : VERIFY_AXES;
    if (uniforms > SIZE_MAX / sizeof(double) / VERIFY_BATCH / 16)
        return BUFFON_E_NOMEM;
    const size_t rows = VERIFY_BATCH * (3 * uniforms + 2 * dim + 3);
    const size_t all = rows + 3 * (VERIFY_CELLS + 1) + shown * (size_t)t->how.samples;
    double *at = t->memory = malloc(all * sizeof *at);
    if (at == NULL)
        return BUFFON_E_NOMEM;
    double **const array[] = {&t->points.u, &t->other.u,    &t->v,         &t->points.x,
                              &t->other.x,  &t->points.pdf, &t->other.pdf, &t->again,
                              &t->count,    &t->expected,   &t->variance,  &t->even};
    const size_t length[] = {VERIFY_BATCH * uniforms,
                             VERIFY_BATCH * uniforms,
                             VERIFY_BATCH * uniforms,
                             VERIFY_BATCH * dim,
                             VERIFY_BATCH * dim,
                             VERIFY_BATCH,
                             VERIFY_BATCH,
                             VERIFY_BATCH,
                             VERIFY_CELLS + 1,
                             VERIFY_CELLS + 1,
                             VERIFY_CELLS + 1,
                             0};
    for (size_t k = 0; k < sizeof array / sizeof *array; k++) {
        *array[k] = at;
        at += length[k];
    }
    return BUFFON_OK;
}

/* What the density can do, which it may learn from its parts: by asking, at one point. */
static buffon_status verify_probe(verify *t)
{
    const size_t dim = t->g->dim, uniforms = t->g->uniforms;
    density_fill(t->points.u, 0.5, uniforms);
    const buffon_status status = buffon_density_sample(t->points.x, NULL, t->points.u, 1, t->g);
    if (status != BUFFON_OK)
        return status;
    t->has_pdf = buffon_density_pdf(t->again, t->points.x, 1, t->g) != BUFFON_E_UNSUPPORTED;
    t->has_inverse = !t->how.discrete && dim <= VERIFY_DIM && uniforms <= VERIFY_DIM &&
                     buffon_density_invert(t->v, t->points.x, 1, t->g) != BUFFON_E_UNSUPPORTED;
    t->one_to_one = t->has_inverse && uniforms <= dim;
    return BUFFON_OK;
}

/* All checks, the exact ones first. Points that are none end it. */
static buffon_status verify_run(verify *t)
{
    verify_cloud *cloud = &t->points;
    buffon_status status = BUFFON_OK;
    for (int edges = 1; edges >= 0; edges--) {
        cloud->n = VERIFY_BATCH;
        buffon_priv_verify_uniforms(t, cloud, edges);
        status = buffon_priv_verify_sample(t, cloud);
        if (status != BUFFON_OK || !verify_points(t, cloud, &status))
            return status;
    }
    verify_measure(t, cloud);
    buffon_priv_verify_cover(t, cloud);
    if (t->how.discrete)
        return t->has_pdf ? verify_discrete(t) : BUFFON_OK;
    if (t->one_to_one)
        status = buffon_priv_verify_stretch(t);
    if (status == BUFFON_OK && t->over != NULL && t->has_pdf)
        status = buffon_priv_verify_covered(t);
    if (status == BUFFON_OK && t->has_inverse)
        status = verify_even(t);
    return status;
}

/* Does a check apply to g at all? */
static int verify_applies(const verify *t, size_t check)
{
    switch (check) {
    case BUFFON_VERIFY_POINTS:
        return 1;
    case BUFFON_VERIFY_INVERSE:
        return t->one_to_one;
    case BUFFON_VERIFY_STRETCH:
        return t->one_to_one && t->has_pdf;
    case BUFFON_VERIFY_SUPPORT:
        return t->has_inverse && t->has_pdf;
    case BUFFON_VERIFY_EVEN:
        return t->has_inverse;
    default:
        return t->has_pdf;
    }
}

/* The verdict: statistics together, then the first check that failed. */
static buffon_status verify_conclude(verify *t)
{
    buffon_verify_report *report = t->report;
    const double statistics = 4 + (double)t->g->uniforms;
    buffon_status status = BUFFON_OK;
    for (size_t k = BUFFON_VERIFY_CHECKS; k-- > 0;) {
        buffon_verify_item *item = &report->item[k];
        const double p = statistics * item->p;
        report->p_value = p < report->p_value ? p : report->p_value;
        item->failed |= p < t->how.alpha;
        if (!item->looked && verify_applies(t, k) && status == BUFFON_OK)
            status = BUFFON_W_UNSEEN;
        if (item->failed) {
            status = BUFFON_E_LAW;
            if (report->check > (buffon_verify_check)k)
                report->check = (buffon_verify_check)k;
        }
    }
    return status;
}

buffon_status buffon_verify_density(buffon_verify_report *report, const buffon_density *g,
                                    const buffon_verification *how)
{
    verify t = {.g = g, .report = report};
    if (report == NULL)
        return BUFFON_E_NULL;
    *report = (buffon_verify_report){.check = BUFFON_VERIFY_CHECKS, .p_value = 1};
    density_fill(report->u, (double)NAN, BUFFON_VERIFY_UNIFORMS);
    density_fill(report->x, (double)NAN, BUFFON_VERIFY_UNIFORMS);
    for (size_t k = 0; k < BUFFON_VERIFY_CHECKS; k++)
        report->item[k].p = 1;
    buffon_status status = verify_defaults(&t, how);
    if (status == BUFFON_OK)
        status = verify_allocate(&t);
    if (status == BUFFON_OK) {
        t.rng = buffon_rng_make(t.how.seed, 0);
        status = verify_probe(&t);
    }
    if (status == BUFFON_OK)
        status = verify_run(&t);
    if (status == BUFFON_OK)
        status = verify_conclude(&t);
    free(t.memory);
    report->status = status;
    return status;
}

const char *buffon_verify_string(buffon_verify_check check)
{
    switch (check) {
#define VERIFY_TEXT(name, text)                                                                    \
    case name:                                                                                     \
        return text;
        BUFFON_VERIFY_LIST(VERIFY_TEXT)
#undef VERIFY_TEXT
    case BUFFON_VERIFY_CHECKS:
        return "nothing is wrong";
    }
    return "unknown check";
}
