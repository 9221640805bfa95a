/// Results of a session: recorded paths of the eye with their playback, and pictures of the screen
/// as files.
#include "document/save.h"

#include "app/app.h"
#include "document/export.h"
#include "panes/account.h"
#include "panes/panes.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// --- paths

/// Ten minutes.
enum { FRAMES_MOST = 36000 };

static sl_status add(sl_context *context, path_recorder *recorder, record_frame frame) {
    if (recorder->frames.count >= FRAMES_MOST) {
        recorder->records = false;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &recorder->frames, 1));
    recorder->frames.items[recorder->frames.count++] = frame;
    return SL_OK;
}

sl_status record_tick(sl_context *context, path_recorder *recorder, double seconds,
                      record_frame now) {
    if (!recorder->records) return SL_OK;
    for (recorder->waited += seconds; recorder->waited >= RECORD_STEP * 0.999;
         recorder->waited -= RECORD_STEP)
        SL_TRY(add(context, recorder, now));
    return SL_OK;
}

bool record_play(path_recorder *recorder, double seconds, record_frame *frame) {
    if (!recorder->plays) return false;
    recorder->waited += seconds;
    const size_t steps = (size_t)(recorder->waited / RECORD_STEP + 0.001);
    recorder->waited -= (double)steps * RECORD_STEP;
    if (recorder->next >= recorder->frames.count) {
        recorder->plays = false;
        return false;
    }
    *frame = recorder->frames.items[recorder->next];
    recorder->next += steps;
    return true;
}

sl_status record_path(sl_context *context, path_recorder *recorder, const sl_path *path,
                      double speed) {
    recorder->frames.count = 0;
    for (size_t i = 1; i < path->count; i++) {
        const sl_point a = path->points[i - 1], b = path->points[i];
        const double length = hypot(b.x - a.x, b.y - a.y);
        const double heading = atan2(b.y - a.y, b.x - a.x) * (180 / 3.14159265358979323846);
        const double steps = fmin(ceil(length / (speed * RECORD_STEP)), FRAMES_MOST);
        for (double k = 0; k < steps; k++)
            SL_TRY(
                add(context, recorder,
                    (record_frame){{a.x + (b.x - a.x) * k / steps, a.y + (b.y - a.y) * k / steps},
                                   heading}));
    }
    return SL_OK;
}

void record_destroy(sl_context *context, path_recorder *recorder) {
    sl_free(context, recorder->frames.items);
    *recorder = (path_recorder){0};
}

// --- pictures

void save_draw_window(void *user, cairo_t *cairo) {
    app_draw(user, cairo);
}

void save_draw_plan(void *user, cairo_t *cairo) {
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
    pane_plan(&app->learn, (sl_box){{0, 0}, {box_width(plan), box_height(plan)}}, 0, true);
    app->ui.cairo = before;
    app->ui.palette = palette;
    app->ui.text = text;
    app->ui.hit_count = hits;
}

sl_status save_window(app_state *app, const char *path) {
    return sl_draw_page_file(app->context, path, app->ui.width, app->ui.height, "Sightline",
                             save_draw_window, app);
}

sl_status save_plan(app_state *app, const char *path) {
    const sl_box plan = app_layout(app).plan[0];
    return sl_draw_page_file(app->context, path, (int)box_width(plan), (int)box_height(plan),
                             "Sightline", save_draw_plan, app);
}

void save_numbered(app_state *app, const char *ending) {
    char path[64], chart[64], said[160];
    if (app->file.locked) return;
    // Lines are drawn straight into their file; only pixels can be drawn here and written
    // elsewhere.
    const bool now = app->ui.steady || strcmp(ending, "png") != 0;
    if (!export_is_free(app)) {
        ui_say(&app->ui, true, "pictures are being written; Esc stops that");
        return;
    }
    for (unsigned i = 1; i < 10000; i++) {
        snprintf(path, sizeof path, "sightline-%u.%s", i, ending);
        snprintf(chart, sizeof chart, "sightline-%u-account.%s", i, ending);
        if (access(path, F_OK) == 0 || access(chart, F_OK) == 0) continue;
        snprintf(said, sizeof said, "saved %s%s%s", path, app->ui.accounts ? " and " : "",
                 app->ui.accounts ? chart : "");
        sl_status status = app->ui.accounts ? account_save(&app->view, chart) : SL_OK;
        if (status == SL_OK) status = now ? save_plan(app, path) : export_plan(app, path, said);
        if (status == SL_OK && now) ui_say(&app->ui, false, "%s", said);
        view_check(&app->view, status);
        return;
    }
    ui_say(&app->ui, true, "no free name for a picture in this folder");
}

sl_status save_series(app_state *app, const char *folder, unsigned every) {
    if (app->file.locked) return SL_OK;
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
