/// Rooms without an opening.
///
/// Cells that portals join, but through windows, are a room. A drawing has more of them than it has
/// rooms: the core of a wall that is drawn by its two faces, a pipe, the leg of a chair. So only
/// thick rooms count. The thickness of a room is 2 area / length of its walls: half the side of a
/// square, and the width of a long passage. It is rounded, and decides what is told, never what is
/// seen.
#include "geometry/length.h"
#include "sightline/faults.h"
#include "sightline/support.h"
#include "space/index.h"

#include <math.h>

/// A room counts that is as thick as this share of the thickest one, and as large as this share of
/// the area inside.
#define THICK 0.25
#define LARGE 0.004

/// A room is at the edge that lies along this share of the map's bounds, or touches so many of
/// their sides.
#define ALONG 0.05
enum { AROUND = 3 };

/// Whether steps pass a portal: a window lets sight through alone.
static bool is_passed(const sl_map *map, const sl_space *space, uint32_t portal) {
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(space, portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &space->seams[on[i].seam];
        if (sli_is_map_seam(seam) && map->seams[seam->number].stops & SL_STOPS_STEPS) return false;
    }
    return true;
}

/// The sides of the map's bounds that a room touches, and how far it lies along them.
typedef struct border {
    bool touched[4];
    double along;
} border;

/// Adds the side from a to b of a cell.
static void touch(const sl_box *edge, sl_point a, sl_point b, border *out) {
    const bool from[] = {a.x == edge->min.x, a.x == edge->max.x, a.y == edge->min.y,
                         a.y == edge->max.y};
    const bool to[] = {b.x == edge->min.x, b.x == edge->max.x, b.y == edge->min.y,
                       b.y == edge->max.y};
    for (int i = 0; i < 4; i++) {
        out->touched[i] |= from[i];
        if (from[i] && to[i]) out->along += sli_length(b.x - a.x, b.y - a.y);
    }
}

static bool is_at_edge(const sl_box *edge, const border *of) {
    const double all = 2 * (edge->max.x - edge->min.x + edge->max.y - edge->min.y);
    const int sides = of->touched[0] + of->touched[1] + of->touched[2] + of->touched[3];
    return sides >= AROUND || of->along >= ALONG * all;
}

/// Adds up a cell: its area, and the length of its sides that are walls.
static void measure(const sl_map *map, const sl_space *space, const sl_box *edge, uint32_t number,
                    sl_sealed_room *room, border *bounds) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = space->vertices + cell->first_vertex;
    room->area += sl_space_area(space, number);
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % cell->vertex_count];
        room->walls += sli_length(b.x - a.x, b.y - a.y);
        touch(edge, a, b, bounds);
    }
    for (uint32_t i = 0; i < cell->directed_count; i++) {
        const sl_directed_portal *portal = &space->directed[cell->first_directed + i];
        if (!is_passed(map, space, portal->portal)) continue;
        room->walls -=
            sli_length(portal->right.x - portal->left.x, portal->right.y - portal->left.y);
    }
}

/// The room of a cell that was not reached before.
static sl_sealed_room room_of(const sl_map *map, const sl_space *space, const sl_box *edge,
                              sl_bits *reached, uint32_t *queue, uint32_t first) {
    sl_sealed_room room = {0};
    border bounds = {0};
    double largest = -1;
    uint32_t end = 0;
    sl_bits_add(reached, first);
    queue[end++] = first;
    for (uint32_t at = 0; at < end; at++) {
        const sl_cell *cell = &space->cells[queue[at]];
        const double area = sl_space_area(space, queue[at]);
        measure(map, space, edge, queue[at], &room, &bounds);
        if (area > largest) {
            largest = area;
            room.at = sl_space_middle(space, queue[at]);
        }
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const sl_directed_portal *portal = &space->directed[cell->first_directed + i];
            const uint32_t next = portal->cell;
            if (sl_bits_has(reached, next) || !is_passed(map, space, portal->portal)) continue;
            sl_bits_add(reached, next);
            queue[end++] = next;
        }
    }
    room.at_edge = is_at_edge(edge, &bounds);
    return room;
}

static double thickness(const sl_sealed_room *room) {
    return room->walls > 0 ? 2 * room->area / room->walls : 0;
}

/// The map of a baked file has its doors and seams, and no walls: the space has these.
static sl_box bounds_of(const sl_map *map, const sl_space *space) {
    sl_map whole = *map;
    whole.walls = space->walls;
    whole.wall_count = space->wall_count;
    return sl_map_bounds(&whole);
}

sl_status sl_find_sealed(sl_context *context, const sl_map *map, const sl_space *space,
                         sl_sealed *out) {
    SL_ARRAY(sl_sealed_room) rooms = {0};
    sl_bits *reached = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof *reached);
    uint32_t *queue = sl_alloc_array(context, space->cell_count, sizeof *queue);
    sl_status status = reached && queue ? SL_OK : SL_NO_MEMORY;
    double inside = 0, thickest = 0, sealed = 0;
    size_t open = 0;
    const sl_box edge = bounds_of(map, space);
    *out = (sl_sealed){0};
    for (uint32_t i = 0; status == SL_OK && i < space->cell_count; i++) {
        if (!space->cells[i].inside || sl_bits_has(reached, i)) continue;
        status = SL_ARRAY_ROOM(context, &rooms, 1);
        if (status != SL_OK) break;
        const sl_sealed_room room = room_of(map, space, &edge, reached, queue, i);
        inside += room.area;
        thickest = fmax(thickest, thickness(&room));
        if (room.area > out->open.area) {
            open = rooms.count;
            out->open = room;
        }
        if (!room.at_edge && room.area > out->within.area) out->within = room;
        rooms.items[rooms.count++] = room;
    }
    for (size_t i = 0; i < rooms.count; i++) {
        const sl_sealed_room *room = &rooms.items[i];
        if (thickness(room) < THICK * thickest || room->area < LARGE * inside) continue;
        out->rooms++;
        if (i == open) continue;
        sealed += room->area;
        if (room->area > out->largest.area) out->largest = *room;
    }
    out->share = inside > 0 ? sealed / inside : 0;
    sl_free(context, reached);
    sl_free(context, queue);
    sl_free(context, rooms.items);
    return status;
}
