/// The plan on a sheet of paper, to scale, with what the mode or tool at hand shows over it.
#ifndef VIEWER_SHEET_H
#define VIEWER_SHEET_H

#include "app/app.h"

/// Asks for the paper, the scale and the file. Says so where the plan has no unit.
void sheet_ask(app_state *app);

/// Writes the sheet as .pdf or .svg. SL_BAD_ARGUMENT where the plan does not fit, with a scale that
/// does; SL_IO, SL_NO_MEMORY.
sl_status sheet_save(app_state *app, const char *path);

#endif
