/* A test program prints TAP: one line `ok N - what` or `not ok N - what` for each check, and the
 * plan at the end. Include it in the one file of a test program; close main with
 * `return tap_done();`. */
#ifndef TESTS_TAP_H
#define TESTS_TAP_H

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#if defined(__GNUC__) || defined(__clang__)
#define TAP_PRINTF(at, from) __attribute__((format(printf, at, from), unused))
#else
#define TAP_PRINTF(at, from)
#endif

static int tap_count, tap_failures;

/* One check. Returns what it was given, so that details can follow a failure. */
TAP_PRINTF(2, 3) static int tap_ok(int good, const char *format, ...)
{
    va_list list;
    tap_count++;
    tap_failures += !good;
    printf("%s %d - ", good ? "ok" : "not ok", tap_count);
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
    printf("\n");
    fflush(stdout);
    return good;
}

/* A remark that is not a check. */
TAP_PRINTF(1, 2) static void tap_note(const char *format, ...)
{
    va_list list;
    printf("# ");
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
    printf("\n");
}

static int tap_done(void)
{
    printf("1..%d\n", tap_count);
    return tap_failures != 0;
}

/* The bits of a double: equality here tells -0 from 0 and holds for equal NaNs. */
static inline uint64_t tap_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

#endif
