/// Potentially visible sets: a row for each cell, compressed.
///
/// A row lists its members as runs. Each run is two numbers: how many cells to skip, and how many
/// follow each other. A number takes 7 bits a byte, the lowest first; the top bit says that more
/// follow. Neighbouring cells have neighbouring numbers, so that runs are long and rows short.
#include "cell_to_cell/pvs_rows.h"

#include "base/bits.h"
#include "base/size.h"

#include <string.h>

void sl_pvs_destroy(sl_context *context, sl_pvs *pvs) {
    sl_free(context, pvs->offsets);
    sl_free(context, pvs->bytes);
    *pvs = (sl_pvs){0};
}

/// Reads one number; false where the bytes end within it or it does not fit 32 bits.
static bool read_number(const uint8_t **next, const uint8_t *stop, uint32_t *value) {
    uint64_t number = 0;
    for (unsigned shift = 0; *next < stop && shift < 35; shift += 7) {
        const uint8_t byte = *(*next)++;
        number |= (uint64_t)(byte & 0x7f) << shift;
        if (byte & 0x80) continue;
        *value = (uint32_t)number;
        return number <= UINT32_MAX;
    }
    return false;
}

sl_pvs_run sl_pvs_begin(const sl_pvs *pvs, uint32_t cell) {
    return (sl_pvs_run){.next = pvs->bytes + pvs->offsets[cell],
                        .stop =
                            pvs->bytes + (pvs->ends ? pvs->ends[cell] : pvs->offsets[cell + 1])};
}

bool sl_pvs_next(sl_pvs_run *run) {
    uint32_t skip, length;
    if (!read_number(&run->next, run->stop, &skip) || !read_number(&run->next, run->stop, &length))
        return false;
    run->first = run->end + skip;
    run->end = run->first + length;
    return true;
}

bool sl_pvs_sees(const sl_pvs *pvs, uint32_t from, uint32_t to) {
    for (sl_pvs_run run = sl_pvs_begin(pvs, from); sl_pvs_next(&run);)
        if (to < run.end) return to >= run.first;
    return false;
}

uint32_t sl_pvs_count(const sl_pvs *pvs, uint32_t cell) {
    uint32_t count = 0;
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);) count += run.end - run.first;
    return count;
}

uint64_t sli_pvs_pairs(const sl_pvs *pvs) {
    uint64_t pairs = 0;
    for (uint32_t cell = 0; cell < pvs->cell_count; cell++) pairs += sl_pvs_count(pvs, cell);
    return pairs;
}

void sli_pvs_parts(const sl_pvs *pvs, uint64_t *out) {
    unsigned shift = 0;
    while (pvs->cell_count && (pvs->cell_count - 1) >> shift > 63) shift++;
    for (uint32_t cell = 0; cell < pvs->cell_count; cell++) {
        out[cell] = 0;
        for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
            out[cell] |= (UINT64_C(2) << ((run.end - 1) >> shift)) - // 2^64 is 0
                         (UINT64_C(1) << (run.first >> shift));
    }
}

static bool row_is_sound(const sl_pvs *pvs, uint32_t cell) {
    const uint8_t *next = pvs->bytes + pvs->offsets[cell];
    const uint8_t *stop = pvs->bytes + pvs->offsets[cell + 1];
    uint64_t end = 0;
    for (bool first = true; next < stop; first = false) {
        uint32_t skip, length;
        if (!read_number(&next, stop, &skip) || !read_number(&next, stop, &length)) return false;
        if ((!skip && !first) || !length) return false;
        end += (uint64_t)skip + length;
        if (end > pvs->cell_count) return false;
    }
    return true;
}

sl_status sli_pvs_check(sl_context *context, const sl_pvs *pvs) {
    if (pvs->cell_count && pvs->offsets[0] != 0)
        return sl_fail(context, SL_BAD_INPUT, "the visible sets do not start at their first byte");
    for (uint32_t cell = 0; cell < pvs->cell_count; cell++) {
        if (pvs->offsets[cell] > pvs->offsets[cell + 1])
            return sl_fail(context, SL_BAD_INPUT, "visible set %u ends before it starts", cell);
    }
    for (uint32_t cell = 0; cell < pvs->cell_count; cell++) {
        if (!row_is_sound(pvs, cell))
            return sl_fail(context, SL_BAD_INPUT, "visible set %u is damaged", cell);
    }
    return SL_OK;
}

static uint8_t *write_number(uint8_t *at, uint32_t value) {
    for (; value >= 0x80; value >>= 7) *at++ = (uint8_t)(value | 0x80);
    *at++ = (uint8_t)value;
    return at;
}

static sl_status append_run(sl_context *context, sli_row_bytes *bytes, uint32_t skip,
                            uint32_t length) {
    SL_TRY(SL_ARRAY_ROOM(context, bytes, 10));
    uint8_t *at = bytes->items + bytes->count;
    at = write_number(write_number(at, skip), length);
    bytes->count = (size_t)(at - bytes->items);
    return SL_OK;
}

sl_status sli_row_append_list(sl_context *context, sli_row_bytes *bytes, const uint32_t *cells,
                              size_t count) {
    uint32_t end = 0;
    for (size_t i = 0; i < count;) {
        const uint32_t first = cells[i];
        uint32_t stop = first;
        for (; i < count && cells[i] <= stop; i++) stop = cells[i] + 1;
        SL_TRY(append_run(context, bytes, first - end, stop - first));
        end = stop;
    }
    return SL_OK;
}

sl_status sli_row_append_words(sl_context *context, sli_row_bytes *bytes, const sl_bits *words,
                               const uint32_t *index, size_t count) {
    uint64_t before = 0, first = 0, end = 0; // the end of the run before, and a run in the making
    for (size_t i = 0; i < count; i++) {
        const uint64_t base = 64 * (uint64_t)(index ? index[i] : i);
        for (sl_bits left = words[i]; left;) {
            const unsigned start = (unsigned)__builtin_ctzll(left);
            const sl_bits neighbour = ~(left >> start); // 0 where all 64 are there
            const unsigned length = neighbour ? (unsigned)__builtin_ctzll(neighbour) : 64;
            left = start + length < 64 ? left >> (start + length) << (start + length) : 0;
            if (base + start != end && end > first) {
                SL_TRY(append_run(context, bytes, (uint32_t)(first - before),
                                  (uint32_t)(end - first)));
                before = end;
            }
            if (base + start != end || end == first) first = base + start;
            end = base + start + length;
        }
    }
    if (end == first) return SL_OK;
    return append_run(context, bytes, (uint32_t)(first - before), (uint32_t)(end - first));
}

sl_status sli_row_append(sl_context *context, sli_row_bytes *bytes, const sl_bits *set,
                         uint32_t count) {
    return sli_row_append_words(context, bytes, set, NULL, sl_bits_words(count));
}

void sli_row_add_to(const sl_pvs *pvs, uint32_t cell, sl_bits *set) {
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++) sl_bits_add(set, i);
}

void sli_row_add_open_to(const sl_pvs *pvs, const sl_door_sets *doors, uint32_t cell,
                         const bool *shut, sl_bits *set) {
    if (!shut || !doors->cell_count) {
        sli_row_add_to(pvs, cell, set);
        return;
    }
    sl_door_pairs pair = sl_door_pairs_begin(doors, cell);
    bool more = sl_door_pairs_next(&pair, shut);
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++) {
            while (more && pair.cell < i) more = sl_door_pairs_next(&pair, shut);
            if (!more || pair.cell != i || pair.open) sl_bits_add(set, i);
        }
}

static sl_status join(sl_context *context, const sli_row_bytes *rows, uint32_t count, sl_pvs *out) {
    sl_pvs pvs = {.cell_count = count};
    pvs.offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *pvs.offsets);
    if (!pvs.offsets) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) pvs.offsets[i + 1] = pvs.offsets[i] + rows[i].count;
    pvs.bytes = sl_alloc(context, sli_size(pvs.offsets[count] + 1));
    if (!pvs.bytes) {
        sl_pvs_destroy(context, &pvs);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++)
        if (rows[i].count) memcpy(pvs.bytes + pvs.offsets[i], rows[i].items, rows[i].count);
    *out = pvs;
    return SL_OK;
}

sl_status sli_pvs_join(sl_context *context, sli_row_bytes *rows, uint32_t count, sl_pvs *out) {
    const sl_status status = join(context, rows, count, out);
    for (uint32_t i = 0; i < count; i++) {
        sl_free(context, rows[i].items);
        rows[i] = (sli_row_bytes){0};
    }
    return status;
}

sl_status sli_columns_gather(sl_context *context, const sl_pvs *rows, uint32_t count,
                             sli_columns *out) {
    out->starts = sl_alloc_array(context, (size_t)count + 2, sizeof *out->starts);
    if (!out->starts) return SL_NO_MEMORY;
    // Counted two places on, then summed, so that filling moves each start to where it belongs.
    for (uint32_t row = 0; row < rows->cell_count; row++)
        for (sl_pvs_run run = sl_pvs_begin(rows, row); sl_pvs_next(&run);)
            for (uint32_t to = run.first; to < run.end; to++) out->starts[to + 2]++;
    for (uint32_t i = 1; i < count + 2; i++) out->starts[i] += out->starts[i - 1];
    out->members = sl_alloc_array(context, sli_size(out->starts[count + 1]), sizeof *out->members);
    if (!out->members) return SL_NO_MEMORY;
    for (uint32_t row = 0; row < rows->cell_count; row++)
        for (sl_pvs_run run = sl_pvs_begin(rows, row); sl_pvs_next(&run);)
            for (uint32_t to = run.first; to < run.end; to++)
                out->members[out->starts[to + 1]++] = row;
    return SL_OK;
}

void sli_columns_destroy(sl_context *context, sli_columns *columns) {
    sl_free(context, columns->starts);
    sl_free(context, columns->members);
    *columns = (sli_columns){0};
}

static sl_status encode_column(sl_context *context, const sli_columns *all, uint32_t cell,
                               sli_row_bytes *row) {
    uint32_t end = 0;
    for (uint64_t i = all->starts[cell]; i < all->starts[cell + 1];) {
        const uint32_t first = all->members[i], skip = first - end;
        for (end = first; i < all->starts[cell + 1] && all->members[i] == end; i++) end++;
        SL_TRY(append_run(context, row, skip, end - first));
    }
    return SL_OK;
}

sl_status sli_pvs_transpose(sl_context *context, const sl_pvs *pvs, sl_pvs *out) {
    const uint32_t count = pvs->cell_count;
    sli_columns gathered = {0};
    sl_status status = sli_columns_gather(context, pvs, count, &gathered);
    sli_row_bytes *rows = status == SL_OK ? sl_alloc_array(context, count, sizeof *rows) : NULL;
    if (status == SL_OK && !rows) status = SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < count && status == SL_OK; cell++) {
        if (cell % 1024 == 0) status = sl_check_cancelled(context);
        if (status == SL_OK) status = encode_column(context, &gathered, cell, &rows[cell]);
    }
    if (status == SL_OK)
        status = sli_pvs_join(context, rows, count, out);
    else
        for (uint32_t cell = 0; rows && cell < count; cell++) sl_free(context, rows[cell].items);
    sl_free(context, rows);
    sli_columns_destroy(context, &gathered);
    return status;
}

// --- a PVS in the making

sl_status sli_pvs_maker_create(sl_context *context, uint32_t members, uint32_t rows,
                               sli_pvs_maker *maker) {
    *maker = (sli_pvs_maker){.count = rows};
    SL_TRY(sli_word_set_create(context, members, &maker->row));
    maker->offsets = sl_alloc_array(context, (size_t)rows + 1, sizeof *maker->offsets);
    return maker->offsets ? SL_OK : SL_NO_MEMORY;
}

void sli_pvs_maker_destroy(sl_context *context, sli_pvs_maker *maker) {
    sli_word_set_destroy(context, &maker->row);
    sl_free(context, maker->offsets);
    sl_free(context, maker->bytes.items);
    sl_free(context, maker->words.items);
    sl_free(context, maker->places.items);
    *maker = (sli_pvs_maker){0};
}

/// The bits of a word that are members `first` .. `end` - 1.
static sl_bits bits_between(size_t word, uint32_t first, uint32_t end) {
    sl_bits bits = ~(sl_bits)0;
    if (first / 64 == word) bits &= ~(sl_bits)0 << (first % 64);
    if (end / 64 == word) bits &= ~(~(sl_bits)0 << (end % 64));
    return bits;
}

void sli_word_set_add_row(sli_word_set *set, const sl_pvs *pvs, uint32_t cell) {
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (size_t word = run.first / 64; word < sl_bits_words(run.end); word++)
            sli_word_set_join(set, word, bits_between(word, run.first, run.end));
}

void sli_word_set_add_common(sli_word_set *set, const sl_pvs *pvs, uint32_t cell,
                             const sli_word_set *other) {
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);) {
        const size_t end = sl_bits_words(run.end);
        for (size_t word = sli_word_set_next(other, run.first / 64);
             word < end && word < other->high; word = sli_word_set_next(other, word + 1)) {
            const sl_bits bits = other->bits[word] & bits_between(word, run.first, run.end);
            if (bits) sli_word_set_join(set, word, bits);
        }
    }
}

void sli_pvs_maker_add(sli_pvs_maker *maker, const sl_pvs *pvs, uint32_t cell) {
    sli_word_set_add_row(&maker->row, pvs, cell);
}

sl_status sli_pvs_maker_end_row(sl_context *context, sli_pvs_maker *maker) {
    const sli_word_set *row = &maker->row;
    maker->words.count = maker->places.count = 0;
    for (size_t word = sli_word_set_next(row, row->low); word < row->high;
         word = sli_word_set_next(row, word + 1)) {
        SL_TRY(SL_ARRAY_ROOM(context, &maker->words, 1));
        SL_TRY(SL_ARRAY_ROOM(context, &maker->places, 1));
        maker->words.items[maker->words.count++] = row->bits[word];
        maker->places.items[maker->places.count++] = (uint32_t)word;
        maker->pairs += (uint64_t)__builtin_popcountll(row->bits[word]);
    }
    SL_TRY(sli_row_append_words(context, &maker->bytes, maker->words.items, maker->places.items,
                                maker->words.count));
    maker->offsets[++maker->made] = maker->bytes.count;
    sli_word_set_clear(&maker->row);
    return SL_OK;
}

sl_status sli_pvs_maker_finish(sl_context *context, sli_pvs_maker *maker, sl_pvs *out) {
    SL_TRY(SL_ARRAY_ROOM(context, &maker->bytes, 1)); // never NULL, also where no row has any
    *out = (sl_pvs){
        .cell_count = maker->count, .offsets = maker->offsets, .bytes = maker->bytes.items};
    maker->offsets = NULL;
    maker->bytes.items = NULL;
    return SL_OK;
}

// --- from both directions to one result

/// The rows that go in, each with its transposed.
typedef struct both_ways {
    const sl_pvs *sure, *doubtful;
    sl_pvs sure_back, doubtful_back;
} both_ways;

typedef struct result_rows {
    sli_row_bytes *seen, *doubtful;
    sl_bits *set, *open; ///< scratch
} result_rows;

static sl_status finish_row(sl_context *context, const both_ways *in, result_rows *rows,
                            uint32_t cell, sl_visibility *out) {
    const uint32_t count = in->sure->cell_count;
    const size_t words = sl_bits_words(count);
    memset(rows->set, 0, words * sizeof *rows->set);
    memset(rows->open, 0, words * sizeof *rows->open);
    sli_row_add_to(in->sure, cell, rows->set);
    if (in->sure_back.cell_count) sli_row_add_to(&in->sure_back, cell, rows->set);
    sli_row_add_to(in->doubtful, cell, rows->open);
    if (in->doubtful_back.cell_count) sli_row_add_to(&in->doubtful_back, cell, rows->open);
    for (size_t i = 0; i < words; i++) rows->open[i] &= ~rows->set[i];
    SL_TRY(sli_row_append(context, &rows->doubtful[cell], rows->open, count));
    out->account.doubtful_pairs += sli_bits_count(rows->open, words);
    if (out->sight == SL_CLOSED)
        for (size_t i = 0; i < words; i++) rows->set[i] |= rows->open[i];
    out->account.pairs += sli_bits_count(rows->set, words);
    return sli_row_append(context, &rows->seen[cell], rows->set, count);
}

static sl_status finish_rows(sl_context *context, const both_ways *in, result_rows *rows,
                             sl_visibility *out) {
    const uint32_t count = in->sure->cell_count;
    rows->seen = sl_alloc_array(context, count, sizeof *rows->seen);
    rows->doubtful = sl_alloc_array(context, count, sizeof *rows->doubtful);
    rows->set = sl_alloc_array(context, sl_bits_words(count), sizeof *rows->set);
    rows->open = sl_alloc_array(context, sl_bits_words(count), sizeof *rows->open);
    if (!rows->seen || !rows->doubtful || !rows->set || !rows->open) return SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < count; cell++) {
        if (cell % 256 == 0) SL_TRY(sl_check_cancelled(context));
        SL_TRY(finish_row(context, in, rows, cell, out));
    }
    SL_TRY(sli_pvs_join(context, rows->seen, count, &out->pvs));
    return sli_pvs_join(context, rows->doubtful, count, &out->doubtful);
}

sl_status sli_visibility_finish(sl_context *context, const sl_pvs *sure, const sl_pvs *doubtful,
                                bool mutual, sl_visibility *out) {
    both_ways in = {.sure = sure, .doubtful = doubtful};
    result_rows rows = {0};
    sl_status status = SL_OK;
    if (mutual) status = sli_pvs_transpose(context, sure, &in.sure_back);
    if (mutual && status == SL_OK) status = sli_pvs_transpose(context, doubtful, &in.doubtful_back);
    if (status == SL_OK) status = finish_rows(context, &in, &rows, out);
    sl_pvs_destroy(context, &in.sure_back);
    sl_pvs_destroy(context, &in.doubtful_back);
    for (uint32_t i = 0; i < sure->cell_count; i++) {
        if (rows.seen) sl_free(context, rows.seen[i].items);
        if (rows.doubtful) sl_free(context, rows.doubtful[i].items);
    }
    sl_free(context, rows.seen);
    sl_free(context, rows.doubtful);
    sl_free(context, rows.set);
    sl_free(context, rows.open);
    return status;
}
