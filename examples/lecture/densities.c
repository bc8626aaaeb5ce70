/* Densities: samples that follow one, and which one to follow. */
#include "story.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Simpson's rule in one dimension, where it is unbeatable: to predict variances. */
static double simpson(double (*f)(double x, const void *ctx), const void *ctx, double a, double b)
{
    enum { STEPS = 2000 };
    double sum = f(a, ctx) + f(b, ctx), h = (b - a) / STEPS;
    for (int i = 1; i < STEPS; i++)
        sum += (i % 2 ? 4 : 2) * f(a + i * h, ctx);
    return sum * h / 3;
}

/* ---- a density and its samples ---- */

static double arc_quantile(double u, void *ctx)
{
    (void)ctx;
    return acos(1 - 2 * u);
}

static double arc_pdf(double x, void *ctx)
{
    (void)ctx;
    return sin(x) / 2;
}

static double square(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0];
}

/* Draws the first points of the run and returns how many fall between x1 and x2. */
static size_t draw_arc(text *out, const buffon_density *g, const buffon_run *run, size_t n,
                       double x1, double x2)
{
    double *x = need_memory(n * sizeof *x), at[101], pdf[101], band_x[21], band[21];
    size_t between = 0;
    for (size_t i = 0; i < n; i++) {
        story_check(buffon_sample_at(&x[i], g, i, run), "samples of a density");
        between += x[i] >= x1 && x[i] < x2;
    }
    for (int i = 0; i <= 100; i++) {
        at[i] = PI * i / 100;
        pdf[i] = arc_pdf(at[i], NULL);
    }
    for (int i = 0; i <= 20; i++) {
        band_x[i] = x1 + (x2 - x1) * i / 20;
        band[i] = arc_pdf(band_x[i], NULL);
    }
    ruler across = {.lo = 0, .hi = PI, .label = "x"}, up = {.lo = 0, .hi = 0.6, .label = "density"};
    panel p = panel_begin(out, 860, 330, across, up, "A histogram of samples and their density");
    panel_histogram(&p, "c1", x, n, 0, PI, 50);
    panel_area(&p, "c2", band_x, band, 21, 0);
    panel_line(&p, "exact", at, pdf, 101);
    panel_text(&p, "c2 middle halo bold", (x1 + x2) / 2, 0.2, 0, 0, "%.1f&#8201;%%",
               100.0 * (double)between / (double)n);
    panel_text(&p, "middle halo", PI / 2, 0.56, 0, 4, "g (x) = &#189; sin x");
    panel_end(&p);
    free(x);
    return between;
}

static void tell_pdf(story *s)
{
    enum { SHOWN = 20000 };
    char shown[STORY_COUNT], inside[STORY_COUNT];
    double x1 = 0.6, x2 = 1.1, mass = (cos(x1) - cos(x2)) / 2;
    buffon_inversion arc = {.quantile = arc_quantile, .pdf = arc_pdf};
    buffon_density g = buffon_inverse(&arc);
    buffon_integrand h = {.scalar = square, .dim = 1};
    buffon_run run = story_run(s, 1 << 21);
    buffon_estimate e;
    story_share(s, 0, 0.2);
    story_check(buffon_expectation(&e, &h, &g, &run), "an expectation");

    story_section(s, "Probability density", "g is nowhere negative and integrates to 1; the chance "
                  "to find X between two points is the area between them.");
    story_prose(s, "Samples need not be uniform. A density <i>g</i> says where they crowd, and "
                "that is all an average can notice: integrating <i>h</i> <i>g</i> and averaging "
                "<i>h</i> over samples of <i>g</i> are the same thing. This one theorem carries "
                "everything that follows. Note that the average never evaluates <i>g</i>; it only "
                "follows it.");
    story_formula(s, "P(<i>x</i><sub>1</sub> &le; <i>X</i> &lt; <i>x</i><sub>2</sub>) = "
                  INTEGRAL("<i>x</i><sub>1</sub>", "<i>x</i><sub>2</sub>") " <i>g</i>(<i>x</i>) "
                  "d<i>x</i>, &#8195; " WHOLE "<i>h</i>(<i>x</i>) <i>g</i>(<i>x</i>) d<i>x</i> = "
                  "E[<i>h</i>(<i>X</i>)], &#8195; <i>X</i> ~ <i>g</i>");
    story_code(s, "static double quantile(double u, void *ctx) { return acos(1 - 2 * u); }\n"
               "static double pdf(double x, void *ctx)      { return sin(x) / 2; }\n\n"
               "buffon_density g = buffon_inverse(&(buffon_inversion){.quantile = quantile, "
               ".pdf = pdf});\n"
               "status = buffon_expectation(&e, &h, &g, &run);     /* E[X^2] */\n"
               "for (i = 0; i < 20000; i++)\n"
               "    status = buffon_sample_at(&x[i], &g, i, &run); /* for the figure */");
    size_t between = draw_arc(story_figure(s, "one"), &g, &run, SHOWN, x1, x2);
    story_caption(s, "The first %s samples of the run as a histogram, and <i>g</i> itself. Between "
                  "%.1f and %.1f lie %s of them, %.2f&#8201;%%; the area under <i>g</i> says "
                  "%.2f&#8201;%%.", story_count(shown, SHOWN), x1, x2, story_count(inside, between),
                  100.0 * (double)between / SHOWN, 100 * mass);
    story_add(s, "E[X^2], g = sin(x)/2", "expectation", &e, (PI * PI - 4) / 2);
    story_results(s);
}

/* ---- primary and average estimators ---- */

static double curve_square(double x, const void *ctx)
{
    double y = curve(&x, NULL);
    (void)ctx;
    return y * y;
}

/* The estimates that `repeats` runs of n samples each make. */
static void draw_estimates(text *out, uint64_t n, size_t repeats, double sigma)
{
    double lo = 0, hi = CURVE_END, exact = curve_integral(CURVE_END);
    double *value = need_memory(repeats * sizeof *value);
    buffon_integrand f = {.scalar = curve, .dim = 1};
    buffon_stats stats = {0};
    for (size_t i = 0; i < repeats; i++) {
        buffon_run run = {.samples = n, .seed = 1777, .stream = 1000 * n + i};
        buffon_estimate e;
        story_check(buffon_uniform(&e, &f, &lo, &hi, &run), "average estimator");
        value[i] = e.value;
    }
    buffon_stats_add(&stats, value, repeats);
    double spread = sqrt(buffon_stats_summary(&stats).variance), root = sqrt((double)n);
    double top = n == 1 ? 4.5 : 0.5 * root / sigma;
    ruler across = {.lo = 0, .hi = 1.5, .label = n >= 16 ? "estimate" : NULL};
    ruler up = {.lo = 0, .hi = top, .no_ticks = 1};
    text_add(out, "<div><p>%llu sample%s: spread %.3f, &sigma;/&radic;N = %.3f</p>",
             (unsigned long long)n, n == 1 ? "" : "s each", spread, sigma / root);
    panel p = panel_begin(out, 430, 190, across, up, "A histogram of estimates");
    panel_histogram(&p, "c1", value, repeats, 0, 1.5, n == 64 ? 90 : 60);
    panel_segment(&p, "c2", exact, 0, exact, top);
    panel_end(&p);
    text_put(out, "</div>");
    free(value);
}

static void tell_average(story *s)
{
    enum { REPEATS = 4000 };
    char runs[STORY_COUNT];
    double exact = curve_integral(CURVE_END);
    double sigma = sqrt(CURVE_END * simpson(curve_square, NULL, 0, CURVE_END) - exact * exact);
    story_section(s, "Primary and average estimators", "One sample is an estimate too. One is "
                  "usually not enough.");
    story_prose(s, "<i>f</i>(<i>x</i>) (<i>b</i> &minus; <i>a</i>) with a single random <i>x</i> "
                "has the right mean: it is the <em>primary estimator</em>, right on average and "
                "wrong every time. The <em>average estimator</em> is the mean of <i>N</i> of them. "
                "Its mean is the same, its spread &radic;<i>N</i> times smaller, and whatever the "
                "integrand looked like, the estimates take the shape of a bell: that is why a "
                "standard error is enough to make an interval.");
    story_formula(s, "<i>Z</i><sub>N</sub> = " FRAC("1", "<i>N</i>")
                  " (<i>Z</i><sub>1</sub> + &hellip; + <i>Z</i><sub>N</sub>), &#8195; "
                  "<i>&sigma;</i>(<i>Z</i><sub>N</sub>) = "
                  FRAC("<i>&sigma;</i>(<i>Z</i>)", "&radic;<i>N</i>"));
    story_code(s, "for (i = 0; i < 4000; i++) { /* each stream is a new, independent run */\n"
               "    buffon_run run = {.samples = n, .stream = i};\n"
               "    status = buffon_uniform(&e, &f, &lo, &hi, &run);\n"
               "    buffon_stats_add(&stats, &e.value, 1);\n"
               "}\n"
               "spread = sqrt(buffon_stats_summary(&stats).variance);");
    text *out = story_figure(s, "two");
    for (int i = 0; i < 4; i++) {
        story_share(s, 0.2 + 0.1 * i, 0.3 + 0.1 * i);
        draw_estimates(out, UINT64_C(1) << 2 * i, REPEATS, sigma);
    }
    story_caption(s, "%s runs each of 1, 4, 16 and 64 samples of the curve above: the primary "
                  "estimates are far from the true area %.4f (orange), their averages close in on "
                  "it, four times the samples for half the "
                  "spread.", story_count(runs, REPEATS), exact);
}

/* ---- which density is best ---- */

/* The integrand 4 / (1 + x^2) over (0, 1), whose integral is pi, and four ways to sample it. */
static double lorentz(const double *x, void *ctx)
{
    (void)ctx;
    return 4 / (1 + x[0] * x[0]);
}

static double even_quantile(double u, void *ctx)
{
    (void)ctx;
    return u;
}

static double even_pdf(double x, void *ctx)
{
    (void)x;
    (void)ctx;
    return 1;
}

static double rising_quantile(double u, void *ctx)
{
    (void)ctx;
    return 4 * u / (1 + sqrt(1 + 8 * u));
}

static double rising_pdf(double x, void *ctx)
{
    (void)ctx;
    return (1 + 2 * x) / 2;
}

static double falling_quantile(double u, void *ctx)
{
    (void)ctx;
    return 2 - sqrt(4 - 3 * u);
}

static double falling_pdf(double x, void *ctx)
{
    (void)ctx;
    return (4 - 2 * x) / 3;
}

static double like_f_quantile(double u, void *ctx)
{
    (void)ctx;
    return tan(PI / 4 * u);
}

static double like_f_pdf(double x, void *ctx)
{
    (void)ctx;
    return 4 / (PI * (1 + x * x));
}

typedef struct candidate {
    const char *name, *label, *estimator, *class;
    double (*quantile)(double u, void *ctx);
    double (*pdf)(double x, void *ctx);
} candidate;

static const candidate candidates[] = {
    {"rising, (1 + 2x)/2", "rising", "importance, rising", "c2", rising_quantile, rising_pdf},
    {"uniform, 1", "uniform", "importance, uniform", "c5", even_quantile, even_pdf},
    {"falling, (4 &#8722; 2x)/3", "falling", "importance, falling", "c1", falling_quantile,
     falling_pdf},
    {"like f, 4/&#960;(1 + x&#178;)", "like f", "importance, like f", "c3", like_f_quantile,
     like_f_pdf},
};
enum { CANDIDATES = sizeof candidates / sizeof *candidates };

/* f^2 / g, whose integral less alpha^2 is the variance. */
static double square_over(double x, const void *ctx)
{
    const candidate *g = ctx;
    double f = lorentz(&x, NULL);
    return f * f / g->pdf(x, NULL);
}

/* Two panels: the densities, and the primary estimates f/g that they lead to. */
static void draw_candidates(text *out)
{
    enum { STEPS = 60 };
    static const double label_at[2][CANDIDATES] = {{0.80, 0.15, 0.42, 0.92},
                                                   {0.30, 0.78, 0.93, 0.30}};
    static const double label_dy[2][CANDIDATES] = {{-16, -8, -10, 18}, {-14, -22, 20, 16}};
    for (int side = 0; side < 2; side++) {
        ruler across = {.lo = 0, .hi = 1, .label = "x"}, up = {.lo = 0, .hi = side ? 8.4 : 1.7};
        text_put(out, side ? "<div><p>The primary estimate f/g: the flatter, the better</p>"
                           : "<div><p>f (dashed, scaled) and four densities g</p>");
        panel p = panel_begin(out, 430, 300, across, up, side ? "f over g" : "Densities");
        for (int c = CANDIDATES - 1; c >= 0; c--) {
            double x[STEPS + 1], y[STEPS + 1];
            for (int i = 0; i <= STEPS; i++) {
                x[i] = (double)i / STEPS;
                y[i] = candidates[c].pdf(x[i], NULL);
                if (side)
                    y[i] = lorentz(&x[i], NULL) / y[i];
            }
            panel_line(&p, candidates[c].class, x, y, STEPS + 1);
            if (!side && c == CANDIDATES - 1)
                panel_line(&p, "exact dash", x, y, STEPS + 1);
        }
        for (int c = 0; c < CANDIDATES; c++) {
            char class[32];
            double at = label_at[side][c], y = candidates[c].pdf(at, NULL);
            snprintf(class, sizeof class, "%s middle halo", candidates[c].class);
            panel_text(&p, class, at, side ? lorentz(&at, NULL) / y : y, 0, label_dy[side][c], "%s",
                       candidates[c].label);
        }
        panel_end(&p);
        text_put(out, "</div>");
    }
}

static void sample_candidates(story *s, buffon_estimate e[CANDIDATES])
{
    buffon_integrand f = {.scalar = lorentz, .dim = 1};
    for (int c = 0; c < CANDIDATES; c++) {
        buffon_density g = buffon_inverse(&(buffon_inversion){.quantile = candidates[c].quantile,
                                                              .pdf = candidates[c].pdf});
        buffon_run run = story_run(s, 1 << 20);
        run.constant = c == CANDIDATES - 1; /* f/g is known to be constant there */
        story_share(s, 0.6 + 0.1 * c, 0.7 + 0.1 * c);
        story_check(buffon_importance(&e[c], &f, &g, &run), candidates[c].name);
    }
}

static void tell_importance(story *s, buffon_estimate e[CANDIDATES])
{
    story_section(s, "Sampling from any density", "Where g sends more samples, each must count for "
                  "less: divide by g. But which g is best?");
    story_prose(s, "Apply the theorem to <i>h</i> = <i>f</i>/<i>g</i> and any density may serve to "
                "integrate <i>f</i>, as long as it is positive wherever <i>f</i> is not zero. All "
                "of them are right on average; they differ in noise. The primary estimate is now "
                "<i>f</i>(<i>x</i>)/<i>g</i>(<i>x</i>), and how much it varies decides everything. "
                "Below, four densities for an integrand whose integral is &pi;. One of them rises "
                "where <i>f</i> falls, and is worse than not thinking at all.");
    story_formula(s, "<i>&alpha;</i> = " WHOLE FRAC("<i>f</i>(<i>x</i>)", "<i>g</i>(<i>x</i>)")
                  " <i>g</i>(<i>x</i>) d<i>x</i> &asymp; "
                  FRAC("1", "<i>N</i>") SUM("<i>i</i> = 1", "<i>N</i>")
                  FRAC("<i>f</i>(<i>x</i><sub>i</sub>)", "<i>g</i>(<i>x</i><sub>i</sub>)")
                  ", &#8195; <i>x</i><sub>i</sub> ~ <i>g</i>, &#8195; <i>f</i>(<i>x</i>) = "
                  FRAC("4", "1 + <i>x</i>&sup2;"));
    story_code(s, "static double quantile(double u, void *ctx) { return 2 - sqrt(4 - 3 * u); }\n"
               "static double pdf(double x, void *ctx)      { return (4 - 2 * x) / 3; }\n\n"
               "buffon_density g = buffon_inverse(&(buffon_inversion){.quantile = quantile, "
               ".pdf = pdf});\n"
               "status = buffon_importance(&e, &f, &g, NULL);");
    draw_candidates(story_figure(s, "two"));
    story_caption(s, "Left: the candidates against the shape of <i>f</i>. Right: what one sample "
                  "at <i>x</i> says the integral is. With <i>g</i> shaped like <i>f</i> every "
                  "sample says &pi;.");
    for (int c = 0; c < CANDIDATES; c++)
        story_add(s, "integral of 4/(1+x^2): pi", candidates[c].estimator, &e[c], PI);
    story_results(s);
}

/* How many samples a standard error of 0.001 takes. */
static uint64_t samples_for(const buffon_estimate *e)
{
    return (uint64_t)ceil(e->variance / 1e-6);
}

static void tell_variance(story *s, const buffon_estimate e[CANDIDATES])
{
    char need[3][STORY_COUNT];
    lollipop stick[CANDIDATES];
    ruler across = {.lo = 1e-3, .hi = 100, .log = 1, .label = "variance of one sample"};
    for (int c = 0; c < CANDIDATES; c++) {
        double predicted = simpson(square_over, &candidates[c], 0, 1) - PI * PI;
        stick[c] = (lollipop){candidates[c].name, candidates[c].class, e[c].variance, predicted,
                              ""};
        if (e[c].variance > across.lo)
            snprintf(stick[c].note, sizeof stick[c].note, "%.4g", e[c].variance);
        else
            snprintf(stick[c].note, sizeof stick[c].note, "zero, but for rounding");
    }
    story_section(s, "Variance, and the density that has none",
                  "The mean of the squares less the square of the mean. With g = f / &int; f "
                  "nothing is left of it.");
    story_prose(s, "The variance of the primary estimate is all that separates one density from "
                "another: halve it, and half the samples will do. It falls as <i>g</i> takes the "
                "shape of <i>f</i>, and vanishes when <i>g</i> = <i>f</i>/<i>&alpha;</i>, which is "
                "no free lunch, since that <i>g</i> contains the answer. But a density that "
                "<em>resembles</em> <i>f</i> is often at hand, and that is importance sampling: "
                "put the samples where the integral is.");
    story_formula(s, "<i>&sigma;</i>&sup2;(<i>Z</i>) = &#10216;<i>Z</i>&sup2;&#10217; &minus; "
                  "&#10216;<i>Z</i>&#10217;&sup2; = " WHOLE FRAC("<i>f</i>&sup2;", "<i>g</i>")
                  " d<i>x</i> &minus; <i>&alpha;</i>&sup2;");
    story_code(s, "status = buffon_importance(&e, &f, &g, NULL);\n"
               "printf(\"variance of one sample %g\\n\", e.variance);\n"
               "printf(\"samples for an error of 0.001: %.0f\\n\", e.variance / 1e-6);");
    figure_lollipops(story_figure(s, "one"), across, stick, CANDIDATES, "Variance by density");
    story_caption(s, "Measured variance of one sample (dots) and what the formula predicts (bars). "
                  "For a standard error of 0.001 the rising density needs %s samples, the uniform "
                  "%s, the falling %s, and the last a single "
                  "one.", story_count(need[0], samples_for(&e[0])),
                  story_count(need[1], samples_for(&e[1])),
                  story_count(need[2], samples_for(&e[2])));
}

void tell_densities(story *s)
{
    buffon_estimate e[CANDIDATES];
    tell_pdf(s);
    tell_average(s);
    sample_candidates(s, e);
    tell_importance(s, e);
    tell_variance(s, e);
}
