/// Random events, to find what falls over.
#ifndef VIEWER_SOAK_H
#define VIEWER_SOAK_H

#include "app.h"

/// Keys, clicks, drags, sizes and maps at random for so many seconds, without a window.
sl_status soak_run(app_state *app, double seconds, uint64_t seed);

#endif
