#include "range.h"

#include "sightline/canvas.h"

#include <math.h>

double range_most(const app_state *app) {
    const sl_box b = app->document.baked->space.bounds;
    return hypot(b.max.x - b.min.x, b.max.y - b.min.y);
}

/// To three digits, so that it can be read.
static double rounded(double range) {
    const double step = pow(10, floor(log10(range)) - 2);
    return step * round(range / step);
}

void range_set(app_state *app, double range) {
    app->document.map.range = rounded(fmax(range, 1e-3 * range_most(app)));
    app_after_touch(app);
}

void range_settle(app_state *app) {
    const edit_history *history = &app->document.history;
    const size_t kept = history->done_count;
    if (kept && history->done[kept - 1].range == app->document.map.range)
        history_forget_last(app->context, &app->document.history);
    if (app->document.baked->map.range != app->document.map.range) app_after_edit(app);
}

void range_toggle(app_state *app) {
    if (!app->document.baked) return;
    app_keep(app);
    app->document.map.range =
        app->document.map.range > 0 ? 0 : rounded(fmax(0.3 * range_most(app), 1e-100));
    app_after_touch(app);
    range_settle(app);
    if (app->document.map.range > 0)
        app_say(app, false, "nothing farther than %g is seen; the slider changes that",
                app->document.map.range);
    else
        app_say(app, false, "sight reaches any distance");
}

void range_draw(app_state *app, const sl_frame *frame) {
    cairo_t *cairo = app->ui.cairo;
    const double radius = app->document.map.range * frame->scale;
    const double dashes[] = {5 * frame->unit, 4 * frame->unit};
    sl_point at;
    // One that is larger than what cairo can hold is nowhere near the page's middle either.
    if (!(radius > 0) || radius > 1e5 || !sl_frame_holds(frame, app->view.eye.at, &at)) return;
    cairo_save(cairo);
    cairo_new_path(cairo);
    cairo_arc(cairo, at.x, at.y, radius, 0, 6.283185307179586);
    sl_set_colour(cairo, app->ui.palette.start);
    cairo_set_line_width(cairo, 1.4 * frame->unit);
    cairo_set_dash(cairo, dashes, 2, 0);
    cairo_stroke(cairo);
    cairo_restore(cairo);
}
