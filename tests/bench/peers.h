/* The libraries that buffon is compared with, where they are installed: BENCH_GSL, BENCH_DSFMT and
 * BENCH_RANDOM123 are the build's. */
#ifndef TESTS_BENCH_PEERS_H
#define TESTS_BENCH_PEERS_H

#ifdef BENCH_GSL
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_monte_plain.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_version.h>

static gsl_rng *gsl_mt, *gsl_taus;
#endif

#ifdef BENCH_DSFMT
#define DSFMT_MEXP 19937
#include <dSFMT.h>

/* The library may have been built for 16 bytes at a time, whatever its header says here. */
static _Alignas(16) dsfmt_t dsfmt;
#endif

#ifdef BENCH_RANDOM123
#include <Random123/philox.h>
#endif

static void peers_start(void)
{
#ifdef BENCH_GSL
    gsl_mt = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_taus = gsl_rng_alloc(gsl_rng_taus2);
#endif
#ifdef BENCH_DSFMT
    dsfmt_init_gen_rand(&dsfmt, 1);
#endif
}

static void peers_stop(void)
{
#ifdef BENCH_GSL
    gsl_rng_free(gsl_mt);
    gsl_rng_free(gsl_taus);
#endif
}

static void peers_print(void)
{
#ifdef BENCH_GSL
    printf("GSL %s\n", gsl_version);
#else
    printf("GSL is not installed (pkg-config gsl): no lines for it\n");
#endif
#ifdef BENCH_DSFMT
    printf("dSFMT %d\n", DSFMT_MEXP);
#else
    printf("dSFMT is not installed (dSFMT.h): no lines for it\n");
#endif
#ifdef BENCH_RANDOM123
    printf("Random123\n");
#else
    printf("Random123 is not installed (Random123/philox.h): no lines for it\n");
#endif
}

#endif
