/// The panel at the right: layers, what each method keeps, what the pointer is over, and why a cell
/// is seen or not. To draw, it shows what can be drawn; in the quiz the question.
#include "lessons/quiz.h"
#include "panes/panel.h"
#include "panes/panes.h"
#include "plan/effects.h"
#include "plan/view_cells.h"
#include "sightline/draw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// --- methods

/// Writes an area beyond four digits without a power of ten.
static void write_area(double area, char text[SL_COUNT_TEXT]) {
    if (area >= 1e4 && area < 1e15)
        sl_text_count((uint64_t)llround(area), "", text);
    else
        snprintf(text, SL_COUNT_TEXT, "%.4g", area);
}

static void write_seconds(const ui_state *ui, double seconds, char text[32]) {
    if (ui->steady)
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
static double figure_end(const column *c, int number) {
    static const double ends[] = {12.3, 16.3, 19.1, 22};
    return c->left + column_width(c) * ends[number] / 22;
}

/// Columns of numbers take shares of the width; in a narrow panel they are smaller.
static double figure_size(const ui_state *ui, const column *c) {
    return 0.95 * fmin(1, column_width(c) / 22 / (0.9 * ui->text));
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
static void draw_figures(view_state *view, column *c, const method_row *row, double base,
                         bool narrow) {
    ui_state *ui = view->ui;
    char area[SL_COUNT_TEXT], time[32];
    sl_text_percent(view->document->area > 0 ? row->area / view->document->area : 0, area);
    write_seconds(view->ui, row->seconds, time);
    if (narrow) {
        char cells[SL_COUNT_TEXT] = "", tests[SL_COUNT_TEXT], line[256];
        if (row->counts_cells) sl_text_count(row->cells, "cell", cells);
        sl_text_count(row->tests, "test", tests);
        snprintf(line, sizeof line, "%s%s%s, %s%s%s", cells, *cells ? ", " : "", area, tests,
                 view->ui->steady ? "" : ", ", view->ui->steady ? "" : time);
        c->y = ui_lines(ui, c->left + 1.3 * ui->text, base + 1.35 * ui->text,
                        column_width(c) - 1.3 * ui->text, 0.9, false, ui->palette.ink, line) -
               0.8 * ui->text;
        return;
    }
    const double size = figure_size(ui, c);
    if (row->counts_cells) cells_text(figure_end(c, 0), ui, base, size, row->cells);
    ui_text_right(ui, figure_end(c, 1), base, size, ui->palette.ink, area);
    cells_text(figure_end(c, 2), ui, base, size, row->tests);
    ui_text_right(ui, figure_end(c, 3), base, size, ui->palette.faint, time);
}

static double method_height(const ui_state *ui, bool narrow) {
    return (narrow ? 2.8 : 1.55) * ui->text;
}

static void draw_method(view_state *view, column *c, const method_row *row, int number) {
    ui_state *ui = view->ui;
    const bool narrow = column_is_narrow(ui, c);
    const double t = ui->text, base = c->y + 1.12 * t, out = fmin(0.4 * t, c->left - c->box.min.x);
    const sl_box box = {{c->left - out, c->y},
                        {c->right + out, c->y + method_height(ui, narrow && row->known)}};
    if (row->chosen || row->other || (number >= 0 && box_has(box, ui->pointer)))
        ui_fill_round(ui, box, 0.25 * t,
                      sl_colour_mix(ui->palette.page,
                                    row->chosen ? ui->palette.glass : ui->palette.ink,
                                    row->chosen ? 0.2 : 0.08));
    const sl_box swatch = {{c->left, c->y + 0.25 * t}, {c->left + 1.05 * t, c->y + 1.3 * t}};
    legend_swatch(ui, swatch, &(legend_row){.mark = LEGEND_AREA, .which = row->which});
    if (row->keeps) ui_outline(ui, swatch, 0.18 * t, ui->palette.ink);
    char name[64];
    snprintf(name, sizeof name, "%s", row->name);
    ui_spaces(name);
    const double room = narrow ? column_width(c) - 1.3 * t
                               : figure_end(c, 0) - c->left - (1.3 + 2.2 * figure_size(ui, c)) * t;
    ui_text_within(ui, c->left + 1.3 * t, base, room, 0.95, ui->palette.ink, name);
    if (number >= 0) ui_hit_focus(ui, HIT_METHOD, number, box);
    c->y = box.max.y;
    if (row->known) draw_figures(view, c, row, base, narrow);
    c->y = fmax(c->y, box.max.y);
}

static void draw_method_titles(ui_state *ui, column *c) {
    static const char *const titles[] = {"cells", "area", "tests", "time"};
    column_heading(ui, c, "What is kept", NULL);
    if (column_is_narrow(ui, c)) return;
    const double size = 0.9 * figure_size(ui, c);
    for (int i = 0; i < 4; i++)
        ui_text_right(ui, figure_end(c, i), c->y - 0.55 * ui->text, size, ui->palette.faint,
                      titles[i]);
}

/// The cell of the plan under the pointer; SL_NO_CELL for none.
static uint32_t cell_under_pointer(const view_state *view) {
    const sl_box plan = view->plan[0];
    if (!view->document->baked || view->ui->over.kind != HIT_PLAN) return SL_NO_CELL;
    return sl_space_locate(&view->document->baked->space,
                           camera_point(&view->camera, plan, view->ui->pointer));
}

static void draw_methods(view_state *view, column *c) {
    ui_state *ui = view->ui;
    const seen_state *seen = &view->seen;
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const uint32_t cell = cell_under_pointer(view);
    draw_method_titles(ui, c);
    for (size_t i = 0; i < count && i < SEEN_MOST; i++) {
        const seen_method *m = &seen->methods[i];
        const method_row row = {.name = methods[i].name,
                                .which = layers_method_tone(i, view->method),
                                .known = seen->valid && m->known,
                                .counts_cells = true,
                                .chosen = i == view->method,
                                .other = view->compare && i == view->other,
                                .keeps = view->seen.valid && m->known && cell != SL_NO_CELL &&
                                         sl_eye_sees(m->cells, cell),
                                .cells = m->count,
                                .area = m->area,
                                .seconds = m->seconds,
                                .tests = m->account.orientations};
        draw_method(view, c, &row, (int)i);
    }
    const method_row region = {.name = "visible region",
                               .which = TONE_REGION,
                               .known = seen->valid,
                               .area = seen->region_area,
                               .seconds = seen->region_seconds,
                               .tests = seen->region.portals_passed};
    draw_method(view, c, &region, -1);
    if (!seen->valid) return;
    char area[SL_COUNT_TEXT], line[160];
    write_area(seen->region_area, area);
    const int length = snprintf(line, sizeof line, "The visible region has an area of %s.", area);
    const seen_method *method = &seen->methods[view->method];
    if (method->known && !view->compare && seen->region_area > 0)
        snprintf(line + length, sizeof line - (size_t)length,
                 " The cells kept have %.1f times that.", method->area / seen->region_area);
    column_words(ui, c, 0.9, ui->palette.faint, line);
}

/// What mirrors add.
static void draw_mirrored(view_state *view, column *c) {
    const seen_state *seen = &view->seen;
    const uint32_t cells = seen->methods[view->method].mirrored_count;
    char share[SL_COUNT_TEXT], text[160];
    if (!view->document->map.mirror_count || !seen->valid) return;
    sl_text_percent(view->document->area > 0 ? seen->mirrored_area / view->document->area : 0,
                    share);
    const size_t parts = seen->in_mirrors.part_count;
    const int length =
        snprintf(text, sizeof text, "In mirrors: %u cell%s more, and %s of the area in %zu part%s.",
                 cells, cells == 1 ? "" : "s", share, parts, parts == 1 ? "" : "s");
    if (seen->depth < view->document->mirror_depth)
        snprintf(text + length, sizeof text - (size_t)length,
                 " Parts to %u reflection%s: more take too long.", seen->depth,
                 seen->depth == 1 ? "" : "s");
    column_words(view->ui, c, 0.9, view->ui->palette.ink, text);
}

/// What the looser of the two methods compared adds.
static void draw_difference(view_state *view, column *c) {
    size_t count;
    const sl_eye_method *methods = sl_eye_methods(&count);
    const size_t loose = view->other < view->method ? view->other : view->method;
    const size_t tight = view->other < view->method ? view->method : view->other;
    const seen_method *more = &view->seen.methods[loose], *less = &view->seen.methods[tight];
    if (!view->compare || loose == tight || !view->seen.valid || !more->known || !less->known)
        return;
    char share[SL_COUNT_TEXT], text[256], cost[80] = "";
    sl_text_percent(view->document->area > 0 ? (more->area - less->area) / view->document->area : 0,
                    share);
    if (!view->ui->steady && more->seconds > 0)
        snprintf(cost, sizeof cost, ", which takes %.2g times as long",
                 less->seconds / more->seconds);
    snprintf(text, sizeof text, "%s adds %u cells, %s of the area, to %s%s.", methods[loose].name,
             more->count - less->count, share, methods[tight].name, cost);
    ui_spaces(text);
    column_words(view->ui, c, 0.95, view->ui->palette.ink, text);
}

// --- words

/// Describes the cell under a point. The caller breaks the text into lines.
static void describe_place(const view_state *view, sl_point at, char *text, size_t room) {
    text[0] = '\0';
    if (!view->document->baked) return;
    const sl_space *space = &view->document->baked->space;
    const uint32_t cell = sl_space_locate(space, at);
    char place[PLACE_TEXT];
    view_say_place(&view->document->map, at, place);
    if (cell == SL_NO_CELL) {
        snprintf(text, room, "%s: outside the map", place);
        return;
    }
    const sl_cell *c = &space->cells[cell];
    if (c->solid) {
        snprintf(text, room, "Solid ground at %s: nobody looks from there.", place);
        return;
    }
    if (view->mode == MODE_PLAN) {
        snprintf(text, room, "%s, %s.", place,
                 !sl_baked_counts(view->document->baked, cell) ? "outside" : "inside");
        return;
    }
    const size_t word = cell / 64, bit = cell % 64;
    const bool counts = sl_baked_counts(view->document->baked, cell);
    char area[SL_COUNT_TEXT];
    write_area(view->document->areas[cell], area);
    int length = snprintf(text, room, "Cell %u at %s: %u portal%s, area %s%s.", cell, place,
                          c->directed_count, c->directed_count == 1 ? "" : "s", area,
                          counts ? "" : ", not inside");
    if (!view->seen.valid || !view->seen.pvs || length < 0 || (size_t)length >= room) return;
    size_t count;
    sl_eye_methods(&count);
    const bool seen = count && view->seen.methods[count - 1].known &&
                      view->seen.methods[count - 1].cells[word] >> bit & 1;
    const bool pvs = view->seen.pvs[word] >> bit & 1;
    const bool mirrored = view->seen.mirrored[word] >> bit & 1;
    snprintf(text + length, room - (size_t)length, " %s",
             cell == view->seen.cell ? "The eye stands in it."
             : seen                  ? "The eye sees it."
             : pvs                   ? "The eye's cell sees it, the eye does not."
             : mirrored              ? "The eye's cell sees it by mirror."
                                     : "It is not seen from the eye's cell.");
    const bool both = sl_plan_make(&view->document->map).mutual || view->seen.cell == SL_NO_CELL;
    const size_t used = strlen(text);
    if (!both && cell != view->seen.cell)
        snprintf(text + used, room - used, " It %s the eye's cell.",
                 present_sees(view->context, &view->present, cell, view->seen.cell)
                     ? "sees"
                     : "does not see");
}

bool pane_say_place(const view_state *view, char *text, size_t room) {
    sl_point at;
    const bool over = view_pointed(view, &at);
    if (!over) at = view->eye.at;
    const bool explores = over && view->mode == MODE_EXPLORE;
    const uint32_t object = explores ? object_at(view, at) : UINT32_MAX;
    const uint32_t door = over ? door_at(view, at) : UINT32_MAX;
    if (door != UINT32_MAX)
        snprintf(text, room, "Door %s, which is %s: a click %s it.",
                 view->document->map.doors[door].name,
                 view->document->map.doors[door].open ? "open" : "shut",
                 view->document->map.doors[door].open ? "shuts" : "opens");
    else if (object != UINT32_MAX)
        object_describe(view, object, text, room);
    else
        describe_place(view, at, text, room);
    return over;
}

void pane_words(view_state *view, column *c) {
    char text[512];
    const bool over = pane_say_place(view, text, sizeof text);
    column_heading(view->ui, c,
                   over                      ? "Under the pointer"
                   : view->mode == MODE_PLAN ? "Under the viewpoint"
                                             : "Under the eye",
                   NULL);
    c->y = ui_paragraph(view->ui, c->left, c->y + 0.7 * view->ui->text, c->right - c->left, 0.95,
                        view->ui->palette.ink, text);
}

void pane_why(learn_state *learn, column *c) {
    const quiz_state *q = &learn->quiz;
    char text[1024];
    if (!q->answered) return;
    snprintf(text, sizeof text, "Why cell %u %s cell %u%s", q->from,
             q->explanation.verdict == SL_HIDDEN && !quiz_is_bent(q) ? "does not see" : "sees",
             q->to, quiz_is_bent(q) ? " by mirror" : "");
    column_heading(learn->ui, c, text, NULL);
    quiz_words(learn, text, sizeof text);
    column_words(learn->ui, c, 0.95, learn->ui->palette.ink, text);
    static const char *const step[] = {"why_step", NULL};
    column_buttons(learn->ui, c, step);
    c->y += 0.4 * learn->ui->text;
}

void pane_side(learn_state *learn, sl_box box) {
    column c = column_begin(learn->ui, box);
    pane_why(learn, &c);
    column_layers(learn->view, &c);
    column_check(learn->ui, &c, "first_person");
    column_check(learn->ui, &c, "account");
    column_legend(learn->view, &c);
    c.y += 0.3 * learn->ui->text;
    column_sliders(learn->ui, &c);
    static const char *const views[] = {"views_merge", "views_split", "views_largest", NULL};
    if (learn->view->show & SHOW_VIEWS && view_layer_shown(learn->view->views))
        column_buttons(learn->ui, &c, views);
    static const char *const heat[] = {"heat_back", "heat_next", "heat_steps", "heat_hold", NULL};
    if (layers_shows(learn->view, LAYER_HEAT)) column_buttons(learn->ui, &c, heat);
    draw_methods(learn->view, &c);
    draw_mirrored(learn->view, &c);
    draw_difference(learn->view, &c);
    pane_words(learn->view, &c);
    static const char *const rows[][5] = {{"home", "fly", "method", "other", NULL},
                                          {"record", "play", "export_series", NULL},
                                          {"save_svg", "save_pdf", "doors", NULL}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) column_buttons(learn->ui, &c, rows[i]);
    column_end(learn->ui, &c);
}

// --- drawing walls

static void draw_rule(ui_state *ui, column *c, const char *text) {
    c->y = ui_paragraph(ui, c->left, c->y + 0.35 * ui->text, c->right - c->left, 0.95,
                        ui->palette.ink, text);
}

void pane_draw(learn_state *learn, sl_box box) {
    column c = column_begin(learn->ui, box);
    const bool doors = learn->view->edit.draws_doors;
    char walls[SL_COUNT_TEXT], steps[SL_COUNT_TEXT], text[160];
    column_heading(learn->ui, &c, "Walls and doors", "key");
    column_check(learn->ui, &c, "draw_doors");
    c.y += 0.8 * learn->ui->text;
    draw_rule(learn->ui, &c,
              doors ? "Drag along a wall, or across a gap: a new door. It cuts the wall."
                    : "Drag on free ground: a new wall, in any direction, its ends on the grid.");
    draw_rule(learn->ui, &c,
              doors ? "Drag a door: moves it. Esc takes that back."
                    : "Drag a wall, a corner or a door: moves it. Esc takes that back.");
    draw_rule(learn->ui, &c,
              doors ? "Click a door: chooses it. Delete: deletes it."
                    : "Click a wall or a door: chooses it. Delete: deletes it.");
    sl_text_count(learn->document->map.wall_count, "wall", walls);
    sl_text_count(learn->document->history.done.count, "step", steps);
    snprintf(text, sizeof text, "%s; %s to undo, %zu to redo.", walls, steps,
             learn->document->history.undone.count);
    draw_rule(learn->ui, &c, text);
    column_layers(learn->view, &c);
    column_legend(learn->view, &c);
    draw_methods(learn->view, &c);
    pane_words(learn->view, &c);
    column_end(learn->ui, &c);
}

// --- the quiz

static void draw_question(learn_state *learn, column *c) {
    ui_state *ui = learn->ui;
    const quiz_state *q = &learn->quiz;
    static const char *const answers[] = {"answer_yes", "answer_no", NULL};
    static const char *const next[] = {"next_question", "why_step", NULL};
    char text[1024];
    quiz_question(learn, text, sizeof text);
    column_words(ui, c, 1.15, ui->palette.ink, text);
    if (!q->answered) {
        column_buttons(learn->ui, c, answers);
        return;
    }
    quiz_words(learn, text, sizeof text);
    column_words(ui, c, 1, ui->palette.ink, text);
    column_buttons(learn->ui, c, next);
}

void pane_quiz(learn_state *learn, sl_box box) {
    column c = column_begin(learn->ui, box);
    const quiz_state *q = &learn->quiz;
    char text[96];
    snprintf(text, sizeof text, "%u of %u right", q->right_count, q->asked_count);
    column_heading(learn->ui, &c, "Seen or not?", q->asked_count ? text : NULL);
    if (q->asked)
        draw_question(learn, &c);
    else {
        quiz_question(learn, text, sizeof text);
        column_words(learn->ui, &c, 0.95, learn->ui->palette.ink, text);
    }
    column_end(learn->ui, &c);
}
