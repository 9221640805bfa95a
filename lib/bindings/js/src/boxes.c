/// A level with boxes that move: level.c, whose questions are answered past boxes.
#define LEVEL_BOXES
#include "level.c" // one module has one level

static sl_runtime_boxes boxes;
static uint32_t *boxes_scratch;
static unsigned char *seen;

/// The parts of the memory for boxes: the list first, which has the widest numbers, then words,
/// then a byte for each box.
static size_t list_size(uint32_t count) {
    return count * sizeof(sl_runtime_box);
}

static size_t lists_size(uint32_t count, uint32_t room) {
    return sl_runtime_boxes_count(&level, count, room) * sizeof(uint32_t);
}

static size_t scratch_size(uint32_t count) {
    const sl_runtime_boxes some = {.runtime = &level, .count = count};
    return sl_runtime_boxes_scratch_count(&some) * sizeof(uint32_t);
}

/// How many pairs of a box and a cell there is to be room for: eight for each box at first.
static uint32_t next_room(uint32_t count) {
    return boxes.room ? 2 * boxes.room : 8 * count;
}

EXPORT(size_t, boxes_size, uint32_t count) {
    return list_size(count) + lists_size(count, next_room(count)) + scratch_size(count) + count;
}

/// Starts with `count` boxes in `memory`, of boxes_size() bytes. Boxes of before, as many, keep
/// their places, and have twice the room. Gives where boxes_seen() puts its answer.
EXPORT(unsigned char *, boxes_start, unsigned char *memory, uint32_t count) {
    const sl_runtime_boxes old = boxes;
    const uint32_t room = next_room(count);
    unsigned char *lists = memory + list_size(count), *scratch = lists + lists_size(count, room);
    boxes_scratch = (uint32_t *)scratch;
    seen = scratch + scratch_size(count);
    sl_runtime_boxes_start(&boxes, &level, (sl_runtime_box *)memory, count, room,
                           (uint32_t *)lists);
    for (uint32_t i = 0; i < old.count; i++) sl_runtime_boxes_move(&boxes, i, &old.boxes[i]);
    return seen;
}

EXPORT(int, move_box, uint32_t box, double min_x, double min_y, double max_x, double max_y,
       int blocks) {
    const sl_runtime_box to = {min_x, min_y, max_x, max_y, blocks != 0};
    return sl_runtime_boxes_move(&boxes, box, &to);
}

EXPORT(uint32_t, boxes_seen, const unsigned char *shut, double range) {
    return sl_runtime_boxes_seen(&boxes, &view, shut, range, boxes_scratch, seen);
}

// As level.c has them. `scratch` is not used: that of boxes is larger.

EXPORT(uint32_t, look, const unsigned char *shut, double range, uint32_t *scratch,
       uint32_t *cells) {
    (void)scratch;
    return sl_runtime_look_past_boxes(&boxes, &view, shut, range, boxes_scratch, seen, cells,
                                      level.cell_count);
}

EXPORT(uint32_t, polygon, const unsigned char *shut, double range, uint32_t *scratch,
       double *points, uint32_t room) {
    (void)scratch;
    return sl_runtime_visible_polygon_past_boxes(&boxes, &view, shut, range, boxes_scratch, points,
                                                 room);
}

EXPORT(int, sees, double x0, double y0, double x1, double y1, const unsigned char *shut,
       uint32_t *scratch) {
    (void)scratch;
    return sl_runtime_sees_past_boxes(&boxes, x0, y0, x1, y1, shut, 0, boxes_scratch);
}

/// `own`: the box of who walks, or SL_RUNTIME_NO_BOX.
EXPORT(int, can_walk, double x0, double y0, double x1, double y1, const unsigned char *shut,
       uint32_t own) {
    return sl_runtime_can_walk_past_boxes(&boxes, x0, y0, x1, y1, shut, own);
}
