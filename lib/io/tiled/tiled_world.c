/// Worlds of Tiled: a list of maps in files beside it, with their places. Each is a map by the name
/// of its file; where it lies in the world is not kept.
#include "io/io_formats.h"
#include "io/parts/document.h"
#include "io/parts/names.h"
#include "io/tiled/tiled.h"

/// The list of maps, one at least.
static sl_status maps_of(const sli_json *root, sli_json *maps, size_t *count) {
    const sli_json patterns = sli_json_member(root, "patterns");
    SL_TRY(sli_json_object(root));
    *maps = sli_json_member(root, "maps");
    *count = 0;
    if (maps->value) SL_TRY(sli_json_array(maps, count));
    if (*count) return SL_OK;
    return sli_json_fail(root, "a world of Tiled that names no map%s",
                         json_array_size(patterns.value)
                             ? ": its patterns are not read; give the file of one of its maps"
                             : "");
}

static sl_status read_file(sl_context *context, const char *name, const char *relative,
                           const sl_import_options *options, sl_map *map) {
    sl_import_options own = *options;
    sl_bytes bytes;
    char *path;
    own.map = NULL;
    SL_TRY(sli_beside_read(context, name, relative, &path, &bytes));
    const sl_status status =
        sli_tiled_looks_like_xml(&bytes)
            ? sli_map_read_tmx(context, path, bytes.data, bytes.size, &own, map)
            : sli_map_read_tmj(context, path, bytes.data, bytes.size, &own, map);
    sl_free(context, bytes.data);
    sl_free(context, path);
    return status;
}

static sl_status read_world(sl_context *context, const sli_json *root,
                            const sl_import_options *options, sl_map *map) {
    sli_json maps;
    size_t count;
    SL_TRY(maps_of(root, &maps, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json item = sli_json_item(&maps, i), file = sli_json_member(&item, "fileName");
        const char *text;
        SL_TRY(sli_json_text(&file, &text));
        if (options->map && strcmp(text, options->map) != 0) continue;
        return read_file(context, root->file->name, text, options, map);
    }
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: the world has no map '%s'", root->file->name,
                   options->map);
}

static sl_status list_world(sl_context *context, const sli_json *root, sl_map_list *list) {
    sli_json maps;
    size_t count;
    SL_TRY(maps_of(root, &maps, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json item = sli_json_item(&maps, i), file = sli_json_member(&item, "fileName");
        const char *text;
        SL_TRY(sli_json_text(&file, &text));
        SL_TRY(sl_map_list_add(context, list, text, strlen(text)));
    }
    return SL_OK;
}

sl_status sli_map_read_world(sl_context *context, const char *name, const char *text, size_t size,
                             const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    const sli_json root = sli_json_root(&file);
    const sl_status status = read_world(context, &root, options, map);
    sli_json_close(&file);
    return status;
}

sl_status sli_map_list_world(sl_context *context, const char *name, const char *text, size_t size,
                             sl_map_list *list) {
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    const sli_json root = sli_json_root(&file);
    const sl_status status = list_world(context, &root, list);
    sli_json_close(&file);
    if (status != SL_OK) sl_map_list_destroy(context, list);
    return status;
}
