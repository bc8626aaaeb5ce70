/* Layer 2. Any density on the line from its pdf alone, by a table of its quantile function.
 *
 *     const buffon_inverse_law law = {.pdf = spectrum, .lo = 0, .hi = INFINITY};
 *     buffon_inverse_table *table;
 *     buffon_inverse_report report;
 *     if (buffon_inverse_table_new(&table, &report, &law) < 0) ...  report.why, report.where
 *     const buffon_density g = buffon_inverse_table_density(table);
 *
 * The pdf is integrated once, adaptively, and x = Q(u) is tabulated as polynomials of degree 5 that
 * meet: u lies in the cell [u_k, u_k+1), and x = c0 + d (c1 + d (...)), d = u - u_k. Below
 * u = 2^-10 and above 1 - 2^-10 the polynomials are of log |x - e| in log p, where p is u or 1 - u
 * and e the finite end of the domain, or the median where there is none: powers become straight
 * lines, so that both tails keep their relative accuracy.
 *
 * What is drawn has exactly the pdf 1 / Q'(u), and that is the pdf that the density gives. It
 * differs a little from the law asked for, but an estimate by importance sampling is unbiased all
 * the same, however coarse the table: f / g corrects it. The law's integral comes out on the way.
 *
 * A table holds no pointers: it may be copied, moved, saved and loaded on a machine of the same
 * byte order. It does not call the functions it was made from. A normal's takes 40 KiB, others of
 * tests/laws40.h 2 to 70; 1000 cells would take 200.
 */
#ifndef BUFFON_INVERSE_TABLE_H
#define BUFFON_INVERSE_TABLE_H

#include "api.h"
#include "density.h"
#include "status.h"

BUFFON_BEGIN

/** A law on the line, given by a pdf that need not be normalised.
 *
 *  pdf       >= 0, of finite integral; smooth but at `breaks`. It may go to infinity as a power at
 *            `poles`, at lo and at hi, where it is not called
 *  cdf       may be NULL; else the error is also measured against it, in every cell
 *  lo, hi    the support; infinite ends allowed; both 0: the line
 *  centre    for infinite ends: a point such that the bulk of the law lies about as far from it as
 *            it is wide. 0 will do where the distance to the bulk is not thousands of its widths
 *  breaks    where pdf or one of its derivatives jumps, in any order; within (lo, hi). A break that
 *            is not told costs calls, hardly accuracy; a peak so narrow that no call meets it is
 *            not seen, and a break there shows it
 *  poles     likewise
 *  u_error   how far F(x) may be from u, F being the law's CDF: 1e-13 to 1e-3; 0 stands for 1e-12.
 *            In the tails, where p < 2^-10: how far relative to p, but for a factor of 1024
 *  tail      the least p for which that is wanted: 1e-300 to 2^-10; 0 stands for 1e-300. Below it
 *            the straight line goes on. Larger ones save calls
 *
 *  A pole that is not at 0 is resolved no better than the doubles about it are spaced: move it to 0
 *  where that matters.
 */
typedef struct buffon_inverse_law {
    double (*pdf)(double x, void *ctx);
    double (*cdf)(double x, void *ctx);
    void *ctx; /* handed through */
    double lo, hi, centre;
    const double *breaks, *poles;
    size_t breaks_count, poles_count;
    double u_error, tail;
    uint64_t reserved[4]; /* must be zero */
} buffon_inverse_law;

/** What the making of a table came to. */
typedef struct buffon_inverse_report {
    buffon_status status;
    const char *why; /* a sentence where the law was refused; else NULL */
    double where;    /* the x that it is about; NaN if none */
    double u_error;  /* the largest |F(Q(u)) - u| measured, the error of the integral included */
    double tail_error; /* the largest relative error of p measured in the tails */
    double lower, upper; /* down to which p the tails were measured on either side */
    double total, total_error; /* the integral of pdf */
    uint64_t calls;            /* of pdf and cdf */
    size_t cells;              /* pieces of polynomials, the tails' included */
    size_t bytes;              /* of the table */
} buffon_inverse_report;

/** A table made by buffon_inverse_table_new or buffon_inverse_table_build. */
typedef struct buffon_inverse_table buffon_inverse_table;

/** Makes a table in memory of its own.
 *
 *  Out:     table   to be freed by buffon_inverse_table_free; NULL on error
 *           report  may be NULL
 *  In:      law     not needed any more afterwards
 *  Returns: BUFFON_OK; BUFFON_W_TOLERANCE, with a table: report->u_error is above the u_error asked
 *           for; BUFFON_E_NULL; BUFFON_E_DOMAIN (lo, hi, centre, breaks, poles); BUFFON_E_TOLERANCE
 *           (u_error, tail); BUFFON_E_RESERVED; BUFFON_E_PDF: a value is negative or not finite, or
 *           the integral is zero or infinite; BUFFON_E_NOMEM
 *  Exact:   u_error as measured against the CDF itself: 1e-12 asked for and reached for the 42 laws
 *           of tests/laws40.h (tests/test_inverse_table.c)
 *  Repeat:  the same bits wherever pdf gives the same
 *  Cost:    500 to 10000 calls of pdf for smooth laws, most of them for tails down to 1e-300
 *  Source:  G. Derflinger, W. Hoermann, J. Leydold (2010), Random variate generation by numerical
 *           inversion when only the density is known; S. Olver, A. Townsend (2013), Fast inverse
 *           transform sampling in one and two dimensions
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_inverse_table_new(buffon_inverse_table **table,
                                                               buffon_inverse_report *report,
                                                               const buffon_inverse_law *law);

/** Makes a table in the caller's memory, and allocates nothing.
 *
 *  Out:     memory  aligned as malloc does; the table begins there and takes report->bytes. The
 *                   rest is workspace: 256 KiB do for smooth laws
 *           report  may be NULL
 *  In:      bytes   of memory
 *           law
 *  Returns: as buffon_inverse_table_new; BUFFON_E_NOMEM if there are too few bytes
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_inverse_table_build(void *memory, size_t bytes,
                                                                 buffon_inverse_report *report,
                                                                 const buffon_inverse_law *law);

/** Gives back what buffon_inverse_table_new took; NULL is allowed.
 *
 *  Since:   0.1
 */
BUFFON_API void buffon_inverse_table_free(buffon_inverse_table *table);

/** The bytes that a table takes, to copy or save it.
 *
 *  In:      table  NULL, or what is no table, gives 0
 *  Since:   0.1
 */
BUFFON_API size_t buffon_inverse_table_bytes(const buffon_inverse_table *table);

/** The density of what a table draws.
 *
 *  In:      table  must outlive the density; aligned as a double
 *  Law:     x = Q(u), g = 1 / Q'(u): Q is the table's, and increases with u
 *  Draws:   1
 *  Returns: a density of 1 coordinate; it carries BUFFON_E_NULL, or BUFFON_E_TABLE where the memory
 *           holds no table
 *  Exact:   see buffon_inverse_table_new for Q. g at a point is that of its draw within 1e-9, and
 *           it inverts to u within 1e-13, each but for what 4 ulp of x are worth
 *           (tests/test_inverse_table.c)
 *  Repeat:  each x depends on its u alone
 *  Since:   0.1
 */
BUFFON_API buffon_density buffon_inverse_table_density(const buffon_inverse_table *table);

/** Points from the upper end: x = Q(1 - q), for q far smaller than 1 - u can tell.
 *
 *  Out:     x[n]
 *           pdf[n]  may be NULL
 *  In:      q[n]    in (0, 1)
 *           table
 *  Returns: as buffon_density_sample
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_inverse_table_upper(double *x, double *pdf,
                                                                 const double *q, size_t n,
                                                                 const buffon_inverse_table *table);

/** The CDF of what the table draws, from both ends.
 *
 *  Out:     lower[n]  P(X <= x)
 *           upper[n]  P(X > x), which keeps its digits where it is small; either may be NULL
 *  In:      x[n]      any
 *           table
 *  Returns: as buffon_density_pdf
 *  Since:   0.1
 */
BUFFON_API BUFFON_CHECK buffon_status buffon_inverse_table_cdf(double *lower, double *upper,
                                                               const double *x, size_t n,
                                                               const buffon_inverse_table *table);

BUFFON_END

#endif
