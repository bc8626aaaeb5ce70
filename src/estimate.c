#include "guard.h"

#include <math.h>
#include <string.h>

#include <buffon/estimate.h>

#include "exact.h"
#include "median.h"
#include "quantile.h"
#include "record.h"
#include "spread.h"
#include "stats_priv.h"

/* A tenth of all squared deviations in one sample: the spread was seen by some ten samples. */
#define ESTIMATE_DOMINATED 0.1
/* Above this tail index k-hat, estimates of the variance do not settle at any practical size
 * (Vehtari et al. 2024, section 3). */
#define ESTIMATE_HEAVY 0.7

/* The largest part that one value has in the squared error: (y - mean)^2 / (n (n - 1)) of its
 * stratum, over the sum of all. */
static double estimate_share(const buffon_priv_record *record, size_t output)
{
    buffon_priv_wide total = buffon_priv_wide_of(0), worst = buffon_priv_wide_of(0);
    for (size_t s = 0; s < record->shape.strata; s++) {
        const size_t variant = buffon_priv_spread_variant(record, s);
        buffon_priv_wide mean = buffon_priv_wide_of(0), high, low, n2;
        buffon_stats pool;
        buffon_priv_spread_pool(&pool, record, s, variant * (size_t)record->shape.outputs + output);
        if (pool.count < 2)
            return NAN;
        if (variant != 2)
            mean = buffon_priv_wide_negate(buffon_priv_stats_mean_wide(&pool));
        n2 = buffon_priv_wide_mul(buffon_priv_wide_count(pool.count),
                                  buffon_priv_wide_count(pool.count - (variant != 2)));
        high = buffon_priv_wide_add(buffon_priv_wide_of(pool.max), mean);
        low = buffon_priv_wide_add(buffon_priv_wide_of(pool.min), mean);
        for (unsigned side = 0; side < 2; side++) {
            const buffon_priv_wide d =
                buffon_priv_wide_mul(side ? high : low, buffon_priv_spread_factor(record, s));
            const buffon_priv_wide part = buffon_priv_wide_div(buffon_priv_wide_mul(d, d), n2);
            const buffon_priv_wide less =
                buffon_priv_wide_add(worst, buffon_priv_wide_negate(part));
            if (less.m < 0)
                worst = part;
        }
        const buffon_priv_wide factor = buffon_priv_spread_factor(record, s);
        const buffon_priv_wide var = buffon_priv_spread_pairs(record, s, output, output).square;
        total = buffon_priv_wide_add(
            total, buffon_priv_wide_mul(var, buffon_priv_wide_mul(factor, factor)));
    }
    return total.m > 0 ? buffon_priv_wide_to_double(buffon_priv_wide_div(worst, total)) : NAN;
}

/* Extremes and tail of the values themselves, over all strata. */
static void estimate_extremes(buffon_estimate *out, const buffon_priv_record *record, size_t output)
{
    const int hits = record->shape.kind == BUFFON_PRIV_HITS;
    out->min = out->max = out->tail_index = NAN;
    for (size_t s = 0; s < record->shape.strata; s++) {
        buffon_stats pool;
        buffon_priv_spread_pool(&pool, record, s, output);
        out->nonfinite += pool.nonfinite;
        if (pool.count == 0)
            continue;
        const buffon_priv_wide factor = buffon_priv_spread_factor(record, s);
        const double a =
            buffon_priv_wide_to_double(buffon_priv_wide_mul(factor, buffon_priv_wide_of(pool.min)));
        const double b =
            buffon_priv_wide_to_double(buffon_priv_wide_mul(factor, buffon_priv_wide_of(pool.max)));
        const double tail = hits ? NAN : buffon_priv_tail_index(pool.top, pool.count);
        if (!(out->min <= (a < b ? a : b)))
            out->min = a < b ? a : b;
        if (!(out->max >= (a < b ? b : a)))
            out->max = a < b ? b : a;
        if (tail == tail && !(out->tail_index >= tail))
            out->tail_index = tail;
    }
}

/* What of a self-normalised estimate is told by its weights. */
static void estimate_weights(buffon_estimate *out, const buffon_priv_record *record)
{
    buffon_stats pool;
    buffon_priv_spread_pool(&pool, record, 0, (size_t)record->shape.components);
    const buffon_priv_wide top = buffon_priv_wide_of(pool.top[0]);
    const buffon_priv_wide sum = buffon_priv_wide_mul(buffon_priv_stats_mean_square(&pool),
                                                      buffon_priv_wide_count(pool.count));
    out->min = out->max = NAN;
    out->tail_index = buffon_priv_tail_index(pool.top, pool.count);
    out->ess = buffon_stats_summary(&pool).ess;
    out->max_share =
        buffon_priv_wide_to_double(buffon_priv_wide_div(buffon_priv_wide_mul(top, top), sum));
}

/* What the rounding of the value may come to. Where pairs or strata cancel, its terms are larger
 * than itself: they count as soon as the error is of such a size. */
static double estimate_rounding(const buffon_estimate *out)
{
    const double largest = -out->min > out->max ? -out->min : out->max;
    double size = out->value < 0 ? -out->value : out->value;
    if (largest > size && out->std_error < 0x1p-30 * largest)
        size = largest;
    return 0x1p-52 * size;
}

/* lo and hi. Hits of independent points have Clopper and Pearson's; a spread has Student's, widened
 * by the rounding of the value; no spread and no error mean that nothing is known. */
static void estimate_interval(buffon_estimate *out, const buffon_priv_record *record, double dof)
{
    const buffon_priv_shape *shape = &record->shape;
    const double alpha = (1 - out->confidence) / (double)shape->looks;
    if (shape->kind == BUFFON_PRIV_HITS && shape->design == BUFFON_DESIGN_INDEPENDENT) {
        const buffon_priv_wide scale = buffon_priv_spread_factor(record, 0);
        /* Between 0 and 1, but a loaded record is only as sound as its bytes. */
        const double share = out->acceptance > 0 && out->acceptance <= 1 ? out->acceptance : 0;
        const uint64_t hits = (uint64_t)(share * (double)out->samples + 0.5);
        buffon_priv_clopper_pearson(&out->lo, &out->hi, hits, out->samples, alpha);
        out->lo =
            buffon_priv_wide_to_double(buffon_priv_wide_mul(scale, buffon_priv_wide_of(out->lo)));
        out->hi =
            buffon_priv_wide_to_double(buffon_priv_wide_mul(scale, buffon_priv_wide_of(out->hi)));
        out->interval = BUFFON_INTERVAL_CLOPPER_PEARSON;
    } else if (out->std_error == 0 && shape->constant) {
        out->lo = out->hi = out->value;
        out->interval = BUFFON_INTERVAL_EXACT;
    } else if (out->std_error > 0 && out->std_error < INFINITY && dof > 0 &&
               out->value - out->value == 0) {
        const double half =
            buffon_priv_student_two_sided(alpha, dof) * out->std_error + estimate_rounding(out);
        out->lo = out->value - half;
        out->hi = out->value + half;
        out->interval = BUFFON_INTERVAL_STUDENT;
    }
}

/* lo and hi of a median, between two of the replicates' estimates. */
static void estimate_order(buffon_estimate *out, const buffon_priv_median *median, double alpha)
{
    const double rounding = estimate_rounding(out);
    double lo, hi;
    if (!(out->std_error < INFINITY) || !(out->value - out->value == 0) ||
        !buffon_priv_median_interval(&lo, &hi, median, alpha))
        return;
    out->lo = lo - rounding;
    out->hi = hi + rounding;
    out->interval = BUFFON_INTERVAL_ORDER;
}

static void estimate_doubts(buffon_estimate *out, const buffon_priv_record *record)
{
    const buffon_priv_shape *shape = &record->shape;
    uint32_t doubts = 0;
    if (!buffon_priv_record_complete(record))
        doubts |= BUFFON_DOUBT(BUFFON_W_INCOMPLETE);
    if (out->nonfinite > 0)
        doubts |= BUFFON_DOUBT(BUFFON_W_NONFINITE);
    if (shape->design == BUFFON_DESIGN_NONE)
        doubts |= BUFFON_DOUBT(BUFFON_W_NO_ERROR);
    else if (out->std_error == INFINITY || out->value - out->value != 0 ||
             (shape->design == BUFFON_DESIGN_MEDIAN && out->std_error > 0 &&
              out->interval == BUFFON_INTERVAL_NONE))
        doubts |= BUFFON_DOUBT(BUFFON_W_FEW);
    if (out->std_error == 0 && !shape->constant)
        doubts |= BUFFON_DOUBT(BUFFON_W_NO_SPREAD);
    if (out->interval != BUFFON_INTERVAL_CLOPPER_PEARSON && out->max_share >= ESTIMATE_DOMINATED)
        doubts |= BUFFON_DOUBT(BUFFON_W_DOMINATED);
    if (out->tail_index > ESTIMATE_HEAVY)
        doubts |= BUFFON_DOUBT(BUFFON_W_HEAVY_TAIL);
    out->doubts = doubts;
    out->status = BUFFON_OK;
    for (int w = 31; w > 0; w--) {
        if (doubts & BUFFON_DOUBT(w))
            out->status = (buffon_status)w;
    }
}

buffon_estimate buffon_priv_estimate_failed(buffon_status status)
{
    return (buffon_estimate){.value = NAN,
                             .std_error = INFINITY,
                             .variance = NAN,
                             .lo = -INFINITY,
                             .hi = INFINITY,
                             .confidence = NAN,
                             .bad_index = UINT64_MAX,
                             .status = status,
                             .min = NAN,
                             .max = NAN,
                             .max_share = NAN,
                             .tail_index = NAN,
                             .ess = NAN,
                             .acceptance = NAN};
}

/* The variance of one sample: that of the values, or, where no single law has them, the squared
 * error times their number. */
static double estimate_variance(const buffon_priv_record *record, size_t k, buffon_priv_wide square,
                                uint64_t n)
{
    if (record->shape.strata > 1 || record->shape.kind == BUFFON_PRIV_RATIO)
        return buffon_priv_wide_to_double(buffon_priv_wide_mul(square, buffon_priv_wide_count(n)));
    const buffon_priv_wide factor = buffon_priv_spread_factor(record, 0);
    buffon_stats pool;
    buffon_priv_spread_pool(&pool, record, 0, k);
    return buffon_priv_wide_to_double(buffon_priv_wide_mul(buffon_priv_stats_variance(&pool),
                                                           buffon_priv_wide_mul(factor, factor)));
}

/* Value and error: the mean and its degrees of freedom, or the median. */
static double estimate_error(buffon_estimate *out, buffon_priv_median *median,
                             const buffon_priv_record *record, size_t k)
{
    buffon_priv_spread spread = {buffon_priv_wide_of(0), 0};
    if (record->shape.design == BUFFON_DESIGN_MEDIAN) {
        buffon_priv_median_make(median, record, k);
        out->value = buffon_priv_median_value(median);
        out->std_error = buffon_priv_median_error(median);
        const buffon_priv_wide error = buffon_priv_wide_of(out->std_error);
        spread.square = buffon_priv_wide_mul(error, error);
    } else {
        spread = buffon_priv_spread_of(record, k, k);
        out->value = buffon_priv_wide_to_double(buffon_priv_spread_value(record, k));
        out->std_error = buffon_priv_wide_to_double(buffon_priv_wide_sqrt(spread.square));
    }
    out->variance = estimate_variance(record, k, spread.square, out->samples);
    return spread.dof;
}

static void estimate_component(buffon_estimate *out, const buffon_priv_record *record, size_t k)
{
    const buffon_priv_shape *shape = &record->shape;
    buffon_priv_median median;
    const double dof = estimate_error(out, &median, record, k);
    /* What is not known is the same NaN on every machine. */
    if (out->std_error != out->std_error)
        out->std_error = shape->design == BUFFON_DESIGN_NONE ? NAN : INFINITY;
    if (out->variance != out->variance)
        out->variance = NAN;
    out->ess = (double)out->samples;
    if (shape->kind == BUFFON_PRIV_HITS)
        out->acceptance = buffon_priv_wide_to_double(buffon_priv_spread_mean(record, 0, k));
    estimate_extremes(out, record, k);
    if (shape->kind == BUFFON_PRIV_RATIO)
        estimate_weights(out, record);
    else if (shape->design <= BUFFON_DESIGN_STRATIFIED)
        out->max_share = estimate_share(record, k);
    if (shape->design == BUFFON_DESIGN_MEDIAN && out->std_error > 0)
        estimate_order(out, &median, (1 - out->confidence) / (double)shape->looks);
    else
        estimate_interval(out, record, dof);
    estimate_doubts(out, record);
}

buffon_status buffon_priv_record_estimate(buffon_estimate *out, const buffon_priv_record *record,
                                          double confidence)
{
    const buffon_priv_shape *shape = &record->shape;
    buffon_status status = BUFFON_OK;
    uint64_t samples = buffon_priv_record_points(record);
    int missing = 0;
    for (size_t s = 0; s < shape->strata; s++)
        missing |= buffon_priv_spread_count(record, s) == 0;
    if (!missing && shape->kind == BUFFON_PRIV_RATIO &&
        buffon_priv_spread_output(record, (size_t)shape->components).m == 0) {
        for (size_t k = 0; k < shape->components; k++)
            out[k] = buffon_priv_estimate_failed(BUFFON_E_EMPTY); /* no weight at all: 0 / 0 */
        return BUFFON_E_EMPTY;
    }
    for (size_t k = 0; k < shape->components; k++) {
        out[k] = buffon_priv_estimate_failed(BUFFON_W_INCOMPLETE);
        out[k].confidence = confidence != 0 ? confidence : 0.95;
        out[k].looks = (uint32_t)shape->looks;
        if (missing) {
            out[k].doubts = BUFFON_DOUBT(BUFFON_W_INCOMPLETE);
        } else {
            out[k].samples = samples;
            estimate_component(&out[k], record, k);
        }
        if (status == BUFFON_OK || (out[k].status > 0 && out[k].status < status))
            status = out[k].status;
    }
    return status;
}

/* A sample as a record of one cell, so that there is one way from sums to an estimate. */
buffon_status buffon_stats_estimate(buffon_estimate *out, const buffon_stats *s, double confidence)
{
    const double one = 1;
    double weight = 1;
    buffon_stats whole, tail = {0};
    buffon_priv_record record = {.shape = {.components = 1,
                                           .outputs = 1,
                                           .strata = 1,
                                           .per_stratum = 1,
                                           .block = 1024,
                                           .round = 1,
                                           .parts = 1,
                                           .looks = 1},
                                 .weight = &weight,
                                 .tail = {&tail, NULL}};
    buffon_status status = BUFFON_OK;
    if (out == NULL)
        return BUFFON_E_NULL;
    if (s == NULL)
        status = BUFFON_E_NULL;
    else if (confidence != 0 && !(confidence > 0 && confidence < 1))
        status = BUFFON_E_CONFIDENCE;
    else if (s->count == 0)
        status = BUFFON_E_EMPTY;
    if (status != BUFFON_OK) {
        *out = buffon_priv_estimate_failed(status);
        return status;
    }
    whole = *s;
    memcpy(&record.shape.scale_m, &one, sizeof one);
    record.target = &whole.count;
    record.whole.stats = &whole;
    return buffon_priv_record_estimate(out, &record, confidence);
}
