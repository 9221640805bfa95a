// GeoJSON as lines and as a map: what is read is written as map text and read back the same.
#include "fuzz.h"
#include "io/io_formats.h"

static sl_status read_lines(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map) {
    (void)options;
    return sl_lines_read_geojson(context, name, text, size, map);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    fuzz_read(context, data, size, read_lines, NULL, NULL);
    sl_import_options options = sl_import_options_default();
    sl_map_list levels = {0};
    options.doors = size % 2;
    options.degrees = size % 3 == 0;
    fuzz_read(context, data, size, sli_map_read_geojson, &options,
              options.degrees ? "--degrees" : NULL);
    const char *text = (const char *)data;
    if (sli_map_list_geojson(context, "input", text, size, &levels) == SL_OK && levels.count) {
        options.map = levels.names[levels.count - 1];
        fuzz_read(context, data, size, sli_map_read_geojson, &options,
                  options.degrees ? "--degrees" : NULL);
    }
    sl_map_list_destroy(context, &levels);
    sl_context_destroy(context);
    return 0;
}
