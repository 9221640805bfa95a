/// The account, live: what each culling method keeps of the view, and what it costs.
#ifndef VIEWER_ACCOUNT_H
#define VIEWER_ACCOUNT_H

#include "plan/view.h"

/// Draws the chart into a box of the page.
void account_draw(view_state *view, cairo_t *cairo, sl_box box);

/// Saves the chart: .png, .svg or .pdf.
sl_status account_save(view_state *view, const char *path);

#endif
