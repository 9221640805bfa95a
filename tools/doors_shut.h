/// The state of doors, as an option gives it.
#ifndef DOORS_SHUT_H
#define DOORS_SHUT_H

#include "sightline/bake.h"

/// Shuts the doors of a baked file that --shut names: "a,b", or "none"; without it (NULL) those
/// that the map says are shut. The map's doors are then as that says, for pictures. SL_BAD_ARGUMENT
/// for a name that is no door's.
sl_status sl_doors_shut(sl_context *context, const char *text, sl_baked *baked);

#endif
