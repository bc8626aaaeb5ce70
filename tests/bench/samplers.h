/* Points of shapes and values of laws, the generator included. Peers store their points too. */
#ifndef TESTS_BENCH_SAMPLERS_H
#define TESTS_BENCH_SAMPLERS_H

#include "uniforms.h"

static const double zeros[8] = {0}, ones[8] = {1, 1, 1, 1, 1, 1, 1, 1};
static _Alignas(64) double points[8 * TILE];

static double ours_density(const buffon_density *g, size_t items)
{
    const buffon_rng_key key = {.seed = 1};
    for (size_t i = 0; i < items; i += TILE, next_index += TILE) {
        for (size_t j = 0; j < g->uniforms; j++)
            buffon_rng_uniforms_at(buffer + j * TILE, TILE, &key, (uint32_t)j, next_index);
        bench_must(buffon_density_sample(points, NULL, buffer, TILE, g));
    }
    return points[1];
}

#define OURS(name, constructor)                                                                    \
    static double ours_##name(size_t items)                                                        \
    {                                                                                              \
        const buffon_density g = constructor;                                                      \
        return ours_density(&g, items);                                                            \
    }
OURS(box, buffon_box(zeros, ones, 2))
OURS(sphere, buffon_sphere())
OURS(cap, buffon_cap(0.5))
OURS(hemisphere, buffon_hemisphere())
OURS(cosine, buffon_hemisphere_cosine())
OURS(disk, buffon_disk(1))
OURS(concentric, buffon_disk_concentric(1))
OURS(normal, buffon_normal(0, 1))
OURS(exponential, buffon_exponential(1))

/* A thousand items of very different weights. */
enum { ITEMS = 1000 };
static double item_weights[ITEMS];
static uint64_t item_tables[2][4 * ITEMS];
static buffon_density item_laws[2]; /* alias, guide */
#ifdef BENCH_GSL
static gsl_ran_discrete_t *gsl_items;
#endif

static void make_items(void)
{
    for (size_t k = 0; k < ITEMS; k++)
        item_weights[k] = 1 / (double)(k + 1);
    item_laws[0] = buffon_alias(item_tables[0], sizeof item_tables[0], item_weights, ITEMS);
    item_laws[1] = buffon_guide(item_tables[1], sizeof item_tables[1], item_weights, ITEMS);
#ifdef BENCH_GSL
    gsl_items = gsl_ran_discrete_preproc(ITEMS, item_weights);
#endif
}

static void free_items(void)
{
#ifdef BENCH_GSL
    gsl_ran_discrete_free(gsl_items);
#endif
}

static double ours_items(const buffon_density *g, size_t items)
{
    static buffon_rng rng;
    static uint32_t index[TILE];
    if (rng.next == 0)
        rng = buffon_rng_make(1, 0);
    for (size_t i = 0; i < items; i += TILE)
        bench_must(buffon_alias_fill(index, TILE, g, &rng));
    return index[1];
}

static double ours_alias(size_t items)
{
    return ours_items(&item_laws[0], items);
}

static double ours_guide(size_t items)
{
    return ours_items(&item_laws[1], items);
}

/* `call` makes the `step` next values at x. */
#define LOOP(name, step, call)                                                                     \
    static double name(size_t items)                                                               \
    {                                                                                              \
        plain_rng rng = plain_make();                                                              \
        for (size_t i = 0; i < items; i += TILE) {                                                 \
            for (size_t k = 0; k < TILE; k += step) {                                              \
                double *x = points + 3 * k;                                                        \
                call;                                                                              \
            }                                                                                      \
            bench_sink = points[i % 3];                                                            \
        }                                                                                          \
        (void)rng;                                                                                 \
        return points[1];                                                                          \
    }
LOOP(plain_square, 1, (x[0] = plain_uniform(&rng), x[1] = plain_uniform(&rng)))
LOOP(plain_spheres, 1, plain_cap(x, -1, &rng))
LOOP(plain_spheres_rejection, 1, plain_sphere_rejection(x, &rng))
LOOP(plain_caps, 1, plain_cap(x, 0.5, &rng))
LOOP(plain_hemispheres, 1, plain_cap(x, 0, &rng))
LOOP(plain_cosines, 1, plain_cosine(x, &rng))
LOOP(plain_disks, 1, plain_disk(x, &rng))
LOOP(plain_disks_rejection, 1, plain_disk_rejection(x, &rng))
LOOP(plain_normal, 2, plain_normals(x, &rng))
LOOP(plain_exponential, 1, x[0] = -log(plain_uniform(&rng)))
#ifdef BENCH_GSL
LOOP(gsl_sphere, 1, gsl_ran_dir_3d(gsl_mt, x, x + 1, x + 2))
LOOP(gsl_circle, 1, gsl_ran_dir_2d(gsl_mt, x, x + 1))
LOOP(gsl_ziggurat, 1, x[0] = gsl_ran_gaussian_ziggurat(gsl_mt, 1))
LOOP(gsl_gaussian, 1, x[0] = gsl_ran_gaussian(gsl_mt, 1))
LOOP(gsl_exponential, 1, x[0] = gsl_ran_exponential(gsl_mt, 1))
LOOP(gsl_discrete, 1, x[0] = (double)gsl_ran_discrete(gsl_mt, gsl_items))
#else
#define gsl_sphere NULL
#define gsl_circle NULL
#define gsl_ziggurat NULL
#define gsl_gaussian NULL
#define gsl_exponential NULL
#define gsl_discrete NULL
#endif

static void bench_shapes(void)
{
    const bench_peer box[] = {{"plain", plain_square, {0}}};
    const bench_peer sphere[] = {{"plain, libm", plain_spheres, {0}},
                                 {"plain, by rejection", plain_spheres_rejection, {0}},
                                 {"GSL gsl_ran_dir_3d", gsl_sphere, {0, 3, 6, 10}}};
    const bench_peer cap[] = {{"plain, libm", plain_caps, {0}},
                              {"GSL gsl_ran_dir_3d", gsl_sphere, {0, 3, 6, 10}}};
    const bench_peer hemisphere[] = {{"plain, libm", plain_hemispheres, {0}},
                                     {"GSL gsl_ran_dir_3d", gsl_sphere, {0}}};
    const bench_peer cosine[] = {{"plain, libm", plain_cosines, {0}},
                                 {"GSL gsl_ran_dir_3d", gsl_sphere, {0, 3, 6, 10}}};
    const bench_peer disk[] = {{"plain, libm", plain_disks, {0}},
                               {"plain, by rejection", plain_disks_rejection, {0}},
                               {"GSL gsl_ran_dir_2d", gsl_circle, {0, 3, 6, 10}}};
    const bench_peer concentric[] = {{"plain, by rejection", plain_disks_rejection, {0}},
                                     {"GSL gsl_ran_dir_2d", gsl_circle, {0}}};
    bench_header("ns per point");
    bench_group("box, d = 2", ours_box, box, COUNT(box));
    bench_group("sphere", ours_sphere, sphere, COUNT(sphere));
    bench_group("cap", ours_cap, cap, COUNT(cap));
    bench_group("hemisphere", ours_hemisphere, hemisphere, COUNT(hemisphere));
    bench_group("cosine hemisphere", ours_cosine, cosine, COUNT(cosine));
    bench_group("disk", ours_disk, disk, COUNT(disk));
    bench_group("disk, concentric", ours_concentric, concentric, COUNT(concentric));
}

static void bench_laws(void)
{
    const bench_peer normal[] = {
        {"plain, Box-Muller", plain_normal, {0}},
        {"GSL gsl_ran_gaussian", gsl_gaussian, {0}},
        {"GSL gsl_ran_gaussian_ziggurat", gsl_ziggurat, {0, 0, 0, 4}},
    };
    const bench_peer exponential[] = {
        {"plain, libm", plain_exponential, {0}},
        {"GSL gsl_ran_exponential", gsl_exponential, {0, 0, 0, 8}},
    };
    const bench_peer alias[] = {{"GSL gsl_ran_discrete", gsl_discrete, {6, 6, 6, 6}}};
    const bench_peer guide[] = {{"GSL gsl_ran_discrete", gsl_discrete, {0}}};
    make_items();
    bench_header("ns per value");
    bench_group("normal", ours_normal, normal, COUNT(normal));
    bench_group("exponential", ours_exponential, exponential, COUNT(exponential));
    bench_group("1000 items, alias", ours_alias, alias, COUNT(alias));
    bench_group("1000 items, guide table", ours_guide, guide, COUNT(guide));
    free_items();
}

#endif
