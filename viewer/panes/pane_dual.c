/// Lines as points: the dual plane of the portal sequence of the lesson.
///
/// An end under the pointer is marked here, in the plan and in the linear program alike: its
/// border, the end itself, its row. Where nothing is left, the half-planes that contradict each
/// other are marked, as are their ends in the plan.
#include "panes/panes.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>

static sl_dual_frame frame_of(learn_state *learn, sl_box box) {
    lesson_state *lesson = &learn->lesson;
    const double t = ui_text_size(learn->ui);
    sl_status status;
    const sl_conflict *conflict = lesson_conflict(learn->context, lesson, &status);
    view_check(learn->view, status);
    return sl_dual_frame_fit(&lesson->dual, &lesson->before, lesson->ends, conflict,
                             box.min.x + 0.9 * t, box.min.y + 2.2 * t,
                             fmax(box_width(box) - 1.8 * t, 8), fmax(box_height(box) - 4.1 * t, 8),
                             ui_scale(learn->ui));
}

/// The line as an equation: "y = 0.31 x - 0.05".
static void write_line(sl_dual_line line, char text[64]) {
    snprintf(text, 64, "line: y = %s%.3g x %s %.3g", line.slope < 0 ? "\xe2\x88\x92" : "",
             fabs(line.slope), line.height < 0 ? "\xe2\x88\x92" : "+", fabs(line.height));
}

/// The title, then the line, then the words, as far as each has room.
static void draw_heading(learn_state *learn, sl_box box) {
    ui_state *ui = learn->ui;
    const double t = ui->text, y = box.min.y + 1.5 * t;
    const lesson_state *lesson = &learn->lesson;
    char text[160], line[64] = "";
    const double left = box.min.x + 0.9 * t, right = box.max.x - 0.9 * t;
    const double x = left + ui_text_width(ui, 1, true, "Lines as points") + 0.8 * t;
    if (lesson->end_count)
        snprintf(text, sizeof text, "%u half-planes: %s", 2 * lesson->end_count,
                 lesson->dual.corner_count ? "what all leave is green" : "nothing is left");
    else
        snprintf(text, sizeof text, "no portal is crossed yet: every line counts");
    if (lesson->end_count) write_line(lesson->line, line);
    const double used = ui_text_width(ui, 0.95, false, line);
    if (x > right)
        ui_text_within(ui, left, y, right - left, 1, ui->palette.ink, "Lines as points");
    else
        ui_text(ui, left, y, 1, true, ui->palette.ink, "Lines as points");
    if (*line && x + used <= right) ui_text_right(ui, right, y, 0.95, ui->palette.ink, line);
    const double end = *line ? right - used - 1.5 * t : right;
    if (x + ui_text_width(ui, 0.95, false, text) <= end)
        ui_text(ui, x, y, 0.95, false, ui->palette.faint, text);
}

static void draw_dual(learn_state *learn, sl_box box) {
    ui_state *ui = learn->ui;
    const double t = ui->text;
    lesson_state *lesson = &learn->lesson;
    if (box_height(box) < 3 * t) return; // too low for anything
    draw_heading(learn, box);
    if (!lesson->end_count) return;
    const sl_dual_frame frame = frame_of(learn, box);
    const double least = fmin(frame.height, 0.5 * frame.width); // labels leave room for the lines
    sl_status status;
    sl_stab_end end;
    sl_dual_marks marks = {.conflict = lesson_conflict(learn->context, lesson, &status),
                           .text = fmin(0.85 * t, fmax(least / 9, 8))};
    if (lesson_marked(lesson, &end)) marks.end = &end;
    sl_draw_dual(ui->cairo, &ui->palette, &frame, &lesson->dual, lesson->ends, lesson->end_count,
                 lesson->line, &marks);
    if (lesson_chosen(lesson) == CHOSEN_LINE) {
        const sl_point at = sl_dual_frame_point(&frame, lesson->line);
        cairo_new_path(ui->cairo);
        cairo_arc(ui->cairo, at.x, at.y, 0.8 * t, 0, 6.283185307179586);
        sl_set_colour(ui->cairo, ui->palette.ink);
        cairo_set_line_width(ui->cairo, 0.15 * t);
        cairo_stroke(ui->cairo);
    }
    sl_text_show_within(
        ui->cairo, ui->palette.faint, frame.left, frame.top + frame.height + 1.2 * t, frame.width,
        0.85 * t, false,
        box_width(box) < 48 * t
            ? "a: slope \xe2\x86\x92   b: height \xe2\x86\x91"
            : "a: slope \xe2\x86\x92   b: height \xe2\x86\x91   L: left ends, from above   "
              "R: right ends, from below   bar: the best line and its margin");
    ui_hit_focus(
        ui, HIT_DUAL, 0,
        (sl_box){{frame.left, frame.top}, {frame.left + frame.width, frame.top + frame.height}});
}

void pane_dual(learn_state *learn, sl_box box) {
    ui_state *ui = learn->ui;
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    draw_dual(learn, box);
    ui_end_area(ui);
}

void pane_dual_drag(learn_state *learn, sl_box box, sl_point to) {
    if (!learn->lesson.end_count) return;
    const sl_dual_frame frame = frame_of(learn, box);
    lesson_move_line(&learn->lesson, sl_dual_frame_line(&frame, to));
}

/// Near an end of the shown line it turns about the other end; between the ends it is shifted.
void pane_plan_drag_line(learn_state *learn, sl_point from, sl_point to) {
    lesson_state *lesson = &learn->lesson;
    if (!lesson->end_count) return;
    const sl_point a = sl_dual_point(&lesson->dual, from), b = sl_dual_point(&lesson->dual, to);
    sl_dual_line line = lesson->line;
    const double pivot = a.x > 0.35 ? -1 : a.x < -0.35 ? 1 : 0;
    if (pivot == 0) {
        line.height = b.y - line.slope * b.x;
    } else if (fabs(b.x - pivot) > 0.05) {
        const double at = line.slope * pivot + line.height;
        line.slope = fmin(fmax((b.y - at) / (b.x - pivot), -SL_DUAL_SLOPE), SL_DUAL_SLOPE);
        line.height = at - line.slope * pivot;
    }
    lesson_move_line(lesson, line);
}

/// Pixels of the plan or of the dual plane for one press of an arrow.
#define NUDGE 4

void pane_dual_nudge(learn_state *learn, sl_box box, int x, int y) {
    lesson_state *lesson = &learn->lesson;
    const uint32_t chosen = lesson_chosen(lesson);
    const double step = NUDGE * ui_scale(learn->ui);
    if (chosen == CHOSEN_NONE || !(learn->view->camera.scale > 0)) return;
    lesson_keep(lesson, chosen);
    if (chosen == CHOSEN_LINE) {
        const sl_dual_frame f = frame_of(learn, box);
        lesson_move_line(
            lesson,
            (sl_dual_line){lesson->line.slope + x * step * (f.high.slope - f.low.slope) / f.width,
                           lesson->line.height +
                               y * step * (f.high.height - f.low.height) / f.height});
        return;
    }
    const sl_portal_ends *ends = &lesson->ends[chosen / 2];
    const sl_point at = chosen % 2 ? ends->right : ends->left;
    const double by = step / learn->view->camera.scale;
    lesson_move_end(lesson, chosen, (sl_point){at.x + x * by, at.y + y * by});
}

uint32_t pane_plan_end_at(const learn_state *learn, sl_point at) {
    const lesson_state *lesson = &learn->lesson;
    double nearest = 8 * ui_scale(learn->ui) / learn->view->camera.scale;
    uint32_t found = UINT32_MAX;
    for (uint32_t i = 0; i < 2 * lesson->end_count; i++) {
        const sl_point p = i % 2 ? lesson->ends[i / 2].right : lesson->ends[i / 2].left;
        const double distance = hypot(p.x - at.x, p.y - at.y);
        if (distance > nearest) continue;
        nearest = distance;
        found = i;
    }
    return found;
}

/// The end whose border is under a place of the dual plane.
static uint32_t border_at(learn_state *learn, sl_box box, sl_point at) {
    const lesson_state *lesson = &learn->lesson;
    const sl_dual_frame f = frame_of(learn, box);
    const sl_dual_line line = sl_dual_frame_line(&f, at);
    double nearest = 6 * f.unit;
    uint32_t found = UINT32_MAX;
    for (uint32_t i = 0; i < 2 * lesson->end_count; i++) {
        const sl_point p = sl_dual_point(&lesson->dual, i % 2 ? lesson->ends[i / 2].right
                                                              : lesson->ends[i / 2].left);
        const double height = p.y - line.slope * p.x;
        const sl_point on = sl_dual_frame_point(&f, (sl_dual_line){line.slope, height});
        if (fabs(on.y - at.y) > nearest) continue;
        nearest = fabs(on.y - at.y);
        found = i;
    }
    return found;
}

/// The step under a place of the time line, from 1.
static size_t step_at(const learn_state *learn, const hit_area *hit, sl_point at) {
    const size_t length = lesson_length(&learn->lesson);
    if (!length) return 0;
    const double share = ui_slider_at(learn->ui, hit->box, at);
    return 1 + (size_t)round(share * (double)(length - 1));
}

void pane_dual_hover(learn_state *learn, sl_box box) {
    lesson_state *lesson = &learn->lesson;
    const hit_area *over = &learn->ui->over;
    const sl_point at = learn->ui->pointer;
    uint32_t end = UINT32_MAX;
    lesson->hovered = 0;
    lesson->hovered_step = 0;
    if (learn->view->mode != MODE_LEARN || !lesson_shows(lesson, learn->document)) return;
    if (over->kind == HIT_TIME) lesson->hovered_step = step_at(learn, over, at);
    if (!lesson->end_count) return;
    if (over->kind == HIT_END) end = (uint32_t)over->value;
    if (over->kind == HIT_DUAL) end = border_at(learn, box, at);
    if (over->kind == HIT_PLAN)
        end = pane_plan_end_at(learn, camera_point(&learn->view->camera, learn->view->plan[0], at));
    if (end < 2 * lesson->end_count) lesson->hovered = end + 1;
}
