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
    app_draw(user, cairo);
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
    pane_plan(app, (sl_box){{0, 0}, {box_width(plan), box_height(plan)}}, 0, true);
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

void save_numbered(app_state *app, const char *ending) {
    char path[64], chart[64];
    for (unsigned i = 1; i < 10000; i++) {
        snprintf(path, sizeof path, "sightline-%u.%s", i, ending);
        snprintf(chart, sizeof chart, "sightline-%u-account.%s", i, ending);
        if (access(path, F_OK) == 0 || access(chart, F_OK) == 0) continue;
        sl_status status = save_plan(app, path);
        if (status == SL_OK && app->ui.accounts) status = account_save(app, chart);
        if (status == SL_OK)
            app_say(app, false, "saved %s%s%s", path, app->ui.accounts ? " and " : "",
                    app->ui.accounts ? chart : "");
        app_check(app, status);
        return;
    }
    app_say(app, true, "no free name for a picture in this folder");
}

sl_status save_series(app_state *app, const char *folder, unsigned every) {
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return sl_fail(app->context, SL_IO, "%s: %s", folder, strerror(errno));
    path_recorder *r = &app->tool.recorder;
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
    app_say(app, false, "%u frames in %s", number, folder);
    return SL_OK;
}
