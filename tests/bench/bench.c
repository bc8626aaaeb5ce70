/* What a number costs, at each level that the machine has, against the same loops written plainly
 * with libm, and against GSL, dSFMT and Random123 where they are installed. How it is measured is
 * said in bench.h. */
#define _POSIX_C_SOURCE 200809L

#include "bench.h"
#include "functions.h"
#include "integrals.h"
#include "memory.h"
#include "peers.h"
#include "samplers.h"
#include "uniforms.h"

/* Where the system tells: its name for the processor. */
static void print_processor(void)
{
    FILE *file = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *colon = strchr(line, ':');
        if (colon != NULL && strncmp(line, "model name", 10) == 0) {
            printf("processor%s", colon);
            break;
        }
    }
    if (file != NULL)
        fclose(file);
}

static void print_levels(void)
{
    printf("levels:");
    for (size_t level = 0; level < bench_levels(); level++)
        printf(" %s", buffon_level_string((buffon_level)level));
    printf("\n");
}

int main(void)
{
    peers_start();
    printf("buffon %s, compiler %s\n", buffon_version(), __VERSION__);
    print_processor();
    print_levels();
    peers_print();
    printf("\nns of processor time, the least and the median of %d rounds in which all of a group\n"
           "take turns. Under the name of a level: how many times as fast as the line's buffon is\n"
           "at that level, the median over the rounds.\n",
           BENCH_ROUNDS);
    bench_uniforms();
    bench_shapes();
    bench_laws();
    bench_functions();
    bench_integrals();
    bench_overhead();
    bench_memory();
    bench_print_targets();
    peers_stop();
    return 0;
}
