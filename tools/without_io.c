// A build without sightline_io: its formats and its command are known by name and refused.
#include "built.h"
#include "commands.h"
#include "sightline/io.h"
#include "sightline/support.h"

#define WHAT "not in this build (SIGHTLINE_IO is off)"

static const char refusal[] =
    "this build reads and writes no foreign formats (SIGHTLINE_IO is off)";

static sl_status refuse_map(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map) {
    (void)text, (void)size, (void)options, (void)map;
    return sl_fail(context, SL_UNSUPPORTED, "%s: %s", name, refusal);
}

static sl_status refuse_list(sl_context *context, const char *name, const char *text, size_t size,
                             sl_map_list *list) {
    (void)list;
    return refuse_map(context, name, text, size, NULL, NULL);
}

static sl_status refuse_write(sl_context *context, const sl_map *map, FILE *stream) {
    (void)map, (void)stream;
    return sl_fail(context, SL_UNSUPPORTED, "%s", refusal);
}

static sl_status refuse_export(sl_context *context, const sl_baked *baked,
                               const sl_export_options *options, const char *path) {
    (void)baked, (void)options, (void)path;
    return sl_fail(context, SL_UNSUPPORTED, "%s", refusal);
}

static const sl_map_format foreign = {
    .name = "foreign",
    .endings = SL_IO_ENDINGS,
    .what = WHAT,
    .read = refuse_map,
    .takes = UINT32_MAX,
    .list = refuse_list,
    .write = refuse_write,
    .keeps = SL_KEEPS_ALL,
};

static const sl_export_format exports[] = {
    {.name = "png", .what = WHAT, .write = refuse_export},
    {.name = "reject", .what = WHAT, .takes = SL_EXPORT_TAKES_WAD, .write = refuse_export},
};

sl_status built_use_formats(sl_context *context) {
    SL_TRY(sl_map_formats_add(context, &foreign, 1));
    return sl_export_formats_add(context, exports, sizeof exports / sizeof *exports);
}

sl_status cmd_reject(command_console *console, int argc, char **argv) {
    (void)argc, (void)argv;
    return sl_fail(console->context, SL_UNSUPPORTED, "%s", refusal);
}

sl_status sl_lines_read_geojson(sl_context *context, const char *name, const char *text,
                                size_t size, sl_map *map) {
    return refuse_map(context, name, text, size, NULL, map);
}

sl_status sl_drawing_layers_dxf(sl_context *context, const char *name, const char *text,
                                size_t size, sl_drawing_layers *out) {
    (void)out;
    return refuse_map(context, name, text, size, NULL, NULL);
}

void sl_drawing_layers_destroy(sl_context *context, sl_drawing_layers *layers) {
    (void)context, (void)layers;
}

sl_status sl_image_read(sl_context *context, const char *name, const char *bytes, size_t size,
                        sl_image *out) {
    (void)bytes, (void)size, (void)out;
    return sl_fail(context, SL_UNSUPPORTED, "%s: %s", name, refusal);
}

void sl_image_destroy(sl_context *context, sl_image *image) {
    (void)context, (void)image;
}
