/* Discrete laws by tables: what a table holds is read and compared, unit by unit, with what the
 * weights ask for; then what is drawn from it. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "../src/shares.h"
#include "grid.h"
#include "law.h"
#include "refused.h"
#include "tap.h"

typedef long double wide;

enum { MOST = 5000 };

static double weight[MOST];
static uint64_t units[MOST];
static uint64_t block[3][4 * MOST];

static buffon_density alias_of(const double *w, size_t count)
{
    return buffon_alias(block[0], sizeof block[0], w, count);
}

static buffon_density guide_of(const double *w, size_t count)
{
    return buffon_guide(block[1], sizeof block[1], w, count);
}

/* The units of each item, added up over the bins. */
static void read_alias(uint64_t *out, const buffon_density *g)
{
    const buffon_priv_table *table = g->data[0];
    const uint64_t *bins = (const uint64_t *)(table + 1);
    const unsigned b = (unsigned)table->bits[0];
    memset(out, 0, table->size[0] * sizeof *out);
    for (size_t k = 0; k < (size_t)1 << b; k++) {
        const uint64_t own = bins[k] >> b, other = bins[k] & ((UINT64_C(1) << b) - 1);
        if (own > 0)
            out[k] += own;
        out[other] += (SHARES_WHOLE >> b) - own;
    }
}

static const uint64_t *bounds_of(const buffon_density *g)
{
    return (const uint64_t *)((const buffon_priv_table *)g->data[0] + 1);
}

/* Both tables say the same, item by item, and it is all. */
static int agree(const buffon_density *alias, const buffon_density *guide, size_t count)
{
    const uint64_t *b = bounds_of(guide);
    int good = alias->status == BUFFON_OK && guide->status == BUFFON_OK;
    if (!good)
        return 0;
    read_alias(units, alias);
    for (size_t k = 0; k < count; k++)
        good &= units[k] == b[k + 1] - b[k] && b[k + 1] >= b[k];
    return good && b[0] == 0 && b[count] == SHARES_WHOLE;
}

/* 2^62 p / q, rounded to the nearest and up where two are near, for p <= q < 2^62: one bit after
 * the other. */
static uint64_t ratio(uint64_t p, uint64_t q)
{
    uint64_t out = p == q;
    uint64_t rest = p == q ? 0 : p;
    for (int k = 0; k < 62; k++) {
        rest *= 2;
        out = 2 * out + (rest >= q);
        rest -= rest >= q ? q : 0;
    }
    return out + (2 * rest >= q);
}

/* Weights that are whole numbers have bounds known exactly. */
static int bounds_are(const buffon_density *g, const uint64_t *whole, size_t count)
{
    const uint64_t *b = bounds_of(g);
    uint64_t sum = 0, total = 0;
    int good = 1;
    for (size_t k = 0; k < count; k++)
        total += whole[k];
    for (size_t k = 0; k < count; k++) {
        sum += whole[k];
        good &= b[k + 1] == ratio(sum, total);
    }
    return good;
}

static void test_equal(void)
{
    int good = 1, exact = 1;
    for (size_t m = 1; m < MOST; m += m < 300 ? 1 : m < 4900 ? 41 : 11) {
        static uint64_t ones[MOST];
        for (size_t k = 0; k < m; k++) {
            weight[k] = 1 / (double)m;
            ones[k] = 1;
        }
        const buffon_density a = alias_of(weight, m), g = guide_of(weight, m);
        good &= agree(&a, &g, m);
        exact &= bounds_are(&g, ones, m);
    }
    tap_ok(good, "m times 1/m: alias and guide give each item the same units, 2^62 in all");
    tap_ok(exact, "m times 1/m: bounds are k 2^62 / m, rounded once");
}

/* Whole numbers of very different sizes, zeros among them, and powers of two times them. */
static void test_whole(void)
{
    static uint64_t whole[MOST];
    int good = 1, exact = 1;
    buffon_rng rng = buffon_rng_make(1, 41);
    for (int trial = 0; trial < 60; trial++) {
        const size_t count = 1 + (size_t)buffon_rng_below(&rng, trial < 50 ? 40 : MOST);
        const double scale = ldexp(1, trial % 3 ? -trial * 17 : trial * 15);
        for (size_t k = 0; k < count; k++) {
            whole[k] = buffon_rng_below(&rng, UINT64_C(1) << buffon_rng_below(&rng, 40));
            weight[k] = (double)whole[k] * scale;
        }
        whole[count - 1] += 1;
        weight[count - 1] = (double)whole[count - 1] * scale;
        const buffon_density a = alias_of(weight, count), g = guide_of(weight, count);
        good &= agree(&a, &g, count);
        exact &= bounds_are(&g, whole, count);
    }
    tap_ok(good, "weights from 0 to 2^40: alias and guide agree");
    tap_ok(exact, "weights from 0 to 2^40, scaled: bounds rounded once");
}

/* A law with a name. */
static void extreme(const char *name, const double *w, size_t count)
{
    const buffon_density a = alias_of(w, count), g = guide_of(w, count);
    int good = agree(&a, &g, count), zero = 1, pdf_good = 1;
    wide sum = 0;
    double worst = 0;
    for (size_t k = 0; k < count; k++)
        sum += w[k];
    for (size_t k = 0; k < count && good; k++) {
        const double x = (double)k, exact = (double)(w[k] / sum);
        double p[2];
        zero &= w[k] > 0 || units[k] == 0;
        pdf_good &= buffon_density_pdf(&p[0], &x, 1, &a) == BUFFON_OK;
        pdf_good &= buffon_density_pdf(&p[1], &x, 1, &g) == BUFFON_OK && p[0] == p[1];
        pdf_good &= (w[k] > 0 && exact > 0) == (p[0] > 0);
        if (LDBL_MANT_DIG >= 64 && exact > 0)
            worst = fmax(worst,
                         (double)fabsl(p[0] - w[k] / sum) / (nextafter(exact, INFINITY) - exact));
        if (LDBL_MANT_DIG >= 64)
            good &= fabsl(ldexpl((wide)units[k], -62) - w[k] / sum) <= 0x1.01p-62L;
    }
    tap_ok(good, "%s: item by item within 2^-62", name);
    tap_ok(zero, "%s: weight 0 has no unit", name);
    if (!tap_ok(pdf_good && worst <= 2, "%s: p within 2 ulp", name))
        tap_note("%.3f", worst);
}

static void test_extremes(void)
{
    const double least[] = {0x1p-1074, 0x1p-1073, 0, 0x1p-1074};
    const double most[] = {DBL_MAX, DBL_MAX, 0.5 * DBL_MAX, 0, DBL_MAX, 1};
    const double far[] = {1e-300, 1e300, 0, 1e-300, 1e280};
    const double one[] = {7}, alone[] = {0, 0, 3e-310, 0, -0.0};
    extreme("subnormal weights", least, 4);
    extreme("a sum beyond the doubles", most, 6);
    extreme("weights 600 decades apart", far, 5);
    extreme("one item", one, 1);
    extreme("one of five", alone, 5);
    for (size_t k = 0; k < 2000; k++)
        weight[k] = k == 1000 ? 1 : 0x1p-50;
    extreme("one heavy among many", weight, 2000);
    for (size_t k = 0; k < 2000; k++)
        weight[k] = ldexp(1, -(int)k);
    extreme("halves of halves", weight, 2000);
    for (size_t k = 0; k < 2048; k++)
        weight[k] = 1 + (double)(k % 7);
    extreme("a power of two of items", weight, 2048);
    for (size_t k = 0; k < 256; k++)
        weight[k] = 0.1;
    extreme("all bins full", weight, 256);
}

/* The item by a search that cannot go wrong. */
static size_t plainly(const uint64_t *b, uint64_t unit)
{
    size_t k = 0;
    while (b[k + 1] <= unit)
        k++;
    return k;
}

static uint64_t unit_of(double u)
{
    return (uint64_t)(u * 0x1p62);
}

/* Weights of a kind, `count` of them. */
static void some_weights(int kind, size_t count, buffon_rng *rng)
{
    for (size_t k = 0; k < count; k++) {
        const double u = buffon_rng_next(rng);
        weight[k] = kind == 0 ? u : kind == 1 ? (k % 3 ? 0 : u) : kind == 2 ? pow(u, 20) : 0x1p-45;
    }
    weight[count / 2] = kind == 3 ? 1 : 0.5;
}

static void test_guide(void)
{
    int right = 1, order = 1, rest_good = 1, inside = 1;
    buffon_rng rng = buffon_rng_make(2, 41);
    for (int kind = 0; kind < 4; kind++) {
        const size_t count = kind == 2 ? 37 : 1500;
        some_weights(kind, count, &rng);
        const buffon_density g = guide_of(weight, count);
        const uint64_t *b = bounds_of(&g);
        for (int i = 0; i < 2500; i++) {
            /* Uniforms, and the very ends of steps. */
            const size_t near = (size_t)buffon_rng_below(&rng, count);
            const double end = ldexp((double)(b[near] >> 9), -53);
            const double u = i % 5 == 4 && end > 0 && end < 1 ? end : grid(&rng, i);
            double x, again, p, q, rest;
            size_t k;
            right &= buffon_density_sample(&x, &p, &u, 1, &g) == BUFFON_OK;
            right &= x == (double)plainly(b, unit_of(u));
            right &= buffon_alias_pick(&k, &q, &rest, u, &g) == BUFFON_OK;
            right &= (double)k == x && p == q && p > 0 && weight[k] > 0;
            const double back = (double)(b[k] + rest * (wide)(b[k + 1] - b[k])) * 0x1p-62;
            inside &= rest > 0 && rest < 1;
            rest_good &= rest < 0x1p-52 || rest > 1 - 0x1p-52 || fabs(back - u) <= 0x1p-52;
            const double more = u + 0x1p-20;
            if (more < 1)
                order &=
                    buffon_density_sample(&again, NULL, &more, 1, &g) == BUFFON_OK && again >= x;
        }
    }
    tap_ok(right, "guide: the item whose step holds u, found as by a plain search");
    tap_ok(order, "guide: items keep the order of u");
    tap_ok(rest_good, "guide: the rest says where in the step u was");
    tap_ok(inside, "guide: the rest is in (0, 1)");
}

static void test_alias_draws(void)
{
    int right = 1, inside = 1;
    buffon_rng rng = buffon_rng_make(3, 41);
    for (int kind = 0; kind < 4; kind++) {
        const size_t count = kind == 2 ? 37 : 1500;
        some_weights(kind, count, &rng);
        const buffon_density g = alias_of(weight, count);
        for (int i = 0; i < 5000; i++) {
            const double u = i == 5 ? 0x1p-1074 : i == 6 ? 0.5 : grid(&rng, i);
            double x, p, q, rest;
            size_t k;
            right &= buffon_density_sample(&x, &p, &u, 1, &g) == BUFFON_OK;
            right &= buffon_alias_pick(&k, &q, &rest, u, &g) == BUFFON_OK;
            right &= (double)k == x && p == q && p > 0 && k < count && weight[k] > 0;
            inside &= rest > 0 && rest < 1;
        }
    }
    tap_ok(right, "alias: pick and sample agree; no item of weight 0");
    tap_ok(inside, "alias: the rest is in (0, 1)");
}

/* Counts from uniforms and from words, and the rests of one heavy and one light item. */
static void test_law(void)
{
    enum { COUNT = 60, DRAWS = 40000 };
    static double u[DRAWS], x[DRAWS], rest[2][DRAWS], mass[COUNT];
    static uint32_t index[DRAWS];
    buffon_rng rng = buffon_rng_make(4, 41);
    double sum = 0;
    for (size_t k = 0; k < COUNT; k++)
        sum += weight[k] = k % 7 == 3 ? 0 : exp(3 * buffon_rng_next(&rng));
    sum += weight[20] = 200;
    for (size_t k = 0; k < COUNT; k++)
        mass[k] = weight[k] / sum;
    sum = 0;
    for (size_t k = 0; k < COUNT; k++)
        sum += mass[k];
    for (size_t k = 0; k < COUNT; k++)
        mass[k] /= sum;
    const buffon_density g[2] = {alias_of(weight, COUNT), guide_of(weight, COUNT)};
    for (int t = 0; t < 2; t++) {
        uint64_t seen[COUNT] = {0}, filled[COUNT] = {0};
        size_t many[2] = {0, 0};
        buffon_rng_fill(u, DRAWS, &rng);
        int good = buffon_density_sample(x, NULL, u, DRAWS, &g[t]) == BUFFON_OK;
        good &= buffon_alias_fill(index, DRAWS, &g[t], &rng) == BUFFON_OK;
        for (size_t i = 0; i < DRAWS; i++) {
            size_t k;
            double r;
            seen[(size_t)x[i]]++;
            filled[index[i]]++;
            good &= buffon_alias_pick(&k, NULL, &r, u[i], &g[t]) == BUFFON_OK;
            if (k == 20)
                rest[0][many[0]++] = r;
            else
                rest[1][many[1]++] = r;
        }
        const char *name = t ? "guide" : "alias";
        tap_ok(good, "%s draws", name);
        law_ok(law_cells(seen, mass, COUNT), "%s: counts from uniforms", name);
        law_ok(law_cells(filled, mass, COUNT), "%s: counts from words", name);
        law_ok(law_uniform(rest[0], many[0]), "%s: the rest of the heavy item is uniform", name);
        law_ok(law_uniform(rest[1], many[1]), "%s: the rest of the others is uniform", name);
    }
}

/* Words are used as they are: the item of the word's upper 62 bits. However the stretch is cut. */
static void test_fill(void)
{
    enum { DRAWS = 3000 };
    static uint32_t whole[DRAWS], cut[DRAWS];
    static uint64_t word[DRAWS];
    buffon_rng rng = buffon_rng_make(5, 41), same, again;
    some_weights(1, 900, &rng);
    const buffon_density g = guide_of(weight, 900), a = alias_of(weight, 900);
    same = again = rng;
    int right = buffon_alias_fill(whole, DRAWS, &g, &rng) == BUFFON_OK, cuts;
    buffon_rng_fill_words(word, DRAWS, &same);
    for (size_t i = 0; i < DRAWS; i++)
        right &= whole[i] == plainly(bounds_of(&g), word[i] >> 2);
    tap_ok(right, "fill: the step of the CDF that holds a word's upper 62 bits");
    cuts = buffon_rng_tell(&rng) == buffon_rng_tell(&same);
    same = again;
    cuts &= buffon_alias_fill(whole, DRAWS, &a, &again) == BUFFON_OK;
    for (size_t i = 0, m = 1; i < DRAWS; i += m, m = m * 3 % 1700 + 1) {
        m = m < DRAWS - i ? m : DRAWS - i;
        cuts &= buffon_alias_fill(cut + i, m, &a, &same) == BUFFON_OK;
    }
    tap_ok(cuts && memcmp(whole, cut, sizeof cut) == 0, "fill: the same however it is cut");
}

static void test_points_without(void)
{
    const double w[] = {1, 0, 2}, x[] = {-1, 0.5, 3, NAN, INFINITY, 1, -0.5, 1e300};
    const buffon_density g[2] = {alias_of(w, 3), guide_of(w, 3)};
    for (int t = 0; t < 2; t++) {
        double pdf[8], at[] = {-0.0, 2}, p[2], u = 0.5;
        int good = buffon_density_pdf(pdf, x, 8, &g[t]) == BUFFON_OK;
        for (int k = 0; k < 8; k++)
            good &= pdf[k] == 0;
        good &=
            buffon_density_pdf(p, at, 2, &g[t]) == BUFFON_OK && p[0] == 1 / 3.0 && p[1] == 2 / 3.0;
        tap_ok(good, "%s: what is no item has pdf 0", g[t].ops->name);
        tap_ok(buffon_density_invert(&u, at, 1, &g[t]) == BUFFON_E_UNSUPPORTED, "%s: no way back",
               g[t].ops->name);
    }
}

static void test_refusals(void)
{
    const double good[] = {1, 2, 3}, zero[] = {0, -0.0, 0}, negative[] = {1, -1e-300, 1};
    const double no_number[] = {1, NAN}, infinite[] = {INFINITY, 1};
    unsigned char *odd = (unsigned char *)block[0] + 1;
    const size_t alias = buffon_alias_size(3), guide = buffon_guide_size(3);
    refused_by_value(alias_of(zero, 3), BUFFON_E_SHAPE, "alias: all weights 0");
    refused_by_value(alias_of(negative, 3), BUFFON_E_SHAPE, "alias: a negative weight");
    refused_by_value(alias_of(no_number, 2), BUFFON_E_SHAPE, "alias: NaN");
    refused_by_value(alias_of(infinite, 2), BUFFON_E_SHAPE, "alias: an infinite weight");
    refused_by_value(alias_of(good, 0), BUFFON_E_DIM, "alias: no items");
    refused_by_value(alias_of(NULL, 3), BUFFON_E_NULL, "alias: no weights");
    refused_by_value(buffon_alias(NULL, alias, good, 3), BUFFON_E_NULL, "alias: no memory");
    refused_by_value(buffon_alias(block[0], alias - 1, good, 3), BUFFON_E_SIZE,
                     "alias: a byte less");
    refused_by_value(buffon_alias(odd, alias, good, 3), BUFFON_E_SIZE,
                     "alias: memory at odd bytes");
    refused_by_value(guide_of(zero, 3), BUFFON_E_SHAPE, "guide: all weights 0");
    refused_by_value(guide_of(negative, 3), BUFFON_E_SHAPE, "guide: a negative weight");
    refused_by_value(guide_of(no_number, 2), BUFFON_E_SHAPE, "guide: NaN");
    refused_by_value(guide_of(infinite, 2), BUFFON_E_SHAPE, "guide: an infinite weight");
    refused_by_value(guide_of(good, 0), BUFFON_E_DIM, "guide: no items");
    refused_by_value(guide_of(NULL, 3), BUFFON_E_NULL, "guide: no weights");
    refused_by_value(buffon_guide(NULL, guide, good, 3), BUFFON_E_NULL, "guide: no memory");
    refused_by_value(buffon_guide(block[1], guide - 1, good, 3), BUFFON_E_SIZE,
                     "guide: a byte less");
    tap_ok(buffon_alias_size(0) == SIZE_MAX && buffon_guide_size(0) == SIZE_MAX &&
               buffon_alias_size((size_t)1 << 31) == SIZE_MAX &&
               buffon_guide_size((size_t)1 << 31) == SIZE_MAX,
           "sizes of tables that cannot be");
}

static void test_calls(void)
{
    const double w[] = {1, 2};
    const buffon_density g = alias_of(w, 2), sphere = buffon_sphere(), bad = alias_of(w, 0);
    buffon_rng rng = buffon_rng_make(6, 41);
    const uint64_t before = buffon_rng_tell(&rng);
    double p = 0, r = 0;
    size_t k = 7;
    uint32_t index[2] = {7, 7};
    tap_ok(buffon_alias_pick(&k, &p, &r, 0.5, &sphere) == BUFFON_E_UNSUPPORTED && k == 0 &&
               p != p && r != r,
           "pick: another density");
    tap_ok(buffon_alias_pick(&k, &p, &r, 0.5, &bad) == BUFFON_E_DIM, "pick: a refused density");
    tap_ok(buffon_alias_pick(NULL, &p, &r, 0.5, &g) == BUFFON_E_NULL && p != p, "pick: no index");
    tap_ok(buffon_alias_fill(index, 2, &sphere, &rng) == BUFFON_E_UNSUPPORTED && index[0] == 0 &&
               index[1] == 0 && buffon_rng_tell(&rng) == before,
           "fill: another density");
    tap_ok(buffon_alias_fill(NULL, 2, &g, &rng) == BUFFON_E_NULL &&
               buffon_alias_fill(index, 2, &g, NULL) == BUFFON_E_NULL &&
               buffon_alias_fill(NULL, 0, &g, &rng) == BUFFON_OK,
           "fill: NULL");
    const double outside[] = {0, 1, -1, 2, NAN, INFINITY, -INFINITY};
    double x[7];
    int safe = buffon_density_sample(x, NULL, outside, 7, &g) == BUFFON_OK;
    for (int i = 0; i < 7; i++)
        safe &= x[i] == 0 || x[i] == 1;
    tap_ok(safe, "what is no uniform gives some item, and reads nothing else");
}

/* A table moved is the same table. */
static void test_open(void)
{
    buffon_rng rng = buffon_rng_make(7, 41);
    some_weights(0, 100, &rng);
    for (int t = 0; t < 2; t++) {
        const buffon_density g = t ? guide_of(weight, 100) : alias_of(weight, 100);
        const size_t size = t ? buffon_guide_size(100) : buffon_alias_size(100);
        unsigned char *bytes = (unsigned char *)block[2];
        double u[50], x[50], y[50], p[50], q[50];
        memcpy(block[2], block[t], size);
        const buffon_density h = buffon_table_open(block[2], size);
        buffon_rng_fill(u, 50, &rng);
        int same = h.status == BUFFON_OK && h.data[0] != g.data[0];
        same &= buffon_density_sample(x, p, u, 50, &g) == BUFFON_OK &&
                buffon_density_sample(y, q, u, 50, &h) == BUFFON_OK;
        tap_ok(same && !memcmp(x, y, sizeof x) && !memcmp(p, q, sizeof p),
               "%s: opened elsewhere, the same points", g.ops->name);
        int caught = 1;
        for (size_t i = 0; i < size; i++) {
            bytes[i] ^= 0x10;
            const buffon_status status = buffon_table_open(block[2], size).status;
            caught &= status == BUFFON_E_CORRUPT || (status == BUFFON_E_SIZE && i < 16);
            bytes[i] ^= 0x10;
        }
        tap_ok(caught, "%s: damage anywhere is seen", g.ops->name);
        refused_by_value(buffon_table_open(block[2], size - 1), BUFFON_E_SIZE, "a table cut short");
    }
    memset(block[2], 0, 64);
    refused_by_value(buffon_table_open(block[2], sizeof block[2]), BUFFON_E_CORRUPT, "no table");
    refused_by_value(buffon_table_open(NULL, 64), BUFFON_E_NULL, "a table at NULL");
    refused_by_value(buffon_table_open(block[2], 8), BUFFON_E_SIZE, "a table of 8 bytes");
    refused_by_value(buffon_table_open((unsigned char *)block[2] + 4, 640), BUFFON_E_SIZE,
                     "a table at odd bytes");
}

int main(void)
{
    test_equal();
    test_whole();
    test_extremes();
    test_guide();
    test_alias_draws();
    test_law();
    test_fill();
    test_points_without();
    test_refusals();
    test_calls();
    test_open();
    return tap_done();
}
