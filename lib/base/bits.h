/// Sets of small numbers, a bit each.
#ifndef SL_BITS_H
#define SL_BITS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef uint64_t sl_bits;

static inline size_t sl_bits_words(size_t count) {
    return (count + 63) / 64;
}

static inline bool sl_bits_has(const sl_bits *set, size_t i) {
    return set[i / 64] >> (i % 64) & 1;
}

static inline void sl_bits_add(sl_bits *set, size_t i) {
    set[i / 64] |= (sl_bits)1 << (i % 64);
}

static inline void sl_bits_flip(sl_bits *set, size_t i) {
    set[i / 64] ^= (sl_bits)1 << (i % 64);
}

#endif
