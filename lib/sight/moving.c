/// Boxes that move: doors that slide, crates, people.
///
/// The cells that the boxes touch are cut along the boxes' sides (space/boxes.h); the rest of the
/// space is copied. A side of a box that blocks sight is then a wall. The visible sets stay those
/// of the space without boxes: a box can only hide, so they remain conservative.
///
/// Each side of a box lies on the boundaries of cells. Its pieces there are targets: the exact
/// search tests, in each cell that it enters, which targets its arc meets. A box is seen when one
/// of its targets is met. No bake is needed when a box moves.
///
///     +-----------+          +---+---+---+
///     |   cell    |          |   |   |   |    four cells are left around the box;
///     |   [box]   |    ->    |   +---+   |    each side of the box is a target of the
///     |           |          |   |   |   |    cell beside it
///     +-----------+          +---+---+---+
#include "sight/moving.h"

#include "effects/filtered.h"
#include "geometry/crossing.h"
#include "sight/eye_search.h"
#include "sight/region.h"
#include "sightline/effects.h"
#include "sightline/map.h"
#include "sightline/support.h"
#include "space/boxes.h"
#include "space/index.h"
#include "space/outline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- targets: the pieces of boxes' sides on the boundaries of cells

typedef struct box_targets {
    uint32_t *first; ///< by cell, and one more: its targets are items[first[c] .. first[c + 1])
    sl_directed_portal *items; ///< as crossed on the way out of the cell; `portal`: the box
} box_targets;

/// A piece of a box's side in a cell.
typedef struct target {
    uint32_t cell;
    sl_directed_portal directed;
} target;

typedef struct gatherer {
    sl_context *context;
    const sl_space *space;
    size_t pieces; ///< so far
    size_t *done;  ///< by cell: the number of the last piece that was tested against it
    SL_ARRAY(target) targets;
    SL_ARRAY(int32_t) stack;
    sli_piece_list free;
    sli_piece_list dark[2]; ///< glass, by whether its left end, on the way out of the cell that it
                            ///< is dark for, is the one at `hi`
    sli_piece_list lit;     ///< what glass leaves free of a piece
} gatherer;

static double along(const sli_piece *side, sl_point p) {
    return side->axis ? p.x : p.y;
}

static double across(const sli_piece *side, sl_point p) {
    return side->axis ? p.y : p.x;
}

static sl_point on(const sli_piece *side, double at) {
    return side->axis ? (sl_point){at, side->at} : (sl_point){side->at, at};
}

/// Adds a directed portal to the dark glass, if it is axial.
static sl_status add_dark(gatherer *g, const sl_directed_portal *d) {
    sli_piece piece = {.axis = d->left.y == d->right.y};
    piece.at = across(&piece, d->left);
    if (across(&piece, d->right) != piece.at) return SL_OK;
    const double left = along(&piece, d->left), right = along(&piece, d->right);
    piece.lo = fmin(left, right);
    piece.hi = fmax(left, right);
    sli_piece_list *dark = &g->dark[left > right];
    SL_TRY(SL_ARRAY_ROOM(g->context, dark, 1));
    dark->items[dark->count++] = piece;
    return SL_OK;
}

/// Lists the dark sides of the ground's glass. In the space with boxes, a box's side may stand in
/// the place of glass.
static sl_status list_dark(gatherer *g, const sl_space *ground) {
    for (uint32_t c = 0; c < ground->cell_count; c++) {
        const sl_cell *cell = &ground->cells[c];
        for (uint32_t k = cell->first_directed; k < cell->first_directed + cell->directed_count;
             k++)
            if (sli_portal_is_blocked(ground, c, k)) SL_TRY(add_dark(g, &ground->directed[k]));
    }
    for (int i = 0; i < 2; i++)
        if (g->dark[i].count)
            qsort(g->dark[i].items, g->dark[i].count, sizeof *g->dark[i].items, sli_compare_pieces);
    return SL_OK;
}

/// Adds a piece of a cell's boundary, but for what dark glass covers. `left_high`: as for `dark`.
static sl_status add_moving_piece(gatherer *g, uint32_t cell, uint32_t box, sli_piece piece,
                                  bool left_high) {
    g->lit.count = 0;
    SL_TRY(sli_piece_add_free(g->context, g->dark[left_high].items, g->dark[left_high].count, piece,
                              &g->lit));
    SL_TRY(SL_ARRAY_ROOM(g->context, &g->targets, g->lit.count));
    for (size_t i = 0; i < g->lit.count; i++) {
        const sli_piece *p = &g->lit.items[i];
        const sl_point low = on(p, p->lo), high = on(p, p->hi);
        g->targets.items[g->targets.count++] =
            (target){cell, {box, SL_NO_CELL, left_high ? high : low, left_high ? low : high}};
    }
    return SL_OK;
}

// --- where cells are boxes

/// Adds a piece where it lies on the boundary of a cell.
static sl_status add_on_boundary(gatherer *g, uint32_t cell, const sli_piece *side, uint32_t box) {
    const sl_point *corners = g->space->vertices + g->space->cells[cell].first_vertex;
    const sl_point min = corners[0], max = corners[2];
    const bool below = side->at == (side->axis ? max.y : max.x);
    const bool above = side->at == (side->axis ? min.y : min.x);
    const double lo = fmax(side->lo, side->axis ? min.x : min.y);
    const double hi = fmin(side->hi, side->axis ? max.x : max.y);
    if (!(below || above) || lo >= hi) return SL_OK;
    // Going up in the line's coordinate, the left hand is at high y (axis 0) or at low x (axis 1).
    return add_moving_piece(g, cell, box,
                            (sli_piece){.at = side->at, .lo = lo, .hi = hi, .axis = side->axis},
                            below == !side->axis);
}

/// Adds a piece to all cells that it lies on the boundary of.
static sl_status add_down_tree(gatherer *g, const sli_piece *side, uint32_t box) {
    g->stack.count = 0;
    SL_TRY(SL_ARRAY_ROOM(g->context, &g->stack, 1));
    g->stack.items[g->stack.count++] = g->space->root;
    while (g->stack.count) {
        const int32_t child = g->stack.items[--g->stack.count];
        if (child < 0) {
            SL_TRY(add_on_boundary(g, (uint32_t)~child, side, box));
            continue;
        }
        const sl_node *node = &g->space->nodes[child];
        const double lo = node->axis == side->axis ? side->at : side->lo;
        const double hi = node->axis == side->axis ? side->at : side->hi;
        SL_TRY(SL_ARRAY_ROOM(g->context, &g->stack, 2));
        if (lo <= node->position) g->stack.items[g->stack.count++] = node->below;
        if (hi >= node->position) g->stack.items[g->stack.count++] = node->above;
    }
    return SL_OK;
}

// --- where cells are convex

/// Adds the part of a piece that lies on a side of a cell, which has the cell to its left.
static sl_status add_along(gatherer *g, uint32_t number, const sli_piece *piece, uint32_t box,
                           sl_point p, sl_point q) {
    const double from = along(piece, p), to = along(piece, q);
    const double lo = fmax(piece->lo, fmin(from, to)), hi = fmin(piece->hi, fmax(from, to));
    if (across(piece, p) != piece->at || across(piece, q) != piece->at || lo >= hi) return SL_OK;
    return add_moving_piece(g, number, box,
                            (sli_piece){.at = piece->at, .lo = lo, .hi = hi, .axis = piece->axis},
                            from < to);
}

/// Adds a piece to all cells that it lies on the boundary of.
static sl_status add_to_cells(gatherer *g, const sli_piece *piece, uint32_t box) {
    const sl_space *s = g->space;
    const sl_box around = {on(piece, piece->lo), on(piece, piece->hi)};
    sli_cell_grid_range r = sli_cell_grid_range_of(s, around);
    g->pieces++;
    for (uint32_t at; sli_cell_grid_next(&s->grid, &r, &at);) {
        const sl_point *v = s->vertices + s->cells[at].first_vertex;
        const uint32_t count = s->cells[at].vertex_count;
        if (g->done[at] == g->pieces) continue;
        g->done[at] = g->pieces;
        for (uint32_t i = 0; i < count; i++)
            SL_TRY(add_along(g, at, piece, box, v[i], v[i + 1 == count ? 0 : i + 1]));
    }
    return SL_OK;
}

// --- gathering

static int compare_targets(const void *left, const void *right) {
    const target *a = left, *b = right;
    return (a->cell > b->cell) - (a->cell < b->cell);
}

static sl_status write_targets(gatherer *g, box_targets *out) {
    const uint32_t cells = g->space->cell_count;
    out->first = sl_alloc_array(g->context, (size_t)cells + 1, sizeof *out->first);
    out->items = sl_alloc_array(g->context, g->targets.count, sizeof *out->items);
    if (!out->first || !out->items) return SL_NO_MEMORY;
    if (g->targets.count > UINT32_MAX) return sl_fail_memory(g->context);
    if (g->targets.count)
        qsort(g->targets.items, g->targets.count, sizeof *g->targets.items, compare_targets);
    for (size_t i = 0; i < g->targets.count; i++) {
        out->items[i] = g->targets.items[i].directed;
        out->first[g->targets.items[i].cell + 1]++;
    }
    for (uint32_t c = 0; c < cells; c++) out->first[c + 1] += out->first[c];
    return SL_OK;
}

static sl_status gather(gatherer *g, const sli_box_ground *ground, const sl_moving_box *boxes,
                        size_t count) {
    g->done = sl_alloc_array(g->context, g->space->cell_count, sizeof *g->done);
    if (!g->done) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        sli_piece sides[4];
        const unsigned n = sli_box_sides(boxes[i].box, sides);
        g->free.count = 0;
        for (unsigned k = 0; k < n; k++)
            SL_TRY(sli_piece_add_free(g->context, ground->walls, ground->wall_count, sides[k],
                                      &g->free));
        for (size_t k = 0; k < g->free.count; k++) {
            const sli_piece *piece = &g->free.items[k];
            SL_TRY(g->space->neighbour ? add_to_cells(g, piece, (uint32_t)i)
                                       : add_down_tree(g, piece, (uint32_t)i));
        }
    }
    return SL_OK;
}

/// The pieces that no axial wall of the ground covers, in a space with the boxes in it. With
/// `one_way`, glass covers what is on its dark side. `out` is zeroed, and to be destroyed whatever
/// comes.
static sl_status find_targets(sl_context *context, const sli_box_ground *ground,
                              const sl_space *space, bool one_way, const sl_moving_box *boxes,
                              size_t count, box_targets *out) {
    gatherer g = {.context = context, .space = space};
    sl_status status = one_way ? list_dark(&g, ground->space) : SL_OK;
    if (status == SL_OK) status = gather(&g, ground, boxes, count);
    if (status == SL_OK) status = write_targets(&g, out);
    sl_free(context, g.done);
    sl_free(context, g.targets.items);
    sl_free(context, g.stack.items);
    sl_free(context, g.free.items);
    for (int i = 0; i < 2; i++) sl_free(context, g.dark[i].items);
    sl_free(context, g.lit.items);
    return status;
}

static void destroy_targets(sl_context *context, box_targets *targets) {
    sl_free(context, targets->first);
    sl_free(context, targets->items);
    *targets = (box_targets){0};
}

/// What stays when boxes are placed again.
typedef struct moving_settings {
    sli_box_ground ground;
    const sl_visibility *visibility;
    const bool *shut; ///< by door, for the visible sets
    double range;
    const sl_map *mirrors; ///< the map that has them, NULL for none
    uint32_t depth;        ///< of reflections
    bool one_way;          ///< glass counts
    bool in_line;          ///< sli_eye_search.in_line
} moving_settings;

struct sli_moving {
    moving_settings set;
    sl_moving_box *boxes;
    size_t count;
    sli_boxed_space *boxed;
    sl_outline outline;
    bool outlined;
    box_targets targets;
    bool *met; ///< by box
    sli_eye_search *search;
    uint64_t *cells; ///< of the space with boxes
};

// --- placing

/// Frees all that was made for the boxes.
static void drop(sl_context *context, sli_moving *m) {
    sli_eye_search_destroy(context, m->search);
    sli_outline_destroy(context, &m->outline);
    if (m->boxed) sli_boxed_space_destroy(context, m->boxed);
    sl_free(context, m->boxed);
    sl_free(context, m->boxes);
    destroy_targets(context, &m->targets);
    sl_free(context, m->met);
    sl_free(context, m->cells);
    *m = (sli_moving){.set = m->set};
}

/// Makes glass of the space with boxes one-way. Boxes are put in first: a box cuts both sides.
static sl_status darken(sl_context *context, sl_space *space) {
    const sli_filtered_space filtered = {.one_way = true, .dark_walls = true};
    sl_space dark;
    SL_TRY(sli_filtered_space_make(context, space, &filtered, NULL, &dark));
    sl_space_destroy(context, space);
    *space = dark;
    return SL_OK;
}

/// Makes all that follows from the boxes of `m`.
static sl_status place(sl_context *context, sli_moving *m) {
    m->boxed = sl_alloc_array(context, 1, sizeof *m->boxed);
    if (!m->boxed) return SL_NO_MEMORY;
    SL_TRY(sli_boxes_put(context, &m->set.ground, m->boxes, m->count, m->boxed));
    if (m->set.one_way) SL_TRY(darken(context, &m->boxed->space));
    SL_TRY(find_targets(context, &m->set.ground, &m->boxed->space, m->set.one_way, m->boxes,
                        m->count, &m->targets));
    SL_TRY(sli_eye_search_create_cut(context, m->boxed, m->set.visibility,
                                     m->set.ground.space->cell_count, &m->search));
    m->met = sl_alloc_array(context, m->count, sizeof *m->met);
    m->cells = sl_alloc_array(context, sl_eye_words(&m->boxed->space), sizeof *m->cells);
    if (!m->met || !m->cells) return SL_NO_MEMORY;
    sli_eye_search_set_range(m->search, m->set.range);
    m->search->shut = m->set.shut;
    m->search->in_line = m->set.in_line;
    if (m->set.mirrors)
        SL_TRY(sli_eye_search_add_mirrors(context, m->search, m->set.mirrors, m->set.depth));
    m->search->targets = (sli_eye_targets){m->targets.first, m->targets.items, m->met};
    return SL_OK;
}

sl_status sli_moving_set_boxes(sl_context *context, sli_moving *moving, const sl_moving_box *boxes,
                               size_t count) {
    SL_TRY(sli_boxes_check(context, boxes, count));
    sli_moving made = {.set = moving->set, .count = count};
    made.boxes = sl_alloc_array(context, count, sizeof *made.boxes);
    if (!made.boxes) return SL_NO_MEMORY;
    if (count) memcpy(made.boxes, boxes, count * sizeof *boxes);
    const sl_status status = place(context, &made);
    drop(context, status == SL_OK ? moving : &made);
    if (status == SL_OK) *moving = made;
    return status;
}

sl_status sli_moving_create(sl_context *context, const sl_space *space,
                            const sl_visibility *visibility, sli_moving **out) {
    sli_moving *moving = sl_alloc_array(context, 1, sizeof *moving);
    if (!moving) return SL_NO_MEMORY;
    moving->set.visibility = visibility;
    sl_status status = sli_box_ground_create(context, space, &moving->set.ground);
    if (status == SL_OK) status = sli_moving_set_boxes(context, moving, NULL, 0);
    if (status == SL_OK)
        *out = moving;
    else
        sli_moving_destroy(context, moving);
    return status;
}

void sli_moving_destroy(sl_context *context, sli_moving *moving) {
    if (!moving) return;
    drop(context, moving);
    sli_box_ground_destroy(context, &moving->set.ground);
    sl_free(context, moving);
}

// --- asking

const sl_space *sli_moving_space(const sli_moving *moving, const uint32_t **parents) {
    if (parents) *parents = moving->boxed->parents;
    return &moving->boxed->space;
}

sl_status sli_moving_outline(sl_context *context, sli_moving *moving, const sl_outline **out) {
    if (!moving->outlined)
        SL_TRY(sli_outline_make(context, &moving->boxed->space, &moving->outline));
    moving->outlined = true;
    *out = &moving->outline;
    return SL_OK;
}

void sli_moving_set_range(sli_moving *moving, double range) {
    moving->set.range = range;
    sli_eye_search_set_range(moving->search, range);
}

void sli_moving_set_shut(sli_moving *moving, const bool *shut) {
    moving->set.shut = moving->search->shut = shut;
}

void sli_moving_set_in_line(sli_moving *moving) {
    moving->set.in_line = moving->search->in_line = true;
}

/// Whether a box that is one point is seen.
static sl_status see_point(sl_context *context, sli_moving *moving, const sl_view *view,
                           sl_point point, bool *seen) {
    const sl_outline *outline;
    *seen = false;
    if (!sli_view_holds(view, point)) return SL_OK;
    const sl_sight sight = moving->set.visibility->sight;
    const double range = moving->set.range;
    if (range > 0 && sli_distance_compare(view->eye, point, range) >= (sight == SL_CLOSED ? 1 : 0))
        return SL_OK;
    SL_TRY(sli_moving_outline(context, moving, &outline));
    return sli_sees(context, outline, view->eye, point, sight, seen);
}

/// Maps the cells that are seen to the cells of the space without boxes.
static void write_cells(const sli_moving *moving, uint64_t *cells) {
    const sli_boxed_space *boxed = moving->boxed;
    memset(cells, 0, sl_eye_words(moving->set.ground.space) * sizeof *cells);
    for (uint32_t c = 0; c < boxed->space.cell_count; c++)
        if (sl_bits_has(moving->cells, c)) sl_bits_add(cells, boxed->parents[c]);
}

sl_status sli_moving_look(sl_context *context, sli_moving *moving, const sl_view *view,
                          uint64_t *cells, bool *seen, sl_eye_account *account) {
    const sl_space *space = &moving->boxed->space;
    if (moving->count) memset(moving->met, 0, moving->count * sizeof *moving->met);
    SL_TRY(sli_eye_exact(context, moving->search, view, moving->cells, account));
    const bool inside = sli_eye_cell(space, view->eye) != SL_NO_CELL;
    for (size_t i = 0; i < moving->count; i++) {
        const sl_box box = moving->boxes[i].box;
        seen[i] = moving->met[i] || (inside && sli_box_holds(&box, view->eye));
        if (!seen[i] && inside && box.min.x == box.max.x && box.min.y == box.max.y)
            SL_TRY(see_point(context, moving, view, box.min, &seen[i]));
    }
    write_cells(moving, cells);
    return SL_OK;
}

sl_status sli_moving_add_mirrors(sl_context *context, sli_moving *moving, const sl_map *map,
                                 uint32_t depth) {
    SL_TRY(sli_eye_search_add_mirrors(context, moving->search, map, depth));
    moving->set.mirrors = map;
    moving->set.depth = depth;
    return SL_OK;
}

sl_status sli_moving_add_glass(sl_context *context, sli_moving *moving) {
    sl_moving_box *boxes = moving->boxes;
    const bool was = moving->set.one_way;
    moving->boxes = NULL;
    moving->set.one_way = true;
    const sl_status status = sli_moving_set_boxes(context, moving, boxes, moving->count);
    if (status == SL_OK) {
        sl_free(context, boxes);
    } else {
        moving->boxes = boxes;
        moving->set.one_way = was;
    }
    return status;
}

sl_status sli_moving_look_mirrored(sl_context *context, sli_moving *moving, const sl_view *view,
                                   uint64_t *cells, bool *seen, sl_eye_account *account) {
    if (moving->count) memset(moving->met, 0, moving->count * sizeof *moving->met);
    SL_TRY(sli_eye_exact_mirrored(context, moving->search, view, moving->cells, account));
    if (moving->count) memcpy(seen, moving->met, moving->count * sizeof *seen);
    write_cells(moving, cells);
    return SL_OK;
}
