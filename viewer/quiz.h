/// "Seen or not?": the viewer asks first and explains then. Explanations are also given unasked.
#ifndef VIEWER_QUIZ_H
#define VIEWER_QUIZ_H

#include "app.h"

void sl_quiz_ask(sl_app *app); ///< a new pair of cells
void sl_quiz_answer(sl_app *app, bool seen);
void sl_quiz_forget(sl_app *app);

/// Explains whether the eye's cell sees another.
void sl_quiz_explain(sl_app *app, uint32_t from, uint32_t to);

/// What is to be said once it is answered.
void sl_quiz_words(const sl_app *app, char *text, size_t room);

/// The pair, and once it is explained its portals and its line.
void sl_quiz_draw_below(sl_app *app, const sl_frame *frame);
void sl_quiz_draw_above(sl_app *app, const sl_frame *frame);

#endif
