#!/bin/sh
# The library as one source and one header: written the same by every awk, compiled as a reader
# would with no flag that matters, linked to C and C++, with the bits of the library. Only $CC
# generates code here, and little of it, since that takes seconds; the other compilers look for
# mistakes. `make bits` and `make cross` do the rest.
. tests/tap.sh
. tests/same_bits.sh
CC=${CC:-cc}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset MAKEFLAGS MFLAGS MAKELEVEL
export LC_ALL=C
one=$scratch/amalgamation
strict='-Wall -Wextra -Werror'

one_file_make "$scratch"
for part in buffon.c buffon.h; do
    sed -n 's/^ \* \{0,1\}//p' "$one/$part" | head -n "$(wc -l < LICENSE)" | cmp -s - LICENSE
    tap_ok $? "$part begins with the licence"
done
tap_empty "$(grep -n '^ *# *include *[^< ]' "$one/buffon.h" "$one/buffon.c" |
    grep -v 'buffon\.c:[0-9]*:#include "buffon\.h"$')" "they include nothing of ours but buffon.h"

version=$(sed -n '1s/^[^0-9]*\([0-9.]*\).*/\1/p' "$one/buffon.h")
same_from()
{
    $1 -v version="$version" -f src/amalgamation.awk src/*.c | cmp - "$one/buffon.c" &&
        $1 -v version="$version" -f src/amalgamation.awk include/buffon/buffon.h |
        cmp - "$one/buffon.h"
}
for awk in mawk gawk original-awk 'busybox awk'; do
    if $awk 'BEGIN { exit 0 }' > /dev/null 2>&1; then
        tap_run "$awk writes the same" same_from "$awk"
    fi
done

# As a reader would compile it.
tap_run "$CC compiles it without a warning" \
    $CC -O1 $strict -c -o "$scratch/buffon.o" "$one/buffon.c"
tap_run "$CC: no warning as C11" $CC $strict -std=c11 -fsyntax-only "$one/buffon.c"
for compiler in clang musl-gcc; do
    if command -v $compiler > /dev/null; then
        for mode in gnu17 c11; do
            tap_run "$compiler: no warning as $mode" \
                $compiler $strict -std=$mode -fsyntax-only "$one/buffon.c"
        done
    else
        tap_skip "$compiler: no warning" "it is not installed"
    fi
done

# What the linker sees of it is what it sees of the library.
names()
{
    nm -g --defined-only "$1" | awk '$NF ~ /^buffon_/ { print $NF }' | sort
}
names "$scratch/buffon.o" > "$scratch/names"
names "${BUILD:-build}/libbuffon.a" | diff - "$scratch/names" > "$scratch/other" &&
    test -s "$scratch/names"
tap_ok $? "its names are those of the library"

# Programs that include <buffon/buffon.h> get the one header.
program()
{
    $1 -O1 $strict -I"$scratch/include" -o "$scratch/$2" "$3" "$scratch/buffon.o" -lm -pthread
}
tap_run "a C program" program "$CC -std=c11 -ffp-contract=off" bits tests/bits.c
same_bits "$CC" "$scratch/bits" "$scratch"
cxx=$(tap_cxx)
if [ -n "$cxx" ]; then
    tap_run "a C++ program" program "$cxx -std=c++17 -Wpedantic" cpp tests/embed/consumer.cpp
    tap_run "a C++ program runs" "$scratch/cpp"
else
    tap_skip "a C++ program" "there is no C++ compiler"
fi
tap_done
