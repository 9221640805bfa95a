/// The search for faults; here thin cells, rooms that no start reaches, and whether it is in doubt
/// what is inside. Leaks are in faults_leaks.c, faults between walls in faults_walls.c, closing
/// gaps in faults_snap.c.
///
/// Cells that portals join make a room. A cell is open where a piece of its boundary lies on the
/// map's border and no wall covers it. A room with a start and an open cell leaks:
///
///     +------------+        walls lie on the border; the piece without a wall opens the cell, and
///     |  o  |      :        with it the room of the start o
///     +------------+
///
/// A cell is as thin as the least distance from one of its edges to the farthest corner. Time
/// O(n log n).
#include "space/faults/faults.h"

#include "geometry/orient.h"
#include "sightline/support.h"

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

/// Covers are apart, so the last one that begins at `low` or before it decides.
static bool is_covered(const border *b, int side, double low, double high) {
    size_t first = 0, last = b->counts[side];
    while (first < last) {
        const size_t middle = first + (last - first) / 2;
        if (b->covers[side][middle].low <= low)
            first = middle + 1;
        else
            last = middle;
    }
    return first > 0 && b->covers[side][first - 1].high >= high;
}

/// Whether a cell touches a part of the border that has no wall.
static bool is_open(const sl_space *space, const border *b, uint32_t number) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *corners = space->vertices + cell->first_vertex;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point p = corners[i], q = corners[(i + 1) % cell->vertex_count];
        for (int side = 0; side < 4; side++) {
            double from, to;
            if (side_of(&space->bounds, side, p, &from) && side_of(&space->bounds, side, q, &to) &&
                !is_covered(b, side, fmin(from, to), fmax(from, to)))
                return true;
        }
    }
    return false;
}

// --- rooms

/// What a search from cell to cell needs.
typedef struct rooms {
    uint32_t *queue;
    sl_bits *open; ///< the cells open to the border
} rooms;

static void destroy_rooms(sl_context *context, rooms *r) {
    sl_free(context, r->queue);
    sl_free(context, r->open);
}

static sl_status make_rooms(sl_context *context, const sl_space *space, rooms *out) {
    border edge;
    SL_TRY(read_border(context, space, &edge));
    rooms r = {.queue = sl_alloc_array(context, space->cell_count, sizeof *r.queue),
               .open = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof *r.open)};
    const bool room = r.queue && r.open;
    for (uint32_t i = 0; room && i < space->cell_count; i++)
        if (is_open(space, &edge, i)) sl_bits_add(r.open, i);
    destroy_border(context, &edge);
    if (!room) {
        destroy_rooms(context, &r);
        return SL_NO_MEMORY;
    }
    *out = r;
    return SL_OK;
}

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

/// Finds the leaks of each room with a start, and marks the cells that starts reach.
static sl_status find_leaks(sli_fault_search *search, rooms *r, sl_bits *reached) {
    const sl_map *map = search->map;
    sli_leak_search *leaks = NULL;
    sl_status status = SL_OK;
    for (size_t i = 0; i < map->start_count && status == SL_OK; i++) {
        const uint32_t start = sl_space_locate(search->space, map->starts[i].at);
        if (start == SL_NO_CELL || sl_bits_has(reached, start)) continue;
        if (search->space->cells[start].solid) continue;
        if (!reach(search->space, r, reached, start)) continue;
        if (!leaks) status = sli_leak_search_begin(search, &leaks);
        if (status == SL_OK) status = sli_find_leaks_of(leaks, map->starts[i].at);
        if (status == SL_OK) status = sl_check_cancelled(search->context);
    }
    sli_leak_search_end(search->context, leaks);
    return status;
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
    room.at.a = room.at.b = sl_space_middle(space, room.cell);
    return room;
}

static sl_status find_unreachable(sli_fault_search *search, rooms *r, sl_bits *reached) {
    for (uint32_t i = 0; i < search->space->cell_count; i++) {
        if (search->space->cells[i].solid || sl_bits_has(reached, i)) continue;
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
    if (!search->trial) SL_TRY(find_thin(search));
    if (!search->map->start_count) return SL_OK;
    SL_TRY(make_rooms(search->context, search->space, &r));
    sl_bits *reached =
        sl_alloc_array(search->context, sl_bits_words(search->space->cell_count), sizeof *reached);
    sl_status status = reached ? find_leaks(search, &r, reached) : SL_NO_MEMORY;
    if (status == SL_OK && !search->trial) status = find_unreachable(search, &r, reached);
    sl_free(search->context, reached);
    destroy_rooms(search->context, &r);
    return status;
}

// --- whether it is in doubt what is inside

/// Whether a cell that counts as inside is open to the border.
static bool inside_is_open(const sl_space *space, const border *edge) {
    for (uint32_t i = 0; i < space->cell_count; i++)
        if (space->cells[i].inside && is_open(space, edge, i)) return true;
    return false;
}

/// What a walk over cells needs.
typedef struct walk {
    const sl_space *space;
    sl_bits *reached;
    uint32_t *stack, count;
} walk;

static void go_to(walk *w, uint32_t cell) {
    if (sl_bits_has(w->reached, cell)) return;
    sl_bits_add(w->reached, cell);
    w->stack[w->count++] = cell;
}

static sl_box join_boxes(sl_box a, sl_box b) {
    return sli_box_with(sli_box_with(a, b.min), b.max);
}

/// Walks on to all cells that portals lead to. Adds to *area what of them is not inside, and to
/// *box all of them.
static void walk_on(walk *w, double *area, sl_box *box) {
    while (w->count) {
        const uint32_t at = w->stack[--w->count];
        const sl_cell *cell = &w->space->cells[at];
        if (!cell->inside) *area += sl_space_area(w->space, at);
        *box = join_boxes(*box, sli_box_of_cell(w->space, at));
        for (uint32_t i = 0; i < cell->directed_count; i++)
            go_to(w, w->space->directed[cell->first_directed + i].cell);
    }
}

static bool is_same_box(const sl_box *a, const sl_box *b) {
    return a->min.x == b->min.x && a->min.y == b->min.y && a->max.x == b->max.x &&
           a->max.y == b->max.y;
}

/// The area of the rooms that neither a start nor the border leads to, as a share of all. Beside
/// solid ground, one as wide and as high as all that the border does not lead to lies around the
/// others, as the void around the rooms of a game does: it is no room.
static sl_status find_shut_in(sl_context *context, const sl_space *space, const border *edge,
                              double *share) {
    const bool solid = sl_space_ground(space).solid > 0;
    walk w = {.space = space,
              .reached = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof(sl_bits)),
              .stack = sl_alloc_array(context, space->cell_count, sizeof *w.stack)};
    const bool done = w.reached && w.stack;
    double area = 0, all = 0, open = 0;
    sl_box around = {0}, bounds = {0};
    bool any = false;
    for (uint32_t i = 0; done && i < space->cell_count; i++)
        if (is_open(space, edge, i)) go_to(&w, i);
    if (done) walk_on(&w, &open, &around);
    for (uint32_t i = 0; done && i < space->cell_count; i++) {
        all += sl_space_area(space, i);
        if (space->cells[i].solid || sl_bits_has(w.reached, i)) continue;
        const sl_box own = sli_box_of_cell(space, i);
        bounds = any ? join_boxes(bounds, own) : own;
        any = true;
    }
    for (uint32_t i = 0; done && i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        if (cell->solid || cell->inside || sl_bits_has(w.reached, i)) continue;
        double own = 0;
        sl_box box = sli_box_of_cell(space, i);
        go_to(&w, i);
        walk_on(&w, &own, &box);
        if (!solid || !is_same_box(&box, &bounds)) area += own;
    }
    *share = all > 0 ? area / all : 0;
    sl_free(context, w.reached);
    sl_free(context, w.stack);
    return done ? SL_OK : SL_NO_MEMORY;
}

/// Without a start: where the border leads to all cells, all of them count as inside; so they do
/// where nothing is found by the width of entrances.
static sl_inside doubt_without_start(const sl_map *map, double enclosed, bool open) {
    const sl_interior *found = &map->interior;
    if (found->doubtful_width > 0 && found->by != SL_ENTRANCE_GIVEN) return SL_INSIDE_OPENING;
    if (found->place_count && found->entrances && found->building) return SL_INSIDE_SURE;
    if (found->place_count) open = false; // at an entrance
    return open || enclosed < 0.5 ? SL_INSIDE_SMALL : SL_INSIDE_SURE;
}

/// Whether reports print 0.0 % for what is inside, while there is more outside: niches, or cores of
/// walls.
static bool is_nearly_nothing(const sl_ground_shares *shares, double enclosed) {
    return shares->inside < 0.0005 && shares->outside > shares->inside && enclosed < 0.5;
}

sl_status sl_doubt_inside(sl_context *context, const sl_map *map, const sl_space *space,
                          sl_inside *out) {
    border edge;
    double shut_in = 0, enclosed = 0;
    SL_TRY(sl_space_enclosed(context, space, &enclosed));
    SL_TRY(read_border(context, space, &edge));
    const bool open = inside_is_open(space, &edge);
    const sl_ground_shares shares = sl_space_ground(space);
    sl_status status = SL_OK;
    if (map->start_count) status = find_shut_in(context, space, &edge, &shut_in);
    const bool few = is_nearly_nothing(&shares, enclosed);
    destroy_border(context, &edge);
    SL_TRY(status);
    *out = SL_INSIDE_SURE;
    if (shut_in > shares.inside || (map->start_count && few)) *out = SL_INSIDE_FEW;
    if (map->start_count && open) *out = SL_INSIDE_LEAKS;
    if (!map->start_count) *out = doubt_without_start(map, enclosed, open);
    if (!map->start_count && few && *out == SL_INSIDE_SURE) *out = SL_INSIDE_SMALL;
    if (!space->inside_count) *out = SL_INSIDE_NONE;
    return SL_OK;
}

/// A width in the map's unit: "1.2 m".
static const char *say_width(const sl_map *map, double width, char text[40]) {
    snprintf(text, 40, "%.4g%s%s", width, *map->unit ? " " : "", map->unit);
    return text;
}

static void say_opening(const sl_map *map, char text[SL_INSIDE_TEXT]) {
    const sl_interior *found = &map->interior;
    const int digits = sl_map_digits(map);
    char opening[40], usual[40];
    snprintf(text, SL_INSIDE_TEXT,
             "an opening %s wide, at %.*g,%.*g, is wider than entrances are (%s), so inside is "
             "doubtful: %s; a start in a room decides it, or an entrance of %.4g if the "
             "opening is one",
             say_width(map, found->doubtful_width, opening), digits, found->doubtful.a.x, digits,
             found->doubtful.a.y, say_width(map, found->width, usual),
             found->place_count ? "what is behind it counts as outside"
                                : "all of the map counts as inside",
             found->doubtful_width);
}

/// Entrances that nobody has given the width of.
static void say_entrances(const sl_map *map, char text[SL_INSIDE_TEXT]) {
    const sl_interior *found = &map->interior;
    char width[40], doors[40] = "";
    if (!found->entrances || found->by == SL_ENTRANCE_GIVEN) return;
    if (found->by == SL_ENTRANCE_FOUND && map->entrance_by_doors)
        snprintf(doors, sizeof doors, "; %.4g by its doors", map->entrance);
    snprintf(text, SL_INSIDE_TEXT,
             "inside ends at %zu opening%s up to %s wide (entrance %.4g, %s%s)", found->entrances,
             found->entrances == 1 ? "" : "s", say_width(map, found->width, width), found->width,
             found->by == SL_ENTRANCE_UNIT    ? "as is usual"
             : found->by == SL_ENTRANCE_DOORS ? "by the doors that are drawn open"
             : found->by == SL_ENTRANCE_WIDE
                 ? "wider than usual: without it, some rooms would be doubtful"
                 : "found from the plan",
             doors);
}

sl_status sl_say_inside(sl_context *context, const sl_map *map, const sl_space *space,
                        char text[SL_INSIDE_TEXT]) {
    const sl_ground_shares shares = sl_space_ground(space);
    sl_inside doubt;
    double enclosed;
    text[0] = '\0';
    SL_TRY(sl_doubt_inside(context, map, space, &doubt));
    SL_TRY(sl_space_enclosed(context, space, &enclosed));
    if (doubt == SL_INSIDE_SURE) say_entrances(map, text);
    if (doubt == SL_INSIDE_OPENING) say_opening(map, text);
    if (doubt == SL_INSIDE_LEAKS)
        snprintf(text, SL_INSIDE_TEXT,
                 "a start leads out of the map, so the outside counts as inside, too (%.0f %% of "
                 "the area)",
                 100 * shares.inside);
    if (doubt == SL_INSIDE_SMALL && shares.outside > 0)
        snprintf(text, SL_INSIDE_TEXT,
                 "the map has no start, and walls enclose only %.0f %% of the area among them, so "
                 "inside is doubtful",
                 100 * enclosed);
    if (doubt == SL_INSIDE_SMALL && !(shares.outside > 0))
        snprintf(text, SL_INSIDE_TEXT,
                 "the map has no start, and walls enclose nothing, so all of it counts as inside");
    if (doubt == SL_INSIDE_FEW)
        snprintf(text, SL_INSIDE_TEXT, "a start reaches %.2g %% of the area, and %s",
                 100 * shares.inside,
                 is_nearly_nothing(&shares, enclosed)
                     ? "nearly all of the map counts as outside"
                     : "rooms that no start reaches have more; they count as outside");
    if (doubt == SL_INSIDE_NONE)
        snprintf(text, SL_INSIDE_TEXT, "all of the map is solid ground, so nothing is inside");
    return SL_OK;
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

static void finish(sli_fault_search *search, sl_faults *out) {
    sl_faults faults = {.items = search->faults.items,
                        .points = search->points.items,
                        .point_count = (uint32_t)search->points.count,
                        .has_starts = search->map->start_count > 0,
                        .welded = search->welded,
                        .weld = search->weld,
                        .leaks_left = search->leaks_left};
    if (search->faults.count) qsort(faults.items, search->faults.count, sizeof(sl_fault), compare);
    faults.count = (uint32_t)search->faults.count;
    for (uint32_t i = 0; i < faults.count; i++) faults.counts[faults.items[i].kind]++;
    *out = faults;
}

/// The power of two below the median length of walls.
static double usual_length(const sl_map *map) {
    enum { LOWEST = -1100, STEPS = 2200 };
    uint32_t counts[STEPS] = {0};
    size_t all = 0, below = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        const double length = sli_apart(map->walls[i].a, map->walls[i].b);
        int exponent;
        if (!(length > 0)) continue;
        (void)frexp(length, &exponent);
        counts[exponent - LOWEST]++;
        all++;
    }
    int step = 0;
    while (all && below + counts[step] <= all / 2) below += counts[step++];
    return all ? ldexp(0.5, step + LOWEST) : INFINITY;
}

double sl_usual_gap(const sl_map *map) {
    const sl_box box = sl_map_bounds(map);
    return fmin(sli_apart(box.min, box.max) / 1000, usual_length(map) / 8);
}

/// Whether there is a gap or a leak.
static bool has_openings(const sli_fault_search *search) {
    for (size_t i = 0; i < search->faults.count; i++)
        if (search->faults.items[i].kind == SL_FAULT_GAP ||
            search->faults.items[i].kind == SL_FAULT_LEAK)
            return true;
    return false;
}

static sl_status find_all(sli_fault_search *search) {
    sl_clean_account account;
    SL_TRY(sl_map_copy(search->context, search->map, &search->clean));
    SL_TRY(sl_map_clean(search->context, &search->clean, search->options.clean, &account));
    search->weld = account.tolerance;
    search->moved = account.largest_move;
    SL_TRY(sli_wall_index_create(search->context, search->map, &search->index));
    SL_TRY(sli_find_wall_faults(search));
    SL_TRY(find_space_faults(search));
    return search->trial || !has_openings(search) ? SL_OK : sli_try_mending(search);
}

sl_status sli_find_faults(sl_context *context, const sl_map *map, const sl_space *space,
                          const sl_faults_options *options, bool trial, sl_faults *out) {
    const double usual = sl_usual_gap(map);
    sli_fault_search search = {
        .context = context, .map = map, .space = space, .options = *options, .trial = trial};
    if (!(options->gap >= 0 && options->thin >= 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "a gap or width cannot be less than 0");
    if (options->gap == 0) search.options.gap = usual;
    if (options->thin == 0) search.options.thin = usual;
    const sl_status status = find_all(&search);
    sl_map_destroy(context, &search.clean);
    sli_wall_index_destroy(context, &search.index);
    if (status == SL_OK) {
        finish(&search, out);
        return SL_OK;
    }
    sl_free(context, search.faults.items);
    sl_free(context, search.points.items);
    return status;
}

sl_status sl_find_faults(sl_context *context, const sl_map *map, const sl_space *space,
                         const sl_faults_options *options, sl_faults *out) {
    return sli_find_faults(context, map, space, options, false, out);
}
