/* One run by several processes: each does a part, and the parts merge to the last bit of the whole.
 *
 * The ranks are children of fork that send their partial result through a pipe. With MPI the loop
 * is one call, since every rank's partial has the same size:
 *
 *     MPI_Gather(mine, (int)n, MPI_BYTE, all, (int)n, MPI_BYTE, 0, MPI_COMM_WORLD);
 */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <buffon/buffon.h>

enum { RANKS = 4 };
static const double lo = 0, hi = 1;

static double f(const double *x, void *ctx)
{
    (void)ctx;
    return sqrt(1 - x[0] * x[0]);
}

static buffon_status integrate(buffon_estimate *e, const buffon_run *run)
{
    return buffon_uniform(e, &(buffon_integrand){.scalar = f, .dim = 1}, &lo, &hi, run);
}

/* What rank r of RANKS does: its part of the run, as bytes into a file descriptor. */
static int rank_main(uint32_t r, int out)
{
    buffon_partial p = {0};
    buffon_estimate e; /* of this part alone */
    const buffon_status s = integrate(
        &e,
        &(buffon_run){.samples = 10000000, .seed = 7, .part = r, .parts = RANKS, .partial = &p});
    const size_t n = buffon_partial_size(&p);
    char *bytes = malloc(n);
    size_t sent = 0;
    if (s >= 0 && bytes != NULL && buffon_partial_save(bytes, n, &p) == BUFFON_OK) {
        ssize_t k = 1;
        for (; sent < n && k > 0; sent += k > 0 ? (size_t)k : 0)
            k = write(out, bytes + sent, n - sent);
    }
    free(bytes);
    buffon_partial_free(&p);
    return sent < n;
}

/* Adds what a rank sent to the total. */
static buffon_status receive(buffon_partial *total, int in)
{
    static char bytes[1 << 16];
    size_t n = 0;
    for (ssize_t k = 1; k > 0; n += k > 0 ? (size_t)k : 0)
        k = read(in, bytes + n, sizeof bytes - n);
    buffon_partial p = {0};
    buffon_status s = buffon_partial_load(&p, bytes, n);
    if (s == BUFFON_OK)
        s = buffon_partial_merge(total, &p);
    buffon_partial_free(&p);
    return s;
}

int main(void)
{
    buffon_partial total = {0};
    buffon_estimate merged, whole;
    buffon_status s = BUFFON_OK;
    for (uint32_t r = 0; r < RANKS && s == BUFFON_OK; r++) {
        int ends[2];
        if (pipe(ends) != 0)
            return 1;
        const pid_t child = fork();
        if (child < 0)
            return 1;
        if (child == 0) {
            close(ends[0]);
            _exit(rank_main(r, ends[1]));
        }
        close(ends[1]);
        s = receive(&total, ends[0]);
        close(ends[0]);
        waitpid(child, NULL, 0);
    }
    if (s == BUFFON_OK)
        s = buffon_partial_estimate(&merged, &total, 0.95);
    buffon_partial_free(&total);
    if (s == BUFFON_OK)
        s = integrate(&whole, &(buffon_run){.samples = 10000000, .seed = 7});
    if (s != BUFFON_OK) {
        fprintf(stderr, "%s\n", buffon_status_string(s));
        return 1;
    }
    printf("%d ranks merged  %.17g +- %.3g\n", RANKS, merged.value, merged.std_error);
    printf("one process     %.17g +- %.3g\n", whole.value, whole.std_error);
    return merged.value != whole.value || merged.std_error != whole.std_error;
}
