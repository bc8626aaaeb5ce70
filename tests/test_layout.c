/* The binary interface: sizes of all public structs, and where their fields are. A program that
 * was compiled against one build must run with another of the same soname. Whoever changes a number
 * here raises BUFFON_ABI too and says so in docs/changelog.md. The table holds where pointers and
 * size_t have 64 bits and 64-bit words are aligned to 8, whichever end comes first.
 */
#include <buffon/buffon.h>

#include "tap.h"

typedef struct layout_row {
    const char *type, *field; /* no field: the struct itself */
    size_t at, size;          /* as they are */
    size_t want_at, want_size;
} layout_row;

#define STRUCT(type, size) {#type, NULL, 0, sizeof(type), 0, size}
#define FIELD(type, field, at, size) \
    {#type, #field, offsetof(type, field), sizeof(((type *)0)->field), at, size}

/* In the order of declaration. */
static const layout_row rows[] = {
    STRUCT(buffon_integrand, 72),
    FIELD(buffon_integrand, scalar, 0, 8),
    FIELD(buffon_integrand, batch, 8, 8),
    FIELD(buffon_integrand, dim, 16, 8),
    FIELD(buffon_integrand, components, 24, 8),
    FIELD(buffon_integrand, ctx, 32, 8),
    FIELD(buffon_integrand, reserved, 40, 32),
    STRUCT(buffon_points_block, 56),
    FIELD(buffon_points_block, key, 0, 24),
    FIELD(buffon_points_block, first, 24, 8),
    FIELD(buffon_points_block, n, 32, 8),
    FIELD(buffon_points_block, dim, 40, 8),
    FIELD(buffon_points_block, table, 48, 8),
    STRUCT(buffon_points, 136),
    FIELD(buffon_points, fill, 0, 8),
    FIELD(buffon_points, table_size, 8, 8),
    FIELD(buffon_points, prepare, 16, 8),
    FIELD(buffon_points, round, 24, 8),
    FIELD(buffon_points, design, 32, 4),
    FIELD(buffon_points, replicates, 36, 4),
    FIELD(buffon_points, limit, 40, 8),
    FIELD(buffon_points, name, 48, 8),
    FIELD(buffon_points, param, 56, 32),
    FIELD(buffon_points, data, 88, 8),
    FIELD(buffon_points, ctx, 96, 8),
    FIELD(buffon_points, doubling, 104, 8),
    FIELD(buffon_points, reserved, 112, 24),
    STRUCT(buffon_density_ops, 80),
    FIELD(buffon_density_ops, sample, 0, 8),
    FIELD(buffon_density_ops, pdf, 8, 8),
    FIELD(buffon_density_ops, log_pdf, 16, 8),
    FIELD(buffon_density_ops, invert, 24, 8),
    FIELD(buffon_density_ops, identity, 32, 8),
    FIELD(buffon_density_ops, name, 40, 8),
    FIELD(buffon_density_ops, reserved, 48, 32),
    STRUCT(buffon_density, 216),
    FIELD(buffon_density, uniforms, 0, 8),
    FIELD(buffon_density, dim, 8, 8),
    FIELD(buffon_density, status, 16, 4),
    FIELD(buffon_density, ops, 24, 8),
    FIELD(buffon_density, param, 32, 128),
    FIELD(buffon_density, data, 160, 16),
    FIELD(buffon_density, ctx, 176, 8),
    FIELD(buffon_density, reserved, 184, 32),
    STRUCT(buffon_inversion, 104),
    FIELD(buffon_inversion, quantile, 0, 8),
    FIELD(buffon_inversion, cdf, 8, 8),
    FIELD(buffon_inversion, pdf, 16, 8),
    FIELD(buffon_inversion, ctx, 24, 8),
    FIELD(buffon_inversion, lo, 32, 8),
    FIELD(buffon_inversion, hi, 40, 8),
    FIELD(buffon_inversion, x, 48, 8),
    FIELD(buffon_inversion, F, 56, 8),
    FIELD(buffon_inversion, count, 64, 8),
    FIELD(buffon_inversion, reserved, 72, 32),
    STRUCT(buffon_stats, 1408),
    FIELD(buffon_stats, count, 0, 8),
    FIELD(buffon_stats, nonfinite, 8, 8),
    FIELD(buffon_stats, min, 16, 8),
    FIELD(buffon_stats, max, 24, 8),
    FIELD(buffon_stats, sum, 32, 288),
    FIELD(buffon_stats, squares, 320, 576),
    FIELD(buffon_stats, top, 896, 512),
    STRUCT(buffon_summary, 80),
    FIELD(buffon_summary, count, 0, 8),
    FIELD(buffon_summary, nonfinite, 8, 8),
    FIELD(buffon_summary, mean, 16, 8),
    FIELD(buffon_summary, variance, 24, 8),
    FIELD(buffon_summary, std_error, 32, 8),
    FIELD(buffon_summary, min, 40, 8),
    FIELD(buffon_summary, max, 48, 8),
    FIELD(buffon_summary, ess, 56, 8),
    FIELD(buffon_summary, max_share, 64, 8),
    FIELD(buffon_summary, tail_index, 72, 8),
    STRUCT(buffon_estimate, 208),
    FIELD(buffon_estimate, value, 0, 8),
    FIELD(buffon_estimate, std_error, 8, 8),
    FIELD(buffon_estimate, variance, 16, 8),
    FIELD(buffon_estimate, lo, 24, 8),
    FIELD(buffon_estimate, hi, 32, 8),
    FIELD(buffon_estimate, confidence, 40, 8),
    FIELD(buffon_estimate, samples, 48, 8),
    FIELD(buffon_estimate, nonfinite, 56, 8),
    FIELD(buffon_estimate, bad_index, 64, 8),
    FIELD(buffon_estimate, bad_stratum, 72, 8),
    FIELD(buffon_estimate, status, 80, 4),
    FIELD(buffon_estimate, doubts, 84, 4),
    FIELD(buffon_estimate, interval, 88, 4),
    FIELD(buffon_estimate, looks, 92, 4),
    FIELD(buffon_estimate, min, 96, 8),
    FIELD(buffon_estimate, max, 104, 8),
    FIELD(buffon_estimate, max_share, 112, 8),
    FIELD(buffon_estimate, tail_index, 120, 8),
    FIELD(buffon_estimate, ess, 128, 8),
    FIELD(buffon_estimate, acceptance, 136, 8),
    FIELD(buffon_estimate, reserved, 144, 64),
    STRUCT(buffon_partial, 264),
    FIELD(buffon_partial, private_, 0, 256),
    FIELD(buffon_partial, more, 256, 8),
    STRUCT(buffon_rng_key, 24),
    FIELD(buffon_rng_key, seed, 0, 8),
    FIELD(buffon_rng_key, stream, 8, 8),
    FIELD(buffon_rng_key, purpose, 16, 1),
    FIELD(buffon_rng_key, replicate, 17, 1),
    FIELD(buffon_rng_key, stratum, 18, 2),
    STRUCT(buffon_rng, 2592),
    FIELD(buffon_rng, seed, 0, 8),
    FIELD(buffon_rng, stream, 8, 8),
    FIELD(buffon_rng, next, 16, 8),
    FIELD(buffon_rng, state, 24, 512),
    FIELD(buffon_rng, buffer, 536, 2048),
    FIELD(buffon_rng, at, 2584, 4),
    FIELD(buffon_rng, reserved, 2588, 4),
    STRUCT(buffon_progress, 40),
    FIELD(buffon_progress, done, 0, 8),
    FIELD(buffon_progress, total, 8, 8),
    FIELD(buffon_progress, estimate, 16, 8),
    FIELD(buffon_progress, components, 24, 8),
    FIELD(buffon_progress, partial, 32, 8),
    STRUCT(buffon_run, 200),
    FIELD(buffon_run, samples, 0, 8),
    FIELD(buffon_run, seed, 8, 8),
    FIELD(buffon_run, stream, 16, 8),
    FIELD(buffon_run, threads, 24, 4),
    FIELD(buffon_run, block, 28, 4),
    FIELD(buffon_run, abs_tol, 32, 8),
    FIELD(buffon_run, rel_tol, 40, 8),
    FIELD(buffon_run, confidence, 48, 8),
    FIELD(buffon_run, points, 56, 8),
    FIELD(buffon_run, part, 64, 4),
    FIELD(buffon_run, parts, 68, 4),
    FIELD(buffon_run, partial, 72, 8),
    FIELD(buffon_run, id, 80, 8),
    FIELD(buffon_run, on_nonfinite, 88, 4),
    FIELD(buffon_run, constant, 92, 4),
    FIELD(buffon_run, covariance, 96, 4),
    FIELD(buffon_run, reserved_int, 100, 4),
    FIELD(buffon_run, progress, 104, 8),
    FIELD(buffon_run, progress_ctx, 112, 8),
    FIELD(buffon_run, executor, 120, 8),
    FIELD(buffon_run, executor_ctx, 128, 8),
    FIELD(buffon_run, reserved, 136, 64),
    STRUCT(buffon_rejection_report, 32),
    FIELD(buffon_rejection_report, accepted, 0, 8),
    FIELD(buffon_rejection_report, tries, 8, 8),
    FIELD(buffon_rejection_report, acceptance, 16, 8),
    FIELD(buffon_rejection_report, worst, 24, 8),
    STRUCT(buffon_stratum, 48),
    FIELD(buffon_stratum, density, 0, 8),
    FIELD(buffon_stratum, f, 8, 8),
    FIELD(buffon_stratum, weight, 16, 8),
    FIELD(buffon_stratum, share, 24, 8),
    FIELD(buffon_stratum, reserved, 32, 16),
    STRUCT(buffon_strata, 56),
    FIELD(buffon_strata, stratum, 0, 8),
    FIELD(buffon_strata, count, 8, 8),
    FIELD(buffon_strata, allocation, 16, 4),
    FIELD(buffon_strata, pilot, 20, 4),
    FIELD(buffon_strata, reserved, 24, 32),
};

enum { ROWS = sizeof rows / sizeof rows[0] };

static int same(const layout_row *row)
{
    return row->at == row->want_at && row->size == row->want_size;
}

/* The fields of a struct follow each other with nothing between them but what alignment asks for,
 * so none is missing from the table. */
static int complete(int i)
{
    size_t at = 0;
    const size_t size = rows[i].want_size;
    for (i++; i < ROWS && rows[i].field != NULL; i++) {
        if (rows[i].want_at < at || rows[i].want_at > at + 4)
            return 0;
        at = rows[i].want_at + rows[i].want_size;
    }
    return at == size || at + 4 == size;
}

static void test_structs(void)
{
    for (int i = 0; i < ROWS;) {
        const int first = i;
        int good = same(&rows[i]);
        for (i++; i < ROWS && rows[i].field != NULL; i++)
            good &= same(&rows[i]);
        if (!tap_ok(good, "the layout of %s is that of ABI 0", rows[first].type)) {
            for (int j = first; j < i; j++) {
                if (!same(&rows[j]))
                    tap_note("%s.%s: at %zu, %zu bytes; ABI 0: at %zu, %zu", rows[j].type,
                             rows[j].field ? rows[j].field : "", rows[j].at, rows[j].size,
                             rows[j].want_at, rows[j].want_size);
            }
        }
        tap_ok(complete(first), "%s: no field is missing here", rows[first].type);
    }
}

static void test_enums(void)
{
    tap_ok(sizeof(buffon_status) == 4 && sizeof(buffon_purpose) == 4 &&
           sizeof(buffon_design) == 4 && sizeof(buffon_interval_kind) == 4 &&
           sizeof(buffon_nonfinite) == 4 && sizeof(buffon_allocation) == 4, "enums have 4 bytes");
    tap_ok(BUFFON_ABI == 0, "the number of the binary interface is 0");
}

int main(void)
{
    test_enums();
    if (sizeof(void *) == 8 && sizeof(size_t) == 8)
        test_structs();
    else
        tap_ok(1, "layout of structs # SKIP the table is for 64 bits");
    return tap_done();
}
