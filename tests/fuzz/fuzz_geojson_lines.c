// Drawn lines of GeoJSON: what is read is written as map text and read back the same.
#include "fuzz.h"

static sl_status read_lines(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map) {
    (void)options;
    return sl_lines_read_geojson(context, name, text, size, map);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    fuzz_read(context, data, size, read_lines, NULL, NULL);
    sl_context_destroy(context);
    return 0;
}
