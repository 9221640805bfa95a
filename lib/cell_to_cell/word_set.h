/// A set of cells whose members lie close together: as bits, with what finds the words that have
/// any without looking at all of them.
#ifndef SL_WORD_SET_H
#define SL_WORD_SET_H

#include "sightline/support.h"

/// To be made with sl_word_set_create and freed with sl_word_set_destroy.
typedef struct sl_word_set {
    sl_bits *bits;
    sl_bits *used;    ///< a bit a word: whether it has any
    size_t low, high; ///< words low .. high - 1 may have any, no others
} sl_word_set;

/// Empty, of cells below `count`. Zeroed on failure.
sl_status sl_word_set_create(sl_context *context, size_t count, sl_word_set *set);
void sl_word_set_destroy(sl_context *context, sl_word_set *set);

/// Adds the members of one word, not none.
static inline void sl_word_set_join(sl_word_set *set, size_t word, sl_bits bits) {
    set->bits[word] |= bits;
    sl_bits_add(set->used, word);
    if (word < set->low) set->low = word;
    if (word >= set->high) set->high = word + 1;
}

static inline void sl_word_set_add(sl_word_set *set, uint32_t cell) {
    sl_word_set_join(set, cell / 64, (sl_bits)1 << (cell % 64));
}

static inline void sl_word_set_drop(sl_word_set *set, uint32_t cell) {
    const size_t word = cell / 64;
    set->bits[word] &= ~((sl_bits)1 << (cell % 64));
    if (!set->bits[word]) set->used[word / 64] &= ~((sl_bits)1 << (word % 64));
}

/// Takes all out. Time: of the words that have any, and 1/64 of those between.
void sl_word_set_clear(sl_word_set *set);

/// The first word from `from` on that has any, set->high or more for none.
static inline size_t sl_word_set_next(const sl_word_set *set, size_t from) {
    if (from >= set->high) return set->high;
    size_t at = from / 64;
    const size_t end = sl_bits_words(set->high);
    sl_bits some = set->used[at] >> (from % 64) << (from % 64);
    while (!some && ++at < end) some = set->used[at];
    return some ? at * 64 + (size_t)__builtin_ctzll(some) : set->high;
}

/// The last word before `end` that has any, SIZE_MAX for none.
static inline size_t sl_word_set_before(const sl_word_set *set, size_t end) {
    if (end <= set->low) return SIZE_MAX;
    size_t at = (end - 1) / 64;
    const size_t first = set->low / 64, above = 63 - (end - 1) % 64;
    sl_bits some = set->used[at] << above >> above;
    while (!some && at-- > first) some = set->used[at];
    return some ? at * 64 + 63 - (size_t)__builtin_clzll(some) : SIZE_MAX;
}

#endif
