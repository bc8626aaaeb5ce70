/* The laws on the line of laws.h: formulas against extended precision over all uniforms and
 * parameters (the numbers behind `Exact:` in the header), what they refuse, their special values
 * and points that are known. */
#include <float.h>
#include <math.h>
#include <string.h>

#include <buffon/buffon.h>

#include "law.h"
#include "line.h"
#include "one.h"
#include "ulps.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

enum { ROUNDS = 40000 };

/* ---- straight lines ----------------------------------------------------------------------- */

static void see_linear(line_errors *w, double lo, double hi, double a, double b, double u)
{
    const buffon_density g = buffon_linear(lo, hi, a, b);
    const double at[] = {lo, hi, a / b, u};
    const wide W = (wide)hi - lo, A = (wide)a / fmax(a, b), B = (wide)b / fmax(a, b),
               v = 1 - (wide)u;
    const wide low = u * (A + B) / (A + sqrtl(A * A * v + B * B * u));
    const wide high = v * (A + B) / (B + sqrtl(A * A * v + B * B * u));
    const line_point y = line_draw(&g, u);
    if (low < 0.5L)
        ulps_see_sum(&w->x, y.x, lo, W * low, 6, at);
    else
        ulps_see_sum(&w->x, y.x, hi, -W * high, 6, at);
    const wide t = ((wide)y.x - lo) / W, s = ((wide)hi - y.x) / W;
    const wide top = 2 * fmaxl(A, B) / (W * (A + B));
    ulps_see_terms(&w->given, y.pdf, 2 * (A * s + B * t) / (W * (A + B)), top, 6, at);
    ulps_see_terms(&w->given, one_pdf(&g, y.x), y.pdf, top, 0.5, at);
    ulps_see(&w->u, one_u(&g, y.x), t * (A * (1 + s) + B * t) / (A + B), 8, at);
}

static void test_linear(void)
{
    line_errors w = {0};
    buffon_rng rng = buffon_rng_make(1, 40);
    for (int k = 0; k < ROUNDS; k++) {
        const double width = ulps_scale(&rng, k, -1000, 1000), u = ulps_uniform(&rng, k);
        const double a = k % 7 ? ulps_scale(&rng, k / 2, -1022, 1023) : 0;
        const double b = k % 7 == 1 ? 0 : ulps_scale(&rng, k / 3, -1022, 1023);
        const double away = k % 3 * width * (buffon_rng_next(&rng) - 0.5);
        const double lo = k % 4 == 3 ? -width : away, hi = k % 4 == 3 ? 0 : lo + width;
        see_linear(&w, lo, hi, a, b, u);
    }
    ulps_report(&w.x, "linear: x within 6 ulp of its distance from the nearer end");
    ulps_report(&w.given, "linear: g at x within 6 ulp of its top");
    ulps_report(&w.u, "linear: u of x within 8 ulp");
}

/* `tent` of the centre and the radius, else the triangle of three corners. */
static void see_triangle(line_errors *w, int tent, double lo, double mode, double hi, double u)
{
    const double radius = hi;
    const buffon_density g = tent ? buffon_tent(mode, radius) : buffon_triangular(lo, mode, hi);
    const double at[] = {lo, mode, hi, u};
    const wide A = tent ? radius : (wide)mode - lo, B = tent ? radius : (wide)hi - mode;
    const wide W = A + B, v = 1 - (wide)u;
    const wide first = tent ? mode - A : (wide)lo, last = tent ? mode + B : (wide)hi;
    const line_point y = line_draw(&g, u);
    const wide low = sqrtl(u * W) * sqrtl(A), high = sqrtl(v * W) * sqrtl(B);
    wide pdf, level;
    if (u * W < A && 2 * low <= A)
        ulps_see_sum(&w->x, y.x, first, low, tent ? 4 : 6, at);
    else if (u * W < A && tent)
        ulps_see_sum(&w->x, y.x, mode, -A * (1 - 2 * (wide)u) / (1 + sqrtl(2 * (wide)u)), 4, at);
    else if (u * W >= A && 2 * high <= B)
        ulps_see_sum(&w->x, y.x, last, -high, tent ? 4 : 6, at);
    else if (u * W >= A && tent)
        ulps_see_sum(&w->x, y.x, mode, A * (1 - 2 * v) / (1 + sqrtl(2 * v)), 4, at);
    else
        ulps_see_terms(&w->drawn, y.x, u * W < A ? lo + low : hi - high,
                       fmaxl(W, fmaxl(fabsl((wide)lo), fabsl((wide)hi))), 3, at);
    if (tent && (mode - radius != (double)first || mode + radius != (double)last))
        return;
    pdf = y.x < mode ? 2 * (y.x - first) / A / W : 2 * (last - y.x) / B / W;
    level = y.x < mode ? (y.x - first) / A * (y.x - first) / W
                       : A / W + (y.x - (wide)mode) / W * (1 + (last - y.x) / B);
    if (fabsl(first - (wide)(mode - A)) == 0 && (wide)(double)first == first &&
        (wide)(double)last == last) {
        ulps_see(&w->given, y.pdf, pdf, 4, at);
        ulps_see(&w->u, one_u(&g, y.x), line_inside(level), 6, at);
    }
    ulps_see(&w->given, one_pdf(&g, y.x), y.pdf, 0.5, at);
}

static void test_triangles(void)
{
    line_errors w[2];
    memset(w, 0, sizeof w);
    buffon_rng rng = buffon_rng_make(2, 40);
    for (int k = 0; k < ROUNDS; k++) {
        const double width = ulps_scale(&rng, k, -1000, 1000), u = ulps_uniform(&rng, k);
        const double away = k % 3 * width * (buffon_rng_next(&rng) - 0.5);
        const double share = k % 4 ? buffon_rng_next(&rng) : k % 8 ? 0 : 1;
        const double part = width * (k % 16 == 7 ? ldexp(share, -300) : share);
        const double lo = k % 4 == 3 ? 0 : away, hi = lo + width, mode = lo + part;
        if (lo <= mode && mode <= hi)
            see_triangle(&w[0], 0, lo, mode, hi, u);
        see_triangle(&w[1], 1, 0, k % 3 ? away : 0, width, u);
    }
    for (int k = 0; k < 2; k++) {
        const char *name = k ? "tent" : "triangular";
        tap_note("%s", name);
        ulps_report(&w[k].x, "triangles: x within 6 (tent: 4) ulp of the distance");
        ulps_report(&w[k].given, "triangles: g at x within 4 ulp");
        ulps_report(&w[k].u, "triangles: u of x within 6 ulp");
    }
    ulps_report(&w[0].drawn, "triangular: x near the mode within 3 ulp of the width");
}

/* ---- laws of a mean and a scale ----------------------------------------------------------- */

typedef struct wide_law {
    const char *name;
    buffon_density (*make)(double mean, double scale);
    wide (*offset)(wide u, wide rest); /* (x - mean) / scale */
    wide (*log_pdf)(wide z);           /* of scale 1 */
    wide (*level)(wide z);
    wide (*at_u)(wide u, wide rest); /* the pdf at u */
    double x, drawn, given, more, u; /* what is allowed; `more` for each |z| */
} wide_law;

static wide laplace_offset(wide u, wide rest)
{
    return u < 0.5L ? logl(2 * u) : -logl(2 * rest);
}

static wide laplace_log(wide z)
{
    return -fabsl(z) - logl(2);
}

static wide laplace_level(wide z)
{
    return z < 0 ? 0.5L * expl(z) : 1 - 0.5L * expl(-z);
}

static wide laplace_at(wide u, wide rest)
{
    return fminl(u, rest);
}

static wide logistic_offset(wide u, wide rest)
{
    if (fabsl(u - 0.5L) < 0.25L)
        return 2 * atanhl(2 * u - 1);
    return logl(u) - logl(rest);
}

static wide logistic_log(wide z)
{
    return -fabsl(z) - 2 * log1pl(expl(-fabsl(z)));
}

static wide logistic_level(wide z)
{
    return z < 0 ? expl(z) / (1 + expl(z)) : 1 / (1 + expl(-z));
}

static wide logistic_at(wide u, wide rest)
{
    return u * rest;
}

static wide cauchy_offset(wide u, wide rest)
{
    const wide t =
        fabsl(u - 0.5L) < 0.25L ? tanl(WIDE_PI * (u - 0.5L)) : -1 / tanl(WIDE_PI * fminl(u, rest));
    return fabsl(u - 0.5L) < 0.25L || u < 0.5L ? t : -t;
}

static wide cauchy_log(wide z)
{
    return -log1pl(z * z) - logl(WIDE_PI);
}

static wide cauchy_level(wide z)
{
    return z < -1  ? atanl(-1 / z) / WIDE_PI
           : z > 1 ? 1 - atanl(1 / z) / WIDE_PI
                   : 0.5L + atanl(z) / WIDE_PI;
}

static wide cauchy_at(wide u, wide rest)
{
    const wide s = sinl(WIDE_PI * fminl(u, rest));
    return s * s / WIDE_PI;
}

static const wide_law wide_laws[] = {
    {"laplace", buffon_laplace, laplace_offset, laplace_log, laplace_level, laplace_at, 2, 2, 3, 1,
     3},
    {"logistic", buffon_logistic, logistic_offset, logistic_log, logistic_level, logistic_at, 4, 3,
     5, 1, 4},
    {"cauchy", buffon_cauchy, cauchy_offset, cauchy_log, cauchy_level, cauchy_at, 5, 5, 6, 0, 5}};

static void see_law(line_errors *w, const wide_law *law, double mean, double scale, double u)
{
    const buffon_density g = law->make(mean, scale);
    const double at[] = {mean, scale, u, 0};
    const wide rest = 1 - (wide)u, z = law->offset(u, rest), pdf = law->at_u(u, rest) / scale;
    const line_point y = line_draw(&g, u);
    if (fabsl(z * scale) < 0x1p1023L)
        ulps_see_sum(&w->x, y.x, mean, z * scale, law->x, at);
    if (pdf > 0x1p-1020L)
        ulps_see(&w->drawn, y.pdf, pdf, law->drawn, at);
    const wide own = ((wide)y.x - mean) / scale, log_pdf = law->log_pdf(own) - logl(scale);
    const double more = law->more * (double)fabsl(own) * (mean != 0 ? 2 : 1);
    if (log_pdf > -706)
        ulps_see(&w->given, one_pdf(&g, y.x), expl(law->log_pdf(own)) / scale, law->given + more,
                 at);
    ulps_see_terms(&w->log_given, one_log_pdf(&g, y.x), log_pdf,
                   fmaxl(fabsl(logl(scale)), fmaxl(fabsl(law->log_pdf(own)), 1)), 4, at);
    ulps_see(&w->u, one_u(&g, y.x), line_inside(law->level(own)),
             law->u + (own < 0 ? more : fmin(more, 2)), at);
}

static void test_scale_laws(void)
{
    for (size_t j = 0; j < COUNT(wide_laws); j++) {
        line_errors w = {0};
        buffon_rng rng = buffon_rng_make(3 + j, 40);
        for (int k = 0; k < ROUNDS; k++) {
            const double scale = ulps_scale(&rng, k, -900, 900), u = ulps_uniform(&rng, k);
            const double v = buffon_rng_next(&rng) - 0.5, far = ldexp(scale, k % 40);
            const double mean = k % 3 ? 0 : k % 31 ? v * far : k % 2 ? 0x1p1000 : -0x1p1000;
            see_law(&w, &wide_laws[j], fabs(mean) <= 0x1p1000 ? mean : 0, scale, u);
        }
        tap_note("%s", wide_laws[j].name);
        ulps_report(&w.x, "x as near as its header says");
        ulps_report(&w.drawn, "g at u");
        ulps_report(&w.given, "g at x");
        ulps_report(&w.log_given, "log g at x within 4 ulp of its largest term");
        ulps_report(&w.u, "u of x");
    }
}

/* ---- powers ------------------------------------------------------------------------------- */

/* log(x / y), also where they are near each other. */
static wide log_ratio(double x, double y)
{
    const wide d = ((wide)x - y) / y;
    return fabsl(d) < 0.5L ? log1pl(d) : logl((wide)x / y);
}

/* log(x / lo) of the law x^(a - 1) on (lo, hi), and what it allows in ulp of x. */
static wide power_log(double *allowed, wide a, double lo, double hi, double u)
{
    const wide l = log_ratio(hi, lo), c = a * l;
    *allowed = a == 0 ? 3 : (double)(4 * (1 + fminl(1 / fabsl(a), l)));
    if (c == 0)
        return u * l;
    if (fabsl(c) < 1000)
        return (c > 0 && u > 0.5L ? c + log1pl((1 - (wide)u) * expm1l(-c))
                                  : log1pl(u * expm1l(c))) /
               a;
    return a > 0 ? l + logl((wide)u + (1 - (wide)u) * expl(-c)) / a
                 : logl((1 - (wide)u) + u * expl(c)) / a;
}

static void see_power(line_errors *w, double exponent, double lo, double hi, double u)
{
    const buffon_density g = buffon_power(exponent, lo, hi);
    const double at[] = {exponent, lo, hi, u};
    const wide a = (wide)exponent + 1, rest = 1 - (wide)u;
    wide x, share;
    double allowed = 3;
    if (g.status != BUFFON_OK)
        return;
    if (lo == 0)
        x = hi * expl(logl(u) / a);
    else if (isinf(hi))
        x = lo * expl((u < 0.5 ? log1pl(-(wide)u) : logl(rest)) / a);
    else
        x = lo * expl(power_log(&allowed, a, lo, hi, u));
    const line_point y = line_draw(&g, u);
    if (x > DBL_MIN && x < DBL_MAX)
        ulps_see(&w->x, y.x, x, allowed, at);
    if (!(y.x >= DBL_MIN && y.x < DBL_MAX))
        return;
    /* (x / ref)^a, whose share of 1 - r is what the level takes. */
    const double ref = a > 0 ? hi : lo;
    const wide log_e = a * log_ratio(y.x, ref), e = expl(log_e);
    const wide L = lo > 0 && hi < INFINITY ? log_ratio(hi, lo) : INFINITY;
    share = a == 0 ? 1 / L : isinf(L) ? fabsl(a) : a / -expm1l(-fabsl(a) * L) * (a < 0 ? -1 : 1);
    const wide pdf = share * e / y.x;
    const double wider = fabs(exponent) + 6;
    if (pdf > DBL_MIN && pdf < DBL_MAX && e > 1e-4000L && L > 1e-3L) {
        ulps_see(&w->given, one_pdf(&g, y.x), pdf, 6, at);
        ulps_see(&w->drawn, y.pdf, pdf, wider + allowed * fabs(exponent), at);
        ulps_see_terms(&w->log_given, one_log_pdf(&g, y.x), logl(pdf),
                       fmaxl(1, fmaxl(fabsl(logl(share)), fmaxl(fabsl(log_e), fabsl(logl(y.x))))),
                       4, at);
    }
    if (y.x > lo && y.x < hi)
        ulps_see_error(
            &w->u, (double)(fabsl(one_u(&g, y.x) - (wide)u) / (ulps_of(u) + share * e * 0x1p-52L)),
            8 + allowed, at);
}

static void test_power(void)
{
    line_errors one = {0}, both = {0};
    buffon_rng rng = buffon_rng_make(6, 40);
    for (int k = 0; k < ROUNDS; k++) {
        const double u = ulps_uniform(&rng, k), v = buffon_rng_next(&rng);
        const double size = ulps_scale(&rng, k / 4, -9, 20),
                     lo = ulps_scale(&rng, k / 3, -300, 300);
        const double p = k % 4 == 0   ? -1
                         : k % 4 == 1 ? size - 1
                         : k % 4 == 2 ? -size - 1
                                      : 8 * v - 4;
        see_power(&one, k % 2 ? fmin(size, 0x1p20) - 1 + v : floor(8 * v), 0, lo, u);
        see_power(&one, -1 - fmin(size, 0x1p19) * (k % 2 ? 1 : v), lo, INFINITY, u);
        see_power(&both, k % 16 ? p : -1 + ldexp(v, -(int)(k % 50)), lo,
                  lo * (k % 5 ? 1 + ulps_scale(&rng, k, -20, 300) : 2), u);
    }
    ulps_report(&one.x, "power from 0 or to infinity: x within 3 ulp");
    ulps_report(&both.x, "power: x within 4 (1 + L) ulp, 3 for x^-1");
    ulps_report(&one.given, "power from 0 or to infinity: g at x within 6 ulp");
    ulps_report(&both.given, "power: g at x within 6 ulp");
    ulps_report(&one.drawn, "power from 0 or to infinity: g at u as near as x allows");
    ulps_report(&both.drawn, "power: g at u as near as x allows");
    ulps_report(&one.log_given, "power from 0 or to infinity: log g within 4 ulp of its terms");
    ulps_report(&both.log_given, "power: log g at x within 4 ulp of its terms");
    ulps_report(&one.u, "power from 0 or to infinity: u of x");
    ulps_report(&both.u, "power: u of x");
}

static void see_weibull(line_errors *w, double shape, double scale, double u)
{
    const buffon_density g = buffon_weibull(shape, scale);
    const double at[] = {shape, scale, u, 0};
    const wide E = u < 0.5 ? -log1pl(-(wide)u) : -logl(1 - (wide)u);
    const wide x = scale * expl(logl(E) / shape);
    if (g.status != BUFFON_OK)
        return;
    const line_point y = line_draw(&g, u);
    if (!(x > DBL_MIN && x < DBL_MAX))
        return;
    ulps_see(&w->x, y.x, x, 3, at);
    ulps_see(&w->drawn, y.pdf, shape * E * (1 - (wide)u) / x, 6, at);
    const wide log_e = shape * log_ratio(y.x, scale), e = expl(log_e);
    const wide log_pdf = logl(shape) + (log_e - logl(y.x)) - e;
    if (log_pdf > -706)
        ulps_see(&w->given, one_pdf(&g, y.x), expl(log_e - e) * shape / y.x, 8 + 4 * (double)e, at);
    ulps_see_terms(&w->log_given, one_log_pdf(&g, y.x), log_pdf,
                   fmaxl(fabsl(log_e), fmaxl(fabsl(logl(y.x)), fmaxl(e, logl(shape)))), 5, at);
    ulps_see(&w->u, one_u(&g, y.x), line_inside(-expm1l(-e)), 6, at);
}

static void test_weibull(void)
{
    line_errors w = {0};
    buffon_rng rng = buffon_rng_make(7, 40);
    for (int k = 0; k < ROUNDS; k++)
        see_weibull(&w, ulps_scale(&rng, k / 4, -4, 20), ulps_scale(&rng, k, -900, 900),
                    ulps_uniform(&rng, k));
    ulps_report(&w.x, "weibull: x within 3 ulp");
    ulps_report(&w.drawn, "weibull: g at u within 6 ulp");
    ulps_report(&w.given, "weibull: g at x within 8 + 4 E ulp");
    ulps_report(&w.log_given, "weibull: log g at x within 5 ulp of its terms");
    ulps_report(&w.u, "weibull: u of x within 6 ulp");
}

/* ---- refusals, special points, order ------------------------------------------------------- */

static void test_refused(void)
{
    static const double wrong[] = {NAN, INFINITY, -INFINITY, -1, 0, -0.0, 0x1p-1074, DBL_MAX};
    int good = 1;
    for (size_t k = 0; k < COUNT(wrong); k++) {
        const double v = wrong[k];
        good &= line_refuses(buffon_laplace(0, v), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_logistic(0, v), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_cauchy(0, v), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_pareto(v, 1), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_weibull(v, 1), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_weibull(1, v), BUFFON_E_SHAPE);
        good &= line_refuses(buffon_tent(0, v), BUFFON_E_SHAPE);
        if (k < 6)
            good &= line_refuses(buffon_pareto(1, v), BUFFON_E_SHAPE);
        if (k < 3 || k == 7) {
            good &= line_refuses(buffon_laplace(v, 1), BUFFON_E_SHAPE);
            good &= line_refuses(buffon_logistic(v, 1), BUFFON_E_SHAPE);
            good &= line_refuses(buffon_cauchy(v, 1), BUFFON_E_SHAPE);
            good &= line_refuses(buffon_power(v, 1, 2), BUFFON_E_SHAPE);
            good &= line_refuses(buffon_tent(v, 1), BUFFON_E_DOMAIN);
        }
        if (k < 4) {
            good &= line_refuses(buffon_linear(0, 1, v, 1), BUFFON_E_SHAPE);
            good &= line_refuses(buffon_linear(0, 1, 1, v), BUFFON_E_SHAPE);
            good &= line_refuses(buffon_power(0, v, 2), BUFFON_E_DOMAIN);
        }
        if (k < 3) {
            good &= line_refuses(buffon_linear(v, 1, 1, 1), BUFFON_E_DOMAIN);
            good &= line_refuses(buffon_linear(0, v, 1, 1), BUFFON_E_DOMAIN);
            good &= line_refuses(buffon_triangular(v, 0.5, 1), BUFFON_E_DOMAIN);
            good &= line_refuses(buffon_triangular(0, v, 1), BUFFON_E_DOMAIN);
            good &= line_refuses(buffon_triangular(0, 0.5, v), BUFFON_E_DOMAIN);
        }
    }
    good &= line_refuses(buffon_linear(0, 1, 0, 0), BUFFON_E_SHAPE);
    good &= line_refuses(buffon_linear(1, 1, 1, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_linear(2, 1, 1, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_linear(-DBL_MAX, DBL_MAX, 1, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_triangular(0, 2, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_triangular(0, -1, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_tent(1e17, 1), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_power(-1, 0, 1), BUFFON_E_SHAPE);
    good &= line_refuses(buffon_power(-1, 1, INFINITY), BUFFON_E_SHAPE);
    good &= line_refuses(buffon_power(1, 0, INFINITY), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_power(1, 2, 2), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_power(1, 2, NAN), BUFFON_E_DOMAIN);
    good &= line_refuses(buffon_power(-1 + 0x1p-6, 0, 1), BUFFON_E_SHAPE); /* x below the doubles */
    good &= line_refuses(buffon_pareto(0x1p-6, 1), BUFFON_E_SHAPE);        /* and above them */
    good &= line_refuses(buffon_weibull(0x1p-5, 1), BUFFON_E_SHAPE);
    good &= line_refuses(buffon_weibull(0x1p-4, 0x1p-300), BUFFON_E_SHAPE);
    tap_ok(good, "parameters out of range are refused");
}

static void test_special_points(void)
{
    const double below[] = {NAN, INFINITY, -INFINITY, -1, -0x1p-1074}, pi = LAW_PI;
    tap_ok(line_special(buffon_linear(0, 2, 1, 3), below, 5, 2, 0.75) &&
               line_special(buffon_linear(0, 2, 1, 3), below, 5, 0, 0.25),
           "linear: 0 outside, known at the ends");
    tap_ok(line_special(buffon_triangular(0, 1, 4), below, 5, 1, 0.5) &&
               line_special(buffon_triangular(0, 0, 4), below, 5, 0, 0.5) &&
               line_special(buffon_triangular(0, 4, 4), below, 5, 4, 0.5) &&
               line_special(buffon_triangular(0, 1, 4), below, 5, 2.5, 0.25),
           "triangular: 0 outside, 2 / width at the mode");
    tap_ok(line_special(buffon_tent(1, 1), below, 5, 1.5, 0.5), "tent: 0 outside, known inside");
    tap_ok(line_special(buffon_laplace(1, 2), below, 3, 1, 0.25), "laplace: the peak");
    tap_ok(line_special(buffon_logistic(1, 2), below, 3, 1, 0.125), "logistic: the peak");
    tap_ok(line_special(buffon_cauchy(1, 2), below, 3, 3, 1 / (4 * pi)), "cauchy: half the peak");
    tap_ok(line_special(buffon_power(2, 0, 2), below, 5, 1, 0.375) &&
               line_special(buffon_power(-0.5, 0, 4), below, 5, 1, 0.25) &&
               line_special(buffon_power(-1, 1, 4), below, 5, 2, 0.5 / log(4)) &&
               line_special(buffon_pareto(2, 1), below, 5, 2, 0.25),
           "power, pareto: 0 outside, known inside");
    tap_ok(line_special(buffon_weibull(2, 1), below, 5, 1, 2 * exp(-1)), "weibull: known inside");
}

static void test_least_points(void)
{
    const buffon_density uniform = buffon_power(0, 0, 1), steep = buffon_power(-0.5, 0, 1);
    const buffon_density exponential = buffon_weibull(1, 1), rayleigh = buffon_weibull(2, 0x1p-500);
    const double x = 0x1p-1074;
    tap_ok(one_pdf(&uniform, x) == 1 && one_pdf(&exponential, x) == 1 &&
               fabs(one_pdf(&steep, x) / 0x1p536 - 1) < 1e-15 &&
               fabs(one_pdf(&rayleigh, x) / 0x1p-73 - 1) < 1e-15,
           "powers and weibull: g where the inverse of x is no double");
    tap_ok(line_least_points(uniform) && line_least_points(steep) &&
               line_least_points(exponential) && line_least_points(buffon_weibull(0.5, 1)) &&
               line_least_points(buffon_power(1, 0, 1e-200)),
           "points of the smallest uniforms, and g at them");
}

static void test_bounds(void)
{
    tap_ok(line_strictly_inside(buffon_linear(1, 2, 1, 3), 1, 2) &&
               line_strictly_inside(buffon_linear(-2, -1, 3, 0), -2, -1) &&
               line_strictly_inside(buffon_triangular(1, 1, 2), 1, 2) &&
               line_strictly_inside(buffon_triangular(1, 2, 2), 1, 2) &&
               line_strictly_inside(buffon_tent(0x1p60, 0x1p10), 0x1p60 - 0x1p10, 0x1p60 + 0x1p10),
           "linear, triangular, tent: points are strictly inside");
}

static void test_known_points(void)
{
    const buffon_density cube = buffon_power(2, 0, 1), log_uniform = buffon_power(-1, 1, 16);
    const buffon_density square = buffon_pareto(0.5, 3), tent = buffon_tent(0, 4);
    const buffon_density cauchy = buffon_cauchy(0, 1), rayleigh = buffon_weibull(2, 1);
    tap_ok(fabs(one_x(&cube, 0.125) - 0.5) < 1e-16, "x^2: the cube root");
    tap_ok(fabs(one_x(&log_uniform, 0.75) - 8) < 2e-15, "1/x: a power of two");
    tap_ok(one_x(&square, 0.5) == 12, "pareto: the square");
    tap_ok(one_x(&tent, 0.125) == -2 && one_x(&tent, 0.875) == 2 && one_x(&tent, 0.5) == 0,
           "tent: quarters");
    tap_ok(one_x(&cauchy, 0.75) == 1 && one_x(&cauchy, 0.25) == -1 && one_x(&cauchy, 0.5) == 0,
           "cauchy: quartiles");
    tap_ok(fabs(one_x(&rayleigh, 0.5) - sqrt(log(2))) < 2e-16, "weibull: the median");
}

/* x grows with u, and batches are their points one by one. */
static void test_order(void)
{
    enum { N = 700 };
    const buffon_density laws[] = {
        buffon_linear(-1, 3, 2, 0.1), buffon_linear(0, 1, 0, 1), buffon_triangular(-1, 0.3, 5),
        buffon_triangular(0, 0, 1),   buffon_tent(0, 1),         buffon_laplace(0, 1),
        buffon_logistic(0, 1),        buffon_cauchy(0, 1),       buffon_power(3.3, 0, 1),
        buffon_power(-0.9, 0, 2),     buffon_power(-1, 1, 1e9),  buffon_power(-1.01, 1, 5),
        buffon_power(1.7, 1, 5),      buffon_pareto(1.5, 2),     buffon_weibull(1.5, 2)};
    static double u[N], x[N], pdf[N];
    for (size_t k = 0; k < N; k++)
        u[k] = k < 100 ? ldexp(1 + (double)k / 100, -60) : (double)k / N;
    u[N - 1] = 1 - 0x1p-53;
    for (size_t j = 0; j < COUNT(laws); j++) {
        int grows = buffon_density_sample(x, pdf, u, N, &laws[j]) == BUFFON_OK, same = 1;
        for (size_t k = 0; k < N; k++) {
            const line_point one = line_draw(&laws[j], u[k]);
            grows &= k == 0 || x[k] >= x[k - 1];
            same &= tap_bits(one.x) == tap_bits(x[k]) && tap_bits(one.pdf) == tap_bits(pdf[k]);
        }
        tap_ok(grows && same, "%s: x grows with u; one by one the same", laws[j].ops->name);
    }
}

int main(void)
{
    if (ulps_have_wide()) {
        test_linear();
        test_triangles();
        test_scale_laws();
        test_power();
        test_weibull();
    } else {
        tap_ok(1, "formulas # SKIP long double is no wider than double");
    }
    test_refused();
    test_special_points();
    test_known_points();
    test_least_points();
    test_bounds();
    test_order();
    return tap_done();
}
