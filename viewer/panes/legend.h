/// The legend: what the plan shows now, each row with a sample that is drawn as in the plan.
#ifndef VIEWER_LEGEND_H
#define VIEWER_LEGEND_H

#include "plan/layers.h"

enum { LEGEND_MOST = 32 };

/// Writes what is shown now, and how. Returns the number of rows.
int layers_legend(const view_state *view, legend_row rows[LEGEND_MOST]);

/// A sample of a tone in a box, as it looks on a cell.
void layers_swatch(ui_state *ui, sl_box box, const legend_row *row);
/// A row with its sample; returns the lower edge.
double layers_legend_row(ui_state *ui, double left, double right, double y, const legend_row *row);

/// Draws the keys of such layers in a column; returns the lower edge.
double layers_key_column(view_state *view, double left, double right, double y);

/// Draws the legend over the plan, where no panel has it; and the keys.
void layers_draw_keys(view_state *view, const sl_frame *frame, bool vector);

#endif
