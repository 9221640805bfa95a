/// Each place is located; ways are followed from place to place.
#include "studies/places.h"

#include "inputs/inputs.h"
#include "sightline/support.h"

void places_note_outside(sl_context *context, const char *what, const sl_space *space,
                         const eye_place *eyes, size_t count) {
    size_t outside = 0;
    sl_point first = {0, 0};
    char near[INPUT_NEAREST_TEXT];
    for (size_t i = 0; i < count; i++) {
        if (sl_space_is_inside(space, eyes[i].at)) continue;
        if (!outside++) first = eyes[i].at;
    }
    if (!outside || !*input_say_nearest(space, first, near)) return;
    sl_note(context, "%s: %zu of %zu points %s not inside, the first at %.12g,%.12g%s", what,
            outside, count, outside == 1 ? "is" : "are", first.x, first.y, near);
}

static sl_status check_path(sl_context *context, const char *what, sl_query *query,
                            const sl_point *points, size_t count) {
    for (size_t i = 0; i + 1 < count; i++) {
        const sl_point a = points[i], b = points[i + 1];
        bool free = false;
        SL_TRY(sl_query_sees(context, query, a, b, &free));
        if (free) continue;
        sl_note(context, "%s: it goes through a wall between %.12g,%.12g and %.12g,%.12g", what,
                a.x, a.y, b.x, b.y);
        return SL_OK;
    }
    return SL_OK;
}

sl_status places_note_path(sl_context *context, const char *what, const sl_baked *baked,
                           const sl_point *points, size_t count) {
    const sl_map none = {0};
    sl_baked steps = {0};
    sl_query *query = NULL;
    SL_TRY(sl_bake_steps(context, baked, NULL, &steps));
    sl_space walls = steps.space.cell_count ? steps.space : baked->space;
    walls.seam_count = walls.seam_portal_count = 0;
    sl_status status = sl_query_over(context, &walls, &none, NULL, &query);
    if (status == SL_OK) status = check_path(context, what, query, points, count);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &steps);
    return status;
}
