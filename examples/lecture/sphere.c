/* The sphere and the hemisphere: uniform directions, and those that a matt surface prefers. */
#include "story.h"

#include <math.h>

/* ---- the uniform sphere ---- */

static double height_squared(const double *w, void *ctx)
{
    (void)ctx;
    return w[2] * w[2];
}

/* Sphere and cylinder; points of the one straight across from points of the other. */
static void draw_archimedes(text *out)
{
    enum { SHOWN = 110 };
    globe g = globe_eye(out, 300, 104, 16, -60);
    buffon_rng rng = buffon_rng_make(1777, 3);
    double pole[3] = {0, 0, 1};
    text_put(out, "<div><p>On the cylinder first</p>");
    text_put(out, "<svg viewBox=\"0 0 300 300\" role=\"img\" aria-label=\"Sphere in a cylinder\">");
    for (int k = -5; k < 6; k++)
        if (k % 2 != 0)
            globe_circle(&g, "wire", pole, k / 6.0);
    text_add(out, "<circle class=\"line rim\" cx=\"%g\" cy=\"%g\" r=\"%g\"/>", g.x, g.y, g.radius);
    globe_ring(&g, "c1 thin", 1, 1);
    globe_ring(&g, "c1 thin", 1, -1);
    for (int side = -1; side < 2; side += 2) {
        double top[3], low[3];
        for (int k = 0; k < 3; k++)
            top[k] = low[k] = side * g.right[k];
        top[2] = 1;
        low[2] = -1;
        globe_segment(&g, "c1 thin", low, top);
    }
    for (int i = 0; i < SHOWN; i++) {
        double z = 1 - 2 * buffon_rng_next(&rng), turn = 2 * PI * buffon_rng_next(&rng);
        double on[3] = {cos(turn), sin(turn), z}, ball[3];
        if (on[0] * g.towards[0] + on[1] * g.towards[1] < 0.15)
            continue; /* the far side would only confuse */
        ball[0] = on[0] * sqrt(1 - z * z);
        ball[1] = on[1] * sqrt(1 - z * z);
        ball[2] = z;
        globe_segment(&g, "pale hair", on, ball);
        globe_dots(&g, "c1", 4.4, on, 1);
        globe_dots(&g, "c2", 4.4, ball, 1);
    }
    globe_end(&g);
    text_put(out, "</div>");
}

static void draw_spheres(text *out)
{
    enum { SHOWN = 1200 };
    static double x[3 * SHOWN];
    for (int wrong = 0; wrong < 2; wrong++) {
        buffon_rng rng = buffon_rng_make(1777, 4);
        for (double *v = x; v < x + 3 * SHOWN; v += 3) {
            double u1 = buffon_rng_next(&rng), u2 = buffon_rng_next(&rng);
            buffon_sphere_sample(v, u1, u2);
            if (wrong) { /* both angles uniform: too many at the poles */
                v[0] = sin(PI * u1) * cos(2 * PI * u2);
                v[1] = sin(PI * u1) * sin(2 * PI * u2);
                v[2] = cos(PI * u1);
            }
        }
        text_add(out, "<div><p>%s</p>", wrong ? "Wrong: uniform angles" : "Uniform on the sphere");
        globe g = globe_begin(out, 300, 42, -60, 0, "Points on a sphere");
        globe_dots(&g, wrong ? "c2" : "c1", 3.4, x, SHOWN);
        globe_end(&g);
        text_put(out, "</div>");
    }
}

void tell_sphere(story *s)
{
    buffon_density sphere = buffon_sphere();
    buffon_integrand f = {.scalar = height_squared, .dim = 3};
    buffon_run run = story_run(s, 1 << 20);
    buffon_estimate e;
    story_share(s, 0.15, 0.3);
    story_check(buffon_importance(&e, &f, &sphere, &run), "sphere");
    story_section(s, "Uniform points on the sphere", "Archimedes: planes that cut equal heights "
                  "cut equal areas from the sphere and from the cylinder around it.");
    story_prose(s, "So to draw a point uniformly on the sphere, draw it on the cylinder, where "
                "that is trivial, and move it straight in to the axis until it meets the sphere. "
                "The height <i>z</i> is uniform. To draw two uniform <em>angles</em> instead is a "
                "classic mistake: circles of latitude near the poles are short, and would get as "
                "many points as the equator.");
    story_formula(s, "<i>z</i> = 1 &minus; 2<i>u</i><sub>1</sub>, &#8195; <i>&theta;</i> = "
                  "2&pi;<i>u</i><sub>2</sub>, &#8195; <i>x</i> = cos <i>&theta;</i> &radic;(1 "
                  "&minus; <i>z</i>&sup2;), &#8195; <i>y</i> = sin <i>&theta;</i> &radic;(1 "
                  "&minus; <i>z</i>&sup2;)");
    story_code(s, "buffon_density sphere = buffon_sphere();\n"
               "buffon_rng_fill(u, 2 * n, &rng);\n"
               "status = buffon_density_sample(x, NULL, u, n, &sphere); /* x[0*n+i], ... */\n"
               "status = buffon_importance(&e, &z_squared, &sphere, NULL);");
    text *out = story_figure(s, "three");
    draw_archimedes(out);
    draw_spheres(out);
    story_caption(s, "Left: points of the cylinder (blue) and where they go on the sphere "
                  "(orange). Middle: 1200 points made so. Right: the same random numbers used as "
                  "two angles crowd at the pole. Points on the far side are pale.");
    story_add(s, "z^2 over the sphere: 4 pi/3", "uniform sphere", &e, 4 * PI / 3);
    story_results(s);
}

/* ---- the hemisphere ---- */

static void draw_projection(text *out)
{
    enum { SHOWN = 70 };
    buffon_rng rng = buffon_rng_make(1777, 5);
    text_put(out, "<div><p>From the disk, straight up</p>");
    globe g = globe_begin(out, 300, 24, -62, 1, "Points of a disk and of the hemisphere above");
    for (int i = 0; i < SHOWN; i++) {
        double w[3], base[3];
        double u1 = buffon_rng_next(&rng), u2 = buffon_rng_next(&rng);
        buffon_hemisphere_sample_cosine(w, u1, u2);
        base[0] = w[0];
        base[1] = w[1];
        base[2] = 0;
        globe_segment(&g, "pale hair", base, w);
        globe_dots(&g, "c1", 3.6, base, 1);
        globe_dots(&g, "c2", 4.4, w, 1);
    }
    globe_end(&g);
    text_put(out, "</div>");
}

void draw_hemispheres(text *out)
{
    enum { SHOWN = 900 };
    static double x[3 * SHOWN];
    draw_projection(out);
    for (int cosine = 0; cosine < 2; cosine++) {
        buffon_rng rng = buffon_rng_make(1777, 6);
        for (double *w = x; w < x + 3 * SHOWN; w += 3) {
            double u1 = buffon_rng_next(&rng), u2 = buffon_rng_next(&rng);
            if (cosine)
                buffon_hemisphere_sample_cosine(w, u1, u2);
            else
                buffon_hemisphere_sample(w, u1, u2);
        }
        text_add(out, "<div><p>%s, from above</p>", cosine ? "Cosine-weighted" : "Uniform");
        globe g = globe_begin(out, 300, 90, -90, 1, "A hemisphere from above");
        globe_dots(&g, cosine ? "c2" : "c1", 3.2, x, SHOWN);
        globe_end(&g);
        text_put(out, "</div>");
    }
}
