#include "guard.h"

#include "bell.h"

#include <math.h>

#include "elementary.h"

#define BELL_INV_SQRT_2PI 0x1.9884533d43651p-2

/* W = zeta + ...: with H = W^2 / 2 the equation is H' = zeta (1 + c W - 2 v H). Then f = zeta / W.
 * Series converge up to the next point of the complex plane where W = 0 again: |zeta| = 2 sqrt(pi)
 * for the gamma law, farther for the beta law, sqrt(2 pi) for Student's. */
static void bell_shape(double *f, double c, double v, int terms)
{
    double w[BELL_TERMS + 2] = {0, 1}, h[BELL_TERMS + 3] = {0, 0, 0.5};
    f[0] = 1;
    for (int k = 2; k <= terms + 1; k++) {
        double sum = k % 2 ? 0.5 * w[(k + 1) / 2] * w[(k + 1) / 2] : 0, next = 0;
        h[k + 1] = (c * w[k - 1] - 2 * v * h[k - 1]) * (1.0 / (k + 1));
        for (int j = 2; 2 * j < k + 1; j++)
            sum += w[j] * w[k + 1 - j];
        w[k] = h[k + 1] - sum;
        for (int j = k; j >= 2; j--)
            next += w[j] * f[k - j];
        f[k - 1] = -next;
    }
}

/* Terms that a zeta needs: they fall by 2.5 / |zeta| at least. */
static int bell_terms(double zeta)
{
    const double size = buffon_priv_abs(zeta);
    if (size < 0.125)
        return size < 0.015625 ? 8 : size < 0.0625 ? 10 : 13;
    return size < 0.25 ? 16 : size < 0.4 ? 20 : BELL_TERMS;
}

/* The coefficients of s need some more of f, fewer as n grows. */
void buffon_priv_bell_make(buffon_priv_bell *bell, double c, double v, double n, double log_gain,
                           double r, double most)
{
    const double gain = buffon_priv_exp(log_gain), step = 1 / n;
    const int needed = bell_terms(most) + (n < 1000 ? 6 : n < 100000 ? 2 : 0);
    const int terms = needed < BELL_TERMS ? needed : BELL_TERMS;
    double *s = bell->s;
    bell->n = n;
    bell->root = sqrt(n);
    bell->gain = gain;
    bell->reach = buffon_priv_bell_reach(r);
    bell_shape(bell->f, c, v, terms);
    for (int k = terms; k > 0; k--)
        s[k - 1] = gain * bell->f[k] + (k + 1 < terms ? (k + 1) * step * s[k + 1] : 0);
}

double buffon_priv_bell_reach(double r)
{
    return 1 / sqrt(r);
}

static double bell_series(const double *c, double zeta, int terms)
{
    double sum = 0;
    for (int k = terms - 1; k >= 0; k--)
        sum = c[k] + zeta * sum;
    return sum;
}

/* Both series, side by side. */
static void bell_both(double *f, double *s, const buffon_priv_bell *bell, double zeta)
{
    double f_sum = 0, s_sum = 0;
    for (int k = bell_terms(zeta) - 1; k >= 0; k--) {
        f_sum = bell->f[k] + zeta * f_sum;
        s_sum = bell->s[k] + zeta * s_sum;
    }
    *f = f_sum;
    *s = s_sum;
}

double buffon_priv_bell_distance(const buffon_priv_bell *bell, double zeta)
{
    return zeta / bell_series(bell->f, zeta, bell_terms(zeta));
}

double buffon_priv_bell_tail(const buffon_priv_bell *bell, double zeta, int upper)
{
    const double w = zeta * bell->root;
    const double s = bell_series(bell->s, zeta, bell_terms(zeta)) / bell->root;
    const double rest = BELL_INV_SQRT_2PI * buffon_priv_exp(-0.5 * w * w) * s;
    return upper ? buffon_priv_normal_cdf(-w) + rest : buffon_priv_normal_cdf(w) - rest;
}

/* (Phi(w) - Phi(w - h)) / phi(w), the integral of exp(w s - s^2 / 2) over s from 0 to h, whose
 * series is that of the Hermite polynomials: k a[k] = w h a[k-1] - h^2 a[k-2]. |w h| < 1/2. */
static double bell_between(double w, double h)
{
    static const double inverse[] = {1,       1.0 / 2,  1.0 / 3,  1.0 / 4,  1.0 / 5,
                                     1.0 / 6, 1.0 / 7,  1.0 / 8,  1.0 / 9,  1.0 / 10,
                                     1. / 11, 1.0 / 12, 1.0 / 13, 1.0 / 14, 1.0 / 15};
    const double wh = w * h, hh = h * h;
    double before = 1, at = wh, sum = 1 + 0.5 * wh;
    for (int k = 2; k < 15; k++) {
        const double next = inverse[k - 1] * (wh * at - hh * before);
        before = at;
        at = next;
        sum += at * inverse[k];
        if (buffon_priv_abs(at) + buffon_priv_abs(before) < 0x1p-56)
            break;
    }
    return h * sum;
}

/* The root w of K = (Phi(w) - Phi(z)) / phi(w) - S / sqrt(n), where K' = G f + w K: steps of
 * Halley's, cubically convergent. They start at the first terms of the Cornish-Fisher series. */
double buffon_priv_bell_quantile(const buffon_priv_bell *bell, double z)
{
    const double r = 1 / bell->root, *s = bell->s;
    const double start = z * r, first = (s[0] + start * (s[1] + start * s[2])) * r;
    double w = z + first * (1 - 0.5 * z * first + (s[1] + 2 * start * s[2]) * r * r);
    for (int i = 0; i < 8; i++) {
        const double zeta = w * r;
        double k, f, rest, bend;
        if (!(buffon_priv_abs(zeta) <= bell->reach))
            return (double)NAN;
        bell_both(&f, &rest, bell, zeta);
        k = bell_between(w, w - z) - rest * r;
        k /= bell->gain * f;
        bend = 0.5 * (w - (bell->f[1] + 2 * zeta * bell->f[2]) * r / f);
        w -= k / (1 + bend * k);
        if (buffon_priv_abs(k) * (1 + buffon_priv_abs(w)) < 1e-5)
            break;
    }
    return w * r;
}
