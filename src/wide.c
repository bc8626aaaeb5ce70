#include "guard.h"

#include "wide.h"

#include <math.h>

#include "elementary.h"

buffon_priv_wide buffon_priv_wide_make(double x, int e)
{
    int shift;
    double m = buffon_priv_frexp(&shift, x);
    if (x == 0.0) /* never -0 */
        return (buffon_priv_wide){0.0, 0};
    return (buffon_priv_wide){m, buffon_priv_isfinite(x) ? e + shift : 0};
}

buffon_priv_wide buffon_priv_wide_count(uint64_t n)
{
    return buffon_priv_wide_round(0, n, 0, 0);
}

buffon_priv_wide buffon_priv_wide_round(uint64_t hi, uint64_t lo, int sticky, int e)
{
    if (hi == 0) {
        hi = lo;
        lo = 0;
        e -= 64;
    }
    if (hi == 0)
        return (buffon_priv_wide){0.0, 0};
    for (unsigned step = 32; step > 0; step /= 2) { /* brings the leading bit to the top of hi */
        if (hi >> (64 - step) == 0) {
            hi = hi << step | lo >> (64 - step);
            lo <<= step;
            e -= (int)step;
        }
    }
    uint64_t kept = hi >> 11, cut = hi & 0x7ff;
    int below = lo != 0 || sticky;
    kept += cut > 0x400 || (cut == 0x400 && (below || (kept & 1)));
    return buffon_priv_wide_make((double)kept, e + 75);
}

buffon_priv_wide buffon_priv_wide_add(buffon_priv_wide a, buffon_priv_wide b)
{
    if (!buffon_priv_isfinite(a.m) || !buffon_priv_isfinite(b.m))
        return (buffon_priv_wide){a.m + b.m, 0};
    if (a.m == 0.0)
        return b;
    if (b.m == 0.0)
        return a;
    if (a.e < b.e) {
        buffon_priv_wide swap = a;
        a = b;
        b = swap;
    }
    if (a.e - b.e > 200) /* b is far below half a unit in the last place of a */
        return a;
    return buffon_priv_wide_make(a.m + buffon_priv_ldexp(b.m, b.e - a.e), a.e);
}

buffon_priv_wide buffon_priv_wide_mul(buffon_priv_wide a, buffon_priv_wide b)
{
    return buffon_priv_wide_make(a.m * b.m, a.e + b.e);
}

buffon_priv_wide buffon_priv_wide_div(buffon_priv_wide a, buffon_priv_wide b)
{
    return buffon_priv_wide_make(a.m / b.m, a.e - b.e);
}

buffon_priv_wide buffon_priv_wide_sqrt(buffon_priv_wide a)
{
    int odd = a.e % 2 != 0;
    return buffon_priv_wide_make(sqrt(odd ? 2.0 * a.m : a.m), (a.e - odd) / 2);
}

buffon_priv_wide buffon_priv_wide_negate(buffon_priv_wide a)
{
    return (buffon_priv_wide){a.m == 0.0 ? 0.0 : -a.m, a.e};
}

double buffon_priv_wide_to_double(buffon_priv_wide a)
{
    return buffon_priv_ldexp(a.m, a.e);
}
