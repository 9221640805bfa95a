/// The shadows of a frame's occluders, merged in one of two ways.
///
/// Directions about the eye are cut at the occluders' ends into leaves. Each leaf lists the
/// occluders that span it and may be the nearest there: none where sight is free, one nearly
/// always, and several only where walls cross. A shape is before or behind the list, leaf by leaf,
/// by exact predicates.
///
/// The occlusion tree (Bittner, Havran & Slavik 1998, Hierarchical Visibility Culling with
/// Occlusion Trees; here in the plane) is a binary tree of rays:
///
///        ray 1 \     / ray 2               1         A node splits directions by a ray to an
///           A   \ B / C                   / \        occluder's end. An occluder sinks to the
///                eye                     A   2       leaves that its directions reach, and cuts
///                                           / \      those where it hides something. A shape is
///                                          B   C     looked up in the same way.
///
/// The angular intervals are the same leaves in one sorted array. A shape is looked up by binary
/// search from the leaf of its rightmost direction on.
///
/// Cost of a lookup: O(depth) for the tree, O(log n) for the array, and O(1) for each leaf within.
/// An occluder costs the same in the tree; in the array it moves what comes after it, O(n).
#include "study/walk/shape.h"

#include <math.h>
#include <string.h>

// --- leaves

/// Whether a leaf's occluders already hide what one hides within the leaf.
static bool leaf_hides(sli_shadows *shadows, int32_t leaf, uint32_t occluder) {
    const sli_occluder *occluders = shadows->occluders.items;
    for (; leaf >= 0; leaf = shadows->shadows.items[leaf].next)
        if (sli_occluder_is_behind(&occluders[occluder],
                                   &occluders[shadows->shadows.items[leaf].occluder]))
            return true;
    return false;
}

static sl_status put(sl_context *context, sli_shadows *shadows, uint32_t occluder, int32_t next,
                     int32_t *out) {
    SL_TRY(SL_ARRAY_ROOM(context, &shadows->shadows, 1));
    *out = (int32_t)shadows->shadows.count;
    shadows->shadows.items[shadows->shadows.count++] = (sli_shadow){occluder, next};
    return SL_OK;
}

/// Makes the list of a leaf with an occluder added, without those that it hides.
static sl_status add_to_leaf(sl_context *context, sli_shadows *shadows, int32_t leaf,
                             uint32_t occluder, int32_t *out) {
    int32_t kept = -1;
    for (; leaf >= 0; leaf = shadows->shadows.items[leaf].next) {
        const uint32_t other = shadows->shadows.items[leaf].occluder;
        const sli_occluder *o = shadows->occluders.items;
        if (!sli_occluder_is_behind(&o[other], &o[occluder]))
            SL_TRY(put(context, shadows, other, kept, &kept));
    }
    return put(context, shadows, occluder, kept, out);
}

/// Adds to the bits where a shape lies about the occluders of one leaf.
static void query_leaf(sli_shadows *shadows, int32_t leaf, const sli_shape *shape,
                       const sli_wedge *wedge, unsigned *bits) {
    unsigned before = SLI_BEFORE;
    for (; leaf >= 0 && *bits != SLI_BOTH_SIDES; leaf = shadows->shadows.items[leaf].next) {
        const uint32_t o = shadows->shadows.items[leaf].occluder;
        const unsigned about =
            sli_shape_about(&shadows->pivot, shape, wedge, &shadows->occluders.items[o]);
        *bits |= about & SLI_BEHIND;
        before &= about;
    }
    *bits |= before;
}

// --- the occlusion tree

/// A child c >= 0 is node c; a child c < 0 is leaf ~c.
typedef struct tree_node {
    sli_ray ray;
    int32_t left, right;
} tree_node;

typedef struct tree {
    sli_occlusion base;
    SL_ARRAY(tree_node) nodes;
    SL_ARRAY(int32_t) leaves; ///< shadows; -1 for none
    int32_t root;
} tree;

static sl_status tree_create(sl_context *context, sli_occlusion **out) {
    tree *t = sl_alloc_array(context, 1, sizeof *t);
    if (!t) return SL_NO_MEMORY;
    *out = &t->base;
    return SL_OK;
}

static void tree_destroy(sl_context *context, sli_occlusion *occlusion) {
    tree *t = (tree *)occlusion;
    sl_free(context, t->nodes.items);
    sl_free(context, t->leaves.items);
    sl_free(context, t);
}

static sl_status add_leaf(sl_context *context, tree *t, int32_t shadows, int32_t *out) {
    SL_TRY(SL_ARRAY_ROOM(context, &t->leaves, 1));
    *out = ~(int32_t)t->leaves.count;
    t->leaves.items[t->leaves.count++] = shadows;
    return SL_OK;
}

static sl_status tree_clear(sl_context *context, sli_occlusion *occlusion, sl_point eye) {
    tree *t = (tree *)occlusion;
    (void)eye;
    t->nodes.count = t->leaves.count = 0;
    return add_leaf(context, t, -1, &t->root);
}

/// An occluder on its way down the tree.
typedef struct sinking {
    tree *tree;
    sl_context *context;
    uint32_t occluder;
    bool added;
} sinking;

/// A part of an occluder; `own`: a border is an end of the occluder, and no ray of the tree yet.
typedef struct part {
    sli_wedge wedge;
    bool own_right, own_left;
} part;

/// Puts a node with this ray in place of a child. On the other side of the ray is a new leaf, with
/// the shadows that were there.
static sl_status cut(sinking *s, sli_ray ray, bool child_left, int32_t shadows, int32_t *child) {
    tree *t = s->tree;
    int32_t rest;
    SL_TRY(add_leaf(s->context, t, shadows, &rest));
    SL_TRY(SL_ARRAY_ROOM(s->context, &t->nodes, 1));
    t->nodes.items[t->nodes.count] =
        (tree_node){ray, child_left ? *child : rest, child_left ? rest : *child};
    *child = (int32_t)t->nodes.count++;
    return SL_OK;
}

static sl_status reach_leaf(sinking *s, const part *p, int32_t *place) {
    tree *t = s->tree;
    const int32_t leaf = ~*place, shadows = t->leaves.items[leaf];
    if (leaf_hides(&t->base.shadows, shadows, s->occluder)) return SL_OK;
    s->added = true;
    int32_t merged;
    SL_TRY(add_to_leaf(s->context, &t->base.shadows, shadows, s->occluder, &merged));
    t->leaves.items[leaf] = merged;
    if (p->own_left) SL_TRY(cut(s, p->wedge.left, false, shadows, place));
    return p->own_right ? cut(s, p->wedge.right, true, shadows, place) : SL_OK;
}

static sl_status sink(sinking *s, const part *p, int32_t *place) {
    if (*place < 0) return reach_leaf(s, p, place);
    tree *t = s->tree;
    const int32_t node = *place;
    const sli_ray ray = t->nodes.items[node].ray;
    const sli_split split = sli_wedge_split(&t->base.shadows.pivot, &p->wedge, ray);
    // Nodes may move while a part sinks: a child is put back by its node's number.
    if (sli_has_left(split)) {
        const part left = {sli_left_part(&p->wedge, split, ray), p->own_right && split.right > 0,
                           p->own_left && split.left > 0};
        int32_t child = t->nodes.items[node].left;
        SL_TRY(sink(s, &left, &child));
        t->nodes.items[node].left = child;
    }
    if (sli_has_right(split)) {
        const part right = {sli_right_part(&p->wedge, split, ray), p->own_right && split.right < 0,
                            p->own_left && split.left < 0};
        int32_t child = t->nodes.items[node].right;
        SL_TRY(sink(s, &right, &child));
        t->nodes.items[node].right = child;
    }
    return SL_OK;
}

static sl_status tree_add(sl_context *context, sli_occlusion *occlusion, uint32_t occluder,
                          const sli_wedge *wedge, bool *added) {
    tree *t = (tree *)occlusion;
    sinking s = {t, context, occluder, false};
    const part whole = {*wedge, true, true};
    int32_t root = t->root;
    const sl_status status = sink(&s, &whole, &root);
    t->root = root;
    *added = *added || s.added;
    return status;
}

/// The constrained search: goes down with the part of the shape's directions on each side.
static void search(tree *t, int32_t place, const sli_shape *shape, const sli_wedge *wedge,
                   unsigned *bits) {
    sli_wedge here = *wedge;
    while (place >= 0) {
        const tree_node *node = &t->nodes.items[place];
        const sli_split split = sli_wedge_split(&t->base.shadows.pivot, &here, node->ray);
        const bool goes_right = sli_has_right(split);
        if (goes_right && sli_has_left(split)) {
            const sli_wedge left = sli_left_part(&here, split, node->ray);
            search(t, node->left, shape, &left, bits);
            if (*bits == SLI_BOTH_SIDES) return;
            here = sli_right_part(&here, split, node->ray);
        }
        place = goes_right ? node->right : node->left;
    }
    query_leaf(&t->base.shadows, t->leaves.items[~place], shape, &here, bits);
}

static void tree_query(sli_occlusion *occlusion, const sli_shape *shape, const sli_wedge *wedge,
                       unsigned *bits) {
    tree *t = (tree *)occlusion;
    search(t, t->root, shape, wedge, bits);
}

const sli_node_test_calls sli_occlusion_tree = {tree_create, tree_destroy, tree_clear, tree_add,
                                                tree_query};

// --- the array of angular intervals

/// From its own ray to the ray of the next interval, at most 180 degrees.
typedef struct interval {
    sli_ray right;
    int32_t shadows; ///< -1 for none
} interval;

typedef struct intervals {
    sli_occlusion base;
    SL_ARRAY(interval) all;
} intervals;

static sl_status intervals_create(sl_context *context, sli_occlusion **out) {
    intervals *v = sl_alloc_array(context, 1, sizeof *v);
    if (!v) return SL_NO_MEMORY;
    *out = &v->base;
    return SL_OK;
}

static void intervals_destroy(sl_context *context, sli_occlusion *occlusion) {
    intervals *v = (intervals *)occlusion;
    sl_free(context, v->all.items);
    sl_free(context, v);
}

/// Starts with two halves of the plane. The order begins to the right of the eye.
static sl_status intervals_clear(sl_context *context, sli_occlusion *occlusion, sl_point eye) {
    intervals *v = (intervals *)occlusion;
    v->all.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &v->all, 2));
    const sli_ray east = sli_ray_to((sl_point){eye.x + fabs(eye.x) + 1, eye.y});
    v->all.items[v->all.count++] = (interval){east, -1};
    v->all.items[v->all.count++] = (interval){sli_ray_back(east), -1};
    return SL_OK;
}

/// Whether a ray is in the first half of the order, counter-clockwise from right of the eye.
static bool in_first_half(const intervals *v, sli_ray ray) {
    const sl_point eye = v->base.shadows.pivot.eye;
    const bool up = ray.point.y > eye.y || (ray.point.y == eye.y && ray.point.x > eye.x);
    return up != ray.away;
}

/// The order of two rays: -1, 0, 1.
static int compare(intervals *v, sli_ray a, sli_ray b) {
    const bool first_a = in_first_half(v, a), first_b = in_first_half(v, b);
    if (first_a != first_b) return first_a ? -1 : 1;
    return -sli_ray_turn(&v->base.shadows.pivot, a, b);
}

/// The interval that a ray is in, its own start included.
static size_t find(intervals *v, sli_ray ray, bool *at_start) {
    size_t low = 0, high = v->all.count;
    *at_start = false;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        const int order = compare(v, v->all.items[middle].right, ray);
        if (order > 0)
            high = middle;
        else
            low = middle;
        if (order == 0) break;
    }
    *at_start = compare(v, v->all.items[low].right, ray) == 0;
    return low;
}

static size_t after(const intervals *v, size_t i) {
    return i + 1 < v->all.count ? i + 1 : 0;
}

/// Cuts the interval that a ray is in at the ray; *place is where the new one starts.
static sl_status start_at(sl_context *context, intervals *v, sli_ray ray, size_t *place) {
    bool there;
    *place = find(v, ray, &there);
    if (there) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &v->all, 1));
    interval *at = &v->all.items[*place + 1];
    memmove(at + 1, at, (v->all.count - *place - 1) * sizeof *at);
    *at = (interval){ray, v->all.items[*place].shadows};
    v->all.count++;
    (*place)++;
    return SL_OK;
}

/// The first and the last interval that share directions with a wedge.
static void span(intervals *v, const sli_wedge *wedge, size_t *first, size_t *last) {
    bool at_start;
    *first = find(v, wedge->right, &at_start);
    *last = find(v, wedge->left, &at_start);
    if (at_start) *last = *last ? *last - 1 : v->all.count - 1;
}

static bool hides_all(intervals *v, const sli_wedge *wedge, uint32_t occluder) {
    size_t first, last;
    span(v, wedge, &first, &last);
    for (size_t i = first;; i = after(v, i)) {
        if (!leaf_hides(&v->base.shadows, v->all.items[i].shadows, occluder)) return false;
        if (i == last) return true;
    }
}

static sl_status intervals_add(sl_context *context, sli_occlusion *occlusion, uint32_t occluder,
                               const sli_wedge *wedge, bool *added) {
    intervals *v = (intervals *)occlusion;
    size_t first, last;
    if (hides_all(v, wedge, occluder)) return SL_OK;
    SL_TRY(start_at(context, v, wedge->right, &first));
    SL_TRY(start_at(context, v, wedge->left, &last));
    span(v, wedge, &first, &last);
    *added = true;
    for (size_t i = first;; i = after(v, i)) {
        int32_t *shadows = &v->all.items[i].shadows;
        if (!leaf_hides(&v->base.shadows, *shadows, occluder))
            SL_TRY(add_to_leaf(context, &v->base.shadows, *shadows, occluder, shadows));
        if (i == last) return SL_OK;
    }
}

static void intervals_query(sli_occlusion *occlusion, const sli_shape *shape,
                            const sli_wedge *wedge, unsigned *bits) {
    intervals *v = (intervals *)occlusion;
    size_t first, last;
    span(v, wedge, &first, &last);
    for (size_t i = first; *bits != SLI_BOTH_SIDES; i = after(v, i)) {
        sli_wedge here = *wedge;
        if (i != first) here.right = v->all.items[i].right;
        if (i != last) here.left = v->all.items[after(v, i)].right;
        query_leaf(&v->base.shadows, v->all.items[i].shadows, shape, &here, bits);
        if (i == last) return;
    }
}

const sli_node_test_calls sli_occlusion_intervals = {
    intervals_create, intervals_destroy, intervals_clear, intervals_add, intervals_query};
