/// The parts of the window, each drawn into its box.
#ifndef VIEWER_PANES_H
#define VIEWER_PANES_H

#include "lessons/learn.h"

/// The plan; `index` is its number among the plans side by side. With `vector` no kept picture is
/// used, so that a file gets lines and not pixels.
void pane_plan(learn_state *learn, sl_box box, int index, bool vector);

void pane_bar(learn_state *learn, sl_box box);      ///< the buttons at the top
void pane_side(learn_state *learn, sl_box box);     ///< layers, methods with counts, words
void pane_learn(learn_state *learn, sl_box box);    ///< in its place: pseudo-code and account
void pane_quiz(learn_state *learn, sl_box box);     ///< likewise: the question
void pane_cameras(learn_state *learn, sl_box box);  ///< likewise: cameras
void pane_measures(learn_state *learn, sl_box box); ///< likewise: what is measured of a plan
void pane_draw(learn_state *learn, sl_box box);     ///< likewise: walls
void pane_time(learn_state *learn, sl_box box);     ///< a sentence, and the lesson's time line
void pane_dual(learn_state *learn, sl_box box);     ///< lines as points
void pane_program(learn_state *learn, sl_box box);  ///< the linear program of the lesson's portals
void pane_first_person(learn_state *learn, sl_box box); ///< what the eye sees
void pane_account(learn_state *learn, sl_box box);      ///< what accuracy costs
void pane_table(learn_state *learn, sl_box box);        ///< what a tool of the Plan mode computed
void pane_effects(learn_state *learn, sl_box box);      ///< what the map calls for
void pane_help(ui_state *ui);                           ///< over all
void pane_tip(ui_state *ui);                            ///< over all: what the pointer is over

/// The line at the bottom: the work in the background, or what the viewer does. Long messages stand
/// over the plan, up to `end`.
void pane_status(learn_state *learn, sl_box box, double end, const job_progress *work,
                 const char *doing);

/// Work out how many lines the bar and the time line need. Before the layout of a frame.
void pane_bar_measure(learn_state *learn);
void pane_time_measure(learn_state *learn);
/// Whether there is a sentence, and which one.
bool pane_time_shown(const learn_state *learn);
enum { BAR_TEXT = 1280 };
void pane_time_sentence(const learn_state *learn, char text[BAR_TEXT]);
double pane_time_height(const learn_state *learn);

/// Drags the lesson's line, in the dual plane or in the plan.
void pane_dual_drag(learn_state *learn, sl_box box, sl_point to);
void pane_plan_drag_line(learn_state *learn, sl_point from, sl_point to);
/// Moves what keys have chosen by a small step: the line in the dual plane, an end in the plan.
void pane_dual_nudge(learn_state *learn, sl_box box, int x, int y);
/// The portal end of the lesson at a place of the map; UINT32_MAX for none.
uint32_t pane_plan_end_at(const learn_state *learn, sl_point at);
/// Finds what is under the pointer in one pane and is to be marked in the others.
void pane_dual_hover(learn_state *learn, sl_box box);

/// Draws the legend over the plan, where no panel has it; and the keys.
void legend_over_plan(view_state *view, const sl_frame *frame, bool vector);

#endif
