#include "input.h"

#include "actions.h"
#include "doors.h"
#include "edit.h"
#include "mirrors.h"
#include "objects.h"
#include "panes.h"
#include "quiz.h"
#include "shelf.h"
#include "sliders.h"

#include <math.h>
#include <string.h>

/// The list takes the keys that choose from it.
static bool list_key(sl_app *app, const char *key, bool down) {
    static const struct {
        const char *key;
        int by;
    } moves[] = {{"Up", -1}, {"Down", 1}, {"PageUp", -10}, {"PageDown", 10}};
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++) {
        if (strcmp(key, moves[i].key) != 0) continue;
        if (down) sl_shelf_move(app, moves[i].by);
        return true;
    }
    return false;
}

void sl_input_key(sl_app *app, const char *key, bool down) {
    size_t count;
    if (app->maps_open && list_key(app, key, down)) return;
    const sl_action *actions = sl_actions(&count);
    const int number = sl_action_of_key(key, app->mode);
    if (number < 0) return;
    const sl_action *action = &actions[number];
    if (action->hold) {
        app->held = down ? app->held | action->hold : app->held & ~action->hold;
        if (down) app->recorder.plays = false;
        return;
    }
    if (down) action->run(app);
}

// --- dragging

static sl_point to_map(const sl_app *app, int plan, sl_point at) {
    const sl_layout l = sl_app_layout(app);
    return sl_camera_point(&app->camera, l.plan[plan < l.plan_count ? plan : 0], at);
}

static double slider_share(const sl_hit *hit, const sl_app *app, sl_point at) {
    const double margin = 0.5 * app->ui.text;
    const double low = hit->box.min.x + margin, high = hit->box.max.x - margin;
    return high > low ? fmin(fmax((at.x - low) / (high - low), 0), 1) : 0;
}

static const sl_slider *slider_of(const sl_hit *hit) {
    size_t count;
    return &sl_sliders(&count)[hit->value];
}

/// Sliders, the time line and the dual plane follow the pointer.
static void follow(sl_app *app, const sl_hit *hit, sl_point at) {
    const double share = slider_share(hit, app, at);
    const size_t length = sl_lesson_length(&app->lesson);
    switch (hit->kind) {
    case SL_HIT_SLIDER:
        slider_of(hit)->set(app, share);
        break;
    case SL_HIT_TIME:
        if (length)
            sl_lesson_go(&app->lesson, &app->document, (size_t)round(share * (double)(length - 1)));
        break;
    case SL_HIT_DUAL:
        sl_pane_dual_drag(app, sl_app_layout(app).below[SL_PANE_DUAL], at);
        break;
    default:
        break;
    }
}

/// A portal end of the lesson under the pointer: twice its number, and one more for a right end.
static bool pick_end(const sl_app *app, sl_point at, uint32_t *found) {
    const sl_lesson *lesson = &app->lesson;
    double nearest = 8 * sl_app_scale(app) / app->camera.scale;
    bool any = false;
    for (uint32_t i = 0; i < 2 * lesson->end_count; i++) {
        const sl_point p = i % 2 ? lesson->ends[i / 2].right : lesson->ends[i / 2].left;
        const double distance = hypot(p.x - at.x, p.y - at.y);
        if (distance > nearest) continue;
        nearest = distance;
        *found = i;
        any = true;
    }
    return any;
}

static bool near_line(const sl_app *app, sl_point at) {
    const sl_lesson *lesson = &app->lesson;
    if (!lesson->end_count) return false;
    const sl_point p = sl_dual_point(&lesson->dual, at);
    const double off =
        fabs(p.y - lesson->line.slope * p.x - lesson->line.height) / hypot(1, lesson->line.slope);
    return off * lesson->dual.scale * app->camera.scale < 7 * sl_app_scale(app);
}

static sl_drag_kind plan_drag(sl_app *app, sl_drag *drag) {
    const bool searches = app->mode == SL_MODE_LEARN && app->lesson.end_count > 0;
    if (searches && pick_end(app, drag->at, &drag->index)) return SL_DRAG_END;
    if (searches && near_line(app, drag->at)) return SL_DRAG_LINE;
    const bool moves = app->mode == SL_MODE_EXPLORE || app->mode == SL_MODE_DRAW;
    if (moves && sl_mirror_take(app, drag)) return SL_DRAG_MIRROR;
    if (app->mode == SL_MODE_EXPLORE && sl_object_take(app, drag)) return SL_DRAG_OBJECT;
    if (app->mode != SL_MODE_DRAW) return SL_DRAG_PAN;
    drag->index = sl_edit_pick(app, drag->at);
    app->wall = drag->index;
    return drag->index == UINT32_MAX ? SL_DRAG_NEW_WALL : SL_DRAG_WALL;
}

static void click(sl_app *app, const sl_hit *hit) {
    if (hit->kind == SL_HIT_ACTION) {
        const bool from_help = app->help;
        app->help = false;
        if (!from_help || hit->value != sl_action_find("help")) sl_action_run(app, hit->value);
    } else if (hit->kind == SL_HIT_METHOD) {
        if (app->compare && (size_t)hit->value != app->method) app->other = app->method;
        app->method = (size_t)hit->value;
    } else if (hit->kind == SL_HIT_MAP) {
        sl_shelf_choose(app, (size_t)hit->value);
    } else if (hit->kind == SL_HIT_PANEL && hit->value == 1) {
        app->help = app->maps_open = false;
    }
}

static void explain_to(sl_app *app, sl_point at) {
    if (!app->document.baked) return;
    const uint32_t to = sl_space_locate(&app->document.baked->space, at);
    const uint32_t from = sl_app_eye_cell(app);
    if (to == SL_NO_CELL || from == SL_NO_CELL) return;
    sl_quiz_explain(app, from, to);
    if (!app->quiz.answered) return;
    char text[sizeof app->message];
    sl_quiz_words(app, text, sizeof text);
    sl_app_say(app, false, "Cell %u: %.440s", to, text);
}

void sl_input_press(sl_app *app, sl_button button, sl_point at) {
    app->pointer = at;
    const sl_hit hit = sl_ui_find(&app->ui, at);
    sl_drag *drag = &app->drag;
    *drag = (sl_drag){.hit = hit, .from = at, .last = at, .index = UINT32_MAX};
    if (hit.kind != SL_HIT_PLAN) {
        if (button != SL_BUTTON_LEFT) return;
        drag->kind = SL_DRAG_HIT;
        if (hit.kind == SL_HIT_SLIDER && slider_of(&hit)->begin) slider_of(&hit)->begin(app);
        click(app, &hit);
        follow(app, &hit, at);
        return;
    }
    if (!app->document.baked) return;
    drag->at = to_map(app, hit.value, at);
    if (button == SL_BUTTON_RIGHT && app->mode != SL_MODE_DRAW)
        explain_to(app, drag->at);
    else if (button == SL_BUTTON_LEFT)
        drag->kind = plan_drag(app, drag);
    else
        drag->kind = button == SL_BUTTON_MIDDLE ? SL_DRAG_LOOK : SL_DRAG_PAN;
}

static void drag_end(sl_app *app, uint32_t index, sl_point at) {
    sl_lesson *lesson = &app->lesson;
    if (index >= 2 * lesson->end_count) return;
    sl_portal_ends *ends = &lesson->ends[index / 2];
    const sl_portal_ends before = *ends;
    *(index % 2 ? &ends->right : &ends->left) = at;
    if (ends->left.x == ends->right.x && ends->left.y == ends->right.y) *ends = before;
    lesson->dragged = true;
    sl_lesson_refresh(lesson);
    if (lesson->dual.corner_count) lesson->line = lesson->dual.best;
}

void sl_input_move(sl_app *app, sl_point to) {
    sl_drag *drag = &app->drag;
    app->pointer = to;
    if (drag->kind == SL_DRAG_NONE) return;
    const double dx = to.x - drag->last.x, dy = to.y - drag->last.y;
    if (hypot(to.x - drag->from.x, to.y - drag->from.y) > 3) drag->moved = true;
    const sl_point before = to_map(app, drag->hit.value, drag->last);
    const sl_point now = to_map(app, drag->hit.value, to);
    switch (drag->kind) {
    case SL_DRAG_PAN:
        if (!drag->moved) return;
        app->fitted = false;
        app->motion = 0.2;
        sl_camera_pan(&app->camera, dx, dy);
        break;
    case SL_DRAG_LOOK:
        app->eye.heading = fmod(app->eye.heading - 0.4 * dx + 720, 360);
        break;
    case SL_DRAG_HIT:
        follow(app, &drag->hit, to);
        break;
    case SL_DRAG_LINE:
        sl_pane_plan_drag_line(app, before, now);
        break;
    case SL_DRAG_END:
        if (drag->moved) drag_end(app, drag->index, now);
        break;
    case SL_DRAG_MIRROR:
        if (drag->moved) sl_mirror_move(app, drag, now);
        break;
    case SL_DRAG_OBJECT:
        if (drag->moved) sl_object_move(app, drag, now);
        break;
    case SL_DRAG_NEW_WALL:
    case SL_DRAG_WALL:
    case SL_DRAG_NONE:
        break;
    }
    drag->last = to;
}

static void finish_wall(sl_app *app, const sl_drag *drag, sl_point now) {
    if (drag->kind == SL_DRAG_NEW_WALL) {
        sl_edit_add(app, sl_edit_snap(app, drag->at), sl_edit_snap(app, now));
        return;
    }
    const double step = sl_edit_step(app);
    sl_edit_move(app, drag->index, step * round((now.x - drag->at.x) / step),
                 step * round((now.y - drag->at.y) / step));
}

void sl_input_release(sl_app *app, sl_point at) {
    const sl_drag drag = app->drag;
    app->drag = (sl_drag){0};
    app->pointer = at;
    if (!app->document.baked) return;
    if (drag.hit.kind == SL_HIT_SLIDER && slider_of(&drag.hit)->end) slider_of(&drag.hit)->end(app);
    const sl_point now = to_map(app, drag.hit.value, at);
    if ((drag.kind == SL_DRAG_NEW_WALL || drag.kind == SL_DRAG_WALL) && drag.moved)
        finish_wall(app, &drag, now);
    if (drag.kind == SL_DRAG_MIRROR) sl_mirror_drop(app, &drag);
    if (drag.kind == SL_DRAG_OBJECT && !drag.moved) sl_object_toggle(app, drag.index);
    const bool holds =
        drag.kind == SL_DRAG_PAN || (drag.kind == SL_DRAG_MIRROR && app->mode == SL_MODE_EXPLORE);
    const bool puts = holds && !drag.moved && app->mode != SL_MODE_QUIZ;
    const uint32_t door = puts ? sl_door_at(app, now) : UINT32_MAX;
    if (door != UINT32_MAX) {
        sl_door_toggle(app, door);
    } else if (puts && sl_space_locate(&app->document.baked->space, now) != SL_NO_CELL) {
        app->eye.at = now;
        app->recorder.plays = false;
        if (app->mode == SL_MODE_EXPLORE) sl_quiz_forget(app);
    }
}

void sl_input_wheel(sl_app *app, double steps) {
    if (app->maps_open) {
        sl_shelf_move(app, -(int)round(fmin(fmax(steps, -3), 3)));
        return;
    }
    const sl_layout l = sl_app_layout(app);
    for (int i = 0; i < l.plan_count; i++) {
        if (!sl_box_has(l.plan[i], app->pointer) || !(app->camera.scale > 0)) continue;
        const sl_point middle = {(l.plan[i].min.x + l.plan[i].max.x) / 2,
                                 (l.plan[i].min.y + l.plan[i].max.y) / 2};
        app->fitted = false;
        app->motion = 0.2;
        sl_camera_zoom(&app->camera, pow(1.2, steps),
                       (sl_point){app->pointer.x - middle.x, app->pointer.y - middle.y});
    }
}
