/// The runtime header for JavaScript. One WebAssembly instance holds one level. JavaScript puts the
/// file and all scratch memory behind `__heap_base`, so this module needs no allocator.
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#define SL_RUNTIME_SMALL_OPEN
#define SL_RUNTIME_WITHOUT_OLD_FILES // sightline/bake writes these anew
#include "runtime/sightline_runtime.h"

#define EXPORT(type, name, ...)                                                                    \
    type level_##name(__VA_ARGS__);                                                                \
    __attribute__((export_name(#name))) type level_##name(__VA_ARGS__)

/// What JavaScript reads and writes directly.
static sl_runtime level;
static sl_runtime_state state;
static sl_runtime_view view;
static double numbers[8];
static uint32_t integers[8];

EXPORT(sl_runtime_view *, view_place, void) {
    return &view;
}

EXPORT(double *, numbers_place, void) {
    return numbers;
}

EXPORT(uint32_t *, integers_place, void) {
    return integers;
}

EXPORT(int, open, const void *bytes, size_t size) {
    return (int)sl_runtime_open(bytes, size, &level);
}

EXPORT(const char *, status_text, int status) {
    return sl_runtime_status_text((sl_runtime_status)status);
}

_Static_assert(offsetof(sl_runtime, range) == 4 * sizeof(double) &&
                   offsetof(sl_runtime_transform, scale) == 2 * sizeof(double) &&
                   sizeof(sl_runtime_cell) == 4 * sizeof(uint32_t),
               "what is copied as a whole, in the order of the header");

/// numbers: bounds, range, the transform of the file; integers: counts and flags, and what is known
/// of mirrors.
EXPORT(void, describe, void) {
    memcpy(numbers, &level, 5 * sizeof *numbers);
    memcpy(numbers + 5, &level.transform, 3 * sizeof *numbers);
    integers[0] = level.cell_count;
    integers[1] = level.transform.y_down;
    integers[2] = level.door_count;
    integers[3] = sl_runtime_start_count(&level);
    integers[4] = (uint32_t)sl_runtime_scratch_count(&level);
    integers[5] = (uint32_t)level.mirrors;
    integers[6] = level.unfinished;
    integers[7] = (uint32_t)sl_runtime_state_count(&level);
}

/// The doors as the map has them. Gives where their bytes are: all calls take them as `shut`.
EXPORT(unsigned char *, start_doors, uint32_t *memory) {
    sl_runtime_state_start(&state, &level, memory);
    return state.shut;
}

EXPORT(int, set_door, uint32_t door, int shut) {
    return sl_runtime_state_set_door(&state, door, shut);
}

EXPORT(uint32_t, settle, uint32_t portals) {
    return sl_runtime_settle(&state, portals);
}

EXPORT(int, wall, uint32_t wall) {
    return sl_runtime_wall(&level, wall, (sl_runtime_segment *)numbers);
}

EXPORT(uint32_t, locate, double x, double y) {
    return sl_runtime_locate(&level, x, y);
}

// Of the calls with `mirrored`: 1 to count what is seen by mirror, too; 0 to take mirrors for
// walls.

EXPORT(int, can_see, uint32_t from, uint32_t to, int mirrored) {
    return mirrored ? sl_runtime_can_see_mirrored(&level, from, to, state.shut)
                    : sl_runtime_state_can_see(&state, from, to);
}

/// Whether something in cell `to` may be seen by mirror from a point.
EXPORT(int, may_mirror, double x, double y, uint32_t to, const unsigned char *shut,
       uint32_t *scratch) {
    const sl_runtime rows = slrt_mirrored(&level);
    const sl_runtime_view eye = sl_runtime_view_all_round(x, y);
    slrt_search s;
    if (!level.mirrors || sl_runtime_is_solid(&level, to)) return false;
    if (!slrt_start_search(&s, &level, &eye, shut, 0, scratch)) return false;
    if (level.mirrors == SL_RUNTIME_MIRRORS_NOT_BAKED || !sl_runtime_has_row(&level, s.eye_cell))
        return true;
    slrt_follow(&s, NULL);
    for (uint32_t i = 0; i < s.own_count; i++)
        if (sl_runtime_can_see_past(&rows, s.path[i], to, shut)) return true;
    return false;
}

/// Gives how many cells are seen, in place of those that see. `bits` has room for the bits of two
/// rows.
EXPORT(uint32_t, seen_from, uint32_t *cells, uint32_t count, unsigned char *bits, int mirrored) {
    const uint32_t bytes = (level.cell_count + 7) / 8;
    uint32_t seen = 0;
    memset(bits, 0, bytes);
    if (mirrored) sl_runtime_seen_from_mirrored(&level, cells, count, state.shut, bits);
    for (uint32_t i = 0; i < count && !mirrored; i++) {
        sl_runtime_state_row_bits(&state, cells[i], bits + bytes);
        for (uint32_t k = 0; k < bytes; k++) bits[k] |= bits[bytes + k];
    }
    for (uint32_t cell = 0; cell < level.cell_count; cell++)
        if (bits[cell / 8] >> cell % 8 & 1) cells[seen++] = cell;
    return seen;
}

EXPORT(uint32_t, view_cell, uint32_t cell) {
    return sl_runtime_view_cell(&level, cell);
}

EXPORT(uint32_t, box_cells, double min_x, double min_y, double max_x, double max_y, uint32_t *cells,
       uint32_t room) {
    return sl_runtime_box_cells(&level, min_x, min_y, max_x, max_y, cells, room);
}

/// As look, and after these cells those that are seen by mirror. integers: how many are seen
/// directly.
EXPORT(uint32_t, look_mirrored, const unsigned char *shut, double range, uint32_t *scratch,
       uint32_t *cells) {
    return sl_runtime_look_mirrored(&level, &view, shut, range, scratch, cells, level.cell_count,
                                    &integers[0]);
}

/// integers: vertices, directed portals, inside, solid, has a row.
EXPORT(void, cell, uint32_t cell) {
    const sl_runtime_cell c = sl_runtime_get_cell(&level, cell);
    memcpy(integers, &c, sizeof c);
    integers[4] = sl_runtime_is_inside(&level, cell);
    integers[5] = sl_runtime_is_solid(&level, cell);
    integers[6] = sl_runtime_has_row(&level, cell);
}

EXPORT(void, vertex, uint32_t vertex) {
    sl_runtime_get_vertex(&level, vertex, &numbers[0], &numbers[1]);
}

/// integers: portal, cell behind it; numbers: its left and right end.
EXPORT(void, directed_portal, uint32_t directed) {
    const sl_runtime_directed_portal d = sl_runtime_get_directed_portal(&level, directed);
    const size_t ends = offsetof(sl_runtime_directed_portal, left);
    memcpy(integers, &d, ends);
    memcpy(numbers, (const char *)&d + ends, sizeof d - ends);
}

/// integers: where its name is, its length, its kind; returns its segments.
EXPORT(uint32_t, door, uint32_t door, sl_runtime_segment *segments, uint32_t room) {
    const sl_runtime_name name = sl_runtime_door_name(&level, door);
    integers[0] = (uint32_t)(uintptr_t)name.text;
    integers[1] = name.length;
    integers[2] = (uint32_t)sl_runtime_get_door_kind(&level, door);
    return sl_runtime_door_segments(&level, door, segments, room);
}

EXPORT(void, start, uint32_t number) {
    sl_runtime_start(&level, number, (sl_runtime_viewpoint *)numbers);
}

#ifndef LEVEL_BOXES // boxes.c has these four, past boxes

EXPORT(uint32_t, look, const unsigned char *shut, double range, uint32_t *scratch,
       uint32_t *cells) {
    return sl_runtime_look_past(&level, &view, shut, range, scratch, cells, level.cell_count);
}

EXPORT(uint32_t, polygon, const unsigned char *shut, double range, uint32_t *scratch,
       double *points, uint32_t room) {
    return sl_runtime_visible_polygon(&level, &view, shut, range, scratch, points, room);
}

EXPORT(int, sees, double x0, double y0, double x1, double y1, const unsigned char *shut,
       uint32_t *scratch) {
    return sl_runtime_sees(&level, x0, y0, x1, y1, shut, 0, scratch);
}

EXPORT(int, can_walk, double x0, double y0, double x1, double y1, const unsigned char *shut) {
    return sl_runtime_can_walk(&level, x0, y0, x1, y1, shut);
}

#endif
