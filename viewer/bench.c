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

static void print_row(const app_state *app, const char *part, frame_meter *meter,
                      double processor) {
    const meter_summary sum = meter_sum_up(meter);
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
static void move(app_state *app, int part, unsigned frame) {
    app->ui.first_person = app->ui.accounts = part == 3;
    if (part == 0 || part == 3) { // walks, and turns away from walls
        app->tool.held = HOLD_FORWARD | (frame / 20 % 3 == 0 ? HOLD_TURN_LEFT : 0u);
    } else if (part == 1) { // looks round
        app->view.eye.heading = fmod(app->view.eye.heading + 2, 360);
    } else { // pans and zooms
        app->view.fitted = false;
        app->view.motion = 0.2;
        camera_pan(&app->view.camera, 4 * cos(frame * 0.05), 4 * sin(frame * 0.05));
        camera_zoom(&app->view.camera, frame / 60 % 2 ? 1 / 1.02 : 1.02, (sl_point){0, 0});
    }
}

sl_status bench_run(app_state *app, unsigned frames) {
    static const char *const parts[] = {"walk", "look round", "pan and zoom",
                                        "walk with all panes"};
    app_window *window;
    app->view.show = SHOW_ALL;
    app_settle(app);
    if (!app->document.baked) return sl_fail(app->context, SL_BAD_ARGUMENT, "no map is open");
    SL_TRY(window_open(app, true, &window));
    frame_meter *meter = sl_alloc_array(app->context, 1, sizeof *meter);
    sl_status status = meter ? SL_OK : SL_NO_MEMORY;
    app->steady = false;
    puts("map,cells,walls,part,frames,mean_ms,median_ms,p95_ms,worst_ms,processor_ms,machine");
    for (int part = 0; part < 4 && status == SL_OK; part++) {
        double processor = 0;
        meter->count = 0;
        app->tool.held = 0;
        for (unsigned i = 0; i < frames + 5 && status == SL_OK; i++) {
            if (i == 5) processor = clock_processor();
            const double before = clock_seconds();
            move(app, part, i);
            app_tick(app, 1.0 / 60);
            status = window_show(window);
            // The first frames make what is kept from then on.
            if (i >= 5) meter_add(meter, clock_seconds() - before);
        }
        if (status == SL_OK) print_row(app, parts[part], meter, clock_processor() - processor);
    }
    if (meter) sl_free(app->context, meter);
    window_close(window);
    return status;
}
