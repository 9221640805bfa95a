/// Shapes laid over each other.
///
///     +-------+                     +-------+
///     |    +--+----+     cut,       | 1  +--+----+      The outlines, and that of the area that
///     |    |  |    |   ------>      |    | 2| 1  |      counts, become one planar graph. It is
///     +----+--+    |     count      +----+--+    |      triangulated, and triangles are merged to
///          |       |                     |   1   |      convex pieces, but not across an outline.
///          +-------+                     +-------+
///
/// An edge of the graph knows the outlines that run along it, and in which direction. A walk steps
/// from piece to piece and notes how often each shape's loops go around it: this changes by 1 with
/// each outline that it crosses. It is depth-first, and each step back undoes what it crossed. So
/// it needs one number a shape, and it crosses each edge at most twice. Invariant: on the bounds'
/// border all numbers are 0.
///
/// Signs decide all of this, so a piece is counted right however thin it is; only places of
/// crossings are rounded (map/planar.h). Areas are sums of exact products, and rounded once.
#include "sight/overlay.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/support.h"
#include "space/mesh.h"

#include <math.h>

#define NOT_ENTERED UINT32_MAX

/// An outline that runs along a wall: what crossing it from right to left adds to a shape's number.
typedef struct change {
    uint32_t shape;
    int32_t by;
} change;

/// A step of the walk: a piece, and how far around it the walk has come.
typedef struct visit {
    uint32_t piece, side, portal;
    uint32_t through; ///< the wall that it was entered by, as the piece's neighbour
} visit;

typedef struct overlayer {
    sl_context *context;
    const sl_shape *shapes;
    size_t count;          ///< of shapes; shape `count` is the area that counts
    bool limited;          ///< there is that area; else all that is covered counts
    size_t most;           ///< of crossings
    const char *what;      ///< is laid
    sl_map map;            ///< the outlines as walls, shape after shape
    size_t *first_segment; ///< by shape, and two more
    sli_mesh_lines lines;
    sli_planar graph;
    sli_triangulation triangles;
    change *changes; ///< by wall of the pieces: first_change[w] .. first_change[w + 1]
    size_t *first_change;
    uint32_t *beside;   ///< by wall: the piece at its left, and the one at its right
    int32_t *winding;   ///< by shape: how often it goes around the walk's piece
    uint32_t *covering; ///< the shapes that cover the walk's piece, and
    uint32_t *place;    ///< by shape: where it stands among them
    uint32_t covering_count;
    visit *path;
    sl_overlay *out;
} overlayer;

// --- the outlines

static sl_status add_side(overlayer *o, sl_point a, sl_point b, uint32_t number) {
    return sli_same_point(a, b) ? SL_OK : sl_map_add_wall(o->context, &o->map, a, b, number);
}

static sl_status add_shape(overlayer *o, const sl_shape *shape, uint32_t number) {
    for (size_t i = 0, from = 0; i < shape->count; from = shape->ends[i++])
        for (size_t k = from; k < shape->ends[i]; k++)
            SL_TRY(add_side(o, shape->points[k],
                            shape->points[k + 1 < shape->ends[i] ? k + 1 : from], number));
    return SL_OK;
}

static sl_status add_outlines(overlayer *o, const sl_shape *within) {
    for (size_t i = 0; i <= o->count; i++) {
        o->first_segment[i] = o->map.wall_count;
        const sl_shape *shape = i < o->count ? &o->shapes[i] : within;
        if (shape) SL_TRY(add_shape(o, shape, (uint32_t)i));
    }
    o->first_segment[o->count + 1] = o->map.wall_count;
    return SL_OK;
}

static sl_status cut(overlayer *o) {
    sl_space *pieces = &o->out->pieces;
    SL_TRY(sli_mesh_lines_of_map(o->context, &o->map, &o->lines, pieces));
    SL_TRY(sli_planar_make_up_to(o->context, o->what, o->lines.items.items, o->lines.items.count,
                                 sli_planar_tolerance(&pieces->bounds), o->most, &o->graph));
    SL_TRY(sli_triangulate(o->context, &o->graph, &pieces->bounds, &o->triangles));
    return sli_mesh_make(o->context, &o->map, &o->lines, &o->graph, &o->triangles, pieces);
}

// --- what crossing a wall changes

/// The wall of each edge of the graph: walls are numbered in the order of segments.
static sl_status number_walls(const overlayer *o, uint32_t **out) {
    const sli_planar *graph = &o->graph;
    uint32_t *wall = *out = sl_alloc_array(o->context, graph->edge_count, sizeof *wall), count = 0;
    if (!wall) return SL_NO_MEMORY;
    for (size_t i = 0; i < graph->edge_count; i++) wall[i] = UINT32_MAX;
    for (size_t k = 0; k < graph->first[o->map.wall_count]; k++)
        if (wall[graph->links[k] / 2] == UINT32_MAX) wall[graph->links[k] / 2] = count++;
    return SL_OK;
}

static void note_changes(overlayer *o, const uint32_t *wall) {
    const sli_planar *graph = &o->graph;
    const size_t links = graph->first[o->map.wall_count];
    size_t *const first = o->first_change, *const end = first + 1;
    for (size_t k = 0; k < links; k++) end[wall[graph->links[k] / 2] + 1]++;
    for (uint32_t w = 0; w < o->out->pieces.wall_count; w++) end[w + 1] += end[w];
    for (uint32_t shape = 0; shape <= o->count; shape++)
        for (size_t k = graph->first[o->first_segment[shape]];
             k < graph->first[o->first_segment[shape + 1]]; k++) {
            const uint32_t w = wall[graph->links[k] / 2];
            const sl_point start = sli_planar_at(graph, graph->links[k]).a;
            const bool along = sli_same_point(start, o->out->pieces.walls[w].a);
            o->changes[end[w]++] = (change){shape, along ? 1 : -1}; // until it is the end
        }
}

static void note_beside(overlayer *o) {
    const sl_space *pieces = &o->out->pieces;
    for (uint32_t w = 0; w < 2 * pieces->wall_count; w++) o->beside[w] = SL_NO_CELL;
    for (uint32_t c = 0; c < pieces->cell_count; c++)
        for (uint32_t i = 0; i < pieces->cells[c].vertex_count; i++) {
            const uint32_t side = pieces->neighbour[pieces->cells[c].first_vertex + i];
            if (side >= SL_NEIGHBOUR_BORDER) continue;
            o->beside[2 * (side & ~SL_NEIGHBOUR_RIGHT) + !!(side & SL_NEIGHBOUR_RIGHT)] = c;
        }
}

// --- the walk

static void set_covering(overlayer *o, uint32_t shape, bool covers) {
    if (covers) {
        o->place[shape] = o->covering_count;
        o->covering[o->covering_count++] = shape;
        return;
    }
    const uint32_t last = o->covering[--o->covering_count];
    o->covering[o->place[shape]] = last;
    o->place[last] = o->place[shape];
}

/// Crosses a wall to the piece that has it as this neighbour, or back.
static void cross(overlayer *o, uint32_t side, bool back) {
    if (side >= SL_NEIGHBOUR_BORDER) return; // no wall
    const uint32_t wall = side & ~SL_NEIGHBOUR_RIGHT;
    const bool to_left = !(side & SL_NEIGHBOUR_RIGHT) != back;
    for (size_t k = o->first_change[wall]; k < o->first_change[wall + 1]; k++) {
        int32_t *const winding = &o->winding[o->changes[k].shape];
        const bool before = *winding != 0;
        *winding += to_left ? o->changes[k].by : -o->changes[k].by;
        if (o->changes[k].shape < o->count && before != (*winding != 0))
            set_covering(o, o->changes[k].shape, !before);
    }
}

static void enter(overlayer *o, uint32_t piece, uint32_t through, size_t *depth) {
    sl_cell *cell = &o->out->pieces.cells[piece];
    cross(o, through, false);
    const uint32_t covering = o->out->counts[piece] = o->covering_count;
    cell->inside = o->limited ? o->winding[o->count] != 0 : covering > 0;
    o->out->pieces.inside_count += cell->inside;
    const double area = cell->inside && covering ? sl_space_area(&o->out->pieces, piece) : 0;
    for (uint32_t i = 0; i < covering; i++) o->out->covered[o->covering[i]] += area;
    if (covering == 1) o->out->alone[o->covering[0]] += area;
    o->path[(*depth)++] = (visit){piece, 0, cell->first_directed, through};
}

/// The piece across the next side of a visit, and the wall to it; SL_NO_CELL beyond the bounds.
static uint32_t step(const overlayer *o, visit *at, uint32_t *through) {
    const sl_space *pieces = &o->out->pieces;
    *through = pieces->neighbour[pieces->cells[at->piece].first_vertex + at->side++];
    if (*through == SL_NEIGHBOUR_PORTAL) return pieces->directed[at->portal++].cell;
    if (*through == SL_NEIGHBOUR_BORDER) return SL_NO_CELL;
    *through ^= SL_NEIGHBOUR_RIGHT; // as the other piece has it
    return o->beside[2 * (*through & ~SL_NEIGHBOUR_RIGHT) + !!(*through & SL_NEIGHBOUR_RIGHT)];
}

/// A piece on the bounds' border, and what to enter it by.
static uint32_t find_start(const overlayer *o, uint32_t *through) {
    const sl_space *pieces = &o->out->pieces;
    for (uint32_t piece = 0;; piece++) {
        visit at = {.piece = piece, .portal = pieces->cells[piece].first_directed};
        while (at.side < pieces->cells[piece].vertex_count)
            if (step(o, &at, through) == SL_NO_CELL) {
                if (*through != SL_NEIGHBOUR_BORDER) *through ^= SL_NEIGHBOUR_RIGHT;
                return piece;
            }
    }
}

static sl_status walk(overlayer *o) {
    const sl_space *pieces = &o->out->pieces;
    size_t depth = 0, entered = 1;
    uint32_t through;
    const uint32_t start = find_start(o, &through);
    for (uint32_t i = 0; i < pieces->cell_count; i++) o->out->counts[i] = NOT_ENTERED;
    o->out->pieces.inside_count = 0;
    enter(o, start, through, &depth);
    while (depth) {
        visit *at = &o->path[depth - 1];
        if (at->side == pieces->cells[at->piece].vertex_count) {
            cross(o, at->through, true);
            depth--;
            continue;
        }
        const uint32_t next = step(o, at, &through);
        if (next == SL_NO_CELL || o->out->counts[next] != NOT_ENTERED) continue;
        if (entered++ % 4096 == 0) SL_TRY(sl_check_cancelled(o->context));
        enter(o, next, through, &depth);
    }
    return SL_OK;
}

static sl_status count_pieces(overlayer *o) {
    const sl_space *pieces = &o->out->pieces;
    uint32_t *wall = NULL;
    const size_t links = o->graph.first[o->map.wall_count];
    o->changes = sl_alloc_array(o->context, links, sizeof *o->changes);
    o->first_change =
        sl_alloc_array(o->context, (size_t)pieces->wall_count + 2, sizeof *o->first_change);
    o->beside = sl_alloc_array(o->context, 2 * (size_t)pieces->wall_count, sizeof *o->beside);
    o->winding = sl_alloc_array(o->context, o->count + 1, sizeof *o->winding);
    o->covering = sl_alloc_array(o->context, o->count + 1, sizeof *o->covering);
    o->place = sl_alloc_array(o->context, o->count + 1, sizeof *o->place);
    o->path = sl_alloc_array(o->context, pieces->cell_count, sizeof *o->path);
    o->out->counts = sl_alloc_array(o->context, pieces->cell_count, sizeof *o->out->counts);
    if (!o->changes || !o->first_change || !o->beside || !o->winding || !o->covering || !o->place ||
        !o->path || !o->out->counts)
        return SL_NO_MEMORY;
    SL_TRY(number_walls(o, &wall));
    note_changes(o, wall);
    sl_free(o->context, wall);
    note_beside(o);
    return walk(o);
}

// --- areas

/// A sum as two doubles.
typedef struct wide_sum {
    double high, low;
} wide_sum;

static void add_to_sum(wide_sum *sum, double value) {
    double rest;
    sum->high = sli_two_sum(sum->high, value, &rest);
    sum->low += rest;
}

static void add_product(wide_sum *sum, double a, double b) {
    const double product = a * b;
    add_to_sum(sum, product);
    add_to_sum(sum, fma(a, b, -product));
}

static sl_status add_areas(overlayer *o) {
    const sl_space *pieces = &o->out->pieces;
    wide_sum *twice = sl_alloc_array(o->context, o->count + 1, sizeof *twice);
    if (!twice) return SL_NO_MEMORY;
    for (uint32_t c = 0; c < pieces->cell_count; c++) {
        const sl_cell *cell = &pieces->cells[c];
        const sl_point *corners = pieces->vertices + cell->first_vertex;
        for (uint32_t i = 0; cell->inside && i < cell->vertex_count; i++) {
            const sl_point a = corners[i], b = corners[i + 1 < cell->vertex_count ? i + 1 : 0];
            add_product(&twice[o->out->counts[c]], a.x, b.y);
            add_product(&twice[o->out->counts[c]], -a.y, b.x);
        }
    }
    for (size_t k = o->count + 1; k-- > 0;) {
        if (k < o->count) {
            add_to_sum(&twice[k], twice[k + 1].high);
            twice[k].low += twice[k + 1].low;
        }
        o->out->areas[k] = (twice[k].high + twice[k].low) / 2;
    }
    sl_free(o->context, twice);
    return SL_OK;
}

// --- all of it

static sl_status make(overlayer *o, const sl_shape *within) {
    o->out->shape_count = o->count;
    o->out->areas = sl_alloc_array(o->context, o->count + 1, sizeof *o->out->areas);
    o->out->covered = sl_alloc_array(o->context, o->count, sizeof *o->out->covered);
    o->out->alone = sl_alloc_array(o->context, o->count, sizeof *o->out->alone);
    o->first_segment = sl_alloc_array(o->context, o->count + 2, sizeof *o->first_segment);
    if (!o->out->areas || !o->out->covered || !o->out->alone || !o->first_segment)
        return SL_NO_MEMORY;
    SL_TRY(add_outlines(o, within));
    if (!o->map.wall_count) return SL_OK;
    SL_TRY(cut(o));
    SL_TRY(count_pieces(o));
    return add_areas(o);
}

sl_status sl_overlay_make(sl_context *context, const sl_shape *within, const sl_shape *shapes,
                          size_t count, sl_overlay *out) {
    return sli_overlay_make_up_to(context, "the overlay", within, shapes, count, SIZE_MAX, out);
}

sl_status sli_overlay_make_up_to(sl_context *context, const char *what, const sl_shape *within,
                                 const sl_shape *shapes, size_t count, size_t most,
                                 sl_overlay *out) {
    sl_overlay made = {0};
    overlayer o = {.context = context,
                   .shapes = shapes,
                   .count = count,
                   .limited = within != NULL,
                   .most = most,
                   .what = what,
                   .out = &made};
    if (count >= INT32_MAX) return sl_fail_memory(context);
    const sl_status status = make(&o, within);
    sl_map_destroy(context, &o.map);
    sli_planar_destroy(context, &o.graph);
    sli_triangulation_destroy(context, &o.triangles);
    void *const scratch[] = {o.first_segment, o.lines.items.items, o.changes,  o.first_change,
                             o.beside,        o.winding,           o.covering, o.place,
                             o.path};
    for (size_t i = 0; i < sizeof scratch / sizeof *scratch; i++) sl_free(context, scratch[i]);
    if (status == SL_OK)
        *out = made;
    else
        sl_overlay_destroy(context, &made);
    return status;
}

void sl_overlay_destroy(sl_context *context, sl_overlay *overlay) {
    sl_space_destroy(context, &overlay->pieces);
    sl_free(context, overlay->areas);
    sl_free(context, overlay->counts);
    sl_free(context, overlay->covered);
    sl_free(context, overlay->alone);
    *overlay = (sl_overlay){0};
}
