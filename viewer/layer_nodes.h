/// The layer of the hierarchy's nodes; what it keeps from frame to frame.
#ifndef VIEWER_LAYER_NODES_H
#define VIEWER_LAYER_NODES_H

#include "sightline/context.h"

typedef struct node_layer node_layer;

void node_layer_destroy(sl_context *context, node_layer *layer); ///< NULL: nothing

#endif
