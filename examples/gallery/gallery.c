/* The gallery of densities: one page, a card for each, drawn from its own points.
 *
 *     build/examples/gallery [output.html]
 *
 * What is on the page is listed in entries.h.
 */
#include "gallery.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { GALLERY_ROOMS = 32 };

typedef struct gallery {
    text cards, contents;
    int groups, entries, rooms;
    void *room[GALLERY_ROOMS];
} gallery;

static const char gallery_style[] =
    ":root{color-scheme:light dark;--ink:#20262b;--soft:#5d6770;--paper:#f7f5ef;--card:#fffefb;"
    "--rule:#ddd8cb;--grid:#eeebe2;--c1:#0a64a8;--c2:#cf4f06;--c3:#0c7d5a;--c4:#9c3f7c;"
    "--c5:#84730c}\n"
    "@media screen and (prefers-color-scheme:dark){:root{--ink:#e7e3d9;--soft:#a2abb3;"
    "--paper:#15191d;--card:#1b2025;--rule:#343c43;--grid:#272e34;--c1:#6cb4ec;--c2:#f58f4b;"
    "--c3:#4cc39b;--c4:#e18fc0;--c5:#d8c45c}}\n"
    "*{box-sizing:border-box}\n"
    "html{-webkit-text-size-adjust:100%}\n"
    "body{margin:0;background:var(--paper);color:var(--ink);font:17px/1.5 'Iowan Old Style',"
    "'Palatino Linotype',Palatino,P052,'Book Antiqua',Georgia,serif}\n"
    "main{max-width:1240px;margin:0 auto;padding:0 28px 72px}\n"
    "header{padding:68px 0 8px}\n"
    "h1{font-size:clamp(34px,6vw,52px);line-height:1.08;letter-spacing:-.015em;margin:0 0 18px;"
    "font-weight:600}\n"
    "h2{font-size:29px;line-height:1.2;letter-spacing:-.01em;margin:0 0 4px;font-weight:600}\n"
    "h3{font-size:19px;line-height:1.25;margin:0;font-weight:600}\n"
    "section{padding-top:24px;margin-top:52px;border-top:1px solid var(--rule)}\n"
    "p{margin:0;text-wrap:pretty}\n"
    ".kicker,nav,svg,.facts{font-family:system-ui,-apple-system,'Segoe UI',Roboto,"
    "'Helvetica Neue',Arial,sans-serif}\n"
    ".kicker{font-size:13px;letter-spacing:.09em;text-transform:uppercase;color:var(--soft);"
    "margin:0 0 14px}\n"
    ".lead{font-size:20px;max-width:41em}\n"
    ".says{font-style:italic;color:var(--soft);max-width:46em;margin-bottom:22px}\n"
    "nav{margin-top:24px;font-size:15px;line-height:2.1}\n"
    "nav a{color:inherit;text-decoration:none;border-bottom:2px solid;padding-bottom:1px;"
    "margin-right:26px;white-space:nowrap}\n"
    ".cards{display:grid;gap:20px;grid-template-columns:repeat(auto-fill,minmax(min(100%,270px),"
    "1fr))}\n"
    "article{display:grid;grid-row:span 5;grid-template-rows:subgrid;row-gap:0;background:"
    "var(--card);border:1px solid var(--rule);border-radius:8px;padding:16px 18px 14px;"
    "min-width:0}\n"
    "article .picture{display:flex;align-items:center;justify-content:center;margin:0 0 12px}\n"
    "article p{font-size:15.5px;line-height:1.42;margin-top:3px}\n"
    "code{display:block;font:11.8px/1.45 ui-monospace,SFMono-Regular,Menlo,Consolas,"
    "'DejaVu Sans Mono',monospace;margin-top:9px;overflow-wrap:anywhere}\n"
    ".facts{font-size:11.4px;letter-spacing:-.005em;white-space:nowrap;color:var(--soft);"
    "margin-top:7px}\n"
    "svg{display:block;width:100%;height:auto;font-size:12px;overflow:visible}\n"
    "svg text{fill:var(--soft)}\n"
    ".middle{text-anchor:middle}.end{text-anchor:end}\n"
    "svg .raise{font-size:9px}\n"
    ".frame{fill:none;stroke:var(--soft);stroke-width:1}\n"
    ".grid{fill:none;stroke:var(--grid);stroke-width:1}\n"
    ".line{fill:none;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}\n"
    ".dots{fill:none;stroke-linecap:round}\n"
    ".area{stroke:none;fill-opacity:.42}\n"
    ".net{fill:none;stroke:var(--soft);stroke-width:8;stroke-opacity:.6;stroke-linejoin:round}"
    ".net.far{stroke-opacity:.22}\n"
    ".hair{fill:none;stroke-width:1.1;stroke-linecap:round}.hair.far{stroke-opacity:.25}\n"
    ".ball{fill:var(--grid);fill-opacity:.55;stroke:var(--rule);stroke-width:1}\n"
    ".c1{stroke:var(--c1);color:var(--c1)}.c2{stroke:var(--c2);color:var(--c2)}"
    ".c3{stroke:var(--c3);color:var(--c3)}.c4{stroke:var(--c4);color:var(--c4)}"
    ".c5{stroke:var(--c5);color:var(--c5)}.exact{stroke:var(--ink)}\n"
    ".area.c1,.area.c2,.area.c3,.area.c4,.area.c5{fill:currentColor;stroke:none}\n"
    "footer{margin-top:60px;padding-top:18px;border-top:1px solid var(--rule);font-size:15px;"
    "color:var(--soft)}\n"
    "footer code{display:inline;font-size:13px}\n"
    "@media print{:root{--paper:#fff}body{font-size:10pt}main{max-width:none;padding:0}"
    ".cards{grid-template-columns:repeat(4,1fr);gap:8px}article{break-inside:avoid;padding:8px}"
    "h2,.says{break-after:avoid}}\n";

static const char *gallery_entry_name = "the page";

void gallery_check(buffon_status status, const char *what)
{
    if (status == BUFFON_OK)
        return;
    fprintf(stderr, "\ngallery: %s: ", gallery_entry_name);
    give_up(what, buffon_status_string(status));
}

static void gallery_group(gallery *page, const char *title, const char *says)
{
    if (page->groups++ > 0)
        text_put(&page->cards, "</div></section>\n");
    text_add(&page->cards, "<section id=\"g%d\"><h2>%s</h2>\n<p class=\"says\">%s</p>\n"
             "<div class=\"cards\">\n", page->groups, title, says);
    text_add(&page->contents, "<a class=\"c%d\" href=\"#g%d\">%s</a>\n", (page->groups - 1) % 5 + 1,
             page->groups, title);
}

/* The constructor's text as it stands in entries.h, fit for HTML. */
static void gallery_code(text *out, const char *code)
{
    for (; *code != '\0'; code++)
        if (*code == '<' || *code == '>' || *code == '&')
            text_put(out, *code == '<' ? "&lt;" : *code == '>' ? "&gt;" : "&amp;");
        else
            text_bytes(out, code, 1);
}

static void gallery_entry(gallery *page, const char *name, const char *caption, view v,
                          const char *code, buffon_density g)
{
    char class[] = "c1";
    text *out = &page->cards;
    class[1] = (char)('1' + (page->groups - 1) % 5);
    gallery_entry_name = name;
    gallery_check(buffon_density_check(&g), "the density");
    page->entries++;
    text_put(out, "<article><div class=\"picture\">");
    view_draw(out, &g, v, class);
    text_add(out, "</div><h3>%s</h3><p>%s</p><code>", name, caption);
    gallery_code(out, code);
    text_add(out, "</code><p class=\"facts\">%zu uniform%s &rarr; %zu coordinate%s%s%s</p>"
             "</article>\n", g.uniforms, g.uniforms == 1 ? "" : "s", g.dim, g.dim == 1 ? "" : "s",
             g.ops->pdf != NULL ? " &middot; pdf" : "",
             g.ops->invert != NULL ? " &middot; inverse" : "");
}

/* Memory for a table, until the page is done. */
static void *gallery_room(gallery *page, size_t bytes)
{
    if (page->rooms == GALLERY_ROOMS)
        give_up("gallery", "too many tables");
    return page->room[page->rooms++] = need_memory(bytes);
}

#define ROOM(name, bytes)           \
    const size_t name##_size = bytes; \
    void *const name = gallery_room(page, name##_size)
#define GROUP(title, says) gallery_group(page, title, says)
#define ENTRY(name, caption, view, ...) \
    gallery_entry(page, name, caption, view, #__VA_ARGS__, __VA_ARGS__)

static void gallery_fill(gallery *page)
{
#include "entries.h"
    text_put(&page->cards, "</div></section>\n");
    while (page->rooms > 0)
        free(page->room[--page->rooms]);
}

static void gallery_finish(const gallery *page, text *document)
{
    text_put(document, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"us-ascii\">\n"
             "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
             "<title>Densities of buffon</title>\n<style>\n");
    text_put(document, gallery_style);
    text_add(document, "</style></head>\n<body><main>\n<header><p class=\"kicker\">buffon %s</p>\n"
             "<h1>A gallery of densities</h1>\n<p class=\"lead\">Each of these %d pictures was "
             "drawn by the library from uniform points, scrambled Sobol&rsquo; points, that went "
             "through the map of the density and nothing else. Colour is where points fell; the "
             "dark line or dot is the density as the library states it. The line of C above the "
             "facts is the line that was compiled.</p>\n<nav>\n", buffon_version(), page->entries);
    text_bytes(document, page->contents.bytes, page->contents.length);
    text_put(document, "</nav></header>\n");
    text_bytes(document, page->cards.bytes, page->cards.length);
    text_put(document, "<footer>Written by <code>examples/gallery</code>. Every map uses the fixed "
             "number of uniforms that is stated, so any point set can drive it; &ldquo;inverse"
             "&rdquo; means that points can be taken back to their uniforms.</footer>\n"
             "</main></body></html>\n");
}

/* Makes the directories on the way to a file. */
static void gallery_make_way(const char *path)
{
    char *copy = need_memory(strlen(path) + 1);
    strcpy(copy, path);
    for (char *slash = strchr(copy + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (mkdir(copy, 0777) != 0 && errno != EEXIST)
            give_up(copy, strerror(errno));
        *slash = '/';
    }
    free(copy);
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "build/demo/gallery.html";
    gallery page = {0};
    text document = {0};
    if (argc > 2 || path[0] == '\0' || path[0] == '-') {
        fprintf(stderr, "usage: %s [output.html]\n", argv[0]);
        return 2;
    }
    gallery_make_way(path);
    gallery_fill(&page);
    gallery_finish(&page, &document);
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        give_up(path, strerror(errno));
    size_t written = fwrite(document.bytes, 1, document.length, file);
    if (fclose(file) != 0 || written != document.length)
        give_up(path, "could not be written");
    printf("wrote %s: %d densities\n", path, page.entries);
    text_free(&document);
    text_free(&page.contents);
    text_free(&page.cards);
    return 0;
}
