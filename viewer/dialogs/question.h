/// Dialogs of words: questions, messages of errors, and the menu of all that has to do with files.
#ifndef VIEWER_QUESTION_H
#define VIEWER_QUESTION_H

#include "app/app.h"

/// Asks. `text` may have line ends. Each answer is led by the letter that chooses it: "S:Save"; the
/// first one is the usual one, the last one is what Escape gives. `then` is called with its number
/// after the dialog is closed.
void question_ask(app_state *app, const char *title, const char *text, const char *const *answers,
                  int count, void (*then)(app_state *app, int answer));

/// Shows a message until it is closed.
void question_tell(app_state *app, const char *title, const char *text);

/// The text of the uppermost dialog; "" where it is no question.
const char *question_text(const app_state *app);

void question_draw(app_state *app);
void question_act(app_state *app, int id);
bool question_key(app_state *app, const char *key);

void menu_open(app_state *app);
void menu_draw(app_state *app);
void menu_act(app_state *app, int id);

#endif
