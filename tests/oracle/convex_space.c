/// Random triangulations of a small grid, joined and given walls.
#include "oracle/convex_space.h"
#include "oracle/must.h"

#include "sightline/support.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS_MOST = 40, CORNERS_MOST = 24, CELLS_MOST = 2 * POINTS_MOST, PIECES_MOST = 2 };

typedef struct place {
    int64_t x, y;
} place;

typedef struct polygon {
    int corners[CORNERS_MOST]; ///< counter-clockwise
    int count;
} polygon;

typedef struct plane {
    sl_random random;
    place points[POINTS_MOST];
    int point_count;
    polygon cells[CELLS_MOST];
    int cell_count;
} plane;

static int64_t cross(const plane *p, int a, int b, int c) {
    const place o = p->points[a], u = p->points[b], v = p->points[c];
    return (u.x - o.x) * (v.y - o.y) - (u.y - o.y) * (v.x - o.x);
}

static int at(const polygon *cell, int corner) {
    return cell->corners[(corner + cell->count) % cell->count];
}

// --- triangles

static void add_triangle(plane *p, int a, int b, int c) {
    assert(p->cell_count < CELLS_MOST && cross(p, a, b, c) > 0);
    p->cells[p->cell_count++] = (polygon){.corners = {a, b, c}, .count = 3};
}

/// Splits every triangle that has the point inside or on an edge.
static void insert(plane *p, place point) {
    for (int i = 0; i < p->point_count; i++)
        if (p->points[i].x == point.x && p->points[i].y == point.y) return;
    const int new = p->point_count++;
    p->points[new] = point;
    const int count = p->cell_count;
    for (int i = 0; i < count; i++) {
        const polygon t = p->cells[i];
        int64_t sides[3];
        bool within = true;
        for (int k = 0; k < 3; k++) {
            sides[k] = cross(p, at(&t, k), at(&t, k + 1), new);
            within &= sides[k] >= 0;
        }
        if (!within) continue;
        bool replaced = false;
        for (int k = 0; k < 3; k++) {
            if (sides[k] == 0) continue;
            add_triangle(p, at(&t, k), at(&t, k + 1), new);
            if (!replaced) p->cells[i] = p->cells[--p->cell_count];
            replaced = true;
        }
    }
}

/// The edge of another cell that runs against edge `edge` of a cell; false at the border.
static bool find_twin(const plane *p, int cell, int edge, int *other, int *other_edge) {
    const int a = at(&p->cells[cell], edge), b = at(&p->cells[cell], edge + 1);
    for (int i = 0; i < p->cell_count; i++)
        for (int k = 0; k < p->cells[i].count; k++)
            if (at(&p->cells[i], k) == b && at(&p->cells[i], k + 1) == a) {
                *other = i;
                *other_edge = k;
                return true;
            }
    return false;
}

static void flip(plane *p) {
    const int cell = (int)sl_random_below(&p->random, (uint64_t)p->cell_count);
    const int edge = (int)sl_random_below(&p->random, 3);
    int other, other_edge;
    if (!find_twin(p, cell, edge, &other, &other_edge)) return;
    const int a = at(&p->cells[cell], edge), b = at(&p->cells[cell], edge + 1);
    const int c = at(&p->cells[cell], edge + 2), d = at(&p->cells[other], other_edge + 2);
    if (cross(p, a, d, c) <= 0 || cross(p, d, b, c) <= 0) return;
    p->cells[cell] = (polygon){.corners = {a, d, c}, .count = 3};
    p->cells[other] = (polygon){.corners = {d, b, c}, .count = 3};
}

// --- cells

/// Joins two cells at an edge where the whole is convex and they share no other edge.
static void merge(plane *p) {
    const int cell = (int)sl_random_below(&p->random, (uint64_t)p->cell_count);
    const int edge = (int)sl_random_below(&p->random, (uint64_t)p->cells[cell].count);
    int other, other_edge, shared = 0;
    if (!find_twin(p, cell, edge, &other, &other_edge)) return;
    const polygon a = p->cells[cell], b = p->cells[other];
    for (int k = 0; k < a.count; k++) {
        int with, with_edge;
        shared += find_twin(p, cell, k, &with, &with_edge) && with == other;
    }
    if (shared != 1 || a.count + b.count - 2 > CORNERS_MOST) return;
    if (cross(p, at(&a, edge - 1), at(&a, edge), at(&b, other_edge + 2)) < 0) return;
    if (cross(p, at(&b, other_edge - 1), at(&b, other_edge), at(&a, edge + 2)) < 0) return;
    polygon whole = {.count = 0};
    for (int k = 1; k < a.count; k++) whole.corners[whole.count++] = at(&a, edge + k);
    for (int k = 1; k < b.count; k++) whole.corners[whole.count++] = at(&b, other_edge + k);
    p->cells[cell] = whole;
    p->cells[other] = p->cells[--p->cell_count];
}

static void make_cells(plane *p) {
    const int64_t size = 3 + (int64_t)sl_random_below(&p->random, 6);
    const place corners[4] = {{0, 0}, {size, 0}, {size, size}, {0, size}};
    memcpy(p->points, corners, sizeof corners);
    p->point_count = 4;
    add_triangle(p, 0, 1, 2);
    add_triangle(p, 0, 2, 3);
    const uint64_t count = 4 + sl_random_below(&p->random, 20);
    for (uint64_t i = 0; i < count; i++) {
        const int64_t x = (int64_t)sl_random_below(&p->random, (uint64_t)size + 1);
        insert(p, (place){x, (int64_t)sl_random_below(&p->random, (uint64_t)size + 1)});
    }
    for (uint64_t i = sl_random_below(&p->random, 60); i; i--) flip(p);
    for (uint64_t i = sl_random_below(&p->random, 40); i; i--) merge(p);
}

// --- the space

/// Where an edge is open, in eighths of its length.
typedef struct openings {
    int count, from[PIECES_MOST], to[PIECES_MOST];
} openings;

static openings random_openings(sl_random *random) {
    switch (sl_random_below(random, 10)) {
    case 0:
    case 1:
    case 2:
        return (openings){0};
    case 3:
        return (openings){.count = 1, .from = {0}, .to = {4}};
    case 4:
        return (openings){.count = 1, .from = {3}, .to = {8}};
    case 5:
        return (openings){.count = 2, .from = {0, 5}, .to = {2, 8}};
    default:
        return (openings){.count = 1, .from = {0}, .to = {8}};
    }
}

static sl_point point_at(const plane *p, int a, int b, int eighths, bool far) {
    const place u = p->points[a], v = p->points[b];
    const double unit = far ? 0x1p-30 : 1, shift = far ? 3 : 0;
    return (sl_point){shift + unit * (double)(8 * u.x + (v.x - u.x) * eighths),
                      shift + unit * (double)(8 * u.y + (v.y - u.y) * eighths)};
}

static void add_portals(plane *p, bool far, sl_space *out) {
    for (int cell = 0; cell < p->cell_count; cell++)
        for (int edge = 0; edge < p->cells[cell].count; edge++) {
            int other, other_edge;
            if (!find_twin(p, cell, edge, &other, &other_edge) || other < cell) continue;
            const int a = at(&p->cells[cell], edge), b = at(&p->cells[cell], edge + 1);
            const openings open = random_openings(&p->random);
            for (int i = 0; i < open.count; i++)
                out->portals[out->portal_count++] =
                    (sl_portal){.cell = {(uint32_t)cell, (uint32_t)other},
                                .right = point_at(p, a, b, open.from[i], far),
                                .left = point_at(p, a, b, open.to[i], far)};
        }
}

static double along(sl_point a, sl_point b, sl_point p) {
    return (b.x - a.x) * (p.x - a.x) + (b.y - a.y) * (p.y - a.y);
}

static bool lies_on(const sl_directed_portal *e, sl_point a, sl_point b) {
    const sl_point ends[2] = {e->right, e->left};
    for (int i = 0; i < 2; i++) {
        const sl_point p = ends[i];
        if ((b.x - a.x) * (p.y - a.y) != (b.y - a.y) * (p.x - a.x)) return false;
        if (along(a, b, p) < 0 || along(a, b, p) > along(a, b, b)) return false;
    }
    return along(a, b, e->right) < along(a, b, e->left);
}

/// The directed portals of one edge, in their order along it.
static void add_directed(sl_space *out, uint32_t cell, sl_point a, sl_point b) {
    const uint32_t first = out->directed_count;
    for (uint32_t i = 0; i < out->portal_count; i++) {
        const sl_portal *p = &out->portals[i];
        if (p->cell[0] != cell && p->cell[1] != cell) continue;
        const bool out_of_first = p->cell[0] == cell;
        const sl_directed_portal e = {.portal = i,
                                      .cell = p->cell[out_of_first],
                                      .left = out_of_first ? p->left : p->right,
                                      .right = out_of_first ? p->right : p->left};
        if (!lies_on(&e, a, b)) continue;
        uint32_t to = out->directed_count++;
        for (; to > first && along(a, b, out->directed[to - 1].right) > along(a, b, e.right); to--)
            out->directed[to] = out->directed[to - 1];
        out->directed[to] = e;
    }
}

void oracle_random_space(sl_context *context, uint64_t seed, sl_space *out) {
    plane *p = must(calloc(1, sizeof *p));
    p->random.state = seed;
    const bool far = seed % 4 == 3;
    make_cells(p);
    const size_t edges = (size_t)p->cell_count * CORNERS_MOST;
    *out = (sl_space){.cell_count = (uint32_t)p->cell_count};
    out->cells = must(sl_alloc_array(context, (size_t)p->cell_count, sizeof *out->cells));
    out->vertices = must(sl_alloc_array(context, edges, sizeof *out->vertices));
    out->portals = must(sl_alloc_array(context, edges * PIECES_MOST, sizeof *out->portals));
    out->directed = must(sl_alloc_array(context, 2 * edges * PIECES_MOST, sizeof *out->directed));
    out->bounds.min = point_at(p, 0, 0, 0, far);
    out->bounds.max = point_at(p, 2, 2, 0, far);
    add_portals(p, far, out);
    for (uint32_t cell = 0; cell < out->cell_count; cell++) {
        const polygon *from = &p->cells[cell];
        sl_cell *c = &out->cells[cell];
        *c = (sl_cell){.first_vertex = out->vertex_count,
                       .vertex_count = (uint32_t)from->count,
                       .first_directed = out->directed_count,
                       .inside = 1};
        for (int k = 0; k < from->count; k++) {
            const sl_point a = point_at(p, at(from, k), 0, 0, far);
            out->vertices[out->vertex_count++] = a;
            add_directed(out, cell, a, point_at(p, at(from, k + 1), 0, 0, far));
        }
        c->directed_count = out->directed_count - c->first_directed;
    }
    out->inside_count = out->cell_count;
    free(p);
}
