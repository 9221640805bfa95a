#include "settings.h"

#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH = 4096 };

/// False where there is no home to remember in. Makes the folders where `make` is set.
static bool find_path(char path[PATH], bool make) {
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    char folder[PATH - 64];
    int length;
    if (config && config[0] == '/')
        length = snprintf(folder, sizeof folder, "%s", config);
    else if (home && home[0] == '/')
        length = snprintf(folder, sizeof folder, "%s/.config", home);
    else
        return false;
    if (length < 0 || (size_t)length >= sizeof folder) return false;
    if (make) mkdir(folder, 0700);
    snprintf(path, PATH, "%s/sightline", folder);
    if (make) mkdir(path, 0700);
    snprintf(path, PATH, "%s/sightline/view.conf", folder);
    return true;
}

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
    SETTINGS
};

static void describe(const app_state *app, setting list[SETTINGS]) {
    size_t count;
    sl_eye_methods(&count);
    const setting all[SETTINGS] = {
        [DARK] = {"dark", 0, 1, app->ui.dark},
        [TEXT] = {"text", 0.7, 3, app->ui.text_scale},
        [SHOW] = {"layers", 0, SHOW_ALL, app->view.show},
        [CONE] = {"cone", 1, 360, app->view.eye.fov},
        [METHOD] = {"method", 0, (double)count - 1, (double)app->view.method},
        [WIDTH] = {"width", 320, 8192, round(app->ui.width / app->ui.density)},
        [HEIGHT] = {"height", 240, 8192, round(app->ui.height / app->ui.density)},
        [PANEL] = {"panel", 0, 1, app->ui.side_panel},
        [FIRST_PERSON] = {"first_person", 0, 1, app->ui.first_person},
        [ACCOUNT] = {"account", 0, 1, app->ui.accounts},
        [EFFECTS] = {"effects", 0, 1, app->ui.effects},
    };
    memcpy(list, all, sizeof all);
}

void settings_load(app_state *app) {
    char path[PATH];
    sl_bytes bytes;
    if (!find_path(path, false) || sl_file_read(app->context, path, &bytes) != SL_OK) return;
    setting list[SETTINGS];
    describe(app, list);
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
}

void settings_save(app_state *app) {
    char path[PATH];
    sl_output output;
    if (!find_path(path, true) || sl_output_open(app->context, path, &output) != SL_OK) return;
    setting list[SETTINGS];
    describe(app, list);
    for (int i = 0; i < SETTINGS; i++)
        fprintf(output.stream, "%s %.6g\n", list[i].name, list[i].value);
    sl_output_close(app->context, &output, SL_OK);
}
