/* Sobol' points: include/buffon/sobol.h says what every bit is. */
#include "guard.h"

#include <buffon/sobol.h>

#include <string.h>

#include "mix.h"
#include "sobol_table.h"

#define SOBOL_BITS 64
#define SOBOL_CHUNK 64  /* aligned points that are made together: they differ in six bits of i */
#define SOBOL_STEPS 58  /* between chunks: one for each bit of the number of a chunk */
#define SOBOL_DEGREE 31 /* of a caller's polynomials */
#define SOBOL_SHIFT 64  /* the random word that shifts */
#define SOBOL_RANDOM 65 /* random words of a dimension */
#define SOBOL_REPLICATES 8
#define SOBOL_MEDIAN 15 /* replicates: the 4th to the 12th cover with 96.5 % */
#define SOBOL_TOP (UINT64_C(0x3f) << SOBOL_STEPS)

enum { SOBOL_WORDS, SOBOL_UNIFORMS, SOBOL_TREE };

/* A dimension as the kernels want it. In a chunk of 64 points all bits of a word below the top six
 * are those of the chunk, and the top six take every value once: so a word is `leaf[t]`, which has
 * the top six, XOR the word of the chunk; and the chunks' words differ by steps.
 *
 * For a tree (nested scramble) leaf[t] has the top six bits scrambled already, for the one value
 * that point t of chunk 0 has there, and the top six bits of steps are such t: the point t of a
 * chunk has leaf[t ^ top six bits of the chunk's word], since t and the value are linear in each
 * other. */
typedef struct sobol_row {
    uint64_t step[SOBOL_STEPS];
    uint64_t leaf[SOBOL_CHUNK];
    uint64_t key[2];
} sobol_row;

/* The number of zeros below the lowest one of x > 0. */
static inline unsigned sobol_zeros(uint64_t x)
{
#if defined(__GNUC__)
    return (unsigned)__builtin_ctzll(x);
#else
    unsigned n = 0;
    for (; !(x & 1); x >>= 1)
        n++;
    return n;
#endif
}

/* The step from chunk c - 1 to chunk c. After the last of all comes the first. */
static inline unsigned sobol_step(uint64_t c)
{
    return c << 6 > 0 ? sobol_zeros(c) : SOBOL_STEPS - 1;
}

#define KERNELS "sobol_lanes.h"
#include "levels.h"

/* ---- direction numbers -------------------------------------------------------------------- */

/* Where the table is being read: at a bit, after a polynomial. */
typedef struct sobol_reader {
    size_t bit;
    uint32_t polynomial;
} sobol_reader;

/* The next n < 64 bits of the table. */
static uint32_t sobol_read(sobol_reader *reader, unsigned n)
{
    const size_t word = reader->bit / 64, at = reader->bit % 64;
    uint64_t bits = sobol_table[word] >> at;
    if (at + n > 64)
        bits |= sobol_table[word + 1] << (64 - at);
    reader->bit += n;
    return (uint32_t)(bits & ((UINT64_C(1) << n) - 1));
}

/* The next dimension's polynomial is the reader's; returns its degree. */
static unsigned sobol_read_polynomial(sobol_reader *reader)
{
    unsigned degree = 0;
    reader->polynomial += 2 * sobol_read(reader, 7);
    while (reader->polynomial >> (degree + 1) > 0)
        degree++;
    return degree;
}

/* The direction numbers from V[degree] on follow from those before and the polynomial
 * x^s + a_1 x^(s-1) + ... + 1:  V[k] = a_1 V[k-1] ^ ... ^ V[k-s] ^ V[k-s] 2^-s. */
static void sobol_follow(uint64_t v[SOBOL_BITS], unsigned degree, uint32_t polynomial)
{
    for (unsigned k = degree; k < SOBOL_BITS; k++) {
        v[k] = v[k - degree] >> degree;
        for (unsigned i = 1; i <= degree; i++)
            v[k] ^= v[k - i] & (0 - (uint64_t)(polynomial >> (degree - i) & 1));
    }
}

/* Those of the next dimension. */
static void sobol_read_numbers(uint64_t v[SOBOL_BITS], sobol_reader *reader)
{
    const unsigned degree = sobol_read_polynomial(reader);
    for (unsigned k = 0; k < degree; k++) {
        const uint64_t m = 2 * (uint64_t)sobol_read(reader, k) + 1;
        v[k] = m << (63 - k);
    }
    sobol_follow(v, degree, reader->polynomial);
}

/* Those of a row s, a, m_1, ..., m_s. */
static void sobol_row_numbers(uint64_t v[SOBOL_BITS], const uint32_t *row)
{
    const uint32_t degree = row[0];
    for (uint32_t k = 0; k < degree; k++)
        v[k] = (uint64_t)row[2 + k] << (63 - k);
    sobol_follow(v, degree, UINT32_C(1) << degree | row[1] << 1 | 1);
}

/* Those of dimension 0. */
static void sobol_first_numbers(uint64_t v[SOBOL_BITS])
{
    for (unsigned k = 0; k < SOBOL_BITS; k++)
        v[k] = UINT64_C(1) << (63 - k);
}

static const sobol_reader sobol_start = {0, 1};

/* ---- rows --------------------------------------------------------------------------------- */

/* Chunk c + 1 differs from chunk c in the bits 5 and 6 + z of the Gray code, z the number of zeros
 * below the lowest one of c + 1. */
static void sobol_row_plain(sobol_row *row, const uint64_t v[SOBOL_BITS], uint64_t shift)
{
    uint64_t w = shift;
    for (unsigned k = 0; k < SOBOL_STEPS; k++)
        row->step[k] = v[5] ^ v[6 + k];
    for (unsigned t = 0; t < SOBOL_CHUNK; t++) {
        row->leaf[t] = w;
        w ^= v[sobol_zeros(t + 1)];
    }
    row->key[0] = row->key[1] = 0;
}

/* The product of the random matrix and each direction number, four columns at a time: `sum` has the
 * sums of any of them. Bits below 63 - k of direction number k are zero. */
static void sobol_row_linear(sobol_row *row, const uint64_t v[SOBOL_BITS], const uint64_t *random)
{
    uint64_t product[SOBOL_BITS] = {0}, sum[16] = {0};
    for (unsigned c = 0; c < SOBOL_BITS; c += 4) {
        for (unsigned i = 1; i < 16; i++) {
            const unsigned low = sobol_zeros(i), column = c + 3 - low;
            sum[i] = sum[i & (i - 1)] ^ (UINT64_C(1) << 63 | random[column] >> 1) >> column;
        }
        for (unsigned k = c; k < SOBOL_BITS; k++)
            product[k] ^= sum[v[k] >> (60 - c) & 15];
    }
    sobol_row_plain(row, product, random[SOBOL_SHIFT]);
}

/* The top six bits of every leaf through the tree of `random`, whose node h has the children 2h and
 * 2h + 1; then what the top six bits of steps are to be. */
static void sobol_row_tree(sobol_row *row, const uint64_t v[SOBOL_BITS], const uint64_t *random)
{
    uint64_t scrambled[2 * SOBOL_CHUNK] = {0}, point[SOBOL_CHUNK];
    sobol_row_plain(row, v, 0);
    for (unsigned h = 1; h < SOBOL_CHUNK; h++) {
        const uint64_t flip = random[0] >> h & 1;
        scrambled[2 * h] = 2 * scrambled[h] + flip;
        scrambled[2 * h + 1] = 2 * scrambled[h] + 1 - flip;
    }
    for (unsigned t = 0; t < SOBOL_CHUNK; t++) {
        const uint64_t top = row->leaf[t] >> SOBOL_STEPS;
        point[top] = (uint64_t)t << SOBOL_STEPS;
        row->leaf[t] = scrambled[SOBOL_CHUNK + top] << SOBOL_STEPS;
    }
    for (unsigned k = 0; k < SOBOL_STEPS; k++)
        row->step[k] = (row->step[k] & ~SOBOL_TOP) | point[row->step[k] >> SOBOL_STEPS];
    row->key[0] = random[1];
    row->key[1] = random[2];
}

/* ---- stretches ---------------------------------------------------------------------------- */

/* The word of a chunk: its number's Gray code has a one for each step that leads there. */
static uint64_t sobol_chunk_word(const sobol_row *row, uint64_t chunk)
{
    uint64_t word = 0;
    for (uint64_t left = chunk ^ chunk >> 1; left > 0; left &= left - 1)
        word ^= row->step[sobol_zeros(left)];
    return word;
}

static void sobol_chunks(void *out, size_t n, const sobol_row *row, uint64_t chunk, int what)
{
    LEVELS_RUN(sobol_chunks, (out, n, row, chunk, sobol_chunk_word(row, chunk), what));
}

/* Points first, ..., first + n - 1; chunks that are wanted in part are made aside. */
static void sobol_stretch(void *out, size_t n, const sobol_row *row, uint64_t first, int what)
{
    unsigned char *at = out;
    uint64_t aside[SOBOL_CHUNK];
    while (n > 0) {
        const size_t from = (size_t)(first % SOBOL_CHUNK);
        size_t some = n - n % SOBOL_CHUNK;
        if (from > 0 || some == 0) {
            some = n < SOBOL_CHUNK - from ? n : SOBOL_CHUNK - from;
            sobol_chunks(aside, 1, row, first / SOBOL_CHUNK, what);
            memcpy(at, aside + from, 8 * some);
        } else {
            sobol_chunks(at, some / SOBOL_CHUNK, row, first / SOBOL_CHUNK, what);
        }
        at += 8 * some;
        n -= some;
        first += some;
    }
}

buffon_status buffon_sobol_words(uint64_t *w, size_t n, uint32_t dimension, uint64_t first)
{
    sobol_reader reader = sobol_start;
    uint64_t v[SOBOL_BITS];
    sobol_row row;
    if (w == NULL)
        return BUFFON_E_NULL;
    if (dimension >= BUFFON_SOBOL_DIMENSIONS)
        return BUFFON_E_DIM;
    sobol_first_numbers(v);
    for (uint32_t j = 1; j < dimension; j++) {
        const unsigned degree = sobol_read_polynomial(&reader);
        reader.bit += degree * (degree - 1) / 2;
    }
    if (dimension > 0)
        sobol_read_numbers(v, &reader);
    sobol_row_plain(&row, v, 0);
    sobol_stretch(w, n, &row, first, SOBOL_WORDS);
    return BUFFON_OK;
}

/* ---- the point set ------------------------------------------------------------------------ */

enum { SOBOL_PARAM_SCRAMBLE, SOBOL_PARAM_DIMENSIONS, SOBOL_PARAM_ROWS };

/* Also what refuses a dimension. */
static size_t sobol_table_size(size_t dim, const buffon_points *self)
{
    return dim <= self->param[SOBOL_PARAM_DIMENSIONS] ? dim * sizeof(sobol_row) : SIZE_MAX;
}

static void sobol_scramble(sobol_row *row, const uint64_t v[SOBOL_BITS], uint64_t scramble,
                           const buffon_rng_key *key, uint32_t dimension)
{
    const uint64_t first = (uint64_t)BUFFON_RNG_ROW * key->purpose;
    uint64_t random[SOBOL_RANDOM] = {0};
    buffon_rng_key own = *key;
    own.purpose = BUFFON_PURPOSE_SCRAMBLE;
    if (scramble != BUFFON_SCRAMBLE_NONE)
        buffon_rng_words_at(random, SOBOL_RANDOM, &own, dimension, first);
    if (scramble == BUFFON_SCRAMBLE_OWEN)
        sobol_row_tree(row, v, random);
    else if (scramble == BUFFON_SCRAMBLE_LINEAR)
        sobol_row_linear(row, v, random);
    else
        sobol_row_plain(row, v, random[SOBOL_SHIFT]);
}

static int sobol_prepare(const buffon_points_block *block, const buffon_points *self)
{
    const uint32_t *own = self->data; /* rows of the caller's */
    sobol_reader reader = sobol_start;
    sobol_row *row = block->table;
    uint64_t v[SOBOL_BITS];
    sobol_first_numbers(v);
    for (uint32_t j = 0; j < block->dim; j++) {
        if (j > 0 && own != NULL) {
            sobol_row_numbers(v, own);
            own += 2 + own[0];
        } else if (j > 0) {
            sobol_read_numbers(v, &reader);
        }
        sobol_scramble(&row[j], v, self->param[SOBOL_PARAM_SCRAMBLE], &block->key, j);
    }
    return 0;
}

static int sobol_fill(double *u, const buffon_points_block *block, const buffon_points *self)
{
    const sobol_row *row = block->table;
    const int tree = self->param[SOBOL_PARAM_SCRAMBLE] == BUFFON_SCRAMBLE_OWEN;
    for (size_t j = 0; j < block->dim; j++)
        sobol_stretch(u + j * block->n, block->n, &row[j], block->first,
                      tree ? SOBOL_TREE : SOBOL_UNIFORMS);
    return 0;
}

buffon_points buffon_points_sobol(buffon_scramble scramble)
{
    const int random = scramble != BUFFON_SCRAMBLE_NONE;
    buffon_points points = {.table_size = sobol_table_size,
                            .prepare = sobol_prepare,
                            .doubling = 1,
                            .design = random ? BUFFON_DESIGN_REPLICATES : BUFFON_DESIGN_NONE,
                            .replicates = random ? SOBOL_REPLICATES : 1,
                            .name = "buffon.sobol",
                            .param = {(uint64_t)scramble, BUFFON_SOBOL_DIMENSIONS}};
    if ((unsigned)scramble <= BUFFON_SCRAMBLE_NONE)
        points.fill = sobol_fill; /* without it the points are refused where they are used */
    return points;
}

buffon_points buffon_points_sobol_net(buffon_scramble scramble)
{
    buffon_points points = buffon_points_sobol(scramble);
    points.replicates = 1;
    if (points.design == BUFFON_DESIGN_REPLICATES)
        points.design = BUFFON_DESIGN_NET;
    return points;
}

buffon_points buffon_points_sobol_median(void)
{
    buffon_points points = buffon_points_sobol(BUFFON_SCRAMBLE_LINEAR);
    points.replicates = SOBOL_MEDIAN;
    points.design = BUFFON_DESIGN_MEDIAN;
    return points;
}

/* The length of the row that begins here, of at most `left` numbers; 0 if it is none. */
static size_t sobol_row_length(const uint32_t *row, size_t left)
{
    const uint32_t degree = row[0];
    if (degree == 0 || degree > SOBOL_DEGREE || left < 2 + (size_t)degree ||
        row[1] >> (degree - 1) > 0)
        return 0;
    for (uint32_t k = 0; k < degree; k++) {
        const uint32_t m = row[2 + k];
        if (m % 2 == 0 || (uint64_t)m >> (k + 1) > 0)
            return 0;
    }
    return 2 + (size_t)degree;
}

buffon_points buffon_points_sobol_table(buffon_scramble scramble, const uint32_t *rows,
                                        size_t count)
{
    buffon_points points = buffon_points_sobol(scramble);
    uint64_t dimensions = 1, mix = 0;
    points.data = rows;
    if (rows == NULL)
        points.fill = NULL;
    for (size_t i = 0, length = 0; points.fill != NULL && i < count; i += length) {
        length = sobol_row_length(rows + i, count - i);
        if (length < 2)
            points.fill = NULL;
        for (size_t k = i; k < i + length; k++)
            mix = buffon_priv_mix(mix, rows[k]);
        dimensions++;
    }
    points.param[SOBOL_PARAM_DIMENSIONS] = dimensions;
    points.param[SOBOL_PARAM_ROWS] = mix; /* partial results tell tables apart by this */
    return points;
}
