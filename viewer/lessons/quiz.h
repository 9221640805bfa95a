/// "Seen or not?": the viewer asks first and explains then. It also explains without a question.
#ifndef VIEWER_QUIZ_H
#define VIEWER_QUIZ_H

#include "app/app.h"

void quiz_ask(app_state *app); ///< a new pair of cells
void quiz_answer(app_state *app, bool seen);
void quiz_forget(app_state *app);

/// Explains whether the eye's cell sees another.
void quiz_explain(app_state *app, uint32_t from, uint32_t to);

/// An explanation in a lesson goes when the lesson goes on.
void quiz_follow_lesson(app_state *app);

/// The question, or why there is none.
void quiz_question(const app_state *app, char *text, size_t room);

/// The words after an answer.
void quiz_words(const app_state *app, char *text, size_t room);

/// Draws the pair; after the explanation also its portals and its line.
void quiz_draw_below(app_state *app, const sl_frame *frame);
void quiz_draw_above(app_state *app, const sl_frame *frame);

/// Whether what is explained is seen by mirror alone, with a line to be drawn.
bool quiz_is_bent(const quiz_state *quiz);

#endif
