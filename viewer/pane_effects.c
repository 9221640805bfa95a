/// What the map calls for beside walls: what each effect adds to the work, what is left out, and
/// what the work of the bake was.
#include "panes.h"

#include "effect_words.h"

#include <stdio.h>

/// The effects found, each with the stages that it adds; returns the base line below.
static double draw_found(app_state *app, sl_box box, double y) {
    ui_state *ui = &app->ui;
    const sl_map *map = &app->document.map;
    const double t = ui->text, left = box.min.x + 1.1 * t, words = left + 10 * t;
    const unsigned called_for = sl_plan_make(map).effects;
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    for (size_t i = 0; i < count; i++) {
        char name[64];
        if (!(called_for >> i & 1)) continue;
        snprintf(name, sizeof name, "%s (%zu)", effects[i]->several, effects[i]->count(map));
        ui_text(ui, left, y, 0.95, true, ui->palette.ink, name);
        y = ui_paragraph(ui, words, y, box.max.x - t - words, 0.95, ui->palette.ink,
                         effects[i]->adds);
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
                           (unsigned long long)a->door_fallbacks);
    if (a->range_tests)
        length += snprintf(text + length, 256 - (size_t)length,
                           "; %llu sightlines held against the range",
                           (unsigned long long)a->range_tests);
    snprintf(text + length, 256 - (size_t)length, ".");
}

void pane_effects(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const double t = ui->text, left = box.min.x + 1.1 * t, wide = box_width(box) - 2.2 * t;
    ui_hit(ui, HIT_PANEL, 0, box);
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_clip(ui->cairo);
    ui_fill(ui, box, ui->palette.page);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    double y = box.min.y + 1.6 * t;
    ui_text(ui, left, y, 1, true, ui->palette.ink, "What the map calls for");
    y = draw_found(app, box, y + 1.6 * t);
    char text[256], none[CALLS_TEXT];
    effects_left_out(&app->document.map, none);
    if (none[0]) {
        snprintf(text, sizeof text, "Left out, as nothing calls for it: %s.", none);
        y = ui_paragraph(ui, left, y + 0.2 * t, wide, 0.95, ui->palette.faint, text);
    }
    write_work(&app->document, text);
    ui_paragraph(ui, left, y + 0.2 * t, wide, 0.95, ui->palette.faint, text);
    cairo_restore(ui->cairo);
}
