#include "guard.h"

#include <math.h>

#include <buffon/environment.h>
#include <buffon/math.h>

#include "density_priv.h"
#include "elementary.h"
#include "frame.h"
#include "shares.h"

/* Heights are measured from the nearer pole: 1 - |z| keeps the digits that z has lost there. Row r
 * begins depth[r] = 2 sin(angle / 2)^2 below the north pole and ends depth[rows - 1 - r] above the
 * south pole. It is band[r] high; 2 pi band is its solid angle. level[r] times the share of a pixel
 * in its row is g. */
typedef struct environment_map {
    buffon_priv_sheet sheet;
    double *depth, *band, *level;
} environment_map;

/* How far from the sides of a pixel directions stay, in heights and in turns: further than rounding
 * leads on the way back. */
#define ENVIRONMENT_ASIDE 0x1p-48
#define ENVIRONMENT_TURN 0x1p-49

enum { ENVIRONMENT_TILE = 512 };

static size_t environment_head(size_t rows)
{
    size_t head = buffon_priv_table_more(sizeof(buffon_priv_table), rows, 3 * sizeof(double));
    return buffon_priv_table_more(head, 1, sizeof(double));
}

static environment_map environment_of(const buffon_priv_table *table)
{
    const size_t rows = (size_t)table->size[1];
    environment_map map = {.sheet = buffon_priv_sheet_of(table, environment_head(rows))};
    map.depth = (double *)(uintptr_t)(table + 1);
    map.band = map.depth + rows + 1;
    map.level = map.band + rows;
    return map;
}

size_t buffon_environment_size(size_t width, size_t height)
{
    return buffon_priv_sheet_size(environment_head(height), width, height);
}

/* ---- drawing ------------------------------------------------------------------------------- */

static double environment_between(double x, double lo, double hi)
{
    const double above = x < lo ? lo : x;
    return above < hi ? above : hi;
}

/* The height of a point of row r from the nearer pole: so far into the row from above, and with so
 * much of it left. z says which pole that is. No branches: half of them would be mispredicted. */
static double environment_height(double *z, const environment_map *map, size_t r, double into,
                                 double left)
{
    const size_t mirror = map->sheet.rows - 1 - r;
    const double north = map->depth[r] + into * map->band[r];
    const double south = map->depth[mirror] + left * map->band[r];
    const size_t row = r ^ ((r ^ mirror) & (0 - (size_t)(south < north)));
    const double height = environment_between(south < north ? south : north,
                                              map->depth[row] * (1 + ENVIRONMENT_ASIDE),
                                              map->depth[row + 1] * (1 - ENVIRONMENT_ASIDE));
    *z = buffon_priv_copysign(1 - height, south - north);
    return height;
}

/* Angles in units of pi, sines of the angle from the pole, z and g of a tile. */
static void environment_find(double *angle, double *sine, double *z, double *pdf, const double *u1,
                             const double *u2, size_t n, const environment_map *map)
{
    const buffon_priv_sheet *sheet = &map->sheet;
    const double columns = (double)sheet->columns, aside = ENVIRONMENT_TURN * columns;
    uint32_t row[ENVIRONMENT_TILE], column[ENVIRONMENT_TILE];
    buffon_priv_sheet_find(row, column, u1, u2, n, sheet);
    for (size_t i = 0; i < n; i++) {
        double above, rest, left, right;
        const uint64_t down = shares_unit(&above, u2[i]), unit = shares_unit(&rest, u1[i]);
        const size_t r = row[i], c = column[i];
        const uint64_t *bound = sheet_columns(sheet, r);
        const double into = shares_into(&left, sheet->row, r, down, above);
        const double across = shares_into(&right, bound, c, unit, rest);
        const double height = environment_height(&z[i], map, r, into, left);
        angle[i] = 2 * ((double)c + environment_between(across, aside, 1 - aside)) / columns;
        sine[i] = sqrt(height * (2 - height));
        if (pdf)
            pdf[i] = map->level[r] * shares_mass(bound, c);
    }
}

static int environment_draw(double *x, double *pdf, const double *u, size_t n,
                            const buffon_density *g)
{
    const environment_map map = environment_of(g->data[0]);
    double angle[ENVIRONMENT_TILE], sine[ENVIRONMENT_TILE];
    for (size_t i = 0; i < n; i += ENVIRONMENT_TILE) {
        const size_t m = n - i < ENVIRONMENT_TILE ? n - i : ENVIRONMENT_TILE;
        double *a = x + i, *b = x + n + i;
        environment_find(angle, sine, x + 2 * n + i, pdf ? pdf + i : NULL, u + i, u + n + i, m,
                         &map);
        buffon_math_sincospi(b, a, angle, m);
        for (size_t k = 0; k < m; k++) {
            a[k] *= sine[k];
            b[k] *= sine[k];
        }
    }
    return 0;
}

/* ---- the way back -------------------------------------------------------------------------- */

/* The pixel of a direction, given its longitude as atan2pi says it; and where in the pixel. */
typedef struct environment_place {
    size_t row, column;
    double down, across;
} environment_place;

static environment_place environment_locate(const environment_map *map, double x, double y,
                                            double z, double longitude)
{
    const size_t rows = map->sheet.rows, columns = map->sheet.columns;
    const double height = (x * x + y * y) / (1 + buffon_priv_abs(z));
    const double half = 0.5 * longitude, turn = density_open(half < 0 ? half + 1 : half);
    const double at = turn * (double)columns;
    environment_place place = {0};
    for (size_t left = (rows + 1) / 2; left > 1;) {
        const size_t step = left / 2;
        place.row += map->depth[place.row + step] <= height ? step : 0;
        left -= step;
    }
    place.down = (height - map->depth[place.row]) / map->band[place.row];
    if (z < 0) {
        place.row = rows - 1 - place.row;
        place.down = 1 - place.down;
    }
    place.column = at < (double)columns ? (size_t)at : columns - 1;
    place.across = at - (double)place.column;
    return place;
}

static int environment_pdf(double *pdf, const double *x, size_t n, const buffon_density *g)
{
    const environment_map map = environment_of(g->data[0]);
    const double *y = x + n, *z = y + n;
    double longitude[ENVIRONMENT_TILE];
    for (size_t i = 0; i < n; i += ENVIRONMENT_TILE) {
        const size_t m = n - i < ENVIRONMENT_TILE ? n - i : ENVIRONMENT_TILE;
        buffon_math_atan2pi(longitude, y + i, x + i, m);
        for (size_t k = 0; k < m; k++) {
            pdf[i + k] = 0;
            if (!frame_is_unit(x[i + k], y[i + k], z[i + k]))
                continue;
            const environment_place p =
                environment_locate(&map, x[i + k], y[i + k], z[i + k], longitude[k]);
            pdf[i + k] = map.level[p.row] * shares_mass(sheet_columns(&map.sheet, p.row), p.column);
        }
    }
    return 0;
}

static int environment_unmap(double *u, const double *x, size_t n, const buffon_density *g)
{
    const environment_map map = environment_of(g->data[0]);
    for (size_t i = 0; i < n; i++) {
        const double a = x[i], b = x[n + i], z = x[2 * n + i];
        environment_place p = {0};
        if (frame_is_unit(a, b, z))
            p = environment_locate(&map, a, b, z, buffon_priv_atan2pi(b, a));
        u[i] = density_open(shares_uniform(sheet_columns(&map.sheet, p.row), p.column, p.across));
        u[n + i] = density_open(shares_uniform(map.sheet.row, p.row, p.down));
    }
    return 0;
}

static const buffon_density_ops environment_ops = {.sample = environment_draw,
                                                   .pdf = environment_pdf,
                                                   .invert = environment_unmap,
                                                   .identity = buffon_priv_table_identity,
                                                   .name = "buffon.environment"};

buffon_density buffon_priv_environment_view(const buffon_priv_table *table)
{
    return (buffon_density){
        .uniforms = 2, .dim = 3, .ops = &environment_ops, .data = {table, NULL}};
}

/* ---- making it ----------------------------------------------------------------------------- */

/* An image of doubles or of floats. */
typedef struct environment_image {
    const double *d;
    const float *f;
    size_t width, height;
} environment_image;

static double environment_value(const environment_image *image, size_t k)
{
    return image->d ? image->d[k] : (double)image->f[k];
}

static double environment_largest(const environment_image *image)
{
    double most = 0;
    for (size_t k = 0; k < image->width * image->height; k++) {
        const double value = environment_value(image, k);
        if (!(value >= 0) || !buffon_priv_isfinite(value))
            return -1;
        most = value > most ? value : most;
    }
    return most;
}

/* A band is cos(a) - cos(b) = 2 sin((a + b) / 2) sin((b - a) / 2), which does not cancel. Mirror
 * images have the same numbers. */
static void environment_rows(environment_map *map)
{
    const size_t n = map->sheet.rows;
    const double whole = 2 * (double)n, half = buffon_priv_sinpi(1 / whole);
    for (size_t r = 0; r <= n; r++) {
        const double s = buffon_priv_sinpi((double)r / whole);
        map->depth[r] = 2 * (s * s);
    }
    for (size_t r = 0; r < n; r++) {
        const size_t near = r < n - 1 - r ? r : n - 1 - r;
        map->band[r] = 2 * buffon_priv_sinpi((double)(2 * near + 1) / whole) * half;
    }
}

static buffon_status environment_make(buffon_priv_table *table, const environment_image *image)
{
    buffon_priv_shares scale;
    if (!image->d && !image->f)
        return BUFFON_E_NULL;
    if (buffon_priv_shares_scale(&scale, environment_largest(image)))
        return BUFFON_E_SHAPE;
    table->size[0] = image->width;
    table->size[1] = image->height;
    table->bits[0] = buffon_priv_guide_bits(image->width);
    table->bits[1] = buffon_priv_guide_bits(image->height);
    environment_map map = environment_of(table);
    environment_rows(&map);
    for (size_t r = 0, k = 0; r < image->height; r++)
        for (size_t c = 0; c < image->width; c++, k++)
            sheet_put(&map.sheet, r, c, shares_scaled(&scale, environment_value(image, k)));
    const buffon_status status = buffon_priv_sheet_make(&map.sheet, map.band);
    if (status != BUFFON_OK)
        return status;
    for (size_t r = 0; r < image->height; r++)
        map.level[r] = shares_mass(map.sheet.row, r) / map.band[r] * (double)image->width *
                       (0.5 * DENSITY_INV_PI);
    buffon_priv_table_close(table);
    return BUFFON_OK;
}

static buffon_density environment_build(void *memory, size_t size, const environment_image *image)
{
    buffon_status status;
    const size_t wanted = buffon_environment_size(image->width, image->height);
    buffon_priv_table *table =
        buffon_priv_table_begin(&status, memory, size, wanted, TABLE_ENVIRONMENT);
    if (table)
        status = environment_make(table, image);
    return status == BUFFON_OK ? buffon_priv_environment_view(table)
                               : table_refused(&environment_ops, 3, 2, status);
}

buffon_density buffon_environment(void *memory, size_t size, const double *luminance, size_t width,
                                  size_t height)
{
    const environment_image image = {.d = luminance, .width = width, .height = height};
    return environment_build(memory, size, &image);
}

buffon_density buffon_environment_float(void *memory, size_t size, const float *luminance,
                                        size_t width, size_t height)
{
    const environment_image image = {.f = luminance, .width = width, .height = height};
    return environment_build(memory, size, &image);
}
