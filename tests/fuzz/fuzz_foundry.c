// Foundry's walls, with doors and without: whatever is read is written as map text and read back
// the same.
#include "fuzz.h"

#include "sightline/import.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_import_options options = sl_import_options_default();
    options.doors = size % 2;
    sl_map map = {0};
    const sl_status status =
        sl_map_read_foundry(context, "input", (const char *)data, size, &options, &map);
    if (status == SL_OK)
        free(fuzz_round_trip(context, &map));
    else
        fuzz_refused(context, status, &map);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}
