/* Each density of the library: verified, with the same bits from every set of vector instructions
 * and however a batch is cut, and with defined outputs where it is misused. */
#include <buffon/buffon.h>

#include "family.h"
#include "tap.h"

enum { MANY = 1003, WIDE = 16 };

static double u[WIDE * MANY], x[WIDE * MANY], pdf[MANY], back[WIDE * MANY];

static void report_worst(const buffon_verify_report *r)
{
    for (size_t k = 0; k < BUFFON_VERIFY_CHECKS; k++)
        if (r->item[k].failed || !r->item[k].looked)
            tap_note("%s%s: %.3g, p = %.3g", r->item[k].looked ? "" : "not looked at: ",
                     buffon_verify_string((buffon_verify_check)k), r->item[k].worst, r->item[k].p);
    if (r->status < 0)
        tap_note("at u = %.17g %.17g, x = %.17g %.17g %.17g", r->u[0], r->u[1], r->x[0], r->x[1],
                 r->x[2]);
}

static void test_verified(const family_case *one)
{
    buffon_verify_report r;
    const buffon_status status = buffon_verify_density(&r, &one->g, &one->how);
    const buffon_status wanted = one->unseen ? BUFFON_W_UNSEEN : BUFFON_OK;
    if (!tap_ok(status == wanted, "%s: is what it says", one->name)) {
        tap_note("%s; %s", buffon_status_string(status), buffon_verify_string(r.check));
        report_worst(&r);
    }
}

static uint64_t mix(uint64_t hash, const double *y, size_t n)
{
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ (y[i] != y[i] ? 1 : tap_bits(y[i]))) * UINT64_C(0x9e3779b97f4a7c15) >> 1 ^
               hash << 7;
    return hash;
}

/* Everything that a density computes of `cut` points at a time, as one number. */
static uint64_t digest(const buffon_density *g, size_t cut)
{
    static double part[3][WIDE * MANY], one[MANY], log_pdf[MANY];
    uint64_t hash = 1;
    memset(back, 0, sizeof back);
    for (size_t from = 0; from < MANY; from += cut) {
        const size_t n = MANY - from < cut ? MANY - from : cut;
        for (size_t j = 0; j < g->uniforms; j++)
            memcpy(part[0] + j * n, u + j * MANY + from, n * sizeof *u);
        if (buffon_density_sample(part[1], one, part[0], n, g) < 0)
            return 0;
        for (size_t j = 0; j < g->dim; j++)
            memcpy(x + j * MANY + from, part[1] + j * n, n * sizeof *x);
        memcpy(pdf + from, one, n * sizeof *pdf);
        if (buffon_density_pdf(one, part[1], n, g) == BUFFON_OK)
            memcpy(back + from, one, n * sizeof *back);
        if (buffon_density_log_pdf(one, part[1], n, g) == BUFFON_OK)
            memcpy(log_pdf + from, one, n * sizeof *one);
        if (buffon_density_invert(part[2], part[1], n, g) == BUFFON_OK)
            for (size_t j = 0; j < g->uniforms && j + 1 < WIDE; j++)
                memcpy(back + (j + 1) * MANY + from, part[2] + j * n, n * sizeof *back);
    }
    hash = mix(hash, x, g->dim * MANY);
    hash = mix(hash, pdf, MANY);
    hash = mix(hash, log_pdf, MANY);
    return mix(hash, back, WIDE * MANY);
}

static void test_bits(const family_case *one)
{
    buffon_rng rng = buffon_rng_make(5, 77);
    const buffon_level best = buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    if (one->g.dim > WIDE || one->g.uniforms > WIDE)
        return;
    buffon_rng_fill(u, one->g.uniforms * MANY, &rng);
    for (size_t j = 0; j < one->g.uniforms; j++) {
        u[j * MANY] = 0x1p-53;
        u[j * MANY + 1] = 1 - 0x1p-53;
    }
    const uint64_t whole = digest(&one->g, MANY);
    int same = whole != 0;
    same &= digest(&one->g, 1) == whole;
    same &= digest(&one->g, 37) == whole;
    for (int level = 0; level <= (int)best; level++) {
        (void)buffon_cpu_limit((buffon_level)level);
        same &= digest(&one->g, MANY) == whole;
    }
    (void)buffon_cpu_limit(BUFFON_LEVEL_AVX512);
    tap_ok(same, "%s: the same bits at every level, one by one and in batches", one->name);
}

/* NaN is in no support; where there is a pdf at all it is 0 there. */
static void test_nowhere(const family_case *one)
{
    static double nowhere[64], value[1];
    for (size_t j = 0; j < one->g.dim && j < 64; j++)
        nowhere[j] = NAN;
    if (one->g.dim > 64 || buffon_density_pdf(value, nowhere, 1, &one->g) == BUFFON_E_UNSUPPORTED)
        return;
    tap_ok(value[0] == 0 && buffon_density_log_pdf(value, nowhere, 1, &one->g) == BUFFON_OK &&
               value[0] == -INFINITY,
           "%s: the pdf of what is not a number is 0", one->name);
}

int main(void)
{
    family_make();
    for (const family_case *one = family; one < family + family_count; one++) {
        if (!tap_ok(one->g.status == BUFFON_OK, "%s: is made", one->name))
            continue;
        test_verified(one);
        test_bits(one);
        test_nowhere(one);
    }
    return tap_done();
}
