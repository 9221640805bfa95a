/// Text, boxes, and one function a widget, which draws it and registers its place.
#include "ui/ui.h"

#include "sightline/draw.h"

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
    ui->message_seconds = 0;
}

void ui_say_working(ui_state *ui, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(ui->message, sizeof ui->message, format, arguments);
    va_end(arguments);
    ui->message_is_error = false;
    ui->message_is_working = true;
    ui->message_seconds = 0;
}

void ui_report(ui_state *ui, const sl_context *context, sl_status status) {
    if (status != SL_OK && status != SL_CANCELLED)
        ui_say(ui, true, "%s", sl_context_message(context));
}

void ui_spaces(char *text) {
    for (; *text; text++)
        if (*text == '_') *text = ' ';
}

int ui_action_find(const ui_state *ui, const char *name) {
    for (int i = 0; i < ui->action_count; i++)
        if (strcmp(ui->actions[i].name, name) == 0) return i;
    return -1;
}

void ui_open_help(ui_state *ui) {
    ui->help = true;
    field_set(&ui->filter, "");
    ui->field = &ui->filter;
    ui->scrolls[SCROLL_HELP] = (ui_scroll){0};
    ui->focus = (ui_focus){0};
}

void ui_shut_help(ui_state *ui) {
    ui->help = false;
    if (ui->field == &ui->filter) ui->field = NULL;
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

void ui_outline(ui_state *ui, sl_box box, double width, sl_colour colour) {
    cairo_rectangle(ui->cairo, box.min.x + width / 2, box.min.y + width / 2, box_width(box) - width,
                    box_height(box) - width);
    sl_set_colour(ui->cairo, colour);
    cairo_set_line_width(ui->cairo, width);
    cairo_stroke(ui->cairo);
}

/// Keeps a text's box for ui_misfit.
static void keep_spot(ui_state *ui, double x, double y, double width, double height,
                      const char *text) {
    if (!ui->spots || ui->spot_count == SPOTS_MOST || !*text) return;
    text_spot *spot = &ui->spots[ui->spot_count++];
    *spot = (text_spot){{{x, y}, {x + width, y + height}}, ui->area, ""};
    // Contents that scroll may lie anywhere above and below.
    if (ui->scrolling >= 0) {
        spot->area.min.y = -1e9;
        spot->area.max.y = 1e9;
    }
    snprintf(spot->text, sizeof spot->text, "%s", text);
}

static bool overlap(const sl_box *a, const sl_box *b) {
    return fmin(a->max.x, b->max.x) - fmax(a->min.x, b->min.x) > 1 &&
           fmin(a->max.y, b->max.y) - fmax(a->min.y, b->min.y) > 1;
}

const char *ui_misfit(const ui_state *ui, char text[160]) {
    for (int i = 0; i < ui->spot_count; i++) {
        const text_spot *s = &ui->spots[i];
        if (s->box.min.x < s->area.min.x - 1 || s->box.max.x > s->area.max.x + 1 ||
            s->box.min.y < s->area.min.y - 1 || s->box.max.y > s->area.max.y + 1) {
            snprintf(text, 160, "'%s' reaches out of its panel", s->text);
            return text;
        }
        for (int k = 0; k < i; k++) {
            const text_spot *o = &ui->spots[k];
            const bool same = memcmp(&o->area, &s->area, sizeof o->area) == 0;
            if (!same || !overlap(&o->box, &s->box)) continue;
            snprintf(text, 160, "'%s' lies on '%s'", s->text, o->text);
            return text;
        }
    }
    return NULL;
}

double ui_text(ui_state *ui, double x, double y, double size, bool bold, sl_colour colour,
               const char *text) {
    const double high = size * ui->text;
    sl_text_font(ui->cairo, high, bold);
    sl_text_show(ui->cairo, colour, x, y, text);
    const double width = sl_text_width(ui->cairo, text);
    keep_spot(ui, x, y - 0.75 * high, width, 0.95 * high, text);
    return width;
}

double ui_text_width(ui_state *ui, double size, bool bold, const char *text) {
    sl_text_font(ui->cairo, size * ui->text, bold);
    return sl_text_width(ui->cairo, text);
}

void ui_text_right(ui_state *ui, double x, double y, double size, sl_colour colour,
                   const char *text) {
    ui_text(ui, x - ui_text_width(ui, size, false, text), y, size, false, colour, text);
}

void ui_text_within(ui_state *ui, double x, double y, double width, double size, sl_colour colour,
                    const char *text) {
    const double high = size * ui->text, wanted = ui_text_width(ui, size, false, text);
    sl_text_show_within(ui->cairo, colour, x, y, width, high, false, text);
    // Where it had to be cut, that is a fault of the place.
    keep_spot(ui, x, y - 0.75 * high, fmax(fmin(wanted, width), wanted * 2 / 3), 0.95 * high, text);
}

double ui_lines(ui_state *ui, double x, double y, double width, double size, bool bold,
                sl_colour colour, const char *text) {
    const double high = size * ui->text;
    sl_text_font(ui->cairo, high, bold);
    const unsigned lines = sl_text_show_lines(ui->cairo, colour, x, y, width, 1.4 * high, text);
    if (lines)
        keep_spot(ui, x, y - 0.75 * high, lines > 1 ? width : sl_text_width(ui->cairo, text),
                  1.4 * high * (lines - 1) + 0.95 * high, text);
    return y + 1.4 * high * lines;
}

double ui_paragraph(ui_state *ui, double x, double y, double width, double size, sl_colour colour,
                    const char *text) {
    return ui_lines(ui, x, y, width, size, false, colour, text);
}

double ui_lines_height(ui_state *ui, double width, double size, bool bold, const char *text) {
    sl_text_font(ui->cairo, size * ui->text, bold);
    return 1.4 * size * ui->text * sl_text_lines(ui->cairo, width, text);
}

/// Makes a colour a little stronger under the pointer.
static sl_colour ground_of(const ui_state *ui, sl_box box, bool on) {
    const sl_palette *p = &ui->palette;
    const sl_colour plain = on ? sl_colour_mix(p->page, p->glass, p->dark ? 0.34 : 0.22)
                               : sl_colour_mix(p->page, p->ink, 0.07);
    return box_has(box, ui->pointer) ? sl_colour_mix(plain, p->ink, 0.09) : plain;
}

bool ui_has_focus(const ui_state *ui) {
    const hit_area *last = ui->hit_count ? &ui->hits[ui->hit_count - 1] : NULL;
    return last && last->kind == ui->focus.kind && last->value == ui->focus.value &&
           ui->copies - 1 == ui->focus.copy;
}

void ui_mark_focus(ui_state *ui, sl_box box) {
    ui_outline(ui, box, fmax(0.15 * ui->text, 2), ui->palette.start);
}

void ui_hit_focus(ui_state *ui, hit_kind kind, int value, sl_box box) {
    ui_hit(ui, kind, value, box);
    if (ui_has_focus(ui)) ui_mark_focus(ui, box);
}

double ui_button_width(ui_state *ui, const char *label) {
    return ui_text_width(ui, 0.95, false, label) + 1.3 * ui->text;
}

double ui_button(ui_state *ui, double x, double y, double height, const char *label, bool on,
                 int action) {
    const double width = ui_button_width(ui, label);
    const sl_box box = {{x, y}, {x + width, y + height}};
    ui_fill_round(ui, box, 0.3 * ui->text, ground_of(ui, box, on));
    ui_text(ui, x + 0.65 * ui->text, y + height / 2 + 0.35 * ui->text, 0.95, false, ui->palette.ink,
            label);
    ui_hit_focus(ui, HIT_ACTION, action, box);
    return box.max.x;
}

static void draw_tick(ui_state *ui, sl_box mark) {
    const double half = box_width(mark) / 2, x = mark.min.x, middle = mark.min.y + half;
    cairo_move_to(ui->cairo, x + 0.45 * half, middle + 0.05 * half);
    cairo_line_to(ui->cairo, x + 0.85 * half, middle + 0.5 * half);
    cairo_line_to(ui->cairo, x + 1.6 * half, middle - 0.5 * half);
    sl_set_colour(ui->cairo, ui->palette.page);
    cairo_set_line_width(ui->cairo, 0.16 * ui->text);
    cairo_stroke(ui->cairo);
}

double ui_check(ui_state *ui, sl_box row, const char *label, const char *key, bool on, int action) {
    const double t = ui->text, middle = row.min.y + 0.75 * t, half = 0.46 * t;
    const double x = row.min.x + 0.4 * t, words = x + 1.5 * t, end = row.max.x - 0.4 * t;
    const double room = end - words - (key ? ui_text_width(ui, 0.9, false, key) + 0.6 * t : 0);
    row.max.y = row.min.y + fmax(ui_lines_height(ui, room, 1, false, label) + 0.1 * t, 1.5 * t);
    if (box_has(row, ui->pointer)) ui_fill_round(ui, row, 0.25 * t, ground_of(ui, row, false));
    const sl_box mark = {{x, middle - half}, {x + 2 * half, middle + half}};
    ui_fill_round(ui, mark, 0.2 * t, on ? ui->palette.glass : ui->palette.faint);
    const double rim = 0.1 * t;
    if (on)
        draw_tick(ui, mark);
    else
        ui_fill_round(
            ui,
            (sl_box){{mark.min.x + rim, mark.min.y + rim}, {mark.max.x - rim, mark.max.y - rim}},
            0.12 * t, ui->palette.page);
    ui_lines(ui, words, middle + 0.36 * t, room, 1, false, ui->palette.ink, label);
    if (key) ui_text_right(ui, end, middle + 0.36 * t, 0.9, ui->palette.faint, key);
    ui_hit_focus(ui, HIT_ACTION, action, row);
    return row.max.y;
}

double ui_slider_at(const ui_state *ui, sl_box box, sl_point at) {
    const double margin = 0.5 * ui->text, low = box.min.x + margin, high = box.max.x - margin;
    return high > low ? fmin(fmax((at.x - low) / (high - low), 0), 1) : 0;
}

void ui_slider(ui_state *ui, sl_box track, double value, hit_kind kind, int number) {
    const double t = ui->text, y = (track.min.y + track.max.y) / 2;
    const double x = track.min.x + fmin(fmax(value, 0), 1) * box_width(track);
    const double thick = 0.14 * t;
    ui_fill(ui, (sl_box){{track.min.x, y - thick}, {track.max.x, y + thick}}, ui->palette.faint);
    ui_fill(ui, (sl_box){{track.min.x, y - thick}, {x, y + thick}}, ui->palette.glass);
    cairo_new_path(ui->cairo);
    cairo_arc(ui->cairo, x, y, 0.5 * t, 0, 6.283185307179586);
    sl_set_colour(ui->cairo, ui->palette.glass);
    cairo_fill(ui->cairo);
    const sl_box box = {{track.min.x - 0.5 * t, track.min.y}, {track.max.x + 0.5 * t, track.max.y}};
    ui_hit_focus(ui, kind, number, box);
}

void ui_edge(ui_state *ui, int number, sl_box box) {
    if (box_has(box, ui->pointer)) ui_fill(ui, box, ui->palette.faint);
    ui_hit_focus(ui, HIT_EDGE, number, box);
}

// --- text fields

/// The width of the text before a place.
static double width_to(ui_state *ui, const text_field *field, size_t at) {
    char text[FIELD_TEXT];
    memcpy(text, field->text, at);
    text[at] = '\0';
    return ui_text_width(ui, 1, false, text);
}

/// The place between two characters that is nearest to a click.
static size_t find_cursor(ui_state *ui, const text_field *field, double x) {
    size_t at = 0, best = 0;
    double nearest = fabs(x);
    while (field->text[at]) {
        do at++;
        while (((unsigned char)field->text[at] & 0xc0) == 0x80);
        const double distance = fabs(width_to(ui, field, at) - x);
        if (distance > nearest) break;
        nearest = distance;
        best = at;
    }
    return best;
}

void ui_text_field(ui_state *ui, sl_box box, text_field *field, const char *empty, bool typed) {
    const double t = ui->text, left = box.min.x + 0.5 * t, wide = box_width(box) - t;
    const double base = (box.min.y + box.max.y) / 2 + 0.36 * t, rim = typed ? fmax(0.15 * t, 2) : 1;
    const sl_box inner = {{box.min.x + rim, box.min.y + rim}, {box.max.x - rim, box.max.y - rim}};
    ui_fill(ui, box, typed ? ui->palette.glass : ui->palette.faint);
    ui_fill(ui, inner, ui->palette.page);
    if (field->clicked) field->at = find_cursor(ui, field, field->click_x - left + field->shift);
    field->clicked = false;
    const double cursor = width_to(ui, field, field->at);
    const double all = width_to(ui, field, strlen(field->text));
    field->shift = fmin(fmax(field->shift, cursor - wide), cursor);
    if (all <= wide) field->shift = 0;
    const double x = left - field->shift, low = base - 0.9 * t, high = base + 0.25 * t;
    cairo_save(ui->cairo);
    cairo_rectangle(ui->cairo, left - 2, box.min.y, wide + 4, box_height(box));
    cairo_clip(ui->cairo);
    if (typed && field->chosen)
        ui_fill(ui, (sl_box){{x, low}, {x + all, high}},
                sl_colour_mix(ui->palette.page, ui->palette.glass, 0.3));
    // A long text is cut at the field's ends on purpose: it follows the cursor.
    sl_text_font(ui->cairo, t, false);
    sl_text_show(ui->cairo, *field->text ? ui->palette.ink : ui->palette.faint, x, base,
                 *field->text ? field->text
                 : empty      ? empty
                              : "");
    if (typed)
        ui_fill(ui, (sl_box){{x + cursor, low}, {x + cursor + fmax(0.1 * t, 1), high}},
                ui->palette.ink);
    cairo_restore(ui->cairo);
}
