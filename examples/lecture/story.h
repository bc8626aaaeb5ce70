/* The lecture as it is told: numbers go into one table, everything else onto one page.
 *
 *     lecture.c     the order of things, the table, the progress bar
 *     page.c        the page: head, style, sections, code, tables
 *     integrals.c   the needle, basic Monte Carlo, rejection, why not quadrature
 *     densities.c   pdf, primary and average estimators, importance sampling, variance
 *     light.c       reflected radiance, cap, stratification, weighted hemisphere
 *     sphere.c      the uniform sphere, and how hemispheres look
 *     disk.c        inverse CDF and the disk
 *     errors.c      the error against N, and how often the interval is right
 *     quasi.c       Sobol' points
 *     picture.c     the picture; render.c makes it
 *     figure.c globe.c png.c deflate.c text.c   drawing and writing
 */
#ifndef LECTURE_STORY_H
#define LECTURE_STORY_H

#include <buffon/buffon.h>

#include "figure.h"
#include "text.h"

#define PI 3.14159265358979323846
#define STORY_ROWS 64
#define STORY_SECTIONS 24

/* One line of the table. */
typedef struct story_row {
    const char *problem, *estimator;
    buffon_estimate estimate;
    double exact;
    int section;
} story_row;

typedef struct story {
    text page;
    story_row row[STORY_ROWS];
    size_t rows;
    const char *title[STORY_SECTIONS];
    int section, figure;
    int terminal;           /* non-zero: somebody watches */
    int shown;              /* percent on the bar */
    const char *doing;      /* the chapter at work, */
    double begin, end;      /* its share of the whole, */
    double from, to;        /* and that of the run at work in it */
} story;

/* The page (page.c). Strings are HTML, but for the code. */
void story_section(story *s, const char *title, const char *statement);
void story_prose(story *s, const char *html);
void story_formula(story *s, const char *html);
void story_code(story *s, const char *code);
text *story_figure(story *s, const char *class); /* class: one to four panels in a line */
void story_caption(story *s, const char *format, ...) TEXT_PRINTF(2, 3);

#define STORY_COUNT 72
/* A whole number with its thousands set apart. */
const char *story_count(char grouped[STORY_COUNT], uint64_t n);

void story_results(story *s); /* the rows of this section */
void story_finish(story *s, text *document);

/* The numbers (lecture.c). */
void story_add(story *s, const char *problem, const char *estimator, const buffon_estimate *e,
               double exact);
double story_z(const story_row *row);
int story_is_exact(const story_row *row); /* no error but rounding */
int story_decimals(const story_row *row); /* as many as its error allows */

/* The options that all runs here share: two threads, one seed, and the bar. */
buffon_run story_run(story *s, uint64_t samples);

/* The run to come covers this share (0 to 1) of its chapter. */
void story_share(story *s, double from, double to);
/* The run at work is so far. */
void story_progress(story *s, double fraction);

/* Ends the program unless there is an estimate. A reservation is one. */
void story_check(buffon_status status, const char *what);

/* The chapters. */
void tell_integrals(story *s);
void tell_densities(story *s);
void tell_light(story *s); /* calls tell_sphere where its turn comes */
void tell_sphere(story *s);
void tell_disk(story *s);
void tell_errors(story *s);
void tell_quasi(story *s);
void tell_picture(story *s);

/* The curve of the first chapters: two humps over [0, CURVE_END], below CURVE_TOP. */
#define CURVE_END 3.0
#define CURVE_TOP 0.5
double curve(const double *x, void *ctx);
double curve_integral(double end); /* from 0, in closed form */
void draw_curve(panel *p, const char *class, int filled);

/* Three panels: the disk projected up, uniform directions, cosine-weighted ones. */
void draw_hemispheres(text *out);

/* Formulas: a fraction, and an integral or sum with its limits. */
#define FRAC(a, b) "<span class=\"fr\"><span>" a "</span><span>" b "</span></span>"
#define LIMITS(sign, a, b) \
    "<span class=\"sign\">" sign "</span><span class=\"lim\"><span>" b "</span><span>" a \
    "</span></span>"
#define INTEGRAL(a, b) LIMITS("&int;", a, b)
#define SUM(a, b) LIMITS("&sum;", a, b)
#define WHOLE "<span class=\"sign whole\">&int;</span>"
#define OVER(a) "<span class=\"sign\">&int;</span><sub class=\"over\">" a "</sub>"

#endif
