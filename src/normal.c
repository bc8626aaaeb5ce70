/* The normal quantile: M. Wichura (1988), Algorithm AS 241: the percentage points of the normal
 * distribution, Applied Statistics 37. Three rational functions of degree 7, PPND16 there: of
 * q = p - 1/2 in the middle, of sqrt(-log p) in the tails. The numbers are those of the paper. They
 * hold for every p that is a double, subnormals too. */
#include "guard.h"

#include <math.h>

#include <buffon/interval.h>

#include "elementary.h"
#include "quantile.h"

#define NORMAL_MIDDLE 0.425 /* |p - 1/2| up to which the first one holds */

/* The quantile of 1/2 + q, |q| <= NORMAL_MIDDLE. */
static double normal_middle(double q)
{
    const double r = 0.180625 - q * q;
    const double above =
        3.3871328727963666080e+0 +
        r * (1.3314166789178437745e+2 +
            r * (1.9715909503065514427e+3 +
                r * (1.3731693765509461125e+4 +
                    r * (4.5921953931549871457e+4 +
                        r * (6.7265770927008700853e+4 +
                            r * (3.3430575583588128105e+4 +
                                r * 2.5090809287301226727e+3))))));
    const double below =
        1.0 +
        r * (4.2313330701600911252e+1 +
            r * (6.8718700749205790830e+2 +
                r * (5.3941960214247511077e+3 +
                    r * (2.1213794301586595867e+4 +
                        r * (3.9307895800092710610e+4 +
                            r * (2.8729085735721942674e+4 +
                                r * 5.2264952788528545610e+3))))));
    return q * above / below;
}

/* The same for sqrt(-log p) = 1.6 + r up to 5. */
static double normal_near(double r)
{
    const double above =
        1.42343711074968357734e+0 +
        r * (4.63033784615654529590e+0 +
            r * (5.76949722146069140550e+0 +
                r * (3.64784832476320460504e+0 +
                    r * (1.27045825245236838258e+0 +
                        r * (2.41780725177450611770e-1 +
                            r * (2.27238449892691845833e-2 +
                                r * 7.74545014278341407640e-4))))));
    const double below =
        1.0 +
        r * (2.05319162663775882187e+0 +
            r * (1.67638483018380384940e+0 +
                r * (6.89767334985100004550e-1 +
                    r * (1.48103976427480074590e-1 +
                        r * (1.51986665636164571966e-2 +
                            r * (5.47593808499534494600e-4 +
                                r * 1.05075007164441684324e-9))))));
    return above / below;
}

/* The same for sqrt(-log p) = 5 + r up to 28. */
static double normal_far(double r)
{
    const double above =
        6.65790464350110377720e+0 +
        r * (5.46378491116411436990e+0 +
            r * (1.78482653991729133580e+0 +
                r * (2.96560571828504891230e-1 +
                    r * (2.65321895265761230930e-2 +
                        r * (1.24266094738807843860e-3 +
                            r * (2.71155556874348757815e-5 +
                                r * 2.01033439929228813265e-7))))));
    const double below =
        1.0 +
        r * (5.99832206555887937690e-1 +
            r * (1.36929880922735805310e-1 +
                r * (1.48753612908506148525e-2 +
                    r * (7.86869131145613259100e-4 +
                        r * (1.84631831751005468180e-5 +
                            r * (1.42151175831644588870e-7 +
                                r * 2.04426310338993978564e-15))))));
    return above / below;
}

/* z with P(Z > z) = p, for p up to 1/2 - NORMAL_MIDDLE. */
static double normal_tail(double p)
{
    const double r = sqrt(-buffon_priv_log(p));
    if (p == 0) {
        return r;
    }
    return r <= 5 ? normal_near(r - 1.6) : normal_far(r - 5);
}

double buffon_priv_normal_quantile(double u)
{
    const double q = u - 0.5;
    if (buffon_priv_abs(q) <= NORMAL_MIDDLE) {
        return normal_middle(q);
    }
    return q < 0 ? -normal_tail(u) : normal_tail(1 - u);
}

double buffon_priv_normal_central(double q)
{
    const double size = buffon_priv_abs(q);
    if (size <= NORMAL_MIDDLE) {
        return normal_middle(q);
    }
    return buffon_priv_copysign(normal_tail(0.5 - size), q);
}

double buffon_priv_normal_two_sided(double alpha)
{
    const double p = 0.5 * alpha;
    return p < 0.5 - NORMAL_MIDDLE ? normal_tail(p) : normal_middle(0.5 - p);
}

double buffon_normal_quantile(double p)
{
    return buffon_priv_normal_quantile(p);
}
