/// Two tables: the modes, with what each draws and says; and the panes below the plan, with when
/// each is shown.
#include "app/modes.h"

#include "lessons/quiz.h"
#include "plan/edit.h"
#include "plan/effects.h"
#include "plan/layer_draw.h"
#include "sightline/draw.h"

#include <math.h>

// --- modes

/// Outlines the cells that a method keeps, while the pointer is over its row of the table.
static void draw_kept(app_state *app, const sl_frame *frame) {
    const hit_area *over = &app->ui.over;
    const sl_space *space = &app->document.baked->space;
    if (over->kind != HIT_METHOD || !app->view.seen.valid) return;
    const seen_method *method = &app->view.seen.methods[over->value];
    for (uint32_t cell = 0; method->known && cell < space->cell_count; cell++)
        if (sl_eye_sees(method->cells, cell))
            sl_draw_cell(app->ui.cairo, space, frame, cell, app->ui.palette.start, 0,
                         2.2 * frame->unit);
}

/// What a right click explains stands in place of the step.
static void lesson_below(app_state *app, const sl_frame *frame) {
    const subject_row *subject = lesson_subject(&app->tool.lesson);
    if (app->tool.quiz.answered)
        quiz_draw_below(app, frame);
    else if (subject->below && lesson_shows(&app->tool.lesson, &app->document))
        subject->below(app, frame);
}

/// Marks the ends that leave no line, the end and the step under the pointer, and what keys chose.
static void draw_lesson_marks(app_state *app, const sl_frame *frame) {
    lesson_state *lesson = &app->tool.lesson;
    const subject_row *subject = lesson_subject(lesson);
    const double unit = frame->unit;
    sl_status status;
    sl_stab_end end;
    const sl_conflict *conflict = lesson_conflict(app->context, lesson, &status);
    view_check(&app->view, status);
    // With open sight a line that only grazes is no sightline.
    const bool rejected = subject->rejects && subject->rejects(lesson, lesson->at);
    if (conflict->verdict == SL_HIDDEN || (conflict->verdict == SL_GRAZING && rejected))
        sl_draw_conflict(app->ui.cairo, &app->ui.palette, frame, lesson->ends, conflict);
    if (lesson_marked(lesson, &end)) {
        const sl_portal_ends *at = &lesson->ends[end.portal];
        sl_draw_ring(app->ui.cairo, frame, end.left ? at->left : at->right, 10 * unit,
                     app->ui.palette.ink, 2.5 * unit);
    }
    const size_t step = lesson->hovered_step;
    if (step && subject->cell && subject->cell(lesson, step - 1) != SL_NO_CELL)
        sl_draw_cell(app->ui.cairo, &app->document.baked->space, frame,
                     subject->cell(lesson, step - 1), app->ui.palette.start, 0.15, 3 * unit);
}

static void lesson_above(app_state *app, const sl_frame *frame) {
    const subject_row *subject = lesson_subject(&app->tool.lesson);
    if (app->tool.quiz.answered) {
        quiz_draw_above(app, frame);
        return;
    }
    if (!lesson_shows(&app->tool.lesson, &app->document)) return;
    if (subject->above) subject->above(app, frame);
    draw_lesson_marks(app, frame);
}

static void edit_above(app_state *app, const sl_frame *frame) {
    edit_draw(&app->view, frame);
}

static const mode_row modes[] = {
    [MODE_EXPLORE] = {"W A S D and arrows walk, a click puts the eye, the wheel zooms", pane_side,
                      quiz_draw_below, quiz_draw_above, true, true},
    [MODE_LEARN] = {"Left and Right step, Space plays, . chooses the line or an end", pane_learn,
                    lesson_below, lesson_above, true, false},
    [MODE_DRAW] =
        {"Drag to draw a wall, or to move a wall, a corner or a door; X draws doors; Ctrl+Z undoes",
         pane_draw, NULL, edit_above, true, false},
    [MODE_QUIZ] = {"Y or N answers, Space asks again", pane_quiz, quiz_draw_below, quiz_draw_above,
                   false, false},
};

const mode_row *mode_table(void) {
    return modes;
}

void modes_draw_below(app_state *app, const sl_frame *frame, int index) {
    const mode_row *mode = &modes[app->view.mode];
    layers_draw(&app->view, frame, index);
    if (mode->below) mode->below(app, frame);
}

/// Says why an eye in solid ground sees nothing.
static void draw_rock_note(app_state *app, const sl_frame *frame) {
    static const char text[] = "The eye is in solid ground and sees nothing. Click in a room.";
    ui_state *ui = &app->ui;
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

void modes_draw_above(app_state *app, const sl_frame *frame) {
    const mode_row *mode = &modes[app->view.mode];
    const sl_palette *palette = &app->ui.palette;
    if (mode->above) mode->above(app, frame);
    draw_kept(app, frame);
    if (mode->cone)
        sl_draw_cone(app->ui.cairo, frame, app->view.eye.at, app->view.eye.heading,
                     app->view.eye.fov, 78 * ui_scale(&app->ui), palette->start);
    if (mode->eye) range_draw(&app->view, frame);
    if (mode->eye) mirror_draw(&app->view, frame);
    if (app->view.mode == MODE_EXPLORE) object_draw(&app->view, frame);
    if (mode->eye)
        sl_draw_eye_mark(app->ui.cairo, palette, frame, app->view.eye.at, app->view.eye.heading,
                         6.5 * ui_scale(&app->ui));
    if (mode->eye && view_is_solid(&app->view, app->view.eye.at)) draw_rock_note(app, frame);
}

// --- panes below the plan

static bool dual_shown(const app_state *app) {
    return app->view.mode == MODE_LEARN && lesson_subject(&app->tool.lesson)->sequence;
}

static bool program_shown(const app_state *app) {
    return app->ui.program && dual_shown(app);
}

static bool first_person_shown(const app_state *app) {
    return app->ui.first_person;
}

static bool account_shown(const app_state *app) {
    return app->ui.accounts;
}

/// A first door that is drawn must not move the plan, so not in Draw mode.
static bool effects_shown(const app_state *app) {
    const bool looks = app->view.mode == MODE_EXPLORE || app->view.mode == MODE_QUIZ;
    return app->ui.effects && looks && app->document.baked &&
           sl_plan_make(&app->document.map).effects;
}

static double effects_lines(const app_state *app) {
    return 4.5 + 1.5 * __builtin_popcount(sl_plan_make(&app->document.map).effects);
}

static void draw_effects(app_state *app, sl_box box) {
    pane_effects(&app->view, box);
}

static const pane_below panes[PANES_BELOW] = {
    [PANE_DUAL] = {dual_shown, pane_dual, NULL},
    [PANE_PROGRAM] = {program_shown, pane_program, NULL},
    [PANE_FIRST_PERSON] = {first_person_shown, pane_first_person, NULL},
    [PANE_ACCOUNT] = {account_shown, pane_account, NULL},
    [PANE_EFFECTS] = {effects_shown, draw_effects, effects_lines},
};

const pane_below *panes_below(void) {
    return panes;
}
