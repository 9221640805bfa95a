/// How many are in a set of bits. It is no part of the public API, as it asks for a builtin of GCC
/// and clang.
#ifndef SL_BITS_H
#define SL_BITS_H

#include "sightline/support.h"

static inline uint64_t sli_bits_count(const sl_bits *set, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(set[i]);
    return count;
}

#endif
