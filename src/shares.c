#include "guard.h"

#include "shares.h"

#include "elementary.h"
#include "pair.h"

int buffon_priv_shares_scale(buffon_priv_shares *sum, double most)
{
    int e;
    buffon_priv_frexp(&e, most);
    sum->exponent = e < -1000 ? -1000 : e;
    sum->scale = buffon_priv_ldexp(1, -sum->exponent);
    return !(most > 0);
}

double buffon_priv_largest(const double *mass, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) {
        if (!(mass[k] >= 0) || !buffon_priv_isfinite(mass[k]))
            return -1;
        most = mass[k] > most ? mass[k] : most;
    }
    return most;
}

/* total += x 2^64 for x from 0 to 2^62, cut to a whole number, as two words. */
static void shares_add(uint64_t total[2], double x, int minus)
{
    const uint64_t whole = (uint64_t)x, part = (uint64_t)((x - (double)whole) * 0x1p64);
    if (minus) {
        total[1] -= whole + (total[0] < part);
        total[0] -= part;
    } else {
        total[0] += part;
        total[1] += whole + (total[0] < part);
    }
}

/* The largest of the masses whose bits are given, or -1 where one is not usable. */
static double shares_largest(const uint64_t *bits, size_t count)
{
    double most = 0;
    for (size_t k = 0; k < count; k++) {
        const double mass = buffon_priv_from_bits(bits[k]);
        if (!(mass >= 0) || !buffon_priv_isfinite(mass))
            return -1;
        most = mass > most ? mass : most;
    }
    return most;
}

/* The sum S of the scaled masses is kept to 104 bits, and so is 2^62 / S. Then each mass times that
 * is right to 2^-40 of a unit, however many there are, and enters a sum of whole 2^-64 of a unit,
 * which loses less than a unit's 2^-32 in all. So the last sum is 2^62 before it is rounded to
 * units, and as no term is negative, the bounds never fall. A mass of 0 adds nothing at all. */
buffon_status buffon_priv_shares_make(uint64_t *bound, size_t count, buffon_priv_shares *sum)
{
    uint64_t total[2] = {UINT64_C(1) << 63, 0}; /* half a unit: cutting the sum rounds it */
    pair all = {0, 0}, whole = {0x1p62, 0};
    if (buffon_priv_shares_scale(sum, shares_largest(bound + 1, count)))
        return BUFFON_E_SHAPE;
    for (size_t k = 1; k <= count; k++) {
        const double mass = shares_scaled(sum, buffon_priv_from_bits(bound[k]));
        const pair s = pair_sum(all.hi, mass);
        all = pair_sum(s.hi, s.lo + all.lo);
    }
    const pair per = pair_over(whole, all);
    sum->all = all.hi;
    bound[0] = 0;
    for (size_t k = 1; k <= count; k++) {
        const double mass = shares_scaled(sum, buffon_priv_from_bits(bound[k]));
        const pair units = pair_product(mass, per.hi);
        const double rest = units.lo + mass * per.lo;
        shares_add(total, units.hi, 0);
        shares_add(total, buffon_priv_abs(rest), rest < 0);
        bound[k] = total[1];
    }
    return BUFFON_OK;
}

unsigned buffon_priv_guide_bits(size_t count)
{
    unsigned bits = 0;
    while ((size_t)1 << bits < count)
        bits++;
    return bits;
}

void buffon_priv_guide_make(uint32_t *first, unsigned bits, const uint64_t *bound, size_t count)
{
    const size_t cells = (size_t)1 << bits;
    uint32_t k = 0;
    for (size_t j = 0; j < cells; j++) {
        const uint64_t begin = (uint64_t)j << (62 - bits);
        while (bound[k + 1] <= begin)
            k++;
        first[j] = k;
    }
    while (count > 0 && bound[count - 1] == SHARES_WHOLE)
        count--;
    first[cells] = (uint32_t)(count - 1);
}

/* ---- rows and columns --------------------------------------------------------------------- */

/* Row bounds, column bounds, row index, column indices. */
size_t buffon_priv_sheet_size(size_t head, size_t columns, size_t rows)
{
    if (columns < 1 || rows < 1 || columns > SHARES_MOST || rows > SHARES_MOST)
        return SIZE_MAX;
    const size_t across = ((size_t)1 << buffon_priv_guide_bits(columns)) + 1;
    const size_t down = ((size_t)1 << buffon_priv_guide_bits(rows)) + 1;
    size_t size = buffon_priv_table_more(head, rows + 1, sizeof(uint64_t));
    const size_t width = buffon_priv_table_more(0, columns + 1, sizeof(uint64_t));
    const size_t index = buffon_priv_table_more(0, across, sizeof(uint32_t));
    size = buffon_priv_table_more(size, rows, width);
    size = buffon_priv_table_more(size, down, sizeof(uint32_t));
    return buffon_priv_table_more(size, rows, index);
}

buffon_priv_sheet buffon_priv_sheet_of(const buffon_priv_table *table, size_t head)
{
    buffon_priv_sheet sheet = {.columns = (size_t)table->size[0],
                               .rows = (size_t)table->size[1],
                               .column_bits = (unsigned)table->bits[0],
                               .row_bits = (unsigned)table->bits[1]};
    sheet.row = (uint64_t *)((uintptr_t)table + head);
    sheet.column = sheet.row + sheet.rows + 1;
    sheet.row_first = (uint32_t *)(sheet.column + sheet.rows * (sheet.columns + 1));
    sheet.column_first = sheet.row_first + ((size_t)1 << sheet.row_bits) + 1;
    return sheet;
}

#if defined(__GNUC__)
#define SHARES_FETCH(p) __builtin_prefetch(p)
#else
#define SHARES_FETCH(p) ((void)(p))
#endif

void buffon_priv_sheet_find(uint32_t *row, uint32_t *column, const double *u1, const double *u2,
                            size_t n, const buffon_priv_sheet *sheet)
{
    const unsigned shift = 62 - sheet->column_bits;
    double rest;
    for (size_t i = 0; i < n; i++) {
        const uint64_t down = shares_unit(&rest, u2[i]);
        row[i] = (uint32_t)shares_find(sheet->row, sheet->row_first, sheet->row_bits, down);
        SHARES_FETCH(sheet_first(sheet, row[i]) + (shares_unit(&rest, u1[i]) >> shift));
    }
    for (size_t i = 0; i < n; i++) {
        const uint64_t cell = shares_unit(&rest, u1[i]) >> shift;
        SHARES_FETCH(sheet_columns(sheet, row[i]) + sheet_first(sheet, row[i])[cell]);
    }
    for (size_t i = 0; i < n; i++)
        column[i] = (uint32_t)shares_find(sheet_columns(sheet, row[i]), sheet_first(sheet, row[i]),
                                          sheet->column_bits, shares_unit(&rest, u1[i]));
}

/* The mass of a row, which becomes shares. */
static double sheet_row(const buffon_priv_sheet *sheet, size_t row)
{
    buffon_priv_shares sum;
    uint64_t *bound = sheet_columns(sheet, row);
    uint32_t *first = sheet_first(sheet, row);
    if (buffon_priv_shares_make(bound, sheet->columns, &sum) != BUFFON_OK) {
        memset(bound, 0, (sheet->columns + 1) * sizeof *bound);
        memset(first, 0, (((size_t)1 << sheet->column_bits) + 1) * sizeof *first);
        return 0;
    }
    buffon_priv_guide_make(first, sheet->column_bits, bound, sheet->columns);
    return buffon_priv_ldexp(sum.all, sum.exponent);
}

buffon_status buffon_priv_sheet_make(const buffon_priv_sheet *sheet, const double *weight)
{
    buffon_priv_shares sum;
    for (size_t r = 0; r < sheet->rows; r++)
        sheet->row[r + 1] = buffon_priv_bits(sheet_row(sheet, r) * (weight ? weight[r] : 1));
    const buffon_status status = buffon_priv_shares_make(sheet->row, sheet->rows, &sum);
    if (status == BUFFON_OK)
        buffon_priv_guide_make(sheet->row_first, sheet->row_bits, sheet->row, sheet->rows);
    return status;
}
