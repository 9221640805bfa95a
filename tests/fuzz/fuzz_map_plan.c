// The ASCII plan: whatever is read can be written as text and as a plan, and is the same map again.
#include "fuzz.h"
#include "map/scan.h"

static void plan_round_trip(sl_context *context, const sl_map *map) {
    sl_status status;
    char *plan = map_plan_text(context, map, &status);
    if (status == SL_UNSUPPORTED) {
        // Only for its size.
        FUZZ_CHECK(strstr(sl_context_message(context), "4096"));
        return;
    }
    FUZZ_CHECK(status == SL_OK);
    sl_map back = {0};
    FUZZ_CHECK(sli_map_read_plan(context, "back", plan, strlen(plan), &back) == SL_OK);
    // A map far from 0 may have been moved there.
    const sl_box was = sl_map_bounds(map), is = sl_map_bounds(&back);
    if (was.max.x < 4096 && was.max.y < 4096)
        FUZZ_CHECK(map_same(map, &back));
    else
        FUZZ_CHECK(was.max.x - was.min.x == is.max.x - is.min.x);
    sl_map_destroy(context, &back);
    free(plan);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    sl_context *context = fuzz_context();
    sl_map map = {0};
    const sl_status status = sli_map_read_plan(context, "input", (const char *)data, size, &map);
    if (status == SL_OK) {
        free(fuzz_round_trip(context, &map));
        plan_round_trip(context, &map);
        FUZZ_CHECK(sl_map_clean(context, &map, NULL, NULL) == SL_OK);
        fuzz_ground(context, &map);
    } else {
        fuzz_refused(context, status, &map);
    }
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return 0;
}
