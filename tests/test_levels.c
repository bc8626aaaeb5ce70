/* Every set of vector instructions gives the bits of plain C. A case is a function that writes what
 * it computed into a record; it is run at each level that the machine has, and the records are
 * compared word by word. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include <buffon/buffon.h>

#include "elementary.h"
#include "levels.h"
#include "moments.h"
#include "problems.h"
#include "stats_priv.h"
#include "tap.h"
#include "weigh.h"

enum { LEVELS = BUFFON_LEVEL_AVX512 + 1, WORDS = 1 << 17, GUARD = 9, MOST = 5000 };

#define COUNT(array) (sizeof(array) / sizeof *(array))
#define UNTOUCHED 12345.678 /* in memory that a case may not write to */

static buffon_level best;

/* ---- records ------------------------------------------------------------------------------ */

typedef struct record {
    uint64_t word[WORDS];
    size_t count;
} record;

/* `a` and `b` say which of several like cases it is. */
typedef struct levels_case {
    const char *name;
    size_t a, b;
    const void *what;
} levels_case;

static record wanted, got;
static size_t wrong[LEVELS], compared;

static void put_word(record *r, uint64_t word)
{
    if (r->count == WORDS)
        abort();
    r->word[r->count++] = word;
}

/* NaNs have signs and payloads that mean nothing. */
static void put(record *r, double x)
{
    put_word(r, x != x ? UINT64_C(0x7ff8000000000000) : tap_bits(x));
}

static void put_all(record *r, const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        put(r, x[i]);
}

static void put_bytes(record *r, const void *bytes, size_t size)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * UINT64_C(0x100000001b3);
    put_word(r, size);
    put_word(r, hash);
}

static void put_estimates(record *r, const buffon_estimate *out, size_t n)
{
    for (const buffon_estimate *e = out; e < out + n; e++) {
        const double x[] = {e->value,      e->std_error, e->variance,   e->lo,
                            e->hi,         e->min,       e->max,        e->max_share,
                            e->tail_index, e->ess,       e->acceptance, e->confidence};
        const uint64_t w[] = {e->samples,          e->nonfinite, e->bad_index, e->bad_stratum,
                              (uint64_t)e->status, e->doubts,    e->interval,  e->looks};
        put_all(r, x, COUNT(x));
        for (size_t k = 0; k < COUNT(w); k++)
            put_word(r, w[k]);
        put_bytes(r, e->reserved, sizeof e->reserved);
    }
}

/* ---- comparing ---------------------------------------------------------------------------- */

static void compare(void (*make)(record *, const levels_case *), const levels_case *c)
{
    wanted.count = 0;
    (void)buffon_cpu_limit(BUFFON_LEVEL_SCALAR);
    make(&wanted, c);
    compared += wanted.count;
    for (int level = 1; level <= (int)best; level++) {
        size_t i = 0;
        got.count = 0;
        (void)buffon_cpu_limit((buffon_level)level);
        make(&got, c);
        while (i < wanted.count && i < got.count && wanted.word[i] == got.word[i])
            i++;
        if (i == wanted.count && i == got.count)
            continue;
        if (wrong[level]++ == 0)
            tap_note("%s, %s (%zu, %zu): word %zu is %016llx, not %016llx",
                     buffon_level_string((buffon_level)level), c->name, c->a, c->b, i,
                     (unsigned long long)got.word[i], (unsigned long long)wanted.word[i]);
    }
}

/* One check for each level of all the cases since the last. */
static void judge(const char *what)
{
    for (int level = 1; level <= (int)best; level++) {
        tap_ok(wrong[level] == 0 && compared > 0, "%s: %s",
               buffon_level_string((buffon_level)level), what);
        wrong[level] = 0;
    }
    tap_note("%zu words each", compared);
    compared = 0;
    (void)buffon_cpu_limit(BUFFON_LEVEL_AVX512);
}

/* ---- memory ------------------------------------------------------------------------------- */

/* n numbers that begin off the lines of the cache and end with the memory, where a sanitizer sees
 * one read too many. */
typedef struct tight {
    double *memory, *at;
} tight;

static tight tight_make(size_t n, size_t shift)
{
    tight t;
    t.memory = malloc((n + shift + (n + shift == 0)) * sizeof(double));
    if (t.memory == NULL)
        abort();
    t.at = t.memory + shift;
    return t;
}

static tight tight_copy(const double *x, size_t n, size_t shift)
{
    const tight t = tight_make(n, shift);
    if (n > 0)
        memcpy(t.at, x, n * sizeof *x);
    return t;
}

/* An output with untouched numbers about it. */
static double *guarded(double *memory, size_t n, size_t shift)
{
    for (size_t i = 0; i < n + 2 * GUARD; i++)
        memory[i] = UNTOUCHED;
    return memory + shift;
}

/* ---- random numbers ----------------------------------------------------------------------- */

static void make_rng_at(record *r, const levels_case *c)
{
    static double memory[1200];
    const uint64_t first = *(const uint64_t *)c->what + c->a;
    const buffon_rng_key key = {first ^ 42, c->b, (uint8_t)c->a, 3, (uint16_t)(5 * c->b)};
    const size_t shift = (c->a + c->b) % GUARD;
    double *out = guarded(memory, c->b, shift);
    buffon_rng_uniforms_at(out, c->b, &key, (uint32_t)c->a, first);
    put_all(r, memory, c->b + 2 * GUARD);
    out = guarded(memory, c->b, shift);
    buffon_rng_words_at((uint64_t *)(void *)out, c->b, &key, UINT32_MAX, first);
    for (size_t i = 0; i < c->b + 2 * GUARD; i++)
        put_word(r, tap_bits(memory[i]));
}

/* All that a sequence can do, in an order that depends on c->a. */
static void make_rng_walk(record *r, const levels_case *c)
{
    static double memory[3000];
    static uint64_t words[3000];
    buffon_rng rng = buffon_rng_make(c->a, 7);
    uint64_t choice = c->a + 1;
    for (int k = 0; k < 12; k++) {
        choice = choice * UINT64_C(6364136223846793005) + 1442695040888963407;
        const size_t n = (size_t)(choice >> 33) % (k % 3 ? 40 : 2600);
        switch ((int)(choice >> 60) % 6) {
        case 0:
            buffon_rng_seek(&rng, choice >> 40);
            break;
        case 1:
            buffon_rng_skip(&rng, n);
            break;
        case 2:
            put(r, buffon_rng_next(&rng));
            break;
        case 3:
            buffon_rng_fill_words(words, n, &rng);
            put_bytes(r, words, 8 * n);
            break;
        default:
            buffon_rng_fill(memory, n, &rng);
            put_all(r, memory, n);
        }
    }
    put_bytes(r, &rng, sizeof rng);
}

static void test_rng(void)
{
    static const uint64_t base[] = {0, 1000, UINT64_C(1) << 42, (UINT64_C(0xfffffffe) << 37) - 20,
                                    UINT64_MAX - 30};
    for (size_t k = 0; k < COUNT(base); k++) {
        for (size_t a = 0; a <= 40; a += a < 18 ? 1 : 7) {
            for (size_t n = 0; n <= 70; n++)
                compare(make_rng_at, &(levels_case){"stretch", a, n, &base[k]});
            for (size_t n = 1000; n <= 1100 && a % 5 == 0; n++)
                compare(make_rng_at, &(levels_case){"long stretch", a, n, &base[k]});
        }
    }
    for (size_t a = 0; a < 200; a++)
        compare(make_rng_walk, &(levels_case){"sequence", a, 0, NULL});
    judge("words and uniforms");
}

/* ---- densities ---------------------------------------------------------------------------- */

enum { DIM = 12, SETS = 4 };

/* Uniforms of four kinds: random, the ends of the generator's with ties between the rows of a
 * point, small ones, and what no generator gives. */
static void uniforms(double *u, size_t rows, size_t n, size_t set, size_t shift)
{
    static const double edge[] = {0x1p-53, 1 - 0x1p-53, 0.5, 0x1p-53, 0.25, 0.75, 0.25};
    static const double hostile[] = {0,   0.3,      NAN, 0.7, 1, -0.0,
                                     0.1, INFINITY, 0.9, -1,  2, -INFINITY};
    buffon_rng rng = buffon_rng_make(shift, set);
    buffon_rng_fill(u, rows * n, &rng);
    for (size_t i = 0; i < rows * n; i++) {
        const double v = u[i];
        if (set == 1 && v < 0.4)
            u[i] = edge[(i + shift) % COUNT(edge)];
        if (set == 1 && v > 0.6 && i >= n)
            u[i] = v < 0.8 ? u[i - n] : 1 - u[i - n];
        if (set == 2)
            u[i] = v * (i % 2 ? 0x1p-1000 : 0x1p-30) * (i % 7 ? 1 : 0x1p-72);
        if (set == 3 && v < 0.5)
            u[i] = hostile[(i + shift) % COUNT(hostile)];
    }
}

static void sample(record *r, double *x, const double *u, size_t n, const buffon_density *g,
                   size_t shift)
{
    static double memory[DIM * 1024 + 2 * GUARD], pdf[1024 + 2 * GUARD];
    double *out = guarded(memory, g->dim * n, shift), *value = guarded(pdf, n, shift + 1);
    put_word(r, (uint64_t)buffon_density_sample(out, NULL, u, n, g));
    put_all(r, memory, g->dim * n + 2 * GUARD);
    out = guarded(memory, g->dim * n, shift);
    put_word(r, (uint64_t)buffon_density_sample(out, value, u, n, g));
    put_all(r, memory, g->dim * n + 2 * GUARD);
    put_all(r, pdf, n + 2 * GUARD);
    memcpy(x, out, g->dim * n * sizeof *x);
}

/* The pdf, its log and the uniforms of points. */
static void look(record *r, const double *x, size_t n, const buffon_density *g, size_t shift)
{
    static double memory[DIM * 1024 + 2 * GUARD];
    double *out = guarded(memory, n, shift);
    put_word(r, (uint64_t)buffon_density_pdf(out, x, n, g));
    put_all(r, memory, n + 2 * GUARD);
    out = guarded(memory, n, shift);
    put_word(r, (uint64_t)buffon_density_log_pdf(out, x, n, g));
    put_all(r, memory, n + 2 * GUARD);
    out = guarded(memory, g->uniforms * n, shift);
    put_word(r, (uint64_t)buffon_density_invert(out, x, n, g));
    put_all(r, memory, g->uniforms * n + 2 * GUARD);
}

/* c->a: n; c->b: the kind of uniforms. */
static void make_density(record *r, const levels_case *c)
{
    static double u[DIM * 1024], x[DIM * 1024];
    const buffon_density *g = c->what;
    const size_t n = c->a < 1024 ? c->a : 1024, shift = n % 8;
    uniforms(u, g->uniforms, n, c->b, n);
    tight from = tight_copy(u, g->uniforms * n, shift);
    sample(r, x, from.at, n, g, (shift + 3) % 8);
    free(from.memory);
    from = tight_copy(x, g->dim * n, shift);
    look(r, from.at, n, g, (shift + 5) % 8);
    free(from.memory);
    if (c->b == SETS - 1) { /* as points too these numbers are of every kind */
        uniforms(x, g->dim, n, c->b, n + 1);
        from = tight_copy(x, g->dim * n, shift);
        look(r, from.at, n, g, shift);
        free(from.memory);
    }
}

static void try_density(const char *name, const buffon_density *g)
{
    if (g->status != BUFFON_OK || g->dim > DIM)
        tap_ok(0, "%s is a density", name);
    for (size_t set = 0; set < SETS; set++) {
        for (size_t n = 0; n <= 40; n++)
            compare(make_density, &(levels_case){name, n, set, g});
        for (size_t n = 1; n < 4; n++)
            compare(make_density, &(levels_case){name, n * 341 + n / 3, set, g});
    }
}

static void test_boxes(void)
{
    static const double end[][2] = {
        {0, 1},           {-1, 2.5},        {-DBL_MAX, DBL_MAX},     {-DBL_MAX, 0.6 * DBL_MAX},
        {0, DBL_MAX},     {0, 0x1p-1074},   {-0x1p-1073, 0x1p-1074}, {0, 0x1p-1060},
        {1, 1 + 0x1p-52}, {1, 1 + 0x1p-51}, {-1 - 0x1p-50, -1},      {1e15, 1e15 + 1}};
    static const double lo[] = {0, 0, -1, -DBL_MAX, 5}, hi[] = {1, 1, 1, DBL_MAX, 6};
    const buffon_density g = buffon_box(lo, hi, 5);
    for (size_t k = 0; k < COUNT(end); k++) {
        const buffon_density s = buffon_segment(end[k][0], end[k][1]);
        try_density("segment", &s);
    }
    try_density("box", &g);
    judge("boxes");
}

static void test_shapes(void)
{
    static const double axis[] = {1, 2, -2}, down[] = {0, 0, -3}, up[] = {0, 0, 0x1p-1000};
    const buffon_density g[] = {buffon_disk(1),
                                buffon_disk(0x1p500),
                                buffon_disk(1e-150),
                                buffon_disk_concentric(1),
                                buffon_disk_concentric(3.7),
                                buffon_sphere(),
                                buffon_cap(0.25),
                                buffon_cap(-1),
                                buffon_cap_about(0.25, axis),
                                buffon_cap_about(-0.5, down),
                                buffon_cap_about(0.25, up),
                                buffon_cap_height(1e-300, axis),
                                buffon_cap_height(0x1p-40, up),
                                buffon_hemisphere(),
                                buffon_hemisphere_about(axis),
                                buffon_hemisphere_cosine(),
                                buffon_hemisphere_cosine_about(axis),
                                buffon_hemisphere_cosine_about(down)};
    static const char *const name[] = {"disk",
                                       "large disk",
                                       "small disk",
                                       "concentric disk",
                                       "concentric disk of 3.7",
                                       "sphere",
                                       "cap",
                                       "whole cap",
                                       "turned cap",
                                       "cap downwards",
                                       "cap upwards",
                                       "smallest cap",
                                       "small cap",
                                       "hemisphere",
                                       "turned hemisphere",
                                       "cosine",
                                       "turned cosine",
                                       "cosine downwards"};
    for (size_t k = 0; k < COUNT(g); k++)
        try_density(name[k], &g[k]);
    judge("shapes");
}

static void test_laws(void)
{
    const buffon_density g[] = {buffon_exponential(1),
                                buffon_exponential(0x1.7p-3),
                                buffon_exponential(DBL_MIN),
                                buffon_exponential(0x1p1017),
                                buffon_normal(0, 1),
                                buffon_normal(-3.5, 0.7),
                                buffon_normal(0x1p1022, 0x1p1017),
                                buffon_normal(1, DBL_MIN),
                                buffon_normal(0, 0x1p-500)};
    const buffon_density inner[] = {g[4], buffon_disk_concentric(2)};
    const buffon_density part[] = {g[1],
                                   buffon_density_product(inner, 2),
                                   buffon_sphere(),
                                   g[5],
                                   buffon_segment(-1, 1),
                                   buffon_disk(0.5)};
    const buffon_density product = buffon_density_product(part, COUNT(part));
    for (size_t k = 0; k < COUNT(g); k++)
        try_density(k < 4 ? "exponential" : "normal", &g[k]);
    try_density("product", &product);
    judge("exponential, normal and products");
}

/* ---- functions of arrays ------------------------------------------------------------------ */

typedef void (*one_argument)(double *y, const double *x, size_t n);

static const one_argument functions[] = {
    buffon_math_sinpi, buffon_math_cospi,      buffon_math_acospi,         buffon_math_log,
    buffon_math_log1p, buffon_math_exp,        buffon_math_expm1,          buffon_math_cbrt,
    buffon_math_erfc,  buffon_math_normal_cdf, buffon_math_normal_quantile};

/* Arguments: in (0, 1), of some size about 0, of any size, and now and then special ones. */
static void arguments(double *x, size_t n, size_t set)
{
    static const double special[] = {0,   -0.0, 1,       -1,      0.5,       INFINITY,   -INFINITY,
                                     NAN, 2,    DBL_MAX, DBL_MIN, 0x1p-1074, -0x1p-1074, 0x1p53};
    buffon_rng rng = buffon_rng_make(n, set);
    for (size_t i = 0; i < n; i++) {
        const uint64_t word = buffon_rng_word(&rng);
        const double u = buffon_rng_next(&rng);
        x[i] = set % 3 == 0 ? u : set % 3 == 1 ? 80 * (u - 0.5) : buffon_priv_from_bits(word);
        if (set >= 3 && word % 5 == 0)
            x[i] = special[(word >> 20) % COUNT(special)];
    }
}

/* c->a: n; c->b: the kind of arguments. */
static void make_functions(record *r, const levels_case *c)
{
    static double x[1024], y[1024], memory[1024 + 2 * GUARD], second[1024 + 2 * GUARD];
    const size_t n = c->a, shift = n % 8;
    arguments(x, n, c->b);
    arguments(y, n, c->b + 6);
    const tight a = tight_copy(x, n, shift), b = tight_copy(y, n, (shift + 3) % 8);
    for (size_t k = 0; k < COUNT(functions); k++) {
        double *out = guarded(memory, n, shift + 1);
        functions[k](out, a.at, n);
        put_all(r, memory, n + 2 * GUARD);
        out = guarded(memory, n, shift);
        for (size_t i = 0; i < n; i++)
            out[i] = x[i];
        functions[k](out, out, n);
        put_all(r, memory, n + 2 * GUARD);
    }
    double *out = guarded(memory, n, shift), *other = guarded(second, n, shift + 1);
    buffon_math_sincospi(out, other, a.at, n);
    put_all(r, memory, n + 2 * GUARD);
    put_all(r, second, n + 2 * GUARD);
    out = guarded(memory, n, shift);
    buffon_math_atan2pi(out, a.at, b.at, n);
    put_all(r, memory, n + 2 * GUARD);
    free(a.memory);
    free(b.memory);
}

static void test_functions(void)
{
    for (size_t set = 0; set < 6; set++) {
        for (size_t n = 0; n <= 40; n++)
            compare(make_functions, &(levels_case){"functions", n, set, NULL});
        for (size_t n = 250; n <= 1024; n += 86)
            compare(make_functions, &(levels_case){"functions", n, set, NULL});
    }
    judge("functions of arrays");
}

/* ---- sums --------------------------------------------------------------------------------- */

enum kind {
    ORDINARY,
    WILD,
    HUGE_ONES,
    TINY,
    EQUAL,
    MINUS_ZERO,
    ZEROS,
    OFFSET,
    FIRST_FAR_OFF,
    LARGEST,
    ONE_HUGE,
    ONE_INFINITE,
    ONE_NAN,
    LAST_NAN,
    KINDS
};

static double value_of(enum kind kind, double v, size_t i, buffon_rng *rng)
{
    switch (kind) {
    case WILD:
        return ldexp(v, (int)buffon_rng_below(rng, 2000) - 1000);
    case HUGE_ONES:
        return v * 0x1p1010;
    case TINY:
        return v * 0x1p-1050;
    case EQUAL:
        return 0.1;
    case MINUS_ZERO:
        return -0.0;
    case ZEROS:
        return v < 0 ? 0.0 : -0.0;
    case OFFSET:
        return 1e15 + v;
    case FIRST_FAR_OFF:
        return i > 0 ? v : 1e16;
    case LARGEST:
        return v * DBL_MAX;
    default:
        return v;
    }
}

static void values(double *y, size_t n, enum kind kind, uint64_t seed)
{
    buffon_rng rng = buffon_rng_make(seed, kind);
    buffon_rng_fill(y, n, &rng);
    for (size_t i = 0; i < n; i++)
        y[i] = value_of(kind, y[i] - 0.5, i, &rng);
    if (n > 0 && kind >= ONE_HUGE) {
        const size_t at = kind == LAST_NAN ? n - 1 : (size_t)buffon_rng_below(&rng, n);
        y[at] = kind == ONE_HUGE ? 1e200 : kind == ONE_INFINITE ? -INFINITY : NAN;
    }
}

/* c->a: n; c->b: the kinds of both. */
static void make_sums(record *r, const levels_case *c)
{
    static double y[MOST], z[MOST];
    const size_t n = c->a;
    double top[BUFFON_STATS_TOP] = {0};
    buffon_priv_moments m, k;
    values(y, n, (enum kind)(c->b % KINDS), n);
    values(z, n, (enum kind)(c->b / KINDS), n + 1);
    const tight a = tight_copy(y, n, n % 8), b = tight_copy(z, n, (n + 3) % 8);
    const size_t y_good = buffon_priv_moments_block(&m, a.at, n);
    const size_t z_good = buffon_priv_moments_block(&k, b.at, n);
    put_word(r, y_good);
    put_word(r, z_good);
    if (y_good == n) {
        const double field[] = {(double)m.n, m.e, m.m, m.r, m.q, m.min, m.max};
        put_all(r, field, COUNT(field));
        buffon_priv_top_add(top, a.at, n);
        put_all(r, top, BUFFON_STATS_TOP);
    }
    if (y_good == n && z_good == n) {
        put(r, buffon_priv_cross_block(a.at, b.at, n, &m, &k));
        buffon_priv_top_add(top, b.at, n);
        put_all(r, top, BUFFON_STATS_TOP);
    }
    free(a.memory);
    free(b.memory);
}

static void test_sums(void)
{
    for (size_t kinds = 0; kinds < KINDS * KINDS; kinds++) {
        for (size_t n = 0; n <= 200; n += n < 70 ? 1 : 19)
            compare(make_sums, &(levels_case){"block", n, kinds, NULL});
        for (size_t n = 1000; n <= 1100; n += 12)
            compare(make_sums, &(levels_case){"block", n, kinds, NULL});
        for (size_t n = 1024; n <= MOST; n += 1024 + 485 * (n % 3))
            compare(make_sums, &(levels_case){"block", n, kinds, NULL});
    }
    judge("sums of blocks");
}

/* ---- ratios and hits ---------------------------------------------------------------------- */

/* A pdf that is not a normal number at point c->b of c->a, and a log that knows better. */
static int half_log(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    (void)g;
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = x[i] < 0.5 ? -750 : -INFINITY;
    return 0;
}

static void make_ratio(record *r, const levels_case *c)
{
    static const double bad[] = {0, 0x1p-1074, 0x1p-1022, INFINITY, NAN, -1, -0.0};
    const buffon_density_ops ops[] = {{0}, {.log_pdf = half_log}};
    const size_t n = c->a, kinds = COUNT(bad);
    const size_t kind = *(const size_t *)c->what;
    const buffon_density g = {.dim = 1, .uniforms = 1, .ops = &ops[kind / kinds % 2]};
    const buffon_integrand f = {.components = 2};
    const buffon_priv_stratum stratum = {.f = &f, .g = &g};
    const buffon_priv_problem ratio = {.stratum = &stratum};
    double x[64], pdf[64], value[128], y[128 + 2 * GUARD], point;
    buffon_rng rng = buffon_rng_make(n, kind);
    size_t lowest = 999;
    buffon_rng_fill(x, n, &rng);
    buffon_rng_fill(pdf, n, &rng);
    buffon_rng_fill(value, 2 * n, &rng);
    if (n > 0) {
        pdf[c->b] = bad[kind % kinds];
        value[c->b] = kind / kinds < 2 ? 1e-300 : kind / kinds == 2 ? 0 : NAN;
        value[n + c->b / 2] = INFINITY;
    }
    const tight density = tight_copy(pdf, n, 1), values_of = tight_copy(value, 2 * n, 3);
    const buffon_priv_batch batch = {
        .n = n, .x = x, .pdf = density.at, .f = values_of.at, .point = &point, .g = &g};
    double *out = guarded(y, 2 * n, 5);
    put_word(r, (uint64_t)buffon_priv_weigh_ratio(out, &lowest, &batch, &ratio));
    put_word(r, lowest);
    put_all(r, y, 2 * n + 2 * GUARD);
    free(density.memory);
    free(values_of.memory);
}

/* x height, but for a point or two where it is something else. */
typedef struct spoilt {
    double height, at, value;
} spoilt;

static double spoilt_value(const double *x, void *ctx)
{
    const spoilt *s = ctx;
    return x[0] == s->at ? s->value : x[0] * s->height;
}

/* Hits at points of which the one at c->b is spoilt in one of several ways, some others being on
 * the curve. */
static void make_hits(record *r, const levels_case *c)
{
    static const double height[] = {2, 0x1.8p-1000, 0x1.8p-1060, 0x1p1000};
    const size_t kind = *(const size_t *)c->what, half = c->a / 2;
    const double top = height[kind / 8 % 4], zero = 0, one = 1;
    const double worse[] = {1.0625 * top, -0x1p-60 * top, INFINITY, -INFINITY, NAN, top, 0, -0.0};
    double u[80];
    buffon_estimate out;
    buffon_rng rng = buffon_rng_make(c->a, 1);
    buffon_rng_fill(u, 2 * c->a, &rng);
    for (size_t i = 0; i < c->a; i += 3)
        u[c->a + i] = u[i];
    spoilt s = {top, u[c->b], worse[kind % 8]};
    u[(c->b + half) % c->a] = s.at;
    const buffon_points points = buffon_points_replay(u, 2, c->a, BUFFON_DESIGN_INDEPENDENT);
    const buffon_integrand f = {.scalar = spoilt_value, .dim = 1, .ctx = &s};
    const buffon_run run = {.samples = c->a, .points = &points, .on_nonfinite = kind >= 32};
    put_word(r, (uint64_t)buffon_rejection(&out, &f, &zero, &one, top, &run));
    put_estimates(r, &out, 1);
}

static void test_weights(void)
{
    for (size_t kind = 0; kind < 28; kind++) {
        for (size_t n = 0; n <= 40; n += n % 8 < 2 ? 1 : 3)
            for (size_t at = 0; at < n || at == 0; at++)
                compare(make_ratio, &(levels_case){"ratio", n, at, &kind});
    }
    judge("ratios");
    for (size_t kind = 0; kind < 64; kind++) {
        for (size_t n = 3; n <= 40; n += n % 8 < 2 ? 1 : 5)
            for (size_t at = 0; at < n; at += 1 + n / 16)
                compare(make_hits, &(levels_case){"hits", n, at, &kind});
    }
    judge("hits");
}

/* ---- estimates ---------------------------------------------------------------------------- */

/* c->a: samples; c->b: threads. */
static void make_problem(record *r, const levels_case *c)
{
    const problem *p = c->what;
    buffon_estimate out[PROBLEMS_COMPONENTS];
    buffon_partial partial = {0};
    double cov[PROBLEMS_COMPONENTS * PROBLEMS_COMPONENTS];
    const buffon_run run = {
        .samples = c->a, .seed = 11, .threads = (uint32_t)c->b, .partial = &partial};
    put_word(r, (uint64_t)p->solve(out, run));
    put_estimates(r, out, p->components);
    put_word(r, (uint64_t)buffon_partial_covariance(cov, &partial));
    put_all(r, cov, p->components * p->components);
    const size_t size = buffon_partial_size(&partial);
    void *bytes = malloc(size > 0 ? size : 1);
    if (bytes == NULL || buffon_partial_save(bytes, size, &partial) != BUFFON_OK)
        tap_ok(0, "%s can be saved", p->name);
    put_bytes(r, bytes, bytes != NULL ? size : 0);
    free(bytes);
    buffon_partial_free(&partial);
}

/* Two components of values of every kind, as the bits of x choose. ctx: the worst kind allowed. */
static int wild_values(double *f, const double *x, size_t n, void *ctx)
{
    const size_t kinds = *(const size_t *)ctx;
    for (size_t i = 0; i < 2 * n; i++) {
        const uint64_t word = (tap_bits(x[i % n]) + i / n) * UINT64_C(0x9e3779b97f4a7c15) >> 40;
        const double v = x[i % n], list[] = {v,      0.1,   -0.0,    ldexp(v, -1060), 1e15 + v,
                                             -1e200, 1e300, DBL_MAX, INFINITY,        NAN};
        f[i] = list[word % 64 < kinds ? word % 64 : 0];
    }
    return 0;
}

/* c->a: kinds of values; c->b: threads, points and what to do with values that are not finite. */
static void make_wild(record *r, const levels_case *c)
{
    static const double lo[] = {0, 0}, hi[] = {1, 1}, far[] = {1e9, 3};
    const buffon_points points = buffon_points_antithetic();
    size_t kinds = c->a;
    buffon_estimate out[2];
    buffon_partial partial = {0};
    const buffon_integrand f = {.batch = wild_values, .dim = 2, .components = 2, .ctx = &kinds};
    const buffon_run run = {.samples = 2100,
                            .seed = c->b,
                            .threads = c->b % 2 ? 3 : 1,
                            .points = c->b & 2 ? &points : NULL,
                            .partial = &partial,
                            .covariance = 1,
                            .on_nonfinite =
                                c->b & 4 ? BUFFON_NONFINITE_ZERO : BUFFON_NONFINITE_ERROR};
    double cov[4] = {0};
    put_word(r, (uint64_t)buffon_uniform(out, &f, lo, c->b & 8 ? far : hi, &run));
    put_estimates(r, out, 2);
    put_word(r, (uint64_t)buffon_partial_covariance(cov, &partial));
    put_all(r, cov, 4);
    buffon_partial_free(&partial);
}

/* One value everywhere, of some kind. */
static double one_value(const double *x, void *ctx)
{
    (void)x;
    return *(const double *)ctx;
}

static void make_equal(record *r, const levels_case *c)
{
    static double value[] = {0, -0.0, 0.1, 1e300, -DBL_MAX, 0x1p-1074, INFINITY, NAN};
    const double lo = -1, hi = 2;
    buffon_estimate out;
    const buffon_integrand f = {.scalar = one_value, .dim = 1, .ctx = &value[c->a]};
    const buffon_run run = {.samples = 1500, .on_nonfinite = (int)c->b};
    put_word(r, (uint64_t)buffon_uniform(&out, &f, &lo, &hi, &run));
    put_estimates(r, &out, 1);
}

/* A density of a user whose pdf leaves the doubles in param[0] of the cases, becoming param[1]. */
static int leaving_sample(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    for (size_t i = 0; i < n; i++) {
        x[i] = u[i];
        if (pdf != NULL)
            pdf[i] = u[i] < g->param[0] ? g->param[1] : 1;
    }
    return 0;
}

static int leaving_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        pdf[i] = x[i] < g->param[0] ? g->param[1] : 1;
    return 0;
}

static int leaving_log(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    for (size_t i = 0; i < n; i++)
        log_pdf[i] = x[i] < g->param[0] ? -720 : 0;
    return 0;
}

/* param[2] of the density: where f vanishes. */
static double leaving_value(const double *x, void *ctx)
{
    const buffon_density *g = ctx;
    return x[0] < g->param[2] ? 0 : x[0] * 0x1p-600;
}

/* c->a: which pdf and where; c->b: threads, and whether its log is known. */
static void make_leaving(record *r, const levels_case *c)
{
    static const double where[] = {1e-3, 0.03, 1},
                        what[] = {0, 0x1p-1074, 0x1p-1030, INFINITY, NAN};
    const buffon_density_ops ops[] = {
        {.sample = leaving_sample, .pdf = leaving_pdf, .name = "tests.leaving"},
        {.sample = leaving_sample,
         .pdf = leaving_pdf,
         .log_pdf = leaving_log,
         .name = "tests.log"}};
    buffon_density g = {.dim = 1, .uniforms = 1, .ops = &ops[c->b / 2 % 2]};
    buffon_estimate out;
    g.param[0] = where[c->a % 3];
    g.param[1] = what[c->a / 3];
    g.param[2] = c->b & 4 ? g.param[0] : 0;
    const buffon_integrand f = {.scalar = leaving_value, .dim = 1, .ctx = &g};
    const buffon_run run = {.samples = 3000, .threads = c->b % 2 ? 3 : 1};
    put_word(r, (uint64_t)buffon_importance(&out, &f, &g, &run));
    put_estimates(r, &out, 1);
    put_word(r, (uint64_t)buffon_self_normalised(&out, &f, &f, &g, &run));
    put_estimates(r, &out, 1);
}

static void test_estimates(void)
{
    for (size_t k = 0; k < PROBLEMS; k++)
        for (size_t threads = 1; threads <= 3; threads += 2)
            compare(make_problem, &(levels_case){problems[k].name, 5003, threads, &problems[k]});
    judge("estimates of every kind, their covariance and partial results");
    for (size_t kinds = 1; kinds <= 10; kinds++)
        for (size_t how = 0; how < 16; how++)
            compare(make_wild, &(levels_case){"wild values", kinds, how, NULL});
    for (size_t kind = 0; kind < 16; kind++)
        compare(make_equal, &(levels_case){"equal values", kind / 2, kind % 2, NULL});
    judge("estimates of values of any size");
    for (size_t which = 0; which < 15; which++)
        for (size_t how = 0; how < 8; how++)
            compare(make_leaving, &(levels_case){"pdf", which, how, NULL});
    judge("estimates where the pdf leaves the doubles");
}

int main(void)
{
    best = buffon_cpu_level();
    for (int level = (int)best + 1; level < LEVELS; level++)
        tap_ok(1, "%s # SKIP this machine or build has none",
               buffon_level_string((buffon_level)level));
    test_rng();
    test_boxes();
    test_shapes();
    test_laws();
    test_functions();
    test_sums();
    test_weights();
    test_estimates();
    return tap_done();
}
