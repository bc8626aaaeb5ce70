/* The inverse CDF, and what it makes of the disk. */
#include "story.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- X = F^-1(u) ---- */

static double curve_cdf(double x, void *ctx)
{
    (void)ctx;
    return curve_integral(x) / curve_integral(CURVE_END);
}

static double curve_pdf(double x, void *ctx)
{
    return curve(&x, ctx) / curve_integral(CURVE_END);
}

static double curve_moment(const double *x, void *ctx)
{
    return x[0] * curve(x, ctx);
}

/* Integral of x curve(x) from 0 to b. With s = -1 + 4i the curve is (e^-x - Re e^(s x)) / 2, and
 * the integral of x e^(s x) is e^(s b) (b/s - 1/s^2) + 1/s^2. */
static double curve_moment_integral(double b)
{
    double fall = exp(-b), c = cos(4 * b), d = sin(4 * b);
    /* 1/s = (-1 - 4i)/17, 1/s^2 = (-15 + 8i)/289 */
    double re = -b / 17 + 15.0 / 289, im = -4 * b / 17 - 8.0 / 289;
    double wave = fall * (c * re - d * im) - 15.0 / 289;
    return (1 - fall * (1 + b) - wave) / 2;
}

static void draw_staircase(text *out, const buffon_inversion *how)
{
    enum { STEPS = 150, RAYS = 25 };
    double x[STEPS + 1], F[STEPS + 1];
    ruler across = {.lo = 0, .hi = CURVE_END, .label = "x"}, up = {.lo = 0, .hi = 1, .label = "u"};
    text_put(out, "<div><p>From u across to F, and down to x</p>");
    panel p = panel_begin(out, 430, 320, across, up, "A distribution function turned round");
    for (int i = 0; i < RAYS; i++) {
        double u = (i + 0.5) / RAYS, at, floor = 0;
        story_check(buffon_inverse_sample(&at, NULL, u, how), "inverse CDF");
        panel_segment(&p, "c1 hair", 0, u, at, u);
        panel_segment(&p, "c2 hair", at, u, at, 0);
        panel_dots(&p, "c2", 5.5, &at, &floor, 1);
    }
    for (int i = 0; i <= STEPS; i++) {
        x[i] = CURVE_END * i / STEPS;
        F[i] = curve_cdf(x[i], NULL);
    }
    panel_line(&p, "exact", x, F, STEPS + 1);
    panel_text(&p, "halo middle", 2.3, curve_cdf(2.3, NULL), 0, 24, "F (x)");
    panel_end(&p);
    text_put(out, "</div>");
}

static void draw_inverted(text *out, const buffon_density *g, size_t n)
{
    enum { STEPS = 150 };
    char count[STORY_COUNT];
    double at[STEPS + 1], pdf[STEPS + 1], *u = need_memory(2 * n * sizeof *u), *x = u + n;
    buffon_rng rng = buffon_rng_make(1777, 7);
    ruler across = {.lo = 0, .hi = CURVE_END, .label = "x"};
    ruler up = {.lo = 0, .hi = 1.25, .label = "density"};
    buffon_rng_fill(u, n, &rng);
    story_check(buffon_density_sample(x, NULL, u, n, g), "inverse CDF");
    for (int i = 0; i <= STEPS; i++) {
        at[i] = CURVE_END * i / STEPS;
        pdf[i] = curve_pdf(at[i], NULL);
    }
    text_add(out, "<div><p>%s samples and their density</p>", story_count(count, n));
    panel p = panel_begin(out, 430, 320, across, up, "A histogram of samples and their density");
    panel_histogram(&p, "c2", x, n, 0, CURVE_END, 60);
    panel_line(&p, "exact", at, pdf, STEPS + 1);
    panel_end(&p);
    text_put(out, "</div>");
    free(u);
}

static void tell_inverse(story *s)
{
    enum { SHOWN = 20000 };
    buffon_inversion how = {.cdf = curve_cdf, .pdf = curve_pdf, .lo = 0, .hi = CURVE_END};
    buffon_density g = buffon_inverse(&how);
    buffon_integrand f = {.scalar = curve_moment, .dim = 1};
    buffon_estimate plain, shaped;
    double lo = 0, hi = CURVE_END;
    buffon_run run = story_run(s, 1 << 20);
    story_share(s, 0, 0.1);
    story_check(buffon_uniform(&plain, &f, &lo, &hi, &run), "inverse CDF");
    story_share(s, 0.1, 0.6);
    story_check(buffon_inverse_cdf(&shaped, &f, &how, &run), "inverse CDF");

    story_section(s, "The inverse CDF", "X = F<sup>&#8722;1</sup>(u) is distributed as g, because "
                  "P(X &le; x) = P(u &le; F(x)) = F(x).");
    story_prose(s, "How does one get samples of <i>g</i> at all? Let <i>F</i>(<i>x</i>) be the "
                "area under <i>g</i> to the left of <i>x</i>: it climbs from 0 to 1, steeply where "
                "<i>g</i> is large. Draw <i>u</i> uniformly on the axis of <i>F</i> and look up "
                "which <i>x</i> it belongs to: steep stretches catch many <i>u</i>, flat ones few. "
                "Often <i>F</i><sup>&minus;1</sup> is a formula. Where it is not, as for the curve "
                "of the first sections, the library finds it from <i>F</i> and <i>g</i> by "
                "Newton&#8217;s method, kept inside a bracket so that it cannot go astray.");
    story_formula(s, "<i>F</i>(<i>x</i>) = " INTEGRAL("&minus;&infin;", "<i>x</i>")
                  " <i>g</i>(<i>t</i>) d<i>t</i>, &#8195; "
                  "<i>X</i> = <i>F</i><sup>&minus;1</sup>(<i>u</i>)");
    story_code(s, "buffon_inversion how = {.cdf = F, .pdf = g, .lo = 0, .hi = 3};\n"
               "status = buffon_inverse_sample(&x, NULL, 0.5, &how); /* the median */\n"
               "status = buffon_inverse_cdf(&e, &f, &how, NULL);     /* integrates f by f/g */");
    text *out = story_figure(s, "two");
    draw_staircase(out, &how);
    draw_inverted(out, &g, SHOWN);
    story_caption(s, "Left: 25 equally spaced <i>u</i> and the <i>x</i> that belong to them, for "
                  "<i>g</i> proportional to the curve e<sup>&minus;<i>x</i></sup> sin&sup2; "
                  "2<i>x</i>. Right: random <i>u</i>, and the density that the <i>x</i> follow.");
    story_add(s, "first moment of the curve", "uniform", &plain, curve_moment_integral(CURVE_END));
    story_add(s, "first moment of the curve", "inverse CDF", &shaped,
              curve_moment_integral(CURVE_END));
    story_results(s);
}

/* ---- the disk ---- */

enum { CELLS = 12 };

static void map_wrong(double x[2], double u1, double u2)
{
    x[0] = u1 * cos(2 * PI * u2);
    x[1] = u1 * sin(2 * PI * u2);
}

/* One cell of the unit square as the map bends it. */
static void draw_cell(panel *p, void (*map)(double x[2], double u1, double u2), int i, int j)
{
    enum { EDGE = 5 };
    text_put(p->out, "M");
    for (int k = 0; k < 4 * EDGE; k++) {
        double t = (double)(k % EDGE) / EDGE, x[2], a, b;
        int side = k / EDGE;
        a = side == 0 ? t : side == 1 ? 1 : side == 2 ? 1 - t : 0;
        b = side == 0 ? 0 : side == 1 ? t : side == 2 ? 1 : 1 - t;
        map(x, (i + a) / CELLS, (j + b) / CELLS);
        text_add(p->out, "%.1f %.1f ", panel_x(p, x[0]), panel_y(p, x[1]));
    }
    text_put(p->out, "Z");
}

/* The unit square's chequers and jittered points, on the disk. Returns the share of points in the
 * inner half, r < 1/2. */
static double draw_disk(text *out, void (*map)(double x[2], double u1, double u2),
                        const char *class, const char *title)
{
    enum { POINTS = 4 * CELLS * CELLS };
    static const double lo[] = {0, 0}, hi[] = {1, 1};
    buffon_density square = buffon_box(lo, hi, 2);
    buffon_points jitter = buffon_points_jitter(CELLS);
    buffon_run run = {.samples = POINTS, .seed = 1777, .points = &jitter};
    ruler r = {.lo = -1.03, .hi = 1.03, .no_ticks = 1};
    int inner = 0;
    text_add(out, "<div><p>%s</p>", title);
    panel p = panel_begin(out, 320, 318, r, r, "The unit square on the disk");
    text_put(out, "<path class=\"area pale\" d=\"");
    for (int i = 0; i < CELLS; i++)
        for (int j = 0; j < CELLS; j++)
            if ((i + j) % 2 == 0)
                draw_cell(&p, map, i, j);
    text_put(out, "\"/>");
    for (uint64_t i = 0; i < POINTS; i++) {
        double u[2], x[2];
        story_check(buffon_sample_at(u, &square, i, &run), "disk");
        map(x, u[0], u[1]);
        inner += x[0] * x[0] + x[1] * x[1] < 0.25;
        panel_dots(&p, class, 3.6, &x[0], &x[1], 1);
    }
    text_add(out, "<circle class=\"line rim\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>", panel_x(&p, 0),
             panel_y(&p, 0), panel_x(&p, 1) - panel_x(&p, 0));
    panel_end(&p);
    text_put(out, "</div>");
    return (double)inner / POINTS;
}

static double x_squared(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0];
}

static void sample_disk(story *s, const buffon_density *disk, const buffon_points *points,
                        const char *name)
{
    buffon_integrand f = {.scalar = x_squared, .dim = 2};
    buffon_run run = story_run(s, 1 << 17);
    buffon_estimate e;
    run.points = points;
    story_check(buffon_importance(&e, &f, disk, &run), name);
    story_add(s, "x^2 over the disk: pi/4", name, &e, PI / 4);
}

static void tell_round(story *s)
{
    buffon_density polar = buffon_disk(1), concentric = buffon_disk_concentric(1);
    buffon_points jitter = buffon_points_jitter(256);
    story_section(s, "The disk", "Radius by inverse CDF, angle uniform.");
    story_prose(s, "A disk of radius <i>r</i> has the share <i>r</i>&sup2; of the area of the unit "
                "disk: that is the CDF of the radius, and its inverse is a square root. Leaving "
                "the root out looks right and is wrong: half of the points then fall within half "
                "the radius, which holds a quarter of the area. A second map takes squares about "
                "the centre to circles. It is uniform too, and keeps neighbours together: cells of "
                "the square stay compact instead of becoming slivers, which pays as soon as the "
                "points are not purely random but stratified.");
    story_formula(s, "<i>F</i>(<i>r</i>) = <i>r</i>&sup2;, &#8195; <i>r</i> = "
                  "&radic;<i>u</i><sub>1</sub>, &#8195; <i>&theta;</i> = "
                  "2&pi;<i>u</i><sub>2</sub>");
    story_code(s, "buffon_density polar = buffon_disk(1), concentric = buffon_disk_concentric(1);\n"
               "buffon_points jitter = buffon_points_jitter(256); /* 256 x 256 cells */\n"
               "buffon_run run = {.points = &jitter};\n"
               "status = buffon_importance(&e, &f, &concentric, &run);");
    text *out = story_figure(s, "three");
    double wrong = draw_disk(out, map_wrong, "c2", "Wrong: r = u<sub>1</sub>");
    double right = draw_disk(out, buffon_disk_sample, "c1", "Polar: r = &radic;u<sub>1</sub>");
    draw_disk(out, buffon_disk_sample_concentric, "c3", "Concentric");
    story_caption(s, "The chequered unit square, with four random points in each of its %d cells, "
                  "on the disk. Within half the radius lie %.0f&#8201;%% of the points on the "
                  "left, and %.0f&#8201;%% in the middle, as it should "
                  "be.", (int)CELLS * CELLS, 100 * wrong,
                  100 * right);
    story_share(s, 0.6, 1);
    sample_disk(s, &polar, NULL, "disk, polar");
    sample_disk(s, &concentric, NULL, "disk, concentric");
    sample_disk(s, &polar, &jitter, "polar, jittered");
    sample_disk(s, &concentric, &jitter, "concentric, jittered");
    story_results(s);
}

void tell_disk(story *s)
{
    tell_inverse(s);
    tell_round(s);
}
