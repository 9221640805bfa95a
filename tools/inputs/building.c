/// Buildings as input: where a place is, how a storey's plan is read, and whether units agree.
#include "inputs/building.h"

#include <string.h>

bool input_is_building(const char *path) {
    return name_ends_with(path, BUILDING_ENDING);
}

sl_status building_read(sl_context *context, const char *path, const map_pipeline *pipeline,
                        sl_building *out) {
    if (pipeline->start_text)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--start %s: a building has several plans; put the start into one of them",
                       pipeline->start_text);
    SL_TRY(sl_building_read(context, path, out));
    for (size_t i = 0; i < out->storey_count; i++) {
        const sl_storey *s = &out->storeys[i];
        if (sl_path_look(s->path) == SL_PATH_FILE) continue;
        const sl_status status = sl_fail_at(context, path, s->line,
                                            "storey %s: there is no file '%s'", s->name, s->path);
        sl_building_destroy(context, out);
        return status;
    }
    return SL_OK;
}

sl_status building_pipeline(sl_context *context, const map_pipeline *pipeline,
                            const sl_storey *storey, map_pipeline *out) {
    *out = *pipeline;
    return pipeline_plan(context, storey->path, out);
}

sl_status building_place(sl_context *context, const char *option, const char *text,
                         const sl_building *building, size_t *storey, sl_point *at) {
    const char *colon = strchr(text, ':');
    if (!colon)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s %s: a place of a building is STOREY:X,Y, as %s:3,4", option, text,
                       building->storeys[0].name);
    *storey = sl_building_find(building, text, (size_t)(colon - text));
    if (*storey == SL_NO_STOREY)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: the building has no such storey", option,
                       text);
    return read_point(context, option, colon + 1, at);
}

sl_status building_check_unit(sl_context *context, const char *path, const sl_building *building,
                              size_t storey, const char *unit, const char *first) {
    if (strcmp(unit, first) == 0) return SL_OK;
    return sl_fail_at(context, path, building->storeys[storey].line,
                      "storey %s: its lengths are in %s, those of storey %s in %s",
                      building->storeys[storey].name, *unit ? unit : "no known unit",
                      building->storeys[0].name, *first ? first : "no known unit");
}
