/* Deflate (RFC 1951): repeats are replaced by (length, distance), then every symbol by a prefix
 * code made for this very data. One block with dynamic codes; simple before small. */
#include "png.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define DEFLATE_LITERALS 286 /* 256 bytes, the end, 29 classes of lengths */
#define DEFLATE_DISTANCES 30
#define DEFLATE_END 256
#define DEFLATE_WINDOW 32768
#define DEFLATE_LONGEST 258
#define DEFLATE_HASHES 32768
#define DEFLATE_TRIES 48

/* A symbol of the first pass: a byte (distance 0), or a repeat. */
typedef struct deflate_token {
    uint16_t value; /* byte or length */
    uint16_t distance;
} deflate_token;

typedef struct deflate_code {
    uint8_t length[DEFLATE_LITERALS];
    uint16_t bits[DEFLATE_LITERALS];
} deflate_code;

typedef struct deflate_bits {
    text *out;
    uint64_t held;
    int count;
} deflate_bits;

static void deflate_put(deflate_bits *b, uint32_t value, int count)
{
    b->held |= (uint64_t)value << b->count;
    for (b->count += count; b->count >= 8; b->count -= 8) {
        unsigned char byte = (unsigned char)b->held;
        text_bytes(b->out, &byte, 1);
        b->held >>= 8;
    }
}

/* Lengths 3..258 fall into 29 classes, distances 1..32768 into 30; each class has extra bits. Both
 * tables double their step every few classes. */
static int deflate_length_class(int length, int *extra, int *rest)
{
    int base = 3, class = 0;
    if (length == DEFLATE_LONGEST) {
        *extra = *rest = 0;
        return 28;
    }
    for (;; class++) {
        *extra = class < 8 ? 0 : class / 4 - 1;
        if (length < base + (1 << *extra))
            break;
        base += 1 << *extra;
    }
    *rest = length - base;
    return class;
}

static int deflate_distance_class(int distance, int *extra, int *rest)
{
    int base = 1, class = 0;
    for (;; class++) {
        *extra = class < 4 ? 0 : class / 2 - 1;
        if (distance < base + (1 << *extra))
            break;
        base += 1 << *extra;
    }
    *rest = distance - base;
    return class;
}

static unsigned deflate_hash(const unsigned char *p)
{
    unsigned three = (unsigned)p[0] | (unsigned)p[1] << 8 | (unsigned)p[2] << 16;
    return (three * 2654435761u) >> 17 & (DEFLATE_HASHES - 1);
}

/* First pass: at each place the longest repeat of what came within the window before. Places with
 * the same three bytes hang on one chain. */
static size_t deflate_tokens(deflate_token *token, const unsigned char *in, size_t n)
{
    size_t count = 0, *head = need_memory(DEFLATE_HASHES * sizeof *head);
    size_t *previous = need_memory(DEFLATE_WINDOW * sizeof *previous);
    memset(head, 0, DEFLATE_HASHES * sizeof *head); /* places are stored plus one; 0 is none */
    memset(previous, 0, DEFLATE_WINDOW * sizeof *previous);
    for (size_t i = 0; i < n;) {
        size_t longest = 0, distance = 0;
        size_t most = n - i < DEFLATE_LONGEST ? n - i : DEFLATE_LONGEST;
        size_t at = most >= 3 ? head[deflate_hash(in + i)] : 0;
        for (int tries = 0; tries < DEFLATE_TRIES; tries++) {
            if (at == 0 || i - (at - 1) >= DEFLATE_WINDOW)
                break;
            size_t same = 0;
            while (same < most && in[at - 1 + same] == in[i + same])
                same++;
            if (same > longest) {
                longest = same;
                distance = i - (at - 1);
            }
            at = previous[(at - 1) % DEFLATE_WINDOW];
        }
        int repeat = longest > 3 || (longest == 3 && distance < 4096);
        token[count].value = (uint16_t)(repeat ? longest : in[i]);
        token[count++].distance = (uint16_t)(repeat ? distance : 0);
        for (size_t end = i + (repeat ? longest : 1); i < end; i++)
            if (i + 3 <= n) {
                unsigned h = deflate_hash(in + i);
                previous[i % DEFLATE_WINDOW] = head[h];
                head[h] = i + 1;
            }
    }
    free(previous);
    free(head);
    return count;
}

/* Huffman's code: join the two rarest until one is left; a symbol's length is its depth. If that
 * is deeper than `most`, rare symbols are made less rare and it is tried again. */
static void deflate_lengths(uint8_t *length, const uint32_t *frequency, int n, int most)
{
    uint32_t weight[2 * DEFLATE_LITERALS];
    int parent[2 * DEFLATE_LITERALS] = {0};
    for (int flatten = 0;; flatten++) {
        int nodes = n, deepest = 0;
        for (int i = 0; i < n; i++)
            weight[i] = frequency[i] > 0 ? (frequency[i] >> flatten) + 1 : 0;
        for (;;) {
            int a = -1, b = -1; /* the rarest and the next */
            for (int i = 0; i < nodes; i++) {
                if (weight[i] == 0)
                    continue;
                if (a < 0 || weight[i] < weight[a]) {
                    b = a;
                    a = i;
                } else if (b < 0 || weight[i] < weight[b]) {
                    b = i;
                }
            }
            if (b < 0)
                break;
            parent[a] = parent[b] = nodes;
            weight[nodes++] = weight[a] + weight[b];
            weight[a] = weight[b] = 0;
        }
        for (int i = 0; i < n; i++) {
            int depth = 0;
            if (frequency[i] > 0 && nodes > n)
                for (int k = i; k != nodes - 1; k = parent[k])
                    depth++;
            length[i] = (uint8_t)(frequency[i] > 0 && depth == 0 ? 1 : depth);
            deepest = depth > deepest ? depth : deepest;
        }
        if (deepest <= most)
            return;
    }
}

/* The canonical code of these lengths, bits reversed as deflate sends them. */
static void deflate_make_code(deflate_code *code, const uint32_t *frequency, int n, int most)
{
    unsigned next = 0;
    deflate_lengths(code->length, frequency, n, most);
    for (int length = 1; length <= most; length++, next <<= 1)
        for (int i = 0; i < n; i++)
            if (code->length[i] == length) {
                unsigned reversed = 0;
                for (int bit = 0; bit < length; bit++)
                    reversed |= (next >> bit & 1u) << (length - 1 - bit);
                code->bits[i] = (uint16_t)reversed;
                next++;
            }
}

/* Both codes' lengths, themselves sent by a code (without its run lengths: a page has other bytes
 * to save). */
static void deflate_send_codes(deflate_bits *b, const deflate_code *literal,
                               const deflate_code *distance)
{
    static const int order[19] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                  11, 4,  12, 3, 13, 2, 14, 1, 15};
    deflate_code lengths = {{0}, {0}};
    uint32_t frequency[19] = {0};
    for (int i = 0; i < DEFLATE_LITERALS; i++)
        frequency[literal->length[i]]++;
    for (int i = 0; i < DEFLATE_DISTANCES; i++)
        frequency[distance->length[i]]++;
    deflate_make_code(&lengths, frequency, 19, 7);

    deflate_put(b, DEFLATE_LITERALS - 257, 5);
    deflate_put(b, DEFLATE_DISTANCES - 1, 5);
    deflate_put(b, 19 - 4, 4);
    for (int i = 0; i < 19; i++)
        deflate_put(b, lengths.length[order[i]], 3);
    for (int i = 0; i < DEFLATE_LITERALS; i++)
        deflate_put(b, lengths.bits[literal->length[i]], lengths.length[literal->length[i]]);
    for (int i = 0; i < DEFLATE_DISTANCES; i++)
        deflate_put(b, lengths.bits[distance->length[i]], lengths.length[distance->length[i]]);
}

/* Second pass: count the symbols, make the codes, send the codes, send the symbols. */
static void deflate_block(deflate_bits *b, const deflate_token *token, size_t count)
{
    uint32_t literals[DEFLATE_LITERALS] = {0}, distances[DEFLATE_DISTANCES] = {0};
    deflate_code literal = {{0}, {0}}, distance = {{0}, {0}};
    int extra, rest;
    literals[DEFLATE_END] = 1;
    distances[0] = 1; /* a code needs a symbol */
    for (size_t i = 0; i < count; i++) {
        if (token[i].distance == 0) {
            literals[token[i].value]++;
        } else {
            literals[257 + deflate_length_class(token[i].value, &extra, &rest)]++;
            distances[deflate_distance_class(token[i].distance, &extra, &rest)]++;
        }
    }
    deflate_make_code(&literal, literals, DEFLATE_LITERALS, 15);
    deflate_make_code(&distance, distances, DEFLATE_DISTANCES, 15);

    deflate_put(b, 1, 1); /* the last block, */
    deflate_put(b, 2, 2); /* with codes of its own */
    deflate_send_codes(b, &literal, &distance);
    for (size_t i = 0; i < count; i++) {
        if (token[i].distance == 0) {
            deflate_put(b, literal.bits[token[i].value], literal.length[token[i].value]);
            continue;
        }
        int class = 257 + deflate_length_class(token[i].value, &extra, &rest);
        deflate_put(b, literal.bits[class], literal.length[class]);
        deflate_put(b, (uint32_t)rest, extra);
        class = deflate_distance_class(token[i].distance, &extra, &rest);
        deflate_put(b, distance.bits[class], distance.length[class]);
        deflate_put(b, (uint32_t)rest, extra);
    }
    deflate_put(b, literal.bits[DEFLATE_END], literal.length[DEFLATE_END]);
    deflate_put(b, 0, b->count > 0 ? 8 - b->count : 0);
}

void deflate_write(text *out, const unsigned char *bytes, size_t n)
{
    static const unsigned char header[2] = {0x78, 0x9c};
    deflate_bits b = {out, 0, 0};
    deflate_token *token = need_memory((n + 1) * sizeof *token);
    uint32_t low = 1, high = 0; /* Adler's checksum */
    unsigned char checksum[4];

    text_bytes(out, header, sizeof header);
    deflate_block(&b, token, deflate_tokens(token, bytes, n));
    for (size_t i = 0; i < n; i++) {
        low = (low + bytes[i]) % 65521;
        high = (high + low) % 65521;
    }
    for (int i = 0; i < 4; i++)
        checksum[i] = (unsigned char)((high << 16 | low) >> (24 - 8 * i));
    text_bytes(out, checksum, sizeof checksum);
    free(token);
}
