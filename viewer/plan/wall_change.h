/// What of the walls of one plan is no wall of another.
#ifndef VIEWER_WALL_CHANGE_H
#define VIEWER_WALL_CHANGE_H

#include "sightline/map.h"
#include "sightline/support.h"

typedef SL_ARRAY(sl_segment) wall_list;

/// Adds the parts of `walls` that no wall of `others` covers. Exact: a wall covers another one
/// where both lie on one line. The ends of parts are ends of walls. Walls that are alike in both
/// plans cost a sort, the rest O(rest * walls).
sl_status wall_change_add(sl_context *context, const wall_list *walls, const wall_list *others,
                          wall_list *out);
double wall_change_length(const wall_list *walls);

#endif
