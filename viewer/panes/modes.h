/// The modes, with what each draws and says; and the panes below the plan.
#ifndef VIEWER_MODES_H
#define VIEWER_MODES_H

#include "lessons/learn.h"

/// The panes below the plan, side by side: rows of the table in modes.c.
enum {
    PANE_DUAL,
    PANE_PROGRAM,
    PANE_FIRST_PERSON,
    PANE_ACCOUNT,
    PANE_EFFECTS,
    PANE_TABLE,
    PANES_BELOW
};

/// A pane below the plan. A row of the table in modes.c says when it is shown.
typedef struct pane_below {
    bool (*shown)(const learn_state *learn);
    void (*draw)(learn_state *learn, sl_box box);
    double (*lines)(
        const learn_state *learn); ///< of text that it has room for; NULL: a share of the window
} pane_below;

/// PANES_BELOW of them.
const pane_below *panes_below(void);

// --- modes

typedef struct mode_row {
    const char *hint;                              ///< said when it begins
    void (*panel)(learn_state *learn, sl_box box); ///< at the right
    void (*below)(learn_state *learn,
                  const sl_frame *frame); ///< below the walls, over the layers; or NULL
    void (*above)(learn_state *learn, const sl_frame *frame); ///< above the walls; or NULL
    bool eye, cone;                                           ///< whether those are marked
} mode_row;

/// By view_mode.
const mode_row *mode_table(void);

/// Draws what changes in the plan from frame to frame: cells and regions. `index` as in pane_plan.
void modes_draw_below(learn_state *learn, const sl_frame *frame, int index);
/// Draws the eye, lines and marks.
void modes_draw_above(learn_state *learn, const sl_frame *frame);

#endif
