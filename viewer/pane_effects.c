/// What the map calls for beside walls: what each effect adds to the work, what is left out, and
/// what the work of the bake was.
#include "panes.h"

#include "effect_words.h"

#include <stdio.h>

/// The effects found, each with the stages that it adds; returns the base line below.
static double draw_found(sl_app *app, sl_box box, double y) {
    sl_ui *ui = &app->ui;
    const sl_map *map = &app->document.map;
    const double t = ui->text, left = box.min.x + 1.1 * t, words = left + 10 * t;
    const unsigned called_for = sl_plan_make(map).effects;
    size_t count;
    const sl_effect *const *effects = sl_effects(&count);
    for (size_t i = 0; i < count; i++) {
        char name[64];
        if (!(called_for >> i & 1)) continue;
        snprintf(name, sizeof name, "%s (%zu)", effects[i]->several, effects[i]->count(map));
        sl_ui_text(ui, left, y, 0.95, true, ui->palette.ink, name);
        y = sl_ui_paragraph(ui, words, y, box.max.x - t - words, 0.95, ui->palette.ink,
                            effects[i]->adds);
    }
    return y;
}

/// What the bake did for them.
static void write_work(const sl_document *document, char text[256]) {
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

void sl_pane_effects(sl_app *app, sl_box box) {
    sl_ui *ui = &app->ui;
    const double t = ui->text, left = box.min.x + 1.1 * t, wide = sl_box_width(box) - 2.2 * t;
    sl_ui_hit(ui, SL_HIT_PANEL, 0, box);
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, sl_box_width(box), sl_box_height(box));
    cairo_clip(ui->cairo);
    sl_ui_fill(ui, box, ui->palette.page);
    sl_ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    double y = box.min.y + 1.6 * t;
    sl_ui_text(ui, left, y, 1, true, ui->palette.ink, "What the map calls for");
    y = draw_found(app, box, y + 1.6 * t);
    char text[256], none[SL_CALLS_TEXT];
    sl_effects_left_out(&app->document.map, none);
    if (none[0]) {
        snprintf(text, sizeof text, "Left out, as nothing calls for it: %s.", none);
        y = sl_ui_paragraph(ui, left, y + 0.2 * t, wide, 0.95, ui->palette.faint, text);
    }
    write_work(&app->document, text);
    sl_ui_paragraph(ui, left, y + 0.2 * t, wide, 0.95, ui->palette.faint, text);
    cairo_restore(ui->cairo);
}
