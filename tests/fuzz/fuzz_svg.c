// SVG: whatever is drawn is written as map text and read back the same.
#include "fuzz.h"
#include "io/io_formats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_import_options options = sl_import_options_default();
    fuzz_read(context, data, size, sli_map_read_svg, &options, NULL);
    options.doors = true; // swings
    fuzz_read(context, data, size, sli_map_read_svg, &options, NULL);
    sl_context_destroy(context);
    return 0;
}
