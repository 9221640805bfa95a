/// CRC-32, sixteen bytes at a step ("slicing by 16": Kounavis and Berry, A Systematic Approach to
/// Building High Performance Software-Based CRC Generators, 2005).
///
/// The state is the remainder of the bytes so far, divided by the polynomial. table[0][b] is what a
/// byte b adds to the remainder, table[k][b] what it adds when k more bytes follow. So the
/// sixteen parts of a step do not wait for each other. The tables take some microseconds to make
/// and live in the sum: nothing is shared between threads.
#include "base/base.h"

#define POLYNOMIAL 0xedb88320u // bits reversed

void sli_checksum_begin(sli_checksum *sum) {
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t value = i;
        for (int bit = 0; bit < 8; bit++) value = value >> 1 ^ (value & 1 ? POLYNOMIAL : 0);
        sum->table[0][i] = value;
    }
    for (int k = 1; k < 16; k++)
        for (uint32_t i = 0; i < 256; i++) {
            const uint32_t before = sum->table[k - 1][i];
            sum->table[k][i] = before >> 8 ^ sum->table[0][before & 255];
        }
    sum->state = UINT32_MAX;
}

/// Four bytes, the lowest first on every machine.
static uint32_t four(const unsigned char *at) {
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/// What four bytes add, of which the last is followed by `k` more in the step.
static inline uint32_t part(uint32_t (*t)[256], uint32_t bytes, int k) {
    return t[k + 3][bytes & 255] ^ t[k + 2][bytes >> 8 & 255] ^ t[k + 1][bytes >> 16 & 255] ^
           t[k][bytes >> 24];
}

void sli_checksum_add(sli_checksum *sum, const void *bytes, size_t count) {
    const unsigned char *at = bytes;
    uint32_t(*const t)[256] = sum->table;
    uint32_t state = sum->state;
    for (; count >= 16; count -= 16, at += 16)
        state = part(t, state ^ four(at), 12) ^ part(t, four(at + 4), 8) ^
                part(t, four(at + 8), 4) ^ part(t, four(at + 12), 0);
    for (; count; count--) state = t[0][(state ^ *at++) & 255] ^ state >> 8;
    sum->state = state;
}

uint32_t sli_checksum_value(const sli_checksum *sum) {
    return ~sum->state;
}
