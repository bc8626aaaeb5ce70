# For the scripts that compare builds; sourced after tests/tap.sh.
same_bits_reference=tests/data/bits.txt
same_bits_levels='scalar 128 avx2 avx512'

# same_bits <name> <program> <directory> [what runs it]: what tests/bits.c prints, with the
# instructions that the library chooses and limited to each level, is what it printed on the machine
# where tests/data/bits.txt was frozen. Where there is no such file, the first one is the reference
# of the others. What was printed stays in the directory.
same_bits()
{
    for same_level in '' $same_bits_levels; do
        same_what="$1: the same bits${same_level:+, $same_level}"
        same_out=$3/$1${same_level:+-$same_level}.txt
        ${4:-} "$2" $same_level > "$same_out" 2> "$same_out.err"
        same_code=$?
        if [ -n "$same_level" ] && [ $same_code -eq 77 ]; then
            tap_skip "$same_what" "the machine or the build does not have it"
        elif [ $same_code -ne 0 ]; then
            tap_ok 1 "$same_what: exit code $same_code"
            tail -n 5 "$same_out.err" | sed 's/^/# /'
        elif [ -f "$same_bits_reference" ]; then
            tap_run "$same_what" diff "$same_bits_reference" "$same_out"
        else
            test -s "$same_out"
            tap_ok $? "$same_what: the reference of the others"
            same_bits_reference=$same_out
        fi
    done
}

# one_file_make <directory>: the library as one source, and a place where programs find its header
# by the name that the installed one has.
one_file_make()
{
    tap_run "make amalgamation" \
        "${MAKE:-make}" --no-print-directory -j1 amalgamation BUILD="$1"
    mkdir -p "$1/include/buffon"
    cp "$1/amalgamation/buffon.h" "$1/include/buffon"
    one_file=$1
}

# one_file_build <name> <compiler and flags>: compiles it with no flag that matters, so the pragmas
# of src/guard.h must do, and links tests/bits.c, which computes too and is given the flag. It takes
# long and uses one processor, so it is made to run in the background; one_file_bits says what came
# of it.
one_file_build()
{
    rm -rf "${one_file:?}/$1"
    mkdir -p "$one_file/$1"
    {
        $2 -O2 -Wall -Wextra -Werror -c "$one_file/amalgamation/buffon.c" \
            -o "$one_file/$1/buffon.o" &&
            $2 -O2 -std=c11 -ffp-contract=off -I"$one_file/include" tests/bits.c \
                "$one_file/$1/buffon.o" -o "$one_file/$1/bits" -lm -pthread
    } > "$one_file/$1/log" 2>&1
}

# one_file_bits <name> [what runs it]
one_file_bits()
{
    tap_run "$1, one file: builds" sh -c "cat '$one_file/$1/log'; test -x '$one_file/$1/bits'"
    same_bits "$1, one file" "$one_file/$1/bits" "$one_file/$1" "${2:-}"
}
