/// What a script can have printed: the state that pictures show, in lines of text.
#ifndef VIEWER_PRINT_H
#define VIEWER_PRINT_H

#include "app/app.h"

#include <stdio.h>

/// Prints a part of the state by its name: PRINT_NAMES. False for an
/// unknown name.
bool print_state(app_state *app, const char *what, FILE *out);

/// The names, with commas between.
#define PRINT_NAMES "lesson, program, why, quiz, first_person, doors, heat, cameras, place"

#endif
