/// What of a thing is seen from a path, and from where: the same question asked both ways.
///
/// What of a line is seen from the path is what the path's region cuts from it. The parts of the
/// path that see the line are what the line's region cuts from the path; those that see all of it,
/// what the region of complete visibility cuts. So one cutter does all (path_cut.h).
#include "sightline/exposure.h"

#include "analysis/placement/path_cut.h"

/// Sight of the lines of a thing, or of the path.
typedef struct gaze {
    sl_set_sight **sights;
    sl_set_region *regions;
    size_t count;
    sl_set_seen seen;
} gaze;

static void drop_gaze(sl_context *context, gaze *g) {
    for (size_t i = 0; i < g->count; i++) {
        if (g->regions) sl_set_region_destroy(context, &g->regions[i]);
        if (g->sights) sl_set_sight_destroy(context, g->sights[i]);
    }
    sl_free(context, g->regions);
    sl_free(context, g->sights);
    *g = (gaze){0};
}

static sl_status make_gaze(sl_context *context, sl_query *query, const sl_shape *lines,
                           sl_set_kind kind, gaze *out) {
    *out = (gaze){.count = lines->count};
    out->sights = sl_alloc_array(context, lines->count, sizeof *out->sights);
    out->regions = sl_alloc_array(context, lines->count, sizeof *out->regions);
    if (!out->sights || !out->regions) return SL_NO_MEMORY;
    for (size_t i = 0, from = 0; i < lines->count; from = lines->ends[i++])
        SL_TRY(sl_set_sight_create(context, query, lines->points + from, lines->ends[i] - from,
                                   kind, &out->sights[i]));
    return SL_OK;
}

static sl_status look(sl_context *context, gaze *g, sl_set_seen seen) {
    g->seen = seen;
    for (size_t i = 0; i < g->count; i++) {
        sl_set_region_destroy(context, &g->regions[i]);
        SL_TRY(sl_set_sight_region(context, g->sights[i], seen, &g->regions[i]));
    }
    return SL_OK;
}

static sl_status cut(sli_path_cut *c, sl_point p, sl_point q) {
    const gaze *g = c->of;
    for (size_t i = 0; i < g->count; i++) SL_TRY(sli_cut_by_shape(c, p, q, &g->regions[i].shape));
    return SL_OK;
}

/// Whether a place sees some point of some line; or all points of all of them.
static sl_status sees(sli_path_cut *c, sl_point at, bool *out) {
    const gaze *g = c->of;
    const bool some = g->seen == SL_SEEN_FROM_SOME;
    *out = !some;
    for (size_t i = 0; i < g->count && *out == !some; i++)
        SL_TRY(sl_set_sight_sees(c->context, g->sights[i], g->seen, at, out));
    return SL_OK;
}

typedef struct exposer {
    sl_context *context;
    sl_query *query;
    const sl_space *space;
    const sl_point *path;
    size_t path_count;
    gaze from_path;
    sl_shape inside;
} exposer;

static sl_status parts_of(const exposer *e, gaze *g, const sl_point *path, size_t count,
                          sl_path_parts *out) {
    sli_path_cut c = {.context = e->context, .space = e->space, .cut = cut, .holds = sees, .of = g};
    return sli_path_parts(&c, path, count, out);
}

/// What of lines the path sees.
static sl_status measure_lines(exposer *e, const sl_shape *lines, sl_exposure *out) {
    for (size_t i = 0, from = 0; i < lines->count; from = lines->ends[i++]) {
        sl_path_parts parts;
        SL_TRY(parts_of(e, &e->from_path, lines->points + from, lines->ends[i] - from, &parts));
        out->size += parts.length;
        out->seen += parts.total;
        sl_path_parts_destroy(e->context, &parts);
    }
    return SL_OK;
}

/// What of an area the path sees, of what is inside.
static sl_status measure_area(exposer *e, const sl_shape *area, sl_exposure *out) {
    const sl_shape both[2] = {*area, e->from_path.regions[0].shape};
    sl_overlay overlay;
    if (!e->inside.count) SL_TRY(sl_shape_of_inside(e->context, e->space, &e->inside));
    SL_TRY(sl_overlay_make(e->context, &e->inside, both, 2, &overlay));
    out->size = overlay.covered[0];
    out->seen = overlay.areas[2];
    sl_overlay_destroy(e->context, &overlay);
    return SL_OK;
}

static sl_status expose(exposer *e, const sl_exposed *thing, sl_exposure *out) {
    if (thing->is_area && thing->parts.count != 1)
        return sl_fail(e->context, SL_BAD_ARGUMENT, "it is %zu areas, not one", thing->parts.count);
    gaze g;
    sl_status status = make_gaze(e->context, e->query, &thing->parts,
                                 thing->is_area ? SL_SET_AREA : SL_SET_LINE, &g);
    if (status == SL_OK)
        status = thing->is_area ? measure_area(e, &thing->parts, out)
                                : measure_lines(e, &thing->parts, out);
    if (status == SL_OK) status = look(e->context, &g, SL_SEEN_FROM_SOME);
    if (status == SL_OK) status = parts_of(e, &g, e->path, e->path_count, &out->some);
    if (status == SL_OK) status = look(e->context, &g, SL_SEEN_FROM_ALL);
    if (status == SL_OK) status = parts_of(e, &g, e->path, e->path_count, &out->whole);
    drop_gaze(e->context, &g);
    return status;
}

static sl_status make(exposer *e, const sl_exposed *things, size_t count, sl_exposure *out) {
    const sl_shape path = {e->path, &e->path_count, 1};
    if (sl_query_range(e->query) > 0)
        return sl_fail(e->context, SL_UNSUPPORTED, "exposure does not support a view range");
    SL_TRY(sl_query_space(e->context, e->query, &e->space, NULL));
    SL_TRY(make_gaze(e->context, e->query, &path, SL_SET_LINE, &e->from_path));
    SL_TRY(look(e->context, &e->from_path, SL_SEEN_FROM_SOME));
    for (size_t i = 0; i < count; i++) {
        const sl_status status = expose(e, &things[i], &out[i]);
        if (status == SL_OK) continue;
        char message[512];
        snprintf(message, sizeof message, "%s", sl_context_message(e->context));
        return status == SL_NO_MEMORY || status == SL_CANCELLED
                   ? status
                   : sl_fail(e->context, status, "thing %zu: %s", i + 1, message);
    }
    return SL_OK;
}

sl_status sl_exposure_make(sl_context *context, sl_query *query, const sl_point *path,
                           size_t path_count, const sl_exposed *things, size_t count,
                           sl_exposure *out) {
    exposer e = {.context = context, .query = query, .path = path, .path_count = path_count};
    for (size_t i = 0; i < count; i++) out[i] = (sl_exposure){0};
    const sl_status status = make(&e, things, count, out);
    for (size_t i = 0; status != SL_OK && i < count; i++) sl_exposure_destroy(context, &out[i]);
    drop_gaze(context, &e.from_path);
    sl_shape_destroy(context, &e.inside);
    return status;
}

void sl_exposure_destroy(sl_context *context, sl_exposure *exposure) {
    sl_path_parts_destroy(context, &exposure->some);
    sl_path_parts_destroy(context, &exposure->whole);
    *exposure = (sl_exposure){0};
}
