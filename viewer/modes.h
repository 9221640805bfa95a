/// The modes: one table of what each draws and says.
#ifndef VIEWER_MODES_H
#define VIEWER_MODES_H

#include "app.h"

typedef struct sl_mode_row {
    const char *hint;                       ///< said when it begins
    void (*panel)(sl_app *app, sl_box box); ///< at the right
    void (*below)(sl_app *app,
                  const sl_frame *frame); ///< below the walls, over the layers; or NULL
    void (*above)(sl_app *app, const sl_frame *frame); ///< above the walls; or NULL
    bool eye, cone;                                    ///< whether those are marked
} sl_mode_row;

/// By sl_mode.
const sl_mode_row *sl_mode_rows(void);

/// What changes in the plan from frame to frame: cells and regions; `index` tells which of the
/// plans side by side.
void sl_modes_draw_below(sl_app *app, const sl_frame *frame, int index);
/// The eye, lines and marks.
void sl_modes_draw_above(sl_app *app, const sl_frame *frame);

#endif
