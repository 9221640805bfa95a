// The BSP: any map text that can be read is cut into a sound space; where walls are a few steps of
// doubles apart, one may be left out of a cell (space.h).
#include "fuzz.h"

#include "sightline/space.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_map map = {0};
    sl_space space = {0};
    const sl_bsp_options options = sl_bsp_options_default();
    sl_status status = sl_map_read_text(context, "input", (const char *)data, size, &map);
    if (status == SL_OK && map.wall_count) {
        FUZZ_CHECK(sl_subdivide_bsp(context, &map, &options, &space) == SL_OK);
        FUZZ_CHECK(sl_space_check(context, &space) == SL_OK ||
                   strstr(sl_context_message(context), "a wall inside"));
    }
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}
