#include "layers.h"

#include "modes.h"
#include "sightline/canvas.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

#define ROW(NAME, name, key, label, help, modes, calls, draw) {name, modes, calls, draw},
static const layer_row rows[] = {LAYERS(ROW)};
#undef ROW

const layer_row *layer_table(void) {
    return rows;
}

bool layers_lists(const app_state *app, unsigned layer) {
    const unsigned calls = rows[layer].calls;
    const sl_baked *baked = app->document.baked;
    if (layer == LAYER_SPLITS && baked && !baked->space.node_count) return false;
    return rows[layer].modes >> app->tool.mode & 1 &&
           (!calls || calls & sl_plan_make(&app->document.map).effects);
}

bool layers_shows(const app_state *app, unsigned layer) {
    return app->view.show >> layer & 1 && layers_lists(app, layer);
}

void layers_draw_key(ui_state *ui, const sl_frame *frame, const legend_row *key, int count,
                     const char *line) {
    const double t = ui->text, left = frame->left + t, row = 1.5 * t;
    const int lines = count + (line != NULL);
    const double bottom = frame->top + frame->height - t, top = bottom - lines * row - 0.6 * t;
    ui_fill_round(ui, (sl_box){{left, top}, {left + 19 * t, bottom}}, 0.3 * t, ui->palette.page);
    for (int i = 0; i < count; i++) {
        char text[16];
        const double base = top + 0.3 * t + (i + 0.8) * row;
        ui_fill_round(ui,
                      (sl_box){{left + 0.6 * t, base - 0.8 * t}, {left + 1.6 * t, base + 0.1 * t}},
                      0.15 * t, sl_colour_mix(ui->palette.floor[0], key[i].colour, key[i].opacity));
        ui_text(ui, left + 2.1 * t, base, 0.95, false, ui->palette.ink, key[i].label);
        snprintf(text, sizeof text, "%u", key[i].count);
        ui_text_right(ui, left + 18.4 * t, base, 0.95, ui->palette.ink, text);
    }
    if (line)
        ui_text(ui, left + 0.6 * t, top + 0.3 * t + (count + 0.8) * row, 0.95, false,
                ui->palette.faint, line);
}

void layers_draw_keys(app_state *app, const sl_frame *frame) {
    if (app->view.seen.valid && layers_shows(app, LAYER_NODES)) layer_nodes_key(app, frame);
    if (app->view.seen.valid && layers_shows(app, LAYER_WATCH)) layer_watch_key(app, frame);
    if (app->view.seen.valid && layers_shows(app, LAYER_VIEWS)) view_layer_draw_key(app, frame);
}

void layers_draw(app_state *app, const sl_frame *frame, int index) {
    const unsigned about_cell = SHOW_PVS | SHOW_CULL | SHOW_TREE;
    unsigned drawn = 0;
    if (!app->view.seen.valid) return;
    for (unsigned i = 0; i < LAYER_COUNT; i++) {
        if (!rows[i].draw || !layers_shows(app, i)) continue;
        rows[i].draw(app, frame, index);
        drawn |= 1u << i;
    }
    if (app->view.seen.cell != SL_NO_CELL && drawn & about_cell)
        sl_draw_cell(app->ui.cairo, &app->document.baked->space, frame, app->view.seen.cell,
                     app->ui.palette.source_edge, 0, 2.4 * frame->unit);
}

void layer_pvs(app_state *app, const sl_frame *frame, int index) {
    (void)index;
    sl_draw_cell_set(app->ui.cairo, &app->document.baked->space, frame, app->view.seen.pvs, NULL,
                     app->ui.palette.seen[0], 0.8);
    sl_draw_cell_set(app->ui.cairo, &app->document.baked->space, frame, app->view.seen.mirrored,
                     app->view.seen.pvs, app->ui.palette.mirrored, 0.3);
}

/// Draws a region as a polygon; arcs are as fine as the eye can tell. `depth` is the number of
/// mirrors in which the part is seen, 0 for none.
static void draw_region(app_state *app, const sl_frame *frame, const sl_region *region,
                        uint32_t depth, sl_colour colour) {
    const double tolerance = fmax(0.2 / frame->scale, 1e-5 * region->range);
    const size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    sl_region flat = {.points = sl_alloc_array(app->context, count, sizeof *flat.points),
                      .count = count};
    if (!flat.points) return;
    sl_region_flatten(region, tolerance, flat.points, count);
    const sl_drawn_region part = {region->view.eye, flat.points, count, depth};
    if (depth)
        sl_draw_seen(app->ui.cairo, &app->ui.palette, frame, &part);
    else
        sl_draw_region(app->ui.cairo, frame, &flat, colour);
    sl_free(app->context, flat.points);
}

void layers_draw_region(app_state *app, const sl_frame *frame, const sl_region *region,
                        sl_colour colour) {
    draw_region(app, frame, region, 0, colour);
}

void layer_region(app_state *app, const sl_frame *frame, int index) {
    const sl_mirrored_region *mirrors = &app->view.seen.in_mirrors;
    (void)index;
    for (size_t i = mirrors->part_count; i-- > 0;)
        draw_region(app, frame, &mirrors->parts[i].region, mirrors->parts[i].depth,
                    app->ui.palette.mirrored);
    layers_draw_region(app, frame, &app->view.seen.region, app->ui.palette.source);
}

// --- culling

sl_colour pane_method_colour(const ui_state *ui, size_t method) {
    size_t count;
    sl_eye_methods(&count);
    const double share = count > 1 ? (double)method / (double)(count - 1) : 1;
    return sl_palette_ramp(ui->dark, 0.10 + 0.66 * share);
}

/// All methods up to the chosen one. A cell has the colour of the last method that keeps it.
void layer_cull(app_state *app, const sl_frame *frame, int index) {
    const sl_space *space = &app->document.baked->space;
    cairo_t *cairo = app->ui.cairo;
    const seen_state *seen = &app->view.seen;
    if (app->view.compare == COMPARE_DIFFERENCE) {
        const bool other_is_loose = app->view.other < app->view.method;
        const size_t loose = other_is_loose ? app->view.other : app->view.method;
        const size_t tight = other_is_loose ? app->view.method : app->view.other;
        sl_draw_cell_set(cairo, space, frame, seen->methods[tight].cells, NULL,
                         pane_method_colour(&app->ui, tight), 0.75);
        sl_draw_cell_set(cairo, space, frame, seen->methods[loose].cells,
                         seen->methods[tight].cells, app->ui.palette.start, 0.6);
        return;
    }
    const size_t last = index ? app->view.other : app->view.method;
    if (app->view.compare == COMPARE_PANES) {
        sl_draw_cell_set(cairo, space, frame, seen->methods[last].cells, NULL,
                         pane_method_colour(&app->ui, last), 0.8);
        return;
    }
    sl_draw_cell_set(cairo, space, frame, seen->methods[last].mirrored, seen->methods[last].cells,
                     app->ui.palette.mirrored, 0.3);
    for (size_t i = 0; i <= last; i++)
        if (seen->methods[i].known || i == last)
            sl_draw_cell_set(cairo, space, frame, seen->methods[i].cells,
                             i < last ? seen->methods[i + 1].cells : NULL,
                             pane_method_colour(&app->ui, i), 0.8);
}

// --- the stab tree

/// Where doors are shut, the tree has no sequences through them.
static sl_status make_tree_scene(app_state *app, const sl_draw_options *options) {
    const document_state *document = &app->document;
    sl_stab_trees trees;
    if (!app->view.present.own)
        return sl_scene_create(app->context, document->baked, options, NULL, &app->view.tree);
    SL_TRY(present_tree(app->context, &app->view.present, document, options->cell, &trees));
    const sl_status status =
        sl_scene_create(app->context, document->baked, options, &trees, &app->view.tree);
    sl_free(app->context, trees.offsets);
    sl_free(app->context, trees.nodes);
    return status;
}

static bool make_tree(app_state *app) {
    const uint32_t cell = app->view.seen.cell;
    if (cell == SL_NO_CELL || !document_has_rows(&app->document)) return false;
    if (app->view.tree && app->view.tree_version == app->view.present.version &&
        app->view.tree_cell == cell && app->view.tree_dark == app->ui.dark)
        return true;
    sl_scene_destroy(app->context, app->view.tree);
    app->view.tree = NULL;
    sl_draw_options options = sl_draw_options_default();
    options.layers = SL_LAYER_STAB_TREE;
    options.cell = cell;
    options.dark = app->ui.dark;
    const sl_status status = make_tree_scene(app, &options);
    app_check(app, status);
    app->view.tree_version = app->view.present.version;
    app->view.tree_cell = cell;
    app->view.tree_dark = app->ui.dark;
    return status == SL_OK;
}

void layer_tree(app_state *app, const sl_frame *frame, int index) {
    (void)index;
    if (make_tree(app))
        sl_draw_tree(app->ui.cairo, app->view.tree, app->view.eye.at, app->view.tree_depth, frame);
}
