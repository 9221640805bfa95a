/// Rows of door sets: reading them.
#include "sightline/doors.h"

#include "sightline/support.h"

void sl_door_sets_destroy(sl_context *context, sl_door_sets *sets) {
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

bool sl_door_sets_open(const sl_door_sets *sets, uint32_t from, uint32_t to, const bool *shut) {
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

sl_status sl_door_sets_check(sl_context *context, const sl_door_sets *sets, size_t door_count) {
    bool sound = !sets->cell_count || sets->offsets[0] == 0;
    for (uint32_t i = 0; i < sets->cell_count && sound; i++)
        sound = sets->offsets[i] <= sets->offsets[i + 1] &&
                sets->offsets[i + 1] <= sets->offsets[sets->cell_count];
    for (uint32_t i = 0; i < sets->cell_count && sound; i++)
        sound = row_is_sound(sets, i, door_count);
    if (sound) return SL_OK;
    return sl_fail(context, SL_BAD_INPUT, "the sets of doors are damaged");
}
