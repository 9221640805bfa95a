/// The ground of placement: walls by their ends.
#include "analysis/placement/place_ground.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/support.h"

#include <stdlib.h>

static int compare_ends(const void *left, const void *right) {
    const sli_wall_end *a = left, *b = right;
    const int order = sli_compare_points(a->at, b->at);
    return order ? order : sli_compare_points(a->other, b->other);
}

bool sli_segment_holds(const sl_segment *segment, sl_point p) {
    const sl_point a = segment->a, b = segment->b;
    return p.x >= sli_lesser(a.x, b.x) && p.x <= sli_greater(a.x, b.x) &&
           p.y >= sli_lesser(a.y, b.y) && p.y <= sli_greater(a.y, b.y) && sli_orient(a, b, p) == 0;
}

/// Cuts walls at a point within them.
static sl_status cut_at(sl_context *context, const sl_space *space, sl_point at, sli_ground *out,
                        size_t *room) {
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_segment w = {space->walls[i].a, space->walls[i].b};
        if (sli_same_point(w.a, at) || sli_same_point(w.b, at) || !sli_segment_holds(&w, at))
            continue;
        SL_TRY(sl_reserve(context, &out->ends, room, out->end_count + 2, sizeof *out->ends));
        out->ends[out->end_count++] = (sli_wall_end){at, w.a};
        out->ends[out->end_count++] = (sli_wall_end){at, w.b};
    }
    return SL_OK;
}

static sl_status index_walls(sl_context *context, sli_ground *out) {
    const sl_space *space = out->space;
    sl_box *boxes = sl_alloc_array(context, space->wall_count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++)
        boxes[i] = sli_box_around(space->walls[i].a, space->walls[i].b);
    const sl_status status = sli_box_tree_create(context, boxes, space->wall_count, &out->walls);
    sl_free(context, boxes);
    return status;
}

static sl_status index_outside(sl_context *context, sli_ground *out) {
    const sl_space *space = out->space;
    sl_box *boxes = sl_alloc_array(context, space->cell_count, sizeof *boxes);
    out->outer = sl_alloc_array(context, space->cell_count, sizeof *out->outer);
    uint32_t count = 0;
    sl_status status = boxes && out->outer ? SL_OK : SL_NO_MEMORY;
    for (uint32_t c = 0; status == SL_OK && c < space->cell_count; c++) {
        const sl_point *corners = space->vertices + space->cells[c].first_vertex;
        if (space->cells[c].inside) continue;
        boxes[count] = sli_box_around(corners[0], corners[0]);
        for (uint32_t i = 1; i < space->cells[c].vertex_count; i++)
            boxes[count] = sli_box_with(boxes[count], corners[i]);
        out->outer[count++] = c;
    }
    if (status == SL_OK) status = sli_box_tree_create(context, boxes, count, &out->outside);
    sl_free(context, boxes);
    return status;
}

sl_status sli_ground_make(sl_context *context, const sl_space *space, const sl_map *map,
                          sli_ground *out) {
    *out = (sli_ground){.space = space, .end_count = 2 * (size_t)space->wall_count};
    size_t room = out->end_count;
    out->ends = sl_alloc_array(context, out->end_count, sizeof *out->ends);
    if (!out->ends) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        out->ends[2 * i] = (sli_wall_end){w->a, w->b};
        out->ends[2 * i + 1] = (sli_wall_end){w->b, w->a};
    }
    for (size_t i = 0; i < map->door_count; i++)
        for (size_t k = 0; k < sli_door_piece_count(&map->doors[i]); k++) {
            const sl_segment piece = sli_door_piece(&map->doors[i], k);
            SL_TRY(cut_at(context, space, piece.a, out, &room));
            SL_TRY(cut_at(context, space, piece.b, out, &room));
        }
    if (out->end_count) qsort(out->ends, out->end_count, sizeof *out->ends, compare_ends);
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const uint32_t *cell = space->portals[i].cell;
        if (space->cells[cell[0]].inside != space->cells[cell[1]].inside) out->open = true;
    }
    SL_TRY(index_walls(context, out));
    return out->open ? index_outside(context, out) : SL_OK;
}

void sli_ground_destroy(sl_context *context, sli_ground *ground) {
    sl_free(context, ground->ends);
    sl_free(context, ground->outer);
    sli_box_tree_destroy(context, &ground->walls);
    sli_box_tree_destroy(context, &ground->outside);
    *ground = (sli_ground){0};
}

const sli_wall_end *sli_ground_walls_at(const sli_ground *ground, sl_point at, size_t *count) {
    const size_t low = sli_first_at(ground->ends, sizeof *ground->ends, ground->end_count, at);
    *count = 0;
    while (low + *count < ground->end_count && sli_same_point(ground->ends[low + *count].at, at))
        ++*count;
    return ground->ends + low;
}

/// Whether the direction to w is strictly between those to a and to b, counter-clockwise.
static bool is_between(sl_point corner, sl_point a, sl_point b, sl_point w) {
    const int turn = sli_orient(corner, a, b);
    const int from = sli_orient(corner, a, w), to = sli_orient(corner, w, b);
    if (turn > 0) return from > 0 && to > 0;
    if (turn < 0) return from > 0 || to > 0;
    const bool same = sli_dot((sl_point){a.x - corner.x, a.y - corner.y},
                              (sl_point){b.x - corner.x, b.y - corner.y}) > 0;
    return !same && from > 0;
}

bool sli_ground_joins(const sli_ground *ground, sl_point corner, sl_point a, sl_point b) {
    size_t count, ahead = 0, back = 0;
    const sli_wall_end *walls = sli_ground_walls_at(ground, corner, &count);
    for (size_t i = 0; i < count; i++) {
        ahead += is_between(corner, a, b, walls[i].other);
        back += is_between(corner, b, a, walls[i].other);
    }
    return count < 2 || !ahead || !back;
}
