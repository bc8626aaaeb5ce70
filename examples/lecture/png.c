/* PNG: a signature and three chunks. Each row of pixels is replaced by its differences from what is
 * left of it and above it, by whichever of five predictions leaves the least; smooth shading turns
 * into small numbers, and deflate does the rest. See the PNG specification, sections 5 and 9. */
#include "png.h"

#include <stdint.h>
#include <stdlib.h>

static void png_big_endian(unsigned char four[4], uint32_t v)
{
    for (int i = 0; i < 4; i++)
        four[i] = (unsigned char)(v >> (24 - 8 * i));
}

/* The chunk's checksum: the remainder of its bits by a polynomial of degree 32. */
static uint32_t png_crc(const unsigned char *bytes, size_t n)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < n; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

static void png_chunk(text *out, const char type[4], const void *data, size_t n)
{
    text body = {0};
    unsigned char number[4];
    text_bytes(&body, type, 4);
    text_bytes(&body, data, n);
    png_big_endian(number, (uint32_t)n);
    text_bytes(out, number, 4);
    text_bytes(out, body.bytes, body.length);
    png_big_endian(number, png_crc((const unsigned char *)body.bytes, body.length));
    text_bytes(out, number, 4);
    text_free(&body);
}

/* Paeth's predictor: of left, up and corner, the one nearest to left + up - corner. */
static int png_paeth(int left, int up, int corner)
{
    int to_left = abs(up - corner), to_up = abs(left - corner);
    int to_corner = abs(left + up - 2 * corner);
    if (to_left <= to_up && to_left <= to_corner)
        return left;
    return to_up <= to_corner ? up : corner;
}

static int png_predict(int filter, int left, int up, int corner)
{
    switch (filter) {
    case 1: return left;
    case 2: return up;
    case 3: return (left + up) / 2;
    case 4: return png_paeth(left, up, corner);
    default: return 0;
    }
}

/* One row by one filter; returns the sum of the magnitudes left over. */
static uint64_t png_filter(unsigned char *out, int filter, const unsigned char *row,
                           const unsigned char *above, size_t bytes)
{
    uint64_t left_over = 0;
    out[0] = (unsigned char)filter;
    for (size_t i = 0; i < bytes; i++) {
        int left = i >= 3 ? row[i - 3] : 0;
        int up = above != NULL ? above[i] : 0;
        int corner = above != NULL && i >= 3 ? above[i - 3] : 0;
        int difference = (row[i] - png_predict(filter, left, up, corner)) & 255;
        out[i + 1] = (unsigned char)difference;
        left_over += (uint64_t)(difference < 128 ? difference : 256 - difference);
    }
    return left_over;
}

void png_write(text *out, const unsigned char *rgb, size_t width, size_t height)
{
    static const unsigned char signature[8] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    unsigned char header[13] = {0};
    size_t bytes = 3 * width;
    text rows = {0}, packed = {0};
    unsigned char *row = need_memory(bytes + 1);

    for (size_t y = 0; y < height; y++) {
        const unsigned char *here = rgb + y * bytes, *above = y > 0 ? here - bytes : NULL;
        uint64_t least = UINT64_MAX;
        int best = 0;
        for (int filter = 0; filter < 5; filter++) {
            uint64_t left_over = png_filter(row, filter, here, above, bytes);
            if (left_over < least) {
                least = left_over;
                best = filter;
            }
        }
        png_filter(row, best, here, above, bytes);
        text_bytes(&rows, row, bytes + 1);
    }
    deflate_write(&packed, (const unsigned char *)rows.bytes, rows.length);

    png_big_endian(header, (uint32_t)width);
    png_big_endian(header + 4, (uint32_t)height);
    header[8] = 8; /* bits a sample */
    header[9] = 2; /* red, green, blue */
    text_bytes(out, signature, sizeof signature);
    png_chunk(out, "IHDR", header, sizeof header);
    png_chunk(out, "IDAT", packed.bytes, packed.length);
    png_chunk(out, "IEND", NULL, 0);
    free(row);
    text_free(&packed);
    text_free(&rows);
}
