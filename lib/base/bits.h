/// Sets of bits: how many are in one, and runs of them. It is no part of the public API, as it asks
/// for a builtin of GCC and clang.
#ifndef SL_BITS_H
#define SL_BITS_H

#include "sightline/support.h"

/// The bits of a word. Without a call, as processors that count bits themselves are not taken for
/// granted.
static inline uint32_t sli_word_count(uint64_t bits) {
    bits -= bits >> 1 & 0x5555555555555555;
    bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
    return (uint32_t)(((bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56);
}

/// The word `word` of a set that has the numbers from `first` up to `stop`, without it. Some of
/// them are in the word.
static inline sl_bits sli_bits_run(size_t word, size_t first, size_t stop) {
    sl_bits bits = ~(sl_bits)0;
    if (first > word * 64) bits &= ~(sl_bits)0 << first % 64;
    if (stop < word * 64 + 64) bits &= ~(~(sl_bits)0 << stop % 64);
    return bits;
}

/// Adds the numbers from `first` up to `stop`, without it.
static inline void sli_bits_add_run(sl_bits *set, size_t first, size_t stop) {
    for (size_t w = first / 64; w * 64 < stop; w++) set[w] |= sli_bits_run(w, first, stop);
}

static inline uint64_t sli_bits_count(const sl_bits *set, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += sli_word_count(set[i]);
    return count;
}

/// The next number from `at` on that is in the set, or is not; `count` where none is.
static inline size_t sli_bits_next(const sl_bits *set, size_t count, size_t at, bool in) {
    const sl_bits flip = in ? 0 : ~(sl_bits)0;
    if (at >= count) return count;
    size_t w = at / 64;
    sl_bits rest = (set[w] ^ flip) & ~(sl_bits)0 << at % 64;
    while (!rest && ++w * 64 < count) rest = set[w] ^ flip;
    const size_t found = rest ? w * 64 + (size_t)__builtin_ctzll(rest) : count;
    return found < count ? found : count;
}

#endif
