/// The buttons at the top, the line at the bottom, the time line.
#include "panes.h"

#include "actions.h"
#include "sightline/canvas.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static double put_button(sl_app *app, double x, const char *name) {
    size_t count;
    const int number = sl_action_find(name);
    const sl_action *a = &sl_actions(&count)[number];
    const double t = app->ui.text;
    return sl_ui_button(&app->ui, x, 0.35 * t, 1.6 * t, a->label, a->on && a->on(app), number) +
           0.35 * t;
}

void sl_pane_bar(sl_app *app, sl_box box) {
    sl_ui *ui = &app->ui;
    const double t = ui->text;
    sl_ui_fill(ui, box, ui->palette.page);
    sl_ui_line(ui, box.min.x, box.max.y - 0.5, box.max.x, box.max.y - 0.5, ui->palette.outline);
    sl_ui_hit(ui, SL_HIT_PANEL, 0, box);
    static const char *const modes[] = {"explore", "learn", "draw", "quiz"};
    static const char *const others[] = {"maps", "fit", "undo", "redo", "save_png"};
    static const char *const right[] = {"dark", "side_panel", "help"};
    double x = 0.6 * t;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) x = put_button(app, x, modes[i]);
    x += 0.8 * t;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) x = put_button(app, x, others[i]);
    if (app->mode == SL_MODE_EXPLORE) x = put_button(app, x, "compare");
    double from = box.max.x - 0.25 * t;
    size_t count;
    for (size_t i = 0; i < sizeof right / sizeof *right; i++) {
        const char *label = sl_actions(&count)[sl_action_find(right[i])].label;
        from -= sl_ui_text_width(ui, 0.95, false, label) + 1.65 * t;
    }
    if (from < x) return;
    for (size_t i = 0; i < sizeof right / sizeof *right; i++)
        from = put_button(app, from, right[i]);
}

static void draw_progress(sl_app *app, sl_box box) {
    sl_ui *ui = &app->ui;
    const sl_document_progress p = sl_app_progress(app);
    const double t = ui->text, wide = 11 * t;
    char text[96];
    snprintf(text, sizeof text, "%s%s", p.stage ? p.stage : "", p.share >= 0 ? "" : " ...");
    for (char *at = text; *at; at++)
        if (*at == '_') *at = ' ';
    const double middle = (box.min.y + box.max.y) / 2, stop = box.max.x - 7.5 * t;
    sl_ui_button(ui, stop, box.min.y + 0.15 * t, 1.6 * t, "Stop (Esc)", false,
                 sl_action_find("escape"));
    const double x = stop - wide - 0.6 * t;
    sl_ui_fill_round(ui, (sl_box){{x, middle - 0.3 * t}, {x + wide, middle + 0.3 * t}}, 0.3 * t,
                     ui->palette.outline);
    if (p.share > 0.05)
        sl_ui_fill_round(
            ui, (sl_box){{x, middle - 0.3 * t}, {x + wide * fmin(p.share, 1), middle + 0.3 * t}},
            0.3 * t, ui->palette.glass);
    sl_ui_text_right(ui, x - 0.6 * t, middle + 0.36 * t, 0.95, ui->palette.ink, text);
}

void sl_pane_status(sl_app *app, sl_box box) {
    sl_ui *ui = &app->ui;
    const double t = ui->text, base = box.max.y - 0.62 * t;
    sl_ui_fill(ui, box, ui->palette.page);
    sl_ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    sl_ui_hit(ui, SL_HIT_PANEL, 0, box);
    char text[160];
    const bool works = sl_app_progress(app).running;
    if (works) {
        draw_progress(app, box);
    } else {
        const sl_baked *baked = app->document.baked;
        const bool partial = baked && sl_partial_begun(&baked->partial);
        const char *doing = app->recorder.records ? "recording"
                            : app->recorder.plays ? "playing"
                            : partial             ? "a partial bake"
                                                  : "";
        if (app->steady || app->frame_seconds <= 0)
            snprintf(text, sizeof text, "%s", doing);
        else
            snprintf(text, sizeof text, "%s   %.1f ms a frame", doing, 1e3 * app->frame_seconds);
        sl_ui_text_right(ui, box.max.x - 0.8 * t, base, 0.95, ui->palette.faint, text);
    }
    const sl_colour colour = app->message_is_error ? ui->palette.start : ui->palette.ink;
    sl_text_show_within(ui->cairo, colour, 0.8 * t, base, box.max.x - (works ? 30 : 15) * t,
                        0.95 * t, false, app->message);
}

void sl_pane_time(sl_app *app, sl_box box) {
    sl_ui *ui = &app->ui;
    const double t = ui->text;
    const sl_lesson *lesson = &app->lesson;
    sl_ui_fill(ui, box, ui->palette.page);
    sl_ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    sl_ui_hit(ui, SL_HIT_PANEL, 0, box);
    char text[SL_SENTENCE];
    sl_lesson_sentence(lesson, &app->document, text);
    sl_text_show_within(ui->cairo, ui->palette.ink, box.min.x + 0.9 * t, box.min.y + 1.55 * t,
                        sl_box_width(box) - 1.8 * t, 1.12 * t, false, text);
    const double y = box.min.y + 2.5 * t;
    static const char *const buttons[] = {"step_first", "step_back", "play_steps", "step_next",
                                          "step_last"};
    double x = box.min.x + 0.7 * t;
    size_t count;
    for (size_t i = 0; i < sizeof buttons / sizeof *buttons; i++) {
        const int number = sl_action_find(buttons[i]);
        const sl_action *a = &sl_actions(&count)[number];
        x = sl_ui_button(ui, x, y, 1.6 * t, a->label, a->on && a->on(app), number) + 0.35 * t;
    }
    const size_t length = sl_lesson_length(lesson);
    snprintf(text, sizeof text, "%zu of %zu", length ? lesson->at + 1 : 0, length);
    // A narrow window has room for the buttons, then for the count, then for the line.
    const double left = box.max.x - 0.9 * t - sl_ui_text_width(ui, 0.95, false, text);
    if (left < x) return;
    sl_ui_text_right(ui, box.max.x - 0.9 * t, y + 1.15 * t, 0.95, ui->palette.faint, text);
    const sl_box line = {{x + t, y}, {left - 1.1 * t, y + 1.6 * t}};
    if (sl_box_width(line) < 3 * t) return;
    sl_ui_slider(ui, line, length > 1 ? (double)lesson->at / (double)(length - 1) : 0, SL_HIT_TIME,
                 0);
}
