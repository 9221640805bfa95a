/// The table below the plan: heads that sort, and rows that are chosen. Rows out of sight are not
/// drawn: tables may have thousands.
#include "panes/panes.h"
#include "plan/table.h"
#include "plan/value_scale.h"
#include "ui/column.h"

#include <math.h>
#include <stdio.h>

#define ROW_HIGH   1.55 ///< these three: plain texts
#define LEAST_WIDE 9.5
#define MOST_WIDE  17

/// Scrolls so that the chosen row is in sight.
static void reveal_row(table_state *t, ui_scroll *scroll, double high) {
    size_t place = 0;
    if (!t->reveal || !(scroll->room > 0)) return;
    t->reveal = false;
    if (t->chosen == SIZE_MAX) return;
    while (place < t->rows && table_row(t, place) != t->chosen) place++;
    const double top = high * (double)place;
    if (top < scroll->at) scroll->at = top;
    if (top + high > scroll->at + scroll->room) scroll->at = top + high - scroll->room;
}

/// How wide a column is: wider where few of them share the room.
static double column_wide(const view_state *view, double width) {
    const size_t left = view->table.of->columns(view) - view->table.first_column;
    const double t = view->ui->text;
    return fmin(fmax(width / (double)left, LEAST_WIDE * t), MOST_WIDE * t);
}

/// The columns that have room, from the first one shown on.
static size_t columns_shown(const view_state *view, double width, double wide) {
    const size_t left = view->table.of->columns(view) - view->table.first_column;
    const size_t room = (size_t)fmax(floor(width / wide), 1);
    return left < room ? left : room;
}

static void draw_heads(view_state *view, sl_box box, double wide, size_t shown) {
    ui_state *ui = view->ui;
    const table_state *t = &view->table;
    const double tx = ui->text;
    char name[TABLE_NAME], text[TABLE_NAME + 8];
    for (size_t i = 0; i < shown; i++) {
        const size_t at = t->first_column + i;
        const sl_box head = {{box.min.x + wide * (double)i, box.min.y},
                             {fmin(box.min.x + wide * (double)(i + 1), box.max.x), box.max.y}};
        t->of->name(view, at, name);
        ui_spaces(name);
        snprintf(text, sizeof text, "%s%s", name,
                 !t->sorted || t->column != at ? ""
                 : t->down                     ? " \xe2\x96\xbc"
                                               : " \xe2\x96\xb2");
        if (box_has(head, ui->pointer))
            ui_fill_round(ui, head, 0.25 * tx,
                          sl_colour_mix(ui->palette.page, ui->palette.glass, 0.1));
        ui_text_within(ui, head.min.x + 0.3 * tx, head.min.y + 1.1 * tx, box_width(head) - 0.6 * tx,
                       0.95, ui->palette.ink, text);
        ui_hit_focus(ui, HIT_HEAD, (int)at, head);
    }
    ui_line(ui, box.min.x, box.max.y - 0.5, box.max.x, box.max.y - 0.5, ui->palette.outline);
}

static void draw_rows(view_state *view, sl_box box, double wide, size_t shown) {
    ui_state *ui = view->ui;
    table_state *t = &view->table;
    const double tx = ui->text, high = ROW_HIGH * tx;
    reveal_row(t, &ui->scrolls[SCROLL_TABLE], high);
    const double top = ui_begin_scroll(ui, SCROLL_TABLE, box);
    const size_t first = (size_t)fmax(floor((box.min.y - top) / high), 0);
    for (size_t i = first; i < t->rows && top + high * (double)i < box.max.y; i++) {
        const size_t row = table_row(t, i);
        const double y = top + high * (double)i;
        const sl_box line = {{box.min.x, y}, {box.max.x - ui_bar_width(ui), y + high}};
        if (row == t->chosen || box_has(line, ui->pointer))
            ui_fill_round(
                ui, line, 0.25 * tx,
                sl_colour_mix(ui->palette.page, ui->palette.glass, row == t->chosen ? 0.22 : 0.1));
        for (size_t k = 0; k < shown; k++) {
            char text[SCALE_TEXT];
            const double left = box.min.x + wide * (double)k;
            const bool named = t->of->text && t->first_column + k == 0;
            if (!named) value_scale_say(t->of->value(view, row, t->first_column + k), text);
            ui_text_within(ui, left + 0.3 * tx, y + 1.1 * tx,
                           fmin(wide, line.max.x - left) - 0.6 * tx, 0.95, ui->palette.ink,
                           named ? t->of->text(view, row) : text);
        }
        ui_hit_focus(ui, HIT_ROW, (int)row, line);
    }
    ui_end_scroll(ui, box, top + high * (double)t->rows);
}

void pane_table(learn_state *learn, sl_box box) {
    static const char *const buttons[] = {"table_left", "table_right", "table_export", "table",
                                          NULL};
    ui_state *ui = learn->ui;
    view_state *view = learn->view;
    const double t = ui->text;
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    table_update(view);
    column c = {box, box.min.x + 0.8 * t, box.max.x - 0.8 * t, box.min.y + 0.1 * t};
    if (box_height(box) > 10 * t) column_buttons(ui, &c, buttons); // else keys do it
    if (view->table.of) {
        const sl_box heads = {{c.left, c.y + 0.2 * t}, {c.right, c.y + 1.8 * t}};
        const sl_box rows = {{c.left, heads.max.y}, {box.max.x, box.max.y}};
        const double wide = column_wide(view, box_width(heads));
        const size_t shown = columns_shown(view, box_width(heads), wide);
        draw_heads(view, heads, wide, shown);
        if (box_height(rows) > 0) draw_rows(view, rows, wide, shown);
    } else {
        ui_text_within(ui, c.left, c.y + 1.3 * t, column_width(&c), 0.95, ui->palette.faint,
                       "This tool has no values yet.");
    }
    ui_end_area(ui);
}
