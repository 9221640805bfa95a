/// Four characters of six bits each are three bytes; '=' at the end stands for bytes that are not
/// there.
#include "io/parts/base64.h"

#include <stdint.h>
#include <string.h>

/// The six bits of a character, or -1.
static int six_bits(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

bool sli_base64_decode(const char *text, unsigned char *out, size_t *size, size_t *wrong) {
    uint32_t bits = 0, pads = 0;
    size_t characters = 0;
    *size = *wrong = 0;
    for (const char *at = text; *at; at++) {
        if (strchr(" \t\r\n", *at)) continue;
        const int value = six_bits(*at);
        pads += *at == '=';
        if ((value < 0 && *at != '=') || (value >= 0 && pads)) {
            *wrong = (size_t)(at - text) + 1;
            return false;
        }
        bits = bits << 6 | (value < 0 ? 0u : (uint32_t)value);
        if (++characters % 4) continue;
        for (int shift = 16; shift >= 0; shift -= 8)
            out[(*size)++] = (unsigned char)(bits >> shift);
        bits = 0;
    }
    if (characters % 4 || pads > 2 || (pads && !*size)) return false;
    *size -= pads;
    return true;
}
