#!/bin/sh
# The library on other processors: 64-bit ARM, the other byte order (s390x), 32 bits (i686). On each
# the one file, compiled by gcc, on ARM by clang too, with no flag that matters, has the bits of
# tests/data/bits.txt, and the test programs that are exact or have known answers pass. Those about
# laws and error bars would take long here and could say no more: they see the same bits.
# A machine without its compiler or emulator is skipped by name.
. tests/tap.sh
. tests/same_bits.sh
build=${BUILD:-build}/cross
unset MAKEFLAGS MFLAGS MAKELEVEL CFLAGS CPPFLAGS LDFLAGS

tests='density errors exact interval inversion layout math moments partial rejection rng saved
    shapes stats status'
clang=
if command -v clang > /dev/null; then
    clang=clang
else
    tap_skip "clang" "it is not installed"
fi

# x86 runs 32-bit programs by itself. Not under qemu-i386, where a thread may never start.
loader=/usr/i686-linux-gnu/lib/ld-linux.so.2
x86='-msse2 -mfpmath=sse'

# one <compiler> <architecture> [flags]: the one file, if the compiler is here.
one()
{
    case $1 in
    gcc) ! command -v "$2-linux-gnu-gcc" > /dev/null ||
        one_file_build "$2-gcc" "$2-linux-gnu-gcc ${3:-}" ;;
    clang) test -z "$clang" || one_file_build "$2-clang" "clang --target=$2-linux-gnu" ;;
    esac
}

# machine <architecture> <flags> <levels> <compilers> <what runs its programs> [more tests]
machine()
{
    if ! command -v "$1-linux-gnu-gcc" > /dev/null || ! command -v "${5%% *}" > /dev/null; then
        tap_skip "$1" "it takes $1-linux-gnu-gcc and ${5%% *}"
        return
    fi
    same_bits_levels=$3
    for compiler in $4; do one_file_bits "$1-$compiler" "$5"; done
    tap_run "$1: tests" "${MAKE:-make}" --no-print-directory -j"${JOBS:-2}" unit \
        BUILD="$build/$1" CC="$1-linux-gnu-gcc" CFLAGS="-O1 $2" RUNNER="$5" \
        WARNINGS='-Wall -Wextra -Werror' TESTS="$(printf 'test_%s ' $tests ${6:-})"
    echo "# $1: $(printf '%s\n' "$tap_output" | tail -n 1)"
}

# Compiling one file takes one processor, and long: two at a time.
one_file_make "$build"
{ one gcc i686 "$x86"; one gcc s390x; } &
{ one gcc aarch64; one clang aarch64; } &
wait

if $loader --version > /dev/null 2>&1; then
    machine i686 "$x86" 'scalar 128 avx2 avx512' gcc \
        "$loader --library-path ${loader%/*}" 'cpu levels points elementary tail'
else
    tap_skip "i686" "its C library is not here, or this system does not run it"
fi
machine aarch64 '' 'scalar 128' "gcc $clang" 'qemu-aarch64 -L /usr/aarch64-linux-gnu' \
    'cpu levels points tail'
machine s390x '' scalar gcc 'qemu-s390x -L /usr/s390x-linux-gnu'

# Doubles with spare bits would give other results: the x87 is refused.
if command -v i686-linux-gnu-gcc > /dev/null; then
    i686-linux-gnu-gcc -fsyntax-only "$build/amalgamation/buffon.c" 2>&1 |
        grep -q '#error .*-msse2 -mfpmath=sse'
    tap_ok $? "the x87 is refused"
fi
tap_done
