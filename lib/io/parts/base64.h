/// Bytes written as text: base64 (RFC 4648).
#ifndef SL_BASE64_H
#define SL_BASE64_H

#include <stdbool.h>
#include <stddef.h>

/// Decodes a text; blanks between the characters are passed over. `out` has room for
/// 3 * (length / 4 + 1) bytes; `*size` gets how many there are. False where it is not base64:
/// `*wrong` is the number of the first wrong character, from 1, or 0 for a text that is cut off.
bool sli_base64_decode(const char *text, unsigned char *out, size_t *size, size_t *wrong);

#endif
