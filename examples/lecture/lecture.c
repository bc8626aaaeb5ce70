/* The whole lecture in one run: prints a table and writes a page.
 *
 *     lecture [output.html]      build/demo/lecture.html if not given
 */
#define _POSIX_C_SOURCE 200809L
#include "story.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- numbers ---- */

void story_check(buffon_status status, const char *what)
{
    if (status < 0)
        give_up(what, buffon_status_string(status));
}

void story_add(story *s, const char *problem, const char *estimator, const buffon_estimate *e,
               double exact)
{
    if (s->rows == STORY_ROWS)
        give_up(problem, "the table is full");
    s->row[s->rows++] = (story_row){problem, estimator, *e, exact, s->section};
}

int story_is_exact(const story_row *row)
{
    return row->estimate.std_error <= 1e-13 * fabs(row->exact) &&
           fabs(row->estimate.value - row->exact) <= 1e-12 * fabs(row->exact);
}

double story_z(const story_row *row)
{
    return (row->estimate.value - row->exact) / row->estimate.std_error;
}

int story_decimals(const story_row *row)
{
    if (story_is_exact(row))
        return 8;
    double places = ceil(-log10(row->estimate.std_error)) + 1;
    return (int)fmin(fmax(places, 1), 10);
}

static void print_row(const story_row *row)
{
    const buffon_estimate *e = &row->estimate;
    int decimals = story_decimals(row);
    char interval[64] = "-", z[16] = "-", error[16] = "rounding";
    if (!story_is_exact(row)) {
        snprintf(interval, sizeof interval, "[%.*f, %.*f]", decimals, e->lo, decimals, e->hi);
        snprintf(z, sizeof z, "%.1f", story_z(row));
        snprintf(error, sizeof error, "%.1e", e->std_error);
    }
    printf("%-28s %-20s %8llu %10.*f %8s %22s %10.*f %4s\n", row->problem, row->estimator,
           (unsigned long long)e->samples, decimals, e->value, error, interval, decimals,
           row->exact, z);
}

static void print_table(const story *s)
{
    double largest = 0;
    size_t noisy = 0, missed = 0;
    printf("%-28s %-20s %8s %10s %8s %22s %10s %4s\n", "problem", "estimator", "samples", "value",
           "std_err", "95 % interval", "exact", "z");
    for (int i = 0; i < 117; i++)
        putchar('-');
    putchar('\n');
    for (size_t i = 0; i < s->rows; i++) {
        const story_row *row = &s->row[i];
        print_row(row);
        if (story_is_exact(row))
            continue;
        noisy++;
        missed += !(row->estimate.lo <= row->exact && row->exact <= row->estimate.hi);
        largest = fmax(largest, fabs(story_z(row)));
    }
    printf("%zu estimates, %zu of them exact; of the other %zu, %zu intervals miss; largest |z| is "
           "%.1f\n", s->rows, s->rows - noisy, noisy, missed, largest);
}

/* ---- the bar ---- */

/* The bar never goes back, and is drawn when it says something new. */
static void draw_bar(story *s, double fraction)
{
    enum { WIDTH = 40 };
    int percent = (int)(100 * fraction), full = percent * WIDTH / 100;
    if (!s->terminal || percent <= s->shown)
        return;
    s->shown = percent;
    fputs("\r[", stderr);
    for (int i = 0; i < WIDTH; i++)
        fputc(i < full ? '#' : '.', stderr);
    fprintf(stderr, "] %3d %%  %-28s", percent, s->doing);
    fflush(stderr);
}

void story_progress(story *s, double fraction)
{
    double within = s->from + (s->to - s->from) * fraction;
    draw_bar(s, s->begin + (s->end - s->begin) * within);
}

void story_share(story *s, double from, double to)
{
    s->from = from;
    s->to = to;
    story_progress(s, 0);
}

/* What the library calls while it works. Non-zero would cancel the run. */
static int show_progress(const buffon_progress *progress, void *ctx)
{
    if (progress->total > 0)
        story_progress(ctx, (double)progress->done / (double)progress->total);
    return 0;
}

buffon_run story_run(story *s, uint64_t samples)
{
    return (buffon_run){.samples = samples,
                        .seed = 1777, /* the year of Buffon's needle */
                        .threads = 2,
                        .progress = s->terminal ? show_progress : NULL,
                        .progress_ctx = s};
}

/* ---- the whole ---- */

typedef struct chapter {
    const char *name;
    void (*tell)(story *s);
    double weight; /* of its run time */
} chapter;

static const chapter chapters[] = {
    {"integrals", tell_integrals, 5},
    {"densities and variance", tell_densities, 1},
    {"directions and light", tell_light, 1.5},
    {"inverse CDF and the disk", tell_disk, 2.5},
    {"errors and intervals", tell_errors, 4},
    {"quasi-Monte Carlo", tell_quasi, 1.5},
    {"the picture", tell_picture, 16},
};

/* Makes the directories on the way to a file. */
static void make_way(const char *path)
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

static void write_page(story *s, const char *path)
{
    text document = {0};
    story_finish(s, &document);
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        give_up(path, strerror(errno));
    size_t written = fwrite(document.bytes, 1, document.length, file);
    if (fclose(file) != 0 || written != document.length)
        give_up(path, "could not be written");
    text_free(&document);
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "build/demo/lecture.html";
    story *s = need_memory(sizeof *s);
    *s = (story){.terminal = isatty(STDERR_FILENO), .shown = -1};
    double whole = 0, done = 0;
    if (argc > 2 || path[0] == '\0' || path[0] == '-') {
        fprintf(stderr, "usage: %s [output.html]\n", argv[0]);
        free(s);
        return 2;
    }
    make_way(path);
    for (size_t i = 0; i < sizeof chapters / sizeof *chapters; i++)
        whole += chapters[i].weight;
    for (size_t i = 0; i < sizeof chapters / sizeof *chapters; i++) {
        s->doing = chapters[i].name;
        s->begin = done / whole;
        done += chapters[i].weight;
        s->end = done / whole;
        story_share(s, 0, 1);
        chapters[i].tell(s);
    }
    if (s->terminal)
        fprintf(stderr, "\r%76s\r", ""); /* wipes the bar */
    print_table(s);
    write_page(s, path);
    printf("wrote %s\n", path);
    text_free(&s->page);
    free(s);
    return 0;
}
