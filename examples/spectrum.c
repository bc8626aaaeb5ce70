/* A spectrum that has no name: bremsstrahlung and two lines behind a filter, in units of nobody's
 * choice. Its pdf is a formula, unnormalised, with a pole at 0, an edge and two narrow peaks.
 *
 * buffon_inverse_table_new integrates it once and tabulates its quantile function. What comes out
 * is a density as any other: here the mean energy, and what of the dose a detector sees that is
 * blind below 1, over scrambled Sobol' points. Weights are f / g with the g of the table itself, so
 * the results have no bias even if the table is coarse: the last lines are from a tenth of the
 * cells. */
#include <math.h>
#include <stdio.h>

#include <buffon/buffon.h>

/* Energies in (0, infinity). The filter lets little through above its edge at 3. */
static double spectrum(double e, void *ctx)
{
    const double line1 = (e - 1.2) / 0.01, line2 = (e - 2.5) / 0.002;
    const double filter = e < 3 ? exp(-0.2 * e) : exp(-0.6 * e);
    (void)ctx;
    return filter *
           (exp(-e) / sqrt(e) + 3 * exp(-0.5 * line1 * line1) + 8 * exp(-0.5 * line2 * line2));
}

static double energy(const double *e, void *ctx)
{
    return e[0] * spectrum(e[0], ctx);
}

static double seen(const double *e, void *ctx)
{
    return e[0] > 1 ? spectrum(e[0], ctx) * (1 - exp(1 - e[0])) : 0;
}

static int integrate(double u_error)
{
    const double breaks[] = {1.2, 2.5, 3};
    const buffon_inverse_law law = {.pdf = spectrum,
                                    .lo = 0,
                                    .hi = INFINITY,
                                    .breaks = breaks,
                                    .breaks_count = 3,
                                    .u_error = u_error};
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const buffon_run run = {.samples = 1 << 16, .seed = 1, .points = &sobol};
    buffon_inverse_table *table;
    buffon_inverse_report r;
    buffon_estimate mean, dose;
    if (buffon_inverse_table_new(&table, &r, &law) < 0) {
        fprintf(stderr, "%s: %s at %g\n", buffon_status_string(r.status), r.why ? r.why : "",
                r.where);
        return 1;
    }
    const buffon_density g = buffon_inverse_table_density(table);
    const buffon_status s =
        buffon_importance(&mean, &(buffon_integrand){.scalar = energy, .dim = 1}, &g, &run);
    const buffon_status t =
        buffon_importance(&dose, &(buffon_integrand){.scalar = seen, .dim = 1}, &g, &run);
    buffon_inverse_table_free(table);
    if (s < 0 || t < 0) {
        fprintf(stderr, "%s\n", buffon_status_string(s < 0 ? s : t));
        return 1;
    }
    printf("%zu cells, %zu bytes, u within %.1g\n", r.cells, r.bytes, r.u_error);
    printf("  spectrum, whole  %.10f +- %.0e\n", r.total, r.total_error);
    printf("  mean energy      %.7f +- %.0e\n", mean.value / r.total, mean.std_error / r.total);
    printf("  seen             %.7f +- %.0e\n", dose.value / r.total, dose.std_error / r.total);
    return 0;
}

int main(void)
{
    return integrate(1e-12) || integrate(1e-4);
}
