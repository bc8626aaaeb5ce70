#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/directional.h>
#include <buffon/math.h>

#include "density_priv.h"
#include "elementary.h"

/* The law of von Mises is solved for |x - mean| = 2 pi h, where h runs from 0 to 1/2 and the
 * density is proportional to f(h) = exp(-2 kappa sin^2(pi h)). The integral of f over all turns is
 * I = exp(-kappa) I0(kappa), I0 Bessel's function. Points nearer to the mean than the quartiles
 * (`inner`) are measured from the mean, the others from the far end: either share is a sum of
 * positives. In `param`: the mean, kappa, I, the quartile's h about, the density at the mean, and
 * the largest |x - mean| that counts as inside. */
enum { MISES_MEAN, MISES_KAPPA, MISES_BESSEL, MISES_QUARTILE, MISES_TOP, MISES_REACH };

enum { MISES_FINE = 28, MISES_ROUGH = 10, MISES_TILE = 64, MISES_STEPS = 20 };

#define MISES_PI 0x1.921fb54442d18p+1

/* Gauss's rules on (0, 1). */
static const double mises_fine_node[MISES_FINE] = {
    0x1.d249f9268e8c0p-10, 0x1.3254355155250p-7, 0x1.76b53db96a48cp-6, 0x1.59912f0821f27p-5,
    0x1.12a6f0ed8947dp-4,  0x1.8e0be59cd9503p-4, 0x1.0ebc05a165ff2p-3, 0x1.5f96db08e1bedp-3,
    0x1.b89b3256d5570p-3,  0x1.0c5a36ad9de94p-2, 0x1.3f5bf616a76b2p-2, 0x1.74b4569d9eea3p-2,
    0x1.abbd93369f329p-2,  0x1.e3cca5b685b7fp-2, 0x1.0e19ad24bd240p-1, 0x1.2a213664b066cp-1,
    0x1.45a5d4b1308afp-1,  0x1.605204f4ac4a7p-1, 0x1.79d2e4a9310b6p-1, 0x1.91d9336a4aaa4p-1,
    0x1.a81a493dc7905p-1,  0x1.bc50fe97a6803p-1, 0x1.ce3e834c64d60p-1, 0x1.ddab21e24ed70p-1,
    0x1.ea66ed0f7de0ep-1,  0x1.f44a561234adcp-1, 0x1.fb36af2abaab7p-1, 0x1.ff16db036cb8cp-1,
};
static const double mises_fine_weight[MISES_FINE] = {
    0x1.2afc07ab1c5c9p-8, 0x1.5a3a811ece501p-7, 0x1.0d874b8a226e9p-6, 0x1.6aaf12dc69637p-6,
    0x1.c3707aee4a4e2p-6, 0x1.0b5b9f1c0a7a2p-5, 0x1.31c03a8e85de3p-5, 0x1.546ebc0db6001p-5,
    0x1.72fb5b81c1868p-5, 0x1.8d0729614b3e3p-5, 0x1.a2413503ecaa0p-5, 0x1.b26787e30dbfbp-5,
    0x1.bd47f277562fdp-5, 0x1.c2c0a81eda19dp-5, 0x1.c2c0a81eda19dp-5, 0x1.bd47f277562fdp-5,
    0x1.b26787e30dbfbp-5, 0x1.a2413503ecaa0p-5, 0x1.8d0729614b3e3p-5, 0x1.72fb5b81c1868p-5,
    0x1.546ebc0db6001p-5, 0x1.31c03a8e85de3p-5, 0x1.0b5b9f1c0a7a2p-5, 0x1.c3707aee4a4e2p-6,
    0x1.6aaf12dc69637p-6, 0x1.0d874b8a226e9p-6, 0x1.5a3a811ece501p-7, 0x1.2afc07ab1c5c9p-8,
};

static const double mises_rough_node[MISES_ROUGH] = {
    0x1.ab83f3aa1a507p-7, 0x1.1459a858d3435p-4, 0x1.4848dbae43cd1p-3, 0x1.2219ffb7f4a92p-2,
    0x1.b3c6be1db8762p-2, 0x1.261ca0f123c4fp-1, 0x1.6ef3002405ab7p-1, 0x1.adedc9146f0ccp-1,
    0x1.dd74caf4e5979p-1, 0x1.f951f0315796cp-1,
};
static const double mises_rough_weight[MISES_ROUGH] = {
    0x1.1115f8b62dc1fp-5, 0x1.32138c878efe5p-4, 0x1.c0b059d00bc31p-4, 0x1.13baa7a559bfep-3,
    0x1.2e9de7014d6efp-3, 0x1.2e9de7014d6efp-3, 0x1.13baa7a559bfep-3, 0x1.c0b059d00bc31p-4,
    0x1.32138c878efe5p-4, 0x1.1115f8b62dc1fp-5,
};

/* The integrals of f(t) / f(h) over `length` from `from`, where `square` is sin^2(pi h). */
static void mises_integrate(double *mass, const double *from, const double *length,
                            const double *square, size_t n, double kappa, int fine)
{
    const double *node = fine ? mises_fine_node : mises_rough_node;
    const double *weight = fine ? mises_fine_weight : mises_rough_weight;
    const size_t nodes = fine ? MISES_FINE : MISES_ROUGH;
    double t[MISES_FINE * MISES_TILE];
    for (size_t k = 0; k < nodes; k++)
        for (size_t i = 0; i < n; i++)
            t[k * n + i] = from[i] + length[i] * node[k];
    buffon_math_sinpi(t, t, nodes * n);
    for (size_t k = 0; k < nodes; k++)
        for (size_t i = 0; i < n; i++)
            t[k * n + i] = -2 * kappa * (t[k * n + i] * t[k * n + i] - square[i]);
    buffon_math_exp(t, t, nodes * n);
    for (size_t i = 0; i < n; i++) {
        double sum = 0;
        for (size_t k = 0; k < nodes; k++)
            sum += weight[k] * t[k * n + i];
        mass[i] = sum * length[i];
    }
}

/* The integral of f on h's side, over f(h): from 0 to h for inner points, over which f changes
 * little, so that the rough rule is exact; else from h to 1/2, or to where f has fallen by
 * exp(-37), with the rough rule exp(-14). */
static void mises_mass(double *mass, const double *h, const double *square, int inner, int fine,
                       size_t n, double kappa)
{
    double length[MISES_TILE], s[MISES_TILE] = {0}, c[MISES_TILE] = {0};
    if (inner) {
        mises_integrate(mass, s, h, square, n, kappa, 0);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        const double end = square[i] + (fine ? 18.5 : 7) / kappa;
        s[i] = end < 1 ? sqrt(end) : 1;
        c[i] = end < 1 ? sqrt(1 - end) : 0;
    }
    buffon_math_atan2pi(length, s, c, n);
    for (size_t i = 0; i < n; i++)
        length[i] -= h[i];
    mises_integrate(mass, h, length, square, n, kappa, fine);
}

/* About the h beyond which lies the share p < 1/2 of one side. The normal law with the density's
 * peak, in sin(pi h), is near for large kappa; the Cauchy law with that peak, wrapped around the
 * circle, for small; both are too wide where they are bad, so the lesser is never far off. */
static void mises_guess(double *h, const double *p, size_t n, double bessel)
{
    double s[MISES_TILE], c[MISES_TILE], z[MISES_TILE];
    buffon_math_normal_quantile(z, p, n);
    buffon_math_sincospi(c, s, p, n);
    for (size_t i = 0; i < n; i++) {
        const double normal = -0x1.40d931ff62705p+0 * bessel * z[i]; /* sqrt(pi / 2) */
        const double sine = normal < 1 ? normal : 1, cosine = sqrt((1 - sine) * (1 + sine));
        const double cauchy = bessel * s[i];
        const int near = sine * c[i] < cauchy * cosine;
        s[i] = near ? sine : cauchy;
        c[i] = near ? cosine : c[i];
    }
    buffon_math_atan2pi(h, s, c, n);
}

/* Those still sought, all of them inner points or none. */
typedef struct mises_search {
    double h[MISES_TILE], share[MISES_TILE];
    size_t place[MISES_TILE], count;
    int inner;
} mises_search;

/* One step for all that are still sought; says which are found if it was `fine`. With m the mass
 * missing over f(h), and -log f(h + d) + log f(h) = a d + b d^2 / 2 + ..., the step is
 * d = m + a m^2 / 2 + (2 a^2 + b) m^3 / 6 + ...; its powers of a alone are those of
 * -log(1 - a m) / a, here a fraction that agrees to that order. What is left is of the order of
 * m (a m)^3, nothing once m is 1e-5 of the law's width. */
static void mises_step(int *found, mises_search *at, int fine, double kappa, double bessel)
{
    double s[MISES_TILE], c[MISES_TILE], square[MISES_TILE], grow[MISES_TILE], mass[MISES_TILE];
    const size_t n = at->count;
    buffon_math_sincospi(s, c, at->h, n);
    for (size_t i = 0; i < n; i++) {
        square[i] = s[i] * s[i];
        grow[i] = kappa * square[i];
    }
    buffon_math_exp(grow, grow, n);
    mises_mass(mass, at->h, square, at->inner, fine, n, kappa);
    for (size_t i = 0; i < n; i++) {
        const double h = at->h[i], want = at->share[i] * grow[i] * grow[i] * bessel;
        const double slope = 4 * MISES_PI * kappa * (s[i] * c[i]);
        const double bend = 4 * MISES_PI * MISES_PI * (kappa * (1 - 2 * square[i]));
        const double all = at->inner ? want - mass[i] : mass[i] - want;
        const double m = slope * all > 0.9 ? 0.9 / slope : all, e = slope * m;
        const double next = h + m * ((6 - e) / (6 - 4 * e) + bend * m * m / 6);
        at->h[i] = next > 0.5 ? 0.5 : next < 0.25 * h ? 0.25 * h : next;
        found[i] = (fine || at->inner) && m * m * (1 + kappa) < 1e-10;
    }
}

/* A point that is found is left alone, so that it does not depend on its neighbours. For large and
 * for tiny kappa the guess is as good as a rough step. */
static void mises_find(double *h, mises_search *at, double kappa, double bessel)
{
    int found[MISES_TILE], fine = kappa > 1e4 || kappa < 1e-4;
    for (int step = 0; step < MISES_STEPS && at->count > 0; step++, fine = 1) {
        size_t left = 0;
        mises_step(found, at, fine, kappa, bessel);
        for (size_t i = 0; i < at->count; i++) {
            h[at->place[i]] = at->h[i];
            at->h[left] = at->h[i];
            at->share[left] = at->share[i];
            at->place[left] = at->place[i];
            left += !found[i];
        }
        at->count = left;
    }
}

/* h of the tail shares p <= 1/2. */
static void mises_solve(double *h, const double *p, size_t n, const buffon_density *g)
{
    const double kappa = g->param[MISES_KAPPA], bessel = g->param[MISES_BESSEL];
    mises_guess(h, p, n, bessel);
    for (int inner = 0; inner < 2; inner++) {
        mises_search at = {.inner = inner};
        for (size_t i = 0; i < n; i++) {
            at.h[at.count] = h[i];
            at.share[at.count] = inner ? 0.5 - p[i] : p[i];
            at.place[at.count] = i;
            at.count += (p[i] > 0.25) == inner;
        }
        mises_find(h, &at, kappa, bessel);
    }
}

/* ---- the density ---- */

static int mises_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const double mean = g->param[MISES_MEAN], kappa = g->param[MISES_KAPPA];
    for (size_t start = 0; start < n; start += MISES_TILE) {
        const size_t m = n - start < MISES_TILE ? n - start : MISES_TILE;
        double p[MISES_TILE], h[MISES_TILE];
        for (size_t i = 0; i < m; i++)
            p[i] = u[start + i] < 0.5 ? u[start + i] : 1 - u[start + i];
        mises_solve(h, p, m, g);
        for (size_t i = 0; i < m; i++) {
            const double angle = 2 * MISES_PI * h[i];
            x[start + i] = u[start + i] < 0.5 ? mean - angle : mean + angle;
        }
        if (!pdf)
            continue;
        buffon_math_sinpi(h, h, m);
        for (size_t i = 0; i < m; i++)
            h[i] = -2 * kappa * (h[i] * h[i]);
        buffon_math_exp(h, h, m);
        for (size_t i = 0; i < m; i++)
            pdf[start + i] = g->param[MISES_TOP] * h[i];
    }
    return 0;
}

/* The exponent of the density; -infinity outside. */
static void mises_exponent(double *y, const double *x, size_t n, const buffon_density *g)
{
    const double mean = g->param[MISES_MEAN], kappa = g->param[MISES_KAPPA];
    const double reach = g->param[MISES_REACH];
    for (size_t i = 0; i < n; i++)
        y[i] = 0.5 * DENSITY_INV_PI * (x[i] - mean);
    buffon_math_sinpi(y, y, n);
    for (size_t i = 0; i < n; i++)
        y[i] =
            buffon_priv_abs(x[i] - mean) <= reach ? -2 * kappa * (y[i] * y[i]) : -(double)INFINITY;
}

static int mises_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    mises_exponent(pdf, x, n, g);
    buffon_math_exp(pdf, pdf, n);
    for (size_t i = 0; i < n; i++)
        pdf[i] *= g->param[MISES_TOP];
    return 0;
}

static int mises_log_pdf(double *log_pdf, const double *x, size_t n, const buffon_density *g)
{
    const double top = buffon_priv_log(g->param[MISES_TOP]);
    mises_exponent(log_pdf, x, n, g);
    for (size_t i = 0; i < n; i++)
        log_pdf[i] += top;
    return 0;
}

static int mises_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const double kappa = g->param[MISES_KAPPA];
    for (size_t i = 0; i < n; i++) {
        const double from = x[i] - g->param[MISES_MEAN];
        const double turns = 0.5 * DENSITY_INV_PI * buffon_priv_abs(from);
        const double h = turns < 0.5 ? turns : 0.5, s = buffon_priv_sinpi(h), square = s * s;
        const int inner = h < g->param[MISES_QUARTILE];
        double mass;
        mises_mass(&mass, &h, &square, inner, 1, 1, kappa);
        const double share = mass / g->param[MISES_BESSEL] * buffon_priv_exp(-2 * kappa * square);
        const double p = inner ? 0.5 - share : share;
        u[i] = density_inside(from < 0 ? p : 1 - p);
    }
    return 0;
}

static const buffon_density_ops mises_ops = {.sample = mises_draw,
                                             .pdf = mises_pdf,
                                             .log_pdf = mises_log_pdf,
                                             .invert = mises_invert,
                                             .name = "buffon.von_mises"};

/* exp(-kappa) I0(kappa): for small kappa the mean of f over 64 even points of the circle, which is
 * off by 2 I64; for large ones the asymptotic series, whose terms grow from 2 kappa on. */
static double mises_bessel(double kappa)
{
    double sum = 1, term = 1;
    if (kappa < 30) {
        for (int k = 1; k < 64; k++) {
            const double s = buffon_priv_sinpi(k * 0x1p-6);
            sum += buffon_priv_exp(-2 * kappa * (s * s));
        }
        return sum * 0x1p-6;
    }
    for (int k = 1; term > 0x1p-60; k++) {
        term *= (2 * k - 1) * (2 * k - 1) / (8 * kappa * k);
        sum += term;
    }
    return sum / sqrt(2 * MISES_PI * kappa);
}

buffon_density buffon_von_mises(double kappa, double mean)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &mises_ops};
    const double quarter = 0.25;
    if (!(kappa >= 0 && kappa <= 0x1p900 && buffon_priv_abs(mean) <= 0x1p40)) {
        g.status = BUFFON_E_SHAPE;
        return g;
    }
    g.param[MISES_MEAN] = mean;
    g.param[MISES_KAPPA] = kappa;
    g.param[MISES_BESSEL] = mises_bessel(kappa);
    mises_guess(&g.param[MISES_QUARTILE], &quarter, 1, g.param[MISES_BESSEL]);
    g.param[MISES_TOP] = 0.5 * DENSITY_INV_PI / g.param[MISES_BESSEL];
    g.param[MISES_REACH] = MISES_PI + 0x1p-50 * (4 + buffon_priv_abs(mean));
    return g;
}
