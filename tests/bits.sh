#!/bin/sh
# The same bits from every build: tests/bits.c prints results in hex, and what it prints must be the
# same from every compiler, level of optimisation and instruction set of this machine, with and
# without threads and vectors, from many sources and from one. Other machines: tests/cross.sh.
. tests/tap.sh
. tests/same_bits.sh
here=${BUILD:-build}
build=$here/bits
mkdir -p "$build"
top=$(pwd)

tap_run "this build: builds" "${MAKE:-make}" --no-print-directory "$here/tests/bits"
same_bits "this build" "$here/tests/bits" "$build"
unset MAKEFLAGS MFLAGS MAKELEVEL CFLAGS CPPFLAGS LDFLAGS

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

# Compiling takes minutes here, so the levels of optimisation are left to one compiler.
try gcc plain '-O2' '-DBUFFON_NO_THREADS -DBUFFON_NO_VECTORS'
try gcc O0 '-O0'
for compiler in gcc clang; do
    if command -v $compiler > /dev/null; then
        tap_run "$compiler-drop-in: builds" drop_in $compiler "$build/$compiler-drop-in"
        same_bits $compiler-drop-in "$build/$compiler-drop-in/bits" "$build"
    else
        tap_skip "$compiler" "it is not installed"
    fi
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
