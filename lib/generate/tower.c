/// The floors of an office tower, side by side: no sight goes from one to another.
#include "generate/plot.h"

enum { WINGS = 3, WING_ROWS = 2, BETWEEN = 8 };

sl_status sl_lay_tower(sl_plot *plot) {
    for (int i = 0; i < plot->count; i++) {
        const int column = i % plot->columns, row = i / plot->columns;
        SL_TRY(sl_plot_floor(plot, column * (WINGS * SL_WING_WIDTH + BETWEEN),
                             row * (WING_ROWS * SL_WING_HEIGHT + BETWEEN), WINGS, WING_ROWS));
        if (column + 1 == plot->columns) SL_TRY(sl_plot_row_done(plot, row));
    }
    return SL_OK;
}
