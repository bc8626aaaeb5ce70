/* Private. The kernel of inverse_table.c: included by levels.h. */

/* Points and, unless it is NULL, the pdf, from uniforms clamped to the centre of a table: `cells`
 * are its rows, 8 numbers each, and bin k of 2^-shift (0, 1) begins in the cell guide[k]. */
static void LANES(inverse_map_centre)(double *x, double *pdf, const double *u, size_t n,
                                      const double *cells, const uint64_t *guide, unsigned bits,
                                      double u_lo, double u_hi)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d raw = lanes_load(u + i, n - i);
        const lanes_d p = lanes_min(lanes_max(raw, lanes_all(u_lo)), lanes_all(u_hi));
        /* The top bits of the fraction of 1 + u. Rounding may carry into the next bin, whose first
         * cell then is at most 2^-53 away. */
        const lanes_u bin = lanes_bits(p + 1.0) << 12 >> (64 - bits);
        lanes_u at = lanes_gather_words(guide, bin) << 3;
        for (;;) {
            const lanes_m past = lanes_less_equal(lanes_gather(cells + 1, at), p);
            const lanes_u next =
                lanes_bits(lanes_pick(past, lanes_double(at + 8), lanes_double(at)));
            if (!lanes_any(past))
                break;
            at = next;
        }
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
    }
}
