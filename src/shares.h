/* Private. Laws by tables: masses as whole numbers of units of 2^-62, an index into their sums, and
 * the block of memory that holds them.
 *
 * Sums of doubles neither end at 1 nor grow by what was asked for. Here the sum of the first k
 * masses, relative to the whole, is bound[k] units, rounded once: bound[count] is 2^62 exactly,
 * nothing is out of reach, and what has no mass has no unit. The generator's uniforms are whole
 * numbers of units too, so finding the piece of one is a comparison of integers.
 */
#ifndef BUFFON_SRC_SHARES_H
#define BUFFON_SRC_SHARES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <buffon/density.h>

/* The units of the whole, and the most pieces that it may be cut into. */
#define SHARES_WHOLE (UINT64_C(1) << 62)
#define SHARES_MOST ((size_t)INT32_MAX)

/* What masses add up to. They are scaled by a power of two to have their largest in [1/2, 1), or
 * from 2^-74 on where all are subnormal or next to that. */
typedef struct buffon_priv_shares {
    double scale; /* a mass times it is scaled */
    double all;   /* the sum of the scaled masses */
    int exponent; /* the sum itself is all 2^exponent */
} buffon_priv_shares;

/* bound[0..count] from the masses, whose bits are in bound[1..count]. BUFFON_E_SHAPE unless all are
 * finite, none negative and one positive. */
buffon_status buffon_priv_shares_make(uint64_t *bound, size_t count, buffon_priv_shares *sum);

/* The largest of them, or -1 unless all are finite and none negative. */
double buffon_priv_largest(const double *mass, size_t count);

/* The scale for a largest mass. Non-zero where nothing is positive. */
int buffon_priv_shares_scale(buffon_priv_shares *sum, double most);

static inline double shares_scaled(const buffon_priv_shares *sum, double mass)
{
    return mass * sum->scale;
}

/* The part of the whole that a mass is, within 2 ulp. */
static inline double shares_of(const buffon_priv_shares *sum, double mass)
{
    return shares_scaled(sum, mass) / sum->all;
}

/* ---- the index ---- */

/* The bits of the index of so many pieces: its cells number from `count` to twice that. */
unsigned buffon_priv_guide_bits(size_t count);

/* first[j] is the piece in which cell j of 2^bits equal cells begins; first[2^bits] is the last
 * that has any units. */
void buffon_priv_guide_make(uint32_t *first, unsigned bits, const uint64_t *bound, size_t count);

/* A uniform in units: a whole number and, for those finer than the generator's, a rest in [0, 1).
 * What is no uniform gives some unit all the same, as tables are read by it. */
static inline uint64_t shares_unit(double *rest, double u)
{
    const double most = 1 - 0x1p-53, above = u > 0 ? u : 0;
    const double t = 0x1p62 * (above < most ? above : most);
    const int64_t unit = (int64_t)t;
    *rest = t - (double)unit;
    return (uint64_t)unit;
}

/* The piece k with bound[k] <= unit < bound[k+1]. Most cells of the index hold less than two
 * bounds, which are passed without a branch; where they crowd, the stretch is halved. */
static inline size_t shares_find(const uint64_t *bound, const uint32_t *first, unsigned bits,
                                 uint64_t unit)
{
    const uint64_t cell = unit >> (62 - bits);
    size_t k = first[cell];
    const size_t last = first[cell + 1];
    if (last - k > 8) {
        for (size_t left = last - k + 1; left > 1;) {
            const size_t half = left / 2;
            k += bound[k + half] <= unit ? half : 0;
            left -= half;
        }
        return k;
    }
    k += bound[k + 1] <= unit;
    k += bound[k + 1] <= unit;
    while (bound[k + 1] <= unit)
        k++;
    return k;
}

/* How far into piece k the unit lies, from 0 to 1; and what is left behind it. Both keep their
 * digits. */
static inline double shares_into(double *left, const uint64_t *bound, size_t k, uint64_t unit,
                                 double rest)
{
    const double per_unit = 1 / (double)(int64_t)(bound[k + 1] - bound[k]);
    *left = ((double)(int64_t)(bound[k + 1] - unit) - rest) * per_unit;
    return ((double)(int64_t)(unit - bound[k]) + rest) * per_unit;
}

/* The way back: the uniform that lies so far into piece k. */
static inline double shares_uniform(const uint64_t *bound, size_t k, double part)
{
    const double units = (double)(int64_t)(bound[k + 1] - bound[k]);
    return 0x1p-62 * ((double)(int64_t)bound[k] + part * units);
}

/* The piece as a part of the whole. */
static inline double shares_mass(const uint64_t *bound, size_t k)
{
    return 0x1p-62 * (double)(int64_t)(bound[k + 1] - bound[k]);
}

/* ---- rows and columns ---- */

/* A grid of masses: the shares of the rows in the whole, and of the columns in each row. A row
 * without mass has bounds that are all 0. */
typedef struct buffon_priv_sheet {
    size_t columns, rows;
    unsigned column_bits, row_bits;
    uint64_t *row, *column; /* bounds: rows + 1; for each row columns + 1 */
    uint32_t *row_first, *column_first;
} buffon_priv_sheet;

static inline uint64_t *sheet_columns(const buffon_priv_sheet *sheet, size_t row)
{
    return sheet->column + row * (sheet->columns + 1);
}

static inline uint32_t *sheet_first(const buffon_priv_sheet *sheet, size_t row)
{
    return sheet->column_first + row * (((size_t)1 << sheet->column_bits) + 1);
}

/* The part of the whole that a cell is. */
static inline double sheet_mass(const buffon_priv_sheet *sheet, size_t row, size_t column)
{
    return shares_mass(sheet->row, row) * shares_mass(sheet_columns(sheet, row), column);
}

/* ---- the block ---- */

typedef enum table_kind {
    TABLE_ALIAS = 1,
    TABLE_GUIDE = 2,
    TABLE_CONSTANT = 3,
    TABLE_LINEAR = 4,
    TABLE_GRID = 5,
    TABLE_ENVIRONMENT = 6,
    TABLE_BILINEAR = 7
} table_kind;

/* What a block begins with. Behind it are arrays whose places follow from it, so that the block may
 * be moved. */
typedef struct buffon_priv_table {
    uint64_t magic;   /* the kind too; reads otherwise where bytes are in another order */
    uint64_t bytes;   /* of the block */
    uint64_t size[2]; /* what its constructor was given: a count, or columns and rows */
    uint64_t bits[2]; /* of the indices */
    uint64_t mix;     /* of all the rest */
    uint64_t spare;
} buffon_priv_table;

/* a + b c, or SIZE_MAX where that is no size. SIZE_MAX as a stays. */
size_t buffon_priv_table_more(size_t a, size_t b, size_t c);

/* Room for a block of `wanted` bytes (SIZE_MAX: there is none): NULL with the reason. */
buffon_priv_table *buffon_priv_table_begin(buffon_status *status, void *memory, size_t size,
                                           size_t wanted, table_kind kind);

/* Closes a block whose sizes, bits and arrays are in place. */
void buffon_priv_table_close(buffon_priv_table *table);

table_kind buffon_priv_table_kind(const buffon_priv_table *table);

/* For the tables of operations. */
uint64_t buffon_priv_table_identity(uint64_t mix, const buffon_density *g);

/* The density of a block of the kind. */
buffon_density buffon_priv_alias_view(const buffon_priv_table *table);
buffon_density buffon_priv_piecewise_view(const buffon_priv_table *table);
buffon_density buffon_priv_bilinear_view(const buffon_priv_table *table);
buffon_density buffon_priv_environment_view(const buffon_priv_table *table);

/* `head` bytes and a sheet behind them: the size of all, and where the sheet is. */
size_t buffon_priv_sheet_size(size_t head, size_t columns, size_t rows);
buffon_priv_sheet buffon_priv_sheet_of(const buffon_priv_table *table, size_t head);

/* The bits of a cell's mass, for a value that is finite and not negative, where
 * buffon_priv_sheet_make looks for it. Values are scaled by powers of two, so that their sums are
 * in range. */
static inline void sheet_put(const buffon_priv_sheet *sheet, size_t row, size_t column, double mass)
{
    memcpy(sheet_columns(sheet, row) + column + 1, &mass, sizeof mass);
}

/* Rows and columns of points whose u1 and u2 are given. In a large table every look is a miss of
 * the caches, so what the next step of all the points reads is fetched before the step is taken. */
void buffon_priv_sheet_find(uint32_t *row, uint32_t *column, const double *u1, const double *u2,
                            size_t n, const buffon_priv_sheet *sheet);

/* Bounds and indices from the masses; that of a row counts `weight[row]` fold, or once where that
 * is NULL. BUFFON_E_SHAPE where all are 0. */
buffon_status buffon_priv_sheet_make(const buffon_priv_sheet *sheet, const double *weight);

static inline buffon_density table_refused(const buffon_density_ops *ops, size_t dim,
                                           size_t uniforms, buffon_status status)
{
    return (buffon_density){.uniforms = uniforms, .dim = dim, .ops = ops, .status = status};
}

#endif
