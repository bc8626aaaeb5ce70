/* Spherical triangles and rectangles: solid angles and the places of points against extended
 * precision, at every distance; directions; the way back; what is refused. What needs a long double
 * of 64 bits is skipped elsewhere. */
#include <buffon/buffon.h>
#include <float.h>
#include <math.h>

#include "grid.h"
#include "tap.h"

typedef long double wide;

#define WIDE_PI 3.14159265358979323846264338327950288L

enum { DRAWS = 20000 };

static double ulp(wide x)
{
    const double a = fabs((double)x);
    return nextafter(a, INFINITY) - a;
}

static void raise_to(double *worst, double error)
{
    if (!(error <= *worst))
        *worst = error;
}

static void report(double worst, double limit, const char *what)
{
    tap_ok(worst <= limit, "%s: at most %g", what, limit);
    tap_note("worst %.3g", worst);
}

static wide dot(const wide *a, const wide *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(wide *out, const wide *a, const wide *b)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static wide norm(const wide *a)
{
    return sqrtl(dot(a, a));
}

/* Of the triangle at, at + e1, at + e2, seen from 0. With whole numbers for coordinates the triple
 * product is exact. */
static wide solid_angle(const wide *at, const wide *e1, const wide *e2)
{
    wide normal[3], b[3], c[3];
    cross(normal, e1, e2);
    for (int j = 0; j < 3; j++) {
        b[j] = at[j] + e1[j];
        c[j] = at[j] + e2[j];
    }
    const wide a0 = norm(at), b0 = norm(b), c0 = norm(c);
    const wide along = a0 * b0 * c0 + dot(at, b) * c0 + dot(b, c) * a0 + dot(c, at) * b0;
    return 2 * atan2l(fabsl(dot(at, normal)), along);
}

/* A scene in whole numbers times a power of two: the observer, a corner at `distance` from it, and
 * two edges. */
typedef struct scene {
    double from[3], corner[3], e1[3], e2[3], b[3], c[3];
    wide at[3], w1[3], w2[3];
} scene;

static double whole(buffon_rng *rng, double size)
{
    return floor(size * (2 * buffon_rng_next(rng) - 1) + 0.5);
}

static void scene_finish(scene *s, double unit)
{
    for (int j = 0; j < 3; j++) {
        s->at[j] = s->corner[j];
        s->w1[j] = s->e1[j];
        s->w2[j] = s->e2[j];
        s->corner[j] += s->from[j];
        s->b[j] = (s->corner[j] + s->e1[j]) * unit;
        s->c[j] = (s->corner[j] + s->e2[j]) * unit;
        s->corner[j] *= unit;
        s->from[j] *= unit;
        s->e1[j] *= unit;
        s->e2[j] *= unit;
    }
}

/* Perpendicular edges in whole numbers: (p, q, r) and a multiple of one across it. */
static void scene_edges(scene *s, buffon_rng *rng, double size, int right)
{
    for (int j = 0; j < 3; j++) {
        s->e1[j] = whole(rng, size);
        s->e2[j] = whole(rng, size);
    }
    if (right) {
        const double k = whole(rng, 3);
        s->e2[0] = s->e1[1] + k * s->e1[2];
        s->e2[1] = -s->e1[0];
        s->e2[2] = -k * s->e1[0];
    }
}

static void scene_make(scene *s, buffon_rng *rng, double distance, int right)
{
    const double size = 100, unit = ldexp(1, (int)buffon_rng_below(rng, 400) - 200);
    scene_edges(s, rng, size, right);
    for (int j = 0; j < 3; j++) {
        s->corner[j] = whole(rng, size * distance);
        s->from[j] = whole(rng, 0x1p40);
    }
    scene_finish(s, unit);
}

/* The sine of the angle between the plane and the direction to the corner: 0 in the plane. */
static wide height(const scene *s)
{
    wide n[3];
    cross(n, s->w1, s->w2);
    return fabsl(dot(s->at, n)) / (norm(s->at) * norm(n));
}

static void test_solid_angles(void)
{
    double worst = 0, flat = 0, quad = 0;
    buffon_rng rng = buffon_rng_make(1, 71);
    for (int k = 0; k < DRAWS; k++) {
        scene s;
        scene_make(&s, &rng, pow(10, 8 * buffon_rng_next(&rng) - 1), 0);
        const wide exact = solid_angle(s.at, s.w1, s.w2);
        if (height(&s) < 1e-4L || !(exact > 0))
            continue;
        const double got = buffon_solid_angle_triangle(s.from, s.corner, s.b, s.c);
        raise_to(&worst, (double)fabsl(got - exact) / ulp(exact));
        const double turned = buffon_solid_angle_triangle(s.from, s.c, s.corner, s.b);
        raise_to(&worst, (double)fabsl(turned - exact) / ulp(exact));
    }
    for (int k = 0; k < DRAWS / 4; k++) {
        /* In the plane but for one unit in 10^3 to 10^9: outside, and above the triangle. */
        scene s;
        const double far = floor(pow(10, 3 + 6 * buffon_rng_next(&rng)));
        s = (scene){.e1 = {far, 1, 0}, .e2 = {1, far, 0}};
        s.corner[0] = k % 2 ? -floor(far / 3) : far;
        s.corner[1] = k % 2 ? -floor(far / 4) : floor(far / 7);
        s.corner[2] = 1;
        scene_finish(&s, 1);
        const wide exact = solid_angle(s.at, s.w1, s.w2);
        const double got = buffon_solid_angle_triangle(s.from, s.corner, s.b, s.c);
        raise_to(&flat, (double)fabsl(got - exact) / ulp(exact));
    }
    for (int k = 0; k < DRAWS / 4; k++) {
        scene s;
        wide sum[3];
        scene_make(&s, &rng, pow(10, 8 * buffon_rng_next(&rng) - 1), k % 2);
        for (int j = 0; j < 3; j++)
            sum[j] = s.w1[j] + s.w2[j];
        const wide exact = solid_angle(s.at, s.w1, sum) + solid_angle(s.at, sum, s.w2);
        if (height(&s) < 1e-4L || !(exact > 0))
            continue;
        const double got = buffon_solid_angle_parallelogram(s.from, s.corner, s.e1, s.e2);
        raise_to(&quad, (double)fabsl(got - exact) / ulp(exact));
    }
    for (int k = 0; k < DRAWS / 4; k++) {
        /* Corners with more digits than their distance leaves room for. */
        const double o[3] = {0x1p29, 0x1p29, 0x1p29};
        double c[3][3];
        wide at[3], e1[3], e2[3];
        for (int j = 0; j < 3; j++) {
            for (int i = 0; i < 3; i++)
                c[i][j] = whole(&rng, 0x1p30) * 0x1p-30;
            at[j] = (wide)c[0][j] - o[j];
            e1[j] = (wide)c[1][j] - c[0][j];
            e2[j] = (wide)c[2][j] - c[0][j];
        }
        const wide exact = solid_angle(at, e1, e2);
        const double got = buffon_solid_angle_triangle(o, c[0], c[1], c[2]);
        raise_to(&worst, (double)fabsl(got - exact) / ulp(exact));
    }
    if (LDBL_MANT_DIG >= 64) {
        report(worst, 4, "solid angle of triangles 0.1 to 1e7 sizes away, in ulp");
        report(flat, 4, "solid angle nearly in the plane, in ulp");
        report(quad, 4, "solid angle of parallelograms, in ulp");
    }
}

static void test_known_angles(void)
{
    const double o[3] = {0}, x[3] = {1, 0, 0}, y[3] = {0, 2, 0}, z[3] = {0, 0, 3};
    const double corner[3] = {-1, -1, 1}, e1[3] = {2, 0, 0}, e2[3] = {0, 2, 0};
    const double mid[3] = {0.25, 0.25, 0}, bad[3] = {0, NAN, 0};
    tap_ok(buffon_solid_angle_triangle(o, x, y, z) == 0x1.921fb54442d18p+0, "an octant is pi / 2");
    tap_ok(fabs(buffon_solid_angle_parallelogram(o, corner, e1, e2) - 0x1.0c152382d7366p+1) < 1e-15,
           "a face of the cube is 2 pi / 3");
    tap_ok(buffon_solid_angle_triangle(z, o, x, y) > 0 &&
               buffon_solid_angle_triangle(e1, o, x, e2) == 0,
           "in the plane, outside of it, the solid angle is 0");
    tap_ok(buffon_solid_angle_triangle(mid, o, x, e2) == 0x1.921fb54442d18p+2,
           "in the plane, inside of it, it is 2 pi");
    tap_ok(isnan(buffon_solid_angle_triangle(o, x, y, NULL)) &&
               isnan(buffon_solid_angle_triangle(bad, x, y, z)) &&
               isnan(buffon_solid_angle_triangle(o, o, o, o)) &&
               isnan(buffon_solid_angle_parallelogram(o, corner, bad, e2)) &&
               isnan(buffon_solid_angle_parallelogram(NULL, corner, e1, e2)),
           "what is NULL or not finite has no solid angle");
}

/* ---- places ---- */

/* 1 - cos of the angle between p and p + d: by the sine, whose product is with the difference. */
static wide depth(const wide *p, const wide *d)
{
    wide product[3], q[3];
    for (int j = 0; j < 3; j++)
        q[j] = p[j] + d[j];
    cross(product, p, d);
    const wide lengths = norm(p) * norm(q), sine = norm(product) / lengths;
    return sine * sine / (1 + dot(p, q) / lengths);
}

/* The uniforms that lead to the weights w, by areas: of the triangle to the point of the edge from
 * a to c, and between b and there. */
static void triangle_uniforms(wide u[2], const scene *s, const double *w)
{
    const wide part = w[2] / ((wide)w[0] + w[2]), third = (wide)w[0] + w[2];
    wide edge[3], to_x[3], to_edge[3], b[3];
    for (int j = 0; j < 3; j++) {
        edge[j] = part * s->w2[j];
        b[j] = s->at[j] + s->w1[j];
        to_edge[j] = edge[j] - s->w1[j];
        to_x[j] = third * to_edge[j];
    }
    u[0] = solid_angle(s->at, s->w1, edge) / solid_angle(s->at, s->w1, s->w2);
    u[1] = depth(b, to_x) / depth(b, to_edge);
}

static wide strip(const scene *s, wide part)
{
    wide edge[3], sum[3];
    for (int j = 0; j < 3; j++) {
        edge[j] = part * s->w1[j];
        sum[j] = edge[j] + s->w2[j];
    }
    return solid_angle(s->at, edge, sum) + solid_angle(s->at, sum, s->w2);
}

/* The sine of the angle from the plane y = 0 grows evenly: of the angle between p and p + t e. */
static wide risen(const wide *p, const wide *e, wide t)
{
    wide q[3];
    for (int j = 0; j < 3; j++)
        q[j] = p[j] + t * e[j];
    const wide l = norm(e), y0 = dot(p, e) / l, y = dot(q, e) / l, r0 = norm(p), r = norm(q);
    const wide square = r0 * r0 - y0 * y0;
    if (y0 * y <= 0)
        return y / r - y0 / r0;
    return square * t * l * (y + y0) / (r * r0 * (y * r0 + y0 * r));
}

static void rectangle_uniforms(wide u[2], const scene *s, const double *st)
{
    wide p[3];
    for (int j = 0; j < 3; j++)
        p[j] = s->at[j] + st[0] * s->w1[j];
    u[0] = strip(s, st[0]) / strip(s, 1);
    u[1] = risen(p, s->w2, st[1]) / risen(p, s->w2, 1);
}

/* The formulas of the header and source, as they stand. */
static void triangle_weights(wide w[3], const double u[2], const scene *s)
{
    wide corner[3][3], length[3], n[3], chord = 0;
    for (int j = 0; j < 3; j++) {
        corner[0][j] = s->at[j];
        corner[1][j] = s->at[j] + s->w1[j];
        corner[2][j] = s->at[j] + s->w2[j];
    }
    for (int k = 0; k < 3; k++) {
        length[k] = norm(corner[k]);
        for (int j = 0; j < 3; j++)
            corner[k][j] /= length[k];
    }
    cross(n, s->w1, s->w2);
    const wide ab = dot(corner[0], corner[1]), ac = dot(corner[0], corner[2]);
    const wide across = fabsl(dot(s->at, n)) / (length[0] * length[1] * length[2]);
    const wide along = 1 + ab + ac + dot(corner[1], corner[2]);
    const wide half = atan2l(across, along), k = 1 + ac;
    const wide near = sinl((1 - (wide)u[0]) * half);
    const wide far = (1 + ab) / hypotl(across, along) * sinl(u[0] * half);
    const wide scale = near * near + 2 * k * far * (near + far);
    const wide on_a = near * (near + 2 * far) / scale, on_c = 2 * far * (near + k * far) / scale;
    for (int j = 0; j < 3; j++) {
        const wide d = corner[1][j] + on_a * corner[0][j] + on_c * corner[2][j];
        chord += d * d;
    }
    const wide p = chord / 2, q = 2 - p, v = u[1], r = sqrtl(v);
    const wide e = sqrtl(p / 2), f = sqrtl(1 - v * q / 2);
    w[0] = r * f / e * on_a / length[0];
    w[1] = (1 - v) * (f * e + r * q / 2) / (e * (f + e * r)) / length[1];
    w[2] = r * f / e * on_c / length[2];
    const wide sum = w[0] + w[1] + w[2];
    for (int j = 0; j < 3; j++)
        w[j] /= sum;
}

/* A triangle or rectangle that is not a thread, and from where its plane is seen under an angle
 * whose sine is `least` or more. */
static int scene_plain(scene *s, buffon_rng *rng, double distance, int rectangle, double least)
{
    wide n[3];
    scene_make(s, rng, distance, rectangle);
    cross(n, s->w1, s->w2);
    return norm(s->w1) > 10 && norm(s->w2) > 10 && norm(n) >= 0.1L * norm(s->w1) * norm(s->w2) &&
           norm(s->at) > 0 && height(s) >= least;
}

static void test_triangle_places(double lo, double hi, double least)
{
    double worst = 0, part = 0;
    int inside = 1;
    buffon_rng rng = buffon_rng_make(2, 72);
    for (int k = 0; k < DRAWS; k++) {
        scene s;
        double u[2], w[3];
        wide v[3];
        if (!scene_plain(&s, &rng, lo * pow(hi / lo, buffon_rng_next(&rng)), 0, least))
            continue;
        grid_pair(u, &rng, k);
        buffon_spherical_triangle_weights(w, u[0], u[1], s.from, s.corner, s.b, s.c);
        inside &= w[0] > 0 && w[1] > 0 && w[2] > 0;
        inside &= fabs(w[0] + w[1] + w[2] - 1) <= 0x1p-51;
        triangle_weights(v, u, &s);
        for (int j = 0; j < 3; j++)
            raise_to(&worst, (double)fabsl(v[j] - w[j]));
        triangle_uniforms(v, &s, w);
        raise_to(&part, (double)fabsl(v[0] - u[0]));
        raise_to(&part, (double)fabsl(v[1] - u[1]));
    }
    tap_ok(inside, "triangle %g to %g sizes away, sine %g or more: on it", lo, hi, least);
    if (LDBL_MANT_DIG >= 64) {
        report(worst, 4e-16, "weights of the corners");
        report(part, 4e-14, "the part of the solid angle before the point");
    }
}

static void test_rectangle_places(double lo, double hi, double least, double limit)
{
    double worst = 0;
    int inside = 1;
    buffon_rng rng = buffon_rng_make(2, 73);
    for (int k = 0; k < DRAWS; k++) {
        scene s;
        double u[2], w[2];
        wide v[2];
        if (!scene_plain(&s, &rng, lo * pow(hi / lo, buffon_rng_next(&rng)), 1, least))
            continue;
        grid_pair(u, &rng, k);
        buffon_spherical_rectangle_along(w, u[0], u[1], s.from, s.corner, s.e1, s.e2);
        inside &= w[0] >= 0 && w[0] <= 1 && w[1] >= 0 && w[1] <= 1;
        rectangle_uniforms(v, &s, w);
        raise_to(&worst, (double)fabsl(v[0] - u[0]));
        raise_to(&worst, (double)fabsl(v[1] - u[1]));
    }
    tap_ok(inside, "rectangle %g to %g sizes away, sine %g or more: on it", lo, hi, least);
    if (LDBL_MANT_DIG >= 64)
        report(worst, limit, "the part of the solid angle before the point");
}

/* ---- directions ---- */

static void test_directions(int rectangle)
{
    double length = 0, apart = 0, density = 0, back = 0;
    int good = 1, ends = 1;
    buffon_rng rng = buffon_rng_make(3, 74 + (uint64_t)rectangle);
    for (int k = 0; k < DRAWS / 2; k++) {
        scene s;
        double u[2], v[2], w[3], x[3], y[3], pdf, again;
        const double distance = pow(10, 7 * buffon_rng_next(&rng) - 1);
        if (!scene_plain(&s, &rng, distance, rectangle, 0.01))
            continue;
        grid_pair(u, &rng, k);
        const buffon_density g = rectangle
                                     ? buffon_spherical_rectangle(s.from, s.corner, s.e1, s.e2)
                                     : buffon_spherical_triangle(s.from, s.corner, s.b, s.c);
        good &= buffon_density_sample(x, &pdf, u, 1, &g) == BUFFON_OK;
        if (rectangle)
            buffon_spherical_rectangle_along(w, u[0], u[1], s.from, s.corner, s.e1, s.e2);
        else
            buffon_spherical_triangle_weights(w, u[0], u[1], s.from, s.corner, s.b, s.c);
        wide p[3], out[3];
        for (int j = 0; j < 3; j++) {
            p[j] = rectangle ? s.at[j] + w[0] * s.w1[j] + w[1] * s.w2[j]
                             : s.at[j] + w[1] * s.w1[j] + w[2] * s.w2[j];
            /* Beyond the side at the corner, by a thousandth of what it is from there. */
            out[j] = s.at[j] - 0.001L * (p[j] - s.at[j]);
        }
        const wide r = norm(p), beyond = norm(out);
        for (int j = 0; j < 3; j++) {
            raise_to(&apart, (double)fabsl(x[j] - p[j] / r));
            y[j] = (double)(out[j] / beyond);
        }
        raise_to(&length, fabs(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 1));
        const wide whole_angle = rectangle ? strip(&s, 1) : solid_angle(s.at, s.w1, s.w2);
        raise_to(&density, (double)fabsl(pdf - 1 / whole_angle) / ulp(1 / whole_angle));
        good &= buffon_density_pdf(&again, x, 1, &g) == BUFFON_OK && again == pdf;
        if (distance < 1000 && u[0] > 1e-3 && u[1] > 1e-3 && u[0] < 0.999 && u[1] < 0.999)
            ends &= buffon_density_pdf(&again, y, 1, &g) == BUFFON_OK && again == 0;
        for (int j = 0; j < 3; j++)
            y[j] = -x[j];
        ends &= buffon_density_pdf(&again, y, 1, &g) == BUFFON_OK && again == 0;
        good &= buffon_density_invert(v, x, 1, &g) == BUFFON_OK;
        good &= buffon_density_sample(y, NULL, v, 1, &g) == BUFFON_OK;
        for (int j = 0; j < 3; j++)
            raise_to(&back, fabs(x[j] - y[j]));
    }
    tap_ok(good, "%s: the pdf at a direction is that with it",
           rectangle ? "rectangle" : "triangle");
    tap_ok(ends, "0 beyond a corner, and behind the observer");
    report(length, 0x1p-50, "length of directions");
    report(back, 1e-11, "directions led back to uniforms and to directions");
    if (LDBL_MANT_DIG >= 64) {
        report(apart, 0x1p-48, "directions, coordinates");
        report(density, 4, "pdf, in ulp");
    }
}

/* A regular polygon with corner 0 at an angle, in a plane that leans, seen from any point. */
static void polygon(double *corner, size_t count, double size, double lean)
{
    for (size_t k = 0; k < count; k++) {
        const double t = 6.283185307179586 * (double)k / (double)count + 0.3;
        corner[3 * k] = size * cos(t);
        corner[3 * k + 1] = size * sin(t);
        corner[3 * k + 2] = lean * corner[3 * k] - 0.5 * lean * corner[3 * k + 1];
    }
}

static void test_polygons(void)
{
    double corner[48], density = 0, apart = 0, back = 0, seam = 0;
    int good = 1;
    buffon_rng rng = buffon_rng_make(4, 76);
    for (int k = 0; k < DRAWS / 10; k++) {
        const size_t count = 3 + (size_t)k % 14;
        const double from[3] = {2 * buffon_rng_next(&rng) - 1, 2 * buffon_rng_next(&rng) - 1,
                                1 + buffon_rng_next(&rng)};
        double u[2], v[2], x[3], y[3], pdf, again;
        wide sum = 0, part[16];
        polygon(corner, count, pow(10, -4 * buffon_rng_next(&rng)), 0.25);
        const buffon_density g = buffon_spherical_polygon(from, corner, count);
        for (size_t i = 1; i + 1 < count; i++) {
            wide at[3], e1[3], e2[3];
            for (size_t j = 0; j < 3; j++) {
                at[j] = (wide)corner[j] - from[j];
                e1[j] = (wide)corner[3 * i + j] - corner[j];
                e2[j] = (wide)corner[3 * i + 3 + j] - corner[j];
            }
            part[i] = sum;
            sum += solid_angle(at, e1, e2);
        }
        /* At the second triangle's end the direction is in the plane of its last side. */
        if (count > 4) {
            wide at[3], side[3], normal[3];
            const double end[2] = {(double)(part[3] / sum), 0.5};
            for (size_t j = 0; j < 3; j++) {
                at[j] = (wide)corner[j] - from[j];
                side[j] = (wide)corner[9 + j] - corner[j];
            }
            cross(normal, at, side);
            good &= buffon_density_sample(x, NULL, end, 1, &g) == BUFFON_OK;
            const wide far = x[0] * normal[0] + x[1] * normal[1] + x[2] * normal[2];
            raise_to(&seam, (double)(fabsl(far) / norm(normal)));
        }
        grid_pair(u, &rng, k);
        good &= buffon_density_sample(x, &pdf, u, 1, &g) == BUFFON_OK;
        raise_to(&density, (double)fabsl(pdf - 1 / sum) / ulp(1 / sum));
        good &= buffon_density_pdf(&again, x, 1, &g) == BUFFON_OK && again == pdf;
        good &= buffon_density_invert(v, x, 1, &g) == BUFFON_OK;
        good &= buffon_density_sample(y, NULL, v, 1, &g) == BUFFON_OK;
        for (int j = 0; j < 3; j++)
            raise_to(&back, fabs(x[j] - y[j]));
        if (count == 3) {
            const buffon_density same =
                buffon_spherical_triangle(from, corner + 3, corner, corner + 6);
            good &= buffon_density_sample(y, NULL, u, 1, &same) == BUFFON_OK;
            for (int j = 0; j < 3; j++)
                raise_to(&apart, fabs(x[j] - y[j]));
        }
        for (int j = 0; j < 3; j++)
            x[j] = -x[j];
        good &= buffon_density_pdf(&again, x, 1, &g) == BUFFON_OK && again == 0;
    }
    tap_ok(good, "polygons: the pdf at a direction is that with it, 0 behind");
    report(apart, 1e-15, "a polygon of three corners against the triangle");
    report(back, 1e-10, "directions led back to uniforms and to directions");
    if (LDBL_MANT_DIG >= 64)
        report(seam, 0x1p-49, "the end of the second triangle");
    if (LDBL_MANT_DIG >= 64)
        report(density, 6, "pdf of polygons, in ulp");
    const double from[3] = {0.1, 0.2, 2};
    polygon(corner, 8, 1, 0);
    good = buffon_spherical_polygon(from, corner, 8).status == BUFFON_OK;
    good &= buffon_spherical_polygon(from, corner, 2).status == BUFFON_E_DIM;
    good &= buffon_spherical_polygon(from, corner, 17).status == BUFFON_E_DIM;
    good &= buffon_spherical_polygon(NULL, corner, 8).status == BUFFON_E_NULL;
    good &= buffon_spherical_polygon(from, NULL, 8).status == BUFFON_E_NULL;
    for (size_t j = 0; j < 3; j++)
        corner[9 + j] *= 0.3;
    good &= buffon_spherical_polygon(from, corner, 8).status == BUFFON_E_SHAPE;
    for (size_t j = 0; j < 3; j++)
        corner[9 + j] = 0.5 * (corner[6 + j] + corner[12 + j]);
    good &= buffon_spherical_polygon(corner, corner, 8).status == BUFFON_E_SHAPE;
    corner[5] = NAN;
    good &= buffon_spherical_polygon(from, corner, 8).status == BUFFON_E_SHAPE;
    tap_ok(good, "polygons of too few or many corners, not convex, or seen edge on are refused");
}

/* So far off that all of it is one double or two. */
static void test_specks(void)
{
    const double o[3] = {0}, a[3] = {1e17, 0, 3e16}, e1[3] = {0, 1, 0}, e2[3] = {-0.3, 0, 1};
    const double b[3] = {1e17, 1, 3e16}, c[3] = {1e17, 0, 3e16 + 8};
    const buffon_density g[2] = {buffon_spherical_triangle(o, a, b, c),
                                 buffon_spherical_rectangle(o, a, e1, e2)};
    int good = 1;
    for (int k = 0; k < 2; k++) {
        const double u[2] = {0.25, 0.75};
        double x[3], y[3], v[2], pdf, again;
        good &= buffon_density_sample(x, &pdf, u, 1, &g[k]) == BUFFON_OK;
        good &= buffon_density_pdf(&again, x, 1, &g[k]) == BUFFON_OK && again == pdf;
        good &= buffon_density_invert(v, x, 1, &g[k]) == BUFFON_OK;
        good &= v[0] > 0 && v[0] < 1 && v[1] > 0 && v[1] < 1;
        for (int j = 0; j < 3; j++)
            y[j] = -x[j];
        good &= buffon_density_pdf(&again, y, 1, &g[k]) == BUFFON_OK && again == 0;
    }
    tap_ok(good, "a speck 1e17 sizes away is seen there, and not behind");
}

static void test_refused(void)
{
    const double o[3] = {0}, x[3] = {1, 0, 0}, y[3] = {0, 2, 0}, z[3] = {0, 0, 3};
    const double mid[3] = {0.25, 0.25, 0}, bad[3] = {0, NAN, 0}, endless[3] = {0, 0, INFINITY};
    const double corner[3] = {-1, -1, 1}, skew[3] = {1e-9, 2, 0}, zero[3] = {0};
    const double huge[3] = {2e301, 0, 0};
    int shape = 1, null = 1;
    double w[3] = {0};
    shape &= buffon_spherical_triangle(mid, o, x, y).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_triangle(o, o, x, y).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_triangle(z, x, y, y).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_triangle(z, x, bad, y).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_triangle(endless, x, y, z).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_triangle(o, x, y, huge).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_rectangle(mid, o, x, y).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_rectangle(o, corner, x, skew).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_rectangle(o, corner, x, zero).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_rectangle(o, corner, x, bad).status == BUFFON_E_SHAPE;
    shape &= buffon_spherical_rectangle(o, endless, x, y).status == BUFFON_E_SHAPE;
    tap_ok(shape, "observers in the plane, degenerate and skew shapes are refused");
    null &= buffon_spherical_triangle(NULL, x, y, z).status == BUFFON_E_NULL;
    null &= buffon_spherical_triangle(o, x, y, NULL).status == BUFFON_E_NULL;
    null &= buffon_spherical_rectangle(NULL, corner, x, y).status == BUFFON_E_NULL;
    null &= buffon_spherical_rectangle(o, corner, NULL, y).status == BUFFON_E_NULL;
    tap_ok(null, "NULL is refused");
    buffon_spherical_triangle_weights(w, 0.5, 0.5, mid, o, x, y);
    tap_ok(isnan(w[0]) && isnan(w[1]) && isnan(w[2]), "there are no weights on it");
    w[0] = w[1] = 0;
    buffon_spherical_rectangle_along(w, 0.5, 0.5, o, corner, x, skew);
    tap_ok(isnan(w[0]) && isnan(w[1]), "and no place");
}

int main(void)
{
    test_solid_angles();
    test_known_angles();
    test_triangle_places(1, 1e6, 0.5);
    test_triangle_places(0.1, 1, 0.1);
    test_triangle_places(1, 1e6, 0.01);
    test_rectangle_places(1, 1e6, 0.5, 2e-15);
    test_rectangle_places(0.1, 1, 0.1, 2e-15);
    test_rectangle_places(1, 1e6, 0.01, 2e-14);
    test_directions(0);
    test_directions(1);
    test_polygons();
    test_specks();
    test_refused();
    return tap_done();
}
