/* The first chapters: what Monte Carlo is, and why one would. */
#include "story.h"

#include <math.h>

/* ---- Buffon's needle ---- */

/* x[0]: the needle's angle to the lines; x[1]: its middle's distance from the nearest line. */
static double crosses(const double *x, void *ctx)
{
    (void)ctx;
    return x[1] <= 0.5 * sin(x[0]);
}

static const double needle_lo[] = {0, 0}, needle_hi[] = {PI / 2, 0.5};

/* The first needles of the run. Angle and distance decide; place and side are for the eye. */
static int draw_needles(text *out, const buffon_density *throw, const buffon_run *run, int needles)
{
    ruler across = {.lo = 0, .hi = 12, .no_ticks = 1};
    ruler along = {.lo = -0.6, .hi = 3.6, .no_ticks = 1};
    panel p = panel_begin(out, 860, 305, across, along, "Needles thrown on a floor of boards");
    buffon_rng rng = buffon_rng_make(1777, 1);
    int crossing = 0;
    for (int line = 0; line < 4; line++)
        panel_segment(&p, "pale thin", across.lo, line, across.hi, line);
    for (int i = 0; i < needles; i++) {
        double x[2];
        story_check(buffon_sample_at(x, throw, (uint64_t)i, run), "needle");
        double middle = 0.5 + 11 * buffon_rng_next(&rng);
        double line = (double)buffon_rng_below(&rng, 4);
        double side = line == 0 ? 1 : line == 3 ? -1 : buffon_rng_below(&rng, 2) ? 1 : -1;
        double slant = buffon_rng_below(&rng, 2) ? 1 : -1;
        double dx = 0.5 * cos(x[0]) * slant, dy = 0.5 * sin(x[0]);
        int hit = crosses(x, NULL) > 0;
        crossing += hit;
        panel_segment(&p, hit ? "c2" : "c1", middle - dx, line + side * x[1] - dy, middle + dx,
                      line + side * x[1] + dy);
    }
    panel_end(&p);
    return crossing;
}

static void tell_needle(story *s)
{
    enum { SHOWN = 150 };
    char count[STORY_COUNT];
    buffon_density throw = buffon_box(needle_lo, needle_hi, 2);
    buffon_integrand f = {.scalar = crosses, .dim = 2};
    buffon_run run = story_run(s, 1 << 22);
    buffon_estimate e;
    story_share(s, 0, 0.15);
    story_check(buffon_expectation(&e, &f, &throw, &run), "Buffon's needle");

    story_section(s, "The Monte Carlo algorithm: Buffon&#8217;s needle",
                  "Devise a random variable whose mean is the solution; generate samples; collect "
                  "statistics.");
    story_prose(s, "In 1777 the Comte de Buffon asked how often a needle thrown on a floor of "
                "boards comes to lie across a joint. If the needle is as long as a board is wide, "
                "it lies at some angle <i>&theta;</i>, its middle at some distance <i>y</i> from "
                "the nearest joint, and it crosses when <i>y</i> &le; &frac12; sin <i>&theta;</i>. "
                "Averaged over all throws that happens with probability 2/&pi;. So a floor and a "
                "needle compute &pi;: the random variable is <q>1 if it crosses, else 0</q>, its "
                "mean is the solution, and throwing is sampling.");
    story_formula(s, "P(cross) = " FRAC("2", "&pi;") INTEGRAL("0", "&pi;/2") " sin <i>&theta;</i> "
                  "d<i>&theta;</i> = " FRAC("2", "&pi;") " &asymp; " FRAC("needles that cross",
                  "needles thrown"));
    story_code(s, "static double crosses(const double *x, void *ctx) /* angle, distance */\n"
               "{\n"
               "    return x[1] <= 0.5 * sin(x[0]);\n"
               "}\n\n"
               "const double lo[] = {0, 0}, hi[] = {PI / 2, 0.5};\n"
               "buffon_density throw = buffon_box(lo, hi, 2);\n"
               "buffon_integrand f = {.scalar = crosses, .dim = 2};\n"
               "status = buffon_expectation(&e, &f, &throw, &(buffon_run){.samples = 1 << 22});");
    int crossing = draw_needles(story_figure(s, "one"), &throw, &run, SHOWN);
    story_caption(s, "The first %d needles of the run; %d of them cross (orange), which would make "
                  "&pi; about %.2f. All %s together give &pi; = %.4f, with 95&#8201;%% confidence "
                  "between %.4f and %.4f.", (int)SHOWN, crossing, 2.0 * SHOWN / crossing,
                  story_count(count, e.samples), 2 / e.value, 2 / e.hi, 2 / e.lo);
    story_add(s, "Buffon's needle: 2/pi", "expectation", &e, 2 / PI);
    story_results(s);
}

/* ---- the curve, and basic Monte Carlo ---- */

double curve(const double *x, void *ctx)
{
    double s = sin(2 * x[0]);
    (void)ctx;
    return exp(-x[0]) * s * s;
}

double curve_integral(double end)
{
    double fall = exp(-end);
    double wave = (1 + fall * (4 * sin(4 * end) - cos(4 * end))) / 17;
    return (1 - fall - wave) / 2;
}

void draw_curve(panel *p, const char *class, int filled)
{
    enum { STEPS = 200 };
    double x[STEPS + 1], y[STEPS + 1];
    for (int i = 0; i <= STEPS; i++) {
        x[i] = CURVE_END * i / STEPS;
        y[i] = curve(&x[i], NULL);
    }
    if (filled)
        panel_area(p, class, x, y, STEPS + 1, 0);
    else
        panel_line(p, class, x, y, STEPS + 1);
}

static void tell_basic(story *s)
{
    enum { SHOWN = 32 };
    char count[STORY_COUNT];
    double lo = 0, hi = CURVE_END, mean = 0, x[SHOWN], y[SHOWN];
    buffon_integrand f = {.scalar = curve, .dim = 1};
    buffon_run run = story_run(s, 1 << 22);
    buffon_density segment = buffon_segment(lo, hi);
    buffon_estimate e;
    story_share(s, 0.15, 0.3);
    story_check(buffon_uniform(&e, &f, &lo, &hi, &run), "basic Monte Carlo");
    for (int i = 0; i < SHOWN; i++) {
        story_check(buffon_sample_at(&x[i], &segment, (uint64_t)i, &run), "basic Monte Carlo");
        y[i] = curve(&x[i], NULL);
        mean += y[i] / SHOWN;
    }

    story_section(s, "Basic Monte Carlo", "The area under a curve is its width times its mean "
                  "height; the mean height is that at random places, averaged.");
    story_prose(s, "To integrate <i>f</i> from <i>a</i> to <i>b</i>, draw places "
                "<i>x</i><sub>i</sub> uniformly between them and average. Nothing is asked of "
                "<i>f</i> but that it can be evaluated, and in ten dimensions the recipe is the "
                "same as in one: it scales well. The price is noise, so an estimate without its "
                "standard error is worth little. The samples that make the one make the other.");
    story_formula(s, "<i>&alpha;</i> = " INTEGRAL("<i>a</i>", "<i>b</i>") " <i>f</i>(<i>x</i>) "
                  "d<i>x</i> &asymp; " FRAC("<i>b</i> &minus; <i>a</i>", "<i>N</i>")
                  SUM("<i>i</i> = 1", "<i>N</i>") " <i>f</i>(<i>x</i><sub>i</sub>), &#8195; "
                  "<i>f</i>(<i>x</i>) = e<sup>&minus;<i>x</i></sup> sin&sup2; 2<i>x</i>");
    story_code(s, "double lo = 0, hi = 3;\n"
               "buffon_integrand f = {.scalar = curve, .dim = 1};\n"
               "status = buffon_uniform(&e, &f, &lo, &hi, &(buffon_run){.samples = 1 << 22});\n"
               "printf(\"%g +- %g\\n\", e.value, e.std_error);");
    ruler across = {.lo = 0, .hi = CURVE_END, .label = "x"};
    ruler up = {.lo = 0, .hi = 0.55, .label = "f (x)"};
    panel p = panel_begin(story_figure(s, "one"), 860, 330, across, up, "A curve with 32 samples");
    panel_rectangle(&p, "c1", 0, 0, CURVE_END, mean);
    for (int i = 0; i < SHOWN; i++)
        panel_segment(&p, "c1 hair", x[i], 0, x[i], y[i]);
    draw_curve(&p, "exact", 0);
    panel_dots(&p, "c1", 7, x, y, SHOWN);
    panel_segment(&p, "c2 dash", 0, e.value / CURVE_END, CURVE_END, e.value / CURVE_END);
    panel_segment(&p, "c1", 0, mean, CURVE_END, mean);
    panel_text(&p, "c1 end halo", CURVE_END, fmax(mean, e.value / CURVE_END), 0, -8,
               "mean of %d samples %.3f", (int)SHOWN, mean);
    panel_text(&p, "c2 end halo", CURVE_END, fmin(mean, e.value / CURVE_END), 0, 18,
               "mean of all %.4f", e.value / CURVE_END);
    panel_end(&p);
    story_caption(s, "The first %d samples of the run. The shaded rectangle has their mean height; "
                  "its area, %.3f, is the estimate that they make. The dashed line is the mean of "
                  "all %s.", (int)SHOWN, mean * CURVE_END, story_count(count, e.samples));
    story_add(s, "area under the curve", "uniform", &e, curve_integral(CURVE_END));
    story_results(s);
}

/* ---- rejection ---- */

static void draw_rejection(story *s, const buffon_run *run, int shown)
{
    double lo[] = {0, 0}, hi[] = {CURVE_END, CURVE_TOP};
    buffon_density board = buffon_box(lo, hi, 2);
    ruler across = {.lo = 0, .hi = CURVE_END, .label = "x"};
    ruler up = {.lo = 0, .hi = CURVE_TOP, .label = "y"};
    panel p = panel_begin(story_figure(s, "one"), 860, 340, across, up,
                          "Points in a box, under the curve or above it");
    draw_curve(&p, "c3", 1);
    for (int under = 0; under < 2; under++)
        for (int i = 0; i < shown; i++) {
            double x[2];
            story_check(buffon_sample_at(x, &board, (uint64_t)i, run), "rejection");
            if ((x[1] <= curve(x, NULL)) == under)
                panel_dots(&p, under ? "c3" : "c2", 5, &x[0], &x[1], 1);
        }
    draw_curve(&p, "exact", 0);
    panel_end(&p);
}

static void tell_rejection(story *s)
{
    enum { SHOWN = 600 };
    double lo = 0, hi = CURVE_END;
    buffon_integrand f = {.scalar = curve, .dim = 1};
    buffon_run run = story_run(s, SHOWN);
    buffon_estimate few, e;
    story_share(s, 0.3, 0.45);
    story_check(buffon_rejection(&few, &f, &lo, &hi, CURVE_TOP, &run), "rejection");
    run.samples = 1 << 22;
    story_check(buffon_rejection(&e, &f, &lo, &hi, CURVE_TOP, &run), "rejection");

    story_section(s, "The rejection method", "Throw points at a box around the curve and count "
                  "those that fall under it.");
    story_prose(s, "If the curve stays below <i>h</i>, the share of points (<i>x</i>, <i>y</i>) of "
                "the box that lie under it is the share of the area. It is the needle once more: a "
                "sample says only yes or no, which wastes what <i>f</i> could tell, so its error "
                "is larger than that of the mean height from as many samples. In return the "
                "interval can be exact: a number of hits is binomial, and the interval of Clopper "
                "and Pearson covers the truth at least as often as it states, for any number of "
                "samples. A value above <i>h</i> would silently spoil the estimate, so here it "
                "ends the run with the offending point.");
    story_formula(s, "<i>&alpha;</i> &asymp; " FRAC("<i>N</i><sup>&lowast;</sup>", "<i>N</i>")
                  " <i>h</i> (<i>b</i> &minus; <i>a</i>), &#8195; <i>N</i><sup>&lowast;</sup> = "
                  "number of points with <i>y</i><sub>i</sub> &le; <i>f</i>(<i>x</i><sub>i</sub>)");
    story_code(s, "double lo = 0, hi = 3, height = 0.5;\n"
               "buffon_run run = {.samples = 600};\n"
               "status = buffon_rejection(&e, &f, &lo, &hi, height, &run);\n"
               "printf(\"%g, 95 %% sure between %g and %g\\n\", e.value, e.lo, e.hi);");
    draw_rejection(s, &run, SHOWN);
    story_caption(s, "%.0f of %d points fall under the curve: <i>&alpha;</i> &asymp; %.3f, and the "
                  "interval of Clopper and Pearson runs from %.3f to %.3f. The exact area is %.4f.",
                  few.acceptance * SHOWN, (int)SHOWN, few.value, few.lo, few.hi,
                  curve_integral(CURVE_END));
    story_add(s, "area under the curve", "rejection", &few, curve_integral(CURVE_END));
    story_add(s, "area under the curve", "rejection", &e, curve_integral(CURVE_END));
    story_results(s);
}

/* ---- why not quadrature ---- */

#define MOST_DIMENSIONS 20

/* A smooth bump over the unit cube with integral 1 in any dimension; *ctx is the dimension. */
static double bump(const double *x, void *ctx)
{
    double product = 1;
    for (int j = 0; j < *(const int *)ctx; j++)
        product *= PI / 2 * sin(PI * x[j]);
    return product;
}

/* 1 inside the unit ball, 0 outside. */
static double ball(const double *x, void *ctx)
{
    double square = 0;
    for (int j = 0; j < *(const int *)ctx; j++)
        square += x[j] * x[j];
    return square <= 1;
}

/* The midpoint rule: k places along each of d coordinates, k^d in all. */
static double midpoint(double (*f)(const double *x, void *ctx), int d, int k, double lo, double hi)
{
    int digit[MOST_DIMENSIONS] = {0};
    double x[MOST_DIMENSIONS], sum = 0, cell = (hi - lo) / k;
    for (int j = 0; j < d; j++)
        x[j] = lo + 0.5 * cell;
    for (int j = 0; j < d;) {
        sum += f(x, &d);
        for (j = 0; j < d; j++) { /* count up, with d digits in base k */
            digit[j] = (digit[j] + 1) % k;
            x[j] = lo + (digit[j] + 0.5) * cell;
            if (digit[j] != 0)
                break;
        }
    }
    return sum * pow(cell, d);
}

static buffon_estimate sample_cube(story *s, double (*f)(const double *x, void *ctx), int d,
                                   double lo, double hi, uint64_t samples)
{
    double low[MOST_DIMENSIONS], high[MOST_DIMENSIONS];
    buffon_integrand integrand = {.scalar = f, .dim = (size_t)d, .ctx = &d};
    buffon_run run = story_run(s, samples);
    buffon_estimate e;
    for (int j = 0; j < d; j++) {
        low[j] = lo;
        high[j] = hi;
    }
    story_check(buffon_uniform(&e, &integrand, low, high, &run), "many dimensions");
    return e;
}

/* Error against dimension, all with 2^20 evaluations. */
static void draw_dimensions(story *s, text *out)
{
    static const int dimension[] = {1, 2, 4, 5, 10, 20};
    static const int places[] = {1 << 20, 1 << 10, 1 << 5, 1 << 4, 1 << 2, 1 << 1};
    enum { COUNT = sizeof dimension / sizeof *dimension };
    double d[COUNT], grid[COUNT], random[COUNT];
    for (int i = 0; i < COUNT; i++) {
        story_share(s, 0.45 + 0.08 * i, 0.53 + 0.08 * i);
        buffon_estimate e = sample_cube(s, bump, dimension[i], 0, 1, 1 << 20);
        d[i] = dimension[i];
        random[i] = e.std_error;
        grid[i] = fmax(fabs(midpoint(bump, dimension[i], places[i], 0, 1) - 1), 1e-14);
        if (dimension[i] == 10)
            story_add(s, "product of sines, d = 10", "uniform", &e, 1);
    }
    ruler across = {.lo = 0.9, .hi = 25, .log = 1, .label = "dimension", .no_ticks = 1};
    ruler up = {.lo = 1e-14, .hi = 100, .log = 1, .label = "relative error"};
    text_put(out, "<div><p>A smooth integrand</p>");
    panel p = panel_begin(out, 430, 320, across, up, "Error against dimension");
    for (int i = 0; i < COUNT; i++)
        panel_text(&p, "tick middle", d[i], up.lo, 0, 15, "%d", dimension[i]);
    panel_line(&p, "c2", d, grid, COUNT);
    panel_dots(&p, "c2", 8, d, grid, COUNT);
    panel_line(&p, "c1", d, random, COUNT);
    panel_dots(&p, "c1", 8, d, random, COUNT);
    panel_text(&p, "c2 halo", 1.41, 4e-10, 12, 8, "midpoint rule");
    panel_text(&p, "c1 halo", 1.05, random[0], 0, -12, "Monte Carlo");
    panel_end(&p);
    text_put(out, "</div>");
}

/* The volume of the ball against the number of evaluations, in ten dimensions. */
static void draw_ball(story *s, text *out, double volume)
{
    enum { D = 10, COUNT = 3 };
    double n[COUNT], grid[COUNT], random[COUNT];
    ruler across = {.lo = 400, .hi = 3e6, .log = 1, .label = "evaluations"};
    ruler up = {.lo = -0.8, .hi = 6.4, .label = "estimated volume"};
    text_put(out, "<div><p>A discontinuous one: the ball in ten dimensions</p>");
    panel p = panel_begin(out, 430, 320, across, up, "Estimates of the volume of a ball");
    panel_segment(&p, "exact dash thin", across.lo, volume, across.hi, volume);
    for (int i = 0; i < COUNT; i++) {
        int k = i + 2;
        story_share(s, 0.93 + 0.02 * i, 0.95 + 0.02 * i);
        n[i] = pow(k, D);
        buffon_estimate e = sample_cube(s, ball, D, -1, 1, (uint64_t)n[i]);
        grid[i] = midpoint(ball, D, k, -1, 1);
        random[i] = e.value;
        panel_segment(&p, "c1", n[i], e.value - 2 * e.std_error, n[i], e.value + 2 * e.std_error);
        if (i == COUNT - 1)
            story_add(s, "volume of the ball, d = 10", "uniform", &e, volume);
    }
    panel_line(&p, "c2 thin dash", n, grid, COUNT);
    panel_dots(&p, "c2", 8, n, grid, COUNT);
    panel_dots(&p, "c1", 8, n, random, COUNT);
    panel_text(&p, "c2 halo", n[0], grid[0], 12, 5, "midpoint rule");
    panel_text(&p, "c1 halo middle", n[1], random[1], 0, -44, "Monte Carlo");
    panel_text(&p, "halo middle", 7000, volume, 0, -7, "exact %.3f", volume);
    panel_end(&p);
    text_put(out, "</div>");
}

static void tell_quadrature(story *s)
{
    double volume = pow(PI, 5) / 120;
    story_section(s, "Why not quadrature?", "The integrand may be discontinuous; and in high "
                  "dimensions a grid is useless.");
    story_prose(s, "In one dimension a quadrature rule wins by many digits. But a grid with "
                "<i>k</i> places along each axis has <i>k</i><sup><i>d</i></sup> points, and a "
                "million evaluations buy a million places in one dimension, four along each axis "
                "in ten and two in twenty. The standard error of Monte Carlo is "
                "<i>&sigma;</i>/&radic;<i>N</i> in every dimension. It does not mind a jump "
                "either, and it comes with an error bar, which the grid does not.");
    story_formula(s, "grid: error ~ <i>N</i><sup>&minus;2/<i>d</i></sup>, if <i>f</i> is smooth "
                  "&#8195;&#8195; Monte Carlo: error ~ <i>N</i><sup>&minus;1/2</sup>");
    story_code(s, "static double ball(const double *x, void *ctx) /* 1 inside, 0 outside */\n"
               "{\n"
               "    double square = 0;\n"
               "    for (int j = 0; j < 10; j++)\n"
               "        square += x[j] * x[j];\n"
               "    return square <= 1;\n"
               "}\n\n"
               "buffon_integrand f = {.scalar = ball, .dim = 10};\n"
               "status = buffon_uniform(&e, &f, lo, hi, NULL); /* 2^20 points of [-1, 1]^10 */");
    text *out = story_figure(s, "two");
    draw_dimensions(s, out);
    draw_ball(s, out, volume);
    story_caption(s, "Left: relative errors for the product of (&pi;/2) sin "
                  "&pi;<i>x</i><sub>j</sub>, always with 2<sup>20</sup> evaluations: the grid "
                  "against the standard error of Monte Carlo. Right: grids of 2, 3 and 4 places "
                  "along each axis, and as many random points with their 95&#8201;%% intervals.");
    story_results(s);
}

void tell_integrals(story *s)
{
    tell_needle(s);
    tell_basic(s);
    tell_rejection(s);
    tell_quadrature(s);
}
