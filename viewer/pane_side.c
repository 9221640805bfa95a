/// The panel at the right: layers, what each method keeps, what the pointer is over, and why a cell
/// is seen or not. Other modes show pseudo-code, the question, or walls there.
#include "actions.h"
#include "effects.h"
#include "modes.h"
#include "quiz.h"
#include "sightline/canvas.h"
#include "sliders.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- the panel

typedef struct column {
    double left, right, y, bottom;
} column;

static column begin_panel(ui_state *ui, sl_box box) {
    ui_fill(ui, box, ui->palette.page);
    ui_line(ui, box.min.x + 0.5, box.min.y, box.min.x + 0.5, box.max.y, ui->palette.outline);
    ui_hit(ui, HIT_PANEL, 0, box);
    return (column){box.min.x + 1.1 * ui->text, box.max.x - 1.1 * ui->text, box.min.y, box.max.y};
}

static void heading(ui_state *ui, column *c, const char *text, const char *right) {
    c->y += 1.9 * ui->text;
    ui_text(ui, c->left, c->y, 1, true, ui->palette.ink, text);
    if (right) ui_text_right(ui, c->right, c->y, 0.9, ui->palette.faint, right);
    c->y += 0.55 * ui->text;
}

static void check_row(app_state *app, column *c, const char *name) {
    size_t count;
    const int number = action_find(name);
    const action_row *action = &action_table(&count)[number];
    const double height = 1.5 * app->ui.text;
    ui_check(&app->ui,
             (sl_box){{c->left - 0.4 * app->ui.text, c->y},
                      {c->right + 0.4 * app->ui.text, c->y + height}},
             action->label, action->key, action->on(app), number);
    c->y += height;
}

/// Draws the buttons of actions that have room; the names end with NULL.
static void button_row(app_state *app, column *c, const char *const *names) {
    size_t count;
    const action_row *actions = action_table(&count);
    const double t = app->ui.text;
    double x = c->left;
    if (c->y + 2 * t > c->bottom) return;
    for (; *names; names++) {
        const action_row *a = &actions[action_find(*names)];
        if (x + ui_text_width(&app->ui, 0.95, false, a->label) + 1.3 * t > c->right) break;
        x = ui_button(&app->ui, x, c->y + 0.4 * t, 1.6 * t, a->label, a->on && a->on(app),
                      (int)(a - actions)) +
            0.4 * t;
    }
    c->y += 2 * t;
}

/// What the colour of solid ground means.
static void ground_row(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    if (!app->document.baked || !app->document.solid) return;
    c->y += 0.3 * t;
    ui_fill_round(ui, (sl_box){{c->left, c->y + 0.25 * t}, {c->left + 2.2 * t, c->y + 1.25 * t}},
                  0.15 * t, ui->palette.solid);
    ui_text(ui, c->left + 2.8 * t, c->y + 1.1 * t, 1, false, ui->palette.ink, "Solid ground");
    c->y += 1.5 * t;
}

/// The layers that belong to the present mode.
static void layer_rows(app_state *app, column *c) {
    heading(&app->ui, c, "Layers", "key");
    for (unsigned i = 0; i < LAYER_COUNT; i++)
        if (layers_lists(app, i)) check_row(app, c, layer_table()[i].name);
}

static void draw_sliders(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    size_t count;
    const slider_row *sliders = slider_table(&count);
    for (size_t i = 0; i < count; i++) {
        if (!sliders[i].shown(app)) continue;
        char text[SLIDER_TEXT];
        const double middle = c->y + 0.8 * t;
        sliders[i].text(app, text);
        ui_text(ui, c->left, middle + 0.36 * t, 1, false, ui->palette.ink, sliders[i].label);
        ui_text_right(ui, c->right, middle + 0.36 * t, 1, ui->palette.ink, text);
        ui_slider(ui, (sl_box){{c->left + 6.4 * t, c->y}, {c->right - 4.2 * t, c->y + 1.6 * t}},
                  sliders[i].share(app), HIT_SLIDER, (int)i);
        c->y += 1.7 * t;
    }
}

// --- methods

static void write_seconds(const app_state *app, double seconds, char text[32]) {
    if (app->steady)
        snprintf(text, 32, "\xe2\x80\x93");
    else if (seconds < 1e-3)
        snprintf(text, 32, "%.0f \xc2\xb5s", 1e6 * seconds);
    else
        snprintf(text, 32, "%.1f ms", 1e3 * seconds);
}

static void cells_text(double x, ui_state *ui, double y, double size, uint64_t count) {
    char text[SL_COUNT_TEXT];
    sl_text_count(count, "", text);
    ui_text_right(ui, x, y, size, ui->palette.ink, text);
}

/// Columns of numbers take shares of the width; in a narrow panel they are smaller.
static double figure_size(const ui_state *ui, double unit) {
    return 0.95 * fmin(1, unit / (0.9 * ui->text));
}

typedef struct method_row {
    const char *name;
    sl_colour colour;
    bool known, chosen, other;
    bool keeps; ///< the cell under the pointer
    uint32_t cells;
    double area, seconds;
    uint64_t tests;
} method_row;

static void draw_method(app_state *app, column *c, const method_row *row, int number) {
    ui_state *ui = &app->ui;
    const double t = ui->text, height = 1.55 * t, base = c->y + 1.12 * t;
    const sl_box box = {{c->left - 0.4 * t, c->y}, {c->right + 0.4 * t, c->y + height}};
    if (row->chosen || row->other || box_has(box, ui->pointer))
        ui_fill_round(ui, box, 0.25 * t,
                      sl_colour_mix(ui->palette.page,
                                    row->chosen ? ui->palette.glass : ui->palette.ink,
                                    row->chosen ? 0.2 : 0.08));
    ui_fill_round(ui, (sl_box){{c->left, c->y + 0.35 * t}, {c->left + 0.9 * t, c->y + 1.25 * t}},
                  0.15 * t, row->colour);
    if (row->keeps) {
        cairo_rectangle(ui->cairo, c->left, c->y + 0.35 * t, 0.9 * t, 0.9 * t);
        sl_set_colour(ui->cairo, ui->palette.ink);
        cairo_set_line_width(ui->cairo, 0.18 * t);
        cairo_stroke(ui->cairo);
    }
    char words[64], text[SL_COUNT_TEXT];
    snprintf(words, sizeof words, "%s", row->name);
    for (char *at = words; *at; at++)
        if (*at == '_') *at = ' ';
    const double unit = (c->right - c->left) / 22, size = figure_size(ui, unit);
    const double room = fmin(9.4 * t, 12.3 * unit - (1.3 + 2.2 * size) * t);
    sl_text_show_within(ui->cairo, ui->palette.ink, c->left + 1.3 * t, base, room, 0.95 * t, false,
                        words);
    if (row->known) {
        cells_text(c->left + 12.3 * unit, ui, base, size, row->cells);
        sl_text_percent(app->document.area > 0 ? row->area / app->document.area : 0, text);
        ui_text_right(ui, c->left + 16.3 * unit, base, size, ui->palette.ink, text);
        cells_text(c->left + 18.9 * unit, ui, base, size, row->tests);
        write_seconds(app, row->seconds, text);
        ui_text_right(ui, c->right, base, size, ui->palette.faint, text);
    }
    if (number >= 0) ui_hit(ui, HIT_METHOD, number, box);
    c->y += height;
}

/// The cell of the plan under the pointer; SL_NO_CELL for none.
static uint32_t cell_under_pointer(const app_state *app) {
    const sl_box plan = app_layout(app).plan[0];
    if (!app->document.baked || app->ui.over.kind != HIT_PLAN) return SL_NO_CELL;
    return sl_space_locate(&app->document.baked->space,
                           camera_point(&app->view.camera, plan, app->tool.pointer));
}

static void draw_methods(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const double unit = (c->right - c->left) / 22, t = ui->text, size = figure_size(ui, unit);
    const uint32_t cell = cell_under_pointer(app);
    heading(&app->ui, c, "What is kept", NULL);
    c->y -= 0.55 * t;
    ui_text_right(ui, c->left + 12.3 * unit, c->y, 0.9 * size, ui->palette.faint, "cells");
    ui_text_right(ui, c->left + 16.3 * unit, c->y, 0.9 * size, ui->palette.faint, "area");
    ui_text_right(ui, c->left + 18.9 * unit, c->y, 0.9 * size, ui->palette.faint, "tests");
    ui_text_right(ui, c->right, c->y, 0.9 * size, ui->palette.faint, "time");
    c->y += 0.4 * t;
    for (size_t i = 0; i < count && i < SEEN_MOST; i++) {
        const seen_method *m = &app->view.seen.methods[i];
        const method_row row = {.name = methods[i].name,
                                .colour = pane_method_colour(&app->ui, i),
                                .known = app->view.seen.valid && m->known,
                                .chosen = i == app->view.method,
                                .other = app->view.compare && i == app->view.other,
                                .keeps = app->view.seen.valid && m->known && cell != SL_NO_CELL &&
                                         sl_eye_sees(m->cells, cell),
                                .cells = m->count,
                                .area = m->area,
                                .seconds = m->seconds,
                                .tests = m->account.orientations};
        draw_method(app, c, &row, (int)i);
    }
    char text[SL_COUNT_TEXT], line[160];
    const double base = c->y + 1.12 * t;
    ui_fill_round(ui, (sl_box){{c->left, c->y + 0.35 * t}, {c->left + 0.9 * t, c->y + 1.25 * t}},
                  0.15 * t, ui->palette.source);
    ui_text(ui, c->left + 1.3 * t, base, 0.95, false, ui->palette.ink, "visible region");
    sl_text_percent(app->document.area > 0 && app->view.seen.valid
                        ? app->view.seen.region_area / app->document.area
                        : 0,
                    text);
    ui_text_right(ui, c->left + 16.3 * unit, base, size, ui->palette.ink, text);
    cells_text(c->left + 18.9 * unit, ui, base, size,
               app->view.seen.valid ? app->view.seen.region.portals_passed : 0);
    write_seconds(app, app->view.seen.region_seconds, text);
    ui_text_right(ui, c->right, base, size, ui->palette.faint, text);
    c->y += 1.6 * t;
    const bool told = app->view.seen.valid && app->view.seen.methods[app->view.method].known;
    if (told && !app->view.compare && app->view.seen.region_area > 0) {
        snprintf(line, sizeof line, "The cells kept have %.1f times the area that is visible.",
                 app->view.seen.methods[app->view.method].area / app->view.seen.region_area);
        c->y =
            ui_paragraph(ui, c->left, c->y + t, c->right - c->left, 0.9, ui->palette.faint, line) -
            t;
    }
}

/// What mirrors add.
static void draw_mirrored(app_state *app, column *c) {
    const seen_state *seen = &app->view.seen;
    const uint32_t cells = seen->methods[app->view.method].mirrored_count;
    char share[SL_COUNT_TEXT], text[160];
    if (!app->document.map.mirror_count || !seen->valid) return;
    sl_text_percent(app->document.area > 0 ? seen->mirrored_area / app->document.area : 0, share);
    const size_t parts = seen->in_mirrors.part_count;
    const int length =
        snprintf(text, sizeof text, "In mirrors: %u cell%s more, and %s of the area in %zu part%s.",
                 cells, cells == 1 ? "" : "s", share, parts, parts == 1 ? "" : "s");
    if (app->document.map.oneway_count)
        snprintf(text + length, sizeof text - (size_t)length, " Parts are not told past glass.");
    else if (seen->depth < app->document.mirror_depth)
        snprintf(text + length, sizeof text - (size_t)length,
                 " Parts to %u reflection%s: more take too long.", seen->depth,
                 seen->depth == 1 ? "" : "s");
    const double t = app->ui.text;
    c->y = ui_paragraph(&app->ui, c->left, c->y + t, c->right - c->left, 0.9, app->ui.palette.ink,
                        text) -
           t;
}

/// What the looser of the two methods compared adds.
static void draw_difference(app_state *app, column *c) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const size_t loose = app->view.other < app->view.method ? app->view.other : app->view.method;
    const size_t tight = app->view.other < app->view.method ? app->view.method : app->view.other;
    const seen_method *more = &app->view.seen.methods[loose],
                      *less = &app->view.seen.methods[tight];
    if (!app->view.compare || loose == tight || !app->view.seen.valid || !more->known ||
        !less->known)
        return;
    char share[SL_COUNT_TEXT], text[256], cost[80] = "";
    sl_text_percent(app->document.area > 0 ? (more->area - less->area) / app->document.area : 0,
                    share);
    if (!app->steady && more->seconds > 0)
        snprintf(cost, sizeof cost, ", which takes %.2g times as long",
                 less->seconds / more->seconds);
    snprintf(text, sizeof text, "%s adds %u cells, %s of the area, to %s%s.", methods[loose].name,
             more->count - less->count, share, methods[tight].name, cost);
    for (char *at = text; *at; at++)
        if (*at == '_') *at = ' ';
    const double t = app->ui.text;
    c->y = ui_paragraph(&app->ui, c->left, c->y + t, c->right - c->left, 0.95, app->ui.palette.ink,
                        text) -
           t;
}

// --- words

/// Writes an area beyond four digits without a power of ten.
static void write_area(double area, char text[SL_COUNT_TEXT]) {
    if (area >= 1e4 && area < 1e15)
        sl_text_count((uint64_t)llround(area), "", text);
    else
        snprintf(text, SL_COUNT_TEXT, "%.4g", area);
}

void pane_describe(const app_state *app, sl_point at, char *text, size_t room) {
    text[0] = '\0';
    if (!app->document.baked) return;
    const sl_space *space = &app->document.baked->space;
    const uint32_t cell = sl_space_locate(space, at);
    if (cell == SL_NO_CELL) {
        snprintf(text, room, "%.6g, %.6g: outside the map", at.x, at.y);
        return;
    }
    const sl_cell *c = &space->cells[cell];
    if (c->solid) {
        snprintf(text, room, "Solid ground at %.4g, %.4g: nobody looks from there.", at.x, at.y);
        return;
    }
    const size_t word = cell / 64, bit = cell % 64;
    const bool counts = sl_baked_counts(app->document.baked, cell);
    char area[SL_COUNT_TEXT];
    write_area(app->document.areas[cell], area);
    int length = snprintf(text, room, "Cell %u at %.4g, %.4g: %u portal%s, area %s%s.", cell, at.x,
                          at.y, c->directed_count, c->directed_count == 1 ? "" : "s", area,
                          counts ? "" : ", not inside");
    if (!app->view.seen.valid || !app->view.seen.pvs || length < 0 || (size_t)length >= room)
        return;
    size_t count;
    sl_eye_methods(&count);
    const bool seen = count && app->view.seen.methods[count - 1].known &&
                      app->view.seen.methods[count - 1].cells[word] >> bit & 1;
    const bool pvs = app->view.seen.pvs[word] >> bit & 1;
    const bool mirrored = app->view.seen.mirrored[word] >> bit & 1;
    snprintf(text + length, room - (size_t)length, " %s",
             cell == app->view.seen.cell ? "The eye stands in it."
             : seen                      ? "The eye sees it."
             : pvs                       ? "The eye's cell sees it, the eye does not."
             : mirrored                  ? "The eye's cell sees it by mirror."
                                         : "It is not seen from the eye's cell.");
    const bool both = sl_plan_make(&app->document.map).mutual || app->view.seen.cell == SL_NO_CELL;
    const size_t used = strlen(text);
    if (!both && cell != app->view.seen.cell)
        snprintf(text + used, room - used, " It %s the eye's cell.",
                 present_sees(&app->view.present, &app->document, cell, app->view.seen.cell)
                     ? "sees"
                     : "does not see");
}

static void draw_words(app_state *app, column *c) {
    char text[512];
    const window_layout l = app_layout(app);
    sl_point at = app->view.eye.at;
    const bool over = box_has(l.plan[0], app->tool.pointer);
    if (over) at = camera_point(&app->view.camera, l.plan[0], app->tool.pointer);
    const bool explores = over && app->tool.mode == MODE_EXPLORE;
    const uint32_t object = explores ? object_at(app, at) : UINT32_MAX;
    const uint32_t door = over ? door_at(app, at) : UINT32_MAX;
    if (door != UINT32_MAX)
        snprintf(text, sizeof text, "Door %s, which is %s: a click %s it.",
                 app->document.map.doors[door].name,
                 app->document.map.doors[door].open ? "open" : "shut",
                 app->document.map.doors[door].open ? "shuts" : "opens");
    else if (object != UINT32_MAX)
        object_describe(app, object, text, sizeof text);
    else
        pane_describe(app, at, text, sizeof text);
    heading(&app->ui, c, over ? "Under the pointer" : "Under the eye", NULL);
    c->y = ui_paragraph(&app->ui, c->left, c->y + 0.7 * app->ui.text, c->right - c->left, 0.95,
                        app->ui.palette.ink, text);
}

/// Why the cell that was asked about is seen or not.
static void draw_why(app_state *app, column *c) {
    const quiz_state *q = &app->tool.quiz;
    char text[1024];
    if (!q->answered) return;
    snprintf(text, sizeof text, "Why cell %u %s cell %u%s", q->from,
             q->explanation.verdict == SL_HIDDEN && !quiz_is_bent(q) ? "does not see" : "sees",
             q->to, quiz_is_bent(q) ? " by mirror" : "");
    heading(&app->ui, c, text, NULL);
    quiz_words(app, text, sizeof text);
    c->y = ui_paragraph(&app->ui, c->left, c->y + 0.7 * app->ui.text, c->right - c->left, 0.95,
                        app->ui.palette.ink, text) -
           0.9 * app->ui.text;
    static const char *const step[] = {"why_step", NULL};
    button_row(app, c, step);
    c->y += 0.4 * app->ui.text;
}

void pane_side(app_state *app, sl_box box) {
    column c = begin_panel(&app->ui, box);
    draw_why(app, &c);
    layer_rows(app, &c);
    check_row(app, &c, "first_person");
    check_row(app, &c, "account");
    ground_row(app, &c);
    c.y += 0.3 * app->ui.text;
    draw_sliders(app, &c);
    static const char *const views[] = {"views_merge", "views_split", "views_largest", NULL};
    if (app->view.show & SHOW_VIEWS && view_layer_shown(app->view.views))
        button_row(app, &c, views);
    draw_methods(app, &c);
    draw_mirrored(app, &c);
    draw_difference(app, &c);
    draw_words(app, &c);
    static const char *const rows[][5] = {{"home", "fly", "method", "other", NULL},
                                          {"record", "play", "export_series", NULL},
                                          {"save_svg", "save_pdf", "doors", NULL}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) button_row(app, &c, rows[i]);
}

// --- learning

static void draw_code(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    size_t count, lit;
    if (!lesson_shows(&app->tool.lesson, &app->document)) return;
    const char *const *code =
        lesson_subject(&app->tool.lesson)->code(&app->tool.lesson, &app->document, &count, &lit);
    const double t = ui->text;
    for (size_t i = 0; i < count; i++) {
        const char *line = code[i];
        const size_t indent = strspn(line, " ");
        const double x = c->left + 0.45 * t * (double)indent;
        if (i == lit)
            ui_fill_round(ui,
                          (sl_box){{c->left - 0.4 * t, c->y}, {c->right + 0.4 * t, c->y + 1.5 * t}},
                          0.25 * t, sl_colour_mix(ui->palette.page, ui->palette.source, 0.55));
        sl_text_show_within(ui->cairo, i == lit ? ui->palette.ink : ui->palette.faint, x,
                            c->y + 1.08 * t, c->right - x, 0.95 * t, i == lit, line + indent);
        c->y += 1.5 * t;
    }
}

/// The subjects to choose from: those that the map allows.
static void draw_subjects(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    size_t count;
    const subject_row *const *subjects = subject_table(&count);
    heading(ui, c, "Lessons", "U");
    for (size_t i = 0; i < count; i++) {
        if (!lesson_fits(i, &app->document)) continue;
        const bool on = i == app->tool.lesson.subject;
        const sl_box row = {{c->left - 0.4 * t, c->y}, {c->right + 0.4 * t, c->y + 1.5 * t}};
        if (on || box_has(row, ui->pointer))
            ui_fill_round(ui, row, 0.25 * t,
                          sl_colour_mix(ui->palette.page, ui->palette.glass, on ? 0.22 : 0.1));
        ui_text(ui, c->left, c->y + 1.08 * t, 1, on, ui->palette.ink, subjects[i]->title);
        ui_hit(ui, HIT_SUBJECT, (int)i, row);
        c->y += 1.5 * t;
    }
}

/// Buttons to the next step of a kind, named by the subject, and the speed.
static void draw_steps(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    const lesson_state *lesson = &app->tool.lesson;
    const subject_row *subject = lesson_subject(lesson);
    const double t = ui->text;
    char text[64];
    double x = c->left;
    c->y += 0.4 * t;
    snprintf(text, sizeof text, "\xe2\x97\x80 %s", subject->found ? subject->found : "");
    if (lesson->finds) x = ui_button(ui, x, c->y, 1.6 * t, text, false, action_find("found_back"));
    snprintf(text, sizeof text, "%s \xe2\x96\xb6", subject->found ? subject->found : "");
    if (lesson->finds)
        x = ui_button(ui, x + 0.4 * t, c->y, 1.6 * t, text, false, action_find("found_next"));
    snprintf(text, sizeof text, "%s \xe2\x96\xb6", subject->rejected ? subject->rejected : "");
    if (lesson->rejects)
        ui_button(ui, x + 0.4 * t, c->y, 1.6 * t, text, false, action_find("rejected_next"));
    if (lesson->finds || lesson->rejects) c->y += 2 * t;
    x = ui_button(ui, c->left, c->y, 1.6 * t, "Slower", false, action_find("slower"));
    x = ui_button(ui, x + 0.4 * t, c->y, 1.6 * t, "Faster", false, action_find("faster"));
    snprintf(text, sizeof text, "%g steps a second", ldexp(2, lesson->speed));
    ui_text(ui, x + 0.7 * t, c->y + 1.12 * t, 0.95, false, ui->palette.faint, text);
    c->y += 1.6 * t;
}

/// "L1 and L4 against R2 and R3".
static void list_ends(const sl_conflict *conflict, char *text, size_t room) {
    size_t used = 0;
    text[0] = '\0';
    for (int side = 0; side < 2; side++) {
        bool first = true;
        for (uint32_t i = 0; i < conflict->end_count && used < room; i++) {
            if (conflict->ends[i].left != (side == 0)) continue;
            used += (size_t)snprintf(text + used, room - used, "%s%c%u",
                                     !first      ? " and "
                                     : side == 1 ? " against "
                                                 : "",
                                     side ? 'R' : 'L', conflict->ends[i].portal + 1);
            first = false;
        }
    }
}

/// What the ends that leave no line are to each other.
static void write_conflict(app_state *app, char *text, size_t room) {
    lesson_state *lesson = &app->tool.lesson;
    char ends[128];
    sl_status status;
    const sl_conflict *conflict = lesson_conflict(app->context, lesson, &status);
    app_check(app, status);
    text[0] = '\0';
    if (conflict->verdict == SL_STABBED || !conflict->end_count) return;
    list_ends(conflict, ends, sizeof ends);
    snprintf(text, room, "%s: %s. They are marked: %s.",
             conflict->verdict == SL_GRAZING ? "The line only grazes"
             : conflict->turns               ? "No line: the portals turn back"
                                             : "No line is left",
             ends, sl_conflict_reason(lesson->ends, conflict));
}

static void draw_account(app_state *app, column *c) {
    lesson_state *lesson = &app->tool.lesson;
    const subject_row *subject = lesson_subject(lesson);
    char text[SENTENCE];
    const double t = app->ui.text, wide = c->right - c->left;
    if (!lesson_shows(lesson, &app->document)) return;
    if (subject->account) {
        subject->account(lesson, text);
        heading(&app->ui, c, "So far", NULL);
        c->y = ui_paragraph(&app->ui, c->left, c->y + 0.7 * t, wide, 1, app->ui.palette.ink, text) -
               0.9 * t;
    }
    if (!lesson->end_count) return;
    const double margin =
        sl_dual_margin(&lesson->dual, lesson->ends, lesson->end_count, lesson->line);
    heading(&app->ui, c, "The line", lesson->dragged ? "ends were dragged" : NULL);
    snprintf(text, sizeof text, "Its margin is %.3g, the best is %.3g.",
             margin * lesson->dual.scale, lesson->dual.margin * lesson->dual.scale);
    c->y = ui_paragraph(&app->ui, c->left, c->y + 0.7 * t, wide, 0.95, app->ui.palette.ink, text);
    write_conflict(app, text, sizeof text);
    if (*text)
        c->y = ui_paragraph(&app->ui, c->left, c->y, wide, 0.95, app->ui.palette.start, text);
    c->y = ui_paragraph(&app->ui, c->left, c->y, wide, 0.95, app->ui.palette.faint,
                        "Drag it or portal ends, or choose by . and move by arrows.") -
           0.9 * t;
    static const char *const change[] = {"undo", "reset_ends", "program", NULL};
    button_row(app, c, change);
}

void pane_learn(app_state *app, sl_box box) {
    column c = begin_panel(&app->ui, box);
    draw_why(app, &c);
    draw_subjects(app, &c);
    c.y += 0.7 * app->ui.text;
    draw_code(app, &c);
    draw_steps(app, &c);
    draw_account(app, &c);
    layer_rows(app, &c);
    check_row(app, &c, "first_person");
    ground_row(app, &c);
    draw_words(app, &c);
}

// --- drawing walls

static void rule(ui_state *ui, column *c, const char *text) {
    c->y = ui_paragraph(ui, c->left, c->y + 0.35 * ui->text, c->right - c->left, 0.95,
                        ui->palette.ink, text);
}

void pane_draw(app_state *app, sl_box box) {
    column c = begin_panel(&app->ui, box);
    char text[160];
    heading(&app->ui, &c, "Walls", NULL);
    c.y += 0.7 * app->ui.text;
    rule(&app->ui, &c, "Drag on free ground: a new wall, in any direction, its ends on the grid.");
    rule(&app->ui, &c, "Drag a wall: moves it. Click: chooses it. Delete: deletes it.");
    snprintf(text, sizeof text, "%zu walls; %zu step%s to undo, %zu to redo.",
             app->document.map.wall_count, app->document.history.done_count,
             app->document.history.done_count == 1 ? "" : "s", app->document.history.undone_count);
    rule(&app->ui, &c, text);
    layer_rows(app, &c);
    ground_row(app, &c);
    draw_methods(app, &c);
    draw_words(app, &c);
}

// --- the quiz

void pane_quiz(app_state *app, sl_box box) {
    column c = begin_panel(&app->ui, box);
    ui_state *ui = &app->ui;
    const quiz_state *q = &app->tool.quiz;
    const double t = ui->text;
    char text[1024];
    snprintf(text, sizeof text, "%u of %u right", q->right_count, q->asked_count);
    heading(&app->ui, &c, "Seen or not?", q->asked_count ? text : NULL);
    if (!q->asked) {
        c.y += 0.7 * t;
        rule(&app->ui, &c, "Space asks about two cells. The visibility must be there first.");
        return;
    }
    snprintf(text, sizeof text, "Can the orange cell %u see the purple cell %u?", q->from, q->to);
    c.y = ui_paragraph(ui, c.left, c.y + t, c.right - c.left, 1.15, ui->palette.ink, text);
    double x = c.left;
    if (!q->answered) {
        x = ui_button(ui, x, c.y, 2 * t, "Yes, seen (Y)", false, action_find("answer_yes"));
        ui_button(ui, x + 0.6 * t, c.y, 2 * t, "No (N)", false, action_find("answer_no"));
        return;
    }
    quiz_words(app, text, sizeof text);
    c.y = ui_paragraph(ui, c.left, c.y + t, c.right - c.left, 1, ui->palette.ink, text) + t;
    x = ui_button(ui, x, c.y, 2 * t, "Next (Space)", false, action_find("next_question"));
    ui_button(ui, x + 0.6 * t, c.y, 2 * t, "Show the step", false, action_find("why_step"));
}
