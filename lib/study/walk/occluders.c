/// The choice of occluders: greedily, those that take up the largest angles about the eye.
///
/// A heap holds walls and nodes, by the angle that a wall, or the longest wall inside a node, can
/// take up. The largest comes first. A node that is already hidden is dropped with all that is
/// inside; else its walls and children go on the heap. A wall is chosen where it hides anything in
/// the view cone that was free.
///
/// Angles are estimates in doubles: they decide only the order. What is hidden is decided exactly,
/// by the node visibility test. Cost: O(log n) for each node and wall that leaves the heap.
#include "base/heap.h"
#include "geometry/length.h"
#include "study/walk/walk_parts.h"

#include <math.h>

/// A wall, or a node.
typedef struct candidate {
    double size; ///< grows with the angle
    uint32_t number;
    bool is_node;
} candidate;

static inline bool is_before(const candidate *a, const candidate *b) {
    return a->size > b->size;
}

SLI_HEAP(queue, candidate, is_before)

struct sli_chooser {
    const sl_hierarchy *hierarchy;
    double *longest; ///< by node: the longest wall in it, scaled
    queue queue;
    double scale; ///< brings coordinates near 1, so that no product overflows
    // Of the frame:
    sli_walk_cone cone;
    sl_point eye, right, left;
};

static void find_longest(sli_chooser *c) {
    const sl_hierarchy *h = c->hierarchy;
    for (uint32_t i = h->node_count; i-- > 0;) {
        for (uint32_t k = h->first_occluder[i]; k < h->first_occluder[i + 1]; k++) {
            const sl_segment *s = &h->occluders[k];
            const double length =
                sli_length((s->b.x - s->a.x) * c->scale, (s->b.y - s->a.y) * c->scale);
            c->longest[i] = fmax(c->longest[i], length);
        }
        const int32_t parent = h->nodes[i].parent;
        if (parent >= 0) c->longest[parent] = fmax(c->longest[parent], c->longest[i]);
    }
}

sl_status sli_chooser_create(sl_context *context, const sl_hierarchy *h, sli_chooser **out) {
    sli_chooser *c = sl_alloc_array(context, 1, sizeof *c);
    if (!c) return SL_NO_MEMORY;
    c->hierarchy = h;
    c->longest = sl_alloc_array(context, h->node_count, sizeof *c->longest);
    if (!c->longest) {
        sli_chooser_destroy(context, c);
        return SL_NO_MEMORY;
    }
    const sl_box *b = &h->space->bounds;
    c->scale = 1 / fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    find_longest(c);
    *out = c;
    return SL_OK;
}

void sli_chooser_destroy(sl_context *context, sli_chooser *chooser) {
    if (chooser) sl_free(context, chooser->queue.items);
    if (chooser) sl_free(context, chooser->longest);
    sl_free(context, chooser);
}

/// The size of a wall from p to q as seen from the eye: minus the signed square of the angle's
/// cosine; -2 for a wall outside the cone or edge-on.
static double wall_size(const sli_chooser *c, sl_point p, sl_point q) {
    if (sli_cross(p, q) < 0) {
        const sl_point turned = p;
        p = q;
        q = turned;
    }
    if (c->cone.kind == SLI_CONE_WEDGE) {
        if (sli_cross(c->right, p) < 0) p = c->right;
        if (sli_cross(q, c->left) < 0) q = c->left;
    }
    const double turn = sli_cross(p, q);
    if (!(turn > 0)) return -2;
    const double dot = sli_dot(p, q);
    const double size = -(dot * fabs(dot)) / (sli_dot(p, p) * sli_dot(q, q));
    return size >= -1 ? size : -1;
}

/// An upper estimate for walls inside a node: as long as the longest, at the node's distance, and
/// square to the line of sight.
static double node_size(const sli_chooser *c, uint32_t node) {
    const sl_box *b = &c->hierarchy->nodes[node].box;
    const double x = fmax(fmax(b->min.x - c->eye.x, c->eye.x - b->max.x), 0) * c->scale;
    const double y = fmax(fmax(b->min.y - c->eye.y, c->eye.y - b->max.y), 0) * c->scale;
    const double far = 4 * (x * x + y * y), length = c->longest[node] * c->longest[node];
    const double cosine = (far - length) / (far + length);
    return length > 0 ? -cosine * fabs(cosine) : -2;
}

static sl_status push_candidate(sl_context *context, sli_chooser *c, candidate what) {
    return what.size >= -1 ? queue_push(context, &c->queue, what) : SL_OK;
}

static sl_point toward(const sli_chooser *c, sl_point at) {
    return (sl_point){(at.x - c->eye.x) * c->scale, (at.y - c->eye.y) * c->scale};
}

static sl_status push_node(sl_context *context, sli_chooser *c, uint32_t node) {
    return push_candidate(context, c, (candidate){node_size(c, node), node, true});
}

/// Puts the contents of a node on the heap, unless it is hidden.
static sl_status open_node(sl_context *context, sli_chooser *c, sl_walk *w, uint32_t node) {
    const sl_hierarchy *h = c->hierarchy;
    const sl_walk_node *n = &h->nodes[node];
    sli_node_view seen;
    sli_walk_view_node(w, node, &seen);
    if (!seen.wedge_count || sli_walk_test(w, &seen) == SL_NODE_INVISIBLE) return SL_OK;
    for (uint32_t i = h->first_occluder[node]; i < h->first_occluder[node + 1]; i++) {
        const sl_segment *s = &h->occluders[i];
        const double size = wall_size(c, toward(c, s->a), toward(c, s->b));
        SL_TRY(push_candidate(context, c, (candidate){size, i, false}));
    }
    if (n->cell != SL_NO_CELL) return SL_OK;
    SL_TRY(push_node(context, c, (uint32_t)n->child[0]));
    return push_node(context, c, (uint32_t)n->child[1]);
}

/// Chooses a wall if it hides anything within the cone that was free.
static sl_status try_wall(sl_context *context, const sl_segment *wall, const sli_walk_cone *cone,
                          const sli_node_test_calls *test, sli_occlusion *occlusion) {
    sli_shadows *s = &occlusion->shadows;
    const int side = sli_orient(wall->a, wall->b, s->pivot.eye);
    if (!side) return SL_OK;
    const sli_occluder o =
        side > 0 ? (sli_occluder){wall->a, wall->b} : (sli_occluder){wall->b, wall->a};
    SL_TRY(SL_ARRAY_ROOM(context, &s->occluders, 1));
    const uint32_t number = (uint32_t)s->occluders.count++;
    s->occluders.items[number] = o;
    const sli_wedge whole = {sli_ray_to(o.a), sli_ray_to(o.b)};
    sli_wedge parts[2];
    bool cut = false, added = false;
    const unsigned count = sli_wedge_in_cone(&s->pivot, cone, &whole, parts, &cut);
    for (unsigned i = 0; i < count; i++)
        SL_TRY(test->add(context, occlusion, number, &parts[i], &added));
    if (!added) s->occluders.count--;
    return SL_OK;
}

sl_status sli_chooser_choose(sl_context *context, sl_walk *w, const sl_view *view) {
    sli_chooser *c = w->chooser;
    const sli_shadows *s = &w->occlusion->shadows;
    c->queue.count = 0;
    c->cone = w->cone;
    c->eye = view->eye;
    c->right = toward(c, view->right);
    c->left = toward(c, view->left);
    if (w->options.occluders) SL_TRY(push_node(context, c, 0));
    while (c->queue.count && s->occluders.count < w->options.occluders) {
        const candidate next = queue_pop(&c->queue);
        if (next.is_node)
            SL_TRY(open_node(context, c, w, next.number));
        else
            SL_TRY(try_wall(context, &c->hierarchy->occluders[next.number], &w->cone, w->test,
                            w->occlusion));
    }
    return SL_OK;
}
