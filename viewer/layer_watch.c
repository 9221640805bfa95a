/// Cells by who sees whom, of the eye's cell; and the region from which the eye itself is seen. A
/// line of sight is the same both ways but for the glass on it, so that the region is what an eye
/// with all glass turned round would see.
#include "layer_watch.h"

#include "app.h"
#include "sightline/canvas.h"
#include "sightline/support.h"

#include <string.h>

typedef enum kind { SEES, MUTUAL, SEEN, KINDS } kind;

struct sl_watch_layer {
    uint32_t version; ///< of what is present that it is of
    sl_present present;
    sl_point eye;
    double range;
    bool made;
    sl_region region;
    sl_bits *sets[KINDS]; ///< cells
    size_t words;
    uint32_t counts[KINDS];
};

static void free_sets(sl_context *context, sl_watch_layer *layer) {
    for (int k = 0; k < KINDS; k++) {
        sl_free(context, layer->sets[k]);
        layer->sets[k] = NULL;
    }
}

void sl_watch_layer_destroy(sl_context *context, sl_watch_layer *layer) {
    if (!layer) return;
    sl_present_drop(context, &layer->present);
    sl_region_destroy(context, &layer->region);
    free_sets(context, layer);
    sl_free(context, layer);
}

static sl_status make_sets(sl_context *context, sl_watch_layer *layer, const sl_space *space) {
    free_sets(context, layer);
    layer->words = sl_bits_words(space->cell_count);
    for (int k = 0; k < KINDS; k++) {
        layer->sets[k] = sl_alloc_array(context, layer->words, sizeof *layer->sets[k]);
        if (!layer->sets[k]) return SL_NO_MEMORY;
    }
    return SL_OK;
}

static void sort_cells(const sl_app *app, sl_watch_layer *layer) {
    const uint32_t eye = app->seen.cell;
    memset(layer->counts, 0, sizeof layer->counts);
    if (eye == SL_NO_CELL || !app->present.has_rows) return;
    for (uint32_t cell = 0; cell < app->present.space->cell_count; cell++) {
        const bool sees = sl_bits_has(app->seen.pvs, cell);
        const bool seen = sl_present_sees(&app->present, &app->document, cell, eye);
        if (cell == eye || !(sees || seen)) continue;
        const kind k = sees && seen ? MUTUAL : sees ? SEES : SEEN;
        sl_bits_add(layer->sets[k], cell);
        layer->counts[k]++;
    }
}

static sl_status make(sl_app *app, sl_watch_layer *layer) {
    sl_context *context = app->context;
    const sl_view view = sl_view_all_round(app->eye.at);
    SL_TRY(sl_present_update(context, &layer->present, &app->document, app->eye.at));
    SL_TRY(make_sets(context, layer, app->present.space));
    sort_cells(app, layer);
    SL_TRY(sl_region_make(context, layer->present.outline, &view, app->document.map.range,
                          &layer->region));
    layer->version = app->present.version;
    layer->eye = app->eye.at;
    layer->range = app->document.map.range;
    layer->made = true;
    return SL_OK;
}

static sl_status follow(sl_app *app) {
    if (!app->watch) {
        app->watch = sl_alloc_array(app->context, 1, sizeof *app->watch);
        if (!app->watch) return SL_NO_MEMORY;
        app->watch->present.backwards = true;
    }
    sl_watch_layer *layer = app->watch;
    if (layer->made && layer->version == app->present.version && layer->eye.x == app->eye.at.x &&
        layer->eye.y == app->eye.at.y && layer->range == app->document.map.range)
        return SL_OK;
    layer->made = false;
    return make(app, layer);
}

static sl_key_row row_of(const sl_app *app, const sl_watch_layer *layer, kind k) {
    const sl_palette *palette = &app->ui.palette;
    const sl_key_row rows[KINDS] = {
        [SEES] = {"the eye's cell sees them", palette->glass, 0.45, layer->counts[SEES]},
        [MUTUAL] = {"both see each other", palette->portal, 0.3, layer->counts[MUTUAL]},
        [SEEN] = {"they see the eye's cell", palette->door, 0.45, layer->counts[SEEN]},
    };
    return rows[k];
}

void sl_layer_watch(sl_app *app, const sl_frame *frame, int index) {
    (void)index;
    const sl_status status = follow(app);
    sl_app_check(app, status);
    if (status != SL_OK) return;
    for (kind k = 0; k < KINDS; k++) {
        const sl_key_row row = row_of(app, app->watch, k);
        sl_draw_cell_set(app->ui.cairo, &app->document.baked->space, frame, app->watch->sets[k],
                         NULL, row.colour, row.opacity);
    }
    sl_layers_draw_region(app, frame, &app->watch->region, app->ui.palette.door);
}

void sl_layer_watch_key(sl_app *app, const sl_frame *frame) {
    const sl_watch_layer *layer = app->watch;
    if (!layer || !layer->made) return;
    sl_key_row rows[KINDS];
    for (kind k = 0; k < KINDS; k++) rows[k] = row_of(app, layer, k);
    sl_layers_draw_key(app, frame, rows, KINDS, "Purple region: from there the eye is seen.");
}
