/* Private. The kernel of sphere.c: included by levels.h. */

/* 1 - z^2 = 4 u (1 - u): a product of positives, where 1 - z * z would cancel at the poles. */
static void LANES(sphere_map)(double *x, double *y, double *z, const double *u1, const double *u2,
                              size_t n)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), s = 2.0 * lanes_sqrt(u * (1.0 - u));
        lanes_d cosine, sine;
        LANES(circle)(&cosine, &sine, lanes_load(u2 + i, n - i));
        lanes_store(x + i, cosine * s, n - i);
        lanes_store(y + i, sine * s, n - i);
        lanes_store(z + i, 1.0 - 2.0 * u, n - i);
    }
}

/* log(1 - u) as log1p of lanes_math.h, without what only numbers further from 1 need. */
LANES_INLINE lanes_d LANES(sphere_log)(lanes_d u)
{
    const lanes_d zero = lanes_all(0);
    lanes_d m, k;
    k = LANES(log_split)(&m, 1.0 - u);
    return LANES(log_core)(k, lanes_pick(lanes_equal(k, zero), -u, m - 1.0), zero);
}

/* exp(t) and 1 - exp(t) for -40 < t <= 0, by what exp and expm1 of lanes_math.h have in common. */
LANES_INLINE void LANES(sphere_split)(lanes_d *keep, lanes_d *share, lanes_d t)
{
    lanes_d r;
    lanes_u k;
    const lanes_d low = LANES(exp_core)(&r, &k, t, lanes_all(0)), power = LANES(power2)(k);
    *keep = (1.0 + (r + low)) * power;
    *share = ((LANES(power2)(0 - k) - 1.0 - r) - low) * power;
}

/* See sphere_priv.h for this and the next. */
static void LANES(sphere_pair)(double *x, double *y, double *rest, const double *u1,
                               const double *u2, size_t n, double power)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d u = lanes_load(u1 + i, n - i), left = lanes_load(rest + i, n - i);
        lanes_d share = u, keep = 1.0 - u, cosine, sine;
        if (power < 1)
            LANES(sphere_split)(&keep, &share, power * LANES(sphere_log)(u));
        const lanes_d size = lanes_sqrt(left * share);
        LANES(circle)(&cosine, &sine, lanes_load(u2 + i, n - i));
        lanes_store(rest + i, left * keep, n - i);
        lanes_store(x + i, size * cosine, n - i);
        lanes_store(y + i, size * sine, n - i);
    }
}

static void LANES(sphere_circle)(double *x, double *y, const double *square, const double *turn,
                                 size_t n)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d size = lanes_sqrt(lanes_load(square + i, n - i));
        lanes_d cosine, sine;
        LANES(circle)(&cosine, &sine, lanes_load(turn + i, n - i));
        lanes_store(x + i, size * cosine, n - i);
        lanes_store(y + i, size * sine, n - i);
    }
}
