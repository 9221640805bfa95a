/// What given viewpoints see together: their regions as shapes of an overlay (view_shapes.c). The
/// walls are a shape, too: they cover nothing, but no blind spot goes through them.
#include "sightline/coverage.h"

#include "analysis/placement/blind_spots.h"
#include "analysis/placement/view_shapes.h"

/// The share of the inside up to which an area is taken for rounding.
#define NEGLIGIBLE 1e-9

/// What the shapes refer to.
struct sli_coverage_memory {
    sli_view_shapes shapes; ///< the walls, and the viewpoints
    sl_shape *list;         ///< the same
};

typedef struct surveyor {
    sl_context *context;
    sl_query *query;
    const sl_space *space;
    sl_region region;
    size_t count; ///< of viewpoints
    sl_coverage *out;
} surveyor;

static sl_status make_shapes(surveyor *s, const sl_viewpoint *viewpoints) {
    struct sli_coverage_memory *memory = s->out->memory =
        sl_alloc_array(s->context, 1, sizeof *memory);
    if (!memory) return SL_NO_MEMORY;
    memory->list = sl_alloc_array(s->context, s->count + 1, sizeof *memory->list);
    if (!memory->list) return SL_NO_MEMORY;
    SL_TRY(sli_view_shapes_add_walls(s->context, s->space, &memory->shapes));
    for (size_t i = 0; i < s->count; i++) {
        SL_TRY(sl_check_cancelled(s->context));
        sl_report(s->context, "coverage", "viewpoints", i, s->count);
        SL_TRY(
            sli_view_shapes_add(s->context, s->query, &viewpoints[i], &s->region, &memory->shapes));
    }
    for (size_t i = 0; i <= s->count; i++) memory->list[i] = sli_view_shape(&memory->shapes, i);
    return SL_OK;
}

static sl_status lay(surveyor *s) {
    sl_shape inside = {0};
    sl_overlay *overlay = &s->out->overlay;
    SL_TRY(sl_shape_of_inside(s->context, s->space, &inside));
    const sl_status status =
        sl_overlay_make(s->context, &inside, s->out->memory->list, s->count + 1, overlay);
    sl_shape_destroy(s->context, &inside);
    if (status != SL_OK) return status;
    overlay->areas[0] = 0; // of the plan itself: no crossing of outlines has rounded it
    for (uint32_t c = 0; c < s->space->cell_count; c++)
        if (s->space->cells[c].inside) overlay->areas[0] += sl_space_area(s->space, c);
    s->out->negligible = NEGLIGIBLE * overlay->areas[0];
    s->out->count = s->count;
    s->out->regions = s->out->memory->list + 1;
    s->out->seen = overlay->covered + 1;
    s->out->alone = overlay->alone + 1;
    return SL_OK;
}

static sl_status find_blind(surveyor *s) {
    const sl_overlay *overlay = &s->out->overlay;
    bool *blind = sl_alloc_array(s->context, (size_t)overlay->pieces.cell_count + 1, sizeof *blind);
    if (!blind) return SL_NO_MEMORY;
    for (uint32_t c = 0; c < overlay->pieces.cell_count; c++)
        blind[c] = overlay->pieces.cells[c].inside && !overlay->counts[c];
    const sl_status status =
        sli_blind_spots_find(s->context, overlay, blind, s->out->negligible, &s->out->spots,
                             &s->out->blind, &s->out->blind_count);
    sl_free(s->context, blind);
    return status;
}

sl_status sl_coverage_make(sl_context *context, sl_query *query, const sl_viewpoint *viewpoints,
                           size_t count, sl_coverage *out) {
    sl_coverage made = {0};
    surveyor s = {.context = context, .query = query, .count = count, .out = &made};
    SL_TRY(sli_check_viewpoints(context, viewpoints, count));
    SL_TRY(sl_query_space(context, query, &s.space, NULL));
    sl_status status = make_shapes(&s, viewpoints);
    if (status == SL_OK) status = lay(&s);
    if (status == SL_OK) status = find_blind(&s);
    sl_region_destroy(context, &s.region);
    if (status == SL_OK)
        *out = made;
    else
        sl_coverage_destroy(context, &made);
    return status;
}

void sl_coverage_destroy(sl_context *context, sl_coverage *coverage) {
    sl_overlay_destroy(context, &coverage->overlay);
    sl_free(context, coverage->spots);
    sl_free(context, coverage->blind);
    if (coverage->memory) {
        sli_view_shapes_destroy(context, &coverage->memory->shapes);
        sl_free(context, coverage->memory->list);
        sl_free(context, coverage->memory);
    }
    *coverage = (sl_coverage){0};
}

double sl_coverage_class_area(const sl_coverage *coverage, uint32_t class_index) {
    const double *areas = coverage->overlay.areas;
    if (class_index > coverage->count || class_index >= SL_COVERAGE_CLASSES) return 0;
    const bool last = class_index + 1 == SL_COVERAGE_CLASSES || class_index == coverage->count;
    const double area = areas[class_index] - (last ? 0 : areas[class_index + 1]);
    return area > coverage->negligible ? area : 0;
}

bool sl_coverage_is_spare(const sl_coverage *coverage, size_t viewpoint) {
    return coverage->alone[viewpoint] <= coverage->negligible;
}
