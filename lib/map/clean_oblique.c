/// Cleaning with oblique walls: all segments of a map become one planar graph (planar.h).
///
///     walls | mirrors | one-way glass | seams | doors | sides of the map's cells
///     \_____________________ one list of segments _____________________________/
///                                    |  sli_planar_make: weld, split at crossings
///                                    v
///     chains of edges, one for each segment, in the same order
///
/// Two segments that lie on each other get the same edges. So a mirror is exactly on its wall, and
/// a door that is shut is as tight as a wall. What the map holds is then replaced by its chains: an
/// edge of a wall is a wall, a piece of glass becomes several, a door gets parts, a cell gets
/// corners.
#include "geometry/orient.h"
#include "map/ground.h"
#include "map/planar.h"
#include "map/source.h"
#include "sightline/support.h"

#include <math.h>

/// All segments of a map in one list, kind after kind.
typedef struct segment_list {
    SL_ARRAY(sl_segment) items;
    size_t mirrors, oneways, seams, doors, cells; ///< the first of each; walls come before them
} segment_list;

typedef struct maker {
    sl_context *context;
    const sl_wall *walls;
    sl_clean_account *account;
    segment_list list;
    sli_planar graph;
} maker;

static sl_status add_segment(sl_context *context, segment_list *list, sl_point a, sl_point b) {
    SL_TRY(SL_ARRAY_ROOM(context, &list->items, 1));
    list->items.items[list->items.count++] = (sl_segment){a, b};
    return SL_OK;
}

static sl_status add_glass(sl_context *context, segment_list *list, const sl_glass *glass,
                           size_t count) {
    for (size_t i = 0; i < count; i++)
        SL_TRY(add_segment(context, list, glass[i].segment.a, glass[i].segment.b));
    return SL_OK;
}

static sl_status list_segments(sl_context *context, const sl_wall *walls, size_t count,
                               const sl_map *map, segment_list *list) {
    for (size_t i = 0; i < count; i++) SL_TRY(add_segment(context, list, walls[i].a, walls[i].b));
    list->mirrors = list->items.count;
    SL_TRY(add_glass(context, list, map->mirrors, map->mirror_count));
    list->oneways = list->items.count;
    SL_TRY(add_glass(context, list, map->oneways, map->oneway_count));
    list->seams = list->items.count;
    SL_TRY(add_glass(context, list, map->seams, map->seam_count));
    list->doors = list->items.count;
    for (size_t i = 0; i < map->door_count; i++)
        SL_TRY(add_segment(context, list, map->doors[i].segment.a, map->doors[i].segment.b));
    list->cells = list->items.count;
    for (size_t i = 0; i < map->cell_count; i++) {
        const sl_map_cell *cell = &map->cells[i];
        const sl_point *corners = map->corners + cell->first;
        for (size_t k = 0; k < cell->count; k++)
            SL_TRY(add_segment(context, list, corners[k], corners[(k + 1) % cell->count]));
    }
    return SL_OK;
}

typedef struct glass_list {
    sl_glass *items;
    size_t count;
} glass_list;

/// The parts that a map gets in place of its own. They are all made before the map is touched, so
/// that no failure leaves it half done.
typedef struct replacement {
    sl_wall *walls;
    glass_list mirrors, oneways, seams;
    sl_segment **doors; ///< by door: its parts
    sl_point *corners;  ///< of cells
    size_t wall_count;
} replacement;

/// Line 0 stands for none.
static uint32_t lower_line(uint32_t a, uint32_t b) {
    return a - 1 <= b - 1 ? a : b;
}

/// The ground of an edge to which walls were moved. Solid ground on both sides may be two polygons
/// side by side, or a thin one that is gone. The walls round it will tell (sl_wall.ground).
static uint32_t sure_ground(uint32_t ground) {
    return sli_ground_hides_wall(ground & ~(uint32_t)SLI_GROUND_KEPT) ? ground & SLI_GROUND_KEPT
                                                                      : ground;
}

/// Makes a wall of each edge that is part of one, but for edges inside of solid ground.
static sl_status make_walls(maker *m, replacement *out) {
    const sli_planar *graph = &m->graph;
    uint32_t *lines = sl_alloc_array(m->context, graph->edge_count, sizeof *lines);
    uint32_t *ground = sl_alloc_array(m->context, graph->edge_count, sizeof *ground);
    bool *walled = sl_alloc_array(m->context, graph->edge_count, sizeof *walled);
    bool *moved = sl_alloc_array(m->context, graph->edge_count, sizeof *moved);
    out->walls = sl_alloc_array(m->context, graph->edge_count, sizeof *out->walls);
    const bool done = lines && ground && walled && moved && out->walls;
    for (size_t i = 0; i < m->list.mirrors && done; i++) {
        const size_t parts = graph->first[i + 1] - graph->first[i];
        m->account->split += parts > 1;
        m->account->zero_length += parts == 0;
        for (size_t k = graph->first[i]; k < graph->first[i + 1]; k++) {
            const size_t edge = graph->links[k] / 2;
            const uint32_t line = m->walls[i].line;
            lines[edge] = walled[edge] ? lower_line(lines[edge], line) : line;
            m->account->merged += walled[edge];
            walled[edge] = true;
            const uint32_t own = m->walls[i].ground;
            const sl_segment at = {graph->points[graph->edges[edge].a],
                                   graph->points[graph->edges[edge].b]};
            moved[edge] |= sli_orient(m->walls[i].a, m->walls[i].b, at.a) ||
                           sli_orient(m->walls[i].a, m->walls[i].b, at.b);
            ground[edge] =
                sli_ground_joined(ground[edge], graph->links[k] % 2 ? sli_ground_turned(own) : own);
        }
    }
    for (size_t i = 0; i < graph->edge_count && done; i++)
        if (moved[i]) ground[i] = sure_ground(ground[i]);
    for (size_t i = 0; i < graph->edge_count && done; i++)
        if (walled[i] && !sli_ground_hides_wall(ground[i]))
            out->walls[out->wall_count++] =
                (sl_wall){graph->points[graph->edges[i].a], graph->points[graph->edges[i].b],
                          lines[i], ground[i] & ~(uint32_t)SLI_GROUND_KEPT};
    sl_free(m->context, lines);
    sl_free(m->context, ground);
    sl_free(m->context, walled);
    sl_free(m->context, moved);
    return done ? SL_OK : SL_NO_MEMORY;
}

/// The parts that mirrors, one-way glass or seams have become. One that welding closed is kept
/// without length, as a door is: sl_map_clean() leaves all of these out, and says so.
static sl_status make_glass(sl_context *context, const sli_planar *graph, size_t first,
                            const sl_glass *glass, size_t count, glass_list *out) {
    const size_t most = graph->first[first + count] - graph->first[first] + count;
    out->items = sl_alloc_array(context, most, sizeof *out->items);
    if (!out->items) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const size_t from = graph->first[first + i], to = graph->first[first + i + 1];
        for (size_t k = from; k < to; k++) {
            out->items[out->count] = glass[i];
            out->items[out->count++].segment = sli_planar_at(graph, graph->links[k]);
        }
        if (from < to) continue;
        out->items[out->count] = glass[i];
        out->items[out->count++].segment.b = glass[i].segment.a;
    }
    return SL_OK;
}

static sl_status make_doors(sl_context *context, const sli_planar *graph, size_t first,
                            size_t count, sl_segment ***out) {
    *out = sl_alloc_array(context, count, sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const size_t links = graph->first[first + i], parts = graph->first[first + i + 1] - links;
        (*out)[i] = sl_alloc_array(context, parts, sizeof ***out);
        if (!(*out)[i]) return SL_NO_MEMORY;
        for (size_t k = 0; k < parts; k++)
            (*out)[i][k] = sli_planar_at(graph, graph->links[links + k]);
    }
    return SL_OK;
}

static sl_status make_replacement(maker *m, const sl_map *map, replacement *out) {
    sl_context *context = m->context;
    const sli_planar *graph = &m->graph;
    const segment_list *list = &m->list;
    SL_TRY(make_walls(m, out));
    SL_TRY(
        make_glass(context, graph, list->mirrors, map->mirrors, map->mirror_count, &out->mirrors));
    SL_TRY(
        make_glass(context, graph, list->oneways, map->oneways, map->oneway_count, &out->oneways));
    SL_TRY(make_glass(context, graph, list->seams, map->seams, map->seam_count, &out->seams));
    SL_TRY(make_doors(context, graph, list->doors, map->door_count, &out->doors));
    const size_t sides = graph->first[list->items.count] - graph->first[list->cells];
    out->corners = sl_alloc_array(context, sides, sizeof *out->corners);
    return out->corners ? SL_OK : SL_NO_MEMORY;
}

static void replace_glass(sl_context *context, sl_glass **glass, size_t *count, size_t *room,
                          glass_list *with) {
    sl_free(context, *glass);
    *glass = with->items;
    *count = *room = with->count;
    with->items = NULL;
}

/// A door keeps its name and number, however it is cut.
static void replace_door(sl_context *context, sl_door *door, sl_segment **parts, size_t count) {
    sl_free(context, door->parts);
    door->parts = NULL;
    door->part_count = 0;
    door->segment.b = count ? (*parts)[count - 1].b : door->segment.a;
    if (count) door->segment.a = (*parts)[0].a;
    if (count < 2) return;
    door->parts = *parts;
    door->part_count = count;
    *parts = NULL;
}

/// The sides of a cell have become edges; its corners are the starts of these edges.
static void replace_cells(sl_context *context, const sli_planar *graph, size_t first, sl_map *map,
                          sl_point **corners) {
    size_t cells = 0, count = 0;
    uint32_t first_line = 0;
    for (size_t i = 0; i < map->cell_count; i++) {
        sl_map_cell cell = map->cells[i];
        const size_t *sides = graph->first + first + cell.first;
        cell.first = count;
        for (size_t k = sides[0]; k < sides[cell.count]; k++)
            (*corners)[count++] = sli_planar_at(graph, graph->links[k]).a;
        cell.count = (uint32_t)(count - cell.first);
        if (cell.count >= 3) {
            map->cells[cells++] = cell;
            continue;
        }
        count = cell.first;
        if (i == cells) first_line = cell.line;
    }
    if (cells < map->cell_count)
        sl_note(context,
                "%s: %zu of the map's own cells, the first on line %u, have no area after welding "
                "and are left out; make them larger, or give a smaller tolerance (--weld)",
                sli_map_name(map), map->cell_count - cells, (unsigned)first_line);
    sl_free(context, map->corners);
    map->corners = *corners;
    *corners = NULL;
    map->corner_count = map->corner_room = count;
    map->cell_count = cells;
}

static void replace(maker *m, replacement *with, sl_map *map) {
    sl_context *context = m->context;
    const segment_list *list = &m->list;
    const size_t *first = m->graph.first;
    sl_free(context, map->walls);
    map->walls = with->walls;
    with->walls = NULL;
    map->wall_count = map->wall_room = m->account->after = with->wall_count;
    replace_glass(context, &map->mirrors, &map->mirror_count, &map->mirror_room, &with->mirrors);
    replace_glass(context, &map->oneways, &map->oneway_count, &map->oneway_room, &with->oneways);
    replace_glass(context, &map->seams, &map->seam_count, &map->seam_room, &with->seams);
    for (size_t i = 0; i < map->door_count; i++)
        replace_door(context, &map->doors[i], &with->doors[i],
                     first[list->doors + i + 1] - first[list->doors + i]);
    if (map->cell_count) replace_cells(context, &m->graph, list->cells, map, &with->corners);
    m->account->welded = m->graph.welded;
    m->account->crossings = m->graph.crossings;
    m->account->largest_move = m->graph.largest_move;
}

static sl_status take_graph(maker *m, sl_map *map) {
    replacement with = {0};
    const sl_status status = make_replacement(m, map, &with);
    if (status == SL_OK) replace(m, &with, map);
    for (size_t i = 0; with.doors && i < map->door_count; i++) sl_free(m->context, with.doors[i]);
    void *const scratch[] = {with.doors,         with.walls,       with.mirrors.items,
                             with.oneways.items, with.seams.items, with.corners};
    for (size_t i = 0; i < sizeof scratch / sizeof *scratch; i++) sl_free(m->context, scratch[i]);
    return status;
}

sl_status sli_clean_oblique(sl_context *context, sl_map *map, const sl_wall *walls, size_t count,
                            double weld, bool *idle, sl_clean_account *account) {
    maker m = {.context = context, .walls = walls, .account = account};
    sl_status status = list_segments(context, walls, count, map, &m.list);
    if (status == SL_OK)
        status = sli_planar_make(context, sli_map_name(map), m.list.items.items, m.list.items.count,
                                 fmax(weld, 2 * map->snap), &m.graph);
    if (idle) *idle = m.graph.largest_move == 0;
    if (status == SL_OK && !(idle && *idle)) status = take_graph(&m, map);
    sli_planar_destroy(context, &m.graph);
    sl_free(context, m.list.items.items);
    return status;
}
