/* Private. Kernels of rng.c: included by levels.h, once for each level.
 *
 * The 16 lanes of a row go through the registers in groups of two vectors, each group for all the
 * steps asked for, its words stored 16 apart. Two vectors hide the latency of the chain, and their
 * eight state words leave room for the temporaries in 16 registers. Rejected: vectors wider than
 * those of the machine (gcc spills them) and plain loops for the compiler to vectorise (gcc does
 * not).
 */

/* The products of the low halves: one instruction on x86, which gcc does not find by itself. */
LANES_INLINE lanes_u LANES(rng_multiply)(lanes_u a, uint32_t b)
{
#if LANES_WIDTH == 8
    return (lanes_u)_mm512_mul_epu32((__m512i)a, _mm512_set1_epi64(b));
#elif LANES_WIDTH == 4
    return (lanes_u)_mm256_mul_epu32((__m256i)a, _mm256_set1_epi64x(b));
#elif LANES_WIDTH == 2 && LEVELS_HAVE_X86
    return (lanes_u)_mm_mul_epu32((__m128i)a, _mm_set1_epi64x(b));
#else
    return (a & UINT32_MAX) * b;
#endif
}

/* Philox of a block in each lane. A counter word is the low half of its lane; what the high half
 * holds between the rounds is never looked at. */
LANES_INLINE void LANES(rng_round)(lanes_u c[4], uint32_t k0, uint32_t k1)
{
    const lanes_u p = LANES(rng_multiply)(c[0], RNG_M0), q = LANES(rng_multiply)(c[2], RNG_M1);
    c[0] = q >> 32 ^ c[1] ^ k0;
    c[1] = q;
    c[2] = p >> 32 ^ c[3] ^ k1;
    c[3] = p;
}

/* Where the lanes of a row begin: words 2h and 2h + 1 of lane l are block 2l + h of the row. The
 * two blocks of a lane go side by side, to hide the latency of the products. */
static void LANES(rng_start)(uint64_t state[4][RNG_LANES], const uint32_t k[4], uint64_t row)
{
    static const uint64_t block[RNG_LANES] = {0,  2,  4,  6,  8,  10, 12, 14,
                                              16, 18, 20, 22, 24, 26, 28, 30};
    for (size_t lane = 0; lane < RNG_LANES; lane += LANES_WIDTH) {
        lanes_u a[4], b[4], low;
        uint32_t k0 = k[0], k1 = k[1];
        memcpy(&low, &block[lane], sizeof low);
        a[0] = b[0] = lanes_words(k[2]);
        a[1] = b[1] = lanes_words(k[3]);
        a[2] = low + (uint32_t)(row << 5);
        b[2] = a[2] + 1;
        a[3] = b[3] = lanes_words((uint32_t)(row >> 27));
        for (int round = 0; round < 10; round++) {
            LANES(rng_round)(a, k0, k1);
            LANES(rng_round)(b, k0, k1);
            k0 += RNG_W0;
            k1 += RNG_W1;
        }
        for (size_t j = 0; j < 2; j++) {
            const lanes_u s = (a[2 * j] & UINT32_MAX) | a[2 * j + 1] << 32;
            const lanes_u t = (b[2 * j] & UINT32_MAX) | b[2 * j + 1] << 32;
            memcpy(&state[j][lane], &s, sizeof s);
            memcpy(&state[2 + j][lane], &t, sizeof t);
        }
    }
}

LANES_INLINE lanes_u LANES(rng_rotate)(lanes_u x, int n)
{
    return x << n | x >> (64 - n);
}

/* xoshiro256++ */
LANES_INLINE lanes_u LANES(rng_step)(lanes_u s[4])
{
    const lanes_u word = LANES(rng_rotate)(s[0] + s[3], 23) + s[0];
    const lanes_u t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = LANES(rng_rotate)(s[3], 45);
    return word;
}

LANES_INLINE void LANES(rng_put)(unsigned char *out, size_t at, lanes_u word, int what)
{
    if (what == RNG_WORDS)
        memcpy(out + at, &word, sizeof word);
    if (what == RNG_UNIFORMS) {
        const lanes_d u = lanes_uniform(word);
        memcpy(out + at, &u, sizeof u);
    }
}

LANES_INLINE void LANES(rng_steps)(unsigned char *out, uint64_t state[4][RNG_LANES], size_t steps,
                                   int what)
{
    for (size_t lane = 0; lane < RNG_LANES; lane += 2 * LANES_WIDTH) {
        lanes_u a[4], b[4];
        for (int j = 0; j < 4; j++) {
            memcpy(&a[j], &state[j][lane], sizeof a[j]);
            memcpy(&b[j], &state[j][lane + LANES_WIDTH], sizeof b[j]);
        }
        for (size_t i = 0; i < steps; i++) {
            const size_t at = 8 * (RNG_LANES * i + lane);
            LANES(rng_put)(out, at, LANES(rng_step)(a), what);
            LANES(rng_put)(out, at + 8 * LANES_WIDTH, LANES(rng_step)(b), what);
        }
        for (int j = 0; j < 4; j++) {
            memcpy(&state[j][lane], &a[j], sizeof a[j]);
            memcpy(&state[j][lane + LANES_WIDTH], &b[j], sizeof b[j]);
        }
    }
}

/* The next steps of all lanes, 16 words or uniforms each; with RNG_NOTHING they are passed over. */
static void LANES(rng_go)(unsigned char *out, uint64_t state[4][RNG_LANES], size_t steps, int what)
{
    if (what == RNG_UNIFORMS)
        LANES(rng_steps)(out, state, steps, RNG_UNIFORMS);
    else if (what == RNG_WORDS)
        LANES(rng_steps)(out, state, steps, RNG_WORDS);
    else
        LANES(rng_steps)(NULL, state, steps, RNG_NOTHING);
}
