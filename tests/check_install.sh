#!/bin/sh
# The library as a package: installed into a scratch directory, found by pkg-config, linked to
# programs that were compiled by other compilers with other flags, and taken away again.
. tests/tap.sh
CC=${CC:-cc}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# The flags reach make through the environment, so that nothing is built again.
unset MAKEFLAGS MFLAGS MAKELEVEL DESTDIR PREFIX LIBDIR INCLUDEDIR
abi=$(sed -n 's/^#define BUFFON_ABI //p' include/buffon/version.h)

tap_run "make install DESTDIR PREFIX" \
    "${MAKE:-make}" --no-print-directory -j1 install DESTDIR="$scratch/dest" PREFIX=/usr
root=$scratch/dest/usr
for file in include/buffon/buffon.h lib/libbuffon.a lib/libbuffon.so lib/libbuffon.so.$abi \
    lib/pkgconfig/buffon.pc; do
    test -f "$root/$file"
    tap_ok $? "it installs $file"
done
tap_empty "$(cd include/buffon && for h in *.h; do cmp "$h" "$root/include/buffon/$h"; done 2>&1)" \
    "it installs every header"

cflags="-I$root/include" libs="-L$root/lib -lbuffon" static="-lm -pthread"
pc_path=$root/lib/pkgconfig
pc()
{
    PKG_CONFIG_PATH=$pc_path ${PKG_CONFIG:-pkg-config} --define-variable=prefix="$root" "$@" buffon
}
if command -v "${PKG_CONFIG:-pkg-config}" > /dev/null; then
    pc --modversion > "$scratch/version"
    test "$(cat "$scratch/version")" = \
        "$(sed -n 's/^#define BUFFON_VERSION_STRING "\(.*\)"/\1/p' include/buffon/version.h)"
    tap_ok $? "pkg-config knows the version"
    cflags=$(pc --cflags) libs=$(pc --libs) static=$(pc --static --libs)
    test "$(echo $libs)" = "-L$root/lib -lbuffon"
    tap_ok $? "shared linking asks for -lbuffon alone"
    case $static in *-lbuffon*-lm*-pthread*) true ;; *) false ;; esac
    tap_ok $? "static linking asks for -lm -pthread too"
else
    tap_skip "pkg-config finds the library" "there is no pkg-config"
fi

strict='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror'
# build <compiler and flags> <output> <source> <libraries>: unquoted on purpose, these are lists.
build()
{
    $1 $cflags ${CFLAGS:-} $4 -o "$scratch/$2" "$3" ${LDFLAGS:-} $5
}
run()
{
    LD_LIBRARY_PATH=$root/lib "$scratch/$1" > "$scratch/$1.out"
}
# consumer <what> <name> <compiler> <source> <flags> <libraries>: prints what the first one printed.
consumer()
{
    if tap_run "$1 compiles" build "$3" "$2" "$4" "$5" "$6" && test -x "$scratch/$2"; then
        tap_run "$1 runs" run "$2"
        if [ "$2" != shared ]; then
            tap_run "$1 prints the same bits" cmp "$scratch/shared.out" "$scratch/$2.out"
        fi
    fi
}
archive="$root/lib/libbuffon.a $static"
consumer "a C program" shared "$CC" tests/embed/consumer.c "-std=c11 $strict" "$libs"
consumer "a C program, linked statically" static "$CC" tests/embed/consumer.c \
    "-std=c11 $strict" "$archive"
consumer "a C program with -ffast-math" fast "$CC" tests/embed/consumer.c \
    "-std=gnu11 -O2 -ffast-math" "$archive"
cxx=$(tap_cxx)
if [ -n "$cxx" ]; then
    consumer "a C++ program" cpp "$cxx" tests/embed/consumer.cpp \
        "-std=c++17 -O0 -fno-exceptions -fno-rtti $strict" "$libs"
else
    tap_skip "a C++ program" "there is no C++ compiler"
fi

# The README's first program, as a reader would build it.
tap_run "the README's program compiles" build "$CC" readme examples/first.c -std=c11 "$libs -lm"
tap_run "the README's program runs" run readme

tap_run "make uninstall" "${MAKE:-make}" --no-print-directory uninstall \
    DESTDIR="$scratch/dest" PREFIX=/usr
tap_empty "$(find "$scratch/dest" ! -type d; find "$scratch/dest" -name buffon -path '*include*')" \
    "uninstall leaves nothing"
tap_done
