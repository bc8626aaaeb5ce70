/* Private. Batches of the functions of lanes_math.h: included by levels.h. A vector is loaded whole
 * before its result is stored, so results may take the place of arguments.
 */
#ifndef MATH_BATCH
#define MATH_BATCH(name)                                                                           \
    static void LANES(math_##name)(double *y, const double *x, size_t n)                           \
    {                                                                                              \
        for (size_t i = 0; i < n; i += LANES_WIDTH)                                                \
            lanes_store(y + i, LANES(name)(lanes_load(x + i, n - i)), n - i);                      \
    }
#endif

LANES_INLINE lanes_d LANES(sinpi)(lanes_d x)
{
    lanes_d s, c;
    LANES(sincospi)(&s, &c, x);
    return s;
}

LANES_INLINE lanes_d LANES(cospi)(lanes_d x)
{
    lanes_d s, c;
    LANES(sincospi)(&s, &c, x);
    return c;
}

MATH_BATCH(sinpi)
MATH_BATCH(cospi)
MATH_BATCH(log)
MATH_BATCH(log1p)
MATH_BATCH(exp)
MATH_BATCH(expm1)
MATH_BATCH(cbrt)
MATH_BATCH(acospi)
MATH_BATCH(erfc)
MATH_BATCH(normal_cdf)

static void LANES(math_sincospi)(double *s, double *c, const double *x, size_t n)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        lanes_d sine, cosine;
        LANES(sincospi)(&sine, &cosine, lanes_load(x + i, n - i));
        lanes_store(s + i, sine, n - i);
        lanes_store(c + i, cosine, n - i);
    }
}

static void LANES(math_atan2pi)(double *t, const double *y, const double *x, size_t n)
{
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        const lanes_d b = lanes_load(y + i, n - i), a = lanes_load(x + i, n - i);
        lanes_store(t + i, LANES(atan2pi)(b, a), n - i);
    }
}

static void LANES(math_normal_quantile)(double *z, const double *u, size_t n)
{
    LANES(normal_quantiles)(z, u, n);
}
