/// How far the places of a plan are from one: the plan in small pieces coloured by distance, with
/// lines of equal distance.
#ifndef DISTANCE_MAP_H
#define DISTANCE_MAP_H

#include "sightline/draw.h"
#include "sightline/path.h"

/// Draws how far all places are from a point, up to a limit or INFINITY, over the plan. `space`:
/// that of the ways.
sl_status distance_map_draw(sl_context *context, const sl_baked *baked, const sl_space *space,
                            sl_route_finder *finder, sl_point from, double limit,
                            const sl_draw_options *options, const char *path);

#endif
