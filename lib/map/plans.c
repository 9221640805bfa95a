/// Which parts of a drawing are plans of their own.
///
/// Boxes of walls are parted where a gap leads all through them, upright or level, again and again:
///
///     +---+   +---+          The gap must be a tenth of the largest plan. A frame around the whole
///     |   |   | | |          sheet is no wall of it. Plans are parts of like size, at least half
///     +---+   +---+          the largest in each direction, that have at least three rooms or
///       - - - - - -          other faces, and stand in rows or columns: two plans agree in an
///     +---+                  edge or in their middle. They hold half of all walls at least. A town
///     +---+                  is no sheet by these rules, if its houses stand freely, are mere
///                            outlines, or are many. Nor is a map of the earth, one with starts
///                            or with solid ground.
///
/// Storeys of a house are drawn nearer to each other, but alike: of one size, with half of the
/// walls at the same places. For them a gap of 3/100 is enough if they have nearly all lines of the
/// sheet.
///
/// These are rules of thumb: they decide what is offered, and never what is seen. All is measured
/// in the directions of most walls, so turned sheets are sheets too. Time O(n log n) for each
/// of few passes.
#include "map/plans.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "map/planar.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The least gap, as a share of the largest plan's longer side; the least size of a plan, as a
/// share of the largest; how well rows agree, as a share of the largest plan; how near to the
/// border of the sheet its frame is, and how long, as shares of the sheet; how much of a plan the
/// boxes of its pieces cover.
static const double GAP = 0.1, SIZE = 0.5, ROW = 0.05, FRAME = 0.02, LONG = 0.9, COVER = 0.75;
/// Of storeys: the least gap; how well widths and places agree, as a share of a storey; their least
/// size, as that of plans; how much of the length of walls is at the same places; how many of all
/// lines they have.
static const double STOREY_GAP = 0.03, STOREY_SIZE = 0.04, LEAST_STOREY = 0.75, SAME = 0.4,
                    HELD = 0.9;
enum { LEAST_FACES = 3, MOST_PARTS = 256, PASSES = 8, MOST_PAIRS = 1 << 24 };

typedef struct item {
    sl_segment at; ///< in the map
    sl_box box;    ///< in the sheet's directions
} item;

typedef struct part {
    size_t first, count;
    sl_box box;
} part;

typedef struct sheet {
    sl_context *context;
    sl_point along;
    double gap; ///< GAP, or STOREY_GAP for storeys
    SL_ARRAY(item) items;
    part parts[MOST_PARTS];
    size_t count;
    bool too_many;
} sheet;

static sl_point turned(sl_point along, sl_point p) {
    return (sl_point){along.x * p.x + along.y * p.y, along.x * p.y - along.y * p.x};
}

static sl_box box_of(sl_point along, sl_segment s) {
    const sl_point p = turned(along, s.a), q = turned(along, s.b);
    return (sl_box){{sli_lesser(p.x, q.x), sli_lesser(p.y, q.y)},
                    {sli_greater(p.x, q.x), sli_greater(p.y, q.y)}};
}

static void grow(sl_box *box, sl_box by) {
    box->min = (sl_point){sli_lesser(box->min.x, by.min.x), sli_lesser(box->min.y, by.min.y)};
    box->max = (sl_point){sli_greater(box->max.x, by.max.x), sli_greater(box->max.y, by.max.y)};
}

static double longer_side(sl_box box) {
    return sli_greater(box.max.x - box.min.x, box.max.y - box.min.y);
}

// --- what is on the sheet

/// All lines of a map, one after the other; false behind the last.
static bool line_of(const sl_map *map, size_t i, sl_segment *at) {
    if (i < map->wall_count) {
        *at = (sl_segment){map->walls[i].a, map->walls[i].b};
        return true;
    }
    i -= map->wall_count;
    if (i < map->door_count) {
        *at = map->doors[i].segment;
        return true;
    }
    i -= map->door_count;
    const sl_glass *glass[] = {map->mirrors, map->oneways, map->seams};
    const size_t counts[] = {map->mirror_count, map->oneway_count, map->seam_count};
    for (int k = 0; k < 3; i -= counts[k++]) {
        if (i >= counts[k]) continue;
        *at = glass[k][i].segment;
        return true;
    }
    return false;
}

/// x where half of all lines, by length, are axial; else the direction of the longest line, turned
/// by quarters to be nearest to x.
static sl_point direction_of(const sl_map *map) {
    double most = 0, all = 0, axial = 0;
    sl_segment at;
    sl_point best = {1, 0};
    for (size_t i = 0; line_of(map, i, &at); i++) {
        const sl_point d = {at.b.x - at.a.x, at.b.y - at.a.y};
        const double length = sli_length(d.x, d.y);
        if (!isfinite(length)) continue;
        all += length;
        axial += d.x == 0 || d.y == 0 ? length : 0;
        if (!(length > most)) continue;
        most = length;
        best = (sl_point){d.x / length, d.y / length};
    }
    if (2 * axial >= all) return (sl_point){1, 0};
    if (fabs(best.x) < fabs(best.y)) best = (sl_point){best.y, -best.x};
    return best.x < 0 ? (sl_point){-best.x, -best.y} : best;
}

static sl_status gather(sheet *s, const sl_map *map) {
    sl_segment at;
    for (size_t i = 0; line_of(map, i, &at); i++) {
        if (sli_same_point(at.a, at.b)) continue;
        SL_TRY(SL_ARRAY_ROOM(s->context, &s->items, 1));
        s->items.items[s->items.count++] = (item){at, box_of(s->along, at)};
    }
    return SL_OK;
}

static sl_box bounds_of(const item *items, size_t count) {
    sl_box box = count ? items[0].box : (sl_box){0};
    for (size_t i = 1; i < count; i++) grow(&box, items[i].box);
    return box;
}

/// Takes the lines away that frame the sheet: long ones at its border. Whether there were any.
static bool drop_frame(sheet *s) {
    const sl_box all = bounds_of(s->items.items, s->items.count);
    const double width = all.max.x - all.min.x, height = all.max.y - all.min.y;
    const double near = FRAME * longer_side(all);
    size_t kept = 0;
    for (size_t i = 0; i < s->items.count; i++) {
        const sl_box b = s->items.items[i].box;
        const bool level = b.max.x - b.min.x >= LONG * width && b.max.y - b.min.y <= near &&
                           (b.max.y - all.min.y <= near || all.max.y - b.min.y <= near);
        const bool upright = b.max.y - b.min.y >= LONG * height && b.max.x - b.min.x <= near &&
                             (b.max.x - all.min.x <= near || all.max.x - b.min.x <= near);
        if (!level && !upright) s->items.items[kept++] = s->items.items[i];
    }
    const bool any = kept < s->items.count;
    s->items.count = kept;
    return any;
}

// --- parts

static int by_x(const void *a, const void *b) {
    const double p = ((const item *)a)->box.min.x, q = ((const item *)b)->box.min.x;
    return (p > q) - (p < q);
}

static int by_y(const void *a, const void *b) {
    const double p = ((const item *)a)->box.min.y, q = ((const item *)b)->box.min.y;
    return (p > q) - (p < q);
}

/// Parts a run of items at its gaps, first across one axis, then across the other. A run without a
/// gap in either is a part.
static void divide(sheet *s, size_t first, size_t count, double gap, int axis, int without) {
    item *items = s->items.items + first;
    if (without == 2) {
        s->too_many |= s->count == MOST_PARTS;
        if (!s->too_many) s->parts[s->count++] = (part){first, count, bounds_of(items, count)};
        return;
    }
    qsort(items, count, sizeof *items, axis ? by_y : by_x);
    size_t begin = 0;
    double end = -INFINITY;
    for (size_t i = 0; i <= count && !s->too_many; i++) {
        const bool last = i == count;
        const double low = last ? INFINITY : axis ? items[i].box.min.y : items[i].box.min.x;
        if (i && low - end >= gap) {
            const bool whole = begin == 0 && last;
            divide(s, first + begin, i - begin, gap, !axis, whole ? without + 1 : 0);
            begin = i;
            if (whole) return;
        }
        if (!last) end = sli_greater(end, axis ? items[i].box.max.y : items[i].box.max.x);
    }
}

/// Parts at gaps that are a share of the largest part. Wider gaps make larger parts, so a few
/// passes end.
static double find_parts(sheet *s) {
    double gap = s->gap / 4 * longer_side(bounds_of(s->items.items, s->items.count)), largest = 0;
    for (int pass = 0; pass < PASSES && gap > 0; pass++) {
        s->count = 0;
        s->too_many = false;
        divide(s, 0, s->items.count, gap, 0, 0);
        largest = 0;
        for (size_t i = 0; i < s->count; i++)
            largest = sli_greater(largest, longer_side(s->parts[i].box));
        if (gap >= s->gap * largest) break;
        gap = s->gap * largest;
    }
    return largest;
}

/// Counts the pieces of a graph that hang together. `*area` gets that of their boxes.
static sl_status count_pieces(sl_context *context, const sli_planar *graph, size_t *pieces,
                              double *area) {
    const uint32_t count = (uint32_t)graph->point_count;
    uint32_t *piece = sl_alloc_array(context, count, sizeof *piece);
    sl_box *boxes = sl_alloc_array(context, count, sizeof *boxes);
    const bool room = piece && boxes;
    for (uint32_t i = 0; room && i < count; i++) {
        piece[i] = i;
        boxes[i] = (sl_box){graph->points[i], graph->points[i]};
    }
    for (size_t i = 0; room && i < graph->edge_count; i++)
        piece[sl_root_of(piece, graph->edges[i].a)] = sl_root_of(piece, graph->edges[i].b);
    for (uint32_t i = 0; room && i < count; i++) grow(&boxes[sl_root_of(piece, i)], boxes[i]);
    for (uint32_t i = 0; room && i < count; i++) {
        if (piece[i] != i) continue;
        ++*pieces;
        *area += (boxes[i].max.x - boxes[i].min.x) * (boxes[i].max.y - boxes[i].min.y);
    }
    sl_free(context, piece);
    sl_free(context, boxes);
    return room ? SL_OK : SL_NO_MEMORY;
}

/// Whether the lines of a part enclose enough faces: edges - points + pieces. Pieces that stand
/// freely, as houses of a town, count as one; walls of a plan, between openings, have boxes that
/// cover most of it.
static sl_status has_rooms(const sheet *s, const part *p, double weld, bool *out) {
    sli_planar graph = {0};
    sl_segment *lines = sl_alloc_array(s->context, p->count, sizeof *lines);
    if (!lines) return SL_NO_MEMORY;
    for (size_t i = 0; i < p->count; i++) lines[i] = s->items.items[p->first + i].at;
    sl_status status = sli_planar_make(s->context, "the sheet", lines, p->count, weld, &graph);
    size_t pieces = 0;
    double area = 0;
    if (status == SL_OK) status = count_pieces(s->context, &graph, &pieces, &area);
    sl_box box = box_of((sl_point){1, 0}, lines[0]);
    for (size_t i = 1; i < p->count; i++) grow(&box, box_of((sl_point){1, 0}, lines[i]));
    if (area < COVER * (box.max.x - box.min.x) * (box.max.y - box.min.y)) pieces = 1;
    *out = status == SL_OK && graph.edge_count + pieces >= graph.point_count + LEAST_FACES;
    sli_planar_destroy(s->context, &graph);
    sl_free(s->context, lines);
    return status == SL_UNSUPPORTED ? SL_OK : status;
}

// --- storeys

/// Whether a line lies along another one, moved, and has its middle beside it.
static bool lies_on(const item *line, sl_point move, const item *other, double within) {
    const sl_box a = line->box, b = other->box;
    const sl_point middle = {(a.min.x + a.max.x) / 2 + move.x, (a.min.y + a.max.y) / 2 + move.y};
    const sl_point u = {line->at.b.x - line->at.a.x, line->at.b.y - line->at.a.y};
    const sl_point v = {other->at.b.x - other->at.a.x, other->at.b.y - other->at.a.y};
    return middle.x >= b.min.x - within && middle.x <= b.max.x + within &&
           middle.y >= b.min.y - within && middle.y <= b.max.y + within &&
           fabs(sli_cross(u, v)) <= 0.1 * sli_length(u.x, u.y) * sli_length(v.x, v.y);
}

/// How much of a part's walls, by length, are at the places of another one's when it is moved.
static double share_at(const sheet *s, const part *p, const part *other, sl_point move) {
    const double within = STOREY_SIZE / 4 * longer_side(other->box);
    double all = 0, same = 0;
    for (size_t i = p->first; i < p->first + p->count; i++) {
        const sl_segment at = s->items.items[i].at;
        const double length = sli_length(at.b.x - at.a.x, at.b.y - at.a.y);
        bool found = false;
        for (size_t k = other->first; k < other->first + other->count && !found; k++)
            found = lies_on(&s->items.items[i], move, &s->items.items[k], within);
        all += length;
        same += found ? length : 0;
    }
    return same / all;
}

/// Whether a part is a storey beside another one: as wide or as high, with much of its walls at the
/// same places once their edges or their middles are.
static bool is_storey(const sheet *s, const part *p, const part *other) {
    const sl_box a = p->box, b = other->box;
    const sl_point low = {b.min.x - a.min.x, b.min.y - a.min.y};
    const sl_point high = {b.max.x - a.max.x, b.max.y - a.max.y};
    const double within = STOREY_SIZE * longer_side(b);
    if (p->count > MOST_PAIRS / other->count) return false;
    if (fabs(high.x - low.x) > within && fabs(high.y - low.y) > within) return false;
    for (int i = 0; i < 9; i++) {
        const double x = i % 3 / 2.0, y = i / 3 / 2.0;
        const sl_point move = {low.x + x * (high.x - low.x), low.y + y * (high.y - low.y)};
        if (share_at(s, p, other, move) >= SAME) return true;
    }
    return false;
}

// --- plans

/// Whether two boxes agree in an edge or in their middle, across an axis.
static bool agree(double low_a, double high_a, double low_b, double high_b, double within) {
    return fabs(low_a - low_b) <= within || fabs(high_a - high_b) <= within ||
           fabs(low_a + high_a - low_b - high_b) <= 2 * within;
}

static bool stand_in_rows(const sli_sheet *out, double within) {
    for (size_t i = 0; i < out->count; i++) {
        bool any = false;
        for (size_t k = 0; k < out->count && !any; k++) {
            const sl_box a = out->plans[i].box, b = out->plans[k].box;
            any = k != i && (agree(a.min.x, a.max.x, b.min.x, b.max.x, within) ||
                             agree(a.min.y, a.max.y, b.min.y, b.max.y, within));
        }
        if (!any) return false;
    }
    return true;
}

static int from_top(const void *left, const void *right) {
    const sli_plan *a = left, *b = right;
    return (b->box.max.y > a->box.max.y) - (b->box.max.y < a->box.max.y);
}

static int from_left(const void *left, const void *right) {
    const sli_plan *a = left, *b = right;
    return (a->box.min.x > b->box.min.x) - (a->box.min.x < b->box.min.x);
}

/// Rows from the top: a plan whose middle is below the first one's bottom begins the next row.
static void sort_plans(sli_sheet *out) {
    qsort(out->plans, out->count, sizeof *out->plans, from_top);
    for (size_t i = 0, first = 0; i <= out->count; i++) {
        const sl_box head = out->plans[first].box;
        if (i < out->count && out->plans[i].box.min.y + out->plans[i].box.max.y >= 2 * head.min.y)
            continue;
        qsort(out->plans + first, i - first, sizeof *out->plans, from_left);
        first = i;
    }
}

static sl_status add_plan(const sheet *s, const part *p, sli_sheet *out) {
    sl_box bounds = box_of((sl_point){1, 0}, s->items.items[p->first].at);
    for (size_t i = 1; i < p->count; i++)
        grow(&bounds, box_of((sl_point){1, 0}, s->items.items[p->first + i].at));
    if (out->count < SLI_PLANS_MOST) out->plans[out->count] = (sli_plan){p->box, bounds, p->count};
    out->count++; // too many are none
    return SL_OK;
}

static sl_status choose(const sheet *s, double largest, double weld, sli_sheet *out) {
    const bool storeys = s->gap < GAP;
    const double least = storeys ? LEAST_STOREY : SIZE, share = storeys ? HELD : 0.5;
    const part *first = NULL;
    double width = 0, height = 0;
    size_t held = 0;
    for (size_t i = 0; i < s->count; i++) {
        width = sli_greater(width, s->parts[i].box.max.x - s->parts[i].box.min.x);
        height = sli_greater(height, s->parts[i].box.max.y - s->parts[i].box.min.y);
    }
    for (size_t i = 0; i < s->count && s->count > 1 && !s->too_many; i++) {
        const part *p = &s->parts[i];
        bool rooms;
        if (p->box.max.x - p->box.min.x < least * width ||
            p->box.max.y - p->box.min.y < least * height)
            continue;
        SL_TRY(has_rooms(s, p, weld, &rooms));
        if (!rooms || (storeys && first && !is_storey(s, p, first))) continue;
        if (!first) first = p;
        held += p->count;
        SL_TRY(add_plan(s, p, out));
    }
    const bool good = out->count >= 2 && out->count <= SLI_PLANS_MOST &&
                      (double)held >= share * (double)s->items.count &&
                      stand_in_rows(out, ROW * largest);
    if (good)
        sort_plans(out);
    else
        out->count = 0;
    return SL_OK;
}

/// Finds plans with gaps of at least the sheet's, in the sheet or in a frame that it has.
static sl_status find_plans(sheet *s, const sl_map *map, sli_sheet *out) {
    const sl_box bounds = sl_map_bounds(map);
    const double weld = sli_greater(map->precision, sli_planar_tolerance(&bounds));
    s->items.count = 0;
    SL_TRY(gather(s, map));
    for (int frames = 0; frames < 3 && s->items.count; frames++) {
        const double largest = find_parts(s);
        SL_TRY(choose(s, largest, weld, out));
        if (out->count || s->count > 1 || !drop_frame(s)) break;
    }
    return SL_OK;
}

sl_status sli_sheet_find(sl_context *context, const sl_map *map, sli_sheet *out) {
    sheet s = {.context = context, .along = direction_of(map), .gap = GAP};
    bool ground = false;
    *out = (sli_sheet){.along = s.along};
    for (size_t i = 0; i < map->wall_count && !ground; i++) ground = map->walls[i].ground != 0;
    if (map->earth.known || map->start_count || ground) return SL_OK;
    sl_status status = find_plans(&s, map, out);
    s.gap = STOREY_GAP;
    if (status == SL_OK && !out->count) status = find_plans(&s, map, out);
    sl_free(context, s.items.items);
    return status;
}

// --- one of them

typedef struct take {
    sl_point along;
    sl_box box;
    size_t left;
} take;

static bool holds(const take *t, sl_point a, sl_point b) {
    const sl_point at = turned(t->along, (sl_point){a.x / 2 + b.x / 2, a.y / 2 + b.y / 2});
    return sli_box_holds(&t->box, at);
}

static bool stays(take *t, sl_segment at) {
    const bool in = holds(t, at.a, at.b);
    t->left += !in;
    return in;
}

static size_t take_glass(take *t, sl_glass *items, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (stays(t, items[i].segment)) items[kept++] = items[i];
    return kept;
}

size_t sli_sheet_take(sl_context *context, const sli_sheet *found, size_t number, sl_map *map) {
    take t = {.along = found->along, .box = found->plans[number].box};
    size_t kept = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        if (stays(&t, (sl_segment){map->walls[i].a, map->walls[i].b}))
            map->walls[kept++] = map->walls[i];
    map->wall_count = kept;
    kept = 0;
    for (size_t i = 0; i < map->door_count; i++) {
        if (stays(&t, map->doors[i].segment)) {
            map->doors[kept++] = map->doors[i];
            continue;
        }
        sl_free(context, map->doors[i].name);
        sl_free(context, map->doors[i].parts);
    }
    map->door_count = kept;
    map->mirror_count = take_glass(&t, map->mirrors, map->mirror_count);
    map->oneway_count = take_glass(&t, map->oneways, map->oneway_count);
    map->seam_count = take_glass(&t, map->seams, map->seam_count);
    kept = 0;
    for (size_t i = 0; i < map->path_count; i++) {
        if (holds(&t, map->paths[i].points[0], map->paths[i].points[0])) {
            map->paths[kept++] = map->paths[i];
            continue;
        }
        sl_free(context, map->paths[i].name);
        sl_free(context, map->paths[i].points);
    }
    map->path_count = kept;
    kept = 0;
    for (size_t i = 0; i < map->object_count; i++) {
        if (holds(&t, map->objects[i].box.min, map->objects[i].box.max))
            map->objects[kept++] = map->objects[i];
        else
            sl_free(context, map->objects[i].name);
    }
    map->object_count = kept;
    return t.left;
}
