/* Private. The kernels of moments.c: included by levels.h.
 *
 * The 16 lanes of a sum are taken two vectors at a time, each pair through all the rows: what a
 * pair gathers stays in registers. */

/* Whole rows about the number m, from fresh sums r and q; min and max are widened. */
static void LANES(moments_rows)(double *r, double *q, double *min, double *max, const double *y,
                                size_t rows, double m)
{
    for (size_t lane = 0; lane < MOMENTS_LANES; lane += LANES_WIDTH) {
        lanes_d sum = lanes_all(0), square = lanes_all(0);
        lanes_d least = lanes_load(min + lane, LANES_WIDTH);
        lanes_d most = lanes_load(max + lane, LANES_WIDTH);
        for (size_t i = 0; i < rows; i++) {
            const double *row = y + i * MOMENTS_ROW + lane;
            lanes_d a = lanes_load(row, LANES_WIDTH);
            lanes_d b = lanes_load(row + MOMENTS_LANES, LANES_WIDTH);
            lanes_d c = lanes_load(row + 2 * MOMENTS_LANES, LANES_WIDTH);
            lanes_d d = lanes_load(row + 3 * MOMENTS_LANES, LANES_WIDTH);
            least = lanes_min(least, lanes_min(lanes_min(a, b), lanes_min(c, d)));
            most = lanes_max(most, lanes_max(lanes_max(a, b), lanes_max(c, d)));
            a -= m;
            b -= m;
            c -= m;
            d -= m;
            sum += (a + b) + (c + d);
            square += (a * a + b * b) + (c * c + d * d);
        }
        lanes_store(r + lane, sum, LANES_WIDTH);
        lanes_store(q + lane, square, LANES_WIDTH);
        lanes_store(min + lane, least, LANES_WIDTH);
        lanes_store(max + lane, most, LANES_WIDTH);
    }
}

/* Sums of (a - ma)(b - mb), from fresh ones. */
static void LANES(moments_cross_rows)(double *q, const double *a, const double *b, size_t rows,
                                      double ma, double mb)
{
    for (size_t lane = 0; lane < MOMENTS_LANES; lane += LANES_WIDTH) {
        lanes_d sum = lanes_all(0);
        for (size_t i = 0; i < rows; i++) {
            const double *x = a + i * MOMENTS_ROW + lane, *y = b + i * MOMENTS_ROW + lane;
            lanes_d p[4];
            for (size_t k = 0; k < 4; k++)
                p[k] = (lanes_load(x + k * MOMENTS_LANES, LANES_WIDTH) - ma) *
                       (lanes_load(y + k * MOMENTS_LANES, LANES_WIDTH) - mb);
            sum += (p[0] + p[1]) + (p[2] + p[3]);
        }
        lanes_store(q + lane, sum, LANES_WIDTH);
    }
}
