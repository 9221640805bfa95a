/// What sparse rows will take, told before the work starts: from what is seen from some of the
/// corners.
#include "cell_to_cell/sweep.h"

enum { CORNERS_ASKED = 256 };

/// A cell has more words than one of its corners sees, and growing rows have room to spare: over
/// generated cities, floors, mazes, caves and halls the two together come to 1.4 to 1.9.
#define WORDS_A_WORD_SEEN 1.6

static void add_cells(sl_word_set *set, const sl_reach *reach) {
    for (size_t i = 0; i < reach->cells.count; i++)
        sl_word_set_add(set, reach->cells.items[i].cell);
}

/// The words in which a row would have what is seen from the fan that was swept last.
static uint64_t count_words(const sl_sweeper *s, sl_word_set *set) {
    uint64_t count = 0;
    add_cells(set, &s->back);
    add_cells(set, &s->middle);
    add_cells(set, &s->ahead);
    for (size_t word = sl_word_set_next(set, set->low); word < set->high;
         word = sl_word_set_next(set, word + 1))
        count++;
    sl_word_set_clear(set);
    return count;
}

static sl_status ask(sl_context *context, sl_sweeper *s, sl_word_set *set, uint64_t *bytes) {
    const size_t count = s->fans->fans.count;
    const size_t asked = count < CORNERS_ASKED ? count : CORNERS_ASKED;
    uint64_t sum = 0;
    for (size_t i = 0; i < asked; i++) {
        SL_TRY(sl_sweep_fan(context, s, &s->fans->fans.items[i * count / asked]));
        sum += count_words(s, set);
    }
    const double words = asked ? WORDS_A_WORD_SEEN * (double)sum / (double)asked : 0;
    *bytes = (uint64_t)(s->fans->cell_count *
                        (words * SL_SPARSE_WORD_BYTES + (double)sizeof(sl_sparse_row)));
    return SL_OK;
}

sl_status sl_sweep_estimate(sl_context *context, const sl_fans *fans, bool closed,
                            sl_bit_rows *rows, uint64_t *bytes) {
    sl_sweeper sweeper;
    sl_word_set set = {0};
    sl_status status = sl_sweeper_create(context, fans, closed, rows, &sweeper);
    if (status == SL_OK) status = sl_word_set_create(context, fans->cell_count, &set);
    if (status == SL_OK) status = ask(context, &sweeper, &set, bytes);
    sl_bit_rows_join(context, rows, &sweeper.rows);
    sl_sweeper_destroy(context, &sweeper);
    sl_word_set_destroy(context, &set);
    return status;
}
