/// What the map calls for, and what the bake did for it.
#include "panes/panes.h"
#include "plan/effects.h"

#include <math.h>
#include <stdio.h>

/// Lists the effects, each with the stages that it adds; returns the base line below.
static double draw_found(const view_state *view, sl_box box, double y) {
    ui_state *ui = view->ui;
    const sl_map *map = &view->document->map;
    const double t = ui->text, left = box.min.x + 1.1 * t, right = box.max.x - t;
    // A narrow pane has the words below the name.
    const bool beside = right - left > 24 * t;
    const double words = beside ? left + 10 * t : left;
    const unsigned called_for = sl_plan_make(map).effects;
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    for (size_t i = 0; i < count; i++) {
        char name[64];
        if (!(called_for >> i & 1)) continue;
        snprintf(name, sizeof name, "%s (%zu)", effects[i]->several, effects[i]->count(map));
        const double below = ui_lines(ui, left, y, beside ? 9.5 * t : right - left, 0.95, true,
                                      ui->palette.ink, name);
        y = fmax(below, ui_paragraph(ui, words, beside ? y : below, right - words, 0.95,
                                     ui->palette.ink, effects[i]->adds));
    }
    return y;
}

/// What the bake did for them.
static void write_work(const document_state *document, char text[256]) {
    if (!document->has_visibility) {
        snprintf(text, 256, "What cells see is being worked out.");
        return;
    }
    const sl_visibility *v = &document->baked->visibility;
    const sl_see_account *a = &v->account;
    int length = snprintf(text, 256, "Baked by %s", document->baked->method);
    if (v->mirrored.cell_count)
        length += snprintf(text + length, 256 - (size_t)length, "; %llu pairs seen by mirror",
                           (unsigned long long)a->mirrored_pairs);
    if (v->doors.cell_count)
        length += snprintf(text + length, 256 - (size_t)length,
                           "; %llu bytes for pairs that depend on doors, %llu pairs over the limit",
                           (unsigned long long)sl_door_sets_bytes(&v->doors),
                           (unsigned long long)a->effects.door_fallbacks);
    if (a->effects.range_tests)
        length += snprintf(text + length, 256 - (size_t)length,
                           "; %llu sightlines held against the range",
                           (unsigned long long)a->effects.range_tests);
    snprintf(text + length, 256 - (size_t)length, ".");
}

void pane_effects(learn_state *learn, sl_box box) {
    const view_state *view = learn->view;
    ui_state *ui = view->ui;
    const double t = ui->text, left = box.min.x + 1.1 * t, wide = box_width(box) - 2.2 * t;
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    const sl_box room = {{box.min.x, box.min.y + 1}, box.max};
    double y = ui_begin_scroll(ui, SCROLL_EFFECTS, room);
    y = ui_lines(ui, left, y + 1.6 * t, wide, 1, true, ui->palette.ink, "What the map calls for");
    box.max.x -= ui_bar_width(ui);
    y = draw_found(view, box, y + 0.2 * t);
    char text[256], none[CALLS_TEXT];
    effects_left_out(&view->document->map, none);
    if (none[0]) {
        snprintf(text, sizeof text, "Left out, as nothing calls for it: %s.", none);
        y = ui_paragraph(ui, left, y + 0.2 * t, wide, 0.95, ui->palette.faint, text);
    }
    write_work(view->document, text);
    y = ui_paragraph(ui, left, y + 0.2 * t, wide, 0.95, ui->palette.faint, text);
    ui_end_scroll(ui, room, y - 0.6 * t);
    ui_end_area(ui);
}
