/// The viewer without a window, for tests of its state.
#ifndef SL_TEST_VIEWER_APP_H
#define SL_TEST_VIEWER_APP_H

#include "testing.h"

#include "app/actions.h"
#include "app/app.h"
#include "app/input.h"
#include "app/layout.h"
#include "app/script.h"
#include "app/start.h"
#include "app/turn.h"
#include "dialogs/opening.h"
#include "sightline/io.h"

#include <string.h>
#include <unistd.h>

#ifndef MAPS
#error "MAPS: the folder of the maps"
#endif

/// With no map; `steady` has each job done before the next step.
static inline app_state *viewer_start(bool steady) {
    sl_context *context = sl_context_create(NULL);
    app_state *app = calloc(1, sizeof *app);
    assert_non_null(context);
    assert_non_null(app);
    assert_int_equal(sl_io_use(context), SL_OK);
    app_init(app, context);
    app->desk.options = sl_import_options_default();
    app->ui.steady = steady;
    return app;
}

static inline void viewer_open(app_state *app, const char *map) {
    files_open(&app->desk, map, false);
    app_settle(app);
    if (!app->document.baked) fail_msg("%s: %s", map, app->ui.message);
}

static inline void viewer_end(app_state *app) {
    sl_context *context = app->context;
    app_destroy(app);
    free(app);
    sl_context_destroy(context);
}

static inline void viewer_press(app_state *app, const char *key) {
    input_key(app, key, true);
    input_key(app, key, false);
}

/// Answers the question that is open.
static inline void viewer_answer(app_state *app, const char *key) {
    assert_int_equal(dialog_open_now(&app->desk.dialog), DIALOG_QUESTION);
    viewer_press(app, key);
    app_tick(app, 0);
    script_frame(app);
}

/// Where a place of the map is on the plan's page.
static inline sl_point viewer_on_page(const app_state *app, sl_point at) {
    const sl_frame frame = camera_frame(&app->view.camera, app_layout(app).plan[0], 1);
    return sl_frame_point(&frame, at);
}

/// Keeps what is written in the frames from now on, and where.
static inline void viewer_keep_spots(app_state *app) {
    app->ui.spots = calloc(SPOTS_MOST, sizeof *app->ui.spots);
    assert_non_null(app->ui.spots);
}

static inline void viewer_drop_spots(app_state *app) {
    free(app->ui.spots);
    app->ui.spots = NULL;
}

/// Whether a text with this part is in the frame.
static inline bool viewer_says(const app_state *app, const char *part) {
    for (int i = 0; i < app->ui.spot_count; i++)
        if (strstr(app->ui.spots[i].text, part)) return true;
    return false;
}

/// The box of the first text that is this one.
static inline sl_box viewer_spot(const app_state *app, const char *text) {
    for (int i = 0; i < app->ui.spot_count; i++)
        if (strcmp(app->ui.spots[i].text, text) == 0) return app->ui.spots[i].box;
    fail_msg("'%s' is not shown", text);
    return (sl_box){0};
}

static inline void viewer_write(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/// For a group of tests: they run in a folder of their own, and leave nothing in it.
static inline int viewer_enter_folder(void **state) {
    char *folder = strdup("/tmp/sightline-viewer-XXXXXX");
    *state = folder;
    return !folder || !mkdtemp(folder) || chdir(folder);
}

static inline int viewer_leave_folder(void **state) {
    const int left = chdir("/") || rmdir(*state);
    if (left) print_error("%s: files are left\n", (const char *)*state);
    free(*state);
    return left;
}

#endif
