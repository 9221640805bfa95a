/// Sets of doors: through which doors a pair of cells is seen.
///
/// A pair that is seen through doors keeps its smallest sets: the pair is seen while all doors of
/// some set are open. The search brings sets one by one. A set that holds a known one is dropped,
/// and known ones that hold it are dropped too. A pair with more sets than the limit counts as
/// always seen, which never misses anything.
#include "cell_to_cell/search/door_table.h"

#include "base/bits.h"
#include "sightline/pvs.h"
#include "sightline/support.h"

#include <string.h>

// --- reading rows of door sets

void sli_door_sets_destroy(sl_context *context, sl_door_sets *sets) {
    sl_free(context, sets->offsets);
    sl_free(context, sets->bytes);
    *sets = (sl_door_sets){0};
}

uint64_t sl_door_sets_bytes(const sl_door_sets *sets) {
    return sets->cell_count ? sets->offsets[sets->cell_count] : 0;
}

/// The next number; 0 past the end of the row.
static uint32_t read_number(const uint8_t **next, const uint8_t *stop) {
    uint32_t value = 0;
    for (unsigned shift = 0; *next < stop && shift < 32; shift += 7) {
        const uint8_t byte = *(*next)++;
        value |= (uint32_t)(byte & 127) << shift;
        if (byte < 128) break;
    }
    return value;
}

sl_door_pairs sl_door_pairs_begin(const sl_door_sets *sets, uint32_t cell) {
    if (!sets->cell_count) return (sl_door_pairs){.cell = UINT32_MAX};
    return (sl_door_pairs){.cell = UINT32_MAX,
                           .next = sets->bytes + sets->offsets[cell],
                           .stop = sets->bytes + sets->offsets[cell + 1]};
}

bool sl_door_pairs_next(sl_door_pairs *pairs, const bool *shut) {
    if (pairs->next == pairs->stop) return false;
    pairs->cell += 1 + read_number(&pairs->next, pairs->stop);
    pairs->alternatives = read_number(&pairs->next, pairs->stop);
    pairs->open = false;
    for (uint32_t i = 0; i < pairs->alternatives; i++) {
        const uint32_t doors = read_number(&pairs->next, pairs->stop);
        uint32_t door = UINT32_MAX;
        bool open = true;
        for (uint32_t k = 0; k < doors; k++) {
            door += 1 + read_number(&pairs->next, pairs->stop);
            open &= !shut[door];
        }
        pairs->open |= open;
    }
    return true;
}

bool sli_door_sets_open(const sl_door_sets *sets, uint32_t from, uint32_t to, const bool *shut) {
    for (sl_door_pairs p = sl_door_pairs_begin(sets, from); sl_door_pairs_next(&p, shut);)
        if (p.cell >= to) return p.cell > to || p.open;
    return true;
}

bool sl_door_sets_alternative(const sl_door_sets *sets, uint32_t from, uint32_t to, uint32_t which,
                              bool *doors) {
    if (!sets->cell_count) return false;
    const uint8_t *next = sets->bytes + sets->offsets[from];
    const uint8_t *stop = sets->bytes + sets->offsets[from + 1];
    for (uint32_t cell = UINT32_MAX; next != stop;) {
        cell += 1 + read_number(&next, stop);
        if (cell > to) return false;
        const uint32_t alternatives = read_number(&next, stop);
        for (uint32_t i = 0; i < alternatives; i++) {
            const uint32_t count = read_number(&next, stop);
            uint32_t door = UINT32_MAX;
            for (uint32_t k = 0; k < count; k++) {
                door += 1 + read_number(&next, stop);
                if (doors && cell == to && i == which) doors[door] = true;
            }
        }
        if (cell == to) return which < alternatives;
    }
    return false;
}

/// As read_number, of untrusted bytes: false where there is no number of 32 bits.
static bool take_number(const uint8_t **next, const uint8_t *stop, uint64_t *value) {
    *value = 0;
    for (unsigned shift = 0; *next < stop && shift < 35; shift += 7) {
        const uint8_t byte = *(*next)++;
        *value |= (uint64_t)(byte & 127) << shift;
        if (byte < 128) return *value <= UINT32_MAX;
    }
    return false;
}

static bool alternative_is_sound(const uint8_t **next, const uint8_t *stop, size_t door_count) {
    uint64_t doors, gap, door = 0;
    if (!take_number(next, stop, &doors) || !doors) return false;
    for (uint64_t k = 0; k < doors; k++) {
        if (!take_number(next, stop, &gap)) return false;
        door += gap + (k > 0);
        if (door >= door_count) return false;
    }
    return true;
}

static bool row_is_sound(const sl_door_sets *sets, uint32_t row, size_t door_count) {
    const uint8_t *next = sets->bytes + sets->offsets[row];
    const uint8_t *stop = sets->bytes + sets->offsets[row + 1];
    uint64_t cell = 0, gap, count;
    for (bool first = true; next < stop; first = false) {
        if (!take_number(&next, stop, &gap) || !take_number(&next, stop, &count) || !count)
            return false;
        cell += gap + !first;
        if (cell >= sets->cell_count) return false;
        for (uint64_t i = 0; i < count; i++)
            if (!alternative_is_sound(&next, stop, door_count)) return false;
    }
    return true;
}

sl_status sli_door_sets_check(sl_context *context, const sl_door_sets *sets, size_t door_count) {
    bool sound = !sets->cell_count || sets->offsets[0] == 0;
    for (uint32_t i = 0; i < sets->cell_count && sound; i++)
        sound = sets->offsets[i] <= sets->offsets[i + 1] &&
                sets->offsets[i + 1] <= sets->offsets[sets->cell_count];
    for (uint32_t i = 0; i < sets->cell_count && sound; i++)
        sound = row_is_sound(sets, i, door_count);
    if (sound) return SL_OK;
    return sl_fail(context, SL_BAD_INPUT, "the sets of doors are damaged");
}

// --- gathering door sets while one source is searched

sl_status sli_door_table_create(sl_context *context, uint32_t cells, size_t doors, uint32_t limit,
                                sli_door_table *table) {
    *table = (sli_door_table){.words = sl_bits_words(doors), .cell_count = cells, .limit = limit};
    table->first = sl_alloc_array(context, cells, sizeof *table->first);
    table->count = sl_alloc_array(context, cells, sizeof *table->count);
    table->seen = sl_alloc_array(context, sl_bits_words(cells), sizeof *table->seen);
    table->free = sl_alloc_array(context, sl_bits_words(cells), sizeof *table->free);
    if (!table->first || !table->count || !table->seen || !table->free) return SL_NO_MEMORY;
    sli_door_table_clear(table);
    return SL_OK;
}

void sli_door_table_destroy(sl_context *context, sli_door_table *table) {
    sl_free(context, table->first);
    sl_free(context, table->count);
    sl_free(context, table->seen);
    sl_free(context, table->free);
    sl_free(context, table->alternatives.items);
    sl_free(context, table->sets.items);
    sl_free(context, table->sorted.items);
    *table = (sli_door_table){0};
}

void sli_door_table_clear(sli_door_table *table) {
    const size_t words = sl_bits_words(table->cell_count);
    memset(table->first, 0xff, table->cell_count * sizeof *table->first);
    memset(table->count, 0, table->cell_count * sizeof *table->count);
    memset(table->seen, 0, words * sizeof *table->seen);
    memset(table->free, 0, words * sizeof *table->free);
    table->alternatives.count = table->sets.count = 0;
}

static const sl_bits *set_of(const sli_door_table *table, uint32_t alternative) {
    return table->sets.items + alternative * table->words;
}

static bool is_within(const sl_bits *set, const sl_bits *other, size_t words) {
    for (size_t i = 0; i < words; i++)
        if (set[i] & ~other[i]) return false;
    return true;
}

bool sli_door_table_proves(const sli_door_table *table, uint32_t cell, const sl_bits *doors) {
    if (sl_bits_has(table->free, cell)) return true;
    for (uint32_t i = table->first[cell]; i != UINT32_MAX; i = table->alternatives.items[i].next)
        if (!table->alternatives.items[i].dropped &&
            is_within(set_of(table, i), doors, table->words))
            return true;
    return false;
}

static bool is_empty(const sl_bits *set, size_t words) {
    sl_bits any = 0;
    for (size_t i = 0; i < words; i++) any |= set[i];
    return !any;
}

sl_status sli_door_table_add(sl_context *context, sli_door_table *table, uint32_t cell,
                             const sl_bits *doors) {
    const size_t words = table->words;
    sl_bits_add(table->seen, cell);
    if (sli_door_table_proves(table, cell, doors)) return SL_OK;
    if (is_empty(doors, words)) {
        sl_bits_add(table->free, cell);
        return SL_OK;
    }
    for (uint32_t i = table->first[cell]; i != UINT32_MAX; i = table->alternatives.items[i].next) {
        sli_door_alternative *old = &table->alternatives.items[i];
        if (old->dropped || !is_within(doors, set_of(table, i), words)) continue;
        old->dropped = true;
        table->count[cell]--;
    }
    if (table->count[cell] == table->limit) {
        table->fallbacks++;
        sl_bits_add(table->free, cell);
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &table->alternatives, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &table->sets, words));
    memcpy(table->sets.items + table->sets.count, doors, words * sizeof *doors);
    table->sets.count += words;
    table->alternatives.items[table->alternatives.count] =
        (sli_door_alternative){.next = table->first[cell]};
    table->first[cell] = (uint32_t)table->alternatives.count++;
    table->count[cell]++;
    return SL_OK;
}

static sl_status append_number(sl_context *context, sli_row_bytes *row, uint32_t value) {
    SL_TRY(SL_ARRAY_ROOM(context, row, 5));
    for (; value > 127; value >>= 7) row->items[row->count++] = (uint8_t)(value | 128);
    row->items[row->count++] = (uint8_t)value;
    return SL_OK;
}

static sl_status append_set(sl_context *context, const sl_bits *set, size_t words,
                            sli_row_bytes *row) {
    uint32_t last = UINT32_MAX;
    SL_TRY(append_number(context, row, (uint32_t)sli_bits_count(set, words)));
    for (uint32_t door = 0; door < 64 * words; door++) {
        if (!sl_bits_has(set, door)) continue;
        SL_TRY(append_number(context, row, door - last - 1));
        last = door;
    }
    return SL_OK;
}

/// Fewer doors first, then the lowest door that the other has not: the order does not tell how the
/// sets were found.
static bool comes_before(const sl_bits *a, const sl_bits *b, size_t words) {
    int more = 0;
    for (size_t i = 0; i < words; i++)
        more += __builtin_popcountll(a[i]) - __builtin_popcountll(b[i]);
    if (more) return more < 0;
    for (size_t i = 0; i < words; i++) {
        const sl_bits differ = a[i] ^ b[i];
        if (differ) return a[i] & (differ & (~differ + 1));
    }
    return false;
}

/// The alternatives of a cell that stand, in order.
static sl_status sort_sets(sl_context *context, sli_door_table *table, uint32_t cell) {
    table->sorted.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &table->sorted, table->count[cell]));
    uint32_t *sorted = table->sorted.items;
    for (uint32_t i = table->first[cell]; i != UINT32_MAX; i = table->alternatives.items[i].next) {
        if (table->alternatives.items[i].dropped) continue;
        size_t at = table->sorted.count++;
        for (; at && comes_before(set_of(table, i), set_of(table, sorted[at - 1]), table->words);
             at--)
            sorted[at] = sorted[at - 1];
        sorted[at] = i;
    }
    return SL_OK;
}

sl_status sli_door_table_append(sl_context *context, sli_door_table *table, uint32_t first,
                                sli_row_bytes *row) {
    uint32_t last = UINT32_MAX;
    for (uint32_t cell = first; cell < table->cell_count; cell++) {
        if (!table->count[cell] || sl_bits_has(table->free, cell)) continue;
        SL_TRY(append_number(context, row, cell - last - 1));
        SL_TRY(append_number(context, row, table->count[cell]));
        last = cell;
        SL_TRY(sort_sets(context, table, cell));
        for (size_t i = 0; i < table->sorted.count; i++)
            SL_TRY(append_set(context, set_of(table, table->sorted.items[i]), table->words, row));
    }
    return SL_OK;
}

// --- both directions

/// A pair of a row: the other cell, and its bytes behind that.
typedef struct entry {
    uint32_t cell;
    const uint8_t *bytes;
    size_t size;
} entry;

static uint32_t read_trusted(const uint8_t **next) {
    uint32_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
        const uint8_t byte = *(*next)++;
        value |= (uint32_t)(byte & 127) << shift;
        if (byte < 128) return value;
    }
}

static bool next_entry(const uint8_t **next, const uint8_t *stop, entry *e) {
    if (*next == stop) return false;
    e->cell += 1 + read_trusted(next);
    e->bytes = *next;
    for (uint32_t sets = read_trusted(next); sets > 0; sets--)
        for (uint32_t doors = read_trusted(next); doors > 0; doors--) read_trusted(next);
    e->size = (size_t)(*next - e->bytes);
    return true;
}

static sl_status append_entry(sl_context *context, const entry *e, uint32_t *last,
                              sli_row_bytes *row) {
    SL_TRY(append_number(context, row, e->cell - *last - 1));
    *last = e->cell;
    SL_TRY(SL_ARRAY_ROOM(context, row, e->size));
    memcpy(row->items + row->count, e->bytes, e->size);
    row->count += e->size;
    return SL_OK;
}

static sl_status mirror_rows(sl_context *context, const sli_row_bytes *rows, uint32_t count,
                             uint32_t *last, sli_row_bytes *out) {
    memset(last, 0xff, count * sizeof *last);
    for (uint32_t cell = 0; cell < count; cell++) {
        if (!rows[cell].count) continue;
        const uint8_t *next = rows[cell].items, *stop = next + rows[cell].count;
        for (entry e = {.cell = UINT32_MAX}; next_entry(&next, stop, &e);) {
            const entry back = {cell, e.bytes, e.size};
            SL_TRY(append_entry(context, &e, &last[cell], &out[cell]));
            SL_TRY(append_entry(context, &back, &last[e.cell], &out[e.cell]));
        }
    }
    return SL_OK;
}

sl_status sli_door_rows_mirror(sl_context *context, sli_row_bytes *rows, uint32_t count) {
    uint32_t *last = sl_alloc_array(context, count, sizeof *last);
    sli_row_bytes *out = sl_alloc_array(context, count, sizeof *out);
    const sl_status status =
        last && out ? mirror_rows(context, rows, count, last, out) : SL_NO_MEMORY;
    for (uint32_t cell = 0; cell < count; cell++) {
        if (status != SL_OK && out) sl_free(context, out[cell].items);
        if (status != SL_OK) continue;
        sl_free(context, rows[cell].items);
        rows[cell] = out[cell];
    }
    sl_free(context, last);
    sl_free(context, out);
    return status;
}
