/// The stack of dialogs, their widgets, and the keys that all share: Tab and Shift+Tab go from
/// widget to widget, Return does what is in focus, or the main thing, Escape cancels, arrows and
/// the wheel move in lists.
#include "dialogs/dialog.h"

#include "sightline/draw.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

dialog_kind dialog_open_now(const dialog_state *d) {
    return d->depth ? d->stack[d->depth - 1] : DIALOG_NONE;
}

static const dialog_row *row_now(const dialog_state *d) {
    return &d->rows[dialog_open_now(d)];
}

void dialog_push(dialog_state *d, dialog_kind kind, int focus) {
    ui_shut_help(d->ui);
    d->item_count = 0;
    if (d->depth == DIALOGS_MOST) d->depth--;
    d->stack[d->depth] = kind;
    d->focus[d->depth++] = focus;
    d->tab_from = 0;
}

void dialog_pop(dialog_state *d) {
    if (d->depth) d->depth--;
    d->item_count = 0;
}

bool dialog_clear(dialog_state *d) {
    while (d->depth && dialog_open_now(d) != DIALOG_QUESTION)
        row_now(d)->act(d->desk, DIALOG_CANCEL);
    return d->depth == 0;
}

void dialog_destroy(dialog_state *d) {
    for (int i = 1; i < DIALOG_KINDS; i++)
        if (d->rows[i].destroy) d->rows[i].destroy(d->desk);
}

/// Only the uppermost one is drawn.
void dialog_draw(dialog_state *d) {
    d->item_count = 0;
    d->title[0] = d->problem[0] = '\0';
    d->beside = false;
    if (d->depth) row_now(d)->draw(d->desk);
}

bool dialog_is_unseen(const dialog_state *d) {
    return d->depth && !d->item_count;
}

// --- widgets

static int *focus_of(dialog_state *d) {
    return &d->focus[d->depth ? d->depth - 1 : 0];
}

static void add_item(dialog_state *d, dialog_item item) {
    if (d->item_count < ITEMS_MOST) d->items[d->item_count++] = item;
}

sl_box dialog_begin(dialog_state *d, double width, double height, const char *title) {
    ui_state *ui = d->ui;
    const sl_box all = {{0, 0}, {ui->width, ui->height}};
    const double room = fmin((ui->width - 12) / width, (ui->height - 12) / height);
    d->text = ui->text;
    snprintf(d->title, sizeof d->title, "%s", title);
    ui->text = fmin(ui->text, room);
    ui_hit(ui, HIT_DIALOG, 0, all);
    const sl_colour dim = ui->palette.dark ? ui->palette.page : ui->palette.ink;
    cairo_set_source_rgba(ui->cairo, dim.red, dim.green, dim.blue, 0.45);
    cairo_paint(ui->cairo);
    const double t = ui->text, w = width * t, h = height * t;
    const sl_box sheet = {{floor((ui->width - w) / 2), floor((ui->height - h) / 2)},
                          {floor((ui->width + w) / 2), floor((ui->height + h) / 2)}};
    ui_fill_round(ui,
                  (sl_box){{sheet.min.x - 1, sheet.min.y - 1}, {sheet.max.x + 1, sheet.max.y + 1}},
                  0.6 * t, ui->palette.outline);
    ui_begin_area(ui, sheet);
    sl_text_show_within(ui->cairo, ui->palette.ink, sheet.min.x + 1.3 * t, sheet.min.y + 2 * t,
                        w - 2.6 * t, 1.3 * t, true, title);
    return (sl_box){{sheet.min.x + 1.3 * t, sheet.min.y + 3 * t},
                    {sheet.max.x - 1.3 * t, sheet.max.y - 1.1 * t}};
}

sl_box dialog_begin_beside(dialog_state *d, double width, double height, const char *title) {
    ui_state *ui = d->ui;
    const sl_box dock = d->dock;
    d->text = ui->text;
    d->beside = true;
    snprintf(d->title, sizeof d->title, "%s", title);
    ui->text = fmin(ui->text, fmin(box_width(dock) / width, box_height(dock) / height));
    const double t = ui->text;
    ui_hit(ui, HIT_DIALOG, 0, dock);
    ui_begin_area(ui, dock);
    ui_line(ui, dock.min.x + 0.5, dock.min.y, dock.min.x + 0.5, dock.max.y, ui->palette.outline);
    sl_text_show_within(ui->cairo, ui->palette.ink, dock.min.x + t, dock.min.y + 1.8 * t,
                        box_width(dock) - 2 * t, 1.2 * t, true, title);
    return (sl_box){{dock.min.x + t, dock.min.y + 2.4 * t}, {dock.max.x - t, dock.max.y - 0.8 * t}};
}

void dialog_end(dialog_state *d) {
    ui_end_area(d->ui);
    d->ui->text = d->text;
}

void dialog_problem(dialog_state *d, sl_point at, double width, const char *text) {
    ui_state *ui = d->ui;
    snprintf(d->problem, sizeof d->problem, "%s", text);
    const double more = dialog_problem_height(d, width / ui->text, text) * ui->text;
    const sl_box ground = {{at.x, at.y - more - ui->text}, {at.x + width, at.y}};
    if (more > 0) ui_fill_round(ui, ground, 0, ui->palette.page);
    if (*text) ui_lines(ui, at.x, at.y - more, width, 1, false, ui->palette.start, text);
}

double dialog_problem_height(dialog_state *d, double width, const char *text) {
    ui_state *ui = d->ui;
    if (!*text) return 0;
    return ui_lines_height(ui, width * ui->text, 1, false, text) / ui->text -
           ui_lines_height(ui, width * ui->text, 1, false, "x") / ui->text;
}

/// A frame about what is in focus.
static void draw_focus(dialog_state *d, int id, sl_box box) {
    ui_state *ui = d->ui;
    if (*focus_of(d) != id) return;
    const double line = fmax(2, 0.13 * ui->text);
    cairo_rectangle(ui->cairo, box.min.x - line / 2, box.min.y - line / 2, box_width(box) + line,
                    box_height(box) + line);
    sl_set_colour(ui->cairo, ui->palette.glass);
    cairo_set_line_width(ui->cairo, line);
    cairo_stroke(ui->cairo);
}

static sl_colour ground(const ui_state *ui, sl_box box, double strength) {
    const double more = box_has(box, ui->pointer) ? 0.09 : 0;
    return sl_colour_mix(ui->palette.page, ui->palette.ink, strength + more);
}

static double button_width(ui_state *ui, const char *label) {
    return ui_text_width(ui, 1, false, label) + 1.6 * ui->text;
}

static void draw_button(dialog_state *d, double x, double y, const dialog_label *button) {
    ui_state *ui = d->ui;
    const double t = ui->text;
    const sl_box box = {{x, y}, {x + button_width(ui, button->label), y + 1.8 * t}};
    ui_fill_round(ui, box, 0.3 * t, ground(ui, box, 0.1));
    ui_text(ui, x + 0.8 * t, y + 1.25 * t, 1, false, ui->palette.ink, button->label);
    draw_focus(d, button->id, box);
    ui_hit(ui, HIT_DIALOG, button->id, box);
    add_item(d, (dialog_item){.kind = ITEM_BUTTON, .id = button->id, .box = box});
}

double dialog_buttons_width(dialog_state *d, const dialog_label *buttons, int count) {
    double wide = -0.6 * d->ui->text;
    for (int i = 0; i < count; i++)
        wide += button_width(d->ui, buttons[i].label) + 0.6 * d->ui->text;
    return wide;
}

void dialog_head(dialog_state *d, int id, sl_box box, const char *label) {
    ui_state *ui = d->ui;
    if (box_has(box, ui->pointer)) ui_fill(ui, box, ground(ui, box, 0));
    ui_text(ui, box.min.x + 0.5 * ui->text, box.max.y - 0.45 * ui->text, 0.95, false,
            ui->palette.faint, label);
    draw_focus(d, id, box);
    ui_hit(ui, HIT_DIALOG, id, box);
    add_item(d, (dialog_item){.kind = ITEM_BUTTON, .id = id, .box = box});
}

double dialog_buttons(dialog_state *d, double x, double y, const dialog_label *buttons, int count) {
    const double gap = 0.6 * d->ui->text;
    const double first = x -= dialog_buttons_width(d, buttons, count);
    for (int i = 0; i < count; i++) {
        draw_button(d, x, y, &buttons[i]);
        x += button_width(d->ui, buttons[i].label) + gap;
    }
    return first;
}

void dialog_check(dialog_state *d, int id, sl_box row, const char *label, bool on) {
    ui_state *ui = d->ui;
    // The widget of the panel registers an action: the hit that follows lies over it.
    ui_check(ui, row, label, NULL, on, -1);
    draw_focus(d, id, row);
    ui_hit(ui, HIT_DIALOG, id, row);
    add_item(d, (dialog_item){.kind = ITEM_CHECK, .id = id, .box = row});
}

void dialog_field(dialog_state *d, int id, sl_box box, text_field *field, const char *hint) {
    ui_text_field(d->ui, box, field, hint, *focus_of(d) == id);
    ui_hit(d->ui, HIT_DIALOG, id, box);
    add_item(d, (dialog_item){.kind = ITEM_FIELD, .id = id, .field = field, .box = box});
}

static double row_height(const ui_state *ui) {
    return 1.7 * ui->text;
}

void dialog_list_frame(dialog_state *d, int id, sl_box box, dialog_list *list) {
    ui_state *ui = d->ui;
    const double high = row_height(ui);
    ui_fill(ui, box, ui->palette.outline);
    ui_fill(ui, (sl_box){{box.min.x + 1, box.min.y + 1}, {box.max.x - 1, box.max.y - 1}},
            ui->palette.page);
    list->page = (size_t)fmax(floor((box_height(box) - 2) / high), 1);
    if (list->at != SIZE_MAX && list->at >= list->count) list->at = SIZE_MAX;
    if (list->first + list->page > list->count)
        list->first = list->count > list->page ? list->count - list->page : 0;
    ui_hit(ui, HIT_DIALOG, id, box);
    if (list->count > list->page) {
        const double share = box_height(box) / (double)list->count;
        const double top = box.min.y + share * (double)list->first;
        ui_fill(ui,
                (sl_box){{box.max.x - 0.5 * ui->text, top},
                         {box.max.x - 1, fmin(top + share * (double)list->page, box.max.y)}},
                ui->palette.faint);
    }
    draw_focus(d, id, box);
    add_item(d, (dialog_item){.kind = ITEM_LIST, .id = id, .list = list, .box = box});
}

sl_box dialog_list_row(dialog_state *d, int id, sl_box box, const dialog_list *list, size_t row) {
    ui_state *ui = d->ui;
    const double high = row_height(ui), y = box.min.y + 1 + high * (double)(row - list->first);
    const double right = list->count > list->page ? 0.6 * ui->text : 0;
    const sl_box place = {{box.min.x + 1, y}, {box.max.x - 1 - right, y + high}};
    const bool over = box_has(place, ui->pointer);
    if (over || row == list->at)
        ui_fill(ui, place,
                sl_colour_mix(ui->palette.page, ui->palette.glass, row == list->at ? 0.3 : 0.12));
    ui_hit(ui, HIT_DIALOG, id | ((int)row + 1) << 8, place);
    return place;
}

void dialog_list_go(dialog_list *list, size_t row) {
    if (!list->count) return;
    list->at = row < list->count ? row : list->count - 1;
    if (list->at < list->first) list->first = list->at;
    if (list->page && list->at >= list->first + list->page) list->first = list->at - list->page + 1;
}

// --- keys and pointer

static dialog_item *find_item(dialog_state *d, int id) {
    for (int i = 0; i < d->item_count; i++)
        if (d->items[i].id == id) return &d->items[i];
    return NULL;
}

/// The list that arrows move in: the one in focus, else the first.
static dialog_item *find_list(dialog_state *d) {
    dialog_item *focused = find_item(d, *focus_of(d));
    if (focused && focused->kind == ITEM_LIST) return focused;
    for (int i = 0; i < d->item_count; i++)
        if (d->items[i].kind == ITEM_LIST) return &d->items[i];
    return NULL;
}

static void tell_edited(dialog_state *d, int id) {
    d->tab_from = 0;
    const dialog_row *row = row_now(d);
    if (row->edited) row->edited(d->desk, id);
}

static bool list_key(dialog_state *d, const char *key, bool focused) {
    dialog_item *item = find_list(d);
    if (!item || !item->list->count) return false;
    dialog_list *list = item->list;
    const size_t last = list->count - 1, page = list->page ? list->page : 1;
    const bool none = list->at == SIZE_MAX;
    size_t to = none ? 0 : list->at;
    if (strcmp(key, "Up") == 0)
        to -= to > 0;
    else if (strcmp(key, "Down") == 0)
        to += !none && to < last;
    else if (strcmp(key, "PageUp") == 0)
        to -= to < page ? to : page;
    else if (strcmp(key, "PageDown") == 0)
        to = to + page < last ? to + page : last;
    else if (focused && strcmp(key, "Home") == 0)
        to = 0;
    else if (focused && strcmp(key, "End") == 0)
        to = last;
    else
        return false;
    dialog_list_go(list, to);
    // Return means the row now, and no longer the button that was in focus.
    const dialog_item *before = find_item(d, *focus_of(d));
    if (!before || before->kind != ITEM_FIELD) *focus_of(d) = item->id;
    tell_edited(d, item->id);
    return true;
}

static void move_focus(dialog_state *d, int by) {
    const int from = find_item(d, d->tab_from) ? d->tab_from : *focus_of(d);
    int at = -1;
    if (!d->item_count) return;
    for (int i = 0; i < d->item_count; i++)
        if (d->items[i].id == from) at = i;
    d->tab_from = 0;
    at = at < 0 ? (by > 0 ? 0 : d->item_count - 1) : (at + by + d->item_count) % d->item_count;
    *focus_of(d) = d->items[at].id;
}

static void press_return(dialog_state *d, const dialog_item *focused) {
    const bool own = focused && focused->kind != ITEM_FIELD && focused->kind != ITEM_CHECK &&
                     !(focused->list && focused->list->marks);
    row_now(d)->act(d->desk, own ? focused->id : DIALOG_MAIN);
}

/// Where the focus goes by a key: 1 on, -1 back, 0 nowhere. Arrows count where nothing else takes
/// them.
static int focus_step(const char *key, bool arrows) {
    static const struct {
        const char *key;
        int by;
        bool arrow;
    } steps[] = {{"Tab", 1, false}, {"Shift+Tab", -1, false}, {"Left", -1, true},
                 {"Up", -1, true},  {"Right", 1, true},       {"Down", 1, true}};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (steps[i].arrow == arrows && strcmp(key, steps[i].key) == 0) return steps[i].by;
    return 0;
}

/// The keys of the widget in focus, and those of the list; false for others.
static bool widget_key(dialog_state *d, const char *key) {
    dialog_item *focused = find_item(d, *focus_of(d));
    bool changed = false;
    if (focused && focused->kind == ITEM_FIELD && field_key(focused->field, key, &changed)) {
        if (changed) tell_edited(d, focused->id);
        return true;
    }
    if (strcmp(key, "Space") == 0) {
        if (focused && focused->kind != ITEM_FIELD) row_now(d)->act(d->desk, focused->id);
        return true;
    }
    return list_key(d, key, focused && focused->kind == ITEM_LIST);
}

void dialog_key(dialog_state *d, const char *key, bool down) {
    if (!down || strcmp(key, d->deaf) != 0) d->deaf[0] = '\0';
    if (!down) return;
    const dialog_row *row = row_now(d);
    if (strcmp(key, "Escape") == 0) {
        row->act(d->desk, DIALOG_CANCEL);
        return;
    }
    if (row->key && row->key(d->desk, key)) return;
    if (strcmp(key, "Return") == 0)
        press_return(d, find_item(d, *focus_of(d)));
    else if (focus_step(key, false))
        move_focus(d, focus_step(key, false));
    else if (!widget_key(d, key) && focus_step(key, true))
        move_focus(d, focus_step(key, true));
}

void dialog_text(dialog_state *d, const char *text) {
    dialog_item *focused = find_item(d, *focus_of(d));
    const int other = row_now(d)->types_into;
    if (d->deaf[0]) return;
    // A space has pressed what has the focus.
    if (other && *text != ' ' && find_item(d, other) && (!focused || focused->kind != ITEM_FIELD)) {
        *focus_of(d) = other;
        focused = find_item(d, other);
    }
    if (!focused || focused->kind != ITEM_FIELD) return;
    field_insert(focused->field, text);
    tell_edited(d, focused->id);
}

static void press_row(dialog_state *d, dialog_item *item, size_t row) {
    const bool again = item->list->at == row || item->list->acts;
    const int id = item->id;
    dialog_list_go(item->list, row);
    if (again)
        row_now(d)->act(d->desk, id);
    else
        tell_edited(d, id);
}

void dialog_press(dialog_state *d, const hit_area *hit, sl_point at) {
    if (hit->kind != HIT_DIALOG) return;
    const int id = hit->value & 255, row = (hit->value >> 8) - 1;
    dialog_item *item = find_item(d, id);
    if (!item) {
        // Beside the sheet: a menu goes away.
        if (hit->value == 0 && dialog_open_now(d) == DIALOG_MENU) dialog_pop(d);
        return;
    }
    *focus_of(d) = id;
    if (item->kind == ITEM_FIELD) {
        item->field->clicked = true;
        item->field->chosen = false;
        item->field->click_x = at.x;
    } else if (item->kind != ITEM_LIST) {
        row_now(d)->act(d->desk, id);
    } else if (row >= 0) {
        press_row(d, item, (size_t)row);
    }
}

void dialog_wheel(dialog_state *d, double steps) {
    dialog_list *list = NULL;
    for (int i = 0; i < d->item_count; i++)
        if (d->items[i].kind == ITEM_LIST && (!list || box_has(d->items[i].box, d->ui->pointer)))
            list = d->items[i].list;
    if (!list) return;
    const double to = (double)list->first - round(3 * fmin(fmax(steps, -5), 5));
    const size_t last = list->count > list->page ? list->count - list->page : 0;
    list->first = to <= 0 ? 0 : to >= (double)last ? last : (size_t)to;
}
