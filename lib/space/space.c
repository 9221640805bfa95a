/// The space: its bounds, where a point is in it, and its end.
///
/// The kd-tree finds the cell of a point from the root down: at each node, below or above the
/// split. A mesh looks into the one bucket of its grid, and asks each cell there for the exact side
/// of each of its edges. The last cell of a bucket needs no test, as the cells leave nothing out.
/// A point on the border of what is inside is in a cell beside it that is: a kd-tree then asks for
/// the cells at the other sides of the point, as each cell at a point covers one of its four
/// quadrants.
#include "sightline/space.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "map/source.h"
#include "sightline/support.h"
#include "space/index.h"
#include "space/kd_tree.h"

#include <math.h>

void sl_space_destroy(sl_context *context, sl_space *space) {
    sl_free(context, space->nodes);
    sl_free(context, space->cells);
    sl_free(context, space->vertices);
    sl_free(context, space->portals);
    sl_free(context, space->directed);
    sl_free(context, space->walls);
    sl_free(context, space->neighbour);
    sli_cell_grid_destroy(context, &space->grid);
    sl_free(context, space->seams);
    sl_free(context, space->seam_portals);
    sl_free(context, space->passages);
    *space = (sl_space){0};
}

sl_status sli_check_has_walls(sl_context *context, const sl_map *map) {
    if (map->wall_count || map->oneway_count) return SL_OK;
    for (size_t i = 0; i < map->seam_count; i++)
        if (map->seams[i].stops & sl_map_channel(map)) return SL_OK;
    char stops[SL_STOPS_TEXT];
    sl_stops_write(sl_map_channel(map), stops);
    if (sl_map_partial_walls(map))
        return sl_fail_at(context, sli_map_name(map), 0, "no wall stops %s: nothing to subdivide",
                          stops);
    return sl_fail_at(context, sli_map_name(map), 0, "the map has no walls: nothing to subdivide");
}

/// A map whose walls all lie on one line has no area. This adds the missing width on both sides.
static sl_box padded(sl_box box) {
    const double width = box.max.x - box.min.x, height = box.max.y - box.min.y;
    const double wider = width > height ? width : height;
    if (width == 0) {
        // Far from the origin, a small step would round to nothing and leave the map without area.
        box.min.x = fmin(box.min.x - wider / 2, nextafter(box.min.x, -INFINITY));
        box.max.x = fmax(box.max.x + wider / 2, nextafter(box.max.x, INFINITY));
    }
    if (height == 0) {
        box.min.y = fmin(box.min.y - wider / 2, nextafter(box.min.y, -INFINITY));
        box.max.y = fmax(box.max.y + wider / 2, nextafter(box.max.y, INFINITY));
    }
    return box;
}

static bool on_border(const sl_box *b, sl_segment at) {
    return (at.a.x == at.b.x && (at.a.x == b->min.x || at.a.x == b->max.x)) ||
           (at.a.y == at.b.y && (at.a.y == b->min.y || at.a.y == b->max.y));
}

sl_box sli_space_bounds(const sl_map *map) {
    sl_box box = sl_map_bounds(map);
    bool wider = false;
    for (size_t i = 0; i < map->seam_count && !wider; i++)
        wider = map->seams[i].stops && on_border(&box, map->seams[i].segment);
    if (!wider) return padded(box);
    const double more = fmax(box.max.x - box.min.x, box.max.y - box.min.y) / 16;
    return (sl_box){{fmin(box.min.x - more, nextafter(box.min.x, -INFINITY)),
                     fmin(box.min.y - more, nextafter(box.min.y, -INFINITY))},
                    {fmax(box.max.x + more, nextafter(box.max.x, INFINITY)),
                     fmax(box.max.y + more, nextafter(box.max.y, INFINITY))}};
}

bool sli_cell_holds(const sl_space *space, uint32_t number, sl_point point) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = space->vertices + cell->first_vertex;
    // One limit for all corners, as they are within the bounds.
    const sl_box *b = &space->bounds;
    const sl_point reach = {sli_greater(point.x - b->min.x, b->max.x - point.x),
                            sli_greater(point.y - b->min.y, b->max.y - point.y)};
    const double limit = sli_turn_limit(reach, reach);
    sl_point from = corners[cell->vertex_count - 1];
    sl_point offset = {from.x - point.x, from.y - point.y};
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point to = corners[i], next = {to.x - point.x, to.y - point.y};
        const int turn = sli_turn_filter_within(offset, next, limit);
        if (turn < 0 || (turn == 0 && sli_orient(from, to, point) < 0)) return false;
        from = to;
        offset = next;
    }
    return true;
}

/// Of the cells that hold a point, the one with the highest number here counts.
static int claim_of(const sl_cell *cell) {
    return cell->inside ? 2 : !cell->solid;
}

/// The first cell of a bucket that holds a point and is inside, else the first that is not solid,
/// else the first. Cells tile the bounds, so the last one holds it if no other does.
static uint32_t locate_in_bucket(const sl_space *space, sl_point point) {
    const uint32_t bucket = sli_cell_grid_bucket(space, point);
    const uint32_t *cells = space->grid.cells, end = sli_cell_grid_stop(&space->grid, bucket);
    uint32_t found = SL_NO_CELL;
    int best = -1;
    for (uint32_t i = space->grid.first[bucket]; i < end && best < 2; i++) {
        const bool last = i + 1 == end && !space->loose;
        const int claim = claim_of(&space->cells[cells[i]]);
        if (claim <= best) continue;
        if (!(last && best < 0) && !sli_cell_holds(space, cells[i], point)) continue;
        found = cells[i];
        best = claim;
    }
    return found;
}

/// The cell of a kd-tree that a point is in, or that is right of it and over it.
static uint32_t descend(const sl_space *space, sl_point point) {
    int32_t at = space->root;
    while (at >= 0) {
        const sl_node *node = &space->nodes[at];
        at = (node->axis ? point.y : point.x) < node->position ? node->below : node->above;
    }
    return (uint32_t)~at;
}

uint32_t sl_space_locate(const sl_space *space, sl_point point) {
    const sl_box *b = &space->bounds;
    if (!space->cell_count || !(point.x >= b->min.x && point.x <= b->max.x) ||
        !(point.y >= b->min.y && point.y <= b->max.y))
        return SL_NO_CELL;
    if (space->neighbour) return locate_in_bucket(space, point);
    uint32_t found = descend(space, point);
    // The next smaller number is below the same split lines, and below one through the point.
    for (int side = 1; side < 4 && !space->cells[found].inside; side++) {
        const sl_point beside = {side & 1 ? nextafter(point.x, -INFINITY) : point.x,
                                 side & 2 ? nextafter(point.y, -INFINITY) : point.y};
        const uint32_t cell = descend(space, beside);
        if (claim_of(&space->cells[cell]) > claim_of(&space->cells[found])) found = cell;
    }
    return found;
}

double sl_space_area(const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    const sl_point *v = space->vertices + c->first_vertex;
    double twice = 0;
    for (uint32_t i = 2; i < c->vertex_count; i++)
        twice +=
            (v[i - 1].x - v[0].x) * (v[i].y - v[0].y) - (v[i].x - v[0].x) * (v[i - 1].y - v[0].y);
    return twice / 2;
}

sl_point sl_space_middle(const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    sl_point sum = {0, 0};
    // Relative to a corner, so that neither far places nor huge ones lose the middle.
    const sl_point *corners = space->vertices + c->first_vertex, base = corners[0];
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        sum.x += (corners[i].x - base.x) / c->vertex_count;
        sum.y += (corners[i].y - base.y) / c->vertex_count;
    }
    return (sl_point){base.x + sum.x, base.y + sum.y};
}

// --- places that are inside

bool sl_space_is_inside(const sl_space *space, sl_point point) {
    const uint32_t cell = sl_space_locate(space, point);
    return cell != SL_NO_CELL && space->cells[cell].inside;
}

bool sl_space_nearest_inside(const sl_space *space, sl_point point, sl_point *out) {
    double least = INFINITY;
    uint32_t best = SL_NO_CELL;
    sl_point at = point;
    if (sl_space_is_inside(space, point)) {
        *out = point;
        return true;
    }
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        const sl_point *corners = space->vertices + cell->first_vertex;
        for (uint32_t k = 0; k < cell->vertex_count && cell->inside; k++) {
            const sl_point p =
                sli_nearest_on(corners[k], corners[(k + 1) % cell->vertex_count], point);
            const double distance = sli_length(p.x - point.x, p.y - point.y);
            if (!(distance < least)) continue;
            least = distance;
            best = i;
            at = p;
        }
    }
    if (best == SL_NO_CELL) return false;
    // Off the wall, into the cell.
    const sl_point middle = sl_space_middle(space, best);
    *out = middle;
    for (double share = 0x1p-10; share < 1; share *= 8) {
        const sl_point p = {at.x + share * (middle.x - at.x), at.y + share * (middle.y - at.y)};
        if (sl_space_locate(space, p) != best) continue;
        *out = p;
        break;
    }
    return true;
}
