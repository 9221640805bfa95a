/// A walk, frame by frame: down the hierarchy, each node through the tests from the cheapest on.
#include "sightline/walk.h"
#include "base/bits.h"
#include "walk/occlusion.h"

#include <string.h>

/// What is known of a node since it was last visited.
typedef struct walk_node {
    uint64_t frame; ///< when that was; 0 for never
    uint8_t state, reason;
} walk_node;

/// A node on the way: its numbers and the sectors of the cone that it lies in.
typedef struct looked {
    const sl_walk_node *node;
    sl_point box_corners[4];
    sl_shape shape;
    uint32_t sector_count;
    bool cut; ///< part of it is outside the cone
} looked;

struct sl_walk {
    const sl_hierarchy *hierarchy;
    sl_walk_options options;
    const sl_node_test_calls *test;
    sl_occlusion *occlusion;
    sl_chooser *chooser;
    sl_walk_cone cone;
    walk_node *nodes;
    uint32_t *stack;
    sl_sector *sectors; ///< those of the node at hand, within the cone
    sl_bits *cells;
    uint32_t *wall_counts; ///< by node, those of its cells added up
    uint64_t frame;
};

static const sl_node_test tests[] = {
    {"tree", "shadows merged into a BSP of directions", &sl_occlusion_tree},
    {"intervals", "shadows merged into an array of angular intervals", &sl_occlusion_intervals},
};

const sl_node_test *sl_node_tests(size_t *count) {
    *count = sizeof tests / sizeof *tests;
    return tests;
}

static const sl_walk_method methods[] = {
    {"classical", "every node from the root down, in every frame"},
};

const sl_walk_method *sl_walk_methods(size_t *count) {
    *count = sizeof methods / sizeof *methods;
    return methods;
}

sl_walk_options sl_walk_options_default(void) {
    return (sl_walk_options){.test = tests, .occluders = 16};
}

static sl_status check_options(sl_context *context, const sl_walk_options *options) {
    if (!options->test) return sl_fail(context, SL_BAD_ARGUMENT, "no node visibility test given");
    if (options->occluders > SL_WALK_OCCLUDERS_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT, "%u occluders: at most %d can be chosen",
                       options->occluders, SL_WALK_OCCLUDERS_MOST);
    return SL_OK;
}

static void count_walls(sl_walk *w) {
    const sl_hierarchy *h = w->hierarchy;
    for (uint32_t i = h->node_count; i-- > 0;) {
        const sl_walk_node *n = &h->nodes[i];
        if (n->cell != SL_NO_CELL)
            w->wall_counts[i] = h->first_wall[n->cell + 1] - h->first_wall[n->cell];
        if (i) w->wall_counts[n->parent] += w->wall_counts[i];
    }
}

static sl_status fill_walk(sl_context *context, sl_walk *w) {
    const sl_hierarchy *h = w->hierarchy;
    w->nodes = sl_alloc_array(context, h->node_count, sizeof *w->nodes);
    w->stack = sl_alloc_array(context, h->node_count, sizeof *w->stack);
    w->sectors = sl_alloc_array(context, 2 * (size_t)h->corner_most, sizeof *w->sectors);
    w->cells = sl_alloc_array(context, sl_bits_words(h->space->cell_count), sizeof *w->cells);
    w->wall_counts = sl_alloc_array(context, h->node_count, sizeof *w->wall_counts);
    if (!w->nodes || !w->stack || !w->sectors || !w->cells || !w->wall_counts) return SL_NO_MEMORY;
    count_walls(w);
    SL_TRY(
        sl_chooser_create(context, h->occluders, h->occluder_count, h->space->bounds, &w->chooser));
    return w->test->create(context, &w->occlusion);
}

sl_status sl_walk_create(sl_context *context, const sl_hierarchy *hierarchy,
                         const sl_walk_method *method, const sl_walk_options *options,
                         sl_walk **out) {
    SL_TRY(check_options(context, options));
    (void)method;
    sl_walk *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->hierarchy = hierarchy;
    w->options = *options;
    w->test = options->test->calls;
    const sl_status status = fill_walk(context, w);
    if (status == SL_OK)
        *out = w;
    else
        sl_walk_destroy(context, w);
    return status;
}

void sl_walk_destroy(sl_context *context, sl_walk *walk) {
    if (!walk) return;
    if (walk->occlusion) {
        sl_free(context, walk->occlusion->shadows.occluders.items);
        sl_free(context, walk->occlusion->shadows.shadows.items);
        walk->test->destroy(context, walk->occlusion);
    }
    sl_chooser_destroy(context, walk->chooser);
    sl_free(context, walk->nodes);
    sl_free(context, walk->stack);
    sl_free(context, walk->sectors);
    sl_free(context, walk->cells);
    sl_free(context, walk->wall_counts);
    sl_free(context, walk);
}

// --- one node

/// The node's shape and its sectors within the cone.
static void look_at(sl_walk *w, const sl_walk_node *n, looked *l) {
    const sl_space *space = w->hierarchy->space;
    sl_pivot *pivot = &w->occlusion->shadows.pivot;
    const sl_box *b = &n->box;
    l->node = n;
    l->cut = false;
    l->shape = (sl_shape){l->box_corners, 4, *b, true};
    if (n->cell != SL_NO_CELL && !w->hierarchy->tiles) {
        const sl_cell *c = &space->cells[n->cell];
        l->shape = (sl_shape){space->vertices + c->first_vertex, c->vertex_count, *b, false};
    } else {
        l->box_corners[0] = b->min;
        l->box_corners[1] = (sl_point){b->max.x, b->min.y};
        l->box_corners[2] = b->max;
        l->box_corners[3] = (sl_point){b->min.x, b->max.y};
    }
    l->sector_count = sl_shape_sectors(pivot, &l->shape, w->sectors);
    if (w->cone.kind == SL_CONE_ALL) return;
    // From the last on, so that the parts of one take the room behind those yet to come.
    uint32_t kept = 2 * w->hierarchy->corner_most;
    for (uint32_t i = l->sector_count; i-- > 0;) {
        sl_sector parts[2];
        const unsigned count = sl_sector_in_cone(pivot, &w->cone, &w->sectors[i], parts, &l->cut);
        for (unsigned k = count; k-- > 0;) w->sectors[--kept] = parts[k];
    }
    l->sector_count = 2 * w->hierarchy->corner_most - kept;
    memmove(w->sectors, w->sectors + kept, l->sector_count * sizeof *w->sectors);
}

static sl_node_state test_node(sl_walk *w, const looked *l) {
    unsigned bits = l->cut ? SL_BEHIND : 0;
    for (uint32_t i = 0; i < l->sector_count && bits != SL_LOOK_BOTH; i++)
        w->test->look(w->occlusion, &l->shape, &w->sectors[i], &bits);
    return bits == SL_LOOK_BOTH ? SL_NODE_PARTIAL
           : bits == SL_BEFORE  ? SL_NODE_VISIBLE
                                : SL_NODE_INVISIBLE;
}

static void decide(sl_walk *w, uint32_t id, sl_walk_frame *frame) {
    walk_node *state = &w->nodes[id];
    looked l;
    look_at(w, &w->hierarchy->nodes[id], &l);
    frame->frustum_tests++;
    if (!l.sector_count) {
        state->state = SL_NODE_INVISIBLE;
        state->reason = SL_WALK_FRUSTUM;
    } else if (w->wall_counts[id] <= w->options.cheap) {
        state->state = SL_NODE_VISIBLE;
        state->reason = SL_WALK_CHEAP;
        frame->cheap++;
    } else {
        state->state = (uint8_t)test_node(w, &l);
        state->reason = SL_WALK_TESTED;
        frame->tests++;
    }
}

// --- all nodes

static void draw_node(sl_walk *w, const sl_walk_node *n, sl_walk_frame *frame) {
    for (uint32_t i = 0; i < n->leaf_count; i++)
        sl_bits_add(w->cells, w->hierarchy->leaves[n->first_leaf + i]);
    frame->cells += n->leaf_count;
}

static void count_state(const walk_node *state, sl_walk_frame *frame) {
    frame->visited++;
    if (state->state == SL_NODE_VISIBLE) frame->visible++;
    if (state->state == SL_NODE_PARTIAL) frame->partial++;
    if (state->state != SL_NODE_INVISIBLE) return;
    if (state->reason == SL_WALK_FRUSTUM)
        frame->out++;
    else
        frame->invisible++;
}

static void go_down(sl_walk *w, sl_walk_frame *frame) {
    const sl_hierarchy *h = w->hierarchy;
    uint32_t waiting = 0;
    w->stack[waiting++] = 0;
    while (waiting) {
        const uint32_t id = w->stack[--waiting];
        const sl_walk_node *n = &h->nodes[id];
        walk_node *state = &w->nodes[id];
        decide(w, id, frame);
        state->frame = w->frame;
        count_state(state, frame);
        const bool leaf = n->cell != SL_NO_CELL;
        if (state->state == SL_NODE_VISIBLE || (leaf && state->state == SL_NODE_PARTIAL))
            draw_node(w, n, frame);
        if (state->state != SL_NODE_PARTIAL || leaf) continue;
        w->stack[waiting++] = (uint32_t)n->child[1];
        w->stack[waiting++] = (uint32_t)n->child[0];
    }
}

static sl_status choose(sl_context *context, sl_walk *w, const sl_view *view) {
    sl_shadows *shadows = &w->occlusion->shadows;
    shadows->pivot = (sl_pivot){view->eye, 0};
    shadows->occluders.count = shadows->shadows.count = 0;
    w->cone = sl_walk_cone_of(&shadows->pivot, view);
    SL_TRY(w->test->clear(context, w->occlusion, view->eye));
    return sl_chooser_choose(context, w->chooser, view, &w->cone, w->options.occluders, w->test,
                             w->occlusion);
}

sl_status sl_walk_step(sl_context *context, sl_walk *w, const sl_view *view, sl_walk_frame *out) {
    if (!sl_view_usable(view))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the eye and the borders of its cone must be finite, and not one point");
    SL_TRY(sl_check_cancelled(context));
    SL_TRY(choose(context, w, view));
    sl_walk_frame frame = {.occluders = (uint32_t)w->occlusion->shadows.occluders.count};
    w->frame++;
    memset(w->cells, 0, sl_bits_words(w->hierarchy->space->cell_count) * sizeof *w->cells);
    go_down(w, &frame);
    frame.orientations = w->occlusion->shadows.pivot.tests;
    *out = frame;
    return SL_OK;
}

sl_node_state sl_walk_state(const sl_walk *walk, uint32_t node, sl_walk_reason *reason) {
    int32_t at = (int32_t)node;
    while (at > 0 && walk->nodes[at].frame != walk->frame) at = walk->hierarchy->nodes[at].parent;
    *reason = (sl_walk_reason)walk->nodes[at].reason;
    return (sl_node_state)walk->nodes[at].state;
}

const uint64_t *sl_walk_cells(const sl_walk *walk) {
    return walk->cells;
}
