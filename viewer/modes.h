/// The modes: one table of what each draws and says.
#ifndef VIEWER_MODES_H
#define VIEWER_MODES_H

#include "app.h"

typedef struct mode_row {
    const char *hint;                          ///< said when it begins
    void (*panel)(app_state *app, sl_box box); ///< at the right
    void (*below)(app_state *app,
                  const sl_frame *frame); ///< below the walls, over the layers; or NULL
    void (*above)(app_state *app, const sl_frame *frame); ///< above the walls; or NULL
    bool eye, cone;                                       ///< whether those are marked
} mode_row;

/// By app_mode.
const mode_row *mode_table(void);

/// What changes in the plan from frame to frame: cells and regions; `index` tells which of the
/// plans side by side.
void modes_draw_below(app_state *app, const sl_frame *frame, int index);
/// The eye, lines and marks.
void modes_draw_above(app_state *app, const sl_frame *frame);

#endif
