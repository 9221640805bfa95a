#include "view_cells/pieces.h"

#include "base/threads.h"
#include "cell_to_cell/sectors.h"
#include "sightline/support.h"

static void piece_destroy(sl_context *context, sl_view_piece *piece) {
    sl_free(context, piece->corners.items);
    for (int q = 0; q < SL_VIEW_QUADRANTS; q++) {
        sl_free(context, piece->directed[q].rooms.items);
        sl_free(context, piece->directed[q].objects.items);
    }
    *piece = (sl_view_piece){0};
}

void sl_view_pieces_destroy(sl_view_pieces *pieces) {
    for (size_t i = 0; i < pieces->items.count; i++)
        piece_destroy(pieces->context, &pieces->items.items[i]);
    sl_free(pieces->context, pieces->items.items);
    sl_view_lookers_destroy(pieces->context, pieces);
    sl_view_rooms_destroy(pieces->context, &pieces->rooms);
    pthread_mutex_destroy(&pieces->lock);
}

static sl_status add_corner(sl_context *context, sl_view_piece *piece, sl_point at) {
    SL_TRY(SL_ARRAY_ROOM(context, &piece->corners, 1));
    piece->corners.items[piece->corners.count++] = at;
    const sl_view_extent own = {{at.x, at.y}, {at.x, at.y}};
    sl_view_extent_join(&piece->box, &own);
    return SL_OK;
}

// --- whole rooms

static sl_status take_room(sl_view_pieces *pieces, uint32_t room) {
    const sl_view_rooms *rooms = &pieces->rooms;
    SL_TRY(SL_ARRAY_ROOM(pieces->context, &pieces->items, 1));
    sl_view_piece *piece = &pieces->items.items[pieces->items.count++];
    *piece = (sl_view_piece){.room = room, .box = sl_view_no_extent()};
    for (uint32_t i = rooms->first_corner[room]; i < rooms->first_corner[room + 1]; i++)
        SL_TRY(add_corner(pieces->context, piece, rooms->corners[i]));
    return SL_OK;
}

/// Which rooms are behind the sides by which a quadrant's sightlines leave each.
static uint32_t fill_graph(const sl_view_rooms *rooms, int quadrant, uint32_t *first,
                           uint32_t *to) {
    uint32_t count = 0;
    for (uint32_t room = 0; room < rooms->count; room++) {
        for (uint32_t i = rooms->first_side[room]; i < rooms->first_side[room + 1]; i++) {
            const sl_room_side *side = &rooms->sides[i];
            sl_direction_sector cone = sl_view_quadrant(quadrant);
            const sl_directed_portal directed = {.left = side->left, .right = side->right};
            if (side->room != SL_NO_ROOM && sl_direction_sector_cut(&cone, &directed))
                to[count++] = side->room;
        }
        first[room + 1] = count;
    }
    return count;
}

/// A component's candidates: its own rooms, those behind them, and what these see.
static void allow_component(const sl_view_pieces *pieces, sl_view_looker *looker, int quadrant,
                            const sl_dependence *graph, const sl_order *order, uint32_t component) {
    sl_view_look_begin(looker);
    for (uint32_t i = order->starts[component]; i < order->starts[component + 1]; i++) {
        const uint32_t room = order->nodes[i];
        if (order->starts[component + 1] - order->starts[component] > 1)
            sl_view_look_allow(looker, room);
        for (uint32_t k = graph->first[room]; k < graph->first[room + 1]; k++) {
            const uint32_t behind = graph->to[k];
            sl_view_look_allow(looker, behind);
            if (order->component[behind] == component) continue;
            const sl_view_numbers *seen = &pieces->items.items[behind].directed[quadrant].rooms;
            for (size_t j = 0; j < seen->count; j++) sl_view_look_allow(looker, seen->items[j]);
        }
    }
}

/// Room by room, those behind first (Laine 2005, algorithm 1).
static sl_status pass(sl_context *context, sl_view_pieces *pieces, sl_view_looker *looker,
                      int quadrant, const sl_dependence *graph) {
    sl_order order;
    SL_TRY(sl_order_create(context, graph, &order));
    sl_status status = SL_OK;
    for (uint32_t k = 0; k < order.component_count && status == SL_OK; k++) {
        allow_component(pieces, looker, quadrant, graph, &order, k);
        for (uint32_t i = order.starts[k]; i < order.starts[k + 1] && status == SL_OK; i++) {
            sl_view_piece *piece = &pieces->items.items[order.nodes[i]];
            status = sl_view_look(looker, piece, quadrant, NULL, &piece->directed[quadrant]);
        }
    }
    sl_order_destroy(context, &order);
    return status;
}

static sl_status begin(sl_context *context, void *job, void **state) {
    sl_view_looker *looker;
    SL_TRY(sl_view_looker_take(context, job, &looker));
    *state = looker;
    return SL_OK;
}

static void end(sl_context *context, void *job, void *state) {
    (void)context;
    sl_view_pieces *pieces = job;
    const sl_view_work work = sl_view_looker_work(state);
    sl_view_looker_give(pieces, state);
    pthread_mutex_lock(&pieces->lock);
    sl_view_work_add(&pieces->work, &work);
    pthread_mutex_unlock(&pieces->lock);
}

static sl_status pass_quadrant(sl_context *context, void *job, void *state, size_t quadrant) {
    sl_view_pieces *pieces = job;
    const sl_view_rooms *rooms = &pieces->rooms;
    uint32_t *first = sl_alloc_array(context, (size_t)rooms->count + 1, sizeof *first);
    uint32_t *to = sl_alloc_array(context, rooms->first_side[rooms->count], sizeof *to);
    sl_status status = first && to ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        fill_graph(rooms, (int)quadrant, first, to);
        status =
            pass(context, pieces, state, (int)quadrant, &(sl_dependence){rooms->count, first, to});
    }
    sl_free(context, first);
    sl_free(context, to);
    return status;
}

sl_status sl_view_pieces_create(sl_context *context, const sl_view_scene *scene, sl_sight sight,
                                unsigned threads, sl_view_pieces *pieces) {
    *pieces = (sl_view_pieces){.context = context, .sight = sight};
    pthread_mutex_init(&pieces->lock, NULL);
    SL_TRY(sl_view_rooms_make(context, scene->space, scene->objects, &pieces->rooms));
    for (uint32_t i = 0; i < pieces->rooms.count; i++) SL_TRY(take_room(pieces, i));
    pieces->work.rooms = pieces->rooms.count;
    const sl_work work = {.job = pieces,
                          .begin = begin,
                          .unit = pass_quadrant,
                          .end = end,
                          .stage = "look",
                          .units = "quadrants"};
    return sl_work_run(context, &work, SL_VIEW_QUADRANTS, threads);
}

// --- cutting

static sl_status cut_polygon(sl_context *context, const sl_view_piece *piece, int axis,
                             double position, sl_view_piece *below, sl_view_piece *above) {
    const size_t count = piece->corners.count;
    for (size_t i = 0; i < count; i++) {
        const sl_point p = piece->corners.items[i];
        const sl_point q = piece->corners.items[i + 1 < count ? i + 1 : 0];
        const double at_p = (axis ? p.y : p.x) - position, at_q = (axis ? q.y : q.x) - position;
        if (at_p <= 0) SL_TRY(add_corner(context, below, p));
        if (at_p >= 0) SL_TRY(add_corner(context, above, p));
        if (!((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))) continue;
        // Of an axial side the crossing is exact.
        const double t = at_p / (at_p - at_q);
        const sl_point c = axis ? (sl_point){p.x + t * (q.x - p.x), position}
                                : (sl_point){position, p.y + t * (q.y - p.y)};
        SL_TRY(add_corner(context, below, c));
        SL_TRY(add_corner(context, above, c));
    }
    return SL_OK;
}

static sl_status look_all(sl_view_looker *looker, const sl_view_piece *whole, sl_view_piece *half) {
    for (int q = 0; q < SL_VIEW_QUADRANTS; q++) {
        const sl_view_directed *known = &whole->directed[q];
        sl_view_look_begin(looker);
        for (size_t i = 0; i < known->rooms.count; i++)
            sl_view_look_allow(looker, known->rooms.items[i]);
        SL_TRY(sl_view_look(looker, half, q, known, &half->directed[q]));
    }
    return SL_OK;
}

sl_status sl_view_pieces_halve(sl_context *context, const sl_view_pieces *pieces,
                               sl_view_looker *looker, uint32_t number, int axis, double position,
                               bool asks_below, bool asks_above, sl_view_halves *out) {
    const sl_view_piece *whole = &pieces->items.items[number];
    out->below = out->above = (sl_view_piece){.room = whole->room, .box = sl_view_no_extent()};
    SL_TRY(cut_polygon(context, whole, axis, position, &out->below, &out->above));
    if (asks_below) SL_TRY(look_all(looker, whole, &out->below));
    if (asks_above) SL_TRY(look_all(looker, whole, &out->above));
    out->work = sl_view_looker_work(looker);
    return SL_OK;
}

void sl_view_halves_destroy(sl_context *context, sl_view_halves *halves) {
    piece_destroy(context, &halves->below);
    piece_destroy(context, &halves->above);
}

sl_status sl_view_pieces_cut(sl_view_pieces *pieces, uint32_t number, sl_view_halves *halves,
                             uint32_t *above) {
    sl_context *context = pieces->context;
    SL_TRY(SL_ARRAY_ROOM(context, &pieces->items, 1));
    sl_view_piece *whole = &pieces->items.items[number];
    piece_destroy(context, whole);
    *whole = halves->below;
    *above = (uint32_t)pieces->items.count;
    pieces->items.items[pieces->items.count++] = halves->above;
    pieces->work.cuts++;
    sl_view_work_add(&pieces->work, &halves->work);
    *halves = (sl_view_halves){0};
    return SL_OK;
}

// --- sets

void sl_view_piece_add_to(const sl_view_pieces *pieces, const sl_view_piece *piece, uint64_t *row) {
    const sl_view_rooms *rooms = &pieces->rooms;
    const uint32_t room = piece->room;
    if (rooms->object[room] != SL_NO_OBJECT) sl_bits_add(row, rooms->object[room]);
    for (uint32_t i = rooms->first_side[room]; i < rooms->first_side[room + 1]; i++)
        if (rooms->sides[i].room == SL_NO_ROOM) sl_bits_add(row, rooms->sides[i].object);
    for (int q = 0; q < SL_VIEW_QUADRANTS; q++)
        for (size_t i = 0; i < piece->directed[q].objects.count; i++)
            sl_bits_add(row, piece->directed[q].objects.items[i].object);
}
