/* Private. The kernel of inverse_table.c: included by levels.h. */

#if LANES_WIDTH == 2

/* Two lanes that are loaded one by one gain nothing. */
static void LANES(inverse_map_points)(double *x, double *pdf, const double *u, size_t n,
                                      const buffon_inverse_table *table, unsigned bits)
{
    inverse_map_points_scalar(x, pdf, u, n, table, bits);
}

#else

/* The cells of p in the centre, as places of their rows of 8 numbers. A bin names the cell of its
 * lower end and where that ends. Most have one such split at most; where more are, the cells are
 * walked over. */
LANES_INLINE lanes_u LANES(inverse_cell)(lanes_d p, const buffon_inverse_table *table,
                                         unsigned bits)
{
    const double *cells = (const double *)inverse_cells(table);
    const uint64_t *guide = inverse_guide(table);
    const double *split = (const double *)(const void *)(guide + table->bins);
    /* The top bits of the fraction of 1 + u. Rounding may carry into the next bin, whose first cell
     * then is at most 2^-53 away. */
    const lanes_u bin = lanes_bits(p + 1.0) << 12 >> (64 - bits);
    const lanes_u word = lanes_gather_words(guide, bin);
    const lanes_u first = word >> 1 << 3;
    const lanes_m past = lanes_less_equal(lanes_gather(split, bin), p);
    lanes_u at = lanes_bits(lanes_pick(past, lanes_double(first + 8), lanes_double(first)));
    if (lanes_any(lanes_odd(word))) {
        for (;;) {
            const lanes_m more = lanes_less_equal(lanes_gather(cells + 1, at), p);
            if (!lanes_any(more))
                break;
            at = lanes_bits(lanes_pick(more, lanes_double(at + 8), lanes_double(at)));
        }
    }
    return at;
}

/* Points and, unless it is NULL, the pdf. Uniforms of the tails are few and go one by one. */
static void LANES(inverse_map_points)(double *x, double *pdf, const double *u, size_t n,
                                      const buffon_inverse_table *table, unsigned bits)
{
    const double *cells = (const double *)inverse_cells(table);
    const double most = buffon_priv_nextdown(table->u_hi);
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d raw = lanes_load(u + i, n - i);
        const lanes_d p = lanes_min(lanes_max(raw, lanes_all(table->u_lo)), lanes_all(most));
        const lanes_u at = LANES(inverse_cell)(p, table, bits);
        const lanes_d d = lanes_max(p - lanes_gather(cells, at), lanes_all(0));
        const lanes_d c5 = lanes_gather(cells + 7, at), c4 = lanes_gather(cells + 6, at);
        const lanes_d c3 = lanes_gather(cells + 5, at), c2 = lanes_gather(cells + 4, at);
        const lanes_d c1 = lanes_gather(cells + 3, at), c0 = lanes_gather(cells + 2, at);
        lanes_store(x + i, c0 + d * (c1 + d * (c2 + d * (c3 + d * (c4 + d * c5)))), n - i);
        if (pdf != NULL) {
            const lanes_d slope =
                c1 + d * (2.0 * c2 + d * (3.0 * c3 + d * (4.0 * c4 + d * (5.0 * c5))));
            lanes_store(pdf + i, 1.0 / slope, n - i);
        }
        if (!lanes_every(lanes_equal(p, raw)))
            buffon_priv_inverse_tails(x + i, pdf != NULL ? pdf + i : NULL, u + i,
                                      n - i < LANES_WIDTH ? n - i : LANES_WIDTH, table);
    }
}

#endif
