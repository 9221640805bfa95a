/// What of named things a path sees: how things are named, and the table.
#ifndef EXPOSURE_H
#define EXPOSURE_H

#include "inputs/inputs.h"
#include "sightline/bake.h"
#include "sightline/exposure.h"
#include "sightline/support.h"

/// Zeroed, it is empty.
typedef struct exposed_things {
    SL_ARRAY(sl_point) points; ///< of all things
    SL_ARRAY(size_t) ends; ///< by loop: points up to its last one, counted from its thing's first
    SL_ARRAY(sl_exposed) list; ///< with `parts` once all are there
    SL_ARRAY(char *) names;
    sl_exposure *exposures; ///< by thing
} exposed_things;

/// Finds the things of --see, and their exposure to a line. `text`: names of objects, doors and
/// layers with commas between, "objects" and "doors" for all; or zones (zones.h). An object is an
/// area where the middle of its box is inside, else the box's sides.
sl_status exposure_make(sl_context *context, const char *text, const input_options *input,
                        const sl_baked *baked, sl_query *query, const sl_point *path, size_t count,
                        exposed_things *out);
/// Writes a table: a row a thing; "-" is stdout.
sl_status exposure_write(sl_context *context, const exposed_things *things, const char *path);
/// "3 of 5 things are seen"
void exposure_say(const exposed_things *things, char *text, size_t size);
void exposure_destroy(sl_context *context, exposed_things *things);

#endif
