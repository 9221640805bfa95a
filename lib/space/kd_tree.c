/// The kd-tree (Teller & Séquin 1991, Spatial Subdivision). A region without walls inside is a
/// leaf, a cell. Any other region is split on a line that holds one of its walls:
///
///     +---------+----+      the rules choose among the lines (sl_subdivide_options):
///     |         :    |      1. spanning: walls that cross the whole region come first
///     |====.....:    |      2. obscured: else lines that walls cover for a good part
///     |         |    |      3. cleaving: of these the lines that cut the fewest walls
///     |   |     |    |      4. median:   of these the one nearest to the median
///     +---------+----+
///
/// A wall that crosses the split line is cut for the two regions. Walls on the split line are kept
/// with the node; portals are the free pieces between them (portals.c). Every split position is the
/// coordinate of a wall, so no coordinate is computed.
///
/// Walls are sorted by line, so the candidates of a region are runs in its list. They are also
/// sorted by their low and by their high ends. On the way along both orders, the walls on either
/// side of each candidate are counted. Cutting walls keeps all three orders, so they are sorted
/// once. Time O(n) for each level.
#include "space/kd_tree.h"

#include "base/base.h"
#include "map/source.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- axial walls by line

static int compare_numbers(double a, double b) {
    return (a > b) - (a < b);
}

int sli_compare_pieces(const void *left, const void *right) {
    const sli_piece *a = left, *b = right;
    if (a->axis != b->axis) return a->axis - b->axis;
    const int at = compare_numbers(a->at, b->at);
    return at ? at : compare_numbers(a->lo, b->lo);
}

static sli_piece make_piece(const sl_wall *wall) {
    const int axis = wall->a.x == wall->b.x ? 0 : 1;
    const double at = axis ? wall->a.y : wall->a.x;
    const double one = axis ? wall->a.x : wall->a.y, other = axis ? wall->b.x : wall->b.y;
    return (sli_piece){
        .axis = axis, .at = at, .lo = one < other ? one : other, .hi = one < other ? other : one};
}

static sl_status check_axial(sl_context *context, const sl_map *map, const sl_wall *wall) {
    const bool vertical = wall->a.x == wall->b.x, horizontal = wall->a.y == wall->b.y;
    if (vertical && horizontal)
        return sli_map_fail(context, map, SL_BAD_INPUT, wall->line,
                            "a wall of zero length at %.17g %.17g: clean the map first", wall->a.x,
                            wall->a.y);
    if (vertical || horizontal) return SL_OK;
    return sli_map_fail(context, map, SL_BAD_INPUT, wall->line,
                        "the wall from %.17g %.17g to %.17g %.17g is neither horizontal nor "
                        "vertical, which the kd-tree needs: make it axial or leave it out",
                        wall->a.x, wall->a.y, wall->b.x, wall->b.y);
}

sl_status sli_wall_lines(sl_context *context, const sl_map *map, const sl_wall *walls, size_t count,
                         sli_piece **out) {
    const sl_map none = {0};
    if (!map) map = &none;
    for (size_t i = 0; i < count; i++) SL_TRY(check_axial(context, map, &walls[i]));
    sli_piece *pieces = sl_alloc_array(context, count, sizeof *pieces);
    if (!pieces) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) pieces[i] = make_piece(&walls[i]);
    qsort(pieces, count, sizeof *pieces, sli_compare_pieces);
    for (size_t i = 1; i < count; i++) {
        const sli_piece *a = &pieces[i - 1], *b = &pieces[i];
        if (a->axis != b->axis || a->at != b->at || b->lo >= a->hi) continue;
        const sl_status status = sli_map_fail(
            context, map, SL_BAD_INPUT, 0, "two walls overlap on %s = %.17g: clean the map first",
            a->axis ? "y" : "x", a->at);
        sl_free(context, pieces);
        return status;
    }
    *out = pieces;
    return SL_OK;
}

size_t sli_wall_lines_find(const sli_piece *pieces, size_t count, int axis, double at, double lo) {
    size_t first = 0, end = count;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        const sli_piece *p = &pieces[middle];
        const bool before = p->axis != axis ? p->axis < axis
                            : p->at != at   ? p->at < at
                                            : p->hi <= lo;
        if (before)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

bool sli_wall_lines_cover(const sli_piece *pieces, size_t count, int axis, double at, double lo,
                          double hi) {
    for (size_t i = sli_wall_lines_find(pieces, count, axis, at, lo); lo < hi; i++) {
        if (i == count || pieces[i].axis != axis || pieces[i].at != at || pieces[i].lo > lo)
            return false;
        lo = pieces[i].hi;
    }
    return true;
}

// --- the tree

/// The orders of the walls of a region; within each, those of axis 0 come first.
typedef enum order { BY_LINE, BY_LOW, BY_HIGH, ORDERS } order;

/// A region still to be divided, with the walls inside it. The stack owns it.
typedef struct region {
    sl_box box;
    sli_piece *pieces;     ///< `count` by line, then the same in the other orders
    size_t count, upright; ///< `upright`: of axis 0
    int32_t parent;        ///< the node that leads here, -1 for none
    bool above;            ///< which child of that node
    uint32_t depth;
} region;

typedef SL_ARRAY(region) region_stack;

/// A line that could be split on: pieces[first .. end) lie on it.
typedef struct candidate {
    size_t first, end;
    double obscured;     ///< the share of the region's width that its walls cover
    bool spanning;       ///< they cover it without a gap; this is exact
    size_t cleaved;      ///< the number of walls that the split would cut
    size_t below, above; ///< the number of walls on either side
} candidate;

/// Scratch memory for the choice.
typedef struct chooser {
    const sl_subdivide_options *options;
    SL_ARRAY(candidate) candidates;
} chooser;

static double low_of(const sl_box *box, int axis) {
    return axis ? box->min.y : box->min.x;
}

static double high_of(const sl_box *box, int axis) {
    return axis ? box->max.y : box->max.x;
}

static sl_status add_candidates(sl_context *context, chooser *choice, const region *r) {
    choice->candidates.count = 0;
    for (size_t first = 0, end; first < r->count; first = end) {
        const sli_piece *line = &r->pieces[first];
        const double lo = low_of(&r->box, !line->axis), hi = high_of(&r->box, !line->axis);
        double covered = 0, reached = lo;
        for (end = first; end < r->count; end++) {
            const sli_piece *p = &r->pieces[end];
            if (p->axis != line->axis || p->at != line->at) break;
            // Half of each, so that the widest maps do not overflow.
            covered += p->hi / 2 - p->lo / 2;
            if (p->lo <= reached && p->hi > reached) reached = p->hi;
        }
        SL_TRY(SL_ARRAY_ROOM(context, &choice->candidates, 1));
        choice->candidates.items[choice->candidates.count++] =
            (candidate){.first = first,
                        .end = end,
                        .obscured = covered / (hi / 2 - lo / 2),
                        .spanning = reached == hi};
    }
    return SL_OK;
}

/// Counts the walls that each candidate would cut, and those on either side.
static void count_sides(chooser *choice, const region *r) {
    const size_t of_axis[2] = {r->upright, r->count - r->upright};
    const sli_piece *lows = NULL, *highs = NULL;
    size_t starting = 0, ended = 0;
    for (size_t i = 0; i < choice->candidates.count; i++) {
        candidate *c = &choice->candidates.items[i];
        const sli_piece *line = &r->pieces[c->first];
        const int across = !line->axis;
        if (i == 0 || r->pieces[c[-1].first].axis != line->axis) {
            lows = r->pieces + BY_LOW * r->count + (across ? r->upright : 0);
            highs = r->pieces + BY_HIGH * r->count + (across ? r->upright : 0);
            starting = ended = 0;
        }
        while (starting < of_axis[across] && lows[starting].lo < line->at) starting++;
        while (ended < of_axis[across] && highs[ended].hi <= line->at) ended++;
        const size_t base = line->axis ? r->upright : 0;
        c->cleaved = starting - ended;
        c->below = c->first - base + starting;
        c->above = base + of_axis[line->axis] - c->end + of_axis[across] - ended;
    }
}

/// Keeps the candidates for which `keep` is true, if there are any.
static void filter(chooser *choice, bool (*keep)(const candidate *, double), double value) {
    size_t kept = 0;
    for (size_t i = 0; i < choice->candidates.count; i++)
        if (keep(&choice->candidates.items[i], value)) kept++;
    if (!kept) return;
    size_t to = 0;
    for (size_t i = 0; i < choice->candidates.count; i++)
        if (keep(&choice->candidates.items[i], value))
            choice->candidates.items[to++] = choice->candidates.items[i];
    choice->candidates.count = to;
}

static bool is_spanning(const candidate *c, double value) {
    (void)value;
    return c->spanning;
}

static bool is_obscured(const candidate *c, double share) {
    return c->spanning || c->obscured >= share;
}

static bool cleaves_at_most(const candidate *c, double most) {
    return (double)c->cleaved <= most;
}

static bool any_spanning(const chooser *choice) {
    for (size_t i = 0; i < choice->candidates.count; i++)
        if (choice->candidates.items[i].spanning) return true;
    return false;
}

static size_t least_cleaved(const chooser *choice) {
    size_t least = SIZE_MAX;
    for (size_t i = 0; i < choice->candidates.count; i++)
        if (choice->candidates.items[i].cleaved < least)
            least = choice->candidates.items[i].cleaved;
    return least;
}

static size_t imbalance(const candidate *c) {
    return c->below > c->above ? c->below - c->above : c->above - c->below;
}

static sl_status choose_split(sl_context *context, chooser *choice, const region *r,
                              candidate *out) {
    const sl_subdivide_options *rules = choice->options;
    SL_TRY(add_candidates(context, choice, r));
    count_sides(choice, r);
    if (rules->spanning && any_spanning(choice))
        filter(choice, is_spanning, 0);
    else {
        if (rules->obscured > 0) filter(choice, is_obscured, rules->obscured);
        if (rules->cleaving) filter(choice, cleaves_at_most, (double)least_cleaved(choice));
    }
    const candidate *best = &choice->candidates.items[0];
    for (size_t i = 1; rules->median && i < choice->candidates.count; i++)
        if (imbalance(&choice->candidates.items[i]) < imbalance(best))
            best = &choice->candidates.items[i];
    *out = *best;
    return SL_OK;
}

static sl_status add_node(sl_context *context, sli_kd_tree *tree, const region *r,
                          const candidate *split) {
    const sli_piece *line = &r->pieces[split->first];
    const size_t count = split->end - split->first;
    if (tree->nodes.count == INT32_MAX) return sl_fail_memory(context);
    SL_TRY(SL_ARRAY_ROOM(context, &tree->nodes, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &tree->splits, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &tree->on_splits, count));
    tree->nodes.items[tree->nodes.count++] = (sl_node){.position = line->at, .axis = line->axis};
    tree->splits.items[tree->splits.count++] =
        (sli_split_walls){.first = tree->on_splits.count, .count = count};
    memcpy(tree->on_splits.items + tree->on_splits.count, line, count * sizeof *line);
    tree->on_splits.count += count;
    return SL_OK;
}

/// The part of a piece on one side of a split; lo == hi where there is none.
static sli_piece clip_piece(const sli_piece *p, int axis, double at, bool above) {
    sli_piece part = *p;
    if (p->axis == axis) {
        if (above ? p->at <= at : p->at >= at) part.lo = part.hi;
    } else if (above) {
        if (part.lo < at) part.lo = part.hi > at ? at : part.hi;
    } else if (part.hi > at)
        part.hi = part.lo < at ? at : part.lo;
    return part;
}

/// The child below takes over the region's memory, so the one above comes first.
static sl_status push_child(sl_context *context, region_stack *stack, region *r,
                            const candidate *split, int32_t node, bool above) {
    const sli_piece line = r->pieces[split->first];
    SL_TRY(SL_ARRAY_ROOM(context, stack, 1));
    region child = {.box = r->box, .parent = node, .above = above, .depth = r->depth + 1};
    sl_point *corner = above ? &child.box.min : &child.box.max;
    *(line.axis ? &corner->y : &corner->x) = line.at;
    child.count = above ? split->above : split->below;
    child.pieces = above ? sl_alloc(context, (ORDERS * child.count + 1) * sizeof line) : r->pieces;
    if (!child.pieces) return SL_NO_MEMORY;
    sli_piece *to = child.pieces;
    for (size_t i = 0; i < ORDERS * r->count; i++) {
        const sli_piece part = clip_piece(&r->pieces[i], line.axis, line.at, above);
        if (part.lo < part.hi) *to++ = part;
    }
    while (child.upright < child.count && child.pieces[child.upright].axis == 0) child.upright++;
    if (!above) {
        size_t room = ORDERS * r->count;
        sli_shrink(context, &child.pieces, &room, ORDERS * child.count, sizeof line);
        r->pieces = NULL;
    }
    stack->items[stack->count++] = child;
    return SL_OK;
}

static void link_child(sli_kd_tree *tree, const region *r, int32_t child) {
    if (r->parent < 0)
        tree->root = child;
    else if (r->above)
        tree->nodes.items[r->parent].above = child;
    else
        tree->nodes.items[r->parent].below = child;
}

static sl_status divide(sl_context *context, chooser *choice, region_stack *stack, region *r,
                        sli_kd_tree *tree) {
    if (r->count == 0) {
        if (tree->cells.count == INT32_MAX) return sl_fail_memory(context);
        SL_TRY(SL_ARRAY_ROOM(context, &tree->cells, 1));
        link_child(tree, r, ~(int32_t)tree->cells.count);
        tree->cells.items[tree->cells.count++] = r->box;
        if (r->depth > tree->depth) tree->depth = r->depth;
        return SL_OK;
    }
    const int32_t node = (int32_t)tree->nodes.count;
    candidate split;
    SL_TRY(choose_split(context, choice, r, &split));
    SL_TRY(add_node(context, tree, r, &split));
    link_child(tree, r, node);
    SL_TRY(push_child(context, stack, r, &split, node, true));
    return push_child(context, stack, r, &split, node, false);
}

static int compare_lows(const void *left, const void *right) {
    const sli_piece *a = left, *b = right;
    return a->axis != b->axis ? a->axis - b->axis : compare_numbers(a->lo, b->lo);
}

static int compare_highs(const void *left, const void *right) {
    const sli_piece *a = left, *b = right;
    return a->axis != b->axis ? a->axis - b->axis : compare_numbers(a->hi, b->hi);
}

/// The root: the walls inside the bounds, without those on the border.
static sl_status push_root(sl_context *context, region_stack *stack, const sli_piece *walls,
                           size_t count, sl_box bounds) {
    SL_TRY(SL_ARRAY_ROOM(context, stack, 1));
    region root = {.box = bounds, .parent = -1};
    root.pieces = sl_alloc_array(context, count, ORDERS * sizeof *walls);
    if (!root.pieces) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const int axis = walls[i].axis;
        if (walls[i].at <= low_of(&bounds, axis) || walls[i].at >= high_of(&bounds, axis)) continue;
        root.upright += axis == 0;
        root.pieces[root.count++] = walls[i];
    }
    for (order k = BY_LOW; k < ORDERS; k++) {
        sli_piece *copy = root.pieces + k * root.count;
        memcpy(copy, root.pieces, root.count * sizeof *copy);
        qsort(copy, root.count, sizeof *copy, k == BY_LOW ? compare_lows : compare_highs);
    }
    stack->items[stack->count++] = root;
    return SL_OK;
}

static sl_status divide_all(sl_context *context, chooser *choice, region_stack *stack,
                            sli_kd_tree *tree) {
    while (stack->count) {
        region r = stack->items[--stack->count];
        sl_status status = sl_check_cancelled(context);
        if (status == SL_OK) status = divide(context, choice, stack, &r, tree);
        sl_free(context, r.pieces);
        SL_TRY(status);
        sl_report(context, "subdivide", "cells", tree->cells.count, 0);
    }
    return SL_OK;
}

sl_status sli_kd_build(sl_context *context, const sli_piece *walls, size_t count, sl_box bounds,
                       const sl_subdivide_options *options, sli_kd_tree *tree) {
    region_stack stack = {0};
    chooser choice = {.options = options};
    sl_status status = push_root(context, &stack, walls, count, bounds);
    if (status == SL_OK) status = divide_all(context, &choice, &stack, tree);
    for (size_t i = 0; i < stack.count; i++) sl_free(context, stack.items[i].pieces);
    sl_free(context, stack.items);
    sl_free(context, choice.candidates.items);
    return status;
}

void sli_kd_destroy(sl_context *context, sli_kd_tree *tree) {
    sl_free(context, tree->nodes.items);
    sl_free(context, tree->splits.items);
    sl_free(context, tree->on_splits.items);
    sl_free(context, tree->cells.items);
    *tree = (sli_kd_tree){0};
}

// --- splits

static sli_split split_box(const sl_node *node, sl_box box, uint32_t depth) {
    sli_split s = {depth, box, box, {box.min, box.max}};
    if (node->axis == 0)
        s.below.max.x = s.above.min.x = s.along.a.x = s.along.b.x = node->position;
    else
        s.below.max.y = s.above.min.y = s.along.a.y = s.along.b.y = node->position;
    return s;
}

sl_status sli_splits_make(sl_context *context, const sl_space *space, sli_split **out) {
    sli_split *splits = sl_alloc_array(context, space->node_count, sizeof *splits);
    if (!splits) return SL_NO_MEMORY;
    // A node stands before its children: each finds its box and depth in its own place.
    if (space->node_count) splits[space->root].below = space->bounds;
    for (uint32_t i = 0; i < space->node_count; i++) {
        const sl_node *node = &space->nodes[i];
        splits[i] = split_box(node, splits[i].below, splits[i].depth);
        if (node->below >= 0)
            splits[node->below] = (sli_split){splits[i].depth + 1, .below = splits[i].below};
        if (node->above >= 0)
            splits[node->above] = (sli_split){splits[i].depth + 1, .below = splits[i].above};
    }
    *out = splits;
    return SL_OK;
}

double sli_splits_covered(const sli_split *splits, const sl_space *space, uint32_t node) {
    const bool upright = space->nodes[node].axis == 0;
    const double position = space->nodes[node].position;
    const sl_segment along = splits[node].along;
    const double low = upright ? along.a.y : along.a.x, high = upright ? along.b.y : along.b.x;
    double sum = 0;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        if ((upright ? w->a.x : w->a.y) != position || (upright ? w->b.x : w->b.y) != position)
            continue;
        const double a = upright ? w->a.y : w->a.x, b = upright ? w->b.y : w->b.x;
        sum += fmax(0, fmin(fmax(a, b), high) - fmax(fmin(a, b), low));
    }
    return high > low ? fmin(sum / (high - low), 1) : 0;
}
