#!/bin/sh
# The files of the repository: plain text of the agreed shape, and sources that fit together in one.
. tests/tap.sh
CC=${CC:-cc}
files=$(find Makefile LICENSE README.md include src tests examples docs .ci -type f 2> /dev/null |
    grep -Ev '\.(png|gz)$' | sort)
code=$(printf '%s\n' "$files" | grep -E '\.(c|h|cpp|sh|awk)$|^Makefile$|^\.ci/')
export LC_ALL=C

# Published data and licences are kept as their authors wrote them.
own=$(printf '%s\n' "$files" | grep -v '^tests/data/')
tab=$(printf '\t')
tap_empty "$(grep -n "[^ -~$tab]" $own /dev/null)" "US-ASCII"
tap_empty "$(awk 'length > 100 { print FILENAME ":" FNR ": " length " columns" }' $code)" \
    "code has at most 100 columns"
tap_empty "$(grep -n "$tab" $(printf '%s\n' "$code" | grep -v '^Makefile$') /dev/null)" \
    "no tabs but in the Makefile"
tap_empty "$(grep -n ' $' $code /dev/null)" "no blanks at the end of a line"
tap_empty "$(for file in $own; do
    tail -c 1 "$file" | od -An -c | grep -q '\\n' || echo "$file: no newline at its end"
done)" "every file ends with a newline"

marks='TO''DO|FIX''ME|X''XX|HA''CK|not imple''mented'
tap_empty "$(grep -nE "(^|[^A-Za-z])($marks)([^A-Za-z]|\$)" $own /dev/null)" \
    "no marks of unfinished work"
# Paths that hold on one machine only: absolute ones but those that every system has.
tap_empty "$(grep -nE "(^|[ \"'=(<>\`])/[a-z]+/[A-Za-z0-9_.]" $own /dev/null |
    grep -vE "[ \"'=(<>\`:]/(usr|bin|dev|etc|tmp|proc)/")" "no paths of one machine"
tap_empty "$(grep -nE '(^|[^.])\.\./[a-z]' $own /dev/null |
    grep -vE '#include|\]\(\.\./(docs|examples|include|src|tests)/')" \
    "nothing outside the repository is referred to"

tap_empty "$(for file in src/*.c; do
    test "$(grep -m 1 '^#include' "$file")" = '#include "guard.h"' ||
        echo "$file: does not include guard.h first"
done)" "every source includes guard.h first"
tap_empty "$(grep -nE '(^|[^a-z_])(long double|__int128|__float128)([^a-z_]|$)' src/*.c src/*.h \
    include/buffon/*.h | grep -vE '^[^:]*:[0-9]+: *(/\*|\*)')" "no types wider than 64 bits"

# One file of all sources: no two share a static function, a macro or a type.
one=$(mktemp -d)
trap 'rm -rf "$one"' EXIT
for file in src/*.c; do echo "#include \"$(basename "$file")\""; done > "$one/all.c"
as_one()
{
    $CC -Iinclude -Isrc ${CPPFLAGS:-} -std=c11 -O0 -Wall -Wextra -Werror "$@" "$one/all.c"
}
tap_run "all sources compile as one file" as_one -c -o "$one/all.o"
tap_run "and without threads" as_one -fsyntax-only -DBUFFON_NO_THREADS
tap_run "and without vectors" as_one -fsyntax-only -DBUFFON_NO_VECTORS
tap_run "and with invariants checked" as_one -fsyntax-only -DBUFFON_VERIFY
tap_empty "$(nm -g --defined-only "$one/all.o" 2> /dev/null | awk '{ print $NF }' |
    grep -Ev '^buffon_[a-z0-9_]+$')" "names seen by the linker are buffon_*"

# Flags that would change results are refused, not obeyed.
for flag in -ffast-math -Ofast -ffinite-math-only; do
    $CC -Iinclude $flag -fsyntax-only src/version.c > /dev/null 2>&1
    test $? -ne 0
    tap_ok $? "$flag is refused"
done
tap_done
