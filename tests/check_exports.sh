#!/bin/sh
# The shared library: exports what the headers declare and nothing else, and asks of the system
# nothing but memory, threads, a clock and plain functions: no stdio, exit, environment, locale or
# errno.
. tests/tap.sh
library=$(ls "${BUILD:-build}"/libbuffon.so.*.*.*)
declared=$(mktemp)
exported=$(mktemp)
trap 'rm -f "$declared" "$exported"' EXIT

# From BUFFON_API to the parenthesis; the name stands before it.
awk '
    /^BUFFON_API/ { text = ""; open = 1 }
    open {
        text = text " " $0
        if (match(text, /[a-zA-Z0-9_]+\(/)) { print substr(text, RSTART, RLENGTH - 1); open = 0 }
    }' include/buffon/*.h | sort > "$declared"
nm -D --defined-only "$library" | awk '{ sub(/@.*/, "", $NF); print $NF }' | sort > "$exported"

test -s "$declared"
tap_ok $? "the headers declare functions"
tap_empty "$(comm -23 "$declared" "$exported")" "every declared function is exported"
tap_empty "$(comm -13 "$declared" "$exported")" "nothing else is exported"
tap_empty "$(grep -v '^buffon_' "$declared")" "every declared function is called buffon_*"

allowed='malloc|calloc|realloc|free|memcpy|memmove|memset|memcmp|memchr|strlen|strcmp|sqrt'
allowed="$allowed|pthread_[a-z_]+|clock_gettime|sigfillset"
# What compilers add by themselves, hardening included.
allowed="$allowed|__stack_chk_(fail|guard)|__(memcpy|memmove|memset)_chk|__tls_get_addr"
allowed="$allowed|_ITM_(de)?registerTMCloneTable|__gmon_start__|__cxa_finalize"
case "${CFLAGS:-}" in
    *-fsanitize* | *--coverage*)
        tap_skip "imports are limited" "instrumented code imports its own" ;;
    *)
        imported=$(nm -D --undefined-only "$library" | awk '{ sub(/@.*/, "", $NF); print $NF }')
        tap_empty "$(printf '%s\n' "$imported" | grep -Ev "^($allowed)\$")" \
            "imports are limited to memory, threads, a clock and sqrt" ;;
esac

if command -v readelf > /dev/null; then
    abi=$(sed -n 's/^#define BUFFON_ABI //p' include/buffon/version.h)
    soname=$(readelf -d "$library" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')
    test "$soname" = "libbuffon.so.$abi"
    tap_ok $? "the soname is libbuffon.so.$abi"
    needed=$(readelf -d "$library" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p')
    tap_empty "$(printf '%s\n' "$needed" |
        grep -Ev '^(lib(c|m|pthread|gcc_s)|ld-[a-z0-9_-]+|libc\.musl-[a-z0-9_]+)\.so')" \
        "it needs libc and libm alone"
    # Memory that is written and outlives a call would be global state. The level of vector
    # instructions is such, and no result depends on it.
    state=$(for object in "${BUILD:-build}"/obj/*.o; do
        nm "$object" | awk -v o="$(basename "$object")" \
            'NF > 1 && $(NF - 1) ~ /^[bBdDC]$/ { print o ": " $NF }'
    done | grep -Ev ': (.*_ops|completed\.[0-9]+|cpu_(best|used)|__gcov.*)$')
    tap_empty "$state" "no writable global data but the level of cpu.h"
else
    tap_skip "soname and needed libraries" "there is no readelf"
fi
tap_done
