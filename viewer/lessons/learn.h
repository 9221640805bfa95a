/// What is taught over the view of a document: the lessons, and the quiz, which explains without a
/// question too.
#ifndef VIEWER_LEARN_H
#define VIEWER_LEARN_H

#include "lessons/lesson.h"
#include "plan/view.h"
#include "sightline/explain.h"

typedef struct quiz_state {
    uint32_t from, to;
    uint32_t version; ///< of what was present when the answer was found
    bool asked, answered, right;
    bool judged; ///< answered by the user, who said `said`; else only explained
    bool said;
    bool seeded; ///< by the clock; under scripts questions are always the same
    unsigned asked_count, right_count;
    size_t subject, step; ///< of the lesson, while the pair was explained
    uint64_t random;
    sl_explanation explanation; ///< once answered
} quiz_state;

struct learn_state {
    sl_context *context;
    ui_state *ui;
    document_state *document;
    view_state *view;
    lesson_state lesson;
    quiz_state quiz;
};

#endif
