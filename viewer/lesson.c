#include "lesson.h"

#include "sightline/support.h"

#include <math.h>
#include <string.h>

static const subject_row *const subjects[] = {&lesson_search, &lesson_subdivision, &lesson_pass,
                                              &lesson_effects};

const subject_row *const *subject_table(size_t *count) {
    *count = sizeof subjects / sizeof *subjects;
    return subjects;
}

const subject_row *lesson_subject(const lesson_state *lesson) {
    return subjects[lesson->subject];
}

void lesson_forget(sl_context *context, lesson_state *lesson) {
    sl_steps_destroy(context, &lesson->steps);
    sli_mesh_steps_destroy(context, &lesson->mesh);
    sl_free(context, lesson->effects.items);
    memset(&lesson->effects, 0, sizeof lesson->effects);
    for (int i = 0; i < PASSES; i++) sli_pass_destroy(context, &lesson->passes[i]);
    lesson->pass_cells = 0;
    lesson->made = false;
    lesson->end_count = 0;
    lesson->dragged = false;
}

void lesson_destroy(sl_context *context, lesson_state *lesson) {
    lesson_forget(context, lesson);
    *lesson = (lesson_state){0};
}

static bool fits(size_t subject, const document_state *document) {
    return !subjects[subject]->fits || subjects[subject]->fits(document);
}

sl_status lesson_update(sl_context *context, lesson_state *lesson, const document_state *document,
                        uint32_t source) {
    if (!fits(lesson->subject, document)) lesson_change(context, lesson, document);
    const subject_row *subject = lesson_subject(lesson);
    const bool same_document = lesson->made && lesson->version == document->version;
    if (lesson->made && !same_document) lesson_forget(context, lesson);
    if (!document->baked || (subject->of_eye && source == SL_NO_CELL)) return SL_OK;
    if (lesson->made && (!subject->of_eye || lesson->source == source)) return SL_OK;
    lesson_forget(context, lesson);
    SL_TRY(subject->record(context, lesson, document, source));
    lesson->made = true;
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

void lesson_change(sl_context *context, lesson_state *lesson, const document_state *document) {
    size_t count;
    subject_table(&count);
    lesson_forget(context, lesson);
    do lesson->subject = (lesson->subject + 1) % count;
    while (!fits(lesson->subject, document));
    lesson->plays = false;
    lesson->at = 0;
}

void lesson_sentence(const lesson_state *lesson, const document_state *document,
                     char text[SENTENCE]) {
    text[0] = '\0';
    if (lesson_shows(lesson, document)) lesson_subject(lesson)->sentence(lesson, document, text);
}

void lesson_refresh(lesson_state *lesson) {
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
    lesson_refresh(lesson);
    if (lesson->end_count) lesson->line = lesson->dual.best;
}

void lesson_go(lesson_state *lesson, const document_state *document, size_t step) {
    const size_t length = lesson_length(lesson);
    if (!lesson_shows(lesson, document)) return;
    lesson->at = step < length ? step : length - 1;
    lesson->waited = 0;
    take_sequence(lesson, &document->baked->space);
}

void lesson_tick(lesson_state *lesson, const document_state *document, double seconds) {
    if (!lesson->plays) return;
    lesson->waited += seconds;
    if (lesson->waited < 0.5) return;
    if (lesson->at + 1 >= lesson_length(lesson)) lesson->plays = false;
    lesson_go(lesson, document, lesson->at + 1);
}
