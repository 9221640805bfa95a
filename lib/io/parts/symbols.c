/// Symbols of floor plans by their shape.
///
///        tip
///         |\ .          A door is drawn open: a leaf, and the arc that it swings along. The leaf
///         is
///    leaf |    ` .      as long as the arc's radius, and stands on its centre, the hinge. So no
///         |       \     wall is taken for a leaf unless an arc of up to 120 degrees ends at its
///   ------+        +--- tip. The leaf may be a thin rectangle.
///       hinge    latch
///
/// If both radii are drawn, it is a door only where it is small for the plan: a round room has such
/// an outline too. The latch is then where more ends of other walls are.
///
/// Hatching and steps are lines that the file has one after another: parallel, at one distance,
/// that is narrower than any room.
///
/// Sizes are held against that of the plan, without the few walls farthest out, since files often
/// name a wrong unit. Nothing here decides what is seen: only which lines are walls.
#include "io/parts/symbols.h"

#include "geometry/length.h"

#include "sightline/support.h"

#include <stdlib.h>

// --- points, found by where they are

enum { MOST_NEAR = 256 };
#define NONE SIZE_MAX

static size_t square_of(const sli_near *near, double column, double row) {
    uint64_t bits[2];
    column += 0.0, row += 0.0; // one zero
    memcpy(&bits[0], &column, sizeof column);
    memcpy(&bits[1], &row, sizeof row);
    sl_random hash = {bits[0] * 0x9e3779b97f4a7c15u ^ bits[1]};
    return (size_t)sl_random_next(&hash) & near->mask;
}

sl_status sli_near_make(sl_context *context, const sl_point *points, size_t count, double reach,
                        sli_near *out) {
    out->points = points;
    out->cell = reach;
    out->mask = 1;
    while (out->mask < count) out->mask *= 2;
    out->heads = sl_alloc_array(context, out->mask, sizeof *out->heads);
    out->next = sl_alloc_array(context, count, sizeof *out->next);
    if (!out->heads || !out->next) return SL_NO_MEMORY;
    for (size_t i = 0; i < out->mask; i++) out->heads[i] = NONE;
    out->mask--;
    for (size_t i = 0; i < count; i++) {
        const size_t square =
            square_of(out, floor(points[i].x / reach), floor(points[i].y / reach));
        out->next[i] = out->heads[square];
        out->heads[square] = i;
    }
    return SL_OK;
}

void sli_near_destroy(sl_context *context, sli_near *near) {
    sl_free(context, near->heads);
    sl_free(context, near->next);
}

void sli_near_each(const sli_near *near, sl_point at, void *user,
                   void (*take)(void *user, size_t point)) {
    for (int i = 0; i < 9; i++) {
        const double column = floor(at.x / near->cell) + i % 3 - 1;
        const double row = floor(at.y / near->cell) + (double)(i / 3) - 1;
        size_t point = near->heads[square_of(near, column, row)];
        for (int n = 0; point != NONE && n < MOST_NEAR; n++, point = near->next[point])
            if (floor(near->points[point].x / near->cell) == column &&
                floor(near->points[point].y / near->cell) == row)
                take(user, point);
    }
}

// --- the walls

typedef struct finder {
    sl_context *context;
    const sl_map *map;
    const unsigned char *means;
    sli_meaning hatching;
    bool doors_only;
    double size; ///< of the plan
    sli_symbols *out;
} finder;

static sl_point minus(sl_point a, sl_point b) {
    return (sl_point){a.x - b.x, a.y - b.y};
}

static double apart(sl_point a, sl_point b) {
    return sli_length(a.x - b.x, a.y - b.y);
}

static sl_point along(const sl_wall *wall) {
    return minus(wall->b, wall->a);
}

static double length_of(const sl_wall *wall) {
    return apart(wall->a, wall->b);
}

static bool may_swing(const finder *f, size_t wall) {
    const sli_meaning means = f->means[wall];
    return means == SLI_MEANS_DOOR ||
           (!f->doors_only &&
            (means == SLI_MEANS_NOTHING || means == SLI_MEANS_WALL || means == SLI_MEANS_WINDOW));
}

/// Whether a wall begins where the one before it ends, on layers of one meaning.
static bool follows(const finder *f, size_t wall) {
    const sl_wall *walls = f->map->walls;
    return wall > 0 && wall < f->map->wall_count && f->means[wall] == f->means[wall - 1] &&
           walls[wall].a.x == walls[wall - 1].b.x && walls[wall].a.y == walls[wall - 1].b.y;
}

/// Whether a wall goes on from the one before, in one shape.
static bool goes_on(const finder *f, size_t wall) {
    return follows(f, wall) && f->map->walls[wall].line == f->map->walls[wall - 1].line;
}

/// The longer side of what lies between a twentieth of the walls and the last twentieth.
static sl_status find_size(finder *f) {
    enum { SAMPLE = 4096 };
    const size_t walls = f->map->wall_count, step = walls / SAMPLE + 1;
    double *places = sl_alloc_array(f->context, walls / step + 1, sizeof *places);
    if (!places) return SL_NO_MEMORY;
    for (int axis = 0; axis < 2; axis++) {
        size_t count = 0;
        for (size_t i = 0; i < walls; i += step)
            places[count++] = axis ? f->map->walls[i].a.y : f->map->walls[i].a.x;
        qsort(places, count, sizeof *places, sl_compare_numbers);
        f->size = fmax(f->size, places[count - 1 - count / 20] - places[count / 20]);
    }
    sl_free(f->context, places);
    return SL_OK;
}

// --- arcs, as the chords that they are drawn by

/// An arc and the walls that may be leaves of it, by the end of the arc that they reach.
typedef struct door_arc {
    size_t first, count; ///< its walls
    sl_point centre, ends[2];
    double radius;
    bool is_door;   ///< by its layer
    sl_point hinge; ///< the end of a leaf that is nearest to the centre
    size_t leaves[2];
    size_t nearby[2]; ///< ends of other walls
} door_arc;

typedef struct arc_list {
    finder *f;
    SL_ARRAY(door_arc) arcs;
    double widest;     ///< radius
    sl_bits *part;     ///< by wall: a chord of an arc
    sl_point *at;      ///< of arcs: the centres; of ends: two an arc
    size_t base;       ///< the arc of the first point
    size_t wall;       ///< at hand
    sl_point from, to; ///< its ends
} arc_list;

/// How many walls from `first` on go round by even steps; arcs may be drawn as lines one by one.
static size_t count_chords(const finder *f, size_t first) {
    const sl_wall *walls = f->map->walls;
    double turn = 0;
    size_t count = 1;
    for (; follows(f, first + count); count++) {
        const sl_wall *before = &walls[first + count - 1], *wall = &walls[first + count];
        const double a = length_of(before), b = length_of(wall);
        const double sine = sli_cross(along(before), along(wall)) / (a * b);
        if (!(b < 1.3 * a && a < 1.3 * b) || !(sli_dot(along(before), along(wall)) > 0)) break;
        if (!(fabs(sine) > 0.03 && fabs(sine) < 0.6)) break;
        if (count > 1 && !(sine / turn > 0.6 && sine / turn < 1.6)) break;
        turn = sine;
    }
    return count;
}

/// The circle through three points; false where they are in line.
static bool centre_of(sl_point a, sl_point b, sl_point c, sl_point *centre) {
    const sl_point u = minus(b, a), v = minus(c, a);
    const double area = 2 * sli_cross(u, v), uu = sli_dot(u, u), vv = sli_dot(v, v);
    *centre = (sl_point){a.x + (v.y * uu - u.y * vv) / area, a.y + (u.x * vv - v.x * uu) / area};
    return isfinite(centre->x) && isfinite(centre->y);
}

/// Whether the walls are an arc that a door may swing along.
static bool make_arc(const finder *f, size_t first, size_t count, door_arc *out) {
    const sl_wall *walls = f->map->walls + first;
    const sl_point middle = walls[count / 2].a;
    *out = (door_arc){.first = first,
                      .count = count,
                      .ends = {walls[0].a, walls[count - 1].b},
                      .is_door = f->means[first] == SLI_MEANS_DOOR};
    if (!centre_of(out->ends[0], middle, out->ends[1], &out->centre)) return false;
    const sl_point from = minus(out->ends[0], out->centre), to = minus(out->ends[1], out->centre);
    const sl_point top = minus(middle, out->centre);
    const double radius = out->radius = sli_length(from.x, from.y);
    if (!(radius > 0 && (out->is_door || radius < 0.4 * f->size))) return false;
    for (size_t i = 1; i < count; i++)
        if (!(fabs(apart(walls[i].a, out->centre) - radius) < 0.03 * radius)) return false;
    // From 28 to 120 degrees, the short way round.
    const double cosine = sli_dot(from, to) / (radius * radius);
    return cosine > -0.51 && cosine < 0.883 && sli_dot(top, from) + sli_dot(top, to) > 0;
}

static sl_status find_arcs(arc_list *list) {
    const finder *f = list->f;
    for (size_t i = 0, count; i < f->map->wall_count; i += count) {
        count = may_swing(f, i) ? count_chords(f, i) : 1;
        door_arc one;
        if (count < 3) {
            count = 1;
            continue;
        }
        for (size_t j = i; j < i + count; j++) sl_bits_add(list->part, j);
        if (!make_arc(f, i, count, &one)) continue;
        SL_TRY(SL_ARRAY_ROOM(f->context, &list->arcs, 1));
        list->arcs.items[list->arcs.count++] = one;
    }
    return SL_OK;
}

// --- leaves

/// How far apart what should meet may be, in radii: frames of doors, and the thickness of leaves.
#define SLACK 0.15

/// Takes the walls of a leaf: the whole outline where it is a thin rectangle.
static void take_leaf(const finder *f, size_t wall) {
    const sl_wall *walls = f->map->walls;
    size_t first = wall, end = wall + 1;
    while (goes_on(f, first) && end - first < 7) first--;
    while (goes_on(f, end) && end - first < 7) end++;
    const bool closed = end - first < 7 && walls[first].a.x == walls[end - 1].b.x &&
                        walls[first].a.y == walls[end - 1].b.y;
    if (!closed) first = wall, end = wall + 1;
    for (size_t i = first; i < end; i++) sl_bits_add(f->out->gone, i);
}

/// The end of the arc that the wall at hand joins with the centre; -1 for none.
static int end_reached(const arc_list *list, const door_arc *arc) {
    const double slack = SLACK * arc->radius;
    if (!(fabs(apart(list->from, list->to) - arc->radius) <= slack)) return -1;
    if (apart(list->from, arc->centre) > slack) return -1;
    for (int end = 0; end < 2; end++)
        if (apart(list->to, arc->ends[end]) <= slack) return end;
    return -1;
}

static void count_leaf(void *user, size_t number) {
    arc_list *list = user;
    door_arc *arc = &list->arcs.items[list->base + number];
    const int end = end_reached(list, arc);
    if (end < 0) return;
    const bool first = !arc->leaves[0] && !arc->leaves[1];
    if (first || apart(list->from, arc->centre) < apart(arc->hinge, arc->centre))
        arc->hinge = list->from;
    arc->leaves[end]++;
}

static bool is_small(const arc_list *list, const door_arc *arc) {
    return arc->is_door || arc->radius <= 0.2 * list->f->size;
}

static bool is_swing(const arc_list *list, const door_arc *arc) {
    if (arc->leaves[0] && arc->leaves[1]) return is_small(list, arc);
    return arc->leaves[0] || arc->leaves[1];
}

static void drop_leaf(void *user, size_t number) {
    arc_list *list = user;
    const door_arc *arc = &list->arcs.items[list->base + number];
    if (is_swing(list, arc) && end_reached(list, arc) >= 0) take_leaf(list->f, list->wall);
}

static void count_end(void *user, size_t number) {
    arc_list *list = user;
    door_arc *arc = &list->arcs.items[list->base + number / 2];
    arc->nearby[number % 2] += apart(list->from, arc->ends[number % 2]) <= 0.25 * arc->radius;
}

/// Hands the points near each end of the straight walls to `take`; `gone` says whether those of
/// leaves count.
static sl_status each_wall(arc_list *list, size_t points, double reach, bool gone,
                           void (*take)(void *user, size_t point)) {
    const finder *f = list->f;
    sli_near near = {0};
    sl_status status = sli_near_make(f->context, list->at, points, reach, &near);
    for (size_t i = 0; status == SL_OK && i < f->map->wall_count; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(f->context);
        if (!may_swing(f, i) || sl_bits_has(list->part, i)) continue;
        if (!gone && sl_bits_has(f->out->gone, i)) continue;
        const sl_wall *wall = &f->map->walls[i];
        list->wall = i;
        for (int end = 0; end < 2; end++) {
            list->from = end ? wall->b : wall->a;
            list->to = end ? wall->a : wall->b;
            sli_near_each(&near, list->from, list, take);
        }
    }
    sli_near_destroy(f->context, &near);
    return status;
}

/// Which end of each arc is the tip.
static sl_status name_ends(arc_list *list) {
    sli_symbols *out = list->f->out;
    for (size_t i = 0; i < list->arcs.count; i++) {
        const door_arc *arc = &list->arcs.items[i];
        if (!is_swing(list, arc)) continue;
        out->doors++;
        for (size_t j = 0; j < arc->count; j++) sl_bits_add(out->gone, arc->first + j);
        const size_t *by = arc->leaves;
        if (by[0] && by[1]) by = arc->nearby;
        if (by[0] == by[1]) {
            SL_TRY(SL_ARRAY_ROOM(list->f->context, &out->unsure, 1));
            out->unsure.items[out->unsure.count++] =
                (sli_swing){arc->hinge, arc->ends[0], arc->ends[1], arc->radius};
            continue;
        }
        // A leaf reaches the tip; other walls, the latch.
        const int tip = (by == arc->leaves) == (by[0] > by[1]) ? 0 : 1;
        SL_TRY(SL_ARRAY_ROOM(list->f->context, &out->swings, 1));
        out->swings.items[out->swings.count++] =
            (sli_swing){arc->hinge, arc->ends[tip], arc->ends[1 - tip], arc->radius};
    }
    return SL_OK;
}

/// Wide arcs first, else as in the file.
static int compare_radii(const void *left, const void *right) {
    const door_arc *a = left, *b = right;
    if (a->radius != b->radius) return a->radius < b->radius ? 1 : -1;
    return (a->first > b->first) - (a->first < b->first);
}

static int compare_places(const void *left, const void *right) {
    const door_arc *a = left, *b = right;
    return (a->first > b->first) - (a->first < b->first);
}

/// Holds the walls against arcs of much the same radius.
static sl_status find_leaves_of(arc_list *list, size_t first, size_t count) {
    const door_arc *arcs = list->arcs.items + first;
    list->base = first;
    for (size_t i = 0; i < count; i++) list->at[i] = arcs[i].centre;
    SL_TRY(each_wall(list, count, SLACK * arcs[0].radius, true, count_leaf));
    SL_TRY(each_wall(list, count, SLACK * arcs[0].radius, true, drop_leaf));
    for (size_t i = 0; i < 2 * count; i++) list->at[i] = arcs[i / 2].ends[i % 2];
    return each_wall(list, 2 * count, 0.25 * arcs[0].radius, false, count_end);
}

/// One wide arc must not put all doors into one square. So arcs go by their radius, in a few
/// groups; the last one has the rest.
static sl_status find_leaves(arc_list *list) {
    enum { GROUPS = 12 };
    const size_t count = list->arcs.count;
    list->at = sl_alloc_array(list->f->context, 2 * count, sizeof *list->at);
    if (!list->at) return SL_NO_MEMORY;
    qsort(list->arcs.items, count, sizeof *list->arcs.items, compare_radii);
    for (size_t first = 0, end, groups = 1; first < count; first = end, groups++) {
        end = first + 1;
        while (end < count && (groups == GROUPS ||
                               list->arcs.items[end].radius > list->arcs.items[first].radius / 4))
            end++;
        SL_TRY(find_leaves_of(list, first, end - first));
    }
    qsort(list->arcs.items, count, sizeof *list->arcs.items, compare_places);
    return name_ends(list);
}

static sl_status find_swings(finder *f) {
    arc_list list = {.f = f};
    list.part = sl_alloc_array(f->context, sl_bits_words(f->map->wall_count), sizeof(sl_bits));
    sl_status status = list.part ? find_arcs(&list) : SL_NO_MEMORY;
    if (status == SL_OK && list.arcs.count) status = find_leaves(&list);
    sl_free(f->context, list.part);
    sl_free(f->context, list.at);
    sl_free(f->context, list.arcs.items);
    return status;
}

// --- hatching and steps

/// Whether the wall is a line by itself that may be hatching.
static bool may_hatch(const finder *f, size_t wall) {
    return f->means[wall] == f->hatching && !goes_on(f, wall) && !goes_on(f, wall + 1) &&
           !sl_bits_has(f->out->gone, wall);
}

/// How far the wall stands beside the one before it, at its left; 0 where they are not parallel or
/// do not stand side by side.
static double beside(const sl_wall *before, const sl_wall *wall) {
    const sl_point u = along(before), v = along(wall), w = minus(wall->a, before->a);
    const double length = sli_length(u.x, u.y);
    if (!(fabs(sli_cross(u, v)) <= 0.01 * length * sli_length(v.x, v.y))) return 0;
    // Both as shares of the first: where the second begins and ends.
    const double a = sli_dot(u, w) / (length * length), b = a + sli_dot(u, v) / (length * length);
    if (fmax(a, b) <= 0 || fmin(a, b) >= 1) return 0;
    return sli_cross(u, w) / length;
}

static void find_hatching(finder *f, double widest) {
    enum { LEAST = 8 };
    const sl_wall *walls = f->map->walls;
    for (size_t first = 0, end; first < f->map->wall_count; first = end) {
        double step = 0;
        end = first + 1;
        if (!may_hatch(f, first)) continue;
        for (; end < f->map->wall_count && f->means[end] == f->means[first]; end++) {
            if (!may_hatch(f, end)) break;
            double next = beside(&walls[end - 1], &walls[end]);
            // Hatching may go to and fro.
            if (sli_dot(along(&walls[first]), along(&walls[end - 1])) < 0) next = -next;
            const bool even = step == 0 || fabs(next - step) <= 0.05 * fabs(step);
            if (next == 0 || !even || fabs(next) > widest) break;
            if (fabs(next) > length_of(&walls[end])) break;
            if (step == 0) step = next;
        }
        const size_t count = end - first;
        if (count >= LEAST)
            for (size_t i = first; i < end; i++) sl_bits_add(f->out->gone, i);
        else if (count > 1)
            end--; // the last one may begin the next
        if (count >= LEAST) f->out->lines += count;
    }
}

// --- all

sl_status sli_symbols_find(sl_context *context, const sl_map *map, const unsigned char *means,
                           sli_meaning hatching, bool doors_only, double metre, sli_symbols *out) {
    finder f = {context, map, means, hatching, doors_only, 0, out};
    if (!map->wall_count) return SL_OK;
    out->gone = sl_alloc_array(context, sl_bits_words(map->wall_count), sizeof *out->gone);
    if (!out->gone) return SL_NO_MEMORY;
    SL_TRY(find_size(&f));
    SL_TRY(find_swings(&f));
    for (size_t i = 0; i < map->wall_count; i++) out->leaves += sl_bits_has(out->gone, i);
    // A unit is believed if the plan is as large as a building.
    const bool believed = metre > 0 && f.size > 4 * metre && f.size < 400 * metre;
    if (hatching != SLI_MEANINGS) find_hatching(&f, believed ? 0.35 * metre : f.size / 200);
    return SL_OK;
}

void sli_symbols_destroy(sl_context *context, sli_symbols *symbols) {
    sl_free(context, symbols->gone);
    sl_free(context, symbols->swings.items);
    sl_free(context, symbols->unsure.items);
}
