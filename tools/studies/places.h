/// Notes about viewpoints: those that are not inside, and ways through walls.
#ifndef PLACES_H
#define PLACES_H

#include "sightline/bake.h"
#include "studies/isovist.h"

/// Notes how many of some viewpoints are not inside, and the place inside that is nearest to the
/// first of them. `what`: where they are from, "--at 3,4".
void places_note_outside(sl_context *context, const char *what, const sl_space *space,
                         const eye_place *eyes, size_t count);

/// Notes where a path goes through a wall that stops steps. One-way glass stops no path. `what`:
/// how it is given, "--path tour".
sl_status places_note_path(sl_context *context, const char *what, const sl_baked *baked,
                           const sl_point *points, size_t count);

#endif
