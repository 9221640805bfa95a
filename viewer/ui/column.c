/// Each thing takes its height off the top of the column.
#include "ui/column.h"

#include "app/actions.h"
#include "app/sliders.h"
#include "panes/legend.h"

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

void column_check(app_state *app, column *c, const char *name) {
    size_t count;
    const int number = action_find(name);
    const action_row *action = &action_table(&count)[number];
    const double t = app->ui.text, out = fmin(0.4 * t, c->left - c->box.min.x);
    c->y = ui_check(&app->ui, (sl_box){{c->left - out, c->y}, {c->right + out, c->y + 1.5 * t}},
                    action->label, action->key, action->on(app), number);
}

double column_button(ui_state *ui, column *c, double x, const char *label, bool on, int action) {
    const double t = ui->text;
    if (x > c->left && x + ui_button_width(ui, label) > c->right) {
        x = c->left;
        c->y += 2 * t;
    }
    return ui_button(ui, x, c->y + 0.4 * t, 1.6 * t, label, on, action) + 0.4 * t;
}

void column_buttons(app_state *app, column *c, const char *const *names) {
    size_t count;
    const action_row *actions = action_table(&count);
    double x = c->left;
    for (; *names; names++) {
        const action_row *a = &actions[action_find(*names)];
        x = column_button(&app->ui, c, x, a->label, a->on && a->on(app), (int)(a - actions));
    }
    c->y += 2 * app->ui.text;
}

void column_legend(app_state *app, column *c) {
    legend_row rows[LEGEND_MOST];
    char text[96];
    const int count = layers_legend(&app->view, rows);
    if (!count) return;
    column_heading(&app->ui, c, "Legend", NULL);
    for (int i = 0; i < count; i++)
        c->y = layers_legend_row(&app->ui, c->left, c->right, c->y, &rows[i]);
    c->y = layers_key_column(&app->view, c->left, c->right, c->y);
    if (layer_nodes_words(&app->view, text))
        column_words(&app->ui, c, 0.9, app->ui.palette.faint, text);
}

void column_layers(app_state *app, column *c) {
    column_heading(&app->ui, c, "Layers", "key");
    for (unsigned i = 0; i < LAYER_COUNT; i++)
        if (layers_lists(&app->view, i)) column_check(app, c, layer_table()[i].name);
}

void column_sliders(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    size_t count;
    const slider_row *sliders = slider_table(&count);
    for (size_t i = 0; i < count; i++) {
        if (!sliders[i].shown(app)) continue;
        char text[SLIDER_TEXT];
        sliders[i].text(app, text);
        // A narrow panel has the track below the words.
        const bool beside = !column_is_narrow(ui, c);
        const double value = fmax(ui_text_width(ui, 1, false, text), beside ? 3.2 * t : 0) + t;
        ui_text_right(ui, c->right, c->y + 1.16 * t, 1, ui->palette.ink, text);
        const double label = beside ? 6.4 * t : column_width(c) - value;
        const double below = ui_lines(ui, c->left, c->y + 1.16 * t, label, 1, false,
                                      ui->palette.ink, sliders[i].label);
        sl_box track = {{c->left + 6.4 * t, c->y}, {c->right - value, c->y + 1.6 * t}};
        if (!beside)
            track = (sl_box){{c->left + 0.5 * t, below - 1.1 * t},
                             {c->right - 0.5 * t, below + 0.5 * t}};
        ui_slider(ui, track, sliders[i].share(app), HIT_SLIDER, (int)i);
        c->y = fmax(track.max.y, below - 1.1 * t) + 0.1 * t;
    }
}
