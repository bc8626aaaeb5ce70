/* Private. Invariants that hold unless the library itself is wrong. They are checked in the build
 * that the tests link (-DBUFFON_VERIFY) and cost nothing in the one that is installed, which never
 * ends its host's process.
 */
#ifndef BUFFON_SRC_VERIFY_H
#define BUFFON_SRC_VERIFY_H

#ifdef BUFFON_VERIFY

#include <stdio.h>
#include <stdlib.h>

#define BUFFON_PRIV_VERIFY(condition)                                                             \
    do {                                                                                          \
        if (!(condition)) {                                                                       \
            fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition);        \
            abort();                                                                              \
        }                                                                                         \
    } while (0)

#else

/* The condition is compiled, so that it cannot rot, and not evaluated. */
#define BUFFON_PRIV_VERIFY(condition) ((void)sizeof((condition) ? 1 : 0))

#endif

#endif
