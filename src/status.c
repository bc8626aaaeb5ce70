/* The texts of the list in status.h. A switch: two statuses of one number would not compile. */
#include "guard.h"

#include <buffon/status.h>

const char *buffon_status_string(buffon_status status)
{
    switch (status) {
#define STATUS_CASE(name, number, text)                                                           \
    case name:                                                                                    \
        return text;
        BUFFON_STATUS_LIST(STATUS_CASE)
#undef STATUS_CASE
    }
    return "unknown status";
}

const char *buffon_status_name(buffon_status status)
{
    switch (status) {
#define STATUS_CASE(name, number, text)                                                           \
    case name:                                                                                    \
        return #name;
        BUFFON_STATUS_LIST(STATUS_CASE)
#undef STATUS_CASE
    }
    return "unknown";
}
