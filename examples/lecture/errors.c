/* How the error falls, and how often the interval is right. */
#include "story.h"

#include <math.h>
#include <stdio.h>

/* ---- error against N ---- */

static double growth(const double *x, void *ctx)
{
    (void)ctx;
    return exp(x[0] + x[1]);
}

/* A straight line that grows from 1 to 1 + slope in place of e^x. */
static const double line_slope = 1.7;

static double line_pdf(double x, void *ctx)
{
    (void)ctx;
    return (1 + line_slope * x) / (1 + line_slope / 2);
}

static double line_quantile(double u, void *ctx)
{
    double v = u * (1 + line_slope / 2);
    (void)ctx;
    return 2 * v / (1 + sqrt(1 + 2 * line_slope * v));
}

typedef struct method {
    const char *name, *class;
    int label_dy;
} method;

static const method methods[] = {
    {"rejection", "c5", -10},          {"plain", "c1", -10},    {"antithetic", "c4", -9},
    {"importance sampling", "c3", 18}, {"jitter", "c2", 18},
};
enum { METHODS = sizeof methods / sizeof *methods };

/* Runs one of the methods; k^2 cells and so 2 k^2 samples, times sweeps. */
static buffon_estimate grow(int which, uint64_t k, buffon_run run)
{
    static const double lo[] = {0, 0}, hi[] = {1, 1};
    buffon_density line = buffon_inverse(&(buffon_inversion){.quantile = line_quantile,
                                                             .pdf = line_pdf});
    buffon_density lines[] = {line, line}, plane = buffon_density_product(lines, 2);
    buffon_points antithetic = buffon_points_antithetic(), jitter = buffon_points_jitter(k);
    buffon_integrand f = {.scalar = growth, .dim = 2};
    buffon_estimate e;
    buffon_status status;
    if (which == 0) {
        status = buffon_rejection(&e, &f, lo, hi, exp(2), &run);
    } else if (which == 3) {
        status = buffon_importance(&e, &f, &plane, &run);
    } else {
        run.points = which == 2 ? &antithetic : which == 4 ? &jitter : NULL;
        status = buffon_uniform(&e, &f, lo, hi, &run);
    }
    story_check(status, methods[which].name);
    return e;
}

enum { SIZES = 8 };

/* Many runs of each size: their true errors (root mean square) and those that they stated. */
static void measure_errors(story *s, double rms[METHODS][SIZES], double stated[METHODS][SIZES],
                           int repeats)
{
    double exact = (exp(1) - 1) * (exp(1) - 1), done = 0;
    double whole = METHODS * repeats * 8 * (pow(4, SIZES) - 1) / 3;
    for (int j = 0; j < SIZES; j++) {
        uint64_t k = UINT64_C(2) << j, n = 2 * k * k;
        for (int m = 0; m < METHODS; m++) {
            double square = 0, variance = 0;
            for (int r = 0; r < repeats; r++) {
                buffon_run run = {.samples = n, .seed = 1777, .stream = (uint64_t)r, .threads = 1};
                buffon_estimate e = grow(m, k, run);
                square += (e.value - exact) * (e.value - exact) / repeats;
                variance += e.std_error * e.std_error / repeats;
                done += (double)n;
                story_progress(s, done / whole);
            }
            rms[m][j] = sqrt(square);
            stated[m][j] = sqrt(variance);
        }
    }
}

static void draw_errors(text *out, double rms[METHODS][SIZES], double stated[METHODS][SIZES],
                        int repeats)
{
    double n[SIZES], low = 1 / (1 + sqrt(2.0 / repeats)), high = 1 + sqrt(2.0 / repeats);
    ruler across = {.lo = 5, .hi = 2.2e6, .log = 1, .label = "samples N"};
    ruler up = {.lo = 1e-6, .hi = 4, .log = 1, .label = "error"};
    panel p = panel_begin(out, 860, 470, across, up, "Error against the number of samples");
    double from[] = {8, 131072}, half[] = {0.4, 0.4 / 128}, whole[] = {0.04, 0.04 / 16384};
    panel_line(&p, "pale dash thin", from, half, 2);
    panel_line(&p, "pale dash thin", from, whole, 2);
    panel_text(&p, "pale halo middle", 60, 0.4 * sqrt(8.0 / 60), -6, 16, "1/&#8730;N");
    panel_text(&p, "pale halo end", 700, 0.04 * 8 / 700, -4, 14, "1/N");
    for (int m = 0; m < METHODS; m++) {
        char class[32];
        for (int j = 0; j < SIZES; j++) {
            n[j] = 2 * pow(4, j + 1);
            panel_segment(&p, methods[m].class, n[j], rms[m][j] * low, n[j], rms[m][j] * high);
        }
        panel_line(&p, methods[m].class, n, stated[m], SIZES);
        panel_dots(&p, methods[m].class, 7, n, rms[m], SIZES);
        snprintf(class, sizeof class, "%s halo", methods[m].class);
        panel_text(&p, class, n[SIZES - 1], stated[m][SIZES - 1], 10, 4, "%s", methods[m].name);
    }
    panel_end(&p);
}

static void tell_convergence(story *s)
{
    enum { REPEATS = 100 };
    static const char *name[] = {"rejection", "uniform", "antithetic", "importance, product",
                                 "jitter, 512 x 512"};
    double rms[METHODS][SIZES], stated[METHODS][SIZES], exact = (exp(1) - 1) * (exp(1) - 1);
    story_share(s, 0, 0.7);
    measure_errors(s, rms, stated, REPEATS);
    story_section(s, "How the error falls", "Four times the samples for half the error; better "
                  "points and better densities begin lower, and some fall faster.");
    story_prose(s, "All that has been said, in one picture: e<sup><i>x</i>+<i>y</i></sup> over the "
                "unit square by five methods. Hit-or-miss is above the plain average, a density "
                "that resembles <i>f</i> far below it, and all three fall as 1/&radic;<i>N</i>. "
                "<em>Antithetic</em> points come in mirrored pairs <i>u</i>, 1 &minus; <i>u</i>, "
                "whose errors cancel in part. <em>Jittered</em> points, two in each of <i>N</i>/2 "
                "cells, are the only ones that fall faster: where the integrand is smooth it "
                "hardly varies within a cell, and in two dimensions that gains another factor "
                "1/&radic;<i>N</i>.");
    story_formula(s, "error = " FRAC("<i>&sigma;</i>", "&radic;<i>N</i>") " &#8195; (jittered in "
                  "<i>d</i> dimensions: ~ <i>N</i><sup>&minus;1/2 &minus; 1/<i>d</i></sup>)");
    story_code(s, "buffon_points antithetic = buffon_points_antithetic();\n"
               "buffon_points jitter = buffon_points_jitter(k); /* k x k cells */\n"
               "buffon_density lines[] = {line, line};\n"
               "buffon_density plane = buffon_density_product(lines, 2);\n\n"
               "status = buffon_uniform(&e, &f, lo, hi, &(buffon_run){.points = &antithetic});\n"
               "status = buffon_uniform(&e, &f, lo, hi, &(buffon_run){.points = &jitter});\n"
               "status = buffon_importance(&e, &f, &plane, NULL);");
    draw_errors(story_figure(s, "one"), rms, stated, REPEATS);
    story_caption(s, "Dots with bars: the true error, root mean square over %d runs of each size. "
                  "Lines: the standard error that those runs themselves stated. But for their own "
                  "noise the dots lie on the lines: the error bars can be believed.", (int)REPEATS);
    for (int m = 0; m < METHODS; m++) {
        story_share(s, 0.7 + 0.04 * m, 0.74 + 0.04 * m);
        buffon_estimate e = grow(m, 512, story_run(s, 1 << 20));
        story_add(s, "e^(x+y) over the square", name[m], &e, exact);
    }
    story_results(s);
}

/* ---- coverage ---- */

static void tell_coverage(story *s)
{
    enum { SHOWN = 200, RUNS = 20000 };
    char runs[STORY_COUNT];
    double lo = 0, hi = CURVE_END, exact = curve_integral(CURVE_END);
    buffon_integrand f = {.scalar = curve, .dim = 1};
    uint64_t covered = 0;
    int missed = 0;
    double low, high;
    story_section(s, "How often the interval is right", "A 95&#8201;% interval is a promise about "
                  "many runs: one in twenty may miss, and should.");
    story_prose(s, "An interval is not a guarantee. It is a recipe that, used again and again, "
                "contains the truth as often as it says. That can be tested like anything else: "
                "run the estimate many times and count. Too many misses would mean error bars that "
                "lie; too few would mean that samples were wasted.");
    story_formula(s, "P(<i>&alpha;</i> &isin; [lo, hi]) = 0.95, &#8195; lo, hi = estimate &#8723; "
                  "<i>t</i> &#183; standard error");
    story_code(s, "for (i = 0; i < 20000; i++) {\n"
               "    buffon_run run = {.samples = 100, .stream = i, .confidence = 0.95};\n"
               "    status = buffon_uniform(&e, &f, &lo, &hi, &run);\n"
               "    covered += e.lo <= exact && exact <= e.hi;\n"
               "}\n"
               "status = buffon_interval_clopper_pearson(&low, &high, covered, 20000, 0.95);");
    ruler across = {.lo = 0, .hi = SHOWN + 1, .label = "run"};
    ruler up = {.lo = 0.2, .hi = 0.8, .label = "interval"};
    panel p = panel_begin(story_figure(s, "one"), 860, 310, across, up, "Intervals of many runs");
    panel_segment(&p, "exact", 0, exact, SHOWN + 1, exact);
    story_share(s, 0.9, 1);
    for (int i = 0; i < RUNS; i++) {
        buffon_run run = {.samples = 100, .seed = 1777, .stream = 1000000 + (uint64_t)i};
        buffon_estimate e;
        story_check(buffon_uniform(&e, &f, &lo, &hi, &run), "coverage");
        int right = e.lo <= exact && exact <= e.hi;
        covered += (uint64_t)right;
        if (i >= SHOWN)
            continue;
        missed += !right;
        panel_segment(&p, right ? "c1 thin" : "c2", i + 1, e.lo, i + 1, e.hi);
        double at = i + 1;
        panel_dots(&p, right ? "c1" : "c2", right ? 2.6 : 5, &at, &e.value, 1);
    }
    panel_end(&p);
    story_check(buffon_interval_clopper_pearson(&low, &high, covered, RUNS, 0.95), "coverage");
    story_caption(s, "%d runs of 100 samples each: the area under the curve of the first sections "
                  "(line), their 95&#8201;%% intervals, and the %d that miss (orange), where 10 "
                  "are to be expected. Of %s such runs %.2f&#8201;%% cover the truth, which puts "
                  "the real coverage between %.2f&#8201;%% and %.2f&#8201;%%.", (int)SHOWN, missed,
                  story_count(runs, RUNS), 100.0 * (double)covered / RUNS, 100 * low, 100 * high);
}

void tell_errors(story *s)
{
    tell_convergence(s);
    tell_coverage(s);
}
