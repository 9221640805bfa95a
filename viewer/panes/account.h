/// The account, live: what each culling method keeps of the view, and what it costs.
#ifndef VIEWER_ACCOUNT_H
#define VIEWER_ACCOUNT_H

#include "plan/view.h"

/// Saves the chart: .png, .svg or .pdf.
sl_status account_save(view_state *view, const char *path);

#endif
