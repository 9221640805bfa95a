#include "cell_to_cell/pvs_rows.h"

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
                        .stop = pvs->bytes + pvs->offsets[cell + 1]};
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

uint64_t sl_pvs_pairs(const sl_pvs *pvs) {
    uint64_t pairs = 0;
    for (uint32_t cell = 0; cell < pvs->cell_count; cell++) pairs += sl_pvs_count(pvs, cell);
    return pairs;
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

sl_status sl_pvs_check(sl_context *context, const sl_pvs *pvs) {
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

static sl_status append_run(sl_context *context, sl_row_bytes *bytes, uint32_t skip,
                            uint32_t length) {
    SL_TRY(SL_ARRAY_ROOM(context, bytes, 10));
    uint8_t *at = bytes->items + bytes->count;
    at = write_number(write_number(at, skip), length);
    bytes->count = (size_t)(at - bytes->items);
    return SL_OK;
}

sl_status sl_row_append_words(sl_context *context, sl_row_bytes *bytes, const sl_bits *words,
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

sl_status sl_row_append(sl_context *context, sl_row_bytes *bytes, const sl_bits *set,
                        uint32_t count) {
    return sl_row_append_words(context, bytes, set, NULL, sl_bits_words(count));
}

void sl_row_add_to(const sl_pvs *pvs, uint32_t cell, sl_bits *set) {
    for (sl_pvs_run run = sl_pvs_begin(pvs, cell); sl_pvs_next(&run);)
        for (uint32_t i = run.first; i < run.end; i++) sl_bits_add(set, i);
}

static sl_status join(sl_context *context, const sl_row_bytes *rows, uint32_t count, sl_pvs *out) {
    sl_pvs pvs = {.cell_count = count};
    pvs.offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *pvs.offsets);
    if (!pvs.offsets) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) pvs.offsets[i + 1] = pvs.offsets[i] + rows[i].count;
    pvs.bytes = sl_alloc(context, pvs.offsets[count] + 1);
    if (!pvs.bytes) {
        sl_pvs_destroy(context, &pvs);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++)
        if (rows[i].count) memcpy(pvs.bytes + pvs.offsets[i], rows[i].items, rows[i].count);
    *out = pvs;
    return SL_OK;
}

sl_status sl_pvs_join(sl_context *context, sl_row_bytes *rows, uint32_t count, sl_pvs *out) {
    const sl_status status = join(context, rows, count, out);
    for (uint32_t i = 0; i < count; i++) {
        sl_free(context, rows[i].items);
        rows[i] = (sl_row_bytes){0};
    }
    return status;
}

sl_status sl_columns_gather(sl_context *context, const sl_pvs *rows, uint32_t count,
                            sl_columns *out) {
    out->starts = sl_alloc_array(context, (size_t)count + 2, sizeof *out->starts);
    if (!out->starts) return SL_NO_MEMORY;
    // Counted two places on, then summed, so that filling moves each start to where it belongs.
    for (uint32_t row = 0; row < rows->cell_count; row++)
        for (sl_pvs_run run = sl_pvs_begin(rows, row); sl_pvs_next(&run);)
            for (uint32_t to = run.first; to < run.end; to++) out->starts[to + 2]++;
    for (uint32_t i = 1; i < count + 2; i++) out->starts[i] += out->starts[i - 1];
    out->members = sl_alloc_array(context, out->starts[count + 1], sizeof *out->members);
    if (!out->members) return SL_NO_MEMORY;
    for (uint32_t row = 0; row < rows->cell_count; row++)
        for (sl_pvs_run run = sl_pvs_begin(rows, row); sl_pvs_next(&run);)
            for (uint32_t to = run.first; to < run.end; to++)
                out->members[out->starts[to + 1]++] = row;
    return SL_OK;
}

void sl_columns_destroy(sl_context *context, sl_columns *columns) {
    sl_free(context, columns->starts);
    sl_free(context, columns->members);
    *columns = (sl_columns){0};
}

static sl_status encode_column(sl_context *context, const sl_columns *all, uint32_t cell,
                               sl_row_bytes *row) {
    uint32_t end = 0;
    for (uint64_t i = all->starts[cell]; i < all->starts[cell + 1];) {
        const uint32_t first = all->members[i], skip = first - end;
        for (end = first; i < all->starts[cell + 1] && all->members[i] == end; i++) end++;
        SL_TRY(append_run(context, row, skip, end - first));
    }
    return SL_OK;
}

sl_status sl_pvs_transpose(sl_context *context, const sl_pvs *pvs, sl_pvs *out) {
    const uint32_t count = pvs->cell_count;
    sl_columns gathered = {0};
    sl_status status = sl_columns_gather(context, pvs, count, &gathered);
    sl_row_bytes *rows = status == SL_OK ? sl_alloc_array(context, count, sizeof *rows) : NULL;
    if (status == SL_OK && !rows) status = SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < count && status == SL_OK; cell++)
        status = encode_column(context, &gathered, cell, &rows[cell]);
    if (status == SL_OK)
        status = sl_pvs_join(context, rows, count, out);
    else
        for (uint32_t cell = 0; rows && cell < count; cell++) sl_free(context, rows[cell].items);
    sl_free(context, rows);
    sl_columns_destroy(context, &gathered);
    return status;
}
