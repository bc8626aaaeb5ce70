/* PNG files: 8-bit RGB, filtered row by row, deflated with one dynamic Huffman block. */
#ifndef LECTURE_PNG_H
#define LECTURE_PNG_H

#include "text.h"

/* Appends a whole PNG file. rgb[3 * width * height], top row first. */
void png_write(text *out, const unsigned char *rgb, size_t width, size_t height);

/* Appends a zlib stream (RFC 1950, 1951) of the bytes. */
void deflate_write(text *out, const unsigned char *bytes, size_t n);

#endif
