/// The table of layers and what each draws: sets of cells, regions, portals, the stab tree.
#include "plan/layers.h"

#include "app/modes.h"
#include "sightline/draw.h"
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

unsigned layers_fill(const app_state *app) {
    unsigned last = LAYER_COUNT;
    for (unsigned i = 0; i < LAYER_COUNT; i++)
        if (SHOW_FILLS >> i & 1 && layers_shows(app, i) &&
            (last == LAYER_COUNT || app->view.filled[i] >= app->view.filled[last]))
            last = i;
    return last;
}

void layers_set_fill(app_state *app, unsigned layer) {
    if (layer < LAYER_COUNT) app->view.filled[layer] = ++app->view.last_filled;
}

void layers_clip_inside(const document_state *document, cairo_t *cairo, const sl_frame *frame) {
    const sl_space *space = &document->baked->space;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *c = &space->cells[i];
        if (c->inside)
            sl_path_polygon(cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    }
    cairo_clip(cairo);
}

/// What fills comes first: lines stay on top.
void layers_draw(app_state *app, const sl_frame *frame, int index) {
    const unsigned about_cell = SHOW_PVS | SHOW_CULL | SHOW_TREE;
    unsigned drawn = 0;
    if (!app->view.seen.valid) return;
    const unsigned fill = layers_fill(app);
    for (int pass = 0; pass < 2; pass++)
        for (unsigned i = 0; i < LAYER_COUNT; i++) {
            if (!rows[i].draw || !layers_shows(app, i) || (i == fill) != (pass == 0)) continue;
            rows[i].draw(app, frame, index);
            drawn |= 1u << i;
        }
    if (app->view.seen.cell != SL_NO_CELL && drawn & about_cell)
        sl_draw_cell(app->ui.cairo, &app->document.baked->space, frame, app->view.seen.cell,
                     app->ui.palette.source_edge, 0, 2.4 * frame->unit);
}

// --- sets of cells

static bool in_set(const uint64_t *cells, const uint64_t *without, uint32_t cell) {
    return cells[cell / 64] >> (cell % 64) & 1 &&
           !(without && without[cell / 64] >> (cell % 64) & 1);
}

/// Where on the side from a to b a point lies, from 0 to 1; NAN: beside it.
static double place_on(sl_point a, sl_point b, sl_point p) {
    const double x = b.x - a.x, y = b.y - a.y, length = x * x + y * y;
    const double off = x * (p.y - a.y) - y * (p.x - a.x);
    return fabs(off) <= 1e-9 * length ? ((p.x - a.x) * x + (p.y - a.y) * y) / length : NAN;
}

/// Adds a side of a cell but for its portals to other cells of the set.
static void add_side(app_state *app, const sl_frame *frame, const uint64_t *cells,
                     const uint64_t *without, const sl_cell *c, sl_point a, sl_point b) {
    const sl_space *space = &app->document.baked->space;
    double at = 0;
    while (at < 1) {
        // The next portal from here on.
        double from = 1, to = 1;
        for (uint32_t i = 0; i < c->directed_count; i++) {
            const sl_directed_portal *d = &space->directed[c->first_directed + i];
            const double u = place_on(a, b, d->left), v = place_on(a, b, d->right);
            if (!in_set(cells, without, d->cell) || isnan(u) || isnan(v)) continue;
            if (fmax(u, v) > at + 1e-9 && fmin(u, v) < from) {
                from = fmin(u, v);
                to = fmax(u, v);
            }
        }
        if (from > at + 1e-9) {
            const double end = fmin(from, 1);
            sl_path_segment(app->ui.cairo, frame,
                            (sl_point){a.x + (b.x - a.x) * at, a.y + (b.y - a.y) * at},
                            (sl_point){a.x + (b.x - a.x) * end, a.y + (b.y - a.y) * end});
        }
        at = fmax(to, at + 1e-9);
    }
}

/// Adds the border of the set: sides of its cells that no other cell of it is behind.
static void add_border(app_state *app, const sl_frame *frame, const uint64_t *cells,
                       const uint64_t *without) {
    const sl_space *space = &app->document.baked->space;
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (!in_set(cells, without, cell)) continue;
        for (uint32_t i = 0; i < c->vertex_count; i++)
            add_side(app, frame, cells, without, c, space->vertices[c->first_vertex + i],
                     space->vertices[c->first_vertex + (i + 1) % c->vertex_count]);
    }
}

void layers_draw_portals(const app_state *app, cairo_t *cairo, const sl_frame *frame,
                         const uint64_t *cells, const uint64_t *without) {
    const sl_space *space = &app->document.baked->space;
    const sl_palette *palette = &app->ui.palette;
    cairo_new_path(cairo);
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (cells && !in_set(cells, without, cell)) continue;
        for (uint32_t i = 0; i < c->directed_count; i++) {
            const sl_directed_portal *d = &space->directed[c->first_directed + i];
            const bool twice = d->cell < cell && (!cells || in_set(cells, without, d->cell));
            if (!twice) sl_path_segment(cairo, frame, d->left, d->right);
        }
    }
    cairo_save(cairo);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_FAST);
    tone_cased(cairo, palette, palette->portal, 1.4 * frame->unit, 3);
    cairo_restore(cairo);
}

/// Patterns are fixed to the map.
static sl_point origin_of(const sl_frame *frame) {
    return sl_frame_point(frame, (sl_point){0, 0});
}

void layers_draw_set(app_state *app, const sl_frame *frame, const uint64_t *cells,
                     const uint64_t *without, tone which, bool fills) {
    const sl_space *space = &app->document.baked->space;
    cairo_t *cairo = app->ui.cairo;
    cairo_new_path(cairo);
    if (!fills) {
        cairo_save(cairo);
        cairo_set_antialias(cairo, CAIRO_ANTIALIAS_FAST);
        add_border(app, frame, cells, without);
        // Wider than walls: it shows on both sides of them.
        tone_line(cairo, &app->ui.palette, which, 6 * frame->unit);
        cairo_restore(cairo);
        return;
    }
    for (uint32_t cell = 0; cell < space->cell_count; cell++) {
        const sl_cell *c = &space->cells[cell];
        if (in_set(cells, without, cell))
            sl_path_polygon(cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    }
    tone_fill(cairo, app->ui.dark, which, frame->unit, origin_of(frame));
    const bool solid = tone_table()[which].pattern == PATTERN_SOLID;
    if (solid && layers_shows(app, LAYER_PORTALS))
        layers_draw_portals(app, cairo, frame, cells, without);
}

void layers_draw_cell(app_state *app, const sl_frame *frame, uint32_t cell, tone which) {
    const sl_space *space = &app->document.baked->space;
    const sl_cell *c = &space->cells[cell];
    cairo_new_path(app->ui.cairo);
    sl_path_polygon(app->ui.cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    tone_fill(app->ui.cairo, app->ui.dark, which, frame->unit, origin_of(frame));
    sl_draw_cell(app->ui.cairo, space, frame, cell, tone_colour(app->ui.dark, which), 0,
                 2 * frame->unit);
}

void layer_pvs(app_state *app, const sl_frame *frame, int index) {
    const bool fills = layers_fill(app) == LAYER_PVS;
    (void)index;
    layers_draw_set(app, frame, app->view.seen.pvs, NULL, TONE_SET, fills);
    layers_draw_set(app, frame, app->view.seen.mirrored, app->view.seen.pvs, TONE_SET_MIRRORED,
                    fills);
}

// --- regions

/// Arcs are as fine as the eye can tell.
void layers_draw_region(app_state *app, const sl_frame *frame, const sl_region *region, tone which,
                        bool fills) {
    cairo_t *cairo = app->ui.cairo;
    const double tolerance = fmax(0.2 / frame->scale, 1e-5 * region->range);
    const size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    sl_point *points = sl_alloc_array(app->context, count, sizeof *points);
    if (!points) return;
    sl_region_flatten(region, tolerance, points, count);
    cairo_new_path(cairo);
    if (count >= 3) {
        sl_path_polygon(cairo, frame, points, count);
        if (fills)
            tone_fill(cairo, app->ui.dark, which, frame->unit, origin_of(frame));
        else
            tone_line(cairo, &app->ui.palette, which, 2.2 * frame->unit);
    }
    sl_free(app->context, points);
}

void layer_region(app_state *app, const sl_frame *frame, int index) {
    const sl_mirrored_region *mirrors = &app->view.seen.in_mirrors;
    const bool fills = layers_fill(app) == LAYER_REGION;
    (void)index;
    for (size_t i = mirrors->part_count; i-- > 0;)
        layers_draw_region(app, frame, &mirrors->parts[i].region, TONE_REGION_MIRRORED, fills);
    layers_draw_region(app, frame, &app->view.seen.region, TONE_REGION, fills);
}

// --- culling

tone layers_method_tone(size_t method, size_t chosen) {
    return method == chosen ? TONE_KEPT : (tone)(TONE_LOOSER + method % 4);
}

/// The two methods that are compared, by guarantee.
static void pair_of(const app_state *app, size_t *loose, size_t *tight) {
    const size_t one = app->view.method, other = app->view.other;
    *loose = one < other ? one : other;
    *tight = one < other ? other : one;
}

/// The cells that the chosen method keeps; and those that looser ones keep beside them.
void layer_cull(app_state *app, const sl_frame *frame, int index) {
    const seen_state *seen = &app->view.seen;
    const bool fills = layers_fill(app) == LAYER_CULL;
    size_t loose, tight;
    pair_of(app, &loose, &tight);
    if (app->view.compare == COMPARE_DIFFERENCE) {
        layers_draw_set(app, frame, seen->methods[tight].cells, NULL, TONE_KEPT, fills);
        layers_draw_set(app, frame, seen->methods[loose].cells, seen->methods[tight].cells,
                        TONE_ADDED, fills);
        return;
    }
    const size_t last = index ? app->view.other : app->view.method;
    layers_draw_set(app, frame, seen->methods[last].mirrored, seen->methods[last].cells,
                    TONE_KEPT_MIRRORED, fills);
    for (size_t i = 0; i < last && fills && app->view.compare == COMPARE_OFF; i++)
        if (seen->methods[i].known)
            layers_draw_set(app, frame, seen->methods[i].cells, seen->methods[i + 1].cells,
                            layers_method_tone(i, last), true);
    layers_draw_set(app, frame, seen->methods[last].cells, NULL, TONE_KEPT, fills);
}

// --- the stab tree

/// Where doors are shut, the tree has no sequences through them.
static sl_status make_tree_scene(app_state *app, const sl_draw_options *options) {
    const document_state *document = &app->document;
    sl_stab_trees trees;
    if (!present_has_shut(&app->view.present))
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
