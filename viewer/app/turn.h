/// The turn of a frame: results are taken, and what follows is made anew.
#ifndef VIEWER_TURN_H
#define VIEWER_TURN_H

#include "app/app.h"

/// The first map is there: puts the eye at its start.
void app_take_opened(app_state *app);

/// Lets time pass: walks, plays, takes over results of the background.
void app_tick(app_state *app, double seconds);

/// Says in the status line what is open.
void app_say_document(app_state *app);

/// Waits for the background. Scripts need this to be the same on every machine.
void app_settle(app_state *app);

/// The progress of the background; that of the document comes first.
job_progress app_progress(const app_state *app);

#endif
