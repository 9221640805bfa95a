#include "walk/walk_parts.h"

static const sl_node_test tests[] = {
    {"tree", "shadows merged into a binary tree of directions", &sl_occlusion_tree},
    {"intervals", "shadows merged into an array of angular intervals", &sl_occlusion_intervals},
};

const sl_node_test *sl_node_tests(size_t *count) {
    *count = sizeof tests / sizeof *tests;
    return tests;
}

static const sl_walk_method methods[] = {
    {"classical", "A: every node from the root down, in every frame", SL_WALK_AS_CLASSICAL, 0},
    {"updating", "B: hierarchy updating: nodes that the last frame opened are not tested",
     SL_WALK_AS_CLASSICAL, SL_WALK_UPDATES},
    {"propagation", "C: B, and states are taken from neighbours, by chance --p-vp",
     SL_WALK_AS_CLASSICAL, SL_WALK_UPDATES | SL_WALK_PROPAGATES},
    {"skipping", "D: C, and what was drawn is drawn again, by chance --p-skip", SL_WALK_MAYBE_MORE,
     SL_WALK_UPDATES | SL_WALK_PROPAGATES | SL_WALK_SKIPS},
    {"adaptive", "D with both chances set by each node's history", SL_WALK_MAYBE_MORE,
     SL_WALK_UPDATES | SL_WALK_PROPAGATES | SL_WALK_SKIPS | SL_WALK_ADAPTS},
    {"predicting", "B, and leaves are taken to stay partially visible, by their history",
     SL_WALK_MAYBE_MORE, SL_WALK_UPDATES | SL_WALK_PREDICTS},
    {"bounded", "B, and nothing is tested before the eye has moved far enough to change its state",
     SL_WALK_MAYBE_EITHER, SL_WALK_UPDATES | SL_WALK_BOUNDS},
    {"combined", "bounded and predicting", SL_WALK_MAYBE_EITHER,
     SL_WALK_UPDATES | SL_WALK_BOUNDS | SL_WALK_PREDICTS},
};

const sl_walk_method *sl_walk_methods(size_t *count) {
    *count = sizeof methods / sizeof *methods;
    return methods;
}

sl_walk_options sl_walk_options_default(void) {
    return (sl_walk_options){.test = tests, .occluders = 16, .p_vp = 0.5, .p_skip = 0.5, .seed = 1};
}
