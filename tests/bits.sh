#!/bin/sh
# The same bits from every build: tests/bits.c prints results in hex, and what it prints must be the
# same from every compiler, level of optimisation and instruction set of this machine, with and
# without threads and vectors, for 32 bits and for the other byte order.
# tests/data/bits.txt, where it exists, is what it printed on the machine where it was frozen.
. tests/tap.sh
build=${BUILD:-build}/bits
unset MAKEFLAGS MFLAGS MAKELEVEL CFLAGS CPPFLAGS LDFLAGS
mkdir -p "$build"
reference=tests/data/bits.txt

# compare <name> <program> [emulator]
compare()
{
    tap_run "$1: runs" sh -c "${3:-} '$2' > '$build/$1.txt'"
    if [ -f "$reference" ]; then
        tap_run "$1: the bits of $reference" diff "$reference" "$build/$1.txt"
    else
        test -s "$build/$1.txt"
        tap_ok $? "$1: the reference for the others"
        reference=$build/$1.txt
    fi
}

# try <compiler> <name> <CFLAGS> [CPPFLAGS [emulator]]
try()
{
    out=$build/$1-$2
    tap_run "$1-$2: builds" "${MAKE:-make}" --no-print-directory -j"${JOBS:-2}" "$out/tests/bits" \
        BUILD="$out" CC="$1" CFLAGS="$3" CPPFLAGS="${4:-}"
    compare "$1-$2" "$out/tests/bits" "${5:-}"
}

# cross <architecture> <CFLAGS> <what runs its programs> <arguments of that>
cross()
{
    if command -v "$1-linux-gnu-gcc" > /dev/null && command -v "$3" > /dev/null; then
        try "$1-linux-gnu-gcc" O2 "$2" '' "$3 $4"
    else
        tap_skip "$1" "it takes $1-linux-gnu-gcc and $3"
    fi
}

# Dropped into a build that knows none of our flags: the pragmas of src/guard.h must do.
drop_in()
{
    mkdir -p "$2"
    for source in src/*.c; do
        $1 -O3 -march=native -Iinclude -c "$source" -o "$2/$(basename "$source" .c).o" || return 1
    done
    $1 -O2 -std=c11 -ffp-contract=off -Iinclude tests/bits.c "$2"/*.o -o "$2/bits" -lm -pthread
}

for compiler in gcc clang; do
    if ! command -v $compiler > /dev/null; then
        tap_skip "$compiler" "it is not installed"
        continue
    fi
    try $compiler O3 '-O3'
    try $compiler O0 '-O0'
    try $compiler Os '-Os'
    try $compiler native '-O3 -march=native'
    try $compiler plain '-O2' '-DBUFFON_NO_THREADS -DBUFFON_NO_VECTORS'
    tap_run "$compiler-drop-in: builds" drop_in $compiler "$build/$compiler-drop-in"
    compare $compiler-drop-in "$build/$compiler-drop-in/bits"
done

# The other byte order, and 32 bits.
cross s390x '-O2' qemu-s390x '-L /usr/s390x-linux-gnu'
cross i686 '-O2 -msse2 -mfpmath=sse' /usr/i686-linux-gnu/lib/ld-linux.so.2 \
    '--library-path /usr/i686-linux-gnu/lib'
tap_done
