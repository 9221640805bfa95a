/// Each thing takes its height off the top of the column.
#include "ui/column.h"

#include <math.h>

column column_begin(ui_state *ui, sl_box box) {
    const double gap = fmin(1.1 * ui->text, 0.06 * box_width(box));
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x + 0.5, box.min.y, box.min.x + 0.5, box.max.y, ui->palette.outline);
    const double y = ui_begin_scroll(ui, SCROLL_SIDE, box);
    return (column){box, box.min.x + gap, box.max.x - fmax(gap, ui_bar_width(ui)), y};
}

void column_end(ui_state *ui, const column *c) {
    ui_end_scroll(ui, c->box, c->y + 0.8 * ui->text);
    ui_end_area(ui);
}

double column_width(const column *c) {
    return c->right - c->left;
}

bool column_is_narrow(const ui_state *ui, const column *c) {
    return column_width(c) < 19 * ui->text;
}

void column_heading(ui_state *ui, column *c, const char *text, const char *right) {
    const double more = right ? ui_text_width(ui, 0.9, false, right) + ui->text : 0;
    c->y += 1.9 * ui->text;
    if (right) ui_text_right(ui, c->right, c->y, 0.9, ui->palette.faint, right);
    c->y = ui_lines(ui, c->left, c->y, column_width(c) - more, 1, true, ui->palette.ink, text) -
           0.85 * ui->text;
}

void column_words(ui_state *ui, column *c, double size, sl_colour colour, const char *text) {
    c->y =
        ui_paragraph(ui, c->left, c->y + ui->text, column_width(c), size, colour, text) - ui->text;
}

void column_check(ui_state *ui, column *c, const char *name) {
    const int number = ui_action_find(ui, name);
    const ui_action *action = &ui->actions[number];
    const double t = ui->text, out = fmin(0.4 * t, c->left - c->box.min.x);
    c->y = ui_check(ui, (sl_box){{c->left - out, c->y}, {c->right + out, c->y + 1.5 * t}},
                    action->label, action->key, action->on, number);
}

sl_box column_row(ui_state *ui, column *c, const sl_colour *colour, const char *label,
                  const char *value, bool chosen) {
    const double t = ui->text, out = fmin(0.4 * t, c->left - c->box.min.x);
    const double left = c->left + (colour ? 1.5 * t : 0), room = c->right - left;
    const double wide = ui_text_width(ui, 0.95, false, value);
    const bool below = ui_text_width(ui, 0.95, false, label) + wide + t > room;
    const double more = below ? ui_lines_height(ui, room, 0.95, false, value) : 0;
    const double high = 1.55 * t + more;
    const sl_box row = {{c->left - out, c->y}, {c->right + out, c->y + high}};
    if (chosen || box_has(row, ui->pointer))
        ui_fill_round(ui, row, 0.25 * t,
                      sl_colour_mix(ui->palette.page, ui->palette.glass, chosen ? 0.22 : 0.1));
    if (colour)
        ui_fill_round(ui,
                      (sl_box){{c->left, c->y + 0.25 * t}, {c->left + 1.05 * t, c->y + 1.3 * t}},
                      0.2 * t, *colour);
    ui_text_within(ui, left, c->y + 1.12 * t, below ? room : room - wide - t, 0.95, ui->palette.ink,
                   label);
    if (below)
        ui_lines(ui, left, c->y + 2.45 * t, room, 0.95, false, ui->palette.faint, value);
    else
        ui_text_right(ui, c->right, c->y + 1.12 * t, 0.95, ui->palette.faint, value);
    c->y = row.max.y;
    return row;
}

double column_button(ui_state *ui, column *c, double x, const char *label, bool on, int action) {
    const double t = ui->text;
    if (x > c->left && x + ui_button_width(ui, label) > c->right) {
        x = c->left;
        c->y += 2 * t;
    }
    return ui_button(ui, x, c->y + 0.4 * t, 1.6 * t, label, on, action) + 0.4 * t;
}

void column_buttons(ui_state *ui, column *c, const char *const *names) {
    double x = c->left;
    for (; *names; names++) {
        const int number = ui_action_find(ui, *names);
        x = column_button(ui, c, x, ui->actions[number].label, ui->actions[number].on, number);
    }
    c->y += 2 * ui->text;
}

/// The value at the right, which a click on it types.
static void draw_value(ui_state *ui, const column *c, int number, double width) {
    const ui_slider_row *slider = &ui->sliders[number];
    const double t = ui->text;
    const sl_box box = {{c->right - width + 0.6 * t, c->y}, {c->right, c->y + 1.6 * t}};
    const bool over = slider->typed && box_has(box, ui->pointer);
    if (over)
        ui_fill_round(ui, box, 0.2 * t, sl_colour_mix(ui->palette.page, ui->palette.glass, 0.2));
    ui_text_right(ui, c->right, c->y + 1.16 * t, 1, ui->palette.ink, slider->text);
    if (slider->typed) ui_hit(ui, HIT_VALUE, number, box);
}

void column_sliders(ui_state *ui, column *c) {
    const double t = ui->text;
    for (int i = 0; i < ui->slider_count; i++) {
        const ui_slider_row *slider = &ui->sliders[i];
        if (!slider->shown) continue;
        // A narrow panel has the track below the words.
        const bool beside = !column_is_narrow(ui, c);
        const double value =
            fmax(ui_text_width(ui, 1, false, slider->text), beside ? 3.2 * t : 0) + t;
        const bool typed = ui_types_value(ui) && ui->typed_slider == i;
        const sl_box field = {{c->left + (beside ? 6.4 : 0) * t, c->y}, {c->right, c->y + 1.7 * t}};
        if (typed) {
            ui_text_field(ui, field, ui->field, slider->label, true);
            ui_hit(ui, HIT_FIELD, 1, field);
        } else {
            draw_value(ui, c, i, value);
        }
        const double label = beside ? 6.4 * t : column_width(c) - value;
        if (typed && !beside) {
            c->y = field.max.y + 0.1 * t;
            continue;
        }
        const double below =
            ui_lines(ui, c->left, c->y + 1.16 * t, label, 1, false, ui->palette.ink, slider->label);
        sl_box track = {{c->left + 6.4 * t, c->y}, {c->right - value, c->y + 1.6 * t}};
        if (!beside)
            track = (sl_box){{c->left + 0.5 * t, below - 1.1 * t},
                             {c->right - 0.5 * t, below + 0.5 * t}};
        if (!typed) ui_slider(ui, track, slider->share, HIT_SLIDER, i);
        c->y = fmax(track.max.y, below - 1.1 * t) + 0.1 * t;
    }
}
