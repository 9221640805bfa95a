/// Two questions and a name, then one of the drawings of the library: cameras with their coverage,
/// lines by a measure, the heat map, or the plan, with what the tool adds (sheet_parts.h).
#include "app/sheet.h"

#include "app/action_parts.h"
#include "app/sheet_parts.h"
#include "dialogs/browser.h"
#include "dialogs/map_file.h"
#include "dialogs/question.h"
#include "document/drawings.h"
#include "plan/cameras.h"
#include "plan/heat.h"
#include "plan/line_map.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

// --- what is asked

static const char *const papers[] = {"4:A4", "3:A3", "2:A2", "1:A1", "0:A0", "C:Cancel"};
static const char *const scales[] = {"L:Largest", "5:1:50",  "1:1:100", "2:1:200",
                                     "4:1:250",   "3:1:300", "0:1:500", "C:Cancel"};
enum { PAPERS = sizeof papers / sizeof *papers - 1, SCALES = sizeof scales / sizeof *scales - 1 };
/// An answer without the letter that chooses it.
enum { LETTER = 2 };

static void take_path(desk_state *desk, const char *path) {
    wish_for(desk, WISH_SHEET, path);
}

static void ask_scale(desk_state *desk, const char *said);

/// A scale at which the plan does not fit is asked for again, before a name is.
static void take_scale(desk_state *desk, int answer) {
    char name[TITLE_TEXT], ending[32];
    if (answer == SCALES) return;
    desk->scale = answer ? scales[answer] + LETTER : NULL;
    sl_draw_options options = sl_draw_options_default();
    options.sheet = (sl_sheet){.paper = desk->paper, .scale = desk->scale};
    if (sl_draw_check_sheet(desk->context, desk->document->baked, &options, "sheet.pdf") != SL_OK) {
        ask_scale(desk, sl_context_message(desk->context));
        return;
    }
    snprintf(ending, sizeof ending, "-%s.pdf", desk->paper);
    map_file_name_output(desk, ending, name);
    browser_save(desk, BROWSE_SHEETS, name, take_path);
}

static void take_paper(desk_state *desk, int answer) {
    if (answer == PAPERS) return;
    desk->paper = papers[answer] + LETTER;
    ask_scale(desk, "");
}

static void ask_scale(desk_state *desk, const char *said) {
    char text[512];
    snprintf(
        text, sizeof text,
        "%s%.300s%sWhich scale? The largest is the largest round scale at which the plan fits.",
        *said ? "It does not fit: " : "", said, *said ? ".\n\n" : "");
    question_ask(desk, "Print to scale", text, scales, SCALES + 1, take_scale);
}

void sheet_ask(app_state *app) {
    if (!app->document.baked) return;
    if (*app->document.map.unit)
        question_ask(&app->desk, "Print to scale",
                     "A PDF or an SVG of what the plan shows now, with a scale bar. Which paper?",
                     papers, PAPERS + 1, take_paper);
    else
        ui_say(&app->ui, true, "a scale needs the unit of the plan: %s",
               drawing_unit_hint(app->document.source.path));
}

// --- what is drawn

static sl_status draw_cameras(const app_state *app, const sl_draw_options *options,
                              const char *path) {
    sl_context *context = app->context;
    const camera_layer *layer = app->view.cameras;
    const sl_coverage *c = &layer->coverage;
    const size_t count = layer->table.count;
    sl_viewpoint *viewpoints = sl_alloc_array(context, count + 1, sizeof *viewpoints);
    const char **names = sl_alloc_array(context, count + 1, sizeof *names);
    sl_point *blind = sl_alloc_array(context, c->blind_count + 1, sizeof *blind);
    sl_status status = viewpoints && names && blind ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        viewpoints[i] = layer->table.items[i].view;
        names[i] = layer->table.items[i].name;
    }
    for (size_t i = 0; status == SL_OK && i < c->blind_count; i++) blind[i] = c->blind[i].at;
    const sl_drawn_coverage drawn = {.pieces = &c->overlay.pieces,
                                     .counts = c->overlay.counts,
                                     .viewpoints = viewpoints,
                                     .names = names,
                                     .regions = c->regions,
                                     .count = c->count,
                                     .blind = blind,
                                     .blind_count = c->blind_count};
    if (status == SL_OK)
        status = sl_draw_coverage_file(context, app->document.baked, &drawn, NULL, options, path);
    sl_free(context, viewpoints);
    sl_free(context, names);
    sl_free(context, blind);
    return status;
}

static sl_status draw_lines(app_state *app, const line_map *map, const sl_draw_options *options,
                            const char *path) {
    size_t measures;
    const size_t measure = *line_map_choice(&app->view);
    double *values = sl_alloc_array(app->context, map->count + 1, sizeof *values);
    if (!values) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < map->count; i++)
        values[i] = map->parts[i] == map->part ? line_map_value(map, measure, i) : NAN;
    char name[64];
    snprintf(name, sizeof name, "%s", line_map_measures(map, &measures)[measure].name);
    ui_spaces(name);
    const sl_drawn_lines lines = {
        .name = name, .lines = map->lines, .values = values, .count = map->count};
    const sl_status status =
        sl_draw_lines_file(app->context, app->document.baked, &lines, options, path);
    sl_free(app->context, values);
    return status;
}

static sl_status draw_heat(const app_state *app, const double *of_points, const heat_graph *graph,
                           const sl_draw_options *options, const char *path) {
    const sl_vga_grid *grid = &graph->grid;
    const size_t squares = (size_t)grid->columns * grid->rows;
    double *values = sl_alloc_array(app->context, squares + 1, sizeof *values);
    char name[64];
    if (!values) return SL_NO_MEMORY;
    for (size_t i = 0; i < squares; i++) values[i] = NAN;
    for (uint32_t i = 0; i < grid->count; i++)
        values[(size_t)(grid->squares[i] % grid->rows) * grid->columns +
               grid->squares[i] / grid->rows] = of_points[i];
    heat_say_measure(&app->view, name);
    sl_field field = {.name = name,
                      .corner = {((double)grid->left - 0.5) * grid->step,
                                 ((double)grid->bottom - 0.5) * grid->step},
                      .step = grid->step,
                      .columns = grid->columns,
                      .rows = grid->rows,
                      .values = values,
                      .diverging = heat_layer_changes(&app->view)};
    heat_layer_scale(&app->view, &field.least, &field.most);
    const sl_status status =
        sl_draw_field_file(app->context, app->document.baked, &field, options, path);
    sl_free(app->context, values);
    return status;
}

static sl_status draw_shown(app_state *app, const sl_draw_options *options, const char *path) {
    const view_state *view = &app->view;
    const heat_graph *graph;
    const double *values = heat_layer_values(view, &graph);
    const line_map *lines = line_map_shown(view);
    if (view->mode == MODE_CAMERAS && cameras_are_seen(view))
        return draw_cameras(app, options, path);
    if (lines) return draw_lines(app, lines, options, path);
    if (values) return draw_heat(app, values, graph, options, path);
    return sl_draw_file(app->context, app->document.baked, options, path);
}

sl_status sheet_save(app_state *app, const char *path) {
    sl_draw_options options = sl_draw_options_default();
    char title[TITLE_TEXT];
    double scale = 0;
    map_file_name(&app->desk, title);
    options.layers = SL_LAYER_WALLS | SL_LAYER_STARTS | SL_LAYER_LEGEND;
    options.title = title;
    options.sheet =
        (sl_sheet){.paper = app->desk.paper, .scale = app->desk.scale, .drawn_at = &scale};
    sheet_parts parts = {0};
    const heat_graph *graph;
    const bool over_heat = heat_layer_values(&app->view, &graph) != NULL;
    sl_status status = sheet_parts_fill(&app->view, over_heat, &parts);
    sheet_parts_apply(&parts, &options);
    if (status == SL_OK) status = draw_shown(app, &options, path);
    sheet_parts_destroy(app->context, &parts);
    SL_TRY(status);
    ui_say(&app->ui, false, "printed at 1:%.9g on %s to %s", scale, options.sheet.paper, path);
    return SL_OK;
}
