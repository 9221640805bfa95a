#include "ui.h"

#include "sightline/canvas.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void ui_say(ui_state *ui, bool error, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(ui->message, sizeof ui->message, format, arguments);
    va_end(arguments);
    ui->message_is_error = error;
    ui->message_is_working = false;
}

void ui_say_working(ui_state *ui, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(ui->message, sizeof ui->message, format, arguments);
    va_end(arguments);
    ui->message_is_error = false;
    ui->message_is_working = true;
}

void ui_hit(ui_state *ui, hit_kind kind, int value, sl_box box) {
    if (ui->hit_count < HITS_MOST) ui->hits[ui->hit_count++] = (hit_area){kind, value, box};
}

bool box_has(sl_box box, sl_point at) {
    return at.x >= box.min.x && at.x < box.max.x && at.y >= box.min.y && at.y < box.max.y;
}

hit_area ui_find(const ui_state *ui, sl_point at) {
    for (int i = ui->hit_count; i-- > 0;)
        if (box_has(ui->hits[i].box, at)) return ui->hits[i];
    return (hit_area){0};
}

void ui_fill(ui_state *ui, sl_box box, sl_colour colour) {
    sl_set_colour(ui->cairo, colour);
    cairo_rectangle(ui->cairo, box.min.x, box.min.y, box_width(box), box_height(box));
    cairo_fill(ui->cairo);
}

void ui_fill_round(ui_state *ui, sl_box box, double r, sl_colour colour) {
    const double quarter = 1.5707963267948966;
    cairo_new_path(ui->cairo);
    cairo_arc(ui->cairo, box.max.x - r, box.min.y + r, r, -quarter, 0);
    cairo_arc(ui->cairo, box.max.x - r, box.max.y - r, r, 0, quarter);
    cairo_arc(ui->cairo, box.min.x + r, box.max.y - r, r, quarter, 2 * quarter);
    cairo_arc(ui->cairo, box.min.x + r, box.min.y + r, r, 2 * quarter, 3 * quarter);
    cairo_close_path(ui->cairo);
    sl_set_colour(ui->cairo, colour);
    cairo_fill(ui->cairo);
}

void ui_line(ui_state *ui, double x0, double y0, double x1, double y1, sl_colour colour) {
    cairo_move_to(ui->cairo, x0, y0);
    cairo_line_to(ui->cairo, x1, y1);
    sl_set_colour(ui->cairo, colour);
    cairo_set_line_width(ui->cairo, 1);
    cairo_stroke(ui->cairo);
}

double ui_text(ui_state *ui, double x, double y, double size, bool bold, sl_colour colour,
               const char *text) {
    sl_text_font(ui->cairo, size * ui->text, bold);
    sl_text_show(ui->cairo, colour, x, y, text);
    return sl_text_width(ui->cairo, text);
}

double ui_text_width(ui_state *ui, double size, bool bold, const char *text) {
    sl_text_font(ui->cairo, size * ui->text, bold);
    return sl_text_width(ui->cairo, text);
}

void ui_text_right(ui_state *ui, double x, double y, double size, sl_colour colour,
                   const char *text) {
    sl_text_font(ui->cairo, size * ui->text, false);
    sl_text_show(ui->cairo, colour, x - sl_text_width(ui->cairo, text), y, text);
}

double ui_paragraph(ui_state *ui, double x, double y, double width, double size, sl_colour colour,
                    const char *text) {
    char line[256] = "";
    sl_text_font(ui->cairo, size * ui->text, false);
    while (*text) {
        const size_t word = strcspn(text, " "), kept = strlen(line);
        if (kept + word + 2 > sizeof line) break;
        if (kept) strcat(line, " ");
        strncat(line, text, word);
        if (kept && sl_text_width(ui->cairo, line) > width) {
            line[kept] = '\0';
            sl_text_show(ui->cairo, colour, x, y, line);
            y += 1.4 * size * ui->text;
            line[0] = '\0';
            continue;
        }
        text += word;
        while (*text == ' ') text++;
    }
    if (*line) {
        sl_text_show(ui->cairo, colour, x, y, line);
        y += 1.4 * size * ui->text;
    }
    return y;
}

/// Makes a colour a little stronger under the pointer.
static sl_colour ground_of(const ui_state *ui, sl_box box, bool on) {
    const sl_palette *p = &ui->palette;
    const sl_colour plain = on ? sl_colour_mix(p->page, p->glass, p->dark ? 0.34 : 0.22)
                               : sl_colour_mix(p->page, p->ink, 0.07);
    return box_has(box, ui->pointer) ? sl_colour_mix(plain, p->ink, 0.09) : plain;
}

double ui_button(ui_state *ui, double x, double y, double height, const char *label, bool on,
                 int action) {
    const double width = ui_text_width(ui, 0.95, false, label) + 1.3 * ui->text;
    const sl_box box = {{x, y}, {x + width, y + height}};
    ui_fill_round(ui, box, 0.3 * ui->text, ground_of(ui, box, on));
    ui_text(ui, x + 0.65 * ui->text, y + height / 2 + 0.35 * ui->text, 0.95, false, ui->palette.ink,
            label);
    ui_hit(ui, HIT_ACTION, action, box);
    return box.max.x;
}

void ui_check(ui_state *ui, sl_box row, const char *label, const char *key, bool on, int action) {
    const double t = ui->text, middle = (row.min.y + row.max.y) / 2, half = 0.46 * t;
    const double x = row.min.x + 0.4 * t;
    if (box_has(row, ui->pointer)) ui_fill_round(ui, row, 0.25 * t, ground_of(ui, row, false));
    const sl_box mark = {{x, middle - half}, {x + 2 * half, middle + half}};
    ui_fill_round(ui, mark, 0.2 * t, on ? ui->palette.glass : ui->palette.outline);
    if (on) {
        cairo_move_to(ui->cairo, x + 0.45 * half, middle + 0.05 * half);
        cairo_line_to(ui->cairo, x + 0.85 * half, middle + 0.5 * half);
        cairo_line_to(ui->cairo, x + 1.6 * half, middle - 0.5 * half);
        sl_set_colour(ui->cairo, ui->palette.page);
        cairo_set_line_width(ui->cairo, 0.16 * t);
        cairo_stroke(ui->cairo);
    }
    ui_text(ui, x + 1.5 * t, middle + 0.36 * t, 1, false, ui->palette.ink, label);
    if (key) ui_text_right(ui, row.max.x - 0.4 * t, middle + 0.36 * t, 0.9, ui->palette.faint, key);
    ui_hit(ui, HIT_ACTION, action, row);
}

void ui_slider(ui_state *ui, sl_box track, double value, hit_kind kind, int number) {
    const double t = ui->text, y = (track.min.y + track.max.y) / 2;
    const double x = track.min.x + fmin(fmax(value, 0), 1) * box_width(track);
    const double thick = 0.14 * t;
    ui_fill(ui, (sl_box){{track.min.x, y - thick}, {track.max.x, y + thick}}, ui->palette.outline);
    ui_fill(ui, (sl_box){{track.min.x, y - thick}, {x, y + thick}}, ui->palette.glass);
    cairo_new_path(ui->cairo);
    cairo_arc(ui->cairo, x, y, 0.5 * t, 0, 6.283185307179586);
    sl_set_colour(ui->cairo, ui->palette.glass);
    cairo_fill(ui->cairo);
    ui_hit(ui, kind, number,
           (sl_box){{track.min.x - 0.5 * t, track.min.y}, {track.max.x + 0.5 * t, track.max.y}});
}
