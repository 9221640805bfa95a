// Our own export (bake/export_json.c): its walls are a map; cells and what they see are made anew.
#include "io/json.h"
#include "sightline/io.h"

static sl_status read_wall(sl_context *context, const sl_json *wall, sl_map *map) {
    size_t count;
    double ends[4];
    SL_TRY(sl_json_array(wall, &count));
    if (count != 4)
        return sl_json_fail(wall, "expected 4 numbers: x0, y0, x1, y1; found %zu", count);
    for (size_t i = 0; i < 4; i++) {
        const sl_json number = sl_json_item(wall, i);
        SL_TRY(sl_json_number(&number, &ends[i]));
    }
    return sl_map_add_wall(context, map, (sl_point){ends[0], ends[1]}, (sl_point){ends[2], ends[3]},
                           0);
}

static sl_status read_walls(sl_context *context, const sl_json *root, sl_map *map) {
    const sl_json walls = sl_json_member(root, "walls");
    size_t count;
    SL_TRY(sl_json_object(root));
    SL_TRY(sl_json_array(&walls, &count));
    for (size_t i = 0; i < count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(context));
        const sl_json wall = sl_json_item(&walls, i);
        SL_TRY(read_wall(context, &wall, map));
    }
    sl_note(context,
            "%s: an export: its %zu walls are taken; left out: cells, portals and what they "
            "see",
            root->file->name, count);
    return SL_OK;
}

sl_status sl_map_read_export(sl_context *context, const char *name, const char *text, size_t size,
                             const sl_import_options *options, sl_map *map) {
    (void)options;
    sl_json_file file;
    SL_TRY(sl_json_open(context, name, text, size, &file));
    sl_map read = {0};
    const sl_json root = sl_json_root(&file);
    const sl_status status = read_walls(context, &root, &read);
    sl_json_close(&file);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
