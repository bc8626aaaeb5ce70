/* Private. Laws that are nearly normal: gamma, beta, Student and, in their parameter, Poisson and
 * binomial, all in one form.
 *
 * In each, a density is exp(-n zeta^2 / 2) in a variable zeta that is found from the law's own,
 * with n its size (its mean, or its degrees of freedom):
 *
 *     P(Z' <= zeta)' = sqrt(n / 2 pi) G exp(-n zeta^2 / 2) f(zeta),   f = zeta / W,
 *
 * and W(zeta), the distance from the mode in a natural unit, obeys W W' = zeta (1 + c W - v W^2):
 *
 *     gamma    c = 1                       v = 0              n = a            x = a (1 + W)
 *     beta     c = (b - a) / (a + b)       v = a b/(a + b)^2  n = a b/(a + b)  x = a/(a+b) + v W
 *     Student  c = 0                       v = 1              n = dof          W = t/sqrt(n + t^2)
 *
 * G, close to 1, is made of errors of Stirling's formula. Then with w = sqrt(n) zeta
 *
 *     P(Z' <= zeta) = Phi(w) - phi(w) S(zeta) / sqrt(n),   S' - n zeta S = n (1 - G f),
 *
 * and the power series of S has coefficients s[k - 1] = G f[k] + (k + 1) s[k + 1] / n. It is that
 * of N. Temme (1982), The uniform asymptotic expansion of a class of integrals, for the gamma law.
 */
#ifndef BUFFON_SRC_BELL_H
#define BUFFON_SRC_BELL_H

enum { BELL_TERMS = 30 };

typedef struct buffon_priv_bell {
    double n, root; /* root = sqrt(n) */
    double gain;    /* G */
    double reach;   /* of |zeta|, where the series hold */
    double f[BELL_TERMS + 1], s[BELL_TERMS];
} buffon_priv_bell;

/* `log_gain` is log G. The series converge up to |zeta| = sqrt(4 pi / r), r = 1 for the gamma law,
 * max(a, b) / (a + b) for the beta law, 2 for Student's; reach is 2/7 of it, where they leave 1e-16
 * for n >= 10 r. No |zeta| above `most` will be asked for, which saves terms. */
void buffon_priv_bell_make(buffon_priv_bell *bell, double c, double v, double n, double log_gain,
                           double r, double most);

double buffon_priv_bell_reach(double r);

/* The zeta that has as much below it as the normal z; NaN if that is out of reach. */
double buffon_priv_bell_quantile(const buffon_priv_bell *bell, double z);

/* W at a zeta within reach. */
double buffon_priv_bell_distance(const buffon_priv_bell *bell, double zeta);

/* P(Z' <= zeta) or, if `upper`, P(Z' > zeta), within reach; either keeps its relative accuracy. */
double buffon_priv_bell_tail(const buffon_priv_bell *bell, double zeta, int upper);

#endif
