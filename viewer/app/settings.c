/// Settings: numbers within bounds.
#include "app/settings.h"

#include "document/files.h"
#include "plan/layers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A setting as a number within bounds.
typedef struct setting {
    const char *name;
    double low, high, value;
} setting;

enum {
    DARK,
    TEXT,
    SHOW,
    CONE,
    METHOD,
    WIDTH,
    HEIGHT,
    PANEL,
    FIRST_PERSON,
    ACCOUNT,
    EFFECTS,
    FILL,
    LEGEND,
    SIDE,
    BELOW,
    SETTINGS
};

static void describe_all(const app_state *app, setting list[SETTINGS]) {
    size_t count;
    sl_eye_methods(&count);
    const setting all[SETTINGS] = {
        [DARK] = {"dark", 0, 1, app->ui.dark},
        [TEXT] = {"text", 0.7, 3, app->ui.text_scale},
        [SHOW] = {"shown", 0, SHOW_ALL, app->view.show},
        [CONE] = {"cone", 1, 360,
                  app->view.mode == MODE_PLAN ? app->view.other_cone : app->view.eye.fov},
        [METHOD] = {"method", 0, (double)count - 1, (double)app->view.method},
        [WIDTH] = {"width", 320, 8192, round(app->ui.window_width / app->ui.density)},
        [HEIGHT] = {"height", 240, 8192, round(app->ui.window_height / app->ui.density)},
        [PANEL] = {"panel", 0, 1, app->ui.side_panel},
        [FIRST_PERSON] = {"first_person", 0, 1, app->ui.first_person},
        [ACCOUNT] = {"account", 0, 1, app->ui.accounts},
        [EFFECTS] = {"effects", 0, 1, app->ui.effects},
        [FILL] = {"filled", 0, LAYER_COUNT, layers_fill(&app->view)},
        [LEGEND] = {"legend", 0, 1, app->ui.legend},
        [SIDE] = {"side", 0, 200, app->ui.edges[EDGE_SIDE]},
        [BELOW] = {"below", 0, 1, app->ui.edges[EDGE_BELOW]},
    };
    memcpy(list, all, sizeof all);
}

void settings_load(app_state *app) {
    char path[PATH_TEXT];
    sl_bytes bytes;
    if (!files_kept("view.conf", path, false) || sl_file_read(app->context, path, &bytes) != SL_OK)
        return;
    setting list[SETTINGS];
    describe_all(app, list);
    for (char *line = bytes.data, *next; line && *line; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        const size_t length = strcspn(line, " ");
        if (!line[length]) continue;
        const double value = strtod(line + length, NULL);
        for (int i = 0; i < SETTINGS; i++)
            if (strlen(list[i].name) == length && strncmp(list[i].name, line, length) == 0 &&
                value >= list[i].low && value <= list[i].high)
                list[i].value = value;
    }
    sl_free(app->context, bytes.data);
    app->ui.dark = list[DARK].value != 0;
    app->ui.text_scale = list[TEXT].value;
    app->view.show = (unsigned)list[SHOW].value;
    app->view.eye.fov = list[CONE].value;
    app->view.method = (size_t)list[METHOD].value;
    app->ui.width = (int)list[WIDTH].value;
    app->ui.height = (int)list[HEIGHT].value;
    app->ui.side_panel = list[PANEL].value != 0;
    app->ui.first_person = list[FIRST_PERSON].value != 0;
    app->ui.accounts = list[ACCOUNT].value != 0;
    app->ui.effects = list[EFFECTS].value != 0;
    layers_set_fill(&app->view, (unsigned)list[FILL].value);
    app->ui.legend = list[LEGEND].value != 0;
    app->ui.edges[EDGE_SIDE] = list[SIDE].value;
    app->ui.edges[EDGE_BELOW] = list[BELOW].value;
}

void settings_save(app_state *app) {
    char path[PATH_TEXT];
    sl_output output;
    if (!files_kept("view.conf", path, true) ||
        sl_output_open(app->context, path, &output) != SL_OK)
        return;
    setting list[SETTINGS];
    describe_all(app, list);
    for (int i = 0; i < SETTINGS; i++)
        fprintf(output.stream, "%s %.6g\n", list[i].name, list[i].value);
    sl_output_close(app->context, &output, SL_OK);
}
