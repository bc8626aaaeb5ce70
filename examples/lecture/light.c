/* Light: how much of it a surface reflects, estimated in one way after the other. */
#include "story.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A white matt surface facing +z under a disk of light in the sky: a cap of directions. */
typedef struct lamp {
    double axis[3]; /* to the middle of the light */
    double h;       /* its height as a cap, 1 - cos(half angle) */
    double light;   /* radiance L0 of the light, */
    double sky;     /* and of the rest of the sky */
    double albedo;  /* rho */
} lamp;

#define HALF_ANGLE (20 * PI / 180)
#define TILT (40 * PI / 180)

static lamp make_lamp(double sky)
{
    double sine = sin(HALF_ANGLE / 2);
    return (lamp){{sin(TILT), 0, cos(TILT)}, 2 * sine * sine, 10, sky, 0.8};
}

static int in_light(const double *w, const lamp *s)
{
    double chord = 0; /* squared distance on the unit sphere: 2 (1 - cos) */
    for (int k = 0; k < 3; k++)
        chord += (w[k] - s->axis[k]) * (w[k] - s->axis[k]);
    return chord <= 2 * s->h;
}

/* (rho / pi) L(w) cos(theta) */
static double reflected(const double *w, void *ctx)
{
    const lamp *s = ctx;
    if (w[2] <= 0)
        return 0;
    return s->albedo / PI * (in_light(w, s) ? s->light : s->sky) * w[2];
}

/* The same without the light: what comes from the rest of the sky. */
static double reflected_sky(const double *w, void *ctx)
{
    return in_light(w, ctx) ? 0 : reflected(w, ctx);
}

/* A cap that is wholly above the horizon lights the surface by pi sin^2(half angle) cos(tilt). */
static double reflected_exactly(const lamp *s)
{
    double seen = pow(sin(HALF_ANGLE), 2) * cos(TILT);
    return s->albedo * (s->sky + (s->light - s->sky) * seen);
}

static buffon_estimate reflect(story *s, const lamp *light, const buffon_density *g)
{
    lamp copy = *light;
    buffon_integrand f = {.scalar = reflected, .dim = 3, .ctx = &copy};
    buffon_run run = story_run(s, 1 << 20);
    buffon_estimate e;
    story_check(buffon_importance(&e, &f, g, &run), "reflected radiance");
    return e;
}

/* ---- drawing directions ---- */

static void draw_light(globe *g, const lamp *light)
{
    static const double origin[3] = {0, 0, 0}, up[3] = {0, 0, 1.14};
    globe_circle(g, "c2", light->axis, 1 - light->h);
    globe_segment(g, "exact", origin, up);
    globe_text(g, "middle", up, 0, -5, "n");
}

/* The first directions of a run; those that reach the light in orange. `only`: 0 leaves out those
 * that do, 1 those that do not, -1 none. */
static void draw_samples(globe *g, const lamp *light, const buffon_density *law, size_t n, int only)
{
    double *w = need_memory(3 * n * sizeof *w);
    buffon_run run = {.seed = 1777};
    for (int lit = 0; lit < 2; lit++) {
        size_t found = 0;
        for (size_t i = 0; i < n; i++) {
            story_check(buffon_sample_at(w + 3 * found, law, i, &run), "directions");
            found += in_light(w + 3 * found, light) == lit;
        }
        if (only < 0 || only == lit)
            globe_dots(g, lit ? "c2" : "c1", lit ? 4.4 : 3.6, w, found);
    }
    free(w);
}

static void draw_directions(text *out, const lamp *light, const buffon_density *law, size_t n,
                            const char *title)
{
    text_add(out, "<div><p>%s</p>", title);
    globe g = globe_begin(out, 430, 24, -62, 1, "Directions over a surface");
    draw_samples(&g, light, law, n, -1);
    draw_light(&g, light);
    globe_end(&g);
    text_put(out, "</div>");
}

/* What each of the first samples says: the primary estimates, one after the other. */
static void draw_primaries(text *out, const lamp *light, const buffon_density *g, double top)
{
    enum { SHOWN = 200 };
    lamp copy = *light;
    buffon_run run = {.seed = 1777};
    double mean = 0;
    ruler across = {.lo = 0, .hi = SHOWN, .label = "sample"};
    ruler up = {.lo = 0, .hi = top, .label = "primary estimate"};
    text_add(out, "<div><p>What %d samples say</p>", (int)SHOWN);
    panel p = panel_begin(out, 430, 268, across, up, "Primary estimates in order");
    for (int i = 0; i < SHOWN; i++) {
        double w[3], pdf;
        story_check(buffon_sample_at(w, g, (uint64_t)i, &run), "directions");
        story_check(buffon_density_pdf(&pdf, w, 1, g), "directions");
        double z = reflected(w, &copy) / pdf;
        mean += z / SHOWN;
        if (z > 0)
            panel_segment(&p, "c2 thin", i + 0.5, 0, i + 0.5, z);
    }
    panel_segment(&p, "exact dash", 0, reflected_exactly(light), SHOWN, reflected_exactly(light));
    panel_text(&p, "end halo", SHOWN, top, 0, 14, "their mean %.3f, exact %.3f", mean,
               reflected_exactly(light));
    panel_end(&p);
    text_put(out, "</div>");
}

/* ---- reflected radiance ---- */

static buffon_estimate tell_radiance(story *s, const lamp *light)
{
    buffon_density hemisphere = buffon_hemisphere();
    story_share(s, 0, 0.15);
    buffon_estimate e = reflect(s, light, &hemisphere);
    story_section(s, "Image synthesis: reflected radiance",
                  "What a surface sends to the eye is an integral over all directions from which "
                  "light arrives.");
    story_prose(s, "A matt surface with albedo <i>&rho;</i> gathers the radiance <i>L</i> from the "
                "whole hemisphere &Omega; above it, weighted by the cosine of the angle to its "
                "normal. If only a region <i>&gamma;</i> shines, with constant radiance "
                "<i>L</i><sub>0</sub>, only that region counts. Here <i>&gamma;</i> is a spherical "
                "lamp that appears 40&deg; wide and stands 40&deg; from the normal, for which the "
                "integral is known: <i>&pi;</i> sin&sup2; 20&deg; cos 40&deg;. The simplest "
                "estimator looks in random directions of the hemisphere. Most of them miss "
                "the lamp and contribute nothing.");
    story_formula(s, "<i>L&prime;</i> = " FRAC("<i>&rho;</i>", "&pi;") OVER("&Omega;")
                  "<i>L</i>(<i>&omega;</i>) cos <i>&theta;</i> d<i>&omega;</i> = "
                  FRAC("<i>&rho; L</i><sub>0</sub>", "&pi;") OVER("&gamma;")
                  "cos <i>&theta;</i> d<i>&omega;</i>");
    story_code(s, "static double reflected(const double *w, void *ctx)\n"
               "{\n"
               "    return in_light(w) ? rho / PI * L0 * w[2] : 0; /* w[2] = cos(theta) */\n"
               "}\n\n"
               "buffon_density g = buffon_hemisphere();\n"
               "buffon_integrand f = {.scalar = reflected, .dim = 3};\n"
               "status = buffon_importance(&e, &f, &g, NULL);");
    text *out = story_figure(s, "two");
    draw_directions(out, light, &hemisphere, 700, "Uniform directions of the hemisphere");
    draw_primaries(out, light, &hemisphere, 18);
    story_caption(s, "Left: 700 uniform directions; only those within the circle (orange) see the "
                  "lamp, which covers %.1f&#8201;%% of the hemisphere. Right: most samples say "
                  "zero, a few say far too much.", 100 * light->h);
    story_add(s, "reflected radiance of a lamp", "uniform hemisphere", &e,
              reflected_exactly(light));
    story_results(s);
    return e;
}

/* ---- the cap ---- */

static buffon_estimate tell_cap(story *s, const lamp *light)
{
    buffon_density cap = buffon_cap_angle(HALF_ANGLE, light->axis);
    story_share(s, 0.3, 0.45);
    buffon_estimate e = reflect(s, light, &cap);
    story_section(s, "The top of the sphere: sampling a light", "A sphere seen from anywhere "
                  "outside is a cap of directions.");
    story_prose(s, "Stop the plane of Archimedes at height <i>h</i> instead of going down to the "
                "south pole, and the same construction gives uniform points of a cap. Turned "
                "towards the lamp, that is exactly the set of directions in which the lamp is "
                "seen, so every sample now reaches it. What noise is left comes from the cosine "
                "alone. (The library carries 1 &minus; <i>h</i>, which for something as small as "
                "the sun keeps the digits that <i>h</i> itself has lost.)");
    story_formula(s, "<i>z</i> = 1 &minus; (1 &minus; <i>h</i>) <i>u</i><sub>1</sub>, &#8195; "
                  "<i>g</i> "
                  "= " FRAC("1", "2&pi; (1 &minus; <i>h</i>)") ", &#8195; <i>x</i>, <i>y</i> "
                  "as on the sphere");
    story_code(s, "/* the directions in which a sphere is seen ... */\n"
               "buffon_density g = buffon_cap_of_sphere(from, centre, radius);\n"
               "/* ... or, here, the cap within 20 degrees of an axis */\n"
               "buffon_density g = buffon_cap_angle(20 * PI / 180, axis);\n"
               "status = buffon_importance(&e, &f, &g, NULL);");
    text *out = story_figure(s, "two");
    draw_directions(out, light, &cap, 400, "Uniform directions of the cap");
    draw_primaries(out, light, &cap, 18);
    story_caption(s, "The same lamp, the same scale as before. Every one of the 400 directions "
                  "sees it, and every sample says nearly the right thing: the variance is %.2g "
                  "instead of %.2g.", e.variance, s->row[s->rows - 2].estimate.variance);
    story_add(s, "reflected radiance of a lamp", "uniform cap", &e, reflected_exactly(light));
    story_results(s);
    return e;
}

/* ---- the whole sky in two strata ---- */

static buffon_estimate reflect_strata(story *s, lamp *sky, int allocation)
{
    buffon_density cap = buffon_cap_angle(HALF_ANGLE, sky->axis);
    buffon_density rest = buffon_hemisphere_cosine();
    buffon_integrand from_light = {.scalar = reflected, .dim = 3, .ctx = sky};
    buffon_integrand from_rest = {.scalar = reflected_sky, .dim = 3, .ctx = sky};
    buffon_stratum stratum[] = {{.density = &cap, .f = &from_light},
                                {.density = &rest, .f = &from_rest}};
    buffon_strata strata = {.stratum = stratum, .count = 2, .allocation = allocation};
    buffon_run run = story_run(s, 1 << 20);
    buffon_estimate e;
    story_check(buffon_stratified(&e, NULL, &strata, &run), "strata");
    return e;
}

static void draw_strata(text *out, const lamp *sky)
{
    buffon_density rest = buffon_hemisphere_cosine();
    buffon_density cap = buffon_cap_angle(HALF_ANGLE, sky->axis);
    text_put(out, "<div><p>&gamma; (orange) and the rest of &Omega; (blue)</p>");
    globe g = globe_begin(out, 430, 24, -62, 1, "Directions in two strata");
    draw_samples(&g, sky, &rest, 300, 0);
    draw_samples(&g, sky, &cap, 300, 1);
    draw_light(&g, sky);
    globe_end(&g);
    text_put(out, "</div>");
}

static void draw_strata_errors(text *out, const buffon_estimate e[4])
{
    static const char *name[] = {"uniform", "cosine", "half and half", "Neyman"};
    double top = 1.18 * e[0].std_error * 1e4;
    ruler across = {.lo = 0, .hi = 4, .no_ticks = 1, .label = "&#160;"};
    ruler up = {.lo = 0, .hi = top, .label = "standard error, in units of 0.0001"};
    text_put(out, "<div><p>Standard error at equal samples</p>");
    panel p = panel_begin(out, 430, 268, across, up, "Standard errors");
    for (int i = 0; i < 4; i++) {
        double error = e[i].std_error * 1e4;
        panel_rectangle(&p, i < 2 ? "c1 bar" : "c2 bar", i + 0.2, 0, i + 0.8, error);
        panel_text(&p, "middle", i + 0.5, error, 0, -6, "%.2f", error);
        panel_text(&p, "tick middle", i + 0.5, 0, 0, 17, "%s", name[i]);
    }
    panel_end(&p);
    text_put(out, "</div>");
}

static void tell_strata(story *s)
{
    lamp sky = make_lamp(1);
    buffon_density uniform = buffon_hemisphere(), cosine = buffon_hemisphere_cosine();
    buffon_estimate e[4];
    static const char *name[] = {"uniform hemisphere", "cosine hemisphere", "gamma + rest",
                                 "gamma + rest, Neyman"};
    story_share(s, 0.45, 0.55);
    e[0] = reflect(s, &sky, &uniform);
    e[1] = reflect(s, &sky, &cosine);
    story_share(s, 0.55, 0.65);
    e[2] = reflect_strata(s, &sky, BUFFON_ALLOCATION_SHARE);
    e[3] = reflect_strata(s, &sky, BUFFON_ALLOCATION_NEYMAN);
    story_section(s, "Indirect light: stratification", "Split the region where the integrand is of "
                  "two minds, and estimate each part on its own.");
    story_prose(s, "Now the rest of the sky shines too, ten times fainter than the lamp but from "
                "everywhere. A sampler for the lamp cannot see the sky, and one for the sky rarely "
                "meets the lamp. So cut the hemisphere into <i>&gamma;</i>, where the lamp is, and "
                "the rest, give each the density that suits it, and add the two estimates; their "
                "errors add in squares. How to share the samples? Half and half is a fair guess; "
                "Neyman&#8217;s rule gives each part as many as its own spread deserves, found by "
                "a short pilot run that does not enter the estimate.");
    story_formula(s, OVER("&Omega;") "<i>f</i> d<i>&omega;</i> = " OVER("&Omega; &minus; &gamma;")
                  "<i>f</i> d<i>&omega;</i> + " OVER("&gamma;") "<i>f</i> d<i>&omega;</i>, &#8195; "
                  "<i>&sigma;</i>&sup2; = " FRAC("<i>&sigma;</i><sub>1</sub>&sup2;",
                  "<i>N</i><sub>1</sub>") " + " FRAC("<i>&sigma;</i><sub>2</sub>&sup2;",
                  "<i>N</i><sub>2</sub>"));
    story_code(s, "buffon_density cap = buffon_cap_angle(20 * PI / 180, axis);\n"
               "buffon_density all = buffon_hemisphere_cosine();\n"
               "buffon_stratum part[] = {{.density = &cap, .f = &from_light},\n"
               "                         {.density = &all, .f = &from_rest}}; /* 0 in the cap */\n"
               "buffon_strata strata = {.stratum = part, .count = 2,\n"
               "                        .allocation = BUFFON_ALLOCATION_NEYMAN};\n"
               "status = buffon_stratified(&e, NULL, &strata, NULL);");
    text *out = story_figure(s, "two");
    draw_strata(out, &sky);
    draw_strata_errors(out, e);
    story_caption(s, "Left: samples of both strata. Right: what the whole sky costs without strata "
                  "(blue) and with them (orange). The split with Neyman&#8217;s shares has a "
                  "variance %.0f times smaller than uniform directions.",
                  e[0].variance / e[3].variance);
    for (int i = 0; i < 4; i++)
        story_add(s, "lamp and sky", name[i], &e[i], reflected_exactly(&sky));
    story_results(s);
}

/* ---- the weighted hemisphere ---- */

static double cosine_of(const double *w, void *ctx)
{
    (void)ctx;
    return w[2];
}

static void draw_light_methods(story *s, const buffon_estimate e[3])
{
    static const char *name[] = {"uniform hemisphere", "cosine hemisphere", "uniform cap"};
    static const char *class[] = {"c1", "c4", "c2"};
    lollipop stick[3];
    ruler across = {.lo = 1e-4, .hi = 100, .log = 1, .label = "variance of one sample"};
    for (int i = 0; i < 3; i++) {
        stick[i] = (lollipop){name[i], class[i], e[i].variance, 0, ""};
        snprintf(stick[i].note, sizeof stick[i].note, "%.2g", e[i].variance);
    }
    figure_lollipops(story_figure(s, "one"), across, stick, 3, "Variance by density");
    story_caption(s, "The lamp alone, by three densities: one sample of the cap is worth %.0f of "
                  "the uniform hemisphere and %.0f of the cosine hemisphere.",
                  e[0].variance / e[2].variance, e[1].variance / e[2].variance);
}

static void tell_hemisphere(story *s, const lamp *light, const buffon_estimate by[3])
{
    buffon_density law[2] = {buffon_hemisphere(), buffon_hemisphere_cosine()};
    buffon_integrand f = {.scalar = cosine_of, .dim = 3};
    buffon_estimate e[2];
    for (int i = 0; i < 2; i++) {
        buffon_run run = story_run(s, 1 << 20);
        run.constant = i; /* cos / (cos / pi) is pi, always */
        story_share(s, 0.8 + 0.1 * i, 0.9 + 0.1 * i);
        story_check(buffon_importance(&e[i], &f, &law[i], &run), "hemisphere");
    }
    story_section(s, "The weighted hemisphere", "To sample directions with density cos &theta; / "
                  "&pi;, sample the disk below and project upwards.");
    story_prose(s, "A patch of the hemisphere that leans by <i>&theta;</i> casts a shadow on the "
                "ground that is cos <i>&theta;</i> times its size. So uniform points of the "
                "ground, lifted to the sphere, arrive with density proportional to the cosine. "
                "That density contains one factor of the integrand already: for a sky that is the "
                "same everywhere nothing is left, and the estimate has no variance. For a small "
                "lamp the cosine is the lesser problem, and it helps but little.");
    story_formula(s, "(<i>x</i>, <i>y</i>) uniform in the disk, &#8195; <i>z</i> = &radic;(1 "
                  "&minus; <i>x</i>&sup2; &minus; <i>y</i>&sup2;), &#8195; <i>g</i> = "
                  FRAC("cos <i>&theta;</i>", "&pi;"));
    story_code(s, "buffon_density g = buffon_hemisphere_cosine();\n"
               "status = buffon_importance(&e, &f, &g, &(buffon_run){.constant = 1});\n"
               "/* .constant: f/g is known to be constant, so that no spread is no surprise */");
    text *out = story_figure(s, "three");
    draw_hemispheres(out);
    story_caption(s, "Left: points of the disk (blue) and above them (orange). Middle and right: "
                  "the same 900 pairs of random numbers as uniform and as cosine-weighted "
                  "directions, seen from straight above: where the cosine is small there are "
                  "fewer, and the disk is covered evenly.");
    draw_light_methods(s, by);
    story_add(s, "cos over the hemisphere: pi", "uniform hemisphere", &e[0], PI);
    story_add(s, "cos over the hemisphere: pi", "cosine hemisphere", &e[1], PI);
    story_add(s, "reflected radiance of a lamp", "cosine hemisphere", &by[1],
              reflected_exactly(light));
    story_results(s);
}

void tell_light(story *s)
{
    lamp light = make_lamp(0);
    buffon_density cosine = buffon_hemisphere_cosine();
    buffon_estimate by[3];
    by[0] = tell_radiance(s, &light);
    tell_sphere(s);
    by[2] = tell_cap(s, &light);
    tell_strata(s);
    story_share(s, 0.7, 0.8);
    by[1] = reflect(s, &light, &cosine);
    tell_hemisphere(s, &light, by);
}
