/* Growing text. */
#include "text.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void give_up(const char *what, const char *why)
{
    fprintf(stderr, "\n%s: %s\n", what, why);
    exit(EXIT_FAILURE);
}

void *need_memory(size_t bytes)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    if (p == NULL)
        give_up("memory", "could not be allocated");
    return p;
}

static void text_reserve(text *t, size_t more)
{
    size_t need = t->length + more + 1;
    if (need <= t->capacity)
        return;
    size_t capacity = t->capacity < 4096 ? 4096 : t->capacity;
    while (capacity < need)
        capacity *= 2;
    char *bytes = realloc(t->bytes, capacity);
    if (bytes == NULL)
        give_up("memory", "could not be allocated");
    t->bytes = bytes;
    t->capacity = capacity;
}

void text_bytes(text *t, const void *bytes, size_t n)
{
    text_reserve(t, n);
    if (n > 0)
        memcpy(t->bytes + t->length, bytes, n);
    t->length += n;
    t->bytes[t->length] = '\0';
}

void text_put(text *t, const char *s)
{
    text_bytes(t, s, strlen(s));
}

void text_add(text *t, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length < 0)
        give_up("text", "could not be formatted");
    text_reserve(t, (size_t)length);
    vsnprintf(t->bytes + t->length, (size_t)length + 1, format, again);
    va_end(again);
    t->length += (size_t)length;
}

void text_base64(text *t, const void *bytes, size_t n)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *b = bytes;
    for (size_t i = 0; i < n; i += 3) {
        uint32_t three = (uint32_t)b[i] << 16;
        if (i + 1 < n)
            three |= (uint32_t)b[i + 1] << 8;
        if (i + 2 < n)
            three |= b[i + 2];
        char four[4] = {digit[three >> 18], digit[three >> 12 & 63], digit[three >> 6 & 63],
                        digit[three & 63]};
        if (i + 2 >= n)
            four[3] = '=';
        if (i + 1 >= n)
            four[2] = '=';
        text_bytes(t, four, 4);
    }
}

void text_free(text *t)
{
    free(t->bytes);
    *t = (text){0};
}
