/// What accuracy costs: the chart, made anew a few times a second, so that it can be read while
/// times change.
#include "panes.h"

#include "account.h"
#include "clock.h"

#include <math.h>
#include <string.h>

#define SECONDS_BETWEEN 0.25

static bool is_stale(const app_state *app, const account_picture *kept, int width, int height) {
    if (!kept->surface || app->steady || kept->version != app->document.version ||
        kept->dark != app->ui.dark || kept->text != app->ui.text ||
        cairo_image_surface_get_width(kept->surface) != width ||
        cairo_image_surface_get_height(kept->surface) != height)
        return true;
    return clock_seconds() - kept->made > SECONDS_BETWEEN;
}

static void remake(app_state *app, account_picture *kept, int width, int height) {
    if (kept->surface) cairo_surface_destroy(kept->surface);
    kept->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    kept->version = app->document.version;
    kept->dark = app->ui.dark;
    kept->text = app->ui.text;
    kept->made = clock_seconds();
    cairo_t *cairo = cairo_create(kept->surface);
    account_draw(app, cairo, (sl_box){{0, 0}, {width, height}});
    cairo_destroy(cairo);
}

void pane_account(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const int width = (int)ceil(box_width(box)), height = (int)ceil(box_height(box));
    ui_hit(ui, HIT_PANEL, 0, box);
    if (is_stale(app, &app->view.account, width, height))
        remake(app, &app->view.account, width, height);
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_clip(ui->cairo);
    cairo_set_source_surface(ui->cairo, app->view.account.surface, box.min.x, box.min.y);
    cairo_paint(ui->cairo);
    cairo_restore(ui->cairo);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
}
