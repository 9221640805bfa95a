/// Visibility propagation (Bittner & Havran 2002, Visibility Propagation): what reaches a node
/// passes the faces that look at the eye, and before them the nodes there. The frame's visible part
/// is star-shaped about the eye: where it has nothing before those faces it has nothing behind.
#include "walk/walk_parts.h"

/// The span of a box along an axis, open.
static bool overlap(const sl_box *a, const sl_box *b, int axis) {
    return axis ? a->min.y < b->max.y && b->min.y < a->max.y
                : a->min.x < b->max.x && b->min.x < a->max.x;
}

/// Whether all of a node's part at a face is in one state, invisible or visible. A search among
/// the nodes that lie at the face, down to where this frame's visits ended.
static bool uniform(const sl_walk *w, int32_t id, const sl_box *box, int face,
                    sl_node_state *state) {
    const sl_hierarchy *h = w->hierarchy;
    const sl_walk_node *n = &h->nodes[id];
    const sl_walk_memory *m = &w->nodes[id];
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

/// The state of what lies before a face: of the rope's node, or of the one above it where this
/// frame's visits ended.
static bool face_state(const sl_walk *w, const sl_walk_node *n, int face, sl_node_state *state) {
    int32_t at = n->rope[face];
    if (at < 0) return false;
    while (at > 0 && w->nodes[at].frame != w->frame) at = w->hierarchy->nodes[at].parent;
    return uniform(w, at, &n->box, face, state);
}

/// Whether no chosen occluder can touch a box: by the boxes around them.
static bool is_free(const sl_walk *w, const sl_box *b) {
    const sl_shadows *s = &w->occlusion->shadows;
    for (size_t i = 0; i < s->occluders.count; i++) {
        const sl_point p = s->occluders.items[i].a, q = s->occluders.items[i].b;
        const bool apart = (p.x < b->min.x && q.x < b->min.x) ||
                           (p.x > b->max.x && q.x > b->max.x) ||
                           (p.y < b->min.y && q.y < b->min.y) || (p.y > b->max.y && q.y > b->max.y);
        if (!apart) return false;
    }
    return true;
}

bool sl_walk_propagate(const sl_walk *w, uint32_t node, sl_node_state *state) {
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
    // What is drawn for being cheap may be hidden all the same, and tells nothing of what is
    // behind.
    return *state == SL_NODE_INVISIBLE || (!w->options.cheap && is_free(w, &n->box));
}
