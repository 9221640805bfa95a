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
/// No wall may say anything of a hole in one polygon that another polygon covers. There, cells are
/// counted into polygons: how many more cover the left of a wall than its right is known of each
/// wall (SL_SOLID_BEGINS).
///
/// Where solid ground reaches open ground, a door or the only start, the map contradicts itself. If
/// a reader had guessed the ground, the region is open then. Else the map is refused. Then starts,
/// or the border, decide what of the rest is inside. No coordinate is computed, so all is exact.
/// Time: linear in cells, portals and marked walls, times the depth of a kd-tree.
#include "space/kd_tree.h"

#include "geometry/orient.h"
#include "map/ground.h"
#include "map/source.h"
#include "sightline/support.h"
#include "space/index.h"
#include "space/subdivide.h"
#include "space/walled.h"

#include <math.h>
#include <string.h>

/// What makes a cell solid: not a wall beside it, but polygons that cover it.
#define COVERED UINT32_MAX

typedef struct inside {
    sl_context *context;
    const sl_map *map;
    const sli_piece *pieces; ///< the walls of a kd-tree by line
    sl_space *space;
    uint32_t *solid_by; ///< by cell: 1 + a wall that says solid, 0 for none
    uint32_t *open_by;  ///< by cell: 1 + a wall that says open, 0 for none
    uint32_t *stack;    ///< cells
    uint32_t *beside;   ///< by wall: a cell at its left, and one at its right; SL_NO_CELL for none
    bool partial;       ///< some walls do not stop all
} inside;

// --- the ground that walls say

/// The ground of a wall that several polygons share. Two open ones, one on each side, say of each
/// other that it is solid: both are open. A solid one in an open one, along its side, is solid.
static uint32_t settled(uint32_t ground, bool guessed) {
    if (sli_ground_parts_rooms(ground)) return SL_OPEN_LEFT | SL_OPEN_RIGHT;
    if (guessed) return ground;
    if (ground & SL_SOLID_LEFT) ground &= ~(uint32_t)SL_OPEN_LEFT;
    if (ground & SL_SOLID_RIGHT) ground &= ~(uint32_t)SL_OPEN_RIGHT;
    return ground;
}

/// Notes what a wall says of a cell at its left or right.
static void say(inside *m, uint32_t cell, uint32_t wall, bool left) {
    const uint32_t ground = settled(m->space->walls[wall].ground, m->map->ground_guessed);
    const bool open = ground & (left ? SL_OPEN_LEFT : SL_OPEN_RIGHT);
    const bool solid = ground & (left ? SL_SOLID_LEFT : SL_SOLID_RIGHT);
    m->beside[2 * (size_t)wall + !left] = cell;
    if (open) m->open_by[cell] = wall + 1;
    // Two lines of a Doom map may lie back to back: each is in front of the other's void.
    if (solid && !(open && m->map->ground_guessed)) m->solid_by[cell] = wall + 1;
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

static void say_all(inside *m) {
    memset(m->beside, 0xff, 2 * (size_t)m->space->wall_count * sizeof *m->beside);
    if (m->space->neighbour) {
        say_mesh(m);
        return;
    }
    for (uint32_t i = 0; i < m->space->wall_count; i++) {
        say_down(m, i, true);
        say_down(m, i, false);
    }
}

// --- solid ground

/// Whether a portal lies on a door, or on another seam that may end what is inside.
static bool is_entrance(const inside *m, uint32_t portal) {
    size_t count;
    const sl_seam_portal *at = sl_space_seams_of(m->space, portal, &count);
    for (size_t i = 0; i < count; i++) {
        const sl_seam *seam = &m->space->seams[at[i].seam];
        if (seam->kind == SL_SEAM_DOOR ||
            (sli_is_map_seam(seam) && m->map->seams[seam->number].entrance))
            return true;
    }
    return false;
}

/// Where cells are connected.
typedef enum connection {
    BY_PORTALS, ///< through all portals
    BY_STEPS,   ///< but not through walls that stop steps
    INDOORS,    ///< nor through entrances
} connection;

static bool connects(const inside *m, connection by, uint32_t portal) {
    if (by == BY_PORTALS) return true;
    if (m->partial && sli_portal_stops(m->map, m->space, portal) & SL_STOPS_STEPS) return false;
    return by == BY_STEPS || !is_entrance(m, portal);
}

/// Gives all cells that are connected with those on the stack a value that is not 0.
static void flood(const inside *m, uint32_t *values, size_t count, connection by) {
    const sl_space *s = m->space;
    while (count) {
        const uint32_t at = m->stack[--count];
        const sl_cell *cell = &s->cells[at];
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const sl_directed_portal *way = &s->directed[cell->first_directed + i];
            const uint32_t next = way->cell;
            if (values[next] || !connects(m, by, way->portal)) continue;
            values[next] = values[at];
            m->stack[count++] = next;
        }
    }
}

/// Puts all cells that have a value on the stack.
static size_t take(const inside *m, const uint32_t *values) {
    size_t count = 0;
    for (uint32_t i = 0; i < m->space->cell_count; i++)
        if (values[i]) m->stack[count++] = i;
    return count;
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

enum { BY_TEXT = SL_LINE_TEXT + 4 };

/// " (line 3)", the line of the wall that makes a cell solid.
static const char *by_line(const inside *m, uint32_t cell, char text[BY_TEXT]) {
    char line[SL_LINE_TEXT];
    text[0] = '\0';
    if (m->solid_by[cell] == COVERED) return text;
    sl_map_say_line(m->map, m->space->walls[m->solid_by[cell] - 1].line, line);
    if (line[0]) snprintf(text, BY_TEXT, " (%s)", line);
    return text;
}

/// Open ground that solid ground reaches.
static sl_status settle_open(inside *m, size_t *reopened) {
    char by[BY_TEXT];
    for (uint32_t i = 0; i < m->space->cell_count; i++) {
        if (!m->solid_by[i] || !m->open_by[i]) continue;
        if (!m->map->ground_guessed) {
            const sl_wall *wall = &m->space->walls[m->open_by[i] - 1];
            return sli_map_fail(
                m->context, m->map, SL_BAD_INPUT, wall->line,
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
    char by[BY_TEXT];
    for (uint32_t i = 0; i < m->space->seam_portal_count; i++) {
        const sl_seam_portal *at = &m->space->seam_portals[i];
        const sl_seam *seam = &m->space->seams[at->seam];
        const uint32_t cell = m->space->portals[at->portal].cell[0];
        if (seam->kind != SL_SEAM_DOOR || !m->solid_by[cell]) continue;
        const sl_door *door = &m->map->doors[seam->number];
        if (!m->map->ground_guessed)
            return sli_map_fail(
                m->context, m->map, SL_BAD_INPUT, door->line,
                "door %s stands in solid ground%s: move the door, or cut an opening "
                "into the solid ground",
                door->name, by_line(m, cell, by));
        reopen(m, cell);
        ++*reopened;
    }
    return SL_OK;
}

// --- starts

/// The cell of a start; one that is not solid where the start is on the border of several.
static uint32_t cell_of_start(const inside *m, sl_point at) {
    const uint32_t cell = sl_space_locate(m->space, at);
    if (cell == SL_NO_CELL || !m->solid_by[cell]) return cell;
    for (uint32_t i = 0; i < m->space->cell_count; i++)
        if (!m->solid_by[i] && sli_cell_holds(m->space, i, at)) return i;
    return cell;
}

/// Says that a start is left out, and why.
static void note_start(const inside *m, const sl_start *start, const char *where) {
    char line[SL_LINE_TEXT];
    sl_map_say_line(m->map, start->line, line);
    sl_note(m->context, "%s%s%s: the start at %.9g %.9g is %s; it is left out",
            sli_map_name(m->map), line[0] ? ": " : "", line, start->at.x, start->at.y, where);
}

/// Finds the cells of starts; SL_NO_CELL for those in solid ground or out of bounds. Fails if none
/// is left, and one of them is in solid ground.
static sl_status find_starts(inside *m, uint32_t *cells, size_t *reopened) {
    const sl_map *map = m->map;
    size_t solid = SIZE_MAX, good = 0;
    char by[BY_TEXT] = "";
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
        return sli_map_fail(m->context, map, SL_BAD_INPUT, map->starts[solid].line,
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

// --- what polygons cover

/// How often solid polygons cover each cell. A portal changes nothing, and a wall what its ground
/// says. So all is known but for a constant: a union-find of cells, each with the difference to its
/// parent. The last member is what lies beyond the bounds.
typedef struct cover {
    uint32_t *parent;
    int32_t *more; ///< than the parent
    uint32_t *size;
} cover;

static uint32_t find_root(const cover *c, uint32_t at, int32_t *more) {
    for (*more = 0; c->parent[at] != at; at = c->parent[at]) *more += c->more[at];
    return at;
}

/// `a` is covered `more` times more than `b`; false where it is known to be otherwise.
static bool join(cover *c, uint32_t a, uint32_t b, int32_t more) {
    int32_t of_a, of_b;
    const uint32_t root_a = find_root(c, a, &of_a), root_b = find_root(c, b, &of_b);
    if (root_a == root_b) return of_a == of_b + more;
    const bool under_b = c->size[root_a] < c->size[root_b];
    const uint32_t root = under_b ? root_b : root_a, child = under_b ? root_a : root_b;
    c->more[child] = under_b ? of_b + more - of_a : of_a - more - of_b;
    c->parent[child] = root;
    c->size[root] += c->size[child];
    return true;
}

/// False where walls contradict each other, as single marked walls do that make no loop.
static bool join_all(const inside *m, cover *c) {
    const sl_space *s = m->space;
    const uint32_t beyond = s->cell_count;
    bool sound = true;
    for (uint32_t i = 0; i <= beyond; i++) {
        c->parent[i] = i;
        c->size[i] = 1;
    }
    for (uint32_t i = 0; i < s->portal_count && sound; i++)
        sound = join(c, s->portals[i].cell[0], s->portals[i].cell[1], 0);
    for (uint32_t i = 0; i < s->wall_count && sound; i++) {
        const uint32_t *beside = &m->beside[2 * (size_t)i];
        sound = join(c, beside[0] == SL_NO_CELL ? beyond : beside[0],
                     beside[1] == SL_NO_CELL ? beyond : beside[1],
                     sli_ground_begins(s->walls[i].ground));
    }
    for (uint32_t i = 0; i < beyond && sound; i++)
        if (open_to_border(m, &s->cells[i])) sound = join(c, i, beyond, 0);
    return sound;
}

/// Whether a wall on the border says that it is solid beyond.
static bool solid_beyond(const inside *m) {
    for (uint32_t i = 0; i < m->space->wall_count; i++) {
        const uint32_t ground = m->space->walls[i].ground, *beside = &m->beside[2 * (size_t)i];
        if ((beside[0] == SL_NO_CELL && ground & SL_SOLID_LEFT) ||
            (beside[1] == SL_NO_CELL && ground & SL_SOLID_RIGHT))
            return true;
    }
    return false;
}

/// Makes solid what no wall says anything of, and what is covered more often than the least covered
/// place is.
static void fill(const inside *m, const cover *c) {
    const uint32_t beyond = m->space->cell_count;
    int32_t least, most, more;
    const uint32_t root = find_root(c, beyond, &least);
    if (solid_beyond(m)) least--;
    most = least;
    for (uint32_t i = 0; i < beyond; i++) {
        if (find_root(c, i, &more) != root) return;
        if (more < least) least = more;
        if (more > most) most = more;
    }
    for (uint32_t i = 0; i < beyond && most > least; i++) {
        find_root(c, i, &more);
        if (more > least && !m->solid_by[i] && !m->open_by[i]) m->solid_by[i] = COVERED;
    }
}

/// Ground in a polygon may have walls around it that say nothing of it: those of another polygon
/// with a hole, or plain ones.
static sl_status add_covered(const inside *m) {
    const sl_space *s = m->space;
    bool any = false, all_known = true;
    for (uint32_t i = 0; i < s->cell_count; i++) all_known &= m->solid_by[i] || m->open_by[i];
    for (uint32_t i = 0; i < s->wall_count; i++) any |= sli_ground_begins(s->walls[i].ground) != 0;
    if (all_known || !any || m->map->ground_guessed) return SL_OK;
    const size_t count = (size_t)s->cell_count + 1;
    cover c = {.parent = sl_alloc_array(m->context, count, sizeof *c.parent),
               .more = sl_alloc_array(m->context, count, sizeof *c.more),
               .size = sl_alloc_array(m->context, count, sizeof *c.size)};
    const bool done = c.parent && c.more && c.size;
    if (done && join_all(m, &c)) fill(m, &c);
    sl_free(m->context, c.parent);
    sl_free(m->context, c.more);
    sl_free(m->context, c.size);
    return done ? SL_OK : SL_NO_MEMORY;
}

// --- ground behind walls that do not stop all

/// Whether a portal is on the outline of ground that nobody steps on; then *cell is on this ground.
static bool is_shore(const inside *m, const sl_seam_portal *on, uint32_t *cell) {
    const sl_seam *seam = &m->space->seams[on->seam];
    if (!sli_is_map_seam(seam)) return false;
    const sl_glass *wall = &m->map->seams[seam->number];
    if (!(wall->stops & SL_STOPS_STEPS) || !(wall->ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT)))
        return false;
    const bool left = wall->ground & SL_SOLID_LEFT;
    *cell = m->space->portals[on->portal].cell[left == (on->forward != 0)];
    return true;
}

/// Takes water and the like out of what is inside: all within outlines that stop steps and have
/// solid ground on one side. `value`: what `reached` has where it is inside.
static sl_status leave_out_fenced(const inside *m, uint32_t *reached, bool value) {
    const sl_space *s = m->space;
    size_t count = 0;
    uint32_t cell;
    for (uint32_t i = 0; i < s->seam_portal_count; i++)
        count += is_shore(m, &s->seam_portals[i], &cell);
    if (!count) return SL_OK;
    uint32_t *fenced = sl_alloc_array(m->context, s->cell_count, sizeof *fenced);
    if (!fenced) return SL_NO_MEMORY;
    count = 0;
    for (uint32_t i = 0; i < s->seam_portal_count; i++) {
        if (!is_shore(m, &s->seam_portals[i], &cell) || fenced[cell]) continue;
        fenced[cell] = 1;
        m->stack[count++] = cell;
    }
    flood(m, fenced, count, BY_STEPS);
    bool left = false; // else a start is on such ground, or no outline closes it
    for (uint32_t i = 0; i < s->cell_count; i++)
        left |= !fenced[i] && !m->solid_by[i] && (reached[i] != 0) == value;
    for (uint32_t i = 0; i < s->cell_count && left; i++)
        if (fenced[i]) reached[i] = !value;
    sl_free(m->context, fenced);
    return SL_OK;
}

// --- all of it

static sl_status mark(inside *m, bool marked, uint32_t *reached) {
    sl_space *s = m->space;
    size_t count = 0, reopened = 0;
    if (marked) {
        say_all(m);
        flood(m, m->solid_by, take(m, m->solid_by), BY_PORTALS);
        flood(m, m->open_by, take(m, m->open_by), BY_PORTALS);
        SL_TRY(add_covered(m));
        SL_TRY(settle_open(m, &reopened));
        SL_TRY(settle_doors(m, &reopened));
    }
    SL_TRY(take_starts(m, reached, &count, &reopened));
    const sl_interior *found = &m->map->interior;
    const bool from_starts = count > 0, indoors = !from_starts && found->by != SL_ENTRANCE_NONE;
    for (size_t i = 0; i < found->place_count && indoors; i++) {
        const uint32_t cell = sl_space_locate(s, found->places[i]);
        if (cell == SL_NO_CELL || m->solid_by[cell] || reached[cell]) continue;
        reached[cell] = 1;
        m->stack[count++] = cell;
    }
    for (uint32_t i = 0; i < s->cell_count && !from_starts && !indoors; i++) {
        if (!open_to_border(m, &s->cells[i])) continue;
        reached[i] = 1;
        m->stack[count++] = i;
    }
    flood(m, reached, count, indoors ? INDOORS : BY_STEPS);
    if (m->partial) SL_TRY(leave_out_fenced(m, reached, from_starts || indoors));
    uint32_t solid = 0;
    s->inside_count = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        s->cells[i].solid = m->solid_by[i] != 0;
        s->cells[i].inside = !s->cells[i].solid && (reached[i] != 0) == (from_starts || indoors);
        s->inside_count += s->cells[i].inside;
        solid += s->cells[i].solid;
    }
    if (reopened)
        sl_note(m->context,
                "%s: %zu region%s behind one-sided walls hold%s a start, a door or the front of a "
                "wall: taken as open",
                sli_map_name(m->map), reopened, reopened == 1 ? "" : "s", reopened == 1 ? "s" : "");
    if (s->inside_count) return SL_OK;
    for (uint32_t i = 0; i < s->cell_count; i++) s->cells[i].inside = !s->cells[i].solid;
    s->inside_count = s->cell_count - solid;
    return SL_OK;
}

sl_status sli_mark_inside(sl_context *context, const sl_map *map, const sli_piece *walls,
                          sl_space *space) {
    const size_t cells = space->cell_count, room = cells + space->tree_depth + 2;
    inside m = {.context = context, .map = map, .pieces = walls, .space = space};
    bool marked = false;
    for (size_t i = 0; i < map->seam_count; i++) m.partial |= map->seams[i].stops != 0;
    for (uint32_t i = 0; i < space->wall_count; i++) marked |= space->walls[i].ground != 0;
    uint32_t *reached = sl_alloc_array(context, cells, sizeof *reached);
    m.solid_by = sl_alloc_array(context, cells, sizeof *m.solid_by);
    m.open_by = sl_alloc_array(context, marked ? cells : 0, sizeof *m.open_by);
    m.stack = sl_alloc_array(context, room, sizeof *m.stack);
    m.beside = sl_alloc_array(context, marked ? space->wall_count : 0, 2 * sizeof *m.beside);
    const bool done = reached && m.solid_by && m.open_by && m.stack && m.beside;
    const sl_status status = done ? mark(&m, marked, reached) : SL_NO_MEMORY;
    sl_free(context, reached);
    sl_free(context, m.solid_by);
    sl_free(context, m.open_by);
    sl_free(context, m.stack);
    sl_free(context, m.beside);
    return status;
}

// --- guesses made certain

/// Gives walls the ground that cells have. Says whether it differs from what the walls had said of
/// ground within the bounds.
static bool take_ground(sl_context *context, sl_space *space, bool *differs) {
    uint32_t *said = sl_alloc_array(context, space->wall_count, sizeof *said);
    if (!said) return false;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        said[i] = space->walls[i].ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT);
        space->walls[i].ground = 0;
    }
    sli_ground_of_cells(space);
    for (uint32_t i = 0; i < space->cell_count; i++)
        for (uint32_t k = 0; k < space->cells[i].vertex_count; k++) {
            const uint32_t next = space->neighbour[space->cells[i].first_vertex + k];
            if (next == SL_NEIGHBOUR_PORTAL || next == SL_NEIGHBOUR_BORDER) continue;
            const uint32_t side = next & SL_NEIGHBOUR_RIGHT ? SL_SOLID_RIGHT : SL_SOLID_LEFT;
            *differs |= (said[next & ~SL_NEIGHBOUR_RIGHT] & side) && !space->cells[i].solid;
        }
    sl_free(context, said);
    return true;
}

static sl_status settle(sl_context *context, sl_map *map, sl_map *copy, sl_space *space) {
    bool differs = false;
    SL_TRY(sl_map_copy(context, map, copy));
    SL_TRY(sl_map_clean(context, copy, NULL, NULL));
    SL_TRY(sli_subdivide_mesh(context, copy, space));
    if (!take_ground(context, space, &differs)) return SL_NO_MEMORY;
    if (!differs) return SL_OK;
    map->wall_count = 0;
    return sl_map_add_walls(context, map, space->walls, space->wall_count);
}

sl_status sl_map_settle_ground(sl_context *context, sl_map *map) {
    sl_map copy = {0};
    sl_space space = {0};
    if (!map->ground_guessed || !map->wall_count) return SL_OK;
    const sl_status status = settle(context, map, &copy, &space);
    sl_map_destroy(context, &copy);
    sl_space_destroy(context, &space);
    if (status == SL_OK) map->ground_guessed = false;
    return status;
}
