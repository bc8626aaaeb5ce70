#!/bin/sh
# Every example runs, says something, and succeeds. The lecture is left to `make demo`.
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

# The gallery has a card for each of its entries, and no number in it is lost.
page=$build/examples.run/gallery.html
"$build/examples/gallery" "$page" > "$build/examples.run/gallery.out" 2>&1
test "$(grep -c '^ENTRY(' examples/gallery/entries.h)" = "$(grep -c '</svg>$' "$page")"
tap_ok $? "the gallery draws every entry"
tap_empty "$(sed -n 's/^ENTRY(\("[^"]*"\).*/\1/p' examples/gallery/entries.h | sort | uniq -d)" \
    "and each once"
tap_empty "$(grep -niE '[^a-z](nan|inf)[^a-z]' "$page" | cut -c 1-90)" "and all of each"
test "$(wc -c < "$page")" -lt 2000000
tap_ok $? "in less than 2 MB"
tap_done
