// Tiled as JSON, by what it says itself, by layers and by starts asked for: whatever is read is
// written as map text and read back the same.
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_import_options options = sl_import_options_default();
    if (size % 4 == 3) options.layers = "walls,Floor:1+3-9";
    if (size % 4 == 2) options.start_names = "player";
    options.doors = size % 2;
    fuzz_read(context, data, size, sl_map_read_tmj, &options,
              options.layers        ? "layer"
              : options.start_names ? "--start-names"
                                    : NULL);
    sl_context_destroy(context);
    return 0;
}
