#include "modes.h"

#include "edit.h"
#include "layers.h"
#include "mirrors.h"
#include "objects.h"
#include "panes.h"
#include "quiz.h"
#include "range.h"
#include "sightline/canvas.h"

static void lesson_below(sl_app *app, const sl_frame *frame) {
    const sl_subject *subject = sl_lesson_subject(&app->lesson);
    if (subject->below && sl_lesson_shows(&app->lesson, &app->document)) subject->below(app, frame);
}

static void lesson_above(sl_app *app, const sl_frame *frame) {
    const sl_subject *subject = sl_lesson_subject(&app->lesson);
    if (subject->above && sl_lesson_shows(&app->lesson, &app->document)) subject->above(app, frame);
}

static const sl_mode_row modes[] = {
    [SL_MODE_EXPLORE] = {"W A S D and arrows walk, a click puts the eye, the wheel zooms",
                         sl_pane_side, NULL, sl_quiz_draw_above, true, true},
    [SL_MODE_LEARN] = {"Left and Right step, Space plays, U changes the subject", sl_pane_learn,
                       lesson_below, lesson_above, true, false},
    [SL_MODE_DRAW] = {"Drag to draw a wall or to move one; Ctrl+Z undoes", sl_pane_draw, NULL,
                      sl_edit_draw, true, false},
    [SL_MODE_QUIZ] = {"Y or N answers, Space asks again", sl_pane_quiz, sl_quiz_draw_below,
                      sl_quiz_draw_above, false, false},
};

const sl_mode_row *sl_mode_rows(void) {
    return modes;
}

void sl_modes_draw_below(sl_app *app, const sl_frame *frame, int index) {
    const sl_mode_row *mode = &modes[app->mode];
    sl_layers_draw(app, frame, index);
    if (mode->below) mode->below(app, frame);
}

void sl_modes_draw_above(sl_app *app, const sl_frame *frame) {
    const sl_mode_row *mode = &modes[app->mode];
    const sl_palette *palette = &app->ui.palette;
    if (mode->above) mode->above(app, frame);
    if (mode->cone)
        sl_draw_cone(app->ui.cairo, frame, app->eye.at, app->eye.heading, app->eye.fov,
                     6 * app->ui.text, palette->start);
    if (mode->eye) sl_range_draw(app, frame);
    if (mode->eye) sl_mirror_draw(app, frame);
    if (app->mode == SL_MODE_EXPLORE) sl_object_draw(app, frame);
    if (mode->eye)
        sl_draw_eye_mark(app->ui.cairo, palette, frame, app->eye.at, app->eye.heading,
                         0.5 * app->ui.text);
}
