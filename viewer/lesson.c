#include "lesson.h"

#include "sightline/support.h"

#include <math.h>
#include <string.h>

static const sl_subject *const subjects[] = {&sl_lesson_search, &sl_lesson_subdivision,
                                             &sl_lesson_pass, &sl_lesson_effects};

const sl_subject *const *sl_subjects(size_t *count) {
    *count = sizeof subjects / sizeof *subjects;
    return subjects;
}

const sl_subject *sl_lesson_subject(const sl_lesson *lesson) {
    return subjects[lesson->subject];
}

void sl_lesson_forget(sl_context *context, sl_lesson *lesson) {
    sl_steps_destroy(context, &lesson->steps);
    sl_mesh_steps_destroy(context, &lesson->mesh);
    sl_free(context, lesson->effects.items);
    memset(&lesson->effects, 0, sizeof lesson->effects);
    for (int i = 0; i < SL_PASSES; i++) sl_pass_destroy(context, &lesson->passes[i]);
    lesson->pass_cells = 0;
    lesson->made = false;
    lesson->end_count = 0;
    lesson->dragged = false;
}

void sl_lesson_destroy(sl_context *context, sl_lesson *lesson) {
    sl_lesson_forget(context, lesson);
    *lesson = (sl_lesson){0};
}

static bool fits(size_t subject, const sl_document *document) {
    return !subjects[subject]->fits || subjects[subject]->fits(document);
}

sl_status sl_lesson_update(sl_context *context, sl_lesson *lesson, const sl_document *document,
                           uint32_t source) {
    if (!fits(lesson->subject, document)) sl_lesson_change(context, lesson, document);
    const sl_subject *subject = sl_lesson_subject(lesson);
    const bool same_document = lesson->made && lesson->version == document->version;
    if (lesson->made && !same_document) sl_lesson_forget(context, lesson);
    if (!document->baked || (subject->of_eye && source == SL_NO_CELL)) return SL_OK;
    if (lesson->made && (!subject->of_eye || lesson->source == source)) return SL_OK;
    sl_lesson_forget(context, lesson);
    SL_TRY(subject->record(context, lesson, document, source));
    lesson->made = true;
    lesson->version = document->version;
    lesson->source = source;
    lesson->plays = false;
    sl_lesson_go(lesson, document, 0);
    return SL_OK;
}

size_t sl_lesson_length(const sl_lesson *lesson) {
    return lesson->made ? sl_lesson_subject(lesson)->length(lesson) : 0;
}

bool sl_lesson_shows(const sl_lesson *lesson, const sl_document *document) {
    return sl_lesson_length(lesson) && lesson->version == document->version;
}

void sl_lesson_change(sl_context *context, sl_lesson *lesson, const sl_document *document) {
    size_t count;
    sl_subjects(&count);
    sl_lesson_forget(context, lesson);
    do lesson->subject = (lesson->subject + 1) % count;
    while (!fits(lesson->subject, document));
    lesson->plays = false;
    lesson->at = 0;
}

void sl_lesson_sentence(const sl_lesson *lesson, const sl_document *document,
                        char text[SL_SENTENCE]) {
    text[0] = '\0';
    if (sl_lesson_shows(lesson, document))
        sl_lesson_subject(lesson)->sentence(lesson, document, text);
}

void sl_lesson_refresh(sl_lesson *lesson) {
    if (!lesson->end_count) return;
    const uint32_t count = lesson->end_count;
    sl_dual_make(lesson->ends, count, count, &lesson->dual);
    sl_dual_make(lesson->ends, count, count - 1, &lesson->before);
}

/// Takes the portals of the step's sequence, and of the lines through them the one with the largest
/// margin.
static void take_sequence(sl_lesson *lesson, const sl_space *space) {
    const sl_subject *subject = sl_lesson_subject(lesson);
    lesson->end_count = subject->sequence ? subject->sequence(lesson, space, lesson->ends) : 0;
    lesson->dragged = false;
    sl_lesson_refresh(lesson);
    if (lesson->end_count) lesson->line = lesson->dual.best;
}

void sl_lesson_go(sl_lesson *lesson, const sl_document *document, size_t step) {
    const size_t length = sl_lesson_length(lesson);
    if (!sl_lesson_shows(lesson, document)) return;
    lesson->at = step < length ? step : length - 1;
    lesson->waited = 0;
    take_sequence(lesson, &document->baked->space);
}

void sl_lesson_tick(sl_lesson *lesson, const sl_document *document, double seconds) {
    if (!lesson->plays) return;
    lesson->waited += seconds;
    if (lesson->waited < 0.5) return;
    if (lesson->at + 1 >= sl_lesson_length(lesson)) lesson->plays = false;
    sl_lesson_go(lesson, document, lesson->at + 1);
}
