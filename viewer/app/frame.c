/// The frame that is drawn from the state.
#include "app/frame.h"

#include "app/actions.h"
#include "app/layout.h"
#include "app/sliders.h"
#include "app/turn.h"
#include "dialogs/import_dialog.h"
#include "panes/modes.h"
#include "panes/panes.h"
#include "plan/heat.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>

/// The borders that can be dragged: over all panes, as they are narrow.
static void draw_edges(app_state *app, const window_layout *l) {
    ui_state *ui = &app->ui;
    const double wide = fmax(0.35 * ui->text, 4);
    if (ui_has_panel(ui))
        ui_edge(ui, EDGE_SIDE,
                (sl_box){{l->side.min.x - wide / 2, l->side.min.y},
                         {l->side.min.x + wide / 2, l->side.max.y}});
    for (int i = 0; i < PANES_BELOW; i++)
        if (box_width(l->below[i]) > 0 && l->below[i].min.y > l->bar.max.y) {
            ui_edge(ui, EDGE_BELOW,
                    (sl_box){{0, l->below[i].min.y - wide / 2},
                             {l->side.min.x, l->below[i].min.y + wide / 2}});
            break;
        }
}

/// What the dialog of how a plan is read marks in it: openings that leak, with their widths, those
/// that are closed, and the line that is measured.
static void reading_draw(app_state *app, sl_box pane) {
    ui_state *ui = &app->ui;
    const sl_palette *palette = &ui->palette;
    const sl_frame frame = camera_frame(&app->view.camera, pane, ui_scale(ui));
    const sl_colour colours[] = {[MARK_LEAK] = palette->start,
                                 [MARK_CHOSEN] = palette->start,
                                 [MARK_CLOSED] = palette->door,
                                 [MARK_LINE] = palette->glass,
                                 [MARK_END] = palette->glass};
    import_mark mark;
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, pane.min.x, pane.min.y, box_width(pane), box_height(pane));
    cairo_clip(ui->cairo);
    for (size_t i = 0; import_mark_at(&app->desk, i, &mark); i++) {
        const sl_point a = sl_frame_point(&frame, mark.at.a), b = sl_frame_point(&frame, mark.at.b);
        char text[48];
        cairo_new_path(ui->cairo);
        sl_path_segment(ui->cairo, &frame, mark.at.a, mark.at.b);
        tone_cased(ui->cairo, palette, colours[mark.kind],
                   (mark.kind == MARK_CHOSEN ? 5 : 3) * frame.unit, 0);
        if (mark.kind == MARK_LINE || mark.kind == MARK_END) {
            sl_draw_ring(ui->cairo, &frame, mark.at.a, 5 * frame.unit, palette->glass,
                         2 * frame.unit);
            sl_draw_ring(ui->cairo, &frame, mark.at.b, 5 * frame.unit, palette->glass,
                         2 * frame.unit);
        }
        if (!(mark.length > 0)) continue;
        sl_draw_ring(ui->cairo, &frame, mark.at.a, 4 * frame.unit, palette->start, 2 * frame.unit);
        snprintf(text, sizeof text, "%.3g%s%s", mark.length, *app->document.map.unit ? " " : "",
                 app->document.map.unit);
        const sl_point middle = {(a.x + b.x) / 2, (a.y + b.y) / 2};
        const double wide = ui_text_width(ui, 1, true, text) + 0.8 * ui->text;
        const sl_box ground = {{middle.x + 0.6 * ui->text, middle.y - 1.6 * ui->text},
                               {middle.x + 0.6 * ui->text + wide, middle.y}};
        ui_fill_round(ui, ground, 0.3 * ui->text, palette->page);
        sl_text_font(ui->cairo, ui->text, true);
        sl_text_show(ui->cairo, palette->start, ground.min.x + 0.4 * ui->text,
                     ground.max.y - 0.45 * ui->text, text);
    }
    cairo_restore(ui->cairo);
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
    app->desk.dialog.dock = l.side;
    reading_draw(app, l.plan[0]);
    if (ui_has_panel(&app->ui) && !import_is_beside(&app->desk))
        mode_table()[app->view.mode].panel(&app->learn, l.side);
    draw_edges(app, &l);
    if (box_width(l.time) > 0) pane_time(&app->learn, l.time);
    pane_bar(&app->learn, l.bar);
    const job_progress work = app_progress(app);
    // A panel of a dialog lies over what the message would cover of it.
    pane_status(&app->learn, l.status, import_is_beside(&app->desk) ? l.side.min.x : l.status.max.x,
                &work,
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
