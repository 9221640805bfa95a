#include "view_cells/tree.h"

#include "base/threads.h"
#include "geometry/orient.h"

#include <string.h>

void sl_view_tree_destroy(sl_context *context, sl_view_tree *tree) {
    sl_free(context, tree->nodes);
    sl_free(context, tree->lines);
    sl_free(context, tree->corners);
    sl_free(context, tree->edges);
    sl_free(context, tree->first);
    sl_free(context, tree->mass);
    *tree = (sl_view_tree){0};
}

uint32_t sl_view_tree_locate(const sl_view_tree *tree, sl_point point) {
    const sl_box *b = &tree->bounds;
    if (!tree->leaf_count || !(point.x >= b->min.x && point.x <= b->max.x) ||
        !(point.y >= b->min.y && point.y <= b->max.y))
        return SL_NO_VIEW_CELL;
    int32_t at = tree->root;
    while (at >= 0) {
        const sl_view_node *node = &tree->nodes[at];
        bool below;
        if (node->axis < 2) {
            below = (node->axis ? point.y : point.x) < node->position;
        } else {
            const sl_segment *line = &tree->lines[node->line];
            below = sl_orient(line->a, line->b, point) < 0;
        }
        at = below ? node->below : node->above;
    }
    return (uint32_t)~at;
}

sl_point sl_view_leaf_middle(const sl_view_tree *tree, uint32_t leaf) {
    const uint32_t first = tree->first[leaf], end = tree->first[leaf + 1];
    const sl_point at = tree->corners[first];
    sl_point sum = {0, 0};
    for (uint32_t i = first; i < end; i++) {
        sum.x += (tree->corners[i].x - at.x) / (end - first);
        sum.y += (tree->corners[i].y - at.y) / (end - first);
    }
    return (sl_point){at.x + sum.x, at.y + sum.y};
}

sl_point sl_view_cell_middle(const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    const sl_point *corners = space->vertices + c->first_vertex;
    sl_point sum = {0, 0};
    for (uint32_t i = 1; i < c->vertex_count; i++) {
        sum.x += (corners[i].x - corners[0].x) / c->vertex_count;
        sum.y += (corners[i].y - corners[0].y) / c->vertex_count;
    }
    return (sl_point){corners[0].x + sum.x, corners[0].y + sum.y};
}

uint32_t sl_view_cell_home(const sl_space *homes, const sl_space *space, uint32_t cell) {
    if (homes->neighbour) return sl_space_locate(homes, sl_view_cell_middle(space, cell));
    const sl_cell *c = &space->cells[cell];
    sl_point least = space->vertices[c->first_vertex];
    for (uint32_t i = 1; i < c->vertex_count; i++) {
        const sl_point p = space->vertices[c->first_vertex + i];
        least = (sl_point){fmin(least.x, p.x), fmin(least.y, p.y)};
    }
    return sl_space_locate(homes, least);
}

/// Where a point lies: below a node's split (negative), on it or above it.
static double side_of(const sl_view_tree *tree, const sl_view_node *node, sl_point p) {
    if (node->axis < 2) return (node->axis ? p.y : p.x) - node->position;
    return sl_view_line_side(&tree->lines[node->line], p);
}

uint32_t sl_view_cell_leaf(const sl_view_tree *tree, const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    int32_t at = tree->root;
    while (at >= 0) {
        const sl_view_node *node = &tree->nodes[at];
        double least = 0, most = 0;
        for (uint32_t i = 0; i < c->vertex_count; i++) {
            const double side = side_of(tree, node, space->vertices[c->first_vertex + i]);
            least = fmin(least, side);
            most = fmax(most, side);
        }
        at = -least > most ? node->below : node->above;
    }
    return (uint32_t)~at;
}

// --- what the leaves see, by segments

/// A part of a segment on its way down the tree.
typedef struct descent {
    int32_t at;
    double t0, t1;
} descent;

/// What one thread has.
typedef struct gatherer {
    sl_view_sets sets;
    SL_ARRAY(descent) waiting;
} gatherer;

typedef struct gathering {
    const sl_view_tree *tree;
    const sl_view_segments *segments;
    uint32_t object_count;
    pthread_mutex_t lock;
    sl_view_sets sets; ///< joined from the threads', under the lock
} gathering;

enum { SEGMENTS_A_UNIT = 16384 };
/// The most bytes that sets take where more than one thread has its own.
#define MOST_SET_BYTES (UINT64_C(1) << 30)

void sl_view_sets_destroy(sl_context *context, sl_view_sets *sets) {
    sl_free(context, sets->bits);
    *sets = (sl_view_sets){0};
}

void sl_view_found_destroy(sl_context *context, sl_view_found *found) {
    sl_view_sets_destroy(context, &found->sets);
    *found = (sl_view_found){0};
}

sl_status sl_view_sets_create(sl_context *context, uint32_t count, uint32_t object_count,
                              sl_view_sets *sets) {
    const size_t words = sl_bits_words(object_count);
    if (words && count > SIZE_MAX / words) return sl_fail_memory(context);
    uint64_t *bits = sl_alloc_array(context, count * words, sizeof *bits);
    if (!bits) return SL_NO_MEMORY;
    *sets = (sl_view_sets){count, object_count, words, bits};
    return SL_OK;
}

static sl_status begin(sl_context *context, void *job, void **state) {
    const gathering *g = job;
    gatherer *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    if (sl_view_sets_create(context, g->tree->cell_count, g->object_count, &me->sets) != SL_OK) {
        sl_free(context, me);
        return SL_NO_MEMORY;
    }
    *state = me;
    return SL_OK;
}

static void end(sl_context *context, void *job, void *state) {
    gathering *g = job;
    gatherer *me = state;
    pthread_mutex_lock(&g->lock);
    if (g->sets.bits) {
        const size_t words = g->sets.count * g->sets.words;
        for (size_t i = 0; i < words; i++) g->sets.bits[i] |= me->sets.bits[i];
    } else {
        g->sets = me->sets;
        me->sets = (sl_view_sets){0};
    }
    pthread_mutex_unlock(&g->lock);
    sl_view_sets_destroy(context, &me->sets);
    sl_free(context, me->waiting.items);
    sl_free(context, me);
}

static sl_status wait(sl_context *context, gatherer *me, int32_t at, double t0, double t1) {
    SL_TRY(SL_ARRAY_ROOM(context, &me->waiting, 1));
    me->waiting.items[me->waiting.count++] = (descent){at, t0, t1};
    return SL_OK;
}

static sl_status pass_node(sl_context *context, const gathering *g, gatherer *me, descent d,
                           const sl_segment *s) {
    const sl_view_node *node = &g->tree->nodes[d.at];
    const double a = side_of(g->tree, node, s->a), b = side_of(g->tree, node, s->b);
    const double from = a + d.t0 * (b - a), to = a + d.t1 * (b - a);
    if (from < 0 && to < 0) return wait(context, me, node->below, d.t0, d.t1);
    if (from >= 0 && to >= 0) return wait(context, me, node->above, d.t0, d.t1);
    const double t = fmin(fmax(a / (a - b), d.t0), d.t1);
    // Up to the split and no farther it has no more than a point above.
    SL_TRY(from < 0 ? wait(context, me, node->below, d.t0, t)
                    : wait(context, me, node->below, t, d.t1));
    if (from < 0 && to == 0) return SL_OK;
    if (to < 0 && from == 0) return SL_OK;
    return from < 0 ? wait(context, me, node->above, t, d.t1)
                    : wait(context, me, node->above, d.t0, t);
}

static sl_status gather_unit(sl_context *context, void *job, void *state, size_t unit) {
    const gathering *g = job;
    gatherer *me = state;
    const sl_view_segments *segments = g->segments;
    const size_t first = unit * SEGMENTS_A_UNIT;
    for (size_t i = first; i < segments->count && i < first + SEGMENTS_A_UNIT; i++) {
        SL_TRY(wait(context, me, g->tree->root, 0, 1));
        while (me->waiting.count) {
            const descent d = me->waiting.items[--me->waiting.count];
            if (d.at >= 0) {
                SL_TRY(pass_node(context, g, me, d, &segments->items[i]));
                continue;
            }
            const uint32_t leaf = (uint32_t)~d.at;
            if (leaf >= g->tree->cell_count) continue;
            sl_bits *row = sl_view_set(&me->sets, leaf);
            for (uint64_t k = segments->first[i]; k < segments->first[i + 1]; k++)
                sl_bits_add(row, segments->objects[k]);
        }
    }
    return SL_OK;
}

sl_status sl_view_sets_sample(sl_context *context, const sl_view_scene *scene,
                              const sl_view_tree *tree, const sl_view_segments *segments,
                              unsigned threads, sl_view_sets *out) {
    const sl_space *space = scene->space;
    gathering g = {.tree = tree, .segments = segments};
    g.object_count = scene->objects == SL_VIEW_WALLS ? space->wall_count : space->cell_count;
    const uint64_t bytes = (uint64_t)tree->cell_count * sl_bits_words(g.object_count) * 8 + 1;
    if (!threads) threads = sl_core_count();
    if (threads > MOST_SET_BYTES / bytes) threads = (unsigned)(MOST_SET_BYTES / bytes);
    pthread_mutex_init(&g.lock, NULL);
    const sl_work work = {.job = &g,
                          .begin = begin,
                          .unit = gather_unit,
                          .end = end,
                          .stage = "see",
                          .units = "bundles of lines"};
    const size_t units = (segments->count + (size_t)SEGMENTS_A_UNIT) / SEGMENTS_A_UNIT;
    const sl_status status = sl_work_run(context, &work, units, threads ? threads : 1);
    pthread_mutex_destroy(&g.lock);
    if (status == SL_OK)
        *out = g.sets;
    else
        sl_view_sets_destroy(context, &g.sets);
    return status;
}
