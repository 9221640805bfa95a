/// The space as sight finds it now. What may change between two questions are the portals on doors
/// and on one-way glass. Each has three states, and a wall stands ready for two of them:
///
///     open            |  portal  |   both cells have a directed portal there
///     shut            ############   both have the wall `door`
///     dark one way    |##########    the cell on the dark side has the wall `dark`, the other one
///                     |  portal  |   a directed portal
///
/// A cell is written anew from the base: its directed portals in their order, without those that
/// are barred. There is always room, as the base has them all.
///
/// For the outline all of these portals are walls first, so that rooms end at them. Then the two
/// sides of each are linked to each other, or not, as the portal stands.
#include "sight/sight_space.h"

#include "effects/filtered.h"
#include "geometry/orient.h"
#include "sightline/effects.h"
#include "sightline/support.h"
#include "space/index.h"
#include "space/kd_tree.h"
#include "space/outline.h"

#include <stdlib.h>
#include <string.h>

// --- which portals

static bool is_special(const sl_space *base, const sl_seam_portal *on) {
    return !sli_is_map_seam(&base->seams[on->seam]);
}

static uint32_t count_specials(const sl_space *base) {
    uint32_t count = 0, last = UINT32_MAX;
    for (uint32_t i = 0; i < base->seam_portal_count; i++) {
        const sl_seam_portal *on = &base->seam_portals[i];
        if (!is_special(base, on) || on->portal == last) continue;
        last = on->portal;
        count++;
    }
    return count;
}

static bool is_shut(const sl_space *base, uint32_t portal, const bool *shut) {
    size_t count;
    const sl_seam_portal *on = sl_space_seams_of(base, portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &base->seams[on[i].seam];
        if (seam->kind == SL_SEAM_DOOR && shut[seam->number]) return true;
    }
    return false;
}

/// Finds what glass blocks at a portal.
static void find_blocked(const sl_space *base, sli_sight_portal *p) {
    p->blocked = SL_NO_CELL;
    for (unsigned side = 0; side < 2; side++) {
        const uint32_t number = base->portals[p->portal].cell[side];
        const sl_cell *cell = &base->cells[number];
        for (uint32_t k = cell->first_directed; k < cell->first_directed + cell->directed_count;
             k++) {
            if (base->directed[k].portal != p->portal || !sli_portal_is_blocked(base, number, k))
                continue;
            p->sealed = p->blocked != SL_NO_CELL;
            p->blocked = k;
        }
    }
    if (p->sealed) p->blocked = SL_NO_CELL;
}

static sl_status find_specials(sl_context *context, sli_sight_space *s) {
    const sl_space *base = s->base;
    s->portals = sl_alloc_array(context, count_specials(base), sizeof *s->portals);
    if (!s->portals) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < base->seam_portal_count; i++) {
        const sl_seam_portal *on = &base->seam_portals[i];
        const bool again = s->portal_count && s->portals[s->portal_count - 1].portal == on->portal;
        if (!is_special(base, on) || again) continue;
        sli_sight_portal *p = &s->portals[s->portal_count];
        *p = (sli_sight_portal){.portal = on->portal, .dark = SL_NO_CELL};
        p->door = base->wall_count + s->portal_count++;
        find_blocked(base, p);
        s->dark_count += p->blocked != SL_NO_CELL;
    }
    uint32_t dark = base->wall_count + s->portal_count;
    for (uint32_t i = 0; i < s->portal_count; i++)
        if (s->portals[i].blocked != SL_NO_CELL) s->portals[i].dark = dark++;
    return SL_OK;
}

static sli_sight_portal *special_at(const sli_sight_space *s, uint32_t portal) {
    uint32_t low = 0, high = s->portal_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (s->portals[middle].portal < portal)
            low = middle + 1;
        else
            high = middle;
    }
    return low < s->portal_count && s->portals[low].portal == portal ? &s->portals[low] : NULL;
}

/// Lists the portals of each door.
static sl_status list_doors(sl_context *context, sli_sight_space *s, size_t door_count) {
    const sl_space *base = s->base;
    s->first_of_door = sl_alloc_array(context, door_count + 2, sizeof *s->first_of_door);
    s->of_door = sl_alloc_array(context, base->seam_portal_count, sizeof *s->of_door);
    if (!s->first_of_door || !s->of_door) return SL_NO_MEMORY;
    // Counted two places on, so that filling leaves each door's first in its place.
    uint32_t *next = s->first_of_door + 1;
    for (uint32_t i = 0; i < base->seam_portal_count; i++) {
        const sl_seam *seam = &base->seams[base->seam_portals[i].seam];
        if (seam->kind == SL_SEAM_DOOR && seam->number + 1 < door_count) next[seam->number + 1]++;
    }
    for (size_t d = 1; d < door_count; d++) next[d] += next[d - 1];
    for (uint32_t i = 0; i < base->seam_portal_count; i++) {
        const sl_seam *seam = &base->seams[base->seam_portals[i].seam];
        if (seam->kind != SL_SEAM_DOOR) continue;
        const sli_sight_portal *p = special_at(s, base->seam_portals[i].portal);
        s->of_door[next[seam->number]++] = (uint32_t)(p - s->portals);
    }
    return SL_OK;
}

// --- the cells

static bool is_barred(const sli_sight_portal *p, uint32_t directed) {
    return p && (p->shut || p->blocked == directed);
}

/// The wall in place of a directed portal that is barred, as its cell's neighbour.
static uint32_t wall_of(const sli_sight_space *s, const sli_sight_portal *p, uint32_t cell) {
    if (!p->shut) return p->dark;
    return p->door | (s->base->portals[p->portal].cell[0] == cell ? 0 : SL_NEIGHBOUR_RIGHT);
}

/// Writes a cell as its portals stand.
static void write_cell(sli_sight_space *s, uint32_t number) {
    const sl_cell *from = &s->base->cells[number];
    sl_cell *to = &s->space.cells[number];
    to->directed_count = 0;
    for (uint32_t k = from->first_directed; k < from->first_directed + from->directed_count; k++) {
        const sl_directed_portal *directed = &s->base->directed[k];
        if (!is_barred(special_at(s, directed->portal), k))
            s->space.directed[to->first_directed + to->directed_count++] = *directed;
    }
    if (!s->base->neighbour) return;
    uint32_t k = from->first_directed;
    for (uint32_t i = from->first_vertex; i < from->first_vertex + from->vertex_count; i++) {
        if (s->base->neighbour[i] != SL_NEIGHBOUR_PORTAL) continue;
        const sli_sight_portal *p = special_at(s, s->base->directed[k].portal);
        s->space.neighbour[i] = is_barred(p, k) ? wall_of(s, p, number) : SL_NEIGHBOUR_PORTAL;
        k++;
    }
}

static void write_cells(sli_sight_space *s, const sli_sight_portal *p) {
    for (unsigned side = 0; side < 2; side++) write_cell(s, s->base->portals[p->portal].cell[side]);
}

/// Puts the walls of a portal where they are walls now: the door's from right to left as crossed
/// from cell[0], glass with the dark side at its left. A wall that does not stand has no length, at
/// the end of another one: for who reads all walls, it is not there.
static void stand_walls(sli_sight_space *s, const sli_sight_portal *p) {
    const sl_space *base = s->base;
    const sl_portal *at = &base->portals[p->portal];
    const sl_point none = base->wall_count ? base->walls[0].a : at->right;
    sl_wall *walls = s->space.walls;
    walls[p->door] = (sl_wall){.a = p->shut ? at->right : none, .b = p->shut ? at->left : none};
    if (p->dark == SL_NO_CELL) return;
    const sl_directed_portal *directed = &base->directed[p->blocked];
    walls[p->dark] =
        (sl_wall){.a = p->shut ? none : directed->right, .b = p->shut ? none : directed->left};
}

static sl_status copy_changing(sl_context *context, sli_sight_space *s) {
    const sl_space *b = s->base;
    sl_space *to = &s->space;
    s->own = true;
    to->neighbour = NULL;
    to->cells = sl_alloc_array(context, b->cell_count, sizeof *to->cells);
    to->directed = sl_alloc_array(context, b->directed_count, sizeof *to->directed);
    to->walls = sl_alloc_array(context, (size_t)b->wall_count + s->portal_count + s->dark_count,
                               sizeof *to->walls);
    if (b->neighbour)
        to->neighbour = sl_alloc_array(context, b->vertex_count, sizeof *to->neighbour);
    if (!to->cells || !to->directed || !to->walls || (b->neighbour && !to->neighbour))
        return SL_NO_MEMORY;
    if (b->cell_count) memcpy(to->cells, b->cells, b->cell_count * sizeof *to->cells);
    if (b->directed_count)
        memcpy(to->directed, b->directed, b->directed_count * sizeof *to->directed);
    if (b->wall_count) memcpy(to->walls, b->walls, b->wall_count * sizeof *to->walls);
    if (b->neighbour) memcpy(to->neighbour, b->neighbour, b->vertex_count * sizeof *to->neighbour);
    return SL_OK;
}

static sl_status make(sl_context *context, sli_sight_space *s, const bool *shut,
                      size_t door_count) {
    if (!count_specials(s->base)) return SL_OK;
    SL_TRY(find_specials(context, s));
    SL_TRY(list_doors(context, s, door_count));
    SL_TRY(copy_changing(context, s));
    s->space.wall_count += s->portal_count + s->dark_count;
    for (uint32_t i = 0; i < s->portal_count; i++) {
        sli_sight_portal *p = &s->portals[i];
        p->shut = p->sealed || is_shut(s->base, p->portal, shut);
        stand_walls(s, p);
        if (p->shut || p->blocked != SL_NO_CELL) write_cells(s, p);
    }
    return SL_OK;
}

sl_status sli_sight_space_make(sl_context *context, const sl_space *base, const bool *shut,
                               size_t door_count, sli_sight_space *out) {
    *out = (sli_sight_space){.base = base, .space = *base};
    const sl_status status = make(context, out, shut, door_count);
    if (status != SL_OK) sli_sight_space_destroy(context, out);
    return status;
}

void sli_sight_space_destroy(sl_context *context, sli_sight_space *s) {
    sli_outline_destroy(context, &s->outline);
    if (s->own) {
        sl_free(context, s->space.cells);
        sl_free(context, s->space.directed);
        sl_free(context, s->space.walls);
        sl_free(context, s->space.neighbour);
    }
    sl_free(context, s->portals);
    sl_free(context, s->first_of_door);
    sl_free(context, s->of_door);
    *s = (sli_sight_space){0};
}

// --- the outline

/// Links the two sides of a portal as it stands.
static void link_sides(sli_sight_space *s, const sli_sight_portal *p) {
    sl_side *sides = s->outline.sides;
    sides[p->sides[0]].neighbour = p->shut ? SL_SIDE_WALL + p->door : p->sides[1];
    sides[p->sides[1]].neighbour = p->shut ? SL_SIDE_WALL + p->door : p->sides[0];
    if (p->dark == SL_NO_CELL || p->shut) return;
    const uint32_t cell = s->base->directed[p->blocked].cell; // on the lit side
    const unsigned dark = s->base->portals[p->portal].cell[0] == cell ? 1 : 0;
    sides[p->sides[dark]].neighbour = SL_SIDE_WALL + p->dark;
    s->outline.lit[p->dark - s->outline.first_dark] = p->sides[1 - dark];
}

/// Finds the two sides of each portal, while all are walls.
static sl_status find_sides(sl_context *context, sli_sight_space *s) {
    const sl_outline *o = &s->outline;
    const uint32_t first = SL_SIDE_WALL + s->base->wall_count;
    for (uint32_t i = 0; i < s->portal_count; i++)
        s->portals[i].sides[0] = s->portals[i].sides[1] = SL_NO_CELL;
    for (uint32_t i = 0; i < o->side_count; i++) {
        const sl_side *side = &o->sides[i];
        if (side->neighbour < first || side->neighbour >= SL_SIDE_BORDER) continue;
        sli_sight_portal *p = &s->portals[side->neighbour - first];
        p->sides[sli_same_point(side->start, s->base->portals[p->portal].right) ? 0 : 1] = i;
    }
    for (uint32_t i = 0; i < s->portal_count; i++)
        if (s->portals[i].sides[0] == SL_NO_CELL || s->portals[i].sides[1] == SL_NO_CELL)
            return sl_fail(context, SL_BAD_ARGUMENT, "portal %u has not two sides",
                           s->portals[i].portal);
    return SL_OK;
}

/// Copies the outline of a base that lives: its rooms are cells, and its sides are in their order.
static sl_status copy_given(sl_context *context, sli_sight_space *s) {
    const sl_space *base = s->base;
    sl_outline *o = &s->outline;
    const size_t rooms = s->given->room_count, sides = s->given->side_count;
    o->sides = sl_alloc_array(context, sides, sizeof *o->sides);
    o->first = sl_alloc_array(context, rooms + 1, sizeof *o->first);
    o->first_part = sl_alloc_array(context, (size_t)base->cell_count + 1, sizeof *o->first_part);
    o->parts = sl_alloc_array(context, base->cell_count, sizeof *o->parts);
    if (!o->sides || !o->first || !o->first_part || !o->parts) return SL_NO_MEMORY;
    memcpy(o->sides, s->given->sides, sides * sizeof *o->sides);
    memcpy(o->first, s->given->first, (rooms + 1) * sizeof *o->first);
    memcpy(o->first_part, s->given->first_part,
           ((size_t)base->cell_count + 1) * sizeof *o->first_part);
    memcpy(o->parts, s->given->parts, base->cell_count * sizeof *o->parts);
    if (s->given->limited) {
        o->limited = sl_alloc_array(context, sides, sizeof *o->limited);
        if (!o->limited) return SL_NO_MEMORY;
        memcpy(o->limited, s->given->limited, sides * sizeof *o->limited);
    }
    o->side_count = s->given->side_count;
    o->room_count = s->given->room_count;
    o->room_of = s->given->room_of;
    for (uint32_t i = 0; i < s->portal_count; i++)
        for (unsigned side = 0; side < 2; side++) {
            const sl_cell *cell = &base->cells[base->portals[s->portals[i].portal].cell[side]];
            uint32_t at = cell->first_directed, place = cell->first_vertex;
            for (;; place++) {
                if (base->neighbour[place] != SL_NEIGHBOUR_PORTAL) continue;
                if (base->directed[at++].portal == s->portals[i].portal) break;
            }
            s->portals[i].sides[side] = place;
        }
    return SL_OK;
}

static sl_status make_walled(sl_context *context, sli_sight_space *s) {
    sl_outline *o = &s->outline;
    uint32_t *portals = sl_alloc_array(context, s->portal_count, sizeof *portals);
    if (!portals) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->portal_count; i++) portals[i] = s->portals[i].portal;
    sl_status status = sli_outline_make_walled(context, s->base, portals, s->portal_count, o);
    sl_free(context, portals);
    return status == SL_OK ? find_sides(context, s) : status;
}

static sl_status make_outline(sl_context *context, sli_sight_space *s) {
    sl_outline *o = &s->outline;
    SL_TRY(s->given ? copy_given(context, s) : make_walled(context, s));
    o->space = &s->space;
    if (!s->dark_count) return SL_OK;
    o->first_dark = s->base->wall_count + s->portal_count;
    o->lit = sl_alloc_array(context, s->dark_count, sizeof *o->lit);
    return o->lit ? SL_OK : SL_NO_MEMORY;
}

sl_status sli_sight_space_outline(sl_context *context, sli_sight_space *s, const sl_outline **out) {
    *out = s->given && !s->portal_count ? s->given : &s->outline;
    if ((*out)->sides) return SL_OK;
    const sl_status status = make_outline(context, s);
    if (status != SL_OK) sli_outline_destroy(context, &s->outline);
    for (uint32_t i = 0; i < s->portal_count && status == SL_OK; i++) link_sides(s, &s->portals[i]);
    return status;
}

// --- changes

void sli_sight_space_set_door(sli_sight_space *s, size_t door, const bool *shut) {
    if (!s->portal_count) return;
    for (uint32_t i = s->first_of_door[door]; i < s->first_of_door[door + 1]; i++) {
        sli_sight_portal *p = &s->portals[s->of_door[i]];
        p->shut = p->sealed || is_shut(s->base, p->portal, shut);
        stand_walls(s, p);
        write_cells(s, p);
        if (s->outline.sides) link_sides(s, p);
    }
}
