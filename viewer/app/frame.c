/// The frame that is drawn from the state.
#include "app/frame.h"

#include "app/actions.h"
#include "app/layout.h"
#include "app/sliders.h"
#include "app/turn.h"
#include "panes/modes.h"
#include "panes/panes.h"
#include "plan/heat.h"
#include "sightline/support.h"

#include <math.h>

/// The borders that can be dragged: over all panes, as they are narrow.
static void draw_edges(app_state *app, const window_layout *l) {
    ui_state *ui = &app->ui;
    const double wide = fmax(0.35 * ui->text, 4);
    if (ui_has_panel(ui))
        ui_edge(ui, EDGE_SIDE,
                (sl_box){{l->side.min.x - wide / 2, l->side.min.y},
                         {l->side.min.x + wide / 2, l->side.max.y}});
    for (int i = 0; i < PANES_BELOW; i++)
        if (box_width(l->below[i]) > 0) {
            ui_edge(ui, EDGE_BELOW,
                    (sl_box){{0, l->below[i].min.y - wide / 2},
                             {l->side.min.x, l->below[i].min.y + wide / 2}});
            break;
        }
}

/// On a projector pale tones vanish.
static sl_palette palette_of(const ui_state *ui) {
    sl_palette p = sl_palette_make(ui->dark);
    if (!ui->presents) return p;
    p.faint = sl_colour_mix(p.faint, p.ink, 0.6);
    p.outline = sl_colour_mix(p.outline, p.ink, 0.4);
    for (int i = 0; i < SL_TONES; i++) p.floor[i] = sl_colour_mix(p.floor[i], p.floor[0], 0.7);
    return p;
}

void app_draw(app_state *app, cairo_t *cairo) {
    const double before = sl_seconds();
    app->ui.cairo = cairo;
    app->ui.palette = palette_of(&app->ui);
    app->ui.text = ui_text_size(&app->ui);
    app->ui.over = ui_find(&app->ui, app->ui.pointer);
    ui_begin(&app->ui);
    actions_show(app);
    pane_bar_measure(&app->learn);
    pane_time_measure(&app->learn);
    const window_layout l = app_place(app);
    app_fit(app, l.plan[0]);
    heat_layer_follow(&app->view);
    pane_dual_hover(&app->learn, l.below[PANE_DUAL]);
    for (int i = 0; i < l.plan_count; i++) pane_plan(&app->learn, l.plan[i], i, false);
    for (int i = 0; i < PANES_BELOW; i++)
        if (box_width(l.below[i]) > 0) panes_below()[i].draw(&app->learn, l.below[i]);
    sliders_show(app);
    if (ui_has_panel(&app->ui)) mode_table()[app->view.mode].panel(&app->learn, l.side);
    draw_edges(app, &l);
    if (box_width(l.time) > 0) pane_time(&app->learn, l.time);
    pane_bar(&app->learn, l.bar);
    const job_progress work = app_progress(app);
    pane_status(&app->learn, l.status, &work,
                app->recorder.records ? "recording"
                : app->recorder.plays ? "playing"
                                      : "");
    if (app->ui.help) pane_help(&app->ui);
    dialog_draw(&app->desk.dialog);
    if (app->view.drag.kind == DRAG_NONE) pane_tip(&app->ui);
    app->view.draw_seconds = 0.8 * app->view.draw_seconds + 0.2 * (sl_seconds() - before);
}

void frame_draw(void *user, cairo_t *cairo) {
    app_draw(user, cairo);
}
