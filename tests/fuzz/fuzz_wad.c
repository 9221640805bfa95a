// Doom WADs: every map listed is read or refused by name; whatever is read is written as map text
// and read back the same; GL nodes make a space or are refused.
#include "fuzz.h"
#include "io/io_formats.h"

static void read_one(sl_context *context, const uint8_t *data, size_t size, const char *name,
                     bool doors) {
    const sl_import_options options = {.map = name, .doors = doors};
    fuzz_read(context, data, size, sli_map_read_wad, &options, NULL);
}

/// Cells that are read are taken, with all that a space promises, or refused.
static void read_cells(sl_context *context, const uint8_t *data, size_t size) {
    const sl_import_options options = {.cells = true};
    sl_map map = {0};
    const sl_status status =
        sli_map_read_wad(context, "input", (const char *)data, size, &options, &map);
    if (status == SL_OK)
        fuzz_cells(context, &map);
    else
        fuzz_refused(context, status, &map);
    sl_map_destroy(context, &map);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    const char *text = (const char *)data;
    sl_map_list list = {0};
    if (sli_map_list_wad(context, "input", text, size, &list) == SL_OK)
        for (size_t i = 0; i < list.count && i < 4; i++)
            read_one(context, data, size, list.names[i], size % 2);
    read_one(context, data, size, NULL, size % 2 == 0);
    read_cells(context, data, size);
    sl_map_list_destroy(context, &list);
    sl_context_destroy(context);
    return 0;
}
