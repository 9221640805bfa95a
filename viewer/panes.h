/// The parts of the window, each drawn into its box.
#ifndef VIEWER_PANES_H
#define VIEWER_PANES_H

#include "app.h"

/// The plan; `index` tells which of those side by side. Where `vector`, nothing kept is used, so
/// that a file gets lines instead of pixels.
void sl_pane_plan(sl_app *app, sl_box box, int index, bool vector);

void sl_pane_bar(sl_app *app, sl_box box);          ///< the buttons at the top
void sl_pane_side(sl_app *app, sl_box box);         ///< layers, methods with counts, words
void sl_pane_learn(sl_app *app, sl_box box);        ///< in its place: pseudo-code and account
void sl_pane_quiz(sl_app *app, sl_box box);         ///< likewise: the question
void sl_pane_draw(sl_app *app, sl_box box);         ///< likewise: walls
void sl_pane_status(sl_app *app, sl_box box);       ///< the line at the bottom
void sl_pane_time(sl_app *app, sl_box box);         ///< the time line of the lesson
void sl_pane_dual(sl_app *app, sl_box box);         ///< lines as points
void sl_pane_first_person(sl_app *app, sl_box box); ///< what the eye sees
void sl_pane_account(sl_app *app, sl_box box);      ///< what accuracy costs
void sl_pane_effects(sl_app *app, sl_box box);      ///< what the map calls for
void sl_pane_help(sl_app *app);                     ///< over all
void sl_pane_maps(sl_app *app);                     ///< over all: the list of maps

/// A pane below the plan: its file draws it, and a row of the table in panes.c tells when.
typedef struct sl_pane_below {
    bool (*shown)(const sl_app *app);
    void (*draw)(sl_app *app, sl_box box);
    double (*lines)(
        const sl_app *app); ///< of text that it has room for; NULL: a share of the window
} sl_pane_below;

/// SL_PANES_BELOW of them.
const sl_pane_below *sl_panes_below(void);

/// The cell under a point in words; its lines are broken by the caller.
void sl_pane_describe(const sl_app *app, sl_point at, char *text, size_t room);

/// The colours of culling methods: steps of the ramp from loose to exact.
sl_colour sl_pane_method_colour(const sl_app *app, size_t method);

/// The line chosen in the lesson is dragged, in the dual plane or in the plan.
void sl_pane_dual_drag(sl_app *app, sl_box box, sl_point to);
void sl_pane_plan_drag_line(sl_app *app, sl_point from, sl_point to);

#endif
