/* Private. The kernel of ball.c: included by levels.h. */

/* r^3 grows from r0^3 as the volume does. In units of r1^3 it is inner + width u, a sum of
 * positives, and no cube leaves the doubles. The direction is that of sphere_map. */
static void LANES(ball_map)(double *x, double *y, double *z, const double *u, size_t n,
                            const double *param)
{
    const double radius = param[BALL_RADIUS], rim = param[BALL_RIM];
    const double inner = param[BALL_INNER], width = param[BALL_WIDTH];
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d root = LANES(cbrt)(inner + width * lanes_load(u + i, n - i));
        const lanes_d r = radius * lanes_min(lanes_all(rim), root);
        const lanes_d v = lanes_load(u + n + i, n - i), s = 2.0 * lanes_sqrt(v * (1.0 - v)) * r;
        lanes_d cosine, sine;
        LANES(circle)(&cosine, &sine, lanes_load(u + 2 * n + i, n - i));
        lanes_store(x + i, cosine * s, n - i);
        lanes_store(y + i, sine * s, n - i);
        lanes_store(z + i, (1.0 - 2.0 * v) * r, n - i);
    }
}
