/* The pictures: histograms, bars, points in the plane and in space. */
#include "gallery.h"

#include <math.h>
#include <stdlib.h>

enum { VIEW_MANY = 1 << 14, VIEW_DOTS = 1500, VIEW_BINS = 64, VIEW_SIDE = 340, VIEW_CELLS = 8 };

/* The first n scrambled Sobol' points, taken through the density: x[dim * n], as it makes them. */
static double *view_points(const buffon_density *g, size_t n)
{
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    buffon_points_block block = {.key = {.seed = 1777}, .n = n, .dim = g->uniforms};
    double *u = need_memory(n * g->uniforms * sizeof *u);
    double *x = need_memory(n * g->dim * sizeof *x);
    block.table = need_memory(sobol.table_size(g->uniforms, &sobol));
    if (sobol.prepare(&block, &sobol) != 0 || sobol.fill(u, &block, &sobol) != 0)
        give_up("gallery", "no points");
    gallery_check(buffon_density_sample(x, NULL, u, n, g), "points");
    free(block.table);
    free(u);
    return x;
}

/* ---- on the line ---- */

/* The curve of the density, in a path of its own pieces where it leaves the panel. */
static void view_curve(panel *p, const double *x, const double *pdf, size_t n)
{
    size_t begin = 0;
    for (size_t i = 0; i <= n; i++) {
        if (i < n && pdf[i] >= p->y.lo && pdf[i] <= p->y.hi)
            continue;
        if (i > begin + 1)
            panel_line(p, "exact", x + begin, pdf + begin, i - begin);
        begin = i + 1;
    }
}

/* The histogram's outline: two corners for each bin. */
static void view_histogram(panel *p, const char *class, const double *height, double lo,
                           double width)
{
    double x[2 * VIEW_BINS], y[2 * VIEW_BINS];
    for (int b = 0; b < VIEW_BINS; b++) {
        x[2 * b] = lo + b * width;
        x[2 * b + 1] = lo + (b + 1) * width;
        y[2 * b] = y[2 * b + 1] = fmin(fmax(height[b], p->y.lo), p->y.hi);
    }
    panel_area(p, class, x, y, 2 * VIEW_BINS, p->y.lo);
}

static void view_line(text *out, const buffon_density *g, view v, const char *class)
{
    enum { STEPS = 512 };
    double at[STEPS + 1], pdf[STEPS + 1], height[VIEW_BINS] = {0}, top = 0;
    /* Tails want many points. */
    size_t n = v.extra > 0 ? (size_t)VIEW_MANY << 5 : VIEW_MANY;
    double *x = view_points(g, n), width = (v.b - v.a) / VIEW_BINS;
    for (size_t i = 0; i < n; i++)
        if (x[i] >= v.a && x[i] < v.b)
            height[(int)fmin((x[i] - v.a) / width, VIEW_BINS - 1)] += 1 / ((double)n * width);
    for (int i = 0; i <= STEPS; i++)
        at[i] = v.a + (v.b - v.a) * i / STEPS;
    gallery_check(buffon_density_pdf(pdf, at, STEPS + 1, g), "a density");
    /* Bins are finite where the density has a pole. */
    for (int b = 0; b < VIEW_BINS; b++)
        top = fmax(top, height[b]);
    ruler across = {.lo = v.a, .hi = v.b}, up = {.lo = 0, .hi = 1.14 * top};
    if (v.extra > 0)
        up = (ruler){.lo = top * pow(10, -v.extra), .hi = 2 * top, .log = 1};
    panel p = panel_begin(out, VIEW_SIDE, 220, across, up, "A histogram of points and the density");
    view_histogram(&p, class, height, v.a, width);
    view_curve(&p, at, pdf, STEPS + 1);
    panel_end(&p);
    free(x);
}

static void view_bars(text *out, const buffon_density *g, view v, const char *class)
{
    size_t n = (size_t)(v.b - v.a) + 1;
    double *x = view_points(g, VIEW_MANY), *pdf = need_memory(n * sizeof *pdf), top = 0;
    double *at = need_memory(n * sizeof *at), *share = need_memory(n * sizeof *share);
    for (size_t k = 0; k < n; k++) {
        at[k] = v.a + (double)k;
        share[k] = 0;
    }
    for (size_t i = 0; i < VIEW_MANY; i++)
        if (x[i] >= v.a && x[i] <= v.b)
            share[(size_t)(x[i] - v.a)] += 1.0 / VIEW_MANY;
    gallery_check(buffon_density_pdf(pdf, at, n, g), "probabilities");
    for (size_t k = 0; k < n; k++)
        top = fmax(top, pdf[k]);
    ruler across = {.lo = v.a - 0.7, .hi = v.b + 0.7}, up = {.lo = 0, .hi = 1.14 * top};
    panel p = panel_begin(out, VIEW_SIDE, 220, across, up, "Shares of points and probabilities");
    for (size_t k = 0; k < n; k++)
        panel_rectangle(&p, class, at[k] - 0.38, 0, at[k] + 0.38, fmin(share[k], up.hi));
    panel_dots(&p, "exact", n > 40 ? 3 : 5, at, pdf, n);
    panel_end(&p);
    free(share);
    free(at);
    free(pdf);
    free(x);
}

/* ---- dots and lines, in tenths of a pixel ---- */

typedef struct dot {
    int x, y, layer; /* 0: the furthest */
} dot;

/* By layers, and in each by rows to and fro: short steps make a short text. */
static int dot_order(const void *left, const void *right)
{
    const dot *a = left, *b = right;
    int row_a = a->y / 64, row_b = b->y / 64, turn = row_a % 2 ? -1 : 1;
    if (a->layer != b->layer)
        return a->layer - b->layer;
    return row_a != row_b ? row_a - row_b : turn * (a->x - b->x);
}

/* sizes[layer] in pixels, opacities[layer]. */
static void view_dots(text *out, const char *class, dot *d, size_t n, const double *sizes,
                      const double *opacities)
{
    int x = 0, y = 0;
    qsort(d, n, sizeof *d, dot_order);
    for (size_t i = 0; i < n; i++) {
        int layer = d[i].layer;
        if (i == 0 || layer != d[i - 1].layer) {
            text_add(out, "%s<path class=\"dots %s\" stroke-width=\"%g\" stroke-opacity=\"%g\" "
                     "transform=\"scale(.1)\" d=\"", i == 0 ? "" : "\"/>", class, 10 * sizes[layer],
                     opacities[layer]);
            x = y = 0;
        }
        text_add(out, d[i].y < y ? "m%d%dh0" : "m%d %dh0", d[i].x - x, d[i].y - y);
        x = d[i].x;
        y = d[i].y;
    }
    if (n > 0)
        text_put(out, "\"/>");
}

/* How many of the dots to draw, so that they stay apart: as many as suit the area on which they
 * fall. The first of even points are even too. */
static size_t view_enough(const dot *d, size_t n)
{
    enum { ACROSS = 48 };
    unsigned char taken[ACROSS * ACROSS] = {0};
    size_t cells = 0;
    for (size_t i = 0; i < n; i++) {
        int x = d[i].x * ACROSS / (10 * VIEW_SIDE), y = d[i].y * ACROSS / (10 * VIEW_SIDE);
        if (x < 0 || x >= ACROSS || y < 0 || y >= ACROSS || taken[y * ACROSS + x])
            continue;
        taken[y * ACROSS + x] = 1;
        cells++;
    }
    size_t enough = cells + cells / 2;
    return n < enough ? n : enough;
}

/* Where a point of the density is drawn, and how far towards the eye it lies: -1 to 1 or so. */
typedef struct camera {
    double size[2], middle[2], scale, depth;
    double centre[3], right[3], up[3], towards[3];
} camera;

static double camera_see(const camera *c, const double *v, double seen[2])
{
    double across = 0, up = 0, depth = 0;
    for (int k = 0; k < 3; k++) {
        double from = v[k] - c->centre[k];
        across += from * c->right[k];
        up += from * c->up[k];
        depth += from * c->towards[k];
    }
    seen[0] = c->middle[0] + c->scale * across;
    seen[1] = c->middle[1] - c->scale * up;
    return depth * c->depth;
}

/* Point i of n, the coordinates that it lacks being 0. */
static void camera_point(double v[3], const double *x, size_t i, size_t n, const buffon_density *g)
{
    for (size_t k = 0; k < 3; k++)
        v[k] = k < g->dim ? x[k * n + i] : 0;
}

/* Between the ends of the unit interval, which laws without bounds would take to infinity. */
static double view_within(double u)
{
    return fmin(fmax(u, 1e-4), 1 - 1e-4);
}

/* The image of a line of the square or cube of uniforms: the one at `across` runs, slowly near its
 * ends, and the others stay. It is lifted where the map jumps, and drawn fainter behind. */
static void view_net_line(text *out, const camera *c, const buffon_density *g, size_t across,
                          const double *others)
{
    enum { STEPS = 96 };
    double u[3 * (STEPS + 1)], *x = need_memory(g->dim * (STEPS + 1) * sizeof *x);
    double before[2] = {0, 0};
    int side = -1, drawn_x = 0, drawn_y = 0;
    for (int i = 0; i <= STEPS; i++)
        for (size_t j = 0; j < g->uniforms; j++)
            u[j * (STEPS + 1) + (size_t)i] =
                view_within(j == across ? pow(sin(1.5707963 * i / STEPS), 2) : others[j]);
    gallery_check(buffon_density_sample(x, NULL, u, STEPS + 1, g), "a net");
    for (size_t i = 0; i <= STEPS; i++) {
        double v[3], at[2];
        camera_point(v, x, i, STEPS + 1, g);
        int near = camera_see(c, v, at) >= -1e-6;
        int jump = hypot(at[0] - before[0], at[1] - before[1]) > 0.2 * VIEW_SIDE;
        int px = (int)lround(10 * at[0]), py = (int)lround(10 * at[1]);
        if (side >= 0 && !jump)
            text_add(out, py < drawn_y ? "l%d%d" : "l%d %d", px - drawn_x, py - drawn_y);
        if (side != near || jump) {
            text_add(out, "%s<path class=\"net%s\" d=\"M%d %d", side >= 0 ? "\"/>" : "",
                     near ? "" : " far", px, py);
            side = near;
        }
        drawn_x = px;
        drawn_y = py;
        before[0] = at[0];
        before[1] = at[1];
    }
    text_put(out, "\"/>");
    free(x);
}

/* The net of a surface; of a solid the twelve edges of the cube. */
static void view_net(text *out, const camera *c, const buffon_density *g)
{
    text_put(out, "<g transform=\"scale(.1)\">");
    for (int k = 0; g->uniforms == 2 && k <= VIEW_CELLS; k++)
        for (size_t across = 0; across < 2; across++) {
            double at = (double)k / VIEW_CELLS, others[] = {at, at};
            view_net_line(out, c, g, across, others);
        }
    for (int k = 0; g->uniforms == 3 && g->dim == 3 && k < 8; k++)
        for (size_t across = 0; across < 3; across++) {
            double others[] = {k & 1, k >> 1 & 1, k >> 2};
            if (others[across] == 0)
                view_net_line(out, c, g, across, others);
        }
    text_put(out, "</g>");
}

/* ---- in the plane ---- */

/* Shades of the density: at each level of its root the cells above it, a little darker. */
static void view_shades(text *out, const camera *c, const buffon_density *g, view v,
                        const char *class)
{
    enum { CELLS = 72, LEVELS = 9 };
    double *x = need_memory(2 * CELLS * CELLS * sizeof *x), top = 0;
    double *pdf = need_memory(CELLS * CELLS * sizeof *pdf), cell[2];
    cell[0] = (v.b - v.a) / CELLS;
    cell[1] = (v.d - v.c) / CELLS;
    for (size_t i = 0; i < CELLS * CELLS; i++) {
        x[i] = v.a + ((double)(i % CELLS) + 0.5) * cell[0];
        x[CELLS * CELLS + i] = v.d - ((double)(i / CELLS) + 0.5) * cell[1];
    }
    gallery_check(buffon_density_pdf(pdf, x, CELLS * CELLS, g), "a density");
    for (size_t i = 0; i < CELLS * CELLS; i++)
        top = fmax(top, pdf[i]);
    text_add(out, "<g class=\"area %s\" style=\"fill-opacity:.085\" transform=\"translate(%g %g) "
             "scale(%g %g)\">", class, c->middle[0] + c->scale * (v.a - c->centre[0]),
             c->middle[1] - c->scale * (v.d - c->centre[1]), c->scale * cell[0],
             c->scale * cell[1]);
    for (int level = 1; level <= LEVELS; level++) {
        double above = top * pow((level - 0.5) / LEVELS, 2);
        text_put(out, "<path d=\"");
        for (int row = 0; row < CELLS; row++)
            for (int from = 0; from < CELLS; from++) {
                int to = from;
                while (to < CELLS && pdf[row * CELLS + to] >= above)
                    to++;
                if (to > from)
                    text_add(out, "M%d %dh%dv1H%dz", from, row, to - from, from);
                from = to;
            }
        text_put(out, "\"/>");
    }
    text_put(out, "</g>");
    free(pdf);
    free(x);
}

static void view_plane(text *out, const buffon_density *g, view v, const char *class)
{
    static const double size[] = {2.5}, opacity[] = {0.75};
    double scale = fmin(VIEW_SIDE / (v.b - v.a), VIEW_SIDE / (v.d - v.c));
    camera c = {.scale = scale, .centre = {(v.a + v.b) / 2, (v.c + v.d) / 2, 0}};
    c.right[0] = c.up[1] = c.towards[2] = 1;
    c.size[0] = VIEW_SIDE;
    c.size[1] = fmin(VIEW_SIDE, fmax(220, scale * (v.d - v.c)));
    c.middle[0] = c.size[0] / 2;
    c.middle[1] = c.size[1] / 2;
    double *x = view_points(g, VIEW_DOTS);
    dot *d = need_memory(VIEW_DOTS * sizeof *d);
    size_t seen = 0;
    for (size_t i = 0; i < VIEW_DOTS; i++) {
        double at[2], w[3];
        camera_point(w, x, i, VIEW_DOTS, g);
        camera_see(&c, w, at);
        if (w[0] >= v.a && w[0] <= v.b && w[1] >= v.c && w[1] <= v.d)
            d[seen++] = (dot){(int)lround(10 * at[0]), (int)lround(10 * at[1]), 0};
    }
    text_add(out, "<svg viewBox=\"0 0 %g %.0f\" role=\"img\" aria-label=\"Points in the plane\">",
             c.size[0], c.size[1]);
    if (v.extra && g->dim == 2)
        view_shades(out, &c, g, v, class);
    else
        view_net(out, &c, g);
    view_dots(out, class, d, view_enough(d, seen), size, opacity);
    text_put(out, "</svg>\n");
    free(d);
    free(x);
}

/* ---- in space ---- */

/* From a little above, and from the side where the lamp of entries.h is. */
static camera view_camera(view v)
{
    text nothing = {0};
    globe eye = globe_eye(&nothing, VIEW_SIDE, 1, 24, -62);
    camera c = {.size = {VIEW_SIDE, VIEW_SIDE}, .middle = {VIEW_SIDE / 2, VIEW_SIDE / 2}};
    c.scale = (VIEW_SIDE / 2 - 12) / v.d;
    c.depth = 1 / v.d;
    for (int k = 0; k < 3; k++) {
        c.centre[k] = k == 0 ? v.a : k == 1 ? v.b : v.c;
        c.right[k] = eye.right[k];
        c.up[k] = eye.up[k];
        c.towards[k] = eye.towards[k];
    }
    return c;
}

static void view_begin(text *out, const camera *c, int ball)
{
    text_add(out, "<svg viewBox=\"0 0 %g %g\" role=\"img\" aria-label=\"Points in space\">",
             c->size[0], c->size[1]);
    if (ball)
        text_add(out, "<circle class=\"ball\" cx=\"%g\" cy=\"%g\" r=\"%g\"/>", c->middle[0],
                 c->middle[1], c->scale);
}

/* Points of a surface or a solid; the nearer, the larger and darker. */
static void view_space(text *out, const buffon_density *g, view v, const char *class)
{
    static const double size[] = {1.7, 1.8, 1.9, 2, 2.1, 2.2, 2.4, 2.6};
    static const double sphere[] = {0.28, 0.31, 0.35, 0.4, 0.7, 0.76, 0.83, 0.9};
    static const double solid[] = {0.4, 0.47, 0.54, 0.61, 0.68, 0.75, 0.82, 0.9};
    camera c = view_camera(v);
    double *x = view_points(g, VIEW_DOTS);
    dot *d = need_memory(VIEW_DOTS * sizeof *d);
    size_t seen = 0;
    for (size_t i = 0; i < VIEW_DOTS; i++) {
        double at[2], w[3];
        camera_point(w, x, i, VIEW_DOTS, g);
        double depth = camera_see(&c, w, at);
        int layer = (int)fmin(fmax(4 * (depth + 1), 0), 7);
        if (hypot(at[0] - c.middle[0], at[1] - c.middle[1]) <= VIEW_SIDE)
            d[seen++] = (dot){(int)lround(10 * at[0]), (int)lround(10 * at[1]), layer};
    }
    view_begin(out, &c, v.kind == VIEW_SPHERE);
    if (!v.extra)
        view_net(out, &c, g);
    view_dots(out, class, d, view_enough(d, seen), size, v.kind == VIEW_SPHERE ? sphere : solid);
    text_put(out, "</svg>\n");
    free(d);
    free(x);
}

/* Those on the far side first. */
static void view_frames(text *out, const buffon_density *g, view v, const char *class)
{
    enum { HAIRS = 600 };
    static const double pole[] = {0, 0, 1}, side[] = {1, 0, 0};
    camera c = view_camera(v);
    double *q = view_points(g, HAIRS);
    view_begin(out, &c, 1);
    for (int near = 0; near < 2; near++) {
        text_add(out, "<path class=\"hair %s%s\" d=\"", class, near ? "" : " far");
        for (size_t i = 0; i < HAIRS; i++) {
            double turn[4], root[3], along[3], tip[3], from[2], to[2];
            for (size_t k = 0; k < 4; k++)
                turn[k] = q[k * HAIRS + i];
            buffon_rotation_apply(root, pole, turn);
            buffon_rotation_apply(along, side, turn);
            for (int k = 0; k < 3; k++)
                tip[k] = root[k] + 0.09 * along[k];
            camera_see(&c, tip, to);
            if ((camera_see(&c, root, from) >= 0) == near)
                text_add(out, "M%.1f %.1fL%.1f %.1f", from[0], from[1], to[0], to[1]);
        }
        text_put(out, "\"/>");
    }
    text_put(out, "</svg>\n");
    free(q);
}

void view_draw(text *out, const buffon_density *g, view v, const char *class)
{
    switch (v.kind) {
    case VIEW_LINE: view_line(out, g, v, class); break;
    case VIEW_BARS: view_bars(out, g, v, class); break;
    case VIEW_PLANE: view_plane(out, g, v, class); break;
    case VIEW_FRAMES: view_frames(out, g, v, class); break;
    default: view_space(out, g, v, class); break;
    }
}
