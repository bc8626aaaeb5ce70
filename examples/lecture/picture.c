/* The picture: one scene, three ways to look for the light, equal samples. */
#include "story.h"

#include <stdio.h>

#include "render.h"

enum { WIDTH = 360, HEIGHT = 240, SAMPLES = 4, REFERENCE_CELLS = 8 };

static void tell_row(double done, void *ctx)
{
    story_progress(ctx, done);
}

static void draw_picture(text *out, const image *i, const char *title)
{
    text png = {0};
    image_png(&png, i);
    text_add(out, "<div><p>%s</p><img width=\"%zu\" height=\"%zu\" alt=\"Three balls on a tiled "
             "floor under a lamp\" src=\"data:image/png;base64,", title, i->width, i->height);
    text_base64(out, png.bytes, png.length);
    text_put(out, "\"></div>\n");
    text_free(&png);
}

/* Renders the scene four times, the last as reference; their errors go into `error`. */
static void draw_pictures(story *s, text *out, double error[3])
{
    static const char *name[] = {"Uniform hemisphere", "Cosine hemisphere", "Cap of the lamp",
                                 "Reference"};
    static const sampling how[] = {SAMPLING_HEMISPHERE, SAMPLING_COSINE, SAMPLING_LAMP,
                                   SAMPLING_LAMP};
    buffon_points jitter = buffon_points_jitter(REFERENCE_CELLS);
    image picture[4];
    for (int i = 0; i < 4; i++) {
        buffon_run run = {.samples = SAMPLES, .seed = 1777};
        if (i == 3) {
            run.samples = 2 * REFERENCE_CELLS * REFERENCE_CELLS;
            run.points = &jitter;
            run.seed = 1733;
        }
        story_share(s, 0.15 * i, i < 3 ? 0.15 * (i + 1) : 1);
        picture[i] = image_make(WIDTH, HEIGHT);
        render(&picture[i], how[i], run, tell_row, s);
    }
    for (int i = 0; i < 4; i++) {
        char title[128];
        if (i < 3) {
            error[i] = 100 * image_difference(&picture[i], &picture[3]);
            snprintf(title, sizeof title, "%s: error %.3g&#8201;%%", name[i], error[i]);
        } else {
            snprintf(title, sizeof title, "%s: %d samples a pixel", name[i],
                     RENDER_RAYS * 2 * REFERENCE_CELLS * REFERENCE_CELLS);
        }
        draw_picture(out, &picture[i], title);
    }
    for (int i = 0; i < 4; i++)
        image_free(&picture[i]);
}

void tell_picture(story *s)
{
    double error[3];
    story_section(s, "A picture", "One integral in every pixel.");
    story_prose(s, "Here is what all this was invented for. Three matt balls stand on a floor "
                "under a spherical lamp; for every point that the eye sees, the light that arrives "
                "is the integral of section 9, now with shadows: the integrand is zero where "
                "another ball is in between, and nobody could say in advance where that is. All "
                "pictures but the last spend the same number of samples in each pixel. Only the "
                "density differs.");
    story_formula(s, "<i>L&prime;</i>(pixel) = " FRAC("<i>&rho;</i>", "&pi;") OVER("&gamma;")
                  "<i>L</i><sub>0</sub> <i>V</i>(<i>&omega;</i>) cos <i>&theta;</i> "
                  "d<i>&omega;</i>, &#8195; <i>V</i> = 0 in shadow, else 1");
    story_code(s, "switch (how) {\n"
               "case HEMISPHERE: g = buffon_hemisphere_about(normal); break;\n"
               "case COSINE:     g = buffon_hemisphere_cosine_about(normal); break;\n"
               "case LAMP:       g = buffon_cap_of_sphere(point, lamp, lamp_radius); break;\n"
               "}\n"
               "status = buffon_importance(&e, &arriving, &g, &(buffon_run){.samples = 4,\n"
               "                                                          .stream = ray});\n"
               "pixel += colour / PI * e.value;");
    draw_pictures(s, story_figure(s, "two pictures"), error);
    story_caption(s, "%d samples a pixel: %d rays of the eye with %d directions each. The error is "
                  "the root mean square difference from the reference, relative to its mean. To be "
                  "as good as the cap, uniform directions would need %.0f times as many samples.",
                  RENDER_RAYS * SAMPLES, RENDER_RAYS, (int)SAMPLES,
                  error[0] * error[0] / (error[2] * error[2]));
}
