#!/bin/sh
# The public headers: documented, layered, guarded, and fit to be included alone from C and C++.
. tests/tap.sh
CC=${CC:-cc}
headers=$(echo include/buffon/*.h)
warnings='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -Iinclude -fsyntax-only'

# Every function and type has a comment of the form /** ... */ directly above, every function's says
# since when it is there.
undocumented=$(awk '
    FNR == 1 { doc = ""; inside = 0 }
    /^\/\*\*/ { doc = ""; inside = 1 }
    inside { doc = doc $0 "\n"; if (/\*\/$/) inside = 0; next }
    /^(BUFFON_API|typedef|struct|union|enum)/ && !/^(struct|union|enum) [a-z_0-9]+;$/ {
        if (doc == "" || doc !~ /^\/\*\* [A-Za-z]/)
            print FILENAME ":" FNR ": no comment of the form /** ... */ above: " $0
        else if (/^BUFFON_API/ && doc !~ /\n \*  Since:   [0-9]+\.[0-9]+\n/)
            print FILENAME ":" FNR ": the comment has no line Since: " $0
    }
    { doc = "" }' $headers)
tap_empty "$undocumented" "every public function and type is documented"

# Calls that can fail say so to the compiler.
unchecked=$(grep -n '^BUFFON_API buffon_status ' $headers)
tap_empty "$unchecked" "functions that return a status carry BUFFON_CHECK"

# The table in buffon.h ranks the headers; includes go to a lower rank. Its own line comes first.
misplaced=$(awk '
    FNR == 1 { n = split(FILENAME, path, "/"); self = path[n]; sub(/\.h$/, "", self) }
    self == "buffon" && /^ \*     layer [0-9]/ {
        for (i = 4; i <= NF; i++) { rank[$i] = ++ranks; layer[$i] = $3 }
    }
    self == "buffon" { if (/^#include/) included[$2] = 1; next }
    FNR == 1 && !(self in rank) { print FILENAME ": not in the table of buffon.h"; next }
    FNR == 1 && $0 !~ "^/\\* Layer " layer[self] "[.] [A-Z]" {
        print FILENAME ":1: does not begin with its layer, " layer[self]
    }
    FNR == 1 && !(("\"" self ".h\"") in included) { print "buffon.h does not include " self ".h" }
    /^#include "/ {
        to = $2; gsub(/"|\.h/, "", to)
        if (!(to in rank) || rank[to] >= rank[self])
            print FILENAME ":" FNR ": includes " to ".h, which is not below or to the left"
    }
    /^#include </ && $2 !~ /^<(stddef|stdint|string)\.h>$/ {
        print FILENAME ":" FNR ": includes " $2
    }' include/buffon/buffon.h $(echo $headers | sed 's, *include/buffon/buffon\.h,,'))
tap_empty "$misplaced" "includes point down, or to the left within a row, of the table in buffon.h"

unguarded=$(for header in $headers; do
    name=BUFFON_$(basename "$header" .h | tr a-z A-Z)_H
    grep -q "^#ifndef $name\$" "$header" && grep -q "^#define $name\$" "$header" ||
        echo "$header: not guarded by $name"
done)
tap_empty "$unguarded" "every header is guarded by its own name"

cxx=$(tap_cxx)
alone()
{
    for header in $headers; do
        # Twice: the guard holds.
        printf '#include "%s"\n#include "%s"\nint main(void) { return 0; }\n' \
            "${header#include/}" "${header#include/}" | "$@" - || return 1
    done
}
tap_run "every header compiles alone as C11" \
    alone $CC ${CPPFLAGS:-} -std=c11 -Wstrict-prototypes $warnings -x c
if [ -n "$cxx" ]; then
    tap_run "every header compiles alone as C++17" alone $cxx -std=c++17 $warnings -x c++
else
    tap_skip "every header compiles alone as C++17" "there is no C++ compiler"
fi
tap_done
