/// Who sees the eye: where one-way glass stands they are not those whom it sees.
#ifndef VIEWER_LAYER_WATCH_H
#define VIEWER_LAYER_WATCH_H

#include "sightline/context.h"

/// What the layer keeps from frame to frame.
typedef struct watch_layer watch_layer;

void watch_layer_destroy(sl_context *context, watch_layer *layer); ///< NULL: nothing

#endif
