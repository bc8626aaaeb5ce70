/* The page: one HTML file that needs nothing else. No script; the figures are SVG in place, the
 * pictures are in it as data: addresses. Light or dark as the reader's system is set. */
#include "story.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char page_colours[] =
    ":root{color-scheme:light dark;--ink:#20262b;--soft:#5d6770;--paper:#fdfcf9;--card:#f4f1e9;"
    "--rule:#d9d3c5;--grid:#e9e5da;--c1:#0a64a8;--c2:#cf4f06;--c3:#0c7d5a;--c4:#9c3f7c;"
    "--c5:#84730c}\n"
    "@media screen and (prefers-color-scheme:dark){:root{--ink:#e7e3d9;--soft:#a2abb3;"
    "--paper:#15191d;--card:#1d2328;--rule:#3b444b;--grid:#2a3137;--c1:#6cb4ec;--c2:#f58f4b;"
    "--c3:#4cc39b;--c4:#e18fc0;--c5:#d8c45c}}\n";

static const char page_prose[] =
    "*{box-sizing:border-box}\n"
    "html{-webkit-text-size-adjust:100%}\n"
    "body{margin:0;background:var(--paper);color:var(--ink);font:18px/1.58 'Iowan Old Style',"
    "'Palatino Linotype',Palatino,P052,'Book Antiqua',Georgia,serif}\n"
    "main{max-width:948px;margin:0 auto;padding:0 24px 72px}\n"
    "header{padding:72px 0 20px}\n"
    "h1{font-size:clamp(34px,6vw,52px);line-height:1.08;letter-spacing:-.015em;margin:0 0 18px;"
    "font-weight:600;text-wrap:balance}\n"
    "h2{font-size:30px;line-height:1.2;letter-spacing:-.01em;margin:0 0 4px;font-weight:600}\n"
    "section{padding-top:26px;margin-top:58px;border-top:1px solid var(--rule)}\n"
    "p,.says{max-width:43em;margin:0 0 16px;text-wrap:pretty;hyphens:manual}\n"
    "a{color:var(--c1)}\n"
    ".kicker,.no,nav,table,figcaption,svg{font-family:system-ui,-apple-system,'Segoe UI',Roboto,"
    "'Helvetica Neue',Arial,sans-serif}\n"
    ".kicker{font-size:13px;letter-spacing:.09em;text-transform:uppercase;color:var(--soft);"
    "margin:0 0 14px}\n"
    ".no{font-size:14px;font-weight:600;color:var(--c2);margin:0 0 6px;display:block}\n"
    ".lead{font-size:21px;line-height:1.5;max-width:37em}\n"
    ".says{font-style:italic;color:var(--soft);margin-bottom:18px}\n"
    ".formula{margin:22px 0 24px;padding:2px 0 2px 22px;border-left:3px solid var(--c2);"
    "font-size:20px;line-height:1.9;overflow-x:auto}\n"
    ".formula p{margin:0;max-width:none}\n"
    "i,em{font-style:italic}\n"
    ".fr{display:inline-flex;flex-direction:column;vertical-align:middle;text-align:center;"
    "line-height:1.25;font-size:.92em;margin:0 .14em}\n"
    ".fr span:first-child{border-bottom:1px solid currentColor;padding:0 .2em}\n"
    ".sign{font-size:1.5em;line-height:1;vertical-align:-.18em;font-style:normal}\n"
    ".lim{display:inline-flex;flex-direction:column;vertical-align:middle;font-size:.64em;"
    "line-height:1.5;margin:0 .4em 0 -.1em}\n"
    ".over{margin:0 .3em 0 -.25em}\n"
    ".whole{margin-right:-.1em}\n"
    "sub,sup{line-height:0;font-size:.7em}\n"
    "nav ol{columns:2;column-gap:36px;margin:26px 0 0;padding:0 0 0 2em;font-size:15px;"
    "line-height:1.9}\n"
    "nav a{color:inherit;text-decoration:none;border-bottom:1px solid var(--rule)}\n"
    "code{font-size:.86em}\n"
    "pre,code{font-family:ui-monospace,SFMono-Regular,Menlo,Consolas,'DejaVu Sans Mono',"
    "monospace}\n"
    "pre{margin:22px 0;padding:16px 20px;background:var(--card);border-radius:6px;font-size:14px;"
    "line-height:1.55;overflow-x:auto;tab-size:4}\n"
    "pre b{font-weight:600;color:var(--c1)}\n"
    "pre i{font-style:normal;color:var(--soft)}\n";

static const char page_figures[] =
    "figure{margin:26px 0}\n"
    "figcaption{font-size:14.5px;line-height:1.5;color:var(--soft);margin-top:10px;"
    "max-width:56em}\n"
    "figcaption b{color:var(--ink);font-weight:600}\n"
    ".panels{display:grid;gap:14px 20px;align-items:end;grid-template-columns:1fr}\n"
    ".panels>div>p{font:600 14px/1.4 system-ui,-apple-system,'Segoe UI',Roboto,Arial,sans-serif;"
    "text-align:center;margin:0 0 2px}\n"
    ".two{grid-template-columns:repeat(auto-fit,minmax(min(100%,330px),1fr))}\n"
    ".three{grid-template-columns:repeat(auto-fit,minmax(min(100%,230px),1fr))}\n"
    ".four{grid-template-columns:repeat(4,1fr)}\n"
    ".one{overflow-x:auto}.one svg{min-width:560px}\n"
    "svg{display:block;width:100%;height:auto;font-size:12.5px;overflow:visible}\n"
    "svg text{fill:var(--ink)}\n"
    ".middle{text-anchor:middle}.end{text-anchor:end}\n"
    "svg .tick{fill:var(--soft);font-size:12px}\n"
    "svg .raise{font-size:9px}\n"
    "svg .label{fill:var(--ink);font-size:13px}\n"
    "svg .halo{paint-order:stroke;stroke:var(--paper);stroke-width:4px;stroke-linejoin:round}\n"
    "svg .bold{font-weight:600}\n"
    ".frame{fill:none;stroke:var(--soft);stroke-width:1}\n"
    ".grid{fill:none;stroke:var(--grid);stroke-width:1}\n"
    ".line{fill:none;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}\n"
    ".dots{fill:none;stroke-linecap:round}\n"
    ".area{stroke:none;fill-opacity:.22}.area.bar{fill-opacity:.8}\n"
    ".line.thin{stroke-width:1}\n"
    ".line.hair{stroke-width:.9;stroke-opacity:.55}\n"
    ".line.dash{stroke-dasharray:5 4}\n"
    ".c1{stroke:var(--c1)}.c2{stroke:var(--c2)}.c3{stroke:var(--c3)}.c4{stroke:var(--c4)}"
    ".c5{stroke:var(--c5)}.exact{stroke:var(--ink)}.pale{stroke:var(--soft)}\n"
    ".area.c1,.note.c1{fill:var(--c1);stroke:none}.area.c2,.note.c2{fill:var(--c2);stroke:none}"
    ".area.c3,.note.c3{fill:var(--c3);stroke:none}.area.c4,.note.c4{fill:var(--c4);stroke:none}"
    ".area.c5,.note.c5{fill:var(--c5);stroke:none}.area.pale,.note.pale{fill:var(--soft);"
    "stroke:none}\n"
    ".note.halo{stroke:var(--paper)}\n"
    ".dots.pale{stroke-opacity:.55}\n"
    ".dots.far{stroke-opacity:.26}\n"
    ".line.far{stroke-opacity:.3}\n"
    ".line.wire{stroke:var(--rule);stroke-width:1}.line.rim{stroke:var(--soft);stroke-width:1.2}\n"
    ".pictures{gap:18px 16px}\n"
    "img{display:block;width:100%;height:auto;border-radius:4px;background:#000}\n";

static const char page_tables[] =
    ".table{overflow-x:auto;margin:22px 0}\n"
    "table{border-collapse:collapse;font-size:14px;line-height:1.35;width:100%;"
    "font-variant-numeric:tabular-nums}\n"
    "th{text-align:left;font-weight:600;color:var(--soft);border-bottom:1px solid var(--soft)}\n"
    "th,td{padding:6px 12px 6px 0;white-space:nowrap;vertical-align:baseline}\n"
    "td:first-child{white-space:normal;min-width:11em}\n"
    "th:last-child,td:last-child{padding-right:0}\n"
    "td{border-bottom:1px solid var(--grid)}\n"
    "tr.part td{border-top:1px solid var(--rule)}\n"
    ".all table{font-size:12.8px}\n"
    ".all th,.all td{padding-right:10px}\n"
    ".num{text-align:right}\n"
    "footer{margin-top:64px;padding-top:18px;border-top:1px solid var(--rule);font-size:15px;"
    "color:var(--soft)}\n"
    "@media(max-width:640px){body{font-size:17px}nav ol{columns:1}header{padding-top:40px}"
    "h2{font-size:26px}.formula{font-size:18px;padding-left:14px}"
    ".four{grid-template-columns:1fr 1fr}}\n"
    "@media print{:root{--paper:#fff}body{font-size:10.5pt}.lead{font-size:13pt}"
    "table{font-size:8pt}.all table{font-size:7.4pt}td:first-child{min-width:0}"
    "main{max-width:none;padding:0}section{margin-top:28px}"
    "figure,pre,.formula,.table tr{break-inside:avoid}h2,.no,.says{break-after:avoid}"
    "pre{white-space:pre-wrap;border:1px solid var(--rule)}a{color:inherit}}\n";

/* C source: escaped, comments pale, the library's names set off. */
static void page_source(text *out, const char *code)
{
    while (*code != '\0') {
        size_t n = 1;
        if (strncmp(code, "/*", 2) == 0) {
            const char *end = strstr(code, "*/");
            n = end != NULL ? (size_t)(end + 2 - code) : strlen(code);
            text_put(out, "<i>");
            text_bytes(out, code, n);
            text_put(out, "</i>");
        } else if (isalpha((unsigned char)*code) || *code == '_') {
            while (isalnum((unsigned char)code[n]) || code[n] == '_')
                n++;
            int ours = strncmp(code, "buffon_", 7) == 0 || strncmp(code, "BUFFON_", 7) == 0;
            text_put(out, ours ? "<b>" : "");
            text_bytes(out, code, n);
            text_put(out, ours ? "</b>" : "");
        } else if (*code == '<' || *code == '>' || *code == '&') {
            text_put(out, *code == '<' ? "&lt;" : *code == '>' ? "&gt;" : "&amp;");
        } else {
            text_bytes(out, code, 1);
        }
        code += n;
    }
}

void story_section(story *s, const char *title, const char *statement)
{
    if (s->section > 0)
        text_put(&s->page, "</section>\n");
    if (s->section + 1 >= STORY_SECTIONS)
        give_up(title, "too many sections");
    s->title[++s->section] = title;
    text_add(&s->page, "<section id=\"s%d\">\n<span class=\"no\">%d</span><h2>%s</h2>\n",
             s->section, s->section, title);
    if (statement != NULL)
        text_add(&s->page, "<p class=\"says\">%s</p>\n", statement);
}

void story_prose(story *s, const char *html)
{
    text_add(&s->page, "<p>%s</p>\n", html);
}

void story_formula(story *s, const char *html)
{
    text_add(&s->page, "<div class=\"formula\"><p>%s</p></div>\n", html);
}

void story_code(story *s, const char *code)
{
    text_put(&s->page, "<pre><code>");
    page_source(&s->page, code);
    text_put(&s->page, "</code></pre>\n");
}

text *story_figure(story *s, const char *class)
{
    s->figure++;
    text_add(&s->page, "<figure><div class=\"panels %s\">\n", class);
    return &s->page;
}

void story_caption(story *s, const char *format, ...)
{
    char what[1024];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= sizeof what)
        give_up("page", "a caption is too long");
    text_add(&s->page, "</div><figcaption><b>Figure %d.</b> %s</figcaption></figure>\n", s->figure,
             what);
}

/* ---- tables ---- */

/* The table's names are for the terminal too, where there is no pi. */
static void page_name(text *out, const char *name)
{
    static const char *const fine[][2] = {
        {"pi", "&pi;"}, {"gamma", "&gamma;"}, {"^2", "&sup2;"}, {"^(x+y)", "<sup>x+y</sup>"},
        {"^(x1+...+x5)", "<sup>&Sigma;x</sup>"},
        {"'", "&rsquo;"}, {" x ", "&#8201;&times;&#8201;"}};
    text_put(out, "<td>");
    while (*name != '\0') {
        size_t n = 0;
        for (size_t i = 0; i < sizeof fine / sizeof *fine && n == 0; i++)
            if (strncmp(name, fine[i][0], strlen(fine[i][0])) == 0) {
                text_put(out, fine[i][1]);
                n = strlen(fine[i][0]);
            }
        if (n == 0)
            text_bytes(out, name, n = 1);
        name += n;
    }
    text_put(out, "</td>");
}

static void page_number(text *out, const char *class, int decimals, double v)
{
    text_add(out, "<td class=\"%s\">%s%.*f</td>", class, v < 0 ? "&#8722;" : "", decimals, fabs(v));
}

/* 1.2e-04 as 1.2 x 10^-4, for people. */
static void page_power(text *out, double v)
{
    char digits[32];
    snprintf(digits, sizeof digits, "%.1e", v);
    char *e = strchr(digits, 'e');
    if (e == NULL) {
        text_add(out, "<td class=\"num\">%s</td>", digits);
        return;
    }
    *e = '\0';
    int exponent = 0;
    sscanf(e + 1, "%d", &exponent);
    text_add(out, "<td class=\"num\">%s&#8201;&times;&#8201;10<sup>%s%d</sup></td>", digits,
             exponent < 0 ? "&#8722;" : "", exponent < 0 ? -exponent : exponent);
}

const char *story_count(char grouped[STORY_COUNT], uint64_t n)
{
    char digits[24];
    int length = snprintf(digits, sizeof digits, "%llu", (unsigned long long)n);
    size_t at = 0;
    for (int i = 0; i < length; i++)
        at += (size_t)snprintf(grouped + at, STORY_COUNT - at, "%s%c",
                               i > 0 && (length - i) % 3 == 0 ? "&#8239;" : "", digits[i]);
    return grouped;
}

static void page_rows(story *s, const char *class, int first_section)
{
    text *out = &s->page;
    char count[STORY_COUNT];
    text_add(out, "<div class=\"table %s\"><table>\n<tr><th>Problem</th><th>Estimator</th>"
             "<th class=\"num\">Samples</th><th class=\"num\">Value</th>"
             "<th class=\"num\">Std&#160;error</th><th class=\"num\">95&#8201;%% interval</th>"
             "<th class=\"num\">Exact</th><th class=\"num\">z</th></tr>\n", class);
    for (size_t i = 0; i < s->rows; i++) {
        const story_row *row = &s->row[i];
        const buffon_estimate *e = &row->estimate;
        int decimals = story_decimals(row);
        if (row->section < first_section)
            continue;
        text_add(out, "<tr%s>",
                 i > 0 && s->row[i - 1].section != row->section ? " class=\"part\"" : "");
        page_name(out, row->problem);
        page_name(out, row->estimator);
        text_add(out, "<td class=\"num\">%s</td>", story_count(count, e->samples));
        page_number(out, "num", decimals, e->value);
        if (story_is_exact(row))
            text_put(out, "<td class=\"num\">rounding</td><td class=\"num\">&#8211;</td>");
        else {
            page_power(out, e->std_error);
            text_add(out, "<td class=\"num\">%.*f &#8211; %.*f</td>", decimals, e->lo, decimals,
                     e->hi);
        }
        page_number(out, "num", decimals, row->exact);
        if (story_is_exact(row))
            text_put(out, "<td class=\"num\">&#8211;</td></tr>\n");
        else {
            page_number(out, "num", 1, story_z(row));
            text_put(out, "</tr>\n");
        }
    }
    text_put(out, "</table></div>\n");
}

void story_results(story *s)
{
    page_rows(s, "some", s->section);
}

void story_finish(story *s, text *document)
{
    text head = {0};
    story_section(s, "All the numbers", NULL);
    story_prose(s, "Every estimate on this page, as the program printed it. <i>z</i> is (value "
                "&minus; exact) / standard error: about one in twenty should lie beyond &plusmn;2 "
                "(&plusmn;2.4 with Sobol&rsquo; points, whose error comes from 8 means), and about "
                "one interval in twenty should miss.");
    page_rows(s, "all", 0);
    text_put(&s->page, "</section>\n");

    text_add(&head, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"us-ascii\">\n"
             "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
             "<title>Monte Carlo, from the needle to the picture</title>\n<style>\n");
    text_put(&head, page_colours);
    text_put(&head, page_prose);
    text_put(&head, page_figures);
    text_put(&head, page_tables);
    text_put(&head, "</style></head>\n<body><main>\n<header><p class=\"kicker\">A lecture that "
             "computes itself</p>\n<h1>Monte Carlo, from the needle to the picture</h1>\n"
             "<p class=\"lead\">Throw points at a problem whose mean is the answer, and average. "
             "This page walks through one lecture on that idea, from Buffon's needle to a picture "
             "with soft shadows. Every number and every dot on it was computed by one run of the "
             "program that wrote the page, with the C library <em>buffon</em>; the few lines of C "
             "that did it stand beside each figure.</p>\n<nav><ol>\n");
    for (int i = 1; i <= s->section; i++)
        text_add(&head, "<li><a href=\"#s%d\">%s</a></li>\n", i, s->title[i]);
    text_put(&head, "</ol></nav></header>\n");
    text_bytes(document, head.bytes, head.length);
    text_bytes(document, s->page.bytes, s->page.length);
    text_add(document, "<footer>Written by <code>examples/lecture</code> with buffon %s. The same "
             "seed gives the same page, to the last digit, on any number of threads.</footer>\n"
             "</main></body></html>\n", buffon_version());
    text_free(&head);
}
