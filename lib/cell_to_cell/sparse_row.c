#include "cell_to_cell/sparse_row.h"

#include <string.h>

void sl_sparse_row_destroy(sl_context *context, sl_sparse_row *row) {
    sl_free(context, row->words);
    *row = (sl_sparse_row){0};
}

/// Counts what a row takes more; false where that is too much.
static bool spend(sl_row_budget *budget, uint64_t bytes) {
    return atomic_fetch_add(&budget->used, bytes) + bytes <= budget->most;
}

static sl_status fail_budget(sl_context *context, const sl_row_budget *budget) {
    return sl_fail(context, SL_NO_MEMORY,
                   "the visible sets take more than the %.1f MiB that they may: allow more memory, "
                   "or bake in parts",
                   (double)budget->most / (1 << 20));
}

static sl_status make_room(sl_context *context, sl_sparse_row *row, uint32_t more,
                           sl_row_budget *budget) {
    const uint32_t needed = row->count + more;
    if (needed <= row->room) return SL_OK;
    uint32_t room = row->room + row->room / 2 + 2;
    if (room < needed) room = needed;
    if (!spend(budget, (uint64_t)(room - row->room) * SL_SPARSE_WORD_BYTES))
        return fail_budget(context, budget);
    sl_bits *words = sl_alloc(context, (size_t)room * SL_SPARSE_WORD_BYTES);
    if (!words) return SL_NO_MEMORY;
    const sl_sparse_row grown = {.words = words, .room = room, .count = row->count};
    if (row->count) {
        memcpy(grown.words, row->words, row->count * sizeof *words);
        memcpy(sl_sparse_index(&grown), sl_sparse_index(row), row->count * sizeof(uint32_t));
    }
    sl_free(context, row->words);
    *row = grown;
    return SL_OK;
}

static sl_status keep_all_words(sl_context *context, sl_sparse_row *row, size_t words,
                                sl_row_budget *budget) {
    const uint64_t before = (uint64_t)row->room * SL_SPARSE_WORD_BYTES;
    const uint64_t after = words * sizeof(sl_bits);
    // Where rows shrink by it, the difference wraps and takes off.
    if (!spend(budget, after - before)) return fail_budget(context, budget);
    sl_bits *all = sl_alloc_array(context, words, sizeof *all);
    if (!all) return SL_NO_MEMORY;
    const uint32_t *index = sl_sparse_index(row);
    for (uint32_t i = 0; i < row->count; i++) all[index[i]] = row->words[i];
    sl_free(context, row->words);
    *row = (sl_sparse_row){.words = all, .room = (uint32_t)words, .count = SL_ALL_WORDS};
    return SL_OK;
}

/// Whether so many words take less room without their indices.
static bool are_many(size_t count, size_t words) {
    return count * SL_SPARSE_WORD_BYTES >= words * sizeof(sl_bits);
}

/// The first place from `at` on whose index is not below `word`.
static uint32_t place_of(const uint32_t *index, uint32_t at, uint32_t count, size_t word) {
    uint32_t step = 1;
    while (at + step < count && index[at + step] < word) {
        at += step;
        step *= 2;
    }
    uint32_t end = at + step < count ? at + step : count;
    while (at < end) {
        const uint32_t middle = at + (end - at) / 2;
        if (index[middle] < word)
            at = middle + 1;
        else
            end = middle;
    }
    return at;
}

/// Adds to the words that the row has; the count of those that it lacks.
static uint32_t add_to_present(sl_sparse_row *row, const sl_word_set *set) {
    const uint32_t *index = sl_sparse_index(row);
    uint32_t missing = 0, at = 0;
    for (size_t word = sl_word_set_next(set, set->low); word < set->high;
         word = sl_word_set_next(set, word + 1)) {
        at = place_of(index, at, row->count, word);
        if (at < row->count && index[at] == word)
            row->words[at] |= set->bits[word];
        else
            missing++;
    }
    return missing;
}

/// Moves what is there towards the end and puts what is missing between, from the end on.
static void insert_missing(sl_sparse_row *row, const sl_word_set *set, uint32_t missing) {
    uint32_t *index = sl_sparse_index(row);
    uint32_t from = row->count, to = from + missing;
    size_t word = sl_word_set_before(set, set->high);
    row->count = to;
    while (to > from) {
        to--;
        if (from && index[from - 1] >= word) {
            if (index[--from] == word) word = sl_word_set_before(set, word);
            index[to] = index[from];
            row->words[to] = row->words[from];
        } else {
            index[to] = (uint32_t)word;
            row->words[to] = set->bits[word];
            word = sl_word_set_before(set, word);
        }
    }
}

static void add_to_all(sl_sparse_row *row, const sl_word_set *set) {
    sl_bits *restrict words = row->words;
    const sl_bits *restrict bits = set->bits;
    for (size_t i = set->low; i < set->high; i++) words[i] |= bits[i];
}

sl_status sl_sparse_row_add(sl_context *context, sl_sparse_row *row, size_t words,
                            const sl_word_set *set, sl_row_budget *budget) {
    if (row->count != SL_ALL_WORDS) {
        const uint32_t missing = add_to_present(row, set);
        if (!missing) return SL_OK;
        if (!are_many(row->count + missing, words)) {
            SL_TRY(make_room(context, row, missing, budget));
            insert_missing(row, set, missing);
            return SL_OK;
        }
        SL_TRY(keep_all_words(context, row, words, budget));
    }
    add_to_all(row, set);
    return SL_OK;
}

sl_bits *sl_sparse_row_find(const sl_sparse_row *row, size_t word, uint32_t *cursor) {
    if (row->count == SL_ALL_WORDS) return &row->words[word];
    if (!row->count) return NULL;
    const uint32_t *index = sl_sparse_index(row);
    *cursor = place_of(index, *cursor, row->count, word);
    return *cursor < row->count && index[*cursor] == word ? &row->words[*cursor] : NULL;
}

sl_status sl_sparse_row_add_word(sl_context *context, sl_sparse_row *row, size_t words, size_t word,
                                 sl_bits bits, sl_row_budget *budget) {
    uint32_t at = 0;
    sl_bits *found = sl_sparse_row_find(row, word, &at);
    if (!found && are_many(row->count + 1, words)) {
        SL_TRY(keep_all_words(context, row, words, budget));
        found = &row->words[word];
    }
    if (found) {
        *found |= bits;
        return SL_OK;
    }
    SL_TRY(make_room(context, row, 1, budget));
    uint32_t *index = sl_sparse_index(row);
    const size_t behind = row->count - at;
    memmove(index + at + 1, index + at, behind * sizeof *index);
    memmove(row->words + at + 1, row->words + at, behind * sizeof *row->words);
    index[at] = (uint32_t)word;
    row->words[at] = bits;
    row->count++;
    return SL_OK;
}

void sl_sparse_row_add_to(const sl_sparse_row *row, size_t words, sl_word_set *set) {
    const bool all = row->count == SL_ALL_WORDS;
    const uint32_t *index = all || !row->count ? NULL : sl_sparse_index(row);
    for (size_t i = 0; i < (all ? words : row->count); i++)
        if (row->words[i]) sl_word_set_join(set, all ? i : index[i], row->words[i]);
}
