/* Private. The kernels of spherical.c, which has the derivations: included by levels.h. */

/* One point of a spherical triangle, by the weights of its corners: a w[0] + b w[1] + c w[2]. */
LANES_INLINE void LANES(spherical_share)(lanes_d w[3], lanes_d u1, lanes_d u2, const double *param)
{
    const double *a = param + SPHERICAL_A, *b = param + SPHERICAL_B, *c = param + SPHERICAL_C;
    const double half = param[SPHERICAL_HALF], k = param[SPHERICAL_COSINE];
    lanes_d near, far, unused, chord = lanes_all(0);
    LANES(sincospi_near)(&far, &unused, half * u1);
    LANES(sincospi_near)(&near, &unused, half * (1.0 - u1));
    far *= param[SPHERICAL_RATIO];
    /* The new corner on the arc from a to c, and half the squared chord from it to -b. */
    const lanes_d sum = near + far;
    const lanes_d length = near * near + 2.0 * k * far * sum;
    const lanes_d on_a = near * (sum + far) / length, on_c = 2.0 * far * (near + k * far) / length;
    for (size_t j = 0; j < 3; j++) {
        const lanes_d d = b[j] + (on_a * a[j] + on_c * c[j]);
        chord += d * d;
    }
    /* The point on the arc from b to there. */
    const lanes_d p = 0.5 * chord, q = 2.0 - p, left = 1.0 - u2, root = lanes_sqrt(u2);
    const lanes_d whole = lanes_sqrt(0.5 * p), part = lanes_sqrt(0.5 * (p + q * left));
    const lanes_d along = root * part / whole;
    w[0] = along * on_a;
    w[1] = left * (part * whole + 0.5 * q * root) / (whole * (part + whole * root));
    w[2] = along * on_c;
}

/* The direction of p. */
LANES_INLINE void LANES(spherical_store)(double *x, const lanes_d p[3], size_t n, size_t left)
{
    const lanes_d scale = 1.0 / lanes_sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (size_t j = 0; j < 3; j++)
        lanes_store(x + j * n, p[j] * scale, left);
}

static void LANES(spherical_triangle)(double *x, const double *u, size_t n, const double *param)
{
    const double *a = param + SPHERICAL_A, *b = param + SPHERICAL_B, *c = param + SPHERICAL_C;
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        lanes_d w[3], p[3];
        LANES(spherical_share)(w, lanes_load(u + i, n - i), lanes_load(u + n + i, n - i), param);
        for (size_t j = 0; j < 3; j++)
            p[j] = w[0] * a[j] + w[1] * b[j] + w[2] * c[j];
        LANES(spherical_store)(x + i, p, n, n - i);
    }
}

/* One point of a rectangle: how far along its edges, 0 to 1. */
LANES_INLINE void LANES(spherical_along)(lanes_d *s, lanes_d *t, lanes_d u, lanes_d v,
                                         const spherical_view *r)
{
    lanes_d su, cu, sv, cv, x, y;
    u = r->mirror[0] ? 1.0 - u : u;
    v = r->mirror[1] ? 1.0 - v : v;
    LANES(sincospi_near)(&su, &cu, r->half * u);
    LANES(sincospi_near)(&sv, &cv, r->half * (1.0 - u));
    const lanes_d du = su * (1 + r->t0 * r->t0) / (cu - r->t0 * su);
    const lanes_d dv = sv * (1 + r->t1 * r->t1) / (cv + r->t1 * sv);
    const lanes_d tau = r->t0 + du, square = tau * tau * r->sigma;
    const lanes_d q = lanes_sqrt((r->above + du) * (r->below + dv) * (1.0 - square));
    if (r->x0 < 0) {
        x = r->scale * tau / q;
        *s = (x - r->x0) / r->width;
    } else {
        const lanes_d rest = r->delta - square * (r->t0 * r->t0);
        const lanes_d step =
            r->scale * du * (tau + r->t0) * rest / (q * r->q0 * (tau * r->q0 + r->t0 * q));
        x = r->x0 + step;
        *s = step / r->width;
    }
    const lanes_d d = x * x + r->z * r->z, y0 = lanes_all(r->y0), y1 = lanes_all(r->y1);
    const lanes_d r0 = lanes_sqrt(d + y0 * y0), r1 = lanes_sqrt(d + y1 * y1);
    const lanes_d h0 = y0 / r0, h1 = y1 / r1, left = 1.0 - v;
    const lanes_d h = left * h0 + v * h1;
    const lanes_d top = d / (r1 * (r1 + y1)); /* 1 - h1 */
    if (r->y0 < 0) {
        const lanes_d bottom = d / (r0 * (r0 - y0)); /* 1 + h0 */
        y = h * lanes_sqrt(d / ((left * (1.0 - h0) + v * top) * (left * bottom + v * (1.0 + h1))));
        *t = (y - y0) / r->high;
    } else {
        const lanes_d gap = d * (y1 + y0) / (r0 * r1 * (y1 * r0 + y0 * r1));
        const lanes_d within = (left * (d / (r0 * (r0 + y0))) + v * top) * (1.0 + h);
        y = h * lanes_sqrt(d / within);
        *t = r0 * r0 * v * gap * (h + h0) / (within * (y + y0));
    }
    *s = lanes_min(*s, lanes_all(1));
    *t = lanes_min(*t, lanes_all(1));
    *s = r->mirror[0] ? 1.0 - *s : *s;
    *t = r->mirror[1] ? 1.0 - *t : *t;
}

static void LANES(spherical_rectangle)(double *x, const double *u, size_t n, const double *param,
                                       const spherical_view *r)
{
    const double *corner = param + SPHERICAL_A, *e1 = param + SPHERICAL_B;
    const double *e2 = param + SPHERICAL_C;
    for (size_t i = 0; i < n; i += LANES_WIDTH) {
        lanes_d s, t, p[3];
        LANES(spherical_along)(&s, &t, lanes_load(u + i, n - i), lanes_load(u + n + i, n - i), r);
        for (size_t j = 0; j < 3; j++)
            p[j] = corner[j] + s * e1[j] + t * e2[j];
        LANES(spherical_store)(x + i, p, n, n - i);
    }
}
