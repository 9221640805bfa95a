/// "Seen or not?": the viewer asks first and explains then. It also explains without a question.
#ifndef VIEWER_QUIZ_H
#define VIEWER_QUIZ_H

#include "lessons/learn.h"

void quiz_ask(learn_state *learn); ///< a new pair of cells
void quiz_answer(learn_state *learn, bool seen);
void quiz_forget(learn_state *learn);

/// Explains whether the eye's cell sees another.
void quiz_explain(learn_state *learn, uint32_t from, uint32_t to);

/// An explanation in a lesson goes when the lesson goes on.
void quiz_follow_lesson(learn_state *learn);

/// The question, or why there is none.
void quiz_question(const learn_state *learn, char *text, size_t room);

/// The words after an answer.
void quiz_words(const learn_state *learn, char *text, size_t room);

/// Draws the pair; after the explanation also its portals and its line.
void quiz_draw_below(learn_state *learn, const sl_frame *frame);
void quiz_draw_above(learn_state *learn, const sl_frame *frame);

/// Whether what is explained is seen by mirror alone, with a line to be drawn.
bool quiz_is_bent(const quiz_state *quiz);

#endif
