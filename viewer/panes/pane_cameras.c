/// The panel of the Cameras mode: what the cameras see, the search for the fewest, each camera, and
/// the blind spots.
#include "document/measure.h"
#include "panes/panel.h"
#include "panes/panes.h"
#include "plan/cameras.h"
#include "plan/room_map.h"
#include "sightline/draw.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

/// Rows that are listed: more would take the places of clicks of a frame.
enum {
    SLIDERS = 5,
    CAMERAS_LISTED = 120,
    SPOTS_LISTED = 40,
    AREA_TEXT = SL_COUNT_TEXT + MEASURE_TEXT + 4
};

static void area_text(const view_state *view, double area, char text[AREA_TEXT]) {
    char share[SL_COUNT_TEXT], measure[MEASURE_TEXT];
    const double all = view->cameras->coverage.overlay.areas[0];
    sl_text_percent(all > 0 ? area / all : 0, share);
    measure_say(area, view->document->map.unit, "\xc2\xb2", measure);
    snprintf(text, AREA_TEXT, "%s   %s", measure, share);
}

static void draw_classes(view_state *view, column *c) {
    static const char *const names[SL_COVERAGE_CLASSES] = {"not seen", "seen by 1", "seen by 2",
                                                           "seen by 3 or more"};
    const camera_layer *layer = view->cameras;
    column_heading(view->ui, c, "Area", NULL);
    for (uint32_t i = 0; i < SL_COVERAGE_CLASSES; i++) {
        const double area = sl_coverage_class_area(&layer->coverage, i);
        const sl_colour colour = sl_coverage_colour(&view->ui->palette, i);
        char text[AREA_TEXT];
        area_text(view, area, text);
        column_row(view->ui, c, &colour, names[i], text, false);
    }
}

/// The bounds of the search, or the proof of its end.
static void draw_search(view_state *view, column *c) {
    ui_state *ui = view->ui;
    const camera_layer *layer = view->cameras;
    const job_progress p = cameras_progress(layer);
    char text[160];
    if (p.running && p.total) {
        snprintf(text, sizeof text,
                 "At least %" PRIu64 " and at most %" PRIu64
                 " cameras are needed. Esc stops, and keeps the best.",
                 p.done, p.total);
        column_words(ui, c, 1, ui->palette.ink, text);
        const double t = ui->text, share = (double)p.done / (double)p.total;
        const sl_box bar = {{c->left, c->y + 0.2 * t}, {c->right, c->y + 0.8 * t}};
        ui_fill_round(ui, bar, 0.3 * t, ui->palette.outline);
        ui_fill_round(ui, (sl_box){bar.min, {c->left + share * column_width(c), bar.max.y}},
                      0.3 * t, ui->palette.glass);
        c->y += 1.2 * t;
    } else if (p.running) {
        column_words(ui, c, 1, ui->palette.ink,
                     cameras_search(layer) == SEARCH_ONE ? "Looking for one more ..."
                                                         : "Looking for the fewest ...");
    } else if (layer->proof[0]) {
        column_words(ui, c, 1, ui->palette.ink, layer->proof);
    }
}

static void draw_list(view_state *view, column *c) {
    const camera_layer *layer = view->cameras;
    const bool now = cameras_are_seen(view);
    size_t spare = 0;
    char count[32];
    snprintf(count, sizeof count, "%zu", layer->table.count);
    column_heading(view->ui, c, "Cameras", count);
    for (size_t i = 0; i < layer->table.count; i++) {
        const sl_colour colour = sl_viewpoint_colour(&view->ui->palette, i);
        const bool is_spare = now && sl_coverage_is_spare(&layer->coverage, i);
        char name[CAMERA_NAME], text[2 * MEASURE_TEXT + 32] = "", sees[MEASURE_TEXT],
                                                        alone[MEASURE_TEXT];
        spare += is_spare;
        if (i >= CAMERAS_LISTED) continue;
        camera_name(layer, i, name);
        if (now) {
            measure_say(layer->coverage.seen[i], view->document->map.unit, "\xc2\xb2", sees);
            measure_say(layer->coverage.alone[i], view->document->map.unit, "\xc2\xb2", alone);
            snprintf(text, sizeof text, "sees %s, %s%s", sees, is_spare ? "spare" : "alone ",
                     is_spare ? "" : alone);
        }
        const sl_box row = column_row(view->ui, c, &colour, name, text, i == layer->chosen);
        ui_hit_focus(view->ui, HIT_CAMERA, (int)i, row);
    }
    if (layer->table.count > CAMERAS_LISTED)
        column_words(view->ui, c, 0.9, view->ui->palette.faint, "The plan shows the rest.");
    if (spare)
        column_words(view->ui, c, 0.9, view->ui->palette.faint,
                     spare > 1 ? "The others see all that a spare one sees. Delete one and look "
                                 "again: two may stand in for each other."
                               : "The others see all that the spare one sees.");
}

static void draw_spots(view_state *view, column *c) {
    const camera_layer *layer = view->cameras;
    char text[AREA_TEXT], name[32 + PLACE_NAME];
    if (!layer->coverage.blind_count || !layer->table.count) return;
    snprintf(text, sizeof text, "%u", layer->coverage.blind_count);
    column_heading(view->ui, c, "Blind spots", text);
    for (uint32_t i = 0; i < layer->coverage.blind_count && i < SPOTS_LISTED; i++) {
        const char *room = room_map_room(view, layer->coverage.blind[i].at);
        snprintf(name, sizeof name, "blind %u%s%s", i + 1, room ? ", " : "", room ? room : "");
        area_text(view, layer->coverage.blind[i].area, text);
        const sl_box row = column_row(view->ui, c, NULL, name, text, i + 1 == layer->spot);
        ui_hit_focus(view->ui, HIT_SPOT, (int)i, row);
    }
    static const char *const next[] = {"camera_spot", NULL};
    c->y += 0.3 * view->ui->text;
    column_buttons(view->ui, c, next);
}

void pane_cameras(learn_state *learn, sl_box box) {
    view_state *view = learn->view;
    column c = column_begin(learn->ui, box);
    static const char *const find[] = {"camera_find", "camera_more", "camera_one", NULL};
    static const char *const change[] = {"camera_name", "camera_copy", "camera_delete",
                                         "undo",        "redo",        NULL};
    static const char *const files[] = {"camera_import", "camera_export", NULL};
    column_heading(learn->ui, &c, "Place cameras", NULL);
    column_words(learn->ui, &c, 0.95, learn->ui->palette.ink,
                 "A click puts one. Drag it, or the handle ahead of it. Left and Right turn it.");
    c.y += 0.4 * learn->ui->text;
    // Buttons come before what grows, so that none moves from under the pointer.
    column_buttons(learn->ui, &c, find);
    column_buttons(learn->ui, &c, change);
    column_buttons(learn->ui, &c, files);
    column_name(view, &c);
    c.y += 0.3 * learn->ui->text;
    if (view->cameras && learn->document->baked) {
        // The room for all sliders, and for what a search says, stays: so do the rows below.
        const double top = c.y, t = learn->ui->text;
        column_sliders(learn->ui, &c);
        if (!camera_chosen(view))
            column_words(learn->ui, &c, 0.9, learn->ui->palette.faint,
                         "A click on a camera chooses it: its field of view, heading and range "
                         "stand here.");
        if (!column_is_narrow(learn->ui, &c)) c.y = fmax(c.y, top + SLIDERS * 1.7 * t);
        const double said = c.y;
        draw_search(view, &c);
        c.y = fmax(c.y, said + 4 * t);
        if (view->cameras->known) draw_classes(view, &c);
        draw_list(view, &c);
        if (view->cameras->known) draw_spots(view, &c);
    }
    column_layers(view, &c);
    column_end(learn->ui, &c);
}
