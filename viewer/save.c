#include "save.h"

#include "account.h"
#include "draw/paper.h"
#include "panes.h"
#include "sightline/support.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static sl_status save(sl_app *app, const char *path, bool window) {
    const sl_paper_kind *kind;
    sl_paper paper;
    sl_context *context = app->context;
    SL_TRY(sl_paper_kind_of(context, path, &kind));
    const sl_layout l = sl_app_layout(app);
    const double w = window ? app->width : sl_box_width(l.plan[0]);
    const double h = window ? app->height : sl_box_height(l.plan[0]);
    SL_TRY(sl_paper_open(context, kind, path, (int)w, (int)h, "Sightline", &paper));
    if (window) {
        sl_app_draw(app, paper.cairo);
    } else {
        const sl_ui before = app->ui;
        app->ui.cairo = paper.cairo;
        app->ui.palette = sl_palette_make(app->dark);
        app->ui.text = sl_app_text(app);
        sl_app_fit(app, l.plan[0]);
        sl_pane_plan(app, (sl_box){{0, 0}, {w, h}}, 0, true);
        app->ui = before;
    }
    return sl_paper_close(context, &paper, SL_OK);
}

sl_status sl_save_window(sl_app *app, const char *path) {
    return save(app, path, true);
}

sl_status sl_save_plan(sl_app *app, const char *path) {
    return save(app, path, false);
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
