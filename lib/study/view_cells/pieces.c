/// Rooms, and pieces of rooms with their exact directed visible sets (pieces.h; Laine 2005).
///
/// Whole rooms come first: in each quadrant a pass takes them in an order in which those behind
/// come first. A room's refine set is what the rooms right behind it are and see. Rooms that depend
/// on each other in a cycle share their refine sets.
///
/// A piece that is cut has what it sees as its refine set: its halves can see nothing else. So the
/// search from a half costs about what the whole saw, not what the map holds.
#include "study/view_cells/pieces.h"

#include "cell_to_cell/search/sectors.h"
#include "sightline/space.h"
#include "sightline/support.h"
#include "space/outline.h"

#include <stdlib.h>

// --- rooms

/// Places nearer to a corner than this share of the map's size snap to it.
#define SNAP 1e-12

static void destroy_rooms(sl_context *context, sli_view_rooms *rooms) {
    sl_free(context, rooms->corners);
    sl_free(context, rooms->first_corner);
    sl_free(context, rooms->sides);
    sl_free(context, rooms->first_side);
    sl_free(context, rooms->object);
    for (int axis = 0; axis < 2; axis++) sl_free(context, rooms->places[axis]);
    *rooms = (sli_view_rooms){0};
}

static sl_status make_arrays(sl_context *context, size_t count, size_t corners, size_t sides,
                             sli_view_rooms *rooms) {
    rooms->corners = sl_alloc_array(context, corners, sizeof *rooms->corners);
    rooms->first_corner = sl_alloc_array(context, count + 1, sizeof *rooms->first_corner);
    rooms->sides = sl_alloc_array(context, sides, sizeof *rooms->sides);
    rooms->first_side = sl_alloc_array(context, count + 1, sizeof *rooms->first_side);
    rooms->object = sl_alloc_array(context, count, sizeof *rooms->object);
    return rooms->corners && rooms->first_corner && rooms->sides && rooms->first_side &&
                   rooms->object
               ? SL_OK
               : SL_NO_MEMORY;
}

// Rooms that are cells.

static void add_cell(const sl_space *space, const uint32_t *number, uint32_t cell,
                     sli_view_rooms *rooms) {
    const sl_cell *c = &space->cells[cell];
    const uint32_t room = rooms->count++;
    uint32_t corner = rooms->first_corner[room], side = rooms->first_side[room];
    for (uint32_t i = 0; i < c->vertex_count; i++)
        rooms->corners[corner++] = space->vertices[c->first_vertex + i];
    for (uint32_t e = c->first_directed; e < c->first_directed + c->directed_count; e++) {
        const sl_directed_portal *portal = &space->directed[e];
        if (number[portal->cell] == SLI_NO_ROOM) continue;
        rooms->sides[side++] =
            (sli_room_side){portal->left, portal->right, number[portal->cell], portal->cell};
    }
    rooms->object[room] = cell;
    rooms->first_corner[room + 1] = corner;
    rooms->first_side[room + 1] = side;
}

static sl_status take_cells(sl_context *context, const sl_space *space, sli_view_rooms *rooms) {
    uint32_t *number = sl_alloc_array(context, space->cell_count, sizeof *number);
    if (!number) return SL_NO_MEMORY;
    uint32_t next = 0;
    for (uint32_t i = 0; i < space->cell_count; i++)
        number[i] = space->cells[i].inside ? next++ : SLI_NO_ROOM;
    const sl_status status =
        make_arrays(context, next, space->vertex_count, space->directed_count, rooms);
    for (uint32_t i = 0; i < space->cell_count && status == SL_OK; i++)
        if (number[i] != SLI_NO_ROOM) add_cell(space, number, i, rooms);
    rooms->object_count = space->cell_count;
    sl_free(context, number);
    return status;
}

// Rooms of the outline.

/// Numbers the rooms of the outline that are inside. Returns how many.
static uint32_t number_rooms(const sl_outline *outline, uint32_t *number) {
    const sl_space *space = outline->space;
    for (uint32_t i = 0; i < outline->room_count; i++) number[i] = SLI_NO_ROOM;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        if (!space->cells[cell].inside) continue;
        for (uint32_t k = outline->first_part[cell]; k < outline->first_part[cell + 1]; k++)
            number[outline->parts[k]] = 0;
    }
    uint32_t next = 0;
    for (uint32_t i = 0; i < outline->room_count; i++)
        if (number[i] != SLI_NO_ROOM) number[i] = next++;
    return next;
}

static void add_room(const sl_outline *outline, const uint32_t *room_of, const uint32_t *number,
                     uint32_t from, sli_view_rooms *rooms) {
    const uint32_t room = rooms->count++;
    uint32_t corner = rooms->first_corner[room], at = rooms->first_side[room];
    for (uint32_t i = outline->first[from]; i < outline->first[from + 1]; i++) {
        const sl_side *side = &outline->sides[i];
        sli_room_side made = {outline->sides[side->next].start, side->start, SLI_NO_ROOM,
                              SLI_NO_OBJECT};
        rooms->corners[corner++] = side->start;
        if (sl_side_is_portal(side))
            made.room = number[room_of[side->neighbour]];
        else if (side->neighbour < SL_SIDE_BORDER)
            made.object = side->neighbour - SL_SIDE_WALL;
        if (made.room != SLI_NO_ROOM || made.object != SLI_NO_OBJECT) rooms->sides[at++] = made;
    }
    rooms->object[room] = SLI_NO_OBJECT;
    rooms->first_corner[room + 1] = corner;
    rooms->first_side[room + 1] = at;
}

static sl_status take_rooms(sl_context *context, const sl_outline *outline, sli_view_rooms *rooms) {
    uint32_t *room_of = sl_alloc_array(context, outline->side_count, sizeof *room_of);
    uint32_t *number = sl_alloc_array(context, outline->room_count, sizeof *number);
    sl_status status = room_of && number ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = make_arrays(context, number_rooms(outline, number), outline->side_count,
                             outline->side_count, rooms);
    if (status == SL_OK) {
        for (uint32_t i = 0; i < outline->room_count; i++)
            for (uint32_t k = outline->first[i]; k < outline->first[i + 1]; k++) room_of[k] = i;
        for (uint32_t i = 0; i < outline->room_count; i++)
            if (number[i] != SLI_NO_ROOM) add_room(outline, room_of, number, i, rooms);
    }
    rooms->object_count = outline->space->wall_count;
    sl_free(context, room_of);
    sl_free(context, number);
    return status;
}

// Places of corners, for snapping.

static sl_status find_places(sl_context *context, sli_view_rooms *rooms) {
    const uint32_t count = rooms->first_corner[rooms->count];
    for (int axis = 0; axis < 2; axis++) {
        double *places = sl_alloc_array(context, count, sizeof *places);
        if (!places) return SL_NO_MEMORY;
        rooms->places[axis] = places;
        for (uint32_t i = 0; i < count; i++)
            places[i] = axis ? rooms->corners[i].y : rooms->corners[i].x;
        if (count) qsort(places, count, sizeof *places, sl_compare_numbers);
        uint32_t kept = 0;
        for (uint32_t i = 0; i < count; i++)
            if (!kept || places[i] != places[kept - 1]) places[kept++] = places[i];
        rooms->place_counts[axis] = kept;
    }
    return SL_OK;
}

double sli_view_rooms_snap(const sli_view_rooms *rooms, int axis, double place) {
    const double *places = rooms->places[axis];
    const sl_box *b = &rooms->bounds;
    const double size = axis ? b->max.y - b->min.y : b->max.x - b->min.x;
    uint32_t low = 0, high = rooms->place_counts[axis];
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (places[middle] < place)
            low = middle + 1;
        else
            high = middle;
    }
    if (low < rooms->place_counts[axis] && places[low] - place <= SNAP * size) return places[low];
    if (low && place - places[low - 1] <= SNAP * size) return places[low - 1];
    return place;
}

static sl_status make_rooms(sl_context *context, const sl_space *space, sl_view_objects objects,
                            sli_view_rooms *out) {
    sli_view_rooms made = {.bounds = space->bounds};
    sl_status status;
    if (objects == SL_VIEW_CELLS) {
        status = take_cells(context, space, &made);
    } else {
        sl_outline outline = {0};
        status = sli_outline_make(context, space, &outline);
        if (status == SL_OK) status = take_rooms(context, &outline, &made);
        sli_outline_destroy(context, &outline);
    }
    if (status == SL_OK) status = find_places(context, &made);
    if (status == SL_OK)
        *out = made;
    else
        destroy_rooms(context, &made);
    return status;
}

// --- pieces

static void piece_destroy(sl_context *context, sli_view_piece *piece) {
    sl_free(context, piece->corners.items);
    for (int q = 0; q < SLI_VIEW_QUADRANTS; q++) {
        sl_free(context, piece->directed[q].rooms.items);
        sl_free(context, piece->directed[q].objects.items);
    }
    *piece = (sli_view_piece){0};
}

void sli_view_pieces_destroy(sli_view_pieces *pieces) {
    for (size_t i = 0; i < pieces->items.count; i++)
        piece_destroy(pieces->context, &pieces->items.items[i]);
    sl_free(pieces->context, pieces->items.items);
    sli_view_searchers_destroy(pieces->context, pieces);
    destroy_rooms(pieces->context, &pieces->rooms);
    pthread_mutex_destroy(&pieces->lock);
}

static sl_status add_corner(sl_context *context, sli_view_piece *piece, sl_point at) {
    SL_TRY(SL_ARRAY_ROOM(context, &piece->corners, 1));
    piece->corners.items[piece->corners.count++] = at;
    const sli_view_extent own = {{at.x, at.y}, {at.x, at.y}};
    sli_view_extent_join(&piece->box, &own);
    return SL_OK;
}

// --- whole rooms

static sl_status take_room(sli_view_pieces *pieces, uint32_t room) {
    const sli_view_rooms *rooms = &pieces->rooms;
    SL_TRY(SL_ARRAY_ROOM(pieces->context, &pieces->items, 1));
    sli_view_piece *piece = &pieces->items.items[pieces->items.count++];
    *piece = (sli_view_piece){.room = room, .box = sli_view_no_extent()};
    for (uint32_t i = rooms->first_corner[room]; i < rooms->first_corner[room + 1]; i++)
        SL_TRY(add_corner(pieces->context, piece, rooms->corners[i]));
    return SL_OK;
}

/// Lists, for each room, those behind the sides by which a quadrant's sightlines leave it.
static uint32_t fill_graph(const sli_view_rooms *rooms, int quadrant, uint32_t *first,
                           uint32_t *to) {
    uint32_t count = 0;
    for (uint32_t room = 0; room < rooms->count; room++) {
        for (uint32_t i = rooms->first_side[room]; i < rooms->first_side[room + 1]; i++) {
            const sli_room_side *side = &rooms->sides[i];
            sli_direction_sector cone = sli_view_quadrant(quadrant);
            const sl_directed_portal portal = {.left = side->left, .right = side->right};
            if (side->room != SLI_NO_ROOM && sli_direction_sector_cut(&cone, &portal))
                to[count++] = side->room;
        }
        first[room + 1] = count;
    }
    return count;
}

/// The candidates of a component: its own rooms, those behind them, and what these see.
static void allow_component(const sli_view_pieces *pieces, sli_view_searcher *searcher,
                            int quadrant, const sli_dependence *graph, const sli_order *order,
                            uint32_t component) {
    sli_view_search_begin(searcher);
    for (uint32_t i = order->starts[component]; i < order->starts[component + 1]; i++) {
        const uint32_t room = order->nodes[i];
        if (order->starts[component + 1] - order->starts[component] > 1)
            sli_view_search_allow(searcher, room);
        for (uint32_t k = graph->first[room]; k < graph->first[room + 1]; k++) {
            const uint32_t behind = graph->to[k];
            sli_view_search_allow(searcher, behind);
            if (order->component[behind] == component) continue;
            const sli_view_numbers *seen = &pieces->items.items[behind].directed[quadrant].rooms;
            for (size_t j = 0; j < seen->count; j++)
                sli_view_search_allow(searcher, seen->items[j]);
        }
    }
}

/// One pass: room by room, those behind first (Laine 2005, algorithm 1).
static sl_status pass(sl_context *context, sli_view_pieces *pieces, sli_view_searcher *searcher,
                      int quadrant, const sli_dependence *graph) {
    sli_order order;
    SL_TRY(sli_order_create(context, graph, &order));
    sl_status status = SL_OK;
    for (uint32_t k = 0; k < order.component_count && status == SL_OK; k++) {
        allow_component(pieces, searcher, quadrant, graph, &order, k);
        for (uint32_t i = order.starts[k]; i < order.starts[k + 1] && status == SL_OK; i++) {
            sli_view_piece *piece = &pieces->items.items[order.nodes[i]];
            status = sli_view_search(searcher, piece, quadrant, NULL, &piece->directed[quadrant]);
        }
    }
    sli_order_destroy(context, &order);
    return status;
}

static sl_status begin_piece_worker(sl_context *context, void *job, void **state) {
    sli_view_searcher *searcher;
    SL_TRY(sli_view_searcher_take(context, job, &searcher));
    *state = searcher;
    return SL_OK;
}

static void end_piece_worker(sl_context *context, void *job, void *state) {
    (void)context;
    sli_view_pieces *pieces = job;
    const sl_view_work work = sli_view_searcher_work(state);
    sli_view_searcher_give(pieces, state);
    pthread_mutex_lock(&pieces->lock);
    sli_view_work_add(&pieces->work, &work);
    pthread_mutex_unlock(&pieces->lock);
}

static sl_status pass_quadrant(sl_context *context, void *job, void *state, size_t quadrant) {
    sli_view_pieces *pieces = job;
    const sli_view_rooms *rooms = &pieces->rooms;
    uint32_t *first = sl_alloc_array(context, (size_t)rooms->count + 1, sizeof *first);
    uint32_t *to = sl_alloc_array(context, rooms->first_side[rooms->count], sizeof *to);
    sl_status status = first && to ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        fill_graph(rooms, (int)quadrant, first, to);
        status =
            pass(context, pieces, state, (int)quadrant, &(sli_dependence){rooms->count, first, to});
    }
    sl_free(context, first);
    sl_free(context, to);
    return status;
}

sl_status sli_view_pieces_create(sl_context *context, const sl_view_scene *scene, sl_sight sight,
                                 unsigned threads, sli_view_pieces *pieces) {
    *pieces = (sli_view_pieces){.context = context, .sight = sight};
    pthread_mutex_init(&pieces->lock, NULL);
    SL_TRY(make_rooms(context, scene->space, scene->objects, &pieces->rooms));
    for (uint32_t i = 0; i < pieces->rooms.count; i++) SL_TRY(take_room(pieces, i));
    pieces->work.rooms = pieces->rooms.count;
    const sl_work work = {.job = pieces,
                          .begin = begin_piece_worker,
                          .unit = pass_quadrant,
                          .end = end_piece_worker,
                          .stage = "look",
                          .units = "quadrants"};
    return sl_work_run(context, &work, SLI_VIEW_QUADRANTS, threads);
}

// --- cutting

static sl_status cut_polygon(sl_context *context, const sli_view_piece *piece, int axis,
                             double position, sli_view_piece *below, sli_view_piece *above) {
    const size_t count = piece->corners.count;
    for (size_t i = 0; i < count; i++) {
        const sl_point p = piece->corners.items[i];
        const sl_point q = piece->corners.items[i + 1 < count ? i + 1 : 0];
        const double at_p = (axis ? p.y : p.x) - position, at_q = (axis ? q.y : q.x) - position;
        if (at_p <= 0) SL_TRY(add_corner(context, below, p));
        if (at_p >= 0) SL_TRY(add_corner(context, above, p));
        if (!((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))) continue;
        // The crossing of an axial side is exact.
        const double t = at_p / (at_p - at_q);
        const sl_point c = axis ? (sl_point){p.x + t * (q.x - p.x), position}
                                : (sl_point){position, p.y + t * (q.y - p.y)};
        SL_TRY(add_corner(context, below, c));
        SL_TRY(add_corner(context, above, c));
    }
    return SL_OK;
}

static sl_status search_all(sli_view_searcher *searcher, const sli_view_piece *whole,
                            sli_view_piece *half) {
    for (int q = 0; q < SLI_VIEW_QUADRANTS; q++) {
        const sli_view_directed *known = &whole->directed[q];
        sli_view_search_begin(searcher);
        for (size_t i = 0; i < known->rooms.count; i++)
            sli_view_search_allow(searcher, known->rooms.items[i]);
        SL_TRY(sli_view_search(searcher, half, q, known, &half->directed[q]));
    }
    return SL_OK;
}

sl_status sli_view_pieces_halve(sl_context *context, const sli_view_pieces *pieces,
                                sli_view_searcher *searcher, uint32_t number, int axis,
                                double position, bool asks_below, bool asks_above,
                                sli_view_halves *out) {
    const sli_view_piece *whole = &pieces->items.items[number];
    out->below = out->above = (sli_view_piece){.room = whole->room, .box = sli_view_no_extent()};
    SL_TRY(cut_polygon(context, whole, axis, position, &out->below, &out->above));
    if (asks_below) SL_TRY(search_all(searcher, whole, &out->below));
    if (asks_above) SL_TRY(search_all(searcher, whole, &out->above));
    out->work = sli_view_searcher_work(searcher);
    return SL_OK;
}

void sli_view_halves_destroy(sl_context *context, sli_view_halves *halves) {
    piece_destroy(context, &halves->below);
    piece_destroy(context, &halves->above);
}

sl_status sli_view_pieces_cut(sli_view_pieces *pieces, uint32_t number, sli_view_halves *halves,
                              uint32_t *above) {
    sl_context *context = pieces->context;
    SL_TRY(SL_ARRAY_ROOM(context, &pieces->items, 1));
    sli_view_piece *whole = &pieces->items.items[number];
    piece_destroy(context, whole);
    *whole = halves->below;
    *above = (uint32_t)pieces->items.count;
    pieces->items.items[pieces->items.count++] = halves->above;
    pieces->work.cuts++;
    sli_view_work_add(&pieces->work, &halves->work);
    *halves = (sli_view_halves){0};
    return SL_OK;
}

// --- sets

void sli_view_piece_add_to(const sli_view_pieces *pieces, const sli_view_piece *piece,
                           uint64_t *row) {
    const sli_view_rooms *rooms = &pieces->rooms;
    const uint32_t room = piece->room;
    if (rooms->object[room] != SLI_NO_OBJECT) sl_bits_add(row, rooms->object[room]);
    for (uint32_t i = rooms->first_side[room]; i < rooms->first_side[room + 1]; i++)
        if (rooms->sides[i].room == SLI_NO_ROOM) sl_bits_add(row, rooms->sides[i].object);
    for (int q = 0; q < SLI_VIEW_QUADRANTS; q++)
        for (size_t i = 0; i < piece->directed[q].objects.count; i++)
            sl_bits_add(row, piece->directed[q].objects.items[i].object);
}
