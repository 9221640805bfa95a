/// Portals become walls: those of shut doors, the dark sides of glass, and walls that stop some of
/// sight, steps and sound, where the space is for what they stop.
///
/// A space is first cut with all such walls as seams, so that a portal lies on each of them:
///
///     cell 0 | cell 1       The portal of a window stays in the space of sight, and is a wall in
///            |              that of steps. Of a curtain it is the other way round. The passage of
///     portal on a seam      that wall keeps which cells are beside it.
#include "space/walled.h"

#include "geometry/orient.h"
#include "space/index.h"

#include <string.h>

static void add_walls(const sli_walled *w) {
    sl_space *s = w->out;
    for (uint32_t i = 0; i < w->from->portal_count; i++) {
        if (w->portals[i] != UINT32_MAX) continue;
        sl_wall *wall = &s->walls[s->wall_count++]; // its line may be known
        wall->a = w->from->portals[i].right;
        wall->b = w->from->portals[i].left;
    }
    for (uint32_t i = 0; i < w->from->portal_count && w->dark; i++) {
        if (w->dark[i] == UINT32_MAX) continue;
        const sl_directed_portal *directed = &w->from->directed[w->dark[i]];
        s->walls[s->wall_count++] = (sl_wall){.a = directed->right, .b = directed->left};
    }
}

/// The wall that a portal, or its dark side, has become; counted as add_walls does.
static void number_walls(const sli_walled *w, uint32_t *walls) {
    uint32_t next = w->from->wall_count;
    for (uint32_t i = 0; i < w->from->portal_count; i++)
        walls[i] = w->portals[i] == UINT32_MAX ? next++ : UINT32_MAX;
    for (uint32_t i = 0; i < w->from->portal_count && w->dark; i++)
        if (w->dark[i] != UINT32_MAX) walls[i] = next++;
}

/// Marks the sides of a mesh's cells that are walls now.
static void tell_sides(const sli_walled *w, const uint32_t *walls) {
    const sl_space *f = w->from;
    for (uint32_t i = 0; i < f->cell_count; i++) {
        const sl_cell *cell = &f->cells[i];
        uint32_t directed = cell->first_directed;
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            uint32_t *what = &w->out->neighbour[cell->first_vertex + k];
            if (*what != SL_NEIGHBOUR_PORTAL) continue;
            const uint32_t number = directed++, portal = f->directed[number].portal;
            const bool shut = w->portals[portal] == UINT32_MAX;
            if (shut)
                *what = walls[portal] | (f->portals[portal].cell[0] == i ? 0 : SL_NEIGHBOUR_RIGHT);
            else if (w->dark && w->dark[portal] == number)
                *what = walls[portal];
        }
    }
}

static void drop_portals(const sli_walled *w) {
    const sl_space *f = w->from;
    sl_space *s = w->out;
    s->portal_count = s->seam_portal_count = 0;
    for (uint32_t i = 0; i < f->portal_count; i++)
        if (w->portals[i] != UINT32_MAX) s->portals[s->portal_count++] = f->portals[i];
    for (uint32_t i = 0; i < f->seam_portal_count; i++) {
        sl_seam_portal on = f->seam_portals[i];
        on.portal = w->portals[on.portal];
        if (on.portal != UINT32_MAX) s->seam_portals[s->seam_portal_count++] = on;
    }
}

static void drop_directed(const sli_walled *w) {
    sl_space *s = w->out;
    s->directed_count = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const uint32_t first = w->from->cells[i].first_directed;
        const uint32_t end = first + w->from->cells[i].directed_count;
        s->cells[i].first_directed = s->directed_count;
        for (uint32_t k = first; k < end; k++) {
            if (w->barred[k]) continue;
            sl_directed_portal directed = w->from->directed[k];
            directed.portal = w->portals[directed.portal];
            s->directed[s->directed_count++] = directed;
        }
        s->cells[i].directed_count = s->directed_count - s->cells[i].first_directed;
    }
}

sl_status sli_walled_make(sl_context *context, const sli_walled *walled) {
    if (walled->from->neighbour) {
        uint32_t *walls = sl_alloc_array(context, walled->from->portal_count, sizeof *walls);
        if (!walls) return SL_NO_MEMORY;
        number_walls(walled, walls);
        tell_sides(walled, walls);
        sl_free(context, walls);
    }
    add_walls(walled);
    drop_portals(walled);
    drop_directed(walled);
    return SL_OK;
}

// --- walls that stop some of sight, steps and sound

/// Whether a cell has all of a wall on its boundary, and is at the left or right of it.
static bool is_beside(const sl_space *s, uint32_t number, const sl_wall *wall, bool left) {
    if (number >= s->cell_count) return false;
    const sl_cell *cell = &s->cells[number];
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const int side = sli_orient(wall->a, wall->b, s->vertices[cell->first_vertex + i]);
        if (side && (side > 0) != left) return false;
    }
    return sli_cell_holds(s, number, wall->a) && sli_cell_holds(s, number, wall->b);
}

sl_status sli_passages_check(sl_context *context, const sl_space *space) {
    for (uint32_t i = 0; i < space->passage_count; i++) {
        const sl_passage *p = &space->passages[i];
        if (p->wall >= space->wall_count || (i && p->wall <= p[-1].wall) || !p->stops ||
            p->stops >= SL_STOPS_ALL ||
            !is_beside(space, p->cell[0], &space->walls[p->wall], true) ||
            !is_beside(space, p->cell[1], &space->walls[p->wall], false))
            return sl_fail(context, SL_BAD_INPUT, "passage %u is none", i);
    }
    return SL_OK;
}

uint32_t sli_portal_stops(const sl_map *map, const sl_space *space, uint32_t portal) {
    size_t count;
    uint32_t stops = 0;
    const sl_seam_portal *on = sl_space_seams_of(space, portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &space->seams[on[i].seam];
        if (sli_is_map_seam(seam)) stops |= map->seams[seam->number].stops;
    }
    return stops & SL_STOPS_SIGHT ? stops & SL_STOPS_ALL : stops;
}

/// The first line of the walls that a portal lies on.
static uint32_t line_of(const sl_map *map, const sl_space *space, uint32_t portal) {
    size_t count;
    uint32_t line = 0;
    const sl_seam_portal *on = sl_space_seams_of(space, portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &space->seams[on[i].seam];
        if (!sli_is_map_seam(seam)) continue;
        const sl_glass *from = &map->seams[seam->number];
        if (!from->stops) continue;
        if (!line || from->line < line) line = from->line;
    }
    return line;
}

typedef struct channel {
    sl_context *context;
    const sl_map *map;
    sl_space from, *space;
    uint32_t *portals, *stops; ///< by portal
    bool *barred;
    uint32_t walls, passages;
} channel;

/// Finds the portals that become walls.
static void choose(channel *c) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < c->from.portal_count; i++) {
        c->stops[i] = sli_portal_stops(c->map, &c->from, i);
        const bool wall = c->stops[i] & sl_map_channel(c->map);
        c->portals[i] = wall ? UINT32_MAX : kept++;
        c->walls += wall;
        c->passages += wall && c->stops[i] != SL_STOPS_ALL;
    }
    for (uint32_t k = 0; k < c->from.directed_count; k++)
        c->barred[k] = c->portals[c->from.directed[k].portal] == UINT32_MAX;
}

static sl_status make_room(channel *c) {
    sl_space *s = c->space;
    const size_t walls = (size_t)s->wall_count + c->walls;
    if (walls > INT32_MAX) return sl_fail_memory(c->context);
    sl_wall *room = sl_alloc_array(c->context, walls, sizeof *room);
    s->passages = c->passages ? sl_alloc_array(c->context, c->passages, sizeof *s->passages) : NULL;
    if (!room || (c->passages && !s->passages)) {
        sl_free(c->context, room);
        return SL_NO_MEMORY;
    }
    if (s->wall_count) memcpy(room, s->walls, s->wall_count * sizeof *room);
    sl_free(c->context, s->walls);
    s->walls = room;
    return SL_OK;
}

static sl_status make(channel *c) {
    sl_space *s = c->space;
    choose(c);
    if (!c->walls) return SL_OK;
    SL_TRY(make_room(c));
    uint32_t next = s->wall_count;
    for (uint32_t i = 0; i < c->from.portal_count; i++) {
        const uint32_t *cell = c->from.portals[i].cell;
        if (c->portals[i] != UINT32_MAX) continue;
        if (c->stops[i] != SL_STOPS_ALL)
            s->passages[s->passage_count++] =
                (sl_passage){next, c->stops[i] & SL_STOPS_ALL, {cell[0], cell[1]}};
        s->walls[next++].line = line_of(c->map, &c->from, i);
    }
    return sli_walled_make(
        c->context,
        &(sli_walled){.from = &c->from, .out = s, .portals = c->portals, .barred = c->barred});
}

sl_status sli_walled_by_channel(sl_context *context, const sl_map *map, sl_space *space) {
    bool any = false;
    for (size_t i = 0; i < map->seam_count; i++) any |= map->seams[i].stops != 0;
    if (!any) return SL_OK;
    channel c = {.context = context, .map = map, .from = *space, .space = space};
    c.portals = sl_alloc_array(context, space->portal_count, sizeof *c.portals);
    c.stops = sl_alloc_array(context, space->portal_count, sizeof *c.stops);
    c.barred = sl_alloc_array(context, space->directed_count, sizeof *c.barred);
    const sl_status status = c.portals && c.stops && c.barred ? make(&c) : SL_NO_MEMORY;
    sl_free(context, c.portals);
    sl_free(context, c.stops);
    sl_free(context, c.barred);
    return status;
}
