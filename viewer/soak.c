#include "soak.h"

#include "actions.h"
#include "clock.h"
#include "input.h"
#include "script.h"
#include "shelf.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// Actions that write files or end the program are left to tests.
static bool is_harmless(const char *name) {
    return strncmp(name, "save", 4) != 0 && strncmp(name, "export", 6) != 0 &&
           strcmp(name, "quit") != 0;
}

static sl_point random_place(const app_state *app, sl_random *random) {
    return (sl_point){sl_random_unit(random) * app->ui.width,
                      sl_random_unit(random) * app->ui.height};
}

static void random_key(app_state *app, sl_random *random) {
    size_t count;
    const action_row *action = &action_table(&count)[0];
    action += sl_random_below(random, count);
    if (!action->key || !is_harmless(action->name)) return;
    // A layout that never turns back to small text would make everything slow.
    if (app->ui.text_scale > 1.8) app->ui.text_scale = 1;
    input_key(app, action->key, true);
    if (sl_random_below(random, 4)) input_key(app, action->key, false);
}

static bool is_file_button(const app_state *app, sl_point at) {
    size_t count;
    const hit_area hit = ui_find(&app->ui, at);
    return hit.kind == HIT_ACTION && !is_harmless(action_table(&count)[hit.value].name);
}

static void random_drag(app_state *app, sl_random *random) {
    const sl_point from = random_place(app, random);
    if (is_file_button(app, from)) return;
    input_press(app, (button_kind)sl_random_below(random, 3), from);
    if (sl_random_below(random, 2)) {
        input_move(app, random_place(app, random));
        script_frame(app);
        input_move(app, random_place(app, random));
    }
    input_release(app, app->tool.pointer);
}

static void random_event(app_state *app, sl_random *random) {
    switch (sl_random_below(random, 40)) {
    case 0:
        app->ui.width = 320 + (int)sl_random_below(random, 900);
        app->ui.height = 240 + (int)sl_random_below(random, 700);
        break;
    case 1:
        app->tool.held = 0;
        break;
    case 2:
        if (app->shelf.files.count)
            shelf_choose(app, sl_random_below(random, shelf_list(app)->count));
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
    case 13:
    case 14:
        input_move(app, random_place(app, random));
        break;
    default:
        random_key(app, random);
        break;
    }
}

sl_status soak_run(app_state *app, double seconds, uint64_t seed) {
    sl_random random = {seed};
    const double end = clock_seconds() + seconds;
    uint64_t events = 0;
    while (clock_seconds() < end) {
        random_event(app, &random);
        app_tick(app, 1.0 / 30);
        script_frame(app);
        events++;
    }
    printf("%llu random events from seed %llu in %g seconds\n", (unsigned long long)events,
           (unsigned long long)seed, seconds);
    return SL_OK;
}
