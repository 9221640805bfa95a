/// What lies over all: the help and the list of maps.
#include "panes.h"

#include "actions.h"
#include "draw/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static sl_box begin_sheet(sl_app *app, double width, double height, const char *title) {
    sl_ui *ui = &app->ui;
    const double t = ui->text;
    const sl_box all = {{0, 0}, {app->width, app->height}};
    sl_ui_hit(ui, SL_HIT_PANEL, 1, all);
    const sl_colour dim = ui->palette.dark ? ui->palette.page : ui->palette.ink;
    cairo_set_source_rgba(ui->cairo, dim.red, dim.green, dim.blue, 0.45);
    cairo_paint(ui->cairo);
    const double w = fmin(width, app->width - 2 * t), h = fmin(height, app->height - 2 * t);
    const sl_box sheet = {{floor((app->width - w) / 2), floor((app->height - h) / 2)},
                          {floor((app->width + w) / 2), floor((app->height + h) / 2)}};
    sl_ui_fill_round(ui, sheet, 0.6 * t, ui->palette.page);
    sl_ui_text(ui, sheet.min.x + 1.5 * t, sheet.min.y + 2.2 * t, 1.3, true, ui->palette.ink, title);
    return sheet;
}

void sl_pane_help(sl_app *app) {
    sl_ui *ui = &app->ui;
    const double t = ui->text;
    size_t count, shown = 0;
    const sl_action *actions = sl_actions(&count);
    for (size_t i = 0; i < count; i++) shown += actions[i].key != NULL;
    const sl_box sheet = begin_sheet(app, 74 * t, 44 * t, "Keys and mouse");
    const int columns = 2;
    const size_t rows = (shown + 3 + columns - 1) / columns;
    const double top = sheet.min.y + 3.4 * t, column = (sl_box_width(sheet) - 2 * t) / columns;
    const double high = fmin(1.55 * t, (sheet.max.y - top - 1.2 * t) / (double)rows);
    const double size = fmin(1, high / (1.3 * t));
    static const char *const mouse[3][2] = {
        {"Drag", "pan; middle button: look"},
        {"Wheel", "zoom to the pointer"},
        {"Click", "puts the eye; right: why is a cell seen or not?"},
    };
    size_t at = 0;
    for (size_t i = 0; i < count + 3; i++) {
        const char *key = i < 3 ? mouse[i][0] : actions[i - 3].key;
        const char *help = i < 3 ? mouse[i][1] : actions[i - 3].help;
        if (!key) continue;
        const double x = sheet.min.x + 1.5 * t + column * (double)(at / rows);
        const double y = top + high * ((double)(at % rows) + 0.7);
        sl_ui_text(ui, x, y, size, true, ui->palette.glass, key);
        sl_text_show_within(ui->cairo, ui->palette.ink, x + 7.2 * t * size, y,
                            column - 7.6 * t * size, size * t, false, help);
        at++;
    }
}

void sl_pane_maps(sl_app *app) {
    sl_ui *ui = &app->ui;
    const double t = ui->text, high = 1.9 * t;
    const double wanted = 4.6 * t + high * fmax((double)app->map_count, 1);
    const sl_box sheet = begin_sheet(app, 40 * t, wanted, "Maps at hand");
    double y = sheet.min.y + 3.3 * t;
    if (!app->map_count)
        sl_ui_text(ui, sheet.min.x + 1.5 * t, y + t, 1, false, ui->palette.faint,
                   "None. Drop a file on the window.");
    for (size_t i = 0; i < app->map_count && y + high < sheet.max.y; i++) {
        const sl_box row = {{sheet.min.x + t, y}, {sheet.max.x - t, y + high}};
        const char *slash = strrchr(app->maps[i], '/');
        if (sl_box_has(row, ui->pointer))
            sl_ui_fill_round(ui, row, 0.3 * t,
                             sl_colour_mix(ui->palette.page, ui->palette.glass, 0.25));
        sl_ui_text(ui, row.min.x + 0.6 * t, y + 1.3 * t, 1, false, ui->palette.ink,
                   slash ? slash + 1 : app->maps[i]);
        sl_ui_hit(ui, SL_HIT_MAP, (int)i, row);
        y += high;
    }
}
