// Tiled as XML, by what it says itself and by layers asked for: whatever is read is written as map
// text and read back the same.
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_import_options options = sl_import_options_default();
    if (size % 4 == 3) options.layers = "walls,Floor:1+3-9";
    fuzz_read(context, data, size, sl_map_read_tmx, &options, options.layers ? "layer" : NULL);
    sl_context_destroy(context);
    return 0;
}
