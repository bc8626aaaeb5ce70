#!/bin/sh
# The same bits from every build: tests/bits.c prints results in hex, and what it prints must be the
# same from every compiler, level of optimisation and instruction set of this machine, with and
# without threads and vectors, from many sources and from one. Other machines: tests/cross.sh.
. tests/tap.sh
. tests/same_bits.sh
build=${BUILD:-build}/bits
unset MAKEFLAGS MFLAGS MAKELEVEL CFLAGS CPPFLAGS LDFLAGS
mkdir -p "$build"
top=$(pwd)

# try <compiler> <name> <CFLAGS> [CPPFLAGS]
try()
{
    out=$build/$1-$2
    tap_run "$1-$2: builds" "${MAKE:-make}" --no-print-directory -j"${JOBS:-2}" "$out/tests/bits" \
        BUILD="$out" CC="$1" CFLAGS="$3" CPPFLAGS="${4:-}"
    same_bits "$1-$2" "$out/tests/bits" "$build"
}

# Dropped into a build that knows none of our flags: the pragmas of src/guard.h must do.
drop_in()
{
    rm -rf "$2" && mkdir -p "$2" &&
        (cd "$2" && printf '%s\n' "$top"/src/*.c |
        xargs -P "${JOBS:-2}" -n 4 $1 -O3 -march=native -I"$top/include" -c) &&
        $1 -O2 -std=c11 -ffp-contract=off -Iinclude tests/bits.c "$2"/*.o -o "$2/bits" -lm -pthread
}

for compiler in gcc clang; do
    if ! command -v $compiler > /dev/null; then
        tap_skip "$compiler" "it is not installed"
        continue
    fi
    try $compiler O3 '-O3'
    try $compiler plain '-O2' '-DBUFFON_NO_THREADS -DBUFFON_NO_VECTORS'
    # Compiling takes minutes here, so these are left to one compiler.
    if [ $compiler = gcc ]; then
        try $compiler O0 '-O0'
        try $compiler Os '-Os'
        try $compiler native '-O3 -march=native'
    fi
    tap_run "$compiler-drop-in: builds" drop_in $compiler "$build/$compiler-drop-in"
    same_bits $compiler-drop-in "$build/$compiler-drop-in/bits" "$build"
done

one_file_make "$build"
for compiler in gcc clang musl-gcc; do
    if command -v $compiler > /dev/null; then one_file_build $compiler $compiler & fi
done
wait
for compiler in gcc clang musl-gcc; do
    if command -v $compiler > /dev/null; then
        one_file_bits $compiler
    else
        tap_skip "$compiler, one file" "it is not installed"
    fi
done
tap_done
