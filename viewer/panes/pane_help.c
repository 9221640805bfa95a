/// The help: all actions by topic, with a field that narrows them down; and tooltips. Both take
/// their words from the table of actions.
#include "panes/panes.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// --- topics

/// A topic reaches from its first action in the table to the next topic.
static const struct {
    const char *title, *first;
} topics[] = {
    {"Modes", "explore"},
    {"Walk and look", "forward"},
    {"Layers", "cells"},
    {"Layers in detail, and panes", "split_less"},
    {"Culling methods", "method"},
    {"Learn: the steps of a lesson", "step_next"},
    {"Change the map", "undo"},
    {"Quiz", "answer_yes"},
    {"Plan: tools and measures", "plan_isovist"},
    {"Cameras", "camera_find"},
    {"A way: record and play", "record"},
    {"Files", "file"},
    {"Plan and window", "fit"},
};
enum { TOPICS = sizeof topics / sizeof *topics };

/// What no single action does.
static const char *const by_hand[][2] = {
    {"Drag", "pan; middle button: look round"},
    {"Wheel", "zoom to the pointer; scroll a panel"},
    {"Click", "puts the eye"},
    {"Right click", "why is a cell seen or not?"},
    {"Cameras", "click: a new one; drag it, or the handle ahead of it"},
    {"On things", "drag a mirror, an object; click on a door, an object"},
    {"Borders", "drag a panel's border: its size"},
    {"Tab", "the next button, slider or row; Shift+Tab: back"},
    {"Return", "presses it; Left and Right move a slider"},
    {"In this help", "Up, Down, PageUp and PageDown scroll"},
    {"Tab to the plan",
     "arrows move a cursor there, in Draw mode by the grid, with Shift by a pixel"},
    {"At its border", "the cursor moves the plan"},
    {"Return there", "a click; Shift+Return: a right click"},
    {"Space there", "presses the button down or releases it: draws walls, drags things"},
};
enum { BY_HAND = sizeof by_hand / sizeof *by_hand };

/// The first action of a topic; of one without actions, that of the next one.
static int topic_start(const ui_state *ui, int topic) {
    for (; topic < TOPICS; topic++) {
        const int first = ui_action_find(ui, topics[topic].first);
        if (first >= 0) return first;
    }
    return ui->action_count;
}

static bool has_words(const char *text, const char *part) {
    const size_t length = strlen(part);
    for (; text && *text; text++) {
        size_t i = 0;
        while (i < length && text[i] &&
               tolower((unsigned char)text[i]) == tolower((unsigned char)part[i]))
            i++;
        if (i == length) return true;
    }
    return !length;
}

// --- rows

typedef struct help_column {
    ui_state *ui;
    double left, right, y;
    bool draw;
} help_column;

/// A row with a key and what it does; `action` is -1 where a click does nothing.
static void help_row(help_column *c, const char *key, const char *help, int action) {
    ui_state *ui = c->ui;
    const double t = ui->text, keys = fmin(9.5 * t, 0.4 * (c->right - c->left));
    const double words = c->left + keys, room = c->right - words;
    const double high = fmax(ui_lines_height(ui, keys - 0.6 * t, 1, true, key),
                             ui_lines_height(ui, room, 1, false, help)) +
                        0.15 * t;
    const sl_box row = {{c->left - 0.4 * t, c->y}, {c->right + 0.2 * t, c->y + high}};
    if (c->draw) {
        if (action >= 0 && box_has(row, ui->pointer))
            ui_fill_round(ui, row, 0.25 * t,
                          sl_colour_mix(ui->palette.page, ui->palette.glass, 0.2));
        ui_lines(ui, c->left, c->y + 1.1 * t, keys - 0.6 * t, 1, true, ui->palette.glass, key);
        ui_lines(ui, words, c->y + 1.1 * t, room, 1, false, ui->palette.ink, help);
        if (action >= 0) ui_hit_focus(ui, HIT_ACTION, action, row);
    }
    c->y += high;
}

static void help_title(help_column *c, const char *title) {
    ui_state *ui = c->ui;
    const double t = ui->text;
    c->y += 0.5 * t;
    if (c->draw)
        ui_lines(ui, c->left, c->y + 1.1 * t, c->right - c->left, 1.1, true, ui->palette.ink,
                 title);
    c->y += ui_lines_height(ui, c->right - c->left, 1.1, true, title) + 0.2 * t;
}

/// The rows of a topic that the filter lets through; TOPICS: what is done by hand.
static void help_topic(help_column *c, int topic, const char *filter) {
    int first = 0, end = BY_HAND;
    const ui_action *actions = c->ui->actions;
    const char *title = topic < TOPICS ? topics[topic].title : "Mouse, and keys in its place";
    const bool all = has_words(title, filter);
    bool titled = false;
    if (topic < TOPICS) {
        first = topic_start(c->ui, topic);
        end = topic_start(c->ui, topic + 1);
    }
    for (int i = first; i < end; i++) {
        const char *key = topic < TOPICS ? actions[i].key : by_hand[i][0];
        const char *help = topic < TOPICS ? actions[i].help : by_hand[i][1];
        if (!all && !has_words(key, filter) && !has_words(help, filter)) continue;
        if (!titled) help_title(c, title);
        titled = true;
        help_row(c, key ? key : "\xe2\x80\x93", help, topic < TOPICS && !actions[i].held ? i : -1);
    }
}

static double help_height(const help_column *column, int from, int to, const char *filter) {
    help_column c = *column;
    c.draw = false;
    c.y = 0;
    for (int i = from; i < to; i++) help_topic(&c, i, filter);
    return c.y;
}

/// Fills one column, or two of about the same height.
static double help_columns(ui_state *ui, sl_box room, double y, const char *filter) {
    const double t = ui->text, inner = box_width(room) - 2.4 * t - ui_bar_width(ui);
    const int columns = inner > 56 * t ? 2 : 1;
    const double wide = (inner - 1.6 * t * (columns - 1)) / columns;
    help_column c = {ui, room.min.x + 1.2 * t, room.min.x + 1.2 * t + wide, y, true};
    const double all = help_height(&c, 0, TOPICS + 1, filter);
    double bottom = y;
    bool broken = columns == 1;
    for (int i = 0; i <= TOPICS; i++) {
        const double high = help_height(&c, i, i + 1, filter);
        if (!broken && c.y > y && c.y + high / 2 - y > all / 2) {
            broken = true;
            c.left += wide + 1.6 * t;
            c.right += wide + 1.6 * t;
            c.y = y;
        }
        help_topic(&c, i, filter);
        bottom = fmax(bottom, c.y);
    }
    if (all <= 0)
        bottom = ui_lines(ui, c.left, y + 1.6 * t, wide, 1, false, ui->palette.faint,
                          "Nothing has these words.");
    return bottom + 0.5 * t;
}

void pane_help(ui_state *ui) {
    const double t = ui->text;
    double top;
    const sl_box sheet = ui_begin_sheet(ui, 78 * t, 52 * t, "Keys; a click on a row does it", &top);
    const sl_box field = {{sheet.min.x + 1.2 * t, top}, {sheet.max.x - 1.2 * t, top + 2 * t}};
    ui_text_field(ui, field, &ui->filter, "type to search", ui->field == &ui->filter);
    ui_hit_focus(ui, HIT_FIELD, 0, field);
    const sl_box room = {{sheet.min.x, top + 2.3 * t}, {sheet.max.x, sheet.max.y - 0.8 * t}};
    const double y = ui_begin_scroll(ui, SCROLL_HELP, room);
    ui_end_scroll(ui, room, help_columns(ui, room, y, ui->filter.text));
    ui_end_area(ui);
}

// --- tooltips

static void write_action(const ui_action *a, char text[UI_TIP_TEXT]) {
    snprintf(text, UI_TIP_TEXT, "%s%s%s%s", a->help, a->key ? " (" : "", a->key ? a->key : "",
             a->key ? ")" : "");
    text[0] = (char)toupper((unsigned char)text[0]);
}

/// Words about a widget; empty: there are none.
static void write_tip(const ui_state *ui, const hit_area *hit, char text[UI_TIP_TEXT]) {
    size_t count;
    text[0] = '\0';
    switch (hit->kind) {
    case HIT_ACTION:
        if (!ui->help && hit->value >= 0) write_action(&ui->actions[hit->value], text);
        break;
    case HIT_METHOD:
        snprintf(text, UI_TIP_TEXT, "%s", sl_eye_methods(&count)[hit->value].what);
        break;
    case HIT_SLIDER:
        snprintf(text, UI_TIP_TEXT, "%s", ui->sliders[hit->value].help);
        break;
    case HIT_PANEL:
        if (hit->value == PANEL_STATUS && ui->message_seconds > 8)
            snprintf(text, UI_TIP_TEXT, "%.300s", ui->message);
        break;
    case HIT_PLAN:
        if (ui->hover_is_focus)
            snprintf(text, UI_TIP_TEXT,
                     "Arrows move the cursor, with Shift by a pixel, and the plan at its border. "
                     "Return clicks, Shift+Return asks why, Space presses or releases, Escape "
                     "leaves.");
        break;
    case HIT_TIME:
        snprintf(text, UI_TIP_TEXT, "The steps of the lesson: drag to go to one (Left, Right)");
        break;
    case HIT_DUAL:
        snprintf(text, UI_TIP_TEXT, "Each point is a line in the plan: drag to choose another");
        break;
    case HIT_END:
        snprintf(text, UI_TIP_TEXT, "A click chooses this portal end: arrows move it");
        break;
    case HIT_HEAD:
        snprintf(text, UI_TIP_TEXT,
                 "A click sorts by this column, largest first; another one turns it round");
        break;
    case HIT_MEASURE:
        snprintf(text, UI_TIP_TEXT, "A click colours the plan by this measure (2, 3)");
        break;
    case HIT_EDGE:
        snprintf(text, UI_TIP_TEXT, "Drag: the size of the panel");
        break;
    default:
        break;
    }
}

void pane_tip(ui_state *ui) {
    const hit_area hit = ui_tip_of(ui);
    char text[UI_TIP_TEXT];
    if (hit.kind == HIT_NONE) return;
    write_tip(ui, &hit, text);
    if (*text) ui_tip(ui, hit.box, text);
}
