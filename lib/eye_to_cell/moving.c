/// Boxes that move: the space is cut along their sides (space/boxes.h), and the exact search tells
/// which pieces of them it meets (box_targets.h).
#include "sightline/moving.h"

#include "eye_to_cell/box_targets.h"
#include "eye_to_cell/eye_methods.h"
#include "eye_to_cell/eye_search.h"
#include "geometry/crossing.h"
#include "sightline/map.h"
#include "sightline/sees.h"

#include <string.h>

struct sl_moving {
    sl_box_ground ground;
    const sl_visibility *visibility;
    double range;
    const sl_map *mirrors; ///< the map that has them, NULL for none
    uint32_t depth;        ///< of reflections
    sl_moving_box *boxes;
    size_t count;
    sl_boxed_space *boxed;
    sl_outline outline;
    bool outlined;
    sl_box_targets targets;
    bool *met; ///< by box
    sl_eye_search *search;
    uint64_t *cells; ///< of the space with boxes
};

// --- placing

/// All that follows from the boxes.
static void drop(sl_context *context, sl_moving *m) {
    sl_eye_search_destroy(context, m->search);
    sl_outline_destroy(context, &m->outline);
    if (m->boxed) sl_boxed_space_destroy(context, m->boxed);
    sl_free(context, m->boxed);
    sl_free(context, m->boxes);
    sl_box_targets_destroy(context, &m->targets);
    sl_free(context, m->met);
    sl_free(context, m->cells);
    *m = (sl_moving){.ground = m->ground,
                     .visibility = m->visibility,
                     .range = m->range,
                     .mirrors = m->mirrors,
                     .depth = m->depth};
}

static sl_status check_boxes(sl_context *context, const sl_moving_box *boxes, size_t count) {
    if (count >= UINT32_MAX) return sl_fail_memory(context);
    for (size_t i = 0; i < count; i++) {
        const sl_box b = boxes[i].box;
        if (!sl_coordinate_usable(b.min.x) || !sl_coordinate_usable(b.min.y) ||
            !sl_coordinate_usable(b.max.x) || !sl_coordinate_usable(b.max.y) || b.min.x > b.max.x ||
            b.min.y > b.max.y)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "box %zu: coordinates must be as a map's, and the lower left corner not "
                           "beyond the upper right one",
                           i + 1);
    }
    return SL_OK;
}

/// Fills `m`, whose boxes are there.
static sl_status place(sl_context *context, sl_moving *m) {
    m->boxed = sl_alloc_array(context, 1, sizeof *m->boxed);
    if (!m->boxed) return SL_NO_MEMORY;
    SL_TRY(sl_boxes_put(context, &m->ground, m->boxes, m->count, m->boxed));
    SL_TRY(sl_box_targets_find(context, &m->ground, &m->boxed->space, m->boxes, m->count,
                               &m->targets));
    SL_TRY(sl_eye_search_create_cut(context, m->boxed, m->visibility, m->ground.space->cell_count,
                                    &m->search));
    m->met = sl_alloc_array(context, m->count, sizeof *m->met);
    m->cells = sl_alloc_array(context, sl_eye_words(&m->boxed->space), sizeof *m->cells);
    if (!m->met || !m->cells) return SL_NO_MEMORY;
    sl_eye_search_limit(m->search, m->range);
    if (m->mirrors) SL_TRY(sl_eye_search_add_mirrors(context, m->search, m->mirrors, m->depth));
    m->search->targets = (sl_eye_targets){m->targets.first, m->targets.items, m->met};
    return SL_OK;
}

sl_status sl_moving_place(sl_context *context, sl_moving *moving, const sl_moving_box *boxes,
                          size_t count) {
    SL_TRY(check_boxes(context, boxes, count));
    sl_moving made = {.ground = moving->ground,
                      .visibility = moving->visibility,
                      .range = moving->range,
                      .mirrors = moving->mirrors,
                      .depth = moving->depth,
                      .count = count};
    made.boxes = sl_alloc_array(context, count, sizeof *made.boxes);
    if (!made.boxes) return SL_NO_MEMORY;
    if (count) memcpy(made.boxes, boxes, count * sizeof *boxes);
    const sl_status status = place(context, &made);
    drop(context, status == SL_OK ? moving : &made);
    if (status == SL_OK) *moving = made;
    return status;
}

sl_status sl_moving_create(sl_context *context, const sl_space *space,
                           const sl_visibility *visibility, sl_moving **out) {
    sl_moving *moving = sl_alloc_array(context, 1, sizeof *moving);
    if (!moving) return SL_NO_MEMORY;
    moving->visibility = visibility;
    sl_status status = sl_box_ground_create(context, space, &moving->ground);
    if (status == SL_OK) status = sl_moving_place(context, moving, NULL, 0);
    if (status == SL_OK)
        *out = moving;
    else
        sl_moving_destroy(context, moving);
    return status;
}

void sl_moving_destroy(sl_context *context, sl_moving *moving) {
    if (!moving) return;
    drop(context, moving);
    sl_box_ground_destroy(context, &moving->ground);
    sl_free(context, moving);
}

// --- asking

const sl_space *sl_moving_space(const sl_moving *moving, const uint32_t **parents) {
    if (parents) *parents = moving->boxed->parents;
    return &moving->boxed->space;
}

sl_status sl_moving_outline(sl_context *context, sl_moving *moving, const sl_outline **out) {
    if (!moving->outlined)
        SL_TRY(sl_outline_make(context, &moving->boxed->space, &moving->outline));
    moving->outlined = true;
    *out = &moving->outline;
    return SL_OK;
}

void sl_moving_limit(sl_moving *moving, double range) {
    moving->range = range;
    sl_eye_search_limit(moving->search, range);
}

static bool holds(sl_box box, sl_point p) {
    return box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y;
}

/// Whether a box that is one point is seen.
static sl_status see_point(sl_context *context, sl_moving *moving, const sl_view *view,
                           sl_point point, bool *seen) {
    const sl_outline *outline;
    *seen = false;
    if (!sl_view_holds(view, point)) return SL_OK;
    if (moving->range > 0 && sl_distance_compare(view->eye, point, moving->range) > 0) return SL_OK;
    SL_TRY(sl_moving_outline(context, moving, &outline));
    return sl_sees(context, outline, view->eye, point, moving->visibility->sight, seen);
}

/// The cells without boxes, of those with them.
static void tell_cells(const sl_moving *moving, uint64_t *cells) {
    const sl_boxed_space *boxed = moving->boxed;
    memset(cells, 0, sl_eye_words(moving->ground.space) * sizeof *cells);
    for (uint32_t c = 0; c < boxed->space.cell_count; c++)
        if (sl_bits_has(moving->cells, c)) sl_bits_add(cells, boxed->parents[c]);
}

sl_status sl_moving_look(sl_context *context, sl_moving *moving, const sl_view *view,
                         uint64_t *cells, bool *seen, sl_eye_account *account) {
    const sl_space *space = &moving->boxed->space;
    if (moving->count) memset(moving->met, 0, moving->count * sizeof *moving->met);
    SL_TRY(sl_eye_exact(context, moving->search, view, moving->cells, account));
    const bool inside = sl_space_locate(space, view->eye) != SL_NO_CELL;
    for (size_t i = 0; i < moving->count; i++) {
        const sl_box box = moving->boxes[i].box;
        seen[i] = moving->met[i] || (inside && holds(box, view->eye));
        if (!seen[i] && inside && box.min.x == box.max.x && box.min.y == box.max.y)
            SL_TRY(see_point(context, moving, view, box.min, &seen[i]));
    }
    tell_cells(moving, cells);
    return SL_OK;
}

sl_status sl_moving_add_mirrors(sl_context *context, sl_moving *moving, const sl_map *map,
                                uint32_t depth) {
    SL_TRY(sl_eye_search_add_mirrors(context, moving->search, map, depth));
    moving->mirrors = map;
    moving->depth = depth;
    return SL_OK;
}

sl_status sl_moving_look_mirrored(sl_context *context, sl_moving *moving, const sl_view *view,
                                  uint64_t *cells, bool *seen, sl_eye_account *account) {
    if (moving->count) memset(moving->met, 0, moving->count * sizeof *moving->met);
    SL_TRY(sl_eye_exact_mirrored(context, moving->search, view, moving->cells, account));
    if (moving->count) memcpy(seen, moving->met, moving->count * sizeof *seen);
    tell_cells(moving, cells);
    return SL_OK;
}
