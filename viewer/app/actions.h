/// The table of all actions. Keys, buttons, the help and scripts use it.
#ifndef VIEWER_ACTIONS_H
#define VIEWER_ACTIONS_H

#include "app/app.h"

typedef struct action_row {
    const char *name;  ///< for scripts: "fit"
    const char *key;   ///< "F", "Ctrl+Z", "Left"; NULL for none
    const char *label; ///< on its button
    const char *help;
    unsigned modes; ///< bits 1 << view_mode in which its key counts; 0: all
    unsigned hold;  ///< hold_key: while the key is down; `run` is NULL
    void (*run)(app_state *app);
    bool (*on)(const app_state *app); ///< whether it is switched on; NULL for what is no switch
} action_row;

int action_count(void);
/// The row of an action, from 0. Numbers go by the order of the help.
const action_row *action_at(int number);

/// Has the page show the actions as they are now.
void actions_show(app_state *app);

/// Whether an action only shows what is there, as beside a dialog that leaves the plan in sight.
bool action_looks(int number);

/// The number of an action; -1 for an unknown name.
int action_find(const char *name);
/// The number of the action of a key in a mode; -1 for none.
int action_of_key(const char *key, view_mode mode);

/// Call after each key and click that a dialog took: does what was chosen in it.
void actions_answered(app_state *app);

/// Runs an action. One that is held stays on until app_release.
void action_run(app_state *app, int action);

#endif
