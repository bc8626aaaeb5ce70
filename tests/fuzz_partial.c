/* Bytes from anywhere as a saved partial result: refused, or a partial that all calls can work with
 * and that saves as the same bytes. */
#include <math.h>

#include <buffon/buffon.h>

#include "fuzz.h"

#ifndef BUFFON_LIBFUZZER
#include "tap.h"
#endif

/* The checksum at the end, as the format has it: otherwise it would refuse nearly everything, and
 * the checks behind it would never be reached. */
static void fuzz_seal(uint8_t *bytes, size_t size)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i + 8 < size; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    for (unsigned i = 0; i < 8 && size >= 8; i++)
        bytes[size - 8 + i] = (uint8_t)(hash >> (8 * i));
}

static uint64_t fuzz_accepted, fuzz_refused;

static void fuzz_use(const buffon_partial *p, const uint8_t *bytes, size_t size)
{
    const size_t need = buffon_partial_size(p), components = buffon_partial_components(p);
    buffon_partial copy = {0};
    FUZZ_REQUIRE(need <= size);
    uint8_t *again = malloc(need);
    buffon_estimate *e = calloc(components + 1, sizeof *e);
    FUZZ_REQUIRE(again != NULL && e != NULL);
    FUZZ_REQUIRE(buffon_partial_save(again, need, p) == BUFFON_OK);
    FUZZ_REQUIRE(memcmp(again, bytes, need) == 0);
    const buffon_status status = buffon_partial_estimate(e, p, 0);
    if (status < 0)
        FUZZ_REQUIRE(isnan(e->value) && e->samples == 0);
    if (components > 0 && components < 64) {
        double *cov = malloc(components * components * sizeof *cov);
        FUZZ_REQUIRE(cov != NULL);
        const buffon_status got = buffon_partial_covariance(cov, p);
        FUZZ_REQUIRE(got == BUFFON_OK || isnan(cov[0]));
        free(cov);
    }
    FUZZ_REQUIRE(buffon_partial_merge(&copy, p) == BUFFON_OK);
    FUZZ_REQUIRE(buffon_partial_size(&copy) == need);
    buffon_partial_free(&copy);
    free(again);
    free(e);
}

static void fuzz_load(const uint8_t *bytes, size_t size)
{
    buffon_partial p = {0};
    const buffon_status status = buffon_partial_load(&p, bytes, size);
    FUZZ_REQUIRE(status <= 0);
    if (status == BUFFON_OK) {
        fuzz_accepted++;
        fuzz_use(&p, bytes, size);
    } else {
        fuzz_refused++;
        FUZZ_REQUIRE(buffon_partial_components(&p) == 0);
    }
    buffon_partial_free(&p);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    fuzz_load(bytes, size);
    uint8_t *sealed = malloc(size + 1);
    FUZZ_REQUIRE(sealed != NULL);
    memcpy(sealed, bytes, size);
    fuzz_seal(sealed, size);
    fuzz_load(sealed, size);
    free(sealed);
    return 0;
}

#ifndef BUFFON_LIBFUZZER

static int fuzz_integrand(double *f, const double *x, size_t n, void *ctx)
{
    (void)ctx;
    for (size_t i = 0; i < n; i++) {
        f[i] = x[i] * x[i];
        f[n + i] = x[i];
    }
    return 0;
}

/* Good bytes to start from: a finished run, a part, one with covariance and pairs, an empty one, a
 * net. */
static void fuzz_seed(int which, const char *directory, buffon_rng *rng)
{
    const double lo = 0, hi = 1;
    const buffon_integrand f = {.batch = fuzz_integrand, .dim = 1, .components = 2};
    const buffon_points pairs = buffon_points_antithetic();
    const buffon_points net = buffon_points_sobol_net(BUFFON_SCRAMBLE_OWEN);
    buffon_partial p = {0};
    buffon_run run = {.samples = 1000, .block = 64, .partial = &p};
    buffon_estimate e[2];
    buffon_status status = BUFFON_OK;
    if (which == 1) {
        run.part = 1;
        run.parts = 3;
    } else if (which == 2) {
        run.covariance = 1;
        run.points = &pairs;
    } else if (which == 4) {
        run.samples = 64;
        run.points = &net;
    }
    if (which != 3)
        status = buffon_uniform(e, &f, &lo, &hi, &run);
    const size_t size = buffon_partial_size(&p);
    uint8_t *bytes = malloc(size);
    FUZZ_REQUIRE(bytes != NULL && status >= 0);
    FUZZ_REQUIRE(buffon_partial_save(bytes, size, &p) == BUFFON_OK);
    if (directory != NULL)
        fuzz_write(directory, which, bytes, size);
    const uint64_t accepted = fuzz_accepted;
    LLVMFuzzerTestOneInput(bytes, size);
    tap_ok(fuzz_accepted == accepted + 2, "partial %d: what was saved is accepted, its checksum "
           "as this file computes it too", which);
    fuzz_mutants(which < 4 ? 3000 : 500, bytes, size, rng);
    tap_ok(1, "partial %d: changed bytes do no harm", which);
    free(bytes);
    buffon_partial_free(&p);
}

/* With a directory: leaves seeds there too. */
int main(int argc, char **argv)
{
    buffon_rng rng = buffon_rng_make(1, 0);
    fuzz_random(3000, 8192, &rng);
    tap_ok(fuzz_accepted == 0, "random bytes are refused");
    for (int which = 0; which < 5; which++)
        fuzz_seed(which, argc > 1 ? argv[1] : NULL, &rng);
    tap_ok(fuzz_accepted > 1000 && fuzz_refused > 1000,
           "the checks behind the checksum were reached: %llu accepted, %llu refused",
           (unsigned long long)fuzz_accepted, (unsigned long long)fuzz_refused);
    return tap_done();
}

#endif
