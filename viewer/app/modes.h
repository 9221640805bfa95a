/// The parts of the window, each drawn into its box; and the table of modes.
#ifndef VIEWER_MODES_H
#define VIEWER_MODES_H

#include "app/app.h"

// --- panes

/// The plan; `index` is its number among the plans side by side. With `vector` no kept picture is
/// used, so that a file gets lines and not pixels.
void pane_plan(app_state *app, sl_box box, int index, bool vector);

void pane_bar(app_state *app, sl_box box);          ///< the buttons at the top
void pane_side(app_state *app, sl_box box);         ///< layers, methods with counts, words
void pane_learn(app_state *app, sl_box box);        ///< in its place: pseudo-code and account
void pane_quiz(app_state *app, sl_box box);         ///< likewise: the question
void pane_draw(app_state *app, sl_box box);         ///< likewise: walls
void pane_status(app_state *app, sl_box box);       ///< the line at the bottom
void pane_time(app_state *app, sl_box box);         ///< a sentence, and the lesson's time line
void pane_dual(app_state *app, sl_box box);         ///< lines as points
void pane_program(app_state *app, sl_box box);      ///< the linear program of the lesson's portals
void pane_first_person(app_state *app, sl_box box); ///< what the eye sees
void pane_account(app_state *app, sl_box box);      ///< what accuracy costs
void pane_effects(view_state *view, sl_box box);    ///< what the map calls for
void pane_help(app_state *app);                     ///< over all
void pane_tip(app_state *app);                      ///< over all: what the pointer is over

/// Work out how many lines the bar and the time line need. Before the layout of a frame.
void pane_bar_measure(app_state *app);
void pane_time_measure(app_state *app);
/// Whether there is a sentence, and which one.
bool pane_time_shown(const app_state *app);
enum { BAR_TEXT = 1280 };
void pane_time_sentence(const app_state *app, char text[BAR_TEXT]);
double pane_time_height(const app_state *app);

/// A pane below the plan. A row of the table in modes.c says when it is shown.
typedef struct pane_below {
    bool (*shown)(const app_state *app);
    void (*draw)(app_state *app, sl_box box);
    double (*lines)(
        const app_state *app); ///< of text that it has room for; NULL: a share of the window
} pane_below;

/// PANES_BELOW of them.
const pane_below *panes_below(void);

/// Describes the cell under a point. The caller breaks the text into lines.
void pane_describe(const app_state *app, sl_point at, char *text, size_t room);

/// Drags the lesson's line, in the dual plane or in the plan.
void pane_dual_drag(app_state *app, sl_box box, sl_point to);
void pane_plan_drag_line(app_state *app, sl_point from, sl_point to);
/// Moves what keys have chosen by a small step: the line in the dual plane, an end in the plan.
void pane_dual_nudge(app_state *app, int x, int y);
/// The portal end of the lesson at a place of the map; UINT32_MAX for none.
uint32_t pane_plan_end_at(const app_state *app, sl_point at);
/// Finds what is under the pointer in one pane and is to be marked in the others.
void pane_dual_hover(app_state *app);

// --- modes

typedef struct mode_row {
    const char *hint;                          ///< said when it begins
    void (*panel)(app_state *app, sl_box box); ///< at the right
    void (*below)(app_state *app,
                  const sl_frame *frame); ///< below the walls, over the layers; or NULL
    void (*above)(app_state *app, const sl_frame *frame); ///< above the walls; or NULL
    bool eye, cone;                                       ///< whether those are marked
} mode_row;

/// By view_mode.
const mode_row *mode_table(void);

/// Draws what changes in the plan from frame to frame: cells and regions. `index` as in pane_plan.
void modes_draw_below(app_state *app, const sl_frame *frame, int index);
/// Draws the eye, lines and marks.
void modes_draw_above(app_state *app, const sl_frame *frame);

#endif
