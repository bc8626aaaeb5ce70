/* What a point of each density costs, the generator included, per uniform used and in times of the
 * sphere's, at the best level of the machine. How it is measured is said in bench.h. */
#define _POSIX_C_SOURCE 200809L

#include "../family.h"
#include "bench.h"

enum { FAMILY_TILE = 1024, FAMILY_WIDE = 16, FAMILY_GROUP = 8 };

static _Alignas(64) double tile_u[FAMILY_WIDE * FAMILY_TILE], tile_x[FAMILY_WIDE * FAMILY_TILE];
static const buffon_density *timed[FAMILY_GROUP];
static uint64_t next_index;

static double draw(const buffon_density *g, size_t items)
{
    const buffon_rng_key key = {.seed = 1};
    for (size_t i = 0; i < items; i += FAMILY_TILE, next_index += FAMILY_TILE) {
        for (size_t j = 0; j < g->uniforms; j++)
            buffon_rng_uniforms_at(tile_u + j * FAMILY_TILE, FAMILY_TILE, &key, (uint32_t)j,
                                   next_index);
        bench_must(buffon_density_sample(tile_x, NULL, tile_u, FAMILY_TILE, g));
    }
    return tile_x[1];
}

/* bench_work takes no argument, so each contestant of a group has a function of its own. */
#define DRAW(k)                                                                                    \
    static double draw_##k(size_t items)                                                           \
    {                                                                                              \
        return draw(timed[k], items);                                                              \
    }
DRAW(0)
DRAW(1)
DRAW(2)
DRAW(3)
DRAW(4)
DRAW(5)
DRAW(6)
DRAW(7)

static bench_work *const draws[FAMILY_GROUP] = {draw_0, draw_1, draw_2, draw_3,
                                                draw_4, draw_5, draw_6, draw_7};

/* Skies of the sizes that people have. What they take lives as long as the program. */
static void skies_make(void)
{
    static const struct {
        const char *name;
        size_t columns, rows;
    } skies[] = {{"sky of 512 x 256", 512, 256}, {"sky of 2048 x 1024", 2048, 1024}};
    for (size_t k = 0; k < COUNT(skies); k++) {
        const size_t pixels = skies[k].columns * skies[k].rows;
        const size_t size = buffon_environment_size(skies[k].columns, skies[k].rows);
        const buffon_rng_key key = {.seed = 2};
        double *image = malloc(pixels * sizeof *image);
        void *memory = malloc(size);
        if (image == NULL || memory == NULL)
            bench_must(BUFFON_E_NOMEM);
        buffon_rng_uniforms_at(image, pixels, &key, 0, 0);
        const double began = bench_clock();
        const buffon_density g =
            buffon_environment(memory, size, image, skies[k].columns, skies[k].rows);
        printf("%s: made in %.3f s, %.1f MiB\n", skies[k].name, bench_clock() - began,
               (double)size / (1 << 20));
        bench_must(g.status);
        family_plain(skies[k].name, g);
        free(image);
    }
}

int main(void)
{
    const buffon_density sphere = buffon_sphere();
    const buffon_level best = buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    family_make();
    skies_make();
    printf("\n%-40s %9s %9s %9s   (%s)\n", "ns, the generator included", "point", "uniform",
           "of sphere", buffon_level_string(best));
    for (size_t next = 0; next < family_count;) {
        const family_case *in[FAMILY_GROUP] = {NULL};
        bench_case cases[FAMILY_GROUP];
        size_t n = 1;
        timed[0] = &sphere; /* takes its turn in every group */
        cases[0] = (bench_case){draws[0], best};
        for (; next < family_count && n < FAMILY_GROUP; next++) {
            const family_case *one = &family[next];
            if (!one->timed || one->g.dim > FAMILY_WIDE || one->g.uniforms > FAMILY_WIDE)
                continue;
            in[n] = one;
            timed[n] = &one->g;
            cases[n] = (bench_case){draws[n], best};
            n++;
        }
        bench_time(cases, n);
        for (size_t k = 1; k < n; k++) {
            const double point = bench_median(bench_times[k]),
                         uniforms = (double)timed[k]->uniforms;
            bench_target target = {.where = buffon_level_string(best),
                                   .unit = "x",
                                   .wanted = 2,
                                   .reached = bench_ratio(k, 0) * 2 / uniforms,
                                   .most = 1};
            printf("%-40s %9.2f %9.2f %9.2f\n", in[k]->name, point, point / uniforms,
                   target.reached);
            snprintf(target.what, sizeof target.what, "%s, a uniform of it to one of the sphere",
                     in[k]->name);
            if (in[k]->shape)
                bench_want(&target);
        }
    }
    bench_print_targets();
    return 0;
}
