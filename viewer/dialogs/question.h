/// Dialogs of words: questions, messages of errors, and the menu of all that has to do with files.
#ifndef VIEWER_QUESTION_H
#define VIEWER_QUESTION_H

#include "dialogs/desk.h"

/// Asks. `text` may have line ends. Each answer is led by the letter that chooses it: "S:Save"; the
/// first one is the usual one, the last one is what Escape gives. `then` is called with its number
/// after the dialog is closed.
void question_ask(desk_state *desk, const char *title, const char *text, const char *const *answers,
                  int count, void (*then)(desk_state *desk, int answer));

/// Shows a message until it is closed.
void question_tell(desk_state *desk, const char *title, const char *text);

/// The text of the uppermost dialog; "" where it is no question.
const char *question_text(const desk_state *desk);

void question_draw(desk_state *desk);
void question_act(desk_state *desk, int id);
bool question_key(desk_state *desk, const char *key);

void menu_open(desk_state *desk);
void menu_draw(desk_state *desk);
void menu_act(desk_state *desk, int id);

#endif
