/* What every consumer of the installed library prints: the bits of some results. Included by a C
 * and a C++ program, so that headers and library meet in both languages and under other flags.
 */
#ifndef TESTS_EMBED_CONSUMER_H
#define TESTS_EMBED_CONSUMER_H

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <buffon/buffon.h>

static void consumer_print(const char *what, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    printf("%-12s %016" PRIx64 "\n", what, bits);
}

static double consumer_square(const double *x, void *ctx)
{
    (void)ctx;
    return x[0] * x[0];
}

/* Returns the exit code of the program. */
static int consumer_run(void)
{
    const double lo = 0, hi = 1;
    double u[3], x[3];
    buffon_estimate e;
    buffon_integrand f;
    buffon_density sphere = buffon_sphere();
    buffon_rng rng = buffon_rng_make(42, 0);
    memset(&f, 0, sizeof f);
    f.scalar = consumer_square;
    f.dim = 1;
    if (strcmp(buffon_version(), BUFFON_VERSION_STRING) != 0)
        return 2;
    buffon_rng_fill(u, 3, &rng);
    consumer_print("next", buffon_rng_next(&rng));
    if (buffon_density_sample(x, NULL, u, 1, &sphere) != BUFFON_OK)
        return 3;
    consumer_print("sphere x", x[0]);
    consumer_print("sphere y", x[1]);
    consumer_print("sphere z", x[2]);
    if (buffon_uniform(&e, &f, &lo, &hi, NULL) != BUFFON_OK)
        return 4;
    consumer_print("value", e.value);
    consumer_print("std_error", e.std_error);
    consumer_print("lo", e.lo);
    consumer_print("hi", e.hi);
    if (buffon_uniform(&e, &f, &hi, &lo, NULL) != BUFFON_E_DOMAIN)
        return 5;
    return 0;
}

#endif
