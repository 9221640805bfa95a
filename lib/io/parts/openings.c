/// Openings over walls that go on beneath them.
///
///              wall                 A plan may be drawn in two layers: walls from end to end, and
///     ====+==============+====      over them doors, or bars in the colour of the paper. To the
///         |   opening    |          eye they are gaps. A wall is cut where it goes through the
///     ====+==============+====      opening along its length, from end to end. A wall that ends
///                                   within, or crosses it, is left as it is: a leaf, a threshold,
///     ----+              +----      a jamb. If two walls go through, they are the faces of one,
///     and
///         |              |          jambs close it at both ends.
///     ----+              +----
///
/// Places of cuts are rounded. All else of the drawing stays as it is.
#include "io/parts/openings.h"

#include "geometry/length.h"
#include "space/index.h"

#include <math.h>
#include <stdlib.h>

/// As shares of an opening's length: how far from its ends a wall may end, and how far beside a
/// line a wall may lie. As a share of its half width: where a wall lies in it and not along a side.
#define REACH  0.02
#define BESIDE 0.02
#define WITHIN 0.9
/// As a share of an opening's length: how much nearer one end of a face may be than the other.
#define LEVEL 0.03

void sli_openings_destroy(sl_context *context, sli_openings *openings) {
    sl_free(context, openings->items.items);
    sl_free(context, openings->cuts.items);
    sl_free(context, openings->jambs.items);
    *openings = (sli_openings){0};
}

// --- which there are

static sl_point middle(sl_point a, sl_point b) {
    return (sl_point){a.x / 2 + b.x / 2, a.y / 2 + b.y / 2};
}

static double apart(sl_point a, sl_point b) {
    return sli_length(a.x - b.x, a.y - b.y);
}

static sl_status add(sl_context *context, sli_opening one, double least, double most,
                     sli_openings *out) {
    const double length = apart(one.from, one.to);
    if (!(length >= least && length <= most)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &out->items, 1));
    out->items.items[out->items.count++] = one;
    return SL_OK;
}

sl_status sli_openings_add(sl_context *context, const sl_wall *walls, size_t count, double wide,
                           double least, double most, size_t below, size_t shape,
                           sli_openings *out) {
    if (count == 1) {
        const double half = fmax(wide / 2, BESIDE * apart(walls[0].a, walls[0].b));
        const sli_opening line = {
            .from = walls[0].a, .to = walls[0].b, .half = half, .below = below, .shape = shape};
        return add(context, line, least, most, out);
    }
    if (count != 4 || walls[3].b.x != walls[0].a.x || walls[3].b.y != walls[0].a.y) return SL_OK;
    for (int i = 0; i < 3; i++)
        if (walls[i].b.x != walls[i + 1].a.x || walls[i].b.y != walls[i + 1].a.y) return SL_OK;
    const sl_point a = walls[0].a, b = walls[1].a, c = walls[2].a, d = walls[3].a;
    const double sides[2] = {apart(a, b), apart(b, c)}, across = apart(a, c);
    // A rectangle: its diagonals are alike, and meet in the middle.
    if (fabs(apart(b, d) - across) > 0.05 * across ||
        apart(middle(a, c), middle(b, d)) > 0.05 * across)
        return SL_OK;
    const sl_point ends[2][2] = {{middle(d, a), middle(b, c)}, {middle(a, b), middle(c, d)}};
    for (int i = 0; i < 2; i++) {
        if (sides[i] < 0.7 * sides[1 - i]) continue;
        const sli_opening box = {.from = ends[i][0],
                                 .to = ends[i][1],
                                 .half = WITHIN * sides[1 - i] / 2,
                                 .box = true,
                                 .below = below,
                                 .shape = shape};
        SL_TRY(add(context, box, least, most, out));
    }
    return SL_OK;
}

// --- what they cut

/// Whether a wall runs along an opening from end to end, and where. `left`: how far at the left of
/// the opening it is there, at its own first end and at its second.
static bool runs_along(const sli_opening *o, const sl_wall *wall, sli_opening_cut *cut,
                       double left[2]) {
    const double length = apart(o->from, o->to);
    const sl_point along = {(o->to.x - o->from.x) / length, (o->to.y - o->from.y) / length};
    const sl_point a = {wall->a.x - o->from.x, wall->a.y - o->from.y};
    const sl_point b = {wall->b.x - o->from.x, wall->b.y - o->from.y};
    const double from = sli_dot(a, along), to = sli_dot(b, along);
    const double beside = sli_cross(along, a), turn = sli_cross(along, b) - beside;
    const bool back = from > to;
    if (fmin(from, to) > REACH * length || fmax(from, to) < (1 - REACH) * length) return false;
    const double begin = fmax(((back ? length : 0) - from) / (to - from), 0);
    const double end = fmin(((back ? 0 : length) - from) / (to - from), 1);
    if (!(begin < end)) return false;
    left[0] = beside + begin * turn;
    left[1] = beside + end * turn;
    cut->begin = begin;
    cut->end = end;
    cut->at.a = wall->a;
    cut->at.b = wall->b;
    if (begin > 0)
        cut->at.a = (sl_point){wall->a.x + begin * (wall->b.x - wall->a.x),
                               wall->a.y + begin * (wall->b.y - wall->a.y)};
    if (end < 1)
        cut->at.b = (sl_point){wall->a.x + end * (wall->b.x - wall->a.x),
                               wall->a.y + end * (wall->b.y - wall->a.y)};
    return true;
}

static sl_status add_jamb(sl_context *context, sl_point a, sl_point b, uint32_t line,
                          sli_openings *openings) {
    if (a.x == b.x && a.y == b.y) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &openings->jambs, 1));
    openings->jambs.items[openings->jambs.count++] = (sl_wall){.a = a, .b = b, .line = line};
    return SL_OK;
}

/// Jambs between the outermost walls that an opening cuts, from its cut `first` on.
static sl_status close_core(sl_context *context, const sl_map *map, sli_openings *openings,
                            size_t first) {
    const sli_opening_cut *cuts = openings->cuts.items;
    size_t right = first, left = first;
    for (size_t i = first + 1; i < openings->cuts.count; i++) {
        if (cuts[i].left < cuts[right].left) right = i;
        if (cuts[i].left > cuts[left].left) left = i;
    }
    if (left == right) return SL_OK;
    const size_t begin = left < right ? left : right, end = left < right ? right : left;
    const sl_segment one = cuts[begin].at, other = cuts[end].at;
    const sl_point u = {one.b.x - one.a.x, one.b.y - one.a.y};
    const sl_point v = {other.b.x - other.a.x, other.b.y - other.a.y};
    const bool same = sli_dot(u, v) > 0;
    const uint32_t line = map->walls[cuts[begin].wall].line;
    SL_TRY(add_jamb(context, one.a, same ? other.a : other.b, line, openings));
    return add_jamb(context, one.b, same ? other.b : other.a, line, openings);
}

static int compare_cuts(const void *left, const void *right) {
    const sli_opening_cut *a = left, *b = right;
    if (a->wall != b->wall) return a->wall < b->wall ? -1 : 1;
    if (a->begin != b->begin) return a->begin < b->begin ? -1 : 1;
    return (a->opening > b->opening) - (a->opening < b->opening);
}

static sl_status take_cut(sl_context *context, sli_openings *openings, const sli_opening_cut *cut) {
    sli_opening *o = &openings->items.items[cut->opening];
    SL_TRY(SL_ARRAY_ROOM(context, &openings->cuts, 1));
    openings->cuts.items[openings->cuts.count++] = *cut;
    if (!o->cuts) o->at = cut->at;
    o->cuts = true;
    return SL_OK;
}

/// Cuts the walls that run along an opening, and lie from `least` to `most` at its left.
static sl_status cut_within(sl_context *context, const sl_map *map, const sl_bits *kept,
                            const sli_box_list *near, sli_openings *openings, size_t number,
                            double least, double most) {
    for (size_t i = 0; i < near->count; i++) {
        const sli_opening *o = &openings->items.items[number];
        sli_opening_cut cut = {.wall = near->items[i], .opening = number};
        double left[2];
        if (cut.wall >= o->below || !sl_bits_has(kept, cut.wall) ||
            !runs_along(o, &map->walls[cut.wall], &cut, left) || fmin(left[0], left[1]) < least ||
            fmax(left[0], left[1]) > most)
            continue;
        cut.left = left[0] / 2 + left[1] / 2;
        SL_TRY(take_cut(context, openings, &cut));
    }
    return SL_OK;
}

/// How far from `middle`, which is so far at the left of an opening, the nearest walls are that run
/// along it beyond its width: at its right, and at its left. INFINITY for none.
static void find_beside(const sl_map *map, const sl_bits *kept, const sli_box_list *near,
                        const sli_opening *o, double middle, double away[2]) {
    away[0] = away[1] = INFINITY;
    for (size_t i = 0; i < near->count; i++) {
        const size_t wall = near->items[i];
        sli_opening_cut cut;
        double left[2];
        if (wall >= o->below || !sl_bits_has(kept, wall) ||
            !runs_along(o, &map->walls[wall], &cut, left))
            continue;
        const double at = left[0] / 2 + left[1] / 2;
        const bool level = fabs(left[0] - left[1]) <= LEVEL * apart(o->from, o->to);
        if (level && fabs(at) > o->half)
            away[at > middle] = fmin(away[at > middle], fabs(at - middle));
    }
}

/// Cuts both faces of a wall that a door lies between, or the other face of one whose first face a
/// line cuts: all cuts from `first` on lie in one line. Several walls may lie in it.
static sl_status cut_faces(sl_context *context, const sl_map *map, const sl_bits *kept,
                           const sli_box_list *near, sli_openings *openings, size_t number,
                           size_t first) {
    const sli_opening o = openings->items.items[number];
    const double slack = BESIDE * apart(o.from, o.to);
    const bool none = openings->cuts.count == first;
    const double middle = none ? 0 : openings->cuts.items[first].left;
    double away[2];
    if (!(o.core > 0) || (!none && o.box)) return SL_OK;
    for (size_t i = first; i < openings->cuts.count; i++)
        if (fabs(openings->cuts.items[i].left - middle) > slack) return SL_OK;
    find_beside(map, kept, near, &o, middle, away);
    if (none && !(away[0] + away[1] <= o.core)) return SL_OK;
    for (int side = 0; side < 2; side++) {
        const double at = side ? middle + away[1] : middle - away[0];
        if (!none && (away[side] > o.core || away[side] > away[1 - side])) continue;
        SL_TRY(cut_within(context, map, kept, near, openings, number, at - slack, at + slack));
    }
    return SL_OK;
}

/// Finds the walls that one opening cuts.
static sl_status cut_one(sl_context *context, const sl_map *map, const sl_bits *kept,
                         const sli_box_tree *tree, sli_box_list *near, sli_openings *openings,
                         size_t number) {
    const sli_opening *o = &openings->items.items[number];
    const double wide = o->half + fmax(o->core, o->pen), pen = o->pen, drawn = o->half + pen;
    const sl_box box = {{fmin(o->from.x, o->to.x) - wide, fmin(o->from.y, o->to.y) - wide},
                        {fmax(o->from.x, o->to.x) + wide, fmax(o->from.y, o->to.y) + wide}};
    const size_t first = openings->cuts.count;
    SL_TRY(sli_box_tree_find(context, tree, &box, near));
    SL_TRY(cut_within(context, map, kept, near, openings, number, -o->half, o->half));
    SL_TRY(cut_faces(context, map, kept, near, openings, number, first));
    if (openings->cuts.count == first && pen > 0)
        SL_TRY(cut_within(context, map, kept, near, openings, number, -drawn, drawn));
    return close_core(context, map, openings, first);
}

sl_status sli_openings_cut(sl_context *context, const sl_map *map, const sl_bits *kept,
                           sli_openings *openings) {
    if (!openings->items.count) return SL_OK;
    sli_box_tree tree = {0};
    sli_box_list near = {0};
    sl_box *boxes = sl_alloc_array(context, map->wall_count + 1, sizeof *boxes);
    for (size_t i = 0; boxes && i < map->wall_count; i++)
        boxes[i] = sli_box_around(map->walls[i].a, map->walls[i].b);
    sl_status status =
        boxes ? sli_box_tree_create(context, boxes, map->wall_count, &tree) : SL_NO_MEMORY;
    for (size_t i = 0; status == SL_OK && i < openings->items.count; i++) {
        status = cut_one(context, map, kept, &tree, &near, openings, i);
        if (status == SL_OK && i % 1024 == 0) status = sl_check_cancelled(context);
    }
    if (openings->cuts.count)
        qsort(openings->cuts.items, openings->cuts.count, sizeof *openings->cuts.items,
              compare_cuts);
    sl_free(context, boxes);
    sl_free(context, near.items);
    sli_box_tree_destroy(context, &tree);
    return status;
}
