/// The panel at the right: layers, what each method keeps, what the pointer is over. Other modes
/// show pseudo-code, the question, or walls there. And lines as points: the dual plane of the
/// portal sequence of the lesson.
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

static void draw_methods(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const double unit = (c->right - c->left) / 22, t = ui->text, size = figure_size(ui, unit);
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

void pane_side(app_state *app, sl_box box) {
    column c = begin_panel(&app->ui, box);
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

static void draw_account(app_state *app, column *c) {
    const lesson_state *lesson = &app->tool.lesson;
    const subject_row *subject = lesson_subject(lesson);
    char text[SENTENCE];
    if (!lesson_shows(lesson, &app->document)) return;
    if (subject->account) {
        subject->account(lesson, text);
        heading(&app->ui, c, "So far", NULL);
        c->y = ui_paragraph(&app->ui, c->left, c->y + 0.7 * app->ui.text, c->right - c->left, 1,
                            app->ui.palette.ink, text) -
               0.9 * app->ui.text;
    }
    if (!lesson->end_count) return;
    heading(&app->ui, c, "The line", lesson->dragged ? "ends were dragged" : NULL);
    const double margin =
        sl_dual_margin(&lesson->dual, lesson->ends, lesson->end_count, lesson->line);
    snprintf(text, sizeof text,
             "Its margin is %.3g, the best is %.3g. %s Drag it in the plan or as a point in the "
             "dual plane; drag portal ends too.",
             margin * lesson->dual.scale, lesson->dual.margin * lesson->dual.scale,
             lesson->dual.corner_count ? "" : "No line is left.");
    c->y = ui_paragraph(&app->ui, c->left, c->y + 0.7 * app->ui.text, c->right - c->left, 0.95,
                        app->ui.palette.ink, text) -
           0.9 * app->ui.text;
}

void pane_learn(app_state *app, sl_box box) {
    column c = begin_panel(&app->ui, box);
    heading(&app->ui, &c, lesson_subject(&app->tool.lesson)->title, NULL);
    draw_code(app, &c);
    static const char *const other[] = {"subject", NULL};
    button_row(app, &c, other);
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
    rule(&app->ui, &c, "Drag a wall, a corner or a door: moves it. Esc takes that back.");
    rule(&app->ui, &c, "Click a wall: chooses it. Delete: deletes it.");
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
    char text[512];
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
    ui_button(ui, x, c.y, 2 * t, "Next (Space)", false, action_find("next_question"));
}

// --- the dual plane

static sl_dual_frame frame_of(const app_state *app, sl_box box) {
    const double t = ui_text_size(&app->ui);
    return sl_dual_frame_fit(&app->tool.lesson.before, box.min.x + 0.9 * t, box.min.y + 2.2 * t,
                             fmax(box_width(box) - 1.8 * t, 8), fmax(box_height(box) - 4.1 * t, 8),
                             ui_scale(&app->ui));
}

void pane_dual(app_state *app, sl_box box) {
    ui_state *ui = &app->ui;
    const double t = ui->text;
    const lesson_state *lesson = &app->tool.lesson;
    ui_fill(ui, box, ui->palette.page);
    ui_line(ui, box.min.x, box.min.y + 0.5, box.max.x, box.min.y + 0.5, ui->palette.outline);
    ui_hit(ui, HIT_PANEL, 0, box);
    const double x = ui_text(ui, box.min.x + 0.9 * t, box.min.y + 1.5 * t, 1, true, ui->palette.ink,
                             "Lines as points");
    char text[160];
    if (lesson->end_count)
        snprintf(text, sizeof text, "%u half-planes: %s", 2 * lesson->end_count,
                 lesson->dual.corner_count ? "what all leave is green" : "nothing is left");
    else
        snprintf(text, sizeof text, "no portal is crossed yet: every line counts");
    ui_text(ui, box.min.x + 1.7 * t + x, box.min.y + 1.5 * t, 0.95, false, ui->palette.faint, text);
    if (!lesson->end_count) return;
    const sl_dual_frame frame = frame_of(app, box);
    sl_draw_dual(ui->cairo, &ui->palette, &frame, &lesson->dual, lesson->ends, lesson->end_count,
                 lesson->line);
    const double base = frame.top + frame.height + 1.2 * t;
    sl_text_show_within(
        ui->cairo, ui->palette.faint, frame.left, base, frame.width, 0.85 * t, false,
        "slope \xe2\x86\x92   height \xe2\x86\x91   blue: left ends, from above   orange: "
        "right ends, from below   bar: the best line and its margin");
    ui_hit(ui, HIT_DUAL, 0,
           (sl_box){{frame.left, frame.top}, {frame.left + frame.width, frame.top + frame.height}});
}

void pane_dual_drag(app_state *app, sl_box box, sl_point to) {
    if (!app->tool.lesson.end_count) return;
    const sl_dual_frame frame = frame_of(app, box);
    const sl_dual_line line = sl_dual_frame_line(&frame, to);
    app->tool.lesson.line.slope = fmin(fmax(line.slope, -SL_DUAL_SLOPE), SL_DUAL_SLOPE);
    app->tool.lesson.line.height = fmin(fmax(line.height, -SL_DUAL_HEIGHT), SL_DUAL_HEIGHT);
}

/// Near an end of the shown line it turns about the other end; between the ends it is shifted.
void pane_plan_drag_line(app_state *app, sl_point from, sl_point to) {
    lesson_state *lesson = &app->tool.lesson;
    if (!lesson->end_count) return;
    const sl_point a = sl_dual_point(&lesson->dual, from), b = sl_dual_point(&lesson->dual, to);
    sl_dual_line *line = &lesson->line;
    const double pivot = a.x > 0.35 ? -1 : a.x < -0.35 ? 1 : 0;
    if (pivot == 0) {
        line->height += (b.y - line->slope * b.x) - line->height;
    } else if (fabs(b.x - pivot) > 0.05) {
        const double at = line->slope * pivot + line->height;
        const double slope = (b.y - at) / (b.x - pivot);
        line->slope = fmin(fmax(slope, -SL_DUAL_SLOPE), SL_DUAL_SLOPE);
        line->height = at - line->slope * pivot;
    }
    line->height = fmin(fmax(line->height, -SL_DUAL_HEIGHT), SL_DUAL_HEIGHT);
}
