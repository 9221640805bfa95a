/// Who gets a key or a click: a dialog, the widget with the focus, the plan.
#include "app/input.h"

#include "app/action_parts.h"
#include "app/layout.h"
#include "app/sliders.h"
#include "app/turn.h"
#include "dialogs/import_dialog.h"
#include "lessons/quiz.h"
#include "panes/panes.h"
#include "plan/cameras.h"
#include "plan/edit.h"
#include "plan/effects.h"
#include "plan/from_line.h"
#include "plan/grid.h"
#include "plan/line_map.h"
#include "plan/room_map.h"
#include "plan/route.h"
#include "plan/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void click_widget(app_state *app, const hit_area *hit);
static void input_press_at(app_state *app, button_kind button, sl_point at);
static void input_point(app_state *app, sl_point to);

// --- the cursor in the plan, moved by keys

/// The pointer stays where it is if it is in the plan; else it goes to the eye, or to the middle.
static void cursor_begin(app_state *app, sl_box plan) {
    if (box_has(plan, app->ui.pointer)) return;
    const sl_frame frame = camera_frame(&app->view.camera, plan, 1);
    const sl_point eye = sl_frame_point(&frame, app->view.eye.at);
    input_point(app, box_has(plan, eye) ? eye : box_middle(plan));
}

/// At the border of the plan the plan moves instead.
static void cursor_move(app_state *app, sl_box plan, sl_point to) {
    const sl_point at = {fmin(fmax(to.x, plan.min.x), plan.max.x - 1),
                         fmin(fmax(to.y, plan.min.y), plan.max.y - 1)};
    if (at.x != to.x || at.y != to.y) view_pan(&app->view, at.x - to.x, at.y - to.y);
    input_point(app, at);
}

/// A step of the cursor. In Draw mode it goes from one place of the grid to the next.
static sl_point cursor_step(const app_state *app, sl_box plan, int x, int y, bool fine) {
    const sl_point at = app->ui.pointer;
    const double step = fine ? 1 : 10 * ui_scale(&app->ui);
    if (fine || app->view.mode != MODE_DRAW || !app->document.baked)
        return (sl_point){at.x + step * x, at.y + step * y};
    const sl_frame frame = camera_frame(&app->view.camera, plan, 1);
    sl_point place = grid_snap(&app->view, camera_point(&app->view.camera, plan, at));
    place.x += grid_step(&app->view) * x;
    place.y -= grid_step(&app->view) * y;
    return sl_frame_point(&frame, place);
}

/// Takes hold of what is under the cursor, or lets it go.
static void cursor_hold(app_state *app) {
    if (app->view.drag.kind == DRAG_NONE)
        input_press_at(app, BUTTON_LEFT, app->ui.pointer);
    else
        input_release(app, app->ui.pointer);
}

static void cursor_click(app_state *app, button_kind button) {
    input_press_at(app, button, app->ui.pointer);
    input_release(app, app->ui.pointer);
}

static bool cursor_key(app_state *app, const char *key, sl_box plan) {
    static const struct {
        const char *key;
        int x, y;
    } arrows[] = {{"Left", -1, 0}, {"Right", 1, 0}, {"Up", 0, -1}, {"Down", 0, 1}};
    const bool fine = strncmp(key, "Shift+", 6) == 0;
    cursor_begin(app, plan);
    app->ui.hover_seconds = -1e9; // the tooltip would cover the place
    for (size_t i = 0; i < sizeof arrows / sizeof *arrows; i++) {
        if (strcmp(key + (fine ? 6 : 0), arrows[i].key) != 0) continue;
        cursor_move(app, plan, cursor_step(app, plan, arrows[i].x, arrows[i].y, fine));
        return true;
    }
    if (strcmp(key, "Return") == 0)
        cursor_click(app, BUTTON_LEFT);
    else if (strcmp(key, "Shift+Return") == 0)
        cursor_click(app, BUTTON_RIGHT);
    else if (strcmp(key, "Space") == 0)
        cursor_hold(app);
    else
        return false;
    return true;
}

// --- keys

static const slider_row *slider_of(const hit_area *hit) {
    size_t count;
    return &slider_table(&count)[hit->value];
}

static bool slider_key(app_state *app, const hit_area *hit, const char *key) {
    const double by = strcmp(key, "Left") == 0 ? -0.02 : strcmp(key, "Right") == 0 ? 0.02 : 0;
    const slider_row *slider = slider_of(hit);
    if (by == 0) return false;
    if (slider->begin) slider->begin(&app->view);
    slider->set(app, fmin(fmax(slider->share(app) + by, 0), 1));
    if (slider->end) slider->end(&app->view);
    return true;
}

static bool edge_key(app_state *app, const hit_area *hit, const char *key) {
    const bool side = hit->value == EDGE_SIDE;
    const double by = strcmp(key, side ? "Left" : "Up") == 0      ? 1
                      : strcmp(key, side ? "Right" : "Down") == 0 ? -1
                                                                  : 0;
    if (by != 0) app_drag_edge(app, hit->value, 10 * by * ui_scale(&app->ui));
    return by != 0;
}

/// What the keys of the plan do is said while they do it.
static void say_focus(app_state *app, bool was_plan) {
    if (app->ui.focus.kind == HIT_PLAN)
        ui_say(
            &app->ui, false,
            "Arrows move the cursor, Return clicks, Space holds the button; Esc leaves the plan");
    else if (was_plan && !app->ui.message_is_error)
        app_say_document(app);
}

/// Keys for the focused widget; false: the key is not for it.
static bool focus_key(app_state *app, const char *key) {
    const hit_area hit = ui_focused(&app->ui);
    if (strcmp(key, "Tab") == 0 || strcmp(key, "Shift+Tab") == 0) {
        ui_focus_move(&app->ui, *key == 'S');
        if (app->ui.focus.kind == HIT_PLAN) cursor_begin(app, ui_focused(&app->ui).box);
        say_focus(app, hit.kind == HIT_PLAN);
        app->ui.hover_is_focus = true;
        return true;
    }
    if (hit.kind == HIT_NONE) return false;
    if (strcmp(key, "Escape") == 0 && app->view.drag.kind != DRAG_NONE) {
        if (!edit_cancel(&app->view)) app->view.drag = (drag_state){0};
        return true;
    }
    if (strcmp(key, "Escape") == 0 && !app->ui.help) {
        app->ui.focus = (ui_focus){0};
        say_focus(app, hit.kind == HIT_PLAN);
        return true;
    }
    if (hit.kind == HIT_PLAN) return cursor_key(app, key, hit.box);
    if (hit.kind == HIT_SLIDER && slider_key(app, &hit, key)) return true;
    if (hit.kind == HIT_EDGE && edge_key(app, &hit, key)) return true;
    if (strcmp(key, "Return") != 0 && strcmp(key, "Space") != 0) return false;
    if (hit.kind == HIT_SLIDER || hit.kind == HIT_TIME || hit.kind == HIT_EDGE) return false;
    if (hit.kind == HIT_DUAL) return false;
    click_widget(app, &hit);
    return true;
}

/// Keys that page through what scrolls over all.
static bool sheet_key(app_state *app, const char *key) {
    ui_scroll *scroll = &app->ui.scrolls[SCROLL_HELP];
    static const struct {
        const char *key;
        double rows, pages;
    } moves[] = {{"Up", -3, 0}, {"Down", 3, 0}, {"PageUp", 0, -0.9}, {"PageDown", 0, 0.9}};
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++) {
        if (strcmp(key, moves[i].key) != 0) continue;
        ui_scroll_by(scroll, moves[i].rows * app->ui.text + moves[i].pages * scroll->room);
        return true;
    }
    return false;
}

/// What is chosen in the lesson takes the arrows.
static bool lesson_key(app_state *app, const char *key) {
    static const struct {
        const char *key;
        int x, y;
    } arrows[] = {{"Left", -1, 0}, {"Right", 1, 0}, {"Up", 0, 1}, {"Down", 0, -1}};
    if (app->view.mode != MODE_LEARN || lesson_chosen(&app->learn.lesson) == CHOSEN_NONE)
        return false;
    for (size_t i = 0; i < sizeof arrows / sizeof *arrows; i++) {
        if (strcmp(key, arrows[i].key) != 0) continue;
        pane_dual_nudge(&app->learn, app_layout(app).below[PANE_DUAL], arrows[i].x, arrows[i].y);
        return true;
    }
    return false;
}

/// Whether a key is for the field that typing goes to: it edits, or it types a letter.
static bool takes_key(text_field *field, const char *key) {
    bool changed;
    return field_key(field, key, &changed) || strlen(key) == 1 || strcmp(key, "Space") == 0;
}

/// Keys that are not for the table of actions.
static bool own_key(app_state *app, const char *key, bool down) {
    ui_state *ui = &app->ui;
    if (!down) return false;
    if (plan_field_key(app, key)) return true;
    if (ui->field && takes_key(ui->field, key)) {
        ui->scrolls[SCROLL_HELP].at = 0;
        return true;
    }
    if (ui->help && sheet_key(app, key)) return true;
    return lesson_key(app, key) || focus_key(app, key);
}

/// A letter that opens a dialog, or answers one and opens the next, comes as text too, which is not
/// meant for the dialog.
static void mute_letter(app_state *app, const char *key) {
    dialog_state *d = &app->desk.dialog;
    if (dialog_open_now(d) != DIALOG_NONE) snprintf(d->deaf, sizeof d->deaf, "%s", key);
}

/// Keys for the plan, where a dialog beside it waits for a click there.
static bool pick_key(app_state *app, const char *key) {
    if (!import_picks(&app->desk) || strcmp(key, "Space") == 0) return false;
    if (strcmp(key, "Escape") != 0) return cursor_key(app, key, app_layout(app).plan[0]);
    import_stop_picking(&app->desk);
    return true;
}

/// Shows the cursor in the plan for as long as it takes the keys.
static void show_cursor(app_state *app) {
    const bool picks = import_picks(&app->desk);
    app->ui.focus = (ui_focus){.kind = picks ? HIT_PLAN : HIT_NONE};
    if (picks) cursor_begin(app, app_layout(app).plan[0]);
}

void input_key(app_state *app, const char *key, bool down) {
    const text_field *before = app->ui.field;
    if (dialog_open_now(&app->desk.dialog) != DIALOG_NONE) {
        const int number = action_of_key(key, app->view.mode);
        if (app->desk.dialog.beside && number >= 0 && action_looks(number) && strchr(key, '+')) {
            if (down) action_run(app, number);
            return;
        }
        const int depth = app->desk.dialog.depth;
        const dialog_kind kind = dialog_open_now(&app->desk.dialog);
        if (!down || !pick_key(app, key)) dialog_key(&app->desk.dialog, key, down);
        if (app->desk.dialog.beside) show_cursor(app);
        actions_answered(app);
        if (down && (depth != app->desk.dialog.depth || kind != dialog_open_now(&app->desk.dialog)))
            mute_letter(app, key);
        return;
    }
    if (!down) app->ui.field_mutes = false;
    if (own_key(app, key, down)) return;
    if (strcmp(key, "Backspace") == 0) key = "Delete";
    const int number = action_of_key(key, app->view.mode);
    if (number < 0) return;
    const action_row *action = action_at(number);
    if (action->hold) {
        app->view.held = down ? app->view.held | action->hold : app->view.held & ~action->hold;
        if (down) app->recorder.plays = false;
        return;
    }
    if (down) action_run(app, number);
    if (down && !before && app->ui.field) app->ui.field_mutes = true;
    if (down) mute_letter(app, key);
}

bool input_takes(const char *key) {
    static const char *const own[] = {"Tab",          "Shift+Tab",  "Return",
                                      "Shift+Return", "Shift+Left", "Shift+Right",
                                      "Shift+Up",     "Shift+Down", "Backspace"};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strcmp(own[i], key) == 0) return true;
    for (int mode = MODE_EXPLORE; mode < MODES; mode++)
        if (action_of_key(key, (view_mode)mode) >= 0) return true;
    return false;
}

void input_text(app_state *app, const char *text) {
    if (dialog_open_now(&app->desk.dialog) != DIALOG_NONE) {
        dialog_text(&app->desk.dialog, text);
        return;
    }
    if (!app->ui.field || app->ui.field_mutes) return;
    field_insert(app->ui.field, text);
    app->ui.scrolls[SCROLL_HELP].at = 0;
}

// --- dragging

static sl_point to_map(const app_state *app, int plan, sl_point at) {
    const window_layout l = app_layout(app);
    return camera_point(&app->view.camera, l.plan[plan < l.plan_count ? plan : 0], at);
}

/// Sliders, the time line and the dual plane follow the pointer.
static void follow_pointer(app_state *app, const hit_area *hit, sl_point at) {
    const double share = ui_slider_at(&app->ui, hit->box, at);
    const size_t length = lesson_length(&app->learn.lesson);
    switch (hit->kind) {
    case HIT_SLIDER:
        slider_of(hit)->set(app, share);
        break;
    case HIT_TIME:
        if (length)
            lesson_go(&app->learn.lesson, &app->document,
                      (size_t)round(share * (double)(length - 1)));
        break;
    case HIT_DUAL:
        pane_dual_drag(&app->learn, app_layout(app).below[PANE_DUAL], at);
        break;
    case HIT_BAR:
        app->ui.scrolls[hit->value].at =
            (at.y - hit->box.min.y) / box_height(hit->box) * app->ui.scrolls[hit->value].length -
            app->ui.scrolls[hit->value].room / 2;
        ui_scroll_by(&app->ui.scrolls[hit->value], 0);
        break;
    default:
        break;
    }
}

static bool near_line(const app_state *app, sl_point at) {
    const lesson_state *lesson = &app->learn.lesson;
    if (!lesson->end_count) return false;
    const sl_point p = sl_dual_point(&lesson->dual, at);
    const double off =
        fabs(p.y - lesson->line.slope * p.x - lesson->line.height) / hypot(1, lesson->line.slope);
    return off * lesson->dual.scale * app->view.camera.scale < 7 * ui_scale(&app->ui);
}

static drag_kind plan_drag(app_state *app, drag_state *drag) {
    const bool searches = app->view.mode == MODE_LEARN && app->learn.lesson.end_count > 0 &&
                          !app->learn.quiz.answered; // whose picture has no ends to drag
    if (searches) drag->index = pane_plan_end_at(&app->learn, drag->at);
    if (searches && drag->index != UINT32_MAX) return DRAG_END;
    if (searches && near_line(app, drag->at)) return DRAG_LINE;
    const bool moves = app->view.mode == MODE_EXPLORE || app->view.mode == MODE_DRAW;
    if (moves && mirror_take(&app->view, drag)) return DRAG_MIRROR;
    if (app->view.mode == MODE_EXPLORE && object_take(&app->view, drag)) return DRAG_OBJECT;
    if (app->view.mode == MODE_CAMERAS && camera_take(&app->view, drag)) return DRAG_CAMERA;
    if (app->view.mode == MODE_PLAN && app->view.tool == TOOL_FROM_LINE) return DRAG_FROM_LINE;
    if (app->view.mode == MODE_PLAN && app->view.tool == TOOL_ROOMS) return DRAG_ZONE;
    if (app->view.mode != MODE_DRAW) return DRAG_PAN;
    return edit_take(&app->view, drag);
}

static void click_widget(app_state *app, const hit_area *hit) {
    if (hit->kind == HIT_ACTION) {
        const bool from_help = app->ui.help;
        ui_shut_help(&app->ui);
        if (!from_help || hit->value != action_find("help")) action_run(app, hit->value);
    } else if (hit->kind == HIT_METHOD) {
        if (app->view.compare && (size_t)hit->value != app->view.method)
            app->view.other = app->view.method;
        app->view.method = (size_t)hit->value;
    } else if (hit->kind == HIT_PANEL && hit->value == PANEL_SHEET) {
        ui_shut_help(&app->ui);
    } else if (hit->kind == HIT_VALUE) {
        slider_type(app, hit->value);
    } else if (hit->kind == HIT_FIELD && app->ui.field) {
        app->ui.field->clicked = true;
        app->ui.field->click_x = app->ui.pointer.x;
        app->ui.field->chosen = false;
    } else if (hit->kind == HIT_SUBJECT) {
        lesson_set_subject(app->context, &app->learn.lesson, (size_t)hit->value);
        app_tick(app, 0);
    } else if (hit->kind == HIT_END) {
        app->learn.lesson.chosen_next = (uint32_t)hit->value + 2;
    } else if (hit->kind == HIT_CAMERA && app->view.cameras) {
        app->view.cameras->chosen = (size_t)hit->value;
    } else if (hit->kind == HIT_HEAD) {
        table_sort(&app->view, (size_t)hit->value);
    } else if (hit->kind == HIT_ROW) {
        table_choose(&app->view, (size_t)hit->value);
    } else if (hit->kind == HIT_MEASURE && line_map_choice(&app->view)) {
        line_map_choose(&app->view, hit->value - (int)*line_map_choice(&app->view));
    } else if (hit->kind == HIT_SPOT) {
        camera_go_to_spot(&app->view, (uint32_t)hit->value);
    }
}

/// The first move of a drag in the lesson is kept for undo.
static void keep_once(app_state *app, drag_state *drag, uint32_t what) {
    if (!drag->changed && app->learn.lesson.end_count) lesson_keep(&app->learn.lesson, what);
    drag->changed = true;
}

static void explain_to(app_state *app, sl_point at) {
    if (!app->document.baked) return;
    if (view_is_solid(&app->view, at) || view_is_solid(&app->view, app->view.eye.at)) {
        ui_say(&app->ui, false,
               "%s solid ground, from where nobody looks: choose a place in a room",
               view_is_solid(&app->view, at) ? "this is" : "the eye is in");
        return;
    }
    const uint32_t to = sl_space_locate(&app->document.baked->space, at);
    const uint32_t from = view_eye_cell(&app->view);
    if (to == SL_NO_CELL || from == SL_NO_CELL) return;
    quiz_explain(&app->learn, from, to);
    if (!app->learn.quiz.answered) return;
    app->ui.side_panel = true;
    ui_say(&app->ui, false, "why: see the %s; Ctrl+T shows the step that decides",
           ui_has_panel(&app->ui) ? "panel" : "sentence above");
}

void input_press(app_state *app, button_kind button, sl_point at) {
    app->ui.focus = (ui_focus){0};
    app->ui.hover_is_focus = false;
    app->ui.hover_seconds = -1e9; // no tooltip until the pointer moves on
    input_press_at(app, button, at);
}

/// Whether the place is in the plan, beside a dialog that leaves it in sight.
static bool is_beside(const app_state *app, const hit_area *hit) {
    return app->desk.dialog.beside && hit->kind == HIT_PLAN &&
           dialog_open_now(&app->desk.dialog) != DIALOG_NONE;
}

static void input_press_at(app_state *app, button_kind button, sl_point at) {
    app->ui.pointer = at;
    const hit_area hit = ui_find(&app->ui, at);
    drag_state *drag = &app->view.drag;
    *drag = (drag_state){.hit = hit, .from = at, .last = at, .index = UINT32_MAX};
    if (dialog_open_now(&app->desk.dialog) != DIALOG_NONE && !is_beside(app, &hit)) {
        if (app->desk.dialog.beside && hit.kind == HIT_ACTION && action_looks(hit.value)) {
            if (button == BUTTON_LEFT) action_run(app, hit.value);
            return;
        }
        if (button == BUTTON_LEFT) dialog_press(&app->desk.dialog, &hit, at);
        actions_answered(app);
        return;
    }
    if (hit.kind != HIT_PLAN) {
        if (button != BUTTON_LEFT) return;
        drag->kind = DRAG_HIT;
        if (hit.kind == HIT_SLIDER && slider_of(&hit)->begin) slider_of(&hit)->begin(&app->view);
        if (hit.kind == HIT_DUAL) keep_once(app, drag, CHOSEN_LINE);
        click_widget(app, &hit);
        follow_pointer(app, &hit, at);
        return;
    }
    if (!app->document.baked) return;
    drag->at = to_map(app, hit.value, at);
    const bool explains = app->view.mode != MODE_DRAW && app->view.mode != MODE_CAMERAS &&
                          app->view.mode != MODE_PLAN;
    if (button == BUTTON_RIGHT && explains)
        explain_to(app, drag->at);
    else if (button == BUTTON_LEFT)
        drag->kind = is_beside(app, &hit) ? DRAG_PAN : plan_drag(app, drag);
    else
        drag->kind = button == BUTTON_MIDDLE ? DRAG_LOOK : DRAG_PAN;
}

void input_move(app_state *app, sl_point to) {
    app->ui.hover_is_focus = false;
    input_point(app, to);
}

static void input_point(app_state *app, sl_point to) {
    drag_state *drag = &app->view.drag;
    app->ui.pointer = to;
    if (drag->kind == DRAG_NONE) return;
    const double dx = to.x - drag->last.x, dy = to.y - drag->last.y;
    if (hypot(to.x - drag->from.x, to.y - drag->from.y) > 3) drag->moved = true;
    const sl_point before = to_map(app, drag->hit.value, drag->last);
    const sl_point now = to_map(app, drag->hit.value, to);
    switch (drag->kind) {
    case DRAG_PAN:
        if (!drag->moved) return;
        view_pan(&app->view, dx, dy);
        break;
    case DRAG_LOOK:
        app->view.eye.heading = fmod(app->view.eye.heading - 0.4 * dx + 720, 360);
        break;
    case DRAG_HIT:
        if (drag->hit.kind == HIT_DUAL) keep_once(app, drag, CHOSEN_LINE);
        if (drag->hit.kind == HIT_EDGE)
            app_drag_edge(app, drag->hit.value, drag->hit.value == EDGE_SIDE ? -dx : -dy);
        else
            follow_pointer(app, &drag->hit, to);
        break;
    case DRAG_LINE:
        keep_once(app, drag, CHOSEN_LINE);
        pane_plan_drag_line(&app->learn, before, now);
        break;
    case DRAG_END:
        if (drag->moved) keep_once(app, drag, drag->index);
        if (drag->moved) lesson_move_end(&app->learn.lesson, drag->index, now);
        break;
    case DRAG_MIRROR:
        if (drag->moved) mirror_move(&app->view, drag, now);
        break;
    case DRAG_OBJECT:
        if (drag->moved) object_move(&app->view, drag, now);
        break;
    case DRAG_CAMERA:
        if (drag->moved) camera_move(&app->view, drag, now);
        break;
    case DRAG_FROM_LINE:
        if (drag->moved && !drag->changed) from_line_begin(&app->view, drag->at);
        drag->changed |= drag->moved;
        if (drag->moved) from_line_move(&app->view, now);
        break;
    case DRAG_ZONE:
        if (drag->moved && !drag->changed) room_map_begin_zone(&app->view, drag->at);
        drag->changed |= drag->moved;
        if (drag->moved) room_map_drag_zone(&app->view, now);
        break;
    case DRAG_NEW_WALL:
    case DRAG_NEW_DOOR:
    case DRAG_WALL:
    case DRAG_CORNER:
    case DRAG_DOOR:
        if (drag->moved) edit_drag(&app->view, drag, now);
        break;
    case DRAG_NONE:
        break;
    }
    drag->last = to;
}

static bool is_edit(drag_kind kind) {
    return kind >= DRAG_NEW_WALL && kind <= DRAG_DOOR;
}

void input_release(app_state *app, sl_point at) {
    if (is_edit(app->view.drag.kind)) input_move(app, at);
    const drag_state drag = app->view.drag;
    app->view.drag = (drag_state){0};
    app->ui.pointer = at;
    if (is_edit(drag.kind)) edit_drop(&app->view, &drag);
    if (!app->document.baked) return;
    if (drag.hit.kind == HIT_SLIDER && slider_of(&drag.hit)->end)
        slider_of(&drag.hit)->end(&app->view);
    const sl_point now = to_map(app, drag.hit.value, at);
    if (is_beside(app, &drag.hit)) {
        if (drag.kind == DRAG_PAN && !drag.moved)
            import_pick_at(&app->desk, now, grid_reach(&app->view));
        return;
    }
    if (drag.kind == DRAG_MIRROR) mirror_drop(&app->view, &drag);
    if (drag.kind == DRAG_OBJECT && !drag.moved) object_toggle(&app->view, drag.index);
    if (drag.kind == DRAG_ZONE) room_map_drop_zone(&app->view);
    const bool holds = drag.kind == DRAG_PAN || drag.kind == DRAG_FROM_LINE ||
                       drag.kind == DRAG_ZONE ||
                       (drag.kind == DRAG_MIRROR && app->view.mode == MODE_EXPLORE);
    const bool puts = holds && !drag.moved && app->view.mode != MODE_QUIZ;
    const uint32_t door = puts ? door_at(&app->view, now) : UINT32_MAX;
    if (door == UINT32_MAX && puts && app->view.mode == MODE_CAMERAS) {
        camera_add(&app->view, now);
    } else if (door != UINT32_MAX) {
        door_toggle(&app->view, door);
    } else if (puts && app->view.mode == MODE_PLAN && app->view.tool == TOOL_PATH) {
        route_click(&app->view, now);
    } else if (puts && line_map_choice(&app->view)) {
        table_pick(&app->view, now);
    } else if (drag.kind == DRAG_FROM_LINE) {
        if (puts) ui_say(&app->ui, false, "drag a line: press where it begins, release at its end");
    } else if (puts && view_is_solid(&app->view, now)) {
        ui_say(&app->ui, false, "this is solid ground: the eye stays; click in a room");
    } else if (puts && sl_space_locate(&app->document.baked->space, now) != SL_NO_CELL) {
        app->view.eye.at = now;
        app->recorder.plays = false;
        if (app->view.mode == MODE_PLAN) table_pick(&app->view, now);
        if (app->view.mode == MODE_EXPLORE) quiz_forget(&app->learn);
    }
}

void input_wheel(app_state *app, double steps) {
    const hit_area over = ui_find(&app->ui, app->ui.pointer);
    if (dialog_open_now(&app->desk.dialog) != DIALOG_NONE && !is_beside(app, &over)) {
        dialog_wheel(&app->desk.dialog, steps);
        return;
    }
    const int area = ui_scroll_at(&app->ui, app->ui.pointer);
    if (area >= 0) ui_scroll_by(&app->ui.scrolls[area], -3 * steps * ui_text_size(&app->ui));
    if (area >= 0 || app->ui.help) return;
    const window_layout l = app_layout(app);
    for (int i = 0; i < l.plan_count; i++) {
        if (!box_has(l.plan[i], app->ui.pointer)) continue;
        const sl_point middle = box_middle(l.plan[i]);
        view_zoom(&app->view, pow(1.2, steps),
                  (sl_point){app->ui.pointer.x - middle.x, app->ui.pointer.y - middle.y});
    }
}
