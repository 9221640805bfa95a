#include "save.h"

#include "account.h"
#include "panes.h"
#include "sightline/canvas.h"
#include "sightline/support.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void draw_window(void *user, cairo_t *cairo) {
    sl_app_draw(user, cairo);
}

static void draw_plan(void *user, cairo_t *cairo) {
    sl_app *app = user;
    const sl_box plan = sl_app_layout(app).plan[0];
    const sl_ui before = app->ui;
    app->ui.cairo = cairo;
    app->ui.palette = sl_palette_make(app->dark);
    app->ui.text = sl_app_text(app);
    sl_app_fit(app, plan);
    sl_pane_plan(app, (sl_box){{0, 0}, {sl_box_width(plan), sl_box_height(plan)}}, 0, true);
    app->ui = before;
}

sl_status sl_save_window(sl_app *app, const char *path) {
    return sl_draw_page_file(app->context, path, app->width, app->height, "Sightline", draw_window,
                             app);
}

sl_status sl_save_plan(sl_app *app, const char *path) {
    const sl_box plan = sl_app_layout(app).plan[0];
    return sl_draw_page_file(app->context, path, (int)sl_box_width(plan), (int)sl_box_height(plan),
                             "Sightline", draw_plan, app);
}

void sl_save_numbered(sl_app *app, const char *ending) {
    char path[64], chart[64];
    for (unsigned i = 1; i < 10000; i++) {
        snprintf(path, sizeof path, "sightline-%u.%s", i, ending);
        snprintf(chart, sizeof chart, "sightline-%u-account.%s", i, ending);
        if (access(path, F_OK) == 0 || access(chart, F_OK) == 0) continue;
        sl_status status = sl_save_plan(app, path);
        if (status == SL_OK && app->accounts) status = sl_account_save(app, chart);
        if (status == SL_OK)
            sl_app_say(app, false, "saved %s%s%s", path, app->accounts ? " and " : "",
                       app->accounts ? chart : "");
        sl_app_check(app, status);
        return;
    }
    sl_app_say(app, true, "no free name for a picture in this folder");
}

sl_status sl_save_series(sl_app *app, const char *folder, unsigned every) {
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return sl_fail(app->context, SL_IO, "%s: %s", folder, strerror(errno));
    sl_recorder *r = &app->recorder;
    if (!r->frames.count)
        return sl_fail(app->context, SL_BAD_ARGUMENT, "nothing was recorded to be exported");
    char path[4096];
    unsigned number = 0;
    r->records = r->plays = false;
    for (size_t i = 0; i < r->frames.count; i += every ? every : 1) {
        app->eye.at = r->frames.items[i].at;
        app->eye.heading = r->frames.items[i].heading;
        sl_app_tick(app, 0);
        snprintf(path, sizeof path, "%s/frame-%04u.png", folder, ++number);
        SL_TRY(sl_save_window(app, path));
    }
    sl_app_say(app, false, "%u frames in %s", number, folder);
    return SL_OK;
}
