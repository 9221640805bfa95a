/// The commands of scripts, one function each, and the loop over the lines.
#include "app/script.h"

#include "app/actions.h"
#include "app/frame.h"
#include "app/input.h"
#include "app/pictures.h"
#include "app/print.h"
#include "app/turn.h"
#include "dialogs/map_file.h"
#include "dialogs/opening.h"
#include "dialogs/question.h"
#include "panes/account.h"
#include "plan/cameras.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    app_state *app;
    const char *file;
    unsigned line;
    void (*after)(void *user, app_state *app);
    void *user;
} reader;

/// The words of a line, the command first. `rest` is all behind the command.
typedef struct words {
    const char *name, *rest;
    double numbers[4];
    int count;
} words;

void script_frame(app_state *app) {
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, app->ui.width, app->ui.height);
    cairo_t *cairo = cairo_create(surface);
    app_draw(app, cairo);
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
}

static void show_frame(reader *r, double seconds) {
    app_tick(r->app, seconds);
    if (r->after)
        r->after(r->user, r->app);
    else
        script_frame(r->app);
}

// --- commands

static sl_status do_open(reader *r, const words *w) {
    map_file_give_up(&r->app->desk);
    files_open(&r->app->desk, w->rest, false);
    app_settle(r->app);
    if (r->app->ui.message_is_error)
        return sl_fail_at(r->app->context, r->file, r->line, "%s", r->app->ui.message);
    return SL_OK;
}

static sl_status do_drop(reader *r, const words *w) {
    files_drop(&r->app->desk, w->rest);
    app_settle(r->app);
    show_frame(r, 0);
    return SL_OK;
}

static sl_status do_type(reader *r, const words *w) {
    input_text(r->app, w->rest);
    show_frame(r, 0);
    return SL_OK;
}

/// A script goes wrong where it does not find what it expects.
static sl_status do_expect(reader *r, const words *w) {
    char title[TITLE_TEXT];
    const dialog_state *dialog = &r->app->desk.dialog;
    script_frame(r->app);
    map_file_title(&r->app->desk, title);
    const char *const shown[] = {title, r->app->ui.message, dialog->title, dialog->problem,
                                 question_text(&r->app->desk)};
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++)
        if (strstr(shown[i], w->rest)) return SL_OK;
    return sl_fail_at(r->app->context, r->file, r->line,
                      "'%s' is not shown. The window's title: '%s'; the message: '%s'; the dialog: "
                      "'%s', '%s', '%.300s'",
                      w->rest, shown[0], shown[1], shown[2], shown[3], shown[4]);
}

static sl_status check_key(reader *r, const char *key) {
    // A dialog and a field have keys of their own.
    const bool typed = dialog_open_now(&r->app->desk.dialog) != DIALOG_NONE || r->app->ui.field;
    if (typed || input_takes(key)) return SL_OK;
    return sl_fail_at(r->app->context, r->file, r->line, "no action has the key '%s'", key);
}

static sl_status do_key(reader *r, const words *w) {
    SL_TRY(check_key(r, w->rest));
    if (!r->app->ui.hit_count) show_frame(r, 0); // keys act on what was drawn
    input_key(r->app, w->rest, true);
    show_frame(r, 1.0 / 60);
    input_key(r->app, w->rest, false);
    return SL_OK;
}

static sl_status do_down(reader *r, const words *w) {
    SL_TRY(check_key(r, w->rest));
    input_key(r->app, w->rest, true);
    return SL_OK;
}

static sl_status do_up(reader *r, const words *w) {
    SL_TRY(check_key(r, w->rest));
    input_key(r->app, w->rest, false);
    return SL_OK;
}

static sl_status do_action(reader *r, const words *w) {
    const int number = action_find(w->rest);
    if (number < 0)
        return sl_fail_at(r->app->context, r->file, r->line, "no action is called '%s'", w->rest);
    action_run(r->app, number);
    show_frame(r, 0);
    return SL_OK;
}

static sl_status do_move(reader *r, const words *w) {
    input_move(r->app, (sl_point){w->numbers[0], w->numbers[1]});
    return SL_OK;
}

static void press_and_drag(reader *r, button_kind button, sl_point from, sl_point to) {
    show_frame(r, 0);
    input_move(r->app, from);
    input_press(r->app, button, from);
    if (to.x != from.x || to.y != from.y)
        for (int i = 1; i <= 4; i++)
            input_move(r->app, (sl_point){from.x + (to.x - from.x) * i / 4,
                                          from.y + (to.y - from.y) * i / 4});
    input_release(r->app, to);
    show_frame(r, 0);
}

static sl_status do_click(reader *r, const words *w) {
    const sl_point at = {w->numbers[0], w->numbers[1]};
    press_and_drag(r, BUTTON_LEFT, at, at);
    return SL_OK;
}

static sl_status do_right(reader *r, const words *w) {
    const sl_point at = {w->numbers[0], w->numbers[1]};
    press_and_drag(r, BUTTON_RIGHT, at, at);
    return SL_OK;
}

static sl_status do_drag(reader *r, const words *w) {
    press_and_drag(r, BUTTON_LEFT, (sl_point){w->numbers[0], w->numbers[1]},
                   (sl_point){w->numbers[2], w->numbers[3]});
    return SL_OK;
}

static sl_status do_wheel(reader *r, const words *w) {
    input_wheel(r->app, w->numbers[0]);
    return SL_OK;
}

static sl_status do_wait(reader *r, const words *w) {
    for (double i = 0; i < fmin(w->numbers[0], 1e5); i++) show_frame(r, 1.0 / 60);
    return SL_OK;
}

static sl_status do_size(reader *r, const words *w) {
    if (!(w->numbers[0] >= 320 && w->numbers[0] <= 8192 && w->numbers[1] >= 240 &&
          w->numbers[1] <= 8192))
        return sl_fail_at(r->app->context, r->file, r->line, "a size is 320x240 to 8192x8192");
    r->app->ui.width = (int)w->numbers[0];
    r->app->ui.height = (int)w->numbers[1];
    return SL_OK;
}

static sl_status do_eye(reader *r, const words *w) {
    if (w->count != 3 && w->count != 4)
        return sl_fail_at(r->app->context, r->file, r->line, "eye needs X Y HEADING [CONE]");
    r->app->view.eye.at = (sl_point){w->numbers[0], w->numbers[1]};
    r->app->view.eye.heading = fmod(fmod(w->numbers[2], 360) + 360, 360);
    if (w->count == 4) r->app->view.eye.fov = fmin(fmax(w->numbers[3], 1), 360);
    return SL_OK;
}

static sl_status do_text(reader *r, const words *w) {
    r->app->ui.text_scale = fmin(fmax(w->numbers[0], 0.7), 3);
    return SL_OK;
}

/// Of the screen: pixels where a common one has 1.
static sl_status do_density(reader *r, const words *w) {
    r->app->ui.density = fmin(fmax(w->numbers[0], 1), 4);
    return SL_OK;
}

static sl_status do_screenshot(reader *r, const words *w) {
    app_tick(r->app, 0);
    return save_window(r->app, w->rest);
}

static sl_status do_save(reader *r, const words *w) {
    app_tick(r->app, 0);
    return save_plan(r->app, w->rest);
}

static sl_status do_cameras(reader *r, const words *w) {
    return cameras_read(&r->app->view, w->rest);
}

static sl_status do_save_cameras(reader *r, const words *w) {
    return cameras_write(&r->app->view, w->rest);
}

static sl_status do_account(reader *r, const words *w) {
    app_tick(r->app, 0);
    return account_save(&r->app->view, w->rest);
}

static sl_status do_export(reader *r, const words *w) {
    return save_series(r->app, w->rest, 2);
}

/// Checks that every text of the next frame is in its panel, and lies on no other.
static sl_status do_fits(reader *r, const words *w) {
    (void)w;
    char text[160];
    ui_state *ui = &r->app->ui;
    text_spot *spots = sl_alloc_array(r->app->context, SPOTS_MOST, sizeof *spots);
    if (!spots) return SL_NO_MEMORY;
    app_tick(r->app, 0);
    script_frame(r->app); // some places follow from the frame before
    ui->spots = spots;
    script_frame(r->app);
    const char *misfit = ui_misfit(ui, text);
    ui->spots = NULL;
    ui->spot_count = 0;
    sl_free(r->app->context, spots);
    if (!misfit) return SL_OK;
    return sl_fail_at(r->app->context, r->file, r->line, "%s", misfit);
}

/// Prints what the frame shows now. The frame is drawn twice: what the pointer is over is that of
/// the frame before.
static sl_status do_print(reader *r, const words *w) {
    app_tick(r->app, 0);
    script_frame(r->app);
    script_frame(r->app);
    if (!print_state(r->app, w->rest, stdout))
        return sl_fail_at(r->app->context, r->file, r->line,
                          "no state is called '%s': " PRINT_NAMES, w->rest);
    fflush(stdout);
    return SL_OK;
}

static const struct command {
    const char *name;
    int numbers; ///< that must follow; -1: text, -2: any numbers
    sl_status (*run)(reader *r, const words *w);
} commands[] = {
    {"open", -1, do_open},       {"key", -1, do_key},
    {"down", -1, do_down},       {"up", -1, do_up},
    {"action", -1, do_action},   {"move", 2, do_move},
    {"click", 2, do_click},      {"right", 2, do_right},
    {"drag", 4, do_drag},        {"wheel", 1, do_wheel},
    {"wait", 1, do_wait},        {"size", 2, do_size},
    {"eye", -2, do_eye},         {"text", 1, do_text},
    {"density", 1, do_density},  {"screenshot", -1, do_screenshot},
    {"save", -1, do_save},       {"export", -1, do_export},
    {"account", -1, do_account}, {"drop", -1, do_drop},
    {"type", -1, do_type},       {"expect", -1, do_expect},
    {"fits", 0, do_fits},        {"print", -1, do_print},
    {"cameras", -1, do_cameras}, {"save_cameras", -1, do_save_cameras},
};

static sl_status run_command(reader *r, const struct command *command, words *w) {
    sl_context *context = r->app->context;
    if (command->numbers == -1 && !*w->rest)
        return sl_fail_at(context, r->file, r->line, "%s needs an operand", command->name);
    const char *at = w->rest;
    while (command->numbers != -1 && *at) {
        char *end;
        if (w->count == 4) break;
        w->numbers[w->count] = strtod(at, &end);
        if (end == at || !isfinite(w->numbers[w->count])) break;
        w->count++;
        for (at = end; *at == ' ';) at++;
    }
    if (command->numbers != -1 && (*at || (command->numbers >= 0 && w->count != command->numbers)))
        return sl_fail_at(context, r->file, r->line, "%s: wrong operands '%s'", command->name,
                          w->rest);
    return command->run(r, w);
}

static sl_status run_line(reader *r, char *line) {
    char *comment = strchr(line, '#');
    if (comment && (comment == line || comment[-1] == ' ')) *comment = '\0';
    while (*line == ' ' || *line == '\t') line++;
    size_t length = strlen(line);
    while (length && (line[length - 1] == ' ' || line[length - 1] == '\r')) line[--length] = '\0';
    if (!length) return SL_OK;
    char *space = strchr(line, ' ');
    words w = {.name = line, .rest = ""};
    if (space) {
        *space = '\0';
        for (space++; *space == ' ';) space++;
        w.rest = space;
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        if (strcmp(commands[i].name, w.name) == 0) return run_command(r, &commands[i], &w);
    return sl_fail_at(r->app->context, r->file, r->line, "no command is called '%s'", w.name);
}

sl_status script_run(app_state *app, const char *path, void (*after)(void *user, app_state *app),
                     void *user) {
    reader r = {.app = app, .file = path, .after = after, .user = user};
    sl_bytes bytes;
    SL_TRY(sl_file_read(app->context, path, &bytes));
    sl_status status = SL_OK;
    for (char *line = bytes.data, *next; line && *line && status == SL_OK; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        r.line++;
        status = run_line(&r, line);
        app_settle(app);
    }
    sl_free(app->context, bytes.data);
    return status;
}
