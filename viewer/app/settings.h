/// What is chosen, kept between runs in $XDG_CONFIG_HOME/sightline/view.conf.
#ifndef VIEWER_SETTINGS_H
#define VIEWER_SETTINGS_H

#include "app/app.h"

/// Reads the settings. What cannot be read keeps its default.
void settings_load(app_state *app);
/// Writes the settings. A failure is not reported: the work does not depend on it.
void settings_save(app_state *app);

#endif
