/// What stands for sight by mirror where a build leaves the work on effects out: it is refused.
#include "effects/effects.h"
#include "eye_to_cell/eye_search.h"
#include "sightline/mirrored.h"

sl_status sl_eye_search_add_mirrors(sl_context *context, sl_eye_search *search, const sl_map *map,
                                    uint32_t depth) {
    (void)search, (void)map, (void)depth;
    return sl_effects_refuse(context);
}

void sl_eye_mirrors_destroy(sl_context *context, struct sl_eye_mirrors *mirrors) {
    (void)context, (void)mirrors;
}

sl_status sl_eye_exact_mirrored(sl_context *context, sl_eye_search *search, const sl_view *view,
                                uint64_t *cells, sl_eye_account *account) {
    (void)search, (void)view, (void)cells, (void)account;
    return sl_effects_refuse(context);
}

sl_status sl_room_mirrors_make(sl_context *context, const sl_outline *outline, const sl_map *map,
                               sl_room_mirrors *out) {
    (void)outline, (void)map, (void)out;
    return sl_effects_refuse(context);
}

void sl_room_mirrors_destroy(sl_context *context, sl_room_mirrors *mirrors) {
    (void)context, (void)mirrors;
}

sl_status sl_mirrored_region_make(sl_context *context, const sl_room_mirrors *mirrors,
                                  const sl_view *view, double range, uint32_t depth,
                                  sl_mirrored_region *out) {
    (void)mirrors, (void)view, (void)range, (void)depth, (void)out;
    return sl_effects_refuse(context);
}

void sl_mirrored_region_destroy(sl_context *context, sl_mirrored_region *region) {
    (void)context, (void)region;
}

double sl_mirrored_area(const sl_mirrored_region *region) {
    (void)region;
    return 0;
}
