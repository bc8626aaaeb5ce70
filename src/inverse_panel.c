/* The integral of a pdf, as series on panels.
 *
 * A panel has a variable y of its own. Towards an end A of the domain, a pole or infinity it is
 * the log of the distance, x = A + scale e^y, in which a power is smooth at any scale; a stretch
 * without singularity that closes up to a break is taken in x itself. On a panel the pdf by y,
 * g = f dx/dy, is interpolated at the 17 Chebyshev points, and the series integrated term by term.
 * Panels march from the middle of a segment to its ends with steps such that the integral is right:
 *
 *   where much mass lies    to a part of the total so far, which is never more than the total
 *   towards a tail          also to a part of what lies further out, so that the mass beyond any x
 *                           has its relative accuracy
 *
 * A march ends where no mass is left that counts, or where log g has become a straight line in y,
 * which a look at further points confirms: beyond, the law is a power and its integral is
 * g / |slope|.
 */
#include "guard.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <buffon/math.h>

#include "inverse_priv.h"

#define PANEL_LAST (INVERSE_NODES - 1)
#define PANEL_POINTS (INVERSE_NODES + 2) /* two more to test the series at */
#define PANEL_FINE 0x1p-46               /* the shortest step in y */
#define PANEL_FAR 0x1p1022               /* the largest distance from an origin */
#define PANEL_NEAR 0x1p-1010             /* the least */
#define PANEL_FAINT 0x1p-1000            /* below it values of a pdf lose digits */
#define PANEL_CALLS 4000000              /* are enough */
#define PANEL_SLOWEST 0x1p-9 /* a power of |x - A| in the mass below this counts as none */

/* A panel on trial. Index 0 is the end at y0, 1 that at y1. */
typedef struct panel_trial {
    inverse_panel panel;
    double error;    /* of its mass */
    double peak;     /* largest g */
    double g[2];     /* pdf by y at the ends */
    double slope[2]; /* derivative of log g there */
} panel_trial;

/* A march towards an end. */
typedef struct panel_march {
    inverse_map map;
    double y, stop, step;
    double slope;    /* the last known d log g / dy */
    double relative; /* least error of tries that failed, relative to the panel's size */
    int stale;       /* times that a shorter step did not make it less */
    int power;       /* g continues as a power from y_power on */
    double y_power, g_power;
} panel_march;

int buffon_priv_inverse_refuse(inverse_builder *b, buffon_status status, const char *why,
                               double where)
{
    b->report->status = status;
    b->report->why = why;
    b->report->where = where;
    return 1;
}

/* sum a[k] T_k(s) by Clenshaw's recurrence. */
static double panel_series(const double *a, size_t terms, double s)
{
    double b1 = 0, b2 = 0;
    for (size_t k = terms; k-- > 1;) {
        const double b0 = a[k] + (2 * s * b1 - b2);
        b2 = b1;
        b1 = b0;
    }
    return a[0] + (s * b1 - b2);
}

double buffon_priv_inverse_part(const inverse_panel *p, double y)
{
    double s = (2 * y - (p->y0 + p->y1)) / (p->y1 - p->y0);
    s = s < -1 ? -1 : s > 1 ? 1 : s;
    const double part = panel_series(p->a, INVERSE_TERMS, s);
    return part < 0 ? 0 : part > p->mass ? p->mass : part;
}

/* f at x inside the domain. An x that rounding has put on the origin of its map is moved off it. */
static int panel_call(double *f, double x, inverse_builder *b)
{
    const buffon_inverse_law *law = b->law;
    if (b->report->calls++ > PANEL_CALLS)
        return buffon_priv_inverse_refuse(b, BUFFON_E_PDF, "no end of calls: name the breaks", x);
    *f = law->pdf(x, law->ctx);
    if (*f >= 0 && *f <= DBL_MAX)
        return 0;
    return buffon_priv_inverse_refuse(b, BUFFON_E_PDF,
                                      *f < 0     ? "the pdf is negative here"
                                      : *f != *f ? "the pdf is not a number here"
                                                 : "the pdf is infinite here: name the pole",
                                      x);
}

static double panel_largest(const double *v, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = v[i] > most ? v[i] : most;
    return most;
}

/* g = f dx/dy in units of a power of two near the first g that is not 0, so that the tails of laws
 * of any scale stay within the doubles. */
static void panel_scale(double *g, const double *f, const double *by_y, size_t n,
                        inverse_builder *b)
{
    if (b->unit == 0) {
        double most = 0;
        int k;
        for (size_t i = 0; i < n; i++)
            most = f[i] * by_y[i] > most ? f[i] * by_y[i] : most;
        (void)buffon_priv_frexp(&k, most);
        if (most > 0 && most <= DBL_MAX)
            b->unit = buffon_priv_ldexp(1, k > 1000 ? -1000 : k < -1000 ? 1000 : -k);
    }
    for (size_t i = 0; i < n; i++)
        g[i] = f[i] * (by_y[i] * (b->unit != 0 ? b->unit : 1));
}

/* g at the points y[n] of a map. Where the origin is not 0 the
 * distance that is left after x has been rounded differs from that wanted; what that is worth is
 * made good by the slope. A straight map keeps off its ends. */
static int panel_values(double *g, const double *y, size_t n, const panel_march *m, double from,
                        double to, inverse_builder *b)
{
    double distance[PANEL_POINTS], f[PANEL_POINTS], by_y[PANEL_POINTS];
    b->faint = 0;
    if (m->power) {
        for (size_t i = 0; i < n; i++)
            g[i] = m->g_power * buffon_priv_exp(m->slope * (y[i] - m->y_power));
        return 0;
    }
    if (m->map.scale != 0)
        buffon_math_exp(distance, y, n);
    for (size_t i = 0; i < n; i++) {
        double x = y[i];
        by_y[i] = 1;
        if (m->map.scale != 0) {
            const double wanted = m->map.scale * distance[i];
            x = m->map.origin + wanted;
            const double reached = x - m->map.origin, off = (wanted - reached) / reached;
            by_y[i] = buffon_priv_abs(reached) *
                      (buffon_priv_abs(off) < 0x1p-28
                           ? 1 + m->slope * off
                           : buffon_priv_exp(m->slope * buffon_priv_log1p(off)));
        } else {
            x = x <= from ? buffon_priv_nextup(from) : x >= to ? buffon_priv_nextdown(to) : x;
        }
        if (panel_call(&f[i], x, b))
            return 1;
        b->faint |= f[i] > 0 && f[i] < PANEL_FAINT;
    }
    panel_scale(g, f, by_y, n, b);
    return 0;
}

/* Chebyshev coefficients of the polynomial through v at the points cos(j pi / 16). */
static void panel_transform(double *c, const double *v, const inverse_builder *b)
{
    double even[PANEL_LAST / 2 + 1], odd[PANEL_LAST / 2 + 1];
    for (size_t j = 0; j < PANEL_LAST / 2; j++) {
        const double half = j == 0 ? 0.5 : 1;
        even[j] = half * (v[j] + v[PANEL_LAST - j]);
        odd[j] = half * (v[j] - v[PANEL_LAST - j]);
    }
    even[PANEL_LAST / 2] = v[PANEL_LAST / 2];
    odd[PANEL_LAST / 2] = 0;
    for (size_t k = 0; k <= PANEL_LAST; k++) {
        const double *w = k % 2 ? odd : even;
        double sum = 0;
        for (size_t j = 0; j <= PANEL_LAST / 2; j++)
            sum += w[j] * b->cosine[j * k % (2 * PANEL_LAST)];
        c[k] = sum * (k == 0 || k == PANEL_LAST ? 1.0 / PANEL_LAST : 2.0 / PANEL_LAST);
    }
}

/* The series of the integral from s = -1 of the series c, times `half`. */
static void panel_integrate(double *a, const double *c, double half)
{
    double start = 0;
    for (size_t k = 1; k <= PANEL_LAST + 1; k++) {
        const double before = k == 1 ? 2 * c[0] : c[k - 1];
        const double after = k + 1 <= PANEL_LAST ? c[k + 1] : 0;
        a[k] = half * (before - after) / (double)(2 * k);
        start += k % 2 ? a[k] : -a[k];
    }
    a[0] = start;
}

/* The derivatives of the series c at s = -1 and 1. */
static void panel_slopes(double out[2], const double *c, size_t terms)
{
    out[0] = out[1] = 0;
    for (size_t k = terms; k-- > 1;) {
        const double term = (double)(k * k) * c[k];
        out[0] += k % 2 ? term : -term;
        out[1] += term;
    }
}

/* From values of the pdf by y. */
static void panel_of_pdf(panel_trial *t, const double *g, const double *c, double half)
{
    double slopes[2];
    const double tail = buffon_priv_abs(c[PANEL_LAST]) + buffon_priv_abs(c[PANEL_LAST - 1]) +
                        0.25 * buffon_priv_abs(c[PANEL_LAST - 2]);
    panel_integrate(t->panel.a, c, half);
    panel_slopes(slopes, c, INVERSE_NODES);
    t->error = half * tail / PANEL_LAST;
    t->peak = panel_largest(g, PANEL_POINTS);
    t->g[0] = g[PANEL_LAST];
    t->g[1] = g[0];
    for (int k = 0; k < 2; k++)
        t->slope[k] = t->g[k] > 0 ? slopes[k] / (half * t->g[k]) : 0;
}

/* Tries the panel from y0 to y1. */
static int panel_try(panel_trial *t, double y0, double y1, const panel_march *m, inverse_builder *b)
{
    static const double tests[2] = {-0.8731, 0.9287};
    const double half = 0.5 * (y1 - y0), middle = 0.5 * (y0 + y1);
    double y[PANEL_POINTS], v[PANEL_POINTS], c[INVERSE_NODES], miss = 0;
    t->panel.map = m->map;
    t->panel.y0 = y0;
    t->panel.y1 = y1;
    for (size_t j = 0; j <= PANEL_LAST; j++)
        y[j] = j == 0 ? y1 : j == PANEL_LAST ? y0 : middle + half * b->cosine[j];
    for (size_t k = 0; k < 2; k++)
        y[INVERSE_NODES + k] = middle + half * tests[k];
    if (panel_values(v, y, PANEL_POINTS, m, y0, y1, b))
        return 1;
    panel_transform(c, v, b);
    for (size_t k = 0; k < 2; k++) {
        const double gap = panel_series(c, INVERSE_NODES, tests[k]) - v[INVERSE_NODES + k];
        miss = buffon_priv_abs(gap) > miss ? buffon_priv_abs(gap) : miss;
    }
    panel_of_pdf(t, v, c, half);
    miss *= 0.125 * half;
    t->error = miss > t->error ? miss : t->error;
    t->panel.mass = panel_series(t->panel.a, INVERSE_TERMS, 1);
    if (!(t->panel.mass > 0))
        t->panel.mass = 0;
    if (t->peak > 0 && !(t->peak * half <= DBL_MAX))
        return buffon_priv_inverse_refuse(b, BUFFON_E_PDF, "the integral exceeds the doubles",
                                          inverse_x(&m->map, middle));
    return 0;
}

/* The mass beyond the outer end of a panel: as if g went on as a power of the distance, corrected
 * for a slope that changes. 0 if there is none, -1 if g does not fall. `rate` is its ratio to g
 * there. */
static double panel_beyond(double *rate, const panel_trial *t, int up)
{
    const double width = t->panel.y1 - t->panel.y0, falls = up ? -t->slope[1] : t->slope[0];
    double change = up ? t->slope[0] - t->slope[1] : t->slope[1] - t->slope[0];
    *rate = 0;
    if (t->g[up] == 0)
        return 0;
    if (!(falls > 0))
        return -1;
    change = -change / width / (falls * falls); /* derivative of 1 / falls, outwards */
    *rate = (buffon_priv_abs(change) < 0.25 ? 1 + change : 1) / falls;
    return t->g[up] * *rate;
}

static int panel_push(inverse_builder *b, const inverse_panel *p, double error)
{
    if (!(p->mass > 0))
        return 0;
    if (b->count == b->room)
        return buffon_priv_inverse_refuse(b, BUFFON_E_NOMEM, "the memory is too small",
                                          inverse_x(&p->map, p->y0));
    b->panels[b->count++] = *p;
    b->total += p->mass;
    b->error += error;
    return 0;
}

/* A panel of constant g: for one that is too short to matter. */
static void panel_flatten(inverse_panel *p, double mass)
{
    memset(p->a, 0, sizeof p->a);
    p->a[0] = p->a[1] = 0.5 * mass;
    p->mass = mass;
}

/* By how much to change a step when the error goes with its 17th power. */
static double panel_factor(double wanted, double error)
{
    double r = wanted / error;
    if (!(r > 0x1p-40))
        return 0.2;
    if (!(r < 0x1p40))
        return 2.5;
    r = 0.85 * sqrt(sqrt(sqrt(sqrt(r))));
    return r < 0.2 ? 0.2 : r > 2.5 ? 2.5 : r;
}

/* What the mass of a panel may be wrong by. */
static double panel_tolerance(const inverse_builder *b, const panel_trial *t, double beyond,
                              int tail)
{
    const double part = (b->u_error < 0x1p-30 ? b->u_error : 0x1p-30) * 0x1p-7;
    const double so_far = b->total + t->panel.mass;
    const int counts = tail && beyond >= 0 && beyond * 0x1p12 < so_far;
    return part * (counts ? 0x1p12 * beyond : so_far);
}

/* Whether a panel over `step` will do; sets the next step. Shorter steps help where the pdf is
 * smooth, and against a jump; where five in a row do not, what is left is noise of the pdf's own
 * rounding, which no step will mend. */
static int panel_judge(panel_march *m, panel_trial *t, double step, double wanted,
                       inverse_builder *b)
{
    const double size = t->peak * (t->panel.y1 - t->panel.y0);
    const double relative = t->error / size;
    const double noise = 1.5 * b->noise * size, allowed = wanted > noise ? wanted : noise;
    if (t->error <= allowed) {
        /* Never shorter: an error that is noise would drive steps to nothing. */
        const double factor = panel_factor(allowed, t->error);
        m->step = step * (factor > 1 ? factor : 1);
        m->step = m->step < 16 ? m->step : 16;
        m->stale = 0;
        m->relative = (double)INFINITY;
        return 1;
    }
    if (relative < 0.5 * m->relative) {
        m->stale = 0;
        m->relative = relative;
    } else if (++m->stale >= 5 && relative < 1e-6) {
        b->noise = relative > b->noise ? relative : b->noise;
        m->step = 2 * step;
        m->stale = 0;
        m->relative = (double)INFINITY;
        return 1;
    }
    const double factor = panel_factor(wanted, t->error);
    m->step = step * (factor < 0.7 ? factor : 0.7);
    return 0;
}

/* Whether g at points further out is what a straight line of its log says. */
static int panel_is_power(const panel_trial *t, int up, double stop, const panel_march *m,
                          inverse_builder *b)
{
    static const double places[6] = {0.02, 0.06, 0.15, 0.35, 0.7, 1};
    const double from = up ? t->panel.y1 : t->panel.y0, slope = t->slope[up];
    const double change = buffon_priv_abs(t->slope[1] - t->slope[0]);
    double y[6], g[6];
    int seen = 0;
    if (!(t->g[up] > 0) || !(change <= 8 * b->u_error * buffon_priv_abs(slope)))
        return 0;
    for (int k = 0; k < 6; k++)
        y[k] = from + places[k] * (stop - from);
    if (panel_values(g, y, 6, m, 0, 0, b))
        return -1;
    for (int k = 0; k < 6; k++) {
        const double line = slope * (y[k] - from), expected = t->g[up] * buffon_priv_exp(line);
        const double slack = 0x1p-30 + 0x1p-38 * buffon_priv_abs(line);
        /* A pdf that has left the doubles says nothing. */
        if (g[k] == 0 && expected < 1e-30 * b->total)
            continue;
        if (expected > DBL_MIN && !(buffon_priv_abs(g[k] - expected) <= slack * expected))
            return 0;
        seen++;
    }
    return seen >= 2;
}

/* What the end of a tail comes to. */
static int panel_end(inverse_builder *b, double beyond, double rate, int side)
{
    const double end = side ? b->hi : b->lo;
    if (beyond < 0 || (rate > 0 && !(rate * PANEL_SLOWEST < 1)))
        return buffon_priv_inverse_refuse(b, BUFFON_E_PDF, "the integral is infinite towards here",
                                          end);
    if (beyond == 0)
        rate = 0;
    b->residual[side] = beyond;
    b->rate[side] = rate;
    return 0;
}

/* The march that begins at a distance from `origin`. */
static panel_march panel_start(double origin, double sign, double distance)
{
    int k;
    const double part = buffon_priv_frexp(&k, distance), scale = buffon_priv_ldexp(sign, k);
    return (panel_march){.map = {origin, scale},
                         .y = buffon_priv_log(part),
                         .step = 1,
                         .slope = 1,
                         .relative = (double)INFINITY};
}

/* Large y would cost digits: the scale follows. */
static void panel_rescale(panel_march *m)
{
    if (m->power || buffon_priv_abs(m->y) < 32)
        return;
    const double scale = buffon_priv_abs(m->map.scale), distance = scale * buffon_priv_exp(m->y);
    panel_march next = panel_start(m->map.origin, m->map.scale < 0 ? -1 : 1, distance);
    next.stop = m->stop + (next.y - m->y);
    next.slope = m->slope;
    next.step = m->step;
    *m = next;
}

/* The state of a march through a tail. */
typedef struct panel_tail_end {
    double beyond, rate; /* mass left, and its ratio to g */
    int strict;          /* its relative accuracy is kept */
    int creeping;        /* steps in a row far shorter than so smooth a law should need */
} panel_tail_end;

/* From here on there is no relative accuracy: by a jump that was not told, a pdf that leaves the
 * doubles, or noise. Whether the march may end here. */
static int panel_give_up(inverse_builder *b, panel_tail_end *end, int side)
{
    if (end->strict)
        b->reached[side] = end->beyond > 0 ? 1e4 * end->beyond : b->total;
    end->strict = 0;
    return end->beyond > 0 && end->beyond < 1e-20 * b->total;
}

/* Whether a march has come to the end of the tail: 1 if so, -1 on refusal. */
static int panel_is_over(inverse_builder *b, const panel_trial *t, const panel_tail_end *end,
                         const panel_march *m, int up)
{
    if (end->beyond >= 0 && end->beyond < 1e-4 * b->tail * b->total && t->g[up] > 0)
        return 1;
    /* Not before the tail begins. */
    if (!(end->beyond > 0 && end->beyond < 0x1p-12 * b->total))
        return 0;
    const double depth = buffon_priv_log(end->beyond / b->total) - buffon_priv_log(b->tail);
    double far = m->y + (up ? 1 : -1) * (depth > 0 ? depth : 0) * end->rate;
    far = (up ? far < m->stop : far > m->stop) ? far : m->stop;
    return panel_is_power(t, up, far < 700 ? far : 700, m, b);
}

/* Marches through a tail: towards infinity (up) or to an end of the domain. */
static int panel_tail(inverse_builder *b, panel_march *m, int up, int side)
{
    panel_tail_end end = {0, 0, 1, 0};
    for (int over = 0; !over && (up ? m->y < m->stop : m->y > m->stop);) {
        panel_rescale(m);
        const double left = up ? m->stop - m->y : m->y - m->stop;
        const double step = m->step < left ? m->step : left;
        const double next = m->step < left ? m->y + (up ? step : -step) : m->stop;
        panel_trial t;
        if (panel_try(&t, up ? m->y : next, up ? next : m->y, m, b))
            return 1;
        if ((b->faint || t.peak == 0) && end.beyond > 0 && end.beyond < 1e-20 * b->total) {
            panel_give_up(b, &end, side);
            break;
        }
        double rate;
        const double ahead = panel_beyond(&rate, &t, up);
        if (!panel_judge(m, &t, step, panel_tolerance(b, &t, ahead, end.strict), b)) {
            if (step > PANEL_FINE)
                continue;
            if (panel_give_up(b, &end, side))
                break;
            panel_flatten(&t.panel, t.panel.mass);
            t.error = t.peak * step;
            m->step = 4 * step;
        }
        const int creeps = step < 0.02 && step < 0.02 * rate;
        end.creeping = creeps ? end.creeping + 1 : 0;
        if (end.creeping > 12 && panel_give_up(b, &end, side))
            break;
        if (end.strict && ahead > 0 && t.error > b->tail_error * ahead)
            b->tail_error = t.error / ahead;
        if (panel_push(b, &t.panel, t.error))
            return 1;
        m->y = next;
        m->slope = t.slope[up] != 0 ? t.slope[up] : m->slope;
        end.beyond = ahead;
        end.rate = rate;
        over = panel_is_over(b, &t, &end, m, up);
        if (over < 0)
            return 1;
    }
    return panel_end(b, end.beyond, end.rate, side);
}

/* Takes all that is left between the origin of the map and y in one panel, if that is smooth.
 * Returns 1 if so, -1 on refusal. */
static int panel_close(inverse_builder *b, const panel_march *m)
{
    const double near = m->map.origin, far = inverse_x(&m->map, m->y);
    const panel_march straight = {.map = {far, 0}};
    panel_trial t;
    if (near == far)
        return 1;
    if (panel_try(&t, near < far ? near : far, near < far ? far : near, &straight, b))
        return -1;
    if (!(t.error <= panel_tolerance(b, &t, 0, 0)))
        return 0;
    return panel_push(b, &t.panel, t.error) ? -1 : 1;
}

/* The last of a pole, of constant pdf: too little mass to matter, but the support has no hole. */
static int panel_sliver(inverse_builder *b, const panel_march *m, double mass)
{
    const double near = m->map.origin, far = inverse_x(&m->map, m->y);
    inverse_panel p = {
        .map = {far, 0}, .y0 = near < far ? near : far, .y1 = near < far ? far : near};
    panel_flatten(&p, mass);
    return near == far ? 0 : panel_push(b, &p, mass);
}

/* Marches to a break or pole within the domain. Where x has no more doubles to resolve a pole, the
 * power goes on. */
static int panel_inner(inverse_builder *b, panel_march *m, int pole)
{
    double beyond = 0, rate = 0;
    for (;;) {
        panel_rescale(m);
        const int closed = pole || m->power ? 0 : panel_close(b, m);
        if (closed)
            return closed < 0;
        while (!(m->stop < m->y)) {
            if (m->power || beyond < 0 || !(rate * PANEL_SLOWEST < 1))
                return m->power
                           ? panel_sliver(b, m, beyond)
                           : buffon_priv_inverse_refuse(b, BUFFON_E_PDF,
                                                        "the integral is infinite towards here",
                                                        m->map.origin);
            m->power = 1;
            m->y_power = m->y;
            m->g_power = rate > 0 ? beyond / rate : 0;
            m->stop = m->y - 60 * (rate > 0 ? rate : 1);
        }
        const double left = m->y - m->stop, step = m->step < left ? m->step : left;
        const double next = m->step < left ? m->y - step : m->stop;
        panel_trial t;
        if (panel_try(&t, next, m->y, m, b))
            return 1;
        const double wanted = panel_tolerance(b, &t, 0, 0);
        if (!panel_judge(m, &t, step, wanted, b)) {
            if (step > PANEL_FINE && t.peak * step > wanted)
                continue;
            panel_flatten(&t.panel, t.panel.mass);
            t.error = t.peak * step;
            m->step = 4 * step;
        }
        if (panel_push(b, &t.panel, t.error))
            return 1;
        m->y = next;
        m->slope = t.slope[0] != 0 && !m->power ? t.slope[0] : m->slope;
        beyond = panel_beyond(&rate, &t, 0);
        if (beyond >= 0 && beyond <= b->u_error * 0x1p-10 * b->total)
            return panel_sliver(b, m, beyond);
    }
}

/* ---- segments ---- */

typedef enum panel_kind { PANEL_BREAK, PANEL_POLE, PANEL_DOMAIN } panel_kind;

/* The panels from `first` on were made from right to left. */
static void panel_reverse(inverse_builder *b, size_t first)
{
    for (size_t i = first, j = b->count; i + 1 < j; i++) {
        const inverse_panel swap = b->panels[i];
        b->panels[i] = b->panels[--j];
        b->panels[j] = swap;
    }
}

/* From the point at a distance from `origin` to it. */
static int panel_towards(inverse_builder *b, double origin, double sign, double distance,
                         panel_kind kind)
{
    panel_march m = panel_start(origin, sign, distance);
    const double near = buffon_priv_abs(origin) * (kind == PANEL_DOMAIN ? 0x1p-46 : 0x1p-40);
    m.stop =
        buffon_priv_log((near > PANEL_NEAR ? near : PANEL_NEAR) / buffon_priv_abs(m.map.scale));
    const size_t first = b->count;
    const int refused = kind == PANEL_DOMAIN ? panel_tail(b, &m, 0, sign < 0)
                                             : panel_inner(b, &m, kind == PANEL_POLE);
    if (sign > 0)
        panel_reverse(b, first);
    return refused;
}

/* From a distance of `origin` to infinity. */
static int panel_to_infinity(inverse_builder *b, double origin, double sign, double distance)
{
    panel_march m = panel_start(origin, sign, distance);
    m.stop = buffon_priv_log(PANEL_FAR) - buffon_priv_log(buffon_priv_abs(m.map.scale));
    const size_t first = b->count;
    const int refused = panel_tail(b, &m, 1, sign > 0);
    if (sign < 0)
        panel_reverse(b, first);
    return refused;
}

/* The distance from `origin`, a power of two, about which most of the mass by the log of the
 * distance lies; 0 if all is nought. */
static int panel_scan(double *distance, inverse_builder *b, double origin, double sign)
{
    double most = 0;
    *distance = 0;
    for (int k = -1020; k <= 1020; k += 6) {
        const double r = buffon_priv_ldexp(1, k), x = origin + sign * r;
        double f, g;
        if (x == origin || r < 0x1p-40 * buffon_priv_abs(origin))
            continue;
        f = b->law->pdf(x, b->law->ctx);
        b->report->calls++;
        g = f * r;
        if (g > most && g <= DBL_MAX) {
            most = g;
            *distance = r;
        }
    }
    return 0;
}

static int panel_segment(inverse_builder *b, double from, double to, panel_kind from_kind,
                         panel_kind to_kind)
{
    double distance;
    if (from >= -DBL_MAX && to <= DBL_MAX) {
        const double middle = 0.5 * from + 0.5 * to;
        if (!(middle > from && middle < to))
            return 0;
        return panel_towards(b, from, 1, middle - from, from_kind) ||
               panel_towards(b, to, -1, to - middle, to_kind);
    }
    if (from >= -DBL_MAX)
        return panel_scan(&distance, b, from, 1) ||
               (distance > 0 && (panel_towards(b, from, 1, distance, from_kind) ||
                                 panel_to_infinity(b, from, 1, distance)));
    return panel_scan(&distance, b, to, -1) ||
           (distance > 0 && (panel_to_infinity(b, to, -1, distance) ||
                             panel_towards(b, to, -1, distance, to_kind)));
}

/* The next break, pole or end to the right of x. */
static double panel_next(panel_kind *kind, const inverse_builder *b, double x)
{
    const buffon_inverse_law *law = b->law;
    double next = b->hi;
    *kind = PANEL_DOMAIN;
    if (b->lo < -DBL_MAX || b->hi > DBL_MAX) {
        if (b->centre > x && b->centre < next) {
            next = b->centre;
            *kind = PANEL_BREAK;
        }
    }
    for (size_t k = 0; k < law->breaks_count; k++) {
        if (law->breaks[k] > x && law->breaks[k] < next) {
            next = law->breaks[k];
            *kind = PANEL_BREAK;
        }
    }
    for (size_t k = 0; k < law->poles_count; k++) {
        if (law->poles[k] > x && law->poles[k] <= next && law->poles[k] < b->hi) {
            next = law->poles[k];
            *kind = PANEL_POLE;
        }
    }
    return next;
}

/* The masses to the left and right of each panel, both added up from the far end. */
static void panel_add_up(inverse_builder *b)
{
    double sum = b->residual[0];
    for (size_t k = 0; k < b->count; k++) {
        b->panels[k].below = sum;
        sum += b->panels[k].mass;
    }
    b->total = sum + b->residual[1];
    sum = b->residual[1];
    for (size_t k = b->count; k-- > 0;) {
        b->panels[k].above = sum;
        sum += b->panels[k].mass;
    }
}

int buffon_priv_inverse_integrate(inverse_builder *b)
{
    panel_kind kind = PANEL_DOMAIN, next_kind;
    for (int k = 0; k < 2 * PANEL_LAST; k++)
        b->cosine[k] = buffon_priv_cospi((double)k / PANEL_LAST);
    for (double x = b->lo; x < b->hi;) {
        const double next = panel_next(&next_kind, b, x);
        if (panel_segment(b, x, next, kind, next_kind))
            return 1;
        x = next;
        kind = next_kind;
    }
    if (!(b->total > 0) || b->count == 0)
        return buffon_priv_inverse_refuse(b, BUFFON_E_PDF,
                                          "the pdf is zero wherever it was called: set a centre",
                                          b->lo < -DBL_MAX || b->hi > DBL_MAX ? b->centre : b->lo);
    /* A tail that ends within the doubles: something is left for the logarithm to be finite. */
    if (!(b->residual[0] > 0))
        b->residual[0] = b->panels[0].mass * 0x1p-70;
    if (!(b->residual[1] > 0))
        b->residual[1] = b->panels[b->count - 1].mass * 0x1p-70;
    panel_add_up(b);
    if (!(b->total <= DBL_MAX))
        return buffon_priv_inverse_refuse(b, BUFFON_E_PDF, "the integral exceeds the doubles",
                                          b->lo);
    return 0;
}
