/// The bars at the top and at the bottom, and the time line of the lesson.
#include "lessons/quiz.h"
#include "panes/panes.h"
#include "plan/grid.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- bars

static const ui_action *row_of(const ui_state *ui, const char *name) {
    return &ui->actions[ui_action_find(ui, name)];
}

static double put_button(ui_state *ui, double x, double y, const char *name) {
    const ui_action *a = row_of(ui, name);
    const double t = ui->text;
    return ui_button(ui, x, y, 1.6 * t, a->label, a->on, (int)(a - ui->actions)) + 0.35 * t;
}

/// Modes and help are always there. The rest has the room that is left in their lines: what finds
/// none is in the help, where a click does it too.
/// In a presentation the button that ends it is needed too: it is the last one.
static const char *const needed[] = {"plan", "cameras", "explore", "learn",
                                     "draw", "quiz",    "help",    "present"};
static const char *const others[] = {"file", "open",    "save",       "fit",  "undo",
                                     "redo", "compare", "side_panel", "dark", "present"};
enum {
    NEEDED = sizeof needed / sizeof *needed,
    OTHERS = sizeof others / sizeof *others,
};

/// The place of the next button of a width, on this line or the next.
static void flow_on(double *x, int *line, double wide, double left, double right) {
    if (*x > left && *x + wide > right) {
        *x = left;
        ++*line;
    }
}

/// Lays out the buttons, and draws them with `draw`. Returns the number of lines.
static int bar_buttons(view_state *view, double right, bool draw) {
    const double t = view->ui->text, left = 0.6 * t, gap = 0.35 * t;
    double x = left;
    int line = 0;
    for (int i = 0; i < NEEDED - !view->ui->presents; i++) {
        const double wide = ui_button_width(view->ui, row_of(view->ui, needed[i])->label);
        flow_on(&x, &line, wide, left, right);
        if (draw) put_button(view->ui, x, (0.35 + 2 * line) * t, needed[i]);
        x += wide + gap;
    }
    x += 0.8 * t;
    for (int i = 0; i < OTHERS; i++) {
        const double wide = ui_button_width(view->ui, row_of(view->ui, others[i])->label);
        if (view->mode != MODE_EXPLORE && strcmp(others[i], "compare") == 0) continue;
        if (view->ui->presents && strcmp(others[i], "side_panel") == 0) continue;
        if (view->ui->presents && strcmp(others[i], "present") == 0) continue;
        if (x + wide > right) continue;
        if (draw) put_button(view->ui, x, (0.35 + 2 * line) * t, others[i]);
        x += wide + gap;
    }
    return line + 1;
}

void pane_bar_measure(learn_state *learn) {
    learn->ui->bar_rows = bar_buttons(learn->view, learn->ui->width - 0.4 * learn->ui->text, false);
}

void pane_bar(learn_state *learn, sl_box box) {
    ui_state *ui = learn->ui;
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x, box.max.y - 0.5, box.max.x, box.max.y - 0.5, ui->palette.outline);
    bar_buttons(learn->view, box.max.x - 0.4 * ui->text, true);
    ui_end_area(ui);
}

/// The work in the background, at the right end of the line. Returns its left end.
static double draw_progress(ui_state *ui, sl_box box, const job_progress *p) {
    const double t = ui->text, wide = fmin(11 * t, 0.2 * box_width(box));
    const char *label = "Stop (Esc)";
    char text[96];
    snprintf(text, sizeof text, "%s%s", p->stage ? p->stage : "", p->share >= 0 ? "" : " ...");
    ui_spaces(text);
    const double middle = (box.min.y + box.max.y) / 2;
    const double stop = box.max.x - ui_button_width(ui, label) - 0.4 * t;
    ui_button(ui, stop, box.min.y + 0.15 * t, 1.6 * t, label, false, ui_action_find(ui, "escape"));
    const double x = stop - wide - 0.6 * t;
    ui_fill_round(ui, (sl_box){{x, middle - 0.3 * t}, {x + wide, middle + 0.3 * t}}, 0.3 * t,
                  ui->palette.outline);
    if (p->share > 0.05)
        ui_fill_round(
            ui, (sl_box){{x, middle - 0.3 * t}, {x + wide * fmin(p->share, 1), middle + 0.3 * t}},
            0.3 * t, ui->palette.glass);
    const double left = x - 0.6 * t - ui_text_width(ui, 0.95, false, text);
    if (left < box.min.x + 0.4 * t) return x;
    ui_text_right(ui, x - 0.6 * t, middle + 0.36 * t, 0.95, ui->palette.ink, text);
    return left;
}

/// In Draw mode: the place of the grid under the pointer.
static void write_place(const view_state *view, char text[64]) {
    sl_point at;
    text[0] = '\0';
    if (view->mode != MODE_DRAW || !view->document->baked || !view_pointed(view, &at)) return;
    at = grid_snap(view, at);
    snprintf(text, 64, "at %.10g, %.10g   ", at.x, at.y);
}

/// What the viewer does, at the right end of the line. Returns its left end.
static double draw_doing(view_state *view, sl_box box, const char *doing) {
    ui_state *ui = view->ui;
    const sl_baked *baked = view->document->baked;
    const bool partial = baked && sl_partial_begun(&baked->partial);
    if (!*doing && partial) doing = "a partial bake";
    char place[64], text[160];
    write_place(view, place);
    if (view->ui->steady || view->ui->frame_seconds <= 0)
        snprintf(text, sizeof text, "%s%s", place, doing);
    else
        snprintf(text, sizeof text, "%s%s   %.1f ms a frame", place, doing,
                 1e3 * view->ui->frame_seconds);
    const double t = ui->text, right = box.max.x - 0.8 * t;
    ui_text_right(ui, right, box.max.y - 0.62 * t, 0.95, ui->palette.faint, text);
    return right - ui_text_width(ui, 0.95, false, text);
}

#define MESSAGE_SECONDS 8

/// A message that is longer than the line grows upwards, over the panes. After some seconds it is
/// cut to the line, unless it is an error; the tooltip has all of it.
/// A long one stands in lines over the plan, up to `end`.
static void draw_message(ui_state *ui, sl_box box, double right, double end) {
    const double t = ui->text, left = 0.8 * t, size = 0.95;
    const sl_colour colour = ui->message_is_error     ? ui->palette.start
                             : ui->message_is_working ? ui->palette.faint
                                                      : ui->palette.ink;
    if (!*ui->message) return;
    if (ui_text_width(ui, size, ui->message_is_error, ui->message) <= right - left) {
        ui_text(ui, left, box.max.y - 0.62 * t, size, ui->message_is_error, colour, ui->message);
        return;
    }
    if (!ui->message_is_error && ui->message_seconds > MESSAGE_SECONDS) {
        sl_text_show_within(ui->cairo, colour, left, box.max.y - 0.62 * t, right - left, size * t,
                            false, ui->message);
        return;
    }
    const double wide = end - 2 * left;
    const double high =
        ui_lines_height(ui, wide, size, ui->message_is_error, ui->message) + 0.5 * t;
    // The line itself is free unless something stands at its right end.
    const double bottom = right > box.max.x - 2 * t ? box.max.y : box.min.y;
    const sl_box over = {{box.min.x, fmax(bottom - high, 0)}, {end, bottom}};
    ui_begin_area(ui, over);
    ui_line(ui, over.min.x, over.min.y + 0.5, over.max.x, over.min.y + 0.5, ui->palette.outline);
    ui_lines(ui, left, over.min.y + 1.25 * t, wide, size, ui->message_is_error, colour,
             ui->message);
    ui_end_area(ui);
}

void pane_status(learn_state *learn, sl_box box, double end, const job_progress *work,
                 const char *doing) {
    ui_state *ui = learn->ui;
    ui_begin_area(ui, box);
    ui_hit(ui, HIT_PANEL, PANEL_STATUS, box);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    const double left =
        work->running ? draw_progress(ui, box, work) : draw_doing(learn->view, box, doing);
    ui_end_area(ui);
    draw_message(ui, box, left - 0.8 * ui->text, end);
}

// --- the time line

#define SENTENCE_SIZE 1.12

/// What is said of a pair stands here where there is no panel. In lessons it always does, as the
/// plan shows it.
static bool says_pair(const learn_state *learn) {
    const quiz_state *q = &learn->quiz;
    if (learn->view->mode == MODE_LEARN) return q->answered;
    return !ui_has_panel(learn->ui) && (q->answered || learn->view->mode == MODE_QUIZ);
}

bool pane_time_shown(const learn_state *learn) {
    return learn->view->mode == MODE_LEARN || says_pair(learn);
}

void pane_time_sentence(const learn_state *learn, char text[BAR_TEXT]) {
    const quiz_state *q = &learn->quiz;
    if (!says_pair(learn)) {
        lesson_sentence(&learn->lesson, learn->document, text);
        return;
    }
    if (learn->view->mode == MODE_QUIZ)
        quiz_question(learn, text, BAR_TEXT);
    else
        snprintf(text, BAR_TEXT, "From cell %u to cell %u:", q->from, q->to);
    const size_t used = strlen(text);
    if (!q->answered) return;
    text[used] = ' ';
    quiz_words(learn, text + used + 1, BAR_TEXT - used - 1);
}

/// Names of actions, with NULL at the end.
static const char *const *time_buttons(const learn_state *learn) {
    static const char *const steps[] = {"step_first", "step_back", "play_steps",
                                        "step_next",  "step_last", NULL};
    static const char *const answers[] = {"answer_yes", "answer_no", NULL};
    static const char *const next[] = {"next_question", "why_step", NULL};
    static const char *const why[] = {"why_step", NULL};
    if (learn->view->mode == MODE_LEARN) return steps;
    if (learn->view->mode != MODE_QUIZ) return why;
    return learn->quiz.asked && !learn->quiz.answered ? answers : next;
}

static void write_count(const lesson_state *lesson, char text[48]) {
    const size_t length = lesson_length(lesson);
    snprintf(text, 48, "%zu of %zu", length ? lesson->at + 1 : 0, length);
}

static double buttons_width(learn_state *learn) {
    double wide = 0.7 * learn->ui->text;
    for (const char *const *name = time_buttons(learn); *name; name++)
        wide +=
            ui_button_width(learn->ui, row_of(learn->ui, *name)->label) + 0.35 * learn->ui->text;
    return wide;
}

/// Marks the steps about the cell under the pointer, if not too many are.
static void draw_ticks(learn_state *learn, sl_box line) {
    enum { TICKS_MOST = 400 };
    const lesson_state *lesson = &learn->lesson;
    const subject_row *subject = lesson_subject(lesson);
    const size_t length = lesson_length(lesson);
    if (!subject->cell || length < 2 || learn->ui->over.kind != HIT_PLAN) return;
    const sl_point at =
        camera_point(&learn->view->camera, learn->view->plan[0], learn->ui->pointer);
    const uint32_t cell = sl_space_locate(&learn->document->baked->space, at);
    int ticks = 0;
    for (size_t i = 0; i < length && cell != SL_NO_CELL && ticks < TICKS_MOST; i++) {
        if (subject->cell(lesson, i) != cell) continue;
        const double x = line.min.x + (double)i / (double)(length - 1) * (line.max.x - line.min.x);
        ui_fill(learn->ui, (sl_box){{x - 1, line.min.y + 1}, {x + 1, line.max.y - 1}},
                learn->ui->palette.start);
        ticks++;
    }
}

/// The line stands beside the buttons where it has room there, else below them.
void pane_time_measure(learn_state *learn) {
    ui_state *ui = learn->ui;
    char text[BAR_TEXT];
    if (!pane_time_shown(learn)) return;
    pane_time_sentence(learn, text);
    const double high = ui_lines_height(ui, ui->width - 1.8 * ui->text, SENTENCE_SIZE, false, text);
    ui->time_lines = (int)fmax(round(high / (1.4 * SENTENCE_SIZE * ui->text)), 1);
    const bool has_line = learn->view->mode == MODE_LEARN;
    ui->time_rows = has_line && buttons_width(learn) + 14 * ui->text > ui->width ? 2 : 1;
}

double pane_time_height(const learn_state *learn) {
    return (0.9 + 1.4 * SENTENCE_SIZE * learn->ui->time_lines + 2 * fmax(learn->ui->time_rows, 1)) *
           ui_text_size(learn->ui);
}

/// Draws the line right of the buttons or below them, from `y` down. Returns its upper edge.
static double draw_time_line(learn_state *learn, sl_box box, double x, double y) {
    ui_state *ui = learn->ui;
    const double t = ui->text;
    const lesson_state *lesson = &learn->lesson;
    const size_t length = lesson_length(lesson);
    char count[48];
    if (ui->time_rows > 1) {
        x = box.min.x + 0.3 * t;
        y += 2 * t;
    }
    write_count(lesson, count);
    box.max.x -= ui_bar_width(ui);
    const double left = box.max.x - 0.9 * t - ui_text_width(ui, 0.95, false, count);
    ui_text_right(ui, left + ui_text_width(ui, 0.95, false, count), y + 1.15 * t, 0.95,
                  ui->palette.faint, count);
    const sl_box line = {{x + t, y}, {left - 1.1 * t, y + 1.6 * t}};
    if (box_width(line) > 2 * t) {
        draw_ticks(learn, line);
        ui_slider(ui, line, length > 1 ? (double)lesson->at / (double)(length - 1) : 0, HIT_TIME,
                  0);
    }
    return y;
}

void pane_time(learn_state *learn, sl_box box) {
    ui_state *ui = learn->ui;
    const double t = ui->text;
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    char text[BAR_TEXT];
    pane_time_sentence(learn, text);
    const sl_box room = {{box.min.x, box.min.y + 1}, box.max};
    double y = ui_begin_scroll(ui, SCROLL_TIME, room);
    y = ui_lines(ui, box.min.x + 0.9 * t, y + 1.6 * t, box_width(box) - 1.8 * t, SENTENCE_SIZE,
                 false, ui->palette.ink, text) -
        0.8 * t;
    double x = box.min.x + 0.7 * t;
    for (const char *const *name = time_buttons(learn); *name; name++)
        x = put_button(ui, x, y, *name);
    if (learn->view->mode == MODE_LEARN) y = draw_time_line(learn, box, x, y);
    ui_end_scroll(ui, room, y + 1.9 * t);
    ui_end_area(ui);
}
