/* A point set of your own: a lattice with random shifts.
 *
 * Coordinate j of point i of replicate r is the fraction of i z_j / N + shift_rj. The points of one
 * replicate are very even, so its mean is near the integral; the replicates are shifted
 * independently of each other, so their means show how near. In 64-bit fractions of 1 the sum wraps
 * by itself.
 *
 * The vector z is good for every power of two up to 2^20: R. Cools, F. Kuo, D. Nuyens (2006),
 * Constructing embedded lattice rules for multivariate integration.
 *
 * Here the product of 1 + (x_j - 1/2) / 2 over the unit cube in six dimensions, exactly 1. */
#include <stdio.h>

#include <buffon/buffon.h>

enum { DIM = 6, LOG2_N = 13, REPLICATES = 8 };
static const uint64_t N = UINT64_C(1) << LOG2_N;
static const uint64_t z[DIM] = {1, 182667, 469891, 498753, 110745, 446247};

static int lattice_fill(double *u, const buffon_points_block *block, const buffon_points *self)
{
    (void)self;
    for (size_t j = 0; j < block->dim; j++) {
        uint64_t shift;
        buffon_rng_words_at(&shift, 1, &block->key, (uint32_t)j, 0);
        for (size_t i = 0; i < block->n; i++) {
            const uint64_t place = ((block->first + i) * z[j] << (64 - LOG2_N)) + shift;
            u[j * block->n + i] = ((double)(place >> 12) + 0.5) * 0x1p-52; /* never 0 or 1 */
        }
    }
    return 0;
}

/* Points are evaluated by whole lattices; 0 says that there is no lattice of this dimension. */
static uint64_t lattice_round(size_t dim, const buffon_points *self)
{
    (void)self;
    return dim <= DIM ? N : 0;
}

static double f(const double *x, void *ctx)
{
    (void)ctx;
    double product = 1;
    for (size_t j = 0; j < DIM; j++)
        product *= 1 + (x[j] - 0.5) / 2;
    return product;
}

static int show(const char *name, const buffon_points *points)
{
    const double lo[DIM] = {0}, hi[DIM] = {1, 1, 1, 1, 1, 1};
    buffon_estimate e;
    const buffon_status s =
        buffon_uniform(&e, &(buffon_integrand){.scalar = f, .dim = DIM}, lo, hi,
                       &(buffon_run){.samples = REPLICATES * N, .seed = 2006, .points = points});
    if (s < 0) {
        fprintf(stderr, "%s: %s\n", name, buffon_status_string(s));
        return 1;
    }
    printf("%-8s %llu points  %.7f +- %.7f, 95 %% in [%.7f, %.7f], exactly 1\n", name,
           (unsigned long long)e.samples, e.value, e.std_error, e.lo, e.hi);
    return 0;
}

int main(void)
{
    const buffon_points lattice = {.fill = lattice_fill,
                                   .round = lattice_round,
                                   .design = BUFFON_DESIGN_REPLICATES,
                                   .replicates = REPLICATES,
                                   .limit = N,
                                   .name = "example.lattice"};
    const int bad = show("random", NULL);
    return bad | show("lattice", &lattice);
}
