/// The bars at the top and at the bottom, the time line of the lesson, and the help over all.
#include "actions.h"
#include "modes.h"
#include "sightline/canvas.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- bars

static double put_button(app_state *app, double x, const char *name) {
    size_t count;
    const int number = action_find(name);
    const action_row *a = &action_table(&count)[number];
    const double t = app->ui.text;
    return ui_button(&app->ui, x, 0.35 * t, 1.6 * t, a->label, a->on && a->on(app), number) +
           0.35 * t;
}

void pane_bar(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    ui_fill(ui, box, ui->palette.page);
    ui_line(ui, box.min.x, box.max.y - 0.5, box.max.x, box.max.y - 0.5, ui->palette.outline);
    ui_hit(ui, HIT_PANEL, 0, box);
    static const char *const modes[] = {"explore", "learn", "draw", "quiz"};
    static const char *const others[] = {"file", "open", "save", "fit", "undo", "redo"};
    static const char *const right[] = {"dark", "side_panel", "help"};
    double x = 0.6 * t;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) x = put_button(app, x, modes[i]);
    x += 0.8 * t;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) x = put_button(app, x, others[i]);
    if (app->tool.mode == MODE_EXPLORE) x = put_button(app, x, "compare");
    double from = box.max.x - 0.25 * t;
    size_t count;
    for (size_t i = 0; i < sizeof right / sizeof *right; i++) {
        const char *label = action_table(&count)[action_find(right[i])].label;
        from -= ui_text_width(ui, 0.95, false, label) + 1.65 * t;
    }
    if (from < x) return;
    for (size_t i = 0; i < sizeof right / sizeof *right; i++)
        from = put_button(app, from, right[i]);
}

static void draw_progress(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const job_progress p = app_progress(app);
    const double t = ui->text, wide = 11 * t;
    char text[96];
    snprintf(text, sizeof text, "%s%s", p.stage ? p.stage : "", p.share >= 0 ? "" : " ...");
    for (char *at = text; *at; at++)
        if (*at == '_') *at = ' ';
    const double middle = (box.min.y + box.max.y) / 2, stop = box.max.x - 7.5 * t;
    ui_button(ui, stop, box.min.y + 0.15 * t, 1.6 * t, "Stop (Esc)", false, action_find("escape"));
    const double x = stop - wide - 0.6 * t;
    ui_fill_round(ui, (sl_box){{x, middle - 0.3 * t}, {x + wide, middle + 0.3 * t}}, 0.3 * t,
                  ui->palette.outline);
    if (p.share > 0.05)
        ui_fill_round(
            ui, (sl_box){{x, middle - 0.3 * t}, {x + wide * fmin(p.share, 1), middle + 0.3 * t}},
            0.3 * t, ui->palette.glass);
    ui_text_right(ui, x - 0.6 * t, middle + 0.36 * t, 0.95, ui->palette.ink, text);
}

void pane_status(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const double t = ui->text, base = box.max.y - 0.62 * t;
    ui_fill(ui, box, ui->palette.page);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    ui_hit(ui, HIT_PANEL, 0, box);
    char text[160];
    const bool works = app_progress(app).running;
    if (works) {
        draw_progress(app, box);
    } else {
        const sl_baked *baked = app->document.baked;
        const bool partial = baked && sl_partial_begun(&baked->partial);
        const char *doing = app->tool.recorder.records ? "recording"
                            : app->tool.recorder.plays ? "playing"
                            : partial                  ? "a partial bake"
                                                       : "";
        if (app->steady || app->ui.frame_seconds <= 0)
            snprintf(text, sizeof text, "%s", doing);
        else
            snprintf(text, sizeof text, "%s   %.1f ms a frame", doing, 1e3 * app->ui.frame_seconds);
        ui_text_right(ui, box.max.x - 0.8 * t, base, 0.95, ui->palette.faint, text);
    }
    const sl_colour colour = ui->message_is_error     ? ui->palette.start
                             : ui->message_is_working ? ui->palette.faint
                                                      : ui->palette.ink;
    sl_text_show_within(ui->cairo, colour, 0.8 * t, base, box.max.x - (works ? 30 : 15) * t,
                        0.95 * t, false, app->ui.message);
}

void pane_time(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    const lesson_state *lesson = &app->tool.lesson;
    ui_fill(ui, box, ui->palette.page);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    ui_hit(ui, HIT_PANEL, 0, box);
    char text[SENTENCE];
    lesson_sentence(lesson, &app->document, text);
    sl_text_show_within(ui->cairo, ui->palette.ink, box.min.x + 0.9 * t, box.min.y + 1.55 * t,
                        box_width(box) - 1.8 * t, 1.12 * t, false, text);
    const double y = box.min.y + 2.5 * t;
    static const char *const buttons[] = {"step_first", "step_back", "play_steps", "step_next",
                                          "step_last"};
    double x = box.min.x + 0.7 * t;
    size_t count;
    for (size_t i = 0; i < sizeof buttons / sizeof *buttons; i++) {
        const int number = action_find(buttons[i]);
        const action_row *a = &action_table(&count)[number];
        x = ui_button(ui, x, y, 1.6 * t, a->label, a->on && a->on(app), number) + 0.35 * t;
    }
    const size_t length = lesson_length(lesson);
    snprintf(text, sizeof text, "%zu of %zu", length ? lesson->at + 1 : 0, length);
    // A narrow window has room for the buttons, then for the count, then for the line.
    const double left = box.max.x - 0.9 * t - ui_text_width(ui, 0.95, false, text);
    if (left < x) return;
    ui_text_right(ui, box.max.x - 0.9 * t, y + 1.15 * t, 0.95, ui->palette.faint, text);
    const sl_box line = {{x + t, y}, {left - 1.1 * t, y + 1.6 * t}};
    if (box_width(line) < 3 * t) return;
    ui_slider(ui, line, length > 1 ? (double)lesson->at / (double)(length - 1) : 0, HIT_TIME, 0);
}

// --- over all

static sl_box begin_sheet(ui_state *ui, double width, double height, const char *title) {
    const double t = ui->text;
    const sl_box all = {{0, 0}, {ui->width, ui->height}};
    ui_hit(ui, HIT_PANEL, 1, all);
    const sl_colour dim = ui->palette.dark ? ui->palette.page : ui->palette.ink;
    cairo_set_source_rgba(ui->cairo, dim.red, dim.green, dim.blue, 0.45);
    cairo_paint(ui->cairo);
    const double w = fmin(width, ui->width - 2 * t), h = fmin(height, ui->height - 2 * t);
    const sl_box sheet = {{floor((ui->width - w) / 2), floor((ui->height - h) / 2)},
                          {floor((ui->width + w) / 2), floor((ui->height + h) / 2)}};
    ui_fill_round(ui, sheet, 0.6 * t, ui->palette.page);
    ui_text(ui, sheet.min.x + 1.5 * t, sheet.min.y + 2.2 * t, 1.3, true, ui->palette.ink, title);
    return sheet;
}

enum { MOUSE = 4 };

void pane_help(app_state *app) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    size_t count, shown = 0;
    const action_row *actions = action_table(&count);
    for (size_t i = 0; i < count; i++) shown += actions[i].key != NULL;
    const sl_box sheet =
        begin_sheet(&app->ui, 74 * t, 44 * t, "Keys and mouse; a click on a line does it");
    const int columns = 2;
    const size_t rows = (shown + MOUSE + columns - 1) / columns;
    const double top = sheet.min.y + 3.4 * t, column = (box_width(sheet) - 2 * t) / columns;
    const double high = fmin(1.55 * t, (sheet.max.y - top - 1.2 * t) / (double)rows);
    const double size = fmin(1, high / (1.3 * t));
    static const char *const mouse[MOUSE][2] = {
        {"Drag", "pan; middle button: look"},
        {"Wheel", "zoom to the pointer"},
        {"Click", "puts the eye; right: why is a cell seen or not?"},
        {"On things", "drag a mirror, an object; click on a door, an object"},
    };
    size_t at = 0;
    for (size_t i = 0; i < count + MOUSE; i++) {
        const char *key = i < MOUSE ? mouse[i][0] : actions[i - MOUSE].key;
        const char *help = i < MOUSE ? mouse[i][1] : actions[i - MOUSE].help;
        if (!key) continue;
        const double x = sheet.min.x + 1.5 * t + column * (double)(at / rows);
        const double y = top + high * ((double)(at % rows) + 0.7);
        const sl_box row = {{x - 0.4 * t, y - 0.75 * high}, {x + column - t, y + 0.25 * high}};
        if (i >= MOUSE && actions[i - MOUSE].run) {
            if (box_has(row, ui->pointer))
                ui_fill_round(ui, row, 0.25 * t,
                              sl_colour_mix(ui->palette.page, ui->palette.glass, 0.2));
            ui_hit(ui, HIT_ACTION, (int)i - MOUSE, row);
        }
        ui_text(ui, x, y, size, true, ui->palette.glass, key);
        sl_text_show_within(ui->cairo, ui->palette.ink, x + 7.2 * t * size, y,
                            column - 7.6 * t * size, size * t, false, help);
        at++;
    }
}
