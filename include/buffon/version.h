/* Layer 0. The version, in one place: the build reads it from here. */
#ifndef BUFFON_VERSION_H
#define BUFFON_VERSION_H

#include "api.h"

#define BUFFON_VERSION_MAJOR 0
#define BUFFON_VERSION_MINOR 1
#define BUFFON_VERSION_PATCH 0
#define BUFFON_VERSION_STRING "0.1.0"

/* The number of the binary interface: the soname. It changes when a struct or a signature does. */
#define BUFFON_ABI 0

BUFFON_BEGIN

/** The version of the library that is linked, such as "0.1.0".
 *
 *  Compare it with BUFFON_VERSION_STRING, which is the version of the headers.
 *
 *  Returns: a string that lives as long as the program
 *  Since:   0.1
 */
BUFFON_API const char *buffon_version(void);

BUFFON_END

#endif
