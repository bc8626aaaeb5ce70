/* The renderer. For each ray of the eye it finds the point that is seen, and estimates the light
 * that arrives there: the integral of L cos(theta) over the directions above the surface. The
 * colour of the surface times that over pi is what the eye receives. */
#include "render.h"

#include <math.h>
#include <stdlib.h>

#include "png.h"

#define RENDER_PI 3.14159265358979323846

typedef struct ball {
    double centre[3], radius, colour[3];
} ball;

/* The floor is the plane z = 0. Balls stand on it; the first is the lamp. */
static const ball balls[] = {
    {{-2.20, -1.1, 3.30}, 0.75, {1.00, 0.95, 0.85}},
    {{-1.35, 0.45, 1.00}, 1.00, {0.80, 0.27, 0.12}},
    {{1.30, 0.85, 1.25}, 1.25, {0.16, 0.38, 0.66}},
    {{0.28, -1.25, 0.55}, 0.55, {0.86, 0.66, 0.22}},
};
enum { BALLS = sizeof balls / sizeof *balls, LAMP = 0, FLOOR = BALLS, NOTHING };

static const double lamp_radiance = 19;
static const double eye[3] = {0.1, -9.2, 2.75}, look_at[3] = {0, 0, 1.66};
static const double eye_width = 0.84; /* of the picture at distance 1 */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(double v[3])
{
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

/* How far a ray goes until it meets a ball; infinity if it does not. `way` has length 1. */
static double meet(const double from[3], const double way[3], const ball *b)
{
    double to[3] = {b->centre[0] - from[0], b->centre[1] - from[1], b->centre[2] - from[2]};
    double along = dot(to, way);
    double inside = along * along - dot(to, to) + b->radius * b->radius;
    if (along <= 0 || inside <= 0)
        return INFINITY;
    return along - sqrt(inside);
}

/* What a ray meets first: a ball, FLOOR or NOTHING. */
static int meet_first(const double from[3], const double way[3], double *distance)
{
    int found = NOTHING;
    *distance = INFINITY;
    if (way[2] < 0) {
        *distance = -from[2] / way[2];
        found = FLOOR;
    }
    for (int i = 0; i < BALLS; i++) {
        double t = meet(from, way, &balls[i]);
        if (t < *distance) {
            *distance = t;
            found = i;
        }
    }
    return found;
}

/* A point to be lit. */
typedef struct spot {
    double at[3], normal[3];
    int surface; /* the ball it is on, or FLOOR */
} spot;

/* The integrand: light from direction w times the cosine. Something in between is a shadow. The
 * surface itself is never in between where the cosine is positive, and the floor is below all. */
static double arriving(const double *w, void *ctx)
{
    const spot *s = ctx;
    double cosine = dot(w, s->normal);
    if (cosine <= 0)
        return 0;
    double lamp = meet(s->at, w, &balls[LAMP]);
    if (lamp == INFINITY)
        return 0;
    for (int i = LAMP + 1; i < BALLS; i++)
        if (i != s->surface && meet(s->at, w, &balls[i]) < lamp)
            return 0;
    return lamp_radiance * cosine;
}

static buffon_density directions(const spot *s, sampling how)
{
    switch (how) {
    case SAMPLING_HEMISPHERE: return buffon_hemisphere_about(s->normal);
    case SAMPLING_COSINE: return buffon_hemisphere_cosine_about(s->normal);
    default: return buffon_cap_of_sphere(s->at, balls[LAMP].centre, balls[LAMP].radius);
    }
}

/* The floor is made of large tiles in two greys. */
static void floor_colour(double colour[3], const double at[3])
{
    int odd = (int)(floor(at[0] / 1.2) + floor(at[1] / 1.2)) & 1;
    for (int k = 0; k < 3; k++)
        colour[k] = odd ? 0.42 : 0.60;
}

/* What the eye sees along one ray. Returns non-zero if it is the lamp. */
static int see(double colour[3], const double way[3], sampling how, const buffon_run *run)
{
    double distance;
    int what = meet_first(eye, way, &distance);
    for (int k = 0; k < 3; k++)
        colour[k] = what == LAMP ? lamp_radiance * balls[LAMP].colour[k] : 0;
    if (what == LAMP || what == NOTHING)
        return what == LAMP;

    spot s = {.surface = what, .normal = {0, 0, 1}};
    for (int k = 0; k < 3; k++) {
        s.at[k] = eye[k] + distance * way[k];
        colour[k] = what == FLOOR ? 0 : balls[what].colour[k];
        if (what != FLOOR)
            s.normal[k] = (s.at[k] - balls[what].centre[k]) / balls[what].radius;
    }
    if (what == FLOOR)
        floor_colour(colour, s.at);

    buffon_density g = directions(&s, how);
    buffon_integrand f = {.scalar = arriving, .dim = 3, .ctx = &s};
    buffon_estimate e;
    buffon_status status = buffon_importance(&e, &f, &g, run);
    if (status < 0)
        give_up("render", buffon_status_string(status));
    for (int k = 0; k < 3; k++)
        colour[k] *= balls[LAMP].colour[k] * e.value / RENDER_PI;
    return 0;
}

void render(image *out, sampling how, buffon_run run, void (*tell)(double done, void *ctx),
            void *ctx)
{
    /* Four rays a pixel, no two of them in a row or a column. */
    static const double offset[RENDER_RAYS][2] = {
        {0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};
    double ahead[3], right[3], up[3];
    for (int k = 0; k < 3; k++)
        ahead[k] = look_at[k] - eye[k];
    unit(ahead);
    right[0] = ahead[1];
    right[1] = -ahead[0];
    right[2] = 0;
    unit(right);
    up[0] = right[1] * ahead[2] - right[2] * ahead[1];
    up[1] = right[2] * ahead[0] - right[0] * ahead[2];
    up[2] = right[0] * ahead[1] - right[1] * ahead[0];

    run.stream = 0;
    for (size_t y = 0; y < out->height; y++) {
        for (size_t x = 0; x < out->width; x++) {
            size_t pixel = y * out->width + x;
            double pixel_size = eye_width / (double)out->width;
            for (int k = 0; k < 3; k++)
                out->rgb[3 * pixel + (size_t)k] = 0;
            out->lamp[pixel] = 0;
            for (int ray = 0; ray < RENDER_RAYS; ray++, run.stream++) {
                double colour[3], way[3];
                double a = ((double)x + offset[ray][0] - (double)out->width / 2) * pixel_size;
                double b = ((double)out->height / 2 - (double)y - offset[ray][1]) * pixel_size;
                for (int k = 0; k < 3; k++)
                    way[k] = ahead[k] + a * right[k] + b * up[k];
                unit(way);
                out->lamp[pixel] |= (unsigned char)see(colour, way, how, &run);
                for (int k = 0; k < 3; k++)
                    out->rgb[3 * pixel + (size_t)k] += colour[k] / RENDER_RAYS;
            }
        }
        tell((double)(y + 1) / (double)out->height, ctx);
    }
}

/* ---- images ---- */

image image_make(size_t width, size_t height)
{
    return (image){width, height, need_memory(3 * width * height * sizeof(double)),
                   need_memory(width * height)};
}

void image_free(image *i)
{
    free(i->rgb);
    free(i->lamp);
    *i = (image){0};
}

double image_difference(const image *i, const image *reference)
{
    double squares = 0, sum = 0, count = 0;
    for (size_t pixel = 0; pixel < i->width * i->height; pixel++) {
        if (reference->lamp[pixel])
            continue;
        for (size_t k = 3 * pixel; k < 3 * pixel + 3; k++) {
            squares += (i->rgb[k] - reference->rgb[k]) * (i->rgb[k] - reference->rgb[k]);
            sum += reference->rgb[k];
            count++;
        }
    }
    return sqrt(squares / count) / (sum / count);
}

/* Film: what is bright saturates gently. Then the screen's own curve (sRGB). */
static unsigned char image_byte(double light)
{
    double v = 1 - exp(-1.8 * light);
    v = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
    return (unsigned char)lround(255 * v);
}

void image_png(text *out, const image *i)
{
    size_t n = 3 * i->width * i->height;
    unsigned char *bytes = need_memory(n);
    for (size_t k = 0; k < n; k++)
        bytes[k] = image_byte(i->rgb[k]);
    png_write(out, bytes, i->width, i->height);
    free(bytes);
}
