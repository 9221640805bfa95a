/// Ways of a walker with a radius, in a room of their own.
///
/// The middle of the walker goes where a point may go, too. So a way of length L or less stays in
/// the cells that are, for a point, no farther than L from the start and the goal together:
///
///         +------+------+------+     S -> G: only walls near A, B and C are grown. Where a
///         |      :  D   |      |     portal leads out of them (to D), it is a wall: a way
///         +--- --+--..--+--- --+     through it is longer than L.
///         | S  A :  B   : C  G |
///         +------+------+------+
///
/// The shortest way there is the shortest of all if it is no longer than L. Else L becomes its
/// length, or it is increased until there is a way. Growing walls costs far more than searching, so
/// all walls are grown once as many have been grown for single ways, and where no way is found.
#include "analysis/route/route.h"

static void drop_part(sl_context *context, sli_route_part *part) {
    sl_free(context, part->has_cell);
    sl_free(context, part->has_wall);
}

/// The walls that are near the cells of a part.
static sl_status add_walls(sl_context *context, const sl_route_finder *f, const sl_space *space,
                           sli_route_part *part) {
    sli_box_list near = {0};
    sl_status status = SL_OK;
    const double reach = sli_route_needed(space, f->radius);
    for (uint32_t c = 0; c < space->cell_count && status == SL_OK; c++) {
        if (!part->has_cell[c]) continue;
        sl_box box = sli_box_of_cell(space, c);
        box = sli_box_with(box, (sl_point){box.min.x - reach, box.min.y - reach});
        box = sli_box_with(box, (sl_point){box.max.x + reach, box.max.y + reach});
        status = sli_box_tree_find(context, &f->walls, &box, &near);
        for (size_t i = 0; i < near.count && status == SL_OK; i++) {
            part->wall_count += !part->has_wall[near.items[i]];
            part->has_wall[near.items[i]] = true;
        }
    }
    sl_free(context, near.items);
    return status;
}

/// The part of the space that ways up to a limit are in.
static sl_status find_part(sl_context *context, const sl_route_finder *f, sl_point from,
                           sl_point to, double limit, sli_route_part *part) {
    const sl_space *space = f->point->space;
    sl_route_near *behind = sl_alloc_array(context, space->cell_count, sizeof *behind),
                  *ahead = sl_alloc_array(context, space->cell_count, sizeof *ahead);
    double most = 0;
    part->has_cell = sl_alloc_array(context, space->cell_count, sizeof *part->has_cell);
    part->has_wall = sl_alloc_array(context, space->wall_count, sizeof *part->has_wall);
    const bool has_room = behind && ahead && part->has_cell && part->has_wall;
    sl_status status = has_room ? sli_route_widen(context, space, limit, &most) : SL_NO_MEMORY;
    if (status == SL_OK) status = sl_route_distances(context, f->point, from, limit, behind);
    if (status == SL_OK) status = sl_route_distances(context, f->point, to, limit, ahead);
    for (uint32_t c = 0; c < space->cell_count && status == SL_OK; c++)
        part->has_cell[c] = behind[c].distance + ahead[c].distance <= most;
    sl_free(context, behind);
    sl_free(context, ahead);
    return status == SL_OK ? add_walls(context, f, space, part) : status;
}

static sl_status find_in_all(sl_context *context, sl_route_finder *f, sl_point from, sl_point to,
                             sl_route *route) {
    if (!f->has_all) SL_TRY(sli_route_make_room(context, f, NULL));
    f->has_all = true;
    return sli_route_find_here(context, f, from, to, route);
}

/// The way in the room of ways up to a limit, or among all walls once that is due.
static sl_status find_within(sl_context *context, sl_route_finder *f, sl_point from, sl_point to,
                             double limit, sl_route *route) {
    sli_route_part part = {0};
    sl_status status = find_part(context, f, from, to, limit, &part);
    f->grown += 1 + (size_t)part.wall_count;
    const bool is_due = f->grown > f->point->space->wall_count;
    if (status == SL_OK && !is_due) status = sli_route_make_room(context, f, &part);
    drop_part(context, &part);
    if (status != SL_OK) return status;
    return is_due ? find_in_all(context, f, from, to, route)
                  : sli_route_find_here(context, f, from, to, route);
}

sl_status sli_route_find_wide(sl_context *context, sl_route_finder *f, sl_point from, sl_point to,
                              sl_route *route) {
    if (f->has_all) return find_in_all(context, f, from, to, route);
    SL_TRY(sl_route_find(context, f->point, from, to, route));
    if (!route->found) return find_in_all(context, f, from, to, route);
    const double least = route->length;
    double limit = least + 2 * f->radius * (double)route->count;
    while (true) {
        SL_TRY(find_within(context, f, from, to, limit, route));
        if (f->has_all || (route->found && route->length <= limit)) return SL_OK;
        limit = route->found ? route->length * (1 + 0x1p-40) : least + 4 * (limit - least);
    }
}
