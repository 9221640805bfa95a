/// Rows of bits, dense or sparse, and how they are added to, made symmetric and encoded.
///
/// A sparse row is a sorted list of words with their indices. A set is added to it in two passes:
/// the first joins the words that both have and counts the missing ones, the second makes room and
/// inserts these from the end on. A row with many words drops its indices and keeps all words.
///
/// Threads add to dense rows of their own, which are joined by OR at the end. They add to sparse
/// rows in place, under locks that many rows share.
///
/// Rows are made symmetric in blocks of 64 rows by one word. A block is turned over its diagonal in
/// registers, in six rounds that swap ever smaller parts (Warren 2003, Hacker's Delight, section
/// 7-3).
#include "cell_to_cell/rows.h"

#include "base/bits.h"
#include "cell_to_cell/pvs_rows.h"
#include "sightline/support.h"

#include <pthread.h>
#include <string.h>

// --- sets of cells

sl_status sli_word_set_create(sl_context *context, size_t count, sli_word_set *set) {
    const size_t words = sl_bits_words(count);
    *set = (sli_word_set){.low = SIZE_MAX};
    set->bits = sl_alloc_array(context, words, sizeof *set->bits);
    set->used = sl_alloc_array(context, sl_bits_words(words), sizeof *set->used);
    if (set->bits && set->used) return SL_OK;
    sli_word_set_destroy(context, set);
    return SL_NO_MEMORY;
}

void sli_word_set_destroy(sl_context *context, sli_word_set *set) {
    sl_free(context, set->bits);
    sl_free(context, set->used);
    *set = (sli_word_set){0};
}

void sli_word_set_clear(sli_word_set *set) {
    if (set->low < set->high) {
        for (size_t word = sli_word_set_next(set, set->low); word < set->high;
             word = sli_word_set_next(set, word + 1))
            set->bits[word] = 0;
        for (size_t i = set->low / 64; i < sl_bits_words(set->high); i++) set->used[i] = 0;
    }
    set->low = SIZE_MAX;
    set->high = 0;
}

// --- rows with few members

void sli_sparse_row_destroy(sl_context *context, sli_sparse_row *row) {
    sl_free(context, row->words);
    *row = (sli_sparse_row){0};
}

/// Counts what a row takes more; false where that is too much.
static bool spend(sli_row_budget *budget, uint64_t bytes) {
    return atomic_fetch_add(&budget->used, bytes) + bytes <= budget->most;
}

static sl_status fail_budget(sl_context *context, const sli_row_budget *budget) {
    return sl_fail(context, SL_NO_MEMORY,
                   "the visible sets take more than the %.1f MiB that they may: allow more memory, "
                   "or bake in parts",
                   (double)budget->most / (1 << 20));
}

static sl_status make_room(sl_context *context, sli_sparse_row *row, uint32_t more,
                           sli_row_budget *budget) {
    const uint32_t needed = row->count + more;
    if (needed <= row->room) return SL_OK;
    uint32_t room = row->room + row->room / 2 + 2;
    if (room < needed) room = needed;
    if (!spend(budget, (uint64_t)(room - row->room) * SLI_SPARSE_WORD_BYTES))
        return fail_budget(context, budget);
    sl_bits *words = sl_alloc(context, (size_t)room * SLI_SPARSE_WORD_BYTES);
    if (!words) return SL_NO_MEMORY;
    const sli_sparse_row grown = {.words = words, .room = room, .count = row->count};
    if (row->count) {
        memcpy(grown.words, row->words, row->count * sizeof *words);
        memcpy(sli_sparse_index(&grown), sli_sparse_index(row), row->count * sizeof(uint32_t));
    }
    sl_free(context, row->words);
    *row = grown;
    return SL_OK;
}

static sl_status keep_all_words(sl_context *context, sli_sparse_row *row, size_t words,
                                sli_row_budget *budget) {
    const uint64_t before = (uint64_t)row->room * SLI_SPARSE_WORD_BYTES;
    const uint64_t after = words * sizeof(sl_bits);
    // Where rows shrink by it, the difference wraps and takes off.
    if (!spend(budget, after - before)) return fail_budget(context, budget);
    sl_bits *all = sl_alloc_array(context, words, sizeof *all);
    if (!all) return SL_NO_MEMORY;
    const uint32_t *index = sli_sparse_index(row);
    for (uint32_t i = 0; i < row->count; i++) all[index[i]] = row->words[i];
    sl_free(context, row->words);
    *row = (sli_sparse_row){.words = all, .room = (uint32_t)words, .count = SLI_ALL_WORDS};
    return SL_OK;
}

/// Whether so many words take less room without their indices.
static bool are_many(size_t count, size_t words) {
    return count * SLI_SPARSE_WORD_BYTES >= words * sizeof(sl_bits);
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
static uint32_t add_to_present(sli_sparse_row *row, const sli_word_set *set) {
    const uint32_t *index = sli_sparse_index(row);
    uint32_t missing = 0, at = 0;
    for (size_t word = sli_word_set_next(set, set->low); word < set->high;
         word = sli_word_set_next(set, word + 1)) {
        at = place_of(index, at, row->count, word);
        if (at < row->count && index[at] == word)
            row->words[at] |= set->bits[word];
        else
            missing++;
    }
    return missing;
}

/// Moves what is there towards the end and puts what is missing between, from the end on.
static void insert_missing(sli_sparse_row *row, const sli_word_set *set, uint32_t missing) {
    uint32_t *index = sli_sparse_index(row);
    uint32_t from = row->count, to = from + missing;
    size_t word = sli_word_set_before(set, set->high);
    row->count = to;
    while (to > from) {
        to--;
        if (from && index[from - 1] >= word) {
            if (index[--from] == word) word = sli_word_set_before(set, word);
            index[to] = index[from];
            row->words[to] = row->words[from];
        } else {
            index[to] = (uint32_t)word;
            row->words[to] = set->bits[word];
            word = sli_word_set_before(set, word);
        }
    }
}

static void add_to_all(sli_sparse_row *row, const sli_word_set *set) {
    sl_bits *restrict words = row->words;
    const sl_bits *restrict bits = set->bits;
    for (size_t i = set->low; i < set->high; i++) words[i] |= bits[i];
}

sl_status sli_sparse_row_add(sl_context *context, sli_sparse_row *row, size_t words,
                             const sli_word_set *set, sli_row_budget *budget) {
    if (row->count != SLI_ALL_WORDS) {
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

/// The place of a word, or NULL where the row has none. `cursor` starts at 0 and makes ascending
/// searches short; words may be added to the row meanwhile.
static sl_bits *find_sparse_word(const sli_sparse_row *row, size_t word, uint32_t *cursor) {
    if (row->count == SLI_ALL_WORDS) return &row->words[word];
    if (!row->count) return NULL;
    const uint32_t *index = sli_sparse_index(row);
    *cursor = place_of(index, *cursor, row->count, word);
    return *cursor < row->count && index[*cursor] == word ? &row->words[*cursor] : NULL;
}

/// Adds the members of one word, not none.
static sl_status add_sparse_word(sl_context *context, sli_sparse_row *row, size_t words,
                                 size_t word, sl_bits bits, sli_row_budget *budget) {
    uint32_t at = 0;
    sl_bits *found = find_sparse_word(row, word, &at);
    if (!found && are_many(row->count + 1, words)) {
        SL_TRY(keep_all_words(context, row, words, budget));
        found = &row->words[word];
    }
    if (found) {
        *found |= bits;
        return SL_OK;
    }
    SL_TRY(make_room(context, row, 1, budget));
    uint32_t *index = sli_sparse_index(row);
    const size_t behind = row->count - at;
    memmove(index + at + 1, index + at, behind * sizeof *index);
    memmove(row->words + at + 1, row->words + at, behind * sizeof *row->words);
    index[at] = (uint32_t)word;
    row->words[at] = bits;
    row->count++;
    return SL_OK;
}

void sli_sparse_row_add_to(const sli_sparse_row *row, size_t words, sli_word_set *set) {
    const bool all = row->count == SLI_ALL_WORDS;
    const uint32_t *index = all || !row->count ? NULL : sli_sparse_index(row);
    for (size_t i = 0; i < (all ? words : row->count); i++)
        if (row->words[i]) sli_word_set_join(set, all ? i : index[i], row->words[i]);
}

// --- all rows

/// Up to here, rows that hold every bit are as fast or faster: they fit a processor's caches.
#define MOST_DENSE_BYTES (UINT64_C(16) << 20)

/// Neighbours are asked for at once, so that they have locks of their own.
enum { LOCKS = 256 };

struct sli_shared_rows {
    sli_row_budget budget;
    pthread_mutex_t locks[LOCKS];
};

/// Of dense rows each thread has its own.
static bool choose_sparse(uint64_t count, size_t words, const sl_see_options *options) {
    if (options->rows != SL_ROWS_BY_SIZE) return options->rows == SL_ROWS_SPARSE;
    const uint64_t bytes = count * words * sizeof(sl_bits);
    const uint64_t forks = options->threads ? options->threads : sl_core_count();
    return bytes > MOST_DENSE_BYTES || bytes * (forks + 1) > options->row_bytes;
}

static sl_status create_sparse(sl_context *context, sli_bit_rows *rows, uint64_t most) {
    const uint64_t heads = rows->count * sizeof *rows->sparse;
    rows->sparse = sl_alloc_array(context, rows->count, sizeof *rows->sparse);
    rows->shared = sl_alloc(context, sizeof *rows->shared);
    if (!rows->sparse || !rows->shared) {
        sl_free(context, rows->sparse);
        sl_free(context, rows->shared);
        return SL_NO_MEMORY;
    }
    rows->shared->budget.most = most;
    atomic_init(&rows->shared->budget.used, heads);
    for (size_t i = 0; i < LOCKS; i++) pthread_mutex_init(&rows->shared->locks[i], NULL);
    return SL_OK;
}

static sl_status create_dense(sl_context *context, sli_bit_rows *rows) {
    if (rows->words && rows->count > SIZE_MAX / rows->words) return sl_fail_memory(context);
    rows->bits = sl_alloc_array(context, rows->count * rows->words, sizeof *rows->bits);
    return rows->bits ? SL_OK : SL_NO_MEMORY;
}

sl_status sli_bit_rows_create(sl_context *context, uint32_t count, const sl_see_options *options,
                              sli_bit_rows *rows) {
    sli_bit_rows made = {.count = count, .words = sl_bits_words(count)};
    if (choose_sparse(count, made.words, options))
        SL_TRY(create_sparse(context, &made, options->row_bytes));
    else
        SL_TRY(create_dense(context, &made));
    *rows = made;
    return SL_OK;
}

void sli_bit_rows_destroy(sl_context *context, sli_bit_rows *rows) {
    sl_free(context, rows->bits);
    for (uint32_t cell = 0; rows->sparse && cell < rows->count; cell++)
        sli_sparse_row_destroy(context, &rows->sparse[cell]);
    sl_free(context, rows->sparse);
    for (size_t i = 0; rows->shared && i < LOCKS; i++)
        pthread_mutex_destroy(&rows->shared->locks[i]);
    sl_free(context, rows->shared);
    *rows = (sli_bit_rows){0};
}

sl_status sli_bit_rows_fork(sl_context *context, const sli_bit_rows *rows, sli_bit_rows *fork) {
    sli_bit_rows made = *rows;
    if (rows->bits) SL_TRY(create_dense(context, &made));
    *fork = made;
    return SL_OK;
}

void sli_bit_rows_join(sl_context *context, sli_bit_rows *rows, sli_bit_rows *fork) {
    for (size_t i = 0; fork->bits && i < rows->count * rows->words; i++)
        rows->bits[i] |= fork->bits[i];
    sl_free(context, fork->bits);
    *fork = (sli_bit_rows){0};
}

sl_status sli_bit_rows_add_sparse(sl_context *context, sli_bit_rows *rows, uint32_t cell,
                                  const sli_word_set *set) {
    pthread_mutex_t *lock = &rows->shared->locks[cell % LOCKS];
    pthread_mutex_lock(lock);
    const sl_status status =
        sli_sparse_row_add(context, &rows->sparse[cell], rows->words, set, &rows->shared->budget);
    pthread_mutex_unlock(lock);
    return status;
}

sl_status sli_bit_rows_add_word(sl_context *context, sli_bit_rows *rows, uint32_t cell, size_t word,
                                sl_bits bits) {
    if (rows->bits) {
        sli_bit_rows_dense(rows, cell)[word] |= bits;
        return SL_OK;
    }
    pthread_mutex_t *lock = &rows->shared->locks[cell % LOCKS];
    pthread_mutex_lock(lock);
    const sl_status status = add_sparse_word(context, &rows->sparse[cell], rows->words, word, bits,
                                             &rows->shared->budget);
    pthread_mutex_unlock(lock);
    return status;
}

// --- encoding

static sl_status append_row(sl_context *context, sli_bit_rows *rows, uint32_t cell,
                            sli_row_bytes *bytes, uint64_t *pairs) {
    if (rows->bits) {
        *pairs += sli_bits_count(sli_bit_rows_dense(rows, cell), rows->words);
        return sli_row_append(context, bytes, sli_bit_rows_dense(rows, cell), rows->count);
    }
    sli_sparse_row *row = &rows->sparse[cell];
    const bool all = row->count == SLI_ALL_WORDS;
    const size_t count = all ? rows->words : row->count;
    *pairs += sli_bits_count(row->words, count);
    SL_TRY(sli_row_append_words(context, bytes, row->words, all ? NULL : sli_sparse_index(row),
                                count));
    sli_sparse_row_destroy(context, row);
    return SL_OK;
}

static sl_status encode(sl_context *context, sli_bit_rows *rows, sli_row_bytes *bytes, sl_pvs *out,
                        uint64_t *pairs) {
    out->cell_count = rows->count;
    out->offsets = sl_alloc_array(context, (size_t)rows->count + 1, sizeof *out->offsets);
    if (!out->offsets) return SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < rows->count; cell++) {
        SL_TRY(append_row(context, rows, cell, bytes, pairs));
        out->offsets[cell + 1] = bytes->count;
    }
    // Never NULL, also where no cell sees any.
    SL_TRY(SL_ARRAY_ROOM(context, bytes, 1));
    out->bytes = bytes->items;
    bytes->items = NULL;
    return SL_OK;
}

sl_status sli_bit_rows_encode(sl_context *context, sli_bit_rows *rows, sl_visibility *out) {
    sli_row_bytes bytes = {0};
    sl_pvs pvs = {0};
    uint64_t pairs = 0;
    const sl_status status = encode(context, rows, &bytes, &pvs, &pairs);
    sl_free(context, bytes.items);
    if (status != SL_OK) {
        sl_pvs_destroy(context, &pvs);
        return status;
    }
    out->pvs = pvs;
    out->account.pairs = pairs;
    return SL_OK;
}

// --- rows made symmetric

/// Mirrors 64 rows of 64 bits about their diagonal, by swapping ever smaller blocks (Warren 2003,
/// Hacker's Delight, section 7-3).
static void transpose(sl_bits block[64]) {
    sl_bits mask = 0x00000000ffffffff;
    for (unsigned size = 32; size; size >>= 1, mask ^= mask << size)
        for (unsigned i = 0; i < 64; i = ((i | size) + 1) & ~size) {
            const sl_bits swap = (block[i] >> size ^ block[i | size]) & mask;
            block[i] ^= swap << size;
            block[i | size] ^= swap;
        }
}

// --- dense rows

/// Copies 64 rows of one word each; rows past the last are empty. Returns whether any bit is set.
static bool take_block(const sli_bit_rows *rows, size_t first_row, size_t word, sl_bits block[64]) {
    sl_bits any = 0;
    for (size_t i = 0; i < 64; i++) {
        const size_t row = first_row + i;
        block[i] = row < rows->count ? rows->bits[row * rows->words + word] : 0;
        any |= block[i];
    }
    return any != 0;
}

static void merge_block(sli_bit_rows *rows, size_t first_row, size_t word, const sl_bits block[64],
                        sli_mirroring how) {
    for (size_t i = 0; i < 64 && first_row + i < rows->count; i++) {
        sl_bits *bits = &rows->bits[(first_row + i) * rows->words + word];
        *bits = how == SLI_ADD_MIRRORED ? *bits | block[i] : *bits & block[i];
    }
}

static void mirror_dense(sli_bit_rows *rows, sli_mirroring how) {
    sl_bits below[64], above[64];
    for (size_t i = 0; i < rows->words; i++)
        for (size_t k = 0; k <= i; k++) {
            const bool some_below = take_block(rows, 64 * i, k, below);
            const bool some_above = take_block(rows, 64 * k, i, above);
            if (!some_below && !some_above) continue;
            transpose(below);
            merge_block(rows, 64 * k, i, below, how);
            if (k == i) continue;
            transpose(above);
            merge_block(rows, 64 * i, k, above, how);
        }
}

// --- sparse rows

/// The number of rows, up to 64, from a multiple of 64 on.
static uint32_t block_rows(const sli_bit_rows *rows, size_t first) {
    return rows->count - first < 64 ? (uint32_t)(rows->count - first) : 64;
}

/// Copies one word of each of 64 rows; cursors as those of find_sparse_word.
static void take_words(const sli_bit_rows *rows, size_t first, size_t word, uint32_t cursors[64],
                       sl_bits block[64]) {
    const uint32_t count = block_rows(rows, first);
    for (uint32_t i = 0; i < 64; i++) {
        const sl_bits *found =
            i < count ? find_sparse_word(&rows->sparse[first + i], word, &cursors[i]) : NULL;
        block[i] = found ? *found : 0;
    }
}

static sl_status add_words(sl_context *context, sli_bit_rows *rows, size_t first, size_t word,
                           const sl_bits block[64]) {
    for (uint32_t i = 0; i < block_rows(rows, first); i++)
        if (block[i])
            SL_TRY(sli_bit_rows_add_word(context, rows, (uint32_t)(first + i), word, block[i]));
    return SL_OK;
}

static void keep_words(sli_bit_rows *rows, size_t first, size_t word, uint32_t cursors[64],
                       const sl_bits block[64]) {
    for (uint32_t i = 0; i < block_rows(rows, first); i++) {
        sl_bits *found = find_sparse_word(&rows->sparse[first + i], word, &cursors[i]);
        if (found) *found &= block[i];
    }
}

/// The rows 64 * i and on against those that their words tell of: what they have goes there, or
/// what those have stays here.
static sl_status mirror_rows(sl_context *context, sli_bit_rows *rows, size_t i, sli_mirroring how,
                             sli_word_set *any) {
    uint32_t cursors[64] = {0};
    sl_bits block[64];
    for (uint32_t r = 0; r < block_rows(rows, 64 * i); r++)
        sli_sparse_row_add_to(&rows->sparse[64 * i + r], rows->words, any);
    for (size_t k = sli_word_set_next(any, any->low); k < any->high;
         k = sli_word_set_next(any, k + 1)) {
        if (how == SLI_ADD_MIRRORED) {
            take_words(rows, 64 * i, k, cursors, block);
            transpose(block);
            SL_TRY(add_words(context, rows, 64 * k, i, block));
        } else {
            uint32_t there[64] = {0};
            take_words(rows, 64 * k, i, there, block);
            transpose(block);
            keep_words(rows, 64 * i, k, cursors, block);
        }
    }
    sli_word_set_clear(any);
    return SL_OK;
}

static sl_status mirror_sparse(sl_context *context, sli_bit_rows *rows, sli_mirroring how) {
    sli_word_set any;
    SL_TRY(sli_word_set_create(context, rows->count, &any));
    sl_status status = SL_OK;
    for (size_t i = 0; i < rows->words && status == SL_OK; i++) {
        status = mirror_rows(context, rows, i, how, &any);
        if (status == SL_OK && i % 64 == 0) status = sl_check_cancelled(context);
    }
    sli_word_set_destroy(context, &any);
    return status;
}

sl_status sli_bit_rows_mirror(sl_context *context, sli_bit_rows *rows, sli_mirroring how) {
    if (!rows->bits) return mirror_sparse(context, rows, how);
    mirror_dense(rows, how);
    return SL_OK;
}
