/// The outline of pieces of a mesh: their sides that do not lead to another one of them, joined to
/// loops. So are found what many shapes of an overlay cover, and what is inside of a space.
///
/// At a point where several loops meet, the loop that comes in goes on by the first way out,
/// clockwise from the way back. So it keeps along the wedge of the covered area that it borders:
///
///                  ^ a
///          covered | not          Coming from the left, the loop turns up to a, though b leads
///      ----------->+<---------     out as well. Where a loop comes back to a point, the part
///              not | covered       since then is a loop of its own.
///                  v b
///
/// Time O(n log n) for n sides, to sort them by their starts.
#include "sightline/overlay.h"

#include "geometry/orient.h"
#include "sightline/support.h"

#include <stdlib.h>

#define NONE SIZE_MAX

/// A piece of the outline, what is covered at its left.
typedef struct way {
    sl_point from, to;
    bool used;
} way;

typedef struct tracer {
    sl_context *context;
    way *ways; ///< by their starts
    size_t count;
    size_t *place; ///< by the first way out of a point: the point's place on the path, or NONE
    size_t *path;  ///< ways
    size_t length;
    SL_ARRAY(sl_point) points;
    SL_ARRAY(size_t) ends;
} tracer;

static int compare_ways(const void *left, const void *right) {
    const way *a = left, *b = right;
    const int order = sli_compare_points(a->from, b->from);
    return order ? order : sli_compare_points(a->to, b->to);
}

/// What is asked of each side of a covered piece.
typedef struct side_list {
    const sl_space *pieces;
    const bool *covered;
    uint8_t *of_wall; ///< by wall: 1 if the piece at its left is covered, 2 for its right, or both
} side_list;

static void note_walls(const side_list *l, const sl_cell *cell) {
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const uint32_t side = l->pieces->neighbour[cell->first_vertex + i];
        if (side < SL_NEIGHBOUR_BORDER)
            l->of_wall[side & ~SL_NEIGHBOUR_RIGHT] |= side & SL_NEIGHBOUR_RIGHT ? 2 : 1;
    }
}

/// Lists the sides that do not lead to another covered piece.
static void add_ways(tracer *t, const side_list *l, const sl_cell *cell) {
    const sl_point *corners = l->pieces->vertices + cell->first_vertex;
    uint32_t portal = cell->first_directed;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const uint32_t side = l->pieces->neighbour[cell->first_vertex + i];
        if (side == SL_NEIGHBOUR_PORTAL && l->covered[l->pieces->directed[portal++].cell]) continue;
        if (side < SL_NEIGHBOUR_BORDER && l->of_wall[side & ~SL_NEIGHBOUR_RIGHT] == 3) continue;
        t->ways[t->count++] =
            (way){corners[i], corners[i + 1 < cell->vertex_count ? i + 1 : 0], false};
    }
}

static sl_status list_ways(tracer *t, const sl_space *pieces, const bool *covered) {
    side_list l = {pieces, covered, NULL};
    size_t most = 0;
    for (uint32_t c = 0; c < pieces->cell_count; c++)
        if (covered[c]) most += pieces->cells[c].vertex_count;
    l.of_wall = sl_alloc_array(t->context, pieces->wall_count, sizeof *l.of_wall);
    t->ways = sl_alloc_array(t->context, most, sizeof *t->ways);
    t->place = sl_alloc_array(t->context, most, sizeof *t->place);
    t->path = sl_alloc_array(t->context, most, sizeof *t->path);
    const bool room = l.of_wall && t->ways && t->place && t->path;
    for (uint32_t c = 0; room && c < pieces->cell_count; c++)
        if (covered[c]) note_walls(&l, &pieces->cells[c]);
    for (uint32_t c = 0; room && c < pieces->cell_count; c++)
        if (covered[c]) add_ways(t, &l, &pieces->cells[c]);
    sl_free(t->context, l.of_wall);
    if (t->count) qsort(t->ways, t->count, sizeof *t->ways, compare_ways);
    for (size_t i = 0; i < t->count; i++) t->place[i] = NONE;
    return room ? SL_OK : SL_NO_MEMORY;
}

/// The first way out of a point; there is one, as loops are closed.
static size_t first_from(const tracer *t, sl_point at) {
    return sli_first_at(t->ways, sizeof *t->ways, t->count, at);
}

/// Whether, turning clockwise about a point from the direction back, a comes before b.
static bool is_sooner(sl_point at, sl_point back, sl_point a, sl_point b) {
    const int side_a = sli_orient(at, back, a), side_b = sli_orient(at, back, b);
    return side_a != side_b ? side_a < side_b : sli_orient(at, a, b) < 0;
}

/// The way on from the end of another; NONE where all are used.
static size_t next_way(const tracer *t, const way *last, size_t first) {
    size_t best = NONE;
    for (size_t i = first; i < t->count && sli_same_point(t->ways[i].from, last->to); i++)
        if (!t->ways[i].used &&
            (best == NONE || is_sooner(last->to, last->from, t->ways[i].to, t->ways[best].to)))
            best = i;
    return best;
}

/// Takes the end of the path off it, as a loop, without corners that are exactly straight.
static sl_status cut_loop(tracer *t, size_t from) {
    const size_t start = t->points.count;
    SL_TRY(SL_ARRAY_ROOM(t->context, &t->points, t->length - from));
    SL_TRY(SL_ARRAY_ROOM(t->context, &t->ends, 1));
    for (size_t i = from; i < t->length; i++) {
        const way *before = &t->ways[t->path[i > from ? i - 1 : t->length - 1]];
        const way *after = &t->ways[t->path[i]];
        t->place[first_from(t, after->from)] = NONE;
        if (sli_orient(before->from, after->from, after->to) != 0)
            t->points.items[t->points.count++] = after->from;
    }
    t->length = from;
    if (t->points.count > start) t->ends.items[t->ends.count++] = t->points.count;
    return SL_OK;
}

/// Follows the outline from one way until it is closed.
static sl_status follow(tracer *t, size_t at) {
    for (size_t point = first_from(t, t->ways[at].from); at != NONE;) {
        t->place[point] = t->length;
        t->path[t->length++] = at;
        t->ways[at].used = true;
        point = first_from(t, t->ways[at].to);
        const size_t next = next_way(t, &t->ways[at], point);
        if (t->place[point] != NONE) SL_TRY(cut_loop(t, t->place[point]));
        at = next;
    }
    return SL_OK;
}

static sl_status trace(tracer *t, const sl_space *pieces, const bool *covered) {
    SL_TRY(list_ways(t, pieces, covered));
    for (size_t i = 0; i < t->count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(t->context));
        if (!t->ways[i].used) SL_TRY(follow(t, i));
    }
    return SL_OK;
}

/// The outline of a mesh's covered pieces.
static sl_status make_outline(sl_context *context, const sl_space *pieces, const bool *covered,
                              sl_shape *out) {
    tracer t = {.context = context};
    const sl_status status = trace(&t, pieces, covered);
    sl_free(context, t.ways);
    sl_free(context, t.place);
    sl_free(context, t.path);
    sl_shape made = {t.points.items, t.ends.items, t.ends.count};
    if (status == SL_OK)
        *out = made;
    else
        sl_shape_destroy(context, &made);
    return status;
}

sl_status sl_overlay_outline(sl_context *context, const sl_overlay *overlay, size_t at_least,
                             sl_shape *out) {
    const sl_space *pieces = &overlay->pieces;
    if (!at_least)
        return sl_fail(context, SL_BAD_ARGUMENT, "the outline of what 0 shapes cover: ask for 1");
    bool *covered = sl_alloc_array(context, pieces->cell_count, sizeof *covered);
    for (uint32_t c = 0; covered && c < pieces->cell_count; c++)
        covered[c] = overlay->counts[c] >= at_least;
    const sl_status status = covered ? make_outline(context, pieces, covered, out) : SL_NO_MEMORY;
    sl_free(context, covered);
    return status;
}

/// Of a space whose walls may be several sides of cells: lays its cells over each other.
static sl_status join_cells(sl_context *context, const sl_space *space, sl_overlay *out) {
    size_t *ends = sl_alloc_array(context, space->cell_count, sizeof *ends), count = 0, corners = 0;
    sl_point *points = sl_alloc_array(context, space->vertex_count, sizeof *points);
    sl_status status = ends && points ? SL_OK : SL_NO_MEMORY;
    for (uint32_t c = 0; status == SL_OK && c < space->cell_count; c++) {
        const sl_cell *cell = &space->cells[c];
        for (uint32_t i = 0; cell->inside && i < cell->vertex_count; i++)
            points[corners++] = space->vertices[cell->first_vertex + i];
        if (cell->inside) ends[count++] = corners;
    }
    if (status == SL_OK)
        status = sl_overlay_make(context, NULL, &(sl_shape){points, ends, count}, 1, out);
    sl_free(context, ends);
    sl_free(context, points);
    return status;
}

sl_status sl_shape_of_inside(sl_context *context, const sl_space *space, sl_shape *out) {
    sl_overlay joined = {0};
    if (!space->neighbour || space->cut_walls) {
        SL_TRY(join_cells(context, space, &joined));
        space = &joined.pieces; // inside is what they cover
    }
    bool *inside = sl_alloc_array(context, space->cell_count, sizeof *inside);
    for (uint32_t c = 0; inside && c < space->cell_count; c++) inside[c] = space->cells[c].inside;
    const sl_status status = inside ? make_outline(context, space, inside, out) : SL_NO_MEMORY;
    sl_free(context, inside);
    sl_overlay_destroy(context, &joined);
    return status;
}

void sl_shape_destroy(sl_context *context, sl_shape *shape) {
    sl_free(context, (void *)(uintptr_t)shape->points);
    sl_free(context, (void *)(uintptr_t)shape->ends);
    *shape = (sl_shape){0};
}
