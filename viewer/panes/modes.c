/// Two tables: the modes, with what each draws and says; and the panes below the plan, with when
/// each is shown.
#include "panes/modes.h"

#include "lessons/quiz.h"
#include "panes/panes.h"
#include "plan/cameras.h"
#include "plan/compare.h"
#include "plan/edit.h"
#include "plan/effects.h"
#include "plan/from_line.h"
#include "plan/layer_draw.h"
#include "plan/line_map.h"
#include "plan/room_map.h"
#include "plan/route.h"
#include "plan/table.h"
#include "sightline/draw.h"

#include <math.h>

// --- modes

/// Outlines the cells that a method keeps, while the pointer is over its row of the table.
static void draw_kept(view_state *view, const sl_frame *frame) {
    const hit_area *over = &view->ui->over;
    const sl_space *space = &view->document->baked->space;
    if (over->kind != HIT_METHOD || !view->seen.valid) return;
    const seen_method *method = &view->seen.methods[over->value];
    for (uint32_t cell = 0; method->known && cell < space->cell_count; cell++)
        if (sl_eye_sees(method->cells, cell))
            sl_draw_cell(view->ui->cairo, space, frame, cell, view->ui->palette.start, 0,
                         2.2 * frame->unit);
}

/// What a right click explains stands in place of the step.
static void lesson_below(learn_state *learn, const sl_frame *frame) {
    const subject_row *subject = lesson_subject(&learn->lesson);
    if (learn->quiz.answered)
        quiz_draw_below(learn, frame);
    else if (subject->below && lesson_shows(&learn->lesson, learn->document))
        subject->below(learn, frame);
}

/// Marks the ends that leave no line, the end and the step under the pointer, and what keys chose.
static void draw_lesson_marks(learn_state *learn, const sl_frame *frame) {
    lesson_state *lesson = &learn->lesson;
    const subject_row *subject = lesson_subject(lesson);
    const double unit = frame->unit;
    sl_status status;
    sl_stab_end end;
    const sl_conflict *conflict = lesson_conflict(learn->context, lesson, &status);
    view_check(learn->view, status);
    // With open sight a line that only grazes is no sightline.
    const bool rejected = subject->rejects && subject->rejects(lesson, lesson->at);
    if (conflict->verdict == SL_HIDDEN || (conflict->verdict == SL_GRAZING && rejected))
        sl_draw_conflict(learn->ui->cairo, &learn->ui->palette, frame, lesson->ends, conflict);
    if (lesson_marked(lesson, &end)) {
        const sl_portal_ends *at = &lesson->ends[end.portal];
        sl_draw_ring(learn->ui->cairo, frame, end.left ? at->left : at->right, 10 * unit,
                     learn->ui->palette.ink, 2.5 * unit);
    }
    const size_t step = lesson->hovered_step;
    if (step && subject->cell && subject->cell(lesson, step - 1) != SL_NO_CELL)
        sl_draw_cell(learn->ui->cairo, &learn->document->baked->space, frame,
                     subject->cell(lesson, step - 1), learn->ui->palette.start, 0.15, 3 * unit);
}

static void lesson_above(learn_state *learn, const sl_frame *frame) {
    const subject_row *subject = lesson_subject(&learn->lesson);
    if (learn->quiz.answered) {
        quiz_draw_above(learn, frame);
        return;
    }
    if (!lesson_shows(&learn->lesson, learn->document)) return;
    if (subject->above) subject->above(learn, frame);
    draw_lesson_marks(learn, frame);
}

static void edit_above(learn_state *learn, const sl_frame *frame) {
    edit_draw(learn->view, frame);
}

static void cameras_below(learn_state *learn, const sl_frame *frame) {
    cameras_draw_below(learn->view, frame);
}

static void cameras_above(learn_state *learn, const sl_frame *frame) {
    cameras_draw_above(learn->view, frame);
}

static void plan_below(learn_state *learn, const sl_frame *frame) {
    if (learn->view->tool == TOOL_FROM_LINE) from_line_draw_below(learn->view, frame);
}

static void plan_above(learn_state *learn, const sl_frame *frame) {
    if (learn->view->tool == TOOL_FROM_LINE) from_line_draw_above(learn->view, frame);
    line_map_draw(learn->view, frame);
    compare_draw(learn->view, frame);
    room_map_draw(learn->view, frame);
    if (learn->view->tool == TOOL_PATH) route_draw(learn->view, frame);
    table_draw_chosen(learn->view, frame);
}

static const mode_row modes[MODES] = {
    [MODE_EXPLORE] = {"W A S D and arrows walk, a click puts the eye, the wheel zooms", pane_side,
                      quiz_draw_below, quiz_draw_above, true, true},
    [MODE_LEARN] = {"Left and Right step, Space plays, . chooses the line or an end", pane_learn,
                    lesson_below, lesson_above, true, false},
    [MODE_DRAW] =
        {"Drag to draw a wall, or to move a wall, a corner or a door; X draws doors; Ctrl+Z undoes",
         pane_draw, NULL, edit_above, true, false},
    [MODE_QUIZ] = {"Y or N answers, Space asks again", pane_quiz, quiz_draw_below, quiz_draw_above,
                   false, false},
    [MODE_CAMERAS] = {"A click puts a camera; drag it, or its handle; Space finds the fewest",
                      pane_cameras, cameras_below, cameras_above, false, false},
    [MODE_PLAN] = {"A click puts the viewpoint; 1 shows the visibility graph, 2 the next measure",
                   pane_measures, plan_below, plan_above, true, true},
};

const mode_row *mode_table(void) {
    return modes;
}

void modes_draw_below(learn_state *learn, const sl_frame *frame, int index) {
    const mode_row *mode = &modes[learn->view->mode];
    layers_draw(learn->view, frame, index);
    if (mode->below) mode->below(learn, frame);
}

/// Says why an eye in solid ground sees nothing.
static void draw_rock_note(ui_state *ui, const sl_frame *frame) {
    static const char text[] = "The eye is in solid ground and sees nothing. Click in a room.";
    const double t = ui->text, middle = frame->left + frame->width / 2;
    const double wide = fmin(ui_text_width(ui, 1, true, text) + 1, frame->width - 3 * t);
    const double high = ui_lines_height(ui, wide, 1, true, text);
    if (high > 0.5 * frame->height) return; // the panel says it too
    const double bottom = frame->top + frame->height - 0.8 * t, left = middle - wide / 2;
    ui_fill_round(
        ui, (sl_box){{left - 0.6 * t, bottom - high - 0.5 * t}, {left + wide + 0.6 * t, bottom}},
        0.3 * t, ui->palette.page);
    ui_lines(ui, left, bottom - high + 0.75 * t, wide, 1, true, ui->palette.ink, text);
}

void modes_draw_above(learn_state *learn, const sl_frame *frame) {
    view_state *view = learn->view;
    ui_state *ui = view->ui;
    const mode_row *mode = &modes[view->mode];
    if (mode->above) mode->above(learn, frame);
    draw_kept(view, frame);
    const bool paints = view->mode == MODE_PLAN && tool_paints(view->tool);
    if (mode->cone && !paints)
        sl_draw_cone(ui->cairo, frame, view->eye.at, view->eye.heading, view->eye.fov,
                     78 * ui_scale(ui), ui->palette.start);
    if (mode->eye) range_draw(view, frame);
    if (mode->eye) mirror_draw(view, frame);
    if (view->mode == MODE_EXPLORE) object_draw(view, frame);
    if (mode->eye && !paints)
        sl_draw_eye_mark(ui->cairo, &ui->palette, frame, view->eye.at, view->eye.heading,
                         6.5 * ui_scale(ui));
    if (mode->eye && !paints && view_is_solid(view, view->eye.at)) draw_rock_note(ui, frame);
}

// --- panes below the plan

static bool dual_shown(const learn_state *learn) {
    return learn->view->mode == MODE_LEARN && lesson_subject(&learn->lesson)->sequence;
}

static bool program_shown(const learn_state *learn) {
    return learn->ui->program && dual_shown(learn);
}

static bool first_person_shown(const learn_state *learn) {
    return learn->ui->first_person;
}

static bool account_shown(const learn_state *learn) {
    return learn->ui->accounts;
}

/// A first door that is drawn must not move the plan, so not in Draw mode.
static bool effects_shown(const learn_state *learn) {
    const bool looks = learn->view->mode == MODE_EXPLORE || learn->view->mode == MODE_QUIZ;
    return learn->ui->effects && looks && learn->document->baked &&
           sl_plan_make(&learn->document->map).effects;
}

static double effects_lines(const learn_state *learn) {
    return 4.5 + 1.5 * __builtin_popcount(sl_plan_make(&learn->document->map).effects);
}

static bool table_shown(const learn_state *learn) {
    return learn->ui->table && learn->view->mode == MODE_PLAN;
}

static const pane_below panes[PANES_BELOW] = {
    [PANE_DUAL] = {dual_shown, pane_dual, NULL},
    [PANE_PROGRAM] = {program_shown, pane_program, NULL},
    [PANE_FIRST_PERSON] = {first_person_shown, pane_first_person, NULL},
    [PANE_ACCOUNT] = {account_shown, pane_account, NULL},
    [PANE_EFFECTS] = {effects_shown, pane_effects, effects_lines},
    [PANE_TABLE] = {table_shown, pane_table, NULL},
};

const pane_below *panes_below(void) {
    return panes;
}
