/// The panel of lessons: their list, the pseudo-code, the account of the search so far.
#include "panes/panel.h"
#include "panes/panes.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void draw_code(learn_state *learn, column *c) {
    ui_state *ui = learn->ui;
    size_t count, lit;
    if (!lesson_shows(&learn->lesson, learn->document)) return;
    const char *const *code =
        lesson_subject(&learn->lesson)->code(&learn->lesson, learn->document, &count, &lit);
    const double t = ui->text;
    for (size_t i = 0; i < count; i++) {
        const char *line = code[i];
        const size_t indent = strspn(line, " ");
        const double x = c->left + fmin(0.45 * t * (double)indent, 0.4 * column_width(c));
        const double out = fmin(0.4 * t, c->left - c->box.min.x);
        const double high =
            fmax(ui_lines_height(ui, c->right - x, 0.95, i == lit, line + indent), t) + 0.15 * t;
        if (i == lit)
            ui_fill_round(ui, (sl_box){{c->left - out, c->y}, {c->right + out, c->y + high}},
                          0.25 * t, sl_colour_mix(ui->palette.page, ui->palette.source, 0.55));
        ui_lines(ui, x, c->y + 1.08 * t, c->right - x, 0.95, i == lit,
                 i == lit ? ui->palette.ink : ui->palette.faint, line + indent);
        c->y += high;
    }
}

/// The subjects to choose from: those that the map allows.
static void draw_subjects(learn_state *learn, column *c) {
    ui_state *ui = learn->ui;
    const double t = ui->text, out = fmin(0.4 * t, c->left - c->box.min.x);
    size_t count;
    const subject_row *const *subjects = subject_table(&count);
    column_heading(ui, c, "Lessons", "U");
    for (size_t i = 0; i < count; i++) {
        if (!lesson_fits(i, learn->document)) continue;
        const bool on = i == learn->lesson.subject;
        const double high =
            ui_lines_height(ui, column_width(c), 1, on, subjects[i]->title) + 0.1 * t;
        const sl_box row = {{c->left - out, c->y}, {c->right + out, c->y + high}};
        if (on || box_has(row, ui->pointer))
            ui_fill_round(ui, row, 0.25 * t,
                          sl_colour_mix(ui->palette.page, ui->palette.glass, on ? 0.22 : 0.1));
        ui_lines(ui, c->left, c->y + 1.08 * t, column_width(c), 1, on, ui->palette.ink,
                 subjects[i]->title);
        ui_hit_focus(ui, HIT_SUBJECT, (int)i, row);
        c->y = row.max.y;
    }
}

/// Buttons to the next step of a kind, named by the subject, and the speed.
static void draw_steps(learn_state *learn, column *c) {
    ui_state *ui = learn->ui;
    const lesson_state *lesson = &learn->lesson;
    const subject_row *subject = lesson_subject(lesson);
    char text[64];
    double x = c->left;
    if (lesson->finds) {
        snprintf(text, sizeof text, "\xe2\x97\x80 %s", subject->found ? subject->found : "");
        x = column_button(ui, c, x, text, false, ui_action_find(ui, "found_back"));
        snprintf(text, sizeof text, "%s \xe2\x96\xb6", subject->found ? subject->found : "");
        x = column_button(ui, c, x, text, false, ui_action_find(ui, "found_next"));
    }
    if (lesson->rejects) {
        snprintf(text, sizeof text, "%s \xe2\x96\xb6", subject->rejected ? subject->rejected : "");
        column_button(ui, c, x, text, false, ui_action_find(ui, "rejected_next"));
    }
    if (lesson->finds || lesson->rejects) c->y += 2 * ui->text;
    static const char *const speed[] = {"slower", "faster", NULL};
    column_buttons(learn->ui, c, speed);
    snprintf(text, sizeof text, "%g steps a second", ldexp(2, lesson->speed));
    column_words(ui, c, 0.95, ui->palette.faint, text);
}

/// "L1 and L4 against R2 and R3".
static void list_ends(const sl_conflict *conflict, char *text, size_t room) {
    size_t used = 0;
    text[0] = '\0';
    for (int side = 0; side < 2; side++) {
        bool first = true;
        for (uint32_t i = 0; i < conflict->end_count && used < room; i++) {
            if (conflict->ends[i].left != (side == 0)) continue;
            used += (size_t)snprintf(text + used, room - used, "%s%c%u",
                                     !first      ? " and "
                                     : side == 1 ? " against "
                                                 : "",
                                     side ? 'R' : 'L', conflict->ends[i].portal + 1);
            first = false;
        }
    }
}

/// What the ends that leave no line are to each other.
static void write_conflict(learn_state *learn, char *text, size_t room) {
    lesson_state *lesson = &learn->lesson;
    char ends[128];
    sl_status status;
    const sl_conflict *conflict = lesson_conflict(learn->context, lesson, &status);
    view_check(learn->view, status);
    text[0] = '\0';
    if (conflict->verdict == SL_STABBED || !conflict->end_count) return;
    list_ends(conflict, ends, sizeof ends);
    snprintf(text, room, "%s: %s. They are marked: %s.",
             conflict->verdict == SL_GRAZING ? "The line only grazes"
             : conflict->turns               ? "No line: the portals turn back"
                                             : "No line is left",
             ends, sl_conflict_reason(lesson->ends, conflict));
}

static void draw_account(learn_state *learn, column *c) {
    lesson_state *lesson = &learn->lesson;
    const subject_row *subject = lesson_subject(lesson);
    char text[SENTENCE];
    if (!lesson_shows(lesson, learn->document)) return;
    if (subject->account) {
        subject->account(lesson, text);
        column_heading(learn->ui, c, "So far", NULL);
        column_words(learn->ui, c, 1, learn->ui->palette.ink, text);
    }
    if (!lesson->end_count) return;
    const double margin =
        sl_dual_margin(&lesson->dual, lesson->ends, lesson->end_count, lesson->line);
    column_heading(learn->ui, c, "The line", lesson->dragged ? "ends were dragged" : NULL);
    snprintf(text, sizeof text, "Its margin is %.3g, the best is %.3g.",
             margin * lesson->dual.scale, lesson->dual.margin * lesson->dual.scale);
    column_words(learn->ui, c, 0.95, learn->ui->palette.ink, text);
    write_conflict(learn, text, sizeof text);
    if (*text) column_words(learn->ui, c, 0.95, learn->ui->palette.start, text);
    column_words(learn->ui, c, 0.95, learn->ui->palette.faint,
                 "Drag it or portal ends, or choose by . and move by arrows.");
    static const char *const change[] = {"undo", "reset_ends", "program", NULL};
    column_buttons(learn->ui, c, change);
}

void pane_learn(learn_state *learn, sl_box box) {
    column c = column_begin(learn->ui, box);
    pane_why(learn, &c);
    draw_subjects(learn, &c);
    c.y += 0.7 * learn->ui->text;
    draw_code(learn, &c);
    draw_steps(learn, &c);
    draw_account(learn, &c);
    column_layers(learn->view, &c);
    column_check(learn->ui, &c, "first_person");
    column_legend(learn->view, &c);
    pane_words(learn->view, &c);
    column_end(learn->ui, &c);
}
