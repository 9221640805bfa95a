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
    sl_box box;
    double left, right, y;
} column;

static column begin_panel(ui_state *ui, sl_box box) {
    const double gap = fmin(1.1 * ui->text, 0.06 * box_width(box));
    ui_begin_area(ui, box);
    ui_line(ui, box.min.x + 0.5, box.min.y, box.min.x + 0.5, box.max.y, ui->palette.outline);
    const double y = ui_begin_scroll(ui, SCROLL_SIDE, box);
    return (column){box, box.min.x + gap, box.max.x - fmax(gap, ui_bar_width(ui)), y};
}

static void end_panel(ui_state *ui, const column *c) {
    ui_end_scroll(ui, c->box, c->y + 0.8 * ui->text);
    ui_end_area(ui);
}

static double width_of(const column *c) {
    return c->right - c->left;
}

/// Whether the panel has no room for columns beside each other.
static bool is_narrow(const ui_state *ui, const column *c) {
    return width_of(c) < 19 * ui->text;
}

static void heading(ui_state *ui, column *c, const char *text, const char *right) {
    const double more = right ? ui_text_width(ui, 0.9, false, right) + ui->text : 0;
    c->y += 1.9 * ui->text;
    if (right) ui_text_right(ui, c->right, c->y, 0.9, ui->palette.faint, right);
    c->y = ui_lines(ui, c->left, c->y, width_of(c) - more, 1, true, ui->palette.ink, text) -
           0.85 * ui->text;
}

/// A paragraph below what is there.
static void words(ui_state *ui, column *c, double size, sl_colour colour, const char *text) {
    c->y = ui_paragraph(ui, c->left, c->y + ui->text, width_of(c), size, colour, text) - ui->text;
}

static void check_row(app_state *app, column *c, const char *name) {
    size_t count;
    const int number = action_find(name);
    const action_row *action = &action_table(&count)[number];
    const double t = app->ui.text, out = fmin(0.4 * t, c->left - c->box.min.x);
    c->y = ui_check(&app->ui, (sl_box){{c->left - out, c->y}, {c->right + out, c->y + 1.5 * t}},
                    action->label, action->key, action->on(app), number);
}

/// A button from x on, or on the next line where it has no room. Returns where the next one begins.
static double place_button(ui_state *ui, column *c, double x, const char *label, bool on,
                           int action) {
    const double t = ui->text;
    if (x > c->left && x + ui_button_width(ui, label) > c->right) {
        x = c->left;
        c->y += 2 * t;
    }
    return ui_button(ui, x, c->y + 0.4 * t, 1.6 * t, label, on, action) + 0.4 * t;
}

/// Draws the buttons of actions, on as many lines as they need; the names end with NULL.
static void button_row(app_state *app, column *c, const char *const *names) {
    size_t count;
    const action_row *actions = action_table(&count);
    double x = c->left;
    for (; *names; names++) {
        const action_row *a = &actions[action_find(*names)];
        x = place_button(&app->ui, c, x, a->label, a->on && a->on(app), (int)(a - actions));
    }
    c->y += 2 * app->ui.text;
}

/// What the plan shows, and how.
static void draw_legend(app_state *app, column *c) {
    legend_row rows[LEGEND_MOST];
    char text[96];
    const int count = layers_legend(app, rows);
    if (!count) return;
    heading(&app->ui, c, "Legend", NULL);
    for (int i = 0; i < count; i++)
        c->y = layers_legend_row(&app->ui, c->left, c->right, c->y, &rows[i]);
    c->y = layers_key_column(app, c->left, c->right, c->y);
    if (layer_nodes_words(app, text)) words(&app->ui, c, 0.9, app->ui.palette.faint, text);
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
        sliders[i].text(app, text);
        // A narrow panel has the track below the words.
        const bool beside = !is_narrow(ui, c);
        const double value = fmax(ui_text_width(ui, 1, false, text), beside ? 3.2 * t : 0) + t;
        ui_text_right(ui, c->right, c->y + 1.16 * t, 1, ui->palette.ink, text);
        const double label = beside ? 6.4 * t : width_of(c) - value;
        const double below = ui_lines(ui, c->left, c->y + 1.16 * t, label, 1, false,
                                      ui->palette.ink, sliders[i].label);
        sl_box track = {{c->left + 6.4 * t, c->y}, {c->right - value, c->y + 1.6 * t}};
        if (!beside)
            track = (sl_box){{c->left + 0.5 * t, below - 1.1 * t},
                             {c->right - 0.5 * t, below + 0.5 * t}};
        ui_slider(ui, track, sliders[i].share(app), HIT_SLIDER, (int)i);
        c->y = fmax(track.max.y, below - 1.1 * t) + 0.1 * t;
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

/// The right ends of the columns of numbers, in shares of the width.
static double column_end(const column *c, int number) {
    static const double ends[] = {12.3, 16.3, 19.1, 22};
    return c->left + width_of(c) * ends[number] / 22;
}

/// Columns of numbers take shares of the width; in a narrow panel they are smaller.
static double figure_size(const ui_state *ui, const column *c) {
    return 0.95 * fmin(1, width_of(c) / 22 / (0.9 * ui->text));
}

typedef struct method_row {
    const char *name;
    tone which;
    bool known, counts_cells, chosen, other;
    bool keeps; ///< the cell under the pointer
    uint32_t cells;
    double area, seconds;
    uint64_t tests;
} method_row;

/// The numbers of a row, in columns or, in a narrow panel, as words below the name.
static void draw_figures(app_state *app, column *c, const method_row *row, double base,
                         bool narrow) {
    ui_state *ui = &app->ui;
    char area[SL_COUNT_TEXT], time[32];
    sl_text_percent(app->document.area > 0 ? row->area / app->document.area : 0, area);
    write_seconds(app, row->seconds, time);
    if (narrow) {
        char cells[SL_COUNT_TEXT] = "", tests[SL_COUNT_TEXT], line[256];
        if (row->counts_cells) sl_text_count(row->cells, "cell", cells);
        sl_text_count(row->tests, "test", tests);
        snprintf(line, sizeof line, "%s%s%s, %s%s%s", cells, *cells ? ", " : "", area, tests,
                 app->steady ? "" : ", ", app->steady ? "" : time);
        c->y = ui_lines(ui, c->left + 1.3 * ui->text, base + 1.35 * ui->text,
                        width_of(c) - 1.3 * ui->text, 0.9, false, ui->palette.ink, line) -
               0.8 * ui->text;
        return;
    }
    const double size = figure_size(ui, c);
    if (row->counts_cells) cells_text(column_end(c, 0), ui, base, size, row->cells);
    ui_text_right(ui, column_end(c, 1), base, size, ui->palette.ink, area);
    cells_text(column_end(c, 2), ui, base, size, row->tests);
    ui_text_right(ui, column_end(c, 3), base, size, ui->palette.faint, time);
}

static double method_height(const ui_state *ui, bool narrow) {
    return (narrow ? 2.8 : 1.55) * ui->text;
}

static void draw_method(app_state *app, column *c, const method_row *row, int number) {
    ui_state *ui = &app->ui;
    const bool narrow = is_narrow(ui, c);
    const double t = ui->text, base = c->y + 1.12 * t, out = fmin(0.4 * t, c->left - c->box.min.x);
    const sl_box box = {{c->left - out, c->y},
                        {c->right + out, c->y + method_height(ui, narrow && row->known)}};
    if (row->chosen || row->other || (number >= 0 && box_has(box, ui->pointer)))
        ui_fill_round(ui, box, 0.25 * t,
                      sl_colour_mix(ui->palette.page,
                                    row->chosen ? ui->palette.glass : ui->palette.ink,
                                    row->chosen ? 0.2 : 0.08));
    const sl_box swatch = {{c->left, c->y + 0.25 * t}, {c->left + 1.05 * t, c->y + 1.3 * t}};
    layers_swatch(ui, swatch, &(legend_row){.mark = LEGEND_AREA, .which = row->which});
    if (row->keeps) ui_outline(ui, swatch, 0.18 * t, ui->palette.ink);
    char name[64];
    snprintf(name, sizeof name, "%s", row->name);
    for (char *at = name; *at; at++)
        if (*at == '_') *at = ' ';
    const double room = narrow ? width_of(c) - 1.3 * t
                               : column_end(c, 0) - c->left - (1.3 + 2.2 * figure_size(ui, c)) * t;
    ui_text_within(ui, c->left + 1.3 * t, base, room, 0.95, ui->palette.ink, name);
    if (number >= 0) ui_hit_focus(ui, HIT_METHOD, number, box);
    c->y = box.max.y;
    if (row->known) draw_figures(app, c, row, base, narrow);
    c->y = fmax(c->y, box.max.y);
}

static void draw_method_titles(ui_state *ui, column *c) {
    static const char *const titles[] = {"cells", "area", "tests", "time"};
    heading(ui, c, "What is kept", NULL);
    if (is_narrow(ui, c)) return;
    const double size = 0.9 * figure_size(ui, c);
    for (int i = 0; i < 4; i++)
        ui_text_right(ui, column_end(c, i), c->y - 0.55 * ui->text, size, ui->palette.faint,
                      titles[i]);
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
    const seen_state *seen = &app->view.seen;
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const uint32_t cell = cell_under_pointer(app);
    draw_method_titles(ui, c);
    for (size_t i = 0; i < count && i < SEEN_MOST; i++) {
        const seen_method *m = &seen->methods[i];
        const method_row row = {.name = methods[i].name,
                                .which = layers_method_tone(i, app->view.method),
                                .known = seen->valid && m->known,
                                .counts_cells = true,
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
    const method_row region = {.name = "visible region",
                               .which = TONE_REGION,
                               .known = seen->valid,
                               .area = seen->region_area,
                               .seconds = seen->region_seconds,
                               .tests = seen->region.portals_passed};
    draw_method(app, c, &region, -1);
    char line[160];
    const bool told = seen->valid && seen->methods[app->view.method].known;
    if (told && !app->view.compare && seen->region_area > 0) {
        snprintf(line, sizeof line, "The cells kept have %.1f times the area that is visible.",
                 seen->methods[app->view.method].area / seen->region_area);
        words(ui, c, 0.9, ui->palette.faint, line);
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
    if (seen->depth < app->document.mirror_depth)
        snprintf(text + length, sizeof text - (size_t)length,
                 " Parts to %u reflection%s: more take too long.", seen->depth,
                 seen->depth == 1 ? "" : "s");
    words(&app->ui, c, 0.9, app->ui.palette.ink, text);
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
    words(&app->ui, c, 0.95, app->ui.palette.ink, text);
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
    words(&app->ui, c, 0.95, app->ui.palette.ink, text);
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
    draw_legend(app, &c);
    c.y += 0.3 * app->ui.text;
    draw_sliders(app, &c);
    static const char *const views[] = {"views_merge", "views_split", "views_largest", NULL};
    if (app->view.show & SHOW_VIEWS && view_layer_shown(app->view.views))
        button_row(app, &c, views);
    static const char *const heat[] = {"heat_back", "heat_next", "heat_steps", "heat_hold", NULL};
    if (layers_shows(app, LAYER_HEAT)) button_row(app, &c, heat);
    draw_methods(app, &c);
    draw_mirrored(app, &c);
    draw_difference(app, &c);
    draw_words(app, &c);
    static const char *const rows[][5] = {{"home", "fly", "method", "other", NULL},
                                          {"record", "play", "export_series", NULL},
                                          {"save_svg", "save_pdf", "doors", NULL}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) button_row(app, &c, rows[i]);
    end_panel(&app->ui, &c);
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
        const double x = c->left + fmin(0.45 * t * (double)indent, 0.4 * width_of(c));
        const double out = fmin(0.4 * t, c->left - c->box.min.x);
        const double high =
            fmax(ui_lines_height(ui, c->right - x, 0.95, i == lit, line + indent), t) + 0.15 * t;
        if (i == lit)
            ui_fill_round(ui, (sl_box){{c->left - out, c->y}, {c->right + out, c->y + high}},
                          0.25 * t, sl_colour_mix(ui->palette.page, ui->palette.source, 0.55));
        ui_lines(ui, x, c->y + 1.08 * t, c->right - x, 0.95, i == lit,
                 i == lit ? ui->palette.ink : ui->palette.faint, line + indent);
        c->y += high;
    }
}

/// The subjects to choose from: those that the map allows.
static void draw_subjects(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    const double t = ui->text, out = fmin(0.4 * t, c->left - c->box.min.x);
    size_t count;
    const subject_row *const *subjects = subject_table(&count);
    heading(ui, c, "Lessons", "U");
    for (size_t i = 0; i < count; i++) {
        if (!lesson_fits(i, &app->document)) continue;
        const bool on = i == app->tool.lesson.subject;
        const double high = ui_lines_height(ui, width_of(c), 1, on, subjects[i]->title) + 0.1 * t;
        const sl_box row = {{c->left - out, c->y}, {c->right + out, c->y + high}};
        if (on || box_has(row, ui->pointer))
            ui_fill_round(ui, row, 0.25 * t,
                          sl_colour_mix(ui->palette.page, ui->palette.glass, on ? 0.22 : 0.1));
        ui_lines(ui, c->left, c->y + 1.08 * t, width_of(c), 1, on, ui->palette.ink,
                 subjects[i]->title);
        ui_hit_focus(ui, HIT_SUBJECT, (int)i, row);
        c->y = row.max.y;
    }
}

/// Buttons to the next step of a kind, named by the subject, and the speed.
static void draw_steps(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    const lesson_state *lesson = &app->tool.lesson;
    const subject_row *subject = lesson_subject(lesson);
    char text[64];
    double x = c->left;
    if (lesson->finds) {
        snprintf(text, sizeof text, "\xe2\x97\x80 %s", subject->found ? subject->found : "");
        x = place_button(ui, c, x, text, false, action_find("found_back"));
        snprintf(text, sizeof text, "%s \xe2\x96\xb6", subject->found ? subject->found : "");
        x = place_button(ui, c, x, text, false, action_find("found_next"));
    }
    if (lesson->rejects) {
        snprintf(text, sizeof text, "%s \xe2\x96\xb6", subject->rejected ? subject->rejected : "");
        place_button(ui, c, x, text, false, action_find("rejected_next"));
    }
    if (lesson->finds || lesson->rejects) c->y += 2 * ui->text;
    static const char *const speed[] = {"slower", "faster", NULL};
    button_row(app, c, speed);
    snprintf(text, sizeof text, "%g steps a second", ldexp(2, lesson->speed));
    words(ui, c, 0.95, ui->palette.faint, text);
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
    if (!lesson_shows(lesson, &app->document)) return;
    if (subject->account) {
        subject->account(lesson, text);
        heading(&app->ui, c, "So far", NULL);
        words(&app->ui, c, 1, app->ui.palette.ink, text);
    }
    if (!lesson->end_count) return;
    const double margin =
        sl_dual_margin(&lesson->dual, lesson->ends, lesson->end_count, lesson->line);
    heading(&app->ui, c, "The line", lesson->dragged ? "ends were dragged" : NULL);
    snprintf(text, sizeof text, "Its margin is %.3g, the best is %.3g.",
             margin * lesson->dual.scale, lesson->dual.margin * lesson->dual.scale);
    words(&app->ui, c, 0.95, app->ui.palette.ink, text);
    write_conflict(app, text, sizeof text);
    if (*text) words(&app->ui, c, 0.95, app->ui.palette.start, text);
    words(&app->ui, c, 0.95, app->ui.palette.faint,
          "Drag it or portal ends, or choose by . and move by arrows.");
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
    draw_legend(app, &c);
    draw_words(app, &c);
    end_panel(&app->ui, &c);
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
    draw_legend(app, &c);
    draw_methods(app, &c);
    draw_words(app, &c);
    end_panel(&app->ui, &c);
}

// --- the quiz

static void draw_question(app_state *app, column *c) {
    ui_state *ui = &app->ui;
    const quiz_state *q = &app->tool.quiz;
    static const char *const answers[] = {"answer_yes", "answer_no", NULL};
    static const char *const next[] = {"next_question", "why_step", NULL};
    char text[1024];
    quiz_question(app, text, sizeof text);
    words(ui, c, 1.15, ui->palette.ink, text);
    if (!q->answered) {
        button_row(app, c, answers);
        return;
    }
    quiz_words(app, text, sizeof text);
    words(ui, c, 1, ui->palette.ink, text);
    button_row(app, c, next);
}

void pane_quiz(app_state *app, sl_box box) {
    column c = begin_panel(&app->ui, box);
    const quiz_state *q = &app->tool.quiz;
    char text[96];
    snprintf(text, sizeof text, "%u of %u right", q->right_count, q->asked_count);
    heading(&app->ui, &c, "Seen or not?", q->asked_count ? text : NULL);
    if (q->asked)
        draw_question(app, &c);
    else {
        quiz_question(app, text, sizeof text);
        words(&app->ui, &c, 0.95, app->ui.palette.ink, text);
    }
    end_panel(&app->ui, &c);
}
