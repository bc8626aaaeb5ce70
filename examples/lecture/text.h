/* Growing text: what the page, the figures and the pictures are written into. */
#ifndef LECTURE_TEXT_H
#define LECTURE_TEXT_H

#include <stddef.h>

#if defined(__GNUC__) || defined(__clang__)
#define TEXT_PRINTF(which, first) __attribute__((format(printf, which, first), nonnull))
#else
#define TEXT_PRINTF(which, first)
#endif

/* {0} is empty. Ends with a NUL that `length` does not count; binary bytes are allowed too. */
typedef struct text {
    char *bytes;
    size_t length, capacity;
} text;

void text_add(text *t, const char *format, ...) TEXT_PRINTF(2, 3);
void text_put(text *t, const char *s);                        /* as it stands */
void text_bytes(text *t, const void *bytes, size_t n);        /* as they stand */
void text_base64(text *t, const void *bytes, size_t n);       /* for a data: address */
void text_free(text *t);

/* Ends the program with a message: an example has nobody to report to. */
void give_up(const char *what, const char *why);

/* malloc or the end. */
void *need_memory(size_t bytes);

#endif
