#include "guard.h"

#include "special.h"

#include "elementary.h"

#define SPECIAL_LOG_SQRT_2PI 0x1.d67f1c864beb5p-1

/* log Gamma(2 + b) = b (1 - gamma) + the sum over k > 1 of (-b)^k (zeta(k) - 1) / k, which falls by
 * 4 a term for |b| <= 1/2. M. Abramowitz, I. Stegun (1964), 6.1.33. */
static double special_lgamma2p(double b)
{
    static const double c[] = {
        0x1.b0ee6072093cep-2,   0x1.4a34cc4a60fa6p-2,   -0x1.13e001a557607p-4,
        0x1.51322ac7d8483p-6,   -0x1.e404fc218f5f2p-8,  0x1.7add6eadb6c30p-9,
        -0x1.38ac5c2bf8e08p-10, 0x1.0b36af86396e9p-11,  -0x1.d3fd4c76d2fc8p-13,
        0x1.a127b0f17d65ap-14,  -0x1.78de5bd7c81efp-15, 0x1.580dcee66eb02p-16,
        -0x1.3cbc963ce2243p-17, 0x1.2597a39f34aacp-18,  -0x1.11b2eb7679541p-19,
        0x1.0064cdeb22f0fp-20,  -0x1.e2600d93cfd2fp-22, 0x1.c76bbb3f07a4dp-23,
        -0x1.af5a6cbbf8a97p-24, 0x1.99b93c2070b0fp-25,  -0x1.862c734df3eacp-26,
        0x1.7469daccfadcdp-27,  -0x1.6434a8447aeadp-28, 0x1.555a877ffd2c3p-29};
    double sum = 0;
    for (int k = (int)(sizeof c / sizeof *c) - 1; k >= 0; k--)
        sum = c[k] + b * sum;
    return b * sum;
}

double buffon_priv_lgamma1p(double a)
{
    return a <= 0.5 ? special_lgamma2p(a) - buffon_priv_log1p(a) : special_lgamma2p(a - 1);
}

/* 1 / 3 + w / 5 + w^2 / 7 + ..., which is (atanh(r) - r) / r^3 for w = r^2: `terms` leave
 * w^terms / 30. */
static double special_atanh(double w, int terms)
{
    static const double c[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                               1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21,
                               1.0 / 23, 1.0 / 25, 1.0 / 27, 1.0 / 29};
    double sum = 0;
    for (int k = terms - 1; k >= 0; k--)
        sum = c[k] + w * sum;
    return sum;
}

/* d(z) - d(z + 1) = (z + 1/2) log(1 + 1/z) - 1 = r^2 / 3 + r^4 / 5 + ..., r = 1 / (2 z + 1), for
 * z >= 1.5. */
static double special_stirling_step(double z)
{
    const double r = 1 / (2 * z + 1), w = r * r;
    return w * special_atanh(w, z < 3 ? 13 : 10);
}

/* Stirling's series from 12 up, where six terms leave 1e-16; below by steps, or from
 * log Gamma(z) = log Gamma(1 + z) - log z. */
double buffon_priv_stirling(double z)
{
    double sum = 0, r, w;
    if (z < 1.5)
        return buffon_priv_lgamma1p(z) - (z + 0.5) * buffon_priv_log(z) +
               (z - SPECIAL_LOG_SQRT_2PI);
    for (; z < 12; z += 1)
        sum += special_stirling_step(z);
    r = 1 / z;
    w = r * r;
    return sum + r * (0x1.5555555555555p-4 +
                      w * (-0x1.6c16c16c16c17p-9 +
                           w * (0x1.a01a01a01a01ap-11 +
                                w * (-0x1.3813813813814p-11 +
                                     w * (0x1.b951e2b18ff23p-11 + w * -0x1.f6ab0d9993c7dp-10)))));
}

/* With r = d / (2 + d), log(1 + d) = 2 (r + r^3 / 3 + ...) and d - 2 r = r d, for r^2 <= 1/16;
 * elsewhere at most four bits cancel. */
double buffon_priv_deviance(double d)
{
    const double r = d / (2 + d), w = r * r;
    if (!(d >= -0.4 && d <= 0.6))
        return d - buffon_priv_log1p(d);
    return r * (d - 2 * w * special_atanh(w, w < 0x1p-10 ? 5 : 14));
}
