/// The heat map: what it is of (map, doors, range, grid), when it is made anew, and how it is
/// drawn.
///
/// While a job runs, the graph belongs to it, and no values are shown: old ones would be those of
/// another map or measure. Without a job the main thread evaluates the chosen measure once. Steps
/// are counted again whenever the point at the pointer changes, by one breadth-first search.
///
/// The squares are part of the kept picture below the plan (pane_plan.c): `stamp` tells it when
/// they change. Where another layer fills the plan, lines between four levels are drawn over it.
#include "plan/heat.h"

#include "app/app.h"
#include "document/task.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct heat_layer {
    // What it is of.
    uint32_t version;
    double range;
    bool *shut; ///< by door
    size_t door_count;

    heat_graph graph;   ///< the job's while it runs
    task *job;          ///< NULL: none
    unsigned has;       ///< groups that are measured, as of the last job
    bool made, stopped; ///< the graph is there; the last job failed or was stopped

    size_t measure;  ///< of the values
    double *values;  ///< by point
    bool valued;     ///< they are there
    uint32_t *sizes; ///< by point: of the part of the graph that it is in
    uint32_t beyond; ///< values that are beyond the scale: of small parts
    double least, most;
    uint32_t from;    ///< of steps: the point they begin at
    uint32_t *steps;  ///< by point
    uint32_t deepest; ///< of all steps that were counted
};

// --- the grid

/// The usual grid has up to this number of points, by the area inside.
#define USUAL_POINTS  4000
#define FEWEST_POINTS 60

/// Steps are 1, 2 or 5 times a power of ten: number 0 is 1, number 3 is 10.
static double step_numbered(int number) {
    static const double digits[] = {1, 2, 5};
    const int tens = (int)floor(number / 3.0);
    return digits[number - 3 * tens] * pow(10, tens);
}

/// The smallest of those steps that gives no more than so many points.
static int number_for(const app_state *app, double points) {
    const double least = sqrt(app->document.area / points);
    int number = 3 * (int)floor(log10(least));
    while (step_numbered(number) < least) number++;
    return number;
}

double heat_step(const app_state *app) {
    int last;
    const int place = heat_step_place(app, &last);
    return app->document.area > 0 ? step_numbered(number_for(app, FEWEST_POINTS) - place) : 0;
}

int heat_step_place(const app_state *app, int *last) {
    *last = 0;
    if (!(app->document.area > 0)) return 0;
    const int coarse = number_for(app, FEWEST_POINTS);
    int number = number_for(app, USUAL_POINTS);
    *last = coarse - number_for(app, HEAT_POINTS_MOST);
    if (app->view.heat_choice.step > 0) number = (int)round(3 * log10(app->view.heat_choice.step));
    return coarse - number < 0 ? 0 : coarse - number > *last ? *last : coarse - number;
}

void heat_set_step(app_state *app, int place) {
    int last;
    const int now = heat_step_place(app, &last);
    place = place < 0 ? 0 : place > last ? last : place;
    if (last && place != now)
        app->view.heat_choice.step = step_numbered(number_for(app, FEWEST_POINTS) - place);
}

// --- the work

static void end_job(sl_context *context, heat_layer *layer) {
    if (!layer->job) return;
    task_drop(context, layer->job);
    layer->job = NULL;
    layer->made = layer->graph.made;
    layer->has = layer->graph.parts;
}

void heat_layer_destroy(sl_context *context, heat_layer *layer) {
    if (!layer) return;
    end_job(context, layer);
    heat_graph_destroy(context, &layer->graph);
    sl_free(context, layer->shut);
    sl_free(context, layer->values);
    sl_free(context, layer->sizes);
    sl_free(context, layer->steps);
    sl_free(context, layer);
}

static void drop(app_state *app) {
    heat_layer_destroy(app->context, app->view.heat);
    app->view.heat = NULL;
    app->view.heat_choice.stamp++;
}

static bool is_old(const app_state *app, const heat_layer *layer) {
    const document_state *document = &app->document;
    if (layer->version != document->version || layer->range != document->map.range ||
        !document->baked || layer->door_count != document->baked->map.door_count ||
        layer->graph.step != heat_step(app))
        return true;
    bool same = true;
    for (size_t i = 0; i < layer->door_count; i++)
        same &= layer->shut[i] == !document->baked->map.doors[i].open;
    return !same;
}

static const sl_measure *chosen(const app_state *app) {
    return heat_measure(app->view.heat_choice.measure);
}

static unsigned chosen_part(const app_state *app) {
    return heat_measure_part(chosen(app));
}

static sl_status start(app_state *app, heat_layer *layer) {
    layer->graph.wanted = chosen_part(app);
    layer->stopped = true; // where it fails too, so that it is not tried again and again
    SL_TRY(task_start(app->context, heat_graph_work, &layer->graph, NULL, NULL, &layer->job));
    layer->stopped = false;
    layer->measure = app->view.heat_choice.measure;
    return SL_OK;
}

/// Takes a copy of what is asked.
static sl_status begin(app_state *app) {
    const document_state *document = &app->document;
    const sl_map *map = &document->baked->map;
    heat_layer *layer = sl_alloc_array(app->context, 1, sizeof *layer);
    if (!layer) return SL_NO_MEMORY;
    app->view.heat = layer;
    layer->stopped = true;
    layer->version = document->version;
    layer->range = layer->graph.range = document->map.range;
    layer->graph.step = heat_step(app);
    layer->shut = sl_alloc_array(app->context, map->door_count + 1, sizeof *layer->shut);
    if (!layer->shut) return SL_NO_MEMORY;
    layer->door_count = map->door_count;
    for (size_t i = 0; i < map->door_count; i++) layer->shut[i] = !map->doors[i].open;
    SL_TRY(sl_effects_check(app->context, map, "the heat map", ~(unsigned)SL_EFFECT_MIRROR,
                            "steps and paths lead straight to points, not to mirror "
                            "images"));
    if (sl_map_steps_differ(map))
        sl_note(app->context,
                "some walls stop steps and not sight, or sight and not steps: the heat map goes "
                "by sight in all measures; 'sightline vga' has paths by steps");
    SL_TRY(sl_query_copy(app->context, app->view.present.query, &layer->graph.query));
    return start(app, layer);
}

static sl_status take(app_state *app, heat_layer *layer) {
    const sl_status status = task_end(app->context, layer->job);
    layer->job = NULL;
    layer->made = layer->graph.made;
    layer->has = layer->graph.parts;
    layer->stopped = status != SL_OK;
    if (status == SL_OK) return SL_OK;
    char message[512];
    snprintf(message, sizeof message, "%s", sl_context_message(app->context));
    return sl_fail(app->context, status, "heat map: %s", message);
}

bool heat_layer_stop(app_state *app) {
    if (!app->view.heat || !app->view.heat->job) return false;
    end_job(app->context, app->view.heat);
    app->view.heat->stopped = true;
    return true;
}

job_progress heat_layer_progress(const heat_layer *layer) {
    return layer && layer->job ? task_progress(layer->job) : (job_progress){0};
}

// --- values

/// The place of the map under the pointer; false: it is not over the plan.
static bool find_pointed(const app_state *app, sl_point *at) {
    const window_layout l = app_layout(app);
    for (int i = 0; i < l.plan_count; i++) {
        if (!box_has(l.plan[i], app->tool.pointer)) continue;
        *at = camera_point(&app->view.camera, l.plan[i], app->tool.pointer);
        return true;
    }
    return false;
}

static sl_status count_from(sl_context *context, heat_layer *layer, uint32_t from) {
    SL_TRY(sl_vga_step_depth(context, &layer->graph.graph, &from, 1, layer->steps));
    for (uint32_t p = 0; p < layer->graph.grid.count; p++)
        if (layer->steps[p] != UINT32_MAX && layer->steps[p] > layer->deepest)
            layer->deepest = layer->steps[p];
    return SL_OK;
}

/// Steps from the point at the pointer; where that is not over the plan, at the eye. The scale ends
/// at the most steps that were counted. To begin with, that is from the farthest point too.
static sl_status count_steps(app_state *app, heat_layer *layer) {
    sl_point at = app->view.eye.at;
    find_pointed(app, &at);
    const uint32_t count = layer->graph.grid.count;
    const uint32_t from = heat_graph_nearest(app->context, &layer->graph, at);
    if (layer->valued && (from == layer->from || from == UINT32_MAX)) return SL_OK;
    if (!layer->steps) layer->steps = sl_alloc_array(app->context, count, sizeof *layer->steps);
    if (!layer->steps) return SL_NO_MEMORY;
    if (from != UINT32_MAX && !layer->deepest) {
        uint32_t far = from;
        SL_TRY(count_from(app->context, layer, from));
        for (uint32_t p = 0; p < count; p++)
            if (layer->steps[p] == layer->deepest) far = p;
        SL_TRY(count_from(app->context, layer, far));
    }
    if (from != UINT32_MAX) SL_TRY(count_from(app->context, layer, from));
    for (uint32_t p = 0; p < count; p++)
        layer->values[p] =
            from == UINT32_MAX || layer->steps[p] == UINT32_MAX ? NAN : layer->steps[p];
    layer->from = from;
    layer->least = 0;
    layer->most = layer->deepest;
    layer->beyond = 0;
    layer->valued = true;
    app->view.heat_choice.stamp++;
    return SL_OK;
}

/// The sizes of the graph's parts, once.
static sl_status find_sizes(sl_context *context, heat_layer *layer) {
    if (layer->sizes) return SL_OK;
    uint32_t *sizes = sl_alloc_array(context, (size_t)layer->graph.grid.count + 1, sizeof *sizes);
    if (!sizes) return SL_NO_MEMORY;
    const sl_status status = sl_vga_part_sizes(context, &layer->graph.graph, NULL, 0, sizes);
    if (status == SL_OK)
        layer->sizes = sizes;
    else
        sl_free(context, sizes);
    return status;
}

static sl_status evaluate(app_state *app, heat_layer *layer) {
    const sl_measure *measure = chosen(app);
    const uint32_t count = layer->graph.grid.count;
    if (layer->measure != app->view.heat_choice.measure) layer->valued = false;
    layer->measure = app->view.heat_choice.measure;
    if (!layer->values) layer->values = sl_alloc_array(app->context, count, sizeof *layer->values);
    if (!layer->values) return SL_NO_MEMORY;
    if (!heat_measure_part(measure)) return count_steps(app, layer);
    if (layer->valued) return SL_OK;
    SL_TRY(find_sizes(app->context, layer));
    for (uint32_t p = 0; p < count; p++)
        layer->values[p] = sl_measure_value(measure, &layer->graph.measures[p]);
    const sl_vga_scale scale = sl_vga_scale_of(layer->values, layer->sizes, count);
    layer->least = scale.least;
    layer->most = scale.most;
    layer->beyond = scale.beyond;
    layer->valued = true;
    app->view.heat_choice.stamp++;
    return SL_OK;
}

void heat_layer_update(app_state *app, bool wait) {
    const unsigned part = chosen_part(app);
    if (app->view.heat && is_old(app, app->view.heat)) drop(app);
    if (!layers_shows(app, LAYER_HEAT) || !app->document.baked) {
        // What is there waits for the next time. What is not starts anew then.
        if (app->view.heat && (app->view.heat->job || app->view.heat->stopped)) drop(app);
        return;
    }
    const bool settled = app->document.has_visibility || !(app->document.job || app->document.live);
    if (!app->view.heat && settled && app->view.present.query) app_check(app, begin(app));
    heat_layer *layer = app->view.heat;
    if (!layer) return;
    if (layer->job && layer->made && !(part & ~layer->has)) end_job(app->context, layer);
    if (!layer->job && layer->made && part & ~layer->has &&
        (!layer->stopped || layer->measure != app->view.heat_choice.measure)) {
        layer->valued = false;
        app_check(app, start(app, layer));
    }
    if (layer->job && (wait || task_done(layer->job))) app_check(app, take(app, layer));
    if (!layer->job && layer->made && !(part & ~layer->has)) app_check(app, evaluate(app, layer));
}

void heat_layer_follow(app_state *app) {
    const heat_graph *graph;
    if (heat_layer_values(app, &graph)) app_check(app, evaluate(app, app->view.heat));
}

const double *heat_layer_values(const app_state *app, const heat_graph **graph) {
    const heat_layer *layer = app->view.heat;
    const bool shown = layer && layer->valued && !layer->job &&
                       layer->measure == app->view.heat_choice.measure &&
                       layers_shows(app, LAYER_HEAT);
    if (shown) *graph = &layer->graph;
    return shown ? layer->values : NULL;
}

void heat_layer_scale(const app_state *app, double *least, double *most) {
    const heat_choice *choice = &app->view.heat_choice;
    *least = choice->held ? choice->least : app->view.heat->least;
    *most = choice->held ? choice->most : app->view.heat->most;
}

// --- choices

void heat_say_measure(const app_state *app, char text[64]) {
    snprintf(text, 64, "%s", chosen(app)->name);
    for (char *at = text; *at; at++)
        if (*at == '_') *at = ' ';
}

static void choose(app_state *app, size_t measure) {
    char text[64];
    app->view.heat_choice.measure = measure;
    app->view.heat_choice.held = false;
    app->view.heat_choice.stamp++;
    heat_say_measure(app, text);
    ui_say(&app->ui, false, "%s%s", text, chosen_part(app) ? "" : " from the pointer");
}

void heat_choose(app_state *app, int by) {
    const size_t count = heat_measure_count();
    choose(app, (app->view.heat_choice.measure + count + (size_t)(by + (int)count)) % count);
}

void heat_toggle_steps(app_state *app) {
    heat_choice *choice = &app->view.heat_choice;
    const size_t steps = heat_measure_count() - 1;
    const bool on = choice->measure == steps;
    const size_t next = on ? choice->before : steps;
    if (!on) choice->before = choice->measure;
    choose(app, next == choice->measure ? 0 : next);
}

void heat_toggle_held(app_state *app) {
    heat_choice *choice = &app->view.heat_choice;
    const heat_graph *graph;
    if (!choice->held && !heat_layer_values(app, &graph)) {
        ui_say(&app->ui, false, "no heat map is there; 1 makes one");
        return;
    }
    if (!choice->held) heat_layer_scale(app, &choice->least, &choice->most);
    choice->held = !choice->held;
    choice->stamp++;
    ui_say(&app->ui, false,
           choice->held ? "the colour scale stays as it is: doors, walls and grids can be compared"
                        : "the colour scale follows the values");
}

// --- drawing

/// The number of a square's colour; -1: it has none.
static int step_at(const app_state *app, const heat_layer *layer, size_t square) {
    double least, most;
    const uint32_t p = layer->graph.points[square];
    if (p == UINT32_MAX || isnan(layer->values[p])) return -1;
    heat_layer_scale(app, &least, &most);
    return ramp_step(layer->values[p], least, most);
}

/// Adds the squares of one colour, those that lie over each other as one. `steps` is by square.
static void add_squares(cairo_t *cairo, const sl_frame *frame, const heat_graph *g,
                        const signed char *steps, int step) {
    for (uint32_t column = 0; column < g->grid.columns; column++)
        for (uint32_t row = 0; row < g->grid.rows;) {
            const signed char *of = steps + (size_t)column * g->grid.rows;
            const uint32_t first = row;
            while (row < g->grid.rows && of[row] == step) row++;
            if (row == first) {
                row++;
                continue;
            }
            const double left = ((double)g->grid.left + column - 0.5) * g->step;
            const double low = ((double)g->grid.bottom + first - 0.5) * g->step;
            const double right = left + g->step, high = low + (row - first) * g->step;
            const sl_point corners[] = {{left, low}, {right, low}, {right, high}, {left, high}};
            sl_path_polygon(cairo, frame, corners, 4);
        }
}

void heat_layer_draw(const app_state *app, cairo_t *cairo, const sl_frame *frame) {
    const heat_graph *g;
    if (!heat_layer_values(app, &g) || layers_fill(app) != LAYER_HEAT) return;
    const size_t squares = (size_t)g->grid.columns * g->grid.rows;
    signed char *steps = sl_alloc_array(app->context, squares, 1);
    if (!steps) return;
    for (size_t i = 0; i < squares; i++) steps[i] = (signed char)step_at(app, app->view.heat, i);
    cairo_save(cairo);
    layers_clip_inside(&app->document, cairo, frame);
    for (int step = 0; step < RAMP_STEPS; step++) {
        add_squares(cairo, frame, g, steps, step);
        sl_set_colour(cairo, ramp_colour(&app->ui, step));
        cairo_fill_preserve(cairo); // a thin stroke covers the seams
        cairo_set_line_width(cairo, 0.6);
        cairo_stroke(cairo);
    }
    cairo_restore(cairo);
    sl_free(app->context, steps);
}

/// Lines between levels, each a fourth of the colours. They run along sides of squares.
void layer_heat(app_state *app, const sl_frame *frame, int index) {
    enum { LEVEL = RAMP_STEPS / 4 };
    const heat_graph *g;
    (void)index;
    if (!heat_layer_values(app, &g) || layers_fill(app) == LAYER_HEAT) return;
    const double half = g->step / 2;
    cairo_new_path(app->ui.cairo);
    for (uint32_t p = 0; p < g->grid.count; p++) {
        const uint32_t square = g->grid.squares[p], row = square % g->grid.rows;
        const sl_point at = g->grid.points[p], corner = {at.x + half, at.y + half};
        const int here = step_at(app, app->view.heat, square);
        const bool last = square / g->grid.rows + 1 == g->grid.columns;
        const int right = last ? -1 : step_at(app, app->view.heat, square + g->grid.rows);
        const int above =
            row + 1 == g->grid.rows ? -1 : step_at(app, app->view.heat, (size_t)square + 1);
        if (here < 0) continue;
        if (right >= 0 && right / LEVEL != here / LEVEL)
            sl_path_segment(app->ui.cairo, frame, (sl_point){corner.x, at.y - half}, corner);
        if (above >= 0 && above / LEVEL != here / LEVEL)
            sl_path_segment(app->ui.cairo, frame, (sl_point){at.x - half, corner.y}, corner);
    }
    tone_cased(app->ui.cairo, &app->ui.palette, app->ui.palette.wall, 0.9 * frame->unit, 0);
}

// --- the key

/// A dash stands for no value.
static void write_value(double value, char text[32]) {
    if (isnan(value))
        snprintf(text, 32, "\xe2\x80\x93");
    else
        snprintf(text, 32, value != round(value) || fabs(value) >= 1e6 ? "%.4g" : "%.0f", value);
}

/// The value of the square under the pointer; a dash where there is none.
static void write_pointed(const app_state *app, const heat_graph *g, char text[32]) {
    sl_point at;
    uint32_t p = UINT32_MAX;
    if (find_pointed(app, &at)) p = heat_graph_square(g, at);
    write_value(p != UINT32_MAX ? app->view.heat->values[p] : NAN, text);
}

bool heat_layer_key(const app_state *app, legend_key *key) {
    const heat_graph *g;
    double least, most;
    char value[32], count[SL_COUNT_TEXT];
    if (!heat_layer_values(app, &g)) return false;
    heat_layer_scale(app, &least, &most);
    *key = (legend_key){.ramp = layers_fill(app) == LAYER_HEAT};
    heat_say_measure(app, key->rows[0].label);
    write_pointed(app, g, value);
    key->count = 1;
    legend_key_add(key, "under the pointer", value);
    sl_text_count(g->grid.count, "point", count);
    legend_key_add(key, "grid", count);
    snprintf(value, sizeof value, "%.3g", g->step);
    legend_key_add(key, "from point to point", value);
    if (app->view.heat_choice.held) legend_key_add(key, "colour scale", "kept");
    if (app->view.heat->beyond && !app->view.heat_choice.held) {
        sl_text_count(app->view.heat->beyond, "point", count);
        legend_key_add(key, "beyond it, in small parts", count);
    }
    bool blocks = false;
    for (size_t i = 0; i < app->document.object_count; i++) blocks |= app->document.blocks[i];
    if (blocks) legend_key_add(key, "objects", "do not block here");
    if (!(least <= most))
        legend_key_add(key, "no point has a value",
                       app->document.map.start_count ? "not defined here"
                                                     : "put a start in a room");
    write_value(least <= most ? least : NAN, key->least);
    write_value(least <= most ? most : NAN, key->most);
    return true;
}
