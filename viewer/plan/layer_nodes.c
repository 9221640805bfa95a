/// The nodes of the hierarchy as a walk without visible sets classifies them, frame by frame, as in
/// Bittner and Havran 2002, Figure 12.
#include "plan/layers.h"

#include "sightline/draw.h"
#include "sightline/support.h"
#include "sightline/walk.h"

#include <stdio.h>
#include <string.h>

typedef enum kind { OUT, INVISIBLE, PROPAGATED, VISIBLE, PARTIAL, KINDS } kind;

static const tone tones[KINDS] = {
    [OUT] = TONE_NODE_OUT,
    [INVISIBLE] = TONE_NODE_INVISIBLE,
    [PROPAGATED] = TONE_NODE_PROPAGATED,
    [VISIBLE] = TONE_NODE_VISIBLE,
    [PARTIAL] = TONE_NODE_PARTIAL,
};

struct node_layer {
    uint32_t version; ///< of what is present that it is of
    sl_hierarchy hierarchy;
    sl_walk *walk;
    sl_view view;
    bool stepped;
    sl_walk_frame frame;
    sl_bits *sets[KINDS]; ///< cells
    uint32_t counts[KINDS];
};

void node_layer_destroy(sl_context *context, node_layer *layer) {
    if (!layer) return;
    sl_walk_destroy(context, layer->walk);
    sl_hierarchy_destroy(context, &layer->hierarchy);
    for (int k = 0; k < KINDS; k++) sl_free(context, layer->sets[k]);
    sl_free(context, layer);
}

static const sl_walk_method *find_method(const char *name) {
    size_t count, i = 0;
    const sl_walk_method *methods = sl_walk_methods(&count);
    while (i + 1 < count && strcmp(methods[i].name, name) != 0) i++;
    return &methods[i];
}

static sl_status fill_layer(sl_context *context, present_state *present, node_layer *layer) {
    SL_TRY(present_space(context, present));
    const sl_space *space = present->space;
    const sl_walk_options options = sl_walk_options_default();
    layer->version = present->version;
    for (int k = 0; k < KINDS; k++) {
        layer->sets[k] =
            sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof *layer->sets[k]);
        if (!layer->sets[k]) return SL_NO_MEMORY;
    }
    SL_TRY(sl_hierarchy_make(context, space, &layer->hierarchy));
    return sl_walk_create(context, &layer->hierarchy, find_method("propagation"), &options,
                          &layer->walk);
}

/// Makes the layer for the present space, if it is not there.
static sl_status prepare_layer(view_state *view) {
    if (view->nodes && view->nodes->version == view->present.version) return SL_OK;
    node_layer_destroy(view->context, view->nodes);
    view->nodes = NULL;
    node_layer *layer = sl_alloc_array(view->context, 1, sizeof *layer);
    if (!layer) return SL_NO_MEMORY;
    const sl_status status = fill_layer(view->context, &view->present, layer);
    if (status == SL_OK)
        view->nodes = layer;
    else
        node_layer_destroy(view->context, layer);
    return status;
}

static kind kind_of(sl_node_state state, sl_walk_reason reason) {
    if (state == SL_NODE_PARTIAL) return PARTIAL;
    if (state == SL_NODE_VISIBLE) return VISIBLE;
    return reason == SL_WALK_FRUSTUM ? OUT : reason == SL_WALK_PROPAGATED ? PROPAGATED : INVISIBLE;
}

static void sort_cells(node_layer *layer) {
    const sl_hierarchy *h = &layer->hierarchy;
    for (int k = 0; k < KINDS; k++) {
        memset(layer->sets[k], 0, sl_bits_words(h->space->cell_count) * sizeof *layer->sets[k]);
        layer->counts[k] = 0;
    }
    for (uint32_t i = 0; i < h->node_count; i++) {
        sl_walk_reason reason;
        if (h->nodes[i].cell == SL_NO_CELL) continue;
        const sl_node_state state = sl_walk_state(layer->walk, i, &reason);
        const kind k = kind_of(state, reason);
        sl_bits_add(layer->sets[k], h->nodes[i].cell);
        layer->counts[k]++;
    }
}

/// Walks one frame if the eye moved since the last one.
static sl_status step_walk(view_state *view) {
    SL_TRY(prepare_layer(view));
    node_layer *layer = view->nodes;
    if (layer->stepped && seen_same_view(&layer->view, &view->seen.view)) return SL_OK;
    SL_TRY(sl_walk_step(view->context, layer->walk, &view->seen.view, &layer->frame));
    layer->view = view->seen.view;
    layer->stepped = true;
    sort_cells(layer);
    return SL_OK;
}

int layer_nodes_legend(const view_state *view, legend_row *rows) {
    const node_layer *layer = view->nodes;
    const bool fills = layers_fill(view) == LAYER_NODES;
    int at = 0;
    if (!layer || !layer->stepped) return 0;
    for (int k = fills ? 0 : VISIBLE; k < KINDS; k++, at++) {
        rows[at] = (legend_row){.label = tone_table()[tones[k]].label,
                                .mark = fills ? LEGEND_AREA : LEGEND_LINE,
                                .which = tones[k]};
        snprintf(rows[at].value, sizeof rows[at].value, "%u", layer->counts[k]);
    }
    return at;
}

const char *layer_nodes_words(const view_state *view, char text[96]) {
    const node_layer *layer = view->nodes;
    if (!layer || !layer->stepped || !layers_shows(view, LAYER_NODES)) return NULL;
    const sl_walk_frame *f = &layer->frame;
    snprintf(text, 96, "Nodes: %u tests for %u, %u occluders.", f->tests, f->visited, f->occluders);
    return text;
}

void layer_nodes(view_state *view, const sl_frame *frame, int index) {
    const sl_status status = step_walk(view);
    const bool fills = layers_fill(view) == LAYER_NODES;
    (void)index;
    view_check(view, status);
    if (status != SL_OK) return;
    // Lines go round what is visible: the rest has all of the map in it.
    for (int k = fills ? 0 : VISIBLE; k < KINDS; k++)
        layers_draw_set(view, frame, view->nodes->sets[k], NULL, tones[k], fills);
}
