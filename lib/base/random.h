/// A small seeded generator, the same on every machine (SplitMix64, Steele, Lea & Flood 2014).
#ifndef SL_RANDOM_H
#define SL_RANDOM_H

#include <stdint.h>

typedef struct sl_random {
    uint64_t state;
} sl_random;

static inline uint64_t sl_random_next(sl_random *random) {
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/// Uniform in 0 .. bound - 1, up to a bias below bound / 2^64.
static inline uint64_t sl_random_below(sl_random *random, uint64_t bound) {
    return sl_random_next(random) % bound;
}

/// Uniform in [0, 1), 53 bits.
static inline double sl_random_unit(sl_random *random) {
    return (double)(sl_random_next(random) >> 11) * 0x1p-53;
}

#endif
