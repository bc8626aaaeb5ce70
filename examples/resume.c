/* Saves a run while it goes, and goes on after a crash from what was saved, with the same bits.
 *
 * A partial result is written from the progress callback, to a new file that then takes the old
 * one's place, so a crash in the middle of writing loses nothing. Here the "crash" is a cancelled
 * run. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <buffon/buffon.h>

static double f(const double *x, void *ctx)
{
    (void)ctx;
    return sqrt(1 - x[0] * x[0]);
}

typedef struct checkpoint {
    const char *path, *fresh; /* the file, and where the next one is written */
    int calls_left;           /* cancel after so many */
} checkpoint;

static int write_file(const char *path, const void *bytes, size_t n)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        return -1;
    const int short_write = fwrite(bytes, 1, n, file) != n;
    return fclose(file) != 0 || short_write ? -1 : 0;
}

static int keep(const buffon_progress *p, void *ctx)
{
    checkpoint *c = ctx;
    const size_t n = buffon_partial_size(p->partial);
    void *bytes = malloc(n);
    int bad = bytes == NULL || buffon_partial_save(bytes, n, p->partial) < 0 ||
              write_file(c->fresh, bytes, n) != 0 || rename(c->fresh, c->path) != 0;
    free(bytes);
    if (bad)
        fprintf(stderr, "cannot write %s\n", c->path);
    return bad || c->calls_left-- == 0;
}

/* Loads what was saved; an absent file is an empty start. */
static int load(buffon_partial *p, const char *path)
{
    static unsigned char bytes[1 << 16];
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return 0;
    const size_t n = fread(bytes, 1, sizeof bytes, file);
    const buffon_status s = buffon_partial_load(p, bytes, n);
    fclose(file);
    if (s < 0)
        fprintf(stderr, "%s: %s\n", path, buffon_status_string(s));
    return s < 0;
}

/* One life of the program: from the checkpoint on, for at most `calls` reports. */
static int live(const char *name, checkpoint *c, int calls)
{
    const double lo = 0, hi = 1;
    buffon_partial p = {0};
    buffon_estimate e;
    c->calls_left = calls;
    if (load(&p, c->path) != 0)
        return 1;
    const buffon_status s = buffon_uniform(
        &e, &(buffon_integrand){.scalar = f, .dim = 1}, &lo, &hi,
        &(buffon_run){
            .samples = 1u << 25, .seed = 7, .partial = &p, .progress = keep, .progress_ctx = c});
    buffon_partial_free(&p);
    if (s < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    printf("%-10s %10llu samples  %.15f +- %.1e  %s\n", name, (unsigned long long)e.samples,
           e.value, e.std_error, buffon_status_string(s));
    return 0;
}

int main(void)
{
    checkpoint c = {"buffon_resume.ckpt", "buffon_resume.new", 0};
    int bad = 0;
    remove(c.path);
    bad |= live("crash", &c, 0);
    bad |= live("crash", &c, 0);
    bad |= live("resumed", &c, -1);
    remove(c.path);
    bad |= live("at once", &c, -1);
    remove(c.path);
    return bad;
}
