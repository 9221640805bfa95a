/// The hierarchy while it is made.
#ifndef SL_HIERARCHY_H
#define SL_HIERARCHY_H

#include "sightline/support.h"
#include "sightline/walk.h"

/// The walls on each cell's boundary.
sl_status sl_hierarchy_add_walls(sl_context *context, sl_hierarchy *hierarchy);

/// The walls as occluders: axial ones that overlap or touch in line are made one.
sl_status sl_hierarchy_add_occluders(sl_context *context, sl_hierarchy *hierarchy);

#endif
