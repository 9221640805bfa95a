// The map text: whatever is read is written and read back the same; cleaning it again may only join
// walls in line that welding has left without a reason to be apart, and then changes nothing more;
// its own cells make a space or are refused; kd-tree and mesh agree on its solid ground.
#include "fuzz.h"
#include "map/scan.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_map map = {0};
    const sl_status status = sli_map_read_text(context, "input", (const char *)data, size, &map);
    if (status == SL_OK) {
        free(fuzz_round_trip(context, &map));
        if (map.cell_count) fuzz_cells(context, &map);
        FUZZ_CHECK(sl_map_clean(context, &map, NULL, NULL) == SL_OK);
        const size_t walls = map.wall_count;
        FUZZ_CHECK(sl_map_clean(context, &map, NULL, NULL) == SL_OK);
        FUZZ_CHECK(map.wall_count <= walls);
        fuzz_ground(context, &map);
        char *clean = map_text(&map);
        FUZZ_CHECK(sl_map_clean(context, &map, NULL, NULL) == SL_OK);
        char *again = map_text(&map);
        FUZZ_CHECK(same_text(clean, again));
        free(clean);
        free(again);
        // A plan is made or refused; made, it stands for a map again.
        sl_status written;
        char *plan = map_plan_text(context, &map, &written);
        FUZZ_CHECK(written == SL_OK || written == SL_UNSUPPORTED);
        sl_map back = {0};
        if (plan)
            FUZZ_CHECK(sli_map_read_plan(context, "plan", plan, strlen(plan), &back) == SL_OK);
        sl_map_destroy(context, &back);
        free(plan);
    } else {
        fuzz_refused(context, status, &map);
    }
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}
