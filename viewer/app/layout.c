/// Where things are on the page, by the size of the window and of text.
#include "app/layout.h"

#include "dialogs/import_dialog.h"
#include "panes/modes.h"
#include "panes/panes.h"

#include <math.h>
#include <string.h>

static sl_box box_of(double left, double top, double right, double bottom) {
    return (sl_box){{left, top}, {fmax(right, left + 1), fmax(bottom, top + 1)}};
}

static double side_width(const app_state *app) {
    const ui_state *ui = &app->ui;
    const double t = ui_text_size(ui), chosen = ui->edges[EDGE_SIDE];
    if (import_is_beside(&app->desk)) return fmin(IMPORT_WIDE * t, 0.55 * ui->width);
    if (!ui_has_panel(&app->ui)) return 0;
    return fmin(fmax(chosen > 0 ? chosen : 26, 8) * t, 0.55 * ui->width);
}

/// Whether the first person has half of the plan's place, in place of a pane below.
static bool looks_beside(const app_state *app) {
    return app->ui.looks_beside && panes_below()[PANE_FIRST_PERSON].shown(&app->learn) &&
           !(app->view.compare == COMPARE_PANES && app->view.mode == MODE_EXPLORE);
}

static bool is_below(const app_state *app, int pane) {
    return panes_below()[pane].shown(&app->learn) &&
           !(pane == PANE_FIRST_PERSON && looks_beside(app));
}

static void place_below(const app_state *app, window_layout *l, double right, double *bottom) {
    int shown = 0, before = 0;
    const double t = ui_text_size(&app->ui), chosen = app->ui.edges[EDGE_BELOW];
    const double room = *bottom - l->bar.max.y;
    double high = 0;
    for (int i = 0; i < PANES_BELOW; i++) {
        const pane_below *pane = &panes_below()[i];
        if (!is_below(app, i)) continue;
        high = fmax(high, pane->lines ? fmin(1.4 * t * pane->lines(&app->learn), 0.42 * room)
                                      : 0.42 * room);
        shown++;
    }
    if (!shown) return;
    if (chosen > 0) high = fmin(fmax(chosen, 0.1), 0.8) * room;
    const double top = round(*bottom - high);
    for (int i = 0; i < PANES_BELOW; i++) {
        if (!is_below(app, i)) continue;
        const double left = right * before / shown;
        l->below[i] = box_of(left, top, right * ++before / shown, *bottom);
    }
    *bottom = top;
}

window_layout app_layout(const app_state *app) {
    const double t = ui_text_size(&app->ui), w = app->ui.width, h = app->ui.height;
    window_layout l = {.plan_count = 1};
    const double bar = (0.3 + 2 * app->ui.bar_rows) * t, status = 1.9 * t;
    l.bar = box_of(0, 0, w, bar);
    l.status = box_of(0, h - status, w, h);
    double bottom = h - status;
    if (pane_time_shown(&app->learn)) {
        l.time = box_of(0, fmax(bottom - pane_time_height(&app->learn), bar + 0.3 * (bottom - bar)),
                        w, bottom);
        bottom = l.time.min.y;
    }
    const double right = round(w - side_width(app));
    l.side = box_of(right, bar, w, bottom);
    place_below(app, &l, right, &bottom);
    l.plan[0] = box_of(0, bar, right, bottom);
    if (looks_beside(app)) {
        l.plan[0].max.x = floor(right / 2);
        l.below[PANE_FIRST_PERSON] = box_of(l.plan[0].max.x, bar, right, bottom);
    }
    if (app->view.compare == COMPARE_PANES && app->view.mode == MODE_EXPLORE) {
        l.plan_count = 2;
        l.plan[0].max.x = floor(right / 2);
        l.plan[1] = box_of(l.plan[0].max.x, bar, right, bottom);
    }
    return l;
}

void app_drag_edge(app_state *app, int edge, double by) {
    const window_layout l = app_layout(app);
    if (edge == EDGE_SIDE) {
        app->ui.edges[edge] = fmax(side_width(app) + by, 1) / ui_text_size(&app->ui);
        return;
    }
    double high = 0, bottom = l.plan[0].max.y;
    for (int i = 0; i < PANES_BELOW; i++)
        if (is_below(app, i)) high = fmax(high, box_height(l.below[i]));
    const double room = bottom + high - l.bar.max.y;
    app->ui.edges[edge] = fmin(fmax((high + by) / room, 0.1), 0.8);
}

window_layout app_place(app_state *app) {
    const window_layout l = app_layout(app);
    memcpy(app->view.plan, l.plan, sizeof l.plan);
    app->view.plan_count = l.plan_count;
    return l;
}

void app_fit(app_state *app, sl_box plan) {
    if (app->view.fitted && app->document.baked)
        app->view.camera =
            camera_fit(app->document.baked->space.bounds, box_width(plan), box_height(plan));
}
