/* Writes a shape of rng_shapes.h to standard output as raw bytes, without end, for a battery of
 * tests to read: battery NAME [FIRST CHUNK]. Without a name, lists the names. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rng_shapes.h"

int main(int argc, char **argv)
{
    static uint64_t w[SHAPE_CHUNK];
    uint64_t chunk = argc > 2 ? strtoull(argv[2], NULL, 10) : 0;
    for (size_t i = 0; i < SHAPE_COUNT; i++) {
        const shape *s = &shape_list[i];
        if (argc < 2)
            printf("%s\n", s->name);
        else if (strcmp(argv[1], s->name) == 0)
            for (;; chunk++) {
                s->make(w, chunk, s->kind);
                if (fwrite(w, sizeof w, 1, stdout) != 1)
                    return 0;
            }
    }
    if (argc < 2)
        return 0;
    fprintf(stderr, "battery: no shape \"%s\"\n", argv[1]);
    return 1;
}
