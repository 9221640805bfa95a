/// Runs without a user: frame times of a walk, and random events.
#include "app/bench.h"

#include "app/actions.h"
#include "app/input.h"
#include "app/layout.h"
#include "app/script.h"
#include "app/turn.h"
#include "app/window.h"
#include "plan/edit.h"
#include "plan/grid.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

// --- meter

enum { METER_MOST = 20000 };

typedef struct frame_meter {
    double seconds[METER_MOST];
    size_t count;
} frame_meter;

typedef struct meter_summary {
    double mean, median, p95, worst; ///< seconds
} meter_summary;

static void meter_add(frame_meter *meter, double seconds) {
    if (meter->count < METER_MOST) meter->seconds[meter->count++] = seconds;
}

/// Sorts what was measured.
static meter_summary meter_sum_up(frame_meter *meter) {
    meter_summary sum = {0};
    if (!meter->count) return sum;
    qsort(meter->seconds, meter->count, sizeof *meter->seconds, sl_compare_numbers);
    for (size_t i = 0; i < meter->count; i++) sum.mean += meter->seconds[i] / (double)meter->count;
    sum.median = meter->seconds[meter->count / 2];
    sum.p95 = meter->seconds[meter->count * 95 / 100];
    sum.worst = meter->seconds[meter->count - 1];
    return sum;
}

// --- benchmark

/// Seconds of processor time of this thread. A busy machine and the background hardly change them.
static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void print_row(const document_state *document, const char *part, frame_meter *meter,
                      double processor, unsigned late) {
    const meter_summary sum = meter_sum_up(meter);
    const char *path = document->source.path, *slash = path ? strrchr(path, '/') : NULL;
    struct utsname machine;
    if (uname(&machine) != 0) snprintf(machine.nodename, sizeof machine.nodename, "unknown");
    printf("%s,%u,%u,%s,%zu,%.2f,%.2f,%.2f,%.2f,%.2f,%u,%s\n",
           slash  ? slash + 1
           : path ? path
                  : "",
           document->baked->space.cell_count, document->baked->space.wall_count, part, meter->count,
           1e3 * sum.mean, 1e3 * sum.median, 1e3 * sum.p95, 1e3 * sum.worst,
           1e3 * processor / (double)meter->count, late, machine.nodename);
}

/// The place in the window of the wall nearest to the eye: its middle, or its end.
static sl_point grip_of_wall(const app_state *app, bool corner) {
    const sl_map *map = &app->document.map;
    const window_layout l = app_layout(app);
    const plan_camera *camera = &app->view.camera;
    const sl_point middle = box_middle(l.plan[0]);
    double nearest = INFINITY;
    sl_point at = middle;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_point a = map->walls[i].a, b = map->walls[i].b;
        const double off = grid_distance(app->view.eye.at, a, b);
        // Longer than the room that its corners take.
        if (off >= nearest || hypot(b.x - a.x, b.y - a.y) < 4 * grid_reach(&app->view)) continue;
        nearest = off;
        at = corner ? a : (sl_point){(a.x + b.x) / 2, (a.y + b.y) / 2};
    }
    return (sl_point){middle.x + (at.x - camera->middle.x) * camera->scale,
                      middle.y - (at.y - camera->middle.y) * camera->scale};
}

/// Drags a wall, or a corner, round in a circle, to the middle of the map and back; each frame is
/// another place.
static void drag_on(app_state *app, bool corner, unsigned frame) {
    static const double radius = 25;
    drag_state *drag = &app->view.drag;
    if (frame == 0) {
        app->view.mode = MODE_DRAW;
        app->view.eye.flies = true;
        input_press(app, BUTTON_LEFT, grip_of_wall(app, corner));
    }
    const sl_box plan = app_layout(app).plan[0];
    const double angle = 0.3 * frame, towards = atan2((plan.min.y + plan.max.y) / 2 - drag->from.y,
                                                      (plan.min.x + plan.max.x) / 2 - drag->from.x);
    input_move(app, (sl_point){drag->from.x + radius * (cos(towards) - cos(towards + angle)),
                               drag->from.y + radius * (sin(towards) - sin(towards + angle))});
}

/// One frame of a part of the benchmark.
static void move_frame(app_state *app, int part, unsigned frame) {
    if (part >= 4) {
        drag_on(app, part == 5, frame);
        return;
    }
    app->ui.first_person = app->ui.accounts = part == 3;
    if (part == 0 || part == 3) { // walks, and turns away from walls
        app->view.held = HOLD_FORWARD | (frame / 20 % 3 == 0 ? HOLD_TURN_LEFT : 0u);
    } else if (part == 1) { // looks round
        app->view.eye.heading = fmod(app->view.eye.heading + 2, 360);
    } else { // pans and zooms
        view_pan(&app->view, 4 * cos(frame * 0.05), 4 * sin(frame * 0.05));
        view_zoom(&app->view, frame / 60 % 2 ? 1 / 1.02 : 1.02, (sl_point){0, 0});
    }
}

/// What is dragged is what one sees of the whole map.
static void begin_part(app_state *app, int part) {
    app->view.held = 0;
    if (part < 4) return;
    app->ui.first_person = app->ui.accounts = false;
    app->view.fitted = true;
}

/// The map is as it was, and nothing works beside what is measured next.
static void end_part(app_state *app, int part) {
    if (part < 4) return;
    edit_cancel(&app->view);
    while (app->document.job) app_tick(app, 0);
}

sl_status bench_run(app_state *app, unsigned frames) {
    static const char *const parts[] = {"walk",         "look round",
                                        "pan and zoom", "walk with all panes",
                                        "drag a wall",  "drag a corner"};
    const int count = sizeof parts / sizeof *parts;
    app_window *window;
    // The heat map does not change with the eye, and is made anew while something is dragged.
    app->view.show = SHOW_ALL & ~(unsigned)SHOW_HEAT;
    app_settle(app);
    if (!app->document.baked) return sl_fail(app->context, SL_BAD_ARGUMENT, "no map is open");
    SL_TRY(window_open(app, true, &window));
    frame_meter *meter = sl_alloc_array(app->context, 1, sizeof *meter);
    sl_status status = meter ? SL_OK : SL_NO_MEMORY;
    app->ui.steady = false;
    puts("map,cells,walls,part,frames,mean_ms,median_ms,p95_ms,worst_ms,processor_ms,late,machine");
    for (int part = 0; part < count && status == SL_OK; part++) {
        double processor = 0;
        unsigned late = 0;
        meter->count = 0;
        begin_part(app, part);
        if (status == SL_OK) status = window_show(window);
        for (unsigned i = 0; i < frames + 5 && status == SL_OK; i++) {
            if (i == 5) processor = processor_seconds();
            const double before = sl_seconds();
            move_frame(app, part, i);
            app_tick(app, 1.0 / 60);
            status = window_show(window);
            // The first frames make what is kept from then on.
            if (i >= 5) meter_add(meter, sl_seconds() - before);
            if (i >= 5) late += view_is_late(&app->view);
        }
        if (status == SL_OK)
            print_row(&app->document, parts[part], meter, processor_seconds() - processor, late);
        end_part(app, part);
    }
    if (meter) sl_free(app->context, meter);
    window_close(window);
    return status;
}

// --- random events

/// Actions that write files or end the program are left to tests.
static bool is_harmless(const char *name) {
    return strncmp(name, "save", 4) != 0 && strncmp(name, "export", 6) != 0 &&
           strcmp(name, "quit") != 0;
}

static sl_point random_place(const ui_state *ui, sl_random *random) {
    return (sl_point){sl_random_unit(random) * ui->width, sl_random_unit(random) * ui->height};
}

static void random_key(app_state *app, sl_random *random) {
    const action_row *action = action_at((int)sl_random_below(random, (uint64_t)action_count()));
    if (!action->key || !is_harmless(action->name)) return;
    // A layout that never turns back to small text would make everything slow.
    if (app->ui.text_scale > 1.8) app->ui.text_scale = 1;
    input_key(app, action->key, true);
    if (sl_random_below(random, 4)) input_key(app, action->key, false);
}

/// Keys that walk through the widgets, and use them.
static void random_focus_key(app_state *app, sl_random *random) {
    static const char *const keys[] = {"Tab",    "Tab",          "Tab",   "Shift+Tab",
                                       "Return", "Shift+Return", "Left",  "Right",
                                       "Up",     "Down",         "Space", "Backspace"};
    const hit_area focused = ui_focused(&app->ui);
    const char *key = keys[sl_random_below(random, sizeof keys / sizeof *keys)];
    const bool writes = focused.kind == HIT_ACTION && focused.value >= 0 &&
                        !is_harmless(action_at(focused.value)->name);
    input_key(app, writes ? "Tab" : key, true);
    input_key(app, key, false);
    if (!sl_random_below(random, 4)) input_text(app, "wall");
}

static bool is_file_button(const ui_state *ui, sl_point at) {
    const hit_area hit = ui_find(ui, at);
    return hit.kind == HIT_ACTION && !is_harmless(action_at(hit.value)->name);
}

static void random_drag(app_state *app, sl_random *random) {
    const sl_point from = random_place(&app->ui, random);
    if (is_file_button(&app->ui, from)) return;
    input_press(app, (button_kind)sl_random_below(random, 3), from);
    if (sl_random_below(random, 2)) {
        input_move(app, random_place(&app->ui, random));
        script_frame(app);
        input_move(app, random_place(&app->ui, random));
    }
    input_release(app, app->ui.pointer);
}

static void random_dialog(app_state *app, sl_random *random) {
    static const char *const keys[] = {"Return", "Escape",    "Tab",  "Shift+Tab",
                                       "Space",  "Down",      "Up",   "Left",
                                       "Right",  "Backspace", "Home", "PageDown"};
    if (dialog_open_now(&app->desk.dialog) == DIALOG_NONE) return;
    if (sl_random_below(random, 4) == 0) input_text(app, "ma\xc3\xa4");
    input_key(app, keys[sl_random_below(random, sizeof keys / sizeof *keys)], true);
}

/// A place in the window on a wall or a door of the map: an end, or somewhere between.
static bool random_grip(const app_state *app, sl_random *random, sl_point *at) {
    const sl_map *map = &app->document.map;
    const size_t count = map->wall_count + map->door_count;
    if (!count || !(app->view.camera.scale > 0)) return false;
    const size_t i = sl_random_below(random, count);
    const sl_segment s = i < map->wall_count ? (sl_segment){map->walls[i].a, map->walls[i].b}
                                             : map->doors[i - map->wall_count].segment;
    const double share = 0.5 * (double)sl_random_below(random, 3);
    const sl_frame frame = camera_frame(&app->view.camera, app_layout(app).plan[0], 1);
    *at = sl_frame_point(
        &frame, (sl_point){s.a.x + share * (s.b.x - s.a.x), s.a.y + share * (s.b.y - s.a.y)});
    return box_has(app_layout(app).plan[0], *at);
}

/// Drags a wall, a corner or a door by hand, frame by frame. Keys may come between: Esc, or others.
static void random_edit(app_state *app, sl_random *random) {
    sl_point at;
    if (app->view.mode != MODE_DRAW) input_key(app, "F3", true);
    if (app->ui.help || dialog_open_now(&app->desk.dialog) != DIALOG_NONE ||
        !random_grip(app, random, &at))
        return;
    if (ui_find(&app->ui, at).kind != HIT_PLAN) return;
    input_press(app, BUTTON_LEFT, at);
    for (uint64_t steps = sl_random_below(random, 8); steps > 0; steps--) {
        const double far = sl_random_below(random, 8) ? 40 : 400;
        at.x += far * (sl_random_unit(random) - 0.5);
        at.y += far * (sl_random_unit(random) - 0.5);
        input_move(app, at);
        app_tick(app, 1.0 / 60);
        if (sl_random_below(random, 3)) script_frame(app);
        if (!sl_random_below(random, 12)) random_key(app, random);
    }
    if (!sl_random_below(random, 4)) input_key(app, "Escape", true);
    input_release(app, at);
}

static void random_event(app_state *app, sl_random *random) {
    switch (sl_random_below(random, 46)) {
    case 40:
    case 41:
    case 42:
    case 43:
        random_edit(app, random);
        break;
    case 44:
    case 45:
        input_key(app, "Escape", true); // whatever is at work
        break;
    case 0:
        app->ui.width = 320 + (int)sl_random_below(random, 900);
        app->ui.height = 240 + (int)sl_random_below(random, 700);
        break;
    case 1:
        app->view.held = 0;
        break;
    case 2:
        random_dialog(app, random);
        break;
    case 3:
    case 4:
        input_wheel(app, 6 * (sl_random_unit(random) - 0.5));
        break;
    case 5:
    case 6:
    case 7:
    case 8:
    case 9:
    case 10:
    case 11:
    case 12:
        random_drag(app, random);
        break;
    case 15:
    case 16:
    case 17:
    case 18:
        random_focus_key(app, random);
        break;
    case 13:
    case 14:
        input_move(app, random_place(&app->ui, random));
        break;
    default:
        random_key(app, random);
        break;
    }
}

sl_status soak_run(app_state *app, double seconds, uint64_t seed) {
    sl_random random = {seed};
    const double end = sl_seconds() + seconds;
    uint64_t events = 0;
    app->desk.file.locked = true;
    while (sl_seconds() < end) {
        random_event(app, &random);
        app_tick(app, 1.0 / 30);
        script_frame(app);
        events++;
    }
    printf("%llu random events from seed %llu in %g seconds\n", (unsigned long long)events,
           (unsigned long long)seed, seconds);
    return SL_OK;
}
