/// The layer of view cells: a cut of the merge history, coloured by cost. A task makes the history
/// on a copy of the map once the layer is on.
#include "plan/view_cells.h"

#include "document/task.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// --- the job

/// Lines that measure costs, for each line that makes the cells.
#define TELLING 2

typedef struct view_history {
    sl_view_tree tree;
    sl_view_hierarchy hierarchy; ///< told by other lines than those that it was made by
} view_history;

typedef struct view_job {
    task *task;
    sl_map map; ///< a copy
    sl_space space;
    sl_query *query;
    const sl_outline *outline;
    sl_view_places places;
    sl_view_segments segments, telling;
    sl_view_hierarchy merged; ///< as told by the lines that made it
    view_history history;
} view_job;

static void view_history_destroy(sl_context *context, view_history *history) {
    sl_view_hierarchy_destroy(context, &history->hierarchy);
    sl_view_tree_destroy(context, &history->tree);
    *history = (view_history){0};
}

static const sl_view_method *method_that_merges(void) {
    size_t count, i = 0;
    const sl_view_method *methods = sl_view_methods(&count);
    while (i + 1 < count && !methods[i].merges) i++;
    return &methods[i];
}

static sl_status merge_cells(sl_context *context, const sl_view_scene *scene, view_job *job) {
    sl_view_sets sets = {0};
    SL_TRY(sl_view_sets_sample(context, scene, &job->history.tree, &job->segments, 0, &sets));
    const sl_status status =
        sl_view_hierarchy_make(context, scene, &job->history.tree, &sets, true, &job->merged);
    sl_view_sets_destroy(context, &sets);
    return status;
}

/// Uses other lines: the cells fit the lines that made them too well.
static sl_status tell_costs(sl_context *context, const sl_view_scene *scene, view_job *job) {
    sl_view_sampling sampling = sl_view_sampling_default();
    sampling.samples *= TELLING;
    sampling.seed = ~sampling.seed;
    sl_view_sets sets = {0};
    SL_TRY(sl_view_sample(context, job->outline, &sampling, &job->telling));
    SL_TRY(sl_view_sets_sample(context, scene, &job->history.tree, &job->telling, 0, &sets));
    const sl_status status = sl_view_evaluate(context, scene, &job->history.tree, &job->merged,
                                              &sets, &job->history.hierarchy);
    sl_view_sets_destroy(context, &sets);
    return status;
}

/// With as many lines and elementary view cells as `sightline viewcells` takes by default.
static sl_status make_history(sl_context *context, void *data) {
    view_job *job = data;
    const sl_view_sampling sampling = sl_view_sampling_default();
    sl_view_subdivision subdivision = sl_view_subdivision_default();
    subdivision.seed = sampling.seed;
    SL_TRY(sl_map_clean(context, &job->map, NULL, NULL));
    SL_TRY(sl_subdivision_for(&job->map)->subdivide(context, &job->map, NULL, &job->space));
    SL_TRY(sl_query_over(context, &job->space, &job->map, NULL, &job->query));
    SL_TRY(sl_query_outline(context, job->query, &job->outline));
    // Its walls are the outline's: shut doors and glass are among them.
    const sl_space *space;
    SL_TRY(sl_query_space(context, job->query, &space, NULL));
    SL_TRY(sl_view_places_inside(context, space, &job->places));
    const sl_view_scene scene = {space, sampling.objects, sl_render_cost_default(), &job->places};
    SL_TRY(sl_view_sample(context, job->outline, &sampling, &job->segments));
    SL_TRY(method_that_merges()->divide(context, &scene, &job->segments, &subdivision,
                                        &job->history.tree, NULL));
    SL_TRY(merge_cells(context, &scene, job));
    return tell_costs(context, &scene, job);
}

static void free_job(sl_context *context, view_job *job) {
    view_history_destroy(context, &job->history);
    sl_view_hierarchy_destroy(context, &job->merged);
    sl_view_segments_destroy(context, &job->telling);
    sl_view_segments_destroy(context, &job->segments);
    sl_view_places_destroy(context, &job->places);
    sl_query_destroy(context, job->query);
    sl_space_destroy(context, &job->space);
    sl_map_destroy(context, &job->map);
    sl_free(context, job);
}

static sl_status start_job(sl_context *context, const sl_map *map, view_job **out) {
    view_job *job = sl_alloc_array(context, 1, sizeof *job);
    if (!job) return SL_NO_MEMORY;
    sl_status status = sl_map_copy(context, map, &job->map);
    if (status == SL_OK)
        status = task_start(context, make_history, job, "sample", NULL, &job->task);
    if (status == SL_OK)
        *out = job;
    else
        free_job(context, job);
    return status;
}

// --- the layer

/// The first cut costs this much more than the cheapest one, as in `sightline viewcells` by
/// default.
#define TOLERANCE 0.1

struct view_layer {
    uint32_t version; ///< of the document that it is of
    view_job *job;    ///< NULL: done, failed or stopped
    view_history history;
    double *costs;   ///< of the cut with n view cells: n - 1
    uint64_t *bytes; ///< likewise
    uint32_t cells;  ///< of the cut that is shown; 0: none
    uint32_t *view_cells, *numbers;
    double least, most; ///< costs of its cells
    sl_segment *borders, *mark_borders;
    size_t border_count, mark_border_count;
    uint32_t mark; ///< a view cell of the cut, or SL_NO_VIEW_CELL
};

// --- the work

static void end_job(sl_context *context, view_layer *layer) {
    if (!layer->job) return;
    task_drop(context, layer->job->task);
    free_job(context, layer->job);
    layer->job = NULL;
}

static void drop_mark(sl_context *context, view_layer *layer) {
    sl_free(context, layer->mark_borders);
    layer->mark_borders = NULL;
    layer->mark_border_count = 0;
    layer->mark = SL_NO_VIEW_CELL;
}

void view_layer_destroy(sl_context *context, view_layer *layer) {
    if (!layer) return;
    end_job(context, layer);
    drop_mark(context, layer);
    sl_free(context, layer->borders);
    view_history_destroy(context, &layer->history);
    sl_free(context, layer->costs);
    sl_free(context, layer->bytes);
    sl_free(context, layer->view_cells);
    sl_free(context, layer->numbers);
    sl_free(context, layer);
}

static double cost_of(const view_layer *layer, uint32_t view_cell) {
    return layer->history.hierarchy.cost[layer->numbers[view_cell]];
}

/// Shows the cut with this number of view cells.
static sl_status show_cut(sl_context *context, view_layer *layer, uint32_t cells) {
    const view_history *h = &layer->history;
    sl_segment *borders = NULL;
    size_t count = 0;
    layer->cells = 0;
    drop_mark(context, layer);
    SL_TRY(sl_view_cut(context, &h->hierarchy, cells, layer->view_cells, layer->numbers));
    SL_TRY(sl_view_borders(context, &h->tree, layer->view_cells, &borders, &count));
    sl_free(context, layer->borders);
    layer->borders = borders;
    layer->border_count = count;
    layer->cells = cells;
    layer->least = INFINITY;
    layer->most = -INFINITY;
    for (uint32_t i = 0; i < cells; i++) {
        layer->least = fmin(layer->least, cost_of(layer, i));
        layer->most = fmax(layer->most, cost_of(layer, i));
    }
    return SL_OK;
}

static sl_status take_history(sl_context *context, view_layer *layer) {
    view_job *job = layer->job;
    layer->job = NULL;
    const sl_status status = task_end(context, job->task);
    if (status == SL_OK) {
        layer->history = job->history;
        job->history = (view_history){0};
    } else {
        char message[1024];
        snprintf(message, sizeof message, "%s", sl_context_message(context));
        sl_fail(context, status, "view cells: %s", message);
    }
    free_job(context, job);
    SL_TRY(status);
    const sl_view_hierarchy *h = &layer->history.hierarchy;
    layer->costs = sl_alloc_array(context, h->cell_count, sizeof *layer->costs);
    layer->bytes = sl_alloc_array(context, h->cell_count, sizeof *layer->bytes);
    layer->view_cells = sl_alloc_array(context, h->cell_count, sizeof *layer->view_cells);
    layer->numbers = sl_alloc_array(context, h->cell_count, sizeof *layer->numbers);
    if (!layer->costs || !layer->bytes || !layer->view_cells || !layer->numbers)
        return SL_NO_MEMORY;
    sl_view_curve(h, layer->costs, layer->bytes);
    uint32_t cells;
    SL_TRY(sl_view_cut_by_cost(context, h, TOLERANCE, &cells));
    return show_cut(context, layer, cells);
}

static sl_status begin_layer(view_state *view) {
    view_layer *layer = sl_alloc_array(view->context, 1, sizeof *layer);
    if (!layer) return SL_NO_MEMORY;
    layer->version = view->document->version;
    layer->mark = SL_NO_VIEW_CELL;
    view->views = layer; // kept where it fails too, so that it is not tried again and again
    return start_job(view->context, &view->document->map, &layer->job);
}

static void drop_layer(view_state *view) {
    view_layer_destroy(view->context, view->views);
    view->views = NULL;
}

void view_layer_update(view_state *view, bool wait) {
    const bool wanted = view->show & SHOW_VIEWS && view->document->baked;
    if (view->views && view->views->version != view->document->version) drop_layer(view);
    // Switched off, what is there waits for the next time; what is not starts anew then.
    if (!wanted && view->views && !view->views->cells) drop_layer(view);
    if (!wanted) return;
    // The document's version has settled once its cells are seen.
    const bool settled =
        view->document->has_visibility || !(view->document->job || view->document->live);
    if (!view->views && settled) view_check(view, begin_layer(view));
    view_layer *layer = view->views;
    if (layer && layer->job && (wait || task_done(layer->job->task)))
        view_check(view, take_history(view->context, layer));
}

bool view_layer_stop(view_state *view) {
    if (!view->views || !view->views->job) return false;
    end_job(view->context, view->views);
    return true;
}

job_progress view_layer_progress(const view_layer *layer) {
    return layer && layer->job ? task_progress(layer->job->task) : (job_progress){0};
}

// --- the walk through the history

uint32_t view_layer_shown(const view_layer *layer) {
    return layer ? layer->cells : 0;
}

uint32_t view_layer_most(const view_layer *layer) {
    return view_layer_shown(layer) ? layer->history.hierarchy.cell_count : 0;
}

uint32_t view_layer_marked(const view_layer *layer) {
    return view_layer_shown(layer) ? layer->mark : SL_NO_VIEW_CELL;
}

void view_layer_go(view_state *view, uint32_t cells) {
    const uint32_t most = view_layer_most(view->views);
    if (cells > most) cells = most;
    if (cells && cells != view->views->cells)
        view_check(view, show_cut(view->context, view->views, cells));
}

/// The next view cell by falling cost, equal ones by number; the first one after the last.
static uint32_t next_by_cost(const view_layer *layer) {
    const uint32_t none = SL_NO_VIEW_CELL, mark = layer->mark;
    uint32_t first = 0, next = none;
    for (uint32_t i = 0; i < layer->cells; i++) {
        const double cost = cost_of(layer, i);
        if (cost > cost_of(layer, first)) first = i;
        if (mark == none) continue;
        const double last = cost_of(layer, mark);
        const bool after = cost < last || (cost == last && i > mark);
        if (after && (next == none || cost > cost_of(layer, next))) next = i;
    }
    return next == none ? first : next;
}

/// Finds the border of the marked view cell, and the middle of its largest elementary cell.
static sl_status outline_marked(sl_context *context, view_layer *layer, sl_point *middle) {
    const sl_view_tree *tree = &layer->history.tree;
    uint32_t largest = SL_NO_VIEW_CELL;
    uint32_t *mine = sl_alloc_array(context, tree->cell_count, sizeof *mine);
    if (!mine) return SL_NO_MEMORY;
    // To all else it borders as to empty space.
    for (uint32_t i = 0; i < tree->cell_count; i++) {
        const bool inside = layer->view_cells[i] == layer->mark;
        mine[i] = inside ? layer->mark : SL_NO_VIEW_CELL;
        if (inside && (largest == SL_NO_VIEW_CELL || tree->mass[i] > tree->mass[largest]))
            largest = i;
    }
    const sl_status status =
        sl_view_borders(context, tree, mine, &layer->mark_borders, &layer->mark_border_count);
    sl_free(context, mine);
    const uint32_t from = tree->first[largest], count = tree->first[largest + 1] - from;
    *middle = (sl_point){0, 0};
    for (uint32_t i = 0; i < count; i++) {
        middle->x += tree->corners[from + i].x / count;
        middle->y += tree->corners[from + i].y / count;
    }
    return status;
}

/// Writes a count of objects with the digits that matter.
static void write_cost(double cost, char text[32]) {
    snprintf(text, 32, cost < 1000 ? "%.1f" : "%.0f", cost);
}

static void write_bytes(uint64_t bytes, char text[32]) {
    if (bytes < 1024)
        snprintf(text, 32, "%" PRIu64 " bytes", bytes);
    else if (bytes < (uint64_t)1000 << 10)
        snprintf(text, 32, "%.1f KiB", (double)bytes / 1024);
    else
        snprintf(text, 32, "%.1f MiB", (double)bytes / (1024 * 1024));
}

void view_layer_mark_next(view_state *view) {
    view_layer *layer = view->views;
    if (!view_layer_shown(layer)) {
        ui_say(view->ui, false, "no view cells are there; F5 makes them");
        return;
    }
    const uint32_t mark = next_by_cost(layer);
    sl_point middle;
    drop_mark(view->context, layer);
    layer->mark = mark;
    const sl_status status = outline_marked(view->context, layer, &middle);
    view_check(view, status);
    if (status != SL_OK) return;
    if (!view->fitted) view->camera.middle = middle;
    uint32_t rank = 1;
    for (uint32_t i = 0; i < layer->cells; i++) {
        const double cost = cost_of(layer, i);
        rank += cost > cost_of(layer, mark) || (cost == cost_of(layer, mark) && i < mark);
    }
    char cost[32], bytes[32], share[SL_COUNT_TEXT];
    const uint32_t number = layer->numbers[mark];
    write_cost(cost_of(layer, mark), cost);
    write_bytes(layer->history.hierarchy.bytes[number], bytes);
    sl_text_percent(layer->history.hierarchy.mass[number], share);
    ui_say(view->ui, false,
           "%u of %u view cells by cost: %s walls to render, for %s of the viewpoints; its set "
           "takes %s",
           rank, layer->cells, cost, share, bytes);
}

// --- drawing

static int step_of(const view_layer *layer, double cost) {
    return ramp_step(cost, layer->least, layer->most);
}

/// Cells of one colour make one path. A thin stroke covers the seams between them.
static void draw_cells(const view_state *view, cairo_t *cairo, const sl_frame *frame) {
    const view_layer *layer = view->views;
    const sl_view_tree *tree = &layer->history.tree;
    for (int step = 0; step < RAMP_STEPS; step++) {
        for (uint32_t i = 0; i < tree->cell_count; i++)
            if (step_of(layer, cost_of(layer, layer->view_cells[i])) == step)
                sl_path_polygon(cairo, frame, tree->corners + tree->first[i],
                                tree->first[i + 1] - tree->first[i]);
        sl_set_colour(cairo, ramp_colour(view->ui, RAMP_AREAS, step));
        cairo_fill_preserve(cairo);
        cairo_set_line_width(cairo, 0.6);
        cairo_stroke(cairo);
    }
}

static void add_borders(cairo_t *cairo, const sl_frame *frame, const sl_segment *borders,
                        size_t count) {
    cairo_new_path(cairo);
    for (size_t i = 0; i < count; i++) sl_path_segment(cairo, frame, borders[i].a, borders[i].b);
}

void view_layer_draw(const view_state *view, cairo_t *cairo, const sl_frame *frame) {
    const view_layer *layer = view->views;
    if (!view_layer_shown(layer)) return;
    const sl_palette *palette = &view->ui->palette;
    cairo_save(cairo);
    layers_clip_inside(view->document, cairo, frame);
    if (layers_fill(view) == LAYER_VIEWS) draw_cells(view, cairo, frame);
    add_borders(cairo, frame, layer->borders, layer->border_count);
    tone_cased(cairo, palette, palette->wall, 0.9 * frame->unit, 0);
    add_borders(cairo, frame, layer->mark_borders, layer->mark_border_count);
    tone_cased(cairo, palette, palette->start, 4 * frame->unit, 0);
    cairo_restore(cairo);
}

/// Writes the cost of the view cell under the pointer; a dash where there is none.
static void write_pointed(const view_state *view, char *text, size_t room) {
    const sl_view_tree *tree = &view->views->history.tree;
    sl_point at;
    const bool over = view_pointed(view, &at);
    const uint32_t leaf = sl_view_tree_locate(tree, at);
    char cost[32];
    snprintf(text, room, "\xe2\x80\x93");
    if (!over || leaf >= tree->cell_count) return;
    write_cost(cost_of(view->views, view->views->view_cells[leaf]), cost);
    snprintf(text, room, "%s walls", cost);
}

bool view_layer_key(const view_state *view, legend_key *key) {
    const view_layer *layer = view->views;
    if (!view_layer_shown(layer) || !layers_shows(view, LAYER_VIEWS)) return false;
    const uint32_t most = view_layer_most(layer);
    char text[96], cost[32];
    *key = (legend_key){.ramp = layers_fill(view) == LAYER_VIEWS ? RAMP_AREAS : RAMP_NONE};
    snprintf(text, sizeof text, "%u of %u", layer->cells, most);
    legend_key_add(key, "view cells", text);
    write_cost(layer->costs[layer->cells - 1], cost);
    snprintf(text, sizeof text, "%s walls", cost);
    legend_key_add(key, "expected cost", text);
    snprintf(text, sizeof text, "%.2f", layer->costs[layer->cells - 1] / layer->costs[most - 1]);
    legend_key_add(key, "times the least", text);
    write_bytes(layer->bytes[layer->cells - 1], cost);
    legend_key_add(key, "memory of visible sets", cost);
    write_pointed(view, text, sizeof text);
    legend_key_add(key, "under the pointer", text);
    write_cost(layer->least, key->least);
    write_cost(layer->most, key->most);
    return true;
}
