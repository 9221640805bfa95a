/// Three jobs, one after the other: the other plan is read; walls of both are compared, again after
/// each change; its graph is measured once the heat map shows a measure.
#include "plan/compare.h"

#include "document/files.h"
#include "plan/heat.h"
#include "plan/layers.h"
#include "sightline/draw.h"
#include "ui/tones.h"

#include <string.h>

bool compare_changes(const view_state *view) {
    return view->mode == MODE_PLAN && view->tool == TOOL_COMPARE && view->compared &&
           view->compared->read;
}

const plan_compare *compare_shown(const view_state *view) {
    return compare_changes(view) ? view->compared : NULL;
}

static void drop_walls(sl_context *context, plan_compare *c) {
    wall_list *const lists[] = {&c->now, &c->other, &c->added, &c->removed};
    tool_job_drop(context, &c->job);
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        sl_free(context, lists[i]->items);
        *lists[i] = (wall_list){0};
    }
}

static void drop_graph(sl_context *context, plan_compare *c) {
    task_drop(context, c->graph_job);
    c->graph_job = NULL;
    c->graph_failed = false;
    heat_graph_destroy(context, &c->graph);
    c->stamp++;
}

void compare_clear(view_state *view) {
    plan_compare *c = view->compared;
    if (!c) return;
    task_drop(view->context, c->reads);
    drop_walls(view->context, c);
    drop_graph(view->context, c);
    sl_query_destroy(view->context, c->query);
    sl_baked_destroy(view->context, &c->baked);
    sl_map_destroy(view->context, &c->map);
    document_source_destroy(view->context, &c->source);
    sl_free(view->context, c);
    view->compared = NULL;
}

// --- reading

static sl_status read_plan(sl_context *context, void *data) {
    plan_compare *c = data;
    sl_bake_options options = sl_bake_options_default();
    sl_bake_account account = {0};
    sl_map map = {0};
    if (document_is_baked(c->source.path))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: is baked; compare with the map that it was made of", c->source.path);
    SL_TRY(sl_map_read(context, c->source.path, &c->source.options, &c->map));
    if (c->source.has_weld) options.clean.weld = c->source.weld;
    SL_TRY(sl_map_copy(context, &c->map, &map));
    if (c->source.has_start) SL_TRY(sl_map_add_start(context, &map, c->source.start, 0, 0));
    const sl_status status = sl_bake_space(context, &map, &options, &c->baked, &account);
    sl_map_destroy(context, &map);
    SL_TRY(status);
    return sl_query_over(context, &c->baked.space, &c->baked.map, NULL, &c->query);
}

static sl_status begin_reading(view_state *view, const char *path) {
    plan_compare *c = view->compared = sl_alloc_array(view->context, 1, sizeof *view->compared);
    document_source source = view->document->source;
    if (!c) return SL_NO_MEMORY;
    source.path = (char *)(uintptr_t)path;
    SL_TRY(document_source_copy(view->context, &source, &c->source));
    return task_start(view->context, read_plan, c, "read", NULL, &c->reads);
}

void compare_open(view_state *view, const char *path) {
    compare_clear(view);
    view_check(view, begin_reading(view, path));
}

/// Two plans in different units have no place in common.
static sl_status check_units(view_state *view, const plan_compare *c) {
    const char *unit = view->document->map.unit;
    if (!*unit || !*c->map.unit || strcmp(unit, c->map.unit) == 0) return SL_OK;
    return sl_fail(view->context, SL_BAD_ARGUMENT,
                   "%s: its lengths are in %s, those of the open plan in %s: open both in one unit "
                   "(Ctrl+I)",
                   c->source.path, c->map.unit, unit);
}

static void take_plan(view_state *view, plan_compare *c) {
    sl_status status = task_end(view->context, c->reads);
    c->reads = NULL;
    if (status == SL_OK) status = check_units(view, c);
    if (status != SL_OK) {
        view_check(view, status);
        compare_clear(view);
        return;
    }
    c->read = true;
    for (uint32_t i = 0; i < c->baked.space.cell_count; i++)
        if (c->baked.space.cells[i].inside) c->area += sl_space_area(&c->baked.space, i);
    ui_say(view->ui, false, "compared with %s", files_base(c->source.path));
}

// --- walls

static sl_status compare_walls(sl_context *context, void *data) {
    plan_compare *c = data;
    SL_TRY(wall_change_add(context, &c->now, &c->other, &c->removed));
    return wall_change_add(context, &c->other, &c->now, &c->added);
}

static sl_status list_walls(sl_context *context, const sl_map *map, wall_list *out) {
    SL_TRY(SL_ARRAY_ROOM(context, out, map->wall_count));
    for (size_t i = 0; i < map->wall_count; i++)
        out->items[out->count++] = (sl_segment){map->walls[i].a, map->walls[i].b};
    return SL_OK;
}

static void update_walls(view_state *view, plan_compare *c, bool wait) {
    sl_status status = SL_OK;
    if (tool_job_is_old(view, &c->job)) drop_walls(view->context, c);
    if (!c->now.items) status = list_walls(view->context, &view->document->map, &c->now);
    if (!c->other.items && status == SL_OK) status = list_walls(view->context, &c->map, &c->other);
    view_check(view, status);
    if (status == SL_OK) tool_job_update(view, &c->job, wait, compare_walls, c);
}

// --- the graph

const heat_graph *compare_graph(const view_state *view, unsigned part) {
    const plan_compare *c = compare_shown(view);
    const bool there = c && !c->graph_job && c->graph.made && !(part & ~c->graph.parts) &&
                       c->graph.step == heat_step(view);
    return there ? &c->graph : NULL;
}

static sl_status begin_graph(view_state *view, plan_compare *c) {
    c->graph.step = heat_step(view);
    c->graph.range = c->baked.map.range;
    SL_TRY(sl_query_copy(view->context, c->query, &c->graph.query));
    return sl_vga_steps_create(view->context, &c->baked, c->graph.query, NULL, &c->graph.steps);
}

static void update_graph(view_state *view, plan_compare *c, bool wait) {
    const unsigned part = heat_measure_part(heat_measure(view->heat_choice.measure));
    sl_status status = SL_OK;
    if (c->graph.query && c->graph.step != heat_step(view)) drop_graph(view->context, c);
    if (!layers_shows(view, LAYER_HEAT) || !part) return;
    if (!c->graph_job && !c->graph_failed && (!c->graph.made || part & ~c->graph.parts)) {
        if (!c->graph.query) status = begin_graph(view, c);
        c->graph.wanted = part;
        if (status == SL_OK)
            status =
                task_start(view->context, heat_graph_work, &c->graph, NULL, NULL, &c->graph_job);
        c->graph_failed = status != SL_OK;
    }
    if (c->graph_job && (wait || task_done(c->graph_job))) {
        status = task_end(view->context, c->graph_job);
        c->graph_job = NULL;
        c->graph_failed = status != SL_OK;
        c->stamp++;
    }
    view_check(view, status);
}

void compare_update(view_state *view, bool wait) {
    plan_compare *c = view->compared;
    if (c && c->reads && (wait || task_done(c->reads))) take_plan(view, c);
    if (!compare_changes(view) || !view->document->baked) return;
    update_walls(view, view->compared, wait);
    update_graph(view, view->compared, wait);
}

job_progress compare_progress(const view_state *view) {
    const plan_compare *c = view->compared;
    if (c && c->reads) return task_progress(c->reads);
    if (c && c->graph_job) return task_progress(c->graph_job);
    return c ? tool_job_progress(&c->job) : (job_progress){0};
}

bool compare_stop(view_state *view) {
    plan_compare *c = view->compared;
    if (!c || !compare_progress(view).running) return false;
    if (c->reads) {
        compare_clear(view);
        return true;
    }
    tool_job_stop(view->context, &c->job);
    if (c->graph_job) {
        drop_graph(view->context, c);
        c->graph_failed = true;
    }
    return true;
}

// --- drawing

sl_colour compare_colour(const ui_state *ui, bool added) {
    return sl_palette_changes(ui->dark, added ? 1 : 0);
}

static void draw_walls(const view_state *view, const sl_frame *frame, const wall_list *walls,
                       bool added) {
    cairo_new_path(view->ui->cairo);
    for (size_t i = 0; i < walls->count; i++)
        sl_path_segment(view->ui->cairo, frame, walls->items[i].a, walls->items[i].b);
    tone_cased(view->ui->cairo, &view->ui->palette, compare_colour(view->ui, added),
               3.4 * frame->unit, added ? 0 : 2.5);
}

void compare_draw(const view_state *view, const sl_frame *frame) {
    const plan_compare *c = compare_shown(view);
    if (!c || !c->job.made) return;
    draw_walls(view, frame, &c->removed, false);
    draw_walls(view, frame, &c->added, true);
}
