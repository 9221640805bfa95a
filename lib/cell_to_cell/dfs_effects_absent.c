/// The searches over sequences where a build leaves effects out: they refuse to begin with any.
#include "cell_to_cell/dfs.h"
#include "effects/effects.h"
#include "sightline/explain.h"

sl_status sl_dfs_effects_create(sl_context *context, sl_dfs *all) {
    (void)all;
    return sl_effects_refuse(context);
}

void sl_dfs_effects_destroy(sl_context *context, sl_dfs *all) {
    (void)context, (void)all;
}

sl_status sl_dfs_effects_begin(sl_context *context, const sl_dfs *all, sl_dfs_thread *me) {
    (void)all, (void)me;
    return sl_effects_refuse(context);
}

void sl_dfs_effects_end(sl_context *context, sl_dfs_thread *me) {
    (void)context, (void)me;
}

sl_status sl_dfs_effects_search(sl_context *context, const sl_dfs *all, sl_dfs_thread *me,
                                uint32_t source) {
    (void)all, (void)me, (void)source;
    return sl_effects_refuse(context);
}

sl_status sl_dfs_effects_finish(sl_context *context, sl_dfs *all, sl_visibility *out) {
    (void)all, (void)out;
    return sl_effects_refuse(context);
}

sl_status sl_explain_by_mirror(sl_context *context, const sl_space *space, const sl_map *map,
                               const sl_explain_options *options, uint32_t depth,
                               sl_explanation *explanation) {
    (void)space, (void)map, (void)options, (void)depth, (void)explanation;
    return sl_effects_refuse(context);
}
