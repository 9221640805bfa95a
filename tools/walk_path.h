/// The way of `sightline walk`: points to walk past, and the frames along them.
#ifndef WALK_PATH_H
#define WALK_PATH_H

#include "isovist_eyes.h"

typedef SL_ARRAY(sl_point) sl_way;

/// Lines of x and y, with blanks or a comma between; # begins a comment. SL_BAD_INPUT with
/// FILE:LINE on anything else, on points outside the map, and where there are fewer than two.
sl_status sl_way_read(sl_context *context, const char *path, const sl_space *space, sl_way *way);

/// A tour: from cell to cell through the middles of portals, to cells chosen at random of those
/// that can be walked to, until it is `length` long. It begins at `start`, which must lie inside
/// the bounds.
sl_status sl_way_tour(sl_context *context, const sl_space *space, sl_point start, uint64_t seed,
                      double length, sl_way *way);

double sl_way_length(const sl_way *way);

/// Eyes every `step` along the way, each looking at the point of the way that is `ahead` on.
sl_status sl_way_frames(sl_context *context, const sl_way *way, double step, double ahead,
                        double fov, sl_eyes *eyes);

#endif
