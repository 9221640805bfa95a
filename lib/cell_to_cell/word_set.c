#include "cell_to_cell/word_set.h"

sl_status sl_word_set_create(sl_context *context, size_t count, sl_word_set *set) {
    const size_t words = sl_bits_words(count);
    *set = (sl_word_set){.low = SIZE_MAX};
    set->bits = sl_alloc_array(context, words, sizeof *set->bits);
    set->used = sl_alloc_array(context, sl_bits_words(words), sizeof *set->used);
    if (set->bits && set->used) return SL_OK;
    sl_word_set_destroy(context, set);
    return SL_NO_MEMORY;
}

void sl_word_set_destroy(sl_context *context, sl_word_set *set) {
    sl_free(context, set->bits);
    sl_free(context, set->used);
    *set = (sl_word_set){0};
}

void sl_word_set_clear(sl_word_set *set) {
    if (set->low < set->high) {
        for (size_t word = sl_word_set_next(set, set->low); word < set->high;
             word = sl_word_set_next(set, word + 1))
            set->bits[word] = 0;
        for (size_t i = set->low / 64; i < sl_bits_words(set->high); i++) set->used[i] = 0;
    }
    set->low = SIZE_MAX;
    set->high = 0;
}
