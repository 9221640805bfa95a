#include "plan_overlays.h"

#include "draw/marks.h"
#include "draw/plan.h"
#include "draw/sight.h"
#include "edit.h"
#include "panes.h"
#include "quiz.h"

#include <math.h>

// --- exploring

sl_colour sl_pane_method_colour(const sl_app *app, size_t method) {
    size_t count;
    sl_eye_methods(&count);
    const double share = count > 1 ? (double)method / (double)(count - 1) : 1;
    return sl_palette_ramp(app->dark, 0.10 + 0.66 * share);
}

/// All methods up to the chosen one, each in its colour where it is the last to keep a cell.
static void draw_cull(sl_app *app, const sl_frame *frame, int index) {
    const sl_space *space = &app->document.baked->space;
    cairo_t *cairo = app->ui.cairo;
    const sl_seen *seen = &app->seen;
    if (app->compare == SL_COMPARE_DIFFERENCE) {
        const bool other_is_loose = app->other < app->method;
        const size_t loose = other_is_loose ? app->other : app->method;
        const size_t tight = other_is_loose ? app->method : app->other;
        sl_draw_cell_set(cairo, space, frame, seen->methods[tight].cells, NULL,
                         sl_pane_method_colour(app, tight), 0.75);
        sl_draw_cell_set(cairo, space, frame, seen->methods[loose].cells,
                         seen->methods[tight].cells, app->ui.palette.start, 0.6);
        return;
    }
    const size_t last = index ? app->other : app->method;
    if (app->compare == SL_COMPARE_PANES) {
        sl_draw_cell_set(cairo, space, frame, seen->methods[last].cells, NULL,
                         sl_pane_method_colour(app, last), 0.8);
        return;
    }
    for (size_t i = 0; i <= last; i++)
        if (seen->methods[i].known || i == last)
            sl_draw_cell_set(cairo, space, frame, seen->methods[i].cells,
                             i < last ? seen->methods[i + 1].cells : NULL,
                             sl_pane_method_colour(app, i), 0.8);
}

static bool make_tree(sl_app *app) {
    const uint32_t cell = app->seen.cell;
    if (cell == SL_NO_CELL || !app->document.has_visibility) return false;
    if (app->tree.baked && app->tree_version == app->document.version &&
        app->tree.options.cell == cell && app->tree.options.dark == app->dark)
        return true;
    if (app->tree.baked) sl_scene_destroy(app->context, &app->tree);
    sl_draw_options options = sl_draw_options_default();
    options.layers = SL_LAYER_STAB_TREE;
    options.cell = cell;
    options.dark = app->dark;
    const sl_status status = sl_scene_make(app->context, app->document.baked, &options, &app->tree);
    sl_app_check(app, status);
    app->tree_version = app->document.version;
    return status == SL_OK;
}

/// The strokes stand deepest first: those too deep are left out at the front.
static void draw_tree(sl_app *app, const sl_frame *frame) {
    if (!make_tree(app)) return;
    sl_scene grown = app->tree;
    grown.eye = app->eye.at;
    while (grown.stroke_count && grown.strokes->depth > app->tree_depth) {
        grown.strokes++;
        grown.stroke_count--;
    }
    sl_draw_tree_onto(app->ui.cairo, &grown, frame);
}

static void explore_below(sl_app *app, const sl_frame *frame, int index) {
    const sl_space *space = &app->document.baked->space;
    const sl_palette *palette = &app->ui.palette;
    cairo_t *cairo = app->ui.cairo;
    if (!app->seen.valid) return;
    if (app->show & SL_SHOW_PVS)
        sl_draw_cell_set(cairo, space, frame, app->seen.pvs, NULL, palette->seen[0], 0.8);
    if (app->show & SL_SHOW_CULL) draw_cull(app, frame, index);
    if (app->seen.cell != SL_NO_CELL && app->show & (SL_SHOW_PVS | SL_SHOW_CULL | SL_SHOW_TREE))
        sl_draw_cell(cairo, space, frame, app->seen.cell, palette->source_edge, 0,
                     2.4 * frame->unit);
    if (app->show & SL_SHOW_REGION)
        sl_draw_region(cairo, frame, &app->seen.region, palette->source);
    if (app->show & SL_SHOW_TREE) draw_tree(app, frame);
}

// --- the lesson

/// The cells that the search has entered so far, and the way between their portals.
static void draw_entered(sl_app *app, const sl_frame *frame) {
    const sl_lesson *lesson = &app->lesson;
    const sl_space *space = &app->document.baked->space;
    const sl_palette *palette = &app->ui.palette;
    cairo_t *cairo = app->ui.cairo;
    for (size_t i = 0; i <= lesson->at; i++) {
        const sl_step *s = &lesson->steps.steps[i];
        if (s->kind != SL_STEP_ENTER || !s->first) continue;
        const sl_cell *c = &space->cells[s->cell];
        sl_path_polygon(cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    }
    sl_set_colour(cairo, palette->seen[0]);
    cairo_fill(cairo);
}

static sl_point exit_middle(const sl_space *space, uint32_t exit, sl_point none) {
    if (exit == UINT32_MAX) return none;
    const sl_exit *e = &space->exits[exit];
    return (sl_point){(e->left.x + e->right.x) / 2, (e->left.y + e->right.y) / 2};
}

static void draw_branches(sl_app *app, const sl_frame *frame) {
    const sl_lesson *lesson = &app->lesson;
    const sl_space *space = &app->document.baked->space;
    const sl_palette *palette = &app->ui.palette;
    cairo_t *cairo = app->ui.cairo;
    for (size_t i = 1; i <= lesson->at; i++) {
        const sl_step *s = &lesson->steps.steps[i];
        if (s->kind != SL_STEP_ENTER) continue;
        const sl_step *from = &lesson->steps.steps[s->parent];
        sl_path_segment(cairo, frame, exit_middle(space, from->exit, app->eye.at),
                        exit_middle(space, s->exit, app->eye.at));
    }
    cairo_set_source_rgba(cairo, palette->tree.red, palette->tree.green, palette->tree.blue, 0.45);
    cairo_set_line_width(cairo, 1.5 * frame->unit);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

static void search_below(sl_app *app, const sl_frame *frame) {
    const sl_lesson *lesson = &app->lesson;
    const sl_space *space = &app->document.baked->space;
    const sl_palette *palette = &app->ui.palette;
    const sl_step *now = &lesson->steps.steps[lesson->at];
    const uint32_t here = now->kind == SL_STEP_ENTER || now->kind == SL_STEP_LEAVE
                              ? now->cell
                              : lesson->steps.steps[now->parent].cell;
    draw_entered(app, frame);
    sl_draw_cell(app->ui.cairo, space, frame, here, palette->source_edge, 0.55, 2 * frame->unit);
    if (now->kind == SL_STEP_HIDDEN || now->kind == SL_STEP_BACKWARDS)
        sl_draw_cell(app->ui.cairo, space, frame, now->cell, palette->start, 0.25, 2 * frame->unit);
}

static void lesson_below(sl_app *app, const sl_frame *frame) {
    const sl_lesson *lesson = &app->lesson;
    if (!sl_lesson_length(lesson) || lesson->version != app->document.version) return;
    if (lesson->subject == SL_SUBJECT_SEARCH) {
        search_below(app, frame);
        return;
    }
    sl_draw_split(app->ui.cairo, &app->ui.palette, &app->document.splits, frame,
                  (uint32_t)lesson->at);
}

static void lesson_above(sl_app *app, const sl_frame *frame) {
    const sl_lesson *lesson = &app->lesson;
    if (lesson->subject != SL_SUBJECT_SEARCH || !sl_lesson_length(lesson) ||
        lesson->version != app->document.version)
        return;
    const sl_step_kind kind = lesson->steps.steps[lesson->at].kind;
    draw_branches(app, frame);
    sl_draw_portal_ends(app->ui.cairo, &app->ui.palette, frame, lesson->ends, lesson->end_count,
                        kind == SL_STEP_HIDDEN || kind == SL_STEP_BACKWARDS);
    if (!lesson->end_count) return;
    const sl_line line = sl_dual_line_at(&lesson->dual, lesson->line, -3, 3);
    const bool good =
        sl_dual_margin(&lesson->dual, lesson->ends, lesson->end_count, lesson->line) >= 0;
    sl_draw_line(app->ui.cairo, frame, line.a, line.b,
                 good ? app->ui.palette.ink : app->ui.palette.start, 2 * frame->unit);
}

// --- the quiz

static void quiz_below(sl_app *app, const sl_frame *frame) {
    const sl_quiz *q = &app->quiz;
    const sl_palette *palette = &app->ui.palette;
    if (!q->asked) return;
    const sl_space *space = &app->document.baked->space;
    sl_draw_cell(app->ui.cairo, space, frame, q->from, palette->source_edge, 0.5, 2 * frame->unit);
    sl_draw_cell(app->ui.cairo, space, frame, q->to, palette->door, 0.5, 2 * frame->unit);
}

static void quiz_above(sl_app *app, const sl_frame *frame) {
    const sl_quiz *q = &app->quiz;
    if (!q->asked || !q->answered) return;
    sl_portal_ends ends[SL_DUAL_PORTALS_MOST];
    const uint32_t count = sl_quiz_portals(app, ends, SL_DUAL_PORTALS_MOST);
    const bool seen = q->explanation.verdict != SL_HIDDEN;
    sl_draw_portal_ends(app->ui.cairo, &app->ui.palette, frame, ends, count, !seen);
    if (seen)
        sl_draw_line(app->ui.cairo, frame, q->explanation.shown.a, q->explanation.shown.b,
                     app->ui.palette.ink, 2.2 * frame->unit);
}

// --- all

void sl_overlays_below_walls(sl_app *app, const sl_frame *frame, int index) {
    if (app->mode == SL_MODE_LEARN)
        lesson_below(app, frame);
    else if (app->mode == SL_MODE_QUIZ)
        quiz_below(app, frame);
    else
        explore_below(app, frame, index);
}

void sl_overlays_above_walls(sl_app *app, const sl_frame *frame) {
    const sl_palette *palette = &app->ui.palette;
    if (app->mode == SL_MODE_LEARN) lesson_above(app, frame);
    quiz_above(app, frame);
    if (app->mode == SL_MODE_DRAW) sl_edit_draw(app, frame);
    if (app->mode == SL_MODE_QUIZ) return;
    if (app->mode == SL_MODE_EXPLORE)
        sl_draw_cone(app->ui.cairo, frame, app->eye.at, app->eye.heading, app->eye.fov,
                     6 * app->ui.text, palette->start);
    sl_draw_eye_mark(app->ui.cairo, palette, frame, app->eye.at, app->eye.heading,
                     0.5 * app->ui.text);
}
