#include "space/splits.h"

#include <math.h>
#include <stdlib.h>

void sl_splits_destroy(sl_context *context, sl_splits *splits) {
    sl_free(context, splits->splits.items);
    sl_free(context, splits->first);
    sl_free(context, splits->corners.items);
    *splits = (sl_splits){0};
}

/// Positive above the node's line, negative below it.
static double distance(const sl_node *node, sl_point p) {
    return (node->axis == 0 ? p.x : p.y) - node->position;
}

static int side_of(const sl_node *node, sl_point p) {
    return (distance(node, p) > 0) - (distance(node, p) < 0);
}

/// Where the line crosses from p to q, which lie on different sides of it.
static sl_point crossing(const sl_node *node, sl_point p, sl_point q) {
    const double from = fabs(distance(node, p)), to = fabs(distance(node, q));
    const double share = from + to > 0 ? from / (from + to) : 0.5;
    sl_point at = {p.x + (q.x - p.x) * share, p.y + (q.y - p.y) * share};
    if (node->axis == 0) at.x = node->position;
    if (node->axis == 1) at.y = node->position;
    return at;
}

static sl_point corner(const sl_splits *splits, sl_split_region region, size_t i) {
    return splits->corners.items[region.first + i % region.count];
}

/// The part of a region on one side of a node's line, and where the line enters and leaves it.
static sl_status cut(sl_context *context, sl_splits *splits, const sl_node *node,
                     sl_split_region from, int sign, sl_split_region *part, sl_segment *along) {
    *part = (sl_split_region){splits->corners.count, 0};
    SL_TRY(SL_ARRAY_ROOM(context, &splits->corners, 2 * from.count));
    size_t met = 0;
    for (size_t i = 0; i < from.count; i++) {
        const sl_point p = corner(splits, from, i), q = corner(splits, from, i + 1);
        const int here = side_of(node, p), next = side_of(node, q);
        sl_point at = p;
        if (here * sign >= 0) splits->corners.items[splits->corners.count++] = p;
        if (here * next < 0) {
            at = crossing(node, p, q);
            splits->corners.items[splits->corners.count++] = at;
        }
        if (here * next < 0 || here == 0) *(met++ ? &along->b : &along->a) = at;
    }
    if (met < 2) along->b = along->a;
    part->count = splits->corners.count - part->first;
    if (part->count < 3) part->count = 0;
    return SL_OK;
}

/// A child and what of it is left to be split.
typedef struct visit {
    int32_t child;
    uint32_t depth;
    sl_split_region region;
} visit;

typedef SL_ARRAY(visit) visits;

static sl_status push(sl_context *context, visits *waiting, visit next) {
    if (next.child < 0 || !next.region.count) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, waiting, 1));
    waiting->items[waiting->count++] = next;
    return SL_OK;
}

static sl_status split(sl_context *context, const sl_space *space, sl_splits *splits, visit now,
                       visits *waiting) {
    const sl_node *node = &space->nodes[now.child];
    sl_split s = {.node = (uint32_t)now.child, .depth = now.depth};
    SL_TRY(cut(context, splits, node, now.region, -1, &s.below, &s.along));
    SL_TRY(cut(context, splits, node, now.region, 1, &s.above, &s.along));
    SL_TRY(SL_ARRAY_ROOM(context, &splits->splits, 1));
    splits->splits.items[splits->splits.count++] = s;
    SL_TRY(push(context, waiting, (visit){node->above, now.depth + 1, s.above}));
    return push(context, waiting, (visit){node->below, now.depth + 1, s.below});
}

static int by_node(const void *a, const void *b) {
    const sl_split *s = a, *t = b;
    if (s->node != t->node) return s->node < t->node ? -1 : 1;
    return s->below.first < t->below.first ? -1 : s->below.first > t->below.first;
}

static sl_status sort(sl_context *context, sl_splits *splits) {
    splits->first = sl_alloc_array(context, (size_t)splits->node_count + 1, sizeof *splits->first);
    if (!splits->first) return SL_NO_MEMORY;
    if (splits->splits.count)
        qsort(splits->splits.items, splits->splits.count, sizeof *splits->splits.items, by_node);
    for (size_t i = 0; i < splits->splits.count; i++)
        splits->first[splits->splits.items[i].node + 1]++;
    for (uint32_t i = 0; i < splits->node_count; i++) splits->first[i + 1] += splits->first[i];
    return SL_OK;
}

static sl_status make(sl_context *context, const sl_space *space, sl_splits *splits,
                      visits *waiting) {
    splits->node_count = space->node_count;
    SL_TRY(SL_ARRAY_ROOM(context, &splits->corners, 4));
    const sl_box b = space->bounds;
    const sl_point box[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    for (int i = 0; i < 4; i++) splits->corners.items[splits->corners.count++] = box[i];
    if (space->node_count) SL_TRY(push(context, waiting, (visit){space->root, 0, {0, 4}}));
    while (waiting->count) {
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(split(context, space, splits, waiting->items[--waiting->count], waiting));
    }
    return sort(context, splits);
}

sl_status sl_splits_make(sl_context *context, const sl_space *space, sl_splits *out) {
    sl_splits splits = {0};
    visits waiting = {0};
    const sl_status status = make(context, space, &splits, &waiting);
    sl_free(context, waiting.items);
    if (status == SL_OK)
        *out = splits;
    else
        sl_splits_destroy(context, &splits);
    return status;
}

/// How long a piece of a split is, and how much of that walls cover.
static void measure(const sl_space *space, const sl_split *split, double *length, double *covered) {
    const sl_node *node = &space->nodes[split->node];
    const sl_segment along = split->along;
    const double dx = along.b.x - along.a.x, dy = along.b.y - along.a.y;
    const double square = dx * dx + dy * dy;
    if (!(square > 0)) return;
    double sum = 0;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        if (side_of(node, w->a) || side_of(node, w->b)) continue;
        const double a = ((w->a.x - along.a.x) * dx + (w->a.y - along.a.y) * dy) / square;
        const double b = ((w->b.x - along.a.x) * dx + (w->b.y - along.a.y) * dy) / square;
        sum += fmax(0, fmin(fmax(a, b), 1) - fmax(fmin(a, b), 0));
    }
    *length += sqrt(square);
    *covered += fmin(sum, 1) * sqrt(square);
}

double sl_splits_covered(const sl_splits *splits, const sl_space *space, uint32_t node) {
    double length = 0, covered = 0;
    for (uint32_t i = splits->first[node]; i < splits->first[node + 1]; i++)
        measure(space, &splits->splits.items[i], &length, &covered);
    return length > 0 ? covered / length : 0;
}
