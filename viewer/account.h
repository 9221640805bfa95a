/// The account of what accuracy costs, live: each culling method by what it keeps of the view and
/// what that takes.
#ifndef VIEWER_ACCOUNT_H
#define VIEWER_ACCOUNT_H

#include "app.h"

/// Draws the chart into a box of the page.
void sl_account_draw(sl_app *app, cairo_t *cairo, sl_box box);

/// Saves it: .png, .svg or .pdf.
sl_status sl_account_save(sl_app *app, const char *path);

#endif
