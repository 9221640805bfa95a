/// Makes cells of walls, and asks whether it is in doubt what is inside. A context of its own keeps
/// this quiet: progress and messages are those of reading.
#include "io/parts/plan_inside.h"

#include "sightline/faults.h"
#include "sightline/space.h"

static sl_status look(sl_context *quiet, sl_map *map, bool *sure) {
    const sl_subdivide_options rules = sl_subdivide_options_default();
    sl_space space = {0};
    sl_inside doubt;
    SL_TRY(sl_map_clean(quiet, map, NULL, NULL));
    SL_TRY(sl_map_find_inside(quiet, map, NULL, NULL));
    SL_TRY(sl_subdivision_for(map)->subdivide(quiet, map, &rules, &space));
    const sl_status status = sl_doubt_inside(quiet, map, &space, &doubt);
    *sure = status == SL_OK && doubt == SL_INSIDE_SURE;
    sl_space_destroy(quiet, &space);
    return status;
}

sl_status sli_plan_inside(sl_context *context, sl_map *map, bool *sure) {
    sl_hooks hooks = *sl_context_hooks(context);
    *sure = false;
    hooks.progress = NULL;
    hooks.note = NULL;
    sl_context *quiet = sl_context_create(&hooks);
    if (!quiet) return SL_NO_MEMORY;
    const sl_status status = look(quiet, map, sure);
    sl_context_destroy(quiet);
    return status == SL_NO_MEMORY || status == SL_CANCELLED ? status : SL_OK;
}
