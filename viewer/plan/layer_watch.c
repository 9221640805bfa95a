/// Who sees the eye. Cells are coloured by who sees whom, and the region shows from where the eye
/// is seen. A line of sight is the same in both directions except for one-way glass. So this region
/// is what an eye would see with all glass turned round: without glass, the query looks forwards.
#include "plan/layers.h"

#include "sightline/draw.h"
#include "sightline/support.h"

#include <stdio.h>
#include <string.h>

typedef enum kind { SEES, MUTUAL, SEEN, KINDS } kind;

struct watch_layer {
    uint32_t version; ///< of what is present that it is of
    present_state present;
    sl_point eye;
    double range;
    bool made;
    sl_region region;
    sl_bits *sets[KINDS]; ///< cells
    size_t words;
    uint32_t counts[KINDS];
};

static void free_sets(sl_context *context, watch_layer *layer) {
    for (int k = 0; k < KINDS; k++) {
        sl_free(context, layer->sets[k]);
        layer->sets[k] = NULL;
    }
}

void watch_layer_destroy(sl_context *context, watch_layer *layer) {
    if (!layer) return;
    present_drop(context, &layer->present);
    sl_region_destroy(context, &layer->region);
    free_sets(context, layer);
    sl_free(context, layer);
}

static sl_status make_sets(sl_context *context, watch_layer *layer, const sl_space *space) {
    free_sets(context, layer);
    layer->words = sl_bits_words(space->cell_count);
    for (int k = 0; k < KINDS; k++) {
        layer->sets[k] = sl_alloc_array(context, layer->words, sizeof *layer->sets[k]);
        if (!layer->sets[k]) return SL_NO_MEMORY;
    }
    return SL_OK;
}

static void sort_cells(const view_state *view, watch_layer *layer) {
    const uint32_t eye = view->seen.cell;
    memset(layer->counts, 0, sizeof layer->counts);
    if (eye == SL_NO_CELL || !view->present.has_rows) return;
    for (uint32_t cell = 0; cell < view->document->baked->space.cell_count; cell++) {
        const bool sees = sl_bits_has(view->seen.pvs, cell);
        const bool seen = present_sees(view->context, &view->present, cell, eye);
        if (cell == eye || !(sees || seen)) continue;
        const kind k = sees && seen ? MUTUAL : sees ? SEES : SEEN;
        sl_bits_add(layer->sets[k], cell);
        layer->counts[k]++;
    }
}

static sl_status make_layer(view_state *view, watch_layer *layer) {
    sl_context *context = view->context;
    const sl_view all_round = sl_view_all_round(view->eye.at);
    const bool turns = view->document->baked->map.oneway_count;
    if (turns) SL_TRY(present_update(context, &layer->present, view->document, view->eye.at));
    SL_TRY(make_sets(context, layer, &view->document->baked->space));
    sort_cells(view, layer);
    sl_query *query = turns ? layer->present.query : view->present.query;
    SL_TRY(sl_query_region(context, query, &all_round, &layer->region));
    layer->version = view->present.version;
    layer->eye = view->eye.at;
    layer->range = view->document->map.range;
    layer->made = true;
    return SL_OK;
}

static sl_status follow_eye(view_state *view) {
    if (!view->watch) {
        view->watch = sl_alloc_array(view->context, 1, sizeof *view->watch);
        if (!view->watch) return SL_NO_MEMORY;
        view->watch->present.backwards = true;
    }
    watch_layer *layer = view->watch;
    if (layer->made && layer->version == view->present.version && layer->eye.x == view->eye.at.x &&
        layer->eye.y == view->eye.at.y && layer->range == view->document->map.range)
        return SL_OK;
    layer->made = false;
    return make_layer(view, layer);
}

static const tone tones[KINDS] = {
    [SEES] = TONE_WATCH_SEES, [MUTUAL] = TONE_WATCH_MUTUAL, [SEEN] = TONE_WATCH_SEEN};

void layer_watch(view_state *view, const sl_frame *frame, int index) {
    const bool fills = layers_fill(view) == LAYER_WATCH;
    (void)index;
    const sl_status status = follow_eye(view);
    view_check(view, status);
    if (status != SL_OK) return;
    for (kind k = 0; k < KINDS; k++)
        layers_draw_set(view, frame, view->watch->sets[k], NULL, tones[k], fills);
    layers_draw_region(view, frame, &view->watch->region, TONE_WATCH_SEEN, false);
}

int layer_watch_legend(const view_state *view, legend_row *rows) {
    const watch_layer *layer = view->watch;
    const bool fills = layers_fill(view) == LAYER_WATCH;
    if (!layer || !layer->made) return 0;
    for (kind k = 0; k < KINDS; k++) {
        rows[k] = (legend_row){.label = tone_table()[tones[k]].label,
                               .mark = fills ? LEGEND_AREA : LEGEND_LINE,
                               .which = tones[k]};
        snprintf(rows[k].value, sizeof rows[k].value, "%u", layer->counts[k]);
    }
    rows[KINDS] = (legend_row){
        .label = "from inside it the eye is seen", .mark = LEGEND_LINE, .which = TONE_WATCH_SEEN};
    return KINDS + 1;
}
