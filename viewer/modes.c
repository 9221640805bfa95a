/// Two tables: the modes, with what each draws and says; and the panes below the plan, with when
/// each is shown.
#include "modes.h"

#include "edit.h"
#include "effects.h"
#include "layers.h"
#include "quiz.h"
#include "sightline/canvas.h"

#include <math.h>

// --- modes

static void lesson_below(app_state *app, const sl_frame *frame) {
    const subject_row *subject = lesson_subject(&app->tool.lesson);
    if (subject->below && lesson_shows(&app->tool.lesson, &app->document))
        subject->below(app, frame);
}

static void lesson_above(app_state *app, const sl_frame *frame) {
    const subject_row *subject = lesson_subject(&app->tool.lesson);
    if (subject->above && lesson_shows(&app->tool.lesson, &app->document))
        subject->above(app, frame);
}

static const mode_row modes[] = {
    [MODE_EXPLORE] = {"W A S D and arrows walk, a click puts the eye, the wheel zooms", pane_side,
                      NULL, quiz_draw_above, true, true},
    [MODE_LEARN] = {"Left and Right step, Space plays, U changes the subject", pane_learn,
                    lesson_below, lesson_above, true, false},
    [MODE_DRAW] = {"Drag to draw a wall, or to move a wall, a corner or a door; Ctrl+Z undoes",
                   pane_draw, NULL, edit_draw, true, false},
    [MODE_QUIZ] = {"Y or N answers, Space asks again", pane_quiz, quiz_draw_below, quiz_draw_above,
                   false, false},
};

const mode_row *mode_table(void) {
    return modes;
}

void modes_draw_below(app_state *app, const sl_frame *frame, int index) {
    const mode_row *mode = &modes[app->tool.mode];
    layers_draw(app, frame, index);
    if (mode->below) mode->below(app, frame);
}

/// Says why an eye in solid ground sees nothing.
static void draw_rock_note(app_state *app, const sl_frame *frame) {
    static const char text[] = "The eye is in solid ground and sees nothing. Click in a room.";
    ui_state *ui = &app->ui;
    const double t = ui->text, middle = frame->left + frame->width / 2;
    const double half = fmin(ui_text_width(ui, 1, true, text), frame->width - 3 * t) / 2;
    const double base = frame->top + frame->height - 1.4 * t;
    ui_fill_round(ui,
                  (sl_box){{middle - half - 0.6 * t, base - 1.3 * t},
                           {middle + half + 0.6 * t, base + 0.6 * t}},
                  0.3 * t, ui->palette.page);
    sl_text_show_within(ui->cairo, ui->palette.ink, middle - half, base, 2 * half, t, true, text);
}

void modes_draw_above(app_state *app, const sl_frame *frame) {
    const mode_row *mode = &modes[app->tool.mode];
    const sl_palette *palette = &app->ui.palette;
    if (mode->above) mode->above(app, frame);
    if (mode->cone)
        sl_draw_cone(app->ui.cairo, frame, app->view.eye.at, app->view.eye.heading,
                     app->view.eye.fov, 6 * app->ui.text, palette->start);
    if (mode->eye) range_draw(app, frame);
    if (mode->eye) mirror_draw(app, frame);
    if (app->tool.mode == MODE_EXPLORE) object_draw(app, frame);
    if (mode->eye)
        sl_draw_eye_mark(app->ui.cairo, palette, frame, app->view.eye.at, app->view.eye.heading,
                         0.5 * app->ui.text);
    if (mode->eye && app_is_solid(app, app->view.eye.at)) draw_rock_note(app, frame);
}

// --- panes below the plan

static bool dual_shown(const app_state *app) {
    return app->tool.mode == MODE_LEARN && lesson_subject(&app->tool.lesson)->sequence;
}

static bool first_person_shown(const app_state *app) {
    return app->ui.first_person;
}

static bool account_shown(const app_state *app) {
    return app->ui.accounts;
}

static bool effects_shown(const app_state *app) {
    return app->ui.effects && app->tool.mode != MODE_LEARN && app->document.baked &&
           sl_plan_make(&app->document.map).effects;
}

static double effects_lines(const app_state *app) {
    return 4.5 + 1.5 * __builtin_popcount(sl_plan_make(&app->document.map).effects);
}

static const pane_below panes[PANES_BELOW] = {
    [PANE_DUAL] = {dual_shown, pane_dual, NULL},
    [PANE_FIRST_PERSON] = {first_person_shown, pane_first_person, NULL},
    [PANE_ACCOUNT] = {account_shown, pane_account, NULL},
    [PANE_EFFECTS] = {effects_shown, pane_effects, effects_lines},
};

const pane_below *panes_below(void) {
    return panes;
}
