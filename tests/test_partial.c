/* Partial results as values: saving and loading, damage, merging and what it refuses. */
#include <stdlib.h>

#include "problems.h"
#include "tap.h"

static unsigned char *save(const buffon_partial *partial, size_t *size)
{
    *size = buffon_partial_size(partial);
    unsigned char *bytes = malloc(*size);
    if (bytes == NULL || buffon_partial_save(bytes, *size, partial) != BUFFON_OK)
        exit(1);
    return bytes;
}

static int same_partial(const buffon_partial *a, const buffon_partial *b)
{
    size_t na, nb;
    unsigned char *const ba = save(a, &na), *const bb = save(b, &nb);
    const int same = na == nb && memcmp(ba, bb, na) == 0;
    free(ba);
    free(bb);
    return same;
}

static buffon_status solve(buffon_partial *partial, const problem *p, buffon_run run)
{
    buffon_estimate e[PROBLEMS_COMPONENTS];
    run.partial = partial;
    return p->solve(e, run);
}

/* ---- saving and loading ---- */

static void test_round_trip(const problem *p)
{
    buffon_partial partial = {0}, loaded = {0}, early = {0};
    buffon_estimate e[PROBLEMS_COMPONENTS], again[PROBLEMS_COMPONENTS];
    size_t size;
    buffon_run run = {.samples = 5000, .seed = 1, .block = 256};
    run.partial = &partial;
    const buffon_status status = p->solve(e, run);
    unsigned char *bytes = save(&partial, &size);
    int good = buffon_partial_load(&loaded, bytes, size) == BUFFON_OK;
    good &= same_partial(&partial, &loaded);
    good &= buffon_partial_components(&loaded) == p->components;
    good &= buffon_partial_estimate(again, &loaded, 0) == status;
    good &= same_estimates(e, again, p->components);
    /* The size is that of the problem, not of what is done. */
    good &= solve(&early, p, (buffon_run){.samples = 20, .seed = 1, .block = 256}) >= 0;
    good &= buffon_partial_size(&early) == size;
    /* Loading frees what it replaces (seen by the sanitizers), and longer bytes are allowed. */
    unsigned char *longer = malloc(size + 9);
    if (longer == NULL)
        exit(1);
    memcpy(longer, bytes, size);
    memset(longer + size, 0xee, 9);
    good &= buffon_partial_load(&early, longer, size + 9) == BUFFON_OK;
    good &= same_partial(&early, &partial);
    tap_ok(good, "%s: saved (%zu bytes) and loaded", p->name, size);
    free(longer);
    free(bytes);
    buffon_partial_free(&partial);
    buffon_partial_free(&loaded);
    buffon_partial_free(&early);
}

static void test_empty(void)
{
    buffon_partial empty = {0}, loaded = {0}, full = {0};
    buffon_estimate e;
    double cov = 0;
    size_t size;
    unsigned char *bytes = save(&empty, &size);
    tap_ok(size > 0 && buffon_partial_load(&loaded, bytes, size) == BUFFON_OK &&
               loaded.more == NULL && buffon_partial_components(&loaded) == 0,
           "an empty partial travels");
    if (solve(&full, &problems[0], (buffon_run){.samples = 100}) < 0)
        exit(1);
    tap_ok(buffon_partial_load(&full, bytes, size) == BUFFON_OK && full.more == NULL,
           "loading an empty one frees what was there");
    tap_ok(buffon_partial_estimate(&e, &empty, 0) == BUFFON_E_EMPTY &&
               is_refusal(&e, BUFFON_E_EMPTY),
           "it has no estimate");
    tap_ok(buffon_partial_covariance(&cov, &empty) == BUFFON_E_EMPTY, "and no covariance");
    tap_ok(buffon_partial_merge(&full, &empty) == BUFFON_OK && full.more == NULL,
           "empty and empty is empty");
    tap_ok(buffon_partial_merge(&empty, &empty) == BUFFON_OK, "even into itself");
    buffon_partial_free(&empty);
    buffon_partial_free(&empty);
    buffon_partial_free(NULL);
    tap_ok(buffon_partial_size(NULL) == 0 && buffon_partial_components(NULL) == 0,
           "NULL has no size and no components");
    free(bytes);
}

/* ---- the form of the bytes ---- */

static uint64_t word_at(const unsigned char *bytes, size_t word)
{
    uint64_t value = 0;
    for (unsigned i = 0; i < 8; i++)
        value |= (uint64_t)bytes[8 * word + i] << (8 * i);
    return value;
}

static void word_put(unsigned char *bytes, size_t word, uint64_t value)
{
    for (unsigned i = 0; i < 8; i++)
        bytes[8 * word + i] = (unsigned char)(value >> (8 * i));
}

/* FNV-1a. */
static uint64_t checksum(const unsigned char *bytes, size_t n)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static double double_at(const unsigned char *bytes, size_t word)
{
    const uint64_t bits = word_at(bytes, word);
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static double eighth(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] < 0.25 ? -2.5 : 3;
}

/* Four points by replay in blocks of 16: one short block. The layout is magic, version, words,
 * shape (15), weight, target, done, then the statistics of whole blocks and of the short one,
 * checksum. */
static void test_layout(void)
{
    static const double u[] = {0.125, 0.375, 0.625, 0.875};
    const buffon_points points = buffon_points_replay(u, 1, 4, BUFFON_DESIGN_INDEPENDENT);
    const buffon_integrand f = {.scalar = eighth, .dim = 1};
    const double lo = 0, hi = 1;
    buffon_partial partial = {0};
    const buffon_run run = {.samples = 4, .block = 16, .points = &points, .partial = &partial};
    enum { STATS = 4 + BUFFON_STATS_SUM + BUFFON_STATS_SQUARES + BUFFON_STATS_TOP };
    enum { TARGET = 3 + 15 + 1, WHOLE = TARGET + 2, TAIL = WHOLE + STATS, END = TAIL + STATS };
    buffon_estimate e;
    size_t size;
    if (buffon_uniform(&e, &f, &lo, &hi, &run) < 0)
        exit(1);
    unsigned char *b = save(&partial, &size);
    tap_ok(size == 8 * (END + 1), "%zu words", size / 8);
    tap_ok(memcmp(b, "BPARTIAL", 8) == 0 && word_at(b, 1) == 1 && word_at(b, 2) == size / 8,
           "magic, version and size, little end first");
    tap_ok(word_at(b, 12) == 16 && word_at(b, TARGET) == 4 && word_at(b, TARGET + 1) == 0 &&
               double_at(b, TARGET - 1) == 1,
           "block, weight, target, and no whole block done");
    tap_ok(word_at(b, WHOLE) == 0 && word_at(b, TAIL) == 4 && double_at(b, TAIL + 2) == -2.5 &&
               double_at(b, TAIL + 3) == 3,
           "count and extremes of the short block");
    /* The sum 6.5 = 13 2^-1 in units of 2^-1152: bit 1151 on is limb 17, bit 63. */
    tap_ok(word_at(b, TAIL + 4 + 17) == UINT64_C(13) << 63 &&
               word_at(b, TAIL + 4 + 18) == UINT64_C(13) >> 1 && word_at(b, TAIL + 4 + 19) == 0,
           "the sum, a fixed-point number");
    /* The squares 33.25 = 133 2^-2 in units of 2^-2304: bit 2302 is limb 35, bit 62. */
    const size_t squares = TAIL + 4 + BUFFON_STATS_SUM;
    tap_ok(word_at(b, squares + 35) == UINT64_C(133) << 62 &&
               word_at(b, squares + 36) == UINT64_C(133) >> 2,
           "the sum of squares");
    const size_t top = squares + BUFFON_STATS_SQUARES;
    tap_ok(double_at(b, top) == 3 && double_at(b, top + 3) == 2.5 && double_at(b, top + 4) == 0,
           "the largest magnitudes");
    tap_ok(word_at(b, END) == checksum(b, size - 8), "the checksum is FNV-1a of what precedes it");
    free(b);
    buffon_partial_free(&partial);
}

/* ---- damage ---- */

static void test_damage(void)
{
    buffon_partial partial = {0}, kept = {0};
    size_t size;
    int truncated = 1, flipped = 1;
    if (solve(&partial, &problems[8], (buffon_run){.samples = 300, .block = 16}) < 0 ||
        solve(&kept, &problems[0], (buffon_run){.samples = 300}) < 0)
        exit(1);
    const void *before = kept.more;
    unsigned char *bytes = save(&partial, &size);
    for (size_t n = 0; n < size; n++) {
        /* Of exactly the size, so that the sanitizers see a read beyond. */
        unsigned char *part = malloc(n > 0 ? n : 1);
        if (part == NULL)
            exit(1);
        memcpy(part, bytes, n);
        truncated &= buffon_partial_load(&kept, part, n) == BUFFON_E_SIZE && kept.more == before;
        free(part);
    }
    tap_ok(truncated, "bytes cut off anywhere are too few");
    for (size_t i = 0; i < size; i++) {
        if (i > 200 && i + 200 < size && i % 37 != 0)
            continue;
        for (unsigned flip = 1; flip < 256; flip = flip * 3 + 1) {
            bytes[i] ^= (unsigned char)flip;
            const buffon_status status = buffon_partial_load(&kept, bytes, size);
            flipped &=
                (status == BUFFON_E_CORRUPT || status == BUFFON_E_SIZE) && kept.more == before;
            flipped &= i >= 16 || status == BUFFON_E_CORRUPT; /* magic or version */
            bytes[i] ^= (unsigned char)flip;
        }
    }
    tap_ok(flipped, "a changed byte anywhere is noticed, and the old partial stays");
    tap_ok(buffon_partial_save(bytes, size - 1, &partial) == BUFFON_E_SIZE, "save wants its size");
    free(bytes);
    buffon_partial_free(&partial);
    buffon_partial_free(&kept);
}

/* Bytes that are whole but no run could have left: a word changed, the checksum made anew. */
static int forged(unsigned char *bytes, size_t size, size_t word, uint64_t value)
{
    buffon_partial partial = {0};
    const uint64_t was = word_at(bytes, word), sum = word_at(bytes, size / 8 - 1);
    word_put(bytes, word, value);
    word_put(bytes, size / 8 - 1, checksum(bytes, size - 8));
    const buffon_status status = buffon_partial_load(&partial, bytes, size);
    buffon_partial_free(&partial);
    word_put(bytes, word, was);
    word_put(bytes, size / 8 - 1, sum);
    return status == BUFFON_E_CORRUPT;
}

/* One cell in three parts: 4 of its 5 blocks and the short one are there. */
static void test_forged(void)
{
    static const struct {
        const char *name;
        size_t word;
        uint64_t value;
    } shape[] = {{"kind", 4, 3},           {"design", 5, 5},
                 {"no components", 6, 0},  {"too many components", 6, (UINT64_C(1) << 20) + 1},
                 {"outputs", 7, 2},        {"covariance", 8, 2},
                 {"constant", 9, 2},       {"no strata", 10, 0},
                 {"no replicates", 11, 0}, {"too many replicates", 11, 257},
                 {"block", 12, 48},        {"round", 13, 0},
                 {"no parts", 16, 0},      {"more parts", 16, 4},
                 {"no looks", 17, 0},      {"too many looks", 17, 65}};
    enum { TARGET = 3 + 15 + 1, DONE = TARGET + 1, WHOLE = DONE + 3 };
    enum { TAIL = WHOLE + 4 + BUFFON_STATS_SUM + BUFFON_STATS_SQUARES + BUFFON_STATS_TOP };
    buffon_partial partial = {0}, part = {0};
    size_t size;
    buffon_run run = {.samples = 90, .block = 16, .parts = 3, .part = 0};
    int good = solve(&partial, &problems[0], run) > 0; /* blocks 0 and 3 */
    run.part = 2;                                      /* blocks 2 and 5, the short one */
    good &= solve(&part, &problems[0], run) > 0;
    good &= buffon_partial_merge(&partial, &part) == BUFFON_OK;
    unsigned char *b = save(&partial, &size);
    tap_ok(good && word_at(b, TARGET) == 90 && word_at(b, DONE) == 2 && word_at(b, DONE + 1) == 0 &&
               word_at(b, DONE + 2) == 1 && word_at(b, WHOLE) == 48 && word_at(b, TAIL) == 10,
           "a partial to forge");
    for (size_t i = 0; i < sizeof shape / sizeof *shape; i++)
        tap_ok(forged(b, size, shape[i].word, shape[i].value), "forged: %s", shape[i].name);
    tap_ok(forged(b, size, DONE, 3) && forged(b, size, DONE, 1) && forged(b, size, DONE + 1, 1) &&
               forged(b, size, DONE, UINT64_MAX),
           "forged: blocks that the sums do not hold");
    tap_ok(forged(b, size, WHOLE, 64) && forged(b, size, WHOLE, 0),
           "forged: counts of whole blocks");
    tap_ok(forged(b, size, TAIL, 9) && forged(b, size, TAIL, 11),
           "forged: count of the short block");
    tap_ok(forged(b, size, TARGET, 91) && forged(b, size, TARGET, 30), "forged: target");
    free(b);
    buffon_partial_free(&partial);
    buffon_partial_free(&part);
}

/* ---- merging ---- */

/* Merging must refuse and leave both as they are. */
static int refuses(buffon_partial *a, const buffon_partial *b, buffon_status status)
{
    size_t na, nb, size;
    unsigned char *const ba = save(a, &na), *const bb = save(b, &nb);
    int good = buffon_partial_merge(a, b) == status;
    unsigned char *again = save(a, &size);
    good &= size == na && memcmp(ba, again, na) == 0;
    free(again);
    again = save(b, &size);
    good &= size == nb && memcmp(bb, again, nb) == 0;
    free(again);
    free(ba);
    free(bb);
    return good;
}

static double cube(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0] * x[0];
}

/* The run that others are compared with, and all in which they may differ. */
typedef struct variation {
    buffon_run run;
    double lo, hi, height, share;
    int estimator, dim;
} variation;

static buffon_status vary(buffon_partial *partial, const variation *v)
{
    const double lo[] = {v->lo, 0}, hi[] = {v->hi, 1};
    const size_t dim = v->dim > 0 ? (size_t)v->dim : 1;
    const buffon_integrand f = {.scalar = cube, .dim = dim};
    const buffon_density g =
        v->estimator == 4 ? buffon_segment(v->lo, v->hi + 1) : buffon_box(lo, hi, dim);
    const buffon_density disk = buffon_disk(v->hi);
    const buffon_integrand plane = {.scalar = cube, .dim = 2};
    const buffon_stratum list[] = {{.density = &g, .weight = v->height, .share = v->share}};
    const buffon_strata strata = {.stratum = list, .count = 1};
    buffon_run run = v->run;
    buffon_estimate e;
    run.partial = partial;
    switch (v->estimator) {
    case 0:
        return buffon_uniform(&e, &f, lo, hi, &run);
    case 1:
        return buffon_rejection(&e, &f, lo, hi, v->height, &run);
    case 2:
        return buffon_expectation(&e, &f, &g, &run);
    case 3:
        return buffon_expectation(&e, &plane, &disk, &run);
    case 4:
        return buffon_importance(&e, &f, &g, &run);
    case 5:
        return buffon_self_normalised(&e, &f, &f, &g, &run);
    case 6:
        return buffon_stratified(&e, &f, &strata, &run);
    default:
        return buffon_importance(&e, &f, &g, &run);
    }
}

static void mismatch(const char *name, const variation *base, const variation *other)
{
    variation a = *base, b = *other;
    buffon_partial pa = {0}, pb = {0};
    a.run.part = 0;
    b.run.part = 1;
    const int good = vary(&pa, &a) >= 0 && vary(&pb, &b) >= 0;
    tap_ok(good && refuses(&pa, &pb, BUFFON_E_MISMATCH) && refuses(&pb, &pa, BUFFON_E_MISMATCH),
           "another %s is another run", name);
    /* Nor does a run go on from it; which leaves it as it is. */
    b.run.part = 0;
    size_t na, size;
    unsigned char *const before = save(&pa, &na);
    const buffon_status status = vary(&pa, &b);
    unsigned char *const after = save(&pa, &size);
    tap_ok(status == BUFFON_E_MISMATCH && size == na && memcmp(before, after, na) == 0,
           "another %s: nor does it go on from there", name);
    free(before);
    free(after);
    buffon_partial_free(&pa);
    buffon_partial_free(&pb);
}

static void test_mismatch(void)
{
    const buffon_points pairs = buffon_points_antithetic(), jitter = buffon_points_jitter(3);
    const buffon_points finer = buffon_points_jitter(9), kronecker = problem_kronecker();
    const variation base = {
        .run = {.samples = 5000, .block = 256, .parts = 2}, .lo = 0, .hi = 1, .height = 1};
    variation v = base, w;
    v.run.seed = 1;
    mismatch("seed", &base, &v);
    v = base, v.run.stream = 1;
    mismatch("stream", &base, &v);
    v = base, v.run.id = 1;
    mismatch("id", &base, &v);
    v = base, v.run.block = 512;
    mismatch("block", &base, &v);
    v = base, v.run.on_nonfinite = BUFFON_NONFINITE_ZERO;
    mismatch("treatment of non-finite values", &base, &v);
    v = base, v.run.constant = 1;
    mismatch("certainty of a constant", &base, &v);
    v = base, v.run.covariance = 1;
    mismatch("choice of covariance", &base, &v);
    v = base, v.run.points = &pairs;
    mismatch("point set (pairs)", &base, &v);
    v.run.points = &jitter;
    mismatch("point set (jitter)", &base, &v);
    w = v, w.run.points = &finer;
    mismatch("parameter of the point set", &v, &w);
    w.run.points = &kronecker;
    mismatch("number of replicates", &base, &w);
    v = base, v.run.parts = 3;
    mismatch("number of parts", &base, &v);
    v = base, v.hi = 2;
    mismatch("upper bound", &base, &v);
    v = base, v.lo = 0.5;
    mismatch("lower bound", &base, &v);
    v = base, v.dim = 2;
    mismatch("dimension", &base, &v);
    for (int estimator = 1; estimator < 7; estimator++) {
        v = base, v.estimator = estimator;
        mismatch("estimator", &base, &v);
    }
    v = base, v.estimator = 1;
    w = v, w.height = 2;
    mismatch("height", &v, &w);
    v = base, v.estimator = 3;
    w = v, w.hi = 2;
    mismatch("radius of the density", &v, &w);
    v = base, v.estimator = 6;
    w = v, w.height = 2;
    mismatch("weight of a stratum", &v, &w);
    w = v, w.share = 2;
    mismatch("share of a stratum", &v, &w);
}

/* Other samples is not another run: a run goes on. But it does not merge. */
static void test_samples(void)
{
    const variation base = {.run = {.samples = 5000, .block = 256, .parts = 2}, .hi = 1};
    variation more = base;
    buffon_partial a = {0}, b = {0};
    more.run.samples = 6000;
    more.run.part = 1;
    int good = vary(&a, &base) >= 0 && vary(&b, &more) >= 0;
    tap_ok(good && refuses(&a, &b, BUFFON_E_MISMATCH), "parts of different samples do not merge");
    more.run.part = 0;
    good &= vary(&a, &more) >= 0;
    tap_ok(good && buffon_partial_merge(&a, &b) == BUFFON_OK, "until the shorter one is extended");
    buffon_partial_free(&a);
    buffon_partial_free(&b);
}

static void test_overlap(void)
{
    const variation base = {.run = {.samples = 5000, .block = 256, .parts = 3}, .hi = 1};
    variation v = base;
    buffon_partial part[3] = {{{0}, NULL}}, again = {0}, both = {0};
    for (uint32_t i = 0; i < 3; i++) {
        v.run.part = i;
        if (vary(&part[i], &v) < 0)
            exit(1);
    }
    v.run.part = 1;
    int good = vary(&again, &v) >= 0;
    tap_ok(good && refuses(&part[1], &again, BUFFON_E_OVERLAP), "the same part twice");
    tap_ok(refuses(&part[1], &part[1], BUFFON_E_OVERLAP), "a part into itself");
    good = buffon_partial_merge(&both, &part[0]) == BUFFON_OK;
    good &= buffon_partial_merge(&both, &part[1]) == BUFFON_OK;
    good &= buffon_partial_merge(&again, &part[2]) == BUFFON_OK;
    tap_ok(good && refuses(&both, &again, BUFFON_E_OVERLAP), "two merged ones that share a part");
    v.run.part = 0;
    good = vary(&both, &v) == BUFFON_E_MISMATCH;
    v.run.part = 1;
    tap_ok(good && vary(&both, &v) == BUFFON_E_MISMATCH,
           "a part does not go on from what holds others");
    v.run.part = 0;
    buffon_partial_free(&again);
    good = vary(&again, &v) >= 0;
    tap_ok(good && refuses(&part[0], &again, BUFFON_E_OVERLAP), "a part without the short block");
    for (int i = 0; i < 3; i++)
        buffon_partial_free(&part[i]);
    buffon_partial_free(&again);
    buffon_partial_free(&both);
    /* Runs with nothing but a short block. */
    v.run = (buffon_run){.samples = 100};
    good = vary(&part[0], &v) >= 0 && vary(&part[1], &v) >= 0;
    tap_ok(good && refuses(&part[0], &part[1], BUFFON_E_OVERLAP), "a short block twice");
    buffon_partial_free(&part[0]);
    v.run = (buffon_run){.samples = 100, .parts = 2};
    good = vary(&part[0], &v) >= 0;
    v.run.part = 1;
    tap_ok(good && vary(&part[0], &v) == BUFFON_E_MISMATCH,
           "a part does not go on from another's short block");
    buffon_partial_free(&part[0]);
    buffon_partial_free(&part[1]);
}

/* A gap is a reservation; where the points come in sweeps, it also breaks them up. */
static void test_gap(void)
{
    const buffon_points jitter = buffon_points_jitter(1024);
    variation v = {.run = {.samples = 16384, .parts = 4, .points = &jitter}, .hi = 1};
    buffon_partial all = {0}, part = {0};
    buffon_estimate e;
    int good = 1;
    for (uint32_t i = 0; i < 4; i++) {
        v.run.part = i;
        good &= vary(&part, &v) == BUFFON_W_INCOMPLETE;
        good &= i == 2 || buffon_partial_merge(&all, &part) == BUFFON_OK;
        if (i == 2)
            good &= buffon_partial_merge(&part, &all) == BUFFON_OK;
        const buffon_status status = buffon_partial_estimate(&e, i == 2 ? &part : &all, 0);
        good &= status == BUFFON_W_INCOMPLETE && e.samples == 4096 * (i == 3 ? 3 : i + 1);
        /* A sweep is two blocks: the parts hold halves of different ones, in which the spread
         * between the cells shows; a whole sweep has nearly none. */
        good &= e.std_error > 1e-3;
        buffon_partial_free(&part);
    }
    tap_ok(good, "a gap is a reservation, and its error bar knows of it");
    v.run.part = 2;
    good = vary(&part, &v) >= 0 && buffon_partial_merge(&all, &part) == BUFFON_OK;
    good &= buffon_partial_estimate(&e, &all, 0) == BUFFON_OK && e.samples == 16384;
    tap_ok(good && e.std_error < 1e-4, "filled, it is gone (%.1e)", e.std_error);
    buffon_partial_free(&part);
    buffon_partial_free(&all);
}

/* Two blocks and the short last one have the points of three sweeps, but are not three sweeps. */
static void test_gap_before_tail(void)
{
    static const uint32_t have[] = {0, 1, 5};
    const buffon_points jitter = buffon_points_jitter(384);
    variation v = {.run = {.samples = 5376, .parts = 6, .points = &jitter}, .hi = 1};
    buffon_partial all = {0}, part = {0};
    buffon_estimate e;
    int good = 1;
    for (int i = 0; i < 3; i++) {
        v.run.part = have[i];
        good &= vary(&part, &v) == BUFFON_W_INCOMPLETE;
        good &= buffon_partial_merge(&all, &part) == BUFFON_OK;
        buffon_partial_free(&part);
    }
    good &= buffon_partial_estimate(&e, &all, 0) == BUFFON_W_INCOMPLETE && e.samples == 2304;
    tap_ok(good && e.std_error > 1e-3, "a gap before the short last block too (%.1e)", e.std_error);
    buffon_partial_free(&all);
}

static void test_nulls(void)
{
    buffon_partial partial = {0};
    unsigned char bytes[512];
    buffon_estimate e;
    double cov[9];
    if (solve(&partial, &problems[0], (buffon_run){.samples = 100}) < 0)
        exit(1);
    tap_ok(buffon_partial_merge(NULL, &partial) == BUFFON_E_NULL &&
               buffon_partial_merge(&partial, NULL) == BUFFON_E_NULL,
           "merge with NULL");
    tap_ok(buffon_partial_estimate(NULL, &partial, 0) == BUFFON_E_NULL &&
               buffon_partial_estimate(&e, NULL, 0) == BUFFON_E_NULL &&
               is_refusal(&e, BUFFON_E_NULL),
           "estimate of or into NULL");
    static const double bad[] = {1, -0.5, 2, NAN, INFINITY};
    for (int i = 0; i < 5; i++)
        tap_ok(buffon_partial_estimate(&e, &partial, bad[i]) == BUFFON_E_CONFIDENCE &&
                   is_refusal(&e, BUFFON_E_CONFIDENCE),
               "confidence %g", bad[i]);
    tap_ok(buffon_partial_covariance(NULL, &partial) == BUFFON_E_NULL &&
               buffon_partial_covariance(cov, NULL) == BUFFON_E_NULL,
           "covariance of or into NULL");
    tap_ok(buffon_partial_covariance(cov, &partial) == BUFFON_E_UNSUPPORTED && isnan(cov[0]),
           "covariance that was not kept");
    tap_ok(buffon_partial_save(NULL, 512, &partial) == BUFFON_E_NULL &&
               buffon_partial_save(bytes, 512, NULL) == BUFFON_E_NULL,
           "save of or into NULL");
    tap_ok(buffon_partial_load(NULL, bytes, 512) == BUFFON_E_NULL &&
               buffon_partial_load(&partial, NULL, 512) == BUFFON_E_NULL,
           "load of or into NULL");
    buffon_partial_free(&partial);
}

/* Intervals at another confidence from what is kept. */
static void test_confidence(void)
{
    buffon_partial partial = {0};
    buffon_estimate e, wide;
    const buffon_run run = {.samples = 1000, .partial = &partial};
    int good = problems[0].solve(&e, run) == BUFFON_OK;
    good &= buffon_partial_estimate(&wide, &partial, 0.999) == BUFFON_OK;
    tap_ok(good && wide.value == e.value && wide.lo < e.lo && wide.hi > e.hi &&
               wide.confidence == 0.999 && e.confidence == 0.95,
           "another confidence, afterwards");
    buffon_partial_free(&partial);
}

int main(void)
{
    for (int i = 0; i < PROBLEMS; i++)
        test_round_trip(&problems[i]);
    test_empty();
    test_layout();
    test_damage();
    test_forged();
    test_mismatch();
    test_samples();
    test_overlap();
    test_gap();
    test_gap_before_tail();
    test_nulls();
    test_confidence();
    return tap_done();
}
