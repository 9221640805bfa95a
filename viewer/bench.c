#include "bench.h"

#include "clock.h"
#include "input.h"
#include "meter.h"
#include "sightline/support.h"
#include "window.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>

static void print_row(const sl_app *app, const char *part, sl_meter *meter, double processor) {
    const sl_meter_summary sum = sl_meter_sum_up(meter);
    const char *path = app->document.source.path, *slash = path ? strrchr(path, '/') : NULL;
    struct utsname machine;
    if (uname(&machine) != 0) snprintf(machine.nodename, sizeof machine.nodename, "unknown");
    printf("%s,%u,%u,%s,%zu,%.2f,%.2f,%.2f,%.2f,%.2f,%s\n",
           slash  ? slash + 1
           : path ? path
                  : "",
           app->document.baked->space.cell_count, app->document.baked->space.wall_count, part,
           meter->count, 1e3 * sum.mean, 1e3 * sum.median, 1e3 * sum.p95, 1e3 * sum.worst,
           1e3 * processor / (double)meter->count, machine.nodename);
}

/// One frame of a part of the benchmark.
static void move(sl_app *app, int part, unsigned frame) {
    app->first_person = app->accounts = part == 3;
    if (part == 0 || part == 3) { // walks, and turns away from walls
        app->held = SL_HOLD_FORWARD | (frame / 20 % 3 == 0 ? SL_HOLD_TURN_LEFT : 0u);
    } else if (part == 1) { // looks round
        app->eye.heading = fmod(app->eye.heading + 2, 360);
    } else { // pans and zooms
        app->fitted = false;
        app->motion = 0.2;
        sl_camera_pan(&app->camera, 4 * cos(frame * 0.05), 4 * sin(frame * 0.05));
        sl_camera_zoom(&app->camera, frame / 60 % 2 ? 1 / 1.02 : 1.02, (sl_point){0, 0});
    }
}

sl_status sl_bench_run(sl_app *app, unsigned frames) {
    static const char *const parts[] = {"walk", "look round", "pan and zoom",
                                        "walk with all panes"};
    sl_window *window;
    app->show = SL_SHOW_ALL;
    sl_app_settle(app);
    if (!app->document.baked) return sl_fail(app->context, SL_BAD_ARGUMENT, "no map is open");
    SL_TRY(sl_window_open(app, true, &window));
    sl_meter *meter = sl_alloc_array(app->context, 1, sizeof *meter);
    sl_status status = meter ? SL_OK : SL_NO_MEMORY;
    app->steady = false;
    puts("map,cells,walls,part,frames,mean_ms,median_ms,p95_ms,worst_ms,processor_ms,machine");
    for (int part = 0; part < 4 && status == SL_OK; part++) {
        double processor = 0;
        meter->count = 0;
        app->held = 0;
        for (unsigned i = 0; i < frames + 5 && status == SL_OK; i++) {
            if (i == 5) processor = sl_clock_processor();
            const double before = sl_clock_seconds();
            move(app, part, i);
            sl_app_tick(app, 1.0 / 60);
            status = sl_window_show(window);
            // The first frames make what is kept from then on.
            if (i >= 5) sl_meter_add(meter, sl_clock_seconds() - before);
        }
        if (status == SL_OK) print_row(app, parts[part], meter, sl_clock_processor() - processor);
    }
    if (meter) sl_free(app->context, meter);
    sl_window_close(window);
    return status;
}
