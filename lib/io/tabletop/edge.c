/// The edge of a scene, where eyes and steps end.
///
/// A dungeon is closed by its walls: what is inside they say by themselves, and what lies beyond
/// them is rock. A street, a wood or a ruin is open: there all of the scene is inside, up to its
/// edge. One scene may be both:
///
///     +------------------------+      the edge
///     |  rock   +----+   rock  |
///     +=========+    +---------+      the passage ends at the edge (=): a piece of the edge
///     #  passage   +    hall   |      closes it (#)
///     +=========+----+---------+
///
/// So the edge is laid around the walls, and the regions (regions.h) that meet it where no wall is
/// are *open*. With starts, the pieces are those of regions with starts. Without, an open region is
/// ground if doors lead to it, or if walls stand free in it. Others are rock if the scene has an
/// interior: closed regions, with doors or large. Where nothing tells, they are ground.
#include "geometry/length.h"
#include "io/parts/regions.h"
#include "io/tabletop/tabletop.h"
#include "map/source.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

/// The share of a scene that makes closed regions an interior.
#define INTERIOR 0.1
/// The share of the walls beside a region that stand free in it, from which on it is ground.
#define FREE 0.05

/// A stretch of one side of the edge, by the coordinate along it.
typedef struct stretch {
    double from, to;
} stretch;

typedef struct edge_search {
    sli_edge *edge;
    const sl_map *map;
    sli_regions regions;
    unsigned char *mark; ///< by region: bits of OPEN ...
    SL_ARRAY(stretch) covered, bare;
} edge_search;

enum { SIDES = 4 };
enum { OPEN = 1, GROUND = 2, BEYOND = 4 };

/// The sides, counter-clockwise from the lower one.
static sl_segment side_of(sl_box b, int side) {
    const sl_point corners[SIDES] = {
        {b.min.x, b.min.y}, {b.max.x, b.min.y}, {b.max.x, b.max.y}, {b.min.x, b.max.y}};
    return (sl_segment){corners[side], corners[(side + 1) % SIDES]};
}

static bool holds(sl_box box, sl_point at) {
    return at.x >= box.min.x && at.x <= box.max.x && at.y >= box.min.y && at.y <= box.max.y;
}

// --- whether the scene's size is right

static bool is_box(sl_box box) {
    return sl_coordinate_usable(box.min.x) && sl_coordinate_usable(box.min.y) &&
           sl_coordinate_usable(box.max.x) && sl_coordinate_usable(box.max.y) &&
           box.min.x < box.max.x && box.min.y < box.max.y;
}

static void count_ends(sl_box box, sl_segment at, size_t *in, size_t *all) {
    *in += (size_t)holds(box, at.a) + holds(box, at.b);
    *all += 2;
}

size_t sli_edge_holds(const sl_map *map, sl_box box, size_t *all) {
    size_t in = 0;
    *all = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        count_ends(box, (sl_segment){map->walls[i].a, map->walls[i].b}, &in, all);
    for (size_t i = 0; i < map->door_count; i++) count_ends(box, map->doors[i].segment, &in, all);
    for (size_t i = 0; i < map->oneway_count; i++)
        count_ends(box, map->oneways[i].segment, &in, all);
    for (size_t i = 0; i < map->seam_count; i++) count_ends(box, map->seams[i].segment, &in, all);
    return in;
}

// --- stretches

/// Whether a segment lies on this side, and the stretch of it.
static bool on_side(const edge_search *s, int side, sl_segment at, stretch *out) {
    const sl_segment line = side_of(s->edge->box, side);
    const double near = 2 * s->regions.tolerance;
    const bool level = side % 2 == 0;
    const double from = level ? at.a.x : at.a.y, to = level ? at.b.x : at.b.y;
    const double off_a = level ? at.a.y - line.a.y : at.a.x - line.a.x;
    const double off_b = level ? at.b.y - line.a.y : at.b.x - line.a.x;
    *out = (stretch){fmin(from, to), fmax(from, to)};
    return fabs(off_a) <= near && fabs(off_b) <= near;
}

static sl_status cover(edge_search *s, int side, sl_segment at) {
    stretch on;
    if (!on_side(s, side, at, &on)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(s->edge->context, &s->covered, 1));
    s->covered.items[s->covered.count++] = on;
    return SL_OK;
}

static int by_from(const void *left, const void *right) {
    const stretch *a = left, *b = right;
    return (a->from > b->from) - (a->from < b->from);
}

/// Joins stretches that meet; they are sorted then.
static void join(stretch *items, size_t *count, double near) {
    size_t kept = 0;
    if (*count) qsort(items, *count, sizeof *items, by_from);
    for (size_t i = 0; i < *count; i++) {
        if (kept && items[i].from <= items[kept - 1].to + near)
            items[kept - 1].to = fmax(items[kept - 1].to, items[i].to);
        else
            items[kept++] = items[i];
    }
    *count = kept;
}

/// The walls of the map that lie along a side.
static sl_status find_covered(edge_search *s, int side) {
    const sl_map *map = s->map;
    s->covered.count = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        SL_TRY(cover(s, side, (sl_segment){map->walls[i].a, map->walls[i].b}));
    for (size_t i = 0; i < map->mirror_count; i++) SL_TRY(cover(s, side, map->mirrors[i].segment));
    join(s->covered.items, &s->covered.count, 0);
    return SL_OK;
}

static bool is_covered(const edge_search *s, double at) {
    size_t low = 0, high = s->covered.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (s->covered.items[middle].to < at)
            low = middle + 1;
        else
            high = middle;
    }
    return low < s->covered.count && s->covered.items[low].from <= at;
}

/// Goes over the sides of cells in the scene that lie on a side of the edge where the map has no
/// wall: marks their regions as open, whose walls these are not; or gathers those of ground.
static sl_status walk_side(edge_search *s, int side, bool gathers) {
    const sl_space *space = &s->regions.space;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            const sl_point *at = space->vertices + cell->first_vertex;
            const sl_segment piece = {at[k], at[(k + 1) % cell->vertex_count]};
            stretch on;
            if (space->neighbour[cell->first_vertex + k] == SL_NEIGHBOUR_PORTAL ||
                !on_side(s, side, piece, &on) || is_covered(s, on.from / 2 + on.to / 2) ||
                !holds(s->edge->box, sli_cell_middle(space, i)))
                continue;
            s->mark[s->regions.region[i]] |= OPEN;
            if (!gathers) s->regions.items[s->regions.region[i]].beside -= on.to - on.from;
            if (!gathers || !(s->mark[s->regions.region[i]] & GROUND)) continue;
            SL_TRY(SL_ARRAY_ROOM(s->edge->context, &s->bare, 1));
            s->bare.items[s->bare.count++] = on;
        }
    }
    return SL_OK;
}

// --- which regions are ground

/// The region of a thing that is a start and is believed; SL_NO_CELL: it is none, or in none.
static uint32_t region_of_start(const edge_search *s, const sli_things *things, size_t i) {
    const sli_thing *start = &things->items.items[i];
    if (start->kind != SLI_THING_START || start->doubt) return SL_NO_CELL;
    return sli_regions_at(&s->regions, sli_thing_place(things, i));
}

/// Marks regions with starts that are believed; false for none.
static bool take_starts(edge_search *s, sli_things *things) {
    bool any = false;
    for (size_t i = 0; i < things->items.count; i++) {
        const uint32_t region = region_of_start(s, things, i);
        if (region == SL_NO_CELL) continue;
        s->mark[region] |= GROUND;
        any = true;
    }
    s->edge->started = any;
    return any;
}

static bool is_ground(const sli_region *region) {
    return region->doors || region->between > FREE * region->beside;
}

/// Tokens stand on one deck or storey of several that a scene has side by side: starts that reach
/// less than half of its ground are not believed.
static sl_status doubt_few(const edge_search *s, sli_things *things) {
    double reached = 0, all = 0;
    sl_bits *has = sl_alloc_array(s->edge->context, sl_bits_words(s->regions.count), sizeof *has);
    if (!has) return SL_NO_MEMORY;
    for (size_t i = 0; i < things->items.count; i++) {
        const uint32_t region = region_of_start(s, things, i);
        if (region != SL_NO_CELL) sl_bits_add(has, region);
    }
    for (size_t i = 0; i < s->regions.count; i++) {
        const double area = s->mark[i] & BEYOND ? 0 : s->regions.items[i].area;
        if (sl_bits_has(has, i)) reached += area;
        if (sl_bits_has(has, i) || is_ground(&s->regions.items[i])) all += area;
    }
    for (size_t i = 0; reached > 0 && 2 * reached < all && i < things->items.count; i++)
        if (things->items.items[i].kind == SLI_THING_START && !things->items.items[i].doubt)
            things->items.items[i].doubt = "starts reach less than half of the scene; "
                                           "--start-names takes it all the same";
    sl_free(s->edge->context, has);
    return SL_OK;
}

/// The area of closed regions that look as an interior does.
static double interior_of(const edge_search *s) {
    double sum = 0, largest = 0;
    for (size_t i = 0; i < s->regions.count; i++) {
        const sli_region *region = &s->regions.items[i];
        if (s->mark[i] & BEYOND || (s->mark[i] & OPEN && !(s->mark[i] & GROUND))) continue;
        if (region->doors) sum += region->area;
        largest = fmax(largest, region->area);
    }
    return sum + largest;
}

static void decide(edge_search *s, sli_things *things) {
    const sl_box box = s->edge->box;
    const double area = (box.max.x - box.min.x) * (box.max.y - box.min.y);
    if (take_starts(s, things)) return;
    for (size_t i = 0; i < s->regions.count; i++) {
        if (is_ground(&s->regions.items[i])) s->mark[i] |= GROUND;
    }
    if (interior_of(s) >= INTERIOR * area) return;
    for (size_t i = 0; i < s->regions.count; i++) s->mark[i] |= GROUND;
}

// --- the pieces

static sl_status add_piece(edge_search *s, int side, stretch on) {
    const sl_segment line = side_of(s->edge->box, side);
    const double near = 2 * s->regions.tolerance;
    const bool level = side % 2 == 0;
    const double low = level ? fmin(line.a.x, line.b.x) : fmin(line.a.y, line.b.y);
    const double high = level ? fmax(line.a.x, line.b.x) : fmax(line.a.y, line.b.y);
    if (on.from <= low + near) on.from = low;
    if (on.to >= high - near) on.to = high;
    if (!(on.from < on.to)) return SL_OK;
    s->edge->whole &= on.from == low && on.to == high;
    SL_TRY(SL_ARRAY_ROOM(s->edge->context, &s->edge->pieces, 1));
    s->edge->pieces.items[s->edge->pieces.count++] =
        level ? (sl_segment){{on.from, line.a.y}, {on.to, line.a.y}}
              : (sl_segment){{line.a.x, on.from}, {line.a.x, on.to}};
    return SL_OK;
}

static sl_status find_pieces(edge_search *s) {
    for (int side = 0; side < SIDES; side++) {
        s->bare.count = 0;
        SL_TRY(find_covered(s, side));
        SL_TRY(walk_side(s, side, true));
        join(s->bare.items, &s->bare.count, s->regions.tolerance);
        s->edge->whole &= s->bare.count > 0;
        for (size_t i = 0; i < s->bare.count; i++) SL_TRY(add_piece(s, side, s->bare.items[i]));
    }
    return SL_OK;
}

static void measure_rock(edge_search *s) {
    const sl_box box = s->edge->box;
    double rock = 0;
    for (size_t i = 0; i < s->regions.count; i++)
        if (s->mark[i] == OPEN) rock += s->regions.items[i].area;
    s->edge->closed_off = rock / ((box.max.x - box.min.x) * (box.max.y - box.min.y));
}

static void doubt_beyond(const sli_edge *edge, sli_things *things) {
    for (size_t i = 0; i < things->items.count && !things->options->start_names; i++)
        if (!holds(edge->box, sli_thing_place(things, i)))
            things->items.items[i].doubt = "it is beyond the scene's edge";
}

static sl_status search(edge_search *s, sli_things *things) {
    sl_segment sides[SIDES];
    for (int i = 0; i < SIDES; i++) sides[i] = side_of(s->edge->box, i);
    SL_TRY(sli_regions_make(s->edge->context, s->map, sides, SIDES, &s->regions));
    s->mark = sl_alloc_array(s->edge->context, s->regions.count, sizeof *s->mark);
    if (!s->mark) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->regions.space.cell_count; i++)
        if (!holds(s->edge->box, sli_cell_middle(&s->regions.space, i)))
            s->mark[s->regions.region[i]] |= BEYOND;
    for (int side = 0; side < SIDES; side++) {
        SL_TRY(find_covered(s, side));
        SL_TRY(walk_side(s, side, false));
    }
    doubt_beyond(s->edge, things);
    sli_regions_doubt(&s->regions, things);
    if (!things->options->start_names) SL_TRY(doubt_few(s, things));
    decide(s, things);
    SL_TRY(find_pieces(s));
    measure_rock(s);
    return SL_OK;
}

sl_status sli_edge_find(sli_edge *edge, const sl_map *map, sli_things *things) {
    edge_search s = {.edge = edge, .map = map};
    size_t all;
    edge->whole = true;
    if (!is_box(edge->box)) return SL_OK;
    if (edge->asked) {
        SL_TRY(SL_ARRAY_ROOM(edge->context, &edge->pieces, SIDES));
        for (int i = 0; i < SIDES; i++) edge->pieces.items[i] = side_of(edge->box, i);
        edge->pieces.count = SIDES;
        return SL_OK;
    }
    if (sli_edge_holds(map, edge->box, &all) * 2 < all || !all) {
        if (all)
            sl_note(edge->context,
                    "%s: most walls lie beyond the scene's edge, so the edge is left out; "
                    "--layers %s takes it",
                    edge->file, edge->all);
        return SL_OK;
    }
    sl_status status = search(&s, things);
    sli_regions_destroy(edge->context, &s.regions);
    sl_free(edge->context, s.mark);
    sl_free(edge->context, s.covered.items);
    sl_free(edge->context, s.bare.items);
    if (status == SL_OK || status == SL_NO_MEMORY || status == SL_CANCELLED) return status;
    // Walls that cannot be cleaned are read as ever: a bake refuses them.
    edge->pieces.count = 0;
    sl_note(edge->context,
            "%s: the walls cannot be cut, so the scene's edge is left out; "
            "--layers %s takes it",
            edge->file, edge->all);
    return SL_OK;
}

sl_status sli_edge_add(const sli_edge *edge, sl_map *map, uint32_t item) {
    const size_t count = edge->pieces.count;
    const double percent = 100 * edge->closed_off;
    if (percent >= 1)
        sl_note(edge->context,
                "%s: %.0f %% of the scene lies beyond closed walls and is not inside; "
                "--layers %s%s takes them in: all of the scene is inside then, whatever openings "
                "it has",
                edge->file, percent, edge->all, edge->started ? " --start-names none" : "");
    if (!count) return SL_OK;
    map->source.lines_are_items = true;
    SL_TRY(sli_map_add_label(edge->context, map, item, "the scene's edge"));
    for (size_t i = 0; i < count; i++)
        SL_TRY(sl_map_add_wall(edge->context, map, edge->pieces.items[i].a, edge->pieces.items[i].b,
                               item));
    if (!edge->asked)
        sl_note(
            edge->context,
            "%s: the walls are open: %s of the scene's edge %s walls; --layers %s leaves %s out",
            edge->file, edge->whole ? "all" : "parts", edge->whole ? "is" : "are", edge->off,
            edge->whole ? "it" : "them");
    return SL_OK;
}

void sli_edge_destroy(sli_edge *edge) {
    sl_free(edge->context, edge->pieces.items);
    *edge = (sli_edge){0};
}
