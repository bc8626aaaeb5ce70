#include "guard.h"

#include <math.h>
#include <string.h>

#include "exact.h"
#include "net.h"
#include "spread.h"
#include "stats_priv.h"

/* The first cell of a stratum. */
static size_t spread_first(const buffon_priv_record *record, size_t stratum)
{
    return stratum * (size_t)record->shape.per_stratum;
}

void buffon_priv_spread_pool(buffon_stats *pool, const buffon_priv_record *record, size_t stratum,
                             size_t series)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t all = buffon_priv_shape_series(shape), first = spread_first(record, stratum);
    memset(pool, 0, sizeof *pool);
    for (size_t c = first; c < first + shape->per_stratum; c++) {
        const size_t at = c * all + series;
        buffon_stats_merge(pool, &record->whole.stats[at]);
        buffon_stats_merge(pool, &record->tail.stats[at]);
    }
}

/* The sum of one series of some cells and the number of its values; their mean. */
typedef struct spread_sum {
    uint64_t count;
    uint64_t limbs[BUFFON_STATS_SUM];
} spread_sum;

static void spread_add(spread_sum *sum, const buffon_stats *stats)
{
    if (stats->count == 0)
        return;
    sum->count += stats->count;
    buffon_priv_limbs_merge(sum->limbs, stats->sum, BUFFON_STATS_SUM);
}

static buffon_priv_wide spread_mean(uint64_t *count, const buffon_priv_record *record, size_t first,
                                    size_t end, size_t series)
{
    const size_t all = buffon_priv_shape_series(&record->shape);
    spread_sum sum = {0, {0}};
    for (size_t c = first; c < end; c++) {
        spread_add(&sum, &record->whole.stats[c * all + series]);
        spread_add(&sum, &record->tail.stats[c * all + series]);
    }
    *count = sum.count;
    if (sum.count == 0)
        return buffon_priv_wide_of(NAN);
    return buffon_priv_limbs_over(sum.limbs, BUFFON_STATS_SUM, sum.count, BUFFON_PRIV_SUM_UNIT);
}

static void spread_pool_cross(uint64_t *limbs, const buffon_priv_record *record, size_t stratum,
                              size_t variant, size_t a, size_t b)
{
    const buffon_priv_shape *shape = &record->shape;
    const size_t words = buffon_priv_shape_cross(shape);
    const size_t at = buffon_priv_shape_cross_at(shape, variant, a, b);
    memset(limbs, 0, BUFFON_STATS_SQUARES * sizeof *limbs);
    for (size_t r = 0; r < shape->per_stratum; r++) {
        const size_t cell = spread_first(record, stratum) + r;
        const size_t from = cell * words + at;
        buffon_priv_limbs_merge(limbs, record->whole.cross + from, BUFFON_STATS_SQUARES);
        buffon_priv_limbs_merge(limbs, record->tail.cross + from, BUFFON_STATS_SQUARES);
    }
}

buffon_priv_wide buffon_priv_spread_mean(const buffon_priv_record *record, size_t stratum,
                                         size_t output)
{
    const size_t first = spread_first(record, stratum);
    uint64_t count;
    return spread_mean(&count, record, first, first + (size_t)record->shape.per_stratum, output);
}

uint64_t buffon_priv_spread_count(const buffon_priv_record *record, size_t stratum)
{
    const size_t first = spread_first(record, stratum);
    uint64_t count = 0;
    for (size_t c = first; c < first + record->shape.per_stratum; c++)
        count += buffon_priv_record_count(record, c);
    return count;
}

/* Are the blocks of a cell that are done the first ones, none left out? */
static int spread_gapless(const buffon_priv_record *record, size_t cell)
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
static int spread_swept(const buffon_priv_record *record, size_t stratum)
{
    const buffon_priv_shape *shape = &record->shape;
    for (size_t r = 0; r < shape->per_stratum; r++) {
        const size_t cell = spread_first(record, stratum) + r;
        if (buffon_priv_record_count(record, cell) % shape->round != 0 ||
            !spread_gapless(record, cell))
            return 0;
    }
    return 1;
}

/* Which series the error comes from: the values, the means of pairs, or their half differences. */
size_t buffon_priv_spread_variant(const buffon_priv_record *record, size_t stratum)
{
    switch (record->shape.design) {
    case BUFFON_DESIGN_ANTITHETIC:
        return 1;
    case BUFFON_DESIGN_STRATIFIED:
        return spread_swept(record, stratum) ? 2 : 1;
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
buffon_priv_spread buffon_priv_spread_pairs(const buffon_priv_record *record, size_t stratum,
                                            size_t a, size_t b)
{
    const size_t variant = buffon_priv_spread_variant(record, stratum),
                 first = variant * (size_t)record->shape.outputs;
    uint64_t limbs[BUFFON_STATS_SQUARES];
    buffon_stats sa, sb;
    buffon_priv_wide square;
    buffon_priv_spread_pool(&sa, record, stratum, first + a);
    if (variant == 2 && a == b)
        square = buffon_priv_stats_mean_square(&sa);
    else if (a == b)
        square = buffon_priv_stats_variance(&sa);
    else {
        buffon_priv_spread_pool(&sb, record, stratum, first + b);
        spread_pool_cross(limbs, record, stratum, variant, a < b ? a : b, a < b ? b : a);
        square = buffon_priv_cross_covariance(limbs, &sa, &sb);
        if (variant == 2 && sa.count > 1) {
            square = buffon_priv_wide_mul(square, buffon_priv_wide_count(sa.count - 1));
            square = buffon_priv_wide_div(square, buffon_priv_wide_count(sa.count));
            square = buffon_priv_wide_add(square,
                                          buffon_priv_wide_mul(buffon_priv_stats_mean_wide(&sa),
                                                               buffon_priv_stats_mean_wide(&sb)));
        }
    }
    return (buffon_priv_spread){.square =
                                    buffon_priv_wide_div(square, buffon_priv_wide_count(sa.count)),
                                .dof = (double)(sa.count - (variant != 2 && sa.count > 0))};
}

/* Ranges of the least net that has all points of the stratum. More may be wanted: at a look before
 * the last it is the net of that look. */
static size_t spread_ranges(const buffon_priv_record *record, size_t stratum)
{
    const size_t first = spread_first(record, stratum);
    size_t end = (size_t)record->shape.per_stratum;
    while (end > BUFFON_PRIV_NET_RANGES && buffon_priv_record_count(record, first + end - 1) == 0)
        end--;
    return (end + 2) / 4 * 4 + 1;
}

/* Groups of cells that count as one repeat each: replicates, or the eighths of a net. Group g of
 * a stratum is cells group[g], ..., group[g + 1] - 1. Returns their number. */
static size_t spread_groups(size_t group[BUFFON_PRIV_REPLICATES + 1],
                            const buffon_priv_record *record, size_t stratum)
{
    const int net = record->shape.design == BUFFON_DESIGN_NET;
    const size_t groups = net ? BUFFON_PRIV_NET_BLOCKS : (size_t)record->shape.per_stratum;
    const size_t ranges = net ? spread_ranges(record, stratum) : 0;
    for (size_t g = 0; g <= groups; g++)
        group[g] = spread_first(record, stratum) + (net ? buffon_priv_net_eighth(ranges, g) : g);
    return groups;
}

/* Covariance of the means over R groups that have points, with weights w_g = n_g / n:
 * R / (R - 1) sum w_g^2 (a_g - a)(b_g - b), which for equal n_g is the usual sum / (R (R - 1)). */
static buffon_priv_spread spread_repeats(const buffon_priv_record *record, size_t stratum, size_t a,
                                         size_t b)
{
    const buffon_priv_wide mean_a = buffon_priv_spread_mean(record, stratum, a);
    const buffon_priv_wide mean_b = buffon_priv_spread_mean(record, stratum, b);
    const buffon_priv_wide n = buffon_priv_wide_count(buffon_priv_spread_count(record, stratum));
    buffon_priv_wide sum = buffon_priv_wide_of(0);
    size_t group[BUFFON_PRIV_REPLICATES + 1];
    const size_t groups = spread_groups(group, record, stratum);
    uint64_t present = 0;
    for (size_t g = 0; g < groups; g++) {
        uint64_t count;
        buffon_priv_wide weight, da, db;
        da = spread_mean(&count, record, group[g], group[g + 1], a);
        if (count == 0)
            continue;
        present++;
        weight = buffon_priv_wide_div(buffon_priv_wide_count(count), n);
        da = buffon_priv_wide_add(da, buffon_priv_wide_negate(mean_a));
        db = a == b ? da
                    : buffon_priv_wide_add(spread_mean(&count, record, group[g], group[g + 1], b),
                                           buffon_priv_wide_negate(mean_b));
        sum = buffon_priv_wide_add(sum, buffon_priv_wide_mul(buffon_priv_wide_mul(weight, da),
                                                             buffon_priv_wide_mul(weight, db)));
    }
    if (present < 2)
        return (buffon_priv_spread){buffon_priv_wide_of(NAN), 0};
    sum = buffon_priv_wide_mul(sum, buffon_priv_wide_count(present));
    return (buffon_priv_spread){buffon_priv_wide_div(sum, buffon_priv_wide_count(present - 1)),
                                (double)(present - 1)};
}

static buffon_priv_spread spread_stratum(const buffon_priv_record *record, size_t stratum, size_t a,
                                         size_t b)
{
    switch (record->shape.design) {
    case BUFFON_DESIGN_NONE:
        return (buffon_priv_spread){buffon_priv_wide_of(NAN), 0};
    case BUFFON_DESIGN_REPLICATES:
    case BUFFON_DESIGN_NET:
        return spread_repeats(record, stratum, a, b);
    default:
        return buffon_priv_spread_pairs(record, stratum, a, b);
    }
}

/* The factor of a stratum's mean in the estimate: scale times weight. */
buffon_priv_wide buffon_priv_spread_factor(const buffon_priv_record *record, size_t stratum)
{
    const buffon_priv_shape *shape = &record->shape;
    double m;
    memcpy(&m, &shape->scale_m, sizeof m);
    return buffon_priv_wide_mul(buffon_priv_wide_make(m, (int)(int64_t)shape->scale_e),
                                buffon_priv_wide_of(record->weight[stratum]));
}

/* The mean of an output from cells r to end - 1 of each stratum: the sum over strata of factor
 * times mean. */
static buffon_priv_wide spread_output(const buffon_priv_record *record, size_t r, size_t end,
                                      size_t output)
{
    buffon_priv_wide sum = buffon_priv_wide_of(0);
    for (size_t s = 0; s < record->shape.strata; s++) {
        const size_t first = spread_first(record, s);
        uint64_t count;
        sum = buffon_priv_wide_add(
            sum, buffon_priv_wide_mul(buffon_priv_spread_factor(record, s),
                                      spread_mean(&count, record, first + r, first + end, output)));
    }
    return sum;
}

buffon_priv_wide buffon_priv_spread_output(const buffon_priv_record *record, size_t output)
{
    return spread_output(record, 0, (size_t)record->shape.per_stratum, output);
}

/* Covariance of the means of two outputs, with the degrees of freedom of Welch (1947) and
 * Satterthwaite (1946): (sum v)^2 / sum (v^2 / dof). */
static buffon_priv_spread spread_output_covariance(const buffon_priv_record *record, size_t a,
                                                   size_t b)
{
    buffon_priv_wide sum = buffon_priv_wide_of(0), sum2 = buffon_priv_wide_of(0);
    buffon_priv_spread one = {buffon_priv_wide_of(0), 0};
    for (size_t s = 0; s < record->shape.strata; s++) {
        const buffon_priv_wide factor = buffon_priv_spread_factor(record, s);
        one = spread_stratum(record, s, a, b);
        one.square = buffon_priv_wide_mul(one.square, buffon_priv_wide_mul(factor, factor));
        sum = buffon_priv_wide_add(sum, one.square);
        sum2 = buffon_priv_wide_add(
            sum2, buffon_priv_wide_div(buffon_priv_wide_mul(one.square, one.square),
                                       buffon_priv_wide_of(one.dof)));
    }
    if (record->shape.strata > 1 && sum2.m > 0)
        one.dof =
            buffon_priv_wide_to_double(buffon_priv_wide_div(buffon_priv_wide_mul(sum, sum), sum2));
    return (buffon_priv_spread){sum, one.dof};
}

static buffon_priv_wide spread_value(const buffon_priv_record *record, size_t r, size_t end,
                                     size_t k)
{
    const size_t weight = (size_t)record->shape.components;
    const buffon_priv_wide mean = spread_output(record, r, end, k);
    if (record->shape.kind != BUFFON_PRIV_RATIO)
        return mean;
    return buffon_priv_wide_div(mean, spread_output(record, r, end, weight));
}

buffon_priv_wide buffon_priv_spread_value(const buffon_priv_record *record, size_t k)
{
    return spread_value(record, 0, (size_t)record->shape.per_stratum, k);
}

buffon_priv_wide buffon_priv_spread_replicate(const buffon_priv_record *record, size_t r, size_t k)
{
    return spread_value(record, r, r + 1, k);
}

/* x y, negated. */
static buffon_priv_wide spread_less(buffon_priv_wide x, buffon_priv_wide y)
{
    return buffon_priv_wide_negate(buffon_priv_wide_mul(x, y));
}

/* Covariance of two ratios R_k = A_k / W, to first order that of (A_k - R_k W) / W:
 *
 *     (V_kl - R_k V_lw - R_l V_kw + R_k R_l V_ww) / W^2
 *
 * Where all values of f are far from 0 the four terms cancel. Each was rounded a few times, so a
 * variance is known within 2^-51 of their sizes: if it is no more than that, no spread was seen,
 * and else it is made larger by that. */
static buffon_priv_spread spread_ratio(const buffon_priv_record *record, size_t k, size_t l)
{
    const size_t w = (size_t)record->shape.components;
    const buffon_priv_wide rk = buffon_priv_spread_value(record, k);
    const buffon_priv_wide rl = buffon_priv_spread_value(record, l);
    const buffon_priv_wide weight = buffon_priv_spread_output(record, w);
    const buffon_priv_wide ww = spread_output_covariance(record, w, w).square;
    const buffon_priv_wide term[3] = {
        spread_less(rk, spread_output_covariance(record, l, w).square),
        spread_less(rl, spread_output_covariance(record, k, w).square),
        buffon_priv_wide_mul(buffon_priv_wide_mul(rk, rl), ww)};
    buffon_priv_spread v = spread_output_covariance(record, k, l);
    buffon_priv_wide size = v.square;
    for (size_t i = 0; i < 3; i++) {
        const buffon_priv_wide t = term[i];
        v.square = buffon_priv_wide_add(v.square, t);
        size = buffon_priv_wide_add(size, t.m < 0 ? buffon_priv_wide_negate(t) : t);
    }
    if (k == l) {
        const buffon_priv_wide bound = buffon_priv_wide_mul(size, buffon_priv_wide_of(0x1p-51));
        const int seen = buffon_priv_wide_add(v.square, buffon_priv_wide_negate(bound)).m > 0;
        v.square = seen ? buffon_priv_wide_add(v.square, bound) : buffon_priv_wide_of(0);
    }
    v.square = buffon_priv_wide_div(v.square, buffon_priv_wide_mul(weight, weight));
    return v;
}

buffon_priv_spread buffon_priv_spread_of(const buffon_priv_record *record, size_t k, size_t l)
{
    buffon_priv_spread v;
    if (record->shape.kind == BUFFON_PRIV_RATIO)
        return spread_ratio(record, k, l);
    v = spread_output_covariance(record, k, l);
    if (k == l && v.square.m < 0)
        v.square = buffon_priv_wide_of(0); /* rounding; a variance is not negative */
    return v;
}
