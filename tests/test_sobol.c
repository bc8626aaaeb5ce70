/* Sobol' points as points: the direction numbers and words against what is published, the scrambles
 * against a second implementation written from the text of the header, nets, and the law of the
 * scrambles. */
#include <math.h>
#include <stdlib.h>

#include <buffon/buffon.h>

#include "tap.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

enum { DIMS = BUFFON_SOBOL_DIMENSIONS, SCRAMBLES = 4, DEGREES = 14 };

static const char *const scramble_name[SCRAMBLES] = {"Owen", "linear", "shift", "none"};

static void *must(void *memory)
{
    if (memory == NULL)
        exit(1);
    return memory;
}

static uint64_t one_word(uint32_t dimension, uint64_t index)
{
    uint64_t w = 0;
    if (buffon_sobol_words(&w, 1, dimension, index) != BUFFON_OK)
        exit(1);
    return w;
}

#define HASH_START UINT64_C(0xcbf29ce484222325)

static uint64_t hash_step(uint64_t hash, uint64_t word)
{
    return (hash ^ word) * UINT64_C(0x100000001b3);
}

/* ---- the sequence ------------------------------------------------------------------------- */

static void test_refusals(void)
{
    uint64_t w = 7;
    const buffon_points points = buffon_points_sobol((buffon_scramble)4);
    tap_ok(buffon_sobol_words(NULL, 1, 0, 0) == BUFFON_E_NULL, "words: nowhere to");
    tap_ok(buffon_sobol_words(&w, 1, DIMS, 0) == BUFFON_E_DIM && w == 7, "words: no dimension %d",
           DIMS);
    tap_ok(buffon_sobol_words(&w, 0, 0, 0) == BUFFON_OK && w == 7, "words: none asked for");
    tap_ok(points.fill == NULL, "no fifth scramble");
}

/* Words of scipy.stats.qmc.Sobol(100, scramble=False).random(4096) of scipy 1.10.1, 30 bits each:
 * their hash, point after point. Then 64-bit words by a program of its own from the published
 * file. */
static void test_known_words(void)
{
    static const struct {
        uint32_t dimension;
        uint64_t index, word;
    } known[] = {{0, (UINT64_C(1) << 40) + 12345, UINT64_C(0xa414000001800000)},
                 {1, (UINT64_C(1) << 40) + 12345, UINT64_C(0xafbc00007f800000)},
                 {2, (UINT64_C(1) << 40) + 12345, UINT64_C(0x51d92d80ad800000)},
                 {3, (UINT64_C(1) << 40) + 12345, UINT64_C(0x180ded638a800000)},
                 {0, (UINT64_C(1) << 63) + 987654321, UINT64_C(0x973a8de400000003)},
                 {1, (UINT64_C(1) << 63) + 987654321, UINT64_C(0xd90b427955555555)},
                 {999, (UINT64_C(1) << 63) + 987654321, UINT64_C(0x3f9d82a8aa321271)},
                 {1110, (UINT64_C(1) << 63) + 987654321, UINT64_C(0x20b5d54c00000b9d)}};
    enum { N = 4096, D = 100 };
    uint64_t *w = must(malloc(sizeof *w * N * D));
    uint64_t hash = HASH_START;
    for (uint32_t j = 0; j < D; j++) {
        if (buffon_sobol_words(w + (size_t)j * N, N, j, 0) != BUFFON_OK)
            exit(1);
    }
    for (size_t i = 0; i < N; i++) {
        for (size_t j = 0; j < D; j++)
            hash = hash_step(hash, w[j * N + i] >> 34);
    }
    free(w);
    tap_ok(hash == UINT64_C(0xc758ffd3d5072325), "100 dimensions of 4096 points are scipy's");
    for (size_t k = 0; k < COUNT(known); k++)
        tap_ok(one_word(known[k].dimension, known[k].index) == known[k].word,
               "dimension %u, index %016llx", (unsigned)known[k].dimension,
               (unsigned long long)known[k].index);
}

/* Cuts change nothing, nor does the way over the end: after point 2^64 - 1 comes point 0. */
static void test_stretches(void)
{
    enum { N = 700 };
    uint64_t whole[N], part[N];
    size_t wrong = 0;
    for (uint32_t d = 0; d < DIMS; d += 101) {
        const uint64_t first = UINT64_C(0) - 300;
        if (buffon_sobol_words(whole, N, d, first) != BUFFON_OK)
            exit(1);
        for (size_t i = 0, cut = 1; i < N; i += cut, cut = cut * 5 % 97 + 1) {
            const size_t some = cut < N - i ? cut : N - i;
            if (buffon_sobol_words(part + i, some, d, first + i) != BUFFON_OK)
                exit(1);
        }
        wrong += memcmp(whole, part, sizeof whole) != 0;
        wrong += whole[300] != 0 || whole[301] != UINT64_C(1) << 63;
    }
    tap_ok(wrong == 0, "words: any cut, and over the end");
}

/* Does x generate the units of the field of this polynomial? By walking all its powers. */
static int is_primitive(uint32_t polynomial, unsigned degree)
{
    uint32_t x = 1, order = 0;
    do {
        x <<= 1;
        x ^= x >> degree & 1 ? polynomial : 0;
        order++;
    } while (x != 1 && x != 0 && order < UINT32_C(1) << degree);
    return x == 1 && order == (UINT32_C(1) << degree) - 1;
}

static uint64_t hash_number(uint64_t hash, uint64_t x, char end)
{
    char digits[24];
    snprintf(digits, sizeof digits, "%llu%c", (unsigned long long)x, end);
    for (const char *c = digits; *c != '\0'; c++)
        hash = hash_step(hash, (unsigned char)*c);
    return hash;
}

/* Direction number V[b] is the word of point 2^(b+1) - 1. All primitive polynomials of degree 1 to
 * 13 in increasing order, one for each dimension, and the numbers obey the polynomial's recurrence.
 * The rows "d s a m_1 ... m_s" of new-joe-kuo-6.21201, d = 2 to 1111, with single blanks between:
 * their hash (FNV-1a) is that of the published file. */
static void test_table(void)
{
    uint32_t polynomial = 1;
    uint64_t hash = HASH_START;
    size_t even = 0, broken = 0, degrees[DEGREES] = {0};
    for (uint32_t d = 1; d < DIMS; d++) {
        unsigned s = 0;
        uint64_t v[64];
        do {
            polynomial += 2;
            for (s = 0; polynomial >> (s + 1) > 0;)
                s++;
        } while (!is_primitive(polynomial, s));
        degrees[s < DEGREES ? s : 0]++;
        for (unsigned b = 0; b < 64; b++) {
            v[b] = one_word(d, (UINT64_C(2) << b) - 1);
            even += (v[b] >> (63 - b) & 1) != 1 || (b < 63 && v[b] << (b + 1) != 0);
        }
        for (unsigned b = s; b < 64; b++) {
            uint64_t x = v[b - s] >> s;
            for (unsigned i = 1; i <= s; i++)
                x ^= polynomial >> (s - i) & 1 ? v[b - i] : 0;
            broken += x != v[b];
        }
        hash = hash_number(hash, d + 1, ' ');
        hash = hash_number(hash, s, ' ');
        hash = hash_number(hash, (polynomial ^ UINT32_C(1) << s) >> 1, ' ');
        for (unsigned b = 0; b < s; b++)
            hash = hash_number(hash, v[b] >> (63 - b), b + 1 < s ? ' ' : '\n');
    }
    static const size_t wanted[DEGREES] = {0, 1, 1, 2, 2, 6, 6, 18, 16, 48, 60, 176, 144, 630};
    tap_ok(memcmp(degrees, wanted, sizeof wanted) == 0, "table: phi(2^s - 1) / s of each degree");
    tap_ok(even == 0, "table: every m is odd and below 2^i");
    tap_ok(broken == 0, "table: the numbers obey their primitive polynomials");
    tap_ok(hash == UINT64_C(0xd8edafecc29b4045), "table: the published rows");
}

/* ---- a second implementation -------------------------------------------------------------- */

static uint64_t naive_hash(uint64_t x, const uint64_t *random)
{
    const uint64_t factor = UINT64_C(0xbea225f9eb34556d);
    x ^= random[1];
    x ^= x >> 32;
    x *= factor;
    x ^= x >> 29;
    x *= factor;
    x ^= random[2];
    x ^= x >> 32;
    x *= factor;
    return x ^ x >> 29;
}

static uint64_t naive_owen(uint64_t w, const uint64_t *random, const uint64_t *top)
{
    uint64_t t = 0, out = w;
    while (top[t] >> 58 != w >> 58)
        t++;
    for (unsigned l = 0; l < 6; l++) {
        const uint64_t node = (UINT64_C(1) << l) + (l > 0 ? w >> (64 - l) : 0);
        out ^= (random[0] >> node & 1) << (63 - l);
    }
    for (unsigned b = 58; b-- > 0;) {
        const uint64_t above = w << 6 >> 6 >> (b + 1) << (b + 1);
        out ^= (naive_hash(above + (UINT64_C(1) << b), random) >> t & 1) << b;
    }
    return out;
}

static uint64_t naive_linear(uint64_t w, const uint64_t *random)
{
    uint64_t out = random[64];
    for (unsigned c = 0; c < 64; c++)
        out ^= w >> (63 - c) & 1 ? ((UINT64_C(1) << 63) + random[c] / 2) >> c : 0;
    return out;
}

static double naive_coordinate(const buffon_rng_key *run_key, buffon_scramble scramble, uint32_t j,
                               uint64_t index)
{
    buffon_rng_key key = *run_key;
    uint64_t random[65], top[64], w = one_word(j, index);
    key.purpose = BUFFON_PURPOSE_SCRAMBLE;
    buffon_rng_words_at(random, 65, &key, j, 1024 * (uint64_t)run_key->purpose);
    if (buffon_sobol_words(top, 64, j, 0) != BUFFON_OK)
        exit(1);
    if (scramble == BUFFON_SCRAMBLE_OWEN)
        w = naive_owen(w, random, top);
    else if (scramble == BUFFON_SCRAMBLE_LINEAR)
        w = naive_linear(w, random);
    else if (scramble == BUFFON_SCRAMBLE_SHIFT)
        w ^= random[64];
    return ((double)(w >> 12) + 0.5) * 0x1p-52;
}

/* ---- points -------------------------------------------------------------------------------- */

/* A point set made ready for a key. */
typedef struct ready {
    buffon_points points;
    buffon_points_block block;
} ready;

static ready make_ready(buffon_scramble scramble, buffon_rng_key key, size_t dim)
{
    ready r = {buffon_points_sobol(scramble), {.key = key, .dim = dim}};
    r.block.table = must(malloc(r.points.table_size(dim, &r.points)));
    if (r.points.prepare(&r.block, &r.points) != 0)
        exit(1);
    return r;
}

static void fill(double *u, ready *r, uint64_t first, size_t n)
{
    r->block.first = first;
    r->block.n = n;
    if (r->points.fill(u, &r->block, &r->points) != 0)
        exit(1);
}

static void test_definition(buffon_scramble scramble)
{
    static const buffon_rng_key keys[] = {
        {1, 2, BUFFON_PURPOSE_MAIN, 0, 0}, {1, 2, BUFFON_PURPOSE_PILOT, 0, 0},
        {1, 2, BUFFON_PURPOSE_MAIN, 3, 0}, {1, 2, BUFFON_PURPOSE_MAIN, 0, 5},
        {9, 2, BUFFON_PURPOSE_USER, 0, 0}, {1, 7, BUFFON_PURPOSE_MAIN, 0, 0}};
    static const uint64_t firsts[] = {0, 64 * 77 + 5, (UINT64_C(1) << 44) - 50,
                                      (UINT64_C(3) << 62) + 999};
    enum { N = 150, D = 7 };
    double u[N * D];
    size_t wrong = 0;
    for (size_t k = 0; k < COUNT(keys); k++) {
        ready r = make_ready(scramble, keys[k], D);
        for (size_t f = 0; f < COUNT(firsts); f++) {
            fill(u, &r, firsts[f], N);
            for (uint32_t j = 0; j < D; j++) {
                for (size_t i = 0; i < N; i += 1 + i % 7)
                    wrong += u[j * N + i] != naive_coordinate(&keys[k], scramble, j, firsts[f] + i);
            }
        }
        free(r.block.table);
    }
    tap_ok(wrong == 0, "%s: as the header says", scramble_name[scramble]);
}

/* Blocks of any lengths, at every level: the same points. */
static void test_cuts_and_levels(buffon_scramble scramble)
{
    enum { N = 1000, D = 3 };
    static double whole[N * D], part[N * D];
    const buffon_level best = buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    const uint64_t first = (UINT64_C(1) << 33) - 407;
    ready r = make_ready(scramble, (buffon_rng_key){.seed = 3}, D);
    size_t wrong = 0;
    fill(whole, &r, first, N);
    for (int level = 0; level <= (int)best; level++) {
        buffon_cpu_limit((buffon_level)level);
        for (size_t i = 0, cut = 1; i < N; i += cut, cut = cut * 7 % 211 + 1) {
            const size_t some = cut < N - i ? cut : N - i;
            fill(part, &r, first + i, some);
            for (size_t j = 0; j < D; j++)
                wrong += memcmp(part + j * some, whole + j * N + i, some * sizeof *part) != 0;
        }
        if (scramble == BUFFON_SCRAMBLE_NONE) {
            uint64_t words[200];
            if (buffon_sobol_words(words, 200, 1, first) != BUFFON_OK)
                exit(1);
            for (size_t i = 0; i < 200; i++)
                wrong += ((double)(words[i] >> 12) + 0.5) * 0x1p-52 != whole[N + i];
        }
    }
    buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    free(r.block.table);
    tap_ok(wrong == 0, "%s: any cut and any level", scramble_name[scramble]);
}

/* ---- a table of the caller's --------------------------------------------------------------- */

static int same_points(const buffon_points *a, const buffon_points *b, size_t dim)
{
    enum { N = 200 };
    const buffon_points *points[2] = {a, b};
    double *u[2];
    for (size_t k = 0; k < 2; k++) {
        ready r = {*points[k], {.key = {.seed = 5, .stratum = 1}, .dim = dim}};
        u[k] = must(malloc(sizeof **u * N * dim));
        r.block.table = must(malloc(r.points.table_size(dim, &r.points)));
        if (r.points.prepare(&r.block, &r.points) != 0)
            exit(1);
        fill(u[k], &r, 999, N);
        free(r.block.table);
    }
    const int same = memcmp(u[0], u[1], sizeof **u * N * dim) == 0;
    free(u[0]);
    free(u[1]);
    return same;
}

/* The first dimensions, written as rows. */
static void test_own_table(void)
{
    static const uint32_t rows[] = {1, 0, 1,            /* d = 2 */
                                    2, 1, 1, 3,         /* 3 */
                                    3, 1, 1, 3, 1,      /* 4 */
                                    3, 2, 1, 1, 1,      /* 5 */
                                    4, 1, 1, 1, 3, 3,   /* 6 */
                                    4, 4, 1, 3, 5, 13}; /* 7 */
    enum { N = sizeof rows / sizeof *rows, ROWS = 6 };
    const buffon_points known = buffon_points_sobol(BUFFON_SCRAMBLE_LINEAR);
    buffon_points own = buffon_points_sobol_table(BUFFON_SCRAMBLE_LINEAR, rows, N);
    tap_ok(own.fill != NULL && same_points(&own, &known, ROWS + 1), "a table: the same points");
    tap_ok(own.table_size(ROWS + 1, &own) < SIZE_MAX && own.table_size(ROWS + 2, &own) == SIZE_MAX,
           "a table: %d dimensions", ROWS + 1);
    own = buffon_points_sobol_table(BUFFON_SCRAMBLE_NONE, rows, 0);
    tap_ok(own.fill != NULL && own.table_size(2, &own) == SIZE_MAX, "no rows: one dimension");
    tap_ok(buffon_points_sobol_table(BUFFON_SCRAMBLE_OWEN, NULL, 0).fill == NULL, "no table");
    tap_ok(buffon_points_sobol_table((buffon_scramble)9, rows, N).fill == NULL, "no scramble");
    tap_ok(buffon_points_sobol_table(BUFFON_SCRAMBLE_OWEN, rows, N - 1).fill == NULL, "cut short");
    static const struct {
        size_t at;
        uint32_t number;
        const char *what;
    } bad[] = {{0, 0, "degree 0"},           {0, 32, "degree 32"},
               {0, UINT32_MAX, "no degree"}, {4, 2, "a coefficient beyond the degree"},
               {6, 2, "an even m"},          {6, 5, "an m that is too large"}};
    for (size_t k = 0; k < COUNT(bad); k++) {
        uint32_t copy[N];
        memcpy(copy, rows, sizeof copy);
        copy[bad[k].at] = bad[k].number;
        tap_ok(buffon_points_sobol_table(BUFFON_SCRAMBLE_OWEN, copy, N).fill == NULL, "refused: %s",
               bad[k].what);
    }
    uint32_t copy[N];
    memcpy(copy, rows, sizeof copy);
    copy[6] = 1;
    own = buffon_points_sobol_table(BUFFON_SCRAMBLE_LINEAR, rows, N);
    const buffon_points other = buffon_points_sobol_table(BUFFON_SCRAMBLE_LINEAR, copy, N);
    tap_ok(other.fill != NULL && memcmp(own.param, other.param, sizeof own.param) != 0 &&
               !same_points(&own, &other, 3),
           "another table: other points, another identity");
}

/* ---- nets ---------------------------------------------------------------------------------- */

/* Has each of the 2^m boxes 2^-a by 2^-(m-a) one of the n = 2^m points? y == NULL: a is m. */
static int one_each(const double *x, const double *y, unsigned m, unsigned a)
{
    static unsigned char seen[1 << 12];
    const size_t n = (size_t)1 << m;
    size_t boxes = 0;
    memset(seen, 0, n);
    for (size_t i = 0; i < n; i++) {
        size_t box = (size_t)(x[i] * (double)(1u << a));
        if (y != NULL)
            box = box << (m - a) | (size_t)(y[i] * (double)(1u << (m - a)));
        boxes += !seen[box];
        seen[box] = 1;
    }
    return boxes == n;
}

/* Dimensions 0 and 1 are a (0, m, 2)-net in every aligned block, and every dimension has a point in
 * each of the 2^m intervals. */
static void test_nets(buffon_scramble scramble)
{
    enum { M = 10, N = 1 << M, WIDE = 8 };
    static const uint64_t block[] = {0, 1, 6, (UINT64_C(1) << 50) + 3};
    double *u = must(malloc(sizeof *u * N * DIMS));
    ready r = make_ready(scramble, (buffon_rng_key){.seed = 11, .replicate = 2}, DIMS);
    size_t boxes = 0, intervals = 0, outside = 0;
    for (size_t k = 0; k < COUNT(block); k++) {
        r.block.dim = k == 0 ? DIMS : WIDE;
        fill(u, &r, block[k] * N, N);
        for (unsigned a = 0; a <= M; a++)
            boxes += !one_each(u, u + N, M, a);
        for (size_t j = 0; j < r.block.dim; j++)
            intervals += !one_each(u + j * N, NULL, M, M);
        for (size_t i = 0; i < N * r.block.dim; i++)
            outside += !(u[i] > 0 && u[i] < 1);
        for (unsigned m = 1; m < M; m++) { /* the second aligned block of 2^m points */
            const size_t at = (size_t)1 << m;
            for (unsigned a = 0; a <= m; a++)
                boxes += !one_each(u + at, u + N + at, m, a);
        }
    }
    free(u);
    free(r.block.table);
    tap_ok(boxes == 0, "%s: (0, m, 2)-nets in aligned blocks", scramble_name[scramble]);
    tap_ok(intervals == 0, "%s: every interval has its point, %d dimensions",
           scramble_name[scramble], DIMS);
    tap_ok(outside == 0, "%s: in (0, 1)", scramble_name[scramble]);
}

/* ---- the law of the scrambles -------------------------------------------------------------- */

/* 12 n^3 Var of the mean of n = 64 points for f = x. A nested scramble leaves in each interval of
 * length 1/n one point, uniform and independent of the others: 1, and the kurtosis is that of a sum
 * of 64 uniforms. The linear one has the same variance; the shift has n as much, since it
 * moves all the points alike. */
static void test_variance(buffon_scramble scramble, uint64_t block, uint32_t dimension)
{
    enum { SEEDS = 12000, N = 64 };
    const double exact_kurtosis = 3 - 1.2 / N;
    double sum2 = 0, sum4 = 0, sum = 0, u[N * 8];
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        ready r = make_ready(scramble, (buffon_rng_key){.seed = seed}, dimension + 1);
        double d = 0;
        fill(u, &r, block * N, N);
        for (size_t i = 0; i < N; i++)
            d += u[dimension * N + i] - 0.5;
        d /= N;
        sum += d;
        sum2 += d * d;
        sum4 += d * d * d * d;
        free(r.block.table);
    }
    const double variance = sum2 / SEEDS, kurtosis = sum4 / SEEDS / (variance * variance);
    const double ratio = 12.0 * N * N * N * variance;
    const double wanted = scramble == BUFFON_SCRAMBLE_SHIFT ? N : 1;
    tap_ok(fabs(sum / SEEDS) < 6.1 * sqrt(variance / SEEDS), "%s: unbiased (%.2f sigma)",
           scramble_name[scramble], sum / SEEDS / sqrt(variance / SEEDS));
    tap_ok(fabs(ratio / wanted - 1) < 6.1 * sqrt((kurtosis - 1) / SEEDS),
           "%s: 12 n^3 Var = %.3f for f = x, block %llu, dimension %u", scramble_name[scramble],
           ratio, (unsigned long long)block, (unsigned)dimension);
    if (scramble == BUFFON_SCRAMBLE_OWEN)
        tap_ok(fabs(kurtosis - exact_kurtosis) < 6.1 * sqrt(24.0 / SEEDS),
               "%s: kurtosis %.3f, that of 64 uniforms is %.3f", scramble_name[scramble], kurtosis,
               exact_kurtosis);
}

/* Eight bits of fixed points over many seeds: chi-squared, and no bucket is empty. */
static void test_buckets(buffon_scramble scramble)
{
    enum { SEEDS = 25600, BUCKETS = 256, POINTS = 4, SHIFTS = 4, D = 3 };
    static const uint64_t index[POINTS] = {0, 1, 12345, UINT64_C(1) << 40};
    static const unsigned shift[SHIFTS] = {0, 6, 13, 40}; /* bits above those looked at */
    static uint32_t count[POINTS][D][SHIFTS][BUCKETS];
    double worst = 0;
    size_t empty = 0;
    memset(count, 0, sizeof count);
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        ready r = make_ready(scramble, (buffon_rng_key){.seed = seed}, D);
        for (size_t p = 0; p < POINTS; p++) {
            double u[D];
            fill(u, &r, index[p], 1);
            for (size_t j = 0; j < D; j++) {
                const uint64_t k = (uint64_t)(u[j] * 0x1p52);
                for (size_t s = 0; s < SHIFTS; s++)
                    count[p][j][s][k >> (44 - shift[s]) & 255]++;
            }
        }
        free(r.block.table);
    }
    const uint32_t *flat = &count[0][0][0][0];
    for (size_t c = 0; c < sizeof count / sizeof *flat; c += BUCKETS) {
        double chi2 = 0;
        for (size_t b = 0; b < BUCKETS; b++) {
            const double d = (double)flat[c + b] - SEEDS / BUCKETS;
            chi2 += d * d / (SEEDS / BUCKETS);
            empty += flat[c + b] == 0;
        }
        worst = chi2 > worst ? chi2 : worst;
    }
    /* P(chi-squared of 255 degrees above 425) < 1e-10. */
    tap_ok(empty == 0 && worst < 425, "%s: no bucket empty or overfull, chi-squared at most %.0f",
           scramble_name[scramble], worst);
}

/* Two points of a nested scramble: the bits above the first one that differs are flipped alike, and
 * so is that one; the bits below independently of each other. No two of 4096 points share the nodes
 * of bits 14 to 19 below the top: over many pairs the XOR of their flips there is uniform, whether
 * the two are of one chunk of 64 points or not. */
static void test_pairs(void)
{
    enum { N = 4096, SEEDS = 8, BUCKETS = 64 };
    static const size_t apart[] = {1, 2, 3, 63, 64, 65, 100, 1024, 2047};
    static double plain[N], u[N];
    ready none = make_ready(BUFFON_SCRAMBLE_NONE, (buffon_rng_key){.seed = 0}, 1);
    fill(plain, &none, 0, N);
    for (size_t a = 0; a < COUNT(apart); a++) {
        double count[BUCKETS] = {0}, pairs = 0, chi2 = 0;
        size_t wrong = 0;
        for (uint64_t seed = 0; seed < SEEDS; seed++) {
            ready r = make_ready(BUFFON_SCRAMBLE_OWEN, (buffon_rng_key){.seed = seed}, 1);
            fill(u, &r, 0, N);
            for (size_t i = 0; i < N; i++) {
                const size_t k = i ^ apart[a];
                const uint64_t p = (uint64_t)(plain[i] * 0x1p52) ^ (uint64_t)(plain[k] * 0x1p52);
                const uint64_t q = (uint64_t)(u[i] * 0x1p52) ^ (uint64_t)(u[k] * 0x1p52);
                unsigned high = 51;
                if (k < i)
                    continue;
                while (!(p >> high & 1))
                    high--;
                wrong += q >> high != 1;
                count[(p ^ q) >> (52 - 20) & (BUCKETS - 1)]++;
                pairs++;
            }
            free(r.block.table);
        }
        for (size_t b = 0; b < BUCKETS; b++)
            chi2 += pow(count[b] - pairs / BUCKETS, 2) * BUCKETS / pairs;
        /* P(chi-squared of 63 degrees above 160) < 1e-9. */
        tap_ok(wrong == 0 && chi2 < 160, "Owen: pairs that differ by %zu, chi-squared %.0f",
               apart[a], chi2);
    }
    free(none.block.table);
}

int main(void)
{
    test_refusals();
    test_known_words();
    test_stretches();
    test_table();
    for (int scramble = 0; scramble < SCRAMBLES; scramble++) {
        test_definition((buffon_scramble)scramble);
        test_cuts_and_levels((buffon_scramble)scramble);
        test_nets((buffon_scramble)scramble);
    }
    test_own_table();
    test_variance(BUFFON_SCRAMBLE_OWEN, 0, 0);
    test_variance(BUFFON_SCRAMBLE_OWEN, 0, 7);
    test_variance(BUFFON_SCRAMBLE_OWEN, 12345, 3);
    test_variance(BUFFON_SCRAMBLE_LINEAR, 3, 4);
    test_variance(BUFFON_SCRAMBLE_SHIFT, 0, 2);
    for (int scramble = 0; scramble < BUFFON_SCRAMBLE_NONE; scramble++)
        test_buckets((buffon_scramble)scramble);
    test_pairs();
    return tap_done();
}
