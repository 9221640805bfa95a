/// Opens floors for JavaScript: floor.js asks.
#include "bindings/js/src/floor.h"

#include "sightline/import.h"

static sl_context *context(void) {
    return sli_module.context;
}

SLI_EXPORT(void, floor_close, sli_floor *f) {
    if (!f) return;
    sli_answers_destroy(f->answers);
    sl_query_destroy(context(), f->query);
    sl_baked_destroy(context(), &f->baked);
    sl_free(context(), f);
}

static sl_status make_space(sli_floor *f, const char *name, const char *text, size_t size,
                            double entrance) {
    const sl_import_options import = {.entrance = entrance};
    sl_map map = {0};
    sl_status status = sl_map_parse(context(), name, text, size, &import, &map);
    if (status == SL_OK) status = sl_bake_cells(context(), &map, NULL, &f->baked);
    sl_map_destroy(context(), &map);
    return status;
}

static sl_status open_map(sli_floor *f, const char *name, const char *bytes, size_t size, int baked,
                          double entrance) {
    SL_TRY(baked ? sl_baked_parse(context(), name, bytes, size, &f->baked)
                 : make_space(f, name, bytes, size, entrance));
    return sl_query_over(context(), &f->baked.space, &f->baked.map, NULL, &f->query);
}

/// Reads a map, or with `baked` a baked file. `entrance`: the width of entrances; 0: as the map
/// says.
SLI_EXPORT(sli_floor *, floor_open, const char *name, const char *bytes, size_t size, int baked,
           double entrance) {
    sli_floor *f = sl_alloc_array(context(), 1, sizeof *f);
    if (sli_done(f ? open_map(f, name, bytes, size, baked, entrance) : SL_NO_MEMORY)) return f;
    floor_close(f);
    return NULL;
}

SLI_EXPORT(int, floor_set_door, sli_floor *f, const char *name, int open) {
    sli_answers_destroy(f->answers);
    f->answers = NULL;
    sli_done(sl_query_set_door(context(), f->query, name, open));
    return (int)sli_module.status;
}
