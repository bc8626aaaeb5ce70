/* Light from a picture of the sky: E = int L(w) cos(theta) dw over the hemisphere above a surface.
 *
 * The picture is in longitude and latitude, its first row about the zenith. Here it is a pale sky,
 * brighter towards the horizon, with a sun of four pixels 20,000 times as bright as the rest.
 * Within a pixel L is constant, so the integral is a sum,
 *
 *     E = sum of L(pixel) (z0^2 - z1^2) / 2 (2 pi / width),   z0, z1 the heights of its sides.
 *
 * Directions by the cosine seldom meet the sun; those by the picture meet it as often as it
 * matters. Its table is made once, in memory of ours. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <buffon/buffon.h>

enum { WIDTH = 256, HEIGHT = 128 };

static const double pi = 3.14159265358979323846;
static float sky[WIDTH * HEIGHT];

static void paint(void)
{
    for (int k = 0; k < WIDTH * HEIGHT / 2; k++)
        sky[k] = (float)(1 + k / WIDTH / (HEIGHT / 2.0));
    for (int row = 30; row < 32; row++)
        for (int column = 100; column < 102; column++)
            sky[row * WIDTH + column] = 20000;
}

static double exactly(void)
{
    double sum = 0;
    for (int k = 0; k < WIDTH * HEIGHT / 2; k++) {
        const int row = k / WIDTH;
        const double z0 = cos(pi * row / HEIGHT), z1 = cos(pi * (row + 1) / HEIGHT);
        sum += sky[k] * (z0 * z0 - z1 * z1) / 2 * (2 * pi / WIDTH);
    }
    return sum;
}

/* L(w) cos(theta), by a look at the picture. */
static double light(const double *w, void *ctx)
{
    const double turn = atan2(w[1], w[0]) / (2 * pi);
    const int column = (int)((turn < 0 ? turn + 1 : turn) * WIDTH) % WIDTH;
    const int row = (int)(acos(w[2]) / pi * HEIGHT) % HEIGHT;
    (void)ctx;
    return w[2] > 0 ? sky[row * WIDTH + column] * w[2] : 0;
}

int main(void)
{
    paint();
    const size_t size = buffon_environment_size(WIDTH, HEIGHT);
    void *table = malloc(size);
    const buffon_density by_picture = buffon_environment_float(table, size, sky, WIDTH, HEIGHT);
    const buffon_density by_cosine = buffon_hemisphere_cosine();
    const buffon_density *g[] = {&by_cosine, &by_picture};
    const buffon_points sobol = buffon_points_sobol(BUFFON_SCRAMBLE_OWEN);
    const char *names[] = {"by the cosine", "by the picture", "and Sobol' points"};
    buffon_status s = BUFFON_OK;
    for (int k = 0; k < 3 && s >= 0; k++) {
        buffon_estimate e;
        s = buffon_importance(&e, &(buffon_integrand){.scalar = light, .dim = 3}, g[k > 0],
                              &(buffon_run){.samples = 1 << 16, .points = k == 2 ? &sobol : NULL});
        printf("%-17s  %.5f +- %.5f, exactly %.5f\n", names[k], e.value, e.std_error, exactly());
    }
    if (s < 0)
        fprintf(stderr, "%s\n", buffon_status_string(s));
    free(table);
    return s < 0;
}
