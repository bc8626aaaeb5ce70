# The reference as Markdown, from the comments of the public headers: `make docs`. Run over
# buffon.h, whose table says which headers there are and in which order.

# A line of a comment without its frame.
function plain(line) {
    sub(/^ \*/, "", line)
    sub(/^  ?/, "", line)
    sub(/ ?\*?\/$/, "", line)
    return line
}

# One header: what its first comment says, then each documented declaration under its name.
function header(name,    path, line, mode, text, declaration) {
    path = directory "/" name ".h"
    mode = "start"
    while ((getline line < path) > 0) {
        if (mode == "start") {
            sub(/^\/\* Layer [0-9]\. /, "", line)
            text = line
            mode = "intro"
        } else if (mode == "intro" && line ~ /^ \*/) {
            text = text "\n" substr(line, 4)
        } else if (mode == "intro") {
            sub(/[ \n]*\*?\/?$/, "", text)
            print "\n## " name ".h\n\n```text\n" text "\n```"
            mode = ""
        } else if (line ~ /^\/\*\* /) {
            mode = line ~ /\*\/$/ ? "declaration" : "comment"
            text = plain(substr(line, 5))
            declaration = ""
        } else if (mode == "comment") {
            text = text "\n" plain(line)
            if (line ~ /\*\/$/)
                mode = "declaration"
        } else if (mode == "declaration") {
            declaration = declaration line "\n"
            if (ends(declaration, line)) {
                show(declaration, text)
                mode = ""
            }
        }
    }
    close(path)
}

# A macro ends where no line continues it, a type with its brace, a function with the semicolon or
# where its body begins.
function ends(declaration, line) {
    if (declaration ~ /^#define/)
        return line !~ /\\$/
    if (declaration ~ /^typedef (struct|enum)/)
        return line ~ /^}/
    return line ~ /;$/ || line ~ /^{$/
}

function show(declaration, text,    name) {
    gsub(/BUFFON_(API|CHECK) /, "", declaration)
    sub(/\n{\n$/, ";\n", declaration)
    if (declaration ~ /^typedef|^#define/) {
        split(declaration, name, /[ (\n]+/)
        name[1] = declaration ~ /^#define/ ? name[2] : name[3]
    } else {
        match(declaration, /[a-z_0-9]+\(/)
        name[1] = substr(declaration, RSTART, RLENGTH - 1)
    }
    sub(/\n+$/, "", text)
    print "\n### " name[1] "\n\n```c\n" declaration "```\n\n```text\n" text "\n```"
}

FNR == 1 {
    directory = FILENAME
    sub(/\/[^\/]*$/, "", directory)
    print "# Reference\n\nGenerated from the headers, layer by layer."
}

/^ \*     layer [0-9]/ {
    for (i = 4; i <= NF; i++)
        header($i)
}
