#include "guard.h"

#include <math.h>
#include <string.h>

#include <buffon/estimate.h>
#include <buffon/partial.h>

#include "exact.h"
#include "quantile.h"
#include "record.h"
#include "stats_priv.h"

/* A single sample with a tenth of all squared deviations: the spread was seen by about ten samples.
 */
#define ESTIMATE_DOMINATED 0.1
/* Above this tail index k-hat, estimates of the variance do not settle at any practical size
 * (Vehtari et al. 2024, section 3). */
#define ESTIMATE_HEAVY 0.7

/* A squared error and the degrees of freedom it was estimated with. */
typedef struct estimate_spread {
    buffon_priv_wide square;
    double dof;
} estimate_spread;

static buffon_priv_wide estimate_wide(double x)
{
    return buffon_priv_wide_make(x, 0);
}

/* The exact sample of one series of a stratum, over its replicates from r on to the end. */
static void estimate_pool(buffon_stats *pool, const buffon_priv_record *record, size_t stratum,
                          size_t r, size_t end, size_t series)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t all = buffon_priv_shape_series(shape);
    memset(pool, 0, sizeof *pool);
    for (; r < end; r++) {
        const size_t at = (stratum * (size_t)shape->replicates + r) * all + series;
        buffon_stats_merge(pool, &record->whole.stats[at]);
        buffon_stats_merge(pool, &record->tail.stats[at]);
    }
}

static void estimate_pool_cross(uint64_t *limbs, const buffon_priv_record *record, size_t stratum,
                                size_t variant, size_t a, size_t b)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t words = buffon_priv_shape_cross(shape);
    const size_t at = buffon_priv_shape_cross_at(shape, variant, a, b);
    memset(limbs, 0, BUFFON_STATS_SQUARES * sizeof *limbs);
    for (size_t r = 0; r < shape->replicates; r++) {
        const size_t cell = stratum * (size_t)shape->replicates + r;
        const size_t from = cell * words + at;
        buffon_priv_limbs_merge(limbs, record->whole.cross + from, BUFFON_STATS_SQUARES);
        buffon_priv_limbs_merge(limbs, record->tail.cross + from, BUFFON_STATS_SQUARES);
    }
}

static buffon_priv_wide estimate_stratum_mean(const buffon_priv_record *record, size_t stratum,
                                              size_t output)
{
    buffon_stats pool;
    estimate_pool(&pool, record, stratum, 0, (size_t)record->shape.replicates, output);
    return buffon_priv_stats_mean_wide(&pool);
}

static uint64_t estimate_stratum_count(const buffon_priv_record *record, size_t stratum)
{
    const buffon_priv_shape *shape = &record->shape;
    uint64_t count = 0;
    for (size_t r = 0; r < shape->replicates; r++) {
        const size_t cell = stratum * (size_t)shape->replicates + r;
        count += buffon_priv_cell_count(&record->whole, cell, shape) +
                 buffon_priv_cell_count(&record->tail, cell, shape);
    }
    return count;
}

/* Are the blocks of a cell that are done the first ones, none left out? */
static int estimate_gapless(const buffon_priv_record *record, size_t cell)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t cells = buffon_priv_shape_cells(shape);
    const uint64_t blocks = buffon_priv_cell_count(&record->whole, cell, shape) / shape->block;
    for (uint64_t p = 0; p < shape->parts; p++) {
        if (record->done[p * cells + cell] != buffon_priv_record_owned(record, p, cell, blocks))
            return 0;
    }
    return buffon_priv_cell_count(&record->tail, cell, shape) == 0 ||
           blocks == record->target[cell] / shape->block;
}

/* Has every replicate of the stratum finished its sweeps over the cells of the point set? */
static int estimate_swept(const buffon_priv_record *record, size_t stratum)
{
    const buffon_priv_shape *shape = &record->shape;
    for (size_t r = 0; r < shape->replicates; r++) {
        const size_t cell = stratum * (size_t)shape->replicates + r;
        const uint64_t count = buffon_priv_cell_count(&record->whole, cell, shape) +
                               buffon_priv_cell_count(&record->tail, cell, shape);
        if (count % shape->round != 0 || !estimate_gapless(record, cell))
            return 0;
    }
    return 1;
}

/* Which series the error comes from: the values, the means of pairs, or their half differences. */
static size_t estimate_variant(const buffon_priv_record *record, size_t stratum)
{
    switch (record->shape.design) {
    case BUFFON_DESIGN_ANTITHETIC:
        return 1;
    case BUFFON_DESIGN_STRATIFIED:
        return estimate_swept(record, stratum) ? 2 : 1;
    default:
        return 0;
    }
}

/* Covariance of the means of independent values, pairs, or stratified pairs.
 *
 * Stratified pairs: M cells with half differences d have Var(mean) = sum Var(cell) / (2 M^2), and
 * d^2 has the mean Var(cell) / 2, so it is estimated by sum d^2 / M^2 = mean(d^2) / M, with M
 * degrees of freedom. mean(d_a d_b) follows from the covariance: (M - 1)/M cov + mean(d_a)
 * mean(d_b). */
static estimate_spread estimate_pairs_spread(const buffon_priv_record *record, size_t stratum,
                                             size_t a, size_t b)
{
    const size_t variant = estimate_variant(record, stratum),
                 first = variant * record->shape.outputs;
    const size_t end = (size_t)record->shape.replicates;
    uint64_t limbs[BUFFON_STATS_SQUARES];
    buffon_stats sa, sb;
    buffon_priv_wide square;
    estimate_pool(&sa, record, stratum, 0, end, first + a);
    if (variant == 2 && a == b)
        square = buffon_priv_stats_mean_square(&sa);
    else if (a == b)
        square = buffon_priv_stats_variance(&sa);
    else {
        estimate_pool(&sb, record, stratum, 0, end, first + b);
        estimate_pool_cross(limbs, record, stratum, variant, a < b ? a : b, a < b ? b : a);
        square = buffon_priv_cross_covariance(limbs, &sa, &sb);
        if (variant == 2 && sa.count > 1) {
            square = buffon_priv_wide_mul(square, buffon_priv_wide_count(sa.count - 1));
            square = buffon_priv_wide_div(square, buffon_priv_wide_count(sa.count));
            square = buffon_priv_wide_add(square,
                                          buffon_priv_wide_mul(buffon_priv_stats_mean_wide(&sa),
                                                               buffon_priv_stats_mean_wide(&sb)));
        }
    }
    return (estimate_spread){.square =
                                 buffon_priv_wide_div(square, buffon_priv_wide_count(sa.count)),
                             .dof = (double)(sa.count - (variant != 2 && sa.count > 0))};
}

/* Covariance of the means over R replicates that have points, with weights w_r = n_r / n:
 * R / (R - 1) sum w_r^2 (a_r - a)(b_r - b), which for equal n_r is the usual sum / (R (R - 1)). */
static estimate_spread estimate_replicates_spread(const buffon_priv_record *record, size_t stratum,
                                                  size_t a, size_t b)
{
    const buffon_priv_wide mean_a = estimate_stratum_mean(record, stratum, a);
    const buffon_priv_wide mean_b = estimate_stratum_mean(record, stratum, b);
    const buffon_priv_wide n = buffon_priv_wide_count(estimate_stratum_count(record, stratum));
    buffon_priv_wide sum = estimate_wide(0);
    uint64_t present = 0;
    for (size_t r = 0; r < record->shape.replicates; r++) {
        buffon_stats pool;
        buffon_priv_wide weight, da, db;
        estimate_pool(&pool, record, stratum, r, r + 1, a);
        if (pool.count == 0)
            continue;
        present++;
        weight = buffon_priv_wide_div(buffon_priv_wide_count(pool.count), n);
        da = buffon_priv_wide_add(buffon_priv_stats_mean_wide(&pool),
                                  buffon_priv_wide_negate(mean_a));
        estimate_pool(&pool, record, stratum, r, r + 1, b);
        db = buffon_priv_wide_add(buffon_priv_stats_mean_wide(&pool),
                                  buffon_priv_wide_negate(mean_b));
        sum = buffon_priv_wide_add(sum, buffon_priv_wide_mul(buffon_priv_wide_mul(weight, da),
                                                             buffon_priv_wide_mul(weight, db)));
    }
    if (present < 2)
        return (estimate_spread){estimate_wide(NAN), 0};
    sum = buffon_priv_wide_mul(sum, buffon_priv_wide_count(present));
    return (estimate_spread){buffon_priv_wide_div(sum, buffon_priv_wide_count(present - 1)),
                             (double)(present - 1)};
}

static estimate_spread estimate_stratum_spread(const buffon_priv_record *record, size_t stratum,
                                               size_t a, size_t b)
{
    switch (record->shape.design) {
    case BUFFON_DESIGN_NONE:
        return (estimate_spread){estimate_wide(NAN), 0};
    case BUFFON_DESIGN_REPLICATES:
        return estimate_replicates_spread(record, stratum, a, b);
    default:
        return estimate_pairs_spread(record, stratum, a, b);
    }
}

/* The factor of a stratum's mean in the estimate: scale times weight. */
static buffon_priv_wide estimate_factor(const buffon_priv_record *record, size_t stratum)
{
    const buffon_priv_shape *shape = &record->shape;
    double m;
    memcpy(&m, &shape->scale_m, sizeof m);
    return buffon_priv_wide_mul(buffon_priv_wide_make(m, (int)(int64_t)shape->scale_e),
                                estimate_wide(record->weight[stratum]));
}

/* The mean of an output: the sum over strata of factor times mean. */
static buffon_priv_wide estimate_mean(const buffon_priv_record *record, size_t output)
{
    buffon_priv_wide sum = estimate_wide(0);
    for (size_t s = 0; s < record->shape.strata; s++)
        sum = buffon_priv_wide_add(sum,
                                   buffon_priv_wide_mul(estimate_factor(record, s),
                                                        estimate_stratum_mean(record, s, output)));
    return sum;
}

/* Covariance of the means of two outputs, with the degrees of freedom of Welch (1947) and
 * Satterthwaite (1946): (sum v)^2 / sum (v^2 / dof). */
static estimate_spread estimate_mean_spread(const buffon_priv_record *record, size_t a, size_t b)
{
    buffon_priv_wide sum = estimate_wide(0), sum2 = estimate_wide(0);
    estimate_spread one = {estimate_wide(0), 0};
    for (size_t s = 0; s < record->shape.strata; s++) {
        const buffon_priv_wide factor = estimate_factor(record, s);
        one = estimate_stratum_spread(record, s, a, b);
        one.square = buffon_priv_wide_mul(one.square, buffon_priv_wide_mul(factor, factor));
        sum = buffon_priv_wide_add(sum, one.square);
        sum2 = buffon_priv_wide_add(
            sum2, buffon_priv_wide_div(buffon_priv_wide_mul(one.square, one.square),
                                       estimate_wide(one.dof)));
    }
    if (record->shape.strata > 1 && sum2.m > 0)
        one.dof =
            buffon_priv_wide_to_double(buffon_priv_wide_div(buffon_priv_wide_mul(sum, sum), sum2));
    return (estimate_spread){sum, one.dof};
}

static buffon_priv_wide estimate_value(const buffon_priv_record *record, size_t k)
{
    const buffon_priv_wide mean = estimate_mean(record, k);
    if (record->shape.kind != BUFFON_PRIV_RATIO)
        return mean;
    return buffon_priv_wide_div(mean, estimate_mean(record, (size_t)record->shape.components));
}

/* Covariance of two component estimates. Of ratios R_k = A_k / W to first order: that of
 * (A_k - R_k W) / W. */
static estimate_spread estimate_spread_of(const buffon_priv_record *record, size_t k, size_t l)
{
    estimate_spread v = estimate_mean_spread(record, k, l);
    if (record->shape.kind == BUFFON_PRIV_RATIO) {
        const size_t w = (size_t)record->shape.components;
        const buffon_priv_wide rk = estimate_value(record, k), rl = estimate_value(record, l);
        const buffon_priv_wide weight = estimate_mean(record, w);
        const buffon_priv_wide ww = estimate_mean_spread(record, w, w).square;
        const buffon_priv_wide kw = estimate_mean_spread(record, k, w).square;
        const buffon_priv_wide lw = estimate_mean_spread(record, l, w).square;
        buffon_priv_wide sum = buffon_priv_wide_mul(buffon_priv_wide_mul(rk, rl), ww);
        sum = buffon_priv_wide_add(sum, buffon_priv_wide_negate(buffon_priv_wide_mul(rk, lw)));
        sum = buffon_priv_wide_add(sum, buffon_priv_wide_negate(buffon_priv_wide_mul(rl, kw)));
        v.square = buffon_priv_wide_add(v.square, sum);
        v.square = buffon_priv_wide_div(v.square, buffon_priv_wide_mul(weight, weight));
    }
    if (k == l && v.square.m < 0)
        v.square = estimate_wide(0); /* rounding; a variance is not negative */
    return v;
}

/* The largest part that one value has in the squared error: (y - mean)^2 / (n (n - 1)) of its
 * stratum, over the sum of all. */
static double estimate_share(const buffon_priv_record *record, size_t output)
{
    buffon_priv_wide total = estimate_wide(0), worst = estimate_wide(0);
    for (size_t s = 0; s < record->shape.strata; s++) {
        const size_t variant = estimate_variant(record, s);
        buffon_priv_wide mean = estimate_wide(0), high, low, n2;
        buffon_stats pool;
        estimate_pool(&pool, record, s, 0, (size_t)record->shape.replicates,
                      variant * (size_t)record->shape.outputs + output);
        if (pool.count < 2)
            return NAN;
        if (variant != 2)
            mean = buffon_priv_wide_negate(buffon_priv_stats_mean_wide(&pool));
        n2 = buffon_priv_wide_mul(buffon_priv_wide_count(pool.count),
                                  buffon_priv_wide_count(pool.count - (variant != 2)));
        high = buffon_priv_wide_add(estimate_wide(pool.max), mean);
        low = buffon_priv_wide_add(estimate_wide(pool.min), mean);
        for (unsigned side = 0; side < 2; side++) {
            const buffon_priv_wide d =
                buffon_priv_wide_mul(side ? high : low, estimate_factor(record, s));
            const buffon_priv_wide part = buffon_priv_wide_div(buffon_priv_wide_mul(d, d), n2);
            const buffon_priv_wide less =
                buffon_priv_wide_add(worst, buffon_priv_wide_negate(part));
            if (less.m < 0)
                worst = part;
        }
        const buffon_priv_wide factor = estimate_factor(record, s);
        const buffon_priv_wide var = estimate_pairs_spread(record, s, output, output).square;
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
        estimate_pool(&pool, record, s, 0, (size_t)record->shape.replicates, output);
        out->nonfinite += pool.nonfinite;
        if (pool.count == 0)
            continue;
        const buffon_priv_wide factor = estimate_factor(record, s);
        const double a =
            buffon_priv_wide_to_double(buffon_priv_wide_mul(factor, estimate_wide(pool.min)));
        const double b =
            buffon_priv_wide_to_double(buffon_priv_wide_mul(factor, estimate_wide(pool.max)));
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
    estimate_pool(&pool, record, 0, 0, (size_t)record->shape.replicates,
                  (size_t)record->shape.components);
    const buffon_priv_wide top = estimate_wide(pool.top[0]);
    const buffon_priv_wide sum = buffon_priv_wide_mul(buffon_priv_stats_mean_square(&pool),
                                                      buffon_priv_wide_count(pool.count));
    out->min = out->max = NAN;
    out->tail_index = buffon_priv_tail_index(pool.top, pool.count);
    out->ess = buffon_stats_summary(&pool).ess;
    out->max_share =
        buffon_priv_wide_to_double(buffon_priv_wide_div(buffon_priv_wide_mul(top, top), sum));
}

/* lo and hi. Hits of independent points have Clopper and Pearson's; a spread has Student's, widened
 * by the rounding of the value; no spread and no error mean that nothing is known. */
static void estimate_interval(buffon_estimate *out, const buffon_priv_record *record, double dof)
{
    const buffon_priv_shape *shape = &record->shape;
    const double alpha = (1 - out->confidence) / (double)shape->looks;
    if (shape->kind == BUFFON_PRIV_HITS && shape->design == BUFFON_DESIGN_INDEPENDENT) {
        const buffon_priv_wide scale = estimate_factor(record, 0);
        const uint64_t hits = (uint64_t)(out->acceptance * (double)out->samples + 0.5);
        buffon_priv_clopper_pearson(&out->lo, &out->hi, hits, out->samples, alpha);
        out->lo = buffon_priv_wide_to_double(buffon_priv_wide_mul(scale, estimate_wide(out->lo)));
        out->hi = buffon_priv_wide_to_double(buffon_priv_wide_mul(scale, estimate_wide(out->hi)));
        out->interval = BUFFON_INTERVAL_CLOPPER_PEARSON;
    } else if (out->std_error == 0 && shape->constant) {
        out->lo = out->hi = out->value;
        out->interval = BUFFON_INTERVAL_EXACT;
    } else if (out->std_error > 0 && out->std_error < INFINITY && dof > 0) {
        const double rounding = 0x1p-52 * (out->value < 0 ? -out->value : out->value);
        const double half = buffon_priv_student_two_sided(alpha, dof) * out->std_error + rounding;
        out->lo = out->value - half;
        out->hi = out->value + half;
        out->interval = BUFFON_INTERVAL_STUDENT;
    }
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
    else if (out->std_error != out->std_error || out->std_error == INFINITY)
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
    const buffon_priv_wide factor = estimate_factor(record, 0);
    buffon_stats pool;
    estimate_pool(&pool, record, 0, 0, (size_t)record->shape.replicates, k);
    return buffon_priv_wide_to_double(buffon_priv_wide_mul(buffon_priv_stats_variance(&pool),
                                                           buffon_priv_wide_mul(factor, factor)));
}

static void estimate_component(buffon_estimate *out, const buffon_priv_record *record, size_t k)
{
    const buffon_priv_shape *shape = &record->shape;
    const estimate_spread spread = estimate_spread_of(record, k, k);
    out->value = buffon_priv_wide_to_double(estimate_value(record, k));
    out->std_error = buffon_priv_wide_to_double(buffon_priv_wide_sqrt(spread.square));
    out->variance = estimate_variance(record, k, spread.square, out->samples);
    out->ess = (double)out->samples;
    if (shape->kind == BUFFON_PRIV_HITS)
        out->acceptance = buffon_priv_wide_to_double(estimate_stratum_mean(record, 0, k));
    estimate_extremes(out, record, k);
    if (shape->kind == BUFFON_PRIV_RATIO)
        estimate_weights(out, record);
    else if (shape->design <= BUFFON_DESIGN_STRATIFIED)
        out->max_share = estimate_share(record, k);
    estimate_interval(out, record, spread.dof);
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
        missing |= estimate_stratum_count(record, s) == 0;
    if (!missing && shape->kind == BUFFON_PRIV_RATIO &&
        estimate_mean(record, (size_t)shape->components).m == 0) {
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

buffon_status buffon_partial_covariance(double *cov, const buffon_partial *partial)
{
    const size_t n = buffon_partial_components(partial);
    if (cov == NULL || partial == NULL)
        return BUFFON_E_NULL;
    if (n == 0)
        return BUFFON_E_EMPTY;
    const buffon_priv_record *record = buffon_priv_partial_record(partial);
    buffon_status status = record->shape.covariance ? BUFFON_OK : BUFFON_E_UNSUPPORTED;
    for (size_t s = 0; s < record->shape.strata && status == BUFFON_OK; s++)
        status = estimate_stratum_count(record, s) > 0 ? BUFFON_OK : BUFFON_E_EMPTY;
    for (size_t k = 0; k < n; k++) {
        for (size_t l = 0; l < n; l++) {
            double *entry = &cov[k * n + l];
            if (status != BUFFON_OK)
                *entry = NAN;
            else if (l < k)
                *entry = cov[l * n + k];
            else
                *entry = buffon_priv_wide_to_double(estimate_spread_of(record, k, l).square);
        }
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
                                           .replicates = 1,
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
