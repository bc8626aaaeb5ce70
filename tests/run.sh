#!/bin/sh
# Runs programs and scripts that print TAP, several at once, and adds up their checks.
#
#     tests/run.sh [-j jobs] [-w 'command to run each under'] -o directory program...
#
# Each leaves directory/<name>.tap and .err. A program that crashes, runs for ten minutes, checks
# nothing, or prints no plan or another number of checks than planned counts as one more failure.
# The last line is `N passed, N failed`; skipped checks are named above it and counted in neither.
set -u

# run_one directory wrapper program
run_one()
{
    name=$(basename "$3" .sh)
    out=$1/$name
    case $3 in *.sh) command="sh $3" ;; *) command="$2 $3" ;; esac
    if command -v timeout > /dev/null; then command="timeout 600 $command"; fi
    began=$(date +%s)
    $command > "$out.tap" 2> "$out.err" < /dev/null
    code=$?
    seconds=$(($(date +%s) - began))
    awk -v name="$name" -v code=$code -v seconds=$seconds -v sum="$out.sum" '
        function fail(line) { failed++; detail = detail "    " line "\n"; more = 1 }
        /^ok.*# SKIP/ { skipped++; count++; more = 0; detail = detail "    " $0 "\n"; next }
        /^ok/     { passed++; count++; more = 0; next }
        /^not ok/ { count++; fail($0); next }
        /^1\.\./  { plan = substr($0, 4) + 0; planned = 1; next }
        /^#/ && more { detail = detail "    " $0 "\n" }
        END {
            if (code == 124) fail("it ran for ten minutes and was ended")
            else if (code > 128) fail("it was ended by signal " code - 128)
            else if (code != 0 && !failed) fail("it returned " code " with no failed check")
            if (!planned) fail("it printed no plan")
            else if (plan == 0) fail("it checked nothing")
            else if (plan != count) fail("it planned " plan " checks and printed " count + 0)
            printf "%-6s %-24s %5d checks %4d s\n%s", failed ? "FAILED" : "ok", name, count,
                   seconds, detail
            print passed + 0, failed + 0, skipped + 0 > sum
        }' "$out.tap" > "$out.report"
    if [ "$code" -ne 0 ]; then tail -n 20 "$out.err" | sed 's/^/    | /' >> "$out.report"; fi
    cat "$out.report"
}

if [ "${1:-}" = --one ]; then
    run_one "$2" "$3" "$4"
    exit 0
fi

jobs=2 wrapper='' out=.
while getopts j:w:o: option; do
    case $option in
        j) jobs=$OPTARG ;;
        w) wrapper=$OPTARG ;;
        o) out=$OPTARG ;;
        *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
mkdir -p "$out"
rm -f "$out"/*.sum
printf '%s\n' "$@" | xargs -P "$jobs" -I '{}' sh "$0" --one "$out" "$wrapper" '{}'
for program in "$@"; do
    sum=$out/$(basename "$program" .sh).sum
    if [ -s "$sum" ]; then cat "$sum"; else echo 0 1 0; fi
done | awk '{ passed += $1; failed += $2; skipped += $3 }
    END {
        if (skipped) print skipped " skipped"
        print passed + 0 " passed, " failed + 0 " failed"
        exit failed != 0
    }'
