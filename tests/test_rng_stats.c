/* The generator as a source of chance, over the shapes of rng_shapes.h. Each line is one check: the
 * smallest p-value of its parts times their number, which must not be below 1e-9. */
#include <math.h>
#include <stdlib.h>

#include "rng_shapes.h"
#include "tap.h"

enum { CHUNKS = 4, N = CHUNKS * SHAPE_CHUNK };

static uint64_t word[N], sorted[N], scratch[N];
static double uniform[N];

/* ---- p-values ----------------------------------------------------------------------------- */

typedef struct check {
    double p; /* the smallest */
    int parts, worst;
} check;

static void check_p(check *c, double p)
{
    if (c->parts == 0 || !(p >= c->p)) {
        c->p = p;
        c->worst = c->parts;
    }
    c->parts++;
}

/* z is standard normal. */
static void check_z(check *c, double z)
{
    check_p(c, erfc(fabs(z) / sqrt(2)));
}

/* `hits` is binomial of n and q, n large. */
static void check_count(check *c, double hits, double n, double q)
{
    check_z(c, (hits - n * q) / sqrt(n * q * (1 - q)));
}

static void check_poisson(check *c, double count, double mean)
{
    double below = 0, above = 0; /* P(X <= count), P(X >= count) */
    for (int k = 0; k < 1000; k++) {
        double p = exp(k * log(mean) - mean - lgamma(k + 1.0));
        below += k <= count ? p : 0;
        above += k >= count ? p : 0;
    }
    check_p(c, fmin(1, 2 * fmin(below, above)));
}

/* Counts against equal chances, or against expect if there is one: Wilson and Hilferty (1931). */
static void check_chi2(check *c, const uint32_t *count, size_t cells, double n,
                       const double *expect)
{
    double sum = 0, k = (double)cells - 1;
    for (size_t i = 0; i < cells; i++) {
        double e = expect ? n * expect[i] : n / (double)cells;
        sum += (count[i] - e) * (count[i] - e) / e;
    }
    check_z(c, (cbrt(sum / k) - (1 - 2 / (9 * k))) / sqrt(2 / (9 * k)));
}

static void check_report(const check *c, const char *shape_name, const char *what)
{
    double p = c->p * c->parts;
    if (!tap_ok(p >= 1e-9, "%s: %s", shape_name, what))
        tap_note("p = %.3g, at part %d of %d", p, c->worst + 1, c->parts);
}

/* ---- checks of N words -------------------------------------------------------------------- */

static void sort_words(int bits)
{
    for (int shift = 0; shift < bits; shift += 8) {
        uint32_t start[257] = {0};
        for (size_t i = 0; i < N; i++)
            start[(sorted[i] >> shift & 255) + 1]++;
        for (int b = 0; b < 255; b++)
            start[b + 1] += start[b];
        for (size_t i = 0; i < N; i++)
            scratch[start[sorted[i] >> shift & 255]++] = sorted[i];
        memcpy(sorted, scratch, sizeof sorted);
    }
}

/* Birthdays: equal words, equal high halves, equal low halves. */
static check words_repeat(void)
{
    static const int bits[3] = {64, 32, 32};
    check c = {0};
    for (int part = 0; part < 3; part++) {
        double repeats = 0;
        for (size_t i = 0; i < N; i++)
            sorted[i] = part == 0 ? word[i] : part == 1 ? word[i] >> 32 : word[i] & UINT32_MAX;
        sort_words(bits[part]);
        for (size_t i = 1; i < N; i++)
            repeats += sorted[i] == sorted[i - 1];
        check_poisson(&c, repeats, ldexp((double)N * (N - 1) / 2, -bits[part]));
    }
    return c;
}

static unsigned weight(uint64_t x)
{
    x -= x >> 1 & UINT64_C(0x5555555555555555);
    x = (x & UINT64_C(0x3333333333333333)) + (x >> 2 & UINT64_C(0x3333333333333333));
    x = (x + (x >> 4)) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    return (unsigned)(x * UINT64_C(0x0101010101010101) >> 56);
}

/* Correlation of the uniforms, and the number of bits that agree. */
static check words_lag(void)
{
    static const size_t far[] = {128, 255, 256, 257, 512, 1008, 1023, 1024, 1025};
    check c = {0};
    for (size_t i = 0; i < 64 + sizeof far / sizeof far[0]; i++) {
        size_t lag = i < 64 ? i + 1 : far[i - 64], n = N - lag;
        double sum[4] = {0};
        for (size_t j = 0; j < n; j++)
            sum[j % 4] += (uniform[j] - 0.5) * (uniform[j + lag] - 0.5);
        check_z(&c, (sum[0] + sum[1] + (sum[2] + sum[3])) / (sqrt((double)n) / 12));
        if (i < 16 || i % 16 == 15 || i >= 64) {
            uint64_t ones = 0;
            for (size_t j = 0; j < n; j++)
                ones += weight(word[j] ^ word[j + lag]);
            check_count(&c, (double)ones, 64 * (double)n, 0.5);
        }
    }
    return c;
}

/* Both ends: how often within 2^-10 of each, from the high and from the low bits; the extremes. */
static check words_edge(void)
{
    double hits[4] = {0}, least = 1, greatest = 0;
    check c = {0};
    for (size_t i = 0; i < N; i++) {
        uint64_t high = word[i] >> 54, low = word[i] & 1023;
        hits[0] += high == 0;
        hits[1] += high == 1023;
        hits[2] += low == 0;
        hits[3] += low == 1023;
        least = fmin(least, uniform[i]);
        greatest = fmax(greatest, uniform[i]);
    }
    for (int i = 0; i < 4; i++)
        check_poisson(&c, hits[i], N * 0x1p-10);
    for (int i = 0; i < 2; i++) {
        double beyond = exp(N * log1p(-(i == 0 ? least : 1 - greatest)));
        check_p(&c, fmin(1, 2 * fmin(beyond, 1 - beyond)));
    }
    return c;
}

/* Each bit, its changes from word to word, and its agreement with its neighbour in the word. */
static check words_bit(void)
{
    check c = {0};
    for (int part = 0; part < 3; part++) {
        uint32_t ones[64] = {0};
        for (size_t i = 0; i + 1 < N; i++) {
            uint64_t w = word[i], other = part == 1 ? word[i + 1] : w << 1 | w >> 63;
            w ^= part == 0 ? 0 : other;
            for (int b = 0; b < 64; b++)
                ones[b] += (uint32_t)(w >> b & 1);
        }
        for (int b = 0; b < 64; b++)
            check_count(&c, ones[b], N - 1, 0.5);
    }
    return c;
}

static check words_byte(void)
{
    static uint32_t count[8][256];
    check c = {0};
    memset(count, 0, sizeof count);
    for (size_t i = 0; i < N; i++)
        for (int b = 0; b < 8; b++)
            count[b][word[i] >> 8 * b & 255]++;
    for (int b = 0; b < 8; b++)
        check_chi2(&c, count[b], 256, N, NULL);
    return c;
}

/* Cells of 4096 of the square and the cube, by the high bits and by the low ones. */
static check words_grid(void)
{
    check c = {0};
    for (int part = 0; part < 4; part++) {
        uint32_t count[4096] = {0};
        size_t dim = part < 2 ? 2 : 3, bits = 12 / dim, n = 0;
        for (size_t i = 0; i + dim <= N; i += dim, n++) {
            size_t cell = 0;
            for (size_t j = 0; j < dim; j++) {
                uint64_t w = word[i + j];
                cell = cell << bits | (size_t)(part % 2 == 0 ? w >> (64 - bits)
                                                             : w & ((1u << bits) - 1));
            }
            count[cell]++;
        }
        check_chi2(&c, count, 4096, (double)n, NULL);
    }
    return c;
}

/* How long four bits stay away from zero: a geometric law. */
static check words_gap(void)
{
    enum { LONGEST = 80 };
    double expect[LONGEST + 1], rest = 1;
    check c = {0};
    for (int i = 0; i < LONGEST; i++) {
        expect[i] = rest / 16;
        rest -= expect[i];
    }
    expect[LONGEST] = rest;
    for (int shift = 0; shift < 64; shift += 12) {
        uint32_t count[LONGEST + 1] = {0}, gap = 0, gaps = 0;
        for (size_t i = 0; i < N; i++)
            if ((word[i] >> shift & 15) != 0)
                gap++;
            else {
                count[gap < LONGEST ? gap : LONGEST]++;
                gaps++;
                gap = 0;
            }
        check_chi2(&c, count, LONGEST + 1, gaps, expect);
    }
    return c;
}

/* Two words throw a ball into one of 2^20 urns; how many hit one that is not empty? */
static check words_collide(void)
{
    static unsigned char urn[1 << 20];
    const double urns = 1 << 20, balls = N / 2, load = balls / urns;
    check c = {0};
    for (int shift = 0; shift < 64; shift += 18) {
        double collisions = 0, free = urns * exp(balls * log1p(-1 / urns));
        memset(urn, 0, sizeof urn);
        for (size_t i = 0; i + 1 < N; i += 2) {
            size_t at = (size_t)((word[i] >> shift & 1023) << 10 | (word[i + 1] >> shift & 1023));
            collisions += urn[at];
            urn[at] = 1;
        }
        check_z(&c, (collisions - (balls - urns + free)) /
                        sqrt(urns * exp(-load) * (1 - (1 + load) * exp(-load))));
    }
    return c;
}

/* The number of ones: its law, and that of neighbours together. */
static check words_weight(void)
{
    enum { FROM = 20, TO = 44 };
    uint32_t count[TO - FROM + 1] = {0};
    double expect[TO - FROM + 1] = {0}, sum = 0, last = 0;
    check c = {0};
    for (int k = 0; k <= 64; k++)
        expect[k < FROM ? 0 : k > TO ? TO - FROM : k - FROM] +=
            exp(lgamma(65) - lgamma(k + 1.0) - lgamma(65.0 - k) - 64 * log(2));
    for (size_t i = 0; i < N; i++) {
        int k = (int)weight(word[i]);
        count[k < FROM ? 0 : k > TO ? TO - FROM : k - FROM]++;
        sum += last * (k - 32);
        last = k - 32;
    }
    check_chi2(&c, count, TO - FROM + 1, N, expect);
    check_z(&c, sum / (16 * sqrt(N - 1.0)));
    return c;
}

static void test_shape(const shape *s)
{
    static const struct {
        const char *name;
        check (*run)(void);
    } list[] = {
        {"repeats", words_repeat}, {"lags", words_lag},           {"edges", words_edge},
        {"bits", words_bit},       {"bytes", words_byte},         {"pairs and triples", words_grid},
        {"gaps", words_gap},       {"collisions", words_collide}, {"weights", words_weight},
    };
    for (size_t chunk = 0; chunk < CHUNKS; chunk++)
        s->make(word + chunk * SHAPE_CHUNK, chunk, s->kind);
    for (size_t i = 0; i < N; i++)
        uniform[i] = (double)(word[i] >> 12) * 0x1p-52 + 0x1p-53;
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++) {
        check c = list[i].run();
        check_report(&c, s->name, list[i].name);
    }
}

/* ---- whole numbers ------------------------------------------------------------------------ */

static void test_below(void)
{
    static const uint32_t small[] = {2, 3, 5, 6, 10, 100, 641, 1000};
    buffon_rng rng = buffon_rng_make(1, 3);
    check c = {0};
    for (size_t i = 0; i < sizeof small / sizeof small[0]; i++) {
        uint32_t count[1000] = {0};
        for (int j = 0; j < N; j++)
            count[buffon_rng_below(&rng, small[i])]++;
        check_chi2(&c, count, small[i], N, NULL);
    }
    check_report(&c, "below", "small bounds");

    /* Of a bound of 3/4 2^64 the remainder of a word would favour the first third, and a word
     * scaled down without refusals the multiples of three. */
    uint32_t third[3] = {0}, rest[3] = {0};
    c = (check){0};
    for (int j = 0; j < N; j++) {
        uint64_t value = buffon_rng_below(&rng, UINT64_C(3) << 62);
        third[value >> 62]++;
        rest[value % 3]++;
    }
    check_chi2(&c, third, 3, N, NULL);
    check_chi2(&c, rest, 3, N, NULL);
    check_report(&c, "below", "thirds and remainders of a bound of 3/4 2^64");
}

int main(void)
{
    for (size_t i = 0; i < SHAPE_COUNT; i++)
        test_shape(&shape_list[i]);
    test_below();
    return tap_done();
}
