/* Saved partial results: they travel, their bytes have the form that is documented, and damage of
 * any kind is noticed. */
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
    /* The size is that of the problem, not of what is done; a net's has to do with its samples. */
    good &= solve(&early, p, (buffon_run){.samples = 20, .seed = 1, .block = 256}) >= 0;
    good &= p->solve == problem_net ? buffon_partial_size(&early) < size
                                    : buffon_partial_size(&early) == size;
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
    } shape[] = {{"kind", 4, 3},           {"design", 5, 7},
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

/* One part of many of a net of 2^8 points: hardly anything is done, so that no count gives a wrong
 * target away. The targets of cells are the sizes of ranges and nothing else. */
static void test_forged_net(void)
{
    enum { PARTS = 64, TARGET = 3 + 15 + 1, RANGES = 13 + 2 * 4 };
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    buffon_partial partial = {0};
    size_t size;
    int refused = 1;
    const buffon_run run = {
        .samples = 256, .block = 1024, .points = &net, .part = 2, .parts = PARTS};
    const buffon_status status = solve(&partial, &problems[0], run); /* range 2 alone */
    unsigned char *b = save(&partial, &size);
    tap_ok(status >= 0 && word_at(b, 5) == BUFFON_DESIGN_NET && word_at(b, 11) == RANGES &&
               word_at(b, TARGET) == 8 && word_at(b, TARGET + 1) == 2 &&
               word_at(b, TARGET + RANGES - 1) == 32,
           "a net to forge");
    for (size_t r = 0; r < RANGES; r++) {
        const uint64_t points = word_at(b, TARGET + r);
        refused &= forged(b, size, TARGET + r, 0) && forged(b, size, TARGET + r, points + 1) &&
                   forged(b, size, TARGET + r, 2 * points) &&
                   forged(b, size, TARGET + r, UINT64_MAX);
    }
    tap_ok(refused, "forged: sizes of ranges");
    for (size_t r = RANGES - 4; r < RANGES; r++)
        word_put(b, TARGET + r, 0);
    tap_ok(!forged(b, size, TARGET, 8) && forged(b, size, TARGET + RANGES - 1, 32) &&
               forged(b, size, TARGET + RANGES - 4, 32),
           "forged: a shell is there whole or not at all");
    for (uint64_t ranges = 0; ranges < 300; ranges++)
        refused &= ranges == RANGES || forged(b, size, 11, ranges);
    tap_ok(refused, "forged: their number");
    free(b);
    buffon_partial_free(&partial);
}

/* Three components with their products: every series must have the count of the first. */
static void test_forged_series(void)
{
    enum { STATS = 4 + BUFFON_STATS_SUM + BUFFON_STATS_SQUARES + BUFFON_STATS_TOP };
    enum { WHOLE = 3 + 15 + 3, TAIL = WHOLE + 3 * STATS + 3 * BUFFON_STATS_SQUARES };
    buffon_partial partial = {0};
    size_t size;
    const buffon_status status =
        solve(&partial, &problems[1], (buffon_run){.samples = 90, .block = 16});
    unsigned char *b = save(&partial, &size);
    tap_ok(status >= 0 && word_at(b, WHOLE + 2 * STATS) == 80 && word_at(b, TAIL + STATS) == 10 &&
               forged(b, size, WHOLE + 2 * STATS, 79) && forged(b, size, TAIL + STATS, 9),
           "forged: counts of another component");
    free(b);
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
    test_forged_net();
    test_forged_series();
    return tap_done();
}
