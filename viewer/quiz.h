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

/// The portals that the explanation shows, with their ends; returns how many.
uint32_t sl_quiz_portals(const sl_app *app, sl_portal_ends *ends, uint32_t room);

#endif
