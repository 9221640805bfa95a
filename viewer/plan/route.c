/// The way is kept with the finder that found it. Both are of one version of what is present: where
/// that changes, the query is copied anew and the way is found again.
#include "plan/route.h"

#include "plan/building_way.h"

#include "document/measure.h"
#include "sightline/draw.h"
#include "ui/tones.h"

static void drop_finder(sl_context *context, route_layer *layer) {
    sl_route_finder_destroy(context, layer->finder);
    sl_query_destroy(context, layer->query);
    layer->finder = NULL;
    layer->query = NULL;
}

void route_layer_destroy(sl_context *context, route_layer *layer) {
    if (!layer) return;
    drop_finder(context, layer);
    sl_route_destroy(context, &layer->route);
    sl_free(context, layer);
}

static sl_status find_way(view_state *view, route_layer *layer) {
    if (!layer->finder) {
        layer->version = view->present.version;
        layer->walker = view->walker;
        SL_TRY(sl_query_copy(view->context, view->present.query, &layer->query));
        SL_TRY(sl_route_finder_create(view->context, layer->query, &layer->finder));
        SL_TRY(sl_route_finder_set_radius(view->context, layer->finder, view->walker));
    }
    return sl_route_find(view->context, layer->finder, layer->from, layer->to, &layer->route);
}

/// A failure takes the way back, unless a thinner walker may find one.
static void find_again(view_state *view, route_layer *layer) {
    const sl_status status = find_way(view, layer);
    layer->tight = status == SL_BAD_ARGUMENT && view->walker > 0;
    if (status != SL_OK) sl_route_destroy(view->context, &layer->route);
    if (status != SL_OK && !layer->tight) layer->clicks = 0;
    view_check(view, status);
}

void route_click(view_state *view, sl_point at) {
    if (*view->building) {
        building_way_click(view, at);
        return;
    }
    if (!view->present.query) return;
    if (!view->route) view->route = sl_alloc_array(view->context, 1, sizeof *view->route);
    route_layer *layer = view->route;
    if (!layer) {
        view_check(view, SL_NO_MEMORY);
        return;
    }
    layer->clicks = layer->clicks % 2 + 1;
    if (layer->clicks == 1) {
        layer->from = at;
        ui_say(view->ui, false, "the way begins here: click where it ends");
        return;
    }
    layer->to = at;
    find_again(view, layer);
    if (layer->clicks < 2 || layer->tight) return;
    char length[MEASURE_TEXT];
    measure_say(layer->route.length, view->document->map.unit, "", length);
    ui_say(view->ui, false, layer->route.found ? "the way is %s long" : "no way leads there",
           length);
}

void route_update(view_state *view) {
    route_layer *layer = view->route;
    const bool slides = view->drag.kind == DRAG_HIT; // the radius follows when the slider is let go
    if (!layer ||
        (layer->version == view->present.version && (layer->walker == view->walker || slides)))
        return;
    drop_finder(view->context, layer);
    if (layer->clicks == 2 && view->present.query) find_again(view, layer);
}

bool route_clear(view_state *view) {
    if (building_way_clear(view)) return true;
    const bool any = view->route && view->route->clicks;
    if (any) view->route->clicks = 0;
    return any;
}

void route_draw(const view_state *view, const sl_frame *frame) {
    const route_layer *layer = view->route;
    const sl_palette *palette = &view->ui->palette;
    building_way_draw(view, frame);
    if (!layer || !layer->clicks) return;
    cairo_t *cairo = view->ui->cairo;
    cairo_new_path(cairo);
    for (size_t i = 1; layer->clicks == 2 && i < layer->route.count; i++)
        sl_path_segment(cairo, frame, layer->route.points[i - 1], layer->route.points[i]);
    tone_cased(cairo, palette, palette->start, 2.6 * frame->unit, 0);
    view_mark(view, frame, layer->from);
    if (layer->clicks < 2) return;
    view_mark(view, frame, layer->to);
    if (!layer->route.found && !layer->tight)
        sl_draw_ring(cairo, frame, layer->route.nearest, 9 * frame->unit, palette->start,
                     2 * frame->unit);
}
