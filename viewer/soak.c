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

static sl_point random_place(const sl_app *app, sl_random *random) {
    return (sl_point){sl_random_unit(random) * app->width, sl_random_unit(random) * app->height};
}

static void random_key(sl_app *app, sl_random *random) {
    size_t count;
    const sl_action *action = &sl_actions(&count)[0];
    action += sl_random_below(random, count);
    if (!action->key || !is_harmless(action->name)) return;
    // A layout that never turns back to small text would make everything slow.
    if (app->text_scale > 1.8) app->text_scale = 1;
    sl_input_key(app, action->key, true);
    if (sl_random_below(random, 4)) sl_input_key(app, action->key, false);
}

static bool is_file_button(const sl_app *app, sl_point at) {
    size_t count;
    const sl_hit hit = sl_ui_find(&app->ui, at);
    return hit.kind == SL_HIT_ACTION && !is_harmless(sl_actions(&count)[hit.value].name);
}

static void random_drag(sl_app *app, sl_random *random) {
    const sl_point from = random_place(app, random);
    if (is_file_button(app, from)) return;
    sl_input_press(app, (sl_button)sl_random_below(random, 3), from);
    if (sl_random_below(random, 2)) {
        sl_input_move(app, random_place(app, random));
        sl_script_frame(app);
        sl_input_move(app, random_place(app, random));
    }
    sl_input_release(app, app->pointer);
}

static void random_event(sl_app *app, sl_random *random) {
    switch (sl_random_below(random, 40)) {
    case 0:
        app->width = 320 + (int)sl_random_below(random, 900);
        app->height = 240 + (int)sl_random_below(random, 700);
        break;
    case 1:
        app->held = 0;
        break;
    case 2:
        if (app->shelf.files.count)
            sl_shelf_choose(app, sl_random_below(random, sl_shelf_list(app)->count));
        break;
    case 3:
    case 4:
        sl_input_wheel(app, 6 * (sl_random_unit(random) - 0.5));
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
        sl_input_move(app, random_place(app, random));
        break;
    default:
        random_key(app, random);
        break;
    }
}

sl_status sl_soak_run(sl_app *app, double seconds, uint64_t seed) {
    sl_random random = {seed};
    const double end = sl_clock_seconds() + seconds;
    uint64_t events = 0;
    while (sl_clock_seconds() < end) {
        random_event(app, &random);
        sl_app_tick(app, 1.0 / 30);
        sl_script_frame(app);
        events++;
    }
    printf("%llu random events from seed %llu in %g seconds\n", (unsigned long long)events,
           (unsigned long long)seed, seconds);
    return SL_OK;
}
