/* The exponential and the normal law between bounds, and the lognormal: formulas against extended
 * precision over all uniforms and parameters (the numbers behind `Exact:` in the headers), what
 * they refuse, and their special values. */
#include <float.h>
#include <math.h>

#include <buffon/buffon.h>

#include "law.h"
#include "line.h"
#include "one.h"
#include "ulps.h"

enum { ROUNDS = 40000 };

/* ---- exponential between bounds ----------------------------------------------------------- */

/* The distances from lo and from hi of the share u, for the law exp(-k t) on (0, W). */
static wide exponential_low(wide u, wide rest, wide k, wide W)
{
    const wide c = k * W;
    if (fabsl(c) < 1e-30L)
        return u * W;
    if (c < 0 && c < -11000) /* exp(-c) is beyond the long doubles */
        return W - logl(u) / k;
    if (c > 0 && rest + u * expl(-c) < 0.5L)
        return -logl(rest + u * expl(-c)) / k;
    return -log1pl(u * expm1l(-c)) / k;
}

static void see_exponential(line_errors *w, double rate, double lo, double hi, double u)
{
    const buffon_density g = buffon_exponential_truncated(rate, lo, hi);
    const double at[] = {rate, lo, hi, u};
    const wide W = (wide)hi - lo, rest = 1 - (wide)u, r = fabsl((wide)rate), c = r * W;
    if (g.status != BUFFON_OK)
        return;
    const wide low = isinf(lo) ? INFINITY : exponential_low(u, rest, rate, W);
    const wide high = isinf(hi) ? INFINITY : exponential_low(rest, u, -(wide)rate, W);
    const line_point y = line_draw(&g, u);
    if (low <= high)
        ulps_see_sum(&w->x, y.x, lo, low, 4, at);
    else
        ulps_see_sum(&w->x, y.x, hi, -high, 4, at);
    const wide base = rate >= 0 ? lo : hi, away = fabsl(y.x - base);
    const wide peak = c < 1e-30L ? 1 / W : r / -expm1l(-c), at_u = r * (rate >= 0 ? low : high);
    const wide shares = peak * (rate >= 0 ? rest + u * expl(-c) : (wide)u + rest * expl(-c));
    if (shares > 1e-300L && at_u < 700)
        ulps_see(&w->drawn, y.pdf, shares, 5 + 2 * (double)fminl(at_u, c), at);
    if (peak * expl(-r * away) > 1e-300L)
        ulps_see(&w->given, one_pdf(&g, y.x), peak * expl(-r * away), 5 + 2 * (double)(r * away),
                 at);
    if (r * away < 1e300L)
        ulps_see_terms(&w->log_given, one_log_pdf(&g, y.x), logl(peak) - r * away,
                       fmaxl(1, fmaxl(fabsl(logl(peak)), r * away)), 4, at);
    const wide slope = shares * ulps_of(y.x);
    if (slope < 0.01L * u)
        ulps_see_error(&w->u,
                       (double)(fabsl(one_u(&g, y.x) - (wide)u) /
                                (slope + ulps_of(u) * (1 + (rate < 0 ? at_u : 0)))),
                       16, at);
}

static void test_exponential(void)
{
    line_errors w = {0};
    buffon_rng rng = buffon_rng_make(8, 40);
    for (int k = 0; k < ROUNDS; k++) {
        const double W = ulps_scale(&rng, k, -1000, 1000), v = buffon_rng_next(&rng);
        const double c =
            k % 3 ? ldexp(1 + v, (int)buffon_rng_below(&rng, 12)) : ulps_scale(&rng, k, -80, 80);
        const double rate = (k % 2 ? 1 : -1) * (k % 50 ? c / W : 0), u = ulps_uniform(&rng, k);
        const double off = k % 5 == 1 ? W * (v - 0.5) : 0;
        const double lo = k % 7 == 3 ? -W : off, hi = k % 7 == 3 ? 0 : lo + W;
        see_exponential(&w, rate, lo, hi, u);
        see_exponential(&w, fabs(rate), lo, INFINITY, u);
        see_exponential(&w, -fabs(rate), -INFINITY, hi, u);
    }
    ulps_report(&w.x, "exponential between bounds: x within 4 ulp of the distance");
    ulps_report(&w.drawn, "exponential between bounds: g at u within 5 + 2 e ulp");
    ulps_report(&w.given, "exponential between bounds: g at x within 5 + 2 e ulp");
    ulps_report(&w.log_given, "exponential between bounds: log g within 4 ulp of its terms");
    ulps_report(&w.u, "exponential between bounds: u of x");
}

/* ---- normal between bounds ---------------------------------------------------------------- */

enum { GAUSS = 12 };
static wide gauss_node[GAUSS], gauss_weight[GAUSS];

/* Legendre's nodes by Newton's method. */
static void gauss_make(void)
{
    for (int i = 0; i < GAUSS; i++) {
        wide x = cosl(WIDE_PI * (i + 0.75L) / (GAUSS + 0.5L)), slope = 1;
        for (int step = 0; step < 20; step++) {
            wide p = 1, q = 0;
            for (int n = 1; n <= GAUSS; n++) {
                const wide r = ((2 * n - 1) * x * p - (n - 1) * q) / n;
                q = p;
                p = r;
            }
            slope = GAUSS * (x * p - q) / (x * x - 1);
            x -= p / slope;
        }
        gauss_node[i] = x;
        gauss_weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
}

/* The integral of exp(-a t - t^2 / 2) from `from` over a width, by panels of Gauss and Legendre:
 * all terms are positive. What is below 1e-25 of it is left. */
static wide bell_mass(wide a, wide from, wide width)
{
    wide sum = 0, t = 0;
    while (t < width) {
        const wide c = a + from + t, h = fminl(width - t, fminl(1, 3 / fabsl(c))) / 2;
        wide part = 0;
        for (int i = 0; i < GAUSS; i++) {
            const wide s = from + t + h * (1 + gauss_node[i]);
            part += gauss_weight[i] * h * expl(-s * (a + s / 2));
        }
        sum += part;
        t += 2 * h;
        if (isinf(sum) || (c > 0 && !(part > 1e-25L * sum)))
            break;
    }
    return sum;
}

/* Instead of solving for x: how far the share on the smaller side of the x that was found is from
 * the wanted one, divided by the density there, is the error of x. */
static void see_between(line_errors *w, double mean, double sd, double lo, double hi, double u)
{
    const buffon_density g = buffon_normal_truncated(mean, sd, lo, hi);
    const double at[] = {mean / sd, u, lo / sd, hi / sd};
    const line_point y = line_draw(&g, u);
    const wide low = ((wide)lo - mean) / sd, high = ((wide)hi - mean) / sd;
    const int up = low >= 0 || (high > 0 && -low <= high);
    const double near = up ? lo : hi, other = up ? hi : lo;
    const wide a = up ? low : -high, length = ((wide)hi - lo) / sd;
    const wide v = up ? (wide)u : 1 - (wide)u, rest = up ? 1 - (wide)u : (wide)u;
    const wide d = fabsl((wide)y.x - near) / sd,
               e = isinf(other) ? INFINITY : fabsl((wide)other - y.x) / sd;
    const wide z = fabsl((wide)y.x - mean) / sd, all = bell_mass(a, 0, length);
    const wide fall = d * (a + d / 2), here = expl(-fall);
    if (fabsl(a) * ulps_of(near) > 0.001L * sd) /* the bell at a bound is finer than the doubles */
        return;
    if (g.status != BUFFON_OK || !(y.x >= lo && y.x <= hi) || here == 0) {
        tap_note("%d %g %g %g %g %g: %g", (int)g.status, mean, sd, lo, hi, u, y.x);
        w->x.share = INFINITY;
        return;
    }
    const wide below = bell_mass(a, 0, d), beyond = bell_mass(a, d, fminl(e, length));
    const wide off = v <= 0.5L ? (below - v * all) / here : (beyond - rest * all) / here;
    const wide nearest = fminl(fminl(d, e), z), round = ulps_of(y.x) / sd + ulps_of(near) / sd / 2;
    const wide left = fabsl(off) - round - (mean != 0 ? 4 * ulps_of(mean) / sd : 0);
    ulps_see_error(&w->x, left > 0 ? (double)(left / nearest * 0x1p53L) : 0, 32, at);
    const wide top = a < 0 ? expl(-a * a / 2) : 1, size = a < 0 ? z * z / 2 : fall;
    ulps_see(&w->given, one_pdf(&g, y.x), here / all / sd,
             16 + 4 * (double)(size + (mean != 0) * size +
                               (a < 0 ? 0 : a * ulps_of(near) / sd * 0x1p53L)),
             at);
    ulps_see(&w->drawn, y.pdf, here / all / sd,
             1e4 + 4 * (double)size + (double)((fabsl(a) + d) * round * 0x1p53L), at);
    ulps_see_terms(&w->log_given, one_log_pdf(&g, y.x), logl(here / all / sd),
                   fmaxl(1, fmaxl(size, fmaxl(fabsl(logl(all * top)), fabsl(logl(sd))))), 16, at);
    const wide share = v <= 0.5L ? below / all : beyond / all;
    const double level = one_u(&g, y.x);
    const wide got = v <= 0.5L ? (up ? level : 1 - (wide)level) : (up ? 1 - (wide)level : level);
    if (share > 1e-12L || ((v <= 0.5L) == up))
        ulps_see_error(
            &w->u,
            (double)(fabsl(got - share) / (ulps_of(share) + (up == (v <= 0.5L) ? 0 : 0x1p-53L))),
            64 + 4 * (double)(size + fabsl(a)) * (mean != 0 ? 8 : 2), at);
}

/* Next to a mean that is not in the middle: by the share below it, which is not had exactly. */
static void test_near_mean(void)
{
    static const double lo[] = {-0.1, -1, -3, -5, -8}, hi[] = {0.3, 3, 9, 6, 10};
    double worst = 0;
    for (int k = 0; k < 5; k++) {
        const buffon_density g = buffon_normal_truncated(0, 1, lo[k], hi[k]);
        const wide a = lo[k], all = bell_mass(a, 0, (wide)hi[k] - a);
        const double mean = (double)(bell_mass(a, 0, -a) / all);
        for (int i = 0; i < 60; i++) {
            const double u = mean + (i % 2 ? 1 : -1) * ldexp(1, -4 - i);
            const wide d = (wide)one_x(&g, u) - lo[k];
            const wide off = (bell_mass(a, 0, d) - u * all) / expl(-d * (a + d / 2));
            worst = fmax(worst, fabs((double)off));
        }
    }
    tap_ok(worst <= 0x1p-51, "normal between bounds: next to the mean within %.2g sd", worst);
}

static void test_between(void)
{
    line_errors w = {0};
    buffon_rng rng = buffon_rng_make(9, 40);
    gauss_make();
    for (int k = 0; k < 3000; k++) {
        const double sd = k % 3 ? 1 : ulps_scale(&rng, k / 3, -300, 300), v = buffon_rng_next(&rng);
        double u = ulps_uniform(&rng, k);
        u = u < 1e-300 ? 1e-300 : u;
        const double a = k % 4   ? 12 * (v - 0.5)
                         : k % 8 ? ulps_scale(&rng, k / 8, -20, 60)
                                 : -38 * v;
        const double T = k % 5 == 0  ? INFINITY
                         : k % 5 < 3 ? 8 * buffon_rng_next(&rng)
                                     : ulps_scale(&rng, k / 5, -60, 6);
        const double mean = k % 2 ? 0 : k % 6 ? -a * sd : sd * 3 * v;
        const double lo = k % 2 || k % 6 == 0 ? mean + a * sd : 0, hi = lo + T * sd;
        if (!(hi - lo > 0x1p-40 * fmax(fabs(lo), fabs(hi))) && !(hi - lo > 0x1p-40 * sd))
            continue;
        if (k % 7 < 3)
            see_between(&w, mean, sd, lo, hi, u);
        else
            see_between(&w, -mean, sd, -hi, -lo, u);
    }
    ulps_report(&w.x, "normal between bounds: the distance from the nearest of them and the mean");
    ulps_report(&w.drawn, "normal between bounds: g at u as near as x allows");
    ulps_report(&w.given, "normal between bounds: g at x");
    ulps_report(&w.log_given, "normal between bounds: log g");
    ulps_report(&w.u, "normal between bounds: u of x");
}

/* log x is mu + sigma z, z the quantile that test_laws judges. */
static void test_lognormal(void)
{
    line_errors w = {0};
    buffon_rng rng = buffon_rng_make(10, 40);
    const buffon_density standard = buffon_normal(0, 1);
    for (int k = 0; k < ROUNDS / 2; k++) {
        const double v = buffon_rng_next(&rng), sigma = k % 3 ? 20 * v : ldexp(60 * v, -(k % 60));
        const double mu = k % 2 ? 0 : 160 * (buffon_rng_next(&rng) - 0.5),
                     u = ulps_uniform(&rng, k);
        const buffon_density g = buffon_lognormal(mu, sigma);
        const double at[] = {mu, sigma, u, 0};
        const line_point z = line_draw(&standard, u), y = line_draw(&g, u);
        const wide x = expl(mu + (wide)sigma * z.x);
        if (!(x > DBL_MIN && x < DBL_MAX) || fabs(z.x) > 37)
            continue;
        const wide own = (logl(y.x) - mu) / sigma,
                   bell = expl(-own * own / 2) / (sigma * sqrtl(2 * WIDE_PI));
        const double size = 3 * z.x * z.x;
        ulps_see(&w.x, y.x, x, 3, at);
        if (sigma > 0.05 && bell / y.x > 1e-307L && bell / y.x < 1e307L) {
            ulps_see(&w.given, one_pdf(&g, y.x), bell / y.x, 6 + size, at);
            ulps_see(&w.drawn, y.pdf, bell / y.x, 6 + size + fabs(z.x) * 4 / sigma, at);
            ulps_see_terms(
                &w.log_given, one_log_pdf(&g, y.x), logl(bell / y.x),
                fmaxl(fmaxl(1, own * own / 2), fmaxl(fabsl(logl(y.x)), fabsl(logl(sigma)))), 5, at);
            ulps_see(&w.u, one_u(&g, y.x), line_inside(0.5L * erfcl(-own * sqrtl(0.5L))), 8 + size,
                     at);
        }
    }
    ulps_report(&w.x, "lognormal: x within 3 ulp of exp(mu + sigma z)");
    ulps_report(&w.drawn, "lognormal: g at u");
    ulps_report(&w.given, "lognormal: g at x within 6 + 3 z^2 ulp");
    ulps_report(&w.log_given, "lognormal: log g within 5 ulp of its terms");
    ulps_report(&w.u, "lognormal: u of x");
}

/* ---- refusals, special points -------------------------------------------------------------- */

static void test_refused(void)
{
    static const double wrong[] = {NAN, INFINITY, -INFINITY};
    int good = 1;
    for (int k = 0; k < 3; k++) {
        good &= line_refuses(buffon_exponential_truncated(wrong[k], 0, 1), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_exponential_truncated(1, wrong[k], 1), BUFFON_E_DOMAIN);
        good &= line_refuses(buffon_exponential_truncated(-1, 0, wrong[k]), BUFFON_E_DOMAIN);
        good &= line_refuses(buffon_exponential_truncated(0, 0, wrong[k]), BUFFON_E_DOMAIN);
    }
    good &= line_refuses(buffon_exponential_truncated(1, 1, 1), BUFFON_E_DOMAIN);
    for (int k = 0; k < 3; k++) {
        good &= line_refuses(buffon_normal_truncated(wrong[k], 1, 0, 1), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_normal_truncated(0, wrong[k], 0, 1), BUFFON_E_SHAPE);
        good &= k == 2 || line_refuses(buffon_normal_truncated(0, 1, wrong[k], 1), BUFFON_E_DOMAIN);
        good &= k == 1 || line_refuses(buffon_normal_truncated(0, 1, 0, wrong[k]), BUFFON_E_DOMAIN);
        good &= line_refuses(buffon_lognormal(wrong[k], 1), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_lognormal(0, wrong[k]), BUFFON_E_SHAPE);
    }
    good &= line_refuses(buffon_normal_truncated(0, 1, 1, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_normal_truncated(0, 1, 2, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_normal_truncated(0, 1, 1e130, INFINITY), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_normal_truncated(0, 1e200, 0, 1e-200), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_normal_truncated(0, 1e-212, 1e-100, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_lognormal(0, 0), BUFFON_E_SHAPE);
    good &= line_refuses(buffon_lognormal(0, 73), BUFFON_E_SHAPE);
    good &= line_refuses(buffon_lognormal(-650, 1), BUFFON_E_SHAPE);
    good &= line_refuses(buffon_exponential_truncated(1, -DBL_MAX, DBL_MAX), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_exponential_truncated(0x1p-1001, 0, INFINITY), BUFFON_E_SHAPE);
    tap_ok(good, "parameters out of range are refused");
}

static void test_special_points(void)
{
    const double below[] = {NAN, INFINITY, -INFINITY, -1, -0x1p-1074}, pi = LAW_PI;
    tap_ok(line_special(buffon_exponential_truncated(2, 0, INFINITY), below, 5, 0, 2) &&
               line_special(buffon_exponential_truncated(0, 0, 4), below, 5, 4, 0.25) &&
               line_special(buffon_exponential_truncated(-1, 0, 1), below, 5, 1, 1 / -expm1(-1)),
           "exponential between bounds: 0 outside, known at its ends");
    tap_ok(
        line_special(buffon_normal_truncated(0, 1, 0, INFINITY), below, 5, 0, sqrt(2 / pi)) &&
            line_special(buffon_normal_truncated(0, 1, -INFINITY, INFINITY), below, 3, 0,
                         sqrt(0.5 / pi)) &&
            line_special(buffon_normal_truncated(-1e300, 1e200, 0, INFINITY), below, 5, 0, 1e-100),
        "normal between bounds: half of it, all of it, its far tail");
    tap_ok(line_special(buffon_lognormal(0, 1), below, 5, 1, sqrt(0.5 / pi)), "lognormal: at 1");
    tap_ok(line_least_points(buffon_lognormal(0, 72)) &&
               line_least_points(buffon_lognormal(-640, 1)),
           "lognormal: points of the smallest uniforms, and g at them");
}

static void test_bounds(void)
{
    tap_ok(line_strictly_inside(buffon_exponential_truncated(1, 1, 2), 1, 2) &&
               line_strictly_inside(buffon_exponential_truncated(-1, 1, 2), 1, 2) &&
               line_strictly_inside(buffon_exponential_truncated(0, -2, -1), -2, -1),
           "exponential between bounds: points are strictly inside");
    tap_ok(line_strictly_inside(buffon_normal_truncated(0, 1, 1, 2), 1, 2) &&
               line_strictly_inside(buffon_normal_truncated(0, 1, -2, -1), -2, -1) &&
               line_strictly_inside(buffon_normal_truncated(1.5, 0.1, 1, 2), 1, 2),
           "normal between bounds: points are strictly inside");
}

int main(void)
{
    if (ulps_have_wide()) {
        test_exponential();
        test_between();
        test_near_mean();
        test_lognormal();
    } else {
        tap_ok(1, "formulas # SKIP long double is no wider than double");
    }
    test_refused();
    test_special_points();
    test_bounds();
    return tap_done();
}
