/// The state of the viewer, and the frame that is drawn from it. It knows no window: the window,
/// scripts and tests use it alike.
#ifndef VIEWER_APP_H
#define VIEWER_APP_H

#include "dialogs/dialog.h"
#include "document/document.h"
#include "document/export.h"
#include "document/map_file.h"
#include "document/save.h"
#include "lessons/learn.h"
#include "panes/modes.h"
#include "plan/changes.h"
#include "plan/present.h"
#include "plan/seen.h"
#include "plan/view.h"
#include "plan/view_cells.h"
#include "sightline/draw.h"
#include "sightline/explain.h"
#include "ui/ui.h"

typedef struct app_state {
    sl_context *context;
    document_state document;
    view_state view;
    learn_state learn;
    path_recorder recorder;
    ui_state ui;
    dialog_state dialog;
    file_state file;
    export_job *exports;       ///< NULL: no pictures are being written
    sl_import_options options; ///< the command line's, for files opened later too
    bool quit;
} app_state;

void app_init(app_state *app, sl_context *context);
void app_destroy(app_state *app);

/// The first map is there: puts the eye at its start.
void app_take_opened(app_state *app);

/// Lets time pass: walks, plays, takes over results of the background.
void app_tick(app_state *app, double seconds);

/// Waits for the background. Scripts need this to be the same on every machine.
void app_settle(app_state *app);

/// The progress of the background; that of the document comes first.
job_progress app_progress(const app_state *app);

/// Draws the whole window of width x height.
void app_draw(app_state *app, cairo_t *cairo);

/// Fits the map into a plan of that size, if the camera is to fit.
void app_fit(app_state *app, sl_box plan);

/// Where things are on the page.
typedef struct window_layout {
    sl_box bar, side, status, plan[2], time;
    int plan_count;
    sl_box below[PANES_BELOW]; ///< the plan; of no width where they are not shown
} window_layout;

window_layout app_layout(const app_state *app);

/// Moves a border between panels, of ui_edges, by pixels; positive: the panel grows.
void app_drag_edge(app_state *app, int edge, double by);

#endif
