/// The linear program of the lesson's portals, as GLPK has it: a row for each portal end, the
/// objective, the optimum and its basis.
///
/// The line is ux y - uy x + c, positive to its left. Its margin d is made as large as possible.
/// Rows that are not in the basis hold it back: these are the ends that the best line touches, or
/// those that leave none. A row under the pointer is marked in the plan and in the dual plane.
#include "panes/panes.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// A table in a wide or in a narrow pane. The narrow one leaves out what is 1 or -1 in each row,
/// and the values; it is at least NARROWEST plain texts wide.
enum { COLUMNS = 8, NUMBER = 24, OUT = -1, NARROWEST = 21 };

typedef struct table {
    ui_state *ui;
    double left;
    const double *places; ///< of columns, in plain texts; OUT: left out
} table;

static const double wide[COLUMNS] = {0, 3, 7.2, 11.4, 13.9, 16.4, 19.4, 23.7};
static const double narrow[COLUMNS] = {0, 2.4, 6.7, OUT, OUT, 11, OUT, 14.2};

static void write_number(double value, char text[NUMBER]) {
    if (fabs(value) < 1e-12) value = 0;
    snprintf(text, NUMBER, "%s%.3g", value < 0 ? "\xe2\x88\x92" : "", fabs(value));
}

static void draw_cell(const table *at, int column, double y, bool bold, sl_colour colour,
                      const char *text) {
    if (at->places[column] != OUT)
        ui_text(at->ui, at->left + at->places[column] * at->ui->text, y, 0.85, bold, colour, text);
}

/// One row; its numbers are short.
static void draw_row(const table *at, double y, const sl_program *program,
                     const sl_program_row *row) {
    const sl_palette *palette = &at->ui->palette;
    const bool fixed = row->portal == SL_PROGRAM_FIXED, held = program->solved && !row->basic;
    const sl_colour colour = fixed ? palette->ink : row->left ? palette->glass : palette->start;
    char text[NUMBER];
    if (fixed)
        snprintf(text, sizeof text, "|u|");
    else
        snprintf(text, sizeof text, "%c%u", row->left ? 'L' : 'R', row->portal + 1);
    draw_cell(at, 0, y, held, colour, text);
    for (int i = 0; i < SL_PROGRAM_COLUMNS; i++) {
        write_number(row->coefficients[i], text);
        if (row->coefficients[i] != 0) draw_cell(at, i + 1, y, held, palette->ink, text);
    }
    draw_cell(at, 5, y, held, palette->ink,
              fixed       ? "= 1"
              : row->left ? "\xe2\x89\xa5 0"
                          : "\xe2\x89\xa4 0");
    if (!program->solved) return;
    write_number(row->value, text);
    draw_cell(at, 6, y, held, palette->ink, text);
    write_number(row->price, text);
    draw_cell(at, 7, y, held, held ? palette->ink : palette->faint, held ? text : "basis");
}

/// "maximise d; d = 0.12, margin 1.5; the basis holds ux, uy, c, d".
static void write_optimum(const sl_program *program, char *text, size_t room) {
    static const char *const names[SL_PROGRAM_COLUMNS] = {"ux", "uy", "c", "d"};
    char numbers[SL_PROGRAM_COLUMNS][NUMBER], margin[NUMBER];
    if (!program->solved) {
        snprintf(text, room,
                 "GLPK finds no optimum: no one direction crosses all portals forwards.");
        return;
    }
    for (int i = 0; i < SL_PROGRAM_COLUMNS; i++) write_number(program->values[i], numbers[i]);
    write_number(program->margin, margin);
    size_t used = (size_t)snprintf(
        text, room, "Maximise d: u = (%s, %s), c = %s, d = %s. The margin is %s%s. Basis: ",
        numbers[SL_PROGRAM_UX], numbers[SL_PROGRAM_UY], numbers[SL_PROGRAM_C],
        numbers[SL_PROGRAM_D], margin, program->objective < 0 ? ", so no line is left" : "");
    for (int i = 0; i < SL_PROGRAM_COLUMNS && used < room; i++)
        if (program->basic[i]) used += (size_t)snprintf(text + used, room - used, "%s ", names[i]);
    uint32_t rows = 0;
    for (uint32_t i = 0; i < program->row_count; i++) rows += program->rows[i].basic;
    if (used < room)
        snprintf(text + used, room - used, "and %u of %u rows.", rows, program->row_count);
}

/// Scrolls to a row that is marked elsewhere.
static void reveal(ui_state *ui, sl_box box, sl_box row) {
    const double above = box.min.y - row.min.y, below = row.max.y - box.max.y;
    if (above > 0 || below > 0)
        ui_scroll_by(&ui->scrolls[SCROLL_PROGRAM], above > 0 ? -above : below);
}

/// Draws words and rows from y on; returns where they end.
static double draw_table(learn_state *learn, sl_box box, double y, const sl_program *program) {
    ui_state *ui = learn->ui;
    const lesson_state *lesson = &learn->lesson;
    const double t = ui->text, left = box.min.x + 0.9 * t, high = 1.25 * t;
    static const char *const titles[] = {"row", "ux", "uy", "c", "d", "bound", "value", "price"};
    char text[512];
    write_optimum(program, text, sizeof text);
    y = ui_paragraph(ui, left, y, box_width(box) - 1.8 * t, 0.9, ui->palette.ink, text) + 0.2 * t;
    const table rows = {ui, left, box_width(box) < 31 * t ? narrow : wide};
    for (int i = 0; i < COLUMNS; i++) draw_cell(&rows, i, y, false, ui->palette.faint, titles[i]);
    sl_stab_end marked = {0};
    const bool any = lesson_marked(lesson, &marked);
    for (size_t i = 0; i < program->row_count; i++) {
        const sl_program_row *row = &program->rows[i];
        y += high;
        const sl_box place = {{box.min.x, y - 0.95 * t}, {box.max.x, y + 0.3 * t}};
        const bool fixed = row->portal == SL_PROGRAM_FIXED;
        if (any && !fixed && row->portal == marked.portal && row->left == marked.left) {
            ui_fill(ui, place, sl_colour_mix(ui->palette.page, ui->palette.source, 0.45));
            if (!box_has(box, ui->pointer)) reveal(ui, box, place);
        }
        draw_row(&rows, y, program, row);
        if (!fixed) ui_hit_focus(ui, HIT_END, (int)(2 * row->portal + !row->left), place);
    }
    return y + 0.6 * t;
}

/// Returns where it ends, from y on.
static double draw_program(learn_state *learn, sl_box box, double y) {
    ui_state *ui = learn->ui;
    const double t = ui->text, left = box.min.x + 0.9 * t, room = box_width(box) - 1.8 * t;
    lesson_state *lesson = &learn->lesson;
    ui_text_within(ui, left, y + 1.5 * t, room, 1, ui->palette.ink, "Linear program");
    y += 3.1 * t;
    if (!lesson->end_count) return y;
    sl_status status;
    const sl_program *program = lesson_program(learn->context, lesson, &status);
    if (program) return draw_table(learn, box, y, program);
    return ui_paragraph(ui, left, y, room, 0.95, ui->palette.ink,
                        sl_context_message(learn->context));
}

void pane_program(learn_state *learn, sl_box box) {
    ui_state *ui = learn->ui;
    const double t = ui->text;
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    ui_line(ui, box.min.x + 0.5, box.min.y, box.min.x + 0.5, box.max.y, ui->palette.outline);
    // The columns keep their places: where they have no room, all is set smaller.
    const sl_box room = {{box.min.x + 1, box.min.y + 1}, box.max};
    const double y = ui_begin_scroll(ui, SCROLL_PROGRAM, room);
    ui->text = fmin(t, box_width(box) / NARROWEST);
    const double bottom = draw_program(learn, room, y);
    ui->text = t;
    ui_end_scroll(ui, room, bottom);
    ui_end_area(ui);
}
