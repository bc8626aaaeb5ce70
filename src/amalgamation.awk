# The library as one source and one header, for programs that would rather not build a library:
# `make amalgamation`. After the licence come the files of the command line, each with what it
# includes in its place: src/*.c for the source, include/buffon/buffon.h for the header.
#
# Lines between `#ifndef X` and its `#endif` are written once if `#define X` comes first among them,
# whether they are a whole header or part of one; other private headers are written wherever they
# are included. The public ones are buffon.h to a source. KERNELS, which says what levels.h is to
# include, is understood here: there is no such file when the compiler comes by.

BEGIN {
    print "/* buffon " version ", all of it in buffon.c and buffon.h: `make amalgamation`. */"
    licence("LICENSE")
    if (ARGV[1] ~ /\.h$/)
        print "\n#ifndef BUFFON_BUFFON_H\n#define BUFFON_BUFFON_H"
    else
        warnings()
    for (a = 1; a < ARGC; a++)
        file(ARGV[a])
    if (ARGV[1] ~ /\.h$/)
        print "\n#endif"
}

# A function that a header defines and nobody uses is no mistake to clang, but one of a source is.
function warnings() {
    print "\n#if defined(__clang__)"
    print "#pragma clang diagnostic ignored \"-Wunused-function\""
    print "#endif"
}

function licence(path,    lines, n, i) {
    n = read(path, lines)
    print "\n/*"
    for (i = 1; i <= n; i++)
        print (lines[i] == "" ? " *" : " * " lines[i])
    print " */"
}

# One file.
function file(path,    lines, n, i, words, gone) {
    n = read(path, lines)
    for (i = 1; i <= n; i++) {
        split(lines[i], words, " ")
        if (i in gone) {
            continue
        } else if (words[1] == "#include") {
            include(path, words[2])
        } else if (words[1] == "#ifndef" && lines[i + 1] == "#define " words[2]) {
            gone[i + 1] = gone[end_of(lines, i)] = 1
            if (words[2] in guards)
                i = end_of(lines, i)
            guards[words[2]] = 1
        } else if (words[1] == "#ifdef" && words[2] == "KERNELS") {
            gone[end_of(lines, i)] = 1
            if (kernels == "")
                i = end_of(lines, i)
        } else if ((words[1] == "#define" || words[1] == "#undef") && words[2] == "KERNELS") {
            kernels = words[3]
        } else {
            put(path, lines[i])
        }
    }
}

function include(path, name,    directory) {
    directory = path
    sub(/[^\/]*$/, "", directory)
    if (name == "KERNELS")
        name = kernels
    if (name ~ /^.buffon\//)
        put_once(path, "#include \"buffon.h\"")
    else if (name ~ /^</)
        put_once(path, "#include " name)
    else
        file(directory substr(name, 2, length(name) - 2))
}

# A line, after the name of its file where that is another one. Blank lines do not pile up.
function put(path, line) {
    if (line == "") {
        blank = 1
        return
    }
    if (path != current)
        print "\n/* ---- " path " ---- */\n"
    else if (blank)
        print ""
    print line
    blank = 0
    current = path
    if (line ~ /^#if/)
        depth++
    else if (line ~ /^#endif/)
        depth--
}

# Once for all, unless it is under a condition.
function put_once(path, line) {
    if (!(line in written))
        put(path, line)
    if (depth == 0)
        written[line] = 1
}

function read(path, lines,    n) {
    n = 0
    while ((getline lines[n + 1] < path) > 0)
        n++
    close(path)
    if (n == 0)
        fail(path " is not there")
    return n
}

# The number of the #endif that belongs to the #if, #ifdef or #ifndef in line i.
function end_of(lines, i,    open) {
    open = 0
    for (; i in lines; i++) {
        if (lines[i] ~ /^#if/)
            open++
        else if (lines[i] ~ /^#endif/ && --open == 0)
            return i
    }
    fail("an #if without its #endif")
}

function fail(what) {
    print "amalgamation: " what | "cat 1>&2"
    exit 1
}
