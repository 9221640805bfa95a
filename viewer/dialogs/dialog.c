/// The stack of dialogs, their widgets, and the keys that all share: Tab and Shift+Tab go from
/// widget to widget, Return does what is in focus, or the main thing, Escape cancels, arrows and
/// the wheel move in lists.
#include "dialogs/dialog.h"

#include "app/app.h"
#include "dialogs/browser.h"
#include "dialogs/import_dialog.h"
#include "dialogs/question.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/// What a dialog is made of. Functions but `draw` and `act` may be NULL.
typedef struct dialog_row {
    void (*draw)(app_state *app);
    void (*act)(app_state *app, int id);          ///< a button, a check, a row twice
    void (*edited)(app_state *app, int id);       ///< a field, or the choice of a list
    bool (*key)(app_state *app, const char *key); ///< before all others; false: not its own
    void (*destroy)(app_state *app);              ///< at the end of the program
} dialog_row;

static const dialog_row dialogs[] = {
    [DIALOG_MENU] = {menu_draw, menu_act, NULL, NULL, NULL},
    [DIALOG_BROWSER] = {browser_draw, browser_act, browser_edited, browser_key, browser_destroy},
    [DIALOG_IMPORT] = {import_draw, import_act, import_edited, NULL, import_destroy},
    [DIALOG_QUESTION] = {question_draw, question_act, NULL, question_key, NULL},
};

dialog_kind dialog_open_now(const app_state *app) {
    return app->dialog.depth ? app->dialog.stack[app->dialog.depth - 1] : DIALOG_NONE;
}

void dialog_push(app_state *app, dialog_kind kind, int focus) {
    dialog_state *d = &app->dialog;
    ui_shut_help(&app->ui);
    app->view.held = 0;
    d->item_count = 0;
    if (d->depth == DIALOGS_MOST) d->depth--;
    d->stack[d->depth] = kind;
    d->focus[d->depth++] = focus;
}

void dialog_pop(app_state *app) {
    if (app->dialog.depth) app->dialog.depth--;
    app->dialog.item_count = 0;
}

bool dialog_clear(app_state *app) {
    while (app->dialog.depth && dialog_open_now(app) != DIALOG_QUESTION)
        dialogs[dialog_open_now(app)].act(app, DIALOG_CANCEL);
    return app->dialog.depth == 0;
}

void dialog_destroy(app_state *app) {
    for (size_t i = 1; i < sizeof dialogs / sizeof *dialogs; i++)
        if (dialogs[i].destroy) dialogs[i].destroy(app);
}

/// Only the uppermost one is drawn.
void dialog_draw(app_state *app) {
    app->dialog.item_count = 0;
    app->dialog.title[0] = app->dialog.problem[0] = '\0';
    if (app->dialog.depth) dialogs[dialog_open_now(app)].draw(app);
}

bool dialog_is_unseen(const app_state *app) {
    return app->dialog.depth && !app->dialog.item_count;
}

// --- widgets

static int *focus_of(dialog_state *d) {
    return &d->focus[d->depth ? d->depth - 1 : 0];
}

static void add_item(app_state *app, dialog_item item) {
    dialog_state *d = &app->dialog;
    if (d->item_count < ITEMS_MOST) d->items[d->item_count++] = item;
}

sl_box dialog_begin(app_state *app, double width, double height, const char *title) {
    ui_state *ui = &app->ui;
    const sl_box all = {{0, 0}, {ui->width, ui->height}};
    const double room = fmin((ui->width - 12) / width, (ui->height - 12) / height);
    app->dialog.text = ui->text;
    snprintf(app->dialog.title, sizeof app->dialog.title, "%s", title);
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

void dialog_end(app_state *app) {
    ui_end_area(&app->ui);
    app->ui.text = app->dialog.text;
}

void dialog_problem(app_state *app, sl_point at, double width, const char *text) {
    ui_state *ui = &app->ui;
    snprintf(app->dialog.problem, sizeof app->dialog.problem, "%s", text);
    if (*text)
        sl_text_show_within(ui->cairo, ui->palette.start, at.x, at.y, width, ui->text, false, text);
}

/// A frame about what is in focus.
static void draw_focus(app_state *app, int id, sl_box box) {
    ui_state *ui = &app->ui;
    if (*focus_of(&app->dialog) != id) return;
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

static void draw_button(app_state *app, double x, double y, const dialog_label *button) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    const sl_box box = {{x, y}, {x + button_width(ui, button->label), y + 1.8 * t}};
    ui_fill_round(ui, box, 0.3 * t, ground(ui, box, 0.1));
    ui_text(ui, x + 0.8 * t, y + 1.25 * t, 1, false, ui->palette.ink, button->label);
    draw_focus(app, button->id, box);
    ui_hit(ui, HIT_DIALOG, button->id, box);
    add_item(app, (dialog_item){.kind = ITEM_BUTTON, .id = button->id, .box = box});
}

double dialog_buttons_width(app_state *app, const dialog_label *buttons, int count) {
    double wide = -0.6 * app->ui.text;
    for (int i = 0; i < count; i++)
        wide += button_width(&app->ui, buttons[i].label) + 0.6 * app->ui.text;
    return wide;
}

void dialog_head(app_state *app, int id, sl_box box, const char *label) {
    ui_state *ui = &app->ui;
    if (box_has(box, ui->pointer)) ui_fill(ui, box, ground(ui, box, 0));
    ui_text(ui, box.min.x + 0.5 * ui->text, box.max.y - 0.45 * ui->text, 0.95, false,
            ui->palette.faint, label);
    draw_focus(app, id, box);
    ui_hit(ui, HIT_DIALOG, id, box);
    add_item(app, (dialog_item){.kind = ITEM_BUTTON, .id = id, .box = box});
}

double dialog_buttons(app_state *app, double x, double y, const dialog_label *buttons, int count) {
    const double gap = 0.6 * app->ui.text;
    const double first = x -= dialog_buttons_width(app, buttons, count);
    for (int i = 0; i < count; i++) {
        draw_button(app, x, y, &buttons[i]);
        x += button_width(&app->ui, buttons[i].label) + gap;
    }
    return first;
}

void dialog_check(app_state *app, int id, sl_box row, const char *label, bool on) {
    ui_state *ui = &app->ui;
    // The widget of the panel registers an action: the hit that follows lies over it.
    ui_check(ui, row, label, NULL, on, -1);
    draw_focus(app, id, row);
    ui_hit(ui, HIT_DIALOG, id, row);
    add_item(app, (dialog_item){.kind = ITEM_CHECK, .id = id, .box = row});
}

void dialog_field(app_state *app, int id, sl_box box, text_field *field, const char *hint) {
    ui_text_field(&app->ui, box, field, hint, *focus_of(&app->dialog) == id);
    ui_hit(&app->ui, HIT_DIALOG, id, box);
    add_item(app, (dialog_item){.kind = ITEM_FIELD, .id = id, .field = field, .box = box});
}

static double row_height(const ui_state *ui) {
    return 1.7 * ui->text;
}

void dialog_list_frame(app_state *app, int id, sl_box box, dialog_list *list) {
    ui_state *ui = &app->ui;
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
    draw_focus(app, id, box);
    add_item(app, (dialog_item){.kind = ITEM_LIST, .id = id, .list = list, .box = box});
}

sl_box dialog_list_row(app_state *app, int id, sl_box box, const dialog_list *list, size_t row) {
    ui_state *ui = &app->ui;
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

static void edited(app_state *app, int id) {
    const dialog_row *row = &dialogs[dialog_open_now(app)];
    if (row->edited) row->edited(app, id);
}

static bool list_key(app_state *app, const char *key, bool focused) {
    dialog_item *item = find_list(&app->dialog);
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
    const dialog_item *before = find_item(&app->dialog, *focus_of(&app->dialog));
    if (!before || before->kind != ITEM_FIELD) *focus_of(&app->dialog) = item->id;
    edited(app, item->id);
    return true;
}

static void move_focus(dialog_state *d, int by) {
    int at = -1;
    if (!d->item_count) return;
    for (int i = 0; i < d->item_count; i++)
        if (d->items[i].id == *focus_of(d)) at = i;
    at = at < 0 ? (by > 0 ? 0 : d->item_count - 1) : (at + by + d->item_count) % d->item_count;
    *focus_of(d) = d->items[at].id;
}

static void press_return(app_state *app, const dialog_item *focused) {
    const bool own = focused && focused->kind != ITEM_FIELD && focused->kind != ITEM_CHECK &&
                     !(focused->list && focused->list->marks);
    dialogs[dialog_open_now(app)].act(app, own ? focused->id : DIALOG_MAIN);
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
static bool widget_key(app_state *app, const char *key) {
    dialog_state *d = &app->dialog;
    dialog_item *focused = find_item(d, *focus_of(d));
    bool changed = false;
    if (focused && focused->kind == ITEM_FIELD && field_key(focused->field, key, &changed)) {
        if (changed) edited(app, focused->id);
        return true;
    }
    if (strcmp(key, "Space") == 0) {
        if (focused && focused->kind != ITEM_FIELD)
            dialogs[dialog_open_now(app)].act(app, focused->id);
        return true;
    }
    return list_key(app, key, focused && focused->kind == ITEM_LIST);
}

void dialog_key(app_state *app, const char *key, bool down) {
    dialog_state *d = &app->dialog;
    if (!down || strcmp(key, d->deaf) != 0) d->deaf[0] = '\0';
    if (!down) return;
    const dialog_row *row = &dialogs[dialog_open_now(app)];
    if (strcmp(key, "Escape") == 0) {
        row->act(app, DIALOG_CANCEL);
        return;
    }
    if (row->key && row->key(app, key)) return;
    if (strcmp(key, "Return") == 0)
        press_return(app, find_item(d, *focus_of(d)));
    else if (focus_step(key, false))
        move_focus(d, focus_step(key, false));
    else if (!widget_key(app, key) && focus_step(key, true))
        move_focus(d, focus_step(key, true));
}

void dialog_text(app_state *app, const char *text) {
    dialog_state *d = &app->dialog;
    dialog_item *focused = find_item(d, *focus_of(d));
    if (d->deaf[0] || !focused || focused->kind != ITEM_FIELD) return;
    field_insert(focused->field, text);
    edited(app, focused->id);
}

static void press_row(app_state *app, dialog_item *item, size_t row) {
    const bool again = item->list->at == row || item->list->acts;
    const int id = item->id;
    dialog_list_go(item->list, row);
    if (again)
        dialogs[dialog_open_now(app)].act(app, id);
    else
        edited(app, id);
}

void dialog_press(app_state *app, const hit_area *hit, sl_point at) {
    dialog_state *d = &app->dialog;
    if (hit->kind != HIT_DIALOG) return;
    const int id = hit->value & 255, row = (hit->value >> 8) - 1;
    dialog_item *item = find_item(d, id);
    if (!item) {
        // Beside the sheet: a menu goes away.
        if (hit->value == 0 && dialog_open_now(app) == DIALOG_MENU) dialog_pop(app);
        return;
    }
    *focus_of(d) = id;
    if (item->kind == ITEM_FIELD) {
        item->field->clicked = true;
        item->field->chosen = false;
        item->field->click_x = at.x;
    } else if (item->kind != ITEM_LIST) {
        dialogs[dialog_open_now(app)].act(app, id);
    } else if (row >= 0) {
        press_row(app, item, (size_t)row);
    }
}

void dialog_wheel(app_state *app, double steps) {
    dialog_state *d = &app->dialog;
    dialog_list *list = NULL;
    for (int i = 0; i < d->item_count; i++)
        if (d->items[i].kind == ITEM_LIST && (!list || box_has(d->items[i].box, app->ui.pointer)))
            list = d->items[i].list;
    if (!list) return;
    const double to = (double)list->first - round(3 * fmin(fmax(steps, -5), 5));
    const size_t last = list->count > list->page ? list->count - list->page : 0;
    list->first = to <= 0 ? 0 : to >= (double)last ? last : (size_t)to;
}
