/// What the files have in common that hold parts of the table of actions.
#ifndef VIEWER_ACTION_PARTS_H
#define VIEWER_ACTION_PARTS_H

#include "app/actions.h"

/// Modes in which keys count, as bits.
enum {
    EXPLORE = 1 << MODE_EXPLORE,
    LEARN = 1 << MODE_LEARN,
    DRAW = 1 << MODE_DRAW,
    QUIZ = 1 << MODE_QUIZ,
    CAMERAS = 1 << MODE_CAMERAS,
    PLAN = 1 << MODE_PLAN,
    NOT_LEARN = EXPLORE | DRAW | QUIZ | PLAN,
    WALKS = EXPLORE | DRAW | LEARN | PLAN,
};

/// An action of one statement, and whether a switch is on.
#define DO(name, statement)                                                                        \
    static void name(app_state *app) {                                                             \
        statement;                                                                                 \
    }
#define IS(name, value)                                                                            \
    static bool is_##name(const app_state *app) {                                                  \
        return value;                                                                              \
    }

/// Rows one after the other.
typedef struct action_part {
    const action_row *rows;
    int count;
} action_part;

/// Tools of the Plan mode, measures, cameras (actions_plan.c).
action_part actions_plan(void);

/// Escape in the Plan mode: stops the work of its tools, or forgets what they show. False: nothing.
bool plan_escape(app_state *app);

/// Return or Escape in the field of a room's name: takes it, or not. False: the key is another one.
bool plan_field_key(app_state *app, const char *key);

/// Has the app do something with a path once the dialog is shut.
void wish_for(desk_state *desk, path_wish wish, const char *path);

#endif
