/* The rows of a table: polynomials through points (t, v) of the quantile function, t and v as in
 * inverse_priv.h. The points are where the panels say them to be, chosen by y, so that no equation
 * is solved; a walk over the panels takes steps in y such that the polynomial, between its points,
 * is off by no more than is wanted. A run is a stretch of panels with one variable y.
 */
#include "guard.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <buffon/math.h>

#include "inverse_priv.h"

#define BUILD_NODES 6
#define BUILD_POINTS (2 * BUILD_NODES - 1) /* with one between each two */
#define BUILD_TAIL 0x1p-10                 /* p at which the tails begin */
#define BUILD_MARGIN 0.7                   /* of the error allowed that is aimed at */
#define BUILD_TRIES 1000000                /* of rows are enough */
#define BUILD_LEAST ((size_t)1 << 19)      /* bytes of workspace to begin with */
#define BUILD_MOST ((size_t)1 << 25)

typedef enum build_part { BUILD_LOWER, BUILD_UPPER, BUILD_CENTRE } build_part;

/* A place in a panel. */
typedef struct build_place {
    size_t panel;
    double y;
} build_place;

typedef struct build_walk {
    inverse_builder *b;
    buffon_inverse_table *table;
    inverse_row *row, *last; /* the next one, and the end of the room for them */
    build_part part;
    int right;           /* goes to the right */
    size_t far;          /* its last panel */
    double t, v;         /* where the last row ended */
    double slope;        /* dv/dt there */
    double error, worst; /* allowed, and the largest measured */
    double strict;       /* the t from which on it is */
    long tries;
} build_walk;

/* ---- points ---- */

/* Whether y grows to the right. */
static int build_rises(const inverse_panel *p)
{
    return p->map.scale >= 0;
}

/* The end of a panel at its right or left side. */
static double build_side(const inverse_panel *p, int right)
{
    return build_rises(p) == right ? p->y1 : p->y0;
}

/* The masses to the left and to the right of y. */
static void build_masses(double *below, double *above, const inverse_panel *p, double y)
{
    const double part = buffon_priv_inverse_part(p, y), rest = p->mass - part;
    *below = p->below + (build_rises(p) ? part : rest);
    *above = p->above + (build_rises(p) ? rest : part);
}

static int build_same_run(const inverse_panel *p, const inverse_panel *q)
{
    return p->map.origin == q->map.origin && p->map.scale == q->map.scale &&
           (p->y0 == q->y1 || p->y1 == q->y0);
}

/* The points at y[n], which go along the walk from the panel k on and stay in its run. */
static void build_points(double *t, double *v, const double *y, size_t n, size_t k,
                         const build_walk *w)
{
    const inverse_panel *p = &w->b->panels[k];
    const inverse_map map = p->map;
    const int tail = w->part != BUILD_CENTRE, up = build_rises(p) == w->right;
    for (size_t i = 0; i < n; i++) {
        double below, above;
        while (up ? y[i] > p->y1 : y[i] < p->y0) {
            const inverse_panel *next = w->right ? p + 1 : p - 1;
            if (next < w->b->panels || next >= w->b->panels + w->b->count ||
                !build_same_run(p, next))
                break;
            p = next;
        }
        build_masses(&below, &above, p, y[i]);
        t[i] = (w->part == BUILD_UPPER ? above : below) / w->b->total;
    }
    if (map.scale == 0) {
        memcpy(v, y, n * sizeof *v);
    } else {
        buffon_math_exp(v, y, n);
        for (size_t i = 0; i < n; i++)
            v[i] = map.origin + map.scale * v[i];
    }
    if (!tail)
        return;
    const double end = w->table->end[w->part], sign = w->table->sign[w->part];
    buffon_math_log(t, t, n);
    if (map.scale * sign > 0 && map.origin == end) {
        const double log_scale = buffon_priv_log(buffon_priv_abs(map.scale));
        for (size_t i = 0; i < n; i++)
            v[i] = y[i] + log_scale;
    } else {
        for (size_t i = 0; i < n; i++)
            v[i] = (v[i] - end) * sign;
        buffon_math_log(v, v, n);
    }
}

/* ---- one row ---- */

/* Newton's divided differences of v at w, turned into powers of w. */
static void build_interpolate(double *c, const double *w, const double *v)
{
    double d[BUILD_NODES];
    memcpy(d, v, sizeof d);
    for (size_t k = 1; k < BUILD_NODES; k++)
        for (size_t i = BUILD_NODES; i-- > k;)
            d[i] = (d[i] - d[i - 1]) / (w[i] - w[i - k]);
    memset(c, 0, BUILD_NODES * sizeof *c);
    for (size_t k = BUILD_NODES; k-- > 0;) {
        for (size_t i = BUILD_NODES - 1; i > 0; i--)
            c[i] = c[i - 1] - w[k] * c[i];
        c[0] = d[k] - w[k] * c[0];
    }
}

/* Whether c1 + 2 c2 w + ... has one sign on [0, 1], by its Bernstein coefficients, and so far from
 * 0 that rounding does not count. */
static int build_is_monotone(const double *c)
{
    static const double ratio[5][5] = {{1, 0, 0, 0, 0},
                                       {1, 0.25, 0, 0, 0},
                                       {1, 0.5, 1.0 / 6, 0, 0},
                                       {1, 0.75, 0.5, 0.25, 0},
                                       {1, 1, 1, 1, 1}};
    double size = 0;
    for (size_t j = 0; j < 5; j++)
        size += buffon_priv_abs((double)(j + 1) * c[j + 1]);
    for (size_t i = 0; i < 5; i++) {
        double value = 0;
        for (size_t j = 0; j <= i; j++)
            value += ratio[i][j] * (double)(j + 1) * c[j + 1];
        if (!(c[1] > 0 ? value > 0x1p-40 * size : value < -0x1p-40 * size))
            return 0;
    }
    return 1;
}

/* The row through the points from (w->t, w->v) to y[BUILD_POINTS - 1], and its error in t beyond
 * what the rounding of x is worth: infinite where there is no such polynomial. */
static double build_row(inverse_row *row, double *t, double *v, size_t k, const double *y,
                        const build_walk *w)
{
    double at[BUILD_POINTS], node[BUILD_NODES], value[BUILD_NODES], c[BUILD_NODES], worst = 0;
    build_points(t, v, y, BUILD_POINTS, k, w);
    t[0] = w->t;
    v[0] = w->v;
    const double width = t[BUILD_POINTS - 1] - t[0];
    for (size_t i = 0; i < BUILD_POINTS; i++) {
        at[i] = (t[i] - t[0]) / width;
        if (i > 0 && !(at[i] > at[i - 1]))
            return (double)INFINITY;
        if (i % 2 == 0) {
            node[i / 2] = at[i];
            value[i / 2] = v[i] - v[0];
        }
    }
    build_interpolate(c, node, value);
    if (!build_is_monotone(c))
        return (double)INFINITY;
    *row = (inverse_row){.from = 0, .to = 1};
    memcpy(row->c, c, sizeof c);
    for (size_t i = 1; i < BUILD_POINTS; i += 2) {
        double slope;
        const double off = buffon_priv_abs(inverse_value(&slope, row, at[i]) - (v[i] - v[0]));
        const double rounding = w->part == BUILD_CENTRE ? 0x1p-52 * buffon_priv_abs(v[i]) : 0;
        const double error = buffon_priv_abs((off > rounding ? off - rounding : 0) / slope * width);
        worst = error > worst ? error : worst;
    }
    double scale = 1;
    for (size_t i = 0; i < BUILD_NODES; i++, scale *= 1 / width)
        row->c[i] = i == 0 ? v[0] : c[i] * scale;
    row->from = t[0];
    row->to = t[BUILD_POINTS - 1];
    return buffon_priv_isfinite(row->c[5]) ? worst : (double)INFINITY;
}

/* ---- walks ---- */

static int build_emit(build_walk *w, const inverse_row *row, double t, double v)
{
    if (w->row == w->last)
        return buffon_priv_inverse_refuse(w->b, BUFFON_E_NOMEM, "the memory is too small", v);
    *w->row++ = *row;
    inverse_value(&w->slope, row, row->to - row->from);
    w->t = t;
    w->v = v;
    return 0;
}

/* Whether t and v at the end of a step lie on the right side of where it began. */
static int build_goes_on(const build_walk *w, double t, double v)
{
    if (w->part == BUILD_CENTRE)
        return t > w->t && v >= w->v;
    const int opens = w->table->sign[w->part] > 0 ? w->right : !w->right;
    return t < w->t && (opens ? v >= w->v : v <= w->v);
}

/* A straight row, for a step too short to matter. v changes by an ulp at least, so that there is a
 * pdf. Where t does not go on x jumps instead. */
static int build_straight(build_walk *w, double t, double v)
{
    const int falls = w->part != BUILD_CENTRE && (w->table->sign[w->part] > 0) != w->right;
    double end = v;
    if (!build_goes_on(w, t, v)) {
        w->v = v;
        return 0;
    }
    if (v == w->v)
        end = falls ? buffon_priv_nextdown(v) : buffon_priv_nextup(v);
    const inverse_row row = {.from = w->t, .to = t, .c = {w->v, (end - w->v) / (t - w->t)}};
    return build_emit(w, &row, t, v);
}

/* Whether x has no more than a few doubles for a step. */
static int build_is_dense(const build_walk *w, double v)
{
    return w->part == BUILD_CENTRE && buffon_priv_abs(v - w->v) <= 0x1p-48 * buffon_priv_abs(v);
}

/* Whether a step is too short to matter otherwise: in t or in y. */
static int build_is_tiny(const build_walk *w, double t, double y, double step, double error)
{
    return buffon_priv_abs(t - w->t) <= 0.25 * error || step <= 0x1p-50 * buffon_priv_abs(y) ||
           step < 0x1p-1000;
}

/* The points of a row from y over a step towards `end`. */
static void build_places(double *points, double y, double step, double end)
{
    /* (1 - cos(k pi / 5)) / 2 and the middles between. */
    static const double places[BUILD_POINTS] = {0,
                                                0.045,
                                                0.0954915028125263,
                                                0.21,
                                                0.3454915028125263,
                                                0.5,
                                                0.6545084971874737,
                                                0.79,
                                                0.9045084971874737,
                                                0.955,
                                                1};
    for (size_t i = 0; i < BUILD_POINTS; i++)
        points[i] = y + (end > y ? step : -step) * places[i];
    if (step == buffon_priv_abs(end - y))
        points[BUILD_POINTS - 1] = end;
}

/* From y to the end of a stretch of one run that begins in panel k. Where nothing fits, because the
 * integral is not known well enough, steps too short to matter lengthen while they follow one
 * another. */
static int build_stretch(build_walk *w, size_t k, double y, double end)
{
    const inverse_panel *p = &w->b->panels[k];
    double step = (p->y1 - p->y0) / 8, patience = 1;
    while (y != end) {
        /* Beyond the place where the integral has no relative accuracy the rows need none. */
        const double loose = w->b->u_error / buffon_priv_exp(w->t);
        const double error = w->t >= w->strict ? w->error : loose < 0.25 ? loose : 0.25;
        const double left = buffon_priv_abs(end - y);
        double points[BUILD_POINTS], t[BUILD_POINTS], v[BUILD_POINTS];
        inverse_row row;
        step = step > 0.999 * left ? left : step > 0.5 * left ? 0.5 * left : step;
        build_places(points, y, step, end);
        while (k != w->far && (end > y ? y >= p->y1 : y <= p->y0)) {
            k = w->right ? k + 1 : k - 1;
            p = &w->b->panels[k];
        }
        if (++w->tries > BUILD_TRIES)
            return buffon_priv_inverse_refuse(w->b, BUFFON_E_PDF, "no end of steps near here",
                                              inverse_x(&p->map, y));
        const double off = build_row(&row, t, v, k, points, w);
        const double t1 = t[BUILD_POINTS - 1], v1 = v[BUILD_POINTS - 1];
        const double ratio = BUILD_MARGIN * error / off, root = buffon_priv_cbrt(sqrt(ratio));
        if (ratio >= 1) {
            if (error == w->error && off > w->worst)
                w->worst = off;
            if (build_emit(w, &row, t1, v1))
                return 1;
            patience = 1;
            step *= ratio < 2e3 ? 0.85 * root : 3;
        } else if (!build_is_dense(w, v1) &&
                   !build_is_tiny(w, t1, y, step / patience, error * patience)) {
            step *= ratio < 1e-4 ? 0.2 : root < 0.9 ? 0.85 * root : 0.8;
            continue;
        } else {
            const double width = buffon_priv_abs(t1 - w->t);
            if (!build_is_dense(w, v1)) {
                w->worst = error == w->error && width > w->worst ? width : w->worst;
                patience *= 2;
            }
            if (build_straight(w, t1, v1))
                return 1;
            step *= 2;
        }
        y = points[BUILD_POINTS - 1];
    }
    return 0;
}

/* From one place to another, run after run. Between runs x may jump, over a gap of the law. */
static int build_walk_over(build_walk *w, build_place from, build_place to)
{
    size_t k = from.panel;
    double y = from.y;
    w->far = to.panel;
    build_points(&w->t, &w->v, &y, 1, k, w);
    for (;;) {
        size_t last = k;
        while (last != to.panel) {
            const size_t next = w->right ? last + 1 : last - 1;
            if (!build_same_run(&w->b->panels[last], &w->b->panels[next]))
                break;
            last = next;
        }
        const double end = last == to.panel ? to.y : build_side(&w->b->panels[last], w->right);
        if (build_stretch(w, k, y, end))
            return 1;
        if (last == to.panel)
            return 0;
        double t, v;
        k = w->right ? last + 1 : last - 1;
        y = build_side(&w->b->panels[k], !w->right);
        build_points(&t, &v, &y, 1, k, w);
        w->v = w->part == BUILD_CENTRE && v < w->v ? w->v : v;
    }
}

/* Where a part `p` of the total lies below, or above. */
static build_place build_find(const inverse_builder *b, double p, int upper)
{
    const double wanted = p * b->total;
    size_t k = upper ? b->count - 1 : 0;
    while (k != (upper ? 0 : b->count - 1)) {
        const inverse_panel *panel = &b->panels[k];
        if ((upper ? panel->above : panel->below) + panel->mass > wanted)
            break;
        k += upper ? (size_t)-1 : 1u;
    }
    const inverse_panel *panel = &b->panels[k];
    double y0 = panel->y0, y1 = panel->y1;
    for (int i = 0; i < 60; i++) {
        const double y = 0.5 * (y0 + y1);
        double below, above;
        build_masses(&below, &above, panel, y);
        /* Both grow with y, or fall. */
        if (((upper ? above : below) < wanted) == (build_rises(panel) != upper))
            y0 = y;
        else
            y1 = y;
    }
    return (build_place){k, y0};
}

/* The straight line that goes on beyond the last panel. */
static void build_outermost(build_walk *w, const inverse_panel *p)
{
    const int side = w->part == BUILD_UPPER;
    const double y = build_side(p, side), x = inverse_x(&p->map, y);
    const double by_y = p->map.scale == 0 ? 1 : buffon_priv_abs(x - p->map.origin);
    double slope = w->slope;
    if (w->b->rate[side] > 0) {
        slope = w->b->rate[side] * by_y / buffon_priv_abs(x - w->table->end[side]);
        slope = w->slope < 0 ? -slope : slope;
    }
    *w->row++ = (inverse_row){.from = w->t, .to = -(double)INFINITY, .c = {w->v, slope}};
}

static int build_tail(build_walk *w, build_part part, build_place from)
{
    inverse_builder *b = w->b;
    const size_t k = part == BUILD_UPPER ? b->count - 1 : 0;
    const build_place to = {k, build_side(&b->panels[k], part == BUILD_UPPER)};
    const double wanted = 1 / BUILD_TAIL * b->u_error;
    inverse_row *first = w->row;
    w->part = part;
    w->right = part == BUILD_UPPER;
    w->error = wanted < 0x1p-20 ? wanted : 0x1p-20;
    w->worst = 0;
    w->strict = buffon_priv_log(b->reached[part] / b->total);
    if (build_walk_over(w, from, to))
        return 1;
    if (w->row == w->last)
        return buffon_priv_inverse_refuse(b, BUFFON_E_NOMEM, "the memory is too small", w->v);
    build_outermost(w, &b->panels[k]);
    w->table->tail[part] = (uint64_t)(w->row - first);
    const double worst = w->worst + b->tail_error;
    b->report->tail_error = worst > b->report->tail_error ? worst : b->report->tail_error;
    const double reached = b->reached[part] / b->total;
    *(part == BUILD_UPPER ? &b->report->upper : &b->report->lower) = reached > 1         ? 1
                                                                     : reached > b->tail ? reached
                                                                                         : b->tail;
    return 0;
}

static int build_centre(build_walk *w, build_place from, build_place to)
{
    inverse_row *first = w->row;
    w->part = BUILD_CENTRE;
    w->right = 1;
    w->error = w->b->u_error;
    w->worst = 0;
    w->strict = -1;
    if (build_walk_over(w, from, to))
        return 1;
    buffon_inverse_table *table = w->table;
    table->cells = (uint64_t)(w->row - first);
    if (table->cells == 0)
        return buffon_priv_inverse_refuse(w->b, BUFFON_E_PDF, "there is no centre", w->v);
    table->u_lo = first->from;
    table->x_lo = first->c[0];
    table->u_hi = w->t;
    table->x_hi = w->v;
    w->b->report->u_error = w->worst + w->b->error / w->b->total;
    return 0;
}

/* ---- the table ---- */

/* Four bins to a cell at least: few uniforms are in one with more than one split. */
static int build_guide(build_walk *w)
{
    buffon_inverse_table *table = w->table;
    const inverse_row *cells = inverse_cells(table);
    double *guide = inverse_guide(table);
    table->bins = 16;
    while (table->bins < 4 * table->cells)
        table->bins *= 2;
    if ((const char *)(guide + 2 * table->bins) > (const char *)w->last)
        return buffon_priv_inverse_refuse(w->b, BUFFON_E_NOMEM, "the memory is too small",
                                          (double)NAN);
    const uint64_t last = table->cells - 1;
    for (uint64_t bin = 0, k = 0; bin < table->bins; bin++) {
        while (k < last && cells[k].to <= (double)bin / (double)table->bins)
            k++;
        const uint64_t place = 8 * k;
        memcpy(&guide[2 * bin], &place, sizeof place);
        guide[2 * bin + 1] = k < last ? cells[k].to : 2;
    }
    table->bytes = (uint64_t)((const char *)(guide + 2 * table->bins) - (const char *)table);
    w->b->report->bytes = (size_t)table->bytes;
    w->b->report->cells = (size_t)(table->tail[0] + table->cells + table->tail[1]);
    return 0;
}

static void build_ends(buffon_inverse_table *table, const inverse_builder *b)
{
    const build_place middle = build_find(b, 0.5, 0);
    const double median = inverse_x(&b->panels[middle.panel].map, middle.y);
    const int open_lo = b->lo<-DBL_MAX, open_hi = b->hi> DBL_MAX;
    table->end[0] = open_lo ? median : b->lo;
    table->sign[0] = open_lo ? -1 : 1;
    table->end[1] = open_hi ? median : b->hi;
    table->sign[1] = open_hi ? 1 : -1;
    table->least = open_lo ? -DBL_MAX : b->lo;
    table->most = open_hi ? DBL_MAX : b->hi;
}

static int build_rows(buffon_inverse_table *table, char *end, inverse_builder *b)
{
    build_walk w = {.b = b, .table = table};
    const build_place lo = build_find(b, BUILD_TAIL, 0), hi = build_find(b, BUILD_TAIL, 1);
    w.row = inverse_rows(table);
    if ((char *)(w.row + 1) > end)
        return buffon_priv_inverse_refuse(b, BUFFON_E_NOMEM, "the memory is too small",
                                          (double)NAN);
    memset(table, 0, sizeof *table);
    w.last = w.row + (size_t)(end - (char *)w.row) / sizeof *w.row;
    build_ends(table, b);
    if (build_tail(&w, BUILD_LOWER, lo) || build_centre(&w, lo, hi) ||
        build_tail(&w, BUILD_UPPER, hi) || build_guide(&w))
        return 1;
    table->magic = INVERSE_MAGIC;
    return 0;
}

/* With a CDF beside the pdf the error is also measured against it. */
static void build_measure(const buffon_inverse_table *table, inverse_builder *b)
{
    const buffon_inverse_law *law = b->law;
    const inverse_row *cells = inverse_cells(table);
    double worst = 0;
    if (law->cdf == NULL)
        return;
    for (uint64_t k = 0; k < table->cells; k++) {
        double slope;
        const double d = 0.5 * (cells[k].to - cells[k].from);
        const double x = inverse_value(&slope, &cells[k], d);
        const double miss = buffon_priv_abs(law->cdf(x, law->ctx) - (cells[k].from + d));
        worst = miss > worst || miss != miss ? miss : worst;
    }
    b->report->calls += table->cells;
    if (!(worst <= b->report->u_error))
        b->report->u_error = worst;
}

static buffon_status build_check_points(const double *x, size_t n, double lo, double hi)
{
    if (n > 0 && x == NULL)
        return BUFFON_E_NULL;
    for (size_t k = 0; k < n; k++)
        if (!(x[k] >= lo && x[k] <= hi) || !buffon_priv_isfinite(x[k]))
            return BUFFON_E_DOMAIN;
    return BUFFON_OK;
}

static buffon_status build_check(inverse_builder *b, const buffon_inverse_law *law)
{
    const int line = law->lo == 0 && law->hi == 0;
    b->lo = line ? -(double)INFINITY : law->lo;
    b->hi = line ? (double)INFINITY : law->hi;
    b->centre = law->centre;
    b->u_error = law->u_error != 0 ? law->u_error : 1e-12;
    b->tail = law->tail != 0 ? law->tail : 1e-300;
    for (size_t k = 0; k < sizeof law->reserved / sizeof *law->reserved; k++)
        if (law->reserved[k] != 0)
            return BUFFON_E_RESERVED;
    if (law->pdf == NULL)
        return BUFFON_E_NULL;
    if (!(b->lo < b->hi) || !(b->lo <= DBL_MAX) || !(b->hi >= -DBL_MAX) ||
        !buffon_priv_isfinite(b->centre) ||
        (buffon_priv_isfinite(b->lo) && buffon_priv_isfinite(b->hi) &&
         !buffon_priv_isfinite(b->hi - b->lo)))
        return BUFFON_E_DOMAIN;
    if (!(b->u_error >= 1e-13 && b->u_error <= 1e-3) || !(b->tail >= 1e-300 && b->tail <= 0x1p-10))
        return BUFFON_E_TOLERANCE;
    const buffon_status status = build_check_points(law->breaks, law->breaks_count, b->lo, b->hi);
    return status != BUFFON_OK ? status
                               : build_check_points(law->poles, law->poles_count, b->lo, b->hi);
}

/* The panels are made at the start of the memory and moved to its end to make room for rows. */
static buffon_status build_in(void *memory, size_t bytes, inverse_builder *b)
{
    char *const end = (char *)memory + bytes / sizeof(inverse_row) * sizeof(inverse_row);
    b->panels = memory;
    b->room = (size_t)(end - (char *)memory) / sizeof *b->panels;
    if (bytes < 4096)
        return (void)buffon_priv_inverse_refuse(b, BUFFON_E_NOMEM, "the memory is too small",
                                                (double)NAN),
               BUFFON_E_NOMEM;
    if (buffon_priv_inverse_integrate(b))
        return b->report->status;
    inverse_panel *const moved = (inverse_panel *)(void *)end - b->count;
    memmove(moved, b->panels, b->count * sizeof *moved);
    b->panels = moved;
    if (build_rows(memory, (char *)moved, b))
        return b->report->status;
    build_measure(memory, b);
    b->report->total = b->total / b->unit;
    b->report->total_error = b->error / b->unit;
    if (!(b->report->u_error <= b->u_error))
        b->report->status = BUFFON_W_TOLERANCE;
    return b->report->status;
}

buffon_status buffon_inverse_table_build(void *memory, size_t bytes, buffon_inverse_report *report,
                                         const buffon_inverse_law *law)
{
    buffon_inverse_report own;
    if (report == NULL)
        report = &own;
    inverse_builder b = {.law = law, .report = report};
    const double nan = (double)NAN;
    *report = (buffon_inverse_report){.where = nan, .u_error = nan, .total = nan};
    report->status = memory == NULL || law == NULL ? BUFFON_E_NULL : build_check(&b, law);
    if (report->status != BUFFON_OK)
        return report->status;
    report->u_error = 0;
    return build_in(memory, bytes, &b);
}

buffon_status buffon_inverse_table_new(buffon_inverse_table **table, buffon_inverse_report *report,
                                       const buffon_inverse_law *law)
{
    buffon_inverse_report own;
    if (report == NULL)
        report = &own;
    if (table == NULL) {
        *report = (buffon_inverse_report){.status = BUFFON_E_NULL};
        return BUFFON_E_NULL;
    }
    *table = NULL;
    for (size_t bytes = BUILD_LEAST;; bytes *= 4) {
        void *work = malloc(bytes);
        if (work == NULL)
            return report->status = BUFFON_E_NOMEM;
        buffon_status status = buffon_inverse_table_build(work, bytes, report, law);
        if (status >= 0) {
            *table = malloc(report->bytes);
            if (*table != NULL)
                memcpy(*table, work, report->bytes);
            else
                status = report->status = BUFFON_E_NOMEM;
        }
        free(work);
        if (status != BUFFON_E_NOMEM || *table != NULL || bytes >= BUILD_MOST)
            return status;
    }
}

void buffon_inverse_table_free(buffon_inverse_table *table)
{
    free(table);
}
