/// What layers draw below the walls: sets of cells, regions, the stab tree.
#include "plan/layer_draw.h"

#include "plan/heat.h"
#include "sightline/support.h"

#include <math.h>

static void draw_pvs(view_state *view, const sl_frame *frame, int index) {
    const bool fills = layers_fill(view) == LAYER_PVS;
    (void)index;
    layers_draw_set(view, frame, view->seen.pvs, NULL, TONE_SET, fills);
    layers_draw_set(view, frame, view->seen.mirrored, view->seen.pvs, TONE_SET_MIRRORED, fills);
}

static void draw_region(view_state *view, const sl_frame *frame, int index) {
    const sl_mirrored_region *mirrors = &view->seen.in_mirrors;
    const bool fills = layers_fill(view) == LAYER_REGION;
    (void)index;
    for (size_t i = mirrors->part_count; i-- > 0;)
        layers_draw_region(view, frame, &mirrors->parts[i].region, TONE_REGION_MIRRORED, fills);
    layers_draw_region(view, frame, &view->seen.region, TONE_REGION, fills);
}

// --- culling

/// The two methods that are compared, by guarantee.
static void pair_of(const view_state *view, size_t *loose, size_t *tight) {
    const size_t one = view->method, other = view->other;
    *loose = one < other ? one : other;
    *tight = one < other ? other : one;
}

/// The cells that the chosen method keeps; and those that looser ones keep beside them.
static void draw_cull(view_state *view, const sl_frame *frame, int index) {
    const seen_state *seen = &view->seen;
    const bool fills = layers_fill(view) == LAYER_CULL;
    size_t loose, tight;
    pair_of(view, &loose, &tight);
    if (view->compare == COMPARE_DIFFERENCE) {
        layers_draw_set(view, frame, seen->methods[tight].cells, NULL, TONE_KEPT, fills);
        layers_draw_set(view, frame, seen->methods[loose].cells, seen->methods[tight].cells,
                        TONE_ADDED, fills);
        return;
    }
    const size_t last = index ? view->other : view->method;
    layers_draw_set(view, frame, seen->methods[last].mirrored, seen->methods[last].cells,
                    TONE_KEPT_MIRRORED, fills);
    for (size_t i = 0; i < last && fills && view->compare == COMPARE_OFF; i++)
        if (seen->methods[i].known)
            layers_draw_set(view, frame, seen->methods[i].cells, seen->methods[i + 1].cells,
                            layers_method_tone(i, last), true);
    layers_draw_set(view, frame, seen->methods[last].cells, NULL, TONE_KEPT, fills);
}

// --- the stab tree

/// Where doors are shut, the tree has no sequences through them.
static sl_status make_tree_scene(view_state *view, const sl_draw_options *options) {
    const document_state *document = view->document;
    sl_stab_trees trees;
    if (!present_has_shut(&view->present))
        return sl_scene_create(view->context, document->baked, options, NULL, &view->tree);
    SL_TRY(present_tree(view->context, &view->present, document, options->cell, &trees));
    const sl_status status =
        sl_scene_create(view->context, document->baked, options, &trees, &view->tree);
    sl_free(view->context, trees.offsets);
    sl_free(view->context, trees.nodes);
    return status;
}

static bool make_tree(view_state *view) {
    const uint32_t cell = view->seen.cell;
    if (cell == SL_NO_CELL || !document_has_rows(view->document)) return false;
    if (view->tree && view->tree_version == view->present.version && view->tree_cell == cell &&
        view->tree_dark == view->ui->dark)
        return true;
    sl_scene_destroy(view->context, view->tree);
    view->tree = NULL;
    sl_draw_options options = sl_draw_options_default();
    options.layers = SL_LAYER_STAB_TREE;
    options.cell = cell;
    options.dark = view->ui->dark;
    const sl_status status = make_tree_scene(view, &options);
    view_check(view, status);
    view->tree_version = view->present.version;
    view->tree_cell = cell;
    view->tree_dark = view->ui->dark;
    return status == SL_OK;
}

static void draw_tree(view_state *view, const sl_frame *frame, int index) {
    (void)index;
    if (make_tree(view))
        sl_draw_tree(view->ui->cairo, view->tree, view->eye.at, view->tree_depth, frame);
}

// --- all

/// What each draws below the walls in each frame; `index` tells which of the plans side by side.
/// NULL for layers that do not change with the eye: they go into the kept picture (pane_plan.c).
static void (*const draws[LAYER_COUNT])(view_state *view, const sl_frame *frame, int index) = {
    [LAYER_HEAT] = layer_heat,    [LAYER_PVS] = draw_pvs,   [LAYER_CULL] = draw_cull,
    [LAYER_REGION] = draw_region, [LAYER_TREE] = draw_tree, [LAYER_NODES] = layer_nodes,
    [LAYER_WATCH] = layer_watch};

/// What fills comes first: lines stay on top.
void layers_draw(view_state *view, const sl_frame *frame, int index) {
    const unsigned about_cell = SHOW_PVS | SHOW_CULL | SHOW_TREE;
    unsigned drawn = 0;
    if (!view->seen.valid) return;
    const unsigned fill = layers_fill(view);
    for (int pass = 0; pass < 2; pass++)
        for (unsigned i = 0; i < LAYER_COUNT; i++) {
            if (!draws[i] || !layers_shows(view, i) || (i == fill) != (pass == 0)) continue;
            draws[i](view, frame, index);
            drawn |= 1u << i;
        }
    if (view->seen.cell != SL_NO_CELL && drawn & about_cell)
        sl_draw_cell(view->ui->cairo, &view->document->baked->space, frame, view->seen.cell,
                     view->ui->palette.source_edge, 0, 2.4 * frame->unit);
}
