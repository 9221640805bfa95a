/// A question at the top of the stack of dialogs, and the menu, which is one too.
#include "dialogs/question.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// --- questions

void question_ask(desk_state *desk, const char *title, const char *text, const char *const *answers,
                  int count, void (*then)(desk_state *desk, int answer)) {
    dialog_push(&desk->dialog, DIALOG_QUESTION, DIALOG_OWN);
    question_state *q = &desk->dialog.questions[desk->dialog.depth - 1];
    *q = (question_state){.count = count, .then = then};
    snprintf(q->title, sizeof q->title, "%s", title);
    snprintf(q->text, sizeof q->text, "%s", text);
    for (int i = 0; i < count && i < ANSWERS_MOST; i++) q->answers[i] = answers[i];
}

void question_tell(desk_state *desk, const char *title, const char *text) {
    static const char *const close[] = {"C:Close"};
    question_ask(desk, title, text, close, 1, NULL);
}

static const question_state *question_now(const desk_state *desk) {
    return &desk->dialog.questions[desk->dialog.depth - 1];
}

const char *question_text(const desk_state *desk) {
    return dialog_open_now(&desk->dialog) == DIALOG_QUESTION ? question_now(desk)->text : "";
}

static void give_answer(desk_state *desk, int number) {
    void (*const then)(desk_state * desk, int answer) = question_now(desk)->then;
    dialog_pop(&desk->dialog);
    if (then) then(desk, number);
}

void question_act(desk_state *desk, int id) {
    if (id == DIALOG_MAIN)
        give_answer(desk, 0);
    else if (id == DIALOG_CANCEL)
        give_answer(desk, question_now(desk)->count - 1);
    else
        give_answer(desk, id - DIALOG_OWN);
}

bool question_key(desk_state *desk, const char *key) {
    const question_state *q = question_now(desk);
    for (int i = 0; i < q->count; i++) {
        if (key[0] != q->answers[i][0] || key[1]) continue;
        give_answer(desk, i);
        return true;
    }
    return false;
}

enum { LINES_MOST = 40, LINE_TEXT = 256 };

/// Breaks a text into lines of a width. A word that is wider than that is cut.
static int break_lines(ui_state *ui, const char *text, double width,
                       char lines[LINES_MOST][LINE_TEXT]) {
    int count = 0;
    while (*text && count < LINES_MOST) {
        size_t kept = 0, length = 0;
        char *line = lines[count];
        while (text[length] && text[length] != '\n' && length < LINE_TEXT - 1) {
            size_t next = length + 1;
            while (((unsigned char)text[next] & 0xc0) == 0x80 && next < LINE_TEXT - 1) next++;
            memcpy(line, text, next);
            line[next] = '\0';
            if (length && ui_text_width(ui, 1, false, line) > width) break;
            length = next;
            if (text[length] == ' ' || text[length] == '\n' || !text[length]) kept = length;
        }
        if (kept) length = kept;
        line[length] = '\0';
        text += length;
        if (*text == '\n')
            text++;
        else
            while (*text == ' ') text++;
        count++;
    }
    return count;
}

void question_draw(desk_state *desk) {
    ui_state *ui = desk->ui;
    const question_state *q = question_now(desk);
    char lines[LINES_MOST][LINE_TEXT];
    const double width = fmin(fmax((ui->width - 12) / ui->text, 30), 48);
    const int count = break_lines(ui, q->text, (width - 3) * ui->text, lines);
    const sl_box box = dialog_begin(&desk->dialog, width, 3.5 + 1.5 * count + 4.2, q->title);
    const double t = ui->text;
    double y = box.min.y + 1.2 * t;
    for (int i = 0; i < count; i++, y += 1.5 * t)
        ui_text(ui, box.min.x, y, 1, false, ui->palette.ink, lines[i]);
    dialog_label buttons[ANSWERS_MOST];
    for (int i = 0; i < q->count; i++)
        buttons[i] = (dialog_label){DIALOG_OWN + i, q->answers[i] + 2};
    dialog_buttons(&desk->dialog, box.max.x, box.max.y - 1.8 * t, buttons, q->count);
    dialog_end(&desk->dialog);
}

// --- the menu

static const char *const rows[] = {
    "new",      "open",     "import",   "storeys", "notes",         "save", "save_as",
    "save_png", "save_svg", "save_pdf", "print",   "export_series", "quit",
};
enum { ROWS = sizeof rows / sizeof *rows };

void menu_open(desk_state *desk) {
    desk->dialog.menu = (dialog_list){.count = ROWS, .acts = true};
    dialog_push(&desk->dialog, DIALOG_MENU, DIALOG_OWN);
}

void menu_draw(desk_state *desk) {
    ui_state *ui = desk->ui;
    dialog_list *list = &desk->dialog.menu;
    const sl_box box = dialog_begin(&desk->dialog, 34, 4.5 + 1.7 * ROWS, "File");
    const double t = ui->text;
    const sl_box frame = {box.min, {box.max.x, box.min.y + 1.7 * ROWS * t + 2}};
    dialog_list_frame(&desk->dialog, DIALOG_OWN, frame, list);
    for (size_t i = list->first; i < list->count && i < list->first + list->page; i++) {
        const ui_action *action = &ui->actions[ui_action_find(ui, rows[i])];
        const sl_box row = dialog_list_row(&desk->dialog, DIALOG_OWN, frame, list, i);
        char label[96];
        snprintf(label, sizeof label, "%s", action->help);
        label[0] = (char)toupper((unsigned char)label[0]);
        ui_text(ui, row.min.x + 0.6 * t, row.min.y + 1.2 * t, 1, false, ui->palette.ink, label);
        if (action->key)
            ui_text_right(ui, row.max.x - 0.6 * t, row.min.y + 1.2 * t, 0.95, ui->palette.faint,
                          action->key);
    }
    dialog_end(&desk->dialog);
}

void menu_act(desk_state *desk, int id) {
    const size_t row = desk->dialog.menu.at;
    dialog_pop(&desk->dialog);
    if (id != DIALOG_CANCEL && row < ROWS) desk->dialog.chosen = rows[row];
}
