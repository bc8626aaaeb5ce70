/* Private. The kernel of inverse_table.c: included by levels.h. */

/* The rows of u[m], as places among the numbers of the cells. */
static inline void LANES(inverse_find)(uint64_t *at, const double *u, size_t m,
                                       const buffon_inverse_table *table, unsigned bits)
{
    const double *guide = inverse_guide(table);
    /* The top bits of the fraction of 1 + u. Rounding may carry into the next bin, whose first cell
     * then is at most 2^-53 away. */
    for (size_t i = 0; i < m; i += LANES_WIDTH) {
        const lanes_d p = lanes_load(u + i, m - i);
        const lanes_u bin = lanes_bits(p + 1.0) << 12 >> (64 - bits) << 1;
        memcpy(at + i, &bin, sizeof bin);
    }
    for (size_t i = 0; i < m; i += LANES_WIDTH) {
        lanes_d first, split;
        lanes_pairs(&first, &split, guide, at + i);
        const lanes_d next = lanes_double(lanes_bits(first) + 8);
        const lanes_m past = lanes_less_equal(split, lanes_load(u + i, m - i));
        const lanes_d row = lanes_pick(past, next, first);
        memcpy(at + i, &row, sizeof row);
    }
}

/* Points and the pdf by these rows. Lists the vectors with uniforms that are beyond their row, and
 * says how many there are. */
static inline size_t LANES(inverse_evaluate)(double *x, double *pdf, size_t *rest, const double *u,
                                             const uint64_t *at, size_t m, const double *cells)
{
    size_t count = 0;
    for (size_t i = 0; i < m; i += LANES_WIDTH) {
        lanes_d from, to, c0, c1, c2, c3, c4, c5;
        lanes_pairs(&from, &to, cells, at + i);
        lanes_pairs(&c0, &c1, cells + 2, at + i);
        lanes_pairs(&c2, &c3, cells + 4, at + i);
        lanes_pairs(&c4, &c5, cells + 6, at + i);
        const lanes_d p = lanes_load(u + i, m - i);
        const lanes_d d = lanes_max(p - from, lanes_all(0));
        lanes_store(x + i, c0 + d * (c1 + d * (c2 + d * (c3 + d * (c4 + d * c5)))), m - i);
        if (pdf != NULL) {
            const lanes_d slope =
                c1 + d * (2.0 * c2 + d * (3.0 * c3 + d * (4.0 * c4 + d * (5.0 * c5))));
            lanes_store(pdf + i, 1.0 / slope, m - i);
        }
        rest[count] = i;
        count += (size_t)!lanes_every(lanes_and(lanes_less_equal(from, p), lanes_less(p, to)));
    }
    return count;
}

/* Points and, unless it is NULL, the pdf. Uniforms of the tails, and of bins with more than one
 * split, are few and go one by one: their vectors are listed, as a branch on each would be guessed
 * wrongly. */
static void LANES(inverse_map_points)(double *x, double *pdf, const double *u, size_t n,
                                      const buffon_inverse_table *table, unsigned bits)
{
    uint64_t at[INVERSE_TILE];
    size_t rest[INVERSE_TILE];
    for (size_t start = 0; start < n; start += INVERSE_TILE) {
        const size_t m = n - start < INVERSE_TILE ? n - start : INVERSE_TILE;
        LANES(inverse_find)(at, u, m, table, bits);
        const size_t count =
            LANES(inverse_evaluate)(x, pdf, rest, u, at, m, (const double *)inverse_cells(table));
        for (size_t k = 0; k < count; k++) {
            const size_t i = rest[k], left = m - i < LANES_WIDTH ? m - i : LANES_WIDTH;
            inverse_mend(x + i, pdf != NULL ? pdf + i : NULL, u + i, at + i, left, table);
        }
        x += m;
        u += m;
        pdf = pdf != NULL ? pdf + m : NULL;
    }
}
