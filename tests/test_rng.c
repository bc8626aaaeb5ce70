/* The generator word for word: published answers, a second implementation written from the text of
 * rng.h, frozen streams, every way of cutting and walking, and conversions at scripted words. */
#include <fenv.h>
#include <stdlib.h>

#include <buffon/rng.h>

#include "rng_naive.h"
#include "splitmix.h"
#include "tap.h"

#ifndef TESTS_DATA
#define TESTS_DATA "tests/data"
#endif

/* A number below `bound`, or any for 0. */
static uint64_t choose(uint64_t bound)
{
    const uint64_t word = splitmix_word();
    return bound == 0 ? word : word % bound;
}

static buffon_rng_key choose_key(void)
{
    buffon_rng_key key = {choose(0), choose(0), (uint8_t)choose(256), (uint8_t)choose(256),
                          (uint16_t)choose(65536)};
    return key;
}

/* ---- known answers ------------------------------------------------------------------------ */

static void test_philox(void)
{
    static const uint32_t known[3][10] = {
        {0, 0, 0, 0, 0, 0, 0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8},
        {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff, 0x408f276d,
         0x41c83b0e, 0xa20bc7c6, 0x6d5451fd},
        {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344, 0xa4093822, 0x299f31d0, 0xd16cfe09,
         0x94fdcceb, 0x5001e420, 0x24126ea1},
    };
    for (int i = 0; i < 3; i++) {
        uint32_t out[4];
        memcpy(out, known[i], sizeof out);
        buffon_rng_philox(out, out, known[i] + 4);
        tap_ok(memcmp(out, known[i] + 6, sizeof out) == 0, "Philox4x32-10, published answer %d", i);
    }
}

/* A sequence whose buffer is empty in the middle of a row: the lanes are what one makes them. */
static buffon_rng scripted_lanes(void)
{
    buffon_rng rng = buffon_rng_make(0, 0);
    rng.next = 256;
    return rng;
}

static void test_xoshiro(void)
{
    static const uint64_t known[5] = {41943041, 58720359, UINT64_C(3588806011781223),
                                      UINT64_C(3591011842654386), UINT64_C(9228616714210784205)};
    buffon_rng rng = scripted_lanes();
    int good = 1;
    for (unsigned j = 0; j < 4; j++)
        for (unsigned lane = 0; lane < 16; lane++)
            rng.state[j][lane] = j + 1;
    for (unsigned i = 0; i < 80; i++)
        good &= buffon_rng_word(&rng) == known[i / 16];
    tap_ok(good, "xoshiro256++ from {1, 2, 3, 4}, published answer, in each lane");
}

static void test_frozen(void)
{
    FILE *file = fopen(TESTS_DATA "/rng_streams.txt", "r");
    char line[512];
    int lines = 0, bad = 0;
    if (!tap_ok(file != NULL, "the frozen streams can be read"))
        return;
    while (fgets(line, sizeof line, file)) {
        uint64_t field[15], got[8];
        char *at = line;
        if (line[0] == '#')
            continue;
        for (int i = 0; i < 15; i++) {
            field[i] = strtoull(at, &at, 16);
            at += *at == ':';
        }
        buffon_rng_key key = {field[0], field[1], (uint8_t)field[2], (uint8_t)field[3],
                              (uint16_t)field[4]};
        buffon_rng_words_at(got, 8, &key, (uint32_t)field[5], field[6]);
        bad += memcmp(got, field + 7, sizeof got) != 0;
        lines++;
    }
    fclose(file);
    tap_ok(lines == 16 && bad == 0, "%d frozen streams, %d differ", lines, bad);
}

/* ---- stretches ---------------------------------------------------------------------------- */

static int window_is_right(const buffon_rng_key *key, uint32_t dimension, uint64_t first, size_t n)
{
    static uint64_t w[5001];
    static double u[5001];
    int good = 1;
    w[n] = 0x5a5a;
    u[n] = -7;
    buffon_rng_words_at(w, n, key, dimension, first);
    buffon_rng_uniforms_at(u, n, key, dimension, first);
    for (size_t i = 0; i < n; i++)
        good &= w[i] == naive_word(key, dimension, first + i) && naive_is_uniform(u[i], w[i]);
    return good && w[n] == 0x5a5a && u[n] == -7;
}

static void test_windows(void)
{
    int good = 1;
    for (int i = 0; i < 300; i++) {
        buffon_rng_key key = choose_key();
        uint64_t first = choose(0) >> choose(64);
        good &= window_is_right(&key, (uint32_t)choose(0), first, (size_t)choose(100));
    }
    tap_ok(good, "short windows of random keys are those of the second implementation");
    good = 1;
    for (int i = 0; i < 40; i++) {
        buffon_rng_key key = choose_key();
        uint64_t first = choose(0) - choose(4000);
        good &= window_is_right(&key, (uint32_t)choose(0), first, (size_t)choose(5001));
        good &= window_is_right(&key, (uint32_t)choose(9), 0 - choose(3000), (size_t)choose(5001));
    }
    tap_ok(good, "long windows too, and those across 2^64");
    good = 1;
    for (uint64_t first = 1024 - 34; first < 1024 + 18; first++)
        for (size_t n = 0; n < 52; n += 1 + n / 20) {
            buffon_rng_key key = {first, n, 0, 0, 0};
            good &= window_is_right(&key, 0, first, n);
        }
    tap_ok(good, "every place and length around the edge of a row");
    good = 1;
    for (uint64_t first = 0; first < 3072; first += 512)
        for (size_t n = 512; n <= 3072; n += 512) {
            buffon_rng_key key = {5, 6, BUFFON_PURPOSE_PILOT, 1, 2};
            good &= window_is_right(&key, 3, first, n);
        }
    tap_ok(good, "whole and half rows");
}

static int compare_words(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Every combination of near and far values of each part of the key: 3^7 places, eight words
 * each. */
static void test_no_sharing(void)
{
    static const uint64_t near_far[3] = {0, 1, UINT64_C(1) << 32};
    static const uint8_t bytes[3] = {0, 1, 2};
    static uint64_t w[8 * 2187];
    size_t n = 0, repeats = 0;
    for (int i = 0; i < 2187; i++) {
        buffon_rng_key key = {near_far[i % 3], near_far[i / 3 % 3], bytes[i / 9 % 3],
                              bytes[i / 27 % 3], bytes[i / 81 % 3]};
        uint32_t dimension = (uint32_t)(i / 243 % 3);
        buffon_rng_words_at(w + n, 8, &key, dimension, near_far[i / 729] * 1024);
        n += 8;
    }
    qsort(w, n, sizeof w[0], compare_words);
    for (size_t i = 1; i < n; i++)
        repeats += w[i] == w[i - 1];
    tap_ok(repeats == 0, "no two seeds, streams, purposes, replicates, strata, dimensions or rows "
                         "share a word");
}

/* ---- the sequence ------------------------------------------------------------------------- */

enum { REFERENCE = 20000 };
static uint64_t reference[REFERENCE]; /* of seed 42, stream 7 */

static void test_sequence(void)
{
    const buffon_rng_key key = {42, 7, BUFFON_PURPOSE_RNG, 0, 0};
    buffon_rng rng = buffon_rng_make(42, 7), other = rng, third = rng;
    int good = buffon_rng_tell(&rng) == 0;
    for (size_t i = 0; i < REFERENCE; i++) {
        uint64_t w = reference[i] = naive_word(&key, 0, i);
        good &= buffon_rng_word(&rng) == w && naive_is_uniform(buffon_rng_next(&other), w) &&
                naive_is_float(buffon_rng_float(&third), w) && buffon_rng_tell(&rng) == i + 1;
    }
    tap_ok(good, "word, next and float are the words of the purpose RNG, one after the other");
    tap_ok(memcmp(&rng, &other, sizeof rng) == 0, "word and next leave the same state");

    uint64_t (*word)(buffon_rng *) = buffon_rng_word;
    double (*next)(buffon_rng *) = buffon_rng_next;
    float (*single)(buffon_rng *) = buffon_rng_float;
    rng = buffon_rng_make(42, 7);
    good = word(&rng) == reference[0] && naive_is_uniform(next(&rng), reference[1]) &&
           naive_is_float(single(&rng), reference[2]);
    tap_ok(good, "the inline calls are functions too");
}

/* Takes n numbers in the given way and says whether they are those of the reference. */
static int take(buffon_rng *rng, size_t from, size_t n, int way)
{
    static uint64_t w[REFERENCE + 1];
    static double u[REFERENCE + 1];
    static float f[REFERENCE + 1];
    int good = 1;
    w[n] = 1;
    u[n] = f[n] = -7;
    if (way == 0)
        buffon_rng_fill(u, n, rng);
    else if (way == 1)
        buffon_rng_fill_words(w, n, rng);
    else if (way == 2)
        buffon_rng_fill_floats(f, n, rng);
    for (size_t i = 0; i < n; i++) {
        uint64_t want = reference[from + i];
        if (way == 0)
            good &= naive_is_uniform(u[i], want);
        else if (way == 1)
            good &= w[i] == want;
        else if (way == 2)
            good &= naive_is_float(f[i], want);
        else if (way == 3)
            good &= naive_is_uniform(buffon_rng_next(rng), want);
        else
            good &= buffon_rng_below(rng, UINT64_C(1) << 63) == want >> 1;
    }
    return good && w[n] == 1 && u[n] == -7 && f[n] == -7 && buffon_rng_tell(rng) == from + n;
}

static void test_cuts(void)
{
    static const size_t size[] = {1,   2,   3,    15,   16,   17,   255,  256,  257,  511,
                                  512, 513, 1000, 1023, 1024, 1025, 4095, 4096, 4097, REFERENCE};
    int good = 1;
    for (size_t s = 0; s < sizeof size / sizeof size[0]; s++)
        for (int way = 0; way < 3; way++) {
            buffon_rng rng = buffon_rng_make(42, 7);
            for (size_t at = 0; at < REFERENCE; at += size[s])
                good &= take(&rng, at, size[s] < REFERENCE - at ? size[s] : REFERENCE - at, way);
        }
    tap_ok(good, "fill in equal cuts of any size gives the numbers of next");
    good = 1;
    for (int trial = 0; trial < 60; trial++) {
        buffon_rng rng = buffon_rng_make(42, 7);
        size_t at = 0;
        while (at < REFERENCE) {
            size_t n = (size_t)(choose(3000) >> choose(12));
            if (n > REFERENCE - at)
                n = REFERENCE - at;
            good &= take(&rng, at, n, (int)choose(5));
            at += n;
        }
    }
    tap_ok(good, "fill, fill_words, fill_floats, next and below interleaved in random cuts");
}

static void test_seek(void)
{
    buffon_rng rng = buffon_rng_make(42, 7);
    int good = 1;
    for (int i = 0; i < 3000; i++) {
        uint64_t at = buffon_rng_tell(&rng), to = choose(REFERENCE - 3000);
        size_t n = (size_t)(choose(3000) >> choose(12));
        if (i % 3 == 0)
            buffon_rng_seek(&rng, to);
        else if (i % 3 == 1)
            buffon_rng_skip(&rng, to - at);
        else
            buffon_rng_skip(&rng, to = choose(300)), to += at;
        good &= buffon_rng_tell(&rng) == to;
        if (to + n <= REFERENCE)
            good &= take(&rng, (size_t)to, n, (int)choose(5));
        else
            rng = buffon_rng_make(42, 7);
    }
    tap_ok(good, "seek and skip, forwards and back, then any way of taking numbers");
    good = 1;
    for (uint64_t back = 1; back < 1100; back++) {
        rng = buffon_rng_make(42, 7);
        good &= take(&rng, 0, 2048, (int)(back % 2));
        buffon_rng_skip(&rng, 0 - back);
        good &= take(&rng, (size_t)(2048 - back), 3, 3);
        rng = buffon_rng_make(42, 7);
        buffon_rng_skip(&rng, 0 - back);
        buffon_rng_skip(&rng, back);
        good &= take(&rng, 0, 3, 3);
    }
    tap_ok(good, "back a little from an empty buffer, whose words are none");

    const buffon_rng_key key = {42, 7, BUFFON_PURPOSE_RNG, 0, 0};
    good = 1;
    for (uint64_t before = 0; before < 2100; before += 1 + choose(40)) {
        uint64_t w[2200], from = 0 - before;
        buffon_rng_seek(&rng, from);
        good &= buffon_rng_tell(&rng) == from;
        good &= buffon_rng_word(&rng) == naive_word(&key, 0, from);
        buffon_rng_fill_words(w, 2200, &rng);
        good &=
            w[0] == naive_word(&key, 0, from + 1) && w[1500] == naive_word(&key, 0, from + 1501);
        good &= w[2199] == reference[2200 - before] && buffon_rng_tell(&rng) == 2201 - before;
    }
    tap_ok(good, "the sequence goes on with word 0 after word 2^64 - 1");
    good = 1;
    for (int i = 0; i < 200; i++) {
        uint64_t to = choose(0);
        buffon_rng_seek(&rng, to);
        good &= buffon_rng_word(&rng) == naive_word(&key, 0, to);
    }
    tap_ok(good, "seek anywhere in 2^64");
}

static void test_checkpoint(void)
{
    buffon_rng rng = buffon_rng_make(42, 7);
    size_t at = 0;
    int good = 1;
    for (int i = 0; i < 100; i++) {
        size_t n = (size_t)choose(150);
        buffon_rng *copy = malloc(sizeof *copy);
        if (copy == NULL)
            break;
        *copy = rng;
        good &= take(&rng, at, n, (int)choose(5));
        good &= take(copy, at, 2000, (int)choose(5));
        free(copy);
        at += n;
    }
    tap_ok(good, "a copy goes on like the original, and each alone");
    tap_ok(sizeof(buffon_rng) == 2592 && offsetof(buffon_rng, at) == 2584,
           "the size of a buffon_rng is that of this version");
}

/* ---- conversions -------------------------------------------------------------------------- */

static uint64_t scripted_word(unsigned i)
{
    static const uint64_t edge[4] = {0, ~UINT64_C(0), UINT64_C(1) << 63, (UINT64_C(1) << 63) - 1};
    if (i < 4)
        return edge[i];
    return i < 68 ? UINT64_C(1) << (i - 4) : i < 132 ? ~(UINT64_C(1) << (i - 68)) : choose(0);
}

/* In the buffer, one by one and by fill; and in the lanes, whose first output is
 * rotl(s0 + s3, 23) + s0: with s0 = 0 any word can be had. */
static int scripted_is_right(void)
{
    int good = 1;
    for (unsigned batch = 0; batch < 100; batch++) {
        buffon_rng one = buffon_rng_make(0, 0), many, lanes = scripted_lanes();
        double u[256];
        uint64_t w[16];
        one.at = 0;
        one.next = 256;
        for (unsigned i = 0; i < 16; i++) {
            one.buffer[i] = one.buffer[i + 16] = w[i] = scripted_word(16 * batch + i);
            lanes.state[3][i] = naive_rotate(w[i], 64 - 23);
        }
        many = one;
        buffon_rng_fill(u, 16, &many);
        for (unsigned i = 0; i < 16; i++)
            good &= naive_is_uniform(buffon_rng_next(&one), w[i]) && naive_is_uniform(u[i], w[i]);
        for (unsigned i = 0; i < 16; i++)
            good &= naive_is_float(buffon_rng_float(&one), w[i]);
        buffon_rng_fill(u, 256, &lanes);
        for (unsigned i = 0; i < 16; i++)
            good &= naive_is_uniform(u[i], w[i]);
    }
    return good;
}

static void test_conversions(void)
{
    tap_ok(scripted_is_right(), "uniforms and floats are exact at words 0 and ~0, each bit alone, "
                                "and random ones, on every path");
#if defined(FE_UPWARD) && defined(FE_DOWNWARD) && defined(FE_TOWARDZERO)
    static const int mode[3] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    for (int i = 0; i < 3; i++) {
        int good;
        fesetround(mode[i]);
        good = scripted_is_right();
        fesetround(FE_TONEAREST);
        tap_ok(good, "and in rounding mode %d of 3", i + 1);
    }
#endif
    buffon_rng rng = buffon_rng_make(0, 0);
    rng.at = 0;
    rng.next = 256;
    rng.buffer[0] = rng.buffer[2] = 0;
    rng.buffer[1] = rng.buffer[3] = ~UINT64_C(0);
    tap_ok(buffon_rng_next(&rng) == 0x1p-53 && buffon_rng_next(&rng) == 1 - 0x1p-53 &&
               buffon_rng_float(&rng) == 0x1p-24f && buffon_rng_float(&rng) == 1 - 0x1p-24f,
           "the ends are 2^-53, 1 - 2^-53, and 2^-24, 1 - 2^-24");
}

/* ---- whole numbers ------------------------------------------------------------------------ */

/* ceil(v 2^64 / bound) mod 2^64 by long division: the first word whose value can be v <= bound. */
static uint64_t first_word(uint64_t v, uint64_t bound)
{
    uint64_t quotient = 0, rest = v % bound;
    for (int i = 0; i < 64; i++) {
        int carry = rest >> 63 != 0;
        rest <<= 1;
        quotient <<= 1;
        if (carry || rest >= bound) {
            rest -= bound;
            quotient |= 1;
        }
    }
    return quotient + (rest > 0);
}

/* Is w refused? If not, it must give v; if so, the word after it decides, here ~0: the largest. */
static int is_refused(uint64_t w, uint64_t bound, uint64_t v, int *good)
{
    buffon_rng rng = buffon_rng_make(0, 0);
    rng.at = 0;
    rng.next = 256;
    rng.buffer[0] = w;
    rng.buffer[1] = ~UINT64_C(0);
    uint64_t value = buffon_rng_below(&rng, bound), used = buffon_rng_tell(&rng);
    *good &= used == 1 ? value == v : used == 2 && value == bound - 1;
    return used == 2;
}

/* The words of value v are an interval. Its low halves rise by bound, so that beyond its second
 * word none can be refused. It must keep floor(2^64 / bound) words, whatever v. */
static int keeps_its_share(uint64_t v, uint64_t bound)
{
    uint64_t from = first_word(v, bound), to = first_word(v + 1, bound), kept = to - from;
    uint64_t share = bound == 1 ? 0 : (0 - bound) / bound + 1; /* mod 2^64 */
    int good = 1;
    kept -= (uint64_t)is_refused(from, bound, v, &good);
    if (to - from > 1)
        good &= !is_refused(from + 1, bound, v, &good);
    if (to - from > 2)
        good &= !is_refused(to - 1, bound, v, &good);
    return good && kept == share;
}

static void test_below(void)
{
    static const uint64_t bounds[] = {1,
                                      2,
                                      3,
                                      5,
                                      6,
                                      7,
                                      10,
                                      255,
                                      256,
                                      257,
                                      641,
                                      1000,
                                      UINT64_C(0xffffffff),
                                      UINT64_C(0x100000000),
                                      UINT64_C(0x100000001),
                                      UINT64_C(0x7fffffffffffffff),
                                      UINT64_C(0x8000000000000000),
                                      UINT64_C(0x8000000000000001),
                                      UINT64_C(0xaaaaaaaaaaaaaaaa),
                                      UINT64_C(0xc000000000000000),
                                      UINT64_C(0xffffffffffffffff)};
    int good = 1;
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++) {
        uint64_t bound = bounds[i];
        for (uint64_t v = 0; v < bound && v < 1000; v++)
            good &= keeps_its_share(v, bound) && keeps_its_share(bound - 1 - v, bound) &&
                    keeps_its_share(choose(bound), bound);
    }
    tap_ok(good, "below: each value keeps exactly floor(2^64 / bound) words, edge bounds");
    good = 1;
    for (int i = 0; i < 20000; i++) {
        uint64_t bound = (choose(0) >> choose(64)) + 1;
        good &= bound == 0 || keeps_its_share(choose(bound), bound);
    }
    tap_ok(good, "below: the same for random bounds and values");

    buffon_rng rng = buffon_rng_make(42, 7);
    good = 1;
    for (int i = 0; i < 1000; i++)
        good &= buffon_rng_below(&rng, 0) == reference[i];
    for (int i = 1000; i < 2000; i++)
        good &= buffon_rng_below(&rng, 1) == 0;
    tap_ok(good && buffon_rng_tell(&rng) == 2000, "below: bound 0 gives the words, bound 1 zeros");
}

int main(void)
{
    test_philox();
    test_xoshiro();
    test_frozen();
    test_windows();
    test_no_sharing();
    test_sequence();
    test_cuts();
    test_seek();
    test_checkpoint();
    test_conversions();
    test_below();
    return tap_done();
}
