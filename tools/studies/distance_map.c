/// The picture of a shortest path map. Each cell is cut by a grid of squares; a piece has the
/// colour of the distance in its middle. Lines of equal distance are straight within the triangles
/// from the middle of a piece to its sides. Distances are asked within the piece, so that those on
/// both sides of a wall are kept apart.
#include "studies/distance_map.h"

#include "sightline/support.h"
#include "system/built.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/// Squares along the longer side of the plan, and lines of equal distance.
enum { SQUARES = 160, LINES = 20 };

/// A piece of a cell: a convex polygon.
typedef struct piece {
    SL_ARRAY(sl_point) points, next;
} piece;

typedef struct picture {
    sl_context *context;
    const sl_space *space;
    sl_route_map *map;
    piece piece;
    SL_ARRAY(sl_point) points;
    SL_ARRAY(uint32_t) first;
    SL_ARRAY(double) values;
    SL_ARRAY(sl_segment) lines;
    SL_ARRAY(sl_point) roots; ///< of the pieces
    double limit;             ///< of distances, or INFINITY
    double side;              ///< of a square
    double step;              ///< between lines of equal distance
} picture;

// --- pieces

static double coordinate(sl_point p, int axis) {
    return axis ? p.y : p.x;
}

/// Keeps what of the piece is on one side of an axial line.
static sl_status clip(picture *p, int axis, double at, bool above) {
    piece *c = &p->piece;
    c->next.count = 0;
    SL_TRY(SL_ARRAY_ROOM(p->context, &c->next, 2 * c->points.count));
    for (size_t i = 0; i < c->points.count; i++) {
        const sl_point a = c->points.items[i],
                       b = c->points.items[i + 1 < c->points.count ? i + 1 : 0];
        const double from = coordinate(a, axis) - at, to = coordinate(b, axis) - at;
        if (above ? from >= 0 : from <= 0) c->next.items[c->next.count++] = a;
        if (from * to < 0) {
            const double share = from / (from - to);
            c->next.items[c->next.count++] =
                (sl_point){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
        }
    }
    c->points.count = 0;
    SL_TRY(SL_ARRAY_ROOM(p->context, &c->points, c->next.count));
    for (size_t i = 0; i < c->next.count; i++)
        c->points.items[c->points.count++] = c->next.items[i];
    return SL_OK;
}

/// Takes a cell as a piece.
static sl_status take_cell(picture *p, uint32_t cell) {
    const sl_cell *c = &p->space->cells[cell];
    p->piece.points.count = 0;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->piece.points, c->vertex_count));
    for (uint32_t i = 0; i < c->vertex_count; i++)
        p->piece.points.items[p->piece.points.count++] = p->space->vertices[c->first_vertex + i];
    return SL_OK;
}

static sl_point middle_of(const piece *c) {
    sl_point sum = {0, 0};
    for (size_t i = 0; i < c->points.count; i++) {
        sum.x += c->points.items[i].x / (double)c->points.count;
        sum.y += c->points.items[i].y / (double)c->points.count;
    }
    return sum;
}

static double distance_at(const picture *p, sl_point at) {
    sl_route_place place;
    sl_route_map_at(p->map, at, &place);
    return place.distance;
}

/// Adds the lines of equal distance within a triangle.
static sl_status add_lines(picture *p, const sl_point corners[3], const double values[3]) {
    const double least = fmin(values[0], fmin(values[1], values[2])),
                 most = fmin(fmax(values[0], fmax(values[1], values[2])), p->limit);
    for (int i = 0; i < 3; i++)
        if (!isfinite(values[i])) return SL_OK;
    for (double level = ceil(least / p->step); level * p->step <= most; level++) {
        const double at = level * p->step;
        sl_point ends[3];
        int count = 0;
        for (int i = 0; i < 3; i++) {
            const double from = values[i] - at, to = values[(i + 1) % 3] - at;
            if ((from < 0) == (to < 0)) continue;
            const double share = from / (from - to);
            const sl_point a = corners[i], b = corners[(i + 1) % 3];
            ends[count++] = (sl_point){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
        }
        if (count != 2) continue;
        SL_TRY(SL_ARRAY_ROOM(p->context, &p->lines, 1));
        p->lines.items[p->lines.count++] = (sl_segment){ends[0], ends[1]};
    }
    return SL_OK;
}

static sl_status add_root(picture *p, sl_point root) {
    const size_t count = p->roots.count;
    if (count && p->roots.items[count - 1].x == root.x && p->roots.items[count - 1].y == root.y)
        return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->roots, 1));
    p->roots.items[p->roots.count++] = root;
    return SL_OK;
}

/// Adds a corner of the piece as it is drawn: what is in range of the side that ends there.
static sl_status add_corner(picture *p, sl_point last, double from, sl_point at, double to) {
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->points, 2));
    if ((from <= p->limit) != (to <= p->limit) && isfinite(from) && isfinite(to)) {
        const double share = (p->limit - from) / (to - from);
        p->points.items[p->points.count++] =
            (sl_point){last.x + share * (at.x - last.x), last.y + share * (at.y - last.y)};
    }
    if (to <= p->limit) p->points.items[p->points.count++] = at;
    return SL_OK;
}

/// Adds a piece with its colour, and its lines of equal distance.
static sl_status add_piece(picture *p) {
    const piece *c = &p->piece;
    const size_t count = c->points.count, begin = p->points.count;
    const sl_point middle = middle_of(c);
    sl_route_place place;
    if (count < 3) return SL_OK;
    sl_route_map_at(p->map, middle, &place);
    if (!isfinite(place.distance)) return SL_OK;
    const double within = 1e-6, value = place.distance < p->side ? 0 : place.distance;
    sl_point last = c->points.items[count - 1];
    double before = 0;
    for (size_t i = 0; i <= count; i++) {
        const sl_point at = c->points.items[(i + count - 1) % count];
        const double now = distance_at(
            p, (sl_point){at.x + within * (middle.x - at.x), at.y + within * (middle.y - at.y)});
        const sl_point corners[3] = {middle, last, at};
        const double values[3] = {place.distance, before, now};
        if (i) SL_TRY(add_corner(p, last, before, at, now));
        if (i) SL_TRY(add_lines(p, corners, values));
        last = at;
        before = now;
    }
    if (p->points.count < begin + 3) {
        p->points.count = begin;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->first, 1));
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->values, 1));
    p->values.items[p->values.count++] = fmin(value, p->limit);
    p->first.items[p->first.count++] = (uint32_t)p->points.count;
    return add_root(p, place.root);
}

/// Cuts a cell by the squares of the grid.
static sl_status add_cell(picture *p, uint32_t cell) {
    const double side = p->side;
    const sl_cell *c = &p->space->cells[cell];
    const sl_point corner = p->space->bounds.min;
    sl_box box = {p->space->vertices[c->first_vertex], p->space->vertices[c->first_vertex]};
    for (uint32_t i = 1; i < c->vertex_count; i++) {
        const sl_point at = p->space->vertices[c->first_vertex + i];
        box.min = (sl_point){fmin(box.min.x, at.x), fmin(box.min.y, at.y)};
        box.max = (sl_point){fmax(box.max.x, at.x), fmax(box.max.y, at.y)};
    }
    for (double y = floor((box.min.y - corner.y) / side); corner.y + y * side < box.max.y; y++) {
        SL_TRY(sl_check_cancelled(p->context));
        for (double x = floor((box.min.x - corner.x) / side); corner.x + x * side < box.max.x;
             x++) {
            SL_TRY(take_cell(p, cell));
            SL_TRY(clip(p, 0, corner.x + x * side, true));
            SL_TRY(clip(p, 0, corner.x + (x + 1) * side, false));
            SL_TRY(clip(p, 1, corner.y + y * side, true));
            SL_TRY(clip(p, 1, corner.y + (y + 1) * side, false));
            SL_TRY(add_piece(p));
        }
    }
    return SL_OK;
}

// --- the scale

/// 1, 2 or 5 times a power of ten: about so many steps up to a value.
static double round_step(double most, int steps) {
    const double rough = most / steps, ten = pow(10, floor(log10(rough)));
    return rough <= ten ? ten : rough <= 2 * ten ? 2 * ten : rough <= 5 * ten ? 5 * ten : 10 * ten;
}

/// The farthest corner of a cell, for the lines.
static double farthest(const picture *p) {
    double most = 0;
    for (uint32_t c = 0; c < p->space->cell_count; c++) {
        const double at = distance_at(p, sl_space_middle(p->space, c));
        if (isfinite(at)) most = fmax(most, at);
    }
    return most;
}

static int compare_places(const void *left, const void *right) {
    const sl_point *a = left, *b = right;
    if (a->x != b->x) return a->x < b->x ? -1 : 1;
    return (a->y > b->y) - (a->y < b->y);
}

/// Two short lines at each corner where ways turn, and where they start.
static sl_status add_crosses(picture *p, double size) {
    const size_t count = p->roots.count;
    if (count) qsort(p->roots.items, count, sizeof *p->roots.items, compare_places);
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->lines, 2 * count));
    for (size_t i = 0; i < count; i++) {
        const sl_point r = p->roots.items[i];
        if (i && !compare_places(&p->roots.items[i - 1], &r)) continue;
        p->lines.items[p->lines.count++] =
            (sl_segment){{r.x - size, r.y - size}, {r.x + size, r.y + size}};
        p->lines.items[p->lines.count++] =
            (sl_segment){{r.x - size, r.y + size}, {r.x + size, r.y - size}};
    }
    return SL_OK;
}

static sl_status fill(picture *p, double longer) {
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->first, 1));
    p->first.items[p->first.count++] = 0;
    for (uint32_t c = 0; c < p->space->cell_count; c++)
        if (!p->space->cells[c].solid) SL_TRY(add_cell(p, c));
    return add_crosses(p, longer / 250);
}

/// The step between lines: for the limit, or for the farthest cell.
static double step_of(const picture *p) {
    const double most = isfinite(p->limit) ? p->limit : farthest(p);
    return most > 0 ? round_step(most, LINES) : 1;
}

static sl_status draw(picture *p, const sl_baked *baked, const sl_draw_options *options,
                      const char *path) {
    char caption[160], name[64];
    const char *unit = baked->map.unit;
    snprintf(caption, sizeof caption,
             "lines: every %.9g%s%s; crosses: the start and the corners where ways turn", p->step,
             *unit ? " " : "", unit);
    snprintf(name, sizeof name, "distance%s%.32s", *unit ? ", " : "", unit);
    const sl_patches patches = {.name = name,
                                .points = p->points.items,
                                .first = p->first.items,
                                .values = p->values.items,
                                .count = (uint32_t)p->values.count,
                                .lines = p->lines.items,
                                .line_count = p->lines.count};
    return built_pictures()->patches(p->context, baked, &patches, caption, options, path);
}

sl_status distance_map_draw(sl_context *context, const sl_baked *baked, const sl_space *space,
                            sl_route_finder *finder, sl_point from, double limit,
                            const sl_draw_options *options, const char *path) {
    const sl_box *b = &space->bounds;
    const double longer = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    picture p = {.context = context, .space = space, .limit = limit, .side = longer / SQUARES};
    // Pieces at the limit are cut, by distances on both of its sides.
    SL_TRY(sl_route_map_create(context, finder, from, limit + 2 * p.side, &p.map));
    p.step = step_of(&p);
    sl_status status = fill(&p, longer);
    if (status == SL_OK) status = draw(&p, baked, options, path);
    sl_route_map_destroy(context, p.map);
    sl_free(context, p.piece.points.items);
    sl_free(context, p.piece.next.items);
    sl_free(context, p.points.items);
    sl_free(context, p.first.items);
    sl_free(context, p.values.items);
    sl_free(context, p.lines.items);
    sl_free(context, p.roots.items);
    return status;
}
