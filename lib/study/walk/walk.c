/// Walking with coherence: hierarchical visibility culling, frame by frame (Bittner & Havran 2002,
/// Exploiting Coherence in Hierarchical Visibility Algorithms).
///
/// Each frame chooses a few large occluders (occluders.c) and merges their shadow frusta
/// (occlusion.c). Then the hierarchy is traversed front to back. A node is outside the view cone,
/// invisible, visible, or partially visible; only a partially visible node is opened.
///
///   classical    tests every node that it reaches, from the root down
///   updating     skips the test of nodes that the last frame opened; states are pulled up
///   propagation  takes a node's state from the neighbours that its ropes lead to
///   skipping     takes what was drawn in the last frame as visible, by chance
///   bounded      tests nothing before the eye has moved far enough for a change (walk_bounds.c)
///
/// Invariant: no method draws less than what is seen. Where methods differ, walk.h says how.
/// Cost of a frame: one node visibility test for each node reached and not skipped; a test takes
/// about the logarithm of the number of occluders.
#include "sightline/walk.h"

#include "sight/cone.h"
#include "study/walk/walk_parts.h"

#include <string.h>

// --- the methods

static const sl_node_test tests[] = {
    {"tree", "shadows merged into a binary tree of directions", &sli_occlusion_tree},
    {"intervals", "shadows merged into an array of angular intervals", &sli_occlusion_intervals},
};

const sl_node_test *sl_node_tests(size_t *count) {
    *count = sizeof tests / sizeof *tests;
    return tests;
}

static const sl_walk_method methods[] = {
    {"classical", "A: every node from the root down, in every frame", SL_WALK_AS_CLASSICAL, 0},
    {"updating", "B: hierarchy updating: nodes that the last frame opened are not tested",
     SL_WALK_AS_CLASSICAL, SLI_WALK_UPDATES},
    {"propagation", "C: B, and states are taken from neighbours, by chance --p-vp",
     SL_WALK_AS_CLASSICAL, SLI_WALK_UPDATES | SLI_WALK_PROPAGATES},
    {"skipping", "D: C, and what was drawn is drawn again, by chance --p-skip", SL_WALK_MAYBE_MORE,
     SLI_WALK_UPDATES | SLI_WALK_PROPAGATES | SLI_WALK_SKIPS},
    {"adaptive", "D with both chances set by each node's history", SL_WALK_MAYBE_MORE,
     SLI_WALK_UPDATES | SLI_WALK_PROPAGATES | SLI_WALK_SKIPS | SLI_WALK_ADAPTS},
    {"predicting", "B, and leaves are taken to stay partially visible, by their history",
     SL_WALK_MAYBE_MORE, SLI_WALK_UPDATES | SLI_WALK_PREDICTS},
    {"bounded", "B, and nothing is tested before the eye has moved far enough to change its state",
     SL_WALK_MAYBE_EITHER, SLI_WALK_UPDATES | SLI_WALK_BOUNDS},
    {"combined", "bounded and predicting", SL_WALK_MAYBE_EITHER,
     SLI_WALK_UPDATES | SLI_WALK_BOUNDS | SLI_WALK_PREDICTS},
};

const sl_walk_method *sl_walk_methods(size_t *count) {
    *count = sizeof methods / sizeof *methods;
    return methods;
}

sl_walk_options sl_walk_options_default(void) {
    return (sl_walk_options){.test = tests, .occluders = 16, .p_vp = 0.5, .p_skip = 0.5, .seed = 1};
}

// --- the node visibility test

void sli_walk_view_node(sl_walk *w, uint32_t node, sli_node_view *seen) {
    const sl_walk_node *n = &w->hierarchy->nodes[node];
    const sl_space *space = w->hierarchy->space;
    sli_pivot *pivot = &w->occlusion->shadows.pivot;
    const sl_box *b = &n->box;
    seen->cut = false;
    seen->shape = (sli_shape){seen->box_corners, 4, *b, true};
    if (n->cell != SL_NO_CELL && !w->hierarchy->tiles) {
        const sl_cell *c = &space->cells[n->cell];
        seen->shape = (sli_shape){space->vertices + c->first_vertex, c->vertex_count, *b, false};
    } else {
        seen->box_corners[0] = b->min;
        seen->box_corners[1] = (sl_point){b->max.x, b->min.y};
        seen->box_corners[2] = b->max;
        seen->box_corners[3] = (sl_point){b->min.x, b->max.y};
    }
    seen->wedge_count = sli_shape_wedges(pivot, &seen->shape, w->wedges);
    if (w->cone.kind == SLI_CONE_ALL) return;
    // From the last wedge on: the parts of one take room behind those still to come.
    uint32_t kept = 2 * w->hierarchy->corner_most;
    for (uint32_t i = seen->wedge_count; i-- > 0;) {
        sli_wedge parts[2];
        const unsigned count = sli_wedge_in_cone(pivot, &w->cone, &w->wedges[i], parts, &seen->cut);
        for (unsigned k = count; k-- > 0;) w->wedges[--kept] = parts[k];
    }
    seen->wedge_count = 2 * w->hierarchy->corner_most - kept;
    memmove(w->wedges, w->wedges + kept, seen->wedge_count * sizeof *w->wedges);
}

sl_node_state sli_walk_test(sl_walk *w, const sli_node_view *seen) {
    unsigned bits = seen->cut ? SLI_BEHIND : 0;
    for (uint32_t i = 0; i < seen->wedge_count && bits != SLI_BOTH_SIDES; i++)
        w->test->query(w->occlusion, &seen->shape, &w->wedges[i], &bits);
    return bits == SLI_BOTH_SIDES ? SL_NODE_PARTIAL
           : bits == SLI_BEFORE   ? SL_NODE_VISIBLE
                                  : SL_NODE_INVISIBLE;
}

// --- visibility propagation: what reaches a node passes the faces that look at the eye, and before
// them the nodes there. The visible part of the plane is star-shaped about the eye: where it has
// nothing before those faces it has nothing behind.

/// Whether the open spans of two boxes along an axis overlap.
static bool overlap(const sl_box *a, const sl_box *b, int axis) {
    return axis ? a->min.y < b->max.y && b->min.y < a->max.y
                : a->min.x < b->max.x && b->min.x < a->max.x;
}

/// Whether all of a node's part at a face is in one state, invisible or visible. Searches the nodes
/// at the face, down to where this frame's visits ended.
static bool uniform(const sl_walk *w, int32_t id, const sl_box *box, int face,
                    sl_node_state *state) {
    const sl_hierarchy *h = w->hierarchy;
    const sl_walk_node *n = &h->nodes[id];
    const sli_walk_memory *m = &w->nodes[id];
    if (m->state != SL_NODE_PARTIAL) {
        *state = (sl_node_state)m->state;
        return true;
    }
    if (n->cell != SL_NO_CELL) return false;
    const int axis = face / 2;
    if (n->axis == axis) return uniform(w, n->child[face % 2 == 0], box, face, state);
    bool first = true;
    for (int side = 0; side < 2; side++) {
        sl_node_state part;
        if (!overlap(&h->nodes[n->child[side]].box, box, !axis)) continue;
        if (!uniform(w, n->child[side], box, face, &part) || (!first && part != *state))
            return false;
        *state = part;
        first = false;
    }
    return true;
}

/// The state of what lies before a face: that of the rope's node, or of the node above it where
/// this frame's visits ended.
static bool face_state(const sl_walk *w, const sl_walk_node *n, int face, sl_node_state *state) {
    int32_t at = n->rope[face];
    if (at < 0) return false;
    while (at > 0 && w->nodes[at].frame != w->frame) at = w->hierarchy->nodes[at].parent;
    return uniform(w, at, &n->box, face, state);
}

/// Whether no chosen occluder can touch a box, by their bounding boxes.
static bool is_free(const sl_walk *w, const sl_box *b) {
    const sli_shadows *s = &w->occlusion->shadows;
    for (size_t i = 0; i < s->occluders.count; i++) {
        const sl_point p = s->occluders.items[i].a, q = s->occluders.items[i].b;
        const bool apart = (p.x < b->min.x && q.x < b->min.x) ||
                           (p.x > b->max.x && q.x > b->max.x) ||
                           (p.y < b->min.y && q.y < b->min.y) || (p.y > b->max.y && q.y > b->max.y);
        if (!apart) return false;
    }
    return true;
}

/// The state of a node by its neighbours'; false where they do not decide it. The nodes before it,
/// front to back, must have been visited in this frame.
static bool propagate(const sl_walk *w, uint32_t node, sl_node_state *state) {
    const sl_walk_node *n = &w->hierarchy->nodes[node];
    const sl_point eye = w->occlusion->shadows.pivot.eye;
    const bool faces_eye[4] = {eye.x<n->box.min.x, eye.x> n->box.max.x,
                               eye.y<n->box.min.y, eye.y> n->box.max.y};
    bool first = true;
    for (int face = 0; face < 4; face++) {
        sl_node_state before;
        if (!faces_eye[face]) continue;
        if (!face_state(w, n, face, &before) || (!first && before != *state)) return false;
        *state = before;
        first = false;
    }
    if (first) return false;
    // A node drawn because it is cheap may be hidden. It says nothing about what is behind it.
    return *state == SL_NODE_INVISIBLE || (!w->options.cheap && is_free(w, &n->box));
}

// --- making a walk

static sl_status check_options(sl_context *context, const sl_walk_options *options) {
    if (!options->test) return sl_fail(context, SL_BAD_ARGUMENT, "no node visibility test given");
    if (options->occluders > SL_WALK_OCCLUDERS_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT, "%u occluders: at most %d can be chosen",
                       options->occluders, SL_WALK_OCCLUDERS_MOST);
    if (!(options->p_vp >= 0 && options->p_vp <= 1) ||
        !(options->p_skip >= 0 && options->p_skip <= 1))
        return sl_fail(context, SL_BAD_ARGUMENT, "chances %g and %g: from 0 to 1 is needed",
                       options->p_vp, options->p_skip);
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
    w->stack = sl_alloc_array(context, 2 * (size_t)h->node_count, sizeof *w->stack);
    w->wedges = sl_alloc_array(context, 2 * (size_t)h->corner_most, sizeof *w->wedges);
    w->cells = sl_alloc_array(context, sl_bits_words(h->space->cell_count), sizeof *w->cells);
    w->wall_counts = sl_alloc_array(context, h->node_count, sizeof *w->wall_counts);
    if (!w->nodes || !w->stack || !w->wedges || !w->cells || !w->wall_counts) return SL_NO_MEMORY;
    count_walls(w);
    SL_TRY(sli_chooser_create(context, h, &w->chooser));
    return w->test->create(context, &w->occlusion);
}

sl_status sl_walk_create(sl_context *context, const sl_hierarchy *hierarchy,
                         const sl_walk_method *method, const sl_walk_options *options,
                         sl_walk **out) {
    SL_TRY(check_options(context, options));
    sl_walk *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->hierarchy = hierarchy;
    w->method = method;
    w->options = *options;
    w->random.state = options->seed;
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
    sli_chooser_destroy(context, walk->chooser);
    sl_free(context, walk->nodes);
    sl_free(context, walk->stack);
    sl_free(context, walk->wedges);
    sl_free(context, walk->cells);
    sl_free(context, walk->wall_counts);
    sl_free(context, walk);
}

// --- one node

static bool does(const sl_walk *w, unsigned policy) {
    return (w->method->policies & policy) != 0;
}

static bool is_cheap(const sl_walk *w, uint32_t id) {
    return w->options.cheap && w->wall_counts[id] <= w->options.cheap;
}

static bool by_chance(sl_walk *w, double chance) {
    return sl_random_unit(&w->random) < chance;
}

/// Whether propagation takes the node's state from its neighbours. It is tried on nodes that were
/// not partially visible in the last frame: always where it last succeeded, else by chance.
static bool propagates(sl_walk *w, uint32_t id, bool known, sl_walk_frame *frame) {
    sli_walk_memory *m = &w->nodes[id];
    const bool again = known && m->spread;
    m->spread = false;
    if (!does(w, SLI_WALK_PROPAGATES) || !w->hierarchy->tiles ||
        (known && m->state == SL_NODE_PARTIAL))
        return false;
    const double chance = does(w, SLI_WALK_ADAPTS) ? sli_walk_share(&m->spreads) : w->options.p_vp;
    if (!again && !by_chance(w, chance)) return false;
    sl_node_state state = SL_NODE_INVISIBLE; // without its vectorizer gcc warns
    m->spread = propagate(w, id, &state);
    frame->propagations++;
    frame->propagated += m->spread;
    sli_walk_note(&m->spreads, m->spread);
    if (m->spread) m->state = (uint8_t)state;
    return m->spread;
}

/// Whether a node that the last frame ended at and drew is drawn again without a test. With chances
/// by history, the chance is 0 for a node that changes every second time.
static bool is_skipped(sl_walk *w, uint32_t id, bool known) {
    const sli_walk_memory *m = &w->nodes[id];
    const bool leaf = w->hierarchy->nodes[id].cell != SL_NO_CELL;
    if (!known || m->state == SL_NODE_INVISIBLE || (m->state == SL_NODE_PARTIAL && !leaf))
        return false;
    const double steady = 2 * sli_walk_share(&m->kept) - 1;
    if (does(w, SLI_WALK_PREDICTS)) return m->state == SL_NODE_PARTIAL && by_chance(w, steady);
    return does(w, SLI_WALK_SKIPS) &&
           by_chance(w, does(w, SLI_WALK_ADAPTS) ? steady : w->options.p_skip);
}

/// Whether the eye is still near enough for what is known of a node.
static bool still_holds(const sl_walk *w, const sli_walk_memory *m) {
    return m->bound > 0 && sli_walk_moved(m->from, w->view.eye) < m->bound;
}

/// Whether a node in the cone is known to be in view, and in which state.
static bool stays_seen(const sl_walk *w, const sli_node_view *seen, sli_walk_memory *m) {
    if (!still_holds(w, m) || m->known == SLI_WALK_HIDDEN ||
        (m->known == SLI_WALK_WITNESS && !sli_view_holds(&w->view, m->witness)))
        return false;
    m->state = m->known == SLI_WALK_IN_VIEW && !seen->cut ? SL_NODE_VISIBLE : SL_NODE_PARTIAL;
    return true;
}

static double find_bound(sl_walk *w, const sli_node_view *seen, bool leaf, sli_walk_memory *m) {
    m->known = SLI_WALK_HIDDEN;
    if (m->state == SL_NODE_INVISIBLE) return sli_walk_hidden_bound(w, seen);
    m->known = SLI_WALK_IN_VIEW;
    const double whole = m->state == SL_NODE_VISIBLE ? sli_walk_whole_bound(w, seen) : 0;
    if (whole > 0 || !leaf) return whole;
    m->known = SLI_WALK_WITNESS;
    return sli_walk_witness_bound(w, seen, &m->witness);
}

/// Finds how far the eye may move with a tested node in its state. Where no bound is found, the
/// next tests search for none, each time for twice as many.
static void note_bound(sl_walk *w, uint32_t id, const sli_node_view *seen) {
    enum { LONGEST = 15 };
    sli_walk_memory *m = &w->nodes[id];
    m->bound = 0;
    if (m->waiting) {
        m->waiting--;
        return;
    }
    m->from = w->view.eye;
    m->bound = find_bound(w, seen, w->hierarchy->nodes[id].cell != SL_NO_CELL, m);
    m->wait = m->bound > 0 ? 0 : m->wait < LONGEST ? (uint8_t)(2 * m->wait + 1) : m->wait;
    m->waiting = m->wait;
}

static void decide(sl_walk *w, uint32_t id, bool known, sl_walk_frame *frame) {
    sli_walk_memory *m = &w->nodes[id];
    if (m->known == SLI_WALK_HIDDEN && still_holds(w, m)) {
        m->state = SL_NODE_INVISIBLE;
        m->reason = SL_WALK_BOUNDED;
        frame->bounded++;
        return;
    }
    sli_node_view seen;
    sli_walk_view_node(w, id, &seen);
    frame->frustum_tests++;
    if (!seen.wedge_count) {
        m->state = SL_NODE_INVISIBLE;
        m->reason = SL_WALK_FRUSTUM;
        m->spread = false;
    } else if (is_cheap(w, id)) {
        m->state = SL_NODE_VISIBLE;
        m->reason = SL_WALK_CHEAP;
        frame->cheap++;
    } else if (propagates(w, id, known, frame)) {
        m->reason = SL_WALK_PROPAGATED;
    } else if (stays_seen(w, &seen, m)) {
        m->reason = SL_WALK_BOUNDED;
        frame->bounded++;
    } else if (is_skipped(w, id, known)) {
        if (!does(w, SLI_WALK_PREDICTS)) m->state = SL_NODE_VISIBLE;
        m->reason = SL_WALK_SKIPPED;
        frame->skipped++;
    } else {
        const bool drawn = known && m->state != SL_NODE_INVISIBLE;
        m->state = (uint8_t)sli_walk_test(w, &seen);
        m->reason = SL_WALK_TESTED;
        frame->tests++;
        if (does(w, SLI_WALK_BOUNDS)) note_bound(w, id, &seen);
        if (drawn) sli_walk_note(&m->kept, m->state != SL_NODE_INVISIBLE);
    }
}

// --- all nodes

static void draw_node(sl_walk *w, const sl_walk_node *n, sl_walk_frame *frame) {
    for (uint32_t i = 0; i < n->leaf_count; i++)
        sl_bits_add(w->cells, w->hierarchy->leaves[n->first_leaf + i]);
    frame->cells += n->leaf_count;
}

static void count_state(const sli_walk_memory *m, sl_walk_frame *frame) {
    if (m->state == SL_NODE_VISIBLE) frame->visible++;
    if (m->state == SL_NODE_PARTIAL) frame->partial++;
    if (m->state != SL_NODE_INVISIBLE) return;
    if (m->reason == SL_WALK_FRUSTUM)
        frame->out++;
    else
        frame->invisible++;
}

/// Whether a node is not tested because the last frame opened it. A node with a child that is drawn
/// without a test is tested: only the parent's test can find that child hidden.
static bool stays_open(const sl_walk *w, uint32_t id, bool known) {
    const sl_walk_node *n = &w->hierarchy->nodes[id];
    if (!does(w, SLI_WALK_UPDATES) || !known || n->cell != SL_NO_CELL ||
        w->nodes[id].state != SL_NODE_PARTIAL)
        return false;
    return !is_cheap(w, (uint32_t)n->child[0]) && !is_cheap(w, (uint32_t)n->child[1]);
}

/// A node whose children are all visible, or all invisible, is so too.
static void pull_up(sl_walk *w, uint32_t id) {
    const sl_walk_node *n = &w->hierarchy->nodes[id];
    const sli_walk_memory *a = &w->nodes[n->child[0]], *b = &w->nodes[n->child[1]];
    sli_walk_memory *m = &w->nodes[id];
    if (a->state != b->state || a->state == SL_NODE_PARTIAL) return;
    m->state = a->state;
    m->reason = a->reason == b->reason ? a->reason : (uint8_t)SL_WALK_PULLED_UP;
}

/// Which child of an opened node lies before the other; among the boxes of a mesh, mostly.
static int nearer_child(const sl_walk *w, const sl_walk_node *n) {
    return (n->axis ? w->view.eye.y : w->view.eye.x) >= n->position;
}

/// Visits a node; true where its children are to be visited.
static bool visit(sl_walk *w, uint32_t id, sl_walk_frame *frame) {
    const sl_walk_node *n = &w->hierarchy->nodes[id];
    sli_walk_memory *m = &w->nodes[id];
    const bool known = w->frame > 1 && m->frame == w->frame - 1;
    frame->visited++;
    if (stays_open(w, id, known)) {
        m->reason = SL_WALK_OPENED;
        m->spread = false;
        frame->opened++;
    } else {
        decide(w, id, known, frame);
    }
    m->frame = w->frame;
    const bool leaf = n->cell != SL_NO_CELL;
    if (m->state == SL_NODE_VISIBLE || (leaf && m->state == SL_NODE_PARTIAL))
        draw_node(w, n, frame);
    if (m->state == SL_NODE_PARTIAL && !leaf) return true;
    count_state(m, frame);
    return false;
}

enum { COMING_UP = 1 }; // a number on the stack is twice a node's, with this on the way back up

/// Visits nodes front to back, and opened nodes again on the way up.
static void go_down(sl_walk *w, sl_walk_frame *frame) {
    const sl_hierarchy *h = w->hierarchy;
    size_t waiting = 0;
    w->stack[waiting++] = 0;
    while (waiting) {
        const uint64_t top = w->stack[--waiting];
        const uint32_t id = (uint32_t)(top / 2);
        const sl_walk_node *n = &h->nodes[id];
        if (top & COMING_UP) {
            if (does(w, SLI_WALK_UPDATES)) pull_up(w, id);
            count_state(&w->nodes[id], frame);
        } else if (visit(w, id, frame)) {
            const int near = nearer_child(w, n);
            w->stack[waiting++] = top | COMING_UP;
            w->stack[waiting++] = 2 * (uint64_t)n->child[!near];
            w->stack[waiting++] = 2 * (uint64_t)n->child[near];
        }
    }
}

static sl_status choose(sl_context *context, sl_walk *w, const sl_view *view) {
    sli_shadows *shadows = &w->occlusion->shadows;
    w->moved = w->frame ? sli_walk_moved(w->view.eye, view->eye) : 0;
    w->view = *view;
    shadows->pivot = (sli_pivot){.eye = view->eye};
    shadows->occluders.count = shadows->shadows.count = 0;
    w->cone = sli_walk_cone_of(&shadows->pivot, view);
    SL_TRY(w->test->clear(context, w->occlusion, view->eye));
    return sli_chooser_choose(context, w, view);
}

sl_status sl_walk_step(sl_context *context, sl_walk *w, const sl_view *view, sl_walk_frame *out) {
    if (!sli_view_usable(view))
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
