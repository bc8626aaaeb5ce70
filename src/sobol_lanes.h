/* Private. Kernels of sobol.c: included by levels.h, once for each level.
 *
 * A chunk of 64 points at a time. For the nested scramble the chunk is what makes vectors pay: its
 * points share all bits below the top six, so they pass through nodes of the same number, and one
 * hash of 64 bits says for all of them whether bit b is flipped. The hashes of many b are made side
 * by side; turned like a matrix they are the flips of each point.
 */

/* ---- words and uniforms ---- */

LANES_INLINE void LANES(sobol_put)(unsigned char *out, const sobol_row *row, uint64_t word,
                                   int what)
{
    for (size_t t = 0; t < SOBOL_CHUNK; t += LANES_WIDTH) {
        lanes_u leaf;
        memcpy(&leaf, &row->leaf[t], sizeof leaf);
        leaf ^= word;
        if (what == SOBOL_UNIFORMS)
            leaf = lanes_bits(lanes_uniform(leaf));
        memcpy(out + 8 * t, &leaf, sizeof leaf);
    }
}

/* ---- flips ---- */

/* H of the header. */
LANES_INLINE lanes_u LANES(sobol_hash)(lanes_u x, const uint64_t key[2])
{
    const uint64_t factor = UINT64_C(0xbea225f9eb34556d);
    x ^= key[0];
    x = (x ^ x >> 32) * factor;
    x = (x ^ x >> 29) * factor;
    x ^= key[1];
    x = (x ^ x >> 32) * factor;
    return x ^ x >> 29;
}

/* Row b of the flips: bit t of it says whether bit b of point t is flipped. Its node has the word's
 * bits above b, but for the top six, and a one at b. Bits below 8 reach no uniform. */
LANES_INLINE void LANES(sobol_flips)(lanes_u flip[], uint64_t word, const uint64_t key[2])
{
    static const uint64_t one[8] = {1, 2, 4, 8, 16, 32, 64, 128};
    for (size_t b = 0; b < SOBOL_CHUNK; b += LANES_WIDTH) {
        lanes_u node;
        if (b < 8) {
            flip[b / LANES_WIDTH] = lanes_words(0);
            continue;
        }
        memcpy(&node, &one[b % 8], sizeof node);
        node = node << (b - b % 8);
        node |= word & ~SOBOL_TOP & ~(2 * node - 1);
        flip[b / LANES_WIDTH] = LANES(sobol_hash)(node, key);
    }
}

/* ---- the matrix turned ---- */

/* Lane l takes what lane l ^ j has; j is a power of two below the number of lanes. */
LANES_INLINE lanes_u LANES(sobol_swap)(lanes_u x, size_t j)
{
#if LANES_WIDTH == 8
    if (j == 4)
        return (lanes_u)_mm512_shuffle_i64x2((__m512i)x, (__m512i)x, 0x4e);
    if (j == 2)
        return (lanes_u)_mm512_permutex_epi64((__m512i)x, 0x4e);
    return (lanes_u)_mm512_shuffle_epi32((__m512i)x, 0x4e);
#elif LANES_WIDTH == 4
    if (j == 2)
        return (lanes_u)_mm256_permute4x64_epi64((__m256i)x, 0x4e);
    return (lanes_u)_mm256_shuffle_epi32((__m256i)x, 0x4e);
#elif LANES_WIDTH == 2 && LEVELS_HAVE_X86
    (void)j;
    return (lanes_u)_mm_shuffle_epi32((__m128i)x, 0x4e);
#elif LANES_WIDTH == 2
    (void)j;
    return (lanes_u){x[1], x[0]};
#else
    (void)j;
    return x;
#endif
}

/* Exchanges the bits of row k that have bit j in their number with those of row k + j that do not,
 * for all k without bit j; `low` are the bits that do not. Here the rows are in other vectors ...
 */
LANES_INLINE void LANES(sobol_far)(lanes_u a[], size_t j, uint64_t low)
{
    const size_t far = j / LANES_WIDTH;
    for (size_t first = 0; first < SOBOL_CHUNK / LANES_WIDTH; first += 2 * far) {
        for (size_t k = first; k < first + far; k++) {
            const lanes_u t = (a[k] >> j ^ a[k + far]) & low;
            a[k + far] ^= t;
            a[k] ^= t << j;
        }
    }
}

/* ... and here they are j lanes apart. */
LANES_INLINE void LANES(sobol_near)(lanes_u a[], size_t j, uint64_t low)
{
    static const uint64_t without[3][8] = {
        {1, 0, 1, 0, 1, 0, 1, 0}, {1, 1, 0, 0, 1, 1, 0, 0}, {1, 1, 1, 1, 0, 0, 0, 0}};
    lanes_u lower;
    memcpy(&lower, without[j / 2], sizeof lower);
    lower = 0 - lower;
    for (size_t k = 0; k < SOBOL_CHUNK / LANES_WIDTH; k++) {
        const lanes_u other = LANES(sobol_swap)(a[k], j);
        const lanes_u down = other << j & ~low & lower, up = other >> j & low & ~lower;
        a[k] = (a[k] & ((low & lower) | (~low & ~lower))) | down | up;
    }
}

LANES_INLINE void LANES(sobol_exchange)(lanes_u a[], size_t j, uint64_t low)
{
    if (j >= LANES_WIDTH)
        LANES(sobol_far)(a, j, low);
    else
        LANES(sobol_near)(a, j, low);
}

/* The six exchanges turn a matrix of 64 by 64 bits about its diagonal (H. Warren, Hacker's Delight,
 * section 7-3). */
LANES_INLINE void LANES(sobol_turn)(lanes_u a[])
{
    LANES(sobol_exchange)(a, 32, UINT64_C(0x00000000ffffffff));
    LANES(sobol_exchange)(a, 16, UINT64_C(0x0000ffff0000ffff));
    LANES(sobol_exchange)(a, 8, UINT64_C(0x00ff00ff00ff00ff));
    LANES(sobol_exchange)(a, 4, UINT64_C(0x0f0f0f0f0f0f0f0f));
    LANES(sobol_exchange)(a, 2, UINT64_C(0x3333333333333333));
    LANES(sobol_exchange)(a, 1, UINT64_C(0x5555555555555555));
}

/* ---- the nested scramble ---- */

/* Lane l takes what lane l ^ turn has. */
LANES_INLINE lanes_u LANES(sobol_place)(lanes_u x, size_t turn)
{
    for (size_t j = 1; j < LANES_WIDTH; j *= 2)
        x = turn & j ? LANES(sobol_swap)(x, j) : x;
    return x;
}

LANES_INLINE void LANES(sobol_put_tree)(unsigned char *out, const sobol_row *row, uint64_t word)
{
    const size_t turn = (size_t)(word >> SOBOL_STEPS);
    lanes_u flip[SOBOL_CHUNK / LANES_WIDTH];
    LANES(sobol_flips)(flip, word, row->key);
    LANES(sobol_turn)(flip);
    for (size_t t = 0; t < SOBOL_CHUNK; t += LANES_WIDTH) {
        lanes_u leaf, u;
        memcpy(&leaf, &row->leaf[t], sizeof leaf);
        u = lanes_bits(lanes_uniform(leaf ^ ((flip[t / LANES_WIDTH] ^ word) & ~SOBOL_TOP)));
        u = LANES(sobol_place)(u, turn % LANES_WIDTH);
        memcpy(out + 8 * (t ^ (turn - turn % LANES_WIDTH)), &u, sizeof u);
    }
}

/* ---- chunks ---- */

LANES_INLINE void LANES(sobol_go)(unsigned char *out, size_t n, const sobol_row *row,
                                  uint64_t chunk, uint64_t word, int what)
{
    for (size_t i = 0; i < n; i++) {
        if (what == SOBOL_TREE)
            LANES(sobol_put_tree)(out + 8 * SOBOL_CHUNK * i, row, word);
        else
            LANES(sobol_put)(out + 8 * SOBOL_CHUNK * i, row, word, what);
        word ^= row->step[sobol_step(++chunk)];
    }
}

/* n chunks from `chunk` on, whose word is given. */
static void LANES(sobol_chunks)(unsigned char *out, size_t n, const sobol_row *row, uint64_t chunk,
                                uint64_t word, int what)
{
    if (what == SOBOL_TREE)
        LANES(sobol_go)(out, n, row, chunk, word, SOBOL_TREE);
    else if (what == SOBOL_UNIFORMS)
        LANES(sobol_go)(out, n, row, chunk, word, SOBOL_UNIFORMS);
    else
        LANES(sobol_go)(out, n, row, chunk, word, SOBOL_WORDS);
}
