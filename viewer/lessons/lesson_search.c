/// The lesson of the depth-first search from the eye's cell: which portals it tries, and why it
/// goes on or back.
#include "lessons/learn.h"
#include "sightline/draw.h"

#include <stdio.h>

static sl_status record(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source) {
    sl_steps_options options = sl_steps_options_default();
    options.sight = document->baked->visibility.sight;
    return sl_steps_record(context, &document->baked->space, &options, source, &lesson->steps);
}

static size_t length(const lesson_state *lesson) {
    return lesson->steps.count;
}

// --- words

static const char *const search_code[] = {
    "search(cell, sequence):",
    "    cell is seen",
    "    for each portal out of cell:",
    "        if it goes back: pass it over",
    "        if no line stabs sequence + portal:",
    "            pass it over",
    "        search(cell behind, sequence + portal)",
    "    return",
};

static const char *const *code(const lesson_state *lesson, const document_state *document,
                               size_t *count, size_t *lit) {
    (void)document;
    *count = sizeof search_code / sizeof *search_code;
    switch (lesson->steps.steps[lesson->at].kind) {
    case SL_STEP_ENTER:
        *lit = lesson->at ? 6 : 1;
        break;
    case SL_STEP_BACKWARDS:
        *lit = 3;
        break;
    case SL_STEP_HIDDEN:
        *lit = 5;
        break;
    case SL_STEP_LEAVE:
        *lit = 7;
        break;
    }
    return search_code;
}

/// How many cells are seen by mirror alone: the search does not enter them.
static uint32_t count_by_mirror(const document_state *document, uint32_t source) {
    const sl_visibility *v = &document->baked->visibility;
    if (!document_has_rows(document) || !v->mirrored.cell_count) return 0;
    uint32_t count = 0;
    for (uint32_t cell = 0; cell < v->mirrored.cell_count; cell++)
        count += sl_pvs_sees(&v->mirrored, source, cell) && !sl_pvs_sees(&v->pvs, source, cell);
    return count;
}

static const char *ending(uint32_t count) {
    return count == 1 ? "" : "s";
}

/// How the search takes what the map has beside walls.
static const char *said_of_effects(const document_state *document) {
    const bool doors = document->map.door_count, mirrors = document->map.mirror_count;
    if (doors && mirrors) return " To this search all doors are open, and mirrors are walls.";
    if (doors) return " To this search all doors are open.";
    return mirrors ? " Mirrors are walls to this search." : "";
}

static void say_end(const sl_step *s, const document_state *document, uint32_t source,
                    char text[SENTENCE]) {
    char aside[128] = "";
    const uint32_t by_mirror = count_by_mirror(document, source);
    if (by_mirror)
        snprintf(aside, sizeof aside, " %u more %s seen by mirror alone: U, \"%s\", shows which.",
                 by_mirror, by_mirror == 1 ? "is" : "are", lesson_effects.title);
    snprintf(text, SENTENCE, "All portals of cell %u are tried: it sees %u cell%s%s.%s", s->cell,
             s->seen, ending(s->seen), document->map.door_count ? " with all doors open" : "",
             aside);
}

static void say(const lesson_state *lesson, const document_state *document, char text[SENTENCE]) {
    const char *aside = said_of_effects(document);
    const sl_step *s = &lesson->steps.steps[lesson->at];
    const uint32_t here = lesson->steps.steps[s->parent].cell;
    const char *plural = ending(s->depth);
    switch (s->kind) {
    case SL_STEP_ENTER:
        if (!lesson->at)
            snprintf(text, SENTENCE, "The search starts in cell %u, which sees itself.%s", s->cell,
                     aside);
        else
            snprintf(text, SENTENCE, "A line %s the %u portal%s: enter cell %u, %s.",
                     s->grazing ? "only grazes" : "stabs", s->depth, plural, s->cell,
                     s->first ? "seen for the first time" : "already seen another way");
        return;
    case SL_STEP_BACKWARDS:
        snprintf(text, SENTENCE,
                 "The portal from cell %u to cell %u goes back against the sequence: passed over.",
                 here, s->cell);
        return;
    case SL_STEP_HIDDEN:
        if (s->grazing)
            snprintf(text, SENTENCE,
                     "Lines only touch ends of the %u portal%s to cell %u: with open sight they do "
                     "not count.",
                     s->depth, plural, s->cell);
        else
            snprintf(text, SENTENCE,
                     "No line stabs the %u portal%s to cell %u: its half-planes leave nothing.",
                     s->depth, plural, s->cell);
        return;
    case SL_STEP_LEAVE:
        if (s->depth)
            snprintf(text, SENTENCE, "All portals of cell %u are tried: back one portal.", s->cell);
        else
            say_end(s, document, lesson->source, text);
        return;
    }
}

static void account(const lesson_state *lesson, char text[SENTENCE]) {
    const sl_step *s = &lesson->steps.steps[lesson->at];
    snprintf(text, SENTENCE, "%u cell%s seen, %u node%s in the stab tree, %u portal%s in sequence.",
             s->seen, ending(s->seen), s->node, ending(s->node), s->depth, ending(s->depth));
}

static uint32_t sequence(const lesson_state *lesson, const sl_space *space, sl_portal_ends *ends) {
    uint32_t directed[SL_DUAL_PORTALS_MOST];
    uint32_t count = sl_steps_sequence(&lesson->steps, lesson->at, directed, SL_DUAL_PORTALS_MOST);
    if (count > SL_DUAL_PORTALS_MOST) count = SL_DUAL_PORTALS_MOST;
    for (uint32_t i = 0; i < count; i++)
        ends[i] =
            (sl_portal_ends){space->directed[directed[i]].left, space->directed[directed[i]].right};
    return count;
}

static uint32_t cell_of(const lesson_state *lesson, size_t step) {
    return lesson->steps.steps[step].cell;
}

static bool finds(const lesson_state *lesson, size_t step) {
    return lesson->steps.steps[step].kind == SL_STEP_ENTER && lesson->steps.steps[step].first;
}

static bool rejects(const lesson_state *lesson, size_t step) {
    const sl_step_kind kind = lesson->steps.steps[step].kind;
    return kind == SL_STEP_HIDDEN || kind == SL_STEP_BACKWARDS;
}

// --- drawing

/// Draws the cells that the search has entered, and the way between their portals.
static void draw_entered(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const sl_space *space = &learn->document->baked->space;
    const sl_palette *palette = &learn->ui->palette;
    cairo_t *cairo = learn->ui->cairo;
    for (size_t i = 0; i <= lesson->at; i++) {
        const sl_step *s = &lesson->steps.steps[i];
        if (s->kind != SL_STEP_ENTER || !s->first) continue;
        const sl_cell *c = &space->cells[s->cell];
        sl_path_polygon(cairo, frame, space->vertices + c->first_vertex, c->vertex_count);
    }
    sl_set_colour(cairo, palette->seen[0]);
    cairo_fill(cairo);
}

static sl_point portal_middle(const sl_space *space, uint32_t directed, sl_point none) {
    if (directed == UINT32_MAX) return none;
    const sl_directed_portal *e = &space->directed[directed];
    return (sl_point){(e->left.x + e->right.x) / 2, (e->left.y + e->right.y) / 2};
}

static void draw_branches(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const sl_space *space = &learn->document->baked->space;
    const sl_palette *palette = &learn->ui->palette;
    cairo_t *cairo = learn->ui->cairo;
    for (size_t i = 1; i <= lesson->at; i++) {
        const sl_step *s = &lesson->steps.steps[i];
        if (s->kind != SL_STEP_ENTER) continue;
        const sl_step *from = &lesson->steps.steps[s->parent];
        sl_path_segment(cairo, frame, portal_middle(space, from->directed, learn->view->eye.at),
                        portal_middle(space, s->directed, learn->view->eye.at));
    }
    cairo_set_source_rgba(cairo, palette->tree.red, palette->tree.green, palette->tree.blue, 0.45);
    cairo_set_line_width(cairo, 1.5 * frame->unit);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

static void below(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const sl_space *space = &learn->document->baked->space;
    const sl_palette *palette = &learn->ui->palette;
    const sl_step *now = &lesson->steps.steps[lesson->at];
    const uint32_t here = now->kind == SL_STEP_ENTER || now->kind == SL_STEP_LEAVE
                              ? now->cell
                              : lesson->steps.steps[now->parent].cell;
    draw_entered(learn, frame);
    sl_draw_cell(learn->ui->cairo, space, frame, here, palette->source_edge, 0.55, 2 * frame->unit);
    if (now->kind == SL_STEP_HIDDEN || now->kind == SL_STEP_BACKWARDS)
        sl_draw_cell(learn->ui->cairo, space, frame, now->cell, palette->start, 0.25,
                     2 * frame->unit);
}

static void above(learn_state *learn, const sl_frame *frame) {
    const lesson_state *lesson = &learn->lesson;
    const sl_step_kind kind = lesson->steps.steps[lesson->at].kind;
    draw_branches(learn, frame);
    sl_draw_portal_ends(learn->ui->cairo, &learn->ui->palette, frame, lesson->ends,
                        lesson->end_count, kind == SL_STEP_HIDDEN || kind == SL_STEP_BACKWARDS);
    if (!lesson->end_count) return;
    const sl_line line = sl_dual_line_at(&lesson->dual, lesson->line, -3, 3);
    const bool good =
        sl_dual_margin(&lesson->dual, lesson->ends, lesson->end_count, lesson->line) >= 0;
    sl_draw_line(learn->ui->cairo, frame, line.a, line.b,
                 good ? learn->ui->palette.ink : learn->ui->palette.start, 2 * frame->unit);
}

const subject_row lesson_search = {
    .title = "Depth-first search",
    .of_eye = true,
    .record = record,
    .length = length,
    .sentence = say,
    .code = code,
    .account = account,
    .sequence = sequence,
    .cell = cell_of,
    .finds = finds,
    .rejects = rejects,
    .found = "New cell",
    .rejected = "Rejection",
    .below = below,
    .above = above,
};
