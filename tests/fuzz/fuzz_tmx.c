// Tiled as XML, by what it says itself and by layers asked for: whatever is read is written as map
// text and read back the same.
#include "fuzz.h"

#include "sightline/import.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_import_options options = sl_import_options_default();
    if (size % 4 == 3) options.layers = "walls,Floor:1+3-9";
    sl_map map = {0};
    const sl_status status =
        sl_map_read_tmx(context, "input", (const char *)data, size, &options, &map);
    if (status == SL_OK) {
        free(fuzz_round_trip(context, &map));
    } else if (status == SL_BAD_ARGUMENT) {
        FUZZ_CHECK(options.layers && strstr(sl_context_message(context), "layer"));
        FUZZ_CHECK(map_is_empty(&map));
    } else {
        fuzz_refused(context, status, &map);
    }
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}
