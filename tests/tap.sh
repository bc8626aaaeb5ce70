# TAP for the check scripts, which source this file and end with `tap_done`.
tap_count=0
tap_failures=0

# tap_ok <exit code> <what>
tap_ok()
{
    tap_count=$((tap_count + 1))
    if [ "$1" -eq 0 ]; then
        echo "ok $tap_count - $2"
    else
        tap_failures=$((tap_failures + 1))
        echo "not ok $tap_count - $2"
    fi
}

# tap_empty <text> <what>: passes if there is no text; else the text says what is wrong.
tap_empty()
{
    test -z "$1"
    tap_ok $? "$2"
    if [ -n "$1" ]; then printf '%s\n' "$1" | head -n 20 | sed 's/^/# /'; fi
}

# tap_run <what> <command...>: passes if the command does; else shows the end of what it said.
tap_run()
{
    tap_what=$1
    shift
    tap_output=$("$@" 2>&1)
    tap_code=$?
    tap_ok $tap_code "$tap_what"
    if [ $tap_code -ne 0 ]; then printf '%s\n' "$tap_output" | tail -n 20 | sed 's/^/# /'; fi
}

# tap_skip <what> <why>
tap_skip()
{
    tap_count=$((tap_count + 1))
    echo "ok $tap_count - $1 # SKIP $2"
}

tap_done()
{
    echo "1..$tap_count"
    test $tap_failures -eq 0
}

# The first C++ compiler there is; nothing if there is none.
tap_cxx()
{
    for tap_try in ${CXX:-} c++ g++ clang++; do
        if echo 'int main() { return 0; }' |
            $tap_try -std=c++17 -x c++ -fsyntax-only - > /dev/null 2>&1; then
            echo "$tap_try"
            return
        fi
    done
}
