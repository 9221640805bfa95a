/// The search for leaks: openings through which a start leads to the map's border.
///
/// A triangulation of the walls (triangulation.c) cuts the plan into free pieces. A side without a
/// wall is an opening, as wide as it is long. A triangle may also be narrow from a corner to a wall
/// opposite it. It is then cut in two at the foot of the corner, and the cut is an opening as well:
///
///          v                 from one half of the triangle to the other, the way is as wide as v
///          is
///         /|\                above the wall
///        / | \               .
///       a==f==b
///
/// Cells of a space do not do: they may reach over a gap. A Delaunay triangulation has the shortest
/// ways across narrow places among its sides and cuts.
///
/// Openings join pieces, the widest first (Kruskal 1956). The outside is a piece as well, behind
/// all of the border without walls. An opening that would join the start's set with that of the
/// outside is a leak, and stays shut. So in the end all leaks together part the start from the
/// outside, and each is the narrowest place of a way out. Holes in walls along the border are leaks
/// as well, wherever the start leads to them. The way is the shortest from piece to piece, made
/// straight where nothing is between. Time O(n log n), and O(n) for each start.
#include "space/faults/faults.h"

#include "geometry/orient.h"
#include "space/mesh.h"

#include <stdlib.h>

#define NONE UINT32_MAX

/// An opening between two free pieces; left and right as seen on the way from the first.
typedef struct opening {
    sl_point left, right;
    double width;
    uint32_t pieces[2];
    uint32_t number; ///< the order of equal widths
    bool hole;       ///< in walls along the border
    bool leaks;      ///< parts the start that is looked at from the outside
} opening;

/// A free piece has at most three openings.
typedef struct free_piece {
    uint32_t half; ///< a side of its triangle; of two pieces of one, both have the wall
    uint32_t count, openings[3];
} free_piece;

struct sli_leak_search {
    sli_fault_search *search;
    sli_triangulation triangles;
    uint32_t *of_half;           ///< the piece of each half-edge
    SL_ARRAY(free_piece) pieces; ///< the last one is the outside
    SL_ARRAY(opening) openings;  ///< the widest first
    uint32_t *parents;           ///< by piece, of the joined sets
    /// By piece, an opening: back to the start without leaks, or with them; on to the outside.
    uint32_t *from, *any, *to;
    uint32_t *queue;
    SL_ARRAY(uint32_t) way; ///< openings
};

// --- pieces and openings

static sl_point start_of(const sli_leak_search *s, uint32_t half) {
    return s->triangles.points.items[s->triangles.halves.items[half].from];
}

static sl_point end_of(const sli_leak_search *s, uint32_t half) {
    return s->triangles.points.items[sli_half_end(&s->triangles, half)];
}

static bool is_wall(const sli_leak_search *s, uint32_t half) {
    return s->triangles.labels[half / 2] != 0;
}

static uint32_t next_of(const sli_leak_search *s, uint32_t half) {
    return s->triangles.halves.items[half].next;
}

static sl_status add_piece(sli_leak_search *s, uint32_t half, uint32_t *number) {
    SL_TRY(SL_ARRAY_ROOM(s->search->context, &s->pieces, 1));
    *number = (uint32_t)s->pieces.count;
    s->pieces.items[s->pieces.count++] = (free_piece){.half = half};
    return SL_OK;
}

static sl_status add_opening(sli_leak_search *s, sl_point left, sl_point right, uint32_t from,
                             uint32_t to) {
    SL_TRY(SL_ARRAY_ROOM(s->search->context, &s->openings, 1));
    const uint32_t number = (uint32_t)s->openings.count++;
    s->openings.items[number] =
        (opening){left, right, sli_apart(left, right), {from, to}, number, false, false};
    return SL_OK;
}

/// Whether the way past a corner is narrow: the foot of the corner opposite a wall lies within it.
static bool find_foot(sl_point a, sl_point b, sl_point corner, sl_point *foot) {
    const double length = sli_apart(a, b);
    const sl_point unit = {(b.x - a.x) / length, (b.y - a.y) / length};
    const double at = (corner.x - a.x) * unit.x + (corner.y - a.y) * unit.y;
    if (!(at > 0 && at < length)) return false;
    *foot = (sl_point){a.x == b.x ? a.x : a.x + at * unit.x, a.y == b.y ? a.y : a.y + at * unit.y};
    return true;
}

/// Makes one or two pieces of a triangle.
static sl_status add_triangle(sli_leak_search *s, uint32_t half) {
    const uint32_t halves[3] = {half, next_of(s, half), next_of(s, next_of(s, half))};
    uint32_t piece = 0, other = 0, wall = NONE, walls = 0;
    sl_point foot;
    for (uint32_t i = 0; i < 3; i++) {
        if (!is_wall(s, halves[i])) continue;
        wall = i;
        walls++;
    }
    SL_TRY(add_piece(s, half, &piece));
    for (int i = 0; i < 3; i++) s->of_half[halves[i]] = piece;
    if (walls != 1) return SL_OK;
    const uint32_t base = halves[wall], after = halves[(wall + 1) % 3];
    const sl_point corner = end_of(s, after);
    if (!find_foot(start_of(s, base), end_of(s, base), corner, &foot)) return SL_OK;
    SL_TRY(add_piece(s, base, &other));
    s->pieces.items[piece].half = base;
    s->of_half[after] = other;
    return add_opening(s, corner, foot, piece, other);
}

/// Marks the ends of walls along the border.
static void mark_border(const sli_leak_search *s, sl_bits *walled) {
    for (uint32_t half = 0; half < s->triangles.halves.count; half++) {
        if (!sli_half_is_outside(&s->triangles, half) || !is_wall(s, half)) continue;
        sl_bits_add(walled, s->triangles.halves.items[half].from);
        sl_bits_add(walled, sli_half_end(&s->triangles, half));
    }
}

static sl_status add_sides(sli_leak_search *s, const sl_bits *walled) {
    uint32_t outside = 0;
    SL_TRY(add_piece(s, NONE, &outside));
    for (uint32_t half = 0; half < s->triangles.halves.count; half += 2) {
        if (is_wall(s, half)) continue;
        const bool turned = sli_half_is_outside(&s->triangles, half);
        const uint32_t in = half ^ turned, out = in ^ 1;
        const bool border = sli_half_is_outside(&s->triangles, out);
        SL_TRY(add_opening(s, end_of(s, in), start_of(s, in), s->of_half[in],
                           border ? outside : s->of_half[out]));
        s->openings.items[s->openings.count - 1].hole =
            border && sl_bits_has(walled, s->triangles.halves.items[in].from) &&
            sl_bits_has(walled, s->triangles.halves.items[out].from);
    }
    return SL_OK;
}

static int compare_openings(const void *left, const void *right) {
    const opening *a = left, *b = right;
    if (a->width != b->width) return a->width > b->width ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

static sl_status make_pieces(sli_leak_search *s) {
    sl_context *context = s->search->context;
    const size_t halves = s->triangles.halves.count;
    s->of_half = sl_alloc_array(context, halves, sizeof *s->of_half);
    if (!s->of_half) return SL_NO_MEMORY;
    for (size_t i = 0; i < halves; i++) s->of_half[i] = NONE;
    for (uint32_t i = 0; i < halves; i++)
        if (!sli_half_is_outside(&s->triangles, i) && s->of_half[i] == NONE)
            SL_TRY(add_triangle(s, i));
    sl_bits *walled =
        sl_alloc_array(context, sl_bits_words((uint32_t)s->triangles.points.count), sizeof *walled);
    if (!walled) return SL_NO_MEMORY;
    mark_border(s, walled);
    const sl_status status = add_sides(s, walled);
    sl_free(context, walled);
    SL_TRY(status);
    qsort(s->openings.items, s->openings.count, sizeof *s->openings.items, compare_openings);
    const uint32_t outside = (uint32_t)s->pieces.count - 1;
    for (uint32_t i = 0; i < s->openings.count; i++) {
        for (int k = 0; k < 2; k++) {
            free_piece *piece = &s->pieces.items[s->openings.items[i].pieces[k]];
            if (s->openings.items[i].pieces[k] != outside) piece->openings[piece->count++] = i;
        }
    }
    s->parents = sl_alloc_array(context, s->pieces.count, sizeof *s->parents);
    s->from = sl_alloc_array(context, s->pieces.count, sizeof *s->from);
    s->any = sl_alloc_array(context, s->pieces.count, sizeof *s->any);
    s->to = sl_alloc_array(context, s->pieces.count, sizeof *s->to);
    s->queue = sl_alloc_array(context, s->pieces.count, sizeof *s->queue);
    return s->parents && s->from && s->any && s->to && s->queue ? SL_OK : SL_NO_MEMORY;
}

static sl_status triangulate(sl_context *context, const sl_space *space, sli_triangulation *out) {
    sl_segment *walls = sl_alloc_array(context, space->wall_count, sizeof *walls);
    sli_planar graph = {0};
    if (!walls) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++)
        walls[i] = (sl_segment){space->walls[i].a, space->walls[i].b};
    sl_status status = sli_planar_make(context, "the map", walls, space->wall_count, 0, &graph);
    if (status == SL_OK) status = sli_triangulate(context, &graph, &space->bounds, out);
    sli_planar_destroy(context, &graph);
    sl_free(context, walls);
    return status;
}

sl_status sli_leak_search_begin(sli_fault_search *search, sli_leak_search **out) {
    sli_leak_search *s = sl_alloc(search->context, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    *out = s;
    *s = (sli_leak_search){.search = search};
    SL_TRY(triangulate(search->context, search->space, &s->triangles));
    return make_pieces(s);
}

void sli_leak_search_end(sl_context *context, sli_leak_search *s) {
    if (!s) return;
    sli_triangulation_destroy(context, &s->triangles);
    sl_free(context, s->of_half);
    sl_free(context, s->pieces.items);
    sl_free(context, s->openings.items);
    sl_free(context, s->parents);
    sl_free(context, s->from);
    sl_free(context, s->any);
    sl_free(context, s->to);
    sl_free(context, s->queue);
    sl_free(context, s->way.items);
    sl_free(context, s);
}

// --- the leaks of a start

/// Whether a point of a triangle that was cut in two lies in the second piece.
static bool is_in_second(const sli_leak_search *s, uint32_t base, sl_point point) {
    const sl_point a = start_of(s, base), b = end_of(s, base);
    sl_point foot;
    if (!find_foot(a, b, end_of(s, next_of(s, base)), &foot)) return false;
    return (point.x - foot.x) * (b.x - a.x) + (point.y - foot.y) * (b.y - a.y) > 0;
}

/// The piece that holds a point.
static uint32_t locate(const sli_leak_search *s, sl_point point) {
    uint32_t found = NONE;
    for (uint32_t i = 0; i + 1 < s->pieces.count && found == NONE; i++) {
        uint32_t half = s->pieces.items[i].half;
        bool holds = true;
        for (int k = 0; k < 3; k++, half = next_of(s, half))
            holds &= sli_orient(start_of(s, half), end_of(s, half), point) >= 0;
        const bool cut = holds && s->pieces.items[i + 1].half == half;
        if (holds) found = i + (cut && is_in_second(s, half, point));
    }
    return found;
}

/// Joins pieces, the widest opening first, and marks the leaks.
static void join(sli_leak_search *s, uint32_t start) {
    const uint32_t outside = (uint32_t)s->pieces.count - 1;
    for (uint32_t i = 0; i <= outside; i++) s->parents[i] = i;
    for (uint32_t i = 0; i < s->openings.count; i++) {
        opening *each = &s->openings.items[i];
        const uint32_t a = sl_root_of(s->parents, each->pieces[0]);
        const uint32_t b = sl_root_of(s->parents, each->pieces[1]);
        const uint32_t in = sl_root_of(s->parents, start), out = sl_root_of(s->parents, outside);
        each->leaks = (a == in && b == out) || (a == out && b == in);
        if (!each->leaks) s->parents[a] = b;
    }
}

/// Goes on from the pieces in the queue. `ways` gets the opening that each piece was reached by.
static void search_on(sli_leak_search *s, bool through_leaks, uint32_t *ways, uint32_t end) {
    const uint32_t outside = (uint32_t)s->pieces.count - 1;
    for (uint32_t begin = 0; begin < end; begin++) {
        const free_piece *piece = &s->pieces.items[s->queue[begin]];
        for (uint32_t i = 0; i < piece->count; i++) {
            const opening *each = &s->openings.items[piece->openings[i]];
            const uint32_t next = each->pieces[each->pieces[0] == s->queue[begin]];
            if ((each->leaks && !through_leaks) || next == outside || ways[next] != NONE) continue;
            ways[next] = piece->openings[i];
            s->queue[end++] = next;
        }
    }
}

/// Finds the ways from the start to all pieces of its set, and from all others to the outside.
static void find_ways(sli_leak_search *s, uint32_t start) {
    const uint32_t outside = (uint32_t)s->pieces.count - 1;
    for (uint32_t i = 0; i <= outside; i++) s->from[i] = s->any[i] = s->to[i] = NONE;
    // The start's own value is not used: it only keeps the search from coming back.
    s->from[start] = s->any[start] = 0;
    s->queue[0] = start;
    search_on(s, false, s->from, 1);
    s->queue[0] = start;
    search_on(s, true, s->any, 1);
    uint32_t end = 0;
    for (uint32_t i = 0; i < s->openings.count; i++) {
        const opening *each = &s->openings.items[i];
        if (each->pieces[1] != outside || each->leaks || s->to[each->pieces[0]] != NONE) continue;
        s->to[each->pieces[0]] = i;
        s->queue[end++] = each->pieces[0];
    }
    search_on(s, false, s->to, end);
}

// --- the way of a leak

static sl_point middle_of(const opening *each) {
    return (sl_point){each->left.x / 2 + each->right.x / 2, each->left.y / 2 + each->right.y / 2};
}

static sl_status add_to_way(sli_leak_search *s, uint32_t number) {
    SL_TRY(SL_ARRAY_ROOM(s->search->context, &s->way, 1));
    s->way.items[s->way.count++] = number;
    return SL_OK;
}

/// The openings on the way to a leak, through it, and on to the border. *at is the leak's place.
static sl_status gather_way(sli_leak_search *s, uint32_t leak, uint32_t start, size_t *at) {
    const opening *openings = s->openings.items;
    const uint32_t outside = (uint32_t)s->pieces.count - 1;
    const uint32_t *back = openings[leak].leaks ? s->from : s->any;
    const bool second = back[openings[leak].pieces[0]] == NONE;
    s->way.count = 0;
    for (uint32_t piece = openings[leak].pieces[second]; piece != start;) {
        const opening *each = &openings[back[piece]];
        SL_TRY(add_to_way(s, back[piece]));
        piece = each->pieces[each->pieces[0] == piece];
    }
    for (size_t i = 0, j = s->way.count; i + 1 < j; i++) {
        const uint32_t swapped = s->way.items[i];
        s->way.items[i] = s->way.items[--j];
        s->way.items[j] = swapped;
    }
    *at = s->way.count;
    SL_TRY(add_to_way(s, leak));
    for (uint32_t piece = openings[leak].pieces[!second]; piece != outside;) {
        const opening *each = &openings[s->to[piece]];
        SL_TRY(add_to_way(s, s->to[piece]));
        piece = each->pieces[each->pieces[0] == piece];
    }
    return SL_OK;
}

/// Whether the straight way between two points passes through openings of the way.
static bool is_straight(const sli_leak_search *s, sl_point a, sl_point b, size_t first,
                        size_t end) {
    for (size_t i = first; i < end; i++) {
        const opening *each = &s->openings.items[s->way.items[i]];
        if (sli_orient(a, b, each->left) * sli_orient(a, b, each->right) >= 0) return false;
    }
    return true;
}

static sl_status add_point(sli_fault_search *search, sl_point point) {
    SL_TRY(SL_ARRAY_ROOM(search->context, &search->points, 1));
    search->points.items[search->points.count++] = point;
    return SL_OK;
}

/// Adds points from `at` to the middle of way[last], after the openings from `first` on.
static sl_status add_part(sli_leak_search *s, sl_point at, size_t first, size_t last) {
    enum { FARTHEST = 64 };
    while (first <= last) {
        size_t best = first;
        for (size_t i = first + 1; i <= last && i < first + FARTHEST; i++)
            if (is_straight(s, at, middle_of(&s->openings.items[s->way.items[i]]), first, i))
                best = i;
        at = middle_of(&s->openings.items[s->way.items[best]]);
        SL_TRY(add_point(s->search, at));
        first = best + 1;
    }
    return SL_OK;
}

// --- a leak as a fault

static sl_status add_leak(sli_leak_search *s, uint32_t number, uint32_t piece, sl_point start) {
    sli_fault_search *search = s->search;
    const opening *each = &s->openings.items[number];
    const sl_point middle = middle_of(each), left = each->left, right = each->right;
    const bool turned = left.x != right.x ? right.x < left.x : right.y < left.y;
    const sl_segment at_ends = turned ? (sl_segment){right, left} : (sl_segment){left, right};
    sl_fault leak = {.kind = SL_FAULT_LEAK,
                     .at = at_ends,
                     .size = each->width,
                     .cell = sl_space_locate(search->space, middle),
                     .first_point = (uint32_t)search->points.count};
    size_t at;
    SL_TRY(sli_wall_as_read(search, at_ends.a, 0, &leak.walls[0]));
    SL_TRY(sli_wall_as_read(search, at_ends.b, 0, &leak.walls[1]));
    SL_TRY(gather_way(s, number, piece, &at));
    SL_TRY(add_point(search, start));
    SL_TRY(add_part(s, start, 0, at));
    if (at + 1 < s->way.count) SL_TRY(add_part(s, middle, at + 1, s->way.count - 1));
    leak.point_count = (uint32_t)search->points.count - leak.first_point;
    return sli_add_fault(search, leak);
}

sl_status sli_find_leaks_of(sli_leak_search *s, sl_point start) {
    const uint32_t piece = locate(s, start);
    if (piece == NONE) return SL_OK;
    join(s, piece);
    find_ways(s, piece);
    for (uint32_t i = 0; i < s->openings.count; i++) {
        const opening *each = &s->openings.items[i];
        if (each->leaks || (each->hole && s->any[each->pieces[0]] != NONE))
            SL_TRY(add_leak(s, i, piece, start));
    }
    return SL_OK;
}
