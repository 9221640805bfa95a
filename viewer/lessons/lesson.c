/// What all subjects of a lesson share: the step shown, playing, and the portal ends and the line
/// that are changed by hand.
#include "lessons/lesson.h"

#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const subject_row *const subjects[] = {&lesson_search, &lesson_subdivision, &lesson_pass,
                                              &lesson_place,  &lesson_fisk,        &lesson_effects};

const subject_row *const *subject_table(size_t *count) {
    *count = sizeof subjects / sizeof *subjects;
    return subjects;
}

size_t subject_find(const subject_row *subject) {
    size_t at = 0;
    while (at + 1 < sizeof subjects / sizeof *subjects && subjects[at] != subject) at++;
    return at;
}

const subject_row *lesson_subject(const lesson_state *lesson) {
    return subjects[lesson->subject];
}

static void forget_record(sl_context *context, lesson_state *lesson) {
    sl_steps_destroy(context, &lesson->steps);
    sli_mesh_steps_destroy(context, &lesson->mesh);
    sl_free(context, lesson->effects.items);
    memset(&lesson->effects, 0, sizeof lesson->effects);
    for (int i = 0; i < PASSES; i++) sli_pass_destroy(context, &lesson->passes[i]);
    lesson->pass_cells = 0;
    sl_shape_destroy(context, &lesson->outline);
    sl_fisk_destroy(context, &lesson->fisk);
    sl_placement_destroy(context, &lesson->placement);
    sl_free(context, lesson->bounds.items);
    memset(&lesson->bounds, 0, sizeof lesson->bounds);
    lesson->refused[0] = '\0';
    lesson->made = false;
    lesson->end_count = 0;
    lesson->dragged = false;
    lesson->change_count = 0;
    lesson->chosen_next = lesson->hovered = 0;
    lesson->hovered_step = 0;
    lesson->conflict_known = lesson->program_known = false;
    sl_program_destroy(context, &lesson->program);
}

void lesson_destroy(sl_context *context, lesson_state *lesson) {
    forget_record(context, lesson);
    *lesson = (lesson_state){0};
}

bool lesson_fits(size_t subject, const document_state *document) {
    return !subjects[subject]->fits || subjects[subject]->fits(document);
}

/// Notes whether there are steps to be sought.
static void find_kinds(lesson_state *lesson) {
    const subject_row *subject = lesson_subject(lesson);
    lesson->finds = lesson->rejects = false;
    for (size_t i = 0; i < lesson_length(lesson); i++) {
        lesson->finds |= subject->finds && subject->finds(lesson, i);
        lesson->rejects |= subject->rejects && subject->rejects(lesson, i);
    }
}

sl_status lesson_update(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source) {
    if (!lesson_fits(lesson->subject, document)) lesson_next_subject(context, lesson, document);
    const subject_row *subject = lesson_subject(lesson);
    const bool same_document = lesson->made && lesson->version == document->version;
    if (lesson->made && !same_document) forget_record(context, lesson);
    if (!document->baked || (subject->of_eye && source == SL_NO_CELL)) return SL_OK;
    if (lesson->made && (!subject->of_eye || lesson->source == source)) return SL_OK;
    forget_record(context, lesson);
    SL_TRY(subject->record(context, lesson, document, source));
    lesson->made = true;
    find_kinds(lesson);
    lesson->version = document->version;
    lesson->source = source;
    lesson->plays = false;
    lesson_go(lesson, document, 0);
    return SL_OK;
}

size_t lesson_length(const lesson_state *lesson) {
    return lesson->made ? lesson_subject(lesson)->length(lesson) : 0;
}

bool lesson_shows(const lesson_state *lesson, const document_state *document) {
    return lesson_length(lesson) && lesson->version == document->version;
}

void lesson_set_subject(sl_context *context, lesson_state *lesson, size_t subject) {
    forget_record(context, lesson);
    lesson->subject = subject;
    lesson->plays = false;
    lesson->at = 0;
}

void lesson_next_subject(sl_context *context, lesson_state *lesson,
                         const document_state *document) {
    size_t count, next = lesson->subject;
    subject_table(&count);
    do next = (next + 1) % count;
    while (!lesson_fits(next, document));
    lesson_set_subject(context, lesson, next);
}

void lesson_sentence(const lesson_state *lesson, const document_state *document,
                     char text[SENTENCE]) {
    text[0] = '\0';
    if (lesson_shows(lesson, document)) lesson_subject(lesson)->sentence(lesson, document, text);
}

/// The ends changed: computes the lines again.
static void refresh_lines(lesson_state *lesson) {
    lesson->conflict_known = lesson->program_known = false;
    if (!lesson->end_count) return;
    const uint32_t count = lesson->end_count;
    sl_dual_make(lesson->ends, count, count, &lesson->dual);
    sl_dual_make(lesson->ends, count, count - 1, &lesson->before);
}

/// Takes the portals of the step's sequence, and the line through them with the largest margin.
static void take_sequence(lesson_state *lesson, const sl_space *space) {
    const subject_row *subject = lesson_subject(lesson);
    lesson->end_count = subject->sequence ? subject->sequence(lesson, space, lesson->ends) : 0;
    lesson->dragged = false;
    lesson->change_count = 0;
    lesson->changes_dropped = false;
    lesson->hovered = 0;
    if (lesson->chosen_next > 2 * lesson->end_count + 1) lesson->chosen_next = 0;
    refresh_lines(lesson);
    if (lesson->end_count) lesson->line = lesson->dual.best;
}

void lesson_go(lesson_state *lesson, const document_state *document, size_t step) {
    const size_t length = lesson_length(lesson);
    if (!lesson_shows(lesson, document)) return;
    lesson->at = step < length ? step : length - 1;
    lesson->waited = 0;
    take_sequence(lesson, &document->baked->space);
}

bool lesson_seek(lesson_state *lesson, const document_state *document, bool rejects, bool back) {
    const subject_row *subject = lesson_subject(lesson);
    bool (*const is)(const lesson_state *, size_t) = rejects ? subject->rejects : subject->finds;
    if (!is || !lesson_shows(lesson, document)) return false;
    for (size_t step = lesson->at; back ? step-- > 0 : ++step < lesson_length(lesson);) {
        if (!is(lesson, step)) continue;
        lesson_go(lesson, document, step);
        return true;
    }
    return false;
}

void lesson_set_speed(lesson_state *lesson, int speed) {
    lesson->speed = speed < SPEED_LEAST ? SPEED_LEAST : speed > SPEED_MOST ? SPEED_MOST : speed;
}

void lesson_tick(lesson_state *lesson, const document_state *document, double seconds) {
    if (!lesson->plays) return;
    lesson->waited += seconds;
    const double pause = ldexp(0.5, -lesson->speed);
    const double steps = fmin(floor(lesson->waited / pause), 100);
    if (steps < 1) return;
    const double rest = lesson->waited - steps * pause;
    if (lesson->at + 1 >= lesson_length(lesson)) lesson->plays = false;
    lesson_go(lesson, document, lesson->at + (size_t)steps);
    lesson->waited = fmin(rest, pause);
}

// --- the portal ends and the line, changed by hand

void lesson_keep(lesson_state *lesson, uint32_t what) {
    if (lesson->change_count == UNDO_MOST) {
        memmove(lesson->changes, lesson->changes + 1, (UNDO_MOST - 1) * sizeof *lesson->changes);
        lesson->change_count--;
        lesson->changes_dropped = true;
    }
    lesson_change *change = &lesson->changes[lesson->change_count++];
    *change = (lesson_change){.what = what, .line = lesson->line};
    if (what != CHOSEN_LINE) change->ends = lesson->ends[what / 2];
}

bool lesson_undo(lesson_state *lesson) {
    if (!lesson->change_count) return false;
    const lesson_change *change = &lesson->changes[--lesson->change_count];
    if (change->what != CHOSEN_LINE) lesson->ends[change->what / 2] = change->ends;
    refresh_lines(lesson);
    lesson->line = change->line;
    bool moved = false;
    for (size_t i = 0; i < lesson->change_count; i++)
        moved |= lesson->changes[i].what != CHOSEN_LINE;
    lesson->dragged = moved || lesson->changes_dropped;
    return true;
}

void lesson_reset(lesson_state *lesson, const document_state *document) {
    if (lesson_shows(lesson, document)) take_sequence(lesson, &document->baked->space);
}

void lesson_move_end(lesson_state *lesson, uint32_t end, sl_point to) {
    if (end >= 2 * lesson->end_count) return;
    sl_portal_ends *ends = &lesson->ends[end / 2];
    const sl_portal_ends before = *ends;
    *(end % 2 ? &ends->right : &ends->left) = to;
    if (ends->left.x == ends->right.x && ends->left.y == ends->right.y) *ends = before;
    lesson->dragged = true;
    refresh_lines(lesson);
    if (lesson->dual.corner_count) lesson->line = lesson->dual.best;
}

void lesson_move_line(lesson_state *lesson, sl_dual_line to) {
    lesson->line.slope = fmin(fmax(to.slope, -SL_DUAL_SLOPE), SL_DUAL_SLOPE);
    lesson->line.height = fmin(fmax(to.height, -SL_DUAL_HEIGHT), SL_DUAL_HEIGHT);
}

void lesson_choose(lesson_state *lesson, bool back) {
    const uint32_t count = lesson->end_count ? 2 * lesson->end_count + 2 : 1;
    lesson->chosen_next = (lesson->chosen_next + (back ? count - 1 : 1)) % count;
}

uint32_t lesson_chosen(const lesson_state *lesson) {
    if (!lesson->chosen_next) return CHOSEN_NONE;
    return lesson->chosen_next == 1 ? CHOSEN_LINE : lesson->chosen_next - 2;
}

bool lesson_marked(const lesson_state *lesson, sl_stab_end *end) {
    const uint32_t chosen = lesson_chosen(lesson);
    uint32_t marked = lesson->hovered ? lesson->hovered - 1 : chosen;
    if (marked >= 2 * lesson->end_count) return false;
    *end = (sl_stab_end){marked / 2, marked % 2 == 0};
    return true;
}

void lesson_name_end(uint32_t end, char text[48]) {
    snprintf(text, 48, "%s end of portal %u", end % 2 ? "right" : "left", end / 2 + 1);
}

const sl_conflict *lesson_conflict(sl_context *context, lesson_state *lesson, sl_status *status) {
    *status = SL_OK;
    if (!lesson->conflict_known) {
        *status = sl_conflict_find(context, lesson->ends, lesson->end_count, &lesson->conflict);
        if (*status != SL_OK) lesson->conflict = (sl_conflict){.verdict = SL_STABBED};
        lesson->conflict_known = true;
    }
    return &lesson->conflict;
}

const sl_program *lesson_program(sl_context *context, lesson_state *lesson, sl_status *status) {
    *status = SL_OK;
    if (!lesson->program_known) {
        sl_program_destroy(context, &lesson->program);
        *status = sl_program_make(context, lesson->ends, lesson->end_count, &lesson->program);
        lesson->program_known = *status == SL_OK;
    }
    return lesson->program_known ? &lesson->program : NULL;
}
