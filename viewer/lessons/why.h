/// From an explanation to the lesson: the step of the search that decides.
#ifndef VIEWER_WHY_H
#define VIEWER_WHY_H

#include "app/app.h"

/// Shows, in the lesson of the search, the step that decides on the pair that was explained last:
/// it enters the cell for the first time, or passes over the portal that stops the search.
void why_go_to_step(app_state *app);

#endif
