/// The search for faults; here leaks to the outside, thin cells and rooms that no start reaches.
///
/// A leak is a way from a start to the border. Among all ways, the one is reported whose narrowest
/// portal is the widest. Cells are joined over portals, the widest first (as in Kruskal's
/// algorithm), until the start's cell and the border are in one set:
///
///     start o)  6  (  5  (  0.02  (   border       the portal that joined the two sets last, here
///                                                  the one of 0.02, is the place to look at
///
/// The shortest way through portals no narrower than that one is then shown. A cell is as thin as
/// the least distance from one of its edges to the farthest corner. Time O(n log n).
#include "space/faults.h"

#include "sightline/support.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the border

/// A piece of the border that a wall covers.
typedef struct cover {
    double low, high;
} cover;

typedef struct border {
    cover *covers[4]; ///< left, right, lower, upper; sorted and joined
    size_t counts[4];
} border;

static bool side_of(const sl_box *box, int side, sl_point p, double *along) {
    *along = side < 2 ? p.y : p.x;
    const double at = side < 2 ? p.x : p.y;
    return at == (side == 0   ? box->min.x
                  : side == 1 ? box->max.x
                  : side == 2 ? box->min.y
                              : box->max.y);
}

static int compare_covers(const void *left, const void *right) {
    const cover *a = left, *b = right;
    return (a->low > b->low) - (a->low < b->low);
}

static void join_covers(cover *covers, size_t *count) {
    size_t kept = 0;
    for (size_t i = 0; i < *count; i++) {
        if (kept && covers[i].low <= covers[kept - 1].high)
            covers[kept - 1].high = fmax(covers[kept - 1].high, covers[i].high);
        else
            covers[kept++] = covers[i];
    }
    *count = kept;
}

static void destroy_border(sl_context *context, border *b) {
    for (int side = 0; side < 4; side++) sl_free(context, b->covers[side]);
}

static sl_status read_border(sl_context *context, const sl_space *space, border *out) {
    border b = {0};
    for (int side = 0; side < 4; side++) {
        b.covers[side] = sl_alloc_array(context, space->wall_count, sizeof **b.covers);
        if (!b.covers[side]) {
            destroy_border(context, &b);
            return SL_NO_MEMORY;
        }
        for (uint32_t i = 0; i < space->wall_count; i++) {
            double from, to;
            if (!side_of(&space->bounds, side, space->walls[i].a, &from) ||
                !side_of(&space->bounds, side, space->walls[i].b, &to))
                continue;
            b.covers[side][b.counts[side]++] = (cover){fmin(from, to), fmax(from, to)};
        }
        if (b.counts[side])
            qsort(b.covers[side], b.counts[side], sizeof **b.covers, compare_covers);
        join_covers(b.covers[side], &b.counts[side]);
    }
    *out = b;
    return SL_OK;
}

static bool is_covered(const border *b, int side, double low, double high) {
    for (size_t i = 0; i < b->counts[side]; i++)
        if (b->covers[side][i].low <= low && b->covers[side][i].high >= high) return true;
    return false;
}

/// Whether a cell touches a part of the border that has no wall. `at` is its middle.
static bool is_open(const sl_space *space, const border *b, uint32_t number, sl_point *at) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = space->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point p = corners[i], q = corners[(i + 1) % cell->vertex_count];
        for (int side = 0; side < 4; side++) {
            double from, to;
            if (!side_of(&space->bounds, side, p, &from) ||
                !side_of(&space->bounds, side, q, &to) ||
                is_covered(b, side, fmin(from, to), fmax(from, to)))
                continue;
            *at = (sl_point){p.x / 2 + q.x / 2, p.y / 2 + q.y / 2};
            return true;
        }
    }
    return false;
}

// --- connected cells

static double width_of(const sl_portal *portal) {
    return sli_apart(portal->left, portal->right);
}

static uint32_t find_root(uint32_t *parents, uint32_t cell) {
    while (parents[cell] != cell) cell = parents[cell] = parents[parents[cell]];
    return cell;
}

/// Sets of connected cells, and the cells open to the border.
typedef struct rooms {
    uint32_t *parents;
    uint32_t *queue, *from; ///< of a breadth-first search; `from` has portals
    uint32_t *order;        ///< portals, the widest first
    sl_bits *open;
    border edge;
} rooms;

static void destroy_rooms(sl_context *context, rooms *r) {
    sl_free(context, r->parents);
    sl_free(context, r->queue);
    sl_free(context, r->from);
    sl_free(context, r->order);
    sl_free(context, r->open);
    destroy_border(context, &r->edge);
}

typedef struct wide_portal {
    double width;
    uint32_t number;
} wide_portal;

static int compare_widths(const void *left, const void *right) {
    const wide_portal *a = left, *b = right;
    if (a->width != b->width) return a->width > b->width ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

static sl_status order_portals(sl_context *context, const sl_space *space, uint32_t *order) {
    wide_portal *wide = sl_alloc_array(context, space->portal_count, sizeof *wide);
    if (!wide) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->portal_count; i++)
        wide[i] = (wide_portal){width_of(&space->portals[i]), i};
    if (space->portal_count) qsort(wide, space->portal_count, sizeof *wide, compare_widths);
    for (uint32_t i = 0; i < space->portal_count; i++) order[i] = wide[i].number;
    sl_free(context, wide);
    return SL_OK;
}

static sl_status make_rooms(sl_context *context, const sl_space *space, rooms *out) {
    rooms r = {0};
    SL_TRY(read_border(context, space, &r.edge));
    const uint32_t count = space->cell_count;
    r.parents = sl_alloc_array(context, count, sizeof *r.parents);
    r.queue = sl_alloc_array(context, count, sizeof *r.queue);
    r.from = sl_alloc_array(context, count, sizeof *r.from);
    r.order = sl_alloc_array(context, space->portal_count, sizeof *r.order);
    r.open = sl_alloc_array(context, sl_bits_words(count), sizeof *r.open);
    const bool room = r.parents && r.queue && r.from && r.order && r.open;
    const sl_status status = room ? order_portals(context, space, r.order) : SL_NO_MEMORY;
    if (status != SL_OK) {
        destroy_rooms(context, &r);
        return status;
    }
    sl_point at;
    for (uint32_t i = 0; i < count; i++)
        if (is_open(space, &r.edge, i, &at)) sl_bits_add(r.open, i);
    *out = r;
    return SL_OK;
}

// --- leaks

/// The narrowest portal on the widest way from a start's cell to an open cell. UINT32_MAX if the
/// start's cell itself is open. There must be some way.
static uint32_t find_bottleneck(const sl_space *space, rooms *r, uint32_t start) {
    const uint32_t count = space->cell_count;
    if (sl_bits_has(r->open, start)) return UINT32_MAX;
    for (uint32_t i = 0; i < count; i++) r->parents[i] = i;
    // Open cells are one set from the beginning.
    uint32_t open = UINT32_MAX;
    for (uint32_t i = 0; i < count; i++) {
        if (!sl_bits_has(r->open, i)) continue;
        if (open == UINT32_MAX) open = i;
        r->parents[i] = open;
    }
    uint32_t next = 0;
    while (find_root(r->parents, start) != find_root(r->parents, open)) {
        assert(next < space->portal_count);
        const sl_portal *each = &space->portals[r->order[next++]];
        const uint32_t a = find_root(r->parents, each->cell[0]);
        r->parents[a] = find_root(r->parents, each->cell[1]);
    }
    return r->order[next - 1];
}

/// The shortest way, in portals no narrower than `width`, to an open cell; SL_NO_CELL for none.
static uint32_t find_way(const sl_space *space, rooms *r, uint32_t start, double width) {
    uint32_t end = 0;
    for (uint32_t i = 0; i < space->cell_count; i++) r->from[i] = UINT32_MAX;
    r->queue[end++] = start;
    for (uint32_t begin = 0; begin < end; begin++) {
        const uint32_t number = r->queue[begin];
        if (sl_bits_has(r->open, number)) return number;
        const sl_cell *cell = &space->cells[number];
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const sl_directed_portal *directed = &space->directed[cell->first_directed + i];
            if (directed->cell == start || r->from[directed->cell] != UINT32_MAX ||
                width_of(&space->portals[directed->portal]) < width)
                continue;
            r->from[directed->cell] = directed->portal;
            r->queue[end++] = directed->cell;
        }
    }
    return SL_NO_CELL;
}

static sl_status add_point(sli_fault_search *search, sl_point point) {
    SL_TRY(SL_ARRAY_ROOM(search->context, &search->points, 1));
    search->points.items[search->points.count++] = point;
    return SL_OK;
}

/// Adds the way from the start through the middles of portals to the border. It is found backwards.
static sl_status add_leak(sli_fault_search *search, rooms *r, sl_point start, uint32_t first,
                          uint32_t last, uint32_t narrowest) {
    const sl_space *space = search->space;
    sl_fault leak = {.kind = SL_FAULT_LEAK,
                     .walls = {UINT32_MAX, UINT32_MAX},
                     .cell = last,
                     .cells = 1,
                     .first_point = (uint32_t)search->points.count};
    sl_point border_point = start;
    is_open(space, &r->edge, last, &border_point);
    if (narrowest != UINT32_MAX) {
        leak.at = (sl_segment){space->portals[narrowest].left, space->portals[narrowest].right};
        leak.size = width_of(&space->portals[narrowest]);
    } else {
        leak.at = (sl_segment){border_point, border_point};
    }
    SL_TRY(add_point(search, border_point));
    for (uint32_t cell = last; cell != first; leak.cells++) {
        const sl_portal *portal = &space->portals[r->from[cell]];
        SL_TRY(add_point(search, (sl_point){portal->left.x / 2 + portal->right.x / 2,
                                            portal->left.y / 2 + portal->right.y / 2}));
        cell = portal->cell[portal->cell[0] == cell];
    }
    SL_TRY(add_point(search, start));
    leak.point_count = (uint32_t)search->points.count - leak.first_point;
    sl_point *points = search->points.items + leak.first_point;
    for (uint32_t i = 0, j = leak.point_count - 1; i < j; i++, j--) {
        const sl_point swapped = points[i];
        points[i] = points[j];
        points[j] = swapped;
    }
    return sli_add_fault(search, leak);
}

// --- rooms

/// Marks all cells that a cell reaches. Returns whether one of them is open to the border.
static bool reach(const sl_space *space, rooms *r, sl_bits *reached, uint32_t start) {
    uint32_t end = 0;
    bool open = sl_bits_has(r->open, start);
    sl_bits_add(reached, start);
    r->queue[end++] = start;
    while (end) {
        const sl_cell *cell = &space->cells[r->queue[--end]];
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const uint32_t next = space->directed[cell->first_directed + i].cell;
            if (sl_bits_has(reached, next)) continue;
            sl_bits_add(reached, next);
            open |= sl_bits_has(r->open, next);
            r->queue[end++] = next;
        }
    }
    return open;
}

/// Finds one leak for each room with a start, and marks the cells that starts reach.
static sl_status find_leaks(sli_fault_search *search, rooms *r, sl_bits *reached) {
    const sl_map *map = search->map;
    for (size_t i = 0; i < map->start_count; i++) {
        const uint32_t start = sl_space_locate(search->space, map->starts[i].at);
        if (start == SL_NO_CELL || sl_bits_has(reached, start)) continue;
        SL_TRY(sl_check_cancelled(search->context));
        if (!reach(search->space, r, reached, start)) continue;
        const uint32_t narrowest = find_bottleneck(search->space, r, start);
        const double width =
            narrowest == UINT32_MAX ? 0 : width_of(&search->space->portals[narrowest]);
        const uint32_t last = find_way(search->space, r, start, width);
        SL_TRY(add_leak(search, r, map->starts[i].at, start, last, narrowest));
    }
    return SL_OK;
}

static sl_point middle_of(const sl_space *space, uint32_t number) {
    const sl_cell *cell = &space->cells[number];
    sl_point sum = {0, 0};
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        sum.x += space->vertices[cell->first_vertex + i].x / cell->vertex_count;
        sum.y += space->vertices[cell->first_vertex + i].y / cell->vertex_count;
    }
    return sum;
}

/// Measures the room of a cell. None of its cells was reached before.
static sl_fault measure_room(const sl_space *space, rooms *r, sl_bits *reached, uint32_t first,
                             bool *open) {
    sl_fault room = {.kind = SL_FAULT_UNREACHABLE, .walls = {UINT32_MAX, UINT32_MAX}};
    double largest = -1;
    uint32_t end = 0;
    *open = false;
    sl_bits_add(reached, first);
    r->queue[end++] = first;
    for (; room.cells < end; room.cells++) {
        const uint32_t number = r->queue[room.cells];
        const sl_cell *cell = &space->cells[number];
        const double area = sl_space_area(space, number);
        *open |= sl_bits_has(r->open, number);
        room.size += area;
        if (area > largest) {
            largest = area;
            room.cell = number;
        }
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const uint32_t next = space->directed[cell->first_directed + i].cell;
            if (sl_bits_has(reached, next)) continue;
            sl_bits_add(reached, next);
            r->queue[end++] = next;
        }
    }
    room.at.a = room.at.b = middle_of(space, room.cell);
    return room;
}

static sl_status find_unreachable(sli_fault_search *search, rooms *r, sl_bits *reached) {
    for (uint32_t i = 0; i < search->space->cell_count; i++) {
        if (sl_bits_has(reached, i)) continue;
        bool open;
        const sl_fault room = measure_room(search->space, r, reached, i, &open);
        if (!open) SL_TRY(sli_add_fault(search, room));
    }
    return SL_OK;
}

// --- thin cells

/// The width of a cell, and where it is that thin.
static double thinnest(const sl_space *space, const sl_cell *cell, sl_segment *at) {
    const sl_point *p = space->vertices + cell->first_vertex;
    double least = INFINITY;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = p[i], b = p[(i + 1) % cell->vertex_count];
        const double length = sli_apart(a, b);
        double most = 0;
        sl_point far = a;
        for (uint32_t k = 0; k < cell->vertex_count && length > 0; k++) {
            const double across =
                ((b.x - a.x) * (p[k].y - a.y) - (b.y - a.y) * (p[k].x - a.x)) / length;
            if (across <= most) continue;
            most = across;
            far = p[k];
        }
        if (!(length > 0) || most >= least) continue;
        least = most;
        const double share =
            ((far.x - a.x) * (b.x - a.x) + (far.y - a.y) * (b.y - a.y)) / (length * length);
        const double held = fmin(fmax(share, 0), 1);
        *at = (sl_segment){far, {a.x + held * (b.x - a.x), a.y + held * (b.y - a.y)}};
    }
    return least;
}

static sl_status find_thin(sli_fault_search *search) {
    const sl_space *space = search->space;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        sl_fault thin = {.kind = SL_FAULT_THIN, .walls = {UINT32_MAX, UINT32_MAX}, .cell = i};
        if (!space->cells[i].inside) continue;
        thin.size = thinnest(space, &space->cells[i], &thin.at);
        if (thin.size < search->options.thin) SL_TRY(sli_add_fault(search, thin));
    }
    return SL_OK;
}

// --- all

/// Leaks, thin cells and unreachable rooms.
static sl_status find_space_faults(sli_fault_search *search) {
    rooms r;
    SL_TRY(find_thin(search));
    if (!search->map->start_count) return SL_OK;
    SL_TRY(make_rooms(search->context, search->space, &r));
    sl_bits *reached =
        sl_alloc_array(search->context, sl_bits_words(search->space->cell_count), sizeof *reached);
    sl_status status = reached ? find_leaks(search, &r, reached) : SL_NO_MEMORY;
    if (status == SL_OK) status = find_unreachable(search, &r, reached);
    sl_free(search->context, reached);
    destroy_rooms(search->context, &r);
    return status;
}

// --- all faults

const char *sl_fault_name(sl_fault_kind kind) {
    static const char *const names[] = {"leak",     "gap",  "overlap",
                                        "crossing", "thin", "unreachable"};
    return (size_t)kind < SL_FAULT_KINDS ? names[kind] : "?";
}

void sl_faults_destroy(sl_context *context, sl_faults *faults) {
    sl_free(context, faults->items);
    sl_free(context, faults->points);
    *faults = (sl_faults){0};
}

static int compare(const void *left, const void *right) {
    const sl_fault *a = left, *b = right;
    if (a->kind != b->kind) return a->kind < b->kind ? -1 : 1;
    const bool largest_first = a->kind == SL_FAULT_OVERLAP || a->kind == SL_FAULT_UNREACHABLE;
    if (a->size != b->size) return (a->size < b->size) == largest_first ? 1 : -1;
    for (int i = 0; i < 2; i++)
        if (a->walls[i] != b->walls[i]) return a->walls[i] < b->walls[i] ? -1 : 1;
    if (a->cell != b->cell) return a->cell < b->cell ? -1 : 1;
    if (a->at.a.x != b->at.a.x) return a->at.a.x < b->at.a.x ? -1 : 1;
    if (a->at.a.y != b->at.a.y) return a->at.a.y < b->at.a.y ? -1 : 1;
    return (a->first_point > b->first_point) - (a->first_point < b->first_point);
}

/// Whether a fault was found twice, as happens to walls that share several squares of the grid.
static bool is_same(const sl_fault *a, const sl_fault *b) {
    return a->kind == b->kind && a->walls[0] == b->walls[0] && a->walls[1] == b->walls[1] &&
           a->walls[0] != UINT32_MAX && a->at.a.x == b->at.a.x && a->at.a.y == b->at.a.y;
}

static void finish(sli_fault_search *search, sl_faults *out) {
    sl_faults faults = {.items = search->faults.items,
                        .points = search->points.items,
                        .point_count = (uint32_t)search->points.count,
                        .has_starts = search->map->start_count > 0};
    if (search->faults.count) qsort(faults.items, search->faults.count, sizeof(sl_fault), compare);
    for (size_t i = 0; i < search->faults.count; i++) {
        const sl_fault fault = faults.items[i];
        if (faults.count && is_same(&faults.items[faults.count - 1], &fault)) continue;
        faults.items[faults.count++] = fault;
        faults.counts[fault.kind]++;
    }
    *out = faults;
}

sl_status sl_find_faults(sl_context *context, const sl_map *map, const sl_space *space,
                         const sl_faults_options *options, sl_faults *out) {
    const sl_box box = sl_map_bounds(map);
    const double usual = sli_apart(box.min, box.max) / 1000;
    sli_fault_search search = {.context = context, .map = map, .space = space, .options = *options};
    if (!(options->gap >= 0 && options->thin >= 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "a gap or width cannot be less than 0");
    if (options->gap == 0) search.options.gap = usual;
    if (options->thin == 0) search.options.thin = usual;
    sl_status status = sli_find_wall_faults(&search);
    if (status == SL_OK) status = find_space_faults(&search);
    if (status == SL_OK) {
        finish(&search, out);
        return SL_OK;
    }
    sl_free(context, search.faults.items);
    sl_free(context, search.points.items);
    return status;
}
