// DXF: whatever is drawn is written as map text and read back the same. Rows and columns of blocks
// stay below a limit, so that a few bytes do not take seconds.
#include "fuzz.h"
#include "io/io_formats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    const sl_limits limits = {.walls = 1 << 14, .entities = 1 << 14};
    sl_context_set_limits(context, &limits);
    sl_import_options options = sl_import_options_default();
    fuzz_read(context, data, size, sli_map_read_dxf, &options, NULL);
    options.doors = true; // swings
    fuzz_read(context, data, size, sli_map_read_dxf, &options, NULL);
    sl_context_destroy(context);
    return 0;
}
