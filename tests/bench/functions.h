/* Elementary functions of 1024 arguments, against loops that call the C library. */
#ifndef TESTS_BENCH_FUNCTIONS_H
#define TESTS_BENCH_FUNCTIONS_H

#include "samplers.h"

/* Arguments a and b; values go to buffer and points. */
static _Alignas(64) double args_a[TILE], args_b[TILE];

/* Each makes TILE values. */
#define BATCH(name, ...)                                                                           \
    static double name(size_t items)                                                               \
    {                                                                                              \
        TILES(__VA_ARGS__);                                                                        \
        return buffer[1] + points[1];                                                              \
    }
#define FUNCTION(name, kernel, libm)                                                               \
    BATCH(ours_##name, kernel)                                                                     \
    BATCH(libm_##name, for (size_t k = 0; k < TILE; k++) libm)
#define OF_ONE(name, function)                                                                     \
    FUNCTION(name, buffon_math_##name(buffer, args_a, TILE), buffer[k] = function(args_a[k]))

FUNCTION(sincospi, buffon_math_sincospi(buffer, points, args_a, TILE), {
    buffer[k] = sin(PLAIN_PI * args_a[k]);
    points[k] = cos(PLAIN_PI * args_a[k]);
})
FUNCTION(atan2pi, buffon_math_atan2pi(buffer, args_a, args_b, TILE),
         buffer[k] = atan2(args_a[k], args_b[k]))
FUNCTION(normal_cdf, buffon_math_normal_cdf(buffer, args_a, TILE),
         buffer[k] = 0.5 * erfc(-0.70710678118654752440 * args_a[k]))
OF_ONE(log, log)
OF_ONE(log1p, log1p)
OF_ONE(exp, exp)
OF_ONE(expm1, expm1)
OF_ONE(cbrt, cbrt)
OF_ONE(acospi, acos)
OF_ONE(erfc, erfc)
BATCH(ours_normal_quantile, buffon_math_normal_quantile(buffer, args_a, TILE))
#ifdef BENCH_GSL
BATCH(gsl_quantile, for (size_t k = 0; k < TILE; k++) buffer[k] = gsl_cdf_ugaussian_Pinv(args_a[k]))
#else
#define gsl_quantile NULL
#endif

/* Arguments spread evenly from `low` to `high`. */
static void function_group(const char *title, bench_work *ours, const char *peer, bench_work *libm,
                           double low, double high)
{
    const buffon_rng_key key = {.seed = 2};
    const bench_peer peers[] = {{peer, libm, {0}}};
    buffon_rng_uniforms_at(args_a, TILE, &key, 0, 0);
    buffon_rng_uniforms_at(args_b, TILE, &key, 1, 0);
    for (size_t k = 0; k < TILE; k++) {
        args_a[k] = low + (high - low) * args_a[k];
        args_b[k] = low + (high - low) * args_b[k];
    }
    bench_group(title, ours, peers, 1);
}

static void bench_functions(void)
{
    bench_header("ns per element");
    function_group("sincospi, -1 to 1", ours_sincospi, "libm sin and cos", libm_sincospi, -1, 1);
    function_group("log, 0 to 1", ours_log, "libm log", libm_log, 0, 1);
    function_group("log1p, -1 to 1", ours_log1p, "libm log1p", libm_log1p, -1, 1);
    function_group("exp, -10 to 10", ours_exp, "libm exp", libm_exp, -10, 10);
    function_group("expm1, -1 to 1", ours_expm1, "libm expm1", libm_expm1, -1, 1);
    function_group("cbrt, 0 to 100", ours_cbrt, "libm cbrt", libm_cbrt, 0, 100);
    function_group("atan2pi, -1 to 1", ours_atan2pi, "libm atan2", libm_atan2pi, -1, 1);
    function_group("acospi, -1 to 1", ours_acospi, "libm acos", libm_acospi, -1, 1);
    function_group("erfc, -2 to 6", ours_erfc, "libm erfc", libm_erfc, -2, 6);
    function_group("normal cdf, -6 to 6", ours_normal_cdf, "libm erfc", libm_normal_cdf, -6, 6);
    function_group("normal quantile, 0 to 1", ours_normal_quantile, "GSL gsl_cdf_ugaussian_Pinv",
                   gsl_quantile, 0, 1);
}

#endif
