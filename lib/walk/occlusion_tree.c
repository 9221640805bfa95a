/// The occlusion tree: shadows merged into a binary tree (Bittner, Havran & Slavik 1998,
/// Hierarchical visibility culling with occlusion trees; in the plane). A node splits directions by
/// the line of a ray to an occluder's end. A part of an occluder sinks to the leaves that its
/// directions reach, and cuts those where it hides something; a shape is looked up the same way.
#include "walk/occlusion.h"

/// A child c >= 0 is node c; a child c < 0 is leaf ~c.
typedef struct tree_node {
    sl_ray ray;
    int32_t left, right;
} tree_node;

typedef struct tree {
    sl_occlusion base;
    SL_ARRAY(tree_node) nodes;
    SL_ARRAY(int32_t) leaves; ///< shadows; -1 for none
    int32_t root;
} tree;

static sl_status create(sl_context *context, sl_occlusion **out) {
    tree *t = sl_alloc_array(context, 1, sizeof *t);
    if (!t) return SL_NO_MEMORY;
    *out = &t->base;
    return SL_OK;
}

static void destroy(sl_context *context, sl_occlusion *occlusion) {
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

static sl_status clear(sl_context *context, sl_occlusion *occlusion, sl_point eye) {
    tree *t = (tree *)occlusion;
    (void)eye;
    t->nodes.count = t->leaves.count = 0;
    return add_leaf(context, t, -1, &t->root);
}

/// An occluder on its way down.
typedef struct sinking {
    tree *tree;
    sl_context *context;
    uint32_t occluder;
    bool added;
} sinking;

/// A part of an occluder; `own`: a border is an end of the occluder, and no ray of the tree yet.
typedef struct part {
    sl_sector sector;
    bool own_right, own_left;
} part;

/// Puts a ray over a child: what is not on the child's side of it is a leaf with what was there.
static sl_status cut(sinking *s, sl_ray ray, bool child_left, int32_t shadows, int32_t *child) {
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
    if (sl_shadows_hide(&t->base.shadows, shadows, s->occluder)) return SL_OK;
    s->added = true;
    int32_t merged;
    SL_TRY(sl_shadows_add(s->context, &t->base.shadows, shadows, s->occluder, &merged));
    t->leaves.items[leaf] = merged;
    if (p->own_left) SL_TRY(cut(s, p->sector.left, false, shadows, place));
    return p->own_right ? cut(s, p->sector.right, true, shadows, place) : SL_OK;
}

static sl_status sink(sinking *s, const part *p, int32_t *place) {
    if (*place < 0) return reach_leaf(s, p, place);
    tree *t = s->tree;
    const int32_t node = *place;
    const sl_ray ray = t->nodes.items[node].ray;
    const sl_split split = sl_sector_split(&t->base.shadows.pivot, &p->sector, ray);
    // Nodes may move while a part sinks: a child is put back by its node's number.
    if (sl_has_left(split)) {
        const part left = {sl_left_part(&p->sector, split, ray), p->own_right && split.right > 0,
                           p->own_left && split.left > 0};
        int32_t child = t->nodes.items[node].left;
        SL_TRY(sink(s, &left, &child));
        t->nodes.items[node].left = child;
    }
    if (sl_has_right(split)) {
        const part right = {sl_right_part(&p->sector, split, ray), p->own_right && split.right < 0,
                            p->own_left && split.left < 0};
        int32_t child = t->nodes.items[node].right;
        SL_TRY(sink(s, &right, &child));
        t->nodes.items[node].right = child;
    }
    return SL_OK;
}

static sl_status add(sl_context *context, sl_occlusion *occlusion, uint32_t occluder,
                     const sl_sector *sector, bool *added) {
    tree *t = (tree *)occlusion;
    sinking s = {t, context, occluder, false};
    const part whole = {*sector, true, true};
    int32_t root = t->root;
    const sl_status status = sink(&s, &whole, &root);
    t->root = root;
    *added = *added || s.added;
    return status;
}

/// The constrained search: goes down with what of the shape's directions is left.
static void search(tree *t, int32_t place, const sl_shape *shape, const sl_sector *sector,
                   unsigned *bits) {
    sl_sector here = *sector;
    while (place >= 0) {
        const tree_node *node = &t->nodes.items[place];
        const sl_split split = sl_sector_split(&t->base.shadows.pivot, &here, node->ray);
        const bool goes_right = sl_has_right(split);
        if (goes_right && sl_has_left(split)) {
            const sl_sector left = sl_left_part(&here, split, node->ray);
            search(t, node->left, shape, &left, bits);
            if (*bits == SL_LOOK_BOTH) return;
            here = sl_right_part(&here, split, node->ray);
        }
        place = goes_right ? node->right : node->left;
    }
    sl_shadows_look(&t->base.shadows, t->leaves.items[~place], shape, &here, bits);
}

static void look(sl_occlusion *occlusion, const sl_shape *shape, const sl_sector *sector,
                 unsigned *bits) {
    tree *t = (tree *)occlusion;
    search(t, t->root, shape, sector, bits);
}

const sl_node_test_calls sl_occlusion_tree = {create, destroy, clear, add, look};
