/// The one table of what can be done: keys, buttons, the help and scripts all go by it.
#ifndef VIEWER_ACTIONS_H
#define VIEWER_ACTIONS_H

#include "app.h"

typedef struct sl_action {
    const char *name;  ///< for scripts: "fit"
    const char *key;   ///< "F", "Ctrl+Z", "Left"; NULL for none
    const char *label; ///< on its button
    const char *help;
    unsigned modes; ///< bits 1 << sl_mode in which its key counts; 0: all
    unsigned hold;  ///< sl_hold: while the key is down; `run` is NULL
    void (*run)(sl_app *app);
    bool (*on)(const sl_app *app); ///< whether it is switched on; NULL for what is no switch
} sl_action;

const sl_action *sl_actions(size_t *count);

/// The number of an action; -1 for none of that name.
int sl_action_find(const char *name);
/// That of a key in a mode; -1 for none.
int sl_action_of_key(const char *key, sl_mode mode);

/// Does it; one that is held is switched on for good until sl_app_release.
void sl_action_run(sl_app *app, int action);

#endif
