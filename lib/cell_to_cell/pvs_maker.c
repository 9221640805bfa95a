#include "cell_to_cell/pvs_maker.h"

sl_status sl_pvs_maker_create(sl_context *context, uint32_t members, uint32_t rows,
                              sl_pvs_maker *maker) {
    *maker = (sl_pvs_maker){.count = rows};
    SL_TRY(sl_word_set_create(context, members, &maker->row));
    maker->offsets = sl_alloc_array(context, (size_t)rows + 1, sizeof *maker->offsets);
    return maker->offsets ? SL_OK : SL_NO_MEMORY;
}

void sl_pvs_maker_destroy(sl_context *context, sl_pvs_maker *maker) {
    sl_word_set_destroy(context, &maker->row);
    sl_free(context, maker->offsets);
    sl_free(context, maker->bytes.items);
    sl_free(context, maker->words.items);
    sl_free(context, maker->places.items);
    *maker = (sl_pvs_maker){0};
}

/// The bits of a word that are members `first` .. `end` - 1.
static sl_bits bits_between(size_t word, uint32_t first, uint32_t end) {
    sl_bits bits = ~(sl_bits)0;
    if (first / 64 == word) bits &= ~(sl_bits)0 << (first % 64);
    if (end / 64 == word) bits &= ~(~(sl_bits)0 << (end % 64));
    return bits;
}

void sl_word_set_add_row(sl_word_set *set, const sl_pvs *pvs, uint32_t cell) {
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (size_t word = run.first / 64; word < sl_bits_words(run.end); word++)
            sl_word_set_join(set, word, bits_between(word, run.first, run.end));
}

void sl_word_set_add_common(sl_word_set *set, const sl_pvs *pvs, uint32_t cell,
                            const sl_word_set *other) {
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);) {
        const size_t end = sl_bits_words(run.end);
        for (size_t word = sl_word_set_next(other, run.first / 64);
             word < end && word < other->high; word = sl_word_set_next(other, word + 1)) {
            const sl_bits bits = other->bits[word] & bits_between(word, run.first, run.end);
            if (bits) sl_word_set_join(set, word, bits);
        }
    }
}

void sl_pvs_maker_add(sl_pvs_maker *maker, const sl_pvs *pvs, uint32_t cell) {
    sl_word_set_add_row(&maker->row, pvs, cell);
}

sl_status sl_pvs_maker_end_row(sl_context *context, sl_pvs_maker *maker) {
    const sl_word_set *row = &maker->row;
    maker->words.count = maker->places.count = 0;
    for (size_t word = sl_word_set_next(row, row->low); word < row->high;
         word = sl_word_set_next(row, word + 1)) {
        SL_TRY(SL_ARRAY_ROOM(context, &maker->words, 1));
        SL_TRY(SL_ARRAY_ROOM(context, &maker->places, 1));
        maker->words.items[maker->words.count++] = row->bits[word];
        maker->places.items[maker->places.count++] = (uint32_t)word;
        maker->pairs += (uint64_t)__builtin_popcountll(row->bits[word]);
    }
    SL_TRY(sl_row_append_words(context, &maker->bytes, maker->words.items, maker->places.items,
                               maker->words.count));
    maker->offsets[++maker->made] = maker->bytes.count;
    sl_word_set_clear(&maker->row);
    return SL_OK;
}

sl_status sl_pvs_maker_finish(sl_context *context, sl_pvs_maker *maker, sl_pvs *out) {
    SL_TRY(SL_ARRAY_ROOM(context, &maker->bytes, 1)); // never NULL, also where no row has any
    *out = (sl_pvs){
        .cell_count = maker->count, .offsets = maker->offsets, .bytes = maker->bytes.items};
    maker->offsets = NULL;
    maker->bytes.items = NULL;
    return SL_OK;
}
