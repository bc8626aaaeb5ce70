/* Partial results as values: merging and what it refuses, gaps, and calls that make no sense. */
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

static buffon_status solve(buffon_partial *partial, const problem *p, buffon_run run)
{
    buffon_estimate e[PROBLEMS_COMPONENTS];
    run.partial = partial;
    return p->solve(e, run);
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

/* A refused run leaves a partial that holds something as it is. */
static void test_refused(void)
{
    variation v = {.run = {.samples = 3000}, .hi = 1};
    buffon_partial partial = {0};
    size_t size, now;
    int good = vary(&partial, &v) >= 0;
    unsigned char *const was = save(&partial, &size);
    v.run.samples = 9000;
    v.run.confidence = 7;
    good &= vary(&partial, &v) == BUFFON_E_CONFIDENCE;
    v.run.confidence = 0;
    v.run.seed = 1;
    good &= vary(&partial, &v) == BUFFON_E_MISMATCH;
    v.run.seed = 0;
    v.run.parts = 2;
    good &= vary(&partial, &v) == BUFFON_E_MISMATCH;
    unsigned char *const is = save(&partial, &now);
    tap_ok(good && size == now && memcmp(was, is, size) == 0, "a refused run leaves it as it was");
    free(was);
    free(is);
    buffon_partial_free(&partial);
}

int main(void)
{
    test_mismatch();
    test_samples();
    test_overlap();
    test_gap();
    test_gap_before_tail();
    test_nulls();
    test_confidence();
    test_refused();
    return tap_done();
}
