/// What is remembered from one time to the next: $XDG_CONFIG_HOME/sightline/view.conf.
#ifndef VIEWER_SETTINGS_H
#define VIEWER_SETTINGS_H

#include "app.h"

/// Takes over what is remembered; what cannot be read is as if it had never been.
void settings_load(app_state *app);
/// Remembers. Where that fails nothing is said: it is no part of the work.
void settings_save(app_state *app);

#endif
