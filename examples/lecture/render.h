/* A small renderer: matt spheres on a floor under one spherical lamp, direct light only. */
#ifndef LECTURE_RENDER_H
#define LECTURE_RENDER_H

#include <buffon/buffon.h>

#include "text.h"

/* How a point that the eye sees chooses directions in which to look for light. */
typedef enum sampling {
    SAMPLING_HEMISPHERE, /* uniformly over its sky */
    SAMPLING_COSINE,     /* in proportion to the cosine */
    SAMPLING_LAMP        /* uniformly over the cap that the lamp is */
} sampling;

/* Linear colours rgb[3 * width * height], top row first, and where the lamp itself is seen. */
typedef struct image {
    size_t width, height;
    double *rgb;
    unsigned char *lamp;
} image;

image image_make(size_t width, size_t height);
void image_free(image *i);

/* Rays of the eye in each pixel; each gets the samples of `run`, whose stream it sets. */
#define RENDER_RAYS 4

/* Renders with `run` for every ray. After each row `tell` is given the share that is done. */
void render(image *out, sampling how, buffon_run run, void (*tell)(double done, void *ctx),
            void *ctx);

/* Root mean square difference of two images over the mean of the second, without the lamp. */
double image_difference(const image *i, const image *reference);

/* Appends a PNG file, exposed and in the colours of a screen. */
void image_png(text *out, const image *i);

#endif
