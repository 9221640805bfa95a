/// The account of what accuracy costs, live: each culling method by what it keeps of the view and
/// what that takes.
#ifndef VIEWER_ACCOUNT_H
#define VIEWER_ACCOUNT_H

#include "app.h"

/// Draws the chart into a box of the page.
void account_draw(app_state *app, cairo_t *cairo, sl_box box);

/// Saves it: .png, .svg or .pdf.
sl_status account_save(app_state *app, const char *path);

#endif
