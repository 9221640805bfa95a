/// What is remembered from one time to the next: $XDG_CONFIG_HOME/sightline/view.conf.
#ifndef VIEWER_SETTINGS_H
#define VIEWER_SETTINGS_H

#include "app.h"

/// Takes over what is remembered; what cannot be read is as if it had never been.
void sl_settings_load(sl_app *app);
/// Remembers. Where that fails nothing is said: it is no part of the work.
void sl_settings_save(sl_app *app);

#endif
