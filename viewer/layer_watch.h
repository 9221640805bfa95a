/// Who sees the eye: where one-way glass stands they are not those whom it sees.
#ifndef VIEWER_LAYER_WATCH_H
#define VIEWER_LAYER_WATCH_H

#include "sightline/context.h"

/// What the layer keeps from frame to frame.
typedef struct sl_watch_layer sl_watch_layer;

void sl_watch_layer_destroy(sl_context *context, sl_watch_layer *layer); ///< NULL: nothing

#endif
