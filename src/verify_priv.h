/* Private. A density held against itself: what the files of verify_density.h share. All works on
 * batches of points of one cloud: uniforms, points, pdf.
 */
#ifndef BUFFON_SRC_VERIFY_PRIV_H
#define BUFFON_SRC_VERIFY_PRIV_H

#include <buffon/rng.h>
#include <buffon/verify_density.h>

enum {
    VERIFY_BATCH = 1024, /* points at a time; at the edges; of differences */
    VERIFY_AXES = 8,     /* uniforms that are looked at one by one; axes of cells */
    VERIFY_DIM = 16,     /* most coordinates and uniforms where differences are taken */
    VERIFY_CELLS = 4096  /* at most */
};

#define VERIFY_NOISE 0x1p-51 /* of a computed number, relative */
#define VERIFY_ROUND 0x1p-48 /* what the rounding of a number may be worth, relative */

/** n points of a density. */
typedef struct verify_cloud {
    size_t n;
    double *u, *x, *pdf;
} verify_cloud;

typedef struct verify {
    const buffon_density *g, *over;
    buffon_verification how;
    buffon_verify_report *report;
    buffon_rng rng;
    int has_pdf, has_inverse, one_to_one;
    verify_cloud points, other; /* room for VERIFY_BATCH each */
    double *v;                  /* [uniforms * VERIFY_BATCH] uniforms found by the way back */
    double *again;              /* [VERIFY_BATCH] the pdf */
    double *even;               /* [axes * samples] */
    double *count, *expected, *variance; /* [VERIFY_CELLS] each */
    double *memory;
    double middle[VERIFY_DIM], spread[VERIFY_DIM]; /* of the first points */
    buffon_density own[VERIFY_DIM + 1];            /* an `over` that was made here */
} verify;

/** An error in units of what is allowed, at point i of a cloud (NULL: no place). */
void buffon_priv_verify_see(verify *t, buffon_verify_check check, double error,
                            const verify_cloud *cloud, size_t i);

/** The p-value of a statistic: the least of its check is kept. */
void buffon_priv_verify_judge(verify *t, buffon_verify_check check, double p);

/** Points of the uniforms of a cloud, and their pdf if there is one. */
buffon_status buffon_priv_verify_sample(verify *t, verify_cloud *cloud);

/** Random uniforms; with edges, three of four coordinates of a point lie at 0, 1/2 or 1, as near as
 *  the generator comes. */
void buffon_priv_verify_uniforms(verify *t, verify_cloud *cloud, int edges);

/** The size of rounding errors that a coordinate may have, where it is x. */
double buffon_priv_verify_size(const verify *t, size_t j, double x);

/** STRETCH and INVERSE (verify_map.c). */
buffon_status buffon_priv_verify_stretch(verify *t);

/** What covers g, of the user or made from the first points; NULL where there is none. */
void buffon_priv_verify_cover(verify *t, const verify_cloud *cloud);

/** SUPPORT, TOTAL and CELLS, over what covers g (verify_cover.c). */
buffon_status buffon_priv_verify_covered(verify *t);

#endif
