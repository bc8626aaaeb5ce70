/* Layer 0. How a name of buffon is declared: linkage, visibility, checks of the compiler. */
#ifndef BUFFON_API_H
#define BUFFON_API_H

#include <stddef.h>
#include <stdint.h>

/* The names of this library and no others leave the shared object. */
#if defined(__GNUC__) || defined(__clang__)
#define BUFFON_API __attribute__((visibility("default")))
#define BUFFON_CHECK __attribute__((warn_unused_result))
#else
#define BUFFON_API
#define BUFFON_CHECK
#endif

#ifdef __cplusplus
#define BUFFON_BEGIN extern "C" {
#define BUFFON_END }
#else
#define BUFFON_BEGIN
#define BUFFON_END
#endif

#endif
