#include "cell_to_cell/door_table.h"

#include <string.h>

sl_status sl_door_table_create(sl_context *context, uint32_t cells, size_t doors, uint32_t limit,
                               sl_door_table *table) {
    *table = (sl_door_table){.words = sl_bits_words(doors), .cell_count = cells, .limit = limit};
    table->first = sl_alloc_array(context, cells, sizeof *table->first);
    table->count = sl_alloc_array(context, cells, sizeof *table->count);
    table->seen = sl_alloc_array(context, sl_bits_words(cells), sizeof *table->seen);
    table->free = sl_alloc_array(context, sl_bits_words(cells), sizeof *table->free);
    if (!table->first || !table->count || !table->seen || !table->free) return SL_NO_MEMORY;
    sl_door_table_clear(table);
    return SL_OK;
}

void sl_door_table_destroy(sl_context *context, sl_door_table *table) {
    sl_free(context, table->first);
    sl_free(context, table->count);
    sl_free(context, table->seen);
    sl_free(context, table->free);
    sl_free(context, table->alternatives.items);
    sl_free(context, table->sets.items);
    *table = (sl_door_table){0};
}

void sl_door_table_clear(sl_door_table *table) {
    const size_t words = sl_bits_words(table->cell_count);
    memset(table->first, 0xff, table->cell_count * sizeof *table->first);
    memset(table->count, 0, table->cell_count * sizeof *table->count);
    memset(table->seen, 0, words * sizeof *table->seen);
    memset(table->free, 0, words * sizeof *table->free);
    table->alternatives.count = table->sets.count = 0;
}

static const sl_bits *set_of(const sl_door_table *table, uint32_t alternative) {
    return table->sets.items + alternative * table->words;
}

static bool is_within(const sl_bits *set, const sl_bits *other, size_t words) {
    for (size_t i = 0; i < words; i++)
        if (set[i] & ~other[i]) return false;
    return true;
}

bool sl_door_table_proves(const sl_door_table *table, uint32_t cell, const sl_bits *doors) {
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

sl_status sl_door_table_add(sl_context *context, sl_door_table *table, uint32_t cell,
                            const sl_bits *doors) {
    const size_t words = table->words;
    sl_bits_add(table->seen, cell);
    if (sl_door_table_proves(table, cell, doors)) return SL_OK;
    if (is_empty(doors, words)) {
        sl_bits_add(table->free, cell);
        return SL_OK;
    }
    for (uint32_t i = table->first[cell]; i != UINT32_MAX; i = table->alternatives.items[i].next) {
        sl_door_alternative *old = &table->alternatives.items[i];
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
        (sl_door_alternative){.next = table->first[cell]};
    table->first[cell] = (uint32_t)table->alternatives.count++;
    table->count[cell]++;
    return SL_OK;
}

static sl_status append_number(sl_context *context, sl_row_bytes *row, uint32_t value) {
    SL_TRY(SL_ARRAY_ROOM(context, row, 5));
    for (; value > 127; value >>= 7) row->items[row->count++] = (uint8_t)(value | 128);
    row->items[row->count++] = (uint8_t)value;
    return SL_OK;
}

static sl_status append_set(sl_context *context, const sl_bits *set, size_t words,
                            sl_row_bytes *row) {
    uint32_t count = 0, last = UINT32_MAX;
    for (size_t i = 0; i < words; i++) count += (uint32_t)__builtin_popcountll(set[i]);
    SL_TRY(append_number(context, row, count));
    for (uint32_t door = 0; door < 64 * words; door++) {
        if (!sl_bits_has(set, door)) continue;
        SL_TRY(append_number(context, row, door - last - 1));
        last = door;
    }
    return SL_OK;
}

sl_status sl_door_table_append(sl_context *context, const sl_door_table *table, sl_row_bytes *row) {
    uint32_t last = UINT32_MAX;
    for (uint32_t cell = 0; cell < table->cell_count; cell++) {
        if (!table->count[cell] || sl_bits_has(table->free, cell)) continue;
        SL_TRY(append_number(context, row, cell - last - 1));
        SL_TRY(append_number(context, row, table->count[cell]));
        last = cell;
        for (uint32_t i = table->first[cell]; i != UINT32_MAX;
             i = table->alternatives.items[i].next)
            if (!table->alternatives.items[i].dropped)
                SL_TRY(append_set(context, set_of(table, i), table->words, row));
    }
    return SL_OK;
}
