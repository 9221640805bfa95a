/// Pictures of the window and of the plan, as files.
#include "app/pictures.h"

#include "app/layout.h"
#include "app/turn.h"
#include "document/export.h"
#include "document/files.h"
#include "panes/account.h"
#include "panes/panes.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/// It is drawn to its end.
static void draw_window(void *user, cairo_t *cairo) {
    app_state *app = user;
    sl_context *const drawing = app->view.drawing;
    app->view.drawing = NULL;
    app->exports.draw_window(app, cairo);
    app->view.drawing = drawing;
}

static void draw_plan(void *user, cairo_t *cairo) {
    app_state *app = user;
    const sl_box plan = app_layout(app).plan[0];
    const int hits = app->ui.hit_count;
    const double text = app->ui.text;
    const sl_palette palette = app->ui.palette;
    cairo_t *const before = app->ui.cairo;
    app->ui.cairo = cairo;
    app->ui.palette = sl_palette_make(app->ui.dark);
    app->ui.text = ui_text_size(&app->ui);
    app_fit(app, plan);
    sl_context *const drawing = app->view.drawing;
    app->view.drawing = NULL;
    pane_plan(&app->learn, (sl_box){{0, 0}, {box_width(plan), box_height(plan)}}, 0, true);
    app->view.drawing = drawing;
    app->ui.cairo = before;
    app->ui.palette = palette;
    app->ui.text = text;
    app->ui.hit_count = hits;
}

sl_status save_window(app_state *app, const char *path) {
    return sl_draw_page_file(app->context, path, app->ui.width, app->ui.height, "Sightline",
                             draw_window, app);
}

sl_status save_plan(app_state *app, const char *path) {
    const sl_box plan = app_layout(app).plan[0];
    return sl_draw_page_file(app->context, path, (int)box_width(plan), (int)box_height(plan),
                             "Sightline", draw_plan, app);
}

/// Draws the plan now, and writes it in the background.
static sl_status export_plan(app_state *app, const char *path, const char *said) {
    const sl_box plan = app_layout(app).plan[0];
    return export_picture(&app->exports, path, said, (int)box_width(plan), (int)box_height(plan),
                          draw_plan);
}

sl_status save_picture(app_state *app, const char *path) {
    char chart[4200], said[256];
    const char *const dot = strrchr(path, '.');
    if (app->desk.file.locked || !dot) return SL_OK;
    // Lines are drawn straight into their file; only pixels can be drawn here and written
    // elsewhere.
    const bool now = app->ui.steady || strcasecmp(dot, ".png") != 0;
    if (!export_is_free(&app->exports))
        return sl_fail(app->context, SL_BAD_ARGUMENT, "pictures are being written; Esc stops that");
    snprintf(chart, sizeof chart, "%.*s-account%s", (int)(dot - path), path, dot);
    snprintf(said, sizeof said, "saved %.120s%s", files_base(path),
             app->ui.accounts ? ", and the account beside it" : "");
    if (app->ui.accounts) SL_TRY(account_save(&app->view, chart));
    if (!now) return export_plan(app, path, said);
    SL_TRY(save_plan(app, path));
    ui_say(&app->ui, false, "%s", said);
    return SL_OK;
}

sl_status save_series(app_state *app, const char *folder, unsigned every) {
    if (app->desk.file.locked) return SL_OK;
    if (!app->ui.steady) return export_series(&app->exports, folder, every, draw_window);
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return sl_fail(app->context, SL_IO, "%s: %s", folder, strerror(errno));
    path_recorder *r = &app->recorder;
    if (!r->frames.count)
        return sl_fail(app->context, SL_BAD_ARGUMENT, "nothing was recorded to be exported");
    char path[4096];
    unsigned number = 0;
    r->records = r->plays = false;
    for (size_t i = 0; i < r->frames.count; i += every ? every : 1) {
        app->view.eye.at = r->frames.items[i].at;
        app->view.eye.heading = r->frames.items[i].heading;
        app_tick(app, 0);
        snprintf(path, sizeof path, "%s/frame-%04u.png", folder, ++number);
        SL_TRY(save_window(app, path));
    }
    ui_say(&app->ui, false, "%u frames in %s", number, folder);
    return SL_OK;
}
