// UniGrafix: whatever is cut is written as map text and read back the same, notes included.
#include "fuzz.h"

#include "sightline/import.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    // The seeds lie about these heights.
    static const double slices[] = {0, 0.5, 1, 4};
    sl_context *context = fuzz_context();
    const sl_import_options options = {.has_slice = size % 5 < 4, .slice = slices[size % 4]};
    sl_map map = {0};
    const sl_status status =
        sl_map_read_unigrafix(context, "input", (const char *)data, size, &options, &map);
    if (status == SL_OK) {
        free(fuzz_round_trip(context, &map));
    } else if (status == SL_BAD_ARGUMENT) {
        FUZZ_CHECK(strstr(sl_context_message(context), "--slice"));
        FUZZ_CHECK(map_is_empty(&map));
    } else {
        fuzz_refused(context, status, &map);
    }
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}
