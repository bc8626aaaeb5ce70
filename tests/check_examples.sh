#!/bin/sh
# Every example runs, says something, and succeeds. The lecture is `make demo`.
. tests/tap.sh
build=$(cd "${BUILD:-build}" && pwd)
mkdir -p "$build/examples.run"
for source in examples/*.c; do
    test -f "$source" || continue
    name=$(basename "$source" .c)
    (cd "$build/examples.run" && "$build/examples/$name" > "$name.out" 2> "$name.err" < /dev/null)
    code=$?
    test $code -eq 0 && test -s "$build/examples.run/$name.out"
    tap_ok $? "$name"
    if [ $code -ne 0 ]; then tail -n 5 "$build/examples.run/$name.err" | sed 's/^/# /'; fi
done
tap_done
