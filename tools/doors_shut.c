#include "doors_shut.h"

#include "names.h"
#include "sightline/support.h"

#include <string.h>

/// Marks the doors of one name.
static bool shut_named(const sl_map *map, const char *name, size_t length, bool *shut) {
    bool found = false;
    for (size_t i = 0; i < map->door_count; i++) {
        if (strlen(map->doors[i].name) != length || memcmp(map->doors[i].name, name, length) != 0)
            continue;
        shut[i] = found = true;
    }
    return found;
}

static sl_status fail_door(sl_context *context, const sl_map *map, const char *name,
                           size_t length) {
    const sl_name_table doors = {"door", map->doors, sizeof *map->doors, map->door_count};
    char names[SL_NAME_LIST];
    sl_name_list(&doors, names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--shut: there is no door '%.*s'; the map's doors: %s%s",
                   (int)(length < 64 ? length : 64), name, names,
                   map->door_count ? "; 'none' leaves all open" : "");
}

static sl_status read_names(sl_context *context, const char *text, const sl_map *map, bool *shut) {
    if (strcmp(text, "none") == 0) return SL_OK;
    while (*text) {
        const size_t length = strcspn(text, ",");
        if (!shut_named(map, text, length, shut)) return fail_door(context, map, text, length);
        text += length;
        if (*text) text++;
    }
    return SL_OK;
}

/// Puts what is left to see in place of what was baked.
static sl_status shut_doors(sl_context *context, sl_baked *baked, const bool *shut) {
    sl_space space;
    sl_visibility visibility;
    SL_TRY(sl_baked_shut(context, baked, shut, &space, &visibility));
    sl_space_destroy(context, &baked->space);
    sl_visibility_destroy(context, &baked->visibility);
    baked->space = space;
    baked->visibility = visibility;
    return SL_OK;
}

sl_status sl_doors_shut(sl_context *context, const char *text, sl_baked *baked) {
    const sl_map *map = &baked->map;
    if (!map->door_count) return text ? read_names(context, text, map, NULL) : SL_OK;
    bool *shut = sl_alloc_array(context, map->door_count, sizeof *shut);
    if (!shut) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->door_count && !text; i++) shut[i] = !map->doors[i].open;
    sl_status status = text ? read_names(context, text, map, shut) : SL_OK;
    if (status == SL_OK) status = shut_doors(context, baked, shut);
    for (size_t i = 0; i < map->door_count && status == SL_OK; i++)
        baked->map.doors[i].open = !shut[i];
    sl_free(context, shut);
    return status;
}
