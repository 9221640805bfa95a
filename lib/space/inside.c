/// What is solid and what is inside: decided here and nowhere else, in the order that sl_space
/// gives.
///
/// The map says what the ground beside its walls is. A cell beside such a wall takes that ground,
/// and all cells that portals connect with it have the same:
///
///     #########=============        = wall, solid ground on the side of the #
///     ########:#######:    |
///     ########:#######:    |        : portal between cells; the ground is the same across
///     =================    |
///
/// Where solid ground reaches open ground, a door or the only start, the map contradicts itself. If
/// a reader had guessed the ground, the region is open then. Else the map is refused. Then starts,
/// or the border, decide what of the rest is inside. No coordinate is computed, so all is exact.
/// Time: linear in cells, portals and marked walls, times the depth of a kd-tree.
#include "space/kd_tree.h"

#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>

typedef struct inside {
    sl_context *context;
    const sl_map *map;
    const sli_piece *pieces; ///< the walls of a kd-tree by line
    sl_space *space;
    uint32_t *solid_by; ///< by cell: 1 + a wall that says solid, 0 for none
    uint32_t *open_by;  ///< by cell: 1 + a wall that says open, 0 for none
    uint32_t *stack;    ///< cells
} inside;

static const char *source_of(const inside *m) {
    return m->map->source ? m->map->source : "the map";
}

// --- the ground that walls say

/// Notes what a wall says of a cell at its left or right.
static void say(inside *m, uint32_t cell, uint32_t wall, bool left) {
    const uint32_t ground = m->space->walls[wall].ground;
    if (ground & (left ? SL_SOLID_LEFT : SL_SOLID_RIGHT)) m->solid_by[cell] = wall + 1;
    if (ground & (left ? SL_OPEN_LEFT : SL_OPEN_RIGHT)) m->open_by[cell] = wall + 1;
}

/// The cells of a mesh know the walls at their sides.
static void say_mesh(inside *m) {
    const sl_space *s = m->space;
    for (uint32_t i = 0; i < s->cell_count; i++)
        for (uint32_t k = 0; k < s->cells[i].vertex_count; k++) {
            const uint32_t next = s->neighbour[s->cells[i].first_vertex + k];
            if (next == SL_NEIGHBOUR_PORTAL || next == SL_NEIGHBOUR_BORDER) continue;
            say(m, i, next & ~SL_NEIGHBOUR_RIGHT, !(next & SL_NEIGHBOUR_RIGHT));
        }
}

/// Whether the side of greater coordinates across an axial wall is at its left.
static bool is_left(const sl_wall *w, bool above) {
    return (above == (sli_compare_points(w->a, w->b) < 0)) != (w->a.x == w->b.x);
}

/// Finds the cells along one side of a wall, from the root of the kd-tree down. `above` is the side
/// of greater coordinates across the wall.
static void say_down(inside *m, uint32_t wall, bool above) {
    const sl_space *s = m->space;
    const sl_wall *w = &s->walls[wall];
    const bool upright = w->a.x == w->b.x, rising = sli_compare_points(w->a, w->b) < 0;
    const sl_point low = rising ? w->a : w->b, high = rising ? w->b : w->a;
    int32_t *stack = (int32_t *)m->stack; // never more than the tree is deep, plus one
    size_t count = 0;
    const double at = upright ? low.x : low.y;
    const double border = upright ? (above ? s->bounds.max.x : s->bounds.min.x)
                                  : (above ? s->bounds.max.y : s->bounds.min.y);
    if (at == border) return; // no cell is there
    stack[count++] = s->root;
    while (count) {
        const int32_t next = stack[--count];
        if (next < 0) {
            say(m, (uint32_t)~next, wall, is_left(w, above));
            continue;
        }
        const sl_node *node = &s->nodes[next];
        if ((node->axis == 0) == upright) {
            const bool up = node->position != at ? node->position < at : above;
            stack[count++] = up ? node->above : node->below;
            continue;
        }
        if ((upright ? high.y : high.x) > node->position) stack[count++] = node->above;
        if ((upright ? low.y : low.x) < node->position) stack[count++] = node->below;
    }
}

/// A cell along one side of an axial wall; SL_NO_CELL beyond the bounds.
static uint32_t cell_beside(const sl_space *s, const sl_wall *w, bool above) {
    const bool upright = w->a.x == w->b.x;
    const double at = upright ? w->a.x : w->a.y;
    const double high = upright ? fmax(w->a.y, w->b.y) : fmax(w->a.x, w->b.x);
    const sl_point corner = above ? s->bounds.max : s->bounds.min;
    if (at == (upright ? corner.x : corner.y)) return SL_NO_CELL;
    int32_t next = s->root;
    while (next >= 0) {
        const sl_node *node = &s->nodes[next];
        const bool across = (node->axis == 0) == upright;
        const bool up =
            across ? (node->position != at ? node->position < at : above) : high > node->position;
        next = up ? node->above : node->below;
    }
    return (uint32_t)~next;
}

void sli_ground_of_cells(sl_space *s) {
    for (uint32_t i = 0; i < s->cell_count && s->neighbour; i++)
        for (uint32_t k = 0; k < s->cells[i].vertex_count && s->cells[i].solid; k++) {
            const uint32_t next = s->neighbour[s->cells[i].first_vertex + k];
            if (next == SL_NEIGHBOUR_PORTAL || next == SL_NEIGHBOUR_BORDER) continue;
            s->walls[next & ~SL_NEIGHBOUR_RIGHT].ground |=
                next & SL_NEIGHBOUR_RIGHT ? SL_SOLID_RIGHT : SL_SOLID_LEFT;
        }
    for (uint32_t i = 0; i < s->wall_count && !s->neighbour && !s->loose; i++)
        for (int above = 0; above < 2; above++) {
            sl_wall *w = &s->walls[i];
            const uint32_t cell = cell_beside(s, w, above);
            if (cell == SL_NO_CELL || !s->cells[cell].solid) continue;
            w->ground |= is_left(w, above) ? SL_SOLID_LEFT : SL_SOLID_RIGHT;
        }
    for (uint32_t i = 0; i < s->wall_count; i++) {
        const uint32_t ground = s->walls[i].ground;
        if (ground == SL_SOLID_LEFT) s->walls[i].ground |= SL_OPEN_RIGHT;
        if (ground == SL_SOLID_RIGHT) s->walls[i].ground |= SL_OPEN_LEFT;
    }
}

static bool say_all(inside *m) {
    bool any = false;
    for (uint32_t i = 0; i < m->space->wall_count; i++) any |= m->space->walls[i].ground != 0;
    if (!any || m->space->neighbour) {
        if (any) say_mesh(m);
        return any;
    }
    for (uint32_t i = 0; i < m->space->wall_count; i++) {
        const uint32_t ground = m->space->walls[i].ground;
        if (!ground) continue;
        say_down(m, i, true);
        say_down(m, i, false);
    }
    return any;
}

// --- solid ground

/// Gives all cells that portals connect with those on the stack a value that is not 0.
static void flood(const inside *m, uint32_t *values, size_t count) {
    const sl_space *s = m->space;
    while (count) {
        const uint32_t at = m->stack[--count];
        const sl_cell *cell = &s->cells[at];
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const uint32_t next = s->directed[cell->first_directed + i].cell;
            if (values[next]) continue;
            values[next] = values[at];
            m->stack[count++] = next;
        }
    }
}

/// Makes the region of a cell open, where a reader had guessed that it is solid.
static void reopen(const inside *m, uint32_t cell) {
    size_t count = 0;
    m->solid_by[cell] = 0;
    for (m->stack[count++] = cell; count;) {
        const sl_cell *c = &m->space->cells[m->stack[--count]];
        for (uint32_t i = 0; i < c->directed_count; i++) {
            const uint32_t next = m->space->directed[c->first_directed + i].cell;
            if (!m->solid_by[next]) continue;
            m->solid_by[next] = 0;
            m->stack[count++] = next;
        }
    }
}

/// " (line 3)", the line of the wall that makes a cell solid.
static const char *by_line(const inside *m, uint32_t cell, char text[32]) {
    const uint32_t line = m->space->walls[m->solid_by[cell] - 1].line;
    text[0] = '\0';
    if (line) snprintf(text, 32, " (line %u)", (unsigned)line);
    return text;
}

/// Open ground that solid ground reaches.
static sl_status settle_open(inside *m, size_t *reopened) {
    char by[32];
    for (uint32_t i = 0; i < m->space->cell_count; i++) {
        if (!m->solid_by[i] || !m->open_by[i]) continue;
        if (!m->map->ground_guessed) {
            const sl_wall *wall = &m->space->walls[m->open_by[i] - 1];
            return sl_fail_at(
                m->context, source_of(m), wall->line,
                "open ground at the wall from %.9g %.9g to %.9g %.9g is also solid "
                "ground%s: an open polygon may not overlap another polygon; make one of both",
                wall->a.x, wall->a.y, wall->b.x, wall->b.y, by_line(m, i, by));
        }
        reopen(m, i);
        ++*reopened;
    }
    return SL_OK;
}

/// A door whose both sides are solid ground.
static sl_status settle_doors(inside *m, size_t *reopened) {
    char by[32];
    for (uint32_t i = 0; i < m->space->seam_portal_count; i++) {
        const sl_seam_portal *at = &m->space->seam_portals[i];
        const sl_seam *seam = &m->space->seams[at->seam];
        const uint32_t cell = m->space->portals[at->portal].cell[0];
        if (seam->kind != SL_SEAM_DOOR || !m->solid_by[cell]) continue;
        const sl_door *door = &m->map->doors[seam->number];
        if (!m->map->ground_guessed)
            return sl_fail_at(m->context, source_of(m), door->line,
                              "door %s stands in solid ground%s: move the door, or cut an opening "
                              "into the solid ground",
                              door->name, by_line(m, cell, by));
        reopen(m, cell);
        ++*reopened;
    }
    return SL_OK;
}

// --- starts

/// Whether a point is in a cell or on its border.
static bool holds(const sl_space *space, uint32_t number, sl_point point) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = space->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        if (sli_orient(corners[i], corners[i + 1 < cell->vertex_count ? i + 1 : 0], point) < 0)
            return false;
    return true;
}

/// The cell of a start; one that is not solid where the start is on the border of several.
static uint32_t cell_of_start(const inside *m, sl_point at) {
    const uint32_t cell = sl_space_locate(m->space, at);
    if (cell == SL_NO_CELL || !m->solid_by[cell]) return cell;
    for (uint32_t i = 0; i < m->space->cell_count; i++)
        if (!m->solid_by[i] && holds(m->space, i, at)) return i;
    return cell;
}

/// Says that a start is left out, and why.
static void note_start(const inside *m, const sl_start *start, const char *where) {
    char line[16] = "";
    if (start->line) snprintf(line, sizeof line, ":%u", (unsigned)start->line);
    sl_note(m->context, "%s%s: the start at %.9g %.9g is %s; it is left out", source_of(m), line,
            start->at.x, start->at.y, where);
}

/// Finds the cells of starts; SL_NO_CELL for those in solid ground or out of bounds. Fails if none
/// is left, and one of them is in solid ground.
static sl_status find_starts(inside *m, uint32_t *cells, size_t *reopened) {
    const sl_map *map = m->map;
    size_t solid = SIZE_MAX, good = 0;
    char by[32] = "";
    for (size_t i = 0; i < map->start_count; i++) {
        cells[i] = cell_of_start(m, map->starts[i].at);
        if (cells[i] == SL_NO_CELL) continue;
        if (m->solid_by[cells[i]] && map->ground_guessed) {
            reopen(m, cells[i]);
            ++*reopened;
        }
        good += !m->solid_by[cells[i]];
        if (!m->solid_by[cells[i]]) continue;
        if (solid == SIZE_MAX) by_line(m, cells[i], by);
        if (solid == SIZE_MAX) solid = i;
    }
    if (solid != SIZE_MAX && !good)
        return sl_fail_at(m->context, source_of(m), map->starts[solid].line,
                          "the start at %.9g %.9g is in solid ground%s: move it, or give another "
                          "one with --start X,Y",
                          map->starts[solid].at.x, map->starts[solid].at.y, by);
    for (size_t i = 0; i < map->start_count; i++) {
        const bool in_solid = cells[i] != SL_NO_CELL && m->solid_by[cells[i]];
        if (in_solid) cells[i] = SL_NO_CELL;
        if (cells[i] == SL_NO_CELL)
            note_start(m, &map->starts[i], in_solid ? "in solid ground" : "outside of the walls");
    }
    return SL_OK;
}

/// Puts the cells of starts on the stack.
static sl_status take_starts(inside *m, uint32_t *reached, size_t *count, size_t *reopened) {
    uint32_t *cells = sl_alloc_array(m->context, m->map->start_count, sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    const sl_status status = find_starts(m, cells, reopened);
    *count = 0;
    for (size_t i = 0; status == SL_OK && i < m->map->start_count; i++) {
        if (cells[i] == SL_NO_CELL || reached[cells[i]]) continue;
        reached[cells[i]] = 1;
        m->stack[(*count)++] = cells[i];
    }
    sl_free(m->context, cells);
    return status;
}

// --- the border

/// Whether the cell touches a part of the map's border that has no wall.
static bool open_to_border(const inside *m, const sl_cell *cell) {
    const sl_space *space = m->space;
    if (space->neighbour) {
        for (uint32_t i = 0; i < cell->vertex_count; i++)
            if (space->neighbour[cell->first_vertex + i] == SL_NEIGHBOUR_BORDER) return true;
        return false;
    }
    const sl_point min = space->vertices[cell->first_vertex];
    const sl_point max = space->vertices[cell->first_vertex + 2];
    const sl_box *b = &space->bounds;
    const sli_piece *walls = m->pieces;
    const size_t count = space->wall_count;
    return (min.x == b->min.x && !sli_wall_lines_cover(walls, count, 0, min.x, min.y, max.y)) ||
           (max.x == b->max.x && !sli_wall_lines_cover(walls, count, 0, max.x, min.y, max.y)) ||
           (min.y == b->min.y && !sli_wall_lines_cover(walls, count, 1, min.y, min.x, max.x)) ||
           (max.y == b->max.y && !sli_wall_lines_cover(walls, count, 1, max.y, min.x, max.x));
}

// --- all of it

static sl_status mark(inside *m, uint32_t *reached) {
    sl_space *s = m->space;
    size_t count = 0, reopened = 0;
    if (say_all(m)) {
        for (uint32_t i = 0; i < s->cell_count; i++)
            if (m->solid_by[i]) m->stack[count++] = i;
        flood(m, m->solid_by, count);
        SL_TRY(settle_open(m, &reopened));
        SL_TRY(settle_doors(m, &reopened));
    }
    SL_TRY(take_starts(m, reached, &count, &reopened));
    const bool from_starts = count > 0;
    for (uint32_t i = 0; i < s->cell_count && !from_starts; i++) {
        if (!open_to_border(m, &s->cells[i])) continue;
        reached[i] = 1;
        m->stack[count++] = i;
    }
    flood(m, reached, count);
    uint32_t solid = 0;
    s->inside_count = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        s->cells[i].solid = m->solid_by[i] != 0;
        s->cells[i].inside = !s->cells[i].solid && (reached[i] != 0) == from_starts;
        s->inside_count += s->cells[i].inside;
        solid += s->cells[i].solid;
    }
    if (reopened)
        sl_note(m->context,
                "%s: %zu regions behind one-sided walls are taken as open, as they hold a start, a "
                "door or the front of a wall",
                source_of(m), reopened);
    if (s->inside_count) return SL_OK;
    for (uint32_t i = 0; i < s->cell_count; i++) s->cells[i].inside = !s->cells[i].solid;
    s->inside_count = s->cell_count - solid;
    return SL_OK;
}

sl_status sli_mark_inside(sl_context *context, const sl_map *map, const sli_piece *walls,
                          sl_space *space) {
    const size_t cells = space->cell_count, room = cells + space->tree_depth + 2;
    inside m = {.context = context, .map = map, .pieces = walls, .space = space};
    uint32_t *reached = sl_alloc_array(context, cells, sizeof *reached);
    m.solid_by = sl_alloc_array(context, cells, sizeof *m.solid_by);
    m.open_by = sl_alloc_array(context, cells, sizeof *m.open_by);
    m.stack = sl_alloc_array(context, room, sizeof *m.stack);
    const bool done = reached && m.solid_by && m.open_by && m.stack;
    const sl_status status = done ? mark(&m, reached) : SL_NO_MEMORY;
    sl_free(context, reached);
    sl_free(context, m.solid_by);
    sl_free(context, m.open_by);
    sl_free(context, m.stack);
    return status;
}
