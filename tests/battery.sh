#!/bin/sh
# Dieharder (R. Brown) over the shapes of tests/rng_shapes.h, with a line for each shape.
#
#     tests/battery.sh build/tests/battery [shape...]
#
# Without shapes, all of them. BATTERY_TESTS are the numbers that `dieharder -l` lists, with the
# length of its tuples after a colon; BATTERY_SECONDS bounds each. Of good words one p-value in a
# hundred is WEAK (below 0.005 or above 0.995), so each such test is run again on other words, and
# both p-values are printed; the line counts the first. Fails if a test did.
set -u

program=$1
shift
all='0 1 2 3 8 9 10 11 12 13 15 16 100 101 102 200:4 201:3 202:5 203:3 204 205 206 207 208 209'
tests=${BATTERY_TESTS:-$all}
seconds=${BATTERY_SECONDS:-120}
if ! command -v dieharder > /dev/null; then
    echo "battery: needs dieharder, a Debian package of that name" >&2
    exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# run shape test first-chunk: the lines `name|ntuple|tsamples|psamples|p-value|assessment`
run()
{
    number=${2%%:*}
    tuple=${2#"$number"}
    nice -n 19 "$program" "$1" "$3" 2> /dev/null |
        timeout "$seconds" nice -n 19 dieharder -g 200 -d "$number" ${tuple:+-n "${tuple#:}"} |
        grep -E 'PASSED|WEAK|FAILED' | tr -d ' '
}

if [ $# -gt 0 ]; then printf '%s\n' "$@"; else "$program"; fi > "$work/shapes"
printf '%-24s %6s %6s %6s %6s %8s\n' shape tests PASSED WEAK FAILED 'timed out'
while read -r shape; do
    : > "$work/lines"
    late=0
    for test in $tests; do
        run "$shape" "$test" 0 > "$work/one"
        test -s "$work/one" || late=$((late + 1))
        cat "$work/one" >> "$work/lines"
        if grep -q -e WEAK -e FAILED "$work/one"; then
            grep -e WEAK -e FAILED "$work/one" | sed "s/^/  $shape: /"
            run "$shape" "$test" 1000000 | sed "s/^/  $shape, other words: /"
        fi
    done
    set -- $(for kind in PASSED WEAK FAILED; do grep -c "$kind" "$work/lines"; done)
    printf '%-24s %6d %6d %6d %6d %8d\n' "$shape" $(($1 + $2 + $3)) "$1" "$2" "$3" "$late"
    cat "$work/lines" >> "$work/all"
done < "$work/shapes"
! grep -q FAILED "$work/all"
