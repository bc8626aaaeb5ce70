/* The version, as the library that is linked has it. */
#include "guard.h"

#include <buffon/version.h>

const char *buffon_version(void)
{
    return BUFFON_VERSION_STRING;
}
