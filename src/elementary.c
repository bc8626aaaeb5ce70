/* The parts of a double. The functions of a real number are in lanes_math.h and math.c. */
#include "guard.h"

#include "elementary.h"

#define ELEMENTARY_INF buffon_priv_from_bits(UINT64_C(0x7ff0000000000000))

/* 2^k for k in -1022 .. 1023. */
static inline double elementary_power2(int k)
{
    return buffon_priv_from_bits((uint64_t)(k + 1023) << 52);
}

/* Factors that keep the value normal until the last one: a first product that is already subnormal
 * becomes zero whatever it rounded to. */
double buffon_priv_ldexp(double x, int k)
{
    int i;
    for (i = 0; i < 2 && k > 1023; i++) {
        x *= 0x1p1023;
        k -= 1023;
    }
    for (i = 0; i < 2 && k < -1022; i++) {
        x *= 0x1p-969;
        k += 969;
    }
    k = k > 1023 ? 1023 : k;
    return x * elementary_power2(k < -1022 ? -1022 : k);
}

double buffon_priv_frexp(int *k, double x)
{
    const int subnormal = buffon_priv_abs(x) < 0x1p-1022;
    const uint64_t bits = buffon_priv_bits(subnormal ? x * 0x1p54 : x);
    const uint64_t mantissa = bits & UINT64_C(0x800fffffffffffff);
    const int exponent = (int)(bits >> 52 & 0x7ff) - 1022;
    if (x == 0 || !buffon_priv_isfinite(x)) {
        *k = 0;
        return x;
    }
    *k = exponent - (subnormal ? 54 : 0);
    return buffon_priv_from_bits(mantissa | UINT64_C(0x3fe0000000000000));
}

double buffon_priv_nextup(double x)
{
    const uint64_t bits = buffon_priv_bits(x);
    const double next = buffon_priv_from_bits(x < 0 ? bits - 1 : bits + 1);
    const double result = x == 0 ? 0x1p-1074 : next;
    return x < ELEMENTARY_INF ? result : x;
}

double buffon_priv_nextdown(double x)
{
    return -buffon_priv_nextup(-x);
}
