/// Lines as points: the dual plane of the portal sequence, linked with the plan.
#include "panes.h"

#include "sightline/canvas.h"

#include <math.h>
#include <stdio.h>

static sl_dual_frame frame_of(const app_state *app, sl_box box) {
    const double t = ui_text_size(&app->ui);
    return sl_dual_frame_fit(&app->tool.lesson.before, box.min.x + 0.9 * t, box.min.y + 2.2 * t,
                             fmax(box_width(box) - 1.8 * t, 8), fmax(box_height(box) - 4.1 * t, 8),
                             ui_scale(&app->ui));
}

void pane_dual(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    const lesson_state *lesson = &app->tool.lesson;
    ui_fill(ui, box, ui->palette.page);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    ui_hit(ui, HIT_PANEL, 0, box);
    const double x = ui_text(ui, box.min.x + 0.9 * t, box.min.y + 1.5 * t, 1, true, ui->palette.ink,
                             "Lines as points");
    char text[160];
    if (lesson->end_count)
        snprintf(text, sizeof text, "%u half-planes: %s", 2 * lesson->end_count,
                 lesson->dual.corner_count ? "what all leave is green" : "nothing is left");
    else
        snprintf(text, sizeof text, "no portal is crossed yet: every line counts");
    ui_text(ui, box.min.x + 1.7 * t + x, box.min.y + 1.5 * t, 0.95, false, ui->palette.faint, text);
    if (!lesson->end_count) return;
    const sl_dual_frame frame = frame_of(app, box);
    sl_draw_dual(ui->cairo, &ui->palette, &frame, &lesson->dual, lesson->ends, lesson->end_count,
                 lesson->line);
    const double base = frame.top + frame.height + 1.2 * t;
    sl_text_show_within(
        ui->cairo, ui->palette.faint, frame.left, base, frame.width, 0.85 * t, false,
        "slope \xe2\x86\x92   height \xe2\x86\x91   blue: left ends, from above   orange: "
        "right ends, from below   bar: the best line and its margin");
    ui_hit(ui, HIT_DUAL, 0,
           (sl_box){{frame.left, frame.top}, {frame.left + frame.width, frame.top + frame.height}});
}

void pane_dual_drag(app_state *app, sl_box box, sl_point to) {
    if (!app->tool.lesson.end_count) return;
    const sl_dual_frame frame = frame_of(app, box);
    const sl_dual_line line = sl_dual_frame_line(&frame, to);
    app->tool.lesson.line.slope = fmin(fmax(line.slope, -SL_DUAL_SLOPE), SL_DUAL_SLOPE);
    app->tool.lesson.line.height = fmin(fmax(line.height, -SL_DUAL_HEIGHT), SL_DUAL_HEIGHT);
}

/// Near an end of what is shown the line turns about the other end; between them it is shifted.
void pane_plan_drag_line(app_state *app, sl_point from, sl_point to) {
    lesson_state *lesson = &app->tool.lesson;
    if (!lesson->end_count) return;
    const sl_point a = sl_dual_point(&lesson->dual, from), b = sl_dual_point(&lesson->dual, to);
    sl_dual_line *line = &lesson->line;
    const double pivot = a.x > 0.35 ? -1 : a.x < -0.35 ? 1 : 0;
    if (pivot == 0) {
        line->height += (b.y - line->slope * b.x) - line->height;
    } else if (fabs(b.x - pivot) > 0.05) {
        const double at = line->slope * pivot + line->height;
        const double slope = (b.y - at) / (b.x - pivot);
        line->slope = fmin(fmax(slope, -SL_DUAL_SLOPE), SL_DUAL_SLOPE);
        line->height = at - line->slope * pivot;
    }
    line->height = fmin(fmax(line->height, -SL_DUAL_HEIGHT), SL_DUAL_HEIGHT);
}
