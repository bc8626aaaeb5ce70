#!/bin/sh
# What the documents say against what is there: the README's first program and its output, the two
# commands, its tables and names; a line in docs/errors.md for every status; links that lead on.
. tests/tap.sh
build=${BUILD:-build}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# block <language>: the first listing of that language in the README.
block()
{
    awk -v fence='```'"$1" '
        $0 == fence && !seen { inside = seen = 1; next }
        /^```/ { inside = 0 }
        inside' README.md
}

# names <regular expression>: what matches it in the README, once each.
names()
{
    grep -oE "$1" README.md | sort -u
}

block sh > "$scratch/commands"
printf 'make demo\nmake test\n' | cmp -s - "$scratch/commands"
tap_ok $? "the first commands are make demo and make test"
first=$(grep -n -m 1 'make ' README.md | cut -d : -f 2)
test "$first" = "make demo"
tap_ok $? "and no other comes before them"

block c > "$scratch/first.c"
tap_run "the first program is examples/first.c" diff examples/first.c "$scratch/first.c"
block text > "$scratch/expected"
"$build/examples/first" > "$scratch/printed"
tap_run "it prints what is shown" diff "$scratch/expected" "$scratch/printed"

cxx=$(tap_cxx)
if [ -n "$cxx" ]; then
    {
        echo '#include <buffon/buffon.h>'
        echo 'int main() { const double lo[] = {0, 0}, hi[] = {1, 1};'
        block cpp
        echo 'return s; }'
    } > "$scratch/first.cpp"
    tap_run "the lines of C++ compile" \
        $cxx -std=c++17 -Wall -Wextra -Werror -Iinclude -fsyntax-only "$scratch/first.cpp"
else
    tap_skip "the lines of C++ compile" "there is no C++ compiler"
fi

# The table of headers, in the order and with the layers of buffon.h.
awk -F '[|`]' '/^\| [0-9] \| `/ { print $2 + 0, $4 }' README.md > "$scratch/table"
awk '/^ \*     layer [0-9]/ { for (i = 4; i <= NF; i++) print $3, $i ".h" }' \
    include/buffon/buffon.h > "$scratch/headers"
tap_run "the table has every header in its layer" diff "$scratch/headers" "$scratch/table"

tap_empty "$(for file in examples/*.c; do
    grep -qF "\`$(basename "$file")\`" README.md || echo "$file"
done)" "it names every example"
tap_empty "$(for name in $(names '`[a-z_]+\.c`' | tr -d '\140'); do
    test -f "examples/$name" || echo "$name"
done)" "and none that is not there"
tap_empty "$(for name in $(names '`(test|check)_[a-z_]+`' | tr -d '\140'); do
    test -f "tests/$name.c" || test -f "tests/$name.sh" || echo "$name"
done)" "the tests that it names are there"
tap_empty "$(for target in $(names '`make [a-z-]+' | cut -d ' ' -f 2); do
    grep -qE "^$target:.*## " Makefile || echo "make $target"
done)" "the targets that it names are there"

tap_empty "$(for file in README.md docs/*.md; do
    grep -oE '\]\([^)#: ]+\)' "$file" | tr -d ']()' | while read -r link; do
        test -e "$(dirname "$file")/$link" || echo "$file: $link"
    done
done)" "links between documents lead somewhere"

sed -n 's/^ *X(\(BUFFON_[A-Z_]*\), \(-*[0-9]*\),.*/\2 \1/p' include/buffon/status.h |
    sort > "$scratch/statuses"
awk -F '[|`]' '/^\| *-?[0-9]+ \| `BUFFON_/ { print $2 + 0, $4 }' docs/errors.md |
    sort > "$scratch/explained"
test -s "$scratch/statuses"
tap_ok $? "status.h lists statuses"
tap_run "docs/errors.md explains every status" diff "$scratch/statuses" "$scratch/explained"

version=$(sed -n 's/^#define BUFFON_VERSION_STRING "\(.*\)"/\1/p' include/buffon/version.h)
grep -qx "## $version" docs/changelog.md
tap_ok $? "docs/changelog.md has this version"
tap_done
