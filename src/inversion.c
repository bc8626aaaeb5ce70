#include "guard.h"

#include <float.h>
#include <math.h>

#include <buffon/inversion.h>

#include "density_priv.h"
#include "elementary.h"

/* Newton's method inside a bracket F(a) < u <= F(b).
 *
 * A Newton step is taken while it stays in the bracket and is at most half the step before; else
 * the bracket is halved, by value and in turn by the order of the doubles themselves, which takes
 * 64 halvings from any bracket at any scale. An infinite end is approached in steps that square. An
 * end of the support counts as F = 0 or 1 until the bracket closes on it, and is then put to the
 * test. */

/* Newton steps and halvings by value end here; then come halvings by order alone. */
#define INVERSION_STEPS 96

typedef struct inversion_search {
    const buffon_inversion *how;
    double lo, hi;  /* the support */
    double u;       /* wanted: F(x) = u */
    double a, b;    /* the bracket */
    double x, F;    /* the last point, an end of the bracket, and the CDF there */
    double step;    /* the size of the last step */
    double stretch; /* the size of the next one towards an infinite end */
    int steps;
} inversion_search;

/* The place of a finite double in their order. */
static uint64_t inversion_rank(double x)
{
    const uint64_t bits = buffon_priv_bits(x);
    return bits >> 63 ? ~bits : bits | UINT64_C(1) << 63;
}

static double inversion_unrank(uint64_t rank)
{
    return buffon_priv_from_bits(rank >> 63 ? rank & ~(UINT64_C(1) << 63) : ~rank);
}

/* The point next to look at, strictly inside the bracket, or an end of it where there is none. */
static double inversion_halve(inversion_search *s)
{
    const int up = s->b > DBL_MAX, down = s->a < -DBL_MAX;
    if (up || down) {
        const double x = up ? s->x + s->stretch : s->x - s->stretch;
        s->stretch = s->stretch < 2 ? 2 : s->stretch * s->stretch;
        return x > DBL_MAX ? DBL_MAX : x < -DBL_MAX ? -DBL_MAX : x;
    }
    const double middle = 0.5 * s->a + 0.5 * s->b;
    if (s->steps % 2 == 0 && s->steps < INVERSION_STEPS && middle > s->a && middle < s->b)
        return middle;
    const uint64_t a = inversion_rank(s->a), b = inversion_rank(s->b);
    return inversion_unrank(a + (b - a) / 2);
}

/* The first point: where a linear F would be u, 0 on the line, or off the finite end. */
static double inversion_start(double lo, double hi, double u)
{
    double x = 0;
    if (lo >= -DBL_MAX && hi <= DBL_MAX)
        x = buffon_priv_isfinite(hi - lo) ? lo + u * (hi - lo) : lo * (1 - u) + hi * u;
    else if (lo >= -DBL_MAX)
        x = lo + (1 + buffon_priv_abs(lo));
    else if (hi <= DBL_MAX)
        x = hi - (1 + buffon_priv_abs(hi));
    if (!(x > lo))
        x = buffon_priv_nextup(lo);
    return x < hi ? x : buffon_priv_nextdown(hi);
}

/* Evaluates F at x and moves an end of the bracket there. Non-zero where F is no number. */
static int inversion_look(inversion_search *s, double x)
{
    s->step = buffon_priv_abs(x - s->x);
    s->x = x;
    s->F = s->how->cdf(x, s->how->ctx);
    if (s->F < s->u)
        s->a = x;
    else
        s->b = x;
    return s->F != s->F;
}

/* Whether the bracket has closed: on neighbours, or on the last double before an infinite end. */
static int inversion_is_closed(const inversion_search *s)
{
    if (s->b > DBL_MAX)
        return s->a == DBL_MAX;
    if (s->a < -DBL_MAX)
        return s->b == -DBL_MAX;
    return inversion_rank(s->b) - inversion_rank(s->a) <= 1;
}

/* One step of the search. The last point is the root if the Newton step is down to rounding and F
 * says so too, by crossing u within 4 ulp: a wrong pdf cannot pass for one. Returns 1 with the root
 * in x, -1 where F is no number, else 0. */
static int inversion_advance(inversion_search *s)
{
    const double x = s->x, slope = s->how->pdf(x, s->how->ctx);
    const double step = (s->u - s->F) / slope, size = buffon_priv_abs(step), next = x + step;
    if (slope > 0 && slope <= DBL_MAX && size <= 0x1p-51 * buffon_priv_abs(x)) {
        const int below = s->F < s->u;
        const double aside = 0x1p-50 * buffon_priv_abs(x), probe = below ? x + aside : x - aside;
        if (s->F == s->u)
            return 1;
        if (probe > s->a && probe < s->b) {
            if (inversion_look(s, probe))
                return -1;
            if ((s->F < s->u) != below) {
                s->x = next;
                return 1;
            }
        }
    } else if (slope > 0 && next > s->a && next < s->b && size <= 0.5 * s->step) {
        return -inversion_look(s, next);
    }
    return inversion_is_closed(s) ? 0 : -inversion_look(s, inversion_halve(s));
}

/* Closes the bracket on u. Returns 1 with the root in x, -1 where F is no number, 0 with neighbours
 * in a and b, one of which may be an end of the support. */
static int inversion_close(inversion_search *s)
{
    int found = 0;
    s->x = inversion_start(s->lo, s->hi, s->u);
    s->a = s->lo;
    s->b = s->hi;
    s->stretch = 1;
    s->steps = 0;
    if (inversion_look(s, s->x))
        return -1;
    s->step = (double)INFINITY;
    for (; !found && !inversion_is_closed(s); s->steps++) {
        if (s->steps < INVERSION_STEPS)
            found = inversion_advance(s);
        else
            found = -inversion_look(s, inversion_halve(s));
    }
    return found;
}

/* x = F^-1(u). A CDF that rounding keeps from quite reaching u at an end of the support is searched
 * for the value it does reach there. */
static int inversion_solve(double *x, double u, const buffon_inversion *how)
{
    const int line = how->lo == 0 && how->hi == 0;
    const double slack = 0x1p-50;
    inversion_search s = {.how = how, .u = u};
    s.lo = line ? -(double)INFINITY : how->lo;
    s.hi = line ? (double)INFINITY : how->hi;
    for (int attempt = 0; attempt < 2; attempt++) {
        const int found = inversion_close(&s);
        const int at_lo = s.a < -DBL_MAX || s.a <= s.lo, at_hi = s.b > DBL_MAX || s.b >= s.hi;
        if (found < 0)
            break;
        *x = found ? s.x : at_hi && s.a >= -DBL_MAX ? s.a : s.b;
        if (found || !(at_lo || at_hi))
            return 0;
        const double end = at_hi ? (s.b > DBL_MAX ? DBL_MAX : s.hi)
                                 : (s.a < -DBL_MAX ? -DBL_MAX : s.lo);
        const double F = how->cdf(end, how->ctx);
        if (at_hi ? F >= s.u : F <= s.u)
            return 0;
        if (!(at_hi ? F >= s.u - slack : F <= s.u + slack))
            break;
        s.u = at_hi ? F : buffon_priv_nextup(F);
    }
    *x = (double)NAN;
    return BUFFON_E_INVERSION;
}

/* Points from functions. A failure leaves NaN at its point and goes on, so that it can be found. */
static int inversion_draw(double *x, double *pdf, const double *u, size_t n,
                          const buffon_density *g)
{
    const buffon_inversion *how = g->data[0];
    int result = 0;
    if (pdf && !how->pdf)
        return BUFFON_E_UNSUPPORTED;
    for (size_t i = 0; i < n; i++) {
        if (!how->quantile) {
            result |= inversion_solve(&x[i], u[i], how);
        } else {
            x[i] = how->quantile(u[i], how->ctx);
            if (!buffon_priv_isfinite(x[i])) {
                x[i] = (double)NAN;
                result = BUFFON_E_INVERSION;
            }
        }
        if (pdf)
            pdf[i] = x[i] == x[i] ? how->pdf(x[i], how->ctx) : x[i];
    }
    return result;
}

static int inversion_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const buffon_inversion *how = g->data[0];
    const int line = how->lo == 0 && how->hi == 0;
    for (size_t i = 0; i < n; i++)
        pdf[i] = line || (x[i] >= how->lo && x[i] <= how->hi) ? how->pdf(x[i], how->ctx) : 0;
    return 0;
}

static int inversion_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    const buffon_inversion *how = g->data[0];
    int result = 0;
    if (!how->cdf)
        return BUFFON_E_UNSUPPORTED;
    for (size_t i = 0; i < n; i++) {
        u[i] = density_open(how->cdf(x[i], how->ctx));
        if (u[i] != u[i])
            result = BUFFON_E_INVERSION;
    }
    return result;
}

/* Functions cannot be told apart across processes; the support and which there are can. */
static uint64_t inversion_identity(uint64_t mix, const buffon_density *g)
{
    const buffon_inversion *how = g->data[0];
    mix = buffon_priv_mix(mix, (how->quantile ? 1u : 0u) | (how->cdf ? 2u : 0u) |
                                   (how->pdf ? 4u : 0u));
    mix = buffon_priv_mix_double(mix, how->lo);
    return buffon_priv_mix_double(mix, how->hi);
}

static const buffon_density_ops inversion_ops = {.sample = inversion_draw,
                                                 .pdf = inversion_pdf,
                                                 .invert = inversion_unmap,
                                                 .identity = inversion_identity,
                                                 .name = "buffon.inverse"};

/* Without a pdf: for expectations. */
static const buffon_density_ops inversion_bare_ops = {.sample = inversion_draw,
                                                      .invert = inversion_unmap,
                                                      .identity = inversion_identity,
                                                      .name = "buffon.inverse"};

/* The piece k with v[k] - origin <= t < v[k+1] - origin, the first or last for t beyond the table.
 * Halving without branches: the uniforms are random, so a predictor could only guess. */
static size_t table_search(const double *v, size_t count, double origin, double t)
{
    size_t k = 0;
    for (size_t left = count - 1; left > 1;) {
        const size_t half = left / 2;
        k += v[k + half] - origin <= t ? half : 0;
        left -= half;
    }
    return k;
}

/* Slopes relative to the whole: F(x) in (0, 1) rises by (F[k+1] - F[k]) / total over piece k. */
static double table_slope(const buffon_inversion *how, size_t k)
{
    const double total = how->F[how->count - 1] - how->F[0];
    return (how->F[k + 1] - how->F[k]) / total / (how->x[k + 1] - how->x[k]);
}

/* x stays below the upper end of its piece, so that its pdf is that of the piece it came from. */
static int table_draw(double *x, double *pdf, const double *u, size_t n, const buffon_density *g)
{
    const buffon_inversion *how = g->data[0];
    const double *knot = how->x, *F = how->F, total = F[how->count - 1] - F[0];
    for (size_t i = 0; i < n; i++) {
        const double t = u[i] * total;
        const size_t k = table_search(F, how->count, F[0], t);
        const double part = (t - (F[k] - F[0])) / (F[k + 1] - F[k]);
        const double v = knot[k] + part * (knot[k + 1] - knot[k]);
        const double most = buffon_priv_nextdown(knot[k + 1]);
        x[i] = v < knot[k] ? knot[k] : v < most ? v : most;
        if (pdf)
            pdf[i] = table_slope(how, k);
    }
    return 0;
}

static int table_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const buffon_inversion *how = g->data[0];
    const double *knot = how->x;
    for (size_t i = 0; i < n; i++) {
        const int inside = x[i] >= knot[0] && x[i] <= knot[how->count - 1];
        pdf[i] = inside ? table_slope(how, table_search(knot, how->count, 0, x[i])) : 0;
    }
    return 0;
}

static int table_invert(double *u, const double *x, size_t n, const buffon_density *g)
{
    const buffon_inversion *how = g->data[0];
    const double *knot = how->x, *F = how->F, total = F[how->count - 1] - F[0];
    for (size_t i = 0; i < n; i++) {
        const size_t k = table_search(knot, how->count, 0, x[i]);
        const double part = (x[i] - knot[k]) / (knot[k + 1] - knot[k]);
        u[i] = density_open(((F[k] - F[0]) + part * (F[k + 1] - F[k])) / total);
    }
    return 0;
}

static uint64_t table_identity(uint64_t mix, const buffon_density *g)
{
    const buffon_inversion *how = g->data[0];
    mix = buffon_priv_mix(mix, how->count);
    mix = density_mix(mix, how->x, how->count);
    return density_mix(mix, how->F, how->count);
}

static const buffon_density_ops table_ops = {.sample = table_draw,
                                             .pdf = table_pdf,
                                             .invert = table_invert,
                                             .identity = table_identity,
                                             .name = "buffon.table"};

static buffon_status table_check(const buffon_inversion *how)
{
    if (!how->x || !how->F)
        return BUFFON_E_NULL;
    if (how->count < 2 || !buffon_priv_isfinite(how->x[how->count - 1] - how->x[0]) ||
        !buffon_priv_isfinite(how->F[how->count - 1] - how->F[0]))
        return BUFFON_E_TABLE;
    for (size_t k = 0; k + 1 < how->count; k++) {
        const double slope = table_slope(how, k);
        if (!(how->x[k] < how->x[k + 1]) || !(how->F[k] < how->F[k + 1]) || !(slope > 0) ||
            !buffon_priv_isfinite(slope))
            return BUFFON_E_TABLE;
    }
    return BUFFON_OK;
}

static buffon_status inversion_check(const buffon_inversion *how)
{
    const int table = how->x || how->F || how->count;
    const int functions = how->quantile || how->cdf || how->pdf;
    for (size_t k = 0; k < sizeof how->reserved / sizeof *how->reserved; k++)
        if (how->reserved[k] != 0)
            return BUFFON_E_RESERVED;
    if (table == functions)
        return BUFFON_E_SHAPE;
    if (table)
        return table_check(how);
    if (!how->quantile && !(how->cdf && how->pdf))
        return BUFFON_E_NULL;
    if (!(how->lo == 0 && how->hi == 0) && !(how->lo < how->hi))
        return BUFFON_E_DOMAIN;
    return BUFFON_OK;
}

buffon_density buffon_inverse(const buffon_inversion *how)
{
    buffon_density g = {.uniforms = 1, .dim = 1, .ops = &inversion_ops, .data = {how, NULL}};
    g.status = how ? inversion_check(how) : BUFFON_E_NULL;
    if (g.status == BUFFON_OK && how->x)
        g.ops = &table_ops;
    else if (g.status == BUFFON_OK && !how->pdf)
        g.ops = &inversion_bare_ops;
    return g;
}

buffon_status buffon_inverse_sample(double *x, double *pdf, double u, const buffon_inversion *how)
{
    const buffon_density g = buffon_inverse(how);
    return buffon_density_sample(x, pdf, &u, 1, &g);
}
