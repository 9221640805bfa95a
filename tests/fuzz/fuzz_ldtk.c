// LDtk: each map that is listed is read or refused; what is read is written as map text and read
// back the same.
#include "fuzz.h"
#include "io/io_formats.h"

static void read_one(sl_context *context, const uint8_t *data, size_t size, const char *name) {
    sl_import_options options = sl_import_options_default();
    options.map = name;
    options.doors = size % 2;
    fuzz_read(context, data, size, sli_map_read_ldtk, &options, NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_map_list list = {0};
    const sl_status status = sli_map_list_ldtk(context, "input", (const char *)data, size, &list);
    if (status != SL_OK) FUZZ_CHECK(status == SL_BAD_INPUT && !list.count && !list.names);
    for (size_t i = 0; i < list.count && i < 4; i++)
        read_one(context, data, size, list.names[list.count - 1 - i]);
    read_one(context, data, size, NULL);
    sl_map_list_destroy(context, &list);
    sl_context_destroy(context);
    return 0;
}
