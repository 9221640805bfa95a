#include "seen_parts.h"

#include "sightline/support.h"

/// Of the map's width and height together: no one sees it in a picture.
#define TOLERANCE 1e-4

static sl_status add(sl_context *context, const sl_space *space, const sl_region *region,
                     sl_point eye, uint32_t depth, sl_seen_parts *parts) {
    const sl_box *b = &space->bounds;
    const double tolerance = (b->max.x - b->min.x + b->max.y - b->min.y) * TOLERANCE;
    const size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    SL_TRY(SL_ARRAY_ROOM(context, parts, 1));
    sl_point *points = sl_alloc_array(context, count, sizeof *points);
    if (!points) return SL_NO_MEMORY;
    sl_region_flatten(region, tolerance, points, count);
    parts->items[parts->count++] =
        (sl_drawn_region){.eye = eye, .points = points, .count = count, .depth = depth};
    return SL_OK;
}

sl_status sl_seen_parts_add(sl_context *context, const sl_space *space,
                            const sl_mirrored_region *region, bool direct, sl_seen_parts *parts) {
    const sl_point eye = region->direct.view.eye;
    if (direct) SL_TRY(add(context, space, &region->direct, eye, 0, parts));
    for (size_t i = 0; i < region->part_count; i++)
        SL_TRY(add(context, space, &region->parts[i].region, eye, region->parts[i].depth, parts));
    return SL_OK;
}

sl_status sl_seen_parts_add_region(sl_context *context, const sl_space *space,
                                   const sl_region *region, sl_seen_parts *parts) {
    return add(context, space, region, region->view.eye, 0, parts);
}

void sl_seen_parts_destroy(sl_context *context, sl_seen_parts *parts) {
    for (size_t i = 0; i < parts->count; i++)
        sl_free(context, (void *)(uintptr_t)parts->items[i].points);
    sl_free(context, parts->items);
    *parts = (sl_seen_parts){0};
}
