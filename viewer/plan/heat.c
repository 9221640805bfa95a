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

#include "document/measure.h"
#include "document/task.h"
#include "plan/compare.h"
#include "plan/value_scale.h"
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
    uint32_t *parts; ///< by point: of the graph, which no sightline joins, from the largest on
    uint32_t part_count, part; ///< the one that has the scale: the eye's, or the largest
    uint32_t within;           ///< points in it
    sl_point eye;              ///< that the part was found for
    value_scale scale;         ///< of the values that have it
    bool changes;              ///< the values are the other plan's less those of this one
    uint32_t compared;         ///< the other plan's stamp then
    uint32_t alone;            ///< points that the other plan alone has
    uint32_t from;             ///< of steps: the point they begin at
    uint32_t *steps;           ///< by point
    uint32_t deepest;          ///< of all steps that were counted
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
static int number_for(const view_state *view, double points) {
    const double least = sqrt(view->document->inside_area / points);
    int number = 3 * (int)floor(log10(least));
    while (step_numbered(number) < least) number++;
    return number;
}

/// Whether a step lies between the coarsest and the finest of the slider.
static bool has_step(const view_state *view, double step) {
    return view->document->inside_area > 0 &&
           step >= step_numbered(number_for(view, HEAT_POINTS_MOST)) &&
           step <= step_numbered(number_for(view, FEWEST_POINTS));
}

bool heat_type_step(view_state *view, double step) {
    if (!has_step(view, step)) return false;
    view->heat_choice.step = step;
    return true;
}

double heat_step(const view_state *view) {
    int last;
    if (has_step(view, view->heat_choice.step)) return view->heat_choice.step;
    const int place = heat_step_place(view, &last);
    return view->document->inside_area > 0 ? step_numbered(number_for(view, FEWEST_POINTS) - place)
                                           : 0;
}

int heat_step_place(const view_state *view, int *last) {
    *last = 0;
    if (!(view->document->inside_area > 0)) return 0;
    const int coarse = number_for(view, FEWEST_POINTS);
    int number = number_for(view, USUAL_POINTS);
    *last = coarse - number_for(view, HEAT_POINTS_MOST);
    if (view->heat_choice.step > 0) number = (int)round(3 * log10(view->heat_choice.step));
    return coarse - number < 0 ? 0 : coarse - number > *last ? *last : coarse - number;
}

void heat_set_step(view_state *view, int place) {
    int last;
    heat_step_place(view, &last);
    place = place < 0 ? 0 : place > last ? last : place;
    if (!last) return;
    const double step = step_numbered(number_for(view, FEWEST_POINTS) - place);
    if (step != heat_step(view)) view->heat_choice.step = step;
}

void heat_turn_step(view_state *view, int by) {
    int last;
    const double step = heat_step(view);
    const int place = heat_step_place(view, &last);
    const double at = step_numbered(number_for(view, FEWEST_POINTS) - place);
    // A typed step may lie before its place already.
    heat_set_step(view, (by > 0 ? at < step : at > step) ? place : place + by);
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
    sl_free(context, layer->parts);
    value_scale_destroy(context, &layer->scale);
    sl_free(context, layer->steps);
    sl_free(context, layer);
}

static void drop_layer(view_state *view) {
    heat_layer_destroy(view->context, view->heat);
    view->heat = NULL;
    view->heat_choice.stamp++;
}

static bool is_old(const view_state *view, const heat_layer *layer) {
    const document_state *document = view->document;
    if (layer->version != document->version || layer->range != document->map.range ||
        !document->baked || layer->door_count != document->baked->map.door_count ||
        layer->graph.step != heat_step(view))
        return true;
    bool same = true;
    for (size_t i = 0; i < layer->door_count; i++)
        same &= layer->shut[i] == !document->baked->map.doors[i].open;
    return !same;
}

static const sl_measure *chosen_measure(const view_state *view) {
    return heat_measure(view->heat_choice.measure);
}

static unsigned chosen_part(const view_state *view) {
    return heat_measure_part(chosen_measure(view));
}

static sl_status start_work(view_state *view, heat_layer *layer) {
    layer->graph.wanted = chosen_part(view);
    layer->stopped = true; // where it fails too, so that it is not tried again and again
    SL_TRY(task_start(view->context, heat_graph_work, &layer->graph, NULL, NULL, &layer->job));
    layer->stopped = false;
    layer->measure = view->heat_choice.measure;
    return SL_OK;
}

/// Takes a copy of what is asked.
static sl_status begin_layer(view_state *view) {
    const document_state *document = view->document;
    const sl_map *map = &document->baked->map;
    heat_layer *layer = sl_alloc_array(view->context, 1, sizeof *layer);
    if (!layer) return SL_NO_MEMORY;
    view->heat = layer;
    layer->stopped = true;
    layer->version = document->version;
    layer->range = document->map.range;
    layer->graph.step = heat_step(view); // what is old is told by it, where this fails too
    layer->shut = sl_alloc_array(view->context, map->door_count + 1, sizeof *layer->shut);
    if (!layer->shut) return SL_NO_MEMORY;
    layer->door_count = map->door_count;
    for (size_t i = 0; i < map->door_count; i++) layer->shut[i] = !map->doors[i].open;
    SL_TRY(heat_graph_begin(view->context, document->baked, view->present.query, layer->graph.step,
                            layer->range, &layer->graph));
    return start_work(view, layer);
}

static sl_status take_work(view_state *view, heat_layer *layer) {
    const sl_status status = task_end(view->context, layer->job);
    layer->job = NULL;
    layer->made = layer->graph.made;
    layer->has = layer->graph.parts;
    layer->stopped = status != SL_OK;
    if (status == SL_OK) return SL_OK;
    char message[512];
    snprintf(message, sizeof message, "%s", sl_context_message(view->context));
    return sl_fail(view->context, status, "heat map: %s", message);
}

bool heat_layer_stop(view_state *view) {
    if (!view->heat || !view->heat->job) return false;
    end_job(view->context, view->heat);
    view->heat->stopped = true;
    return true;
}

job_progress heat_layer_progress(const heat_layer *layer) {
    return layer && layer->job ? task_progress(layer->job) : (job_progress){0};
}

// --- values

/// The place of the map under the pointer; false: it is not over the plan.
static bool find_pointed(const view_state *view, sl_point *at) {
    for (int i = 0; i < view->plan_count; i++) {
        if (!box_has(view->plan[i], view->ui->pointer)) continue;
        *at = camera_point(&view->camera, view->plan[i], view->ui->pointer);
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
static sl_status count_steps(view_state *view, heat_layer *layer) {
    sl_point at = view->eye.at;
    find_pointed(view, &at);
    const uint32_t count = layer->graph.grid.count;
    const uint32_t from = heat_graph_nearest(view->context, &layer->graph, at);
    if (layer->valued && (from == layer->from || from == UINT32_MAX)) return SL_OK;
    if (!layer->steps) layer->steps = sl_alloc_array(view->context, count, sizeof *layer->steps);
    if (!layer->steps) return SL_NO_MEMORY;
    if (from != UINT32_MAX && !layer->deepest) {
        uint32_t far = from;
        SL_TRY(count_from(view->context, layer, from));
        for (uint32_t p = 0; p < count; p++)
            if (layer->steps[p] == layer->deepest) far = p;
        SL_TRY(count_from(view->context, layer, far));
    }
    if (from != UINT32_MAX) SL_TRY(count_from(view->context, layer, from));
    for (uint32_t p = 0; p < count; p++)
        layer->values[p] =
            from == UINT32_MAX || layer->steps[p] == UINT32_MAX ? NAN : layer->steps[p];
    layer->from = from;
    layer->scale.least = 0;
    layer->scale.most = layer->deepest;
    layer->valued = true;
    view->heat_choice.stamp++;
    return SL_OK;
}

/// The graph's parts, once; and again where the eye has moved the one that it is in. Beside the
/// grid the part stays. True: it is another one.
static bool find_part(view_state *view, heat_layer *layer, sl_status *status) {
    const heat_graph *g = &layer->graph;
    const bool first = !layer->parts,
               moved = layer->eye.x != view->eye.at.x || layer->eye.y != view->eye.at.y;
    if (first) {
        uint32_t *parts = sl_alloc_array(view->context, (size_t)g->grid.count + 1, sizeof *parts);
        *status = parts ? sl_vga_parts(view->context, &g->graph, NULL, 0, parts, &layer->part_count)
                        : SL_NO_MEMORY;
        if (*status != SL_OK) sl_free(view->context, parts);
        if (*status != SL_OK) return false;
        layer->parts = parts;
    }
    if (!first && (!moved || layer->part_count < 2)) return false;
    const uint32_t at = heat_graph_nearest(view->context, g, view->eye.at), before = layer->part;
    layer->eye = view->eye.at;
    if (at != UINT32_MAX) layer->part = layer->parts[at];
    return layer->part != before;
}

/// Whether a point has no colour of its own: it is in another part than that with the scale. Steps
/// have none there.
static bool is_grey(const heat_layer *layer, uint32_t point) {
    return !layer->changes && layer->parts && layer->parts[point] != layer->part &&
           heat_measure_part(heat_measure(layer->measure));
}

uint32_t heat_layer_part(const view_state *view, uint32_t point) {
    const heat_layer *layer = view->heat;
    return layer && layer->parts && layer->part_count > 1 ? layer->parts[point] + 1 : 0;
}

/// The value of a point in the other plan; NAN where it has none.
static double other_value(heat_layer *layer, const heat_graph *other, const sl_measure *measure,
                          uint32_t point) {
    const uint32_t p = heat_graph_square(other, layer->graph.grid.points[point]);
    if (p == UINT32_MAX) return NAN;
    layer->alone--;
    return sl_measure_value(measure, &other->measures[p]);
}

static sl_status evaluate_measure(view_state *view, heat_layer *layer) {
    const sl_measure *measure = chosen_measure(view);
    const uint32_t count = layer->graph.grid.count;
    if (layer->measure != view->heat_choice.measure) layer->valued = false;
    layer->measure = view->heat_choice.measure;
    if (!layer->values) layer->values = sl_alloc_array(view->context, count, sizeof *layer->values);
    if (!layer->values) return SL_NO_MEMORY;
    if (!heat_measure_part(measure)) {
        layer->changes = false;
        return count_steps(view, layer);
    }
    sl_status status = SL_OK;
    const bool changes = compare_changes(view);
    const heat_graph *other = compare_graph(view, heat_measure_part(measure));
    if (find_part(view, layer, &status)) layer->valued = false;
    if (changes != layer->changes) view->heat_choice.held = false; // that is the other's scale
    if (changes != layer->changes || (changes && layer->compared != view->compared->stamp))
        layer->valued = false;
    if (layer->valued || status != SL_OK || (changes && !other)) return status;
    layer->changes = changes;
    if (changes) layer->compared = view->compared->stamp;
    layer->alone = changes ? other->grid.count : 0;
    SL_TRY(value_scale_begin(view->context, &layer->scale, count));
    layer->within = 0;
    for (uint32_t p = 0; p < count; p++) {
        double value = sl_measure_value(measure, &layer->graph.measures[p]);
        if (changes) value = other_value(layer, other, measure, p) - value;
        layer->values[p] = value;
        if (is_grey(layer, p)) continue;
        value_scale_add(&layer->scale, value);
        layer->within++;
    }
    value_scale_end(&layer->scale);
    if (changes && layer->scale.count) { // as far on both sides of 0
        layer->scale.most = fmax(fabs(layer->scale.least), fabs(layer->scale.most));
        layer->scale.least = -layer->scale.most;
    }
    layer->valued = true;
    view->heat_choice.stamp++;
    return SL_OK;
}

void heat_layer_update(view_state *view, bool wait) {
    const unsigned part = chosen_part(view);
    if (view->heat && is_old(view, view->heat)) drop_layer(view);
    if (!layers_shows(view, LAYER_HEAT) || !view->document->baked) {
        // What is there waits for the next time. What is not starts anew then.
        if (view->heat && (view->heat->job || view->heat->stopped)) drop_layer(view);
        return;
    }
    const bool settled =
        view->document->has_visibility || !(view->document->job || view->document->live);
    if (!view->heat && settled && view->present.query) view_check(view, begin_layer(view));
    heat_layer *layer = view->heat;
    if (!layer) return;
    if (layer->job && layer->made && !(part & ~layer->has)) end_job(view->context, layer);
    if (!layer->job && layer->made && part & ~layer->has &&
        (!layer->stopped || layer->measure != view->heat_choice.measure)) {
        layer->valued = false;
        view_check(view, start_work(view, layer));
    }
    if (layer->job && (wait || task_done(layer->job))) view_check(view, take_work(view, layer));
    if (!layer->job && layer->made && !(part & ~layer->has))
        view_check(view, evaluate_measure(view, layer));
}

void heat_layer_follow(view_state *view) {
    const heat_graph *graph;
    if (heat_layer_values(view, &graph)) view_check(view, evaluate_measure(view, view->heat));
}

const double *heat_layer_values(const view_state *view, const heat_graph **graph) {
    const heat_layer *layer = view->heat;
    const bool shown = layer && layer->valued && !layer->job &&
                       layer->measure == view->heat_choice.measure &&
                       layers_shows(view, LAYER_HEAT);
    if (shown) *graph = &layer->graph;
    return shown ? layer->values : NULL;
}

bool heat_layer_changes(const view_state *view) {
    const heat_graph *graph;
    return heat_layer_values(view, &graph) && view->heat->changes;
}

void heat_layer_scale(const view_state *view, double *least, double *most) {
    const heat_choice *choice = &view->heat_choice;
    *least = choice->held ? choice->least : view->heat->scale.least;
    *most = choice->held ? choice->most : view->heat->scale.most;
}

// --- choices

void heat_say_measure(const view_state *view, char text[64]) {
    snprintf(text, 64, "%s", chosen_measure(view)->name);
    ui_spaces(text);
}

static void choose_measure(view_state *view, size_t measure) {
    char text[64];
    view->heat_choice.measure = measure;
    view->heat_choice.held = false;
    view->heat_choice.stamp++;
    heat_say_measure(view, text);
    ui_say(view->ui, false, "%s%s", text, chosen_part(view) ? "" : " from the pointer");
}

void heat_choose(view_state *view, int by) {
    const size_t count = heat_measure_count();
    choose_measure(view, (view->heat_choice.measure + count + (size_t)(by + (int)count)) % count);
}

void heat_toggle_steps(view_state *view) {
    heat_choice *choice = &view->heat_choice;
    const size_t steps = heat_measure_count() - 1;
    const bool on = choice->measure == steps;
    const size_t next = on ? choice->before : steps;
    if (!on) choice->before = choice->measure;
    choose_measure(view, next == choice->measure ? 0 : next);
}

void heat_toggle_ranks(view_state *view) {
    heat_choice *choice = &view->heat_choice;
    choice->ranks = !choice->ranks;
    choice->stamp++;
    ui_say(view->ui, false, "%s",
           choice->ranks ? "each colour has as many points as any other"
                         : "colours go by the values, in equal steps");
}

void heat_toggle_held(view_state *view) {
    heat_choice *choice = &view->heat_choice;
    const heat_graph *graph;
    if (!choice->held && !heat_layer_values(view, &graph)) {
        ui_say(view->ui, false, "no heat map is there; 1 makes one");
        return;
    }
    if (!choice->held) heat_layer_scale(view, &choice->least, &choice->most);
    choice->held = !choice->held;
    choice->stamp++;
    ui_say(view->ui, false,
           choice->held ? "the colour scale stays as it is: doors, walls and grids can be compared"
                        : "the colour scale follows the values");
}

// --- drawing

enum { NO_COLOUR = -1, GREY = RAMP_STEPS };

/// A scale that is kept is one of values, and so are steps.
static bool by_rank(const view_state *view) {
    return view->heat_choice.ranks && !view->heat_choice.held && chosen_part(view) &&
           !view->heat->changes;
}

/// The number of a square's colour.
static int step_at(const view_state *view, const heat_layer *layer, size_t square) {
    double least, most;
    const uint32_t p = layer->graph.points[square];
    if (p == UINT32_MAX) return NO_COLOUR;
    if (is_grey(layer, p)) return GREY;
    if (isnan(layer->values[p])) return NO_COLOUR;
    if (by_rank(view)) return ramp_step(value_scale_rank(&layer->scale, layer->values[p]), 0, 1);
    heat_layer_scale(view, &least, &most);
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

static ramp_kind ramp_of(const heat_layer *layer) {
    return layer->changes ? RAMP_CHANGES : RAMP_AREAS;
}

void heat_layer_draw(const view_state *view, cairo_t *cairo, const sl_frame *frame) {
    const heat_graph *g;
    if (!heat_layer_values(view, &g) || layers_fill(view) != LAYER_HEAT) return;
    const size_t squares = (size_t)g->grid.columns * g->grid.rows;
    signed char *steps = sl_alloc_array(view->context, squares, 1);
    if (!steps) return;
    for (size_t i = 0; i < squares; i++) steps[i] = (signed char)step_at(view, view->heat, i);
    cairo_save(cairo);
    layers_clip_inside(view->document, cairo, frame);
    const sl_palette *palette = &view->ui->palette;
    for (int step = 0; step <= GREY; step++) {
        add_squares(cairo, frame, g, steps, step);
        sl_set_colour(cairo, step == GREY ? sl_colour_mix(palette->page, palette->ink, 0.18)
                                          : ramp_colour(view->ui, ramp_of(view->heat), step));
        cairo_fill_preserve(cairo); // a thin stroke covers the seams
        cairo_set_line_width(cairo, 0.6);
        cairo_stroke(cairo);
    }
    cairo_restore(cairo);
    sl_free(view->context, steps);
}

/// Lines between levels, each a fourth of the colours. They run along sides of squares.
void layer_heat(view_state *view, const sl_frame *frame, int index) {
    enum { LEVEL = RAMP_STEPS / 4 };
    const heat_graph *g;
    (void)index;
    if (!heat_layer_values(view, &g) || layers_fill(view) == LAYER_HEAT) return;
    const double half = g->step / 2;
    cairo_new_path(view->ui->cairo);
    for (uint32_t p = 0; p < g->grid.count; p++) {
        const uint32_t square = g->grid.squares[p], row = square % g->grid.rows;
        const sl_point at = g->grid.points[p], corner = {at.x + half, at.y + half};
        const int here = step_at(view, view->heat, square);
        const bool last = square / g->grid.rows + 1 == g->grid.columns;
        const int right = last ? -1 : step_at(view, view->heat, square + g->grid.rows);
        const int above =
            row + 1 == g->grid.rows ? -1 : step_at(view, view->heat, (size_t)square + 1);
        if (here < 0) continue;
        if (right >= 0 && right / LEVEL != here / LEVEL)
            sl_path_segment(view->ui->cairo, frame, (sl_point){corner.x, at.y - half}, corner);
        if (above >= 0 && above / LEVEL != here / LEVEL)
            sl_path_segment(view->ui->cairo, frame, (sl_point){at.x - half, corner.y}, corner);
    }
    tone_cased(view->ui->cairo, &view->ui->palette, view->ui->palette.wall, 0.9 * frame->unit, 0);
}

// --- the key

/// The value of the square under the pointer; a dash where there is none.
static void write_pointed(const view_state *view, const heat_graph *g, char text[SCALE_TEXT]) {
    sl_point at;
    uint32_t p = UINT32_MAX;
    if (find_pointed(view, &at)) p = heat_graph_square(g, at);
    value_scale_say(p != UINT32_MAX ? view->heat->values[p] : NAN, text);
}

bool heat_layer_key(const view_state *view, legend_key *key) {
    const heat_graph *g;
    double least, most;
    char value[SCALE_TEXT], step[MEASURE_TEXT], count[SL_COUNT_TEXT];
    if (!heat_layer_values(view, &g)) return false;
    heat_layer_scale(view, &least, &most);
    *key = (legend_key){.ramp = layers_fill(view) == LAYER_HEAT ? ramp_of(view->heat) : RAMP_NONE};
    char unit[SL_UNIT_TEXT];
    heat_say_measure(view, key->rows[0].label);
    if (view->heat->changes) {
        char name[64];
        heat_say_measure(view, name);
        snprintf(key->rows[0].label, sizeof key->rows[0].label, "change of %.50s", name);
    }
    sl_measure_say_unit(chosen_measure(view), view->document->map.unit, unit);
    snprintf(key->rows[0].text, sizeof key->rows[0].text, "%s", unit);
    write_pointed(view, g, value);
    key->count = 1;
    legend_key_add(key, "under the pointer", value);
    sl_text_count(g->grid.count, "point", count);
    legend_key_add(key, "grid", count);
    measure_say(g->step, view->document->map.unit, "", step);
    legend_key_add(key, "from point to point", step);
    if (view->heat_choice.held) legend_key_add(key, "colour scale", "kept");
    if (by_rank(view)) value_scale_quarters(&view->heat->scale, "points", key);
    if (view->heat->alone) {
        sl_text_count(view->heat->alone, "point", count);
        legend_key_add(key, "in the other plan alone", count);
    }
    if (heat_measure_part(chosen_measure(view)) && view->heat->part_count > 1 &&
        !view->heat->changes) {
        char others[2 * SL_COUNT_TEXT];
        sl_text_count(g->grid.count - view->heat->within, "", count);
        snprintf(others, sizeof others, "%s points are grey", count);
        legend_key_add(key, "in parts that the eye's does not see", others);
    }
    bool blocks = false;
    for (size_t i = 0; i < view->document->object_count; i++) blocks |= view->document->blocks[i];
    if (blocks) legend_key_add(key, "objects", "do not block here");
    if (!(least <= most))
        legend_key_add(key, "no point has a value",
                       view->document->map.start_count ? "not defined here"
                                                       : "put a start in a room");
    value_scale_say(least <= most ? least : NAN, key->least);
    value_scale_say(least <= most ? most : NAN, key->most);
    return true;
}
