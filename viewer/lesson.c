#include "lesson.h"

#include "base/base.h"

#include <math.h>

static void forget(sl_context *context, sl_lesson *lesson) {
    sl_steps_destroy(context, &lesson->steps);
    lesson->made = false;
    lesson->end_count = 0;
    lesson->dragged = false;
}

void sl_lesson_destroy(sl_context *context, sl_lesson *lesson) {
    forget(context, lesson);
    *lesson = (sl_lesson){0};
}

sl_status sl_lesson_update(sl_context *context, sl_lesson *lesson, const sl_document *document,
                           uint32_t source) {
    if (lesson->made && lesson->version != document->version) forget(context, lesson);
    if (!document->baked || source == SL_NO_CELL) return SL_OK;
    if (lesson->made && lesson->source == source) return SL_OK;
    const bool same_document = lesson->made;
    const size_t at = lesson->at;
    forget(context, lesson);
    lesson->node_count = document->splits.node_count;
    sl_steps_options options = sl_steps_options_default();
    options.sight = document->baked->visibility.sight;
    SL_TRY(sl_steps_record(context, &document->baked->space, &options, source, &lesson->steps));
    lesson->made = true;
    lesson->version = document->version;
    lesson->source = source;
    lesson->plays = false;
    // The subdivision does not depend on the eye: it stays where it is.
    const bool stay = same_document && lesson->subject == SL_SUBJECT_SUBDIVISION;
    sl_lesson_go(lesson, document, stay ? at : 0);
    return SL_OK;
}

size_t sl_lesson_length(const sl_lesson *lesson) {
    if (!lesson->made) return 0;
    return lesson->subject == SL_SUBJECT_SEARCH ? lesson->steps.count : lesson->node_count;
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
    uint32_t exits[SL_DUAL_PORTALS_MOST];
    uint32_t count = sl_steps_sequence(&lesson->steps, lesson->at, exits, SL_DUAL_PORTALS_MOST);
    if (count > SL_DUAL_PORTALS_MOST) count = SL_DUAL_PORTALS_MOST;
    for (uint32_t i = 0; i < count; i++)
        lesson->ends[i] =
            (sl_portal_ends){space->exits[exits[i]].left, space->exits[exits[i]].right};
    lesson->end_count = count;
    lesson->dragged = false;
    sl_lesson_refresh(lesson);
    if (count) lesson->line = lesson->dual.best;
}

void sl_lesson_go(sl_lesson *lesson, const sl_document *document, size_t step) {
    const size_t length = sl_lesson_length(lesson);
    if (!length || lesson->version != document->version) return;
    lesson->at = step < length ? step : length - 1;
    lesson->waited = 0;
    if (lesson->subject == SL_SUBJECT_SEARCH)
        take_sequence(lesson, &document->baked->space);
    else
        lesson->end_count = 0;
}

void sl_lesson_tick(sl_lesson *lesson, const sl_document *document, double seconds) {
    if (!lesson->plays) return;
    lesson->waited += seconds;
    if (lesson->waited < 0.5) return;
    if (lesson->at + 1 >= sl_lesson_length(lesson)) lesson->plays = false;
    sl_lesson_go(lesson, document, lesson->at + 1);
}
