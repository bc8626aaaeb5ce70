/* Quasi-Monte Carlo: points that are even, and random only as a whole. */
#include "story.h"

#include <math.h>
#include <stdio.h>

/* ---- the points ---- */

enum { CELLS = 16, POINTS = 2 * CELLS * CELLS, LOG_POINTS = 9,
       BOXES = (LOG_POINTS + 1) * POINTS };

typedef struct pattern {
    const char *name, *class;
    buffon_points points;
    uint64_t empty; /* how many of the boxes below have no point, of BOXES */
} pattern;

/* The square is cut into POINTS equal boxes of each shape, 1 by 1 / POINTS to 1 / POINTS by 1. */
static uint64_t count_empty(const double *x, const double *y)
{
    uint64_t empty = 0;
    for (int a = 0; a <= LOG_POINTS; a++) {
        char hit[POINTS] = {0};
        int across = 1 << a, up = POINTS / across;
        for (int i = 0; i < POINTS; i++)
            hit[(int)(x[i] * across) * up + (int)(y[i] * up)] = 1;
        for (int i = 0; i < POINTS; i++)
            empty += hit[i] == 0;
    }
    return empty;
}

static void draw_pattern(text *out, pattern *shown)
{
    static const double lo[] = {0, 0}, hi[] = {1, 1};
    buffon_density square = buffon_box(lo, hi, 2);
    buffon_run run = {.samples = POINTS, .seed = 1777, .points = &shown->points};
    ruler r = {.lo = -0.01, .hi = 1.01, .no_ticks = 1};
    double x[POINTS], y[POINTS];
    for (int i = 0; i < POINTS; i++) {
        double v[2];
        story_check(buffon_sample_at(v, &square, (uint64_t)i, &run), shown->name);
        x[i] = v[0];
        y[i] = v[1];
    }
    shown->empty = count_empty(x, y);
    text_add(out, "<div><p>%s</p>", shown->name);
    panel p = panel_begin(out, 320, 314, r, r, "Points of the unit square");
    text_add(out, "<path class=\"frame\" d=\"M%.1f %.1fH%.1fV%.1fH%.1fZ\"/>", panel_x(&p, 0),
             panel_y(&p, 0), panel_x(&p, 1), panel_y(&p, 1), panel_x(&p, 0));
    panel_dots(&p, shown->class, 5, x, y, POINTS);
    panel_end(&p);
    text_put(out, "</div>");
}

static void draw_patterns(story *s)
{
    pattern shown[] = {
        {.name = "Random", .class = "c1", .points = buffon_points_random()},
        {.name = "Jittered", .class = "c2", .points = buffon_points_jitter(CELLS)},
        {.name = "Sobol&rsquo;", .class = "c4",
         .points = buffon_points_sobol(BUFFON_SCRAMBLE_NONE)},
        {.name = "Sobol&rsquo;, scrambled", .class = "c3",
         .points = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN)},
    };
    char boxes[STORY_COUNT], empty[4][STORY_COUNT];
    text *out = story_figure(s, "four");
    for (int i = 0; i < 4; i++) {
        shown[i].points.replicates = 1;
        draw_pattern(out, &shown[i]);
    }
    story_caption(s, "%d points of the unit square. Random ones crowd and leave holes. Jittered "
                  "ones, two in each of %d cells, are even as far as the cells are. Sobol&rsquo; "
                  "points are even in boxes of every shape, but lie on a lattice that begins in "
                  "the corner; the scramble keeps the first and undoes the second. The square can "
                  "be cut into %d equal boxes in ten ways, from upright strips to level ones. Of "
                  "those %s boxes %s are without a random point, %s without a jittered one, %s "
                  "without a Sobol&rsquo; point and %s without a scrambled one.", (int)POINTS,
                  (int)(CELLS * CELLS), (int)POINTS, story_count(boxes, BOXES),
                  story_count(empty[0], shown[0].empty), story_count(empty[1], shown[1].empty),
                  story_count(empty[2], shown[2].empty), story_count(empty[3], shown[3].empty));
}

/* ---- the error ---- */

enum { DIM = 5 };

/* Integral (e - 1)^5. */
static double growth(const double *x, void *ctx)
{
    double sum = 0;
    (void)ctx;
    for (int j = 0; j < DIM; j++)
        sum += x[j];
    return exp(sum);
}

static double ball(const double *x, void *ctx)
{
    double square = 0;
    (void)ctx;
    for (int j = 0; j < DIM; j++)
        square += x[j] * x[j];
    return square <= 1;
}

typedef struct problem {
    const char *title, *name;
    buffon_integrand f;
    double lo, exact;    /* the cube is [lo, 1]^5 */
    double above, below; /* where the slopes begin: 1/sqrt(N), and the one that Sobol' reaches */
    double fall;         /* the power of the latter, */
    const char *slope;   /* and its name */
    int label_dy[3];
} problem;

enum { METHODS = 3, SIZES = 9, FEWEST = 9 };

static const char *const method_name[] = {"uniform", "jitter", "Sobol', scrambled"};
static const char *const method_label[] = {"random", "jitter", "Sobol&rsquo;"};
static const char *const method_class[] = {"c1", "c2", "c3"};

/* Runs with about n samples: jitter takes two in each of k^5 cells, the most that n allow. */
static buffon_estimate measure(const problem *f, int method, uint64_t n, buffon_run run)
{
    double lo[DIM], hi[DIM];
    uint64_t k = (uint64_t)(pow((double)n / 2, 1.0 / DIM) + 1e-9);
    buffon_points jitter = buffon_points_jitter(k);
    buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    buffon_estimate e;
    for (int j = 0; j < DIM; j++) {
        lo[j] = f->lo;
        hi[j] = 1;
    }
    run.samples = method == 1 ? 2 * (uint64_t)(pow((double)k, DIM) + 0.5) : n;
    run.points = method == 1 ? &jitter : method == 2 ? &sobol : NULL;
    story_check(buffon_uniform(&e, &f->f, lo, hi, &run), f->name);
    return e;
}

/* The errors of one method at each size, relative: those of `repeats` runs, root mean square, and
 * those that the runs stated. */
typedef struct curve_of_errors {
    double n[SIZES], rms[SIZES], stated[SIZES];
} curve_of_errors;

static curve_of_errors measure_method(const problem *f, int method, int repeats)
{
    curve_of_errors c = {.n = {0}};
    for (int j = 0; j < SIZES; j++) {
        for (int r = 0; r < repeats; r++) {
            buffon_run run = {.seed = 1777, .stream = (uint64_t)r, .threads = 1};
            buffon_estimate e = measure(f, method, UINT64_C(1) << (FEWEST + j), run);
            c.n[j] = (double)e.samples;
            c.rms[j] += (e.value / f->exact - 1) * (e.value / f->exact - 1) / repeats;
            c.stated[j] += e.std_error * e.std_error / (f->exact * f->exact) / repeats;
        }
        c.rms[j] = sqrt(c.rms[j]);
        c.stated[j] = sqrt(c.stated[j]);
    }
    return c;
}

/* A line N^power that begins at `top`, named halfway: above it, or below. */
static void draw_slope(panel *p, const char *name, double top, double power, int below)
{
    const double n[] = {512, 131072}, middle = 8192;
    double e[] = {top, top * pow(n[1] / n[0], power)};
    panel_line(p, "pale dash thin", n, e, 2);
    panel_text(p, below ? "pale halo end" : "pale halo", middle, top * pow(middle / n[0], power),
               below ? -6 : 4, below ? 16 : -5, "%s", name);
}

static void draw_errors(story *s, text *out, const problem *f, int repeats,
                        curve_of_errors c[METHODS])
{
    double low = 1 / (1 + sqrt(2.0 / repeats)), high = 1 + sqrt(2.0 / repeats);
    ruler across = {.lo = 350, .hi = 1.9e6, .log = 1, .label = "samples N"};
    ruler up = {.lo = 3e-7, .hi = 0.4, .log = 1, .label = "relative error"};
    text_add(out, "<div><p>%s</p>", f->title);
    panel p = panel_begin(out, 430, 360, across, up, "Error against the number of samples");
    draw_slope(&p, "1/&#8730;N", f->above, -0.5, 0);
    draw_slope(&p, f->slope, f->below, f->fall, 1);
    for (int m = 0; m < METHODS; m++) {
        char class[32];
        c[m] = measure_method(f, m, repeats);
        for (int j = 0; j < SIZES; j++)
            panel_segment(&p, method_class[m], c[m].n[j], c[m].rms[j] * low, c[m].n[j],
                          c[m].rms[j] * high);
        panel_line(&p, method_class[m], c[m].n, c[m].stated, SIZES);
        panel_dots(&p, method_class[m], 7, c[m].n, c[m].rms, SIZES);
        snprintf(class, sizeof class, "%s halo", method_class[m]);
        panel_text(&p, class, c[m].n[SIZES - 1], c[m].stated[SIZES - 1], 10, f->label_dy[m], "%s",
                   method_label[m]);
        story_progress(s, (m + 1.0) / METHODS);
    }
    panel_end(&p);
    text_put(out, "</div>");
}

/* How many times smaller than with random points the largest runs state their error. */
static double gain(const curve_of_errors c[METHODS], int method)
{
    return c[0].stated[SIZES - 1] / c[method].stated[SIZES - 1];
}

/* The power at which the stated error falls: a straight line through the logarithms. */
static double slope(const curve_of_errors *c)
{
    double top = 0, bottom = 0;
    for (int j = 0; j < SIZES; j++) {
        double across = j - (SIZES - 1) / 2.0;
        top += across * log2(c->stated[j]);
        bottom += across * across;
    }
    return -top / bottom;
}

static void tell_errors_of_both(story *s)
{
    enum { REPEATS = 25 };
    const problem both[] = {{.title = "A smooth integrand",
                             .name = "e^(x1+...+x5) over the cube",
                             .f = {.scalar = growth, .dim = DIM},
                             .exact = pow(exp(1) - 1, DIM),
                             .above = 0.1,
                             .below = 2e-3,
                             .fall = -1.5,
                             .slope = "N<tspan class=\"raise\" dy=\"-5\">&#8722;3/2</tspan>",
                             .label_dy = {4, 4, 4}},
                            {.title = "A discontinuous one: the ball",
                             .name = "volume of the ball, d = 5",
                             .f = {.scalar = ball, .dim = DIM},
                             .lo = -1,
                             .exact = 8 * PI * PI / 15,
                             .above = 0.25,
                             .below = 0.03,
                             .fall = -0.6,
                             .slope = "N<tspan class=\"raise\" dy=\"-5\">&#8722;3/5</tspan>",
                             .label_dy = {1, 4, 13}}};
    curve_of_errors c[2][METHODS];
    text *out = story_figure(s, "two");
    for (int i = 0; i < 2; i++) {
        story_share(s, 0.45 * i, 0.45 * (i + 1));
        draw_errors(s, out, &both[i], REPEATS, c[i]);
    }
    story_caption(s, "Five dimensions, both panels to one scale. Left: e<sup>&Sigma;x</sup> over "
                  "the unit cube. Right: 1 inside the unit ball, 0 outside. Dots with bars: the "
                  "true error, root mean square over %d runs of each size. Lines: the standard "
                  "error that those runs themselves stated, for Sobol&rsquo; points from 8 means. "
                  "At 2<sup>17</sup> samples it is %.0f times smaller than with random points on "
                  "the left (jitter: %.0f times), and on the right %.1f times (jitter: %.1f). Over "
                  "the sizes shown it falls as <i>N</i><sup>&minus;%.2f</sup> and "
                  "<i>N</i><sup>&minus;%.2f</sup>.", (int)REPEATS, gain(c[0], 2), gain(c[0], 1),
                  gain(c[1], 2), gain(c[1], 1), slope(&c[0][2]), slope(&c[1][2]));
    for (int i = 0; i < 2; i++)
        for (int m = 0; m < METHODS; m++) {
            story_share(s, 0.9 + 0.05 * i, 0.95 + 0.05 * i);
            buffon_estimate e = measure(&both[i], m, 1 << 17, story_run(s, 0));
            story_add(s, both[i].name, method_name[m], &e, both[i].exact);
        }
    story_results(s);
}

void tell_quasi(story *s)
{
    story_section(s, "Quasi-Monte Carlo", "An average wants even points, not independent ones. A "
                  "little randomness is enough for the error bar.");
    story_prose(s, "Independent points crowd here and leave holes there; that is where the error "
                "1/&radic;<i>N</i> comes from. Jitter helps in a few dimensions, but cells are "
                "soon too many: two along each of twenty axes are a million. The points of "
                "Sobol&rsquo; are computed, not drawn, so that a power of two of them visits boxes "
                "of every shape alike, or nearly so, long and thin ones too, in a "
                "thousand dimensions.");
    story_formula(s, "error ~ <i>N</i><sup>&minus;3/2</sup> (log "
                  "<i>N</i>)<sup>(<i>d</i>&minus;1)/2</sup> if <i>f</i> is smooth, &#8195; ~ "
                  "<i>N</i><sup>&minus;1/2 &minus; 1/(2<i>d</i>)</sup> if it jumps");
    story_prose(s, "Computed points have no error bar. So they are scrambled: each binary digit of "
                "a coordinate is flipped or not by a random bit, one for every value of the digits "
                "before it. That makes every point uniform and the estimate unbiased, and it "
                "leaves the boxes as even as they were. Eight scrambles, independent of each "
                "other, give eight means, and their spread gives the interval, which is "
                "Student&rsquo;s with 7 degrees of freedom: here one <i>z</i> in twenty lies "
                "beyond &plusmn;2.4. One scramble of all the points is nearer still. Its error bar "
                "comes from eight stretches of it, which are not independent: it is as long as "
                "that of eight scrambles, longer than it need be.");
    draw_patterns(s);
    story_code(s, "buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);\n"
               "buffon_run run = {.samples = 1 << 17, .points = &sobol}; /* 8 x 2^14 */\n"
               "status = buffon_uniform(&e, &f, lo, hi, &run);");
    tell_errors_of_both(s);
}
