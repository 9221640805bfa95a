/// All storeys are read in the background, each as it was read when it was open last. Doors are as
/// the files have them.
#include "plan/building_way.h"

#include "document/drawings.h"
#include "document/measure.h"
#include "sightline/draw.h"
#include "ui/tones.h"

#include <stdio.h>
#include <string.h>

// --- the work

typedef struct storey_work {
    sl_map map;
    sl_baked baked;
    sl_query *query;
} storey_work;

static sl_status open_storey(sl_context *context, struct building_way *way, size_t number,
                             storey_work *storey, sl_route_finder **finder) {
    sl_bake_options options = sl_bake_options_default();
    sl_bake_account account = {0};
    const document_source *source = &way->sources[number];
    SL_TRY(document_source_read(context, source, &storey->map));
    if (number && strcmp(storey->map.unit, way->unit) != 0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: its lengths are in '%s', those of %s in '%s': open it and say its unit "
                       "(Ctrl+I)",
                       source->path, storey->map.unit, way->sources[0].path, way->unit);
    snprintf(way->unit, sizeof way->unit, "%s", storey->map.unit);
    if (source->has_weld) options.clean.weld = source->weld;
    SL_TRY(sl_bake_space(context, &storey->map, &options, &storey->baked, &account));
    SL_TRY(sl_query_over(context, &storey->baked.space, &storey->baked.map, NULL, &storey->query));
    SL_TRY(sl_route_finder_create(context, storey->query, finder));
    return sl_route_finder_set_radius(context, *finder, way->walker);
}

static sl_status find_way(sl_context *context, void *data) {
    struct building_way *way = data;
    const size_t count = way->building.storey_count;
    storey_work *storeys = sl_alloc_array(context, count, sizeof *storeys);
    sl_route_finder **finders = sl_alloc_array(context, count, sizeof(sl_route_finder *));
    sl_status status = storeys && finders ? SL_OK : SL_NO_MEMORY;
    for (size_t s = 0; s < count && status == SL_OK; s++)
        status = open_storey(context, way, s, &storeys[s], &finders[s]);
    if (status == SL_OK)
        status = sl_building_route_find(context, &way->building, finders, way->ends[0],
                                        way->ends[1], &way->route);
    for (size_t s = 0; s < count && storeys && finders; s++) {
        sl_route_finder_destroy(context, finders[s]);
        sl_query_destroy(context, storeys[s].query);
        sl_baked_destroy(context, &storeys[s].baked);
        sl_map_destroy(context, &storeys[s].map);
    }
    sl_free(context, storeys);
    sl_free(context, finders);
    return status;
}

// --- the state

static void drop_way(sl_context *context, struct building_way *way) {
    task_drop(context, way->task);
    way->task = NULL;
    way->made = false;
    sl_building_route_destroy(context, &way->route);
}

bool building_way_clear(view_state *view) {
    struct building_way *way = view->way;
    if (!way) return false;
    drop_way(view->context, way);
    for (size_t s = 0; way->sources && s < way->building.storey_count; s++)
        document_source_destroy(view->context, &way->sources[s]);
    sl_free(view->context, way->sources);
    sl_building_destroy(view->context, &way->building);
    sl_free(view->context, way->path);
    sl_free(view->context, way);
    view->way = NULL;
    return true;
}

static sl_status make_sources(view_state *view, struct building_way *way) {
    sl_status status = SL_OK;
    way->sources = sl_alloc_array(view->context, way->building.storey_count, sizeof *way->sources);
    if (!way->sources) return SL_NO_MEMORY;
    for (size_t s = 0; s < way->building.storey_count && status == SL_OK; s++) {
        const document_source *open = &view->document->source;
        document_source source = {.path = way->building.storeys[s].path,
                                  .options = sl_import_options_default()};
        const bool is_open = strcmp(open->path, source.path) == 0;
        status = document_source_copy(view->context, is_open ? open : &source, &way->sources[s]);
        if (status == SL_OK && !is_open && drawing_is(source.path))
            drawing_recall(view->context, &way->sources[s], &status);
    }
    return status;
}

static sl_status begin(view_state *view) {
    struct building_way *way = view->way =
        sl_alloc_array(view->context, 1, sizeof(struct building_way));
    if (!way) return SL_NO_MEMORY;
    way->path = sl_copy_text(view->context, *view->building, strlen(*view->building));
    if (!way->path) return SL_NO_MEMORY;
    return sl_building_read(view->context, *view->building, &way->building);
}

static sl_status start(view_state *view, struct building_way *way) {
    drop_way(view->context, way);
    way->walker = view->walker;
    if (!way->sources) SL_TRY(make_sources(view, way));
    return task_start(view->context, find_way, way, "read", NULL, &way->task);
}

size_t building_way_storey(const view_state *view) {
    const struct building_way *way = view->way;
    const char *open = view->document->source.path;
    for (size_t s = 0; way && open && s < way->building.storey_count; s++)
        if (strcmp(open, way->building.storeys[s].path) == 0) return s;
    return SL_NO_STOREY;
}

void building_way_click(view_state *view, sl_point at) {
    sl_status status = SL_OK;
    if (view->way && view->way->clicks != 1) building_way_clear(view);
    if (!view->way) status = begin(view);
    struct building_way *way = view->way;
    const size_t storey = building_way_storey(view);
    if (status == SL_OK && storey == SL_NO_STOREY)
        status = sl_fail(view->context, SL_BAD_INPUT, "%s: this plan is no storey of it any more",
                         *view->building);
    if (status == SL_OK) way->ends[way->clicks++] = (sl_building_place){storey, at};
    if (status == SL_OK && way->clicks == 1)
        ui_say(view->ui, false,
               "the way begins here: click where it ends; Ctrl+Shift+B shows another storey");
    if (status == SL_OK && way->clicks == 2) status = start(view, way);
    if (status == SL_OK) return;
    view_check(view, status);
    building_way_clear(view);
}

void building_way_update(view_state *view, bool wait) {
    struct building_way *way = view->way;
    const bool slides = view->drag.kind == DRAG_HIT; // as for ways on one storey
    if (way && (!*view->building || strcmp(*view->building, way->path) != 0)) {
        building_way_clear(view);
        return;
    }
    if (!way || way->clicks < 2) return;
    if (way->walker != view->walker && !slides) view_check(view, start(view, way));
    if (!way->task || !(wait || task_done(way->task))) return;
    const sl_status status = task_end(view->context, way->task);
    way->task = NULL;
    way->made = status == SL_OK;
    view_check(view, status);
    char length[MEASURE_TEXT];
    measure_say(way->route.length, view->document->map.unit, "", length);
    if (way->made)
        ui_say(view->ui, false, way->route.found ? "the way is %s long" : "no way leads there",
               length);
}

job_progress building_way_progress(const view_state *view) {
    return view->way && view->way->task ? task_progress(view->way->task) : (job_progress){0};
}

const struct building_way *building_way_shown(const view_state *view) {
    return *view->building ? view->way : NULL;
}

// --- the picture

/// A place of the way on the open storey, with the name of the link that leaves it.
static void mark_link(const view_state *view, const sl_frame *frame, sl_point at,
                      const sl_storey_link *link, size_t to) {
    char text[160];
    ui_state *ui = view->ui;
    const sl_point page = sl_frame_point(frame, at);
    snprintf(text, sizeof text, "%.60s: %.60s", link->name, view->way->building.storeys[to].name);
    const double t = ui->text, wide = ui_text_width(ui, 0.95, true, text);
    view_mark(view, frame, at);
    ui_fill_round(
        ui,
        (sl_box){{page.x + 0.6 * t, page.y - 1.9 * t}, {page.x + 1.2 * t + wide, page.y - 0.5 * t}},
        0.25 * t, ui->palette.page);
    ui_text(ui, page.x + 0.9 * t, page.y - 0.85 * t, 0.95, true, ui->palette.ink, text);
}

void building_way_draw(const view_state *view, const sl_frame *frame) {
    const struct building_way *way = building_way_shown(view);
    const size_t storey = building_way_storey(view);
    if (!way || storey == SL_NO_STOREY) return;
    const sl_building_place *p = way->route.points;
    cairo_new_path(view->ui->cairo);
    for (size_t i = 1; way->made && i < way->route.count; i++)
        if (p[i].storey == storey && p[i - 1].storey == storey)
            sl_path_segment(view->ui->cairo, frame, p[i - 1].at, p[i].at);
    tone_cased(view->ui->cairo, &view->ui->palette, view->ui->palette.start, 2.6 * frame->unit, 0);
    for (int i = 0; i < way->clicks; i++)
        if (way->ends[i].storey == storey) view_mark(view, frame, way->ends[i].at);
    for (size_t i = 1, link = 0; way->made && i < way->route.count && link < way->route.link_count;
         i++) {
        const sl_storey_link *l = &way->building.links[way->route.links[link]];
        const bool along = p[i].storey != p[i - 1].storey;
        if (!along) continue;
        if (p[i - 1].storey == storey) mark_link(view, frame, p[i - 1].at, l, p[i].storey);
        if (p[i].storey == storey) mark_link(view, frame, p[i].at, l, p[i - 1].storey);
        link++;
    }
}
