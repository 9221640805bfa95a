/// A job finds the lines, measures all of them, and tells which are joined. The measure is chosen
/// afterwards: all are there.
#include "plan/line_map.h"

#include "plan/grid.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_at_hand(const view_state *view) {
    return view->mode == MODE_PLAN && (view->tool == TOOL_AXIAL || view->tool == TOOL_SEGMENTS);
}

/// The place of the map of the tool at hand.
static line_map **place_of(view_state *view) {
    return &view->lines[view->tool == TOOL_SEGMENTS];
}

static void forget(sl_context *context, line_map *map) {
    tool_job_drop(context, &map->job);
    sl_free(context, map->lines);
    sl_free(context, map->measures);
    sl_free(context, map->parts);
    value_scale_destroy(context, &map->scale);
    *map = (line_map){.chosen = UINT32_MAX};
}

void line_map_destroy(sl_context *context, line_map *map) {
    if (!map) return;
    forget(context, map);
    sl_free(context, map);
}

// --- the work

static size_t measure_size(const line_map *map) {
    return map->segments ? sizeof(sl_segment_measures) : sizeof(sl_axial_measures);
}

static sl_status find_axial(sl_context *context, line_map *map) {
    const sl_outline *outline;
    sl_axial_lines lines = {0};
    SL_TRY(sl_query_outline(context, map->job.query, &outline));
    SL_TRY(sl_axial_all_lines(context, outline, 0, &lines));
    sl_status status = lines.count ? sl_axial_fewest(context, &lines, true)
                                   : sl_fail(context, SL_BAD_ARGUMENT,
                                             "the plan has no axial line: none of its corners is "
                                             "inside; 'Drawn lines' takes those of the drawing");
    if (status == SL_OK) {
        map->lines = lines.lines;
        map->count = lines.count;
        lines.lines = NULL;
    }
    sl_axial_lines_destroy(context, &lines);
    return status;
}

/// Cleaning cuts lines where they cross, and joins their ends.
static sl_status cut_lines(sl_context *context, line_map *map) {
    sl_map cut = {0};
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < map->count && status == SL_OK; i++)
        status = sl_map_add_wall(context, &cut, map->lines[i].a, map->lines[i].b, 0);
    if (status == SL_OK) status = sl_map_clean(context, &cut, NULL, NULL);
    if (status == SL_OK && cut.wall_count > INT32_MAX / 4)
        status = sl_fail(context, SL_UNSUPPORTED, "too many lines");
    sl_free(context, map->lines);
    map->lines =
        status == SL_OK ? sl_alloc_array(context, cut.wall_count + 1, sizeof *map->lines) : NULL;
    if (status == SL_OK && !map->lines) status = SL_NO_MEMORY;
    map->count = 0;
    for (size_t i = 0; status == SL_OK && i < cut.wall_count; i++)
        map->lines[map->count++] = (sl_segment){cut.walls[i].a, cut.walls[i].b};
    sl_map_destroy(context, &cut);
    return status;
}

typedef struct part_size {
    uint32_t number, size;
} part_size;

static int compare_sizes(const void *a, const void *b) {
    const part_size *p = a, *q = b;
    if (p->size != q->size) return p->size < q->size ? 1 : -1;
    return (p->number > q->number) - (p->number < q->number);
}

/// Numbers the parts by a search from each line that has none, and then by their sizes.
static sl_status find_parts(sl_context *context, line_map *map, const sl_line_graph *graph) {
    uint32_t *queue = sl_alloc_array(context, (size_t)map->count + 1, sizeof *queue);
    uint32_t *renamed = sl_alloc_array(context, (size_t)map->count + 1, sizeof *renamed);
    part_size *sizes = sl_alloc_array(context, (size_t)map->count + 1, sizeof *sizes);
    map->parts = sl_alloc_array(context, (size_t)map->count + 1, sizeof *map->parts);
    const bool room = queue && renamed && sizes && map->parts;
    for (uint32_t i = 0; i < map->count && room; i++) map->parts[i] = UINT32_MAX;
    for (uint32_t i = 0; i < map->count && room; i++) {
        uint32_t taken = 0, found = 0;
        if (map->parts[i] != UINT32_MAX) continue;
        const uint32_t part = map->part_count++;
        map->parts[queue[found++] = i] = part;
        for (; taken < found; taken++)
            for (size_t k = graph->first[queue[taken]]; k < graph->first[queue[taken] + 1]; k++)
                if (map->parts[graph->others[k]] == UINT32_MAX)
                    map->parts[queue[found++] = graph->others[k]] = part;
        sizes[part] = (part_size){part, found};
    }
    if (room) {
        qsort(sizes, map->part_count, sizeof *sizes, compare_sizes);
        for (uint32_t i = 0; i < map->part_count; i++) renamed[sizes[i].number] = i;
        for (uint32_t i = 0; i < map->count; i++) map->parts[i] = renamed[map->parts[i]];
    }
    sl_free(context, queue);
    sl_free(context, renamed);
    sl_free(context, sizes);
    return room ? SL_OK : SL_NO_MEMORY;
}

static sl_status measure_lines(sl_context *context, line_map *map) {
    sl_line_graph graph = {0};
    map->measures = sl_alloc_array(context, (size_t)map->count + 1, measure_size(map));
    if (!map->measures) return SL_NO_MEMORY;
    sl_status status = sl_line_graph_make(context, map->lines, map->count, &graph);
    if (status == SL_OK) status = find_parts(context, map, &graph);
    if (status == SL_OK)
        status = map->segments ? sl_segment_measure(context, map->lines, map->count,
                                                    &(sl_segment_options){0}, map->measures)
                               : sl_axial_measure(context, map->lines, &graph,
                                                  &(sl_axial_options){0}, map->measures);
    sl_line_graph_destroy(context, &graph);
    return status;
}

static sl_status find_map(sl_context *context, void *data) {
    line_map *map = data;
    if (!map->drawn) SL_TRY(find_axial(context, map));
    if (map->segments) SL_TRY(cut_lines(context, map));
    return measure_lines(context, map);
}

/// Lines as they are drawn: what has no length is none.
static sl_status take_drawn(const view_state *view, line_map *map) {
    const sl_map *from = &view->document->map;
    map->lines = sl_alloc_array(view->context, from->wall_count + 1, sizeof *map->lines);
    if (!map->lines) return SL_NO_MEMORY;
    for (size_t i = 0; i < from->wall_count && map->count < INT32_MAX; i++) {
        const sl_segment line = {from->walls[i].a, from->walls[i].b};
        if (line.a.x != line.b.x || line.a.y != line.b.y) map->lines[map->count++] = line;
    }
    return SL_OK;
}

static sl_status begin_map(view_state *view, line_map **out) {
    const bool first = !*out;
    if (first) *out = sl_alloc_array(view->context, 1, sizeof **out);
    line_map *map = *out;
    if (!map) return SL_NO_MEMORY;
    if (first) map->chosen = UINT32_MAX;
    map->segments = view->tool == TOOL_SEGMENTS;
    map->drawn = view->drawn_lines;
    return map->drawn && !map->lines ? take_drawn(view, map) : SL_OK;
}

/// The measures that have a scale: those of the chosen line's part, or of the largest.
static sl_status scale_values(view_state *view, line_map *map, size_t measure, uint32_t part) {
    if (map->scaled && map->measure == measure && map->part == part) return SL_OK;
    SL_TRY(value_scale_begin(view->context, &map->scale, map->count));
    map->measure = measure;
    map->part = part;
    map->within = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        if (map->parts[i] != part) continue;
        value_scale_add(&map->scale, line_map_value(map, measure, i));
        map->within++;
    }
    value_scale_end(&map->scale);
    map->scaled = true;
    return SL_OK;
}

void line_map_update(view_state *view, bool wait) {
    if (!is_at_hand(view) || !view->document->baked) return;
    line_map **place = place_of(view);
    if (*place && (tool_job_is_old(view, &(*place)->job) || (*place)->drawn != view->drawn_lines))
        forget(view->context, *place);
    const sl_status status = begin_map(view, place);
    if (status != SL_OK) {
        view_check(view, status);
        return;
    }
    line_map *map = *place;
    if (tool_job_update(view, &map->job, wait, find_map, map))
        ui_say(view->ui, false, "%u %s%s", map->count, map->segments ? "segment" : "line",
               map->count == 1 ? "" : "s");
    if (map->job.made)
        view_check(view, scale_values(view, map, *line_map_choice(view),
                                      map->chosen < map->count ? map->parts[map->chosen] : 0));
}

const line_map *line_map_shown(const view_state *view) {
    const line_map *map = is_at_hand(view) ? view->lines[view->tool == TOOL_SEGMENTS] : NULL;
    return map && map->job.made && map->scaled ? map : NULL;
}

void line_map_try_again(view_state *view) {
    line_map *map = is_at_hand(view) ? *place_of(view) : NULL;
    if (map && map->job.stopped) forget(view->context, map);
}

bool line_map_stop(view_state *view) {
    bool any = false;
    for (int i = 0; i < 2; i++)
        if (view->lines[i]) any |= tool_job_stop(view->context, &view->lines[i]->job);
    return any;
}

job_progress line_map_progress(const view_state *view) {
    job_progress p = {0};
    for (int i = 0; i < 2 && !p.running; i++)
        if (view->lines[i]) p = tool_job_progress(&view->lines[i]->job);
    return p;
}

// --- measures

const sl_measure *line_map_measures(const line_map *map, size_t *count) {
    return sl_measures(map->segments ? SL_SEGMENTS : SL_AXIAL, count);
}

double line_map_value(const line_map *map, size_t measure, uint32_t line) {
    size_t count;
    return sl_measure_value(&line_map_measures(map, &count)[measure],
                            (const char *)map->measures + line * measure_size(map));
}

size_t *line_map_choice(view_state *view) {
    return is_at_hand(view) ? &view->line_measure[view->tool == TOOL_SEGMENTS] : NULL;
}

void line_map_choose(view_state *view, int by) {
    size_t *choice = line_map_choice(view), count;
    const sl_measure *all =
        sl_measures(view->tool == TOOL_SEGMENTS ? SL_SEGMENTS : SL_AXIAL, &count);
    char text[64];
    *choice = (*choice + count + (size_t)(by + (int)count)) % count;
    snprintf(text, sizeof text, "%s", all[*choice].name);
    ui_spaces(text);
    ui_say(view->ui, false, "%s: %s", text, all[*choice].meaning);
}

void line_map_toggle_drawn(view_state *view) {
    view->drawn_lines = !view->drawn_lines;
    ui_say(view->ui, false, "%s",
           view->drawn_lines ? "the lines of the drawing" : "the axial lines of the plan");
}

// --- on the page

static double distance_to(const sl_segment *s, sl_point p) {
    const double x = s->b.x - s->a.x, y = s->b.y - s->a.y, length = x * x + y * y;
    const double along = length > 0 ? ((p.x - s->a.x) * x + (p.y - s->a.y) * y) / length : 0;
    const double at = fmin(fmax(along, 0), 1);
    return hypot(p.x - s->a.x - at * x, p.y - s->a.y - at * y);
}

uint32_t line_map_at(const view_state *view, sl_point at) {
    const line_map *map = line_map_shown(view);
    double least = 0.8 * grid_reach(view);
    uint32_t nearest = UINT32_MAX;
    for (uint32_t i = 0; map && i < map->count; i++) {
        const double away = distance_to(&map->lines[i], at);
        if (away >= least) continue;
        least = away;
        nearest = i;
    }
    return nearest;
}

void line_map_pick(view_state *view, uint32_t line) {
    if (line_map_shown(view)) (*place_of(view))->chosen = line;
}

/// The number of a line's colour; RAMP_STEPS: it is grey.
static int step_of(const view_state *view, const line_map *map, uint32_t line) {
    const double value = line_map_value(map, map->measure, line);
    if (map->parts[line] != map->part || isnan(value)) return RAMP_STEPS;
    if (view->heat_choice.ranks) return ramp_step(value_scale_rank(&map->scale, value), 0, 1);
    return ramp_step(value, map->scale.least, map->scale.most);
}

/// High values lie on top, each step a little wider than the last.
void line_map_draw(const view_state *view, const sl_frame *frame) {
    const line_map *map = line_map_shown(view);
    cairo_t *cairo = view->ui->cairo;
    if (!map) return;
    signed char *steps = sl_alloc_array(view->context, (size_t)map->count + 1, 1);
    if (!steps) return;
    for (uint32_t i = 0; i < map->count; i++) steps[i] = (signed char)step_of(view, map, i);
    for (int n = 0; n <= RAMP_STEPS; n++) {
        const int step = n ? n - 1 : RAMP_STEPS;
        cairo_new_path(cairo);
        for (uint32_t i = 0; i < map->count; i++)
            if (steps[i] == step) sl_path_segment(cairo, frame, map->lines[i].a, map->lines[i].b);
        sl_set_colour(cairo, n ? ramp_colour(view->ui, RAMP_LINES, step) : view->ui->palette.faint);
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
        cairo_set_line_width(cairo, (n ? 1.5 + 2.0 * step / RAMP_STEPS : 1) * frame->unit);
        cairo_stroke(cairo);
    }
    sl_free(view->context, steps);
}

bool line_map_key(const view_state *view, legend_key *key) {
    const line_map *map = line_map_shown(view);
    char unit[SL_UNIT_TEXT], text[SL_COUNT_TEXT], value[SCALE_TEXT];
    size_t count;
    sl_point at;
    if (!map) return false;
    const sl_measure *measure = &line_map_measures(map, &count)[map->measure];
    *key = (legend_key){.ramp = RAMP_LINES};
    snprintf(text, sizeof text, "%s", measure->name);
    ui_spaces(text);
    sl_measure_say_unit(measure, view->document->map.unit, unit);
    legend_key_add(key, text, unit);
    const uint32_t pointed = view_pointed(view, &at) ? line_map_at(view, at) : UINT32_MAX;
    value_scale_say(pointed < map->count ? line_map_value(map, map->measure, pointed) : NAN, value);
    legend_key_add(key, "under the pointer", value);
    sl_text_count(map->count, map->segments ? "segment" : "line", text);
    legend_key_add(key, map->drawn ? "drawn" : "network", text);
    if (view->heat_choice.ranks)
        value_scale_quarters(&map->scale, map->segments ? "segments" : "lines", key);
    if (map->part_count > 1) {
        sl_text_count(map->count - map->within, "", text);
        legend_key_add(key, "grey: not joined to these", text);
    }
    const bool any = map->scale.least <= map->scale.most;
    value_scale_say(any ? map->scale.least : NAN, key->least);
    value_scale_say(any ? map->scale.most : NAN, key->most);
    return true;
}
