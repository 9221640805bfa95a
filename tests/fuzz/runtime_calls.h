/// Calls of every function of the runtime on an open file. Whatever the file holds, none reads or
/// writes out of bounds (the sanitizers watch), comes to no end, or breaks what the header says.
#ifndef SL_RUNTIME_CALLS_H
#define SL_RUNTIME_CALLS_H

#include "fuzz.h"

#include "sightline/support.h"

#include <math.h>

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

/// Buffers of just the size that the header asks for, so that a byte more is found out.
typedef struct buffers {
    unsigned char *bits, *seen;
    uint32_t *scratch, *cells;
} buffers;

static void *room(size_t bytes) {
    void *block = malloc(bytes ? bytes : 1);
    FUZZ_CHECK(block);
    return block;
}

static void check_row(const sl_runtime *r, uint32_t cell, const buffers *b) {
    uint32_t count = 0, end = 0;
    sl_runtime_row_bits(r, cell, b->bits);
    sl_runtime_run run = sl_runtime_row(r, cell);
    while (sl_runtime_next(&run)) {
        FUZZ_CHECK(run.first < run.end && run.end <= r->cell_count && (!end || run.first > end));
        end = run.end;
        count += run.end - run.first;
    }
    FUZZ_CHECK(sl_runtime_row_count(r, cell) == count);
    FUZZ_CHECK(sl_runtime_has_row(r, cell) == (count > 0));
    FUZZ_CHECK(sl_runtime_can_see(r, cell, cell) == (count > 0));
    for (uint32_t to = 0; to < r->cell_count; to++) {
        const bool sees = sl_runtime_can_see(r, cell, to);
        FUZZ_CHECK(sees == (b->bits[to / 8] >> to % 8 & 1));
        count -= sees;
    }
    FUZZ_CHECK(count == 0);
    sl_runtime_passage passage;
    if (sl_runtime_passages(r, cell, &passage, 1)) FUZZ_CHECK(passage.cell < r->cell_count);
    FUZZ_CHECK(sl_runtime_portal_stops(r, cell) < 2 * SL_RUNTIME_STOPS_LIMITED); // a number too
    run = sl_runtime_mirrored_row(r, cell);
    while (sl_runtime_next(&run)) FUZZ_CHECK(run.first < run.end && run.end <= r->cell_count);
    const uint32_t seen = sl_runtime_seen_from_mirrored(r, &cell, 1, NULL, b->bits);
    for (uint32_t to = 0; to < r->cell_count; to++)
        count += sl_runtime_can_see_mirrored(r, cell, to, NULL);
    FUZZ_CHECK(seen == count);
}

/// Into mirrors likewise.
static void check_into_mirrors(const sl_runtime *r, const sl_runtime_view *view, uint32_t seen,
                               const buffers *b) {
    enum { DEPTH = 2 };
    uint32_t *scratch = room(sl_runtime_mirrored_scratch_count(r, DEPTH) * sizeof *scratch);
    uint32_t direct = 0;
    bool rounded = true;
    const uint32_t count = sl_runtime_look_into_mirrors(r, view, NULL, 0, DEPTH, scratch, b->cells,
                                                        r->cell_count, &direct, &rounded);
    FUZZ_CHECK(direct == seen && count >= direct && count <= r->cell_count);
    FUZZ_CHECK(r->mirrors || r->mirror_count || (count == direct && !rounded));
    for (uint32_t i = 0; i < count; i++)
        FUZZ_CHECK(b->cells[i] < r->cell_count && b->seen[b->cells[i]] == (i < direct));
    free(scratch);
}

/// By mirror no cell of `seen` is lost, and none comes twice. Leaves `seen` as it was.
static void check_mirrored(const sl_runtime *r, const sl_runtime_view *view, uint32_t seen,
                           const buffers *b) {
    uint32_t direct = 0;
    const uint32_t count =
        sl_runtime_look_mirrored(r, view, NULL, 0, b->scratch, b->cells, r->cell_count, &direct);
    FUZZ_CHECK(direct == seen && count >= direct && count <= r->cell_count);
    FUZZ_CHECK(r->mirrors || count == direct);
    for (uint32_t i = 0; i < count; i++)
        FUZZ_CHECK(b->cells[i] < r->cell_count && b->seen[b->cells[i]] == (i < direct));
    check_into_mirrors(r, view, seen, b);
}

/// Whether a row of a cell that the eye stands in has a cell, or one of a cell at glass in its
/// line.
static bool is_in_rows(const sl_runtime *r, const sl_runtime_view *view, uint32_t cell,
                       const buffers *b) {
    slrt_search s;
    if (!slrt_start_search(&s, r, view, NULL, 0, b->scratch)) return false;
    memset(s.marks, 0, r->cell_count);
    slrt_follow(&s, NULL);
    for (uint32_t i = 0; i < s.own_count; i++)
        if (sl_runtime_can_see(r, s.path[i], cell)) return true;
    if (r->has_glass) slrt_allow_rows_in_line(&s);
    return s.marks[cell] & SLRT_IN_ROW;
}

static void check_look(const sl_runtime *r, const sl_runtime_view *view, const buffers *b) {
    const uint32_t cell = sl_runtime_locate(r, slrt_no_dust(view->x), slrt_no_dust(view->y));
    const uint32_t count = sl_runtime_look(r, view, b->scratch, b->cells, r->cell_count);
    const bool looks = cell != SL_RUNTIME_NO_CELL && !sl_runtime_is_solid(r, cell);
    FUZZ_CHECK((!count || looks) && count <= r->cell_count);
    memset(b->seen, 0, r->cell_count);
    for (uint32_t i = 0; i < count; i++) {
        FUZZ_CHECK(b->cells[i] < r->cell_count && !b->seen[b->cells[i]]++);
        FUZZ_CHECK(!i || b->cells[i] != cell);
        FUZZ_CHECK(!sl_runtime_has_row(r, cell) || is_in_rows(r, view, b->cells[i], b));
    }
    check_mirrored(r, view, count, b);
}

/// Past doors and within a range no more is seen; `seen` is what check_look has left.
static void check_look_past(const sl_runtime *r, const sl_runtime_view *view, double range,
                            const buffers *b) {
    unsigned char shut[64];
    for (size_t i = 0; i < sizeof shut; i++) shut[i] = i % 3 == 0;
    const bool few = r->door_count <= sizeof shut;
    const uint32_t count = sl_runtime_look_past(r, view, few ? shut : NULL, range, b->scratch,
                                                b->cells, r->cell_count);
    for (uint32_t i = 0; i < count; i++)
        FUZZ_CHECK(b->cells[i] < r->cell_count && b->seen[b->cells[i]]);
    // Whoever has a row sees at least itself.
    const uint32_t seen = sl_runtime_seen_from(r, b->cells, count, few ? shut : NULL, b->bits);
    FUZZ_CHECK(seen <= r->cell_count);
    for (uint32_t i = 0; i < count && !r->door_count; i++)
        FUZZ_CHECK(!sl_runtime_can_see(r, b->cells[i], b->cells[i]) ||
                   b->bits[b->cells[i] / 8] >> b->cells[i] % 8 & 1);
}

/// The polygon has finite points, the same number of them for any room, and writes no more.
static void check_polygon(const sl_runtime *r, const sl_runtime_view *view, double range,
                          const buffers *b) {
    unsigned char shut[64];
    for (size_t i = 0; i < sizeof shut; i++) shut[i] = i % 3 == 0;
    const unsigned char *doors = r->door_count <= sizeof shut ? shut : NULL;
    const uint32_t count = sl_runtime_visible_polygon(r, view, doors, range, b->scratch, NULL, 0);
    FUZZ_CHECK(count == 0 || count >= 3);
    if (count > 1 << 20) return;
    double *points = room(2 * (size_t)count * sizeof *points);
    FUZZ_CHECK(sl_runtime_visible_polygon(r, view, doors, range, b->scratch, points, count) ==
               count);
    for (uint32_t i = 0; i < 2 * count; i++) FUZZ_CHECK(isfinite(points[i]));
    free(points);
}

/// Parts come after their parents, and share out the points.
static void check_mirror_parts(const sl_runtime *r, const sl_runtime_view *view, double range,
                               const buffers *b) {
    enum { PARTS = 8 };
    sl_runtime_mirror_part parts[PARTS];
    double few[8];
    uint32_t count, all = 0;
    const uint32_t points = sl_runtime_visible_polygon_mirrored(r, view, NULL, range, 3, b->scratch,
                                                                parts, PARTS, &count, few, 4);
    for (uint32_t i = 0; i < count && count <= PARTS; all += parts[i++].count)
        FUZZ_CHECK(parts[i].first == all && parts[i].count >= 3 && parts[i].depth <= 3 &&
                   (parts[i].depth ? parts[i].parent < i : i == 0));
    FUZZ_CHECK(count > PARTS || all == points);
    for (uint32_t k = 0; k < 2 * points && k < 8; k++) FUZZ_CHECK(isfinite(few[k]));
}

/// Whether a cell has a point within its sides. In a damaged file it need not be found there.
static bool is_in_a_cell(const sl_runtime *r, double x, double y) {
    for (uint32_t i = 0; i < r->cell_count; i++)
        if (slrt_holds(r, i, x, y)) return true;
    return false;
}

/// Both ends of a line of sight and of a step are in cells, whatever the walls of the file are.
static void check_points(const sl_runtime *r, double x, double y, sl_random *random,
                         const buffers *b) {
    const double to_x = sl_random_below(random, 4) ? x + sl_random_unit(random) : odd_real(random);
    const double to_y = sl_random_below(random, 4) ? y + sl_random_unit(random) : odd_real(random);
    const bool walks = sl_runtime_can_walk(r, x, y, to_x, to_y, NULL);
    if (!sl_runtime_sees(r, x, y, to_x, to_y, NULL, odd_real(random), b->scratch) && !walks) return;
    FUZZ_CHECK(sl_runtime_locate(r, slrt_no_dust(x), slrt_no_dust(y)) < r->cell_count);
    FUZZ_CHECK(sl_runtime_locate(r, slrt_no_dust(to_x), slrt_no_dust(to_y)) < r->cell_count ||
               is_in_a_cell(r, slrt_no_dust(to_x), slrt_no_dust(to_y)));
}

static void check_place(const sl_runtime *r, double x, double y, sl_random *random,
                        const buffers *b) {
    const uint32_t cell = sl_runtime_locate(r, x, y);
    const bool within = x >= r->min_x && x <= r->max_x && y >= r->min_y && y <= r->max_y;
    const bool found = cell < r->cell_count;
    FUZZ_CHECK(found || cell == SL_RUNTIME_NO_CELL);
    FUZZ_CHECK(within ? found || r->grid_cells || r->loose : !found);
    const sl_runtime_view round = sl_runtime_view_all_round(x, y);
    check_look(r, &round, b);
    check_polygon(r, &round, 0, b);
    check_polygon(r, &round, odd_real(random), b);
    check_mirror_parts(r, &round, odd_real(random), b);
    check_look_past(r, &round, sl_random_unit(random) * (r->max_x - r->min_x), b);
    check_points(r, x, y, random, b);
    sl_runtime_view cone = round;
    cone.all_round = false;
    for (int i = 0; i < 2; i++) {
        cone.left[i] = sl_random_below(random, 4) ? sl_random_unit(random) - 0.5 : odd_real(random);
        cone.right[i] =
            sl_random_below(random, 4) ? sl_random_unit(random) - 0.5 : odd_real(random);
    }
    check_look(r, &cone, b);
    check_polygon(r, &cone, sl_random_unit(random) * (r->max_x - r->min_x), b);
    check_mirror_parts(r, &cone, 0, b);
}

/// A corner, somewhere within the bounds, or the middle of a portal.
static void check_kind_of_place(const sl_runtime *r, int kind, sl_random *random,
                                const buffers *b) {
    double x, y;
    if (kind == 0) {
        sl_runtime_get_vertex(r, (uint32_t)sl_random_below(random, r->vertex_count), &x, &y);
        check_place(r, x, y, random, b);
    } else if (kind == 1) {
        check_place(r, r->min_x + sl_random_unit(random) * (r->max_x - r->min_x),
                    r->min_y + sl_random_unit(random) * (r->max_y - r->min_y), random, b);
    } else if (r->directed_count) {
        const sl_runtime_directed_portal e =
            sl_runtime_get_directed_portal(r, (uint32_t)sl_random_below(random, r->directed_count));
        FUZZ_CHECK(e.cell < r->cell_count && e.portal < r->portal_count);
        check_place(r, e.left[0] / 2 + e.right[0] / 2, e.left[1] / 2 + e.right[1] / 2, random, b);
    }
}

/// `rounds` places of each kind, and an odd one; for 0 rounds one place of all these.
static void check_places(const sl_runtime *r, int rounds, sl_random *random, const buffers *b) {
    const int only = rounds ? 3 : (int)sl_random_below(random, 4);
    for (int i = 0; i < rounds; i++)
        for (int kind = 0; kind < 3; kind++) check_kind_of_place(r, kind, random, b);
    if (only < 3) check_kind_of_place(r, only, random, b);
    if (only == 3) check_place(r, odd_real(random), odd_real(random), random, b);
}

/// The bytes of a name are in the block.
static void check_name(sl_runtime_name name) {
    FUZZ_CHECK(name.length > 0);
    volatile char last = name.text[name.length - 1];
    (void)last;
}

/// Objects, paths and mirrors.
static void check_other_things(const sl_runtime *r) {
    sl_runtime_name name;
    sl_runtime_segment at;
    bool one_sided;
    uint32_t count;
    for (uint32_t i = 0; i < r->object_count && i < 64; i++) {
        FUZZ_CHECK(sl_runtime_object(r, i, &name, &at) && isfinite(at.x0) && isfinite(at.y1));
        check_name(name);
    }
    for (uint32_t i = 0; i < r->path_count && i < 64; i++) {
        FUZZ_CHECK(sl_runtime_path(r, i, &name, &count));
        check_name(name);
        double *points = room(2 * (size_t)count * sizeof *points);
        sl_runtime_path_points(r, i, points);
        for (size_t k = 0; k < 2 * (size_t)count; k++) FUZZ_CHECK(isfinite(points[k]));
        free(points);
    }
    for (uint32_t i = 0; i < r->mirror_count && i < 64; i++)
        FUZZ_CHECK(sl_runtime_mirror(r, i, &at, &one_sided) && isfinite(at.x0) && isfinite(at.y1));
}

/// Doors and starts.
static void check_things(const sl_runtime *r) {
    const uint32_t doors = r->door_count < 64 ? r->door_count : 64;
    const uint32_t starts = sl_runtime_start_count(r);
    for (uint32_t i = 0; i < doors; i++) {
        const sl_runtime_name name = sl_runtime_door_name(r, i);
        char copy[256];
        sl_runtime_segment at[2];
        check_name(name);
        sl_runtime_door_open(r, i);
        sl_runtime_door_segments(r, i, at, 2);
        if (name.length >= sizeof copy || memchr(name.text, 0, name.length)) continue;
        memcpy(copy, name.text, name.length);
        copy[name.length] = '\0';
        FUZZ_CHECK(sl_runtime_find_door(r, copy) <= i);
    }
    for (uint32_t i = 0; i < starts && i < 64; i++) {
        sl_runtime_viewpoint start;
        FUZZ_CHECK(sl_runtime_start(r, i, &start) && isfinite(start.heading));
    }
    check_other_things(r);
}

/// What a view cell sees, and what cells see past doors.
static void check_views(const sl_runtime *r, const unsigned char *shut, const buffers *b) {
    for (uint32_t view = 0; view < r->view_cell_count; view++) {
        sl_runtime_view_bits(r, view, b->bits);
        for (uint32_t to = 0; to < r->cell_count; to++)
            FUZZ_CHECK(sl_runtime_view_can_see(r, view, to) == (b->bits[to / 8] >> to % 8 & 1));
    }
    FUZZ_CHECK(!sl_runtime_view_can_see(r, r->view_cell_count, 0));
    for (uint32_t cell = 0; cell < r->cell_count; cell++) {
        const uint32_t view = sl_runtime_view_cell(r, cell);
        FUZZ_CHECK(view < r->view_cell_count || view == SL_RUNTIME_NO_CELL);
        sl_runtime_is_inside(r, cell);
        const uint32_t to = r->cell_count - 1 - cell;
        FUZZ_CHECK(!sl_runtime_can_see_past(r, cell, to, shut) || sl_runtime_can_see(r, cell, to));
    }
}

/// A box about a place of the map, or anywhere.
static sl_runtime_box some_box(const sl_runtime *r, sl_random *random) {
    const double x = r->min_x + sl_random_unit(random) * (r->max_x - r->min_x),
                 y = r->min_y + sl_random_unit(random) * (r->max_y - r->min_y);
    const double wide = (r->max_x - r->min_x) * sl_random_unit(random) / 2,
                 high = (r->max_y - r->min_y) * sl_random_unit(random) / 2;
    sl_runtime_box box = {x, y, x + wide, y + high, sl_random_below(random, 2)};
    if (!sl_random_below(random, 8)) box.min_x = odd_real(random);
    if (!sl_random_below(random, 8)) box.max_y = odd_real(random);
    return box;
}

static void ask_boxes(const sl_runtime_boxes *boxes, const unsigned char *shut, sl_random *random,
                      const buffers *b) {
    const sl_runtime *r = boxes->runtime;
    uint32_t *scratch = room(sl_runtime_boxes_scratch_count(boxes) * sizeof *scratch);
    unsigned char *seen = room(boxes->count);
    double few[8];
    for (int i = 0; i < 2; i++) {
        const double x = r->min_x + sl_random_unit(random) * (r->max_x - r->min_x),
                     y = r->min_y + sl_random_unit(random) * (r->max_y - r->min_y);
        sl_runtime_view view = sl_runtime_view_all_round(x, y);
        if (i)
            view = sl_runtime_view_toward(x, y, odd_real(random), sl_random_unit(random) - 0.5,
                                          sl_random_unit(random) * 4);
        const double range = i ? sl_random_unit(random) * (r->max_x - r->min_x) : 0;
        uint32_t count = sl_runtime_boxes_seen(boxes, &view, shut, range, scratch, seen);
        for (uint32_t k = 0; k < boxes->count; k++) count -= seen[k];
        FUZZ_CHECK(count == 0);
        const uint32_t cells = sl_runtime_look_past_boxes(boxes, &view, shut, range, scratch, seen,
                                                          b->cells, r->cell_count);
        FUZZ_CHECK(cells <= r->cell_count);
        for (uint32_t k = 0; k < cells; k++) FUZZ_CHECK(b->cells[k] < r->cell_count);
        const double x1 = i ? odd_real(random) : x + range / 8, y1 = y - range / 8;
        count = sl_runtime_visible_polygon_past_boxes(boxes, &view, shut, range, scratch, few, 4);
        FUZZ_CHECK(count == 0 || count >= 3);
        for (uint32_t k = 0; k < 2 * count && k < 8; k++) FUZZ_CHECK(isfinite(few[k]));
        sl_runtime_sees_past_boxes(boxes, x, y, x1, y1, shut, range, scratch);
        sl_runtime_can_walk_past_boxes(boxes, x, y, x1, y1, shut, (uint32_t)i);
        const sl_runtime_walker walker = {i ? odd_real(random) : range / 16, shut, boxes, 0};
        double to_x, to_y;
        const bool can = sl_runtime_can_walk_wide(r, &walker, x, y, x1, y1, scratch);
        FUZZ_CHECK(sl_runtime_walk(r, &walker, x, y, x1, y1, scratch, &to_x, &to_y) || !can);
    }
    free(scratch);
    free(seen);
}

/// Boxes that move, with so little room at times that some have none.
static void check_boxes(const sl_runtime *r, const unsigned char *shut, sl_random *random,
                        const buffers *b) {
    enum { BOXES = 4 };
    const uint32_t pairs = (uint32_t)sl_random_below(random, 3) * 8;
    sl_runtime_box list[BOXES];
    uint32_t *memory = room(sl_runtime_boxes_count(r, BOXES, pairs) * sizeof *memory);
    sl_runtime_boxes boxes;
    sl_runtime_boxes_start(&boxes, r, list, BOXES, pairs, memory);
    for (uint32_t i = 0; i < 2 * BOXES; i++) {
        const sl_runtime_box box = some_box(r, random);
        const uint32_t count = sl_runtime_box_cells(r, box.min_x, box.min_y, box.max_x, box.max_y,
                                                    b->cells, r->cell_count);
        FUZZ_CHECK(count <= r->cell_count);
        sl_runtime_boxes_move(&boxes, i % BOXES, &box);
    }
    ask_boxes(&boxes, shut, random, b);
    free(memory);
}

/// Who may see whom: as many pairs as there are bits.
static void check_relevant(const sl_runtime *r, const unsigned char *shut, sl_random *random,
                           const buffers *b) {
    enum { PLAYERS = 3, THINGS = 9 };
    sl_runtime_box players[PLAYERS], things[THINGS];
    const uint32_t count = (uint32_t)sl_random_below(random, THINGS + 1);
    const double margin = sl_random_below(random, 4) ? 0 : odd_real(random);
    const double range = sl_random_below(random, 2) ? 0 : odd_real(random);
    for (int i = 0; i < PLAYERS; i++) players[i] = some_box(r, random);
    for (int i = 0; i < THINGS; i++) things[i] = some_box(r, random);
    uint32_t *scratch = room(sl_runtime_relevant_count(r, count) * sizeof *scratch);
    unsigned char *bits = room(PLAYERS * (((size_t)count + 7) / 8));
    size_t pairs =
        sl_runtime_relevant(r, players, PLAYERS, margin, things, count, shut, range, scratch, bits);
    for (uint32_t i = 0; i < PLAYERS; i++)
        for (uint32_t k = 0; k < count; k++)
            pairs -= bits[i * ((count + 7) / 8) + k / 8] >> k % 8 & 1;
    FUZZ_CHECK(pairs == 0);
    free(scratch);
    free(bits);
    sl_runtime_sees_within(r, players[0].min_x, players[0].min_y, margin, things[0].min_x,
                           things[0].min_y, 1, shut, range, b->scratch);
}

/// A way from somewhere to somewhere, with memory for a few nodes.
static void check_way(const sl_runtime *r, const unsigned char *shut, sl_random *random) {
    enum { ROOM = 16 };
    const uint32_t nodes = (uint32_t)sl_random_below(random, 500);
    const uint32_t points = (uint32_t)sl_random_below(random, ROOM + 1);
    const sl_runtime_box from = some_box(r, random), to = some_box(r, random);
    uint32_t *scratch = room(sl_runtime_way_scratch_count(r, nodes) * sizeof *scratch);
    double *found = room(2 * points * sizeof *found);
    sl_runtime_way way;
    const sl_runtime_way_status status = sl_runtime_find_way(
        r, from.min_x, from.min_y, to.max_x, to.max_y, shut, scratch, nodes, found, points, &way);
    FUZZ_CHECK((status == SL_RUNTIME_WAY_FOUND) == (way.count >= 2 && way.count <= points));
    FUZZ_CHECK((status == SL_RUNTIME_WAY_ROOM) == (way.count > points));
    free(scratch);
    free(found);
}

/// Calls them all. `rounds`: how thoroughly eyes are placed.
static void check_open(const sl_runtime *r, int rounds, sl_random *random) {
    const buffers b = {.bits = room((r->cell_count + 7) / 8),
                       .seen = room(r->cell_count),
                       .scratch = room(sl_runtime_scratch_count(r) * sizeof *b.scratch),
                       .cells = room(r->cell_count * sizeof *b.cells)};
    for (uint32_t cell = 0; cell < r->cell_count; cell++) {
        const sl_runtime_cell c = sl_runtime_get_cell(r, cell);
        FUZZ_CHECK((uint64_t)c.first_directed + c.directed_count <= r->directed_count);
        FUZZ_CHECK((uint64_t)c.first_vertex + c.vertex_count <= r->vertex_count);
        check_row(r, cell, &b);
    }
    FUZZ_CHECK(!sl_runtime_can_see(r, r->cell_count, 0) &&
               !sl_runtime_can_see(r, 0, r->cell_count));
    check_things(r);
    check_places(r, rounds, random, &b);
    unsigned char *shut = NULL;
    if (r->door_count && r->door_count <= 64) shut = room(r->door_count);
    for (uint32_t i = 0; shut && i < r->door_count; i++) shut[i] = i % 3 != 0;
    check_views(r, shut, &b);
    if (rounds || !sl_random_below(random, 4)) check_boxes(r, shut, random, &b);
    if (rounds || !sl_random_below(random, 4)) check_relevant(r, shut, random, &b);
    if (rounds || !sl_random_below(random, 4)) check_way(r, shut, random);
    free(shut);
    free(b.bits);
    free(b.seen);
    free(b.scratch);
    free(b.cells);
}

#endif
