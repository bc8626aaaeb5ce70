/* A clock in place of the system's, which the linker puts there (see the Makefile). It leaps
 * between one look at it and the next: by a second, so that a run starts its threads with its first
 * block, however fast the machine; or as a test says. At rest it stands still, and a run starts
 * none. */
#ifndef TESTS_LEAP_H
#define TESTS_LEAP_H

#include <time.h>

static double leap_seconds = 1, leap_now;

int __wrap_clock_gettime(clockid_t id, struct timespec *t);

int __wrap_clock_gettime(clockid_t id, struct timespec *t)
{
    (void)id;
    leap_now += leap_seconds;
    t->tv_sec = (time_t)leap_now;
    t->tv_nsec = (long)((leap_now - (double)t->tv_sec) * 1e9);
    return 0;
}

#endif
