/// Random maps with doors and glass, axial or turned by an angle that leaves coordinates integers,
/// and boxes in them, for tests of what goes along lines. Boxes touch walls, doors, corners, the
/// points and each other.
#ifndef SL_RUNTIME_TRIAL_H
#define SL_RUNTIME_TRIAL_H

#include "runtime_maps.h"

#include "oracle/random_effects.h"

#include "sightline/bake.h"

enum {
    MAPS = 40,
    BOXES = 12,
    DOORS = 3,
    STATES = 4,
    LINES = 400,
    ROOM = 4096,
    GRID = 12,
    CELLS_MOST = 512
};

typedef struct trial {
    sl_context *context;
    sl_random random;
    bool turned;
    baked_file file;
    sl_query *query;
    unsigned char shut[DOORS];
    sl_moving_box boxes[BOXES];
    sl_runtime_box list[BOXES];
    sl_runtime_boxes placed;
    uint32_t *memory, *scratch;
    size_t sees[2], steps[2], hidden, stopped, same, wide[2], moves[3];
} trial;

/// 1 for a point in a box, 0 on its border, -1 outside.
static inline int place(sl_point p, sl_box b) {
    if (p.x < b.min.x || p.x > b.max.x || p.y < b.min.y || p.y > b.max.y) return -1;
    return b.min.x < p.x && p.x < b.max.x && b.min.y < p.y && p.y < b.max.y;
}

/// Whether a box reaches inside the bounds. One that only touches them from outside is in no cell.
static inline bool is_there(const trial *t, sl_box b) {
    const sl_runtime *r = &t->file.runtime;
    return b.min.x < r->max_x && b.max.x > r->min_x && b.min.y < r->max_y && b.max.y > r->min_y;
}

static inline double below(trial *t, uint64_t bound) {
    return (double)sl_random_below(&t->random, bound);
}

static inline sl_point turn(const trial *t, sl_point p) {
    return t->turned ? (sl_point){4 * p.x - 3 * p.y, 3 * p.x + 4 * p.y} : p;
}

static inline void turn_segment(const trial *t, sl_segment *s) {
    *s = (sl_segment){turn(t, s->a), turn(t, s->b)};
}

/// Prepares to ask of the file.
static inline void ask_of(trial *t) {
    const sl_runtime *r = &t->file.runtime;
    assert_ok(t->context, sl_query_create(t->context, &t->file.baked, &t->query));
    t->memory = malloc(sl_runtime_boxes_count(r, BOXES, ROOM) * sizeof *t->memory);
    assert_non_null(t->memory);
    sl_runtime_boxes_start(&t->placed, r, t->list, BOXES, ROOM, t->memory);
    t->scratch = malloc(sl_runtime_boxes_scratch_count(&t->placed) * sizeof *t->scratch);
    assert_non_null(t->scratch);
}

static inline void start(trial *t) {
    sl_map map = {0};
    const sl_bake_options options = sl_bake_options_default();
    random_effects_map(t->context, &t->random, SL_EFFECT_DOOR | SL_EFFECT_ONEWAY, GRID, &map);
    for (size_t i = 0; i < map.wall_count; i++) {
        map.walls[i].a = turn(t, map.walls[i].a);
        map.walls[i].b = turn(t, map.walls[i].b);
    }
    for (size_t i = 0; i < map.door_count; i++) {
        turn_segment(t, &map.doors[i].segment);
        for (size_t k = 0; k < map.doors[i].part_count; k++)
            turn_segment(t, &map.doors[i].parts[k]);
    }
    for (size_t i = 0; i < map.oneway_count; i++) turn_segment(t, &map.oneways[i].segment);
    t->file = (baked_file){.name = "random"};
    assert_ok(t->context, sl_bake(t->context, &map, &options, &t->file.baked, NULL));
    t->file.bytes = baked_bytes(t->context, &t->file.baked, &t->file.size);
    baked_file_open(&t->file);
    ask_of(t);
}

static inline void finish(trial *t) {
    sl_query_destroy(t->context, t->query);
    baked_file_destroy(t->context, &t->file);
    free(t->memory);
    free(t->scratch);
}

/// Anywhere, or on the lines of the map's grid.
static inline sl_point some_place(trial *t) {
    const double size = RANDOM_EFFECTS_SIZE * GRID, step = below(t, 2) != 0 ? GRID : GRID / 4;
    const sl_point grid = {step * below(t, (uint64_t)(size / step) + 1),
                           step * below(t, (uint64_t)(size / step) + 1)};
    if (below(t, 2) != 0) return turn(t, grid);
    const sl_runtime *r = &t->file.runtime;
    return (sl_point){r->min_x + below(t, (uint64_t)(r->max_x - r->min_x) + 1),
                      r->min_y + below(t, (uint64_t)(r->max_y - r->min_y) + 1)};
}

/// A corner of a box, a place on a side of one, or any other.
static inline sl_point some_point(trial *t) {
    const sl_box b = t->boxes[sl_random_below(&t->random, BOXES)].box;
    const sl_point at = {floor(b.min.x + below(t, 5) / 4 * (b.max.x - b.min.x)),
                         floor(b.min.y + below(t, 5) / 4 * (b.max.y - b.min.y))};
    return below(t, 3) != 0 ? some_place(t) : at;
}

static inline void set_state(trial *t) {
    for (uint32_t i = 0; i < t->file.runtime.door_count; i++) {
        t->shut[i] = (unsigned char)sl_random_below(&t->random, 2);
        sl_query_set_door_at(t->context, t->query, i, !t->shut[i]);
    }
    for (uint32_t i = 0; i < BOXES; i++) {
        const sl_point p = some_place(t);
        const double most = t->turned ? 60 : 30;
        const sl_box b = {p, {p.x + below(t, 4) / 3 * most, p.y + floor(below(t, 4) / 3 * most)}};
        t->boxes[i] = (sl_moving_box){b, sl_random_below(&t->random, 2)};
        const sl_runtime_box to = {b.min.x, b.min.y, b.max.x, b.max.y, t->boxes[i].blocks};
        assert_true(sl_runtime_boxes_move(&t->placed, i, &to));
    }
    assert_ok(t->context, sl_query_set_boxes(t->context, t->query, t->boxes, BOXES));
}

static inline void complain(const trial *t, sl_point p, sl_point q, const char *what) {
    for (int i = 0; i < BOXES; i++) {
        const sl_box b = t->boxes[i].box;
        if (t->boxes[i].blocks)
            print_message("box %d: %g,%g %g,%g\n", i, b.min.x, b.min.y, b.max.x, b.max.y);
    }
    fail_msg("%s%g,%g to %g,%g: %s", t->turned ? "turned, " : "", p.x, p.y, q.x, q.y, what);
}

#endif
