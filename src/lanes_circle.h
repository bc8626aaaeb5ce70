/* Private. Circles, disks and frames in lanes: what the kernels of shapes share. Included by
 * lanes.h, once for each level. */

/* cos(2 pi t) and sin(2 pi t) for t in [0, 1], each within 1.5 ulp. */
LANES_INLINE void LANES(circle)(lanes_d *c, lanes_d *s, lanes_d t)
{
    LANES(sincospi_near)(s, c, 2.0 * t);
}

/* The concentric map of the unit square to the unit disk: see buffon_disk_concentric. With the
 * larger of |a|, |b| as the radius the angle from its axis is (pi/4) small / big, an eighth of a
 * turn at most, which needs no reduction. The branches of the four triangles become two choices:
 * which is big, and which of sine and cosine goes with which coordinate. */
LANES_INLINE void LANES(concentric)(lanes_d *x, lanes_d *y, lanes_d u1, lanes_d u2)
{
    const lanes_d a = 2.0 * u1 - 1.0, b = 2.0 * u2 - 1.0, zero = lanes_all(0);
    const lanes_m flat = lanes_less(lanes_abs(b), lanes_abs(a));
    const lanes_d big = lanes_pick(flat, a, b), small = lanes_pick(flat, b, a);
    const lanes_d quarter = 0.25 * (small / big);
    const lanes_d angle = lanes_pick(lanes_equal(big, zero), zero, quarter);
    const lanes_d s = lanes_copysign(LANES(sin_core)(angle), angle), c = LANES(cos_core)(angle);
    const lanes_d rim = lanes_all(CIRCLE_RIM);
    const lanes_d r = lanes_max(-rim, lanes_min(rim, big));
    *x = r * lanes_pick(flat, c, s);
    *y = r * lanes_pick(flat, s, c);
}

/* Turns vectors from coordinates in the frame of frame.h to those of the world. */
LANES_INLINE void LANES(turn)(lanes_d *x, lanes_d *y, lanes_d *z, const double f[FRAME_SIZE])
{
    const lanes_d t = *x, b = *y, a = *z;
    *x = t * f[0] + b * f[3] + a * f[6];
    *y = t * f[1] + b * f[4] + a * f[7];
    *z = t * f[2] + b * f[5] + a * f[8];
}

/* Stores such vectors at i of three rows; a frame of NULL leaves the axis at +z. */
LANES_INLINE void LANES(store_turned)(double *const row[3], size_t i, size_t n, lanes_d x,
                                      lanes_d y, lanes_d z, const double *frame)
{
    if (frame != NULL)
        LANES(turn)(&x, &y, &z, frame);
    lanes_store(row[0] + i, x, n - i);
    lanes_store(row[1] + i, y, n - i);
    lanes_store(row[2] + i, z, n - i);
}
