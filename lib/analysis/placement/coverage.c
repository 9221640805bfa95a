/// What given viewpoints see together: their regions as shapes of an overlay.
///
///     +---------------+        A region with a dead zone is a shape with a hole: the region up to
///     |     ____      |        the range, counter-clockwise, and that up to the dead zone,
///     |    /    \     |        clockwise. Both look from one eye, so one lies within the other.
///     |   ( (o)  )    |
///     |    \____/     |        The walls are a shape, too: loops of two points, there and back.
///     +---------------+        They cover nothing, but no blind spot goes through them.
///
/// The pieces that nothing covers are joined to blind spots, but not across walls.
#include "sightline/coverage.h"

#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

/// The share of the inside up to which an area is taken for rounding.
#define NEGLIGIBLE 1e-9
/// The number of the shape of walls.
#define WALLS 0
/// How far the chord of an arc may be off it, as a share of the radius.
#define CHORD 1e-4

/// What the shapes refer to.
struct sli_coverage_memory {
    SL_ARRAY(sl_point) points; ///< of all shapes
    SL_ARRAY(size_t) ends;     ///< of all loops, counted from their shape's first point
    sl_shape *shapes;          ///< that of the walls, and those of the viewpoints
};

typedef struct surveyor {
    sl_context *context;
    sl_query *query;
    const sl_space *space;
    sl_region region;
    struct sli_coverage_memory *memory;
    size_t *first_point; ///< by shape, and one more
    size_t *first_loop;
    size_t count; ///< of viewpoints
    sl_coverage *out;
} surveyor;

// --- shapes

static sl_status check_viewpoints(sl_context *context, const sl_viewpoint *viewpoints,
                                  size_t count) {
    for (size_t i = 0; i < count; i++) {
        const sl_viewpoint *v = &viewpoints[i];
        const bool cone = v->fov > 0 && v->fov <= 360 && isfinite(v->heading);
        const bool reach = v->range >= 0 && v->nearest >= 0 && isfinite(v->range + v->nearest);
        if (!cone || !reach || !isfinite(v->at.x) || !isfinite(v->at.y))
            return sl_fail(context, SL_BAD_ARGUMENT, "viewpoint %zu: %s", i + 1,
                           !cone    ? "the field of view must be over 0 and up to 360 degrees"
                           : !reach ? "range and dead zone must be 0 or more, and finite"
                                    : "its place must be finite");
    }
    return SL_OK;
}

static sl_status end_loop(surveyor *s) {
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->memory->ends, 1));
    s->memory->ends.items[s->memory->ends.count++] = s->memory->points.count;
    return SL_OK;
}

/// Adds the region of a viewpoint up to a range as a loop of the last shape.
static sl_status add_loop(surveyor *s, const sl_viewpoint *v, double range, bool clockwise) {
    const double most = sl_query_range(s->query);
    const sl_view view = sl_query_view(s->query, v->at, v->heading, v->fov);
    SL_TRY(sl_query_set_range(s->context, s->query, range));
    const sl_status status = sl_query_region(s->context, s->query, &view, &s->region);
    SL_TRY(sl_query_set_range(s->context, s->query, most));
    SL_TRY(status);
    const size_t from = s->memory->points.count;
    const double tolerance = CHORD * range;
    const size_t count = sl_region_flatten(&s->region, tolerance, NULL, 0);
    if (!count) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->memory->points, count));
    sl_point *const loop = s->memory->points.items + from;
    sl_region_flatten(&s->region, tolerance, loop, count);
    s->memory->points.count += count;
    for (size_t i = 0; clockwise && i < count / 2; i++) {
        const sl_point last = loop[count - 1 - i];
        loop[count - 1 - i] = loop[i];
        loop[i] = last;
    }
    return end_loop(s);
}

static sl_status add_viewpoint(surveyor *s, const sl_viewpoint *v) {
    const double most = sl_query_range(s->query);
    const double range = most > 0 && !(v->range > 0 && v->range < most) ? most : v->range;
    if (range > 0 && v->nearest >= range) return SL_OK;
    SL_TRY(add_loop(s, v, range, false));
    return v->nearest > 0 ? add_loop(s, v, v->nearest, true) : SL_OK;
}

/// All walls, there and back.
static sl_status add_walls(surveyor *s) {
    for (uint32_t w = 0; w < s->space->wall_count; w++) {
        SL_TRY(SL_ARRAY_ROOM(s->context, &s->memory->points, 2));
        s->memory->points.items[s->memory->points.count++] = s->space->walls[w].a;
        s->memory->points.items[s->memory->points.count++] = s->space->walls[w].b;
        SL_TRY(end_loop(s));
    }
    return SL_OK;
}

static void end_shape(surveyor *s, size_t shape) {
    for (size_t i = s->first_loop[shape]; i < s->memory->ends.count; i++)
        s->memory->ends.items[i] -= s->first_point[shape];
    s->first_point[shape + 1] = s->memory->points.count;
    s->first_loop[shape + 1] = s->memory->ends.count;
}

static sl_status make_shapes(surveyor *s, const sl_viewpoint *viewpoints) {
    s->memory = s->out->memory = sl_alloc_array(s->context, 1, sizeof *s->memory);
    if (!s->memory) return SL_NO_MEMORY;
    s->first_point = sl_alloc_array(s->context, s->count + 2, sizeof *s->first_point);
    s->first_loop = sl_alloc_array(s->context, s->count + 2, sizeof *s->first_loop);
    s->memory->shapes = sl_alloc_array(s->context, s->count + 1, sizeof *s->memory->shapes);
    if (!s->first_point || !s->first_loop || !s->memory->shapes) return SL_NO_MEMORY;
    SL_TRY(add_walls(s));
    end_shape(s, 0);
    for (size_t i = 0; i < s->count; i++) {
        SL_TRY(sl_check_cancelled(s->context));
        sl_report(s->context, "coverage", "viewpoints", i, s->count);
        SL_TRY(add_viewpoint(s, &viewpoints[i]));
        end_shape(s, i + 1);
    }
    for (size_t i = 0; i <= s->count; i++)
        s->memory->shapes[i] = (sl_shape){s->memory->points.items + s->first_point[i],
                                          s->memory->ends.items + s->first_loop[i],
                                          s->first_loop[i + 1] - s->first_loop[i]};
    return SL_OK;
}

static sl_status lay(surveyor *s) {
    sl_shape inside = {0};
    sl_overlay *overlay = &s->out->overlay;
    SL_TRY(sl_shape_of_inside(s->context, s->space, &inside));
    const sl_status status =
        sl_overlay_make(s->context, &inside, s->memory->shapes, s->count + 1, overlay);
    sl_shape_destroy(s->context, &inside);
    if (status != SL_OK) return status;
    overlay->areas[0] = 0; // of the plan itself: no crossing of outlines has rounded it
    for (uint32_t c = 0; c < s->space->cell_count; c++)
        if (s->space->cells[c].inside) overlay->areas[0] += sl_space_area(s->space, c);
    s->out->negligible = NEGLIGIBLE * overlay->areas[0];
    s->out->count = s->count;
    s->out->regions = s->memory->shapes + 1;
    s->out->seen = overlay->covered + 1;
    s->out->alone = overlay->alone + 1;
    return SL_OK;
}

// --- blind spots

static bool is_blind(const sl_overlay *overlay, uint32_t piece) {
    return overlay->pieces.cells[piece].inside && !overlay->counts[piece];
}

static sl_point middle_of(const sl_space *pieces, uint32_t piece) {
    const sl_cell *cell = &pieces->cells[piece];
    sl_point sum = {0, 0};
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        sum.x += pieces->vertices[cell->first_vertex + i].x / cell->vertex_count;
        sum.y += pieces->vertices[cell->first_vertex + i].y / cell->vertex_count;
    }
    return sum;
}

static void add_piece(const sl_space *pieces, uint32_t piece, double *largest,
                      sl_blind_spot *spot) {
    const sl_cell *cell = &pieces->cells[piece];
    const double area = sl_space_area(pieces, piece);
    spot->area += area;
    if (area > *largest) {
        *largest = area;
        spot->at = middle_of(pieces, piece);
    }
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point at = pieces->vertices[cell->first_vertex + i];
        sl_box *const b = &spot->bounds;
        b->min = (sl_point){fmin(b->min.x, at.x), fmin(b->min.y, at.y)};
        b->max = (sl_point){fmax(b->max.x, at.x), fmax(b->max.y, at.y)};
    }
}

/// Joins two pieces, to the one of the smaller number.
static void join(const sl_overlay *overlay, uint32_t *parent, uint32_t a, uint32_t b) {
    if (!is_blind(overlay, a) || !is_blind(overlay, b)) return;
    a = sl_root_of(parent, a);
    b = sl_root_of(parent, b);
    parent[a > b ? a : b] = a > b ? b : a;
}

/// Joins the blind pieces on both sides of portals, and of outlines that no wall is on. `left`, by
/// wall, is scratch.
static void join_pieces(const sl_overlay *overlay, uint32_t *left, uint32_t *parent) {
    const sl_space *pieces = &overlay->pieces;
    for (uint32_t w = 0; w < pieces->wall_count; w++) left[w] = UINT32_MAX;
    for (uint32_t c = 0; c < pieces->cell_count; c++) parent[c] = c;
    for (uint32_t c = 0; c < pieces->cell_count; c++) {
        const sl_cell *cell = &pieces->cells[c];
        for (uint32_t i = 0; i < cell->directed_count; i++)
            join(overlay, parent, c, pieces->directed[cell->first_directed + i].cell);
        for (uint32_t i = 0; i < cell->vertex_count; i++) {
            const uint32_t side = pieces->neighbour[cell->first_vertex + i];
            if (side >= SL_NEIGHBOUR_BORDER) continue;
            const uint32_t wall = side & ~SL_NEIGHBOUR_RIGHT;
            if (pieces->walls[wall].line == WALLS) continue;
            if (left[wall] != UINT32_MAX) join(overlay, parent, c, left[wall]);
            left[wall] = c; // the first of its two sides that is met
        }
    }
}

/// A spot and its number before the spots are sorted.
typedef struct numbered {
    sl_blind_spot spot;
    uint32_t number;
} numbered;

static int compare_spots(const void *left, const void *right) {
    const numbered *a = left, *b = right;
    if (a->spot.area != b->spot.area) return a->spot.area > b->spot.area ? -1 : 1;
    return a->number < b->number ? -1 : 1;
}

/// Sorts spots by size, and leaves out those that are rounding.
static sl_status sort_spots(surveyor *s, numbered *found, uint32_t count) {
    sl_coverage *out = s->out;
    uint32_t *place = sl_alloc_array(s->context, (size_t)count + 1, sizeof *place);
    out->blind = sl_alloc_array(s->context, (size_t)count + 1, sizeof *out->blind);
    const bool room = place && out->blind;
    if (room && count) qsort(found, count, sizeof *found, compare_spots);
    for (uint32_t i = 0; room && i < count; i++) {
        const bool counts = found[i].spot.area > out->negligible;
        place[found[i].number] = counts ? out->blind_count : UINT32_MAX;
        if (counts) out->blind[out->blind_count++] = found[i].spot;
    }
    for (uint32_t c = 0; room && c < out->overlay.pieces.cell_count; c++)
        if (out->spots[c] != UINT32_MAX) out->spots[c] = place[out->spots[c]];
    sl_free(s->context, place);
    return room ? SL_OK : SL_NO_MEMORY;
}

/// Sums the pieces up, by their roots; out->spots has the number of each one's spot.
static sl_status gather(surveyor *s, uint32_t *parent, double *largest) {
    sl_coverage *out = s->out;
    const sl_space *pieces = &out->overlay.pieces;
    SL_ARRAY(numbered) found = {0};
    sl_status status = SL_OK;
    for (uint32_t c = 0; status == SL_OK && c < pieces->cell_count; c++) {
        out->spots[c] = UINT32_MAX;
        if (!is_blind(&out->overlay, c)) continue;
        const uint32_t root = sl_root_of(parent, c);
        if (root == c) {
            status = SL_ARRAY_ROOM(s->context, &found, 1);
            if (status != SL_OK) break;
            const uint32_t number = (uint32_t)found.count;
            found.items[found.count++] =
                (numbered){{.bounds = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}}}, number};
            out->spots[c] = number;
        }
        out->spots[c] = out->spots[root]; // the root has the smallest number
        add_piece(pieces, c, &largest[root], &found.items[out->spots[c]].spot);
    }
    if (status == SL_OK) status = sort_spots(s, found.items, (uint32_t)found.count);
    sl_free(s->context, found.items);
    return status;
}

static sl_status find_blind(surveyor *s) {
    const sl_overlay *overlay = &s->out->overlay;
    const size_t pieces = (size_t)overlay->pieces.cell_count + 1;
    uint32_t *parent = sl_alloc_array(s->context, pieces, sizeof *parent);
    uint32_t *left =
        sl_alloc_array(s->context, (size_t)overlay->pieces.wall_count + 1, sizeof *left);
    double *largest = sl_alloc_array(s->context, pieces, sizeof *largest);
    s->out->spots = sl_alloc_array(s->context, pieces, sizeof *s->out->spots);
    sl_status status = parent && left && largest && s->out->spots ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        join_pieces(overlay, left, parent);
        status = gather(s, parent, largest);
    }
    sl_free(s->context, parent);
    sl_free(s->context, left);
    sl_free(s->context, largest);
    return status;
}

// --- all of it

sl_status sl_coverage_make(sl_context *context, sl_query *query, const sl_viewpoint *viewpoints,
                           size_t count, sl_coverage *out) {
    sl_coverage made = {0};
    surveyor s = {.context = context, .query = query, .count = count, .out = &made};
    SL_TRY(check_viewpoints(context, viewpoints, count));
    SL_TRY(sl_query_space(context, query, &s.space, NULL));
    sl_status status = make_shapes(&s, viewpoints);
    if (status == SL_OK) status = lay(&s);
    if (status == SL_OK) status = find_blind(&s);
    sl_region_destroy(context, &s.region);
    sl_free(context, s.first_point);
    sl_free(context, s.first_loop);
    if (status == SL_OK)
        *out = made;
    else
        sl_coverage_destroy(context, &made);
    return status;
}

void sl_coverage_destroy(sl_context *context, sl_coverage *coverage) {
    sl_overlay_destroy(context, &coverage->overlay);
    sl_free(context, coverage->spots);
    sl_free(context, coverage->blind);
    if (coverage->memory) {
        sl_free(context, coverage->memory->points.items);
        sl_free(context, coverage->memory->ends.items);
        sl_free(context, coverage->memory->shapes);
        sl_free(context, coverage->memory);
    }
    *coverage = (sl_coverage){0};
}

bool sl_coverage_is_spare(const sl_coverage *coverage, size_t viewpoint) {
    return coverage->alone[viewpoint] <= coverage->negligible;
}
