// UniGrafix: whatever is cut is written as map text and read back the same, notes included.
#include "fuzz.h"
#include "io/io_formats.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    // The seeds lie about these heights.
    static const double slices[] = {0, 0.5, 1, 4};
    sl_context *context = fuzz_context();
    const sl_import_options options = {.has_slice = size % 5 < 4, .slice = slices[size % 4]};
    fuzz_read(context, data, size, sli_map_read_unigrafix, &options, "--slice");
    sl_context_destroy(context);
    return 0;
}
