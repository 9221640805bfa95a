/// The layer of the hierarchy's nodes; what it keeps from frame to frame.
#ifndef VIEWER_LAYER_NODES_H
#define VIEWER_LAYER_NODES_H

#include "sightline/context.h"

typedef struct sl_node_layer sl_node_layer;

void sl_node_layer_destroy(sl_context *context, sl_node_layer *layer); ///< NULL: nothing

#endif
