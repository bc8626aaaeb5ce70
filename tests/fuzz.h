/* A fuzz target feeds bytes to the library and returns unless something is wrong. Under libFuzzer
 * (`make fuzz`) the bytes come from there; in `make test` from the loops below: random ones, and
 * good ones with a few changes, the same on every run. A wrong answer ends the program.
 */
#ifndef TESTS_FUZZ_H
#define TESTS_FUZZ_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

#define FUZZ_REQUIRE(condition)                                                                   \
    do {                                                                                          \
        if (!(condition)) {                                                                       \
            fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition);        \
            abort();                                                                              \
        }                                                                                         \
    } while (0)

#ifndef BUFFON_LIBFUZZER

#include <buffon/rng.h>

/* Overwrites, flips, shortens: one to eight times. Sizes of words and small numbers are favoured,
 * for they are what formats are made of. */
static size_t fuzz_mutate(uint8_t *bytes, size_t size, buffon_rng *rng)
{
    for (uint64_t times = 1 + buffon_rng_below(rng, 8); times > 0 && size > 0; times--) {
        const size_t at = (size_t)buffon_rng_below(rng, size);
        switch (buffon_rng_below(rng, 6)) {
        case 0: bytes[at] ^= (uint8_t)(1u << buffon_rng_below(rng, 8)); break;
        case 1: bytes[at] = (uint8_t)buffon_rng_word(rng); break;
        case 2: bytes[at] = (uint8_t)buffon_rng_below(rng, 4); break;
        case 3: bytes[at & ~(size_t)7] = (uint8_t)buffon_rng_below(rng, 4); break;
        case 4: memset(bytes + (at & ~(size_t)7), 0xff, size - at < 8 ? size - at : 8); break;
        default: size = buffon_rng_below(rng, 8) == 0 ? at : size;
        }
    }
    return size;
}

static void fuzz_random(uint64_t times, size_t most, buffon_rng *rng)
{
    uint8_t *bytes = malloc(most);
    FUZZ_REQUIRE(bytes != NULL);
    while (times-- > 0) {
        const size_t size = (size_t)buffon_rng_below(rng, most);
        for (size_t i = 0; i < size; i++)
            bytes[i] = (uint8_t)buffon_rng_word(rng);
        LLVMFuzzerTestOneInput(bytes, size);
    }
    free(bytes);
}

/* Leaves good bytes for libFuzzer to begin with. */
static void fuzz_write(const char *directory, int number, const uint8_t *bytes, size_t size)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/seed%d", directory, number);
    FILE *file = fopen(path, "wb");
    FUZZ_REQUIRE(file != NULL && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
}

static void fuzz_mutants(uint64_t times, const uint8_t *good, size_t size, buffon_rng *rng)
{
    while (times-- > 0) {
        /* Of exactly the size, so that sanitizers see a read past the end. */
        uint8_t *bytes = malloc(size);
        FUZZ_REQUIRE(bytes != NULL);
        memcpy(bytes, good, size);
        const size_t rest = fuzz_mutate(bytes, size, rng);
        uint8_t *exact = rest > 0 ? realloc(bytes, rest) : bytes;
        FUZZ_REQUIRE(exact != NULL);
        LLVMFuzzerTestOneInput(exact, rest);
        free(exact);
    }
}

#endif

#endif
